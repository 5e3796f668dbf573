"""Bad input: LAMMPS's usual error, naming the word or the value, on every rank; no crash, no hang, no NaN."""

import re
from pathlib import Path

import pytest

from helpers import disordered, lattice

ROOT = Path(__file__).resolve().parents[2]
GOOD = {
    "units": "units lj",
    "dimension": "dimension 2",
    "boundary": "boundary p p p",
    "newton": "newton on",
    "atom_style": "atom_style sph/bulk",
    "box": "read_data box.data",
    "pair_style": "pair_style sph/bulk",
    "pair_coeff": "pair_coeff * * 1.0 10.0 0.5 2.0 3.0",
    "fix": "fix 1 all sph/bulk",
    "extra": "",
    "timestep": "timestep 0.005",
    "run": "run 2",
}
TWO = "pair_coeff 1 1 1.0 10.0 0.5 2.0 3.0\npair_coeff 2 2 1.0 10.0 0.5 2.0 3.0\n"
LJ = "pair_style lj/cut 2.5"
LJ_COEFF = "pair_coeff * * 1.0 1.0"


def deck(**changes):
    assert set(changes) <= set(GOOD)
    return "\n".join({**GOOD, **changes}.values()) + "\n"


@pytest.fixture
def box(lammps):
    disordered(2, 10, ntypes=2, spread=0.04).write(lammps.path("box.data"))
    disordered(3, 6, ntypes=2, spread=0.04).write(lammps.path("box3.data"))
    return lammps


def case(words, **changes):
    """Changed input, and what its error has to say: one pattern or several."""
    words = [words] if isinstance(words, str) else words
    return pytest.param(changes, words, id=" | ".join(value.replace("\n", "; ") for value in changes.values()))


def style(words, arguments, **changes):
    return case(words, pair_style=f"pair_style sph/bulk {arguments}", **changes)


def coeff(words, arguments, **changes):
    return case(words, pair_coeff=f"pair_coeff {arguments}", **changes)


def unlike(words, arguments):
    return case(words, pair_coeff=TWO + f"pair_coeff {arguments}")


IN_3D = dict(dimension="dimension 3", box="read_data box3.data")

PAIR_STYLE = [
    style("Unknown pair_style sph/bulk keyword: krenel", "krenel lucy"),
    style("Unknown pair_style sph/bulk keyword: 3.0", "3.0"),
    style("Unknown pair_style sph/bulk keyword: lucy", "kernel cubic lucy"),
    style("Unknown kernel gauss", "kernel gauss"),
    style("Unknown kernel wendland", "kernel wendland"),
    style("Unknown eos stiff", "eos stiff"),
    style("Unknown shear form monaghan", "shear monaghan"),
    style("Unknown bulk form pressure", "bulk pressure"),
    style("kernel", "kernel"),
    style("dim", "dim"),
    style("eos", "kernel lucy eos"),
    style("shear", "shear"),
    style("bulk", "shear mg bulk"),
    style("dim 3 does not match the 2-d simulation box", "dim 3"),
    style("dim 2 does not match the 3-d simulation box", "dim 2", **IN_3D),
    style("dim 1 requires a 2d box", "dim 1", **IN_3D),
    style("dim.* 0", "dim 0"),
    style("dim.* 4", "dim 4"),
    style("limit", "limit"),
    style("Unknown limit maybe", "limit maybe"),
    style(["limit", "bulk density"], "limit yes bulk volume"),
    style("-1", "dim -1"),
    style("2.5", "dim 2.5"),
    style("two", "dim two"),
]

PAIR_COEFF = [
    *[coeff(r"Incorrect (number of )?arg|[Mm]issing", "* * " + " ".join("1.0 10.0 0.5 2.0".split()[:k])) for k in range(5)],
    coeff("missing", "*"),
    coeff(r"\bx1\b", "* * x1 10.0 0.5 2.0 3.0"),
    coeff(r"\bfast\b", "* * 1.0 fast 0.5 2.0 3.0"),
    coeff("0,5", "* * 1.0 10.0 0,5 2.0 3.0"),
    coeff("intrinsick", "* * 1.0 10.0 0.5 intrinsick 3.0"),
    coeff("three", "* * 1.0 10.0 0.5 2.0 three"),
    coeff(r"\bnan\b", "* * 1.0 nan 0.5 2.0 3.0"),
    coeff("1e999", "* * 1.0 1e999 0.5 2.0 3.0"),
    coeff("rho0 must be > 0", "* * 0.0 10.0 0.5 2.0 3.0"),
    coeff("rho0 must be > 0", "* * -1.0 10.0 0.5 2.0 3.0"),
    coeff("c0 must be > 0", "* * 1.0 0.0 0.5 2.0 3.0"),
    coeff("c0 must be > 0", "* * 1.0 -10.0 0.5 2.0 3.0"),
    coeff("mu must be >= 0", "* * 1.0 10.0 -0.5 2.0 3.0"),
    coeff("kappa must be >= 0", "* * 1.0 10.0 0.5 -0.001 3.0"),
    coeff("rc must be > 0", "* * 1.0 10.0 0.5 2.0 0.0"),
    coeff("rc must be > 0", "* * 1.0 10.0 0.5 2.0 -3.0"),
    coeff("viscosity", "* * 1.0 10.0 0.5 2.0 3.0 viscosity 1.0"),
    coeff(r"\b7\b", "* * 1.0 10.0 0.5 2.0 3.0 7"),
    coeff("pb", "* * 1.0 10.0 0.5 2.0 3.0 pb"),
    coeff("gamma", "* * 1.0 10.0 0.5 2.0 3.0 pb 1.0 gamma"),
    coeff("high", "* * 1.0 10.0 0.5 2.0 3.0 pb high"),
    coeff("seven", "* * 1.0 10.0 0.5 2.0 3.0 gamma seven"),
    *[coeff("gamma must be > 0", f"* * 1.0 10.0 0.5 2.0 3.0 gamma {gamma}", pair_style=f"pair_style sph/bulk eos {eos}")
      for eos in ("tait", "ideal") for gamma in (-1, 0)],
    coeff("gamma must be > 1 with eos ideal", "* * 1.0 10.0 0.5 2.0 3.0 gamma 1.0", pair_style="pair_style sph/bulk eos ideal"),
    coeff(["mu", "shear none"], "* * 1.0 10.0 0.5 2.0 3.0", pair_style="pair_style sph/bulk shear none"),
    coeff("3.*1-2", "3 3 1.0 10.0 0.5 2.0 3.0"),
    coeff("range.* 0 ", "0 1 1.0 10.0 0.5 2.0 3.0"),
    coeff("range.* -1 ", "-1 1 1.0 10.0 0.5 2.0 3.0"),
    coeff("All pair coeffs are not set", "1 1 1.0 10.0 0.5 2.0 3.0"),
    case("All pair coeffs are not set", pair_coeff=""),
    coeff("[Pp]air_?coeff", "* * 1.0 10.0 0.5 2.0 3.0", pair_style=""),
    case(["rc", r"\b2\.9\b"], pair_coeff="pair_coeff 1 1 1 10 0.5 2 3.0\npair_coeff 2 2 1 10 0.5 2 2.9"),
    unlike(r"\b1\.0\b|type", "1 2 1.0 10.0 0.5 2.0 3.0"),
    *[unlike(word, f"1 2 {word} 1.0") for word in ("rho0", "c0", "kappa", "pb", "gamma", "rc", "nu")],
    unlike("pb", "1 2 mu 0.3 pb 1.0"),
    unlike("kappa", "2 1 mu 0.3 kappa 1.0"),
    unlike("mu", "1 2 mu"),
    unlike("thick", "1 2 mu thick"),
    unlike("mu must be >= 0", "1 2 mu -0.3"),
    unlike("[Ii]ncorrect arg|[Mm]issing", "1 2"),
    unlike(r"\bmu\b", "1 1 mu 0.3"),
]

FIX = [
    case("requires fix sph/bulk", fix=""),
    case("requires fix sph/bulk", fix="fix 1 all nve"),
    case(r"\bdamp\b", fix="fix 1 all sph/bulk damp 1.0"),
    case("fluid", fix="fix 1 fluid sph/bulk"),
    case(["shift needs the forces", "pair_modify compute no"], fix="fix 1 all sph/bulk shift 0.1", extra="pair_modify compute no"),
    case(["Variable T", "invalid style"], fix="variable T string hot\nfix 1 all sph/bulk temperature v_T",
         pair_coeff="pair_coeff * * 1.0 10.0 0.5 2.0 3.0 cv 1.0"),
    case("inertia requires pair style sph/micropolar", atom_style="atom_style sph/micropolar", pair_style=LJ, pair_coeff=LJ_COEFF,
         box="region B block 0 9 0 9 -.5 .5\ncreate_box 2 B\ncreate_atoms 1 random 50 1 B\nset group all mass 1.0",
         fix="fix 1 all sph/micropolar inertia 0.1 0.0"),
]

PARTICLES = [
    case(["sph/bulk and sph/micropolar", "one of the two"], atom_style="atom_style hybrid sph/bulk sph/micropolar"),
    case(["sph/bulk and sph/micropolar", "one of the two"], atom_style="atom_style hybrid charge sph/micropolar sph/bulk"),
    case(["internal energy .* finite .* particle 7 ", "set"], extra="variable e atom 1e308*10\nset atom 7 sph/e v_e"),
    case("requires atom style sph/bulk", atom_style="atom_style sph", box="region B block 0 9 0 9 -.5 .5\n"
         "create_box 2 B\ncreate_atoms 1 random 50 1 B\nmass * 1.0", fix=""),
    case("requires atom style sph/bulk", atom_style="atom_style atomic", box="region B block 0 9 0 9 -.5 .5\n"
         "create_box 2 B\ncreate_atoms 1 random 50 1 B\nmass * 1.0", pair_style=LJ, pair_coeff=LJ_COEFF),
    case("atom_style", atom_style="atom_style sph/bulk 3"),
    case("mass must be > 0", box="read_data zero.data"),
    case("mass must be > 0", box="read_data negative.data"),
    case(["mass must be > 0", "set"], box="region B block 0 9 0 9 -.5 .5\ncreate_box 2 B\n"
         "create_atoms 1 random 50 1 B"),
    case("heavy", box="read_data word.data"),
    case("Atoms|format|columns", box="read_data short.data"),
    case(r"mass", extra="set type 1 mass 0.0"),
    case("box too narrow for dim 1", box="read_data narrow.data", pair_style="pair_style sph/bulk dim 1",
         pair_coeff="pair_coeff * * 1.0 10.0 0.5 2.0 4.0"),
    case("units", units="units real"),
    case("units", units="units metal"),
    case("comm_modify vel yes", box="read_data tilted.data", extra="fix 2 all deform 1 xy erate 0.1 remap v"),
    case("comm_modify vel yes", extra="fix 2 all deform 1 x erate 0.1 remap v", newton="newton off"),
    case("mass must be > 0", extra="region R block 2 8 2 8 -0.5 0.5\n"
         "fix D all deposit 5 1 1 4711 region R near 0.1", run="run 10"),
    case("sph/heatconduction", pair_style="pair_style hybrid/overlay sph/bulk sph/heatconduction",
         pair_coeff="pair_coeff * * sph/bulk 1.0 10.0 0.5 2.0 3.0\npair_coeff * * sph/heatconduction 1.0 3.0"),
    case("cannot be combined with pair style sph/rhosum, which needs masses by type",
         pair_style="pair_style hybrid/overlay sph/bulk density continuity sph/rhosum 1",
         pair_coeff="pair_coeff * * sph/bulk 1.0 10.0 0.5 2.0 3.0\npair_coeff * * sph/rhosum 3.0"),
    case(["ghost cutoff", "2.5"], extra="comm_modify cutoff 2.5"),
    case("pair_write", extra="pair_write 1 1 100 r 0.5 3.0 table.txt FLUID"),
    case("group/group", extra="compute G all group/group all"),
    case("respa", extra="run_style respa 2 2 pair 1"),
    case("respa|rRESPA", extra="run_style respa 2 2 inner 1 2.0 2.5 outer 2"),
]

FLUIDS = """# UNITS: lj
water 20 1.0 10.0 0.5 2.0
ice 0 1.0 10.0 0.5 {}
"""
FILES = [
    coeff(["nowhere.sph", "LAMMPS_POTENTIALS"], "* * nowhere.sph water 3.0"),
    coeff("wine.*good.sph|good.sph.*wine", "* * good.sph wine 3.0"),
    coeff("solid", "* * word.sph water 3.0"),
    coeff("kappa must be >= 0", "* * negative.sph water 3.0"),
    coeff("columns", "* * short.sph water 3.0"),
    coeff("water", "* * twice.sph water 3.0"),
    coeff("units", "* * metal.sph water 3.0"),
    coeff("rc must be > 0", "* * good.sph water 0.0"),
    coeff("three", "* * good.sph water three"),
    coeff("[Mm]issing|good.sph", "* * good.sph water"),
    coeff("[Mm]issing|good.sph", "* * good.sph"),
]
ATOMIC = dict(atom_style="atom_style atomic", pair_style=LJ, pair_coeff=LJ_COEFF, fix="fix 1 all nve",
              box="region B block 0 9 0 9 -.5 .5\ncreate_box 2 B\ncreate_atoms 1 random 50 1 B\nmass * 1.0")
COMPUTES = [
    case("keyword.*verbose|verbose", extra="compute Q all sph/dissipation verbose"),
    case("verbose", extra="compute E all sph/energy verbose"),
    case("group all", extra="group A type 1\ncompute Q A sph/dissipation"),
    case("sph/bulk", pair_style=LJ, pair_coeff=LJ_COEFF, extra="compute Q all sph/dissipation\nthermo_style custom "
         "step c_Q"),
    case("sph/bulk", extra="compute E all sph/energy", **ATOMIC),
    case("requires atom style sph/bulk", extra="compute T all sph/temp", **ATOMIC),
    case("use run 0 first", pair_coeff="pair_coeff * * 1.0 10.0 0.5 2.0 3.0 cv 1.0", run="compute T all property/atom tsph\n"
         "compute M all reduce max c_T\nrun 0\npair_coeff * * 1.0 10.0 0.5 2.0 3.0 cv 2.0\nvariable M equal c_M\nprint $(v_M)"),
]


def damaged(lammps):
    """Data files with one wrong line each."""
    text = lammps.path("box.data").read_text()
    atom = re.search(r"^7 [12] .*$", text, re.MULTILINE)[0]
    words = atom.split()
    for name, changed in {"zero": [*words[:2], "0.0", *words[3:]], "negative": [*words[:2], "-1.0", *words[3:]],
                          "word": [*words[:2], "heavy", *words[3:]], "short": words[:-2]}.items():
        lammps.path(f"{name}.data").write_text(text.replace(atom, " ".join(changed)))
    fluids = {"good": FLUIDS.format("2.0"), "word": FLUIDS.format("solid"), "negative": FLUIDS.format("-2.0"),
              "short": FLUIDS.format(""), "metal": FLUIDS.replace("lj", "metal").format("2.0"),
              "twice": FLUIDS.format("2.0").replace("ice", "water")}
    for name, content in fluids.items():
        lammps.path(f"{name}.sph").write_text(content)
    narrow = lattice(1, 60)
    narrow.type[::2] = 2
    narrow.lo[1], narrow.hi[1] = -1.5, 1.5
    narrow.write(lammps.path("narrow.data"))
    disordered(2, 10, ntypes=2, tilt=(0.0, 0.0, 0.0)).write(lammps.path("tilted.data"))


def assert_refused(result, words):
    assert result.code != 0, f"accepted:\n{result.output[-3000:]}"
    assert result.code == 1, f"ended by status {result.code}:\n{result.output[-3000:]}"
    assert result.error, f"no ERROR message:\n{result.output[-3000:]}"
    assert not re.search(r"segmentation|signal \d|\bassert", result.output, re.IGNORECASE), result.output[-3000:]
    for word in words:
        assert re.search(word, result.error), f"the message lacks '{word}':\n{result.error}"


CASES = [*PAIR_STYLE, *PAIR_COEFF, *FIX, *PARTICLES, *FILES, *COMPUTES]


@pytest.mark.parametrize("changes, words", CASES)
def test_refused(box, changes, words):
    damaged(box)
    assert_refused(box(deck(**changes), check=False, timeout=60), words)


@pytest.mark.parametrize("changes, words", PAIR_STYLE[::6] + PAIR_COEFF[::6] + FIX + PARTICLES + FILES[:3] + COMPUTES[::2])
def test_refused_on_two_ranks(box, changes, words):
    damaged(box)
    assert_refused(box(deck(**changes), ranks=2, check=False, timeout=60), words)


# -- Beginners ------------------------------------------------------------------------------------------------------

FIRST = re.search(r"^```\n(# a sound wave.*?)^```$", (ROOT / "README.md").read_text(), re.MULTILINE | re.DOTALL)[1]
SI = {r"^units .*": "units si", r"^(lattice +hex) .*": r"\1 $(1e-6*sqrt(2/sqrt(3)))", r" 4\.0 +#": " 4e-6 #", "^set .*": "set group all mass 8.66e-13"}

# what is changed in README's input: what is printed, in a warning unless it is an error
MISTAKES = {
    "no mass": ({"^set .*": ""}, r"ERROR: .* mass must be > 0, which that of particle 1 is not; use the set command"),
    "mass ten times too large": ({"v_mass$": "8.66", "density rho0": ""}, r"mean density 10\.\d* of type 1 is far from its rho0 1: the mass .* should be rho0 times its volume"),
    "time step 20 times too large": ({"^timestep .*": "timestep 1.0"}, r"time step 1 exceeds the largest stable time step 0\.049"),
    "kT of 300": ({"^pair_style .*": "pair_style sph/bulk temp 300 1"}, r"thermal velocity .* is 1\.9 c0, .* use a lower temperature, a larger c0"),
    "velocities above c0": ({"v_wave v_wave NULL": "0.0 v_wave NULL\nvelocity all ramp vx -20 20 y 0 6", "^timestep .*": "timestep 0.005"}, r"\d+ of 480 particles are faster than 0\.3 c0: .*; use a c0 of 10 times the largest speed"),
    "wall of all": ({"^(fix .*) density rho0": r"\1\nfix w all sph/wall"}, r"ERROR: .*of the wall of fix w sph/wall is also moved by fix 1 sph/bulk"),
    "units real": ({"units .*": "units real"}, r"ERROR: .* use units lj, si, cgs, micro, or nano, not real"),
    "no kappa": ({"0.4 2.0 4.0": "0.4 4.0"}, r"ERROR: Illegal pair_coeff command: missing argument\(s\), 4 of 5 given; give rho0 c0 mu kappa rc"),
    "half a kernel": ({"^pair_style .*": "pair_style sph/bulk kernel wendland"}, r"ERROR: Unknown kernel wendland .*; use wendland/c2, wendland/c4, wendland/c6, cubic, quintic, or lucy"),
    "keyword of the pair style": ({"^pair_style .*": "pair_style sph/bulk kernal lucy"}, r"ERROR: Unknown pair_style sph/bulk keyword: kernal; use kernel, dim, eos, .*, or temp"),
    "keyword of the coefficients": ({r"4\.0 +#": "4.0 yeild 0.1 1.0 #"}, r"ERROR: Unknown pair_coeff keyword .*: yeild; use yield, pb, gamma, .*, thixotropy, or cohesion"),
    "keyword of a fix": ({"density rho0": "vicous rkl2"}, r"ERROR: Unknown fix sph/bulk keyword: vicous; use viscous, density, .*, or iterations"),
    "keyword of a compute": ({"^(run .*)": r"compute e all sph/energy now\n\1"}, r"ERROR: Unknown compute sph/energy keyword: now: there are no keywords"),
    "noise without a seed": ({"^pair_style .*": "pair_style sph/bulk temp 0.01"}, r"ERROR: Illegal pair_style sph/bulk temp command: missing argument\(s\), 1 of 2 given; give T seed"),
    "yield stress without m": ({r"4\.0 +#": "4.0 yield 0.1 #"}, r"ERROR: Illegal pair_coeff yield command: missing argument\(s\), 1 of 2 given; give tau_y m"),
    "two velocities of a wall": ({"^(fix .*)": r"\1\nfix w all sph/wall velocity 1 0"}, r"ERROR: Illegal fix sph/wall velocity command: missing argument\(s\), 2 of 3 given; give vx vy vz"),
    "nve": ({"^fix .*": "fix 1 all nve"}, r"ERROR: Pair style sph/bulk requires fix sph/bulk"),
    "nvt as well": ({"^(fix .*)": r"\1\nfix 2 all nvt temp 1 1 1"}, r"Fix 2 nvt also integrates 480 particles of fix sph/bulk, .*; use fix sph/bulk alone"),
    "support of 1.2 spacings": ({r"2\.0 4\.0 +#": "2.0 1.2 #"}, r"support radius 1\.2 is less than 2 distances of the particles .*; use an rc of three to four particle distances"),
    "name of the set command": ({"^(run .*)": r"compute r all property/atom sph/rho\ncompute g all sph/grid 4 4 1 sph/e\n\1"}, None),
    "no such file of fluids": ({"^(pair_coeff +. .) .*": r"\1 liquids.sph water 4.0"}, r"ERROR: Cannot open file of fluids liquids\.sph.*export LAMMPS_POTENTIALS"),
    "no such fluid": ({"^(pair_coeff +. .) .*": r"\1 fluids.sph watr 4.0"}, r"ERROR: No fluid watr in file fluids\.sph; use water, "),
    "the skin of units si": (SI, r"skin of the neighbor list, 0\.001, is 2\.5e\+02 support radii.*; use neighbor 4e-07 bin"),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_mistakes_of_beginners(lammps, mistake):
    """README's first input with one mistake: what is printed names the cure, above no other message."""
    changes, message = MISTAKES[mistake]
    text = FIRST
    for old, new in changes.items():
        text, count = re.subn(old, new, text, flags=re.MULTILINE)
        assert count, old
    result = lammps(re.sub(r"^run .*", "run 0" if mistake.startswith("the skin") else "run 200", text, flags=re.MULTILINE), check=False, timeout=60)
    found = re.findall(r"^(?:ERROR|WARNING).*", result.output, re.MULTILINE)
    if message is None:
        assert not found and result.code == 0, found
        return
    assert re.search(message, found[0]), found
    assert (result.code or "ERROR" not in message) and "MPI_ABORT" not in result.output


@pytest.mark.parametrize("ranks", [1, 2])
def test_the_input_all_cases_start_from_is_good(box, ranks):
    result = box(deck(), ranks=ranks)
    assert not result.warnings, result.warnings
    assert not re.search(r"\bnan\b", result.log)


@pytest.mark.parametrize("arguments", [
    "* * 1.0 10.0 0.5 intrinsic 3.0", "* * 1.0 10.0 0.5 0.0 3.0", "* * 1.0 10.0 0.0 0.0 3.0",
    "* * 1.0 10.0 0.5 2.0 3.0 pb -1.0", "1*2 1*2 1.0 10.0 0.5 2.0 3.0"])
def test_limits_of_the_admissible_range_are_accepted(box, arguments):
    result = box(deck(pair_coeff=f"pair_coeff {arguments}"))
    assert not result.warnings, result.warnings


@pytest.mark.parametrize("options", ["shear none", "bulk none"])
def test_no_viscosity_is_accepted(box, options):
    box(deck(pair_style=f"pair_style sph/bulk {options}", pair_coeff="pair_coeff * * 1.0 10.0 0.0 intrinsic 3.0"))


@pytest.mark.parametrize("ranks", [1, 2])
def test_kappa_without_bulk_term_is_a_warning(box, ranks):
    result = box(deck(pair_style="pair_style sph/bulk bulk none"), ranks=ranks)
    assert len(result.warnings) == 2, result.warnings
    for line, number in zip(result.warnings, (1, 2)):
        assert re.search(f"kappa 2 of type {number} is ignored with bulk none", line)


def test_gamma_of_a_linear_fluid_is_a_warning(box):
    lines = "pair_coeff * * 1.0 10.0 0.5 2.0 3.0\npair_coeff 2 2 1.0 10.0 0.5 2.0 3.0 gamma 3"
    (line,) = box(deck(pair_coeff=lines)).warnings
    assert "gamma 3 of type 2 is ignored with eos linear" in line
    assert not box(deck(pair_style="pair_style sph/bulk eos tait", pair_coeff=lines)).warnings


@pytest.mark.parametrize("ranks", [1, 2])
def test_time_step_above_the_limit_is_a_warning_given_once(box, ranks):
    """In one run as in several."""
    for run in ("run 0", "run 0\nrun 0\nrun 0"):
        result = box(deck(timestep="timestep 0.2", run=run), ranks=ranks)
        warnings = [line for line in result.warnings if "time step" in line]
        assert len(warnings) == 1, result.warnings
        assert re.search(r"time step 0\.2 exceeds", warnings[0])


@pytest.mark.parametrize("name, change", {
    "acoustic": dict(pair_coeff="pair_coeff * * 1.0 1000.0 0.0 0.0 3.0"),
    "shear": dict(pair_coeff="pair_coeff * * 1.0 10.0 50.0 intrinsic 3.0"),
    "bulk": dict(pair_coeff="pair_coeff * * 1.0 10.0 0.0 400.0 3.0"),
}.items(), ids=lambda value: value if isinstance(value, str) else "")
def test_every_mechanism_limits_the_time_step(box, name, change):
    assert any("time step" in line for line in box(deck(run="run 0", **change)).warnings)
