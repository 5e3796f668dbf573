"""fix sph/open together with others: walls, spin, variables, regions, several zones, types, gases; from its definition to its end."""

import numpy as np
import pytest

from open_boundaries import Channel, account, columns, dump
from test_open import U, lattice_mass, stream, unsteady, wavy
from test_open_ledger import PLANE, agitated, assert_balance, keywords, output


def last_column(lammps, name, column):
    return lammps.frame(name).columns[column]


# ---------------------------------------------------------------------------------------------
# what enters


def test_zones_beside_walls(lammps):
    """A stream between walls that let it slip, over three lengths: what is left is that its lattice moves past theirs."""
    channel = Channel(box="walls", width=10)
    steps = int(3 * channel.length / U / 0.25)
    lammps(channel.text(lammps, f"velocity {channel.vector(U)}", "density 1.0", velocity=lambda p: stream(p) * (p[:, 1:2] > 0)
                        * (p[:, 1:2] < channel.width), timestep=0.25)
           + dump("out.dump", steps) + "variable n equal count(fluid)\nthermo_style custom step v_n\nthermo 100\n"
           f"thermo_modify norm no\nrun {steps}\n")
    frame = lammps.frame("out.dump")
    wet = (frame["x"][:, 1] > 0) & (frame["x"][:, 1] < channel.width)
    error = np.abs(frame["v"][wet] - U * channel.along).max() / U
    count = lammps.results[-1].thermo()[-1]["v_n"]
    print("velocity", error, "particles", count.min(), count.max())
    assert error < 0.02
    assert np.abs(count - count[0]).max() <= channel.width


@pytest.mark.parametrize("ranks", [1, 2])
def test_spin_is_carried_in(lammps, ranks):
    """Without friction between spin and flow, each particle keeps what it brought; it has a moment of inertia."""
    channel = Channel()
    lammps(channel.text(lammps, f"velocity {channel.vector(U)} spin 0 0 v_w", "density 1.0", velocity=stream, spin=0.2,
                        before="variable w atom 0.3+0.01*y\n",
                        **{**keywords("sph/micropolar"), "coeff": "1.0 1.0 0.1 0.2 0 0 0 {R}"})
           + dump("out.dump", 800, "omegaz") + "run 800\n", ranks=ranks)
    frame = lammps.frame("out.dump")
    new = frame["id"] > 257
    assert new.sum() > 100
    np.testing.assert_allclose(frame["omegaz"][new], 0.3 + 0.01 * frame["x"][new, 1], rtol=1e-12)
    kept = (frame["id"] > 64) & (frame["id"] <= 256) & (frame["x"][:, 0] > 14)
    assert kept.any() and (frame["omegaz"][kept] == 0.2).all()


@pytest.mark.parametrize("ranks", [1, 4])
def test_velocity_that_depends_on_time_and_place(lammps, ranks):
    """Particles of the zone have it at the end of each step, when it is and where they are, to the second order of the step."""
    channel = Channel()
    lammps(channel.text(lammps, "velocity v_u v_v 0 condition fixed", "density 1.0", timestep=0.25, velocity=stream,
                        before="variable u atom 0.1+0.05*sin(0.3*step*dt)*cos(2*PI*y/8)\nvariable v equal 0.02*sin(0.5*step*dt)\n")
           + dump("out.dump", 20, "v_u") + "run 400\n", ranks=ranks)
    for frame in lammps.frames("out.dump"):
        zone = frame["x"][:, 0] < 0.0
        time = 0.25 * frame.step
        want = 0.1 + 0.05 * np.sin(0.3 * time) * np.cos(2 * np.pi * frame["x"][zone, 1] / 8)
        assert np.abs(frame["v"][zone, 0] - want).max() < 3e-5
        assert np.abs(frame["v"][zone, 1] - 0.02 * np.sin(0.5 * time)).max() < 1e-13


@pytest.mark.parametrize("ranks", [1, 2])
def test_types_enter_in_their_rows(lammps, ranks):
    channel = Channel()
    lammps(channel.text(lammps, f"velocity {channel.vector(U)}", "density 1.0", velocity=stream, timestep=0.25)
           .replace("read_data box.data", "read_data box.data extra/atom/types 1\nregion high block INF INF 4 INF INF INF\n"
                    "set region high type 2").replace("thermo_modify", "pair_coeff 2 2 1.0 1.0 0.3 0.6 3.0\nthermo_modify")
           + dump("out.dump", 1000, "type") + "run 1000\n", ranks=ranks)
    frame = lammps.frame("out.dump")
    assert (frame["type"] == np.where(frame["x"][:, 1] > 4, 2, 1)).all()
    assert (frame["id"] > 257).sum() > 150
    assert np.abs(frame["v"] - U * channel.along).max() < 1e-10 * U


@pytest.mark.parametrize("condition", ["lagged", "characteristic", "fixed"])
def test_ideal_gas(lammps, condition):
    """Warm gas in motion: as uniform as what enters, but for round-off, which its pressure lets grow on a lattice."""
    channel = Channel()
    steps = int( channel.length / U / 0.1)
    mass = lattice_mass(lammps)
    lammps(channel.text(lammps, f"velocity {channel.vector(U)} energy 2.5 condition {condition}", f"pressure 1.0 condition {condition}",
                        velocity=stream, timestep=0.1, options="eos ideal", esph=2.5 * mass, mass=mass, integrate="")
           + "compute e all property/atom esph\n" + dump("out.dump", steps, "c_e") + f"run {steps}\n")
    frame = lammps.frame("out.dump")
    errors = (np.abs(frame["v"] - U * channel.along).max() / U, np.abs(frame["c_RHO"] - 1.0).max(),
              np.abs(frame["c_e"] / mass / 2.5 - 1.0).max())
    print(errors)
    assert max(errors) < 1e-7


def test_energy_of_what_enters(lammps):
    """Without heat capacity, what enters has the given internal energy, and what was there keeps its own."""
    channel, mass = Channel(), lattice_mass(lammps)
    lammps(channel.text(lammps, f"velocity {channel.vector(U)} energy 2.5", "density 1.0", velocity=stream, timestep=0.25, mass=mass, esph=0.5 * mass, integrate="")
           + "compute e all property/atom esph\n" + dump("out.dump", 400, "c_e") + "run 400\n", ranks=2)
    frame = lammps.frame("out.dump")
    fluid = (frame["x"][:, 0] > 1.0) & (frame["x"][:, 0] < channel.length)
    entered = frame["x"][:, 0] < 0.25 * 400 * U - 1.0
    for here, energy in ((fluid & entered, 2.5), (fluid & (frame["x"][:, 0] > 0.25 * 400 * U + 1.0), 0.5)):
        assert here.sum() > 20
        np.testing.assert_allclose(frame["c_e"][here], energy * mass, rtol=1e-9)


def test_averages_begin_when_there_is_fluid(lammps):
    """A gap in front of the outlet, whose velocity is from inside: when the stream arrives, it goes on as before.  With averages
    that began at zero in the gap, the zone would stop."""
    channel = Channel()
    text = channel.text(lammps, f"velocity {channel.vector(U)} density 1.0", "density 1.0 average 1000.0", velocity=stream,
                        coeff="1.0 0.01 0.01 0.02 {R}").replace("pair_style", "region gap block 12 16 INF INF INF INF\n"
                        "group gap region gap\ndelete_atoms group gap compress no\npair_style", 1)
    lammps(text + "variable u equal vcm(out,x)\nthermo_style custom step v_u f_out[30]\nthermo 20\nrun 140\n")
    (table,) = lammps.results[-1].thermo()
    assert table["f_out[30]"][0] == 0.0 and table["f_out[30]"][-1] > 0.5 * U, "no gap, or it has not closed"
    print(table["v_u"] / U - 1.0)
    assert np.abs(table["v_u"] / U - 1.0).max() < 0.1


def accelerated(time, difference, length, T):
    """Velocity of a column of fluid (rho = c = 1) between two ends with given pressures, by the impedance of the theory page:
    at the outlet p = u - <u> - <J>/2 with J = u - <u> + p, averages over the time T."""
    dt, u, mean_u, mean_J = 0.01, 0.0, 0.0, 0.0
    for _ in range(int(round(time / dt))):
        p = u - mean_u - 0.5 * mean_J
        J = u - mean_u + p
        mean_J += dt / T * (J - mean_J)
        mean_u += dt / T * (u - mean_u)
        u += dt * (difference - 2.0 * p) / length
    return u


def test_ends_with_pressures_are_a_column_of_fluid(lammps):
    """The stream speeds up as with c T/3 of fluid more at either end."""
    channel, T, difference = Channel(), 20.0, 0.02
    lammps(channel.text(lammps, f"pressure {difference} average {T}", f"pressure 0.0 average {T}", coeff="1.0 1.0 0.02 0.04 {R}")
           + "variable u equal vcm(fluid,x)\nthermo_style custom step time v_u\nthermo 400\nrun 800\n")
    (table,) = lammps.results[-1].thermo()
    for time, u in zip(table["Time"][1:], table["v_u"][1:]):
        print(time, u, accelerated(time, difference, channel.length, T))
        assert u == pytest.approx(accelerated(time, difference, channel.length, T), rel=0.03)
    late = difference / (channel.length + 2.0 * T / 3.0)
    assert (table["v_u"][2] - table["v_u"][1]) / (table["Time"][2] - table["Time"][1]) == pytest.approx(late, rel=0.05)


# ---------------------------------------------------------------------------------------------
# where the zones are


@pytest.mark.parametrize("ranks", [1, 4])
def test_zone_with_fluid_at_its_side(lammps, ranks):
    """A region ends the zone; its particles act on fluid beside it, too, and the account has that."""
    channel = Channel(width=16)
    split = ("region half block INF 0 8 INF INF INF\ngroup beside region half\ngroup wet union fluid beside\n"
             "group inlet subtract in beside\n")
    text = channel.text(lammps, f"velocity {channel.vector(U)} region low", "density 1.0", velocity=agitated(channel), timestep=0.25,
                        after_read="region low block INF INF 0 8 INF INF\n" + split, integrate="")
    text = text.replace("fix 1 fluid", "fix 1 wet").replace("fix in in sph/open fluid", "fix in inlet sph/open wet").replace(
        "sph/open fluid", "sph/open wet")
    lammps(text + output(channel, "sph/bulk").replace("fluid", "wet") + "run 200\n", ranks=ranks)
    (table,) = lammps.results[-1].thermo()
    assert np.abs(table["f_in[22]"]).max() > 1e-3
    assert_balance(table, ("n", "m", "px", "py"))


@pytest.mark.parametrize("size", [1e200, 1e-200])
def test_normal_of_any_length(lammps, size):
    channel = Channel(kind="hex", length=20)
    frames = []
    for scale in ("1.0", repr(size)):
        lammps(unsteady(lammps, channel).replace("0.0 0.0 0.0 1.0 0.0 0.0", f"0.0 0.0 0.0 {scale} 0.0 0.0")
               + dump("out.dump", 20) + "run 20\n")
        frames.append(lammps.frame("out.dump"))
    assert (frames[0]["x"] == frames[1]["x"]).all()


def test_region_that_just_fits(lammps):
    """It ends with the zone, with its first and last row, and with what is measured."""
    channel = Channel(kind="hex", length=20)
    numbers = []
    for region, words in (("", ""), (f"region tube block -8 2.4 {0.5 * channel.pitch[1]} {channel.place[:, 1].max()} INF INF\n", "region tube")):
        lammps(channel.text(lammps, f"velocity {channel.vector(U)} {words}", "density 1.0", velocity=stream, after_read=region, timestep=0.25)
               + "thermo_style custom step f_in[28] f_in[1]\nrun 60\nrun 60\n", ranks=2)
        numbers.append([table[name][-1] for table in lammps.results[-1].thermo() for name in ("f_in[28]", "f_in[1]")])
    assert numbers[0] == numbers[1] and numbers[0][-1] > 16


def cross(lammps, ranks, steps):
    """A square of fluid with a zone at each side: two inlets, two outlets."""
    grid = np.arange(-9, 21) + 0.5
    x, y = (a.ravel() for a in np.meshgrid(grid, grid))
    parts = {"fluid": (x > 0) & (x < 12) & (y > 0) & (y < 12), "left": (x < 0) & (y > 0) & (y < 12), "right": (x > 12) & (y > 0) & (y < 12),
             "low": (y < 0) & (x > 0) & (x < 12), "high": (y > 12) & (x > 0) & (x < 12)}
    lines, groups, n = [], "", 0
    for name, mask in parts.items():
        groups += f"group {name} id {n + 1}:{n + mask.sum()}\n"
        lines += [f"{n + k + 1} 1 1.0 0.0 {a + 0.1} {b + 0.1} 0.0" for k, (a, b) in enumerate(zip(x[mask], y[mask]))]
        n += mask.sum()
    lammps.path("box.data").write_text(f"\n\n{n} atoms\n1 atom types\n\n-11 23 xlo xhi\n-11 23 ylo yhi\n-0.5 0.5 zlo zhi\n\n"
                                       "Atoms # sph/bulk\n\n" + "\n".join(lines) + "\n")
    zones = {"left": "0 0 0 1 0 0 9 velocity 0.08 0 0", "low": "0 0 0 0 1 0 9 velocity 0 0.08 0",
             "right": "12 0 0 -1 0 0 9 density 1.0", "high": "0 12 0 0 -1 0 9 density 1.0"}
    fixes = "".join(f"fix {name} {name} sph/open fluid {words}\n" for name, words in zones.items())
    channel = Channel(box="free")
    lammps("units lj\ndimension 2\nboundary f f p\natom_style sph/bulk\nread_data box.data\n" + groups
           + "pair_style sph/bulk\npair_coeff * * 1.0 1.0 0.1 0.2 3.0\nneighbor 0.53 bin\nfix 1 fluid sph/bulk density rho0\n"
           + fixes + "timestep 0.25\n" + dump("out.dump", steps) + output(channel, "sph/bulk").replace(
               columns("in", "out"), columns(*zones)) + f"run {steps}\n", ranks=ranks)
    return lammps.frame("out.dump"), lammps.results[-1].thermo()[0], tuple(zones)


def test_four_zones(lammps):
    (one, table, zones), (other, _, _) = cross(lammps, 1, 200), cross(lammps, 4, 200)
    assert (one["id"] == other["id"]).all() and len(np.unique(one["id"])) == len(one["id"])
    assert np.abs(one["x"] - other["x"]).max() < 1e-10
    names = {"n": "v_n", "m": "v_m", "px": "v_px", "py": "v_py", "lz": "c_L[3]"}
    for name, column in names.items():
        change = account(table, name, zones)
        assert np.abs(table[column] - table[column][0] - change).max() < 1e-12 * max(np.abs(table[column]).max(), 100.0), name
    assert min(table[f"f_{zone}[1]"][-1] for zone in ("left", "low")) > 20


def test_zone_beside_another_fluid_of_its_type(lammps):
    """density rho0 of two fluids: the zone gets the factor of its own fluid alone."""
    lammps("units lj\ndimension 2\nboundary f p p\natom_style sph/bulk\nlattice sq 1.0\nregion box block -10 50 0 12 -0.5 0.5\ncreate_box 1 box\n"
           + "".join(f"region {name} block {low} {high} INF INF INF INF\ncreate_atoms 1 region {name}\ngroup {name} region {name}\n"
                     for name, low, high in (("zone", -9, -1), ("fluid", 0, 14), ("other", 30, 44)))
           + "set group all mass 1.0\nset group other mass 1.3\npair_style sph/bulk\npair_coeff * * 1.0 1.0 0.1 0.2 3.0\nneighbor 0.53 bin\n"
           "fix 1 fluid sph/bulk density rho0\nfix 2 other sph/bulk density rho0\n"
           "fix in zone sph/open fluid -0.5 0 0 1 0 0 9 velocity 0 0 0\ntimestep 0.25\n" + dump("out.dump", 1) + "run 0\n")
    frame = lammps.frame("out.dump")
    x, mass = frame["x"][:, 0], frame["mass"]
    assert (abs(mass - mass[x < 0][0]) < 1e-12).all() and abs(mass[0] - 1.0) < 0.02


# ---------------------------------------------------------------------------------------------
# LAMMPS around it


@pytest.mark.parametrize("before, after", [("atom_modify map array\n", ""), ("atom_modify map hash\n", ""), ("", "comm_style tiled\nbalance 1.0 rcb\n"),
                                           ("", "fix B all balance 20 1.0 shift xy 5 1.1\n"), ("", "neigh_modify every 7 delay 0 check no\n"),
                                           ("atom_modify sort 10 1.0\n", ""), ("", "fix D all property/atom i_mark ghost yes\n")])
def test_settings_that_do_not_matter(lammps, before, after):
    """To a uniform stream."""
    channel = Channel(kind="hex")
    lammps(channel.text(lammps, f"velocity {channel.vector(U)}", "density 1.0", velocity=stream, timestep=0.25, before=before)
           + after + dump("out.dump", 2000) + "run 2000\n", ranks=2)
    frame = lammps.frame("out.dump")
    assert frame["id"].max() > 600 and len(np.unique(frame["id"])) == len(frame["id"])
    assert np.abs(frame["v"] - U * channel.along).max() < 1e-10 * U
    assert np.abs(frame["c_RHO"] - 1.0).max() < 1e-10


def test_speed_of_sound_by_fix_adapt(lammps):
    """The default time of the average is that of the speed of sound in effect."""
    channel = Channel(kind="hex", length=20)
    frames = []
    for c0, after in ((1.5, ""), (1.0, "variable c equal 1.5\nfix A all adapt 0 pair sph/bulk c0 * * v_c\n")):
        lammps(channel.text(lammps, f"velocity {channel.vector(U)}", "density 1.0", velocity=wavy(channel), timestep=0.2,
                            coeff=f"1.0 {c0} 0.1 0.2 {{R}}") + after + dump("out.dump", 100) + "run 100\n")
        frames.append(lammps.frame("out.dump"))
    for name in ("x", "v", "c_RHO"):
        assert np.abs(frames[0][name] - frames[1][name]).max() < 1e-12, name


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("before", [True, False])
def test_particles_that_split_and_merge(lammps, before, ranks):
    """By a fix that is defined before the zones or after them: the account of number, mass, and momentum closes."""
    channel = Channel()
    text = channel.text(lammps, f"velocity {channel.vector(0.4)} density 1.0", "density 1.0", timestep=0.05, options="volume mass",
                        coeff="1.0 4.0 0.1 0.2 {R}", before='variable t atom "0.4+2.2*(x>8)"\n',
                        velocity=lambda place: np.tile([0.4, 0.0, 0.0], (len(place), 1)))
    text = text.replace("fix in in" if before else "timestep", "fix R fluid sph/refine 1 volume v_t wait 0.0\n"
                        + ("fix in in" if before else "timestep"), 1)
    lammps(text + output(channel, "sph/bulk", 5).replace("v_n v_m", "f_R[1] f_R[2] f_R[3] v_n v_m") + "run 400\n", ranks=ranks)
    (table,) = lammps.results[-1].thermo()
    assert table["f_R[1]"][-1] > 100 and table["f_R[2]"][-1] > 200
    assert table["f_in[1]"][-1] > 150 and table["f_out[11]"][-1] > 30
    assert_balance(table, ("n", "m", "px", "py"), {"n": -table["f_R[3]"]})


def test_results_before_the_first_run(lammps):
    channel = Channel()
    result = lammps(channel.text(lammps, f"velocity {channel.vector(U)}", "density 1.0")
                    + "print \"first: $(f_in[1]) $(f_in[21]) $(f_out[28]) $(f_in[29]) $(f_in[32])\"\nrun 0\nprint \"then: $(f_in[28])\"\n")
    assert "first: 0 0 64 0 0" in result.log and "then: 64" in result.log


def test_fix_comes_and_goes(lammps):
    """Defined anew in the middle of a stream, with the zone where it is then; without it, its particles stay."""
    channel = Channel()
    inlet = f"fix in {channel.plane('in')} velocity {channel.vector(U)}\n"
    lammps(channel.text(lammps, f"velocity {channel.vector(U)}", "density 1.0", velocity=stream, timestep=0.25)
           + "run 333\nunfix in\n" + inlet + dump("out.dump", 700) + "run 367\nunfix in\nunfix out\nrun 0\n"
           "fix 2 in sph/bulk\nfix 3 out sph/bulk\nrun 100\n")
    frame = lammps.frames("out.dump")[0]
    assert np.abs(frame["v"] - U * channel.along).max() < 1e-10 * U and np.abs(frame["c_RHO"] - 1.0).max() < 1e-10


@pytest.mark.parametrize("commands", ["pair_style none\nunfix in\nunfix out\n", "clear\n", "unfix in\nunfix out\nclear\n",
                                      "pair_style sph/bulk\npair_coeff * * 1.0 1.0 0.1 0.2 3.0\nrun 20\n",
                                      "pair_style sph/bulk\npair_coeff * * 1.0 1.0 0.1 0.2 3.0\nunfix in\nunfix out\nrun 20\n",
                                      "unfix out\ngroup out delete\n", "run 20 pre no\nunfix in\nrun 20 pre no\n"])
def test_pair_style_and_fix_come_and_go(lammps, commands):
    channel = Channel()
    lammps(channel.text(lammps, f"velocity {channel.vector(U)}", "density 1.0", velocity=wavy(channel)) + "run 20\n" + commands)


def test_new_pair_style_feels_the_zones(lammps):
    channel = Channel(length=20)
    frames = []
    for again in ("", "pair_style sph/bulk\npair_coeff * * 1.0 1.0 0.1 0.2 3.0\n"):
        lammps(unsteady(lammps, channel) + "run 50\n" + again + dump("out.dump", 50) + "run 50\n")
        frames.append(lammps.frame("out.dump"))
    assert np.abs(frames[0]["v"] - frames[1]["v"]).max() < 1e-13


def test_restart_with_another_plane(lammps):
    """What is known of the other plane is forgotten, and that is said."""
    channel = Channel(width=8)
    lammps(unsteady(lammps, channel) + "run 50\nwrite_restart state.restart\n")
    result = lammps("read_restart state.restart\nfix 1 fluid sph/bulk density rho0\n"
                    f"fix out {channel.plane('in')} velocity {channel.vector(U)} spacing 1\nfix in {channel.plane('out')} density 1.0 spacing 1\n"
                    "timestep 0.25\nrun 10\n")
    assert result.log.count("the plane is not that of the restart file") == 2
