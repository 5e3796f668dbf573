#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""A bulk viscosity measured by the flow that a decaying wave of sound leaves behind, against the theory of second order.

    ./sphd run streaming       or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, curve_fit

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, fluids, pyplot, save      # noqa: E402

RATIOS, QUICK_RATIOS = (0, 1, 3, 10, 30), (1, 10)     # kappa/mu
LATTICES, QUICK_LATTICES = (160, 80, 40), (40,)       # particles in a wavelength
DISORDER, QUICK_DISORDER = (80, 40), (40,)
GAS, QUICK_GAS = (10e3, 30e3, 100e3), (10e3, 100e3)   # Hz, in carbon dioxide
SPINS = {"no": (0.0, 1.0), "light": (1.0, 1e-4), "heavy": (1.0, 1.0)}    # mu_r/mu; moment of inertia per mass, over the squared wavelength
SPIN_RATIO = 10
MACH = 0.005
# errors of kappa/mu, relative, for 0 absolute; with 40 particles in a wavelength the kernel smooths the wave
LATTICE, DISORDERED, RELAXING, COARSE, SPINNING, ROUND_OFF = 0.05, 0.08, 0.06, 0.2, 0.03, 1e-14


def flow(time, r, diffusion, share):
    """Velocity of the flow over the Stokes drift of the wave at the start, r = 2 g/diffusion; share: of the wave in the mean over particles."""
    r += 1e-9 * (r == 1)
    wave, shear = np.exp(-r * diffusion * time), np.exp(-diffusion * time)
    return (r / (1 - r) + share) * (wave - shear)


class Run:
    """One wave. A disordered arrangement scatters it: the mean of runs with opposite velocities has no part of odd order."""

    def __init__(self, name, ratio, **variables):
        self.name, self.ratio = name, ratio
        self.variables = {"ratio": ratio, **variables}
        machs = (MACH, -MACH) if variables.get("arrangement") == "random" else (MACH,)
        self.parts = {f"{name}.{'-' * (mach < 0)}": {**self.variables, "mach": mach} for mach in machs} if len(machs) > 1 else {name: self.variables}

    def measure(self, out):
        tables = [np.loadtxt(out / f"{part}.flow.txt") for part in self.parts]
        self.time, self.flow, _, _ = np.mean(tables, axis=0)[:, 1:].T
        self.wave = tables[0][:, 3]
        self.momentum = max(abs(table[:, 4]).max() for table in tables)
        self.odd = max(abs(table[:, 2] - self.flow).max() for table in tables)
        words = (out / f"{next(iter(self.parts))}.given.txt").read_text().split()
        given = {name: float(number) for name, number in zip(words[::2], words[1::2])}
        self.k2 = given["k"]**2 + given["q"]**2
        self.mu, self.q, self.g, self.w = (given[name] for name in ("mu", "q", "g", "w"))
        self.diffusion = 4 * self.q**2 * self.mu
        self.share = (given["k"]**2 - self.q**2) / self.k2
        self.sound = curve_fit(lambda t, a, g, w, phase: a * np.exp(-g * t) * np.cos(w * t + phase), self.time, self.wave, (1, self.g, self.w, 0))[0]

    def kappa(self, g):
        """over mu, of a decay rate"""
        return 2 * g / (self.k2 * self.mu) - 1

    def theory(self, time, g=None):
        return flow(time, 2 * (g or self.g) / self.diffusion, self.diffusion, self.share)

    def from_peak(self):
        """kappa/mu of the strongest flow"""
        top = np.argmax(self.flow)
        near = slice(top - 4, top + 5)
        a, b, c = np.polyfit(self.time[near] - self.time[top], self.flow[near], 2)
        fine = np.linspace(0, self.time[-1], 4000)
        return self.kappa(brentq(lambda g: self.theory(fine, g).max() - (c - b * b / (4 * a)), 0.02 * self.g, 20 * self.g))

    def from_rise(self):
        """decay rate of the wave that the rise of the flow has, where shear viscosity has not acted yet"""
        return curve_fit(self.theory, self.time, self.flow, (self.g,))[0][0]


class Gas(Run):
    """Carbon dioxide of a frequency; units of length, density, and speed of those of the input."""

    def __init__(self, frequency, n):
        gas = fluids.find("CO2")
        k = 2 * np.pi * np.hypot(1, n / (round(n / 3**0.5) * 3**0.5))
        length = k * gas.c / (2 * np.pi * frequency)
        unit, time = gas.rho * gas.c * length, length / gas.c
        (strength, tau), = gas.relax
        self.fluid = fluids.Fluid(1, 1, gas.mu / unit, gas.kappa / unit, [(strength / unit, tau / time)])
        s = self.fluid.standing_wave(2 * np.pi / k)
        (self.strength, self.tau), = self.fluid.relax
        super().__init__(f"gas.{frequency / 1e3:g}", (self.fluid.kappa + self.fluid.mu / 3) / self.fluid.mu, n=n, mu=self.fluid.mu, room="relax 1",
                         process=f"relax {self.strength} {self.tau}", tau=self.tau, g=-s.real, w=s.imag, time=-0.5 / s.real)

    def share_of_process(self, g):
        """bulk viscosity at the frequency of the wave, over that of frequency 0"""
        return (2 * g / self.k2 - (4 / 3 * self.fluid.mu + self.fluid.kappa)) / self.strength


class Spinning(Run):
    def __init__(self, name, n):
        (self.vortex, self.inertia), self.label = SPINS[name], name
        mu = 0.01 / (1 + SPIN_RATIO)
        super().__init__(f"spin.{name}", SPIN_RATIO, n=n, style="micropolar", mu_r=self.vortex * mu, inertia=self.inertia)

    def theory(self, time, g=None):
        """The wave has no vorticity. The flow e cos 2qy drives a spin W sin 2qy, which drags it."""
        g, vortex, q = g or self.g, self.vortex * self.mu, 2 * self.q

        def rates(t, state):
            e, spin = state
            return [2 * g * np.exp(-2 * g * t) - q * q * (self.mu + vortex) * e + 2 * vortex * q * spin, -2 * vortex / self.inertia * (2 * spin - q * e)]

        found = solve_ivp(rates, (0, time[-1]), (-self.share, 0), "LSODA", time, rtol=1e-9, atol=1e-12)
        return found.y[0] + self.share * np.exp(-2 * g * time)


def plot(path, measured, gases, spins):
    plt = pyplot()
    figure, ((curves, ratios), (relaxing, spinning)) = plt.subplots(2, 2, figsize=(9.2, 7.4))
    finest = max(n for kind, n in measured if kind == "hex")
    for color, run in zip(plt.cm.viridis(np.linspace(0, 0.9, len(RATIOS))), measured["hex", finest]):
        fine = np.linspace(0, run.time[-1], 400)
        curves.plot(fine, run.theory(fine), "-", color=color, lw=0.9)
        curves.plot(run.time[::4], run.flow[::4], "o", color=color, ms=3.5, mfc="none", label=f"{run.ratio}")
    curves.set(xlabel="time $t\\,c/\\lambda$", ylabel="flow over the Stokes drift at the start", ylim=(0, 1.18))
    curves.legend(title="$\\kappa/\\mu$; lines: theory", ncol=3, loc="upper right")

    ratios.plot([-0.2, 40], [-0.2, 40], "k-", lw=0.8, label="continuum")
    for (kind, n), runs in measured.items():
        color, mark = {"hex": ("C0", "o"), "random": ("C3", "s")}[kind][0], {160: "o", 80: "s", 40: "^"}[n]
        ratios.plot([run.ratio for run in runs], [run.from_peak() for run in runs], mark, color=color, mfc="none", ms=4 + 160 / n,
                    label=f"{'lattice' if kind == 'hex' else 'disorder'}, {n} in a wave")
    ratios.set_xscale("symlog", linthresh=1)
    ratios.set_yscale("symlog", linthresh=1)
    for axis in (ratios.xaxis, ratios.yaxis):
        axis.set_ticks([0, 1, 3, 10, 30])
        axis.set_major_formatter("{x:g}")
    ratios.set(xlabel="$\\kappa/\\mu$ given", ylabel="$\\kappa/\\mu$ returned by the strongest flow", xlim=(-0.2, 45), ylim=(-0.2, 45))
    ratios.legend(loc="upper left")

    x = np.geomspace(0.1, 10, 200)
    relaxing.plot(x, 1 / (1 + x * x), "k-", lw=0.8, label="$1/(1+\\omega^2\\tau^2)$")
    relaxing.plot([run.w * run.tau for run in gases], [run.share_of_process(run.from_rise()) for run in gases], "o", mfc="none", ms=6, label="by streaming")
    relaxing.plot([run.w * run.tau for run in gases], [run.share_of_process(run.sound[1]) for run in gases], "x", color="C1", ms=6, label="by decay of the sound")
    relaxing.set(xscale="log", yscale="log", xlabel="frequency times relaxation time, $\\omega\\tau$", ylabel="bulk viscosity of CO$_2$ over that of frequency 0")

    names = {"no": "$\\mu_r = 0$", "light": "$\\mu_r = \\mu$, light spin", "heavy": "$\\mu_r = \\mu$, heavy spin"}
    for color, mark, run in zip(("C0", "C2", "C3"), "oxs", spins):
        fine = np.linspace(0, run.time[-1], 400)
        spinning.plot(fine, run.theory(fine), "-", color=color, lw=0.9)
        spinning.plot(run.time[::4], run.flow[::4], mark, color=color, ms=4, mfc="none", label=names[run.label])
    spinning.set(xlabel="time $t\\,c/\\lambda$", ylabel="flow over the Stokes drift at the start")
    return save(figure, path, legends=(relaxing, spinning))


def main():
    example = Example(HERE, "Acoustic streaming that measures the bulk viscosity.")
    args = example.arguments()
    quick = args.quick
    lattices, disorder = (QUICK_LATTICES, QUICK_DISORDER) if quick else (LATTICES, DISORDER)
    n = 40 if quick else 80
    measured = {("hex", n): [Run(f"hex.{n}.{ratio}", ratio, n=n) for ratio in (QUICK_RATIOS if quick else RATIOS)] for n in lattices}
    measured |= {("random", n): [Run(f"random.{n}.{ratio}", ratio, n=n, arrangement="random") for ratio in (QUICK_RATIOS if quick else RATIOS)] for n in disorder}
    gases = [Gas(frequency, n) for frequency in (QUICK_GAS if quick else GAS)]
    spins = [Spinning(name, n) for name in SPINS]

    example.run({f"settle.{n}": {"n": n, "arrangement": "settle"} for n in disorder})
    runs = [*(run for group in measured.values() for run in reversed(group)), *gases, *spins]
    example.run({name: variables for run in runs for name, variables in run.parts.items()})
    for run in runs:
        run.measure(example.out)

    table = example.out / "streaming.csv"
    with csv_rows(table, ["arrangement", "particles", "kappa_over_mu", "from_the_strongest_flow", "from_the_decay_of_sound", "speed_over_c", "odd_part"]) as writerow:
        print("\narrangement  particles  kappa/mu  by streaming  by decay of sound  speed of sound/c  odd part of the flow")
        for (kind, n), group in measured.items():
            for run in group:
                row = [kind, n, run.ratio, f"{run.from_peak():.4f}", f"{run.kappa(run.sound[1]):.4f}", f"{np.hypot(*run.sound[1:3]) / run.k2**0.5:.5f}",
                       f"{run.odd:.4f}"]
                writerow(row)
                print(f"{row[0]:<12} {row[1]:<10} {row[2]:<9} {row[3]:<13} {row[4]:<18} {row[5]:<17} {row[6]}")
    print("\nCO2, bulk viscosity over that of frequency 0\nfrequency [kHz]  omega tau  by streaming  by decay of sound  theory")
    for run in gases:
        run.error = run.share_of_process(run.from_rise()) / run.share_of_process(run.g)
        print(f"{run.name[4:]:<16} {run.w * run.tau:<10.3f} {run.share_of_process(run.from_rise()):<13.5f} {run.share_of_process(run.sound[1]):<18.5f} "
              f"{run.share_of_process(run.g):.5f}")
    print("\nmicropolar, kappa/mu = 10\nspin    strongest flow  theory   largest difference")
    for run in spins:
        run.error = abs(run.flow - run.theory(run.time)).max() / run.theory(run.time).max()
        print(f"{run.label:<7} {run.flow.max():<15.4f} {run.theory(run.time).max():<8.4f} {run.error:.4f}")
    print()

    def errors(group):
        return [(run.from_peak() - run.ratio) / max(run.ratio, 1) for run in group]

    for (kind, n), group in measured.items():
        within = COARSE if n == 40 else LATTICE if kind == "hex" else DISORDERED
        example.merit(f"{kind}, {n} particles in a wavelength: error of kappa/mu, the largest", max(errors(group), key=abs), -within, within)
    if not quick:
        coarse, fine = (np.abs(errors(measured["hex", n])).max() for n in (40, 80))
        example.merit("largest error with 40 particles over that with 80", coarse / fine, 3, 6)
    example.merit("CO2: bulk viscosity over theory, farthest from 1", max((run.error for run in gases), key=lambda e: abs(e - 1)), 1 - RELAXING, 1 + RELAXING)
    example.merit("micropolar: largest difference of the flow from theory, over the strongest flow", max(run.error for run in spins), 0, SPINNING * (2 if quick else 1))
    example.merit("momentum of all particles over that of the wave, the largest", max(run.momentum for run in runs), 0, ROUND_OFF)
    return example.finish(plot(example.out / "streaming.png", measured, gases, spins), table)


if __name__ == "__main__":
    sys.exit(main())
