#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""A dam break with a box in its way, SPHERIC benchmark 2: pressures on the box and levels, against the experiment.

    SPHD_LMP=path/to/lmp python3 obstacle.py [--fine] [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, pyplot, save, series, thermo      # noqa: E402

CASES = {"n18": {"n": 18, "end": 6.0}}
FINE = {"n36": {"n": 36, "kappa": 0.15, "end": 0.52}}
QUICK = {"quick": {"n": 8, "end": 0.6}}
LEVELS = "H1", "H2", "H3", "H4"
SHOWN = "P1", "P3", "P5", "H1", "H2", "H4"
MEANS = (0.43, 0.5), (0.5, 0.7), (0.7, 1.1)     # of time, for mean pressures


def arrival(t, p, above=200.0):
    """Time at which P1 passes a pressure between two means of 2 ms."""
    first = np.argmax(p > above)
    return np.interp(above, p[first - 1:first + 1], t[first - 1:first + 1]) if first else np.inf


class Run:
    def __init__(self, out, name):
        self.gauges = series(out / f"{name}.gauges.txt")
        self.t = self.gauges["t"]
        self.pictures = sorted(out.glob(f"{name}.*.png"))
        (table,) = thermo((out / f"{name}.log").read_text())
        self.atoms = table["Atoms"]
        p = self.gauges["P1"]
        self.arrival = arrival(self.t, p)
        self.peak = p.max()

    def mean(self, name, begin, end):
        there = (self.t >= begin) & (self.t < end)
        return self.gauges[name][there].mean() if self.t[-1] > end else np.nan

    def distance(self, data, name):
        """Mean distance from the experiment, over the largest value of the experiment in this time."""
        there = data["t"] < self.t[-1]
        value = data[name][there]
        return np.abs(np.interp(data["t"][there], self.t, self.gauges[name]) - value).mean() / value.max()


def read(path):
    names, *rows = [line.split(",") for line in path.read_text().splitlines() if not line.startswith("#")]
    return dict(zip(names, np.array(rows, dtype=float).T))


def plot(path, runs, data):
    plt = pyplot()
    shown = list(runs.values())[0]
    figure = plt.figure(figsize=(9.6, 8.0))
    top, bottom = figure.subfigures(2, 1, height_ratios=[0.8, 1.0])
    for axes, k in zip(top.subplots(2, 2).ravel(), (2, 3, 5, 10)):
        k = min(k, len(shown.pictures) - 1)
        axes.imshow(plt.imread(shown.pictures[k])[100:])
        axes.set_title(f"t = {0.2 * k:g} s", loc="left")
        axes.axis("off")
    for axes, name in zip(bottom.subplots(2, 3).ravel(), SHOWN):
        scale = 1e-3 if name[0] == "P" else 1.0
        axes.plot(data["t"], scale * data[name], "k-", lw=1.2, label="experiment")
        for index, (case, run) in enumerate(runs.items()):
            axes.plot(run.t, scale * run.gauges[name], f"C{index}", lw=0.6, label=case)
        if name[0] == "P":
            axes.set(xlim=(0.35, 1.2), ylim=(-0.5, 16))
        else:
            axes.set(xlim=(0, min(6.0, max(run.t[-1] for run in runs.values()))), ylim=(0, None))
        axes.set_title(f"{name}, {'kPa' if name[0] == 'P' else 'm'}", loc="left")
    axes.legend()
    save(figure, path)


def main():
    example = Example(HERE, __doc__.splitlines()[0])
    example.parser.add_argument("--fine", action="store_true", help="36 particles per height as well, to 0.52 s: an hour")
    args = example.arguments()
    cases = QUICK if args.quick else {**CASES, **FINE} if args.fine else CASES
    example.run(dict(reversed(cases.items())), {name: HERE / "in.obstacle" for name in cases})
    data = read(HERE / "kleefsman2005.csv")
    runs = {name: Run(example.out, name) for name in cases}
    table = example.out / "obstacle.csv"
    names = [f"{name} {begin}-{end}" for name in ("P1", "P2", "P3", "P4") for begin, end in MEANS]
    measured, largest = arrival(data["t"], data["P1"]), data["P1"].max()
    print(f"\nexperiment: arrival {measured:.4f} s, peak of P1 {largest:.0f} Pa; " + ", ".join(
        f"{name} s {data[name[:2]][(data['t'] >= begin) & (data['t'] < end)].mean():.0f} Pa"
        for name, (begin, end) in zip(names, MEANS * 4)))
    with csv_rows(table, ["run", "end", "arrival", "peak of P1", *names, *LEVELS]) as writerow:
        for name, run in runs.items():
            means = [run.mean(one[:2], *window) for one, window in zip(names, MEANS * 4)]
            distances = [run.distance(data, level) for level in LEVELS]
            writerow([name, f"{run.t[-1]:.2f}", f"{run.arrival:.4f}", f"{run.peak:.0f}", *(f"{value:.0f}" if np.isfinite(value) else "" for value in means),
                      *(f"{value:.4f}" for value in distances)])
            print(f"\n{name}: {run.atoms[0]:.0f} particles with the walls, to {run.t[-1]:.2f} s; spray that has left: "
                  f"{run.atoms[0] - run.atoms[-1]:.0f}\narrival {run.arrival:.4f} s, peak of P1 {run.peak:.0f} Pa; "
                  + ", ".join(f"{one} s {value:.0f} Pa" for one, value in zip(names, means) if np.isfinite(value))
                  + "\nmean distance of levels over the largest: " + ", ".join(f"{level} {value:.3f}" for level, value in zip(LEVELS, distances)))
    print()
    for name, run in runs.items():
        example.merit(f"{name}: share of the particles that has left", 1 - run.atoms[-1] / run.atoms[0], 0.0, 0.005)
        if args.quick:
            continue
        example.merit(f"{name}: arrival of the water at the box, s", run.arrival, 0.97 * measured, 1.03 * measured)
        example.merit(f"{name}: peak of P1, Pa", run.peak, 0.8 * largest, 1.2 * largest)
        for level in ("H2", "H4"):
            example.merit(f"{name}: mean distance of {level} to {run.t[-1]:.2f} s", run.distance(data, level), 0.0, 0.1)
    picture = example.out / "obstacle.png"
    plot(picture, runs, data)
    return example.finish(picture, table)


if __name__ == "__main__":
    sys.exit(main())
