"""Against LAMMPS's own sdpd/taitwater/isothermal at zero temperature, which takes the density from us."""

import numpy as np
import pytest

from helpers import relative
from test_lammps_sph import C0, RHO0, ours_and_theirs

ETA = 0.6
# that style's factor 5/3 is that of 3d; in 2d it makes the fluid thicker than what it was asked for
MU = {2: 25 / 24 * ETA, 3: ETA}


# zero itself is refused; noise goes with the square root and cannot be seen in 16 digits
COLD = 1e-60


def sdpd(temperature=COLD):
    return f"pair_style sdpd/taitwater/isothermal {temperature} {ETA} 4711", f"{RHO0} {C0}"


def twin(dim, mu=None):
    return "kernel lucy eos tait shear espanol bulk none", MU[dim] if mu is None else mu


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("dim", [2, 3])
def test_forces_of_sdpd_at_zero_temperature(lammps, dim, ranks, newton):
    """Lucy kernel, Tait equation of state, Espanol-Revenga viscosity, no bulk term: the same forces."""
    ours, theirs = ours_and_theirs(lammps, dim, twin(dim), sdpd(), ranks, newton)
    assert relative(theirs["f"] - ours["f"], ours["f"]) < 1e-12
    assert relative(theirs["drho"] - ours["mass"] * ours["dnumden"], theirs["drho"]) < 1e-12


@pytest.mark.parametrize("dim", [2, 3])
def test_the_viscous_part_is_seen(lammps, dim):
    """The comparison above is sharp: another viscosity, another form or noise would be noticed."""
    plain, theirs = ours_and_theirs(lammps, dim, ("kernel lucy eos tait shear none bulk none", 0.0), sdpd())
    viscous = theirs["f"] - plain["f"]
    assert np.abs(viscous).max() > 0.1 * np.abs(plain["f"]).max()
    # in 2d the 4 % between eta and 25/24 eta
    ours, _ = ours_and_theirs(lammps, dim, twin(dim, 1.01 * MU[dim]), sdpd())
    assert relative(ours["f"] - theirs["f"], viscous) > 5e-3
    _, warm = ours_and_theirs(lammps, dim, twin(dim), sdpd(1e-6))
    assert relative(warm["f"] - theirs["f"], viscous) > 1e-4


@pytest.mark.parametrize("dim", [2, 3])
def test_espanol_is_monaghan_and_morris_together(lammps, dim):
    """mu = mu/(n+3) of mg + (n+2) mu/(n+3) of morris: one more way to the forces of SDPD."""
    def viscous(shear, mu):
        plain, _ = ours_and_theirs(lammps, dim, ("kernel lucy eos tait shear none bulk none", 0.0), sdpd())
        both, _ = ours_and_theirs(lammps, dim, (f"kernel lucy eos tait shear {shear} bulk none", mu), sdpd())
        return both["f"] - plain["f"]

    together = viscous("mg", MU[dim] / (dim + 3)) + viscous("morris", MU[dim] * (dim + 2) / (dim + 3))
    assert relative(together - viscous("espanol", MU[dim]), together) < 1e-11
