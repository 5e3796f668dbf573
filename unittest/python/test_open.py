"""fix sph/open: a stream that passes undisturbed, on any number of ranks; restarts; flow that reverses."""

import struct

import numpy as np
import pytest

from helpers import relative
from open_boundaries import SKIN, Channel, account, columns, dump, errors

U = 0.1


def stream(place):
    return np.tile([U, 0.0, 0.0], (len(place), 1))


CHANNELS = {
    "square": dict(kind="sq"),
    "hexagonal": dict(kind="hex"),
    "rows across": dict(kind="hexrows", zone=9.0),
    "down": dict(kind="hex", direction=(0, -1)),
    "oblique": dict(kind="sq", direction=(0.8, -0.6), box="triclinic"),
    "oblique, hexagonal": dict(kind="hex", direction=(np.cos(0.3), -np.sin(0.3)), box="triclinic"),
    "3d": dict(dim=3, direction=(0, 0, 1), support=2.5, zone=7.0, width=6, length=8),
}


# ---------------------------------------------------------------------------------------------
# a uniform stream


@pytest.mark.parametrize("outlet", ["density 1.0", "density 1.0 condition characteristic", "condition fixed"])
@pytest.mark.parametrize("name", CHANNELS)
def test_uniform_stream(lammps, name, outlet):
    """After ten flow-throughs at the square lattice, for all outlets; after five on the others, for the default."""
    if outlet != "density 1.0" and name not in ("square", "oblique"):
        pytest.skip("covered by the other lattices")
    channel = Channel(**CHANNELS[name])
    passes = 10 if name == "square" else 5
    steps = int(passes * channel.length / U / 0.25)
    lammps(channel.text(lammps, f"velocity {channel.vector(U)}", outlet, velocity=stream, timestep=0.25)
           + dump("out.dump", steps) + f"thermo_style custom step {columns('in', 'out')}\n"
           f"thermo_modify norm no format float %.17g\nthermo {steps}\nrun {steps}\n")
    first, last = lammps.frames("out.dump")
    assert len(np.intersect1d(first["id"], last["id"])) == 0, "a particle of the start is still there"
    (table,) = lammps.results[-1].thermo()
    assert table["f_in[1]"][-1] > 0.9 * passes * len(first["id"]) * channel.length / (channel.length + 2 * channel.zone)
    errors = (np.abs(last["v"] - U * channel.along).max() / U, np.abs(last["c_RHO"] - 1.0).max())
    print("velocity, density", *errors)
    assert max(errors) < 1e-10


def some(names, ranks, newton, short):
    """The other channels are long."""
    return [pytest.param(name, ranks, newton, marks=[] if name in short else pytest.mark.long) for name in names]


@pytest.mark.parametrize("name, ranks, newton", [
    *some(CHANNELS, 2, "off", ("square", "rows across", "down", "oblique, hexagonal", "3d")),
    *some(CHANNELS, 4, "on", ("hexagonal", "oblique")), *some(CHANNELS, 4, "off", ("3d",))])
def test_stream_does_not_depend_on_the_number_of_ranks(lammps, name, ranks, newton):
    """Tags and positions of each particle, also of the many that came in the run; newton on and off."""
    channel = Channel(**CHANNELS[name])
    steps = 480  # twelve spacings: more than the zone is long
    frames = []
    for number, law in ((1, "on"), (ranks, newton)):
        lammps(channel.text(lammps, f"velocity {channel.vector(U)}", "density 1.0", velocity=stream, timestep=0.25,
                            newton=law) + dump("out.dump", steps) + f"run {steps}\n", ranks=number)
        frames.append(lammps.frame("out.dump"))
    one, other = frames
    assert one["id"].max() > 1.2 * len(one["id"])
    assert (other["id"] == one["id"]).all()
    difference = np.abs(np.stack([other["x"] - one["x"], other["v"] - one["v"]])).max()
    print(f"{difference:.2e}")
    assert difference < 1e-11


def wavy(channel, size=0.02):
    """A stream with eddies, everywhere but in the zones."""
    def velocity(place):
        s, t = 2 * np.pi * place[:, 0] / channel.length, 2 * np.pi * place[:, 1] / channel.width
        inside = (place[:, 0] > 0) & (place[:, 0] < channel.length)
        swirl = np.column_stack([np.sin(s) * np.cos(t), -np.cos(s) * np.sin(t), 0 * s])
        return stream(place) + size * inside[:, None] * swirl
    return velocity


@pytest.mark.parametrize("condition", ["", "condition characteristic", "condition fixed order 1"])
def test_eddies_do_not_depend_on_the_number_of_ranks(lammps, condition):
    """A flow that varies along the planes and in time, as long as round-off has not grown."""
    channel = Channel(kind="hex", length=20)
    frames = []
    for ranks, newton in ((1, "on"), (2, "on"), (4, "off")):
        lammps(channel.text(lammps, f"velocity {channel.vector(U)} {condition.replace(' order 1', '')}",
                            "density 1.0 " + condition,
                            velocity=wavy(channel), newton=newton, coeff="1.0 1.0 0.02 0.05 {R}")
               + dump("out.dump", 300) + "run 300\n", ranks=ranks)
        frames.append(lammps.frame("out.dump"))
    assert np.ptp(frames[0]["vy"]) > 0.001
    for frame in frames[1:]:
        assert (frame["id"] == frames[0]["id"]).all()
        difference = np.abs(np.stack([frame["x"] - frames[0]["x"], frame["v"] - frames[0]["v"]])).max()
        print(f"{difference:.2e}")
        assert difference < 1e-11


def test_rows_of_given_area(lammps):
    """The distance of particles that enter follows from density and area; here it is that of the lattice."""
    channel = Channel()
    steps = int(3 * channel.length / U / 0.25)
    mass = lattice_mass(lammps)
    text = channel.text(lammps, f"velocity {channel.vector(U)} density 1.0 area 1.0", "density 1.0", velocity=stream,
                        timestep=0.25, integrate="")
    lammps(text.replace("fix in", f"set group all mass {mass}\nfix in").replace("area 1.0", f"area {mass}")
           + dump("out.dump", steps) + f"run {steps}\n")
    last = lammps.frame("out.dump")
    assert np.abs(last["v"] - U * channel.along).max() < 1e-10 * U
    assert np.abs(last["c_RHO"] - 1.0).max() < 1e-10


def lattice_mass(lammps):
    """Of a particle of the square lattice with density 1 as the kernel sums it up."""
    lammps(Channel().text(lammps, "velocity 0 0 0", "density 1.0") + dump("mass.dump", 1) + "run 0\n")
    return float(lammps.frame("mass.dump")["mass"][0])


# ---------------------------------------------------------------------------------------------
# restarts, run commands

def unsteady(lammps, channel, **keywords):
    return channel.text(lammps, f"velocity {channel.vector(U)} average 40", "density 1.0", velocity=wavy(channel), **keywords)


def after_read(channel):
    return ("fix 1 fluid sph/bulk density rho0\n"
            f"fix in {channel.plane('in')} velocity {channel.vector(U)} average 40\nfix out {channel.plane('out')} density 1.0\n"
            f"timestep 0.3\nneighbor {SKIN} bin\n")


LEDGER = f"thermo_style custom step {columns('in', 'out', entries=32)}\nthermo_modify norm no format float %.17g\nthermo 40\n"


@pytest.mark.parametrize("before, after", [(1, 1), (2, 4), (4, 1)])
@pytest.mark.parametrize("steps", [37, 200])
def test_restart(lammps, before, after, steps):
    """Equals a second run command; nothing is lost or doubled; the accounts and the waves go on."""
    channel = Channel(kind="hex", length=20)
    lammps(unsteady(lammps, channel) + f"run {steps}\nwrite_restart state.restart\n" + dump("whole.dump", 100) + LEDGER
           + "run 100\n", ranks=before)
    lammps("read_restart state.restart\n" + after_read(channel) + dump("parts.dump", 100) + LEDGER + "run 100\n",
           ranks=after)
    for whole, parts in zip(lammps.frames("whole.dump"), lammps.frames("parts.dump"), strict=True):
        assert (whole["id"] == parts["id"]).all() and (whole["mass"] == parts["mass"]).all()
        assert np.abs(whole["x"] - parts["x"]).max() < 1e-12
        assert np.abs(whole["v"] - parts["v"]).max() < 1e-13
    whole, parts = (result.thermo()[-1] for result in lammps.results[-2:])
    for key in whole:
        assert np.abs(whole[key] - parts[key]).max() < 1e-11 * max(np.abs(whole[key]).max(), 1.0), key
    assert whole["f_in[1]"][-1] > whole["f_in[1]"][0] > 0


@pytest.mark.parametrize("form, word", [(96.0, "an older"), (-1003.0, "an older"), (-1005.0, "a newer")])
def test_restart_file_of_another_version(lammps, form, word):
    channel = Channel(kind="hex", length=20)
    lammps(unsteady(lammps, channel) + "write_restart state.restart\n")
    data = lammps.path("state.restart").read_bytes()
    head = struct.pack("<d", -1004.0)
    assert data.count(head) == 2
    lammps.path("state.restart").write_bytes(data.replace(head, struct.pack("<d", form)))
    result = lammps("read_restart state.restart\n" + after_read(channel), ranks=2, check=False)
    assert result.code != 0 and f"Fix sph/open in: the restart file was written by {word} version of this fix" in errors(result)


def test_restart_is_close_to_the_run_without_it(lammps):
    """Lists are built at the same steps, for what enters stands behind the last one of its row as that is then.  What
    differs is the start of any run: its first forces have the velocities, not the extrapolated ones."""
    channel = Channel(kind="hex", length=20)
    text = unsteady(lammps, channel) + "neigh_modify every 5 delay 0 check no\n"
    lammps(text + dump("whole.dump", 100) + "run 100\n")
    lammps(text + "run 50\nwrite_restart state.restart\n")
    lammps("read_restart state.restart\n" + after_read(channel) + "neigh_modify every 5 delay 0 check no\n"
           + dump("parts.dump", 100) + "run 50\n", ranks=2)
    whole, parts = lammps.frame("whole.dump"), lammps.frame("parts.dump")
    assert (whole["id"] == parts["id"]).all()
    assert np.abs(whole["x"] - parts["x"]).max() < 5e-6
    assert np.abs(whole["v"] - parts["v"]).max() < 5e-6


@pytest.mark.parametrize("runs", ["run 50\nrun 100 pre no\nrun 100 pre no\n", "run 250 pre no every 40 NULL\n"])
def test_run_commands_without_setup(lammps, runs):
    """run pre no and run every go on as one run does."""
    channel = Channel(kind="hex", length=20)
    lammps(unsteady(lammps, channel) + dump("one.dump", 250) + "run 250\n")
    lammps(unsteady(lammps, channel) + dump("two.dump", 250) + runs)
    one, two = lammps.frame("one.dump"), lammps.frame("two.dump")
    assert (one["id"] == two["id"]).all()
    assert np.abs(one["x"] - two["x"]).max() < 1e-12


def paused(lammps, pause):
    channel = Channel(kind="hex", length=20)
    lammps(unsteady(lammps, channel) + "run 60\n" + pause + dump("out.dump", 20) + LEDGER + "run 100\n", ranks=2)
    return lammps.frame("out.dump"), lammps.results[-1].thermo()[-1]


@pytest.fixture(scope="module")
def without_pause(shared_lammps):
    return paused(shared_lammps, "")


@pytest.mark.parametrize("pause", ["run 0\nrun 0\n", "reset_timestep 0\n", "timestep 0.3\n", "write_restart x.restart\n",
                                   "write_data x.data\n", "balance 1.0 shift x 5 1.1\n"])
def test_pause(lammps, without_pause, pause):
    """Nothing of these is an event for the zones: what they remember, in particular, is not of this clock."""
    (one, table), (two, other) = without_pause, paused(lammps, pause)
    assert (one["id"] == two["id"]).all()
    assert np.abs(one["x"] - two["x"]).max() < 1e-12
    for key in table:
        if key != "Step":
            assert np.abs(table[key][-1] - other[key][-1]) < 1e-11 * max(np.abs(table[key][-1]), 1.0), key


def hesitating(place):
    """A stream that is slower at the first plane than ahead of it."""
    return stream(place) * (1 - 0.5 * np.exp(-(place[:, :1] / 3)**2))


TAKEN_FROM_INSIDE = [("density 1.01", f"velocity {U} 0 0"), (f"velocity {U} 0 0", "density 1.0"),
                     ("pressure 0.01 condition characteristic", f"velocity {U} 0 0 condition characteristic")]


@pytest.mark.parametrize("inlet, outlet", TAKEN_FROM_INSIDE)
@pytest.mark.parametrize("pause", ["run 0\n", "run 0\nrun 0\nwrite_restart x.restart\nrun 0\n"])
def test_pause_before_the_first_step(lammps, inlet, outlet, pause):
    """Forces that are computed again take the place of those before them: also the first sample, of which there was no average."""
    channel = Channel(kind="hex", length=20)
    frames = []
    for commands in ("", pause):
        lammps(channel.text(lammps, inlet, outlet, velocity=hesitating) + commands + dump("out.dump", 40) + "run 40\n")
        frames.append(lammps.frame("out.dump"))
    assert np.ptp(frames[0]["vx"][:50]) > 1e-3
    for name in ("x", "v", "c_RHO"):
        assert np.abs(frames[1][name] - frames[0][name]).max() < 1e-13, name


@pytest.mark.parametrize("inlet, outlet, order", [(*ends, order) for ends, order in zip(TAKEN_FROM_INSIDE, (1, 2, 1))])
@pytest.mark.parametrize("stage", ["rkl2", "implicit"])
def test_forces_twice_a_step(lammps, inlet, outlet, order, stage):
    """With a viscous stage, which does nothing to a fluid without friction: what is left is the error of the time step."""
    channel = Channel(kind="hex", length=20)
    difference = []
    for timestep in (0.05, 0.025):
        frames = []
        for viscous in ("", f" viscous {stage}"):
            steps = round(4.0 / timestep)
            lammps(channel.text(lammps, inlet, outlet, velocity=hesitating, coeff="1.0 1.0 0.0 0.0 {R}", timestep=timestep,
                                integrate="density rho0" + viscous) + dump("out.dump", steps) + f"run {steps}\n")
            frames.append(lammps.frame("out.dump"))
        difference.append([np.abs(frames[1][name] - frames[0][name]).max() for name in ("x", "v", "c_RHO")])
    ratio = np.divide(*difference)
    print(ratio)
    assert (ratio > 0.97 * 2**order).all()


# ---------------------------------------------------------------------------------------------
# flow that reverses

@pytest.mark.parametrize("kind, ranks", [("sq", 1), ("hex", 1), ("hex", 2), pytest.param("hex", 4, marks=pytest.mark.long)])
def test_flow_that_reverses_four_times(lammps, kind, ranks):
    """Two periods of a plug that goes to and fro by more than the zone is long."""
    channel = Channel(kind=kind)
    period = 200.0
    steps = int(2 * period / 0.25)
    shift = channel.particles()
    velocity = f"variable U equal {0.4}*cos(2*PI*step*dt/{period})\n"
    lammps(channel.text(lammps, "velocity v_U 0 0", "velocity v_U 0 0 density 1.0", timestep=0.25, before=velocity,
                        velocity=lambda place: np.tile([0.4, 0, 0], (len(place), 1)), after_read="")
           .replace("fix in", f"variable A equal -0.4*2*PI/{period}*sin(2*PI*step*dt/{period})*mass(all)/count(all)\n"
                    "fix A fluid addforce v_A 0 0\nfix in")
           + dump("out.dump", steps // 8) + "variable n equal count(fluid)\nvariable m equal mass(fluid)\n"
           f"thermo_style custom step v_n v_m {columns('in', 'out')}\nthermo_modify norm no format float %.17g\n"
           f"thermo {steps // 8}\nrun {steps}\n", ranks=ranks)
    (table,) = lammps.results[-1].thermo()
    print(table["v_n"], table["f_in[1]"], table["f_in[11]"])
    assert table["v_n"][-1] == table["v_n"][0] and abs(table["v_m"][-1] - table["v_m"][0]) < 1e-12 * table["v_m"][0]
    assert min(table["f_in[1]"][-1], table["f_in[11]"][-1], table["f_out[1]"][-1], table["f_out[11]"][-1]) > 2 * 8 * channel.zone
    frames = lammps.frames("out.dump")
    for one in frames:
        assert len(np.unique(one["id"])) == len(one["id"])
    assert np.abs(frames[-1]["c_RHO"] - 1.0).max() < 1e-3
