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
from exact import Drop, finite_range      # noqa: E402
from run_lammps import Example, frames, pyplot, save      # noqa: E402

SIGMA = 1.0                     # tension
DROPS = {"r1.333": {"radius": 1.33333333}, "r1": {}, "r0.667": {"radius": 0.66666667}, "ratio10": {"ratio": 10, "muin": 1.0},
         "ratio1000": {"ratio": 1000, "muin": 5.0, "muout": 0.05}}
SLOW = {"rest": 0, "end": 32}      # a drop that comes to rest by its viscosity alone
TEN = {"ratio": 10, "muin": 0.5, "muout": 0.05, "eps": 0.1, "rest": 0, "box": 4, "end": 12}
THOUSAND = {"ratio": 1000, "muin": 5.0, "muout": 0.05, "kappain": 10, "eps": 0.1, "rest": 0, "box": 4, "dx": 0.1, "pb": 80, "factor": 0.984,
            "end": 60, "every": 0.5}
SEEDS = {f"seed{seed}": {**TEN, "seed": seed} for seed in (1, 2, 3)}
ANGLES = 60, 120, 90
QUICK = {"end": 0.5, "dx": 0.1, "rest": 500}
PRESSURE, ANGLE, FREQUENCY, DECAY = 0.03, 3.0, 0.03, 0.4      # bars: relative; degrees; relative
CAPILLARY = 1e-3


class Probe:
    """What LAMMPS has written at each time."""

    def __init__(self, out, name, columns, every=0.1):
        values = np.loadtxt(out / f"{name}.probe.txt").T
        self.t = every * np.arange(values.shape[1])
        for column, value in zip(columns, values[1:]):
            setattr(self, column, value)

    def mean(self, what):
        """over the last quarter"""
        return what[-len(what) // 4:].mean()


class Round(Probe):
    def __init__(self, out, name, every=0.1):
        super().__init__(out, name, ("radius", "pressure", "capillary", "xx", "yy"), every)
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
    """Frequency and decay of A cos + B sin, nearest to the rate s."""
    def misfit(omega, decay):
        f = np.exp(-decay * t)
        base = np.column_stack([f * np.cos(omega * t), f * np.sin(omega * t)])
        return ((shape - base @ np.linalg.lstsq(base, shape, rcond=None)[0])**2).sum()

    omega, decay, width = s.imag, -s.real, 1.0
    while width > 1e-3:
        around = np.linspace(-0.3, 0.3, 13) * width
        omega, decay = min(((omega * (1 + a), decay * (1 + b)) for a in around for b in around), key=lambda one: misfit(*one))
        width /= 1.5
    return omega, decay


class Oscillation:
    """Of one drop, or of the mean of several: frequency and decay as the same fit finds them in the linear theory over the same time."""

    def __init__(self, runs, given):
        self.t = runs[0].t
        self.shape = np.mean([run.shape for run in runs], axis=0)
        theory = Drop(SIGMA, (given["ratio"], given["muin"]), (1.0, given["muout"]), np.mean([run.radius.mean() for run in runs]), box=given["box"])
        rate = theory.rate()
        self.exact = self.shape[0] * theory.shape(self.t)
        self.frequency, self.decay = fit(self.t, self.shape, rate)
        self.theory = fit(self.t, self.exact, rate)
        self.over = self.frequency / self.theory[0], self.decay / self.theory[1]
        self.round = [np.interp(0.0, -shape[:k + 1], self.t[:k + 1]) for shape in (self.shape, self.exact) for k in [np.argmax(shape < 0)]]
        self.lowest = [shape.min() / shape[0] for shape in (self.shape, self.exact)]


def plot(path, out, drops, slow, oscillations, sessiles):
    plt = pyplot()
    figure, axes = plt.subplots(3, 2, figsize=(9.6, 11.0))
    picture, laplace, rest, wall, *shapes = axes.flat
    frame = list(frames(out / "r1.particles.txt").values())[-1]
    for kind, color in (1, "0.8"), (2, "C0"):
        mine = frame["type"] == kind
        picture.plot(frame["x"][mine], frame["y"][mine], "o", ms=3, color=color)
    phi = np.linspace(0, 2 * np.pi, 200)
    center = [frame[axis][frame["type"] == 2].mean() for axis in "xy"]
    radius = drops["r1"].mean(drops["r1"].radius)
    picture.plot(center[0] + radius * np.cos(phi), center[1] + radius * np.sin(phi), "k", lw=1)
    picture.set(aspect="equal", title="a drop at rest, circle of its area", xticks=[], yticks=[])
    marks = {"ratio10": ("s", "C1", "density ratio 10"), "ratio1000": ("x", "C3", "density ratio 1000")}
    for name, drop in drops.items():
        marker, color, label = marks.get(name, ("o", "C0", "density ratio 1" if name == "r1" else None))
        laplace.plot(1 / drop.mean(drop.radius), drop.mean(drop.pressure), marker, mfc="none", color=color, label=label)
    laplace.plot([0, 1.6], [0, 1.6 * SIGMA], "k", lw=1, label="Laplace")
    laplace.set(xlabel="1/radius", ylabel="pressure inside less that outside", xlim=(0, None), ylim=(0, None))
    laplace.legend()
    rest.loglog(slow.t[1:], slow.capillary[1:], "C0-", lw=1.5, label="by viscosity")
    for name in "r1", "ratio1000":
        _, color, label = marks.get(name, ("o", "C2", "density ratio 1"))
        rest.loglog(drops[name].t[1:], drops[name].capillary[1:], "--", color=color, lw=1.5, label=f"after a minimization, {label}")
    rest.axhline(CAPILLARY, color="0.6", lw=1)
    rest.set(xlabel="time", ylabel="largest mu v/sigma of a particle", title="coming to rest")
    rest.legend()
    for (label, one), shape in zip(oscillations.items(), shapes):
        shape.plot(one.t, one.shape / one.shape[0], "C0-", lw=1.5, label="particles")
        shape.plot(one.t, one.exact / one.exact[0], "k--", lw=1.5, label="linear theory")
        shape.set(xlabel="time", ylabel="deformation over that at the beginning", title=label)
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
    jobs = {"thousand": THOUSAND, "slow": SLOW, **SEEDS, **DROPS}
    if args.quick:
        jobs = {name: {**DROPS[name], **QUICK} for name in DROPS}
    walls = {f"w{angle}": {"angle": angle, **({"noisy": 2.0, "end": 2.0, "dx": 0.125} if args.quick else {})} for angle in ANGLES}
    example.run({**jobs, **walls}, {name: HERE / "in.wetting" for name in walls})
    drops = {name: Round(example.out, name) for name in DROPS}
    sessiles = {angle: Sessile(example.out, f"w{angle}") for angle in ANGLES}
    print("drop       radius  pressure  over sigma/radius  largest mu v/sigma of a particle")
    for name, drop in drops.items():
        print(f"{name:9s}  {drop.mean(drop.radius):.4f}  {drop.mean(drop.pressure):8.4f}  {drop.mean(drop.laplace):17.4f}  {drop.capillary[1:].max():32.1e}")
    print("\nangle asked for  found  change in the run")
    for angle, drop in sessiles.items():
        print(f"{angle:15d}  {drop.mean(drop.angle):5.1f}  {drop.angle[-1] - drop.angle[0]:+17.1f}")
    if not args.quick:
        slow = Round(example.out, "slow")
        print("\nr1 without minimization\ntime  pressure over sigma/radius  largest mu v/sigma of a particle")
        for k in 4, 8, 16, 32:
            at = np.argmin(np.abs(slow.t - k))
            print(f"{k:4d}  {slow.laplace[at]:26.4f}  {slow.capillary[at]:32.1e}")
        runs = {name: Round(example.out, name) for name in SEEDS}
        ten = Oscillation(list(runs.values()), TEN)
        heavy = Round(example.out, "thousand", THOUSAND["every"])
        thousand = Oscillation([heavy], THOUSAND)
        print(f"\noscillation, linear theory, density ratio 10: frequency {ten.theory[0]:.4f}, decay {ten.theory[1]:.4f};"
              f" 1000: {thousand.theory[0]:.5f}, {thousand.theory[1]:.5f}")
        print("run        frequency  over theory    decay  over theory  pressure over sigma/radius  round at  theory  lowest  theory")
        for name, one, drop in (*((name, Oscillation([run], TEN), [run]) for name, run in runs.items()), ("mean", ten, list(runs.values())),
                                ("ratio1000", thousand, [heavy])):
            pressure = np.mean([run.laplace[len(run.t) // 2:].mean() for run in drop])
            print(f"{name:9s}  {one.frequency:9.5f}  {one.over[0]:11.3f}  {one.decay:.5f}  {one.over[1]:11.2f}  {pressure:26.3f}  {one.round[0]:8.2f}  {one.round[1]:6.2f}"
                  f"  {one.lowest[0]:6.3f}  {one.lowest[1]:6.3f}")
        for reach, one in (5 / 12, "density ratio 10"), (0.5, "1000"):
            print("{}: factors by the range of the tension: frequency {:.4f}".format(one, np.sqrt(finite_range(reach)[1])))
    print()
    wide = 4.0 if args.quick else 1.0
    for name, drop in drops.items():
        example.merit(f"{name}: pressure over sigma/radius", drop.mean(drop.laplace), 1 - wide * PRESSURE, 1 + wide * PRESSURE)
        example.merit(f"{name}: largest mu v/sigma of a particle", drop.capillary.max(), 0.0, wide * CAPILLARY)
    for angle, drop in sessiles.items():
        example.merit(f"contact angle {angle}", drop.mean(drop.angle), angle - wide * ANGLE, angle + wide * ANGLE)
    if args.quick:
        return example.finish()
    example.merit("r1 without minimization: largest mu v/sigma of a particle", slow.capillary[-1], 0.0, CAPILLARY)
    example.merit("frequency over linear theory", ten.over[0], 1 - FREQUENCY, 1 + FREQUENCY)
    example.merit("decay over linear theory", ten.over[1], 1 - DECAY, 1 + DECAY)
    example.merit("density ratio 1000: frequency over linear theory", thousand.over[0], 1 - FREQUENCY, 1 + FREQUENCY)
    example.merit("density ratio 1000: decay over linear theory", thousand.over[1], 1 - DECAY, 1 + DECAY)
    picture = example.out / "drop.png"
    plot(picture, example.out, drops, slow, {"density ratio 10, mean of 3": ten, "density ratio 1000": thousand}, sessiles)
    return example.finish(picture)


if __name__ == "__main__":
    sys.exit(main())
