#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Standing sound waves in fluids of potentials/fluids.sph against the absorption of Stokes.

    ./sphd run sound_absorption       or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import curve_fit

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, fluids, pyplot, save      # noqa: E402

FLUIDS = fluids.POTENTIALS / "fluids.sph"
CASES = {      # fluid: wavelength [m], title
    "water": (0.4e-6, "water, 0.4 µm"),
    "toluene": (1e-6, "toluene, 1 µm"),
    "argon/gas": (10e-6, "argon gas, 10 µm"),
    "CO2": (0.1, "CO$_2$, 0.1 m"),
}
CELLS, QUICK_CELLS = (32, 48, 64, 96), (24, 32)
SUPPORT = 5                 # as in the input
STOKES = 0.01               # extrapolated damping over that of Stokes
LATTICE = 0.002             # damping at any resolution over that of the lattice sums
SPEED = 0.002               # speed of sound at any resolution


class Fluid:
    """A line of the file of fluids, and the damping of a wave in it."""

    def __init__(self, name):
        known = fluids.read(FLUIDS)[name]
        self.name, self.rho, self.c, self.mu, self.kappa = name, known.rho, known.c, known.mu, known.kappa
        self.wavelength, self.title = CASES[name]
        self.k = 2 * np.pi / self.wavelength
        self.period = self.wavelength / self.c

    def bulk_viscosity(self, model):
        """Of the fluid, or of the shear term alone."""
        return self.kappa if model == "file" else 5 / 3 * self.mu

    def damping(self, model):
        """Stokes: the amplitude of a standing wave decays as exp(-damping t)."""
        return (4 / 3 * self.mu + self.bulk_viscosity(model)) * self.k**2 / (2 * self.rho)

    def wave(self, model, t):
        """Velocity at the antinode over its initial value, of a wave that starts with uniform density."""
        g = self.damping(model)
        w = np.sqrt((self.c * self.k)**2 - g**2)
        return np.exp(-g * t) * (np.cos(w * t) - g / w * np.sin(w * t))


def kh(n):
    """Wave number times half the support radius."""
    return np.pi * SUPPORT / 2**(1 / 3) / n


def lattice_sums(n, wavelength, dim=3):
    """What stands for k^2 in a longitudinal wave of n cells in infinitely many particles, from sums over one neighborhood [1/m^2]:
    of the divergence (density), of the second derivative of the kernel (curvature), of the shear term over that of the
    divergence with lambda + 2 mu = 3 mu (shear), of the Laplacian (heat); and the density over its number in the input."""
    cell = {1: 1.0, 2: np.sqrt(0.75), 3: 0.5}[dim]         # volume of a particle, in edges of cells
    support = SUPPORT * cell**(1 / dim)
    grid = np.stack(np.meshgrid(*[np.arange(-np.ceil(support) - 1, np.ceil(support) + 2)] * dim, indexing="ij"), -1).reshape(-1, dim)
    points = grid if dim == 1 else np.concatenate([grid, grid + 0.5])
    if dim == 2:
        points *= [1, np.sqrt(3)]
    r = np.linalg.norm(points, axis=1)
    x, r = points[r < support, 0], r[r < support]
    norm = {1: 3 / 2, 2: 7 / np.pi, 3: 21 / (2 * np.pi)}[dim] / support**dim
    volume = 1 / (norm * (1 - r / support)**4 * (1 + 4 * r / support)).sum()
    slope = 20 * norm / support**2 * (1 - r / support)**3  # -W'/r
    k, away = 2 * np.pi / n, r > 0
    x2, rest = np.where(away, x / np.where(away, r, 1), 0)**2, 1 - np.cos(k * x)
    second = slope * (4 * r / support - 1) / (1 - r / support)            # W''
    edges = (n / wavelength)**2 * volume
    return {"density": edges * volume * (slope * x * np.sin(k * x)).sum()**2,
            "curvature": edges * ((second * x2 - slope * (1 - x2)) * rest).sum(),
            "shear": edges * 2 * (dim + 2) / 3 * (slope * x2 * rest).sum(),
            "heat": edges * 2 * (slope * rest).sum(), "rho": cell / volume}


def lattice_damping(fluid, model, n):
    """Damping of the same wave in infinitely many particles on the lattice."""
    sums = lattice_sums(n, fluid.wavelength)
    zeta = fluid.bulk_viscosity(model) - 5 / 3 * fluid.mu
    return (zeta * sums["density"] + 3 * fluid.mu * sums["shear"]) / (2 * fluid.rho * sums["rho"])


class Run:
    def __init__(self, fluid, model, n):
        self.fluid, self.model, self.n = fluid, model, n
        self.name = f"{fluid.name.replace('/', '_')}.{model}.n{n}"
        self.variables = {"fluid": fluid.name, "file": FLUIDS, "kappa": model, "wavelength": fluid.wavelength,
                          "rho": fluid.rho, "c": fluid.c, "mu": fluid.mu, "n": n}

    def measure(self, out):
        """Damping and frequency from a fit to the whole time series."""
        self.t, self.amplitude = np.loadtxt(out / f"{self.name}.wave.txt", usecols=(1, 2)).T
        tau = self.t / self.fluid.period
        start = (1, self.fluid.damping(self.model) * self.fluid.period, 2 * np.pi, 0)
        (_, g, w, _), covariance = curve_fit(
            lambda s, a, g, w, phase: a * np.exp(-g * s) * np.cos(w * s + phase), tau, self.amplitude, start)
        self.damping = g / self.fluid.period
        self.error = np.sqrt(covariance[1, 1]) / g
        self.speed = np.sqrt(w**2 + g**2) / self.fluid.period / self.fluid.k
        self.stokes = self.damping / self.fluid.damping(self.model)
        self.lattice = self.damping / lattice_damping(self.fluid, self.model, self.n)


def extrapolate(runs):
    """damping/Stokes for kh -> 0: straight in (kh)^2 through the two finest; uncertainty: against the next two."""
    def intercept(a, b):
        return (a.stokes * kh(b.n)**2 - b.stokes * kh(a.n)**2) / (kh(b.n)**2 - kh(a.n)**2)
    value = intercept(runs[-1], runs[-2])
    return value, abs(value - intercept(runs[-2], runs[-3])) if len(runs) > 2 else abs(value - runs[-1].stokes)


def plot(out, measured, alone):
    plt = pyplot()
    paths = [out / "absorption.png", out / "convergence.png"]
    figure = plt.figure(figsize=(8.6, 6.2))
    top, below = figure.subfigures(2, 1, height_ratios=(0.06, 1))
    axes = below.subplots(2, 2, sharex=True, sharey=True)
    for axis, (name, runs) in zip(axes.flat, measured.items()):
        fluid, run, bare = runs[-1].fluid, runs[-1], alone[name]
        periods = run.t[-1] / fluid.period
        t = np.linspace(0, periods, 1200)
        axis.plot(t, np.exp(-bare.fluid.damping("intrinsic") * fluid.period * t), "--", color="C3",
                  label="Stokes, $\\kappa = 5\\mu/3$")
        some = slice(0, None, 20)        # every half period: crest or trough
        axis.plot(bare.t[some] / fluid.period, np.abs(bare.amplitude[some]), "s", color="C3", ms=3.5, mfc="none",
                  label="SPH, shear term alone")
        axis.plot(t, fluid.wave("file", t * fluid.period), "-", color="0.7", lw=0.7)
        axis.plot(t, np.exp(-fluid.damping("file") * fluid.period * t), "k-",
                  label="Stokes, $\\kappa$ of the fluid")
        axis.plot(run.t[some] / fluid.period, np.abs(run.amplitude[some]), "o", color="C0", ms=4.5, mfc="none",
                  mew=1.2, label="SPH, $\\kappa$ of the fluid")
        ratio = fluid.kappa / fluid.mu
        axis.set_title(f"{fluid.title}:  $\\kappa/\\mu$ = {ratio:.3g}" if ratio < 1000 else
                       f"{fluid.title}:  $\\kappa/\\mu$ = {ratio:.0f}")
        axis.set_xlim(0, periods)
        axis.set_ylim(-1.05, 1.05)
    for axis in axes[1]:
        axis.set_xlabel("time / period")
    for axis in axes[:, 0]:
        axis.set_ylabel("velocity at the antinode / initial")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    top.legend(handles, labels, loc="center", ncol=4)
    save(figure, paths[0])

    figure, axis = plt.subplots(figsize=(5.6, 3.9))
    fine = np.linspace(min(QUICK_CELLS), 2000, 4000)
    for color, mark, (name, runs) in zip(("C0", "C1", "C2", "C3"), "os^D", measured.items()):
        fluid = runs[0].fluid
        axis.plot(kh(fine)**2, [lattice_damping(fluid, "file", n) / fluid.damping("file") for n in fine], "-",
                  color=color, lw=0.8)
        axis.plot([kh(run.n)**2 for run in runs], [run.stokes for run in runs], mark, color=color, mfc="none",
                  label=fluid.title.split(",")[0])
        value, spread = extrapolate(runs)
        axis.errorbar([0], [value], [spread], fmt=mark, color=color, ms=4, capsize=3)
    axis.axhline(1, color="k", lw=0.8)
    axis.set_xlim(-0.004, 1.08 * max(kh(run.n)**2 for runs in measured.values() for run in runs))
    stokes = [run.stokes for runs in measured.values() for run in runs]
    axis.set_ylim(min(stokes) - 0.01, max(stokes) + 0.01)
    axis.set_xlabel("$(k h)^2$,  $h$ = half the support radius")
    axis.set_ylabel("measured damping / Stokes")
    axis.legend(loc="lower left", title="marks: SPH, lines: lattice sums\nfilled at 0: extrapolated")
    save(figure, paths[1])
    return paths


def main():
    example = Example(HERE, "Sound absorbed by real fluids: LAMMPS against Stokes.")
    args = example.arguments()
    cells = QUICK_CELLS if args.quick else CELLS
    cases = {name: Fluid(name) for name in CASES}
    measured = {name: [Run(fluid, "file", n) for n in cells] for name, fluid in cases.items()}
    alone = {name: Run(fluid, "intrinsic", cells[-1]) for name, fluid in cases.items()}
    runs = [run for group in measured.values() for run in group] + list(alone.values())
    example.run({run.name: run.variables for run in sorted(runs, key=lambda run: -run.n)})
    for run in runs:
        run.measure(example.out)

    print("\nfluid      kappa from     n    kh     damping    loss per   damping over          speed/c   shear term alone")
    print("                                      [1/s]      period     Stokes     lattice              would give")
    for name, fluid in cases.items():
        for run in [*measured[name], alone[name]]:
            loss = 1 - np.exp(-run.damping * fluid.period)
            print(f"{name:10s} {run.model:10s} {run.n:4d}  {kh(run.n):.3f}  {run.damping:.4e}  {100 * loss:5.2f} %   "
                  f"{run.stokes:.4f}     {run.lattice:.5f}   {run.speed / fluid.c:.5f}   "
                  + (f"{fluid.damping('intrinsic') / fluid.damping('file'):.4g} of it" if run is measured[name][-1] else ""))
    print()

    for name, group in measured.items():
        value, spread = extrapolate(group)
        example.merit(f"{name}: damping/Stokes for kh -> 0 (+- {spread:.4f})", value, 1 - STOKES, 1 + STOKES)
    for name, group in measured.items():
        for what, values in (("damping/lattice sum", [run.lattice for run in [*group, alone[name]]]),
                             ("speed of sound/c", [run.speed / cases[name].c for run in [*group, alone[name]]])):
            worst = max(values, key=lambda v: abs(v - 1))
            within = LATTICE if "damping" in what else SPEED
            example.merit(f"{name}: {what}, farthest from 1", worst, 1 - within, 1 + within)

    table = example.out / "absorption.csv"
    with csv_rows(table, ["fluid", "wavelength_m", "frequency_Hz", "kappa_Pa_s", "mu_Pa_s", "cells", "kh", "damping_per_s",
                          "fit_error", "damping_over_stokes", "damping_over_lattice", "speed_over_c"]) as writerow:
        for run in runs:
            fluid = run.fluid
            writerow([fluid.name, fluid.wavelength, f"{1 / fluid.period:.6g}",
                      f"{fluid.bulk_viscosity(run.model):.6g}", fluid.mu, run.n, f"{kh(run.n):.5f}",
                      f"{run.damping:.6e}", f"{run.error:.1e}", f"{run.stokes:.6f}", f"{run.lattice:.6f}",
                      f"{run.speed / fluid.c:.6f}"])
    return example.finish(*plot(example.out, measured, alone), table)


if __name__ == "__main__":
    sys.exit(main())
