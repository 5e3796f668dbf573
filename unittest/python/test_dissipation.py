"""Dissipated power: identities, sign, the friction matrix and its limiter, and the account of the energy of a run."""

import itertools
import re
from math import pi

import numpy as np
import pytest

from helpers import INTEGRATE, Lammps, disordered, dump, fluid, header, lattice, relative, undump

SHEAR = ("mg", "mg/fr", "mg/fr2", "morris", "espanol")
BULK = ("density", "volume", "none")
CELLS = {1: 60, 2: 12, 3: 6}
RANKS = [(1, "on"), (1, "off"), (2, "on"), (2, "off"), (4, "on"), (4, "off")]
MU = 0.5
FULL_PRECISION = "thermo_modify norm no format float %.17g\n"
# the commands between which a model can be exchanged for another one
MEASURE = "compute Q all sph/dissipation\ncompute S all reduce sum c_Q\nthermo_style custom step c_Q c_Q[1] c_Q[2] c_S\n"
END_MEASURE = "thermo_style one\nuncompute S\nuncompute Q\npair_style none\n"


def intrinsic(shear, dim):
    """kappa/mu of a shear term alone: lambda = mu (central forces), -mu (Laplacian), -(n+1)/(n+3) mu (both)."""
    lam = {"mg": 1.0, "mg/fr": 1.0, "mg/fr2": 1.0, "morris": -1.0, "espanol": -(dim + 1) / (dim + 3)}[shear]
    return lam + 2.0 / dim


# ---------------------------------------------------------------------------------------------
# the identity


@pytest.mark.parametrize("dim", [1, 2, 3])
@pytest.mark.parametrize("ranks, newton", RANKS)
def test_power_is_the_work_of_the_viscous_forces(lammps, dim, ranks, newton):
    """scalar = sum of channels = sum over particles = -sum(viscous force . v); viscous: force less that at rest."""
    models = {(shear, bulk, kappa): fluid(dim, f"shear {shear} bulk {bulk}", mu=MU, kappa=kappa)
              for shear, bulk in itertools.product(SHEAR, BULK)
              for kappa in (["intrinsic"] if bulk == "none" else [2.0, 0.0])}
    particles = disordered(dim, CELLS[dim])
    particles.write(lammps.path("box.data"))
    text = header(dim, newton=newton) + "read_data box.data\n" + INTEGRATE
    for number, model in enumerate(models.values()):
        text += (model + MEASURE + FULL_PRECISION + dump(f"moving.{number}", extra="c_Q") + "run 0 post no\n"
                 + undump() + END_MEASURE)
    text += "velocity all set 0.0 0.0 0.0\n"
    for number, model in enumerate(models.values()):
        text += model + dump(f"rest.{number}") + "run 0 post no\n" + undump() + "pair_style none\n"
    tables = [table for table in lammps(text, ranks=ranks).thermo() if "c_Q" in table]

    assert len(tables) == len(models)
    for number, (key, table) in enumerate(zip(models, tables)):
        moving, rest = lammps.frame(f"moving.{number}"), lammps.frame(f"rest.{number}")
        work = -((moving["f"] - rest["f"]) * moving["v"]).sum()
        total = table["c_Q"][0]
        assert total == pytest.approx(work, rel=1e-12), key
        assert total == pytest.approx(table["c_Q[1]"][0] + table["c_Q[2]"][0], rel=1e-12), key
        assert total == pytest.approx(table["c_S"][0], rel=1e-12), key
        assert total == pytest.approx(moving["c_Q"].sum(), rel=1e-12), key
        assert abs(total) > 1.0, key


@pytest.mark.parametrize("dim", [1, 2, 3])
@pytest.mark.parametrize("shear", SHEAR)
def test_no_particle_is_cooled_along_a_run(lammps, dim, shear):
    """Pairs share their heat half and half, the bulk term heats by a square: never negative if zeta >= 0."""
    disordered(dim, CELLS[dim], ntypes=2).write(lammps.path("box.data"))
    rc = {1: 4.0, 2: 3.0, 3: 2.5}[dim]
    kappa = [max(intrinsic(shear, dim), 0.0) * mu for mu in (0.5, 2.0)]
    coeff = (f"pair_coeff 1 1 1.0 10.0 0.5 {kappa[0]} {rc}\npair_coeff 2 2 1.0 10.0 2.0 {kappa[1] + 1.0} {rc}\n"
             "pair_coeff 1 2 mu 0.1\n")
    result = lammps(header(dim) + "read_data box.data\n" + fluid(dim, f"shear {shear} bulk density", coeff=coeff)
                    + INTEGRATE + MEASURE + FULL_PRECISION + "thermo 5\n" + dump("out.dump", 5, extra="c_Q")
                    + "timestep 0.001\nrun 100\n")
    heats = [frame["c_Q"] for frame in lammps.frames("out.dump")]
    assert len(heats) == 21
    for heat in heats:
        assert heat.min() >= 0.0
    (table,) = result.thermo()
    assert (table["c_Q[1]"] > 0.0).all() and (table["c_Q[2]"] > 0.0).all()


# ---------------------------------------------------------------------------------------------
# the friction matrix: force = force at rest - matrix * velocity


def friction_matrix(lammps, particles, model):
    """The matrix column by column, from the forces on particles of which one moves; and the result of the run."""
    dim, number = particles.dim, len(particles)
    particles.write(lammps.path("box.data"))
    text = (header(dim) + "read_data box.data\n" + model + INTEGRATE + "compute P all pair sph/bulk\n"
            "thermo_style custom step c_P[1]\nthermo_modify norm no\n")
    moves = [(0, None), *itertools.product(range(number), range(dim))]
    for column, (particle, axis) in enumerate(moves):
        velocity = ["v_one" if d == axis else "0.0" for d in range(3)]
        text += (f"variable one atom id=={particle + 1}\nvelocity all set {' '.join(velocity)}\nrun 0 post no\n"
                 f"write_dump all custom force.{column} id fx fy fz modify sort id format float %.17g\n")
    result = lammps(text)
    forces = [lammps.frame(f"force.{column}")["f"][:, :dim].ravel() for column in range(len(moves))]
    return np.array([forces[0] - force for force in forces[1:]]).T, result


def eigenvalues(matrix):
    return np.linalg.eigvalsh(0.5 * (matrix + matrix.T))


@pytest.mark.parametrize("dim, cells", [(1, 24), (2, 8), (3, 5)])
@pytest.mark.parametrize("shear", ["mg", "mg/fr", "mg/fr2", "espanol"])
def test_no_velocity_field_gains_energy_on_a_lattice(lammps, dim, cells, shear):
    """Stokes' hypothesis, kappa = 0: a negative coefficient of the bulk term, and still a friction matrix >= 0."""
    matrix, _ = friction_matrix(lammps, lattice(dim, cells), fluid(dim, f"shear {shear}", mu=MU, kappa=0.0))
    values = eigenvalues(matrix)
    print(f"smallest over largest eigenvalue {values[0] / values[-1]:.1e}")
    assert relative(matrix - matrix.T, matrix) < 1e-13
    assert values[0] > -1e-13 * values[-1]


@pytest.mark.parametrize("dim", [1, 2, 3])
@pytest.mark.parametrize("shear, kappa", [("mg", 0.0), ("mg", 0.5), ("mg/fr", 0.0), ("mg/fr2", 0.0), ("espanol", 0.0), ("mg", 2.0)])
def test_power_along_a_run_from_a_lattice(lammps, dim, shear, kappa):
    """A sound wave in a fluid with kappa >= 0 loses kinetic energy at every output."""
    particles = lattice(dim, CELLS[dim])
    particles.v[:, 0] = 0.5 * np.sin(2 * pi * particles.x[:, 0] / CELLS[dim])
    particles.write(lammps.path("box.data"))
    (table,) = lammps(header(dim) + "read_data box.data\n" + fluid(dim, f"shear {shear}", mu=MU, kappa=kappa)
                      + INTEGRATE + MEASURE + FULL_PRECISION + "thermo 5\nrun 300\n").thermo()
    assert len(table["c_Q"]) == 61
    assert (table["c_Q"] >= 0.0).all()
    below = kappa < intrinsic(shear, dim) * MU * (1 - 1e-12)
    assert (table["c_Q[2]"] <= 0.0).all() if below else (table["c_Q[2]"] >= 0.0).all()
    assert (table["c_Q[1]"] >= 0.0).all() and table["c_Q"].max() > 0.0


# ---------------------------------------------------------------------------------------------
# the limiter


def random_line(seed, number=30):
    """Particles anywhere on a periodic line: the sets on which kappa = 0 is too little."""
    particles = lattice(1, number)
    particles.x[:, 0] = np.random.default_rng(seed).uniform(0.0, number, number)
    return particles


def below_hypothesis(limit, dim=1, shear="mg"):
    return fluid(dim, f"shear {shear} limit {limit}", mu=MU, kappa=0.0)


def bounds(particles, support):
    """zeta_i >= -1/(2 bound_i) for all i makes the power positive (line, mg, Wendland C2): computed without LAMMPS."""
    length = particles.hi[0] - particles.lo[0]
    x = particles.x[:, 0]
    r = x[:, None] - x
    r = np.abs(r - length * np.round(r / length))
    q = np.minimum(r / support, 1.0)
    vol = 1.0 / (1.5 / support * (1.0 - q) ** 4 * (1.0 + 4.0 * q)).sum(axis=1)
    slope = 30.0 / support ** 3 * (1.0 - q) ** 3
    return vol ** 2 * (slope * r ** 2 / vol).sum(axis=1) / (6.0 * MU)


@pytest.mark.parametrize("seed", range(4))
def test_limit_on_a_random_line(lammps, seed):
    """Without limit some velocity field gains energy, with it none does; count and limit see the same particles."""
    particles = random_line(seed)
    zeta = -3.0 * MU
    beyond = (zeta * bounds(particles, 4.0) < -0.5).sum()
    assert beyond > 0
    matrices = {}
    for limit in ("no", "count", "yes"):
        matrices[limit], result = friction_matrix(lammps, particles, below_hypothesis(limit))
        for table in result.thermo():
            assert table["c_P[1]"][0] == (0 if limit == "no" else beyond)
    worst = {limit: eigenvalues(matrix)[0] / eigenvalues(matrix)[-1] for limit, matrix in matrices.items()}
    print(f"{beyond} of {len(particles)} particles; smallest over largest eigenvalue {worst}")
    assert (matrices["count"] == matrices["no"]).all()
    assert worst["no"] < -1e-4
    assert worst["yes"] > -1e-13
    assert relative(matrices["yes"] - matrices["yes"].T, matrices["yes"]) < 1e-13
    assert relative(matrices["yes"].sum(axis=0), matrices["yes"]) < 1e-13, "momentum"


def test_worst_velocity_field(lammps):
    """compute sph/dissipation: negative without the limit, positive with it, for the field that gains most."""
    particles = random_line(1)
    matrix, _ = friction_matrix(lammps, particles, below_hypothesis("no"))
    values, fields = np.linalg.eigh(0.5 * (matrix + matrix.T))
    particles.v[:, 0] = fields[:, 0]
    particles.write(lammps.path("box.data"))
    text = header(1) + "read_data box.data\n" + INTEGRATE
    for limit in ("no", "count", "yes"):
        text += below_hypothesis(limit) + MEASURE + FULL_PRECISION + "run 0\n" + END_MEASURE
    power = [table["c_Q"][0] for table in lammps(text).thermo()]
    assert power[0] == pytest.approx(values[0], rel=1e-10) and power[0] < 0.0
    assert power[1] == power[0]
    assert power[2] > 0.0


def test_how_much_too_little_kappa_0_is_in_a_random_line(lammps):
    """3 mu over the largest -zeta that a random line bears; above 1, kappa = 0 is inadmissible for this set."""
    ratios = []
    for seed in range(12):
        particles = random_line(seed)
        shear, _ = friction_matrix(lammps, particles, fluid(1, "bulk none", mu=MU, kappa="intrinsic"))
        bulk, _ = friction_matrix(lammps, particles, fluid(1, "shear none", mu=0.0, kappa=1.0))
        # in the range of the shear matrix: without the uniform velocity, which no friction acts on
        values, fields = np.linalg.eigh(0.5 * (shear + shear.T))
        regular = values > 1e-10 * values[-1]
        root = fields[:, regular] / np.sqrt(values[regular])
        ratios.append(3.0 * MU * np.linalg.eigvalsh(root.T @ bulk @ root)[-1])
    print("ratios", np.round(ratios, 2))
    assert max(ratios) > 1.3
    assert min(ratios) > 0.9


# espanol in three dimensions has kappa = 0 of its own
@pytest.mark.parametrize("dim, shear", [*itertools.product([1, 2, 3], ["mg", "mg/fr", "mg/fr2"]), (1, "espanol"), (2, "espanol"),
                                        (1, "morris")])
def test_limit_in_disorder(lammps, dim, shear):
    """Random sets in every dimension: violations are counted; limited forces conserve momentum, and the power stays
    the work of the viscous forces."""
    particles = disordered(dim, CELLS[dim], seed=3)
    random = np.random.default_rng(5)
    particles.x[:, :dim] = random.uniform(0.0, CELLS[dim], (len(particles), dim))
    particles.write(lammps.path("box.data"))
    text = header(dim) + "read_data box.data\n" + INTEGRATE
    for limit in ("count", "yes"):
        text += (below_hypothesis(limit, dim, shear) + MEASURE + "compute P all pair sph/bulk\n"
                 "thermo_style custom step c_Q c_S c_P[1]\n" + FULL_PRECISION + dump(f"{limit}.dump", extra="c_Q")
                 + "run 0\nthermo_style one\nuncompute P\n" + undump() + END_MEASURE)
    text += "velocity all set 0.0 0.0 0.0\n" + below_hypothesis("yes", dim, shear) + dump("rest.dump") + "run 0\n"
    tables = lammps(text).thermo()
    assert 0 < tables[0]["c_P[1]"][0] <= len(particles)
    assert tables[1]["c_P[1]"][0] == tables[0]["c_P[1]"][0]
    free, limited, rest = (lammps.frame(f"{name}.dump") for name in ("count", "yes", "rest"))
    assert relative(limited["f"] - free["f"], free["f"]) > 1e-6
    for frame, table in zip((free, limited), tables):
        work = -((frame["f"] - rest["f"]) * frame["v"]).sum()
        assert table["c_Q"][0] == pytest.approx(work, rel=1e-11)
        assert table["c_S"][0] == pytest.approx(work, rel=1e-11)
        assert np.abs(frame["f"].sum(axis=0)).max() < 1e-12 * np.abs(frame["f"]).sum()
    assert tables[1]["c_Q"][0] > tables[0]["c_Q"][0]


@pytest.mark.parametrize("dim", [1, 2, 3])
def test_limit_changes_nothing_on_a_lattice(lammps, dim):
    """There the bound is that of the continuum, kappa = 0, or a little beyond it."""
    particles = lattice(dim, CELLS[dim])
    particles.v[:, :dim] = np.random.default_rng(2).normal(0.0, 0.5, (len(particles), dim))
    particles.write(lammps.path("box.data"))
    text = header(dim) + "read_data box.data\n" + INTEGRATE
    for limit in ("no", "yes"):
        model = fluid(dim, f"limit {limit}", mu=MU, kappa=0.01 * MU)
        text += (model + "compute P all pair sph/bulk\nthermo_style custom step c_P[1]\n" + dump(f"{limit}.dump")
                 + "run 0\nthermo_style one\nuncompute P\n" + undump() + "pair_style none\n")
    for table in lammps(text).thermo():
        assert table["c_P[1]"][0] == 0
    assert (lammps.frame("yes.dump")["f"] == lammps.frame("no.dump")["f"]).all()


@pytest.fixture(scope="module")
def limited(tmp_path_factory):
    """Forces and count of one random set on any number of ranks."""
    lammps = Lammps(tmp_path_factory.mktemp("limited"))
    particles = disordered(2, 12, seed=4)
    particles.x[:, :2] = np.random.default_rng(6).uniform(0.0, 12.0, (len(particles), 2))
    particles.write(lammps.path("box.data"))

    def get(ranks, newton):
        (table,) = lammps(header(2, newton=newton) + "read_data box.data\n" + below_hypothesis("yes", 2) + INTEGRATE
                          + "compute P all pair sph/bulk\nthermo_style custom step c_P[1]\nthermo_modify norm no\n"
                          + dump("out.dump") + "run 0\n", ranks=ranks).thermo()
        return lammps.frame("out.dump")["f"], table["c_P[1]"][0]

    return get


@pytest.mark.parametrize("ranks, newton", RANKS[1:])
def test_limit_on_any_number_of_ranks(limited, ranks, newton):
    force, count = limited(ranks, newton)
    expected_force, expected_count = limited(1, "on")
    assert count == expected_count > 0
    assert relative(force - expected_force, expected_force) < 1e-12


def test_limit_by_type_pair(lammps):
    """Two types with their own mu and kappa: the limiter takes what stands before each pair's term."""
    particles = random_line(7)
    particles.type[::2] = 2
    coeff = "pair_coeff 1 1 1.0 10.0 0.5 0.0 4.0\npair_coeff 2 2 1.0 10.0 5.0 3.0 4.0\npair_coeff 1 2 mu 0.05\n"
    least = {limit: eigenvalues(friction_matrix(lammps, particles, fluid(1, f"limit {limit}", coeff=coeff))[0])
             for limit in ("no", "yes")}
    assert least["no"][0] < -1e-4 * least["no"][-1]
    assert least["yes"][0] > -1e-13 * least["yes"][-1]


def test_restart_keeps_the_limit(lammps):
    """The settings come back from the file: forces and the count are those of the first run."""
    particles = disordered(2, 12, seed=4)
    particles.x[:, :2] = np.random.default_rng(6).uniform(0.0, 12.0, (len(particles), 2))
    particles.write(lammps.path("box.data"))
    measure = ("compute P all pair sph/bulk\nthermo_style custom step c_P[1]\nthermo_modify norm no\n")
    tables = {}
    for limit in ("yes", "count"):
        (first,) = lammps(header(2) + "read_data box.data\n" + below_hypothesis(limit, 2) + INTEGRATE + measure
                          + dump("first.dump") + "run 0\n" + undump() + f"write_restart {limit}.restart\n").thermo()
        (second,) = lammps(f"read_restart {limit}.restart\n" + INTEGRATE + measure + dump("second.dump")
                           + "run 0\n").thermo()
        assert second["c_P[1]"][0] == first["c_P[1]"][0] > 0
        tables[limit] = lammps.frame("first.dump")["f"]
        assert relative(lammps.frame("second.dump")["f"] - tables[limit], tables[limit]) < 1e-13
    assert relative(tables["yes"] - tables["count"], tables["yes"]) > 1e-6


@pytest.mark.parametrize("bulk", ["volume", "none"])
@pytest.mark.parametrize("limit", ["count", "yes"])
def test_limit_needs_the_bulk_term_it_bounds(lammps, bulk, limit):
    disordered(2, 10).write(lammps.path("box.data"))
    result = lammps(header(2) + "read_data box.data\n" + fluid(2, f"limit {limit} bulk {bulk}") + INTEGRATE + "run 0\n",
                    check=False)
    assert result.code != 0
    assert re.search("limit requires bulk density", result.error), result.error


# ---------------------------------------------------------------------------------------------
# energy of a run


def vortices(lammps, step, steps, kappa=0.4, cells=12, speed=0.05, mu=0.1, options=""):
    """Decaying vortices of a square lattice; thermo table of sph/energy, and the largest stable step of the table."""
    particles = lattice(2, cells)
    k = 2 * pi / cells
    x, y = particles.x[:, 0], particles.x[:, 1]
    particles.v[:, 0] = speed * np.sin(k * x) * np.cos(k * y)
    particles.v[:, 1] = -speed * np.cos(k * x) * np.sin(k * y)
    particles.write(lammps.path("box.data"))
    result = lammps(header(2) + "read_data box.data\n" + fluid(2, options, mu=mu, kappa=kappa)
                    + f"fix FLUID all sph/bulk\ntimestep {step}\ncompute E all sph/energy\n"
                    "compute Q all sph/dissipation\n"
                    f"thermo {max(steps // 100, 1)}\nthermo_style custom step time pe c_E c_E[1] c_E[2] c_Q\n"
                    + FULL_PRECISION + f"run {steps}\n", timeout=300)
    (table,) = result.thermo()
    stable = float(re.search(r"^ +1-1 .* (\S+) *$", result.log, re.MULTILINE)[1])
    return table, stable


@pytest.mark.parametrize("kappa, options", [(0.4, ""), (0.4, "shear mg/fr bulk volume eos tait"),
                                            (0.2, "shear morris")])
def test_energy_of_ten_thousand_adiabatic_steps(lammps, kappa, options):
    """Kinetic + internal energy at half the stable step: constant to 1e-6 of the initial kinetic energy, and the error
    falls as the square of the step."""
    _, stable = vortices(lammps, 1e-4, 0, kappa, options=options)
    errors = []
    for part in (1, 2, 4):
        table, _ = vortices(lammps, 0.5 * stable / part, 10000 * part, kappa, options=options)
        kinetic = table["c_E[1]"]
        assert kinetic[-1] < 0.02 * kinetic[0], "the kinetic energy has not become heat"
        errors.append(np.abs(table["c_E"] - table["c_E"][0]).max() / kinetic[0])
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    print(f"half of {stable}: errors {errors}, orders {orders}")
    assert errors[0] < 1e-6
    assert (orders > 1.8).all()


@pytest.mark.parametrize("kappa", [0.0, 0.4])
def test_entropy_grows_along_a_run(lammps, kappa):
    """At every output the power is positive, also under Stokes' hypothesis, and it adds up to what the run lost."""
    table, _ = vortices(lammps, 0.01, 4000, kappa)
    assert (table["c_Q"] > 0.0).all()
    heat = (0.5 * (table["c_Q"][1:] + table["c_Q"][:-1]) * np.diff(table["Time"])).sum()
    mechanical = table["c_E[1]"] + table["PotEng"]
    assert heat == pytest.approx(mechanical[0] - mechanical[-1], rel=1e-3)
