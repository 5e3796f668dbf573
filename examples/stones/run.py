#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Ten stones fall into a tank of water and pile up: the force on the tank against the weight, and the gaps between the stones.

    ./sphd run stones          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, frames, pyplot, save      # noqa: E402

JOBS = {"stones": {"n": 20}, "sticky": {"n": 20, "e": 0.1, "mu": 1.0}}
QUICK = {"stones": {"n": 20, "end": 5.0}}
EVERY = 0.5                 # time between two frames
AREA = 2.0                  # of the water; the tank is 2 wide
REST = 4.0                  # last time units, of the mean force
TIMES = 0.0, 1.0, 2.0, 16.0


class Run:
    def __init__(self, out, name, n, **_):
        self.dx = 1.0 / n
        self.step, self.force = np.loadtxt(out / f"{name}.force.txt").T
        self.frames = list(frames(out / f"{name}.particles.txt").values())
        count = {kind: np.sum(self.frames[0]["type"] == kind) for kind in (1, 2, 3)}
        self.weight = (count[1] + count[2] + 2.5 * count[3]) * self.dx**2
        self.closest = [self.distances(frame) for frame in self.frames]

    def distances(self, frame):
        """Least distance of particles of two stones, and of a stone and the tank, in spacings."""
        place, stone, kind = np.column_stack([frame["x"], frame["y"]]), frame["mol"], frame["type"]
        one, two = np.inf, np.inf
        tank = cKDTree(place[kind == 2])
        for k in range(1, 11):
            own = place[stone == k]
            others = place[(kind == 3) & (stone != k)]
            one = min(one, cKDTree(others).query(own)[0].min())
            two = min(two, tank.query(own)[0].min())
        return one / self.dx, two / self.dx

    def speed(self):
        """Root mean square of the velocities of the stones between the last two frames."""
        before, after = self.frames[-2:]
        stones = after["type"] == 3
        return np.sqrt(np.mean((after["x"] - before["x"])[stones]**2 + (after["y"] - before["y"])[stones]**2)) / EVERY


def plot(path, run):
    plt = pyplot()
    figure, axes = plt.subplots(1, len(TIMES), figsize=(10.0, 3.6))
    for axis, time in zip(axes, TIMES):
        frame = run.frames[round(time / EVERY)]
        for kind, color in ((1, "C0"), (2, "0.6")):
            own = frame["type"] == kind
            axis.scatter(frame["x"][own], frame["y"][own], s=3, c=color, lw=0, rasterized=True)
        own = frame["type"] == 3
        axis.scatter(frame["x"][own], frame["y"][own], s=3, c=frame["mol"][own], cmap="autumn", lw=0, rasterized=True)
        axis.set(aspect="equal", xlim=(-0.2, 2.2), ylim=(-0.2, 2.8), xticks=[], yticks=[], title=f"t = {time:g}")
    save(figure, path)


def main():
    example = Example(HERE, "Ten stones fall into a tank of water.")
    args = example.arguments()
    jobs = QUICK if args.quick else JOBS
    example.run(jobs)
    runs = {name: Run(example.out, name, **variables) for name, variables in jobs.items()}
    print("run       force on the tank over the weight   speed of the stones   least distance in spacings: two stones   stone and tank")
    for name, run in runs.items():
        mean = -run.force[-round(REST / 0.1):].mean() / run.weight
        one, two = np.min(run.closest, axis=0)
        print(f"{name:8s}  {mean:33.4f}   {run.speed():19.4f}   {one:38.3f}   {two:14.3f}")
        example.merit(f"{name}: least distance of particles of two stones, in spacings", one, 0.9, 1.1)
        example.merit(f"{name}: least distance of stones and tank, in spacings", two, 0.9, 1.1)
        if not args.quick:
            example.merit(f"{name}: mean force on the tank over the weight", mean, 0.99, 1.01)
    if args.quick:
        return example.finish()
    picture = example.out / "stones.png"
    plot(picture, runs["stones"])
    return example.finish(picture)


if __name__ == "__main__":
    sys.exit(main())
