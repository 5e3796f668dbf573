"""Shapes of STL files are filled with particles, python/sph_dissipation/fill.py; the shapes are made here."""

import itertools
import os
import re
import subprocess
import sys

import numpy as np
import pytest

from sph_dissipation import fill
from test_pages import ROOT, blocks


def cube(side=1.0, origin=(0.0, 0.0, 0.0)):
    """Twelve triangles, counterclockwise as seen from outside."""
    triangles = []
    for axis, end in itertools.product(range(3), (0, 1)):
        corners = np.zeros((4, 3))
        corners[:, axis] = end
        corners[:, (axis + 1) % 3], corners[:, (axis + 2) % 3] = [0, 1, 1, 0], [0, 0, 1, 1]
        corners = corners if end else corners[::-1]
        triangles += [corners[[0, 1, 2]], corners[[0, 2, 3]]]
    return side * np.array(triangles) + np.array(origin)


def sphere(radius=1.0, divisions=4):
    """An octahedron whose triangles are divided in four again and again; all corners on the sphere."""
    signs = itertools.product((1, -1), repeat=3)
    triangles = np.array([np.diag(s)[::np.prod(s)] for s in signs], dtype=float)
    for _ in range(divisions):
        a, b, c = triangles.transpose(1, 0, 2)
        ab, bc, ca = ((p + q) / np.linalg.norm(p + q, axis=1)[:, None] for p, q in ((a, b), (b, c), (c, a)))
        triangles = np.concatenate([np.stack(corners, axis=1) for corners in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return radius * triangles


def write_binary(path, triangles):
    facet = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    data = np.zeros(len(triangles), facet)
    data["corners"] = triangles
    path.write_bytes(b"solid in the first word of a binary file".ljust(80) + np.uint32(len(triangles)).tobytes() + data.tobytes())


def write_text(path, triangles):
    lines = ["solid shape"]
    for triangle in triangles:
        lines += ["facet normal 0 0 0", " outer loop", *(f"  vertex {x:.9g} {y:.9g} {z:.9g}" for x, y, z in triangle), " endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid shape"]) + "\n")


def test_files_and_volume(tmp_path):
    for shape, exact in ((cube(2.0), 8.0), (sphere(), 4 / 3 * np.pi * 0.9957)):
        assert fill.volume(shape) == pytest.approx(exact, rel=2e-3) and len(fill.open_edges(shape)) == 0
        assert fill.volume(shape[:, ::-1]) == pytest.approx(-fill.volume(shape))
        for write in (write_binary, write_text):
            write(tmp_path / "shape.stl", shape)
            assert np.abs(fill.read_stl(tmp_path / "shape.stl") - shape).max() < 1e-6
    assert len(fill.open_edges(cube()[1:])) == 3 and len(fill.open_edges(np.concatenate([cube(), cube(0.5, (0.2, 0.2, 0.2))]))) == 0


@pytest.mark.parametrize("spacing", [0.1, 0.05])
def test_cube(spacing):
    """A cube whose faces are between the particles is filled exactly; the layers around it have round edges."""
    within, around = fill.fill(cube(), spacing, 3.4 * spacing)
    assert len(within) == round(spacing**-3) and within.min() > 0.4 * spacing and within.max() < 1 - 0.4 * spacing
    outside = np.maximum(np.abs(around - 0.5) - 0.5, 0.0)
    assert outside.max(axis=1).min() > 0.4 * spacing and np.linalg.norm(outside, axis=1).max() < 3.4 * spacing
    axes = spacing * (np.arange(-8, round(1 / spacing) + 8) + 0.5)
    points = np.array(list(itertools.product(axes, repeat=3)))
    distance = np.linalg.norm(np.maximum(np.abs(points - 0.5) - 0.5, 0.0), axis=1)
    assert len(around) == np.sum((distance > 0) & (distance < 3.4 * spacing))


def test_sphere():
    """The particles are those of the lattice inside of the triangles, of which the farthest is 0.002 below the sphere."""
    spacing, radius = 0.07, 1.0
    axes = spacing * (np.arange(-25, 25) + 0.5)
    points = np.array(list(itertools.product(axes, repeat=3)))
    distance = np.linalg.norm(points, axis=1)
    for shape in (sphere(), sphere()[:, ::-1]):    # normals to either side
        within, around = fill.fill(shape, spacing, 0.3)
        assert np.linalg.norm(within, axis=1).max() <= radius
        assert abs(len(within) * spacing**3 / abs(fill.volume(shape)) - 1) < 0.02
        assert np.sum(distance < radius - 0.005) <= len(within) <= np.sum(distance < radius)
        outside = np.linalg.norm(around, axis=1)
        assert outside.min() > radius - 0.005 and outside.max() <= radius + 0.3
        assert np.sum((distance > radius) & (distance < radius + 0.295)) <= len(around) <= np.sum(
            (distance > radius - 0.005) & (distance < radius + 0.3))


def test_rays_through_edges_and_corners():
    """Particles exactly below edges, corners, and upright triangles: none is lost, none is outside."""
    for spacing in (0.25, 0.5):
        grid = spacing * np.arange(-4, 9)
        which = fill.inside(cube(spacing * 3), [grid] * 3)
        strictly = (grid > 1e-12) & (grid < spacing * 3 - 1e-12)
        at_most = (grid > -1e-12) & (grid < spacing * 3 + 1e-12)
        product = lambda part: part[:, None, None] & part[None, :, None] & part[None, None, :]    # noqa: E731
        assert (product(strictly) <= which).all() and (which <= product(at_most)).all()
    grid = np.linspace(-1.2, 1.2, 25)       # meets corners and edges of the octahedron
    x = np.stack(np.meshgrid(grid, grid, grid, indexing="ij"))
    which = fill.inside(sphere(divisions=0), [grid] * 3)
    size = np.abs(x).sum(axis=0)
    assert which[size < 1 - 1e-9].all() and not which[size > 1 + 1e-9].any()
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    which = fill.inside(cube() @ turn, [grid] * 3)
    back = np.einsum("iabc,ji->jabc", x, turn)
    size = np.abs(back - 0.5).max(axis=0)
    assert which[size < 0.5 - 1e-9].all() and not which[size > 0.5 + 1e-9].any()


def test_shells():
    """A cavity is outside; a shell in the interior, or one that overlaps, changes nothing."""
    grid = np.linspace(0.05, 0.95, 10)
    for inner, count in ((cube(0.4, (0.3, 0.3, 0.3))[:, ::-1], 1000 - 64), (cube(0.4, (0.3, 0.3, 0.3)), 1000), (cube(1.0, (0.5, 0, 0)), 1000)):
        assert fill.inside(np.concatenate([cube(), inner]), [grid] * 3).sum() == count


def test_the_input_of_the_page(lammps):
    """What the command writes is a body in a fluid: the ball sinks, and its velocity becomes steady."""
    (text,) = (text for _, _, text, _ in blocks(ROOT / "doc" / "src" / "Howto_sph_bodies.rst") if "ball.data" in text and "vessel" not in text)
    write_binary(lammps.path("ball.stl"), sphere(220.0))
    fill.main([str(lammps.path("ball.stl")), "0.1", *"--scale 0.001 --move 0.5 0.5 0.5 --inside 2 --density 2.0 --out".split(),
               str(lammps.path("ball.data"))])
    within, _ = fill.fill(0.22 * sphere() + 0.5, 0.1)
    (table,) = lammps(text).thermo()
    assert table["v_n"][0] == len(within) == 1000 - table["v_m"][0]
    assert table["v_M"][0] == pytest.approx(0.002 * len(within), rel=1e-12)
    assert np.abs(table["v_p"]).max() < 1e-12 and -1.0 < table["v_w"][-1] < -0.05
    assert abs(table["v_w"][-1] - table["v_w"][-2]) < 0.2 * abs(table["v_w"][-1])


def test_the_vessel_of_the_page(lammps, monkeypatch):
    """A ball floats in an open vessel: its center at the level, and the vessel carries the weight of both."""
    page = ROOT / "doc" / "src" / "Howto_sph_bodies.rst"
    (text,) = (text for _, _, text, _ in blocks(page) if "vessel.data" in text)
    monkeypatch.chdir(lammps.path("."))
    write_binary(lammps.path("vessel.stl"), cube()[:-2])
    write_binary(lammps.path("ball.stl"), sphere(220.0))
    for words in re.findall(r"sphd fill (vessel.stl .* --level .*|ball.stl .* --inside 3 .*)", page.read_text()):
        fill.main(words.split())
    result = lammps(text.replace("run             2000", "run             1000"))
    (table,) = result.thermo()
    assert not result.warnings and np.abs(table["v_z"] - 0.7).max() < 0.01
    assert table["v_down"][1:] == pytest.approx(-1.0, abs=0.01)


@pytest.mark.parametrize("words, message", [
    (["0.1", "--outside", "2"], "belong together"), (["0.1", "--inside", "0"], "no particles are wanted"), (["-1"], "must be > 0"),
    (["0.1", "--inside", "-1"], "must be the number of a type"), (["9.0"], "has no room for particles at a spacing of 9")])
def test_errors(tmp_path, capsys, words, message):
    write_text(tmp_path / "cube.stl", cube())
    with pytest.raises(SystemExit) as error:
        fill.main([str(tmp_path / "cube.stl"), *words, "--out", str(tmp_path / "cube.data")])
    assert message in str(error.value) + capsys.readouterr().err


def test_corners_that_rounding_has_moved(tmp_path):
    """Corners that differ by rounding are one: the surface is closed, and no ray passes between the triangles."""
    grid = np.linspace(-1.2, 1.2, 25)       # meets corners and edges of the octahedron
    size = np.abs(np.stack(np.meshgrid(grid, grid, grid, indexing="ij"))).sum(axis=0)
    random = np.random.default_rng(3)
    for noise in (1e-16, 1e-12, 1e-7):
        shape = sphere(divisions=0)
        shape = shape + random.choice([-noise, noise], shape.shape)
        assert len(fill.open_edges(shape)) > 0 and len(fill.open_edges(fill.weld(shape))) == 0
        which = fill.inside(fill.weld(shape), [grid] * 3)
        assert which[size < 1 - 1e-6].all() and not which[size > 1 + 1e-6].any()
    lines = ["SOLID shape"]
    for triangle in cube() + random.choice([-1e-16, 1e-16], (12, 3, 3)):
        lines += ["FACET NORMAL 0 0 0", "OUTER LOOP", *("VERTEX " + " ".join(map(repr, map(float, corner))) for corner in triangle), "ENDLOOP", "ENDFACET"]
    (tmp_path / "cube.stl").write_text("\n".join(lines))
    fill.main([str(tmp_path / "cube.stl"), "0.1", "--out", str(tmp_path / "cube.data")])
    assert "\n1000 atoms\n" in (tmp_path / "cube.data").read_text()
    # fine meshes are left as they are
    points = random.uniform(size=(20000, 3, 3))
    assert (fill.weld(points) == points).all()
    # corners that are farther apart: the message has the distance to be given
    write_text(tmp_path / "cube.stl", cube() + random.uniform(-1e-3, 1e-3, (12, 3, 3)))
    with pytest.raises(SystemExit, match="is not closed: 36 edges .*; --weld 0.00[1-9] joins their corners, which are at most 0.00[12]") as error:
        fill.main([str(tmp_path / "cube.stl"), "0.1", "--out", str(tmp_path / "cube.data")])
    words = re.search(r"--weld \S+", str(error.value))[0].split()
    fill.main([str(tmp_path / "cube.stl"), "0.1", *words, "--out", str(tmp_path / "cube.data")])
    assert "\n1000 atoms\n" in (tmp_path / "cube.data").read_text()


def test_vessel_filled_to_a_level(tmp_path, capsys):
    """An open vessel has fluid below the level and a wall around it, none in its opening; below the level it must have no hole."""
    path, open_top = tmp_path / "vessel.stl", cube()[:-2]
    for shape, closed in ((open_top, False), (open_top[:, ::-1], False), (cube(), True)):
        write_text(path, shape)
        fill.main([str(path), "0.1", *"--level 0.5 --outside 2 --thickness 0.34 --out".split(), str(tmp_path / "vessel.data")])
        x = np.loadtxt(tmp_path / "vessel.data", skiprows=10)
        assert "filled up to z = 0.5 by a volume of 0.5\n" in capsys.readouterr().out
        water, wall = x[x[:, 1] == 1][:, 4:], x[x[:, 1] == 2][:, 4:]
        assert len(water) == 500 and water.min() > 0 and water[:, 2].max() < 0.5
        over = (np.abs(wall[:, :2] - 0.5) < 0.5).all(axis=1) & (wall[:, 2] > 0)    # inside of the vessel, in its opening
        assert over.any() == closed and wall[over][:, 2].min(initial=2.0) > 1.0
        assert (wall[:, 2] < -0.2).any() and (wall[:, 0] < -0.2).any()
    # a round vessel that gets narrower to the top, cut open: the part of a sphere below the level
    ball = sphere()
    grid = np.linspace(-0.95, 0.95, 39)
    cut = ball[ball[:, :, 2].min(axis=1) < 0.8]
    radius = np.linalg.norm(np.stack(np.meshgrid(grid, grid, grid, indexing="ij")), axis=0)
    which, low = fill.inside(cut, [grid] * 3), grid < 0.7
    assert len(fill.open_edges(cut)) and which[:, :, low][radius[:, :, low] < 0.99].all() and not which[:, :, low][radius[:, :, low] > 1].any()
    for shape, words, message in (
            (open_top, "", r"is not closed: 4 edges .*: 4 around \(0.5 0.5 1\), 1 wide; --level fills an open vessel$"),
            (open_top, "--level 1.01", r"is not closed below the level: 4 edges .* \(0.5 0.5 1\), 1 wide$"),
            (open_top[1:], "--level 0.5", r"below the level: 2 edges .*: 2 around \(0 0.75 0.5\), 1 wide$"),
            (open_top, "--level -1", "has no room for particles .* below the level"),
            (open_top, "--level nan", "must be a finite number")):
        write_text(path, shape)
        with pytest.raises(SystemExit) as error:
            fill.main([str(path), "0.1", *words.split(), "--out", str(tmp_path / "none.data")])
        assert re.search(message, str(error.value) + capsys.readouterr().err) and "\n" not in str(error.value)


def test_data_far_from_the_origin(tmp_path):
    """Places have all digits that their spacing needs."""
    write_text(tmp_path / "cube.stl", cube())
    fill.main([str(tmp_path / "cube.stl"), "0.125", *"--move 1e7 0 0 --out".split(), str(tmp_path / "cube.data")])
    x = np.loadtxt(tmp_path / "cube.data", skiprows=10, usecols=4)
    assert sorted(set(x)) == list(1e7 + 0.125 * np.arange(8) + 0.0625)


def test_files_that_are_no_closed_surface(tmp_path):
    path = tmp_path / "shape.stl"
    whole = cube()
    for make, message in ((lambda: write_text(path, whole[1:]), r"is not closed: 3 edges have .*: 3 around \(0 0.666667 0.666667\), 1 wide; --level fills an open vessel$"),
                          (lambda: write_text(path, np.concatenate([whole, cube(1.0, (5, 6, 7))[:11]])), r"3 edges .*: 3 around \(\S+ \S+ 8\), 1 wide"),
                          (lambda: write_text(path, np.concatenate([whole[1:], 3.0 + 1e-5 * whole[1:]])), "6 edges .*: 3 around .* 1 wide; 3 around .*, 1e-05 wide"),
                          (lambda: path.write_text("solid\n"), "is no STL file"), (lambda: path.write_text("ply\n"), "is no STL file"),
                          (lambda: path.write_text(""), "is no STL file"), (lambda: path.write_bytes(bytes(range(256)) * 9), "is no STL file"),
                          (lambda: write_binary(path, whole) or path.write_bytes(path.read_bytes()[:-1]), "is no STL file, or a part of one"),
                          (lambda: write_text(path, whole * np.nan), "no finite numbers"), (lambda: write_text(path, whole + np.inf), "no finite numbers"),
                          (lambda: path.write_text("solid\n" + "vertex 0,5 0 0\n" * 3), "no numbers"),
                          (path.unlink, "No such file"), (path.mkdir, "Is a directory")):
        make()
        with pytest.raises(SystemExit, match=message) as error:
            fill.main([str(path), "0.1"])
        assert str(path) in str(error.value) and "\n" not in str(error.value)


@pytest.mark.parametrize("words, message", [
    ("1e-9", "needs about 1e\\+27 particles at a spacing of 1e-09, and LAMMPS numbers at most 2147483647: take a larger spacing"),
    ("1e-3 --outside 2 --thickness 1", "needs about 7e\\+09 particles"), ("1e-2", "needs about 1e\\+06 particles .* take .* GiB of memory; this machine has "),
    ("0.1 --move 1e9 0 0", "too far from the origin"), ("0.1 --move nan 0 0", "must be a finite number"), ("0.1 --scale 1e308 --move 1e308 1e308 1e308", "is too large"),
    ("1e-120", "the mass of a particle, is 0"), ("1e120", "the mass of a particle, is inf"), ("0.1 --density 1e-323", "the mass of a particle, is 0"),
    ("1e-100 --scale 1e-90", "needs about 1e\\+30 particles"), ("0.1 --scale 1e-200", "has no room"), ("0.1 --out {0}/none/cube.data", "none/cube.data: No such file"),
    ("0.1 --out {0}", "Is a directory"), ("0.1 --out /dev/full", "/dev/full: No space left on device"), ("0.1 --out {0}/cube.stl", "is the file to be written")])
def test_numbers_and_places_that_do_not_work(tmp_path, monkeypatch, capsys, words, message):
    """One line says what is wrong."""
    monkeypatch.setattr(fill, "memory_of_machine", lambda: 5e7)
    write_text(tmp_path / "cube.stl", cube())
    with pytest.raises(SystemExit) as error:
        fill.main([str(tmp_path / "cube.stl"), *words.format(tmp_path).split(), *([] if "--out" in words else ["--out", str(tmp_path / "cube.data")])])
    assert re.search(message, str(error.value) + capsys.readouterr().err) and "\n" not in str(error.value)
    assert not (tmp_path / "cube.data").exists()


def test_end_of_memory_and_of_the_output(tmp_path):
    """... as the system has them; and a Python without numpy."""
    write_text(tmp_path / "cube.stl", cube())
    (tmp_path / "without").mkdir()
    (tmp_path / "without" / "numpy.py").write_text("raise ModuleNotFoundError(name='numpy')\n")

    def run(command, folder=ROOT):
        environment = {**os.environ, "PYTHONPATH": f"{folder}{os.pathsep}{ROOT / 'python'}", "OPENBLAS_NUM_THREADS": "1"}
        done = subprocess.run(["bash", "-c", command.format(f"{sys.executable} -m sph_dissipation.fill cube.stl")], cwd=tmp_path, env=environment,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
        return done.returncode, done.stderr

    code, text = run("ulimit -v 400000; {0} 0.004")
    assert code and re.match("fill: cube.stl needs about 1.56e.07 particles at a spacing of 0.004, .* memory", text) and text.count("\n") == 1
    assert run("{0} 0.1 >/dev/full") == (1, "fill: No space left on device\n")
    code, text = run("{0} 0.1 | true; exit ${{PIPESTATUS[0]}}")
    assert code in (0, 1) and not text
    assert run("{0} 0.1", tmp_path / "without") == (1, "fill: needs numpy, which this Python does not have; ./sphd fill finds one that does\n")
