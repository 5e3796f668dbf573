#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The mean force of a standing wave of sound on a cylinder in a viscous fluid, against the theory of second order.

    ./sphd run radiation_force       or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np
from exact import Cylinder, Wave, added_mass, elasticity, size
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, pyplot, save      # noqa: E402

# body, thickness of the boundary layer, particles in a radius; density and speed of sound of the body over those of the fluid
CASES = [("wall", 0.6, 10), ("rigid", 1.0, 6, 0.1, 12.65), ("rigid", 0.6, 6, 0.1, 12.65), ("rigid", 0.3, 6, 0.1, 12.65), ("rigid", 0.6, 6, 5, 1.789),
         ("drop", 0.6, 6, 2, 1), ("drop", 0.6, 6, 1, 2, 3.43), ("drop", 0.6, 6, 0.5, 1.4142),
         ("wall", 1.0, 6), ("wall", 0.6, 6), ("wall", 0.3, 6), ("wall", 0.6, 6, 1, 1, 4), ("wall", 0.6, 4)]
QUICK_CASES = [("wall", 0.6, 4), ("drop", 0.6, 4, 2, 1)]
WAVENUMBER, WIDTH, BULK, HOLD, SUPPORT = 0.25, 10, 2, 0.3, 4.25     # as in the input
DROP_WIDTH = 7      # what the waves that a cylinder sends out drive far from it is not part of the theory; the narrower the box, the less of it
LIGHT = 0.1
PERIODS = {"wall": (3, 9), "none": (3, 9), "drop": (6, 12), "rigid": (6, 12)}     # of the means
# bounds of the errors: of the finest lattice, of all walls, of drops, of rigid bodies that move, of first order
FINEST, WALLS, DROPS, RIGID, FIRST_ORDER = 0.03, 0.12, 0.05, 0.12, 0.03


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
    """One cylinder: a run of LAMMPS if it is at rest, two with opposite phases of the wave if it moves."""

    def __init__(self, body, delta, n, ratio=1, c=1, support=SUPPORT, **more):
        self.body, self.delta, self.n, self.ratio, self.c, self.support = body, delta, n, ratio, c, support
        self.name = f"{body}.{delta:g}.{n}.{ratio:g}.{c:g}" + (f".{support:g}" if support != SUPPORT else "") + ("." + more["ends"] if "ends" in more else "")
        # of the energy of the wave, what the bulk and the boundary layers lose in a period over 2 pi, about; the drive makes up for half of gain
        width = DROP_WIDTH if body == "drop" else WIDTH
        loss = 0.5 * delta**2 * WAVENUMBER**2 * (1 + BULK)
        if body != "none":
            loss += Cylinder(body, WAVENUMBER, delta, 0.0, ratio, c).first_order(1.0, 0.0)[0].imag * WAVENUMBER / width
        self.variables = {"body": body, "n": n, "delta": delta, "ratio": ratio, "c": c, "support": support, "gain": round(2.4 * loss, 3), "periods": PERIODS[body][1], **more}
        if body == "rigid" or "ends" in more:
            self.variables["part"] = 0.3 if ratio < 1 else 0.4       # of the time step, for a stiff body
        if body == "drop":
            self.variables.update(ends="mirror", width=width)
        self.moves = body in ("drop", "rigid")

    def jobs(self):
        phases = (("", 0.004), (".back", -0.004)) if self.moves else (("", 0.004),)
        return {self.name + phase: {**self.variables, "mach": mach} for phase, mach in phases}

    def read(self, out):
        words = (out / f"{self.name}.given.txt").read_text().split()
        self.given = given = {name: float(number) for name, number in zip(words[::2], words[1::2])}
        tables = [np.loadtxt(out / f"{name}.force.txt")[:, 1:7] for name in self.jobs()]
        period = 2 * np.pi / given["k"]
        first, last = PERIODS[self.body]
        rows = (tables[0][:, 0] >= first * period) & (tables[0][:, 0] <= (last + 1e-6) * period)
        table = tables[0][rows]
        time, columns = table[:, 0] - table[:, 0].mean(), table[:, 1:]
        odd, even = columns, columns
        if self.moves:      # what is linear in the wave, however slowly it decays, changes its sign with the wave
            back = tables[1][rows, 1:]
            odd, even = 0.5 * (columns - back), 0.5 * (columns + back)
        weight = np.cos(np.pi * time / (time[-1] - time[0]))[:, None]**2

        def harmonics(omega, columns):
            waves = [f(m * omega * time) for m in (1, 2, 3) for f in (np.cos, np.sin)]
            basis = np.column_stack([np.ones_like(time), time, *waves]) * weight
            found = np.linalg.lstsq(basis, columns * weight, rcond=None)[0]
            return found, ((columns * weight - basis @ found)[:, 0]**2).sum()

        k = given["k"]
        self.omega = minimize_scalar(lambda omega: harmonics(omega, odd)[1], bounds=(0.85 * k, 1.1 * k), method="bounded", options={"xatol": 1e-9}).x
        found = harmonics(self.omega, odd)[0]
        self.waves, self.mean = found[2] + 1j * found[3], harmonics(self.omega, even)[0][0, 3]      # of exp(-i omega t)

    def offset(self):
        """of a wall, in spacings, from the frequency of the wave alone"""
        return 0.5 * (np.pi / self.omega - self.given["length"]) * self.n

    def measure(self, offset):
        omega, given = self.omega, self.given
        offset = 0 if self.body == "drop" else offset
        wave, left, right, force, speed = self.waves
        length, x0, area, width = given["length"], given["x0"], given["area"], given["width"]
        q, viscosity, offset = np.pi / length, given["mu"] + given["kappa"], offset / self.n
        push = given["gain"] * given["k"] * wave * (1 - 0.5 * abs(wave / given["mach"])**2)

        # plane waves left and right of the cylinder: their ratio is that of the densities next to the walls, and they have the momentum of the fluid
        (free_left, more_left), (free_right, more_right) = (between(omega, viscosity, sign * push, q, x, offset) for sign, x in ((1, x0), (-1, length - x0)))
        factor = (0.5 * length * wave - more_left[2] + more_right[2]) / (left * free_left[2] - right * free_right[2])
        left, right = factor * left, factor * right
        p_left, u_left, _ = left * free_left + more_left
        p_right, u_right, _ = right * free_right + more_right
        p, u = 0.5 * (p_left + p_right), 0.5 * (u_left - u_right)
        push, push_slope = push * np.sin(q * x0), push * q * np.cos(q * x0)

        # at the cylinder, with the flow around those of the next periods of the box
        radius, hold = np.sqrt(area / np.pi), HOLD * given["k"] / omega
        cylinder = Cylinder(self.body, omega * radius, np.sqrt(2 * given["mu"] / omega) / radius, given["kappa"] / radius, self.ratio, self.c, hold)
        others, expansion = np.pi * area / (6 * width**2), 1 - cylinder.expansion
        far = u
        for _ in range(3):
            dipole, velocity = cylinder.first_order(u, push * radius)
            u = far + others * dipole
        acceleration = -1j * omega * u
        unit = area * omega * (abs(left)**2 + abs(right)**2) / 8 * np.sin(2 * omega * x0)
        self.force = self.mean / unit
        without, steady = cylinder.mean_force(length / radius, width / radius, x0 / radius, Wave(
            u, 1j * omega * p * radius, 1 - others * expansion, push * radius, push_slope * radius**2))
        self.steady = 0.5 * np.pi * radius / unit * steady
        self.size, more = size(self.body, omega * radius, cylinder.delta, self.ratio, self.c, hold, omega * (x0 + offset), width / radius,
                               ((x0 + offset) / radius, (length - x0 + offset) / radius))
        self.theory = 0.5 * np.pi * radius / unit * without + self.steady + self.size
        # of the force; for rigid bodies that move, on which the forces of their volume and of their motion may cancel, of the unit
        self.error = (self.force - self.theory) / (1 if self.body == "rigid" else self.theory)
        found = abs(speed / velocity if self.moves else (force / area + push) / (acceleration * added_mass(cylinder.delta) + acceleration))
        self.first_order = found / (1 + more) - 1


def small(body, delta, ratio=1.0, hold=0.0, steady=True):
    """Theory of a small ka; with the steady flow in the box of the runs"""
    cylinder = Cylinder(body, WAVENUMBER, delta, BULK * 0.5 * delta**2 * WAVENUMBER, ratio, hold=hold)
    length = np.pi / WAVENUMBER
    return cylinder.expansion_and_dipole().real + (cylinder.steady_flow(length, WIDTH, 0.25 * length) if steady else 0)


def plot(path, runs):
    plt = pyplot()
    figure, (forces, errors, light) = plt.subplots(1, 3, figsize=(11.5, 3.9))
    walls = [run for run in runs if run.body == "wall" and run.support == SUPPORT]
    delta = np.linspace(0.02, 1.2, 25)
    forces.plot(delta, [small("wall", one, steady=False) for one in delta], "k-", lw=0.9, label="theory, small $ka$")
    forces.axhline(3, color="k", lw=0.7, ls=":", label="without viscosity")
    for n, mark in ((4, "^"), (6, "s"), (10, "o")):
        some = [run for run in walls if run.n == n]
        forces.plot([run.delta for run in some], [run.force for run in some], mark, color="C0", mfc="none", label=f"{n} particles in the radius")
    forces.plot([run.delta for run in walls], [run.theory for run in walls], "_", color="k", ms=9, label="theory in full")
    forces.set(title="cylinder at rest", xlabel="boundary layer over radius, $\\delta/a$", ylabel="mean force over $\\pi a^2 k E \\sin 2kx$",
               xlim=(0, 1.2), ylim=(2, 6.5))
    forces.legend(loc="upper left")

    some = [run for run in walls if run.delta == 0.6]
    errors.axhline(0, color="k", lw=0.5)
    errors.plot([1 / run.n for run in some], [100 * run.error for run in some], "o-", color="C0", mfc="none", lw=0.8, label="mean force")
    errors.plot([1 / run.n for run in some], [100 * run.first_order for run in some], "x-", color="C1", lw=0.8, label="force of first order")
    errors.set(title="at rest, $\\delta/a$ = 0.6", xlabel="particle spacing over radius", ylabel="deviation from theory [%]", xlim=(0, 0.27), ylim=(-20, 5))
    errors.legend(loc="lower left")

    some = [run for run in runs if run.body == "rigid" and run.ratio == LIGHT]
    light.axhline(0, color="k", lw=0.5)
    light.plot(delta, [small("rigid", one, LIGHT, HOLD, steady=False) for one in delta], "k--", lw=0.9, label="theory, no steady flow")
    light.plot(delta, [small("rigid", one, LIGHT, HOLD) for one in delta], "k-", lw=0.9, label="theory, steady flow in the box")
    light.plot([run.delta for run in some], [run.theory for run in some], "_", color="k", ms=9, label="theory in full")
    light.plot([run.delta for run in some], [run.force for run in some], "s", color="C2", mfc="none", label="particles")
    light.set(title=f"rigid body of {LIGHT:g} of the density", xlabel="boundary layer over radius, $\\delta/a$", ylabel="mean force over $\\pi a^2 k E \\sin 2kx$",
              xlim=(0, 1.2), ylim=(-0.8, 0.8))
    light.legend(loc="upper left")
    return save(figure, path, legends=(forces, errors, light))


def main():
    example = Example(HERE, "The force of sound on a cylinder.")
    args = example.arguments()
    runs = [Run(*case) for case in (QUICK_CASES if args.quick else CASES)]
    alone = Run("none", 0.6, 4 if args.quick else 6, width=2)
    rigid = [] if args.quick else [Run("none", 0.6, 6, 1, c, ends="rigid", width=2) for c in (1, 2, 4)]
    example.run({name: variables for run in [*runs, *rigid, alone] for name, variables in run.jobs().items()})
    for run in [*runs, *rigid, alone]:
        run.read(example.out)
    offset = alone.offset()
    for run in runs:
        run.measure(offset)
    runs.sort(key=lambda run: (["wall", "drop", "rigid"].index(run.body), run.ratio, run.delta, run.n))

    print(f"\nwave alone: frequency {alone.omega * alone.given['length'] / np.pi:.4f} of that of walls at the surface, which act {offset:.2f} spacings behind it")
    for run in rigid:
        print(f"between rigid bodies with a modulus of {run.c**2:g} times that of the fluid: {run.offset():.2f} spacings behind it")
    print("shear modulus of the lattice over pressure: " + ", ".join(f"{elasticity(support):.4f} at a support of {support:g}" for support in (3, 3.43, 4, SUPPORT)) + "\n")
    table = example.out / "radiation_force.csv"
    header = ["body", "ratio", "c", "delta", "particles", "support", "force", "theory", "steady", "size", "error", "error_of_first_order"]
    with csv_rows(table, header) as writerow:
        print("body   density  c       delta/a  particles in a  support  force    theory   steady flow  size     error    first order")
        for run in runs:
            row = [run.body, f"{run.ratio:g}", f"{run.c:g}", f"{run.delta:g}", run.n, f"{run.support:g}", *(f"{number:.4f}" for number in (
                   run.force, run.theory, run.steady, run.size, run.error, run.first_order))]
            writerow(row)
            print("{:<6} {:<8} {:<7} {:<8} {:<15} {:<8} {:<8} {:<8} {:<12} {:<8} {:<8} {}".format(*row))
    print()

    light = [run for run in runs if run.body == "rigid" and run.ratio == LIGHT]
    if light:
        print(f"a rigid body of {LIGHT:g} of the density goes to the node of the pressure for delta/a above")
        print(f"  {np.interp(0, [run.force for run in light], [run.delta for run in light]):.2f}  particles, between the runs")
        print(f"  {np.interp(0, [run.theory for run in light], [run.delta for run in light]):.2f}  theory in full, between the runs")
        for hold, steady, words in ((HOLD, True, "theory of a small ka"), (0, True, "theory, without the spring"), (0, False, "theory, without spring and steady flow")):
            print(f"  {brentq(lambda delta: small('rigid', delta, LIGHT, hold, steady), 0.2, 3, xtol=1e-4):.2f}  {words}")
        print()

    walls = [run for run in runs if run.body == "wall" and run.support == SUPPORT]
    example.merit("largest error of first order", max((run.first_order for run in runs), key=abs), -FIRST_ORDER, FIRST_ORDER)
    example.merit("largest error of the force on a cylinder at rest", max((run.error for run in walls), key=abs), -WALLS, WALLS)
    example.merit("largest error of the force on a drop", max((run.error for run in runs if run.body == "drop"), key=abs), -DROPS, DROPS)
    if not args.quick:
        example.merit("largest error of the force on a rigid body that moves", max((run.error for run in runs if run.body == "rigid"), key=abs), -RIGID, RIGID)
        finest = max(run.n for run in walls)
        error = {run.n: run.error for run in walls if run.delta == 0.6}
        example.merit(f"error of the force on a cylinder at rest, {finest} particles in the radius", error[finest], -FINEST, FINEST)
        example.merit("error with 4 particles over that of the finest lattice", error[4] / error[finest], 3, 8)
        example.merit("force on the light body, thinnest layer", light[0].force, -0.5, -0.3)
        example.merit("force on the light body, thickest layer", light[-1].force, 0.3, 0.5)
    return example.finish(plot(example.out / "radiation_force.png", runs), table)


if __name__ == "__main__":
    sys.exit(main())
