"""Fixtures shared by the behaviour tests; the tools they hand out are in helpers.py."""

import pytest

from helpers import Lammps


@pytest.fixture
def lammps(tmp_path):
    """LAMMPS in a fresh folder of the test's own."""
    return Lammps(tmp_path)


@pytest.fixture(scope="module")
def shared_lammps(tmp_path_factory):
    """LAMMPS in one folder for all tests of a file, for results that several tests compare with."""
    return Lammps(tmp_path_factory.mktemp("shared"))
