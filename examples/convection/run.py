#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Convection: a square cavity heated from the side, and the onset between two plates.

    ./sphd run convection          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import csv
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, frames, pyplot, save      # noqa: E402

PRANDTL = 0.71
CAVITY = {                                  # Rayleigh number: particles per side, duration, averages over the last part
    "1e5": (80, 60, 12),
    "1e4": (64, 36, 9),
    "1e3": (48, 18, 6),
}
QUICK = {"1e3": (24, 16, 4)}
LIMITS = {"1e3": 0.015, "1e4": 0.015, "1e5": 0.03}      # of the Nusselt number
SPEED = 0.03                                # of the largest velocities
PLACE = 0.01                                # of their positions, over the side
BALANCE = 1e-3                              # of heat in and heat out

CRITICAL = 1707.76                          # plates with given temperatures
LENGTH = 2.0                                # of a roll pair over the distance of the plates; the critical one is 2 pi/3.117
ONSET = (1500, 1900)
ROWS = {"N": 64, "support": 6, "end": 0.12}     # variables of in.convection_onset


def published():
    with open(HERE / "devahldavis1983.csv", newline="") as file:
        return {row.pop("Ra"): {key: float(value) for key, value in row.items()} for row in csv.DictReader(file)}


def peak(s, value, width=0.05):
    """Place and height of the maximum of a profile: of the polynomial of degree 4 through the points next to the largest."""
    near = np.abs(s - s[np.argmax(value)]) < max(width, 3.1 * (s[1] - s[0]))
    top = s[near]
    fit = np.polynomial.Polynomial.fit(top, value[near], 4)
    fine = np.linspace(top[0], top[-1], 2001)
    place = fine[np.argmax(fit(fine))]
    return place, fit(place)


class Cavity:
    """One cavity: means over the last part of the run, velocities in alpha/L."""

    def __init__(self, out, name, Ra, N):
        self.N, scale = N, np.sqrt(PRANDTL * float(Ra))
        cells = np.loadtxt(out / f"{name}.cells.txt", skiprows=4)
        bins = round(len(cells)**0.5)       # N, or one more, empty, where N times 1/N is rounded to less than 1
        count, *fields = (cells[:, column].reshape(bins, bins)[:N, :N] for column in (3, 4, 5, 6))
        assert (count > 0).all()
        self.s = (np.arange(N) + 0.5) / N
        self.vx, self.vy, self.T = fields
        self.u = scale * self.vx[N // 2 - 1:N // 2 + 1].mean(axis=0)
        self.v = scale * self.vy[:, N // 2 - 1:N // 2 + 1].mean(axis=1)
        self.y, self.u_max = peak(self.s, self.u)
        self.x, self.v_max = peak(self.s, self.v)
        history = np.loadtxt(out / f"{name}.time.txt")
        self.time, self.kinetic, self.hot, self.cold = history[:, 1:].T
        # for pictures
        self.psi = scale * np.cumsum(self.vx, axis=1) / N
        self.particles = next(iter(frames(out / f"{name}.particles.txt").values()))

    def means(self, duration):
        last = self.time > self.time[-1] - duration
        self.heat_in, self.heat_out = self.hot[last].mean(), self.cold[last].mean()
        self.nusselt = (self.heat_in + self.heat_out) / 2
        self.spread = (self.hot[last] + self.cold[last]).std() / 2


def growth(Ra, Pr, k, n=8):
    """Largest growth rate in alpha/H^2 of a roll of the wave number k/H, by the linear equations of the Boussinesq fluid,

        s (D^2 - k^2) w = Pr (D^2 - k^2)^2 w - Pr Ra k^2 T,   s T = w + (D^2 - k^2) T,   w = D w = T = 0 on the plates,

    in the first n polynomials that are even and obey the boundary conditions (Galerkin)
    """
    from numpy.polynomial import Legendre, Polynomial

    x, weight = np.polynomial.legendre.leggauss(4 * n)
    even = [Legendre.basis(2 * i).convert(kind=Polynomial) for i in range(n)]
    edge = Polynomial([1, 0, -1])
    W, T = (np.array([[2.0**d * f.deriv(d)(x) for d in (0, 2, 4)] for f in (edge**power * p for p in even)]) for power in (2, 1))
    lap = W[:, 1] - k * k * W[:, 0]
    product = lambda f, g: (weight * f) @ g.T
    zero = np.zeros((n, n))
    left = np.block([[product(W[:, 0], lap), zero], [zero, product(T[:, 0], T[:, 0])]])
    right = np.block([[Pr * product(W[:, 0], W[:, 2] - 2 * k * k * W[:, 1] + k**4 * W[:, 0]), -Pr * Ra * k * k * product(W[:, 0], T[:, 0])],
                      [product(T[:, 0], W[:, 0]), product(T[:, 0], T[:, 1] - k * k * T[:, 0])]])
    return np.linalg.eigvals(np.linalg.solve(left, right)).real.max()


class Roll:
    """Growth rate of a roll between the plates, in alpha/H^2."""

    def __init__(self, out, name):
        self.time, self.kinetic = np.loadtxt(out / f"{name}.time.txt")[:, 1:3].T
        self.late = self.time > self.time[-1] / 2
        self.rate = np.polyfit(self.time[self.late], np.log(self.kinetic[self.late]) / 2, 1)[0]


def plot_cavities(path, runs, table):
    plt = pyplot()
    figure, axes = plt.subplots(2, 3, figsize=(9.6, 6.6))
    for axis in axes[0, len(runs):]:
        axis.set_axis_off()
    for axis, (Ra, run) in zip(axes[0], reversed(runs.items())):
        place = run.particles
        shown = axis.scatter(place["x"], place["y"], c=place["v_temperature"] - 1, s=(142 / run.N) ** 2, cmap="coolwarm", vmin=-0.5, vmax=0.5, lw=0)
        axis.contour(run.s, run.s, run.psi.T, np.linspace(0, run.psi.min(), 8)[-2:0:-1], colors="k", linewidths=0.7, linestyles="-")
        axis.set(aspect="equal", xlim=(0, 1), ylim=(0, 1), xticks=(), yticks=(), title=f"Ra = {Ra}, {run.N} x {run.N} particles")
    figure.colorbar(shown, ax=axes[0], label="temperature $(T - T_0)/\\Delta T$", shrink=0.9)
    for color, (Ra, run) in zip(("C3", "C0", "k"), runs.items()):
        known, label = table[Ra], f"Ra = {Ra}"
        axes[1, 0].plot(run.s, run.v, color=color, lw=1, label=label)
        axes[1, 0].plot(known["x"], known["v_max"], "+", color=color, ms=12)
        axes[1, 1].plot(run.s, run.u, color=color, lw=1, label=label)
        axes[1, 1].plot(known["y"], known["u_max"], "+", color=color, ms=12)
        axes[1, 2].plot(run.time, run.hot, color=color, lw=1, label=label)
        axes[1, 2].plot(run.time, run.cold, color=color, lw=1, ls=":")
        axes[1, 2].axhline(known["Nu"], color=color, lw=0.6, ls="--")
    axes[1, 0].set(xlabel="place $x/L$", ylabel="velocity $v L/\\alpha$", title="velocity along y, at half height")
    axes[1, 1].set(xlabel="height $y/L$", ylabel="velocity $u L/\\alpha$", title="velocity along x, at half width")
    axes[1, 2].set(xlabel="time $t\\,\\sqrt{g\\beta\\Delta T/L}$", ylabel="Nusselt number of the heat", ylim=(0, 7), title="heat")
    axes[1, 0].plot([], [], "k+", ms=9, label="published maximum")
    for style, label in (("-", "in"), (":", "out"), ("--", "published")):
        axes[1, 2].plot([], [], "0.4", lw=1, ls=style, label=label)
    axes[1, 0].legend()
    axes[1, 1].legend()
    axes[1, 2].legend(ncols=2)
    return save(figure, path)


def plot_onset(path, rolls, k, critical):
    plt = pyplot()
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.4))
    for color, (Ra, roll) in zip(("C0", "C3"), rolls.items()):
        axes[0].semilogy(roll.time, roll.kinetic, color=color, label=f"Ra = {Ra}")
        exact = growth(Ra, 1.0, k)
        late = roll.late
        middle = np.log(roll.kinetic[late]).mean() - 2 * exact * roll.time[late].mean()
        axes[0].semilogy(roll.time[late], np.exp(middle + 2 * exact * roll.time[late]), "k--", lw=0.8)
        axes[1].plot(Ra, roll.rate, "o", color=color)
    axes[0].plot([], [], "k--", lw=0.8, label="linear theory")
    axes[0].set(xlabel="time $t\\alpha/H^2$", ylabel="kinetic energy (lj units)")
    numbers = np.linspace(min(rolls) - 100, max(rolls) + 100, 41)
    axes[1].plot(numbers, [growth(Ra, 1.0, k) for Ra in numbers], "k--", lw=0.8, label="linear theory")
    axes[1].plot(list(rolls), [roll.rate for roll in rolls.values()], "-", color="0.5", lw=0.8, label=f"particles: 0 at {critical:.0f}")
    axes[1].axhline(0, color="0.7", lw=0.6)
    axes[1].set(xlabel="Rayleigh number Ra", ylabel="growth rate in $\\alpha/H^2$")
    return save(figure, path, legends=axes)


def main():
    example = Example(HERE, "Convection: a square cavity heated from the side, and the onset between two plates.")
    example.parser.add_argument("--cases", nargs="+", choices=[*CAVITY, "onset"], help="some of the cases only")
    args = example.arguments()
    cases = QUICK if args.quick else CAVITY
    cases = {Ra: case for Ra, case in cases.items() if Ra in (args.cases or CAVITY)}
    onset = ONSET if not args.cases or "onset" in args.cases else ()
    jobs = {f"cavity.{Ra}": {"Ra": Ra, "Pr": PRANDTL, "N": N, "end": end, "mean": mean} for Ra, (N, end, mean) in cases.items()}
    jobs |= {f"onset.{Ra}": {"Ra": Ra, **({} if args.quick else ROWS)} for Ra in onset}
    example.run(jobs, {name: HERE / "in.convection_onset" for name in jobs if name.startswith("onset")})

    table, pictures = published(), []
    if cases:
        runs = {Ra: Cavity(example.out, f"cavity.{Ra}", Ra, N) for Ra, (N, _, _) in cases.items()}
        for Ra, run in reversed(runs.items()):
            run.means(cases[Ra][2])
            known = table[Ra]
            print(f"\nRa = {Ra}, N = {run.N}: Nu {run.nusselt:.4f} +- {run.spread:.4f} ({known['Nu']}), u {run.u_max:.3f} at {run.y:.3f} ({known['u_max']} at {known['y']}), "
                  f"v {run.v_max:.3f} at {run.x:.3f} ({known['v_max']} at {known['x']})")
            example.merit("Nusselt number over the published one, minus 1", run.nusselt / known["Nu"] - 1, -LIMITS[Ra], LIMITS[Ra])
            example.merit("heat out over heat in, minus 1", run.heat_out / run.heat_in - 1, -BALANCE, BALANCE)
            for velocity, place in (("u_max", "y"), ("v_max", "x")):
                example.merit(f"{velocity} over the published one, minus 1", getattr(run, velocity) / known[velocity] - 1, -SPEED, SPEED)
                example.merit(f"its {place}, minus the published one", getattr(run, place) - known[place], -PLACE, PLACE)
        pictures.append(plot_cavities(example.out / "cavity.png", runs, table))
    if onset:
        k = 2 * np.pi / LENGTH
        rolls = {Ra: Roll(example.out, f"onset.{Ra}") for Ra in onset}
        print()
        for Ra, roll in rolls.items():
            print(f"onset, Ra = {Ra}: growth rate {roll.rate:.4f} alpha/H^2, linear theory {growth(Ra, 1.0, k):.4f}")
        critical = np.interp(0.0, [roll.rate for roll in rolls.values()], list(rolls))
        print(f"critical Rayleigh number {critical:.1f}")
        example.merit("critical Rayleigh number over the exact one, minus 1", critical / CRITICAL - 1, -0.02, 0.02)
        pictures.append(plot_onset(example.out / "onset.png", rolls, k, critical))
    return example.finish(*pictures)


if __name__ == "__main__":
    sys.exit(main())
