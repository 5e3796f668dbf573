"""The theory of examples/radiation_force against its limits."""

import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("scipy")
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples" / "radiation_force"))
from exact import Cylinder, added_mass, elasticity, inviscid      # noqa: E402

OMEGA, DELTA, KAPPA = 0.25, 0.6, 0.09


def test_drop_of_the_same_fluid_has_no_force():
    drop = Cylinder("drop", OMEGA, DELTA, KAPPA)
    assert abs(drop.expansion_and_dipole()) < 1e-12
    assert abs(drop.force(8.0, points=400)) < 1e-9


def test_compressibility_alone_makes_no_steady_flow():
    """The boundary layer belongs to another density: the force of another compressibility is that of the formula, at any radius."""
    drop = Cylinder("drop", OMEGA, DELTA, KAPPA, 1.0, 2.0)
    assert drop.force(8.0) == pytest.approx(drop.expansion_and_dipole().real, abs=1e-4)


@pytest.mark.parametrize("body", [("wall",), ("rigid", 0.1), ("rigid", 5.0), ("drop", 2.0, 0.8), ("drop", 0.5, 1.4)])
def test_thin_layer(body):
    """The steady flow takes no momentum from a wave without a boundary layer; half of the layer, at most 0.6 of it."""
    kind, *numbers = body
    parts = []
    for delta in (0.02, 0.04):
        cylinder = Cylinder(kind, OMEGA, delta, 0.0, *numbers)
        parts.append(cylinder.force(5.0, points=4000) - cylinder.expansion_and_dipole().real)
    assert abs(parts[0]) < 0.004
    assert abs(parts[0]) < 0.6 * abs(parts[1])


def test_cylinder_at_rest_is_a_heavy_one():
    heavy, wall = Cylinder("rigid", OMEGA, DELTA, KAPPA, 1e7), Cylinder("wall", OMEGA, DELTA, KAPPA)
    assert heavy.expansion_and_dipole() == pytest.approx(wall.expansion_and_dipole(), rel=1e-5)
    assert heavy.force(8.0) == pytest.approx(wall.force(8.0), rel=1e-5)
    assert wall.expansion_and_dipole() == pytest.approx(2 + added_mass(DELTA), rel=1e-12)


@pytest.mark.parametrize("hold", [0.0, 0.3])
def test_first_order_of_a_rigid_body(hold):
    """G = (r - 1)(1 + K)/(r + K), where a spring takes its force off the inertia of r, not off the pressure of the volume."""
    ratio, mass = 0.1, added_mass(DELTA)
    spring = hold**2 * (ratio + 1)
    dipole, speed = Cylinder("rigid", OMEGA, DELTA, KAPPA, ratio, 1.0, hold).first_order(1.0, 0.0)
    assert speed == pytest.approx((1 + mass) / (ratio - spring + mass), rel=1e-10)
    assert dipole == pytest.approx((ratio - spring - 1) * (1 + mass) / (ratio - spring + mass), rel=1e-10)


@pytest.mark.parametrize("body", [("wall",), ("rigid", 0.1), ("drop", 2.0, 1.0)])
def test_steady_flow_is_linear_in_two_numbers(body):
    """Two radii at which the flow vanishes give the force for a third one."""
    kind, *numbers = body
    cylinder = Cylinder(kind, OMEGA, DELTA, KAPPA, *numbers)
    far = cylinder.expansion_and_dipole().real
    slopes = np.linalg.solve([cylinder.drawn(radius)[0][2:] for radius in (10.0, 30.0)], [cylinder.force(radius) - far for radius in (10.0, 30.0)])
    assert abs(cylinder.force(16.0) - far) > 0.02
    assert slopes @ cylinder.drawn(16.0)[0][2:] == pytest.approx(cylinder.force(16.0) - far, abs=1e-3)


@pytest.mark.parametrize("kind, ratio, c, hold, small", [
    ("wall", 1, 1, 0, 3), ("rigid", 0.1, 1, 0, 1 - 1.8 / 1.1), ("drop", 2, 1, 0, 0.5 + 2 / 3), ("drop", 1, 2, 0, 0.75),
    ("rigid", 0.5, 1, 0.4, 1 - 2 * 0.74 / 1.26), ("drop", 0.5, 1, 0.4, -1 - 2 * 0.74 / 1.26)])
def test_size(kind, ratio, c, hold, small):
    """Small cylinders without viscosity, those with a spring of the density ratio - hold^2 (ratio + 1) in motion; the next order is (ka)^2, with a
    logarithm."""
    errors = [inviscid(kind, k, ratio, c, hold) - small for k in (0.01, 0.1)]
    assert abs(errors[0]) < 1e-3
    assert abs(errors[0]) < 0.05 * abs(errors[1])


def test_elasticity_of_a_lattice():
    """The same kernel sums as in Howto_sph_streaming: larger supports, less of it; 4.25 spacings is near a zero."""
    assert elasticity(3) > 4 * elasticity(4) > 0
    assert abs(elasticity(4.25)) < 0.1 * elasticity(4)
