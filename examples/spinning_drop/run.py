#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Orbital and spin angular momentum of an isolated drop whose core starts spinning.

    ./sphd run spinning_drop          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, frames, pyplot, save      # noqa: E402

CASES = (0.1, 0.01)      # vortex viscosity
INERTIA = 0.02           # as in the input
CONSERVED = 1e-12        # |L - L(0)|/L(0)
RIGID = 0.02             # spin part over what rigid rotation with this L has, minus 1


def plot(path, runs):
    plt = pyplot()
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.4))
    for color, (mu_r, (data, _)) in zip(("C0", "C3"), runs.items()):
        time, total, orbital, spin = data[1:, 1:].T
        left.semilogx(time, orbital / total, color, label=f"orbital, $\\mu_r = {mu_r}$")
        left.semilogx(time, spin / total, color + "--", label=f"spin, $\\mu_r = {mu_r}$")
        right.loglog(time, np.maximum(np.abs(total / data[0, 2] - 1), 1e-16), color, lw=0.7, label=f"$\\mu_r = {mu_r}$")
    left.axhline(1, color="k", lw=1, label="sum")
    left.set(xlabel="time (lj units)", ylabel="part of the angular momentum")
    right.set(xlabel="time (lj units)", ylabel="change of the angular momentum, relative", ylim=(5e-17, 1e-11))
    for axes in (left, right):
        axes.legend(loc="best")
    save(figure, path)


def main():
    example = Example(HERE, "Angular momentum of an isolated drop of spinning particles.")
    args = example.arguments()
    steps = 2000 if args.quick else 10000
    example.run({f"mu_r.{mu_r}": {"mu_r": mu_r, "steps": steps} for mu_r in CASES})
    runs = {mu_r: (np.loadtxt(example.out / f"mu_r.{mu_r}.balance.txt"),
                   frames(example.out / f"mu_r.{mu_r}.particles.txt")[steps]) for mu_r in CASES}
    for mu_r, (data, frame) in runs.items():
        name = f"mu_r = {mu_r}: "
        total, orbital, spin = data[:, 2:].T
        example.merit(name + "largest |L - L(0)|/L(0)", np.abs(total / total[0] - 1).max(), 0, CONSERVED)
        example.merit(name + "orbital part at the start", abs(orbital[0] / total[0]), 0, CONSERVED)
        moment = frame["mass"] @ (frame["x"] ** 2 + frame["y"] ** 2)
        rigid = INERTIA * frame["mass"].sum() / (moment + INERTIA * frame["mass"].sum())
        print(f"{name}spin part at the end {spin[-1] / total[-1]:.5f}, of rigid rotation {rigid:.5f}")
        if mu_r == max(CASES):
            example.merit(name + "spin part over that of rigid rotation, minus 1", abs(spin[-1] / total[-1] / rigid - 1),
                          0, RIGID)
    picture = example.out / "spinning_drop.png"
    plot(picture, runs)
    return example.finish(picture)


if __name__ == "__main__":
    sys.exit(main())
