#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Lid-driven cavity of a Newtonian and of a micropolar fluid against Ghia, Ghia and Shin and finite differences.

    ./sphd run cavity          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check] [--size N] [--cases NAME ...] [--switches WORDS] [--sample N]
"""

import csv
import sys
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, frames, pyplot, save      # noqa: E402
import reference                    # noqa: E402

# name: label, case of reference.csv, variables of the input; the longest first.  Where viscosity is large, so is the pressure
# in the corners at the lid, and the fluid has to be stiffer.
CASES = {
    "k3": ("$K = 3$, spin diffuses", "k3", {"Re": 400, "K": 3, "c0": 10, "pb": 0, "end": 12, "mean": 4}),
    "re1000": ("Re = 1000", "re1000", {"Re": 1000, "c0": 5, "end": 40, "mean": 10}),
    "k3b": ("$K = 3$, spin does not diffuse", "re160", {"Re": 400, "K": 3, "gamma1": 0, "inertia": 1e-4, "c0": 10, "pb": 0, "end": 12, "mean": 4}),
    "re400": ("Re = 400", "re400", {"Re": 400, "c0": 5, "end": 25, "mean": 5}),
    "re100": ("Re = 100", "re100", {"Re": 100, "c0": 10, "pb": 0, "end": 10, "mean": 4}),
}
QUICK = {"k3": {"end": 9, "mean": 3}, "re100": {"end": 9, "mean": 3}}
# that pressure grows with 1/spacing
FINE, STIFF = 200, {"k3": {"c0": 20}, "k3b": {"c0": 20}}
SUPPORT = 4             # support radius over particle spacing, as in the input
# The pressure on fluid and wall has a part along the wall, -LEVER rc dp/dx per length of wall: 2/3 of the integral of F r^4 dr
LEVER = 2 / 3 * (7 / np.pi) * 20 / 280
# limits: profiles against Ghia or the finite differences (rms), kinetic energy and force on the inner lid (relative)
LIMITS = {
    100: {"re100": (0.015, 0.03, 0.05), "re400": (0.015, 0.03, 0.05), "re1000": (0.03, 0.03, 0.05),
          "k3": (0.015, 0.03, 0.05), "k3b": (0.015, 0.03, 0.05)},
    50: {"re100": (0.01, 0.03, 0.05), "k3": (0.01, 0.03, 0.05)},
}


def interpolated(tree, values, points, radius):
    """Weighted linear fit around each point; the weight is the kernel, Wendland C2."""
    found = []
    for point in points:
        near = tree.query_ball_point(point, radius)
        d = (tree.data[near] - point) / radius
        q = np.hypot(*d.T)
        basis = np.column_stack([np.ones(len(near)), d])
        weighted = (basis * ((1 - q) ** 4 * (1 + 4 * q))[:, None]).T
        found.append(np.linalg.solve(weighted @ basis, weighted @ values[near])[0])
    return np.array(found)


class References:
    def __init__(self):
        with open(HERE / "reference.csv", newline="") as file:
            self.numbers = {row["case"]: {key: float(value) for key, value in row.items() if key != "case"} for row in csv.DictReader(file)}
        self.profiles, self.lid, self.psi, self.energy = (np.genfromtxt(HERE / f"reference_{name}.csv", delimiter=",", names=True)
                                                          for name in ("profiles", "lid", "psi", "energy"))

    def profile(self, what, case, s):
        return np.interp(s, self.profiles["s"], self.profiles[f"{what}_{case}"])

    def energy_at(self, case, times):
        """Kinetic energy at these times; the steady value where the transient has ended."""
        use = np.isfinite(self.energy[case])
        return np.interp(times, self.energy["t"][use], self.energy[case][use])


class Run:
    def __init__(self, out, base, size, variables, references):
        name = f"{base}.n{size}"
        self.label, self.case, _ = CASES[base]
        self.t, self.energy, lid, middle = np.loadtxt(out / f"{name}.time.txt").T[1:]
        last = self.t > variables["end"] - variables["mean"]
        self.kinetic, self.spread = self.energy[last].mean(), self.energy[last].std()
        numbers = references.numbers[self.case]
        self.steady = numbers["kinetic_energy"]
        # the finite differences at the same times, nearly but not quite their steady state
        self.expected = references.energy_at(self.case, self.t[last]).mean()

        m = size // 2
        cells = np.loadtxt(out / f"{name}.cells.txt", skiprows=4)
        self.cell = (np.arange(m) + 0.5) / m
        self.u, self.v, pressure = (cells[:, k].reshape(m, m).T for k in (4, 5, 6))
        psi = np.vstack([np.zeros(m), np.cumsum(self.u, axis=0) / m])
        self.edge = np.arange(m + 1) / m
        self.psi = psi - np.outer(self.edge, psi[-1])       # closed at the lid
        # center of the vortex: a parabola through what is near the smallest value
        j, i = np.unravel_index(self.psi.argmin(), self.psi.shape)
        x, y = np.meshgrid(self.cell - self.cell[i], self.edge - self.edge[j])
        near = np.hypot(x, y) < 0.1
        x, y = x[near], y[near]
        c = np.linalg.lstsq(np.column_stack([np.ones_like(x), x, y, x * x, x * y, y * y]), self.psi[near], rcond=None)[0]
        dx, dy = np.linalg.solve([[2 * c[3], c[4]], [c[4], 2 * c[5]]], -c[1:3])
        self.vortex = c[0] + 0.5 * (c[1] * dx + c[2] * dy), self.cell[i] + dx, self.edge[j] + dy

        near = [np.abs(self.cell - x) < 0.035 for x in reference.INNER]
        self.pull = LEVER * SUPPORT / size * (pressure[-1, near[1]].mean() - pressure[-1, near[0]].mean())
        self.lid, self.lid_all = -middle[last].mean() - self.pull, -lid[last].mean()
        self.lid_error = self.lid / numbers["lid_0.1_0.9"] - 1
        columns = np.loadtxt(out / f"{name}.lid.txt", skiprows=4)
        self.lid_x, self.lid_stress = columns[:, 1], -columns[:, 3] / 0.02

        particles = np.hstack([list(frame.values()) for frame in frames(out / f"{name}.lines.txt").values()])
        tree = cKDTree(particles[:2].T)
        self.s = np.linspace(0.5 / size, 1 - 0.5 / size, size)

        def along(column, s, upright):
            half = np.full_like(s, 0.5)
            return interpolated(tree, particles[column], np.column_stack([half, s] if upright else [s, half]), 2 / size)

        self.profile_u, self.profile_v, self.profile_spin = along(2, self.s, True), along(3, self.s, False), along(4, self.s, True)
        self.spin_error = None
        if base == "k3" and abs(variables["end"] - 0.5 * variables["mean"] - 10) < 0.1:
            exact = np.interp(self.s, references.profiles["s"], references.profiles["spin_k3_10"])
            self.spin_error = np.sqrt(((self.profile_spin - exact) ** 2).sum() / (exact**2).sum())
        re = self.case[2:] if self.case != "re160" and self.case != "k3" else "100"
        (y, u), (x, v) = reference.ghia(re)
        y, u, x, v = (a[1:-1] for a in (y, u, x, v))
        found = np.concatenate([along(2, y, True), along(3, x, False)])
        exact = np.concatenate([references.profile("u", self.case, y), references.profile("v", self.case, x)])
        self.to_reference = np.sqrt(((found - exact) ** 2).mean())
        self.to_ghia = np.sqrt(((found - np.concatenate([u, v])) ** 2).mean()) if base.startswith("re") else None

        step, t, px, py, wx, wy, fx, fy = np.loadtxt(out / f"{name}.momentum.txt").T
        dt = np.diff(t).mean()
        worst = 0.0
        for p, wall, fluid in ((px, wx, fx), (py, wy, fy)):
            worst = max(worst, np.abs(wall + fluid).max(), np.abs(np.diff(p) / dt + 0.5 * (wall[1:] + wall[:-1])).max())
        self.balance = worst / self.lid_all
        (self.particles,) = frames(out / f"{name}.particles.txt").values()


COLORS = {"re100": "C0", "re400": "C2", "re1000": "C3", "k3": "C1", "k3b": "C4"}


def plot_energy(path, runs, references):
    plt = pyplot()
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.8))
    for base, run in runs.items():
        left.plot(run.t, run.energy, color=COLORS[base], label=run.label, alpha=0.9)
        left.plot(run.t, references.energy_at(run.case, run.t), "k--", lw=0.9)
        right.plot(run.lid_x, run.lid_stress, "o", color=COLORS[base], ms=3, mfc="none", label=run.label)
        right.plot(references.lid["x"], references.lid[run.case], "k--", lw=0.9)
    left.plot([], [], "k--", lw=0.9, label="finite differences")
    left.set(xlabel="time $tU/L$", ylabel="kinetic energy$\\,/\\,\\rho U^2 L^2$", xlim=(0, None), ylim=(0, None))
    left.legend(loc="lower right")
    right.set(xlabel="place $x/L$", ylabel="shear stress on the lid$\\,/\\,\\rho U^2$", xlim=(0, 1), ylim=(0, 0.4))
    save(figure, path)


def plot_profiles(path, runs, references):
    plt = pyplot()
    newtonian = [base for base in runs if base.startswith("re")]
    spinning = [base for base in runs if base in ("re400", "k3", "k3b")] if {"k3", "k3b"} & set(runs) else []
    rows = [["u", "u", "u", "v", "v", "v"]] if newtonian else []
    if spinning:
        rows.append(["u3", "u3", "v3", "v3", "w", "w"] if "k3" in runs else ["u3", "u3", "u3", "v3", "v3", "v3"])
    figure, axes = plt.subplot_mosaic(rows, figsize=(9.6, 3.7 * len(rows)))
    for suffix, group in (("", newtonian), ("3", spinning)):
        if not group:
            continue
        left, right = axes[f"u{suffix}"], axes[f"v{suffix}"]
        for base in group:
            run = runs[base]
            left.plot(run.profile_u, run.s, color=COLORS[base], label=run.label)
            right.plot(run.s, run.profile_v, color=COLORS[base])
            left.plot(references.profile("u", run.case, run.s), run.s, "k--", lw=0.8)
            right.plot(run.s, references.profile("v", run.case, run.s), "k--", lw=0.8)
            if run.to_ghia is not None and not suffix:
                (y, u), (x, v) = reference.ghia(run.case[2:])
                left.plot(u, y, "o", color=COLORS[base], ms=4, mfc="none")
                right.plot(x, v, "o", color=COLORS[base], ms=4, mfc="none")
        left.plot([], [], "k--", lw=0.8, label="finite differences")
        if not suffix:
            left.plot([], [], "ko", ms=4, mfc="none", label="Ghia et al. (1982)")
        left.set(xlabel="velocity along x, $u/U$, at $x = L/2$", ylabel="height $y/L$", ylim=(0, 1))
        right.set(xlabel="place $x/L$", ylabel="velocity along y, $v/U$, at $y = L/2$", xlim=(0, 1))
        left.legend(loc="lower right")
    if "w" in axes:
        axes["w"].plot(runs["k3"].profile_spin, runs["k3"].s, color=COLORS["k3"])
        axes["w"].plot(references.profiles["spin_k3_10"], references.profiles["s"], "k--", lw=0.8, label="finite differences, $t = 10$")
        axes["w"].plot(references.profiles["spin_k3"], references.profiles["s"], "k:", lw=0.8, label="steady")
        axes["w"].legend(loc="lower left")
        axes["w"].set(xlabel="spin$\\,L/U$ at $x = L/2$", ylim=(0, 1), title=runs["k3"].label)
    save(figure, path)


def plot_streamlines(path, runs, references):
    plt = pyplot()
    chosen = [base for base in ("re400", "k3", "re1000") if base in runs] or list(runs)
    figure, axes = plt.subplots(1, len(chosen), figsize=(3.2 * len(chosen), 3.5), squeeze=False)
    levels = [-0.115, -0.11, -0.1, -0.085, -0.07, -0.05, -0.03, -0.015, -0.005, 0.0004, 0.0008, 0.0014]
    grid = np.unique(references.psi["x"])
    for axis, base in zip(axes[0], chosen):
        run = runs[base]
        axis.contour(run.cell[1:-1], run.edge, run.psi[:, 1:-1], levels, colors=COLORS[base], linestyles="-", linewidths=1.2)
        axis.contour(grid, grid, references.psi[run.case].reshape(len(grid), -1), levels, colors="k", linestyles="--", linewidths=0.7)
        axis.set(xlim=(0, 1), ylim=(0, 1), aspect="equal", xlabel="place $x/L$", title=run.label)
    axes[0, 0].set_ylabel("height $y/L$")
    save(figure, path)


def plot_particles(path, runs, disorder):
    plt = pyplot()
    panels = [(runs[base].label, runs[base].particles) for base in sorted(runs, key=["re1000", "k3", "re400", "re100", "k3b"].index)][:2]
    if disorder:
        panels.append(("Re = 1000, $N = 50$, without shifting", *frames(disorder).values()))
    figure, axes = plt.subplots(1, len(panels), figsize=(3.2 * len(panels), 3.2), squeeze=False)
    for axis, (label, particles) in zip(axes[0], panels):
        x, y, vx, vy = (particles[column] for column in ("x", "y", "vx", "vy"))
        shown = axis.scatter(x, y, c=np.hypot(vx, vy), s=1.1 * 100**2 / len(x), vmin=0, vmax=0.8, cmap="viridis", lw=0)
        axis.set(xlim=(0, 1), ylim=(0, 1), aspect="equal", xlabel="place $x/L$", title=label)
    axes[0, 0].set_ylabel("height $y/L$")
    figure.colorbar(shown, ax=axes[0], label="speed$\\,/\\,U$", shrink=0.85)
    save(figure, path)


def main():
    example = Example(HERE, "Lid-driven cavity.")
    example.parser.add_argument("--size", type=int, metavar="N", help="particles per side (100, and 50 for comparison; --quick: 50)")
    example.parser.add_argument("--cases", nargs="+", choices=CASES, help="some of the cases only")
    example.parser.add_argument("--sample", type=int, metavar="N", help="steps between the values that means over time are taken of (1)")
    args = example.arguments()
    sizes = [args.size] if args.size else [50] if args.quick else [100, 50]
    cases = [base for base in CASES if base in (args.cases or (["re100", "k3"] if args.quick else CASES))]
    keys = [(base, size) for size in sizes for base in cases]
    names = {(base, size): f"{base}.n{size}" for base, size in keys}
    variables = {(base, size): {"N": size, **CASES[base][2], **(QUICK[base] if args.quick and base in QUICK else {})} for base, size in keys}
    for (base, size), values in variables.items():
        if size > FINE:
            values.update(STIFF.get(base, {}))
    if args.sample:
        for values in variables.values():
            values["sample"] = args.sample
    jobs = {names[key]: values for key, values in variables.items()}
    disorder = "re1000.noshift"         # for the figure of the particles only
    if not (args.quick or args.cases or args.size):
        jobs[disorder] = {"N": 50, **CASES["re1000"][2], "c0": 7, "shift": 0, "end": 20, "mean": 5}
    example.run(jobs)
    references = References()
    runs = {key: Run(example.out, *key, variables[key], references) for key in keys}

    table = example.out / "cavity.csv"
    with csv_rows(table, ["case", "N", "rms_to_ghia", "rms_to_finite_differences", "kinetic_energy", "spread", "same_times", "steady",
                          "lid_0.1_0.9", "reference_lid", "pressure_part", "whole_lid", "psi", "reference_psi", "balance"]) as writerow:
        for (base, size), run in runs.items():
            numbers = references.numbers[run.case]
            print(f"\n{base}, N = {size}: kinetic energy {run.kinetic:.5f} +- {run.spread:.5f}, finite differences {run.expected:.5f} "
                  f"at the same times, {run.steady:.5f} steady; vortex psi {run.vortex[0]:.4f} at {run.vortex[1]:.3f}, {run.vortex[2]:.3f}, "
                  f"finite differences {numbers['psi']:.4f} at {numbers['x']:.3f}, {numbers['y']:.3f}; "
                  f"force on the lid {run.lid_all:.5f}, on 0.1 < x < 0.9 {run.lid:.5f} without {run.pull:.5f} from the pressure")
            limits = LIMITS.get(size, {}).get(base)
            if limits:
                if run.to_ghia is not None:
                    example.merit("rms deviation from Ghia et al. over both profiles", run.to_ghia, 0, limits[0])
                example.merit("rms deviation from finite differences, same points", run.to_reference, 0, limits[0])
                example.merit("kinetic energy over that of finite differences, minus 1", abs(run.kinetic / run.expected - 1), 0, limits[1])
                example.merit("force on 0.1 < x < 0.9 over that of finite differences, minus 1", abs(run.lid_error), 0, limits[2])
            else:
                print(f"rms deviation from finite differences {run.to_reference:.4f}"
                      + (f", from Ghia et al. {run.to_ghia:.4f}" if run.to_ghia is not None else "")
                      + f"; kinetic energy {100 * (run.kinetic / run.expected - 1):+.2f} %, force {100 * run.lid_error:+.2f} %")
            if run.spin_error is not None:
                example.merit("spin along x = L/2 at t = 10, relative L2 error", run.spin_error, 0, 0.05)
            example.merit("momentum balance over the force on the lid", run.balance, 0, 1e-9)
            writerow([base, size, "" if run.to_ghia is None else f"{run.to_ghia:.5f}", f"{run.to_reference:.5f}", f"{run.kinetic:.6f}",
                      f"{run.spread:.6f}", f"{run.expected:.6f}", f"{run.steady:.6f}", f"{run.lid:.6f}", f"{numbers['lid_0.1_0.9']:.6f}",
                      f"{run.pull:.6f}", f"{run.lid_all:.6f}", f"{run.vortex[0]:.5f}", f"{numbers['psi']:.5f}", f"{run.balance:.1e}"])
    print()
    shown = {base: runs[base, sizes[0]] for base in reversed(cases)}
    pictures = [example.out / f"{name}.png" for name in ("kinetic_energy", "profiles", "streamlines", "particles")]
    plot_energy(pictures[0], shown, references)
    plot_profiles(pictures[1], shown, references)
    plot_streamlines(pictures[2], shown, references)
    plot_particles(pictures[3], shown, example.out / f"{disorder}.particles.txt" if disorder in jobs else None)
    return example.finish(*pictures, table)


if __name__ == "__main__":
    sys.exit(main())
