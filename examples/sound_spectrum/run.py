#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Sound and shear in the thermal fluctuations of a fluid, for three bulk viscosities at the same shear viscosity.

    ./sphd run sound_spectrum          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.integrate import quad
from scipy.optimize import least_squares
from scipy.special import j0

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, pyplot, save      # noqa: E402

C0, MU, T, SUPPORT = 3.0, 1.5, 0.009, 5.0
WAVES = ((1, 0), (0, 1), (2, 0), (0, 2), (1, 1), (1, -1))    # in the order of the columns
# by kappa/mu: steps, time step, steps between two rows. The long waves lose (1 - a) and not exp(-a) in a step, so a
# larger viscosity has a smaller step
RUNS = {0: (400000, 0.05, 10), 1: (300000, 0.05, 10), 10: (200000, 0.02, 25)}
QUICK = {1: (12000, 0.05, 10)}
# many neighbours, for the structure; without a bulk term, and about critically damped
STRUCTURE = {"kappa": 2, "mu": 2.0, "T": 0.02, "support": 12, "dt": 0.2, "nx": 28, "ny": 16, "settle": 500, "every": 4}
STRUCTURE_STEPS, STRUCTURE_QUICK = 30000, 400
PIECES = 8             # of a series, for its statistical error


def box(nx=24, ny=14):
    """Lengths of the box and number of particles, of a hexagonal lattice of density 1."""
    a = np.sqrt(2 / np.sqrt(3))
    return np.array([nx * a, ny * a * np.sqrt(3)]), 2 * nx * ny


def series(path, lengths):
    """By wave: wave number, amplitudes of density, longitudinal and transverse velocity; rows of the series are steps."""
    data = np.loadtxt(path)
    sums = data[:, 1:].reshape(len(data), len(WAVES), 3, 2) @ [1, 1j]
    found = []
    for number, wave in enumerate(WAVES):
        k = 2 * np.pi * np.array(wave) / lengths
        e = k / np.linalg.norm(k)
        density, u = sums[:, number, 0], sums[:, number, 1:]
        found.append((np.linalg.norm(k), density, u @ e, u @ np.array([-e[1], e[0]])))
    return found


def kernel(q):
    """Fourier transform of wendland/c2 in two dimensions; q = k times its support."""
    return quad(lambda s: 14 * s * (1 - s)**4 * (1 + 4 * s) * j0(q * s), 0, 1)[0]


def theory(k, kappa):
    """Rates of shear and sound of this fluid at wave number k: continuum, finite wavelength (theory page)."""
    kh2 = (0.5 * k * SUPPORT)**2
    along = 3 * MU * (1 - 0.077 * kh2) + (kappa - 2) * MU * (1 - 0.28 * kh2)
    return MU * (1 - 0.046 * kh2) * k**2, 0.5 * along * k**2


def correlation(z, count):
    """Re <z(t) z*(0)> for the first `count` lags."""
    n = len(z)
    f = np.fft.fft(z, 2 * n)
    return np.fft.ifft(f * f.conj()).real[:count] / np.arange(n, n - count, -1)


def decay(time, rate):
    return np.exp(-rate * time)


def wave(time, gamma, square):
    """Current of a damped wave: exp(-g t) [cos w t - (g/w) sin w t] with w^2 = square - g^2, also beyond critical damping."""
    w = np.sqrt(complex(square - gamma**2)) + 1e-9
    return (np.exp(-gamma * time) * (np.cos(w * time) - gamma / w * np.sin(w * time))).real


def fit(function, time, values, guess):
    return least_squares(lambda p: function(time, *p) - values / values[0], guess, x_scale=np.abs(guess)).x


def fluid(example, kappa, steps, dt, every, waves):
    """Rates of the correlations and of the fluid without noise, for each wave, shear and sound."""
    lengths, particles = box()
    name = f"kappa{kappa}"
    noisy = series(example.out / f"{name}.series.txt", lengths)
    rest = series(example.out / f"{name}.rest.series.txt", lengths)
    step, found = every * dt, []
    for number in waves:
        k, density, *currents = noisy[number]
        guesses = theory(k, kappa)
        for along in (1, 0):
            own = series(example.out / f"{name}.{number}.{along}.series.txt", lengths)[number]
            answer = (own[3 - along] - rest[number][3 - along][:len(own[1])]).real
            guess = guesses[along]
            count = min(int((2.0 if along else 1.2) / guess / step), len(answer))
            time = step * np.arange(count)
            function, first = (wave, [guess, (C0 * kernel(k * SUPPORT) * k)**2]) if along else (decay, [guess])
            z = currents[1 - along]
            pieces = np.array([correlation(p, count) for p in np.array_split(z, PIECES)])
            # jackknife
            rates = [fit(function, time, values, first)[0] for values in
                     (np.mean(pieces, axis=0), *((np.sum(pieces, axis=0) - p) for p in pieces))]
            alone = fit(function, time, answer[:count], first)
            found.append({"kappa": kappa, "wave": WAVES[number], "k": k, "along": along, "rate": rates[0],
                          "others": np.array(rates[1:]), "alone": alone[0], "square": alone[-1], "theory": guess,
                          "time": time, "correlation": np.mean(pieces, axis=0) / np.mean(pieces[:, 0]),
                          "answer": answer[:count] / answer[0], "power": np.mean(np.abs(z)**2) / particles,
                          "samples": len(z) * step * guess, "density": density})
    return found


def mean_ratio(results):
    """Rate of the correlations over that without noise, mean over waves by their number of decay times, and its error.

    The error is the larger one of that of an exponential seen for so many decay times and of that between the pieces.
    """
    samples = np.array([r["samples"] for r in results])
    weights = samples / samples.sum()
    ratio = sum(w * r["rate"] / r["alone"] for w, r in zip(weights, results))
    others = sum(w * r["others"] / r["alone"] for w, r in zip(weights, results))
    return ratio, max(1 / np.sqrt(samples.sum()), np.sqrt((PIECES - 1) * np.var(others)))


def over_theory(waves, particles, support, temperature):
    """S(k) over that of the theory page, for each wave and piece of the series."""
    ratios = []
    for k, density, *_ in waves:
        sound = (C0 * kernel(k * support))**2
        ratios.append([np.mean(np.abs(p)**2) / particles * (1 + sound / temperature)
                       for p in np.array_split(density, PIECES)])
    return np.array(ratios)


def spectrum(z, dt, parts):
    """Power of z by frequency, mean over pieces of the series."""
    n = len(z) // parts
    pieces = z[:parts * n].reshape(parts, n) * np.hanning(n)
    power = np.mean(np.abs(np.fft.fft(pieces))**2, axis=0) * dt / np.sum(np.hanning(n)**2)
    omega = 2 * np.pi * np.fft.fftfreq(n, dt)
    order = np.argsort(omega[omega > 0])
    return omega[omega > 0][order], 0.5 * (power[omega > 0] + power[::-1][:-1][omega[1:] > 0])[order]


def plot(path, results):
    plt = pyplot()
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(9.6, 3.4))
    for index, kappa in enumerate(results):
        color = f"C{index}"
        # two waves of the same length
        sound, shear = ([r for r in results[kappa] if r["along"] == a and abs(r["wave"][1]) == r["wave"][0]]
                        for a in (1, 0))
        step = sound[0]["time"][1]
        densities = [r["density"] for r in sound]
        spectra = [spectrum(z, step, int(len(z) * step / 400) + 1) for z in densities]
        omega, power = spectra[0][0], np.mean([s[1] for s in spectra], axis=0)
        w2, gamma = (np.mean([r[name] for r in sound]) for name in ("square", "alone"))
        peak = 4 * gamma * w2 / ((omega**2 - w2)**2 + 4 * gamma**2 * omega**2)
        left.semilogy(omega, power / np.mean(np.abs(densities)**2), color + ".", ms=3, alpha=0.5)
        left.semilogy(omega, peak, color, lw=1.2, label=f"$\\kappa/\\mu$ = {kappa}")
        for axes, both in ((middle, sound), (right, shear)):
            time, found, answer = (np.mean([r[name] for r in both], axis=0) for name in ("time", "correlation", "answer"))
            few = max(1, len(time) // 60)
            axes.plot(time[::few], found[::few], color + ".", ms=3, label=f"$\\kappa/\\mu$ = {kappa}")
            axes.plot(time, answer, color, lw=0.9)
    left.set(xlim=(0, 2.5), ylim=(1e-2, 1e2), xlabel="frequency $\\omega$ (lj units)", ylabel="dynamic structure factor $S(k,\\omega)/S(k)$")
    middle.set(xlabel="time (lj units)", ylabel="correlation of the longitudinal current")
    right.set(xlabel="time (lj units)", ylabel="correlation of the transverse current", ylim=(0, 1))
    left.legend()
    right.legend()
    save(figure, path)


def jobs(example, runs, waves, structure_steps):
    """The fluids with noise first, then each from its last particles without noise: at rest, and with one wave each."""
    example.run({**{f"kappa{kappa}": {"kappa": kappa, "steps": steps, "dt": dt, "every": every,
                                      "settle": min(10000, steps // 4)}
                    for kappa, (steps, dt, every) in runs.items()},
                 "structure": {**STRUCTURE, "steps": structure_steps}})
    calm = {}
    for kappa, (_, dt, every) in runs.items():
        name = f"kappa{kappa}"
        lengths, _ = box()
        needed = []
        for number in waves:
            m, n = WAVES[number]
            for along in (1, 0):
                rate = theory(2 * np.pi * np.hypot(m / lengths[0], n / lengths[1]), kappa)[along]
                needed.append(every * (int(2.0 / rate / dt / every) + 2))
                calm[f"{name}.{number}.{along}"] = {"m": m, "n": n, "along": along, "steps": needed[-1]}
        calm[f"{name}.rest"] = {"steps": max(needed)}
        for job in calm:
            if job.startswith(name + "."):
                calm[job].update({"start": name, "T": 0, "kappa": kappa, "dt": dt, "every": every})
    example.run(calm)


def main():
    example = Example(HERE, "Sound and shear in thermal fluctuations.")
    args = example.arguments()
    runs = QUICK if args.quick else RUNS
    width = 4 if args.quick else 3      # a small version must not fail by chance
    waves = (4, 5) if args.quick else range(len(WAVES))
    jobs(example, runs, waves, STRUCTURE_QUICK if args.quick else STRUCTURE_STEPS)
    results = {kappa: fluid(example, kappa, *runs[kappa], waves) for kappa in runs}
    for kappa, found in results.items():
        for along, what in ((0, "shear"), (1, "sound")):
            mine = [r for r in found if r["along"] == along]
            for r in mine:
                print(f"kappa/mu = {kappa}, {what}, wave {r['wave']}: rate {r['rate']:.5f}, without noise "
                      f"{r['alone']:.5f}, theory {r['theory']:.5f}; power over N kT/m {r['power'] / T:.3f}")
            ratio, error = mean_ratio(mine)
            bar = max(0.03, width * error)
            example.merit(f"kappa/mu = {kappa}: decay of {what} in correlations over that without noise "
                          f"(standard error {error:.3f})", ratio, 1 - bar, 1 + bar)
    for kappa in runs:
        lengths, particles = box()
        ratios = over_theory(series(example.out / f"kappa{kappa}.series.txt", lengths), particles, SUPPORT, T)
        print(f"kappa/mu = {kappa}: S(k) over theory {ratios.mean():.3f}")
    lengths, particles = box(STRUCTURE["nx"], STRUCTURE["ny"])
    ratios = over_theory(series(example.out / "structure.series.txt", lengths), particles, STRUCTURE["support"],
                         STRUCTURE["T"])
    means = ratios.mean(axis=0)
    error = np.std(means) / np.sqrt(PIECES - 1)
    bar = max(0.03, width * error)
    print("many neighbours: S(k) over theory by wave", " ".join(f"{r:.3f}" for r in ratios.mean(axis=1)))
    example.merit(f"many neighbours: S(k) over theory, mean over waves (standard error {error:.3f})", means.mean(),
                  1 - bar, 1 + bar)
    table = example.out / "rates.csv"
    np.savetxt(table, [[kappa, *r["wave"], r["along"], r["rate"], np.sqrt((PIECES - 1) * np.var(r["others"])),
                        r["alone"], r["theory"]] for kappa, found in results.items() for r in found],
               fmt="%.5g", delimiter=",", comments="",
               header="kappa_over_mu,m,n,longitudinal,rate,standard_error,rate_without_noise,rate_theory")
    picture = example.out / "sound_spectrum.png"
    plot(picture, results)
    return example.finish(table, picture)


if __name__ == "__main__":
    sys.exit(main())
