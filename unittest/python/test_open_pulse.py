"""What comes back from an open end: sound pulses, straight and oblique, at rest and in a stream, and a vortex.

The inputs and the measurement are those of examples/pulse_exit.
"""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

HERE = Path(__file__).resolve().parents[2] / "examples" / "pulse_exit"
spec = importlib.util.spec_from_file_location("pulse_exit", HERE / "run.py")
example = importlib.util.module_from_spec(spec)
spec.loader.exec_module(example)


def run(lammps, name, job, ranks=1):
    """An input of the example with other values of its variables."""
    text = "".join(f'variable {key} index "{value}"\n' for key, value in {**job, "out": "run"}.items())
    return lammps(text + (HERE / f"in.{name}").read_text(), ranks=ranks)


def reflection(lammps, job, ranks=1):
    run(lammps, "pulse_exit", job, ranks)
    return example.Pulse(lammps.folder, "run", job)


@pytest.mark.parametrize("width", [8, 16])
@pytest.mark.parametrize("stream", [0.0, 0.1])
def test_pulse_leaves(lammps, width, stream):
    assert reflection(lammps, example.pulse("lagged", width, stream)).reflection < example.BARS[width]


def test_hexagonal_rows(lammps):
    job = {**example.pulse("lagged", 8, 0.1), "arrangement": "hex"}
    assert reflection(lammps, job, ranks=2).reflection < example.BARS[8]


@pytest.mark.parametrize("outlet, least, most", [("characteristic", 0.1, 0.4), ("fixed", 0.5, 1.05)])
def test_pulse_that_does_not_leave(lammps, outlet, least, most):
    """Without the lag, the particles of the zone are not compressed as those of the wave are; fixed, they reflect it."""
    assert least < reflection(lammps, example.pulse(outlet, 8, 0.0)).reflection < most


@pytest.mark.parametrize("angle", [30, 45])
def test_oblique(lammps, angle):
    """As much as from a condition that is right for waves along its normal, and a twentieth more."""
    job = example.pulse("lagged", 1.2 * 16, 0.0, angle, 16, 14 * 16)
    assert reflection(lammps, job, ranks=2).reflection < np.tan(np.radians(angle / 2)) ** 2 + 0.05


def test_ranks(lammps):
    job = example.pulse("lagged", 8, 0.1)
    one, four = (reflection(lammps, job, ranks) for ranks in (1, 4))
    np.testing.assert_allclose(four.back, one.back, rtol=0, atol=1e-9 * np.abs(one.there).max())


def test_vortex_leaves(lammps):
    job = {"condition": "lagged", "outlet": "velocity 1.0 0.0 0.0 pressure 0.0", "length": 8, "width": 6, "end": 10}
    run(lammps, "pulse_exit_vortex", job)
    t, energy = np.loadtxt(lammps.path("run.history.txt"))[:, 1:3].T
    assert energy[t > 7.5].mean() < example.LEFT * energy[t < 1.25].mean()
