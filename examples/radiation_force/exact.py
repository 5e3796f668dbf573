# SPDX-License-Identifier: GPL-2.0-only
"""Theory of the mean force of sound on a small cylinder in a viscous fluid, in second order of the velocity of the wave.

The cylinder is a rigid one at rest ("wall"), a rigid one that the fluid moves ("rigid"), or a drop of a second viscous fluid ("drop").
Radius of the cylinder, density and speed of sound of the fluid are 1; first order varies as exp(-i omega t).  Near the cylinder the wave
is the velocity U plus x dU/dx along x, and the pressure that belongs to it.
"""

import numpy as np
from scipy.special import h1vp, hankel1, iv, ivp, j0, jv, jvp, kv, kvp


def added_mass(delta):
    """of a cylinder over its mass of fluid, with the force of the boundary layer as imaginary part (Stokes 1851)"""
    x = (1 - 1j) / delta
    return 1 + 4 * kv(1, x) / (x * kv(0, x))


def powers(r, *exponents):
    """Each power of r with its first two derivatives."""
    return [(r**m, m * r**(m - 1.0), m * (m - 1) * r**(m - 2.0)) for m in exponents]


def shear(f, m):
    """Shear stress of the stream function f sin(m theta) at r = 1, over viscosity and sin(m theta)."""
    return -f[2] + f[1] - m * m * f[0]


def velocity_gradient(f, m, r, t):
    """of the stream function f sin(m t): derivative j of component i, both along r and t"""
    cos, sin = np.cos(m * t), np.sin(m * t)
    return np.array([[m * (f[1] / r - f[0] / r**2) * cos, (f[1] - m * m * f[0] / r) / r * sin],
                     [-f[2] * sin, (m * f[0] / r - m * f[1]) / r * cos]])


class Cylinder:
    """kind; omega; delta, the thickness of the boundary layer; of a body that moves: density over that of the fluid, speed of sound of the
    drop, frequency of the spring over omega.  mu, kappa: of both fluids."""

    def __init__(self, kind, omega, delta, kappa=0.0, ratio=1.0, c=1.0, hold=0.0):
        self.kind, self.omega, self.delta, self.mu, self.kappa, self.ratio = kind, omega, delta, 0.5 * delta**2 * omega, kappa, ratio
        self.spring = hold**2 * (ratio + 1)      # over pi omega^2
        self.outer, self.inner = (1 - 1j) / delta, (1 - 1j) / delta * np.sqrt(ratio)
        self.modulus = ratio * c**2
        outside, inside = 1 - 1j * omega * kappa, self.modulus - 1j * omega * kappa
        # rate of expansion of the cylinder over that of the fluid far away
        self.expansion = outside / inside * (1 - 1j * omega * self.mu / outside) / (1 - 1j * omega * self.mu / inside) if kind == "drop" else 0

    def layer(self, m, r):
        return [self.outer**d * (kvp(m, self.outer * r, d) if d else kv(m, self.outer * r)) / kv(m, self.outer) for d in (0, 1, 2)]

    def layer_inside(self, m, r):
        return [self.inner**d * (ivp(m, self.inner * r, d) if d else iv(m, self.inner * r)) / iv(m, self.inner) for d in (0, 1, 2)]

    def flow(self, m, incident, push=0.0):
        """Factors a, b, c, d of the stream functions (incident r^m + a r^-m + b K_m) sin(m theta) outside, (c r^m + d I_m) sin(m theta) inside.
        push: body force per mass on fluid and cylinder, along x, m = 1"""
        layer = self.layer(m, 1.0)
        if self.kind != "drop":
            speed = 0
            if self.kind == "rigid" and m == 1:
                mass, acceleration = added_mass(1 / self.outer.real), -1j * self.omega * incident
                speed = ((1 + mass) * acceleration + (self.ratio - 1) * push) / (self.ratio - self.spring + mass) / (-1j * self.omega)
            return [*np.linalg.solve([[1, 1], [-m, layer[1]]], [speed - incident, speed - m * incident]), speed, 0]
        # velocities, shear stress, and normal stress are continuous
        (r_m,), (r_minus,) = powers(1.0, m), powers(1.0, -m)
        shapes = r_minus, layer, r_m, self.layer_inside(m, 1.0)
        rows = np.array([[sign * np.array([f[0], f[1], self.mu * shear(f, m), 2 * self.mu * m * (f[1] - f[0])]) for f, sign in zip(shapes, (1, 1, -1, -1))]])[0].T
        rows = rows.astype(complex)
        rows[3, 0] += 1j * self.omega
        rows[3, 2] += 1j * self.omega * self.ratio
        right = -incident * np.array([1, m, self.mu * shear(r_m, m), 2 * self.mu * m * (m - 1) - 1j * self.omega])
        if m == 1:
            rows[3, 2:] -= 1j * self.omega * self.spring * np.array([1, 1])
            right[3] += push * (1 - self.ratio)
        return np.linalg.solve(rows, right)

    def first_order(self, velocity, push):
        """Dipole of the flow around the cylinder over its volume, and velocity of the cylinder."""
        a, _, c, d = self.flow(1, velocity, push)
        return -2 * a, c + d

    def force(self, radius, points=1500, angles=16):
        """Mean force for U = dU/dx = 1 over pi/2, where the mean flow vanishes at this radius.

        In coordinates of the particles at rest the mean of the momentum balance is Div(P) = 0, with the first Piola stress P.  The wave
        contributes Q in second order, bilinear in the flows of U and of dU/dx; the rest is the Stokes flow of the mean velocities of the
        particles.  By the reciprocal theorem the force is the integral of -grad(u): Q, with the Stokes flow u of the same cylinder that
        is drawn along x with a mean velocity of 1.  Terms of the order omega^2 are left out."""
        x = (np.arange(points) + 0.5) / points
        t = ((np.arange(angles) + 0.5) * 2 * np.pi / angles)[None, :]
        a1, b1, c1, d1 = self.flow(1, 1.0)
        a2, b2, c2, d2 = self.flow(2, 0.25)
        omega, mu, kappa, identity = self.omega, self.mu, self.kappa, np.eye(2)[:, :, None, None]
        test, test_inside = self.drawn(radius)

        def trace(h):
            return h[0, 0] + h[1, 1]

        def transposed(h):
            return np.swapaxes(h, 0, 1)

        def viscous(gradient):
            return mu * (gradient + transposed(gradient) - trace(gradient) * identity) + kappa * trace(gradient) * identity

        def mean(h, g):
            return 0.5 * np.real(np.einsum("ik...,kj...->ij...", h, np.conj(g)))

        def integral(r, weight, stream1, pressure1, stream2, expansion, source, pressure2, stream):
            gradient1 = velocity_gradient(stream1, 1, r, t)
            gradient2 = velocity_gradient(stream2, 2, r, t) + np.array([[0.5 * expansion - source / r**2 + 0 * t, 0 * r * t],
                                                                          [0 * r * t, 0.5 * expansion + source / r**2 + 0 * t]])
            strain1, strain2 = gradient1 / (-1j * omega), gradient2 / (-1j * omega)
            stress1, stress2 = viscous(gradient1) - pressure1 * identity, viscous(gradient2) - pressure2 * identity
            q = (mean(stress1, trace(strain2) * identity - transposed(strain2)) + mean(stress2, trace(strain1) * identity - transposed(strain1))
                 - viscous(mean(gradient1, strain2) + mean(gradient2, strain1)))
            # the wave without a cylinder has no mean force
            wave = -0.5 * np.real(1j * omega * r * np.cos(t) * np.conj(1 / (-1j * omega)))
            q -= wave * np.array([[np.sin(t)**2, np.sin(t) * np.cos(t)], [np.sin(t) * np.cos(t), np.cos(t)**2]])
            return (velocity_gradient(stream, 1, r, t) * q).sum((0, 1, 3)) @ (weight * r[:, 0]) * 2 * np.pi / angles

        def combined(*parts):
            return [sum(factor * f[d] for factor, f in parts) for d in (0, 1, 2)]

        r, weight = (1 + (radius - 1) * x**2)[:, None], (radius - 1) * 2 * x / points
        source, double = 0.5 * (self.expansion - 1), np.cos(2 * t)
        (r1,), (rm1,), (r2,), (rm2,) = (powers(r, m) for m in (1, -1, 2, -2))
        found = integral(r, weight, combined((1, r1), (a1, rm1), (b1, self.layer(1, r))), 1j * omega * (r - a1 / r) * np.cos(t),
                         combined((0.25, r2), (a2, rm2), (b2, self.layer(2, r))), 1.0, source,
                         1j * omega * (0.25 * r**2 * (1 + double) - a2 / r**2 * double + source * np.log(r)), combined(*zip(test, stokes(r))))
        if self.kind == "drop":
            r, weight = x[:, None], np.full(points, 1 / points)
            (r1,), (r2,), (r3,) = (powers(r, m) for m in (1, 2, 3))
            pressure1 = 1j * omega * (self.ratio * c1 - self.spring * (c1 + d1)) * r * np.cos(t)
            pressure2 = (0.25j * omega + 2 * mu * source + kappa * (self.expansion - 1) + 0.25j * omega * self.ratio * self.expansion * (r**2 - 1)
                         + 1j * omega * self.ratio * c2 * r**2 * double)
            found += integral(r, weight, combined((c1, r1), (d1, self.layer_inside(1, r))), pressure1,
                              combined((c2, r2), (d2, self.layer_inside(2, r))), self.expansion, 0.0, pressure2, combined(*zip(test_inside, (r1, r3))))
        return -found / (0.5 * np.pi)

    def drawn(self, radius=None, mean=0.0, curvature=0.0):
        """Stokes flow of the cylinder that is drawn along x with a mean velocity of 1: factors of stokes() outside, and of r and r^3 inside.
        It vanishes at a radius, or its first, third, and fourth factor are in the ratio mean : 1 : curvature."""
        far = np.array([[f[d] for f in stokes(radius)] for d in (0, 1)]) if radius else np.array([[1, 0, -mean, 0], [0, 0, -curvature, 1.0]])
        near = np.array([[f[0], f[1], shear(f, 1)] for f in stokes(1.0)]).T
        if self.kind != "drop":
            return np.linalg.solve(np.vstack([far, near[:2]]), [0, 0, 1, 1]), None
        inside = np.array([[f[0], f[1], shear(f, 1)] for f in powers(1.0, 1, 3)]).T
        rows = np.vstack([np.hstack([far, np.zeros((2, 2))]), np.hstack([near, -inside]), [*near[0], 0, 0]])
        factors = np.linalg.solve(rows, [0, 0, 0, 0, 0, 1])
        return factors[:4], factors[4:]

    def steady_flow(self, length, width, x0):
        """What the steady flow around the cylinder adds to the mean force, over pi U (dU/dx)/2, in a box with free-slip walls at x = 0 and length,
        periodic along y.  It is linear in two numbers of the Stokes flow that the box sets."""
        far = self.expansion_and_dipole().real
        radii = 10.0, 30.0
        slopes = np.linalg.solve([self.drawn(radius)[0][2:] for radius in radii], [self.force(radius) - far for radius in radii])
        return slopes @ self.drawn(None, *box(length, width, x0))[0][2:]

    def expansion_and_dipole(self):
        """Mean force over pi U (dU/dx)/2 in an infinite fluid where no steady flow takes momentum away."""
        return 1 - self.expansion + self.first_order(1.0, 0.0)[0]


def inviscid(kind, k, ratio=1.0, c=1.0, hold=0.0, place=0.25 * np.pi, waves=6, angles=64):
    """Mean force of a standing wave p cos(k x + place) over pi k E sin(2 place), for any k, without viscosity: all multipoles, and the flux of
    momentum through a circle"""
    n = np.arange(waves)
    spring = np.where(n == 1, hold**2 * (ratio + 1), 0)
    r, t = 3.0, (np.arange(angles) + 0.5) * 2 * np.pi / angles
    if kind == "drop":
        inside = jvp(n, k / c) / (ratio * c) / (jv(n, k / c) - spring * k / (ratio * c) * jvp(n, k / c))
        scattered = -(jvp(n, k) - inside * jv(n, k)) / (h1vp(n, k) - inside * hankel1(n, k))
    else:
        # the velocity of a body that moves is that of the pressure on it, over its mass
        inside = np.where(n == 1, 1 / (k * (ratio - spring)), 0) if kind == "rigid" else 0 * n
        scattered = -(jvp(n, k) - inside * jv(n, k)) / (h1vp(n, k) - inside * hankel1(n, k))
    factors = np.where(n > 0, 2, 1) * 0.5 * (1j**n * np.exp(1j * place) + (-1j)**n * np.exp(-1j * place))
    cos, sin = np.cos(np.outer(n, t)), np.sin(np.outer(n, t))
    shape, slope = (factors * (jv(n, k * r) + scattered * hankel1(n, k * r))), k * (factors * (jvp(n, k * r) + scattered * h1vp(n, k * r)))
    p, along, across = shape @ cos, slope @ cos / (1j * k), -(n * shape / r) @ sin / (1j * k)
    along_x = along * np.cos(t) - across * np.sin(t)
    flux = 0.25 * (abs(p)**2 - abs(along)**2 - abs(across)**2) * np.cos(t) + 0.5 * (along_x * along.conjugate()).real
    return -flux.sum() * r * 2 * np.pi / angles / (0.25 * np.pi * k * np.sin(2 * place))


def elasticity(support):
    """Shear modulus over pressure of a hexagonal lattice, wendland/c4, support in spacings: the second derivative of the sum of the kernel by the
    strain, over the sum"""
    spacing, far = np.sqrt(2 / np.sqrt(3)), int(support) + 2
    i, j = np.mgrid[-far:far + 1, -far:far + 1]
    x, y, step = spacing * (i + 0.5 * j), spacing * 0.5 * np.sqrt(3) * j, 1e-3

    def kernel_sum(strain):
        q = np.minimum(np.hypot(x * np.exp(0.5 * strain), y * np.exp(-0.5 * strain)) / support, 1)
        return ((1 - q)**6 * (1 + 6 * q + 35 / 3 * q**2)).sum()

    return (kernel_sum(step) + kernel_sum(-step) - 2 * kernel_sum(0)) / step**2 / kernel_sum(0)


def stokes(r):
    """Stream functions of Stokes flow over sin(theta), with two derivatives."""
    (first,), (inverse,), (third,) = (powers(r, m) for m in (1, -1, 3))
    return first, inverse, (r * np.log(r), np.log(r) + 1, 1 / r), third


def box(length, width, x0, waves=160):
    """Of the Stokes flow of a force at x0 in the box: its parts r and r^3 over the part r ln r, from Fourier series."""
    kx = np.pi * np.arange(1, int(waves * length / np.pi))[:, None] / length
    ky = 2 * np.pi * np.arange(1, int(waves * width / (2 * np.pi)))[None, :] / width
    k = np.hypot(kx, ky)
    modes = 4 / (length * width) * ky**2 / k**4 * np.sin(kx * x0)**2 * j0(k) * np.exp(-(0.02 * k)**2)
    r = np.array([1.0, 1.5, 2.0, 2.5, 3.0])
    # mean velocity over circles, without the part r ln r
    rest = np.array([(modes * j0(k * one)).sum() for one in r]) + (np.log(r) + 0.5) / (4 * np.pi)
    first, third, _ = np.linalg.lstsq(np.column_stack([np.ones(5), 2 * r**2, r**4]), rest, rcond=None)[0]
    return -4 * np.pi * first, -4 * np.pi * third
