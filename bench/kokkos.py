#!/usr/bin/env python3
"""Time the styles with the suffix kk, by a LAMMPS with the package KOKKOS, on the particles of bench/run.py.

    ./sphd bench --kokkos                     LAMMPS's own CPU styles, sph/bulk, sph/bulk/kk with one thread and with two,
                                              the last ones between walls and with thermal noise as well
    ./sphd bench --kokkos --scaling           strong scaling of sph/bulk and sph/micropolar over MPI ranks, and of /kk over threads
    ./sphd bench --kokkos cuda --gpu          atom-steps per second on one GPU, for 0.1, 1, 10 and 30 million particles

All runs of one table are in turn, from the same executable.  Printed: medians, and the median, smallest and largest ratio of the
runs of one turn.
"""

import argparse
import os
import statistics
import sys

import run as bench

FASTER = 1.2  # what --check asks for: /kk on one thread over LAMMPS's own CPU styles
THREADS = 1.8  # two threads over one
MORE = {"between walls": {"wall": "slip no"}, "with noise": {"noise": bench.NOISE}}
SIDES = (46, 100, 215, 311)  # particles per side: 0.1, 1, 10, 30 million


def suffix(threads=None, name="kk"):
    return ["-k", "on", *(["t", str(threads)] if threads else ["g", "1"]), "-sf", name]


def times(cases, args):
    """cases: name -> (style, ranks, switches, more arguments of run()); seconds of each of the runs, in turn, and # of atoms
    and pairs."""
    seconds = {name: [] for name in cases}
    for _ in range(args.repeat):
        for name, (style, ranks, switches, *more) in cases.items():
            elapsed, atoms, _, pairs, _ = bench.run(style, ranks, args, switches=switches, **dict(*more))
            seconds[name].append(elapsed)
    return seconds, atoms, pairs


def table(seconds, atoms, args):
    for name, elapsed in seconds.items():
        print(f"  {name:<44} {args.steps * atoms / statistics.median(elapsed):12.4g} atom-steps/s", flush=True)


def compare(args):
    cases = {"lammps": ("lammps", 1, []), "bulk": ("bulk", 1, []), "kk, 1 thread": ("bulk", 1, suffix(1)),
             "kk, 2 threads": ("bulk", 1, suffix(2)), "loops of a GPU, 1 thread": ("bulk", 1, suffix(1, "kk/device"))}
    seconds, atoms, _ = times(cases, args)
    table(seconds, atoms, args)
    one = seconds["kk, 1 thread"]
    bench.ratio(seconds["bulk"], one, "sph/bulk/kk on one thread over sph/bulk")
    bench.ratio(seconds["loops of a GPU, 1 thread"], one, "... over the loops of a GPU on one thread")
    faster = bench.ratio(seconds["lammps"], one, "... over LAMMPS's CPU styles")
    threads = [bench.ratio(one, seconds["kk, 2 threads"], "two threads over one")]
    cases = {f"kk {what}, {n}": ("bulk", 1, suffix(n), more) for what, more in MORE.items() for n in (1, 2)}
    seconds, _, _ = times(cases, args)
    threads += [bench.ratio(seconds[f"kk {what}, 1"], seconds[f"kk {what}, 2"], f"... {what}") for what in MORE]
    if args.check and (faster < FASTER or min(threads) < THREADS):
        sys.exit("slower than it should be")


def scaling(args):
    most = os.cpu_count()
    numbers = [n for n in (1, 2, 4, 8, 16, 32, 64, 128, 256) if n < most] + [most]
    for style in ("bulk", "micropolar"):
        cases = {f"sph/{style}, {n} ranks": (style, n, []) for n in numbers}
        cases.update({f"sph/{style}/kk, {n} threads": (style, 1, suffix(n)) for n in numbers})
        seconds, atoms, _ = times(cases, args)
        table(seconds, atoms, args)
        for name, elapsed in seconds.items():
            alone = seconds[f"sph/{style}, 1 ranks" if "ranks" in name else f"sph/{style}/kk, 1 threads"]
            bench.ratio(alone, elapsed, f"speed of {name} over that of one")


def gpu(args):
    for style in ("bulk", "micropolar"):
        for n in SIDES:
            args.n = n
            seconds, atoms, pairs = times({f"sph/{style}/kk, {n**3} particles": (style, 1, suffix())}, args)
            table(seconds, atoms, args)
            for elapsed in seconds.values():
                print(f"    {args.steps * pairs / statistics.median(elapsed):.4g} pairs/s", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default=os.environ.get("SPHD_LMP", str(bench.HERE.parent / "build" / "lmp_kokkos")))
    parser.add_argument("--mpiexec", default=os.environ.get("SPHD_MPIEXEC", "mpiexec"))
    parser.add_argument("--n", type=int, default=40, help="particles per side (40: 64,000 particles)")
    parser.add_argument("--steps", type=int, default=50)
    parser.add_argument("--repeat", type=int, default=7, help="runs of each, in turn")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--scaling", action="store_true", help="over all cores of the machine, 1, 2, 4, ... of them")
    what.add_argument("--gpu", action="store_true", help="on one GPU")
    what.add_argument("--check", action="store_true",
                      help=f"fail if sph/bulk/kk on one thread is not {FASTER} times as fast as LAMMPS's CPU styles, or "
                           f"on two threads not {THREADS} times as fast as on one, between walls and with noise as well")
    args = bench.parsed(parser)
    args.simd = "auto"
    (scaling if args.scaling else gpu if args.gpu else compare)(args)


if __name__ == "__main__":
    main()
