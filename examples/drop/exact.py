#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Small oscillations of a round drop of one viscous fluid in another, in two dimensions, by linear theory.

As H. Lamb, Hydrodynamics, 6th ed., art. 355, has it for a sphere without a fluid outside of it: with the stream function

    psi = [A r^n + B I_n(a r)] sin(n phi) e^(s t) inside,  [C r^-n + D K_n(b r)] sin(n phi) e^(s t) outside,  a^2 = s rho/mu,

velocities and tangential stress are the same on both sides at r = R, and the normal stress differs by the tension times the
change of the curvature, sigma (n^2 - 1) zeta/R^2.  Four equations, whose determinant is 0 at the rate s.
"""

import numpy as np


def bessel_i(n, z):
    """I_n(z) e^-z, from its integral"""
    t = np.linspace(0.0, np.pi, 2001)
    f = np.exp(z * (np.cos(t) - 1.0)) * np.cos(n * t)
    return (f.sum() - 0.5 * (f[0] + f[-1])) * (t[1] - t[0]) / np.pi


def bessel_k(n, z):
    """K_n(z) e^z, from its integral"""
    t = np.linspace(0.0, 12.0, 12001)
    f = np.exp(np.maximum(-z.real * (np.cosh(t) - 1.0), -700.0) - 1j * z.imag * (np.cosh(t) - 1.0)) * np.cosh(n * t)
    return (f.sum() - 0.5 * f[0]) * (t[1] - t[0])


class Drop:
    """inside and outside: (density, viscosity)"""

    def __init__(self, sigma, inside, outside, radius=1.0, n=2):
        self.sigma, self.inside, self.outside, self.radius, self.n = sigma, inside, outside, radius, n

    def inviscid(self):
        n = self.n
        return np.sqrt(n * (n * n - 1) * self.sigma / ((self.inside[0] + self.outside[0]) * self.radius**3))

    def conditions(self, s):
        """The matrix of A, B, C, D, each of its functions 1 at r = R."""
        n, radius, sign = self.n, self.radius, -1
        columns = []
        for (rho, mu), power in ((self.inside, n), (self.outside, -n)):
            k = np.sqrt(s * rho / mu + 0j)
            z = k * radius
            values = [bessel_i(n + i, z) if power > 0 else (-1)**i * bessel_k(n + i, z) for i in (0, 1)]
            slope = n / radius + k * values[1] / values[0]    # of I_n or K_n, over the value
            sign = -sign
            for f, df, ddf, p in (
                    (1.0, power / radius, power * (power - 1) / radius**2, -rho * s * np.sign(power)),
                    (1.0, slope, k * k + (n / radius)**2 - slope / radius, 0.0)):
                # u_r = n f/r cos, u_phi = -f' sin; the pressure p cos is that of the potential part
                along = ddf - df / radius + n * n * f / radius**2
                normal = -p + 2 * mu * n * (df / radius - f / radius**2)
                columns.append(sign * np.array([n * f / radius, df, mu * along, normal]))
        matrix = np.array(columns).T
        # zeta = u_r/s, of the inside
        for j in (0, 1):
            matrix[3, j] += self.sigma * (n * n - 1) / radius**2 * matrix[0, j] / s
        return matrix

    def determinant(self, s):
        return np.linalg.det(self.conditions(s))

    def rate(self):
        """s, from the inviscid frequency by secants"""
        a = 1j * self.inviscid()
        b = a * (0.97 + 0.05j)
        fa, fb = self.determinant(a), self.determinant(b)
        for _ in range(60):
            a, b, fa = b, b - fb * (b - a) / (fb - fa), fb
            fb = self.determinant(b)
            if abs(b - a) < 1e-12 * abs(b):
                break
        return b


def main():
    """Limits that are known in closed form."""
    mu = 1e-4
    for n in 2, 3, 4:
        alone = Drop(1.0, (1.0, mu), (1e-8, 1e-8 * mu), n=n)
        s = alone.rate()
        print(f"mode {n}, a drop alone: frequency over the inviscid one {s.imag / alone.inviscid():.5f}, decay over 2 n (n - 1) nu/R^2 {-s.real / (2 * n * (n - 1) * mu):.4f}")
    for nu in 1e-2, 1e-4, 1e-6:
        both = Drop(1.0, (1.0, nu), (1.0, nu))
        print(f"two fluids alike, nu = {nu:.0e}: frequency over the inviscid one {both.rate().imag / both.inviscid():.5f}")


if __name__ == "__main__":
    main()
