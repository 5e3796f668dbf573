#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Plane channel flow, from rest, of power-law fluids, a Carreau fluid, and a Bingham fluid.

    ./sphd run rheology          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from exact import Channel, carreau, papanastasiou, power      # noqa: E402
from run_lammps import Example, frames, pyplot, save      # noqa: E402

# mu, keywords of pair_coeff, the same law for exact.py, sound speed, duration; the Newtonian fluid is a law, too
FLUIDS = {
    "newtonian": (0.5, "power 1 0 0.5", lambda g: 0.5 + 0.0 * g, 10.0, 1.5),
    "power 0.5": (0.5, "power 0.5 0.001 5", power(0.5, 0.5, 0.001, 5), 15.0, 3.0),
    "power 1.5": (0.5, "power 1.5 0.01 5", power(0.5, 1.5, 0.01, 5), 10.0, 1.5),
    "carreau": (1.0, "carreau 5 0.5 2 0.05", carreau(1.0, 5, 0.5, 2, 0.05), 12.0, 2.5),
    "bingham": (0.1, "yield 0.3 50", papanastasiou(0.1, 0.3, 50), 25.0, 6.0),
}
TITLES = {"newtonian": "Newtonian", "power 0.5": "power law, $n = 0.5$", "power 1.5": "power law, $n = 1.5$",
          "carreau": "Carreau", "bingham": "Bingham"}
ROWS, SUPPORT = 50, 3
SMALL, FLOW = 0.005, 0.005    # relative L2 error of the velocity, error of the flow rate


class Run:
    """Mean profile in the steady state."""

    def __init__(self, out, name, fluid, n):
        self.mu = FLUIDS[fluid][2]
        self.exact = Channel(self.mu)
        found = list(frames(out / f"{name}.particles.txt").values())
        y, u, rate = (np.array([frame[column] for frame in found]) for column in ("y", "vx", "c_rate"))
        inside = np.abs(y[0]) < 1
        y, u, rate = y[:, inside], u[:, inside], rate[:, inside]
        half = len(u) // 2
        self.drift = np.abs(u[half:].mean() / u[:half].mean() - 1)
        row = np.clip(np.digitize(y.ravel(), np.linspace(-1, 1, n + 1)) - 1, 0, n - 1)
        count = np.bincount(row, minlength=n)
        self.y, self.u, self.rate = (np.bincount(row, value.ravel(), n) / count for value in (y, u, rate))
        self.mean = u.mean()

    def compare(self):
        """Relative L2 error of the velocity, and error of the flow rate."""
        wanted = self.exact.u(self.y)
        return np.linalg.norm(self.u - wanted) / np.linalg.norm(wanted), self.mean / self.exact.mean - 1


def plot(path, runs):
    plt = pyplot()
    figure, axes = plt.subplots(1, 2, figsize=(9.6, 4.0))
    fine = np.linspace(-1, 1, 801)
    for k, (fluid, run) in enumerate(runs.items()):
        u = run.exact.u(fine)
        axes[0].plot(fine, u, color=f"C{k}")
        axes[1].semilogy(fine, np.maximum(np.abs(np.gradient(u, fine)), 1e-4), color=f"C{k}")
        axes[0].plot(run.y, run.u, "o", color=f"C{k}", ms=3, mfc="none", label=TITLES[fluid])
        axes[1].semilogy(run.y, run.rate, "o", color=f"C{k}", ms=3, mfc="none")
    axes[0].set(xlabel="height $y$", ylabel="velocity $u$", title="lines: exact")
    axes[1].set(xlabel="height $y$", ylabel="rate of shear", ylim=(1e-3, None))
    axes[0].legend()
    save(figure, path)


def check_plug(example, run, n):
    """Spread of the velocity in the part that is not sheared, and its edges, where the parabola outside begins."""
    plug = run.u[np.abs(run.y) < 0.3 - 2 / n]
    spread = np.ptp(plug) / plug.mean()
    example.merit("bingham: spread of the velocity in the plug", spread, 0.0, 0.01)
    # u = plug - (|y| - edge)^2/(2 mu) outside of it
    for side in (-1, 1):
        outside = (side * run.y > 0.5) & (side * run.y < 0.9)
        slope, at_0 = np.polyfit(side * run.y[outside], np.sqrt(plug.mean() - run.u[outside]), 1)
        example.merit(f"bingham: edge of the plug at y {'<>'[side > 0]} 0, in spacings from 0.3", abs(-at_0 / slope - 0.3) * n / 2, 0.0, 1.0)


def main():
    example = Example(HERE, "Plane channel flow of fluids whose viscosity depends on the rate of shear.")
    args = example.arguments()
    n = 20 if args.quick else ROWS
    small = 4.0 if args.quick else 1.0
    names = {fluid: fluid.replace(" ", "_") for fluid in FLUIDS}
    example.run({names[fluid]: {"n": n, "support": SUPPORT, "mu": mu, "law": law, "c0": c0, "end": end}
                 for fluid, (mu, law, _, c0, end) in reversed(FLUIDS.items())})
    runs = {fluid: Run(example.out, names[fluid], fluid, n) for fluid in FLUIDS}
    for fluid, run in runs.items():
        error, flow = run.compare()
        print(f"{fluid}: L2 error of the velocity {error:.4f}, flow rate {flow:+.4f}; largest velocity {run.u.max():.3f}, exact {run.exact.u(0.0):.3f};"
              f" drift {run.drift:.0e}")
        example.merit(f"{fluid}: L2 error of the velocity", error, 0.0, small * SMALL)
        example.merit(f"{fluid}: error of the flow rate", abs(flow), 0.0, small * FLOW)
    check_plug(example, runs["bingham"], n)
    picture = example.out / "rheology.png"
    plot(picture, runs)
    return example.finish(picture)


if __name__ == "__main__":
    sys.exit(main())
