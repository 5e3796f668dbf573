#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Linear waves of a viscous fluid of depth H over a floor without friction, surface open to air of no pressure.

With u = grad phi + curl psi, phi = A cosh(k y) exp(i k x + s t), psi = B sinh(m y) exp(i k x + s t), and m^2 = k^2 + s/nu, the equations of
Navier and Stokes hold for p = -rho d phi/dt, and so do the conditions at the floor: no flow through it, no shear stress. At the surface,

    no shear stress:   2 i k^2 A sinh(k H) + (m^2 + k^2) B sinh(m H) = 0
    no normal stress:  p - 2 rho nu dv/dy = rho g eta,  d eta/dt = v

where eta is the elevation. Both hold with A and B other than zero for the s with residual(s) = 0.
The decay is 2 nu k^2 and the frequency (g k tanh(k H))^(1/2) for nu -> 0.
"""

import sys

import numpy as np
from scipy.optimize import root


def residual(s, nu, k=np.pi, g=1.0, H=1.0):
    """Over cosh(k H)."""
    m = np.sqrt(k**2 + s / nu)
    vortex = 2 * k**2 / (m**2 + k**2) * np.tanh(k * H)
    return s**2 + 2 * nu * s * k**2 * (1 - vortex / k * m / np.tanh(m * H)) + g * k * (np.tanh(k * H) - vortex)


def inviscid(k=np.pi, g=1.0, H=1.0):
    return np.sqrt(g * k * np.tanh(k * H))


def wave(nu, k=np.pi, g=1.0, H=1.0):
    """Decay and frequency."""
    def real(y):
        value = residual(complex(*y), nu, k, g, H)
        return [value.real, value.imag]

    found = root(real, [-2 * nu * k**2, inviscid(k, g, H)], tol=1e-14)
    assert abs(residual(complex(*found.x), nu, k, g, H)) < 1e-11, found.message
    return -found.x[0], found.x[1]


def main():
    """The limit of little viscosity, and that of deep water against the equation of Lamb, Hydrodynamics, section 349."""
    for nu in (1e-2, 2e-3, 1e-4, 1e-6):
        decay, omega = wave(nu)
        print(f"nu = {nu:g}: decay {decay / (2 * nu * np.pi**2):.6f} x 2 nu k^2, frequency {omega / inviscid():.6f} x (g k tanh kH)^(1/2)")
    assert abs(decay / (2 * nu * np.pi**2) - 1) < 5e-3 and abs(omega / inviscid() - 1) < 1e-4
    k, nu = 20.0, 1e-3      # k H = 20
    s = complex(-wave(nu, k)[0], wave(nu, k)[1])
    m = np.sqrt(k**2 + s / nu)
    lamb = (s + 2 * nu * k**2)**2 + k - 4 * nu**2 * k**3 * m
    print(f"deep water: {abs(lamb) / k:.1e}")
    return 0 if abs(lamb) / k < 1e-9 else 1


if __name__ == "__main__":
    sys.exit(main())
