"""Keyword solute of pair_coeff: rates, total amount, decay of a wave, contact of two fluids, passive dye, files, refinement, bad input.

The reference is the formula of the theory page, 2 k_ij F V_i V_j (q_j - q_i) with k = rho0 D and the harmonic mean, as dense sums
over all pairs.
"""

import re

import numpy as np
import pytest

import test_micropolar as micro
from helpers import INTEGRATE, SUPPORT, disordered, dump, fluid, header, lattice, relative
from test_relax import write

FULL = "thermo_modify norm no format float %.17g\n"
ROOM = "sph/bulk solute"
D = {1: 0.3, 2: 0.05, 3: 0.0}  # and a fourth type, which carries none
RHO0 = {1: 1.0, 2: 1.1, 3: 1.2, 4: 1.3}
TOTAL = "compute S all property/atom d_solute\ncompute Q all reduce sum c_S\nthermo_style custom step c_Q\nthermo 1\n" + FULL


def coefficients(dim, diffusivity=D, ntypes=4, options="", mu=0.5):
    words = {k: f" solute {value}" for k, value in diffusivity.items()}
    return f"pair_style sph/bulk dim {dim} {options}\n" + "".join(
        f"pair_coeff {k} {k} {RHO0[k]} 10.0 {mu} 2.0 {SUPPORT[dim]}{words.get(k, '')}\n" for k in range(1, ntypes + 1))


def start(lammps, particles, amount, model, integrate=INTEGRATE, style=ROOM, **keywords):
    write(particles, lammps.path("box.data"), np.broadcast_to(amount, len(particles))[:, None], style.split()[0])
    return header(particles.dim, style=style, **keywords) + "read_data box.data\n" + model + integrate


def carried(particles, seed=5):
    """Amounts of both signs, none of particles of a type without the keyword."""
    amount = np.random.default_rng(seed).uniform(-1.0, 3.0, len(particles))
    return np.where(particles.type == 4, 0.0, amount)


def rates(frame, particles, amount, diffusivity):
    """Of each particle, with wendland/c2."""
    dim, support = particles.dim, SUPPORT[particles.dim]
    r = (frame["x"][:, None] - frame["x"][None])[..., :dim]
    length = (particles.hi - particles.lo)[:dim]
    q = np.minimum(np.linalg.norm(r - length * np.round(r / length), axis=2) / support, 1.0)
    F = {1: 1.5, 2: 7 / np.pi, 3: 10.5 / np.pi}[dim] * support ** -(dim + 2) * 20 * (1 - q) ** 3
    k = np.array([RHO0[kind] * diffusivity.get(kind, 0.0) for kind in particles.type])
    mean = 2 * k[:, None] * k / (k[:, None] + k + 1e-300)
    value = amount / particles.mass
    return (2 * mean * F * frame["vol"][:, None] * frame["vol"] * (value[None] - value[:, None])).sum(axis=1)


# ---- rates and what is conserved ---------------------------------------------------------------------------------


@pytest.mark.parametrize("dim, options", [(1, "shear none"), (2, ""), (2, "volume mass simd none"), (3, "shear morris")])
@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "off"), (2, "on")])
def test_rate_of_each_particle(lammps, dim, options, ranks, newton):
    """Of four types, one of them with D = 0, one without the keyword: the first step adds dt times the rate of its beginning."""
    if ranks == 2 and options != "":
        pytest.skip("ranks are covered by one form")
    dt = 0.25  # so large that the difference of the amounts has all digits; nothing moves
    particles = disordered(dim, {1: 40, 2: 12, 3: 6}[dim], ntypes=4, speed=0.0)
    amount = carried(particles)
    still = f"fix FLUID all sph/bulk\nfix HOLD all setforce 0 0 0\ntimestep {dt}\n"
    mu = 0.0 if "none" in options else 0.5
    text = start(lammps, particles, amount, coefficients(dim, options=options, mu=mu), still, newton=newton)
    lammps(text + dump("f.dump", extra="d_solute") + "run 1\n", ranks=ranks)
    first, then = lammps.frames("f.dump")
    rate = rates(first, particles, amount, D)
    assert np.all(first["d_solute"] == amount)
    assert relative((then["d_solute"] - amount) / dt - rate, rate) < 1e-11
    assert np.all(rate[particles.type > 2] == 0.0) and np.abs(rate).max() > 0.05


def test_particles_with_spin(lammps):
    """The same in a micropolar fluid."""
    particles = disordered(2, 12, speed=0.0, spread=0.0)
    amount = carried(particles)
    found = {}
    for style, model in ("sph/bulk", fluid(2, keywords="solute 0.3")), ("sph/micropolar", micro.fluid(2).rstrip() + " solute 0.3\n"):
        still = f"fix FLUID all {style}\nfix HOLD all setforce 0 0 0\ntimestep 0.25\n"
        text = start(lammps, particles, amount, model, still, f"{style} solute")
        lammps(text + "dump D all custom 1 f.dump id d_solute\ndump_modify D sort id format float %.17g\nrun 1\n")
        found[style] = lammps.frame("f.dump")["d_solute"]
    assert relative(found["sph/bulk"] - found["sph/micropolar"], amount) < 1e-13
    assert relative(found["sph/bulk"] - amount, amount) > 1e-3


@pytest.mark.parametrize("integrator", ["", "viscous rkl2"])
@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "off"), (4, "on")])
def test_total_amount_in_a_moving_fluid(lammps, integrator, ranks, newton):
    """Particles change their ranks.  The spread falls, and the motion does not depend on the solute."""
    if integrator and ranks != 2:
        pytest.skip("ranks are covered without")
    particles = disordered(2, 14, ntypes=4, speed=2.0)
    amount = carried(particles)
    frames = []
    for diffusivity in D, {}:
        text = start(lammps, particles, amount if diffusivity else 0.0, coefficients(2, diffusivity), newton=newton)
        text = text.replace("fix FLUID all sph/bulk", f"fix FLUID all sph/bulk {integrator}") + TOTAL + dump("f.dump", 200, "d_solute")
        table = lammps(text + "run 200\n", ranks=ranks).thermo()[-1]
        assert np.abs(table["c_Q"] - table["c_Q"][0]).max() < 1e-13 * np.abs(amount).sum()
        frames.append(lammps.frames("f.dump"))
    (first, last), (_, without) = frames
    assert np.all(last["x"] == without["x"]) and np.all(last["v"] == without["v"])
    assert np.abs(last["x"] - first["x"]).max() > 1.0
    spread = [(frame["mass"] * (frame["d_solute"] / frame["mass"])**2)[particles.type < 3].sum() for frame in (first, last)]
    assert spread[1] < 0.9 * spread[0]
    assert np.all(last["d_solute"][particles.type > 2] == amount[particles.type > 2])


def test_largest_time_step(lammps):
    """At the step of the table nothing leaves the range of before, and the spread falls; the warning comes above it."""
    particles = disordered(2, 14, speed=0.0, ntypes=2)
    amount = carried(particles)
    model = coefficients(2, {1: 40.0, 2: 15.0}, 2, mu=0.0)
    hold = INTEGRATE + "fix HOLD all setforce 0 0 0\n"
    log = lammps(start(lammps, particles, amount, model, hold) + "run 0\n").log
    names, row = re.search(r"^  types +(.*)\n  1-1 +(.*)$", log, re.MULTILINE).groups()
    assert "rho0*D" in names and names.split("step:")[1].split() == ["acoustic", "shear", "bulk", "solute", "all"]
    steps = [float(line.split()[-2]) for line in re.findall(r"^  \d-\d .*$", log, re.MULTILINE)]
    assert float(row.split()[-2]) == min(steps)
    text = start(lammps, particles, amount, model, hold.replace("0.005", f"{min(steps)}"))
    lammps(text + dump("f.dump", extra="d_solute") + "run 40\n")
    frames = [frame["d_solute"] / frame["mass"] for frame in lammps.frames("f.dump")]
    for before, after in zip(frames, frames[1:]):
        assert after.max() <= before.max() and after.min() >= before.min()
    assert np.ptp(frames[-1]) < 0.3 * np.ptp(frames[0])
    for factor, warns in (0.9, False), (1.2, True):
        step = float(row.split()[-1]) * factor
        result = lammps(start(lammps, particles, amount, model, hold.replace("0.005", f"{step}")) + "run 0\n")
        assert any("time step" in one for one in result.warnings) == warns


# ---- exact solutions ---------------------------------------------------------------------------------------------


def test_decay_of_a_cosine(lammps):
    """The rate is the sum over a square lattice, and with a support of four spacings D k^2 within half a percent."""
    particles = lattice(2, (80, 6))
    k = 2 * np.pi / 80
    wave = np.cos(k * particles.x[:, 0])
    diffusivity, dt, steps = 0.7, 0.02, 2000
    s = np.stack(np.meshgrid(*[np.arange(-4, 5)] * 2, indexing="ij"), -1).reshape(-1, 2)
    q = np.minimum(np.linalg.norm(s, axis=1) / 4.0, 1.0)
    norm = 7 / np.pi / 4.0**2
    volume = 1 / (norm * (1 - q) ** 4 * (1 + 4 * q)).sum()
    rate = 2 * diffusivity * volume**2 * (norm / 4.0**2 * 20 * (1 - q) ** 3 * (1 - np.cos(k * s[:, 0]))).sum()
    model = f"pair_style sph/bulk shear none\npair_coeff * * 1.0 10.0 0 0 4.0 solute {diffusivity}\n"
    integrate = f"fix FLUID all sph/bulk\nfix HOLD all setforce 0 0 0\ntimestep {dt}\n"
    lammps(start(lammps, particles, 2.0 + wave, model, integrate) + dump("f.dump", steps, "d_solute") + f"run {steps}\n")
    amount = lammps.frame("f.dump")["d_solute"]
    amplitude = 2 * (amount * wave).mean()
    assert amount.mean() == pytest.approx(2.0, rel=1e-13)
    assert np.abs(amount - 2.0 - amplitude * wave).max() < 1e-12
    assert amplitude == pytest.approx((1 - rate * dt) ** steps, rel=1e-11)
    assert -np.log(amplitude) / (steps * dt * diffusivity * k * k) == pytest.approx(1.0, abs=5e-3)


@pytest.mark.parametrize("high", [1, 2])
def test_contact_of_two_diffusivities(lammps, high):
    """The amount per mass at the contact is (s1 q1 + s2 q2)/(s1 + s2), s = sqrt(D), with an error function on each side."""
    from scipy.special import erf
    N, t, steps = 400, 0.01, 1000
    spacing = 2.0 / N
    particles = lattice(1, N, spacing)
    particles.mass[:] = spacing
    particles.type[:] = np.where(particles.x[:, 0] < 1.0, 1, 2)
    diffusivity, q = {1: 1.0, 2: 0.1}, {1: 1.0, 2: 1.0, high: 2.0}
    model = "pair_style sph/bulk dim 1 shear none\n" + "".join(
        f"pair_coeff {i} {i} 1.0 1.0 0.0 0.0 {4 * spacing} solute {value}\n" for i, value in diffusivity.items())
    integrate = f"fix FLUID all sph/bulk\nfix HOLD all setforce 0 0 0\ntimestep {t / steps}\n"
    amount = spacing * np.where(particles.type == 1, q[1], q[2])
    lammps(start(lammps, particles, amount, model, integrate) + dump("f.dump", steps, "d_solute") + f"run {steps}\n")
    frame = lammps.frame("f.dump")
    x, value = frame["x"][:, 0] - 1.0, frame["d_solute"] / spacing
    s = {i: np.sqrt(value) for i, value in diffusivity.items()}
    contact = (s[1] * q[1] + s[2] * q[2]) / (s[1] + s[2])
    exact = np.where(x < 0, contact + (q[1] - contact) * erf(-x / np.sqrt(4 * diffusivity[1] * t)),
                     contact + (q[2] - contact) * erf(x / np.sqrt(4 * diffusivity[2] * t)))
    near = np.abs(x) < 0.5
    print(np.sqrt(((value - exact)[near] ** 2).mean()), np.abs(value - exact)[near].max())
    assert np.sqrt(((value - exact)[near] ** 2).mean()) < 2e-3
    assert np.abs(value - exact)[near].max() < 0.02


# ---- what belongs to particles -----------------------------------------------------------------------------------


def test_set_and_read(lammps):
    """By command set, compute property/atom with either name, and dump; negative amounts, too."""
    particles = disordered(2, 8)
    text = start(lammps, particles, 0.0, fluid(2, keywords="solute 0")) + (
        "variable s atom id-20\nset group all d_solute v_s\ncompute S all property/atom solute d_solute\n"
        "dump D all custom 5 f.dump id d_solute c_S[1] c_S[2]\ndump_modify D sort id\nrun 5\n")
    lammps(text, ranks=2)
    for frame in lammps.frames("f.dump"):
        for column in "d_solute", "c_S[1]", "c_S[2]":
            assert np.all(frame[column] == frame["id"] - 20)


@pytest.mark.parametrize("diffusivity", [0.0, 0.2])
def test_particles_that_split_and_merge(lammps, diffusivity):
    """The total is constant, and a uniform amount per mass stays uniform."""
    particles = disordered(2, 14, jitter=0.1, speed=0.05)
    model = fluid(2, "volume mass limit yes", mu=0.2, keywords=f"solute {diffusivity}")
    for uniform in True, False:
        amount = 0.7 * particles.mass if uniform else carried(particles)
        text = start(lammps, particles, amount, model, "fix FLUID all sph/bulk\ntimestep 0.002\n") + (
            'variable phase equal "floor((step+1)/40)%2"\nvariable target atom "1.0 - 0.8*v_phase*(x>7)"\n'
            "fix R all sph/refine 5 volume v_target wait 0.0\n" + TOTAL.replace("step", "step f_R[1] f_R[2]") + dump("f.dump", 40, "d_solute"))
        table = lammps(text + "run 160\n", ranks=2).thermo()[-1]
        assert table["f_R[1]"][-1] > 30 and table["f_R[2]"][-1] > 30
        assert np.abs(table["c_Q"] - table["c_Q"][0]).max() < 1e-13 * np.abs(amount).sum()
        for frame in lammps.frames("f.dump") if uniform else ():
            assert np.abs(frame["d_solute"] / frame["mass"] - 0.7).max() < 1e-14


def test_masses_for_rho0_keep_the_amount_per_mass(lammps):
    particles = disordered(2, 10, jitter=0.1, speed=0.0)
    amount = carried(particles)
    text = start(lammps, particles, amount, fluid(2, keywords="solute 0"), INTEGRATE.replace("sph/bulk", "sph/bulk density rho0"))
    lammps(text + dump("f.dump", extra="d_solute") + "run 0\n", ranks=2)
    frame = lammps.frame("f.dump")
    assert relative(frame["d_solute"] / frame["mass"] - amount / particles.mass, amount) < 1e-14
    assert relative(frame["mass"] - particles.mass, particles.mass) > 1e-3


def test_walls_are_impermeable(lammps):
    """Walls have none, and the total of the fluid stays, also where a wall has the type of the fluid."""
    particles = lattice(2, (10, 16))
    particles.x[:, 1] -= 3.0
    particles.lo[1], particles.hi[1] = -4.0, 14.0
    wet = (particles.x[:, 1] > 0) & (particles.x[:, 1] < 10)
    amount = np.where(wet, carried(particles), 0.0)
    text = start(lammps, particles, amount, fluid(2, keywords="solute 0.5"), "", boundary="p f p") + (
        "region FLUID block INF INF 0 10 INF INF\ngroup fluid region FLUID\ngroup wall subtract all fluid\n"
        + INTEGRATE.replace("all", "fluid") + "fix W wall sph/wall velocity 0.5 0 0\n" + TOTAL + dump("f.dump", 100, "d_solute"))
    table = lammps(text + "run 100\n", ranks=2).thermo()[-1]
    assert np.abs(table["c_Q"] - table["c_Q"][0]).max() < 1e-13 * np.abs(amount).sum()
    last = lammps.frame("f.dump")["d_solute"]
    assert np.all(last[~wet] == 0.0)
    assert np.var(last[wet]) < 0.5 * np.var(amount[wet])


# ---- runs and files ----------------------------------------------------------------------------------------------


def case(lammps, diffusivity=D, extra=""):
    particles = disordered(2, 14, ntypes=4, speed=1.0)
    return start(lammps, particles, carried(particles), coefficients(2, diffusivity)) + extra


def same(one, other, bound=1e-12):
    for key in "x", "v", "d_solute":
        assert relative(one[key] - other[key], one[key]) < bound, key


@pytest.mark.parametrize("commands", ["run 20\nrun 1\nrun 0\nrun 29\n", "run 50 pre no every 7 NULL\n", "run 25\nrun 25 pre no\n"])
def test_several_runs_are_one(lammps, commands):
    for name, parts in ("one.dump", "run 50\n"), ("parts.dump", commands):
        lammps(case(lammps) + parts + dump(name, 1, "d_solute") + "run 0\n", ranks=2)
    same(lammps.frame("one.dump"), lammps.frame("parts.dump"))


@pytest.mark.parametrize("before, after", [(1, 1), (2, 2), (2, 1)])
def test_restart(lammps, before, after):
    """Amounts come back bit for bit, with the coefficients, D = 0 included; the run goes on as one."""
    lammps(case(lammps) + "run 25\nwrite_restart half.restart\n" + dump("half.dump", 25, "d_solute") + "run 25\n", ranks=before)
    first, last = lammps.frames("half.dump")
    lammps("read_restart half.restart\n" + INTEGRATE + dump("then.dump", 25, "d_solute") + "run 25\n", ranks=after)
    again, then = lammps.frames("then.dump")
    assert np.all(again["d_solute"] == first["d_solute"])
    same(last, then)


@pytest.mark.parametrize("pairs", ["ii", "ij"])
def test_data_file(lammps, pairs):
    lammps(case(lammps) + f"run 25\nwrite_data half.data pair {pairs}\n" + dump("half.dump", 1, "d_solute") + "run 0\n", ranks=2)
    text = lammps.path("half.data").read_text()
    assert len(re.findall(r"^3 .*solute 0$", text, re.M)) == 1 and not re.search(r"^4 4? ?1\.3 .*solute", text, re.M)
    lammps(header(2, style=ROOM) + "pair_style sph/bulk dim 2\nread_data half.data\n" + INTEGRATE + dump("then.dump", 1, "d_solute") + "run 0\n")
    half, then = lammps.frame("half.dump"), lammps.frame("then.dump")
    assert np.all(half["d_solute"] == then["d_solute"]) or relative(half["d_solute"] - then["d_solute"], half["d_solute"]) < 1e-15
    assert np.all(half["type"] == then["type"])


def test_type_without_the_keyword(lammps):
    """What its particles carry is lost, with a warning, at the beginning of a run."""
    text = case(lammps) + "set type 3 type 4\n" + TOTAL + dump("f.dump", 1, "d_solute")
    result = lammps(text + "run 1\n")
    first, last = lammps.frames("f.dump")
    assert any("particles have values of d_solute, which their type does not have" in one for one in result.warnings)
    assert np.all(last["d_solute"][last["type"] == 4] == 0.0) and np.abs(last["d_solute"]).max() > 1.0
    assert "rho0*D" in result.log


def test_room_alone_and_passive_dye_change_nothing(lammps):
    """No column of the table, no motion, no amount."""
    found = []
    for diffusivity in {}, {1: 0.0, 2: 0.0, 3: 0.0, 4: 0.0}:
        particles = disordered(2, 12, ntypes=4)
        amount = 1.5 if diffusivity else 0.0
        result = lammps(start(lammps, particles, amount, coefficients(2, diffusivity)) + dump("f.dump", 20, "d_solute") + "run 20\n", ranks=2)
        assert "rho0*D" not in result.log and not any("states" in one for one in result.warnings)
        found.append(lammps.frame("f.dump"))
        assert np.all(found[-1]["d_solute"] == amount)
    assert np.all(found[0]["x"] == found[1]["x"]) and np.all(found[0]["f"] == found[1]["f"])


def adapted(types, value):
    return f"variable D equal {value}\nfix A all adapt 1 pair sph/bulk solute {types} v_D\n"


def test_adapt(lammps):
    """A value from the first step on is that of pair_coeff; after D = 0 of all types amounts stay; from 0 of one type it may grow."""
    lammps(case(lammps, {**D, 1: 0.7}) + dump("f.dump", 10, "d_solute") + "run 10\n")
    lammps(case(lammps, D) + adapted("1 1", 0.7) + dump("g.dump", 10, "d_solute") + "run 10\n", ranks=2)
    same(lammps.frame("f.dump"), lammps.frame("g.dump"))
    lammps(case(lammps, {1: 0.7, 2: 0.7, 3: 0.7}) + adapted("1*3 1*3", "0.7*(step<5)") + dump("h.dump", 1, "d_solute") + "run 10\n")
    change = [np.abs(np.diff([one["d_solute"] for one in lammps.frames("h.dump")], axis=0)).max(axis=1)][0]
    assert np.all(change[:5] > 1e-4) and np.all(change[5:] == 0.0)
    lammps(case(lammps, D) + adapted("3 3", "0.7*(step>=5)") + dump("k.dump", 1, "d_solute") + "run 10\n")
    frames = lammps.frames("k.dump")
    own = frames[0]["type"] == 3
    assert np.all(frames[5]["d_solute"][own] == frames[0]["d_solute"][own]) and np.any(frames[7]["d_solute"][own] != frames[0]["d_solute"][own])


@pytest.mark.parametrize("diffusivity, types, value, message", [
    (D, "1 1", "0.3-0.1*step", "solute must be >= 0, not -"), (D, "4 4", "0.3", "solute of type 4 cannot be changed"),
    (D, "1 2", "0.3", "belongs to a type"), ({1: 0.0}, "1 1", "0.3", "solute")])
def test_adapt_errors(lammps, diffusivity, types, value, message):
    result = lammps(case(lammps, diffusivity) + adapted(types, value) + "run 10\n", check=False, ranks=2)
    assert result.code and message in result.error, result.error


# ---- bad input ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("keywords, message", [
    ("solute -0.1", "solute must be >= 0, not -0.1"), ("solute", "missing argument"), ("solute 0.1 0.2", "Unknown pair_coeff keyword"),
    ("solute nan", "nan"), ("solute 0.1 solute 0", "solute is given twice"), ("solute x", "x")])
def test_bad_coefficients(lammps, keywords, message):
    particles = disordered(2, 8)
    result = lammps(start(lammps, particles, 0.0, fluid(2, keywords=keywords)) + "run 0\n", check=False)
    assert result.code and message in result.error, result.error


@pytest.mark.parametrize("diffusivity", ["0", "0.1"])
def test_what_it_cannot_be_used_with(lammps, diffusivity):
    particles = disordered(2, 8)
    for options in "temp 0.1 4711", "temp energy 100 4711":
        result = lammps(start(lammps, particles, 0.0, fluid(2, options, keywords=f"solute {diffusivity}")) + "run 0\n", check=False)
        assert "temp cannot be used with solute of pair_coeff, which type 1 has" in result.error
    unlike = "pair_coeff 1 2 solute 0.1\n"
    particles.type[0] = 2
    result = lammps(start(lammps, particles, 0.0, fluid(2)) + unlike, check=False)
    assert "belongs to a type, not to a pair of types" in result.error
    no_room = header(2) + "region BOX block 0 8 0 8 -0.5 0.5\ncreate_box 1 BOX\n" + fluid(2, keywords=f"solute {diffusivity}") + INTEGRATE
    result = lammps(no_room + "run 0\n", check=False)
    assert "states of solute of type 1 are 1, but particles have room for 0; use atom_style sph/bulk solute" in result.error


def test_solute_of_an_open_stream(lammps):
    """A uniform stream brings the amount of the inlet, and a spot of more solute spreads in it."""
    lammps("""units lj
dimension 2
boundary f p p
atom_style sph/bulk solute
lattice sq 1.0 origin 0.5 0.5 0
region box block -14 34 0 10 -0.5 0.5 units box
create_box 1 box
region filled block -8 28 INF INF INF INF units box
create_atoms 1 region filled
set group all mass 1.0
region before block INF 0 INF INF INF INF units box
region behind block 20 INF INF INF INF INF units box
group inlet region before
group outlet region behind
group fluid subtract all inlet outlet
set group all d_solute 1.0
variable Q atom 1.0+exp(-0.25*(x-6)*(x-6))
set group fluid d_solute v_Q
velocity all set 1.0 0 0
neighbor 0.3 bin
pair_style sph/bulk
pair_coeff * * 1.0 10.0 0.5 2.0 3.0 pb 1.0 solute 0.05
fix 1 fluid sph/bulk
fix in inlet sph/open fluid 0 0 0 1 0 0 8 velocity 1.0 0 0
fix out outlet sph/open fluid 20 0 0 -1 0 0 8 pressure 1.0
timestep 0.02
dump f fluid custom 400 s.dump id type mass x y z xu yu zu vx vy vz fx fy fz d_solute
dump_modify f sort id format float %.17g
run 400
""")
    frame = lammps.frame("s.dump")
    x, q = frame["x"][:, 0], frame["d_solute"]
    centre = x[frame["id"] == 15] - 0.5  # of the spot, which this particle was beside
    exact = 1 + (20 / 28) ** 0.5 * np.exp(-((x - centre) ** 2) / (4 * 0.05 * 28))
    assert centre == pytest.approx(14, abs=0.3)  # the stream starts a little faster
    print(np.abs(q - exact).max())
    assert frame["id"].max() > 360 and x.min() < 1 and len(x) == pytest.approx(200, abs=10)
    assert np.abs(q - exact).max() < 0.03
