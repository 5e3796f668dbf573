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
from run_lammps import Example, frames, pyplot, save      # noqa: E402

MU, T, PULL, DT = 2.0, 0.2, 0.1, 0.01
CELL = 2**(1 / 3)                             # of the bcc lattice of density 1
RUNS, QUICK = {6: 300000, 8: 2000, 10: 2000}, {6: 10000}    # by width of the box in cells: steps with noise
# how many particles of each kind are pulled, each from the same state
PULLS, QUICK_PULLS = {2: 12, 1: 24}, {2: 4, 1: 4}
STEADY, PULLED = 300, 1000                    # steps until they move steadily, and in all
NAMES = {2: "heavy", 1: "of the fluid"}
SCATTER = {2: 0.07, 1: 0.2}                   # of one mobility, for the error of a few
HASIMOTO = 2.837297                           # periodic array of Stokeslets, simple cubic
SEEDS = (4712,)                               # of more runs with noise of the narrowest box
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


def mobility(folder, starts, kind, count):
    """Mean velocity over force of the pulled particles, once they move steadily, and its standard error.

    The velocity is what the force adds to that of the same particle without force.
    """
    speeds = []
    for start in starts:
        time, alone, ids, _ = paths(folder / f"rest.{start}.dump")
        first = np.searchsorted(time, (STEADY - 0.5) * DT)
        for number in range(count):
            _, x, one, _ = paths(folder / f"pull.{start}.{kind}.{number}.dump")
            way = (x[:, 0] - alone[:, list(ids).index(one[0])])[:, number % 3]
            speeds.append((way[-1] - way[first]) / (time[-1] - time[first]) / PULL)
    mean = np.mean(speeds)
    return mean, max(np.std(speeds), SCATTER[kind] * mean) / np.sqrt(len(speeds) - 1)


def drag(radius, length):
    """Mobility times 6 pi mu of a sphere in a periodic cube, to the third order in radius over length."""
    return 1 / radius - HASIMOTO / length + 4 * np.pi / 3 * radius**2 / length**3


def hydrodynamic_radius(mobility, length):
    radius = 0.5
    for _ in range(60):
        radius = 1 / (6 * np.pi * MU * mobility + HASIMOTO / length - 4 * np.pi / 3 * radius**2 / length**3)
    return radius


def plot(path, found):
    plt = pyplot()
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 3.5))
    for index, ((cells, kind), r) in enumerate((key, r) for key, r in found.items() if "lags" in r and key[1] == 2):
        left.plot(r["lags"], r["spread"], f"C{index}.", ms=4, label=f"heavy particle, L = {r['length']:.2f}")
        late = r["lags"] >= LAGS[0]
        line = 6 * T * r["mobility"] * (r["lags"] - r["lags"][late][0]) + r["spread"][late][0]
        left.plot(r["lags"][late], line[late], f"C{index}", lw=0.9, label="slope $6 k_BT\\,U/F$ from $t = 3$")
    left.set(xlabel="time $t$ (lj units)", ylabel="mean square displacement", xlim=(0, None), ylim=(0, None))
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
    right.set(xlabel="one over the length of the box, $1/L$", ylabel="mobility $6\\pi\\mu\\,U/F$, diffusion $6\\pi\\mu\\,D/k_BT$")
    save(figure, path, legends=(left, right))


def main():
    example = Example(HERE, "Brownian motion and drag.")
    args = example.arguments()
    runs = QUICK if args.quick else RUNS
    width = 4 if args.quick else 3      # a small version must not fail by chance
    boxes = {cells: [f"box{cells}"] for cells in runs}
    seeds = () if args.quick else SEEDS
    boxes[min(runs)] += [f"box{min(runs)}s{seed}" for seed in seeds]
    noisy = {name: {"cells": cells, "steps": steps, "T": T, "dt": DT}
             for cells, steps in runs.items() for name in boxes[cells]}
    for name, seed in zip(boxes[min(runs)][1:], seeds):
        noisy[name]["seed"] = seed
    example.run(noisy)
    pulled, count = {}, QUICK_PULLS if args.quick else PULLS
    for start in noisy:
        _, _, ids, types = paths(example.out / f"{start}.all.dump")
        calm = {"start": start, "T": 0, "dt": DT, "steps": PULLED}
        pulled[f"rest.{start}"] = {**calm, "pulled": 0}
        for kind in (2, 1):
            mine = ids[types == kind]
            for number in range(count[kind]):
                # evenly among the IDs, so that each heavy one is pulled in each direction
                one = mine[(2 * (number % 12) + number // 12) * len(mine) // 24]
                pulled[f"pull.{start}.{kind}.{number}"] = {**calm, "pulled": one, "pull": PULL, "along": number % 3 + 1}
    example.run(pulled)

    found = {}
    for cells, steps in runs.items():
        length = cells * CELL
        for kind in (2, 1):
            r = {"length": length}
            r["mobility"], r["mobility_error"] = mobility(example.out, boxes[cells], kind, count[kind])
            r["radius"] = hydrodynamic_radius(r["mobility"], length)
            if steps > 2000:
                samples = []
                for name in boxes[cells]:
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
        wide = found[largest, kind]
        if cells != largest:
            error = np.hypot(r["mobility_error"] / r["mobility"], wide["mobility_error"] / wide["mobility"])
            bar = max(0.03, width * error)
            example.merit(f"{what}radius over that of the widest box (standard error {error:.3f})",
                          r["radius"] / wide["radius"], 1 - bar, 1 + bar)
        if "diffusion" in r:
            error = np.hypot(r["error"] / r["diffusion"], r["mobility_error"] / r["mobility"])
            bar = max(0.03, width * error)
            example.merit(f"{what}D over kT U/F (standard error {error:.3f})", r["diffusion"] / (T * r["mobility"]),
                          1 - bar, 1 + bar)
            stokes = T / (6 * np.pi * MU) * drag(wide["radius"], r["length"])
            error = np.hypot(r["error"] / r["diffusion"], wide["mobility_error"] / wide["mobility"])
            bar = max(0.03, width * error)
            example.merit(f"{what}D over Stokes and Einstein with the radius of the widest box (standard error "
                          f"{error:.3f})", r["diffusion"] / stokes, 1 - bar, 1 + bar)
    table = example.out / "brownian.csv"
    np.savetxt(table, [[kind, *(r.get(name, np.nan) for name in COLUMNS)] for (_, kind), r in found.items()],
               fmt="%.6g", delimiter=",", comments="", header=",".join(["type", *COLUMNS]))
    picture = example.out / "brownian.png"
    plot(picture, found)
    return example.finish(table, picture)


if __name__ == "__main__":
    sys.exit(main())
