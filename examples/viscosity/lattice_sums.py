# SPDX-License-Identifier: GPL-2.0-only
"""Viscosities that particles on a lattice have, without particles: sums over the neighbors of one of them.

A wave u = e exp(i k x) on a lattice is an eigenvector of the forces.  The sums below, divided by k^2, are the
viscosities at that wave number; for kh -> 0 they become the "discrete" viscosities, which differ from the
continuum's 1 by what the sum over neighbors differs from the integral.  Density, particle distance and shear
viscosity are 1, as in in.viscosity.
"""

import itertools

import numpy as np
from scipy.integrate import quad

# W(q) and -W'(q)/q, q = r/support, without the norms; the norms in two and three dimensions
KERNELS = {
    "wendland/c2": (lambda q: (1 - q) ** 4 * (1 + 4 * q), lambda q: 20 * (1 - q) ** 3,
                    {2: 7 / np.pi, 3: 21 / (2 * np.pi)}),
    "lucy": (lambda q: (1 - q) ** 3 * (1 + 3 * q), lambda q: 12 * (1 - q) ** 2, {2: 5 / np.pi, 3: 105 / (16 * np.pi)}),
}
# dimension, unit cell, particles in it
BASES = {
    "sq": (2, [[1, 0], [0, 1]], [[0, 0]]),
    "hex": (2, [[1, 0], [0, np.sqrt(3)]], [[0, 0], [0.5, 0.5]]),
    "sc": (3, np.eye(3), [[0, 0, 0]]),
    "bcc": (3, np.eye(3), [[0, 0, 0], [0.5, 0.5, 0.5]]),
    "fcc": (3, np.eye(3), [[0, 0, 0], [0.5, 0.5, 0], [0.5, 0, 0.5], [0, 0.5, 0.5]]),
}


def period(lattice, direction):
    """Length of the unit cell along x, in particle distances."""
    dim, cell, basis = BASES[lattice]
    a = (len(basis) / np.linalg.det(cell)) ** (1 / dim)
    return a * (np.sqrt(2) if direction == "110" else 1.0)


class Lattice:
    """Neighbors of one particle; the wave runs along x, a shear wave has its velocity along y."""

    def __init__(self, lattice, direction, support, kernel="wendland/c2", summed=True):
        self.dim, cell, basis = BASES[lattice]
        dim = self.dim
        a = (len(basis) / np.linalg.det(cell)) ** (1 / dim)
        reach = range(-int(support / a) - 2, int(support / a) + 3)
        cells = np.array(list(itertools.product(reach, repeat=dim)), dtype=float)
        r = np.concatenate([(cells + b) @ np.asarray(cell) for b in np.asarray(basis)]) * a
        if direction == "110":
            s = np.sqrt(0.5)
            turn = np.eye(dim)
            turn[:2, :2] = [[s, s], [-s, s]]
            r = r @ turn.T
        d = np.linalg.norm(r, axis=1)
        w, f, norm = KERNELS[kernel]
        inside = d < support
        c = norm[dim] * np.sum(w(d[inside] / support)) / support**dim
        near = inside & (d > 1e-9)
        self.r, self.d = r[near], d[near]
        self.F = norm[dim] * f(self.d / support) / support ** (dim + 2)
        # the volume of a particle comes from the summed density, or is given (LAMMPS's own styles)
        self.V = 1 / c if summed else 1.0
        # integral of r W, for the form with the weight F r
        surface = {2: 2 * np.pi, 3: 4 * np.pi}[dim]
        self.mean_radius = support * quad(lambda q: surface * norm[dim] * w(q) * q**dim, 0, 1)[0]

    def _waves(self, k):
        """(1 - cos kx)/k^2 and sin(kx)/k at the neighbors, for k = 0 their limits."""
        x = self.r[:, 0]
        if k == 0:
            return x**2 / 2, x
        return 2 * np.sin(k * x / 2) ** 2 / k**2, np.sin(k * x) / k

    def shear_term(self, form, axis, k):
        """Viscosity of the shear term for a wave with its velocity along an axis (0: sound, 1: shear)."""
        n = self.dim
        central = (self.r[:, axis] / self.d) ** 2
        weight = {"mg": 2 * (n + 2) * central,
                  "mg/fr": 2 * n * (n + 2) / ((n + 1) * self.mean_radius) * self.d * central,
                  "morris": 2.0,
                  "espanol": 2 * (n + 2) / (n + 3) * (1 + central)}[form]
        return self.V**2 * np.sum(self.F * weight * self._waves(k)[0])

    def bulk_term(self, k):
        """Longitudinal viscosity of the bulk term for zeta = 1."""
        return self.V**3 * np.sum(self.F * self.r[:, 0] * self._waves(k)[1]) ** 2

    def sound_speed(self, k):
        """Of waves without damping, over c0."""
        return self.V * abs(np.sum(self.F * self.r[:, 0] * self._waves(k)[1]))
