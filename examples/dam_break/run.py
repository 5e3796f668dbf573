#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""A dam break: pressure on the far wall and front of the water, against an experiment and another SPH.

    ./sphd run dam_break          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, frames, pyplot, save      # noqa: E402

L, LOW, HIGH = 5.366, 0.117, 0.267      # of the tank; the stretch of the far wall that the sensor covers
WINDOWS = (3, 4), (4, 5)                # of time, for mean pressures
MEAN = 0.48, 0.66                       # bars of these
ARRIVAL = 2.40, 2.65                    # pressure above 0.1
SCATTER = {30: 0.35, 60: 0.15}          # n: standard deviation in 3 < t < 5
CASES = {"n30": {"n": 30}, "tait": {"n": 30, "eos": "tait"}, "no_slip": {"n": 30, "slip": "no"},
         "n60": {"n": 60, "kappa": 0.1}}
QUICK = {"quick": {"n": 15, "kappa": 0.4, "end": 3.0}}
TIMES = 1.0, 2.0, 3.0, 5.0, 6.0, 7.0    # of the pictures


class Run:
    def __init__(self, out, name, n, c0=20.0, eos="linear", **_):
        self.n, self.rc = n, 4.0 / n
        rows = sum(LOW < (k + 0.5) / n < HIGH for k in range(n))    # of the wall in the stretch
        step, self.front, push = np.loadtxt(out / f"{name}.probe.txt").T
        self.frames = list(frames(out / f"{name}.particles.txt").values())
        self.t = 0.02 * np.arange(len(self.frames))
        self.front, self.force = self.front[:len(self.t)], push[:len(self.t)] * n / rows
        gamma = 7.0 if eos == "tait" else 1.0
        self.p_of = lambda rho: np.maximum(c0**2 / gamma * (rho**gamma - 1), 0.0)
        self.p = np.array([self.kernel_mean(one) for one in self.frames])
        self.depth = max(self.deepest(one) for one in self.frames) * n

    def pressure(self, frame):
        return self.p_of(frame["c_rho"])

    def kernel_mean(self, frame):
        """Of the pressure at the stretch of the wall."""
        above = np.maximum(np.maximum(LOW - frame["y"], frame["y"] - HIGH), 0.0)
        q = np.minimum(np.hypot(L - frame["x"], above) / self.rc, 1.0)
        weight = (1 - q)**4 * (1 + 4 * q)
        return (weight * self.pressure(frame)).sum() / weight.sum() if weight.sum() > 0.5 else 0.0

    @staticmethod
    def deepest(frame):
        """Largest distance of a particle behind the surface of the tank."""
        return max(-frame["x"].min(), frame["x"].max() - L, -frame["y"].min())

    def arrival(self, p):
        return self.t[np.argmax(p > 0.1)] if (p > 0.1).any() else np.inf

    def window(self, p, begin, end):
        return p[(self.t >= begin) & (self.t < end)]


def plot(path, runs, data):
    plt = pyplot()
    fine = runs[max(runs, key=lambda name: runs[name].n)]
    figure = plt.figure(figsize=(9.6, 6.4))
    top, bottom = figure.subfigures(2, 1, height_ratios=[0.9, 1.0])
    panels = top.subplots(2, 3, sharex=True, sharey=True).ravel()
    for axes, time in zip(panels, TIMES):
        k = min(round(time / 0.02), len(fine.frames) - 1)
        frame = fine.frames[k]
        picture = axes.scatter(frame["x"], frame["y"], c=fine.pressure(frame), s=110 / fine.n, lw=0, vmin=0, vmax=1, cmap="viridis", rasterized=True)
        axes.plot([0, 0, L, L], [2.6, 0, 0, 2.6], "k-", lw=1)
        axes.set(xlim=(-0.1, L + 0.1), ylim=(-0.1, 2.6), aspect="equal")
        axes.set_title(f"$t\\,(g/H)^{{1/2}}$ = {fine.t[k]:g}", loc="left")
        axes.grid(False)
    top.colorbar(picture, ax=panels, label="pressure $p/(\\rho g H)$", shrink=0.8)
    left, right = bottom.subplots(1, 2, width_ratios=[1.6, 1.0])
    for name, (t, p) in data.items():
        left.plot(t, p, "k." if "Buchner" in name else "k-", ms=3, lw=1.2, label=name)
    for name, color in (("n30", "C0"), ("n60", "C3"), ("quick", "C0")):
        if name in runs:
            run = runs[name]
            left.plot(run.t, run.p, color, lw=0.9, label=f"n = {run.n}")
            right.plot(run.t, run.front, color, label=f"n = {run.n}")
    left.set(xlim=(2, 8), ylim=(-0.05, 1.6), xlabel="time $t\\,(g/H)^{1/2}$", title="pressure on the far wall, $p/(\\rho g H)$")
    left.legend()
    t = np.linspace(0, 2.5, 50)
    right.plot(t, 2 + 2 * t, "k:", lw=1.2, label="shallow water, Ritter")
    right.set(xlim=(0, 2.6), ylim=(1.9, 5.5), xlabel="time $t\\,(g/H)^{1/2}$", title="front, $x/H$")
    right.legend()
    save(figure, path)


def main():
    example = Example(HERE, "A column of water that falls into a tank.")
    args = example.arguments()
    jobs = QUICK if args.quick else dict(reversed(CASES.items()))
    example.run({name: dict(variables) for name, variables in jobs.items()})
    data = {name: np.loadtxt(HERE / file, delimiter=",", skiprows=1).T
            for name, file in (("experiment, Buchner", "buchner2002.csv"), ("SPH, Marrone et al., H/320", "marrone2011.csv"))}
    runs = {name: Run(example.out, name, **jobs[name]) for name in (QUICK if args.quick else CASES)}

    table = example.out / "dam_break.csv"
    print("\nrun        n  arrival  p, 3 < t < 4  4 < t < 5  scatter  by force: arrival  3 to 4  4 to 5  x at t = 1  1.5    2      depth/dx")
    with csv_rows(table, ["run", "n", "arrival", "p 3-4", "p 4-5", "scatter", "arrival by force", "force 3-4", "force 4-5", "x 1", "x 1.5", "x 2",
                          "depth/dx"]) as writerow:
        for name, (t, p) in data.items():
            means = [p[(t >= a) & (t < b)].mean() for a, b in WINDOWS]
            print(f"{name:32s}  {t[np.argmax(p > 0.1)]:.2f}, {means[0]:.3f}, {means[1]:.3f}")
        for name, run in runs.items():
            values = [run.arrival(run.p), *(run.window(run.p, *w).mean() if run.t[-1] > w[1] else np.nan for w in WINDOWS),
                      run.window(run.p, 3, 5).std() if run.t[-1] > 5 else np.nan, run.arrival(run.force),
                      *(run.window(run.force, *w).mean() if run.t[-1] > w[1] else np.nan for w in WINDOWS),
                      *(run.front[round(time / 0.02)] for time in (1, 1.5, 2)), run.depth]
            writerow([name, run.n, *(f"{value:.4f}" for value in values)])
            print("{:8s} {:3d}  {:5.2f}    {:.3f}         {:.3f}      {:.3f}    {:.2f}               {:.3f}   {:.3f}   {:.3f}       {:.3f}  {:.3f}  {:.3f}".format(
                name, run.n, *values))
    print()
    for name, run in runs.items():
        example.merit(f"{name}: arrival at the far wall", run.arrival(run.p), *ARRIVAL)
        example.merit(f"{name}: depth of a particle in a wall, over dx", run.depth, -1.0, 0.15)
        if run.t[-1] < 5:
            continue
        for begin, end in WINDOWS:
            example.merit(f"{name}: mean pressure in {begin} < t < {end}", run.window(run.p, begin, end).mean(), *MEAN)
        example.merit(f"{name}: scatter of the pressure in 3 < t < 5", run.window(run.p, 3, 5).std(), 0.0, SCATTER[run.n])
    picture = example.out / "dam_break.png"
    plot(picture, runs, data)
    return example.finish(picture, table)


if __name__ == "__main__":
    sys.exit(main())
