"""Contact of bodies with each other and with walls, keyword contact of fix sph/wall move rigid.

Most runs have no fluid near the bodies: the references are those of mechanics.
"""

import re

import numpy as np
import pytest

from helpers import relative
from test_bodies import FULL
from test_pages import ROOT, blocks

BODIES = {2: ["sphere 10 10 {z} 4.1", "sphere 25 {y} {z} 4.1"], 3: ["sphere 6 6 6 3.1", "sphere 13 {y} 6 3.1"]}


def pair(dim=2, e=1.0, mu=0.0, y=13.3, speed=0.05, across=0.002, step=0.1, time=160.0, rigid="rigid/small molecule", coarse=1.0, extra="", contact=None, options="density continuity"):
    """Two bodies, one twice as dense, that hit each other; a few particles of fluid far away."""
    box = "0 36 0 24 -0.5 0.5" if dim == 2 else "0 20 0 14 0 14"
    one, two = (text.format(y=y, z=0) for text in BODIES[dim])
    lattice = "sq" if dim == 2 else "sc"
    contact = f"contact {e} {mu}" if contact is None else contact
    return (f"units lj\ndimension {dim}\nboundary p p p\natom_style sph/bulk\natom_modify map yes\nfix mol all property/atom mol ghost yes\n"
            f"lattice {lattice} 1.0 origin 0.5 0.5 {0.5 if dim == 3 else 0.0}\nregion box block {box}\ncreate_box 3 box\n"
            f"region one {one}\nregion two {two}\nregion far block 0 2 0 2 {'0 2' if dim == 3 else 'INF INF'}\n"
            f"create_atoms 1 region far\ncreate_atoms 2 region one\nlattice {lattice} {coarse**-dim} origin 0.5 0.5 {0.5 if dim == 3 else 0.0}\n"
            f"region two delete\nregion two {two} units box\ncreate_atoms 3 region two\nset type 2 mol 1\nset type 3 mol 2\n"
            f"set type 1*2 mass 1.0\nset type 3 mass {2.0 * coarse**dim}\ngroup fluid type 1\ngroup one type 2\ngroup two type 3\ngroup b type 2 3\n"
            f"velocity one set {speed} {across} 0 units box\nvelocity two set 0 0 0\npair_style sph/bulk {options}\npair_coeff * * 1.0 1.0 0.01 0.3 3.0\n"
            f"pair_coeff 3 3 2.0 0.7 0.01 0.3 3.0\nfix 1 fluid sph/bulk\nfix 2 b {rigid}\ncomm_modify cutoff 12\n"
            f"fix 3 b sph/wall move rigid {contact}\nneighbor 0.3 bin\ntimestep {step}\ncompute K all ke\ncompute E all sph/energy\n"
            "compute U all property/atom xu yu zu\nvariable lx atom mass*(c_U[2]*vz-c_U[3]*vy)\n"
            "variable ly atom mass*(c_U[3]*vx-c_U[1]*vz)\nvariable lz atom mass*(c_U[1]*vy-c_U[2]*vx)\ncompute L all reduce sum v_lx v_ly v_lz\n"
            "variable P equal vcm(b,x)*mass(b)\nvariable Q equal vcm(b,y)*mass(b)\nvariable M equal mass(b)\nvariable v equal vcm(one,x)\nvariable w equal vcm(two,x)\n"
            f"thermo_style custom step c_K pe c_E v_P v_Q c_L[*] v_v v_w v_M\n{FULL}thermo {round(time / step / 8)}\n{extra}run {round(time / step)}\n")


def kept_energy(table):
    """Part of the energy of a motion relative to the center of mass that a head-on impact leaves."""
    first, last = table["c_K"][0], table["c_K"][-1]
    common = 0.5 * table["v_P"][0]**2 / table["v_M"][0]
    return (last - common) / (first - common)


@pytest.mark.parametrize("dim, e, mu", [(2, 1.0, 0.0), (2, 0.5, 0.5), (3, 0.7, 0.3)])
def test_momenta(lammps, dim, e, mu):
    """Momentum, angular momentum, energy; any number of ranks."""
    found = []
    for ranks in (1, 2, 4) if dim == 2 and mu else (2,):
        table = lammps(pair(dim, e, mu, y=13.3 if dim == 2 else 7.5, time=200.0 if dim == 2 else 60.0, step=0.1 if e == 0.5 else 0.05), ranks=ranks).thermo()[-1]
        found.append([table[name][-1] for name in ("c_K", "v_v", "v_w", "c_E")])
        assert abs(table["v_w"][-1]) > 0.005
        for name in ("v_P", "v_Q"):
            assert np.ptp(table[name]) < 1e-13 * table["v_P"][0]
        for k in (1, 2, 3):
            assert np.ptp(table[f"c_L[{k}]"]) < 1e-12 * np.abs(table["c_L[3]"]).max()
        assert relative(np.ptp(table["c_E"]), table["c_E"][0]) < 2e-4
        if e == 1.0:
            assert abs(table["c_K"][-1] / table["c_K"][0] - 1.0) < 5e-5
        else:
            assert table["c_K"][-1] < 0.9 * table["c_K"][0]
    for other in found[1:]:
        np.testing.assert_allclose(other, found[0], rtol=1e-10)


def test_energy_is_of_second_order(lammps):
    """During the contact; a rough step still loses and gains little."""
    error = []
    for step in (0.2, 0.05, 0.0125):
        table = lammps(pair(y=10.0, step=step, time=160.0).replace("thermo 50\n", "thermo 1\n")
                       .replace(f"thermo {round(20 / step)}\n", "thermo 1\n")).thermo()[-1]
        energy = table["c_K"] + table["PotEng"]
        assert table["PotEng"].max() - table["PotEng"][0] > 0.2 * table["c_K"][0]
        error.append(np.abs(energy / energy[0] - 1.0).max())
    print(error)
    assert error[0] > 40.0 * error[2] and error[0] > 5.0 * error[1] and error[0] < 2e-3


@pytest.mark.parametrize("e, found", [(0.25, 0.259), (0.5, 0.502), (0.8, 0.800)])
def test_restitution(lammps, e, found):
    table = lammps(pair(e=e, y=10.0, across=0.0, step=0.1)).thermo()[-1]
    assert (table["v_w"][-1] - table["v_v"][-1]) / 0.05 == pytest.approx(found, abs=0.001)


def test_warning_without_contact(lammps):
    """Bodies without contact pass through each other; the first touch is a warning."""
    result = lammps(pair(contact="", y=10.0))
    assert result.thermo()[-1]["v_w"][-1] == 0.0
    (line,) = [line for line in result.warnings if "a body touches another one" in line]
    assert "use contact of fix sph/wall" in line


@pytest.mark.parametrize("coarse", [0.5, 0.8, 1.5])
def test_other_spacing(lammps, coarse):
    """A body of another spacing, without damping and with."""
    table = lammps(pair(y=10.0, across=0.0, coarse=coarse, step=0.05)).thermo()[-1]
    assert kept_energy(table) == pytest.approx(1.0, abs=1e-4)
    result = lammps(pair(e=0.5, y=10.0, across=0.0, coarse=coarse))
    table = result.thermo()[-1]
    assert 0.2 < kept_energy(table) < 0.3    # coarse discs are rough, and turn
    assert np.ptp(table["v_P"]) < 1e-13 * table["v_P"][0] and "overlap" not in result.log


def test_no_force_across_a_gap(lammps):
    """Down to a gap of 0.05 spacings, in a fluid, all forces are those without contact."""
    frames = []
    for contact in ("", "contact 0.5 0.3"):
        text = ("units lj\ndimension 2\nboundary p p p\natom_style sph/bulk\nfix mol all property/atom mol ghost yes\n"
                "lattice sq 1.0 origin 0.5 0.5 0.0\nregion box block 0 30 0 20 -0.5 0.5\ncreate_box 2 box\ncreate_atoms 1 box\n"
                "region one block 5 12 6 14 INF INF\nregion two block 13 20 6 14 INF INF\nset region one type 2 mol 1\nset region two type 2 mol 2\n"
                "set group all mass 1.0\ngroup fluid type 1\ngroup b type 2\nregion between block 12 13 6 14 INF INF\ngroup film region between\n"
                "delete_atoms group film\ngroup two region two\ndisplace_atoms two move -0.95 0 0\n"
                "pair_style sph/bulk density continuity\npair_coeff * * 1.0 10.0 0.1 1.0 3.0\nfix 1 fluid sph/bulk\nfix 2 b rigid molecule\n"
                f"fix 3 b sph/wall move rigid {contact}\nneighbor 0.3 bin\ntimestep 0.01\nvelocity b set 0.01 0.1 0\n"
                "dump D all custom 10 out.dump id x y z vx vy vz fx fy fz\ndump_modify D sort id format float %.17g\nrun 10\n")
        lammps(text)
        frames.append(lammps.frame("out.dump"))
    assert np.array_equal(frames[0]["f"], frames[1]["f"]) and np.abs(frames[0]["f"]).max() > 0.1


def floor(shape="block 10 20 4 10 INF INF", slope=0.0, mu=0.5, e=0.2, steps=4000, step=0.1, wall="", extra="", rigid="rigid single", gravity=1e-4):
    """A body on a floor with a gravity that is inclined."""
    return ("units lj\ndimension 2\nboundary p f p\natom_style sph/bulk\nlattice sq 1.0 origin 0.5 0.5 0.0\n"
            "region box block 0 60 0 40 -0.5 0.5\ncreate_box 3 box\nregion floor block INF INF INF 4 INF INF\n"
            f"region body {shape}\nregion far block 1 4 33 36 INF INF\ncreate_atoms 1 region far\ncreate_atoms 2 region floor\n"
            "create_atoms 3 region body\nset group all mass 1.0\ngroup fluid type 1\ngroup floor type 2\ngroup b type 3\n"
            "pair_style sph/bulk density continuity\npair_coeff * * 1.0 1.0 0.01 0.3 3.0\n"
            f"fix g b gravity {gravity} vector {slope} -1 0\nfix 1 fluid sph/bulk\nfix w floor sph/wall {wall}\nfix 2 b {rigid}\n"
            f"fix 3 b sph/wall move rigid contact {e} {mu}\nneighbor 0.3 bin\ntimestep {step}\n"
            "variable v equal vcm(b,x)\nvariable vy equal vcm(b,y)\nvariable y equal xcm(b,y)\nvariable x equal xcm(b,x)\nvariable W equal mass(b)\n"
            f"thermo_style custom step time v_v v_vy v_x v_y f_w[1] f_w[2] v_W ke\n{FULL}thermo {steps // 5}\n{extra}run {steps}\n")


def test_friction(lammps):
    """A box on a slope: it slides with Coulomb friction, or creeps more slowly than 2e-4 c0; the floor has its weight."""
    for slope in (0.4, 0.7):
        table = lammps(floor(slope=slope), ranks=2).thermo()[-1]
        g = 1e-4 / np.hypot(1.0, slope)
        weight = g * table["v_W"][0]
        assert table["f_w[2]"][-1] == pytest.approx(-weight, rel=1e-4) and 6.95 < table["v_y"][-1] < 7.0
        force = min(slope, 0.5) * weight
        assert table["f_w[1]"][-1] == pytest.approx(force, rel=1e-4)
        rate = np.diff(table["v_v"])[1:] / np.diff(table["Time"])[1:]
        assert np.abs(rate - (slope * g - force / table["v_W"][0])).max() < 1e-3 * g
        assert (slope > 0.5) == (table["v_v"][-1] > 2e-4)


def test_rest(lammps):
    """A box that falls on a corner comes to rest on the floor."""
    text = floor(gravity=2e-3, mu=0.3, e=0.3, steps=12000, extra="displace_atoms b rotate 15 7 0 0 0 1 30\ndisplace_atoms b move 0 6 0\n")
    result = lammps(text)
    table = result.thermo()[-1]
    assert table["Step"][-1] == 12000 and table["KinEng"][-1] < 1e-8 and "overlap" not in result.log
    assert 6.9 < table["v_y"][-1] < 7.0


def test_moving_wall(lammps):
    """A plate with a given velocity pushes a box, which takes this velocity; the plate has the opposite force."""
    text = floor(gravity=0.0, slope=0.0, mu=0.0, e=0.0, wall="velocity 0 0.01 0", steps=2000)
    table = lammps(text).thermo()[-1]
    assert table["v_vy"][-1] == pytest.approx(0.01, rel=0.15) and table["v_vy"][-1] > 0.01
    table = lammps(text.replace("thermo 400", "thermo 1").replace("run 2000", "run 60")).thermo()[-1]
    gained = table["v_W"][0] * np.diff(table["v_vy"]) / 0.1
    force = -0.5 * (table["f_w[2]"][1:] + table["f_w[2]"][:-1])
    np.testing.assert_allclose(gained, force, rtol=1e-9, atol=1e-12)


def test_restart(lammps):
    """In the middle of a contact, on another number of ranks."""
    text = pair(e=0.5, mu=0.4, time=170.0, step=0.1)
    whole = lammps(text).thermo()[-1]
    first = text.replace("run 1700", "run 1250\nwrite_restart half.restart")
    lammps(first, ranks=2)
    defined = text.index("fix 1 fluid")
    second = "atom_modify map yes\nread_restart half.restart\nfix mol all property/atom mol ghost yes\n" + text[defined:].replace("run 1700", "run 450")
    again = lammps(second, ranks=1).thermo()[-1]
    for name in ("c_K", "v_v", "v_w", "c_E"):
        assert again[name][-1] == pytest.approx(whole[name][-1], rel=1e-10), name


@pytest.mark.parametrize("options, rigid", [("", "rigid molecule"), ("", "rigid/nve molecule"), ("temp 1e-5 7", "rigid/small molecule")])
def test_movers(lammps, options, rigid):
    table = lammps(pair(rigid=rigid, options=options, step=0.1)).thermo()[-1]
    assert np.ptp(table["v_P"]) < 1e-12 * table["v_P"][0] and abs(table["c_K"][-1] / table["c_K"][0] - 1.0) < 0.02


@pytest.mark.parametrize("viscous", ["", "viscous rkl2", "viscous implicit"])
def test_stone_in_water(lammps, viscous):
    """The input of the manual, with a stone near the floor, and all ways of friction: the stone lies on the floor."""
    (text,) = [code for _, _, code, _ in blocks(ROOT / "doc/src/Howto_sph_bodies.rst") if "A stone sinks" in code]
    text = re.sub(r"fix\s+1 water sph/bulk", f"fix 1 water sph/bulk {viscous}", text).replace("sphere 20 11 0 3.1", "sphere 20 5 0 3.1")
    result = lammps(text.replace("run             8000", "run             2000"), ranks=2)
    table = result.thermo()[-1]
    assert -0.1 < table["v_gap"][-1] < 0.0 and abs(table["v_v"][-1]) < 0.05
    assert "largest stable time step of the contact of bodies" in result.log and "WARNING" not in result.log


@pytest.mark.long
@pytest.mark.parametrize("e, mu", [(0.5, 0.3), (1.0, 0.0)])
def test_pile(lammps, e, mu):
    """Ten discs fall into a box: with damping they come to rest, without, their energy stays."""
    text = ("units lj\ndimension 2\nboundary f f p\natom_style sph/bulk\natom_modify map yes\nfix mol all property/atom mol ghost yes\n"
            "lattice sq 1 origin 0.5 0.5 0.0\nregion tank block 0 40 0 50 -0.5 0.5\ncreate_box 3 tank\nregion far block 30 34 45 48 INF INF\n"
            "region walls block 4 36 4 INF INF INF side out\ncreate_atoms 2 region walls\ncreate_atoms 1 region far\n")
    for k in range(10):
        x, y = 9 + 6.1 * (k % 4) + 1.7 * (k // 4), 14 + 8 * (k // 4)
        text += f"region d{k} sphere {x} {y} 0 2.6\ncreate_atoms 3 region d{k}\nset region d{k} mol {k + 1}\n"
    text += ("set type 1*2 mass 1\nset type 3 mass 2\ngroup water type 1\ngroup walls type 2\ngroup discs type 3\n"
             "pair_style sph/bulk density continuity\npair_coeff * * 1.0 20.0 0.1 6 3\npair_coeff 3 3 2.0 20.0 0.1 6 3\n"
             "fix g discs gravity 0.05 vector 0 -1 0\nfix ground walls sph/wall\nfix 1 water sph/bulk\nfix 2 discs rigid/small molecule\n"
             f"comm_modify cutoff 8\nfix 3 discs sph/wall move rigid contact {e} {mu}\nneighbor 0.3 bin\ntimestep 0.008\n"
             "compute K discs ke\nvariable y equal xcm(discs,y)\nvariable W equal mass(discs)*0.05\n"
             f"thermo_style custom step c_K v_y pe v_W f_ground[2]\n{FULL}thermo 500\nrun 20000\n")
    table = lammps(text, ranks=2).thermo()[-1]
    energy = table["c_K"] + table["PotEng"] + table["v_W"] * table["v_y"]
    assert (energy / energy[0] - 1.0).max() < 2e-3
    if e < 1.0:
        assert table["c_K"][-1] < 1e-5 * table["c_K"].max() and table["f_ground[2]"][-1] == pytest.approx(-table["v_W"][0], rel=1e-4)
    else:
        assert abs(energy[-1] / energy[0] - 1.0) < 2e-3


@pytest.mark.parametrize("contact, options, words", [
    ("contact 1.5 0.0", "", "contact must be between 0 and 1, not 1.5"), ("contact 0.5 -0.1", "", "the coefficient of friction must be >= 0, not -0.1"),
    ("contact 0.5", "", "contact"), ("contact 0.5 0.0", "temp 1e-5 7", "the restitution must be 1 and the friction 0"),
    ("contact 1.0 0.1", "temp 1e-5 7", "the restitution must be 1 and the friction 0")])
def test_errors(lammps, contact, options, words):
    result = lammps(pair(contact=contact, options=options), check=False, ranks=2)
    assert result.code and words in result.error


def test_contact_without_bodies(lammps):
    result = lammps(floor(wall="contact 0.5 0.3"), check=False)
    assert result.code and "contact requires move rigid" in result.error


def test_particle_in_a_gap(lammps):
    """A heavy, soft stone presses particles to the floor: they are in no wall; inside of the stone, they are."""
    (text,) = [code for _, _, code, _ in blocks(ROOT / "doc/src/Howto_sph_bodies.rst") if "A stone sinks" in code]
    text = text.replace("mass 2.0", "mass 8.0").replace("2 2 2.0 40.0", "2 2 8.0 14.1").replace("run             8000", "run             2500")
    assert -0.1 < lammps(text.replace("sphere 20 11 0", "sphere 20 11.3 0"), ranks=2).thermo()[-1]["v_gap"][-1] < 0.1    # from 11, a particle is caught
    inside = text.replace("set             region stone", "group stone region stone\nset             region stone")
    inside = inside.replace("group           stone type 2", "create_atoms    1 single 20.3 11.2 0.0\nset             group all mass 1.0\nset type 2 mass 8.0")
    result = lammps(inside, check=False)
    assert result.code and "is inside a wall" in result.error
