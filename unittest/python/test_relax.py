"""Keyword relax of pair_coeff: waves, force, heat, what is conserved, files, other commands, bad input; test_relax_noise.py has the noise.

The reference is written down here, from the equations: P = rho sum g phi1(a) x, x = ln(rho/rho_r), g = kappa_r/(rho0 tau), a = dt/tau,
phi1 = (1 - exp(-a))/a, and at the start of each step ln rho_r grows by (1 - exp(-a)) x - sqrt(2 kT dt/(m g tau)) xi.
"""

import re

import numpy as np
import pytest

import test_micropolar as micro
from helpers import Particles, SUPPORT, as_written, disordered, drop, dump, fluid, free, header, lattice, relative, undump

FULL = "thermo_modify norm no format float %.17g\n"


# ---- reference ---------------------------------------------------------------------------------------------------


def phi1(a):
    return -np.expm1(-a) / a


def wendland(r, R, dim):
    """W, -W'/r, and W'' of the kernel wendland/c2."""
    q = r / R
    norm = {1: 1.5, 2: 7.0 / np.pi, 3: 10.5 / np.pi}[dim] / R**dim
    return (norm * (1.0 - q) ** 4 * (1.0 + 4.0 * q), 20.0 * norm / R**2 * (1.0 - q) ** 3,
            norm / R**2 * (60.0 * q * (1.0 - q) ** 2 - 20.0 * (1.0 - q) ** 3))


def lattice_sums(sites, k, R, dim):
    """Density of a lattice, and its two wave numbers, of the density and of a uniform pressure: sites around one, wave along x."""
    r = np.linalg.norm(sites, axis=1)
    near = (r < R) & (r > 0.0)
    x, r = sites[near, 0], r[near]
    W, F, bend = wendland(r, R, dim)
    number = W.sum() + wendland(0.0, R, dim)[0]
    q = (F * x * np.sin(k * x)).sum() / number
    along = (x / r) ** 2
    q2 = np.sqrt(((bend * along - F * (1.0 - along)) * (1.0 - np.cos(k * x))).sum() / number)
    return number, q, q2


def elastic(q, q2, c0, pb):
    """Square of the frequency of sound without relaxation, rho = 1."""
    return c0**2 * q**2 + 2.0 * pb * (q2**2 - q**2)


def cubic(q, square, g, tau, nu=0.0):
    """The roots s of a wave exp(s t) with one process: sound (positive frequency), relaxation."""
    roots = np.roots([1.0, 1.0 / tau + nu * q**2, square + g * q**2 + nu * q**2 / tau, square / tau])
    return roots[np.argmax(roots.imag)], roots[np.argmin(np.abs(roots.imag))].real


def one_step(q, square, processes, timestep, nu=0.0):
    """Matrix of a step on displacement, velocity, acceleration, and ln rho_r of each process of a wave; (g, tau) of the processes."""
    def step(state):
        xi, v, acceleration = state[:3]
        relaxed = state[3:].copy()
        for k, (_, tau) in enumerate(processes):
            relaxed[k] += -np.expm1(-timestep / tau) * (-q * xi - relaxed[k])
        v = v + 0.5 * timestep * acceleration
        seen = v + 0.5 * timestep * acceleration
        xi = xi + timestep * v
        acceleration = -square * xi - nu * q**2 * seen
        for k, (g, tau) in enumerate(processes):
            acceleration += q * g * phi1(timestep / tau) * (-q * xi - relaxed[k])
        return np.concatenate([[xi, v + 0.5 * timestep * acceleration, acceleration], relaxed])

    return np.array([step(unit) for unit in np.eye(3 + len(processes))]).T


def modes(matrix, timestep):
    """(root, state) of sound, with positive frequency, and of all that decays without one, the slowest last; velocity 1 in the states."""
    values, vectors = np.linalg.eig(matrix)
    values = values.astype(complex)
    sound = np.argmax(values.imag)
    others = [k for k in np.argsort(values.real) if abs(values[k].imag) < 1e-12 and values[k].real > 1e-12]
    return [(np.log(values[k]) / timestep, vectors[:, k] / vectors[1, k]) for k in [sound, *others]]


# ---- input -------------------------------------------------------------------------------------------------------


def write(particles, path, relaxed, style="sph/bulk", **keywords):
    """Data file with the relaxed densities, one column for each process, before the position; -1: minus the density."""
    relaxed = np.broadcast_to(np.asarray(relaxed, dtype=float), (len(particles), np.shape(relaxed)[-1]))
    if style == "sph/bulk":
        particles.write(path, **keywords)
    else:
        micro.write(particles, path, **keywords)
    head, atoms, rest = re.fullmatch(r"(.*Atoms [^\n]*\n\n)(.*?\n)(\nVelocities.*)", path.read_text(), re.S).groups()
    lines = [line.split() for line in atoms.splitlines()]
    lines = [" ".join([*words[:-3], *map(repr, row.tolist()), *words[-3:]]) + "\n" for words, row in zip(lines, relaxed)]
    path.write_text(head + "".join(lines) + rest)


def strained(strain):
    """The column of a data file for strains x at the first forces."""
    return -np.exp(-np.asarray(strain, dtype=float))


def room(dim, count=1, style="sph/bulk", **keywords):
    return header(dim, style=f"{style} relax {count}", **keywords)


def start(lammps, particles, model, strain=0.0, count=1, timestep=0.005, integrator="", extra="", **keywords):
    """Particles with strains, one number or (particles, processes)."""
    strain = np.broadcast_to(np.asarray(strain, dtype=float), (len(particles), count))
    write(particles, lammps.path("box.data"), strained(strain))
    return (room(particles.dim, count, **keywords) + "read_data box.data\n" + extra + model
            + f"fix FLUID all sph/bulk {integrator}\ntimestep {timestep}\n")


def relaxed_of(frame, count=1):
    return np.column_stack([frame.columns[f"d_rho_relaxed{k}"] for k in range(1, count + 1)])


def strain_of(frame, count=1):
    """ln(rho/rho_r); 0 of particles that do not have the process."""
    rho, relaxed = frame["rho"][:, None], relaxed_of(frame, count)
    return np.log(rho / np.where(relaxed == 0.0, rho, relaxed))


def columns(count=1):
    return " ".join(f"d_rho_relaxed{k}" for k in range(1, count + 1))


# ---- waves -------------------------------------------------------------------------------------------------------


def unit_lattice(name, cells, width):
    """A lattice of one particle per unit volume in a periodic box of cells x width (x width) cubic or rectangular cells, and the sites
    around one of its particles."""
    dim, basis, shape = {
        "line": (1, [(0, 0, 0)], (1, 1, 1)),
        "sq": (2, [(0, 0, 0)], (1, 1, 1)),
        "hex": (2, [(0, 0, 0), (0.5, 0.5, 0)], (1, np.sqrt(3.0), 1)),
        "sc": (3, [(0, 0, 0)], (1, 1, 1)),
        "bcc": (3, [(0, 0, 0), (0.5, 0.5, 0.5)], (1, 1, 1)),
        "fcc": (3, [(0, 0, 0), (0.5, 0.5, 0), (0.5, 0, 0.5), (0, 0.5, 0.5)], (1, 1, 1)),
    }[name]
    cell = np.array(shape) * (len(basis) / np.prod(shape[:dim])) ** (1.0 / dim)

    def points(counts):
        grid = np.stack(np.meshgrid(*map(np.arange, counts), indexing="ij"), axis=-1).reshape(-1, 1, 3)
        return ((grid + np.array(basis)) * cell).reshape(-1, 3)

    counts = [cells, width if dim > 1 else 1, width if dim > 2 else 1]
    x = points(counts) + 0.25 * cell * (np.arange(3) < dim)
    lo, hi = np.full(3, -0.5), np.full(3, 0.5)
    lo[:dim], hi[:dim] = 0.0, (counts * cell)[:dim]
    if dim == 1:
        lo[1], hi[1] = -10.0, 10.0
    number = len(x)
    particles = Particles(dim, x, np.zeros((number, 3)), np.ones(number), np.full(number, 5.0), np.ones(number, dtype=int), lo, hi)
    half = [9 if d < dim else 0 for d in range(3)]
    around = points([2 * n + 1 for n in half]) - cell * half
    return particles, around


class Wave:
    """A sound wave as long as the box along x, of a lattice of particles with rho = rho0 = c0 = 1."""

    AMPLITUDE = 6e-6    # larger: nonlinear terms; smaller: round-off of positions and densities

    def __init__(self, lammps, name, cells, support, pb, width=1):
        self.lammps, self.pb, self.support = lammps, pb, support
        self.particles, sites = unit_lattice(name, cells, width)
        self.dim = self.particles.dim
        self.k = 2.0 * np.pi / self.particles.hi[0]
        number, self.q, self.q2 = lattice_sums(sites, self.k, support, self.dim)
        self.particles.mass[:] = 1.0 / number
        self.square = elastic(self.q, self.q2, 1.0, pb)
        self.sites = self.particles.x.copy()

    def run(self, state, processes, timestep, steps, every=1, kappa=0.0, integrator="", commands=None, ranks=1):
        """Amplitude of the velocity and of the strain of the first process, from a state of the matrix of a step."""
        phase = self.k * self.sites[:, 0]
        state = self.AMPLITUDE * np.real(state)
        particles = self.particles
        particles.x[:, 0] = self.sites[:, 0] + state[0] * np.sin(phase)
        particles.v[:, 0] = state[1] * np.sin(phase)
        strain = [np.cos(phase) * (-self.q * state[0] - value) for value in state[3:]]
        words = "relax " + " ".join(f"{g * tau} {tau}" for g, tau in processes) if processes else ""
        model = fluid(self.dim, "shear none", mu=0.0, kappa=kappa, c0=1.0, support=self.support, keywords=f"pb {self.pb} {words}")
        text = start(self.lammps, particles, model, np.transpose(strain) if strain else 0.0, max(len(processes), 1), timestep, integrator)
        text += (f"variable k equal {self.k}\nvariable u atom vx*sin(v_k*x)\ncompute P all property/atom rho d_rho_relaxed1\n"
                 f"variable s atom {'ln(c_P[1]/c_P[2])*cos(v_k*x)' if processes else '0.0'}\ncompute A all reduce ave v_u v_s\n"
                 f"thermo_style custom step time c_A[*]\nthermo {every}\n" + FULL)
        tables = self.lammps(text + (commands or f"run {steps}\n"), ranks=ranks).thermo()
        return tuple(2.0 * np.concatenate([table[f"c_A[{k}]"][bool(n):] for n, table in enumerate(tables)]) for k in (1, 2))


def fitted(series, interval):
    """The root s with positive frequency of a series Re(A exp(s t)): x_{n+2} = b x_{n+1} - d x_n."""
    (b, d), *_ = np.linalg.lstsq(np.column_stack([series[1:-1], -series[:-2]]), series[2:], rcond=None)
    z = np.roots([1.0, -b, d])
    return np.log(z[np.argmax(z.imag)].astype(complex)) / interval


# k c0 tau: with the time step, dt/tau from 0.67 to 2e-4
TIMES = [0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0]
STEP = 0.2048  # of the line, 0.1 h/sqrt(c0^2 + g) with g = 0.5


def test_reference():
    """Long waves and many neighbors are a continuum, short steps the cubic; one table of roots to all of its digits."""
    _, sites = unit_lattice("line", 64, 1)
    _, q, q2 = lattice_sums(sites, 1e-3, 8.0, 1)
    assert q == pytest.approx(1e-3, rel=1e-3) and q2 == pytest.approx(1e-3, rel=1e-3)
    _, q, q2 = lattice_sums(sites, 2.0 * np.pi / 64.0, 5.0, 1)
    square = elastic(q, q2, 1.0, 1.0)
    discrete, continuum = [], []
    for time in TIMES:
        tau = 64.0 * time / (2.0 * np.pi)
        exact = cubic(q, square, 0.5, tau)
        errors = [max(abs(modes(one_step(q, square, [(0.5, tau)], step), step)[k][0] - exact[k]) for k in (0, 1)) for step in (0.02, 0.01)]
        assert errors[0] < 1e-6 and (errors[1] < 1e-12 or errors[0] / errors[1] == pytest.approx(4.0, rel=0.1))
        discrete.append(64.0 * exact[0])
        continuum.append(64.0 * cubic(2.0 * np.pi / 64.0, (2.0 * np.pi / 64.0) ** 2, 0.5, tau)[0])
    assert np.round(discrete, 5) == pytest.approx(np.array([
        -.04607 + 6.28498j, -.15285 + 6.29725j, -.43811 + 6.40451j, -.74114 + 7.15036j, -.33234 + 7.59819j, -.10286 + 7.66132j,
        -.01032 + 7.66762j]), abs=1e-9)
    assert np.round(continuum, 5) == pytest.approx(np.array([
        -.04710 + 6.28442j, -.15629 + 6.29693j, -.44828 + 6.40648j, -.75651 + 7.17133j, -.33758 + 7.62532j, -.10441 + 7.68890j,
        -.01047 + 7.69523j]), abs=1e-9)


def compare(found, discrete, stepped, continuum=None, bound=0.03):
    """A root against those of the lattice within 1e-3, with its time step within 1e-7, and of the continuum."""
    print(f"found {found:.7g}, lattice {discrete:.7g}, with the step {stepped:.7g}, continuum {continuum}")
    for part in ("real", "imag") if np.iscomplexobj(discrete) else ("real",):
        value = getattr(found, part)
        assert value == pytest.approx(getattr(stepped, part), rel=1e-7)
        assert value == pytest.approx(getattr(discrete, part), rel=1e-3)
        if continuum is not None:
            assert value == pytest.approx(getattr(continuum, part), rel=bound)


@pytest.mark.parametrize("time", TIMES)
def test_standing_wave_on_a_line(lammps, time):
    """Damping and frequency of sound and the rate of the relaxation."""
    wave = Wave(lammps, "line", 64, 5.0, 1.0)
    tau = time / wave.k
    step = 2 * STEP if time > 10 else STEP    # a strain that follows slowly changes by more than its round-off
    process = [(0.5, tau)]
    exact = cubic(wave.q, wave.square, 0.5, tau)
    (sound, state), (decay, other) = modes(one_step(wave.q, wave.square, process, step), step)
    u, _ = wave.run(state, process, step, 600, 15)
    compare(fitted(u, 15 * step), exact[0], sound)
    steps = max(int(1.0 / abs(decay.real) / step), 1)
    steps = 4 if time < 0.1 else min(steps, 600)
    _, x = wave.run(other * 1.0 / abs(wave.q * other[0] + other[3]), process, step, steps, steps)
    compare(np.log(x[-1] / x[0]) / (steps * step), exact[1], decay.real)


LATTICES = {"sq": (64, 5), "hex": (60, 3), "sc": (64, 5), "bcc": (50, 4), "fcc": (40, 3)}


@pytest.mark.parametrize("name", [pytest.param(name, marks=pytest.mark.long) if name in ("sc", "fcc") else name for name in LATTICES])
@pytest.mark.parametrize("time", [0.3, 1.0, 3.0])
def test_standing_wave_on_a_lattice(lammps, name, time):
    """With a support of four spacings: within 3 percent of the continuum."""
    cells, width = LATTICES[name]
    wave = Wave(lammps, name, cells, 4.0, 0.0, width)
    timestep, tau = 0.2, time / wave.k
    process = [(0.5, tau)]
    exact, continuum = (cubic(q, square, 0.5, tau) for q, square in ((wave.q, wave.square), (wave.k, wave.k**2)))
    (sound, state), (decay, other) = modes(one_step(wave.q, wave.square, process, timestep), timestep)
    u, _ = wave.run(state, process, timestep, 320, 16)
    compare(fitted(u, 16 * timestep), exact[0], sound, continuum[0])
    if time == 1.0:
        _, x = wave.run(other, process, timestep, 60, 60)
        compare(np.log(x[-1] / x[0]) / (60 * timestep), exact[1], decay.real, continuum[1])


def test_two_processes_and_a_constant_viscosity(lammps):
    """Together: the sound of a wave and the slower of its rates."""
    wave = Wave(lammps, "line", 64, 5.0, 1.0)
    wave.AMPLITUDE = 3e-6
    processes, timestep = [(0.3, 0.3 / wave.k), (0.2, 4.0 / wave.k)], 0.2
    roots = modes(one_step(wave.q, wave.square, processes, timestep, nu=0.5), timestep)
    u, _ = wave.run(roots[0][1], processes, timestep, 600, 15, kappa=0.5)
    assert fitted(u[4:], 15 * timestep) == pytest.approx(roots[0][0], rel=1e-7)
    slow = max(roots[1:], key=lambda root: root[0].real)
    _, x = wave.run(slow[1], processes, timestep, 200, 100, kappa=0.5)
    assert np.log(x[-1] / x[1]) / (100 * timestep) == pytest.approx(slow[0].real, rel=1e-7)


def test_short_relaxation_is_a_constant_viscosity(lammps):
    """tau far below the time step: the rate of the density half a step ago, so that the damping of the constant kappa is met to first
    order in the time step."""
    kappa = 0.02 * 64.0
    wave = Wave(lammps, "line", 64, 5.0, 1.0)
    exact = np.roots([1.0, kappa * wave.q**2, wave.square])[0]
    errors, differences = [], []
    for timestep in (0.2, 0.1, 0.05):
        found = []
        for processes, constant in (([(kappa / 1e-5, 1e-5)], 0.0), ([], kappa)):
            matrix = one_step(wave.q, wave.square, processes, timestep, nu=constant)
            root, state = max(modes(matrix, timestep), key=lambda mode: mode[0].imag)
            every = round(3.0 / timestep)
            u, _ = wave.run(state, processes, timestep, 40 * every, every, kappa=constant)
            found.append(fitted(u[2:], every * timestep))
            assert found[-1] == pytest.approx(root, rel=1e-7)
        warned = [any("time 1e-05 of relax of type 1 is far below the time step" in line for line in result.warnings) for result in lammps.results[-2:]]
        assert warned == [True, False]
        errors.append(found[0].real / exact.real - 1.0)
        differences.append(found[0].real / found[1].real - 1.0)
    print(f"damping over the exact one - 1: {errors}; over that with kappa - 1: {differences}")
    assert abs(differences[0]) < 1.1e-3 and abs(errors[0]) < 1.3e-3
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=0.01) and errors[1] / errors[2] == pytest.approx(2.0, rel=0.01)


@pytest.mark.parametrize("options", ["", "volume mass eos tait limit yes", "temp 0.3 4711", "simd none shear mg/fr"])
def test_room_alone_changes_nothing(lammps, options):
    """Without coefficients: bit for bit the fluid of an atom style without room."""
    particles = disordered(2, 12, spread=0.04)
    texts = []
    for words in (None, "1", "3"):
        if words:
            write(particles, lammps.path("box.data"), np.zeros((1, int(words))))
            text = room(2, words)
        else:
            particles.write(lammps.path("box.data"))
            text = header(2)
        lammps(text + "read_data box.data\n" + fluid(2, options) + "fix FLUID all sph/bulk\ntimestep 0.005\n" + dump("out.dump", 10) + "run 50\n")
        texts.append(lammps.path("out.dump").read_text())
    assert texts[0] == texts[1] == texts[2]


def acoustic(log):
    """The largest step of sound in the table."""
    names = re.search(r"largest stable time step:(.*)", log)[1].split()
    return float(re.search(r"^  1-1 .*\|(.*)$", log, re.MULTILINE)[1].split()[names.index("acoustic")])


def largest_step(hs, c0, processes, speed):
    """dt = 0.25 hs/(sqrt(c0^2 + sum g phi1(dt/tau)) + u), rho = 1."""
    step = 0.25 * hs / (c0 + speed)
    for _ in range(200):
        step = np.sqrt(step * 0.25 * hs / (np.sqrt(c0**2 + sum(kr / tau * phi1(step / tau) for kr, tau in processes)) + speed))
    return step


@pytest.mark.parametrize("dim, tau, steps", [(1, 2e4, 10000), (1, 2.0, 10000), (1, 1e-6, 10000), (2, 2.0, 10000)]
                         + [pytest.param(dim, tau, 100000, marks=pytest.mark.long) for dim in (1, 2) for tau in (2e4, 2.0, 1e-6)])
def test_stable_at_the_acoustic_step(lammps, dim, tau, steps):
    """kappa/(rho c0 dx) = 2e4: at the acoustic step that the log has, kinetic energy stays below the first one."""
    particles = disordered(dim, {1: 64, 2: 10}[dim], jitter=0.0, speed=0.02, spread=0.0)
    model = fluid(dim, "shear none", mu=0.0, kappa=0.0, c0=1.0, keywords=f"relax 2e4 {tau}")
    timestep = 0.999 * acoustic(lammps(start(lammps, particles, model, timestep=1e-6) + "run 0\n").log)
    expected = largest_step(np.sqrt(3.5 / {1: 15.0, 2: 14.0}[dim]) * SUPPORT[dim], 1.0, [(2e4, tau)], 0.0)
    print(f"time step {timestep}, {expected} without the speed of the particles, dt/tau {timestep / tau:.3g}")
    assert 0.9 * expected < timestep < expected
    text = start(lammps, particles, model, timestep=timestep)
    table = lammps(text + f"compute E all sph/energy\nthermo_style custom step ke c_E[1] c_E[4]\nthermo {steps // 100}\n" + FULL
                   + f"run {steps}\n", timeout=600).thermo()[0]
    assert not any("exceeds the largest stable" in line for line in lammps.results[-1].warnings)
    energy = table["c_E[1]"]
    print(energy[::20], table["c_E[4]"][::20])
    assert np.isfinite(energy).all() and energy.max() < 1.5 * energy[0]
    assert energy[-20:].mean() < energy[:20].mean()


@pytest.mark.parametrize("tau", [1e-6, 0.1, 10.0])
def test_acoustic_step_of_a_gas_does_not_depend_on_c0(lammps, tau):
    """It is that of a stiffness beside the speed of sound in the gas."""
    T, kr, steps = 2.0, 0.7, []
    particles = disordered(2, 10, jitter=0.0, speed=0.02, spread=0.0)
    for c0 in (0.01, 1.2, 1000.0):
        model = fluid(2, "eos ideal shear none", mu=0.0, kappa=0.0, c0=c0, keywords=f"gamma 1.4 cv 2.5 relax {kr} {tau}")
        steps.append(acoustic(lammps(start(lammps, particles, model, timestep=1e-6, integrator=f"temperature {T}") + "run 0\n").log))
    expected = largest_step(np.sqrt(3.5 / 14.0) * SUPPORT[2], np.sqrt(1.4 * 0.4 * 2.5 * T), [(kr, tau)], 0.0)
    print(steps, expected)
    assert np.ptp(steps) == 0.0 and 0.9 * expected < steps[0] < expected


# ---- force and heat of each particle -----------------------------------------------------------------------------

TYPES = {1: [(30.0, 0.02), (5.0, 0.5)], 2: [(8.0, 0.1)], 3: []}


def three_types(dim, options, pb="", c0=10.0):
    mu = 0.0 if "none" in options else 0.5
    lines = [f"pair_coeff {k} {k} {1.0 + 0.1 * k} {c0} {mu} 2.0 {SUPPORT[dim]} {pb} "
             + ("relax " + " ".join(f"{kr} {tau}" for kr, tau in processes) if processes else "") + "\n" for k, processes in TYPES.items()]
    return f"pair_style sph/bulk dim {dim} {options}\n" + "".join(lines), [line.split(" relax")[0].rstrip() + "\n" for line in lines]


def pairs(frame, lo, hi, R, dim, weight, periodic):
    """c, its rate, and a function of the force of numbers P_i that act as pressures, by sums over all pairs and their images."""
    x, v = frame["x"], frame["v"]
    d = x[:, None] - x[None, :]
    length = np.where(periodic, hi - lo, np.inf)
    d -= np.where(np.isfinite(length), length, 0.0) * np.round(d / length)
    r = np.linalg.norm(d, axis=2)
    near = (r < R) & (r > 0.0)
    W, F, _ = wendland(np.where(near, r, R), R, dim)
    W[~near], F[~near] = 0.0, 0.0
    c = W @ weight + weight * wendland(0.0, R, dim)[0]
    rate = -(F * (d * (v[:, None] - v[None, :])).sum(axis=2)) @ weight

    def force(P):
        g = P / c**2
        bond = weight[:, None] * weight[None, :] * (g[:, None] + g[None, :]) * F
        return (bond[:, :, None] * d).sum(axis=1), 0.5 * (bond * r**2).sum()

    return c, rate, force


@pytest.mark.parametrize("dim, options", [(1, "shear none"), (2, ""), (2, "volume mass eos tait"), (2, "simd none"), (3, "shear mg/fr"),
                                          (2, "eos ideal")])
@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "off")])
def test_force_and_heat_of_each_particle(lammps, dim, options, ranks, newton):
    """Three types with two, one, and no processes: force, work, heat, energy, and stress of given strains, and no force without any."""
    timestep, R = 0.03, SUPPORT[dim]
    particles = disordered(dim, {1: 40, 2: 12, 3: 6}[dim], ntypes=3)
    random = np.random.default_rng(5)
    strain = random.uniform(-0.2, 0.2, (len(particles), 2))
    write(particles, lammps.path("box.data"), strained(strain))
    model, plain = three_types(dim, options)
    text = room(dim, 2, newton=newton) + "read_data box.data\nfix FLUID all sph/bulk\n" + f"timestep {timestep}\n"
    text += "compute P all pressure NULL virial\n"
    for name, lines in (("relax", model), ("plain", f"pair_style sph/bulk dim {dim} {options}\n" + "".join(plain))):
        text += (lines + "compute E all sph/energy\ncompute Q all sph/dissipation\nthermo_style custom step pe c_P vol c_Q c_Q[*] c_E c_E[*]\n" + FULL
                 + dump(name, extra=f"c_Q {columns(2)}") + "run 0 post no\n" + undump() + "thermo_style one\nuncompute Q\nuncompute E\npair_style none\n")
    after, before = [table for table in lammps(text, ranks=ranks).thermo() if "c_Q" in table]
    cold, frame = lammps.frame("plain"), lammps.frame("relax")
    for k, processes in TYPES.items():
        count = len(processes)
        assert count == 0 or np.abs(strain_of(frame, count) - strain[:, :count])[particles.type == k].max() < 1e-14
        assert (relaxed_of(frame, 2)[particles.type == k, count:] == 0.0).all()

    P, energy, power = np.zeros(len(particles)), np.zeros(len(particles)), np.zeros(len(particles))
    for k, processes in TYPES.items():
        one = particles.type == k
        for p, (kr, tau) in enumerate(processes):
            g, factor = kr / ((1.0 + 0.1 * k) * tau), phi1(timestep / tau)
            x = strain[one, p]
            P[one] += frame["rho"][one] * g * factor * x
            energy[one] += particles.mass[one] * g * factor * x**2
            power[one] += particles.mass[one] * g * (factor * x) ** 2 / tau
    if "ideal" in options:  # the energy of the strain is no heat
        P -= 0.4 * frame["rho"] * 0.5 * energy / particles.mass
    weight = particles.mass / (1.0 + 0.1 * particles.type) if "mass" in options else np.ones(len(particles))
    c, rate, force = pairs(frame, particles.lo, particles.hi, R, dim, weight, np.arange(3) < dim)
    assert relative(weight / c - frame["vol"], frame["vol"]) < 1e-12
    expected, virial = force(P)
    assert relative(frame["f"] - cold["f"] - expected, expected) < 1e-11
    work = P * weight / c * rate / c
    assert relative(frame["desph"] - cold["desph"] - work, work) < 1e-11
    assert relative(frame["c_Q"] - cold["c_Q"] - power, power) < 1e-11
    for column in ("c_Q[1]", "c_Q[2]", "c_Q[3]", "c_Q[4]", "c_Q[5]", "c_E[1]", "c_E[2]", "c_E[3]", "c_E"):
        assert after[column][0] == pytest.approx(before[column][0], rel=1e-12, abs=1e-12), column
    assert before["c_Q[6]"][0] == before["c_E[4]"][0] == 0.0
    assert after["c_Q[6]"][0] == pytest.approx(power.sum(), rel=1e-12)
    assert after["c_E[4]"][0] == pytest.approx(0.5 * energy.sum(), rel=1e-12)
    if "ideal" not in options:
        assert after["PotEng"][0] - before["PotEng"][0] == pytest.approx(0.5 * energy.sum(), rel=1e-10)
    directions = max(dim, 2)
    assert (after["c_P"][0] - before["c_P"][0]) * after["Volume"][0] * directions == pytest.approx(virial * 1.0, rel=1e-9)


def test_micropolar(lammps):
    """The same force on particles with spin, and none on the spins."""
    particles = disordered(2, 12, spread=0.0)
    strain = np.random.default_rng(6).uniform(-0.2, 0.2, (len(particles), 1))
    found = {}
    for style in ("sph/bulk", "sph/micropolar"):
        for words in ("", "relax 8.0 0.1"):
            write(particles, lammps.path("box.data"), strained(strain), style)
            if style == "sph/bulk":
                model, fields = fluid(2, keywords=words) + "fix FLUID all sph/bulk\n", dump("f.dump")
            else:
                line, coeff = micro.fluid(2).splitlines()
                model, fields = f"{line}\n{coeff} {words}\n" + micro.integrate(), micro.dump("f.dump")
            lammps(room(2, style=style) + "read_data box.data\n" + model + "timestep 0.005\n" + fields + "run 0\n")
            found[style, words] = lammps.frame("f.dump")
    bulk, spin = (found[style, "relax 8.0 0.1"]["f"] - found[style, ""]["f"] for style in ("sph/bulk", "sph/micropolar"))
    assert relative(bulk - spin, bulk) < 1e-12
    torques = [micro.torque_of(found["sph/micropolar", words]) for words in ("", "relax 8.0 0.1")]
    assert relative(torques[1] - torques[0], torques[0]) < 1e-13


# ---- strain at rest ----------------------------------------------------------------------------------------------

ENERGIES = "compute E all sph/energy\ncompute Q all sph/dissipation\n"


@pytest.mark.parametrize("a", [0.01, 0.1, 1.0, 10.0])
def test_sudden_compression_at_rest(lammps, a):
    """The strain decays by exp(-a) in each step; heat over all steps is m g eps^2 tanh(a/2)/a, which is the energy of the spring as a goes
    to 0, and the internal energy stays."""
    eps, timestep, g = 0.02, 0.005, 6.0
    tau = timestep / a
    particles = lattice(2, 8)
    steps = int(np.ceil(20.0 / a))
    every = max(steps // 20, 1)
    text = start(lammps, particles, fluid(2, keywords=f"relax {g * tau} {tau}"), timestep=timestep)
    text += ("run 0 post no\n" + f"set group all d_rho_relaxed1 {-np.exp(-eps)}\n" + ENERGIES
             + "thermo_style custom step c_E c_E[2] c_E[4] c_Q[6]\nthermo 1\n" + FULL + dump("out.dump", every, columns()) + f"run {steps}\n")
    table = lammps(text).thermo()[-1]
    mass, n = particles.mass.sum(), np.arange(steps + 1)
    x = eps * np.exp(-a * n)
    seen = x > 1e-8
    for frame in lammps.frames("out.dump"):
        assert np.abs(strain_of(frame) - x[frame.step]).max() < 1e-13
        assert np.abs(frame["v"]).max() < 1e-13
    assert table["c_E[4]"][seen] == pytest.approx(0.5 * mass * g * phi1(a) * x[seen] ** 2, rel=1e-6)
    assert table["c_Q[6]"][seen] == pytest.approx(mass * g * phi1(a) ** 2 * x[seen] ** 2 / tau, rel=1e-6)
    heat = timestep * table["c_Q[6]"].sum()
    spring = 0.5 * mass * g * eps**2
    print(f"heat over the energy of the spring: {heat / spring}, {2.0 * np.tanh(a / 2.0) / a}")
    assert heat / spring == pytest.approx(2.0 * np.tanh(a / 2.0) / a, rel=1e-11)
    assert table["c_E[2]"] == pytest.approx(table["c_E[2]"][0], rel=1e-14)


def test_strain_that_is_set_and_read(lammps):
    """The property by its name, with and without d_: 0 and negative numbers become densities with the next forces, positive ones are densities."""
    particles = disordered(2, 8)
    text = start(lammps, particles, fluid(2, keywords="relax 3.0 0.5 1.0 0.1"), count=2)
    text += ("set atom 1 d_rho_relaxed1 1.5\nset atom 2 d_rho_relaxed2 -0.9\nset atom 3 d_rho_relaxed1 0.0\n"
             + dump("out.dump", 1, columns(2)) + "compute R all property/atom d_rho_relaxed1 rho_relaxed2\n"
             "compute S all reduce sum c_R[*]\nthermo_style custom step c_S[*]\n" + FULL + "run 0\n")
    table = lammps(text).thermo()[0]
    frame = lammps.frame("out.dump")
    relaxed, rho = relaxed_of(frame, 2), frame["rho"]
    assert relaxed[0, 0] == 1.5 and relaxed[1, 1] == pytest.approx(0.9 * rho[1], rel=1e-15)
    assert relaxed[2, 0] == rho[2] and (relaxed[3:] == rho[3:, None]).all()
    for k in (0, 1):
        assert table[f"c_S[{k + 1}]"][0] == pytest.approx(relaxed[:, k].sum(), rel=1e-13)


# ---- what is conserved -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("dim, radius, options, integrator", [(2, 7.0, "", ""), (3, 3.5, "", ""), (2, 7.0, "shear mg/fr volume mass", ""),
                                                              (2, 7.0, "", "viscous implicit"), (2, 7.0, "", "viscous rkl2")])
def test_momenta_of_an_isolated_drop(lammps, dim, radius, options, integrator):
    """That rotates, with strain at the start, over 1000 steps: to rounding errors."""
    particles = drop(dim, radius)
    strain = np.random.default_rng(8).uniform(-0.1, 0.1, (len(particles), 1))
    text = start(lammps, particles, fluid(dim, options, keywords="relax 40.0 0.5"), strain, boundary=free(dim), integrator=integrator)
    lammps(text + dump("out.dump", 1000, columns()) + "run 1000\n")
    first, last = lammps.frames("out.dump")
    assert np.abs(last["x"] - first["x"]).max() > 0.05 and np.abs(strain_of(last)).max() > 1e-3
    linear = [frame["mass"][:, None] * frame["v"] for frame in (first, last)]
    spin = [np.cross(frame["x"], p) for frame, p in zip((first, last), linear)]
    drift = [np.abs(p[1].sum(0) - p[0].sum(0)).max() / np.linalg.norm(p[0], axis=1).sum() for p in (linear, spin)]
    print(f"drift: linear {drift[0]:.2e}, angular {drift[1]:.2e}")
    assert max(drift) < 1e-14


@pytest.mark.parametrize("keywords, options", [("relax 20.0 0.5", ""), ("relax 5.0 0.05 20.0 2.0", ""), ("relax 2.0 1e-4", ""),
                                               ("relax 20.0 0.5", "eos ideal")])
def test_energy_and_entropy(lammps, keywords, options):
    """Kinetic and internal energy to second order in the time step, without anything added for the strain; heat is never negative."""
    particles = disordered(2, 12)
    particles.esph *= 20.0 if options else 1.0
    strain = np.random.default_rng(9).uniform(-0.05, 0.05, (len(particles), 2)) if "e-4" not in keywords else 0.0
    errors = []
    for timestep in (0.004, 0.002, 0.001):
        text = start(lammps, particles, fluid(2, options, keywords=keywords), strain, count=2, timestep=timestep)
        table = lammps(text + ENERGIES + "thermo_style custom step c_E c_E[*] c_Q[*] c_Q\nthermo 1\n" + FULL + f"run {round(0.8 / timestep)}\n").thermo()[0]
        errors.append(np.abs(table["c_E"] - table["c_E"][0]).max() / table["c_E[1]"][0])
        assert table["c_Q[6]"].min() >= 0.0 and table["c_Q[6]"].max() > 0.0
        assert table["c_Q"] == pytest.approx(sum(table[f"c_Q[{k}]"] for k in range(1, 7)), rel=1e-12)
        assert table["c_E"] == pytest.approx(table["c_E[1]"] + table["c_E[2]"] + table["c_E[3]"], rel=1e-14)
    print(f"error over the kinetic energy {errors}, ratios {errors[0] / errors[1]:.3f} {errors[1] / errors[2]:.3f}")
    assert errors[-1] < 1e-4
    assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.15)


@pytest.mark.parametrize("integrator", ["viscous rkl2", "viscous implicit", "viscous implicit scheme sdirk2"])
def test_energy_with_large_viscosities(lammps, integrator):
    """To rounding errors, whatever the step."""
    text = start(lammps, disordered(2, 12), fluid(2, mu=20.0, kappa=200.0, keywords="relax 20.0 0.5"), 0.05, timestep=0.01, integrator=integrator)
    table = lammps(text + ENERGIES + "thermo_style custom step c_E c_E[4] c_Q[6]\nthermo 1\n" + FULL + "run 100\n").thermo()[0]
    assert np.abs(table["c_E"] - table["c_E"][0]).max() < 1e-13 * table["c_E"][0]
    assert table["c_Q[6]"].min() > 0.0 and table["c_E[4]"].min() > 0.0


def test_energy_of_a_group(lammps):
    text = start(lammps, disordered(2, 12, ntypes=2), fluid(2, keywords="relax 8.0 0.1"), 0.1)
    text += "group A type 1\ncompute A A sph/energy\ncompute E all sph/energy\nthermo_style custom step c_A[4] c_E[4]\n" + FULL
    table = lammps(text + dump("out.dump", 5, columns()) + "run 5\n", ranks=2).thermo()[0]
    frame = lammps.frame("out.dump")
    energy = 0.5 * frame["mass"] * 80.0 * phi1(0.05) * strain_of(frame)[:, 0] ** 2
    assert table["c_E[4]"][-1] == pytest.approx(energy.sum(), rel=1e-12)
    assert table["c_A[4]"][-1] == pytest.approx(energy[frame["type"] == 1].sum(), rel=1e-12)


# ---- ranks, runs, files ------------------------------------------------------------------------------------------


def case(lammps, options="", extra="", **keywords):
    """Three types with two, one, and no processes, and strain."""
    particles = disordered(2, 12, ntypes=3)
    strain = np.random.default_rng(10).uniform(-0.1, 0.1, (len(particles), 2))
    return start(lammps, particles, three_types(2, options)[0], strain, count=2, extra=extra, **keywords)


def same(one, other, bound=1e-12):
    for key in ("x", "v", "f", "esph", "d_rho_relaxed1", "d_rho_relaxed2"):
        assert relative(one[key] - other[key], one[key]) < bound, key


@pytest.mark.parametrize("ranks, newton", [(2, "on"), (4, "off"), (4, "on")])
def test_same_on_any_number_of_ranks(lammps, ranks, newton):
    """Particles move over to other ranks."""
    frames = []
    for n, setting in ((1, "on"), (ranks, newton)):
        lammps(case(lammps, newton=setting, extra="velocity all set 5.0 3.0 NULL sum yes\n") + dump("out.dump", 200, columns(2)) + "run 200\n", ranks=n)
        frames.append(lammps.frame("out.dump"))
    same(*frames, bound=1e-11)


@pytest.mark.parametrize("commands", ["run 20\nrun 1\nrun 0\nrun 29\n", "run 50 pre no every 7 NULL\n", "run 25\nrun 25 pre no\n"])
def test_several_runs_are_one(lammps, commands):
    lammps(case(lammps) + "run 50\n" + dump("one.dump", 1, columns(2)) + "run 0\n")
    lammps(case(lammps) + commands + dump("parts.dump", 1, columns(2)) + "run 0\n")
    same(lammps.frame("one.dump"), lammps.frame("parts.dump"), 1e-13)


@pytest.mark.parametrize("before, after", [(1, 1), (2, 2), (2, 1)])
def test_restart_in_the_middle(lammps, before, after):
    """The state is that of the file bit for bit."""
    lammps(case(lammps) + "run 30\nwrite_restart state.restart\n" + dump("whole.dump", 30, columns(2)) + "run 30\n", ranks=before)
    lammps("read_restart state.restart\nfix FLUID all sph/bulk\ntimestep 0.005\n" + dump("parts.dump", 30, columns(2)) + "run 30\n", ranks=after)
    whole, parts = lammps.frames("whole.dump"), lammps.frames("parts.dump")
    assert (relaxed_of(whole[0], 2) == relaxed_of(parts[0], 2)).all()
    same(whole[1], parts[1], 1e-12)
    if before == after == 1:
        assert all((whole[1][key] == parts[1][key]).all() for key in ("x", "v", "f", "d_rho_relaxed1"))


@pytest.mark.parametrize("pairs_of", ["ii", "ij"])
def test_data_file_out_and_in(lammps, pairs_of):
    lammps(case(lammps) + f"run 20\nwrite_data out.data pair {pairs_of}\n" + dump("before.dump", 1, columns(2)) + "run 0\n")
    text = lammps.path("out.data").read_text()
    assert text.count(" relax 30") == 1
    atoms = text.split("Atoms")[1].split("\n\n")[1].splitlines()
    assert {len(line.split()) for line in atoms} == {12}    # with image flags
    lammps(room(2, 2) + "pair_style sph/bulk\nread_data out.data\nfix FLUID all sph/bulk\ntimestep 0.005\n" + dump("after.dump", 1, columns(2)) + "run 0\n")
    before, after = lammps.frame("before.dump"), lammps.frame("after.dump")
    for k in (1, 2):
        np.testing.assert_array_equal(after[f"d_rho_relaxed{k}"], as_written(before[f"d_rho_relaxed{k}"]))
    lammps(case(lammps) + "run 20\nvelocity all scale 0.3\n" + dump("scaled.dump", 1, columns(2)) + "write_data scaled.data pair ii\nrun 0\n")
    lammps(room(2, 2) + "pair_style sph/bulk\nread_data scaled.data\nfix FLUID all sph/bulk\ntimestep 0.005\n" + dump("again.dump", 1, columns(2)) + "run 0\n")
    same(lammps.frame("scaled.dump"), lammps.frame("again.dump"), 1e-13)


@pytest.mark.parametrize("ranks", [1, 2])
def test_files_of_particles_with_spin(lammps, ranks):
    """Restart and data file."""
    particles = disordered(2, 12, spread=0.0)
    write(particles, lammps.path("box.data"), strained(np.random.default_rng(1).uniform(-0.1, 0.1, (len(particles), 2))), "sph/micropolar")
    style, coeff = micro.fluid(2).splitlines()
    coeff += " relax 8 0.1 3 0.4\n"
    fields = lambda name, every: micro.dump(name, every, columns(2))
    lammps(room(2, 2, style="sph/micropolar") + f"read_data box.data\n{style}\n{coeff}" + micro.integrate()
           + "run 20\nwrite_restart state.restart\nwrite_data state.data\n" + fields("whole.dump", 20) + "run 20\n", ranks=ranks)
    lammps("read_restart state.restart\n" + micro.integrate() + fields("parts.dump", 20) + "run 20\n", ranks=ranks)
    lammps(room(2, 2, style="sph/micropolar") + f"{style}\nread_data state.data\n{coeff}" + micro.integrate() + fields("data.dump", 1) + "run 0\n")
    first, last = lammps.frames("whole.dump")
    for one, other in ((last, lammps.frame("parts.dump")), (first, lammps.frame("data.dump"))):
        for key in ("x", "v", "omegaz", "d_rho_relaxed1", "d_rho_relaxed2"):
            assert relative(one[key] - other[key], one[key]) < 1e-13, key


def test_replicated(lammps):
    """Copies have the strain of their particle."""
    lammps(case(lammps) + "run 5\nreplicate 2 1 1\n" + dump("out.dump", 1, columns(2)) + "run 0\n")
    frame = lammps.frame("out.dump")
    half = len(frame["id"]) // 2
    assert (relaxed_of(frame, 2)[:half] == relaxed_of(frame, 2)[half:]).all()
    assert np.abs(strain_of(frame, 2)[frame["type"] == 1]).max() > 1e-3


def test_particles_that_are_made_have_no_strain(lammps):
    """And those that are there keep their relaxed density."""
    text = case(lammps) + "run 20\n" + dump("before.dump", 1, columns(2)) + "run 0\n" + undump()
    text += ("create_atoms 1 single 4.3 4.4 0.0\nset atom 145 mass 1.0\n" + dump("after.dump", 1, columns(2)) + "run 0\nrun 1\n")
    lammps(text)
    before, after = lammps.frame("before.dump"), lammps.frames("after.dump")
    assert (relaxed_of(after[0], 2)[-1] == after[0]["rho"][-1]).all()
    assert (relaxed_of(after[0], 2)[:-1] == relaxed_of(before, 2)).all()
    assert np.isfinite(after[-1]["x"]).all()


@pytest.mark.parametrize("ranks", [1, 2])
def test_masses_for_rho0_leave_the_strain(lammps, ranks):
    """Also of particles that have relaxed densities by then."""
    text = case(lammps) + "run 10\n" + dump("before.dump", 1, columns(2)) + "run 0\n" + undump()
    text += "unfix FLUID\nfix FLUID all sph/bulk density rho0\n" + dump("after.dump", 1, columns(2)) + "run 0\n"
    lammps(text, ranks=ranks)
    before, after = lammps.frame("before.dump"), lammps.frame("after.dump")
    assert relative(before["mass"] - after["mass"], before["mass"]) > 0.01
    assert np.abs(strain_of(before, 2) - strain_of(after, 2)).max() < 1e-13


@pytest.mark.parametrize("count", [4, 8])
def test_data_file_of_many_processes(lammps, count):
    """As many as there may be; 0 in a data file: no strain."""
    relax = "relax" + "".join(f" {k + 1} {0.1 * (k + 1)}" for k in range(count))
    particles = disordered(2, 12)
    state = np.zeros((len(particles), count))
    state[:, 1:] = strained(np.linspace(-0.1, 0.1, count - 1))
    write(particles, lammps.path("box.data"), state)
    text = room(2, count) + "read_data {}\n" + fluid(2, keywords=relax) + "fix FLUID all sph/bulk\ntimestep 0.005\n"
    lammps(text.format("box.data") + dump("out.dump", 1, columns(count)) + "run 0\nwrite_data out.data nocoeff\n")
    frame = lammps.frame("out.dump")
    np.testing.assert_allclose(strain_of(frame, count), np.broadcast_to([0.0, *np.linspace(-0.1, 0.1, count - 1)], state.shape), atol=1e-14)
    lammps(text.format("out.data") + dump("again.dump", 1, columns(count)) + "run 0\n", ranks=2)
    np.testing.assert_array_equal(relaxed_of(lammps.frame("again.dump"), count), as_written(relaxed_of(frame, count)))


# ---- other commands ----------------------------------------------------------------------------------------------


def test_change_of_the_time_step(lammps):
    """Between runs, with tau far below it: the wave goes on as with a constant kappa, within the error of the time step."""
    kappa, tau = 0.02 * 64.0, 1e-3
    wave = Wave(lammps, "line", 64, 5.0, 1.0)
    state = modes(one_step(wave.q, wave.square, [(kappa / tau, tau)], 0.2), 0.2)[0][1]
    found = []
    for processes, constant in (([(kappa / tau, tau)], 0.0), ([], kappa)):
        start_of = state if processes else state[:3]
        u, _ = wave.run(start_of, processes, 0.2, 0, 300, kappa=constant,
                        commands="run 300\ntimestep 0.02\nrun 300\ntimestep 0.2\nrun 300\ntimestep 0.002\nrun 300\ntimestep 0.2\nrun 300\n")
        found.append(u)
    print(found)
    assert np.abs(found[0] - found[1]).max() < 0.01 * np.abs(found[1][0])


def test_processes_that_come_and_go(lammps):
    """Keywords add up, a new command has its own processes only, and a process that comes again has no strain."""
    model = fluid(2, keywords="relax 8.0 0.1 relax 3.0 10.0")
    alone = fluid(2, keywords="relax 8.0 0.1").splitlines()[1] + "\n"
    text = start(lammps, disordered(2, 12), model, 0.05, count=2)
    text += "run 10\n" + dump("both.dump", 1, columns(2)) + "run 0\n" + undump() + alone + "run 20\n" + dump("one.dump", 1, columns(2)) + "run 0\n"
    text += undump() + model.splitlines()[1] + "\n" + dump("again.dump", 1, columns(2)) + "run 0\n"
    lammps(text)
    both, one, again = (lammps.frame(f"{name}.dump") for name in ("both", "one", "again"))
    assert np.abs(strain_of(both, 2)).min(axis=0).max() > 0.0
    assert (relaxed_of(one, 2)[:, 1] == 0.0).all() and (strain_of(again, 2)[:, 1] == 0.0).all()
    assert (relaxed_of(one, 2)[:, 0] == relaxed_of(again, 2)[:, 0]).all()


def test_warning_of_a_short_relaxation_time(lammps):
    """Below a thousandth of the time step, of any process; once."""
    particles = lattice(2, 8)
    for tau, warned in ((4.9e-6, 1), (5.1e-6, 0)):
        text = start(lammps, particles, fluid(2, keywords=f"relax 1.0 0.1 0.5 {tau}"), count=2)
        warnings = [line for line in lammps(text + "run 1\nrun 1\n").warnings if "of relax of type 1 is far below" in line]
        assert len(warnings) == warned and all("a kappa that is larger by its kappa_r does the same" in line for line in warnings)


@pytest.mark.parametrize("fixes", ["fix FLUID one sph/bulk\nfix OTHER two sph/bulk\n", "fix FLUID one sph/bulk\n",
                                   "fix FLUID one sph/bulk\nfix M two move linear 0 0 0\n"])
def test_strain_of_all_particles_decays_once_in_a_step(lammps, fixes):
    """Of two integrators, and of particles that stay where they are or that another fix moves."""
    text = start(lammps, lattice(2, 8), fluid(2, keywords="relax 0.1 0.05"), 0.01)
    text = text.replace("fix FLUID all sph/bulk \n", "group one id <> 1 32\ngroup two subtract all one\n" + fixes)
    lammps(text + dump("out.dump", 10, columns()) + "run 10\n")
    frame = lammps.frame("out.dump")
    assert np.abs(strain_of(frame) - 0.01 * np.exp(-1.0)).max() < 1e-6


def test_adapt(lammps):
    """Coefficients of each process, in mid-run."""
    frames = []
    particles = disordered(2, 12)
    first = "relax 1.0 0.3 2.0 0.4"
    wanted = "relax 3.0 0.2 5.0 0.7"
    change = "".join(f"variable {name} equal {value}\n" for name, value in (("a", 3.0), ("b", 0.2), ("c", 5.0), ("d", 0.7)))
    change += ("fix A all adapt 1 pair sph/bulk kappa_r * * v_a pair sph/bulk tau * * v_b pair sph/bulk kappa_r2 * * v_c "
               "pair sph/bulk tau2 * * v_d\n")
    for words, adapt in ((wanted, ""), (first, change)):
        lammps(start(lammps, particles, fluid(2, keywords=words), 0.05, count=2) + adapt + dump("out.dump", 10, columns(2)) + "run 10\n", ranks=2)
        frames.append(lammps.frame("out.dump"))
    same(*frames)
    for name in ("kappa_r", "tau"):
        bad = f"variable b equal 0.4-0.1*step\nfix A all adapt 1 pair sph/bulk {name} * * v_b\n"
        result = lammps(start(lammps, particles, fluid(2, keywords=first), count=2) + bad + "run 10\n", check=False)
        assert result.code and re.search(r"relax.*> 0", result.error), result.error
    none = "variable b equal 0.4\nfix A all adapt 1 pair sph/bulk kappa_r2 * * v_b\n"
    assert lammps(start(lammps, particles, fluid(2, keywords="relax 1.0 0.3"), count=2) + none + "run 1\n", check=False).code


def test_time_step_of_fix_dt(lammps):
    """0.25 h_s/(sqrt(c0^2 + sum g phi1) + u), the same as in the table."""
    particles = lattice(2, 10)
    particles.v[:, 0] = 0.5
    text = start(lammps, particles, fluid(2, mu=0.0, kappa=0.0, keywords="relax 40.0 0.05 10.0 0.005"), count=2, timestep=0.01, integrator="density rho0")
    result = lammps(text + "fix D all sph/dt 1\nthermo_style custom step dt\nthermo 1\n" + FULL + "run 3\n")
    expected = largest_step(0.5 * SUPPORT[2], 10.0, [(40.0, 0.05), (10.0, 0.005)], 0.5)
    assert acoustic(result.log) == pytest.approx(expected, rel=5e-4)
    assert result.thermo()[0]["Dt"] == pytest.approx(expected, rel=1e-9)


def test_hybrid_styles(lammps):
    """Together with another pair style, and another atom style."""
    particles = disordered(2, 12)
    particles.charge = np.linspace(-1.0, 1.0, len(particles))
    frames = {}
    for name in ("alone", "pair", "atom"):
        words = "relax 8.0 0.1"
        if name == "atom":
            text = start(lammps, particles, fluid(2, keywords=words), 0.05)
            particles.write(lammps.path("box.data"), style="hybrid sph/bulk charge")
            lines = lammps.path("box.data").read_text().splitlines()
            for n in range(lines.index("Atoms # hybrid sph/bulk charge") + 2, lines.index("Velocities") - 1):
                *most, charge = lines[n].split()
                lines[n] = " ".join([*most, repr(float(strained(0.05))), charge])
            lammps.path("box.data").write_text("\n".join(lines) + "\n")
            text = text.replace("atom_style sph/bulk relax 1", "atom_style hybrid sph/bulk relax 1 charge")
        elif name == "pair":
            model = f"pair_style hybrid/overlay sph/bulk zero 2.0\npair_coeff * * sph/bulk 1.0 10.0 0.5 2.0 3.0 {words}\npair_coeff * * zero\n"
            text = start(lammps, particles, model, 0.05)
        else:
            text = start(lammps, particles, fluid(2, keywords=words), 0.05)
        lammps(text + dump("out.dump", 20, columns()) + "run 20\n", ranks=2)
        frames[name] = lammps.frame("out.dump")
    for name in ("pair", "atom"):
        for key in ("x", "f", "d_rho_relaxed1"):
            assert relative(frames[name][key] - frames["alone"][key], frames["alone"][key]) < 1e-12, (name, key)


def test_rerun_has_no_strain_and_says_so(lammps):
    particles = disordered(2, 12)
    text = start(lammps, particles, fluid(2, keywords="relax 8.0 0.1"), 0.05)
    lammps(text + "dump T all custom 10 run.dump id x y vx vy\ndump_modify T sort id format float %.17g\nrun 20\n")
    found = []
    for words in ("", "relax 8.0 0.1"):
        text = start(lammps, particles, fluid(2, keywords=words), 0.05)
        found.append((lammps(text + dump("again.dump", 10) + "rerun run.dump dump x y vx vy\n"), lammps.frames("again.dump")))
    for plain, again in zip(found[0][1], found[1][1]):
        assert relative(again["f"] - plain["f"], plain["f"]) < 1e-13
    assert [sum("rerun" in line and "strain" in line for line in result.warnings) for result, _ in found] == [0, 1]


def test_minimization_has_no_strain(lammps):
    particles = disordered(2, 12)
    found = []
    for words in ("", "relax 50.0 0.1"):
        lammps(start(lammps, particles, fluid(2, keywords=words), 0.05) + dump("f", 1, columns()) + "minimize 0 0 5 5\n")
        found.append(lammps.frame("f"))
    assert relative(found[1]["f"] - found[0]["f"], found[0]["f"]) < 1e-12
    lammps(start(lammps, particles, fluid(2, keywords="relax 50.0 0.1"), 0.05) + "minimize 0 0 5 5\n" + dump("f", 1, columns()) + "run 0\n")
    assert np.abs(strain_of(lammps.frame("f"))).max() < 1e-14


def test_body_force(lammps):
    """A uniform fluid falls without strain."""
    text = start(lammps, lattice(2, 8), fluid(2, keywords="relax 50.0 0.1"), extra="fix G all gravity 2.0 vector 0 -1 0\n")
    lammps(text + dump("out.dump", 100, columns()) + "run 100\n")
    frame = lammps.frame("out.dump")
    assert np.abs(strain_of(frame)).max() < 1e-13
    np.testing.assert_allclose(frame["v"][:, 1], -2.0 * 100 * 0.005, rtol=1e-11)


@pytest.mark.parametrize("ranks", [1, 2])
def test_still_fluid_between_walls(lammps, ranks):
    """Under its weight: it comes to the same rest with and without relaxation, and the walls carry it."""
    found = {}
    for words in ("", "relax 5.0 0.2"):
        particles = lattice(2, (8, 16))
        particles.x[:, 1] -= 3.0
        particles.lo[1], particles.hi[1] = -4.0, 14.0
        extra = "region FLUID block INF INF 0 10 INF INF units box\ngroup fluid region FLUID\ngroup wall subtract all fluid\n"
        text = start(lammps, particles, fluid(2, mu=2.0, kappa=6.0, keywords="pb 20 " + words), boundary="p f p", extra=extra, timestep=0.02)
        text = text.replace("fix FLUID all", "fix FLUID fluid")
        text += ("fix W wall sph/wall\nfix G fluid gravity 0.05 vector 0 -1 0\nthermo_style custom step ke f_W[2]\nthermo 500\n" + FULL
                 + dump("out.dump", 4000, columns()) + "run 4000\n")
        table = lammps(text, ranks=ranks).thermo()[-1]
        frame = lammps.frame("out.dump")
        wet = (frame["y"] > 0.0) & (frame["y"] < 10.0)
        found[words] = frame["rho"][wet]
        print(table["f_W[2]"][-1], 0.05 * wet.sum(), table["KinEng"])
        assert abs(table["f_W[2]"][-1]) == pytest.approx(0.05 * wet.sum(), rel=1e-3)
    assert np.abs(strain_of(frame)[wet]).max() < 1e-6
    assert relative(found[""] - found["relax 5.0 0.2"], 1.0) < 1e-6


@pytest.mark.parametrize("integrator", ["viscous rkl2", "viscous implicit tolerance 1e-12"])
def test_wave_with_large_viscosities(lammps, integrator):
    """The friction of a constant kappa by such a step, relaxation as before: within the error of the time step."""
    wave = Wave(lammps, "line", 64, 5.0, 1.0)
    processes = [(0.5, 1.0 / wave.k)]
    found = []
    for timestep in (0.2, 0.1):
        root, state = modes(one_step(wave.q, wave.square, processes, timestep, nu=0.5), timestep)[0]
        every = round(3.0 / timestep)
        u, _ = wave.run(state, processes, timestep, 40 * every, every, kappa=0.5, integrator=integrator)
        exact = modes(one_step(wave.q, wave.square, processes, 1e-3, nu=0.5), 1e-3)[0][0]
        found.append(abs(fitted(u[2:], every * timestep) - exact) / abs(exact))
    print(found)
    assert found[0] < 1e-4 and found[0] / found[1] == pytest.approx(4.0, rel=0.2)


# ---- bad input ---------------------------------------------------------------------------------------------------

GOOD = "pair_coeff * * 1.0 10.0 0.5 2.0 3.0 relax"
NOT_POSITIVE = "Pair_coeff relax must have kappa_r > 0 and tau > 0, not "
ODD = "Pair_coeff relax needs groups of 2 numbers, of which 1 are left"
MISSING = "Illegal pair_coeff relax command: missing argument"


@pytest.mark.parametrize("line, message", [
    (f"{GOOD} 0.0 0.1", NOT_POSITIVE + "0.0 0.1"), (f"{GOOD} -2.0 0.1", NOT_POSITIVE + "-2.0 0.1"), (f"{GOOD} 2.0 0.0", NOT_POSITIVE + "2.0 0.0"),
    (f"{GOOD} 2.0 -1.0", NOT_POSITIVE + "2.0 -1.0"), (f"{GOOD} 2.0 0.1 3.0 0.0", NOT_POSITIVE + "2.0 0.1 3.0 0.0"), (f"{GOOD}", MISSING),
    (f"{GOOD} 2.0", ODD), (f"{GOOD} 2.0 0.1 3.0", ODD), (f"{GOOD} 2.0 pb 1.0", ODD), (GOOD + 9 * " 2.0 0.1", "relax has more than 8 groups of numbers"),
    (f"{GOOD} 1 1 1 1 1 1 1 1 relax 1 1 1 1 1 1 1 1 1 1", "relax has more than 8 groups of numbers"), (f"{GOOD} nan 0.1", "relax|nan"), (f"{GOOD} 1e999 0.1", "1e999.*out of range"),
    (f"{GOOD} 2.0 0.1 x", "Unknown pair_coeff keyword for pair_style sph/bulk: x"),
    (f"{GOOD} 1 1 2 2 3 3", "the states of relax of type 1 are 3, but particles have room for 2; use atom_style sph/bulk relax 3"),
    ("pair_coeff 1 2 relax 2.0 0.1", "Pair_coeff keyword relax belongs to a type, not to a pair of types"),
])
def test_bad_coefficients(lammps, line, message):
    write(disordered(2, 6, ntypes=2), lammps.path("box.data"), np.zeros((1, 2)))
    text = room(2, 2) + "read_data box.data\npair_style sph/bulk\n" + line + "\nfix 1 all sph/bulk\nrun 0\n"
    for ranks in (1, 2) if "room" in message or "not 0.0" in message else (1,):
        result = lammps(text, ranks=ranks, check=False)
        assert result.code and re.search(message, result.error), result.error


def test_no_room(lammps):
    """For any process, or for all of them; and a data file without their state."""
    particles = disordered(2, 6)
    particles.write(lammps.path("box.data"))
    result = lammps(header(2) + f"read_data box.data\npair_style sph/bulk\n{GOOD} 2.0 0.1\nfix 1 all sph/bulk\nrun 0\n", check=False)
    assert result.code and "the states of relax of type 1 are 1, but particles have room for 0; use atom_style sph/bulk relax 1" in result.error
    result = lammps(room(2) + "read_data box.data\n", check=False)
    assert result.code and "Incorrect format in Atoms section of data file" in result.error


@pytest.mark.parametrize("words, message", [("relax 0", "relax must be 1 to 8, not 0"), ("relax -1", "relax must be 1 to 8, not -1"),
                                            ("relax 9", "relax must be 1 to 8, not 9"), ("relax", "missing argument"),
                                            ("relax 1.5", "Expected integer parameter instead of '1.5'"), ("relaxes 1", "keyword: relaxes"),
                                            ("relax 1 1", "relax|keyword")])
@pytest.mark.parametrize("style", ["sph/bulk", "sph/micropolar"])
def test_bad_atom_style(lammps, style, words, message):
    result = lammps(f"units lj\ndimension 2\natom_style {style} {words}\n", check=False)
    assert result.code and re.search(message, result.error), result.error


def test_pressure_of_strains_in_the_report(lammps):
    """The mean pressure of the log has that of the strains; their energy is no heat, which has a pressure of its own."""
    particles = disordered(2, 12, spread=0.0, speed=0.0, jitter=0.05)
    rows = []
    for strain, heat in ((0.5, 5.0), (0.0, 5.0 - 0.5 * 3.0 * 0.5**2)):    # g = 30/10
        particles.esph[:] = heat
        log = lammps(start(lammps, particles, fluid(2, keywords="relax 30 10 cv 2.0 gruneisen 0.4 1"), strain) + "run 0\n").log
        rows.append([float(word) for word in re.search(r"^  1 +\d+ +\d+ +\| (\S+) .*\| (\S+)$", log, re.MULTILINE).groups()])
    (density, pressure), (_, without) = rows
    assert pressure - without == pytest.approx(3.0 * 0.5 * density, rel=2e-3)
