"""Keyword thixotropy of pair_coeff: a structure parameter of each particle that acts on its viscosity.

The references are the exact solution for a given rate of shear, and the sums of test_rheology with mu + mu1 lambda in the place of mu.
"""

import re

import numpy as np
import pytest

from helpers import SUPPORT, disordered, dump, fluid, header, relative
from test_rheology import C0, FULL, HEAT, KAPPA, MU, RATE, RHO0, Reference, run_0

MU1, A, B = 1.5, 0.4, 2.0
KEYWORD = f"thixotropy {MU1} {A} {B}"
ROOM = "atom_style sph/bulk thixotropy\n"


def with_room(text):
    return text.replace("atom_style sph/bulk\n", ROOM)


def step(structure, rate, dt, a=A, b=B):
    """Exact for a constant rate."""
    speed = a + b * rate
    return a / speed + (structure - a / speed) * np.exp(-speed * dt)


def start(lammps, particles, keywords=KEYWORD, model=None, options="", newton="on"):
    """Particles with a structure between 0 and 1 by ID."""
    particles.write(lammps.path("box.data"))
    lines = lammps.path("box.data").read_text().splitlines()
    begin = next(k for k, line in enumerate(lines) if line.startswith("Atoms")) + 2
    for k in range(begin, begin + len(particles)):
        words = lines[k].split()
        lines[k] = " ".join([*words[:4], repr(float(structure_of(float(words[0])))), *words[4:]])
    lammps.path("box.data").write_text("\n".join(lines) + "\n")
    return with_room(header(particles.dim, newton)) + "read_data box.data\n" + (model or fluid(particles.dim, options, mu=MU, kappa=KAPPA, c0=C0, keywords=keywords))


def structure_of(tag):
    return 0.5 + 0.5 * np.sin(tag)


# ---- forces ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("dim, options, law, ranks, newton", [
    (2, "", "", 1, "on"), (2, "shear mg/fr2", "", 2, "on"), (3, "", "", 1, "off"), (2, "volume mass", "", 4, "off"),
    (2, "", "power 0.6 0.01 5", 1, "on"), (2, "simd none", "yield 0.3 40", 2, "off")])
def test_forces_and_heat(lammps, dim, options, law, ranks, newton):
    """Those of the law with mu + mu1 lambda of each particle."""
    particles = disordered(dim, {2: 12, 3: 6}[dim])
    structure = structure_of(np.arange(1, len(particles) + 1))
    mu = MU + MU1 * structure
    laws = {"": lambda g, rho: mu, "power 0.6 0.01 5": lambda g, rho: np.clip(mu * g**-0.4, 0.01, 5.0),
            "yield 0.3 40": lambda g, rho: mu + 0.3 * (1 - np.exp(-40 * g)) / g}
    reference = Reference(particles, "mass" if "mass" in options else "number", shear="mg/fr2" if "fr2" in options else "mg")
    force, _, heat = reference.forces(particles.v, laws[law])
    text = start(lammps, particles, f"{KEYWORD} {law}", options=options, newton=newton)
    lammps(text + "fix FLUID all sph/bulk\ntimestep 0.0001\n" + RATE + HEAT + dump("f", extra="c_G c_Q d_structure") + "run 0\n", ranks=ranks)
    frame = lammps.frame("f")
    assert relative(frame["d_structure"] - structure, structure) < 1e-15
    assert relative(frame["f"] - force, force) < 1e-12
    assert relative(frame["c_Q"] - heat[0] - heat[1], heat[0]) < 1e-12


def test_types(lammps):
    """Types with other numbers, and without structure, are other fluids; equal ones are one fluid."""
    particles = disordered(2, 12, ntypes=3)
    structure = np.where(particles.type == 2, 0.0, structure_of(np.arange(1, len(particles) + 1)))
    model = "pair_style sph/bulk\n" + "".join(f"pair_coeff {k} {k} {RHO0} {C0} {MU} {KAPPA} {SUPPORT[2]} {words}\n"
                                              for k, words in ((1, KEYWORD), (2, ""), (3, KEYWORD)))
    second = particles.type == 2
    for other, like in ((KEYWORD, second[:, None] == second[None]), ("thixotropy 1.5 0.4 2.1", particles.type[:, None] == particles.type[None])):
        force = Reference(particles).forces(particles.v, lambda g, rho: MU + MU1 * structure, like=like)[0]
        text = start(lammps, particles, model=model[:model.rindex(KEYWORD)] + other + "\n")
        result = lammps(text + "fix FLUID all sph/bulk\ntimestep 0.0001\n" + dump("f", extra="d_structure") + "run 0\n", ranks=2)
        assert any("have values of d_structure, which their type does not have" in line for line in result.warnings)
        frame = lammps.frame("f")
        assert np.array_equal(frame["d_structure"], structure)
        assert relative(frame["f"] - force, force) < 1e-12


# ---- the structure in time ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("integrator, ranks", [("", 1), ("viscous rkl2", 2)])
def test_each_step_is_exact(lammps, integrator, ranks):
    """From one step to the next, with the rate of shear of the last forces."""
    particles = disordered(2, 12, speed=0.5)
    text = start(lammps, particles)
    lammps(text + f"fix FLUID all sph/bulk {integrator}\ntimestep 0.01\n" + dump("s", every=1, extra="d_structure d_shear_rate") + "run 10\n", ranks=ranks)
    frames = lammps.frames("s")
    assert len(frames) == 11 and np.ptp(frames[5]["d_shear_rate"]) > 0.1
    for before, after in zip(frames, frames[1:]):
        assert np.abs(after["d_structure"] - step(before["d_structure"], before["d_shear_rate"], 0.01)).max() < 1e-14


def couette(keywords=KEYWORD, structure=0.25, gap=6, options="kernel quintic shear mg/fr2", integrator="", dt=0.01):
    """Walls and fluid with the linear profile of Couette flow of the rate v_rate."""
    return f"""units lj
dimension 2
boundary p f p
{ROOM}lattice sq 1.0 origin 0.5 0.5 0
region box block 0 8 -4 {gap + 4} -0.5 0.5 units box
create_box 1 box
create_atoms 1 box
region low block INF INF INF 0 INF INF units box
region high block INF INF {gap} INF INF INF units box
group low region low
group high region high
group fluid subtract all low high
set group all mass 1.0
set group fluid d_structure {structure}
pair_style sph/bulk {options}
pair_coeff 1 1 {RHO0} {C0} {MU} {KAPPA} 3.0 {keywords}
variable rate equal 0.0
variable speed equal v_rate*{gap}
variable profile atom v_rate*y
velocity fluid set v_profile 0 0
fix FLUID fluid sph/bulk {integrator}
fix low low sph/wall
fix high high sph/wall velocity v_speed 0 0 move no
timestep {dt}
compute s all property/atom d_structure d_shear_rate
compute mean fluid reduce ave c_s[1] c_s[2]
compute least fluid reduce min c_s[1]
compute most fluid reduce max c_s[1]
thermo_style custom step time c_mean[1] c_mean[2] c_least c_most f_high[1]
thermo 20
{FULL}"""


def jump(rate):
    return f"variable rate equal {rate}\nvelocity fluid set v_profile 0 0\n"


@pytest.mark.parametrize("ranks", [1, 2])
def test_at_rest(lammps, ranks):
    """The structure builds up as 1 - e^(-a t), to round-off."""
    table = lammps(couette() + "run 500\n", ranks=ranks).thermo()[-1]
    exact = 1.0 - 0.75 * np.exp(-A * table["Time"])
    for column in ("c_mean[1]", "c_least", "c_most"):
        assert np.abs(table[column] - exact).max() < 1e-12


@pytest.mark.parametrize("integrator", ["", "viscous rkl2"])
def test_couette_flow_with_jumps_of_the_rate(lammps, integrator):
    """Structure and stress at a steady rate, and after it jumps up and down: exponentials with a + b rate.

    The rate of shear of a lattice in this kernel is within 1 % of the exact one; that of the fluid near walls within 2 %."""
    rates = 0.1, 0.5, 0.05
    text = couette(integrator=integrator, structure=1.0) + "".join(jump(rate) + "run 500\n" for rate in rates)
    tables = lammps(text).thermo()
    structure = 1.0
    for rate, table in zip(rates, tables):
        exact = step(structure, rate, table["Time"] - table["Time"][0])
        structure = exact[-1]
        assert np.abs(table["c_mean[1]"] - exact).max() < 0.01
        assert np.abs(table["c_most"] - exact).max() < 0.02 and np.abs(table["c_least"] - exact).max() < 0.02
        stress = (MU + MU1 * exact) * rate
        assert np.abs(table["f_high[1]"][1:] / 8.0 + stress[1:]).max() < 0.03 * stress.max()
    assert np.ptp([table["c_mean[1]"][-1] for table in tables]) > 0.3


def test_steady_state(lammps):
    """a/(a + b rate) after a long time."""
    table = lammps(couette(keywords="thixotropy 1.5 4 20") + jump(0.2) + "run 600\n").thermo()[-1]
    assert table["c_mean[1]"][-1] == pytest.approx(0.5, rel=0.01)
    assert abs(table["f_high[1]"][-1]) / 8.0 == pytest.approx((MU + 0.5 * MU1) * 0.2, rel=0.02)


def test_large_steps_stay_between_0_and_1(lammps):
    table = lammps(couette(keywords="thixotropy 1.5 1e6 1e9") + jump(0.2) + "run 20\n").thermo()[-1]
    assert 0.0 < table["c_least"].min() and table["c_most"].max() <= 1.0


# ---- files, adapt, refinement ------------------------------------------------------------------------------------


def state(name):
    return f"write_dump all custom {name} id x y vx vy fx fy d_shear_rate d_structure modify sort id format float %.17g\n"


@pytest.mark.parametrize("integrator", ["", "viscous rkl2"])
def test_runs_restarts_and_ranks(lammps, integrator):
    """Two runs, a restart file between them, and other numbers of ranks are one long run."""
    text = couette(integrator=integrator) + jump(0.2)
    again = text[text.index("variable rate equal 0.0"):].replace("velocity fluid set v_profile 0 0\n", "")
    lammps(text + "write_data start.data nocoeff\n")
    text = text[:text.index("lattice")] + "read_data start.data\n" + text[text.index("region low"):].replace("set group fluid d_structure 0.25\n", "")
    lammps(text + "run 20\n" + state("one"))
    lammps(text + "run 8\nwrite_restart r\nrun 12\n" + state("two"))
    lammps("read_restart r\n" + again + "run 12\n" + state("three"))
    lammps(text + "run 20\n" + state("four"), ranks=4)
    one = lammps.frame("one")
    for name in ("two", "three", "four"):
        other = lammps.frame(name)
        for column in ("y", "vx", "fx", "d_shear_rate", "d_structure"):
            assert relative(other[column] - one[column], one[column]) < 1e-10, (name, column)


def test_data_file_and_adapt(lammps):
    """write_data keeps numbers and structure; fix adapt varies mu1."""
    particles = disordered(2, 12)
    text = start(lammps, particles) + "fix FLUID all sph/bulk\ntimestep 0.0001\n"
    lammps(text + dump("f", extra="d_structure") + "run 0\nwrite_data out.data\n")
    frame = lammps.frame("f")
    lammps(with_room(header(2)) + "pair_style sph/bulk\nread_data out.data\nfix FLUID all sph/bulk\ntimestep 0.0001\n" + dump("d", extra="d_structure") + "run 0\n")
    assert relative(lammps.frame("d")["f"] - frame["f"], frame["f"]) < 1e-13
    assert relative(lammps.frame("d")["d_structure"] - frame["d_structure"], frame["d_structure"]) < 1e-15
    adapted = text.replace(KEYWORD, f"thixotropy 0.7 {A} {B}") + f"variable m equal {MU1}\nfix A all adapt 1 pair sph/bulk thixotropy * * v_m\n"
    lammps(adapted + dump("a") + "run 0\n")
    assert relative(lammps.frame("a")["f"] - frame["f"], frame["f"]) < 1e-13


def test_set_type_drops_the_structure(lammps):
    """Of a type without it; particles that come back begin without structure."""
    particles = disordered(2, 12, ntypes=2)
    model = f"pair_style sph/bulk\npair_coeff 1 1 {RHO0} {C0} {MU} {KAPPA} {SUPPORT[2]} {KEYWORD}\npair_coeff 2 2 {RHO0} {C0} {MU} {KAPPA} {SUPPORT[2]}\n"
    text = start(lammps, particles, model=model) + "fix FLUID all sph/bulk\ntimestep 0.0001\nrun 0\ngroup one type 1\nset group one type 2\n"
    result = lammps(text + dump("s", extra="d_structure") + "run 0\nset group one type 1\nrun 0\n")
    assert sum("have values of d_structure, which their type does not have" in line for line in result.warnings) == 2
    assert all(np.all(frame["d_structure"] == 0.0) for frame in lammps.frames("s"))


def test_splits_keep_the_structure(lammps):
    """Daughters have that of their parent."""
    text = couette(options="volume mass", structure=0.3).replace("thermo_style", "fix R fluid sph/refine 1 volume 0.25\nthermo_style")
    result = lammps(text.replace("step time", "step time atoms") + "thermo 1\nrun 2\n")
    table = result.thermo()[-1]
    assert table["Atoms"][-1] > 1.5 * table["Atoms"][0]
    exact = step(0.3, 0.0, table["Time"])
    assert np.abs(table["c_least"] - exact).max() < 1e-12 and np.abs(table["c_most"] - exact).max() < 1e-12


def test_table_has_the_largest_viscosity(lammps):
    log = lammps(couette() + "run 0\n").log
    line = next(line for line in log.splitlines() if line.startswith("  1-1")).split("|")[0].split()
    header_line = next(line for line in log.splitlines() if "largest_mu" in line).split("|")[0].split()
    assert float(line[header_line.index("largest_mu")]) == MU + MU1 and float(line[header_line.index("mu1")]) == MU1


# ---- bad input ---------------------------------------------------------------------------------------------------

COEFF = f"pair_coeff * * 1 10 0.5 2 {SUPPORT[2]} "


@pytest.mark.parametrize("words", ["0 1 1", "-1 1 1", "1 -1 1", "1 1 -1", "1 0 0"])
def test_numbers(lammps, words):
    result = lammps(couette(f"thixotropy {words}") + "run 0\n", check=False)
    assert result.code == 1 and "thixotropy must have mu1 > 0, a >= 0, b >= 0, and one of a and b > 0" in result.error


@pytest.mark.parametrize("value", ["-1", "-0.1", "1.1"])
def test_structure_is_between_0_and_1(lammps, value):
    result = lammps(couette(structure=value) + "run 0\n", check=False, ranks=2)
    assert result.code == 1 and "d_structure must be >= 0 and <= 1, which that of particle" in result.error


@pytest.mark.parametrize("change, words", [
    (("atom_style sph/bulk thixotropy", "atom_style sph/bulk"), "use atom_style"),
    (("pair_style sph/bulk kernel quintic shear mg/fr2", "pair_style sph/bulk limit yes"), "cannot be used with limit"),
    (("pair_style sph/bulk kernel quintic shear mg/fr2", "pair_style sph/bulk shear morris"), "requires pair style sph/bulk with shear mg or mg/fr2"),
    (("pair_style sph/bulk kernel quintic shear mg/fr2", "pair_style sph/bulk temp 0.1 5"), "cannot be used with temp"),
    (("fix FLUID fluid sph/bulk", "fix FLUID fluid sph/bulk viscous implicit"), "use viscous rkl2"),
    (("thermo 20", "write_dump all custom d.dump id type x y vx vy\nrerun d.dump dump x y vx vy"), "snapshots have no states of the particles")])
def test_refused(lammps, change, words):
    text = couette()
    assert change[0] in text
    text = text.replace(*change)
    if "thixotropy\n" not in text:
        text = re.sub(r"set group fluid d_structure.*\n|compute (s|mean|least|most).*\n|thermo_style.*\n", "", text)
    result = lammps(text + "run 0\n", check=False, ranks=2)
    assert result.code == 1 and words in result.error, result.output[-800:]
