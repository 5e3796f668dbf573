#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Brownian motion in a fluctuating fluid, against the drag on the same particle in the same fluid without noise.

    ./sphd run brownian          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, frames      # noqa: E402

MU, T, PULL, DT = 2.0, 0.2, 4.0, 0.01
CELL = 2**(1 / 3)                             # of the bcc lattice of density 1
# by width of the box in cells: steps with noise, and how many particles are pulled, each from the same state
RUNS, QUICK = {6: (300000, 12), 8: (2000, 12), 10: (2000, 6)}, {6: (10000, 3)}
PULLED = 3000                                 # steps of each
NAMES = {2: "heavy", 1: "of the fluid"}
FORCES = {2: PULL, 1: 0.4 * PULL}             # on a particle of each type
HASIMOTO = 2.837297                           # periodic array of Stokeslets, simple cubic
SEEDS = 4712, 4713                            # of more runs with noise of the narrowest box
LAGS = 3.0, 6.0                               # longer than the momentum stays in the box
PIECES = 8
COLUMNS = "length", "mobility", "mobility_error", "radius", "diffusion", "error"


def paths(path):
    """Times and positions [frame, particle, 3], particles in the order of their IDs, and these."""
    found = frames(path)
    order = [np.argsort(f["id"]) for f in found.values()]
    x = np.array([np.stack([f[c][o] for c in ("xu", "yu", "zu")], axis=1) for o, f in zip(order, found.values())])
    first = next(iter(found.values()))
    return DT * np.array(list(found)), x, first["id"][order[0]].astype(int), first.get("type", first["id"])[order[0]]


def spread(x, lag):
    """Mean square displacement of each particle over that many frames."""
    return np.mean(np.sum((x[lag:] - x[:-lag])**2, axis=2), axis=0)


def diffusion(step, samples, near, far):
    """Half the slope of the mean square displacement per direction between two times, and its standard error."""
    a, b = round(near / step), round(far / step)
    pieces = np.array([np.mean(spread(p, b) - spread(p, a)) for x in samples for p in np.array_split(x, PIECES)])
    pieces /= 6 * step * (b - a)
    return pieces.mean(), pieces.std() / np.sqrt(len(pieces) - 1)


def mobility(folder, name, pull, count):
    """Mean velocity over force of the pulled particles, after they have begun to move steadily, and its standard error."""
    speeds = []
    for number in range(count):
        time, x, *_ = paths(folder / f"{name}.{number}.dump")
        first = len(time) // 8
        speeds.append((x[-1, 0] - x[first, 0])[number % 3] / (time[-1] - time[first]) / pull)
    return np.mean(speeds), np.std(speeds) / np.sqrt(count - 1)


def drag(radius, length):
    """Mobility times 6 pi mu of a sphere in a periodic cube, to the third order in radius over length."""
    return 1 / radius - HASIMOTO / length + 4 * np.pi / 3 * radius**2 / length**3


def hydrodynamic_radius(mobility, length):
    radius = 0.5
    for _ in range(60):
        radius = 1 / (6 * np.pi * MU * mobility + HASIMOTO / length - 4 * np.pi / 3 * radius**2 / length**3)
    return radius


def plot(path, found):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update({"font.size": 9, "legend.fontsize": 8})
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 3.5), layout="constrained")
    for index, ((cells, kind), r) in enumerate((key, r) for key, r in found.items() if "lags" in r and key[1] == 2):
        left.plot(r["lags"], r["spread"], f"C{index}.", ms=4, label=f"heavy particle, L = {r['length']:.2f}")
        left.plot(r["lags"], 6 * T * r["mobility"] * r["lags"], f"C{index}", lw=0.9)
    left.set(xlabel="$t$", title="mean square displacement; lines $6 k_BT\\,(U/F)\\,t$", xlim=(0, None), ylim=(0, None))
    for kind, color in ((2, "C0"), (1, "C2")):
        mine = [r for (_, k), r in found.items() if k == kind]
        inverse = np.array([1 / r["length"] for r in mine])
        right.errorbar(inverse, [6 * np.pi * MU * r["mobility"] for r in mine], color=color, fmt="s", mfc="none",
                       yerr=[6 * np.pi * MU * r["mobility_error"] for r in mine], label=f"drag, {NAMES[kind]}")
        shown = [r for r in mine if "diffusion" in r]
        right.errorbar([1 / r["length"] for r in shown], [6 * np.pi * MU * r["diffusion"] / T for r in shown],
                       [6 * np.pi * MU * r["error"] / T for r in shown], color=color, fmt=".",
                       label=f"diffusion, {NAMES[kind]}")
        x = np.linspace(1e-9, 1.1 * inverse.max(), 60)
        right.plot(x, drag(mine[-1]["radius"], 1 / x), color, lw=0.9)
    right.set(xlabel="$1/L$", title="$6\\pi\\mu\\,U/F$ and $6\\pi\\mu\\,D/k_BT$")
    for axes in (left, right):
        axes.grid(alpha=0.3)
        axes.legend()
    figure.savefig(path, dpi=90)
    plt.close(figure)


def main():
    example = Example(HERE, "Brownian motion and drag.")
    args = example.arguments()
    runs = QUICK if args.quick else RUNS
    noisy = {f"box{cells}": {"cells": cells, "steps": steps, "T": T, "dt": DT} for cells, (steps, _) in runs.items()}
    narrow = f"box{min(runs)}"
    example.run({**noisy, **{f"{narrow}.{seed}": {**noisy[narrow], "seed": seed} for seed in SEEDS}})
    pulled = {}
    for cells, (_, count) in runs.items():
        _, _, ids, types = paths(example.out / f"box{cells}.all.dump")
        for kind in (2, 1):
            mine = ids[types == kind]
            # the heavy ones in turn in all directions; particles of the fluid all over the box
            for number in range(count):
                one = mine[number // 3 if kind == 2 else number * len(mine) // count]
                pulled[f"pull{cells}.{kind}.{number}"] = {
                    "start": f"box{cells}", "T": 0, "dt": DT, "steps": PULLED, "pulled": one, "pull": FORCES[kind],
                    "along": number % 3 + 1}
    example.run(pulled)

    found = {}
    for cells, (steps, count) in runs.items():
        length = cells * CELL
        for kind in (2, 1):
            r = {"length": length}
            r["mobility"], r["mobility_error"] = mobility(example.out, f"pull{cells}.{kind}", FORCES[kind], count)
            r["radius"] = hydrodynamic_radius(r["mobility"], length)
            if steps > 10000:
                samples = []
                for name in (f"box{cells}", *(f"box{cells}.{seed}" for seed in SEEDS)):
                    time, x, _, types = paths(example.out / f"{name}.{'heavy' if kind == 2 else 'all'}.dump")
                    samples.append(x if kind == 2 else x[:, types == 1])
                step = time[1] - time[0]
                r["diffusion"], r["error"] = diffusion(step, samples, *LAGS)
                if kind == 2:
                    lags = np.unique(np.linspace(1, 10.0 / step, 25).astype(int))
                    r["lags"] = step * lags
                    r["spread"] = np.array([np.mean([spread(x, lag) for x in samples]) for lag in lags])
            found[cells, kind] = r
    largest = max(runs)
    for (cells, kind), r in found.items():
        what = f"{NAMES[kind]}, L = {r['length']:.2f}: "
        print(f"{what}U/F = {r['mobility']:.5f} +- {r['mobility_error']:.5f}, hydrodynamic radius {r['radius']:.4f}")
        if cells != largest:
            off = r["radius"] / found[largest, kind]["radius"] - 1
            example.merit(what + "radius over that of the widest box, minus 1", abs(off), 0, 0.03)
        if "diffusion" in r:
            error = np.hypot(r["error"] / r["diffusion"], r["mobility_error"] / r["mobility"])
            bar = max(0.03, 3 * error)
            example.merit(f"{what}D over kT U/F (standard error {error:.3f})", r["diffusion"] / (T * r["mobility"]),
                          1 - bar, 1 + bar)
            stokes = T / (6 * np.pi * MU) * drag(found[largest, kind]["radius"], r["length"])
            example.merit(f"{what}D over Stokes and Einstein with the radius of the widest box",
                          r["diffusion"] / stokes, 1 - bar, 1 + bar)
    table = example.out / "brownian.csv"
    np.savetxt(table, [[kind, *(r.get(name, np.nan) for name in COLUMNS)] for (_, kind), r in found.items()],
               fmt="%.6g", delimiter=",", comments="", header=",".join(["type", *COLUMNS]))
    picture = example.out / "brownian.png"
    plot(picture, found)
    return example.finish(table, picture)


if __name__ == "__main__":
    sys.exit(main())
