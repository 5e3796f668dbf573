"""The page "Looking at a flow", word for word: its input, its lines of Python, and the files that they leave, read back."""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
from PIL import Image

from sph_dissipation import frames

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "doc" / "src" / "Howto_sph_looking.rst").read_text()
COLUMNS = ("density", "volume", "temperature", "pressure", "radius", "omegaz")


def blocks(language):
    return [re.sub(r"^   ", "", text, flags=re.MULTILINE)
            for text in re.findall(rf"^\.\. code-block:: {language}\n\n((?:   .*\n|\n)+)", PAGE, re.MULTILINE)]


def test_page(tmp_path):
    lmp = Path(os.environ["SPHD_LMP"]).resolve()
    (tmp_path / "in.looking").write_text(blocks("LAMMPS")[0])
    environment = dict(os.environ, LD_LIBRARY_PATH=str(lmp.parent), PYTHONPATH=str(lmp.parent / "lammps-source" / "python"))

    def run(*command):
        done = subprocess.run(command, cwd=tmp_path, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300)
        assert done.returncode == 0, done.stdout
        return done.stdout

    run(str(lmp), "-in", "in.looking")
    found = frames(tmp_path / "flow.dump")
    steps = list(found)
    assert steps == [0, 100, 200, 300, 400, 500]
    last = found[500]
    assert abs(last["density"] - 1).max() < 0.05 and abs(last["omegaz"]).max() > 0.1
    np.testing.assert_allclose(last["pressure"], 100 * (last["density"] - 1), atol=1e-3)
    np.testing.assert_allclose(last["radius"], 0.5 * np.sqrt(last["volume"]), rtol=1e-4)
    assert last["temperature"].max() > 1.001      # of the heat of friction

    # pictures: as large as asked for, and with the colors of the scale
    pictures = sorted(tmp_path.glob("flow.*.png"))
    assert len(pictures) == len(steps)
    with Image.open(pictures[0]) as picture:
        assert picture.size == (600, 600)
        colors = np.array(picture.convert("RGB")).reshape(-1, 3)
    white = (colors > 250).all(axis=1)
    assert 0.05 < 1 - white.mean() < 0.99 and len(np.unique(colors[~white], axis=0)) > 100

    gif, log, module, package = blocks("python")
    run(sys.executable, "-c", gif)
    with Image.open(tmp_path / "flow.gif") as movie:
        assert movie.n_frames == len(steps)
    time, kinetic = map(float, run(sys.executable, "-c", log).split())
    assert time > 0 and 0 < kinetic < 0.25
    if "UBSAN_OPTIONS" not in os.environ:      # Python is not built with the sanitizers
        density, temperature = map(float, run(sys.executable, "-c", module).split()[-2:])
        assert abs(density - last["density"].mean()) < 1e-5 and abs(temperature - last["temperature"].max()) < 1e-4

    environment["PYTHONPATH"] = str(ROOT / "python")
    numbers = list(map(float, run(sys.executable, "-c", package).split()))
    assert numbers[:2] == [time, kinetic] and numbers[2] == last["density"].max()
    assert numbers[3] == 1496.7 and abs(numbers[4] / 0.021179 - 1) < 1e-3     # Stokes

    # VTK: each column is there as a whole, in the order of the dump
    run(sys.executable, str(ROOT / "tools" / "dump_to_vtk.py"), "flow.dump")
    files = sorted(tmp_path.glob("flow.*.vtk"))
    assert len(files) == len(steps)
    words = files[-1].read_text().split()
    count = len(last["id"])

    def array(keyword, skip, width):
        begin = words.index(keyword) + skip
        return np.array(words[begin:begin + width * count], dtype=float).reshape(count, width)

    assert words[words.index("POINTS") + 1] == words[words.index("POINT_DATA") + 1] == str(count)
    np.testing.assert_array_equal(array("POINTS", 3, 3)[:, :2], np.column_stack([last["x"], last["y"]]))
    np.testing.assert_array_equal(array("velocity", 2, 3)[:, :2], np.column_stack([last["vx"], last["vy"]]))
    for name in COLUMNS:
        np.testing.assert_array_equal(array(name, 5, 1)[:, 0], last[name])
