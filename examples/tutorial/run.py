# SPDX-License-Identifier: GPL-2.0-only
"""Runs the inputs of the page "A first flow, step by step" and draws its figures."""
import sys
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent))

from run_lammps import Example, averages, pyplot, save, thermo      # noqa: E402


def chunks(path):
    """[(step, rows)] of the outputs of fix ave/chunk: chunk, coordinate, count and values, of bins with particles alone"""
    outputs = [(step, np.column_stack([*found.values()])) for step, found in averages(path).items()]
    return [(step, rows[rows[:, 2] > 0]) for step, rows in outputs]


def figure(name, draw, out):
    figure, axes = pyplot().subplots(figsize=(6.4, 3.6))
    draw(axes)
    save(figure, out / f"{name}.png")


def couette(y, t, mu=0.1, U=0.1):
    n = np.arange(1, 400)
    return U * (y - np.sum(2 / (np.pi * n) * (-1.0) ** (n + 1) * np.sin(np.pi * n * y[:, None])
                           * np.exp(-mu * (np.pi * n) ** 2 * t), axis=1))


def micropolar(y, mu=0.1, mu_r=0.1, gamma=0.02, g=0.8, H=0.5):
    K = np.sqrt(4 * mu * mu_r / (gamma * (mu + mu_r)))
    C = -g * H / (2 * mu * np.sinh(K * H))
    spin = g * y / (2 * mu) + C * np.sinh(K * y)
    return g * (H**2 - y**2) / (2 * mu) + 2 * mu_r * C * (np.cosh(K * H) - np.cosh(K * y)) / ((mu + mu_r) * K), spin


def main():
    example = Example(FOLDER, __doc__)
    args = example.arguments()
    out = example.out

    kappas = ("0.2",) if args.quick else ("2.0", "0.2", "0.02")
    sizes = (8, 16) if args.quick else (8, 16, 32)
    supports = ("3", "4")
    jobs = {f"5-{n}-{support}": {"n": n, "support": support} for n in reversed(sizes) for support in supports}
    jobs.update({"8": {}, "7": {}, "6": {}, "4": {}})
    jobs.update({f"3-{kappa}": {"kappa": kappa} for kappa in kappas})
    jobs.update({"2": {}, "1": {}})
    example.run(jobs, {name: FOLDER / f"in.{name[0]}" for name in jobs})
    log = lambda name: thermo((out / f"{name}.log").read_text())[-1]

    rest = log("1")
    example.merit("1: smallest density of the box at rest, less 1", rest["c_rho"][-1] - 1, -1e-12, 1e-12)
    example.merit("1: its kinetic energy", rest["KinEng"][-1], 0, 1e-20)

    shear = log("2")
    k = 2 * np.pi / (40 * 0.05 * np.sqrt(2 / np.sqrt(3)))
    rate = -np.log(shear["c_vy"][-1] / 5e-5) / 2 / shear["Time"][-1]
    example.merit("2: viscosity over mu", rate / k**2 / 0.1, 0.99, 1.01)

    def shear_wave(axes):
        t = np.linspace(0, 4, 200)
        axes.semilogy(t, 5e-5 * np.exp(-2 * 0.1 * k**2 * t), "k-", lw=1, label="theory")
        axes.semilogy(shear["Time"], shear["c_vy"], "o", label="particles")
        axes.legend()
        axes.set(xlabel="time (lj units)", ylabel="mean square of the velocity (lj units)")
    figure("shear_wave", shear_wave, out)

    sound = {kappa: np.loadtxt(out / f"wave.{kappa}.txt") for kappa in reversed(kappas)}

    def sound_wave(axes):
        for (kappa, wave), color in zip(sound.items(), ("C0", "C3", "C2")):
            t = wave[:, 0] * 0.001
            rate = 0.5 * (float(kappa) + 0.1) * (k / 2) ** 2
            axes.plot(t, wave[:, 1] / 5e-3, ".", ms=2, color=color, label=f"kappa = {kappa}")
            for sign in (-1, 1):
                axes.plot(t, sign * np.exp(-rate * t), "-", lw=1, color=color)
        axes.set(xlabel="time (lj units)", ylabel="amplitude over that at the start", xlim=(0, 5))
        axes.legend(markerscale=4)
    figure("sound_wave", sound_wave, out)
    wave = sound["0.2"]
    t, peaks = wave[:, 0] * 0.001, wave[:, 1]
    top = [i for i in range(1, len(t) - 1) if abs(peaks[i]) > max(abs(peaks[i - 1]), abs(peaks[i + 1]))]
    slope = -np.polyfit(t[top], np.log(abs(peaks[top])), 1)[0]
    wanted = 0.15 * (k / 2) ** 2
    example.merit("3: damping of the sound wave over that of theory", slope / wanted, 0.97, 1.03)

    stress = log("4")["v_stress"][-1]
    example.merit("4: stress on the lid over mu U", stress / 0.01, 0.98, 1.02)
    frames = chunks(out / "couette.txt")
    dt = 0.02 / 16 * np.sqrt(2 / np.sqrt(3))

    def gap(axes):
        y = np.linspace(0, 1, 200)
        for which in (1, 2, 4, 20):
            step, rows = frames[which]
            axes.plot(couette(y, step * dt) / 0.1, y, "k-", lw=1)
            axes.plot(rows[:, 3] / 0.1, rows[:, 1], "o", ms=4, label=f"t = {step * dt:.2g}")
        axes.set(xlabel="velocity over that of the lid", ylabel="height over that of the gap")
        axes.legend(title="lines: exact")
    figure("couette", gap, out)

    sizes = (8, 16) if args.quick else (8, 16, 32)
    error = {support: [log(f"5-{n}-{support}")["v_error"][-1] for n in sizes] for support in supports}
    for support, values in error.items():
        print(f"5: rc = {support} spacings: " + ", ".join(f"n = {n}: {100 * e:.2f} %" for n, e in zip(sizes, values)))
    example.merit("5: error with 16 rows", error["3"][1], 0, 0.008)

    def channel(axes):
        for support, values in error.items():
            axes.loglog(sizes, 100 * np.array(values), "o-", label=f"rc = {support} spacings")
        axes.set(xlabel="rows across the channel", ylabel="error of the velocity, percent", xticks=sizes, xticklabels=sizes)
        axes.minorticks_off()
        axes.set(yticks=(0.2, 0.5, 1, 2), yticklabels=("0.2", "0.5", "1", "2"))
        axes.legend()
    figure("channel", channel, out)

    _, rows = chunks(out / "spin.txt")[-1]
    y = rows[:, 1] - 0.5
    u, spin = micropolar(y)
    errors = [np.linalg.norm(rows[:, column] - exact) / np.linalg.norm(exact) for column, exact in ((3, u), (4, spin))]
    example.merit("6: error of the velocity", errors[0], 0, 0.012)
    example.merit("6: error of the spin", errors[1], 0, 0.045)

    def spins(axes):
        fine = np.linspace(-0.5, 0.5, 200)
        axes.plot(fine + 0.5, 4 * (0.25 - fine**2), "k:", lw=1, label="velocity without spin, exact")
        for curve in micropolar(fine):
            axes.plot(fine + 0.5, curve, "k-", lw=1)
        axes.plot(rows[:, 1], rows[:, 3], "o", ms=4, label="velocity")
        axes.plot(rows[:, 1], rows[:, 4], "s", ms=4, label="spin")
        axes.set(xlabel="height over that of the channel", ylabel="velocity, spin (lj units)")
        axes.legend()
    figure("spin", spins, out)

    balance = log("7")["v_balance"]
    _, rows = chunks(out / "open.txt")[-1]
    inner = (rows[:, 1] > 0.3) & (rows[:, 1] < 1.7)
    slope = -np.polyfit(rows[inner, 1], rows[inner, 3], 1)[0]
    example.merit("7: change of the balance of particles", np.ptp(balance), 0, 0)
    example.merit("7: pressure gradient over 8 mu", slope / 0.8, 0.9, 1.1)

    def pressure(axes):
        # above that of the fluid at the outlet: the ends hold the pressure to a part in a thousand of rho0 c0^2 only
        line = np.polyfit(rows[inner, 1], rows[inner, 3], 1)
        axes.plot([0, 2], [1.6, 0], "k-", lw=1, label="exact")
        axes.plot(rows[:, 1], rows[:, 3] - np.polyval(line, 2.0), "o", ms=4, label="particles")
        axes.set(xlabel="place along the channel (lj units)", ylabel="pressure above the outlet (lj units)")
        axes.legend()
    figure("inlet", pressure, out)

    dam = log("8")
    energy = dam["v_mechanical"]
    example.merit("8: largest growth of the mechanical energy", np.diff(energy).max(), -1, 0)
    example.merit("8: mechanical energy lost", 1 - energy[-1], 0, 0.04)
    example.merit("8: front at t = 1 over that of 60 particles per height", dam["v_front"][4] / 2.93, 0.95, 1.05)

    def front(axes):
        axes.plot(dam["Time"], dam["v_front"], "o-", ms=4, label="front")
        axes.plot(dam["Time"], energy, "s-", ms=4, label="mechanical energy over that at the start")
        axes.axhline(4.0, color="k", lw=1, ls=":", label="far wall")
        axes.set(xlabel="time (lj units)", ylabel="place (lj units), energy", ylim=(0, 4.5))
        axes.legend()
    figure("dam_break", front, out)
    return example.finish(*sorted(out.glob("*.png")))


sys.exit(main())
