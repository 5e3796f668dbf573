#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Steady flow in a plane channel |y| <= 1, driven by a force of 1 per volume, of fluids whose viscosity depends on the rate of shear.

The stress is y, the rate of shear g(y) solves mu(g) g = |y|, and u = int_|y|^1 g.  python3 exact.py compares with closed forms.
"""

import sys

import numpy as np


def power(K, n, least=0.0, most=np.inf):
    return lambda g: np.clip(K * g**(n - 1), least, most)


def carreau(mu, time, n, a, mu_inf):
    return lambda g: mu_inf + (mu - mu_inf) * (1 + (time * g)**a)**((n - 1) / a)


def papanastasiou(mu, tau_y, m):
    return lambda g: mu - tau_y * np.expm1(-m * g) / g


def rate(mu, stress):
    """By bisection in the logarithm: mu(g) g grows with g."""
    low, high = np.full_like(stress, -40.0), np.full_like(stress, 20.0)
    for _ in range(100):
        middle = 0.5 * (low + high)
        g = np.exp(middle)
        below = mu(g) * g < stress
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return np.exp(0.5 * (low + high))


class Channel:
    def __init__(self, mu, cells=20000):
        edges = np.linspace(0, 1, cells + 1)
        g = rate(mu, 0.5 * (edges[1:] + edges[:-1]))
        self.y = edges
        self.of_y = np.concatenate([np.cumsum(g[::-1])[::-1], [0.0]]) / cells
        self.mean = 0.5 * (self.of_y[1:] + self.of_y[:-1]).mean()

    def u(self, y):
        return np.interp(np.abs(y), self.y, self.of_y)


def main():
    worst = 0.0
    for n in (0.5, 0.7, 1.5):
        found, largest = Channel(power(0.5, n)), n / (n + 1) * 2**(1 / n)
        worst = max(worst, abs(found.u(0) / largest - 1), abs(found.mean / (largest * (n + 1) / (2 * n + 1)) - 1))
    bingham = Channel(papanastasiou(0.1, 0.3, 1e7))
    worst = max(worst, abs(bingham.u(0) / 2.45 - 1), abs(bingham.mean / 1.8783333 - 1))
    print(f"closed forms within {worst:.1e}")
    return 0 if worst < 1e-5 else 1


if __name__ == "__main__":
    sys.exit(main())
