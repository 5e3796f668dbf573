"""Runs in.smoke with one LAMMPS executable; compares with the result of another one, if that is given."""
import argparse
import os
import subprocess
import sys

import numpy as np

TOLERANCE = 1e-12


def run(lmp, result, plugin):
    here = os.path.dirname(os.path.abspath(__file__))
    if os.path.exists(result):
        os.remove(result)
    script = result + ".in"
    with open(script, "w") as out:
        if plugin:
            out.write(f"plugin load {plugin}\n")
        out.write(f"include {here}/in.smoke\n")
    command = [lmp, "-in", script, "-log", result + ".log", "-var", "result", result]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True)
    if done.returncode:
        sys.exit(f"{' '.join(command)}\nstopped with code {done.returncode}:\n{done.stdout}")


def read(result):
    """The dumped columns of all snapshots in one array, and the line of totals."""
    rows, total = [], None
    with open(result) as lines:
        for line in lines:
            words = line.split()
            if words[0] == "total":
                total = np.array(words[1:], dtype=float)
            elif words[0] != "ITEM:" and len(words) > 4:
                rows.append(words)
    table = np.array(rows, dtype=float)
    if total is None or table.shape != (2 * 216, 14) or not np.isfinite(table).all():
        sys.exit(f"{result} is not the complete result of in.smoke")
    return table, total


def compare(result, reference):
    table, total = read(result)
    table_ref, total_ref = read(reference)
    scale = np.abs(table_ref).max(axis=0)
    if not (scale > 0).all():
        sys.exit(f"{reference}: a column is zero everywhere, the comparison would say nothing")
    error = max((np.abs(table - table_ref) / scale).max(), (np.abs(total - total_ref) / np.abs(total_ref)).max())
    print(f"largest relative difference {error:.2e}, allowed {TOLERANCE:.0e}")
    if not error <= TOLERANCE:
        sys.exit(f"{result} differs from {reference}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("lmp")
    parser.add_argument("result")
    parser.add_argument("--plugin")
    parser.add_argument("--reference")
    args = parser.parse_args()
    run(args.lmp, args.result, args.plugin)
    read(args.result)
    if args.reference:
        compare(args.result, args.reference)


main()
