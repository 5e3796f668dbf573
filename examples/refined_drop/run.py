#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""A rotating drop, half of which splits and merges again and again: angular momentum and the account of the energy.

    ./sphd run refined_drop          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, frames, pyplot, save      # noqa: E402

STYLES = ("bulk", "micropolar")
CONSERVED = 1e-12        # angular momentum
LEDGER = 1e-12           # kinetic plus internal energy of all events, over the sum of their kinetic parts
KINETIC = 0.1            # kinetic energy at the end over that at the start, minus 1: nothing brakes the drop, nothing stirs it


class Run:
    def __init__(self, out, name):
        data = np.loadtxt(out / f"{name}.balance.txt")
        self.step, self.L, self.kinetic = data[:, :3].T
        self.ledger = data[:, 3:].T
        self.frames = frames(out / f"{name}.particles.txt")
        self.change = np.abs(self.L / self.L[0] - 1)


def plot(path, runs):
    plt = pyplot()
    figure, (picture, left, right) = plt.subplots(1, 3, figsize=(9.6, 3.4))
    frame = max(runs["bulk"].frames.values(), key=lambda frame: len(frame["x"]))
    dots = picture.scatter(frame["x"], frame["y"], s=14 * frame["mass"], c=frame["mass"], lw=0)
    figure.colorbar(dots, ax=picture, label="mass of the particle (lj units)", shrink=0.8)
    picture.set(aspect="equal", xlabel="x (lj units)", ylabel="y (lj units)", title="fine on the right, coarse on the left")
    for (name, run), color in zip(runs.items(), ("C0", "C1")):
        left.semilogy(run.step[1:], np.maximum(run.change[1:], 1e-17), color=color, lw=0.7, label=f"sph/{name}")
        right.plot(run.step, run.kinetic / run.kinetic[0] - 1, color=color, label=f"kinetic, sph/{name}")
        right.plot(run.step, run.ledger[11] / run.kinetic[0], color=color, ls="--", label="elastic, by events")
    left.set(ylabel="change of the angular momentum, relative", xlabel="time step", ylim=(1e-17, 1e-10))
    right.set(ylabel="change of energy over initial kinetic energy", xlabel="time step", ylim=(-0.05, 0.3))
    save(figure, path, legends=(left, right))


def main():
    example = Example(HERE, "A rotating drop, half of which splits and merges again and again.")
    args = example.arguments()
    steps = 2000 if args.quick else 10000
    example.run({style: {"style": style, "steps": steps} for style in STYLES})
    runs = {style: Run(example.out, style) for style in STYLES}
    for style, run in runs.items():
        splits, merges = run.ledger[:2, -1]
        kinetic, elastic, internal, heat, rotation, coldest = run.ledger[10:16, -1]
        print(f"sph/{style}: {splits:.0f} splits, {merges:.0f} merges; energy by events: kinetic {kinetic:.4g}, "
              f"elastic {elastic:.4g}, heat of merges {heat:.4g}, rotation of neighbors {rotation:.4g}")
        example.merit(f"sph/{style}: splits", splits, steps / 20, 1e9)
        example.merit(f"sph/{style}: largest |L - L(0)|/L(0)", run.change.max(), 0.0, CONSERVED)
        example.merit(f"sph/{style}: kinetic plus internal energy of all events, relative",
                      abs(kinetic + internal) / (heat + abs(kinetic)), 0.0, LEDGER)
        example.merit(f"sph/{style}: smallest heat of a merge", coldest, 0.0, heat)
        example.merit(f"sph/{style}: kinetic energy at the end over that at the start", run.kinetic[-1] / run.kinetic[0],
                      1 - KINETIC, 1 + KINETIC)
    picture = example.out / "refined_drop.png"
    plot(picture, runs)
    return example.finish(picture)


if __name__ == "__main__":
    sys.exit(main())
