"""Temperature and conduction of heat: equations of state with thermal pressure, temperature waves, sound, two materials."""

import re

import numpy as np
import pytest

from helpers import INTEGRATE, SUPPORT, disordered, dump, fluid, header, lattice, relative, undump
from sph_dissipation import exponents

TEMPERATURE = "compute T all property/atom tsph\n"
FULL = "thermo_modify norm no format float %.17g\n"


# ---------------------------------------------------------------------------------------------
# written anew from the equations: kernel, sums over a lattice, all pairs of a set of particles


def kernel(r, R, dim):
    """W and F = -W'/r of Wendland C2."""
    q = np.minimum(r / R, 1.0)
    norm = {1: 3 / 2, 2: 7 / np.pi, 3: 21 / (2 * np.pi)}[dim] / R**dim
    return norm * (1 - q) ** 4 * (1 + 4 * q), norm / R**2 * 20 * (1 - q) ** 3


class Line:
    """Sums over a line of particles with the distance 1/N, for waves of the number k: q, q2, K as in the equations of motion

        rho xi'' = -i q p' + 2 P0 (q^2 - q2^2) xi,   rho'/rho = -i q xi,   rho cv T' = ... - k K T
    """

    def __init__(self, N, R, waves=1):
        s = np.arange(1, int(R) + 1) / N
        k, self.R = 2 * np.pi * waves, R / N
        W, F = kernel(s, self.R, 1)
        u = s / self.R
        d2W = 1.5 / self.R * -20 * (1 - u) ** 2 * (1 - 4 * u) / self.R**2
        c = kernel(0.0, self.R, 1)[0] + 2 * W.sum()
        self.c = c
        self.q = 2 / c * (F * s * np.sin(k * s)).sum()
        self.q2sq = 2 / c * (d2W * (1 - np.cos(k * s))).sum()
        self.K = 4 / c * (F * (1 - np.cos(k * s))).sum()

    def sound(self, p_rho, p_T, gruneisen, T, P0, kappa, conductivity, cv, rho=1.0):
        """Growth rates of (xi, u, T) in a fluid with these derivatives of the pressure at constant temperature and density."""
        q = self.q
        matrix = np.array([[0, 1, 0],
                           [-q * q * p_rho + 2 * P0 / rho * (q * q - self.q2sq), -q * q * kappa / rho, -1j * q * p_T / rho],
                           [0, -1j * q * gruneisen * T, -conductivity * self.K / (rho * cv)]])
        return np.linalg.eigvals(matrix)


def line(N, length=1.0):
    particles = lattice(1, N, length / N)
    particles.mass[:] = length / N
    particles.x[:, 0] -= 0.5 * length / N
    return particles


def elastic(eos, fluid, rho):
    """Pressure and energy per mass without heat."""
    rho0, pb, x = fluid["rho0"], fluid["pb"], rho / fluid["rho0"]
    G, heat = fluid["gruneisen"], fluid["cv"] * fluid["T0"]
    if eos == "ideal":
        p, e = 0.0 * rho, 0.0 * rho
    else:
        cc = fluid["c0"] ** 2 - G * (G + 1) * heat
        pb = pb - G * rho0 * heat
        if eos == "linear":
            p, e = cc * (rho - rho0), cc * (np.log(x) + 1 / x - 1)
        else:
            b = rho0 * cc / 7
            p, e = b * (x**7 - 1), b / rho0 * ((x**6 - 1) / 6 + 1 / x - 1)
    return p + pb, e + pb * (1 / rho0 - 1 / rho)


def dense(particles, fluids, eos, volume="number", strain=0.0, dt=0.005):
    """Forces, heating, temperatures of particles in a periodic box, with the shear form morris and the bulk form density."""
    dim, n = particles.dim, len(particles)
    R = SUPPORT[dim]
    of = {key: np.array([fluids[t - 1][key] for t in particles.type]) for key in fluids[0]}
    r = particles.x[:, None] - particles.x[None]
    length = (particles.hi - particles.lo)[:dim]
    r[..., :dim] -= length * np.round(r[..., :dim] / length)
    u = particles.v[:, None] - particles.v[None]
    W, F = kernel(np.linalg.norm(r, axis=2), R, dim)
    w = particles.mass / of["rho0"] if volume == "mass" else np.ones(n)
    c = W @ w
    V = w / c
    rho = particles.mass / V
    rate = -(F * np.einsum("ijk,ijk->ij", r, u)) @ w / c

    p, e_el = np.empty(n), np.empty(n)
    for k, one in enumerate(fluids, 1):
        own = particles.type == k
        p[own], e_el[own] = elastic(eos, one, rho[own])
    G = np.where(eos == "ideal", 0.4, of["gruneisen"])
    a = dt / of["tau"]
    stiffness = of["kappa_r"] / (of["rho0"] * of["tau"]) * (1 - np.exp(-a)) / a
    q = particles.esph / particles.mass - e_el - stiffness * strain**2 / 2
    p = p + G * rho * q + rho * stiffness * strain
    T = q / of["cv"]

    mean = lambda key: 2 * of[key][:, None] * of[key] / (of[key][:, None] + of[key] + 1e-300)
    FVV = F * V[:, None] * V
    np.fill_diagonal(FVV, 0.0)
    zeta = of["kappa"] - (2 / dim - 1) * of["mu"]
    g = (p + zeta * rate) / c**2
    f = np.einsum("ij,ijk->ik", w[:, None] * w * (g[:, None] + g) * F, r) - np.einsum("ij,ijk->ik", 2 * mean("mu") * FVV, u)
    flow = 2 * mean("k") * FVV * (T[None] - T[:, None])
    heat = p * V * rate + zeta * V * rate**2 + (mean("mu") * FVV * (u**2).sum(2)).sum(1) + flow.sum(1)
    return f, heat, T, flow


def of_type(eos, one, R):
    """Words of pair_coeff I I."""
    words = f"{one['rho0']} {one['c0']} {one['mu']} {one['kappa']} {R} pb {one['pb']} cv {one['cv']}"
    if one["k"] > 0.0:
        words += f" conductivity {one['k']}"
    if one["gruneisen"] > 0.0 and eos != "ideal":
        words += f" gruneisen {one['gruneisen']} {one['T0']}"
    if one["kappa_r"] > 0.0:
        words += f" relax {one['kappa_r']} {one['tau']}"
    return words


def model(eos, fluids, dim, options=""):
    return fluid(dim, f"eos {eos} shear morris bulk density {options}",
                 coeff="".join(f"pair_coeff {k} {k} {of_type(eos, one, SUPPORT[dim])}\n" for k, one in enumerate(fluids, 1)))


FLUIDS = [dict(rho0=1.0, c0=10.0, mu=0.5, kappa=2.0, pb=1.5, cv=2.0, k=0.7, gruneisen=0.6, T0=3.0, kappa_r=0.0, tau=1.0),
          dict(rho0=1.1, c0=9.0, mu=0.8, kappa=1.0, pb=2.0, cv=1.2, k=2.3, gruneisen=0.3, T0=2.0, kappa_r=0.9, tau=0.02)]


def write(lammps, particles, strain=None):
    """Data file; with room for a relaxing process, whose strain is that number."""
    path = lammps.path("box.data")
    particles.write(path)
    if strain is None:
        return
    head, lines, rest = re.split("(?<=Atoms # sph/bulk\n\n)|(?=\nVelocities)", path.read_text())
    lines = [line.split() for line in lines.splitlines()]
    path.write_text(head + "".join(" ".join([*words[:4], repr(float(-np.exp(-strain))), *words[4:]]) + "\n" for words in lines) + rest)


@pytest.mark.parametrize("newton, ranks", [("on", 1), ("on", 4), ("off", 2)])
@pytest.mark.parametrize("eos, dim, volume", [("linear", 2, "number"), ("tait", 2, "mass"), ("ideal", 2, "number"), ("tait", 3, "number")])
def test_dense_reference(lammps, eos, dim, volume, newton, ranks):
    """Forces, heating and temperatures of two fluids with thermal pressure, relaxing strain, viscosities, and conduction."""
    if ranks > 1 and eos == "linear":
        pytest.skip("ranks are covered by the other equations of state")
    strain = 0.02
    particles = disordered(dim, {2: 12, 3: 6}[dim], ntypes=2)
    write(lammps, particles, strain)
    text = (header(dim, newton, style="sph/bulk relax 1") + "read_data box.data\n" + model(eos, FLUIDS, dim, f"volume {volume}") + INTEGRATE)
    lammps(text + TEMPERATURE + dump("f.dump", extra="c_T") + "run 0\n", ranks=ranks)
    frame = lammps.frame("f.dump")
    f, heat, T, flow = dense(particles, FLUIDS, eos, volume, np.where(particles.type == 2, strain, 0.0))
    assert relative(frame["c_T"] - T, T) < 1e-11
    assert relative(frame["f"] - f, f) < 1e-11
    assert relative(frame["desph"] - heat, heat) < 1e-11
    assert np.abs(flow.sum(1)).max() > 0.05 * np.abs(heat).max(), "conduction counts here"


# ---------------------------------------------------------------------------------------------
# conduction


AT_REST = dict(rho0=1.0, c0=10.0, mu=0.0, kappa=0.0, pb=0.0, cv=2.5, k=0.0, gruneisen=0.0, T0=0.0, kappa_r=0.0, tau=1.0)


def hot_line(lammps, N, R, cv, k, timestep, run, extra="", keywords="", length=1.0):
    line(N, length).write(lammps.path("box.data"))
    return lammps(header(1) + "read_data box.data\npair_style sph/bulk dim 1 shear none\n"
                  f"pair_coeff * * 1.0 1.0 0.0 0.0 {R * length / N} cv {cv} conductivity {k} {keywords}\n"
                  f"variable T atom 1.0+0.1*cos(2*PI*x/{length})\nfix FLUID all sph/bulk temperature v_T\ntimestep {timestep}\n"
                  + TEMPERATURE + extra + dump("T.dump", run or 1, "c_T") + f"run {run}\n")


def test_temperature_wave(lammps):
    """On a line the rate is k/(rho cv) times the sum over the neighbors; the mean temperature stays."""
    N, R, cv, k, dt, steps = 32, 5.0, 2.0, 0.04, 1e-3, 500
    hot_line(lammps, N, R, cv, k, dt, steps)
    first, last = lammps.frames("T.dump")
    sums = Line(N, R)
    wave = np.cos(2 * np.pi * first["x"][:, 0])
    start, end = (2 / N * (frame["c_T"] * wave).sum() for frame in (first, last))
    rho = sums.c / N
    rate = k / (rho * cv) * sums.K
    assert np.abs(first["c_T"] - 1.0 - 0.1 * wave).max() < 1e-14
    assert relative(first["desph"] / (cv / N) + rate * 0.1 * wave, first["desph"] / (cv / N)) < 1e-11

    assert np.log(start / end) / (steps * dt) == pytest.approx(rate, rel=1e-6)
    assert last["c_T"].mean() == pytest.approx(1.0, abs=1e-13)
    continuum = k / cv * (2 * np.pi) ** 2
    assert 0.96 < rate / continuum < 1.0


LATTICES = {  # vectors of the cell, particles in it, factor of the conductivity of long waves for R = 3, 4, 6 spacings V^(1/n)
    "line": (1, [[1.0]], (.9816, .9942, .9988)), "square": (2, np.eye(2), (.9923, .9980, .9997)),
    "hexagonal": (2, np.array([[1.0, 0.0], [0.5, np.sqrt(0.75)]]), (.9890, .9970, .9995)),
    "sc": (3, np.eye(3), (.9975, .9989, .9999)),
    "bcc": (3, np.array([[-1, 1, 1], [1, -1, 1], [1, 1, -1]]) / 2, (.9933, .9983, .9997)),
    "fcc": (3, np.array([[0, 1, 1], [1, 0, 1], [1, 1, 0]]) / 2, (.9958, .9995, .9998)),
}


def neighbors(name, R):
    dim, cell, _ = LATTICES[name]
    cell = np.array(cell) / abs(np.linalg.det(cell)) ** (1 / dim)
    n = np.arange(-12, 13)
    s = np.stack(np.meshgrid(*[n] * dim, indexing="ij"), -1).reshape(-1, dim) @ cell
    r = np.linalg.norm(s, axis=1)
    inside = (r < R) & (r > 0.0)
    return s[inside], kernel(r[inside], R, dim)


@pytest.mark.parametrize("name", LATTICES)
def test_factors_of_lattices(name):
    """Those that the manual has, of sums over the lattices, with which the other tests compare."""
    dim = LATTICES[name][0]
    for R, factor in zip((3.0, 4.0, 6.0), LATTICES[name][2]):
        s, (W, F) = neighbors(name, R)
        V = 1.0 / (W.sum() + kernel(0.0, R, dim)[0])
        assert V / dim * (F * (s**2).sum(1)).sum() == pytest.approx(factor, abs=6e-5)


@pytest.mark.parametrize("dim, name, R", [(2, "sq", 3.0), (2, "hex", 4.0), (3, "fcc", 2.5)])
def test_waves_on_lattices(lammps, dim, name, R):
    """The rate of a temperature wave along x, at the start, is the sum over the lattice."""
    cells = {"sq": "0 16 0 8 -0.5 0.5", "hex": "0 12 0 7 -0.5 0.5", "fcc": "0 7 0 4 0 4"}[name]
    lammps(header(dim) + f"lattice {name} 1.0\nregion BOX block {cells}\ncreate_box 1 BOX\ncreate_atoms 1 box\nset group all mass 1.0\n"
           f"pair_style sph/bulk dim {dim}\npair_coeff * * 1.0 10.0 0.0 0.0 {R} cv 1.5 conductivity 0.3\n"
           "variable T atom 2.0+cos(2*PI*(x-xlo)/lx)\nfix FLUID all sph/bulk temperature v_T\n" + TEMPERATURE
           + dump("f.dump", extra="c_T") + "run 0\n")
    frame = lammps.frame("f.dump")
    lattice_name = {"sq": "square", "hex": "hexagonal"}.get(name, name)
    s, (W, F) = neighbors(lattice_name, R)
    V = 1.0 / (W.sum() + kernel(0.0, R, dim)[0])
    lx = {"sq": 16.0, "hex": 12.0 * np.sqrt(2 / np.sqrt(3)), "fcc": 7.0 * 4 ** (1 / 3)}[name]
    rate = 2 * 0.3 * V * V * (F * (1 - np.cos(2 * np.pi / lx * s[:, 0]))).sum()
    wave = frame["c_T"] - 2.0
    assert relative(frame["desph"] + rate * wave, rate * wave) < 1e-11


@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "off"), (4, "on")])
def test_heat_spreads_and_nothing_else(lammps, ranks, newton):
    """Particles at rest with random temperatures, two conductivities, near the largest stable step: the energy stays, the entropy
    grows in each step, no temperature leaves the range of those before."""
    particles = disordered(2, 14, speed=0.0, ntypes=2)
    write(lammps, particles)
    types = [dict(AT_REST, k=0.7), dict(AT_REST, k=3.0, cv=1.2)]
    random = "variable T atom 2.5+1.5*sin(12.9*id)\n"
    text = (header(2, newton) + "read_data box.data\n" + model("linear", types, 2) + random
            + "fix FLUID all sph/bulk temperature v_T\nvelocity all set 0 0 0\nfix HOLD all setforce 0 0 0\n")
    log = lammps(text + "run 0\n", ranks=ranks).log
    row = re.findall(r"^  \d-\d .*\| +(.*)$", log, re.MULTILINE)
    step = 0.9 * min(float(words.split()[-2]) for words in row)
    lammps(text + TEMPERATURE + f"timestep {step}\n" + dump("T.dump", extra="c_T") + "run 40\n", ranks=ranks)
    frames = lammps.frames("T.dump")
    capacity = frames[0]["mass"] * np.where(frames[0]["type"] == 1, 2.5, 1.2)
    energies = np.array([frame["esph"].sum() for frame in frames])
    assert np.ptp(energies) < 1e-13 * abs(energies[0])
    for before, after in zip(frames[1:], frames[2:]):  # without the first step, whose rates are those of its beginning
        a, b = before["c_T"], after["c_T"]
        assert (capacity * np.log(b / a)).sum() > 0.0
        assert b.max() <= a.max() + 1e-12 and b.min() >= a.min() - 1e-12
    assert np.ptp(frames[-1]["c_T"]) < 0.3 * np.ptp(frames[0]["c_T"])


@pytest.mark.parametrize("swap", [False, True])
def test_slabs_of_two_materials(lammps, swap):
    """The temperature of contact is (e1 T1 + e2 T2)/(e1 + e2), e = sqrt(k rho cv); error functions on both sides."""
    from scipy.special import erf
    N, t = 400, 0.01
    particles = line(N, 2.0)
    particles.type[:] = np.where(particles.x[:, 0] < 0.999, 1, 2)
    particles.write(lammps.path("box.data"))
    k = {1: 1.0, 2: 0.1}
    start = {1: 1.0, 2: 2.0}
    if swap:
        start = {1: 2.0, 2: 1.0}
    steps = 2000
    lammps(header(1) + "read_data box.data\npair_style sph/bulk dim 1 shear none\n"
           + "".join(f"pair_coeff {i} {i} 1.0 1.0 0.0 0.0 {4 * 2.0 / N} cv 1.0 conductivity {k[i]}\n" for i in (1, 2))
           + f"variable T atom {start[1]}*(type==1)+{start[2]}*(type==2)\nfix FLUID all sph/bulk temperature v_T\n"
           f"fix HOLD all setforce 0 0 0\ntimestep {t / steps}\n" + TEMPERATURE + dump("T.dump", steps, "c_T") + f"run {steps}\n")
    frame = lammps.frame("T.dump")
    e = {i: np.sqrt(k[i]) for i in k}
    contact = (e[1] * start[1] + e[2] * start[2]) / (e[1] + e[2])
    interface = 1.0 - 1.0 / N
    x, T = frame["x"][:, 0] - interface, frame["c_T"]
    near = np.abs(x) < 0.5
    profile = lambda Ti: np.where(x < 0, Ti + (start[1] - Ti) * erf(-x / np.sqrt(4 * k[1] * t)),
                                  Ti + (start[2] - Ti) * erf(x / np.sqrt(4 * k[2] * t)))
    slope = profile(1.0) - profile(0.0)
    far = near & (np.abs(x) > 4 * 2.0 / N)
    fitted = ((T - profile(0.0)) * slope)[far].sum() / (slope**2)[far].sum()
    print(f"temperature of contact {fitted:.6f}, {contact:.6f}; rms {np.sqrt(((T - profile(contact))[near] ** 2).mean()):.2e}")
    assert fitted == pytest.approx(contact, abs=1e-3)
    assert np.sqrt(((T - profile(contact))[near] ** 2).mean()) < 2e-3
    assert np.abs(T - profile(contact))[near].max() < 0.02


# ---------------------------------------------------------------------------------------------
# sound


def standing_wave(lammps, N, R, pair, coefficients, T, dt=0.002, every=20, run=1200, amplitude=1e-5):
    line(N).write(lammps.path("box.data"))
    log = lammps(header(1) + "read_data box.data\n" + f"pair_style sph/bulk dim 1 shear none bulk density {pair}\n"
                 + f"pair_coeff * * {coefficients.format(R=R / N)}\nfix FLUID all sph/bulk temperature {T}\ntimestep {dt}\n"
                 f"variable u0 atom {amplitude}*sin(2*PI*x)\nvelocity all set v_u0 0 0\nvariable u atom vx*sin(2*PI*x)\n"
                 f"compute U all reduce sum v_u\nthermo_style custom step c_U\nthermo {every}\n" + FULL + f"run {run}\n")
    return log.thermo()[-1]["c_U"] / amplitude * 2 / N, every * dt


@pytest.mark.parametrize("N, kappa, k, gamma, pb", [
    (64, 0.01, 0.0, 1.4, 0.4), (64, 0.0, 0.05, 1.4, 0.4), (64, 0.01, 0.05, 1.4, 0.4), (64, 0.01, 0.05, 5 / 3, 2 / 3),
    (128, 0.01, 0.05, 1.4, 0.4), (64, 0.01, 0.05, 1.4, 0.0)])
def test_sound_of_an_ideal_gas(lammps, N, kappa, k, gamma, pb):
    """Frequency, damping of sound with bulk viscosity and conduction: the sums over the line within 1e-3, the theory of Kirchhoff
    within 3 %.  The background pressure is elastic: it changes no speed of sound."""
    R, cv = 5.0, 1 / (gamma - 1)
    signal, interval = standing_wave(lammps, N, R, "eos ideal", f"1.0 1.0 0.0 {kappa} {{R}} gamma {gamma} pb {pb} cv {cv} conductivity {k}", 1.0)
    measured = max(exponents(interval, signal, 3 if k else 2), key=lambda s: s.imag)
    sums = Line(N, R)
    rho = sums.c / N
    heat = (gamma - 1) * cv
    exact = max(sums.sound(heat, heat * rho, gamma - 1, 1.0, heat * rho + pb, kappa, k, cv, rho), key=lambda s: s.imag)
    k2 = (2 * np.pi) ** 2
    D = k / (cv * gamma)
    cubic = max(np.roots([1, (kappa + gamma * D) * k2, gamma * k2 + kappa * gamma * D * k2**2, gamma * D * k2 * k2]), key=lambda s: s.imag)
    print(f"measured {measured:.5f}, discrete {exact:.5f}, continuum {cubic:.5f}")
    assert abs(measured.real - exact.real) < 1e-3 * abs(exact)
    assert measured.real == pytest.approx(exact.real, rel=2e-3)
    assert measured.imag == pytest.approx(exact.imag, rel=1e-3)
    assert measured.real == pytest.approx(cubic.real, rel=0.035) and measured.imag == pytest.approx(cubic.imag, rel=0.01)


@pytest.mark.parametrize("eos", ["linear", "tait"])
@pytest.mark.parametrize("gruneisen, T", [(0.6, 3.0), (0.6, 6.0)])
def test_sound_of_a_liquid(lammps, eos, gruneisen, T):
    """c0 is the adiabatic speed of sound at rho0 and T0 = 3, c^2 = c0^2 + Gamma (Gamma + 1) cv (T - T0) at others."""
    N, R, cv, c0, T0 = 64, 5.0, 0.2, 1.3, 3.0
    signal, interval = standing_wave(lammps, N, R, f"eos {eos}", f"1.0 {c0} 0.0 0.0 {{R}} cv {cv} gruneisen {gruneisen} {T0}", T)
    measured = max(exponents(interval, signal, 2), key=lambda s: s.imag)
    sums = Line(N, R)
    x = sums.c / N
    pc = c0**2 - gruneisen * (gruneisen + 1) * cv * T0
    p = gruneisen * cv * (x * T - T0) + (pc * (x - 1) if eos == "linear" else pc / 7 * (x**7 - 1))
    csq = pc * (1 if eos == "linear" else x**6) + gruneisen * (gruneisen + 1) * cv * T
    omega = np.sqrt(csq * sums.q**2 - 2 * p / x * (sums.q**2 - sums.q2sq))
    assert csq == pytest.approx(c0**2 + gruneisen * (gruneisen + 1) * cv * (T - T0), rel=0.01)
    assert measured.imag == pytest.approx(omega, rel=3e-4)
    assert abs(measured.real) < 1e-4


def test_pressure_of_a_liquid(lammps):
    """pb is the pressure at rho0 and T0; heat adds Gamma rho cv (T - T0)."""
    lattice(2, 8).write(lammps.path("box.data"))
    pressure = []
    for T in (3.0, 5.0):
        log = lammps(header(2) + "read_data box.data\npair_style sph/bulk\npair_coeff * * 1.0 10.0 0.5 2.0 3.0 pb 1.5 cv 2.0 gruneisen 0.6 3.0\n"
                     f"fix FLUID all sph/bulk density rho0 temperature {T}\nrun 0\n").log
        pressure.append(float(re.search(r"^  1 +\d+ +\d+ +\|.*\| +(\S+)", log, re.MULTILINE)[1]))
    assert pressure == pytest.approx([1.5, 1.5 + 0.6 * 2.0 * 2.0], rel=1e-3)


# ---------------------------------------------------------------------------------------------
# runs, ranks, files


def moving(lammps, eos="tait", style="sph/bulk", ntypes=2, options=""):
    particles = disordered(2, 12, ntypes=ntypes)
    particles.write(lammps.path("box.data"))
    fluids = [dict(one, kappa_r=0.0) for one in FLUIDS]
    return header(2) + "read_data box.data\n" + model(eos, fluids, 2, options)


START = "fix FLUID all sph/bulk density rho0 temperature 3.5\ntimestep 0.002\n"


@pytest.mark.parametrize("eos", ["tait", "ideal"])
def test_ranks_and_newton(lammps, eos):
    text = moving(lammps, eos) + START + dump("f.dump", 30) + "run 30\n"
    frames = []
    for ranks, newton in ((1, "on"), (2, "on"), (4, "on"), (2, "off"), (1, "off")):
        lammps(text.replace("newton on", f"newton {newton}"), ranks=ranks)
        frames.append(lammps.frame("f.dump"))
    for frame in frames[1:]:
        for key in ("x", "v", "esph", "desph"):
            assert relative(frame[key] - frames[0][key], frames[0][key]) < 1e-11, key


@pytest.mark.parametrize("viscous", ["", "viscous implicit", "viscous rkl2"])
def test_energy(lammps, viscous):
    """Of motion and heat together: to second order in the time step."""
    drift = []
    for dt in (0.004, 0.002):
        start = START.replace("fix FLUID all sph/bulk", f"fix FLUID all sph/bulk {viscous}").replace("0.002", f"{dt}")
        table = lammps(moving(lammps) + start + "compute E all sph/energy\nthermo_style custom step c_E\nthermo 1\n" + FULL
                       + f"run {round(0.4 / dt)}\n").thermo()[-1]
        drift.append(np.abs(table["c_E"] - table["c_E"][0]).max() / 144)
    print(drift)
    assert drift[1] < 0.35 * drift[0] + 1e-12 and drift[1] < 2e-3


@pytest.mark.parametrize("ranks", [1, 2])
def test_restart(lammps, ranks):
    lammps(moving(lammps) + START + "run 20\nwrite_restart state.restart\nwrite_data state.data pair ii\nwrite_data pairs.data pair ij\n"
           + TEMPERATURE + dump("whole.dump", 20, "c_T") + "run 20\n", ranks=ranks)
    lammps("read_restart state.restart\n" + START + TEMPERATURE + dump("parts.dump", 20, "c_T") + "run 20\n", ranks=ranks)
    whole, parts = lammps.frames("whole.dump"), lammps.frames("parts.dump")
    for a, b in zip(whole, parts):
        for key in ("x", "v", "esph", "c_T"):
            assert relative(a[key] - b[key], a[key]) < 1e-12, key
    for name in ("state.data", "pairs.data"):
        lines = [line for line in lammps.path(name).read_text().splitlines() if "gruneisen" in line]
        assert len(lines) == 2
        for one, words in zip(FLUIDS, lines):
            assert f" cv {one['cv']:g} conductivity {one['k']:g} gruneisen {one['gruneisen']:g} {one['T0']:g}" in words
    lammps(header(2) + "pair_style sph/bulk eos tait shear morris\nread_data state.data\n" + "fix FLUID all sph/bulk\n" + TEMPERATURE
           + dump("data.dump", 20, "c_T") + "run 0\n", ranks=ranks)
    assert relative(lammps.frame("data.dump")["c_T"] - whole[0]["c_T"], whole[0]["c_T"]) < 1e-12


def test_temperature_is_set_once(lammps):
    """A number, a variable of equal style, one of atom style; after the masses; once; compute sph/temp has heat over heat capacity."""
    box = moving(lammps, "linear")
    for word, T in (("2.5", lambda x: 2.5 + 0 * x), ("v_E", lambda x: 2.5 + 0 * x), ("v_A", lambda x: 1.0 + 0.1 * x)):
        variables = "variable E equal 5.0/2.0\nvariable A atom 1.0+0.1*x\n"
        result = lammps(box + variables + f"fix FLUID all sph/bulk temperature {word} density rho0\ntimestep 0.002\n" + TEMPERATURE
                        + "compute ALL all sph/temp\nthermo_style custom step c_ALL[5]\n" + FULL
                        + dump("T.dump", 5, "c_T") + "run 5\nrun 5\n", ranks=2)
        first, later = lammps.frames("T.dump")[0], lammps.frames("T.dump")[1]
        exact = T(first["x"][:, 0])
        assert relative(first["c_T"] - exact, exact) < 1e-13
        capacity = first["mass"] * np.where(first["type"] == 1, FLUIDS[0]["cv"], FLUIDS[1]["cv"])
        assert result.thermo()[0]["c_ALL[5]"][0] == pytest.approx((capacity * exact).sum() / capacity.sum(), rel=1e-13)
        assert relative(later["c_T"] - exact, exact) > 1e-3
        assert not np.array_equal(lammps.frame("T.dump")["c_T"], first["c_T"])


def test_temperature_with_relaxing_strain(lammps):
    """The energy of the strain, which the data file has, is no heat."""
    particles = disordered(2, 12, ntypes=2)
    write(lammps, particles, 0.05)
    lammps(header(2, style="sph/bulk relax 1") + "read_data box.data\n" + model("tait", FLUIDS, 2)
           + START + TEMPERATURE + "compute E all sph/energy\nthermo_style custom step c_E[4]\n" + FULL + dump("T.dump", extra="c_T") + "run 0\n")
    assert relative(lammps.frame("T.dump")["c_T"] - 3.5, 3.5) < 1e-13
    assert lammps.results[-1].thermo()[0]["c_E[4]"][0] > 1e-3


def test_fix_adapt_changes_the_conductivity(lammps):
    text = moving(lammps, "linear") + "fix FLUID all sph/bulk temperature v_T\nvariable T atom 1.0+0.1*x\nvelocity all set 0 0 0\n"
    lammps(text + dump("a.dump") + "run 0\n" + undump() + "variable k equal 1.4\nfix A all adapt 1 pair sph/bulk conductivity 1 1 v_k\n"
           "run 0\n" + dump("b.dump") + "run 1\n")
    lammps(text.replace("conductivity 0.7", "conductivity 1.4") + dump("c.dump") + "run 1\n")
    a, b, c = (lammps.frames(f"{name}.dump")[0]["desph"] for name in "abc")
    assert relative(b - c, c) < 1e-13 and relative(a - c, c) > 0.01


def test_walls_are_adiabatic(lammps):
    """Fluid at rest between walls: its heat stays, whatever the internal energy of the walls is."""
    particles = lattice(2, (8, 20))
    particles.esph[:] = 0.0
    particles.write(lammps.path("box.data"))
    text = (header(2, boundary="p f p") + "read_data box.data\nregion FLUID block INF INF 3 17 INF INF units box\ngroup fluid region FLUID\n"
            "group wall subtract all fluid\nset group wall sph/e 1000.0\n" + fluid(2, keywords="cv 1.0 conductivity 2.0")
            + "variable T atom 1.0+0.1*y\nfix FLUID fluid sph/bulk temperature v_T\nfix W wall sph/wall\nfix HOLD all setforce 0 0 0\n")
    lammps(text + TEMPERATURE + dump("T.dump", 100, "c_T") + "timestep 0.01\nrun 100\n", ranks=2)
    first, last = lammps.frames("T.dump")
    wet = (first["y"] > 3.0) & (first["y"] < 17.0)
    assert first["esph"][wet].sum() == pytest.approx(last["esph"][wet].sum(), rel=1e-13)
    assert (last["c_T"][~wet] == 0.0).all() and relative(last["desph"][~wet], first["desph"][wet]) < 1e-14
    assert np.ptp(last["c_T"][wet]) < 0.99 * np.ptp(first["c_T"][wet])


@pytest.mark.parametrize("rows", [10, 20])
def test_heat_along_adiabatic_walls(lammps, rows):
    """A wave of the temperature along a channel decays as without walls."""
    length, margin, k = 24, 3, 2 * np.pi / 24
    particles = lattice(2, (length, rows + 2 * margin))
    particles.write(lammps.path("box.data"))
    lammps(header(2, boundary="p f p") + f"read_data box.data\nregion FLUID block INF INF {margin} {margin + rows} INF INF units box\ngroup fluid region FLUID\n"
           "group wall subtract all fluid\n" + fluid(2, keywords="cv 1.0 conductivity 2.0")
           + f"variable T atom 1.0+0.1*cos({k}*x)\nfix FLUID fluid sph/bulk temperature v_T\nfix W wall sph/wall\nfix HOLD all setforce 0 0 0\n"
           + TEMPERATURE + dump("T.dump", 200, "c_T") + "timestep 0.01\nrun 200\n")
    first, last = (frame["c_T"] @ np.cos(k * frame["x"][:, 0]) for frame in lammps.frames("T.dump"))
    x, y = np.meshgrid(np.arange(-3, 4), np.arange(-3, 4))
    W, F = kernel(np.hypot(x, y), SUPPORT[2], 2)
    rate = 2.0 * 2.0 * (F * (1.0 - np.cos(k * x))).sum() / W.sum() ** 2
    assert np.log(first / last) / 2.0 == pytest.approx(rate, rel=1e-3)


@pytest.mark.parametrize("name", ["micropolar", "shift", "hybrid", "volume mass"])
def test_with_other_features(lammps, name):
    """The heat rates of conduction add up to zero, and the temperatures approach each other."""
    particles = disordered(2, 12, ntypes=2, speed=0.0)
    style = "sph/micropolar" if name == "micropolar" else "sph/bulk"
    words = "0.5 2.0 0.1 0.2 -0.2" if name == "micropolar" else "0.5 2.0"
    types = "pair_coeff {i} {i} {style} 1.0 10.0 {words} 3.0 cv 1.5 conductivity {k}\n"
    pair = f"pair_style {style} dim 2 " + ("volume mass" if name == "volume mass" else "") + "\n"
    sub = ""
    coeffs = [types.format(i=i, style=sub, words=words, k=k) for i, k in ((1, 1.0), (2, 0.4))]
    if name == "hybrid":
        pair = "pair_style hybrid sph/bulk dim 2 zero 3.0\n"
        coeffs = [types.format(i=1, style="sph/bulk", words=words, k=1.0), "pair_coeff 2 2 zero\npair_coeff 1 2 zero\n"]
    particles.write(lammps.path("box.data"))
    if name == "micropolar":
        from test_micropolar import write as write_micropolar
        write_micropolar(particles, lammps.path("box.data"), omega=np.zeros((len(particles), 3)))
    group = "group own type 1\n" if name == "hybrid" else "group own union all\n"
    lammps(header(2, style=style) + "read_data box.data\n" + group + pair + "".join(coeffs)
           + f"variable T atom 1.0+0.1*x\nfix FLUID own {style} temperature v_T" + (" shift 1.0" if name == "shift" else "")
           + "\ntimestep 1e-4\n" + TEMPERATURE + dump("a.dump", extra="c_T") + "run 0\n", ranks=2)
    frame = lammps.frame("a.dump")
    own = frame["type"] == 1 if name == "hybrid" else frame["type"] > 0
    rate, T = frame["desph"], frame["c_T"]
    assert abs(rate.sum()) < 1e-12 * np.abs(rate).sum()
    assert (rate[~own] == 0.0).all() and (T[~own] == 0.0).all()
    assert (rate[own] / T[own]).sum() > 0.0


def test_largest_stable_step(lammps):
    """The table has a column of heat, of the form morris with k/(rho cv), with and without a stage for viscous terms."""
    box = moving(lammps, "linear")
    for viscous in ("", "viscous rkl2"):
        log = lammps(box + f"fix FLUID all sph/bulk {viscous} temperature 3.0\ntimestep 0.5\nrun 0\n").log
        head = re.search(r"^  types .*$", log, re.MULTILINE)[0].split("step:")[1].split()
        rows = re.findall(r"^  (\d-\d) .*\| +(.*)$", log, re.MULTILINE)
        steps = {pair: dict(zip(head, map(float, words.replace("-", "inf").split()))) if "e-" not in words
                 else dict(zip(head, [float(word) if word != "-" else np.inf for word in words.split()])) for pair, words in rows}
        ratio = steps["1-1"]["heat"] / steps["2-2"]["heat"]
        thin = 1.0 / 1.1  # both have the same mean of rho
        assert ratio == pytest.approx((2.0 / 0.7) / (1.2 / 2.3) * thin, rel=0.3)
        assert all(row["all"] < row["heat"] for row in steps.values())
        limit = float(re.search(r"exceeds the largest stable time step (\S+)", log)[1])
        combined = {"": min(row["all"] for row in steps.values()),
                    "viscous rkl2": min(row["acoustic"] for row in steps.values())}[viscous]
        assert limit == pytest.approx(combined, rel=1e-3)


# ---------------------------------------------------------------------------------------------
# what is refused


@pytest.mark.parametrize("options, keywords, extra, words", [
    ("", "conductivity 1.0", "", "conductivity of type 1 needs its heat capacity, keyword cv"),
    ("", "gruneisen 0.5 1.0", "", "gruneisen of type 1 needs its heat capacity, keyword cv"),
    ("", "cv 1.0 gruneisen 0.5", "", "pair_coeff gruneisen.*missing|missing.*gruneisen"),
    ("", "cv 1.0 conductivity -1.0", "", "conductivity must be >= 0, not -1.0"),
    ("", "cv 1.0 gruneisen -1.0 2.0", "", "gruneisen must have Gamma >= 0 and T0 >= 0, not -1.0 2.0"),
    ("", "cv 0.0", "", "cv must be > 0, not 0.0"),
    ("", "cv 1.0 gruneisen 2.0 17.0", "", "gruneisen 2 17 of type 1: the heat alone makes sound faster than c0 10"),
    ("eos ideal", "cv 1.0 gruneisen 0.5 1.0", "", "gruneisen of type 1 cannot be used with eos ideal"),
    ("temp 1.0 5", "cv 1.0 conductivity 1.0", "", "temp cannot be used with conductivity"),
    ("temp 1.0 5", "cv 1.0 gruneisen 0.5 1.0", "", "temp cannot be used with gruneisen"),
    ("", "", "fix FLUID all sph/bulk temperature 1.0\n", "temperature needs the heat capacity of type 1, keyword cv"),
    ("", "cv 1.0", "fix FLUID all sph/bulk temperature -1.0\n", "temperature must be >= 0, not -1"),
    ("", "cv 1.0", "fix FLUID all sph/bulk temperature v_no\n", "Variable no for fix sph/bulk.* does not exist"),
    ("", "cv 1.0", "fix FLUID all sph/bulk temperature\n", "[Mm]issing"),
    ("", "cv 1.0 gruneisen 0.5 1.0", "minimize", "gruneisen cannot be used in a minimization"),
    ("", "cv 1.0 conductivity 1.0", "rerun", "conductivity of type 1 cannot be used with rerun"),
])
def test_errors(lammps, options, keywords, extra, words):
    lattice(2, 8).write(lammps.path("box.data"))
    text = header(2) + "read_data box.data\n" + fluid(2, options, keywords=keywords) + (extra if "fix" in extra else INTEGRATE)
    run = "run 0\n"
    if extra == "minimize":
        run = "minimize 0 1e-4 10 20\n"
    if extra == "rerun":
        run = "dump D all custom 1 r.dump id x y\nrun 0\nundump D\nrerun r.dump dump x y\n"
    result = lammps(text + run, check=False)
    assert result.code and re.search(words, result.error, re.DOTALL), result.output[-600:]


def test_warning_without_heat(lammps):
    lattice(2, 8).write(lammps.path("box.data"))
    for keywords, warned in (("cv 1.0", False), ("cv 1.0 conductivity 1.0", True), ("cv 1.0 gruneisen 0.5 1.0", True)):
        text = header(2) + "read_data box.data\nset group all sph/e 0.0\n" + fluid(2, keywords=keywords)
        for word in ("", "temperature 1.0"):
            result = lammps(text + f"fix FLUID all sph/bulk {word}\nrun 0\n", ranks=2)
            assert any("64 of 64 particles" in line for line in result.warnings) == (warned and not word)


def test_conduction_does_not_begin_during_a_run(lammps):
    """fix adapt is refused where no type conducts, and takes no number that pair_coeff would not take."""
    box = moving(lammps, "linear")
    adapt = "fix A all adapt 1 pair sph/bulk conductivity 1 1 v_k\nrun 1\n"
    without = re.sub(r"conductivity \S+|gruneisen \S+ \S+", "", box)
    result = lammps(without + START + "variable k equal 1.0\n" + adapt, check=False)
    assert result.code and "conductivity not supported" in result.error
    result = lammps(box + START + "variable k equal -1.0\n" + adapt, check=False)
    assert result.code and "conductivity must be >= 0, not -1 of type 1" in result.error


# ---- with other commands -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("pb, energy", [(5.0, 4.0), (1.0, 6.0)])
def test_stream_of_a_gas_with_background_pressure(lammps, pb, energy):
    """From an inlet to an outlet: zones hold heat, so that a uniform stream stays as it is, whatever pb/rho0 is over the heat."""
    particles = lattice(2, (36, 8))
    particles.v[:, 0] = 1.0
    particles.esph[:] = energy
    particles.write(lammps.path("box.data"))
    lammps(header(2, boundary="f p p") + "read_data box.data\n"
           "region IN block INF 9 INF INF INF INF\ngroup inlet region IN\nregion OUT block 27 INF INF INF INF INF\ngroup outlet region OUT\n"
           f"group flow subtract all inlet outlet\npair_style sph/bulk eos ideal\npair_coeff 1 1 1.0 10.0 0.5 2.0 3.0 gamma 1.4 pb {pb}\n"
           "fix FLUID flow sph/bulk\nfix IN inlet sph/open flow 9 4 0 1 0 0 8 velocity 1 0 0\n"
           f"fix OUT outlet sph/open flow 27 4 0 -1 0 0 8 pressure {0.4 * energy + pb}\ntimestep 0.005\n" + dump("out.dump", 400) + "run 400\n")
    frame = lammps.frame("out.dump")
    inside = (frame["x"][:, 0] > 11.0) & (frame["x"][:, 0] < 25.0)
    heat = frame["esph"] / frame["mass"] - pb * (1.0 - 1.0 / frame["rho"])
    assert inside.sum() > 80
    assert np.abs(frame["v"][inside, 0] - 1.0).max() < 0.02 and np.abs(heat[inside] / energy - 1.0).max() < 0.02


@pytest.mark.parametrize("mode", ["explicit", "rkl2", "implicit"])
def test_time_step_of_conduction(lammps, mode):
    """fix sph/dt keeps it, but with a stage for it only if asked to: then it is that of sound."""
    steps = {}
    for part in ("", "viscous 1.0", "viscous 5.0")[:2 if mode == "explicit" else 3]:
        text = (header(2) + "region BOX block 0 12 0 12 -0.5 0.5\ncreate_box 1 BOX\nlattice sq 1.0\ncreate_atoms 1 box\nset group all mass 1.0\n"
                "pair_style sph/bulk\npair_coeff 1 1 1.0 10.0 0.5 1.0 3.0 cv 1.0 conductivity 200.0\nvariable T atom 1.0+0.5*sin(2*PI*x/12)\n"
                f"fix FLUID all sph/bulk temperature v_T viscous {mode}\nfix DT all sph/dt 1 {part}\ncompute T all sph/temp\n"
                "thermo_style custom step dt c_T[5]\nthermo 10\nrun 50\n")
        log = lammps(text)
        table = log.thermo()[-1]
        steps[part] = table["Dt"]
        assert relative(table["c_T[5]"] - 1.0, np.ones(1)) < 1e-12
        row = [np.inf if word == "-" else float(word) for word in re.search(r"^  1-1 .*\| +(.*)$", log.log, re.MULTILINE)[1].split()]
    acoustic, limit = row[0], row[-1]
    assert limit < 0.05 * acoustic
    assert steps["viscous 1.0"] == pytest.approx(limit, rel=0.01)
    assert steps[""] == pytest.approx(limit if mode == "explicit" else acoustic, rel=0.02)
    if mode != "explicit":
        assert steps["viscous 5.0"] == pytest.approx(5.0 * limit, rel=0.01)
