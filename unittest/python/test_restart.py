"""Continuing from restart and data files."""

import re

import numpy as np
import pytest

from helpers import INTEGRATE, as_written, disordered, dump, fluid, header, relative, undump
from test_micropolar import fluid as micropolar_fluid, spins, write as write_micropolar

# every keyword away from its default at least once
SETTINGS = {
    "c4": (2, "kernel wendland/c4 eos tait shear mg/fr bulk volume",
           ["1 1 1.0 10.0 0.5 2.0 3.0 gamma 5 pb 1.25", "2 2 1.1 12.0 0.2 0.8 3.0", "1 2 mu 0.3"]),
    "quintic": (2, "kernel quintic eos ideal shear morris bulk none",
                ["1 1 1.0 10.0 0.5 intrinsic 3.0 gamma 1.6", "2 2 1.1 12.0 0.2 intrinsic 3.0", "1 2 mu 0.7"]),
    "lucy": (3, "kernel lucy eos linear shear mg bulk density",
             ["1 1 1.0 10.0 0.5 2.0 2.5 pb 3.5", "2 2 1.1 12.0 0.2 intrinsic 2.5"]),
    "line": (1, "kernel cubic eos linear shear none bulk density",
             ["1 1 1.0 10.0 0.0 2.0 4.0 pb 3.5", "2 2 1.1 12.0 0.0 1.0 4.0"]),
    "c6": (2, "kernel wendland/c6 eos tait shear mg bulk density", ["* * 1.0 10.0 0.5 0.1 3.0"]),
}
CELLS = {1: 80, 2: 16, 3: 7}


def model(name):
    dim, options, lines = SETTINGS[name]
    return fluid(dim, options, coeff="".join(f"pair_coeff {line}\n" for line in lines))


def start(lammps, name):
    dim = SETTINGS[name][0]
    disordered(dim, CELLS[dim], ntypes=2).write(lammps.path("box.data"))
    return header(dim) + "read_data box.data\n" + model(name) + INTEGRATE


@pytest.mark.parametrize("name", SETTINGS)
@pytest.mark.parametrize("before, after", [(1, 1), (2, 4)])
def test_continue_from_a_restart_file(lammps, name, before, after):
    """No pair_style and no pair_coeff after read_restart: the file has them."""
    if (before, after) == (2, 4) and name not in ("c4", "lucy", "line"):
        pytest.skip("ranks are covered by the other settings")
    lammps(start(lammps, name) + "run 200\nwrite_restart state.restart\n" + dump("whole.dump", 200) + "run 200\n",
           ranks=before)
    lammps("read_restart state.restart\n" + INTEGRATE + dump("parts.dump", 200) + "run 200\n", ranks=after)
    whole, parts = lammps.frames("whole.dump"), lammps.frames("parts.dump")
    assert [frame.step for frame in whole] == [frame.step for frame in parts] == [200, 400]
    for key in ("mass", "type"):
        assert (whole[0][key] == parts[0][key]).all()
    for key in ("x", "v", "esph"):
        assert np.abs(whole[0][key] - parts[0][key]).max() < 1e-13, f"{key} changed on the way through the file"
    difference = np.abs(whole[1]["x"] - parts[1]["x"]).max()
    print(f"largest difference {difference:.2e}")
    assert difference < 1e-12


@pytest.mark.parametrize("style", ["sph/bulk", "hybrid sph/bulk charge"])
def test_continue_from_one_file_per_rank(lammps, style):
    """Also with a hybrid atom style, whose fields travel together."""
    particles = disordered(2, 16, ntypes=2)
    particles.charge = np.linspace(-1.0, 1.0, len(particles))
    particles.write(lammps.path("box.data"), style=style)
    lammps(header(2, style=style) + "read_data box.data\n" + model("c4") + INTEGRATE + "run 100\n"
           "write_restart state.%.restart\n" + dump("whole.dump", 100) + "run 100\n", ranks=2)
    lammps("read_restart state.%.restart\n" + INTEGRATE + dump("parts.dump", 100) + "run 100\n", ranks=2)
    difference = np.abs(lammps.frame("whole.dump")["x"] - lammps.frame("parts.dump")["x"]).max()
    print(f"largest difference {difference:.2e}")
    assert difference < 1e-12


def test_a_restart_file_of_a_restarted_run(lammps):
    """What was read from a file is written to the next one unchanged, and may be overridden after reading."""
    lammps(start(lammps, "c4") + "run 10\nwrite_restart one.restart\n" + dump("one.dump") + "run 0\n")
    lammps("read_restart one.restart\n" + INTEGRATE + "write_restart two.restart\n")
    lammps("read_restart two.restart\n" + INTEGRATE + dump("two.dump") + "run 0\n")
    lammps("read_restart two.restart\n" + model("c6") + INTEGRATE + dump("other.dump") + "run 0\n")
    one, two, other = (lammps.frame(f"{name}.dump") for name in ("one", "two", "other"))
    assert relative(two["f"] - one["f"], one["f"]) < 1e-13
    assert relative(other["f"] - one["f"], one["f"]) > 1e-3


def test_run_continues_after_write_restart_as_without(lammps):
    text = start(lammps, "c4") + "run 100\n{}" + dump("{}") + "run 50\n"
    lammps(text.format("", "without.dump"))
    lammps(text.format("write_restart state.restart\n", "with.dump"))
    assert np.abs(lammps.frame("with.dump")["x"] - lammps.frame("without.dump")["x"]).max() < 1e-12


@pytest.mark.parametrize("name", SETTINGS)
def test_data_file_round_trip(lammps, name):
    """Particles, velocities and the coefficients of all type pairs survive write_data and read_data."""
    dim = SETTINGS[name][0]
    style = model(name).splitlines()[0] + "\n"
    lammps(start(lammps, name) + "run 20\nvelocity all scale 0.3\nwrite_data out.data pair ij\n" + dump("before.dump") + "run 0\n")
    lammps(header(dim) + style + "read_data out.data\n" + INTEGRATE + dump("after.dump") + "run 0\n")
    before, after = lammps.frame("before.dump"), lammps.frame("after.dump")
    for key in ("mass", "type", "esph"):
        np.testing.assert_array_equal(after[key], as_written(before[key]))
    np.testing.assert_array_equal(after["v"], before["v"])
    for key in ("f", "numden", "desph"):
        assert relative(after[key] - before[key], before[key]) < 1e-13, key


def test_data_file_with_coefficients_of_like_types_only(lammps):
    """write_data ... pair ii leaves unlike pairs to the mixing rule."""
    name = "lucy"
    style = model(name).splitlines()[0] + "\n"
    lammps(start(lammps, name) + "write_data out.data pair ii\n" + dump("before.dump") + "run 0\n")
    lammps(header(3) + style + "read_data out.data\n" + INTEGRATE + dump("after.dump") + "run 0\n")
    before, after = lammps.frame("before.dump"), lammps.frame("after.dump")
    assert relative(after["f"] - before["f"], before["f"]) < 1e-13


def test_unlike_viscosity_is_the_harmonic_mean(lammps):
    """The default for an unlike pair equals setting 2 mu1 mu2 / (mu1 + mu2), whatever the order of the lines."""
    disordered(2, 12, ntypes=2).write(lammps.path("box.data"))
    like = ["pair_coeff 1 1 1.0 10.0 0.5 2.0 3.0\n", "pair_coeff 2 2 1.1 12.0 0.2 2.0 3.0\n"]
    mean = f"mu {2 * 0.5 * 0.2 / 0.7}\n"
    texts = {"default": [*like], "last": [*like, "pair_coeff 1 2 " + mean], "first": ["pair_coeff 1 2 " + mean, *like],
             "swapped": [*like, "pair_coeff 2 1 " + mean], "other": [*like, "pair_coeff 1 2 mu 0.4\n"]}
    text = header(2) + "read_data box.data\n" + INTEGRATE
    for name, lines in texts.items():
        text += (fluid(2, coeff="".join(lines)) + dump(f"{name}.dump") + "run 0\n" + undump() + "pair_style none\n")
    lammps(text)
    forces = {name: lammps.frame(f"{name}.dump")["f"] for name in texts}
    for name in ("last", "first", "swapped"):
        assert relative(forces[name] - forces["default"], forces["default"]) < 1e-13, name
    assert relative(forces["other"] - forces["default"], forces["default"]) > 1e-4


# ---- a run that continues another one ----------------------------------------------------------------------------

IMPLICIT = "viscous implicit tolerance 1e-14 scheme"
CONTINUED = {
    "spins": ("sph/micropolar", "", "", "fix G all gravity 5.0 vector 0 -1 0\n"),
    "ideal": ("sph/bulk", "eos ideal", "", "set group all sph/e 100.0\n"),
    "shift": ("sph/bulk", "", "shift 0.1", ""),
    "walls": ("sph/micropolar", "", "", "fix W wall sph/wall velocity 0.3 0 0 move no\n"),
    "noise": ("sph/bulk", "limit yes temp 30.0 5", "", ""),
    "temperatures": ("sph/micropolar", "temp energy 20.0 5", "", "set group all sph/e 100.0\n"),
    "rkl2": ("sph/micropolar", "", "viscous rkl2", ""),
    "euler": ("sph/bulk", "", f"{IMPLICIT} euler", ""),
    "trapezoidal": ("sph/micropolar", "limit yes temp 30.0 5", f"{IMPLICIT} trapezoidal", ""),
}


def continued(lammps, name):
    style, options, keywords, extra = CONTINUED[name]
    particles = disordered(2, 12, spread=0.0)
    if style == "sph/micropolar":
        write_micropolar(particles, lammps.path("box.data"), omega=spins(particles, size=0.1))
    else:
        particles.write(lammps.path("box.data"))
    pair = micropolar_fluid(2, options) if style == "sph/micropolar" else fluid(2, options)
    return (header(2, style=style) + "read_data box.data\n" + pair + "region low block INF INF INF 2.9 INF INF\n"
            "group wall region low\ngroup fluid subtract all wall\n"
            f"fix FLUID {'fluid' if name == 'walls' else 'all'} {style} {keywords}\ntimestep 0.002\n{extra}")


@pytest.mark.parametrize("name", CONTINUED)
def test_short_runs_are_one_long_run(lammps, name):
    """Also the rest of it from a restart file, which has the extrapolated velocities and energies."""
    text = continued(lammps, name)
    last = lambda name: dump(name) + "run 0\n"
    lammps(text + "run 10\n" + last("one.dump"))
    lammps(text + "run 3\nwrite_data three.data\nrun 4\nrun 1\nwrite_restart eight.restart\nrun 1\nrun 1\n" + last("many.dump"))
    again = "".join(line + "\n" for line in text.splitlines() if line.startswith(("fix", "timestep")))
    lammps("read_restart eight.restart\n" + again + "run 2\n" + last("rest.dump"), ranks=2)
    one = lammps.frame("one.dump")
    for other in (lammps.frame("many.dump"), lammps.frame("rest.dump")):
        for field in ("x", "v", "vest", "esph", "f"):
            assert relative(other[field] - one[field], one[field]) < 1e-11, field


def test_another_velocity_starts_anew(lammps):
    text = start(lammps, "c4")
    lammps(text + "run 5\n" + dump("same.dump") + "run 0\n" + undump() + "velocity all scale 0.3\n" + dump("other.dump")
           + "write_restart other.restart\nrun 0\n")
    lammps("read_restart other.restart\n" + INTEGRATE + dump("read.dump") + "run 0\n")
    same, other, read = (lammps.frame(f"{name}.dump") for name in ("same", "other", "read"))
    assert relative(same["vest"] - same["v"], same["v"]) > 1e-4
    assert (other["vest"] == other["v"]).all() and (read["vest"] == read["v"]).all()


@pytest.mark.parametrize("keywords", ["viscous rkl2", IMPLICIT + " sdirk2"])
@pytest.mark.parametrize("change", ["velocity", "displace", "driven"])
def test_another_motion_of_a_wall_starts_anew(lammps, keywords, change):
    """Stiff friction with a wall that moves otherwise than in the last step: with the velocities of that step it would
    kick the fluid far beyond the wall."""
    particles = disordered(2, 12, spread=0.0)
    particles.write(lammps.path("box.data"))
    fix = f"fix FLUID fluid sph/bulk {keywords}\n"
    wall = lambda u: f"fix W wall sph/wall velocity {u} 0 0 move no\n"
    text = (header(2) + "read_data box.data\n" + fluid(2, mu=2000.0, kappa=4000.0) + "region low block INF INF INF 2.9 INF INF\n"
            "group wall region low\ngroup fluid subtract all wall\n" + fix + "timestep 0.002\n")
    if change == "velocity":
        before, after = wall(0.0), "unfix W\n" + wall(1.0)
    elif change == "driven":
        before, after = "", "velocity wall set 1 0 NULL units box\n"
    else:
        before, after = wall(1.0), "displace_atoms wall move 0.3 0 0 units box\n"
    lammps(text + before + "run 2\n" + after + "run 1\n" + dump("kept.dump") + "run 0\n")
    lammps(text + before + "run 2\n" + after + "unfix FLUID\n" + fix + "run 1\n" + dump("anew.dump") + "run 0\n")
    kept, anew = lammps.frame("kept.dump"), lammps.frame("anew.dump")
    assert relative(kept["v"] - anew["v"], anew["v"]) < 1e-6


@pytest.mark.parametrize("name, inertia", [*((name, None) for name in CONTINUED), ("temperatures", "inertia 0.1 0.0"), ("spins", "inertia 0.1 0.0"),
                                           ("rkl2", "inertia 0.1 0.0"), ("trapezoidal", "inertia 0.1 0.0")])
def test_run_0_is_no_part_of_a_run(lammps, name, inertia):
    """Energies, too, which are extrapolated within a step; also where the first forces find the inertia."""
    text = continued(lammps, name)
    if inertia:
        text = text.replace("fix FLUID all sph/micropolar", f"set group all d_inertia 0\nfix FLUID all sph/micropolar {inertia}")
    last = lambda name: dump(name) + "run 0\n"
    lammps(text + "run 3\n" + last("one.dump"))
    lammps(text + "run 0\nrun 0\nrun 3\n" + last("two.dump"))
    one, two = lammps.frame("one.dump"), lammps.frame("two.dump")
    for field in ("x", "v", "esph"):
        assert relative(two[field] - one[field], one[field]) < 1e-14, field


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("fix", ["sph/bulk", "sph/wall"])
@pytest.mark.parametrize("format, words", [(0.0, "an older"), (-9999.0, "a newer")])
def test_restart_data_of_another_format(lammps, fix, format, words, ranks):
    """The data of a fix begin with a number; what another version has written is refused."""
    disordered(2, 12, spread=0.0).write(lammps.path("box.data"))
    groups = "region low block INF INF INF 2.9 INF INF\ngroup wall region low\ngroup fluid subtract all wall\n"
    fixes = "fix F fluid sph/bulk\nfix W wall sph/wall rotate 6 6 0 0 0 1 0.1\ntimestep 0.001\n"
    lammps(header(2) + "read_data box.data\n" + fluid(2) + groups + fixes + "run 1\nwrite_restart state.restart\n")
    content = lammps.path("state.restart").read_bytes()
    place = content.find(np.float64({"sph/bulk": -1101.0, "sph/wall": -1002.0}[fix]).tobytes())
    assert place > 0
    lammps.path("other.restart").write_bytes(content[:place] + np.float64(format).tobytes() + content[place + 8:])
    result = lammps("read_restart other.restart\n" + fixes + "run 1\n", ranks=ranks, check=False, timeout=60)
    name = "FW"[fix == "sph/wall"]
    assert result.code and re.search(rf"Fix {fix}\S* {name}: the restart file was written by {words} version", result.error), result.error
    lammps("read_restart other.restart\n" + fixes.replace("fix F", "fix F2").replace("fix W", "fix W2") + "run 1\n", ranks=ranks)
