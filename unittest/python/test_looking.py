"""The page "Looking at a flow", word for word: its input, its lines of Python, and the files that they leave, read back. Files that are
cut, packed, of other styles, or none of LAMMPS's."""

import gzip
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import sph_dissipation as sph
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


FRAME = """ITEM: TIMESTEP
{0}
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS pp pp pp
0 1
0 1
-0.5 0.5
ITEM: ATOMS id x y vx element
1 0.25 0.5 {0} Ar 
2 0.75 0.5 -0.5 He 
"""
DUMP = FRAME.format(0) + FRAME.format(10)


def to_vtk(*names, cwd):
    return subprocess.run([sys.executable, str(ROOT / "tools" / "dump_to_vtk.py"), *names], cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          check=False)


def test_cut_dump(tmp_path):
    """Wherever the last frame ends, the frames before are there, and a warning has the step of the cut one."""
    path = tmp_path / "cut.dump"
    third = FRAME.format(20)
    for end in range(1, len(third)):
        path.write_text(DUMP + third[:end])
        with pytest.warns(UserWarning, match=r"cut\.dump: the output of step (after 10|unknown|20) is cut") as seen:
            found = frames(path)
        assert list(found) == [0, 10] and list(found[10]["vx"]) == [10.0, -0.5] and list(found[10]["element"]) == ["Ar", "He"]
        assert len(seen) == 1 and (("step 20" in str(seen[0].message)) == (end > third.index("20")+ 2))
    path.write_text(DUMP + third[:-5] + FRAME.format(30))      # a run that was killed, and one that appends
    with pytest.warns(UserWarning, match="step 20 is cut"):
        assert list(frames(path)) == [0, 10, 30]
    path.write_text(DUMP + third[:-20])
    done = to_vtk("cut.dump", cwd=tmp_path)
    assert done.returncode == 0 and done.stdout == "cut.dump: 2 frames\n"
    assert done.stderr == "dump_to_vtk: cut.dump: the output of step 20 is cut, and left out\n"
    files = sorted(tmp_path.glob("*.vtk"))
    assert [file.name for file in files] == ["cut.0000.vtk", "cut.0001.vtk"]
    assert "element" not in files[0].read_text() and "SCALARS vx" in files[0].read_text()    # text is no number
    path.write_text(third[:-20])
    done = to_vtk("cut.dump", cwd=tmp_path)
    assert done.returncode == 1 and "cut.dump has no whole frame" in done.stderr


def test_other_files(tmp_path):
    """Packed dumps, and files that are no dumps: one line, and a status that is not 0."""
    (tmp_path / "x.dump.gz").write_bytes(gzip.compress(DUMP.encode()))
    (tmp_path / "bom.dump").write_text(DUMP, encoding="utf-8-sig")
    for name, vtk in [("x.dump.gz", "x.0001.vtk"), ("bom.dump", "bom.0001.vtk")]:
        assert list(frames(tmp_path / name)) == [0, 10]
        assert to_vtk(name, cwd=tmp_path).returncode == 0 and (tmp_path / vtk).exists()
    (tmp_path / "cut.dump.gz").write_bytes(gzip.compress((DUMP + FRAME.format(20)).encode())[:-20])
    with pytest.warns(UserWarning, match="is cut"):
        assert 0 in frames(tmp_path / "cut.dump.gz")
    bad = {"empty.dump": (b"", "not a text dump"), "flow.xyz": (b"2\n Atoms. Timestep: 0\n1 0 0 0\n1 0 0 0\n", "not a text dump"),
           "flow.bin": (bytes(range(256)), "not a text file"), "wide.dump": (DUMP.encode("utf-16"), "not a text file"),
           "names.dump": (DUMP.replace("element", "my element").encode(), "names must have no spaces"),
           "places.dump": (DUMP.replace(" x y ", " q r ").encode(), "no columns x y"), "none.dump": (None, "No such file"),
           "box.dump": (DUMP.replace(" x y ", " xs ys ").replace("-0.5 0.5\n", "-0.5\n").encode(), "ITEM: BOX BOUNDS has not the form"),
           "grid.dump": (b"ITEM: TIMESTEP\n0\nITEM: GRID SIZE nx ny nz\n1 1 1\nITEM: GRID CELLS ix iy iz f\n1 1 1 0\n", "has no ITEM: ATOMS or ENTRIES")}
    for name, (content, message) in bad.items():
        if content is not None:
            (tmp_path / name).write_bytes(content)
        done = to_vtk(name, cwd=tmp_path)
        assert done.returncode == 1 and message in done.stderr and done.stderr.count("\n") == 1 and done.stderr.count(name) == 1, done.stderr
        if name not in ("places.dump", "box.dump"):
            with pytest.raises((ValueError, OSError), match=message):
                frames(tmp_path / name)
    done = subprocess.run([sys.executable, str(ROOT / "tools" / "animate.py"), "nope"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 2 and "no animation of nope; there are: rotating_drop" in done.stderr and "Traceback" not in done.stderr


BOXES = {"orthogonal": "region box block -2 3 1 5 -1 4\n", "triclinic": "region box prism -2 3 1 5 -1 4 1.0 -0.5 0.7\n"}


@pytest.mark.parametrize("box", BOXES)
def test_scaled_places(lammps, box):
    """Scaled and unwrapped columns give the same places as x y z."""
    styles = {"xyz": "x y z", "s": "xs ys zs", "u": "xu yu zu", "su": "xsu ysu zsu"}
    lammps("units lj\natom_style sph/bulk\nlattice sc 1.0\n" + BOXES[box] + "create_box 1 box\ncreate_atoms 1 box\nset group all mass 1.0\n"
           "displace_atoms all random 0.3 0.3 0.3 1\npair_style zero 1.0\npair_coeff * *\n"
           + "".join(f"dump {name} all custom 1 {name}.dump id {style}\ndump_modify {name} sort id format float %.15g\n" for name, style in styles.items())
           + "dump gz all atom 1 gz.dump.gz\nrun 0\n")
    found = {}
    for name in styles:
        done = to_vtk(f"{name}.dump", cwd=lammps.path("."))
        assert done.returncode == 0, done.stderr
        words = lammps.path(f"{name}.0000.vtk").read_text().split()
        begin = words.index("POINTS")
        found[name] = np.array(words[begin + 3:begin + 3 + 3 * int(words[begin + 1])], dtype=float).reshape(-1, 3)
    assert len(found["xyz"]) > 50
    np.testing.assert_allclose(found["s"], found["xyz"], atol=1e-13)
    np.testing.assert_allclose(found["su"], found["u"], atol=2e-12)    # LAMMPS adds 512 images and subtracts them: 5.7e-14 of the edges
    assert to_vtk("gz.dump.gz", cwd=lammps.path(".")).returncode == 0 and lammps.path("gz.0000.vtk").exists()


def test_cut_averages(tmp_path):
    """of chunks, vectors, and grids"""
    text = "# Chunk-averaged data\n# Timestep Number-of-chunks Total-count\n# Chunk Ncount vx\n" + "".join(f"{step} 2 9\n  1 4 0.25\n  2 5 {step}.5\n" for step in (10, 20))
    path = tmp_path / "chunks.txt"
    path.write_text(text)
    whole = sph.averages(path)
    assert list(whole) == [10, 20]
    for end in range(text.index("20 2 9") + 7, len(text)):
        path.write_text(text[:end])
        with pytest.warns(UserWarning, match="step 20 is cut"):
            assert list(sph.averages(path)) == [10]
    path.write_text(text[:-3] + text.replace("10", "30").replace("20", "40"))     # a run that was killed, and one that appends
    with pytest.warns(UserWarning, match="step 20 is cut"):
        assert list(sph.averages(path)) == [10, 30, 40]
    path.write_text("# Time-averaged data\n# TimeStep v_a\n10 0.5\n")
    with pytest.raises(ValueError, match="no output of fix ave/chunk, nor"):
        sph.averages(path)
    grid = "ITEM: TIMESTEP\n{}\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 2\n0 3\nITEM: DIMENSION\n3\nITEM: GRID SIZE nx ny nz\n1 2 1\nITEM: GRID CELLS ix iy iz f\n1 1 1 0.5\n1 2 1 1.5\n"
    path.write_text(grid.format(0) + grid.format(5)[:-4])
    with pytest.warns(UserWarning, match="step 5 is cut"):
        ((length, field),) = sph.read_grid(path)
    assert list(length) == [1, 2, 3] and field.tolist() == [[[[0.5]], [[1.5]]]]



def test_series(tmp_path):
    """of scalars: cut, appended, with other columns; of vectors"""
    path = tmp_path / "gauges.txt"
    path.write_text(SCALARS)
    found = sph.series(path)
    assert list(found) == ["TimeStep", "v_t", "c_level"] and found["TimeStep"].tolist() == [0, 20, 40] and found["v_t"].tolist() == [0.0, 0.20, 0.40]
    for end in range(len(SCALARS) - 6, len(SCALARS)):
        path.write_text(SCALARS[:end])
        with pytest.warns(UserWarning, match="step 40 is cut"):
            assert sph.series(path)["TimeStep"].tolist() == [0, 20]
    path.write_text(SCALARS + SCALARS.replace("\n20", "\n60"))
    assert sph.series(path)["TimeStep"].tolist() == [0, 20, 40, 0, 60, 40]
    path.write_text(SCALARS + SCALARS.replace("v_t", "v_u"))
    with pytest.raises(ValueError, match="two outputs with different columns"):
        sph.series(path)
    path.write_text(CHUNKS)
    with pytest.raises(ValueError, match="which averages.. reads"):
        sph.series(path)


GRID = "ITEM: TIMESTEP\n0\nITEM: GRID SIZE nx ny nz\n2 1 1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n-0.5 0.5\nITEM: GRID CELLS ix iy iz f\n1 1 1 0\n2 1 1 0.5\n"
CHUNKS = "# Chunk-averaged data\n# Timestep Number-of-chunks Total-count\n# Chunk Ncount vx\n10 2 9\n  1 4 0.25\n  2 5 0.5\n20 2 9\n  1 4 0.25\n  2 5 0.5\n"
SCALARS = "# Time-averaged data for fix gauges\n# TimeStep v_t c_level\n" + "".join(f"{step} 0.{step} 1.5\n" for step in range(0, 60, 20))
FLUIDS = (ROOT / "potentials" / "gases.sph").read_text().partition("columns ")
WORDS = ["nan", "inf", "-1", "1e400", "9" * 20, "\u00b2", "abc", "#", "ITEM: ATOMS id\n", "ITEM: TIMESTEP\n", "\0", "-", "0", "1.5", "\n", "columns"]


@pytest.mark.parametrize("read, text", [(frames, DUMP), (sph.read_grid, GRID), (sph.averages, CHUNKS), (sph.read_array, CHUNKS), (sph.series, SCALARS),
                                        (sph.fluids.read, "".join(FLUIDS[1:]))], ids=lambda value: getattr(value, "__name__", ""))
@pytest.mark.filterwarnings("ignore")
def test_damaged_files(tmp_path, read, text):
    """A file with other words, lines, or bytes is read, or refused by one line that names it; so are a folder, an empty file, and packed ones."""
    path = tmp_path / "damaged"
    random = np.random.default_rng(5)
    words, lines = re.split(r"(\s+)", text), text.splitlines(keepends=True)
    refused = 0
    for number in range(200):
        place, word = random.integers(len(words)), WORDS[random.integers(len(WORDS))]
        line, byte = random.integers(len(lines)), random.integers(len(text))
        damaged = ["".join(words[:place] + [word] + words[place + 1:]), "".join(lines[:line] + lines[line + 1:]),
                   "".join(lines[:line] + [word + "\n"] + lines[line:]), text[:byte], text[:byte] + "\u00e6" + text[byte + 1:]][number % 5]
        data = damaged.encode(("utf-8", "latin-1")[number % 7 == 0], errors="replace")
        if number % 11 == 0:
            data = bytearray(gzip.compress(data))
            data[random.integers(2, len(data))] ^= 1 << random.integers(8)
        path.write_bytes(data)
        try:
            read(path)
        except (ValueError, OSError) as error:
            refused += 1
            assert "\n" not in str(error) and not isinstance(error, UnicodeError) and (str(path) in str(error) or isinstance(error, gzip.BadGzipFile)), repr(error)
    assert 0 < refused < 200
    path.write_bytes(b"")
    if read is not sph.fluids.read:
        with pytest.raises(ValueError, match="damaged (is not|has no)"):
            read(path)
    with pytest.raises(OSError, match="Is a directory"):
        read(tmp_path)

LOG = """units lj
dimension 2
lattice sq 1.0
region box block 0 3 0 3 -0.5 0.5
create_box 1 box
create_atoms 1 box
mass 1 1.0
pair_style zero 1.0
pair_coeff * *
velocity all set 1 0 0
fix 1 all nve
thermo 1
variable n equal step
thermo_style custom time v_n ke
run 2
run 1 pre no
thermo_style yaml
run 2
thermo_style multi
run 2
thermo_style custom step v_n ke
thermo_modify line yaml
run 2 post no
thermo_modify line multi
run 2
thermo_modify line one colname v_n "my number"
print "Step 5"
fix print all print 1 "7 8"
run 2 every 1 "print 'Step 5'"
"""


def test_thermo(lammps):
    """Every style, names with a space, and what else prints words and numbers; of a log that ends anywhere, what there is."""
    log = lammps(LOG).log
    found = sph.thermo(log)
    steps = [list(run.get("Step", run.get("v_n"))) for run in found]
    assert steps == [[0, 1, 2], [2, 3], [3, 4, 5], [5, 6, 7], [7, 8, 9], [9, 10, 11], [11, 12], [12, 13]]
    assert list(found[0]) == ["Time", "v_n", "KinEng"] and list(found[6]) == ["Step", "my number", "KinEng"]
    np.testing.assert_allclose(found[0]["Time"], [0, 0.005, 0.01])
    for run in found:
        assert set(run["KinEng"]) == {0.5}
    for end in range(log.index("Per MPI"), len(log), 3):
        runs = sph.thermo(log[:end])
        assert all(list(run) == list(whole)[:len(run)] for run, whole in zip(runs, found))    # the first output of style multi may be cut
        assert [list(run.values())[0][0] for run in runs] == [list(run.values())[0][0] for run in found[:len(runs)]]
        assert all(len(run["KinEng"]) == len(whole["KinEng"]) > 0 for run, whole in zip(runs[:-1], found))
        assert all(list(run[name]) == list(whole[name][:len(run[name])]) for run, whole in zip(runs, found) for name in run)
    killed = log[:log.index("Loop time")]
    assert list(sph.thermo(killed)[0]["v_n"]) == [0, 1, 2] and sph.progress(killed) == (None, None)
    with pytest.raises(ValueError, match="text of a log"):
        sph.thermo("log.lammps")
    with pytest.raises(ValueError, match="names without spaces"):
        sph.thermo("Per MPI rank memory allocation\n   Step my number KinEng \n 1 2 3 \n")
