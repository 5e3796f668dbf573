#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""A drop in another fluid: Laplace pressure, oscillation, and contact angles on a wall.

    ./sphd run drop          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from exact import Drop      # noqa: E402
from run_lammps import Example, frames, pyplot, save      # noqa: E402

SIGMA, MU = 1.0, 0.2             # tension, viscosity of the fluid outside
DROPS = {"r1.333": {"radius": 1.33333333}, "heavy": {"ratio": 10, "muin": 1.0}, "r1": {}, "r0.667": {"radius": 0.66666667}}
OSCILLATION = {"ratio": 10, "muin": 0.5, "muout": 0.05, "eps": 0.1, "pb": 60, "cout": 20, "noisy": 0.5, "end": 12}
NOISY = {f"seed{seed}": {"kept": 0.001, "seed": seed} for seed in (1, 2, 3)}      # oscillations with noise; a last one has none
ANGLES = 60, 120, 90
QUICK = {"noisy": 2.0, "end": 2.0, "dx": 0.125}
PRESSURE, ANGLE, FREQUENCY = 0.05, 3.0, 0.1      # bars: relative; degrees; relative, for the tension measured


class Probe:
    """What LAMMPS has written at each time."""

    def __init__(self, out, name, columns, every=0.1):
        values = np.loadtxt(out / f"{name}.probe.txt").T
        self.t = every * np.arange(values.shape[1])
        for column, value in zip(columns, values[1:], strict=True):
            setattr(self, column, value)

    def mean(self, what):
        """over the last quarter"""
        return what[-len(what) // 4:].mean()


class Round(Probe):
    def __init__(self, out, name):
        super().__init__(out, name, ("radius", "pressure", "fastest", "xx", "yy"))
        self.shape = (self.xx - self.yy) / (self.xx + self.yy)      # twice the amplitude of cos 2 phi over the radius
        self.laplace = self.pressure * self.radius / SIGMA


def segment(angle):
    """Height of the centroid of a circular segment over the root of its area."""
    area = angle - np.sin(angle) * np.cos(angle)
    return (2 / 3 * np.sin(angle)**3 / area - np.cos(angle)) / np.sqrt(area)


class Sessile(Probe):
    """A drop on a wall: its angle is that of the circular segment of the same area and centroid."""

    def __init__(self, out, name):
        super().__init__(out, name, ("area", "height", "fastest"))
        angles = np.linspace(0.2, 3.0, 2801)
        self.angle = np.degrees(np.interp(self.height / np.sqrt(self.area), segment(angles), angles))


def fit(t, shape, s):
    """Frequency and decay of A cos + B sin + C, nearest to the rate s."""
    def misfit(omega, decay):
        f = np.exp(-decay * t)
        base = np.column_stack([f * np.cos(omega * t), f * np.sin(omega * t), np.ones_like(t)])
        return ((shape - base @ np.linalg.lstsq(base, shape, rcond=None)[0])**2).sum()

    omega, decay, width = s.imag, -s.real, 1.0
    while width > 1e-3:
        around = np.linspace(-0.3, 0.3, 13) * width
        omega, decay = min(((omega * (1 + a), decay * (1 + b)) for a in around for b in around), key=lambda one: misfit(*one))
        width /= 1.5
    return omega, decay


def plot(path, out, drops, shapes, t, sessiles):
    plt = pyplot()
    figure, ((picture, laplace), (shape, wall)) = plt.subplots(2, 2, figsize=(9.6, 7.6))
    frame = list(frames(out / "r1.particles.txt").values())[-1]
    for kind, color in (1, "0.8"), (2, "C0"):
        mine = frame["type"] == kind
        picture.plot(frame["x"][mine], frame["y"][mine], "o", ms=3, color=color)
    phi = np.linspace(0, 2 * np.pi, 200)
    center = [frame[axis][frame["type"] == 2].mean() for axis in "xy"]
    radius = drops["r1"].mean(drops["r1"].radius)
    picture.plot(center[0] + radius * np.cos(phi), center[1] + radius * np.sin(phi), "k", lw=1)
    picture.set(aspect="equal", title="a drop at rest, circle of its area", xticks=[], yticks=[])
    for name, drop in drops.items():
        marker = "s" if name == "heavy" else "o"
        laplace.plot(1 / drop.mean(drop.radius), drop.mean(drop.pressure), marker, mfc="none", color="C1" if name == "heavy" else "C0",
                     label={"heavy": "density ratio 10", "r1": "density ratio 1"}.get(name))
    laplace.plot([0, 1.6], [0, 1.6 * SIGMA], "k", lw=1, label="Laplace")
    laplace.set(xlabel="1/radius", ylabel="pressure inside less that outside", xlim=(0, None), ylim=(0, None))
    laplace.legend()
    for (name, values), line in zip(shapes.items(), ("C0-", "C3-", "k--"), strict=True):
        shape.plot(t, values, line, lw=1.5, label=name)
    shape.set(xlabel="time", ylabel="(xx - yy)/(xx + yy) of the gyration", title="oscillation, density ratio 10")
    shape.legend()
    for k, (angle, drop) in enumerate(sorted(sessiles.items())):
        frame = list(frames(out / f"w{angle}.particles.txt").values())[-1]
        mine = frame["type"] == 2
        x, y = frame["x"][mine], frame["y"][mine]
        x = x - x.mean()
        theta = np.radians(angle)
        radius = np.sqrt(drop.area[-1] / (theta - np.sin(theta) * np.cos(theta)))
        along = np.linspace(-theta, theta, 100)
        wall.plot(x, y + 2.2 * k, "o", ms=2.5, color=f"C{k}")
        wall.plot(radius * np.sin(along), radius * (np.cos(along) - np.cos(theta)) + 2.2 * k, "k", lw=1)
        wall.axhline(2.2 * k, color="0.6", lw=1)
        wall.text(-2.1, 2.2 * k - 0.35, f"{angle}°: {drop.mean(drop.angle):.1f}°")
    wall.set(aspect="equal", xlim=(-2.2, 2.2), ylim=(-0.5, None), title="on a wall, segments of the angles asked for", xticks=[], yticks=[])
    save(figure, path)


def main():
    example = Example(HERE, "A drop in another fluid.")
    args = example.arguments()
    less = QUICK if args.quick else {}
    jobs = {name: {**variables, **less} for name, variables in {**DROPS, **{f"w{angle}": {"angle": angle} for angle in ANGLES}}.items()}
    less = {"dx": 0.125, "end": 2.0} if args.quick else {}
    jobs = {**{name: {**OSCILLATION, **variables, **less} for name, variables in {**NOISY, "frozen": {}}.items()}, **jobs}
    example.run(jobs, {f"w{angle}": HERE / "in.wetting" for angle in ANGLES})
    drops = {name: Round(example.out, name) for name in DROPS}
    sessiles = {angle: Sessile(example.out, f"w{angle}") for angle in ANGLES}
    noisy = {name: Round(example.out, name) for name in NOISY}
    frozen = Round(example.out, "frozen")
    print("drop     radius  pressure  over sigma/radius  velocity of the fastest particle times mu/sigma")
    for name, drop in drops.items():
        print(f"{name:8s} {drop.mean(drop.radius):.4f}  {drop.mean(drop.pressure):8.4f}  {drop.mean(drop.laplace):17.4f}"
              f"  {MU / SIGMA * drop.fastest[-1]:46.1e}")
    print("\nangle asked for  found  change in the run")
    for angle, drop in sessiles.items():
        print(f"{angle:15d}  {drop.mean(drop.angle):5.1f}  {drop.angle[-1] - drop.angle[0]:+17.1f}")
    given = OSCILLATION
    t = frozen.t
    mean = np.mean([drop.shape for drop in noisy.values()], axis=0)

    def theory(drops, sigma=SIGMA):
        return Drop(sigma, (given["ratio"], given["muin"]), (1.0, given["muout"]), np.mean([drop.radius.mean() for drop in drops]))

    s = theory([frozen]).rate()
    exact = mean[0] * np.exp(s.real * t) * (np.cos(s.imag * t) - s.real / s.imag * np.sin(s.imag * t))
    print(f"\noscillation, linear theory: frequency {s.imag:.4f}, decay {-s.real:.4f}; without viscosity {theory([frozen]).inviscid():.4f}, 0")
    print("run      frequency  over theory   decay  over theory  pressure over sigma/radius  frequency over theory with that tension")
    for name, shape, runs in *((name, drop.shape, [drop]) for name, drop in noisy.items()), ("mean", mean, list(noisy.values())):
        laplace = np.mean([drop.mean(drop.laplace) for drop in runs])
        rate, own = theory(runs).rate(), theory(runs, laplace * SIGMA).rate()
        omega, decay = fit(t, shape, rate)
        found = omega / own.imag
        print(f"{name:8s} {omega:9.4f}  {omega / rate.imag:11.3f}  {decay:.4f}  {-decay / rate.real:11.2f}  {laplace:26.3f}  {found:39.3f}")
    low = t < 1.5 * np.pi / s.imag
    print(f"lowest shape over the one at the beginning: theory {min(exact) / exact[0]:.3f}, mean {min(mean[low]) / mean[0]:.3f},"
          f" without noise {min(frozen.shape[low]) / frozen.shape[0]:.3f}\n")
    wide = 4.0 if args.quick else 1.0
    for name, drop in drops.items():
        example.merit(f"{name}: pressure over sigma/radius", drop.mean(drop.laplace), 1 - wide * PRESSURE, 1 + wide * PRESSURE)
    for angle, drop in sessiles.items():
        example.merit(f"contact angle {angle}", drop.mean(drop.angle), angle - wide * ANGLE, angle + wide * ANGLE)
    if not args.quick:
        example.merit("frequency over linear theory with the tension measured", found, 1 - FREQUENCY, 1 + FREQUENCY)
    if args.quick:
        return example.finish()
    picture = example.out / "drop.png"
    shapes = {"noise, mean of 3": mean, "no noise": frozen.shape, "linear theory": exact}
    plot(picture, example.out, drops, shapes, t, sessiles)
    return example.finish(picture)


if __name__ == "__main__":
    sys.exit(main())
