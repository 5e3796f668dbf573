"""compute sph/dissipation and compute sph/energy against sums over the dumped fields."""

import itertools

import numpy as np
import pytest

from helpers import INTEGRATE, SUPPORT, disordered, dump, fluid, header, relative, undump

THERMO = "thermo_modify norm no format float %.17g\n"
VISCOUS = {"mg": "shear mg bulk none", "density": "shear none bulk density", "both": "shear mg/fr bulk density",
           "volume": "shear espanol bulk volume"}
CELLS = {1: 60, 2: 12, 3: 6}


def model(dim, options):
    return fluid(dim, options, mu=0.0 if "shear none" in options else 0.5,
                 kappa="intrinsic" if "bulk none" in options else 2.0)


@pytest.mark.parametrize("dim", [1, 2, 3])
@pytest.mark.parametrize("newton, ranks", [("on", 1), ("off", 1), ("on", 2)])
def test_dissipation(lammps, dim, newton, ranks):
    """Power by channel, its sum, and the heat of each particle, whatever else asked for them in the same step."""
    disordered(dim, CELLS[dim]).write(lammps.path("box.data"))
    text = header(dim, newton=newton) + "read_data box.data\n" + INTEGRATE
    text += model(dim, "shear none bulk none") + dump("cold.dump") + "run 0\n" + undump() + "pair_style none\n"
    for name, options in VISCOUS.items():
        text += (model(dim, options) + "compute Q all sph/dissipation\ncompute A all reduce sum c_Q\n"
                 "compute B all reduce sum c_Q\n"
                 "thermo_style custom step c_A c_Q c_Q[1] c_Q[2] c_B\n" + THERMO
                 + dump(f"{name}.dump", extra="c_Q") + "run 0\nthermo_style one\n"
                 "uncompute B\nuncompute A\n" + undump() + "uncompute Q\npair_style none\n")
    tables = lammps(text, ranks=ranks).thermo()[1:]
    cold = lammps.frame("cold.dump")
    for (name, options), table in zip(VISCOUS.items(), tables):
        frame = lammps.frame(f"{name}.dump")
        heat = frame["desph"] - cold["desph"]
        assert relative(frame["c_Q"] - heat, heat) < 1e-12, name
        shear, bulk = table["c_Q[1]"][0], table["c_Q[2]"][0]
        total = heat.sum()
        for sum_ in (table["c_Q"][0], shear + bulk, table["c_A"][0], table["c_B"][0],
                     -((frame["f"] - cold["f"]) * frame["v"]).sum()):
            assert sum_ == pytest.approx(total, rel=1e-12), name
        assert (shear == 0.0) == ("shear none" in options) and (bulk == 0.0) == ("bulk none" in options)


@pytest.mark.parametrize("ranks", [1, 2])
def test_energy(lammps, ranks):
    """Kinetic and internal energy of a group."""
    particles = disordered(2, 12, ntypes=2)
    particles.write(lammps.path("box.data"))
    result = lammps(header(2) + "read_data box.data\n" + fluid(2) + INTEGRATE + "group A type 1\n"
                    "compute E all sph/energy\ncompute G A sph/energy\n" + dump("out.dump", 20)
                    + "thermo 20\nthermo_style custom step c_E c_E[1] c_E[2] c_G c_G[1] c_G[2]\n" + THERMO + "run 20\n",
                    ranks=ranks)
    (table,) = result.thermo()
    for (k, frame), (name, mask) in itertools.product(
            enumerate(lammps.frames("out.dump")),
            (("c_E", np.ones(len(particles), dtype=bool)), ("c_G", particles.type == 1))):
        kinetic = 0.5 * (frame["mass"][:, None] * frame["v"] ** 2)[mask].sum()
        internal = frame["esph"][mask].sum()
        assert table[f"{name}[1]"][k] == pytest.approx(kinetic, rel=1e-13)
        assert table[f"{name}[2]"][k] == pytest.approx(internal, rel=1e-13)
        assert table[name][k] == pytest.approx(kinetic + internal, rel=1e-13)


PLACES = {2: ((1.6, 11.9), (6.0, 2.9)), 3: ((1.6, 3.1, 5.8), (3.6, 2.7, 1.4))}


def wendland(n, r, support):
    q = np.minimum(r / support, 1.0)
    return {1: 3 / 2, 2: 7 / np.pi, 3: 21 / (2 * np.pi)}[n] * (1 - q)**4 * (1 + 4 * q) / support**n


@pytest.mark.parametrize("dim, ranks", [(2, 1), (2, 2), (3, 1), (3, 4)])
def test_gauges(lammps, dim, ranks):
    """Pressure and level of a group, next to a wall and across a periodic boundary, against sums over the dumped fields."""
    box = disordered(dim, CELLS[dim], ntypes=2)
    box.write(lammps.path("box.data"))
    places = [" ".join(map(str, (*place, 0.0)[:3])) for place in PLACES[dim]]
    level = "5.3 NULL 0.0" if dim == 2 else "4.1 5.9 NULL"
    gauges = f"sph/gauge pressure {places[0]} level {level} pressure {places[1]}"
    text = (header(dim) + "read_data box.data\n" + fluid(dim, "kernel wendland/c2") + "region left block INF 1.5 INF INF INF INF\n"
            "group wall region left\ngroup free subtract all wall\ngroup red type 1\ngroup some subtract red wall\n"
            f"fix W wall sph/wall\nfix I free sph/bulk\ntimestep 1e-4\ncompute A all {gauges}\ncompute S some {gauges}\n"
            "thermo_style custom step c_A[*] c_S[*]\n" + THERMO + dump("out.dump") + "run 0\n")
    (table,) = lammps(text, ranks=ranks).thermo()
    frame = lammps.frame("out.dump")
    length, support = (box.hi - box.lo)[:dim], SUPPORT[dim]

    def distances(place, axes):
        r = (frame["x"][:, :dim] - np.array(place))[:, axes]
        return np.linalg.norm(r - length[axes] * np.round(r / length[axes]), axis=1)

    wall = box.x[:, 0] < 1.5
    assert wall.sum() > CELLS[dim]
    for name, fluid_of in (("A", ~wall), ("S", ~wall & (box.type == 1))):
        for k, place in ((1, PLACES[dim][0]), (3, PLACES[dim][1])):
            W = wendland(dim, distances(place, range(dim)), support)
            pressure = 100.0 * (frame["rho"] - 1.0)
            there = 1 - (box.mass * W)[wall].sum()
            assert (there < 0.9) == (k == 1)
            assert table[f"c_{name}[{k}]"][0] == pytest.approx((frame["vol"] * W * pressure)[fluid_of].sum() / there, rel=1e-11)
        axes, place = ([0], (5.3, 0.0)) if dim == 2 else ([0, 1], (4.1, 5.9, 0.0))
        W = wendland(dim - 1, distances(place, axes), support)
        assert table[f"c_{name}[2]"][0] == pytest.approx((frame["vol"] * W)[fluid_of].sum(), rel=1e-12)


@pytest.mark.parametrize("dim, words, message", [
    (2, "", "needs at least one pressure or level"), (2, "pressure 1.0 2.0", "missing argument"),
    (2, "pressure 1.0 2.0 0.5", "pressure: z must be 0 in 2d"), (2, "pressure 1.0 NULL 0.0", "Expected floating point parameter"),
    (2, "level 1.0 2.0 0.0", "NULL must stand for the coordinate along the level"),
    (2, "level 1.0 2.0 NULL", "NULL must stand for one coordinate of the box"), (3, "level 1.0 NULL NULL", "NULL must stand for one coordinate"),
    (3, "pressure 1.0 1e300 1.0\nrun 0", "place 1e+300 is outside of the periodic box by more than its length"),
    (3, "front 1.0 0.0 0.0", "Unknown compute sph/gauge keyword: front"),
    (3, "level 1.0 1.0 NULL\nvariable h equal c_A[1]\nrun 0\ndelete_atoms random count 1 yes all NULL 4711\nprint $h", "use run 0 first"),
    (3, "level 1.0 1.0 NULL\npair_style none\nrun 0", "requires pair style sph/bulk or sph/micropolar"),
])
def test_gauge_errors(lammps, dim, words, message):
    disordered(dim, CELLS[dim]).write(lammps.path("box.data"))
    result = lammps(header(dim) + "read_data box.data\n" + fluid(dim) + INTEGRATE + f"compute A all sph/gauge {words}\n", check=False)
    assert result.code == 1 and message in " ".join(result.error.split()), result.output[-2000:]


FLUIDS = """# fluids of a test   UNITS: lj
# name temperature rho c mu kappa
water   20.0  1.0  10.0  0.5  2.0
honey   20.0  1.4  12.0  5.0  9.0
"""


def test_fluid_from_a_file(lammps):
    """pair_coeff I I FILE NAME rc is the same as the numbers of that line."""
    disordered(2, 12, ntypes=2).write(lammps.path("box.data"))
    lammps.path("fluids.sph").write_text(FLUIDS)
    cases = {
        "numbers": "pair_coeff 1 1 1.0 10.0 0.5 2.0 3.0\npair_coeff 2 2 1.4 12.0 5.0 9.0 3.0 pb 2.5\n",
        "file": "pair_coeff 1 1 fluids.sph water 3.0\npair_coeff 2 2 fluids.sph honey 3.0 pb 2.5\n",
    }
    text = header(2) + "read_data box.data\n" + INTEGRATE
    for name, coeff in cases.items():
        text += fluid(2, coeff=coeff) + dump(f"{name}.dump") + "run 0\n" + undump() + "pair_style none\n"
    lammps(text, ranks=2)
    assert (lammps.frame("file.dump")["f"] == lammps.frame("numbers.dump")["f"]).all()
