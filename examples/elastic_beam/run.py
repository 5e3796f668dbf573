#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""A column of water on an elastic beam: deflection and frequency against the theory of the lattice and of sound in the water.

    ./sphd run elastic_beam          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.linalg import eigh
from scipy.optimize import curve_fit

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, frames, pyplot, save      # noqa: E402

E, C0 = 9000.0, 20.0                          # of the input
JOBS = {"fine": {"n": 96, "rows": 9, "end": 1.5}, "beam": {"n": 64, "rows": 6, "end": 3.0}, "heavy": {"n": 64, "rows": 6, "ratio": 4.0, "end": 1.5},
        "shallow": {"n": 64, "rows": 6, "depth": 0.25, "end": 1.5}}
QUICK = {"beam": {"n": 64, "rows": 6, "end": 0.7}}
STATIC, FREQUENCY = 0.03, 0.05                # bars


class Theory:
    """Linear elasticity of the lattice between the clamps, under its weight and that of the water, and its slowest mode with the mass of the
    water: sound in a column with a free surface, whose pressure on the beam is that of its waves along the beam."""

    def __init__(self, n, rows, ratio=1.0, depth=0.5, **_):
        a = 1.0 / n
        row = 0.5 * np.sqrt(3) * a
        place = np.array([[-0.5 + (k + (0.25 if r % 2 == 0 else 0.75)) * a, (r + 0.5 - rows) * row] for r in range(rows) for k in range(n)])
        mass, spring = ratio * a * row, 0.5 * np.sqrt(3) * E
        stiffness = np.zeros((2 * len(place),) * 2)
        for i, at in enumerate(place):
            r = place - at
            r[:, 0] -= np.round(r[:, 0])
            for j in np.flatnonzero(np.hypot(*r.T) < 1.1 * a):
                if j > i:
                    block = spring * np.outer(r[j], r[j]) / (r[j] @ r[j])
                    for p, q, sign in ((i, i, 1), (j, j, 1), (i, j, -1), (j, i, -1)):
                        stiffness[2 * p:2 * p + 2, 2 * q:2 * q + 2] += sign * block
        free = np.repeat(np.abs(place[:, 0]) > 1.3 * a, 2)
        top = np.arange(len(place) - n, len(place))
        middle = np.flatnonzero(0.5 - np.abs(place[:, 0]) < 0.8 * a)
        load = np.zeros(2 * len(place))
        load[1::2] = -mass
        load[2 * top + 1] -= depth * a
        part = np.ix_(free, free)
        shift = np.zeros_like(load)
        shift[free] = np.linalg.solve(stiffness[part], load[free])
        self.static = shift[2 * middle + 1].mean()

        waves, omega = 2 * np.pi * np.fft.fftfreq(n, a), 0.0
        fourier = np.fft.fft(np.eye(n)) / np.sqrt(n)
        for _ in range(20):
            decay = np.sqrt(waves**2 - (omega / C0)**2 + 1e-12 + 0j)
            inertia = mass * np.eye(len(load))
            inertia[np.ix_(2 * top + 1, 2 * top + 1)] += a * (fourier.conj().T @ np.diag(np.tanh(decay * depth) / decay) @ fourier).real
            before, omega = omega, np.sqrt(eigh(stiffness[part], inertia[part], subset_by_index=[0, 0], eigvals_only=True)[0])
            if abs(omega - before) < 1e-6 * omega:
                break
        self.omega = omega
        # Euler and Bernoulli's beam with the bending stiffness of the rows, and its shear
        length, load = 1.0 - 2.0 * a, depth + ratio * rows * row
        bending, shear = spring * a * row**2 * rows * (rows**2 - 1) / 12, 5 / 6 * np.sqrt(3) / 4 * spring * rows * row
        self.bent, self.sheared = -load * length**4 / (384 * bending), -load * length**2 / (8 * shear)


def damped(t, rest, cosine, sine, omega, rate):
    return rest + np.exp(-rate * t) * (cosine * np.cos(omega * t) + sine * np.sin(omega * t))


class Run:
    def __init__(self, out, name, **variables):
        self.theory = Theory(**variables)
        self.t, self.y = np.loadtxt(out / f"{name}.txt")[:, 1:].T
        start = self.theory.static, -self.theory.static, 0.0, self.theory.omega, 0.05
        self.fit = curve_fit(damped, self.t, self.y, start)[0]
        self.rest, self.omega = self.fit[0], self.fit[3]
        self.n = variables["n"]
        self.last = list(frames(out / f"{name}.particles.txt").values())[1]


def plot(path, run):
    plt = pyplot()
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.0, 3.4), width_ratios=[1.0, 1.5])
    frame = run.last
    for kind, color in ((1, None), (2, "k")):
        own = frame["type"] == kind
        shown = left.scatter(frame["x"][own], frame["y"][own], s=3, c=color or (frame["rho"][own] - 1) * C0**2, lw=0, rasterized=True)
        picture = shown if kind == 1 else picture
    left.set(aspect="equal", title="half a period after the start", xlabel="$x/L$", ylabel="$y/L$")
    left.grid(False)
    figure.colorbar(picture, ax=left, label=r"$p/(\rho g L)$", shrink=0.8)
    right.plot(run.t, run.y, "C0", lw=1.0, label=f"particles, n = {run.n}")
    right.plot(run.t, damped(run.t, run.theory.static, -run.theory.static, 0.0, run.theory.omega, 0.0), "k", lw=2.6, alpha=0.3, label="theory, without damping")
    right.axhline(run.theory.static, color="k", lw=0.8, ls=":")
    right.set(title="deflection in the middle, $y/L$", xlabel=r"time $t\,(g/L)^{1/2}$", xlim=(0, 1.5), ylim=(-0.0078, 0.0016))
    right.legend(fontsize=8, loc="upper right")
    save(figure, path)


def main():
    example = Example(HERE, "A column of water on an elastic beam.")
    args = example.arguments()
    jobs = QUICK if args.quick else JOBS
    example.run(jobs)
    print("run       n   deflection   theory      beam       frequency   theory")
    for name, variables in jobs.items():
        run = Run(example.out, name, **variables)
        theory = run.theory
        print(f"{name:8s} {run.n:2d}   {run.rest:.6f}   {theory.static:.6f}   {theory.bent + theory.sheared:.6f}   {run.omega:9.3f}   {theory.omega:.3f}")
        example.merit(f"{name}: deflection over theory", run.rest / theory.static, 1 - STATIC, 1 + STATIC)
        example.merit(f"{name}: frequency over theory", run.omega / theory.omega, 1 - FREQUENCY, 1 + FREQUENCY)
        if name == "beam":
            shown = run
    picture = example.out / "elastic_beam.png"
    if args.quick:
        return example.finish()
    plot(picture, shown)
    return example.finish(picture)


if __name__ == "__main__":
    sys.exit(main())
