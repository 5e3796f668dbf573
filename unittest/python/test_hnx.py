"""Noise of the heat: conduction, and gases whose pressure depends on the heat, with temp energy.

Stationary distributions are those of the measure exp(S/k) prod dS_i, found here by quadrature or in closed form."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

from helpers import disordered, dump, fluid, relative
from run_lammps import exponents
from test_relax import start

APART = 20.0
EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def groups(lammps, count, masses, heats, speed=0.0):
    """count groups of particles on a line, a distance of 1 apart, each type with its mass; the first moves with speed, the others against it."""
    size = len(masses)
    atoms, velocities = "", ""
    for k in range(count):
        for one, (mass, heat) in enumerate(zip(masses, heats)):
            tag = size * k + one + 1
            atoms += f"{tag} {one + 1} {mass} {heat:.17g} {APART * k + 5.0 + one} 0 0\n"
            velocities += f"{tag} {(speed if one == 0 else -speed / (size - 1)):.17g} 0 0\n"
    lammps.path("groups.data").write_text(
        f"groups\n\n{size * count} atoms\n{size} atom types\n0 {APART * count} xlo xhi\n-10 10 ylo yhi\n-0.5 0.5 zlo zhi\n\n"
        f"Atoms # sph/bulk\n\n{atoms}\nVelocities\n\n{velocities}")
    return "units lj\ndimension 2\natom_style sph/bulk\nread_data groups.data\nneighbor 1.0 bin\ncompute E all sph/energy\n"


def blocks(values, number=10):
    """Mean, and its standard error from the means of blocks."""
    means = np.asarray(values)[:len(values) // number * number].reshape(number, -1).mean(axis=1)
    return means.mean(), means.std(ddof=1) / np.sqrt(number)


LONG = pytest.mark.long


@pytest.mark.parametrize("capacity, masses", [
    (3.0, (1.0, 3.0, 1.0)), pytest.param(3.0, (1.0, 1.0, 1.0), marks=LONG), pytest.param(6.0, (1.0, 1.0, 1.0), marks=LONG),
    pytest.param(20.0, (1.0, 1.0, 1.0), marks=LONG)])
def test_three_particles_share_their_heat(lammps, capacity, masses):
    """Conduction alone: the shares of the heat have Dirichlet's distribution, prod Q_i^(C_i/k - 1)."""
    total = 3.0
    a = capacity * np.array(masses)
    box = groups(lammps, 300, masses, total * a / a.sum())
    coeffs = "".join(f"pair_coeff {i} {i} {m} 1e-9 0.0 intrinsic 3.0 conductivity 1.0\n" for i, m in enumerate(masses, 1))
    squares = "".join(f"group G{i} type {i}\nvariable q{i} atom c_e\nvariable s{i} atom c_e*c_e\n"
                      f"compute r{i} G{i} reduce ave v_q{i} v_s{i}\n" for i in (1, 2, 3))
    values = " ".join(f"c_r{i}[{k}]" for i in (1, 2, 3) for k in (1, 2))
    dt = 0.05 * capacity  # a tenth of the rate of the slowest mode
    thermo = lammps(box + f"pair_style sph/bulk dim 1 temp energy {capacity} 77\n{coeffs}fix FLUID all sph/bulk\n"
                    f"timestep {dt}\ncompute e all property/atom esph\n{squares}fix A all ave/time 5 400 2000 {values}\n"
                    "thermo_style custom step c_E f_A[1] f_A[2] f_A[3] f_A[4] f_A[5] f_A[6]\nthermo 2000\n"
                    "thermo_modify norm no format float %.17g\nrun 22000\n", timeout=300).thermo()[-1]
    assert np.ptp(thermo["c_E"]) < 1e-12 * thermo["c_E"][0]
    for i in range(3):
        mean, error = blocks(thermo[f"f_A[{2 * i + 1}]"][2:])
        square, error_of_square = blocks(thermo[f"f_A[{2 * i + 2}]"][2:])
        exact = total * a[i] / a.sum()
        variance = exact * (total - exact) / (a.sum() + 1.0)
        assert abs(mean / exact - 1.0) < 4.0 * error / exact + 3e-3
        assert abs(np.sqrt(square - mean**2) / np.sqrt(variance) - 1.0) < 2.0 * error_of_square / variance + 3e-3


def gas_of_two(capacity, gamma, total, spring, alike=False, support=3.0):
    """Means of distance, energy of motion, and heat of two particles of an ideal gas, mass 1, that springs hold at the ends of
    a line of length 1: density exp(S/k) dS_1 dS_2 at constant energy, S_i = C (ln Q_i - Gamma ln rho_i).  alike: the friction
    of the pair alone keeps Q_1 = Q_2; given the energy, its noise and friction balance at the density Q^(2C-2) dQ, and the work
    leaves a density that is a function of the entropy, so that it is Q^(2C-2) rho^(-Gamma(2C-1)) dQ."""
    r, dr = np.linspace(0.02, support - 0.02, 1500, retstep=True)
    v = np.linspace(0.0, np.sqrt(4.0 * total), 1201)  # relative velocity, kinetic energy v^2/4
    q = r / support
    kernel = lambda q: np.where(q < 1.0, (1.0 - q)**4 * (1.0 + 4.0 * q), 0.0)  # Wendland C2 but for its norm
    rho = kernel(0.0) + kernel(q)
    motion = 0.25 * v[None, :]**2
    shares = 2.0 * capacity - (1.0 if alike else 0.0)
    heat = total - motion - 0.25 * spring * (r[:, None] - 1.0)**2
    weight = np.where(heat > 0.0, np.maximum(heat, 1e-300)**(shares - 1.0), 0.0)
    weight *= rho[:, None]**(-(gamma - 1.0) * shares)
    mean = lambda field: (weight * field).sum() / weight.sum()
    return mean(r[:, None]), mean(motion), mean(heat)


@pytest.mark.parametrize("channel, gamma", [
    ("kappa 0.6 conductivity 0.3", 5.0 / 3.0), ("mu 0.3 conductivity 0.3", 1.4), pytest.param("kappa 0.6", 1.4, marks=LONG),
    pytest.param("mu 0.3", 5.0 / 3.0, marks=LONG)])
def test_gas_and_springs(lammps, channel, gamma):
    """Two particles of an ideal gas exchange energy by work, friction, and conduction, with each other and with springs."""
    capacity, total, spring = 3.0, 5.0, 60.0
    words = channel.split()
    value = dict(zip(words[::2], words[1::2]))
    box = groups(lammps, 400, (1.0, 1.0), (0.45 * total, 0.45 * total), np.sqrt(0.1 * total))
    keywords = f" conductivity {value['conductivity']}" if "conductivity" in value else ""
    text = (box + f"pair_style sph/bulk dim 1 eos ideal temp energy {capacity} 77\n"
            f"pair_coeff * * 1.0 1.0 {value.get('mu', 0.0)} {value.get('kappa', 'intrinsic')} 3.0 gamma {gamma}{keywords}\n"
            f"fix FLUID all sph/bulk\nfix SPRING all spring/self {spring}\ntimestep 0.01\n"
            "compute e all property/atom esph\ncompute heat all reduce ave c_e\nvariable d atom x*(2*type-3)\n"
            "compute distance all reduce ave v_d\nvariable motion equal c_E[1]/(0.5*count(all))\nvariable r equal 2*c_distance\n"
            "variable heat equal 2*c_heat\nvariable sum equal c_E+f_SPRING\n"
            "fix A all ave/time 2 250 500 v_r v_motion v_heat v_sum\n"
            "thermo_style custom step f_A[1] f_A[2] f_A[3] f_A[4]\nthermo 500\nthermo_modify norm no format float %.17g\nrun 12000\n")
    thermo = lammps(text, timeout=300).thermo()[-1]
    energy = thermo["f_A[4]"][1:]
    assert np.ptp(energy) < 0.003 * energy[0]
    for k, exact in enumerate(gas_of_two(capacity, gamma, energy.mean() / 400.0, spring, channel == "mu 0.3"), 1):
        mean, error = blocks(thermo[f"f_A[{k}]"][4:])
        assert abs(mean - exact) < 4.0 * error + 0.003 * abs(exact), (k, mean, error, exact)


@pytest.mark.parametrize("options, keywords", [
    ("eos ideal", "pb 5.0 gamma 1.4 conductivity 2.0"), ("eos tait", "pb 5.0 gruneisen 0.3 1.0 conductivity 2.0"),
    ("eos ideal volume mass", "gamma 1.4 conductivity 2.0 relax 4.0 0.1")])
def test_energy_is_exact(lammps, options, keywords):
    """Motion and heat together, over 500 steps; momentum; and the same forces and heats on any number of ranks."""
    particles = disordered(2, 12, ntypes=2, speed=1.0)
    particles.esph[:] = 40.0
    model = fluid(2, f"temp energy 10.0 77 {options}", keywords=keywords)
    text = start(lammps, particles, model, timestep=0.002) + "compute E all sph/energy\n"
    reference = None
    for ranks, newton in ((1, "on"), (2, "off"), (4, "on")):
        lammps(text.replace("newton on", f"newton {newton}") + dump("a.dump", 3) + "run 3\n", ranks=ranks)
        frame = lammps.frames("a.dump")[-1]
        now = np.column_stack((frame["f"], frame["desph"]))
        reference = now if reference is None else reference
        assert relative(now - reference, reference) < 1e-11, (ranks, newton)
    thermo = lammps(text + "thermo_style custom step c_E c_E[1]\nthermo 50\nthermo_modify norm no format float %.17g\nrun 500\n").thermo()[-1]
    assert np.ptp(thermo["c_E"]) < 1e-12 * thermo["c_E"][0]
    assert np.ptp(thermo["c_E[1]"]) > 1e-4 * thermo["c_E"][0]


@pytest.mark.parametrize("masses", ["", "set atom 1 mass 1.0000000001\n"])
def test_sound_with_little_noise(lammps, masses):
    """Frequency and damping of sound in an ideal gas are those of the run without noise, but for the part g dt/2 of the damping, which
    friction has with noise; a pressure that lags by half a step would take 1.4 percent off."""
    found = []
    for noise in ("", " temp energy 1.5e17 77"):
        lammps("units lj\ndimension 2\natom_style sph/bulk\nlattice sq 1.0 origin 0.5 0.0 0.0\nregion box block 0 64 -4 4 -0.5 0.5\n"
               "region line block 0 64 -0.1 0.1 -0.1 0.1\ncreate_box 1 box\ncreate_atoms 1 region line\nset group all mass 1.0\n" + masses +
               f"pair_style sph/bulk dim 1 eos ideal{noise}\npair_coeff * * 1.0 1.0 0.13 0.7 4.0 gamma 1.6666667 cv 1.5e17 conductivity 1.1e17\n"
               "fix FLUID all sph/bulk temperature 1e-17\nvariable s atom sin(6*PI*x/lx)\nvariable v atom 1e-5*v_s\nvelocity all set v_v 0.0 0.0\n"
               "variable w atom v_s*vx\ncompute A all reduce ave v_w\ntimestep 0.05\n"
               "fix A all ave/time 1 1 16 c_A file a.txt format ' %.16g'\nrun 960\n")
        found.append(max(exponents(0.8, np.loadtxt(lammps.path("a.txt"))[:, 1], 3), key=lambda s: s.imag))
    plain, noisy = found
    assert abs(noisy.imag / plain.imag - 1.0) < 0.002
    assert 0.0 < noisy.real / plain.real - 1.0 < 0.004


@pytest.mark.parametrize("style, steps, bound", [
    ("sph/bulk", 12000, 0.03), pytest.param("sph/bulk", 200000, 0.003, marks=LONG),
    pytest.param("sph/micropolar", 200000, 0.003, marks=LONG)])
def test_unequal_masses_have_one_temperature(lammps, style, steps, bound):
    """Motion, spin, and heat of light and heavy particles, at a quarter of the largest stable time step, at which the rest of the work
    of pressures and friction would make the heats differ by 6 percent."""
    spins = style == "sph/micropolar"
    viscosities = "0.3 0.8 0.1 0.02 -0.02" if spins else "0.3 0.8"
    thermo = lammps(
        f"units lj\ndimension 2\natom_style {style}\nlattice sq 1.0\nregion box block 0 20 0 20 -0.5 0.5\ncreate_box 2 box\n"
        "create_atoms 1 box\nset group all type/fraction 2 0.5 77\nset type 1 mass 1.0\nset type 2 mass 4.0\n"
        f"displace_atoms all random 0.1 0.1 0.0 5\nvelocity all create 1.0 87 loop geom\npair_style {style} temp energy 20.0 4711\n"
        f"pair_coeff 1 1 1.0 6.0 {viscosities} 3.0 pb 20.0 conductivity 1.0\npair_coeff 2 2 4.0 6.0 {viscosities} 3.0 pb 20.0 conductivity 1.0\n"
        f"fix FLUID all {style}{' inertia 0.16 0.0' if spins else ''} temperature 1.0\ntimestep 0.012\ngroup light type 1\ngroup heavy type 2\n"
        "compute light light sph/temp\ncompute heavy heavy sph/temp\nrun 3000\nreset_timestep 0\n"
        "fix A all ave/time 2 500 1000 c_light c_heavy c_light[4] c_heavy[4] c_light[5] c_heavy[5]\n"
        f"thermo_style custom step f_A[*]\nthermo 1000\nrun {steps}\n", timeout=3000).thermo()[-1]
    names = ["motion of light", "motion of heavy", "spin of light", "spin of heavy", "heat of light"]
    for k, name in enumerate(names, 1):
        if "spin" in name and not spins:
            continue
        ratio, error = blocks(thermo[f"f_A[{k}]"][1:] / thermo["f_A[6]"][1:], 4 if steps < 100000 else 10)
        print(f"{style}: {name} over heat of heavy {ratio:.4f} +- {error:.4f}")
        assert abs(ratio - 1.0) < bound + (0.0 if "heat" in name and bound > 0.01 else 2.0 * error)


def test_each_partner_gets_half_of_the_heat_of_friction(lammps):
    """Three micropolar particles of different masses, too cold for noise: at the mean velocities and spins of its kick, the work of each
    pair is half of it heat of either partner, also what its torques do together with those of the other pairs."""
    dt, support, mu, mu_r, gamma = 0.02, 3.0, 0.4, 0.5, 0.07
    masses, inertia = np.array([1.0, 4.0, 2.0]), 0.3
    places = np.array([[5.0, 0.0], [6.0, 0.1], [5.5, 0.8]])
    motions = np.array([[0.3, -0.2, 0.9], [-0.4, 0.5, -0.7], [0.1, 0.6, 0.4]])  # velocity and spin
    lammps.path("three.data").write_text(
        "three\n\n3 atoms\n3 atom types\n0 20 xlo xhi\n-10 10 ylo yhi\n-0.5 0.5 zlo zhi\n\nAtoms # sph/micropolar\n\n"
        + "".join(f"{i + 1} {i + 1} {masses[i]} {inertia} 1.0 {places[i, 0]} {places[i, 1]} 0\n" for i in range(3)) + "\nVelocities\n\n"
        + "".join(f"{i + 1} {motions[i, 0]} {motions[i, 1]} 0 0 0 {motions[i, 2]}\n" for i in range(3)))
    coeffs = "".join(f"pair_coeff {i} {i} {m} 1e-9 {mu} intrinsic {mu_r} {gamma} {-gamma} {support}\n" for i, m in enumerate(masses, 1))
    lammps("units lj\ndimension 2\natom_style sph/micropolar\nread_data three.data\nneighbor 1.0 bin\n"
           f"pair_style sph/micropolar temp energy 1e28 77\n{coeffs}fix FLUID all sph/micropolar\ntimestep {dt}\n"
           + dump("a.dump", 1, "omegaz tqz") + "run 1\n")
    frame = lammps.frames("a.dump")[-1]
    x = frame["x"][:, :2]
    moments = np.column_stack((masses, masses, inertia * masses))
    force = np.column_stack((frame["f"][:, :2], frame["tqz"]))
    acting = np.column_stack((frame["v"][:, :2], frame["omegaz"])) - 0.5 * dt * force / moments
    mean = acting + 0.5 * dt * force / moments
    q = np.linalg.norm(x[:, None] - x, axis=2) / support
    volume = 1.0 / (7.0 / (np.pi * support**2) * (1.0 - q)**4 * (1.0 + 4.0 * q)).sum(axis=1)  # Wendland C2
    total, heat = np.zeros((3, 3)), np.zeros(3)
    for i, j in ((0, 1), (0, 2), (1, 2)):
        r = x[i] - x[j]
        factor = 140.0 / (np.pi * support**4) * (1.0 - q[i, j])**3 * volume[i] * volume[j]
        slip = acting[i, :2] - acting[j, :2] - 0.5 * (acting[i, 2] + acting[j, 2]) * np.array([-r[1], r[0]])
        f = -factor * (8.0 * (mu - mu_r) * (r @ slip) * r / (r @ r) + 4.0 * mu_r * slip)
        both, diffusion = -0.5 * (r[0] * f[1] - r[1] * f[0]), factor * 2.0 * gamma * (acting[i, 2] - acting[j, 2])
        on_i, on_j = np.append(f, both - diffusion), np.append(-f, both + diffusion)
        total += np.outer(np.eye(3)[i], on_i) + np.outer(np.eye(3)[j], on_j)
        heat[[i, j]] -= 0.5 * (on_i @ mean[i] + on_j @ mean[j])
    assert relative(total - force, force) < 1e-8
    # what the rate lacks is what a particle pays for its own kick
    paid = (force * (mean - acting)).sum(axis=1)
    assert relative(frame["desph"] - paid - heat, heat) < 1e-8


def test_particles_without_heat_in_a_continued_run(lammps):
    """At the start they are an error; in a run that goes on, of whatever length, they are warmed."""
    particles = disordered(2, 12, speed=1.0)
    particles.esph[:] = 0.6
    model = fluid(2, "temp energy 0.5 77 eos ideal", keywords="gamma 1.1 conductivity 2.0")
    box = start(lammps, particles, model, timestep=0.002) + dump("a.dump", 100)
    frames = []
    for runs in ("run 100\n", "run 100 every 10 NULL\n", "run 40\nrun 60\n"):
        result = lammps(box + runs)
        assert any("particles have no heat" in line for line in result.warnings) == (runs != "run 100\n")
        assert "144 particles have a heat capacity, mass times cv, below Boltzmann's constant" in " ".join(result.warnings)
        frames.append(lammps.frames("a.dump")[-1])
    assert (frames[0]["esph"] < 0.0).any()
    for frame in frames[1:]:
        assert relative(frame["v"] - frames[0]["v"], frame["v"]) < 1e-9
    particles.esph[0] = -1.0
    result = lammps(start(lammps, particles, model, timestep=0.002) + "run 1\n", check=False)
    assert result.code and "1 particles have no heat" in result.error


def test_gas_and_piston(lammps):
    """Three particles of gas under a piston that another pair style holds up: the example, small, and its integral."""
    folder = EXAMPLES / "piston"
    spec = importlib.util.spec_from_file_location("piston", folder / "run.py")
    piston = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(piston)
    small = "".join(f"variable {name} index {value}\n" for name, value in {"cylinders": 100, "steps": 20000, "out": "a"}.items())
    lammps(small + (folder / "in.piston").read_text(), timeout=300)
    means, errors = piston.blocks(np.loadtxt(lammps.path("a.means.txt"))[:, 1:])
    exact = piston.Exact(means[3], 3.0, 5.0 / 3.0, 4.0, nodes=12)    # the integral to 1e-5
    assert abs(means[3] - 15.0) < 0.015
    for mean, error, value in zip(means, errors, exact.means.values()):
        assert abs(mean - value) < 4.0 * error + 0.003 * value


def test_vibrations_have_no_noise(lammps):
    particles = disordered(2, 12)
    result = lammps(start(lammps, particles, fluid(2, "temp energy 10.0 77 eos ideal", keywords="vibration 1.0 0.1")) + "run 1\n", check=False)
    assert result.code and "temp cannot be used with vibration of pair_coeff" in result.error


# ---- walls ----------------------------------------------------------------------------------------------------------


def particles_at_walls(lammps, count, heat, speed, style="sph/bulk"):
    """count single particles of the fluid on a line, between two of a wall each."""
    spin = "0.2 " if style == "sph/micropolar" else ""
    atoms, velocities = "", ""
    for k in range(count):
        for one, (place, kind) in enumerate(((-1.0, 2), (0.0, 1), (1.0, 2))):
            tag = 3 * k + one + 1
            atoms += f"{tag} {kind} 1.0 {spin}{heat if kind == 1 else 0.0:.17g} {APART * k + 10.0 + place} 0 0\n"
            velocities += f"{tag} {speed if kind == 1 else 0.0:.17g} 0 0{' 0 0 0' if spin else ''}\n"
    lammps.path("walls.data").write_text(
        f"walls\n\n{3 * count} atoms\n2 atom types\n0 {APART * count} xlo xhi\n-10 10 ylo yhi\n-0.5 0.5 zlo zhi\n\n"
        f"Atoms # {style}\n\n{atoms}\nVelocities\n\n{velocities}")
    return (f"units lj\ndimension 2\natom_style {style}\nread_data walls.data\nneighbor 1.0 bin\ngroup fluid type 1\ngroup wall type 2\n"
            f"fix FLUID fluid {style}\ncompute E fluid sph/energy\n")


@pytest.mark.parametrize("heat", ["adiabatic", "temp"])
def test_one_particle_and_a_wall(lammps, heat):
    """Friction with a wall is that of the temperature of the particle alone, prod Q^(C/k - 1) dQ dp at constant energy; a wall
    with a temperature is a heat bath, in which Q and p are independent."""
    capacity, T = 3.0, 1e-7
    total = (capacity + 0.5) * T
    box = particles_at_walls(lammps, 400, capacity * T, np.sqrt(T))
    conductivity, wall = ("", "") if heat == "adiabatic" else (" conductivity 0.5", f" heat temp {T}")
    given = "" if heat == "adiabatic" else " f_W[8]"
    thermo = lammps(
        box + f"pair_style sph/bulk dim 1 temp energy {capacity} 5\npair_coeff * * 1.0 1e-7 0.4 intrinsic 3.0{conductivity}\n"
        f"fix W wall sph/wall{wall}\ntimestep 0.02\ncompute e all property/atom esph\nvariable s atom c_e*c_e\n"
        f"compute q fluid reduce ave c_e v_s\nthermo_style custom step c_E[1] c_E c_q[1] c_q[2]{given}\nthermo 20\n"
        "thermo_modify norm no format float %.17g\nrun 2000\nrun 16000\n", timeout=300).thermo()[-1]
    energy = thermo["c_E"] - (thermo["f_W[8]"] if given else 0.0)
    assert np.ptp(energy) < 1e-12 * energy[0]
    motion, error = blocks(thermo["c_E[1]"][1:] / 400.0)
    exact = total / (2.0 * capacity + 1.0) if heat == "adiabatic" else 0.5 * T
    print("MOTION", heat, motion/exact-1, error/exact, np.ptp(energy)/energy[0])
    assert abs(motion - exact) < 4.0 * error + 0.005 * exact
    if heat == "adiabatic":
        return
    mean, error = blocks(thermo["c_q[1]"][1:])
    square, error_of_square = blocks(thermo["c_q[2]"][1:])
    variance = capacity * T**2
    print("REST", mean / (capacity * T) - 1.0, error / mean, (square - mean**2) / variance - 1.0, error_of_square / variance)
    assert abs(mean / (capacity * T) - 1.0) < 4.0 * error / mean + 0.003
    assert abs((square - mean**2) / variance - 1.0) < 4.0 * error_of_square / variance + 0.01


def between_walls(style="sph/bulk", lower="heat temp 1.0", upper="", options="", keywords="conductivity 60.0", every=100):
    """A fluid in two dimensions that begins with all temperatures at 1; everything up to thermo_style."""
    spin = " 0.1 0.02 -0.02" if style == "sph/micropolar" else ""
    return (f"units lj\ndimension 2\natom_style {style}\nlattice sq 1.0\nregion box block 0 10 -3 9 -0.5 0.5\ncreate_box 1 box\n"
            "create_atoms 1 box\nset group all mass 1.0\nregion low block INF INF INF -0.25 INF INF\n"
            "region high block INF INF 5.75 INF INF INF\ngroup low region low\ngroup high region high\ngroup fluid subtract all low high\n"
            "displace_atoms fluid random 0.1 0.1 0.0 5\nvelocity fluid create 1.0 87 loop geom\n"
            f"pair_style {style} temp energy 20.0 4711 {options}\npair_coeff * * 1.0 15.0 0.5 1.5{spin} 3.0 pb 200.0 {keywords}\n"
            f"fix FLUID fluid {style}" + (" inertia 0.16 0.0" if spin else "") + f" temperature 1.0\nfix LOW low sph/wall {lower}\n"
            f"fix HIGH high sph/wall {upper}\ntimestep 0.004\ncompute E fluid sph/energy\ncompute T fluid sph/temp\n"
            f"thermo {every}\n")


@pytest.mark.parametrize("style", ["sph/bulk", "sph/micropolar"])
def test_energy_between_walls(lammps, style):
    """With what the wall has given, to rounding errors; the same forces and heats on any number of ranks."""
    box, rest = between_walls(style, "heat temp 1.5", every=3).split("pair_style")
    lammps(box + "write_restart box.restart\n")
    reference = None
    for ranks, newton in ((1, "on"), (2, "off"), (4, "on")):
        lammps(f"newton {newton}\nread_restart box.restart\npair_style{rest}{dump('a.dump', 3)}run 3\n", ranks=ranks)
        frame = lammps.frames("a.dump")[-1]
        now = np.column_stack((frame["f"], frame["desph"]))
        reference = now if reference is None else reference
        assert relative(now - reference, reference) < 1e-10, (ranks, newton)
    thermo = lammps(between_walls(style, "heat temp 1.5") + "thermo_style custom step c_E c_E[1] f_LOW[8] c_T[5]\n"
                    "thermo_modify norm no format float %.17g\nrun 0\nrun 1000\n").thermo()
    assert thermo[0]["c_T[5]"][0] == pytest.approx(1.0, rel=1e-10)
    energy = thermo[-1]["c_E"] - thermo[-1]["f_LOW[8]"]
    assert np.ptp(energy) < 1e-12 * energy[0]
    assert thermo[-1]["f_LOW[8]"][-1] > 5.0


def test_walls_in_other_units(lammps):
    """Lengths and speeds times powers of two, all else so that the flow is the same: the same digits."""
    found = []
    for s, v in ((1.0, 1.0), (2.0**-20, 1.0), (1.0, 2.0**-20), (2.0**10, 2.0**20)):
        lines = lammps(
            f"units lj\natom_style sph/bulk\nneighbor {0.3 * s} bin\nlattice sc {s**-3}\nregion box block 0 6 -3 8 0 6\ncreate_box 1 box\n"
            "create_atoms 1 box\nvariable m atom 1.0+0.25*(id%3)\nset group all mass v_m\nregion low block INF INF INF -0.25 INF INF\n"
            "region high block INF INF 4.75 INF INF INF\ngroup low region low\ngroup high region high\ngroup fluid subtract all low high\n"
            f"velocity fluid create {v**2} 87 loop all\npair_style sph/bulk temp energy 20.0 4711\npair_coeff * * {s**-3} {15.0 * v} "
            f"{0.5 * v / s**2} {1.5 * v / s**2} {2.5 * s} pb {200.0 * v**2 / s**3} conductivity {60.0 * v / s**2}\n"
            f"fix FLUID fluid sph/bulk temperature {v**2}\nfix LOW low sph/wall heat temp {3.0 * v**2}\nfix HIGH high sph/wall\n"
            f"timestep {0.004 * s / v}\ncompute T fluid sph/temp\nthermo 40\nthermo_style custom step f_LOW[8] c_T c_T[5]\n"
            "thermo_modify norm no format float %.17g\nrun 40\n").thermo()[0]
        found.append(np.array([lines[name][-1] for name in ("f_LOW[8]", "c_T", "c_T[5]")]) / v**2)
    for other in found[1:]:
        assert other == pytest.approx(found[0], rel=1e-12)


def test_energies_of_walls_in_full_arrays(lammps):
    """LAMMPS's arrays have room for multiples of 16384 particles; sorting enlarges them when they are full."""
    energies = []
    for sort in ("", "atom_modify sort 0 0\n"):
        text = between_walls().replace("lattice", f"boundary f f p\n{sort}lattice").replace("block 0 10 -3 9", "block 0.5 128.5 -3.5 124.5")
        energies.append(lammps(text + "thermo_style custom step c_E atoms\nthermo_modify norm no format float %.17g\nrun 0\n").thermo()[0])
    assert energies[0]["Atoms"] == 16384
    assert energies[0]["c_E"] == pytest.approx(energies[1]["c_E"], rel=1e-12)


@pytest.mark.parametrize("upper", ["", pytest.param("heat temp 1.0", marks=LONG)])
def test_temperatures_between_walls(lammps, upper):
    """Of the motion, and of the heat, next to the walls too. Heat reaches the wall within a block of the mean, so that blocks are independent."""
    thermo = lammps(
        between_walls(upper=upper, keywords="conductivity 240.0") + "region near block INF INF 3.75 INF INF INF\ngroup near dynamic fluid region near every 100\n"
        "compute e fluid property/atom tsph\nvariable k atom 0.5*mass*(vx*vx+vy*vy)\ncompute warm near reduce ave c_e\ncompute fast near reduce sum v_k\nrun 3000\n"
        "variable fast equal c_fast/count(near)\nfix A fluid ave/time 5 200 1000 c_T c_T[5]\nfix B fluid ave/time 100 10 1000 c_warm v_fast\n"
        "thermo_style custom step f_A[*] f_B[*]\nthermo 1000\nrun 12000\n", timeout=300).thermo()[-1]  # near the upper one
    for name, bound in (("f_A[1]", 0.005), ("f_A[2]", 0.003), ("f_B[1]", 0.005), ("f_B[2]", 0.01)):
        mean, error = blocks(thermo[name][1:], 12)
        print(name, mean, error)
        assert abs(mean - 1.0) < 4.0 * error + bound, (name, mean, error)


@pytest.mark.parametrize("lower, options, keywords, words", [
    ("heat flux 1.0", "", "conductivity 1.0", "heat flux cannot be used with temp energy"),
    ("", "eos ideal", "gamma 1.4", "cannot be used with temp energy and eos ideal or gruneisen"),
    ("", "", "gruneisen 0.2 1.0", "cannot be used with temp energy and eos ideal or gruneisen")])
def test_walls_that_are_refused(lammps, lower, options, keywords, words):
    text = between_walls(lower=lower, options=options, keywords=keywords) + "run 1\n"
    result = lammps(text.replace("pb 200.0 ", ""), check=False)
    assert result.code and words in result.error


def test_a_wall_with_a_temperature_needs_a_conductivity_of_its_own(lammps):
    box = particles_at_walls(lammps, 2, 3.0, 0.0)
    result = lammps(box + "pair_style sph/bulk dim 1 temp energy 3.0 5\npair_coeff 1 1 1.0 1e-7 0.4 intrinsic 3.0 conductivity 0.5\n"
                    "pair_coeff 2 2 1.0 1e-7 0.4 intrinsic 3.0\nfix W wall sph/wall heat temp 1.0\ntimestep 0.02\nrun 1\n", check=False)
    assert result.code and "the types of the wall need a conductivity as well" in result.error
