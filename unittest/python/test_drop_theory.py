"""The linear theory of an oscillating drop in examples/drop/exact.py, against closed forms."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

PATH = Path(__file__).resolve().parents[2] / "examples" / "drop" / "exact.py"
spec = importlib.util.spec_from_file_location("drop_exact", PATH)
exact = importlib.util.module_from_spec(spec)
spec.loader.exec_module(exact)


@pytest.mark.parametrize("n", [2, 3, 4])
def test_decay_of_a_drop_alone(n):
    """Lamb: 2 n (n - 1) nu/R^2 for small viscosities."""
    nu = 1e-4
    rate = exact.Drop(1.0, (1.0, nu), (1e-8, 1e-8 * nu), n=n).rate()
    assert rate.imag == pytest.approx(np.sqrt(n * (n * n - 1)), rel=1e-4)
    assert -rate.real == pytest.approx(2 * n * (n - 1) * nu, rel=0.01)


def test_lattice_sum():
    k = np.arange(-400, 401)
    place = (k[:, None] + 1j * k[None]).ravel()
    assert (place[place != 0]**-4.0).sum().real == pytest.approx(exact.LATTICE_SUM, rel=1e-5)


@pytest.mark.parametrize("box", [3.0, 4.0, 8.0])
def test_images_of_a_periodic_box(box):
    """The potential outside is a sum over all images: the mass that it adds, from its value and slope at the drop."""
    k = np.arange(-60, 61)
    place = box * (k[:, None] + 1j * k[None]).ravel()
    phi = (np.arange(16) + 0.5) * np.pi / 8
    near = np.exp(1j * phi)

    def potential(r):
        # images at opposite places cancel the odd terms; a constant changes nothing
        far = place[place != 0]
        return ((r * near)**-2.0 + sum((r * near - one)**-2.0 - one**-2.0 for one in far)).real

    def mode(values):
        return (values * np.cos(2 * phi)).mean() * 2

    h = 1e-4
    mass = -2 * mode(potential(1.0)) / ((mode(potential(1 + h)) - mode(potential(1 - h))) / (2 * h))
    drop = exact.Drop(1.0, (1.0, 1e-7), (1.0, 1e-7), box=box)
    assert drop.inviscid() == pytest.approx(np.sqrt(6 / (1 + mass)), rel=1e-4)
    assert drop.rate().imag == pytest.approx(drop.inviscid(), rel=1e-3)


def test_motion_from_rest():
    """At first that without viscosity, later that of the mode."""
    t = np.linspace(0.0, 20.0, 201)
    drop = exact.Drop(1.0, (10.0, 0.5), (1.0, 0.05), box=4.0)
    shape, rate = drop.shape(t), drop.rate()
    assert shape[0] == pytest.approx(1.0, abs=1e-4)
    assert shape[1] - 1 == pytest.approx(-0.5 * (drop.inviscid() * t[1])**2, rel=0.05)
    late = t > 10.0
    wave = np.column_stack([np.exp(rate.real * t[late]) * f(rate.imag * t[late]) for f in (np.cos, np.sin)])
    assert np.abs(shape[late] - wave @ np.linalg.lstsq(wave, shape[late], rcond=None)[0]).max() < 0.02 * np.abs(shape[late]).max()


def test_finite_range():
    """A short one is the tension of a line, and what it changes grows with its square."""
    errors = np.array([np.array(exact.finite_range(reach)) - 1 for reach in (0.1, 0.2)])
    assert np.abs(errors[0]).max() < 1e-3
    assert errors[1] / errors[0] == pytest.approx([4.0, 4.0], rel=0.02)
    # pressure: of second order in the curvature, <r^3>/<r> weighted by r W over 24, as of the area in common of shifted discs
    assert errors[0][0] == pytest.approx(0.1**2 / 72, rel=0.01)
