#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""A drop that oscillates under a central force, against the exact solution.

    ./sphd run oscillating_drop          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.path.insert(0, str(HERE.parent))
from exact import Drop, invariants, period      # noqa: E402
from run_lammps import Example, csv_rows, frames, pyplot, save          # noqa: E402

KAPPA = 0.1             # of the runs without shear viscosity
MU = KAPPA / 3          # and of those without bulk term: kappa = 2 mu then, and sound is damped by kappa + mu
P0, GAMMA = 0.25, 300   # of the equation of state
NONE = {"shear": "none", "bulk": "none"}
MG = {"shear": "mg", "bulk": "none", "mu": MU}
SURFACES = {            # other ways to deal with the free surface
    "linear": {"eos": "linear"},
    "linear_equal": {"eos": "linear", "masses": "equal"},
    "power_equal": {"masses": "equal"},
    "continuity": {"eos": "linear", "masses": "equal", "density": "continuity"},
}
CONSERVED = 1e-12       # momenta, round-off of some 10,000 steps
LIMITS = {              # (periods, small version): kappa
    (1, True): {"shape": 0.02, "area": 0.015, "lost": 0.015, "surface": 0.5, "pressure": 0.12},
    (1, False): {"shape": 0.01, "area": 0.015, "lost": 0.01, "surface": 0.5, "pressure": 0.05},
    (5, False): {"shape": 0.04, "area": 0.015, "lost": 0.04, "surface": 1.0, "pressure": 0.05},
}
CONTINUITY = {1: {"shape": 0.006, "lost": 0.015}, 2: {"shape": 0.009, "lost": 0.015}}    # periods: of density continuity


class Run:
    """A run with what the continuum says: the second moment of the mass at the start sets the length R."""

    def __init__(self, out, name, variables):
        self.name, self.n, self.W = name, variables["n"], variables.get("W", 0.0)
        data = np.loadtxt(out / f"{name}.balance.txt")
        self.t, xx, yy, xy, self.momentum, Px, Py, self.kinetic, self.elastic, self.internal, self.p = data[:, 1:].T
        self.frames = list(frames(out / f"{name}.particles.txt").values())
        mass = self.frames[0]["mass"].sum()
        moment = 0.5 * (xx[0] + yy[0])
        self.R2 = 4 * moment / mass
        self.exact = Drop(1.0, self.W, self.t)
        moments = np.moveaxis(np.array([[xx, xy], [xy, yy]]), -1, 0) / moment
        self.axes = np.sqrt(np.linalg.eigvalsh(moments))
        self.along = np.sqrt(moments[:, (0, 1), (0, 1)])      # semi-axes along x and y, if the axes are those
        # an error of the shape, and what is compressed: the semi-axes that they would be with the area of the disc
        self.shape = np.sqrt((self.axes[:, 1] / self.axes[:, 0]) / (self.exact.axes[:, 1] / self.exact.axes[:, 0])) - 1
        self.area = self.axes.prod(axis=1)
        field = 0.5 * (xx + yy)
        self.energy = (self.kinetic + field) / (self.kinetic[0] + field[0])
        self.total = (self.kinetic + field + self.internal) / (self.kinetic[0] + field[0] + self.internal[0])
        # over the largest momenta that particles with this kinetic energy could have
        self.P = np.hypot(Px, Py) / np.sqrt(2 * mass * self.kinetic[0])
        self.J = np.abs(self.momentum - self.momentum[0]) / np.sqrt(2 * self.kinetic[0] * (xx[0] + yy[0]))
        self.pressure = 0.5 * self.R2 * self.exact.s

    def until(self, periods, T):
        return self.t < T * (periods + 1e-6)

    def at(self, periods, T):
        return np.argmin(np.abs(self.t - periods * T))

    def frame(self, periods, T):
        """The particles, and F and L of the exact solution at that time."""
        k = round(8 * periods)
        i = self.at(k / 8, T)
        return self.frames[k], self.exact.F[i], self.exact.L[i]

    def velocity(self, periods, T):
        """Over the root mean square velocity at the start: the error, and what is left of it without linear flow."""
        frame, _, L = self.frame(periods, T)
        x, v, m = np.array([frame["x"], frame["y"]]), np.array([frame["vx"], frame["vy"]]), frame["mass"]
        fit = (m * v) @ x.T @ np.linalg.inv((m * x) @ x.T)
        return [np.sqrt((m * (v - G @ x) ** 2).sum() / (2 * self.kinetic[0])) for G in (L, fit)]

    def outermost(self, frame, F):
        """Where the outermost particles, in 2 n sectors, were at the start if they have moved like the exact solution."""
        X = np.linalg.inv(F) @ np.array([frame["x"], frame["y"]])
        sector = ((np.arctan2(X[1], X[0]) / np.pi + 1) * self.n).astype(int) % (2 * self.n)
        radius = np.hypot(*X)
        return X[:, [np.flatnonzero(sector == k)[np.argmax(radius[sector == k])] for k in range(2 * self.n) if (sector == k).any()]]

    def surface_error(self, periods, T):
        """Root mean square and largest distance of the outermost particles from their ellipse, over the spacing."""
        edge = np.hypot(*self.outermost(*self.frame(0, T)[:2])).mean()
        frame, F, _ = self.frame(periods, T)
        X = self.outermost(frame, F)
        radius = np.hypot(*X)
        distance = (radius - edge) / np.hypot(*(np.linalg.inv(F).T @ (X / radius))) * self.n
        return np.sqrt(np.mean(distance**2)), np.abs(distance).max()


def plot_drop(path, runs, T, n):
    plt = pyplot()
    sizes = sorted(run.n for name, run in runs.items() if name.startswith("kappa_"))
    main, mg, fine = runs[f"kappa_{n}"], runs["mg"], runs[f"kappa_{sizes[-1]}"]
    end = main.t[-1] / T
    figure = plt.figure(figsize=(9.6, 8.8), constrained_layout=False)
    top = figure.add_gridspec(1, 5, left=0.06, right=0.925, top=0.975, bottom=0.725, wspace=0.12, width_ratios=[1, 1, 1, 1, 0.06])
    last = round(4 * fine.t[-1] / T - 1) / 4
    for column, periods in enumerate((0, 0.25, 0.5, last)):
        axes = figure.add_subplot(top[0, column])
        frame, F, _ = fine.frame(periods, T)
        p = P0 * (frame["mass"] / frame["c_volume"]) ** GAMMA
        picture = axes.scatter(frame["x"], frame["y"], c=p, s=90 / fine.n**1.1, lw=0, vmin=0, vmax=1, cmap="viridis", rasterized=True)
        angle = np.linspace(0, 2 * np.pi, 300)
        axes.plot(*(np.sqrt(fine.R2) * F @ np.array([np.cos(angle), np.sin(angle)])), "k-", lw=0.7)
        axes.set(xlim=(-2.05, 2.05), ylim=(-2.05, 2.05), aspect="equal", xlabel="$x/R$", xticks=range(-2, 3), yticks=range(-2, 3))
        axes.set_title(f"$t = {periods:g}\\,T$" + (f", n = {fine.n}" if column == 0 else ""))
        if column:
            axes.set_yticklabels([])
        else:
            axes.set_ylabel("$y/R$")
    figure.colorbar(picture, cax=figure.add_subplot(top[0, 4]), label="pressure $p/(\\rho B^2R^2)$")

    grid = figure.add_gridspec(2, 3, left=0.06, right=0.985, top=0.635, bottom=0.055, hspace=0.33, wspace=0.23)
    axes = figure.add_subplot(grid[0, :])
    for k, style in enumerate(("-", "--")):
        axes.plot(main.t / T, np.sqrt(main.exact.moments[:, k, k]), "k", ls=style, lw=2.6, alpha=0.3, label=None if k else "exact")
        axes.plot(main.t / T, main.along[:, k], "C0", ls=style,
                  label=None if k else f"$\\kappa$ = {KAPPA:g}, no shear viscosity, n = {main.n}")
        axes.plot(mg.t / T, mg.along[:, k], "C3", ls=style,
                  label=None if k else f"$\\mu$ = {MU:.3f}, no bulk term: the same damping of sound, n = {mg.n}")
    axes.set(xlim=(0, end), ylim=(0.35, 2.45), xlabel="time over the period, $t/T$", ylabel="semi-axes $a/R$, $b/R$", title="semi-axes along x (lines) and y (dashed)")
    axes.legend(ncol=3, loc="upper center")

    left, middle, right = (figure.add_subplot(grid[1, k]) for k in range(3))
    for k, size in enumerate(sizes):
        run, color = runs[f"kappa_{size}"], f"C{(2, 1, 0, 4)[k if len(sizes) > 2 else k + 1]}"
        left.semilogy(run.t / T, np.maximum.accumulate(np.maximum(np.abs(run.shape), 1e-6)), color, label=f"n = {run.n}")
        middle.plot(run.t / T, 1 - run.energy, color, label=f"$\\kappa$, n = {run.n}")
        if run is fine:
            right.plot(run.t / T, run.pressure, "k", lw=2.6, alpha=0.3, label="exact")
            right.plot(run.t / T, run.p, color, lw=0.8, label=f"n = {run.n}")
    if "none" in runs:
        middle.plot(runs["none"].t / T, 1 - runs["none"].energy, "k:", lw=1.4, label=f"no viscosity, n = {runs['none'].n}")
    middle.plot(mg.t / T, 1 - mg.energy, "C3", label=f"$\\mu$, n = {mg.n}")
    estimate = Drop(1.0, 0.0, mg.t, MU / mg.R2)
    middle.plot(mg.t / T, 1 - estimate.energy / estimate.energy[0], "k--", lw=0.9, label="estimate for $\\mu$")
    left.set(ylim=(1e-4, 0.2), title="error of $(a/b)^{1/2}$, largest until then")
    middle.set(ylim=(-0.02, 0.5), title="lost part of the mechanical energy")
    right.set(ylim=(0, 1.5), title="pressure in the centre $/(\\rho B^2R^2)$")
    for axes, stop in ((left, end), (middle, end), (right, fine.t[-1] / T)):
        axes.set(xlim=(0, stop), xlabel="time over the period, $t/T$")
        axes.legend(loc="lower right" if axes is left else "upper right", ncol=2 if axes is right else 1, framealpha=0.9)
    save(figure, path)


def plot_spin(path, runs, T):
    plt = pyplot()
    figure, ((picture, left), (middle, right)) = plt.subplots(2, 2, figsize=(8.6, 7.0))
    cases = {"spin": ("C0", f"$\\kappa$ = {KAPPA:g}"), "spin_mg": ("C1", f"mg, $\\mu$ = {MU:.3f}"), "spin_morris": ("C3", "morris, the same")}
    run = runs["spin"]
    angle = np.linspace(0, 2 * np.pi, 300)
    for periods, color in ((0.25, "C0"), (0.75, "C2")):
        frame, F, _ = run.frame(periods, T)
        picture.scatter(frame["x"], frame["y"], s=40 / run.n**1.1, lw=0, color=color, label=f"$t = {periods}\\,T$")
        picture.plot(*(np.sqrt(run.R2) * F @ np.array([np.cos(angle), np.sin(angle)])), "k-", lw=0.7)
    picture.set(xlim=(-2.1, 2.1), ylim=(-2.1, 2.1), aspect="equal", xlabel="$x/R$", ylabel="$y/R$", title=f"$\\kappa$, n = {run.n}; lines: exact")
    picture.legend(markerscale=6, loc="lower left")
    left.plot(run.t / T, run.exact.axes, "k-", lw=2.6, alpha=0.3)
    for name, (color, label) in cases.items():
        run = runs[name]
        left.plot(run.t / T, run.axes, color, lw=1.0)
        middle.plot(run.t / T, run.momentum / run.momentum[0], color, ls="--" if name == "spin_mg" else "-", label=label)
        right.semilogy(run.t[1:] / T, np.maximum(np.abs(run.momentum[1:] / run.momentum[0] - 1), 1e-16), color, lw=0.8, label=label)
    estimate = Drop(1.0, run.W, run.t, MU / run.R2, "laplace")
    middle.plot(run.t / T, estimate.momentum / estimate.momentum[0], "k:", lw=1.2, label="estimate for morris")
    left.set(title="semi-axes $/R$; grey: exact", ylim=(0.4, 2.1))
    middle.set(title="angular momentum $L/L(0)$", ylim=(0, 1.05))
    right.set(title="change of the angular momentum, relative", ylim=(5e-17, 3))
    for axes in (left, middle, right):
        axes.set(xlabel="time over the period, $t/T$", xlim=(0, run.t[-1] / T))
    middle.legend(loc="lower left")
    save(figure, path)


def main():
    example = Example(HERE, "A drop that oscillates under a central force.")
    args = example.arguments()
    T = period(1.0)
    n, sizes, spinning, end, long = (25, (25, 16), 16, 1, 1) if args.quick else (50, (100, 50, 25), 50, 2, 5)
    jobs = {f"kappa_{k}": {"n": k, "periods": end if k == 100 else long} for k in sizes}
    jobs["mg"] = {"n": n, "periods": end, **MG}
    jobs["spin"] = {"n": spinning, "periods": end, "W": 0.5}
    jobs["spin_mg"] = {"n": spinning, "periods": end, "W": 0.5, **MG}
    jobs["spin_morris"] = {"n": spinning, "periods": end, "W": 0.5, **MG, "shear": "morris"}
    if not args.quick:
        jobs["none"] = {"n": n, "periods": end, **NONE}
        jobs |= {name: {"n": 25, "periods": end, **variables} for name, variables in SURFACES.items()}
    for variables in jobs.values():
        variables.update(kappa=KAPPA, p0=P0, gamma=GAMMA, period=T)
    example.run(jobs)
    runs = {name: Run(example.out, name, variables) for name, variables in jobs.items()}

    print(f"\nperiod of the exact solution: {T:.5f}/B\n\n"
          f"{'run':13s}   n  t/T  shape     area      energy    sum       v error  noise    surface/dx    pressure  L drift  P drift")
    table = example.out / "oscillating_drop.csv"
    measured = {}
    with csv_rows(table, ["run", "n", "periods", "shape_error", "area_change", "energy_lost", "total_energy_change", "velocity_error",
                          "velocity_noise", "surface_rms_dx", "surface_max_dx", "pressure_error", "L_change", "P_change"]) as writerow:
        for name, run in runs.items():
            for periods in (1, 2, 5):
                if run.t[-1] < T * (periods - 1e-6):
                    continue
                u, i = run.until(periods, T), run.at(periods, T)
                error = np.sqrt(np.mean((run.p - run.pressure)[u] ** 2)) / run.pressure[0]
                values = [np.abs(run.shape[u]).max(), np.abs(run.area[u] - 1).max(), 1 - run.energy[i], np.abs(run.total[u] - 1).max(),
                          *run.velocity(periods, T), *run.surface_error(periods, T), error, run.J[u].max(), run.P[u].max()]
                measured[name, periods] = dict(zip(("shape", "area", "lost", "total", "velocity", "noise", "surface", "farthest",
                                                    "pressure", "L", "P"), values))
                writerow([name, run.n, periods, *(f"{value:.4e}" for value in values)])
                print("{:13s} {:3d} {:4d}  {:.2e}  {:.2e}  {:8.5f}  {:.1e}   {:.4f}   {:.4f}   {:5.2f} {:6.2f}  {:.4f}    {:.0e}    {:.0e}".format(
                    name, run.n, periods, *values))

    print()
    for W in (0.0, 0.5):
        example.merit(f"exact solution, W = {W:g}: largest change of an invariant", max(invariants(1.0, W)), 0.0, 1e-8)
    long_name = f"kappa_{n}"
    for name, periods in dict.fromkeys([(long_name, 1), (long_name, long), ("spin", 1)]):
        here, limit = measured[name, periods], LIMITS[periods, args.quick]
        for key, text in (("shape", "largest error of the square root of a/b"), ("area", "largest change of the area"),
                          ("lost", "lost mechanical energy"), ("surface", "surface, distance from the exact one over dx"),
                          ("pressure", "pressure in the centre, error")):
            example.merit(f"{name}, {periods} period(s): {text}", here[key], -1e-3 if key == "lost" else 0.0, limit[key])
    if not args.quick:
        for coarse, fine, periods in ((25, 50, 5), (50, 100, 2)):
            for key in ("shape", "lost"):
                example.merit(f"{key}, {periods} periods: n = {fine} over n = {coarse}",
                              measured[f"kappa_{fine}", periods][key] / measured[f"kappa_{coarse}", periods][key], 0.0, 0.7)
        for periods, limit in CONTINUITY.items():
            for key, text in (("shape", "largest error of the square root of a/b"), ("lost", "lost mechanical energy")):
                example.merit(f"continuity, {periods} period(s): {text}", measured["continuity", periods][key], -1e-3, limit[key])
    for name, run in runs.items():
        if name != "none":
            example.merit(f"{name}: change of the sum of energies", np.abs(run.total - 1).max(), 0.0, 1e-3)
        example.merit(f"{name}: linear momentum", run.P.max(), 0.0, CONSERVED)
        if name != "spin_morris":
            example.merit(f"{name}: change of the angular momentum", run.J.max(), 0.0, CONSERVED)
    mg, morris = runs["mg"], runs["spin_morris"]
    estimate = Drop(1.0, 0.0, mg.t, MU / mg.R2)
    i = mg.at(1, T)
    example.merit("mg, 1 period: lost mechanical energy over the estimate", (1 - mg.energy[i]) / (1 - estimate.energy[i] / estimate.energy[0]), 0.8, 1.1)
    example.merit("mg, 1 period: lost mechanical energy over that with kappa", (1 - mg.energy[i]) / measured[long_name, 1]["lost"], 20, 1e9)
    estimate = Drop(1.0, morris.W, morris.t, MU / morris.R2, "laplace")
    lost = 1 - morris.momentum[i] / morris.momentum[0]
    example.merit("morris, 1 period: lost angular momentum over the estimate", lost / (1 - estimate.momentum[i] / estimate.momentum[0]), 0.8, 1.1)
    print(f"morris, 1 period: lost {100 * lost:.1f} % of the angular momentum\n")

    pictures = [example.out / "drop.png", example.out / "spin.png"]
    plot_drop(pictures[0], runs, T, n)
    plot_spin(pictures[1], runs, T)
    return example.finish(*pictures, table)


if __name__ == "__main__":
    sys.exit(main())
