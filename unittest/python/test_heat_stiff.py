"""Conduction of heat at time steps far beyond its explicit limit: keyword viscous of fix sph/bulk."""

import re

import numpy as np
import pytest

import test_heat as heat
import test_viscous as viscous
from helpers import disordered, dump, fluid, header, lattice, relative
from sph_dissipation import exponents

SCHEMES, SECOND_ORDER = viscous.SCHEMES, viscous.SECOND_ORDER
TEMPERATURE, FULL = heat.TEMPERATURE, heat.FULL


def tight(name, tolerance=1e-12):
    return SCHEMES[name] + ("" if name == "rkl2" else f" tolerance {tolerance}")


def steps_of(log):
    """Largest stable time steps of the table, by column; the smallest of all pairs of types."""
    head = re.search(r"^  types .*$", log, re.MULTILINE)[0].split("step:")[1].split()
    rows = [words.split() for words in re.findall(r"^  \d-\d .*\| +(.*)$", log, re.MULTILINE)]
    return {name: min(np.inf if word == "-" else float(word) for word in column) for name, column in zip(head, zip(*rows))}


# ---- accuracy ----------------------------------------------------------------------------------------------------


def wave(lammps, keywords, timestep, end, N=48, R=4.0, cv=2.0, k=1.0):
    """Amplitude at the end of a temperature wave on a line of particles, over that at the start; the mean temperature."""
    heat.line(N).write(lammps.path("box.data"))
    lammps(header(1) + f"read_data box.data\npair_style sph/bulk dim 1 shear none\npair_coeff * * 1.0 1.0 0.0 0.0 {R / N} cv {cv} conductivity {k}\n"
           f"variable T atom 1.0+0.1*cos(2*PI*x)\nfix FLUID all sph/bulk temperature v_T {keywords}\nfix HOLD all setforce 0 0 0\n"
           f"timestep {timestep}\n" + TEMPERATURE + dump("T.dump", round(end / timestep), "c_T") + f"run {round(end / timestep)}\n")
    first, last = lammps.frames("T.dump")
    shape = np.cos(2 * np.pi * first["x"][:, 0])
    start, left = (2 / N * (frame["c_T"] * shape).sum() for frame in (first, last))
    assert last["c_T"].mean() == pytest.approx(1.0, abs=1e-13)
    assert np.abs(last["c_T"] - 1.0 - left * shape).max() < 1e-9, "no other wave"
    return left / start


@pytest.mark.parametrize("name", SCHEMES)
def test_temperature_wave(lammps, name):
    """At 20 times the explicit limit, and at less, with the order of the scheme: the rate is the sum over the line."""
    N, R, cv, k, end = 48, 4.0, 2.0, 1.0, 0.18
    sums = heat.Line(N, R)
    rate = k / (sums.c / N * cv) * sums.K
    errors = [np.log(wave(lammps, tight(name), step, end, N, R, cv, k)) + rate * end for step in (0.0075, 0.00375, 0.001875)]
    print(name, errors)
    assert 0.0075 > 20.0 * steps_of(lammps.results[-1].log)["heat"]
    assert abs(errors[0]) < (0.006 if name in SECOND_ORDER else 0.25)
    assert errors[1] / errors[2] == pytest.approx(4.0 if name in SECOND_ORDER else 2.0, rel=0.1)


# ---- conservation, entropy, extrema ------------------------------------------------------------------------------


TWO = [dict(heat.AT_REST, k=0.7), dict(heat.AT_REST, k=3.0, cv=1.2)]
CAPACITY = np.array([0.0, 2.5, 1.2])  # by type
RANDOM = "1.0+{}*(1+sin(12.9*id))"


def at_rest(lammps, keywords, temperature, factor=30.0, ranks=1, newton="on", steps=12):
    """Frames of particles at rest with two conductivities, at a multiple of the explicit limit."""
    disordered(2, 14, speed=0.0, ntypes=2).write(lammps.path("box.data"))
    text = (header(2, newton) + "read_data box.data\n" + heat.model("linear", TWO, 2) + f"variable T atom {temperature}\n"
            f"fix FLUID all sph/bulk temperature v_T {keywords}\nvelocity all set 0 0 0\nfix HOLD all setforce 0 0 0\n")
    step = factor * steps_of(lammps(text + "timestep 1e-9\nrun 0\n", ranks=ranks).log)["heat"]
    lammps(text + TEMPERATURE + f"timestep {step}\n" + dump("T.dump", extra="c_T") + f"run {steps}\n", ranks=ranks)
    return lammps.frames("T.dump")


@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "on"), (2, "off")])
@pytest.mark.parametrize("name", SCHEMES)
def test_energy_and_entropy(lammps, name, ranks, newton):
    """From random temperatures, at any tolerance: the energy stays to round-off, the entropy never falls."""
    for tolerance in ([1e-1, 1e-8] if ranks == 1 and name != "rkl2" else [1e-6]):
        frames = at_rest(lammps, tight(name, tolerance), RANDOM.format(0.25), ranks=ranks, newton=newton)
        energy = np.array([frame["esph"].sum() for frame in frames])
        assert np.ptp(energy) < 1e-13 * abs(energy[0])
        capacity = frames[0]["mass"] * CAPACITY[frames[0]["type"].astype(int)]
        entropy = np.array([(capacity * np.log(frame["c_T"])).sum() for frame in frames])
        assert np.diff(entropy).min() > 0.0
        assert np.ptp(frames[-1]["c_T"]) < 0.02 * np.ptp(frames[0]["c_T"])


@pytest.mark.parametrize("factor", [5.0, 30.0, 1000.0])
@pytest.mark.parametrize("temperature", [RANDOM.format(1e4), "1.0+99.0*(id==30)"])
def test_scheme_euler_has_no_new_extremum(lammps, temperature, factor):
    """In no step, of random temperatures and of one hot particle, to round-off of the highest one at the start."""
    frames = at_rest(lammps, tight("euler"), temperature, factor)
    slack = 1e-12 * frames[0]["c_T"].max()
    for before, after in zip(frames, frames[1:]):
        a, b = before["c_T"], after["c_T"]
        assert b.max() < a.max() + slack and b.min() > a.min() - slack


def test_others_may_have_one(lammps):
    """Near one hot particle, by a small part of the jump."""
    lowest = {}
    for name in SECOND_ORDER:
        for factor in (30.0, 1000.0):
            frames = at_rest(lammps, tight(name), "1.0+99.0*(id==30)", factor, steps=4)
            lowest[name, factor] = min(frame["c_T"].min() for frame in frames) / 99.0
    print(lowest)
    assert -0.03 < min(lowest.values()) < -0.02 and lowest["rkl2", 30.0] < 0.0


# ---- with motion, runs, ranks ------------------------------------------------------------------------------------


def moving(lammps, eos, keywords, timestep, run, ranks=1, newton="on", conductivity=40.0, extra=""):
    """Input of a fluid of two types with thermal pressure, viscosities, and large conductivities."""
    disordered(2, 12, ntypes=2).write(lammps.path("box.data"))
    fluids = [dict(one, kappa_r=0.0, k=conductivity * one["k"]) for one in heat.FLUIDS]
    lammps(header(2, newton) + "read_data box.data\n" + heat.model(eos, fluids, 2) + "variable T atom 3.5+sin(2*PI*x/12)\n" + TEMPERATURE
           + f"fix FLUID all sph/bulk density rho0 temperature v_T {keywords}\ncompute E all sph/energy\nthermo_style custom step c_E\n"
           f"thermo 1\n{FULL}timestep {timestep}\n" + extra + run + dump("out.dump", extra="c_T") + "run 0\n", ranks=ranks)
    return lammps.frame("out.dump")


def distance(one, other, keys=("x", "v", "esph", "c_T")):
    return max(relative(one[key] - other[key], other[key] - other[key].mean(0)) for key in keys)


@pytest.mark.parametrize("eos", ["ideal", "linear"])
def test_second_order_with_motion(lammps, eos):
    """Against explicit steps; kinetic and internal energy together to round-off in every step."""
    end = 0.1
    fine, finer = (moving(lammps, eos, "", step, f"run {round(end / step)}\n") for step in (0.0005, 0.00025))
    exact = {key: finer[key] + (finer[key] - fine[key]) / 3 for key in ("x", "v", "c_T")}
    for name in SCHEMES:
        errors = []
        for step in (0.01, 0.005):
            errors.append(distance(moving(lammps, eos, tight(name), step, f"run {round(end / step)}\n"), exact, exact))
            energy = lammps.results[-1].thermo()[0]["c_E"]
            assert np.ptp(energy) < 1e-13 * abs(energy[0])
        print(eos, name, errors)
        assert 0.01 > 3.0 * steps_of(lammps.results[-1].log)["heat"]
        assert errors[0] > (3.5 if name in ("rkl2", "sdirk2") else 2.7 if name == "trapezoidal" else 1.9) * errors[1]
        assert errors[0] < (0.003 if name in SECOND_ORDER else 0.04)


@pytest.mark.parametrize("name", SCHEMES)
@pytest.mark.parametrize("k", [0.3, 3.0])
def test_sound_of_a_gas(lammps, name, k):
    """From nearly adiabatic to isothermal: frequency and damping of the sums over the line."""
    N, R, cv, dt, every = 64, 5.0, 2.5, 0.0025, 8
    heat.line(N).write(lammps.path("box.data"))
    log = lammps(header(1) + "read_data box.data\npair_style sph/bulk dim 1 shear none bulk density eos ideal\n"
                 f"pair_coeff * * 1.0 1.0 0.0 0.0 {R / N} gamma 1.4 pb 0.4 cv {cv} conductivity {k}\n"
                 f"fix FLUID all sph/bulk temperature 1.0 {tight(name, 1e-9)}\ntimestep {dt}\n"
                 "variable u0 atom 1e-5*sin(2*PI*x)\nvelocity all set v_u0 0 0\nvariable u atom vx*sin(2*PI*x)\n"
                 f"compute U all reduce sum v_u\nthermo_style custom step c_U f_FLUID[5]\nthermo {every}\n{FULL}run 1200\n")
    table = log.thermo()[-1]
    measured = max(exponents(every * dt, table["c_U"], 3), key=lambda s: s.imag)
    sums = heat.Line(N, R)
    rho = sums.c / N
    exact = max(sums.sound(1.0, rho, 0.4, 1.0, rho + 0.4, 0.0, k, cv, rho), key=lambda s: s.imag)
    print(name, measured, exact)
    assert dt > (18.0 if k > 1.0 else 1.8) * steps_of(log.log)["heat"]
    assert measured.imag == pytest.approx(exact.imag, rel=2e-5 if name in SECOND_ORDER else 2e-3)
    assert measured.real == pytest.approx(exact.real, rel=2e-4 if name in SECOND_ORDER else 0.02)
    assert 1 <= table["f_FLUID[5]"][1:].max() < 15


@pytest.mark.parametrize("eos", ["tait", "linear no"])
@pytest.mark.parametrize("name", SCHEMES)
def test_runs_go_on(lammps, name, eos):
    """Without setup, as a second run, from a restart file, on two ranks, with newton off: with thermal pressure and without."""
    eos, *none = eos.split()
    extra = "neighbor 0.1 bin\n" + (" ".join(f"pair_coeff {k} {k} {heat.of_type(eos, dict(one, kappa_r=0.0, gruneisen=0.0, k=40 * one['k']), 3.0)}\n"
                                               for k, one in enumerate(heat.FLUIDS, 1)) if none else "")
    go = lambda run, **settings: moving(lammps, eos, tight(name, 1e-13), 0.01, run, extra=extra, **settings)
    one = go("run 12\n")
    assert distance(go("run 5\nrun 7 pre no\n"), one) < 1e-13
    assert distance(go("run 5\nrun 7\n"), one) < 1e-11
    assert distance(go("run 12\n", ranks=2, newton="off"), one) < 1e-10
    go("run 5\nwrite_restart half.restart\n")
    lammps(f"read_restart half.restart\nfix FLUID all sph/bulk density rho0 temperature v_T {tight(name, 1e-13)}\n"
           + "variable T atom 3.5+sin(2*PI*x/12)\n" + TEMPERATURE + "timestep 0.01\nrun 7\n" + dump("again.dump", extra="c_T") + "run 0\n", ranks=2)
    assert distance(lammps.frame("again.dump"), one) < 1e-10


# ---- steady states -----------------------------------------------------------------------------------------------


def between_two_temperatures(lammps, keywords, timestep, steps, N=40):
    """Two materials between particles that no fix integrates, which keep their energies."""
    particles = heat.line(N)
    x = particles.x[:, 0]
    particles.type[:] = np.where(x < 0.35, 1, 2)
    particles.write(lammps.path("box.data"))
    lammps(header(1) + "read_data box.data\npair_style sph/bulk dim 1 shear none\n"
           + "".join(f"pair_coeff {i} {i} 1.0 1.0 0.0 0.0 {4 / N} cv 1.0 conductivity {k}\n" for i, k in ((1, 1.0), (2, 0.4)))
           + "variable T atom 1.0+(x>0.5)\nfix ALL all sph/bulk temperature v_T\nrun 0\nunfix ALL\n"
           "region FREE block 0.2 0.5 INF INF INF INF\ngroup free region FREE\ngroup held subtract all free\n"
           f"fix FLUID free sph/bulk {keywords}\nfix HOLD all setforce 0 0 0\ntimestep {timestep}\n" + TEMPERATURE
           + f"run {steps}\n" + dump("T.dump", extra="c_T") + "run 0\n")
    return lammps.frame("T.dump")["c_T"]


def test_steady_conduction(lammps):
    expected = between_two_temperatures(lammps, "", 2e-4, 3000)
    assert steps_of(lammps.results[-1].log)["heat"] < 3e-4 and 1.0 < expected[15] < 2.0
    for name in SCHEMES:
        found = between_two_temperatures(lammps, tight(name), 5e-3, 250)
        assert np.abs(found - expected).max() < 1e-8, name


def heated_shear(lammps, keywords, timestep, end=6.0):
    """Temperatures, relative to the mean one, of a fluid that a force drives in waves, and its viscosity heats."""
    lattice(2, (8, viscous.ROWS)).write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\n" + fluid(2, mu=18.0, kappa=40.0, keywords="cv 1.0 conductivity 100.0")
           + f"fix FLUID all sph/bulk temperature 1.0 {keywords}\n" + viscous.WAVE + f"timestep {timestep}\n" + TEMPERATURE
           + f"run {round(end / timestep)}\n" + dump("out.dump", extra="c_T") + "run 0\n")
    T = lammps.frame("out.dump")["c_T"]
    return T - T.mean()


def test_steady_heat_of_a_shear_flow(lammps):
    """The heat that the viscosity makes flows off: temperatures of the explicit step, at the time step of sound."""
    expected = heated_shear(lammps, "", 0.0015)
    assert steps_of(lammps.results[-1].log)["heat"] < 0.1 * viscous.STEP
    for name in SCHEMES:
        error = relative(heated_shear(lammps, tight(name, 1e-9), viscous.STEP) - expected, expected)
        print(name, error)
        assert error < 2e-5, name


def between_walls(lammps, keywords, timestep, end, wall="heat temp 2.0", other="heat temp 1.0", ranks=1, start="1.0+0.5*sin(y)"):
    """Temperatures of a fluid at rest between walls at y = 3 and 17."""
    particles = lattice(2, (6, 20))
    random = np.random.default_rng(5)
    particles.x[:, :2] += random.uniform(-0.1, 0.1, (len(particles), 2))
    particles.write(lammps.path("box.data"))
    steps = round(end / timestep)
    lammps(header(2, boundary="p f p") + "read_data box.data\nregion FLUID block INF INF 3 17 INF INF units box\ngroup fluid region FLUID\n"
           "region LOW block INF INF INF 3 INF INF units box\ngroup low region LOW\ngroup high subtract all fluid low\n"
           + fluid(2, mu=0.0, kappa=0.0, keywords="cv 1.0 conductivity 20.0") + f"variable T atom {start}\n"
           f"fix FLUID fluid sph/bulk temperature v_T {keywords}\nfix L low sph/wall {wall}\nfix H high sph/wall {other}\n"
           f"fix HOLD all setforce 0 0 0\ntimestep {timestep}\n" + TEMPERATURE + f"run {steps}\n" + dump("T.dump", extra="c_T") + "run 0\n", ranks=ranks)
    frame = lammps.frame("T.dump")
    return frame["c_T"][(frame["y"] > 3.0) & (frame["y"] < 17.0)]


@pytest.mark.parametrize("wall, other", [("heat temp 2.0", "heat temp 1.0"), ("heat flux 3.0", "heat temp 1.0")])
def test_heat_at_walls(lammps, wall, other):
    """In time with the order of the scheme, and in the steady state; on two ranks."""
    settings = {"wall": wall, "other": other}
    fine, finer = (between_walls(lammps, "", step, 1.0, **settings) for step in (0.002, 0.001))
    exact = finer + (finer - fine) / 3
    limit = steps_of(lammps.results[-1].log)["heat"]
    steady = between_walls(lammps, "", 0.8 * limit, 80.0, **settings)
    for name in SCHEMES:
        errors = [relative(between_walls(lammps, tight(name), step, 1.0, **settings) - exact, np.ptp(exact)) for step in (0.1, 0.05)]
        ranks = relative(between_walls(lammps, tight(name), 0.1, 1.0, ranks=2, **settings) - between_walls(lammps, tight(name), 0.1, 1.0, **settings), exact)
        last = relative(between_walls(lammps, tight(name), 0.2, 80.0, **settings) - steady, steady)
        print(name, errors, ranks, last)
        assert 0.1 > 8.0 * limit and ranks < 1e-12 and last < 1e-8
        assert errors[0] < (0.01 if name in SECOND_ORDER else 0.03)
        assert errors[0] > (1.9 if name == "euler" else 2.8) * errors[1]


# ---- time step, messages -----------------------------------------------------------------------------------------


def test_table_and_warning(lammps):
    """Conduction limits the explicit step alone; the log says how many stages it takes."""
    heat.line(48).write(lammps.path("box.data"))
    text = header(1) + "read_data box.data\npair_style sph/bulk dim 1 shear none\npair_coeff * * 1.0 1.0 0.0 0.0 0.1 cv 2.0 conductivity 1.0\n"
    for keywords, warned in (("", True), ("viscous rkl2", False), ("viscous implicit", False)):
        result = lammps(text + f"fix FLUID all sph/bulk temperature 1.0 {keywords}\ntimestep 0.005\nrun 1\n")
        steps = steps_of(result.log)
        line = re.search(r"with viscous explicit (\S+), with rkl2 or implicit (\S+); the time step 0.005 times the largest rate of the conduction of "
                         r"heat is (\S+): rkl2 would take (\d+) stages$", result.log, re.MULTILINE)
        assert [float(word) for word in line.groups()[:2]] == pytest.approx([steps["heat"], steps["acoustic"]], rel=1e-3)
        assert float(line[3]) == pytest.approx(0.005 / steps["heat"], rel=1e-2) and int(line[4]) > 3
        assert any("exceeds the largest stable time step" in one for one in result.warnings) == warned


@pytest.mark.parametrize("keywords, words", [
    ("rkl2 stages 3", r"rkl2: the largest viscous rate times the time step is .* at step 1 in the conduction of heat, which needs \d+ stages, not 3"),
    ("rkl2", r"at step 0 in the conduction of heat, which needs .* stages, and 1001 are the most"),
    ("implicit tolerance 1e-12 iterations 2 error", "above the tolerance 1e-12, after 2 iterations at step 0 in the conduction of heat"),
])
def test_errors(lammps, keywords, words):
    heat.line(48).write(lammps.path("box.data"))
    k = 1e6 if keywords == "rkl2" else 1.0
    result = lammps(header(1) + "read_data box.data\npair_style sph/bulk dim 1 shear none\n"
                    f"pair_coeff * * 1.0 1.0 0.0 0.0 0.1 cv 2.0 conductivity {k}\nvariable T atom 1.0+0.1*sin(2*PI*x+x*x)\n"
                    f"fix FLUID all sph/bulk temperature v_T viscous {keywords}\ntimestep 0.005\nrun 10\n", check=False)
    assert result.code and re.search(words, result.error, re.DOTALL), result.output[-800:]


def test_fix_adapt(lammps):
    """A conductivity that another command raises by 30: rkl2 takes more stages at once."""
    stages = moving(lammps, "tait", "viscous rkl2", 0.01, "run 5\n", extra="variable k equal ramp(28,840)\nfix A all adapt 1 pair sph/bulk conductivity 1 1 v_k\n"
                    "thermo_style custom step f_FLUID[5] f_FLUID[8] c_E\n")
    table = lammps.results[-1].thermo()[0]
    assert table["f_FLUID[5]"][-1] > 2 * table["f_FLUID[5]"][0] and np.all(np.diff(table["f_FLUID[8]"][1:]) > 0)
    assert np.isfinite(stages["c_T"]).all()
