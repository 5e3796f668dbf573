"""Linear and angular momentum over 1000 steps."""

import numpy as np
import pytest

from helpers import INTEGRATE, disordered, drop, dump, fluid, free, header

STEPS = 1000
BOUND = 1e-14  # of sum(m |v|) or sum(m |r x v|)


def evolve(lammps, particles, options, ranks=1, **head):
    particles.write(lammps.path("box.data"))
    mu = 0.0 if "shear none" in options else 0.5
    lammps(header(particles.dim, **head) + "read_data box.data\n" + fluid(particles.dim, options, mu=mu)
           + INTEGRATE + dump("out.dump", STEPS) + f"run {STEPS}\n", ranks=ranks)
    first, last = lammps.frames("out.dump")
    assert len(last["x"]) == len(particles), "particles left the box"
    assert np.abs(last["x"] - first["x"]).max() > 0.05, "nothing moved"
    return first, last


def evolve_drop(lammps, dim, radius, options):
    return evolve(lammps, drop(dim, radius), options, boundary=free(dim))


def linear_drift(first, last):
    momentum = [frame["mass"][:, None] * frame["v"] for frame in (first, last)]
    return np.abs(momentum[1].sum(0) - momentum[0].sum(0)).max() / np.linalg.norm(momentum[0], axis=1).sum()


def angular_drift(first, last):
    spin = [frame["mass"][:, None] * np.cross(frame["x"], frame["v"]) for frame in (first, last)]
    return np.abs(spin[1].sum(0) - spin[0].sum(0)).max() / np.linalg.norm(spin[0], axis=1).sum()


@pytest.mark.parametrize("dim, cells", [(1, 100), (2, 16), (3, 7)])
@pytest.mark.parametrize("options", ["shear mg bulk density", "shear mg/fr bulk volume eos tait",
                                     "shear morris bulk density eos ideal"])
def test_linear_momentum_in_a_periodic_box(lammps, dim, cells, options):
    drift = linear_drift(*evolve(lammps, disordered(dim, cells), options))
    print(f"linear momentum drift {drift:.2e}")
    assert drift < BOUND


@pytest.mark.parametrize("newton", ["on", "off"])
def test_linear_momentum_on_two_ranks(lammps, newton):
    drift = linear_drift(*evolve(lammps, disordered(2, 16), "", ranks=2, newton=newton))
    print(f"linear momentum drift {drift:.2e}")
    assert drift < BOUND


@pytest.mark.parametrize("dim, radius", [(2, 7.0), (3, 3.5)])
@pytest.mark.parametrize("options", ["shear mg bulk density", "shear mg bulk volume", "shear mg/fr bulk density",
                                     "shear mg/fr bulk volume", "shear mg/fr2", "shear none bulk density", "shear none bulk volume"])
def test_momentum_of_an_isolated_drop(lammps, dim, radius, options):
    first, last = evolve_drop(lammps, dim, radius, options)
    linear, angular = linear_drift(first, last), angular_drift(first, last)
    print(f"drift: linear {linear:.2e}, angular {angular:.2e}")
    assert linear < BOUND
    assert angular < BOUND


@pytest.mark.parametrize("dim, radius", [(2, 7.0), (3, 3.5)])
@pytest.mark.parametrize("options", ["shear morris bulk density", "shear morris bulk volume", "shear espanol"])
def test_shear_forms_that_lose_angular_momentum(lammps, dim, radius, options):
    first, last = evolve_drop(lammps, dim, radius, options)
    linear, angular = linear_drift(first, last), angular_drift(first, last)
    print(f"drift: linear {linear:.2e}, angular {angular:.2e}")
    assert linear < BOUND
    assert angular > 1e12 * BOUND

