#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Sound through a plane between coarse and fine particles: transmission, reflection, decay on both sides.

    ./sphd run sound_interface          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]

Every wave is the difference of two runs, with and without it: the plane disturbs the arrangement of the particles a
little, and the fluid moves there without any wave, too.
"""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import curve_fit

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, frames, pyplot, save      # noqa: E402

LENGTH, C0, MU, KAPPA, LAMBDA, STEP = 240.0, 10.0, 0.5, 1.0, 60.0, 0.02      # as in the input
TRANSMITTED = 0.01       # amplitude behind the plane over that without one, minus 1
REFLECTED = 0.01         # amplitude that comes back over that which arrives
DECAY = 0.02             # rate of decay over that of lambda + 2 mu, minus 1


def difference(out, name):
    """The wave: places and masses of the particles, velocities with the wave minus those without, for each frame."""
    wave, still = (list(frames(out / f"{name}_{part}.particles.txt").items()) for part in ("wave", "still"))
    return [(step * STEP, a["x"], a["mass"], a["vx"] - b["vx"]) for (step, a), (_, b) in zip(wave, still)]


def amplitude(m, u):
    return np.sqrt((m * u**2).sum())


def rates(series):
    """Decay of the standing wave over that of the continuum, left and right of the plane; speeds of sound."""
    k = 2 * np.pi / LAMBDA
    expected = 0.5 * (KAPPA + MU) * k**2      # kappa = lambda + mu in two dimensions
    t = np.array([frame[0] for frame in series])
    found = []
    for right in (False, True):
        mode = []
        for _, x, m, u in series:
            s, w = np.sin(k * x), m * ((x > 0.5 * LENGTH) == right)
            mode.append((w * u * s).sum() / (w * s * s).sum())
        mode = np.array(mode)

        def law(t, a, rate, omega, phase):
            return a * np.exp(-rate * t) * np.cos(omega * t + phase)
        (_, rate, omega, _), _ = curve_fit(law, t, mode, p0=[mode[0], expected, C0 * k, 0.0])
        found.append((rate / expected, omega / k, mode))
    return t, found


def plot(path, packet, uniform, t, sides):
    plt = pyplot()
    figure, (first, second) = plt.subplots(1, 2, figsize=(9.6, 3.2))
    for index, color in ((0, "0.6"), (-1, "C0")):
        time, x, _, u = packet[index]
        first.plot(x, u / C0, ".", ms=2, color=color, label=f"t = {time:g}")
    _, x, _, u = uniform[-1]
    order = np.argsort(x)
    first.plot(x[order], u[order] / C0, "k-", lw=0.6, label="coarse particles only")
    first.axvline(0.5 * LENGTH, color="C3", lw=0.8, ls="--")
    first.set(title="a packet before and behind the plane", xlabel="place $x$ (lj units)", ylabel="velocity $u/c_0$", xlim=(0, LENGTH), ylim=(-0.0085, 0.005))
    for label, color, (rate, _, mode) in zip(("coarse", "fine"), ("C0", "C1"), sides):
        second.plot(t, mode / C0, color=color, ls="-" if color == "C0" else "--", label=f"{label}: rate {rate:.4f}")
    k = 2 * np.pi / LAMBDA
    second.plot(t, sides[0][2][0] / C0 * np.exp(-0.5 * (KAPPA + MU) * k**2 * t), "k:", lw=1, label="$e^{-\\Gamma t}$")
    second.set(title="standing wave, each side", xlabel="time (lj units)", ylabel="amplitude of the velocity $/c_0$", ylim=(-0.0022, 0.0034))
    save(figure, path, legends=(first, second))


def main():
    example = Example(HERE, "Sound through a plane between coarse and fine particles.")
    args = example.arguments()
    jobs = {}
    for fine in (1, 0):
        for part, amount in (("wave", 0.005), ("still", 0.0)):
            jobs[f"packet{fine}_{part}"] = {"wave": "packet", "fine": fine, "A": amount}
    for part, amount in (("wave", 0.002), ("still", 0.0)):
        jobs[f"standing1_{part}"] = {"wave": "standing", "fine": 1, "A": amount, "every": 20,
                                     "end": 12 if args.quick else 24}
    example.run(jobs)

    packet, uniform = difference(example.out, "packet1"), difference(example.out, "packet0")
    (_, x, m, u), (_, x0, m0, u0) = packet[-1], uniform[-1]
    behind = amplitude(m[x > 0.5 * LENGTH], u[x > 0.5 * LENGTH])
    expected = amplitude(m0[x0 > 0.5 * LENGTH], u0[x0 > 0.5 * LENGTH])
    # particles of the left half are the same ones in both runs: what is not there without the plane has come back
    left = slice(None, int(LENGTH) * 8)
    coarse = (x[left] < 0.5 * LENGTH) & (m[left] > 0.9)
    back = (u[left] - u0)[coarse]
    example.merit("transmitted amplitude over that without a plane", behind / expected, 1 - TRANSMITTED, 1 + TRANSMITTED)
    example.merit("reflected over arriving amplitude", amplitude(m[left][coarse], back) / expected, 0.0, REFLECTED)
    example.merit("the same, largest velocity", np.abs(back).max() / np.abs(u0).max(), 0.0, REFLECTED)
    t, sides = rates(difference(example.out, "standing1"))
    for label, (rate, speed, _) in zip(("coarse", "fine"), sides):
        example.merit(f"decay of a standing wave over that of lambda + 2 mu, {label} side", rate, 1 - DECAY, 1 + DECAY)
        print(f"speed of sound there over c0: {speed / C0:.4f}")
    picture = example.out / "sound_interface.png"
    plot(picture, packet, uniform, t, sides)
    return example.finish(picture)


if __name__ == "__main__":
    sys.exit(main())
