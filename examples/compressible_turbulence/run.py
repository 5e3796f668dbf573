#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Decaying compressible turbulence with four bulk viscosities: energies, spectra, power.

    ./sphd run compressible_turbulence       or
    SPHD_LMP=path/to/lmp python3 run.py [--n 64] [--tend T] [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

import field

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, pyplot, read_array, save      # noqa: E402

KAPPAS, QUICK_KAPPAS = (0, 1, 10, 100), (0, 10, 100)
SOLENOIDAL = 0.03           # energy with bulk viscosity over that without
ACCOUNT = 1e-5              # total energy less that at the start, over the kinetic energy at the start
COLUMNS = ("t", "kinetic", "total", "heat_shear", "heat_bulk", "solenoidal", "dilatational", "omega2", "div2", "power_omega",
           "power_div", "density2", "kinetic_grid")


class Run:
    def __init__(self, kappa, n, tend, velocities):
        self.kappa = kappa
        self.name = f"kappa{kappa:g}"
        self.variables = {"kappa": kappa, "n": n, "tend": tend, "field": velocities}

    def measure(self, out):
        for name, values in zip(COLUMNS, np.loadtxt(out / f"{self.name}.totals.txt", ndmin=2).T[1:]):
            setattr(self, name, values)

    def account(self):
        return abs(self.total - self.total[0]).max() / self.kinetic[0]

    def last_spectrum(self, out):
        return read_array(out / f"{self.name}.spectra.txt")[-1].T


def plot(out, runs):
    plt = pyplot()
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.6))
    for number, run in enumerate(runs):
        color, label = f"C{number}", f"$\\kappa/\\mu$ = {run.kappa:g}"
        axes[0].semilogy(run.t, run.solenoidal, "-", color=color)
        axes[0].semilogy(run.t, run.dilatational, "--", color=color, label=label)
        axes[1].semilogy(run.t, np.sqrt(run.div2), color=color, label=label)
        k, _, solenoidal, dilatational = run.last_spectrum(out)[:4]
        axes[2].loglog(k[1:], solenoidal[1:], "-", color=color)
        axes[2].loglog(k[1:], dilatational[1:], "--", color=color, label=label)
    axes[0].set_ylabel("energy, solenoidal (lines), dilatational (dashed)")
    axes[1].set_ylabel("root mean square of div u")
    axes[2].set_ylabel("spectra at the end, the same")
    for axis, x in zip(axes, ("time (lj units)", "time (lj units)", "wave number")):
        axis.set_xlabel(x)
    axes[2].legend(loc="lower left")
    return save(figure, out / "turbulence.png")


def main():
    example = Example(HERE, __doc__)
    example.parser.add_argument("--n", type=int, default=24, help="particles per side (%(default)s)")
    example.parser.add_argument("--tend", type=float, default=1, help="end of the runs (%(default)s)")
    args = example.arguments()
    n, tend = (14, 0.4) if args.quick else (args.n, args.tend)
    velocities = example.out / "velocities"
    field.write(velocities, n)
    runs = [Run(kappa, n, tend, velocities) for kappa in (QUICK_KAPPAS if args.quick else KAPPAS)]
    example.run({run.name: run.variables for run in runs})

    print("\nkappa/mu   E_s      E_d      rms div u   power: mu<omega^2>   (lambda+2mu)<div^2>   of the particles   account")
    table = example.out / "turbulence.csv"
    with csv_rows(table, ["kappa_over_mu", *COLUMNS]) as writerow:
        for run in runs:
            run.measure(example.out)
            print(f"{run.kappa:8g}   {run.solenoidal[-1]:.5f}  {run.dilatational[-1]:.5f}  {run.div2[-1]**0.5:.5f}     "
                  f"{run.power_omega[-1]:.5f}              {run.power_div[-1]:.5f}               "
                  f"{run.heat_shear[-1] + run.heat_bulk[-1]:.5f}            {run.account():.1e}")
            for row in zip(*(getattr(run, name) for name in COLUMNS)):
                writerow([run.kappa, *(f"{value:.7g}" for value in row)])
    for one, next_one in zip(runs, runs[1:]):
        what = f"kappa/mu = {next_one.kappa:g} over {one.kappa:g}"
        example.merit(f"dilatational energy, mean over the run, {what}", next_one.dilatational.mean() / one.dilatational.mean(),
                      0, 0.99)
        example.merit(f"rms div u, mean over the run, {what}", np.sqrt(next_one.div2).mean() / np.sqrt(one.div2).mean(), 0, 0.99)
    for run in runs:
        example.merit(f"kappa/mu = {run.kappa:g}: solenoidal energy at the end over that of kappa = 0",
                      run.solenoidal[-1] / runs[0].solenoidal[-1], 1 - SOLENOIDAL, 1 + SOLENOIDAL)
        example.merit(f"kappa/mu = {run.kappa:g}: account of the energy", run.account(), 0, ACCOUNT)
    return example.finish(table, *([] if args.quick else [plot(example.out, runs)]))


if __name__ == "__main__":
    sys.exit(main())
