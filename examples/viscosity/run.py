#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Measures the viscosities of the particle fluid by the decay of waves, and compares with what was asked for.

    ./sphd run viscosity              or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import csv
import json
import sys
from collections import defaultdict
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from lattice_sums import Lattice, period  # noqa: E402
from run_lammps import Example, pyplot, save  # noqa: E402

KAPPAS = [0, 0.41, 1.67, 2.7, 10, 100, 1000]      # bulk over shear viscosity
DAMPING = 0.25                                    # damping ratio of the sound waves: c0 is chosen for that
STEPS = 600                                       # at least, for a sound wave
# fix sph of LAMMPS integrates the density and gives the force a pressure that is half a step late: an error
# of first order in dt of the damping, -w dt/(4 damping ratio), kept small by more damping and more steps
LATE_DAMPING, LATE_STEPS = 0.6, 3200
LENGTHS = (12, 16, 20, 28)                        # wavelengths on lattices, over h = support/2
SAMPLES = 60                                      # outputs of a run
MERIT = 0.01                                      # measured/requested, support of 4 or more particle distances
DISCRETE = 0.003                                  # measured/what the lattice has

# Viscosities of lattices from independent sums (support 3, 4, 6): shear term of mg and bulk term;
# for the square lattice the shear viscosity along [10] and [11] at support 3
HEX = {3: (0.984, 0.973), 4: (0.996, 0.993), 6: (0.999, 0.999)}
CUBIC = {3: 0.0415, 4: 0.0095, 6: 0.00155}        # mg on bcc and fcc: at most 4.1 %, 0.9 %, 0.15 % from 1, as printed
SQUARE = {"100": 0.877, "110": 1.098}


class Model:
    """Pair style and what its viscosities shall be: shear mu = 1, longitudinal lambda + 2 mu."""

    def __init__(self, name, shear="mg", kappa="intrinsic", style="sph/bulk", mu=1.0, kernel="wendland/c2"):
        self.name, self.shear, self.kappa, self.style, self.mu, self.kernel = name, shear, kappa, style, mu, kernel

    def intrinsic(self, n):
        return {"mg": 1 + 2 / n, "mg/fr": 1 + 2 / n, "morris": 2 / n - 1,
                "espanol": 2 / n - (n + 1) / (n + 3)}[self.shear] * self.mu

    def requested_kappa(self, n):
        return self.intrinsic(n) if self.kappa == "intrinsic" else self.kappa

    def requested(self, n, wave):
        return self.mu if wave == "shear" else self.requested_kappa(n) + 2 * (1 - 1 / n) * self.mu

    def zeta(self, n):
        return self.requested_kappa(n) - self.intrinsic(n)

    def discrete(self, lattice, wave, k):
        """What particles on a lattice have."""
        if wave == "shear":
            return self.mu * lattice.shear_term(self.shear, 1, k)
        return self.mu * lattice.shear_term(self.shear, 0, k) + self.zeta(lattice.dim) * lattice.bulk_term(k)


MG = Model("mg")
MORRIS = Model("morris", "morris")
BULK = [Model(f"mg, kappa/mu = {kappa:g}", kappa=kappa) for kappa in KAPPAS]
FORMS = [Model("mg/fr", "mg/fr"), Model("espanol", "espanol"), Model("morris, kappa/mu = 10", "morris", 10)]
LAMMPS_MORRIS = Model("LAMMPS sph/taitwater/morris", "morris", style="sph/taitwater/morris", kernel="lucy")


def lammps_sdpd(dim):
    """At T = 0; in two dimensions the viscosity is not what was given to the style, 1, but 25/24 of it."""
    return Model("LAMMPS sdpd/taitwater/isothermal", "espanol", style="sdpd/taitwater/isothermal",
                 mu={2: 25 / 24, 3: 1.0}[dim], kernel="lucy")


class Set:
    """An arrangement of particles with the support of the kernel and the wavelengths."""

    def __init__(self, arrangement, support, direction="100", lengths=LENGTHS, width=1, seeds=(1,), dim=None):
        self.arrangement, self.support, self.direction, self.width, self.seeds = arrangement, support, direction, width, seeds
        self.random = arrangement == "random"
        self.dim = dim or Lattice(arrangement, direction, 2.0).dim
        self.h = support / 2
        self.period = 1.0 if self.random else period(arrangement, direction)
        self.cells = [round(length * self.h / self.period) for length in lengths]
        turned = f" [{direction[:self.dim]}]" if arrangement in ("sq", "sc", "bcc", "fcc") else ""
        self.name = f"{self.dim}d {arrangement}{turned}, support {support}"

    def lattice(self, kernel="wendland/c2", summed=True):
        """Of the arrangement; for a random one the isotropic lattice that tells how viscosities fall with k."""
        name = {2: "hex", 3: "bcc"}[self.dim] if self.random else self.arrangement
        return Lattice(name, self.direction, self.support, kernel, summed)

    def settled(self, cells, seed):
        return f"settled.{self.dim}d.support{self.support}.{cells}x{self.width}.seed{seed}"


class Wave:
    """One run of LAMMPS: what it is given, and the viscosity that its decay tells."""

    def __init__(self, where, model, wave, cells, seed=1, refine=1):
        self.where, self.model, self.wave, self.cells, self.seed, self.refine = where, model, wave, cells, seed, refine
        n, h = where.dim, where.h
        self.k = 2 * np.pi / (cells * where.period)
        self.q = (self.k * h) ** 2
        rate = model.requested(n, wave) * self.k**2
        damping, least = (DAMPING, STEPS) if model.style == "sph/bulk" else (LATE_DAMPING, LATE_STEPS)
        sound = rate / (2 * damping * self.k) if wave == "sound" else 10 * self.k
        # a third of the step at which the shortest waves become unstable; Lucy's kernel is steeper
        stiff = {"mg": 17.7, "mg/fr": 17.7, "morris": 7.0, "espanol": 9.7}[model.shear] * model.mu
        viscous = (stiff + 1.35 * abs(model.zeta(n))) / h**2 * (1.5 if model.kernel == "lucy" else 1.0)
        step = min(0.33 / viscous, 0.1 * h / sound)
        if wave == "sound":
            # the amplitude falls to a tenth, in one and a half periods unless damped more
            total = 0.375 / damping * 2 * np.pi / (sound * self.k)
            step = min(step, total / least)
        elif where.random:
            total = 0.8 / rate
        else:
            # a wave on a lattice decays exactly exponentially: a short time is enough
            total = min(0.5 / rate, 800 * step)
        self.c0 = sound
        self.every = int(2 * np.ceil(total / step / SAMPLES / 2) * refine)
        self.steps = SAMPLES * self.every
        self.dt = total / self.steps
        late = wave == "sound" and model.style != "sph/bulk"
        self.late_error = sound * self.k * self.dt / (4 * damping) if late else 0.0
        words = [str(n) + "d", where.arrangement, where.direction, f"support{where.support}", model.style, model.shear,
                 f"kappa{model.kappa}", wave, f"cells{cells}", f"seed{seed}"]
        self.name = "_".join(words).replace("/", "-") + (f"_refine{refine:g}" if refine != 1 else "")
        self.cost = self.steps * cells * where.width ** (n - 1) * (5 if n == 3 else 1)

    def variables(self):
        w, m = self.where, self.model
        values = {"dim": w.dim, "arrangement": w.arrangement, "direction": w.direction, "cells": self.cells,
                  "width": w.width, "seed": self.seed, "wave": self.wave, "style": m.style, "kernel": m.kernel,
                  "shear": m.shear, "kappa": m.kappa, "bulk": "none" if m.kappa == "intrinsic" else "density",
                  "support": w.support, "c0": repr(float(self.c0)), "dt": repr(float(self.dt)), "steps": self.steps,
                  "every": self.every}
        if w.random:
            values["settled"] = w.settled(self.cells, self.seed)
        return values

    def measure(self, out):
        _, t, a, density = np.loadtxt(out / f"{self.name}.txt").T
        if len(t) != SAMPLES + 1:
            raise SystemExit(f"viscosity: {self.name}.txt has {len(t)} lines, not {SAMPLES + 1}")
        rho = density[0]
        if self.wave == "shear":
            use = t >= 0.25 * t[-1] if self.where.random else t >= 0
            # straight line through the logarithm
            p, cov = np.polyfit(t[use], np.log(a[use]), 1, cov="unscaled")
            rest = np.log(a[use]) - np.polyval(p, t[use])
            gamma, error = -p[0], np.sqrt(cov[0, 0] * np.sum(rest**2) / (np.sum(use) - 2))
            self.speed = None
        else:
            gamma, error = self.oscillator(t, a)
        self.value = gamma * rho / self.k**2
        self.error = error * rho / self.k**2
        return self

    def oscillator(self, t, a):
        """Damping rate g of a'' + g a' + w0^2 a = 0; amplitude and phase are fitted as well."""
        guess = np.array([self.model.requested(self.where.dim, "sound") * self.k**2, self.c0 * self.k])

        def basis(p):
            g, w0 = p * guess
            w = np.sqrt(complex(w0**2 - g**2 / 4))
            return np.column_stack([(np.exp(-g * t / 2) * np.cos(w * t)).real,
                                    (np.exp(-g * t / 2) * np.sin(w * t) / w).real])

        def residual(p):
            b = basis(p)
            return b @ np.linalg.lstsq(b, a, rcond=None)[0] - a

        fit = least_squares(residual, [1.0, 1.0], xtol=1e-12, ftol=1e-12, gtol=1e-12)
        variance = np.sum(fit.fun**2) / (len(t) - 4)
        error = np.sqrt(variance * np.linalg.inv(fit.jac.T @ fit.jac)[0, 0])
        self.speed = fit.x[1]     # over c0
        return fit.x[0] * guess[0], error * guess[0]


class Result:
    """Viscosity of one set and model, extrapolated to kh -> 0."""

    def __init__(self, waves, dt_error):
        first = waves[0]
        self.where, self.model, self.wave, self.waves = first.where, first.model, first.wave, waves
        self.requested = self.model.requested(self.where.dim, self.wave)
        self.lattice = self.where.lattice(self.model.kernel, self.model.style == "sph/bulk")
        self.discrete = self.model.discrete(self.lattice, self.wave, 0)
        q = np.array([w.q for w in waves])
        v = np.array([w.value for w in waves])
        dt_error += max(w.late_error for w in waves)
        if self.where.random:
            # the scatter between arrangements hides the fourth power of k: take out the fall with k that
            # the lattice has, and average
            scaled = np.array([w.value * self.discrete / self.model.discrete(self.lattice, self.wave, w.k) for w in waves])
            self.value = scaled.mean()
            self.error = scaled.std(ddof=1) / np.sqrt(len(scaled)) + dt_error * abs(self.value)
            self.lattice_error = None
        else:
            # through the three longest waves, and with the shortest one as a check on the extrapolation
            fine = np.polyfit(q, v, 3)[-1]
            coarse = np.polyfit(np.sort(q)[:3], v[np.argsort(q)][:3], 2)[-1]
            self.value = fine
            self.error = np.hypot(abs(fine - coarse), max(w.error for w in waves)) + dt_error * abs(fine)
            # every wavelength against the sum over the lattice at that wavelength
            self.lattice_error = max(abs(w.value / self.model.discrete(self.lattice, self.wave, w.k) - 1) for w in waves)
            self.speed_error = max(abs(w.speed / self.lattice.sound_speed(w.k) - 1) for w in waves) if self.wave == "sound" else 0.0

    @property
    def ratio(self):
        return self.value / self.requested


def plan(quick):
    """(set, models, waves) to measure."""
    both = ("shear", "sound")
    some = [MG, MORRIS, BULK[0], BULK[4], BULK[6]]
    sets = []
    hexagonal = {s: Set("hex", s) for s in (3, 4, 6)}
    bcc = {s: Set("bcc", s) for s in (3, 4, 6)}
    sets.append((hexagonal[4], some if quick else [MG, MORRIS, *BULK, *FORMS], both))
    sets.append((bcc[4], some if quick else [MG, MORRIS, *BULK, *FORMS], both))
    if not quick:
        sets += [(hexagonal[s], some, both) for s in (3, 6)]
        sets += [(bcc[s], some, both) for s in (3, 6)]
        sets += [(Set("fcc", 4), [MG, MORRIS, *BULK], both)]
        sets += [(Set("bcc", 4, "110"), some, both), (Set("fcc", 4, "110"), some, both)]
        sets += [(Set("sq", s, d), [MG, MORRIS, FORMS[0]], both) for s in (4, 6) for d in ("100", "110")]
    sets += [(Set("sq", 3, d), [MG, MORRIS, FORMS[0]], ("shear",) if quick else both) for d in ("100", "110")]
    sets += [(where, [LAMMPS_MORRIS, lammps_sdpd(where.dim)], both) for where in (hexagonal[4], bcc[4])]
    if quick:
        sets.append((Set("random", 4, lengths=(12, 16), width=20, seeds=(1,), dim=2), [MG, BULK[4]], both))
    else:
        sets.append((Set("random", 4, lengths=(12, 16, 24), width=24, seeds=(1, 2), dim=2), [MG, MORRIS, *BULK], both))
        sets += [(Set("random", s, lengths=(12, 16), width=24, seeds=(1, 2), dim=2), [MG, MORRIS, BULK[4]], both) for s in (3, 6)]
        sets.append((Set("random", 4, lengths=(10, 14), width=9, seeds=(1, 2), dim=3),
                     [MG, MORRIS, BULK[0], BULK[2], BULK[4]], both))
    return sets


def time_steps():
    """The same waves with the double, single and half step."""
    where = Set("hex", 4)
    return {(model, wave): [Wave(where, model, wave, 32, refine=refine) for refine in (0.5, 1, 2)]
            for model, wave in ((MG, "shear"), (MG, "sound"), (BULK[4], "sound"))}



def table(results):
    """One row for every set and model."""
    rows = []
    for (where, model), waves in results.items():
        any_wave = next(iter(waves.values()))
        n = any_wave.where.dim
        row = {"set": where, "model": model, "kappa_requested": any_wave.model.requested_kappa(n)}
        for wave, name in (("shear", "mu"), ("sound", "longitudinal")):
            r = waves.get(wave)
            row |= {f"{name}_requested": r.requested, f"{name}_measured": r.value, f"{name}_uncertainty": r.error,
                    f"{name}_ratio": r.ratio, f"{name}_ratio_uncertainty": r.error / r.requested,
                    f"{name}_lattice": None if r.where.random else r.discrete / r.requested} if r else {}
        if len(waves) == 2:
            factor = 2 * (1 - 1 / n)
            row["kappa_measured"] = waves["sound"].value - factor * waves["shear"].value
            row["kappa_uncertainty"] = np.hypot(waves["sound"].error, factor * waves["shear"].error)
        rows.append(row)
    return rows


def show(rows):
    print(f"{'':28s}{'':34s}   mu: measured/requested    lambda + 2 mu: measured/requested     kappa/mu")
    print(f"{'set':28s}{'model':34s}   {'':18s} lattice  {'':24s} lattice   wanted    measured")
    last = None
    for row in rows:
        cells = []
        for name, width in (("mu", 5), ("longitudinal", 5)):
            if f"{name}_ratio" in row:
                lattice = row[f"{name}_lattice"]
                cells.append(f"{row[f'{name}_ratio']:.{width}f} +- {row[f'{name}_ratio_uncertainty']:.{width}f}  "
                             + (f"{lattice:.5f}" if lattice else " " * 7))
            else:
                cells.append(" " * 28)
        kappa = f"{row['kappa_requested']:9.4g}  {row['kappa_measured']:9.4f} +- {row['kappa_uncertainty']:.4f}" \
            if "kappa_measured" in row else ""
        print(f"{row['set'] if row['set'] != last else '':28s}{row['model']:34s}   {cells[0]:28s}      {cells[1]:28s} {kappa}")
        last = row["set"]


def judge(example, results, refined, rows):
    """The figures of merit."""
    sets = defaultdict(list)
    for (where, _), waves in results.items():
        sets[where] += waves.values()
    merit = example.merit
    for name, group in sets.items():
        where = group[0].where
        ours = [r for r in group if r.model.style == "sph/bulk"]
        if ours and (where.arrangement in ("hex", "bcc", "fcc") or where.random) and where.support >= 4:
            for wave, what in (("shear", "mu"), ("sound", "lambda + 2 mu")):
                worst = max(abs(r.ratio - 1) for r in ours if r.wave == wave)
                merit(f"{name}: {what}, largest |measured/requested - 1|", worst, 0, MERIT)
        if where.arrangement == "hex" and ours:
            shear, bulk = HEX[where.support]
            worst = max(abs(r.value / (shear * (r.requested - (z := r.model.zeta(2) if r.wave == "sound" else 0)) + bulk * z) - 1)
                        for r in ours if r.model.shear in ("mg", "morris"))
            merit(f"{name}: largest difference from the discrete values", worst, 0, DISCRETE)
        if where.arrangement in ("bcc", "fcc") and ours:
            worst = max(abs(r.ratio - 1) for r in ours if r.model.name == "mg")
            merit(f"{name}: mg, largest |measured/requested - 1|", worst, 0, CUBIC[where.support])
        if where.arrangement == "sq" and where.support == 3:
            value = next(r.ratio for r in group if r.model.name == "mg" and r.wave == "shear")
            expected = SQUARE[where.direction]
            merit(f"{name}: mu of mg", value, expected * (1 - DISCRETE), expected * (1 + DISCRETE))
        shear = {r.model.name: r.value for r in ours if r.wave == "shear" and r.model.shear == "mg"}
        if "mg" in shear and len(shear) > 1:
            worst = max(abs(v / shear["mg"] - 1) for v in shear.values())
            merit(f"{name}: mu changed by the bulk term", worst, 0, 1e-3)
    worst = max(r.lattice_error for group in sets.values() for r in group if not r.where.random)
    merit("lattices: viscosity, largest difference from the lattice sum at the same wavelength", worst, 0, 1e-3)
    worst = max(r.speed_error for group in sets.values() for r in group if not r.where.random)
    merit("lattices: speed of sound, the same", worst, 0, 1e-3)
    for row in rows:
        if row["model"] in ("mg", "morris") and "kappa_measured" in row and row["set"] in ("2d hex, support 4", "3d bcc [100], support 4"):
            n = int(row["set"][0])
            theory = {"mg": 1 + 2 / n, "morris": 2 / n - 1}[row["model"]]
            merit(f"{row['set']}: {row['model']} alone, (kappa - {theory:.4g} mu)/(lambda + 2 mu)",
                  (row["kappa_measured"] - theory) / row["longitudinal_requested"], -MERIT, MERIT)
        if row["model"].startswith("LAMMPS"):
            for name in ("mu", "longitudinal"):
                merit(f"{row['set']}: {row['model']}, {name}, measured/theory", row[f"{name}_ratio"], 1 - MERIT, 1 + MERIT)
    for (model, wave), waves in refined.items():
        coarse, normal, fine = (w.value for w in waves)
        merit(f"order of the time step, {model.name}, {wave}", np.log2(abs((coarse - normal) / (normal - fine))), 1.8, 2.5)


def write_tables(out, rows, results):
    keys = list(dict.fromkeys(key for row in rows for key in row))
    with open(out / "viscosity.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, keys)
        writer.writeheader()
        for row in rows:
            writer.writerow({k: f"{v:.6g}" if isinstance(v, float) else v for k, v in row.items()})
    points = [{"set": key[0], "model": key[1], "wave": r.wave, "kh": float(np.sqrt(w.q)), "seed": w.seed,
               "viscosity": float(w.value), "fit_uncertainty": float(w.error), "c0": float(w.c0), "dt": float(w.dt),
               "speed_over_c0": w.speed, "steps": w.steps}
              for key, waves in results.items() for r in waves.values() for w in r.waves]
    (out / "waves.json").write_text(json.dumps(points, indent=0) + "\n")
    return [out / "viscosity.csv", out / "waves.json"]


def plot(out, results, rows):
    plt = pyplot()
    paths = []

    def keep(figure, name):
        paths.append(save(figure, out / name))

    shown = {"2d hex, support 4": ("hexagonal", "o", "C0"), "3d bcc [100], support 4": ("bcc", "s", "C1"),
             "3d fcc [100], support 4": ("fcc", "D", "C2"), "2d random, support 4": ("2d disordered", "^", "C3"),
             "3d random, support 4": ("3d disordered", "v", "C4")}
    shown = {name: style for name, style in shown.items() if any(row["set"] == name for row in rows)}

    # measured against requested
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.8), gridspec_kw={"width_ratios": [1.15, 1, 1]})
    line = np.concatenate([[-1, 0], np.geomspace(0.1, 2000, 50)])
    axes[0].plot(line, line, "k-", lw=0.8, zorder=1)
    # arrangements side by side, so that none hides another
    for i, (name, (label, marker, color)) in enumerate(shown.items()):
        shift = 1.06 ** (i - len(shown) / 2)
        for row in (row for row in rows if row["set"] == name):
            plain = row["model"] in ("mg", "morris")
            if not (plain or row["model"].startswith("mg, kappa")):
                continue
            style = dict(color=color, mfc=color if row["model"] == "mg" else "none", mew=0.9, ls="none",
                         capsize=2 if "random" in name else 0)
            mark = "*" if row["model"] == "morris" else marker
            axes[0].errorbar(row["kappa_requested"], row["kappa_measured"], row["kappa_uncertainty"], marker=mark,
                             ms=9 if mark == "*" else 5, **style)
            if row["model"] == "morris":
                continue
            x = row["kappa_requested"] * shift if row["kappa_requested"] else 0.02 * (i - len(shown) / 2)
            for panel, key in ((1, "mu"), (2, "longitudinal")):
                axes[panel].errorbar(x, row[f"{key}_ratio"], row[f"{key}_ratio_uncertainty"], marker=marker, ms=5, **style)
        axes[1].plot([], [], marker, color=color, mfc="none", label=label)
    axes[0].plot([], [], "ks", ms=5, label="mg alone: $2\\mu$, $\\frac{5}{3}\\mu$")
    axes[0].plot([], [], "k*", ms=9, mfc="none", label="morris alone: 0, $-\\frac{1}{3}\\mu$")
    axes[0].plot([], [], "ks", ms=5, mfc="none", label="mg + bulk")
    axes[0].set_xscale("symlog", linthresh=0.4)
    axes[0].set_yscale("symlog", linthresh=0.4)
    axes[0].set_xlim(-0.6, 2000)
    axes[0].set_ylim(-0.6, 2000)
    axes[0].set_ylabel("measured $\\kappa/\\mu$")
    axes[0].legend(loc="upper left")
    axes[1].legend(loc="lower left", ncol=2)
    for axis, title in zip(axes[1:], ("$\\mu$", "$\\lambda + 2\\mu$")):
        axis.axhspan(0.99, 1.01, color="0.92", zorder=0)
        axis.axhline(1, color="k", lw=0.8)
        axis.set_xscale("symlog", linthresh=0.4)
        axis.set_xlim(-0.15, 2000)
        axis.set_ylim(0.975, 1.02)
        axis.set_title(f"{title}: measured over requested")
    axes[0].set_title("bulk viscosity")
    for axis in axes:
        axis.set_xlabel("requested $\\kappa/\\mu$")
        axis.set_xticks([0, 1, 10, 100, 1000], ["0", "1", "10", "100", "1000"])
    axes[0].set_yticks([0, 1, 10, 100, 1000], ["0", "1", "10", "100", "1000"])
    keep(figure, "viscosity.png")

    # wavelength: points from LAMMPS, lines from the lattice sums
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 4.0))
    q = np.linspace(0, 0.31, 60)
    for axis, (name, title) in zip(axes[:2], (("2d hex, support 4", "2d, hexagonal"), ("3d bcc [100], support 4", "3d, bcc"))):
        cases = [("mg", "shear", "mg, shear wave", "o"), ("mg", "sound", "mg, sound", "s"), ("morris", "shear", "morris, shear wave", "^"),
                 ("mg, kappa/mu = 10", "sound", "mg + bulk, $\\kappa = 10\\mu$, sound", "D"),
                 ("mg, kappa/mu = 1000", "sound", "mg + bulk, $\\kappa = 1000\\mu$, sound", "v")]
        for i, (model, wave, label, marker) in enumerate(cases):
            r = results.get((name, model), {}).get(wave)
            if r is None:
                continue
            axis.plot(q, [r.model.discrete(r.lattice, wave, np.sqrt(x) / r.where.h) / r.requested for x in q], "-", color=f"C{i}", lw=1)
            axis.plot([w.q for w in r.waves], [w.value / r.requested for w in r.waves], marker, color=f"C{i}", mfc="none", ms=5, label=label)
            axis.plot(0, r.ratio, marker, color=f"C{i}", ms=5)
        axis.axhline(1, color="k", lw=0.8)
        axis.set_title(title + ", support 4 $\\Delta x$")
        axis.set_xlabel("(wave number times\nsmoothing length)$^2$, $(kh)^2$")
        axis.set_ylim(0.875, 1.01)       # room for the legend
        axis.legend(loc="lower left")
    axes[0].set_ylabel("viscosity, measured / requested")
    for i, (name, label) in enumerate((("2d hex, support 4", "hexagonal"), ("3d bcc [100], support 4", "bcc"))):
        r = results[name, "mg"]["sound"]
        axes[2].plot(q, [r.lattice.sound_speed(np.sqrt(x) / r.where.h) for x in q], "-", color=f"C{i}", lw=1)
        axes[2].plot([w.q for w in r.waves], [w.speed for w in r.waves], "os"[i], color=f"C{i}", mfc="none", ms=5, label=f"mg, {label}")
    axes[2].axhline(1, color="k", lw=0.8)
    axes[2].set_title("speed of sound over $c_0$")
    axes[2].set_xlabel("(wave number times\nsmoothing length)$^2$, $(kh)^2$")
    axes[2].legend(loc="lower left")
    keep(figure, "wavelength.png")

    # lattices and supports
    figure, axis = plt.subplots(figsize=(8.2, 4.2))
    names = ["2d hex", "2d random", "2d sq [10]", "2d sq [11]", "3d bcc [100]", "3d bcc [110]", "3d fcc [100]", "3d fcc [110]", "3d random"]
    labels = ["hexagonal", "2d dis-\nordered", "square\n[10]", "square\n[11]", "bcc\n[100]", "bcc\n[110]", "fcc\n[100]", "fcc\n[110]",
              "3d dis-\nordered"]
    axis.axhspan(0.99, 1.01, color="0.92", zorder=0)
    axis.axhline(1, color="k", lw=0.8)
    for j, support in enumerate((3, 4, 6)):
        for m, (model, marker) in enumerate((("mg", "o"), ("morris", "^"), ("mg/fr", "s"))):
            points = [(i + 0.24 * (j - 1) + 0.05 * (m - 1), results[f"{name}, support {support}", model]["shear"])
                      for i, name in enumerate(names) if (f"{name}, support {support}", model) in results]
            for x, r in points:
                axis.errorbar(x, r.ratio, r.error / r.requested, marker=marker, color=f"C{j}", mfc="none", ms=6,
                              capsize=2 if r.where.random else 0)
    for j, support in enumerate((3, 4, 6)):
        axis.plot([], [], "s", color=f"C{j}", mec="none", label=f"support {support} $\\Delta x$")
    for model, marker in (("mg", "o"), ("morris", "^"), ("mg/fr", "s")):
        axis.plot([], [], marker, color="k", mfc="none", label=model)
    axis.legend(ncol=2, loc="lower right")
    axis.set_xticks(range(len(names)), labels)
    axis.grid(axis="x", visible=False)
    axis.set_ylabel("shear viscosity, measured / requested")
    keep(figure, "arrangements.png")
    return paths


def main():
    example = Example(HERE, "Viscosities of the particle fluid, measured by the decay of waves.")
    args = example.arguments()
    groups = defaultdict(list)
    for where, models, waves in plan(args.quick):
        for model in models:
            for wave in waves:
                for cells in where.cells:
                    for seed in where.seeds:
                        groups[where.name, model.name, wave].append(Wave(where, model, wave, cells, seed))
    refined = time_steps()
    runs = [w for group in [*groups.values(), *refined.values()] for w in group]

    settle = {}
    for w in sorted((w for w in runs if w.where.random), key=lambda w: -w.cost):
        # the first run of every arrangement settles it and keeps it in a file
        settle.setdefault(w.where.settled(w.cells, w.seed), {**w.variables(), "steps": 1, "every": 1})
    for name in settle:
        (example.out / f"{name}.data").unlink(missing_ok=True)
    example.run(settle)
    example.run({w.name: w.variables() for w in sorted(runs, key=lambda w: -w.cost)})
    for w in runs:
        w.measure(example.out)

    # what the step of all runs costs in accuracy
    dt_error = max(abs(normal.value / fine.value - 1) * 4 / 3 for _, normal, fine in refined.values())
    results = defaultdict(dict)
    for (where, model, wave), group in groups.items():
        results[where, model][wave] = Result(group, dt_error)
    rows = table(results)
    print()
    show(rows)
    print()
    judge(example, results, refined, rows)
    return example.finish(*write_tables(example.out, rows, results), *plot(example.out, results, rows))


if __name__ == "__main__":
    sys.exit(main())
