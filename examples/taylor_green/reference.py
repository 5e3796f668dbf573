#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Taylor-Green vortex of an incompressible fluid by a pseudo-spectral method: the reference of run.py.

    python3 reference.py [--n 48] [--re 100 200] [--check]

Fourier modes, dealiased by the 2/3 rule, the nonlinear term in rotational form, fourth-order Runge-Kutta with the viscous
term integrated exactly. Writes reference.csv; --check computes Re = 100 on a coarse grid and compares with that file.
"""

import argparse
import csv
import sys
from pathlib import Path

import numpy as np
from scipy.fft import irfftn, rfftn

HERE = Path(__file__).resolve().parent
AXES = (1, 2, 3)


class Flow:
    def __init__(self, n, re):
        self.n, self.nu = n, 1 / re
        side = np.fft.fftfreq(n, 1 / n)
        self.k = np.stack(np.meshgrid(side, side, np.arange(n // 2 + 1), indexing="ij"))
        self.k2 = (self.k**2).sum(axis=0)
        self.keep = (np.abs(self.k) < n / 3).all(axis=0)
        self.half = np.where((self.k[2] == 0) | (self.k[2] == n / 2), 1, 2)      # modes that stand for two
        x, y, z = np.meshgrid(*[2 * np.pi / n * np.arange(n)] * 3, indexing="ij")
        self.u = rfftn(np.stack([np.sin(x) * np.cos(y) * np.cos(z), -np.cos(x) * np.sin(y) * np.cos(z), 0 * x]), axes=AXES)

    def rate(self, u):
        """u x omega without its gradient part."""
        omega = 1j * np.cross(self.k, u, axis=0)
        field = np.cross(irfftn(u, axes=AXES, s=[self.n] * 3), irfftn(omega, axes=AXES, s=[self.n] * 3), axis=0)
        hat = rfftn(field, axes=AXES) * self.keep
        return hat - self.k * (self.k * hat).sum(axis=0) / np.where(self.k2 > 0, self.k2, 1)

    def step(self, dt):
        half = np.exp(-0.5 * self.nu * self.k2 * dt)
        a = self.rate(self.u)
        b = self.rate(half * (self.u + 0.5 * dt * a))
        c = self.rate(half * self.u + 0.5 * dt * b)
        d = self.rate(half**2 * self.u + dt * half * c)
        self.u = half**2 * self.u + dt / 6 * (half**2 * a + 2 * half * (b + c) + d)

    def energies(self):
        """Kinetic energy and dissipation, per volume."""
        power = 0.5 * self.half * (np.abs(self.u)**2).sum(axis=0) / self.n**6
        return power.sum(), 2 * self.nu * (self.k2 * power).sum()

    def vorticity(self):
        """Its size at the points 2 pi/n (i, j, k)."""
        omega = irfftn(1j * np.cross(self.k, self.u, axis=0), axes=AXES, s=[self.n] * 3)
        return np.sqrt((omega**2).sum(axis=0))


def solve(n, re, times):
    flow, rows, steps = Flow(n, re), [], 2
    for i, t in enumerate(times):
        if i:
            for _ in range(steps):
                flow.step((t - times[i - 1]) / steps)
        rows.append((t, *flow.energies()))
    return np.array(rows)


def load(re):
    """t, energy, dissipation of reference.csv."""
    with open(HERE / "reference.csv") as file:
        rows = [row for row in csv.DictReader(file) if float(row["re"]) == re]
    return np.array([[float(row[name]) for name in ("t", "energy", "dissipation")] for row in rows]).T


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--n", type=int, default=48)
    parser.add_argument("--re", type=float, nargs="+", default=[100, 200])
    parser.add_argument("--check", action="store_true")
    args = parser.parse_args()
    times = np.round(np.arange(0, 10.01, 0.1), 10)
    if args.check:
        t, energy, dissipation = load(100)
        found = solve(32, 100, times[:61])
        worst = max(abs(found[:, 1] / energy[:61] - 1).max(), abs(found[:, 2] / dissipation[:61] - 1).max())
        print(f"32 against the grid of reference.csv, t <= 6: {worst:.1e}")
        return 0 if worst < 5e-3 and abs(energy[0] - 0.125) < 1e-9 and abs(dissipation[0] - 0.0075) < 1e-9 else 1
    with open(HERE / "reference.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["re", "t", "energy", "dissipation"])
        for re in args.re:
            for t, energy, dissipation in solve(args.n, re, times):
                writer.writerow([re, t, f"{energy:.7g}", f"{dissipation:.7g}"])
    return 0


if __name__ == "__main__":
    sys.exit(main())
