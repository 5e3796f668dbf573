#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Sound in carbon dioxide and in air, whose bulk viscosities relax, against theory and ISO 9613-1, and a pulse that disperses.

    ./sphd run real_gas_sound       or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, exponents, fluids, frames, pyplot, save      # noqa: E402

CO2, CO2_PER_DECADE = (1e3, 1e6), (10, 4)         # [Hz]; waves in a factor of ten: all, quick
CONSTANT, CONSTANT_PER_DECADE = (1e3, 1e5), (4, 2)    # with all of kappa at once
AIR, AIR_PER_DECADE = (1e2, 1e4), (4, 1)
PARTICLES, SUPPORT = 128, 5                       # in a wave, as in the input
HUMIDITIES = (0, 10, 50)                          # percent, at 20 C and 101325 Pa
# dimensions of a pulse, length of its box [m], particles or cells along it, end over tau: all, quick. The lattice under the
# pressure pb falls apart soon after
PULSES = ((1, 48e-3, 1920, 150), (3, 12e-3, 190, 25)), ((1, 48e-3, 960, 150), (3, 8e-3, 127, 15))
WIDTH, EVERY = 0.4e-3, 5                          # [m]; frames, over tau
FRONT_TIMES, BODY_TIMES, SHOWN = (5, 40), (100, 150), (0, 10, 25, 60, 150)     # over tau
PEAK_PLACE, PEAK_HEIGHT, SPEED, DECIBEL, LINE = 0.02, 0.03, 0.005, 0.03, 0.002
PROFILE = 0.12 / (50e-6)**2                       # difference of a pulse, over the square of the spacing [1/m^2]
COLORS, MARKS = ("C0", "C3", "C2", "C4", "k"), "osD^v"


def iso_9613(frequency, humidity):
    """dB/km at 20 C and 101325 Pa: ISO 9613-1:1993; H. E. Bass et al., J. Acoust. Soc. Am. 97, 680 (1995)."""
    t = 293.15
    vapour = humidity * 10**(-6.8346 * (273.16 / t)**1.261 + 4.6151)    # molar percentage
    oxygen = 24 + 4.04e4 * vapour * (0.02 + vapour) / (0.391 + vapour)
    nitrogen = 9 + 280 * vapour
    return 8686 * frequency**2 * (1.84e-11 + 0.01275 * np.exp(-2239.1 / t) / (oxygen + frequency**2 / oxygen)
                                  + 0.1068 * np.exp(-3352 / t) / (nitrogen + frequency**2 / nitrogen))


def coefficients(gas, line=True):
    """Variables of the input. On a line the bulk term has the shear viscosity, too; conduction of heat, which this
    input leaves out, comes as the longitudinal viscosity that damps sound as much."""
    kappa = gas.kappa + gas.conduction + (4 / 3 * gas.mu if line else 0.0)
    processes = " ".join(["relax", *(f"{number:.6g}" for process in gas.relax for number in process)])
    return {"rho": f"{gas.rho:.8g}", "c": f"{gas.c:.8g}", "mu": 0 if line else gas.mu, "kappa": f"{kappa:.6g}",
            "processes": processes if gas.relax else "", "cfast": f"{fast(gas):.6g}"}


def fast(gas):
    """Speed of sound above all relaxation."""
    return np.sqrt(gas.c**2 + sum(kappa / (gas.rho * tau) for kappa, tau in gas.relax))


class Standing:
    """A standing wave: exp(s t) at the real wave number k."""

    def __init__(self, name, gas, frequency):
        self.name, self.processes = f"{name}.{frequency:.0f}", len(gas.relax)
        wavelength = gas.c / frequency
        self.k = 2 * np.pi / wavelength
        self.variables = {"wavelength": f"{wavelength:.10g}", **coefficients(gas)}

    def measure(self, out):
        """Two modes are of sound, one of each process."""
        time, y = np.loadtxt(out / f"{self.name}.wave.txt", usecols=(1, 2)).T
        self.s = min(exponents(time[1], y, 2 + self.processes), key=lambda s: abs(s - 1j * self.k * float(self.variables["c"])))
        self.frequency = self.s.imag / (2 * np.pi)


def driven(waves):
    """Frequency, speed and absorption per wavelength [Np] of the wave that a source drives, from standing waves.

    ln s of a sound wave is an analytic function of ln k. Standing waves have it at real k. The cubic spline through them, continued
    to complex k by its Taylor series, has the k for which s is imaginary, by Newton's method."""
    x, z = np.log([wave.k for wave in waves]), np.log([wave.s for wave in waves])
    spline = CubicSpline(x, z)
    first, second, third = (spline(x, n) for n in (1, 2, 3))
    step = np.zeros(len(x), complex)
    for _ in range(6):
        value = z + step * (first + step * (second / 2 + step * third / 6))
        step += (z.real + 0.5j * np.pi - value) / (first + step * (second + step * third / 2))
    k, omega = np.exp(x + step), np.exp(z.real)
    return omega / (2 * np.pi), omega / k.real, 2 * np.pi * np.abs(k.imag) / k.real


def theory(gas, frequency):
    """Speed and absorption per wavelength [Np] of driven waves in the continuum: L. D. Landau, E. M. Lifshitz, Fluid Mechanics,
    section 81, with shear viscosity and conduction of heat."""
    k = np.array([gas.wave_number(f, gas.conduction) for f in frequency])
    return 2 * np.pi * np.asarray(frequency) / k.real, 2 * np.pi * k.imag / k.real


def line_factor():
    """What is left of a bulk viscosity on a line of particles: (q/k)^2, q the wave number that the sums see, of wendland/c2."""
    s, k = np.arange(1, SUPPORT), 2 * np.pi / PARTICLES
    density = 1 + 2 * ((1 - s / SUPPORT)**4 * (1 + 4 * s / SUPPORT)).sum()
    return (2 * (20 / SUPPORT**2 * (1 - s / SUPPORT)**3 * s * np.sin(k * s)).sum() / density / k)**2


def peak(frequency, absorption):
    """Place and height of the largest absorption, on a spline."""
    spline = CubicSpline(np.log(frequency), np.log(absorption))
    top = spline.derivative().roots(extrapolate=False)
    top = top[np.argmax(spline(top))]
    return np.exp(top), np.exp(spline(top))


class Pulse:
    def __init__(self, gas, dim, length, n, end):
        self.name, self.gas, self.dim, self.length, self.end = f"pulse_{dim}d", gas, dim, length, end
        self.tau, self.spacing = gas.relax[0][1], length / n / (1 if dim == 1 else 2**(1 / 3))
        self.variables = {"wave": "pulse", "dim": dim, "wavelength": length, "n": n, "width": WIDTH, "part": 1,
                          "time": end * self.tau, "interval": EVERY * self.tau, **coefficients(gas, dim == 1)}

    def exact(self, x, time):
        """Velocity over its first maximum at places x: small sound of the continuum, each wave of the box by itself.

        of density s, velocity v and strain e: s' = -v_x, v' = -c0^2 s_x - g e_x + nu v_xx, e' = -v_x - e/tau."""
        gas, cells = self.gas, 8192
        grid = np.arange(cells) * self.length / cells
        k = 2 * np.pi * np.fft.fftfreq(cells, self.length / cells)
        kappa, tau = gas.relax[0]
        rates = np.zeros((cells, 3, 3), complex)
        rates[:, 0, 1] = rates[:, 2, 1] = -1j * k
        rates[:, 1, 0] = -1j * k * gas.c**2
        rates[:, 1, 1] = -(4 / 3 * gas.mu + gas.kappa + gas.conduction) / gas.rho * k**2
        rates[:, 1, 2] = -1j * k * kappa / (gas.rho * tau)
        rates[:, 2, 2] = -1 / tau
        values, modes = np.linalg.eig(rates)
        first = np.fft.fft(np.exp(-0.5 * ((grid - self.length / 2) / WIDTH)**2))[:, None] * np.array([1, fast(gas), 1])
        parts = np.linalg.solve(modes, first[..., None])[..., 0] * np.exp(values * time)
        v = np.fft.ifft(np.einsum("kj,kj->k", modes[:, 1], parts)).real / fast(gas)
        return np.interp(x, grid, v, period=self.length)

    def measure(self, out):
        """Frames by time over tau: distances ahead of a wave with c_0, velocity; the front and the top of the body."""
        self.frames, self.worst, front, body = {}, 0.0, [], []
        for number, frame in enumerate(frames(out / f"{self.name}.dump").values()):
            over_tau = number * EVERY
            time = over_tau * self.tau
            x, v = self.rows(frame["x"], frame["v_relative"])
            self.worst = max(self.worst, np.sqrt(np.mean((v - self.exact(x, time))**2) / np.mean(self.exact(x, time)**2)))
            place = (x - self.gas.c * time) % self.length - self.length / 2
            order = np.argsort(place)
            place, v = place[order], v[order]
            self.frames[over_tau] = place, v
            if FRONT_TIMES[0] <= over_tau <= FRONT_TIMES[1]:
                front.append((time, extremum(place, -np.gradient(v, place), round(0.15e-3 / (place[1] - place[0])))))
            if BODY_TIMES[0] <= over_tau <= BODY_TIMES[1]:
                body.append((time, extremum(place, v, round(2e-3 / self.spacing))))
        self.front = (self.gas.c + np.polyfit(*np.transpose(front), 1)[0]) / fast(self.gas)
        self.body = 1 + np.polyfit(*np.transpose(body), 1)[0] / self.gas.c if body else None

    def rows(self, x, v):
        """Mean of the particles of the same x."""
        spacing = self.length / self.variables["n"] / (2 if self.dim == 3 else 1)
        place = np.round(x / spacing - 0.5).astype(int)
        count = np.bincount(place)
        return np.bincount(place, x) / count, np.bincount(place, v) / count


def extremum(x, y, reach):
    """Place of the largest y, by a parabola through this many values on both sides."""
    top = np.argmax(y)
    some = slice(top - reach, top + reach + 1)
    square, linear, _ = np.polyfit(x[some] - x[top], y[some], 2)
    return x[top] - linear / (2 * square)


def plain(axis):
    """1000 for 10^3"""
    axis.set_major_formatter("{x:g}")


def plot_co2(path, gas, relaxing, constant):
    plt = pyplot()
    figure, axes = plt.subplots(1, 2, figsize=(9.2, 3.8))
    f = np.geomspace(CO2[0] / 1.3, CO2[1] * 1.3, 300)
    for axis, column in zip(axes, (0, 1)):
        low = f[f < 2 * CONSTANT[1]]
        axis.plot(f / 1e3, theory(gas, f)[column], "k-", lw=0.9, label="theory, relaxing")
        axis.plot(low / 1e3, theory(gas.constant(), low)[column], "--", color=COLORS[1], lw=0.9, label="theory, constant $\\kappa$")
        axis.plot(relaxing[0] / 1e3, relaxing[column + 1], "o", color=COLORS[0], mfc="none", ms=5, label="SPH, relaxing")
        axis.plot(constant[0] / 1e3, constant[column + 1], "s", color=COLORS[1], mfc="none", ms=5, label="SPH, constant $\\kappa$")
        axis.set_xscale("log")
        plain(axis.xaxis)
        axis.set_xlabel("frequency [kHz]")
    axes[0].set_ylabel("speed of sound [m/s]")
    axes[0].set_ylim(268, 284)
    axes[1].set_yscale("log")
    axes[1].set_ylabel("absorption per wavelength [Np]")
    return save(figure, path, legends=axes)


def plot_air(path, measured):
    plt = pyplot()
    figure, axis = plt.subplots(figsize=(5.6, 4.2))
    f = np.geomspace(AIR[0] / 1.2, AIR[1] * 1.2, 200)
    for color, mark, (humidity, (frequency, decibel)) in zip(COLORS, MARKS, measured.items()):
        axis.loglog(f / 1e3, iso_9613(f, humidity), "-", color=color, lw=0.9)
        axis.loglog(frequency / 1e3, decibel, mark, color=color, mfc="none", ms=5, label=f"{humidity} %")
    plain(axis.xaxis)
    plain(axis.yaxis)
    axis.set_xlabel("frequency [kHz]")
    axis.set_ylabel("absorption [dB/km]")
    axis.legend(title="relative humidity\nmarks: SPH, lines: ISO 9613-1", alignment="left")
    return save(figure, path)


def plot_pulses(path, pulses):
    plt = pyplot()
    figure, axes = plt.subplots(1, 2, figsize=(9.2, 3.8), gridspec_kw={"width_ratios": (2, 1)})
    for axis, pulse in zip(axes, pulses):
        for color, mark, over_tau in zip(COLORS, MARKS, SHOWN):
            if over_tau not in pulse.frames:
                continue
            time = over_tau * pulse.tau
            place, v = pulse.frames[over_tau]
            fine = np.linspace(place[0], place[-1], 2000)
            axis.plot(fine * 1e3, pulse.exact(fine + pulse.length / 2 + pulse.gas.c * time, time), "-", color=color, lw=0.9)
            some = slice(None, None, max(1, round((0.2e-3 if pulse.dim == 1 else 0.1e-3) / (place[1] - place[0]))))
            axis.plot(place[some] * 1e3, v[some], mark, color=color, mfc="none", ms=3.5, label=f"{over_tau} $\\tau$")
            axis.plot([(fast(pulse.gas) - pulse.gas.c) * time * 1e3], [-0.04], "^", color=color, ms=5)
        axis.set_title("on a line" if pulse.dim == 1 else "in three dimensions")
        axis.set_ylim(-0.08, 1.05)
        axis.set_xlabel("distance ahead of a wave with $c_0$ [mm]")
    axes[0].set_xlim(-11, 11)
    axes[1].set_xlim(-2.5, 2.5)
    axes[0].set_ylabel("velocity over its first maximum")
    axes[0].legend(title="time; marks: SPH, lines: continuum,\ntriangles: moved with $c_\\infty$",
                   alignment="left")
    return save(figure, path)


def main():
    example = Example(HERE, "Sound in gases whose bulk viscosity relaxes.")
    args = example.arguments()
    gas = fluids.find("CO2")

    def waves(name, gas, between, per_decade):
        count = round(np.log10(between[1] / between[0]) * per_decade[args.quick]) + 1
        return [Standing(name, gas, frequency) for frequency in np.geomspace(*between, count)]

    relaxing = waves("CO2", gas, CO2, CO2_PER_DECADE)
    constant = waves("constant", gas.constant(), CONSTANT, CONSTANT_PER_DECADE)
    air = {humidity: waves(f"air{humidity}", fluids.find(f"air/{humidity}"), AIR, AIR_PER_DECADE) for humidity in HUMIDITIES}
    pulses = [Pulse(gas, *numbers) for numbers in PULSES[args.quick]]
    runs = [*pulses[::-1], *relaxing, *constant, *sum(air.values(), [])]
    example.run({run.name: run.variables for run in runs})
    for run in runs:
        run.measure(example.out)

    print("\nCO2, 300 K, 101325 Pa      speed of sound [m/s]       absorption per wavelength [Np]")
    print("frequency [kHz]            SPH      theory   ratio    SPH       theory    ratio")
    found = {}
    for name, fluid, group in (("relaxing", gas, relaxing), ("constant", gas.constant(), constant)):
        found[name] = f, c, absorption = driven(group)
        for row in zip(f, c, theory(fluid, f)[0], absorption, theory(fluid, f)[1]):
            print(f"{row[0] / 1e3:8.3f} {name:16s}  {row[1]:.2f}   {row[2]:.2f}   {row[1] / row[2]:.4f}   "
                  f"{row[3]:.6f}  {row[4]:.6f}  {row[3] / row[4]:.4f}")
    print("\nair, 20 C, 101325 Pa: absorption [dB/km]\nhumidity   frequency [Hz]   SPH       ISO 9613-1   ratio")
    decibels = {}
    for humidity, group in air.items():
        f = np.array([wave.frequency for wave in group])
        decibels[humidity] = f, np.array([-wave.s.real / (wave.s.imag / wave.k) for wave in group]) * 8686
        for frequency, decibel in zip(*decibels[humidity]):
            iso = iso_9613(frequency, humidity)
            print(f"{humidity:4d} %     {frequency:10.2f}       {decibel:8.4f}  {iso:8.4f}     {decibel / iso:.4f}")
    print("\npulse                front/c_inf   body/c_0   difference from the continuum, rms over that of the pulse")
    for pulse in pulses:
        print(f"{pulse.dim}d, to {pulse.end:3d} tau      {pulse.front:.4f}        {pulse.body or np.nan:.4f}     {pulse.worst:.4f}")
    print()

    place, height = peak(found["relaxing"][0], found["relaxing"][2])
    fine = np.geomspace(*CO2, 400)
    their_place, their_height = peak(fine, theory(gas, fine)[1])
    print(f"largest absorption of CO2: {height:.5f} Np at {place / 1e3:.2f} kHz, theory {their_height:.5f} Np at {their_place / 1e3:.2f} kHz")
    example.merit("CO2: place of the largest absorption over theory", place / their_place, 1 - PEAK_PLACE, 1 + PEAK_PLACE)
    example.merit("CO2: largest absorption over theory", height / their_height, 1 - PEAK_HEIGHT, 1 + PEAK_HEIGHT)
    example.merit("CO2: speed at the lowest frequency over c_0", found["relaxing"][1][0] / gas.c, 1 - SPEED, 1 + SPEED)
    example.merit("CO2: speed at the highest frequency over c_inf", found["relaxing"][1][-1] / fast(gas), 1 - SPEED, 1 + SPEED)
    f, _, absorption = found["relaxing"]
    worst = max(absorption / theory(gas, f)[1] / line_factor(), key=lambda ratio: abs(ratio - 1))
    example.merit(f"CO2: absorption over {line_factor():.4f} of theory, farthest from 1", worst, 1 - LINE, 1 + LINE)
    for humidity, (f, decibel) in decibels.items():
        worst = max(decibel / iso_9613(f, humidity), key=lambda ratio: abs(ratio - 1))
        example.merit(f"air, {humidity} % humidity: absorption over ISO 9613-1, farthest from 1", worst, 1 - DECIBEL, 1 + DECIBEL)
    for pulse in pulses:
        example.merit(f"pulse, {pulse.dim}d: front over c_inf", pulse.front, 1 - SPEED, 1 + SPEED)
        example.merit(f"pulse, {pulse.dim}d: difference from the continuum", pulse.worst, 0, PROFILE * pulse.spacing**2)
    example.merit("pulse, 1d: body over c_0", pulses[0].body, 1 - SPEED, 1 + SPEED)
    return example.finish(plot_co2(example.out / "co2.png", gas, found["relaxing"], found["constant"]),
                          plot_air(example.out / "air.png", decibels), plot_pulses(example.out / "pulse.png", pulses))


if __name__ == "__main__":
    sys.exit(main())
