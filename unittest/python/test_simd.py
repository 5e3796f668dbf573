"""The loops for every instruction set of this processor give the same forces to round-off; keyword simd."""

import re

import pytest

from helpers import INTEGRATE, SUPPORT, disordered, dump, fluid, header, relative

INSTRUCTION_SETS = {"none": set(), "avx2": {"avx2", "fma"},
                    "avx512": {"avx2", "fma", "avx512f", "avx512dq", "avx512vl"}}    # and what the processor needs
BOUND = 1e-13


def box(lammps, particles, options, support=None):
    """A run of no steps; `options` are keywords of pair_style."""
    particles.write(lammps.path("box.data"))
    return lammps(header(particles.dim) + "read_data box.data\n" + fluid(particles.dim, options, support=support)
                  + "fix FLUID all sph/bulk\n" + dump("out.dump") + "run 0\n")


def loops(result):
    """The loops that LAMMPS says it uses."""
    return re.search(r"(\w+) loops", result.log)[1]


def available(lammps):
    """Instruction sets whose loops can run here; the others are refused with an error that says so."""
    found = []
    for name in INSTRUCTION_SETS:
        result = lammps(f"pair_style sph/bulk simd {name}\n", check=False)
        if result.code == 0:
            found.append(name)
        else:
            assert f"Pair_style sph/bulk simd {name}: not in this processor" in result.output
    assert "none" in found
    return found


def fields(lammps, particles, options, support=None):
    box(lammps, particles, options, support)
    frame = lammps.frame("out.dump")
    return {name: frame[name] for name in ("f", "desph", "numden", "dnumden")}


@pytest.mark.parametrize("kernel", ["wendland/c2", "wendland/c4", "wendland/c6", "cubic", "quintic", "lucy"])
@pytest.mark.parametrize("options", ["shear mg bulk density", "shear mg/fr bulk volume", "shear mg/fr2 volume mass", "shear morris bulk volume",
                                     "shear espanol bulk density"])
def test_instruction_sets_agree(lammps, kernel, options):
    particles = disordered(3, (7, 8, 9))
    expected = fields(lammps, particles, f"kernel {kernel} {options} simd none")
    for name in available(lammps)[1:]:
        for field, value in fields(lammps, particles, f"kernel {kernel} {options} simd {name}").items():
            assert relative(value - expected[field], expected[field]) < BOUND, (name, field)


@pytest.mark.parametrize("noise", ["", "temp 0.1 4711", "temp energy 30.0 4711"])
@pytest.mark.parametrize("ntypes", [2, 4, 5, 8, 9])
def test_coefficients_of_several_types(lammps, ntypes, noise):
    """As many as a vector has places, or fewer, or more."""
    disordered(3, (6, 6, 7)).write(lammps.path("box.data"))
    coeff = "".join(f"pair_coeff {t} {t} 1.0 10.0 {0.1 * t} {0.3 * t} {SUPPORT[3]}\n" for t in range(1, ntypes + 1))

    def forces(name):
        lammps(header(3) + f"read_data box.data extra/atom/types {ntypes - 1}\nvariable t atom 1+id%{ntypes}\n"
               + "set group all type v_t\nset group all sph/e 90.0\n"
               + fluid(3, f"{noise} shear espanol simd {name}", coeff=coeff) + INTEGRATE + dump("out.dump") + "run 1\n")
        frame = lammps.frame("out.dump")
        return {field: frame[field] for field in ("f", "desph")}

    expected = forces("none")
    for name in available(lammps)[1:]:
        for field, value in forces(name).items():
            assert relative(value - expected[field], expected[field]) < 10 * BOUND, (name, field)


@pytest.mark.parametrize("support", [0.9, 1.1, 1.3, 1.5, 1.7, 1.9])
def test_short_lists_of_neighbors(lammps, support):
    """Blocks that are filled up in every way: from no neighbor to some more than a vector has places."""
    particles = disordered(3, (5, 6, 7))
    options = "shear espanol bulk volume"
    expected = fields(lammps, particles, f"{options} simd none", support)
    for name in available(lammps)[1:]:
        for field, value in fields(lammps, particles, f"{options} simd {name}", support).items():
            assert relative(value - expected[field], expected[field]) < BOUND, (name, field)


def test_keyword(lammps):
    particles = disordered(2, 8)
    here = available(lammps)
    for name in here:
        assert loops(box(lammps, particles, f"simd {name}")) == ("plain" if name == "none" else name)
    best = loops(box(lammps, particles, "simd auto"))
    assert best == loops(box(lammps, particles, "")) == ("plain" if here[-1] == "none" else here[-1])
    for style in "sph/bulk", "sph/micropolar":
        result = lammps(f"pair_style {style} simd sse\n", check=False)
        assert result.code != 0 and f"Unknown simd sse for pair_style {style}" in result.output
    result = lammps("pair_style sph/bulk simd\n", check=False)
    assert result.code != 0 and "pair_style sph/bulk simd" in result.output


def test_everything_the_processor_has_is_used(lammps):
    """Whatever the compiler, if it is GCC or Clang or built on them."""
    try:
        with open("/proc/cpuinfo") as file:
            flags = set(re.search(r"^flags\s*:(.*)$", file.read(), re.MULTILINE)[1].split())
    except (OSError, TypeError):
        pytest.skip("this machine does not tell what its processor can")
    here = available(lammps)
    if here == ["none"]:
        pytest.skip("LAMMPS was built without loops for AVX2 and AVX-512")
    assert here == [name for name, needed in INSTRUCTION_SETS.items() if needed <= flags]


def test_restart_goes_to_another_machine(lammps):
    """A restart file does not hold the choice."""
    particles = disordered(2, 8)
    particles.write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\n" + fluid(2, "simd none") + INTEGRATE + "run 1\nwrite_restart state\n")
    result = lammps("read_restart state\n" + INTEGRATE + "run 1\n")
    assert loops(result) == loops(box(lammps, particles, "simd auto"))
