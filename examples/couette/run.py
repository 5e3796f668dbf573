#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Start-up of Couette flow between plates and between cylinders, against the exact transients.

    ./sphd run couette          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from exact import Circular, Plane           # noqa: E402
from run_lammps import Example, csv_rows, frames, pyplot, save      # noqa: E402

PLANE = (12, 24, 48)        # rows between the plates
CIRCULAR = (10, 20, 40)     # rings between the cylinders
SUPPORT = 3.0               # radius over particle spacing
PLANE_TIMES = (0.02, 0.05, 0.1, 0.2, 1.0)   # over gap^2/nu
CIRCULAR_TIMES = (0.02, 0.05, 0.1, 0.2, 0.8)
MU = 0.1            # of the plane flow, as in the input
EARLY = 0.1         # errors of the start-up are those at this time
SMALL = 0.001       # relative L2 errors of the finest runs, at this time and in the steady state
TORQUE = 0.002       # steady stress or torque over the exact one, minus 1, of the finest runs
BALANCE = 0.001     # sum of both over the second one, minus that of the exact solution
SECOND = 0.8        # steady error between cylinders times n^2, at any resolution
LINEAR = 0.0005      # steady error between plates, at any resolution


class Run:
    """Profiles at some times, their relative L2 errors, and stress or torque on both walls over time."""

    def __init__(self, out, name, n, kind):
        self.kind, self.n = kind, n
        self.exact = Plane() if kind == "plane" else Circular()
        self.t, self.first, self.second = np.loadtxt(out / f"{name}.history.txt")[1:, 1:4].T
        if kind == "plane":
            self.first, self.second = self.first / MU, self.second / MU
        found = frames(out / f"{name}.particles.txt")
        steps, low = np.array(list(found)), 0.0 if kind == "plane" else 1.0
        times = steps / steps[-1] * self.t[-1]
        self.profiles, self.errors = {}, {}
        for time in PLANE_TIMES if kind == "plane" else CIRCULAR_TIMES:
            at = np.argmin(np.abs(times - time))
            assert abs(times[at] - time) < 1e-6
            frame = found[steps[at]]
            if kind == "plane":
                place, u = frame["y"], frame["vx"]
            else:
                place = np.hypot(frame["x"], frame["y"])
                u = (frame["x"] * frame["vy"] - frame["y"] * frame["vx"]) / place
            row = np.clip(((place - low) * n).astype(int), 0, n - 1)
            count = np.bincount(row, minlength=n)
            mean, where, wanted = (np.bincount(row, value, n) / count for value in (u, place, self.exact.u(place, time)))
            self.profiles[time] = where, mean
            self.errors[time] = np.linalg.norm(mean - wanted) / np.linalg.norm(wanted)
        self.last = max(self.errors)
        if kind == "plane":
            exact = [[self.exact.gradient(y, t) for t in self.t] for y in (0.0, 1.0)]
        else:
            exact = [[self.exact.torque(r, t, 1.0) for t in self.t] for r in (1.0, 2.0)]
        self.exact_first, self.exact_second = np.array(exact[0]), -np.array(exact[1])
        steady = self.t > 0.9 * self.t[-1]
        first, second, exact_first, exact_second = (
            value[steady].mean() for value in (self.first, self.second, self.exact_first, self.exact_second))
        self.ratio_first, self.ratio_second = first / exact_first, second / exact_second
        self.balance = first / second - exact_first / exact_second      # the exact one: the rest of the transient


def order(sizes, errors):
    """Of the errors, from the coarsest to the finest."""
    return np.log(errors[0] / errors[-1]) / np.log(sizes[-1] / sizes[0])


def plot(path, kind, runs, sizes):
    from matplotlib.ticker import LogLocator, NullFormatter

    plt = pyplot()
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.9))
    plane = kind == "plane"
    run = runs[kind, sorted(sizes)[-2] if len(sizes) > 1 else sizes[0]]
    place = np.linspace(0, 1, 301) if plane else np.linspace(1, 2, 301)
    for color, time in zip(("C0", "C1", "C2", "C3", "C4"), run.profiles):
        axes[0].plot(place, run.exact.u(place, time), "-", color=color)
        axes[0].plot(*run.profiles[time], "o", color=color, ms=3.5, mfc="none", label=f"$t = {time:g}$")
    axes[0].set(xlabel="height over the gap" if plane else "radius $r/R_1$", ylabel="velocity $u/U$" if plane else "velocity $u_\\theta/(\\omega R_1)$",
                ylim=(-0.03, 1.03), title=f"{run.n} {'rows' if plane else 'rings'}, t in gap$^2/\\nu$; lines: exact")
    axes[0].legend()
    late = run.t > 0.008
    scale = 1.0 if plane else 4 * np.pi * run.exact.B
    names = ("lower wall", "upper wall") if plane else ("inner cylinder", "outer cylinder")
    for color, name, value, exact in zip(("C0", "C3"), names, (run.first, run.second), (run.exact_first, run.exact_second)):
        axes[1].plot(run.t[late], exact[late] / scale, "-", color=color)
        axes[1].plot(run.t[late], value[late] / scale, "o", color=color, ms=3, mfc="none", label=name)
    axes[1].set(xlabel="time $t\\,\\nu/\\mathrm{gap}^2$", title="wall stress over $\\mu U/\\mathrm{gap}$" if plane
                else "torque over the steady one", ylim=(-4, 1.5) if plane else (-3, 1.5))
    axes[1].legend()
    for color, marker, time in zip(("C0", "C1", "C2", "C3", "C4"), "os^vD", run.profiles):
        errors = [runs[kind, n].errors[time] for n in sizes]
        axes[2].loglog(sizes, errors, marker + "-", color=color, mfc="none", ms=5,
                       label=f"$t = {time:g}$: order {order(sizes, errors):.2f}")
    line = np.array([min(sizes), max(sizes)])
    low, high = axes[2].get_ylim()
    axes[2].set_ylim(low / 12, high)        # room for the legend
    axes[2].loglog(line, 0.5 * high * line[0] / line, "k--", lw=0.8, label="order 1")
    axes[2].set(xlabel="rows between the walls" if plane else "rings between the cylinders", title="relative L2 error of the velocity")
    axes[2].set_xticks(sizes, [str(n) for n in sizes])
    axes[2].xaxis.set_minor_formatter(NullFormatter())
    axes[2].yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes[2].yaxis.set_major_formatter("{x:g}")
    axes[2].yaxis.set_minor_formatter(NullFormatter())
    axes[2].legend(loc="lower left")
    save(figure, path)


def main():
    example = Example(HERE, "Start-up of Couette flow between plates and between cylinders.")
    args = example.arguments()
    plane, circular = ([n for n in sizes if not args.quick or n < 40] for sizes in (PLANE, CIRCULAR))
    example.run({f"plane.n{n}": {"n": n, "support": SUPPORT} for n in reversed(plane)})
    # the same for the second input of this folder
    example.name = "couette_circular"
    jobs = {f"circular.n{n}": {"n": n, "support": SUPPORT} for n in reversed(circular)}
    middle = circular[1]
    jobs |= {f"circular_{name}.n{middle}": {**jobs[f"circular.n{middle}"], key: value}
             for name, key, value in (("move_no", "move", "no"), ("hex", "arrangement", "hex"))}
    example.run(jobs)
    example.name = HERE.name

    runs = {("plane", n): Run(example.out, f"plane.n{n}", n, "plane") for n in plane}
    runs |= {("circular", n): Run(example.out, f"circular.n{n}", n, "circular") for n in circular}
    runs |= {(name, middle): Run(example.out, f"{name}.n{middle}", middle, "circular") for name in ("circular_move_no", "circular_hex")}
    table = example.out / "errors.csv"
    with csv_rows(table, ["flow", "n", *(f"error t={t}" for t in PLANE_TIMES[:-1]), "error steady", "first wall", "second wall", "sum"]) as writerow:
        print()
        for (kind, n), run in runs.items():
            writerow([kind, n, *(f"{e:.5f}" for e in run.errors.values()), f"{run.ratio_first:.5f}", f"{run.ratio_second:.5f}",
                      f"{run.balance:.1e}"])
            print(f"{kind}, n = {n}: errors", ", ".join(f"{e:.5f} (t = {t})" for t, e in run.errors.items()) + "; steady",
                  f"{'stress' if kind == 'plane' else 'torque'} over the exact one {run.ratio_first:.5f}, {run.ratio_second:.5f},",
                  f"sum {run.balance:.1e}")
    pictures = []
    for kind, sizes in (("plane", plane), ("circular", circular)):
        print()
        finest = runs[kind, max(sizes)]
        for time in (EARLY, finest.last):
            if not args.quick:
                example.merit(f"{kind}: error at t = {time}, n = {finest.n}", finest.errors[time], 0.0, SMALL)
        errors = [runs[kind, n].errors[finest.last] for n in sizes]
        if kind == "plane":
            example.merit(f"plane: largest error at t = {finest.last}, any n", max(errors), 0.0, LINEAR)
        else:
            example.merit(f"circular: largest error at t = {finest.last} times n^2, any n", max(e * n**2 for e, n in zip(errors, sizes)), 0.0, SECOND)
        for which, ratio in (("first", finest.ratio_first), ("second", finest.ratio_second)):
            example.merit(f"{kind}: steady {'stress' if kind == 'plane' else 'torque'} on the {which} wall over the exact one, minus 1",
                          abs(ratio - 1), 0.0, TORQUE)
        example.merit(f"{kind}: sum of both over the second", abs(finest.balance), 0.0, BALANCE)
        pictures.append(example.out / f"{kind}.png")
        plot(pictures[-1], kind, runs, sizes)
    return example.finish(*pictures, table)


if __name__ == "__main__":
    sys.exit(main())
