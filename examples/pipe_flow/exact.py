#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Decay of an accelerating and decelerating flow through a pipe that is open at both ends, |x| < x0, 0 < y < L.

    u = U cosh(bx)/cosh(b x0) sin(ky) exp(-beta t),  v = 0,  rho = rho0/cosh(bx)
    k = pi/L,  b = k/sqrt((sigma+2)(sigma+3)),  sigma = lambda/mu,  beta = nu k^2 (sigma+2)/(sigma+3),  nu = mu/rho0

J. Bonet Avalos, M. Antuono, A. Colagrossi, A. Souto-Iglesias, Phys. Rev. E 101, 013302 (2020), section V.B. It solves the
equations of a fluid of constant mu and lambda and of pressure c0^2 (rho - rho0) + pb with the body force per mass

    f_x = b [U^2/2 sinh(2bx)/cosh(b x0)^2 sin(ky)^2 exp(-2 beta t) - c0^2 tanh(bx)] + beta u (cosh(bx) - 1)
    f_y = -nu (sigma+1) cosh(bx) u_xy

The first part of f_x is that of the paper, which has no f_y. python3 exact.py checks the solution.
"""

import sys

import numpy as np


class Pipe:
    def __init__(self, sigma, U=1.0, L=1.0, rho0=1.0, nu=0.02, c0=2.0, x0=1.0):
        self.sigma, self.U, self.L, self.rho0, self.nu, self.c0, self.x0 = sigma, U, L, rho0, nu, c0, x0
        self.k = np.pi / L
        self.b = self.k / np.sqrt((sigma + 2) * (sigma + 3))
        self.beta = nu * self.k**2 * (sigma + 2) / (sigma + 3)

    def u(self, x, y, t=0.0):
        return self.U * np.cosh(self.b * x) / np.cosh(self.b * self.x0) * np.sin(self.k * y) * np.exp(-self.beta * t)

    def rho(self, x):
        return self.rho0 / np.cosh(self.b * x)

    def force(self, x, y, t=0.0):
        b, k = self.b, self.k
        mixed = b * k * np.tanh(b * x) * self.u(x, self.L / 2, t) * np.cos(k * y)     # u_xy
        return (b * np.tanh(b * x) * (self.u(x, y, t)**2 - self.c0**2) + self.beta * self.u(x, y, t) * (np.cosh(b * x) - 1),
                -self.nu * (self.sigma + 1) * np.cosh(b * x) * mixed)

    # of the velocity at the centre, of the kinetic energy and of the flux of mass through a cross section

    def center(self, t):
        return self.u(0.0, self.L / 2, t)

    def kinetic(self, t):
        b, x0 = self.b, self.x0
        return self.rho0 * self.U**2 * self.L * np.sinh(b * x0) / (2 * b * np.cosh(b * x0)**2) * np.exp(-2 * self.beta * t)

    def flux(self, t):
        return 2 * self.L * self.rho0 * self.U / (np.pi * np.cosh(self.b * self.x0)) * np.exp(-self.beta * t)

    def passed(self, t):
        """The mass that has gone through a cross section."""
        return (self.flux(0.0) - self.flux(t)) / self.beta

    def mass(self):
        return 4 * self.rho0 * self.L / self.b * np.arctan(np.tanh(self.b * self.x0 / 2))


def residuals(pipe, step=1e-3):
    """Largest residuals of the equations of mass and of momentum along x and y, over the viscous force along x."""
    x, y = np.meshgrid(np.linspace(-0.95, 0.95, 21) * pipe.x0, np.linspace(0.05, 0.95, 21) * pipe.L)
    t, d = 0.3, step
    mu, lam = pipe.nu * pipe.rho0, pipe.sigma * pipe.nu * pipe.rho0

    def first(g, a):
        return (8 * (g(a + d) - g(a - d)) - (g(a + 2 * d) - g(a - 2 * d))) / (12 * d)

    def second(g, a):
        return (16 * (g(a + d) + g(a - d)) - (g(a + 2 * d) + g(a - 2 * d)) - 30 * g(a)) / (12 * d * d)

    u_x, u_t = first(lambda a: pipe.u(a, y, t), x), first(lambda a: pipe.u(x, y, a), t)
    u_xx, u_yy = second(lambda a: pipe.u(a, y, t), x), second(lambda a: pipe.u(x, a, t), y)
    u_xy = first(lambda a: first(lambda c: pipe.u(a, c, t), y), x)
    rho, u, force = pipe.rho(x), pipe.u(x, y, t), pipe.force(x, y, t)
    pressure = pipe.c0**2 * first(pipe.rho, x)
    mass = first(lambda a: pipe.rho(a) * pipe.u(a, y, t), x)
    along = rho * (u_t + u * u_x) + pressure - (lam + 2 * mu) * u_xx - mu * u_yy - rho * force[0]
    across = -(lam + mu) * u_xy - rho * force[1]
    scale = mu * np.abs(u_yy).max()
    return max(np.abs(residual).max() / scale for residual in (mass, along, across))


def totals(pipe, n=400):
    """Largest relative differences of the integrals from sums over n x n points."""
    x = (np.arange(n) + 0.5) / n * 2 * pipe.x0 - pipe.x0
    y = (np.arange(n) + 0.5) / n * pipe.L
    area = 2 * pipe.x0 * pipe.L / n**2
    grid = np.meshgrid(x, y)
    found = (area * np.sum(pipe.rho(grid[0])), area * np.sum(pipe.rho(grid[0]) * pipe.u(*grid, 0.7)**2) / 2,
             pipe.rho(pipe.x0) * np.sum(pipe.u(pipe.x0, y, 0.7)) * pipe.L / n)
    return max(abs(a / b - 1) for a, b in zip(found, (pipe.mass(), pipe.kinetic(0.7), pipe.flux(0.7))))


def main():
    worst = 0
    for sigma in (-1, 0, 1, 10):
        pipe = Pipe(sigma)
        errors = residuals(pipe), totals(pipe)
        print(f"sigma {sigma}: residual {errors[0]:.1e}, integrals {errors[1]:.1e}; b {pipe.b:.6f}, beta {pipe.beta:.6f},"
              f" mass {pipe.mass():.6f}, kinetic energy {pipe.kinetic(0):.6f}, flux {pipe.flux(0):.6f}")
        worst = max(worst, errors[0] / 1e-6, errors[1] / 1e-4)
    print("well" if worst < 1 else "WRONG")
    return 0 if worst < 1 else 1


if __name__ == "__main__":
    sys.exit(main())
