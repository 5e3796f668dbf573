#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Viscous shock waves in an ideal gas without heat conduction, against the exact profile.

    ./sphd run shock       or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, frames, pyplot, save      # noqa: E402

GAMMA, MACH = 1.4, 2.0                       # as in the input
U1 = MACH
U2 = U1 * ((GAMMA - 1) * MACH**2 + 2) / ((GAMMA + 1) * MACH**2)
DENSITY, ENERGY_1 = U1 / U2, 1 / (GAMMA * (GAMMA - 1))
VISCOSITIES = (0.008, 0.016, 0.032)
CASES = {      # title: keywords of the integrator, whether the shear term has the viscosity
    "bulk term, sdirk2": ("viscous implicit scheme sdirk2", "no"),
    "shear term, sdirk2": ("viscous implicit scheme sdirk2", "yes"),
    "bulk term, rkl2": ("viscous rkl2", "no"),
    "bulk term, explicit": ("viscous explicit", "no"),
}
THICKNESS, PLATEAU, PROFILE = 0.03, 0.005, 0.01


def exact(u, viscosity):
    """Place of the velocity u in the frame of the shock, which is steady; zero at the steepest place.

    Mass, momentum and energy are integrals, with e = Q/m + u^2/2 - P u/m, what is left of the momentum is
    viscosity u' = (gamma + 1)/2 m (u - U1) (u - U2)/u, B. M. Johnson, J. Fluid Mech. 726, R4 (2013)."""
    def place(u):
        return 2 * viscosity / ((GAMMA + 1) * U1 * (U1 - U2)) * (U1 * np.log(U1 - u) - U2 * np.log(u - U2))
    return place(u) - place(np.sqrt(U1 * U2))


def thickness(viscosity):
    """Between a quarter and three quarters of the jump of the velocity."""
    return exact(U2 + 0.25 * (U1 - U2), viscosity) - exact(U2 + 0.75 * (U1 - U2), viscosity)


def energy(u):
    """Internal energy per mass at the velocity u."""
    p1 = 1 / GAMMA
    momentum, total = U1**2 + p1, U1 * (ENERGY_1 + U1**2 / 2) + p1 * U1
    return total / U1 + u**2 / 2 - momentum * u / U1


class Run:
    def __init__(self, title, viscosity, n):
        self.title, self.viscosity = title, viscosity
        viscous, shear = CASES[title]
        self.name = f"{title.replace(', ', '.').replace(' ', '_')}.{viscosity}"
        self.variables = {"viscosity": viscosity, "shear": shear, "viscous": viscous, "n": n}

    def measure(self, out):
        words = (out / f"{self.name}.end.txt").read_text().split()
        self.steps = int(words[4])
        (frame,) = frames(out / f"{self.name}.dump").values()
        order = np.argsort(frame["x"])
        x, v, rho, e = (frame[key][order] for key in ("x", "vx", "c_property[1]", "c_property[2]"))
        e = e / frame["mass"][order]
        d = thickness(self.viscosity)
        u = U2 - v                                            # the shock on the right goes with U2 to the right
        at = np.sqrt(U1 * U2)
        near = (x > 0.05) & (x < 0.55)
        x, u, rho, e = x[near], u[near], rho[near], e[near]
        k = np.flatnonzero((u[:-1] < at) & (u[1:] >= at))[0]
        self.middle = np.interp(at, u[k:k + 2], x[k:k + 2])
        self.x, self.u, self.rho, self.e = x - self.middle, u, rho, e
        rise = np.abs(self.x) < 3 * d
        quarters = np.interp([U2 + 0.25 * (U1 - U2), U2 + 0.75 * (U1 - U2)], u[rise], self.x[rise])
        self.thickness = (quarters[1] - quarters[0]) / d
        behind = (self.x < -4 * d) & (x > 0.08)     # nearer to x = 0 the start is seen
        self.density = rho[behind].mean() / DENSITY
        reach = np.abs(self.x) < 5 * d
        theory = np.array([brentq(lambda w, s=s: exact(w, self.viscosity) + s, U2 + 1e-14, U1 - 1e-14) for s in self.x[reach]])
        self.profile = np.sqrt(np.mean((u[reach] - theory)**2)) / (U1 - U2)
        self.heat = np.abs(e[reach] - energy(u[reach])).max() / (energy(U2) - ENERGY_1)


def plot(path, runs):
    plt = pyplot()
    figure, axes = plt.subplots(1, 2, figsize=(9.2, 3.8))
    u = U2 + (U1 - U2) * (1 - np.cos(np.linspace(1e-4, np.pi - 1e-4, 4000))) / 2
    for color, viscosity in zip(("C0", "C1", "C2"), VISCOSITIES):
        for mark, title in zip("ox", ("bulk term, sdirk2", "shear term, sdirk2")):
            for run in runs:
                if run.viscosity == viscosity and run.title == title:
                    some = slice(None, None, 7)
                    axes[0].plot(run.x[some], run.rho[some], mark, color=color, ms=3.5, mfc="none",
                                 label=f"{viscosity}, {title.split(',')[0]}")
                    axes[1].plot(run.x[some], run.e[some] / ENERGY_1, mark, color=color, ms=3.5, mfc="none")
        axes[0].plot(-exact(u, viscosity), U1 / u, "k-", lw=0.8)
        axes[1].plot(-exact(u, viscosity), energy(u) / ENERGY_1, "k-", lw=0.8)
    for axis, label in zip(axes, ("density", "internal energy")):
        axis.set_xlim(-0.12, 0.12)
        axis.set_xlabel("distance from the shock (lj units)")
        axis.set_ylabel(f"{label}, of that before the shock")
    axes[0].legend(title="$\\lambda + 2\\mu$")
    return save(figure, path)


def main():
    example = Example(HERE, "Viscous shock waves in an ideal gas.")
    args = example.arguments()
    n = 500 if args.quick else 1000
    runs = [Run(title, viscosity, n) for title in CASES
            for viscosity in (VISCOSITIES if "sdirk2" in title and not args.quick else VISCOSITIES[1:2])]
    example.run({run.name: run.variables for run in runs})
    table = example.out / "shock.csv"
    print("\nviscosity  of what                 steps  thickness  density behind  velocity, rms  energy, largest")
    with csv_rows(table, ["viscosity", "case", "steps", "thickness_over_exact", "density_over_exact", "rms_velocity", "largest_energy"]) as writerow:
        for run in runs:
            run.measure(example.out)
            row = [run.viscosity, run.title, run.steps, f"{run.thickness:.5f}", f"{run.density:.5f}", f"{run.profile:.5f}", f"{run.heat:.5f}"]
            writerow(row)
            print(f"{row[0]:<10} {row[1]:<23} {row[2]:<6} {row[3]:<10} {row[4]:<15} {row[5]:<14} {row[6]}")
    print()
    for run in runs:
        where = f"viscosity {run.viscosity}, {run.title}: "
        example.merit(where + "thickness over the exact one", run.thickness, 1 - THICKNESS, 1 + THICKNESS)
        example.merit(where + "density behind", run.density, 1 - PLATEAU, 1 + PLATEAU)
        example.merit(where + "velocity, rms over the jump", run.profile, 0, PROFILE)
    return example.finish(plot(example.out / "shock.png", runs), table)


if __name__ == "__main__":
    sys.exit(main())
