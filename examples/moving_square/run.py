#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""A square that moves through a closed box of fluid: its drag, the parts of pressure and viscosity, against finite volumes and
published finite differences.

    ./sphd run moving_square          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check] [--size N]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, pyplot, save      # noqa: E402
from sph_dissipation import each_frame                      # noqa: E402

JOBS = {"n40": {"n": 40}, "n20": {"n": 20}}
QUICK = {"n10": {"n": 10, "end": 2.0}}
EVERY, FRAME = 0.02, 0.1                # time between values of the force, and between dumps
TURN = 1.3                              # time from which the step is longer
PARTS = "total", "pressure", "viscous"
BEGIN, WINDOW = 1.0, 0.2                # differences are of running means over WINDOW, from BEGIN on
NARROW = 0.04                           # window of the largest drag
START = 0.3                             # time of the comparison at the start
PICTURE = 5.0                           # time of the field
# the aim is 0.04; README.md says why the parts are not within it
LIMITS = {40: {"total": 0.04, "pressure": 0.12, "peak": 0.02, "start": 0.08},
          20: {"total": 0.06, "pressure": 0.16, "peak": 0.05, "start": 0.2},
          10: {"total": 0.1, "peak": 0.16}}


def mean(time, values, window):
    """Running means of values at equal distances in time."""
    many = max(1, round(window / (time[1] - time[0])))
    return tuple(np.convolve(one, np.ones(many) / many, "valid") for one in (time, values))


class Drag:
    """Drag coefficients over time"""

    def errors(self, reference):
        """Of each part from BEGIN on: relative L2 difference, and mean over that of the reference."""
        result = {}
        for part in PARTS:
            t, here = mean(self.t, getattr(self, part), WINDOW)
            late = (t > BEGIN) & (t < reference.t[-1] - WINDOW / 2)
            there = np.interp(t, *mean(reference.t, getattr(reference, part), WINDOW))[late]
            here = here[late]
            result[part] = np.sqrt(np.mean((here - there)**2) / np.mean(there**2)), here.mean() / there.mean()
        return result

    def at(self, time, part):
        return np.interp(time, *mean(self.t, getattr(self, part), NARROW))


class Known(Drag):
    def __init__(self, file):
        with open(HERE / file, encoding="utf-8") as table:
            rows = [line for line in table if line[0].isdigit()]
        self.name = Path(file).stem
        self.t, self.pressure, self.viscous = np.loadtxt(rows, delimiter=",").T
        self.total = self.pressure + self.viscous
        self.peak = self.total.max()

    def at(self, time, part):
        return CubicSpline(self.t, getattr(self, part))(time)


class Run(Drag):
    """The viscous part is known at the times of the dumps, and pressure is the rest of the total."""

    def __init__(self, out, name, n, **_):
        self.n, self.name = n, name
        force, viscous = [], []
        for part in ("first", "later"):
            drag = np.loadtxt(out / f"{name}.{part}.viscous.txt", ndmin=2)[:, 2]
            viscous.append((EVERY * sum(map(len, force)) + FRAME * np.arange(len(drag)), drag))
            force.append(np.loadtxt(out / f"{name}.{part}.force.txt"))
        self.t, self.total = np.concatenate(force)[:, [1, 4]].T
        self.viscous = np.interp(self.t, *(np.concatenate(one) for one in zip(*viscous)))
        self.pressure = self.total - self.viscous
        self.peak = mean(self.t, self.total, NARROW)[1].max()
        self.frames = out / f"{name}.later.frames.txt"


def plot(path, runs, reference, published):
    plt = pyplot()
    figure = plt.figure(figsize=(9.6, 8.2))
    top, bottom = figure.subfigures(2, 1, height_ratios=[1.0, 1.25])
    start, later = top.subplots(1, 2)
    main = next(iter(runs.values()))
    for axes, window in ((start, NARROW), (later, WINDOW)):
        for part, color in zip(PARTS, ("k", "C0", "C3")):
            for drag, style, label in ((reference, {"lw": 3, "alpha": 0.3}, "finite volumes"), (published, {"lw": 1, "ls": ":"}, "published"),
                                       (main, {"lw": 1}, f"n = {main.n}")):
                axes.plot(*mean(drag.t, getattr(drag, part), window), color=color, label=f"{part}, {label}", **style)
    start.set(xlim=(0, 1.2), ylim=(-0.5, 11), xlabel="time $t\\,U/D$", title="drag coefficient, start")
    later.set(xlim=(1.0, 8.0), ylim=(0, 4.2), xlabel="time $t\\,U/D$", title="drag coefficient")
    later.legend(ncol=3, loc="upper center", fontsize=7, columnspacing=1.0, handlelength=1.5)
    if main.frames.exists():
        for place, (_, frame) in enumerate(each_frame(main.frames)):
            if place == round((PICTURE - TURN) / FRAME):
                break
        axes = bottom.subplots()
        fluid = (frame["x"] > 0) & (frame["x"] < 10) & (frame["y"] > 0) & (frame["y"] < 5) & (frame["type"] == 1)
        speed = np.hypot(frame["vx"], frame["vy"])
        picture = axes.scatter(frame["x"][fluid], frame["y"][fluid], c=speed[fluid], s=(110 / main.n)**2 / 1.8, lw=0, vmin=0, vmax=1.4,
                               cmap="viridis", rasterized=True)
        square = (frame["type"] == 2) & (frame["vx"] > 0.5)
        x, y = frame["x"][square].mean(), frame["y"][square].mean()
        axes.add_patch(plt.Rectangle((x - 0.5, y - 0.5), 1, 1, color="0.4"))
        axes.set(aspect="equal", xlim=(0, 10), ylim=(0, 5), xlabel="$x/D$", ylabel="$y/D$")
        axes.set_title(f"speed at $t\\,U/D$ = {TURN + FRAME * place:g}, n = {main.n}", loc="left")
        axes.grid(False)
        bottom.colorbar(picture, ax=axes, shrink=0.8, label="speed over U")
    save(figure, path)


def main():
    example = Example(HERE, "A square that moves through a closed box of fluid.")
    example.parser.add_argument("--size", type=int, metavar="N", help="particles along a side of the square, in place of the two runs")
    args = example.arguments()
    jobs = QUICK if args.quick else {f"n{args.size}": {"n": args.size}} if args.size else JOBS
    example.run({name: dict(variables) for name, variables in jobs.items()})
    runs = {name: Run(example.out, name, **variables) for name, variables in jobs.items()}
    reference, published = Known("reference.csv"), Known("published.csv")
    table = example.out / "moving_square.csv"
    with csv_rows(table, ["n", "part", "L2 difference", "mean over reference", f"at t = {START}", "reference"]) as writerow:
        print("\n  n        part      L2 difference  mean over reference  at t = 0.3  reference")
        for drag in (*runs.values(), published):
            name = drag.n if drag is not published else drag.name
            for part, (difference, ratio) in drag.errors(reference).items():
                values = difference, ratio, drag.at(START, part), reference.at(START, part)
                writerow([name, part, *(f"{value:.4f}" for value in values)])
                print("{:>9}  {:8s}  {:13.4f}  {:19.4f}  {:10.4f}  {:9.4f}".format(name, part, *values))
    print()
    for drag in (*runs.values(), published):
        print(f"{drag.name}: largest drag coefficient {drag.peak:.3f}, finite volumes {reference.peak:.3f}, ratio {drag.peak / reference.peak:.3f}")
    print()
    for run in runs.values():
        for part, limit in LIMITS.get(run.n, {}).items():
            if part == "peak":
                example.merit(f"n = {run.n}, largest drag over that of finite volumes", run.peak / reference.peak, 1 - limit, 1 + limit)
            elif part == "start":
                ratio = run.at(START, "viscous") / reference.at(START, "viscous")
                example.merit(f"n = {run.n}, viscous drag at t = {START} over that of finite volumes", ratio, 1 - limit, 1 + limit)
            else:
                example.merit(f"n = {run.n}, relative L2 difference of the {part} drag", run.errors(reference)[part][0], 0.0, limit)
    picture = example.out / "moving_square.png"
    plot(picture, runs, reference, published)
    return example.finish(picture, table)


if __name__ == "__main__":
    sys.exit(main())
