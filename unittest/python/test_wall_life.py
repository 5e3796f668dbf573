"""fix sph/wall from its definition to its end: entry points other than run, restarts, groups, bad neighbours, first steps."""

import re

import numpy as np
import pytest

from helpers import lattice, relative
from test_wall import thin

FULL = "thermo_modify norm no format float %.17g\n"
WALL = "thermo_style custom step " + " ".join(f"f_{name}[{k}]" for name in "FL" for k in range(1, 7)) + "\n" + FULL
COLUMNS = [f"f_{name}[{k}]" for name in "FL" for k in range(1, 7)]
LID = "velocity 1 0 0"
LOW, WET, HIGH = slice(0, 36), slice(36, 180), slice(180, 216)  # floor, fluid and lid in the order of their IDs


def box(floor="", lid=LID, pair="pair_style sph/bulk\npair_coeff * * 1.0 10.0 0.5 2.0 3.0\n", style="sph/bulk",
        before="", types=1, integrate=True, inertia=None):
    """The vessel that all start from: floor, fluid displaced at random, lid."""
    return (f"units lj\ndimension 2\natom_style {style}\n{before}lattice sq 1.0 origin 0.5 0.5 0\n"
            f"region box block 0 12 0 18 -0.5 0.5\ncreate_box {types} box\ncreate_atoms 1 box\n"
            "set group all mass 1.0\nregion low block INF INF INF 3 INF INF\nregion high block INF INF 15 INF INF INF\n"
            "group floor region low\ngroup lid region high\ngroup fluid subtract all floor lid\n"
            "displace_atoms fluid random 0.1 0.1 0 4711\ntimestep 0.005\n" + pair
            + (f"fix 1 fluid {style} {inertia or ''}\nfix F floor sph/wall {floor}\nfix L lid sph/wall {lid}\n" if integrate else ""))


MICROPOLAR = dict(style="sph/micropolar", inertia="inertia 0.1 0.0",
                  pair="pair_style sph/micropolar\npair_coeff * * 1.0 10.0 0.5 2.0 0.3 0.05 -0.05 3.0\n")


def dump(name, every=1):
    return (f"dump D all custom {every} {name} id xu yu zu vx vy vz fx fy fz f_F[*]\n"
            "dump_modify D sort id format float %.17g\n")


def forces_on_walls(result):
    return [np.array([table[name] for name in COLUMNS]).T for table in result.thermo()]


# ---------------------------------------------------------------------------------------------
# rerun


@pytest.mark.parametrize("ranks", [1, 2])
def test_rerun_gives_the_forces_of_run_0(lammps, ranks):
    """Snapshot by snapshot, with walls that move and turn."""
    walls = dict(floor="velocity 0 v_U 0", lid="rotate 6 16 0 0 0 1 0.1 move no")
    variable = "variable U equal 0.2*step*dt\n"
    lammps(variable + box(**walls) + "dump D all custom 5 run.dump id x y z vx vy vz ix iy iz\n"
           "dump_modify D sort id format float %.17g\nrun 20\n")
    read = "run.dump {} x y vx vy ix iy box yes replace yes\n"
    rerun = lammps(variable + box(**walls) + WALL + "thermo 5\nrerun run.dump dump x y vx vy ix iy\n", ranks=ranks)
    single = [lammps(variable + box(**walls) + WALL + "read_dump " + read.format(step) + "run 0\n") for step in range(0, 25, 5)]
    (found,) = forces_on_walls(rerun)
    want = np.concatenate([forces_on_walls(result)[0] for result in single])
    assert len(found) == 5 and np.abs(want[:, 1]).min() > 1.0
    assert relative(found - want, want) < 1e-12


# ---------------------------------------------------------------------------------------------
# the point of rotate in restart files

TURN = "rotate 6 16 0 0 0 1 0.5 move no"


def stored_by(lammps, lid, steps=10):
    lammps(box(lid=lid) + f"run {steps}\nwrite_restart state.restart\n")


def continued(lammps, lid):
    """The walls go on with the restart file; the first frame."""
    lammps("read_restart state.restart\nfix 1 fluid sph/bulk\nfix F floor sph/wall\n"
           f"fix L lid sph/wall {lid}\ntimestep 0.005\n" + dump("out.dump") + WALL + "run 0\n")
    return lammps.frame("out.dump")


@pytest.mark.parametrize("stored", ["", "velocity 1 0 0", "velocity 1 0 0 move no", "rotate 2 17 0 0 0 1 0.5",
                                    "rotate 6 16 0 0 0 -1 0.5", "rotate 6 16 0 0 0 1 0.5 velocity 1 0 0"])
def test_point_of_the_input_beats_that_of_another_rotation(lammps, stored):
    """Wherever the wall of this ID turned before, if it did at all; only the same rotation goes on about the point that
    has travelled."""
    stored_by(lammps, stored)
    frame = continued(lammps, TURN)
    same = "rotate 6 16 0 0 0 1" in stored
    point = np.array([6.05 if "velocity" in stored and same else 6.0, 16.0, 0.0])
    want = np.cross([0, 0, 0.5], frame["x"][HIGH] - point)
    np.testing.assert_allclose(frame["v"][HIGH], want, rtol=0, atol=1e-13)


def test_wall_that_no_longer_turns(lammps):
    """Its torque is about the origin."""
    stored_by(lammps, TURN)
    frame = continued(lammps, "")
    (row,) = forces_on_walls(lammps.results[-1])
    torque = (frame["xu"] * frame["fy"] - frame["yu"] * frame["fx"])[HIGH].sum()
    assert row[0][11] == pytest.approx(torque, rel=1e-12)


def test_axis_is_compared_as_it_is_given(lammps):
    """Its length does not matter to the rotation, nor does it stop the point from being found again."""
    wall = "rotate 6 16 0 0 0 3 0.5 velocity 1 0 0"
    stored_by(lammps, wall)
    frame = continued(lammps, wall)
    want = [1, 0, 0] + np.cross([0, 0, 0.5], frame["x"][HIGH] - [6.05, 16.0, 0.0])
    np.testing.assert_allclose(frame["v"][HIGH], want, rtol=0, atol=1e-13)


# ---------------------------------------------------------------------------------------------
# minimization


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("style", ["sph/bulk", "sph/micropolar"])
@pytest.mark.parametrize("lid", [LID, "rotate 6 16 0 0 0 1 0.5", "velocity v_U 0 0"])
def test_walls_stand_still_in_a_minimization(lammps, lid, style, ranks):
    """Walls that move in a run exert the forces of walls at rest, and the minimizer moves the fluid only."""
    frames = {}
    for name, wall in (("moving", lid), ("rest", "")):
        lammps("variable U equal 0.3+3*step*dt\n" + box(lid=wall, **(MICROPOLAR if style != "sph/bulk" else {}))
               + "min_style fire\n" + dump(f"{name}.dump") + WALL + "minimize 0 1e-6 20 1000\n", ranks=ranks)
        frames[name] = lammps.frames(f"{name}.dump")
    moving, rest = (forces_on_walls(result)[0][0] for result in lammps.results)
    assert np.abs(rest[1]) > 1.0 and relative(moving[:3] - rest[:3], rest) < 1e-12
    first, last = frames["moving"][0], frames["moving"][-1]
    assert relative(first["f"][WET] - frames["rest"][0]["f"][WET], first["f"][WET]) < 1e-12
    assert (first["f"][LOW] == 0.0).all() and (first["f"][HIGH] == 0.0).all() and (last["v"][HIGH] == 0.0).all()
    assert first["f_F[2]"].sum() == pytest.approx(moving[1], rel=1e-12)
    moved = last["x"] - first["x"]
    assert (moved[LOW] == 0.0).all() and (moved[HIGH] == 0.0).all() and np.abs(moved[WET]).max() > 1e-3


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("lid", [LID, "slip free", "rotate 6 16 0 0 0 1 0.1 move no"])
@pytest.mark.parametrize("pb", [0.0, 3.0])
def test_forces_of_a_minimization_are_the_gradient_of_the_energy(lammps, lid, pb, ranks):
    """Energy of one particle next to the lid displaced by small steps against its force."""
    pair = f"pair_style sph/bulk\npair_coeff * * 1.0 10.0 0.5 2.0 3.0 pb {pb}\n"
    step, energy = 1e-4, []
    for k in (-2, -1, 1, 2, 0):
        result = lammps(box(lid=lid, pair=pair) + f"group one id 170\ndisplace_atoms one move {0.6 * k * step} {0.8 * k * step} 0\n"
                        + dump("out.dump") + "thermo_style custom step pe\n" + FULL + "minimize 0 0 0 0\n", ranks=ranks)
        energy.append(result.thermo()[0]["PotEng"][0])
    slope = (8 * (energy[2] - energy[1]) - (energy[3] - energy[0])) / (12 * step)
    force = lammps.frame("out.dump")["f"][169] @ [0.6, 0.8, 0.0]
    print(slope, force)
    assert np.abs(force) > 0.01
    assert slope == pytest.approx(-force, rel=1e-7)


@pytest.mark.parametrize("minimizer, tolerance", [("fire", 1e-6), ("cg", 1e-5)])
@pytest.mark.parametrize("pause", ["", "velocity fluid set 0 0 0\nrun 0\n"])
def test_minimization_after_a_run_converges(lammps, minimizer, tolerance, pause):
    """Viscous forces of the motion before have no place in it."""
    result = lammps(box() + f"run 100\n{pause}min_style {minimizer}\nmin_modify dmax 0.05\n" + WALL
                    + f"minimize 0 {tolerance} 20000 100000\nrun 10\n")
    assert "Stopping criterion = force tolerance" in result.log, re.findall("Stopping.*", result.log)


# ---------------------------------------------------------------------------------------------
# exclusions


ALL_FLUID = "pair_style sph/bulk\npair_coeff * * 1.0 10.0 0.5 2.0 3.0\nfix 1 all sph/bulk\n"


def as_fluid(lammps, text, ranks=1):
    """Energy and forces when all particles are fluid."""
    result = lammps(text + "thermo_style custom step pe\n" + FULL + "dump E all custom 1 all.dump id fx fy fz\n"
                    "dump_modify E sort id format float %.17g\nrun 0\n", ranks=ranks)
    return result.thermo()[-1]["PotEng"][-1], lammps.frame("all.dump")["f"]


def assert_same_fluid(one, other):
    assert one[0] == pytest.approx(other[0], rel=1e-12)
    assert relative(one[1] - other[1], other[1]) < 1e-11


REMOVE = "unfix 1\nunfix F\nunfix L\n"


@pytest.mark.parametrize("ranks", [1, 2])
def test_walls_made_fluid_interact(lammps, ranks):
    """Nothing of the fixes is left when they are gone."""
    fresh = as_fluid(lammps, box(integrate=False) + "fix 1 all sph/bulk\n")
    walls = box(lid="") + "run 0\n" + REMOVE
    assert_same_fluid(as_fluid(lammps, walls + "fix 1 all sph/bulk\n", ranks), fresh)


def test_exclusions_do_not_hit_the_group_that_takes_the_index(lammps):
    fresh = as_fluid(lammps, box(integrate=False) + "fix 1 all sph/bulk\n")
    text = (box(lid="") + "run 0\n" + REMOVE + "group floor delete\ngroup lid delete\ngroup fluid delete\n"
            "group new union all\ngroup other union all\ngroup third union all\nfix 1 all sph/bulk\n")
    assert_same_fluid(as_fluid(lammps, text), fresh)


def test_one_of_two_walls_made_fluid(lammps):
    """The exclusion between the two walls, too, goes with either."""
    for gone, name, stays in (("F", "floor", "L lid"), ("L", "lid", "F floor")):
        frames = []
        for before in (f"fix F floor sph/wall\nfix L lid sph/wall\nrun 0\nunfix {gone}\n", f"fix {stays} sph/wall\n"):
            text = (box(integrate=False) + "fix 1 fluid sph/bulk\n" + before + f"unfix 1\ngroup wet union fluid {name}\n"
                    "fix 1 wet sph/bulk\n" + ("" if gone in before else ""))
            frames.append(as_fluid(lammps, text.replace(f"fix {stays} sph/wall\nunfix 1", f"fix {stays} sph/wall\nunfix 1")))
        assert_same_fluid(*frames)


@pytest.mark.parametrize("where", ["before", "after"])
@pytest.mark.parametrize("exclusion", ["floor lid", "floor floor", "fluid fluid", "floor fluid"])
def test_exclusions_of_the_user_stay(lammps, where, exclusion):
    """Also if they are the same as those of the walls: when the particles of the walls have become fluid, their exclusion is an error."""
    user = f"neigh_modify exclude group {exclusion}\n"
    before, after = (user, "") if where == "before" else ("", user)
    walls = "fix F floor sph/wall\nfix L lid sph/wall\n"
    text = box(integrate=False) + "fix 1 fluid sph/bulk\n"
    if exclusion == "floor fluid":  # with this one there is no run with walls
        text += walls + "run 0\n" + after if where == "after" else before
    else:
        text += before + walls + "run 0\nrun 0\n" + after
    text += "unfix 1\n" + ("unfix F\nunfix L\n" if walls in text else "") + "fix 1 all sph/bulk\n"
    if exclusion != "fluid fluid" or where == "after":
        lammps(text)
    result = lammps(text + "run 0\n", check=False)
    assert result.code == 1 and "leaves out pairs of the fluid of type" in result.error, result.error


def test_exclude_none_does_no_harm(lammps):
    """Before any kind of run: the fix defines its exclusions anew, or the lists in use still have them."""
    for second in ("run 100\n", "run 100 pre no\n"):
        rows = []
        for none in ("", "neigh_modify exclude none\n"):
            result = lammps(box() + "neighbor 0.1 bin\n" + WALL + "run 20\n" + none + second)
            assert int(re.findall(r"Neighbor list builds = (\d+)", result.log)[-1]) > 0
            rows.append(forces_on_walls(result)[-1][-1])
        assert (rows[0] == rows[1]).all()


# ---------------------------------------------------------------------------------------------
# fix, pair style and groups come and go


def test_wall_of_another_group(lammps):
    """The same ID for other particles; those of before are fluid."""
    want = as_fluid(lammps, box(integrate=False) + "group wet union fluid floor\nfix 1 wet sph/bulk\nfix L lid sph/wall\n")
    text = box(integrate=False) + "fix 1 fluid sph/bulk\nfix F floor sph/wall\nfix L lid sph/wall\nrun 1\nunfix 1\nunfix F\n"
    text = text.replace("run 1", "run 0") + "unfix L\ngroup wet union fluid floor\nfix 1 wet sph/bulk\nfix F lid sph/wall\n"
    assert_same_fluid(as_fluid(lammps, text), want)


@pytest.mark.parametrize("commands", [
    "pair_style none\nunfix F\nunfix L\n",
    "pair_style zero 3.0\npair_coeff * *\nunfix F\nunfix L\nrun 1\n",
    "pair_style none\n" + MICROPOLAR["pair"].replace("micropolar", "bulk").replace(" 0.3 0.05 -0.05", "") + "run 5\n",
    "pair_style sph/bulk\npair_coeff * * 1.0 10.0 0.5 2.0 3.0\nrun 5\nunfix F\nfix F floor sph/wall\nrun 5\n",
    "clear\n", "clear\n" + box() + "run 5\n", "unfix F\nunfix L\nclear\n" + box() + "run 5\n"])
def test_pair_style_and_fix_come_and_go(lammps, commands):
    lammps(box() + "run 5\n" + commands)


@pytest.mark.parametrize("pair", ["pair_style none\n", "pair_style zero 3.0\npair_coeff * *\n"])
def test_run_without_the_pair_style(lammps, pair):
    result = lammps(box() + "run 5\n" + pair + "run 5\n", check=False)
    assert result.code == 1
    assert "requires pair style sph/bulk or sph/micropolar" in result.error


# ---------------------------------------------------------------------------------------------
# reading the results of the fix at any time


@pytest.mark.parametrize("ranks", [1, 2])
def test_force_on_each_particle_before_the_first_run(lammps, ranks):
    """And of particles that come later: zero, as long as there was none."""
    text = (box() + "write_dump all custom first.dump id f_F[1] f_F[6] modify sort id\n"
            "variable a atom f_F[1]\nset group all sph/e v_a\n"
            "change_box all y final 0 200\nregion above block INF INF 20 INF INF INF\ncreate_atoms 1 region above\n"
            "set group all mass 1.0\nwrite_dump all custom second.dump id f_F[1] f_F[6] modify sort id\n"
            "variable b atom f_F[2]+f_L[2]\ngroup heavy variable b\n")
    lammps(text, ranks=ranks)
    for name, number in (("first.dump", 216), ("second.dump", 216 + 12 * 180)):
        frame = lammps.frame(name)
        assert len(frame["id"]) == number
        assert (frame["f_F[1]"] == 0.0).all() and (frame["f_F[6]"] == 0.0).all()


@pytest.mark.parametrize("ranks", [1, 4])
def test_force_stays_with_its_particle(lammps, ranks):
    """When particles are deleted, sorted or sent to other ranks between runs."""
    text = (box() + "run 5\n" + dump("one.dump") + "run 0\nundump D\nbalance 1.0 shift xy 10 1.01\n"
            "group gone id 80:90\ndelete_atoms group gone compress no\n"
            "write_dump all custom two.dump id yu f_F[*] modify sort id format float %.17g\n")
    lammps(text, ranks=ranks)
    one, two = lammps.frame("one.dump"), lammps.frame("two.dump")
    kept = np.isin(one["id"], two["id"])
    for k in range(1, 7):
        assert (one[f"f_F[{k}]"][kept] == two[f"f_F[{k}]"]).all()
    low = two["yu"] < 3
    assert np.abs(two["f_F[2]"][low]).max() > 0.0 and (two["f_F[2]"][~low] == 0.0).all()


# ---------------------------------------------------------------------------------------------
# time step zero


@pytest.mark.parametrize("floor", ["", "velocity 0 v_U 0", "rotate 6 1 0 0 0 1 v_U"])
def test_time_step_zero(lammps, floor):
    """Nothing moves, and the forces are those of the start."""
    result = lammps("variable U equal 0.1*step\n" + box(floor) + WALL + "timestep 0\nthermo 1\nrun 3\n")
    (rows,) = forces_on_walls(result)
    assert np.isfinite(rows).all()
    if not floor:
        assert relative(rows - rows[0], rows) < 1e-12


# ---------------------------------------------------------------------------------------------
# a wall that nothing feels

TWO = dict(types=2)
SPH, LJ = "sph/bulk 1.0 10.0 0.5 2.0 3.0", "lj/cut 1.0 1.0 2.5"
HYBRID = f"pair_style hybrid sph/bulk lj/cut 2.5\npair_coeff 1 1 {SPH}\n"
BOTH = f"pair_style sph/bulk\npair_coeff * * {SPH[9:]}\n"
SOLID = "set group floor type 2\nset group lid type 2\n"
FLOOR = "set group floor type 2\n"


def walls_of(pair, types, extra="", types_number=2, before=""):
    text = box(integrate=False, types=types_number, pair="", before=before)
    return (text + types + pair + "fix 1 fluid sph/bulk\nfix F floor sph/wall\nfix L lid sph/wall\n" + extra + "run 1\n")


APART = "does not interact with the wall of fix F sph/wall"


UNFELT = {
    "no coefficients": (walls_of(HYBRID + f"pair_coeff * 2 {LJ}\n", FLOOR), "wall of fix F sph/wall has particles of type 2"),
    "hybrid": (walls_of(HYBRID + f"pair_coeff 2 2 {SPH}\npair_coeff 1 2 {LJ}\n", FLOOR), APART),
    "hybrid none": (walls_of(HYBRID.replace(" lj/cut 2.5", "") + f"pair_coeff 2 2 {SPH}\npair_coeff 1 2 none\n", FLOOR), APART),
    "hybrid/overlay": (walls_of(HYBRID.replace("hybrid", "hybrid/overlay").replace("lj/cut 2.5", "zero 3.0")
                                + f"pair_coeff 2 2 {SPH}\npair_coeff 1 2 zero\n", FLOOR), APART),
    "exclude type": (walls_of(BOTH, FLOOR, "neigh_modify exclude type 1 2\n"), APART),
    "exclude group": (walls_of(BOTH, "", "neigh_modify exclude group fluid floor\n"), APART),
    "exclude all": (walls_of(BOTH, "", "neigh_modify exclude group floor all\n"), APART),
    "include": (walls_of(BOTH, "", "atom_modify first fluid\nneigh_modify include fluid\n"), APART),
}


@pytest.mark.parametrize("text, message", UNFELT.values(), ids=UNFELT)
@pytest.mark.parametrize("ranks", [1, 2])
def test_wall_that_the_fluid_does_not_feel(lammps, text, message, ranks):
    result = lammps(text, ranks=ranks, check=False, timeout=60)
    assert result.code == 1, result.output[-2000:]
    assert message in result.error, result.error


def test_wall_that_a_part_of_the_fluid_does_not_feel(lammps):
    """May be meant: a warning, once."""
    types = "region half block INF 6 5 13 INF INF\ngroup other region half\nset group other type 2\n"
    result = lammps(walls_of(BOTH, types, "neigh_modify exclude group other floor\n", before="") + "run 1\n")
    (line,) = [line for line in result.warnings if APART in line]
    assert "of type 2" in line


FELT = {
    "types": walls_of(BOTH, SOLID),
    "hybrid": walls_of(HYBRID.replace(" lj/cut 2.5", "") + f"pair_coeff 2 2 {SPH}\n", SOLID),
    "exclusions among walls": walls_of(BOTH, SOLID, "neigh_modify exclude type 2 2\nneigh_modify exclude group floor lid\n"),
    "no fluid": walls_of(BOTH, SOLID, "delete_atoms group fluid\n"),
}


@pytest.mark.parametrize("text", FELT.values(), ids=FELT)
@pytest.mark.parametrize("ranks", [1, 2])
def test_no_false_alarm_about_walls_nobody_feels(lammps, text, ranks):
    result = lammps(text, ranks=ranks)
    assert not [line for line in result.warnings if "interact" in line], result.warnings


@pytest.mark.parametrize("ranks", [1, 2])
def test_wall_moved_by_another_fix_without_atom_ids(lammps, ranks):
    text = box(before="atom_modify id no\n").replace("fix 1 fluid", "fix 1 all")
    result = lammps(text + "run 1\n", ranks=ranks, check=False)
    assert result.code == 1
    assert "of the wall of fix F sph/wall is also moved by fix 1 sph/bulk" in result.error, result.error


# ---------------------------------------------------------------------------------------------
# acceleration at the start of a run


def wall_force(lammps, variable, commands, floor="velocity 0 v_U 0", before=""):
    result = lammps(before + f"variable U equal {variable}\n" + box(floor, lid="") + WALL + "thermo 1\n" + commands)
    return forces_on_walls(result)


@pytest.mark.parametrize("commands", ["run 0\n", "run 3\n", "run 0\nrun 0\n", "run 2\nrun 2\n", "reset_timestep 7\nrun 0\n"])
def test_accelerating_wall_at_the_start_of_a_run(lammps, commands):
    """The pressure in the wall is that of its acceleration in every step, also of the first: with a velocity of zero there,
    it is that of the body force which is equal to it in the frame of the wall."""
    start = "7*0.005" if "reset" in commands else "0.0"
    rows = wall_force(lammps, f"3.0*(step*dt-{start})", commands)
    # the same wall at rest, with the acceleration as gravity of the other sign
    (like,) = wall_force(lammps, "0.0", "run 0\n", floor="gravity 0 -3.0 0")
    (rest,) = wall_force(lammps, "0.0", "run 0\n", floor="")
    print("with acceleration", rows[0][0][1], "gravity", like[0][1], "at rest", rest[0][1])
    assert np.abs(like[0][1] - rest[0][1]) > 1.0
    assert relative(rows[0][0] - like[0], like) < 1e-10
    if commands == "run 0\nrun 0\n":
        assert relative(rows[1][0] - rows[0][0], like) < 1e-10
    if commands == "run 2\nrun 2\n":  # extrapolated velocities differ, the acceleration does not
        assert relative(rows[1][0] - rows[0][2], like) < 0.01


@pytest.mark.parametrize("variable, order", [("0.4*sin(20*step*dt)", 2), ("0.3*(step*dt)^2", None), ("ramp(0.0,1.0)", None)])
def test_start_of_a_run_continues_the_series(lammps, variable, order):
    """Force at the start of a second run against that at the end of the first: what is left is of second order."""
    jumps = []
    for halve in (1, 2):
        steps = 10 * halve
        rows = wall_force(lammps, variable, f"timestep {0.005 / halve}\nvelocity fluid set 0 0 0\n"
                          f"run {steps} start 0 stop {2 * steps}\nrun 0 start 0 stop {2 * steps}\n", floor="velocity v_U 0 0 gravity 0 0 0")
        jumps.append(np.abs(rows[1][0] - rows[0][-1]).max())
    print("jumps", jumps)
    assert jumps[1] < 0.35 * jumps[0] or max(jumps) < 1e-9


@pytest.mark.parametrize("before, after", [(1, 2), (2, 1)])
def test_accelerating_wall_after_a_restart(lammps, before, after):
    """Equals a second run command in the script that wrote the file; the variable is all there is to know."""
    variable = "variable U equal 0.4*sin(20*step*dt)\nvariable O equal 0.1*cos(10*step*dt)\n"
    walls = dict(floor="velocity 0 v_U 0", lid="rotate 6 16 0 0 0 1 v_O velocity v_U 0 0")
    fixes = f"fix 1 fluid sph/bulk\nfix F floor sph/wall {walls['floor']}\nfix L lid sph/wall {walls['lid']}\ntimestep 0.005\n"
    table = WALL + "thermo 1\n"
    want = forces_on_walls(lammps(variable + box(**walls) + table + "run 10\nwrite_restart state.restart\nrun 10\n",
                                  ranks=before))[-1]
    (found,) = forces_on_walls(lammps(variable + "read_restart state.restart\n" + fixes + table + "run 10\n", ranks=after))
    assert relative(found - want, want) < 1e-11


def test_ramp_in_a_run_of_no_steps(lammps):
    """It has no slope there."""
    (ramp,) = wall_force(lammps, "ramp(0.5,1.0)", "run 0\n")
    (constant,) = wall_force(lammps, "0.5", "run 0\n")
    assert relative(ramp - constant, constant) < 1e-13


def test_wall_moved_by_what_the_particles_do(lammps):
    """Its velocity in steps to come is not known: computes are not asked for it, and its rate stays that of the last step
    (without it, the force would be -128).  The compute gives the value of mid-step in a run, that of the end between."""
    text = ("variable U equal 0.02*c_KE\n" + box("velocity 0 v_U 0", lid="") + "compute KE fluid ke\n"
            "velocity fluid create 1.0 4711\nthermo 1\nthermo_style custom step c_KE f_F[2]\n" + FULL)
    one = lammps(text + "run 10\n").thermo()[0]
    two = lammps(text + "run 5\nrun 5\n").thermo()
    np.testing.assert_allclose(two[0]["f_F[2]"], one["f_F[2]"][:6], rtol=1e-12)
    assert two[1]["f_F[2]"][0] == pytest.approx(one["f_F[2]"][5], abs=2.0)


def test_wall_moved_by_the_force_on_it(lammps):
    """Between runs, the force is that of the last step, and so is the rate of the velocity."""
    text = ("variable U equal -0.001*f_F[2]\n" + box("velocity 0 v_U 0", lid="") + WALL + "thermo 1\n")
    one = forces_on_walls(lammps(text + "run 10\n"))[0]
    two = forces_on_walls(lammps(text + "run 5\nrun 5\n"))
    assert relative(two[0] - one[:6], one) < 1e-12
    assert np.isfinite(two[1]).all()


# ---------------------------------------------------------------------------------------------
# the table of the first run


def acoustic_step(result):
    return float(re.search(r"^ *1-1 .*\| +(\S+)", result.log, re.MULTILINE)[1])


@pytest.mark.parametrize("lid", ["velocity 20 0 0 move no", "rotate 6 16 0 0 0 1 3.0 move no"])
def test_walls_count_in_the_first_table(lammps, lid):
    steps = [acoustic_step(lammps(box(lid=wall) + "timestep 0.0001\nrun 0\n")) for wall in ("", lid)]
    speed = 20.0 if "velocity" in lid else 3.0 * np.hypot(5.5, 1.5)
    assert steps[0] / steps[1] == pytest.approx(1.0 + speed / 10.0, rel=5e-4)  # four digits in the table


# ---------------------------------------------------------------------------------------------
# pores


def pore(dim, support, length, wet):
    """A solid with the particles marked by wet(x, y, z) as fluid."""
    thick = int(np.ceil(support))
    cells = [2 * thick + 1] * (dim - 1) + [length]
    particles = lattice(dim, cells)
    x = particles.x - 0.5
    mask = wet(*(x[:, d] - (thick if d < dim - 1 else 0) for d in range(dim)))
    ids = np.flatnonzero(mask) + 1
    return particles, ids


def pore_text(dim, ids, support, commands):
    number = " ".join(map(str, ids))
    return (f"units lj\ndimension {dim}\natom_style sph/bulk\nread_data box.data\ngroup fluid id {number}\n"
            "group solid subtract all fluid\nset group all mass 1.0\npair_style sph/bulk\n"
            f"pair_coeff * * 1.0 10.0 0.5 2.0 {support}\nfix 1 fluid sph/bulk\nfix F solid sph/wall\ntimestep 0.01\n" + commands)


SHAPES = {2: {"slit": lambda x, y: x == 0, "hole": lambda x, y: (x == 0) & (y == 3)},
          3: {"tube": lambda x, y, z: (x == 0) & (y == 0), "slit": lambda x, y, z: x == 0,
              "hole": lambda x, y, z: (x == 0) & (y == 0) & (z == 3)}}


@pytest.mark.parametrize("dim, shape, support", [(2, "slit", 3.0), (2, "hole", 3.0), (2, "slit", 6.0), (2, "hole", 6.0),
                                                 (3, "tube", 2.5), (3, "hole", 2.5), (3, "tube", 4.0), (3, "slit", 4.0),
                                                 (3, "hole", 4.0), (3, "tube", 5.5), (3, "hole", 5.0)])
def test_pore_one_particle_wide(lammps, dim, shape, support):
    """At any support radius its particles are where they belong, also when they are pushed about."""
    particles, ids = pore(dim, support, 2 * int(np.ceil(support)) + 2, SHAPES[dim][shape])
    particles.write(lammps.path("box.data"))
    push = "displace_atoms fluid random 0.2 0.2 {} 4711\nrun 20\n".format(0.0 if dim == 2 else 0.2)
    lammps(pore_text(dim, ids, support, "run 0\n" + push))


@pytest.mark.parametrize("dim, support", [(2, 3.0), (2, 6.0), (3, 2.5), (3, 5.0)])
@pytest.mark.parametrize("lone", [False, True])
@pytest.mark.parametrize("ranks", [1, 2])
def test_particle_inside_a_wall_of_a_large_support(lammps, dim, support, lone, ranks):
    """Between its particles; with the fluid above, or alone in front of a dry wall."""
    layers = int(np.ceil(support))
    cells = [2 * layers + 2] * (dim - 1) + [4 * layers]
    particles = lattice(dim, cells)
    height = particles.x[:, dim - 1]
    wet = height > layers
    particles.x[-1, :dim] = [layers + 1.0] * (dim - 1) + [np.floor(0.5 * layers)]
    ids = [len(particles)] if lone else np.flatnonzero(wet) + 1
    if lone:
        keep = ~wet
        keep[-1] = True
        particles = particles.where(keep)
        ids = [len(particles)]
    particles.write(lammps.path("box.data"))
    text = pore_text(dim, ids, support, "run 0\n").replace("read_data", f"boundary {'p f p' if dim == 2 else 'p p f'}\nread_data")
    result = lammps(text, ranks=ranks, check=False)
    assert result.code == 1
    assert re.search(rf"Particle {ids[-1]} of the fluid .*inside a wall", result.error), result.error or result.output[-500:]


def test_thin_is_what_it_was(lammps):
    """The fix checks the thickness in the first run only."""
    assert len(thin(lammps(box() + "run 0\nrun 0\n"))) == 0


NOISE = """
units lj
dimension 2
atom_style sph/bulk
atom_modify map array
lattice sq 1.0 origin 0.5 0.5 0
region box block 0 10 0 14 -0.5 0.5
create_box 1 box
create_atoms 1 box
set group all mass 1.0
region wall block INF INF 0 4 INF INF
group wall region wall
group fluid subtract all wall
region gone block INF INF 12 14 INF INF
group gone region gone
displace_atoms fluid random 0.1 0.1 0 4711
pair_style sph/bulk temp energy 1000.0 77
pair_coeff * * 1.0 10.0 0.5 2.0 3.0 cv 10.0 conductivity 1.0 pb 20
fix 1 fluid sph/bulk temperature 2.0
fix W wall sph/wall
compute T all property/atom tsph
timestep 0.001
run 5
"""


@pytest.mark.parametrize("ranks", [1, 2])
def test_temperatures_after_a_deletion(lammps, ranks):
    """With temp energy a wall holds a part of the energy of the fluid next to it, which belongs to particles, not places in an array."""
    write = "write_dump fluid custom {}.dump id c_T modify sort id format float %.17g\n"
    lammps(NOISE + write.format("before"), ranks=ranks)
    lammps(NOISE + "group some id 50:60\ndelete_atoms group some compress no\n" + write.format("after"), ranks=ranks)  # computes keep values of a step
    before, after = lammps.frame("before.dump"), lammps.frame("after.dump")
    left = np.isin(before["id"], after["id"])
    assert left.sum() == len(left) - 11
    assert np.abs(after["c_T"] - before["c_T"][left]).max() < 1e-12
