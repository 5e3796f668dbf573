#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Coupled thermal fluctuations of transverse velocity and spin, against the same waves without noise and the two exact rates.

    ./sphd run spin_spectrum          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.integrate import quad
from scipy.linalg import expm
from scipy.optimize import least_squares
from scipy.special import j0, j1

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, pyplot, save      # noqa: E402

MU, MU_R, GAMMA1, INERTIA, SUPPORT, T, DT, EVERY, WIDTH = 2.0, 0.5, 1.0, 2.0, 5.0, 0.2, 0.025, 10, 24
STEPS, QUICK = 300000, 20000
PARTICLES = 2 * WIDTH * 7
PIECES = 8      # of the series, for its statistical error
SCALE = np.sqrt(np.array([1, 1 / INERTIA]))
NAMES = {(0, 0): "velocity", (1, 1): "spin", (1, 0): "spin after velocity"}


def moment(integrand):
    """Integral over the plane of F(r) times a function of r, wendland/c2 (theory page)."""
    return quad(lambda r: 2 * np.pi * r * 140 / np.pi / SUPPORT**4 * (1 - r / SUPPORT)**3 * integrand(r), 0, SUPPORT)[0]


def relaxation(k, particles=True):
    """d/dt of (u, Omega), amplitudes of cos and sin, in a fluid of density 1; its eigenvalues are minus the rates.

    Of particles with many neighbours: the sums over pairs as integrals with the kernel; or of the continuum, k to 0.
    """
    if particles:
        laplace = moment(lambda r: 1 - j0(k * r))                  # k^2/2 of long waves
        shear = moment(lambda r: 0.5 - j1(k * r) / (k * r))        # k^2/8
        curl = moment(lambda r: r * j1(k * r))                     # k
        mean = 0.5 * moment(lambda r: r**2 * (1 + j0(k * r)))      # 2, of the spins of both partners
    else:
        laplace, shear, curl, mean = k**2 / 2, k**2 / 8, k, 2
    a = 8 * (MU - MU_R) * shear + 4 * MU_R * laplace
    b = (2 * MU_R * mean + 2 * GAMMA1 * laplace) / INERTIA
    return np.array([[-a, 2 * MU_R * curl], [2 * MU_R * curl / INERTIA, -b]])


def series(path):
    """Amplitudes of velocity and spin, the spin a quarter of a wave ahead, where it is coupled to the velocity."""
    data = np.loadtxt(path)
    return np.array([data[:, 1] + 1j * data[:, 2], 1j * (data[:, 3] + 1j * data[:, 4])])


def correlations(waves, count):
    """<x(t) y*(0)> of velocity and spin, per particle, for the first `count` lags."""
    n = waves.shape[1]
    f = np.fft.fft(waves, 2 * n)
    product = np.fft.ifft(f[:, None] * f[None].conj()).real[..., :count]
    return product / np.arange(n, n - count, -1) / PARTICLES


def answers(out, count):
    """What becomes of a wave of velocity, and of one of spin, without noise: matrix of (u, Omega) from (u, Omega)."""
    rest = series(out / "rest.series.txt")
    change = np.array([series(out / f"{name}.series.txt") - rest for name in ("velocity", "turn")])
    columns = [wave / wave[number, 0] for number, wave in enumerate(change)]
    return np.real(columns).transpose(1, 0, 2)[..., :count]


def fitted(time, matrix, guess):
    """The relaxation matrix whose exponential is closest."""
    start = matrix[..., 0]
    def off(p):
        w, v = np.linalg.eig(p.reshape(2, 2))
        exponential = np.einsum("ij,tj,jk->ikt", v, np.exp(np.outer(time, w)), np.linalg.inv(v)).real
        return ((np.einsum("ijt,jk->ikt", exponential, start) - matrix) / np.outer(SCALE, SCALE)[..., None]).ravel()
    return least_squares(off, guess.ravel(), x_scale=np.abs(guess).max()).x.reshape(2, 2)


def rates(matrix):
    return np.sort(-np.linalg.eigvals(matrix).real)


def plot(path, time, found, answer, exact):
    plt = pyplot()
    figure, axes = plt.subplots(figsize=(5.2, 3.6))
    for (a, b), label in NAMES.items():
        norm = SCALE[a] * SCALE[b]
        line, = axes.plot(time[::3], found[a, b, ::3] / norm, ".", ms=4, label=label)
        axes.plot(time, answer[a, b] / norm, color=line.get_color(), lw=1)
        axes.plot(time, exact[a, b] / norm, color=line.get_color(), lw=0.8, ls=":")
    axes.set(xlabel="time (lj units)", ylabel="correlation over its thermal value",
             title="points: fluctuations, lines: decay without noise, dotted: exact")
    save(figure, path, legends=[axes])


def main():
    example = Example(HERE, "Fluctuations of velocity and spin.")
    args = example.arguments()
    steps = QUICK if args.quick else STEPS
    width = 4 if args.quick else 3      # a small version must not fail by chance
    k = 2 * np.pi / (WIDTH * np.sqrt(2 / np.sqrt(3)))
    matrix = relaxation(k)
    print("continuum: rates {:.5f} and {:.5f}".format(*rates(relaxation(k, particles=False))))
    step = EVERY * DT
    count = int(1.5 / rates(matrix)[0] / step)
    example.run({"spin": {"steps": steps, "mu_r": MU_R, "dt": DT, "every": EVERY, "T": T}})
    calm = {"start": "spin", "T": 0, "mu_r": MU_R, "dt": DT, "every": EVERY, "steps": EVERY * count}
    example.run({"rest": calm, "velocity": {**calm, "velocity": 1}, "turn": {**calm, "spin": 1}})

    time = step * np.arange(count)
    waves = series(example.out / "spin.series.txt")
    pieces = np.array([correlations(p, count) for p in np.array_split(waves, PIECES, axis=1)]) / T
    found = pieces.mean(axis=0)
    errors = pieces.std(axis=0) / np.sqrt(PIECES - 1) / np.outer(SCALE, SCALE)[..., None]
    thermal = np.diag(SCALE**2)
    answer = np.einsum("ijt,jk->ikt", answers(example.out, count), thermal)
    exact = np.array([expm(matrix * t) @ thermal for t in time]).transpose(1, 2, 0)
    for (a, b), name in NAMES.items():
        rms = [np.sqrt(np.mean(x**2)) for x in ((found - answer)[a, b] / SCALE[a] / SCALE[b],
                                                (found - exact)[a, b] / SCALE[a] / SCALE[b], errors[a, b])]
        print(f"{name}: rms difference from the exact correlation {rms[1]:.4f}, standard error {rms[2]:.4f}")
        example.merit(f"{name}: rms difference from the wave without noise, over the thermal value", rms[0], 0,
                      width * rms[2])

    alone = rates(fitted(time, answer, matrix))
    own = rates(fitted(time, found, matrix))
    # jackknife
    others = np.array([rates(fitted(time, (found * PIECES - p) / (PIECES - 1), matrix)) for p in pieces])
    error = np.sqrt((PIECES - 1) * np.var(others, axis=0))
    for name, r, e, d, x in zip(("slow", "fast"), own, error, alone, rates(matrix)):
        print(f"{name} rate {r:.5f} +- {e:.5f}, without noise {d:.5f}, exact {x:.5f}")
        bar = max(0.03, width * e / d)
        # a liquid of particles has a few percent less viscosity than many neighbours, more or less by sample
        example.merit(f"{name} rate without noise over the exact one", d / x, 0.92, 1.06)
        example.merit(f"{name} rate of the correlations over that without noise", r / d, 1 - bar, 1 + bar)
    table = example.out / "correlations.csv"
    np.savetxt(table, np.column_stack([time, *(x[a, b] / SCALE[a] / SCALE[b] for x in (found, answer, exact)
                                               for a, b in NAMES)]), fmt="%.5g", delimiter=",", comments="",
               header="t," + ",".join(f"{what}_{NAMES[key].replace(' ', '_')}"
                                      for what in ("noise", "without_noise", "exact") for key in NAMES))
    picture = example.out / "spin_spectrum.png"
    plot(picture, time, found, answer, exact)
    return example.finish(table, picture)


if __name__ == "__main__":
    sys.exit(main())
