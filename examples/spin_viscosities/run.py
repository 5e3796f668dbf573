#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Viscosities of a fluid whose particles spin: mu + mu_r, mu and lambda + 2 mu by the decay of waves.

    ./sphd run spin_viscosities          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import curve_fit

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, pyplot, save      # noqa: E402

LENGTHS = (12, 16, 20, 28)              # wavelengths over h
QUICK = (16, 20, 28)
SUPPORT = 4
H = SUPPORT / 2
KAPPA = 3                               # with mu = rho = dx = 1
MU_R = {2: (0.5, 2.0), 3: (0.5, 5 / 3)}     # the second is the largest that is admitted, mu (1 + 2/n)
GAMMA2 = {2: -1.0, 3: 0.5}              # gamma1 = 1
INERTIA = 1.0
DAMPING = 0.25                          # damping ratio of the sound waves: c0 is chosen for that
SAMPLES = 60
MERIT = 0.01                            # viscosity for kh -> 0 over what was asked for, minus 1
WAVES = {"held": r"\mu + \mu_r", "free": r"\mu", "sound": r"\lambda + 2\mu"}


def requested(dim, mu_r, wave):
    return {"held": 1 + mu_r, "free": 1.0, "sound": KAPPA + 2 * (1 - 1 / dim)}[wave]


class Wave:
    def __init__(self, dim, mu_r, wave, length):
        self.dim, self.wave = dim, wave
        spacing = np.sqrt(2 / np.sqrt(3)) if dim == 2 else 2 ** (1 / 3)
        self.cells = round(length * H / spacing)
        k = 2 * np.pi / (self.cells * spacing)
        self.asked = requested(dim, mu_r, wave)
        rate = self.asked * k**2
        c0 = rate / (2 * DAMPING * k) if wave == "sound" else 10 * k
        inertia = INERTIA if wave != "held" else 1e6
        # what the style recommends, times a third, and for sound 400 steps per period
        step = 0.33 / (0.5 * c0 / H + (20 * (1 + mu_r) + 1.4 * KAPPA) / H**2 + (4 * mu_r + 8 / H**2) / inertia)
        # spin that does not follow the vorticity yet is gone after ten of its relaxation times
        self.skip = 10 * inertia / (4 * mu_r) if wave == "free" else 0.0
        total = self.skip + 0.4 / rate
        if wave == "sound":
            total = 0.375 / DAMPING * 2 * np.pi / (c0 * k)
            step = min(step, total / 600)
        every = int(np.ceil(total / step / SAMPLES))
        self.guess = rate, c0 * k
        self.name = f"{dim}d.mu_r{mu_r:.3g}.{wave}.{self.cells}"
        self.variables = {"dim": dim, "cells": self.cells, "wave": wave, "mu_r": repr(mu_r), "kappa": KAPPA, "gamma1": 1.0,
                          "gamma2": GAMMA2[dim], "I": INERTIA, "support": SUPPORT, "c0": repr(float(c0)),
                          "dt": repr(float(total / (SAMPLES * every))), "steps": SAMPLES * every, "every": every}

    def measure(self, out):
        _, t, a, density, k = np.loadtxt(out / f"{self.name}.txt").T
        if self.wave == "sound":
            def oscillator(t, g, w, c, s):
                return np.exp(-g * self.guess[0] * t / 2) * (c * np.cos(w * self.guess[1] * t) + s * np.sin(w * self.guess[1] * t))
            rate = curve_fit(oscillator, t, a, [1.0, 0.97, 1.0, 0.0], ftol=1e-12, xtol=1e-12)[0][0] * self.guess[0]
        else:
            use = t >= self.skip
            rate = -np.polyfit(t[use], np.log(a[use]), 1)[0]
        self.q = (k[0] * H) ** 2
        self.ratio = rate * density[0] / k[0] ** 2 / self.asked


def extrapolate(group):
    """kh -> 0: the polynomial in (kh)^2 through all wavelengths, and its distance from that without the shortest."""
    q, y = np.array([(w.q, w.ratio) for w in sorted(group, key=lambda w: w.q)]).T
    fit = np.polyfit(q, y, len(q) - 1)
    return fit, abs(fit[-1] - np.polyfit(q[:-1], y[:-1], len(q) - 2)[-1])


def plot(path, groups):
    plt = pyplot()
    figure, both = plt.subplots(1, 2, figsize=(8.6, 3.6), sharey=True)
    for axes, dim in zip(both, MU_R):
        axes.axhspan(1 - MERIT, 1 + MERIT, color="0.92", zorder=0, label=f"within {100 * MERIT:g} %")
        axes.axhline(1, color="k", lw=0.8)
        for (d, mu_r, wave), group in groups.items():
            if d == dim:
                color, first = f"C{list(WAVES).index(wave)}", mu_r == MU_R[dim][0]
                x = np.linspace(0, max(w.q for w in group), 50)
                axes.plot(x, np.polyval(extrapolate(group)[0], x), color + ("-" if first else "--"), lw=1)
                axes.plot([w.q for w in group], [w.ratio for w in group], color + ("o" if first else "s"), mfc="none", ms=5,
                          label=f"${WAVES[wave]}$, $\\mu_r = {mu_r:.3g}\\mu$")
        axes.set(xlabel="(wave number times smoothing length)$^2$, $(kh)^2$", title={2: "2d, hexagonal", 3: "3d, bcc"}[dim])
        axes.legend(loc="lower left")
    both[0].set_ylabel("viscosity, measured over given")
    save(figure, path)


def main():
    example = Example(HERE, "Viscosities of a fluid whose particles spin.")
    args = example.arguments()
    groups = {(dim, mu_r, wave): [Wave(dim, mu_r, wave, length) for length in (QUICK if args.quick else LENGTHS)]
              for dim in (3, 2) for mu_r in MU_R[dim] for wave in WAVES}
    example.run({w.name: w.variables for group in groups.values() for w in reversed(group)})
    table = example.out / "spin_viscosities.csv"
    with csv_rows(table, ["dim", "mu_r", "wave", "asked", "kh", "ratio"]) as writerow:
        for (dim, mu_r, wave), group in groups.items():
            for w in group:
                w.measure(example.out)
                writerow([dim, f"{mu_r:.4f}", wave, f"{w.asked:.4f}", f"{w.q ** 0.5:.4f}", f"{w.ratio:.6f}"])
            fit, error = extrapolate(group)
            writerow([dim, f"{mu_r:.4f}", wave, f"{group[0].asked:.4f}", 0, f"{fit[-1]:.6f}"])
            name = {"held": "mu + mu_r", "free": "mu", "sound": "lambda + 2 mu"}[wave]
            print(f"{dim}d, mu_r = {mu_r:.3g}: {name} over {group[0].asked:.4g} is {fit[-1]:.5f} +- {error:.5f}")
            example.merit(f"{dim}d, mu_r = {mu_r:.3g}: {name} over what was asked for, minus 1", abs(fit[-1] - 1), 0, MERIT)
    picture = example.out / "spin_viscosities.png"
    plot(picture, groups)
    return example.finish(picture, table)


if __name__ == "__main__":
    sys.exit(main())
