"""Another unit changes no digit: with all numbers of an input times powers of two, all results are times powers of two.

The features of test_combinations.py, all pairs of them, and flows in three dimensions with walls, bodies, and laws that the
features do not have. The inputs name the unit of each number, see Units.
"""

from dataclasses import dataclass, replace

import numpy as np
import pytest

import test_combinations as combinations
from helpers import Lammps, Units, read_dump

# The roots that occur are powers of two as well. With noise, Boltzmann's constant ties the temperature to the energy.
SMALL, LARGE = dict(length=-36, time=-30, mass=-114), dict(length=24, time=48, mass=96)
NOISE = "noise", "warm"
COLUMNS = {"mass": "m", "v_m": "m", "x": "l", "y": "l", "z": "l", "vx": "v", "vy": "v", "vz": "v", "fx": "mv/t", "fy": "mv/t", "fz": "mv/t",
           "omegaz": "1/t", "tqx": "e", "tqz": "e", "d_solute": "1", "c_E[1]": "e", "c_E[2]": "e/t"}
RATES = {2: {"c_E[3]": "1/ll", "c_E[4]": "1/llt"}, 3: {"c_E[3]": "1/lll", "c_E[4]": "1/lllt"}}


def scales(names, dim=2):
    """Not of time where mu is a number per power of a time."""
    separate = ({}, {}) if set(names) & set(NOISE) else ({"temperature": 66}, {"temperature": -48})
    some = {"time": 0} if "thinning" in names else {}
    return [Units(**{**one, **other, **some}, dim=dim) for one, other in zip((SMALL, LARGE), separate, strict=True)]


@pytest.fixture(scope="module")
def lammps(tmp_path_factory):
    return Lammps(tmp_path_factory.mktemp("units"))


def outcome(lammps, name, units, ends):
    """{quantity: values in the units of the input}"""
    result = {}
    for end in ends:
        columns = read_dump(lammps.path(f"{name}.{end}"))[0].columns
        for one, unit in {**COLUMNS, **RATES[units.dim]}.items():
            if one in columns:
                result[f"{one} {end}"] = units.in_first(columns[one], unit)
    return result


def compare(one, other):
    assert one.keys() == other.keys()
    differences = {}
    for name, first in one.items():
        if first.shape != other[name].shape:
            differences[name] = "another number"
        elif not np.array_equal(first, other[name]):
            differences[name] = f"{np.abs(other[name] - first).max() / np.abs(first).max():.1e}"
    assert not differences, differences


def outcome_of_lines(lammps, lines, units):
    lammps(combinations.write(lammps.folder, "case", lines, units))
    return outcome(lammps, "case", units, ("after", "again"))


def check_features(lammps, names):
    check_lines(lammps, combinations.combined(names), names)


def check_lines(lammps, lines, names):
    first = outcome_of_lines(lammps, lines, Units())
    for units in scales(names):
        compare(first, outcome_of_lines(lammps, lines, units))


@pytest.mark.parametrize("name", combinations.FEATURES)
def test_feature(lammps, name):
    check_features(lammps, (name,))


@pytest.mark.long
@pytest.mark.parametrize("names", [names for names in combinations.PAIRS if len(names) > 1 and not combinations.refusal(names)],
                         ids="-".join)
def test_pair_of_features(lammps, names):
    check_features(lammps, names)


def ends(inlet, outlet):
    return combinations.Lines(particles=("zones",), fixes=(f"fix in inlet sph/open fluid 0 0 0 1 0 0 8[l] {inlet}",
                                                           f"fix out outlet sph/open fluid 16[l] 0 0 -1 0 0 8[l] {outlet}"))


OTHER_LINES = {
    "means": ends("velocity 0.5[v] 0 0 average 0.03[t]", "pressure 1.0[p] average 0.03[t] condition characteristic"),
    "fixed": ends("velocity 0.5[v] 0 0 density 1.01[r] condition fixed", "pressure inside velocity inside order 1 condition fixed"),
    "tait": combinations.Lines(pair=("eos tait tension yes density continuity delta 0.2",), keywords=("gamma 6.5",)),
}


@pytest.mark.parametrize("name", OTHER_LINES)
def test_other_lines(lammps, name):
    check_lines(lammps, OTHER_LINES[name], ())


def test_unit_of_time_of_a_power_law(lammps):
    """mu is a pressure times time^0.6, and pow() of another rate has other digits: of the viscosity, the last one."""
    lines = combinations.combined(("thinning",))
    time = -20
    first = outcome_of_lines(lammps, lines, Units())
    other = outcome_of_lines(lammps, replace(lines, mu=lines.mu * 2.0**(-0.4 * time)), Units(time=time))
    for name in first:
        assert np.abs(other[name] - first[name]).max() <= 1e-14 * np.abs(first[name]).max(), name


# ---------------------------------------------------------------------------------------------
# other flows


@dataclass(frozen=True)
class Flow:
    dim: int = 3
    walls: bool = False
    body: bool = False
    types: int = 1
    style: str = "sph/bulk"
    room: str = ""
    pair: str = ""
    spin: str = ""
    kappa: str = "2.0[pt]"
    coeff: str = ""
    second: str = ""    # of the other fluid
    unlike: str = ""
    integrator: str = ""
    fixes: str = ""
    values: tuple = ()    # printed at the end: what and its unit
    names: tuple = ()


SPIN = dict(style="sph/micropolar", spin="0.2[pt] 0.05[ptll] -0.05[ptll]")
HEAT = "cv 100.0[e/mT] conductivity 30.0[pll/tT]"
STICK = "fix low low sph/wall velocity 0.3[v] 0.1[v] 0 move no\nfix high high sph/wall\n"
ENERGY = "compute U all sph/energy\ncompute D all sph/dissipation\ncompute P all pressure NULL virial\n"
OF_ENERGY = (*((f"c_U[{k}]", "e") for k in (1, 2, 3, 4, 5)), *((f"c_D[{k}]", "e/t") for k in range(1, 8)),
             *((f"c_P[{k}]", "p") for k in (1, 2, 4)))
SPECTRUM = "compute S all sph/spectrum 8 8 8\n"
OF_SPECTRUM = tuple((f"c_S[{k}]", unit) for k, unit in enumerate(("vv", "vv", "1/tt", "1/tt", "p/t", "p/t", "rr", "p"), 1))
BODY = "fix turn ball rigid single\nfix ball ball sph/wall move rigid\n"

FLOWS = {
    "plain": Flow(fixes=ENERGY + SPECTRUM, values=(*OF_ENERGY, *OF_SPECTRUM)),
    "flat": Flow(dim=2, pair="eos tait", coeff="gamma 6.5 pb 1.0[p]"),
    "mg/fr": Flow(pair="shear mg/fr bulk volume kernel quintic"),
    "mg/fr2": Flow(walls=True, pair="shear mg/fr2", fixes=STICK),
    "frozen_body": Flow(walls=True, body=True, pair="density continuity tension yes", fixes=STICK + BODY),
    "morris": Flow(walls=True, pair="shear morris kernel cubic", fixes=STICK + ENERGY, values=OF_ENERGY),
    "espanol": Flow(walls=True, pair="shear espanol kernel wendland/c6 limit yes", kappa="0.2[pt]", fixes=STICK),
    "spins": Flow(walls=True, **SPIN, integrator="inertia 0.16 0.1[ll]", fixes=STICK.replace("no\n", "no spin rate 0.5\n") + ENERGY +
                  "compute L all sph/angmom\n", values=(*OF_ENERGY, *((f"c_L[{k}]", "mlv") for k in (1, 3, 9)))),
    "noise": Flow(walls=True, pair="temp 0.01[e] 5", fixes=STICK + ENERGY + "compute T all sph/temp\n", names=("noise",),
                  values=(*OF_ENERGY, ("c_T", "e"))),
    "negative_noise": Flow(pair="temp 0.01[e] 5 limit yes", kappa="0.2[pt]", names=("noise",)),
    "noise_of_spins": Flow(body=True, pair="temp 0.01[e] 5", fixes=BODY, names=("noise",)),
    "warm": Flow(walls=True, **SPIN, pair="temp energy 100[e/mT] 5", coeff="conductivity 30.0[pll/tT]", names=("warm",),
                 fixes=STICK.replace("sph/wall\n", "sph/wall heat temp 0.06[e]\n")),
    "heat": Flow(walls=True, coeff=HEAT + " gruneisen 0.5 0.01[T]", fixes="fix low low sph/wall heat flux 2.0[pv]\n"
                 "fix high high sph/wall heat temp 0.04[T] gravity 0 0 -1.0[v/t]\nfix g fluid gravity 1.0[v/t] vector 0 0 -1\n"),
    "stiff_heat": Flow(coeff=HEAT, integrator="viscous rkl2 temperature 0.05[T]"),
    "melt": Flow(coeff=HEAT + " melt 0.04[T] 0.06[T] 1.0[e/m] solid 100", integrator="viscous rkl2 temperature 0.05[T]"),
    "laws": Flow(walls=True, fixes=STICK, coeff="carreau 2.0[t] 0.6 1.5 0.05[pt] yield 0.05[p] 5[t]"),
    "eddies": Flow(walls=True, types=2, fixes=STICK, coeff="cross 2.0[t] 0.7 0.05[pt] smagorinsky 0.2[l] 1.0[pt]"),
    "body": Flow(walls=True, body=True, integrator="viscous implicit tolerance 1e-13",
                 fixes=STICK + BODY + "fix g all gravity 1.0[v/t] vector 0 0 -1\n"),
    "rotating": Flow(walls=True, fixes="fix low low sph/wall rotate 3.0[l] 3.0[l] 0 0 0 1 0.2[1/t] slip free\nfix high high sph/wall\n"),
    "surface": Flow(walls=True, pair="density continuity volume mass", types=2, second="0.5[r]", fixes=STICK),
    "tension": Flow(types=2, unlike="tension 0.8[pl] interdrag 0.8[pt/ll]", coeff="cohesion 0.4[pl]", integrator="shift 0.5[v]"),
    "step": Flow(walls=True, fixes=STICK + "fix dt all sph/dt 1\n", values=(("dt", "t"),)),
    "refined": Flow(pair="volume mass", fixes="variable t atom 1.0[lll]*(1.0-0.8*(x<3[l]))\nfix R fluid sph/refine 2 volume v_t\n"),
    "refined_spins": Flow(**SPIN, pair="volume mass", fixes="fix R fluid sph/refine 2 spacing 1.4[l]\n"),
    "vibration": Flow(room="relax 1", pair="eos ideal", coeff="cv 100.0[e/mT] vibration 20.0[e/mT] 0.05[t]"),
}


def particles(flow):
    """Text of a data file: a box of 6 spacings, with walls above and below, another fluid on one side, and a body in the middle."""
    random = np.random.default_rng(3)
    rows = np.arange(-3, 9) if flow.walls and flow.dim == 3 else np.arange(6)
    places = np.stack(np.meshgrid(np.arange(6), np.arange(6), rows if flow.dim == 3 else [0], indexing="ij"), axis=-1).reshape(-1, 3) + 0.5
    if flow.dim == 2:
        places[:, 2] = 0.0
    fluid = (places[:, 2] > 0.0) & (places[:, 2] < 6.0) | (flow.dim == 2)
    ball = flow.body & (np.linalg.norm(places - 3.0, axis=1) < 1.5) & fluid
    wet = fluid & ~ball
    types = np.where(wet & (places[:, 0] > 3.0), flow.types, 1)
    groups = {"low": places[:, 2] < 0.0, "high": places[:, 2] > 6.0, "ball": ball, "fluid": wet}
    if flow.dim == 2:
        groups = {"fluid": wet}
    number = len(places)
    shift, v = random.uniform(-0.1, 0.1, places.shape), random.normal(0.0, 0.2, places.shape)
    if flow.dim == 2:
        shift[:, 2] = v[:, 2] = 0.0
    x = np.where(wet[:, None], places + shift, places)
    v = np.where(wet[:, None], v, 0.0)
    light = 0.5 if flow.second else 1.0
    mass = np.where(types == 1, 1.0, light)
    spins = flow.style != "sph/bulk"
    own = [" ".join((f"{m}[m]", *("0.16[ll]",) * spins, f"{2.5 * m}[e]", *("0.02[T]",) * bool(flow.room))) for m in mass.tolist()]
    spin = [f" 0 0 {w}[1/t]" if spins else "" for w in np.sin(1.7 * np.arange(number)).tolist()]
    zlo, zhi = (-0.5, 0.5) if flow.dim == 2 else (-3.0, 9.0) if flow.walls else (0.0, 6.0)
    text = (f"\n\n{number} atoms\n{types.max()} atom types\n\n0 6[l] xlo xhi\n0 6[l] ylo yhi\n{zlo}[l] {zhi}[l] zlo zhi\n\nAtoms # {flow.style}\n\n"
            + "".join(f"{i + 1} {t} {o} {a}[l] {b}[l] {c}[l]\n" for i, (t, o, (a, b, c)) in enumerate(zip(types, own, x.tolist(), strict=True)))
            + "\nVelocities\n\n" + "".join(f"{i + 1} {a}[v] {b}[v] {c}[v]{s}\n" for i, ((a, b, c), s) in enumerate(zip(v.tolist(), spin, strict=True))))
    return text, {name: 1 + np.flatnonzero(which) for name, which in groups.items() if which.any()}


def write(folder, flow, units):
    data, groups = particles(flow)
    (folder / "flow.data").write_text(units.of_input(data))
    rho = ["1.0[r]", flow.second or "1.0[r]"]
    text = (f"units lj\ndimension {flow.dim}\nboundary p p {'f' if flow.walls else 'p'}\natom_style {flow.style} {flow.room}\nread_data flow.data\n"
            + "".join(f"group {name} id {' '.join(map(str, ids))}\n" for name, ids in groups.items())
            + f"pair_style {flow.style} {flow.pair}\n"
            + "".join(f"pair_coeff {t + 1} {t + 1} {rho[t]} 10.0[v] 0.5[pt] {flow.kappa} {flow.spin} 2.5[l] {flow.coeff}\n" for t in range(flow.types))
            + (f"pair_coeff 1 2 {flow.unlike}\n" if flow.unlike else "")
            + f"neighbor 0.3[l] bin\ntimestep 0.01[t]\nfix FLUID fluid {flow.style} {flow.integrator}\n" + flow.fixes
            + "compute E all property/atom esph desph numden dnumden\nrun 6\n"
            f"write_dump all custom flow.end id mass x y z vx vy vz fx fy fz c_E[*] {'omegaz tqx tqz' if flow.spin else ''} "
            "modify sort id format float %.17g\n"
            + "".join(f"print 'VALUE $({what}:%.17g)'\n" for what, _ in flow.values))
    return units.of_input(text)


@pytest.mark.parametrize("name", FLOWS)
def test_flow(lammps, name):
    flow = FLOWS[name]
    first, *others = (Units(dim=flow.dim), *scales(flow.names, flow.dim))
    results = []
    for units in (first, *others):
        log = lammps(write(lammps.folder, flow, units)).log
        results.append(outcome(lammps, "flow", units, ("end",)))
        printed = [float(line.split()[1]) for line in log.splitlines() if line.startswith("VALUE")]
        results[-1].update({what: np.array([units.in_first(value, unit)]) for (what, unit), value in zip(flow.values, printed, strict=True)})
    for other in results[1:]:
        compare(results[0], other)
