"""Fixtures shared by the behaviour tests; the tools they hand out are in helpers.py.

The summary tells how near the deviations of a file are to their tolerances, as unittest/cpp/margin.h does for the tests in C++.
"""

import os
import re
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path[:0] = [str(Path(__file__).resolve().parents[2] / folder) for folder in ("python", "examples", "tools")]
from helpers import Lammps      # noqa: E402


def pytest_configure(config):
    config.addinivalue_line("markers", "long: runs with SPHD_ALL only, which ./sphd test --all sets")


def pytest_collection_modifyitems(config, items):
    if not os.environ.get("SPHD_ALL"):
        long = [item for item in items if item.get_closest_marker("long")]
        config.hook.pytest_deselected(items=long)
        items[:] = [item for item in items if item not in long]


@pytest.fixture
def lammps(tmp_path):
    """LAMMPS in a fresh folder of the test's own."""
    return Lammps(tmp_path)


@pytest.fixture(scope="module")
def shared_lammps(tmp_path_factory):
    """LAMMPS in one folder for all tests of a file, for results that several tests compare with."""
    return Lammps(tmp_path_factory.mktemp("shared"))


# ---------------------------------------------------------------------------------------------
# margins

ROUND_OFF, ROOM = 2e-7, 4.0    # larger tolerances are for errors of a method, the same on all processors, or for digits of a text
NUMBER = r"(?:np\.\w+\()?([-+]?[0-9.]+(?:e[-+]?[0-9]+)?)\)?"
COMPARISON = re.compile(f"(?<![\\w.]){NUMBER} <=? {NUMBER}(?![\\w.])")
Approx = type(pytest.approx(1.0))
margins = {}                   # by place: the largest ratio of a deviation to its tolerance, and this tolerance


def of_round_off(tolerance, size, relative):
    """Whether a tolerance is; without a relative one, small numbers of any size may be."""
    return tolerance < ROUND_OFF * abs(size) or not relative and tolerance < 5e-3 * ROUND_OFF


def note_margin(ratio, tolerance, place):
    """Of comparisons that hold: what is beyond its tolerance belongs to a test that wants a difference, or has failed."""
    if ratio <= 1.0 and (place not in margins or ratio > margins[place][0]):
        margins[place] = ratio, tolerance


def pytest_assertion_pass(item, lineno, orig, expl):
    """assert deviation < tolerance"""
    for deviation, tolerance in COMPARISON.findall(expl.partition("\n")[0]):
        if 0.0 < float(tolerance) < ROUND_OFF:
            note_margin(abs(float(deviation)) / float(tolerance), float(tolerance), f"{os.path.basename(item.location[0])}:{lineno}")


def caller():
    """The line of a test that compares by a function."""
    frame = sys._getframe(2)
    while frame and (frame.f_code.co_filename == __file__ or os.path.dirname(frame.f_code.co_filename) != os.path.dirname(__file__)):
        frame = frame.f_back
    return f"{os.path.basename(frame.f_code.co_filename)}:{frame.f_lineno}" if frame else "?"


def approx_equal(self, actual, compare=Approx.__eq__):
    same = compare(self, actual)
    if same and np.ndim(actual) == 0 and actual != self.expected and of_round_off(self.tolerance, self.expected, self.rel):
        note_margin(abs(actual - self.expected) / self.tolerance, self.tolerance, caller())
    return same


def assert_allclose(actual, desired, rtol=None, atol=0.0, compare=np.testing.assert_allclose, **kwargs):
    """atol alone means no rtol: with numpy's default, 1e-7 of the number would pass, too."""
    if rtol is None:
        rtol = 0.0 if np.any(atol) else 1e-7
    compare(actual, desired, rtol=rtol, atol=atol, **kwargs)
    size = np.abs(desired).max(initial=0.0)
    allowed = np.broadcast_to(atol + rtol * np.abs(desired), np.broadcast(actual, desired).shape)
    if (allowed > 0.0).any() and of_round_off(allowed.max(), size, rtol):
        ratio = np.abs(np.subtract(actual, desired))[allowed > 0.0] / allowed[allowed > 0.0]
        note_margin(ratio.max(), allowed.max(), caller())


# pytest: rel alone means no absolute tolerance; with its default, 1e-12, small numbers would have more
Approx.__eq__ = approx_equal
Approx.DEFAULT_ABSOLUTE_TOLERANCE = 0.0
np.testing.assert_allclose = assert_allclose


def pytest_terminal_summary(terminalreporter):
    for place, (ratio, tolerance) in margins.items():
        if ratio * ROOM > 1.0:
            terminalreporter.write_line(f"less than a factor of {ROOM:g} of room: {ratio:.2g} of the tolerance {tolerance:.1e}, {place}")
    if margins:
        terminalreporter.write_line(f"largest deviation: {max(margins.values())[0]:.2g} of its tolerance")
