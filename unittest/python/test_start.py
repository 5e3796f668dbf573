"""The state of the fluid before the first step: the report, its warnings, and masses for a mean density rho0."""

import re
from dataclasses import replace

import numpy as np
import pytest

import test_wall as walls
from helpers import INTEGRATE, SUPPORT, disordered, drop, dump, fluid, free, header, lattice
from test_combinations import combined, write as write_case
from test_layers import stages_of_page
from test_micropolar import spins, write

MICRO = "sph/micropolar"
NORMS = {1: 1.5, 2: 7 / np.pi, 3: 10.5 / np.pi}
DENSITY = "fix FLUID all sph/bulk density rho0\ntimestep 0.005\n"


def number_density(particles, support, periodic=True):
    """The sum over the kernel, wendland/c2."""
    r = particles.x[:, None] - particles.x
    length = particles.hi - particles.lo
    if periodic:
        r -= length * np.round(r / length)
    q = np.minimum(np.linalg.norm(r, axis=2) / support, 1.0)
    return NORMS[particles.dim] / support**particles.dim * ((1 - q) ** 4 * (1 + 4 * q)).sum(axis=1)


def report(result):
    """Rows by type: particles, with full support, mean, spread, smallest, largest density over rho0, mean pressure."""
    lines = re.search(r"^  type +particles.*\n((?:  \d+ .*\n)+)", result.log, re.MULTILINE)[1].splitlines()
    return {int(row[0]): row[1:] for row in (list(map(float, line.replace("|", " ").split())) for line in lines)}


def round_drop(radius, mass):
    """On a square lattice, at rest."""
    particles = lattice(2, 2 * int(radius) + 2)
    particles.x[:, :2] -= radius + 1.0
    particles = particles.where(np.linalg.norm(particles.x, axis=1) < radius)
    reach = np.array([4.0 * radius, 4.0 * radius, 0.5])
    return replace(particles, mass=np.full(len(particles), mass), lo=-reach, hi=reach)


def far(result):
    return [line for line in result.warnings if "is far from its rho0" in line]


# ---------------------------------------------------------------------------------------------
# report and warning


@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "on"), (4, "off")])
def test_report(lammps, ranks, newton):
    """Mean, spread, extremes, and pressure of each type."""
    particles = disordered(2, 14, jitter=0.15, ntypes=2)
    particles.write(lammps.path("box.data"))
    coeff = "pair_coeff 1 1 1.0 10.0 0.5 2.0 3.0 pb 0.5\npair_coeff 2 2 0.95 7.0 0.5 2.0 3.0\n"
    rows = report(lammps(header(2, newton=newton) + "read_data box.data\n" + fluid(2, coeff=coeff) + INTEGRATE + "run 0\n",
                         ranks=ranks))
    rho = particles.mass * number_density(particles, 3.0)
    for kind, rho0, c0, pb in ((1, 1.0, 10.0, 0.5), (2, 0.95, 7.0, 0.0)):
        own = rho[particles.type == kind]
        x = own / rho0
        want = [len(own), len(own), x.mean(), x.std(), x.min(), x.max(), c0**2 * (own - rho0).mean() + pb]
        assert rows[kind][:2] == want[:2]
        np.testing.assert_allclose(rows[kind][2:3] + rows[kind][4:6], want[2:3] + want[4:6], atol=6e-7)
        assert rows[kind][3] == pytest.approx(want[3], rel=0.06)
        assert rows[kind][6] == pytest.approx(want[6], rel=6e-4)


def test_report_leaves_out_free_surfaces(lammps):
    """The particles with full support of a drop have the density of the lattice."""
    particles = round_drop(12.0, 1.0)
    particles.write(lammps.path("drop.data"))
    row = report(lammps(header(2, boundary=free(2)) + "read_data drop.data\n" + fluid(2) + INTEGRATE + "run 0\n", ranks=2))[1]
    assert row[0] == len(particles) and 50 < row[1] < 0.7 * len(particles)
    assert row[2] == pytest.approx(number_density(lattice(2, 12), 3.0)[0], abs=6e-7)
    assert row[3] < 1e-7


@pytest.mark.parametrize("mass, rho0, warned", [(1.0, 1000.0, True), (1000.0, 1000.0, False), (1.2, 1.0, True),
                                                (0.8, 1.0, True), (1.05, 1.0, False)])
def test_mean_density_far_from_rho0_is_a_warning(lammps, mass, rho0, warned):
    lattice(2, 12).write(lammps.path("box.data"))
    result = lammps(header(2) + f"read_data box.data\nset group all mass {mass}\n"
                    + fluid(2, rho0=rho0, mu=0.5 * rho0, kappa=rho0, c0=3.0) + INTEGRATE + "run 0\nrun 0\n")
    assert len(far(result)) == warned, result.warnings
    if warned:
        assert f"rho0 {rho0:g}" in far(result)[0] and "keyword density of fix sph/bulk" in far(result)[0]


# ---------------------------------------------------------------------------------------------
# keyword density


@pytest.mark.parametrize("dim, ranks, newton", [(1, 1, "on"), (2, 1, "on"), (2, 2, "off"), (2, 4, "on"), (3, 2, "on")])
def test_mean_density_of_each_type_is_rho0(lammps, dim, ranks, newton):
    """One factor for all masses of a type; nothing else changes.  The forces are those of the new masses."""
    cells = {1: 40, 2: 14, 3: 7}[dim]
    particles = disordered(dim, cells, jitter=0.15, ntypes=2)
    particles.write(lammps.path("box.data"))
    model = fluid(dim, coeff="".join(f"pair_coeff {k} {k} {rho0} 10.0 0.5 2.0 {SUPPORT[dim]}\n"
                                     for k, rho0 in ((1, 1.3), (2, 0.7))))
    text = header(dim, newton=newton) + "read_data box.data\n" + model
    lammps(text + DENSITY + dump("new.dump") + "run 0\n" + "write_data new.data\n", ranks=ranks)
    new = lammps.frame("new.dump")
    for kind, rho0 in ((1, 1.3), (2, 0.7)):
        own = new["type"] == kind
        assert new["rho"][own].mean() == pytest.approx(rho0, rel=1e-13)
        factor = new["mass"][own] / particles.mass[own]
        np.testing.assert_allclose(factor, factor[0], rtol=1e-14)
        assert abs(factor[0] - 1.0) > 0.05
    for name, values in (("x", particles.x), ("v", particles.v), ("esph", particles.esph)):
        np.testing.assert_allclose(new[name], values, rtol=1e-13, atol=1e-13)
    replace(particles, mass=new["mass"]).write(lammps.path("box.data"))
    lammps(text + INTEGRATE + dump("given.dump") + "run 0\n", ranks=ranks)
    given = lammps.frame("given.dump")
    for name in ("f", "rho", "desph"):
        assert np.abs(given[name] - new[name]).max() < 1e-13 * np.abs(given[name]).max()


def test_drop_has_rho0_inside(lammps):
    particles = round_drop(12.0, 1.1)
    particles.write(lammps.path("drop.data"))
    result = lammps(header(2, boundary=free(2)) + "read_data drop.data\n" + fluid(2) + DENSITY + dump("drop.dump") + "run 0\n")
    frame = lammps.frame("drop.dump")
    inside = np.linalg.norm(frame["x"][:, :2], axis=1) < 6.0
    np.testing.assert_allclose(frame["rho"][inside], 1.0, rtol=1e-12)
    assert frame["rho"].min() < 0.8
    assert not any("near a free surface" in line for line in result.warnings)


def test_small_drop_is_a_warning(lammps):
    particles = drop(2, 3.0, speed=0.0, rate=0.0)
    particles.write(lammps.path("drop.data"))
    result = lammps(header(2, boundary=free(2)) + "read_data drop.data\n" + fluid(2) + DENSITY + dump("drop.dump") + "run 0\n")
    assert sum("all particles of type 1 are near a free surface" in line for line in result.warnings) == 1
    assert lammps.frame("drop.dump")["rho"].mean() == pytest.approx(1.0, rel=1e-13)


def test_walls_keep_their_masses(lammps):
    """The mean is over the fluid, with the particles of the walls among its neighbors."""
    particles, owner = walls.channel(2)
    particles = replace(particles, mass=np.full(len(particles), 1.1))
    model = walls.one_fluid(2)
    walls.save(lammps, particles, model)
    text = walls.start(model, owner, [{}, {}]).replace("fluid sph/bulk\n", "fluid sph/bulk density rho0\n")
    lammps(text + dump("out.dump") + "run 0\n")
    frame = lammps.frame("out.dump")
    assert (frame["mass"][owner >= 0] == 1.1).all()
    assert frame["rho"][owner < 0].mean() == pytest.approx(1.0, rel=1e-12)


def test_only_the_group(lammps):
    particles = disordered(2, 14, jitter=0.1)
    particles.write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\n" + fluid(2) + "region R block INF 7 INF INF INF INF\ngroup A region R\n"
           "group B subtract all A\nfix 1 A sph/bulk density rho0\nfix 2 B sph/bulk density keep\n"
           + dump("out.dump") + "run 0\n")
    frame = lammps.frame("out.dump")
    own = particles.x[:, 0] < 7.0
    assert frame["rho"][own].mean() == pytest.approx(1.0, rel=1e-13)
    np.testing.assert_allclose(frame["mass"][~own], particles.mass[~own], rtol=1e-15)


@pytest.mark.parametrize("order", [0, 1])
def test_restart_does_not_repeat(lammps, order):
    """Once, in the first run: neither in the second nor after a restart; with and without inertia to be set."""
    particles = disordered(2, 13, jitter=0.15)
    write(particles, lammps.path("box.data"), spins(particles))
    pair = walls.pair_commands(walls.one_fluid(2, MICRO))
    words = " ".join(["density rho0", "inertia 0.2 0.1"][::(-1 if order else 1)])
    fix = f"fix FLUID all {MICRO} {words}\ntimestep 0.002\n"
    out = "dump D all custom 1 out.dump id xu yu zu vx vy vz mass\ndump_modify D sort id format float %.17g\n"
    lammps(header(2, style=MICRO) + "read_data box.data\n" + pair + fix + out + "run 20\nrun 20\nwrite_restart half\nrun 20\n",
           ranks=2)
    through = lammps.frame("out.dump")
    for k in (20, 40):
        np.testing.assert_array_equal(lammps.frames("out.dump")[k]["mass"], through["mass"])
    result = lammps("read_restart half\n" + pair + fix + out + "run 20\n")
    assert "mean density rho0" not in result.log.split("run 20")[1]
    again = lammps.frame("out.dump")
    np.testing.assert_array_equal(again["mass"], through["mass"])
    np.testing.assert_allclose(again["x"], through["x"], rtol=1e-11, atol=1e-11)


def test_restart_of_a_fluid_without_spin(lammps):
    disordered(2, 12).write(lammps.path("box.data"))
    out = dump("out.dump", 10)
    lammps(header(2) + "read_data box.data\n" + fluid(2) + DENSITY + out + "run 30\nwrite_restart half\n")
    first = lammps.frame("out.dump")
    lammps("read_restart half\n" + DENSITY + out + "run 30\n")
    np.testing.assert_array_equal(lammps.frame("out.dump")["mass"], first["mass"])
    # without the keyword in the run before, nothing is in the file: it acts
    lammps(header(2) + "read_data box.data\n" + fluid(2) + INTEGRATE + "run 30\nwrite_restart half\n")
    result = lammps("read_restart half\n" + DENSITY + "run 0\n")
    assert "for the mean density rho0" in result.log


@pytest.mark.parametrize("keywords, expected_words", [
    ("density", ["[Mm]issing", "density"]), ("density 1.0", ["density must be rho0 or keep, not 1.0"]),
    ("density yes", ["density must be rho0 or keep"]), ("density rho0 keep", ["keyword: keep"])])
def test_refused(lammps, keywords, expected_words):
    disordered(2, 8).write(lammps.path("box.data"))
    walls.refused(lammps, header(2) + "read_data box.data\n" + fluid(2) + f"fix FLUID all sph/bulk {keywords}\nrun 0\n",
                  expected_words, 1)


def test_needs_pair_style_and_masses(lammps):
    disordered(2, 8).write(lammps.path("box.data"))
    start = header(2) + "read_data box.data\n"
    walls.refused(lammps, start + "pair_style zero 3.0\npair_coeff * *\n" + DENSITY + "run 0\n",
                  ["density requires pair style sph/bulk"], 1)
    walls.refused(lammps, header(2) + "lattice sq 1.0\nregion B block 0 8 0 8 -0.5 0.5\ncreate_box 1 B\ncreate_atoms 1 box\n"
                  + fluid(2) + DENSITY + "run 0\n", ["mass must be > 0"], 2)


@pytest.mark.parametrize("ranks", [1, 2])
def test_density_rho0_with_reference_volumes(lammps, ranks):
    """volume mass: walls keep their masses, two types have masses that depend on each other."""
    text = """
units lj
dimension 2
atom_style sph/bulk
lattice sq 1.0 origin 0.5 0.5 0
region box block 0 12 0 18 -0.5 0.5
create_box 3 box
create_atoms 1 box
region floor block INF INF INF 3 INF INF
region lid block INF INF 15 INF INF INF
region upper block INF INF 9 15 INF INF
set region floor type 3
set region lid type 3
set region upper type 2
group fluid type 1 2
group walls type 3
displace_atoms fluid random 0.1 0.1 0 4711
set type 1 mass 3.0
set type 2 mass 0.2
set type 3 mass 1.0
pair_style sph/bulk volume mass
pair_coeff * * 1.0 10.0 0.5 2.0 3.0
pair_coeff 2 2 0.5 10.0 0.5 2.0 3.0
fix 1 fluid sph/bulk density rho0
fix W walls sph/wall
run 0
"""
    log = lammps(text, ranks=ranks).log
    for type_ in (1, 2):
        row = re.search(rf"^  {type_} +\d+ +\d+ +\| (\S+)", log, re.MULTILINE)
        assert abs(float(row[1]) - 1.0) < 2e-6, log


@pytest.mark.parametrize("volume", ["number", "mass"])
@pytest.mark.parametrize("scale", [0.1, 10.0])
def test_state_in_other_lengths(lammps, volume, scale):
    """The same drop with another length and mass: the same numbers of full support, density and spread."""
    def rows(factor):
        particles = drop(2, 8.0, seed=3)
        replace(particles, x=factor * particles.x, mass=factor**2 * particles.mass, esph=factor**2 * particles.esph,
                lo=factor * particles.lo, hi=factor * particles.hi).write(lammps.path("drop.data"))
        log = lammps(header(2, boundary=free(2)) + "read_data drop.data\n"
                     + fluid(2, f"volume {volume}", support=3.0 * factor) + INTEGRATE + "run 0\n").log
        return re.search(r"^  1 +(\d+) +(\d+) +\| (\S+) +(\S+)", log, re.MULTILINE).groups()

    here, there = rows(1.0), rows(scale)
    assert 0 < int(here[1]) < int(here[0])
    assert here == there


def test_minimize_first(lammps):
    """The masses are set by a minimization, too, if it comes first."""
    lammps("""
units lj
dimension 2
atom_style sph/bulk
lattice hex 1.0
region box block 0 8 0 6 -0.5 0.5
create_box 1 box
create_atoms 1 box
set group all mass 2.0
pair_style sph/bulk
pair_coeff * * 1.0 10.0 0.5 2.0 3.0
fix 1 all sph/bulk density rho0
minimize 0.0 1e-8 10 10
write_dump all custom x.dump id mass modify format float %.17g
""")
    assert np.abs(lammps.frame("x.dump")["mass"] - 1.0).max() < 0.02


# ---------------------------------------------------------------------------------------------
# times of the stages, timer full


STAGES = {("gravity",): "densities pressures pairs forces",
          ("implicit", "heat"): "guess densities pressures pairs forces velocities aside densities pressures pairs forces temperatures "
                                "restored densities pressures pairs forces flows totals",
          ("rkl2", "thinning"): "guess densities shear rates pressures pairs forces velocities densities pressures pairs forces totals",
          ("walls", "noise", "limit"): "numbers densities wall volumes bound pressures walls noise pairs wall friction forces repulsion",
          ("walls", "warm"): "numbers densities wall volumes pressures walls wall energies noise pairs wall friction forces repulsion totals work",
          ("surface", "walls"): "densities wall volumes pressures walls pairs forces repulsion diffusion diffusion heat",
          ("open", "tension"): "densities pressures zones pairs tension forces ledger"}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("names", STAGES)
def test_times_of_stages(lammps, ranks, names):
    """Those of the page, in an order in which each has what it needs; each runs once in a step, or as often as it is listed."""
    page = stages_of_page()
    write_case(lammps.folder, "case", combined(names))
    lammps("timer full\n" + write_case(lammps.folder, "case", combined(names)) + "timer normal\nrun 5\n", ranks=ranks)
    log = lammps.path("case.log").read_text()
    tables = re.findall(r"^Stages of pair style \S+:\n.*\n-+\n((?:.*\|.*\n)+)\nMPI task", log, re.M)
    assert len(tables) == 2 == log.count("MPI task timing breakdown") - 2    # run 5 twice; not run 0, not without full
    loops = [float(time) for time in re.findall(r"^Loop time of (\S+) on", log, re.M)]
    for table, loop in zip(tables, loops):
        rows = [[word.strip() for word in row.split("|")] for row in table.splitlines()]
        assert " ".join(name for name, *_ in rows) == STAGES[names]
        left = {"MOTION", "TEMPERATURES"}
        for name, *numbers in rows:
            needs, leaves = page[name]
            assert left.issuperset(needs)
            left.update(leaves)
            calls, least, mean, most, part = map(float, numbers)
            assert calls == 5 and 0.0 < least <= mean * 1.0001 and mean <= most * 1.0001
            assert abs(part - 100.0 * mean / loop) < 0.1 * part + 0.1
        assert sum(float(row[3]) for row in rows) < loop
