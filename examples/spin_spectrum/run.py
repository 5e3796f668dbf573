#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Coupled thermal fluctuations of transverse velocity and spin against the two exact rates.

    ./sphd run spin_spectrum          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.linalg import expm

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example      # noqa: E402

MU, MU_R, GAMMA1, INERTIA, T, DT, EVERY, WIDTH = 2.0, 0.5, 1.0, 2.0, 1.0, 0.0125, 10, 24
STEPS, QUICK = 300000, 30000
PARTICLES = 2 * WIDTH * 7


def relaxation(k):
    """d/dt of (u, Omega), amplitudes of sin and cos, in a fluid of density 1; its eigenvalues are minus the rates."""
    a, b = (MU + MU_R) * k**2, (4 * MU_R + GAMMA1 * k**2) / INERTIA
    return np.array([[-a, 2 * MU_R * k], [2 * MU_R * k / INERTIA, -b]])


def correlations(path, count):
    """<u(t)u>, <Omega(t)Omega>, <u(t)Omega> and <Omega(t)u> of the longest wave, per particle."""
    data = np.loadtxt(path)
    u, w = data[:, 1] + 1j * data[:, 2], data[:, 3] + 1j * data[:, 4]
    # u ~ sin where Omega ~ cos: Omega has the phase of the derivative of u
    w = 1j * w
    n = len(u)

    def correlate(x, y):
        f = np.fft.fft(x, 2 * n) * np.fft.fft(y, 2 * n).conj()
        return np.fft.ifft(f).real[:count] / np.arange(n, n - count, -1) / PARTICLES

    return np.array([[correlate(u, u), correlate(u, w)], [correlate(w, u), correlate(w, w)]]), n


def plot(path, time, found, exact):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update({"font.size": 9, "legend.fontsize": 8})
    figure, axes = plt.subplots(figsize=(5.2, 3.6), layout="constrained")
    scale = np.sqrt(np.array([T, T / INERTIA]))
    for (a, b), label in {(0, 0): "velocity", (1, 1): "spin", (1, 0): "spin after velocity"}.items():
        norm = scale[a] * scale[b]
        line, = axes.plot(time, found[a, b] / norm, ".", ms=4, label=label)
        axes.plot(time, exact[a, b] / norm, color=line.get_color(), lw=1)
    axes.set(xlabel="$t$", title="correlations of the longest transverse wave, over their thermal values")
    axes.grid(alpha=0.3)
    axes.legend()
    figure.savefig(path, dpi=90)
    plt.close(figure)


def main():
    example = Example(HERE, "Fluctuations of velocity and spin.")
    args = example.arguments()
    steps = QUICK if args.quick else STEPS
    example.run({"spin": {"steps": steps, "mu_r": MU_R, "dt": DT}})
    length = WIDTH * np.sqrt(2 / np.sqrt(3))
    matrix = relaxation(2 * np.pi / length)
    rates = np.sort(-np.linalg.eigvals(matrix).real)
    print("exact rates {:.4f} and {:.4f}".format(*rates))

    count = int(1.5 / rates[0] / (EVERY * DT))
    time = EVERY * DT * np.arange(count)
    found, number = correlations(example.out / "spin.series.txt", count)
    equal_times = np.diag([T, T / INERTIA])
    exact = np.array([expm(matrix * t) @ equal_times for t in time]).transpose(1, 2, 0)
    if np.sum(found[1, 0] * exact[1, 0]) < 0:
        found[0, 1] *= -1      # the sense of the wave
        found[1, 0] *= -1
    # standard error of a correlation from real and imaginary part of so many decay times of the slower mode
    error = np.sqrt(1 / (number * EVERY * DT * rates[0]))
    scale = np.sqrt(np.diag(equal_times))
    for (a, b), name in {(0, 0): "velocity", (1, 1): "spin", (1, 0): "spin after velocity"}.items():
        off = np.sqrt(np.mean(((found[a, b] - exact[a, b]) / scale[a] / scale[b])**2))
        example.merit(f"{name}: rms difference from the exact correlation, over the thermal value", off, 0, 3 * error)
    print(f"standard error {error:.4f}")
    picture = example.out / "spin_spectrum.png"
    plot(picture, time, found, exact)
    return example.finish(picture)


if __name__ == "__main__":
    sys.exit(main())
