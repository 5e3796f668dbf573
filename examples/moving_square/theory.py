#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Drag of the square at the start, before vortices form: added mass of the potential flow, and friction of the boundary layer.

    python3 theory.py          added mass and velocity along the sides; exits with 1 if they are not those below
"""

import sys

import numpy as np
from scipy.sparse import coo_matrix, diags
from scipy.sparse.linalg import splu

ADDED, ALONG = 1.328, 0.77                          # added mass; mean velocity of the fluid along the sides, against that of the square
T0, WIDTH = 0.2 * np.sqrt(np.log(1000)), 0.2        # time of the largest acceleration, and its width


def acceleration(t):
    return np.exp(-((t - T0) / WIDTH)**2) / (WIDTH * np.sqrt(np.pi))


def friction(t, nu=0.01, acceleration=acceleration):
    """Stress at a plate that accelerates likewise in a fluid at rest (Stokes): rho (nu/pi)^(1/2) int a(s) (t - s)^(-1/2) ds."""
    root = np.linspace(0, np.sqrt(t), 2001)
    values = 2 * acceleration(t - root**2)
    return np.sqrt(nu / np.pi) * root[1] * (values.sum() - (values[0] + values[-1]) / 2)


def potential(n):
    """Added mass of the square, and by how much the mean velocity of the fluid along its sides is opposite to its own: finite
    volumes of the size 1/n in the upper half of the box."""
    h, first = 1 / n, n
    wet = np.ones((10 * n, 5 * n // 2), bool)
    wet[first:first + n, :n // 2] = False
    number, count = np.cumsum(wet).reshape(wet.shape) - 1, wet.sum()
    rows, columns = [], []
    for one, other in ((np.s_[1:], np.s_[:-1]), (np.s_[:, 1:], np.s_[:, :-1])):
        both = wet[one] & wet[other]
        rows += [number[one][both], number[other][both]]
        columns += [number[other][both], number[one][both]]
    rows, columns = np.concatenate(rows), np.concatenate(columns)
    links = coo_matrix((np.ones(len(rows)), (rows, columns)), shape=(count, count)).tocsc()
    laplace = links - diags(np.asarray(links.sum(axis=1)).ravel()) - 1e-9 * diags(np.arange(count) == 0, dtype=float)
    flow = np.zeros(count)
    front, rear = number[first + n, :n // 2], number[first - 1, :n // 2]
    flow[front], flow[rear] = h, -h
    phi = splu(laplace.tocsc()).solve(flow)
    side = phi[number[first:first + n, n // 2]]
    return -2 * h * ((phi[front] - h / 2).sum() - (phi[rear] + h / 2).sum()), side[0] - side[-1]


def limit(values, n, powers):
    """for n to infinity, with errors of these powers of 1/n"""
    return np.linalg.solve(np.array([[1.0] + [one**-power for power in powers] for one in n]), values)[0]


def main():
    n = 20, 40, 80
    masses, slips = zip(*map(potential, n))
    for one, mass, slip in zip(n, masses, slips):
        print(f"n = {one}: added mass {mass:.4f}, velocity along the sides {slip:.4f}")
    mass, slip = limit(masses, n, (4 / 3, 2)), limit(slips, n, (2 / 3, 4 / 3))      # the corners have r^(2/3)
    print(f"limits: added mass {mass:.3f}, velocity along the sides {slip:.2f}")
    uniform = friction(0.5, acceleration=np.ones_like)
    print(f"friction at uniform acceleration over exact: {uniform / (2 * np.sqrt(0.01 * 0.5 / np.pi)):.6f}")
    return 0 if round(mass, 3) == ADDED and round(slip, 2) == ALONG and abs(uniform / (2 * np.sqrt(0.005 / np.pi)) - 1) < 1e-6 else 1


if __name__ == "__main__":
    sys.exit(main())
