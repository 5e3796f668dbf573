# SPDX-License-Identifier: GPL-2.0-only
"""Theory of the mean force of sound on a small cylinder in a viscous fluid, in second order of the velocity of the wave.

The cylinder is a rigid one at rest ("wall"), a rigid one that the fluid moves ("rigid"), or a drop of a second viscous fluid ("drop").
Radius of the cylinder, density and speed of sound of the fluid are 1; first order varies as exp(-i omega t).  Near the cylinder the wave
is the velocity U plus x dU/dx along x, and the pressure that belongs to it and to the body force that drives the wave.
"""

from typing import NamedTuple

import numpy as np
from scipy.special import erfc, h1vp, hankel1, iv, ive, ivp, j0, jv, jvp, kv, kve, kvp, yv


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


class Wave(NamedTuple):
    """At the place of the cylinder: velocity and its derivative; that of the shear, which the cylinders of the next periods change, over it;
    the body force per mass and its derivative."""
    velocity: complex = 1.0
    slope: complex = 1.0
    shear: float = 1.0
    push: complex = 0.0
    push_slope: complex = 0.0


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
        push: body force per mass on fluid and cylinder, the gradient of push r^m cos(m theta)"""
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

    def force(self, radius, wave=Wave(), points=1500, angles=16):
        """Mean force over pi/2, where the mean flow vanishes at this radius.

        In coordinates of the particles at rest the mean of the momentum balance is Div(P) = 0, with the first Piola stress P.  The wave
        contributes Q in second order, bilinear in the flows of U and of dU/dx; the rest is the Stokes flow of the mean velocities of the
        particles.  By the reciprocal theorem the force is the integral of -grad(u): Q, with the Stokes flow u of the same cylinder that
        is drawn along x with a mean velocity of 1.  Terms of the order omega^2 are left out."""
        x = (np.arange(points) + 0.5) / points
        t = ((np.arange(angles) + 0.5) * 2 * np.pi / angles)[None, :]
        velocity, slope, push, push_slope = wave.velocity, wave.slope, wave.push, 0.25 * wave.push_slope
        shear = 0.25 * slope * wave.shear
        a1, b1, c1, d1 = self.flow(1, velocity, push)
        a2, b2, c2, d2 = self.flow(2, shear, push_slope)
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
            plane = -0.5 * np.real((1j * omega * velocity + push) * r * np.cos(t) * np.conj(slope / (-1j * omega)))
            q -= plane * np.array([[np.sin(t)**2, np.sin(t) * np.cos(t)], [np.sin(t) * np.cos(t), np.cos(t)**2]])
            return (velocity_gradient(stream, 1, r, t) * q).sum((0, 1, 3)) @ (weight * r[:, 0]) * 2 * np.pi / angles

        def combined(*parts):
            return [sum(factor * f[d] for factor, f in parts) for d in (0, 1, 2)]

        r, weight = (1 + (radius - 1) * x**2)[:, None], (radius - 1) * 2 * x / points
        source, inside, double = 0.5 * (self.expansion - 1) * slope, self.expansion * slope, np.cos(2 * t)
        (r1,), (rm1,), (r2,), (rm2,) = (powers(r, m) for m in (1, -1, 2, -2))
        found = integral(r, weight, combined((velocity, r1), (a1, rm1), (b1, self.layer(1, r))),
                         (1j * omega * (velocity * r - a1 / r) + push * r) * np.cos(t),
                         combined((shear, r2), (a2, rm2), (b2, self.layer(2, r))), slope, source,
                         1j * omega * (r**2 * (0.25 * slope + shear * double) - a2 / r**2 * double + source * np.log(r)) + push_slope * r**2 * (1 + double),
                         combined(*zip(test, stokes(r))))
        if self.kind == "drop":
            r, weight = x[:, None], np.full(points, 1 / points)
            (r1,), (r2,), (r3,) = (powers(r, m) for m in (1, 2, 3))
            pressure1 = (1j * omega * (self.ratio * c1 - self.spring * (c1 + d1)) + self.ratio * push) * r * np.cos(t)
            pressure2 = (0.25j * omega * slope + 2 * mu * source + 2 * kappa * source + 0.25j * omega * self.ratio * inside * (r**2 - 1)
                         + self.ratio * (1j * omega * c2 + push_slope) * r**2 * double + push_slope * (1 + self.ratio * (r**2 - 1)))
            found += integral(r, weight, combined((c1, r1), (d1, self.layer_inside(1, r))), pressure1,
                              combined((c2, r2), (d2, self.layer_inside(2, r))), inside, 0.0, pressure2, combined(*zip(test_inside, (r1, r3))))
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

    def mean_force(self, length, width, x0, wave=Wave()):
        """Mean force over pi/2 in a box with free-slip walls at x = 0 and length, periodic along y, in two parts: without a steady flow that takes
        momentum away, and what the steady flow adds.  The second is linear in two numbers of the Stokes flow that the box sets."""
        radii = 8.0, 16.0, 32.0
        found = np.linalg.solve([[1, *self.drawn(radius)[0][2:]] for radius in radii], [self.force(radius, wave) for radius in radii])
        return found[0], found[1:] @ self.drawn(None, *box(length, width, x0))[0][2:]

    def steady_flow(self, length, width, x0):
        """What the steady flow around the cylinder adds to the mean force, over pi U (dU/dx)/2"""
        return self.mean_force(length, width, x0)[1]

    def expansion_and_dipole(self):
        """Mean force over pi U (dU/dx)/2 in an infinite fluid where no steady flow takes momentum away."""
        return 1 - self.expansion + self.first_order(1.0, 0.0)[0]


def scattering(kind, k, delta, ratio=1.0, c=1.0, hold=0.0, waves=6):
    """Of waves J_n(kr) cos(n theta) of pressure: the factors of H_n, and the velocity of the cylinder for n = 1, of one at rest the force on it over
    pi.  Any k: waves of pressure and of shear outside and, in a drop, inside; the attenuation of sound in the bulk is left out."""
    mu, outer, spring = 0.5 * delta**2 * k, (1 - 1j) / delta, hold**2 * (ratio + 1)
    inner = outer * np.sqrt(ratio)

    def pressure(n, q, density, f, slope):
        """velocities along r and across, stresses rr and r theta at r = 1"""
        p, p1 = f(n, q), q * slope(n, q)
        p2 = -p1 - (q * q - n * n) * p
        return np.array([p1, -n * p, -1j * k * density * p + 2 * mu * p2, -2 * n * mu * (p1 - p)]) / (1j * k * density)

    def layer(n, slope, root):
        return np.array([n, -slope, 2 * mu * n * (slope - 1), mu * (2 * slope - 2 * n * n - root**2)])

    factors, speed = np.zeros(waves, complex), 0
    for n in range(waves):
        incident, out = pressure(n, k, 1, jv, jvp), pressure(n, k, 1, hankel1, h1vp)
        outside = layer(n, -outer * (kve(n - 1, outer) + kve(n + 1, outer)) / (2 * kve(n, outer)), outer)
        if kind == "drop":
            within = pressure(n, k / c, ratio, jv, jvp)
            columns = np.column_stack([out, outside, -within, -layer(n, inner * (ive(n - 1, inner) + ive(n + 1, inner)) / (2 * ive(n, inner)), inner)])
            if n == 0:
                factors[n] = np.linalg.solve(columns[::2, ::2], -incident[::2])[0]
                continue
            mean = np.array([jv(1, k / c) / (1j * k * ratio), 1])      # velocity of its mass
            if n == 1:
                columns[2, 2:] -= 1j * k * spring * mean
            found = np.linalg.solve(columns, -incident)
            if n == 1:
                speed = mean @ found[2:]
        elif n == 0:
            found = -incident[:1] / out[0]
        elif n == 1 and kind == "rigid":
            columns = np.column_stack([out, outside, [-1, 1, 1j * k * (ratio - spring), 0]])
            rows = np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, -1]])
            found = np.linalg.solve(rows @ columns, -rows @ incident)
            speed = found[2]
        else:
            columns = np.column_stack([out, outside])
            found = np.linalg.solve(columns[:2], -incident[:2])
            if n == 1:
                speed = np.array([0, 0, 1, -1]) @ (incident + columns @ found)
        factors[n] = found[0]
    return factors, speed


def row(m, k, width):
    """Waves H_m exp(i m theta) of cylinders at the other multiples of the width along y, without their plane waves, whose mean of both sides is part of
    the wave that is there: factor of J_0 at the origin; m even.  That of J_n for H_l is the same for m = n - l.  The sum of J_m is known."""
    m, place = abs(m), np.arange(1, 4001)
    smooth = 0.5 * erfc((place - 2000) / 400)
    return (-1)**(m // 2) * (2j * (yv(m, k * width * place) * smooth).sum() - (m == 0))


def other_row(n, m, k, width, distance):
    """Of a row of such cylinders at x = -distance (behind, at +distance if it is negative), without their plane waves: factor of J_n for H_m"""
    across = 2 * np.pi * np.arange(1, 60) / width
    across = np.concatenate([across, -across])
    decay = np.sqrt(across**2 - k**2)
    turn = (1j * decay + 1j * across) / k
    turn = turn if distance > 0 else -1 / turn
    return (2 / (1j * width * decay) * np.exp(-decay * abs(distance)) * 1j**(n - m) * turn**(m - n)).sum()


def channel(kind, k, delta, ratio=1.0, c=1.0, hold=0.0, place=0.25 * np.pi, width=None, ends=None, waves=6, angles=64):
    """Mean force of a standing wave p cos(kx + place) over pi k E sin(2 place), without a steady flow, and the velocity of the cylinder over that of
    the wave, or the force over pi.  width: of a periodic box; ends: distances to free-slip walls on the left and on the right"""
    factors, speed = scattering(kind, k, delta, ratio, c, hold, waves)
    orders = list(range(1 - waves, waves))
    n = np.array(orders)
    factors = factors[abs(n)]
    wave = 0.5 * 1j**n * (np.exp(1j * place) + (-1.0)**n * np.exp(-1j * place))
    others = np.zeros((len(n), len(n)), complex)
    for one in range(-3, 4) if width else ():
        for two in range(-3, 4):
            i, j = orders.index(one), orders.index(two)
            if (one - two) % 2 == 0:
                others[i, j] += row(one - two, k, width)
            if ends:
                left, right = ends
                others[i, orders.index(-two)] += other_row(one, two, k, width, 2 * left) + other_row(one, two, k, width, -2 * right)
                others[i, j] += other_row(one, two, k, width, 2 * (left + right)) + other_row(one, two, k, width, -2 * (left + right))
    incident = np.linalg.solve(np.eye(len(n)) - others * factors, wave)
    # flux of momentum through a circle
    r, t = 3.0, (np.arange(angles) + 0.5) * 2 * np.pi / angles
    out, turn = factors * incident, np.exp(1j * np.outer(n, t))
    shape, slope = incident * jv(n, k * r) + out * hankel1(n, k * r), k * (incident * jvp(n, k * r) + out * h1vp(n, k * r))
    p, along, across = shape @ turn, slope @ turn / (1j * k), (n * shape / r) @ turn / k
    along_x = along * np.cos(t) - across * np.sin(t)
    flux = 0.25 * (abs(p)**2 - abs(along)**2 - abs(across)**2) * np.cos(t) + 0.5 * (along_x * along.conjugate()).real
    first, last = orders.index(1), orders.index(-1)
    return (-flux.sum() * r * 2 * np.pi / angles / (0.25 * np.pi * k * np.sin(2 * place)),
            2j * speed * (incident[first] - incident[last]) / (wave[first] - wave[last]))


def size(kind, k, delta, ratio=1.0, c=1.0, hold=0.0, place=0.25 * np.pi, width=None, ends=None):
    """What a finite ka and the walls add to the mean force of channel(), and by what part they raise the velocity of the cylinder or the force on it"""
    small = 0.01
    (force, speed), (force_small, speed_small) = channel(kind, k, delta, ratio, c, hold, place, width, ends), channel(kind, small * k, delta, ratio, c, hold, place, width)
    return force - force_small, abs(speed / speed_small) * (small if kind == "wall" else 1) - 1


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
