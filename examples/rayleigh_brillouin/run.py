#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Light that an ideal gas scatters: Rayleigh and Brillouin lines in the thermal fluctuations of its density, against the exact spectrum of a line of particles.

    ./sphd run rayleigh_brillouin     or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import csv
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, pyplot, save      # noqa: E402

MU, T, PARTICLES, SUPPORT = 0.3, 1e-4, 256, 4.0     # as in the input; density, particle spacing, and isothermal speed of sound are 1
WAVES = np.arange(6, 25)            # waves in the box, in the order of the columns
BANDS = ((6, 11), (12, 17), (18, 24))
PICTURE = 10                        # wave of the spectra in the figure
D = 0.45                            # diffusivity of heat, Prandtl number 2/3
INTERVAL = 0.8                      # time between two rows
QUICK = 40000
# gamma, kappa/mu, diffusivity over D: time step, which keeps the largest rates of friction and of conduction times it below 0.1; steps
CASES = {(5 / 3, 1, 1): (0.05, 1600000), (5 / 3, 0, 1): (0.05, 1600000), (5 / 3, 10, 1): (0.04, 3200000), (5 / 3, 1, 2): (0.025, 2400000),
         (1.4, 1, 1): (0.05, 1600000), (1.4, 0, 1): (0.05, 1600000), (1.4, 10, 1): (0.04, 4800000)}
PIECES = 10                         # of a series, for its statistical error
WITHIN = 0.03
NAMES = ("structure", "share", "rayleigh", "brillouin", "frequency")
TITLES = ("structure factor S(k)", "share of the Rayleigh line", "width of the Rayleigh line", "width of the Brillouin lines",
          "frequency of the Brillouin lines")


def lattice_sums(k):
    """What stands for k^2 in a wave of a line of particles, from sums over one neighborhood: of the divergence, of the second derivative
    of the kernel, of friction along the line and of conduction; and the density over that of the input."""
    x = np.arange(-SUPPORT, SUPPORT + 1)
    x = x[abs(x) < SUPPORT]
    q = abs(x) / SUPPORT
    kernel = 1.5 / SUPPORT * (1 - q)**4 * (1 + 4 * q)      # wendland/c2
    slope = 30 / SUPPORT**3 * (1 - q)**3                   # -W'/r
    second = slope * (4 * q - 1) / (1 - q)                 # W''
    volume = 1 / kernel.sum()
    rest = 1 - np.cos(k * x)
    return (volume * (slope * x * np.sin(k * x)).sum())**2, volume * (second * rest).sum(), 2 * volume * (slope * rest).sum(), 1 / volume


def relaxation(k, gamma, kappa, diffusivity):
    """d/dt of displacement, velocity and temperature of a wave of small amplitude, and the mean square of its displacement over k_B T/m.

    The equations are linear in small waves on the lattice, for pressure, friction, and conduction as on the theory page.
    """
    square, curvature, laplace, rho = lattice_sums(k)
    q = np.sqrt(square)
    friction = (4 / 3 * MU * laplace + kappa * square) / rho
    stiffness = square + 2 * (curvature - square)          # that of constant temperature, c_T = 1; the pressure is rho c_T^2
    # temperatures in units of T: c_v = 1/(T (gamma - 1))
    matrix = np.array([[0, 1, 0],
                       [-stiffness, -friction, -1j * q],
                       [0, -1j * q * (gamma - 1), -gamma * diffusivity * laplace / rho]])
    return matrix, 1 / stiffness


def step_matrix(dt, *wave):
    """What a time step does with displacement, and velocity and temperature half a step before: friction and work are those of the velocity
    before the kick, the pressure is that of the temperature after the work.  And the mean of their products with the displacement."""
    rates = relaxation(*wave)[0]
    temperature = np.array([0, dt * rates[2, 1], 1])
    velocity = np.array([dt * rates[1, 0], 1 + dt * rates[1, 1], 0]) + dt * rates[1, 2] * temperature
    heated = temperature + dt * rates[2, 2] * temperature
    return np.array([np.array([1, 0, 0]) + dt * velocity, velocity, heated]), np.array([1, -0.5 * dt * rates[1, 0], 0])


def lines(dt, *wave):
    """Exact lines of the density of a wave: share of the Rayleigh line in all, its half width, half width and frequency of the Brillouin lines."""
    matrix, start = step_matrix(dt, *wave)
    values, vectors = np.linalg.eig(matrix)
    rates, weights = np.log(values) / dt, vectors[0] * np.linalg.solve(vectors, start)
    still, sound = np.argmin(abs(rates.imag)), np.argmax(rates.imag)
    assert abs(rates[still].imag) < 1e-9 < rates[sound].imag
    return np.array([weights[still].real, -rates[still].real, -rates[sound].real, rates[sound].imag])


def modes(share, rayleigh, brillouin, frequency):
    """Weights and rates of the three modes whose sum is the correlation of the density: 1 at time 0, where its slope is 0."""
    slope = (share * rayleigh + (1 - share) * brillouin) / frequency
    sound = 0.5 * (1 - share - 1j * slope)
    return np.array([share, sound, sound.conjugate()]), np.array([-rayleigh, -brillouin + 1j * frequency, -brillouin - 1j * frequency])


def correlation(time, shape):
    weights, rates = modes(*shape)
    return (weights @ np.exp(np.outer(rates, time))).real


def spectrum(omega, shape, count):
    """Mean power in these frequencies of a series of count values, in steps of INTERVAL, with this correlation."""
    weights, rates = modes(*shape)
    found = np.full(len(omega), weights.sum().real)
    for turn in (1j, -1j):
        w = np.exp(rates[:, None] * INTERVAL + turn * omega * INTERVAL)
        found += (weights @ (w / (1 - w) - w * (1 - w**count) / (count * (1 - w)**2))).real     # sum of (1 - n/count) w^n
    return INTERVAL * found


class Case:
    def __init__(self, gamma, kappa, heat, dt, steps):
        self.gamma, self.kappa, self.heat, self.dt = gamma, kappa, heat, dt
        self.name = f"gamma{gamma:.2f}.kappa{kappa}.heat{heat}"
        self.gas = gamma, kappa * MU, heat * D
        every = round(INTERVAL / dt)
        self.variables = {"gamma": gamma, "mu": MU, "kappa": kappa * MU, "diffusivity": heat * D, "dt": dt, "every": every,
                          "steps": steps, "settle": round(500 / dt)}
        self.k = 2 * np.pi * WAVES / PARTICLES
        self.exact = np.array([lines(dt, k, *self.gas) for k in self.k])
        self.limit = np.array([lines(1e-3, k, *self.gas) for k in self.k])      # of short time steps
        self.label = f"$\\gamma$ = {'5/3' if gamma > 1.5 else gamma}, $\\kappa/\\mu$ = {kappa}"

    def read(self, out):
        data = np.loadtxt(out / f"{self.name}.series.txt")[:, 1:]
        waves = (data[:, ::2] + 1j * data[:, 1::2]).T / np.sqrt(PARTICLES)
        count = waves.shape[1] // PIECES
        self.pieces = waves[:, :PIECES * count].reshape(len(WAVES), PIECES, count)
        scale = np.array([relaxation(k, *self.gas)[1] * k**2 * T for k in self.k])      # exact S(k)
        self.pieces = self.pieces / np.sqrt(scale)[:, None, None]
        power = abs(np.fft.fft(self.pieces))**2 * INTERVAL / count
        omega = 2 * np.pi * np.fft.fftfreq(count, INTERVAL)
        # both signs of the frequency are independent; bins are short compared to the width of any line
        self.power = 0.5 * (power + np.roll(power[..., ::-1], 1, axis=-1))[..., 1:count // 2]
        self.omega = omega[1:count // 2]

    def binned(self, number):
        """Frequencies and mean power in bins, by piece, up to beyond the Brillouin line; and how many independent numbers a bin of a piece has."""
        _, rayleigh, brillouin, frequency = self.exact[number]
        size = max(1, int(0.1 * min(rayleigh, brillouin) / self.omega[0]))
        count = int((1.2 * frequency + 3 * brillouin) / self.omega[0]) // size
        count = min(count, len(self.omega) // size)
        mean = lambda a: a[..., :count * size].reshape(*a.shape[:-1], count, size).mean(axis=-1)
        return mean(self.omega), mean(self.power[number]), 2 * size

    def model(self, omega, number, factors):
        structure, ratio, *others = factors
        share, *rest = self.exact[number]
        ratio *= share / (1 - share)            # I_R/2I_B
        return structure * spectrum(omega, (ratio / (1 + ratio), *np.multiply(others, rest)), self.pieces.shape[2])

    def fit(self, waves):
        """Factors of the exact lines that make the spectra of these waves most likely, and the standard error of each, from the pieces.

        The power in each frequency has an exponential distribution (P. Whittle); the maximum is found by the method of scoring.
        """
        rows = [(number, *self.binned(number)) for number in np.flatnonzero(np.isin(WAVES, waves))]
        logs, step = np.zeros(len(NAMES)), 1e-4
        for _ in range(30):
            score, information = np.zeros((PIECES, len(logs))), 0
            for number, omega, power, size in rows:
                model = self.model(omega, number, np.exp(logs))
                slope = np.array([np.log(self.model(omega, number, np.exp(logs + one)) / model) for one in step * np.eye(len(logs))]) / step
                score += size * (power / model - 1) @ slope.T
                information += PIECES * size * slope @ slope.T
            change = np.linalg.solve(information, score.T)
            logs = logs + change.sum(axis=1)
            if abs(change.sum(axis=1)).max() < 1e-6:
                break
        return np.exp(logs), np.sqrt(PIECES / (PIECES - 1) * (change**2).sum(axis=1))

    def correlations(self, count):
        """Correlation of the density over its exact value at time 0, of all waves, by piece, for the first `count` lags."""
        n = self.pieces.shape[2]
        f = np.fft.fft(self.pieces, 2 * n)
        return np.fft.ifft(f * f.conj()).real[..., :count] / np.arange(n, n - count, -1)


def plot(path, cases):
    plt = pyplot()
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.3))
    shown = [case for case in cases if case.gamma > 1.5 and case.heat == 1], [case for case in cases if case.kappa == 1]
    for axis, group in zip(axes, shown):
        for color, case in zip(("C0", "C1", "C2"), sorted(group, key=lambda case: (case.kappa, -case.gamma, case.heat))):
            numbers = [np.flatnonzero(WAVES == wave)[0] for wave in (PICTURE,)]
            size = 12
            count = int(0.6 / case.omega[0]) // size * size
            omega = case.omega[:count]
            bins = lambda y: y[:count].reshape(-1, size).mean(axis=1)
            power = np.mean([case.power[n].mean(axis=0) for n in numbers], axis=0)
            exact = np.mean([spectrum(omega, case.exact[n], case.pieces.shape[2]) for n in numbers], axis=0)
            label = f"$\\kappa/\\mu$ = {case.kappa}" if axis is axes[0] else \
                f"$\\gamma$ = {'5/3' if case.gamma > 1.5 else case.gamma}" + (f", conductivity x {case.heat}" if case.heat > 1 else "")
            axis.semilogy(bins(omega), bins(power), color + ".", ms=3)
            axis.semilogy(omega, exact, color, lw=1.2, label=label)
        axis.set(xlim=(0, 0.6), xlabel="frequency $\\omega$ (lj units)", ylabel="dynamic structure factor $S(k,\\omega)/S(k)$")
        axis.set_title("points: fluctuations, lines: exact")
        axis.legend()
    for color, case in zip(("C0", "C1", "C2"), sorted(shown[0], key=lambda case: case.kappa)):
        for column, mark, line in ((1, "s", "--"), (2, "o", "-")):
            axes[2].plot(case.k**2, case.exact[:, column], color + line, lw=1)
            for band, (factors, errors) in case.bands.items():
                k = 2 * np.pi * np.mean(band) / PARTICLES
                exact = np.interp(k, case.k, case.exact[:, column]) * factors[1 + column]
                axes[2].errorbar(k**2, exact, errors[1 + column] * exact, color=color, marker=mark, ms=4, mfc="none", lw=0,
                                 elinewidth=1, label=f"$\\kappa/\\mu$ = {case.kappa}" if column == 2 and band == BANDS[0] else None)
    axes[2].set(xlim=(0, None), ylim=(0, None), xlabel="$k^2$ (lj units)", ylabel="half width of a line (lj units)")
    axes[2].set_title("squares: Rayleigh, circles: Brillouin")
    axes[2].legend()
    return save(figure, path)


def main():
    example = Example(HERE, "Rayleigh and Brillouin lines of an ideal gas.")
    args = example.arguments()
    chance = 4 if args.quick else 3      # a small version must not fail by chance
    cases = [Case(*key, dt, QUICK if args.quick else steps) for key, (dt, steps) in CASES.items()][:1 if args.quick else None]
    example.run({case.name: case.variables for case in sorted(cases, key=lambda case: -case.variables["steps"])})
    table = example.out / "lines.csv"
    with open(table, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["gamma", "kappa_over_mu", "diffusivity", "waves_from", "waves_to", "k",
                         *(f"{name}{what}" for name in NAMES for what in ("_over_exact", "_error"))])
        for case in cases:
            case.read(example.out)
            case.bands = {band: case.fit(range(band[0], band[1] + 1)) for band in (*BANDS, (WAVES[0], WAVES[-1]))}
            for band, (factors, errors) in case.bands.items():
                writer.writerow([f"{case.gamma:.4f}", case.kappa, case.heat * D, *band, f"{2 * np.pi * np.mean(band) / PARTICLES:.4f}",
                                 *(f"{x:.4f}" for pair in zip(factors, errors) for x in pair)])
            factors, errors = case.bands.pop((WAVES[0], WAVES[-1]))
            share, *rest = case.limit[PICTURE - WAVES[0]]
            print(f"\ngamma {case.gamma:.4f}, kappa/mu {case.kappa}, diffusivity {case.heat * D:g}: exact at k = {case.k[PICTURE - WAVES[0]]:.4f}: "
                  f"I_R/2I_B {share / (1 - share):.4f} (gamma - 1 = {case.gamma - 1:.4f}), "
                  "half widths {:.5f} and {:.5f}, frequency {:.5f}".format(*rest))
            example.merit("largest part of the time step in a width", (case.exact / case.limit)[:, 1:3].max() - 1, 0, WITHIN)
            for title, factor, error in zip(TITLES, factors, errors):
                bar = max(WITHIN, chance * error)
                example.merit(f"{title} over the exact one (standard error {error:.4f})", factor, 1 - bar, 1 + bar)
            lags = np.unique(np.geomspace(1, 1.5 / case.exact[0, 1] / INTERVAL, 40).astype(int))
            every = case.correlations(lags[-1] + 1)[..., np.append(0, lags)]
            exact = np.array([correlation(np.append(0, lags) * INTERVAL, shape) for shape in case.exact])
            off, noise = every.mean(axis=1) - exact, every.std(axis=1, ddof=1) / np.sqrt(PIECES)
            example.merit("correlation in time: root mean square difference from the matrix exponential over the standard error",
                          np.sqrt((off**2).mean() / (noise**2).mean()), 0, 2 if args.quick else 1.5)
    if args.quick:
        return example.finish(table)
    return example.finish(table, plot(example.out / "rayleigh_brillouin.png", cases))


if __name__ == "__main__":
    sys.exit(main())
