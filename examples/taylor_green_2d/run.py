#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Taylor-Green vortices in two dimensions against the exact decay, with and without particle shifting.

    ./sphd run taylor_green_2d       or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, pyplot, save      # noqa: E402

DECAY = 0.02                # decay rate over the exact one, with shifting; Re = 1000 with n = 100
SPEEDS = {"1.0": "shifting", "0.0": "no shifting"}


class Run:
    def __init__(self, re, shift, n, tend):
        self.re, self.shift, self.n = re, shift, n
        self.name = f"re{re}.shift{shift}.n{n}"
        self.variables = {"re": re, "shift": shift, "n": n, "tend": tend}
        self.rate = 16 * np.pi**2 / re

    def measure(self, out):
        rows = np.loadtxt(out / f"{self.name}.energy.txt", ndmin=2).T
        self.t, self.kinetic, self.total, self.shear, self.bulk = rows[1:6]
        self.solenoidal, self.dilatational, self.omega, self.div = rows[6:10]
        self.decay = -np.polyfit(self.t, np.log(self.kinetic), 1)[0] / self.rate
        self.final = self.kinetic[-1] / (0.25 * np.exp(-self.rate * self.t[-1]))
        late = self.t >= 0.25
        self.resolved = np.mean((self.omega + self.div)[late]) / np.mean((self.shear + self.bulk)[late])


def plot(out, runs):
    plt = pyplot()
    figure, axes = plt.subplots(1, 2, figsize=(8.6, 3.4))
    for axis, re in zip(axes, sorted({run.re for run in runs})):
        some = [run for run in runs if run.re == re]
        t = some[0].t
        axis.semilogy(t, 0.25 * np.exp(-16 * np.pi**2 / re * t), "k-", lw=2.5, alpha=0.35, label="exact")
        for run in some:
            axis.semilogy(run.t, run.kinetic, "-" if float(run.shift) else "--",
                          color={0: "C0", 1: "C3"}[sorted({r.n for r in some}).index(run.n)],
                          label=f"n = {run.n}, {SPEEDS[run.shift]}")
        axis.set_title(f"Re = {re}")
        axis.set_xlabel("time (lj units)")
        axis.legend()
    axes[0].set_ylabel("kinetic energy per volume")
    return save(figure, out / "decay.png")


def main():
    example = Example(HERE, __doc__)
    args = example.arguments()
    cases = [(100, "1.0", 50)] if args.quick else [(re, s, n) for n in (100, 50) for re in (1000, 100) for s in SPEEDS]
    runs = [Run(*case, 1 if args.quick else 2) for case in cases]
    example.run({run.name: run.variables for run in runs})
    print("\n  Re  shift    n   decay/exact   energy/exact at the end   spectral power/that of the particles   energy drift")
    for run in runs:
        run.measure(example.out)
        print(f"{run.re:4d}  {run.shift:>4s}  {run.n:4d}   {run.decay:.4f}        {run.final:.4f}                    {run.resolved:.4f}"
              f"                                 {run.total[-1] / run.total[0] - 1:+.1e}")
    for run in runs:
        if float(run.shift) and (run.re == 100 or run.n == 100):
            example.merit(f"Re = {run.re}, n = {run.n}, shifting: decay rate/exact", run.decay, 1 - DECAY, 1 + DECAY)
    table = example.out / "decay.csv"
    with csv_rows(table, ["re", "shift", "n", "decay_over_exact", "final_energy_over_exact", "spectral_over_particle_power"]) as writerow:
        for run in runs:
            writerow([run.re, run.shift, run.n, f"{run.decay:.5f}", f"{run.final:.5f}", f"{run.resolved:.5f}"])
    return example.finish(table, *([] if args.quick else [plot(example.out, runs)]))


if __name__ == "__main__":
    sys.exit(main())
