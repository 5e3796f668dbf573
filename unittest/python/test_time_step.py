"""The largest stable time step is that: runs at 0.9 of the printed one, one number at all places, and what it knows."""

import re

import numpy as np
import pytest

import open_boundaries as ends
import test_micropolar as micro
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
    "morris": (BULK, "shear morris", "{0} intrinsic"),
    "espanol": (BULK, "shear espanol", "{0} intrinsic"),
    "bulk": (BULK, "shear mg", "1.0 {0}"),
    "volume": (BULK, "shear morris bulk volume", "{0} {0}"),
    "shear": (MICRO, "", "{0} intrinsic {0} 0.0 0.0", 5.0),
    "vortex": (MICRO, "", "{0} intrinsic {0} 0.0 0.0", 0.2),
    "spin": (MICRO, "", "{0} intrinsic 0.1 {0} {1}", 0.15),
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
    """The step of the table and kinetic energies; no warning of it."""
    tail = "compute K fluid ke\nthermo_style custom step c_K\nthermo_modify norm no\n"
    first = lammps(text + tail + "timestep 1e-9\nrun 0\n")
    dt = part * steps_of(first.log)["all"]
    result = lammps(text + tail + f"timestep {dt!r}\nthermo {steps // 10}\nrun {steps}\n")
    assert not any("exceeds the largest" in line for line in result.warnings)
    return steps_of(first.log), result.thermo()[0]["c_K"]


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("dim, where", [(2, plane), (2, cup), (2, wheel), (3, plane)], ids=["plane", "cup", "wheel", "plane3d"])
def test_stable_between_walls(lammps, dim, where, form):
    particles, text, inertia = case(dim, form, where)
    if inertia:
        micro.write(particles, lammps.path("box.data"), inertia=inertia)
    else:
        particles.write(lammps.path("box.data"))
    table, energy = run(lammps, text)
    print(table, energy)
    assert table["all"] < 0.8 * table["acoustic"], "friction is to be the limit"
    if inertia:
        assert min(table, key=lambda name: table[name] if name != "all" else np.inf) == form
    assert energy[-1] < 0.5 * particles.mass.sum() * SPEED ** 2


@pytest.mark.parametrize("form", ["mg", "morris", "spin"])
def test_stable_with_open_ends(lammps, form):
    """A stream between walls from an inlet to an outlet."""
    style, options, coefficients, *inertia = FORMS[form]
    channel = ends.Channel(length=12, width=7, zone=8.0, support=3.0, box="walls")
    text = channel.text(lammps, f"velocity {0.5 * SPEED} 0 0", "pressure 0", lambda place: np.array([0.5 * SPEED, 0, 0]) + 0.0 * place,
                        "1.0 10.0 " + coefficients.format(25.0, -25.0) + " {R}", style, options, wall="slip no",
                        integrate="density rho0" + (f" inertia 0.0 {inertia[0]}" if inertia else ""))
    _, energy = run(lammps, text.replace("timestep 0.3\n", ""))
    print(energy)
    assert energy[-1] < 0.5 * len(channel.part) * SPEED ** 2
