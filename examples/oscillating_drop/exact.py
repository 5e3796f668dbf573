#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The drop of the continuum: an incompressible, inviscid ellipse under the central force -B^2 r per mass, B = 1.

The motion is linear, x = F(t) X, from a disc |X| < R: the velocity u = L x with L = F' F^-1 has no divergence
(det F = 1), and the pressure p = (rho R^2 s/2) (1 - |X|^2/R^2) is zero at the surface. Euler's equation
rho x'' = -grad p - rho B^2 x, with grad p = -rho s F^-T X, holds at every point if

    F'' = -B^2 F + s F^-T,        s = (tr L^2 + 2 B^2)/tr(F^-1 F^-T),

where s is what keeps det F = 1. Without rotation F is diagonal, u = (A x, -A y), and with the semi-axes a, b

    A' = (A^2 + B^2) (b^2 - a^2)/(a^2 + b^2),     a' = A a,     b' = -A b.

R does not enter: the equations are linear in x but for the surface, and ratios to R are the same for any.
A little viscosity: the work against the shear stress of that flow, nu |grad u + (grad u)^T|^2/2 per mass, in the
place of exact friction; it neglects the thin layer at the surface in which the flow adapts to zero shear stress.
With stress = "laplace" it is nu |grad u|^2, that of a force nu times the Laplacian of the velocity, which does not
conserve angular momentum.
"""

import numpy as np
from scipy.integrate import solve_ivp


class Drop:
    def __init__(self, A, W, times, nu=0.0, stress="newton"):
        """F and its rate of change at the times, the first of them 0; nu: viscosity over density and R^2 B."""
        def motion(_, y):
            F, D = y.reshape(2, 2, 2)
            inverse = np.linalg.inv(F)
            L = D @ inverse
            s = (np.trace(L @ L) + 2) / np.sum(inverse**2)
            # Lagrange's equations: the second moment per mass of a disc is R^2/4 in both directions
            friction = -4 * nu * (L + L.T if stress == "newton" else L) @ inverse.T
            # what is left of it after the pressure has kept det F = 1
            friction -= np.sum(inverse.T * friction) / np.sum(inverse**2) * inverse.T
            return np.concatenate([D.ravel(), (-F + s * inverse.T + friction).ravel()])

        start = [1, 0, 0, 1, A, -W, W, -A]
        solution = solve_ivp(motion, (0, times[-1]), start, t_eval=times, rtol=1e-11, atol=1e-12, method="DOP853")
        self.t = np.asarray(times)
        self.F, self.D = np.moveaxis(solution.y.reshape(2, 2, 2, -1), -1, 1)
        self.inverse = np.linalg.inv(self.F)
        self.L = self.D @ self.inverse
        self.s = (np.einsum("tij,tji->t", self.L, self.L) + 2) / np.sum(self.inverse**2, axis=(1, 2))
        self.moments = self.F @ np.swapaxes(self.F, 1, 2)          # over R^2/4 per mass
        self.axes = np.sqrt(np.linalg.eigvalsh(self.moments))      # over R, the smaller first
        # per mass and R^2/4; the energy twice
        self.energy = np.sum(self.D**2 + self.F**2, axis=(1, 2))
        self.momentum = np.einsum("ti,ti->t", self.F[:, 0], self.D[:, 1]) - np.einsum("ti,ti->t", self.F[:, 1], self.D[:, 0])
        lagrange = np.swapaxes(self.F, 1, 2) @ self.D
        self.circulation = lagrange[:, 1, 0] - lagrange[:, 0, 1]


def period(A):
    """Of the motion without rotation: twice the time between two passages through the disc."""
    def motion(_, y):
        A, a, b = y
        return [(A * A + 1) * (b * b - a * a) / (a * a + b * b), A * a, -A * b]

    def disc(_, y):
        return y[1] - y[2]
    disc.direction = -1
    disc.terminal = True
    half = solve_ivp(motion, (0, 100), [A, 1.0 + 1e-15, 1.0 - 1e-15], events=disc, rtol=1e-12, atol=1e-13, method="DOP853")
    return 2 * half.t_events[0][-1]


def invariants(A, W, end=24.0):
    """Largest change of det F, energy, angular momentum and circulation, relative (to the energy for the latter two)."""
    drop = Drop(A, W, np.linspace(0, end, 500))
    return (np.abs(np.linalg.det(drop.F) - 1).max(), *(np.ptp(q) / drop.energy[0]
            for q in (drop.energy, drop.momentum, drop.circulation)))


if __name__ == "__main__":
    for A, W in ((1.0, 0.0), (0.5, 0.0), (1.0, 0.5)):
        drop = Drop(A, W, np.linspace(0, 24, 5000))
        print(f"A = {A}, W = {W}: semi-axes {drop.axes.min():.5f} to {drop.axes.max():.5f} R"
              + (f", period {period(A):.5f}/B" if W == 0 else "")
              + f", pressure in the centre {0.5 * drop.s.min():.4f} to {0.5 * drop.s.max():.4f}")
        print("    change of det F, energy, angular momentum, circulation: "
              + ", ".join(f"{value:.1e}" for value in invariants(A, W)))
