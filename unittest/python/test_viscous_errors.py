"""Keyword viscous of the integrators and fix sph/dt: bad input, warnings, life of the settings."""

import re

import numpy as np
import pytest

from helpers import disordered, dump, fluid, header, lattice
from test_micropolar import STYLE as MICRO
from test_micropolar import fluid as micropolar
from test_micropolar import write


def box(lammps):
    disordered(2, 10, spread=0.04).write(lammps.path("box.data"))


def deck(fix="fix 1 all sph/bulk", options="", before="", after="", run="run 2", kappa=200.0):
    return (header(2) + "read_data box.data\n" + fluid(2, options, kappa=kappa) + before + fix
            + f"\ntimestep 0.02\n{after}{run}\n")


def refused(lammps, text, *words, ranks=1):
    box(lammps)
    result = lammps(text, check=False, ranks=ranks)
    message = re.sub(r"\s+", " ", result.error)
    assert result.code != 0
    for word in words:
        assert word in message, message


FIX = "fix 1 all sph/bulk viscous"


@pytest.mark.parametrize("keywords, words", [
    ("", "missing argument"),
    ("sometimes", "viscous must be explicit, rkl2, or implicit, not sometimes"),
    ("rkl2 stages", "missing argument"),
    ("rkl2 stages 4", "stages must be auto or an odd number from 3 to 1001, not 4"),
    ("rkl2 stages 1", "odd number from 3 to 1001, not 1"),
    ("rkl2 stages 65537", "odd number from 3 to 1001, not 65537"),
    ("rkl2 stages x", "x"),
    ("rkl2 tolerance 1e-6", "tolerance is for viscous implicit only"),
    ("explicit stages 5", "stages is for viscous rkl2 only"),
    ("implicit stages 5", "stages is for viscous rkl2 only"),
    ("explicit scheme euler", "scheme is for viscous implicit only"),
    ("implicit scheme crank", "scheme must be trapezoidal, sdirk2, or euler, not crank"),
    ("implicit tolerance 0.0", "tolerance must be > 0 and < 1, not 0.0"),
    ("implicit tolerance 1.0", "tolerance must be > 0 and < 1"),
    ("implicit tolerance nan", "instead of 'nan'"),
    ("implicit iterations 10", "missing argument"),
    ("implicit iterations 0 warn", "iterations must be >= 1, not 0"),
    ("implicit iterations 10 maybe", "iterations must end with warn or error, not maybe"),
])
def test_bad_words(lammps, keywords, words):
    refused(lammps, deck(f"{FIX} {keywords}"), words)


def test_micropolar_has_the_same_words(lammps):
    write(disordered(2, 10), lammps.path("box.data"))
    result = lammps(header(2, style=MICRO) + "read_data box.data\n" + micropolar(2)
                    + f"fix 1 all {MICRO} inertia 0.1 0.0 viscous rkl2 tolerance 0.1\nrun 0\n", check=False)
    assert "tolerance is for viscous implicit only" in re.sub(r"\s+", " ", result.error)


def test_too_few_stages(lammps):
    refused(lammps, deck(f"{FIX} rkl2 stages 3", kappa=400.0), "largest viscous rate times the time step is", "needs 5 stages, not 3", ranks=2)


def test_too_many_stages(lammps):
    """1001 stages are possible, more are refused."""
    box(lammps)
    result = lammps(deck(f"{FIX} rkl2 stages 1001", kappa=1e6, after="velocity all scale 1e-3\nthermo_style custom step ke f_1[1]\n"))
    table = result.thermo()[0]
    assert np.all(table["f_1[1]"] == 1001) and np.all(np.isfinite(table["KinEng"])) and table["KinEng"][-1] < 1.0
    for kappa in (1e9, 1e12, 1e30):
        for stages in ("auto", "1001"):
            refused(lammps, deck(f"{FIX} rkl2 stages {stages}", kappa=kappa), "stages, and 1001 are the most")
    assert "rkl2 cannot be used" in lammps(deck(f"{FIX} implicit", kappa=1e9, run="run 0")).log


def test_iterations_exhausted(lammps):
    refused(lammps, deck(f"{FIX} implicit iterations 3 error tolerance 1e-9"), "residual", "after 3 iterations at step 0")
    result = lammps(deck(f"{FIX} implicit iterations 3 warn tolerance 1e-9", run="run 5"), ranks=2)
    found = [line for line in result.warnings if "after 3 iterations at step 0" in line]
    assert len(found) == 1 and "above the tolerance 1e-09" in found[0]


@pytest.mark.parametrize("options", ["", "bulk volume"])
def test_no_solution(lammps, options):
    """A residual larger than the velocities is none, with iterations ... warn, too; by both solvers."""
    refused(lammps, deck(f"{FIX} implicit", options, kappa=1e30), "which is no solution, after", "at step 0; use a smaller time step or more iterations", ranks=2)


def test_not_finite(lammps):
    """What is not a number is not taken for negative friction, or for a rate: here squares of a velocity."""
    infinite = "set atom 3 vx 1e200\n"
    for options in ("", "bulk volume"):
        for scheme in ("trapezoidal", "sdirk2"):
            refused(lammps, deck(f"{FIX} implicit scheme {scheme}", options, after=infinite), "are not finite numbers at step 0", ranks=2)


@pytest.mark.parametrize("keywords", ["", " viscous rkl2", " viscous implicit"])
def test_new_fix_and_no_setup(lammps, keywords):
    fix = f"fix 1 all sph/bulk{keywords}"
    refused(lammps, deck(fix, run=f"run 3\nunfix 1\n{fix}\nrun 3 pre no"),
            "Fix 1 sph/bulk was defined after the last run was set up: the next one cannot be a run with pre no")


JUMP = "run 3\ntimestep 0.2\nrun 3 {}"


@pytest.mark.parametrize("mode", ["rkl2", "implicit scheme sdirk2", "implicit scheme euler", "implicit"])
def test_jump_of_the_time_step(lammps, mode):
    """The force of a short step is too large for a long one, but not the one of the trapezoidal step."""
    box(lammps)
    warned = "is more than twice that of the forces, 0.02, which may create kinetic energy"

    def jump(pre):
        return lammps(deck(f"{FIX} {mode}", run=JUMP.format(pre)))

    assert any(warned in line for line in jump("pre no").warnings) == (mode != "implicit")
    assert not any(warned in line for line in jump("").warnings)
    reset = deck(f"{FIX} {mode}", after="fix R all dt/reset 1 NULL 0.1 0.1\n")
    if mode == "implicit":
        lammps(reset)
    else:
        refused(lammps, reset, "cannot be used with fix dt/reset", "use fix sph/dt")


def test_stages_follow_the_time_step(lammps):
    """Also in a run without setup."""
    box(lammps)
    stages = []
    for pre in ("pre no", ""):
        result = lammps(deck(f"{FIX} rkl2", after="thermo_style custom step f_1[1]\nthermo 1\n", run=JUMP.format(pre)))
        stages.append([table["f_1[1]"][-1] for table in result.thermo()])
    assert stages[0] == stages[1] and stages[0][1] > stages[0][0]


def test_rest_is_not_solved_for(lammps):
    """Velocities of rounding errors, of a lattice at rest under pressure."""
    lattice(2, 10, spacing=0.97).write(lammps.path("box.data"))
    result = lammps(deck(f"{FIX} implicit", after="thermo_style custom step ke f_1[*]\nthermo 1\n", run="run 20"))
    table = result.thermo()[0]
    assert np.all(table["f_1[1]"] <= 1) and np.all(table["f_1[2]"] <= 1e-6) and np.all(table["KinEng"] < 1e-20)


def test_other_ways_to_run(lammps):
    refused(lammps, deck(f"{FIX} rkl2", run="minimize 1e-4 1e-4 5 5"), "cannot be used in a minimization")
    refused(lammps, deck(f"{FIX} implicit", before="run_style respa 2 2\n"), "respa")
    refused(lammps, deck(f"{FIX} implicit", before="pair_modify compute no\n"), "requires the forces of pair style sph/bulk")


def test_all_integrators_agree(lammps):
    two = "group A id 1:50\ngroup B subtract all A\n"
    fixes = "fix 1 A sph/bulk viscous implicit\nfix 2 B sph/bulk viscous {}"
    refused(lammps, deck(fixes.format("rkl2"), before=two), "must be the same in all fixes sph/bulk")
    lammps(deck(fixes.format("implicit tolerance 1e-13").replace("implicit\n", "implicit tolerance 1e-13\n"), before=two)
           + dump("two.dump") + "run 2\n")
    lammps(deck(f"{FIX} implicit tolerance 1e-13") + dump("one.dump") + "run 2\n")
    np.testing.assert_allclose(lammps.frame("two.dump")["v"], lammps.frame("one.dump")["v"], rtol=0, atol=1e-13)


def test_noise_needs_the_trapezoidal_step(lammps):
    for mode in ("rkl2", "implicit scheme euler", "implicit scheme sdirk2"):
        refused(lammps, deck(f"{FIX} {mode}", options="temp 1.0 1"), "implicit with scheme trapezoidal")
    lammps(deck(f"{FIX} implicit", options="temp 1.0 1"))
    refused(lammps, deck(f"{FIX} implicit", options="temp energy 20.0 1"), "temp energy needs fix sph/bulk viscous explicit")


def test_no_warning_about_the_time_step(lammps):
    box(lammps)
    assert any("exceeds the largest stable time step" in line for line in lammps(deck(f"{FIX} explicit", run="run 0")).warnings)
    for mode in ("rkl2", "implicit"):
        result = lammps(deck(f"{FIX} {mode}", run="run 0"))
        assert not any("exceeds" in line for line in result.warnings)
        assert re.search(r"largest stable time step with viscous explicit 0.0055\d*, with rkl2 or implicit 0.03\d*;", result.log)
        assert "rkl2 would take 3 stages" in result.log
        assert any("exceeds" in line for line in lammps(deck(f"{FIX} {mode}", after="timestep 0.05\n", run="run 0")).warnings)


def test_explicit_is_the_default(lammps):
    box(lammps)
    frames = []
    for keywords in ("fix 1 all sph/bulk", f"{FIX} explicit"):
        lammps(deck(keywords, kappa=1.0, run="") + dump("out.dump") + "run 10\n")
        frames.append(lammps.frame("out.dump")["v"])
    assert np.array_equal(*frames)
    refused(lammps, deck(f"{FIX} explicit", run="") + "thermo_style custom step f_1[1]\nrun 0\n", "does not compute a vector")


def test_settings_end_with_their_fix(lammps):
    """Another fix, another run: what a fix had set is forgotten."""
    box(lammps)
    again = "unfix 1\nfix 1 all sph/bulk\n"
    lammps(deck(f"{FIX} rkl2", kappa=1.0, run="run 0\n" + again) + dump("other.dump") + "run 5\n")
    lammps(deck(kappa=1.0, run="") + dump("plain.dump") + "run 5\n")
    assert np.array_equal(lammps.frame("other.dump")["v"], lammps.frame("plain.dump")["v"])


@pytest.mark.parametrize("mode", ["rkl2", "implicit tolerance 1e-13", "implicit scheme sdirk2 tolerance 1e-13"])
def test_restart_is_a_second_run(lammps, mode):
    box(lammps)
    lammps(deck(f"{FIX} {mode}", run="run 5\nwrite_restart half.restart") + dump("two.dump") + "run 5\n")
    lammps(f"read_restart half.restart\n{FIX} {mode}\ntimestep 0.02\n" + dump("again.dump") + "run 5\n", ranks=2)
    np.testing.assert_allclose(lammps.frame("again.dump")["v"], lammps.frame("two.dump")["v"], rtol=0, atol=1e-12)


def test_stages_follow_the_coefficients(lammps):
    """fix adapt makes the bulk viscosity ten thousand times as large between two estimates of the rate."""
    box(lammps)
    adapt = "variable k equal 10.0+(step>4)*90000\nfix A all adapt 1 pair sph/bulk kappa * * v_k\n"
    energy = "compute E all sph/energy\nthermo 1\nthermo_style custom step ke c_E f_1[1]\nthermo_modify norm no\n"
    result = lammps(deck(f"{FIX} rkl2", kappa=10.0, before="velocity all scale 1e-4\nneighbor 1.0 bin\n", after=adapt + energy, run="run 12"))
    table = result.thermo()[0]
    assert table["f_1[1]"][4] <= 5 and np.all(table["f_1[1]"][5:] > 50)
    assert np.ptp(table["c_E"]) < 1e-6 * table["c_E"][0] and np.all(np.diff(table["KinEng"][4:]) < 0.0)
    refused(lammps, deck(f"{FIX} rkl2 stages 5", kappa=10.0, after=adapt, run="run 12"), "at step 5, which needs")


def test_shear_flow_with_remapped_velocities(lammps):
    """fix deform remap v: neighbors across the boundary have another velocity; a Couette flow stays as it is."""
    particles = disordered(2, 12, jitter=0.0, speed=0.0, spread=0.0, tilt=(0.0, 0.0, 0.0))
    particles.v[:, 0] = 0.1 * (particles.x[:, 1] - 6.0)
    particles.write(lammps.path("box.data"))
    for mode in ("rkl2", "implicit", "implicit scheme sdirk2"):
        lammps(header(2) + "read_data box.data\ncomm_modify vel yes\n" + fluid(2, mu=20.0, kappa=200.0)
               + f"{FIX} {mode}\nfix D all deform 1 xy erate 0.1 remap v\ntimestep 0.02\n" + dump("out.dump", 100) + "run 200\n")
        frame = lammps.frame("out.dump")
        expected = 0.1 * (frame.columns["yu"] - 6.0)
        assert np.abs(frame["v"][:, 0] - expected + 1.2 * np.round((expected - frame["v"][:, 0]) / 1.2)).max() < 0.02, mode


# ---- fix sph/dt ---------------------------------------------------------------------------------------------------


DT = "fix DT all sph/dt"


@pytest.mark.parametrize("words, message", [
    ("", "missing argument"),
    ("0", "N must be >= 1, not 0"),
    ("10 acoustic", "missing argument"),
    ("10 acoustic -1", "acoustic must be > 0, not -1"),
    ("10 viscous nan", "instead of 'nan'"),
    ("10 speed 3", "Unknown fix sph/dt keyword: speed"),
    ("10 min 0.1 max 0.01", "min 0.1 is larger than max 0.01"),
])
def test_dt_bad_words(lammps, words, message):
    refused(lammps, deck(after=f"{DT} {words}\n"), message)


def test_dt_bad_company(lammps):
    refused(lammps, deck(after="group A id 1:10\nfix DT A sph/dt 1\n"), "must use group all")
    refused(lammps, deck(options="temp 1.0 1", after=f"{DT} 1\n"), "cannot be used with fix sph/dt")
    refused(lammps, deck(after=f"{DT} 1\nfix E all dt/reset 1 NULL NULL 0.1\n"), "only one fix can set the time step")
    refused(lammps, deck(before="run_style respa 2 2\n", after=f"{DT} 1\n"), "respa")
    refused(lammps, deck(after=f"{DT} 1\npair_style none\n"), "requires pair style")


def steps(lammps, fix, dt, kappa=200.0, c0=10.0, run=20, extra=""):
    box(lammps)
    result = lammps(header(2) + "read_data box.data\n" + fluid(2, kappa=kappa, c0=c0) + fix + f"\ntimestep 0.001\n{DT} {dt}\n"
                    + extra + "thermo 1\nthermo_style custom step dt time f_DT f_DT[*] ke\nthermo_modify format float %.15g norm no\n"
                    + f"run {run}\n")
    return result.thermo()[0], result.log


def test_dt_follows_the_limits(lammps):
    """The acoustic limit with the speed of the fastest particle; the viscous one if the step is explicit, or if asked for."""
    table, log = steps(lammps, "fix 1 all sph/bulk", 1)
    assert table["Dt"][0] == pytest.approx(0.0055, rel=0.5) and np.allclose(table["Dt"], table["f_DT"], rtol=1e-14)
    assert np.all(table["f_DT[2]"] < table["f_DT[1]"])
    table, _ = steps(lammps, "fix 1 all sph/bulk viscous rkl2", 1)
    assert np.allclose(table["Dt"][1:], np.minimum(np.minimum(table["f_DT[1]"], table["f_DT[3]"])[1:], 1.25 * table["Dt"][:-1]), rtol=1e-12)
    assert np.all(table["f_DT[2]"] == 1e300) and table["Dt"][-1] > 0.02
    fixed, _ = steps(lammps, "fix 1 all sph/bulk viscous rkl2", "1 viscous 2.0")
    assert fixed["f_DT[2]"][0] == pytest.approx(2.0 * steps(lammps, "fix 1 all sph/bulk", 1)[0]["f_DT[2]"][0])
    half, _ = steps(lammps, "fix 1 all sph/bulk viscous rkl2", "1 acoustic 0.125")
    assert half["f_DT[1]"][0] == pytest.approx(0.5 * table["f_DT[1]"][0])
    bounded, _ = steps(lammps, "fix 1 all sph/bulk viscous rkl2", "1 max 0.004")
    assert np.all(bounded["Dt"] == 0.004)
    bounded, _ = steps(lammps, "fix 1 all sph/bulk viscous rkl2", "1 min 0.1", run=1)
    assert np.all(bounded["Dt"] == 0.1)


def test_dt_force_and_time(lammps):
    """A body force shortens the step; the time is the sum of the steps; N steps apart."""
    table, _ = steps(lammps, "fix 1 all sph/bulk viscous implicit", "5 force 0.02",
                     extra="fix G all gravity 200.0 vector 1 0 0\n")
    dt = table["Dt"]
    assert np.all(table["f_DT[3]"][5:] < table["f_DT[1]"][5:]) and dt[-1] < 0.5 * dt[0]
    assert np.all(dt[5:9] == dt[5]) and dt[0] == dt[4] != dt[5]
    np.testing.assert_allclose(np.diff(table["Time"]), dt[:-1], rtol=1e-12)


def test_dt_knows_the_inertia_of_the_first_step(lammps):
    """Keyword inertia of the integrator sets it later than the first time step: the order of the fixes does not matter."""
    write(disordered(2, 10), lammps.path("box.data"), inertia=0.0)
    integrate, dt = f"fix 1 all {MICRO} inertia 1e-3 0.0\n", f"{DT} 1\n"
    tables = []
    for fixes in (integrate + dt, dt + integrate):
        result = lammps(header(2, style=MICRO) + "read_data box.data\n" + micropolar(2) + fixes
                        + "thermo 1\nthermo_style custom step dt f_DT[2]\nthermo_modify format float %.15g\nrun 3\n")
        tables.append(result.thermo()[0])
        assert not any("exceeds" in line for line in result.warnings)
    assert np.array_equal(tables[0]["Dt"], tables[1]["Dt"])
    assert tables[0]["f_DT[2]"][0] == pytest.approx(tables[0]["f_DT[2]"][1], rel=0.01) and tables[0]["Dt"][0] < 1e-3


def test_dt_knows_the_first_forces(lammps):
    """Of a fix before it, at once, however large N is; with a stage of its own for the viscous terms, too."""
    gravity = "fix G all gravity 1e4 vector 1 0 0\n"
    for mode in ("", " viscous implicit"):
        table, _ = steps(lammps, f"{gravity}fix 1 all sph/bulk{mode}", "20 force 0.02", kappa=1.0, run=2)
        assert table["Dt"][0] == table["f_DT[3]"][0] < 0.5 * table["f_DT[1]"][0]


def test_dt_without_a_limit(lammps):
    """A gas without energy, viscosity and force has none: the time step stays, or is the largest one."""
    particles = disordered(2, 10, speed=0.0, tilt=(0.0, 0.0, 0.0))
    particles.esph[:] = 0.0
    particles.write(lammps.path("cold.data"))
    for words, expected in (("1", 0.001), ("1 max 0.5", 0.5), ("1 min 0.01", 0.01)):
        result = lammps(header(2) + "read_data cold.data\npair_style sph/bulk dim 2 eos ideal\npair_coeff * * 1.0 1.4 0.0 0.0 3.0\n"
                        + f"fix 1 all sph/bulk\ntimestep 0.001\n{DT} {words}\nthermo_style custom step dt f_DT[*]\nrun 2\n")
        table = result.thermo()[0]
        assert np.all(table["Dt"] == expected), words
        assert all(np.all(table[f"f_DT[{k}]"] == 1e300) for k in (1, 2, 3))
