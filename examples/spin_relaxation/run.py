#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Relaxation of a uniform spin in a fluid at rest, for several support radii.

    ./sphd run spin_relaxation          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, pyplot, save      # noqa: E402

SUPPORTS = (3, 4, 6)
LATTICE = 1e-4      # rate against the lattice sum; the time step is 1 % of the relaxation time
THEORY = 0.01       # rate against 4 mu_r/(rho I), support 4 dx and more
ENERGY = 1e-4       # change of the total energy over the energy of the spin; second order in the time step


def lattice_factor(dim, rc):
    """The rate over 4 mu_r/(rho I): sum of F r^2 over the number density times the dimension, 1 for an integral."""
    if dim == 2:
        a = np.sqrt(2 / np.sqrt(3))
        cell, basis = a * np.array([1, np.sqrt(3)]), np.array([[0, 0], [0.5, 0.5]])
    else:
        cell, basis = 2 ** (1 / 3) * np.ones(3), np.array([[0, 0, 0], [0.5, 0.5, 0.5]])
    grid = np.stack(np.meshgrid(*dim * [np.arange(-8, 9)], indexing="ij"), -1).reshape(-1, 1, dim)
    r = np.linalg.norm(((grid + basis) * cell).reshape(-1, dim), axis=1)
    p, norm = np.clip(1 - r / rc, 0, None), {2: 7 / np.pi, 3: 21 / (2 * np.pi)}[dim] / rc**dim
    volume = 1 / np.sum(norm * p**4 * (5 - 4 * p))
    return volume**2 * np.sum(20 * norm / rc**2 * p**3 * r**2) / dim


def plot(path, runs):
    plt = pyplot()
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.4))
    for index, ((dim, support), data) in enumerate(runs.items()):
        time, spin = data[:, 1], data[:, 2]
        label = f"{dim}d, rc = {support} dx"
        color, mark = f"C{index % 3}", "os"[dim - 2]
        left.semilogy(time, spin, color + mark, ms=4, mfc="none", markevery=(index, 6), label=label)
        right.plot(time[1:], -np.log(spin[1:]) / time[1:], color + "-" * (dim - 1), label=label)
    left.semilogy(time, np.exp(-time), "k", lw=0.8, label="$\\exp(-4\\mu_rt/(\\rho I))$")
    right.axhline(1, color="k", lw=0.8)
    left.set(xlabel="time $4\\mu_rt/(\\rho I)$", ylabel="spin $\\Omega(t)/\\Omega(0)$")
    right.set(xlabel="time $4\\mu_rt/(\\rho I)$", ylabel="rate over $4\\mu_r/(\\rho I)$")
    right.set_ylim(0.979, 1.001)      # room for the legend
    left.legend()
    right.legend(ncols=2, loc="lower center")
    save(figure, path)


def main():
    example = Example(HERE, "Relaxation of a uniform spin.")
    args = example.arguments()
    cases = [(dim, support) for dim in (2, 3) for support in ((4,) if args.quick else SUPPORTS)]
    example.run({f"{dim}d.{support}": {"dim": dim, "support": support} for dim, support in reversed(cases)})
    runs = {case: np.loadtxt(example.out / "{}d.{}.decay.txt".format(*case)) for case in cases}
    for (dim, support), data in runs.items():
        rate, lattice = -np.polyfit(data[:, 1], np.log(data[:, 2]), 1)[0], lattice_factor(dim, support)
        name = f"{dim}d, rc = {support} dx: "
        print(f"{name}rate over 4 mu_r/(rho I): {rate:.5f}, lattice sum {lattice:.5f}")
        example.merit(name + "rate over the lattice sum, minus 1", abs(rate / lattice - 1), 0, LATTICE)
        if support >= 4:
            example.merit(name + "rate over 4 mu_r/(rho I), minus 1", abs(rate - 1), 0, THEORY)
        example.merit(name + "change of the total energy over the energy of the spin",
                      np.abs(data[:, 3] - data[0, 3]).max() / data[0, 4], 0, ENERGY)
    picture = example.out / "spin_relaxation.png"
    plot(picture, runs)
    return example.finish(picture)


if __name__ == "__main__":
    sys.exit(main())
