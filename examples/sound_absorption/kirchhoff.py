#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Standing sound waves in argon, nitrogen and carbon dioxide with shear viscosity, bulk viscosity and conduction of heat, against Kirchhoff.

    SPHD_LMP=path/to/lmp python3 kirchhoff.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

import run as absorption
from run_lammps import Example, csv_rows, exponents, fluids, pyplot, save

HERE = Path(__file__).resolve().parent
WAVELENGTH = 1e-5           # [m]
TITLES = {"Ar": "argon", "N2": "nitrogen", "CO2": "CO$_2$,\nfrozen vibration"}
PARTS = {"shear": (1, 0, 0), "bulk": (0, 1, 0), "conduction": (0, 0, 1), "all": (1, 1, 1)}    # of mu, kappa, k
LATTICES = {3: ("bcc", 48), 2: ("hexagonal", 64), 1: ("line", 96)}                            # name, cells in a wave
DISCRETE = 0.001            # damping over that of the lattice sums
KIRCHHOFF = 0.03            # damping over that of the continuum
SPEED = 0.01                # speed over that of the continuum


class Gas:
    """An ideal gas of the file, with the heat capacity that follows a wave of this length: of CO2 the vibrations do not."""

    def __init__(self, name):
        column, _ = fluids.rows(fluids.POTENTIALS / "gases.sph")[name]
        self.name, self.wavelength = name, WAVELENGTH
        self.T, self.p, mass, self.mu, self.k, self.gamma, self.kappa = (
            column[key] for key in ("temperature", "pressure", "M", "mu", "k", "gamma", "kappa"))
        if name == "CO2":
            self.gamma = 1.4
        self.R = fluids.GAS_CONSTANT / mass
        self.rho, self.cv = self.p / (self.R * self.T), self.R / (self.gamma - 1)
        self.c = np.sqrt(self.gamma * self.R * self.T)
        self.pb = self.rho * self.c**2 - self.p        # as in the input

    def matrix(self, part, sums, dim):
        """Rates of displacement, velocity and temperature of a wave of small amplitude. sums: what stands for k^2 in each term."""
        mu, kappa, k = np.multiply(PARTS[part], (self.mu, self.kappa, self.k))
        rho = self.rho * sums["rho"]
        q, central = np.sqrt(sums["density"]), mu if dim > 1 else 0      # on a line the bulk term has all of the viscosity
        friction = (4 / 3 * mu + kappa - 3 * central) * sums["density"] + 3 * central * sums["shear"]
        pressure = rho * self.R * self.T + self.pb
        return np.array([[0, 1, 0],
                         [-self.R * self.T * q**2 + 2 * pressure / rho * (q**2 - sums["curvature"]), -friction / rho, -1j * q * self.R],
                         [0, -1j * q * (self.gamma - 1) * self.T, -k * sums["heat"] / (rho * self.cv)]])

    def continuum(self, part):
        """G. Kirchhoff (1868), a cubic for s: that of the matrix."""
        square = (2 * np.pi / self.wavelength)**2
        return self.matrix(part, {"density": square, "curvature": square, "shear": square, "heat": square, "rho": 1}, 3)

    def lattice(self, part, n, dim):
        return self.matrix(part, absorption.lattice_sums(n, self.wavelength, dim), dim)

    def stokes_kirchhoff(self, part):
        """Damping of long waves."""
        mu, kappa, k = np.multiply(PARTS[part], (self.mu, self.kappa, self.k))
        return (4 / 3 * mu + kappa + k * (1 - 1 / self.gamma) / self.cv) * (2 * np.pi / self.wavelength)**2 / (2 * self.rho)


def sound(rates):
    return max(rates, key=lambda s: s.imag)


class Run:
    def __init__(self, gas, part, dim):
        self.gas, self.part, self.dim = gas, part, dim
        self.n = LATTICES[dim][1]
        self.name = f"{gas.name}.{part}.{dim}d"
        mu, kappa, k = np.multiply(PARTS[part], (gas.mu, gas.kappa, gas.k))
        if dim == 1:
            mu, kappa = 0, kappa + 4 / 3 * mu
        if dim == 2:            # 4 mu/3 + kappa in space is mu + kappa in the plane
            kappa += mu / 3
        self.variables = {"eos": "ideal", "wavelength": gas.wavelength, "rho": gas.rho, "c": gas.c, "mu": mu, "kappa": kappa,
                          "pressure": gas.p, "temperature": gas.T, "heat": f"gamma {gas.gamma} cv {gas.cv} conductivity {k}",
                          "dim": dim, "n": self.n, "part": 0.25, "periods": 4}

    def measure(self, out):
        self.t, self.amplitude = np.loadtxt(out / f"{self.name}.wave.txt", usecols=(1, 2)).T
        self.s = sound(exponents(self.t[1], self.amplitude, 2 if PARTS[self.part][2] == 0 else 3))
        exact, discrete = (sound(np.linalg.eigvals(m)) for m in (self.gas.continuum(self.part), self.gas.lattice(self.part, self.n, self.dim)))
        self.kirchhoff, self.discrete = self.s.real / exact.real, self.s.real / discrete.real
        self.speed = abs(self.s) / abs(exact)
        self.damping = -self.s.real


def plot(path, runs):
    plt = pyplot()
    figure, axes = plt.subplots(1, 2, figsize=(9.2, 3.8), gridspec_kw={"width_ratios": (3, 2)})
    space = [run for run in runs if run.dim == 3]
    for color, mark, run in zip(("C0", "C1", "C2", "k"), "osD^", (run for run in space if run.gas.name == "N2")):
        period = run.gas.wavelength / run.gas.c
        crests = slice(0, None, 20)
        axes[0].semilogy(run.t / period, np.exp(sound(np.linalg.eigvals(run.gas.continuum(run.part))).real * run.t), color=color, lw=1)
        axes[0].semilogy(run.t[crests] / period, abs(run.amplitude[crests]), mark, color=color, ms=5, mfc="none", label=run.part)
    axes[0].set_yticks((0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1), ("0.4", "0.5", "0.6", "0.7", "0.8", "0.9", "1"))
    axes[0].minorticks_off()
    axes[0].set_xlabel("time / period")
    axes[0].set_ylabel("crests of the velocity / the first")
    axes[0].set_title("nitrogen; lines: Kirchhoff")
    names = [name for name in TITLES if any(run.gas.name == name for run in space)]
    for place, name in enumerate(names):
        group = {run.part: run for run in space if run.gas.name == name}
        gas = group["all"].gas
        unit = 1e11 * (gas.wavelength / gas.c)**2 / gas.c           # damping to alpha/f^2
        bottom = 0.0
        for color, part in zip(("C0", "C1", "C2"), PARTS):
            if part in group:
                height = gas.stokes_kirchhoff(part) * unit
                axes[1].bar(place, height, 0.6, bottom, color=color, alpha=0.35, label=part if name == "N2" else None)
                axes[1].plot(place, bottom + group[part].damping * unit, "_", color=color, ms=26, mew=2)
                bottom += height
        axes[1].plot(place, group["all"].damping * unit, "ko", ms=5, label="all, SPH" if name == "N2" else None)
    axes[1].set_xticks(range(len(names)), [TITLES[name] for name in names])
    axes[1].set_ylabel("$\\alpha/f^2$ ($10^{-11}$ s$^2$/m)")
    axes[1].set_title("bars: Stokes and Kirchhoff")
    axes[0].legend()
    axes[1].legend(loc="upper right", ncols=2)
    axes[1].set_ylim(0, 2.5)
    return save(figure, path)


def main():
    example = Example(HERE, "Sound in gases that conduct heat.")
    args = example.arguments()
    gases = {name: Gas(name) for name in (["N2"] if args.quick else TITLES)}
    runs = [Run(gas, part, dim) for dim in LATTICES for name, gas in gases.items() for part, (_, bulk, _) in PARTS.items()
            if (dim == 3 or name == "N2") and (part != "bulk" or gas.kappa > 0)]
    example.run({run.name: run.variables for run in runs})
    table = example.out / "kirchhoff.csv"
    print("\ngas       particles    what        damping    alpha/f^2      damping over                           speed over")
    print("                                   [1/s]      [1e-13 s2/cm]  lattice   Kirchhoff  Stokes-Kirchhoff  Kirchhoff")
    with csv_rows(table, ["gas", "particles", "cells", "what", "damping_per_s", "alpha_over_f2_s2_per_m", "over_lattice", "over_kirchhoff",
                          "over_stokes_kirchhoff", "speed_over_kirchhoff"]) as writerow:
        for run in runs:
            run.measure(example.out)
            gas, (lattice, _) = run.gas, LATTICES[run.dim]
            absorbed = run.damping * gas.wavelength**2 / gas.c**3
            ratio = run.damping / gas.stokes_kirchhoff(run.part)
            writerow([gas.name, lattice, run.n, run.part, f"{run.damping:.6e}", f"{absorbed:.5e}", f"{run.discrete:.6f}",
                      f"{run.kirchhoff:.5f}", f"{ratio:.5f}", f"{run.speed:.6f}"])
            print(f"{gas.name:9s} {lattice:12s} {run.part:11s} {run.damping:.4e} {absorbed * 1e11:.4f}         {run.discrete:.5f}   "
                  f"{run.kirchhoff:.4f}     {ratio:.4f}            {run.speed:.5f}")
    print()
    for dim, (lattice, _) in LATTICES.items():
        for what, values, within in (("damping over lattice sums", [run.discrete for run in runs if run.dim == dim], DISCRETE),
                                     ("damping over Kirchhoff", [run.kirchhoff for run in runs if run.dim == dim], KIRCHHOFF),
                                     ("speed over Kirchhoff", [run.speed for run in runs if run.dim == dim], SPEED)):
            example.merit(f"{lattice}: {what}, farthest from 1", max(values, key=lambda v: abs(v - 1)), 1 - within, 1 + within)
    return example.finish(plot(example.out / "kirchhoff.png", runs), table)


if __name__ == "__main__":
    sys.exit(main())
