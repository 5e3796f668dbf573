#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""A standing wave at a free surface: frequency and viscous decay, against the exact linear solution.

    ./sphd run standing_wave          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import curve_fit

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.path.insert(0, str(HERE.parent))
from exact import inviscid, wave      # noqa: E402
from run_lammps import Example, csv_rows, frames, pyplot, save      # noqa: E402

MU, A, C0, EVERY = 0.002, 0.02, 10.0, 0.05
RATIOS = 0, 2, 100                      # kappa/mu
SIZES = 25, 50                          # particles per depth
FITTED = 1.0, 14.0                      # time
LIMITS = {15: ((1.10, 1.40), (0.985, 1.01)), 25: ((1.04, 1.14), (0.995, 1.005)), 50: ((1.00, 1.06), (0.995, 1.007))}    # decay, frequency
CHANGE = 0.015                          # of the decay by the bulk viscosity
PERIODS = 0.25, 0.5, 0.75, 1.0          # of the pictures


class Run:
    def __init__(self, out, name, n, **_):
        self.n = n
        self.mode = np.loadtxt(out / f"{name}.mode.txt")[:, 1]
        self.t = EVERY * np.arange(len(self.mode))
        self.frames = list(frames(out / f"{name}.particles.txt").values())
        decay, omega = wave(MU)
        chosen = (self.t >= FITTED[0]) & (self.t <= FITTED[1])
        self.fit = curve_fit(self.damped, self.t[chosen], self.mode[chosen], [1.0, 0.0, decay, omega])[0]
        self.decay, self.omega = self.fit[2] / decay, self.fit[3] / omega

    @staticmethod
    def damped(t, cosine, sine, decay, omega):
        return (cosine * np.cos(omega * t) + sine * np.sin(omega * t)) * np.exp(-decay * t)


def elevation(x, t):
    """Of the exact wave that begins flat."""
    decay, omega = wave(MU)
    return A * np.exp(-decay * t) * np.sin(omega * t) * np.cos(np.pi * x)


def plot(path, runs):
    plt = pyplot()
    fine = max(runs.values(), key=lambda run: run.n)
    decay, omega = wave(MU)
    figure = plt.figure(figsize=(9.6, 6.4))
    top, bottom = figure.subfigures(2, 1, height_ratios=[1.0, 1.25])
    panels = top.subplots(1, 4, sharex=True, sharey=True)
    x = np.linspace(0, 2, 200)
    for axes, periods in zip(panels, PERIODS):
        frame = fine.frames[min(round(periods * 2 * np.pi / omega / 0.25), len(fine.frames) - 1)]
        time = 0.25 * round(periods * 2 * np.pi / omega / 0.25)
        picture = axes.scatter(frame["x"], frame["y"], c=np.maximum(C0**2 * (frame["c_rho"] - 1), 0), s=160 / fine.n, lw=0, vmin=0, vmax=0.2,
                               cmap="viridis", rasterized=True)
        axes.plot(x, 1 - 0.5 / fine.n + elevation(x, time), "k-", lw=1)      # of the uppermost particles
        axes.set(xlim=(0, 2), ylim=(0.9, 1.03), xlabel="$x/H$")
        axes.set_title(f"$t\\,(g/H)^{{1/2}}$ = {time:g}", loc="left")
        axes.grid(False)
    panels[0].set_ylabel("$y/H$ (stretched)")
    top.colorbar(picture, ax=panels, label="pressure $p/(\\rho g H)$")
    left, right = bottom.subplots(1, 2, width_ratios=[1.7, 1.0])
    left.plot(fine.t, Run.damped(fine.t, 1.0, 0.0, decay, omega), "k", lw=2.6, alpha=0.3, label="exact decay and frequency")
    sizes = sorted({run.n for run in runs.values()})
    for (n, ratio), run in runs.items():
        if n == fine.n and ratio in (min(RATIOS), max(RATIOS)):
            left.plot(run.t, run.mode, "C0-" if ratio == 0 else "C3--", lw=0.9, label=f"n = {n}, $\\kappa = {ratio}\\,\\mu$")
    left.set(xlim=(0, FITTED[1]), ylim=(-1.0, 1.25), xlabel="time $t\\,(g/H)^{1/2}$", title="velocity of the wave over that at the start")
    left.legend(ncol=3, loc="upper right")
    for ratio, color, mark in zip(RATIOS, ("C0", "C1", "C3"), "osx"):
        right.plot(sizes, [runs[n, ratio].decay for n in sizes], color + mark + "-", mfc="none", label=f"$\\kappa = {ratio}\\,\\mu$")
    right.axhline(1, color="k", lw=1)
    right.set(xlabel="particles per depth, n", xticks=sizes, title="decay over the exact decay")
    right.legend()
    save(figure, path)


def main():
    example = Example(HERE, "A standing wave at a free surface.")
    args = example.arguments()
    sizes = [15] if args.quick else SIZES
    jobs = {(n, ratio): {"n": n, "ratio": ratio} for n in reversed(sizes) for ratio in RATIOS}
    example.run({f"n{n}_{ratio}": variables for (n, ratio), variables in jobs.items()})
    runs = {(n, ratio): Run(example.out, f"n{n}_{ratio}", n) for n in sizes for ratio in RATIOS}
    decay, omega = wave(MU)
    print(f"exact: decay {decay / (2 * MU * np.pi**2):.4f} x 2 nu k^2, frequency {omega / inviscid():.5f} x (g k tanh kH)^(1/2)")
    table = example.out / "standing_wave.csv"
    print("\n  n  kappa/mu  decay/exact  frequency/exact")
    with csv_rows(table, ["n", "kappa/mu", "decay/exact", "frequency/exact"]) as writerow:
        for (n, ratio), run in runs.items():
            writerow([n, ratio, f"{run.decay:.4f}", f"{run.omega:.5f}"])
            print(f"{n:3d}  {ratio:8d}  {run.decay:11.3f}  {run.omega:15.4f}")
    print()
    for (n, ratio), run in runs.items():
        example.merit(f"n = {n}, kappa = {ratio} mu: decay over exact", run.decay, *LIMITS[n][0])
        example.merit(f"n = {n}, kappa = {ratio} mu: frequency over exact", run.omega, *LIMITS[n][1])
    for n in sizes:
        example.merit(f"n = {n}: change of the decay by kappa = 100 mu", runs[n, 100].decay / runs[n, 0].decay - 1, -CHANGE, CHANGE)
    picture = example.out / "standing_wave.png"
    plot(picture, runs)
    return example.finish(picture, table)


if __name__ == "__main__":
    sys.exit(main())
