#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Angular velocity of a free disc between sliding plates without inertia, over half of the rate of shear.

    python3 reference.py [HEIGHT...]      distance of the plates, and period along them, in diameters

Stokes' equations in a periodic box that holds the channel twice, mirrored, by Fourier series; plates and disc are points whose forces,
spread by the kernel of C. S. Peskin, Acta Numerica 11, 479 (2002), give them their velocities.  Disc: no force, no torque.
"""
import sys

import numpy as np


def peskin(r):
    r = np.abs(r)
    inner = (3 - 2 * r + np.sqrt(np.maximum(1 + 4 * r - 4 * r * r, 0))) / 8
    outer = (5 - 2 * r - np.sqrt(np.maximum(-7 + 12 * r - 4 * r * r, 0))) / 8
    return np.where(r < 1, inner, np.where(r < 2, outer, 0.0))


def angular_velocity(height, cells):
    """height in diameters; cells of the grid per diameter"""
    nx, ny, h = round(height * cells), round(2 * height * cells), 1.0 / cells
    size = np.array([nx, ny]) * h
    disc = round(np.pi * cells)
    angle = 2 * np.pi * np.arange(disc) / disc
    line = np.arange(nx) * h
    plates = np.concatenate([np.column_stack([line, np.full(nx, y)]) for y in (height / 2, 3 * height / 2)])
    center = np.array([height / 2, height])
    points = np.concatenate([center + 0.5 * np.column_stack([np.cos(angle), np.sin(angle)]), plates])
    spread = []
    for axis in (0, 1):
        r = points[:, axis, None] / h - np.arange((nx, ny)[axis])
        r -= np.round(r * h / size[axis]) * size[axis] / h
        spread.append(peskin(r))
    kx, ky = np.meshgrid(2 * np.pi * np.fft.fftfreq(nx, h), 2 * np.pi * np.fft.fftfreq(ny, h), indexing="ij")
    square = kx**2 + ky**2
    square[0, 0] = np.inf    # no mean velocity: the flow is odd
    n = len(points)
    matrix = np.zeros((2, n, 2, n))
    for j in range(n):
        force = np.fft.fft2(np.outer(spread[0][j], spread[1][j]) / h**2)
        for b, k in ((0, kx), (1, ky)):
            along = force * k / square
            for a, k in ((0, kx), (1, ky)):
                u = np.fft.ifft2(((a == b) * force - k * along) / square).real
                matrix[a, :, b, j] = np.einsum("px,xy,py->p", spread[0], u, spread[1], optimize=True)
    r = points[:disc] - center
    motion = np.zeros((2, n, 3))     # of the disc
    motion[0, :disc, 0] = motion[1, :disc, 1] = 1.0
    motion[0, :disc, 2], motion[1, :disc, 2] = -r[:, 1], r[:, 0]
    wall = np.zeros((2, n))
    wall[0, disc:] = np.where(plates[:, 1] > height, height / 2, -height / 2)
    whole = np.block([[matrix.reshape(2 * n, 2 * n), -motion.reshape(2 * n, 3)], [motion.reshape(2 * n, 3).T, np.zeros((3, 3))]])
    solution = np.linalg.lstsq(whole, np.concatenate([wall.ravel(), np.zeros(3)]), rcond=1e-10)[0]
    # the kernel shifts the surface of the plates: the rate of shear is that between the same points without a disc
    plate = np.arange(n) >= disc
    alone = np.linalg.lstsq(matrix[:, plate][:, :, :, plate].reshape(2 * (n - disc), -1), wall[:, plate].ravel(), rcond=1e-10)[0]
    u = matrix[0, :disc].reshape(disc, 2, n)[:, :, plate].reshape(disc, -1) @ alone
    return -2 * solution[-1] / (u @ r[:, 1] / (r[:, 1] @ r[:, 1]))


if __name__ == "__main__":
    for height in map(int, sys.argv[1:] or ("4", "8")):
        print(height, *(f"{angular_velocity(height, cells):.4f}" for cells in (8, 12, 16)))
