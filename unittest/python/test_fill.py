"""Shapes of STL files are filled with particles, python/sph_dissipation/fill.py; the shapes are made here."""

import itertools

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
        assert fill.volume(shape) == pytest.approx(exact, rel=2e-3) and fill.open_edges(shape) == 0
        assert fill.volume(shape[:, ::-1]) == pytest.approx(-fill.volume(shape))
        for write in (write_binary, write_text):
            write(tmp_path / "shape.stl", shape)
            assert np.abs(fill.read_stl(tmp_path / "shape.stl") - shape).max() < 1e-6
    assert fill.open_edges(cube()[1:]) == 3 and fill.open_edges(np.concatenate([cube(), cube(0.5, (0.2, 0.2, 0.2))])) == 0


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
    (text,) = (text for _, _, text, _ in blocks(ROOT / "doc" / "src" / "Howto_sph_bodies.rst") if "ball.data" in text)
    write_binary(lammps.path("ball.stl"), sphere(220.0))
    fill.main([str(lammps.path("ball.stl")), "0.1", *"--scale 0.001 --move 0.5 0.5 0.5 --inside 2 --density 2.0 --out".split(),
               str(lammps.path("ball.data"))])
    within, _ = fill.fill(0.22 * sphere() + 0.5, 0.1)
    (table,) = lammps(text).thermo()
    assert table["v_n"][0] == len(within) == 1000 - table["v_m"][0]
    assert table["v_M"][0] == pytest.approx(0.002 * len(within), rel=1e-12)
    assert np.abs(table["v_p"]).max() < 1e-12 and -1.0 < table["v_w"][-1] < -0.05
    assert abs(table["v_w"][-1] - table["v_w"][-2]) < 0.2 * abs(table["v_w"][-1])


@pytest.mark.parametrize("words, message", [
    (["0.1", "--outside", "2"], "belong together"), (["0.1", "--inside", "0"], "no particles are wanted"), (["-1"], "must be > 0"),
    (["0.1", "--inside", "-1"], "must be the number of a type"), (["9.0"], "has no room for particles at a spacing of 9")])
def test_errors(tmp_path, capsys, words, message):
    write_text(tmp_path / "cube.stl", cube())
    with pytest.raises(SystemExit) as error:
        fill.main([str(tmp_path / "cube.stl"), *words, "--out", str(tmp_path / "cube.data")])
    assert message in str(error.value) + capsys.readouterr().err


def test_files_that_are_no_closed_surface(tmp_path):
    path = tmp_path / "shape.stl"
    for make, message in ((lambda: write_text(path, cube()[1:]), "is not closed: 3 edges"), (lambda: path.write_text("solid\n"), "is no STL file"),
                          (lambda: path.write_text("ply\n"), "is no STL file"), (lambda: write_text(path, cube() * np.nan), "no numbers"),
                          (path.unlink, "No such file")):
        if make != path.unlink or path.exists():
            make()
        with pytest.raises(SystemExit, match=message):
            fill.main([str(path), "0.1"])
