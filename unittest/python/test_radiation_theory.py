"""The theory of examples/radiation_force against its limits."""

import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("scipy")
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples" / "radiation_force"))
from scipy.special import hankel1, jv      # noqa: E402

from exact import Cylinder, Wave, added_mass, channel, elasticity, other_row, row, scattering, size      # noqa: E402

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


@pytest.mark.parametrize("body", [("wall",), ("rigid", 0.1), ("drop", 2.0, 1.0), ("drop", 0.5, 1.4)])
def test_force_is_bilinear_in_the_wave(body):
    """Phases of the whole wave do not count, and the velocity with what belongs to it takes a factor."""
    kind, *numbers = body
    cylinder, wave = Cylinder(kind, OMEGA, DELTA, KAPPA, *numbers), Wave(1 + 0.2j, 0.9 - 0.1j, 0.95, 0.03 - 0.01j, 0.02j)
    force, turn = cylinder.force(8.0, wave, points=300), np.exp(0.7j)
    turned = Wave(turn * wave.velocity, turn * wave.slope, wave.shear, turn * wave.push, turn * wave.push_slope)
    more = wave._replace(velocity=3 * wave.velocity, push=3 * wave.push)
    assert cylinder.force(8.0, turned, points=300) == pytest.approx(force, rel=1e-10)
    assert cylinder.force(8.0, more, points=300) == pytest.approx(3 * force, rel=1e-10)


@pytest.mark.parametrize("push", [0.02, 0.02j])
def test_drive(push):
    """The pressure has the gradient of the drive less that of the inertia: without a steady flow, a body force changes the force of the volume and the
    dipole as the formula says."""
    for body in (("rigid", 5.0), ("drop", 2.0, 0.8), ("drop", 0.5, 1.4142, 0.3)):
        kind, *numbers = body
        cylinder = Cylinder(kind, OMEGA, DELTA, KAPPA, *numbers)
        dipole, _ = cylinder.first_order(1.0, push)
        formula = ((1 - cylinder.expansion) / (1j * OMEGA)).conjugate() * (-1j * OMEGA - push) + dipole.conjugate()
        found, _ = cylinder.mean_force(4 * np.pi, 10.0, np.pi, Wave(push=push))
        assert found == pytest.approx(formula.real, abs=2e-4)


def test_gradient_of_the_drive():
    """A body force with a gradient acts on a drop of another density, not on one of another compressibility alone; a light drop and a heavy one go
    opposite ways."""
    changes = []
    for numbers in ((1.0, 2.0), (2.0, 1.0), (0.5, 1.4142)):
        cylinder = Cylinder("drop", OMEGA, DELTA, KAPPA, *numbers)
        changes.append(cylinder.mean_force(4 * np.pi, 10.0, np.pi, Wave(push_slope=0.02j))[0] - cylinder.mean_force(4 * np.pi, 10.0, np.pi)[0])
    assert abs(changes[0]) < 1e-4
    assert changes[1] > 0.02 and changes[2] < -0.02


LIMITS = [("wall", 1, 1, 0, 3), ("rigid", 0.1, 1, 0, 1 - 1.8 / 1.1), ("drop", 2, 1, 0, 0.5 + 2 / 3), ("drop", 1, 2, 0, 0.75),
          ("rigid", 0.5, 1, 0.4, 1 - 2 * 0.74 / 1.26), ("drop", 0.5, 1, 0.4, -1 - 2 * 0.74 / 1.26)]


@pytest.mark.parametrize("kind, ratio, c, hold, small", LIMITS)
def test_size(kind, ratio, c, hold, small):
    """Small cylinders without viscosity, those with a spring of the density ratio - hold^2 (ratio + 1) in motion; the next order is (ka)^2, with a
    logarithm."""
    errors = [channel(kind, k, 1e-5, ratio, c, hold)[0] - small for k in (0.01, 0.1)]
    assert abs(errors[0]) < 1e-3
    assert abs(errors[0]) < 0.05 * abs(errors[1])


@pytest.mark.parametrize("kind, ratio, c, hold", [case[:4] for case in LIMITS])
def test_small_cylinder_in_a_viscous_fluid(kind, ratio, c, hold):
    """At any thickness of the layer, force and velocity of a small cylinder are those of an incompressible flow around it."""
    cylinder = Cylinder(kind, 1e-3, DELTA, 0.0, ratio, c, hold)
    force, speed = channel(kind, 1e-3, DELTA, ratio, c, hold)
    assert force == pytest.approx(cylinder.expansion_and_dipole().real, abs=2e-5)
    exact = -1e-3j * (1 + added_mass(DELTA)) if kind == "wall" else cylinder.first_order(1.0, 0.0)[1]
    assert speed == pytest.approx(exact, rel=2e-5)


def test_row_of_small_cylinders():
    """The static sum over the next periods, which the runs use: each dipole d raises the velocity by pi^2 d/(6 width^2)."""
    width, delta = 10.0, DELTA
    alone, among = (channel("drop", 1e-4, delta, 0.5, 1.4142, width=one)[1] for one in (None, width))
    dipole, _ = Cylinder("drop", 1e-4, delta, 0.0, 0.5, 1.4142).first_order(1.0, 0.0)
    other = np.pi**2 / (6 * width**2)
    assert among / alone == pytest.approx(1 / (1 - other * dipole), rel=1e-5)


@pytest.mark.parametrize("kind, ratio, c", [("wall", 1, 1), ("drop", 0.5, 1.4142), ("rigid", 5, 1)])
def test_momentum_of_the_plane_waves(kind, ratio, c):
    """Without viscosity, the force on the cylinders of a row is the difference of the momentum that plane waves carry on both sides."""
    k, width, place = 0.25, 10.0, 0.6
    force, _ = channel(kind, k, 1e-6, ratio, c, place=place, width=width)
    factors, _ = scattering(kind, k, 1e-6, ratio, c)
    # the waves that the cylinders send out
    n = np.arange(-3, 4)
    wave = 0.5 * 1j**n * (np.exp(1j * place) + (-1.0)**n * np.exp(-1j * place))
    others = np.array([[row(one - two, k, width) if (one - two) % 2 == 0 else 0 for two in n] for one in n])
    out = factors[abs(n)] * np.linalg.solve(np.eye(7) - others * factors[abs(n)], wave)
    ahead, behind = (2 / (k * width) * (out * (sign * -1j)**n).sum() for sign in (1, -1))
    right = abs(0.5 * np.exp(1j * place) + 0.5 * ahead)**2 + abs(0.5 * np.exp(-1j * place) - 0.5 * behind)**2
    left = abs(0.5 * np.exp(1j * place) - 0.5 * ahead)**2 + abs(0.5 * np.exp(-1j * place) + 0.5 * behind)**2
    unit = 0.25 * np.pi * k * np.sin(2 * place)
    assert force == pytest.approx(0.5 * width * (left - right) / unit, rel=1e-5)


@pytest.mark.parametrize("n, m", [(0, 0), (1, 1), (0, 1), (2, 1), (1, -1), (2, -1)])
def test_another_row(n, m):
    """Evanescent waves of a row of cylinders against the sum over its cylinders."""
    k, width, distance = 0.25, 10.0, 6.0
    place = np.arange(-4000, 4001)
    smooth = np.exp(-(place / 1500.0)**8)

    def field(x, y):
        dx, dy = x + distance, y - width * place
        plane = 2 / (k * width) * (-1j)**m * np.exp(1j * k * dx)
        return (smooth * hankel1(m, k * np.hypot(dx, dy)) * np.exp(1j * m * np.arctan2(dy, dx))).sum() - plane

    angles, r = np.arange(16) * np.pi / 8, 1.0
    found = sum(field(r * np.cos(t), r * np.sin(t)) * np.exp(-1j * n * t) for t in angles) / 16 / jv(n, k * r)
    assert other_row(n, m, k, width, distance) == pytest.approx(found, rel=1e-4, abs=1e-4)


def test_walls_far_away():
    """Walls farther than the width of the box add nothing but plane waves."""
    near, far, none = (size("drop", 0.25, DELTA, 0.5, 1.4142, width=10.0, ends=ends) for ends in ((3.0, 9.0), (20.0, 20.0), None))
    assert far == pytest.approx(none, abs=1e-6)
    assert abs(near[0] - none[0]) > 1e-3


def test_elasticity_of_a_lattice():
    """The same kernel sums as in Howto_sph_streaming: larger supports, less of it; 4.25 spacings is near a zero."""
    assert elasticity(3) > 4 * elasticity(4) > 0
    assert abs(elasticity(4.25)) < 0.1 * elasticity(4)
