# SPDX-License-Identifier: GPL-2.0-only
"""Plane swirling flow u(r, t) about an axis, of an inner fluid up to r = core and an outer one up to r = radius.

The stress decides what happens. With `newton`, the symmetric stress that conserves angular momentum,

    rho du/dt = (1/r^2) d/dr(r^3 eta d(u/r)/dr);

with `laplace`, where eta times the velocity gradient takes the place of the stress,

    rho du/dt = (1/r) d/dr(r eta du/dr) - eta u/r^2.

Finite volumes, second order in space, implicit in time; the interface is a face between two cells.
"""

import numpy as np
from scipy.linalg import solve_banded

CELLS = 400       # about; the interface must be a face
STEP = 0.002      # of the time; Crank and Nicolson's scheme, implicit Euler steps up to the first of the times


class Swirl:
    def __init__(self, stress, eta1, eta2, core, radius=1.0, rho=1.0, wall=None):
        """wall: angular velocity of a wall at r = radius; None: a free surface there."""
        inner = round(CELLS * core / radius)
        outer = CELLS - inner
        self.face = np.concatenate([np.linspace(0, core, inner + 1), np.linspace(core, radius, outer + 1)[1:]])
        self.r = 0.5 * (self.face[1:] + self.face[:-1])
        width = np.diff(self.face)
        eta = np.where(self.r < core, eta1, eta2)
        resistance = 0.5 * width / eta
        self.inertia = rho * self.r * width
        self.moment = 2 * np.pi * rho * width * self.r**2

        # both stresses are eta d(u/over)/dr; times over and r it is what the flux through a face is
        over, over_face = (self.r, self.face) if stress == "newton" else (np.ones_like(self.r), np.ones_like(self.face))
        weight = self.face * over_face**2
        link = weight[1:-1] / (resistance[1:] + resistance[:-1])
        self.diagonal = np.zeros_like(self.r)
        self.diagonal[:-1] -= link / over[:-1] ** 2
        self.diagonal[1:] -= link / over[1:] ** 2
        self.beside = link / (over[1:] * over[:-1])
        self.drive = np.zeros_like(self.r)
        if wall is not None:
            end = weight[-1] / resistance[-1]
            self.diagonal[-1] -= end / over[-1] ** 2
            self.drive[-1] = end * wall * radius / (over_face[-1] * over[-1])
        if stress == "laplace":
            self.diagonal -= eta * width / self.r

    def _apply(self, u):
        f = self.diagonal * u + self.drive
        f[:-1] += self.beside * u[1:]
        f[1:] += self.beside * u[:-1]
        return f

    def _matrix(self, inertia, factor):
        band = np.zeros((3, len(self.r)))
        band[0, 1:] = band[2, :-1] = -factor * self.beside
        band[1] = inertia - factor * self.diagonal
        return band

    def evolve(self, omega, times):
        """u at the increasing times, from the angular velocities omega at self.r at time 0."""
        u, now, found = omega * self.r, 0.0, []
        for target in times:
            steps = int(np.ceil((target - now) / STEP - 1e-9))
            if steps > 0:
                dt = (target - now) / steps
                theta = 1.0 if now == 0.0 else 0.5
                band = self._matrix(self.inertia, theta * dt)
                for _ in range(steps):
                    rhs = self.inertia * u + dt * ((1 - theta) * self._apply(u) + theta * self.drive)
                    u = solve_banded((1, 1), band, rhs)
                now = target
            found.append(u)
        return np.array(found)

    def steady(self):
        return solve_banded((1, 1), self._matrix(0.0, 1.0), self.drive)

    def angular_momentum(self, u):
        return np.sum(self.moment * u, axis=-1)

    def angular_velocity(self, u, within):
        """Angular momentum over moment of inertia of the fluid at r < within."""
        core = self.r < within
        return np.sum((self.moment * u)[..., core], axis=-1) / np.sum((self.moment * self.r)[core])
