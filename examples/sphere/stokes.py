#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Drag and couple of a sphere in a simple cubic array, by Stokes' equations: a reference that has nothing of SPH.

    python3 stokes.py        drag beside the published one, and couple, for some volume fractions

Point forces inside of the sphere move the fluid.  Least squares find the forces for which the fluid at the surface moves as the rigid
sphere does.  The mean flow is zero.
"""

from functools import lru_cache

import numpy as np
from scipy.special import erfc

SPLIT, IMAGES, WAVES = 2.2, 2, 5        # of the sums below: parameter, and largest indices


def velocity(x):
    """Velocities at x (..., 3) by unit forces at the origin of each cell of a cubic lattice, (..., 3, 3); length of a cell and viscosity
    are 1.  H. Hasimoto, J. Fluid Mech. 5, 317 (1959): one sum over cells, one over waves."""
    result, unit = np.zeros((*x.shape, 3)), np.eye(3)
    for cell in np.ndindex(*(2 * IMAGES + 1,) * 3):
        d = x + np.array(cell) - IMAGES
        square = (d * d).sum(axis=-1)
        r, gauss = np.sqrt(square), SPLIT / np.sqrt(np.pi) * np.exp(-SPLIT**2 * square)
        near = 2 * gauss / square + erfc(SPLIT * r) / (square * r)
        result += (near * square - 4 * gauss)[..., None, None] * unit + near[..., None, None] * d[..., :, None] * d[..., None, :]
    for wave in np.ndindex(*(2 * WAVES + 1,) * 3):
        k = 2 * np.pi * (np.array(wave) - WAVES)
        square = k @ k
        if 0 < square < (2 * np.pi * (WAVES + 0.01))**2:
            far = 8 * np.pi * (1 + square / (2 * SPLIT)**2) * np.exp(-square / (2 * SPLIT)**2) / square**2
            result += np.cos(x @ k)[..., None, None] * far * (square * unit - np.outer(k, k))
    return result / (8 * np.pi)


def sphere(count):
    """count points on the unit sphere, on a spiral"""
    z, angle = 1 - (2 * np.arange(count) + 1) / count, np.pi * (1 + np.sqrt(5)) * np.arange(count)
    return np.stack([np.sqrt(1 - z * z) * np.cos(angle), np.sqrt(1 - z * z) * np.sin(angle), z], axis=1)


@lru_cache(maxsize=None)
def array(phi, forces=150):
    """Drag over that of Stokes, and couple over that of a single sphere, for a volume fraction phi"""
    a = np.cbrt(3 * phi / 4 / np.pi)
    inside, surface = 0.65 * a * sphere(forces), a * sphere(2 * forces)
    matrix = velocity(surface[:, None] - inside).swapaxes(1, 2).reshape(6 * forces, 3 * forces)
    moves = np.zeros((*surface.shape, 2))
    moves[:, 0, 0] = 1.0                                            # along x
    moves[:, :2, 1] = np.stack([-surface[:, 1], surface[:, 0]], 1)  # about z
    along, about = np.linalg.lstsq(matrix, moves.reshape(-1, 2), rcond=1e-12)[0].T.reshape(2, forces, 3)
    return along[:, 0].sum() / (6 * np.pi * a), (inside[:, 0] * about[:, 1] - inside[:, 1] * about[:, 0]).sum() / (8 * np.pi * a**3)


if __name__ == "__main__":
    print("phi      drag     Zick and Homsy  couple   (1 - phi) couple")
    for phi, published in ((0.001, 1.212), (0.008, 1.525), (0.064, 2.810), (0.125, 4.292), (0.216, 7.442)):
        drag, couple = array(phi, 300)
        print(f"{phi:.3f}  {drag:7.4f}   {published:7.3f}        {couple:.5f}  {(1 - phi) * couple:.5f}")
