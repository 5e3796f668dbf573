#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Makes the short animations of the examples: examples/NAME/NAME.gif, at most 1 MB each.

    animate.py [NAME ...] [--lmp PATH] [--out DIR]       seconds to two minutes of processor time each; needs Pillow, which matplotlib brings

Each is the input of the example with one more dump, in a coarse version.
"""
import argparse
import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
EXAMPLES = ROOT / "examples"
sys.path.insert(0, str(EXAMPLES))
from run_lammps import frames, pyplot      # noqa: E402

LARGEST = 1_000_000     # bytes
COLORS = 32
WIDTH, HEIGHT = 600, 420        # pixels, at most
TWO_FLUIDS = ("#E69F00", "#56B4E9")

# by example: panels (title, variables of the input), input, its run that is shown, group and steps between two frames, what the color of a
# particle is, range of it and name of the color map or two colors, limits of x and y, area of a particle in square points

FLOWS = {
    "rotating_drop": ([("mg: goes on rotating", {"shear": "mg", "n": 20, "end": 8}), ("morris: comes to rest", {"shear": "morris", "n": 20, "end": 8})],
                      "in.rotating_drop", "run ${steps}", ("all", "$(round(v_steps/40))"), lambda p: p["type"], (1, 2), TWO_FLUIDS,
                      ((-1.1, 1.1), (-1.1, 1.1)), 30),
    "oscillating_drop": ([("speed", {"n": 25, "periods": 1})], "in.oscillating_drop", "run $(round(240*v_periods)*v_every)", ("all", "$(6*v_every)"),
                         lambda p: np.hypot(p["vx"], p["vy"]), (0, 1.1), "viridis", ((-2.1, 2.1), (-2.1, 2.1)), 12),
    "refined_drop": ([("mass of the particles", {"steps": 2000})], "in.refined_drop", "run ${steps}", ("all", "$(v_steps/50)"),
                     lambda p: p["mass"], (0, 1.1), "viridis", ((-13, 13), (-13, 13)), 40),
    "taylor_green_2d": ([("speed", {"n": 40, "shift": 1.0, "tend": 1, "re": 100})], "in.taylor_green_2d", "run $(50*v_part*v_tend)", ("all", "$(round(1.25*v_part))"),
                        lambda p: np.hypot(p["vx"], p["vy"]), (0, 1), "viridis", ((0, 1), (0, 1)), 30),
    "pulse_exit": ([("velocity across the stream, outlet on the right", {"end": 10})], "in.pulse_exit_vortex", "run $(ceil(v_end*v_unit))",
                   ("fluid", "$(ceil(v_end*v_unit/50))"), lambda p: p["vy"], (-0.25, 0.25), "RdBu_r", ((0, 12), (0, 8)), 40),
    "cylinder": ([("velocity across the stream, Re = 100", {"Re": 100, "n": 10, "width": 8, "up": 4, "down": 10, "support": 3, "kick": 0.5, "end": 48, "mean": 6})],
                 "in.cylinder", "run ${window}", ("fluid", "$(floor(v_window/24))"), lambda p: p["vy"], (-0.6, 0.6), "RdBu_r", ((-4, 10), (-4, 4)), 8),
    "floating": ([("a box of 0.6 of the density of water falls", {"lift": 0.48, "end": 6})], "in.floating", "run $(round(v_end/v_every)*v_steps)",
                 ("all", "$(2*v_steps)"), lambda p: p["type"], (1, 3), ("#56B4E9", "#E69F00"), ((0, 4), (0, 1.8)), 12),
    "cavity": ([("speed, Re = 400", {"N": 40, "Re": 400, "end": 8, "mean": 8})], "in.cavity", "run ${window}", ("fluid", "$(floor(v_window/40))"),
               lambda p: np.hypot(p["vx"], p["vy"]), (0, 0.8), "viridis", ((0, 1), (0, 1)), 30),
}


def run(lmp, name, out, title, variables, script, shown, group, every):
    """Frames of one panel."""
    text = (EXAMPLES / name / script).read_text(encoding="utf-8")
    dump = f"dump animation {group} custom {every} ${{out}}.animation id type mass x y vx vy\ndump_modify animation sort id\n"
    text, count = re.subn(rf"^{re.escape(shown)}$", lambda line: dump + line[0], text, flags=re.MULTILINE)
    if count != 1:
        raise SystemExit(f"animate: {script} has {count} lines {shown}")
    prefix = out / f"{name}.{re.sub(r'[^a-z0-9]+', '_', title.lower())}"
    prefix.with_suffix(".in").write_text(text, encoding="utf-8")
    words = [word for key, value in {**variables, "out": prefix}.items() for word in ("-var", key, str(value))]
    done = subprocess.run([lmp, "-in", str(prefix.with_suffix(".in")), "-screen", "none", "-log", f"{prefix}.log", *words], text=True,
                          cwd=out, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        raise SystemExit(f"animate: LAMMPS failed for {name}, see {prefix}.log\n{done.stdout}")
    return list(frames(f"{prefix}.animation").values())


def draw(path, panels, value, limits, colors, box, size):
    """panels: {title: frames}. The pictures have the colors of the map, and greys."""
    from matplotlib.colors import ListedColormap
    from PIL import Image

    plt = pyplot()
    wide, high = (np.ptp(side) for side in box)
    shape = len(panels) * wide / high
    width = min(WIDTH, HEIGHT * shape) / 80
    figure, axes = plt.subplots(1, len(panels), figsize=(width, width / shape + 0.45), dpi=80, squeeze=False)
    cmap = ListedColormap(colors) if isinstance(colors, tuple) else colors
    dots = []
    for axis, (title, first) in zip(axes[0], panels.items()):
        dots.append(axis.scatter([], [], c=[], s=size, lw=0, antialiased=False, cmap=cmap, vmin=limits[0], vmax=limits[1]))
        axis.set(xlim=box[0], ylim=box[1], aspect="equal", title=title, xticks=[], yticks=[], facecolor="0.9")
    if not isinstance(colors, tuple):
        figure.colorbar(dots[-1], ax=axes[0], shrink=0.9)
    figure.canvas.draw()
    figure.set_layout_engine("none")    # that of the first picture for all
    pictures = []
    for moment in zip(*panels.values()):
        for dot, particles in zip(dots, moment):
            dot.set_offsets(np.column_stack([particles["x"], particles["y"]]))
            dot.set_sizes(size * particles["mass"] / particles["mass"].max())
            dot.set_array(value(particles))
        figure.canvas.draw()
        pictures.append(Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB"))
    plt.close(figure)
    steps = [*dots[0].cmap(np.linspace(0, 1, COLORS))[:, :3], *np.linspace((0, 0, 0), (1, 1, 1), 12)]
    palette = Image.new("P", (1, 1))
    palette.putpalette(np.rint(255 * np.array(steps)).astype(int).ravel().tolist())
    pictures = [picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures]
    pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=80, loop=0, optimize=True)
    if path.stat().st_size > LARGEST:
        raise SystemExit(f"animate: {path} has {path.stat().st_size} bytes")
    return len(pictures)


def main():
    parser = argparse.ArgumentParser(description="Makes the animations of the examples.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(FLOWS) + " (all of them)")
    parser.add_argument("--lmp", default=str(ROOT / "build" / "lmp"), help="(%(default)s)")
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "animations", help="folder for dumps and logs (%(default)s)")
    args = parser.parse_args()
    unknown = [name for name in args.names if name not in FLOWS]
    if unknown:
        parser.error(f"no animation of {unknown[0]}; there are: {' '.join(FLOWS)}")
    if not shutil.which(args.lmp):
        parser.error(f"no LAMMPS executable {args.lmp}; name one by --lmp, or run ./sphd build")
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))    # subprocess.run ends its LAMMPS
    args.out.mkdir(parents=True, exist_ok=True)
    for name in args.names or FLOWS:
        panels, script, shown, (group, every), *look = FLOWS[name]
        found = {title: run(args.lmp, name, args.out.resolve(), title, variables, script, shown, group, every) for title, variables in panels}
        path = EXAMPLES / name / f"{name}.gif"
        count = draw(path, found, *look)
        print(f"{path}: {count} frames, {path.stat().st_size} bytes", flush=True)


if __name__ == "__main__":
    main()
