#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The dam break by density continuity beside that by LAMMPS's own SPH package: front, pressure, and processor time.

    SPHD_LMP=path/to/lmp python3 lammps.py [--quick] [--out DIR] [--check]
"""

import re
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, frames, pyplot, save      # noqa: E402

L, TIME = 5.366, 2.0                # length of the tank; time of the picture
CASES = {                           # name: title, input, variables
    "bulk": ("sph/bulk, density continuity", "in.dam_break", {}),
    "summed": ("LAMMPS's SPH as in water_collapse, alpha = 1", "in.dam_break_lammps", {}),
    "integrated": ("LAMMPS's SPH, density integrated, alpha = 1", "in.dam_break_lammps", {"density": "integrated"}),
    "inviscid": ("LAMMPS's SPH, density integrated, alpha = 0.1", "in.dam_break_lammps", {"density": "integrated", "alpha": 0.1}),
}
C0 = 20.0


class Run:
    def __init__(self, out, name):
        self.title, script, _ = CASES[name]
        self.frames = list(frames(out / f"{name}.particles.txt").values())
        self.front = np.array([frame["x"].max() for frame in self.frames])
        self.t = 0.02 * np.arange(len(self.front))
        log = (out / f"{name}.log").read_text()
        seconds, self.particles = re.search(r"^Loop time of (\S+) on .* with (\d+) atoms", log, re.MULTILINE).groups()
        self.seconds = float(seconds) * float(re.search(r"^([\d.]+)% CPU use", log, re.MULTILINE)[1]) / 100 / self.t[-1]
        self.p = (lambda rho: C0**2 * np.maximum(rho - 1, 0)) if script == "in.dam_break" else (lambda rho: C0**2 / 7 * (rho**7 - 1))

    def at(self, time):
        return self.front[round(time / 0.02)]

    def arrival(self):
        """Of the front at the far wall; inf: later than the run."""
        there = self.front > L - 0.05
        return self.t[np.argmax(there)] if there.any() else np.inf


def plot(path, runs):
    plt = pyplot()
    figure, panels = plt.subplots(2, 2, figsize=(9.6, 4.4), sharex=True, sharey=True)
    for axes, run in zip(panels.ravel(), runs.values()):
        frame = run.frames[round(TIME / 0.02)]
        picture = axes.scatter(frame["x"], frame["y"], c=run.p(frame["c_rho"]), s=4, lw=0, vmin=0, vmax=1, cmap="viridis", rasterized=True)
        axes.plot([0, 0, L, L], [1.2, 0, 0, 1.2], "k-", lw=1)
        axes.set(xlim=(-0.15, L + 0.1), ylim=(-0.15, 1.2))
        axes.set_title(run.title, loc="left", fontsize=9)
        axes.grid(False)
    figure.colorbar(picture, ax=panels, label="pressure $p/(\\rho g H)$", shrink=0.8)
    save(figure, path)


def main():
    example = Example(HERE, "The dam break by this package and by LAMMPS's own.")
    args = example.arguments()
    n = 10 if args.quick else 30
    example.run({name: {"n": n, "end": 4.0, **variables} for name, (_, _, variables) in CASES.items()},
                {name: HERE / script for name, (_, script, _) in CASES.items()})
    runs = {name: Run(example.out, name) for name in CASES}
    table = example.out / "lammps.csv"
    print(f"\n{n} particles per height, processor seconds per (H/g)^(1/2)\n"
          "\nrun         particles  front at t = 1   1.5     2      arrival  seconds")
    with csv_rows(table, ["run", "particles", "x 1", "x 1.5", "x 2", "arrival", "seconds"]) as writerow:
        for name, run in runs.items():
            values = run.at(1), run.at(1.5), run.at(2), run.arrival(), run.seconds
            writerow([name, run.particles, *(f"{value:.3f}" for value in values)])
            print("{:11s} {:>9s}  {:14.3f}  {:.3f}  {:.3f}  {:7.2f}  {:7.1f}".format(name, run.particles, *values))
    print()
    example.merit("front at t = 2 beyond that of LAMMPS's SPH", runs["bulk"].at(2) - max(run.at(2) for run in runs.values() if run is not runs["bulk"]), 0, 1)
    picture = example.out / "lammps.png"
    plot(picture, runs)
    return example.finish(picture, table)


if __name__ == "__main__":
    sys.exit(main())
