"""Rigid bodies that the fluid moves, fix sph/wall move rigid.

Values of forces are those of an independent program with dense matrices.
"""

import itertools
import re
import subprocess
import sys
import textwrap

import numpy as np
import pytest

from helpers import relative
from test_pages import ROOT, blocks

FULL = "thermo_modify norm no format float %.17g\n"
FLUID = [(1.005, 1.18), (.858, -.821), (-1.075, .969), (-.869, -1.036), (2.02, -.189), (-1.899, .015), (-.068, 2.115),
         (-.079, -2.019), (1.854, .961), (-2.119, -1.095), (1.1, -2.088), (-1.006, 2.192)]
SPEED = [(-2.711, -1.889), (-.175, -.422), (.214, .217), (2.118, -1.112), (-.378, 2.043), (.647, .663), (-.514, -1.648),
         (.167, .109), (-1.227, -.683), (-.072, -.945), (-.098, .095), (.036, -.506)]
BODY = [(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)]
VELOCITY, OMEGA = np.array([.594, .891]), .321


def write(path, x, v, body, mass=None, size=8.0):
    """Atoms of type 1, those of the body of type 2."""
    text = [f"particles\n\n{len(x)} atoms\n2 atom types\n{-size} {size} xlo xhi\n{-size} {size} ylo yhi\n-0.5 0.5 zlo zhi\n\n"
            "Atoms # sph/bulk\n"]
    mass = np.ones(len(x)) if mass is None else mass
    for k, at in enumerate(x):
        text.append(f"{k + 1} {1 + int(body[k])} {mass[k]} 0.0 {at[0]:.17g} {at[1]:.17g} 0.0")
    text.append("\nVelocities\n")
    for k, u in enumerate(v):
        text.append(f"{k + 1} {u[0]:.17g} {u[1]:.17g} 0.0")
    path.write_text("\n".join(text) + "\n")


def cross_of(at, omega):
    return omega * np.array([-at[1], at[0]])


def small(lammps, coeff, options="", shift=(0.0, 0.0)):
    """The five particles of a body and twelve of the fluid."""
    x = [np.array(at) + shift for at in FLUID + BODY]
    v = list(SPEED) + [VELOCITY + cross_of(at, OMEGA) for at in BODY]
    write(lammps.path("small.data"), x, v, [False] * 12 + [True] * 5)
    return ("units lj\ndimension 2\nboundary f f p\natom_style sph/bulk\nread_data small.data\nneighbor 0.5 bin\n"
            f"group fluid type 1\ngroup body type 2\npair_style sph/bulk {options}\npair_coeff * * {coeff}\n"
            "fix 1 fluid sph/bulk\nfix 2 body rigid single\nfix 3 body sph/wall move rigid\n"
            "dump D all custom 1 out.dump id x y z vx vy vz fx fy fz\ndump_modify D sort id format float %.17g\n"
            "variable e equal pe\nthermo_style custom step pe f_3[1] f_3[2] f_3[6]\n" + FULL)


def forces(lammps, text, ranks=1):
    table = lammps(text, ranks=ranks).thermo()[-1]
    return table, lammps.frame("out.dump")["f"]


def test_friction(lammps):
    """Shear and bulk friction; on two ranks, without newton."""
    x, body = FLUID + BODY, [False] * 12 + [True] * 5
    gamma, _ = dense_friction(x, body, 0.7, 0.4, 2.5)
    want = -gamma @ np.concatenate([np.ravel(SPEED), VELOCITY, [OMEGA]])
    for ranks, newton in ((1, "on"), (2, "on"), (2, "off")):
        text = f"newton {newton}\n" + small(lammps, "1.0 1e-9 0.7 1.8 2.5") + "run 0\n"
        table, f = forces(lammps, text, ranks)
        np.testing.assert_allclose([table[f"f_3[{k}]"][0] for k in (1, 2, 6)], want[24:], rtol=0, atol=1e-11)
        np.testing.assert_allclose(f[:12, :2].ravel(), want[:24], rtol=0, atol=1e-11)
        assert np.abs(f.sum(axis=0)).max() < 1e-13


def test_pressure(lammps):
    """That of frozen fluid, with its energy."""
    table, f = forces(lammps, small(lammps, "1.0 5.0 0.0 0.0 2.5 pb 1.5") + "run 0\n")
    np.testing.assert_allclose(f[0, :2], (2.42140826151609, -2.60524334087034), rtol=0, atol=1e-11)
    np.testing.assert_allclose(f[11, :2], (12.2645774690028, -8.77529336832857), rtol=0, atol=1e-11)
    body = [table[f"f_3[{k}]"][0] for k in (1, 2, 6)]
    np.testing.assert_allclose(body, (.660496783511102, .640642182414606, 5.51094445681440), rtol=0, atol=1e-11)
    assert abs(table["PotEng"][0] - 22.7714189679794) < 1e-11


@pytest.mark.parametrize("options", ["", "volume mass", "density continuity tension yes", "temp 0.3 5", "limit yes"])
def test_forces_do_not_depend_on_the_density_of_a_body(lammps, options):
    """Of one bulk modulus, with any bulk viscosity of the type of the body."""
    found = []
    for ratio in (1.0, 0.1, 0.5, 2.0, 10.0):
        text = small(lammps, "1.0 5.0 0.7 1.8 2.5 pb 1.5", options)
        text = text.replace("fix 1 fluid", f"pair_coeff 2 2 {ratio} {5.0 / np.sqrt(ratio):.17g} 0.7 {1.8 + ratio} 2.5 pb 1.5\nset type 2 mass {ratio}\nfix 1 fluid")
        found.append(forces(lammps, text + "run 0\n")[1])
    for other in found[1:]:
        assert np.abs(other - found[0]).max() < 1e-13 * np.abs(found[0]).max()


# ---- motion ---------------------------------------------------------------------------------------------------------


def drop(dim=2, options="", coeff="1.0 10.0 0.3 0.8", mass=1.0, newton="on", extra="", rigid="rigid single", jitter=0.1,
         boundary="f f f", body="sphere 0.3 0.2 0.0 2.3", step=0.01, sph="", shift=0.0, box=9):
    """A drop of fluid in an open box, or a fluid in a periodic one, with bodies in it that turn and travel."""
    z = f"{-box} {box}" if dim == 3 else "-0.5 0.5"
    lattice = "sq" if dim == 2 else "sc"
    region = f"sphere 0 0 0 {6.5 if dim == 2 else 5.2}" if boundary[0] == "f" else "block EDGE EDGE EDGE EDGE EDGE EDGE"
    return (f"units lj\ndimension {dim}\nboundary {boundary if dim == 3 else boundary[:-1] + 'p'}\nnewton {newton}\n"
            f"atom_style sph/bulk\nfix mol all property/atom mol\nlattice {lattice} 1.0\n"
            f"region box block {-box} {box} {-box} {box} {z}\ncreate_box 2 box\nregion drop {region}\n"
            f"create_atoms 1 region drop\nreset_atoms id sort yes\nregion body {body}\nset region body type 2\nset type 1 mass 1.0\n"
            f"set type 2 mass {mass}\nset type 2 mol 1\ngroup fluid type 1\ngroup body type 2\n"
            f"displace_atoms fluid random {jitter} {jitter} {jitter if dim == 3 else 0.0} 5\n"
            "velocity fluid create 0.05 4 loop geom\nvelocity body set 0.3 -0.2 0.0\nvelocity all ramp vx -0.3 0.3 y -6 6 sum yes\n"
            f"displace_atoms all move {shift} 0 0\n"
            f"neighbor 0.5 bin\npair_style sph/bulk {options}\npair_coeff * * {coeff} 2.6\npair_coeff 2 2 {mass} "
            f"{10.0 * mass**-0.5:.12g} {' '.join(coeff.split()[2:4])} 2.6\n"
            f"fix 1 fluid sph/bulk\nfix 2 body {rigid}\nfix 3 body sph/wall move rigid\n{sph}timestep {step}\n"
            "variable px atom mass*vx\nvariable py atom mass*vy\nvariable pz atom mass*vz\n"
            "compute U all property/atom xu yu zu\nvariable lx atom mass*(c_U[2]*vz-c_U[3]*vy)\n"
            "variable ly atom mass*(c_U[3]*vx-c_U[1]*vz)\nvariable lz atom mass*(c_U[1]*vy-c_U[2]*vx)\n"
            "compute L all reduce sum v_lx v_ly v_lz\ncompute P all reduce sum v_px v_py v_pz\ncompute E all sph/energy\n"
            "thermo_style custom step c_P[*] c_L[*] ke pe c_E\n" + FULL + extra)


@pytest.mark.parametrize("dim, options, mass, rigid, ranks, newton", [
    (2, "", 1.0, "rigid single", 1, "on"), (2, "temp 0.02 7", 3.0, "rigid molecule", 2, "off"),
    (3, "shear mg/fr2", 0.5, "rigid single", 2, "on"), (3, "temp 0.02 7", 1.0, "rigid/nve single", 1, "on")])
def test_momentum_and_angular_momentum(lammps, dim, options, mass, rigid, ranks, newton):
    text = drop(dim, options, mass=mass, newton=newton, rigid=rigid)
    table = lammps(text + "thermo 20\nrun 300\n", ranks=ranks).thermo()[-1]
    for kind in "PL":
        value = np.column_stack([table[f"c_{kind}[{k}]"] for k in (1, 2, 3)])
        scale = np.abs(value).max()
        assert scale > 1.0 and np.abs(value - value[0]).max() < 2e-13 * max(scale, 20.0), (kind, value[-1] - value[0])


def test_free_fall(lammps):
    """Fluid and body under the same gravity: nothing moves relatively; fix rigid with fluid particles is half a step off."""
    extra = ("velocity all set 0.0 0.0 0.0\n"
             "variable r equal vcm(body,y)-vcm(fluid,y)\n"
             "thermo_style custom step v_r\nthermo 100\n" + FULL)
    text = drop(boundary="p p p", jitter=0.0, extra=extra, step=0.004)
    text = text.replace("fix 1 fluid", "fix g all gravity 1.0 vector 0 -1 0\nfix 1 fluid")    # fix rigid sums the forces before it
    table = lammps(text + "run 1000\n").thermo()[-1]
    assert np.abs(table["v_r"]).max() < 1e-12


@pytest.mark.parametrize("dim, mass, options, boundary, least", [
    (2, 1.0, "", "f f f", 50.0), (3, 2.0, "", "f f f", 50.0), (2, 1.0, "density continuity", "f f f", 1.0),
    (2, 3.0, "density continuity delta 0 tension yes", "p p p", 3.0)])
def test_energy(lammps, dim, mass, options, boundary, least):
    """Kinetic energy of fluid and bodies and all internal energies, to second order in the step."""
    drift = {}
    for step in (0.01, 0.005):
        text = drop(dim, options, mass=mass, step=step, boundary=boundary)
        table = lammps(text + f"thermo 5\nrun {round(1.0 / step)}\n").thermo()[-1]
        drift[step] = np.abs(table["c_E"] - table["c_E"][0]).max()
        turned = np.ptp(table["PotEng"])
    print(drift, turned)
    assert turned > least and drift[0.01] < 4e-3 * turned and drift[0.005] < (0.35 if least > 10.0 else 0.27) * drift[0.01]


TWO = "region second sphere {x} {y} 0.0 2.1\nset region second type 2\nset region second mol 2\n"


def periodic(newton="on", rigid="rigid molecule", extra="", options="", **settings):
    """Two bodies in a periodic box; one lies across its border."""
    text = drop(boundary="p p p", newton=newton, rigid=rigid, extra=extra, options=options, **settings)
    return text.replace("set type 1 mass 1.0\n", "").replace("set type 2 mol 1\n", "set region body mol 1\n" + TWO.format(
        x=8.0, y=-4.0) + "region third sphere -10.0 -4.0 0.0 2.1\nset region third type 2\nset region third mol 2\n"
        "set group all mass 1.0\nset region third image 1 NULL NULL\n").replace("set type 2 mass 1.0\n", "")


def test_bodies_cut_by_a_border(lammps):
    """A warning; not of bodies that are one piece, or that go through the whole box."""
    image = "set region third image 1 NULL NULL\n"
    through = "region third block EDGE EDGE -6 -4 EDGE EDGE\n"
    for text, torn in ((periodic(), 0), (periodic().replace(image, ""), 1), (periodic().replace(image, "set region body image 1 1 NULL\n" + image), 0),
                       (re.sub(r"region third sphere.*\n", through, periodic().replace(image, "")), 0)):
        for ranks in (1, 4):
            lines = [line for line in lammps(text + "run 0\n", ranks=ranks).warnings if "a periodic border cuts" in line]
            assert len(lines) == torn and all("cuts 1 of 2 bodies in two" in line for line in lines), lines


@pytest.mark.parametrize("viscous", ["explicit", "implicit tolerance 1e-13"])
def test_ranks_and_periodic_borders(lammps, viscous):
    """Two bodies that cross the borders of box and processors; momentum is that of the start."""
    dump = "dump D all custom 100 out.dump id xu yu zu vx vy vz fx fy fz\ndump_modify D sort id format float %.17g\n"
    reference = None
    for ranks, newton in ((1, "on"), (2, "off"), (4, "on")):
        text = periodic(newton, extra=dump + "velocity body set 3.0 -2.0 0.0\n")
        text = text.replace("fix 1 fluid sph/bulk", f"fix 1 fluid sph/bulk viscous {viscous}")
        table = lammps(text + "thermo 100\nrun 100\n", ranks=ranks).thermo()[-1]
        for k in (1, 2):
            assert np.abs(table[f"c_P[{k}]"] - table[f"c_P[{k}]"][0]).max() < 1e-12
        frame = lammps.frames("out.dump")[-1]
        reference = reference or frame
        for name in ("x", "v"):
            assert np.abs(frame[name] - reference[name]).max() < 1e-11, (ranks, newton, name)


@pytest.mark.parametrize("options, heat", [("", ""), ("temp 0.02 7", ""), ("", "heat temp v_heated")])
def test_restart(lammps, options, heat):
    """A continued run, and one from a restart file, go on as a single run."""
    dump = "compute H all property/atom esph\ndump D all custom 30 {}.dump id xu yu zu vx vy vz fx fy fz c_H\ndump_modify D sort id format float %.17g\n"
    text = periodic(options=options)
    if heat:
        text = HEATED + text.replace(" 2.6\n", " 2.6 cv 2.0 conductivity 0.5\n").replace("move rigid\n", f"move rigid {heat}\n")
    lammps(text + dump.format("single") + "run 60\n")
    lammps(text + dump.format("twice") + "run 30\nwrite_restart box.restart\nrun 30\n")
    after = text[text.index("neighbor 0.5 bin"):]
    lammps((HEATED if heat else "") + "fix mol all property/atom mol\n".join(("atom_style sph/bulk\n", "read_restart box.restart\n")).replace(
        "atom_style sph/bulk\nfix mol all property/atom mol\n", "") + "fix mol all property/atom mol\n"
        + after[:after.index("pair_style")] + after[after.index("fix 1 fluid"):] + dump.format("read") + "run 30\n")
    want = lammps.frames("single.dump")[-1]
    for name in ("twice", "read"):
        frame = lammps.frames(f"{name}.dump")[-1]
        for what in ("x", "v", "f"):
            assert relative(frame[what] - want[what], want[what]) < 1.5e-11, (name, what)
        # at the start of a run, a variable has the heat of this step, later that of the one before
        assert np.abs(frame["c_H"] - want["c_H"]).max() < (1e-4 if heat else 1e-10) * max(1.0, np.abs(want["c_H"]).max()), name


def test_a_body_behaves_as_a_wall_if_it_is_heavy(lammps):
    """With the same surface, the friction of a body that does not move is that of a wall with thermal noise."""
    fluid = {}
    for name, wall in (("body", "fix 2 body rigid single\nfix 3 body sph/wall move rigid\n"), ("wall", "fix 3 body sph/wall\n")):
        text = small(lammps, "1.0 1e-9 0.7 1.8 2.5", "temp 1e-30 1").replace(
            "fix 2 body rigid single\nfix 3 body sph/wall move rigid\n", "velocity body set 0.0 0.0 0.0\n" + wall)
        fluid[name] = forces(lammps, text + "run 0\n")[1][:12]
    assert np.abs(fluid["wall"]).max() > 1.0
    assert np.abs(fluid["body"] - fluid["wall"]).max() < 1e-12


# ---- heat -----------------------------------------------------------------------------------------------------------


def conducting(heat, **keywords):
    """The drop of a fluid at the temperature 1, with a body that gives heat."""
    text = drop(**keywords).replace(" 2.6\n", " 2.6 cv 2.0 conductivity 0.5\n").replace("fix 1 fluid sph/bulk", "fix 1 fluid sph/bulk temperature 1.0")
    return text.replace("move rigid\n", f"move rigid {heat}\n").replace(" ke pe c_E\n", " c_E f_3[7] f_3[8]\n")


@pytest.mark.parametrize("heat", ["heat temp 1.5", "heat flux 0.3", ""])
def test_heat_of_a_body_is_that_of_a_wall(lammps, heat):
    """At rest, where friction has none; without the keyword no heat passes.  The volumes of body particles are not those of a wall."""
    rates = []
    for moves in ("rigid", "no"):
        text = conducting(heat or "heat flux 0", boundary="p p p").replace("timestep", "velocity all set 0 0 0\ntimestep")
        if not heat:
            text = text.replace("heat flux 0", "").replace(" f_3[7] f_3[8]", "")
        if moves == "no":
            text = text.replace("fix 2 body rigid single\n", "").replace("move rigid", "move no")
        lammps(text + "compute H all property/atom desph\ndump D fluid custom 1 out.dump id c_H\ndump_modify D sort id format float %.17g\nrun 0\n")
        rates.append(lammps.frame("out.dump")["c_H"])
        if heat:
            assert lammps.results[-1].thermo()[-1]["f_3[7]"][0] == pytest.approx(rates[-1].sum(), rel=1e-12)
    assert np.abs(rates[0] - rates[1]).max() < (0.05 * rates[1].max() if "temp" in heat else 1e-13)
    assert (rates[0].sum() > 1.0) if heat else np.abs(rates[0]).max() < 1e-13


@pytest.mark.parametrize("layers, part, warned", [(1, 0.0, True), (2, 0.82, True), (3, 0.90, False), (6, 0.95, False)])
def test_flux_of_plates(lammps, layers, part, warned):
    """A body that is thinner than the support radius does not give the heat, and says so."""
    text = conducting("heat flux 0.5", boundary="p p p", jitter=0.0, body=f"block -5.5 4.4 {-layers / 2 - 0.01} {layers / 2 - 0.02} -1 1", box=12)
    result = lammps(text.replace("timestep", "velocity all set 0 0 0\ntimestep") + "run 0\n")
    assert result.thermo()[-1]["f_3[7]"][0] / (0.5 * 2 * (10 + layers)) == pytest.approx(part, abs=0.005)
    assert warned == any("is thinner than the support radius" in line for line in result.warnings)


HEATED = "variable heated equal 2.0-f_3[8]/30.0\n"


@pytest.mark.parametrize("options", ["", "density continuity"])
def test_bodies_of_one_temperature(lammps, options):
    """Of the page: energy is what it is without heat, and the body gets the temperature of the fluid."""
    energy = []
    for heat in ("", "heat temp v_heated"):
        text = (HEATED if heat else "") + conducting(heat, options=options, boundary="p p p", jitter=0.05).replace(" f_3[7]", " v_heated f_3[7]")
        if not heat:
            text = text.replace(" v_heated f_3[7] f_3[8]", "")
        table = lammps(text + "thermo 5\nrun 100\n", ranks=2).thermo()[-1]
        energy.append(table["c_E"])
    assert np.abs(energy[1] - energy[0]).max() < 1e-11 * energy[0][0]
    assert table["f_3[8]"][-1] > 9.0 and table["v_heated"][-1] == pytest.approx(2.0 - table["f_3[8]"][-1] / 30.0, rel=1e-3)
    table = lammps(text.replace("conductivity 0.5", "conductivity 2.0") + "compute M fluid property/atom tsph\ncompute T fluid reduce ave c_M\n"
                   "thermo_style custom step v_heated c_T\nvelocity all set 0 0 0\nthermo 1000\nrun 10000\n").thermo()[-1]
    print(table["v_heated"], table["c_T"])
    assert table["v_heated"][-1] == pytest.approx(table["c_T"][-1], rel=0.005)


@pytest.mark.parametrize("change, words", [
    (("move rigid", "move rigid velocity 1 0 0"), "move rigid cannot be used with velocity"),
    (("move rigid", "move rigid slip free"), "move rigid cannot be used with slip"),
    (("move rigid", "move rigid heat temp 1.0"), "the fluid at the wall conducts no heat"),
    (("move rigid", "gravity 0 1 0 move rigid"), "cannot be used with gravity"),
    (("move rigid", "move rigid body molecule"), "requires molecule IDs"),
    (("move rigid", "move yes body single"), "body requires move rigid"),
    (("pair_style sph/bulk ", "pair_style sph/bulk shear morris"), "shear morris or espanol"),
    (("pair_style sph/bulk ", "pair_style sph/bulk bulk volume"), "bulk volume"),
    (("fix 1 fluid sph/bulk", "fix 1 all sph/bulk"), "is also moved by fix 1"),
    (("fix 2 body rigid single\n", ""), "must be moved by one fix for rigid bodies"),
    (("fix 1 fluid sph/bulk", "fix 1 fluid sph/bulk\nfix 4 body sph/wall move rigid"), "is also moved by fix 3 sph/wall"),
    (("fix 2 body rigid single\n", "fix 2 body rigid single\nfix 4 body rigid/nve single\n"), ""),
    (("run 0", "minimize 0 0 1 1"), "a minimization"),
    (("sph/bulk \npair_coeff", "sph/bulk temp 0.1 7\npair_coeff", "rigid single", "rigid/nvt single temp 1.0 1.0 1.0"),
     "cannot be used with the thermostat of fix 2 rigid/nvt"),
    (("fix 2 body rigid single\n", "group a id 13 14\ngroup b id 15 16 17\nfix 2 body rigid group 2 a b\n"),
     "do not move as a rigid body"),
    (("fix 2 body rigid single\n", "group a id 13 14\ngroup b id 15 16 17\nfix 2 a rigid single\nfix 4 b rigid/nve single\n"),
     "which move in different ways; give each kind a fix"),
])
def test_errors(lammps, change, words):
    text = small(lammps, "1.0 5.0 0.7 1.8 2.5") + ("run 20\n" if "rigid body" in words else "run 0\n")
    for old, new in zip(change[::2], change[1::2]):
        assert old in text
        text = text.replace(old, new)
    result = lammps(text, check=False)
    assert result.code and words in result.error


def test_bodies_that_are_added_in_a_run(lammps):
    """*fix deposit* with a molecule, which *fix rigid/small* makes a body."""
    lammps.path("two.mol").write_text("two\n\n2 atoms\n\nCoords\n\n1 0 0 0\n2 1 0 0\n\nTypes\n\n1 2\n2 2\n\nMasses\n\n1 1\n2 1\n")
    text = drop(rigid="rigid/small molecule mol T", extra="fix D body deposit 1 0 5 4711 region top mol T rigid 2 near 1.0\nrun 20\n")
    result = lammps(text.replace("units lj", "units lj\natom_modify map yes\nmolecule T two.mol").replace("neighbor 0.5 bin", (
        "neighbor 0.5 bin\ncomm_modify cutoff 9.0\nregion top block -5 5 7 8 EDGE EDGE")), check=False)
    assert result.code and "was no body when the run began" in result.error


def test_bodies_that_are_fluid(lammps):
    """LAMMPS's fix alone makes no body."""
    text = small(lammps, "1.0 5.0 0.7 1.8 2.5") + "run 0\n"
    for lines, warned in ((text, 0), (text.replace("fix 3 body sph/wall move rigid\n", "").replace("f_3[1] f_3[2] f_3[6]", "ke"), 1)):
        assert sum("5 particles of the fluid belong to rigid bodies" in line for line in lammps(lines).warnings) == warned


def test_buoyancy(lammps):
    """The pressure of a column at rest carries a disc of the density of the fluid."""
    (table,) = lammps(
        "units lj\ndimension 2\nboundary p f p\natom_style sph/bulk\nlattice sq 1.0 origin 0.5 0.5 0.0\n"
        "region domain block 0 24 -5 24 -0.5 0.5\ncreate_box 3 domain\ncreate_atoms 1 region domain\n"
        "region floor block INF INF INF -0.01 INF INF\nregion top block INF INF 19.99 INF INF INF\n"
        "region body sphere 12.0 10.0 0.0 4.2\nset region floor type 2\nset region top type 2\nset region body type 3\n"
        "group fluid type 1\ngroup wall type 2\ngroup body type 3\nset group all mass 1.0\n"
        "displace_atoms fluid random 0.05 0.05 0.0 3\nneighbor 0.5 bin\npair_style sph/bulk\n"
        "pair_coeff * * 1.0 10.0 2.0 1.0 4.0\nfix g fluid gravity 0.01 vector 0 -1 0\nfix w wall sph/wall gravity 0 -0.01 0\n"
        "fix r body rigid single force * off off off torque * off off off\nfix b body sph/wall move rigid\n"
        "fix 1 fluid sph/bulk\ntimestep 0.05\nvariable B equal f_b[2]/mass(body)/0.01\nthermo_style custom step v_B f_b[1]\n"
        + FULL + "thermo 3000\nrun 3000\n").thermo()
    assert abs(table["v_B"][-1] - 1.0) < 0.002 and abs(table["f_b[1]"][-1]) < 1e-3


@pytest.mark.parametrize("mass", [0.1, 100.0])
def test_density_ratios(lammps, mass):
    """Light and heavy bodies at the time step of the table."""
    text = drop(boundary="p p p", mass=mass, coeff="1.0 10.0 0.3 0.8 ", step=0.001, jitter=0.05)
    log = lammps(text + "run 0\n").log
    step = float(re.search(r"largest stable time step with viscous explicit (\S+),", log)[1])
    table = lammps(text.replace("timestep 0.001", f"timestep {0.98 * step}") + "thermo 50\nrun 1000\n").thermo()[-1]
    assert table["KinEng"].max() < 1.05 * table["KinEng"][0] and table["KinEng"][-1] < table["KinEng"][0]


def test_accuracy_beside_stiff_bodies(lammps):
    """A heavy body with the speed of sound of the fluid has a larger modulus: at the time step of the table, the error of the energy is no larger."""
    error = {}
    for mass in (1.0, 100.0):
        text = drop(boundary="p p p", mass=mass, coeff="1.0 10.0 0.003 0.008 ", step=0.001, jitter=0.05)
        text = re.sub(r"pair_coeff 2 2 \S+ \S+", f"pair_coeff 2 2 {mass} 10.0", text)
        step = float(re.search(r"largest stable time step with viscous explicit (\S+),", lammps(text + "run 0\n").log)[1])
        table = lammps(text.replace("timestep 0.001", f"timestep {0.98 * step}") + "thermo 10\nrun 500\n").thermo()[-1]
        error[mass] = np.abs(table["c_E"] - table["c_E"][0]).max() / table["KinEng"][0]
    print(error)
    assert error[100.0] < 1.5 * error[1.0]


# ---- thermal noise --------------------------------------------------------------------------------------------------


RATIOS = {3: 0.1, 4: 0.9}     # density over that of water, by the type of the box


def floating(extra="", lift=0):
    """Two boxes, 8 spacings wide and 6 high, float in one tank at their drafts of Archimedes, or one is so many spacings above."""
    text = ("units lj\ndimension 2\nboundary p f p\natom_style sph/bulk\nfix mol all property/atom mol\n"
            "lattice sq 100 origin 0.5 0.5 0.0\nregion domain block 0.0 3.2 -0.4 2.0 -0.5 0.5 units box\ncreate_box 4 domain\n"
            "region pool block INF INF 0.0 1.0 INF INF units box\nregion floor block INF INF INF 0.0 INF INF units box\n"
            "create_atoms 1 region pool\ncreate_atoms 2 region floor\nset group all mass 0.01\n")
    for kind, ratio in RATIOS.items():
        left, bottom = 0.4 + 1.6 * (kind - 3), 1.0 - round(6 * ratio) / 10 + (lift / 10 if kind == 3 else 0.0)
        text += (f"region cut{kind} block {left} {left + 0.8} {bottom} INF INF INF units box\ndelete_atoms region cut{kind} compress no\n"
                 f"region box{kind} block {left} {left + 0.8} {bottom} {bottom + 0.6} INF INF units box\n"
                 f"create_atoms {kind} region box{kind}\nset type {kind} mol {kind}\n")
    text += ("set group all mass 0.01\n" + "".join(f"set type {kind} mass {0.01 * ratio}\n" for kind, ratio in RATIOS.items())
             + "group water type 1\ngroup floor type 2\ngroup boxes type 3 4\n")
    return text + after_start(extra, "variable rho atom 1.0+(1.0-y)/400.0\nset group water sph/rho v_rho\n")


def after_start(extra, start=""):
    """From the pair style on, the part of the input that a restart repeats."""
    return ("neighbor 0.03 bin\npair_style sph/bulk density continuity\npair_coeff * * 1.0 20.0 0.001 0.3 0.4\n"
            + "".join(f"pair_coeff {kind} {kind} {ratio} 20.0 0.001 0.3 0.4\n" for kind, ratio in RATIOS.items()) + start
            + "fix g all gravity 1.0 vector 0 -1 0\nfix w floor sph/wall slip free gravity 0 -1 0\nfix 1 water sph/bulk\n"
            "fix 2 boxes rigid molecule\nfix 3 boxes sph/wall move rigid gravity 0 -1 0\ntimestep 0.002\n"
            "compute C boxes chunk/atom type\ncompute X boxes com/chunk C\n" + FULL + extra)


OUT = "dump D all custom {} {}.dump id xu yu zu vx vy vz fx fy fz\ndump_modify D sort id format float %.17g\n"


@pytest.mark.parametrize("viscous", ["explicit", "implicit", "rkl2"])
def test_boxes_float_where_archimedes_says(lammps, viscous):
    """A light and a heavy one in one tank, within a fifth of a spacing."""
    text = floating("thermo_style custom step time c_X[3][2] c_X[4][2]\nthermo 25\n" + FULL)
    text = text.replace("fix 1 water sph/bulk", f"fix 1 water sph/bulk viscous {viscous}")
    (table,) = lammps(text + "run 2000\n").thermo()
    for kind, ratio in RATIOS.items():
        height = table[f"c_X[{kind}][2]"] - (1.3 - 0.6 * ratio)
        print(kind, height.mean(), np.ptp(height))
        assert abs(height.mean()) < 0.02 and np.ptp(height) < 0.1


def test_bodies_begin_with_the_pressure_of_the_fluid_around(lammps):
    """A body that was turned, and so fits nowhere into the lattice of the fluid, has no force at the start; nor after a restart, a data file, or
    *set*, in a run that begins anew.  A pressure that begins with the sums has one; where the fluid ends, it has none."""
    start = ("units lj\ndimension 2\natom_style sph/bulk\nlattice sq 1.0 origin 0.5 0.5 0.0\nregion box block 0 16 0 16 -0.5 0.5\n"
             "create_box 2 box\nregion all block INF INF INF {top} INF INF\nregion L block 5.9 10.1 5.9 10.1 INF INF\ncreate_atoms 1 region all\n"
             "create_atoms 2 region L\ngroup fluid type 1\ngroup body type 2\ndisplace_atoms body rotate 8 8 0 0 0 1 33 units box\n"
             "set group all mass 1.0\n")
    overlap = "delete_atoms overlap 0.7 fluid body\n"
    after = ("neighbor 0.5 bin\npair_style sph/bulk density {density}\npair_coeff * * 1.0 10.0 0.1 0.3 3.2\nfix 1 fluid sph/bulk\n"
             "fix 2 body rigid single\nfix 3 body sph/wall move rigid\n"
             "compute R body property/atom rho\ncompute MR body reduce max c_R\nvariable f atom abs(fx)+abs(fy)\n"
             "compute F all reduce max v_f\nthermo_style custom step c_F c_MR\n" + FULL)

    def run(text, density="continuity", top="INF", ranks=1):
        return [(table["c_F"][-1], table["c_MR"][-1]) for table in lammps(text.format(density=density, top=top), ranks=ranks).thermo()]

    more = (overlap + "run 0\nwrite_restart a.restart\nwrite_data a.data nocoeff\nset group all sph/rho 0.9\nrun 0\n"
            "set group all sph/rho 0\nrun 0\n")
    for ranks in (1, 2):
        first, second, third = run(start + after + more, ranks=ranks)
        assert max(first[0], second[0], third[0]) < 1e-12
        assert first[1] < 1.0 and second[1] == pytest.approx(0.9, abs=1e-12) and third[1] == pytest.approx(first[1], abs=1e-12)
    for read in ("read_restart a.restart\n", "units lj\ndimension 2\natom_style sph/bulk\nread_data a.data\ngroup fluid type 1\ngroup body type 2\n"):
        ((force, _),) = run(read + after + "run 0\n")
        assert force < 1e-12
    assert run(start + after + overlap + "run 0\n", density="sum")[0][0] > 5.0
    ((force, rho),) = run(start + after + overlap + "run 0\n", top="8.0")
    assert force < 1e-12 and rho < 1.0 + 1e-12


def test_dry_bodies_with_tension(lammps):
    """They would draw water to them, and say so; bodies in the middle of water, and those without tension, do not."""
    for options, dry in (("", False), ("tension yes", True)):
        warned = [line for line in lammps(floating().replace("density continuity", f"density continuity {options}") + "run 0\n").warnings if "are dry" in line]
        assert len(warned) == dry and (not dry or "use tension no" in warned[0])
    assert not any("are dry" in line for line in lammps(drop(options="density continuity tension yes", boundary="p p p") + "run 0\n").warnings)


@pytest.mark.parametrize("ranks", [1, 2])
def test_the_pressure_of_floating_boxes_in_the_implicit_step(lammps, ranks):
    """The pressure of boxes and floor follows that of the fluid, with its bulk viscosity: the velocity that the forces have is the mean of those
    before and after, that at the end of the step, within the tolerance."""
    text = floating("compute A all property/atom vestx vesty\ndump D all custom 25 out.dump id type vx vy c_A[*]\ndump_modify D sort id format float %.17g\n", lift=1)
    text = text.replace("0.001 0.3 0.4", "0.3 3.0 0.4").replace("fix 1 water sph/bulk", "fix 1 water sph/bulk viscous implicit tolerance 1e-12")
    lammps(text + "run 125\n", ranks=ranks)
    frames = lammps.path("out.dump").read_text().split("ITEM: ATOMS")[2:]
    assert len(frames) == 5
    for frame in frames:
        values = np.loadtxt(frame.split("ITEM")[0].split("\n")[1:])
        for kind in (1, 3, 4):
            some = values[values[:, 1] == kind]
            assert np.abs(some[:, 4:] - some[:, 2:4]).max() < 1e-9 * np.abs(values[:, 2:4]).max() and np.abs(some[:, 2:4]).max() > 1e-4


def test_floating_boxes_on_ranks_and_after_a_restart(lammps):
    """Continued, and from a restart file on one and two ranks, while the light box meets the water: the same motion."""
    text = floating(lift=1)
    lammps(text + OUT.format(300, "single") + "run 300\n")
    lammps(text + OUT.format(300, "twice") + "run 200\nwrite_restart box.restart\nrun 100\n")
    for ranks in (1, 2):
        lammps("read_restart box.restart\nfix mol all property/atom mol\n" + after_start(OUT.format(300, f"read{ranks}") + "run 100\n"), ranks=ranks)
    want = lammps.frames("single.dump")[-1]
    for name in ("twice", "read1", "read2"):
        frame = lammps.frames(f"{name}.dump")[-1]
        for what in ("x", "v"):
            print(name, what, np.abs(frame[what] - want[what]).max())
            assert np.abs(frame[what] - want[what]).max() < 1e-10, (name, what)


def dense_friction(x, body, mu, zeta, support, least=0.05, rigid=True):
    """Matrix of the friction of fluid and body, of unknowns v of each fluid particle, V, Omega of the body, from the formulas of the
    pages: forces are minus this matrix times the velocities.  Also the matrix of the map from the unknowns to the particles.
    rigid False: unknowns are the velocities of all particles."""
    x, body = np.array(x, dtype=float), np.array(body)
    fluid = np.flatnonzero(~body)
    center = x[body].mean(axis=0)
    moves = fluid if rigid else np.arange(len(x))    # one by one
    n = 2 * len(moves) + 3 * rigid
    motion = np.zeros((len(x), 2, n))
    motion[moves, 0, 2 * np.arange(len(moves))] = motion[moves, 1, 2 * np.arange(len(moves)) + 1] = 1.0
    for w in np.flatnonzero(body) if rigid else []:
        motion[w, 0, n - 3] = motion[w, 1, n - 2] = 1.0
        motion[w, :, n - 1] = cross_of(x[w] - center, 1.0)
    r = x[:, None] - x
    distance = np.hypot(*r.transpose(2, 0, 1))
    q = np.minimum(distance / support, 1.0)
    norm = 7.0 / (np.pi * support**2)
    kernel = norm * (1 - q)**4 * (1 + 4 * q)
    f = norm * 20.0 / support**2 * (1 - q)**3      # -W'/r
    v = np.where(body, 1.0, 1.0 / kernel.sum(axis=1))
    # surface of a body of five particles: normals of the outer ones point away from the inner one, which has none
    depth = np.where(np.hypot(*(x - center).T) > 0.5, .0557354536432820, .45)
    normal = np.where(depth[:, None] < 0.1, x - center, 0.0)
    beta = np.ones_like(distance)
    for w in np.flatnonzero(body):
        d = np.maximum(r[:, w] @ normal[w] - depth[w], least * support if depth[w] < 0.1 else 0.5)
        beta[:, w] = beta[w] = (d + depth[w]) / d
    gamma = np.zeros((n, n))
    for i in fluid:
        rate = np.zeros(n)
        for j in range(len(x)):
            if j == i or q[i, j] >= 1.0:
                continue
            slip = r[i, j] @ (motion[i] - motion[j])
            rate += f[i, j] * slip
            if body[j] or j > i:
                gamma += 8 * mu * f[i, j] * v[i] * v[j] * beta[i, j] / distance[i, j]**2 * np.outer(slip, slip)
        gamma += zeta * v[i]**3 * np.outer(rate, rate)
    return gamma, motion


def test_dense_friction(lammps):
    """The forces are those of the dense matrix; it is symmetric, and rigid motions of all have no friction.

    With half a spacing as the least distance from the surface, the matrix is that of another program, which gave these numbers."""
    x, body = FLUID + BODY, [False] * 12 + [True] * 5
    gamma, _ = dense_friction(x, body, 0.7, 0.4, 2.5)
    _, f = forces(lammps, small(lammps, "1.0 1e-9 0.7 1.8 2.5", "temp 1e-30 1") + "run 0\n")
    want = -gamma @ np.concatenate([np.ravel(SPEED), VELOCITY, [OMEGA]])
    np.testing.assert_allclose(f[:12, :2].ravel(), want[:24], rtol=0, atol=1e-11)
    np.testing.assert_allclose(f[12:, :2].sum(axis=0), want[24:26], rtol=0, atol=1e-11)
    assert np.abs(np.linalg.eigvalsh(gamma)[:3]).max() < 1e-13
    gamma, _ = dense_friction(x, body, 0.7, 0.4, 2.5, least=0.5 / 2.5)
    rates, q = np.linalg.eigvalsh(gamma), np.concatenate([np.ravel(SPEED), VELOCITY, [OMEGA]])
    np.testing.assert_allclose(rates[[3, 4, -2, -1]], [.534561273038569, .641760096311664, 19.4015232260125, 22.4158441758033], rtol=1e-12)
    np.testing.assert_allclose([np.trace(gamma), q @ gamma @ q], [147.453529679900, 166.933637359255], rtol=1e-12)
    np.testing.assert_allclose((-gamma @ q)[[0, 1, 22, 23, 24, 25, 26]], [13.2165988456283, 7.38176025623968, -2.73824880598193, 2.25322531915990,
                                                                        -15.5329482961025, -28.1252933530866, .0553027406775977], atol=1e-11)


@pytest.mark.parametrize("support", [4.0, 6.0])
def test_stable_step_next_to_surfaces(lammps, support):
    """At the largest stable step of the log, particles of a sheared fluid stay within a twentieth of the support radius of the surfaces,
    where their rate is largest; at 1.3 times this step they are thrown off."""
    layers = int(support)
    text = f"""units lj\ndimension 2\nboundary p f p\natom_style sph/bulk\nlattice sq 1.0 origin 0.5 0.5 0.0
region box block 0 20 {-layers} {12 + layers} -0.5 0.5\ncreate_box 1 box\ncreate_atoms 1 box\nset group all mass 1.0
region f block INF INF 0 12 INF INF\ngroup fluid region f\ngroup wall subtract all fluid
region low block INF INF INF 0 INF INF\ngroup low region low\ngroup high subtract wall low
displace_atoms fluid random 0.4 0.4 0.0 5\nvelocity fluid set 0.0 0.0 0.0
pair_style sph/bulk shear mg\npair_coeff * * 1.0 10.0 25.0 50.0 {support} pb 20.0\nfix 1 fluid sph/bulk
fix 2 low rigid single force 1 off off off torque 1 off off off\nfix 3 low sph/wall move rigid
fix 4 high sph/wall velocity 1.0 0.0 0.0 move no
variable v atom sqrt(vx*vx+vy*vy)\ncompute V fluid reduce max v_v\nvariable d atom ternary(y<6,y,12-y)\ncompute D fluid reduce min v_d
thermo_style custom step c_V c_D\nthermo 100\n"""
    (step,) = re.findall(r"with viscous explicit (\S+?),", lammps(text + "timestep 1e-9\nrun 0\n").log)
    table = lammps(text + f"timestep {step}\nrun 3000\n").thermo()[-1]
    print(step, table["c_V"][1:].max(), table["c_D"][-1])
    assert table["c_V"][1:].max() < 1.01 and table["c_D"][-1] < support / 20


# ---- large viscosities ----------------------------------------------------------------------------------------------


def acting_force(viscous, gamma, mass, v, dt, force):
    """The force M (v+ - v-)/dt of a step of M dv/dt = force - Gamma v, from the pages."""
    def solve(part, start, more):
        return np.linalg.solve(np.diag(mass) + part * gamma, mass * start + part * force + more)

    if "rkl2" in viscous:
        s, slope = int(viscous.split()[-1]), lambda y: (force - gamma @ y) / mass
        b = np.array([1 / 3, 1 / 3, 1 / 3] + [(j * j + j - 2) / (2 * j * (j + 1)) for j in range(3, s + 1)])
        w = 4 / (s * s + s - 2)
        before, y = v, v + w / 3 * dt * slope(v)
        for j in range(2, s + 1):
            mu, nu = (2 * j - 1) / j * b[j] / b[j - 1], -(j - 1) / j * b[j] / b[j - 2]
            before, y = y, mu * y + nu * before + (1 - mu - nu) * v + w * mu * dt * (slope(y) - (1 - b[j - 1]) * slope(v))
        return mass * (y - v) / dt
    if "sdirk2" in viscous:
        part = (1 - np.sqrt(0.5)) * dt
        first = force - gamma @ solve(part, v, 0.0)
        rest = (dt - part) * first
        return rest / dt + part / dt * (force - gamma @ solve(part, v, rest))
    return force - gamma @ solve(dt if "euler" in viscous else dt / 2, v, 0.0)


def first_force(viscous, gamma, mass, v, dt, force):
    """The same in the first half step of a run."""
    tau = dt * (3.0 if "trapezoidal" in viscous else 1.5)
    return 2 * acting_force(viscous, gamma, mass, v, tau / 2, force) - acting_force(viscous, gamma, mass, v, tau, force)


LARGE = [f"implicit scheme {scheme} tolerance 1e-13" for scheme in ("trapezoidal", "sdirk2", "euler")] + ["rkl2 stages 15"]


def in_rows(f, at):
    """Forces on the twelve particles, force and torque on the body."""
    r = at[12:] - at[12:].mean(axis=0)
    return np.concatenate([f[:12, :2].ravel(), f[12:, :2].sum(axis=0), [np.sum(r[:, 0] * f[12:, 1] - r[:, 1] * f[12:, 0])]])


@pytest.mark.parametrize("viscous", LARGE)
@pytest.mark.parametrize("ranks", [1, 2])
def test_steps_of_the_dense_matrix(lammps, viscous, ranks):
    """The first forces, and those of a step, in which another fix pulls: as from the dense matrix, with twelve times two unknowns of the
    fluid and three of the body.  The largest rate of the matrix times the step is 9.8."""
    dt, small_speed, pull = 1.0, 1e-3, np.array([3e-4, -2e-4])
    text = small(lammps, "1.0 1e-9 0.7 1.8 2.5").replace("fix 1 fluid sph/bulk", f"fix 1 fluid sph/bulk viscous {viscous}")
    v = small_speed * np.concatenate([np.ravel(SPEED), VELOCITY, [OMEGA]])
    write(lammps.path("slow.data"), FLUID + BODY, list(small_speed * np.array(SPEED)) +
          [small_speed * (VELOCITY + cross_of(at, OMEGA)) for at in BODY], [False] * 12 + [True] * 5)
    text = text.replace("small.data", "slow.data").replace("fix 2 body", f"fix A body addforce {pull[0]} {pull[1]} 0\nfix 2 body")
    text = text.replace("id x y z", "id xu yu zu")
    lammps(text + f"timestep {dt}\nrun 1\n", ranks=ranks)
    frames = lammps.frames("out.dump")
    mass, others = np.array([1.0] * 24 + [5.0, 5.0, 4.0]), np.array([0.0] * 24 + [*(5 * pull), 0.0])
    for step, frame in enumerate(frames):
        at = frame["x"][:, :2]
        gamma, _ = dense_friction(at, [False] * 12 + [True] * 5, 0.7, 0.4, 2.5)
        assert step or 9.0 < dt * np.linalg.eigvals(gamma / mass[:, None]).real.max() < 12.0
        want = (acting_force if step else first_force)(viscous, gamma, mass, v, dt, others if step else 0 * others)
        want += 0 if step else others    # of this moment, which the first step does not have yet
        np.testing.assert_allclose(in_rows(frame["f"], at), want, rtol=0, atol=1e-12 * np.abs(gamma @ v).max())
        v = v + 0.5 * dt * want / mass


def test_random_forces_in_the_dense_matrix(lammps):
    """With thermal noise: the random forces, those at rest, act in the step as all others do, on the body too."""
    dt, options = 0.7, "temp 0.3 5"
    forces_of = {}
    for name, viscous, more in (("noise", "explicit", "velocity all set 0.0 0.0 0.0\n"), ("all", "implicit tolerance 1e-13", "")):
        text = small(lammps, "1.0 1e-9 0.7 1.8 2.5", options).replace("fix 1 fluid sph/bulk", f"fix 1 fluid sph/bulk viscous {viscous}")
        lammps(text.replace("id x y z", "id xu yu zu") + more + f"timestep {dt}\nrun 0\n")
        frame = lammps.frame("out.dump")
        forces_of[name] = in_rows(frame["f"], frame["x"][:, :2])
    gamma, _ = dense_friction(FLUID + BODY, [False] * 12 + [True] * 5, 0.7, 0.4, 2.5)
    v, mass = np.concatenate([np.ravel(SPEED), VELOCITY, [OMEGA]]), np.array([1.0] * 24 + [5.0, 5.0, 4.0])
    want = first_force("trapezoidal", gamma, mass, v, dt, forces_of["noise"])
    assert np.abs(forces_of["noise"][24:]).min() > 0.1
    np.testing.assert_allclose(forces_of["all"], want, rtol=0, atol=1e-10)


def large(viscous, **keywords):
    """The drop, with *viscous* of the integrator."""
    return drop(**keywords).replace("fix 1 fluid sph/bulk", f"fix 1 fluid sph/bulk viscous {viscous}")


BRICK = "block -1.6 2.6 -1.6 1.6 -0.6 0.6"
TUMBLES = "variable wx atom 0.6*y-0.9*z+0.1\nvariable wy atom 0.7*z-0.6*x\nvariable wz atom 0.9*x-0.7*y\nvelocity body set v_wx v_wy v_wz\n"


@pytest.mark.parametrize("viscous, dim, options, rigid, ranks, newton, body", [
    ("implicit tolerance 1e-2", 2, "", "rigid single", 1, "on", "sphere 0.3 0.2 0.0 2.3"),
    ("implicit tolerance 1e-3", 2, "temp 0.02 7", "rigid/nve single", 4, "on", "sphere 0.3 0.2 0.0 2.3"),
    ("rkl2", 2, "shear mg/fr", "rigid molecule", 2, "off", "sphere 0.3 0.2 0.0 2.3"),
    ("implicit scheme sdirk2 tolerance 1e-2", 3, "", "rigid single", 2, "on", BRICK), ("rkl2", 3, "", "rigid/nve single", 4, "off", BRICK)])
def test_momentum_with_large_viscosities(lammps, viscous, dim, options, rigid, ranks, newton, body):
    """Exact for any tolerance, at thirty times the step of the friction."""
    text = large(viscous, dim=dim, options=options, mass=2.0, newton=newton, rigid=rigid, coeff="1.0 10.0 30.0 70.0", body=body,
                 step=0.02 if dim == 2 else 0.01)
    table = lammps(text + "thermo 10\nrun 40\n", ranks=ranks).thermo()[-1]
    for kind in "PL":
        value = np.column_stack([table[f"c_{kind}[{k}]"] for k in (1, 2, 3)])
        scale = np.abs(value).max()
        assert scale > 1.0 and np.abs(value - value[0]).max() < 2e-13 * max(scale, 20.0), (kind, value[-1] - value[0])


@pytest.mark.parametrize("viscous", ["implicit tolerance 1e-2", "implicit scheme sdirk2", "implicit scheme euler", "rkl2"])
def test_energy_with_large_viscosities(lammps, viscous):
    """Kinetic energy of fluid and bodies and all internal energies are constant to rounding errors, for any tolerance."""
    table = lammps(large(viscous, coeff="1.0 10.0 10.0 20.0", mass=2.0) + "thermo 5\nrun 100\n").thermo()[-1]
    drift = np.abs(table["c_E"] - table["c_E"][0]).max()
    print(drift, table["KinEng"])
    assert np.ptp(table["KinEng"]) > 1.0 and drift < 1e-12 * table["c_E"][0]


@pytest.mark.parametrize("rigid", ["rigid single", "rigid/small molecule", "rigid/nve single"])
def test_acting_velocity_of_a_brick(lammps, rigid):
    """A brick that tumbles without forces: the velocity that the fluid has at the end of a step is that of the brick, to second order."""
    off = []
    for step in (0.02, 0.01):
        text = drop(dim=3, body=BRICK, step=step, coeff="1.0 1e-9 1e-9 1e-9", rigid=rigid, extra=TUMBLES + "compute A all property/atom vestx vesty vestz\n"
                    f"dump D body custom {round(0.2 / step)} out.dump id vx vy vz c_A[*]\ndump_modify D sort id format float %.17g\n")
        text = text.replace("neighbor 0.5 bin", "neighbor 0.5 bin\ncomm_modify cutoff 9.0").replace("units lj", "units lj\natom_modify map yes")
        lammps(text + f"run {round(0.2 / step)}\n")
        values = np.loadtxt(lammps.path("out.dump").read_text().split("ITEM: ATOMS")[-1].split("\n")[1:])
        off.append(np.abs(values[:, 4:] - values[:, 1:4]).max())
    print(rigid, off)
    assert 3.5 * off[1] < off[0] < 4e-3


@pytest.mark.parametrize("rigid", ["rigid single", "rigid/nve single"])
@pytest.mark.parametrize("viscous", ["explicit", "implicit tolerance 1e-12", "implicit scheme sdirk2 tolerance 1e-12", "rkl2"])
def test_order(lammps, viscous, rigid):
    """Second order in the step, for a brick that tumbles as well, with the explicit step as the limit."""
    spin = (TUMBLES + "dump D all custom {n} out.dump id xu yu zu vx vy vz\ndump_modify D sort id format float %.17g\nrun {n}\n")
    states = {}
    for scheme, n in itertools.product({viscous, "explicit"}, (10, 20, 40)):
        text = large(scheme, dim=3, mass=2.0, rigid=rigid, body=BRICK, step=0.25 / n, jitter=0.05, coeff="1.0 5.0 1.0 1.5", extra=spin.format(n=n))
        lammps(text)
        frame = lammps.frames("out.dump")[-1]
        states[scheme, n] = np.concatenate([frame["x"], frame["v"]], axis=1)
    def size(values):
        return np.sqrt(np.mean(values**2))

    change = [size(states[viscous, n] - states[viscous, 2 * n]) for n in (10, 20)]
    off = [size(states[viscous, n] - states["explicit", n]) for n in (20, 40)]
    print(viscous, rigid, change, off, change[0] / change[1], off[0] / max(off[1], 1e-99))
    assert change[0] > 3.4 * change[1] and off[0] >= 3.7 * off[1]


@pytest.mark.parametrize("rigid, ranks, bound", [("rigid/nve single", 1, 1e-9), ("rigid/nve single", 4, 1e-9), ("rigid single", 2, 1e-4)])
def test_the_trapezoidal_step_of_a_brick(lammps, rigid, ranks, bound):
    """In three dimensions the velocity and the angular velocity that act are those at the end of the step, within the tolerance of the solver;
    with *fix rigid* but for an error of second order of its rotation."""
    text = large("implicit tolerance 1e-12", dim=3, body=BRICK, mass=2.0, step=0.01, coeff="1.0 10.0 30.0 60.0", rigid=rigid, extra=TUMBLES +
                 "compute A all property/atom vestx vesty vestz\ndump D all custom 2 out.dump id type vx vy vz c_A[*]\ndump_modify D sort id format float %.17g\n")
    lammps(text + "run 2\n", ranks=ranks)
    values = np.loadtxt(lammps.path("out.dump").read_text().split("ITEM: ATOMS")[-1].split("\n")[1:])
    body = values[values[:, 1] == 2]
    off = [np.abs(some[:, 5:] - some[:, 2:5]).max() / np.abs(some[:, 2:5]).max() for some in (values, body)]
    print(rigid, off)
    assert np.ptp(body[:, 2:5], axis=0).min() > 0.3 and max(off) < bound


@pytest.mark.parametrize("viscous", ["rkl2", "implicit tolerance 1e-13"])
def test_restart_with_large_viscosities(lammps, viscous):
    """As test_restart()."""
    def run(text, **keywords):
        return lammps(text.replace("fix 1 fluid sph/bulk", f"fix 1 fluid sph/bulk viscous {viscous}"), **keywords)

    run.frames = lammps.frames
    test_restart(run, "", "")


@pytest.mark.parametrize("ranks", [1, 2])
def test_bodies_of_two_fixes_with_large_viscosities(lammps, ranks):
    """Two bodies of one fix, or one of each of two fixes: the same motion."""
    dump = "dump D all custom 15 out.dump id xu yu zu vx vy vz\ndump_modify D sort id format float %.17g\n"
    text = periodic(extra=dump).replace("fix 1 fluid sph/bulk", "fix 1 fluid sph/bulk viscous implicit tolerance 1e-13").replace(" 0.3 0.8 ", " 3.0 8.0 ")
    frames = []
    for lines in ("fix 3 body sph/wall move rigid\n", "variable second atom mol==2\ngroup second variable second\ngroup first subtract body second\n"
                  "fix 4 second sph/wall move rigid body single\nfix 3 first sph/wall move rigid\n"):
        lammps(text.replace("fix 3 body sph/wall move rigid\n", lines) + "run 15\n", ranks=ranks)
        frames.append(lammps.frames("out.dump")[-1])
    assert np.abs(frames[0]["v"]).max() > 0.1
    for what in ("x", "v"):
        assert np.abs(frames[0][what] - frames[1][what]).max() < 1e-10, what


@pytest.mark.parametrize("viscous", ["implicit", "implicit scheme euler", "rkl2"])
@pytest.mark.parametrize("mass", [0.1, 100.0])
def test_stability_with_large_viscosities(lammps, viscous, mass):
    """Light and heavy bodies at the time step of sound, more than fifty times that of the friction."""
    text = large(viscous, boundary="p p p", mass=mass, coeff="1.0 10.0 100.0 200.0", step=1e-4, jitter=0.05)
    log = lammps(text + "run 0\n").log
    explicit, step = (float(re.search(words + r" (\S+?)[,;]?\s", log)[1]) for words in ("with viscous explicit", "with rkl2 or implicit"))
    assert step > 50.0 * explicit
    table = lammps(text.replace("timestep 0.0001", f"timestep {0.9 * step}") + "thermo 1\nrun 100\n").thermo()[-1]
    print(step / explicit, table["KinEng"][[0, 1, 10, -1]])
    assert table["KinEng"].max() < 1.001 * table["KinEng"][0] and table["KinEng"][-1] < (0.1 if mass < 1.0 else 0.7) * table["KinEng"][0]


def test_the_tolerance_does_not_depend_on_the_mass_of_a_body(lammps):
    """After ten steps, the error of the velocities is at most ten times the tolerance next to bodies of any weight."""
    for mass in (1.0, 1e8):
        v = []
        for viscous in ("implicit", "implicit tolerance 1e-13"):
            text = large(viscous, boundary="p p p", mass=mass, coeff="1.0 10.0 3.0 8.0")
            lammps(text + "dump D all custom 10 out.dump id vx vy vz\ndump_modify D sort id format float %.17g\nrun 10\n")
            v.append(lammps.frames("out.dump")[-1]["v"])
        print(mass, np.abs(v[1] - v[0]).max())
        assert np.abs(v[1] - v[0]).max() < 1e-5 * np.abs(v[1]).max()


@pytest.mark.parametrize("rigid", ["rigid single", "rigid/small molecule"])
def test_a_body_that_its_fix_makes_lighter(lammps, rigid):
    """*infile* of fix rigid with a tenth of the mass of the particles: the solver does not know it, and would not be stable."""
    lammps.path("light.txt").write_text("1\n1 1.7 0.0 0.0 0.0 20.0 20.0 4.0 0.0 0.0 0.0 0.3 -0.2 0.0 0.0 0.0 0.0 0 0 0\n")
    for viscous in ("explicit", "rkl2", "implicit"):
        text = large(viscous, rigid=rigid + " infile light.txt", step=0.002).replace("units lj", "units lj\natom_modify map yes")
        result = lammps(text.replace("neighbor 0.5 bin", "neighbor 0.5 bin\ncomm_modify cutoff 9.0") + "run 1\n", check=False)
        assert bool(result.code) == (viscous != "explicit")
        if result.code:
            assert "must not give the body of particle" in result.output and "less mass than its particles have" in result.output


@pytest.mark.parametrize("viscous", ["implicit tolerance 1e-10", "rkl2"])
def test_a_body_that_its_fix_holds(lammps, viscous):
    """*force off* and *torque off* of fix rigid: the velocity that acts on the fluid comes to rest, and the flow is that of the explicit step."""
    speed = {}
    for scheme, step in (("explicit", 0.002), (viscous, 0.04)):
        text = large(scheme, boundary="p p p", coeff="1.0 10.0 10.0 20.0", jitter=0.0, step=step, rigid="rigid single force * off off off torque * off off off",
                     extra="velocity all set 0 0 0\ncompute A body property/atom vestx vesty\ncompute AM body reduce maxabs c_A[1] c_A[2]\n"
                     "variable u equal vcm(fluid,x)\nthermo_style custom step v_u f_3[1] c_AM[*]\n" + FULL)
        text = text.replace("fix 2 body", "fix A fluid addforce 0.1 0 0\nfix 2 body")
        table = lammps(text + f"run {round(16.0 / step)}\n").thermo()[-1]
        speed[scheme] = table["v_u"][-1]
        assert max(table["c_AM[1]"][-1], table["c_AM[2]"][-1]) < 2e-3 * speed[scheme]
    print(speed)
    assert speed[viscous] == pytest.approx(speed["explicit"], rel=1e-3)


@pytest.mark.parametrize("viscous", LARGE)
def test_rigid_motion_of_all(lammps, viscous):
    """Fluid and body that travel and turn together have no friction."""
    x = FLUID + BODY
    text = small(lammps, "1.0 1e-9 0.7 1.8 2.5").replace("fix 1 fluid sph/bulk", f"fix 1 fluid sph/bulk viscous {viscous}")
    write(lammps.path("together.data"), x, [VELOCITY + cross_of(at, OMEGA) for at in x], [False] * 12 + [True] * 5)
    lammps(text.replace("small.data", "together.data") + "timestep 1.0\nrun 0\n")
    assert np.abs(lammps.frame("out.dump")["f"]).max() < 1e-13


def test_covariance_of_the_impulses(lammps):
    """The random impulses of fluid and body in a step dt have the covariance 2 kT Gamma dt, in all directions.

    At rest, with a step so small that nothing moves; in the eigenvectors of Gamma each impulse has its own variance, and the eigenvalues
    of the sampled covariance over it are within 1 +- 2 (24/samples)^(1/2), but for their fluctuations.  Their sum vanishes."""
    samples, step, kt = 40000, 1e-12, 0.3
    x, body = FLUID + BODY, [False] * 12 + [True] * 5
    gamma, motion = dense_friction(x, body, 0.7, 0.4, 2.5)
    text = small(lammps, "1.0 1e-9 0.7 1.8 2.5", f"temp {kt} 5")
    text = text.replace("id x y z vx vy vz fx fy fz", "fx fy").replace("format float %.17g", "format float %.9g")
    lammps(text + f"velocity all set 0.0 0.0 0.0\nthermo {samples}\ntimestep {step}\nrun {samples}\n")
    lines = lammps.path("out.dump").read_text().split("\n")[:-1]
    frames = np.array(lines).reshape(-1, 9 + len(x))[1:, 9:]
    f = np.array(" ".join(frames.ravel()).split(), dtype=float).reshape(-1, len(x), 2)
    impulses = step * np.einsum("tia,ian->tn", f, motion)
    assert len(impulses) == samples
    assert np.abs(f.sum(axis=1)).max() < 1e-7 * np.abs(f).max()
    rates, modes = np.linalg.eigh(gamma)
    scaled = impulses @ modes / np.sqrt(2 * kt * step * np.maximum(rates, rates[3]))
    assert np.abs(scaled[:, :3]).max() < 1e-6
    scaled = scaled[:, 3:]
    covariance = scaled.T @ scaled / samples
    spread = np.linalg.eigvalsh(covariance)
    limit = 2 * np.sqrt(24 / samples)
    deviations = (covariance - np.eye(24)) * np.sqrt(samples / (1 + np.eye(24)))
    print(spread, np.sqrt(np.mean(deviations[np.triu_indices(24)]**2)), np.abs(deviations).max())
    assert 1 - 1.3 * limit < spread[0] and spread[-1] < 1 + 1.3 * limit
    assert abs(np.mean(deviations[np.triu_indices(24)]**2) - 1) < 3 * np.sqrt(2 / 300) and np.abs(deviations).max() < 5.0
    lagged = scaled[1:].T @ scaled[:-1] / samples * np.sqrt(samples)
    assert np.abs(lagged).max() < 5.0 and abs(np.mean(lagged**2) - 1) < 3 * np.sqrt(2 / 576)


# ---- contact --------------------------------------------------------------------------------------------------------


# ---- equipartition --------------------------------------------------------------------------------------------------


# diffusion over kT of the input of the page Howto_sph_bodies: mean of seeds 1001 to 1010 with 480,000 steps, of which one has the
# standard deviation 0.04, and by the times 30 to 80 the mean 0.48; standard deviation of a run of 160,000 steps

DIFFUSION, SCATTER = 0.558, 0.08


@pytest.mark.long
def test_diffusion_of_the_colloid_of_the_page(lammps):
    """The input and the Python of the page print the diffusion of the disc, within three standard deviations."""
    page = ROOT / "doc" / "src" / "Howto_sph_bodies.rst"
    (text,) = (text for _, _, text, _ in blocks(page) if text.startswith("# A colloid"))
    (script,) = re.findall(r"code-block:: python\n\n((?: {3}.*\n|\n)+)", page.read_text())
    lammps(text, timeout=300)
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(script)], cwd=lammps.path("."), stdout=subprocess.PIPE, text=True, check=True)
    assert float(done.stdout) == pytest.approx(DIFFUSION, abs=3 * SCATTER)
    time, spread = np.loadtxt(lammps.path("msd.txt")).T
    _, _, *place = np.loadtxt(lammps.path("path.txt")).T
    apart, last = 32 * 0.06, 113    # time between two rows; rows in six times the time in which momentum spreads
    assert time[[0, -1]] == pytest.approx((apart, last * apart))
    assert spread[-1] == pytest.approx(sum(np.mean((x[last:] - x[:-last])**2) for x in place))


def equipartition(lammps, steps, pair="", mu=0.05, kappa=0.2):
    """Mean squares of velocity and angular velocity of nine small bodies over those of the temperature of the noise, and their errors.

    Bodies of five particles, mass 5 and moment of inertia 4; a repulsion of their centers keeps them apart.  The total momentum is
    zero: <V^2> = kT/M (1 - M/M_total)."""
    kt = 0.001
    text = ("units lj\ndimension 2\natom_style sph/bulk\nfix mol all property/atom mol ghost yes\nlattice sq 1.0\n"
            "region box block 0 12 0 12 -0.5 0.5\ncreate_box 3 box\ncreate_atoms 1 box\n")
    for k in range(9):
        at = f"{2 + 4 * (k % 3)} {2 + 4 * (k // 3)} 0"
        text += f"region b{k} sphere {at} 1.1\nset region b{k} type 2\ncreate_atoms 3 single {at}\nset region b{k} mol {k + 1}\n"
    text += ("set type 1*2 mass 1.0\nset type 3 mass 1e-6\ngroup fluid type 1\ngroup body type 2\ngroup rigid type 2 3\n"
             f"neighbor 0.5 bin\npair_style hybrid/overlay sph/bulk {pair} temp {kt} 7 lj/cut 3.2\n"
             f"pair_coeff 1*2 1*2 sph/bulk 1.0 1.0 {mu} {kappa} 2.5\npair_coeff 1*2 3 none\n"
             f"pair_coeff 3 3 lj/cut {kt} 2.8 $(2.8*2^(1/6))\n"
             "fix 1 fluid sph/bulk\nfix 2 rigid rigid molecule\nfix 3 body sph/wall move rigid\ntimestep 0.2\n"
             "compute B body chunk/atom molecule\ncompute V body vcm/chunk B\ncompute O body omega/chunk B\n"
             "variable x vector c_V[1]^2\nvariable y vector c_V[2]^2\nvariable o vector c_O[3]^2\n"
             f"variable V equal 5*(sum(v_x)+sum(v_y))/18/{kt}/(1-5/144)\nvariable O equal 4*sum(v_o)/9/{kt}\n"
             f"fix A all ave/time 4 {steps // 80} {steps // 20} v_V v_O file means.txt\nthermo {steps // 20}\nrun {steps}\n")
    lammps(text, timeout=3600)
    means = np.loadtxt(lammps.path("means.txt"))[1:, 1:]
    error = means.std(axis=0, ddof=1) / np.sqrt(len(means))
    print(means.mean(axis=0), error)
    return means.mean(axis=0), error


@pytest.mark.long
def test_equipartition(lammps):
    """Translation and rotation of nine small bodies in a fluctuating fluid have the temperature of the noise, within 1 %.

    A velocity is new after some 25 steps, so the standard error of the means is 0.3 and 0.5 %."""
    mean, error = equipartition(lammps, 400000)
    assert np.abs(mean - 1).max() < 0.01 and error.max() < 0.006


CONTINUITY = "density continuity delta 0 tension yes"


def test_equipartition_with_density_continuity(lammps):
    """As in a tenth of the next test: the standard errors are 0.02 and 0.04.  The mean pressure of the fluid around would make them 2.5 and 2.0."""
    mean, _ = equipartition(lammps, 8000, CONTINUITY, 0.004, 0.05)
    assert abs(mean[0] - 1) < 0.1 and abs(mean[1] - 1) < 0.16


@pytest.mark.long
@pytest.mark.parametrize("mu, kappa", [(0.2, 0.5), (0.02, 0.05), (0.004, 0.05)])
def test_equipartition_of_any_viscosity_with_density_continuity(lammps, mu, kappa):
    """Within three standard errors, which are 0.003 to 0.015 and known within a fifth, and 0.01 for the time step."""
    mean, error = equipartition(lammps, 80000, CONTINUITY, mu, kappa)
    assert np.all(np.abs(mean - 1) < 3 * error + 0.01) and error.max() < 0.02


@pytest.mark.long
def test_equipartition_with_large_viscosities(lammps):
    """The same with *viscous implicit* at seven times the viscosity, of the velocities in the middle of the steps, within 1.5 %.

    A velocity is new after four steps, so the standard error of the means is 0.4 and 0.6 %.  At the ends of the steps it is too cold."""
    kt, steps, dt = 0.001, 40000, 0.2
    text = ("units lj\ndimension 2\natom_style sph/bulk\nfix mol all property/atom mol\nlattice sq 1.0\n"
            "region box block 0 12 0 12 -0.5 0.5\ncreate_box 2 box\ncreate_atoms 1 box\n")
    for k in range(9):
        text += f"region b{k} sphere {2 + 4 * (k % 3)} {2 + 4 * (k // 3)} 0 1.1\nset region b{k} type 2\nset region b{k} mol {k + 1}\n"
    text += ("set group all mass 1.0\ngroup fluid type 1\ngroup body type 2\n"
             f"neighbor 0.5 bin\npair_style hybrid/overlay sph/bulk temp {kt} 7 soft 1.5\npair_coeff * * sph/bulk 1.0 1.0 0.35 1.4 2.5\n"
             f"pair_coeff 2 2 soft {100 * kt}\n"
             f"fix 1 fluid sph/bulk viscous implicit\nfix 2 body rigid molecule\nfix 3 body sph/wall move rigid\ntimestep {dt}\n"
             "compute B body chunk/atom molecule\ncompute V body vcm/chunk B\ncompute O body omega/chunk B\ncompute T body torque/chunk B\n"
             "variable fx atom fx\nvariable fy atom fy\ncompute F body reduce/chunk B sum v_fx v_fy\n"
             + "".join(f"variable {name} vector (c_{a}+{dt / 2 / inertia}*c_{b})^2\nvariable {name}e vector c_{a}^2\n"
                       for name, a, b, inertia in (("x", "V[1]", "F[1]", 5), ("y", "V[2]", "F[2]", 5), ("o", "O[3]", "T[3]", 4)))
             + "".join(f"variable V{e} equal 5*(sum(v_x{e})+sum(v_y{e}))/18/{kt}/(1-5/144)\nvariable O{e} equal 4*sum(v_o{e})/9/{kt}\n" for e in ("", "e"))
             + f"fix A all ave/time 2 1000 2000 v_V v_O v_Ve v_Oe file means.txt\nthermo 20000\nrun {steps}\n")
    lammps(text, timeout=3600)
    means = np.loadtxt(lammps.path("means.txt"))[1:, 1:]
    error = means.std(axis=0, ddof=1) / np.sqrt(len(means))
    print(means.mean(axis=0), error)
    assert np.abs(means.mean(axis=0)[:2] - 1).max() < 0.015 and error.max() < 0.008 and means.mean(axis=0)[2:].max() < 0.95
