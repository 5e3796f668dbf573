#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Reference of the moving square: finite volumes, on a grid whose lines follow the square.

    python3 reference.py            three grids and two time steps, and their limit, written to reference.csv (some minutes)
    python3 reference.py --quick    a coarse grid; exits with 1 if it is not near reference.csv

The upper half of the box, with symmetry at y = 2.5.  Velocities are at the faces of the cells, pressure in the cells.  The faces
of the square are lines of the grid, so that no-slip is exact.  Cells are small at them, and smallest at the corners.  Columns
above the square move with it; those behind and in front of it are stretched.

Differences are central in space, and backward of second order in time, implicit in x and y in turn with the convecting velocity
extrapolated.  The projection is exact: each column is the sum of its modes in y, and the columns behind, above and in front of
the square are connected by those two next to it.

The stress at a corner is infinite, but not its integral.  Drag by pressure is that on the front and rear faces, drag by viscous
stress that on top and bottom; the normal viscous stress is 0 at a wall without slip.  The sum is that of the balance of momentum,
which converges regularly, as the size of cells to the power 1.089: twice that of the velocity at a corner.  It differs little
from the sum of stresses.
"""

import argparse
import sys
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.linalg import cho_factor, cho_solve, eigh
from scipy.linalg.lapack import dgtsv
from scipy.optimize import brentq
from scipy.special import erf

PARTS = "pressure", "viscous", "balance"
TABLE = Path(__file__).resolve().parent / "reference.csv"
LENGTH, HALF, NU = 10.0, 2.5, 0.01
TIMES = np.arange(0.018, 7.97, 0.03)
GRIDS, STEP = (1, 1.5, 2), 0.0025
QUICK = 0.012, 0.02
T0, WIDTH = 0.2 * np.sqrt(np.log(1000)), 0.2        # time of the largest acceleration, and its width
EARLY, LATER = 1.5, 2                               # until when steps are short, and by how much they are longer then
NEAR = 0.6                                          # width of the fine grid around the square
SINGULAR, CORNER = 0.4555, 3                        # stress at a corner is r^-0.4555; in so many cells it is not taken from the grid


def speed(t):
    return (erf((t - T0) / WIDTH) + erf(T0 / WIDTH)) / 2


def rear(t):
    """Position of the rear face: integral of the speed."""
    z, z0 = (t - T0) / WIDTH, T0 / WIDTH
    return 1 + (WIDTH * (z * erf(z) + np.exp(-z * z) / np.sqrt(np.pi) - z0 * erf(z0) - np.exp(-z0 * z0) / np.sqrt(np.pi)) + t * erf(z0)) / 2


def spread(width, cells, first):
    """Distances from a face of the square: the first cell is so small, the others grow."""
    b = brentq(lambda b: b / np.sinh(b) * width - first * cells, 1e-3, 20)
    return width * np.sinh(b * np.linspace(0, 1, cells + 1)) / np.sinh(b)


def integral(stress, size):
    """Over cells from a corner on: in the first ones the stress is a r^-0.4555 + b, as farther away."""
    r = np.cumsum(size) - size / 2
    one, two = CORNER, 2 * CORNER
    a = (stress[one] - stress[two]) / (r[one]**-SINGULAR - r[two]**-SINGULAR)
    b, end = stress[one] - a * r[one]**-SINGULAR, r[one] - size[one] / 2
    return stress[one:] @ size[one:] + a * end**(1 - SINGULAR) / (1 - SINGULAR) + b * end


def lines(lower, diagonal, upper, rhs):
    """Solve a tridiagonal system of each line of cells; a third index of rhs counts right sides."""
    lower, upper = lower.copy(), upper.copy()
    lower[:, 0] = upper[:, -1] = 0
    return dgtsv(lower.ravel()[1:], diagonal.ravel(), upper.ravel()[:-1], rhs.reshape(diagonal.size, -1))[3].reshape(rhs.shape)


class Flow:
    def __init__(self, n, step):
        """n: refinement of the grid; step: in time, at the start"""
        first, half, long, above = 0.002 / n, round(30 * n), round(80 * n), round(60 * n)
        edge = spread(0.5, half, first)
        self.near, self.far = spread(NEAR, long, first), np.linspace(0, 1, long + 1)**3
        self.over = np.concatenate([edge, 1 - edge[-2::-1]])
        top = spread(NEAR, above, first) + (HALF - 0.5 - NEAR) * np.linspace(0, 1, above + 1)**3
        self.y = np.concatenate([0.5 - edge[:0:-1], 0.5 + top])
        self.i, self.k, self.j = long, long + 2 * half, half         # cells of the square: i to k, 0 to j
        self.hy = np.diff(self.y)
        self.gy = np.concatenate([[self.hy[0]], (self.hy[1:] + self.hy[:-1]) / 2, [self.hy[-1] / 2]])
        columns, rows = self.k + long, len(self.hy)
        self.u, self.v, self.p = np.zeros((columns + 1, rows)), np.zeros((columns, rows + 1)), np.zeros((columns, rows))
        self.wet = np.ones_like(self.p)
        self.wet[self.i:self.k, :self.j] = 0
        self.body = np.s_[self.i:self.k + 1, :self.j]
        self.moves, self.rises = np.ones_like(self.u, bool), np.ones_like(self.v, bool)     # unknowns
        self.moves[self.body] = self.moves[[0, -1]] = False
        self.rises[self.i:self.k, :self.j + 1] = self.rises[:, [0, -1]] = False
        self.u0, self.v0 = self.u, self.v
        self.step, self.last, self.t, self.out = step, np.inf, 0.0, []
        self.full, self.part = self.modes(self.hy), self.modes(self.hy[self.j:])
        cut = np.zeros((rows, rows - self.j))
        cut[self.j:] = np.diag(self.hy[self.j:])
        self.cross = self.full[1].T @ cut @ self.part[1]
        self.link = self.cross @ self.cross.T

    def x(self, t):
        r = rear(t)
        behind = r - self.near - (r - NEAR) * self.far
        front = r + 1 + self.near + (LENGTH - r - 1 - NEAR) * self.far
        return np.concatenate([behind[::-1], r + self.over[1:-1], front])

    @staticmethod
    def modes(h):
        """Eigenvalues and modes of -d2/dy2 on cells of the size h between walls."""
        c = 2 / (h[1:] + h[:-1])
        matrix = np.diag(np.append(c, 0) + np.append(0, c)) - np.diag(c, 1) - np.diag(c, -1)
        return eigh(matrix, np.diag(h))

    def advance(self):
        dt, nu, hy, gy, i, j, k = self.step, NU, self.hy, self.gy, self.i, self.j, self.k
        r = dt / self.last                                                              # 0 in the first step, which is Euler's
        e, tau = r * r / (1 + 2 * r), dt * (1 + r) / (1 + 2 * r)
        before, old, x = (self.x(max(0.0, t)) for t in (self.t - self.last, self.t, self.t + dt))
        self.t, self.last = self.t + dt, dt
        w = (x - old - e * (old - before)) / tau
        dx = np.diff(x)
        gx = np.concatenate([[dx[0] / 2], (dx[1:] + dx[:-1]) / 2, [dx[-1] / 2]])
        u, v = self.u + r * (self.u - self.u0), self.v + r * (self.v - self.v0)         # convecting
        uc = (u[1:] + u[:-1]) / 2 - ((w[1:] + w[:-1]) / 2)[:, None]
        vc = (v[:, 1:] + v[:, :-1]) / 2
        uf = np.zeros((len(dx) + 1, len(hy) + 1))                                        # at the corners of cells, relative to the grid
        uf[:, 1:-1] = (u[:, :-1] * hy[:-1] + u[:, 1:] * hy[1:]) / (2 * gy[1:-1]) - w[:, None]
        vf = np.zeros_like(uf)
        vf[1:-1] = (v[:-1] * dx[:-1, None] + v[1:] * dx[1:, None]) / (2 * gx[1:-1, None])
        # coefficients of the neighbours of u
        west, east, south, north = (np.zeros_like(u) for _ in range(4))
        west[1:-1] = (nu / dx[:-1, None] + uc[:-1] / 2) / gx[1:-1, None]
        east[1:-1] = (nu / dx[1:, None] - uc[1:] / 2) / gx[1:-1, None]
        south[:, 1:] = (nu / gy[1:-1] + vf[:, 1:-1] / 2) / hy[1:]
        north[:] = (nu / gy[1:] - vf[:, 1:] / 2) / hy
        south[i + 1:k, j] = 2 * nu / hy[j]**2
        rhs = e * (self.u - self.u0)
        rhs[1:-1] -= tau * np.diff(self.p, axis=0) / gx[1:-1, None]
        du = self.change(tau, self.u, rhs, (west, east, south, north), self.moves, speed(self.t))
        # and of v
        west, east, south, north = (np.zeros_like(v) for _ in range(4))
        west[:, 1:-1] = (nu / gx[:-1, None] + uf[:-1, 1:-1] / 2) / dx[:, None]
        east[:, 1:-1] = (nu / gx[1:, None] - uf[1:, 1:-1] / 2) / dx[:, None]
        east[i - 1, 1:j] = nu * 2 / dx[i - 1]**2
        west[k, 1:j] = nu * 2 / dx[k]**2
        south[:, 1:-1] = (nu / hy[:-1] + vc[:, :-1] / 2) / gy[1:-1]
        north[:, 1:-1] = (nu / hy[1:] - vc[:, 1:] / 2) / gy[1:-1]
        rhs = e * (self.v - self.v0)
        rhs[:, 1:-1] -= tau * np.diff(self.p, axis=1) / gy[1:-1]
        dv = self.change(tau, self.v, rhs, (west, east, south, north), self.rises)
        self.u0, self.v0 = self.u, self.v
        self.u, self.v = self.u + du, self.v + dv
        smooth = self.u[:, self.j:self.j + 2].copy()                                    # projection leaves a slip at walls
        # projection
        source = self.wet * (np.diff(self.u, axis=0) * hy + np.diff(self.v, axis=1) * dx[:, None])
        phi = self.poisson(gx, dx, -source / tau)
        self.u[1:-1] -= tau * self.moves[1:-1] * np.diff(phi, axis=0) / gx[1:-1, None]
        self.v[:, 1:-1] -= tau * self.rises[:, 1:-1] * np.diff(phi, axis=1) / gy[1:-1]
        self.p += phi - nu * source / (hy * dx[:, None])
        self.measure(dx, smooth)

    def change(self, tau, f, rhs, coefficients, free, wall=None):
        """Change of a velocity in a step before the projection; rhs: by the step before and by pressure; wall: of the square"""
        west, east, south, north = (one * free * tau for one in coefficients)
        rhs[1:] += west[1:] * (f[:-1] - f[1:])
        rhs[:-1] += east[:-1] * (f[1:] - f[:-1])
        rhs[0] -= west[0] * f[0]
        rhs[-1] -= east[-1] * f[-1]
        rhs[:, 1:] += south[:, 1:] * (f[:, :-1] - f[:, 1:])
        rhs[:, :-1] += north[:, :-1] * (f[:, 1:] - f[:, :-1])
        rhs[:, -1] -= north[:, -1] * f[:, -1]
        rhs *= free
        if wall is not None:
            rhs[self.body] = wall - f[self.body]
        rhs = lines(-west.T, 1 + (west + east).T, -east.T, np.ascontiguousarray(rhs.T)).T
        return lines(-south, 1 + south + north, -north, np.ascontiguousarray(rhs))

    def poisson(self, gx, wide, source):
        """Modes q of each column; columns i-1 and k, next to the square, connect the three parts."""
        i, j, k = self.i, self.j, self.k
        c = 1 / gx
        c[0] = c[-1] = 0
        parts = []
        for begin, end, bottom, (value, mode) in ((0, i - 1, 0, self.full), (i, k, j, self.part), (k + 1, len(wide), 0, self.full)):
            rhs = np.zeros((len(value), end - begin, 3))
            rhs[..., 0] = (source[begin:end, bottom:] @ mode).T
            rhs[:, 0, 1] = rhs[:, -1, 2] = 1                                             # for the columns next to it
            lower, upper = (np.broadcast_to(-c[at:at + end - begin], rhs.shape[:2]) for at in (begin, begin + 1))
            parts.append(lines(lower, value[:, None] * wide[begin:end] - lower - upper, upper, rhs))
        a, b, d = parts
        (value, mode), rows, x = self.full, len(self.hy), self.cross
        east, west = c[i], c[k]
        matrix = np.empty((2 * rows, 2 * rows))
        matrix[:rows, :rows] = np.diag(c[i - 1] - c[i - 1]**2 * a[:, -1, 2] + value * wide[i - 1])
        matrix[rows:, rows:] = np.diag(c[k + 1] - c[k + 1]**2 * d[:, 0, 1] + value * wide[k])
        matrix[:rows, :rows] += east * self.link - east**2 * (x * b[:, 0, 1]) @ x.T
        matrix[rows:, rows:] += west * self.link - west**2 * (x * b[:, -1, 2]) @ x.T
        matrix[:rows, rows:] = -east * west * (x * b[:, 0, 2]) @ x.T
        matrix[rows:, :rows] = matrix[:rows, rows:].T
        matrix[0, 0] += 1                                                                # pressure has no level
        rhs = np.concatenate([source[i - 1] @ mode + c[i - 1] * a[:, -1, 0] + east * x @ b[:, 0, 0],
                              source[k] @ mode + c[k + 1] * d[:, 0, 0] + west * x @ b[:, -1, 0]])
        one, two = np.split(cho_solve(cho_factor(matrix), rhs), 2)
        phi = np.zeros_like(source)
        phi[i - 1], phi[k] = mode @ one, mode @ two
        phi[:i - 1] = (mode @ (a[..., 0] + c[i - 1] * a[..., 2] * one[:, None])).T
        phi[k + 1:] = (mode @ (d[..., 0] + c[k + 1] * d[..., 1] * two[:, None])).T
        phi[i:k, j:] = (self.part[1] @ (b[..., 0] + east * b[..., 1] * (x.T @ one)[:, None] + west * b[..., 2] * (x.T @ two)[:, None])).T
        return phi

    def measure(self, dx, smooth):
        """Drag by pressure and by viscous stress; momentum of the fluid, and force of the box on it."""
        i, j, k, hy = self.i, self.j, self.k, self.hy

        def wall(one, two):
            """pressure at the face of two columns"""
            return self.p[one] + (self.p[one] - self.p[two]) * dx[one] / (dx[one] + dx[two])

        def shear(u, h, over):
            """at a wall, of the velocities in two rows over its own"""
            near, far = h[0] / 2, h[0] + h[1] / 2
            return NU * ((u[:, 0] - over) * far / near - (u[:, 1] - over) * near / far) / (far - near)

        pressure = integral((wall(k, k + 1) - wall(i - 1, i - 2))[j - 1::-1], hy[j - 1::-1])
        top, middle = -shear(smooth, hy[j:], speed(self.t)), (i + k) // 2
        top = (top[1:] + top[:-1]) / 2
        viscous = integral(top[i:middle], dx[i:middle]) + integral(top[k - 1:middle - 1:-1], dx[k - 1:middle - 1:-1])
        momentum = ((self.u[1:] + self.u[:-1]) / 2 * self.wet * hy * dx[:, None]).sum()
        lid = shear(self.u[:, :-3:-1], hy[::-1], 0.0)
        box = hy @ (wall(0, 1) - wall(-1, -2)) - (lid[1:] + lid[:-1]) / 2 @ dx
        self.out.append((self.t, 4 * pressure, 4 * viscous, 4 * momentum, 4 * box))

    def run(self):
        """Drag at TIMES: by pressure, by viscous stress, and all of it from the balance of momentum."""
        start = self.step
        while self.t < TIMES[-1]:
            self.step = start if self.t < EARLY - start / 2 else LATER * start
            self.advance()
        t, pressure, viscous, momentum, box = np.concatenate([np.zeros((1, 5)), self.out]).T
        return np.array([CubicSpline(t, one)(TIMES) for one in (pressure, viscous, CubicSpline(t, momentum)(t, 1) - box)])


def norm(difference, drag):
    """Relative L2 difference"""
    return np.sqrt(np.mean(difference**2, axis=-1) / np.mean(drag**2, axis=-1))


def extrapolate(drags, orders):
    """Limit of the finest grids, with errors of these powers of the size of cells"""
    grids = GRIDS[-len(orders) - 1:]
    return np.linalg.inv([[1, *(n**-order for order in orders)] for n in grids])[0] @ drags[-len(grids):]


def show(text, values):
    print(text, ", ".join(f"{name} {value:.4f}" for name, value in zip(PARTS, values)))


def main():
    parser = argparse.ArgumentParser(description="Reference of the moving square.")
    parser.add_argument("--quick", action="store_true", help="a coarse grid, compared with reference.csv")
    if parser.parse_args().quick:
        result = Flow(GRIDS[0], 3 * STEP).run()[:2]
        table = np.loadtxt(TABLE, delimiter=",", skiprows=1).T[1:]
        differences = norm(result - table, table)
        for name, difference, limit in zip(PARTS, differences, QUICK):
            print(f"{name}: relative L2 difference {difference:.4f}, limit {limit}")
        return 0 if (differences < QUICK).all() else 1
    drags = []
    for n in GRIDS:
        drags.append(Flow(n, STEP).run())
        print(f"grid {n}: done", flush=True)
    in_time = (drags[0] - Flow(GRIDS[0], 2 * STEP).run()) / 3
    limit = in_time + [extrapolate([drag[part] for drag in drags], orders) for part, orders in enumerate(((2,), (2,), (2 * (1 - SINGULAR), 2)))]
    for n, drag in zip(GRIDS, drags):
        show(f"grid {n}, relative L2 differences to the limit:", norm(drag - limit, limit))
    show("correction of the time step:", norm(in_time, limit))
    pressure, viscous, total = limit
    print(f"pressure and viscous stress, relative L2 difference to the balance of momentum: {norm(pressure + viscous - total, total):.4f}")
    with open(TABLE, "w", encoding="utf-8") as file:
        file.write("time,pressure,viscous\n")
        for row in zip(TIMES, total - viscous, viscous):
            file.write("{:.3f},{:.4f},{:.4f}\n".format(*row))
    return 0


if __name__ == "__main__":
    sys.exit(main())
