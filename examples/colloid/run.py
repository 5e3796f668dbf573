#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""A disc in a fluctuating fluid: equipartition, and diffusion against the mobility in the same box, for two bulk viscosities.

    ./sphd run colloid          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, pyplot, save, thermo      # noqa: E402

T, MU, DT, EVERY, PARTICLES = 0.001, 0.07, 0.03125, 32, 100     # those of in.colloid
KAPPA = {"zero": 0.0, "ten": 0.7}               # bulk viscosity: 0 and 10 mu
SEEDS, STEPS, STARTS = range(1, 17), 960000, 15  # runs of each fluid, steps, and configurations of each in which the disc is pulled
QUICK = (1,), 48000, 2
PULL, PULLED = 0.002, 3200                      # force, and steps
SETTLE = 200                                    # outputs before the means
LAGS = 30, 80                                   # outputs, of the slopes; the momentum spreads in 36
PIECES = 10                                     # of each run, for the standard errors
WIDTH = 3                                       # standard errors, of the bars; 5 in a small version, which must not fail by chance


def mean(values):
    """and standard error"""
    values = np.asarray(values)
    return values.mean(), values.std(ddof=1) / np.sqrt(len(values))


def spread(x, lags):
    """mean square displacement per direction"""
    return np.array([np.mean((x[lag:] - x[:-lag])**2) if lag else 0.0 for lag in lags])


class Fluid:
    def __init__(self, out, name, seeds, starts):
        self.lags, translation, rotation, spreads = np.arange(LAGS[1] + 11), [], [], []
        for seed in seeds:
            log = thermo((out / f"{name}_{seed}.log").read_text())[-1]
            mass, inertia = log["v_M"][0], log["v_I"][0]
            x, y, u, v, o = np.loadtxt(out / f"{name}_{seed}.probe.txt").T[1:, SETTLE:]
            for piece in np.array_split(np.arange(len(x)), PIECES):
                translation.append(mass * np.mean(u[piece]**2 + v[piece]**2) / 2 / T / (1 - mass / PARTICLES))
                rotation.append(inertia * np.mean(o[piece]**2) / T)
                spreads.append((spread(x[piece], self.lags) + spread(y[piece], self.lags)) / 2)
        ways = []
        for start in starts:
            there, back = (np.loadtxt(out / f"{what}_{start}.probe.txt")[:, 1] for what in ("there", "back"))
            # the work of the force and of its opposite on the fluid is that of PULL/(1 - mass/PARTICLES) on the disc, as the total momentum is zero
            ways.append((there - back) / 2 / PULL * (1 - mass / PARTICLES))
        near, far = LAGS
        duration = (far - near) * EVERY * DT
        self.translation, self.rotation = mean(translation), mean(rotation)
        self.diffusion = mean([(one[far] - one[near]) / 2 / duration / T for one in spreads])
        self.mobility = mean([(way[far] - way[near]) / duration for way in ways])
        self.spread, self.way = np.mean(spreads, axis=0) / 2 / T, np.mean(ways, axis=0)
        self.ratio = self.diffusion[0] / self.mobility[0]
        self.error = self.ratio * np.hypot(self.diffusion[1] / self.diffusion[0], self.mobility[1] / self.mobility[0])


def plot(path, fluids):
    plt = pyplot()
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.6, 3.8))
    for index, (name, fluid) in enumerate(fluids.items()):
        label = f"$\\kappa/\\mu$ = {KAPPA[name] / MU:.0f}"
        time = EVERY * DT * fluid.lags
        left.plot(time, fluid.spread, f"C{index}o", ms=3, mfc="none", label=f"mean square displacement$/2k_BT$, {label}")
        left.plot(time, fluid.way[:len(time)], f"C{index}-", lw=1.0, label=f"displacement$/F$, {label}")
        for place, (value, error) in enumerate((fluid.translation, fluid.rotation, (fluid.ratio, fluid.error))):
            right.errorbar(place + 0.2 * index - 0.1, value, error, color=f"C{index}", fmt="o", mfc="none", label=label if not place else None)
    for lag in LAGS:
        left.axvline(EVERY * DT * lag, color="k", lw=0.8, alpha=0.3)
    left.set(xlabel="time", xlim=(0, None), ylim=(0, None))
    right.axhline(1.0, color="k", lw=2.6, alpha=0.3)
    right.set(xticks=range(3), xticklabels=["$M V^2/k_BT$", "$I \\Omega^2/k_BT$", "$D/k_BT b$"], xlim=(-0.5, 2.5), ylim=(0.8, 1.2))
    save(figure, path, legends=(left, right))


def main():
    example = Example(HERE, "A disc in a fluctuating fluid.")
    args = example.arguments()
    seeds, steps, count = QUICK if args.quick else (SEEDS, STEPS, STARTS)
    example.run({f"{name}_{seed}": {"kappa": kappa, "steps": steps, "seed": 4710 + seed} for name, kappa in KAPPA.items() for seed in seeds})
    starts = {name: [f"{name}_{seed}_{steps // 20 * (19 - k)}" for seed in seeds for k in range(count)] for name in KAPPA}
    example.run({f"{what}_{start}": {"kappa": KAPPA[name], "start": start, "pull": force, "steps": PULLED, "seed": 100 + number}
                 for name in KAPPA for number, start in enumerate(starts[name]) for what, force in (("there", PULL), ("back", -PULL))})
    fluids = {name: Fluid(example.out, name, seeds, starts[name]) for name in KAPPA}
    table = example.out / "colloid.csv"
    print("\nkappa/mu  M V^2/kT  error   I Omega^2/kT  error   D/kT    error   mobility  error   D/kT/mobility  error")
    with csv_rows(table, ["kappa/mu", "M V^2/kT", "error", "I Omega^2/kT", "error", "D/kT", "error", "mobility", "error", "D/kT/mobility", "error"]) as writerow:
        for name, fluid in fluids.items():
            values = KAPPA[name] / MU, *fluid.translation, *fluid.rotation, *fluid.diffusion, *fluid.mobility, fluid.ratio, fluid.error
            writerow([f"{value:.5g}" for value in values])
            print("{:8.0f}  {:8.4f}  {:.4f}  {:12.4f}  {:.4f}  {:.4f}  {:.4f}  {:8.4f}  {:.4f}  {:13.3f}  {:.3f}".format(*values))
    width = 5 if args.quick else WIDTH
    one, other = fluids.values()
    change = other.diffusion[0] / one.diffusion[0]
    error = change * np.hypot(one.diffusion[1] / one.diffusion[0], other.diffusion[1] / other.diffusion[0])
    print(f"\nD of both bulk viscosities, one over the other: {change:.3f}({error:.3f})\n")
    for name, fluid in fluids.items():
        what = f"kappa/mu = {KAPPA[name] / MU:.0f}"
        for kind, (value, error_of) in (("translation", fluid.translation), ("rotation", fluid.rotation)):
            example.merit(f"{what}: temperature of the {kind}", value, 1 - width * error_of, 1 + width * error_of)
        if not args.quick:      # its pieces are too short for a standard error of D
            bar = max(0.05, width * fluid.error)
            example.merit(f"{what}: D over kT times the mobility", fluid.ratio, 1 - bar, 1 + bar)
    if not args.quick:
        bar = max(0.05, width * error)
        example.merit("D of both bulk viscosities, one over the other", change, 1 - bar, 1 + bar)
    picture = example.out / "colloid.png"
    plot(picture, fluids)
    return example.finish(table, picture)


if __name__ == "__main__":
    sys.exit(main())
