#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Two fluids in a cup that turns: angular velocity with conserving and with Laplacian viscous forces.

    ./sphd run two_fluid_cup          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, frames, pyplot, save      # noqa: E402
from swirl import Swirl                     # noqa: E402

R1, SUPPORT = 0.5, 4                            # as in the input; R2 = 1, Omega0 = 1
RATIOS = {"0.2": (5.0, 1.0), "5": (1.0, 5.0)}   # eta2/eta1: (eta1, eta2)
SHEARS = {"mg": ("newton", "o", "C0"), "morris": ("laplace", "s", "C3"),
          "micropolar": ("newton", "x", "C2")}
CONSERVING = 0.01       # mg, micropolar: Omega_in over Omega0, minus 1; mean spin likewise
FORMULA = 0.05          # morris: Omega_in over the formula, minus 1
LATTICE = 0.01          # morris: Omega_in over that of particles that stay where they were, minus 1


def laplacian_inner(eta1, eta2):
    """Omega_in/Omega0 of the stress eta grad v: eta u' and u continuous at R1, u = A r + B/r outside."""
    return 2 * eta2 / ((eta1 + eta2) - (eta1 - eta2) * R1**2)


def lattice_inner(n, eta1, eta2):
    """The same for the Morris form between particles that keep their places on the initial lattice."""
    from scipy.sparse import coo_matrix, diags
    from scipy.sparse.linalg import spsolve
    from scipy.spatial import cKDTree

    dx = 1 / n
    rc, a = SUPPORT * dx, dx * np.sqrt(2 / np.sqrt(3))
    row, column = np.mgrid[-2 * n:2 * n + 1, -2 * n:2 * n + 1]
    x = np.column_stack([((column + 0.5 * (row % 2)) * a).ravel(), (row * a * np.sqrt(3) / 2).ravel()])
    x = x[np.hypot(*x.T) < 1 + 2 * rc]
    r = np.hypot(*x.T)
    mu = np.where(r < R1, eta1, eta2)
    i, j = cKDTree(x).query_pairs(rc, output_type="ndarray").T
    p = 1 - np.hypot(*(x[i] - x[j]).T) / rc
    norm = 7 / np.pi
    c = np.full(len(x), norm / rc**2)
    for k in (i, j):
        np.add.at(c, k, norm / rc**2 * p**4 * (1 + 4 * (1 - p)))
    link = 2 * (2 * mu[i] * mu[j] / (mu[i] + mu[j])) * (20 * norm / rc**4 * p**3) / (c[i] * c[j])
    matrix = coo_matrix((np.tile(link, 2), (np.append(i, j), np.append(j, i)))).tocsr()
    matrix = matrix - diags(np.asarray(matrix.sum(axis=1)).ravel())
    fluid, core = r < 1, r < R1 - rc
    v = np.column_stack([-x[:, 1], x[:, 0]])
    v[fluid] = spsolve(matrix[fluid][:, fluid].tocsc(), -matrix[fluid][:, ~fluid] @ v[~fluid])
    return (x[core, 0] * v[core, 1] - x[core, 1] * v[core, 0]).sum() / (r[core] ** 2).sum()


class Run:
    def __init__(self, out, name):
        columns = np.loadtxt(out / f"{name}.inside.txt").T
        self.t, self.inside = columns[1:3]
        last = self.t > self.t[-1] * 5 / 6
        self.spin = columns[4][last].mean() if len(columns) > 4 else None
        self.omega, self.spread = self.inside[last].mean(), np.ptp(self.inside[last])
        collected = frames(out / f"{name}.particles.txt").values()
        x, y, vx, vy = (np.concatenate([frame[c] for frame in collected]) for c in ("x", "y", "vx", "vy"))
        r = np.hypot(x, y)
        edges = np.linspace(0.04, 1, 25)       # without the particle on the axis
        which = np.digitize(r, edges)
        self.r = 0.5 * (edges[1:] + edges[:-1])
        moment = x * vy - y * vx
        self.profile = np.array([moment[which == k].sum() / (r[which == k] ** 2).sum() for k in range(1, len(edges))])


def plot(path, runs, n):
    plt = pyplot()
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.8), gridspec_kw={"width_ratios": [1, 1, 1.05]})
    for axis, (ratio, etas) in zip(axes, RATIOS.items()):
        for shear, (stress, marker, color) in SHEARS.items():
            swirl = Swirl(stress, *etas, R1, wall=1.0)
            if shear != "micropolar":
                axis.plot(np.append(swirl.r, 1), np.append(swirl.steady() / swirl.r, 1), "-" if shear == "mg" else "--", color="k",
                          label="conserving stress" if shear == "mg" else "$\\eta\\nabla v$ as stress")
            run = runs[shear, ratio, n]
            axis.plot(run.r, run.profile, marker, color=color, ms=4.5, mfc="none", label=f"shear {shear}" if shear != "micropolar" else shear)
        axis.axvspan(0, R1, color="#d8a040", alpha=0.18, lw=0)
        axis.axvspan(R1, 1, color="#a8c4e0", alpha=0.25, lw=0)
        for x, name in ((R1 / 2, "\\eta_1"), ((1 + R1) / 2, "\\eta_2")):
            axis.text(x, 0.04, f"${name}$", ha="center", color="0.35", fontsize=11, transform=axis.get_xaxis_transform())
        axis.set(xlim=(0, 1), ylim=(0, 1.65), xlabel="radius $r/R_2$", title=f"$\\eta_2/\\eta_1 = {ratio}$")
    axes[0].set_ylabel("angular velocity $\\Omega(r)\\,/\\,\\Omega_0$")
    axes[0].legend(loc="upper right")
    axis = axes[2]
    for ratio, etas in RATIOS.items():
        for shear, (stress, marker, color) in SHEARS.items():
            run = runs[shear, ratio, n]
            if shear == "micropolar":
                axis.plot(run.t[3::6], run.inside[3::6], marker, color=color, ms=3.5)
                continue
            swirl = Swirl(stress, *etas, R1, wall=1.0)
            exact = swirl.angular_velocity(swirl.evolve(np.zeros_like(swirl.r), run.t), R1 - SUPPORT / n)
            axis.plot(run.t, exact, "-" if shear == "mg" else "--", color="k", lw=1)
            axis.plot(run.t[::6], run.inside[::6], marker, color=color, ms=3.5, mfc="none")
            axis.text(0.98 * run.t[-1], run.omega + (0.05 if shear == "morris" else -0.1 if ratio == "0.2" else 0.04),
                      f"$\\eta_2/\\eta_1 = {ratio}$", ha="right", color=color)
    axis.set(xlim=(0, run.t[-1]), ylim=(0, 1.65), xlabel="time $t\\,\\Omega_0$", title="inner fluid, $\\Omega_\\mathrm{in}(t)/\\Omega_0$")
    save(figure, path)


def main():
    example = Example(HERE, "Two fluids of different viscosity in a cup that turns.")
    args = example.arguments()
    sizes = [16] if args.quick else [32, 16]
    keys = [(shear, ratio, n) for n in sizes for ratio in RATIOS for shear in SHEARS]
    names = {key: f"{key[0]}.ratio{key[1]}.n{key[2]}" for key in keys}
    example.run({names[shear, ratio, n]: {"n": n, "shear": shear, "mu1": RATIOS[ratio][0], "mu2": RATIOS[ratio][1]}
                 for shear, ratio, n in keys})
    runs = {key: Run(example.out, name) for key, name in names.items()}

    table = example.out / "omega.csv"
    with csv_rows(table, ["eta2/eta1", "shear", "n", "omega_in", "spread", "continuum", "lattice", "spin"]) as writerow:
        for ratio, etas in RATIOS.items():
            for n in reversed(sizes):
                print()
                conserving, run, spinning = (runs[shear, ratio, n] for shear in SHEARS)
                formula, lattice = laplacian_inner(*etas), lattice_inner(n, *etas)
                print(f"eta2/eta1 = {ratio}, n = {n}: Omega_in = {conserving.omega:.4f} with mg, {run.omega:.4f} with morris, "
                      f"{spinning.omega:.4f} and mean spin {spinning.spin:.4f} with micropolar; "
                      f"formula {formula:.4f}, still lattice {lattice:.4f}")
                example.merit("mg: Omega_in over Omega0, minus 1", abs(conserving.omega - 1), 0.0, CONSERVING)
                example.merit("micropolar: Omega_in over Omega0, minus 1", abs(spinning.omega - 1), 0.0, CONSERVING)
                example.merit("micropolar: mean spin over Omega0, minus 1", abs(spinning.spin - 1), 0.0, CONSERVING)
                example.merit("morris: Omega_in over the formula, minus 1", abs(run.omega / formula - 1), 0.0, FORMULA)
                example.merit("morris: Omega_in over that of a still lattice, minus 1", abs(run.omega / lattice - 1), 0.0, LATTICE)
                writerow([ratio, "mg", n, f"{conserving.omega:.6f}", f"{conserving.spread:.1e}", 1.0, 1.0, ""])
                writerow([ratio, "morris", n, f"{run.omega:.6f}", f"{run.spread:.1e}", f"{formula:.6f}", f"{lattice:.6f}", ""])
                writerow([ratio, "micropolar", n, f"{spinning.omega:.6f}", f"{spinning.spread:.1e}", 1.0, 1.0, f"{spinning.spin:.6f}"])
            if len(sizes) > 1:
                coarse, fine = (abs(runs["morris", ratio, n].omega / formula - 1) for n in sorted(sizes))
                example.merit("morris: error at n = 32 over that at n = 16", fine / coarse, 0.0, 1.0)
    print()
    picture = example.out / "omega.png"
    plot(picture, runs, sizes[0])
    return example.finish(picture, table)


if __name__ == "__main__":
    sys.exit(main())
