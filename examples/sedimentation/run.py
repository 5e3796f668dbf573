#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Discs that the fluid moves: the drag in a square array against that of Sangani and Acrivos, the rotation in a shear flow, and the
migration across the flow between two plates against that of Inamuro, Maeba, and Ogino.

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
JOBS = {"array64": {"n": 64, "rings": 12, "end": 1.5}, "shear4": {"height": 4, "end": 13.2}, "array32": {"end": 8.0}, "shear8": {"height": 8},
        "array48": {"n": 48, "rings": 9, "end": 2.0}, "dense32": {"rings": 8, "drag": 50.30, "end": 4.0}, "cells48": {"n": 48, "rings": 9, "disc": "no"},
        "migration4": {"y0": 0.4}, "migration2": {"y0": 0.2}}
QUICK = {"array32": {"end": 0.5}, "cells20": {"n": 20, "rings": 4, "disc": "no", "end": 0.5}, "shear3": {"n": 6, "height": 3, "end": 1.0},
         "migration2": {"n": 20, "y0": 0.2, "end": 3.0}}
INPUTS = {"shear": "in.shear", "migration": "in.migration"}         # of the runs that do not have in.sedimentation
EVERY = {"shear": 0.02, "migration": 0.05}                          # time between outputs; 0.01 of the other runs
BEGIN = {"array": 0.2, "dense": 0.2, "cells": 0.2, "shear": 0.4, "migration": 30.0}     # means are from this time on; half of the run if that is earlier
AIMS = {"array32": 0.025, "dense32": 0.025, "array48": 0.02, "array64": 0.01}    # distance from 1 of drag over published and viscosity
# Distance of the disc from the nearer plate: T. Inamuro, K. Maeba, H. Ogino, Int. J. Multiphase Flow 26, 1981 (2000)
PLACE, NEAR = 0.2745, 0.005
TURN = {3: 0.9357, 4: 0.9631, 8: 0.990}    # angular velocity over half of the rate, distance of the plates in diameters: reference.py


def exact_drag(c):
    """of any area of the disc: their expansion for small areas, scaled to the nearest number of their table"""
    def expansion(c):
        return 4 * np.pi / (-0.5 * np.log(c) - 0.738 + c - 0.887 * c**2 + 2.038 * c**3)

    nearest = min(DRAG, key=lambda known: abs(known - c))
    return DRAG[nearest] * expansion(c) / expansion(nearest)


def around(out, name, n, drag, begin):
    """Viscosity over mu, and the radius at which the fluid has the velocity of the disc, from the mean over circles around the disc.

    Whatever the neighbors of the disc are, Stokes' equations have the mean velocity b + c log r + d r^2, with the viscosity
    -F/(4 pi c), where F is the force on the disc and on the fluid in its place.
    """
    parts = []
    for i, frame in enumerate(frames(out / f"{name}.particles.txt").values()):
        if 0.02 * i <= begin:
            continue
        fluid, disc = frame["type"] == 1, frame["type"] == 2
        x, y = [frame[axis] - np.angle(np.mean(np.exp(2j * np.pi * frame[axis][disc]))) / (2 * np.pi) for axis in ("x", "y")]
        x, y = x - np.round(x), y - np.round(y)
        parts.append(np.array([np.hypot(x, y), np.arctan2(y, x), frame["vx"] - frame["vx"][disc].mean()])[:, fluid])
    radius = np.sqrt(disc.sum() / np.pi) / n
    r, angle, u = np.concatenate(parts, axis=1)
    low, high = radius + 2 / n, 0.47    # from half a support radius on, up to the edge of the cell
    inside = (r > low) & (r < high)
    r, angle, u = r[inside], angle[inside], u[inside]
    z = (r - low) / (high - low)
    shapes = [np.ones_like(r), np.log(r / radius), r**2 - radius**2]
    shapes += [wave(m * angle) * z**power for m in range(1, 9) for power in range(5) for wave in (np.cos, np.sin)]
    b, c, d = np.linalg.lstsq(np.array(shapes).T, u, rcond=None)[0][:3]
    near = radius * np.linspace(0.8, 1.2, 4001)
    return -drag / (4 * np.pi * c), near[np.argmin(np.abs(b + c * np.log(near / radius) + d * (near**2 - radius**2)))]


def kind(name):
    return name.rstrip("0123456789")


class Run:
    """values: velocity or angular velocity of the disc, or its place in the flow between plates; second: area of the disc, if any"""

    def __init__(self, out, name, **variables):
        self.name, self.variables = name, variables
        columns = np.loadtxt(out / f"{name}.probe.txt").T
        self.t, self.second = EVERY.get(kind(name), 0.01) * np.arange(columns.shape[1]), columns[2]
        self.values = columns[2 if kind(name) == "migration" else 1]
        self.late = self.t >= min(BEGIN[kind(name)], self.t[-1] / 2)
        self.mean = self.values[self.late].mean()
        self.error = np.std([part.mean() for part in np.array_split(self.values[self.late], 5)], ddof=1) / np.sqrt(5)
        self.frame = list(frames(out / f"{name}.particles.txt").values())[-1]


def plot(path, arrays, shears, migrations):
    plt = pyplot()
    figure, ((left, middle, right), (lower, center, last)) = plt.subplots(2, 3, figsize=(14.4, 7.6))
    for axes, run in zip((left, middle, right), (next(iter(runs.values())) for runs in (arrays, shears, migrations))):
        frame = run.frame
        disc = frame["type"] == 2
        x, speed = frame["x"], frame["vx"]
        if axes is not middle:    # the disc in the middle of its cell
            x = (x - np.angle(np.mean(np.exp(2j * np.pi * x[disc]))) / (2 * np.pi) + 0.5) % 1.0
        size = (150 / np.sqrt(len(speed)))**2
        least = 0.0 if axes is right else -np.abs(speed).max()
        picture = axes.scatter(x, frame["y"], c=speed, s=size, lw=0, cmap="viridis" if axes is right else "RdBu_r", vmin=least,
                               vmax=np.abs(speed).max(), rasterized=True)
        axes.scatter(x[disc], frame["y"][disc], s=size / 3, c="k", lw=0)
        axes.set(aspect="equal", xlabel="$x$", ylabel="$y$")
        axes.grid(False)
        figure.colorbar(picture, ax=axes, label="$v_x$", shrink=0.8)
    left.set_title("square array", loc="left")
    middle.set_title("shear", loc="left")
    right.set_title("flow between plates", loc="left")
    for run in arrays.values():
        lower.plot(run.t[1:], run.drag / run.values[1:] / run.published / run.viscosity, lw=1, label=f"{run.name}: a = {run.radius:.1f} spacings")
    lower.axhline(1.0, color="k", lw=2.6, alpha=0.3)
    lower.set(xlabel="time", title="drag over that of Sangani and Acrivos, with the viscosity", ylim=(0.8, 1.2))
    lower.legend(fontsize=8)
    for run in shears.values():
        center.plot(run.t, -2 * run.values, lw=1, label=f"plates {run.variables['height']} diameters apart")
    center.axhline(1.0, color="k", lw=2.6, alpha=0.3)
    center.set(xlabel="time", title="angular velocity over half of the rate of shear", ylim=(0.8, 1.1))
    center.legend(fontsize=8)
    for run in migrations.values():
        last.plot(run.t, run.values, lw=1, label=f"from {run.variables['y0']}")
    last.axhline(PLACE, color="k", lw=2.6, alpha=0.3)
    last.set(xlabel="time", title="distance of the disc from the plate", ylim=(0.15, 0.45))
    last.legend(fontsize=8)
    save(figure, path)


def main():
    example = Example(HERE, "Discs that the fluid moves.")
    args = example.arguments()
    jobs = QUICK if args.quick else JOBS
    example.run(jobs, {name: HERE / INPUTS[kind(name)] for name in jobs if kind(name) in INPUTS})
    runs = {name: Run(example.out, name, **{"n": 32, **variables}) for name, variables in sorted(jobs.items())}
    cells = next(run for name, run in runs.items() if name.startswith("cells"))
    print(f"\nviscosity of the particles, from cells without a disc: {1 / cells.mean:.4f} of mu, velocity {cells.mean:.4f}({cells.error:.4f})")
    arrays = {name: run for name, run in runs.items() if name.startswith(("array", "dense"))}
    shears, migrations = ({name: run for name, run in runs.items() if kind(name) == one} for one in ("shear", "migration"))
    table = example.out / "sedimentation.csv"
    header = ["run", "n", "area", "radius", "velocity", "error", "drag", "published", "over published", "viscosity", "and the viscosity",
              "radius of no slip", "over that of this radius"]
    print("\n" + "  ".join(header))
    with csv_rows(table, header) as writerow:
        for name, run in arrays.items():
            area, n = run.second[0], run.variables["n"]
            run.drag = run.variables.get("drag", 26.97)
            run.published = exact_drag(area)
            run.viscosity, fluid_radius = around(example.out, name, n, run.drag, run.t[run.late][0])
            run.radius, run.ratio = np.sqrt(area / np.pi) * n, run.drag / run.mean / run.published / run.viscosity
            run.ratio_of_fluid = run.ratio * run.published / exact_drag(np.pi * fluid_radius**2)
            values = (area, run.radius, run.mean, run.error, run.drag / run.mean, run.published, run.drag / run.mean / run.published,
                      run.viscosity, run.ratio, fluid_radius * n, run.ratio_of_fluid)
            writerow([name, n, *(f"{value:.5f}" for value in values)])
            print("{:8s} {:2d}  {:.5f}  {:.2f}  {:.4f}  {:.4f}  {:.2f}  {:.2f}  {:.4f}  {:.4f}  {:.4f}  {:.2f}  {:.4f}".format(name, n, *values))
    turns = example.out / "shear.csv"
    print("\nrun      diameter/distance of the plates  angular velocity over half of the rate  error  reference")
    with csv_rows(turns, ["run", "diameter/distance", "angular velocity", "error", "reference"]) as writerow:
        for name, run in shears.items():
            values = 1 / run.variables["height"], -2 * run.mean, 2 * run.error, TURN[run.variables["height"]]
            writerow([name, *(f"{value:.5f}" for value in values)])
            print("{:8s} {:31.4f}  {:38.4f}  {:.4f}  {:.4f}".format(name, *values))
    places = example.out / "migration.csv"
    print("\nrun         from    distance from the plate  error   published")
    with csv_rows(places, ["run", "from", "distance", "error", "published"]) as writerow:
        for name, run in migrations.items():
            values = run.variables["y0"], run.mean, run.error, PLACE
            writerow([name, *(f"{value:.5f}" for value in values)])
            print("{:10s}  {:.4f}  {:23.4f}  {:.4f}  {:.4f}".format(name, *values))
    print()
    for name, run in arrays.items():
        example.merit(f"{name}: drag over published and viscosity", run.ratio, 1 - AIMS[name], 1 + AIMS[name])
        example.merit(f"{name}: the same with the radius of no slip", run.ratio_of_fluid, 0.99, 1.01)
    for name, run in shears.items():
        exact = TURN[run.variables["height"]]
        near = 0.02 if args.quick else 0.01    # a small version has a standard error of 0.005
        example.merit(f"{name}: angular velocity over half of the rate", -2 * run.mean, exact - near, exact + near)
    for name, run in migrations.items():
        least, most = (0.21, 0.25) if args.quick else (PLACE - NEAR, PLACE + NEAR)    # on its way in a small version
        example.merit(f"{name}: distance of the disc from the plate", run.mean, least, most)
    picture = example.out / "sedimentation.png"
    plot(picture, arrays, shears, migrations)
    return example.finish(picture, table, turns, places)


if __name__ == "__main__":
    sys.exit(main())
