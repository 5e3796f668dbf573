"""The Python package in python/: installed, without numpy, its readers against those of LAMMPS, and its notebooks."""

import json
import os
import re
import shutil
import subprocess
import sys
from importlib.metadata import distributions
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

import sph_dissipation as sph
from helpers import INTEGRATE, disordered, fluid, header
from sph_dissipation import plan
from test_pages import blocks

ROOT = Path(__file__).resolve().parents[2]
CASE = "--fluid CO2 --frequency 30e3 --particles 20"


def printed(*command, **environment):
    done = subprocess.run([sys.executable, *command], cwd=environment.pop("cwd", None), env={**os.environ, **environment}, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_install(tmp_path):
    """pip builds it from the tree, with the files that it reads, and with the version number of the package."""
    if not (find_spec("pip") and find_spec("setuptools") and find_spec("wheel")):
        pytest.skip("no pip, setuptools, and wheel")
    for name in ("python", "potentials"):
        shutil.copytree(ROOT / name, tmp_path / name, symlinks=True)
    shutil.copy(ROOT / "VERSION", tmp_path)
    target = tmp_path / "target"
    printed("-m", "pip", "install", "--no-deps", "--no-index", "--no-build-isolation", "--target", str(target), str(tmp_path / "python"))
    shutil.rmtree(tmp_path / "potentials")
    text = printed("-m", "sph_dissipation.plan", *CASE.split(), "--lmp", "none", cwd=tmp_path, PYTHONPATH=str(target))
    assert plan.Plan(plan.arguments(CASE.split())).input().partition("\n\n")[2] in text
    printed("-c", "import sph_dissipation as sph; sph.fluids.find('water'); sph.pyplot()", cwd=tmp_path, PYTHONPATH=str(target))
    (found,) = distributions(path=[str(target)])
    assert found.version.startswith((ROOT / "VERSION").read_text().strip().partition("-")[0])


def test_copy_without_the_fluids(tmp_path):
    """The fluids are a link of the sources: a copy of it alone says what to do."""
    shutil.copytree(ROOT / "python" / "sph_dissipation", tmp_path / "sph_dissipation", symlinks=True)
    done = subprocess.run([sys.executable, "-c", "import sph_dissipation as sph; sph.fluids.find('water')"], cwd=tmp_path, env={**os.environ, "PYTHONPATH": ""},
                          stderr=subprocess.PIPE, text=True, check=False)
    assert "cp -rL" in done.stderr


def test_without_numpy():
    """./sphd plan works with a Python that has nothing else."""
    text = printed("-S", "-c", "import sys; from sph_dissipation import plan; plan.main(); assert 'numpy' not in sys.modules", *CASE.split(), "--lmp",
                   "none", PYTHONPATH=str(ROOT / "python"))
    assert plan.Plan(plan.arguments(CASE.split())).input().partition("\n\n")[2] in text


@pytest.fixture
def formats(monkeypatch):
    """lammps.formats, of the tree of LAMMPS from which the executable is built"""
    monkeypatch.syspath_prepend(Path(os.environ["SPHD_LMP"]).resolve().parent / "lammps-source" / "python")
    return pytest.importorskip("lammps.formats")


@pytest.mark.parametrize("example", ["brownian", "cavity", "couette", "taylor_green", "two_fluid_cup"])
def test_thermo(formats, example):
    path = ROOT / "examples" / example / f"log.4Jul26.{example}.g++.1"
    expected, found = formats.LogFile(str(path)).runs, sph.thermo(path.read_text())
    assert len(expected) == len(found) > 0
    for wanted, columns in zip(expected, found):
        assert list(wanted) == list(columns)
        for name in wanted:
            np.testing.assert_array_equal(wanted[name], columns[name])


def test_averages(formats, lammps):
    """of chunks and of vectors, of as many outputs as there are"""
    disordered(2, 8).write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\n" + fluid(2) + INTEGRATE + "compute C all chunk/atom bin/1d x lower 2.0\n"
           "fix C all ave/chunk 1 2 4 C vx density/mass file chunks.txt\ncompute V all pressure NULL virial\n"
           "fix V all ave/time 1 2 4 c_V c_V mode vector file vectors.txt\nrun 12\n")
    expected, found = formats.AvgChunkFile(str(lammps.path("chunks.txt"))), sph.averages(lammps.path("chunks.txt"))
    assert list(found) == list(expected.timesteps) == [4, 8, 12]
    for number, columns in enumerate(found.values()):
        assert list(columns) == ["Chunk", "Coord1", "Ncount", "vx", "density/mass"]
        for name in ("vx", "density/mass"):
            np.testing.assert_array_equal(columns[name], [chunk[name][number] for chunk in expected.chunks])
    vectors = sph.averages(lammps.path("vectors.txt"))
    assert list(vectors) == [4, 8, 12] and all(len(columns["Row"]) == 6 for columns in vectors.values())
    last = lammps.path("vectors.txt").read_text().split()[-1]
    assert vectors[12]["c_V"][-1] == float(last) == sph.read_array(lammps.path("vectors.txt"))[-1][-1, -1]


def test_gauges(lammps):
    """The file that the input of the manual's page writes, against the log."""
    (text,) = [code for _, _, code, _ in blocks(ROOT / "doc/src/Howto_sph_surface.rst") if "gauges.txt" in code]
    text = re.sub(r"ave/time 5 4 20", "ave/time 1 1 20", text).replace("thermo          100", "thermo 20").replace("run             $(round(v_end/dt))", "run 100")
    (log,) = lammps(text).thermo()
    found = sph.series(lammps.path("gauges.txt"))
    assert list(found) == ["step", "t", "front", "level", "tap", "pressure", "thrust"] and list(found["step"]) == list(log["Step"])
    for name, column in (("front", "v_front"), ("level", "c_gauge[2]"), ("pressure", "c_gauge[1]"), ("thrust", "c_thrust")):
        np.testing.assert_allclose(found[name], log[column], rtol=1e-5, atol=1e-12)


# what makes it short; figures; lines of results; relative errors of those stored, and of the short one
NOTEBOOKS = {
    "sound": (("--particles 64", "--particles 32"), 2, r"^(?P<name>frequency|damping) +(?P<found>\d+) \S+ +theory (?P<theory>\d+) ", 0.02, 0.08),
    "dam_break": (("n, end = 30, 4.0", "n, end = 15, 3.2"), 2, r"^(?P<name>arrival at the wall) (?P<found>\S+), experiment (?P<theory>\S+)$", 0.03, 0.05),
    "streaming": (("n, ratios = 80", "n, ratios = 40"), 1, r"^(?P<name>kappa/mu given) +(?P<theory>\d+), from the flow (?P<found>\S+)$", 0.05, 0.2),
    "colloid": (("places = 960000, range(4, 20)", "places = 48000, (18,)"), 1, r"(?P<name>[IM] \S+/kT) (?P<found>[\d.]+),(?=.* theory (?P<theory>1)$)", 0.05, 0.6)}


@pytest.mark.parametrize("name", ["sound", "dam_break", *(pytest.param(name, marks=pytest.mark.long) for name in ("streaming", "colloid"))])
def test_notebook(name, capsys, monkeypatch):
    """Its cells run in their order, here with fewer particles or steps; what is stored is what they leave, and it is no larger than 300 kB."""
    words, figures, results, kept, short = NOTEBOOKS[name]
    path = ROOT / "python" / f"{name}.ipynb"
    notebook = json.loads(path.read_text(encoding="utf-8"))
    assert notebook["nbformat"] == 4 and path.stat().st_size < 300_000
    code = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert [cell["execution_count"] for cell in code] == list(range(1, len(code) + 1))
    stored = "".join("".join(output.get("text", [])) for cell in code for output in cell["outputs"])
    assert sum("image/png" in output.get("data", {}) for cell in code for output in cell["outputs"]) == figures
    monkeypatch.chdir(path.parent)
    plt, space, sources = sph.pyplot(), {}, ["".join(cell["source"]) for cell in code]
    assert "".join(sources).count(words[0]) == 1
    for number, source in enumerate(sources, 1):
        exec(compile(source.replace(*words), f"cell {number} of {path.name}", "exec"), space)
    plt.close("all")
    text = capsys.readouterr().out
    found = [[(one["name"], float(one["found"]), float(one["theory"])) for one in re.finditer(results, output, re.MULTILINE)] for output in (stored, text)]
    assert len(found[0]) == len(found[1]) > 0
    for (what, value, theory), (again, quick, same) in zip(*found):
        assert (again, same) == (what, theory)
        assert value == pytest.approx(theory, rel=kept) and quick == pytest.approx(theory, rel=short)
    if name == "sound":
        assert text.startswith(stored.partition("\n# ")[0])      # the fluid, and the first line of the input
