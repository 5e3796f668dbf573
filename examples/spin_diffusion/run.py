#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Spin viscosities gamma1 and gamma1 + gamma2 from the decay of waves of spin in 3d.

    ./sphd run spin_diffusion          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, pyplot, save      # noqa: E402

GAMMA1, GAMMA2, INERTIA, SUPPORT = 1.0, 0.5, 0.5, 4      # as in the input
MODES = {"transverse": GAMMA1, "longitudinal": 2 * GAMMA1 + GAMMA2}
CELLS = (20, 28, 40)
THEORY = 0.01       # of the spin viscosities, extrapolated to kh = 0


def plot(path, found, lines):
    plt = pyplot()
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.4))
    for color, (mode, points) in zip(("C0", "C3"), found.items()):
        for nx, (k, _, time, amplitude) in points.items():
            left.semilogy(MODES[mode] * k**2 / INERTIA * time, amplitude, color + "osv"[CELLS.index(nx)], mfc="none", ms=4,
                          label=f"{mode}, kh = {k * SUPPORT / 2:.2f}")
        kh = np.array([k * SUPPORT / 2 for k, _, _, _ in points.values()])
        right.plot(kh**2, [value / MODES[mode] for _, value, _, _ in points.values()], color + "o", mfc="none", label=mode)
        x = np.array([0, kh.max() ** 2])
        right.plot(x, np.polyval(lines[mode], x) / MODES[mode], color, lw=0.8)
    time = np.linspace(0, 1, 20)
    left.semilogy(time, np.exp(-time), "k", lw=0.8)
    left.set(xlabel="time over relaxation time of the continuum", ylabel="amplitude of the spin", title="line: continuum")
    right.axhline(1, color="k", lw=0.8)
    right.set(xlabel="(wave number times smoothing length)$^2$, $(kh)^2$", ylabel="spin viscosity, measured over given")
    save(figure, path, legends=(left, right))


def main():
    example = Example(HERE, "Diffusion of spin.")
    args = example.arguments()
    cells = CELLS[:2] if args.quick else CELLS
    example.run({f"{mode}.{nx}": {"mode": mode, "nx": nx} for nx in reversed(cells) for mode in MODES})
    found, lines = {}, {}
    for mode, asked in MODES.items():
        found[mode] = {}
        for nx in cells:
            words = (example.out / f"{mode}.{nx}.rate.txt").read_text().split()
            k, rate = float(words[1]), float(words[3])
            decay, amplitude = np.loadtxt(example.out / f"{mode}.{nx}.decay.txt")[:, 1:3].T
            time = decay / rate
            value = -np.polyfit(time, np.log(amplitude), 1)[0] * INERTIA / k**2
            found[mode][nx] = k, value, time, amplitude
            print(f"{mode}, kh = {k * SUPPORT / 2:.3f}: spin viscosity {value:.5f}, asked for {asked}, ratio {value / asked:.5f}")
        lines[mode] = np.polyfit([(k * SUPPORT / 2) ** 2 for k, _, _, _ in found[mode].values()],
                                 [value for _, value, _, _ in found[mode].values()], 1)
    gamma1 = lines["transverse"][1]
    both = lines["longitudinal"][1] - gamma1
    example.merit("gamma1 over the one asked for, minus 1", abs(gamma1 / GAMMA1 - 1), 0, THEORY)
    example.merit("gamma1 + gamma2 over the one asked for, minus 1", abs(both / (GAMMA1 + GAMMA2) - 1), 0, THEORY)
    picture = example.out / "spin_diffusion.png"
    plot(picture, found, lines)
    return example.finish(picture)


if __name__ == "__main__":
    sys.exit(main())
