"""Keyword drag of pair_coeff: force, heat, noise, walls, large coefficients, files, bad input.

The reference is the formula of the theory page, -b V (u - U), written down here.
"""

import re

import numpy as np
import pytest

import test_micropolar as micro
from helpers import INTEGRATE, SUPPORT, disordered, dump, fluid, header, lattice, relative, undump

FULL = "thermo_modify norm no format float %.17g\n"
B, STREAM = 0.4, (0.2, -0.1, 0.0)
DRAG = f"drag {B} 0.2 -0.1 0"
HEAT = "compute Q all sph/dissipation\n"
CHANNELS = " ".join(f"c_Q[{k}]" for k in range(1, 6))
MOMENTUM = "variable px equal mass(all)*vcm(all,x)\nvariable py equal mass(all)*vcm(all,y)\n"


def start(particles, lammps, model, integrator="", timestep=0.005, newton="on"):
    particles.write(lammps.path("box.data"))
    return (header(particles.dim, newton) + "read_data box.data\n" + model
            + f"fix FLUID all sph/bulk {integrator}\ntimestep {timestep}\n")


# ---- force and heat ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("dim, options", [(1, ""), (2, ""), (2, "shear none"), (2, "volume mass shear morris bulk volume"), (3, "shear mg/fr"),
                                          (2, "simd none eos tait")])
@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "off")])
def test_force_and_heat_of_each_particle(lammps, dim, options, ranks, newton):
    """-b V (u - U) and b V |u - U|^2, of two types with drags of their own, in total, by channel, and by particle."""
    mu = 0.0 if "none" in options else 0.5
    rc, drags = SUPPORT[dim], {1: (0.4, np.array([0.2, -0.1, 0.3 * (dim == 3)])), 2: (0.9, np.array([-0.5, 0.0, 0.0]))}
    particles = disordered(dim, {1: 40, 2: 12, 3: 6}[dim], ntypes=2)
    base = [f"pair_coeff {k} {k} {1.0 + 0.1 * k} 10.0 {mu} 2.0 {rc}" for k in drags]
    models = {"plain": base, "drag": [line + f" drag {b} {U[0]} {U[1]} {U[2]}" for line, (b, U) in zip(base, drags.values())]}
    text = start(particles, lammps, "", newton=newton)
    for name, lines in models.items():
        text += (f"pair_style sph/bulk dim {dim} {options}\n" + "\n".join(lines) + "\n" + HEAT
                 + f"thermo_style custom step c_Q {CHANNELS}\n" + FULL + dump(name, extra="c_Q") + "run 0 post no\n" + undump()
                 + "thermo_style one\nuncompute Q\npair_style none\n")
    tables = [table for table in lammps(text, ranks=ranks).thermo() if "c_Q" in table]
    plain, drag = lammps.frame("plain"), lammps.frame("drag")
    b = np.array([drags[k][0] for k in drag["type"].astype(int)])
    slip = drag["v"] - np.array([drags[k][1] for k in drag["type"].astype(int)])
    force = -(b * drag["vol"])[:, None] * slip
    heat = b * drag["vol"] * (slip**2).sum(axis=1)
    assert relative(drag["f"] - plain["f"] - force, drag["f"]) < 1e-13
    assert relative(drag["c_Q"] - plain["c_Q"] - heat, heat) < 1e-12
    assert relative(drag["desph"] - plain["desph"] - heat, drag["desph"]) < 1e-12
    assert tables[1]["c_Q[5]"][0] == pytest.approx(heat.sum(), rel=1e-12) and tables[0]["c_Q[5]"][0] == 0.0
    for k in range(1, 5):
        assert tables[1][f"c_Q[{k}]"][0] == pytest.approx(tables[0][f"c_Q[{k}]"][0], rel=1e-12)
    assert tables[1]["c_Q"][0] == pytest.approx(sum(tables[1][f"c_Q[{k}]"][0] for k in range(1, 6)), rel=1e-12)


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("options", ["", "temp 0.3 4711"])
def test_stress_is_of_pairs(lammps, newton, options):
    """The drag is no force between particles: pressure and stress are those without it; fix adapt switches it on."""
    particles, columns = disordered(2, 12), ("Press", "Pxx", "Pyy", "Pxy")
    tables = []
    for keywords in ("", "drag 5 3 -2 0", "drag 0 3 -2 0"):
        mu = 0.5 if not options else 0.0
        model = f"pair_style sph/bulk {options}\npair_coeff * * 1.0 10.0 {mu} 2.0 {SUPPORT[2]} {keywords}\n"
        text = start(particles, lammps, model, newton=newton)
        if keywords.startswith("drag 0"):
            text += "variable b equal 5\nfix A all adapt 1 pair sph/bulk drag * * v_b\n"
        text += "thermo_style custom step temp press pxx pyy pxy\n" + FULL + "run 0\n"
        tables.append(lammps(text).thermo()[-1])
    for column in columns:
        for table in tables[1:]:
            assert table[column][0] == pytest.approx(tables[0][column][0], rel=1e-12, abs=1e-12 * abs(tables[0]["Press"][0]))


def test_stress_is_of_pairs_in_hybrid(lammps):
    particles = disordered(2, 12)
    tables = []
    for keywords in ("", "drag 5 3 -2 0"):
        model = f"pair_style hybrid sph/bulk\npair_coeff * * sph/bulk 1.0 10.0 0.5 2.0 {SUPPORT[2]} {keywords}\n"
        tables.append(lammps(start(particles, lammps, model) + "thermo_style custom step press pxx pyy pxy\n" + FULL + "run 0\n").thermo()[-1])
    for column in ("Press", "Pxx", "Pyy", "Pxy"):
        assert tables[1][column][0] == pytest.approx(tables[0][column][0], rel=1e-12, abs=1e-12 * abs(tables[0]["Press"][0]))


def test_minimization_has_no_drag(lammps):
    particles = disordered(2, 12)
    forces = []
    for keywords in ("", "drag 5 3 -2 0"):
        model = f"pair_style sph/bulk\npair_coeff * * 1.0 10.0 0.5 2.0 {SUPPORT[2]} {keywords}\n"
        lammps(start(particles, lammps, model) + dump("f") + "minimize 0 0 3 3\n")
        forces.append(lammps.frame("f")["f"])
    assert relative(forces[1] - forces[0], forces[0]) < 1e-12


def test_particles_with_spin(lammps):
    """On velocities only."""
    particles = disordered(2, 12, spread=0.0)
    micro.write(particles, lammps.path("box.data"))
    found = {}
    for name in ("", DRAG):
        style, coeff = micro.fluid(2).splitlines()
        lammps(header(2, style="sph/micropolar") + f"read_data box.data\n{style}\n{coeff} {name}\n" + micro.integrate() + HEAT
               + f"thermo_style custom step {CHANNELS}\n" + FULL + micro.dump("f.dump") + "run 0\n")
        found[name] = lammps.frame("f.dump"), lammps.results[-1].thermo()[0]
    (plain, before), (drag, table) = found.values()
    assert relative(drag["f"] - plain["f"] + B * drag["c_G[2]"][:, None] * (drag["v"] - np.array(STREAM)), drag["f"]) < 1e-13
    assert relative(micro.vector(drag, "tqx", "tqy", "tqz") - micro.vector(plain, "tqx", "tqy", "tqz"), drag["f"]) < 1e-13
    assert table["c_Q[5]"][0] > 0.1 and table["c_Q[4]"][0] == pytest.approx(before["c_Q[4]"][0], rel=1e-13)


# ---- known motions -----------------------------------------------------------------------------------------------


def uniform(lammps, integrator, timestep, keywords, end=3.2, before="", ranks=1, mu=0.5, c0=10.0):
    """A fluid in uniform motion: velocity, momentum, and energy in time."""
    particles = lattice(2, 8)
    particles.v[:, :2] = 1.0, 0.3
    steps = round(end / timestep)
    text = start(particles, lammps, fluid(2, mu=mu, keywords=keywords, c0=c0), f"density rho0 {integrator}", timestep)
    text += before + HEAT + MOMENTUM + "variable m equal mass(all)\ncompute E all sph/energy\n"
    text += "thermo_style custom step time ke c_E v_px v_py v_m c_Q[5]\nthermo 1\n" + FULL + f"run {steps}\n"
    return lammps(text, ranks=ranks).thermo()[-1]


MODES = ["", "viscous rkl2", "viscous implicit tolerance 1e-12"]


@pytest.mark.parametrize("integrator", MODES)
def test_uniform_motion_decays_toward_the_stream(lammps, integrator):
    """exp(-b t/rho), to second order in the time step; the energy is that which the stream has given, U.(change of the momentum)."""
    U = np.array(STREAM[:2])
    errors, accounts = [], []
    for timestep in (0.02, 0.01):
        table = uniform(lammps, integrator, timestep, DRAG)
        momentum = np.column_stack([table["v_px"], table["v_py"]])
        mass = table["v_m"][0]
        exact = mass * (U + (np.array([1.0, 0.3]) - U) * np.exp(-B * table["Time"])[:, None])
        errors.append(np.abs(momentum - exact).max() / mass)
        given = (momentum - momentum[0]) @ U
        accounts.append(np.abs(table["c_E"] - table["c_E"][0] - given).max() / table["KinEng"][0])
    print(errors, accounts)
    assert errors[1] < 1e-5
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)
    assert accounts[1] < 1e-5
    slip = momentum[-1] / mass - U
    heat = B * 64.0 * slip @ slip  # the volume is that of the box
    assert table["c_Q[5]"][-1] == pytest.approx(heat, rel=0.01)


@pytest.mark.parametrize("integrator", MODES)
@pytest.mark.parametrize("b, timestep", [(0.4, 0.02), (400.0, 0.02)])
def test_driven_flow_reaches_its_speed(lammps, integrator, b, timestep):
    """U + g rho/b, also with b dt/rho = 8, for which the explicit step is not stable."""
    if b > 1.0 and not integrator:
        pytest.skip("unstable")
    table = uniform(lammps, integrator, timestep, f"drag {b} 0.2 -0.1 0", before="fix G all gravity 2.0 vector 1 0 0\n",
                    end=40.0 if b < 1.0 else 2.0)
    assert table["v_px"][-1] / table["v_m"][-1] == pytest.approx(0.2 + 2.0 / b, rel=1e-5)
    assert table["v_py"][-1] / table["v_m"][-1] == pytest.approx(-0.1, rel=1e-5)


@pytest.mark.parametrize("integrator", ["", "viscous implicit tolerance 1e-10"])
@pytest.mark.parametrize("ranks", [1, 2])
def test_channel_of_a_porous_medium(lammps, integrator, ranks):
    """mu u'' = b u - rho g between two walls: cosh profile (Brinkman); drag and walls carry the weight."""
    if integrator and ranks > 1:
        pytest.skip("ranks are covered by the explicit step")
    height, mu, b, g = 16.0, 1.0, 0.06, 0.01
    particles = lattice(2, (8, 22))
    particles.x[:, 1] -= 3.0
    particles.lo[1], particles.hi[1] = -4.0, 20.0
    particles.write(lammps.path("box.data"))
    text = (header(2, boundary="p f p") + "read_data box.data\nregion FLUID block INF INF 0 16 INF INF units box\n"
            "group fluid region FLUID\ngroup wall subtract all fluid\n"
            + fluid(2, mu=mu, kappa=3.0, keywords=f"drag {b} 0 0 0")
            + f"fix FLUID fluid sph/bulk {integrator}\nfix W wall sph/wall\nfix G fluid gravity {g} vector 1 0 0\n" + HEAT
            + f"thermo_style custom step ke f_W[1] c_Q[5]\nthermo 500\ntimestep 0.03\n" + FULL + dump("f.dump", 3000) + "run 3000\n")
    table = lammps(text, ranks=ranks).thermo()[-1]
    frame = lammps.frame("f.dump")
    wet = (frame["y"] > 0.0) & (frame["y"] < height)
    y, u, volume = frame["y"][wet], frame["v"][wet, 0], frame["vol"][wet]
    scale = np.sqrt(b / mu)
    exact = g / b * (1.0 - np.cosh(scale * (y - height / 2)) / np.cosh(scale * height / 2))
    assert relative(u - exact, exact) < 0.04  # three spacings of a square lattice
    assert table["c_Q[5]"][-1] == pytest.approx((b * volume * u**2).sum(), rel=1e-5)  # of the velocity that forces have seen
    carried = table["f_W[1]"][-1] + (b * volume * frame["vest"][wet, 0]).sum()
    assert carried + frame["f"][wet, 0].sum() == pytest.approx(g * wet.sum(), rel=1e-11)


# ---- noise -------------------------------------------------------------------------------------------------------


def noisy(lammps, particles, temperature, mu=0.0, dim=2, timestep=0.1, steps=0, style=DRAG, ranks=1, extra=""):
    kappa = "intrinsic" if mu == 0.0 else 3.0
    model = fluid(dim, f"temp {temperature} 4711", mu=mu, kappa=kappa, keywords=style, c0=10.0)
    return lammps(start(particles, lammps, model, timestep=timestep) + extra + f"run {steps}\n", ranks=ranks)


def random_force(lammps, particles, dim=2, ranks=1, mu=0.0, steps=0):
    forces = []
    for temperature in (2.0, 0.0):
        noisy(lammps, particles, temperature, dim=dim, mu=mu, extra=f"reset_timestep {steps}\n" + dump("f.dump"), ranks=ranks)
        forces.append(lammps.frame("f.dump"))
    return forces[0]["f"] - forces[1]["f"], forces[0]["vol"]


@pytest.mark.parametrize("dim, cells", [(2, 60), (3, 15)])
def test_covariance_of_the_impulses(lammps, dim, cells):
    """2 kT b dt V for each component, none between components, particles next to each other, and steps: within 5 sigma."""
    particles = disordered(dim, cells, jitter=0.1)
    force, volume = random_force(lammps, particles, dim)
    later, _ = random_force(lammps, particles, dim, steps=1)
    assert np.all(force[:, dim:] == 0.0)
    unit = np.sqrt(2.0 * 2.0 * B * volume / 0.1)[:, None]
    number, later = (force / unit)[:, :dim], (later / unit)[:, :dim]
    count = number.size
    assert abs(number.mean()) < 5.0 / np.sqrt(count)
    assert abs((number**2).mean() - 1.0) < 5.0 * np.sqrt(0.8 / count)  # of a uniform distribution
    products = [number * later, number[1:] * number[:-1]] + [number[:, k] * number[:, 0] for k in range(1, dim)]
    for product in products:
        assert abs(product.mean()) < 5.0 / np.sqrt(product.size)


def test_same_noise_on_any_number_of_ranks(lammps):
    particles = disordered(2, 12)
    one, _ = random_force(lammps, particles)
    two, _ = random_force(lammps, particles, ranks=2)
    assert relative(one - two, one) < 1e-13


@pytest.mark.parametrize("mu", [0.0, 0.3])
def test_temperature(lammps, mu):
    """Particles that only the drag and its noise hold at a temperature, in a stream; with viscosity as well."""
    particles = lattice(2, 16)
    table = noisy(lammps, particles, 2.0, mu=mu, timestep=0.02, steps=4000, style="drag 2.0 0.5 0 0",
                  extra=MOMENTUM + "thermo_style custom step ke v_px v_py\nthermo 20\n" + FULL).thermo()[-1]
    late = table["Step"] > 500
    motion = table["KinEng"] - 0.5 * table["v_px"] + 0.5 * len(particles) * 0.25
    temperature = motion[late] / len(particles)
    assert temperature.mean() == pytest.approx(2.0, rel=0.02)
    assert table["v_px"][late].mean() / len(particles) == pytest.approx(0.5, abs=5 * np.sqrt(2.0 / len(particles) / 70))


# ---- files, types, other commands --------------------------------------------------------------------------------


@pytest.mark.parametrize("ranks", [1, 2])
def test_restart_and_data_files(lammps, ranks):
    particles = disordered(2, 12, ntypes=2, jitter=0.1)
    coeff = "".join(f"pair_coeff {k} {k} 1.0 10.0 0.5 2.0 3.0 drag {b} 0.123456789012345 -0.1 0\n" for k, b in ((1, 0.4), (2, 0.0)))
    model = fluid(2, "temp 0.3 4711", coeff=coeff)
    lammps(start(particles, lammps, model) + "run 10\nwrite_restart state.restart\nwrite_data state.data pair ii\nwrite_data pairs.data pair ij\n"
           + dump("whole.dump", 10) + "run 10\n", ranks=ranks)
    lammps("read_restart state.restart\n" + INTEGRATE + dump("parts.dump", 10) + "run 10\n", ranks=ranks)
    whole, parts = lammps.frame("whole.dump"), lammps.frame("parts.dump")
    assert np.abs(whole["x"] - parts["x"]).max() < 1e-12 and relative(whole["f"] - parts["f"], whole["f"]) < 1e-11
    assert lammps.path("state.data").read_text().count(" drag 0.4") == 1
    for name in ("state", "pairs"):
        forces = []
        for again in ("", coeff):
            lammps(header(2) + f"pair_style sph/bulk temp 0.3 4711\nread_data {name}.data\n" + again + INTEGRATE + dump("data.dump") + "run 0\n")
            forces.append(lammps.frame("data.dump")["f"])
        assert relative(forces[0] - forces[1], forces[0]) == 0.0


def test_hybrid_styles(lammps):
    """Together with another style, and with particles that are not of the fluid."""
    particles = disordered(2, 12, ntypes=2)
    found = {}
    for words in ("", DRAG):
        model = ("pair_style hybrid/overlay sph/bulk soft 1.2\n"
                 f"pair_coeff 1 1 sph/bulk 1.0 10.0 0.5 2.0 3.0 {words}\npair_coeff * 2 soft 5.0\n")
        lammps(start(particles, lammps, model).replace("fix FLUID all", "group fluid type 1\ngroup rest type 2\nfix N rest nve\nfix FLUID fluid")
               + dump("f.dump") + "run 0\n")
        found[words] = lammps.frame("f.dump")
    plain, drag = found.values()
    force = -B * drag["vol"][:, None] * (drag["v"] - np.array(STREAM)) * (drag["type"] == 1)[:, None]
    assert relative(drag["f"] - plain["f"] - force, force) < 1e-12


def test_adapt(lammps):
    """The first number may vary, also from zero."""
    particles = disordered(2, 12)
    frames = []
    for words, adapt in (("drag 0.7 0.2 -0.1 0", ""), ("drag 0 0.2 -0.1 0", "variable b equal 0.7\nfix A all adapt 1 pair sph/bulk drag * * v_b\n")):
        lammps(start(particles, lammps, fluid(2, keywords=words)) + adapt + dump("f.dump", 10) + "run 10\n", ranks=2)
        frames.append(lammps.frame("f.dump"))
    assert relative(frames[0]["f"] - frames[1]["f"], frames[0]["f"]) < 1e-12
    bad = "variable b equal 0.4-0.1*step\nfix A all adapt 1 pair sph/bulk drag * * v_b\n"
    result = lammps(start(particles, lammps, fluid(2, keywords=DRAG)) + bad + "run 10\n", check=False)
    assert "drag must be >= 0, not -0." in result.error


def test_table_and_time_step(lammps):
    """The rate b/rho is in the table and in fix sph/dt; without drag there is no column."""
    particles = lattice(2, 8)
    log = lammps(start(particles, lammps, fluid(2), "density rho0") + "run 0\n").log
    assert "drag" not in re.search(r"types .*largest stable.*", log)[0]
    text = start(particles, lammps, fluid(2, mu=0.0, kappa=0.0, keywords="drag 300 0 0 0"), "density rho0", timestep=0.002)
    log = lammps(text + "fix T all sph/dt 1\nthermo_style custom step dt\nthermo 1\nrun 2\n").log
    names, numbers = re.search(r"( types .*)\n(.*)\n", log).groups()
    columns = dict(zip(names.replace("largest stable time step:", "").replace("|", "").split(), numbers.replace("|", "").split()))
    assert float(columns["all"]) == pytest.approx(0.9 / 300, rel=1e-3)
    values, steps = names.split("|")
    assert values.split().count("drag") == 1 and steps.split().count("drag") == 1
    assert lammps.results[-1].thermo()[-1]["Dt"][-1] == pytest.approx(0.9 / 300, rel=1e-3)
    assert any("exceeds the largest stable time step" in line
               for line in lammps(text + "timestep 0.004\nrun 0\n").warnings)


# ---- bad input ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("line, message", [
    ("pair_coeff * * 1.0 10.0 0.5 2.0 3.0 drag", "Illegal pair_coeff drag command: missing argument"),
    ("pair_coeff * * 1.0 10.0 0.5 2.0 3.0 drag 0.1 0 0", "Illegal pair_coeff drag command: missing argument"),
    ("pair_coeff * * 1.0 10.0 0.5 2.0 3.0 drag -0.1 0 1 0", "Pair_coeff drag must be >= 0, not -0.1 0 1 0"),
    ("pair_coeff * * 1.0 10.0 0.5 2.0 3.0 drag 0.1 0 0 1", "Pair_coeff drag must have a stream of Uz = 0 in 2d, not 0.1 0 0 1"),
    ("pair_coeff * * 1.0 10.0 0.5 2.0 3.0 drag 0.1 0 0 pb", "Expected floating point parameter"),
    ("pair_coeff * * 1.0 10.0 0.5 2.0 3.0 drags 0.1 0 0 0", "Unknown pair_coeff keyword for pair_style sph/bulk: drags"),
    ("pair_coeff 1 2 drag 0.1 0 0 0", "Pair_coeff keyword drag belongs to a type, not to a pair of types"),
])
def test_bad_input(lammps, line, message):
    disordered(2, 6, ntypes=2).write(lammps.path("box.data"))
    result = lammps(header(2) + "read_data box.data\npair_style sph/bulk\n" + line + "\n", check=False)
    assert result.code and message in result.error, result.error


def test_noise_on_a_line_is_refused(lammps):
    model = fluid(1, "temp 0.3 4711", keywords="drag 0.4 0.2 0 0")
    result = lammps(start(lattice(1, 40), lammps, model) + "run 0\n", check=False)
    assert "Pair style sph/bulk temp with dim 1 cannot be used with a drag of single particles" in result.error


def test_temperatures_of_the_particles_are_refused(lammps):
    particles = lattice(2, 8)
    model = fluid(2, "temp energy 10.0 4711", keywords=DRAG)
    result = lammps(start(particles, lammps, model) + "run 0\n", check=False)
    assert "Pair style sph/bulk temp energy cannot be used with a drag of single particles" in result.error
