"""Flows with a free surface: density continuity with walls, from inputs as users write them."""

import re
from pathlib import Path

import numpy as np
import pytest

L = 5.366  # length of the tank, units of the height of the column

INPUT = """
units lj
dimension {dim}
boundary f f p
atom_style sph/bulk
lattice {lattice}
region domain block -0.4 5.766 -0.4 {height} {z} units box
create_box 2 domain
region column block 0.0 2.0 0.0 1.0 INF INF units box
region tank block 0.0 5.366 0.0 INF INF INF units box side out
create_atoms 1 region column
create_atoms 2 region tank
group water type 1
group tank type 2
set group all mass {mass}
pair_style sph/bulk density continuity eos {eos}
pair_coeff * * 1.0 20.0 {mu} 0.4 $(4.0/10)
variable rho atom 1.0+(1.0-y)/20.0^2
set group water sph/rho v_rho
"""
RUN = """
fix gravity water gravity 1.0 vector 0 -1 0
fix walls tank sph/wall slip {slip} gravity 0 -1 0
fix flow water sph/bulk
timestep 0.002
compute front water reduce max x
compute left water reduce min x
compute low water reduce min y
thermo_style custom step time c_front c_left c_low
thermo_modify format float %.12g
thermo 25
"""
CASES = {"slip free": {}, "no slip": {"slip": "no"}, "tait": {"eos": "tait"}, "mu": {"mu": "0.01"},
         "hexagonal": {"lattice": "hex 100 origin 0.25 0.25 0.0"},
         "slab": {"dim": 3, "lattice": "sc 1000 origin 0.5 0.5 0.5", "z": "0.0 0.5", "mass": "0.001", "height": 1.2}}


def dam(between="", commands="run 1100\n", **words):
    """A column of 10 particles that falls; between: commands before the fixes."""
    words = {"dim": 2, "lattice": "sq 100 origin 0.5 0.5 0.0", "z": "-0.5 0.5", "mass": "0.01", "eos": "linear", "mu": "1e-6",
             "slip": "free", "height": 6.0, **words}
    return (INPUT + between + RUN + commands).format(**words)


def check(result):
    """No warning, nobody inside a wall; times and places of the front."""
    assert not result.warnings, result.warnings
    time, front, left, low = (np.concatenate([run[name] for run in result.thermo()]) for name in ("Time", "c_front", "c_left", "c_low"))
    depth = max(-left.min(), front.max() - L, -low.min())
    assert depth < 0.15 * 0.1, depth
    return time, front


@pytest.mark.parametrize("case", CASES)
def test_dam_break(lammps, case):
    time, front = check(lammps(dam(commands="run 300\n" if case == "slab" else "run 1100\n", **CASES[case])))
    for when, expected, within in ((0.5, 2.140, 0.01), (1.0, 2.69, 0.06), (2.0, 4.24, 0.2)):
        if when < time[-1]:
            assert front[np.isclose(time, when)][0] == pytest.approx(expected, abs=within)


def test_repulsion_of_walls(lammps):
    """Energy and force on a particle without pressure that comes into the corner of a box, against the formula of the page."""
    c0, way = 10.0, np.array([0.8, 0.6])
    places = [np.array([-0.1, 0.0]) - depth * way for depth in (-0.6, -0.2, 0.0, 0.1, 0.3)]
    text = ("units lj\ndimension 2\nboundary f f p\natom_style sph/bulk\nlattice sq 1.0 origin 0.5 0.5 0.0\nregion domain block -4 8 -4 8 -0.5 0.5\n"
            "create_box 2 domain\nregion box block 0 INF 0 INF INF INF side out\ncreate_atoms 2 region box\ncreate_atoms 1 single 4 4 0 units box\n"
            f"set group all mass 2.0\npair_style sph/bulk density continuity\npair_coeff * * 2.0 {c0} 0.1 0.2 3.0\ngroup water type 1\ngroup tank type 2\n"
            "set group water sph/rho 0.5\nfix walls tank sph/wall slip free\nfix flow water sph/bulk\ncompute E water pe/atom\ncompute e water reduce sum c_E\n"
            "variable fx equal fcm(water,x)\nvariable fy equal fcm(water,y)\nthermo_style custom step c_e v_fx v_fy\n"
            "thermo_modify norm no format float %.15g\nrun 0\n")
    text += "".join(f"set group water x {x:.15g} y {y:.15g} sph/rho 0.5\nrun 0\n" for x, y in places)
    far, *runs = lammps(text).thermo()
    row = np.arange(-3.5, 8.0)
    walls = np.array([(x, y) for x in row for y in row if x < 0 or y < 0])

    def energy(place):
        q = np.linalg.norm(walls - place, axis=1) / 1.7
        s = 7 / (np.pi * 1.7**2) * (np.maximum(1 - q, 0)**4 * (1 + 4 * q)).sum() - 0.5
        return 2.0 * c0**2 * (0.05 * max(s, 0)**2 + 3 * max(s - 0.15, 0)**2), s

    for place, run in zip(places, runs):
        (value, s), step = energy(place), 1e-6
        slope = [(energy(place + step * e)[0] - energy(place - step * e)[0]) / (2 * step) for e in np.eye(2)]
        assert run["c_e"][0] - far["c_e"][0] == pytest.approx(value, abs=1e-11 * c0**2), s
        assert [run["v_fx"][0], run["v_fy"][0]] == pytest.approx([-one for one in slope], abs=1e-6 * c0**2), s
    assert energy(places[0])[1] < 0 < energy(places[1])[1] and energy(places[-1])[1] > 0.4


def fast_drops(dim, speed):
    """Drops that fly at the corners of a box and at the edges of a post in it, at half the speed of sound or so."""
    wide, low, high = (30, 12, 18) if dim == 2 else (14, 6, 8)
    lattice, third = ("sq 1.0 origin", "0.0") if dim == 2 else ("sc 1.0 origin", "0.5")
    text = (f"units lj\ndimension {dim}\nboundary f f {'p' if dim == 2 else 'f'}\natom_style sph/bulk\nlattice {lattice} 0.5 0.5 {third}\n"
            f"region domain block -3 {wide + 3} -3 {wide + 3} {'-0.5 0.5' if dim == 2 else f'-3 {wide + 3}'}\ncreate_box 2 domain\n"
            f"region box block 0 {wide} 0 {wide} {'INF INF' if dim == 2 else f'0 {wide}'} side out\n"
            f"region post block {low} {high} {low} {high} INF INF\nregion walls union 2 box post\ncreate_atoms 2 region walls\n")
    moves = ""
    rng = np.random.default_rng(1)
    corners = [(0, 0), (wide, wide), (0, wide), (wide, 0)], [(low, low), (high, high), (low, high), (high, low)]
    for k, (outer, corner) in enumerate([(True, one) for one in corners[0]] + [(False, one) for one in corners[1]]):
        if dim == 3 and k % 4 > 1:
            continue
        away = np.array([1 if (at < wide / 2) == outer else -1 for at in corner])    # from the walls
        way = away * rng.uniform(0.3, 1.0, 2)
        way /= np.hypot(*way)
        center = corner + (4.0 if dim == 2 else 3.6) * away if outer else corner + (2.6 / np.abs(way).max() + 0.8) * way
        x, y, z = *center, 0.0 if dim == 2 else 3.6 if outer else 7.0
        vx, vy, vz = *(-speed * way), -0.5 * speed if dim == 3 and outer else 0.0
        ox, oy, oz = rng.uniform(0, 1, 3) if dim == 3 else (*rng.uniform(0, 1, 2), 0.0)
        text += f"lattice {lattice} {ox:.3f} {oy:.3f} {oz:.3f}\nregion drop{k} sphere {x:.3f} {y:.3f} {z} 2.1 units box\ncreate_atoms 1 region drop{k}\n"
        moves += f"group drop{k} region drop{k}\nvelocity drop{k} set {vx:.4f} {vy:.4f} {vz}\n"
    return (text + f"set group all mass 1.0\n{moves}group water type 1\ngroup tank type 2\nneighbor 0.5 bin\npair_style sph/bulk density continuity\n"
            "pair_coeff * * 1.0 10.0 1e-6 9.0 3.0\nfix walls tank sph/wall slip free\nfix flow water sph/bulk\ntimestep 0.037\n"
            f"region out block -0.7 {wide + 0.7} -0.7 {wide + 0.7} {'INF INF' if dim == 2 else f'-0.7 {wide + 0.7}'} side out\n"
            "variable out equal count(water,out)\nvariable speed atom sqrt(vx^2+vy^2+vz^2)\ncompute speed water reduce max v_speed\n"
            "thermo_style custom step atoms v_out ke c_speed\nthermo_modify norm no\nthermo 2\nrun 200\n")


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("speed", [3.0, 4.0, 5.0])
def test_fast_drops_stay_outside(lammps, dim, speed):
    """... of corners and edges, and bounce off slower than they came; the speed of sound is 10."""
    result = lammps(fast_drops(dim, speed))
    (table,) = result.thermo()
    print(table["v_out"].max(), table["c_speed"].max() / speed, table["KinEng"][-1] / table["KinEng"][0])
    assert table["v_out"].max() == 0 and table["Atoms"][-1] == table["Atoms"][0]
    assert table["c_speed"].max() < 2.5 * speed and table["KinEng"].max() <= table["KinEng"][0] and table["KinEng"][-1] < 0.3 * table["KinEng"][0]


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("support", [3, 4])
@pytest.mark.parametrize("wall, mu, kappa, timestep", [("free", 1e-6, 0.3, 0.37), ("no", 0.5, 0.0, 0.02), ("no", 0.5, 2.0, 0.02)])
def test_lone_particle_at_a_wall(lammps, dim, support, wall, mu, kappa, timestep):
    """Spray from inside of the fluid has the density of its own kernel. Its velocity decays at a wall as that of a particle without
    pressure at the density of the fluid, with *kappa* 0 and a negative zeta, too."""
    lattice, third = ("sq", "-0.5 0.5") if dim == 2 else ("sc", "0 12")
    own = 7 / (4 * np.pi * (support / 2)**2) if dim == 2 else 21 / (16 * np.pi * (support / 2)**3)

    def velocity(rho):
        text = (f"units lj\ndimension {dim}\nboundary p f p\natom_style sph/bulk\nlattice {lattice} 1.0 origin 0.5 0.5 {0.0 if dim == 2 else 0.5}\n"
                f"region box block 0 12 -4 12 {third}\ncreate_box 2 box\nregion floor block INF INF INF 0 INF INF\ncreate_atoms 2 region floor\n"
                f"create_atoms 1 single 5.5 0.4 {0.0 if dim == 2 else 5.5} units box\ngroup water type 1\ngroup floor type 2\nset group all mass 1.0\n"
                f"neighbor 0.3 bin\npair_style sph/bulk density continuity\npair_coeff * * 1.0 1.0 {mu} {kappa * support} {support}\n"
                f"set group water sph/rho {rho}\nvelocity water set 0.03 0.01 0.0\nfix w floor sph/wall slip {wall}\nfix 1 water sph/bulk\n"
                f"timestep {timestep}\nvariable u equal vcm(water,x)\nvariable v equal vcm(water,y)\nthermo_style custom step v_u v_v\n"
                "thermo_modify norm no lost ignore format float %.15g\nthermo 1\nrun 40\n")
        table = lammps(text).thermo()[-1]
        return np.column_stack([table["v_u"], table["v_v"]])

    spray, fluid = velocity(own), velocity(0.9)
    assert spray.shape == (41, 2) and (np.diff(spray[:, 1]) < 0).all() and (spray > 0).all() and spray[-1, 1] < 0.9 * spray[0, 1]
    assert spray == pytest.approx(fluid, rel=1e-10)


def test_no_warning_about_the_lattice_of_a_long_run(lammps):
    """The hydrostatic pressure on a hexagonal lattice is no background pressure that somebody could leave out."""
    check(lammps(dam(commands="variable step equal step\nfix end all halt 1 v_step >= 1 error continue\nrun 20000\n", **CASES["hexagonal"])))


def test_goes_on_from_a_file(lammps):
    """A restart file gives the same run. A data file with a column of densities has no extrapolated velocities: it gives the same run as
    a restart file for a fix with another ID."""
    _, whole = check(lammps(dam(commands="run 500\nrun 500\n")))
    lammps(dam(commands="run 500\nwrite_restart half.restart\nwrite_data half.data pair ij\n").replace("sph/bulk\nlattice", "sph/bulk rho\nlattice"))
    assert not lammps.results[-1].warnings
    fixes = RUN.format(slip="free")
    start = "units lj\nboundary f f p\ndimension 2\natom_style sph/bulk rho\npair_style sph/bulk density continuity\n"
    _, again = check(lammps("read_restart half.restart\n" + fixes + "run 500\n"))
    assert np.abs(again - whole[-len(again):]).max() < 1e-9
    _, anew = check(lammps("read_restart half.restart\n" + fixes.replace("fix flow", "fix other") + "run 500\n"))
    groups = "group water type 1\ngroup tank type 2\n"
    _, again = check(lammps(start + "read_data half.data\n" + groups + fixes + "run 500\n"))
    assert np.abs(again - anew).max() < 4e-11


def test_ranks_and_balance(lammps):
    _, one = check(lammps(dam(commands="run 500\n")))
    result = lammps(dam(between="comm_style brick\n", commands="fix even all balance 50 1.0 shift xy 10 1.1\nrun 500\n"), ranks=4)
    _, four = check(result)
    assert np.abs(four - one).max() < 1e-6


def test_gravity_by_variables(lammps):
    """The same run with constant variables; of a gravity that turns, the force on the tank is that on the fluid at rest."""
    fixed, free = "gravity 0 -1 0", "gravity v_zero v_g 0"
    variables = "variable zero equal 0.0\nvariable g equal -1.0\n"
    runs = [check(lammps(variables + dam(commands="run 100\n").replace(f"free {fixed}", f"free {words}")))[1] for words in (fixed, free)]
    assert (runs[0] == runs[1]).all()

    turning = "variable gx equal 0.5*sin(20*time)\n" + dam(commands="run 40\n")
    fronts = [check(lammps(turning.replace(f"free {fixed}", f"free {words}")))[1] for words in (fixed, "gravity v_gx -1 0")]
    assert fronts[0][0] == fronts[1][0] and fronts[0][-1] != fronts[1][-1]


@pytest.mark.parametrize("words, message", [
    ("gravity v_none -1 0", "Variable none for fix sph/wall gravity does not exist"),
    ("gravity v_a -1 0", "Variable a for fix sph/wall gravity is not an equal-style variable"),
    ("gravity 0 -1 v_z", "velocity and gravity must lie in the plane in 2d"), ("gravity 0 v_inf 0", "Fix sph/wall gravity: variable inf is inf at step 0: values must be finite"),
    ("gravity 0 -1", "fix sph/wall gravity")])
def test_gravity_that_is_refused(lammps, words, message):
    variables = "variable a atom x\nvariable z equal 0.0\nvariable inf equal exp(1000)\n"
    result = lammps(variables + dam(commands="run 1\n").replace("free gravity 0 -1 0", f"free {words}"), check=False)
    assert result.code and message in result.error, result.error


EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "dam_break" / "in.dam_break"


def tank_at_rest(n, end):
    """The input of the example with a tank that the water fills, without viscosities."""
    text = EXAMPLE.read_text()
    for old, new in (("n index 30", f"n index {n}"), ("end index 10.0", f"end index {end}"), ("kappa index 0.2", "kappa index 0.0"),
                     ("mu index 1.0e-6", "mu index 0.0"), ("every index 0.02", f"every index {end / 10}"), ("5.366", "1.0"),
                     ("0.0 2.0 0.0 1.0", "0.0 1.0 0.0 1.0"), (" 6.0 -0.5", " 1.4 -0.5"), ("0.117", "0.25"), ("0.267", "0.75")):
        assert old in text, old
        text = text.replace(old, new)
    return text


@pytest.mark.long
def test_shifting(lammps):
    """The dam break of the example: less scatter of the pressure on the far wall with shifting, no mechanical energy gained."""
    text = EXAMPLE.read_text()
    start = text.index("thermo_style")
    energies = ("compute P all pe\ncompute K water ke\nvariable weight atom mass*y\ncompute G water reduce sum v_weight\n"
                "variable mechanical equal c_K+c_P+c_G\nthermo_style custom step time v_mechanical c_front c_push\nthermo_modify norm no\nthermo ${steps}\n")
    scatter = {}
    for shift in ("0", "auto"):
        result = lammps(f"variable shift index {shift}\n" + text[:start] + energies
                        + "run $(round(5/v_every)*v_steps)\n", timeout=300)
        assert not result.warnings, result.warnings
        table = result.thermo()[-1]
        time, energy, pressure = table["Time"], table["v_mechanical"], table["c_push"] / 0.15
        impact = (time >= 3.0) & (time < 5.0)
        scatter[shift] = pressure[impact].std()
        print(f"shift {shift}: pressure {pressure[impact].mean():.3f}, scatter {scatter[shift]:.3f}, front "
              + " ".join(f"{table['c_front'][np.isclose(time, when)][0]:.3f}" for when in (1.0, 1.5, 2.0))
              + f", largest rise of the energy {np.diff(energy).max():.1e}, {energy[-1]:.4f} at the end")
        assert pressure[impact].mean() == pytest.approx(0.51, abs=0.05)
        assert np.diff(energy).max() < 1e-3 and energy.max() < energy[0] + 2e-5 and 0.96 < energy[-1] < 0.98
    assert scatter["auto"] < 0.6 * scatter["0"]


@pytest.mark.parametrize("n, end, pressure, speed", [
    (16, 4.0, 0.012, 4e-3), pytest.param(40, 50.0, 0.006, 5e-4, marks=pytest.mark.long)])
def test_tank_at_rest(lammps, n, end, pressure, speed):
    """The pressure stays hydrostatic without any viscosity: diffusion does not lift the surface, and the particles come to rest."""
    result = lammps(tank_at_rest(n, end), timeout=900)
    assert not result.warnings, result.warnings
    last = lammps.frame("dam_break.particles.txt")
    y, rho, vx, vy = (last.columns[name] for name in ("y", "c_rho", "vx", "vy"))
    assert np.sqrt(np.mean((np.maximum(400 * (rho - 1), 0) - (1 - y))**2)) < pressure
    assert np.sqrt(np.mean(vx**2 + vy**2)) < speed
    assert abs(y.mean() - 0.5) < 2e-4
    push = np.loadtxt(lammps.path("dam_break.probe.txt"))[-1, 2]
    assert push / 0.5 == pytest.approx(0.5, rel=0.01)    # force on the stretch of the wall


# -- Recipes of the page Howto_sph_surface --------------------------------------------------------------------------

PAGE = (Path(__file__).resolve().parents[2] / "doc" / "src" / "Howto_sph_surface.rst").read_text()


def recipe(title):
    """The input of the page that begins with this comment."""
    block = re.search(rf"^   # {title}.*\n(?:   .*\n|\n)+", PAGE, re.MULTILINE)[0]
    return re.sub("^   ", "", block, flags=re.MULTILINE)


def dam_of_page(*changes, **top):
    """The input of the page with other values of the variables at its top, and other changes."""
    text = recipe("A dam break")
    for name, value in top.items():
        text, count = re.subn(rf"^(variable +{name} index) \S+", rf"\1 {value}", text, flags=re.MULTILINE)
        assert count == 1, name
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    return text


SI = {"H": 0.2, "g": 9.81, "rho0": 1000.0}
SI_UNITS = {"length": 0.2, "time": (0.2 / 9.81)**0.5, "pressure": 1000.0 * 9.81 * 0.2}


@pytest.mark.parametrize("top, length, pressure", [({"width": 1.0, "tank": 1.0, "end": 3.375}, 1.0, 1.0),
                                                   ({**SI, "width": 0.2, "tank": 0.2, "end": 3.375 * SI_UNITS["time"]}, 0.2, SI_UNITS["pressure"])])
def test_probes_of_a_tank_at_rest(lammps, top, length, pressure):
    """Pressure in both ways, level, and force on a wall are those of hydrostatics; the tank stays at rest. Only the top changes."""
    changes = ("0.117", "0.23"), ("0.267", "0.77"), ("c_thrust\n", "c_thrust ke\n")    # a tap that is no whole number of spacings long
    result = lammps(dam_of_page(*changes, n=20, **top))
    assert not result.warnings, result.warnings
    probes = {name: column[-10:].mean() for name, column in result.thermo()[-1].items()}
    assert probes["v_tap"] / pressure == pytest.approx(0.5, abs=0.01)
    assert probes["c_gauge[1]"] / pressure == pytest.approx(0.5, abs=0.01)
    assert probes["c_gauge[2]"] / length == pytest.approx(1.0, abs=0.01)
    assert probes["v_front"] / length == pytest.approx(1.0, abs=0.01)
    assert probes["c_thrust"] / pressure / length == pytest.approx(0.5, abs=0.01)
    assert np.sqrt(2 * probes["KinEng"] / pressure) / length < 5e-3      # what is left of the start


def test_dam_break_of_the_page_in_si_units(lammps):
    """The flow of the page with other numbers at the top is the same one, in other units."""
    plain = lammps(dam_of_page(("thermo          100", "thermo 25"), end=0.45)).thermo()[-1]
    scale, time, pressure = SI_UNITS["length"], SI_UNITS["time"], SI_UNITS["pressure"]
    top = {**SI, "width": 2 * scale, "tank": 5.366 * scale, "mu": 1e-6 * pressure * time, "end": 0.45 * time}
    result = lammps(dam_of_page(("thermo          100", "thermo 25"), **top))
    assert not result.warnings, result.warnings
    (table,) = result.thermo()
    for name, unit in (("Time", time), ("v_front", scale), ("c_gauge[2]", scale)):
        np.testing.assert_allclose(table[name] / unit, plain[name], rtol=1e-6, err_msg=name)


@pytest.mark.long
def test_narrow_column_of_the_page(lammps):
    """The command line of the page: the spray reaches the lid and does not leave the tank."""
    words = re.search(r"``((?:-var \w+ \S+ ?)+)``", PAGE)[1].split()
    top = dict(zip(words[1::3], words[2::3]))
    assert {"H", "width", "tank", "g", "rho0", "mu", "end"} <= set(top)
    changes = ("compute         front", "compute high water reduce max y\ncompute         front"), ("c_thrust\n", "c_thrust c_high atoms\n")
    result = lammps(dam_of_page(*changes, **{**top, "end": 1.0}))
    assert not result.warnings, result.warnings
    (table,) = result.thermo()
    assert table["v_front"].max() == pytest.approx(float(top["tank"]), abs=0.02)
    print(table["c_high"].max())
    assert table["Atoms"][-1] == table["Atoms"][0] and table["c_high"].max() < 1.0


def test_frequency_of_sloshing(lammps):
    """After the push, the center of the water swings with the frequency of linear waves."""
    result = lammps(recipe("Sloshing"))
    assert not result.warnings, result.warnings
    time, center = (result.thermo()[-1][name] for name in ("Time", "v_center"))
    k = np.pi
    free = time > 0.6
    omegas = np.sqrt(k * np.tanh(0.5 * k)) * np.linspace(0.9, 1.1, 401)

    def misfit(omega):
        waves = np.column_stack([np.cos(omega * time[free]), np.sin(omega * time[free]), np.ones(free.sum())])
        return np.linalg.lstsq(waves, center[free], rcond=None)[1][0]

    found = min(omegas, key=misfit) / np.sqrt(k * np.tanh(0.5 * k))
    assert found == pytest.approx(1.0, abs=0.02)
    assert 0.005 < np.ptp(center[free]) / 2 < 0.01
