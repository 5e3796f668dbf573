#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""A compression that relaxes in a fluid of large bulk viscosity, against the roots of the dispersion relation.

    ./sphd run overdamped_sound       or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import re
import sys
from pathlib import Path

import numpy as np
from scipy.optimize import curve_fit

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, pyplot, save      # noqa: E402

RATIOS, QUICK_RATIOS = (1, 3, 10, 30, 60, 150, 300, 1000), (3, 30, 300, 1000)
MODES = {"rkl2": "viscous rkl2", "trapezoidal": "viscous implicit"}
N, MU, K, SUPPORT = 96, 0.003422, 2 * np.pi, 4.0     # as in the input
CONTINUUM, LATTICE = 0.03, 0.002                     # rate over that of the dispersion relation
APPLICATION = 0.65                                   # of the friction, in force computations, measured
COST = 5                                             # time of explicit steps over that of rkl2, kappa/mu = 1000


def lattice_sums():
    """Factors of the particles on mu and zeta in lambda + 2 mu, and on c^2, for this wave: 3, 1, 1 in the continuum."""
    grid = np.arange(-5.0, 6.0)
    place = np.stack(np.meshgrid(grid, grid), -1).reshape(-1, 2)
    r = np.linalg.norm(place, axis=1)
    x, r = place[r < SUPPORT, 0], r[r < SUPPORT]
    norm = 7 / (np.pi * SUPPORT**2)
    volume = 1 / (norm * (1 - r / SUPPORT)**4 * (1 + 4 * r / SUPPORT)).sum()
    slope, k, away = 20 * norm / SUPPORT**2 * (1 - r / SUPPORT)**3, K / N, r > 0
    divergence = (slope * x * np.sin(k * x)).sum() * volume / k
    central = (slope * x**2 * (1 - np.cos(k * x)))[away] @ (1 / r[away]**2) * volume
    return 8 * central / k**2, divergence**2, divergence**2


class Wave:
    """s^2 + 2 D s + (c k)^2 = 0 for the amplitude exp(s t), D = (lambda + 2 mu) k^2/(2 rho)."""

    def __init__(self, ratio, shear=3.0, bulk=1.0, speed=1.0):
        self.frequency = np.sqrt(speed) * K
        self.damping = (shear + bulk * (ratio - 2)) * MU * K**2 / 2      # kappa = 2 mu is that of the shear term

    @property
    def number(self):
        return self.damping / K

    def rate(self):
        """Of the amplitude: the damping of the oscillation, or the slow root."""
        d, w = self.damping, self.frequency
        return d if d < w else d - np.sqrt(d * d - w * w)

    def amplitude(self, t):
        w = np.sqrt(complex(self.frequency**2 - self.damping**2))
        return (np.exp(-self.damping * t) * (np.cos(w * t) + self.damping / w * np.sin(w * t))).real


def seconds(log):
    """Of the run, per unit of its time."""
    time, steps = re.search(r"^Loop time of (\S+) on \d+ procs for (\d+) steps", log, re.MULTILINE).groups()
    step = float(re.search(r"^timestep (\d\S*)", log, re.MULTILINE)[1])
    return float(time) / (int(steps) * step)


class Run:
    def __init__(self, ratio, mode):
        self.ratio, self.mode, self.name = ratio, mode, f"{mode}.{ratio}"
        self.variables = {"ratio": ratio, "viscous": MODES[mode], "n": N, "count": "yes"}
        self.continuum, self.lattice = Wave(ratio), Wave(ratio, *lattice_sums())

    def measure(self, out):
        self.t, a = np.loadtxt(out / f"{self.name}.wave.txt", usecols=(1, 2)).T
        self.amplitude = a / a[0]
        log = (out / f"{self.name}.log").read_text()
        self.stiffness = float(re.search(r"largest viscous rate is (\S+):", log)[1])
        steps = float(re.search(r"^Loop time of .* for (\d+) steps", log, re.MULTILINE)[1])
        self.work = 2 + APPLICATION * float(re.search(r"^applications (\S+)", log, re.MULTILINE)[1]) / steps
        d = self.lattice.damping
        if d < K:
            (_, self.rate, _, _), _ = curve_fit(lambda t, a, g, w, phase: a * np.exp(-g * t) * np.cos(w * t + phase),
                                                self.t, self.amplitude, (1, d, np.sqrt(K * K - d * d), 0))
        else:
            late = (self.t > 8 / (d + np.sqrt(d * d - K * K))) & (self.amplitude > 1e-4)
            self.rate = -np.polyfit(self.t[late], np.log(self.amplitude[late]), 1)[0]


def plot(path, runs):
    plt = pyplot()
    figure, (left, right, work) = plt.subplots(1, 3, figsize=(9.6, 3.6))
    for color, run in zip(plt.cm.viridis(np.linspace(0, 0.9, len(RATIOS))), [r for r in runs if r.mode == "rkl2"]):
        left.plot(run.t, run.continuum.amplitude(run.t), "-", color=color, lw=0.8)
        left.plot(run.t[::8], run.amplitude[::8], "o", color=color, ms=3, mfc="none", label=f"{run.ratio}")
    left.set_xlabel("time $t\\,c/\\lambda$")
    left.set_ylabel("amplitude of the density")
    left.set_ylim(-1.05, 1.8)         # room for the legend
    left.legend(title="$\\kappa/\\mu$", ncol=4, loc="upper center", columnspacing=0.8, handletextpad=0.1)
    ratio = np.logspace(0, 3.1, 400)
    waves = [Wave(r) for r in ratio]
    right.loglog([w.number for w in waves], [w.rate() / K for w in waves], "k-", lw=0.8, label="dispersion relation")
    for mark, mode in zip("ox", MODES):
        some = [run for run in runs if run.mode == mode]
        right.loglog([r.continuum.number for r in some], [r.rate / K for r in some], mark, mfc="none", label=mode)
    right.set_xlabel("damping over frequency, $\\Gamma k/c$")
    right.set_ylabel("decay rate over $ck$")
    right.legend()
    for mark, mode in zip("ox", MODES):
        some = [run for run in runs if run.mode == mode]
        work.loglog([r.stiffness for r in some], [r.work for r in some], f"{mark}-", mfc="none", label=mode)
    g = np.array([min(run.stiffness for run in runs), 1, max(run.stiffness for run in runs)])
    work.loglog(g, np.maximum(1, g / 0.9), "k--", lw=0.8, label="explicit")
    work.set_xlabel("largest viscous rate times time step")
    work.set_ylabel("force computations per step")
    work.legend()
    return save(figure, path)


def main():
    example = Example(HERE, "Relaxation of a compression in a fluid of large bulk viscosity.")
    args = example.arguments()
    runs = [Run(ratio, mode) for ratio in (QUICK_RATIOS if args.quick else RATIOS) for mode in MODES]
    example.run({run.name: run.variables for run in reversed(runs)})

    # one after the other, at the largest stable steps of each
    costs = {"explicit": {"viscous": "viscous explicit", "part": 0.009, "time": 0.2},
             **{mode: {"viscous": keywords, "part": 1, "time": 2} for mode, keywords in MODES.items()}}
    for mode, variables in costs.items():
        example.run({f"cost.{mode}": {"ratio": 1000, "n": N, **variables}})
    table = example.out / "overdamped_sound.csv"
    with csv_rows(table, ["kappa_over_mu", "mode", "Gamma_k_over_c", "rate_times_dt", "rate_over_ck", "over_continuum", "over_lattice",
                          "force_computations_per_step"]) as writerow:
        print("\nkappa/mu  mode          Gamma k/c  g dt    rate/(c k)  over continuum  over lattice sums  force computations/step")
        for run in runs:
            run.measure(example.out)
            row = [run.ratio, run.mode, f"{run.continuum.number:.4f}", f"{run.stiffness:.3g}", f"{run.rate / K:.6f}",
                   f"{run.rate / run.continuum.rate():.5f}", f"{run.rate / run.lattice.rate():.5f}", f"{run.work:.2f}"]
            writerow(row)
            print(f"{row[0]:<9} {row[1]:<13} {row[2]:<10} {row[3]:<7} {row[4]:<11} {row[5]:<15} {row[6]:<18} {row[7]}")
    time = {mode: seconds((example.out / f"cost.{mode}.log").read_text()) for mode in costs}
    print("\nseconds per unit of time, kappa/mu = 1000: " + ", ".join(f"{mode} {s:.3g}" for mode, s in time.items()) + "\n")
    example.merit("time of explicit steps over that of rkl2", time["explicit"] / time["rkl2"], COST, 1e3)
    example.merit("time of explicit steps over that of implicit ones", time["explicit"] / time["trapezoidal"], COST, 1e3)
    for mode in MODES:
        some = [run for run in runs if run.mode == mode]
        for what, within, values in (("dispersion relation", CONTINUUM, [r.rate / r.continuum.rate() for r in some]),
                                     ("lattice sums", LATTICE, [r.rate / r.lattice.rate() for r in some])):
            example.merit(f"{mode}: rate over {what}, farthest from 1", max(values, key=lambda v: abs(v - 1)), 1 - within, 1 + within)
    return example.finish(plot(example.out / "overdamped_sound.png", runs), table)


if __name__ == "__main__":
    sys.exit(main())
