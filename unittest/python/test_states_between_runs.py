"""What becomes of the states of particles where a command changes particles between two runs: the table of the page of
atom_style sph/bulk, cell by cell."""

import re
from pathlib import Path

import numpy as np
import pytest

from helpers import Result, dump, relative, undump
from test_life import library

PAGE = Path(__file__).resolve().parents[2] / "doc" / "src" / "atom_style_sph_bulk.rst"
COLUMNS = ("density", "energy", "relaxed", "tvib", "solute", "spin", "extrapolated")
WORDS = {"density": "sph/rho", "energy": "sph/e", "relaxed": "d_rho_relaxed1", "tvib": "d_tvib", "solute": "d_solute", "spin": "omega"}
NUMBER = 100    # particles

# the commands of the table, for a fluid of 10 x 10 spacings, of which snapshots have been written

READ = "read_dump snap.dump 0 x y vx vy"
COMMANDS = {
    "displace_atoms": ("displace_atoms all ramp x 0 0.5 y 0 10", "displace_atoms all random .01 .01 0 5", "displace_atoms some move .3 0 0",
                       "displace_atoms some rotate 5 5 0 0 0 1 3"),
    "set x": ("variable X atom 1.01*x\nset group all x v_X",),
    "change_box ... remap": ("change_box all x scale .98 y scale .97 remap",),
    "change_box without remap": ("change_box all x final 0 12", "change_box all boundary f p p"),
    "velocity": ("velocity all set .1 NULL NULL",),
    "set vx": ("set group all vx .1",),
    "set omega": ("set group all omega 0 0 .3",),
    "set mass": ("set group all mass 1.01",),
    "set type": ("set group all type 2",),
    "set sph/rho": ("set group all sph/rho 1.01",),
    "sph/e": ("set group all sph/e 12",),
    "d_rho_relaxed1": ("set group all d_rho_relaxed1 1.02",),
    "d_tvib": ("set group all d_tvib 1.5",),
    "d_solute": ("set group all d_solute 0.25",),
    "read_dump with positions, velocities": (READ, READ + " box no timestep no", "read_dump snap.dump 0 x y"),
    "read_dump ... trim yes": ("read_dump some.dump 0 x y vx vy trim yes",),
    "read_dump ... add yes": ("group few id 1:5\ndelete_atoms group few compress no\nread_dump snap.dump 0 x y vx vy add keep",),
    "purge yes add yes": ("read_dump snap.dump 0 x y vx vy replace no purge yes add yes",),
    "delete_atoms": ("group few id 1:5\ndelete_atoms group few compress no",),
    "create_atoms": ("create_atoms 1 single 5.1 5.2 0\ngroup new id 101\nset group new mass 1",),
    "read_data ... add append": ("write_data more.data nocoeff\nread_data more.data add append",),
    "replicate": ("replicate 2 1 1",),
    "reset_atoms id": ("reset_atoms id sort yes",),
    "set image": ("set group all image 1 -1 NULL",),
    "minimize": ("minimize 0 0 3 3",),
    "positions by the library": ("x",),
    "velocities by the library": ("v",),
}


def table():
    """(command, column, cell) of the page"""
    text = re.search(r"^\.\. _sph_between_runs:$.*?\.\. list-table::(.*?)^\S", PAGE.read_text(), re.M | re.S)[1]
    rows = [re.sub(r"\*", "", row).splitlines() for row in text.split("\n   * - ")[2:]]
    for first, *cells in rows:
        cells = [cell.strip().removeprefix("- ") for cell in cells if cell.strip()]
        assert len(cells) == len(COLUMNS), first
        for command in re.split(r"[;,] (?!velocities$)", first):
            yield command, dict(zip(COLUMNS, cells))


TABLE = dict(table())
HEAD = ("units lj\ndimension 2\natom_style {}\natom_modify map array sort 0 0\nlattice sq 1.0 origin .5 .5 0\nregion box block 0 10 0 10 -.5 .5\n"
        "create_box 2 box\ncreate_atoms 1 box\nset group all mass 1\ndisplace_atoms all random .1 .1 0 1234\nvelocity all create .01 123\n"
        "timestep 0.01\ngroup some id 1:90\ndump snap all custom 100 snap.dump id type x y vx vy\n"
        "dump some some custom 100 some.dump id type x y vx vy\n")
FLUIDS = {
    "liquid": HEAD.format("sph/micropolar rho relax 1 solute") + "set group all d_solute 0.5 omega 0 0 .1\n"
              "pair_style sph/micropolar density continuity tension yes delta 0.1\n"
              "pair_coeff * * 1 10 .1 .3 .1 .1 -.1 2.7 relax 1 .1 solute .1 cv 10 conductivity .1\n"
              "fix 1 all sph/micropolar inertia 0.1 0 temperature 1.0\n",
    "gas": HEAD.format("sph/bulk relax 1") + "pair_style sph/bulk eos ideal\nset group all sph/e 100\n"
           "pair_coeff * * 1 10 .1 .3 2.7 gamma 1.4 cv 10 vibration 5 1\nfix 1 all sph/bulk\n",
}
EXTRA = {"liquid": "d_rho_sum d_rho_relaxed1 d_solute omegaz", "gas": "d_tvib"}
STATES = {"liquid": {"density": "rho", "energy": "esph", "relaxed": "d_rho_relaxed1", "solute": "d_solute", "spin": "omegaz"},
          "gas": {"energy": "esph", "tvib": "d_tvib"}}


def run(lammps, fluid, command):
    """Result, and the frames before and after the command, or None after an error."""
    before, after = (dump(name, extra=EXTRA[fluid]) + "run 0\n" + undump() for name in ("before.dump", "after.dump"))
    text = FLUIDS[fluid] + "run 3\nundump snap\nundump some\n" + before
    if command in ("x", "v"):
        library(lammps, f"""
            one = Instance()
            one({text!r})
            moved = (ctypes.c_double * 300)(*(1.01 * one.array({command!r})[np.argsort(one.integers("id"))]).ravel())
            lib.lammps_scatter_atoms(one.handle, b"{command}", 1, 3, moved)
            one("log after.log")
            one({after!r})
            one.close()
            """)
        result = Result(0, "", lammps.path("after.log").read_text())
    else:
        result = lammps(text + "log after.log\n" + command + "\n" + after, ranks=2 if fluid == "liquid" else 1, check=False)
        result.log = lammps.path("after.log").read_text()
    return result, lammps.frame("before.dump"), None if result.code else lammps.frame("after.dump")


def pairs(command, before, after):
    """Indices of each particle before and after the command."""
    if command.startswith("reset_atoms id"):    # the same places
        return [np.lexsort(np.round(frame["x"].T, 9)) for frame in (before, after)]
    same = (after["id"] - 1) % NUMBER + 1 if command.startswith("replicate") else after["id"]
    kept = np.isin(same, before["id"])
    return np.searchsorted(before["id"], same[kept]), np.flatnonzero(kept)


def test_each_command_is_in_the_table():
    assert set(TABLE) == set(COMMANDS)


@pytest.mark.parametrize("name, command, fluid", [(name, command, fluid) for name, commands in COMMANDS.items() for command in commands
                                                  for fluid in FLUIDS])
def test_cell(lammps, name, command, fluid):
    if (name, fluid) in {("set sph/rho", "gas"), ("set omega", "gas"), ("d_tvib", "liquid"), ("d_rho_relaxed1", "gas"), ("d_solute", "gas")}:
        pytest.skip("it has no such state")
    cells = TABLE[name]
    result, before, after = run(lammps, fluid, command)
    if "error" in (cells["tvib" if fluid == "gas" else "solute"]):
        assert result.code == 1 and re.search("mass must be > 0|minimization", result.error), result.output[-2000:]
        return
    assert result.code == 0, result.output[-2000:]
    told = re.findall(r"commands have changed .* after the last run, but (.*) stay as they are", result.log)
    assert len(told) <= 1
    told = set(told[0].split(", ")) if told else set()
    old, new = pairs(command, before, after)
    assert len(old) >= 0.9 * NUMBER
    for state, field in STATES[fluid].items():
        one, other = before[field][old], after[field][new]
        word, *warning = cells[state].split(", ")
        assert (WORDS[state] in told) == bool(warning), (state, told)
        told.discard(WORDS[state])
        if word == "follows":
            change = after["d_rho_sum"][new] - before["d_rho_sum"][old]
            assert np.abs(change).max() > 1e-4 and relative(other - one - change, one) < 1e-14, state
        elif word == "set" and WORDS[state] in command:
            assert (other == float(command.split()[-1])).all(), state
        elif word == "no strain":
            assert (other == after["rho"][new]).all()
        elif word == "set" and "set omega" in command:
            assert (other == 0.3).all()
        else:
            assert word in ("stays", "copied", "set") and relative(other - one, one) < 1e-14, (state, word)
    assert not told
    anew = (after["vest"][new] == after["v"][new]).all()
    same = (after["vest"][new] == before["vest"][old]).all()
    assert {"anew": anew, "goes on": same and not anew}[cells["extrapolated"]]


# ---------------------------------------------------------------------------------------------
# numbers


LATTICE = ("units lj\ndimension 2\natom_style sph/bulk\natom_modify map array\nlattice sq 1.0 origin .5 .5 0\nregion box block 0 12 0 12 -.5 .5\n"
           "create_box 1 box\ncreate_atoms 1 box\nset group all mass 1\n{}pair_style sph/bulk density continuity {} tension yes\n"
           "pair_coeff * * 1 10 .1 .3 2.7\nfix 1 all sph/bulk\ntimestep 0.01\n")
FLOW = "displace_atoms all random .1 .1 0 1234\nvelocity all create .01 123\n"
DEFORM = {"change_box": "change_box all x scale .98 y scale .98 remap\n",
          "displace_atoms": "displace_atoms all ramp x 0 -.24 x 0 12 units box\ndisplace_atoms all ramp y 0 -.24 y 0 12 units box\n"
                            "change_box all x final 0 11.76 y final 0 11.76\n"}


@pytest.mark.parametrize("between", ["", "unfix 1\nfix 1 all sph/bulk\n", "write_restart a.restart\nclear\nread_restart a.restart\nfix 1 all sph/bulk\n"],
                         ids=["", "another fix", "restart"])
@pytest.mark.parametrize("change", DEFORM)
def test_a_deformation_is_one_of_the_density(lammps, change, between):
    """As fix deform does it; also where the integrator is another one by then, or a restart file comes in between."""
    write = "compute P all property/atom rho\ndump D all custom 100 {} id c_P\ndump_modify D sort id format float %.17g\nrun {}\n"
    lammps(LATTICE.format("", "delta 0") + "fix D all deform 1 x scale .98 y scale .98 remap x\ntimestep 1e-6\n" + write.format("deform.dump", 100))
    result = lammps(LATTICE.format("", "delta 0") + "run 0\n" + DEFORM[change] + between + write.format("a.dump", 0))
    rho, deformed = lammps.frame("a.dump")["c_P"], lammps.frame("deform.dump")["c_P"]
    assert np.ptp(rho) < 1e-13 and np.abs(rho - deformed.mean()).max() < 1e-3 and rho[0] > 1.04    # its last step lacks a hundredth
    assert not result.warnings


THERMO = "thermo_style custom step pe ke\nthermo_modify norm no format float %.16g\nthermo 10\n"
BY_VELOCITY = ("read_dump a.dump 0 x y vx label vx c_P\nvariable density atom vx\nset group all sph/rho v_density\n")


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("options, read, told", [("delta 0", "", False), ("", BY_VELOCITY, False), ("", "", True)])
def test_a_run_repeats_from_its_snapshot(lammps, options, read, told, ranks):
    """Offsets stay without diffusion; otherwise the snapshot must have the densities."""
    result = lammps(LATTICE.format(FLOW, options) + THERMO + "compute P all property/atom rho\ndump D all custom 50 a.dump id type x y vx vy c_P\n"
                    "dump_modify D format float %.17g\nrun 50\nundump D\n" + read + "read_dump a.dump 0 x y vx vy\nrun 50\n", ranks=ranks)
    first, second = result.thermo()
    for name in ("PotEng", "KinEng"):
        assert (relative(second[name] - first[name], first[name]) < 1e-11) != told, name
    assert [re.search(r"positions, velocities after the last run, but (.*) stay as", line)[1] for line in result.warnings] == ["sph/rho"] * told


def test_a_drop_that_is_put_on_another_place(lammps):
    """Its border loses neighbors: a warning, and the way to begin anew."""
    base = LATTICE.format("", "") + "region half block INF 6 INF INF INF INF\ngroup half region half\nrun 0\nchange_box all x final 0 40\n"
    result = lammps(base + "run 0\ndisplace_atoms half move 15 0 0\nrun 0\n")
    (line,) = result.warnings
    number = int(re.search(r"densities of (\d+) of them by more than 0.1 rho0", line)[1])
    assert number == 2 * 12    # the layers beside the gap
    result = lammps(base + "displace_atoms half move 15 0 0\nset group all sph/rho 0\n" + dump("a.dump") + "run 0\n")
    assert not result.warnings and (lammps.frame("a.dump")["rho"] == 1.0).all()
