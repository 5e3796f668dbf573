#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""A dam break with a box in its way: pictures of the water, obstacle.png.

    SPHD_LMP=path/to/lmp python3 obstacle.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, pyplot, save, thermo      # noqa: E402

PANELS = 2, 3, 5, 10    # of the pictures, one in 0.2 s


def plot(path, pictures):
    plt = pyplot()
    figure, panels = plt.subplots(2, 2, figsize=(9.6, 4.0))
    for axes, k in zip(panels.ravel(), PANELS):
        axes.imshow(plt.imread(pictures[min(k, len(pictures) - 1)])[100:])
        axes.set_title(f"t = {0.2 * k:g} s", loc="left")
        axes.axis("off")
    save(figure, path)


def main():
    example = Example(HERE, __doc__.splitlines()[0])
    args = example.arguments()
    n = 8 if args.quick else 14
    example.run({"obstacle": {"n": n}}, {"obstacle": HERE / "in.obstacle"})
    (table,) = thermo((example.out / "obstacle.log").read_text())
    atoms = table["Atoms"]
    print(f"\n{n} particles per height, {atoms[0]:.0f} with the walls; spray that has left: {atoms[0] - atoms[-1]:.0f} particles\n")
    example.merit("share of the particles that has left", 1 - atoms[-1] / atoms[0], 0.0, 0.005)
    picture = example.out / "obstacle.png"
    plot(picture, sorted(example.out.glob("obstacle.*.png")))
    return example.finish(picture)


if __name__ == "__main__":
    sys.exit(main())
