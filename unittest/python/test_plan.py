"""The inputs that ./sphd plan prints run, and its time steps are those of the pair style's table."""

import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

from helpers import LMP
import sph_dissipation as sph
from sph_dissipation import fluids
from sph_dissipation import plan as planner

ROOT = Path(__file__).resolve().parents[2]
BOX = "--length 2 --velocity 0.7 --particles 12"
WATER = "--fluid water --length 1e-6 --velocity 100 --particles 14"
CASES = [f"--rho 1.2 --mu {mu} --kappa {kappa} {BOX} --kernel {kernel} --support 3.5"
         for kernel, mu, kappa in [("wendland/c2", 0.1, 0.2), ("wendland/c4", 0.5, 0.3), ("wendland/c6", 0.5, 1.0), ("cubic", 0.5, 3.0),
                                   ("quintic", 0.5, 3.0), ("lucy", 0.5, 30.0)]]
CASES += [f"{case} --dim 3" for case in CASES]
CASES += [f"--rho 1.2 --mu 0.8 --kappa 0.5 {BOX} --dim {dim} --shear {shear}" for dim in (2, 3) for shear in ("mg/fr", "morris", "espanol")]
CASES += [f"--rho 1.2 --mu 0.8 {BOX}", f"--rho 1.2 --mu 0 --kappa 0.5 {BOX}", f"--rho 1000 --mu 1e-3 {BOX} --units si",
          WATER, f"{WATER} --dim 3 --c real", "--fluid CO2 --length 1 --velocity 1 --particles 12 --c 200",
          "--fluid CO2 --length 1e-3 --velocity 1 --particles 14 --c real", "--fluid CO2 --frequency 30e3 --particles 14 --dim 3",
          "--fluid CO2 --wavelength 1 --particles 14", "--fluid air/50 --frequency 1e3 --particles 14", "--fluid He --wavelength 1e-4 --particles 14",
          "--fluid CO2 --length 1e-5 --velocity 1 --particles 14 --relax", "--rho 1 --mu 0.01 --kappa 0.1 --wavelength 2 --c 5 --particles 14",
          "--fluid CO2 --length 1e-6 --velocity 1 --particles 14",
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
    result = lammps(re.sub(r"(?m)^run .*", "run 4", text))
    assert not result.warnings, result.warnings
    limits = {name: step for name, step in plan.limits.items() if step < 1e300}
    assert table(result.log) == pytest.approx({**limits, "all": plan.explicit}, rel=5e-4)    # four digits
    assert f"Created {plan.number} atoms" in result.log
    assert float(re.search(r"^timestep +(\S+)", text, re.MULTILINE)[1]) / plan.largest < 1.0
    if "temperature" in case:
        rate = float(re.search(r"largest viscous rate times time step (\S+)", result.log)[1])
        assert rate == pytest.approx(plan.rate * plan.dt, rel=5e-3)


COLUMNS = ["--rho 1 --mu 1e-6 --column 1 --particles 10", "--fluid water --column 0.6 --tank 3.22 --particles 12 --kernel wendland/c4",
           "--rho 2 --mu 0.01 --kappa 0.3 --column 3 --width 2 --tank 2 --gravity 5 --particles 15 --shear mg/fr",
           "--rho 1000 --mu 1 --units si --column 0.1 --width 0.1 --dim 3 --particles 8",
           "--rho 1260 --mu 1.4 --units si --column 0.15 --width 0.3 --tank 0.8 --particles 20"]    # glycerol, which sticks to the walls


@pytest.mark.parametrize("case", COLUMNS)
def test_column(lammps, case):
    """A column in a tank: it starts with the hydrostatic pressure and without a warning; nobody leaves; at rest it stays."""
    plan = planner.Column(planner.arguments(case.split()))
    text = plan.input()
    steps = min(plan.steps, 400 if plan.dim == 2 else 30)
    result = lammps(re.sub(r"(?m)^run .*", f"run {steps}", text)
                    + 'print "largest $(bound(water,xmax)) $(bound(water,xmin)) $(bound(water,ymin))"\n')
    assert not result.warnings, result.warnings
    assert sum(int(count) for count in re.findall(r"Created (\d+) atoms", result.log)) == plan.number
    limits = table(result.log)
    assert {name: limits[name] for name in ("shear", "bulk", "diffusion")} == pytest.approx(
        {name: plan.limits[name] for name in ("shear", "bulk", "diffusion")}, rel=1e-3)
    assert plan.dt < plan.largest < limits["all"]
    assert re.search(r"sph/wall slip (\w+)", text)[1] == ("no" if "1260" in case else "free")
    right, left, low = (float(word) for word in re.search(r"^largest (.*)", result.output, re.MULTILINE)[1].split())
    assert min(left, low, plan.tank * plan.dx - right) > -0.15 * plan.dx
    first, last = (result.thermo()[0]["v_front"][k] for k in (0, -1))
    assert abs(first / (plan.width * plan.dx) - 1) < 1e-6 and (last - first > 0.1 * plan.dx) == (plan.falls and plan.dim == 2)
    columns = result.thermo()[0]
    if plan.falls:
        assert (columns["v_front"] <= columns["v_theory"] * (1 + 1e-6)).all()
    else:
        for name in ("c_push", "c_mean"):
            assert columns[name][1:].mean() == pytest.approx(columns["v_theory"][0], rel=0.03), name


@pytest.mark.parametrize("particles, error", [(15, 0.12), pytest.param(24, 0.1, marks=pytest.mark.long)])
def test_forces_of_a_dam_break(lammps, particles, error):
    """The force on the far wall and that of the pressure in the water next to it agree, once the wall is wet."""
    plan = planner.Column(planner.arguments(f"--rho 1 --mu 1e-6 --column 1 --particles {particles}".split()))
    (table,) = lammps(plan.input()).thermo()
    time, force = plan.measured(table)
    assert 2.0 < float(re.search(r"at the far wall at (\S+);", time)[1]) < 3.5 and "by the pressure in the water" in force
    wet = table["Time"] > 4.0
    assert table["c_push"][wet].mean() == pytest.approx(table["c_mean"][wet].mean(), rel=error)
    assert table["c_mean"][wet].mean() > 0.1 and not table["c_push"][table["Time"] < 1.5].any()


CHANNELS = {"--rho 1 --mu 0.1 --channel 1 --velocity 1 --particles 16": 0.004, "--rho 2 --mu 0.5 --kappa 2 --channel 2 --velocity 0.3 --particles 15 --c 5": 0.004,
            "--fluid water --channel 1e-3 --velocity 1e-3 --particles 12": 0.006, "--rho 1 --mu 0.1 --channel 1 --velocity 1 --yield 0.2 --particles 20": 0.01}


@pytest.mark.parametrize("case, error", CHANNELS.items())
def test_channel(lammps, case, error):
    """From rest to the exact mean velocity, profile, and stress, which a sum over the profile confirms."""
    plan = planner.Channel(planner.arguments(case.split()))
    result = lammps(plan.input())
    assert not result.warnings, result.warnings
    assert f"Created {plan.number} atoms" in result.log and table(result.log)["shear"] == pytest.approx(plan.limits["shear"], rel=5e-4)
    (columns,) = result.thermo()
    assert plan.measured(columns)[0].startswith("mean velocity ") and abs(float(re.search(r": (\S+) %", plan.measured(columns)[0])[1])) < 101 * error    # two digits
    assert columns["v_mean"][0] == 0.0 and columns["v_mean"][-1] == pytest.approx(columns["v_theory"][-1], rel=error)
    assert columns["v_stress"][-20:].mean() == pytest.approx(columns["v_balance"][-1], rel=0.005)
    y = np.linspace(-1, 1, 20001)
    u = np.array([plan.profile(place) for place in y])
    assert np.trapezoid(u, y) / 2 == pytest.approx(plan.mean(), rel=1e-6) if hasattr(np, "trapezoid") else np.trapz(u, y) / 2 == pytest.approx(plan.mean(), rel=1e-6)
    # the stress from the middle to the wall is linear: mu times the slope, and the yield stress
    half = plan.args.channel / 2
    assert plan.stress + plan.mu * (plan.profile(1 - 1e-6) - plan.profile(1)) / (1e-6 * half) == pytest.approx(plan.at_wall, rel=1e-5)
    assert plan.at_wall == pytest.approx(plan.force * plan.rho * half, rel=1e-9)
    *_, last = sph.frames(lammps.path("channel.dump")).values()
    inside = (last["y"] > 0) & (last["y"] < plan.args.channel)
    exact = np.array([plan.profile(place) for place in last["y"][inside] / half - 1])
    assert np.abs(last["vx"][inside] - exact).max() < 2.5 * error * plan.args.velocity


@pytest.mark.long
@pytest.mark.parametrize("rows, lacks", [(16, (0.06, 0.1)), (32, (-0.005, 0.005))])
def test_rows_of_a_channel(lammps, rows, lacks):
    """At a Reynolds number of 100, the mean velocity is below theory with too few rows, and correct with a third as many rows."""
    (columns,) = lammps(planner.Channel(planner.arguments(f"--rho 1 --mu 0.01 --channel 1 --velocity 1 --particles {rows}".split())).input(), timeout=1800).thermo()
    assert lacks[0] < 1.0 - columns["v_mean"][-1] / columns["v_theory"][-1] < lacks[1]


COLLOID = "--rho 1 --mu 0.07 --kappa 0.2 --colloid 2 --temperature 0.001"


@pytest.mark.parametrize("case, steps", [(COLLOID, 20), ("--fluid water --colloid 1e-6 --temperature 298", 20), ("--rho 2 --mu 1 --colloid 3 --temperature 0.1 --c 2", 20),
                                         pytest.param(COLLOID, None, marks=pytest.mark.long)])
def test_colloid(lammps, case, steps):
    """A sphere of particles without a warning; in a long run it has the kinetic energy of equipartition."""
    plan = planner.plan_of(planner.arguments(case.split()))
    text = re.sub(r"(?m)^run .*", f"run {steps}", plan.input()) if steps else plan.input()
    result = lammps(text, timeout=300)
    assert not result.warnings, result.warnings
    assert f"{plan.inside} settings made for type" in result.output and f"Created {plan.number} atoms" in result.log
    assert 0.08 < float(re.search(r"largest viscous rate times time step (\S+)", result.log)[1]) < 0.1    # also next to the body
    schmidt, diffusion = (float(re.search(rf"^# {name} +(\S+?)[ ,]", text, re.MULTILINE)[1]) for name in ("Schmidt number", "diffusion"))
    energy = (1.380649e-23 if plan.units == "si" else 1.0) * plan.args.temperature
    assert diffusion == pytest.approx(energy / (6 * np.pi * plan.mu * plan.args.colloid), rel=1e-3) and schmidt == pytest.approx(plan.mu / plan.rho / diffusion, rel=5e-3)
    if not steps:
        (columns,) = result.thermo()
        assert columns["f_K"][-1] == pytest.approx(columns["v_theory"][-1], rel=0.1)
        (line,) = plan.measured(columns)
        assert line.startswith("kinetic energy") and line.endswith("a statistical error of about 8 %")


FIRST = {"colloid": COLLOID, "sound": "--fluid CO2 --frequency 30e3", "column": "--fluid water --column 0.6 --tank 3.22", "channel": "--rho 1 --mu 0.1 --channel 1 --velocity 1 --yield 0.2",
         "flow": BOX.replace("0.7", "0.7 --rho 1 --mu 1")}


@pytest.mark.parametrize("name", FIRST)
def test_first_inputs_are_short(name):
    plan = planner.plan_of(planner.arguments(FIRST[name].split()))
    commands = [line for line in plan.input().splitlines() if line and not line.startswith("#")]
    assert plan.name == name and len(commands) <= 35 and any(f" {name}.dump " in line for line in commands)
    assert name == "flow" or any(line.startswith("thermo_style") and "v_theory" in line for line in commands)


def test_run_and_plot(tmp_path):
    """... write input, log, dump, and figure; another input that is there gets another name."""
    command = [str(ROOT / "sphd"), "plan", *"--rho 1 --mu 0.01 --kappa 0.1 --wavelength 2 --c 5 --particles 14 --time 1.2 --plot --lmp".split(), LMP]
    for _ in range(2):
        done = subprocess.run(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
        assert done.returncode == 0 and done.stdout.endswith("plan: wrote in.sound, log.sound, sound.dump, sound.png\n"), done.stderr
        assert re.search(r"^plan: frequency 2.\d+, theory 2.499: \S+ %\nplan: rate of decay ", done.stdout, re.MULTILINE)
    assert (tmp_path / "sound.png").read_bytes()[:4] == b"\x89PNG" and "v_theory" in (tmp_path / "log.sound").read_text()
    old = (tmp_path / "in.sound").read_text()
    (tmp_path / "in.sound.1").write_text("mine\n")
    done = subprocess.run([*command, "--velocity", "0.1"], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 0 and done.stdout.startswith("plan: in.sound was another input; it is now in.sound.2\n"), done.stderr
    assert (tmp_path / "in.sound.2").read_text() == old and (tmp_path / "in.sound.1").read_text() == "mine\n" and "velocity 0.1," in (tmp_path / "in.sound").read_text()


def test_narrow_column_in_a_short_tank(lammps):
    """Its spray rises above five times its height: nothing is lost."""
    plan = planner.Column(planner.arguments("--fluid water --column 0.2 --width 0.1 --tank 0.4 --particles 20".split()))
    assert lammps(plan.input() + "run 0\n").thermo()[0]["Step"][-1] == plan.steps


def test_command(tmp_path):
    """What the command prints is a LAMMPS input; it has measured how long a run takes."""
    done = printed(CASES[0], "--lmp", LMP)
    assert done.returncode == 0, done.stderr
    assert re.search(r"^# run time +about [\d.]+ \w+ of one core", done.stdout, re.MULTILINE)
    assert planner.Plan(planner.arguments(CASES[0].split())).input().split("\n\n")[1] in done.stdout
    assert "not measured" in printed(CASES[0], "--lmp", str(tmp_path / "none")).stdout


@pytest.mark.parametrize("wave", ["--fluid water --wavelength 2e-7", "--fluid CO2 --length 0.1 --velocity 0.1 --c real", "--fluid CO2 --frequency 30e3",
                                  "--fluid CO2 --frequency 300e3", "--fluid air/10 --wavelength 0.1"])
def test_sound(lammps, wave):
    """A standing wave has the period and the decay that are printed, by its equations, integrated here (errors of the lattice: 2.5
    percent of the amplitude in 1.5 periods), without shift, with the right pressure.  The kernel smooths the strain of a process twice:
    far above its relaxation that takes more particles."""
    plan = planner.Plan(planner.arguments(f"{wave} --velocity 0.01 --particles {60 if '300e3' in wave else 40} --support 6".split()))
    text = plan.input()
    assert "shift" not in text and f" pb {plan.rho * plan.c0**2:.6g} " in text
    rho, c0, mu, kappa = (float(word) for word in re.search(r"^pair_coeff +\* \* (\S+) (\S+) (\S+) (\S+)", text, re.MULTILINE).groups())
    words = re.search(r" relax (.*) pb", text)
    pairs = np.reshape([float(word) for word in words[1].split()] if words else [], (-1, 2))
    assert bool(words) == bool(plan.fluid.relax) == ("real" not in wave and "water" not in wave)
    wave_number = 2 * np.pi / plan.args.length
    box = re.search(r"^lattice +hex (\S+)\n.*block 0 (\d+)", text, re.MULTILINE)
    assert box[1] == f"{plan.args.length / int(box[2]):.8g}"
    # velocity u, relative density r = div of the displacement, strains x: u' = k (c0^2 r + sum g x) - nu k^2 u, r' = -k u, x' = r' - x/tau
    size = 2 + len(pairs)
    matrix = np.zeros((size, size))
    matrix[0, 0], matrix[0, 1], matrix[1, 0] = -(kappa + mu) / rho * wave_number**2, wave_number * c0**2, -wave_number
    for row, (kappa_r, tau) in enumerate(pairs, 2):
        matrix[0, row], matrix[row, 0], matrix[row, row] = wave_number * kappa_r / (rho * tau), -wave_number, -1 / tau
    rates, modes = np.linalg.eig(matrix)
    sound = rates[np.argmax(rates.imag)]
    period, decay = (float(word) for word in re.search(r"period of the wave (\S+), decay of its amplitude (\S+)", text).groups())
    assert (2 * np.pi / sound.imag, -1 / sound.real) == pytest.approx((period, decay), rel=1e-3)
    (table,) = lammps(re.sub(r"(?m)^run .*", f"run {round(1.5 * period / plan.dt)}", re.sub(r"thermo  .*", "thermo 1", text))).thermo()
    parts = np.linalg.solve(modes, np.eye(size)[0].astype(complex))
    exact = (modes[0] * parts @ np.exp(np.outer(rates, table["Time"]))).real
    assert np.abs(table["c_amplitude"] / 0.01 - exact).max() < 0.025
    # the printed theory is without the modes that do not oscillate
    assert np.abs(table["v_theory"] / 0.01 - exact).max() < (0.04 if words else 1e-4)


def test_wave_lasts(lammps):
    """With all defaults the wave decays as it is printed, to the end: the lattice under the background pressure holds."""
    plan = planner.Plan(planner.arguments("--fluid CO2 --frequency 30e3".split()))
    (table,) = lammps(plan.input()).thermo()
    # what is measured differs from theory by the errors that the header has
    header = re.search(r"errors +frequency (\S+) %, decay (\S+) %", plan.input()).groups()
    for line, what, error in zip(plan.measured(table), (r"frequency 2.99\de.04, theory", "rate of decay 39.., theory"), header):
        assert re.match(what, line) and float(re.search(r": (\S+) %", line)[1]) == pytest.approx(float(error), rel=0.15)
    decay = np.exp(plan.fluid.standing_wave(plan.args.length).real * table["Time"])
    assert table["Time"][-1] * 30e3 > 10 and np.abs(table["c_amplitude"] / plan.args.velocity / decay).max() < 1.1


LJ = "--rho 1.3 --wavelength 2 --c 1.5"


@pytest.mark.parametrize("case", [
    f"{LJ} --mu 0.02 --kappa 0.05 --particles 20", f"{LJ} --mu 0.02 --kappa 0.05 --particles 20 --kernel wendland/c2",
    f"{LJ} --mu 0.02 --kappa 0.05 --particles 30 --support 4 --kernel wendland/c2",
    f"{LJ} --mu 0.01 --kappa 0.08 --particles 24 --kernel wendland/c4 --shear mg/fr", f"{LJ} --mu 0.05 --kappa 0 --particles 24 --kernel quintic --shear morris",
    f"{LJ} --mu 0.04 --kappa 0.02 --particles 24 --kernel cubic --support 5 --shear espanol", f"{LJ} --mu 0.02 --kappa 0.03 --particles 10 --dim 3 --support 4 --kernel wendland/c2",
    f"{LJ} --mu 0.05 --kappa 0.01 --particles 10 --dim 3 --support 4 --kernel wendland/c6 --shear morris", "--fluid CO2 --frequency 30e3 --particles 30",
    "--fluid air/50 --wavelength 0.05 --particles 24 --kernel lucy"])
def test_errors_of_sound(lammps, case):
    """Frequency and decay of the wave in LAMMPS are off by what is printed, within a quarter of it."""
    plan = planner.Plan(planner.arguments(case.split()))
    text = plan.input()
    printed = re.search(r"^# errors +frequency (\S+) %, decay (\S+) %", text, re.MULTILINE).groups()
    every = max(1, round(plan.args.length / plan.c0 / plan.dt / 12))
    text = re.sub(r"(?m)^run .*", f"run {48 * every}", re.sub(r"thermo  .*", f"thermo {every}", text))
    (table,) = lammps(text).thermo()
    s = max(sph.exponents(every * plan.dt, table["c_amplitude"], 2 + len(plan.fluid.relax)), key=lambda mode: mode.imag)
    rho, mu, zeta = plan.rho, plan.mu, plan.zeta
    k2 = (2 * np.pi / plan.args.length)**2
    longitudinal = zeta + mu * {"mg": 3, "mg/fr": 3, "morris": 1, "espanol": 1 + 2 / (plan.dim + 3)}[plan.args.shear]    # eq. "limits"
    # s^2 + s D + w^2 + s sum(g/(1 + s tau)) = 0 as a polynomial
    polynomial = np.polynomial.Polynomial([k2 * plan.c0**2, k2 * longitudinal / rho, 1])
    others = np.polynomial.Polynomial([1])
    for kappa, tau in plan.fluid.relax:
        process = np.polynomial.Polynomial([1, tau])
        polynomial = polynomial * process + others * np.polynomial.Polynomial([0, k2 * kappa / rho])
        others = others * process
    exact = max(polynomial.roots(), key=lambda root: root.imag)
    found = 100 * (s.imag / exact.imag - 1), 100 * (s.real / exact.real - 1)
    print(case, printed, found)
    for measured, word in zip(found, printed):
        assert measured == pytest.approx(float(word), rel=0.25)


def test_wave_that_dies_at_once():
    for case, dies in [("--fluid water --wavelength 1e-10", True), ("--fluid water --wavelength 1e-8", False),
                       ("--rho 1 --mu 0 --kappa 0 --c 10 --frequency 2", False)]:
        text = planner.Plan(planner.arguments(case.split())).input()
        assert ("does not outlive a period" in text) == dies and ("period of the wave" in text) != dies


def test_frequency_of_kappa():
    """... is looked up in the files of fluids; a gas says it by its slowest process, and by rotation."""
    assert fluids.find("air").valid == (1e5, np.inf) and fluids.find("mercury").valid == (0.0, np.inf)
    assert fluids.find("water").valid == (0.0, 1e8) and fluids.find("water").measured
    slow = fluids.find("CO2").constant()
    assert slow.valid[1] == pytest.approx(0.1 / (2 * np.pi * 5.1035e-6)) and slow.kappa == pytest.approx(5.8163e-2 + 6.15e-6)
    assert fluids.find("He").valid == (0.0, np.inf)
    for case, note in [("--fluid CO2 --length 1e-3 --velocity 1 --c real", "relaxes; the constant 0.05817 in its place holds below 3119 Hz"),
                       ("--fluid CO2 --length 1e-5 --velocity 1", "kappa of CO2 holds below 3119 Hz, this has 1e+05"),
                       ("--fluid N2 --wavelength 1e-6", "kappa of N2 holds below 3.286e+07 Hz, this has 3.53e+08"),
                       ("--fluid air --length 1 --velocity 1 --c real", "kappa of air holds above 1e+05 Hz, this has 347"),
                       ("--fluid water --wavelength 1e-6", "kappa of water was measured below 1e+08 Hz, this has 1.5e+09"),
                       ("--fluid CO2 --length 0.1 --velocity 1 --c real", ""), ("--fluid water --length 1e-6 --velocity 1", "")]:
        text = planner.Plan(planner.arguments(case.split())).input()
        assert note in text and ("Hz" in text) == bool(note), text


def test_a_kappa_that_is_not_given():
    """... is named in the first line."""
    for case, note in [(f"--rho 1.2 --mu 0.8 {BOX} --shear mg", "; kappa NOT GIVEN: 1.6, what shear mg brings along"),
                       (f"--rho 1.2 --mu 0.3 {BOX} --dim 3 --shear espanol", "; kappa NOT GIVEN: 0, what shear espanol brings along"),
                       ("--rho 1 --mu 1e-3 --column 1", "; kappa NOT GIVEN: 0.12, which damps sound"), ("--rho 1 --mu 1e-3 --kappa 0 --column 1", ""),
                       ("--fluid water --column 1", ""), (WATER, ""), (f"--rho 1.2 --mu 0.8 --kappa 0 {BOX}", "")]:
        args = planner.arguments(case.split())
        first, *others = (planner.Column if args.column else planner.Plan)(args).input().splitlines()
        assert first.endswith(f"units {'si' if args.fluid else 'lj'}{note}") and "NOT GIVEN" not in "".join(others)


def test_notes_in_the_header():
    """... on the dimension of kappa, on gravity, and on a channel at a large Reynolds number."""
    sound, channel = "--rho 1 --mu 0.03 --kappa 0.1 --wavelength 2 --c 5 --particles 14", "--rho 1 --channel 1 --velocity 1 --mu"
    for case, note, there in [(sound, "has kappa + mu/3 = 0.11 here", True), (f"{sound} --dim 3", "kappa + mu/3", False), ("--fluid water --wavelength 1e-6", "kappa + mu/3", False),
                              (f"{channel} 0.01 --particles 16", "take --particles 25: fewer rows may break up", True), (f"{channel} 0.01", "may break up", False),
                              ("--rho 1 --mu 1e-6 --column 1", "; gravity 1;", True), ("--fluid water --column 1", "; gravity 9.81;", True)]:
        assert (note in planner.plan_of(planner.arguments(case.split())).input()) == there, case


def test_proposal():
    """A flow for which the constant does not hold gets the lines of the relaxing form, those that --relax prints."""
    case = "--fluid CO2 --length 1e-5 --velocity 1"
    plain, relaxing = (planner.Plan(planner.arguments(f"{case} {more}".split())).input() for more in ("", "--relax"))
    for command in ("atom_style", "pair_coeff"):
        proposed = re.search(rf"^# +{command} +(.*)$", plain, re.MULTILINE)[1]
        assert re.search(rf"^{command} +(.*?)( +#.*)?$", relaxing, re.MULTILINE)[1] == proposed
    assert "viscous implicit" in plain and "implicit" not in relaxing


@pytest.mark.parametrize("case, message", [
    ("--fluid water --length 1", "give --length and --velocity, or"), ("--fluid water --length 1 --wavelength 1", "give --length and --velocity, or"),
    ("--fluid water --frequency 1 --wavelength 1", "or --frequency"), ("--fluid He --wavelength 1 --relax", "--relax is for a gas"),
    ("--rho 1 --mu 1 --wavelength 1", "needs its speed after --c, for instance --c 1920"), ("--fluid toluene --rho 900", "--rho cannot be given with --fluid"),
    ("--fluid toluene --kappa 5e-3", "--kappa cannot be given with --fluid"), ("--fluid water --mu 0", "--mu cannot be given with --fluid"),
    ("--column 0.3", "give --fluid, or --rho and --mu\n"), ("--wavelength 1", "or --rho, --mu, --kappa, and --c\n"),
    ("--fluid glycerol --wavelength 1", "give --rho, --mu, --kappa, --c, and --units si"), ("--fluid glycerol --column 1", "give --rho, --mu, --kappa, and --units si"),
    (f"{COLLOID} --dim 2", "--dim 2 is not for --colloid; the page Howto_sph_bodies has"), ("--rho 1 --mu 1 --wavelength 1 --c 5", "give --kappa"), ("--rho 1 --mu 1 --frequency 1 --c 5", "give --kappa"),
    ("--rho 1 --mu 1 --column 1 --length 1", "--length is not for --column"), ("--rho 1 --mu 1 --column 1 --velocity 1", "--velocity is not for --column"),
    ("--rho 1 --mu 1 --colloid 1", "--colloid needs --temperature"), ("--rho 1 --mu 0 --colloid 1 --temperature 1", "a shear viscosity"),
    ("--rho 1 --mu 1 --colloid 1 --temperature 1 --length 1", "--length is not for --colloid"),
    ("--rho 1 --mu 1 --colloid 1 --temperature 1 --particles 5", "less than two support radii"), ("--rho 1 --mu 1 --colloid 1 --channel 1 --velocity 1", "--colloid is not for --channel"),
    ("--rho 1 --mu 1 --channel 1", "--channel needs --velocity"), ("--rho 1 --mu 0 --channel 1 --velocity 1", "with a shear viscosity"),
    ("--rho 1 --mu 1 --channel 1 --velocity 1 --dim 3", "--dim 3 is not for --channel"), ("--rho 1 --mu 1 --channel 1 --velocity 1 --temperature 1", "--temperature is not for --channel"),
    ("--rho 1 --mu 1 --channel 1 --velocity 1 --yield 1 --shear morris", "--yield is for --shear mg and mg/fr2, not morris"),
    (f"--rho 1 --mu 1 {BOX} --yield 1", "--yield is for --channel"), (f"--rho 1 --mu 1 {BOX} --plot", "--plot draws what a theory tells"),
    (f"--rho 1 --mu 1 {BOX} --run --lmp none", "--run needs LAMMPS"), ("--rho 1 --mu 1 --channel 1 --velocity 1 --support 1", "reaches no neighbor in a row"),
    ("--rho 1 --mu 1 --column 1 --width 3 --tank 2", "shorter than the column is wide"), ("--rho 1 --mu 1 --column 1 --tank 1", "give --width"),
    ("--rho 1 --mu 1 --column 1 --tank 2", "give --width"), ("--rho 1 --mu 1 --length 1 --velocity 1 --tank 3", "are for --column"),
    ("--rho 1 --mu 1 --column 1 --shear morris", "torque at a free surface"), ("--rho 1 --mu 1 --column 1 --temperature 1", "--temperature is not"), ("--fluid air/101 --wavelength 1", "no fluid air/101"),
    ("--fluid air/50/0 --wavelength 1", "no fluid air/50/0"), ("--fluid air/50/20 --frequency 1e3", "no fluid air/50/20: ISO 9613-1 holds from 253 to 323 K"),
    ("--fluid air/50/1e308 --frequency 1e3", "253 to 323 K"), ("--fluid air/50/293/1e308 --wavelength 1", "up to 200e3 Pa"),
    ("--fluid air/50/293/1e-300 --wavelength 1", "water boils"), ("--fluid air/wet --wavelength 1", "no fluid air/wet: air/HUMIDITY["),
    ("--fluid water --length 1e-300 --velocity 1e-300", "beyond what a computer"), ("--fluid water --length 1e300 --velocity 1e-300", "beyond what a computer"),
    ("--fluid CO2 --frequency 1e-300", "beyond what a computer"), ("--rho 1 --mu 1e-320 --kappa 0 --length 1e-10 --velocity 1", "beyond what a computer"),
    ("--rho 1e-300 --mu 1e300 --length 1 --velocity 1", "beyond what a computer"),
    (f"--rho 1 --mu 1 {BOX} --support 1.07", "reaches no neighbor of this lattice, the nearest are at 1.07"),
    (f"--rho 1 --mu 1 {BOX} --dim 3 --support 1.09", "reaches no neighbor of this lattice, the nearest are at 1.09"), (BOX, "give --fluid"), (f"--fluid mud {BOX}", "no fluid mud"), (f"--fluid methanole {BOX}", "which have: methanol "), ("--fluid CO2 --frequency 40kHz", "a number without a unit, such as 40e3, not 40kHz"), (f"--fluid water --mu 1 {BOX}", "--mu cannot be given with --fluid"),
    (f"--rho 1 {BOX}", "--mu is missing"), (f"--rho 1 --mu 1 {BOX} --c real", "for --fluid"), (f"--rho 0 --mu 1 {BOX}", "must be > 0"),
    (f"--rho 1 --mu 1 {BOX} --support 7", "two support radii"), (f"--rho 1 --mu 1 {BOX} --dim 3 --shear morris", "give --kappa"),
    (f"--rho 1 --mu 1 {BOX} --fraction 2", "--fraction"), (f"{WATER} --units lj", "leave --units out"),
    (f"{WATER} --time 1e9", "more than LAMMPS can run"), (f"{WATER} --lmp {ROOT}", "no program that can be run"),
    (f"{WATER} --lmp {ROOT}/README.md", "no program that can be run"),
    ("--fluid water --wavelength 1 --support 1e5 --particles 1000000", "3.1e+10 neighbors"),
    ("--fluid water --wavelength 1 --dim 3 --particles 3000", "these are 2.7e+10 particles, and LAMMPS numbers at most 2147483647"),
    ("--fluid water --column 1 --dim 3 --particles 3000", "these are 2.74e+10 particles")])
def test_errors(case, message):
    done = printed(case)
    assert done.returncode != 0 and message in done.stderr and "Traceback" not in done.stderr


def test_failures_of_the_system(tmp_path):
    """... of the output, of a LAMMPS that is none, and of the folder for temporary files end in one line."""
    other = tmp_path / "other"
    other.write_text("#!/no/such/program\n")
    other.chmod(0o755)
    for words, variables, message in [(f"--lmp {tmp_path}/none >/dev/full", {}, "plan: No space left on device\n"),
                                      (f"--lmp {tmp_path}/none | true; exit ${{PIPESTATUS[0]}}", {}, None),
                                      (f"--lmp {other}", {}, f"plan: {other}: No such file or directory\n"),
                                      (f"--lmp {LMP}", {"TMPDIR": str(tmp_path / "none")}, None)]:
        command = f"{ROOT}/sphd plan {CASES[0]} {words}"
        done = subprocess.run(["bash", "-c", command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False, env={**os.environ, **variables})
        assert done.stderr == message and done.returncode if message else not done.stderr


def test_modules_of_the_working_folder(tmp_path):
    """... are not run."""
    for name in ("sph_dissipation.py", "argparse.py", "re.py"):
        (tmp_path / name).write_text("raise SystemExit('of the working folder')\n")
    done = subprocess.run([str(ROOT / "sphd"), "plan", *CASES[0].split(), "--lmp", "none"], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          env={**os.environ, "PYTHONPATH": ""}, check=False)
    assert done.returncode == 0 and "pair_style" in done.stdout, done.stderr


def test_pages():
    """Pages have what the command prints."""
    found = []
    for page in (ROOT / "doc" / "src").glob("*.rst"):
        for case in re.findall(r"^   \./sphd plan (--.*)$", page.read_text(), re.MULTILINE):
            plan = planner.plan_of(planner.arguments(case.split()))
            found.append(plan.name)
            assert "".join(f"   {line}".rstrip() + "\n" for line in plan.input().splitlines()) in page.read_text(), case
    assert sorted(found) == ["channel", "channel", "column", "flow", "sound", "sound"]
