"""The loops for every instruction set of this processor give the same forces to round-off."""

import re

import pytest

from helpers import disordered, dump, fluid, header, relative

INSTRUCTION_SETS = ("default", "avx2", "avx512")
BOUND = 1e-13


def fields(lammps, monkeypatch, instruction_set, particles, options):
    """Forces, heating and number densities, and the name of the loops that LAMMPS printed."""
    monkeypatch.setenv("SPH_DISSIPATION_SIMD", instruction_set)
    particles.write(lammps.path("box.data"))
    result = lammps(header(particles.dim) + "read_data box.data\n" + fluid(particles.dim, options)
                    + "fix FLUID all sph/bulk\n" + dump("out.dump") + "run 0\n")
    frame = lammps.frame("out.dump")
    return {name: frame[name] for name in ("f", "desph", "numden", "dnumden")}, \
        re.search(r"(\w+) loops", result.log)[1]


@pytest.mark.parametrize("kernel", ["wendland/c2", "wendland/c4", "wendland/c6", "cubic", "quintic", "lucy"])
@pytest.mark.parametrize("options", ["shear mg bulk density", "shear mg/fr bulk volume", "shear morris bulk volume",
                                     "shear espanol bulk density"])
def test_instruction_sets_agree(lammps, monkeypatch, kernel, options):
    particles = disordered(3, (7, 8, 9))
    results = [fields(lammps, monkeypatch, name, particles, f"kernel {kernel} {options}")
               for name in INSTRUCTION_SETS]
    expected, _ = results[0]
    for values, _ in results[1:]:
        for name, value in values.items():
            assert relative(value - expected[name], expected[name]) < BOUND, name


def test_wish_is_obeyed_as_far_as_the_processor_can(lammps, monkeypatch):
    particles = disordered(2, 8)
    used = [fields(lammps, monkeypatch, name, particles, "")[1] for name in INSTRUCTION_SETS]
    assert used[0] == "default"
    flags = set()
    try:
        with open("/proc/cpuinfo") as file:
            flags = set(re.search(r"^flags\s*:(.*)$", file.read(), re.MULTILINE)[1].split())
    except (OSError, TypeError):
        pytest.skip("this machine does not tell what its processor can")
    if {"avx2", "fma"} <= flags:
        assert used[1] == "avx2"
    if {"avx2", "fma", "avx512f", "avx512dq", "avx512vl"} <= flags:
        assert used[2] == "avx512"
