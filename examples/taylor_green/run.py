#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Taylor-Green vortex in three dimensions against a spectral solution, for three bulk viscosities.

    ./sphd run taylor_green       or
    SPHD_LMP=path/to/lmp python3 run.py [--n 64] [--re 100 200] [--kappa 0 1 10] [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

import reference

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, pyplot, read_array, read_grid, save      # noqa: E402

ENERGY = 0.02               # energy over that of the spectral solution, n = 64, Re = 100
PEAK, PEAK_TIME = 0.05, 0.2     # of the rate of loss of energy
KAPPA = 0.01                # energy with bulk viscosity over that without


def peak(t, rate):
    """Value and time of the maximum of a parabola through what is within 1 of the largest value."""
    near = abs(t - t[rate.argmax()]) < 1.01
    a, b, c = np.polyfit(t[near], rate[near], 2)
    return c - b**2 / (4 * a), -b / (2 * a)


class Run:
    def __init__(self, re, kappa, n, tend):
        self.re, self.kappa, self.n = re, kappa, n
        self.name = f"re{re:g}.kappa{kappa:g}"
        self.variables = {"re": re, "kappa": kappa, "n": n, "tend": tend}

    def measure(self, out):
        self.t, self.kinetic, self.total, self.shear, self.bulk = np.loadtxt(out / f"{self.name}.energy.txt", ndmin=2).T[1:]
        t, energy, power = reference.load(self.re)
        self.error = self.kinetic / np.interp(self.t, t, energy) - 1
        # the energy lost, not the heat: sound passes energy to and fro within 0.3
        wide = np.ones(5) / 5
        self.rate_t = np.convolve(self.t, wide, "valid")[1:-1]
        self.rate = -np.gradient(np.convolve(self.kinetic, wide, "valid"), self.t[1])[1:-1]
        self.peak, self.exact_peak = peak(self.rate_t, self.rate), peak(t, power)
        self.power(np.loadtxt(out / f"{self.name}.totals.txt", ndmin=2).T[1:])

    def power(self, totals):
        """Power of the vortical and of the dilatational motion, seen by the grid and by the channels of the particles."""
        self.spectra_t, self.grid_vortical, self.grid_dilatational = totals[[0, 5, 6]]
        shear, bulk = (np.interp(self.spectra_t, self.t, channel) for channel in (self.shear, self.bulk))
        self.heat = shear + bulk
        # shear = mu <omega^2> + 3 mu <div^2>, bulk = zeta <div^2>, kappa = zeta + 5/3 mu, lambda + 2 mu = kappa + 4/3 mu
        mu, zeta = 1 / self.re, (self.kappa - 5 / 3) / self.re
        div2 = bulk / zeta
        self.vortical, self.dilatational = shear - 3 * mu * div2, (3 * mu + zeta) * div2

    def spectra(self, out):
        return [frame.T for frame in read_array(out / f"{self.name}.spectra.txt")]


def fields(path):
    """Velocities u[z, y, x, component] of the frames of a dump of style grid."""
    return [field[..., :3].transpose(2, 1, 0, 3) for _, field in read_grid(path)]


def plot(out, runs):
    plt = pyplot()
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.6))
    for re in sorted({run.re for run in runs}):
        t, energy, power = reference.load(re)
        axes[0].plot(t, energy, "k-", lw=3, alpha=0.3, label=f"spectral, Re = {re:g}")
        axes[1].plot(t, power, "k-", lw=3, alpha=0.3)
    for number, run in enumerate(runs):
        label, color = f"SPH, Re = {run.re:g}, $\\kappa/\\mu$ = {run.kappa:g}", f"C{number}"
        axes[0].plot(run.t, run.kinetic, color=color, label=label)
        axes[1].plot(run.rate_t, run.rate, color=color)
        axes[1].plot(run.spectra_t, run.grid_vortical + run.grid_dilatational, "o", ms=3, color=color)
        axes[1].plot(run.t, run.shear + run.bulk, ":", color=color)
    axes[1].plot([], [], ":", color="0.4", label="heat of the particles")
    axes[1].plot([], [], "o", ms=3, color="0.4", label="power of the spectra")
    axes[1].set_ylim(0, None)
    axes[0].set_ylabel("kinetic energy (lj units)")
    axes[1].set_ylabel("loss of energy per time (lj units)")
    for axis in axes[:2]:
        axis.set_xlabel("time (lj units)")
        axis.legend()
    frames = runs[0].spectra(out)
    for time, color in zip(range(0, len(frames), max(1, len(frames) // 4)), ("0.7", "C0", "C1", "C2", "C3")):
        k, _, solenoidal, dilatational = frames[time][:4]
        axes[2].loglog(k[1:], solenoidal[1:], "-", color=color, label=f"t = {time}")
        axes[2].loglog(k[1:], dilatational[1:], ":", color=color)
    axes[2].set_xlabel("wave number")
    axes[2].set_ylabel("spectra, solenoidal (lines), dilatational (dots)")
    axes[2].set_ylim(1e-10, 1)
    axes[2].legend()
    return save(figure, out / "energy.png")


def vorticity(side, dz, u):
    """Size of the curl of u[z, y, x, component], second order, on a periodic grid."""
    def slope(field, axis, step):
        return (np.roll(field, -1, axis) - np.roll(field, 1, axis)) / (2 * step)

    def d(axis, component):
        return slope(u[..., component], 2 - axis, dz if axis == 2 else side)
    return np.sqrt((d(1, 2) - d(2, 1))**2 + (d(2, 0) - d(0, 2))**2 + (d(0, 1) - d(1, 0))**2)


def plot_vorticity(out, run):
    """|omega| in the planes z = 0 and z = pi/2 for the times of the fields, and of the spectral solution in the second one."""
    plt = pyplot()
    from scipy.ndimage import map_coordinates

    found, flow, dt = fields(out / f"{run.name}.grid"), reference.Flow(32, run.re), 0.05
    figure, axes = plt.subplots(3, len(found), figsize=(1.9 * len(found) + 1.0, 5.8), squeeze=False)
    width, time = 2**0.5 * np.pi, 0
    for column, u in zip(axes.T, found):
        n, m = u.shape[:2]
        omega = vorticity(width / m, 2 * np.pi / n, u)
        y, x = np.meshgrid(*[(np.arange(m) + 0.5) / m * width] * 2, indexing="ij")
        places = np.stack([x - y, x + y]) / 2**0.5 * flow.n / (2 * np.pi)
        exact = map_coordinates(flow.vorticity()[:, :, flow.n // 4], places, order=3, mode="grid-wrap")
        planes = (0.5 * (omega[0] + omega[-1]), 0.5 * (omega[n // 4 - 1] + omega[n // 4]), exact)
        for axis, plane, name in zip(column, planes, ("z = 0", "z = $\\pi/2$", "z = $\\pi/2$, spectral")):
            image = axis.imshow(plane, origin="lower", vmin=0, vmax=3, cmap="magma", interpolation="bilinear")
            if time == 0:
                axis.set_ylabel(name)
            axis.set_xticks([])
            axis.set_yticks([])
            axis.grid(False)
        column[0].set_title(f"t = {time:g}")
        for _ in range(round(2.5 / dt)):
            flow.step(dt)
        time += 2.5
    figure.colorbar(image, ax=axes, shrink=0.8, label="$|\\omega|$")
    path = out / "vorticity.png"
    return save(figure, path)


def main():
    example = Example(HERE, __doc__)
    example.parser.add_argument("--n", type=int, default=32, help="particles per side (%(default)s)")
    example.parser.add_argument("--re", type=float, nargs="+", default=[100])
    example.parser.add_argument("--kappa", type=float, nargs="+", default=[0, 10], help="bulk viscosity over mu")
    args = example.arguments()
    n, tend = (16, 1) if args.quick else (args.n, 10)
    runs = [Run(re, kappa, n, tend) for re in args.re for kappa in args.kappa]
    example.run({run.name: {**run.variables, "grid": 0 if args.quick else 1} for run in runs})

    for run in runs:
        run.measure(example.out)
    table, power = example.out / "taylor_green.csv", example.out / "power.csv"
    with csv_rows(table, ["re", "kappa_over_mu", "n", "t", "energy", "energy_over_spectral", "heat_shear", "heat_bulk"]) as writerow:
        for run in runs:
            for row in zip(run.t, run.kinetic, run.error + 1, run.shear, run.bulk):
                writerow([f"{run.re:g}", f"{run.kappa:g}", run.n, *(f"{value:.6g}" for value in row)])
    columns = ("grid_vortical", "vortical", "grid_dilatational", "dilatational", "heat")
    with csv_rows(power, ["re", "kappa_over_mu", "n", "t", *columns]) as writerow:
        for run in runs:
            for row in zip(run.spectra_t, *(getattr(run, name) for name in columns)):
                writerow([f"{run.re:g}", f"{run.kappa:g}", run.n, *(f"{value:.6g}" for value in row)])
    for run in runs:
        worst = abs(run.error).max()
        print(f"Re = {run.re:g}, kappa/mu = {run.kappa:g}: energy within {100 * worst:.2f} %, largest loss {run.peak[0]:.5f} at "
              f"{run.peak[1]:.2f} (spectral {run.exact_peak[0]:.5f} at {run.exact_peak[1]:.2f}), account of the energy {abs(run.total - run.total[0]).max() / run.kinetic[0]:.1e} of that at the start")
        print("   t, and power of the grid over that of the particles: all, vortical, dilatational")
        for time, *row in zip(run.spectra_t, run.grid_vortical + run.grid_dilatational, run.heat, run.grid_vortical, run.vortical,
                              run.grid_dilatational, run.dilatational):
            print(f"   {time:4g}  " + "  ".join(f"{grid / particles:6.3f}" for grid, particles in zip(row[::2], row[1::2])))
        if run.re == 100:
            example.merit(f"kappa/mu = {run.kappa:g}: largest error of the energy", worst, 0, ENERGY)
            if not args.quick:
                example.merit(f"kappa/mu = {run.kappa:g}: largest loss of energy over that of the spectral solution",
                              run.peak[0] / run.exact_peak[0], 1 - PEAK, 1 + PEAK)
                example.merit(f"kappa/mu = {run.kappa:g}: time of the largest loss less that of the spectral solution",
                              run.peak[1] - run.exact_peak[1], -PEAK_TIME, PEAK_TIME)
        same = next(other for other in runs if other.re == run.re)
        if same is not run:
            example.merit(f"Re = {run.re:g}: largest difference of the energy with kappa/mu = {run.kappa:g} and {same.kappa:g}",
                          abs(run.kinetic / same.kinetic - 1).max(), 0, KAPPA)
    return example.finish(table, power, *([] if args.quick else [plot(example.out, runs), plot_vorticity(example.out, runs[0])]))


if __name__ == "__main__":
    sys.exit(main())
