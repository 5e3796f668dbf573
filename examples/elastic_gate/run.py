#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""An elastic gate that water opens: the path of its tip beside three results of SPHinXsys.

    ./sphd run elastic_gate          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, frames, pyplot, save, thermo      # noqa: E402

# Of SPHinXsys, in mm: its tutorial (sphinxsys.csv), and two versions of the results that its test of the gate compares with
LARGEST_X, LARGEST_Y = (42.8, 45.8, 46.4), (15.6, 19.6, 20.2)
LAST_X, LAST_Y = (31.2, 31.9, 34.1), (8.1, 9.0, 10.4)
# soft: four particles with their areas have the bending stiffness of a plate times 1 - 1/16
JOBS = {"coarse": {"rows": 3}, "gate": {"rows": 4}, "soft": {"rows": 4, "E": 7.8e6 * (1 - 1 / 4**2)}}
QUICK = {"quick": {"rows": 3, "end": 0.03}}
SHOWN = 1, 3, 10      # frames of the picture


class Run:
    def __init__(self, out, name):
        self.t, x, y = np.loadtxt(out / f"{name}.txt")[:, 1:].T
        self.x, self.y = 1e3 * (x[0] - x), 1e3 * (y - y[0])
        self.largest, self.high = self.x.max(), self.y.max()
        self.when = self.t[self.x.argmax()]
        self.frames = list(frames(out / f"{name}.particles.txt").values())
        (table,) = thermo((out / f"{name}.log").read_text())
        self.atoms = table["Atoms"][0]


def plot(path, runs, other):
    plt = pyplot()
    figure = plt.figure(figsize=(10.0, 5.6))
    top, bottom = figure.subfigures(2, 1, height_ratios=[1.0, 1.1])
    shown = runs["gate"]
    for axes, k in zip(top.subplots(1, 3, sharey=True), SHOWN):
        frame = shown.frames[k]
        for kind, color in ((1, "C0"), (2, "C3"), (3, "0.6")):
            own = frame["type"] == kind
            axes.scatter(1e3 * frame["x"][own], 1e3 * frame["y"][own], s=1.5, c=color, lw=0, rasterized=True)
        axes.set(aspect="equal", xlim=(-150, 106), ylim=(-6, 150), xlabel="x, mm", title=f"t = {0.04 * k:g} s")
        axes.grid(False)
    for axes, part, title in zip(bottom.subplots(1, 2), "xy", ("tip, to the left, mm", "tip, upward, mm")):
        for name, run in runs.items():
            axes.plot(run.t, getattr(run, part), lw=1.0, label=f"{run.rows} rows{', soft' * (name == 'soft')}")
        axes.plot(other["t"], other[part], "k--", lw=1.2, label="SPHinXsys, tutorial")
        values = LARGEST_X if part == "x" else LARGEST_Y
        axes.axhspan(min(values), max(values), color="k", alpha=0.12, lw=0, label="SPHinXsys, largest")
        axes.set(title=title, xlabel="t, s", xlim=(0, 0.4), ylim=(0, None))
        if part == "x":
            axes.legend(fontsize=8, loc="lower right")
    save(figure, path)


def main():
    example = Example(HERE, __doc__.splitlines()[0])
    args = example.arguments()
    jobs = QUICK if args.quick else JOBS
    example.run(dict(reversed(jobs.items())))
    names, *rows = [line.split(",") for line in (HERE / "sphinxsys.csv").read_text().splitlines() if not line.startswith("#")]
    other = dict(zip(names, np.array(rows, dtype=float).T))
    runs = {name: Run(example.out, name) for name in jobs}
    table = example.out / "elastic_gate.csv"
    print(f"SPHinXsys: largest x {LARGEST_X}, at {other['t'][other['x'].argmax()]:.3f} s, largest y {LARGEST_Y}, at the end {LAST_X} and {LAST_Y} mm")
    print("run      rows   particles   largest x   at       largest y   x and y at the end")
    with csv_rows(table, ["run", "rows", "largest x", "time", "largest y", "x", "y"]) as writerow:
        for name, run in runs.items():
            run.rows = jobs[name]["rows"]
            writerow([name, run.rows, f"{run.largest:.2f}", f"{run.when:.4f}", f"{run.high:.2f}", f"{run.x[-1]:.2f}", f"{run.y[-1]:.2f}"])
            print(f"{name:8s} {run.rows}      {run.atoms:6.0f}      {run.largest:.2f}       {run.when:.4f}   {run.high:.2f}       {run.x[-1]:.2f} {run.y[-1]:.2f}")
    if args.quick:
        example.merit("x of the tip at 0.03 s, mm", runs["quick"].largest, 7.5, 10.5)
        return example.finish(table)
    run = runs["gate"]
    for what, value, values in (("largest x", run.largest, LARGEST_X), ("largest y", run.high, LARGEST_Y),
                                ("x at the end", run.x[-1], LAST_X), ("y at the end", run.y[-1], LAST_Y)):
        example.merit(f"{what} of the tip, mm", value, min(values), max(values))
    example.merit("time of the largest x, over SPHinXsys", run.when / other["t"][other["x"].argmax()], 0.9, 1.1)
    picture = example.out / "elastic_gate.png"
    plot(picture, runs, other)
    return example.finish(picture, table)


if __name__ == "__main__":
    sys.exit(main())
