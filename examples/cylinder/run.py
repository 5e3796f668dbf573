#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Flow past a circular cylinder: drag, length of the wake, lift and Strouhal number.

    ./sphd run cylinder          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check] [--size N]
"""

import csv
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from reference import shedding              # noqa: E402
from run_lammps import Example, csv_rows, frames, pyplot, save      # noqa: E402

CASES = {                                   # Re: variables of the input, in which n is the number of particles per diameter
    20: {"n": 12, "support": 4, "end": 24.0, "mean": 8.0, "kick": 0.0},
    40: {"n": 12, "support": 4, "end": 36.0, "mean": 12.0, "kick": 0.0},
    100: {"n": 16, "support": 3, "end": 54.0, "mean": 18.0, "kick": 0.5},
}
BARS = {"drag": 0.03, "wake": 0.05, "strouhal": 0.03}   # beyond the published values
MEAN_DRAG = 0.04                                        # at Re = 100
QUICK = {"n": 8, "Re": 40, "end": 15.0, "mean": 5.0, "width": 8, "up": 4, "down": 6}
QUICK_DRAG = 0.08                           # of the small version, to finite elements in its domain
TITLE = {"drag": "drag coefficient", "wake": "length of the wake", "lift": "amplitude of the lift coefficient",
         "strouhal": "Strouhal number"}


def table(path):
    with open(path) as file:
        return [{key: value if key in ("source", "domain") else float(value) if value else None for key, value in row.items()}
                for row in csv.DictReader(file)]


class Run:
    def __init__(self, out, name, Re, mean):
        self.name = name
        self.t, self.drag_t, self.lift_t = np.loadtxt(out / f"{name}.history.txt")[:, 1:4].T
        late = self.t > self.t[-1] - mean
        self.drag = self.drag_t[late].mean()
        halves = np.array_split(self.drag_t[late], 2)
        self.drift = halves[1].mean() / halves[0].mean() - 1
        self.wake = self.lift = self.strouhal = None
        if Re > 50:
            self.drag, self.lift, self.strouhal = shedding(self.t, self.drag_t, self.lift_t, mean)
        rows = np.loadtxt(out / f"{name}.axis.txt", skiprows=4)
        rows = rows[rows[:, 2] > 0]
        self.x, self.u = rows[:, 1], rows[:, 3]
        if Re < 50:
            k = np.flatnonzero((self.u[:-1] < 0) & (self.u[1:] >= 0))[-1]
            self.wake = self.x[k] - self.u[k] * (self.x[k + 1] - self.x[k]) / (self.u[k + 1] - self.u[k]) - 0.5


def smooth(frame, spacing, box, support=3.0):
    """Velocity and its curl on a grid, by the Wendland kernel of this support radius over the spacing, normalised."""
    from scipy.spatial import cKDTree
    x0, x1, y0, y1 = box
    gx, gy = np.arange(x0, x1, spacing), np.arange(y0, y1, spacing)
    grid = np.stack(np.meshgrid(gx, gy), axis=-1).reshape(-1, 2)
    place = np.stack([frame["x"], frame["y"]], axis=1)
    tree, u = cKDTree(place), np.stack([frame["vx"], frame["vy"]], axis=1)
    pairs = cKDTree(grid).sparse_distance_matrix(tree, support * spacing, output_type="ndarray")
    q = pairs["v"] / (support * spacing)
    w = (1 - q)**4 * (1 + 4 * q)
    total = np.bincount(pairs["i"], w, len(grid))
    ux, uy = (np.bincount(pairs["i"], w * u[pairs["j"], c], len(grid)) / np.maximum(total, 1e-9) for c in range(2))
    shape = len(gy), len(gx)
    ux, uy = ux.reshape(shape), uy.reshape(shape)
    curl = np.gradient(uy, spacing, axis=1) - np.gradient(ux, spacing, axis=0)
    return gx, gy, ux, curl


def plot(path, out, runs, n):
    """n: particles per diameter of each run"""
    plt = pyplot()
    figure = plt.figure(figsize=(9.6, 3.0 + 2.2 * len(runs)))
    top, *below = figure.subfigures(1 + len(runs), 1, height_ratios=[3.0] + [2.2] * len(runs))
    axes = top.subplots(1, 3)
    for color, (Re, run) in zip(("C0", "C1", "C2"), runs.items()):
        many = max(1, len(run.t) // 200)        # the noise of single particles that pass the surface
        t, drag = (np.convolve(value, np.ones(many) / many, "valid") for value in (run.t, run.drag_t))
        axes[0].plot(t[t > 0.5], drag[t > 0.5], "-", color=color, label=f"Re = {Re}" + (", steady, ended early" if Re < 50 else ""))
        axes[2].plot(run.x, run.u, "o-", ms=2.5, color=color, label=f"Re = {Re}")
        if Re > 50:
            axes[1].plot(run.t, run.lift_t, "-", color=color)
    axes[0].set(xlabel="time $t\\,U/D$", title="drag coefficient", ylim=(1.0, 3.0))
    axes[1].set(xlabel="time $t\\,U/D$", title="lift coefficient, Re = 100")
    axes[2].set(xlabel="distance from the center, $x/D$", title="mean velocity on the axis over U", xlim=(0.4, 8))
    axes[0].legend()
    axes[2].legend()
    for part, (Re, run) in zip(below, runs.items()):
        frame = list(frames(out / f"{run.name}.particles.txt").values())[-1]
        box = frame["x"].min(), frame["x"].max(), -3.0, 3.0
        gx, gy, ux, curl = smooth(frame, 1.5 / n[Re], box)
        hole = np.hypot(*np.meshgrid(gx, gy)) < 0.5
        left, right = part.subplots(1, 2)
        for axis, value, limit, title in ((left, ux, (-0.4, 1.4), "velocity along x, $u/U$"), (right, curl, (-3, 3), "vorticity, $\\omega D/U$")):
            axis.grid(False)
            picture = axis.pcolormesh(gx, gy, np.where(hole, np.nan, value), cmap="RdBu_r" if limit[0] == -limit[1] else "viridis",
                                      vmin=limit[0], vmax=limit[1], shading="auto", rasterized=True)
            axis.add_patch(plt.Circle((0, 0), 0.5, color="0.4"))
            axis.set(aspect="equal", title=f"Re = {Re}", xlabel="$x/D$", ylabel="$y/D$", xlim=box[:2], ylim=box[2:])
            part.colorbar(picture, ax=axis, shrink=0.8, label=title)
    save(figure, path)


def main():
    example = Example(HERE, "Flow past a circular cylinder with an inlet, an outlet, and free-slip sides.")
    example.parser.add_argument("--size", type=int, metavar="N", help="particles per diameter")
    args = example.arguments()
    reference = {(row["domain"], row["Re"]): row for row in table(HERE / "reference.csv")}
    if args.quick:
        example.run({"quick": QUICK})
        run, expected = Run(example.out, "quick", QUICK["Re"], QUICK["mean"]), reference["small", QUICK["Re"]]
        print(f"Re = {QUICK['Re']}: drag {run.drag:.4f}, finite elements {expected['drag']:.4f}; wake {run.wake:.3f}, {expected['wake']:.3f}")
        example.merit("drag over that of finite elements, minus 1", abs(run.drag / expected["drag"] - 1), 0.0, QUICK_DRAG)
        return example.finish()

    names = {Re: f"Re{Re}" for Re in CASES}
    if args.size:
        for case in CASES.values():
            case["n"] = args.size
    example.run({names[Re]: {"Re": Re, **case} for Re, case in reversed(CASES.items())})
    published = table(HERE / "published.csv")
    runs = {Re: Run(example.out, names[Re], Re, case["mean"]) for Re, case in CASES.items()}
    results = example.out / "cylinder.csv"
    with csv_rows(results, ["Re", "quantity", "particles", "finite elements", "finite elements, wide", "without blockage", "published from", "to"]) as writerow:
        for Re, run in runs.items():
            print()
            for what in ("drag", "wake", "lift", "strouhal"):
                value = getattr(run, what)
                if value is None:
                    continue
                same, wide = (reference[domain, Re][what] for domain in ("particles", "wide"))
                spread = [row[what] for row in published if row["Re"] == Re and row[what] is not None]
                free = value * wide / same
                writerow([Re, what, *(f"{x:.4f}" for x in (value, same, wide, free, min(spread), max(spread)))])
                print(f"Re = {Re}, {TITLE[what]}: {value:.4f}, finite elements {same:.4f} ({100 * (value / same - 1):+.1f} %);"
                      f" without blockage {free:.4f}, finite elements {wide:.4f}, published {min(spread):.4g} to {max(spread):.4g}")
                if what in BARS:
                    bar = MEAN_DRAG if what == "drag" and Re > 50 else BARS[what]
                    example.merit(f"Re = {Re}, {TITLE[what]} without blockage", free, min(spread) * (1 - bar), max(spread) * (1 + bar))
            print(f"drag in the second half of the average over the first, minus 1: {run.drift:.1e}")
    picture = example.out / "cylinder.png"
    plot(picture, example.out, runs, {Re: case["n"] for Re, case in CASES.items()})
    return example.finish(picture, results)


if __name__ == "__main__":
    sys.exit(main())
