#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Angular momentum of an isolated rotating drop for three ways to dissipate.

    ./sphd run rotating_drop          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--dim 3] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, frames, pyplot, save      # noqa: E402
from swirl import Swirl                     # noqa: E402

CASES = {        # variables of the input, legend, color
    "mg": ({"shear": "mg"}, "mg", "C0"),
    "mg_bulk": ({"shear": "mg", "bulk": "density"}, "mg + bulk", "C1"),
    "morris": ({"shear": "morris"}, "morris", "C3"),
}
CORE, MU, SWIRL, SUPPORT = 0.6, (0.10, 0.02), 0.5, 4      # as in the input
CONSERVED = 1e-12        # |L - L(0)|/L(0), round-off of some 10,000 steps
TORQUE = 1e-10           # Morris: LAMMPS against the sum over all pairs, relative
INTEGRAL = 1e-3          # Morris: loss against the integral of the torque, relative
LOSS = 0.01              # Morris: L(t)/L(0) against the continuum
# Morris: torque at t = 0 against the continuum, relative, per support radius over radius of the drop. The harmonic
# mean of the viscosities acts between the fluids, a layer as wide as the support.
CONTINUUM = 0.4


def angular_velocity(r):
    return 1 + SWIRL * np.cos(np.pi * r)


def continuum_torque(dim, radius):
    """Of the Laplacian stress: minus the integral of viscosity times vorticity, (1/r) d(r^2 omega)/dr."""
    def disc(inner, outer):
        circulation = [2 * np.pi * r**2 * angular_velocity(r) for r in (inner, outer)]
        return -MU[0] * circulation[0] - MU[1] * (circulation[1] - circulation[0])
    if dim == 2:
        return disc(CORE, radius)
    height = radius * ((np.arange(4000) + 0.5) / 2000 - 1)
    return 2 * radius * np.mean([disc(np.sqrt(max(0.0, CORE**2 - z**2)), np.sqrt(radius**2 - z**2)) for z in height])


def pair_torque(frame, dim, rc):
    """The torque of the Morris form on the drop, by a sum over all pairs, that is without neighbor lists."""
    x = np.array([frame[c] for c in "xyz"]).T
    v = np.array([frame["v" + c] for c in "xyz"]).T
    norm = {2: 7 / np.pi, 3: 21 / (2 * np.pi)}[dim]
    mu = np.array(MU)[frame["type"].astype(int) - 1]
    chunks = np.array_split(np.arange(len(x)), 1 + len(x) // 500)

    def pairs(i):
        r = x[i, None] - x
        return r, np.clip(1 - np.sqrt((r**2).sum(-1)) / rc, 0, None)

    volume = np.empty(len(x))
    for i in chunks:
        r, p = pairs(i)
        volume[i] = 1 / (norm / rc**dim * (p**4 * (1 + 4 * (1 - p))).sum(1))
    torque = 0.0
    for i in chunks:
        r, p = pairs(i)
        F = 20 * norm / rc ** (dim + 2) * p**3
        mean = 2 * mu[i, None] * mu / (mu[i, None] + mu)
        f = -2 * ((mean * F * volume[i, None] * volume)[..., None] * (v[i, None] - v)).sum(1)
        torque += (x[i, 0] * f[:, 1] - x[i, 1] * f[:, 0]).sum()
    return torque


class Run:
    def __init__(self, out, name):
        data = np.loadtxt(out / f"{name}.balance.txt")
        self.t, self.L, self.torque, self.kinetic, self.inertia = data[:, 1:].T
        self.frames = list(frames(out / f"{name}.particles.txt").values())
        self.change = self.L / self.L[0] - 1
        self.rigid = self.L**2 / (2 * self.inertia)        # kinetic energy of rigid rotation with this L


def plot(path, runs, theory, dim):
    plt = pyplot()
    figure = plt.figure(figsize=(9.6, 5.8), constrained_layout=False)
    grid = figure.add_gridspec(2, 12, height_ratios=[1, 1.15], left=0.05, right=0.985, top=0.95, bottom=0.085, hspace=0.16, wspace=1.5)
    first, end = next(iter(runs.values())).frames[0], next(iter(runs.values())).t[-1]
    pictures = [("$t = 0$", first)] + [(f"{CASES[name][1]}, $t = {end:g}$", run.frames[-1]) for name, run in runs.items()]
    for column, (title, frame) in enumerate(pictures):
        axes = figure.add_subplot(grid[0, 3 * column:3 * column + 3])
        slab = np.abs(frame["z"]) < 0.12
        x, y, vx, vy = (frame[c][slab] for c in ("x", "y", "vx", "vy"))
        axes.scatter(x, y, s=9600 / len(x), lw=0, c=np.where(frame["type"][slab] == 1, "#d8a040", "#a8c4e0"))
        rings = [np.argmin((x - r * np.cos(a)) ** 2 + (y - r * np.sin(a)) ** 2)
                 for r, m in ((0.3, 6), (0.6, 12), (0.9, 18)) for a in 2 * np.pi * np.arange(m) / m]
        axes.quiver(x[rings], y[rings], vx[rings], vy[rings], angles="xy", scale_units="xy", scale=3, width=0.008, zorder=3)
        axes.set(xlim=(-1.12, 1.12), ylim=(-1.12, 1.12), aspect="equal", xticks=[], yticks=[])
        axes.set_title(title, color=CASES[list(CASES)[column - 1]][2] if column else "k")
        axes.axis("off")

    left = figure.add_subplot(grid[1, 0:4])
    middle = figure.add_subplot(grid[1, 4:8])
    right = figure.add_subplot(grid[1, 8:12])
    for name, run in runs.items():
        _, label, color = CASES[name]
        dashed = "--" if name == "mg_bulk" else "-"
        left.plot(run.t, run.L / run.L[0], dashed, color=color, label=label)
        middle.semilogy(run.t[1:], np.maximum(np.abs(run.change[1:]), 1e-16), color=color, label=label,
                        lw=1.4 if name == "morris" else 0.6)
        right.plot(run.t, run.kinetic / run.kinetic[0], dashed, color=color, label=label)
    if theory is not None:
        left.plot(*theory, "k:", lw=1.2, label="continuum, $\\eta\\nabla v$ as stress")
    run = runs["mg"]
    right.plot(run.t, run.rigid / run.kinetic[0], "k:", lw=1.0, label="$L^2/(2I)$")
    left.set(title="angular momentum $L/L(0)$", ylim=(0, 1.05))
    middle.set(title="change of $L$, relative", ylim=(5e-17, 3))
    right.set(title="kinetic energy over initial", ylim=(0, 1.05))
    for axes in (left, middle, right):
        axes.set_xlabel("time $t\\,\\Omega_0$")
        axes.set_xlim(0, run.t[-1])
    left.legend(loc="upper right", bbox_to_anchor=(1, 0.93))
    right.legend(loc="center right")
    middle.annotate("morris", (0.55 * run.t[-1], 0.3), (0.5 * run.t[-1], 1e-4), color="C3")
    middle.annotate("mg, mg + bulk", (0.35 * run.t[-1], 3e-14), color="k")
    save(figure, path)


def main():
    example = Example(HERE, "Angular momentum of an isolated rotating drop.")
    example.parser.add_argument("--dim", type=int, choices=(2, 3), default=2, help="disc (default) or ball")
    args = example.arguments()
    n, end = {(2, False): (32, 12), (2, True): (16, 4), (3, False): (12, 6), (3, True): (8, 2)}[args.dim, args.quick]
    example.run({f"{name}.{args.dim}d": {"dim": args.dim, "n": n, "end": end, **variables}
                 for name, (variables, _, _) in reversed(CASES.items())})
    runs = {name: Run(example.out, f"{name}.{args.dim}d") for name in CASES}
    morris = runs["morris"]

    # the mass of the particles is that of a drop with a somewhat larger radius, 1 + 0.6 dx
    frame = morris.frames[0]
    volume = frame["mass"].sum()
    radius = (volume / {2: np.pi, 3: 4 * np.pi / 3}[args.dim]) ** (1 / args.dim)
    print(f"\n{len(frame['x'])} particles, {args.dim}d; radius of a drop of their mass: {radius:.4f}\n")

    for name in ("mg", "mg_bulk"):
        example.merit(f"{name}: largest |L - L(0)|/L(0)", np.abs(runs[name].change).max(), 0.0, CONSERVED)
        example.merit(f"{name}: kinetic energy at the end over that of rigid rotation",
                      runs[name].kinetic[-1] / runs[name].rigid[-1], 0.999, 1.05 if args.quick or args.dim == 3 else 1.001)
    pairs = pair_torque(frame, args.dim, SUPPORT / n)
    example.merit("morris: torque at t = 0 in LAMMPS over the sum over all pairs, minus 1",
                  abs(morris.torque[0] / pairs - 1), 0.0, TORQUE)
    lost = morris.L[0] - morris.L[-1]
    integral = -np.sum(0.5 * (morris.torque[1:] + morris.torque[:-1]) * np.diff(morris.t))
    example.merit("morris: loss of L over the integral of the torque, minus 1", abs(lost / integral - 1), 0.0, INTEGRAL)
    expected = continuum_torque(args.dim, radius)
    print(f"morris: torque at t = 0 {morris.torque[0]:.5f}, of the continuum {expected:.5f}")
    example.merit("morris: torque at t = 0 over that of the continuum, minus 1", abs(morris.torque[0] / expected - 1), 0.0,
                  CONTINUUM * SUPPORT / n)

    theory = None
    if args.dim == 2:
        swirl = Swirl("laplace", *MU, CORE, radius)
        momentum = swirl.angular_momentum(swirl.evolve(angular_velocity(swirl.r), morris.t))
        theory = morris.t, momentum / momentum[0]
        example.merit("morris: largest difference of L(t)/L(0) from the continuum",
                      np.abs(1 + morris.change - theory[1]).max(), 0.0, LOSS)
        print(f"morris: lost {-100 * morris.change[-1]:.1f} % of L, the continuum {100 * (1 - theory[1][-1]):.1f} %")
    else:
        example.merit("morris: lost part of L", -morris.change[-1], 0.2 if args.quick else 0.5, 1.0)
    print()

    suffix = "" if args.dim == 2 else "_3d"
    table, picture = example.out / f"angular_momentum{suffix}.csv", example.out / f"angular_momentum{suffix}.png"
    with csv_rows(table, ["time", *(f"{what}_{name}" for name in CASES for what in ("change_of_L", "kinetic"))]) as writerow:
        for i in range(0, len(morris.t), 10):
            writerow([f"{morris.t[i]:.6g}", *(f"{value:.6e}" for name in CASES for value in
                                              (runs[name].change[i], runs[name].kinetic[i] / runs[name].kinetic[0]))])
    plot(picture, runs, theory, args.dim)
    return example.finish(picture, table)


if __name__ == "__main__":
    sys.exit(main())
