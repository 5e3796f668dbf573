#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Temperatures of all degrees of freedom of a fluctuating fluid against the time step, and their distributions.

    ./sphd run thermal_equilibrium          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, pyplot, save      # noqa: E402

DTS, QUICK = (0.0035, 0.007, 0.014, 0.028), (0.007,)
RATE = 13.6            # of the fastest viscous mode, as LAMMPS prints it
SIDE, LONG = 64, 50000        # by which temperatures are known to 0.1 percent; the other time steps are for the trend
SMALL, STEPS = 32, 10000
TEMPERATURE = 0.003    # of all particles at RATE dt <= 0.1 and this size
# columns of the temperature file: x, y, z, spin of all, of light, of heavy particles; between the steps
NAMES = {1: "x", 2: "y", 4: "spin", 5: "light, x", 6: "light, y", 9: "heavy, x", 10: "heavy, y"}
ALIKE = ((1, 2), (4,), (5, 6, 9, 10))       # as many degrees of freedom, hence the same standard error


def temperatures(path):
    """Means over the run, and their standard errors from its pieces, of which there are few: columns alike share theirs."""
    data = np.loadtxt(path)
    data = data[data[:, 0] >= data[0, 0]]
    variance = data[:, 1:].var(axis=0, ddof=1) / len(data)
    for columns in ALIKE:
        same = [column - 1 for column in columns]
        variance[same] = variance[same].mean()
    return data[:, 1:].mean(axis=0), np.sqrt(variance)


def histogram(path):
    """The last histogram of fix ave/histo: centers, density, and number of samples."""
    lines = [line.split() for line in open(path) if not line.startswith("#")]
    start = max(i for i, words in enumerate(lines) if len(words) == 6)
    rows = np.array(lines[start + 1:start + 1 + int(lines[start][1])], dtype=float)
    width = rows[1, 1] - rows[0, 1]
    return rows[:, 1], rows[:, 3] / width, float(lines[start][2])


def moments(center, density):
    weight = density / density.sum()
    variance = np.sum(weight * center**2)
    return variance, np.sum(weight * center**4) / variance**2


def plot(path, runs, shapes):
    plt = pyplot()
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.4))
    rate = RATE * np.array(list(runs))
    for shift, (column, label, mark) in enumerate(((0, "x", "o"), (1, "y", "s"), (3, "spin", "^"), (12, "between the steps", "kx"))):
        values = np.array([run[0][column] for run in runs.values()])
        errors = np.array([run[1][column] for run in runs.values()])
        left.errorbar(rate * 1.05 ** (shift - 1.5), values, errors, fmt=mark, ms=4, mfc="none", label=label)
    left.axhline(1, color="k", lw=0.8)
    left.set(xlabel="largest viscous rate times time step", ylabel="temperature $T/T_0$", xscale="log")
    left.set_xticks(rate, [f"{one:.2g}" for one in rate])
    left.set_xticks([], minor=True)
    x = np.linspace(-5, 5, 200)
    right.semilogy(x, np.exp(-0.5 * x**2) / np.sqrt(2 * np.pi), "k", lw=0.8)
    for (name, (center, density, _)), mark in zip(shapes.items(), "os"):
        right.semilogy(center, np.clip(density, 1e-7, None), mark, ms=3, mfc="none", label=name)
    right.set(xlabel="velocity $v\\sqrt{m/k_BT}$, spin $\\Omega\\sqrt{J/k_BT}$", ylabel="distribution", ylim=(1e-6, 1))
    save(figure, path, legends=(left, right))


def main():
    example = Example(HERE, "A fluctuating fluid in equilibrium.")
    args = example.arguments()
    dts = QUICK if args.quick else DTS
    side = {dt: 24 if args.quick else SIDE if dt in QUICK else SMALL for dt in dts}
    steps = {dt: 4000 if args.quick else LONG if dt in QUICK else STEPS for dt in dts}
    example.run({f"dt{dt}": {"dt": dt, "n": side[dt], "steps": steps[dt]} for dt in sorted(dts, key=lambda dt: -side[dt])})
    runs = {dt: temperatures(example.out / f"dt{dt}.temperature.txt") for dt in dts}
    for dt, (mean, error) in runs.items():
        print(f"dt = {dt}: largest viscous rate times dt {RATE * dt:.3f}, between the steps {mean[12]:.4f} +- {error[12]:.4f}")
        for column, name in NAMES.items():
            print(f"  {name}: {mean[column - 1]:.4f} +- {error[column - 1]:.4f}")
            if RATE * dt > 0.1:
                continue
            whole = column <= 4 and side[dt] == SIDE
            example.merit(f"  {name}: temperature minus 1", abs(mean[column - 1] - 1), 0,
                          TEMPERATURE if whole else 4 * error[column - 1] + TEMPERATURE)
    middle = dts[min(1, len(dts) - 1)]
    shapes = {what: histogram(example.out / f"dt{middle}.{what}.txt") for what in ("velocity", "spin")}
    for what, (center, density, count) in shapes.items():
        variance, kurtosis = moments(center, density)
        example.merit(f"{what}: kurtosis minus 3", abs(kurtosis - 3), 0, 0.05 if not args.quick else 0.15)
        print(f"{what}: variance {variance:.4f}, kurtosis {kurtosis:.4f} of {count:.0f} samples")
    picture = example.out / "thermal_equilibrium.png"
    plot(picture, runs, shapes)
    return example.finish(picture)


if __name__ == "__main__":
    sys.exit(main())
