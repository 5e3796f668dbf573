#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""What comes back when a sound pulse or a vortex leaves through an open end.

    ./sphd run pulse_exit          or
    SPHD_LMP=path/to/lmp python3 run.py [--quick] [--np N] [--out DIR] [--check]
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from run_lammps import Example, csv_rows, frames, pyplot, save      # noqa: E402

# kinds of outlets: name, color, condition and what is given, in which {u} and {p} stand for the stream and its pressure
OUTLETS = {
    "lagged": ("C3", "lagged", "velocity {u} 0.0 0.0 pressure {p}"),
    "lagged_mean": ("C1", "lagged", "velocity inside average {T} pressure {p}"),
    "characteristic": ("C0", "characteristic", "velocity {u} 0.0 0.0 pressure {p}"),
    "fixed": ("k", "fixed", "velocity {u} 0.0 0.0 pressure {p}"),
    "pressure": ("C2", "fixed", "velocity inside pressure {p} order 0"),
    "inside": ("C4", "fixed", "velocity inside pressure inside order 0"),
}
TITLE = {
    "lagged": "lagged",
    "lagged_mean": "lagged, mean velocity from inside",
    "characteristic": "characteristic",
    "fixed": "fixed velocity and pressure",
    "pressure": "fixed pressure, velocity from inside",
    "inside": "fixed, both from inside, order 0",
}
STREAMS = (0.0, 0.1)                    # over the sound speed
STEP = 0.4                              # time step of the input
WIDTHS = (8, 16)                        # of the pulses, in spacings
MORE = (4, 8, 16, 32)                   # ... of those that leave through the outlets SLANTED
BARS = {8: 0.05, 16: 0.03}              # largest reflection, outlet lagged
ANGLES = (0, 30, 45)
WAVE = 16                               # wavelength of the oblique pulses, in spacings
SLANTED = ("lagged", "characteristic")  # outlets of oblique pulses
VORTEX = ("lagged", "lagged_mean", "characteristic", "fixed", "pressure")
LEFT = 0.01                             # of the kinetic energy of the vortex, outlet lagged


class Pulse:
    """The pressure in the right half of the channel when the pulse is in its middle: on its way out, and what comes back."""

    def __init__(self, out, name, job):
        found = frames(out / f"{name}.particles.txt")
        steps, length = np.array(list(found)), job["length"]
        u, c = job["stream"], np.cos(np.radians(job["angle"]))
        self.x = np.arange(0.5 * length, length)
        wave = job["wavelength"] > 0
        there, back = 0.25 * length / (c + u), 0.5 * length / (c + u) + 0.25 * length / (c - u)
        self.there, self.back = (self._pressure(found[steps[np.argmin(np.abs(steps * STEP - time))]], wave) for time in (there, back))
        # of a wave the root of the mean square, for its crests may be anywhere
        size = (lambda p: np.sqrt(np.mean(p**2))) if wave else (lambda p: np.abs(p).max())
        self.reflection = size(self.back) / size(self.there)

    def _pressure(self, frame, wave):
        """Of all particles, or the means in columns of one spacing."""
        inside = frame["x"] > self.x[0]
        x, p = frame["x"][inside], frame["v_p"][inside]
        if wave:
            return p
        place = np.minimum((x - self.x[0]).astype(int), len(self.x) - 1)
        return np.bincount(place, p, len(self.x)) / np.maximum(np.bincount(place, minlength=len(self.x)), 1)

    def spectrum(self):
        """Wavelengths and the reflection of each, for a pulse without a wave."""
        there, back = (np.abs(np.fft.rfft(p, 4096)) for p in (self.there, self.back))
        k = np.arange(len(there)) * 2 * np.pi / 4096
        clear = (there > 0.05 * there.max()) & (k > 2 * np.pi / 150)
        return 2 * np.pi / k[clear], back[clear] / there[clear]


def pulse(outlet, width, stream, angle=0, wavelength=0, length=None):
    color, condition, given = OUTLETS[outlet]
    length = length or max(300, 20 * width)
    return {"width": width, "stream": stream, "angle": angle, "wavelength": wavelength, "length": length, "condition": condition,
            "outlet": given.format(u=stream, p=1.0, T=10 * length)}


def plot(path, straight, oblique, vortices):
    from matplotlib.ticker import NullFormatter

    plt = pyplot()
    figure, axes = plt.subplots(2, 2, figsize=(9.6, 7.6))
    axes = axes.ravel()
    for axis, stream in zip(axes, STREAMS):
        for outlet, (color, *_) in OUTLETS.items():
            runs = {width: run for (o, width, s), run in straight.items() if o == outlet and s == stream}
            if not runs:
                continue
            look = ":s" if outlet == "inside" else "-o"        # by color alone it would be "pressure" for some
            axis.loglog(*runs[min(runs)].spectrum(), look[0], color=color)
            widths = sorted(runs)
            axis.loglog([2 * np.pi * w for w in widths], [runs[w].reflection for w in widths], look[1], color=color, ms=4, mfc="none",
                        label=TITLE[outlet])
        axis.set(xlabel="wavelength or $2\\pi$ width, spacings", ylim=(3e-3, 200), xlim=(15, 250), xticks=(20, 50, 100, 200),
                 ylabel="reflected part of the amplitude", title="fluid at rest" if stream == 0 else f"stream of {stream:g} $c_0$")
        axis.xaxis.set_major_formatter("{x:g}")
        axis.xaxis.set_minor_formatter(NullFormatter())
    axes[0].legend(loc="upper left", title="marks: pulses; lines: the wavelengths in the narrowest")
    theta = np.linspace(0, 60, 121)
    axes[2].plot(theta, np.tan(np.radians(theta) / 2)**2, "k-", label="$\\tan^2(\\theta/2)$")
    for (outlet, angle, wave, stream), run in oblique.items():
        axes[2].plot(angle, run.reflection, "os"[stream > 0], color=OUTLETS[outlet][0], ms=5, mfc="none",
                     label=TITLE[outlet] + (", stream" if stream > 0 else "") if angle == 0 else None)
    axes[2].set(xlabel="angle between the pulse and the outlet's normal, degrees", ylabel="reflected part of the amplitude", ylim=(0, 1.25), title=f"oblique waves of {WAVE} spacings")
    axes[2].legend(loc="upper right")
    for outlet, (t, energy) in vortices.items():
        width = {"lagged": 3.5, "characteristic": 2.2}.get(outlet, 1.2)      # those below others
        axes[3].semilogy(t, energy / energy[0], "--" if outlet == "fixed" else "-", lw=width, color=OUTLETS[outlet][0], label=TITLE[outlet])
    axes[3].set(xlabel="time, core radii over stream", ylabel="kinetic energy over that at the start", title="a vortex is carried out")
    axes[3].legend()
    save(figure, path)


def main():
    example = Example(HERE, "Sound pulses and a vortex that leave through an open end.")
    args = example.arguments()
    outlets = ("lagged",) if args.quick else OUTLETS
    straight = {(o, w, s): pulse(o, w, s) for o in outlets for s in STREAMS
                for w in (MORE if o in SLANTED and not args.quick else WIDTHS)}
    oblique = {} if args.quick else {
        (o, angle, WAVE, s): pulse(o, 1.2 * WAVE, s, angle, WAVE, 14 * WAVE)
        for o in SLANTED for angle in ANGLES for s in STREAMS}
    names = {key: "_".join(map(str, ("straight", *key))) for key in straight}
    names |= {key: "_".join(map(str, ("oblique", *key))) for key in oblique}
    jobs = {**oblique, **straight}
    example.run({names[key]: jobs[key] for key in sorted(jobs, key=lambda key: (-len(key), -jobs[key]["length"]))})
    # the same for the second input of this folder
    example.name = "pulse_exit_vortex"
    kinds = ("lagged",) if args.quick else VORTEX
    small = {"length": 8, "width": 6, "end": 10} if args.quick else {}
    example.run({f"vortex_{o}": {"condition": OUTLETS[o][1], "outlet": OUTLETS[o][2].format(u=1.0, p=0.0, T=1.0), **small} for o in kinds})
    example.name = HERE.name

    table = example.out / "reflections.csv"
    results = {key: Pulse(example.out, names[key], job) for key, job in jobs.items()}
    with csv_rows(table, ["outlet", "stream", "angle", "wavelength", "width", "reflection"]) as writerow:
        for key, job in jobs.items():
            writerow([key[0], job["stream"], job["angle"], job["wavelength"], job["width"], f"{results[key].reflection:.4f}"])
            print(f"{key[0]}, stream {job['stream']}, angle {job['angle']}, wavelength {job['wavelength']}, width {job['width']}:"
                  f" {results[key].reflection:.4f}")
    vortices = {}
    print()
    for o in kinds:
        t, energy = np.loadtxt(example.out / f"vortex_{o}.history.txt")[:, 1:3].T
        vortices[o] = t, energy
        before, after = energy[t < t[-1] / 8].mean(), energy[t > 0.75 * t[-1]].mean()
        left = after / before
        print(f"vortex, {o}: {left:.5f} of its kinetic energy is left")
        if o.startswith("lagged"):
            example.merit(f"vortex: kinetic energy left by the outlet {o}", left, 0.0, LEFT)
    for width, bar in BARS.items():
        for stream in STREAMS:
            example.merit(f"reflection of a pulse of width {width}, outlet lagged, stream {stream}",
                          results["lagged", width, stream].reflection, 0.0, bar)
    picture = example.out / "pulse_exit.png"
    plot(picture, {k: results[k] for k in straight}, {k: results[k] for k in oblique}, vortices)
    return example.finish(picture, table)


if __name__ == "__main__":
    sys.exit(main())
