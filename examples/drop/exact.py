#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Small oscillations of a round drop of one viscous fluid in another, in two dimensions, by linear theory.

As H. Lamb, Hydrodynamics, 6th ed., art. 355, has it for a sphere without a fluid outside of it: with the stream function

    psi = [A r^n + B I_n(a r)] sin(n phi) e^(s t) inside,  [C r^-n + D K_n(b r)] sin(n phi) e^(s t) outside,  a^2 = s rho/mu,

velocities and tangential stress are the same on both sides at r = R, and the normal stress differs by the tension times the
change of the curvature, sigma (n^2 - 1) zeta/R^2.  Four equations, whose determinant is 0 at the rate s.

In a periodic box, other drops that do the same stand on a square lattice.  The potential of the flow outside is then a
function of Weierstrass in place of r^-2: for n = 2 near the drop C (r^-2 - 3 G r^2), with G = 3.1512/L^4, the sum of the
inverse fourth powers of the places of the lattice.  The vortical part is small at the images.

A drop that begins at rest has no vorticity at its surface: its first motion is not that of the rate s.  It follows from the
same four equations for the Laplace transform, with sigma (n^2 - 1)/R^2 zeta(0)/s on the right side.
"""

import numpy as np


LATTICE_SUM = 3.1512120    # of the inverse fourth powers of the places (j + i k) of a square lattice


def bessel_i(n, z):
    """I_n(z) e^-z, from its integral"""
    t = np.linspace(0.0, np.pi, 401 + 4 * int(abs(z)))
    f = np.exp(z * (np.cos(t) - 1.0)) * np.cos(n * t)
    return (f.sum() - 0.5 * (f[0] + f[-1])) * (t[1] - t[0]) / np.pi


def bessel_k(n, z):
    """K_n(z) e^z, from its integral"""
    t = np.linspace(0.0, 12.0, 1201)
    f = np.exp(np.maximum(-z.real * (np.cosh(t) - 1.0), -700.0) - 1j * z.imag * (np.cosh(t) - 1.0)) * np.cosh(n * t)
    return (f.sum() - 0.5 * f[0]) * (t[1] - t[0])


def finite_range(reach, n=2):
    """Tension by a pair energy of W = (1 - r^2/reach^2)^2 around a drop of radius 1, over that of a line: (1) in the Laplace
    pressure; (2) in the restoring force of mode n.  An area that changes by f(phi) changes the energy between both fluids by
    the sum over pairs of places of the circle, W [f(phi) - f(phi')]^2, less that of a shift, n = 1."""
    angle = np.linspace(0.0, 2 * np.arcsin(min(reach / 2, 1.0)), 20001)
    chord = 2 * np.sin(angle / 2)
    weight = np.maximum(1 - (chord / reach)**2, 0.0)**2
    r = np.linspace(0.0, reach, 20001)
    flat = integral(r, r**2 * (1 - (r / reach)**2)**2)      # proportional to the tension of a line
    force = integral(angle, weight * (np.cos(angle) - np.cos(n * angle))) / (n * n - 1) * 2 / flat
    # pairs at the distance r: d/dR of the area of a disc of radius R without its overlap with itself, shifted by r
    pressure = integral(r, r * (1 - (r / reach)**2)**2 * (np.pi - 2 * np.arccos(r / 2))) / flat
    return pressure, force


def integral(x, y):
    return float(((y[1:] + y[:-1]) * np.diff(x)).sum() / 2)


class Drop:
    """inside and outside: (density, viscosity); box: edge of a periodic one along whose edges the drop is stretched, for n = 2"""

    def __init__(self, sigma, inside, outside, radius=1.0, n=2, box=np.inf):
        self.sigma, self.inside, self.outside, self.radius, self.n = sigma, inside, outside, radius, n
        self.images = -3 * LATTICE_SUM * (radius / box)**4      # of r^n outside over that of r^-n, in units of the radius

    def inviscid(self):
        n, more = self.n, (1 - self.images) / (1 + self.images)
        return np.sqrt(n * (n * n - 1) * self.sigma / ((self.inside[0] + more * self.outside[0]) * self.radius**3))

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
            images = self.images if power < 0 else 0.0
            for f, df, ddf, p in (
                    (1.0 + images, (power - power * images) / radius, (power * (power - 1) + power * (power + 1) * images) / radius**2,
                     -rho * s * np.sign(power) * (1.0 - images)),
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

    def shape(self, t):
        """zeta(t)/zeta(0) of a drop that begins at rest, by the inverse of the Laplace transform along Re s = line"""
        line, step = 3.0 / t[-1], 0.6 / t[-1]
        omega = np.arange(0.5 * step, 60 * self.inviscid(), step)
        values = []
        for s in line + 1j * omega:
            push = self.sigma * (self.n**2 - 1) / self.radius**2 / s
            parts = np.linalg.solve(self.conditions(s), [0.0, 0.0, 0.0, -push])
            values.append(self.n / self.radius * (parts[0] + parts[1]) / s)      # of zeta - zeta(0)
        return 1.0 + np.exp(line * t) / np.pi * step * (np.exp(1j * np.outer(t, omega)) @ np.array(values)).real

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
        both = Drop(1.0, (1.0, nu), (1.0, nu), box=4.0)
        print(f"    in a box of 4 radii: {both.rate().imag / both.inviscid():.5f}")
    t = np.linspace(0.0, 5.0, 6)
    alone = Drop(1.0, (1.0, 1e-3), (1e-8, 1e-11))
    s = alone.rate()
    for reach in 0.1, 0.25, 0.4167, 0.5:
        print("range {:.2f} of the tension: Laplace pressure {:.4f}, force of mode 2 {:.4f}".format(reach, *finite_range(reach)))
    print("from rest, a drop alone:", alone.shape(t), "with the rate of the mode:", np.exp(s.real * t) * np.cos(s.imag * t))


if __name__ == "__main__":
    main()
