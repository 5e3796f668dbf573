#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Decay rates of both modes of a transverse wave coupled to spin.

    ./sphd run shear_wave_spin          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, pyplot, save      # noqa: E402

SETS = {"a": dict(mu_r=0.5, gamma1=1, I=1), "b": dict(mu_r=1.0, gamma1=20, I=10),      # with mu = 1
        "c": dict(mu_r=2.0, gamma1=50, I=40)}                                           # mu (1 + 2/n)
CELLS = (20, 29, 39, 59)        # per wavelength
SUPPORT = 4
THEORY = 0.015                  # rate against the eigenvalue for kh <= 0.2, h = half of the support
SINGLE = 1e-4                   # deviation of the logarithm of the amplitude from a straight line


def eigenvalues(k, mu_r, gamma1, I):
    """Decay rates of (u, Omega), from the matrix of the two equations; mu = rho = 1."""
    matrix = np.array([[(1 + mu_r) * k**2, -2 * mu_r * k], [-2 * mu_r * k / I, (4 * mu_r + gamma1 * k**2) / I]])
    return dict(zip(("slow", "fast"), sorted(np.linalg.eigvals(matrix).real)))


def plot(path, found):
    plt = pyplot()
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.6))
    k = np.linspace(0.08, 0.31, 60)
    for color, (name, values) in zip(("C0", "C1", "C2"), SETS.items()):
        theory = [eigenvalues(one, **values) for one in k]
        for mode, mark in (("slow", "o"), ("fast", "s")):
            points = np.array([(wave, rate) for (s, m, _), (wave, rate, _) in found.items() if (s, m) == (name, mode)])
            label = f"$\\mu_r = {values['mu_r']:g}$, $\\gamma_1 = {values['gamma1']}$, $I = {values['I']}$" if mode == "slow" else None
            left.loglog(k, [one[mode] for one in theory], color, lw=1)
            left.loglog(*points.T, color + mark, mfc="none", ms=5, label=label)
            exact = np.array([eigenvalues(one, **values)[mode] for one in points[:, 0]])
            right.plot(points[:, 0] * SUPPORT / 2, points[:, 1] / exact, color + mark + ("-" if mode == "slow" else "--"),
                       mfc="none", ms=5)
    for mode, mark in (("slow mode", "ko-"), ("fast mode", "ks--")):
        right.plot([], [], mark, mfc="none", ms=5, label=mode)
    left.set(xlabel="wave number times spacing, $k\\,\\Delta x$", ylabel="decay rate (lj units)", title="lines: eigenvalues", ylim=(0.002, 30))
    left.legend(loc="upper left")
    right.legend(loc="lower left")
    right.axhline(1, color="k", lw=0.8)
    right.set(xlabel="wave number times smoothing length, $kh$", ylabel="rate over eigenvalue")
    save(figure, path)


def main():
    example = Example(HERE, "Transverse waves coupled to spin.")
    args = example.arguments()
    cells = CELLS[-1:] if args.quick else CELLS
    cases = [(name, mode, nx) for nx in reversed(cells) for mode in ("slow", "fast") for name in SETS]
    example.run({f"{name}.{mode}.{nx}": {"mode": mode, "nx": nx, **SETS[name]} for name, mode, nx in cases})
    found = {}
    for name, mode, nx in cases:
        prefix = example.out / f"{name}.{mode}.{nx}"
        words = Path(f"{prefix}.rate.txt").read_text().split()
        k, expected = float(words[1]), eigenvalues(float(words[1]), **SETS[name])[mode]
        time, amplitude = np.loadtxt(f"{prefix}.decay.txt")[:, 1:3].T
        time = time / float(words[3])
        line = np.polyfit(time, np.log(amplitude), 1)
        single = np.abs(np.log(amplitude) - np.polyval(line, time)).max()
        found[name, mode, nx] = k, -line[0], single
        print(f"set {name}, {mode}, kh = {k * SUPPORT / 2:.3f}: rate {-line[0]:.6f}, eigenvalue {expected:.6f}, "
              f"ratio {-line[0] / expected:.5f}, single exponential to {single:.1e}")
    print()
    for (name, mode, nx), (k, rate, single) in found.items():
        if k * SUPPORT / 2 <= 0.2:
            example.merit(f"set {name}, {mode}: rate over eigenvalue, minus 1",
                          abs(rate / eigenvalues(k, **SETS[name])[mode] - 1), 0, THEORY)
            example.merit(f"set {name}, {mode}: deviation from an exponential", single, 0, SINGLE)
    picture = example.out / "shear_wave_spin.png"
    plot(picture, found)
    return example.finish(picture)


if __name__ == "__main__":
    sys.exit(main())
