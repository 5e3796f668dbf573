"""Keyword viscous of fix sph/bulk and fix sph/micropolar: large viscosities at the acoustic time step.

That a step is the one of the dense friction matrix is tested in unittest/cpp/test_viscous.cpp.
"""


import numpy as np
import pytest

import open_boundaries as ends
import test_micropolar as micro
import test_open_ledger as ledger
import test_wall as walls
from helpers import disordered, drop, dump, fluid, free, header, lattice, relative

RKL2 = "viscous rkl2"
SCHEMES = {"rkl2": RKL2, **{scheme: f"viscous implicit scheme {scheme}" for scheme in ("trapezoidal", "sdirk2", "euler")}}
SECOND_ORDER = ["rkl2", "trapezoidal", "sdirk2"]
STATISTICS = " ".join(f"f_FLUID[{k}]" for k in (1, 2, 3, 4))
FULL = "thermo_modify norm no format float %.17g\n"
SOUND_STEP = 0.0478  # 0.25 h/c0 of the line of particles with c0 = 10, printed by the pair style


def integrate(keywords, style="sph/bulk", group="all"):
    return f"fix FLUID {group} {style} {keywords}\n"


def thermo(columns="", every=1):
    return f"thermo_style custom step {columns}\nthermo {every}\n" + FULL


# ---- accuracy ----------------------------------------------------------------------------------------------------


def pulse(lammps, keywords, timestep, kappa, end=96 * SOUND_STEP):
    """Velocity of a sound pulse of 256 particles at the end."""
    particles = lattice(1, 256)
    particles.v[:, 0] = 0.1 * np.exp(-0.5 * ((particles.x[:, 0] - 128.0) / 8.0) ** 2)
    particles.write(lammps.path("box.data"))
    steps = round(end / timestep)
    lammps(header(1) + "read_data box.data\n" + fluid(1, kappa=kappa) + integrate(f"density rho0 {keywords}")
           + f"timestep {timestep}\n" + dump("out.dump", steps) + f"run {steps}\n")
    return lammps.frame("out.dump")["v"][:, 0]


@pytest.mark.parametrize("kappa", [20.0, 200.0])
def test_sound_pulse_at_the_acoustic_step(lammps, kappa):
    """Against the explicit step a hundred times shorter: within 3e-4, and four times nearer at half the step."""
    expected = pulse(lammps, "", SOUND_STEP / 100, kappa)
    for name in SECOND_ORDER:
        precise = "" if name == "rkl2" else " tolerance 1e-8"
        error = [np.linalg.norm(pulse(lammps, SCHEMES[name] + precise, step, kappa) - expected)
                 / np.linalg.norm(expected) for step in (SOUND_STEP, SOUND_STEP / 2, SOUND_STEP / 4)]
        print(f"{name}: {error}")
        assert error[0] < 3e-4
        assert error[1] / error[2] == pytest.approx(4.0, rel=0.1), name
    error = [np.linalg.norm(pulse(lammps, SCHEMES["euler"], step, kappa) - expected) for step in (SOUND_STEP / 2, SOUND_STEP / 4)]
    assert error[0] / error[1] == pytest.approx(2.0, rel=0.1)


def stiff(lammps, keywords, steps=10, mu=1000.0, kappa=10000.0):
    """Sizes of the velocity after each step, from random ones; all rates are larger than 1 over the time step."""
    disordered(2, 12, spread=0.04).write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\n" + fluid(2, mu=mu, kappa=kappa, c0=0.01)
           + integrate(keywords) + "timestep 0.05\n" + dump("out.dump") + f"run {steps}\n")
    size = np.array([np.linalg.norm(frame["v"] - frame["v"].mean(axis=0)) for frame in lammps.frames("out.dump")])
    return size / size[0]


def test_stiff_start(lammps):
    """All steps damp; those that are L-stable damp the fast modes at once, the trapezoidal one hardly."""
    left = {name: stiff(lammps, keywords) for name, keywords in SCHEMES.items()}
    for name, size in left.items():
        print(name, size)
        assert np.all(np.diff(size[:6]) < 0.0), name
    for name in ("sdirk2", "euler"):
        assert left[name][10] < 0.01 * left["trapezoidal"][10]


@pytest.mark.parametrize("name", SECOND_ORDER)
def test_shear_waves_do_not_notice_kappa(lammps, name):
    def amplitude(kappa):
        particles = lattice(2, 24)
        wave = np.sin(2 * np.pi * particles.x[:, 1] / 24)
        particles.v[:, 0] = 1e-3 * wave
        particles.write(lammps.path("box.data"))
        lammps(header(2) + "read_data box.data\n" + fluid(2, mu=0.5, kappa=kappa)
               + integrate(f"density rho0 {SCHEMES[name]}") + "timestep 0.03\n" + dump("out.dump", 200) + "run 200\n")
        return 2e3 * np.mean(lammps.frame("out.dump")["v"][:, 0] * wave)

    one, thousand = amplitude(1.0), amplitude(500.0)
    assert 0.5 < one < 0.9  # it decays by exp(-0.21)
    assert thousand == pytest.approx(one, rel=1e-4)


# ---- forces of other styles --------------------------------------------------------------------------------------

ROWS = 16       # of the driven flows; in channels, of the fluid
STEP = 0.0375   # of sound; the friction is seven times as fast as explicit steps allow
EXPLICIT = 0.004
MICRO = micro.STYLE
WAVE = f"variable w atom 0.01*sin(2*PI*y/{ROWS})\nfix B all addforce v_w 0 0\n"
RINGS = f"variable c atom 0.01*(1+cos(2*PI*y/{ROWS}))\nfix T all sph/torque 0 0 v_c\n"
GRAVITY = "fix B fluid gravity 1.0 vector 1 0 0\n"
ONE_BY_ONE = "label a\nvariable i loop {}\nrun 1\nnext i\njump SELF a\n"


def in_runs_of_one(steps):
    return ONE_BY_ONE.format(steps)


def driven(lammps, keywords, timestep, end, particles, fluid, after, style="sph/bulk", group="all", boundary="p p p", before="",
           run="run {}\n".format):
    """Velocities at the end, with spins; from rest or what particles have."""
    if style == MICRO:
        micro.write(particles, lammps.path("box.data"), omega=np.zeros((len(particles), 3)))
    else:
        particles.write(lammps.path("box.data"))
    spin = "omegax omegay omegaz" if style == MICRO else ""
    lammps(header(2, style=style, boundary=boundary) + "read_data box.data\n" + before + fluid + integrate(keywords, style, group)
           + after + f"timestep {timestep}\n" + run(round(end / timestep)) + dump("out.dump", extra=spin) + "run 0\n")
    frame = lammps.frame("out.dump")
    return np.column_stack([frame["v"][:, :2], *([frame["omegaz"]] if spin else [])])


def shear_wave(lammps, keywords, timestep, end, after=WAVE, **settings):
    return driven(lammps, keywords, timestep, end, lattice(2, (8, ROWS)), fluid(2, mu=18.0, kappa=40.0), after, **settings)


def spinning(lammps, keywords, timestep, end, **settings):
    """Force and torque in waves, and a mean torque."""
    return driven(lammps, keywords, timestep, end, lattice(2, (8, ROWS)), micro.fluid(2, mu=18.0, kappa=40.0, mu_r=9.0, gamma1=2.0),
                  WAVE + RINGS, style=MICRO, **settings)


def channel(lammps, keywords, timestep, end, after=GRAVITY, wall="", **settings):
    particles = lattice(2, (7, 16))
    height = particles.x[:, 1]
    particles, owner = walls.arrange(particles, [height < 3.0, height > 13.0])
    found = driven(lammps, keywords, timestep, end, particles, fluid(2, mu=18.0, kappa=40.0), f"fix W0 wall0 sph/wall {wall}\n"
                   "fix W1 wall1 sph/wall\n" + after, group="fluid", boundary="p f p", before=walls.groups(owner), **settings)
    return found[owner < 0]


@pytest.mark.parametrize("flow, end, precision", [(shear_wave, 6.0, 2e-5), (spinning, 5.0, 3e-5), (channel, 9.0, 4e-4)])
def test_steady_velocity(lammps, flow, end, precision):
    """That of the explicit step, at the time step of sound, for every scheme: fluid under a force, a torque, and between walls."""
    expected = flow(lammps, "", 0.001 if flow is spinning else EXPLICIT, end)
    for name, keywords in SCHEMES.items():
        precise = "" if name == "rkl2" else " tolerance 1e-9"
        found = flow(lammps, keywords + precise, STEP, end)
        error = relative(found - expected, expected)
        print(name, error)
        assert error < precision, name


def second_order(lammps, flow, stages=5, **settings):
    """Errors at two time steps, against the explicit one at much shorter ones; four times less at half the step."""
    fine, finer = (flow(lammps, "", step, 0.3, **settings) for step in (0.001, 0.0005))
    expected = finer + (finer - fine) / 3.0
    for name in SECOND_ORDER:
        precise = f" stages {stages}" if name == "rkl2" else " tolerance 1e-10"
        errors = [np.linalg.norm(flow(lammps, SCHEMES[name] + precise, step, 0.3, **settings) - expected) / np.linalg.norm(expected)
                  for step in (0.02, 0.01)]
        print(name, errors)
        assert errors[0] < 0.01 and errors[0] > 3.3 * errors[1], name


def soft(lammps, keywords, timestep, end, fluid=None, after="", **settings):
    """A disturbed lattice with a shear wave."""
    particles = lattice(2, 10)
    particles.v[:, 0] = 0.1 * np.sin(2 * np.pi * particles.x[:, 1] / 10)
    particles.x[:, 0] += 0.05 * np.sin(2 * np.pi * particles.x[:, 0] / 10)
    return driven(lammps, keywords, timestep, end, particles, fluid or STIFF, after, **settings)


STIFF = fluid(2, mu=18.0, kappa=40.0)
OVERLAY = ("pair_style hybrid/overlay sph/bulk dim 2 soft 2.5\npair_coeff * * sph/bulk 1.0 10.0 18.0 40.0 3.0\n"
           "pair_coeff * * soft 5.0\n")
IN_TIME = "variable a equal 1+sin(6*time)\nfix B all addforce v_a 0 0\n"


@pytest.mark.parametrize("flow, settings", [
    (shear_wave, {}),
    (channel, {"wall": "velocity v_u 0 0", "after": "variable u equal 0.2*sin(6*time)\n" + GRAVITY}),
    (channel, {"after": IN_TIME.replace("all", "fluid"), "stages": 7}),
    (soft, {"fluid": OVERLAY}),
    (soft, {"after": "fix S all spring/self 20.0\n"}),
    (soft, {"after": "group some id 1:20\nfix S some setforce 0 0 0\n"}),
], ids=["force", "moving wall", "force in time", "other pair style", "springs", "no force on some"])
def test_second_order_with_forces_of_other_styles(lammps, flow, settings):
    second_order(lammps, flow, **settings)


def test_second_order_with_torques(lammps):
    second_order(lammps, spinning, stages=11)


def test_many_short_runs_are_of_second_order(lammps):
    """The first half step of a run does not know the forces of other styles."""
    second_order(lammps, shear_wave, run=in_runs_of_one)


@pytest.mark.parametrize("name", SCHEMES)
def test_runs_go_on(lammps, name):
    """Without setup, as a second run, and from a restart file, with new neighbor lists in between; equal coefficients that a
    command gives again are no change."""
    particles = disordered(2, 12, spread=0.04)
    micro.write(particles, lammps.path("box.data"), inertia=0.05)
    forces = "variable w atom sin(2*PI*y/12)\nfix B all addforce v_w 0 0\nfix T all sph/torque 0 0 v_w\nneighbor 0.1 bin\n"
    model = micro.fluid(2, mu=5.0, kappa=50.0, mu_r=2.0, gamma1=0.5)
    start = header(2, style=MICRO) + "read_data box.data\n" + model
    fixes = integrate(SCHEMES[name] + ("" if name == "rkl2" else " tolerance 1e-13"), MICRO) + forces + "timestep 0.02\n"
    v = {}
    for key, text in (("one", "run 12\n"), ("no setup", "run 5\nrun 7 pre no\n"), ("two", "run 5\nrun 7\n"), ("again", f"run 5\n{model}run 7\n"),
                      ("file", "run 5\nwrite_restart half.restart\n")):
        lammps(start + fixes + text + micro.dump("out.dump") + "run 0\n")
        v[key] = np.column_stack([lammps.frame("out.dump")["v"], micro.omega_of(lammps.frame("out.dump"))])
    for words in ("", model):
        lammps(f"read_restart half.restart\n{words}{fixes}run 7\n{micro.dump('out.dump')}run 0\n", ranks=2)
        again = np.column_stack([lammps.frame("out.dump")["v"], micro.omega_of(lammps.frame("out.dump"))])
        assert relative(again - v["one"], v["one"]) < 1e-11
    assert relative(v["no setup"] - v["one"], v["one"]) < 1e-13
    assert relative(v["two"] - v["one"], v["one"]) < 1e-11
    assert relative(v["again"] - v["one"], v["one"]) < 1e-11


def test_hybrid_goes_on_with_the_same_coefficients(lammps):
    """After a restart file, which pair_style hybrid leaves without coefficients."""
    disordered(2, 12, spread=0.04).write(lammps.path("box.data"))
    style = "pair_style hybrid/overlay zero 3.0 sph/bulk temp 0.01 4711\n"
    coeffs = "pair_coeff * * sph/bulk 1.0 10.0 5.0 50.0 3.0\npair_coeff * * zero\n"
    fixes = "fix 1 all sph/bulk viscous implicit tolerance 1e-13\ntimestep 0.02\n"
    lammps(header(2) + "read_data box.data\n" + style + coeffs + fixes + "run 5\nwrite_restart half.restart\nrun 7\n" + dump("out.dump") + "run 0\n")
    whole = lammps.frame("out.dump")["v"]
    lammps(f"read_restart half.restart\n{coeffs}{fixes}run 7\n{dump('out.dump')}run 0\n")
    assert relative(lammps.frame("out.dump")["v"] - whole, whole) < 1e-11


# ---- conservation ------------------------------------------------------------------------------------------------


def momenta(frame):
    x, p = frame["x"], frame["mass"][:, None] * frame["v"]
    return p.sum(0), np.cross(x, p).sum(0), np.linalg.norm(p, axis=1).sum(), np.linalg.norm(np.cross(x, p), axis=1).sum()


@pytest.mark.parametrize("name", SCHEMES)
@pytest.mark.parametrize("dim, options", [(2, ""), (2, "bulk volume"), (3, "volume mass"), (3, "shear none")])
def test_momentum_and_energy_of_a_drop_at_a_coarse_tolerance(lammps, name, dim, options):
    """In every step, to round-off: the friction acts between pairs, however wrong its velocities may be."""
    drop(dim, 6.0 if dim == 2 else 3.2).write(lammps.path("box.data"))
    coarse = "" if name == "rkl2" else " tolerance 1e-2"
    mu = 0.0 if "none" in options else 0.5
    lammps(header(dim, boundary=free(dim)) + "read_data box.data\n" + fluid(dim, options, mu=mu, kappa=500.0)
           + integrate(SCHEMES[name] + coarse) + "timestep 0.01\ncompute E all sph/energy\n"
           + thermo(f"c_E {STATISTICS}") + dump("out.dump") + "run 50\n")
    frames = lammps.frames("out.dump")
    for before, after in zip(frames, frames[1:]):
        p, l, p_size, l_size = momenta(before)
        q, k, _, _ = momenta(after)
        assert np.abs(q - p).max() < 1e-13 * p_size
        assert np.abs(k - l).max() < 1e-13 * l_size
    energy = lammps.results[-1].thermo()[0]["c_E"]
    assert np.abs(np.diff(energy)).max() < 1e-12 * energy[0]
    assert np.abs(energy - energy[0]).max() < 1e-11 * energy[0]


@pytest.mark.parametrize("name", SCHEMES)
def test_micropolar_drop(lammps, name):
    dim = 2
    particles = drop(dim, 6.0)
    micro.write(particles, lammps.path("box.data"), inertia=0.05)
    coarse = "" if name == "rkl2" else " tolerance 1e-2"
    lammps(header(dim, boundary=free(dim), style=micro.STYLE) + "read_data box.data\n"
           + micro.fluid(dim, mu=5.0, kappa=500.0, mu_r=4.0, gamma1=0.5)
           + integrate(SCHEMES[name] + coarse, micro.STYLE)
           + "timestep 0.01\ncompute E all sph/energy\ncompute L all sph/angmom\ncompute Q all sph/dissipation\n"
           + thermo("c_E c_L[*] c_Q[*]") + "run 50\n")
    table = lammps.results[-1].thermo()[0]
    assert np.abs(np.diff(table["c_E"])).max() < 1e-12 * table["c_E"][0]
    scale = np.abs(table["c_L[3]"]).max()
    assert scale > 1.0 and np.abs(table["c_L[3]"] - table["c_L[3]"][0]).max() < 1e-11 * scale
    for k in range(1, 5):
        assert np.all(table[f"c_Q[{k}]"] > 0.0)


@pytest.mark.parametrize("name", ["trapezoidal", "euler"])
def test_friction_heats_in_every_step(lammps, name):
    """Without pressure to speak of, the heat of a step is that of the friction."""
    disordered(2, 12, spread=0.04).write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\n" + fluid(2, mu=5.0, kappa=500.0, c0=1e-6)
           + integrate(SCHEMES[name] + " tolerance 1e-9")
           + "timestep 0.01\ncompute e all property/atom esph\ncompute H all reduce sum c_e\n"
           + "compute Q all sph/dissipation\n"
           + thermo("c_H c_Q[1] c_Q[2]") + "run 30\n")
    table = lammps.results[-1].thermo()[0]
    assert np.all(np.diff(table["c_H"]) > 0.0)
    assert np.all(table["c_Q[1]"] > 0.0) and np.all(table["c_Q[2]"] > 0.0)


# ---- ranks, walls, open ends, noise ------------------------------------------------------------------------------


@pytest.mark.parametrize("name", SCHEMES)
def test_ranks(lammps, name):
    """20 steps with exchanges of atoms, at a tight tolerance."""
    disordered(2, 16, ntypes=2).write(lammps.path("box.data"))
    coeff = "pair_coeff 1 1 1.0 10.0 0.5 200.0 3.0\npair_coeff 2 2 1.1 12.0 0.2 100.0 3.0\n"
    tight = "" if name == "rkl2" else " tolerance 1e-14"
    x = {}
    for ranks, newton in ((1, "on"), (2, "on"), (4, "on"), (4, "off")):
        lammps(header(2, newton=newton) + "read_data box.data\n" + fluid(2, coeff=coeff)
               + integrate(SCHEMES[name] + tight) + WAVE + "timestep 0.01\n" + dump("out.dump", 20) + "run 20\n", ranks=ranks)
        x[ranks, newton] = lammps.frame("out.dump")["x"]
    first = x[1, "on"]
    moved = np.abs(first - lammps.frames("out.dump")[0]["x"]).max()
    assert moved > 0.02
    for key, other in x.items():
        assert np.abs(other - first).max() < 1e-12 * moved, key


def affine_force(lammps, before, after, group, axes):
    """F(0), and the matrix of F(u) of a group of particles, by explicit forces at rest and at one velocity each."""
    write = "write_dump all custom f.{}.dump id fx fy fz modify sort id format float %.17g\n"
    text = before + integrate("", group="fluid") + after
    text += "velocity fluid set 0 0 0\nrun 0\n" + write.format("rest")
    names = [f"{i + 1}{'xyz'[d]}" for i in group for d in range(axes)]
    for name in names:
        text += (f"velocity fluid set 0 0 0\nset atom {name[:-1]} v{name[-1]} 1.0\nrun 0\n" + write.format(name))
    lammps(text, timeout=300)
    force = {name: lammps.frame(f"f.{name}.dump")["f"][group][:, :axes].ravel() for name in ["rest", *names]}
    return force["rest"], np.array([force[name] - force["rest"] for name in names]).T


@pytest.mark.parametrize("wall, options", [("velocity 0.3 0.0 0.0 gravity 0.0 -1.0 0.0", ""), ("slip free", ""),
                                           ("velocity 0.3 0.0 0.0", "temp 0.0 1")])
def test_walls(lammps, wall, options):
    """The velocity goes on behind the wall, at once: against the dense solution with the matrix of the explicit forces.

    With noise, the wall has friction of its own instead, and the matrix is symmetric."""
    particles = lattice(2, (7, 12))
    random = np.random.default_rng(5)
    particles.x[:, :2] += random.uniform(-0.1, 0.1, (len(particles), 2))
    particles.v[:, :2] = random.normal(0.0, 0.5, (len(particles), 2))
    particles, owner = walls.arrange(particles, [(particles.x[:, 1] < 3.3) | (particles.x[:, 1] > 8.7)])
    particles.v[owner == 0] = 0.0
    particles.write(lammps.path("box.data"))
    group = np.flatnonzero(owner < 0)
    before = (header(2) + "read_data box.data\n" + walls.groups(owner) + fluid(2, options, kappa=200.0)
              + "neighbor 0.5 bin\n")
    after = f"fix W wall0 sph/wall {wall}\ntimestep 0.04\n"
    rest, matrix = affine_force(lammps, before, after, group, 2)
    mass = np.repeat(particles.mass[group], 2)
    v = particles.v[group, :2].ravel()
    asymmetry = relative(matrix - matrix.T, matrix)
    assert asymmetry < 1e-12 if options else asymmetry > 1e-3
    one, two = (np.linalg.solve(np.diag(mass) - part * matrix, mass * v + part * rest) for part in (0.03, 0.06))
    acting = 2.0 * one - two
    for name in ("trapezoidal", "euler")[:1 if options else 2]:
        lammps(before + integrate(SCHEMES[name] + " tolerance 1e-13", group="fluid") + after + dump("v.dump") + "run 0\n")
        force = lammps.frame("v.dump")["f"][group][:, :2].ravel()
        assert relative(force - rest - matrix @ acting, rest + matrix @ acting) < 1e-10, name



@pytest.mark.parametrize("name, style, options", [
    pytest.param(name, style, options, marks=[] if number % 2 == kind else pytest.mark.long)
    for number, name in enumerate(SCHEMES) for kind, (style, options) in enumerate([("sph/bulk", "bulk density"), ("sph/micropolar", "volume mass")])])
def test_open_ends(lammps, name, style, options):
    """The account of mass and momentum in a jet of a fluid with a hundred times its viscosities."""
    channel = ends.Channel(box="free", zone=9.0)
    spin = "spin 0 0 0.3" if style != "sph/bulk" else ""
    settings = ledger.keywords(style, coeff="1.0 1.0 0.1 20.0 {R}" if not spin else "1.0 1.0 0.1 20.0 0.05 0.05 -0.05 {R}")
    settings["integrate"] += " " + SCHEMES[name]
    lammps(channel.text(lammps, f"velocity {channel.vector(ledger.U)} average 40 {spin}", "density 1.0",
                        velocity=ledger.agitated(channel), options=options, spin=0.2, **settings)
           + ledger.output(channel, style) + "run 300\n", ranks=2)
    (table,) = lammps.results[-1].thermo()
    assert table["f_in[1]"][-1] > 8 and table["f_out[11]"][-1] > 8
    ledger.assert_balance(table, ledger.PLANE)


def stream(lammps, keywords, timestep, condition):
    """Velocities at three places of a stream between two open ends, under a force and with a jump of what enters."""
    open_channel = ends.Channel(length=12, width=6, zone=8.0)
    lammps(open_channel.text(lammps, f"velocity 0.6 0 0 {condition}", f"pressure 0 {condition}",
                             velocity=lambda place: np.full((len(place), 3), (0.5, 0.0, 0.0)), coeff="1.0 6.0 1.0 3.0 {R} pb 1.0",
                             integrate=f"density rho0 {keywords}", timestep=timestep)
           + f"fix B all addforce 0.1 0 0\n{dump('out.dump', round(2.0 / timestep))}run {round(2.0 / timestep)}\n")
    frame = lammps.frame("out.dump")
    weight = np.exp(-0.5 * (frame["x"][:, :1] - [1.5, 6.0, 10.5]) ** 2)
    return (weight * frame["v"][:, :1]).sum(axis=0) / weight.sum(axis=0)


@pytest.mark.parametrize("condition, first_order", [("condition lagged", 5e-4), ("condition fixed", 7e-3)])
def test_open_ends_as_the_explicit_step(lammps, condition, first_order):
    """The condition at the ends is of first order, with any step: they differ from one another by the second order."""
    explicit = {step: stream(lammps, "", step, condition) for step in (0.02, 0.01, 0.0025)}
    fine = explicit.pop(0.0025)
    assert relative(explicit[0.02] - fine, fine) == pytest.approx(first_order, rel=0.3)
    for name in SECOND_ORDER:
        precise = "" if name == "rkl2" else " tolerance 1e-10"
        one, two = (relative(stream(lammps, SCHEMES[name] + precise, step, condition) - explicit[step], explicit[step])
                    for step in explicit)
        print(name, one, two)
        assert one < 1e-3 and one > 3.3 * two, name


def temperature_of_the_drift(lammps, keywords, timestep):
    """Of the velocities between the steps, over kT."""
    particles = lattice(2, 16)
    particles.v[:, :2] = np.random.default_rng(3).normal(0.0, 1.0, (256, 2))
    particles.v -= particles.v.mean(axis=0)
    particles.write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\n" + fluid(2, "temp 1.0 4711", mu=2.0, kappa=200.0, c0=20.0)
           + integrate(keywords) + f"timestep {timestep}\nrun 200\n" + dump("out.dump", 5) + "run 2500\n")
    squares = [np.mean((frame["v"] + 0.5 * timestep * frame["f"] / frame["mass"][:, None])[:, :2] ** 2)
               for frame in lammps.frames("out.dump")]
    return np.mean(squares) * 256 / 255


def test_temperature_with_noise(lammps):
    """The trapezoidal step has kT between the steps at any time step, here with rates of thirty times its inverse."""
    assert temperature_of_the_drift(lammps, SCHEMES["trapezoidal"], 0.015) == pytest.approx(1.0, abs=0.01)


def test_springs_with_noise(lammps):
    """Where particles are on their springs: kT over the spring constant, in the waves that friction damps most, too."""
    rows, spring, kT, timestep = 12, 100.0, 0.01, 0.015
    particles = lattice(2, rows)
    particles.write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\n" + fluid(2, f"temp {kT} 4711", mu=20.0, kappa=40.0, c0=2.0)
           + integrate(SCHEMES["trapezoidal"] + " tolerance 1e-4") + f"fix S all spring/self {spring}\ntimestep {timestep}\nrun 300\n"
           + dump("out.dump", 25) + "run 3000\n")
    moved = np.array([frame["x"][:, :2] - particles.x[:, :2] for frame in lammps.frames("out.dump")])
    waves = [(along, f(2 * np.pi * k * particles.x[:, 1 - along] / rows)) for along in (0, 1) for k in (3, 4, 5) for f in (np.cos, np.sin)]
    energy = [spring * np.mean((moved[:, :, along] @ wave) ** 2) / (wave @ wave) for along, wave in waves]
    print(np.mean(energy) / kT, np.std(energy) / kT)
    assert np.mean(energy) == pytest.approx(kT, rel=0.12)


# ---- work --------------------------------------------------------------------------------------------------------


def work(lammps, keywords, timestep, steps=10, kappa=500.0):
    """Statistics of the steps with a rate of a hundred over the time step, and the rate times it, from random velocities."""
    disordered(2, 24, spread=0.04, jitter=0.1).write(lammps.path("box.data"))
    coeff = f"pair_coeff * * 1.0 5.0 0.5 {kappa} 4.0\n"
    result = lammps(header(2) + "read_data box.data\n" + fluid(2, coeff=coeff) + integrate(keywords)
                    + f"timestep {timestep}\n" + thermo(STATISTICS) + f"run {steps}\n")
    modes = float(result.log.split("largest viscous rate is ")[1].split(":")[0])
    return result.thermo()[0], modes


def test_work_at_a_hundred_times_the_explicit_step(lammps):
    """Evaluations of the force in a step: two of all terms, and the applications of the friction, each less than one."""
    table, modes = work(lammps, RKL2, timestep=0.42)
    assert 100 <= modes < 110
    assert np.all(table["f_FLUID[1]"][1:] <= 17)
    applications = np.diff(table["f_FLUID[4]"])
    assert np.all(applications + 2 <= 20)
    table, modes = work(lammps, SCHEMES["trapezoidal"], timestep=0.32)
    assert np.all(np.diff(table["f_FLUID[4]"]) <= 40)
    assert np.all(np.diff(table["f_FLUID[4]"]) == table["f_FLUID[1]"][1:])
    assert np.all(table["f_FLUID[2]"] < 1e-6) and np.all(table["f_FLUID[3]"] > 0.0)


@pytest.mark.parametrize("name", SCHEMES)
def test_stokes_fluid(lammps, name):
    """kappa = 0: the bulk term takes away what the shear term gives too much, cut off where it is more than that."""
    disordered(2, 12, spread=0.04).write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\n" + fluid(2, "limit yes", mu=50.0, kappa=0.0)
           + integrate(SCHEMES[name]) + "timestep 0.03\ncompute Q all sph/dissipation\n" + thermo("ke c_Q") + "run 30\n")
    table = lammps.results[-1].thermo()[0]
    assert np.all(table["c_Q"] >= 0.0) and table["KinEng"][-1] < 0.1 * table["KinEng"][0]
