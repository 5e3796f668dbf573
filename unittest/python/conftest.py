"""Fixtures shared by the behaviour tests; the tools they hand out are in helpers.py."""

import os
import sys
from pathlib import Path

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
