"""Every two features together: each gives what the plain way of getting the same gives, or the two are refused with a reason.

A feature is one row of FEATURES: the lines that it adds to an input, the plain way of getting the same, and with which
features it is refused.  The pairs follow by iteration.  The input of a pair, on two ranks, is compared with that of the
plain ways of both, on one rank with newton off, another skin, and no vector instructions.  In both, the momentum of the
fluid must balance.
"""

import itertools
import re
from dataclasses import dataclass, field, fields, replace

import numpy as np
import pytest

from helpers import Lammps, Result, Units, read_dump
from test_messages import NEED, TEXTS

BOUND = 1e-12  # of the largest value
SHORT = 5e-4  # a time step for which terms of second order are below NEARLY, those of first order above
NEARLY = 1e-5
MOMENTUM = 100.0  # of the fluid, about
FIRST = 11  # lower IDs are those of particles that are no fluid


# ---------------------------------------------------------------------------------------------
# the features


@dataclass(frozen=True)
class Lines:
    """What is in an input.  In a sum tuples are joined; any other value is that of the one that sets it."""

    particles: tuple = ()  # besides the fluid: "zones", "walls", "disc", "alien"
    style: str = "sph/bulk"
    room: tuple = ()  # for states, in the atom style
    state: tuple = ()  # their values in data files
    types: int = 1  # of the fluid
    wall_density: float = 0.0  # reference density of walls, which have a type of their own then
    pair: tuple = ()  # keywords of the pair style
    mu: float = 0.5
    kappa: float = 2.0
    energy: float = 0.0  # internal, of each particle
    spin: str = ""  # coefficients of a fluid with spin
    cv: float = 0.0
    conductivity: float = 0.0
    keywords: tuple = ()  # of its pair_coeff, besides these two
    unlike: tuple = ()  # keywords of two unlike types
    others: tuple = ()  # pair_coeff of pair style soft, in a hybrid style
    hybrid: str = "{sph} soft 1.5[l]"
    integrator: tuple = ()  # keywords of the fix that integrates the fluid
    early: tuple = ()  # after it, before the other fixes
    fixes: tuple = ()
    late: tuple = ()  # after them
    between: tuple = ()  # the two runs of five steps
    second: str = "run 5"
    end: str = "run 0"  # gives the forces once more
    force: tuple = ()  # on the fluid, from outside: formulas, {k} is 1 for x, 2 for y
    carried: tuple = ()  # momentum, likewise; {entered}, {left}, {pushed} number the values of fix sph/open
    timestep: float = 0.01
    newton: str = "on"
    skin: float = 0.5

    def __add__(self, other):
        change = {}
        for one in fields(Lines):
            mine, new = getattr(self, one.name), getattr(other, one.name)
            if isinstance(mine, tuple):
                change[one.name] = mine + new
            elif new != one.default:
                assert mine in (one.default, new), f"two features set {one.name}"
                change[one.name] = new
        return replace(self, **change)


@dataclass(frozen=True)
class Feature:
    adds: Lines
    plain: Lines = None  # another way of getting the same; None: there is none
    nearly: Lines = None  # what it comes near to as the time step becomes short
    refused: dict = field(default_factory=dict)  # other features, with words of the message
    nearly_with: dict = field(default_factory=dict)  # other features, and what holds with them
    not_plain_with: tuple = ()  # other features, which do not allow the plain way
    effect: bool = True  # particles move differently than without it


def zones(normal, outlet):
    return Lines(particles=("zones",), fixes=("variable u atom 0.5[v]+0.02[1/t]*y",
                                              f"fix in inlet sph/open fluid 0 0 0 {normal} 0 0 8[l] velocity v_u 0 0",
                                              f"fix out outlet sph/open fluid 16[l] 0 0 -{normal} 0 0 8[l] {outlet}"),
                 carried=tuple(f"f_{name}[{{entered}}]-f_{name}[{{left}}]+f_{name}[{{pushed}}]" for name in ("in", "out")))


def walls(speed):
    return Lines(particles=("walls",), fixes=("variable U equal 0.3[v]", f"fix low low sph/wall velocity {speed} 0 0 move no",
                                              "fix high high sph/wall"), force=("-f_low[{k}]", "-f_high[{k}]"))


def disc(rigid, heat=""):
    return Lines(particles=("disc",), fixes=("variable hot equal 0.05[T]", f"fix turn disc {rigid}", f"fix disc disc sph/wall move rigid {heat}"),
                 force=("-f_disc[{k}]",), **dict(cv=100.0, conductivity=30.0, energy=2.5) if heat else {})


def halves():
    """Two bodies that touch each other from the start, and press each other."""
    return Lines(particles=("disc",), fixes=("region half block INF 9.0[l] INF INF INF INF units box", "group left region half", "group one intersect left disc",
                                             "group two subtract disc left", "fix turn disc rigid group 2 one two", "fix one one sph/wall move rigid contact 0.5 0.3",
                                             "fix two two sph/wall move rigid"), force=("-f_one[{k}]", "-f_two[{k}]"))


def body(fix):
    return Lines(fixes=("variable mx atom 4.0[v/t]*mass", "variable my atom -3.0[v/t]*mass", "variable driven atom mass*gmask(driven)",
                        "compute driven fluid reduce sum v_driven", f"fix G driven {fix}"),
                 force=("c_driven*(4.0*(2-{k})-3.0*({k}-1))",))


LARGE = "rkl2", "implicit"  # they start anew after a change of the time step or of a coefficient
TARGET = "1.0-0.75*(x>3[l])*(x<6[l])+1.6*(x>10[l])*(x<13[l])"
NOT_WITH_BODIES = {"open": "fix sph/open", "spin": "micropolar", "idle_spin": "micropolar", "warm": "temp energy",
                   "gas": "eos ideal", "heat": "gruneisen", "interdrag": "interdrag", "thinning": "not constant", "arrhenius": "not constant", "thixotropy": "not constant", "melt": "not constant", "rerun": "rerun"}
NOT_WITH_LAWS = {"warm": "drift", "limit": "limit", "interdrag": "not constant", "implicit": "implicit", "spin": "sph/bulk", "idle_spin": "sph/bulk"}

FEATURES = {
    "rkl2": Feature(Lines(integrator=("viscous rkl2",)), nearly=Lines(), refused={"noise": "temp"}, nearly_with={"thinning": 1e-3, "thixotropy": 1e-3}),
    "implicit": Feature(Lines(integrator=("viscous implicit tolerance 1e-13",)), nearly=Lines(), nearly_with={"noise": 2e-3}),
    "gravity": Feature(body("gravity 5.0[v/t] vector 0.8 -0.6 0"), body("addforce v_mx v_my 0")),
    "walls": Feature(walls("v_U"), walls("0.3[v]")),
    "dense_walls": Feature(walls("0.3[v]") + Lines(wall_density=4.0), walls("0.3[v]"), not_plain_with=("adapt", "overlay", "interdrag", "tension", "cohesion")),
    "bodies": Feature(disc("rigid single"), disc("rigid group 1 disc"), refused=NOT_WITH_BODIES),
    "hot_bodies": Feature(disc("rigid single", "heat temp v_hot"), disc("rigid group 1 disc", "heat temp 0.05[T]"),
                          refused={**NOT_WITH_BODIES, "noise": "conductivity"}),
    "elastic": Feature(Lines(particles=("disc",), fixes=("fix turn disc nve", "fix disc disc sph/wall move elastic"), force=("-f_disc[{k}]",)),
                       refused={**NOT_WITH_BODIES, "rkl2": "viscous", "implicit": "viscous"}),
    "contact": Feature(halves(), refused={**NOT_WITH_BODIES, "noise": "restitution"}),
    "open": Feature(zones(1, "pressure 1.0[p]"), zones(3, "density 1.01[r]"), not_plain_with=("gas", "heat"), refused={"noise": "temp", "rerun": "rerun"}),
    "split": Feature(Lines(pair=("volume mass",), fixes=(f"variable t atom 1.0[ll]*({TARGET})", "fix R fluid sph/refine 5 volume v_t")),
                     Lines(pair=("volume mass",), fixes=(f"variable t atom 1.0[l]*sqrt({TARGET})", "fix R fluid sph/refine 5 spacing v_t")),
                     refused={"rerun": "rerun"}),
    "noise": Feature(Lines(pair=("temp 0.01[e] 4711",))),
    "hybrid": Feature(Lines(particles=("alien",), others=("1 1 soft 2.0[e]",), fixes=("fix alien alien nve",)), Lines(), effect=False),
    "overlay": Feature(Lines(others=("{own} {own} soft 2.0[e]",)), Lines(others=("{own} {own} soft 2.0[e]",), hybrid="soft 1.5[l] {sph}")),
    "adapt": Feature(Lines(fixes=("variable mu equal 0.8[pt]", "fix A all adapt 1 pair {style} mu {own} {own} v_mu reset yes")), Lines(mu=0.8),
                     not_plain_with=LARGE),
    "timestep": Feature(Lines(early=("timestep 0.003[t]", "run 0"), late=("timestep {timestep}",),
                              between=("timestep 0.003[t]", "run 0", "timestep {timestep}")), Lines(), effect=False,
                        not_plain_with=(*LARGE, "warm")),
    "short_runs": Feature(Lines(second="run 1\n" * 5), Lines(), effect=False,
                          not_plain_with=("open", "elastic")),  # every run builds a neighbor list, with which rows of zones are continued, and surfaces found
    "pre_no": Feature(Lines(second="run 2\nrun 3 pre no"), Lines(), effect=False),
    "reset": Feature(Lines(between=("reset_timestep 0",)), Lines(), effect=False),
    "reset_ahead": Feature(Lines(between=("reset_timestep 1000",)), Lines(), effect=False, not_plain_with=("noise", "warm")),
    "restart": Feature(Lines(between=("write_restart {name}.restart", "clear", "read_restart {name}.restart", "{again}")), Lines(),
                       effect=False),
    "rerun": Feature(Lines(end="write_dump all custom {name}.last id type x y vx vy modify format float %.17g\n"
                               "displace_atoms all move 0.2[l] 0.1[l] 0\nvelocity all set 3.0[v] 4.0[v] NULL\nrerun {name}.last dump x y vx vy"),
                     Lines(end="velocity fluid set 1e-13[v] NULL NULL sum yes units box\nrun 0"), effect=False, not_plain_with=("relax",),
                     refused={"gas": "rerun", "warm": "rerun"}),
    "types": Feature(Lines(types=2), Lines(), effect=False),
    "limit": Feature(Lines(pair=("limit yes",), kappa=0.9), Lines(kappa=0.9), not_plain_with=("noise",)),
    "shift": Feature(Lines(integrator=("shift 0.5[v]",)), refused={"noise": "shift"}),
    "square": Feature(Lines(pair=("shear mg/fr2",))),
    "spin": Feature(Lines(style="sph/micropolar", spin="0.2[pt] 0.05[ptll] -0.05[ptll]")),
    "surface": Feature(Lines(pair=("density continuity",)), refused={"noise": "temp", "warm": "temp", "gas": "no free surface",
                                                                      "heat": "tension yes", "rerun": "rerun"}),
    "drag": Feature(Lines(keywords=("drag 0.3[pt/ll] 0.2[v] -0.1[v] 0",), force=("c_drag[{k}]",),
                          fixes=("compute state fluid property/atom vol vestx vesty", "variable dragx atom -0.3[pt/ll]*c_state[1]*(c_state[2]-0.2[v])",
                                 "variable dragy atom -0.3[pt/ll]*c_state[1]*(c_state[3]+0.1[v])", "compute drag fluid reduce sum v_dragx v_dragy"))),
    "interdrag": Feature(Lines(types=2, unlike=("interdrag 0.8[pt/ll]",))),
    "tension": Feature(Lines(types=2, unlike=("tension 0.8[pl]",))),
    "cohesion": Feature(Lines(keywords=("cohesion 5.0[pl]",)), refused={"surface": "tension yes"}),
    "thinning": Feature(Lines(keywords=("power 0.6 0.05[pt] 1.5[pt] yield 0.05[p] 5[t]",)), refused={**NOT_WITH_LAWS, "noise": "drift"}),
    "arrhenius": Feature(Lines(cv=100.0, energy=2.5, keywords=("arrhenius 0.05[T] 0.02[T] 1.5",)),
                         Lines(cv=100.0, energy=2.5, mu=0.5 * np.exp(-1.25), keywords=(f"arrhenius 0.05[T] 0.04[T] {1.5 * np.exp(1.25)}",)),
                         not_plain_with=("adapt", "thinning", "thixotropy", "melt"), refused={**NOT_WITH_LAWS,
                                                                       "noise": "arrhenius", "rerun": "arrhenius"}),
    "melt": Feature(Lines(cv=100.0, conductivity=30.0, energy=2.5, keywords=("melt 0.012[T] 0.03[T] 1.0[e/m] solid 3",)),
                    refused={**NOT_WITH_LAWS, "noise": "solid", "warm": "melt", "limit": "kappa", "heat": "melt and gruneisen", "gas": "melt",
                             "implicit": "melt", "rerun": "solid"}),
    "thixotropy": Feature(Lines(room=("thixotropy",), state=("0.3",), keywords=("thixotropy 0.8[pt] 2.0[1/t] 5.0",)),
                          refused={**NOT_WITH_LAWS, "noise": "drift", "rerun": "states"}),
    "relax": Feature(Lines(room=("relax 2",), state=("-0.99 0",), keywords=("relax 4.0[pt] 0.02[t] 3.0[pt] 0.5[t]",))),
    "heat": Feature(Lines(cv=100.0, conductivity=30.0, keywords=("gruneisen 0.5 0.01[T]",), energy=2.5),
                    refused={"rerun": "conductivity", "noise": "conductivity", "gas": "gruneisen"}),
    "solute": Feature(Lines(room=("solute",), state=("1.0",), keywords=("solute 0.4[ll/t]",),
                            early=("variable amount atom 1.0+0.5*sin(id)", "set group all d_solute v_amount")),
                      effect=False, refused={"noise": "solute", "warm": "solute"}),
    "idle_room": Feature(Lines(room=("relax 1",), state=("0",)), Lines(), effect=False),
    "gas": Feature(Lines(pair=("eos ideal",), energy=2.5), refused={"noise": "ideal"}),
    "warm": Feature(Lines(pair=("temp energy 100[e/mT] 4711",), energy=2.5),
                    refused={"open": "open", "rkl2": "temp", "implicit": "temp", "limit": "kappa", "shift": "shift", "drag": "drag"}),
    "idle_spin": Feature(Lines(style="sph/micropolar", spin="0 0 0"), Lines(), not_plain_with=("split",), effect=False),
}
NEVER = {("rkl2", "implicit"), ("short_runs", "pre_no"), ("reset", "reset_ahead"), ("noise", "warm"), ("spin", "idle_spin"), ("relax", "idle_room"), *itertools.combinations(("bodies", "hot_bodies", "elastic", "contact"), 2), ("walls", "dense_walls")}  # two values of the same
# pairs whose momentum is not accounted for, with words of the warning about it: forces on walls are also those of the zones,
# and the random forces of a drag are no pairs'
NO_BALANCE = {("walls", "open"): "", ("dense_walls", "open"): "", ("noise", "drag"): "", ("open", "overlay"): "not in the ledger", ("open", "cohesion"): ""}
PAIRS = [(name,) for name in FEATURES] + [pair for pair in itertools.combinations(FEATURES, 2) if pair not in NEVER]
PAIRS += [("split", "reset_ahead", "restart")]  # all three have to do with how long ago the last event of a particle was


def refusal(names):
    for one, other in itertools.permutations(names, 2):
        if other in FEATURES[one].refused:
            return FEATURES[one].refused[other]
    return None


# ---------------------------------------------------------------------------------------------
# from features to inputs


def combined(names):
    return sum((FEATURES[name].adds for name in names), Lines())


def plain(names, which=None):
    """The plain ways of all features, or of those in `which`."""
    result = Lines()
    for name in names:
        one = FEATURES[name]
        other_way = one.plain is not None and name in (which or names) and not set(one.not_plain_with) & set(names)
        result += one.plain if other_way else one.adds
    return result


def near(names, which, plain=False):
    """Short steps, with a feature or without."""
    return sum((FEATURES[name].nearly if plain and name == which else FEATURES[name].adds for name in names), Lines(timestep=SHORT))


def other_way(lines):
    """The same on another way through the code."""
    return lines + Lines(newton="off", skin=0.4, pair=("simd none",))


def particles(lines):
    """Text of a data file, with the IDs of each group.  Rows of the zones are straight."""
    random = np.random.default_rng(7)
    has = lines.particles
    columns = np.arange(-8, 24) if "zones" in has else np.arange(16)
    rows = np.arange(-3, 13) if "walls" in has else np.arange(10)
    x, y = (one.ravel() for one in np.meshgrid(columns + 0.97, rows + 0.5, indexing="ij"))
    part = np.where(y < 0, "low", np.where(y > 10, "high", np.where(x < 0, "inlet", np.where(x > 16, "outlet", "fluid"))))
    if "disc" in has:
        part = np.where((part == "fluid") & ((x - 9.0)**2 + (y - 5.0)**2 < 5.0), "disc", part)
    order = np.argsort(part, kind="stable")
    x, y, part = x[order], y[order], part[order]
    wet = part == "fluid"
    number = wet.sum()
    u = np.where((part == "inlet") | (part == "outlet"), 0.5, 0.0)
    v = np.zeros(len(x))
    driven = wet & (y < 5.0)
    x[wet] += random.uniform(-0.02, 0.02, number)
    y[wet] += random.uniform(-0.1, 0.1, number)
    u[wet], v[wet] = random.normal(0.5, 0.1, number), random.normal(0.0, 0.1, number)
    ids = np.arange(len(x)) + FIRST
    types = np.where(x < 8.0, 1, lines.types)
    mass = np.ones(len(x))
    if lines.wall_density:
        solid = (part == "low") | (part == "high")
        types[solid], mass[solid] = lines.types + 1, lines.wall_density
    groups = {name: ids[part == name] for name in np.unique(part)}
    groups["driven"] = ids[driven]
    if "alien" in has:
        groups["alien"] = np.arange(4) + 1
        ids, types = np.append(groups["alien"], ids), np.append(np.ones(4, dtype=int), types + 1)
        mass = np.append(np.ones(4), mass)
        x, y, u, v = (np.append(np.array(new), old) for new, old in (([4.1, 5.2, 4.5, 5.5], x), ([5.0, 5.1, 6.0, 6.2], y),
                                                                    ([0.5, 0.0, -0.5, 0.2], u), ([0.0, 0.4, 0.0, -0.4], v)))
    spinning = lines.style != "sph/bulk"
    own = " ".join((*("0.16[ll]",) * spinning, f"{lines.energy}[e]", *lines.state))
    spin = [f" 0 0 {w}[1/t]" if spinning else "" for w in np.sin(1.7 * ids)]
    xlo, xhi = (-10.0, 26.0) if "zones" in has else (0.0, 16.0)
    ylo, yhi = (-4.0, 14.0) if "walls" in has else (0.0, 10.0)
    text = (f"\n\n{len(x)} atoms\n{types.max()} atom types\n\n{xlo}[l] {xhi}[l] xlo xhi\n{ylo}[l] {yhi}[l] ylo yhi\n-0.5[l] 0.5[l] zlo zhi\n\n"
            f"Atoms # {lines.style}\n\n" + "".join(f"{i} {t} {m}[m] {own} {a}[l] {b}[l] 0.0\n" for i, t, m, a, b in zip(ids, types, mass, x.tolist(), y.tolist()))
            + "\nVelocities\n\n" + "".join(f"{i} {a}[v] {b}[v] 0.0{w}\n" for i, a, b, w in zip(ids, u.tolist(), v.tolist(), spin)))
    return text, groups


def coefficients(lines, first, own):
    """The fluid's are those of types first, first + 1, ..., in `own`."""
    style = f"{lines.style} " if lines.others else ""
    types = range(first, first + lines.types) if lines.types > 1 else [own]
    wall = first + lines.types
    numbers = ("cv", lines.cv, "e/mT"), ("conductivity", lines.conductivity, "pll/tT")
    keywords = " ".join((*(f"{name} {value}[{unit}]" for name, value, unit in numbers if value), *lines.keywords))
    unlike = " ".join(("mu mean",) * bool(lines.others) + lines.unlike)
    result = [f"{one} {one} {style}1.0[r] 10.0[v] {lines.mu}[pt] {lines.kappa}[pt] {lines.spin} 3.0[l] {keywords}" for one in types]
    if lines.wall_density:
        result += [f"{wall} {wall} {style}{lines.wall_density}[r] 7.0[v] {Lines.mu}[pt] {lines.kappa + 1.0}[pt] {lines.spin} 3.0[l] {keywords}"]
        result += [f"{one} {wall} {style}mu mean" for one in types if lines.others]
    if unlike:
        result += [f"{one} {other} {style}{unlike}" for one, other in itertools.combinations(types, 2)]
    if lines.others:
        result += ["1 2* none"] * (first > 1) + [one.format(own=own) for one in lines.others]
    return "".join(f"pair_coeff {one}\n" for one in result)


def account(lines):
    """Variables px, py: momentum of the fluid; fx, fy: force on it from outside; cx, cy: momentum that came with particles."""
    text = ""
    for k, d in ((1, "x"), (2, "y")):
        numbers = dict(k=k, entered=k + 2, left=k + 12, pushed=k + 20)
        terms = {"p": [f"mass(fluid)*vcm(fluid,{d})"], "f": ["0", *lines.force], "c": ["0", *lines.carried]}
        text += "".join(f"variable {one}{d} equal {'+'.join(sums).format(**numbers)}\n" for one, sums in terms.items())
    return (text + "thermo 1\nthermo_style custom step dt v_px v_py v_fx v_fy v_cx v_cy\n"
            "thermo_modify norm no format float %.17g\n")


def write(folder, name, lines, units=Units()):
    """The input of one case, and its data file; `name` is that of all its files."""
    data, groups = particles(lines)
    (folder / f"{name}.data").write_text(units.of_input(data))
    first = 2 if "alien" in lines.particles else 1
    own = "*" if first + lines.types == 2 and not lines.wall_density else f"{first}*{first + lines.types - 1}"
    words = dict(name=name, style=lines.style, own=own, timestep=f"{lines.timestep}[t]")

    def block(commands):
        return "".join(one.format(**words) + "\n" for one in commands)

    sph = f"{lines.style} {' '.join(lines.pair)}"
    hybrid = "hybrid/overlay" if any("{own}" in one for one in lines.others) else "hybrid"
    pair = f"pair_style {hybrid} {lines.hybrid.format(sph=sph)}\n" if lines.others else f"pair_style {sph}\n"
    coeffs = coefficients(lines, first, own)
    begin = (f"neighbor {lines.skin}[l] bin\nneigh_modify every 5 delay 0 check no\n"
             f"timestep {words['timestep']}\nfix FLUID fluid {lines.style} {' '.join(lines.integrator)}\n")
    fixes = block(lines.fixes) + "compute E all property/atom esph desph numden dnumden\nvariable m atom mass*gmask(fluid)\n" + account(lines)
    words["again"] = (coeffs if lines.others else "") + begin + fixes  # what a restart file does not have
    also = "omegaz tqz " * (lines.style != "sph/bulk") + "d_solute" * ("solute" in lines.room)
    output = f"write_dump all custom {name}.{{}} id v_m x y vx vy fx fy c_E[*] {also} modify sort id format float %.17g\n"
    ends = "f" if "zones" in lines.particles else "p", "f" if "walls" in lines.particles else "p"
    text = (f"log {name}.log\nunits lj\ndimension 2\nboundary {' '.join(ends)} p\nnewton {lines.newton}\n"
            f"atom_style {lines.style} {' '.join(lines.room)}\nread_data {name}.data\n"
            + "".join(f"group {one} id {' '.join(map(str, ids))}\n" for one, ids in groups.items())
            + pair + coeffs + begin + block(lines.early) + fixes + block(lines.late)
            + "run 5\n" + block((*lines.between, lines.second)) + output.format("after")
            + block((lines.end,)) + output.format("again") + "print COMPLETE\n")
    return units.of_input(text)


# ---------------------------------------------------------------------------------------------
# running them


QUANTITIES = {"id": ("id",), "mass": ("v_m",), "esph": ("c_E[1]",), "x": ("x", "y"), "v": ("vx", "vy"), "spin": ("omegaz",),
              "force": ("fx", "fy"), "torque": ("tqz",), "solute": ("d_solute",)}


class Cases:
    """Results of inputs, of which many run in one process: one after the other, and in a new process after one that fails."""

    def __init__(self, lammps):
        self.lammps = lammps
        self.results = {}
        self.names = {}

    def run(self, cases, ranks):
        """cases: {key: Lines}."""
        left = {key: lines for key, lines in cases.items() if key not in self.results}
        names = {key: f"case{len(self.results) + k}" for k, key in enumerate(left)}
        while left:
            text = "clear\n".join(write(self.lammps.folder, names[key], lines) for key, lines in left.items())
            try:
                process = self.lammps(text, ranks=ranks, check=False)
            except AssertionError as hangs:
                process = Result(1, str(hangs), "")
            for key in list(left):
                log = self.lammps.path(f"{names[key]}.log")
                text = log.read_text() if log.exists() else ""
                complete = "\nCOMPLETE" in text
                self.results[key] = Result(0 if complete else process.code or 1, "" if complete else process.output, text)
                del left[key]
                if not complete:
                    break
        self.names.update(names)

    def state(self, key):
        """{quantity: array} at the end of the last run, and forces of the same particles once more."""
        result = {}
        for when, also in ("after", ""), ("again", " once more"):
            columns = read_dump(self.lammps.path(f"{self.names[key]}.{when}"))[0].columns
            fluid = columns["id"] >= FIRST
            for quantity, names in QUANTITIES.items():
                if names[0] in columns and (when == "after" or quantity in ("id", "force", "torque")):
                    result[quantity + also] = np.column_stack([columns[name][fluid] for name in names])
        return result


@pytest.fixture(scope="module")
def cases(tmp_path_factory):
    return Cases(Lammps(tmp_path_factory.mktemp("cases")))


def row(names):
    """The pairs of one feature run together."""
    return [pair for pair in PAIRS if pair[0] == names[0] and len(pair) == len(names) and not refusal(pair)]


def difference(one, other):
    """Largest difference of each quantity, relative to its largest value."""
    if any(not np.array_equal(one[name], other[name]) for name in ("id", "id once more")):
        return {"particles": np.inf}
    result = {}
    for name in one.keys() & other.keys():
        change = np.abs(one[name] - other[name])
        if name == "x":
            change = np.minimum(change, np.abs([16.0, 10.0] - change))  # across a periodic boundary
        scale = 1.0 if name == "x" else max(np.abs(other[name]).max(), 1e-3)
        result[name] = change.max() / scale if np.isfinite(change).all() else np.inf
    return result


def imbalance(result):
    """Momentum of the fluid, less what was carried in and the impulse of the forces: the trapezoidal rule is exact."""
    worst, expected = 0.0, {}
    for table in result.thermo():
        for d in "xy" if "v_px" in table else "":
            own = table[f"v_p{d}"] - table[f"v_c{d}"]
            force = table[f"v_f{d}"]
            impulse = np.append(0.0, np.cumsum(0.5 * table["Dt"][1:] * (force[1:] + force[:-1])))
            worst = max(worst, np.abs(own - impulse - expected.get(d, own[0])).max() / MOMENTUM)
            expected[d] = own[-1]
    return worst


def end(result):
    """How a run that failed has ended."""
    signal = re.search(r"signal \d+ \(.*\)|hangs", result.output)
    return result.error or (signal[0] if signal else f"status {result.code}") + ", the last output is\n" + result.log[-300:]


def complaints(cases, key, other, bound, quantities=None):
    found = [f"{' '.join(map(str, one))}: {end(cases.results[one])}" for one in (key, other) if cases.results[one].code]
    if found:
        return found
    differences = difference(cases.state(key), cases.state(other))
    return [f"{name} differs by {value:.1e}" for name, value in sorted(differences.items())
            if not value < bound and name in (quantities or differences)]


def explain(cases, names):
    """Which single change makes a difference: another number of ranks, another way through the code, each plain way."""
    if cases.results[names, "all"].code:
        return ""
    lines = combined(names)
    single = {"one rank": lines, "another way through the code": other_way(lines),
              **{f"the plain way of {name}": plain(names, (name,)) for name in names}}
    text = ""
    for change, other in single.items():
        cases.run({(names, change): other}, 1)
        text += f"\n  {change}: " + ("; ".join(complaints(cases, (names, "all"), (names, change), BOUND)) or "the same")
    return text


@pytest.mark.parametrize("names", PAIRS, ids="-".join)
def test_pair(cases, names):
    words = refusal(names)
    if words:
        cases.run({(names, "all"): combined(names)}, 1)
        result = cases.results[names, "all"]
        assert result.code, "is not refused"
        assert words in result.error, f"is not refused with a reason: {end(result)}"
        return

    together = row(names)
    cases.run({(pair, "all"): combined(pair) for pair in together}, 2)
    cases.run({(pair, "plain"): other_way(plain(pair)) for pair in together}, 1)
    found = complaints(cases, (names, "all"), (names, "plain"), BOUND)
    assert not found, "\n".join(found) + explain(cases, names)
    for way in ("all", "plain"):
        result = cases.results[names, way]
        if names in NO_BALANCE:
            assert NO_BALANCE[names] in result.log
        else:
            error = imbalance(result)
            assert error < BOUND, f"the momentum is not that of the account, {way}: {error:.1e}"

    # what is accepted has an effect
    if len(names) == 2:
        cases.run({((name,), "all"): combined((name,)) for name in FEATURES}, 2)
    for name in names:
        rest = tuple(other for other in names if other != name)
        if rest and FEATURES[name].effect and not refusal(rest):
            assert complaints(cases, (names, "all"), (rest, "all"), 1e-7), f"{name} has no effect"


# the same features in the words of the pages
ON_PAGES = {"rkl2": r"\*(viscous )?rkl2\*", "implicit": r"\*(viscous )?implicit\*", "bodies": r"\*move rigid\*", "hot_bodies": r"\*move rigid\*", "contact": r"\*move rigid\*", "elastic": r"\*move elastic\*", "open": r"ix sph/open\b",
            "split": r"ix sph/refine\b", "noise": r"\*temp( T seed)?\*", "warm": r"\*temp( energy)?\*", "rerun": r"[Rr]erun", "limit": r"\*limit\*|a \*kappa\* below",
            "shift": r"\*shift\*", "spin": r"\*sph/micropolar\*", "idle_spin": r"\*sph/micropolar\*", "surface": r"\*density continuity\*", "drag": r"\*drag\*",
            "interdrag": r"\*interdrag\*", "thinning": r"\*power\*|iscosities that are not constant", "arrhenius": r"\*arrhenius\*|iscosities that are not constant", "thixotropy": r"\*thixotropy\*|iscosities that are not constant",
            "melt": r"\*(melt|solid)\*|iscosities that are not constant", "cohesion": r"\*cohesion\*", "heat": r"\*(conductivity|gruneisen)\*", "solute": r"\*solute\*", "gas": r"\*eos ideal\*"}
# sentences that say it in another way
REQUIRED = {frozenset(["thinning", "spin"]): r"Pair style \*sph/bulk\*.* required", frozenset(["arrhenius", "spin"]): r"Pair style \*sph/bulk\*.* required",
            frozenset(["thixotropy", "spin"]): r"Pair style \*sph/bulk\*.* required", frozenset(["thixotropy", "idle_spin"]): r"Pair style \*sph/bulk\*.* required",
            frozenset(["thinning", "idle_spin"]): r"Pair style \*sph/bulk\*.* required", frozenset(["arrhenius", "idle_spin"]): r"Pair style \*sph/bulk\*.* required",
            frozenset(["melt", "spin"]): r"Pair style \*sph/bulk\*.* required", frozenset(["melt", "idle_spin"]): r"Pair style \*sph/bulk\*.* required",
            frozenset(["heat", "gas"]): r"\*gruneisen\* values .*with \*eos linear\* and \*tait\*",
            frozenset(["contact", "noise"]): r"With \*temp\* .*\*e\* must be 1 and \*mu\* 0",
            frozenset(["hot_bodies", "noise"]): r"\*temp T seed\* .*\*conductivity\*"}


@pytest.mark.parametrize("pair", [pair for pair in PAIRS if refusal(pair)], ids="-".join)
def test_refused_pair_is_on_a_page(pair):
    """A sentence of the manual says that the two cannot be used together."""
    one, other = (re.compile(ON_PAGES[name]) for name in pair)
    required = REQUIRED.get(frozenset(pair))
    assert any(re.search(required, sentence) if required else one.search(sentence) and other.search(sentence) and NEED.search(sentence)
               for page in TEXTS for sentence in TEXTS[page])


NEAR = [(name, pair) for name in FEATURES if FEATURES[name].nearly for pair in PAIRS if name in pair and not refusal(pair)]


@pytest.mark.parametrize("name, names", NEAR, ids=lambda value: value if isinstance(value, str) else "-".join(value))
def test_short_steps(cases, name, names):
    """What is another integration of the same equations agrees to the second order of the time step."""
    together = [pair for one, pair in NEAR if one == name]
    cases.run({(pair, "short", name): near(pair, name) for pair in together}, 1)
    cases.run({(pair, "plain", name): near(pair, name, True) for pair in together}, 1)
    one = FEATURES[name]
    bound = max(one.nearly_with.get(other, NEARLY) for other in names)
    found = complaints(cases, (names, "short", name), (names, "plain", name), bound, ("particles", "x", "v", "spin", "force", "torque", "solute"))
    assert not found, "\n".join(found)
