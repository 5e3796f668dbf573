"""Keyword interdrag of pair_coeff: force, heat, conserved quantities, noise, macroscopic drag, files, bad input.

The reference is the formula of the theory page, -b F V_i V_j (u.r) r of unlike particles, as dense sums over all pairs.
"""

import re

import numpy as np
import pytest

import test_micropolar as micro
from helpers import SUPPORT, disordered, drop, dump, free, header, lattice, momentum_errors, relative, undump

FULL = "thermo_modify norm no format float %.17g\n"
HEAT = "compute Q all sph/dissipation\n"
NUMBER = 7  # of its heat in the compute
CHANNELS = " ".join(f"c_Q[{k}]" for k in range(1, NUMBER + 1))
B = {(1, 2): 0.7, (1, 3): 0.3}  # none of types 2 and 3
KT = 0.3


def coefficients(dim, mu=0.5, kappa=2.0, ntypes=2, c0=10.0, b=B, rho0=lambda k: 1.0 + 0.1 * k):
    text = "".join(f"pair_coeff {k} {k} {rho0(k)} {c0} {mu} {kappa} {SUPPORT[dim]}\n" for k in range(1, ntypes + 1))
    return text + "".join(f"pair_coeff {i} {j} interdrag {value}\n" for (i, j), value in b.items() if j <= ntypes)


def start(particles, lammps, model, integrator="", timestep=0.005, newton="on", boundary="p p p"):
    particles.write(lammps.path("box.data"))
    return (header(particles.dim, newton, boundary) + "read_data box.data\n" + model
            + f"fix FLUID all sph/bulk {integrator}\ntimestep {timestep}\n")


# ---- the reference -----------------------------------------------------------------------------------------------


def geometry(frame, particles):
    """r_ij, r_ij^2, and F of wendland/c2 of all pairs."""
    dim, support = particles.dim, SUPPORT[particles.dim]
    r = frame["x"][:, None] - frame["x"][None]
    length = particles.hi - particles.lo
    r[..., :dim] -= (length * np.round(r / length))[..., :dim]
    r[..., dim:] = 0.0
    rsq = (r**2).sum(axis=2)
    q = np.minimum(np.sqrt(rsq) / support, 1.0)
    norm = {1: 1.5, 2: 7 / np.pi, 3: 10.5 / np.pi}[dim]
    return r, rsq, norm * support ** -(dim + 2) * 20 * (1 - q) ** 3


def strengths(frame, b=B):
    """b of all pairs."""
    kind = frame["type"].astype(int)
    table = np.zeros((4, 4))
    for (i, j), value in b.items():
        table[i, j] = table[j, i] = value
    return table[kind[:, None], kind[None]]


def reference(frame, particles, b=B):
    """Force and heat of each particle."""
    r, _, slope = geometry(frame, particles)
    u = frame["vest"][:, None] - frame["vest"][None]
    weight = strengths(frame, b) * slope * frame["vol"][:, None] * frame["vol"][None]
    approach = (u * r).sum(axis=2)
    return -((weight * approach)[..., None] * r).sum(axis=1), 0.5 * (weight * approach**2).sum(axis=1)


# ---- force and heat ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("dim, options", [(1, ""), (2, ""), (2, "shear none"), (2, "shear morris bulk volume"), (3, "volume mass"),
                                          (3, "shear espanol simd none")])
@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "off"), (2, "on")])
def test_force_and_heat_of_each_particle(lammps, dim, options, ranks, newton):
    """Of three types, in total, by channel, and by particle; other channels stay as they are."""
    if ranks == 2 and (dim != 2 or options == "shear none"):
        pytest.skip("ranks are covered by other forms")
    particles = disordered(dim, {1: 40, 2: 12, 3: 6}[dim], ntypes=3)
    text = start(particles, lammps, "", newton=newton)
    for name, b in ("plain", {}), ("drag", B):
        text += (f"pair_style sph/bulk dim {dim} {options}\n" + coefficients(dim, 0.0 if "none" in options else 0.5, ntypes=3, b=b) + HEAT
                 + f"thermo_style custom step c_Q {CHANNELS}\n" + FULL + dump(name, extra="c_Q") + "run 0 post no\n" + undump()
                 + "thermo_style one\nuncompute Q\npair_style none\n")
    before, after = (table for table in lammps(text, ranks=ranks).thermo() if "c_Q" in table)
    plain, drag = lammps.frame("plain"), lammps.frame("drag")
    force, heat = reference(drag, particles)
    assert relative(drag["f"] - plain["f"] - force, drag["f"]) < 1e-12
    assert relative(force, drag["f"]) > 1e-3
    assert relative(drag["c_Q"] - plain["c_Q"] - heat, drag["c_Q"]) < 1e-12
    assert relative(drag["desph"] - plain["desph"] - heat, drag["desph"]) < 1e-12
    assert before[f"c_Q[{NUMBER}]"][0] == 0.0
    assert after[f"c_Q[{NUMBER}]"][0] == pytest.approx(heat.sum(), rel=1e-12)
    for k in range(1, NUMBER):
        assert after[f"c_Q[{k}]"][0] == pytest.approx(before[f"c_Q[{k}]"][0], rel=1e-12)


def test_particles_with_spin(lammps):
    """On velocities only, and without a torque."""
    particles = disordered(2, 12, spread=0.0, ntypes=2)
    micro.write(particles, lammps.path("box.data"))
    found = []
    for line in ("", "pair_coeff 1 2 interdrag 0.7\n"):
        lammps(header(2, style="sph/micropolar") + "read_data box.data\n" + micro.fluid(2) + line + micro.integrate() + HEAT
               + f"thermo_style custom step {CHANNELS}\n" + FULL + micro.dump("f.dump") + "run 0\n")
        found.append((lammps.frame("f.dump"), lammps.results[-1].thermo()[0]))
    (plain, before), (drag, after) = found
    force, heat = reference({"x": drag["x"], "type": particles.type, "vest": drag["v"], "vol": drag["c_G[2]"]}, particles)
    assert relative(drag["f"] - plain["f"] - force, drag["f"]) < 1e-12
    assert relative(micro.vector(drag, "tqx", "tqy", "tqz") - micro.vector(plain, "tqx", "tqy", "tqz"), drag["f"]) < 1e-13
    assert after[f"c_Q[{NUMBER}]"][0] == pytest.approx(heat.sum(), rel=1e-12)
    for k in range(1, NUMBER):
        assert after[f"c_Q[{k}]"][0] == pytest.approx(before[f"c_Q[{k}]"][0], rel=1e-12)


# ---- what is conserved -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("options", ["", f"temp {KT} 4711"])
@pytest.mark.parametrize("dim", [2, 3])
def test_momentum_and_angular_momentum(lammps, dim, options):
    """Of a free drop of two fluids, with and without noise."""
    particles = drop(dim, 3.0)
    particles.type = np.arange(len(particles)) % 2 + 1
    model = f"pair_style sph/bulk {options}\n" + coefficients(dim, b={(1, 2): 5.0})
    lammps(start(particles, lammps, model, boundary=free(dim)) + dump("f.dump", 50) + "run 50\n", ranks=2)
    first, last = lammps.frames("f.dump")
    assert np.abs(first["v"] - last["v"]).max() > 0.1
    assert max(momentum_errors(first, last)) < 1e-13


@pytest.mark.parametrize("integrator", ["", "viscous rkl2", "viscous implicit tolerance 1e-12"])
def test_energy(lammps, integrator):
    """What the motion loses becomes heat: to second order in the time step, exactly with large viscosities."""
    particles = disordered(2, 12, ntypes=2, jitter=0.1)
    errors = []
    for timestep in 0.01, 0.005:
        model = "pair_style sph/bulk\n" + coefficients(2, b={(1, 2): 5.0})
        table = lammps(start(particles, lammps, model, integrator, timestep) + "compute E all sph/energy\nthermo_style custom step ke c_E\nthermo 1\n"
                       + FULL + f"run {round(0.4 / timestep)}\n").thermo()[0]
        assert table["KinEng"][-1] < 0.6 * table["KinEng"][0]
        errors.append(abs(table["c_E"][-1] - table["c_E"][0]) / table["KinEng"][0])
    print(errors)
    if integrator:
        assert max(errors) < 1e-12
    else:
        assert errors[1] < 1e-3 and errors[0] / errors[1] > 3.0


# ---- macroscopic drag --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("dim, arrangement, first, whole", [
    (2, "turn", 0.01, 0.01), (2, "random", 0.01, 0.05), (2, "quarter", 0.01, 0.05), (2, "disordered", 0.02, 0.06), (3, "disordered", 0.01, 0.02)])
def test_counter_streaming_fluids(lammps, dim, arrangement, first, whole):
    """The relative velocity decays by b (phi_2/rho_1 + phi_1/rho_2): at first, and over one decay time with particles of their own surroundings."""
    b, rho, timestep = 2.0, np.array([1.0, 2.5]), 0.005
    particles = disordered(dim, {2: 40, 3: 9}[dim], jitter=0.2 * (arrangement == "disordered"), speed=0.0, ntypes=2)
    if arrangement == "turn":
        particles.type = np.floor(particles.x).astype(int)[:, :dim].sum(axis=1) % 2 + 1
    if arrangement == "quarter":
        particles.type = np.where(np.random.default_rng(5).random(len(particles)) < 0.25, 1, 2)
    one = particles.type == 1
    phi = np.array([one.mean(), 1 - one.mean()])
    particles.mass = np.where(one, *rho)
    particles.v[:, 0] = np.where(one, *(np.array([0.01, -0.01]) / rho / phi))
    model = f"pair_style sph/bulk dim {dim}\n" + "".join(f"pair_coeff {k + 1} {k + 1} {rho[k]} 0.01 1.0 intrinsic 4.0\n" for k in range(2))
    model += f"pair_coeff 1 2 mu 0 interdrag {b}\n"
    exact = b * (phi[1] / rho[0] + phi[0] / rho[1])
    table = lammps(start(particles, lammps, model, timestep=timestep) + "group one type 1\ngroup two type 2\n"
                   "variable u equal vcm(one,x)-vcm(two,x)\nthermo_style custom step time v_u\nthermo 1\n" + FULL
                   + f"run {round(1 / exact / timestep)}\n").thermo()[0]
    rate = -np.log(table["v_u"] / table["v_u"][0])[1:] / table["Time"][1:] / exact
    print(dim, arrangement, rate[1], rate[-1])
    assert rate[1] == pytest.approx(1.0, abs=first) and rate[-1] == pytest.approx(1.0, abs=whole)


@pytest.mark.parametrize("c0", [2.0, 5.0])
def test_collisions_of_the_particles(lammps, c0):
    """Without this drag, two fluids that pass each other lose their relative velocity u at 0.2 to 0.4 u per spacing; with b = 4 rho u per spacing, about b."""
    u, found = 0.5, {}
    for b in 0.0, 2.0:
        particles = disordered(2, 30, jitter=0.1, speed=0.0, ntypes=2, spread=0.0)
        one = particles.type == 1
        particles.v[:, 0] = np.where(one, 0.5 * u / one.mean(), -0.5 * u / (1 - one.mean()))
        model = "pair_style sph/bulk\n" + "".join(f"pair_coeff {k} {k} 1.0 {c0} 0.1 intrinsic 4.0 pb {0.1 * c0**2}\n" for k in (1, 2))
        table = lammps(start(particles, lammps, model + f"pair_coeff 1 2 mu 0 interdrag {b}\n", timestep=0.3 / c0)
                       + "group one type 1\ngroup two type 2\nvariable u equal vcm(one,x)-vcm(two,x)\nthermo_style custom step time v_u\nthermo 1\n"
                       + FULL + f"run {round((8 if b == 0 else 1) / 0.3 * c0)}\n").thermo()[0]
        half = np.argmax(table["v_u"] < 0.5 * table["v_u"][0])
        found[b] = np.log(table["v_u"][0] / table["v_u"][half]) / table["Time"][half]
    print(c0, found)
    assert 0.15 < found[0.0] / u < 0.45
    assert found[2.0] == pytest.approx(2.0, rel=0.15)


# ---- noise -------------------------------------------------------------------------------------------------------


def friction(frame, particles, mu, kappa, b):
    """Matrix R of f = -R u, of the shear form mg, the bulk form density with limit yes, and this drag."""
    dim, number = particles.dim, len(particles)
    r, rsq, slope = geometry(frame, particles)
    r, vol, mass = r[..., :dim], frame["vol"], frame["mass"]
    weight = 2 * (dim + 2) * mu + strengths(frame, b) * rsq
    pair = weight * slope * vol[:, None] * vol[None] / np.where(rsq > 0, rsq, 1.0)
    blocks = -pair[..., None, None] * r[..., :, None] * r[..., None, :]
    blocks[np.arange(number), np.arange(number)] = -blocks.sum(axis=1)
    bound = vol**2 * (slope * rsq / np.where(weight > 0, weight, np.inf) / vol[None]).sum(axis=1)
    zeta = np.maximum(kappa - (1 + 2 / dim) * mu, -0.5 / bound)
    rate = slope[..., None] * r  # of c_i by the velocity of j
    rate[np.arange(number), np.arange(number)] = -rate.sum(axis=1)
    rate = rate.reshape(number, -1)
    return blocks.transpose(0, 2, 1, 3).reshape(number * dim, -1) + rate.T @ ((zeta * vol**3)[:, None] * rate)


@pytest.mark.parametrize("dim, mu, kappa, options", [(1, 0.0, 0.0, ""), (2, 0.0, 0.0, ""), (2, 0.3, 0.6, ""), (2, 0.3, 0.2, "limit yes"), (3, 0.0, 0.0, ""),
                                                     (3, 0.3, 0.2, "limit yes")])
def test_covariance_of_the_random_forces(lammps, dim, mu, kappa, options):
    """2 kT R/dt with the friction matrix R: along each of its eigenvectors, and zero where it is zero."""
    particles = disordered(dim, {1: 24, 2: 7, 3: 5}[dim], ntypes=2, speed=0.0, spread=0.0)
    timestep, steps, b = 1e-12, {1: 800, 2: 500, 3: 200}[dim], {(1, 2): 2.0}
    model = f"pair_style sph/bulk dim {dim} temp {KT} 4711 {options}\n" + coefficients(dim, mu, kappa, b=b, rho0=lambda k: 1.0)
    text = start(particles, lammps, model, timestep=timestep)
    lammps(text + dump("one.dump") + "run 0\n" + undump() + f"dump D all custom 1 f.dump id fx fy fz\ndump_modify D sort id format float %.17g\nrun {steps}\n")
    frame = lammps.frame("one.dump")
    force = np.array([np.column_stack([one.columns[name] for name in ("fx", "fy", "fz")[:dim]]).ravel() for one in lammps.frames("f.dump")])
    values, vectors = np.linalg.eigh(friction(frame, particles, mu, kappa, b))
    assert values[0] > -1e-12 * values[-1]
    modes = force @ vectors
    still = values < 1e-9 * values[-1]
    assert still.any() and np.abs(modes[:, still]).max() < 1e-6 * np.abs(force).max()
    number = modes[:, ~still] / np.sqrt(2 * KT * values[~still] / timestep)
    square = (number**2).mean(axis=0)
    print(dim, mu, kappa, square.mean() - 1, square.min(), square.max())
    sigma = np.sqrt(2.0 / len(number))  # of normal numbers
    assert abs(square.mean() - 1) < 5 * sigma / np.sqrt(len(square))
    assert np.abs(square - 1).max() < 5 * sigma
    correlation = number.T @ number / len(number)
    assert np.abs(correlation - np.diag(square)).max() < 6 / np.sqrt(len(number))
    assert abs((number[1:] * number[:-1]).mean()) < 5 / np.sqrt(number.size)


@pytest.mark.parametrize("words, mass", [(f"temp {KT} 4711", (1.0, 1.0)), (f"temp energy 1000 4711", (1.0, 3.0))])
def test_temperature(lammps, words, mass):
    """Two fluids that only this drag and its noise hold at a temperature; with heats of their own the energy stays."""
    particles = disordered(2, 16, ntypes=2, jitter=0.0, speed=0.0)
    one = particles.type == 1
    particles.mass = np.where(one, *mass)
    particles.v[:, :2] = np.random.default_rng(4).normal(0.0, 1.0, (len(particles), 2)) * np.sqrt(KT / particles.mass)[:, None]
    particles.v -= particles.mass @ particles.v / particles.mass.sum()
    model = f"pair_style sph/bulk {words}\n" + coefficients(2, 0.0, 0.0, c0=5.0, b={(1, 2): 4.0}, rho0=lambda k: mass[k - 1])
    if "energy" in words:
        particles.esph = 1000 * KT * particles.mass
    text = start(particles, lammps, model, timestep=0.01) + "compute E all sph/energy\ngroup one type 1\ngroup two type 2\nthermo 10\n"
    table = lammps(text + "variable one equal ke(one)\nvariable two equal ke(two)\n"
                   "thermo_style custom step ke c_E v_one v_two\n" + FULL + "run 3000\n").thermo()[-1]
    late = table["Step"] > 300
    for name, count in ("v_one", one.sum()), ("v_two", (~one).sum()):
        found = table[name][late].mean() / count
        print(words, name, found)
        assert found == pytest.approx(KT, rel=0.04)
    if "energy" in words:
        assert relative(table["c_E"] - table["c_E"][0], table["KinEng"]) < 1e-2


# ---- files, other commands ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("ranks", [1, 2])
def test_restart_and_data_files(lammps, ranks):
    particles = disordered(2, 12, ntypes=3, jitter=0.1)
    model = f"pair_style sph/bulk temp {KT} 4711\n" + coefficients(2, ntypes=3, b={(1, 2): 0.123456789012345, (1, 3): 0.3})
    lammps(start(particles, lammps, model) + "run 10\nwrite_restart state.restart\nwrite_data state.data pair ij\nwrite_data like.data pair ii\n"
           + dump("whole.dump", 10) + "run 10\n", ranks=ranks)
    again = "fix FLUID all sph/bulk\ntimestep 0.005\n"
    lammps("read_restart state.restart\n" + again + dump("parts.dump", 10) + "run 10\n", ranks=ranks)
    whole, parts = lammps.frame("whole.dump"), lammps.frame("parts.dump")
    assert np.abs(whole["x"] - parts["x"]).max() < 1e-12 and relative(whole["f"] - parts["f"], whole["f"]) < 1e-11
    forces = {}
    for name, lines in ("state", ""), ("state", model.split("\n", 1)[1]), ("like", ""):
        lammps(header(2) + f"pair_style sph/bulk temp {KT} 4711\nread_data {name}.data\n" + lines + again + dump("data.dump") + "run 0\n")
        forces[name, bool(lines)] = lammps.frame("data.dump")["f"]
    assert relative(forces["state", False] - forces["state", True], forces["state", True]) == 0.0
    assert relative(forces["like", False] - forces["state", True], forces["state", True]) > 1e-3


def test_adapt(lammps):
    """Also from zero, and with the noise."""
    particles = disordered(2, 12, ntypes=2)
    change = "variable b equal 0.7\nfix A all adapt 1 pair sph/bulk interdrag 1 2 v_b\n"
    for options in "", f"temp {KT} 4711":
        frames = []
        for b, adapt in ({(1, 2): 0.7}, ""), ({}, change), ({(1, 2): 3.0}, change):
            lammps(start(particles, lammps, f"pair_style sph/bulk {options}\n" + coefficients(2, b=b)) + adapt + dump("f.dump", 10) + "run 10\n")
            frames.append(lammps.frame("f.dump"))
        for frame in frames[1:]:
            assert relative(frames[0]["f"] - frame["f"], frames[0]["f"]) < 1e-11


def test_hybrid_styles(lammps):
    """Together with another style, and with particles that are not of the fluid."""
    particles = disordered(2, 12, ntypes=3)
    frames = []
    for line in "", "pair_coeff 1 2 sph/bulk mu mean interdrag 0.7\n":
        model = ("pair_style hybrid/overlay sph/bulk soft 1.2\n"
                 + "".join(f"pair_coeff {k} {k} sph/bulk 1.0 10.0 0.5 2.0 3.0\n" for k in (1, 2)) + "pair_coeff 1 2 sph/bulk mu mean\n" + line
                 + "pair_coeff * 3 soft 5.0\n")
        lammps(start(particles, lammps, model).replace("fix FLUID all", "group fluid type 1 2\ngroup rest type 3\nfix N rest nve\nfix FLUID fluid")
               + dump("f.dump") + "run 0\n")
        frames.append(lammps.frame("f.dump"))
    force, _ = reference(frames[1], particles, {(1, 2): 0.7})
    assert relative(frames[1]["f"] - frames[0]["f"] - force, frames[1]["f"]) < 1e-12


def test_table_and_time_step(lammps):
    """The column of the log, the step of fix sph/dt; without this drag there is no column."""
    particles = lattice(2, 8)
    particles.type = np.arange(64) % 2 + 1

    def text(b, rho=(1.0, 2.5)):
        model = "pair_style sph/bulk\n" + coefficients(2, 0.0, 0.0, b={(1, 2): b} if b else {}, rho0=lambda k: rho[k - 1])
        return start(particles, lammps, model, "density rho0", timestep=0.002)

    assert "interdrag" not in re.search(r"types .*largest stable.*", lammps(text(0.0) + "run 0\n").log)[0]
    run = lammps(text(300.0) + "fix T all sph/dt 1\nthermo_style custom step dt\nthermo 1\nrun 2\n")
    names, *rows = re.search(r"( types .*)\n(.*)\n(.*)\n(.*)\n", run.log).groups()
    values, steps = names.split("|")
    assert values.split().count("interdrag") == 1 and steps.split().count("interdrag") == 1
    column = values.split().index("interdrag")
    assert [float(row.split()[column]) for row in rows] == [0.0, 300.0, 0.0]
    assert run.thermo()[-1]["Dt"][-1] == pytest.approx(0.9 / (2.1 * 300), rel=1e-3)
    assert any("exceeds the largest stable time step" in line for line in lammps(text(300.0) + "run 0\n").warnings)


@pytest.mark.parametrize("dim, arrangement", [(1, "turn"), (2, "layers"), (2, "random"), (3, "layers")])
def test_rate_of_the_fastest_mode(lammps, dim, arrangement):
    """The table has a rate that no mode exceeds, and not twice that of the fastest one."""
    particles = disordered(dim, {1: 40, 2: 12, 3: 6}[dim], jitter=0.1, ntypes=2, speed=0.0, spread=0.0)
    if arrangement != "random":
        particles.type = np.floor(particles.x[:, :1 if arrangement == "layers" else dim].sum(axis=1)).astype(int) % 2 + 1
    model = f"pair_style sph/bulk dim {dim}\n" + coefficients(dim, 0.0, 0.0, b={(1, 2): 1.0}, rho0=lambda k: 1.0)
    lammps(start(particles, lammps, model) + dump("f.dump") + "run 0\n")
    frame = lammps.frame("f.dump")
    fastest = np.linalg.eigvalsh(friction(frame, particles, 0.0, 0.0, {(1, 2): 1.0})).max()
    print(dim, arrangement, fastest)
    assert 1.05 < fastest < 2.1


# ---- bad input ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("options, line, message", [
    ("", "pair_coeff 1 2 interdrag", "Illegal pair_coeff interdrag command: missing argument"),
    ("", "pair_coeff 1 2 interdrag -0.1", "Pair_coeff interdrag must be >= 0, not mu = 0.5 interdrag = -0.1 of types 1 2"),
    ("", "pair_coeff 1 2 interdrag inf", "Expected floating point parameter"),
    ("", "pair_coeff 1 2 interdrag mean", "Expected floating point parameter"),
    ("", "pair_coeff 1 2 interdrags 0.1", "Unknown pair_coeff keyword for pair_style sph/bulk: interdrags"),
    ("", "pair_coeff 1 1 interdrag 0.1", "viscosities and other coefficients by keyword are for unlike types"),
    ("", "pair_coeff * * 1.0 10.0 0.5 2.0 3.0 interdrag 0.1", "Pair_coeff keyword interdrag belongs to two unlike types"),
    ("shear mg/fr", "pair_coeff 1 2 interdrag 0.1", "Pair style sph/bulk shear mg/fr cannot be used with interdrag"),
    ("", "fix A all adapt 1 pair sph/bulk interdrag * * v_b", "interdrag of type 1 was changed, but it belongs to two unlike types"),
    ("", "fix A all adapt 1 pair sph/bulk interdrag 1 2 v_minus", "Pair_coeff interdrag must be >= 0"),
])
def test_bad_input(lammps, options, line, message):
    particles = disordered(2, 6, ntypes=2)
    model = f"pair_style sph/bulk {options}\npair_coeff * * 1.0 10.0 0.5 2.0 3.0\n" + line * line.startswith("pair") + "\n"
    text = start(particles, lammps, model) + "variable b equal 0.1\nvariable minus equal -0.1*step\n" + line * line.startswith("fix") + "\nrun 2\n"
    result = lammps(text, check=False)
    assert result.code and message in result.error, result.error
