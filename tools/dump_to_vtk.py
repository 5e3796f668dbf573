#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Writes the frames of a text dump of LAMMPS as VTK files for ParaView: NAME.dump, or NAME.dump.gz, becomes NAME.0000.vtk, NAME.0001.vtk, ...

    dump_to_vtk.py DUMP [DUMP ...]

Columns x y z are the places (z = 0 if it is not there), or xu yu zu, or the scaled ones xs ys zs or xsu ysu zsu. Three columns that end in
x, y, z are a vector, all others scalars. Text is left out.
"""
import sys
import warnings
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python"))
from sph_dissipation import program      # noqa: E402
from sph_dissipation.results import each_table, is_text      # noqa: E402


def places(columns, box, zero):
    """Takes the columns of the places out, and returns x, y, and z. box: lines of the dump."""
    for end in ("", "u", "s", "su"):
        if f"x{end}" in columns and f"y{end}" in columns:
            found = [columns.pop(f"x{end}"), columns.pop(f"y{end}"), columns.pop(f"z{end}", None)]
            break
    else:
        raise ValueError("no columns x y, xu yu, xs ys, or xsu ysu")
    if end[:1] == "s":
        if not box:
            raise ValueError("scaled places, and no ITEM: BOX BOUNDS")
        edges, origin = cell(box)
        scaled = [map(float, column) for column in found if column]
        moved = [[start + sum(s * edge[k] for s, edge in zip(one, edges)) for k, start in enumerate(origin)] for one in zip(*scaled)]
        found = [[repr(place[k]) for place in moved] if column else None for k, column in enumerate(found)]
    return [column or zero for column in found]


def cell(box):
    """Edges and origin of the box of a dump."""
    head, *rows = box
    rows = [[float(word) for word in row.split()] for row in rows]
    if len(rows) != 3 or min(map(len, rows)) < 2 + (" xy xz yz" in head) + 2 * (" abc origin" in head):
        raise ValueError("ITEM: BOX BOUNDS has not the form that LAMMPS writes")
    if " abc origin" in head:
        return [row[:3] for row in rows], [row[3] for row in rows]
    xy, xz, yz = (row[2] for row in rows) if " xy xz yz" in head else (0.0, 0.0, 0.0)
    # the bounds are those of a box around the tilted one
    low = [rows[0][0] - min(0.0, xy, xz, xy + xz), rows[1][0] - min(0.0, yz), rows[2][0]]
    high = [rows[0][1] - max(0.0, xy, xz, xy + xz), rows[1][1] - max(0.0, yz), rows[2][1]]
    return [[high[0] - low[0], 0.0, 0.0], [xy, high[1] - low[1], 0.0], [xz, yz, high[2] - low[2]]], low


def vtk(names, rows, box):
    """Text of a file: legacy format, polygonal data of vertices."""
    columns = {name: [row[place] for row in rows] for place, name in enumerate(names)}
    count = len(rows)
    zero = ("0",) * count
    vectors = {"x": places(columns, box, zero)}
    columns = {name: values for name, values in columns.items() if not any(map(is_text, values[:1]))}
    for name in list(columns):
        stem = name[:-1]
        if name.endswith("x") and f"{stem}y" in columns:
            vectors[{"v": "velocity", "f": "force"}.get(stem, stem)] = [columns.pop(name), columns.pop(f"{stem}y"), columns.pop(f"{stem}z", zero)]

    def lines(vector):
        return "\n".join(map(" ".join, zip(*vector)))

    text = ["# vtk DataFile Version 3.0", "particles", "ASCII", "DATASET POLYDATA", f"POINTS {count} double", lines(vectors.pop("x")),
            f"VERTICES {count} {2 * count}", "\n".join(f"1 {number}" for number in range(count)), f"POINT_DATA {count}"]
    for name, values in columns.items():
        text += [f"SCALARS {name.replace(' ', '_')} double 1", "LOOKUP_TABLE default", "\n".join(values)]
    for name, vector in vectors.items():
        text += [f"VECTORS {name} double", lines(vector)]
    return "\n".join(text) + "\n"


def main():
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    warnings.showwarning = lambda message, *_: print(f"dump_to_vtk: {message}", file=sys.stderr)
    with program("dump_to_vtk"):
        for path in map(Path, sys.argv[1:]):
            number = 0
            try:
                for _, names, rows, other in each_table(path):
                    text = vtk(names, rows, other.get("BOX BOUNDS"))
                    (path.with_suffix("") if path.suffix == ".gz" else path).with_suffix(f".{number:04d}.vtk").write_text(text)
                    number += 1
            except ValueError as error:
                raise SystemExit(f"dump_to_vtk: {'' if str(path) in str(error) else f'{path}: '}{error}") from None
            if not number:
                raise SystemExit(f"dump_to_vtk: {path} has no whole frame")
            print(f"{path}: {number} frame" + "s" * (number > 1))


if __name__ == "__main__":
    main()
