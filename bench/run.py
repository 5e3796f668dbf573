#!/usr/bin/env python3
"""Time sph/bulk against LAMMPS's own sph/rhosum + sph/taitwater/morris, sph/micropolar against sph/bulk, and
channels with walls of fix sph/wall against the periodic fluid, both fluids with thermal noise against those without, and
sph/bulk with a fix sph/refine that finds nothing to do against it without.

All run from the same executable on the same particles (3d periodic, support radius of three particle
spacings), in turn, so that a drift of the machine's speed meets all.  A channel has as many fluid particles
and besides them two walls of three layers.  Printed: medians of atom-steps per second and of pair
interactions per second (distinct pairs inside the support), and the median, smallest and largest ratio of
the runs of one turn.
"""

import argparse
import os
import re
import shutil
import signal
import statistics
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
FASTER = 4.0  # what --check asks for
COST = 1.5
WALL_COST = 1.3
NOISE_COST = 1.6
IDLE_COST = 1.02
STYLES = ("lammps", "bulk", "micropolar")
NAMES = {"lammps": "sph/rhosum 1 + sph/taitwater/morris", "bulk": "sph/bulk (mg, bulk density)",
         "micropolar": "sph/micropolar (everything on)"}
LAYERS = 3
WALLS = {"channel, sph/bulk": ("bulk", "slip no"),
         "channel, sph/micropolar": ("micropolar", "slip no spin zero"),
         "channel, sph/micropolar, spin rate": ("micropolar", "slip no spin rate 1.0")}
NOISE = "temp 1e-6 4711"
OWN = "temp energy 60.0 4711"     # temperatures of the particles
FLUIDS = {"one fluid": "0", "two fluids": "1.0", "two densities": "1.5"}
MASS = "volume mass"              # which fix sph/refine needs
REFINE = 10


def run(style, ranks, args, wall=None, noise=None, refine=None, switches=()):
    """One run; returns seconds of the time loop, atoms and how many are fluid, pairs inside the support, checksum of
    the positions."""
    command = [args.lmp, "-in", str(HERE / "in.bench"), "-log", "none", "-nocite",
               "-var", "style", style, "-var", "n", str(args.n), "-var", "steps", str(args.steps),
               "-var", "simd", args.simd, *switches]
    if wall:
        command += ["-var", "layers", str(LAYERS), "-var", "wall", wall]
    if noise:
        command += ["-var", "noise", noise]
    if refine:
        command += ["-var", "refine", str(refine)]
    if ranks > 1:
        command = [args.mpiexec, "--oversubscribe", "-np", str(ranks)] + command
    threads = switches[switches.index("t") + 1] if "t" in switches else "1"
    result = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": threads})
    if result.returncode != 0:
        sys.exit(f"{' '.join(command)}\nfailed:\n{result.stdout[-2000:]}{result.stderr[-2000:]}")
    seconds = float(re.findall(r"Loop time of (\S+) on", result.stdout)[-1])
    place, pairs, atoms, fluid = re.search(r"^BENCH place (\S+) pairs (\S+) atoms (\S+) fluid (\S+)", result.stdout,
                                           re.M).groups()
    return seconds, int(atoms), int(fluid), 0.5 * float(pairs), float(place)


def compare(ranks, args):
    seconds = {name: [] for name in (*STYLES, *WALLS)}
    noisy = {style: [] for style in STYLES if style != "lammps"}
    idle = {None: [], REFINE: []}
    size = {}
    for _ in range(args.repeat):
        places = []
        for style in STYLES:
            elapsed, atoms, _, pairs, place = run(style, ranks, args)
            seconds[style].append(elapsed)
            places.append(place)
        if max(places) - min(places) > 1e-12 * places[0]:
            sys.exit("the styles did not run the same particles")
        for style, elapsed in noisy.items():
            elapsed.append(run(style, ranks, args, noise=NOISE)[0])
        for refine, elapsed in idle.items():
            elapsed.append(run("bulk", ranks, args, noise=MASS, refine=refine)[0])
        for name, (style, wall) in WALLS.items():
            elapsed, *size[name] = run(style, ranks, args, wall)
            seconds[name].append(elapsed)
            if size[name][1] != atoms:
                sys.exit("the channel does not have the fluid particles of the periodic box")

    print(f"\n{ranks} rank{'s' if ranks > 1 else ''}, {atoms} particles, {2 * pairs / atoms:.1f} neighbours inside "
          f"the support, {args.steps} steps, median of {args.repeat} runs each, in turn")
    for style in STYLES:
        steps_per_second = args.steps / statistics.median(seconds[style])
        print(f"  {NAMES[style]:<38} {steps_per_second * atoms:12.4g} atom-steps/s "
              f"{steps_per_second * pairs:12.4g} pairs/s")
    for name in WALLS:
        steps_per_second = args.steps / statistics.median(seconds[name])
        print(f"  {name:<38} {steps_per_second * size[name][0]:12.4g} atom-steps/s "
              f"{steps_per_second * size[name][1]:12.4g} fluid-atom-steps/s")
    faster = ratio(seconds["lammps"], seconds["bulk"], "steps per second of sph/bulk over LAMMPS's styles")
    cost = ratio(seconds["micropolar"], seconds["bulk"], "time per step of sph/micropolar over sph/bulk")
    walls = []
    for name, (style, _) in WALLS.items():
        all_atoms, fluid = size[name][:2]
        walls.append(ratio([t / all_atoms for t in seconds[name]], [t / atoms for t in seconds[style]],
                           f"time per particle, {name} over periodic"))
        ratio([t / fluid for t in seconds[name]], [t / atoms for t in seconds[style]], "  per fluid particle")
    noise = [ratio(elapsed, seconds[style], f"time per step of sph/{style} with thermal noise over without")
             for style, elapsed in noisy.items()]
    ratio(idle[REFINE], idle[None], "time per step of sph/bulk with an idle fix sph/refine over without")
    idle_cost = min(idle[REFINE]) / min(idle[None])
    print(f"    of the shortest times: {idle_cost:.4f}", flush=True)
    return faster, cost, max(walls), max(noise), idle_cost


def noises(args):
    """The noise in all its forms, each against the same fluid without it, on one rank."""
    warm = ("-var", "T", "1e-3")
    conducts, heat = (*warm, "-var", "heat", "conductivity 3.0"), (*warm, "-var", "heat", "cv 60.0 conductivity 3.0")
    kinds = {"": (None, ()), "temp T": (NOISE, ()), "temp energy": (OWN, warm), "conductivity": (None, heat),
             "temp energy, conductivity": (OWN, conducts)}
    for style in ("bulk", "micropolar"):
        for fluids, second in FLUIDS.items():
            seconds = {kind: [] for kind in kinds}
            for _ in range(args.repeat):
                for kind, (noise, switches) in kinds.items():
                    seconds[kind].append(run(style, 1, args, noise=noise, switches=("-var", "second", second, *switches))[0])
            print(f"\nsph/{style}, {fluids}, {statistics.median(seconds['']) / args.steps * 1e3:.3g} ms per step without noise")
            for kind in ("temp T", "temp energy", "temp energy, conductivity"):
                ratio(seconds[kind], seconds["conductivity" if "," in kind else ""], f"time per step with {kind} over that without noise")


def ratio(seconds_a, seconds_b, what):
    """Median ratio of runs of one turn, printed with its range."""
    ratios = [a / b for a, b in zip(seconds_a, seconds_b)]
    median = statistics.median(ratios)
    print(f"  ratio, {what}: {median:.2f} ({min(ratios):.2f} to {max(ratios):.2f})", flush=True)
    return median


def parsed(parser):
    """Arguments of a benchmark. With SPHD_PARSE_ONLY, nothing but a look at them, before LAMMPS is built."""
    args = parser.parse_args()
    for name in ("n", "steps", "repeat", "ranks"):
        number = getattr(args, name, None)
        if number is not None and min(number if isinstance(number, list) else [number]) < 1:
            parser.error(f"--{name} must be at least 1")
    if os.environ.get("SPHD_PARSE_ONLY"):
        sys.exit()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))    # subprocess.run ends its LAMMPS
    if not shutil.which(args.lmp):
        parser.error(f"no LAMMPS executable {args.lmp}; name one by --lmp")
    if getattr(args, "ranks", 1) not in (1, [1]) and not shutil.which(args.mpiexec):
        parser.error(f"no {args.mpiexec}, which starts MPI programs; name one by --mpiexec")
    return args


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default=os.environ.get("SPHD_LMP", str(HERE.parent / "build" / "lmp")))
    parser.add_argument("--mpiexec", default=os.environ.get("SPHD_MPIEXEC", "mpiexec"))
    parser.add_argument("--n", type=int, default=40, help="particles per side (40: 64,000 particles)")
    parser.add_argument("--steps", type=int, default=50)
    parser.add_argument("--repeat", type=int, default=7, help="runs of each style, in turn")
    parser.add_argument("--simd", default="auto", help="keyword simd of the pair styles: auto, none, avx2 or avx512")
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--noise", action="store_true", help="the thermal noise in all its forms, and nothing else")
    parser.add_argument("--check", action="store_true",
                        help=f"fail if sph/bulk is not {FASTER} times as fast as LAMMPS's styles, sph/micropolar "
                             f"costs more than {COST} times as much as sph/bulk, a channel per particle more than "
                             f"{WALL_COST} times as much as the periodic box, thermal noise makes a style more than "
                             f"{NOISE_COST} times as expensive, or an idle fix sph/refine takes more than {IDLE_COST} "
                             "times as long as none (shortest of all runs), on the first number of ranks")
    args = parsed(parser)
    if args.noise:
        return noises(args)
    results = [compare(ranks, args) for ranks in args.ranks]
    faster, cost, walls, noise, idle = results[0]
    if args.check and (faster < FASTER or cost > COST or walls > WALL_COST or noise > NOISE_COST or idle > IDLE_COST):
        sys.exit("slower than it should be")


if __name__ == "__main__":
    main()
