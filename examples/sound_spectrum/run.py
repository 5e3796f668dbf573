#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Sound and shear in the thermal fluctuations of a fluid, for three bulk viscosities at the same shear viscosity.

    ./sphd run sound_spectrum          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example      # noqa: E402

MU, C0, T, SUPPORT = 0.5, 3.0, 0.02, 3.5
KAPPAS = (0, 1, 10)    # over mu
STEPS, QUICK = 500000, 40000
EVERY = 10             # steps between two rows of the series


def series(path):
    """Fluctuating amplitudes of the first two waves: density, longitudinal and transverse velocity; time between rows."""
    data = np.loadtxt(path)
    waves = []
    for first in (1, 7):
        columns = data[:, first:first + 6]
        waves.append([columns[:, 2 * k] + 1j * columns[:, 2 * k + 1] for k in range(3)])
    return waves, data[1, 0] - data[0, 0]


def correlation(z, count):
    """<z(t) z*(0)> for the first `count` lags."""
    n = len(z)
    f = np.fft.fft(z - z.mean(), 2 * n)
    return np.fft.ifft(f * f.conj()).real[:count] / np.arange(n, n - count, -1)


def longitudinal(time, gamma, omega):
    """C(t)/C(0) of a damped wave: exp(-g t) [cos w t - (g/w) sin w t]."""
    return np.exp(-gamma * time) * (np.cos(omega * time) - gamma / omega * np.sin(omega * time))


def fit(function, time, values, guess):
    return least_squares(lambda p: function(time, *p) - values, guess, x_scale=np.abs(guess)).x


def theory(k, kappa):
    """Rates of shear and sound of this fluid at wave number k: continuum, finite wavelength (theory page)."""
    kh2 = (0.5 * k * SUPPORT)**2
    longitudinal_mg = 3 * MU * (1 - 0.077 * kh2)
    bulk = (kappa * MU - 2 * MU) * (1 - 0.28 * kh2)
    shear = MU * (1 - 0.046 * kh2)
    return shear * k**2, 0.5 * (longitudinal_mg + bulk) * k**2


def spectrum(z, dt, parts):
    """Power of z by frequency, mean over pieces of the series."""
    n = len(z) // parts
    pieces = z[:parts * n].reshape(parts, n)
    pieces = (pieces - z.mean()) * np.hanning(n)
    power = np.mean(np.abs(np.fft.fft(pieces))**2, axis=0) * dt / np.sum(np.hanning(n)**2)
    omega = 2 * np.pi * np.fft.fftfreq(n, dt)
    keep = omega > 0
    return omega[keep], 0.5 * (power[keep] + power[::-1][keep])


def plot(path, results):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update({"font.size": 9, "legend.fontsize": 8})
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(11.5, 3.4), layout="constrained")
    for index, (kappa, r) in enumerate(results.items()):
        color = f"C{index}"
        omega, power = r["spectrum"]
        rate_shear, gamma = theory(r["k"], kappa)
        w2 = r["omega"]**2 + r["gamma"]**2
        peak = 4 * gamma * w2 / ((omega**2 - w2)**2 + 4 * gamma**2 * omega**2)
        left.semilogy(omega, power / r["S"], color + ".", ms=3, alpha=0.5)
        left.semilogy(omega, peak, color, lw=1.2, label=f"$\\kappa/\\mu$ = {kappa}")
        time, transverse, along = r["time"], r["transverse"], r["along"]
        middle.plot(time, along, color + ".", ms=2)
        middle.plot(time, longitudinal(time, gamma, r["omega"]), color, lw=0.9)
        right.semilogy(time, np.clip(transverse, 1e-3, None), color + ".", ms=3, label=f"$\\kappa/\\mu$ = {kappa}")
    right.semilogy(time, np.exp(-rate_shear * time), "k", lw=0.9, label="$\\exp(-\\nu k^2t)$")
    left.set(xlim=(0, 1.6), ylim=(3e-2, 2e3), xlabel="$\\omega$", title="dynamic structure factor $S(k,\\omega)/S(k)$")
    middle.set(xlabel="$t$", title="longitudinal current", xlim=(0, 60))
    right.set(xlabel="$t$", title="transverse current", ylim=(2e-2, 1.2), xlim=(0, 70))
    for axes in (left, middle, right):
        axes.grid(alpha=0.3)
    left.legend()
    right.legend()
    figure.savefig(path, dpi=90)
    plt.close(figure)


def analyse(path, kappa, dt, length):
    waves, stride = series(path)
    found = {}
    for number, (density, vx, vy) in enumerate(waves, 1):
        k, step = 2 * np.pi * number / length, stride * dt
        shear, gamma = theory(k, kappa)
        count = int(1.2 / shear / step)
        time = step * np.arange(count)
        transverse, along = correlation(vy, count), correlation(vx, count)
        decay, = fit(lambda t, g: np.exp(-g * t), time, transverse / transverse[0], [shear])
        short = time < 2.0 / gamma
        gamma_fit, omega = fit(longitudinal, time[short], along[short] / along[0], [gamma, C0 * k])
        found[number] = {"k": k, "shear": decay, "gamma": gamma_fit, "omega": omega, "theory": (shear, gamma),
                         "transverse": transverse / transverse[0], "along": along / along[0], "time": time,
                         "power": (transverse[0], along[0]), "S": np.var(density),
                         "spectrum": spectrum(density, step, 60)}
    return found


def main():
    example = Example(HERE, "Sound and shear in thermal fluctuations.")
    args = example.arguments()
    steps = QUICK if args.quick else STEPS
    kappas = (1,) if args.quick else KAPPAS
    dt, nx, ny = 0.05, 24, 7
    a = np.sqrt(2 / np.sqrt(3))
    length, particles = nx * a, 2 * nx * ny
    example.run({f"kappa{kappa}": {"kappa": kappa, "steps": steps} for kappa in kappas})
    results = {}
    for kappa in kappas:
        found = analyse(example.out / f"kappa{kappa}.series.txt", kappa, dt, length)
        results[kappa] = found[1]
        for number, r in found.items():
            name = f"kappa/mu = {kappa}, wave {number}: "
            # relative error of a rate from a series of that many decay times, real and imaginary part
            samples = [2 * steps * dt * rate for rate in r["theory"]]
            bar = max(0.03, 3 * np.sqrt(2 / samples[0]))
            print(f"{name}shear rate {r['shear']:.5f}, theory {r['theory'][0]:.5f}; sound damping {r['gamma']:.5f}, "
                  f"theory {r['theory'][1]:.5f}; frequency over c0 k {r['omega'] / C0 / r['k']:.4f}")
            example.merit(name + "rate of shear over theory, minus 1", abs(r["shear"] / r["theory"][0] - 1), 0, bar)
            for what, power, n in zip(("transverse", "longitudinal"), r["power"], samples):
                example.merit(f"{name}power of the {what} current over N kT/m, minus 1",
                              abs(power / (particles * T) - 1), 0, 3 * np.sqrt(2 / n))
    picture = example.out / "sound_spectrum.png"
    plot(picture, results)
    return example.finish(picture)


if __name__ == "__main__":
    sys.exit(main())
