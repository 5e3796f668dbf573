#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Reference solution of the sound pulse, without particles.

Solves eqs. (70)-(74) of Bonet Avalos, Antuono, Colagrossi and Souto-Iglesias,
Phys. Rev. E 101, 013302 (2020) on the periodic domain [-0.5, 1.5),

    rho_t = -(rho v)_x
    v_t   = -v v_x - c0^2 rho_x / rho + (kappa / rho) v_xx
    rho(x, 0) = rho0 (1 + A sin(2 pi x / L)),   v(x, 0) = c0 (rho(x, 0) / rho0 - 1)

in Eulerian form: central finite differences of sixth order in space, the
classical Runge-Kutta method of fourth order in time.  Run as a script, it shows
how far the solution still depends on the grid, on the order of the differences
and on the time step, with a Fourier spectral solution as the judge.
"""

import sys

import numpy as np
from scipy.interpolate import CubicSpline

RHO0 = 1.0
C0 = 1.0
AMPLITUDE = 0.005
XLO = -0.5
LENGTH = 2.0
TIME = 1.22 * LENGTH / C0     # when the paper's figure 2 looks at the velocity

POINTS = 128                  # grid of the reference that the example uses

# coefficients of f(x + m dx) -+ f(x - m dx), m = 1, 2, ...: first and second derivative
CENTRAL = {
    2: ([1 / 2], [1]),
    4: ([2 / 3, -1 / 12], [4 / 3, -1 / 12]),
    6: ([3 / 4, -3 / 20, 1 / 60], [3 / 2, -3 / 20, 1 / 90]),
}


def initial_density(x):
    """Density of eq. (73)."""
    return RHO0 * (1 + AMPLITUDE * np.sin(2 * np.pi * x / LENGTH))


def initial_velocity(x):
    """Velocity of eq. (74)."""
    return C0 * (initial_density(x) / RHO0 - 1)


class FiniteDifferences:
    """Periodic central differences of order 2, 4 or 6."""

    def __init__(self, points, order=6):
        dx = LENGTH / points
        first, second = CENTRAL[order]
        self.first = [a / dx for a in first]
        self.second = [b / dx**2 for b in second]
        # largest eigenvalue of the second derivative (its mode +1, -1, +1, ...)
        self.stiffness = 4 * sum(b for b in self.second[::2])

    def __call__(self, f):
        d1 = np.zeros_like(f)
        d2 = np.zeros_like(f)
        for m, (a, b) in enumerate(zip(self.first, self.second), start=1):
            right, left = np.roll(f, -m), np.roll(f, m)
            d1 += a * (right - left)
            d2 += b * (right - 2 * f + left)
        return d1, d2


class Spectral:
    """Fourier derivatives, for checking the finite differences."""

    def __init__(self, points):
        self.k = 2 * np.pi / LENGTH * np.arange(points // 2 + 1)
        self.stiffness = self.k[-1] ** 2
        self.ik = 1j * self.k
        self.ik[-1] = 0.0      # the first derivative of the sawtooth mode vanishes on the grid
        self.points = points

    def __call__(self, f):
        g = np.fft.rfft(f)
        return (np.fft.irfft(self.ik * g, self.points),
                np.fft.irfft(-self.k**2 * g, self.points))


class Solution:
    """Velocity at the end and kinetic energy at all times of one kappa."""

    def __init__(self, kappa, points=POINTS, derivatives=None, time=TIME, dt_factor=1.0):
        if derivatives is None:
            derivatives = FiniteDifferences(points)
        self.x = XLO + LENGTH / points * np.arange(points)
        dx = LENGTH / points

        # Runge-Kutta 4 is stable for |lambda dt| < 2.8 along both axes; sound waves and
        # diffusion share half of that
        rate = kappa / RHO0 * derivatives.stiffness + np.pi * C0 / dx
        steps = int(np.ceil(time * rate / 1.4 / dt_factor))
        dt = time / steps

        def rhs(state):
            rho, v = state
            rho_x, _ = derivatives(rho)
            v_x, v_xx = derivatives(v)
            return np.array([-(rho * v_x + v * rho_x),
                             -v * v_x + (kappa * v_xx - C0**2 * rho_x) / rho])

        def energy(state):
            return 0.5 * dx * np.sum(state[0] * state[1] ** 2)

        state = np.array([initial_density(self.x), initial_velocity(self.x)])
        times, energies = [0.0], [energy(state)]
        for step in range(1, steps + 1):
            k1 = rhs(state)
            k2 = rhs(state + 0.5 * dt * k1)
            k3 = rhs(state + 0.5 * dt * k2)
            k4 = rhs(state + dt * k3)
            state = state + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            times.append(step * dt)
            energies.append(energy(state))

        self.steps = steps
        self.v = state[1]
        self.spectrum = np.fft.rfft(self.v) / points
        self.energy_ratio = CubicSpline(times, np.array(energies) / energies[0])

    def velocity(self, x):
        """Velocity at any x, by trigonometric interpolation."""
        phase = 2 * np.pi / LENGTH * (np.asarray(x) - XLO)
        v = np.full(phase.shape, self.spectrum[0].real)
        # beyond 24 waves per domain nothing is left above round-off
        for k in range(1, min(25, len(self.spectrum))):
            v += 2 * (self.spectrum[k] * np.exp(1j * k * phase)).real
        return v


def main():
    x = np.linspace(XLO, XLO + LENGTH, 1000, endpoint=False)
    t = np.linspace(0, TIME, 200)
    worst = 0.0
    for kappa in (0.2, 0.02):
        judge = Solution(kappa, 48, Spectral(48), dt_factor=0.25)
        ratio = judge.velocity(x).max() / initial_velocity(x).max()
        print(f"kappa = {kappa}: largest velocity at t c0/L = 1.22 over its initial value {ratio:.6f}")
        print("  differences to a spectral solution (48 points, a quarter of the time step)")
        print("  method         points  steps   v(x), relative L2   KE(t)/KE(0), largest")
        rows = [("order 2", 64, FiniteDifferences(64, 2)),
                ("order 2", 128, FiniteDifferences(128, 2)),
                ("order 6", 64, FiniteDifferences(64)),
                ("order 6, used", POINTS, FiniteDifferences(POINTS)),
                ("spectral", 32, Spectral(32))]
        for name, points, derivatives in rows:
            fd = Solution(kappa, points, derivatives)
            dv = np.linalg.norm(fd.velocity(x) - judge.velocity(x)) / np.linalg.norm(judge.velocity(x))
            de = np.abs(fd.energy_ratio(t) - judge.energy_ratio(t)).max()
            print(f"  {name:14s} {points:5d} {fd.steps:6d}   {dv:17.1e}   {de:20.1e}")
            if name == "order 6, used":
                worst = max(worst, dv, de)
    print(f"error of the reference: {worst:.0e}")
    return 0 if worst < 1e-6 else 1


if __name__ == "__main__":
    sys.exit(main())
