"""Forces between a fluid and walls, written anew from the equations of the manual with dense arrays.

Nothing here is shared with the package.  Every pair of particles is one entry of an N x N array; the box is
periodic and wider than twice the support radius, so that only the nearest image of a particle counts.
"""

from dataclasses import dataclass, field
from math import pi

import numpy as np
from numpy.polynomial import Polynomial as P

KERNELS = {  # shape w(q), norms of W R^n in 2 and 3 dimensions
    "wendland/c2": (P([1, -1]) ** 4 * P([1, 4]), {2: 7 / pi, 3: 21 / (2 * pi)}),
    "lucy": (P([1, -1]) ** 3 * P([1, 3]), {2: 5 / pi, 3: 105 / (16 * pi)}),
}
ZERO = np.zeros(3)


@dataclass
class Fluid:
    """pair_coeff of one type."""

    rho0: float = 1.0
    c0: float = 10.0
    mu: float = 0.5
    kappa: float = 2.0  # None: intrinsic
    pb: float = 0.0
    gamma: float = None
    mu_r: float = 0.0
    gamma1: float = 0.0
    gamma2: float = 0.0


@dataclass
class Wall:
    """Arguments of fix sph/wall at one moment."""

    velocity: np.ndarray = field(default_factory=lambda: ZERO)
    rate: np.ndarray = field(default_factory=lambda: ZERO)  # of change of the velocity
    omega: np.ndarray = field(default_factory=lambda: ZERO)
    omega_rate: np.ndarray = field(default_factory=lambda: ZERO)
    point: np.ndarray = field(default_factory=lambda: ZERO)
    slip: str = "no"
    spin: object = "zero"  # "zero", "free" or the number alpha of spin rate
    gravity: np.ndarray = field(default_factory=lambda: ZERO)

    def velocity_at(self, x):
        return self.velocity + np.cross(self.omega, x - self.point)

    def acceleration_at(self, x):
        arm = x - self.point
        return self.rate + np.cross(self.omega_rate, arm) + np.cross(self.omega, np.cross(self.omega, arm))


@dataclass
class Model:
    dim: int
    fluids: list  # of type 1, 2, ...
    support: float
    style: str = "sph/bulk"
    kernel: str = "wendland/c2"
    eos: str = "linear"
    shear: str = "mg"
    bulk: str = "density"

    def kernel_at(self, r):
        """W and F = -W'/r."""
        shape, norms = KERNELS[self.kernel]
        q = np.minimum(r / self.support, 1.0)
        inside = r < self.support
        over_q = -shape.deriv() // P([0, 1])  # the slope of all these shapes is zero at the origin
        norm = norms[self.dim] / self.support ** self.dim
        return np.where(inside, norm * shape(q), 0.0), np.where(inside, norm / self.support ** 2 * over_q(q), 0.0)

    def mean(self, power):
        """Integral of r^power W over all space."""
        shape, norms = KERNELS[self.kernel]
        area = {2: 2 * pi, 3: 4 * pi}[self.dim]
        return area * norms[self.dim] * self.support**power * (shape * P([0, 1]) ** (self.dim + power - 1)).integ()(1.0)

    def intrinsic(self, fluid):
        n = self.dim
        if self.style == "sph/micropolar":
            return (1 + 2 / n) * fluid.mu - fluid.mu_r
        return {"mg": 1 + 2 / n, "mg/fr": 1 + 2 / n, "mg/fr2": 1 + 2 / n, "morris": 2 / n - 1,
                "espanol": (3 - n) * (n + 2) / (n * (n + 3))}[self.shear] * fluid.mu

    def zeta(self, fluid):
        return 0.0 if self.bulk == "none" or fluid.kappa is None else fluid.kappa - self.intrinsic(fluid)

    def pressure(self, fluid, rho, energy_per_mass):
        if self.eos == "linear":
            return fluid.c0 ** 2 * (rho - fluid.rho0) + fluid.pb
        if self.eos == "tait":
            gamma = fluid.gamma or 7.0
            return fluid.rho0 * fluid.c0 ** 2 / gamma * ((rho / fluid.rho0) ** gamma - 1.0) + fluid.pb
        heat = energy_per_mass - fluid.pb * (1.0 / fluid.rho0 - 1.0 / rho)
        return ((fluid.gamma or 1.4) - 1.0) * rho * heat + fluid.pb


@dataclass
class State:
    x: np.ndarray
    v: np.ndarray  # of the fluid; that of the walls follows from their motion
    mass: np.ndarray
    esph: np.ndarray
    type: np.ndarray
    wall: np.ndarray  # which wall a particle belongs to, -1: fluid
    length: np.ndarray
    spin: np.ndarray = None


def harmonic(a):
    a = np.asarray(a, dtype=float)
    total = a[:, None] + a
    return np.divide(2.0 * a[:, None] * a, total, out=np.zeros_like(total), where=total != 0.0)


def fading(dist, radius):
    """1 up to close to the radius, then a smooth step down to 0."""
    t = np.clip((1.0 - (dist / radius) ** 2) / 0.03, 0.0, 1.0)
    return 3 * t ** 2 - 2 * t ** 3


def curvature(r, dist, own, normal, solid, support, spacing):
    """Mean of the curvatures of the surface seen from a wall particle with the normal own, from the normals around it; r from it to all."""
    if not own.any():
        return 0.0
    radius = min(support, 3.0 * spacing)
    near = np.flatnonzero(solid & (dist < radius))
    share = fading(dist[near], radius)
    along = r[near] - np.outer(r[near] @ own, own)
    room = share @ (along ** 2).sum(axis=1)
    found = share @ (normal[near] * along).sum(axis=1) / room if room > 0.0 else 0.0
    return found if found * spacing > -0.25 else 0.0


def surface_of(model, x_from, dist, F, solid, fluid, volume):
    """Normal and depth of each wall particle, and its depth below the planes; x_from[i, j] points from i to j.

    The outer layer is what a Gaussian does not find surrounded and what looks at the fluid; the depth is the mean over
    the planes that touch it, and what a curved surface fills less of the Gaussian than a plane.
    """
    n, at = model.dim, np.flatnonzero(solid)
    spacing = volume ** (1 / n)
    normal, depth = np.zeros((len(solid), 3)), np.zeros(len(solid))
    planes = {}
    for i in at:
        radius = min(model.support, 3.0 * spacing[i])
        near = at[dist[i, at] < radius]
        width = 0.7 * spacing[i]
        gauss = volume[near] * np.exp(-dist[i, near] ** 2 / (2 * width ** 2)) / (2 * pi * width ** 2) ** (n / 2)
        gauss *= fading(dist[i, near], radius)
        inward = gauss @ x_from[i, near]
        side = F[i, fluid] @ x_from[i, fluid]
        if (gauss.sum() < 0.85 and np.linalg.norm(inward) > 0.01 * width
                and inward @ side < -0.01 * np.linalg.norm(inward) * np.linalg.norm(side)):
            planes[i] = -inward / np.linalg.norm(inward), (gauss.sum() - 0.5) * np.sqrt(2 * pi) * width
    for i in at:
        near = [j for j in planes if dist[i, j] < model.support]
        if not near:
            depth[i] = 0.45 * spacing[i]
            continue
        share = (dist[i, near] ** 2 + (0.25 * spacing[i]) ** 2) ** -4.0 * fading(dist[i, near], model.support)
        share /= share.sum()
        depth[i] = max(0.0, sum(w * (planes[j][0] @ x_from[i, j] + planes[j][1]) for w, j in zip(share, near)))
        mean = sum(w * planes[j][0] for w, j in zip(share, near))
        if np.linalg.norm(mean) < 0.1:  # half way between two surfaces
            depth[i] = 0.45 * spacing[i]
        else:
            normal[i] = mean / np.linalg.norm(mean)
    below_planes = depth.copy()
    for i in at:
        bend = curvature(x_from[i], dist[i], normal[i], normal, solid, model.support, spacing[i])
        bend /= max(1.0 + bend * depth[i], 0.5)
        known = np.clip(2.0 - abs(bend) * spacing[i] / 0.25, 0.0, 1.0)
        depth[i] = max(depth[i] + 0.5 * (n - 1) * (0.7 * spacing[i]) ** 2 * known * bend, 0.0)
    return normal, depth, below_planes


def beyond(kind, depth, d, q, weight, alike=0.01):
    """What a field q of the fluid at distances d is at the given depth behind the surface, where q ("zero") or its
    derivative ("flat") vanishes: the other one and the second derivative from the moments of q with d^3 and d^4. The
    sixth moment of d is larger by the share alike and by 0.001 depth^6 ("zero"), or by a tenth."""
    m3, m4, m5, m6 = (weight @ d ** k for k in (3, 4, 5, 6))
    moments = np.array([(weight * d ** 3) @ q, (weight * d ** 4) @ q])
    if kind == "zero":
        slope, bend = np.linalg.solve([[m4, m5], [m5, (1 + alike) * m6 + 0.001 * depth ** 6]], moments)
        return -slope * depth + bend * depth ** 2, slope
    level, bend = np.linalg.solve([[m3, m5], [m4, 1.1 * m6]], moments)
    return level + bend * depth ** 2, np.linalg.solve([[m3, m4], [m4, 1.1 * m5]], moments)[1]


def forces(model, state, walls):
    """Forces, torques, and all that leads to them."""
    n, x, number = model.dim, state.x, len(state.x)
    own = [model.fluids[t - 1] for t in state.type]
    solid = state.wall >= 0
    fluid = ~solid
    in_wall = [np.flatnonzero(state.wall == k) for k in range(len(walls))]
    spin = np.zeros((number, 3)) if state.spin is None else state.spin.copy()

    r = x[:, None] - x
    r -= state.length * np.round(r / state.length)
    dist = np.linalg.norm(r, axis=2)
    W, F = model.kernel_at(dist)
    apart = ~np.eye(number, dtype=bool)
    pairs = apart & ~(solid[:, None] & solid)
    F = np.where(pairs, F, 0.0)
    e = np.divide(r, dist[..., None], out=np.zeros_like(r), where=dist[..., None] > 0.0)

    # fluid: density and its rate of change, with the walls at their own velocity
    u = state.v.copy()
    wall_spin, acceleration, gravity = np.zeros((number, 3)), np.zeros((number, 3)), np.zeros((number, 3))
    for wall, at in zip(walls, in_wall):
        u[at] = wall.velocity_at(x[at])
        acceleration[at] = wall.acceleration_at(x[at])
        wall_spin[at] = wall.omega
        gravity[at] = wall.gravity
    c = W.sum(axis=1)
    cdot = -(F * (r * (u[:, None] - u)).sum(axis=2)).sum(axis=1)
    vol, rho = 1.0 / c, state.mass * c
    static = np.array([model.pressure(own[i], rho[i], state.esph[i] / state.mass[i]) for i in range(number)])
    viscous = np.array([model.zeta(own[i]) for i in range(number)]) * vol * cdot

    # walls: Shepard means over the fluid around them
    weight = np.where(fluid[None, :] & solid[:, None], vol * W, 0.0)
    total = weight.sum(axis=1)
    wet = total > 0.0
    safe = np.where(wet, total, 1.0)[:, None]

    def mean(values):
        values = values if values.ndim == 2 else values[:, None]
        return (weight @ values) / safe

    # mass of the fluid around times the way from it to the wall particle
    moment = (weight[..., None] * rho[None, :, None] * r).sum(axis=1) / safe
    head = ((gravity - acceleration) * moment).sum(axis=1)
    rho0 = np.array([one.rho0 for one in own])
    rho[solid] = (rho0 * mean(fluid * rho / rho0)[:, 0])[solid]
    vol[solid] = state.mass[solid] / rho[solid]
    for at in in_wall:
        dry = at[~wet[at]]
        rho[dry] = [own[i].rho0 for i in dry]
        vol[dry] = state.mass[dry] / rho[dry]
    static_mean, viscous_mean = mean(static)[:, 0], mean(viscous)[:, 0]
    static[solid] = np.where(wet, static_mean + head, 0.0)[solid]
    viscous[solid] = np.where(wet, viscous_mean, 0.0)[solid]

    # behind the surface, velocity and spin of the fluid relative to the rigid body which the wall is
    reference = np.array([mass / one.rho0 for mass, one in zip(state.mass, own)])
    normal, depth, _ = surface_of(model, -r, dist, F, solid, fluid, reference)
    virtual = u.copy()
    for wall, at in zip(walls, in_wall):
        spin[at] = wall_spin[at]
        for i in at[wet[at]]:
            near = np.flatnonzero(weight[i])
            share = weight[i, near] / total[i]
            spacing = reference[i] ** (1 / n)
            d = np.maximum(-r[i, near] @ normal[i] - depth[i], 0.25 * spacing)
            d *= max(0.45 * spacing / (share @ d), 1.0)
            relative = u[near] - wall.velocity_at(x[i] - r[i, near])
            across = relative @ normal[i]
            along = relative - np.outer(across, normal[i])
            q, slope = beyond("flat" if wall.slip == "free" else "zero", depth[i], d, along, share)
            virtual[i] += q - min(depth[i] / (share @ d), 1.0) * (share @ across) * normal[i]
            relative = spin[near] - wall.omega
            if wall.spin == "free":
                spin[i] += beyond("flat", depth[i], d, relative, share)[0]
            else:
                alpha = 0.0 if wall.spin == "zero" else wall.spin
                edge = 0.5 * alpha * np.cross(normal[i], slope)
                spin[i] += edge + beyond("zero", depth[i], d, relative - edge, share, 0.001)[0]
    uu = virtual[:, None] - virtual

    # pair forces
    VV = vol[:, None] * vol
    if model.bulk == "volume":
        push = static * vol ** 2
        central = (push[:, None] + push) + (viscous[:, None] + viscous) * VV
    else:
        push = (static + viscous) * vol ** 2
        central = push[:, None] + push
    f = (central * F)[..., None] * r
    torque = np.zeros_like(f)
    mu = harmonic([one.mu for one in own])
    along = (e * uu).sum(axis=2)[..., None] * e
    FVV = (F * VV)[..., None]
    if model.style == "sph/micropolar":
        mu_r = harmonic([one.mu_r for one in own])[..., None]
        g1, g2 = (harmonic([one.gamma1 for one in own])[..., None],
                  -harmonic([-one.gamma2 for one in own])[..., None])
        zeta1, zeta2 = 2 * (n + 2) * (mu[..., None] - mu_r), 4 * mu_r
        xi1, xi2 = (5 * (g1 + g2), g1 - g2) if n == 3 else (0.0, 2 * g1)
        contact = uu - np.cross(0.5 * (spin[:, None] + spin), r)
        central = np.where(zeta1 > 0, zeta1 * n / (n + 2) * (dist**2)[..., None] / model.mean(2), zeta1) if model.shear == "mg/fr2" else zeta1
        f -= FVV * (central * (e * contact).sum(axis=2)[..., None] * e + zeta2 * contact)
        spins = spin[:, None] - spin
        torque = FVV * (0.5 * zeta2 * np.cross(r, contact) - xi1 * (e * spins).sum(axis=2)[..., None] * e - xi2 * spins)
    elif model.shear == "mg":
        f -= (2 * (n + 2) * mu)[..., None] * FVV * along
    elif model.shear == "mg/fr":
        eta = 2 * n * (n + 2) / ((n + 1) * model.mean(1)) * mu
        f -= (eta * dist)[..., None] * FVV * along
    elif model.shear == "mg/fr2":
        f -= (2 * n / model.mean(2) * mu * dist**2)[..., None] * FVV * along
    elif model.shear == "morris":
        f -= (2 * mu)[..., None] * FVV * uu
    elif model.shear == "espanol":
        f -= (2 * (n + 2) / (n + 3) * mu)[..., None] * FVV * (uu + along)
    return {"f": f.sum(axis=1), "torque": torque.sum(axis=1), "c": c, "cdot": cdot, "rho": rho, "vol": vol,
            "virtual": virtual, "pressure": static, "v": u, "spin": spin}
