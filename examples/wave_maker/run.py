#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Regular waves of a paddle in a tank with a sponge, against linear wavemaker theory.

    ./sphd run wave_maker          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import brentq, least_squares

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, frames, pyplot, save, series      # noqa: E402

LENGTH, SPONGE, HEIGHT = 18.0, 11.0, 0.1        # of the tank; begin of the sponge; height of the waves by linear theory
GAUGES, LEFT_OUT = np.arange(1.0, 10.0), 1      # places; the first has the near field of the paddle, and is not in the fit
SAMPLES, LAST = 40, 4                           # outputs in a period; periods that are analyzed
JOBS = {"waves": {}, "short": {"k": 2.5}, "coarse": {"n": 12}}
QUICK = {"waves": {"n": 10, "periods": 9}}
WAVE, LENGTHS, BACK = 0.05, 0.02, 0.10          # bars: height at the paddle; wave length; height that comes back


class Theory:
    """Linear waves of a piston: R. G. Dean, R. A. Dalrymple, Water Wave Mechanics for Engineers and Scientists (World Scientific, 1991), chapter 6"""

    def __init__(self, k):
        self.k, self.omega = k, np.sqrt(k * np.tanh(k))
        self.stroke = HEIGHT * (np.sinh(2 * k) + 2 * k) / 2 / (np.cosh(2 * k) - 1)
        self.near = [brentq(lambda q: self.omega**2 * np.cos(q) + q * np.sin(q), (m - 0.5) * np.pi, m * np.pi) for m in range(1, 20)]

    def elevation(self, x, t):
        """of the paddle at S/2 sin(omega t); the near field is in phase with the place of the paddle"""
        near = sum(2 * np.sin(q)**2 / (q + np.sin(q) * np.cos(q)) * np.exp(-q * x) for q in self.near)
        return HEIGHT / 2 * np.cos(self.k * x - self.omega * t) + self.stroke / 2 * near * np.sin(self.omega * t)


class Run:
    def __init__(self, out, name, n=20, k=1.5, periods=14):
        self.n, self.theory = n, Theory(k)
        table = series(out / f"{name}.levels.txt")
        self.t = table["time"]
        self.levels = np.array([table[f"{x:g}"] for x in GAUGES])
        part = slice(-LAST * SAMPLES, None)
        self.amplitude = 2 * (self.levels[:, part] * np.exp(1j * self.theory.omega * self.t[part])).mean(axis=1)
        x, amplitude = GAUGES[LEFT_OUT:], self.amplitude[LEFT_OUT:]

        def waves(number, decay):
            """there, and back from the end of the tank"""
            terms = np.exp(np.outer(x, [1j * number - decay, -1j * number + decay]))
            return terms, np.linalg.lstsq(terms, amplitude, rcond=None)[0]

        def miss(values):
            terms, factors = waves(*values)
            return (terms @ factors - amplitude).view(float)

        number, self.decay = least_squares(miss, [k, 0.0]).x
        there, back = waves(number, self.decay)[1]
        self.height, self.length, self.loss = 2 * abs(there), k / number, 1 - np.exp(-self.decay * 2 * np.pi / number)
        self.back = abs(back / there) * np.exp(2 * self.decay * x.mean())
        self.misfit = np.sqrt(np.mean(miss([number, self.decay])**2) * 2) / abs(there)


def plot(path, runs, out):
    plt = pyplot()
    main = runs["waves"]
    figure = plt.figure(figsize=(9.6, 5.4))
    top, bottom = figure.subfigures(2, 1, height_ratios=[1.0, 2.2])
    axes = top.subplots()
    frame = list(frames(out / "waves.particles.txt").values())[-1]
    water = frame["type"] == 1
    picture = axes.scatter(frame["x"][water], frame["y"][water], c=frame["vx"][water], s=30 / main.n, lw=0, vmin=-0.06, vmax=0.06, cmap="RdBu_r", rasterized=True)
    axes.scatter(frame["x"][~water], frame["y"][~water], c="0.4", s=30 / main.n, lw=0, rasterized=True)
    axes.axvline(SPONGE, color="k", lw=0.8, ls=":")
    axes.set(xlim=(-0.4, LENGTH + 0.2), ylim=(-0.2, 1.3), xlabel="$x/h$", ylabel="$y/h$")
    axes.set_title(f"water at the end, $kh$ = {main.theory.k:g}; the sponge begins at the dotted line", loc="left")
    axes.grid(False)
    top.colorbar(picture, ax=axes, label="$v_x/(gh)^{1/2}$")
    left, right = bottom.subplots(1, 2)
    period = 2 * np.pi / main.theory.omega
    for x, color in ((1, "C0"), (7, "C3")):
        left.plot(main.t / period, main.theory.elevation(x, main.t), color=color, lw=2.6, alpha=0.3)
        left.plot(main.t / period, main.levels[np.searchsorted(GAUGES, x)] - main.levels[np.searchsorted(GAUGES, x), -LAST * SAMPLES:].mean(), color=color, lw=1.0, label=f"$x = {x}\\,h$")
    left.set(title="elevation over h; wide: theory, steady waves", xlabel="time, in periods", xlim=(0, main.t[-1] / period), ylim=(-0.07, 0.09))
    for (name, run), color in zip(runs.items(), ("C0", "C2", "C1")):
        right.plot(GAUGES, 2 * abs(run.amplitude) / HEIGHT, color=color, marker="o", ms=4, mfc="none", lw=0.8, label=f"$kh$ = {run.theory.k:g}, n = {run.n}")
    right.axhline(1.0, color="k", lw=2.6, alpha=0.3)
    right.set(title="height of the waves over that of theory", xlabel="$x/h$", ylim=(0.6, 1.1))
    left.legend(ncol=2, loc="upper left", fontsize=8)
    right.legend(fontsize=8, ncol=2, loc="lower left")
    save(figure, path)


def main():
    example = Example(HERE, "Waves of a paddle, and a sponge.")
    args = example.arguments()
    jobs = QUICK if args.quick else JOBS
    example.run(jobs)
    runs = {name: Run(example.out, name, **variables) for name, variables in jobs.items()}
    table = example.out / "wave_maker.csv"
    print("\nrun     n  kh   height at the paddle/theory  wave length/theory  height lost in a wave length  height back/there  misfit")
    with csv_rows(table, ["run", "n", "kh", "height at the paddle/theory", "wave length/theory", "height lost in a wave length", "height back/there", "misfit"]) as writerow:
        for name, run in runs.items():
            values = run.height / HEIGHT, run.length, run.loss, run.back, run.misfit
            writerow([name, run.n, run.theory.k, *(f"{value:.5f}" for value in values)])
            print("{:6s} {:2d}  {:.1f}  {:27.4f}  {:18.4f}  {:28.4f}  {:17.4f}  {:.4f}".format(name, run.n, run.theory.k, *values))
    print()
    for name, run in runs.items():
        example.merit(f"{name}: height at the paddle over that of theory", run.height / HEIGHT, 1 - WAVE, 1 + WAVE)
        example.merit(f"{name}: wave length over that of theory", run.length, 1 - LENGTHS, 1 + LENGTHS)
        example.merit(f"{name}: height that comes back over that of the waves", run.back, 0.0, BACK)
    picture = example.out / "wave_maker.png"
    plot(picture, runs, example.out)
    return example.finish(picture, table)


if __name__ == "__main__":
    sys.exit(main())
