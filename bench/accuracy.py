#!/usr/bin/env python3
"""Processor time that an error of 1 % takes, in eight flows (3 % where the table says so), and what LAMMPS's SPH and RHEO take for the same.

    ./sphd bench --accuracy                              all flows
    ./sphd bench --accuracy --peers build/peers/lmp      LAMMPS's styles in another executable, RHEO too if that has it
    ./sphd bench --accuracy --only channel               flows whose names have this in them

Each method has a ladder of settings, from coarse to fine.  Printed: error and processor time of the time loops of each setting, and for each
method the cheapest setting that is as exact as asked for, and from which on all finer ones are.
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from flows import EXAMPLES, has_style, runs
from run import HERE, parsed

sys.path.insert(0, str(HERE.parent / "python"))
from sph_dissipation import exponents, thermo      # noqa: E402

OWN = HERE / "in.accuracy"
METHODS = {"before": "sph/bulk, shear mg", "now": "sph/bulk as the manual advises for the flow: shear mg/fr2, and shift auto where it mixes",
           "lammps": "sph/rhosum + sph/taitwater/morris",
           "rheo": "RHEO, quintic, shift, interface/reconstruct"}
NEEDS = {"lammps": "sph/rhosum", "rheo": "rheo"}


def last(log, _):
    """of the value whose exact one is 1, at the end"""
    return thermo(log.read_text())[-1]["v_value"][-1] - 1


def steady(log, _):
    value = thermo(log.read_text())[-1]["v_value"]
    return value[-max(1, len(value) // 8):].mean() - 1


def decay(log, _):
    """of the rate at which a standing wave decays: s^2 + nu k^2 s + c^2 k^2 = 0 with nu = 0.02, c = 1"""
    table = thermo(log.read_text())[-1]
    value, time = table["v_value"], table["v_time"]
    found = max(exponents(time[1] - time[0], value[:-1], 2), key=lambda mode: mode.imag)
    return found.real / (-0.01 * (2 * np.pi)**2) - 1


def cavity(_, folder):
    """root mean square of the velocities on the middle lines beside a solution by finite differences, over that of the lid"""
    cells = np.loadtxt(folder / "cavity.cells.txt", skiprows=4)
    cells = cells[cells[:, 3] > 0]    # by round-off there may be a bin more, without particles
    m = round(len(cells)**0.5)
    u, v = (cells[:, column].reshape(m, m).T for column in (4, 5))
    exact = np.genfromtxt(EXAMPLES / "cavity" / "reference_profiles.csv", delimiter=",", names=True)
    s = (np.arange(m) + 0.5) / m
    middle = slice((m - 1) // 2, m // 2 + 1)
    errors = [u[:, middle].mean(axis=1) - np.interp(s, exact["s"], exact["u_re100"]), v[middle].mean(axis=0) - np.interp(s, exact["s"], exact["v_re100"])]
    return np.sqrt(np.mean(np.square(errors)))


def drag(_, folder):
    """beside that of finite elements in the same domain, at Re = 20"""
    time, value = np.loadtxt(folder / "cylinder.history.txt")[:, 1:3].T
    return value[time > time[-1] - 8].mean() / 2.33067 - 1


def front(_, folder):
    """of a dam break at t = 2, beside that of 64 particles per height"""
    time, place = np.loadtxt(folder / "dam_break.probe.txt").T[:2]
    return place[-1] / FRONT - 1


FRONT = 4.615


def ladder(*settings, **common):
    return [{**common, **one} for one in settings]


def by(name, *values):
    return [{name: value} for value in values]


def pairs(*values):
    """of rows and support"""
    return [{"n": n, "support": support} for n, support in values]


ROWS = {"before": pairs((20, 3), (20, 4), (20, 5), (20, 6), (22, 6), (24, 6), (28, 6), (40, 6)),
        "now": ladder(*by("n", 10, 14, 20, 28), shear="mg/fr2", support=3, kernel="quintic"), "lammps": ladder(*by("n", 20, 40))}

# flow: input, variables of all runs, error asked for, its measure, ladders
FLOWS = {
    "channel": (OWN, {"flow": "channel"}, 0.01, steady, {
        **ROWS, "rheo": ladder(*by("n", 10, 20, 28))}),
    "Couette flow": (OWN, {"flow": "couette"}, 0.01, steady, {
        **ROWS}),
    "channel in 3d": (OWN, {"flow": "channel", "dim": 3}, 0.01, steady, {
        "before": pairs((12, 4), (16, 4), (18, 4), (20, 4), (20, 5), (24, 5)),
        "now": ladder(*by("n", 10, 12, 16), shear="mg/fr2", support=3, kernel="quintic"),
        "lammps": ladder(*by("n", 12, 16))}),
    "Taylor-Green": (OWN, {"flow": "vortices"}, 0.01, last, {
        "before": ladder(*by("n", 24, 32, 40, 48, 56, 64), support=4, keywords="shift 1.0"),
        "now": ladder(*by("n", 24, 32, 40, 48, 56, 64), shear="mg/fr2", support=3, keywords="shift auto"),
        "lammps": ladder(*by("n", 48, 96)), "rheo": ladder(*by("n", 32, 48, 64))}),
    "cavity, Re = 100": (EXAMPLES / "cavity" / "in.cavity", {"Re": 100, "c0": 10, "pb": 0, "end": 16, "mean": 4}, 0.01, cavity, {
        "before": ladder(*by("N", 20, 24, 28, 32, 40), support=4), "now": ladder(*by("N", 20, 24, 28, 32, 40), shear="mg/fr2", support=3, shift="auto")}),
    "cylinder, Re = 20": (EXAMPLES / "cylinder" / "in.cylinder", {"Re": 20, "end": 24, "mean": 8}, 0.03, drag, {
        "before": ladder(*by("n", 4, 6, 8, 10), support=4), "now": ladder(*by("n", 4, 6, 8, 10), shear="mg/fr2", support=3, shift="auto")}),
    "sound": (OWN, {"flow": "sound"}, 0.01, decay, {
        "before": ladder(*by("n", 12, 16, 24, 32, 48), support=4), "now": ladder(*by("n", 12, 16, 24, 32, 48), kernel="wendland/c6", support=6),
        "lammps": ladder(*by("n", 24, 48)), "rheo": ladder(*by("n", 24, 48))}),
    "dam break": (EXAMPLES / "dam_break" / "in.dam_break", {"end": 2}, 0.03, front, {
        "before": ladder(*by("n", 8, 12, 16, 24, 32)), "now": ladder(*by("n", 8, 12, 16, 24, 32), shear="mg/fr2", support=3, shift="auto")}),
}


def launch(lmp, script, variables, measure):
    command = [str(Path(lmp).resolve()), "-in", str(script), "-log", "log.lammps", "-nocite"]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
        if done.returncode != 0:
            return None, 0.0, done.stdout[-300:]
        return measure(Path(folder) / "log.lammps", Path(folder)), sum(one["seconds"] for one in runs(done.stdout)), ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", default=os.environ.get("SPHD_LMP", str(HERE.parent / "build" / "lmp")))
    parser.add_argument("--peers", help="executable with LAMMPS's own styles (default: that of --lmp)")
    parser.add_argument("--only", help="flows whose names have this in them")
    args = parsed(parser)
    args.peers = args.peers or args.lmp
    summary = []
    for flow, (script, common, bar, measure, ladders) in FLOWS.items():
        if args.only and not re.search(args.only, flow):
            continue
        print(f"\n{flow}, error asked for {100 * bar:g} %", flush=True)
        cheapest = {}
        for method, rungs in ladders.items():
            lmp = args.peers if method in NEEDS else args.lmp
            if method in NEEDS and not has_style(lmp, NEEDS[method]):
                continue
            style = {"style": method if method in NEEDS else "bulk"} if script == OWN else {}
            results = []
            for rung in rungs:
                error, seconds, words = launch(lmp, script, {**common, **style, **rung}, measure)
                setting = " ".join(f"{name} {value}" for name, value in rung.items())
                print(f"  {method:<8} {setting:<52} {'failed ' + words if error is None else f'{100 * error:8.2f} %'} {seconds:9.2f} s", flush=True)
                results.append((error, seconds, setting))
            good = [error is not None and abs(error) <= bar for error, _, _ in results]
            first = next((i for i in range(len(good)) if all(good[i:])), None)
            cheapest[method] = None if first is None else min(results[first:], key=lambda one: one[1])
        summary.append((flow, bar, cheapest))
    print("\nprocessor time of the cheapest setting, seconds, over that of the second column; -: none of the ladder is as exact")
    print(f"  {'':<18} {'error':>6} " + "".join(f"{method:>18}" for method in METHODS))
    for flow, bar, cheapest in summary:
        base = cheapest.get("now")
        cells = [f"{'-':>18}" if not one else f"{one[1]:9.2f} ({one[1] / base[1]:5.1f})" if base else f"{one[1]:18.2f}" for one in map(cheapest.get, METHODS)]
        print(f"  {flow:<18} {100 * bar:4.0f} % " + "".join(f"{cell:>18}" for cell in cells))
    print("\n".join(f"  {name}: {title}" for name, title in METHODS.items()))


if __name__ == "__main__":
    main()
