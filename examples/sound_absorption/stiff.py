#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Sound of short waves in carbon dioxide and nitrous oxide at the time step of sound: damping and work.

    SPHD_LMP=path/to/lmp python3 stiff.py [--quick] [--np N] [--out DIR] [--check]
"""

import re
import sys
from pathlib import Path

import numpy as np
from scipy.optimize import curve_fit

import run as absorption
from run_lammps import Example, csv_rows, pyplot, save

HERE = Path(__file__).resolve().parent
absorption.SUPPORT = 3
CELLS, QUICK_CELLS = (32, 64, 128), (32,)
EXPLICIT_CELLS = 64       # at most: with more the work of the explicit steps is known anyway
MODES = {      # keywords, time step over that of sound; explicit: over the rate of viscosity as well
    "explicit": ("viscous explicit", None),
    "rkl2": ("viscous rkl2", 1.0),
    "trapezoidal": ("viscous implicit", 1.0),
    "trapezoidal 1e-3": ("viscous implicit tolerance 1e-3", 1.0),
}
STRENGTH = 0.5          # Gamma k/c: the amplitude falls to a twentieth in a period
LATTICE = 0.005         # damping over that of the lattice sums
APPLICATION = 0.65      # work of one application of the friction, in force computations, measured


class Gas(absorption.Fluid):
    def __init__(self, name):
        absorption.CASES[name] = (1.0, name)
        super().__init__(name)
        viscosity = (4 / 3 * self.mu + self.kappa) / (2 * self.rho)
        self.wavelength = 2 * np.pi * viscosity / (STRENGTH * self.c)
        self.k = 2 * np.pi / self.wavelength
        self.period = self.wavelength / self.c


class Run(absorption.Run):
    def __init__(self, fluid, n, mode):
        super().__init__(fluid, "file", n)
        self.mode, self.name = mode, f"{fluid.name}.n{n}.{mode.replace(' ', '_')}"
        keywords, part = MODES[mode]
        h = absorption.SUPPORT * fluid.wavelength / n / 2**(1 / 3) / 2
        self.stiffness = 0.25 * h / fluid.c * (fluid.kappa / fluid.rho / (0.4 * h**2))      # at the step of sound
        if part is None:
            part = 0.9 * min(1, 1 / self.stiffness)
        self.variables.update(viscous=keywords, part=part, support=absorption.SUPPORT, periods=1,
                              count="no" if mode == "explicit" else "yes")

    def measure(self, out):
        t, a = np.loadtxt(out / f"{self.name}.wave.txt", usecols=(1, 2)).T
        tau, g = t / self.fluid.period, self.fluid.damping("file") * self.fluid.period
        (_, g, _, _), _ = curve_fit(lambda s, a, g, w, phase: a * np.exp(-g * s) * np.cos(w * s + phase), tau, a,
                                    (1.2, g, np.sqrt(4 * np.pi**2 - g**2), 0.5))
        self.damping = g / self.fluid.period
        self.lattice = self.damping / absorption.lattice_damping(self.fluid, "file", self.n)
        log = (out / f"{self.name}.log").read_text()
        self.seconds, self.steps = re.search(r"^Loop time of (\S+) on \d+ procs for (\d+) steps", log, re.MULTILINE).groups()
        self.seconds, self.steps = float(self.seconds), int(self.steps)
        self.work = self.steps
        applications = re.search(r"^applications (\S+)", log, re.MULTILINE)
        if applications:
            self.work = 2 * self.steps + APPLICATION * float(applications[1])


def plot(path, runs):
    plt = pyplot()
    figure, axis = plt.subplots(figsize=(5.6, 3.9))
    for mark, mode in zip("osx+", MODES):
        some = [run for run in runs if run.mode == mode and run.fluid.name == "CO2"]
        reference = {run.n: run.fluid.period * run.fluid.c / (0.25 * absorption.SUPPORT * run.fluid.wavelength / run.n
                                                                     / 2**(1 / 3) / 2) for run in some}
        axis.loglog([run.stiffness for run in some], [run.work / reference[run.n] for run in some], f"{mark}-", label=mode)
    g = np.array(sorted({run.stiffness for run in runs if run.fluid.name == "CO2"}))
    axis.loglog(g, np.maximum(g, 1) / 0.9, "k--", lw=0.8, label="explicit, $g \\Delta t$ = 0.9")
    axis.set_xlabel("largest viscous rate times the time step of sound")
    axis.set_ylabel("force computations per step of sound")
    axis.legend()
    axis.grid(alpha=0.3, which="both")
    for side in (axis.xaxis, axis.yaxis):
        side.set_major_formatter("{x:g}")
        side.set_minor_formatter("{x:g}")
    return save(figure, path)


def main():
    example = Example(HERE, "Sound of short waves in gases of large bulk viscosity.")
    args = example.arguments()
    runs = [Run(gas, n, mode) for gas in (Gas("CO2"), Gas("N2O")) for n in (QUICK_CELLS if args.quick else CELLS)
            for mode in MODES if mode != "explicit" or n <= EXPLICIT_CELLS]
    example.run({run.name: run.variables for run in sorted(runs, key=lambda run: -run.n)})
    table = example.out / "stiff.csv"
    print("\ngas  n    rate*dt  step              steps   force computations  seconds  damping/lattice sums")
    with csv_rows(table, ["gas", "wavelength_m", "cells", "rate_times_dt", "step", "steps", "force_computations", "seconds",
                          "damping_per_s", "damping_over_lattice"]) as writerow:
        for run in runs:
            run.measure(example.out)
            writerow([run.fluid.name, f"{run.fluid.wavelength:.4e}", run.n, f"{run.stiffness:.3g}", run.mode, run.steps,
                      f"{run.work:.0f}", f"{run.seconds:.3g}", f"{run.damping:.6e}", f"{run.lattice:.5f}"])
            print(f"{run.fluid.name:4s} {run.n:<4d} {run.stiffness:<8.3g} {run.mode:<17s} {run.steps:<7d} {run.work:<19.0f} "
                  f"{run.seconds:<8.3g} {run.lattice:.5f}")
    print()
    for run in runs:
        example.merit(f"{run.fluid.name}, n = {run.n}, {run.mode}: damping over lattice sums", run.lattice, 1 - LATTICE, 1 + LATTICE)
    return example.finish(plot(example.out / "stiff.png", runs), table)


if __name__ == "__main__":
    sys.exit(main())
