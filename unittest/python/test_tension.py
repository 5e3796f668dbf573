"""Keyword tension of pair_coeff: energy and force, conserved quantities, the tension itself, files, bad input.

The reference is the energy of the theory page, a w_i w_j W(r) (1 + k (w_i w_j)^(1/n)/R^2) of unlike particles with w = m/rho0, as dense sums over
all pairs.
"""

import re
from types import SimpleNamespace

import numpy as np
import pytest
from scipy import optimize

import test_micropolar as micro
from helpers import SUPPORT, disordered, drop, dump, free, header, lattice, momentum_errors, relative, undump

FULL = "thermo_modify norm no format float %.17g\n"
SIGMA = {(1, 2): 0.7, (1, 3): 0.3}  # none of types 2 and 3
RHO = 1.0, 1.1, 2.0
NORM = {1: 15 / 16, 2: 3 / np.pi, 3: 105 / (32 * np.pi)}  # of (1 - q^2)^2
DISTANCE = {1: 5 / 16, 2: 32 / (35 * np.pi), 3: 35 / 128}  # <|z|>/R
ROWS = {1: 1 / 2, 2: 7 / 12, 3: 2 / 3}


def coefficients(dim, mu=0.5, kappa=2.0, ntypes=2, c0=10.0, sigma=SIGMA, rho=RHO):
    text = "".join(f"pair_coeff {k} {k} {rho[k - 1]} {c0} {mu} {kappa} {SUPPORT[dim]}\n" for k in range(1, ntypes + 1))
    return text + "".join(f"pair_coeff {i} {j} tension {value}\n" for (i, j), value in sigma.items() if j <= ntypes)


def start(particles, lammps, model, integrator="", timestep=0.005, newton="on", boundary="p p p"):
    particles.write(lammps.path("box.data"))
    return (header(particles.dim, newton, boundary) + "read_data box.data\n" + model
            + f"fix FLUID all sph/bulk {integrator}\ntimestep {timestep}\n")


# ---- the reference -----------------------------------------------------------------------------------------------


def reference(x, particles, sigma=SIGMA, rho=RHO, length=None):
    """Energy and force of each particle."""
    dim = particles.dim
    support = SUPPORT[dim]
    kind = particles.type.astype(int)
    table = np.zeros((4, 4))
    for (i, j), value in sigma.items():
        table[i, j] = table[j, i] = value
    w = particles.mass / np.array((0.0, *rho))[kind]
    r = x[:, None] - x[None]
    length = particles.hi - particles.lo if length is None else length
    r[..., :dim] -= (length * np.round(r / length))[..., :dim]
    r[..., dim:] = 0.0
    inside = np.maximum(1 - (r**2).sum(axis=2) / support**2, 0.0)
    both = w[:, None] * w[None]
    a = 2 * table[kind[:, None], kind[None]] / (DISTANCE[dim] * support) * both * (1 + ROWS[dim] * both ** (1 / dim) / support**2)
    energy = 0.5 * (a * NORM[dim] * support**-dim * inside**2).sum(axis=1)
    slope = NORM[dim] * support ** -(dim + 2) * 4 * inside
    return energy, ((a * slope)[..., None] * r).sum(axis=1)


# ---- energy and force --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("dim, options", [(1, ""), (2, ""), (2, "shear none"), (2, "shear morris bulk volume"), (2, "shear mg/fr"), (3, "volume mass"),
                                          (3, "shear espanol simd none")])
@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "off"), (4, "on")])
def test_energy_and_force_of_each_particle(lammps, dim, options, ranks, newton):
    """Of three types, in any form; heat and density stay as they are."""
    if ranks > 1 and (dim != 2 or options == "shear none"):
        pytest.skip("ranks are covered by other forms")
    particles = disordered(dim, {1: 40, 2: 12, 3: 6}[dim], ntypes=3)
    text = start(particles, lammps, "", newton=newton)
    for name, sigma in ("plain", {}), ("tension", SIGMA):
        text += (f"pair_style sph/bulk dim {dim} {options}\n" + coefficients(dim, 0.0 if "none" in options else 0.5, ntypes=3, sigma=sigma)
                 + "compute E all sph/energy\ngroup some type 1\ncompute S some sph/energy\ncompute P all pe/atom pair\n"
                 "thermo_style custom step pe c_E c_E[1] c_E[2] c_E[5] c_S[5] press\n" + FULL + dump(name, extra="c_P") + "run 0 post no\n" + undump()
                 + "thermo_style one\nuncompute E\nuncompute S\nuncompute P\ngroup some delete\npair_style none\n")
    before, after = (table for table in lammps(text, ranks=ranks).thermo() if "c_E" in table)
    plain, tension = lammps.frame("plain"), lammps.frame("tension")
    energy, force = reference(tension["x"], particles)
    assert relative(tension["f"] - plain["f"] - force, tension["f"]) < 1e-12
    assert relative(force, tension["f"]) > 1e-3
    assert relative(tension["c_P"] - plain["c_P"] - energy, tension["c_P"]) < 1e-12
    assert relative(tension["desph"] - plain["desph"], plain["desph"]) < 1e-12
    assert np.all(tension["rho"] == plain["rho"])
    assert before["c_E[5]"][0] == 0.0
    assert after["c_E[5]"][0] == pytest.approx(energy.sum(), rel=1e-12)
    assert after["c_S[5]"][0] == pytest.approx(energy[particles.type == 1].sum(), rel=1e-12)
    assert after["c_E"][0] == pytest.approx(sum(after[f"c_E[{k}]"][0] for k in (1, 2, 5)), rel=1e-14)
    assert after["PotEng"][0] - before["PotEng"][0] == pytest.approx(energy.sum(), rel=1e-10)


def test_particles_with_spin(lammps):
    """Without a torque."""
    particles = disordered(2, 12, spread=0.0, ntypes=2)
    micro.write(particles, lammps.path("box.data"))
    found = []
    for line in ("", "pair_coeff 1 2 tension 0.7\n"):
        lammps(header(2, style="sph/micropolar") + "read_data box.data\n" + micro.fluid(2) + line + micro.integrate() + micro.dump("f.dump") + "run 0\n")
        found.append(lammps.frame("f.dump"))
    plain, tension = found
    _, force = reference(tension["x"], particles, rho=(1.0, 1.0))
    assert relative(tension["f"] - plain["f"] - force, tension["f"]) < 1e-12
    assert relative(micro.vector(tension, "tqx", "tqy", "tqz") - micro.vector(plain, "tqx", "tqy", "tqz"), tension["f"]) < 1e-13


@pytest.mark.parametrize("dim", [2, 3])
def test_force_is_the_derivative_of_the_energy(lammps, dim):
    """By finite differences of the energy that LAMMPS gives out, extrapolated to a shift of 0."""
    particles = disordered(dim, {2: 12, 3: 6}[dim], ntypes=3)
    text = start(particles, lammps, f"pair_style sph/bulk dim {dim}\n" + coefficients(dim, 0.0, 0.0, ntypes=3, c0=1e-9))
    text += ("compute E all sph/energy\ngroup one id 7\nthermo_style custom step c_E[5]\n" + FULL + "neigh_modify delay 0 every 1 check no\n"
             + dump("f.dump") + "run 0 post no\n")
    step = 2e-3
    for axis in range(dim):
        for move in -2, 1, 2, 1:
            shift = " ".join(repr(move * step) if d == axis else "0" for d in range(3))
            text += f"displace_atoms one move {shift} units box\nrun 0 post no\n"
        shift = " ".join(repr(-2 * step) if d == axis else "0" for d in range(3))
        text += f"displace_atoms one move {shift} units box\n"
    tables = lammps(text).thermo()
    energies = np.array([table["c_E[5]"][0] for table in tables[1:]]).reshape(dim, 4)
    force = lammps.frames("f.dump")[0]["f"][6][:dim]
    near = (energies[:, 2] - energies[:, 1]) / (2 * step)
    far = (energies[:, 3] - energies[:, 0]) / (4 * step)
    assert np.abs((4 * near - far) / 3 + force).max() < 1e-8 * np.abs(force).max()


@pytest.mark.parametrize("volume", ["number", "mass"])
@pytest.mark.parametrize("dim, spacings", [(1, 4), (2, 3), (2, 4), (2, 6), (3, 3), (3, 4)])
def test_energy_of_a_plane(lammps, dim, spacings, volume):
    """In physical units: the tension within 1 percent, whatever masses and densities are."""
    spacing, sigma, rho = 0.01, 0.07, np.array([1000.0, 1.2])
    cells = {1: 16, 2: 16, 3: 14}[dim]
    particles = lattice(dim, cells, spacing)
    particles.type = np.where(particles.x[:, 0] < particles.hi[0] / 2, 1, 2)
    particles.mass = rho[particles.type - 1] * spacing**dim
    particles.write(lammps.path("box.data"))
    text = header(dim) + f"read_data box.data\nneighbor {0.3 * spacing} bin\npair_style sph/bulk dim {dim} volume {volume}\n"
    for k in range(2):
        text += f"pair_coeff {k + 1} {k + 1} {rho[k]} 1.0 0.1 intrinsic {spacings * spacing}\n"
    text += f"pair_coeff 1 2 tension {sigma}\nfix FLUID all sph/bulk\ncompute E all sph/energy\nthermo_style custom step c_E[5]\n" + FULL + "run 0\n"
    found = lammps(text).thermo()[0]["c_E[5]"][0] / (2 * sigma * (cells * spacing) ** (dim - 1))
    print(dim, spacings, found)
    assert found == pytest.approx(1.0, abs=0.01)


# of a plane whose particles have made room for each other, over sigma: by kernel and rc in spacings, (rho0 c0^2, pb) rc/sigma
RELAXED = {
    ("wendland/c2", 4): {(100, 20): 0.946, (100, 40): 0.964, (100, 80): 0.976, (200, 20): 0.958, (200, 40): 0.973, (200, 80): 0.982,
                         (400, 20): 0.968, (400, 40): 0.980, (400, 80): 0.987},
    ("wendland/c6", 5): {(100, 20): 0.965, (100, 40): 0.975, (100, 80): 0.981, (200, 20): 0.974, (200, 40): 0.982, (200, 80): 0.987,
                         (400, 20): 0.980, (400, 40): 0.987, (400, 80): 0.991},
}


@pytest.mark.parametrize("kernel, spacings", RELAXED)
@pytest.mark.parametrize("ratio", [1, 1000])
def test_relaxed_plane(lammps, kernel, spacings, ratio):
    """Its tension is the energy of both planes at the pressure across them, less that of the fluid at this pressure; any ratio of densities."""
    particles = lattice(2, (2, 48))
    particles.type = np.where(particles.x[:, 1] < 24.0, 1, 2)
    particles.mass = np.where(particles.type == 1, 1.0, ratio)
    particles.write(lammps.path("box.data"))
    text = ""
    for modulus, pressure in RELAXED[kernel, spacings]:
        text += header(2) + f"read_data box.data\nneighbor 0.5 bin\npair_style sph/bulk kernel {kernel} volume mass\n"
        for kind, rho in (1, 1.0), (2, float(ratio)):
            text += f"pair_coeff {kind} {kind} {rho} {np.sqrt(modulus / spacings / rho)} 0.1 intrinsic {spacings} pb {pressure / spacings}\n"
        text += "fix FLUID all sph/bulk\nthermo_style custom step pe pyy\n" + FULL + "run 0 post no\npair_coeff 1 2 tension 1.0\n"
        text += "min_modify dmax 0.05\nminimize 0 1e-9 1000 10000\nclear\n"
    tables = lammps(text).thermo()
    for ((modulus, pressure), wanted), before, after in zip(RELAXED[kernel, spacings].items(), tables[::2], tables[1::2], strict=True):
        more = after["Pyy"][-1] - before["Pyy"][0]
        found = (after["PotEng"][-1] - before["PotEng"][0] + 48 * more**2 * spacings / modulus) / 4
        print(kernel, spacings, modulus, pressure, round(found, 4))
        assert found == pytest.approx(wanted, abs=1e-3)


# ---- what is conserved -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("options", ["", "temp 0.3 4711"])
@pytest.mark.parametrize("dim", [2, 3])
def test_momentum_and_angular_momentum(lammps, dim, options):
    """Of a free drop of two fluids, with and without noise."""
    particles = drop(dim, 3.0)
    particles.type = np.arange(len(particles)) % 2 + 1
    model = f"pair_style sph/bulk {options}\n" + coefficients(dim, sigma={(1, 2): 5.0})
    lammps(start(particles, lammps, model, boundary=free(dim)) + dump("f.dump", 50) + "run 50\n", ranks=2)
    first, last = lammps.frames("f.dump")
    assert np.abs(first["v"] - last["v"]).max() > 0.1
    assert max(momentum_errors(first, last)) < 1e-13


@pytest.mark.parametrize("integrator", ["", "viscous rkl2", "viscous implicit tolerance 1e-12"])
def test_energy(lammps, integrator):
    """Kinetic, internal, and that of the tension: to second order in the time step."""
    errors = []
    for timestep in 0.01, 0.005:
        particles = disordered(2, 12, ntypes=2, jitter=0.1)
        model = "pair_style sph/bulk\n" + coefficients(2, sigma={(1, 2): 2.0})
        table = lammps(start(particles, lammps, model, integrator, timestep) + "compute E all sph/energy\nthermo_style custom step ke c_E c_E[5]\nthermo 1\n"
                       + FULL + f"run {round(0.4 / timestep)}\n").thermo()[0]
        assert np.ptp(table["c_E[5]"]) > 0.05 * table["KinEng"][0]
        errors.append(abs(table["c_E"][-1] - table["c_E"][0]) / table["KinEng"][0])
    print(integrator, errors)
    assert errors[1] < 1e-3 and errors[0] / errors[1] > 3.0


# ---- files, other commands ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("ranks", [1, 2])
def test_restart_and_data_files(lammps, ranks):
    particles = disordered(2, 12, ntypes=3, jitter=0.1)
    model = "pair_style sph/bulk\n" + coefficients(2, ntypes=3, sigma={(1, 2): 0.123456789012345, (1, 3): 0.3})
    lammps(start(particles, lammps, model) + "run 10\nwrite_restart state.restart\nwrite_data state.data pair ij\nwrite_data like.data pair ii\n"
           + dump("whole.dump", 10) + "run 10\n", ranks=ranks)
    again = "fix FLUID all sph/bulk\ntimestep 0.005\n"
    lammps("read_restart state.restart\n" + again + dump("parts.dump", 10) + "run 10\n", ranks=ranks)
    whole, parts = lammps.frame("whole.dump"), lammps.frame("parts.dump")
    assert np.abs(whole["x"] - parts["x"]).max() < 1e-12 and relative(whole["f"] - parts["f"], whole["f"]) < 1e-11
    forces = {}
    for name, lines in ("state", ""), ("state", model.split("\n", 1)[1]), ("like", ""):
        lammps(header(2) + f"pair_style sph/bulk\nread_data {name}.data\n" + lines + again + dump("data.dump") + "run 0\n")
        forces[name, bool(lines)] = lammps.frame("data.dump")["f"]
    assert relative(forces["state", False] - forces["state", True], forces["state", True]) == 0.0
    assert relative(forces["like", False] - forces["state", True], forces["state", True]) > 1e-3


def test_adapt(lammps):
    """In the middle of a run; not from nothing."""
    particles = disordered(2, 12, ntypes=3)
    change = "variable b equal 0.7\nvariable c equal 0.3\nfix A all adapt 1 pair sph/bulk tension 1 2 v_b pair sph/bulk tension 1 3 v_c\n"
    frames = []
    for sigma, adapt in (SIGMA, ""), ({(1, 2): 3.0}, change), ({(2, 3): 0.0, (1, 3): 1.0}, change):
        lammps(start(particles, lammps, "pair_style sph/bulk\n" + coefficients(2, ntypes=3, sigma=sigma)) + adapt + dump("f.dump", 10) + "run 10\n")
        frames.append(lammps.frame("f.dump"))
    for frame in frames[1:]:
        assert relative(frames[0]["f"] - frame["f"], frames[0]["f"]) < 1e-11
    result = lammps(start(particles, lammps, "pair_style sph/bulk\n" + coefficients(2, ntypes=3, sigma={})) + change + "run 1\n", check=False)
    assert result.code and "tension" in result.error


def test_tension_that_is_off_for_a_while(lammps):
    """With new neighbor lists in between, after which it acts on the pairs of the last one."""
    particles = disordered(2, 12, ntypes=2, speed=2.0)
    text = start(particles, lammps, "pair_style sph/bulk\n" + coefficients(2, sigma={(1, 2): 0.7}))
    text += ('variable s equal "0.7*(step < 3 || step > 37)"\nfix A all adapt 1 pair sph/bulk tension 1 2 v_s\n'
             "neighbor 2.0 bin\natom_modify sort 1 1.0\n" + dump("f.dump", 40))
    found = []
    for every in 36, 1:
        lammps(text + f"neigh_modify every {every} delay 0 check no\nrun 40\n")
        found.append(lammps.frame("f.dump"))
    assert relative(found[1]["f"] - found[0]["f"], found[0]["f"]) < 1e-10


def test_hybrid_styles(lammps):
    """Together with another style, and with particles that are not of the fluid."""
    particles = disordered(2, 12, ntypes=3)
    frames = []
    for line in "", "pair_coeff 1 2 sph/bulk mu mean tension 0.7\n":
        model = ("pair_style hybrid/overlay sph/bulk soft 1.2\n"
                 + "".join(f"pair_coeff {k} {k} sph/bulk {RHO[k - 1]} 10.0 0.5 2.0 3.0\n" for k in (1, 2)) + "pair_coeff 1 2 sph/bulk mu mean\n" + line
                 + "pair_coeff * 3 soft 5.0\n")
        lammps(start(particles, lammps, model).replace("fix FLUID all", "group fluid type 1 2\ngroup rest type 3\nfix N rest nve\nfix FLUID fluid")
               + dump("f.dump") + "run 0\n")
        frames.append(lammps.frame("f.dump"))
    _, force = reference(frames[1]["x"], particles, {(1, 2): 0.7})
    assert relative(frames[1]["f"] - frames[0]["f"] - force, frames[1]["f"]) < 1e-12


def test_table_and_time_step(lammps):
    """The columns of the log, the step of fix sph/dt, the warning; without tension there is no column."""
    particles = lattice(2, 8)
    particles.type = np.arange(64) % 2 + 1
    particles.mass = np.where(particles.type == 1, 1.0, 2.5)

    def text(sigma):
        model = "pair_style sph/bulk\n" + coefficients(2, 0.0, 0.0, sigma={(1, 2): sigma} if sigma else {}, rho=(1.0, 2.5))
        return start(particles, lammps, model, "density rho0", timestep=0.002)

    assert "tension" not in re.search(r"types .*largest stable.*", lammps(text(0.0) + "run 0\n").log)[0]
    run = lammps(text(3000.0) + "fix T all sph/dt 1\nthermo_style custom step dt\nthermo 1\nrun 0\n")
    names, *rows = re.search(r"( types .*)\n(.*)\n(.*)\n(.*)\n", run.log).groups()
    values, steps = names.split("|")
    assert values.split().count("tension") == 1 and steps.split().count("tension") == 1
    column = values.split().index("tension")
    assert [float(row.split()[column]) for row in rows] == [0.0, 3000.0, 0.0]
    h = 3.0 / 2
    assert run.thermo()[-1]["Dt"][-1] == pytest.approx(0.25 * np.sqrt(1.0 * h**3 / (2 * np.pi * 3000)), rel=1e-2)
    assert any("exceeds the largest stable time step" in line for line in lammps(text(30000.0) + "run 0\n").warnings)


# ---- particles that come, go, split, or stand still ---------------------------------------------------------------

DEPOSIT = ("molecule one one.mol\nregion top block 4 12 13.0 15.0 0 0 units box\n"
           "fix D all deposit 5 0 4 4711 mol one region top near 0.4 vy -1.0 -1.0 units box\n")
REFINE = "variable t atom 1.0-0.75*(x<6)+1.6*(x>10)\nfix R all sph/refine 5 volume v_t\n"
OPEN = ("region low block INF 8 INF INF INF INF units box\nregion high block 24 INF INF INF INF INF units box\ngroup low region low\ngroup high region high\n"
        "group fluid subtract all low high\nfix low low sph/open fluid 8 0 0 1 0 0 8 velocity 3.0 0 0\n"
        "fix high high sph/open fluid 24 0 0 -1 0 0 8 pressure 1.0\n")


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("options, keywords, fixes, count", [
    ("", "power 0.6 0.05 1.5", "", "same"), ("temp energy 100 4711", "", "", "same"), ("", "", "timestep 0\n", "same"),
    ("", "", DEPOSIT, "more"), ("volume mass", "", REFINE, "other"), ("volume mass", "", OPEN, "new")],
    ids=["rate", "energy", "at_rest", "deposit", "refine", "open"])
def test_energy_of_the_particles_there(lammps, options, keywords, fixes, count, ranks):
    """Every ten steps, whichever they are."""
    particles = disordered(2, 16, ntypes=2, jitter=0.1, speed=0.1)
    if "open" in fixes:
        particles = disordered(2, (32, 16), ntypes=2, jitter=0.0, spread=0.0, speed=0.1)
        particles.v[:, 0] += 3.0
        particles.lo[0], particles.hi[0] = -3.0, 35.0
    lammps.path("one.mol").write_text("one\n\n1 atoms\n\nCoords\n\n1 0 0 0\n\nTypes\n\n1 2\n\nMasses\n\n1 1.1\n")
    shut = "f p p" if "open" in fixes else "p f p" if "deposit" in fixes else "p p p"
    if "deposit" in fixes:
        particles = particles.where(particles.x[:, 1] < 12.0)
    length = np.where(np.array(shut.split()) == "p", 16.0, 1e9)
    model = f"pair_style sph/bulk {options}\n" + coefficients(2).replace(" 3.0\n", f" 3.0 {keywords}\n")
    text = start(particles, lammps, model, boundary=shut)
    if "open" in fixes:
        text = text.replace("fix FLUID all", fixes + "fix FLUID fluid")
    else:
        text += fixes
    table = lammps(text + "compute E all sph/energy\nthermo_style custom step atoms c_E c_E[5]\nthermo 10\n" + FULL + dump("f.dump", 10) + "run 40\n",
                   ranks=ranks).thermo()[-1]
    frames = lammps.frames("f.dump")
    number = len(particles)
    assert {"same": table["Atoms"][-1] == number, "more": table["Atoms"][-1] == number + 5, "other": table["Atoms"][-1] != number,
            "new": frames[-1]["id"].max() > number}[count]
    assert (np.ptp(table["c_E[5]"]) == 0.0) == ("timestep 0" in fixes)
    for frame, found in zip(frames, table["c_E[5]"], strict=True):
        there = SimpleNamespace(dim=2, mass=frame["mass"], type=frame["type"])
        assert found == pytest.approx(reference(frame["x"], there, length=length)[0].sum(), rel=1e-12)


def test_rerun(lammps):
    """Energy and force of snapshots, without viscosity, whose force needs velocities at their times."""
    particles = disordered(2, 16, ntypes=3, jitter=0.1)
    text = start(particles, lammps, "pair_style sph/bulk\n" + coefficients(2, 0.0, 0.0, ntypes=3))
    text += "compute E all sph/energy\nthermo_style custom step c_E[5]\n" + FULL
    snapshots = "dump S all custom 5 s.dump id type mass x y z vx vy vz\ndump_modify S sort id format float %.17g\nthermo 5\n"
    lammps(text + snapshots + dump("run.dump", 5) + "run 20\n")
    lammps(text + "thermo 1\n" + dump("again.dump", 5) + "rerun s.dump dump x y vx vy\n")
    for first, again in zip(lammps.frames("run.dump"), lammps.frames("again.dump"), strict=True):
        assert relative(again["f"] - first["f"], first["f"]) < 1e-11
    first, again = (result.thermo()[-1]["c_E[5]"] for result in lammps.results)
    assert np.ptp(first) > 0 and again == pytest.approx(first, rel=1e-12)


# ---- a drop ------------------------------------------------------------------------------------------------------


def test_laplace_pressure(lammps):
    """Of a drop of radius 9 spacings that is cut out of a lattice."""
    support, sigma, box, c0 = 4.0, 2.0, 26, 20.0
    particles = lattice(2, box)
    x = particles.x - box / 2
    particles.type = np.where(np.hypot(x[:, 0], x[:, 1]) < 9.0, 2, 1)
    model = f"pair_style sph/bulk\npair_coeff * * 1.0 {c0} 2.0 20.0 {support} pb 60.0\npair_coeff 1 2 tension {sigma}\n"
    lammps(start(particles, lammps, model, timestep=0.01) + dump("f.dump", 800) + "run 800\n")
    frame = lammps.frame("f.dump")
    inside, r = frame["type"] == 2, np.hypot(*(frame["x"] - box / 2)[:, :2].T)
    radius = np.sqrt(frame["vol"][inside].sum() / np.pi)
    deep, far = (c0**2 * frame["rho"][part].mean() for part in (r < radius - support, r > radius + support))
    print((deep - far) * radius / sigma)
    assert deep - far == pytest.approx(sigma / radius, rel=0.05)


# ---- a wave of the interface -------------------------------------------------------------------------------------


def root_of_wave(k, nu, sigma):
    """Decay and frequency of a wave between two fluids of density 1 and viscosity nu that fill all space, from the equations of Stokes.

    Velocity along z: A exp(-k|z|) - A k/q exp(-q|z|) with q^2 = k^2 + s/nu, so that both components are continuous at z = 0.
    The pressures 2 s A/k apart carry the tension sigma k^2 (1 - k/q) A/s: s^2 = -sigma k^3/2 (1 - k/q).
    """
    s = 1j * np.sqrt(sigma * k**3 / 2)
    for _ in range(200):
        s = 0.5 * (s + 1j * np.sqrt(sigma * k**3 / 2 * (1 - k / np.sqrt(k**2 + s / nu))))
    return -s.real, s.imag


@pytest.mark.long
@pytest.mark.parametrize("pb, temp, frequency, decay", [(8.0, "", 0.93, 2.3), (8.0, "temp 0.002 1", 0.96, 1.9), (0.0, "temp 0.002 1", 0.87, 1.1)])
def test_wave_of_an_interface(lammps, pb, temp, frequency, decay):
    """Frequency and decay over those of linear theory; a wave of 32 spacings with a small viscosity, in both planes between two fluids."""
    n, amplitude, nu = 32, 1.6, 0.024
    k = 2 * np.pi / n
    rate, omega = root_of_wave(k, nu, 1.0)
    particles = lattice(2, (n, 2 * n))
    height = particles.x[:, 1] - amplitude * np.cos(k * particles.x[:, 0])
    particles.type = np.where((height > n / 2) & (height < 3 * n / 2), 2, 1)
    model = (f"pair_style sph/bulk kernel wendland/c6 volume mass {temp}\npair_coeff * * 1.0 10.0 {nu} 0.5 5.0 pb {pb}\npair_coeff 1 2 tension 1.0\n"
             "displace_atoms all random 0.15 0.15 0 4711\n"
             f"variable low atom (type==2)*cos({k}*x)*(y<{n})\nvariable high atom (type==2)*cos({k}*x)*(y>={n})\ncompute sums all reduce sum v_low v_high\n"
             "thermo_style custom step time c_sums[1] c_sums[2]\nthermo_modify norm no\nthermo 20\n")
    table = lammps(start(particles, lammps, model, timestep=0.05) + "run 8200\n", ranks=2).thermo()[-1]
    later = np.array(table["Time"]) > 10.0
    t, found = np.array(table["Time"])[later], []
    for column in "c_sums[1]", "c_sums[2]":
        y = np.array(table[column])[later]
        fits = [optimize.least_squares(lambda p: p[0] * np.exp(-p[1] * t) * np.cos(p[2] * t + p[3]) + p[4] - y, (y[0], rate, guess, 0.0, 0.0))
                for guess in omega * np.linspace(0.6, 1.2, 7)]
        found.append(min(fits, key=lambda fit: fit.cost).x[[2, 1]] / (omega, rate))
    print(pb, temp, np.round(found, 3))
    assert np.mean(found, axis=0)[0] == pytest.approx(frequency, abs=0.06)
    assert np.mean(found, axis=0)[1] == pytest.approx(decay, abs=0.4)


# ---- bad input ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("line, message", [
    ("pair_coeff 1 2 tension", "Illegal pair_coeff tension command: missing argument"),
    ("pair_coeff 1 2 tension -0.1", "Pair_coeff tension must be >= 0"),
    ("pair_coeff 1 2 tension inf", "Expected floating point parameter"),
    ("pair_coeff 1 2 tension mean", "Expected floating point parameter"),
    ("pair_coeff 1 1 tension 0.1", "viscosities and other coefficients by keyword are for unlike types"),
    ("pair_coeff * * 1.0 10.0 0.5 2.0 3.0 tension 0.1", "Pair_coeff keyword tension belongs to two unlike types"),
    ("pair_coeff 1 2 tension 0.1\nfix A all adapt 1 pair sph/bulk tension * * v_b", "tension of type 1 was changed, but it belongs to two unlike types"),
    ("pair_coeff 1 2 tension 0.1\nfix A all adapt 1 pair sph/bulk tension 1 2 v_minus", "Pair_coeff tension must be >= 0"),
    ("pair_coeff 1 2 tension 0.1\ncompute E all sph/energy\nfix G all sph/bulk\nrun 0 post no\npair_coeff 1 2 tension 0.2\nprint $(c_E)", "run 0 first"),
])
def test_bad_input(lammps, line, message):
    particles = disordered(2, 6, ntypes=2)
    model = "pair_style sph/bulk\npair_coeff * * 1.0 10.0 0.5 2.0 3.0\nvariable b equal 0.1\nvariable minus equal -0.1*step\n" + line + "\n"
    result = lammps(start(particles, lammps, model) + "run 2\n", check=False)
    assert result.code and message in result.error, result.error
