"""Where fix sph/wall finds its surface: the same on any number of ranks, wherever the wall is, and however often the
neighbor lists are built; walls with fluid on both sides, whose normals cancel; masses that do not fit."""

import re

import numpy as np
import pytest

from helpers import Lammps, relative

WALL = """
units lj
dimension 2
atom_style sph/bulk
atom_modify map array
lattice sq 1.0 origin 0.5 0.5 0
region box block 0 12 0 18 -0.5 0.5
create_box 1 box
create_atoms 1 box
reset_atoms id sort yes
set group all mass 1.0
{region}
group wall region wall
group fluid subtract all wall
displace_atoms fluid random 0.1 0.1 0 4711
velocity fluid create 1.0 12345 loop geom
pair_style sph/bulk
pair_coeff * * 1.0 10.0 0.5 2.0 {support}
timestep 0.005
fix 1 fluid sph/bulk
{before}
fix W wall sph/wall {keywords}
{neighbor}
run {steps}
write_dump all custom {name} id xu yu fx fy modify sort id format float %.17g
"""


def forces(lammps, name, region, support=3.0, before="", keywords="", neighbor="", steps=0, ranks=1):
    lammps(WALL.format(region=f"region wall {region}", support=support, before=before, keywords=keywords,
                       neighbor=neighbor, steps=steps, name=name), ranks=ranks)
    frame = lammps.frame(name)
    return np.column_stack([frame["fx"], frame["fy"]])


@pytest.mark.parametrize("ranks", [2, 4])
@pytest.mark.parametrize("region", ["block INF INF 8 11 INF INF", "block INF INF 7 12 INF INF", "block 5 8 8 11 INF INF",
                                    "cylinder z 6.5 9.5 2.2 INF INF", "cylinder z 6 9 2.9 INF INF",
                                    "block INF INF 8 9 INF INF"])
def test_fluid_on_both_sides(tmp_path, region, ranks):
    """Plates of three, five and one layers, posts and discs: the same forces on any number of ranks."""
    lammps = Lammps(tmp_path)
    one = forces(lammps, "one.dump", region)
    assert relative(forces(lammps, "many.dump", region, ranks=ranks) - one, one) < 1e-12


@pytest.mark.parametrize("region", ["block INF INF 8 11 INF INF", "block INF INF 8 9 INF INF",
                                    "cylinder z 6 9 3.2 INF INF"])
@pytest.mark.parametrize("support", [2.9, 3.0, 3.3])
def test_a_shift_of_everything_changes_nothing(tmp_path, region, support):
    """Lattice distances are those at which sums over neighbors end."""
    lammps = Lammps(tmp_path)
    here = forces(lammps, "here.dump", region, support)
    there = forces(lammps, "there.dump", region, support, before="displace_atoms all move 0.137 0.219 0")
    assert relative(there - here, here) < 1e-11


@pytest.mark.parametrize("support", [2.9, 3.0, 3.05])
def test_rotor_whatever_the_age_of_the_lists(tmp_path, support):
    lammps = Lammps(tmp_path)
    often, rarely = (forces(lammps, f"{every}.dump", "cylinder z 6 9 3.2 INF INF", support, keywords="rotate 6 9 0 0 0 1 0.8",
                            neighbor=f"neighbor 1.5 bin\nneigh_modify every {every} delay 0 check no", steps=40)
                     for every in (1, 200))
    assert relative(often - rarely, often) < 1e-9


@pytest.mark.parametrize("mass, warned", [(1.0, False), (0.85, False), (1.15, False), (1.5, True), (0.5, True), (0.05, True)])
def test_masses_of_walls_that_do_not_fit(tmp_path, mass, warned):
    lammps = Lammps(tmp_path)
    result = lammps(WALL.format(region="region wall block INF INF INF 3 INF INF", support=3.0,
                                before=f"set group wall mass {mass}", keywords="", neighbor="", steps=0, name="x.dump"),
                    ranks=2)
    found = [float(number) for line in result.warnings
             for number in re.findall(r"The masses of the wall of fix W sph/wall are (\S+) times rho0 of its type times the volume", line)]
    assert found == ([pytest.approx(mass, rel=0.05)] if warned else []), result.warnings
