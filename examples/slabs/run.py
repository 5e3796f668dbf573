#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Two slabs put in contact, against the exact temperatures, with conduction of sph/bulk and with LAMMPS's sph/heatconduction.

    ./sphd run slabs       or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.special import erf

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, frames, pyplot, save      # noqa: E402

CASES = {      # title: density, heat capacity per mass, conductivity, temperature at the start, of both slabs
    "two conductivities": ((1, 1), (1, 1), (1, 0.1), (1, 2)),
    "two heat capacities": ((1, 2), (1, 2), (1, 0.2), (1, 2)),
    "two heat capacities, one temperature": ((1, 2), (1, 2), (1, 0.2), (1, 1)),
}
INPUTS = {"sph/bulk": "in.slabs", "sph/heatconduction": "in.slabs_lammps"}
REACH = 0.3                                  # to both sides of the contact
CONTACT, PROFILE, REST = 0.001, 0.005, 1e-13


class Run:
    def __init__(self, style, title, n):
        self.style, self.title, self.n = style, title, n
        self.rho, self.cv, self.k, self.T0 = (np.array(pair, dtype=float) for pair in CASES[title])
        self.name = f"{style.split('/')[1]}.{title.replace(', ', '.').replace(' ', '_')}"
        self.variables = {"n": n, **{f"{name}{side + 1}": pair[side] for name, pair in zip(("rho", "cv", "k", "T"), CASES[title]) for side in (0, 1)}}
        effusivity = np.sqrt(self.k * self.rho * self.cv)
        self.exact = (effusivity * self.T0).sum() / effusivity.sum()

    def profile(self, x, contact):
        """H. S. Carslaw, J. C. Jaeger, Conduction of Heat in Solids, the infinite composite solid."""
        side = np.where(x < 0, 0, 1)
        return contact + (self.T0[side] - contact) * erf(np.abs(x) / np.sqrt(4 * (self.k / (self.rho * self.cv))[side] * self.time))

    def measure(self, out):
        self.time = float((out / f"{self.name}.end.txt").read_text().split()[2])
        (frame,) = frames(out / f"{self.name}.dump").values()
        near = np.abs(frame["x"]) < REACH
        order = np.argsort(frame["x"][near])
        self.x, self.T = frame["x"][near][order], (frame["c_T"] if "c_T" in frame else frame["v_T"])[near][order]
        # both profiles are linear in the temperature of contact: least squares, beyond reach of the other slab
        away = np.abs(self.x) > 4 / self.n
        base, slope = self.profile(self.x, 0.0), self.profile(self.x, 1.0) - self.profile(self.x, 0.0)
        self.contact = ((self.T - base) * slope)[away].sum() / (slope**2)[away].sum()
        self.error = self.T - self.profile(self.x, self.exact)
        self.rms, self.largest = np.sqrt(np.mean(self.error**2)), np.abs(self.error).max()


def plot(path, runs):
    plt = pyplot()
    figure, axes = plt.subplots(1, len(CASES), figsize=(9.6, 3.4))
    for axis, title in zip(axes, CASES):
        for mark, color, style in zip("ox", ("C0", "C1"), INPUTS):
            (run,) = (run for run in runs if (run.style, run.title) == (style, title))
            line = np.linspace(-REACH, REACH, 1201)
            if style == "sph/bulk":
                axis.plot(line, run.profile(line, run.exact), "k-", lw=0.9, label="exact")
            x, first = np.unique(run.x, return_index=True)
            some = np.flatnonzero(np.diff(x // np.where(np.abs(x) < 0.06, 0.007, 0.02), prepend=np.nan))
            axis.plot(x[some], run.T[first][some], mark, color=color, ms=4, mfc="none", label=style)
        axis.set_title(title, fontsize=9)
        axis.set_xlabel("distance from contact (lj units)")
        axis.set_ylim(0.3, 2.45)
    axes[0].set_ylabel("temperature (lj units)")
    axes[0].legend(loc="lower right")
    return save(figure, path)


def main():
    example = Example(HERE, "Two slabs of different materials in contact.")
    args = example.arguments()
    n = 200 if args.quick else 400
    runs = [Run(style, title, n) for style in INPUTS for title in CASES]
    example.run({run.name: run.variables for run in runs}, {run.name: HERE / INPUTS[run.style] for run in runs})
    table = example.out / "slabs.csv"
    print(f"\n{n} particles per unit length\n\n"
          "conduction by       slabs                                  contact, exact   measured   profile, rms   largest error")
    with csv_rows(table, ["style", "slabs", "contact_exact", "contact", "rms", "largest"]) as writerow:
        for run in runs:
            run.measure(example.out)
            row = [f"{run.exact:.5f}", f"{run.contact:.5f}", f"{run.rms:.5f}", f"{run.largest:.5f}"]
            writerow([run.style, run.title, *row])
            print(f"{run.style:<19} {run.title:<38} {row[0]:<16} {row[1]:<10} {row[2]:<14} {row[3]}")
    print()
    for run in runs:
        if run.style == "sph/bulk":
            if run.T0[0] == run.T0[1]:
                example.merit(f"{run.title}: largest change of a temperature", run.largest, 0, REST)
            else:
                example.merit(f"{run.title}: temperature of contact less exact", run.contact - run.exact, -CONTACT, CONTACT)
                example.merit(f"{run.title}: profile, rms", run.rms, 0, PROFILE)
    return example.finish(plot(example.out / "slabs.png", runs), table)


if __name__ == "__main__":
    sys.exit(main())
