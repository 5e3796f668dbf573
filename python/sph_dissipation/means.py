# SPDX-License-Identifier: GPL-2.0-only
"""Means over whole periods of a wave: what it leaves behind in second order of its velocity.

A plain mean over a period is off by the derivative of the wave's envelope, and by the error of the period: a wave whose mean is a hundredth
or less of its amplitude then hides it.  The window here is a B-spline of several periods, the mean of means of means over a
period, which suppresses both by one more power with each; a fit of the harmonics takes out what the sampling leaves.
"""
from collections import namedtuple
from math import comb, factorial

FlowMeans = namedtuple("FlowMeans", "time density eulerian transport stress")


def window(x, order):
    """B-spline of this order, of width order and integral 1: as many boxes of width 1, convolved; x: distances from its middle."""
    import numpy as np

    x = np.asarray(x, dtype=float)
    terms = [(-1)**j * comb(order, j) * np.where(x + order / 2 >= j, (x + order / 2 - j)**(order - 1), 0.0) for j in range(order + 1)]
    return np.where(abs(x) <= order / 2, sum(terms), 0.0) / factorial(order - 1)


def period_means(time, values, period, order=3, harmonics=2):
    """Times and means of values[sample, ...] over order periods around each sample that has as many on both sides, ends of the series left out.
    harmonics: of the period, that are fitted together with mean and trend, so that intervals need not divide the period.  What varies as
    a straight line in time is not changed."""
    import numpy as np

    time, values = np.asarray(time, dtype=float), np.asarray(values, dtype=float)
    if time.ndim != 1 or len(time) != len(values) or not (np.diff(time) > 0).all():
        raise ValueError("period_means(): one time for each row of values, in increasing order")
    if not period > 0 or order < 1 or harmonics < 0:
        raise ValueError("period_means(): a period > 0, an order of at least 1, and no negative number of harmonics")
    reach = 0.5 * order * period * (1 + 1e-9)
    middles = [t for t in time if t - time[0] >= 0.5 * order * period * (1 - 1e-9) and time[-1] - t >= 0.5 * order * period * (1 - 1e-9)]
    if not middles:
        raise ValueError(f"period_means(): {time[-1] - time[0]:g} of time is less than {order} periods of {period:g}")
    found = []
    for middle in middles:
        some = abs(time - middle) <= reach
        t = time[some] - middle
        if len(t) < 2 * (1 + harmonics) * order + 1:
            raise ValueError(f"period_means(): {len(t)} samples in {order} periods are too few for {harmonics} harmonics")
        angles = 2 * np.pi / period * np.outer(t, np.arange(1, harmonics + 1))
        basis = np.column_stack([np.ones(len(t)), t, np.cos(angles), np.sin(angles)])
        weights = window(t / period, order) if order > 1 else np.ones(len(t))
        # the row of the pseudo-inverse that gives the mean
        mean = np.linalg.solve(basis.T @ (weights[:, None] * basis), basis.T * weights)[0]
        found.append(np.tensordot(mean, values[some], 1))
    return np.array(middles), np.array(found)


def flow_means(time, density, velocity, period, pressure=None, **keywords):
    """Means at fixed places, of density[sample, place ...] and velocity[sample, place ..., component]: a FlowMeans with

        density, eulerian   <rho>, <u>
        transport           <rho u>/<rho>, the velocity of the mass; less <u> it is the mass flux of the wave, which in a wave without
                            vorticity is its Stokes drift
        stress              [..., i, j] <rho u_i u_j> - <rho u_i> <rho u_j>/<rho> + <p> delta_ij, the flux of momentum less that of the mean
                            flow; less the pressure of the fluid at rest it is the radiation stress.  Without pressure the first two terms

    The mean velocity of a particle is period_means() of its velocities: the Lagrangian one.  Less the Eulerian one at its place it is
    the Stokes drift."""
    import numpy as np

    density, velocity = np.asarray(density, dtype=float), np.asarray(velocity, dtype=float)
    flux = density[..., None] * velocity
    times, mean_density = period_means(time, density, period, **keywords)
    eulerian, mean_flux, stress = (period_means(time, values, period, **keywords)[1] for values in (velocity, flux, flux[..., :, None] * velocity[..., None, :]))
    stress = stress - mean_flux[..., :, None] * mean_flux[..., None, :] / mean_density[..., None, None]
    if pressure is not None:
        stress = stress + period_means(time, pressure, period, **keywords)[1][..., None, None] * np.eye(velocity.shape[-1])
    return FlowMeans(times, mean_density, eulerian, mean_flux / mean_density[..., None], stress)
