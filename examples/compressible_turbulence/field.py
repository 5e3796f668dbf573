#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Random velocities with prescribed spectra for particles on a cubic lattice in a periodic box of width 2 pi.

    python3 field.py velocities.txt --n 24 --dilatational 0.2 --peak 2 --seed 1

Solenoidal and dilatational part have E(k) ~ k^4 exp(-2 (k/peak)^2) and random phases; <u^2> = 1, of which the dilatational
part has the given share. The file has the form of LAMMPS's atomfile variables, one for each component: particles in the
order in which create_atoms numbers them.
"""

import argparse

import numpy as np


def velocity_field(n, share, peak, seed):
    """u[z, y, x, component] at the points (i + 1/2) 2 pi/n; the same waves for every n."""
    most = 3 * peak                    # waves beyond are left out: exp(-18)
    if n < 2 * most + 2:
        raise SystemExit(f"n = {n} is too small for waves up to {most}")
    random = np.random.default_rng(seed)
    side = np.arange(-most, most + 1)
    kz, ky, kx = np.meshgrid(side, side, side, indexing="ij")
    k = np.stack([kx, ky, kz], axis=-1).astype(float)
    size = np.linalg.norm(k, axis=-1)
    noise = random.normal(size=(*k.shape, 2)) @ np.array([1, 1j])
    inside = (size > 0) & (size <= most)
    unit = np.where(inside[..., None], k / np.where(size > 0, size, 1)[..., None], 0)
    along = unit * (unit * noise).sum(axis=-1)[..., None]
    shape = np.where(inside, np.exp(-(size / peak)**2) * size, 0)[..., None]     # E(k) = 4 pi k^2 |u_k|^2/2
    u = 0
    for part, energy in ((noise * inside[..., None] - along, 1 - share), (along, share)):
        hat = np.zeros((n, n, n, 3), complex)
        place = np.ix_(side % n, side % n, side % n)
        shift = np.exp(1j * np.pi / n * (kx + ky + kz))[..., None]
        hat[place] = part * shape * shift
        field = np.fft.ifftn(hat, axes=(0, 1, 2)).real
        u = u + field * np.sqrt(energy / (field**2).sum(axis=-1).mean())
    return u


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", help="three files: FILE.x, FILE.y, FILE.z")
    parser.add_argument("--n", type=int, default=24, help="particles per side (%(default)s)")
    parser.add_argument("--dilatational", type=float, default=0.2, help="share of the energy (%(default)s)")
    parser.add_argument("--peak", type=int, default=2, help="wave number (%(default)s)")
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    write(args.file, args.n, args.dilatational, args.peak, args.seed)


def write(name, n, share=0.2, peak=2, seed=1):
    u = velocity_field(n, share, peak, seed).reshape(-1, 3)
    for component, letter in enumerate("xyz"):
        with open(f"{name}.{letter}", "w") as file:
            file.write(f"{len(u)}\n")
            file.writelines(f"{i} {value:.9g}\n" for i, value in enumerate(u[:, component], 1))


if __name__ == "__main__":
    main()
