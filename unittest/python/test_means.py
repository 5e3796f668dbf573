"""Means over periods of a wave, against signals and a wave whose means are known."""

import re
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from sph_dissipation import flow_means, period_means
from sph_dissipation.means import window


def test_window():
    """boxes of width 1, convolved"""
    fine = np.linspace(-3, 3, 6001)
    box = np.where(abs(fine) < 0.5 + 1e-6, 1.0, 0.0)
    inside = abs(abs(fine) - 0.5) > 1e-6
    np.testing.assert_allclose(window(fine, 1)[inside], box[inside], atol=1e-14)
    convolved = box
    for order in (2, 3, 4):
        convolved = np.convolve(convolved, box / box.sum(), "same")
        np.testing.assert_allclose(window(fine, order), convolved, atol=2e-3)
        assert window(fine, order).sum() * (fine[1] - fine[0]) == pytest.approx(1, abs=1e-7)


@pytest.mark.parametrize("samples", [16, 16.37, 40])    # in a period
@pytest.mark.parametrize("order", [1, 2, 3])
def test_harmonics_and_trend_leave_nothing(samples, order):
    t = np.arange(200) / samples
    signal = 3 + 0.1 * t + 100 * np.cos(2 * np.pi * t + 0.3) + 20 * np.sin(4 * np.pi * t)
    times, means = period_means(t, np.column_stack([signal, -signal]), 1.0, order=order)
    assert times[0] == pytest.approx(order / 2, abs=1 / samples) and len(times) == len(means) > 10
    np.testing.assert_allclose(means, np.outer(3 + 0.1 * times, (1, -1)), atol=1e-10)


@pytest.mark.parametrize("wrong, decay", [(1.02, 0.0), (1.0, 0.02)])
def test_windows_suppress_leakage(wrong, decay):
    """A period that is 2 percent off, or a decay of 0.02 of the frequency: each order takes one power more of it."""
    t = np.arange(0, 12, 1 / 32)
    wave = np.exp(-2 * np.pi * decay * t) * np.cos(2 * np.pi * t)
    left = [abs(period_means(t, wave, wrong, order=order, harmonics=0)[1]).max() for order in (1, 2, 3, 4)]
    assert all(fine < 0.05 * coarse for coarse, fine in zip(left, left[1:]))
    assert left[2] < 2e-5


def test_wave_of_second_order():
    """Places that particles of a travelling wave pass: Stokes drift a^2 k/(2 w), radiation stress rho a^2/2, for a velocity a cos(kx - wt) with
    the density that the mass balance has. The mean of the velocity at a fixed place is that of the flow."""
    a, k, w, stream = 0.02, 2 * np.pi, 2 * np.pi * 3.0, 0.001
    t = np.arange(0, 6 / 3.0, 1 / 150)
    x = np.arange(8) / 8
    u = stream + a * np.cos(k * x - w * t[:, None])
    density = 1 / (1 - a * k / w * np.cos(k * x - w * t[:, None]))     # (w/k - u + stream) rho = w/k: constant in the frame of the wave
    means = flow_means(t, density, u[..., None], 1 / 3.0, pressure=9.0 * (density - 1))
    np.testing.assert_allclose(means.eulerian[..., 0], stream, atol=1e-12)
    drift = a * a * k / (2 * w)
    np.testing.assert_allclose(means.transport[..., 0] - stream, drift, rtol=1e-4)    # up to the fourth order
    np.testing.assert_allclose(means.density, 1 / np.sqrt(1 - (a * k / w)**2), rtol=1e-9)
    pressure = 9.0 * (means.density - 1)
    np.testing.assert_allclose(means.stress[..., 0, 0] - pressure, a * a / 2, rtol=1e-3)

    path = solve_ivp(lambda t, x: stream + a * np.cos(k * x - w * t), (0, t[-1]), x, t_eval=t, rtol=1e-11, atol=1e-13).y.T
    velocity = stream + a * np.cos(k * path - w * t[:, None])
    _, lagrangian = period_means(t, velocity, 1 / 3.0)
    np.testing.assert_allclose(lagrangian - stream, drift, rtol=0.02)    # its period is another one by the drift itself


def test_means_of_means_in_lammps(lammps):
    """fix ave/time of fix ave/time, as on the page, is the window of order 2"""
    page = (Path(__file__).resolve().parents[2] / "doc" / "src" / "Howto_sph_streaming.rst").read_text()
    recipe = re.search(r"^   (variable +period .*\n(?:   .*\n)+)", page, re.MULTILINE)[1].replace("\n   ", "\n")
    recipe = "".join(line for line in recipe.splitlines(True) if "variable flow" not in line)
    lammps("dimension 2\nregion box block 0 3 0 3 -0.5 0.5\ncreate_box 1 box\nlattice sq 1.0\ncreate_atoms 1 box\nmass 1 1.0\npair_style zero 1.0\n"
           "pair_coeff * *\nvariable flow equal 1.0+0.001*step+cos(2*PI*step/v_period)+0.2*(step%7)\n" + recipe + "run 300\n")
    step, found = np.loadtxt(lammps.path("mean.txt")).T
    t = np.arange(301)
    flow = 1 + 0.001 * t + np.cos(2 * np.pi * t / 100) + 0.2 * (t % 7)
    boxes = np.convolve(np.ones(100), np.ones(100)) / 1e4
    np.testing.assert_allclose(found[step >= 200], np.convolve(flow, boxes, "valid")[2:], rtol=1e-5)


@pytest.mark.parametrize("arguments, message", [
    (([0, 1, 2], [1, 2, 3], 1.0), "2 of time is less than 3 periods of 1"),
    ((np.arange(9), np.arange(9), 2.0), "7 samples in 3 periods are too few for 2 harmonics"),
    (([0, 2, 1], [1, 2, 3], 1.0), "increasing"), (([0, 1], [1, 2, 3], 1.0), "one time for each row"), (([0, 1], [1, 2], -1.0), "period > 0")])
def test_errors(arguments, message):
    with pytest.raises(ValueError, match=message):
        period_means(*arguments)
