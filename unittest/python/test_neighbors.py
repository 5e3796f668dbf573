"""The neighbor list of the package has the pairs of LAMMPS's own, which *neighbor nsq* makes, wherever a list is needed."""

import numpy as np
import pytest

from helpers import INTEGRATE, SUPPORT, SWITCHES, disordered, dump, fluid, free, header, lattice, relative

pytestmark = pytest.mark.skipif(bool(SWITCHES), reason="with KOKKOS, the neighbor list is that of KOKKOS")

SMALL = disordered(3, (6, 7, 5), ntypes=3)        # hardly longer than twice the reach: neighbors are images, some twice
CUBE = disordered(3, (9, 10, 11), jitter=0.5, ntypes=3)
TILTED = disordered(3, (9, 9, 9), ntypes=3, tilt=(3.0, -2.0, 2.5))
PLANE = disordered(2, (30, 20), jitter=0.5, ntypes=3)
LINE = disordered(1, 60, ntypes=3)
EXACT = lattice(3, 10)                            # many pairs as far from each other as the list reaches: 2.5 and a skin of 0.5
CORNER = CUBE.where(np.linalg.norm(CUBE.x - CUBE.lo, axis=1) < 6.0)
CORNER.hi = CORNER.lo + 300.0                     # most of the box is empty

MOLECULES = "fix MOL all property/atom mol ghost yes\nset group all mol 1\nset group ODD mol 2\n"
HYBRID = ("pair_style hybrid lj/cut 1.5 sph/bulk dim 3\n"
          "pair_coeff * * lj/cut 0.0 1.0\npair_coeff 1*2 1*2 sph/bulk 1.0 10.0 0.5 2.0 2.5\n")

CASES = {
    # particles, ranks, lines before the box, boundary, lines after the coefficients, pair style
    "cube": (CUBE,),
    "cube, 4 ranks": (CUBE, 4),
    "cube, newton off": (CUBE, 1, "off"),
    "cube, newton off, 4 ranks": (CUBE, 4, "off"),
    "small": (SMALL,),
    "small, 2 ranks": (SMALL, 2),
    "small, newton off, 2 ranks": (SMALL, 2, "off"),
    "triclinic": (TILTED,),
    "triclinic, 4 ranks": (TILTED, 4),
    "triclinic, newton off, 2 ranks": (TILTED, 2, "off"),
    "lattice": (EXACT,),
    "lattice, 4 ranks": (EXACT, 4),
    "plane": (PLANE,),
    "plane, 4 ranks": (PLANE, 4),
    "plane, newton off, 4 ranks": (PLANE, 4, "off"),
    "line": (LINE, 2),
    "free": (CUBE, 2, "on", free(3)),
    "shrinking": (CUBE, 2, "on", "s m p"),
    "empty box": (CORNER, 2, "on", "f f f"),
    "types excluded": (CUBE, 2, "on", "p p p", "neigh_modify exclude type 1 2 exclude type 3 1\n"),
    "groups excluded": (CUBE, 2, "on", "p p p", "group first type 1\ngroup second type 2\nneigh_modify exclude group first second exclude group first third\n"),
    "in molecules excluded": (CUBE, 2, "on", "p p p", MOLECULES + "neigh_modify exclude molecule/intra ODD\n"),
    "between molecules excluded": (CUBE, 2, "off", "p p p", MOLECULES + "neigh_modify exclude molecule/inter all\n"),
    "hybrid": (CUBE, 2, "on", "p p p", "", HYBRID),
    "hybrid, a pair of types to another": (CUBE, 2, "on", "p p p", "", HYBRID + "pair_coeff 1 2 lj/cut 0.0 1.0\n"),
    "hybrid, newton off": (CUBE, 2, "off", "p p p", "", HYBRID),
    "bins of the user": (CUBE, 2, "on", "p p p", "neigh_modify binsize 0.7\n"),
    "domains of several sizes": (CUBE, 4, "on", "p p p", "balance 0.9 shift xyz 10 1.0\n"),
    "a domain shorter than the reach": (SMALL, 2, "on", "p p p", "balance 1.0 y 0.2\n"),
    "tiled": (CUBE, 1, "on", "p p p", "comm_style tiled\n"),
    "tiled, 4 ranks": (CUBE, 4, "on", "p p p", "comm_style tiled\nbalance 1.0 rcb\n"),
    "tiled, small, 2 ranks": (SMALL, 2, "on", "p p p", "comm_style tiled\nbalance 1.0 rcb\n"),
    "tiled, triclinic, 3 ranks": (TILTED, 3, "on", "p p p", "comm_style tiled\nbalance 1.0 rcb\n"),
    "tiled, free, newton off, 3 ranks": (CUBE, 3, "off", free(3), "comm_style tiled\nbalance 1.0 rcb\n"),
    "wide skin": (CUBE, 2, "on", "p p p", "neigh_modify every 1\n"),
}


def forces(lammps, style, particles, ranks=1, newton="on", boundary="p p p", after="", pairs=None, simd=""):
    """Number of pairs in the neighbor list; the particles after ten steps, with their forces."""
    dim = particles.dim
    particles.write(lammps.path("box.data"))
    pairs = pairs or fluid(dim, simd)
    skin = 1.5 if "binsize" in after or "every" in after else 0.5
    result = lammps(header(dim, newton, boundary) + f"read_data box.data\nneighbor {skin} {style}\n"
                    "group ODD id 1:100000:2\ngroup third type 3\n" + pairs + INTEGRATE + after
                    + "thermo_modify lost error\n" + dump("out.dump", 10) + "run 0 post yes\nrun 10\n", ranks=ranks)
    counts = [int(line.split("=")[1]) for line in result.log.splitlines() if line.startswith("Total # of neighbors")]
    return counts[0], lammps.frame("out.dump"), result


@pytest.mark.parametrize("name", CASES)
def test_pairs(lammps, name):
    """As many pairs, and the same sums over them."""
    found, here, log = forces(lammps, "bin", *CASES[name])
    known, there, other = forces(lammps, "nsq", *CASES[name])
    assert "sph/bulk, occasional" in log.log and "sph/bulk, perpetual" in other.log
    assert found == known and (found > 0 or "hybrid" in name)    # LAMMPS does not count those of hybrid
    for field in ("numden", "dnumden", "f", "desph", "x"):
        assert np.abs(here[field] - there[field]).max() < 1e-11 * (1.0 + np.abs(there[field]).max()), field


@pytest.mark.parametrize("simd", ["none", "avx2", "avx512"])
@pytest.mark.parametrize("particles", [CUBE, EXACT, PLANE], ids=["cube", "lattice", "plane"])
def test_vectors(lammps, particles, simd):
    """Every instruction set finds the same pairs."""
    lammps.skip_without(simd)
    known, there, _ = forces(lammps, "nsq", particles)
    found, here, _ = forces(lammps, "bin", particles, simd=f"simd {simd}")
    assert found == known
    assert np.abs(here["f"] - there["f"]).max() < 1e-11 * (1.0 + np.abs(there["f"]).max())


@pytest.mark.parametrize("setting, reason", [("neighbor 0.3 nsq", "neighbor style nsq"), ("neighbor 0.3 multi", "neighbor style multi"),
                                             ("neigh_modify every 2", ""),
                                             ("group A union all\natom_modify first A\nneigh_modify include A", "neigh_modify include")])
def test_what_lammps_builds(lammps, setting, reason):
    """What the package does not cover LAMMPS's own list covers, and the log says why."""
    PLANE.write(lammps.path("box.data"))
    log = lammps(header(2) + f"read_data box.data\n{setting}\n" + fluid(2) + INTEGRATE + "run 1\n").log
    assert ("LAMMPS builds the neighbor list" in log) == bool(reason) and reason in log


def test_lists_of_others(lammps):
    """A compute that asks for a list of its own gets one, in the run and at its end, and changes nothing."""
    PLANE.write(lammps.path("box.data"))
    values = []
    for style in ("bin", "nsq"):
        log = lammps(header(2) + f"read_data box.data\nneighbor 0.3 {style}\n" + fluid(2) + INTEGRATE
                     + "compute N all coord/atom cutoff 2.0\ncompute S all reduce sum c_N\n"
                     "thermo_style custom step c_S press\nthermo 5\nrun 20\nrun 0\n")
        values.append([run["c_S"] for run in log.thermo()])
    for here, there in zip(*values):
        np.testing.assert_array_equal(here, there)


def test_runs_continue(lammps):
    """Short runs, with and without setup, and particles that are deleted between them."""
    PLANE.write(lammps.path("box.data"))
    ends = []
    for style in ("bin", "nsq"):
        lammps(header(2) + f"read_data box.data\nneighbor 0.3 {style}\n" + fluid(2) + INTEGRATE
               + "run 7\nrun 5 pre no post no\nrun 30\nrun 0\ngroup GONE id 1:600:7\ndelete_atoms group GONE compress no\n"
               "run 20\n" + dump("out.dump", 1) + "run 0\n")
        ends.append(lammps.frame("out.dump"))
    assert relative(ends[0]["x"] - ends[1]["x"], ends[1]["x"]) < 1e-11
    assert relative(ends[0]["f"] - ends[1]["f"], ends[1]["f"]) < 1e-9


@pytest.mark.parametrize("ranks, style", [(1, "brick"), (2, "tiled")])
def test_boxes_and_settings_change(lammps, ranks, style):
    """Between runs the box gets wider, oblique, and open, where some particles are lost, pairs are excluded, the skin changes, and ranks share the particles anew."""
    particles = disordered(3, (9, 8, 8), jitter=0.3, ntypes=2)
    particles.write(lammps.path("box.data"))
    ends = []
    for lists in ("bin", "nsq"):
        lammps(header(3) + f"comm_style {style}\nread_data box.data\nneighbor 0.3 {lists}\n" + fluid(3) + INTEGRATE
               + "change_box all x scale 1.1 remap\nrun 5\nbalance 1.0 " + ("rcb" if style == "tiled" else "shift xyz 5 1.05") + "\nrun 5\n"
               f"change_box all triclinic\nchange_box all xy final 1.5 remap units box\nneighbor 0.6 {lists}\nrun 5\n"
               "neigh_modify exclude type 1 2\nrun 5\nneigh_modify exclude none\nchange_box all boundary f f f\nthermo_modify lost ignore\nrun 20\n"
               + dump("out.dump", 1) + "run 0\n", ranks=ranks)
        ends.append(lammps.frame("out.dump"))
    assert len(ends[0]["x"]) == len(ends[1]["x"]) > 500
    assert relative(ends[0]["x"] - ends[1]["x"], ends[1]["x"]) < 1e-11
    assert relative(ends[0]["f"] - ends[1]["f"], ends[1]["f"]) < 1e-9


@pytest.mark.parametrize("special", ["lj/coul 1 1 1", "lj 1 1 1 coul 0 0 0.5"])
def test_bonds(lammps, special):
    """Bonded particles are neighbors as all others, whether LAMMPS marks them or not."""
    found = []
    for style in ("bin", "nsq"):
        result = lammps(header(2, style="hybrid sph/bulk bond") + "lattice sq 1.0\nregion box block 0 8 0 8 -0.5 0.5\n"
                        "create_box 1 box bond/types 1 extra/bond/per/atom 1 extra/special/per/atom 2\ncreate_atoms 1 box\nset group all mass 1.0\n"
                        "displace_atoms all random 0.2 0.2 0.0 7\nvelocity all create 0.1 8 loop geom\n"
                        f"bond_style zero\nbond_coeff 1\ncreate_bonds single/bond 1 5 6\nspecial_bonds {special}\nneighbor 0.5 {style}\n"
                        + fluid(2) + INTEGRATE + dump("out.dump", 1) + "run 1\n", check=False)
        if "MOLECULE package" in result.error:
            pytest.skip("no package MOLECULE")
        assert result.code == 0 and ("LAMMPS builds the neighbor list" in result.log) == (style == "nsq")
        found.append(lammps.frame("out.dump")["f"])
    assert relative(found[0] - found[1], found[1]) < 1e-12


@pytest.mark.parametrize("ranks", [1, 4])
@pytest.mark.parametrize("lo, hi", [((0.52, -0.83, 0.58), (6.81, 7.79, 7.04)), ((-0.9, -0.28, 0.94), (7.8, 7.38, 7.11)),
                                    ((-8.0, -7.3, -8.0), (0.0, 0.0, 0.0))])
def test_faces_of_the_box(lammps, lo, hi, ranks):
    """Particles on the faces of a box whose length has round-off, where LAMMPS's own bins lose pairs or count them twice."""
    particles = disordered(3, (7, 7, 7), ntypes=3)
    lo, hi = np.array(lo), np.array(hi)
    particles.x *= (hi - lo) / particles.hi
    particles.x += lo
    particles.lo, particles.hi = lo, hi
    inside = np.nextafter(hi, lo)
    inside[hi == 0.0] = -1e-17
    for number in range(0, len(particles), 3):
        particles.x[number, number % 4 % 3] = lo[number % 4 % 3]
    for number in range(1, len(particles), 5):
        particles.x[number, number % 4 % 3] = inside[number % 4 % 3]
    found, here, _ = forces(lammps, "bin", particles, ranks)
    known, there, _ = forces(lammps, "nsq", particles, ranks)
    assert found == known
    assert relative(here["f"] - there["f"], there["f"]) < 1e-11


@pytest.mark.parametrize("unit", [1e-25, 1e-9, 1e19])
def test_unit_of_length(lammps, unit):
    """Lengths whose squares are no numbers of single precision."""
    particles = disordered(3, (6, 7, 5))
    particles.x, particles.lo, particles.hi = unit * particles.x, unit * particles.lo, unit * particles.hi
    particles.mass, particles.esph = unit**3 * particles.mass, unit**3 * particles.esph
    particles.write(lammps.path("box.data"))
    counts = []
    for style in ("bin", "nsq"):
        log = lammps(header(3) + f"comm_modify cutoff {3.0 * unit}\nread_data box.data\nneighbor {0.5 * unit} {style}\n"
                     + fluid(3, mu=0.5 * unit, kappa=2.0 * unit, support=2.5 * unit)
                     + f"fix FLUID all sph/bulk\ntimestep {0.005 * unit}\nrun 0 post yes\n").log
        counts += [line for line in log.splitlines() if line.startswith("Total # of neighbors")]
    assert counts[0] == counts[1]
