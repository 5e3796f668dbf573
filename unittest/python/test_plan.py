"""The inputs that ./sphd plan prints run, and its time steps are those of the pair style's table."""

import re
import subprocess
import sys
from pathlib import Path

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
    assert not result.warnings
    limits = {name: step for name, step in plan.limits.items() if step < 1e300}
    assert table(result.log) == pytest.approx({**limits, "all": plan.largest}, rel=5e-4)    # four digits
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


@pytest.mark.parametrize("case, message", [
    (BOX, "give --fluid"), (f"--fluid mud {BOX}", "no fluid mud"), (f"--fluid water --mu 1 {BOX}", "give --fluid"),
    (f"--rho 1 {BOX}", "--mu is missing"), (f"--rho 1 --mu 1 {BOX} --c real", "for --fluid"), (f"--rho 0 --mu 1 {BOX}", "must be > 0"),
    (f"--rho 1 --mu 1 {BOX} --support 7", "two support radii"), (f"--rho 1 --mu 1 {BOX} --dim 3 --shear morris", "give --kappa"),
    (f"--rho 1 --mu 1 {BOX} --fraction 2", "--fraction")])
def test_errors(case, message):
    done = printed(case)
    assert done.returncode != 0 and message in done.stderr


def test_page():
    """The page about numbers has what the command prints."""
    page = (ROOT / "doc" / "src" / "Howto_sph_numbers.rst").read_text()
    case = re.search(r"^   \./sphd plan (--rho.*)$", page, re.MULTILINE)[1]
    block = "".join(f"   {line}".rstrip() + "\n" for line in planner.Plan(planner.arguments(case.split())).input().splitlines())
    assert block in page
