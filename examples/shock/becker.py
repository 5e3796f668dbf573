#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Shock waves in an ideal gas that conducts heat, Prandtl number 3/4, against the exact profile of Becker.

    SPHD_LMP=path/to/lmp python3 becker.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from fractions import Fraction
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, frames, pyplot, save      # noqa: E402

GAMMA = 1.4                                  # as in the input
MACHS = (1.5, 2.0)
SHARES = {"0": "kappa alone", "1/3": "shear term alone", "3/4": "4/3 mu, no kappa"}    # of mu in lambda + 2 mu
REACH = 2.0                                  # thicknesses to both sides of the middle that are compared
PROFILE, PLACE = 0.005, 0.01                # rms over the jump; thicknesses. Twice as much with --quick


class Becker:
    """R. Becker, Z. Phys. 8, 321 (1922), in the frame of the shock; density, speed of sound and temperature before it are 1, its
    thickness, the jump of the velocity over the largest slope, is 1. In the mass m = integral of density dx the velocity is that
    of a hyperbolic tangent; u^2/2 + cp T is constant."""

    def __init__(self, mach):
        self.u0, self.u1 = mach, ((GAMMA - 1) * mach**2 + 2) / ((GAMMA + 1) * mach)
        self.jump = self.u0 - self.u1
        self.width = self.u0 * (np.sqrt(self.u0) - np.sqrt(self.u1)) / (np.sqrt(self.u0) + np.sqrt(self.u1)) / self.jump
        m = np.linspace(-40, 40, 40001)
        self.table_u = self.u1 + self.jump / (1 + np.exp(-m))
        self.table_x = self.width / self.u0 * (self.u1 * m + self.jump * np.logaddexp(0, m))
        middle = np.interp(np.sqrt(self.u0 * self.u1), self.table_u, self.table_x)      # where the slope is largest
        self.start = middle - self.width * (self.jump * np.logaddexp(0, -10) - self.u1 * 10) / self.u0     # in the input
        self.table_x -= middle

    def velocity(self, x):
        return np.interp(x, self.table_x, self.table_u)

    def temperature(self, u):
        return 1 + (GAMMA - 1) * (self.u0**2 - u**2) / 2

    def quarters(self, x, u):
        """Distance between a quarter and three quarters of the jump."""
        return np.ptp(np.interp([self.u1 + 0.25 * self.jump, self.u1 + 0.75 * self.jump], u, x))


class Run:
    def __init__(self, mach, share, n, sweep):
        self.mach, self.share, self.n = mach, share, n
        self.exact = Becker(mach)
        self.name = f"becker.M{mach}.{share.replace('/', '_')}"
        self.variables = {"mach": mach, "share": f"{float(Fraction(share)):.15g}", "n": n, "sweep": sweep}

    def measure(self, out):
        words = (out / f"{self.name}.end.txt").read_text().split()
        time, self.steps = float(words[2]), int(words[4])
        (frame,) = frames(out / f"{self.name}.dump").values()
        exact, order = self.exact, np.argsort(np.abs(frame["x"]))
        x, u, rho, T = (values[order] for values in (np.abs(frame["x"]), exact.u1 + np.abs(frame["vx"]), frame["c_property[1]"],
                                                     frame["c_property[2]"]))
        at = np.flatnonzero(u > np.sqrt(exact.u0 * exact.u1))[0]
        middle = np.interp(np.sqrt(exact.u0 * exact.u1), u[at - 40:at + 40], x[at - 40:at + 40])
        self.place = middle - exact.start - exact.u1 * time
        x -= middle
        near = np.abs(x) < REACH
        self.x, self.u, self.rho, self.T = x[near], u[near], rho[near], T[near]
        theory = exact.velocity(self.x)
        self.rms_u = np.sqrt(np.mean((self.u - theory)**2)) / exact.jump
        self.rms_T = np.sqrt(np.mean((self.T - exact.temperature(theory))**2)) / (exact.temperature(exact.u1) - 1)
        self.thickness = exact.quarters(self.x, self.u) / exact.quarters(exact.table_x, exact.table_u)


def plot(path, runs):
    plt = pyplot()
    figure, axes = plt.subplots(1, 2, figsize=(9.2, 3.8))
    x = np.linspace(-REACH, REACH, 1000)
    for color, mach in zip(("C0", "C1"), MACHS):
        exact = Becker(mach)
        u = exact.velocity(x)
        axes[0].plot(x, exact.u0 / u, "k-", lw=0.8)
        axes[1].plot(x, exact.temperature(u), "k-", lw=0.8)
        for shift, mark, share in zip((0, 1, 2), "osx", SHARES):
            for run in runs:
                if (run.mach, run.share) == (mach, share):
                    some = slice(shift * len(run.x) // 60, None, len(run.x) // 20)
                    axes[0].plot(run.x[some], run.rho[some], mark, color=color, ms=5, mfc="none", label=f"M = {mach}, {SHARES[share]}".replace("mu", "$\\mu$").replace("kappa", "$\\kappa$"))
                    axes[1].plot(run.x[some], run.T[some], mark, color=color, ms=5, mfc="none")
    for axis, label in zip(axes, ("density", "temperature")):
        axis.set_xlabel("distance from the shock / thickness")
        axis.set_ylabel(f"{label} / that before the shock")
    axes[0].legend()
    return save(figure, path)


def main():
    example = Example(HERE, "Shock waves in an ideal gas that conducts heat.")
    args = example.arguments()
    n, sweep = (10, 3) if args.quick else (20, 10)
    runs = [Run(mach, share, n, sweep) for share in list(SHARES)[::-1] for mach in MACHS]
    example.run({run.name: run.variables for run in runs}, {run.name: HERE / "in.shock_becker" for run in runs})
    table = example.out / "becker.csv"
    print(f"\n{n} particle distances in a thickness before the shock\n"
          "\nMach   lambda + 2 mu of    steps   thickness   velocity, rms   temperature, rms   place of the shock")
    with csv_rows(table, ["mach", "mu_over_lambda_plus_2mu", "spacings", "steps", "thickness_over_exact", "rms_velocity", "rms_temperature",
                          "place_less_exact"]) as writerow:
        for run in runs:
            run.measure(example.out)
            row = [f"{run.thickness:.4f}", f"{run.rms_u:.5f}", f"{run.rms_T:.5f}", f"{run.place:.5f}"]
            writerow([run.mach, run.share, run.n, run.steps, *row])
            print(f"{run.mach:<6} {SHARES[run.share]:<19} {run.steps:<7} {row[0]:<11} {row[1]:<15} {row[2]:<18} {row[3]}")
    print()
    profile, place = np.multiply(2 if args.quick else 1, (PROFILE, PLACE))
    for run in runs:
        where = f"M = {run.mach}, {SHARES[run.share]}: "
        example.merit(where + "velocity, rms over the jump", run.rms_u, 0, profile)
        example.merit(where + "temperature, rms over the jump", run.rms_T, 0, profile)
        example.merit(where + "place of the shock less exact, thicknesses", run.place, -place, place)
    return example.finish(plot(example.out / "becker.png", runs), table)


if __name__ == "__main__":
    sys.exit(main())
