"""Thermal noise of keyword relax of pair_coeff: covariance, ranks, restart, equilibrium, temperature."""

import numpy as np
import pytest

from helpers import disordered, drop, dump, fluid, free, lattice
from test_relax import ENERGIES, FULL, columns, elastic, lattice_sums, modes, one_step, phi1, relaxed_of, same, start, strain_of, unit_lattice


HEAT_BATH = 0.02
PROCESSES = [(8.0, 0.1), (3.0, 0.004)]


def noisy(lammps, particles, temperature=HEAT_BATH, options="", timestep=0.002, extra="", processes=PROCESSES, mu=0.5, kappa=2.0, strain=0.0, **keywords):
    words = "relax " + " ".join(f"{kr} {tau}" for kr, tau in processes)
    model = fluid(particles.dim, f"temp {temperature} 4711 {options}", mu=mu, kappa=kappa, keywords="pb 5 " + words)
    return start(lammps, particles, model, strain, len(processes), timestep, extra=extra, **keywords)


def increments(frames, timestep, processes):
    """What is random of ln rho_r in each step, over its standard deviation at temperature 1 and mass 1; (steps, particles, processes)."""
    count = len(processes)
    g, tau = np.array([kr / tau for kr, tau in processes]), np.array([tau for _, tau in processes])
    found = [np.log(relaxed_of(b, count) / relaxed_of(a, count)) + np.expm1(-timestep / tau) * strain_of(a, count)
             for a, b in zip(frames, frames[1:])]
    return np.array(found) / np.sqrt(2.0 * timestep / (g * tau)) * np.sqrt(frames[0]["mass"])[:, None]


@pytest.mark.parametrize("dim, cells", [(1, 3000), (2, 56), (3, 14)])
def test_covariance_of_the_noise(lammps, dim, cells):
    """2 kT dt/(m g tau), none between particles, processes, and steps: within 5 sigma."""
    particles = disordered(dim, cells, jitter=0.1, spread=0.3)
    options = "shear none" if dim == 1 else ""
    lammps(noisy(lammps, particles, options=options, mu=0.0 if dim == 1 else 0.5) + dump("out.dump", 1, columns(2)) + "run 3\n")
    number = increments(lammps.frames("out.dump"), 0.002, PROCESSES) / np.sqrt(HEAT_BATH)
    count = number[0].size
    for step in number:
        assert abs(step.mean()) < 5.0 / np.sqrt(count)
        for process in step.T:
            assert abs((process**2).mean() - 1.0) < 5.0 * np.sqrt(0.8 / len(particles))  # of a uniform distribution
        assert np.abs(step).max() <= np.sqrt(3.0) * (1.0 + 1e-9)
    products = [number[0] * number[1], number[0] * number[2], number[:, 1:] * number[:, :-1], number[:, :, 0] * number[:, :, 1],
                number[:, 1:, 0] * number[:, :-1, 1]]
    for product in products:
        assert abs(product.mean()) < 5.0 / np.sqrt(product.size)


def test_noise_leaves_momentum_alone(lammps):
    """The random pressure acts between particles, with all other noise, in a periodic box and a drop that rotates."""
    text = noisy(lammps, disordered(2, 12, spread=0.04)) + dump("out.dump", 500, columns(2)) + "run 500\n"
    lammps(text)
    first, last = lammps.frames("out.dump")
    assert np.abs((last["mass"][:, None] * last["v"]).sum(0) - (first["mass"][:, None] * first["v"]).sum(0)).max() < 1e-12
    particles = drop(2, 5.0)
    particles.mass[:] = 1.0
    lammps(noisy(lammps, particles, boundary=free(2)).replace("pb 5", "pb 0") + dump("out.dump", 500, columns(2)) + "run 500\n")
    spin = [frame["mass"][:, None] * np.cross(frame["x"], frame["v"]) for frame in lammps.frames("out.dump")]
    assert np.abs(spin[1].sum(0) - spin[0].sum(0)).max() < 1e-13 * np.linalg.norm(spin[0], axis=1).sum()


@pytest.mark.parametrize("ranks, newton", [(1, "off"), (2, "on"), (2, "off"), (4, "on")])
def test_same_noise_on_any_number_of_ranks(lammps, ranks, newton):
    particles = disordered(2, 12, spread=0.04)
    found = []
    for n, setting in ((1, "on"), (ranks, newton)):
        lammps(noisy(lammps, particles, newton=setting) + dump("out.dump", 20, columns(2)) + "run 20\n", ranks=n)
        found.append(lammps.frame("out.dump"))
    same(*found, bound=1e-11)


@pytest.mark.parametrize("ranks", [1, 2])
def test_same_noise_after_a_restart(lammps, ranks):
    particles = disordered(2, 12, spread=0.04)
    lammps(noisy(lammps, particles) + "run 10\nwrite_restart ten.restart\n" + dump("whole.dump", 5, columns(2)) + "run 10\n")
    lammps("read_restart ten.restart\nfix FLUID all sph/bulk\ntimestep 0.002\n" + dump("parts.dump", 5, columns(2)) + "run 10\n", ranks=ranks)
    for one, other in zip(lammps.frames("whole.dump"), lammps.frames("parts.dump")):
        same(one, other)


def test_noise_goes_on_after_reset_timestep(lammps):
    particles = disordered(2, 12, spread=0.04)
    for name, runs in (("whole.dump", "run 8\n"), ("parts.dump", "run 4\nreset_timestep 0\nrun 2 pre no\nreset_timestep 1\nrun 2\n")):
        lammps(noisy(lammps, particles) + "thermo_style custom step\n" + runs + dump(name, 1, columns(2)) + "run 0\n")
    same(lammps.frame("whole.dump"), lammps.frame("parts.dump"), bound=1e-11)


def test_other_seeds_and_steps_have_other_noise(lammps):
    particles = disordered(2, 30, spread=0.04)
    found = []
    for seed, step in ((4711, 0), (4712, 0), (4711, 1)):
        lammps(noisy(lammps, particles).replace("4711", str(seed)) + f"reset_timestep {step}\n" + dump("out.dump", 1, columns(2)) + "run 1\n")
        found.append(increments(lammps.frames("out.dump"), 0.002, PROCESSES)[0].ravel())
    for k, one in enumerate(found):
        for other in found[:k]:
            assert abs(one @ other) < 5.0 * np.linalg.norm(one) * np.linalg.norm(other) / np.sqrt(len(one))


@pytest.mark.parametrize("cells, steps", [(2000, 600), pytest.param(8000, 6000, marks=pytest.mark.long)])
def test_distribution_of_the_strain(lammps, cells, steps):
    """Particles that hardly move in the time: at the forces m g <x^2>/kT = 2 a/(1 - exp(-2 a)), for dt/tau = 0.1, 1, 10 at once."""
    timestep, g = 1e-4, 4.0
    ratios = [0.1, 1.0, 10.0]
    processes = [(g * timestep / a, timestep / a) for a in ratios for _ in (1, 2)]
    text = noisy(lammps, lattice(1, cells), 1e-4, "shear none", timestep, processes=processes, mu=0.0, kappa=0.0)
    names = [f"s{k}" for k in range(len(processes))]
    text += "compute P all property/atom rho " + columns(len(processes)) + "\n"
    text += "".join(f"variable {name} atom ln(c_P[1]/c_P[{k + 2}])^2\n" for k, name in enumerate(names))
    text += "compute A all reduce ave " + " ".join("v_" + name for name in names) + "\nthermo_style custom step c_A[*]\nthermo 1\n" + FULL
    table = lammps(text + f"run 60 post no\nrun {steps}\n", timeout=600).thermo()[-1]
    for k, a in enumerate(ratios):
        mean = 0.5 * sum(table[f"c_A[{2 * k + p}]"].mean() for p in (1, 2)) * g / 1e-4
        expected = 2.0 * a / -np.expm1(-2.0 * a)
        error = np.sqrt(2.0 / (2.0 * cells * steps) * (1.0 + np.exp(-2.0 * a)) / -np.expm1(-2.0 * a))
        print(f"a {a}: {mean / expected:.5f} +- {error:.5f}")
        assert abs(mean / expected - 1.0) < 5.0 * error
        assert error < 3e-3


def stationary(matrix, kick):
    """Covariance C = M C M^T + k k^T."""
    number = len(matrix)
    return np.linalg.solve(np.eye(number**2) - np.kron(matrix, matrix), np.outer(kick, kick).ravel()).reshape(number, number)


@pytest.mark.parametrize("a, g", [(0.1, 1.0), (1.0, 5.0), (10.0, 50.0)])
@pytest.mark.parametrize("steps", [6000, pytest.param(60000, marks=pytest.mark.long)])
def test_equilibrium_of_sound(lammps, a, g, steps):
    """No other viscosity: each wave has the velocity of the temperature and the density of the speed of sound c0, whatever g and dt/tau
    are, and its correlation in time is that of the sound and the relaxation, within 5 sigma of the covariance of the time step."""
    cells, R, kT, every = 512, 4.0, 1e-4, 4
    timestep = 0.25 * 0.5 * R / np.sqrt(1.0 + g * phi1(a))
    tau = timestep / a
    particles, sites = unit_lattice("line", cells, 1)
    random = np.random.default_rng(3)
    waves = np.arange(24, 120)  # k h from 0.6 to 3
    expected, rates, moving = [], [], []
    for wave in 2.0 * np.pi * waves / cells:
        number, q, q2 = lattice_sums(sites, wave, R, 1)
        matrix = one_step(q, elastic(q, q2, 1.0, 1.0), [(g, tau)], timestep)
        size = np.sqrt(2.0 * a / g)
        push = q * g * phi1(a) * size
        C = stationary(matrix, np.array([0.0, 0.5 * timestep * push, push, -size]))
        strain = np.array([-q, 0.0, 0.0, -1.0])
        assert C[1, 1] == pytest.approx(1.0, rel=1e-9)
        expected.append([C[1, 1], C[0, 0] * elastic(q, q2, 1.0, 1.0), strain @ C @ strain * g])
        moving.append([(np.linalg.matrix_power(matrix, every * lag) @ C)[1, 1] for lag in range(1, 9)])
        rates.append(min(-root.real for root, _ in modes(matrix, timestep)))
    mass = 1.0 / number
    particles.mass[:] = mass
    particles.v[:, 0] = random.normal(0.0, np.sqrt(kT / mass), cells)
    particles.v[:, 0] -= particles.v[:, 0].mean()
    model = fluid(1, f"shear none temp {kT} 31", mu=0.0, kappa=0.0, c0=1.0, support=R, keywords=f"pb 1 relax {g * tau} {tau}")
    text = start(lammps, particles, model, timestep=timestep)
    lammps(text + "run 500\ncompute P all property/atom rho vol\n"
           f"dump D all custom {every} out.dump id xu vx c_P[1] d_rho_relaxed1\n"
           f"dump_modify D sort id format float %.10g\nrun {steps}\n", timeout=1200)
    frames = lammps.frames("out.dump")
    v = np.array([frame["vx"] for frame in frames])
    x = np.array([np.log(frame["c_P[1]"] / frame["d_rho_relaxed1"]) for frame in frames])
    place = np.array([frame["xu"] for frame in frames]) - particles.x[:, 0]
    amplitudes = [np.fft.rfft(values, axis=1)[:, waves] / np.sqrt(cells * kT / mass) for values in (v, place, x)]
    found = [(np.abs(values) ** 2).mean(axis=0) for values in amplitudes]
    u, moving = amplitudes[0], np.array(moving)
    later = np.array([(u[lag:] * u[:-lag].conj()).real.mean(axis=0) for lag in range(1, 9)]).T
    expected = np.array(expected).T
    square = np.array([elastic(*lattice_sums(sites, 2.0 * np.pi * wave / cells, R, 1)[1:], 1.0, 1.0) for wave in waves])
    ratios = [found[0] / expected[0], found[1] * square / expected[1], found[2] * g / expected[2]]
    samples = 2.0 * (steps * timestep * np.array(rates) / 2.0).sum()
    error = np.sqrt(2.0 / samples)
    follows = (later * moving).sum() / (moving**2).sum()
    slower = np.abs(later - moving).max() / np.abs(moving).max()
    print(f"correlation in time over the exact one {follows:.4f}, largest difference {slower:.3f}")
    print(f"velocity, density, strain over the expected ones: {[f'{ratio.mean():.4f}' for ratio in ratios]} +- {error:.4f}; "
          f"density over that of c0 {(found[1] * square).mean():.4f}; slowest rate {min(rates):.4f}")
    assert error < 0.03
    assert abs(follows - 1.0) < 5.0 * error
    for ratio in ratios[:2]:
        assert abs(ratio.mean() - 1.0) < 5.0 * error
    assert abs(ratios[2].mean() - 1.0) < 2.0 * error
    assert abs((found[1] * square).mean() - 1.0) < 0.03 + 5.0 * error  # (omega dt)^2/4 too large


@pytest.mark.parametrize("a", [0.1, 1.0, 10.0])
@pytest.mark.parametrize("steps, cells", [(3000, 20), pytest.param(60000, 40, marks=pytest.mark.long)])
def test_temperature(lammps, a, steps, cells):
    """Of a fluid with all of its viscosities: within three standard errors, of 2e-3 in the long run."""
    timestep, kT = 0.003, 0.5
    particles = disordered(2, cells, jitter=0.1, speed=np.sqrt(kT), spread=0.0)
    particles.v[:, :2] -= particles.v[:, :2].mean(axis=0)
    text = noisy(lammps, particles, kT, timestep=timestep, processes=[(40.0 * timestep / a, timestep / a)], mu=0.5, kappa=1.0)
    text = text.replace("1.0 10.0 0.5", "1.0 6.0 0.5").replace("pb 5", "pb 20")
    text += ("compute T all sph/temp\nrun 400 post no\nreset_timestep 0\n"
             f"fix av all ave/time 1 {steps} {steps} c_T\nthermo_style custom step f_av\nthermo {steps}\n" + FULL + f"run {steps}\n")
    found = lammps(text, timeout=1200).thermo()[-1]["f_av"][-1]
    error = np.sqrt(2.0 / (2.0 * cells**2 * steps * timestep))  # an independent sample in a time of 1
    print(f"temperature {found / kT:.5f} +- {error:.5f}")
    assert abs(found / kT - 1.0) < 3.0 * error


def test_temperatures_of_the_particles(lammps):
    """temp energy: kinetic and internal energy together to rounding errors; the energy of the strain is not of the heat."""
    particles = disordered(2, 12, spread=0.0)
    particles.esph[:] = 100.0
    model = fluid(2, "temp energy 20.0 5", keywords="pb 5 relax 8.0 0.1")
    text = start(lammps, particles, model, 0.02, timestep=0.002) + ENERGIES + "thermo_style custom step c_E c_E[*]\nthermo 10\n" + FULL
    table = lammps(text + "run 500\n").thermo()[0]
    assert np.ptp(table["c_E[1]"]) > 1e-3 * table["c_E[1]"][0]
    assert np.abs(table["c_E"] - table["c_E"][0]).max() < 1e-12 * np.abs(table["c_E"][0])
    heat = []
    for strain in (0.0, 0.3):
        text = start(lammps, particles, model, strain, timestep=0.002) + "compute T all sph/temp\nthermo_style custom step c_T[5]\n" + FULL
        heat.append(lammps(text + "run 0\n").thermo()[0]["c_T[5]"][0])
    assert heat[0] - heat[1] == pytest.approx(0.5 * 80.0 * phi1(0.02) * 0.3**2 / 20.0, rel=1e-4)
