#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""A sphere in three dimensions: drag and couple in cubic arrays, the long-time tail of a kick, Brownian motion for two bulk viscosities.

    ./sphd run sphere          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.special import wofz

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import stokes                                                             # noqa: E402
from run_lammps import Example, csv_rows, pyplot, save, series, thermo      # noqa: E402

# drag of simple cubic arrays over that of Stokes, by volume fraction: A. A. Zick, G. M. Homsy, J. Fluid Mech. 115, 13 (1982)
PHI, ZICK = np.array([0.001, 0.008, 0.027, 0.064, 0.125, 0.216, 0.343, 0.45, 0.5236]), np.array([1.212, 1.525, 2.008, 2.810, 4.292, 7.442, 15.4, 28.1, 42.1])
FORCE, TORQUE, KICK = 0.001, 0.001, 0.001
DRAG = {"drag_24": dict(n=24, radius=9.0, steps=470), "drag_20": dict(n=20, radius=6.2, steps=330), "drag_16": {}}
TURN = {"turn_20": dict(n=20, radius=6.2, steps=240), "turn_16": dict(steps=150)}
TAIL = {"kick": dict(n=32, radius=2.0, mu=0.1, kappa=1.0, viscous="explicit", every=5, steps=1500)}
COLLOID = dict(n=10, radius=2.0, force=0.0, shear="mg", kernel="wendland/c2", mu=0.1, viscous="explicit")
KAPPA = {"zero": 0.0, "ten": 1.0}
COLD = dict(dt=0.24, steps=1000)
NOISE = dict(T=0.001, dt=0.03, every=16, steps=100000)
SEEDS = range(1, 9)
SETTLE = 200                    # outputs before the means
PIECES = 10                     # of each run, for the standard errors
LAGS = 0.5, 1.5                 # times of the slope of the mean square displacement, over L^2 rho/(4 pi^2 mu)
TIMES = 2.0, 10.0               # of the tail, over a^2/nu
QUICK = {"drag_10": dict(n=10, radius=3.0, steps=110), "turn_10": dict(n=10, radius=3.0, steps=60)}
QUICK_NOISE, QUICK_COLD, QUICK_LAGS = dict(every=4, steps=3200), dict(steps=300), (0.02, 0.1)


def rest(phi):
    """1/K but for the interpolated part: H. Hasimoto, J. Fluid Mech. 5, 317 (1959)"""
    return 1 - 1.7601 * np.cbrt(phi) + phi - 1.5593 * phi**2


FIT = np.polyfit(np.cbrt(PHI), 1 / ZICK - rest(PHI), 6)


def array(phi):
    """K of a simple cubic array"""
    return 1 / (rest(phi) + np.polyval(FIT, np.cbrt(phi)))


def mean(values):
    """and standard error"""
    values = np.asarray(values)
    return values.mean(), values.std(ddof=1) / np.sqrt(len(values))


class Run:
    def __init__(self, out, name, n=16, mu=1.0, dt=0.28, **_):
        self.series = series(out / f"{name}.probe.txt")
        log = thermo((out / f"{name}.log").read_text())[-1]
        self.N, self.inertia, self.n, self.mu, self.L = log["v_N"][0], log["v_I"][0], n, mu, float(n)
        self.t = dt * self.series["step"]
        self.phi, self.a = self.N / n**3, np.cbrt(3 * self.N / 4 / np.pi)
        self.tau = n**2 / (4 * np.pi**2 * mu)

    def end(self, column):
        """Limit of a column that approaches it exponentially, from three values of the last two fifths"""
        one, two, three = self.series[column][[-1 - 2 * (len(self.t) // 5), -1 - len(self.t) // 5, -1]]
        return three - (three - two)**2 / ((three - two) - (two - one)) if three != two else three

    def drag(self):
        return FORCE / (6 * np.pi * self.mu * self.a * self.end("vx") * (1 - self.phi))

    def no_slip(self):
        """Radius of the sphere with this drag in a cubic array"""
        radii = np.linspace(0.8, 1.1, 3001) * self.a
        return np.interp(self.drag() * self.a, radii * array(4 / 3 * np.pi * radii**3 / self.L**3), radii)

    def couple(self):
        """over the couple of a sphere in the array"""
        return TORQUE / (8 * np.pi * self.mu * self.a**3 * self.end("oz")) / stokes.array(self.phi)[1]

    def tail(self):
        """Velocity after a kick, and that of a sphere of the density of the fluid by the equations of Stokes, in a periodic box.
        The sphere alone has the mobility 1/(1 + q + q^2/3)/(6 pi mu a), q = a (s/nu)^(1/2), in the time of Laplace: the force of A. B. Basset;
        R. Zwanzig, M. Bixon, Phys. Rev. A 2, 2005 (1970).  The box changes an integral over waves, (1 - a^2 k^2/3) 2/3 exp(-nu k^2 t), to a sum.
        """
        tau = np.maximum(self.t * self.mu / self.a**2, 1e-9)
        pole = np.array([[-3 + 1j * np.sqrt(3)], [-3 - 1j * np.sqrt(3)]]) / 2
        one, two = pole * wofz(-1j * pole * np.sqrt(tau))
        alone = (3 * (one - two) / (pole[0] - pole[1])).real
        waves = np.arange(-64, 65) * 2 * np.pi / self.L
        decay = np.exp(-self.mu * waves**2 * self.t[:, None])
        line, bend = decay.sum(axis=1), (waves**2 * decay).sum(axis=1)
        box = 2 / 3 * (line**3 - 1 - self.a**2 * bend * line**2) / self.L**3
        return (self.series["vx"] / (KICK * self.N / (1 - self.phi)),
                box + (alone - (1 - 0.5 / tau) * tau**-1.5 / (2 * np.sqrt(np.pi))) / (6 * np.pi * self.a**3))


class Colloid:
    def __init__(self, out, name, seeds, lags):
        translation, rotation, correlations, spreads = [], [], [], []
        for seed in seeds:
            run = Run(out, f"{name}_{seed}", n=COLLOID["n"], mu=COLLOID["mu"], dt=NOISE["dt"])
            x, v, o = (np.array([run.series[f"{what}{axis}"] for axis in "xyz"])[:, SETTLE:] for what in ("", "v", "o"))
            interval = NOISE["every"] * NOISE["dt"]
            self.lags = np.arange(int(lags[1] * run.tau / interval) + 1)
            for part in np.array_split(np.arange(x.shape[1]), PIECES):
                scale = run.N / NOISE["T"] / (1 - run.phi)
                translation.append(scale * (v[:, part]**2).mean())
                rotation.append(run.inertia / NOISE["T"] * (o[:, part]**2).mean())
                spreads.append([((x[:, part[lag:]] - x[:, part[:len(part) - lag]])**2).mean() / 2 / NOISE["T"] for lag in self.lags])
                correlations.append([scale * (v[:, part[lag:]] * v[:, part[:len(part) - lag]]).mean() for lag in self.lags])
        self.t, self.run = self.lags * interval, run
        self.translation, self.rotation = mean(translation), mean(rotation)
        near, far = (int(lag * run.tau / interval) for lag in lags)
        self.spread, self.correlation, self.scatter = np.mean(spreads, axis=0), np.mean(correlations, axis=0), mean(correlations)[1]
        self.hasimoto = 1 / (6 * np.pi * run.mu * run.a * array(run.phi))
        pull = Run(out, f"pull_{name}", **COLLOID, **COLD)
        self.mobility = pull.end("vx") / FORCE * (1 - pull.phi)
        self.pulled = pull.t, (pull.series["x"] - pull.series["x"][0]) / FORCE * (1 - pull.phi)
        begin, end = np.interp(self.t[[near, far]], *self.pulled)
        self.einstein = mean([(one[far] - one[near]) / (end - begin) for one in spreads])
        kick = Run(out, f"cold_{name}", **COLLOID, **COLD)
        self.response = kick.t, kick.series["vx"] / KICK


def plot(path, arrays, tails, colloids):
    plt = pyplot()
    figure, panels = plt.subplots(2, 2, figsize=(9.6, 7.0))
    (drag, tail), (spread, correlation) = panels
    phi = np.geomspace(0.005, 0.3, 100)
    drag.plot(phi, array(phi), "k-", lw=1.0, label="Zick and Homsy")
    for index, run in enumerate(arrays):
        drag.plot(run.phi, run.drag(), f"C{index}o", mfc="none", label=f"radius {run.a:.2f} spacings")
    drag.set(xscale="log", yscale="log", xlabel="volume fraction", title="drag over that of Stokes")
    for index, run in enumerate(tails):
        value, theory = run.tail()
        time = run.t * run.mu / run.a**2
        tail.loglog(time[1:], value[1:] * run.a**3, f"C{index}o", ms=3, mfc="none", label=f"radius {run.a:.2f} spacings")
        tail.loglog(time[1:], theory[1:] * run.a**3, f"C{index}-", lw=0.8, label="equations of Stokes, in the box")
    time = np.geomspace(0.5, 20, 50)
    tail.loglog(time, 1 / 12 / (np.pi * time)**1.5, "k:", label="$t^{-3/2}$, infinite fluid")
    tail.set(xlabel="$\\nu t/a^2$", ylim=(1e-4, 0.3), title="velocity after a kick, $V \\rho a^3/P$")
    for index, (name, one) in enumerate(colloids.items()):
        label = f"$\\kappa/\\mu$ = {KAPPA[name] / COLLOID['mu']:.0f}"
        spread.plot(one.t, one.spread, f"C{index}o", ms=3, mfc="none", label=label)
        spread.plot(*one.pulled, f"C{index}-", lw=0.8, label="displacement by a force, no noise")
        correlation.errorbar(one.t, one.correlation, one.scatter, color=f"C{index}", fmt="o", ms=2, lw=0.5, mfc="none", label=label)
        correlation.plot(*one.response, f"C{index}-", lw=0.8, label="velocity after a kick, no noise")
    spread.set(xlabel="time", xlim=(0, one.t[-1]), ylim=(0, 1.1 * one.spread[-1]), title="mean square displacement$/2k_BT$")
    correlation.set(xlabel="time", xlim=(0, one.t[-1]), title="correlation of the velocity, $M \\langle V(0) V(t)\\rangle/k_BT$")
    save(figure, path, legends=(drag, tail, spread, correlation))


def main():
    example = Example(HERE, "A sphere in three dimensions.")
    args = example.arguments()
    drags, turns, seeds, lags = DRAG, TURN, SEEDS, LAGS
    if args.quick:
        drags, turns = ({name: one} for name, one in QUICK.items())
        seeds, lags = (1,), QUICK_LAGS
        NOISE.update(QUICK_NOISE)
        COLD.update(QUICK_COLD)
    tails = {} if args.quick else TAIL
    jobs = {**drags, **{name: {**one, "force": 0.0, "torque": TORQUE} for name, one in turns.items()},
            **{name: {**one, "force": 0.0, "kick": KICK} for name, one in tails.items()}}
    for name, kappa in KAPPA.items():
        jobs.update({f"{name}_{seed}": {**COLLOID, **NOISE, "kappa": kappa, "seed": 4710 + seed} for seed in seeds})
        jobs[f"pull_{name}"] = {**COLLOID, **COLD, "kappa": kappa, "force": FORCE}
        jobs[f"cold_{name}"] = {**COLLOID, **COLD, "kappa": kappa, "kick": KICK}
    example.run(jobs)
    arrays, couples, kicks = ([Run(example.out, name, **one) for name, one in cases.items()] for cases in (drags, turns, tails))
    table = example.out / "sphere.csv"
    with csv_rows(table, ["what", "phi or kappa/mu", "radius", "value", "over reference", "error"]) as writerow:
        print("\nphi       radius  drag    published  ratio   radius of no slip - radius")
        for run in arrays:
            print(f"{run.phi:.5f}  {run.a:6.3f}  {run.drag():.4f}  {array(run.phi):.4f}     {run.drag() / array(run.phi):.4f}  {run.no_slip() - run.a:+.3f}")
            writerow(["drag", f"{run.phi:.5f}", f"{run.a:.3f}", f"{run.drag():.4f}", f"{run.drag() / array(run.phi):.4f}", ""])
        print("\nphi       radius  couple over that in the array")
        for run in couples:
            print(f"{run.phi:.5f}  {run.a:6.3f}  {run.couple():.4f}")
            writerow(["couple", f"{run.phi:.5f}", f"{run.a:.3f}", "", f"{run.couple():.4f}", ""])
        for run in kicks:
            value, theory = run.tail()
            print(f"\nkick, radius {run.a:.3f}: nu t/a^2, velocity over that by the equations of Stokes")
            for time in (1, 2, 3, 4, 6, 8, 10):
                k = np.searchsorted(run.t * run.mu / run.a**2, time)
                if k < len(value):
                    print(f"{time:3d}  {value[k] / theory[k]:.4f}")
                    writerow(["kick", time, f"{run.a:.3f}", f"{value[k]:.4g}", f"{value[k] / theory[k]:.4f}", ""])
        colloids = {name: Colloid(example.out, name, seeds, lags) for name in KAPPA}
        print("\nkappa/mu  M V^2/kT  error   I Omega^2/kT  error   mobility  Hasimoto  D over kT times mobility  error")
        for name, one in colloids.items():
            values = KAPPA[name] / COLLOID["mu"], *one.translation, *one.rotation, one.mobility, one.hasimoto, *one.einstein
            print("{:8.0f}  {:8.4f}  {:.4f}  {:12.4f}  {:.4f}  {:8.4f}  {:8.4f}  {:12.4f}  {:.4f}".format(*values))
            for what, (value, error) in (("translation", one.translation), ("rotation", one.rotation), ("D over kT times mobility", one.einstein)):
                writerow([what, values[0], f"{one.run.a:.3f}", f"{value:.4f}", f"{value:.4f}", f"{error:.4f}"])
            writerow(["mobility", values[0], f"{one.run.a:.3f}", f"{one.mobility:.4f}", f"{one.mobility / one.hasimoto:.4f}", ""])
    print()
    for run in arrays:
        example.merit(f"drag at phi = {run.phi:.3f}, radius {run.a:.2f}, over the published one", run.drag() / array(run.phi), 0.97 - 0.2 * args.quick, 1.03)
    for run in couples:
        example.merit(f"couple at phi = {run.phi:.3f}, radius {run.a:.2f}, over that in the array", run.couple(), 0.97 - 0.2 * args.quick, 1.03)
        example.merit(f"drag of stokes.py at phi = {run.phi:.3f}, over the published one", stokes.array(run.phi)[0] / array(run.phi), 0.999, 1.001)
    for run in kicks:
        value, theory = run.tail()
        late = (run.t * run.mu / run.a**2 > TIMES[0]) & (run.t * run.mu / run.a**2 < TIMES[1])
        for what, bound in (("least", np.min), ("largest", np.max)):
            example.merit(f"velocity after a kick over that by the equations of Stokes, {what} for {TIMES[0]:.0f} < nu t/a^2 < {TIMES[1]:.0f}", bound(value[late] / theory[late]), 0.9, 1.1)
    width = 5 if args.quick else 3
    for name, one in colloids.items():
        for kind, (value, error) in (("translation", one.translation), ("rotation", one.rotation)):
            example.merit(f"kappa/mu = {KAPPA[name] / COLLOID['mu']:.0f}: temperature of the {kind}", value, 1 - width * error, 1 + width * error)
        if not args.quick:
            bar = max(0.05, width * one.einstein[1])
            example.merit(f"kappa/mu = {KAPPA[name] / COLLOID['mu']:.0f}: D over kT times the mobility", one.einstein[0], 1 - bar, 1 + bar)
    picture = example.out / "sphere.png"
    plot(picture, arrays, kicks, colloids)
    return example.finish(table, picture)


if __name__ == "__main__":
    sys.exit(main())
