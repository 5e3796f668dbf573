#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Decay of an accelerating and decelerating flow through a pipe with open ends: centre, kinetic energy, mass.

    ./sphd run pipe_flow          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from exact import Pipe                      # noqa: E402
from run_lammps import Example, csv_rows, frames, pyplot, save      # noqa: E402

# sigma: rows across the pipe, distance of the particles of a row at x = 0 over that of the rows, support over that
SIZES = {-1: (38, 0.2, 6.0), 0: (30, 0.5, 6.0), 1: (26, 0.7, 6.0), 10: (34, 1.0, 6.0)}
QUICK = {0: (22, 0.5, 6.0), 1: (18, 0.7, 6.0)}
COARSE = 2.0                # the errors of the quick ones are larger by this
# what goes wrong, and other ends: sigma, variables of the input that differ
NO_FY, OTHER_BULK = "no $f_y$", "bulk viscosity of $\\sigma = 10$"
WRONG = {
    NO_FY: (1, {"fy": 0}),
    OTHER_BULK: (1, {"fluid": 10}),
    "characteristic ends": (1, {"condition": "characteristic"}),
    "fixed ends": (1, {"condition": "fixed"}),
    "velocity inside": (1, {"velocity": "inside", "tenths": 0.35}),     # later the density at the ends becomes negative
    "velocity inside, fixed ends": (1, {"velocity": "inside", "condition": "fixed"}),
}
# particles that split and merge, beside the same without: target volume over the square of the distance of the rows
REFINE = 0.6
REFINED = {"sigma": -1, "n": 26, "aspect": 0.2, "support": 6.0}
QUICK_REFINED = {"sigma": -1, "n": 22, "aspect": 0.2, "support": 5.0, "tenths": 0.1}
FEWER = 0.7                 # particle-steps over those without, at most
SMALL = 0.01                # relative error of velocity and kinetic energy, until each is a tenth
SMALL_MASS = 1e-3
VISIBLE = 0.1               # what the first two of the wrong ones must differ by, at least
JUDGED = {NO_FY: 1.0, OTHER_BULK: 0.5}      # these, with the part of the time after which it is seen


def value_at(x, y, u, point, radius=0.15):
    """Of a field at a point: a polynomial of second order through the particles around it, the near ones above all."""
    dx, dy = (x - point[0]) / radius, (y - point[1]) / radius
    distance = dx**2 + dy**2
    near = distance < 1
    dx, dy, weight = dx[near], dy[near], 1 - distance[near]
    terms = np.stack([np.ones_like(dx), dx, dy, dx**2, dx * dy, dy**2], axis=1)
    return np.linalg.lstsq(terms * weight[:, None], u[near] * weight, rcond=None)[0][0]


class Run:
    """Two pipes side by side, -1 < y < 0 and 0 < y < 1, in which the fluid flows in opposite directions."""

    def __init__(self, out, name, sigma):
        self.sigma, self.exact = sigma, Pipe(sigma)
        history = np.loadtxt(out / f"{name}.history.txt")
        step, self.time, self.energy, self.mass, self.particles, *self.carried, self.lost = history.T
        self.steps = step[-1]
        self.energy, self.mass = self.energy / 2, self.mass / 2
        center = frames(out / f"{name}.center.txt")
        per_step = (self.time[1] - self.time[0]) / (step[1] - step[0])
        self.at = np.array(list(center)) * per_step
        self.u = np.array([np.mean([sign * value_at(frame["x"], frame["y"], frame["vx"], (0, sign / 2)) for sign in (1, -1)])
                           for frame in center.values()])
        self.frames = {step * per_step: frame for step, frame in frames(out / f"{name}.particles.txt").items()}

    def errors(self):
        """Largest relative errors of the velocity at the centre and of the kinetic energy, of the mass; lost particles."""
        e = self.exact
        early = e.kinetic(self.time) > 0.1 * e.kinetic(0.0)
        return (np.abs(self.u / e.center(self.at) - 1).max(), np.abs(self.energy / e.kinetic(self.time) - 1)[early].max(),
                np.abs(self.mass / e.mass() - 1).max(), np.abs(self.lost).max())

    def particle_steps(self):
        return self.particles.mean() * self.steps

    def passed(self):
        """Mass in and out through both ends over the exact one, at the end."""
        wanted = 2 * self.exact.passed(self.time[-1])
        left_in, left_out, right_in, right_out = (column[-1] for column in self.carried)
        return (left_in + right_in) / wanted, (left_out + right_out) / wanted

    def field(self):
        """Relative L2 errors of the velocity and its part across the pipe, the largest of all frames after the first."""
        found = []
        for t, frame in self.frames.items():
            u = self.exact.u(frame["x"], frame["y"], t)
            found.append([np.linalg.norm(frame["vx"] - u), np.linalg.norm(frame["vy"])] / np.linalg.norm(u))
        return np.array(found)[1:].max(axis=0) if len(found) > 1 else (np.nan, np.nan)


def draw_fields(path, runs):
    """Velocity halfway through the decay: exact, and that of the particles."""
    plt = pyplot()
    figure, axes = plt.subplots(len(runs), 2, figsize=(8.4, 2.1 * len(runs)), squeeze=False, sharex=True, sharey=True)
    x, y = np.meshgrid(np.linspace(-1, 1, 201), np.linspace(0, 1, 101))
    for row, (sigma, run) in zip(axes, runs.items()):
        t, frame = list(run.frames.items())[len(run.frames) // 2]
        exact, upper = run.exact.u(x, y, t), frame["y"] > 0
        top = exact.max()
        row[0].contourf(x, y, exact, levels=np.linspace(0, top, 41))
        dots = row[1].scatter(frame["x"][upper], frame["y"][upper], s=7, c=frame["vx"][upper], vmin=0, vmax=top, lw=0, rasterized=True)
        row[0].set(ylabel="height $y/L$", title=f"$\\sigma = {sigma}$, $t U_0/L = {t:.3g}$: exact")
        row[1].set(title="particles", xlim=(-1, 1), ylim=(0, 1), xticks=(-1, -0.5, 0, 0.5, 1))
        figure.colorbar(dots, ax=row, label="velocity $u/U_0$")
        for axis in row:
            axis.set_aspect("equal")
    for axis in axes[-1]:
        axis.set_xlabel("place along the pipe, $x/L$")
    save(figure, path)


def draw_decay(path, runs, wrong):
    """As figure 5 of the paper, with what goes wrong beside it."""
    def shown(error):
        """Up to the first value that lies outside of the axis."""
        outside = np.nonzero(np.abs(error) > most)[0]
        return np.where(np.arange(len(error)) > outside[0], np.nan, error) if len(outside) else error

    plt = pyplot()
    most = 0.25
    figure, axes = plt.subplots(2, 2, figsize=(9.6, 7.4))
    axes = axes.ravel()
    for color, (sigma, run) in zip(("C0", "C1", "C2", "C3"), runs.items()):
        fine = np.linspace(0, run.at[-1], 200)
        axes[0].semilogy(run.at, run.u, "-", color=color, label=f"$\\sigma = {sigma}$")
        axes[0].semilogy(fine, run.exact.center(fine), "k-.", lw=0.8)
        axes[1].semilogy(run.time, run.energy, "-", color=color)
        axes[1].semilogy(fine, run.exact.kinetic(fine), "k-.", lw=0.8)
        axes[2].plot(run.at, run.u / run.exact.center(run.at) - 1, "-", color=color)
        axes[3].plot(run.time, run.energy / run.exact.kinetic(run.time) - 1, "-", color=color)
    axes[0].legend(title="lines: particles, dash-dotted: exact")
    for number, (what, run) in enumerate(wrong.items()):
        look = {"color": ("C4", "C5", "C6")[number % 3], "ls": "--" if number < 3 else ":"}
        axes[2].plot(run.at, shown(run.u / run.exact.center(run.at) - 1), label=what, **look)
        axes[3].plot(run.time, shown(run.energy / run.exact.kinetic(run.time) - 1), **look)
    axes[0].set(title="velocity at the centre over $U_0$")
    axes[1].set(title="kinetic energy over $\\rho_0 U_0^2 L^2$")
    axes[2].set(ylim=(-most, most), title="velocity at the centre, relative error")
    axes[3].set(ylim=(-most, most), title="kinetic energy, relative error")
    axes[2].legend(ncols=2, loc="upper center", fontsize="small", title=f"for $\\sigma = {next(iter(wrong.values())).sigma}$ with")
    for axis in axes:
        axis.set_xlabel("time $t U_0/L$")
    save(figure, path)


def draw_refined(path, constant, changing):
    """Errors with and without splitting and merging, and where the particles are halfway."""
    plt = pyplot()
    figure, axes = plt.subplots(2, 2, figsize=(9.6, 5.4))
    axes = axes.ravel()
    for look, (what, run) in zip(("-", "--"), (("constant particles", constant), ("splitting and merging", changing))):
        axes[0].plot(run.at, 100 * (run.u / run.exact.center(run.at) - 1), look, label=what)
        axes[1].plot(run.time, 100 * (run.energy / run.exact.kinetic(run.time) - 1), look)
    axes[0].set(xlabel="time $t U_0/L$", title="velocity at the centre, error in %")
    axes[1].set(xlabel="time $t U_0/L$", title="kinetic energy, error in %")
    axes[0].legend()
    for axis, run in zip(axes[2:], (constant, changing)):
        t, frame = list(run.frames.items())[len(run.frames) // 2]
        inside = (frame["y"] > 0) & (frame["y"] < 0.5)
        axis.plot(frame["x"][inside], frame["y"][inside], ".", ms=1.5)
        axis.set(xlim=(-1, 1), ylim=(0, 0.5), xlabel="$x/L$", ylabel="$y/L$",
                 title=f"{'constant' if run is constant else 'splitting and merging'}, $t = {t:.3g}$")
    save(figure, path)


def main():
    example = Example(HERE, "Accelerating and decelerating flow through a pipe with open ends.")
    args = example.arguments()
    sizes = QUICK if args.quick else SIZES
    variables = {sigma: dict(zip(("sigma", "n", "aspect", "support"), (sigma, *size))) for sigma, size in sizes.items()}
    jobs = {f"sigma{sigma}": found for sigma, found in variables.items()}
    wrong_names = {}
    for number, (what, (sigma, differing)) in enumerate(WRONG.items()):
        if args.quick and what not in JUDGED:
            continue
        wrong_names[what] = f"wrong{number}", sigma
        jobs[f"wrong{number}"] = {**variables[sigma], **differing, **({"tenths": JUDGED[what]} if args.quick else {})}
    refined = dict(QUICK_REFINED if args.quick else REFINED)
    jobs["constant"] = refined
    jobs["refined"] = {**refined, "refine": REFINE}
    example.run(jobs)
    runs = {sigma: Run(example.out, f"sigma{sigma}", sigma) for sigma in sizes}
    wrong = {what: Run(example.out, *found) for what, found in wrong_names.items()}

    constant, changing = (Run(example.out, name, refined["sigma"]) for name in ("constant", "refined"))

    table = example.out / "errors.csv"
    with csv_rows(table, ["run", "sigma", "rows", "aspect", "support", "center", "kinetic", "mass", "lost", "u", "v", "in", "out",
                          "particle-steps"]) as writerow:
        listed = {**{f"sigma {sigma}": (run, sizes[sigma]) for sigma, run in runs.items()},
                  **{what: (run, sizes[run.sigma]) for what, run in wrong.items()}}
        for what, run in (("constant particles", constant), ("splitting and merging", changing)):
            listed[what] = run, [refined[name] for name in ("n", "aspect", "support")]
        for what, (run, size) in listed.items():
            center, kinetic, mass, lost = run.errors()
            fields, passed = run.field(), run.passed()
            writerow([what, run.sigma, *size, f"{center:.5f}", f"{kinetic:.5f}", f"{mass:.6f}", f"{lost:g}",
                      *(f"{value:.5f}" for value in (*fields, *passed)), f"{run.particle_steps():.3g}"])
            print(f"{what}: errors of u at the centre {center:.4f}, kinetic energy {kinetic:.4f}, mass {mass:.1e},"
                  f" field of u {fields[0]:.4f}, v/u {fields[1]:.4f}; particles lost {lost:g},"
                  f" mass in and out over the exact one {passed[0]:.4f}, {passed[1]:.4f}")
    for sigma, run in runs.items():
        center, kinetic, mass, lost = run.errors()
        coarse = COARSE if args.quick else 1.0
        example.merit(f"sigma = {sigma}: error of the velocity at the centre", center, 0.0, coarse * SMALL)
        example.merit(f"sigma = {sigma}: error of the kinetic energy", kinetic, 0.0, coarse * SMALL)
        example.merit(f"sigma = {sigma}: error of the mass", mass, 0.0, coarse * SMALL_MASS)
        example.merit(f"sigma = {sigma}: particles lost", lost, 0.0, 0.0)
    for what in JUDGED:
        example.merit(f"{what}: error of the velocity at the centre or of the kinetic energy", max(wrong[what].errors()[:2]),
                      VISIBLE, 9.0)
    (center, kinetic, mass, lost), before = changing.errors(), constant.errors()
    example.merit("splitting and merging: particle-steps over those without", changing.particle_steps() / constant.particle_steps(),
                  0.0, FEWER)
    example.merit("splitting and merging: error of the velocity at the centre, more than without", center - before[0], -1.0, SMALL)
    example.merit("splitting and merging: error of the kinetic energy, more than without", kinetic - before[1], -1.0, 2 * SMALL)
    example.merit("splitting and merging: error of the mass, more than without", mass - before[2], -1.0, SMALL_MASS)
    example.merit("splitting and merging: particles lost", lost, 0.0, 0.0)
    decay, fields, refining = (example.out / f"{name}.png" for name in ("decay", "velocity", "refined"))
    draw_decay(decay, runs, wrong)
    draw_fields(fields, runs)
    draw_refined(refining, constant, changing)
    return example.finish(decay, fields, refining, table)


if __name__ == "__main__":
    sys.exit(main())
