#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Taylor-Green vortex in three dimensions against a spectral solution, for three bulk viscosities.

    ./sphd run taylor_green       or
    SPHD_LMP=path/to/lmp python3 run.py [--n 64] [--re 100 200] [--kappa 0 1 10] [--quick] [--np N] [--out DIR] [--check]
"""

import csv
import sys
from pathlib import Path

import numpy as np

import reference

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example      # noqa: E402

ENERGY = 0.02               # energy over that of the spectral solution, n = 64, Re = 100
PEAK, PEAK_TIME = 0.05, 0.2     # of the rate of loss of energy
KAPPA = 0.01                # energy with bulk viscosity over that without


class Run:
    def __init__(self, re, kappa, n, tend):
        self.re, self.kappa, self.n = re, kappa, n
        self.name = f"re{re:g}.kappa{kappa:g}"
        self.variables = {"re": re, "kappa": kappa, "n": n, "tend": tend}

    def measure(self, out):
        self.t, self.kinetic, self.total, self.shear, self.bulk = np.loadtxt(out / f"{self.name}.energy.txt", ndmin=2).T[1:]
        self.totals = np.loadtxt(out / f"{self.name}.totals.txt", ndmin=2).T[1:]
        t, energy, self.exact_power = reference.load(self.re)
        self.exact = np.interp(self.t, t, energy)
        self.error = self.kinetic / self.exact - 1
        # the energy lost, not the heat: sound passes energy to and fro within 0.3
        wide = np.ones(5) / 5
        self.rate_t = np.convolve(self.t, wide, "valid")[1:-1]
        self.rate = -np.gradient(np.convolve(self.kinetic, wide, "valid"), self.t[1])[1:-1]
        self.peak = self.rate.max(), self.rate_t[self.rate.argmax()]

    def resolved(self):
        """Times of the spectra, and mu <omega^2> + (lambda + 2 mu) <div^2> over the power of the particles there."""
        t, power = self.totals[0], self.totals[5] + self.totals[6]
        return t, power / np.interp(t, self.t, self.shear + self.bulk)

    def spectra(self, out):
        frames, rows = [], 0
        for line in (out / f"{self.name}.spectra.txt").read_text().splitlines():
            if line.startswith("#"):
                continue
            words = line.split()
            if rows == 0:
                rows = int(words[1])
                frames.append([])
            else:
                frames[-1].append(words[1:])
                rows -= 1
        return [np.array(frame, dtype=float).T for frame in frames]


def plot(out, runs):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "legend.fontsize": 8})
    figure, axes = plt.subplots(1, 3, figsize=(11, 3.4))
    for re in sorted({run.re for run in runs}):
        t, energy, power = reference.load(re)
        axes[0].plot(t, energy, "k-", lw=3, alpha=0.3, label=f"spectral, Re = {re:g}")
        axes[1].plot(t, power, "k-", lw=3, alpha=0.3)
    for number, run in enumerate(runs):
        label, color = f"SPH, Re = {run.re:g}, $\\kappa/\\mu$ = {run.kappa:g}", f"C{number}"
        axes[0].plot(run.t, run.kinetic, color=color, label=label)
        axes[1].plot(run.rate_t, run.rate, color=color)
        axes[1].plot(run.t, run.shear + run.bulk, ":", color=color)
    axes[1].plot([], [], ":", color="0.4", label="heat of the particles")
    axes[0].set_ylabel("kinetic energy")
    axes[1].set_ylabel("loss of energy")
    for axis in axes[:2]:
        axis.set_xlabel("time")
        axis.legend()
    for number, run in enumerate(runs[:1]):
        frames = run.spectra(out)
        for time, color in zip(range(0, len(frames), max(1, len(frames) // 4)), ("0.7", "C0", "C1", "C2", "C3")):
            k, _, solenoidal, dilatational = frames[time][:4]
            axes[2].loglog(k[1:], solenoidal[1:], "-", color=color, label=f"t = {time}")
            axes[2].loglog(k[1:], dilatational[1:], ":", color=color)
    axes[2].set_xlabel("wave number")
    axes[2].set_ylabel("$E^s$ (lines), $E^d$ (dots)")
    axes[2].set_ylim(1e-10, 1)
    axes[2].legend()
    figure.tight_layout()
    paths = [out / "energy.png"]
    figure.savefig(paths[0], dpi=130)
    return paths


def main():
    example = Example(HERE, __doc__)
    example.parser.add_argument("--n", type=int, default=32, help="particles per side (%(default)s)")
    example.parser.add_argument("--re", type=float, nargs="+", default=[100])
    example.parser.add_argument("--kappa", type=float, nargs="+", default=[0, 10], help="bulk viscosity over mu")
    args = example.arguments()
    n, tend = (16, 1) if args.quick else (args.n, 10)
    runs = [Run(re, kappa, n, tend) for re in args.re for kappa in args.kappa]
    example.run({run.name: {**run.variables, "grid": 0 if args.quick else 1} for run in runs})

    table = example.out / "taylor_green.csv"
    with open(table, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["re", "kappa_over_mu", "n", "t", "energy", "energy_over_spectral", "heat_shear", "heat_bulk"])
        for run in runs:
            run.measure(example.out)
            for row in zip(run.t, run.kinetic, run.error + 1, run.shear, run.bulk):
                writer.writerow([run.re, run.kappa, run.n, *(f"{value:.6g}" for value in row)])
    for run in runs:
        worst = abs(run.error).max()
        t, resolved = run.resolved()
        print(f"Re = {run.re:g}, kappa/mu = {run.kappa:g}: energy within {100 * worst:.2f} %, largest loss {run.peak[0]:.5f} at "
              f"{run.peak[1]:.2f}, energy drift {run.total[-1] / run.total[0] - 1:+.1e}; spectral over particle power "
              + ", ".join(f"{value:.3f} (t = {time:g})" for time, value in zip(t, resolved)))
        if run.re == 100:
            example.merit(f"kappa/mu = {run.kappa:g}: largest error of the energy", worst, 0, ENERGY)
            if not args.quick:
                t, _, power = reference.load(run.re)
                example.merit(f"kappa/mu = {run.kappa:g}: largest loss of energy over that of the spectral solution",
                              run.peak[0] / power.max(), 1 - PEAK, 1 + PEAK)
                example.merit(f"kappa/mu = {run.kappa:g}: time of the largest loss less that of the spectral solution",
                              run.peak[1] - t[power.argmax()], -PEAK_TIME, PEAK_TIME)
        same = next(other for other in runs if other.re == run.re)
        if same is not run:
            example.merit(f"Re = {run.re:g}: largest difference of the energy with kappa/mu = {run.kappa:g} and {same.kappa:g}",
                          abs(run.kinetic / same.kinetic - 1).max(), 0, KAPPA)
    return example.finish(table, *([] if args.quick else plot(example.out, runs)))


if __name__ == "__main__":
    sys.exit(main())
