#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""A bubble that rises in a heavier fluid, against the first benchmark of S. Hysing et al., Int. J. Numer. Meth. Fluids 60, 1259 (2009).

    ./sphd run rising_bubble          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, frames, pyplot, save      # noqa: E402

SIZES = {"n80": {"n": 80}, "n40": {"n": 40}, "n20": {"n": 20}}
PRESSURES = {"pb1": {"n": 40, "pb": 1.0}, "pb16": {"n": 40, "pb": 16.0}}
KERNELS = {"c2": {"n": 40, "support": 4, "kernel": "wendland/c2"}}
QUICK = {"n20": {"n": 20, "end": 1.25}}    # until the speed is largest
EVERY = 0.25                # time between two pictures
WINDOW = 0.1                # of the running mean of the speed, which has the sound of the start
# smallest circularity and its time, largest speed and its time, height of the center at t = 3, of the finest grid of each group
GROUPS = {"TP2D": (0.9013, 1.9041, 0.2417, 0.9213, 1.0813), "FreeLIFE": (0.9011, 1.8750, 0.2421, 0.9313, 1.0799),
          "MooNMD": (0.9013, 1.9000, 0.2417, 0.9239, 1.0817)}
PUBLISHED = np.mean(list(GROUPS.values()), axis=0)
NAMES = "smallest circularity", "its time", "largest speed", "its time", "height of the center at the end"
BARS = 0.02, None, 0.03, 0.1, 0.03       # relative; the smallest circularity is a flat minimum


def outline(x, y, light, dx):
    """Points of the line on which the share of the bubble, a mean of the particles around with a Gaussian, is a half."""
    from contourpy import contour_generator
    nx, ny = round(1.0 / dx) + 1, round(2.0 / dx) + 1
    gx, gy = np.linspace(0, 1, nx), np.linspace(0, 2, ny)
    total, mine = np.zeros((ny, nx)), np.zeros((ny, nx))
    near = np.arange(-4, 5)
    for weight, field in (np.ones_like(x), total), (light.astype(float), mine):
        for i in near:
            for j in near:
                column, row = np.rint(x / dx).astype(int) + i, np.rint(y / dx).astype(int) + j
                ok = (column >= 0) & (column < nx) & (row >= 0) & (row < ny)
                distance = (gx[column[ok]] - x[ok])**2 + (gy[row[ok]] - y[ok])**2
                np.add.at(field, (row[ok], column[ok]), weight[ok] * np.exp(-distance / (2 * dx**2)))
    return max(contour_generator(gx, gy, mine / total).lines(0.5), key=len)


def circularity(line):
    """Perimeter of the circle of the same area over that of the line."""
    x, y = line.T
    area = abs(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])) / 2
    return 2 * np.sqrt(np.pi * area) / np.hypot(np.diff(x), np.diff(y)).sum()


class Run:
    def __init__(self, out, name, n, **_):
        _, self.height, self.speed = np.loadtxt(out / f"{name}.probe.txt").T
        self.t = np.linspace(0, 0.01 * (len(self.height) - 1), len(self.height))
        count = round(WINDOW / 0.01) + 1
        self.mean = np.convolve(self.speed, np.ones(count) / count, "same")[count // 2:-(count // 2)]
        self.mean_t = self.t[count // 2:-(count // 2)]
        self.frames = list(frames(out / f"{name}.particles.txt").values())
        self.times = EVERY * np.arange(len(self.frames))
        self.lines = [outline(frame["x"], frame["y"], frame["type"] == 2, 1.0 / n) for frame in self.frames]
        self.circularity = np.array([circularity(line) for line in self.lines])
        k = min(max(np.argmin(self.circularity), 1), len(self.times) - 2)
        a, b, c = np.polyfit(self.times[k - 1:k + 2], self.circularity[k - 1:k + 2], 2)
        fastest = np.argmax(self.mean)
        self.results = (c - b**2 / (4 * a), -b / (2 * a), self.mean[fastest], self.mean_t[fastest], self.height[-1])


def plot(path, runs):
    plt = pyplot()
    figure, axes = plt.subplots(1, 4, figsize=(11.0, 4.2), width_ratios=[1.0, 1.3, 1.3, 1.3])
    best = next(iter(runs.values()))
    picture, *curves = axes
    frame = best.frames[-1]
    light = frame["type"] == 2
    picture.scatter(frame["x"], frame["y"], s=1.2, c=np.where(light, "C1", "0.85"), lw=0, rasterized=True)
    for time in 0.0, 1.0, 2.0, 3.0:
        line = best.lines[round(time / EVERY)]
        picture.plot(*line.T, "k", lw=0.8)
    picture.set(aspect="equal", xlim=(0, 1), ylim=(0, 2), xticks=[], yticks=[], title="t = 0, 1, 2, 3")
    for name, color in zip(reversed(SIZES), ("C2", "C1", "C0")):
        run, label = runs[name], f"{name[1:]} particles in the width"
        curves[0].plot(run.mean_t, run.mean, color=color, label=label)
        curves[1].plot(run.t, run.height, color=color)
        curves[2].plot(run.times, run.circularity, color=color)
    for values in GROUPS.values():
        curves[0].plot(values[3], values[2], "kx")
        curves[1].plot(3.0, values[4], "kx")
        curves[2].plot(values[1], values[0], "kx")
    for one, title in zip(curves, ("speed of the bubble", "height of its center", "circularity")):
        one.set(xlabel="time", title=title)
    curves[0].set(ylim=(0, 0.28))
    curves[0].plot([], [], "kx", label="published")
    curves[0].legend(loc="lower right")
    save(figure, path)


def main():
    example = Example(HERE, "A bubble that rises in a heavier fluid.")
    args = example.arguments()
    jobs = QUICK if args.quick else {**SIZES, **PRESSURES, **KERNELS}
    example.run(jobs)
    runs = {name: Run(example.out, name, **variables) for name, variables in jobs.items()}
    shown = range(2, 4) if args.quick else range(5)    # the others are of t = 3
    print("run       " + "  ".join(NAMES[k] for k in shown))

    def row(name, values):
        print(f"{name:8s}  " + "  ".join(f"{values[k]:{len(NAMES[k])}.{2 if k in (1, 3) else 4}f}" for k in shown))

    for name, run in runs.items():
        row(name, run.results)
    for name, values in GROUPS.items():
        row(name, values)
    best = next(iter(runs.values()))
    print("\nover the mean of the three groups: " + ", ".join(f"{NAMES[k]} {best.results[k] / PUBLISHED[k]:.4f}" for k in shown) + "\n")
    for k in shown:
        if BARS[k]:
            example.merit(f"{NAMES[k]}, over published", best.results[k] / PUBLISHED[k], 1 - BARS[k], 1 + BARS[k])
    if args.quick:
        return example.finish()
    picture = example.out / "rising_bubble.png"
    plot(picture, runs)
    return example.finish(picture)


if __name__ == "__main__":
    sys.exit(main())
