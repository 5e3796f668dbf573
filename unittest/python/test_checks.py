"""What the fluid checks before a run and during it: combinations, special bonds, lines, neighbors, energies."""

import re
import subprocess

import numpy as np
import pytest

import test_micropolar
from helpers import INTEGRATE, LMP, disordered, dump, fluid, header, lattice, relative


def refused(lammps, text, words, ranks=1):
    result = lammps(text, ranks=ranks, check=False, timeout=60)
    assert result.code != 0, f"accepted:\n{result.output[-2000:]}"
    assert re.search(words, result.error), result.error or result.output[-2000:]
    return result


def box(lammps, dim=2, cells=12, **more):
    particles = disordered(dim, cells, ntypes=2, **more)
    particles.write(lammps.path("box.data"), ntypes=2)
    return particles


BULK = "pair_coeff {0} {0} sph/bulk {1} 1.0 10.0 0.5 2.0 3.0\n"

# ---------------------------------------------------------------------------------------------
# other styles


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("hybrid", ["hybrid", "hybrid/overlay"])
def test_two_fluids_in_two_instances(lammps, hybrid, ranks):
    box(lammps)
    zero = "" if hybrid == "hybrid/overlay" else "pair_coeff 1 2 none\n"
    refused(lammps, header(2) + f"read_data box.data\npair_style {hybrid} sph/bulk sph/bulk eos tait\n"
            + BULK.format(1, 1) + BULK.format(2, 2) + (zero or "pair_coeff 1 2 sph/bulk 1 mu 0.5\n") + INTEGRATE + "run 0\n",
            "cannot be combined with another sph/bulk", ranks)


def test_one_of_two_types(lammps):
    """Density, volume, and energy of the particles of another style are left alone, also if that style took the
    type over later; their mass is of no concern unless they are integrated."""
    particles = box(lammps)
    first = particles.type == 1
    hybrid = header(2) + ("read_data box.data\npair_style hybrid sph/bulk zero 3.0\n" + BULK.format(1, "")
                          + "{}pair_coeff 1 2 zero\npair_coeff 2 2 zero\n" + INTEGRATE)
    results = []
    for name, before in {"never": "", "once": BULK.format(2, "")}.items():
        results.append(lammps(hybrid.format(before) + dump(f"{name}.dump") + "run 10\n"))
        frame = lammps.frame(f"{name}.dump")
        for key in ("rho", "vol", "desph"):
            assert (frame[key][~first] == 0.0).all(), key
            assert (np.abs(frame[key][first]) > 0.0).all(), key
        assert "2-2" not in re.sub(r"\d-\d-\d", "", results[-1].log)
    particles.where(first).write(lammps.path("alone.data"), ntypes=2)
    lammps(header(2) + "read_data alone.data\n" + fluid(2) + INTEGRATE + dump("alone.dump") + "run 10\n")
    alone = lammps.frame("alone.dump")
    for name in ("never", "once"):
        frame = lammps.frame(f"{name}.dump")
        for key in ("f", "rho", "vol", "desph", "esph"):
            assert relative(frame[key][first] - alone[key], alone[key]) < 1e-12, key
    weightless = hybrid.format("").replace("box.data\n", "box.data\ncreate_atoms 2 single 5 5 0\n").replace(
        "fix FLUID all", "group G type 1\nfix FLUID G")
    lammps(weightless + "run 1\n")
    refused(lammps, weightless.replace("fix FLUID G", "fix FLUID all") + "run 1\n", "mass must be > 0")


def test_a_pair_with_a_type_that_is_no_fluid(lammps):
    box(lammps)
    refused(lammps, header(2) + "read_data box.data\npair_style hybrid sph/bulk zero 3.0\n" + BULK.format(1, "")
            + "pair_coeff 1 2 sph/bulk mu 0.3\npair_coeff 2 2 zero\n" + INTEGRATE + "run 0\n",
            "between types 1 and 2, but type 2 has no coefficients")


@pytest.mark.parametrize("lines, silent", [("pair_coeff * * zero\n", False), ("pair_coeff 1 2 none\n", False), ("", True),
                                           ("pair_coeff 1 2 sph/bulk mu 0.5\npair_coeff * * zero\n", True)])
def test_types_that_do_not_interact(lammps, lines, silent):
    """A line for all types gives the pair 1 2 to another style, and LAMMPS mixes no coefficients for it."""
    box(lammps)
    other = "zero 3.0 " if "zero" in lines else ""
    text = (header(2) + f"read_data box.data\npair_style hybrid/overlay {other}sph/bulk\n" + BULK.format(1, "") + BULK.format(2, "")
            + lines + INTEGRATE)
    found = warnings(lammps, text, "do not interact")
    assert len(found) == (not silent), found
    assert silent or "types 1 and 2 do not interact" in found[0] and "pair_coeff 1 2 sph/bulk" in found[0]


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("order", ["sph/bulk sph", "sph sph/bulk"])
def test_atom_style_with_another_density(lammps, order, ranks):
    refused(lammps, header(2, style=f"hybrid {order}") + "region B block 0 9 0 9 -.5 .5\ncreate_box 1 B\n"
            "create_atoms 1 random 50 1 B\nset group all mass 1.0\nmass 1 1.0\n" + fluid(2) + INTEGRATE + "run 0\n",
            "Atom style sph/bulk cannot be combined with atom style sph", ranks)


@pytest.mark.parametrize("style", ["sph/bulk", "hybrid sph/bulk charge"])
def test_density_cannot_be_set(lammps, style):
    """It is a sum over neighbors; dump and compute property/atom have it."""
    particles = box(lammps)
    particles.charge = np.zeros(len(particles))
    particles.write(lammps.path("box.data"), style=style)
    head = header(2, style=style) + "read_data box.data\n"
    refused(lammps, head + "set group all sph/rho 2.0\n", "sph/rho")
    lammps(head + fluid(2) + INTEGRATE + "compute P all property/atom rho\ncompute R all reduce ave c_P\n"
           "thermo_style custom step c_R\nset group all sph/e 2.0\nrun 0\n")
    assert lammps.results[-1].thermo()[0]["c_R"][0] == pytest.approx(1.0, rel=0.1)


# ---------------------------------------------------------------------------------------------
# special bonds


def bonded(lammps, special, fluid_lines):
    lammps.path("bond.data").write_text(
        "bonded\n\n2 atoms\n1 bonds\n1 atom types\n1 bond types\n0 9 xlo xhi\n0 9 ylo yhi\n-0.5 0.5 zlo zhi\n\n"
        "Atoms # hybrid\n\n1 1 4.0 4.0 0.0 1.0 0.0 1\n2 1 5.0 4.0 0.0 1.0 0.0 1\n\nBonds\n\n1 1 1 2\n")
    return (header(2, style="hybrid sph/bulk bond") + "bond_style zero\nread_data bond.data\nbond_coeff *\n"
            f"special_bonds {special}\n" + fluid_lines + INTEGRATE + dump("bond.dump") + "run 0\n")


def test_bonded_neighbors_count(lammps):
    """The density of two bonded particles is that of two free ones.  (LAMMPS's package MOLECULE has bonds.)"""
    if "MOLECULE" not in subprocess.run([LMP, "-h"], capture_output=True, text=True, check=True).stdout:
        pytest.skip("LAMMPS was built without bonds")
    for special in ("lj/coul 1 1 1", "lj 1 1 1 coul 0 0.5 1"):
        lammps(bonded(lammps, special, fluid(2)))
        bound = lammps.frame("bond.dump")["rho"]
        lammps(bonded(lammps, special, fluid(2)).replace("run 0", "delete_bonds all bond 1 remove special\nrun 0"))
        assert (lammps.frame("bond.dump")["rho"] == bound).all()
    for special in ("lj/coul 0 0 0", "lj/coul 1 1 0.5", "lj 0 1 1 coul 1 1 1"):
        refused(lammps, bonded(lammps, special, fluid(2)), "special_bonds lj 1 1 1")


# ---------------------------------------------------------------------------------------------
# particles without an ID


@pytest.mark.parametrize("ranks", [1, 2, 4])
@pytest.mark.parametrize("ids", ["yes", "no"])
def test_checks_work_without_ids(lammps, ids, ranks):
    text = (header(2) + f"atom_modify id {ids}\nregion B block 0 9 0 9 -.5 .5\nlattice sq 1.0\ncreate_box 1 B\n"
            "create_atoms 1 box\nset group all mass 1.0\ncreate_atoms 1 single 3.2 3.2 0\n" + fluid(2))
    result = refused(lammps, text + INTEGRATE + "run 0\n", "mass must be > 0, which that of a? ?particle", ranks)
    assert bool(re.search(r"particle \d+", result.error)) == (ids == "yes"), result.error


@pytest.mark.parametrize("ranks", [1, 2])
def test_tilted_spins_without_ids(lammps, ranks):
    refused(lammps, header(2, style="sph/micropolar") + "atom_modify id no\nregion B block 0 9 0 9 -.5 .5\n"
            "lattice sq 1.0\ncreate_box 1 B\ncreate_atoms 1 box\nset group all mass 1.0 omega 0.1 0.0 0.0\n"
            + test_micropolar.fluid(2) + test_micropolar.integrate("inertia 0.1667 0.1") + "run 0\n",
            "spin must be along z in 2d, which that of a particle is not", ranks)


# ---------------------------------------------------------------------------------------------
# numbers


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("commands, words", [
    ("velocity all create 1.0 4711\nset group all mass 1.0\n", "velocity must be a finite number.*particle 1 is not; use velocity create after set mass"),
    ("set group all mass 1.0\nvelocity odd set v_n 0 0\n", "velocity must be a finite number.*particle 5 "),
    ("set group all mass 1.0\nset atom 5 omega 0 0 v_n\n", "spin must be a finite number.*particle 5 "),
    ("set group all mass 1.0\nset atom 5 sph/e v_n\n", "internal energy must be a finite number.*particle 5 ")])
def test_numbers_are_finite(lammps, commands, words, ranks):
    """They spread over the whole fluid, and the run would end without an error."""
    refused(lammps, header(2, style="sph/micropolar") + "region B block 0 9 0 9 -.5 .5\nlattice sq 1.0 origin 0.5 0.5 0\n"
            "create_box 1 B\ncreate_atoms 1 box\ngroup odd id 5\nvariable n atom exp(1000.0)*0.0\n" + commands
            + test_micropolar.fluid(2) + test_micropolar.integrate("inertia 0.1667 0.1") + "run 2\n", words, ranks)


SQUARE = ("region B block 0 9 0 9 -.5 .5\nlattice sq 1.0 origin 0.5 0.5 0\ncreate_box 2 B\ncreate_atoms 1 box\nset group all mass 1.0\n"
        "region W block INF INF INF 2.9 INF INF\ngroup W region W\ngroup F subtract all W\ngroup five id 5\ntimestep 0.001\n")
ONE_FLUID = "pair_style sph/bulk {}\npair_coeff * * 1 10 .1 .3 2.7 {}\nfix FLUID {} sph/bulk {}\n"
SPIN = test_micropolar.fluid(2) + "fix FLUID all sph/micropolar inertia .1 0\n"
WALL = "set group all sph/e 10\n" + ONE_FLUID.format("", "cv 1 conductivity 1", "F", "") + "fix W W sph/wall "
VOLUME = ONE_FLUID.format("volume mass", "", "all", "") + "fix R all sph/refine 1 volume "
ADAPT = ONE_FLUID.format("", "cv 1 conductivity 1 drag 1 0 0 0", "all", "") + "fix A all adapt 1 pair sph/bulk {} 1 1 v_n\n"
PROPERTY = "must be a finite number, which that of particle 5 is not"

# atom style; commands, with v_n, a variable of equal style, or v_a, finite but for particle 5; words of the error

SET_ONCE = [
    ("sph/bulk relax 1", ONE_FLUID.format("", "relax 1 1", "all", "") + "set group five d_rho_relaxed1 v_a\n", "d_rho_relaxed1 " + PROPERTY),
    ("sph/bulk solute", ONE_FLUID.format("", "solute 1", "all", "") + "set group five d_solute v_a\n", "d_solute " + PROPERTY),
    ("sph/bulk relax 1", "set group all sph/e 100\n" + ONE_FLUID.format("eos ideal", "gamma 1.4 cv 10 vibration 5 1", "all", "")
     + "set group five d_tvib v_a\n", "d_tvib " + PROPERTY),
    ("sph/bulk", ONE_FLUID.format("density continuity", "", "all", "") + "set group five sph/rho v_a\n", "density " + PROPERTY),
    ("sph/bulk", ONE_FLUID.format("", "", "all", "") + "set group five mass v_a\n", f"mass (must be > 0|{PROPERTY})"),
    ("sph/micropolar", SPIN + "set group five d_inertia v_a\n", "inertia " + PROPERTY),
    ("sph/bulk", ONE_FLUID.format("", "cv 1", "all", "temperature v_n"), "Fix sph/bulk temperature must be >= 0, not VALUE"),
    ("sph/bulk", ONE_FLUID.format("", "cv 1", "all", "temperature v_a"), "Fix sph/bulk temperature must be >= 0, not VALUE")]
IN_EACH_STEP = [
    ("sph/micropolar", SPIN + "fix T all sph/torque 0 0 v_n\n", r"Fix sph/torque: variable n is VALUE at step \d"),
    ("sph/micropolar", SPIN + "fix T all sph/torque 0 0 v_a\n", r"Fix sph/torque: variable a is VALUE for particle 5 at step \d"),
    ("sph/bulk", WALL + "velocity v_n 0 0\n", r"Fix sph/wall: variable n is VALUE at step \d"),
    ("sph/bulk", WALL + "rotate 6 6 0 0 0 1 v_n\n", r"Fix sph/wall: variable n is VALUE at step \d"),
    ("sph/bulk", WALL + "gravity v_n 0 0\n", r"Fix sph/wall gravity: variable n is VALUE at step \d"),
    ("sph/bulk", WALL + "heat temp v_n\n", "heat temp must be >= 0, not VALUE"),
    ("sph/bulk", WALL + "heat temp v_a\n", "heat temp must be >= 0, not VALUE for particle 5"),
    ("sph/bulk", WALL + "heat flux v_a\n", "heat flux must be finite, not VALUE for particle 5"),
    ("sph/bulk", VOLUME + "v_n\n", "target v_n is VALUE, must be > 0"),
    ("sph/bulk", VOLUME + "v_a\n", "target v_a is VALUE for particle 5, must be > 0"),
    *[("sph/bulk", ADAPT.format(name), f"{name} of types 1 1 was changed to VALUE, which is not admissible")
      for name in ("mu", "kappa", "c0", "pb", "conductivity", "drag")]]


@pytest.mark.parametrize("number", ["exp(1000.0*{0})", "(1.0-{0})*exp(1000.0*{0})"], ids=["inf", "nan"])
@pytest.mark.parametrize("atoms, commands, words, first, ranks", [(*case, 0, 2) for case in SET_ONCE + IN_EACH_STEP]
                         + [(*case, 3, 1) for case in IN_EACH_STEP])
def test_values_are_finite(lammps, atoms, commands, words, first, ranks, number):
    """Of states, and of variables, from this step on: all ranks report them, so that nothing else is lost."""
    variables = (f"variable n equal {number.format(f'(step>={first})')}\n"
                 f"variable a atom {number.format(f'(id==5)*(step>={first})')}\n")
    result = lammps(header(2, style=atoms) + SQUARE + variables + commands + "run 5\n", ranks=ranks, check=False)
    assert result.code == 1 and re.search(words.replace("VALUE", "-?(nan|inf)"), result.error), result.output[-1500:]
    assert "ERROR on proc" not in result.output


def each_number(line):
    """The line with X in the place of each of its numbers."""
    words = line.split()
    for k, word in enumerate(words):
        if re.fullmatch(r"-?[.\d]+", word):
            yield " ".join([*words[:k], "X", *words[k + 1:]])


COEFFS = [f"pair_coeff * * 1 10 .1 .3 2.7 {line}" for keywords in (
    "pb 1", "gamma 7", "cv 1 conductivity .5", "cv 1 gruneisen .5 1", "drag 1 .5 .5 .5", "power .5 .1 1", "carreau 1 .5 1 .1", "cross 1 .5 .1", "yield 1 1",
    "smagorinsky 1 1", "cv 1 arrhenius 1 1 2", "relax 1 1", "solute .1", "thixotropy 1 .5 2") for line in each_number(keywords) if " X" in line]
COEFFS += [line.replace("pair_coeff X", "pair_coeff *") for line in each_number("pair_coeff * * 1.0 10 .1 .3 2.7") if not line.endswith("* * X 10 .1 .3 2.7")]
NUMBERS = (COEFFS + ["pair_coeff 1 2 mu X", "pair_coeff 1 2 interdrag X", "pair_coeff 1 2 tension X"]
           + [f"pair_style sph/bulk {words}" for words in ("temp X 5", "temp energy X 5", "density continuity delta X")]
           + [f"fix I all sph/bulk {words}" for words in ("shift X", "temperature X", "viscous implicit tolerance X")]
           + [f"fix W W sph/wall {words}" for words in ("velocity X 0 0", "rotate X 6 0 0 0 1 1", "rotate 6 6 0 0 0 X 1", "rotate 6 6 0 0 0 1 X", "gravity 0 X 0",
                                                        "heat temp X", "heat flux X")]
           + [f"fix O W sph/open F {words}" for words in ("X 0 0 1 0 0 8 velocity 0 0 0", "0 0 0 1 X 0 8 velocity 0 0 0", "0 0 0 1 0 0 X velocity 0 0 0")]
           + [f"fix O W sph/open F 0 0 0 1 0 0 8 {words}" for words in ("velocity 0 X 0", "density X", "pressure X", "energy X", "temperature X", "average X",
                                                                        "spacing X", "area X")]
           + [f"fix R all sph/refine 1 {words}" for words in ("volume X", "spacing X", "volume 1 split X", "volume 1 merge X", "volume 1 wait X", "volume 1 fraction X")]
           + [f"fix D all sph/dt 1 {words}" for words in ("acoustic X", "viscous X", "force X", "min X", "max X")])


@pytest.mark.parametrize("number", ["inf", "nan"])
def test_numbers_of_commands_are_finite(lammps, number):
    """All refuse such words when they are read, and none takes one for a name."""
    base = header(2, style="sph/bulk relax 1 solute") + SQUARE + ONE_FLUID.format("volume mass", "", "F", "")
    accepted = []
    for line in NUMBERS:
        result = lammps(base + line.replace("X", number) + "\n", check=False)
        if result.code != 1 or not re.search(f"parameter instead of '{number}'|must be .*, not {number}", result.error):
            accepted.append((line, result.error))
    assert not accepted


@pytest.mark.parametrize("atoms, commands, words", [
    ("sph/bulk", ONE_FLUID.format("density continuity", "", "all", "") + "set group five sph/rho -1\n",
     "density must be >= 0, which that of particle 5 is not; use set sph/rho, where 0 stands for rho0"),
    ("sph/micropolar", SPIN + "set group five d_inertia -1\n", "inertia must be >= 0, which that of particle 5 is not"),
    ("sph/bulk relax 1", ONE_FLUID.format("eos ideal", "gamma 1.4 cv 10 vibration 5 1", "all", "") + "set group five d_tvib -2\n",
     "d_tvib must be >= 0, which that of particle 5 is not")])
def test_states_that_cannot_be_negative(lammps, atoms, commands, words):
    refused(lammps, header(2, style=atoms) + SQUARE + commands + "run 1\n", words, 2)


# ---------------------------------------------------------------------------------------------
# one dimension


def line(lammps, along=0, at=0.0, off=0.0):
    """Particles on a line along x or y, one of them off it."""
    particles = lattice(1, 60)
    particles.x[7, 1] += off
    particles.x[:, 1] += at
    if along == 1:
        for array in (particles.x, particles.v, particles.lo, particles.hi):
            array[..., [0, 1]] = array[..., [1, 0]]
    particles.write(lammps.path("line.data"))
    return header(1) + "read_data line.data\n" + fluid(1) + INTEGRATE + "run 0\n"


@pytest.mark.parametrize("ranks", [1, 2, 4])
@pytest.mark.parametrize("along", [0, 1])
def test_dim_1_needs_a_line(lammps, along, ranks):
    for at in (0.0, 3.7, 10.0 - 1e-12):
        lammps(line(lammps, along, at), ranks=ranks)
        lammps(line(lammps, along, at, off=3e-12), ranks=ranks)
        refused(lammps, line(lammps, along, at, off=1e-3), r"must lie on a line .* but they spread over .*\b0\.001\b", ranks)


def test_dim_1_line_and_other_particles(lammps):
    """Particles of other styles need not be on it."""
    particles = lattice(1, 60)
    particles.x[7, 1] = 5.0
    particles.type[7] = 2
    particles.write(lammps.path("line.data"))
    lammps(header(1) + "read_data line.data\npair_style hybrid sph/bulk dim 1 zero 3.0\n"
           "pair_coeff 1 1 sph/bulk 1.0 10.0 0.5 2.0 3.0\npair_coeff 1*2 2 zero\n" + INTEGRATE + "run 0\n")


# ---------------------------------------------------------------------------------------------
# warnings


@pytest.mark.parametrize("ranks", [1, 2])
def test_time_step_warning_comes_again_for_another_step_or_other_coefficients(lammps, ranks):
    box(lammps)
    text = header(2) + "read_data box.data\n" + fluid(2) + INTEGRATE
    runs = ["timestep 0.2\nrun 0\nrun 0\n", "timestep 0.3\nrun 0\nrun 0\n", "timestep 0.2\nrun 0\n",
            "pair_coeff * * 1.0 11.0 0.5 2.0 3.0\nrun 0\n", "run 0\n", "timestep 0.001\nrun 0\n"]
    warned = [re.search("time step (\\S+) exceeds", line) for line in lammps(text + "".join(runs), ranks=ranks).warnings]
    assert [match[1] for match in warned if match] == ["0.2", "0.3", "0.2", "0.2"]


def warnings(lammps, text, words, ranks=1):
    return [line for line in lammps(text + "run 0\n", ranks=ranks).warnings if re.search(words, line)]


@pytest.mark.parametrize("ranks", [1, 2])
def test_ideal_gas_without_energy(lammps, ranks):
    particles = box(lammps)
    text = header(2) + "read_data box.data\n" + fluid(2, "eos ideal") + INTEGRATE
    assert not warnings(lammps, text, "energy", ranks)
    some = warnings(lammps, text + "group G type 2\nset group G sph/e 0.0\n", "energy", ranks)
    number = (particles.type == 2).sum()
    assert len(some) == 1 and f"{number} of {len(particles)} particles have no internal energy" in some[0], some
    assert "set ... sph/e" in some[0]
    assert not warnings(lammps, text.replace("ideal", "linear") + "set group all sph/e 0.0\n", "energy", ranks)
    wall = ("region W block INF INF INF 4 INF INF\ngroup W region W\nset group W sph/e 0.0\nunfix FLUID\n"
            "group F subtract all W\nfix FLUID F sph/bulk\nfix W W sph/wall\n")
    assert not warnings(lammps, text + wall, "energy", ranks)


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("ranks", [1, 2, 4])
@pytest.mark.parametrize("dim", [1, 2, 3])
def test_support_smaller_than_the_spacing(lammps, dim, ranks, newton):
    lattice(dim, {1: 60, 2: 12, 3: 8}[dim]).write(lammps.path("box.data"))
    text = header(dim, newton=newton) + "read_data box.data\n"
    for kernel in ("wendland/c2", "wendland/c6", "lucy"):    # the estimate of a distance depends on the kernel
        for support, few in ((0.9, True), (1.2, True), (1.75, True), (2.1, False), (3.0, False)):
            found = warnings(lammps, text + fluid(dim, f"kernel {kernel}", support=support) + INTEGRATE, "too few neighbors", ranks)
            assert len(found) == few, (kernel, support, found)
            if found:
                assert f"the support radius {support} is less than 2 distances of the particles of type 1" in found[0]


@pytest.mark.parametrize("newton, ranks", [("on", 1), ("off", 2), ("on", 4), ("off", 4)])
def test_particles_in_the_same_place(lammps, newton, ranks):
    """Of two regions that overlap, and of fluid on a wall; once, unless their number grows."""
    regions = ("region B block 0 12 0 12 -.5 .5\nlattice sq 1.0 origin 0.5 0.5 0\ncreate_box 2 B\nregion W block INF INF 0 {} INF INF\n"
               "region F block INF INF 3 INF INF INF\nregion M block 3 6 5 {} INF INF\ncreate_atoms 2 region W\ncreate_atoms 1 region F\n"
               "create_atoms 1 region M\ngroup W type 2\ngroup F type 1\nset group all mass 1\n")
    base = header(2, newton=newton) + "{}pair_style sph/bulk\npair_coeff * * 1 10 .1 .3 2.7\nfix FLUID F sph/bulk\nfix W W sph/wall\ntimestep 0.01\n"
    for wall, more, number in ((3, 5, 0), (3, 7, 6), (4, 5, 12), (4, 7, 18)):
        result = lammps(base.format(regions.format(wall, more)) + "run 1\nrun 1\n", ranks=ranks)
        found = [re.search(r"(\d+) pairs of particles are in the same place, one of them particle \d+:", line) for line in result.warnings]
        assert [int(one[1]) for one in found if one] == [number] * (number > 0)
    result = lammps(base.format(regions.format(5, 5)) + "run 1\n", ranks=ranks, check=False)
    assert "is inside a wall in step 0" in result.output
    assert ranks > 1 or "24 pairs of particles are in the same place" in result.log    # the processor that stops does not wait for the log of the first


def test_a_few_free_particles_are_no_fluid(lammps):
    for chosen in ([5], [3, 40, 77, 100]):
        lattice(2, 12).where(np.isin(np.arange(144), chosen)).write(lammps.path("box.data"))
        assert not warnings(lammps, header(2) + "read_data box.data\n" + fluid(2) + INTEGRATE, "neighbors")


# ---------------------------------------------------------------------------------------------
# errors point at the argument


@pytest.mark.parametrize("command, word", [
    ("pair_style sph/bulk eos stiff", "stiff"), ("pair_style sph/bulk kernel lucy krenel lucy", "krenel"),
    ("pair_style hybrid/overlay zero 3.0 sph/bulk kernel gaussian", "gaussian"), ("pair_style sph/bulk dim 7", "7"),
    ("pair_coeff 1 1 1.0 10.0 0.5 -2.0 3.0", "-2.0"), ("pair_coeff 1 1 1.0 10.0 0.5 2.0 -3.0", "-3.0"),
    ("pair_coeff 1 1 1.0 10.0 0.5 2.0 3.0 pb 1.0 vis 2", "vis"), ("pair_coeff 1 2 kappa 1.0", "kappa"),
    ("pair_coeff 1 2 mu -1.0", "-1.0"), ("pair_coeff 1 1 1.0 10.0 -0.5 2.0 3.0", "-0.5")])
def test_errors_point_at_the_argument(lammps, command, word):
    box(lammps)
    result = lammps(header(2) + "read_data box.data\n" + fluid(2) + f"{command}\n", check=False)
    lines = result.output.splitlines()
    place = next(i for i, text in enumerate(lines) if re.fullmatch(r" +\^+", text))
    mark = lines[place]
    start = len(mark) - len(mark.lstrip())
    assert lines[place - 1][start:len(mark)] == word, "\n".join(lines[place - 1:place + 1])


@pytest.mark.parametrize("option", ["energy yes", "virial yes", "bodyforces early", "respa 1"])
@pytest.mark.parametrize("fix", ["sph/bulk", "sph/wall"])
def test_fix_modify_has_nothing_to_modify(lammps, fix, option):
    """As the pages say; only dynamic/dof, which LAMMPS offers for any fix, is not refused."""
    box(lammps)
    refused(lammps, header(2) + "read_data box.data\n" + fluid(2) + f"fix M all {fix}\nfix_modify M {option}\n",
            f"does not support fix_modify|fix_modify {option.split()[0]}")


@pytest.mark.parametrize("lists", ["exclude type 1 1", "exclude group A A", "exclude group A B"])
@pytest.mark.parametrize("ranks", [1, 2])
def test_pairs_of_the_fluid_are_excluded(lammps, lists, ranks):
    """Between particles of one type; not where the fluid has no such particles."""
    disordered(2, 10, ntypes=1).write(lammps.path("box.data"))
    text = header(2) + "read_data box.data\ngroup A id 1:100:2\ngroup B subtract all A\n" + fluid(2) + INTEGRATE
    result = lammps(text + f"neigh_modify {lists}\nrun 1\n", ranks=ranks, check=False)
    assert result.code == 1 and "leaves out pairs of the fluid of type 1" in result.error, result.error
    lammps(text + "group none empty\nneigh_modify exclude group none all\nrun 1\nneigh_modify exclude none\nrun 1\n", ranks=ranks)


def test_pairs_of_a_body_are_excluded(lammps):
    """As LAMMPS's page of fix rigid recommends it; particles of the fluid need all neighbors, whatever moves them."""
    disordered(2, 10, ntypes=2).write(lammps.path("box.data"))
    text = header(2) + "read_data box.data\ngroup BODY type 2\ngroup FLUID type 1\n" + fluid(2) + "fix 1 FLUID sph/bulk\n"
    result = lammps(text + "neigh_modify exclude group BODY BODY\nrun 1\n", check=False)
    assert result.code == 1 and "leaves out pairs of the fluid of type 2" in result.error, result.error
    lammps(text + "run 1\n")
