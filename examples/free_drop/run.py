#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Drops of a liquid with a free surface: they oscillate by its tension, against theory; two drops merge; drops rest on walls.

    ./sphd run free_drop          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, frames, pyplot, save      # noqa: E402

MU, EVERY = 0.1, 80      # shear viscosity; outputs in a period
RADII = 20, 12
SEEDS = 1, 2, 3
JOBS = {f"r{radius}_{seed}": {"radius": radius, "seed": seed} for radius in RADII for seed in SEEDS}
QUICK = {"r12_1": {"radius": 12, "seed": 1, "end": 1.0}}
TIMES = 0, 20, 80, 500   # of the frames of two drops that merge
ANGLES = {2: (40, 60, 90, 120, 150), 3: (90, 120)}     # contact angles of walls; 40: not held
STARTS = {"flat": -30, "round": 30}                     # angle of the drop at the beginning less that of the wall
OF_DIM = {2: {}, 3: {"dim": 3, "n": 1000, "end": 300}}
OF_ANGLE = {150: {"mu": 0.4, "kappa": 2.0}}             # a drop that hardly touches its wall bounces
ON_WALLS = {f"wall{dim}_{angle}_{start}_{seed}": {**OF_DIM[dim], **OF_ANGLE.get(angle, {}), "angle": angle, "start": angle + more, "seed": seed}
            for dim in (3, 2) for angle in ANGLES[dim] for start, more in STARTS.items() for seed in (SEEDS if dim == 2 else SEEDS[:1])}


class Drop:
    """Logarithm of the aspect of the axes over the time.

    A drop of radius r has omega^2 = 6 sigma/(rho r^3) without viscosity, and the decay 4 mu/(rho r^2) with a small one."""

    def __init__(self, out, name):
        step, xx, yy = np.loadtxt(out / f"{name}.probe.txt").T
        self.frames = list(frames(out / f"{name}.particles.txt").values())
        self.t, self.aspect = 0.05 * step, 0.5 * np.log(xx / yy)
        self.radius = np.sqrt(len(self.frames[0]["x"]) / np.pi)
        self.omega = np.sqrt(6 / self.radius**3)
        self.decay = 4 * MU / self.radius**2
        late = self.t > 0.3 * np.pi / self.omega      # without the sound of the beginning
        self.rate = fit(self.t[late], self.aspect[late], self.omega, self.decay)


class Merging:
    """Aspect of the axes at each time; at the end, the least and the largest width of the drop over its diameter."""

    def __init__(self, out, name):
        _, xx, yy = np.loadtxt(out / f"{name}.probe.txt").T
        self.aspect = np.sqrt(xx / yy)
        self.frames = list(frames(out / f"{name}.particles.txt").values())
        places = np.column_stack([self.frames[-1][axis] for axis in "xy"])
        angles = np.linspace(0, np.pi, 24, endpoint=False)
        widths = np.ptp(places @ np.array([np.cos(angles), np.sin(angles)]), axis=0) + 1.0
        self.widths = np.array([widths.min(), widths.max()]) / np.sqrt(4 * len(places) / np.pi)
        apart = np.sqrt(((places[:, None] - places[None])**2).sum(axis=2)) + 9 * np.eye(len(places))
        self.apart = apart.min()


def segment(angle, dim):
    """Mean height above the wall over the root of the mean squared distance from the axis, of a part of a circle or a sphere."""
    z = np.linspace(np.cos(angle), 1.0, 2001)
    width = np.sqrt(1.0 - z**2)
    weight = width**(dim - 1)
    squares = width**2 / (3 if dim == 2 else 2)
    return np.average(z - z[0], weights=weight) / np.sqrt(np.average(squares, weights=weight))


def contact_angle(out, name, dim):
    """Angle of the part of a circle or a sphere with height and width of the drop, the mean over the last half of the run."""
    _, width, height = np.loadtxt(out / f"{name}.probe.txt").T
    angles = np.radians(np.linspace(5, 178, 500))
    found = np.interp(height / width, [segment(angle, dim) for angle in angles], angles)
    return np.degrees(found[len(found) // 2:].mean())


def base(t, omega, decay):
    f = np.exp(-decay * t)
    return np.column_stack([f * np.cos(omega * t), f * np.sin(omega * t), np.ones_like(t)])


def fit(t, aspect, omega, decay):
    """Frequency and decay of A cos + B sin + C, by least squares, from these values on."""
    def misfit(omega, decay):
        shapes = base(t, omega, decay)
        return ((aspect - shapes @ np.linalg.lstsq(shapes, aspect, rcond=None)[0])**2).sum()

    width = 1.0
    while width > 1e-3:
        omega, decay = min(((omega * (1 + 0.3 * width * a), decay * (1 + width * b)) for a in np.linspace(-1, 1, 13) for b in np.linspace(-0.9, 0.9, 13)),
                           key=lambda one: misfit(*one))
        width /= 1.5
    return omega, decay


def picture_of(axis, frame, title):
    axis.plot(frame["x"], frame["y"], "o", ms=1.5)
    axis.set(aspect="equal", xlim=(-27, 27), ylim=(-27, 27), xticks=[], yticks=[], title=title)


def plot(path, drops, merging):
    plt = pyplot()
    figure = plt.figure(figsize=(9.6, 9.0))
    drop = drops["r20_1"]
    for k, part in enumerate((0, 0.25, 0.5, 0.75)):
        frame = drop.frames[round(part * EVERY / 10 * drop.omega / drop.rate[0])]
        picture_of(figure.add_subplot(3, 4, k + 1), frame, f"{part:g} periods")
    for k, time in enumerate(TIMES):
        picture_of(figure.add_subplot(3, 4, k + 9), merging.frames[round(time / 20)], f"t = {time}")
    for k, radius in enumerate(sorted(RADII)):
        axis = figure.add_subplot(3, 2, 3 + k)
        for n, seed in enumerate(SEEDS):
            drop = drops[f"r{radius}_{seed}"]
            axis.plot(drop.t, drop.aspect, "C0-", lw=1, label="particles, 3 seeds" if n == 0 else None)
        axis.plot(drop.t, drop.aspect[0] * np.exp(-drop.decay * drop.t) * np.cos(drop.omega * drop.t), "k--", lw=1.5, label="theory")
        axis.set(xlabel="time", ylabel="logarithm of the aspect", title=f"radius {drop.radius:.1f} spacings")
        axis.legend()
    save(figure, path)


def main():
    example = Example(HERE, "Drops of a liquid with a free surface oscillate, merge, and rest on walls.")
    args = example.arguments()
    jobs = QUICK if args.quick else JOBS
    both = {"merging": {"radius": 5, "end": 100} if args.quick else {}}
    on_walls = {"wall2_90_flat_1": {"n": 150, "angle": 90, "start": 60, "end": 100}} if args.quick else ON_WALLS
    example.run({**on_walls, **jobs, **both}, {"merging": HERE / "in.merging", **dict.fromkeys(on_walls, HERE / "in.wall")})
    merging = Merging(example.out, "merging")
    drops = {name: Drop(example.out, name) for name in jobs}
    print("drop     radius  frequency  over theory    decay  over that by viscosity")
    for name, drop in drops.items():
        omega, decay = drop.rate
        print(f"{name:7s}  {drop.radius:6.2f}  {omega:9.5f}  {omega / drop.omega:11.4f}  {decay:.5f}  {decay / drop.decay:22.2f}")
    print("\ntwo drops that merged\naspect of the axes  least width over the diameter  largest width  least distance of particles")
    print(f"{merging.aspect[-1]:18.4f}  {merging.widths[0]:29.4f}  {merging.widths[1]:13.4f}  {merging.apart:27.3f}")
    example.merit("two drops that merged: aspect of the axes", merging.aspect[-1], *((0.8, 1.2) if args.quick else (0.99, 1.01)))
    if args.quick:
        example.merit("angle of a wall with 90", contact_angle(example.out, *on_walls, 2), 60, 120)
        example.merit("radius 12: frequency over theory", omega / drop.omega, 0.9, 1.1)
        return example.finish()
    print("\nmean of 3 seeds\nradius  tension over that given  decay over that by viscosity")
    for radius in RADII:
        own = [drops[f"r{radius}_{seed}"] for seed in SEEDS]
        tension = np.mean([(one.rate[0]**2 + one.rate[1]**2) / one.omega**2 for one in own])
        decay = np.mean([one.rate[1] / one.decay for one in own])
        print(f"{radius:6d}  {tension:23.3f}  {decay:28.2f}")
        example.merit(f"radius {radius}: tension by the frequency over that given", tension, 0.96, 1.04)
        example.merit(f"radius {radius}: decay over that by viscosity", decay, 1.0, 2.4)
    print("\ncontact angles on walls, mean of 3 seeds in two dimensions\ndimensions  angle of the wall  of a drop that begins too flat  too round")
    for dim, bound in (2, 4), (3, 5):
        for angle in ANGLES[dim]:
            own = {start: np.mean([contact_angle(example.out, name, dim) for name in ON_WALLS if name.startswith(f"wall{dim}_{angle}_{start}")])
                   for start in STARTS}
            print(f"{dim:10d}  {angle:17d}  {own['flat']:30.1f}  {own['round']:9.1f}")
            for start, found in own.items() if angle > 40 else ():
                example.merit(f"{dim} dimensions, contact angle {angle}, from too {start}", found, angle - bound, angle + bound)
    picture = example.out / "free_drop.png"
    plot(picture, drops, merging)
    return example.finish(picture)


if __name__ == "__main__":
    sys.exit(main())
