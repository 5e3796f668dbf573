#!/usr/bin/env python3
"""Time whole flows with the rebuilds of the neighbor list that they need, beside the pair loops alone.

    ./sphd bench --flows                              all flows, and LAMMPS's own SPH styles in the Taylor-Green flow
    ./sphd bench --flows --against OTHER/lmp          ... in turn with another executable, as that of the commit before
    ./sphd bench --flows --peers lmp                  LAMMPS's styles in another executable, RHEO too if that has it
    ./sphd bench --flows --messages                   what 1 to 16 ranks send, and up to how many ranks a flow scales
    ./sphd bench --flows --quick                      small flows, one minute

All runs of one turn come after one another, so that a drift of the machine's speed meets all.  Times are processor times of the
time loop.  Printed: medians of particle-steps per second (particles of walls and zones count), the share of LAMMPS's section Neigh, the
steps for which a list lasts, and the median, smallest and largest ratio of the runs of one turn.
"""

import argparse
import math
import os
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from run import HERE, parsed, ratio

EXAMPLES = HERE.parent / "examples"
PERIODIC = HERE / "in.bench"
MACH = {"mach": 0.1, "dt": 0.35}

# name -> (input, variables, those of --quick).  The cavity and the cylinder run the inputs of the examples, to an early time.
FLOWS = {
    "pair loops alone": (PERIODIC, {"n": 40, "steps": 50}, {"n": 24}),
    "Taylor-Green, Mach 0.1": (PERIODIC, {"n": 40, "steps": 50, **MACH}, {"n": 24}),
    "lid-driven cavity": (EXAMPLES / "cavity" / "in.cavity", {"N": 100, "c0": 5, "end": 0.15, "mean": 0.15, "sample": 20}, {"N": 80}),
    "cylinder, open ends": (EXAMPLES / "cylinder" / "in.cylinder", {"n": 12, "end": 1, "mean": 1}, {"n": 6}),
}
PEER_FLOW = "Taylor-Green, Mach 0.1"
PEERS = {"lammps": ("sph/rhosum + sph/taitwater/morris", 20), "rheo": ("rheo, quintic", 5)}    # name, steps


def launch(lmp, flow, args, ranks=1, prefix=(), **changes):
    """Run a flow; return what the log says of its longest run."""
    script, variables, quick = FLOWS[flow]
    variables = {**variables, **(quick if args.quick else {}), **changes}
    command = [str(Path(lmp).resolve()), "-in", str(script), "-log", "none", "-nocite"]
    for name, value in variables.items():
        command += ["-var", name, *str(value).split()]
    command = [*prefix, *command]
    if ranks > 1:
        command = [args.mpiexec, "-n", str(ranks), *command]
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\nfailed:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return max(runs(done.stdout), key=lambda one: one["steps"])


def runs(log):
    """what LAMMPS has printed at the end of each run"""
    for part in log.split("\nLoop time of ")[1:]:
        seconds, steps, atoms = re.match(r"(\S+) on \d+ procs for (\d+) steps with (\d+) atoms", part).groups()
        seconds, steps, atoms = float(seconds), int(steps), int(atoms)
        if not steps:
            continue
        share = re.search(r"^([\d.]+)% CPU use", part, re.M)
        processor = seconds * min(float(share[1]) / 100, 1.0) if share and float(share[1]) else seconds
        neigh = re.search(r"^Neigh +\|[^|]*\| *(\S+)", part, re.M)
        builds = re.search(r"^Neighbor list builds = (\d+)", part, re.M)
        pairs = re.search(r"^Neighs: +(\S+) ave +(\S+) max", part, re.M)
        ghosts = re.search(r"^Nghost: +(\S+) ave", part, re.M)
        yield {"seconds": processor, "steps": steps, "atoms": atoms, "speed": atoms * steps / processor,
               "neigh": float(neigh[1]) / seconds if neigh else 0.0, "builds": int(builds[1]) if builds else 0,
               "ghosts": float(ghosts[1]) if ghosts else 0.0,
               "imbalance": float(pairs[2]) / float(pairs[1]) if pairs and float(pairs[1]) else 1.0}


def line(name, results):
    median = {key: statistics.median(one[key] for one in results) for key in results[0]}
    lists = f"{median['steps'] / median['builds']:8.1f}" if median["builds"] else f"{'-':>8}"
    print(f"  {name:<44} {median['atoms']:9.0f} {median['speed']:12.4g} {100 * median['neigh']:8.1f} {lists}", flush=True)


def has_style(lmp, name):
    done = subprocess.run([str(lmp), "-h"], capture_output=True, text=True)
    return re.search(rf"(?<!\S){name}(?!\S)", done.stdout) is not None


def compare(args):
    cases = {flow: (args.lmp, flow, {}) for flow in FLOWS}
    if args.against:
        cases.update({f"{flow} (against)": (args.against, flow, {}) for flow in FLOWS})
    for style, (name, steps) in PEERS.items():
        if has_style(args.peers, name.split(",")[0].split()[0]):
            cases[f"... {name}"] = (args.peers, PEER_FLOW, {"style": style, "steps": steps})
    if args.only:
        cases = {name: case for name, case in cases.items() if re.search(args.only, name)}
    results = {name: [] for name in cases}
    for _ in range(args.repeat):
        for name, (lmp, flow, changes) in cases.items():
            results[name].append(launch(lmp, flow, args, args.ranks, **changes))
    print(f"\n{args.ranks} rank{'s' if args.ranks > 1 else ''}, median of {args.repeat} runs each, in turn")
    print(f"  {'':<44} {'particles':>9} {'p.-steps/s':>12} {'Neigh, %':>8} {'list':>8}")
    for name, those in results.items():
        line(name, those)
    times = {name: [1.0 / one["speed"] for one in those] for name, those in results.items()}
    for flow in FLOWS:
        if flow in times and f"{flow} (against)" in times:
            ratio(times[f"{flow} (against)"], times[flow], f"speed over the other executable, {flow}")
    for name, _ in PEERS.values():
        if PEER_FLOW in times and f"... {name}" in times:
            ratio(times[f"... {name}"], times[PEER_FLOW], f"speed of sph/bulk over {name}, {PEER_FLOW}")


# -- Several ranks ------------------------------------------------------------------------------------------------

COUNTS = ("messages", "bytes", "reductions", "reduced")


def messages(flow, ranks, args, library):
    """per step, mean of the ranks: messages, their bytes, collective operations, their bytes; and the log of the longer run.
    The difference of two runs of the same start, one twice as long"""
    variables = FLOWS[flow][1]
    totals, results = [], []
    for factor in (1, 2):
        table = library.parent / "table.txt"
        changes = {key: variables[key] * factor for key in ("steps", "end", "mean") if key in variables}
        prefix = ["env", f"LD_PRELOAD={library}", f"MESSAGES={table}"]
        results.append(launch(args.lmp, flow, args, ranks, prefix, **changes))
        rows = [[int(n) for n in row.split()] for row in table.read_text().splitlines()]
        totals.append([statistics.mean(column) for column in zip(*rows)])
    steps = results[1]["steps"] - results[0]["steps"]
    return {key: max((b - a) / steps, 0.0) for key, a, b in zip(COUNTS, *totals)} | results[1]


def count(args):
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "libmessages.so"
        subprocess.run([os.environ.get("MPICC", "mpicc"), "-shared", "-fPIC", "-O2", str(HERE / "messages.c"), "-o", str(library)], check=True)
        print("\nper step and rank; imbalance: most pairs of a rank over the mean; ghosts: per particle")
        print(f"  {'':<26} {'ranks':>5} {'particles':>9} {'messages':>9} {'kB':>8} {'B/ghost':>8} {'collective':>10} {'kB':>6} {'imbalance':>9} {'ghosts':>7}")
        for flow in FLOWS:
            if args.only and not re.search(args.only, flow):
                continue
            for ranks in (1, 2, 4, 8, 16):
                one = messages(flow, ranks, args, library)
                each = one["bytes"] / one["ghosts"] if ranks > 1 else 0.0
                print(f"  {flow:<26} {ranks:5} {one['atoms'] / ranks:9.0f} {one['messages']:9.1f} {one['bytes'] / 1e3:8.1f} {each:8.0f} "
                      f"{one['reductions']:10.2f} {one['reduced'] / 1e3:6.2f} {one['imbalance']:9.2f} {one['ghosts'] * ranks / one['atoms']:7.2f}",
                      flush=True)


# Time of a step on a rank that has n particles and g ghosts, spacing 1: own n + ghost g + MESSAGES latency + BYTES g / bandwidth +
# REDUCTIONS 2 log2(ranks) latency, where a reduction goes up and down a tree.  own and ghost are measured on one rank; the others are
# counts of the Taylor-Green flow on 8 ranks.  The load is taken to be the same on all ranks.

REACH = 3.3           # support radius and skin
MESSAGES = 26.0       # per step
BYTES = 118.0         # per ghost and step
REDUCTIONS = 1.33     # per step


def ghosts_of(n):
    return (n ** (1 / 3) + 2 * REACH) ** 3 - n


def step_time(n, ranks, own, ghost, args):
    g = ghosts_of(n)
    time = own * n + ghost * g
    if ranks == 1:
        return time
    return time + BYTES * g / args.bandwidth + (MESSAGES + 2 * REDUCTIONS * math.log2(ranks)) * args.latency


def predict(args):
    own, ghost = args.costs
    print(f"\n{1e6 * own:.3f} us per particle and step, {1e6 * ghost:.3f} per ghost; {1e6 * args.latency:g} us per message, "
          f"{args.bandwidth / 1e9:g} GB/s per rank")
    print(f"  {'particles':>9} {'ranks at 80 %':>13} {'particles of each':>17} {'steps per second':>16}")
    for power in range(5, 9):
        total, one = 10**power, step_time(10**power, 1, own, ghost, args)
        ranks = 1
        while one / ((ranks + 1) * step_time(total / (ranks + 1), ranks + 1, own, ghost, args)) >= 0.8:
            ranks = max(ranks + 1, int(1.01 * ranks))
        print(f"  {total:9.0e} {ranks:13} {total / ranks:17.0f} {1 / step_time(total / ranks, ranks, own, ghost, args):16.1f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default=os.environ.get("SPHD_LMP", str(HERE.parent / "build" / "lmp")))
    parser.add_argument("--against", help="another executable, for the same flows in turn")
    parser.add_argument("--peers", help="executable with LAMMPS's own styles (default: that of --lmp)")
    parser.add_argument("--mpiexec", default=os.environ.get("SPHD_MPIEXEC", "mpiexec"))
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--repeat", type=int, help="runs of each, in turn (default: 7; with --quick 3)")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", help="lines of the table whose names have this in them")
    parser.add_argument("--messages", action="store_true", help="count messages on 1, 2, 4, 8 and 16 ranks, and predict the scaling")
    parser.add_argument("--costs", type=float, nargs=2, default=[0.43e-6, 0.065e-6], metavar=("OWN", "GHOST"),
                        help="seconds per particle and per ghost (default: those of README.md)")
    parser.add_argument("--latency", type=float, default=2e-6, help="of a message, seconds")
    parser.add_argument("--bandwidth", type=float, default=1.6e9, help="bytes per second of each rank")
    args = parsed(parser)
    args.peers = args.peers or args.lmp
    args.repeat = args.repeat or (3 if args.quick else 7)
    if args.messages:
        count(args)
        predict(args)
    else:
        compare(args)


if __name__ == "__main__":
    main()
