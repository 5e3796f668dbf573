#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The mean force of a standing wave of sound on a cylinder in a viscous fluid, against the theory of second order.

    ./sphd run radiation_force       or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar
from scipy.special import kv

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, pyplot, save      # noqa: E402

# thickness of the boundary layer, particles in a radius, wavenumber, the unit of length being the radius
CASES = [(0.6, 8, 0.25), (0.6, 6, 0.15), (1.0, 6, 0.25), (0.6, 6, 0.25), (0.3, 6, 0.25), (0.6, 4, 0.25)]
QUICK_CASES = [(0.6, 4, 0.25)]
WIDTH, BULK, PERIODS = 10, 2, 9     # as in the input
FIRST = 3                           # periods before the means
# of the force over theory, less 1: the mean one of the finest lattice, of all; the first-order one; the README says why
FINEST, MEAN, FIRST_ORDER = -0.12, -0.18, 0.03


def added_mass(delta):
    """of a cylinder over its mass of fluid, with the force of the boundary layer as imaginary part (Stokes 1851)"""
    x = (1 - 1j) / delta
    return 1 + 4 * kv(1, x) / (x * kv(0, x))


def between(omega, viscosity, push, q, x, offset):
    """A plane wave from a wall that acts as if it were at -offset: pressure and velocity at x, and the integral of the velocity times
    sin(q x) from 0 to x, over the pressure at the wall; the same that the body force push sin(q x) adds."""
    def state(pressure, push):
        def rates(s, y):
            shape = np.sin(q * max(s, 0))
            return [(1j * omega * y[1] + push * shape) / (1 - 1j * omega * viscosity), 1j * omega * y[0], y[1] * shape]

        return solve_ivp(rates, (-offset, x), np.array([pressure, 0, 0], complex), rtol=1e-9, atol=1e-14).y[:, -1]

    return state(1, 0), state(0, push)


class Run:
    def __init__(self, delta, n, k, **more):
        self.delta, self.n, self.k = delta, n, k
        self.name = ".".join(["alone"] * bool(more) + [f"{delta:g}", f"{n}", f"{k:g}"])
        # of the energy of the wave, what both boundary layers and the bulk lose in a period over 2 pi, about; the drive makes up for half of gain
        loss = 0.5 * delta**2 * k**2 * (1 + BULK) + (0 if more else added_mass(delta).imag * k / WIDTH)
        self.variables = {"n": n, "delta": delta, "k": k, "gain": round(2.4 * loss, 3), "periods": PERIODS, **more}

    def read(self, out):
        words = (out / f"{self.name}.given.txt").read_text().split()
        self.given = given = {name: float(number) for name, number in zip(words[::2], words[1::2])}
        table = np.loadtxt(out / f"{self.name}.force.txt")[:, 1:6]
        period = 2 * np.pi / self.k
        table = table[(table[:, 0] >= FIRST * period) & (table[:, 0] <= (PERIODS + 1e-6) * period)]
        time, columns = table[:, 0] - table[:, 0].mean(), table[:, 1:]
        weight = np.cos(np.pi * time / (time[-1] - time[0]))[:, None]**2

        def harmonics(omega):
            waves = [f(m * omega * time) for m in (1, 2, 3) for f in (np.cos, np.sin)]
            basis = np.column_stack([np.ones_like(time), time, *waves]) * weight
            found = np.linalg.lstsq(basis, columns * weight, rcond=None)[0]
            return found, ((columns * weight - basis @ found)[:, 0]**2).sum()

        self.omega = minimize_scalar(lambda omega: harmonics(omega)[1], bounds=(0.85 * self.k, 1.1 * self.k), method="bounded", options={"xatol": 1e-9}).x
        found = harmonics(self.omega)[0]
        self.waves, self.mean = found[2] + 1j * found[3], found[0, 3]      # of exp(-i omega t)

    def offset(self):
        """of a wall, in spacings, from the frequency of the wave alone"""
        return 0.5 * (np.pi / self.omega - self.given["length"]) * self.n

    def measure(self, offset):
        omega, given = self.omega, self.given
        wave, left, right, force = self.waves
        length, x0, area = given["length"], given["x0"], given["area"]
        q, viscosity, offset = np.pi / length, given["mu"] + given["kappa"], offset / self.n
        push = given["gain"] * self.k * wave * (1 - 0.5 * abs(wave / given["mach"])**2)

        # plane waves left and right of the cylinder: their ratio is that of the densities next to the walls, and they have the momentum of the fluid
        (free_left, more_left), (free_right, more_right) = (between(omega, viscosity, sign * push, q, x, offset) for sign, x in ((1, x0), (-1, length - x0)))
        factor = (0.5 * length * wave - more_left[2] + more_right[2]) / (left * free_left[2] - right * free_right[2])
        left, right = factor * left, factor * right
        p_left, u_left, _ = left * free_left + more_left
        p_right, u_right, _ = right * free_right + more_right
        p, u, push = 0.5 * (p_left + p_right), 0.5 * (u_left - u_right), push * np.sin(q * x0)

        # at the cylinder, with the flow around those of the next periods of the box
        others = np.pi * area / (6 * given["width"]**2)
        dipole = 1 + added_mass(np.sqrt(2 * given["mu"] * np.pi / (omega * area)))
        u /= 1 - others * dipole
        acceleration, slope = -1j * omega * u, 1j * omega * p * (1 - others)
        unit = area * omega * (abs(left)**2 + abs(right)**2) / 8 * np.sin(2 * omega * x0)
        self.force = self.mean / unit
        self.theory = 0.5 * area * (p.conjugate() * (acceleration - push) + (dipole * u).conjugate() * slope).real / unit
        self.plane = plane_wave(self.delta)
        self.error = self.force / self.theory - 1
        self.first_order = abs(force / area + push) / abs(dipole * acceleration) - 1


def plane_wave(delta):
    """the mean force on a cylinder at rest over pi a^2 k E sin 2kx, for a small ka in an infinite fluid"""
    return 2 + added_mass(delta).real


def plot(path, runs):
    plt = pyplot()
    figure, (forces, errors) = plt.subplots(1, 2, figsize=(9.2, 3.9))
    delta = np.linspace(0.02, 1.2, 100)
    forces.plot(delta, [plane_wave(d) for d in delta], "k-", lw=0.9, label="theory, small $ka$")
    forces.axhline(3, color="k", lw=0.7, ls=":", label="without viscosity")
    errors.axhline(0, color="k", lw=0.5)
    for n, mark in ((4, "^"), (6, "s"), (8, "o")):
        some = [run for run in runs if run.n == n and run.k == 0.25]
        forces.plot([run.delta for run in some], [run.force for run in some], mark, color="C0", mfc="none", label=f"{n} particles in the radius")
    some = [run for run in runs if run.delta == 0.6 and run.k == 0.25]
    errors.plot([1 / run.n for run in some], [100 * run.error for run in some], "o-", color="C0", mfc="none", lw=0.8, label="mean force")
    errors.plot([1 / run.n for run in some], [100 * run.first_order for run in some], "x-", color="C1", lw=0.8, label="force of first order")
    some = [run for run in runs if run.k == 0.25]
    forces.plot([run.delta for run in some], [run.theory for run in some], "_", color="k", ms=9, label="theory, waves that are there")
    forces.set(xlabel="boundary layer over radius, $\\delta/a$", ylabel="mean force over $\\pi a^2 k E \\sin 2kx$", xlim=(0, 1.2), ylim=(2, 6))
    forces.legend(loc="upper left")
    errors.set(xlabel="particle spacing over radius", ylabel="deviation from theory [%], $\\delta/a$ = 0.6", xlim=(0, 0.27), ylim=(-20, 5))
    errors.legend(loc="lower left")
    return save(figure, path, legends=(forces, errors))


def main():
    example = Example(HERE, "The force of sound on a cylinder.")
    args = example.arguments()
    runs = [Run(*case) for case in (QUICK_CASES if args.quick else CASES)]
    alone = Run(0.6, 4 if args.quick else 6, 0.25, cylinder="no", width=2)
    example.run({run.name: run.variables for run in [*runs, alone]})
    for run in [*runs, alone]:
        run.read(example.out)
    offset = alone.offset()
    for run in runs:
        run.measure(offset)
    runs.sort(key=lambda run: (run.delta, run.n, run.k))

    print(f"\nwave alone: frequency {alone.omega * alone.given['length'] / np.pi:.4f} of that of walls at the surface, which act {offset:.2f} spacings behind it\n")
    table = example.out / "radiation_force.csv"
    with csv_rows(table, ["delta", "particles", "ka", "force", "theory", "of_small_ka", "error", "error_of_first_order"]) as writerow:
        print("delta/a  particles in a  k a   force    theory   theory, small ka  error    error of the force of first order")
        for run in runs:
            row = [f"{run.delta:g}", run.n, f"{run.k:g}", f"{run.force:.4f}", f"{run.theory:.4f}", f"{run.plane:.4f}", f"{run.error:.4f}", f"{run.first_order:.4f}"]
            writerow(row)
            print("{:<8} {:<15} {:<5} {:<8} {:<8} {:<17} {:<8} {}".format(*row))
    print()

    finest = max(run.n for run in runs)
    example.merit("largest error of the force of first order", max((run.first_order for run in runs), key=abs), -FIRST_ORDER, FIRST_ORDER)
    example.merit("largest error of the mean force", min(run.error for run in runs), MEAN, 0)
    if not args.quick:
        coarse, fine = (run.error for run in runs if run.delta == 0.6 and run.k == 0.25 and run.n in (4, finest))
        example.merit(f"error of the mean force, {finest} particles in the radius", fine, FINEST, 0)
        example.merit("error with 4 particles over that of the finest lattice", coarse / fine, 1.3, 3)
    return example.finish(plot(example.out / "radiation_force.png", runs), table)


if __name__ == "__main__":
    sys.exit(main())
