# SPDX-License-Identifier: GPL-2.0-only
"""Particles in and around a surface of triangles, an STL file: bodies, and vessels with their walls.

    python3 -m sph_dissipation.fill SHAPE.stl SPACING        (./sphd fill)

The particles are those of a simple cubic lattice, as "lattice sc" of LAMMPS with "origin 0.5 0.5 0.5" has them.
"""
import argparse
import math
import os
import re
from pathlib import Path

from . import program

WELD = 1e-6             # of the size of a shape: corners nearer to each other are one, which rounding has moved
MOST = 2**31 - 1        # IDs of LAMMPS, if it is not built for more
DIGITS = 15             # of coordinates in a data file
# bytes of memory of a point of the lattice, of a particle, and of a point in the box around one triangle
BYTES, BYTES_OF_PARTICLE, BYTES_OF_TRIANGLE = 11, 120, 200


def read_stl(path):
    """Triangles of a binary or text STL file: array [triangle, corner, coordinate].  ValueError if it is none."""
    import numpy as np

    data = Path(path).read_bytes()
    count = int.from_bytes(data[80:84], "little")
    if len(data) > 84 and len(data) == 84 + 50 * count:
        facet = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
        triangles = np.frombuffer(data, facet, count, 84)["corners"].astype(float)
    else:
        words = re.findall(rb"^\s*vertex\s+(\S+)\s+(\S+)\s+(\S+)\s*$", data, re.MULTILINE | re.IGNORECASE)
        if not data.lstrip()[:5].lower() == b"solid" or not words or len(words) % 3:
            raise ValueError("is no STL file, or a part of one")
        try:
            triangles = np.array(words).astype(float).reshape(-1, 3, 3)
        except ValueError:
            raise ValueError("has coordinates that are no numbers") from None
    if not np.isfinite(triangles).all():
        raise ValueError("has coordinates that are no finite numbers")
    return triangles


def weld(triangles, apart=None):
    """The same triangles, with those corners in one place that are nearer to each other (default: than a part WELD of the size of the shape)."""
    import numpy as np

    points, number = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    apart = apart or WELD * np.ptp(points, axis=0).max()
    label, count, before = np.zeros(len(points), dtype=np.int64), 1, 0
    # groups are divided where they have a gap along an axis, until they have none
    while count > before:
        before = count
        for values in points.T:
            order = np.lexsort((values, label))
            cut = (np.diff(label[order]) > 0) | (np.diff(values[order]) > apart)
            label[order] = np.concatenate([[0], np.cumsum(cut)])
        count = label.max() + 1
    first = np.unique(label, return_index=True)[1]
    return points[first[label[number.reshape(-1)]]].reshape(-1, 3, 3)


def open_edges(triangles):
    """Edges of triangles without an opposite edge of another triangle, array [edge, end, coordinate]: none if the surface is closed."""
    import numpy as np

    corners, number = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    number = number.reshape(-1, 3)
    edges = np.stack([number[:, [k, (k + 1) % 3]] for k in range(3)], axis=1).reshape(-1, 2)
    edges = edges[edges[:, 0] != edges[:, 1]]
    code, back = (edges[:, k].astype(np.int64) * len(corners) + edges[:, 1 - k] for k in (0, 1))
    names, first, counts = np.unique(code, return_index=True, return_counts=True)
    backs = np.sort(back)
    counts -= np.searchsorted(backs, names, "right") - np.searchsorted(backs, names, "left")
    which = np.repeat(first, np.maximum(counts, 0))
    return corners[edges[np.sort(which)]]


def holes(edges):
    """Groups of open edges that hang together, the largest first."""
    import numpy as np

    _, number = np.unique(edges.reshape(-1, 3), axis=0, return_inverse=True)
    number = number.reshape(-1, 2)
    label = np.arange(number.max(initial=-1) + 1)
    before = None
    while before is None or (label != before).any():    # the smallest number of a group spreads along its edges
        before, smallest = label, label[number].min(axis=1)
        label = label.copy()
        for end in number.T:
            np.minimum.at(label, end, smallest)
        label = label[label]
    groups = label[number[:, 0]]
    return sorted((edges[groups == name] for name in np.unique(groups)), key=len, reverse=True)


def where(edges):
    """Words that say where the holes of a surface are, and which --weld would close cracks."""
    import numpy as np

    parts = holes(edges)
    text = f"{len(edges)} edges have no triangle on one side: " + "; ".join(
        f"{len(part)} around ({' '.join(f'{place:.6g}' for place in part.mean(axis=(0, 1)))}), {np.ptp(part, axis=(0, 1)).max():.3g} wide"
        for part in parts[:3]) + ("; ..." if len(parts) > 3 else "")
    corners = np.unique(edges.reshape(-1, 3), axis=0)
    if len(corners) <= 3000:
        apart = np.linalg.norm(corners[:, None] - corners, axis=2)
        np.fill_diagonal(apart, np.inf)
        gap, edge = apart.min(axis=1).max(), np.linalg.norm(edges[:, 1] - edges[:, 0], axis=1).min()
        if gap < 0.1 * edge:
            text += f"; --weld {2 * gap:.1g} joins their corners, which are at most {gap:.2g} apart"
    return text


def volume(triangles):
    """Of a closed surface, by the divergence theorem; negative if the triangles are clockwise as seen from outside."""
    import numpy as np

    return np.einsum("ij,ij->", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])) / 6


def inside(triangles, axes):
    """Which points of a lattice, the product of three sorted axes, a surface surrounds, which may be open above them.

    The winding number: the signed number of triangles below a point.  A triangle is below it if its projection along z surrounds
    that of the point, counted by the edges that a ray along x crosses.  Triangles with a common edge calculate the same crossing:
    no ray passes between them, nor meets both.
    """
    import numpy as np

    x, y, z = axes
    change = np.zeros((len(x), len(y), len(z) + 1), dtype=np.int32)    # of the winding number, above each height of a triangle
    for triangle in triangles:
        low, high = triangle.min(axis=0), triangle.max(axis=0)
        rows = slice(*np.searchsorted(y, (low[1], high[1]), side="left"))
        columns = slice(max(np.searchsorted(x, low[0]) - 1, 0), np.searchsorted(x, high[0], side="right") + 1)
        if rows.start == rows.stop or not len(x[columns]):
            continue
        turns = np.zeros((len(x[columns]), rows.stop - rows.start), dtype=np.int32)
        for k in range(3):
            a, b = triangle[k], triangle[(k + 1) % 3]
            up = 1 if a[1] < b[1] else -1
            a, b = (a, b) if up == 1 else (b, a)
            on = (a[1] <= y[rows]) & (y[rows] < b[1])
            if on.any():
                at = a[0] + (y[rows] - a[1]) * ((b[0] - a[0]) / (b[1] - a[1]))
                turns += up * (on & (x[columns, None] < at))
        i, j = np.nonzero(turns)
        if not len(i):
            continue
        normal = np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])
        height = np.full(len(i), triangle[:, 2].mean())
        if normal[2]:
            height = triangle[0, 2] - ((x[columns][i] - triangle[0, 0]) * normal[0] + (y[rows][j] - triangle[0, 1]) * normal[1]) / normal[2]
        first = np.searchsorted(z, np.clip(height, low[2], high[2]), side="left")
        np.add.at(change, (columns.start + i, rows.start + j, first), turns[i, j])
    return change.cumsum(axis=2, dtype=np.int32)[:, :, :-1] != 0


def near(triangles, axes, distance):
    """Which points of a lattice have at most this distance from a surface."""
    import numpy as np

    found = np.zeros([len(axis) for axis in axes], dtype=bool)
    for triangle in triangles:
        parts = tuple(slice(*np.searchsorted(axis, (low - distance, high + distance))) for axis, low, high in
                      zip(axes, triangle.min(axis=0), triangle.max(axis=0)))
        points = np.stack(np.meshgrid(*(axis[part] for axis, part in zip(axes, parts)), indexing="ij"), axis=-1)
        normal = np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])
        area = np.linalg.norm(normal)
        across = area > 0
        square = np.full(points.shape[:-1], np.inf)
        for k in range(3):
            a, edge = triangle[k], triangle[(k + 1) % 3] - triangle[k]
            r = points - a
            along = np.clip(r @ edge / max(edge @ edge, 1e-300), 0.0, 1.0)
            square = np.minimum(square, ((r - along[..., None] * edge)**2).sum(axis=-1))
            across = across & (r @ np.cross(normal, edge) >= 0)
        plane = ((points - triangle[0]) @ (normal / max(area, 1e-300)))**2
        found[parts] |= np.where(across, plane, square) <= distance**2
    return found


def check_size(triangles, spacing, thickness=0.0, level=None):
    """About how many particles there are; ValueError if LAMMPS cannot number them, or the memory of this machine does not hold them."""
    import numpy as np

    low, high = triangles.min(axis=(0, 1)), triangles.max(axis=(0, 1))
    sides = np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)
    size = abs(volume(triangles)) if level is None else np.prod(np.minimum(high, [np.inf, np.inf, level]) - low)
    number = (size + 0.5 * sides.sum() * thickness) / spacing**3
    about = f"needs about {number:.3g} particles at a spacing of {spacing:g}"
    if number > MOST:
        raise ValueError(f"{about}, and LAMMPS numbers at most {MOST}: take a larger spacing")
    if spacing < 1e6 * 10.0**-DIGITS * np.abs([low, high]).max():
        raise ValueError(f"is too far from the origin for a spacing of {spacing:g}, which takes more than {DIGITS} digits: move it")
    cells = np.prod((high - low + 2 * thickness) / spacing + 4)
    largest = np.prod((np.ptp(triangles, axis=1) + 2 * thickness) / spacing + 1, axis=1).max() if thickness else 0.0
    needed, memory = BYTES * cells + BYTES_OF_PARTICLE * number + BYTES_OF_TRIANGLE * largest, memory_of_machine()
    if needed > memory:
        raise ValueError(f"{about}, which take {needed / 2**30:.3g} GiB of memory; this machine has {memory / 2**30:.3g}: take a larger spacing")
    return number


def memory_of_machine():
    return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")


def fill(triangles, spacing, thickness=0.0, level=None):
    """Positions of the particles inside of a surface and below a level, and of those outside at most a thickness away from the surface."""
    number = check_size(triangles, spacing, thickness, level)
    try:
        return lattice_points(triangles, spacing, thickness, level)
    except MemoryError:
        raise ValueError(f"needs about {number:.3g} particles at a spacing of {spacing:g}, for which the memory is not enough: take a larger spacing") from None


def lattice_points(triangles, spacing, thickness, level):
    import numpy as np

    margin = thickness + spacing
    axes = [spacing * (np.arange(math.floor((low - margin) / spacing), math.ceil((high + margin) / spacing)) + 0.5)
            for low, high in zip(triangles.min(axis=(0, 1)), triangles.max(axis=(0, 1)))]
    within = inside(triangles, axes)
    outside = near(triangles, axes, thickness) & ~within if thickness > 0 else np.zeros_like(within)
    if level is not None:
        within &= axes[2] < level
    return [np.column_stack([axis[index] for axis, index in zip(axes, np.nonzero(which))]) for which in (within, outside)]


def write_data(path, groups, spacing, mass):
    """Data file of LAMMPS for atom_style sph/bulk; groups: [(type, positions)]."""
    import numpy as np

    points = np.concatenate([x for _, x in groups])
    types = np.concatenate([np.full(len(x), kind) for kind, x in groups])
    try:
        with open(path, "w", encoding="utf-8") as file:
            file.write(f"particles at a spacing of {spacing:g}\n\n{len(points)} atoms\n{types.max()} atom types\n\n")
            for axis, low, high in zip("xyz", points.min(axis=0) - spacing / 2, points.max(axis=0) + spacing / 2):
                file.write(f"{low:.{DIGITS}g} {high:.{DIGITS}g} {axis}lo {axis}hi\n")
            file.write("\nAtoms # sph/bulk\n\n")
            for number, (kind, x) in enumerate(zip(types, points), 1):
                file.write(f"{number} {kind} {mass:.{DIGITS}g} 0.0 " + " ".join(f"{place:.{DIGITS}g}" for place in x) + "\n")
    except OSError as error:
        error.filename = str(path)    # that of a full disk has none
        raise


def positive(text):
    value = float(text)
    if not 0 < value < math.inf:
        raise argparse.ArgumentTypeError("must be > 0")
    return value


def finite(text):
    value = float(text)
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError("must be a finite number")
    return value


def kind(text):
    value = int(text)
    if value < 0:
        raise argparse.ArgumentTypeError("must be the number of a type, or 0 for no particles")
    return value


def arguments(argv=None):
    parser = argparse.ArgumentParser(prog="./sphd fill", description="Fills a surface, an STL file, with particles, and writes a data file of LAMMPS.")
    parser.add_argument("shape", type=Path, metavar="SHAPE.stl")
    parser.add_argument("spacing", type=positive, metavar="SPACING", help="of the particles")
    parser.add_argument("--scale", type=positive, default=1.0, help="multiplies the coordinates of the file (default: 1)")
    parser.add_argument("--move", type=finite, nargs=3, default=(0.0, 0.0, 0.0), metavar=("X", "Y", "Z"), help="moves the shape then")
    parser.add_argument("--weld", type=positive, metavar="D", help="corners of the file nearer than this are one (default: a millionth of the size of the shape)")
    parser.add_argument("--level", type=finite, metavar="Z", help="fills up to this height, after --scale and --move; the surface may be open above it")
    parser.add_argument("--inside", type=kind, default=1, metavar="TYPE", help="of the particles inside; 0: none (default: 1)")
    parser.add_argument("--outside", type=kind, default=0, metavar="TYPE", help="of particles around the shape, the wall of a vessel")
    parser.add_argument("--thickness", type=positive, metavar="D", help="of the particles around it; at least the support radius")
    parser.add_argument("--density", type=positive, default=1.0, help="mass over volume (default: 1)")
    parser.add_argument("--out", type=Path, metavar="FILE", help="(default: SHAPE.data)")
    args = parser.parse_args(argv)
    if bool(args.outside) != (args.thickness is not None):
        parser.error("--outside and --thickness belong together")
    if not args.inside and not args.outside:
        parser.error("no particles are wanted")
    return args


def run(args):
    import numpy as np

    mass = args.density * math.prod([args.spacing] * 3)    # no error where it is too large
    if not 0 < mass < math.inf:
        raise SystemExit(f"fill: --density {args.density:g} times {args.spacing:g}^3, the mass of a particle, is {mass:g}: take other units")
    try:
        triangles = weld(read_stl(args.shape), args.weld)
        edges = open_edges(triangles)
        if args.level is not None:    # holes above it do not matter
            edges = edges[edges[:, :, 2].min(axis=1) * args.scale + args.move[2] < args.level]
        if len(edges):
            raise ValueError(f"is not closed{'' if args.level is None else ' below the level'}: {where(edges)}"
                             + ("; --level fills an open vessel" if args.level is None else ""))
        triangles = triangles * args.scale + np.array(args.move)
        if not np.isfinite(triangles).all():
            raise ValueError("is too large, with --scale and --move, for a computer to calculate with")
        path = args.out or Path(args.shape.with_suffix(".data").name)
        if path.exists() and path.samefile(args.shape):
            raise ValueError("is the file to be written: name another one by --out")
        points = fill(triangles, args.spacing, args.thickness or 0.0, args.level)
        if not len(points[0]):
            raise ValueError(f"has no room for particles at a spacing of {args.spacing:g}{'' if args.level is None else ' below the level'}")
    except ValueError as error:
        raise SystemExit(f"fill: {args.shape} {error}") from None
    groups = [(number, x) for number, x in zip((args.inside, args.outside), points) if number]
    write_data(path, groups, args.spacing, mass)
    size, filled = abs(volume(triangles)), len(points[0]) * args.spacing**3
    print(f"{len(triangles)} triangles around a volume of {size:.6g}, filled by {filled / size:.4f} of it" if args.level is None else
          f"{len(triangles)} triangles, filled up to z = {args.level:g} by a volume of {filled:.6g}")
    for number, x in groups:
        print(f"type {number}: {len(x)} particles")
    print(f"wrote {path}")


def main(argv=None):
    args = arguments(argv)
    with program("fill"):
        import numpy as np

        with np.errstate(all="ignore"):    # what is not finite is noticed
            run(args)


if __name__ == "__main__":
    main()
