"""The largest stable time step is that: runs at 0.9 of the printed one, one number at all places, and what it knows."""

import re

import numpy as np
import pytest

import open_boundaries as ends
import test_micropolar as micro
import test_relax as relax
import test_wall as walls
from helpers import disordered, dump, header, lattice

BULK, MICRO = "sph/bulk", "sph/micropolar"
PART, STEPS, SPEED = 0.9, 800, 1.0
SUPPORT = {2: 4.0, 3: 2.6}


def steps_of(log):
    """{column: largest stable time step} of the pair of types for which it is smallest."""
    names = re.search(r"largest stable time step:(.*)", log)[1].split()
    rows = [row.split() for row in re.findall(r"^  \d+-\d+ .*\|(.*)$", log, re.MULTILINE)]
    return {name: min(np.inf if row[k] == "-" else float(row[k]) for row in rows) for k, name in enumerate(names)}


# ---------------------------------------------------------------------------------------------
# runs at 0.9 of it, of fluids whose friction limits it

# pair style, its options, and the viscosities of a fluid; the moment of inertia per mass decides which of shear,
# vortex, and spin diffusion of the second style is the fast one
FORMS = {
    "mg": (BULK, "shear mg", "{0} intrinsic"),
    "mg/fr": (BULK, "shear mg/fr", "{0} intrinsic"),
    "mg/fr2": (BULK, "shear mg/fr2", "{0} intrinsic"),
    "morris": (BULK, "shear morris", "{0} intrinsic"),
    "espanol": (BULK, "shear espanol", "{0} intrinsic"),
    "bulk": (BULK, "shear mg", "1.0 {0}"),
    "volume": (BULK, "shear morris bulk volume", "{0} {0}"),
    "shear": (MICRO, "", "{0} intrinsic {0} 0.0 0.0", 5.0),
    "vortex": (MICRO, "", "{0} intrinsic {0} 0.0 0.0", 0.2),
    "spin": (MICRO, "", "1.0 intrinsic 0.1 {0} {1}", 1.0),
}


def stretch(particles, owner, seed=3):
    """Masses that differ by a factor of two at the most, of walls they stay."""
    wet = owner < 0
    particles.mass[wet] = np.random.default_rng(seed).uniform(0.7, 1.4, wet.sum())


def plane(dim, form):
    """Between a floor and a ceiling that moves, unequal masses, with the limit of the bulk term."""
    particles, owner = walls.channel(dim, 0.15, {2: (9, 16), 3: (6, 11, 6)}[dim], 4 if dim == 2 else 3)
    stretch(particles, owner)
    options = "volume mass" + ("" if "volume" in form else " limit yes")
    return particles, owner, "p p p", options, walls.wall_fix(0) + walls.wall_fix(1, velocity=(SPEED, 0.0, 0.0))


def cup(dim, form):
    """Two fluids in a round cup that turns, the outer one more viscous."""
    particles, owner = walls.cup(2, 6.0, 4.2, 0.15)
    centre = np.linalg.norm(particles.x, axis=1) < 3.0
    particles.type[~centre] = 2
    return particles, owner, "f f p", "", walls.wall_fix(0, rotate=((0, 0, 0), (0, 0, 1), SPEED / 6.0))


def wheel(dim, form):
    """Round a body that turns and travels, in a periodic box, with spins that follow the vorticity at its surface."""
    particles = disordered(2, 16, jitter=0.15, speed=0.2, spread=0.0)
    particles, owner = walls.arrange(particles, [np.linalg.norm(particles.x[:, :2] - 8.0, axis=1) < 4.2])
    spin = " spin rate 0.5" if FORMS[form][0] == MICRO else ""
    return (particles, owner, "p p p", "",
            walls.wall_fix(0, (0.2 * SPEED, 0, 0), ((8, 8, 0), (0, 0, 1), 0.8 * SPEED / 4.2)).rstrip() + spin + "\n")


def case(dim, form, where):
    particles, owner, boundary, options, fixes = where(dim, form)
    style, form_options, coefficients, *inertia = FORMS[form]
    mu = 200.0 if form == "bulk" else 25.0
    lines = ""
    for k, value in enumerate((0.2 * mu, mu) if particles.type.max() > 1 else (mu,), 1):
        lines += (f"pair_coeff {k} {k} 1.0 10.0 " + coefficients.format(value, -value if dim == 2 else 0.0)
                  + f" {SUPPORT[dim]} pb 20.0\n")
    text = (header(dim, boundary=boundary, style=style) + "read_data box.data\n" + walls.groups(owner)
            + f"pair_style {style} {form_options} {options}\n{lines}fix 1 fluid {style}\n{fixes}")
    return particles, text, inertia[0] if inertia else None


def run(lammps, text, part=PART, steps=STEPS):
    """The steps of the table, energies of the motion of the fluid, and squares of its spins."""
    tail = "compute K fluid ke\nthermo_style custom step c_K\nthermo_modify norm no\n"
    if MICRO in text:
        tail = ("compute S fluid property/atom omegax omegay omegaz\ncompute S2 fluid reduce sumsq c_S[*]\n"
                + tail.replace("c_K\n", "c_K c_S2[*]\n"))
    first = lammps(text + tail + "timestep 1e-9\nrun 0\n")
    table = steps_of(first.log)
    result = lammps(text + tail + f"timestep {part * table['all']}\nthermo {steps // 10}\nrun {steps}\n", check=part < 1.0)
    if result.code:
        return table, [np.inf], [np.inf]
    if part < 1.0:
        assert not any("exceeds the largest" in line for line in result.warnings)
    thermo = result.thermo()[0]
    return table, thermo["c_K"], sum(thermo[f"c_S2[{k}]"] for k in (1, 2, 3)) if MICRO in text else np.zeros(1)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("dim, where", [(2, plane), (2, cup), (2, wheel), (3, plane)], ids=["plane", "cup", "wheel", "plane3d"])
def test_stable_between_walls(lammps, dim, where, form):
    particles, text, inertia = case(dim, form, where)
    if inertia:
        micro.write(particles, lammps.path("box.data"), inertia=inertia)
    else:
        particles.write(lammps.path("box.data"))
    table, energy, spin = run(lammps, text)
    print(table, energy, spin)
    assert table["all"] < 0.8 * table["acoustic"], "friction is to be the limit"
    if inertia:
        assert min(table, key=lambda name: table[name] if name != "all" else np.inf) == form
    assert energy[-1] < 0.5 * particles.mass.sum() * SPEED ** 2
    assert spin[-1] <= spin[0]


@pytest.mark.parametrize("form", ["mg", "morris", "spin"])
def test_stable_with_open_ends(lammps, form):
    """A stream between walls from an inlet to an outlet."""
    style, options, coefficients, *inertia = FORMS[form]
    channel = ends.Channel(length=12, width=7, zone=8.0, support=3.0, box="walls")
    text = channel.text(lammps, f"velocity {0.5 * SPEED} 0 0", "pressure 0", lambda place: np.array([0.5 * SPEED, 0, 0]) + 0.0 * place,
                        "1.0 10.0 " + coefficients.format(25.0, -25.0) + " {R}", style, options, wall="slip no",
                        integrate="density rho0" + (f" inertia 0.0 {inertia[0]}" if inertia else ""))
    _, energy, _ = run(lammps, text.replace("timestep 0.3\n", ""))
    print(energy)
    assert energy[-1] < 0.5 * len(channel.part) * SPEED ** 2


@pytest.mark.parametrize("form", [form for form in FORMS if form != "volume"])
def test_not_needlessly_careful(lammps, form):
    """A lattice of many particles blows up at 2.2 times the step of its fastest channel."""
    style, options, coefficients, *inertia = FORMS[form]
    particles = disordered(2, 12, jitter=0.0, speed=0.2, spread=0.0)
    if inertia:
        micro.write(particles, lammps.path("box.data"), inertia=inertia[0])
    else:
        particles.write(lammps.path("box.data"))
    mu = 200.0 if form == "bulk" else 25.0
    text = (header(2, style=style) + f"read_data box.data\ngroup fluid id > 0\npair_style {style} {options}\n"
            + f"pair_coeff * * 1.0 10.0 {coefficients.format(mu, -mu)} 4.0 pb 20.0\nfix 1 all {style}\nthermo_modify lost ignore\n")
    table, energy, spin = run(lammps, text, 0.99, 400)
    bound, bound_of_spin = energy[0], spin[0]
    assert energy[-1] < bound and spin[-1] <= bound_of_spin
    table, energy, spin = run(lammps, text, 2.2, 400)
    print(table, energy, spin)
    assert not (energy[-1] < 2.0 * bound and spin[-1] <= 2.0 * bound_of_spin)


# ---------------------------------------------------------------------------------------------
# one number at all places

PAIRS = {  # pair style, its coefficients, options of the fixes
    "two speeds of sound": ("", "pair_coeff 1 1 1.0 10.0 0.5 2.0 3.0\npair_coeff 2 2 1.0 8.0 0.5 2.0 3.0\n"),
    "two viscosities": ("shear morris", "pair_coeff 1 1 1.0 10.0 9.0 2.0 3.0\npair_coeff 2 2 1.5 10.0 70.0 80.0 3.0\n"),
    "tait": ("eos tait", "pair_coeff * * 0.9 10.0 0.5 2.0 3.0 pb 3.0\n"),
    "gas": ("eos ideal", "pair_coeff * * 1.0 10.0 0.5 2.0 3.0 pb 2.0\n"),
    "heat": ("", "pair_coeff 1 1 1.0 10.0 0.5 2.0 3.0 cv 2.0 conductivity 30\npair_coeff 2 2 1.0 10.0 0.5 2.0 3.0 cv 0.5 conductivity 20\n"),
}


@pytest.mark.parametrize("name", PAIRS)
def test_fix_dt_has_the_steps_of_the_table(lammps, name):
    """At the default values, to the four digits of the table, and the pair style has nothing to warn of."""
    options, coefficients = PAIRS[name]
    particles = disordered(2, 10, ntypes=2)
    particles.v[particles.type == 2] *= 3.0
    particles.write(lammps.path("box.data"))
    result = lammps(header(2) + f"read_data box.data\npair_style sph/bulk {options}\n{coefficients}fix 1 all sph/bulk\n"
                    "fix D all sph/dt 1 force 100\nthermo_style custom step dt f_D[*]\nthermo_modify format float %.17g\nrun 0\n")
    table, thermo = steps_of(result.log), result.thermo()[0]
    assert not any("exceeds" in line for line in result.warnings), result.warnings
    assert thermo["f_D[1]"][0] == pytest.approx(table["acoustic"], rel=5e-4)
    assert thermo["Dt"][0] == pytest.approx(table["all"], rel=5e-4)


@pytest.mark.parametrize("order", [0, 1])
def test_fix_dt_never_exceeds_the_step_of_the_pair_style(lammps, order):
    """At the default values, also at the start of runs that continue others; its own factors are warned of."""
    particles = disordered(2, 10)
    relax.write(particles, lammps.path("box.data"), relax.strained([0.1]))
    fixes = ["fix 1 all sph/bulk\n", "fix D all sph/dt 1\n"]
    text = (relax.room(2) + "read_data box.data\npair_style sph/bulk\n"
            "pair_coeff * * 1.0 10.0 0.5 2.0 3.0 cv 2.0 gruneisen 0.4 1 relax 5 0.02\n" + fixes[order] + fixes[1 - order]
            + "fix S all setforce NULL NULL 0\nrun 1\n" + 6 * "run 7\n")
    assert not [line for line in lammps(text).warnings if "exceeds" in line]
    far = lammps(text.replace("sph/dt 1", "sph/dt 1 acoustic 0.5 force 10")).warnings
    assert [line for line in far if "exceeds" in line]


def test_ideal_gas_under_a_background_pressure(lammps):
    """The background pressure is elastic: c^2 = gamma (gamma - 1) q of the heat q alone, e less pb (1/rho0 - 1/rho)."""
    particles = lattice(2, 10)
    particles.esph[:] = 60.0
    particles.write(lammps.path("box.data"))
    steps = []
    for pb in (0.0, 50.0):
        log = lammps(header(2) + "read_data box.data\npair_style sph/bulk eos ideal\n"
                     f"pair_coeff * * 1.0 10.0 0.5 2.0 4.0 pb {pb}\nfix 1 all sph/bulk\ntimestep 0.001\nrun 0\n").log
        steps.append(steps_of(log)["acoustic"])
        rho = float(re.search(r"^  1 +\d+ +\d+ +\| (\S+)", log, re.MULTILINE)[1])
        assert steps[-1] == pytest.approx(0.5 / np.sqrt(0.56 * (60.0 - pb * (1.0 - 1.0 / rho))), rel=5e-4)


def test_warning_in_the_middle_of_a_run(lammps):
    """fix adapt raises the bulk viscosity beyond what the time step allows: said once, and not if fix sph/dt follows."""
    disordered(2, 10).write(lammps.path("box.data"))
    text = (header(2) + "read_data box.data\npair_style sph/bulk\npair_coeff * * 1.0 10.0 0.5 2.0 3.0\nfix 1 all sph/bulk\n"
            "variable kappa equal 2.0+5.0*step\nfix A all adapt 1 pair sph/bulk kappa * * v_kappa\n")
    warned = [line for line in lammps(text + "timestep 0.02\nrun 20\n").warnings if "exceeds the largest stable time step" in line]
    assert len(warned) == 1
    limit = float(re.search(r"largest stable time step (\S+)", warned[0])[1])
    assert 0.017 < limit < 0.02, "at the first step at which it is so"
    assert not any("exceeds" in line for line in lammps(text + "fix D all sph/dt 1\nrun 20\n").warnings)


def test_rate_of_the_noise_is_that_of_the_table(lammps):
    disordered(2, 10, spread=0.0).write(lammps.path("box.data"))
    log = lammps(header(2) + "read_data box.data\npair_style sph/bulk shear morris temp 1e-3 1\npair_coeff * * 1.0 10.0 2.0 5.0 3.0\n"
                 "fix 1 all sph/bulk\ntimestep 0.01\nrun 0\n").log
    table = steps_of(log)
    rate = 1.0 / table["shear"] + 1.0 / table["bulk"]
    for words in (r"largest viscous rate times time step (\S+)", r"times the largest viscous rate is (\S+):"):
        assert float(re.search(words, log)[1]) == pytest.approx(0.01 * rate, rel=5e-3)


# ---------------------------------------------------------------------------------------------
# the skin of the neighbor list

def stream(skin, speed=1.0, options="", lists="every 1 delay 0 check yes"):
    """A periodic fluid that is carried along as a whole: its list lasts until it has moved by half of the skin."""
    return (f"{header(2)}read_data data.txt\npair_style sph/bulk {options}\npair_coeff * * 1.0 10.0 0.5 intrinsic 3.0\n"
            f"neighbor {skin} bin\nneigh_modify {lists}\nvelocity all set {speed} 0.0 0.0\nfix 1 all sph/bulk\ntimestep 0.02\nrun 100\n")


def best_skin(log):
    """(steps for which a list lasts, recommended skin, percent) of the line below the table, or nothing"""
    found = re.search(r"a neighbor list with skin \S+ lasts (\d+) steps; the fastest skin is (\S+), with an estimated (\d+) % less time", log)
    return found and tuple(float(number) for number in found.groups())


@pytest.mark.parametrize("skin, steps", [(0.05, 2), (0.081, 3), (8.0, 200)])
def test_life_of_a_neighbor_list(lammps, skin, steps):
    """As many rebuilds as the line says, and what it recommends needs no recommendation."""
    lattice(2, 12).write(lammps.path("data.txt"))
    log = lammps(stream(skin)).log
    lasts, best, percent = best_skin(log)
    assert lasts == steps and percent >= 10
    assert int(re.findall(r"^Neighbor list builds = (\d+)", log, re.MULTILINE)[-1]) == 100 // steps
    assert best_skin(lammps(stream(best)).log) is None
    # the sum of a term proportional to the skin and one inverse to it, 0.3 skin/rc + 1.5 u dt/skin, has its minimum there
    assert best == pytest.approx(np.sqrt(1.5 * 0.02 * 3.0 / 0.3), rel=0.05)


@pytest.mark.parametrize("case", [{"speed": 0.0}, {"options": "temp 1e-3 1"}, {"lists": "every 5 delay 0 check no"}])
def test_no_recommended_skin(lammps, case):
    """At rest, with thermal motion, and for lists that are built without looking at the particles."""
    lattice(2, 12).write(lammps.path("data.txt"))
    assert best_skin(lammps(stream(0.05, **case)).log) is None


@pytest.mark.parametrize("skin, times, speed", [(3.0, None, 0.0), (4.5, "6.2", 0.0), (4.5, "6.2", 1.0)])
def test_skin_above_the_support(lammps, skin, times, speed):
    """... is too long for any speed: a warning, once."""
    lattice(2, 12).write(lammps.path("data.txt"))
    log = lammps(stream(skin, speed=speed) + "run 0\n").log
    found = re.findall(r"the skin of the neighbor list, (\S+), is 1.5 support radii, with which the list is (\S+) times as long as without; use neighbor 0.3 bin", log)
    assert found == ([("4.5", times)] if times else [])


@pytest.mark.parametrize("speed, options, warned", [(4.0, "", True), (2.0, "", False), (0.0, "", False), (4.0, "eos ideal", False), (4.0, "temp 1e-6 1", False)])
def test_liquid_faster_than_its_sound(lammps, speed, options, warned):
    """Above 0.3 c0 the density is far from constant, but not that of a fluid that moves as a whole; a gas has another speed of sound."""
    disordered(2, 12, jitter=0.1, speed=0.0).write(lammps.path("data.txt"))
    gas = "gamma 1.4 cv 100" if "ideal" in options else ""
    found = [line for line in lammps(header(2) + f"read_data data.txt\npair_style sph/bulk {options}\n"
                                     f"pair_coeff * * 1 10 0.1 0.2 {SUPPORT[2]} {gas}\nvelocity all ramp vx -{speed} {speed} y 0 12\nvelocity all set 20 0 0 sum yes\n"
                                     "fix FLUID all sph/bulk\ntimestep 0.01\nneigh_modify every 1 check no\nrun 3\n").warnings
             if "are faster than 0.3 c0: the liquid is compressed" in line]
    assert len(found) == warned
