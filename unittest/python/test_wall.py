"""fix sph/wall as a user meets it: forces against a reference, momentum, motion, ranks, files, known flows, bad input."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import wall_reference as ref
from helpers import SUPPORT, disordered, free, header, lattice, relative
from test_micropolar import spins, write

BULK, MICRO = "sph/bulk", "sph/micropolar"
FULL = "thermo_modify norm no format float %.17g\n"


# ---------------------------------------------------------------------------------------------
# sets of particles with walls, and their input


def arrange(particles, inside):
    """Renumber: first the fluid, then wall after wall. inside: one mask per wall."""
    owner = np.full(len(particles), -1)
    for k, mask in enumerate(inside):
        owner[mask] = k
    order = np.argsort(owner, kind="stable")
    return particles.where(order), owner[order]


def groups(owner):
    """Group commands: fluid, wall0, wall1, ..."""
    text = ""
    for k in range(-1, owner.max() + 1):
        ids = np.flatnonzero(owner == k) + 1
        text += f"group {'fluid' if k < 0 else f'wall{k}'} id {ids[0]}:{ids[-1]}\n"
    return text


def words(values):
    return " ".join(value if isinstance(value, str) else f"{value:.17g}" for value in values)


def wall_fix(k, velocity=None, rotate=None, slip=None, spin=None, gravity=None, move=None):
    """The fix command; rotate = (point, axis, rate)."""
    text = f"fix W{k} wall{k} sph/wall"
    if velocity is not None:
        text += f" velocity {words(velocity)}"
    if rotate is not None:
        point, axis, rate = rotate
        text += f" rotate {words(point)} {words(axis)} {words([rate])}"
    for name, value in (("slip", slip), ("spin", spin), ("move", move)):
        if value is not None:
            text += f" {name} {value if isinstance(value, str) else f'rate {value}'}"
    return text + (f" gravity {words(gravity)}" if gravity is not None else "") + "\n"


def wall_now(velocity=(0, 0, 0), rotate=None, slip="no", spin="zero", gravity=(0, 0, 0), move=None):
    """What the command means at the start of a run."""
    wall = ref.Wall(velocity=np.array(velocity, float), slip=slip, spin=spin, gravity=np.array(gravity, float))
    if rotate is not None:
        point, axis, rate = rotate
        axis = np.array(axis, float)
        wall.point, wall.omega = np.array(point, float), rate * axis / np.linalg.norm(axis)
    return wall


FLUIDS = {  # two types; the walls have particles of both
    BULK: [ref.Fluid(1.0, 10.0, 0.5, 2.0, pb=3.0, gamma=5.0), ref.Fluid(1.1, 12.0, 0.2, 0.8, gamma=1.6)],
    MICRO: [ref.Fluid(1.0, 10.0, 0.5, 2.0, pb=3.0, gamma=5.0, mu_r=0.3, gamma1=0.05, gamma2=-0.05),
            ref.Fluid(1.1, 12.0, 0.2, 0.8, gamma=1.6, mu_r=0.1, gamma1=0.02, gamma2=-0.02)],
}


def model_of(dim, style=BULK, **settings):
    fluids = FLUIDS[style]
    if dim == 3 and style == MICRO:
        fluids = [replace(fluid, gamma2=0.4 * fluid.gamma1) for fluid in fluids]
    return ref.Model(dim, fluids, SUPPORT[dim], style, **settings)


def pair_commands(model):
    text = f"pair_style {model.style} kernel {model.kernel} eos {model.eos} shear {model.shear} bulk {model.bulk}\n"
    for k, fluid in enumerate(model.fluids, 1):
        kappa = "intrinsic" if model.bulk == "none" else fluid.kappa
        spin = f"{fluid.mu_r} {fluid.gamma1} {fluid.gamma2} " if model.style == MICRO else ""
        gamma = f" gamma {fluid.gamma}" if fluid.gamma else ""
        text += f"pair_coeff {k} {k} {fluid.rho0} {fluid.c0} {fluid.mu} {kappa} {spin}{model.support} pb {fluid.pb}{gamma}\n"
    return text


def odd_shapes(dim, seed=3):
    """A disordered periodic set with a paddle and a ragged floor (that of the periodic image below is its ceiling)."""
    cells = (15, 13) if dim == 2 else (7, 8, 8)
    particles = disordered(dim, cells, seed=seed, jitter=0.15, ntypes=2)
    x, y, z = particles.x.T
    if dim == 2:
        paddle = (np.hypot(x - 5, y - 6) < 2.4) | ((np.abs(y - 6) < 1.1) & (x > 5) & (x < 9))
        floor = (y > 11.6 + 0.7 * np.sin(x)) | (y < 0.6)
    else:
        paddle = (np.linalg.norm(particles.x - [3.5, 3.5, 3.0], axis=1) < 1.6) | ((x < 4) & (y < 2) & (z < 4) & (z > 2))
        floor = z > 6.2 + 0.5 * np.sin(x)
    return arrange(particles, [paddle & ~floor, floor])


def save(lammps, particles, model, omega=None):
    if model.style == MICRO:
        write(particles, lammps.path("box.data"), omega)
    else:
        particles.write(lammps.path("box.data"))


def start(model, owner, walls, newton="on", boundary="p p p", step=0.002, before=""):
    """Everything up to the run."""
    return (header(model.dim, newton=newton, boundary=boundary, style=model.style) + before + "read_data box.data\n"
            + groups(owner) + pair_commands(model) + f"fix FLUID fluid {model.style}\n"
            + "".join(wall_fix(k, **wall) for k, wall in enumerate(walls)) + f"timestep {step}\n")


def dump(name, owner, every=1, style=BULK):
    spin = "omegax omegay omegaz tqx tqy tqz" if style == MICRO else ""
    each = " ".join(f"f_W{k}[*]" for k in range(owner.max() + 1))
    return ("compute V all property/atom vestx vesty vestz rho vol\n"
            f"dump D all custom {every} {name} id xu yu zu vx vy vz fx fy fz {spin} c_V[*] {each}\n"
            "dump_modify D sort id format float %.17g\n")


def undump():
    return "undump D\nuncompute V\n"


def vector(frame, *names):
    return np.column_stack([frame.columns[name] for name in names])


def vest_of(frame):
    return vector(frame, "c_V[1]", "c_V[2]", "c_V[3]")


def torque_of(frame):
    return vector(frame, "tqx", "tqy", "tqz")


def omega_of(frame):
    return vector(frame, "omegax", "omegay", "omegaz")


def global_vector(k):
    return " ".join(f"f_W{k}[{i}]" for i in range(1, 7))


# ---------------------------------------------------------------------------------------------
# forces against the reference

SETS = {dim: odd_shapes(dim) for dim in (2, 3)}
WALLS = {  # of the paddle and of the floor
    2: {"at rest": ({}, {}),
        "free": (dict(slip="free"), dict(slip="free", spin="free")),
        "spin rate": (dict(spin=0.4), dict(spin=1.0, velocity=(0.2, 0, 0))),
        "spin rate and free slip": (dict(spin=0.7, slip="free"), dict(spin="free")),
        "moving": (dict(velocity=(0.4, -0.3, 0), gravity=(0.5, -2.0, 0)), dict(velocity=(-0.6, 0, 0), slip="free")),
        "turning": (dict(rotate=((4.5, 6.2, 0), (0, 0, 2), 0.8), velocity=(0.1, 0.2, 0), gravity=(1.0, -0.5, 0)),
                    dict(gravity=(0.3, -3.0, 0))),
        "turning freely": (dict(rotate=((4.5, 6.2, 0), (0, 0, -1), 0.8), slip="free", spin=0.5), dict(slip="free"))},
    3: {"at rest": ({}, {}),
        "free": (dict(slip="free", spin="free"), dict(slip="free")),
        "spin rate": (dict(spin=0.4), dict(spin="free")),
        "moving": (dict(velocity=(0.4, -0.3, 0.2), gravity=(0.5, 1.0, -2.0)), dict(velocity=(-0.6, 0.1, 0), slip="free")),
        "turning": (dict(rotate=((3.0, 3.5, 3.2), (0.3, -1.0, 0.5), 0.9), velocity=(0.1, 0.2, -0.1), spin=0.3),
                    dict(gravity=(0.3, 0.0, -3.0)))},
}
OPTIONS = [dict(bulk="volume"), dict(bulk="none"), dict(shear="mg/fr"), dict(shear="mg/fr", bulk="volume"), dict(shear="mg/fr2"), dict(shear="morris"),
           dict(shear="morris", bulk="volume", kernel="lucy"), dict(shear="espanol", bulk="none"),
           dict(eos="tait"), dict(eos="ideal"), dict(eos="ideal", bulk="volume")]
PARALLEL = [(1, "off"), (2, "on"), (2, "off"), (4, "on"), (4, "off")]
CASES = ([(dim, BULK, name, {}) for dim in (2, 3) for name in WALLS[dim]]
         + [(dim, MICRO, name, {}) for dim in (2, 3) for name in WALLS[dim]]
         + [(dim, BULK, "turning", options) for dim in (2, 3) for options in OPTIONS]
         + [(dim, MICRO, "turning", options) for dim in (2, 3)
            for options in (dict(shear="mg/fr2"), dict(bulk="volume"), dict(bulk="none"), dict(eos="tait"), dict(eos="ideal", kernel="lucy"))])


def expected(dim, style, name, options):
    particles, owner = SETS[dim]
    model = model_of(dim, style, **options)
    omega = spins(particles) if style == MICRO else None
    state = ref.State(particles.x, particles.v, particles.mass, particles.esph, particles.type, owner,
                      particles.hi - particles.lo, omega)
    return model, omega, ref.forces(model, state, [wall_now(**wall) for wall in WALLS[dim][name]])


# The fit that continues the spin divides by a difference of 0.001 of its terms, and behind the surface multiplies by up to (depth/d)^2: round-off, too
BOUND, SPIN = 1e-12, 25.0


def assert_forces(frame, owner, want, style, bound=BOUND):
    difference = {"force": relative(frame["f"] - want["f"], want["f"])}
    if style == MICRO:
        difference["torque"] = relative(torque_of(frame) - want["torque"], want["torque"]) / SPIN
    wet = owner < 0
    for k in range(owner.max() + 1):
        each = vector(frame, *[f"f_W{k}[{i}]" for i in range(1, 7)])
        own = owner == k
        assert (each[~own] == 0.0).all()
        difference[f"force on wall {k}"] = relative(each[own, :3] - want["f"][own], want["f"])
        difference[f"couple on wall {k}"] = relative(each[own, 3:] - want["torque"][own], want["torque"]) / SPIN if style == MICRO \
            else np.abs(each[own, 3:]).max()
        wet |= own & (np.abs(want["f"]).max(axis=1) > 0.0)
    difference["density"] = relative((frame["c_V[4]"] - want["rho"])[wet], want["rho"])
    difference["velocity of the walls"] = np.abs(frame["v"] - want["v"])[owner >= 0].max()
    print("largest differences", {name: f"{value:.1e}" for name, value in difference.items()})
    assert max(difference.values()) < bound, difference


def assert_global(table, owner, want, walls, style, bound=2e-13):
    for k, wall in enumerate(walls):
        own = owner == k
        point = np.array(wall["rotate"][0]) if wall.get("rotate") else np.zeros(3)
        f = want["f"][own]
        t = np.cross(want["x"][own] - point, f) + want["torque"][own]
        total = np.array([table[f"f_W{k}[{i}]"][0] for i in range(1, 7)])
        assert relative(total[:3] - f.sum(axis=0), np.abs(f).sum(axis=0)) < bound
        assert relative(total[3:] - t.sum(axis=0), np.abs(t).sum(axis=0)) < bound


@pytest.mark.parametrize("dim, style, name, options", CASES)
def test_forces(lammps, dim, style, name, options):
    model, omega, want = expected(dim, style, name, options)
    particles, owner = SETS[dim]
    save(lammps, particles, model, omega)
    (table,) = lammps(start(model, owner, WALLS[dim][name]) + dump("out.dump", owner, style=style)
                      + f"thermo_style custom step {global_vector(0)} {global_vector(1)}\n" + FULL + "run 0\n").thermo()
    assert_forces(lammps.frame("out.dump"), owner, want, style)
    assert_global(table, owner, {**want, "x": particles.x}, WALLS[dim][name], style)


FRICTION = [(dim, BULK, name, options) for dim in (2, 3)
            for name, options in (("moving", {}), ("turning", dict(shear="mg/fr")), ("free", dict(shear="morris")), ("turning", dict(shear="espanol")))]
FRICTION += [(dim, MICRO, name, {}) for dim in (2, 3) for name in ("spin rate", "free", "turning")]
BEFORE = ["run 3\nrun 3 pre no\n", "minimize 0 0 3 10\nrun 2\nrun 2 pre no\n", "run 2\nunfix W0\nrun 1\n" + wall_fix(0, **WALLS[2]["moving"][0])]


@pytest.mark.parametrize("dim, style, name, options, before", [(*case, "") for case in FRICTION] + [(2, BULK, "moving", {}, text) for text in BEFORE])
def test_heat_of_friction_is_the_work(lammps, dim, style, name, options, before):
    """Its forces and torques do work on the fluid, and on walls with their own velocity and angular velocity: what is lost is heat of the fluid."""
    particles, owner = SETS[dim]
    model = model_of(dim, style, bulk="none", **options)
    spinning = dict(mu_r=0.0, gamma1=0.0, gamma2=0.0) if style == MICRO else {}
    without = replace(model, fluids=[replace(fluid, mu=0.0, **spinning) for fluid in model.fluids])
    omega = spins(particles) if style == MICRO else None
    save(lammps, particles, model, omega)
    text = start(model, owner, WALLS[dim][name]) + before + "compute Q all sph/dissipation\nthermo_style custom step c_Q c_Q[*]\n" + FULL
    for commands, file in (("", "all.dump"), (pair_commands(without), "pressure.dump")):
        text += commands + dump(file, owner, style=style).replace("c_V[*]", "c_V[*] c_Q", 1) + "run 0\n" + undump()
    table = lammps(text).thermo()[-2]
    frame, pressure = lammps.frame("all.dump"), lammps.frame("pressure.dump")
    work = ((frame["f"] - pressure["f"]) * vest_of(frame)).sum(axis=1)
    if style == MICRO:
        rate = omega_of(frame)
        for k, wall in enumerate(WALLS[dim][name]):
            rate[owner == k] = wall_now(**wall).omega
        work += ((torque_of(frame) - torque_of(pressure)) * rate).sum(axis=1)
    heat = frame.columns["c_Q"]
    print("heat", table["c_Q"][0], "work", work.sum(), "on walls", work[owner >= 0].sum())
    assert table["c_Q"][0] == pytest.approx(-work.sum(), rel=1e-12)
    assert sum(table[key][0] for key in table if key.startswith("c_Q[")) == pytest.approx(table["c_Q"][0], rel=1e-12)
    assert heat.sum() == pytest.approx(table["c_Q"][0], rel=1e-12)
    assert (heat[owner >= 0] == 0.0).all()


def test_exclusions_come_back_with_every_run(lammps):
    """neigh_modify exclude none after the fix: no force between wall particles in the per-atom array."""
    model, omega, want = expected(2, BULK, "turning", {})
    particles, owner = SETS[2]
    save(lammps, particles, model, omega)
    none = "neigh_modify exclude none\n"
    lammps(start(model, owner, WALLS[2]["turning"]) + none + "run 0\n" + none + dump("out.dump", owner) + "run 0\n")
    assert_forces(lammps.frame("out.dump"), owner, want, BULK)


@pytest.mark.parametrize("dim, style, name", [(2, BULK, "turning"), (3, MICRO, "turning"), (2, MICRO, "spin rate"),
                                              (3, MICRO, "spin rate")])
@pytest.mark.parametrize("ranks, newton", PARALLEL)
def test_forces_on_any_number_of_ranks(lammps, dim, style, name, ranks, newton):
    model, omega, want = expected(dim, style, name, {})
    particles, owner = SETS[dim]
    save(lammps, particles, model, omega)
    (table,) = lammps(start(model, owner, WALLS[dim][name], newton=newton) + dump("out.dump", owner, style=style)
                      + f"thermo_style custom step {global_vector(0)} {global_vector(1)}\n" + FULL + "run 0\n",
                      ranks=ranks).thermo()
    assert_forces(lammps.frame("out.dump"), owner, want, style)
    assert_global(table, owner, {**want, "x": particles.x}, WALLS[dim][name], style)


# ---------------------------------------------------------------------------------------------
# walls that move

STEP = 0.002
TIME = "variable t equal step*dt\n"


def travel(lammps, walls, steps, before="", dim=2, every=1):
    """Frames of a run of the odd shapes from rest; the walls are as given."""
    particles, owner = SETS[dim]
    model = model_of(dim)
    save(lammps, particles, model)
    lammps(start(model, owner, walls, step=STEP, before=before) + dump("out.dump", owner, every)
           + f"run {steps}\n")
    return particles, owner, lammps.frames("out.dump")


def test_constant_velocity(lammps):
    velocity = np.array([0.4, -0.3, 0.0])
    particles, owner, frames = travel(lammps, [dict(velocity=velocity), dict(velocity=(0.5, 0, 0), move="no")], 50)
    for frame in frames:
        np.testing.assert_allclose(frame["x"][owner == 0], particles.x[owner == 0] + velocity * STEP * frame.step,
                                   rtol=0, atol=1e-13)
        assert (frame["x"][owner == 1] == particles.x[owner == 1]).all()
        for k, v in ((0, velocity), (1, [0.5, 0.0, 0.0])):
            assert np.abs(frame["v"][owner == k] - v).max() < 1e-15


@pytest.mark.parametrize("dim", [2, 3])
def test_rotation_is_exact_after_any_number_of_steps(lammps, dim):
    """About an axis whose point travels; distances within the wall stay."""
    axis = np.array([0.0, 0.0, 2.0]) if dim == 2 else np.array([0.3, -1.0, 0.5])
    point, velocity, rate = np.array([4.5, 6.0, 0.0] if dim == 2 else [3.0, 3.5, 3.2]), np.array([0.3, 0.1, 0.0]), 5.0
    turning = dict(rotate=(point, axis, rate), velocity=velocity)
    particles, owner, frames = travel(lammps, [turning, {}], 200, dim=dim, every=200)
    own = owner == 0
    arm = particles.x[own] - point
    axis /= np.linalg.norm(axis)
    angle = rate * STEP * 200
    turned = (np.cos(angle) * arm + np.sin(angle) * np.cross(axis, arm)
              + (1 - np.cos(angle)) * (arm @ axis)[:, None] * axis)
    last = frames[-1]
    np.testing.assert_allclose(last["x"][own], point + velocity * STEP * 200 + turned, rtol=0, atol=1e-11)
    np.testing.assert_allclose(last["v"][own], velocity + rate * np.cross(axis, turned), rtol=0, atol=1e-10)
    assert (last["x"][owner == 1] == particles.x[owner == 1]).all()


def test_rotation_without_motion(lammps):
    """move no: only the surface turns."""
    particles, owner, frames = travel(lammps, [dict(rotate=((4.5, 6.0, 0), (0, 0, 1), 2.0), move="no"), {}], 20)
    own = owner == 0
    assert (frames[-1]["x"][own] == particles.x[own]).all()
    v = np.cross([0, 0, 2.0], particles.x[own] - [4.5, 6.0, 0])
    np.testing.assert_allclose(frames[-1]["v"][own], v, rtol=0, atol=1e-13)


def variable_wall(step):
    """Velocity and rotation at the end of a step, and their changes over this step; before the first one, they go on the
    parabola through those of the next steps."""
    def velocity(t):
        return np.array([0.5 * np.sin(30 * t), 0.2 + 3 * t, 0.0])

    def rate(t):
        return 0.8 * np.cos(40 * t)

    def change(value):
        before = value(STEP * (step - 1)) if step else 3 * value(0.0) - 3 * value(STEP) + value(2 * STEP)
        return (value(STEP * step) - before) / STEP

    return velocity(STEP * step), change(velocity), rate(STEP * step), change(rate)


VARIABLES = TIME + "variable U equal 0.5*sin(30*v_t)\nvariable V equal 0.2+3*v_t\nvariable O equal 0.8*cos(40*v_t)\n"


@pytest.mark.parametrize("move", ["yes", "no"])
def test_variable_velocity_and_rotation(lammps, move):
    """Forces after some steps against the reference: the acceleration of the wall acts on the pressure in it."""
    point = np.array([4.5, 6.2, 0.0])
    walls = [dict(velocity=("v_U", "v_V", 0.0), rotate=(point, (0, 0, 1), "v_O"), move=move), dict(gravity=(0, -1.0, 0))]
    particles, owner, frames = travel(lammps, walls, 12, before=VARIABLES)
    model = model_of(2)
    own = owner == 0
    for frame in frames:
        v, v_rate, omega, omega_rate = variable_wall(frame.step)
        point_now = point.copy()
        if move == "yes":  # the point of the axis has travelled with the wall, by the mean velocity of each step
            for s in range(frame.step):
                point_now += 0.5 * STEP * (variable_wall(s)[0] + variable_wall(s + 1)[0])
        z = np.array([0.0, 0.0, 1.0])
        now = ref.Wall(velocity=v, rate=v_rate, omega=omega * z, omega_rate=omega_rate * z, point=point_now)
        state = ref.State(frame["x"], vest_of(frame), particles.mass, particles.esph, particles.type, owner,
                          particles.hi - particles.lo)
        want = ref.forces(model, state, [now, ref.Wall(gravity=np.array([0, -1.0, 0]))])
        assert_forces(frame, owner, want, BULK)
    moved = np.abs(frames[-1]["x"][own] - particles.x[own]).max()
    assert (moved > 0.005) == (move == "yes")


# ---------------------------------------------------------------------------------------------
# vessels whose walls are thick enough


def channel(dim=2, jitter=0.1, size=None, layers=3, seed=5, speed=0.2, obstacle=False):
    """Fluid between a floor and a ceiling, along y, periodic otherwise; wall 0 = floor, 1 = ceiling, 2 = obstacle."""
    size = size or {2: (16, 18), 3: (6, 12, 6)}[dim]
    particles = lattice(dim, size)
    y = particles.x[:, 1]
    floor, ceiling = y < layers, y > size[1] - layers
    masks = [floor, ceiling]
    if obstacle:
        masks.append(np.linalg.norm(particles.x[:, :2] - [0.5 * size[0], 0.5 * size[1]], axis=1) < 2.3)
    wet = ~np.any(masks, axis=0)
    random = np.random.default_rng(seed)
    particles.x[wet, :dim] += random.uniform(-jitter, jitter, (wet.sum(), dim))
    particles.v[wet, :dim] = random.normal(0.0, speed, (wet.sum(), dim))
    return arrange(particles, masks)


def cup(dim=2, radius=6.0, thick=3.2, jitter=0.1, seed=5, speed=0.2, seed_spin=0.0):
    """Fluid in a round vessel in an open box."""
    cells = 2 * int(radius + thick) + 4
    particles = lattice(dim, cells)
    particles.x[:, :dim] -= 0.5 * cells
    distance = np.linalg.norm(particles.x, axis=1)
    particles = particles.where(distance < radius + thick)
    solid = np.linalg.norm(particles.x, axis=1) > radius
    random = np.random.default_rng(seed)
    wet = ~solid
    particles.x[wet, :dim] += random.uniform(-jitter, jitter, (wet.sum(), dim))
    particles.v[wet, :dim] = random.normal(0.0, speed, (wet.sum(), dim))
    reach = np.array([cells] * dim + [0.5] * (3 - dim))
    return arrange(replace(particles, lo=-reach, hi=reach), [solid])


def one_fluid(dim, style=BULK, mu=0.5, kappa=2.0, pb=0.0, **settings):
    spin = dict(mu_r=0.3, gamma1=0.05, gamma2=-0.05 if dim == 2 else 0.02) if style == MICRO else {}
    return ref.Model(dim, [ref.Fluid(1.0, 10.0, mu, kappa, pb=pb, **spin)], SUPPORT[dim], style, **settings)


def run_vessel(lammps, particles, owner, model, walls, commands, ranks=1, newton="on", boundary="p p p", omega=None,
               check=True, before="", timeout=120):
    save(lammps, particles, model, omega)
    return lammps(start(model, owner, walls, newton, boundary, step=0.005, before=before) + commands, ranks=ranks,
                  check=check, timeout=timeout)


# ---------------------------------------------------------------------------------------------
# momentum


@pytest.mark.parametrize("dim, style", [(2, BULK), (3, BULK), (2, MICRO)])
@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "off")])
def test_force_on_the_walls_is_the_momentum_lost(lammps, dim, style, ranks, newton):
    """Over a run: velocity Verlet gives the fluid half the force at the start and half that at the end of each step."""
    particles, owner = channel(dim, obstacle=dim == 2)
    walls = [dict(gravity=(0.3, -0.2, 0)), dict(velocity=(0.5, 0, 0), move="no"),
             dict(rotate=((8, 9, 0), (0, 0, 1), 0.6), slip="free", gravity=(0.3, -0.2, 0))][:2 + (dim == 2)]
    model = one_fluid(dim, style)
    steps, body = 300, np.array([0.3, -0.2, 0.0])
    wet = owner < 0
    columns = " ".join(global_vector(k) for k in range(len(walls)))
    result = run_vessel(
        lammps, particles, owner, model, walls,
        f"fix G fluid addforce {words(body)}\n" + dump("out.dump", owner, steps, style)
        + "compute F fluid reduce sum fx fy fz\n" + f"thermo 1\nthermo_style custom step {columns} c_F[*]\n" + FULL
        + f"run {steps}\n", ranks, newton)
    (table,) = result.thermo()
    on_walls = sum(np.column_stack([table[f"f_W{k}[{i}]"] for i in (1, 2, 3)]) for k in range(len(walls)))
    on_fluid = np.column_stack([table[f"c_F[{i}]"] for i in (1, 2, 3)]) - body * wet.sum()
    scale = np.abs(on_walls).max()
    assert np.abs(on_walls + on_fluid).max() < 1e-12 * scale * len(particles) ** 0.5
    first, last = lammps.frames("out.dump")
    for frame, row in ((first, 0), (last, -1)):
        for k in range(len(walls)):
            each = vector(frame, *[f"f_W{k}[{i}]" for i in (1, 2, 3)])
            assert np.abs(each.sum(axis=0) - [table[f"f_W{k}[{i}]"][row] for i in (1, 2, 3)]).max() < 1e-12 * scale
    impulse = 0.005 * (0.5 * (on_walls[1:] + on_walls[:-1])).sum(axis=0)
    gained = (particles.mass[wet, None] * (last["v"] - first["v"])[wet]).sum(axis=0)
    missing = np.abs(gained + impulse - body * wet.sum() * 0.005 * steps).max()
    size = np.abs(particles.mass[:, None] * first["v"]).sum()
    print(f"impulse {impulse}, missing {missing:.1e} of {size:.1f}")
    assert np.abs(impulse).max() > 0.1
    assert missing < 1e-13 * size


@pytest.mark.parametrize("dim, style, slip", [(2, BULK, "no"), (2, MICRO, "no"), (2, MICRO, "free"), (3, MICRO, "no")])
def test_torque_on_the_wall_is_the_angular_momentum_lost(lammps, dim, style, slip):
    """Orbital and spin part together, in a cup that turns about its axis: forces and couples on the wall balance it."""
    radius = 6.0 if dim == 2 else 3.6
    particles, owner = cup(dim, radius=radius, thick=3.2 if dim == 2 else 2.7)
    omega = 0.5 * spins(particles) if style == MICRO else None
    axis = (0, 0, 1) if dim == 2 else (0.4, 0.7, -0.5)
    steps, wet = 300, owner < 0
    result = run_vessel(
        lammps, particles, owner, one_fluid(dim, style), [dict(rotate=((0, 0, 0), axis, 0.8), slip=slip, spin=0.5)],
        dump("out.dump", owner, steps, style) + f"thermo 1\nthermo_style custom step {global_vector(0)}\n" + FULL
        + f"timestep 0.002\nrun {steps}\n", boundary=free(dim), omega=omega)
    (table,) = result.thermo()
    torque = np.column_stack([table[f"f_W0[{i}]"] for i in (4, 5, 6)])
    impulse = 0.002 * (0.5 * (torque[1:] + torque[:-1])).sum(axis=0)
    total = []
    for frame in lammps.frames("out.dump"):
        mass = particles.mass[wet, None]
        each = mass * np.cross(frame["x"][wet], frame["v"][wet])
        if style == MICRO:
            each = each + mass * 0.2 * omega_of(frame)[wet]
        total.append((each.sum(axis=0), np.abs(each).sum()))
    missing = np.abs(total[1][0] - total[0][0] + impulse).max() / total[0][1]
    print(f"impulse {impulse}, missing {missing:.1e}")
    assert np.abs(impulse).max() > 0.01 * total[0][1]
    assert missing < 1e-13


# ---------------------------------------------------------------------------------------------
# ranks, files, commands

MOVING = [dict(gravity=(0.3, -0.2, 0)), dict(velocity=(0.5, 0, 0), move="no"),
          dict(rotate=((8, 9, 0), (0, 0, 1), 0.6), spin=0.5, gravity=(0.3, -0.2, 0))]
BODY = "fix G fluid addforce 0.3 -0.2 0\n"


def vessel(dim):
    return channel(dim, obstacle=dim == 2), MOVING if dim == 2 else [MOVING[0], dict(velocity=(0.5, 0, 0.2), slip="free")]


def trajectory(lammps, dim, style, ranks=1, newton="on", before="", after="", steps=200):
    (particles, owner), walls = vessel(dim)
    omega = 0.3 * spins(particles) if style == MICRO else None
    run_vessel(lammps, particles, owner, one_fluid(dim, style), walls,
               after + BODY + dump("out.dump", owner, steps, style) + f"run {steps}\n", ranks, newton, omega=omega,
               before=before)
    return lammps.frame("out.dump")


def assert_same(one, other, style, bound=1e-11):
    names = ["xu", "yu", "zu", "vx", "vy", "vz", "fx", "fy", "fz"]
    names += ["omegax", "omegay", "omegaz"] if style == MICRO else []
    names += [name for name in one.columns if name.startswith("f_W")]
    largest = {name: np.abs(one.columns[name] - other.columns[name]).max() for name in names}
    print("largest difference", max(largest.values()))
    assert max(largest.values()) < bound, largest


@pytest.fixture(scope="module")
def serial(shared_lammps):
    known = {}

    def get(dim, style):
        if (dim, style) not in known:
            known[dim, style] = trajectory(shared_lammps, dim, style)
        return known[dim, style]

    return get


@pytest.mark.parametrize("dim, style, ranks, newton, before, after", [
    (2, BULK, 1, "off", "", ""), (2, BULK, 2, "on", "processors 1 2 1\n", ""), (2, BULK, 4, "on", "", ""),
    (2, BULK, 4, "off", "processors 4 1 1\n", ""), (2, BULK, 4, "on", "comm_style tiled\n", "balance 1.0 rcb\n"),
    (2, BULK, 2, "off", "comm_modify cutoff 7.0\n", "fix B all balance 50 1.0 shift xy 10 1.05\n"),
    (2, MICRO, 2, "on", "", ""), (2, MICRO, 4, "off", "", ""), (3, BULK, 2, "on", "", ""), (3, MICRO, 4, "on", "", ""),
    (3, MICRO, 4, "off", "", "")])
def test_same_trajectory(lammps, serial, dim, style, ranks, newton, before, after):
    assert_same(serial(dim, style), trajectory(lammps, dim, style, ranks, newton, before, after), style)


@pytest.mark.parametrize("dim, style, before, after", [(2, BULK, 1, 1), (2, BULK, 2, 4), (2, MICRO, 1, 2), (3, BULK, 2, 1)])
def test_continue_from_a_restart_file(lammps, dim, style, before, after):
    """Equals a second run command in the script that wrote the file."""
    (particles, owner), walls = vessel(dim)
    omega = 0.3 * spins(particles) if style == MICRO else None
    save(lammps, particles, one_fluid(dim, style), omega)
    run_vessel(lammps, particles, owner, one_fluid(dim, style), walls,
               BODY + "run 100\nwrite_restart state.restart\n" + dump("whole.dump", owner, 100, style) + "run 100\n",
               before, omega=omega)
    fixes = f"fix FLUID fluid {style}\n" + "".join(wall_fix(k, **wall) for k, wall in enumerate(walls)) + BODY
    lammps("read_restart state.restart\n" + fixes + "timestep 0.005\n" + dump("parts.dump", owner, 100, style) + "run 100\n",
           ranks=after)
    for one, other in zip(lammps.frames("whole.dump"), lammps.frames("parts.dump")):
        assert one.step == other.step
        assert_same(one, other, style)


def test_position_of_the_axis_is_in_the_restart_file(lammps):
    """A wheel that rolls, through a periodic boundary: without the travelled point it would be torn apart."""
    (particles, owner), walls = vessel(2)
    particles.x[:, 0] = particles.x[:, 0] + 5.0
    particles.x[:, 0] -= 16.0 * (particles.x[:, 0] > 16.0)
    walls = [walls[0], walls[1], dict(rotate=((13, 9, 0), (0, 0, 1), 3.0), velocity=(2.0, 0, 0))]
    run_vessel(lammps, particles, owner, one_fluid(2), walls, "run 100\nwrite_restart state.restart\n", 2)
    fixes = "fix FLUID fluid sph/bulk\n" + "".join(wall_fix(k, **wall) for k, wall in enumerate(walls))
    lammps("read_restart state.restart\n" + fixes + "timestep 0.005\n" + dump("out.dump", owner, 100) + "run 100\n")
    own = owner == 2
    last = lammps.frame("out.dump")
    arm = particles.x[own] - [13, 9, 0]
    turned = np.cos(3.0) * arm + np.sin(3.0) * np.cross([0, 0, 1], arm)
    assert last["x"][own, 0].max() > 16.5
    np.testing.assert_allclose(last["x"][own], turned + [15, 9, 0], rtol=0, atol=1e-11)


def test_wheel_cut_by_a_border(lammps):
    """A warning, unless its image flags make it one piece, or it does not rotate."""
    text = ("units lj\ndimension 2\natom_style sph/bulk\nlattice sq 1.0 origin 0.5 0.5 0.0\nregion box block 0 16 0 16 -0.5 0.5\n"
            "create_box 2 box\ncreate_atoms 1 box\nregion left sphere 0 8 0 3.2\nregion right sphere 16 8 0 3.2\nset region left type 2\n"
            "set region right type 2\n{image}set group all mass 1.0\ngroup fluid type 1\ngroup wheel type 2\nneighbor 0.5 bin\npair_style sph/bulk\n"
            "pair_coeff * * 1.0 10.0 0.1 0.3 3.0\nfix 1 fluid sph/bulk\nfix 2 wheel sph/wall {motion}\nrun 0\n")
    turns, image = "rotate 0 8 0 0 0 1 0.1", "set region right image -1 NULL NULL\n"
    for keywords, warned in ((dict(motion=turns, image=""), 1), (dict(motion=turns, image=image), 0), (dict(motion="velocity 1 0 0", image=""), 0)):
        lines = [line for line in lammps(text.format(**keywords)).warnings if "a periodic border cuts the wall in two" in line]
        assert len(lines) == warned, keywords


def test_data_file_round_trip(lammps):
    (particles, owner), walls = vessel(2)
    run_vessel(lammps, particles, owner, one_fluid(2), walls, "run 20\nvelocity all scale 0.3\nwrite_data out.data\n" + dump("before.dump", owner)
               + "run 0\n")
    # the file has the coefficients of the pair style; the obstacle goes on about the same point
    text = start(one_fluid(2), owner, walls, step=0.005).replace(
        "read_data box.data", pair_commands(one_fluid(2)).splitlines()[0] + "\nread_data out.data")
    lammps(text + dump("after.dump", owner) + "run 0\n")
    one, other = lammps.frame("before.dump"), lammps.frame("after.dump")
    assert relative(one["f"] - other["f"], one["f"]) < 1e-12


def test_run_pre_no_continues_exactly(lammps):
    """Two runs, the second without set-up, are one long run."""
    (particles, owner), walls = vessel(2)
    for name, runs in (("one", "run 60\n"), ("two", "run 30\nrun 30 pre no\n")):
        run_vessel(lammps, particles, owner, one_fluid(2), walls, BODY + dump(f"{name}.dump", owner, 60) + runs)
    assert_same(lammps.frame("one.dump"), lammps.frame("two.dump"), BULK)


def test_wall_may_stand_still_again(lammps):
    """After unfix and a new fix the wall has the new velocity; its particles are still not a fluid's."""
    (particles, owner), walls = vessel(2)
    run_vessel(lammps, particles, owner, one_fluid(2), walls,
               "run 10\nunfix W2\n" + wall_fix(2, velocity=(0, 0.1, 0)) + dump("out.dump", owner) + "run 10\n")
    frames = lammps.frames("out.dump")
    own = owner == 2
    moved = frames[-1]["x"][own] - frames[0]["x"][own]
    np.testing.assert_allclose(moved, np.tile([0, 0.005, 0], (own.sum(), 1)), rtol=0, atol=1e-13)


def test_hybrid_overlay(lammps, serial):
    (particles, owner), walls = vessel(2)
    save(lammps, particles, one_fluid(2))
    text = start(one_fluid(2), owner, walls, step=0.005)
    text = text.replace("pair_style sph/bulk", "pair_style hybrid/overlay zero 3.0 sph/bulk").replace(
        "pair_coeff 1 1 ", "pair_coeff * * zero\npair_coeff 1 1 sph/bulk ")
    lammps(text + BODY + dump("out.dump", owner, 200) + "run 200\n")
    assert_same(serial(2, BULK), lammps.frame("out.dump"), BULK)


# ---------------------------------------------------------------------------------------------
# flows whose forces are known


def forces_of(lammps, particles, owner, model, walls, boundary="p p p", omega=None, name="out.dump"):
    run_vessel(lammps, particles, owner, model, walls, dump(name, owner, style=model.style) + "run 0\n", boundary=boundary,
               omega=omega)
    return lammps.frame(name)


@pytest.mark.parametrize("style", [BULK, MICRO])
@pytest.mark.parametrize("slip", ["no", "free"])
@pytest.mark.parametrize("dim", [2, 3])
def test_common_motion_exerts_no_viscous_force(lammps, dim, slip, style):
    """Walls and fluid in uniform motion: the forces are those at rest."""
    (particles, owner), walls = vessel(dim)
    velocity = np.array([0.7, -0.4, 0.3 if dim == 3 else 0.0])
    still = np.zeros((len(particles), 3))
    frames = []
    for v, name in ((0 * velocity, "rest.dump"), (velocity, "moving.dump")):
        particles.v[:] = v
        frames.append(forces_of(lammps, particles, owner, one_fluid(dim, style),
                                [dict(velocity=v, slip=slip, spin="free")] * len(walls), omega=still, name=name))
    difference = relative(frames[1]["f"] - frames[0]["f"], frames[0]["f"])
    print(f"{difference:.1e}")
    assert difference < 1e-12


@pytest.mark.parametrize("style", [BULK, MICRO])
@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("slip", ["no", "free"])
def test_common_rotation_exerts_no_viscous_force(lammps, dim, style, slip):
    """Fluid that turns with its cup like a rigid body, spin included: only the pressure of the centrifugal force remains."""
    particles, owner = cup(dim, radius=6.0 if dim == 2 else 3.6, thick=3.2 if dim == 2 else 2.7)
    axis = np.array([0, 0, 1.0]) if dim == 2 else np.array([2.0, -1.0, 2.0]) / 3.0
    rate, point = 0.8, np.array([0.3, -0.2, 0.0])
    particles.v = rate * np.cross(axis, particles.x - point)
    omega = np.tile(rate * axis, (len(particles), 1))
    model = one_fluid(dim, style)
    wall = dict(rotate=(point, axis, rate), slip=slip)
    inviscid = replace(model, bulk="none", fluids=[replace(model.fluids[0], mu=0.0, mu_r=0.0, gamma1=0.0, gamma2=0.0)])
    frames = [forces_of(lammps, particles, owner, one, [wall], free(dim), omega, name)
              for one, name in ((model, "viscous.dump"), (inviscid, "inviscid.dump"))]
    difference = relative(frames[0]["f"] - frames[1]["f"], frames[1]["f"])
    print(f"{difference:.1e}")
    assert difference < 1e-12
    if style == MICRO:
        assert np.abs(torque_of(frames[0])).max() < 1e-12


@pytest.mark.parametrize("style", [BULK, MICRO])
@pytest.mark.parametrize("dim", [2, 3])
def test_linear_shear_goes_on_into_the_wall(lammps, dim, style):
    """No force along the walls on any particle, in units of the stress on its area; with the mean of the fluid reflected
    it is 0.03 (2d) and 0.02. The fluid of the second style spins with half of the vorticity, at the wall as well."""
    particles, owner = channel(dim, jitter=0.0)
    height, wet, shear = particles.hi[1] - 6.0, owner < 0, 0.1
    particles.v[:] = 0.0
    particles.v[wet, 0] = shear * (particles.x[wet, 1] - 3.0)
    omega = np.zeros((len(particles), 3))
    omega[wet, 2] = -0.5 * shear
    walls = [dict(spin=1.0), dict(velocity=(shear * height, 0, 0), spin=1.0)]
    model = one_fluid(dim, style)
    frame = forces_of(lammps, particles, owner, model, walls, omega=omega if style == MICRO else None)
    stress = model.fluids[0].mu * shear
    along = np.abs(frame["f"][wet, 0]).max() / stress
    on_wall = np.array([frame["f"][owner == k, 0].sum() for k in (0, 1)]) / stress / (owner == 0).sum() * 3
    print("along", along, "on the walls", on_wall)
    bound = {2: 1e-4, 3: 3e-3}[dim]  # in 3d the support radius of 2.5 spacings cuts off the sum that finds the surface
    assert along < bound
    assert on_wall[0] == pytest.approx(-on_wall[1], rel=1e-12)
    if style == MICRO:
        assert np.abs(torque_of(frame)[wet]).max() / stress < bound


def test_free_slip_leaves_plug_flow_alone(lammps):
    """No force along the walls in any step as long as rows of the lattice slide; sticking walls do slow it."""
    particles, owner = channel(2, jitter=0.0)
    particles.v[owner < 0] = [0.1, 0, 0]
    speeds = {}
    for slip in ("free", "no"):
        run_vessel(lammps, particles, owner, one_fluid(2), [dict(slip=slip)] * 2,
                   dump(f"{slip}.dump", owner, 500) + "run 500\n")
        speeds[slip] = lammps.frame(f"{slip}.dump")["v"][owner < 0]
    print("free:", speeds["free"].min(axis=0), speeds["free"].max(axis=0), "no:", speeds["no"][:, 0].mean())
    np.testing.assert_allclose(speeds["free"], np.tile([0.1, 0, 0], (len(speeds["free"]), 1)), rtol=0, atol=2e-3)
    assert speeds["no"][:, 0].mean() < 0.09


def test_hydrostatic_pressure(lammps):
    """A column at rest between floor and lid: it stays at rest, and pressure grows with depth by rho g."""
    particles, owner = channel(2, jitter=0.0, size=(8, 24))
    g, model = 0.2, one_fluid(2, mu=2.0, kappa=20.0, pb=4.0)  # no tension; sound dies away
    particles.v[:] = 0.0
    wet = owner < 0
    gravity = dict(gravity=(0, -g, 0))
    for name, walls in (("with", [gravity] * 2), ("without", [{}, {}])):
        run_vessel(lammps, particles, owner, model, walls, f"fix G fluid addforce 0 {-g} 0\nrun 4000\n"
                   + dump(f"{name}.dump", owner) + "run 0\n")
    result = {}
    for name in ("with", "without"):
        frame = lammps.frame(f"{name}.dump")
        y, p = frame["x"][wet, 1], 100.0 * (frame["c_V[4]"][wet] - 1.0) + 4.0
        slope, level = np.polyfit(y, p, 1)
        result[name] = dict(slope=slope, residual=np.abs(p - slope * y - level).max(), speed=np.abs(frame["v"][wet]).max())
    print(result)
    assert result["with"]["slope"] == pytest.approx(-g, rel=0.01)
    assert result["with"]["residual"] < 0.02 * g * 18
    assert result["with"]["speed"] < 1e-3
    assert result["without"]["residual"] > 2 * result["with"]["residual"]


@pytest.mark.parametrize("dim", [1, 2])
def test_piston(lammps, dim):
    """Slow compression between a wall at rest and one that travels: pressure and density follow the length."""
    layers = int(SUPPORT[dim])
    size = 30 + 2 * layers
    particles = lattice(dim, size if dim == 1 else (size, 8))
    x = particles.x[:, 0]
    particles, owner = arrange(particles, [x < layers, x > size - layers])
    particles.lo[0], particles.hi[0] = -1.0, size + 1.0
    style = f"pair_style sph/bulk {'dim 1 shear none' if dim == 1 else ''}\n"
    coeff = f"pair_coeff * * 1.0 10.0 {0.0 if dim == 1 else 0.5} 80.0 {SUPPORT[dim]}\n"
    particles.write(lammps.path("box.data"))
    text = (header(dim, boundary="f p p") + "read_data box.data\n" + groups(owner) + style + coeff
            + "fix FLUID fluid sph/bulk\nfix W0 wall0 sph/wall\nvariable U equal -0.5*sin(0.1*PI*step*dt)^2\n"
            "fix W1 wall1 sph/wall velocity v_U 0 0\ntimestep 0.005\nrun 2000\nunfix W1\nfix W1 wall1 sph/wall\nrun 2000\n"
            f"thermo_style custom step {global_vector(0)} {global_vector(1)}\n" + FULL + dump("out.dump", owner) + "run 0\n")
    table = lammps(text).thermo()[-1]
    frame = lammps.frame("out.dump")
    moved = particles.x[owner == 1, 0] - frame["x"][owner == 1, 0]
    np.testing.assert_allclose(moved, 2.5, rtol=1e-6)
    middle = (owner < 0) & (np.abs(frame["x"][:, 0] - layers - 13.75) < 8.0)
    rho = frame["c_V[4]"][middle]
    force = 100.0 * (rho.mean() - 1.0) * (8 if dim == 2 else 1)
    length = 30.0 / rho.mean()
    print("density", rho.min(), rho.max(), "length", length, "force", table["f_W0[1]"], table["f_W1[1]"], force)
    assert np.ptp(rho) < 1e-3
    assert length == pytest.approx(27.5, abs=0.2)  # a tenth of a spacing at either wall
    assert table["f_W1[1]"][0] == pytest.approx(force, rel=0.03)
    assert table["f_W0[1]"][0] == pytest.approx(-table["f_W1[1]"][0], rel=5e-3)
    assert np.abs(frame["v"][owner < 0].mean(axis=0)).max() < 2e-3  # sound of the start, 0.5, has died away


# ---------------------------------------------------------------------------------------------
# particles in the wall, thin walls


@pytest.mark.parametrize("ranks, newton, lists", [(1, "on", "check yes"), (1, "off", "check yes"), (2, "on", "check yes"), (4, "off", "check yes"),
                                                  (1, "on", "every 8 check no")])
def test_particle_shot_into_a_wall(lammps, ranks, newton, lists):
    """Also where the neighbor list does not follow the particles."""
    particles, owner = channel(2)
    shot = np.flatnonzero((owner < 0) & (np.abs(particles.x[:, 1] - 5.5) < 0.4))[3]
    particles.v[shot] = [0, -300.0, 0]
    result = run_vessel(lammps, particles, owner, one_fluid(2), [{}, {}], f"timestep 0.002\nneigh_modify {lists}\nrun 40\n", ranks,
                        newton, check=False, timeout=60)
    assert result.code == 1, result.output[-2000:]
    assert re.search(rf"Particle {shot + 1} of the fluid .*inside a wall in step [1-9]\d*, at \S+ \S+ \S+ with the speed [1-9]\S*", result.error), result.error


def test_fluid_laid_into_the_wall(lammps):
    """Between its particles; found at the start."""
    particles, owner = channel(2, layers=5, size=(16, 26))
    inside = np.flatnonzero(owner < 0)[7]
    particles.x[inside, :2] = [6.9, 3.1]
    result = run_vessel(lammps, particles, owner, one_fluid(2), [{}, {}], "run 0\n", check=False)
    assert result.code == 1
    assert re.search(rf"Particle {inside + 1} of the fluid .*inside a wall", result.error), result.error


def thin(result):
    return [line for line in result.warnings if "thinner" in line]


OPEN = {2: "p f p", 3: "p f p"}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("dim, layers", [(2, 1), (2, 2), (2, 3), (2, 4), (3, 1), (3, 3)])
def test_layers_of_a_flat_wall(lammps, dim, layers, ranks):
    """The support radius is 3 (2d) or 2.5 (3d) spacings: three layers are enough."""
    particles, owner = channel(dim, layers=layers)
    result = run_vessel(lammps, particles, owner, one_fluid(dim), [{}, {}], "run 0\nrun 0\n", ranks, boundary=OPEN[dim])
    lines = thin(result)
    print(lines)
    if layers >= 3:
        assert not result.warnings, result.warnings
    else:
        assert len(lines) == 2, result.warnings
        for k, line in enumerate(lines):
            assert re.search(rf"fix W{k} sph/wall.* needs 3 layers", line)


@pytest.mark.parametrize("support, thinner, needed", [(3.0, 2, 3), (3.4, 2, 4), (3.6, 3, 4), (4.0, 3, 4)])
def test_layers_for_a_support_radius(lammps, support, thinner, needed):
    """Half a spacing is allowed to be missing."""
    for layers in (thinner, thinner + 1, needed):
        particles, owner = channel(2, layers=layers)
        lines = thin(run_vessel(lammps, particles, owner, replace(one_fluid(2), support=support), [{}, {}], "run 0\n",
                                boundary="p f p"))
        assert len(lines) == (2 if layers == thinner else 0), lines
        assert all(f"needs {needed} layers" in line for line in lines)


def test_time_step_beside_walls_of_another_fluid(lammps):
    """Density and speed of sound of the wall's type make no difference to the step, nor to the stages of rkl2."""
    text = ("units lj\ndimension 2\nboundary p f p\natom_style sph/bulk\nlattice sq 1.0 origin 0.5 0.5 0.0\n"
            "region box block 0 8 -3 9 -0.5 0.5\ncreate_box 2 box\ncreate_atoms 1 box\nregion fluid block INF INF 0 6 INF INF\n"
            "group fluid region fluid\ngroup wall subtract all fluid\nset group wall type 2\nset type 1 mass 1.0\nset type 2 mass {rho}\n"
            "neighbor 0.5 bin\npair_style sph/bulk\npair_coeff * * 1.0 10.0 5.0 15.0 3.0\npair_coeff 2 2 {rho} {c} 5.0 15.0 3.0\n"
            "fix 1 fluid sph/bulk viscous rkl2\nfix 2 wall sph/wall\ntimestep 0.01\nrun 0\n")
    lines = {re.search(r"largest stable time step with viscous.*", lammps(text.format(rho=rho, c=c)).log)[0] for rho, c in ((1.0, 10.0), (0.01, 30.0), (100.0, 3.0))}
    assert len(lines) == 1, lines


def test_points_of_contact_inside_of_a_wall(lammps):
    """Particles of another pair style, wherever they are, are neither fluid nor wall to the checks of layers and masses."""
    text = ("units lj\ndimension 2\nboundary p f p\natom_style sph/bulk\nlattice sq 1.0 origin 0.5 0.5 0.0\n"
            "region box block 0 12 -6 10 -0.5 0.5\ncreate_box 3 box\nregion all block INF INF -4 6 INF INF\ncreate_atoms 1 region all\n"
            "region wall block INF INF INF 0 INF INF\nset region wall type 2\nset type 1*2 mass 1.0\n{points}set type 3 mass 1e-8\n"
            "group fluid type 1\ngroup wall type 2\nneighbor 0.5 bin\npair_style hybrid/overlay sph/bulk zero 2.0\n"
            "pair_coeff 1*2 1*2 sph/bulk 1.0 10.0 0.1 0.3 4.0\npair_coeff 3 3 zero\npair_coeff 1*2 3 none\n"
            "fix 1 fluid sph/bulk\nfix 2 wall sph/wall\nrun 0\n")
    points = "region points block INF INF -3.5 0.5 INF INF\ncreate_atoms 3 region points\ncreate_atoms 3 region points\n"
    for some in ("", points):
        assert not lammps(text.format(points=some)).warnings


@pytest.mark.parametrize("dim", [2, 3])
def test_layers_of_a_cup(lammps, dim):
    """Cut from a lattice, its surface is not smooth."""
    radius = 6.0 if dim == 2 else 4.0
    for thick, warned in ((3.2, False), (1.6, True)):
        particles, owner = cup(dim, radius=radius, thick=thick)
        lines = thin(run_vessel(lammps, particles, owner, one_fluid(dim), [{}], "run 0\n", boundary=free(dim)))
        assert len(lines) == warned, (thick, lines)


def test_layers_of_corners_and_of_a_body(lammps):
    for layers in (3, 2):
        particles = lattice(2, 20)
        x, y = particles.x[:, 0], particles.x[:, 1]
        frame = np.minimum(np.minimum(x, 20 - x), np.minimum(y, 20 - y)) < layers
        body = (np.abs(x - 8) < 0.5 * layers + 0.5) & (np.abs(y - 11) < 3.1)  # a bar, wetted on both sides
        particles, owner = arrange(particles, [frame, body])
        result = run_vessel(lammps, particles, owner, one_fluid(2), [{}, {}], "run 0\n", boundary="f f p")
        assert len(thin(result)) == 2 * (layers == 2), result.warnings


# ---------------------------------------------------------------------------------------------
# bad input

GOOD = {"definitions": "", "dimension": "dimension 2", "boundary": "boundary p f p", "box": "read_data box.data",
        "groups": "group floor id <= 24\ngroup lid id >= 121\ngroup fluid subtract all floor lid",
        "pair": "pair_style sph/bulk\npair_coeff * * 1.0 10.0 0.5 2.0 3.0", "integrate": "fix 1 fluid sph/bulk",
        "wall": "fix W floor sph/wall", "lid": "fix L lid sph/wall", "extra": "", "run": "run 2"}
IN_3D = dict(dimension="dimension 3", box="read_data box3.data", boundary="boundary p p p")
MICROPOLAR = dict(pair="pair_style sph/micropolar\npair_coeff * * 1.0 10.0 0.5 2.0 0.3 0.05 -0.05 3.0",
                  integrate="fix 1 fluid sph/micropolar")


def deck(style=BULK, **changes):
    assert set(changes) <= set(GOOD)
    return f"units lj\natom_style {style}\n" + "\n".join({**GOOD, **changes}.values()) + "\n"


@pytest.fixture
def box(lammps):
    for name, dim, size in (("box", 2, (8, 18)), ("box3", 3, (6, 6, 6))):
        lattice(dim, size).write(lammps.path(f"{name}.data"))
    # rows along x: 24 of them below, 24 above
    particles = lattice(2, (8, 18))
    particles = particles.where(np.lexsort((particles.x[:, 0], particles.x[:, 1])))
    particles.write(lammps.path("box.data"))
    write(particles, lammps.path("spin.data"))
    return lammps


def case(expected_words, wall=None, **changes):
    if wall is not None:
        changes["wall"] = f"fix W floor sph/wall {wall}"
    return pytest.param(changes, expected_words, id=" | ".join(value.replace("\n", "; ") for value in changes.values())[:90])


def missing(keyword, number):
    """One test for every number of arguments that is too small."""
    return [case(["[Mm]issing", keyword], " ".join([keyword] + ["1.0"] * k)) for k in range(number)]


BAD = [
    # keywords
    case("Unknown fix sph/wall keyword: speed", "speed 1 0 0"),
    case("Unknown fix sph/wall keyword: 1.0", "1.0"),
    case("Unknown fix sph/wall keyword: 4", "velocity 1 2 0 4"),
    case("Unknown fix sph/wall keyword: 4", "gravity 1 2 0 4"),
    case("Unknown fix sph/wall keyword: yes", "move no yes"),
    case("Unknown fix sph/wall keyword: 0.5", "spin zero 0.5"),
    *missing("velocity", 3), *missing("gravity", 3), *missing("rotate", 7),
    *missing("move", 1), *missing("slip", 1), *missing("spin", 1),
    case(["[Mm]issing", "spin"], "spin rate"),
    # words
    case(["slip", "partial"], "slip partial"),
    case(["slip", "yes"], "slip yes"),
    case(["spin", "half"], "spin half"),
    case(["spin", "0.5"], "spin 0.5"),
    case("maybe", "move maybe"),
    case("much", "spin rate much"),
    case("fast", "velocity fast 0 0"),
    case("0,5", "velocity 0,5 0 0"),
    case(r"\bnan\b", "velocity nan 0 0"),
    case("1e999", "gravity 0 1e999 0"),
    case("down", "gravity 0 down 0"),
    case("Variable g ", "gravity 0 v_g 0"),
    case("here", "rotate here 0 0 0 0 1 0.5"),
    case("up", "rotate 0 0 0 0 0 up 0.5"),
    case("quick", "rotate 0 0 0 0 0 1 quick"),
    case("axis", "rotate 0 0 0 0 0 0 0.5"),
    case("axis", "rotate 0 0 0 0 0 0 0.5", **IN_3D),
    # variables
    case(["U", "does not exist"], "velocity v_U 0 0"),
    case(["O", "does not exist"], "rotate 0 0 0 0 0 1 v_O"),
    case(["U", "equal"], "velocity 0 v_U 0", definitions="variable U string hello"),
    case(["U", "equal"], "velocity v_U 0 0", definitions="variable U atom x"),
    case(["O", "equal"], "rotate 0 0 0 0 0 1 v_O", definitions="variable O atom y"),
    case("v_nothing", "velocity v_U 0 0", definitions="variable U equal v_nothing"),
    case("[Vv]ariable +.*does not exist", "velocity v_ 0 0"),
    # two dimensions
    case("2d", "velocity 0 0 0.1"),
    case("2d", "velocity 0 0 v_U", definitions="variable U equal 0.0"),
    case("2d", "gravity 0 0 -9.81"),
    case("2d", "rotate 0 0 0 0 1 0 0.5"),
    case("2d", "rotate 0 0 0 0.1 0 1 0.5"),
    # groups and other fixes
    case("no particles|empty", groups=GOOD["groups"] + "\ngroup none id 4711", wall="", integrate=GOOD["integrate"]
         + "\nfix N none sph/wall"),
    case("nowhere", integrate=GOOD["integrate"] + "\nfix N nowhere sph/wall"),
    case("dynamic", extra="group moving dynamic fluid every 1\nfix N moving sph/wall"),
    case("dynamic", extra="region R block INF INF INF 2 INF INF\ngroup floor dynamic all region R every 1"),
    case(["fix 1 sph/bulk", r"\d"], integrate="fix 1 all sph/bulk"),
    case(["fix W2 sph/wall"], extra="fix W2 floor sph/wall"),
    case("fix N nve", extra="fix N floor nve"),
    case("fix N nve/noforce", extra="fix N all nve/noforce"),
    case("fix M move", extra="fix M floor move linear 1 0 0"),
    case("fix M nve/limit", extra="fix M all nve/limit 0.1"),
    case("fix 1 sph/bulk", groups=GOOD["groups"] + "\ngroup wet union fluid floor", integrate="fix 1 wet sph/bulk"),
    # set-up
    case("requires pair style sph/bulk or sph/micropolar", pair="pair_style zero 3.0\npair_coeff * *"),
    case("pair style|[Mm]ust", pair=""),
    case("deform", extra="comm_modify vel yes\nfix D all deform 1 x erate 0.1 remap v"),
]
BAD_MICROPOLAR = [
    case("fix 1 sph/micropolar", **{**MICROPOLAR, "integrate": "fix 1 all sph/micropolar"}),
    case("Unknown fix sph/wall keyword: omega", "omega 1", **MICROPOLAR),
    case("much", "spin rate much", **MICROPOLAR),
]


def refused(box, text, expected_words, ranks):
    result = box(text, ranks=ranks, check=False, timeout=60)
    assert result.code != 0, f"accepted:\n{result.output[-3000:]}"
    assert result.code == 1, f"ended by status {result.code}:\n{result.output[-3000:]}"
    for word in [expected_words] if isinstance(expected_words, str) else expected_words:
        assert re.search(word, result.error), f"the message lacks '{word}':\n{result.error or result.output[-2000:]}"


@pytest.mark.parametrize("changes, expected_words", BAD)
def test_refused(box, changes, expected_words):
    refused(box, deck(**changes), expected_words, 1)


@pytest.mark.parametrize("changes, expected_words", BAD[6::6] + BAD[-18:])
def test_refused_on_two_ranks(box, changes, expected_words):
    refused(box, deck(**changes), expected_words, 2)


@pytest.mark.parametrize("changes, expected_words", BAD_MICROPOLAR)
@pytest.mark.parametrize("ranks", [1, 2])
def test_refused_with_spin(box, changes, expected_words, ranks):
    refused(box, deck(MICRO, box="read_data spin.data", **changes), expected_words, ranks)


@pytest.mark.parametrize("ranks", [1, 2])
def test_the_input_all_cases_start_from_is_good(box, ranks):
    for text in (deck(), deck(MICRO, box="read_data spin.data", **MICROPOLAR)):
        result = box(text, ranks=ranks)
        assert not result.warnings, result.warnings
        assert not re.search(r"\bnan\b", result.log)


def test_order_of_the_commands(box):
    """The fix may come before the pair style and before the integrator."""
    wall = GOOD["wall"] + "\n" + GOOD["lid"]
    result = box(deck(wall="", lid="", groups=GOOD["groups"] + "\n" + wall))
    assert not result.warnings, result.warnings


@pytest.mark.parametrize("wall", [
    "velocity 0 0 0 move yes slip no spin zero gravity 0 0 0", "spin free", "spin rate 1.5",
    "rotate 0 0 0 0 0 -3 0.1 move no",
    "velocity v_U 0 0 slip free", "velocity v_U v_V 0 rotate 0 0 0 0 0 1 v_O move no"])
def test_accepted(box, wall):
    result = box(deck(definitions="variable U equal 0.1*step*dt\nvariable V equal 0.0\nvariable O equal sin(step*dt)",
                      wall=f"fix W floor sph/wall {wall}"))
    assert not result.warnings, result.warnings


# ---------------------------------------------------------------------------------------------
# walls whose reference density is not that of the fluid; test_combinations.py has them with all features


def layers(lower, upper, wall, volume="mass"):
    """Two layers of fluid in a channel, 10 rows each, and its walls, with these reference densities and one mu; a body force per
    volume drives them from the exact profile."""
    speed = "".join(f"variable c{k} equal 5.0/sqrt({rho})\npair_coeff {k} {k} {rho} ${{c{k}}} 0.5 intrinsic 0.4 pb 1.0\n"
                    f"set type {k} mass $(0.01*{rho})\n" for k, rho in enumerate((wall, lower, upper), 1))
    return (header(2, boundary="p f p") + "lattice sq 100.0 origin 0.5 0.5 0\nregion box block 0 1.0 -1.4 1.4 -0.5 0.5 units box\n"
            "create_box 3 box\ncreate_atoms 1 box\nregion below block INF INF INF -1.0 INF INF units box\n"
            "region above block INF INF 1.0 INF INF INF units box\nregion top block INF INF 0.0 1.0 INF INF units box\n"
            "group below region below\ngroup above region above\ngroup fluid subtract all below above\nset group fluid type 2\n"
            "set region top type 3\ngroup lower type 2\ngroup upper type 3\n"
            f"pair_style sph/bulk volume {volume}\n{speed}"
            "variable u atom 0.1*(1.0-y^2)\nvelocity fluid set v_u 0 0\nfix I fluid sph/bulk viscous rkl2\n"
            f"fix L lower gravity $(0.1/{lower}) vector 1 0 0\nfix U upper gravity $(0.1/{upper}) vector 1 0 0\n"
            "fix B below sph/wall\nfix A above sph/wall\ntimestep 0.005\n"
            f"compute C fluid chunk/atom bin/1d y lower 0.1 units box\nfix P fluid ave/chunk 1 1 1 C vx file profile\nrun 1000\n")


def profile(lammps, *args):
    """Mean velocities of the rows."""
    lammps(layers(*args))
    rows = [line.split() for line in open(lammps.path("profile")) if line.startswith("  ")][-28:]
    return np.array([float(row[3]) for row in rows if float(row[2]) > 0.0])


def test_densities_of_walls(lammps):
    """One fluid, or two of a ratio of 10, flow as fluids of the walls' density do."""
    alike = profile(lammps, 1.0, 1.0, 1.0)
    y = np.arange(20) * 0.1 - 0.95
    np.testing.assert_allclose(alike, 0.1 * (1.0 - y**2), rtol=0, atol=0.004)  # mg at a support of four spacings
    for lower, upper, wall, volume in ((1.0, 1.0, 7.0, "number"), (0.1, 1.0, 1.0, "mass"), (10.0, 1.0, 0.5, "number")):
        found = profile(lammps, lower, upper, wall, volume)
        np.testing.assert_allclose(found, alike, rtol=0, atol=0.001)


@pytest.mark.parametrize("ratio", [10, 1000])
def test_drop_on_a_wall_of_another_density(lammps, ratio):
    """A heavy drop in a light fluid rests on a wall, whose reference density is that of neither."""
    light, wall = 1.0 / ratio, 0.2
    result = lammps(
        header(2, boundary="p f p") + "lattice sq 400.0 origin 0.5 0.5 0\nregion box block 0 1.6 -0.2 1.2 -0.5 0.5 units box\n"
        "create_box 3 box\ncreate_atoms 3 box\nregion below block INF INF INF 0 INF INF units box\n"
        "region above block INF INF 1.0 INF INF INF units box\nregion drop sphere 0.8 0.0 0 0.5 units box\nset region drop type 2\n"
        "group below region below\ngroup above region above\ngroup walls union below above\nset group walls type 1\n"
        f"group fluid subtract all walls\ngroup drop type 2\nset type 1 mass {0.0025 * wall}\nset type 2 mass 0.0025\nset type 3 mass {0.0025 * light}\n"
        f"pair_style sph/bulk volume mass\npair_coeff 1 1 {wall} 20.0 0.1 intrinsic 0.2 pb 20.0\npair_coeff 2 2 1.0 10.0 0.1 intrinsic 0.2 pb 20.0\n"
        f"pair_coeff 3 3 {light} {10 * ratio**0.5} {0.1 * light**0.5} intrinsic 0.2 pb 20.0\npair_coeff 2 3 tension 0.5\n"
        "fix I fluid sph/bulk\nfix G drop gravity 1.0 vector 0 -1 0\nfix B below sph/wall\nfix A above sph/wall\nfix T all sph/dt 10\n"
        "variable least equal bound(drop,ymin)\nthermo_style custom step v_least\nthermo 100\nrun 2000\n")
    least = result.thermo()[0]["v_least"]
    assert 0.2 * 0.05 < least.min() and least.max() < 0.6 * 0.05


# flow rates of the page about walls: {rows, support over spacing: mg, mg/fr2}
FLOWS = {(20, 2.6): (1.133, 1.023), (20, 3.0): (1.073, 1.006), (20, 4.0): (1.026, 1.004),
         (11, 2.6): (1.138, 1.027), (11, 3.0): (1.080, 1.013), (11, 4.0): (1.034, 1.013)}


# ... of fewer and of more rows: {rows: wendland/c2, quintic, wendland/c2 with temp 0}, mg/fr2, three spacings
ROWS = {5: (1.056, 1.041, 1.117), 10: (1.016, 1.010, 1.032), 20: (1.006, 1.002, 1.010), 40: (1.004, None, 1.005)}


@pytest.mark.parametrize("shear, kernel, lattice, rows, support, flow", [
    ("mg", "wendland/c2", "hex", 20, 3.0, 1.073), ("mg/fr2", "wendland/c2", "hex", 20, 3.0, 1.006), ("mg/fr2", "wendland/c2", "sq", 20, 3.0, 1.009),
    ("mg/fr2", "quintic", "hex", 20, 3.0, 1.002), ("mg/fr2", "quintic", "sq", 20, 3.0, 1.002),
    *(pytest.param(shear, "wendland/c2", "hex", *case, flow, marks=pytest.mark.long)
      for case, flows in FLOWS.items() for shear, flow in zip(("mg", "mg/fr2"), flows)),
    *(pytest.param("mg/fr2" + noise, kernel, "hex", rows, 3.0, flow, marks=pytest.mark.long) for rows, flows in ROWS.items()
      for kernel, noise, flow in zip(("wendland/c2", "quintic", "wendland/c2"), ("", "", " temp 0 4711"), flows) if flow)])
def test_flow_rate(lammps, shear, kernel, lattice, rows, support, flow):
    """A channel of rows along its walls at a Reynolds number of 1, over the exact flow rate."""
    a = (4 / 3)**0.25 if lattice == "hex" else 1.0  # distance in a row
    height = rows / a
    second = "basis 0.75 0.75 0" if lattice == "hex" else "basis 0.25 0.75 0"
    text = (header(2, boundary="p f p") + f"lattice custom 1.0 a1 {a} 0 0 a2 0 {2 / a} 0 a3 0 0 1 basis 0.25 0.25 0 {second}\n"
            f"region box block 0 {12 * a} {-6 / a} {(rows + 6) / a} -0.5 0.5 units box\ncreate_box 1 box\ncreate_atoms 1 box\n"
            f"region inside block INF INF 0 {height} INF INF units box\ngroup fluid region inside\ngroup walls subtract all fluid\n"
            f"set group all mass 1.0\npair_style sph/bulk kernel {kernel} shear {shear}\n"
            f"pair_coeff * * 1.0 1.5 {0.05 * height} intrinsic {support}\n"
            f"variable u atom 0.4*y*({height}-y)/{height}^2\nvelocity fluid set v_u 0 0\nfix I fluid sph/bulk density rho0\n"
            f"fix G fluid gravity {0.04 / height} vector 1 0 0\nfix W walls sph/wall\n"
            f"timestep {0.1 if rows == 20 and 'temp' not in shear else 0.05 if rows > 20 else 0.07 if rows > 5 else 0.02}\n"
            "variable flow equal vcm(fluid,x)*15.0\nfix A all ave/time 10 100 1000 v_flow\nthermo_style custom step f_A\nthermo 1000\n"
            f"run {20000 if rows > 20 else 5000}\n")
    found = lammps(text, timeout=300).thermo()[-1]["f_A"][2:]
    assert found.mean() == pytest.approx(flow, abs=0.006 if shear == "mg" else 0.003)


# ---------------------------------------------------------------------------------------------
# the inputs of the manual

HOWTO = Path(__file__).resolve().parents[2] / "doc" / "src" / "Howto_sph_walls.rst"


def inputs_of_the_manual():
    blocks = re.findall(r"^\.\. code-block:: LAMMPS\n\n((?: {3}.*\n|\n)+)", HOWTO.read_text(), re.MULTILINE)
    whole = [re.sub("^   ", "", block, flags=re.MULTILINE) for block in blocks if "atom_style" in block]
    return {text.splitlines()[0][2:]: text for text in whole}


def test_there_are_inputs_in_the_manual():
    assert len(inputs_of_the_manual()) == 5


@pytest.mark.parametrize("title", inputs_of_the_manual())
def test_inputs_of_the_manual(lammps, title):
    """Short and small; no warnings."""
    text = inputs_of_the_manual()[title]
    text, count = re.subn(r"^variable +n index \d+", "variable n index 16", text, flags=re.MULTILINE)
    assert count == 1
    text = re.sub(r"^run .*", "run 300", text, flags=re.MULTILINE)
    text = re.sub(r"^thermo  +1000", "thermo 100", text, flags=re.MULTILINE)
    result = lammps(text)
    assert not result.warnings, result.warnings
    (table,) = result.thermo()
    of_walls = [name for name in table if name.startswith(("f_", "v_"))]
    assert len(of_walls) >= 2
    assert all(np.isfinite(table[name]).all() and np.abs(table[name][-1]) > 0.0 for name in of_walls)


def test_profile_of_the_heated_channel(lammps):
    """The file of the page has all rows of the fluid and none of the walls, and the exact profiles within 0.5 % of their largest values."""
    lammps(inputs_of_the_manual()["A heated channel: a body force drives the fluid between a hot and a cold wall, and friction heats it"])
    rows = np.array([line.split() for line in open(lammps.path("profile.txt")) if line.startswith("  ")][-20:], dtype=float)
    _, y, count, velocity, temperature = rows.T
    np.testing.assert_allclose(y, (np.arange(20) + 0.5) / 20)
    assert (count == 20).all()
    np.testing.assert_allclose(velocity, 0.4 * y * (1 - y) / 0.2, rtol=0, atol=0.0025)
    np.testing.assert_allclose(temperature, 2 - y + 0.16 / 0.12 * (1 / 16 - (y - 0.5)**4), rtol=0, atol=0.005)


# drag of simple cubic arrays over that of Stokes, by volume fraction: A. A. Zick, G. M. Homsy, J. Fluid Mech. 115, 13 (1982)

ZICK = {0.064: 2.810, 0.125: 4.292, 0.216: 7.442, 0.343: 15.4}


@pytest.mark.parametrize("n, radius, steps, bound", [(16, 6.0, 110, "move rigid"), *(pytest.param(*array, bound, marks=pytest.mark.long) for array in ((16, 6.0, 220), (20, 6.2, 400))
                                                                                     for bound in ("gravity 1e-4 0 0", "move rigid"))])
def test_drag_of_a_cubic_array_of_spheres(lammps, n, radius, steps, bound):
    """Volume fractions 0.223 and 0.121; fixed or held by fix rigid; the fluid begins with the velocity of the published drag."""
    side, g, middle = np.arange(n) + 0.5, 1e-4, n / 2
    count = (np.linalg.norm(np.stack(np.meshgrid(side, side, side)) - middle, axis=0) < radius).sum()
    a, phi = np.cbrt(3 * count / (4 * np.pi)), count / n**3

    def rest(fraction):
        """1/K but for the interpolated part: H. Hasimoto, J. Fluid Mech. 5, 317 (1959)"""
        return 1 - 1.7601 * np.cbrt(fraction) + fraction - 1.5593 * fraction**2

    known = np.array(list(ZICK))
    drag = 1 / (rest(phi) + np.polyval(np.polyfit(np.cbrt(known), 1 / np.array(list(ZICK.values())) - rest(known), 3), np.cbrt(phi)))
    speed = g * n**3 / (6 * np.pi * a * drag * (1 - phi))
    rigid = "fix RIGID ball rigid single force 1 off off off torque 1 off off off\n" if "rigid" in bound else ""
    table = lammps(f"units lj\ndimension 3\natom_style sph/bulk\nlattice sc 1.0 origin 0.5 0.5 0.5\nregion BOX block 0 {n} 0 {n} 0 {n}\ncreate_box 2 BOX\n"
                   f"create_atoms 1 box\nregion BALL sphere {middle} {middle} {middle} {radius}\nset region BALL type 2\nset group all mass 1.0\n"
                   f"group fluid type 1\ngroup ball type 2\nvelocity fluid set {speed} 0 0\nneighbor 0.3 bin\npair_style sph/bulk kernel quintic shear mg/fr2\n"
                   f"pair_coeff * * 1.0 1.0 1.0 2.0 3.0\nfix PUSH fluid gravity {g} vector 1 0 0\nfix FLOW fluid sph/bulk viscous rkl2\n{rigid}"
                   f"fix BALL ball sph/wall {bound}\ntimestep 0.28\nvariable u equal vcm(fluid,x)\nthermo_style custom step v_u\nthermo {steps}\nrun {steps}\n").thermo()[-1]
    ratio = speed / table["v_u"][-1]
    print(f"phi {phi:.5f}, radius {a:.3f}: drag over the published one {ratio:.4f}")
    assert abs(ratio - 1.0) < 0.03
