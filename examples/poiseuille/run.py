#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Plane Poiseuille flow of a Newtonian and of micropolar fluids: profiles and order of convergence.

    ./sphd run poiseuille          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from exact import Channel                   # noqa: E402
from run_lammps import Example, csv_rows, frames, pyplot, save      # noqa: E402

FLUIDS = {                                  # mu_r, gamma1, alpha; mu = H = 1, f = 2
    "newtonian": (0.0, 0.3, 0.0),
    "a": (0.7, 2.0, 0.0),
    "b": (1.2, 1.0, 0.0),
    "c": (1.0, 0.5, 0.0),
    "c, spin rate 1": (1.0, 0.5, 1.0),
}
RATE = "c, spin rate 1"
# rows across: support radius over particle spacing of the micropolar fluids; that of the Newtonian one, with these keywords
SUPPORT = {12: 4.0, 25: 5.0, 50: 6.0, 100: 7.0}
NEWTONIAN = {"support": 3.0, "kernel": "quintic", "shear": "mg/fr2"}
SIZE, SMALL = 50, 0.005     # the relative L2 errors at this size
SMALL_SPIN = 0.01
ORDER = 1.0                 # of both errors
OWN_ORDER = 1.8             # of that of the Newtonian fluid against the parabola of the viscosity which it has
BALANCE = 0.01              # force on the walls over the body force on the fluid, minus 1


def support(fluid, n):
    return SUPPORT[n] if FLUIDS[fluid][0] > 0 else NEWTONIAN["support"]


def title(name):
    mu_r, gamma1, alpha = FLUIDS[name]
    if mu_r == 0:
        return "Newtonian"
    return f"$\\mu_r = {mu_r:g}$, $\\gamma_1 = {gamma1:g}$" + (f", $\\alpha = {alpha:g}$" if alpha else "")


class Run:
    """One channel: mean profiles in the steady state, and their relative L2 errors."""

    def __init__(self, out, name, n, fluid):
        mu_r, gamma1, alpha = FLUIDS[fluid]
        self.exact = Channel(1.0, mu_r, gamma1, alpha, f=2.0)
        found = list(frames(out / f"{name}.particles.txt").values())
        y, u = (np.array([frame[column] for frame in found]) for column in ("y", "vx"))
        self.drift = np.abs(u[len(u) // 2:].mean() / u[:len(u) // 2].mean() - 1)
        self.wander = np.abs(y - y[0]).max() * n / 2
        edges = np.linspace(-1, 1, n + 1)
        row = np.clip(np.digitize(y.ravel(), edges) - 1, 0, n - 1)
        count = np.bincount(row, minlength=n)
        self.y, self.u = (np.bincount(row, value.ravel(), n) / count for value in (y, u))
        self.error = np.linalg.norm(self.u - self.exact.u(self.y)) / np.linalg.norm(self.exact.u(self.y))
        self.each = np.linalg.norm(u - self.exact.u(y)) / np.linalg.norm(self.exact.u(y))
        # the viscosity that the fluid has: curvature in the middle, out of reach of the walls
        middle = np.abs(self.y) < 0.5
        self.viscosity = -self.exact.f / 2 / np.polyfit(self.y[middle], self.u[middle], 2)[0]
        own = self.exact.u(self.y) * self.exact.mu / self.viscosity
        self.own_error = np.linalg.norm(self.u - own) / np.linalg.norm(own)
        self.spin_error = self.spin_each = None
        if mu_r > 0:
            spin = np.array([frame["omegaz"] for frame in found])
            self.spin = np.bincount(row, spin.ravel(), n) / count
            wanted = self.exact.spin(self.y)
            self.spin_error = np.linalg.norm(self.spin - wanted) / np.linalg.norm(wanted)
            self.spin_each = np.linalg.norm(spin - self.exact.spin(y)) / np.linalg.norm(self.exact.spin(y))
        history = np.loadtxt(out / f"{name}.history.txt")
        lower, upper, drive = history[len(history) * 3 // 4:, 3:6].mean(axis=0)
        self.balance, self.side = (lower + upper) / drive - 1, (lower - upper) / drive


def order(sizes, errors):
    """Of the errors, from the coarsest to the finest."""
    return np.log(errors[0] / errors[-1]) / np.log(sizes[-1] / sizes[0])


def plot(path, runs, sizes):
    plt = pyplot()
    figure, axes = plt.subplots(2, 2, figsize=(9.6, 7.6))
    axes = axes.ravel()
    fine = np.linspace(-1, 1, 401)
    shown = min(sizes, key=lambda n: abs(n - 25))
    for color, marker, fluid in zip(("k", "C0", "C3", "C2", "C4"), "os^vD", FLUIDS):
        run = runs[fluid, shown]
        axes[0].plot(fine, run.exact.u(fine), "-", color=color)
        axes[0].plot(run.y, run.u, marker, color=color, ms=4, mfc="none", label=title(fluid))
        mine = [n for n in sizes if (fluid, n) in runs]
        errors = [runs[fluid, n].error for n in mine]
        axes[2].loglog(mine, errors, marker + "-", color=color, ms=5, mfc="none", label=f"{title(fluid)}: {order(mine, errors):.2f}")
        if run.spin_error is not None:
            axes[1].plot(fine, run.exact.spin(fine), "-", color=color)
            axes[1].plot(run.y, run.spin, marker, color=color, ms=4, mfc="none")
            errors = [runs[fluid, n].spin_error for n in mine]
            axes[3].loglog(mine, errors, marker + "-", color=color, ms=5, mfc="none", label=f"{title(fluid)}: {order(mine, errors):.2f}")
    axes[1].plot(fine, fine, "k:", label="half of the Newtonian vorticity")
    axes[0].set(xlabel="height $y/H$", ylabel="velocity $u\\,/\\,U$", ylim=(0, 1.45), title=f"{shown} rows; lines: exact")
    axes[1].set(xlabel="height $y/H$", ylabel="spin $\\Omega H/U$", title=f"{shown} rows; lines: exact")
    axes[0].legend(loc="upper center", ncols=2)
    axes[1].legend(loc="upper left")
    from matplotlib.ticker import LogLocator, NullFormatter
    for axis, what in zip(axes[2:], ("velocity", "spin")):
        line = np.array([min(sizes), max(sizes)])
        low, high = axis.get_ylim()
        axis.set_ylim(low / 8, high)        # room for the legend
        axis.loglog(line, 0.35 * high * line[0] / line, "k--", lw=0.8, label="order 1")
        axis.set(xlabel="rows across the channel", title=f"relative L2 error of the {what}; order")
        axis.set_xticks(sizes, [str(n) for n in sizes])
        axis.xaxis.set_minor_formatter(NullFormatter())
        axis.yaxis.set_major_locator(LogLocator(subs=(1, 3)))
        axis.yaxis.set_major_formatter("{x:g}")
        axis.yaxis.set_minor_formatter(NullFormatter())
        axis.grid(which="minor", alpha=0.15)
        axis.legend(loc="lower left")
    save(figure, path)


def main():
    example = Example(HERE, "Plane Poiseuille flow of a Newtonian and of micropolar fluids.")
    args = example.arguments()
    sizes = [n for n in SUPPORT if not args.quick or n <= SIZE]
    keys = [(fluid, n) for n in sizes for fluid in FLUIDS if fluid != RATE or n <= SIZE]
    names = {(fluid, n): f"{fluid.replace(', ', '_').replace(' ', '_')}.n{n}" for fluid, n in keys}
    example.run({names[fluid, n]: {"n": n, "support": support(fluid, n), **(NEWTONIAN if FLUIDS[fluid][0] == 0 else {}),
                                   **dict(zip(("mu_r", "gamma1", "alpha"), FLUIDS[fluid]))} for fluid, n in reversed(keys)})
    runs = {(fluid, n): Run(example.out, names[fluid, n], n, fluid) for fluid, n in keys}

    table = example.out / "errors.csv"
    with csv_rows(table, ["fluid", "mu_r", "gamma1", "alpha", "n", "support", "u_error", "spin_error", "u_error_each", "spin_error_each",
                          "force", "drift", "wander"]) as writerow:
        for fluid in FLUIDS:
            print()
            for n in (n for n in sizes if (fluid, n) in runs):
                run = runs[fluid, n]
                spin = ["", ""] if run.spin_error is None else [f"{run.spin_error:.5f}", f"{run.spin_each:.5f}"]
                writerow([fluid, *FLUIDS[fluid], n, support(fluid, n), f"{run.error:.5f}", spin[0], f"{run.each:.5f}", spin[1],
                          f"{run.balance + 1:.6f}", f"{run.drift:.1e}", f"{run.wander:.3f}"])
                print(f"{fluid}, n = {n}: error of u {run.error:.5f} (every particle {run.each:.5f})"
                      + (f", of the spin {run.spin_error:.5f} ({run.spin_each:.5f})" if run.spin_error is not None else "")
                      + f"; force on the walls over body force - 1: {run.balance:.1e}; upper minus lower {run.side:.0e};"
                      f" drift {run.drift:.0e}, particles wander {run.wander:.2f} rows")
            for what, attribute in (("velocity", "error"), ("spin", "spin_error")):
                if getattr(runs[fluid, SIZE], attribute) is None:
                    continue
                mine = [n for n in sizes if (fluid, n) in runs]
                errors = [getattr(runs[fluid, n], attribute) for n in mine]
                example.merit(f"{fluid}: error of the {what}, n = {SIZE}", getattr(runs[fluid, SIZE], attribute), 0.0,
                              SMALL if what == "velocity" else SMALL_SPIN)
                example.merit(f"{fluid}: order of the error of the {what}", order(mine, errors), ORDER, 9.0)
            if FLUIDS[fluid][0] == 0:
                errors = [runs[fluid, n].own_error for n in sizes]
                print(f"{fluid}: viscosity", ", ".join(f"{runs[fluid, n].viscosity:.5f}" for n in sizes),
                      "and error against its own parabola", ", ".join(f"{e:.5f}" for e in errors))
                example.merit(f"{fluid}: order of the error of the velocity with this viscosity", order(sizes, errors), OWN_ORDER, 9.0)
            example.merit(f"{fluid}: force on the walls over body force, minus 1, n = {SIZE}", abs(runs[fluid, SIZE].balance), 0.0, BALANCE)
    print()
    picture = example.out / "poiseuille.png"
    plot(picture, runs, sizes)
    return example.finish(picture, table)


if __name__ == "__main__":
    sys.exit(main())
