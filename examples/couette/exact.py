#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Start-up of Couette flow from rest: between plates, and between cylinders. python3 exact.py checks the series."""

import sys

import numpy as np
from scipy.optimize import brentq
from scipy.special import erfc, jv, yv


class Plane:
    """0 <= y <= gap; the plate at y = gap moves with U from t = 0 on, the other one is at rest."""

    def __init__(self, U=1.0, gap=1.0, nu=1.0, terms=200):
        self.U, self.gap, self.nu = U, gap, nu
        self.q = np.arange(1, terms + 1) * np.pi / gap
        self.weight = 2 * U / (gap * self.q) * (-1.0) ** np.arange(1, terms + 1)

    def u(self, y, t):
        y = np.asarray(y, dtype=float)
        return self.U * y / self.gap + np.sin(np.multiply.outer(y, self.q)) @ (self.weight * np.exp(-self.nu * self.q**2 * t))

    def gradient(self, y, t):
        y = np.asarray(y, dtype=float)
        return self.U / self.gap + np.cos(np.multiply.outer(y, self.q)) @ (self.q * self.weight * np.exp(-self.nu * self.q**2 * t))


class Circular:
    """R1 <= r <= R2; the inner cylinder turns with omega from t = 0 on, the outer one is at rest.

    Steady: u = A r + B/r. The rest is a series of Z(r) = J1(qr) Y1(q R1) - Y1(qr) J1(q R1) with Z(R2) = 0.
    """

    def __init__(self, omega=1.0, R1=1.0, R2=2.0, nu=1.0, terms=100):
        self.R1, self.R2, self.nu = R1, R2, nu
        self.B = omega * R1**2 * R2**2 / (R2**2 - R1**2)
        self.A = -self.B / R2**2

        def end(q):
            return jv(1, q * R2) * yv(1, q * R1) - yv(1, q * R2) * jv(1, q * R1)

        # the roots are near multiples of pi/gap, above them for R1 > 0
        grid = np.arange(1, 8 * terms + 16) * np.pi / (R2 - R1) / 8
        value = end(grid)
        change = np.nonzero(value[1:] * value[:-1] < 0)[0][:terms]
        self.q = np.array([brentq(end, grid[i], grid[i + 1], xtol=1e-14) for i in change])
        # the coefficients: integrals of r Z (A r + B/r) over those of r Z^2, both by the Wronskian of J1 and Y1
        j1, j2 = jv(1, self.q * R1), jv(1, self.q * R2)
        self.weight = np.pi * omega * R1 * j2**2 / (j1**2 - j2**2)

    def _basis(self, r, order):
        qr = np.multiply.outer(np.asarray(r, dtype=float), self.q)
        return jv(order, qr) * yv(1, self.q * self.R1) - yv(order, qr) * jv(1, self.q * self.R1)

    def steady(self, r):
        return self.A * r + self.B / r

    def u(self, r, t):
        return self.steady(r) + self._basis(r, 1) @ (self.weight * np.exp(-self.nu * self.q**2 * t))

    def torque(self, r, t, mu):
        """Of the fluid outside r on that inside, per length: 2 pi r^2 mu r d(u/r)/dr; r d(J1(qr)/r)/dr = -q J2(qr)."""
        series = -self._basis(r, 2) @ (self.q * self.weight * np.exp(-self.nu * self.q**2 * t))
        return 2 * np.pi * mu * (-2 * self.B + np.asarray(r) ** 2 * series)


def radial(omega, R1, R2, nu, t, cells, steps):
    """u at the nodes by finite differences of du/dt = nu (u'' + u'/r - u/r^2), Crank-Nicolson after two Euler steps."""
    from scipy.linalg import solve_banded
    r = np.linspace(R1, R2, cells + 1)
    d, dt = r[1] - r[0], t / steps
    inner = r[1:-1]
    low, high, mid = 1 / d**2 - 0.5 / (d * inner), 1 / d**2 + 0.5 / (d * inner), -2 / d**2 - 1 / inner**2
    u = np.zeros_like(r)
    u[0] = omega * R1
    for step in range(steps + 2):
        theta, tau = (1.0, dt / 2) if step < 4 else (0.5, dt)
        change = low * u[:-2] + mid * u[1:-1] + high * u[2:]
        right = u[1:-1] + (1 - theta) * nu * tau * change
        right[0] += theta * nu * tau * low[0] * u[0]
        band = np.zeros((3, cells - 1))
        band[0, 1:], band[1], band[2, :-1] = -theta * nu * tau * high[:-1], 1 - theta * nu * tau * mid, -theta * nu * tau * low[1:]
        u[1:-1] = solve_banded((1, 1), band, right)
    return r, u


def main():
    worst = 0.0

    def report(what, error, limit):
        nonlocal worst
        print(f"{what}: {error:.1e}")
        worst = max(worst, error / limit)

    plane = Plane(U=1.5, gap=0.7, nu=0.3)
    y = np.linspace(0, 0.7, 71)
    t = 0.01 * 0.7**2 / 0.3
    # soon after the start the other plate is not felt
    report("plane, early, against Stokes's erfc", np.abs(plane.u(y, t) - 1.5 * erfc((0.7 - y) / np.sqrt(4 * 0.3 * t))).max(), 1e-10)
    t, d = 0.1 * 0.7**2 / 0.3, 1e-3
    rate = (plane.u(y, t + 1e-4) - plane.u(y, t - 1e-4)) / 2e-4
    report("plane, du/dt - nu u''", np.abs(rate - 0.3 * (plane.gradient(y + d, t) - plane.gradient(y - d, t)) / (2 * d)).max(), 1e-4)
    report("plane, late, against U y/gap", np.abs(plane.u(y, 20.0) - 1.5 * y / 0.7).max(), 1e-10)

    R1, R2, nu, omega = 0.8, 1.7, 0.6, 1.3
    flow = Circular(omega, R1, R2, nu)
    for t in (0.02, 0.2):
        errors = []
        for cells in (200, 400):
            r, u = radial(omega, R1, R2, nu, t, cells, 2 * cells)
            errors.append(np.abs(u - flow.u(r, t)).max())
        report(f"circular, t = {t}, against finite differences", errors[1], 1e-4)
        report("   over that of half as many cells", errors[1] / errors[0], 0.3)
    report("circular, late, against A r + B/r", np.abs(flow.u(r, 10.0) - flow.steady(r)).max(), 1e-10)
    report("circular, walls", max(abs(flow.u(R1, 0.1) - omega * R1), abs(flow.u(R2, 0.1))), 1e-12)
    r, d = np.linspace(R1, R2, 11)[1:-1], 1e-4
    slope = (flow.u(r + d, 0.1) / (r + d) - flow.u(r - d, 0.1) / (r - d)) / (2 * d)
    report("circular, torque", np.abs(flow.torque(r, 0.1, 2.0) - 2 * np.pi * 2.0 * r**3 * slope).max(), 1e-5)
    report("circular, steady torque over 4 pi mu omega R1^2 R2^2/(R2^2 - R1^2), plus 1",
           abs(flow.torque(R2, 10.0, 2.0) / (4 * np.pi * 2.0 * omega * R1**2 * R2**2 / (R2**2 - R1**2)) + 1), 1e-10)
    print("well" if worst < 1 else "WRONG")
    return 0 if worst < 1 else 1


if __name__ == "__main__":
    sys.exit(main())
