#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Sloshing of water in a tank that is shaken, by gravity that sways and by motion of the tank, against the exact linear solution.

    ./sphd run sloshing          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, frames, pyplot, save      # noqa: E402

L, A, RATIO = 2.0, 0.01, 0.8                    # length of the tank, amplitude of the acceleration, frequency over that of the first mode
EVERY, FRAMES = 0.05, 0.5                       # time between outputs, and between dumps of the particles
JOBS = {"gravity": {"n": 25}, "tank": {"n": 25, "way": "tank"}, "coarse": {"n": 15}}
QUICK = {"gravity": {"n": 15, "end": 20.0}, "tank": {"n": 15, "end": 20.0, "way": "tank"}}
FREQUENCY, MISFIT = 0.02, 0.10                  # bars: of the first mode; of the center with that frequency
SAME = 1e-4                                     # difference of the two ways, over the amplitude
TIMES = 8.0, 16.0, 38.0                         # of the pictures
STRETCH = (0.93, 1.07)


def modes(t, stretch=1.0, count=15):
    """Amplitudes of the odd modes cos(n pi x/L) of the elevation, for an acceleration A sin(omega t) from rest.  O. M. Faltinsen,
    A. N. Timokha, Sloshing (Cambridge, 2009), chapter 5: b'' + omega_n^2 b = P_n A sin(omega t), omega_n^2 = k tanh k, k = n pi/L,
    P_n = -4/(n pi) tanh k.  stretch: of all frequencies."""
    omega = RATIO * np.sqrt(np.pi / L * np.tanh(np.pi / L))
    for n in range(1, 2 * count, 2):
        k = n * np.pi / L
        own = stretch * np.sqrt(k * np.tanh(k))
        forcing = -4 / (n * np.pi) * np.tanh(k) * A
        yield n, forcing * (np.sin(omega * t) - omega / own * np.sin(own * t)) / (own**2 - omega**2)


def center(t, stretch=1.0):
    """Of mass, relative to the middle of the tank: the mean of the elevation times x."""
    return sum(-2 * L / (n * np.pi)**2 * amplitude for n, amplitude in modes(t, stretch))


def elevation(x, t):
    return sum(amplitude * np.cos(n * np.pi * x / L) for n, amplitude in modes(t))


class Run:
    def __init__(self, out, name, n, **_):
        self.n = n
        _, self.center, self.force, self.place = np.loadtxt(out / f"{name}.probe.txt").T
        self.center -= L / 2
        self.t = EVERY * np.arange(len(self.center))
        stretches = np.linspace(*STRETCH, 1401)
        misfits = [np.sum((self.center - center(self.t, stretch))**2) for stretch in stretches]
        self.frequency = stretches[np.argmin(misfits)]
        self.misfit = np.sqrt(min(misfits) / np.sum(center(self.t)**2))
        self.frames = list(frames(out / f"{name}.particles.txt").values())
        self.times = FRAMES * np.arange(len(self.frames))
        self.level = np.array([frame["y"][frame["x"] - place < 2.0 / n].max() + 0.5 / n - 1.0
                               for frame, place in zip(self.frames, self.place[::round(FRAMES / EVERY)])])


def plot(path, runs):
    plt = pyplot()
    main = runs["gravity"]
    figure = plt.figure(figsize=(9.6, 6.0))
    top, bottom = figure.subfigures(2, 1, height_ratios=[1.0, 1.7])
    panels = top.subplots(1, len(TIMES), sharex=True, sharey=True)
    x = np.linspace(0, L, 200)
    for axes, time in zip(panels, TIMES):
        k = min(round(time / FRAMES), len(main.frames) - 1)
        frame = main.frames[k]
        picture = axes.scatter(frame["x"], frame["y"], c=np.maximum(100 * (frame["c_rho"] - 1), 0), s=150 / main.n, lw=0, vmin=0, vmax=1,
                               cmap="viridis", rasterized=True)
        axes.plot(x, 1 - 0.5 / main.n + elevation(x, main.times[k]), "C3-", lw=1.2)      # of the uppermost particles
        axes.plot([0, 0, L, L], [1.15, 0, 0, 1.15], "k-", lw=1)
        axes.set(xlim=(-0.05, L + 0.05), ylim=(-0.05, 1.15), xlabel="$x/H$")
        axes.set_title(f"$t\\,(g/H)^{{1/2}}$ = {main.times[k]:g}", loc="left")
        axes.grid(False)
    panels[0].set_ylabel("$y/H$")
    top.colorbar(picture, ax=panels, label="pressure $p/(\\rho g H)$", shrink=0.8)
    upper, lower = bottom.subplots(2, 1, sharex=True)
    upper.plot(main.t, center(main.t), "k", lw=2.6, alpha=0.3, label="exact linear solution")
    lower.plot(main.t, elevation(0.0, main.t), "k", lw=2.6, alpha=0.3, label="exact linear solution")
    for name, style, label in (("gravity", "C0-", "gravity sways"), ("tank", "C1--", "tank moves"), ("coarse", "C3:", "gravity sways")):
        if name in runs:
            run = runs[name]
            upper.plot(run.t, run.center, style, lw=1.0, label=f"{label}, n = {run.n}")
            lower.plot(run.times, run.level, style[:2] + ("x" if name == "tank" else "o"), ms=3, mfc="none")
    upper.set(title="center of mass of the water, $x/H$", ylim=(-0.02, 0.03))
    lower.set(title="water level at the left wall, over H", xlabel="time $t\\,(g/H)^{1/2}$", xlim=(0, main.t[-1]))
    upper.legend(ncol=4, loc="upper left", fontsize=8)
    save(figure, path)


def main():
    example = Example(HERE, "Water in a tank that is shaken.")
    args = example.arguments()
    jobs = QUICK if args.quick else dict(reversed(JOBS.items()))
    example.run({name: dict(variables) for name, variables in jobs.items()})
    runs = {name: Run(example.out, name, **variables) for name, variables in sorted(jobs.items(), key=lambda job: list(JOBS).index(job[0]))}
    table = example.out / "sloshing.csv"
    print("\nrun        n  frequency/exact  misfit of the center with it  largest center  exact")
    with csv_rows(table, ["run", "n", "frequency/exact", "misfit", "largest center", "exact"]) as writerow:
        for name, run in runs.items():
            values = run.frequency, run.misfit, np.abs(run.center).max(), np.abs(center(run.t)).max()
            writerow([name, run.n, *(f"{value:.5f}" for value in values)])
            print("{:8s} {:3d}  {:15.4f}  {:28.4f}  {:14.5f}  {:.5f}".format(name, run.n, *values))
    one, other = runs["gravity"], runs["tank"]
    difference = np.abs(one.center - other.center).max() / np.abs(one.center).max()
    print(f"\ndifference of the two ways, over the amplitude: {difference:.1e}\n")
    for name, run in runs.items():
        example.merit(f"{name}: frequency of the first mode over exact", run.frequency, 1 - FREQUENCY, 1 + FREQUENCY)
        example.merit(f"{name}: misfit of the center of mass with this frequency", run.misfit, 0.0, MISFIT)
    example.merit("difference of the two ways, over the amplitude", difference, 0.0, SAME)
    picture = example.out / "sloshing.png"
    plot(picture, runs)
    return example.finish(picture, table)


if __name__ == "__main__":
    sys.exit(main())
