#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Writes the frames of a text dump of LAMMPS as VTK files for ParaView: NAME.dump becomes NAME.0000.vtk, NAME.0001.vtk, ...

    dump_to_vtk.py DUMP [DUMP ...]

Columns x y z are the places (z = 0 if it is not there), three columns that end in x, y, z a vector, all others scalars.
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python"))
from sph_dissipation.results import each_table      # noqa: E402


def vtk(names, rows):
    """Text of a file: legacy format, polygonal data of vertices."""
    columns = {name: [row[place] for row in rows] for place, name in enumerate(names)}
    count = len(rows)
    zero = ("0",) * count
    vectors = {"x": [columns.pop("x"), columns.pop("y"), columns.pop("z", zero)]}
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
    for path in map(Path, sys.argv[1:]):
        for number, (_, names, rows) in enumerate(each_table(path)):
            path.with_suffix(f".{number:04d}.vtk").write_text(vtk(names, rows))


if __name__ == "__main__":
    main()
