#!/usr/bin/env python3
"""Time sph/bulk against LAMMPS's own sph/rhosum + sph/taitwater/morris, and sph/micropolar against sph/bulk.

All run from the same executable on the same particles (3d periodic, support radius of three particle
spacings), in turn, so that a drift of the machine's speed meets all.  Printed: medians of atom-steps per
second and of pair interactions per second (distinct pairs inside the support), and the median,
smallest and largest ratio of the runs of one turn.
"""

import argparse
import os
import re
import statistics
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
FASTER = 1.5  # what --check asks for
COST = 1.7
STYLES = ("lammps", "bulk", "micropolar")
NAMES = {"lammps": "sph/rhosum 1 + sph/taitwater/morris", "bulk": "sph/bulk (mg, bulk density)",
         "micropolar": "sph/micropolar (everything on)"}


def run(style, ranks, args):
    """One run; returns seconds of the time loop, atoms, pairs inside the support, checksum of the positions."""
    command = [args.lmp, "-in", str(HERE / "in.bench"), "-log", "none", "-nocite",
               "-var", "style", style, "-var", "n", str(args.n), "-var", "steps", str(args.steps)]
    if ranks > 1:
        command = [args.mpiexec, "--oversubscribe", "-np", str(ranks)] + command
    result = subprocess.run(command, capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{' '.join(command)}\nfailed:\n{result.stdout[-2000:]}{result.stderr[-2000:]}")
    seconds = float(re.findall(r"Loop time of (\S+) on", result.stdout)[-1])
    place, pairs, atoms = re.search(r"^BENCH place (\S+) pairs (\S+) atoms (\S+)", result.stdout, re.M).groups()
    return seconds, int(atoms), 0.5 * float(pairs), float(place)


def compare(ranks, args):
    seconds = {style: [] for style in STYLES}
    for _ in range(args.repeat):
        places = []
        for style in STYLES:
            elapsed, atoms, pairs, place = run(style, ranks, args)
            seconds[style].append(elapsed)
            places.append(place)
        if max(places) - min(places) > 1e-12 * places[0]:
            sys.exit("the styles did not run the same particles")

    print(f"\n{ranks} rank{'s' if ranks > 1 else ''}, {atoms} particles, {2 * pairs / atoms:.1f} neighbours inside "
          f"the support, {args.steps} steps, median of {args.repeat} runs each, in turn")
    for style in STYLES:
        steps_per_second = args.steps / statistics.median(seconds[style])
        print(f"  {NAMES[style]:<38} {steps_per_second * atoms:12.4g} atom-steps/s "
              f"{steps_per_second * pairs:12.4g} pairs/s")
    faster = ratio(seconds["lammps"], seconds["bulk"], "steps per second of sph/bulk over LAMMPS's styles")
    cost = ratio(seconds["micropolar"], seconds["bulk"], "time per step of sph/micropolar over sph/bulk")
    return faster, cost


def ratio(seconds_a, seconds_b, what):
    """Median ratio of runs of one turn, printed with its range."""
    ratios = [a / b for a, b in zip(seconds_a, seconds_b)]
    median = statistics.median(ratios)
    print(f"  ratio, {what}: {median:.2f} ({min(ratios):.2f} to {max(ratios):.2f})", flush=True)
    return median


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default=os.environ.get("SPHD_LMP", str(HERE.parent / "build" / "lmp")))
    parser.add_argument("--mpiexec", default=os.environ.get("SPHD_MPIEXEC", "mpiexec"))
    parser.add_argument("--n", type=int, default=40, help="particles per side (40: 64,000 particles)")
    parser.add_argument("--steps", type=int, default=50)
    parser.add_argument("--repeat", type=int, default=5, help="runs of each style")
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--check", action="store_true",
                        help=f"fail if sph/bulk is not {FASTER} times as fast as LAMMPS's styles, or sph/micropolar "
                             f"costs more than {COST} times as much as sph/bulk, on the first number of ranks")
    args = parser.parse_args()
    results = [compare(ranks, args) for ranks in args.ranks]
    faster, cost = results[0]
    if args.check and (faster < FASTER or cost > COST):
        sys.exit("slower than it should be")


if __name__ == "__main__":
    main()
