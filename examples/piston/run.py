#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""A gas and a piston of finite mass that exchange energy: their distributions in equilibrium against the exact ones.

    ./sphd run piston                 or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import csv
import sys
from pathlib import Path

import numpy as np
from scipy.stats import beta

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, pyplot, read_array, save      # noqa: E402

GAS, WEIGHT, WALL, SUPPORT = 3, 1.5, 20.0, 3.0      # as in the input: particles of gas in a cylinder, and what acts on them; k_B = 1
CLOSEST = 0.5           # to the closed end or the piston: there the energy is WALL, more than what is to be had
# name: heat capacity of a particle, gamma, mass of the piston; a particle stands for two molecules, (gamma - 1) C = 2 k_B
CASES = {"monatomic": (3, 5 / 3, 4), "light": (3, 5 / 3, 1), "diatomic": (5, 1.4, 4)}
TITLES = {"monatomic": "monatomic gas, piston of mass 4", "light": "monatomic gas, piston of mass 1", "diatomic": "diatomic gas, piston of mass 4"}
STEPS, QUICK = 200000, {"steps": 20000, "cylinders": 100}
MEANS = {"height": "height of the piston", "motion": "kinetic energy of the piston", "heat": "heat of a particle"}
START = {3: 15.0, 5: 21.0}  # energy of a cylinder by heat capacity: heat of the gas, and the weight at a height of 4
BLOCKS = 10             # of the series, for their statistical errors
WITHIN = 0.005          # of a mean
DISTANCE = 0.005        # largest difference of cumulative distributions


def repulsion(r):
    """Energy of a particle of gas at this distance from the closed end or the piston: pair style soft."""
    return np.where(r < 1, WALL * (1 + np.cos(np.pi * r)), 0)


def kernel(q):
    """wendland/c2 but for its norm"""
    return np.where(q < 1, (1 - q)**4 * (1 + 4 * q), 0)


class Exact:
    """Distributions of gas and piston with constant energy: exp(S/k) prod dx dp prod dS_i, S_i = C [ln Q_i - (gamma - 1) ln rho_i].

    Heats and momenta are integrated in closed form: with A = energy - potential energy, positions have the density
    A^(N C + (N + 1)/2 - 1) prod rho_i^(-(gamma - 1) C), here a sum over points. entropies False: prod dE_i in place of prod dS_i.
    """

    def __init__(self, energy, capacity, gamma, mass, entropies=True, nodes=9, points=160, bins=2000):
        rule, weights = np.polynomial.legendre.leggauss(nodes)
        label = np.stack(np.meshgrid(*[np.arange(3 * nodes)] * GAS, indexing="ij")).reshape(GAS, -1)
        own = capacity if entropies else capacity + 1           # of a heat: Q^(own - 1)
        power = GAS * own + 0.5 * (GAS + 1) - 1
        self.own, self.power, self.mass = own, power, mass
        self.height = 2 * CLOSEST + (np.arange(points) + 0.5) * (energy / WEIGHT - 2 * CLOSEST) / points
        density, self.free = np.zeros(points), np.zeros(bins)
        for number, x in enumerate(self.height):
            ends = [CLOSEST, min(1, x / 2), max(x - 1, x / 2), x - CLOSEST]     # between them the energy is smooth
            middle, half = 0.5 * np.add(ends[1:], ends[:-1]), 0.5 * np.diff(ends)
            r = (middle[:, None] + half[:, None] * rule).ravel()[label]
            volume = (half[:, None] * weights).ravel()[label].prod(axis=0)
            rho = sum(kernel(abs(r - r[j]) / SUPPORT) for j in range(GAS))
            left = energy - WEIGHT * x - (repulsion(r) + repulsion(x - r)).sum(axis=0)
            weight = np.where(left > 0, volume * (np.maximum(left, 0) / energy)**power * rho.prod(axis=0)**(-(gamma - 1) * capacity), 0)
            density[number] = weight.sum()
            self.free += np.bincount(np.minimum((left[left > 0] / energy * bins).astype(int), bins - 1), weight[left > 0], bins)
        self.density = density / density.sum()
        self.free /= self.free.sum()
        self.energy = (np.arange(bins) + 0.5) * energy / bins
        mean = self.free @ self.energy / (power + 1)
        self.means = {"height": self.density @ self.height, "motion": 0.5 * mean, "heat": own * mean}

    def below(self, name, value):
        """Probability that the height of the piston, its velocity, or the heat of a particle is below this."""
        if name == "height":
            width = self.height[1] - self.height[0]
            return np.interp(value, 2 * CLOSEST + np.arange(len(self.height) + 1) * width, np.concatenate([[0], np.cumsum(self.density)]))
        if name == "heat":
            return np.array([self.free @ beta.cdf(one / self.energy, self.own, self.power + 1 - self.own) for one in value])
        part = np.array([self.free @ beta.cdf(0.5 * self.mass * one**2 / self.energy, 0.5, self.power + 0.5) for one in value])
        return 0.5 + 0.5 * np.sign(value) * part


def blocks(values):
    """Mean, and its standard error from the means of blocks."""
    means = values[:len(values) // BLOCKS * BLOCKS].reshape(BLOCKS, -1, *values.shape[1:]).mean(axis=1)
    return means.mean(axis=0), means.std(axis=0, ddof=1) / np.sqrt(BLOCKS)


def histogram(path):
    """Edges of the bins, and the share of all values in each, by block."""
    found = np.array(read_array(path))
    center, count = found[0, :, 0], found[:, :, 1]
    width = center[1] - center[0]
    return np.append(center - 0.5 * width, center[-1] + 0.5 * width), count / count.sum(axis=1)[:, None]


def plot(path, found):
    plt = pyplot()
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.4))
    for axis, (name, title) in zip(axes, (("height", "height of the piston"), ("velocity", "velocity of the piston"), ("heat", "heat of a particle of gas"))):
        for color, (case, (exact, others, histograms)) in zip(("C0", "C1", "C2"), found.items()):
            edges, share = histograms[name]
            width, center = edges[1] - edges[0], 0.5 * (edges[1:] + edges[:-1])
            axis.plot(center, np.diff(exact.below(name, edges)) / width, color, lw=1.2)
            axis.plot(center, np.diff(others.below(name, edges)) / width, color, lw=0.8, ls=":")
            axis.plot(center[::2], share.mean(axis=0)[::2] * np.ptp(exact.below(name, edges[[0, -1]])) / width, color + ".", ms=4, label=TITLES[case])
        axis.set(xlabel=f"{title} (lj units)", ylim=(0, None))
    axes[0].set_ylabel("probability density")
    axes[0].set_ylim(0, 0.62)       # room for the legends
    axes[0].plot([], [], "0.3", lw=1.2, label="exact")
    axes[0].plot([], [], "0.3", lw=0.8, ls=":", label="with the measure of energies")
    axes[0].legend(handles=axes[0].lines[-2:], loc="upper left")
    axes[2].set_ylim(0, 0.53)
    axes[0].set_xlim(1, 10)
    axes[2].set_xlim(0, 9)
    axes[2].legend(loc="upper right")
    return save(figure, path)


def main():
    example = Example(HERE, "Gas and piston.")
    args = example.arguments()
    width = 4 if args.quick else 3      # a small version must not fail by chance
    cases = {"monatomic": CASES["monatomic"]} if args.quick else CASES
    size = QUICK if args.quick else {"steps": STEPS}
    example.run({name: {"capacity": capacity, "gamma": gamma, "mass": mass, **size} for name, (capacity, gamma, mass) in cases.items()})
    found, table = {}, example.out / "means.csv"
    with open(table, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["case", "of", "mean", "standard_error", "exact", "measure_of_energies"])
        for name, (capacity, gamma, mass) in cases.items():
            means, errors = blocks(np.loadtxt(example.out / f"{name}.means.txt")[:, 1:])
            energy = means[3]
            example.merit(f"{TITLES[name]}: energy of a cylinder over that at the start", energy / START[capacity], 0.997, 1.003)
            exact, others = (Exact(energy, capacity, gamma, mass, entropies) for entropies in (True, False))
            histograms = {what: histogram(example.out / f"{name}.{what}.txt") for what in ("height", "velocity", "heat")}
            found[name] = exact, others, histograms
            for number, (key, what) in enumerate(MEANS.items()):
                print(f"{TITLES[name]}, {what}: {means[number]:.4f} +- {errors[number]:.4f}, exact {exact.means[key]:.4f}; "
                      f"prod dE_i in place of prod dS_i would have {others.means[key]:.4f}")
                writer.writerow([name, key, *(f"{x:.6g}" for x in (means[number], errors[number], exact.means[key], others.means[key]))])
                bar = max(WITHIN, width * errors[number] / exact.means[key])
                example.merit(f"{TITLES[name]}: {what} over the exact mean", means[number] / exact.means[key], 1 - bar, 1 + bar)
            for what, (edges, share) in histograms.items():
                sums, error = blocks(np.cumsum(share, axis=1))
                below = exact.below(what, edges)
                off = abs(sums - (below[1:] - below[0]) / (below[-1] - below[0]))       # of what is between the edges
                bar = max(DISTANCE, width * error.max())
                example.merit(f"{TITLES[name]}: cumulative distribution of the {what}, largest difference", off.max(), 0, bar)
    return example.finish(table, plot(example.out / "piston.png", found))


if __name__ == "__main__":
    sys.exit(main())
