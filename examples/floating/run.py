#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""A box that floats on water: draft against Archimedes, heave against linear waves, and a box that falls into the water.

    ./sphd run floating          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.sparse import lil_matrix
from scipy.sparse.linalg import splu

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, frames, pyplot, save      # noqa: E402

LENGTH, WIDTH, HEIGHT = 4.0, 0.8, 0.4           # period of the tank, box
RATIO, LIFT = 0.6, 0.08                         # density of the box over that of water; above its place at rest, of the runs that heave
EVERY = 0.05                                    # time between outputs
JOBS = {"fine": {"n": 50, "end": 4.0}, "heave": {"n": 25, "end": 12.0}, "drop": {"n": 25, "lift": 0.48, "frames": 0.1, "end": 8.0},
        "light": {"n": 25, "ratio": 0.2, "lift": 0.0, "end": 10.0}, "heavy": {"n": 25, "ratio": 0.9, "lift": 0.0, "end": 10.0}}
QUICK = {"heave": {"n": 25, "end": 3.0}, "heavy": {"n": 25, "ratio": 0.9, "lift": 0.0, "end": 0.5}}
FREQUENCY, MISFIT, PLACE = 0.02, 0.15, 0.1      # bars: of the heave; of the height at rest, in spacings
TIMES = 0.8, 2.0, 4.0                           # of the pictures
STRETCH = (0.93, 1.07)


def heave(t, n=50):
    """Height of the box over its place at rest, released with the water level with its surface: linear waves without viscosity.

    The potential phi of the velocity, by finite volumes of the size 1/n in half of the period, which is symmetric: no flow through the floor and
    the planes of symmetry, the velocity of the box below it.  At the surface d(eta)/dt = d(phi)/dy and d(phi)/dt = -eta; the box has
    m d^2z/dt^2 = -d/dt int phi dx - z WIDTH."""
    h, size = 1.0 / n, RATIO * HEIGHT
    columns, rows, under, deep = (round(n * length) for length in (LENGTH / 2, 1.0, WIDTH / 2, 1.0 - size))
    wet = np.ones((columns, rows), bool)
    wet[:under, deep:] = False
    number, count = np.cumsum(wet).reshape(wet.shape) - 1, wet.sum()
    laplace = lil_matrix((count, count))
    for one, other in ((np.s_[1:], np.s_[:-1]), (np.s_[:, 1:], np.s_[:, :-1])):
        both = wet[one] & wet[other]
        i, j = number[one][both], number[other][both]
        laplace[i, j] = laplace[j, i] = 1.0
    top, bottom = number[under:, -1], number[:under, deep - 1]
    links = -np.asarray(laplace.sum(axis=1)).ravel()
    links[top] -= 2.0
    laplace.setdiag(links)
    surface = len(top)
    sources = np.zeros((count, surface + 1))        # of each potential at the surface, and of the velocity of the box
    sources[top, np.arange(surface)] = -2.0
    sources[bottom, -1] = -h
    phi = splu(laplace.tocsc()).solve(sources)
    push = h * phi[bottom].sum(axis=0)              # integral of phi below half of the box
    inertia = size * WIDTH / 2 + push[-1] + under * h * h / 2
    matrix = np.zeros((2 * surface + 2, 2 * surface + 2))      # elevations, potentials, height and velocity of the box
    matrix[:surface, surface:2 * surface] = 2 * n * (np.eye(surface) - phi[top, :-1])
    matrix[:surface, -1] = -2 * n * phi[top, -1]
    matrix[surface:2 * surface, :surface] = -np.eye(surface)
    matrix[-2, -1] = 1.0
    matrix[-1, :surface] = push[:-1] / inertia
    matrix[-1, -2] = -WIDTH / 2 / inertia
    start = np.zeros(len(matrix))
    start[:surface], start[-2] = -LIFT * WIDTH / LENGTH, LIFT * (1 - WIDTH / LENGTH)
    values, vectors = np.linalg.eig(matrix)
    return ((np.exp(np.outer(t, values)) * np.linalg.solve(vectors, start)) @ vectors[-2]).real


class Run:
    def __init__(self, out, name, n, ratio=RATIO, lift=LIFT, frames_every=0.5, **_):
        self.n, self.ratio = n, ratio
        self.y = np.loadtxt(out / f"{name}.probe.txt")[:, 2]
        self.t = EVERY * np.arange(len(self.y))
        self.rest = 1 - ratio * HEIGHT + HEIGHT / 2 + min(lift, ratio * HEIGHT) * WIDTH / LENGTH
        self.frames = list(frames(out / f"{name}.particles.txt").values())
        self.times = frames_every * np.arange(len(self.frames))

    def compare(self, t, z):
        """with the reference: frequency over its one, misfit, and height at rest above its one in spacings"""
        mine, best = self.y - self.rest, np.inf
        for stretch in np.linspace(*STRETCH, 281):
            curve = np.interp(stretch * self.t, t, z)
            terms = np.column_stack([curve, np.ones_like(curve)])
            factors = np.linalg.lstsq(terms, mine, rcond=None)[0]
            rest = np.sum((terms @ factors - mine)**2)
            if rest < best:
                best, self.frequency, self.place = rest, stretch, factors[1] * self.n
        exact = np.interp(self.t, t, z)
        self.misfit = np.sqrt(np.mean((mine - exact)**2) / np.mean(exact**2))


def plot(path, runs, t, z):
    plt = pyplot()
    figure = plt.figure(figsize=(9.6, 6.4))
    top, bottom = figure.subfigures(2, 1, height_ratios=[1.0, 1.5])
    shown = runs.get("drop", next(iter(runs.values())))
    panels = top.subplots(1, len(TIMES), sharex=True, sharey=True)
    for axes, time in zip(panels, TIMES):
        k = np.argmin(np.abs(shown.times - time))
        frame = shown.frames[k]
        water, box = frame["type"] == 1, frame["type"] == 3
        picture = axes.scatter(frame["x"][water], frame["y"][water], c=frame["vy"][water], s=60 / shown.n, lw=0, vmin=-0.3, vmax=0.3, cmap="RdBu_r", rasterized=True)
        axes.scatter(frame["x"][box], frame["y"][box], c="k", s=60 / shown.n, lw=0, rasterized=True)
        axes.set(xlim=(0, LENGTH), ylim=(0, 1.7), xlabel="$x/H$", aspect="equal")
        axes.set_title(f"$t\\,(g/H)^{{1/2}}$ = {shown.times[k]:g}", loc="left")
        axes.grid(False)
    panels[0].set_ylabel("$y/H$")
    top.colorbar(picture, ax=panels, label="$v_y/(gH)^{1/2}$", shrink=0.55)
    left, right = bottom.subplots(1, 2)
    left.plot(t, z, "k", lw=2.6, alpha=0.3, label="linear waves")
    for name, style in (("heave", "C3-"), ("fine", "C0-")):
        if name in runs:
            left.plot(runs[name].t, runs[name].y - runs[name].rest, style, lw=1.0, label=f"particles, n = {runs[name].n}")
    left.set(title="heave of the box, $z/H$", xlabel="time $t\\,(g/H)^{1/2}$", xlim=(0, t[-1]))
    for name, label in (("light", "0.2 of the density of water, at rest"), ("drop", "0.6, falls"), ("heavy", "0.9, at rest")):
        if name in runs:
            line, = right.plot(runs[name].t, runs[name].y, lw=1.0, label=label)
            right.axhline(runs[name].rest, color=line.get_color(), lw=2.6, alpha=0.3)
    right.set(title="height of the center, $y/H$; wide: Archimedes", xlabel="time $t\\,(g/H)^{1/2}$")
    left.legend(fontsize=8, loc="lower right")
    right.legend(fontsize=8, loc="upper right")
    save(figure, path)


def main():
    example = Example(HERE, "A box that floats on water.")
    args = example.arguments()
    jobs = QUICK if args.quick else JOBS
    example.run(jobs)
    runs = {name: Run(example.out, name, **{"frames_every": variables.get("frames", 0.5), **variables}) for name, variables in jobs.items()}
    t = np.linspace(0, max(run.t[-1] for name, run in runs.items() if name in ("heave", "fine")), 1001)
    z = heave(STRETCH[1] * t)
    table = example.out / "floating.csv"
    print("\nheave    n  frequency/exact  misfit  height at rest - exact in spacings")
    with csv_rows(table, ["run", "n", "density", "frequency/exact", "misfit", "draft", "draft of Archimedes", "height at rest - exact in spacings"]) as writerow:
        for name in sorted({"heave", "fine"} & set(runs), reverse=True):
            run = runs[name]
            run.compare(STRETCH[1] * t, z)
            writerow([name, run.n, run.ratio, f"{run.frequency:.4f}", f"{run.misfit:.4f}", "", "", f"{run.place:.3f}"])
            print(f"{name:6s} {run.n:3d}  {run.frequency:15.4f}  {run.misfit:.4f}  {run.place:.3f}")
        print("\nat rest   density  draft   Archimedes  height - exact in spacings")
        for name in sorted({"light", "heavy"} & set(runs)):
            run = runs[name]
            draft, exact = 1 + HEIGHT / 2 - run.y.mean(), run.ratio * HEIGHT
            run.place = (exact - draft) * run.n
            writerow([name, run.n, run.ratio, "", "", f"{draft:.5f}", f"{exact:.5f}", f"{run.place:.3f}"])
            print(f"{name:8s} {run.ratio:8.1f}  {draft:.4f}  {exact:10.4f}  {run.place:.3f}")
    print()
    for name, run in runs.items():
        if name in ("heave", "fine"):
            example.merit(f"{name}: frequency over that of linear waves", run.frequency, 1 - FREQUENCY, 1 + FREQUENCY)
            example.merit(f"{name}: misfit of the height", run.misfit, 0.0, MISFIT)
        if name != "drop":
            example.merit(f"{name}: height at rest above that of Archimedes, in spacings", run.place, -PLACE, PLACE)
    picture = example.out / "floating.png"
    plot(picture, runs, t, np.interp(t, STRETCH[1] * t, z))
    return example.finish(picture, table)


if __name__ == "__main__":
    sys.exit(main())
