"""Keyword shift of fix sph/bulk and fix sph/micropolar: displacements and impulses against sums of its own, what is conserved, ranks, bad
input."""

import re

import numpy as np
import pytest

import test_wall as walls
from helpers import INTEGRATE, SUPPORT, disordered, drop, fluid, header, lattice, relative
from test_micropolar import spins, write

BULK, MICRO = "sph/bulk", "sph/micropolar"
STEP, STEPS = 0.002, 8  # time step; steps from one shift to the next one
SPEED = 12.0  # much larger than that of the flow: one shift has to show the displacement to twelve digits
DUMP = "dump D all custom 1 out.dump id xu yu zu vx vy vz\ndump_modify D sort id format float %.17g\n"

# ---------------------------------------------------------------------------------------------
# the shifting velocity from its equation

KERNELS = {  # sums of a (b - q)_+^p times a polynomial of q
    "wendland/c2": [(1, 1, 4, [1, 4])],
    "wendland/c4": [(1, 1, 6, [1, 6, 35 / 3])],
    "wendland/c6": [(1, 1, 8, [1, 8, 25, 32])],
    "lucy": [(1, 1, 3, [1, 3])],
    "cubic": [(1, 1, 3, [1]), (-4, 1 / 2, 3, [1])],
    "quintic": [(1, 1, 5, [1]), (-6, 2 / 3, 5, [1]), (15, 1 / 3, 5, [1])],
}


def shape(kernel, q):
    """w(q) and its derivative, not normalised."""
    w, slope = np.zeros_like(q), np.zeros_like(q)
    for a, b, p, coefficients in KERNELS[kernel]:
        rest, factor = np.maximum(b - q, 0.0), np.polynomial.Polynomial(coefficients)
        w += a * rest ** p * factor(q)
        slope += a * (rest ** p * factor.deriv()(q) - p * rest ** (p - 1) * factor(q))
    return w, slope


def norm(kernel, dim):
    """By quadrature, exact for polynomials between the multiples of 1/6."""
    nodes, weights = np.polynomial.legendre.leggauss(12)
    q = (np.arange(6)[:, None] + 0.5 * (nodes + 1.0)).ravel() / 6.0
    surface = {1: 2.0, 2: 2 * np.pi, 3: 4 * np.pi}[dim]
    return 1.0 / (surface * (np.tile(weights / 12.0, 6) * q ** (dim - 1) * shape(kernel, q)[0]).sum())


def sums(kernel, dim):
    """Integral of F over space times the square of the support radius, by quadrature."""
    nodes, weights = np.polynomial.legendre.leggauss(12)
    q = (np.arange(6)[:, None] + 0.5 * (nodes + 1.0)).ravel() / 6.0
    surface = {1: 2.0, 2: 2 * np.pi, 3: 4 * np.pi}[dim]
    return -norm(kernel, dim) * surface * (np.tile(weights / 12.0, 6) * q ** (dim - 2) * shape(kernel, q)[1]).sum()


def shifting(particles, support, kernel, speed, middle, vol=None, still=None, surfaces=False):
    """Displacements, changes of the velocities by impulses, and which particles are at the limit of the displacement.

    middle: velocities after the first half of the kick; vol of a fluid without walls follows from the number density; still: particles
    that are not shifted; speed: a number, or "auto"."""
    dim, length, m = particles.dim, particles.hi - particles.lo, particles.mass
    moves = np.full(len(m), True) if still is None else ~still
    r = particles.x[:, None] - particles.x
    r -= length * np.round(r / length)
    dist = np.linalg.norm(r, axis=2)
    scale = norm(kernel, dim) / support ** dim
    w, slope = shape(kernel, np.minimum(dist / support, 1.0))
    if vol is None:
        vol = 1.0 / (scale * w).sum(axis=1)
    contact = shape(kernel, np.minimum(vol ** (1.0 / dim) / support, 0.9))[0]
    F = -scale / support * slope / np.where(dist > 0.0, dist, 1.0)
    np.fill_diagonal(F, 0.0)
    gradient = np.einsum("ij,ijd->id", vol * F * (1.0 + 0.2 * (w / contact[:, None]) ** 4), r)
    time = STEPS * STEP
    if speed == "auto":
        slopes = np.einsum("ij,ija,ijb->iab", vol * F, particles.v[:, None] - particles.v, r)
        strain = 0.5 * (slopes + slopes.transpose(0, 2, 1))
        speed = 5.0 * support * np.sqrt(2.0 * (strain ** 2).sum(axis=(1, 2)))
    way = np.minimum(time * speed, 0.1 * support) * np.ones(len(m))
    size = support * np.linalg.norm(gradient, axis=1)
    delta = (way * support * np.minimum(1.0, 0.5 / np.where(size > 0.0, size, 1.0)))[:, None] * gradient
    if surfaces:
        tensor = np.einsum("ij,ija,ijb->iab", vol * F, r, r)[:, :dim, :dim]
        delta *= np.clip((np.linalg.eigvalsh(tensor)[:, 0] - 0.6) / 0.3, 0.0, 1.0)[:, None]
    share = np.where(np.outer(moves, moves), F * np.outer(vol, vol) * np.minimum(m / m[:, None], m[:, None] / m), 0.0)
    total = share.sum(axis=1)
    stays = ~(moves & (total > 0.25 * vol * sums(kernel, dim) / support ** 2))
    delta[stays] = 0.0
    q = np.where(stays[:, None], 0.0, m[:, None] * delta / np.where(total > 0.0, total, 1.0)[:, None])
    moved = delta - share @ q / m[:, None]
    moved[~moves] = 0.0
    u = middle[:, None] - middle
    lost = np.cross(q, np.einsum("ij,ijd->id", share, u))
    apart = r + moved[:, None] - moved
    spin = np.zeros_like(lost)
    if dim > 1:
        inertia = np.einsum("ij,ijab->iab", share, np.einsum("ijd,ijd,ab->ijab", apart, apart, np.eye(3)) - np.einsum(
            "ija,ijb->ijab", apart, apart))
        some = np.abs(lost).max(axis=1) > 0.0
        spin[some] = -np.linalg.solve(inertia[some], lost[some][:, :, None])[:, :, 0]
    impulse = np.einsum("ij,ijd->id", share, np.cross(spin[:, None] + spin, apart))
    return moved, impulse / m[:, None], moves & ~stays & (size > 0.5)


def one_step(lammps, text, speed=SPEED, keywords="", ranks=1, start=None):
    """Positions after one step with the keyword minus those without, and the velocities in the middle of the step; text has the fix
    command without keywords."""
    places = []
    for extra in ("", f" shift {speed}"):
        line = re.search(r"^fix FLUID .*$", text, re.MULTILINE)[0]
        lammps(text.replace(line, line + keywords + extra) + DUMP + "run 1\n", ranks=ranks)
        places.append(lammps.frame("out.dump"))
    assert places[1].step == 1
    assert (places[0]["v"][0] != places[1]["v"][0]).any()  # the second half of the step has other forces
    return places[1]["x"] - places[0]["x"], (places[0]["x"] - lammps.frames("out.dump")[0]["x"]) / STEP


def assert_displaced(lammps, text, particles, support, kernel="wendland/c2", speed=SPEED, ranks=1, keywords="", **more):
    moved, middle = one_step(lammps, text, speed, keywords, ranks)
    displacement, kick, limited = shifting(particles, support, kernel, speed, middle, **more)
    wanted = displacement + STEP * kick
    difference = relative(moved - wanted, wanted)
    print(f"largest difference {difference:.1e}, {limited.sum()} of {len(limited)} particles at the limit, largest displacement "
          f"{np.abs(displacement).max():.1e}, by impulses {STEP * np.abs(kick).max():.1e}")
    assert difference < 1e-12
    assert particles.dim == 1 or STEP * np.abs(kick).max() > 1e-9 * np.abs(displacement).max()
    return moved, limited


@pytest.mark.parametrize("kernel, jitter", [*((kernel, 0.1) for kernel in KERNELS), ("wendland/c2", 0.4)])
@pytest.mark.parametrize("dim, cells, support", [(1, 30, 4.0), (2, (13, 14), 3.2), (3, (7, 8, 7), 2.6)])
def test_displacement_of_one_step(lammps, dim, cells, support, kernel, jitter):
    particles = disordered(dim, cells, jitter=jitter, ntypes=2)
    particles.write(lammps.path("box.data"))
    text = (header(dim) + "read_data box.data\n" + fluid(dim, f"kernel {kernel}", support=support) + INTEGRATE
            + f"timestep {STEP}\n")
    _, limited = assert_displaced(lammps, text, particles, support, kernel)
    assert not limited.all()
    assert limited.any() or (dim == 1 or jitter < 0.2)


@pytest.mark.parametrize("dim", [1, 2, 3])
@pytest.mark.parametrize("speed", ["auto", 1e4])
def test_speed(lammps, dim, speed):
    """That of the local rate of shear; and one at which the displacement is cut off."""
    particles = disordered(dim, {1: 30, 2: 14, 3: 7}[dim], jitter=0.2, speed=1.0)
    particles.write(lammps.path("box.data"))
    text = header(dim) + "read_data box.data\n" + fluid(dim) + INTEGRATE + f"timestep {STEP}\n"
    moved, _ = assert_displaced(lammps, text, particles, SUPPORT[dim], speed=speed)
    if speed != "auto":
        assert np.abs(moved).max() < 0.1 * SUPPORT[dim]


@pytest.mark.parametrize("dim", [2, 3])
def test_displacement_near_a_free_surface(lammps, dim):
    """With density continuity: nothing at the surface, all inside."""
    particles = drop(dim, 9.0 if dim == 2 else 5.0, speed=0.1)
    text = (header(dim, boundary="f f f" if dim == 3 else "f f p") + "read_data box.data\n" + fluid(dim, "density continuity") + INTEGRATE
            + f"timestep {STEP}\n")
    particles.write(lammps.path("box.data"))
    moved, _ = assert_displaced(lammps, text, particles, SUPPORT[dim], speed=1.0, vol=particles.mass, surfaces=True)
    outside = np.linalg.norm(particles.x, axis=1) > np.linalg.norm(particles.x, axis=1).max() - 0.5
    assert np.abs(moved[outside]).max() < 0.2 * np.abs(moved).max()


@pytest.mark.parametrize("dim, style, name, kernel, ranks, newton", [
    (2, BULK, "turning", "wendland/c2", 1, "on"), (2, BULK, "turning", "wendland/c2", 4, "off"),
    (2, BULK, "free", "lucy", 1, "off"), (2, MICRO, "spin rate", "wendland/c2", 2, "on"),
    (3, BULK, "moving", "wendland/c2", 1, "on"), (3, MICRO, "moving", "wendland/c2", 2, "off")])
def test_displacement_next_to_walls(lammps, dim, style, name, kernel, ranks, newton):
    """The walls count with their extrapolated volume, and are not shifted."""
    particles, owner = walls.SETS[dim]
    model, omega, want = walls.expected(dim, style, name, dict(kernel=kernel))
    walls.save(lammps, particles, model, omega)
    text = walls.start(model, owner, walls.WALLS[dim][name], newton=newton, step=STEP)
    moved, _ = assert_displaced(lammps, text, particles, model.support, kernel, ranks=ranks, vol=want["vol"], still=owner >= 0)
    assert (moved[owner >= 0] == 0.0).all()


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("order", [0, 1])
def test_shift_and_inertia(lammps, dim, order):
    """Both keywords of fix sph/micropolar, in either order."""
    particles = disordered(dim, 13 if dim == 2 else 7, jitter=0.15)
    write(particles, lammps.path("box.data"), spins(particles))
    keywords = ["inertia 0.3 0.1", f"shift {SPEED}"]
    support = SUPPORT[dim]
    text = (header(dim, style=MICRO) + "read_data box.data\n" + walls.pair_commands(walls.one_fluid(dim, MICRO))
            + f"fix FLUID all {MICRO}\ntimestep {STEP}\ncompute I all property/atom inertia vol\n")
    places, first = [], None
    for words in (keywords[:1], keywords[::(-1 if order else 1)]):
        lammps(text.replace(MICRO + "\ntimestep", f"{MICRO} {' '.join(words)}\ntimestep")
               + DUMP.replace("vx", "c_I[*] vx") + "run 1\n")
        places.append(lammps.frame("out.dump")["x"])
        first = lammps.frames("out.dump")[0]
        np.testing.assert_allclose(first["c_I[1]"], 0.3 * first["c_I[2]"] ** (2 / dim) + 0.1, rtol=1e-14)
    displacement, kick, _ = shifting(particles, support, "wendland/c2", SPEED, (places[0] - first["x"]) / STEP)
    wanted = displacement + STEP * kick
    assert relative(places[1] - places[0] - wanted, wanted) < 1e-12


def test_only_the_group_is_shifted(lammps):
    """Two fixes: one of them shifts its particles."""
    particles = disordered(2, 13, ntypes=2)
    particles.write(lammps.path("box.data"))
    text = (header(2) + "read_data box.data\n" + fluid(2) + f"group A type 1\ngroup B type 2\ntimestep {STEP}\n"
            "fix OTHER B sph/bulk\nfix FLUID A sph/bulk\n")
    moved, _ = assert_displaced(lammps, text, particles, SUPPORT[2], still=particles.type == 2)
    assert (moved[particles.type == 2] == 0.0).all()


def test_hybrid_overlay(lammps):
    particles = disordered(2, 13)
    particles.write(lammps.path("box.data"))
    pair = fluid(2).replace("pair_style sph/bulk", "pair_style hybrid/overlay zero 3.0 sph/bulk").replace(
        "pair_coeff * *", "pair_coeff * * zero\npair_coeff * * sph/bulk")
    text = header(2) + "read_data box.data\n" + pair + INTEGRATE + f"timestep {STEP}\n"
    assert_displaced(lammps, text, particles, SUPPORT[2])


def test_time_step_zero(lammps):
    """Nothing moves, and nothing becomes a number that is not finite."""
    disordered(2, 13).write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\n" + fluid(2) + "fix FLUID all sph/bulk shift auto\ntimestep 0\ncompute E all property/atom esph\n"
           + DUMP.replace("id xu", "id c_E xu") + "run 3\n")
    first, *_, last = lammps.frames("out.dump")
    for name in ("x", "v", "c_E"):
        assert (first[name] == last[name]).all()


def test_zero_is_no_shifting(lammps):
    disordered(2, 13).write(lammps.path("box.data"))
    frames = []
    for keywords in ("", " shift 0"):
        lammps(header(2) + "read_data box.data\n" + fluid(2) + f"fix FLUID all sph/bulk{keywords}\ntimestep 0.005\n"
               + DUMP + "run 20\n")
        frames.append(lammps.frame("out.dump"))
    for name in ("x", "v"):
        assert (frames[0][name] == frames[1][name]).all()


# ---------------------------------------------------------------------------------------------
# runs

@pytest.mark.parametrize("dim, cells, style, newton", [(2, 16, BULK, "on"), (2, 16, MICRO, "off"), (3, 7, BULK, "off")])
def test_momentum(lammps, dim, cells, style, newton):
    """Impulses are those of pairs: linear momentum stays to rounding errors."""
    particles = disordered(dim, cells)
    model = walls.one_fluid(dim, style)
    walls.save(lammps, particles, model, spins(particles) if style == MICRO else None)
    lammps(header(dim, newton=newton, style=style) + "read_data box.data\n" + walls.pair_commands(model)
           + f"fix FLUID all {style} shift 1.0\ntimestep 0.005\n" + DUMP.replace("custom 1", "custom 300") + "run 300\n")
    first, last = lammps.frames("out.dump")
    momentum = [particles.mass[:, None] * frame["v"] for frame in (first, last)]
    drift = np.abs(momentum[1].sum(axis=0) - momentum[0].sum(axis=0)).max() / np.linalg.norm(momentum[0], axis=1).sum()
    travelled = np.linalg.norm(last["x"] - first["x"], axis=1).mean()
    print(f"drift of momentum {drift:.1e}, way of a particle {travelled:.2f}")
    assert drift < 1e-14
    assert travelled > 0.05


@pytest.mark.parametrize("dim, style, pair, speed, steps", [
    (2, BULK, "density continuity tension yes", "auto", 1000), (2, BULK, "density continuity volume mass", "0.5", 400),
    (3, BULK, "density continuity tension yes shear mg/fr2", "auto", 200), (2, MICRO, "density continuity", "auto", 200),
    pytest.param(2, BULK, "density continuity tension yes", "auto", 10000, marks=pytest.mark.long)])
def test_free_drop(lammps, dim, style, pair, speed, steps):
    """Momentum, center of mass, angular momentum, and the sum of kinetic and internal energy, which viscous implicit has exact."""
    particles = drop(dim, 9.0 if dim == 2 else 5.0, speed=0.1)
    particles.v[:, :dim] += [0.3, -0.2, 0.1][:dim]
    model = walls.one_fluid(dim, style)
    walls.save(lammps, particles, model, 0.1 * spins(particles) if style == MICRO else None)
    bounds = "f f p" if dim == 2 else "f f f"
    coefficients = walls.pair_commands(model).replace("pair_style " + style, f"pair_style {style} {pair}")
    inertia = " inertia 0.3 0.1" if style == MICRO else ""
    result = lammps(header(dim, style=style, boundary=bounds) + "read_data box.data\n" + coefficients + "change_box all "
           + " ".join(f"{axis} final -60 60" for axis in "xyz"[:dim]) + f"\nfix FLUID all {style}{inertia} shift {speed} viscous implicit\n"
           "timestep 0.01\ncompute E all sph/energy\ncompute S all property/atom esph" + (" inertia\n" if style == MICRO else "\n")
           + "thermo_style custom step c_E\nthermo_modify format float %.17g\n" + f"thermo {steps}\n"
           + DUMP.replace("custom 1", f"custom {steps}").replace("vx", ("c_S[2] omegax omegay omegaz " if style == MICRO else "") + "vx")
           + f"run {steps}\n", timeout=300)
    energy = result.thermo()[-1]["c_E"]
    first, last = lammps.frames("out.dump")
    m = particles.mass[:, None]
    momentum, spread = [], []
    for frame in (first, last):
        turning = np.cross(frame["x"], m * frame["v"])
        if style == MICRO:
            turning = turning + m * frame["c_S[2]"][:, None] * np.column_stack([frame[f"omega{axis}"] for axis in "xyz"])
        momentum.append([(m * frame["v"]).sum(axis=0), turning.sum(axis=0)])
        spread.append([np.abs(m * frame["v"]).sum(), np.abs(turning).sum()])
    drift = np.abs(np.subtract(*momentum)).max(axis=1) / spread[0]
    way = (m * (last["x"] - first["x"])).sum(axis=0) - 0.01 * steps * momentum[0][0]
    print(f"drift of momentum {drift[0]:.1e}, of angular momentum {drift[1]:.1e}, of the center of mass {np.abs(way).max() / m.sum():.1e}, "
          f"of energy {energy[-1] / energy[0] - 1:.1e}")
    assert (drift < 1e-12).all()
    assert np.abs(way).max() < 1e-11 * m.sum()
    assert abs(energy[-1] / energy[0] - 1) < 1e-12
    assert np.linalg.norm(last["x"] - first["x"], axis=1).mean() > 0.01


def trajectory(lammps, dim, style, ranks=1, newton="on", commands="run 100\n"):
    (particles, owner), vessel = walls.vessel(dim)
    model = walls.one_fluid(dim, style)
    walls.save(lammps, particles, model, 0.3 * spins(particles) if style == MICRO else None)
    text = walls.start(model, owner, vessel, newton, step=0.005).replace(f"fluid {style}\n", f"fluid {style} shift 0.5\n")
    lammps(text + walls.BODY + walls.dump("out.dump", owner, 100, style) + commands, ranks=ranks)
    return lammps.frame("out.dump")


@pytest.fixture(scope="module")
def serial(shared_lammps):
    known = {}

    def get(dim, style):
        if (dim, style) not in known:
            known[dim, style] = trajectory(shared_lammps, dim, style)
        return known[dim, style]

    return get


@pytest.mark.parametrize("dim, style, ranks, newton", [
    (2, BULK, 1, "off"), (2, BULK, 2, "on"), (2, BULK, 2, "off"), (2, BULK, 4, "on"), (2, BULK, 4, "off"),
    (2, MICRO, 2, "on"), (3, BULK, 4, "off")])
def test_same_trajectory(lammps, serial, dim, style, ranks, newton):
    """In a vessel with walls."""
    walls.assert_same(serial(dim, style), trajectory(lammps, dim, style, ranks, newton), style)


def test_run_pre_no_continues_exactly(lammps, serial):
    walls.assert_same(serial(2, BULK), trajectory(lammps, 2, BULK, commands="run 50\nrun 50 pre no\n"), BULK)


# ---------------------------------------------------------------------------------------------
# what it is for

STILL = "pair_coeff * * 1.0 1.0e-6 0.5 2.0"  # a fluid almost without pressure: nothing but shifting moves it


@pytest.mark.parametrize("dim, cells", [(2, 12), (3, 7)])
def test_lattice_stays(lammps, dim, cells):
    lattice(dim, cells).write(lammps.path("box.data"))
    lammps(header(dim) + "read_data box.data\n" + fluid(dim) + "fix FLUID all sph/bulk shift 1.0\ntimestep 0.005\n"
           + DUMP.replace("custom 1", "custom 200") + "run 200\n")
    first, last = lammps.frames("out.dump")
    assert np.abs(last["x"] - first["x"]).max() < 1e-11


@pytest.mark.parametrize("dim, cells", [(2, 20), (3, 8)])
def test_disordered_particles_become_even(lammps, dim, cells):
    """Number density and nearest neighbors; without the keyword nothing happens."""
    particles = disordered(dim, cells, jitter=0.3, speed=0.0)
    particles.write(lammps.path("box.data"))
    support = 4.0 if dim == 2 else 2.5
    spread = {}
    for keywords in ("", " shift 1.0"):
        lammps(header(dim) + "read_data box.data\n" + fluid(dim, coeff=f"{STILL} {support}\n")
               + f"fix FLUID all sph/bulk{keywords}\ntimestep 0.01\ncompute N all property/atom numden\n"
               + DUMP.replace("custom 1", "custom 300").replace("id xu", "id c_N xu") + "run 300\n")
        for frame in lammps.frames("out.dump"):
            r = frame["x"][:, None] - frame["x"]
            length = particles.hi - particles.lo
            r -= length * np.round(r / length)
            dist = np.linalg.norm(r, axis=2) + 100.0 * np.eye(len(r))
            nearest = dist.min(axis=1)
            spread[keywords, frame.step] = np.array([frame["c_N"].std(), nearest.std() / nearest.mean(), nearest.min()])
    for key, values in spread.items():
        print(key, "spread of c %.4f, of the distance to the nearest %.4f, shortest distance %.3f" % tuple(values))
    before, after = spread[" shift 1.0", 0], spread[" shift 1.0", 300]
    np.testing.assert_allclose(spread["", 300], before, rtol=1e-6)
    assert (after[:2] < 0.5 * before[:2]).all()
    assert after[2] > 1.5 * before[2]


VORTICES = """
units lj
dimension 2
boundary p p p
atom_style sph/bulk
variable n index {n}
variable dx equal 1.0/v_n
variable rc equal 4.0*v_dx
region box block 0 1 0 1 $(-0.5*v_dx) $(0.5*v_dx) units box
create_box 1 box
lattice sq $(1/v_dx^2) origin 0.5 0.5 0
create_atoms 1 region box
set group all mass $(v_dx^2)
displace_atoms all random $(0.2*v_dx) $(0.2*v_dx) 0 1 units box
pair_style sph/bulk
pair_coeff * * 1.0 10.0 0.001 0.001 ${{rc}}
neighbor $(0.3*v_rc) bin
fix FLUID all sph/bulk {keywords}
timestep $(0.1*v_rc/10.0)
fix calm all viscous $(5*v_dx^2)
run {calm}
unfix calm
variable u atom -cos(2*PI*x)*sin(2*PI*y)
variable w atom sin(2*PI*x)*cos(2*PI*y)
velocity all set v_u v_w 0
reset_timestep 0 time 0
compute K all ke
thermo_style custom step time c_K
thermo_modify norm no
thermo $(floor({time}/dt/8))
run $(floor({time}/dt/8)*8)
"""


def decay(lammps, n, time, keywords):
    """Rate at which the kinetic energy of Taylor-Green vortices decays, over the exact one; Reynolds number 1000."""
    table = lammps(VORTICES.format(n=n, time=time, keywords=keywords, calm=6 * n)).thermo()[-1]
    rate = -np.log(table["c_K"][-1] / table["c_K"][0]) / (table["Time"][-1] - table["Time"][0])
    return rate / (16.0 * np.pi ** 2 * 0.001)


def test_taylor_green_vortices(lammps):
    """Without shifting, particles in grains resist the flow by more than its viscosity does."""
    without, shifted = decay(lammps, 40, 1.5, ""), decay(lammps, 40, 1.5, "shift 1.0")
    print(f"decay rate over the exact one: {without:.3f} without, {shifted:.3f} with shifting")
    assert abs(shifted - 1.0) < 0.5 * abs(without - 1.0)


MIXING = """
units lj
dimension 2
boundary p p p
atom_style sph/bulk
lattice custom $({n}^2*2/sqrt(3)) a1 1 0 0 a2 0 1.7320508075688772 0 a3 0 0 1 basis 0 0 0 basis 0.5 0.5 0 origin 0.25 0.25 0
region box block 0 {n} 0 {rows} -0.5 0.5
create_box 1 box
create_atoms 1 box
variable spacing equal sqrt(vol/atoms)
set group all mass $(v_spacing^2)
variable kx equal 2*PI/lx
variable ky equal 2*PI/ly
variable nu equal 1.0/v_kx/{re}
pair_style sph/bulk shear mg/fr2
pair_coeff * * 1.0 15.0 ${{nu}} 0.0 $(3*v_spacing)
neighbor $(0.9*v_spacing) bin
fix 1 all sph/bulk density rho0 {keywords}
timestep $(0.3*v_spacing/15)
variable fx atom sin(v_kx*x)*cos(v_ky*y)
variable fy atom -v_kx/v_ky*cos(v_kx*x)*sin(v_ky*y)
velocity all set v_fx v_fy 0
variable a atom v_fx*vx+v_fy*vy
variable b atom v_fx*v_fx+v_fy*v_fy
compute A all reduce sum v_a v_b
variable ratio equal c_A[1]/c_A[2]*exp(v_nu*(v_kx^2+v_ky^2)*time)
thermo_style custom step time v_ratio
run $(ceil(6/v_kx/dt))
"""


@pytest.mark.parametrize("n, re, keywords, low, high", [
    (48, 16, "shift auto", 0.99, 1.01), (48, 16, "", 0.70, 0.80), (48, 160, "shift auto", 0.98, 1.01),
    pytest.param(96, 16, "shift auto", 0.995, 1.005, marks=pytest.mark.long),
    pytest.param(96, 160, "shift auto", 0.99, 1.005, marks=pytest.mark.long)])
def test_mixing_flow(lammps, n, re, keywords, low, high):
    """Amplitude of Taylor-Green vortices at t = 6/(kU) over the exact one, support of three spacings, from a hexagonal lattice."""
    table = lammps(MIXING.format(n=n, rows=n * 7 // 12, re=re, keywords=keywords), timeout=300).thermo()[-1]
    print(f"amplitude over the exact one {table['v_ratio'][-1]:.4f}")
    assert low < table["v_ratio"][-1] < high


# shear, c0 over U, pb over rho0 U^2, keywords: amplitude over the exact one
YIELDING = {("mg", 7, 0, ""): 0.89, ("mg", 15, 0, ""): 0.82, ("mg", 30, 0, ""): 0.71, ("mg", 15, 1, ""): 0.77, ("mg", 15, 3, ""): 0.70,
            ("mg", 15, 10, ""): 0.49, ("mg/fr2", 7, 0, ""): 0.84, ("mg/fr2", 30, 0, ""): 0.67, ("mg/fr2", 15, 1, ""): 0.73, ("mg/fr2", 15, 3, ""): 0.65,
            ("mg/fr2", 15, 10, ""): 0.46, ("mg/fr2", 15, 1, "shift auto"): 0.97, ("mg/fr2", 15, 3, "shift auto"): 0.93}


@pytest.mark.long
@pytest.mark.parametrize("shear, c0, pb, keywords", YIELDING)
def test_weak_solid(lammps, shear, c0, pb, keywords):
    """The arrangement of the particles resists a flow that mixes: the table of the page of limits."""
    text = MIXING.format(n=48, rows=28, re=16, keywords=keywords).replace("shear mg/fr2", f"shear {shear}")
    text = text.replace(" 15.0 ", f" {c0} ").replace("0.0 $(3*v_spacing)", f"0.0 $(3*v_spacing) pb {pb}").replace("/15)", f"/{c0})")
    table = lammps(text, timeout=300).thermo()[-1]
    print(f"amplitude over the exact one {table['v_ratio'][-1]:.4f}")
    assert table["v_ratio"][-1] == pytest.approx(YIELDING[shear, c0, pb, keywords], abs=0.025)


@pytest.mark.long
@pytest.mark.parametrize("kernel, support, amplitude, density", [("quintic", 3, 1.03, 0.93), ("wendland/c4", 3, 1.06, 0.93), ("wendland/c4", 4, 1.00, 0.996)])
def test_other_kernels(lammps, kernel, support, amplitude, density):
    """Amplitude over the exact one, and the smallest density, which a void has at its edge."""
    text = MIXING.format(n=48, rows=28, re=16, keywords="shift auto").replace("3*v_spacing", f"{support}*v_spacing")
    text = text.replace("pair_style sph/bulk", f"pair_style sph/bulk kernel {kernel}")
    text = text.replace("thermo_style custom step time", "compute RHO all property/atom rho\ncompute LEAST all reduce min c_RHO\nthermo_style custom step c_LEAST")
    table = lammps(text, timeout=300).thermo()[-1]
    print(f"amplitude over the exact one {table['v_ratio'][-1]:.4f}, smallest density {table['c_LEAST'][-1]:.4f}")
    assert table["v_ratio"][-1] == pytest.approx(amplitude, abs=0.03)    # voids are chaotic
    assert table["c_LEAST"][-1] == pytest.approx(density, abs=0.02)


# ---------------------------------------------------------------------------------------------
# bad input

BAD = [
    ("shift -1", ["shift", ">= 0", "-1"]),
    ("shift -1e-9", ["shift", ">= 0"]),
    ("shift", ["[Mm]issing", "shift"]),
    ("shift fast", ["fast"]),
    ("shift 1,0", ["1,0"]),
    ("shift nan", ["nan"]),
    ("shift inf", ["inf"]),
    ("shift 1e999", ["1e999"]),
    ("shift v_U", ["v_U"]),
    ("shift yes", ["yes"]),
    ("shift 1 2", ["keyword: 2"]),
    ("shifting 1", ["keyword: shifting"]),
    ("speed 1", ["keyword: speed"]),
    ("1.0", ["keyword: 1.0"]),
    ("shift shift 1", ["shift"]),
]


@pytest.mark.parametrize("style, keywords, expected_words",
                         [(BULK, *bad) for bad in BAD] + [(MICRO, *bad) for bad in (BAD[0], BAD[2], BAD[3], BAD[11])])
def test_refused(lammps, style, keywords, expected_words):
    particles = disordered(2, 8)
    model = walls.one_fluid(2, style)
    walls.save(lammps, particles, model, spins(particles) if style == MICRO else None)
    walls.refused(lammps, header(2, style=style) + "read_data box.data\n" + walls.pair_commands(model)
                  + f"fix FLUID all {style} {keywords}\nrun 1\n", expected_words, 1)


def test_refused_on_two_ranks(lammps):
    disordered(2, 8).write(lammps.path("box.data"))
    walls.refused(lammps, header(2) + "read_data box.data\n" + fluid(2) + "fix FLUID all sph/bulk shift -1\nrun 1\n",
                  ["Fix sph/bulk shift must be auto or >= 0, not -1"], 2)


def test_needs_the_pair_style(lammps):
    disordered(2, 8).write(lammps.path("box.data"))
    walls.refused(lammps, header(2) + "read_data box.data\npair_style zero 3.0\npair_coeff * *\n"
                  "fix FLUID all sph/bulk shift 1\nrun 1\n", ["shift requires pair style sph/bulk"], 1)
