"""LAMMPS commands that change, copy or describe the particles."""

import re

import numpy as np
import pytest

import test_micropolar as micropolar
from helpers import FIELDS, INTEGRATE, disordered, dump, fluid, header, relative, undump

SAME = 1e-12
TYPES = ("pair_coeff 1 1 1.0 10.0 0.5 2.0 3.0\n" "pair_coeff 2 2 1.1 12.0 0.2 2.0 3.0\n")
MODEL = fluid(2, "eos ideal", coeff=TYPES)


def evaluate(lammps, particles, name, commands="", model=MODEL, ranks=1, head=None, steps=0, write=None):
    """Fields after `steps` steps, with `commands` given once the particles exist."""
    (write or particles.write)(lammps.path(f"{name}.data"))
    lammps((head or header(particles.dim)) + f"read_data {name}.data\n" + model + commands + "\n" + INTEGRATE
           + dump(f"{name}.dump", max(steps, 1)) + f"run {steps}\n", ranks=ranks)
    return lammps.frame(f"{name}.dump")


def assert_same(frame, reference, keys=("f", "numden", "dnumden", "desph")):
    for key in keys:
        assert frame[key].shape == reference[key].shape
        assert relative(frame[key] - reference[key], reference[key]) < SAME, key


@pytest.fixture
def particles():
    return disordered(2, 12, ntypes=2)


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("dim, copies, tilt", [(2, (2, 2, 1), None), (3, (2, 1, 2), None), (2, (2, 2, 1), (3., 0., 0.))])
def test_replicate(lammps, ranks, dim, copies, tilt):
    """Every image of a particle feels the same force."""
    particles = disordered(dim, {2: 12, 3: 6}[dim], tilt=tilt)
    model = fluid(dim)
    one = evaluate(lammps, particles, "one", model=model)
    many = evaluate(lammps, particles, "many", "replicate {} {} {}".format(*copies), model=model, ranks=ranks)
    number = int(np.prod(copies))
    assert len(many["id"]) == number * len(particles)
    for key in ("mass", "esph", "numden", "desph", "f", "v"):
        for image in np.split(many[key], number):
            assert relative(image - one[key], one[key]) < SAME, key


def test_replicate_then_run_stays_periodic(lammps):
    particles = disordered(2, 10)
    model = fluid(2)
    one = evaluate(lammps, particles, "one", model=model, steps=100)
    many = evaluate(lammps, particles, "many", "replicate 2 1 1", model=model, steps=100)
    for image, shift in zip(np.split(many["x"], 2), (0.0, 10.0)):
        assert np.abs(image - one["x"] - [shift, 0.0, 0.0]).max() < 1e-9


def test_set(lammps, particles):
    """set ... mass, sph/e, vx and type give what the data file would have given."""
    changed = disordered(2, 12, ntypes=2)
    heavy = changed.type == 2
    changed.mass[heavy], changed.esph[heavy], changed.v[heavy, 0] = 1.75, 7.5, 0.125
    reference = evaluate(lammps, changed, "reference")
    frame = evaluate(lammps, particles, "set", "set type 2 mass 1.75\nset type 2 sph/e 7.5\nset type 2 vx 0.125")
    assert (frame["mass"] == changed.mass).all() and (frame["esph"] == changed.esph).all()
    assert_same(frame, reference)
    swapped = disordered(2, 12, ntypes=2)
    swapped.type = np.full(len(swapped), 2)
    assert_same(evaluate(lammps, particles, "types", "set group all type 2"),
                evaluate(lammps, swapped, "swapped", write=lambda path: swapped.write(path, ntypes=2)))


def test_set_between_runs(lammps, particles):
    """A second run sees values changed after the first one."""
    frame = evaluate(lammps, particles, "between", INTEGRATE + "run 0\nunfix FLUID\nset type 1 mass 1.5")
    changed = disordered(2, 12, ntypes=2)
    changed.mass[changed.type == 1] = 1.5
    assert_same(frame, evaluate(lammps, changed, "reference"))


def test_velocity(lammps, particles):
    """velocity set is seen by the viscous force at once; velocity create uses the particle masses."""
    moved = disordered(2, 12, ntypes=2)
    moved.v[:, :2] = 0.3, -0.2
    assert_same(evaluate(lammps, particles, "velocity", "velocity all set 0.3 -0.2 0.0"),
                evaluate(lammps, moved, "reference"), keys=("f", "numden"))
    frame = evaluate(lammps, particles, "create", "velocity all create 1.5 4711 mom yes")
    energy = 0.5 * (frame["mass"][:, None] * frame["v"] ** 2).sum()
    assert energy == pytest.approx(1.5 * (len(particles) - 1), rel=1e-10)  # N - 1 degrees of freedom twice
    assert np.abs((frame["mass"][:, None] * frame["v"]).sum(0)).max() < 1e-10


@pytest.mark.parametrize("ranks", [1, 2])
def test_delete_atoms(lammps, particles, ranks):
    kept = np.linalg.norm(particles.x[:, :2] - 6.0, axis=1) > 2.5
    commands = "region R sphere 6 6 0 2.5\ndelete_atoms region R compress yes"
    frame = evaluate(lammps, particles, "deleted", commands, ranks=ranks)
    reference = evaluate(lammps, particles.where(kept), "reference")
    order = [np.lexsort(f["x"].T) for f in (frame, reference)]
    for key in ("f", "numden", "desph"):
        assert relative(frame[key][order[0]] - reference[key][order[1]], reference[key]) < SAME, key


def test_create_atoms(lammps, particles):
    """Particles made by create_atoms and set equal those of a data file."""
    particles.type[:], particles.mass[:], particles.esph[:], particles.v[:] = 1, 1.25, 6.0, 0.0
    model = fluid(2, "eos ideal")
    reference = evaluate(lammps, particles, "reference", model=model)
    text = header(2) + "region B block 0 12 0 12 -0.5 0.5\ncreate_box 1 B\n"
    text += "".join(f"create_atoms 1 single {x} {y} 0.0\n" for x, y in
                    (particles.x[:, :2] % 12.0).tolist())
    lammps(text + "set group all mass 1.25 sph/e 6.0\n" + model + INTEGRATE + dump("created.dump") + "run 0\n")
    assert_same(lammps.frame("created.dump"), reference, keys=("f", "numden"))


def test_groups(lammps, particles):
    """Two integrators on two groups move the particles as one on all of them."""
    one = evaluate(lammps, particles, "one", steps=100)
    particles.write(lammps.path("two.data"))
    lammps(header(2) + "read_data two.data\n" + MODEL + "group A type 1\ngroup B type 2\ntimestep 0.005\n"
           "fix A A sph/bulk\nfix B B sph/bulk\n" + dump("two.dump", 100) + "run 100\n")
    assert np.abs(lammps.frame("two.dump")["x"] - one["x"]).max() < 1e-11


@pytest.mark.parametrize("before", ["atom_style sph/bulk\n", "atom_style atomic\natom_style sph/bulk\n",
                                    "atom_style hybrid sph/bulk charge\natom_style sph/bulk\n"])
def test_atom_style_given_again(lammps, particles, before):
    reference = evaluate(lammps, particles, "reference", steps=20)
    assert_same(evaluate(lammps, particles, "again", head=header(2) + before, steps=20), reference)


def test_clear(lammps, particles):
    """Everything after clear is as in a fresh LAMMPS, several times over."""
    particles.write(lammps.path("box.data"))
    case = header(2) + "read_data box.data\n" + MODEL + INTEGRATE + dump("{}.dump", 20) + "run 20\n"
    lammps("clear\n".join(case.format(k) for k in range(3)))
    for k in (1, 2):
        assert_same(lammps.frame(f"{k}.dump"), lammps.frame("0.dump"))


def test_clear_to_another_atom_style(lammps, particles):
    particles.write(lammps.path("box.data"))
    other = ("units lj\ndimension 2\natom_style atomic\nlattice sq 0.8\nregion B block 0 6 0 6 -0.5 0.5\n"
             "create_box 1 B\ncreate_atoms 1 box\nmass 1 1.0\npair_style lj/cut 2.5\npair_coeff 1 1 1.0 1.0\n"
             "fix N all nve\nrun 5\n")
    case = header(2) + "read_data box.data\n" + MODEL + INTEGRATE + dump("{}.dump", 20) + "run 20\n"
    lammps("clear\n".join([case.format("first"), other, case.format("second")]))
    assert_same(lammps.frame("second.dump"), lammps.frame("first.dump"))


@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "off"), (2, "on")])
def test_atom_style_hybrid(lammps, particles, ranks, newton):
    reference = evaluate(lammps, particles, "reference", steps=50)
    particles.charge = np.linspace(-1.0, 1.0, len(particles))
    style = "hybrid sph/bulk charge"
    frame = evaluate(lammps, particles, "hybrid", head=header(2, newton=newton, style=style), ranks=ranks, steps=50,
                     write=lambda path: particles.write(path, style=style))
    assert np.abs(frame["x"] - reference["x"]).max() < 1e-10


OTHERS = {"zero": ("zero 2.0", "* *"), "lj": ("lj/cut 1.5", "* * 0.7 0.8"), "soft": ("soft 1.2", "* * 3.0")}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("other", OTHERS)
def test_hybrid_overlay_adds_forces(lammps, particles, other, ranks):
    style, coeff = OTHERS[other]
    ours = evaluate(lammps, particles, "ours")["f"]
    theirs = evaluate(lammps, particles, "theirs", model=f"pair_style {style}\npair_coeff {coeff}\n",
                      head=header(2))["f"] if other != "zero" else np.zeros_like(ours)
    name = style.split()[0]
    both = (f"pair_style hybrid/overlay sph/bulk dim 2 eos ideal {style}\n"
            + TYPES.replace("1 1 1.0", "1 1 sph/bulk 1.0").replace("2 2 1.1", "2 2 sph/bulk 1.1")
            + f"pair_coeff 1 2 sph/bulk mu {2 * 0.5 * 0.2 / 0.7}\n"
            + f"pair_coeff * * {name} {coeff[4:]}\n")
    total = evaluate(lammps, particles, "both", model=both, ranks=ranks)["f"]
    assert relative(total - ours - theirs, ours) < SAME


@pytest.mark.parametrize("order", [1, -1])
def test_wildcards_cover_unlike_types_in_hybrid_overlay(lammps, particles, order):
    """pair_coeff * * means all pairs, also when another style has * * of its own."""
    alone = evaluate(lammps, particles, "alone", model=fluid(2))
    lines = ["pair_coeff * * sph/bulk 1.0 10.0 0.5 2.0 3.0\n", "pair_coeff * * zero\n"][::order]
    both = evaluate(lammps, particles, "both",
                    model="pair_style hybrid/overlay sph/bulk zero 2.0\n" + "".join(lines))
    assert_same(both, alone)


def test_hybrid_keeps_the_fluid_to_its_types(lammps, particles):
    """pair_style hybrid: particles without an sph/bulk coefficient are not part of the fluid's density."""
    alone = evaluate(lammps, particles.where(particles.type == 1), "alone", model=fluid(2))
    model = ("pair_style hybrid sph/bulk dim 2 zero 3.0\npair_coeff 1 1 sph/bulk 1.0 10.0 0.5 2.0 3.0\n"
             "pair_coeff 1 2 zero\npair_coeff 2 2 zero\n")
    mixed = evaluate(lammps, particles, "mixed", model=model)
    first = particles.type == 1
    for key in ("f", "numden", "desph"):
        assert relative(mixed[key][first] - alone[key], alone[key]) < SAME, key
    assert (mixed["f"][~first] == 0.0).all() and (mixed["desph"][~first] == 0.0).all()
    energies = [result.thermo()[0]["E_pair"][0] * len(frame["id"])
                for result, frame in zip(lammps.results, (alone, mixed))]  # LAMMPS prints it per particle
    assert energies[1] == pytest.approx(energies[0], rel=1e-6)


def test_a_pair_style_given_again_starts_from_the_defaults(lammps, particles):
    reference = evaluate(lammps, particles, "reference", model=fluid(2))
    again = fluid(2, "kernel quintic eos tait shear mg/fr bulk volume", keywords="pb 3 gamma 4") + fluid(2)
    assert_same(evaluate(lammps, particles, "again", model=again), reference)


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("eos", ["linear", "tait"])
def test_minimize_relaxes_a_set(lammps, eos, ranks):
    """The forces of a fluid at rest are the gradient of the potential energy."""
    disordered(2, 12, speed=0.0).write(lammps.path("box.data"))
    result = lammps(header(2) + "read_data box.data\n" + fluid(2, f"eos {eos}", keywords="pb 5") + INTEGRATE
                    + dump("out.dump", 5000) + "minimize 0 1e-8 5000 50000\n", ranks=ranks)
    first, last = lammps.frames("out.dump")
    assert np.abs(last["f"]).max() < 1e-7 * np.abs(first["f"]).max()
    (table,) = result.thermo()
    assert table["E_pair"][-1] < 0.5 * table["E_pair"][0]


def test_rerun(lammps):
    """Forces of stored positions and velocities are those of the run's first step."""
    disordered(2, 12).write(lammps.path("box.data"))
    text = header(2) + "read_data box.data\n" + fluid(2) + INTEGRATE
    lammps(text + dump("run.dump", 10) + "run 10\n")
    lammps(text + dump("again.dump", 10) + "rerun run.dump dump x y vx vy\n")
    start, later = zip(lammps.frames("run.dump"), lammps.frames("again.dump"))
    assert_same(start[1], start[0])
    assert relative(later[1]["f"] - later[0]["f"], later[0]["f"]) < 1e-3  # velocity there, extrapolated velocity here


@pytest.mark.parametrize("options, fix, words", [
    ("eos ideal", "", "eos ideal cannot be used with rerun"), ("temp energy 5.0 5 bulk none", "", "temp energy cannot be used with rerun"),
    ("volume mass", "fix R all sph/refine 5 volume 1.0\n", "Fix sph/refine cannot be used with rerun")])
def test_rerun_refused(lammps, options, fix, words):
    """Snapshots that LAMMPS reads have no masses and no heat."""
    disordered(2, 8).write(lammps.path("box.data"))
    text = header(2) + "read_data box.data\nset group all sph/e 30.0\n" + fluid(2, options) + INTEGRATE + fix
    lammps(text + dump("run.dump", 2) + "run 2\n")
    result = lammps(text + "rerun run.dump dump x y vx vy\n", check=False, ranks=2)
    assert result.code == 1 and re.search(words, result.error), result.output[-2000:]


def test_rerun_with_spins(lammps):
    """Those of the start, with a warning."""
    micropolar.write(disordered(2, 8), lammps.path("box.data"))
    text = header(2, style="sph/micropolar") + "read_data box.data\n" + micropolar.fluid(2) + micropolar.integrate()
    lammps(text + "dump D all custom 2 run.dump id type x y vx vy\nrun 2\n")
    result = lammps(text + "rerun run.dump dump x y vx vy\n")
    assert sum("snapshots have no spins" in line for line in result.warnings) == 1, result.warnings


@pytest.mark.parametrize("units", ["si", "cgs", "micro", "nano"])
def test_units(lammps, particles, units):
    """The same numbers in all systems of units that need no conversion factor."""
    reference = evaluate(lammps, particles, "reference", steps=50)
    head = header(2).replace("units lj", f"units {units}") + "neighbor 0.3 bin\n"
    frame = evaluate(lammps, particles, "units", steps=50, head=head)
    for key in ("x", "v", "f", "esph"):
        assert relative(frame[key] - reference[key], reference[key]) < SAME, key


def test_line_along_the_other_direction(lammps):
    """dim 1 does not care whether the line lies along x or y."""
    particles = disordered(1, 40)
    along_x = evaluate(lammps, particles, "x", model=fluid(1), steps=50)
    swap = [1, 0, 2]
    for name in ("x", "v"):
        setattr(particles, name, getattr(particles, name)[:, swap])
    particles.lo, particles.hi = particles.lo[swap], particles.hi[swap]
    along_y = evaluate(lammps, particles, "y", model=fluid(1), steps=50)
    for key in ("x", "f"):
        assert np.abs(along_y[key][:, swap] - along_x[key]).max() < 1e-10, key


@pytest.mark.parametrize("ranks", [1, 2])
def test_no_particles(lammps, particles, ranks):
    particles.write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\ndelete_atoms group all\n" + MODEL + INTEGRATE + "run 5\n", ranks=ranks)


@pytest.mark.parametrize("dim, cells", [(1, 60), (2, 12), (3, 6)])
@pytest.mark.parametrize("newton, ranks", [("on", 1), ("off", 2)])
def test_dumped_fields(lammps, dim, cells, newton, ranks):
    """What compute property/atom exports is consistent, at the start and during a run."""
    disordered(dim, cells).write(lammps.path("box.data"))
    lammps(header(dim, newton=newton) + "read_data box.data\n" + fluid(dim) + INTEGRATE + dump("out.dump", 10)
           + "run 30\n", ranks=ranks)
    frames = lammps.frames("out.dump")
    assert [frame.step for frame in frames] == [0, 10, 20, 30]
    assert (frames[0]["vest"] == frames[0]["v"]).all()
    for frame in frames:
        assert all(np.isfinite(frame[name]).all() for name in FIELDS)
        np.testing.assert_array_max_ulp(frame["rho"], frame["mass"] * frame["numden"], 2)
        np.testing.assert_array_max_ulp(frame["vol"], 1.0 / frame["numden"], 2)
        assert np.abs(frame["dnumden"]).max() > 1e-3 and np.abs(frame["desph"]).max() > 1e-3
        assert relative(frame["vest"] - frame["v"], frame["v"]) < 0.02
    assert (frames[-1]["vest"] != frames[-1]["v"]).any()


def test_rate_of_the_number_density(lammps):
    """dnumden is the time derivative of numden along the motion."""
    dt = 1e-4
    disordered(2, 12).write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\n" + fluid(2) + INTEGRATE + f"timestep {dt}\n" + dump("out.dump")
           + "run 2\n")
    before, now, after = lammps.frames("out.dump")
    slope = (after["numden"] - before["numden"]) / (2 * dt)
    assert relative(slope - now["dnumden"], now["dnumden"]) < 1e-5


def test_variables_see_the_fields(lammps, particles):
    """compute reduce over the exported fields, as thermo output would show them."""
    particles.write(lammps.path("box.data"))
    result = lammps(header(2) + "read_data box.data\n" + MODEL + INTEGRATE + dump("out.dump")
                    + "compute R all reduce sum c_F[3] c_F[5]\nthermo_style custom step c_R[1] c_R[2]\n"
                    "thermo_modify norm no format float %.17g\nrun 0\n", ranks=2)
    frame, (table,) = lammps.frame("out.dump"), result.thermo()
    assert table["c_R[1]"][0] == pytest.approx(frame["vol"].sum(), rel=1e-13)
    assert table["c_R[2]"][0] == pytest.approx(frame["esph"].sum(), rel=1e-13)
