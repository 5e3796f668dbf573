"""Conduction of heat at time steps far beyond its explicit limit: keyword viscous of fix sph/bulk."""

import re

import numpy as np
import pytest

import test_heat as heat
import test_viscous as viscous
from helpers import disordered, dump, fluid, header, lattice, relative

SCHEMES, SECOND_ORDER, FULL = viscous.SCHEMES, viscous.SECOND_ORDER, heat.FULL
TEMPERATURE = heat.TEMPERATURE


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
           f"timestep {timestep!r}\n" + TEMPERATURE + dump("T.dump", round(end / timestep), "c_T") + f"run {round(end / timestep)}\n")
    first, last = lammps.frames("T.dump")
    shape = np.cos(2 * np.pi * first["x"][:, 0])
    start, left = (2 / N * (frame["c_T"] * shape).sum() for frame in (first, last))
    assert last["c_T"].mean() == pytest.approx(1.0, abs=1e-13)
    assert np.abs(last["c_T"] - 1.0 - left * shape).max() < 1e-9, "no other wave"
    return left / start


@pytest.mark.parametrize("name", SCHEMES)
def test_temperature_wave(lammps, name):
    """At 20 times the explicit limit: the sum over the line, with the order of the scheme."""
    N, R, cv, k, end = 48, 4.0, 2.0, 1.0, 0.18
    sums = heat.Line(N, R)
    rho = sums.c / N
    rate = k / (rho * cv) * sums.K
    errors = []
    for step in (0.0075, 0.00375, 0.001875):
        errors.append(np.log(wave(lammps, tight(name), step, end, N, R, cv, k)) + rate * end)
        if step == 0.0075:
            assert step > 20.0 * steps_of(lammps.results[-1].log)["heat"]
    print(name, errors)
