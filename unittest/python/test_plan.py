"""The inputs that ./sphd plan prints run, and its time steps are those of the pair style's table."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from helpers import LMP

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import plan as planner  # noqa: E402

BOX = "--length 2 --velocity 0.7 --particles 12"
WATER = "--fluid water --length 1e-6 --velocity 100 --particles 14"
CASES = [f"--rho 1.2 --mu {mu} --kappa {kappa} {BOX} --kernel {kernel} --support 3.5"
         for kernel, mu, kappa in [("wendland/c2", 0.1, 0.2), ("wendland/c4", 0.5, 0.3), ("wendland/c6", 0.5, 1.0), ("cubic", 0.5, 3.0),
                                   ("quintic", 0.5, 3.0), ("lucy", 0.5, 30.0)]]
CASES += [f"{case} --dim 3" for case in CASES]
CASES += [f"--rho 1.2 --mu 0.8 --kappa 0.5 {BOX} --dim {dim} --shear {shear}" for dim in (2, 3) for shear in ("mg/fr", "morris", "espanol")]
CASES += [f"--rho 1.2 --mu 0.8 {BOX}", f"--rho 1.2 --mu 0 --kappa 0.5 {BOX}", f"--rho 1000 --mu 1e-3 {BOX} --units si",
          WATER, f"{WATER} --dim 3 --c real", "--fluid CO2 --length 1 --velocity 1 --particles 12 --c 200",
          "--fluid CO2 --length 1e-3 --velocity 1 --particles 14 --c real", "--fluid CO2 --length 1e-6 --velocity 1 --particles 14",
          "--fluid CO2 --length 1e-4 --velocity 1 --particles 14 --dim 3",
          "--rho 1 --mu 0.5 --kappa 0 --length 16 --velocity 0.1 --c 3 --particles 16 --temperature 0.02"]


def table(log):
    """{column: largest stable time step} of the pair style's table"""
    head, row = re.search(r"largest stable time step:(.*)\n *1-1 .*\|(.*)\n", log).groups()
    return {name: float(step) for name, step in zip(head.split(), row.split()) if step != "-"}


def printed(case, *more):
    return subprocess.run([str(ROOT / "sphd"), "plan", *case.split(), *more], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          check=False)


@pytest.mark.parametrize("case", CASES)
def test_plan(lammps, case):
    plan = planner.Plan(planner.arguments(case.split()))
    text = plan.input()
    result = lammps(re.sub(r"(variable +steps index) .*", r"\1 4", text))
    assert all(plan.wave and "shear elasticity" in line for line in result.warnings), result.warnings
    limits = {name: step for name, step in plan.limits.items() if step < 1e300}
    assert table(result.log) == pytest.approx({**limits, "all": plan.explicit}, rel=5e-4)    # four digits
    assert f"Created {plan.number} atoms" in result.log
    assert float(re.search(r"^timestep +(\S+)", text, re.MULTILINE)[1]) < plan.largest
    if "temperature" in case:
        rate = float(re.search(r"largest viscous rate times time step (\S+)", result.log)[1])
        assert rate == pytest.approx(plan.rate * plan.dt, rel=5e-3)


def test_command(tmp_path):
    """What the command prints is a LAMMPS input; it has measured how long a run takes."""
    done = printed(CASES[0], "--lmp", LMP)
    assert done.returncode == 0, done.stderr
    assert re.search(r"^# run time +about [\d.]+ \w+ of one core", done.stdout, re.MULTILINE)
    assert planner.Plan(planner.arguments(CASES[0].split())).input().split("\n\n")[1] in done.stdout
    assert "not measured" in printed(CASES[0], "--lmp", str(tmp_path / "none")).stdout


@pytest.mark.parametrize("fluid, length", [("water", 2e-7), ("CO2", 1e-3)])
def test_sound(lammps, fluid, length):
    """--c real prints a standing wave, whose period and decay are those that it says (errors of the lattice: 2 percent
    of the amplitude in 1.5 periods), without shift, with the right pressure."""
    plan = planner.Plan(planner.arguments(f"--fluid {fluid} --length {length} --velocity 0.1 --c real --particles 40 --support 6".split()))
    text = plan.input()
    assert "shift" not in text and f" pb {plan.rho * plan.c0**2:.6g} " in text
    period, decay = (float(word) for word in re.search(r"period of the wave (\S+), decay of its amplitude (\S+)", text).groups())
    steps = round(1.5 * period / plan.dt)
    (table,) = lammps(re.sub(r"(variable +steps index) .*", rf"\g<1> {steps}", re.sub(r"thermo  .*", "thermo 1", text))).thermo()
    t, amplitude = table["Time"], table["c_amplitude"]
    omega = 2 * np.pi / period
    exact = np.sqrt(omega**2 - decay**-2)
    shape = np.exp(-t / decay) * (np.cos(exact * t) - np.sin(exact * t) / (decay * exact))
    assert np.abs(amplitude / 0.1 - shape).max() < 0.025


def test_frequency_of_kappa():
    """... is looked up in the file of fluids."""
    assert planner.read_fluid("CO2")[4] == (0.0, 22e3) and planner.read_fluid("air")[4][0] == 1e5
    assert planner.read_fluid("water")[4] == (0.0, float("inf"))
    for case, note in [("--fluid CO2 --length 1e-3 --velocity 1 --c real", "kappa of CO2 holds below 22000 Hz, this has 2.67e+05"),
                       ("--fluid air --length 1 --velocity 1 --c real", "kappa of air holds above 100000 Hz, this has 344"),
                       ("--fluid CO2 --length 0.1 --velocity 1 --c real", ""), ("--fluid water --length 1e-6 --velocity 1", "")]:
        text = planner.Plan(planner.arguments(case.split())).input()
        assert note in text and ("holds" in text) == bool(note), text


@pytest.mark.parametrize("case, message", [
    (BOX, "give --fluid"), (f"--fluid mud {BOX}", "no fluid mud"), (f"--fluid water --mu 1 {BOX}", "give --fluid"),
    (f"--rho 1 {BOX}", "--mu is missing"), (f"--rho 1 --mu 1 {BOX} --c real", "for --fluid"), (f"--rho 0 --mu 1 {BOX}", "must be > 0"),
    (f"--rho 1 --mu 1 {BOX} --support 7", "two support radii"), (f"--rho 1 --mu 1 {BOX} --dim 3 --shear morris", "give --kappa"),
    (f"--rho 1 --mu 1 {BOX} --fraction 2", "--fraction"), (f"{WATER} --units lj", "leave --units out"),
    (f"{WATER} --time 1e9", "more than LAMMPS can run"), (f"{WATER} --lmp {ROOT}", "no program that can be run"),
    (f"{WATER} --lmp {ROOT}/README.md", "no program that can be run")])
def test_errors(case, message):
    done = printed(case)
    assert done.returncode != 0 and message in done.stderr


def test_page():
    """The page about numbers has what the command prints."""
    page = (ROOT / "doc" / "src" / "Howto_sph_numbers.rst").read_text()
    case = re.search(r"^   \./sphd plan (--rho.*)$", page, re.MULTILINE)[1]
    block = "".join(f"   {line}".rstrip() + "\n" for line in planner.Plan(planner.arguments(case.split())).input().splitlines())
    assert block in page
