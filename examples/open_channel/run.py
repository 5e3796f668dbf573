#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Plane Poiseuille flow of a Newtonian and a micropolar fluid from an inlet to an outlet: profiles, pressure, mass.

    ./sphd run open_channel          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "poiseuille")]
from exact import Channel                   # noqa: E402
from run_lammps import Example, csv_rows, frames, pyplot, save      # noqa: E402

MU, LENGTH = 0.1, 4.0
FLUIDS = {"newtonian": (0.0, 0.05), "micropolar": (0.1, 0.05)}     # mu_r, gamma1; K H = 2
TITLES = {"newtonian": "Newtonian", "micropolar": "$\\mu_r = \\mu$, $\\gamma_1 = \\mu H^2/2$"}
SUPPORT = {20: 5.0, 40: 6.0}                # rows across: support radius over particle spacing
SIZE = 40
SMALL, SMALL_SPIN, SMALL_GRADIENT = 0.01, 0.02, 0.01
COARSE = 3                                  # the errors with half the rows are larger by this


class Run:
    """One channel: mean profiles of the last fourth of the run, pressure along the channel, balance of particles."""

    def __init__(self, out, name, n, fluid):
        self.n = n
        mu_r, gamma1 = FLUIDS[fluid]
        self.exact = Channel(MU, mu_r, gamma1, f=2 * MU)
        found = list(frames(out / f"{name}.particles.txt").values())
        x, y, u, v, p = (np.concatenate([frame[column] for frame in found]) for column in ("x", "y", "vx", "vy", "v_p"))
        row = np.clip(np.digitize(y, np.linspace(-1, 1, n + 1)) - 1, 0, n - 1)
        count = np.bincount(row, minlength=n)
        self.y, self.u = (np.bincount(row, value, n) / count for value in (y, u))
        self.error = self.relative(u, self.exact.u(y), self.u, self.exact.u(self.y))
        self.across = np.linalg.norm(v) / np.linalg.norm(u)
        self.spin_error = None
        if mu_r > 0:
            spin = np.concatenate([frame["omegaz"] for frame in found])
            self.spin = np.bincount(row, spin, n) / count
            self.spin_error = self.relative(spin, self.exact.spin(y), self.spin, self.exact.spin(self.y))
        # along the channel: means of slices, a straight line through those away from the ends
        edges = np.linspace(0, LENGTH, 41)
        slices = np.clip(np.digitize(x, edges) - 1, 0, 39)
        self.x, self.p = (np.bincount(slices, value, 40) / np.bincount(slices, minlength=40) for value in (x, p))
        middle = (x > 0.5) & (x < LENGTH - 0.5)
        self.gradient = np.polyfit(x[middle], p[middle], 1)[0] / (-2 * MU) - 1
        history = np.loadtxt(out / f"{name}.history.txt")
        self.mass, self.mass_in, self.mass_out, self.lost = history[:, 2:6].T
        last = len(history) // 2
        self.flux = (self.mass_out[-1] - self.mass_out[last]) / (self.mass_in[-1] - self.mass_in[last]) - 1

    @staticmethod
    def relative(each, wanted_each, mean, wanted):
        """L2 errors of the means of the rows and of all particles."""
        return (np.linalg.norm(mean - wanted) / np.linalg.norm(wanted),
                np.linalg.norm(each - wanted_each) / np.linalg.norm(wanted_each))


def plot(path, runs):
    plt = pyplot()
    figure, axes = plt.subplots(2, 2, figsize=(9.6, 6.8))
    axes = axes.ravel()
    fine = np.linspace(-1, 1, 401)
    for color, fluid in zip(("k", "C3"), FLUIDS):
        run = runs[fluid, max(n for name, n in runs if name == fluid)]
        axes[0].plot(fine, run.exact.u(fine), "-", color=color)
        axes[0].plot(run.y, run.u, "o", color=color, ms=4, mfc="none", label=TITLES[fluid])
        if run.spin_error:
            axes[1].plot(fine, run.exact.spin(fine), "-", color=color)
            axes[1].plot(run.y, run.spin, "o", color=color, ms=4, mfc="none")
        axes[2].plot(run.x, (run.p - 0.5) / MU, "o", color=color, ms=4, mfc="none")
        start = run.mass[0] + run.mass_out[0] - run.mass_in[0]
        axes[3].plot(run.mass_in, 1e3 * (run.mass / start - 1), "-", color=color, lw=0.8)
    axes[2].plot([0, LENGTH], [2 * LENGTH, 0], "k--", lw=0.8, label="$-2\\mu U/H^2$")
    axes[0].set(xlabel="height $y/H$", ylabel="velocity $u\\,/\\,U$", ylim=(0, 1.25), title=f"{run.n} rows; lines: exact")
    axes[1].set(xlabel="height $y/H$", ylabel="spin $\\Omega H/U$", title="line: exact")
    axes[2].set(xlabel="place along the channel, $x/H$", ylabel="pressure $(p - p_\\mathrm{out}) H/(\\mu U)$")
    axes[3].set(xlabel="mass that has entered, over $\\rho H^2$", title="change of the mass in the channel, $10^{-3}$")
    axes[0].legend(loc="upper center")
    axes[2].legend()
    save(figure, path)


def main():
    example = Example(HERE, "Plane Poiseuille flow from an inlet to an outlet.")
    args = example.arguments()
    sizes = [n for n in SUPPORT if not args.quick or n < SIZE]
    keys = [(fluid, n) for fluid in FLUIDS for n in reversed(sizes)]
    example.run({f"{fluid}.n{n}": {"n": n, "support": SUPPORT[n], **dict(zip(("mu_r", "gamma1"), FLUIDS[fluid]))}
                 for fluid, n in keys})
    runs = {(fluid, n): Run(example.out, f"{fluid}.n{n}", n, fluid) for fluid, n in keys}

    table = example.out / "errors.csv"
    with csv_rows(table, ["fluid", "n", "support", "u_error", "u_error_each", "spin_error", "spin_error_each", "gradient",
                          "across", "out_over_in", "lost"]) as writerow:
        for (fluid, n), run in runs.items():
            spin = run.spin_error or ("", "")
            writerow([fluid, n, SUPPORT[n], *(value if value == "" else f"{value:.5f}" for value in
                                             (*run.error, *spin, run.gradient, run.across, run.flux)),
                      f"{np.abs(run.lost).max():g}"])
            print(f"{fluid}, n = {n}: error of u {run.error[0]:.4f} (every particle {run.error[1]:.4f})"
                  + (f", of the spin {spin[0]:.4f} ({spin[1]:.4f})" if run.spin_error else "")
                  + f"; pressure gradient over the exact one - 1: {run.gradient:.4f}; v/u {run.across:.4f};"
                  f" flux out over in - 1: {run.flux:.4f}; particles lost {np.abs(run.lost).max():g}")
    shown = max(sizes)
    for fluid in FLUIDS:
        run = runs[fluid, shown]
        coarse = 1 if shown == SIZE else COARSE
        example.merit(f"{fluid}: error of the velocity, n = {shown}", run.error[0], 0.0, coarse * SMALL)
        example.merit(f"{fluid}: pressure gradient over the exact one - 1, n = {shown}", abs(run.gradient), 0.0, coarse * SMALL_GRADIENT)
        if run.spin_error:
            example.merit(f"{fluid}: error of the spin, n = {shown}", run.spin_error[0], 0.0, coarse * SMALL_SPIN)
        example.merit(f"{fluid}: particles lost, n = {shown}", np.abs(run.lost).max(), 0.0, 0.0)
    picture = example.out / "open_channel.png"
    plot(picture, runs)
    return example.finish(picture, table)


if __name__ == "__main__":
    sys.exit(main())
