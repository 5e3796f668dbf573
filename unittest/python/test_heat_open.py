"""fix sph/open and heat: temperature of what enters and leaves, conduction through the planes, sound and warm spots that leave."""

import re

import numpy as np
import pytest

from helpers import relative
from open_boundaries import IMPULSE, Channel, account, columns, dump, errors

U, CV, GAMMA, T0, PB = 0.1, 2.0, 0.6, 0.05, 0.3
COEFF = {  # rho0 = c0 = 1; the pressure of heat is as large as the others
    "linear": f"1.0 1.0 0.05 0.1 {{R}} pb {PB} cv {CV} gruneisen {GAMMA} {T0}",
    "tait": f"1.0 1.0 0.05 0.1 {{R}} pb {PB} cv {CV} gruneisen {GAMMA} {T0}",
    "ideal": f"1.0 1.0 0.05 0.1 {{R}} pb {PB} cv {CV} gamma 1.4",
}
TEMPERATURE = "compute T all property/atom tsph\n"


def pressure(eos, T, rho=1.0):
    """Of the fluids above, whose elastic part is without the heat at T0."""
    if eos == "ideal":
        return PB + 0.4 * rho * CV * T
    cc = 1.0 - GAMMA * (GAMMA + 1) * CV * T0
    elastic = cc * (rho - 1.0) if eos == "linear" else cc / 7 * (rho**7 - 1.0)
    return PB - GAMMA * CV * T0 + elastic + GAMMA * rho * CV * T


def sound(eos, T):
    """At the density 1."""
    return np.sqrt(1.4 * 0.4 * CV * T if eos == "ideal" else 1.0 + GAMMA * (GAMMA + 1) * CV * (T - T0))


def stream(place):
    return place * 0 + [U, 0, 0]


# ---------------------------------------------------------------------------------------------
# streams


@pytest.mark.parametrize("condition", ["lagged", "fixed"])
@pytest.mark.parametrize("eos", COEFF)
def test_hot_stream_stays_uniform(lammps, eos, condition):
    """Conducting, hotter than the reference: temperature of the inlet from a variable, that of the outlet from the fix of the fluid."""
    channel, T = Channel(length=10), 0.15
    steps = int(12 / U / 0.1)
    lammps(channel.text(lammps, f"velocity {channel.vector(U)} temperature v_T condition {condition}",
                        f"pressure {pressure(eos, T)} condition {condition}", velocity=stream, timestep=0.1, options=f"eos {eos}",
                        coeff=COEFF[eos] + " conductivity 0.2", before=f"variable T equal {T}\n", integrate=f"density rho0 temperature {T}")
           + TEMPERATURE + dump("out.dump", steps, "c_T") + f"run {steps}\n")
    for frame in lammps.frames("out.dump"):
        found = (np.abs(frame["v"] - U * channel.along).max() / U, np.abs(frame["c_RHO"] - 1.0).max(), np.abs(frame["c_T"] / T - 1.0).max())
        print(found)
        assert max(found) < 1e-10
    assert (frame["id"] > len(channel.part)).sum() > 60


class WarmSpot(Channel):
    """A stream of constant pressure with a place where it is warmer, T(x) = T [1 + size exp(-((x - middle)/spread)^2)], and thinner."""

    def __init__(self, eos, T, size, spread, middle, **options):
        super().__init__(**options)
        self.formula = f"{T}*(1.0+{size}*exp(-1.0*((x-{middle})/{spread})^2))"
        x = np.linspace(-self.zone - 1.0, self.length + self.zone + 40.0, 20001)
        warm = T * (1.0 + size * np.exp(-(((x - middle) / spread) ** 2)))
        low, high = 0.1 + 0 * x, 3.0 + 0 * x
        for _ in range(60):
            rho = 0.5 * (low + high)
            too_low = pressure(eos, warm, rho) < pressure(eos, T)
            low, high = np.where(too_low, rho, low), np.where(too_low, high, rho)
        number = np.concatenate([[0.0], np.cumsum(0.5 * (rho[1:] + rho[:-1]) * np.diff(x))]) - self.zone - 1.0
        self.place[:, 0] = np.interp(self.place[:, 0], number, x)
        part = np.where(self.place[:, 0] < 0.0, 0, np.where(self.place[:, 0] > self.length, 2, 1))
        order = [i for k in range(3) for i in np.flatnonzero((part == k) & (self.place[:, 0] < self.length + self.zone))]
        self.place, self.part = self.place[order], part[order]


@pytest.mark.parametrize("eos, conductivity", [("linear", 0.05), ("tait", 0.0), ("ideal", 0.0)])
def test_warm_spot_leaves(lammps, eos, conductivity):
    """When it has left, the fluid is as before: of the temperature of the spot less than one percent is left.  The gas has no background pressure,
    with which another arrangement of the particles has another pressure."""
    T, size, length = 0.15, 0.2, 26.0
    channel = WarmSpot(eos, T, size, 5.0, 12.0, length=length, width=7)
    mass = 1.0 / lattice_sum(channel.support)
    steps, dt = 1400, 0.25
    coeff = COEFF[eos].replace(f"pb {PB}", "pb 0.0") if eos == "ideal" else COEFF[eos]
    lammps(channel.text(lammps, f"velocity {channel.vector(U)} temperature {T}", f"pressure {pressure(eos, T) - (PB if eos == 'ideal' else 0.0)}", velocity=stream, timestep=dt,
                        options=f"eos {eos}", coeff=coeff + f" conductivity {conductivity}", integrate="temperature v_start", mass=mass,
                        before=f"variable start atom {channel.formula}\n") + TEMPERATURE + dump("out.dump", steps, "c_T") + f"run {steps}\n")
    first, last = (frame for frame in lammps.frames("out.dump"))
    inside = (last["x"][:, 0] > 0) & (last["x"][:, 0] < length)
    left = np.abs(last["c_T"][inside] / T - 1.0).max() / size
    motion = np.abs(last["v"][inside, 0] - U).max() / sound(eos, T)
    print(first["c_T"].max() / T - 1, left, motion)
    assert first["c_T"].max() / T - 1.0 > 0.98 * size
    assert left < 0.01 and motion < 0.02 * size


def lattice_sum(R):
    """Of the kernel Wendland C2 over a square lattice."""
    n = np.arange(-5, 6)
    q = np.minimum(np.hypot(*np.meshgrid(n, n)) / R, 1.0)
    return (7 / (np.pi * R**2) * (1 - q) ** 4 * (1 + 4 * q)).sum()


@pytest.mark.parametrize("given", ["number", "variable"])
def test_conduction_against_the_stream(lammps, given):
    """T = exp(Pe x/L) between an inlet and an outlet with given temperatures; exact where a variable goes on with it in the zones.  A constant
    temperature of a zone is that of a plane 0.15 support radii behind the end."""
    L, pe, T = 20.0, 2.0, (1.0, 2.0)
    channel = Channel(length=L, width=7)
    behind = 0.0 if given == "variable" else 0.15 * channel.support
    pe *= 1.0 + 2 * behind / L
    place = f"((x+{behind})/{L + 2 * behind})"
    law = f"{T[0]}+{T[1] - T[0]}*(exp({pe}*{place})-1.0)/(exp({pe})-1.0)"
    words = [f"temperature {one}" if given == "number" else "temperature v_law" for one in T]
    text = channel.text(lammps, f"velocity {channel.vector(U)} {words[0]}", f"pressure 0.0 {words[1]}", velocity=stream, timestep=0.1,
                        coeff=f"1.0 1.0 0.05 0.1 {{R}} cv {CV} conductivity {CV * U * (L + 2 * behind) / pe}",
                        integrate="density rho0 temperature v_law", before=f"variable law atom {law}\n")
    lammps(text + TEMPERATURE + dump("out.dump", 1500, "c_T v_law") + "run 1500\n")
    frame = lammps.frame("out.dump")
    inside = (frame["x"][:, 0] > 0) & (frame["x"][:, 0] < L)
    error = np.abs(frame["c_T"] - frame["v_law"])[inside].max()
    print(given, error)
    assert error < {"variable": 2e-3, "number": 1e-2}[given]


@pytest.mark.parametrize("outlet", ["velocity {u} pressure {p}", "velocity {u} pressure {p} temperature {T}", "pressure {p}"])
@pytest.mark.parametrize("eos, bar", [("tait", 0.01), ("ideal", 0.04)])
def test_sound_leaves(lammps, eos, bar, outlet):
    """A pulse in a stream, with the temperature that goes with it: what comes back from the outlet over what arrived there."""
    T, amplitude, width, length = 0.15, 1e-3, 8.0, 120.0
    c = sound(eos, T)
    channel = Channel(length=length, width=9, support=4.0, zone=11.0)
    dt = 0.4 / c
    def velocity(place):
        return place * 0 + np.outer(U + 2 * amplitude * np.exp(-0.5 * ((place[:, 0] - 0.5 * length) / width) ** 2), [1, 0, 0])
    steps = [int(t / dt) for t in (0.25 * length / (c + U), 0.5 * length / (c + U) + 0.25 * length / (c - U))]
    words = outlet.format(u=channel.vector(U), p=pressure(eos, T), T=T)
    text = channel.text(lammps, f"velocity {channel.vector(U)} pressure {pressure(eos, T)} temperature {T}", words, velocity=velocity, timestep=dt,
                        options=f"eos {eos} shear none bulk none", coeff=COEFF[eos].replace("0.05 0.1", "0.0 0.0") + " conductivity 0.005",
                        integrate=f"density rho0 temperature {T}") + TEMPERATURE
    lammps(text + dump("out.dump", steps[0], "c_T") + f"run {steps[0]}\n" + f"dump_modify D every {steps[1]}\nrun {steps[1] - steps[0]}\n")
    there, back = ({key: np.abs(value[(frame["x"][:, 0] > 0.5 * length) & (frame["x"][:, 0] < length)]).max()
                    for key, value in (("u", frame["v"][:, 0] - U), ("T", frame["c_T"] / T - 1.0))} for frame in lammps.frames("out.dump")[1:])
    print({key: back[key] / there[key] for key in back})
    assert there["T"] == pytest.approx(amplitude / c * (0.4 if eos == "ideal" else GAMMA), rel=0.06)
    bar += 0.03 * ("velocity" not in outlet)
    assert back["u"] < bar * there["u"] and back["T"] < bar * there["T"]


def test_temperature_of_what_enters_does_not_depend_on_the_density(lammps):
    """The pressure that is given is that of another density than the particles have by their arrangement, by 12 percent."""
    channel = Channel(length=10, width=7)
    T, p = 0.15, 0.42
    lammps(channel.text(lammps, f"velocity {channel.vector(U)} pressure {p} temperature {T} condition fixed", f"pressure {PB}", velocity=stream, timestep=0.1,
                        coeff=f"1.0 1.0 0.05 0.1 {{R}} pb {PB} cv {CV}", integrate="density rho0 temperature 0.1")
           + TEMPERATURE + dump("out.dump", 500, "c_T") + "run 500\n")
    frame = lammps.frame("out.dump")
    new = (frame["x"][:, 0] > 0) & (frame["x"][:, 0] < 4.0)
    zone = (frame["x"][:, 0] < 0) & (frame["x"][:, 0] > -4.0)
    print(np.ptp(frame["c_T"][new]), frame["c_RHO"][zone].mean(), frame["c_RHO"][new].mean())
    assert frame["c_RHO"][zone].min() > 1.1 and frame["c_RHO"][new].max() < 1.08
    assert np.abs(frame["c_T"][new] / T - 1.0).max() < 5e-3


# ---------------------------------------------------------------------------------------------
# accounts


def agitated(place):
    """A stream with an eddy and a random part in the fluid, steady in the zones."""
    s, t = 2 * np.pi * place[:, 0] / 16.0, 2 * np.pi * place[:, 1] / 8.0
    inside = ((place[:, 0] > 0) & (place[:, 0] < 16.0))[:, None]
    random = np.random.default_rng(1).normal(0.0, 0.02, place.shape) * [1, 1, 0]
    return inside * (0.05 * np.column_stack([np.sin(s) * np.cos(t), -np.cos(s) * np.sin(t), 0 * s]) + random) + [U, 0, 0]


def hot_inlet(lammps, eos, timestep, time, newton="on"):
    """Input of a channel that a hot inlet heats, before its output."""
    channel = Channel(zone=9.0)
    T = "0.1+0.02*x/16" if eos == "ideal" else "0.05+0.02*x/16"  # which is close to the density 1
    return channel.text(lammps, f"velocity {channel.vector(U)} average 40 temperature {1.2 * T0 if eos != 'ideal' else 0.12}",
                        f"pressure {pressure(eos, 0.1 if eos == 'ideal' else T0)}", velocity=agitated, timestep=timestep, options=f"eos {eos}", newton=newton,
                        coeff=COEFF[eos] + " conductivity 0.2", integrate="density rho0 temperature v_start", before=f"variable start atom {T}\n")


@pytest.mark.parametrize("eos", ["linear", "tait", "ideal"])
def test_energy(lammps, eos):
    """Energy of the fluid against what the zones carried, did, and conducted: to the second order of the time step, as in a closed box."""
    errors_of, time = [], 12
    for timestep in (0.04, 0.02, 0.01):
        lammps(hot_inlet(lammps, eos, timestep, time) + "compute E fluid sph/energy\nthermo 1\n"
               f"thermo_style custom step c_E {columns('in', 'out')}\nthermo_modify norm no format float %.17g\nrun {int(time / timestep)}\n")
        (table,) = lammps.results[-1].thermo()
        change = account(table, "ke") + account(table, "e") + sum(table[f"f_{fix}[{IMPULSE['work']}]"] for fix in ("in", "out"))
        errors_of.append(np.abs((table["c_E"] - table["c_E"][0]) - (change - change[0])).max())
    print(errors_of, "of", np.ptp(table["c_E"]))
    assert errors_of[0] < 0.01 * np.ptp(table["c_E"])
    assert errors_of[1] < 0.35 * errors_of[0] and errors_of[2] < 0.35 * errors_of[1]


def test_conducted_heat(lammps):
    """Fluid at rest between two ends: what it gains is what the zones conduct, to round-off."""
    channel = Channel(length=12, width=6)
    text = channel.text(lammps, "pressure 0.0 temperature 2.0", "pressure 0.0 temperature 1.0", coeff=f"1.0 1.0 0.05 0.1 {{R}} cv {CV} conductivity 2.0",
                        integrate="density rho0 temperature 1.0", timestep=0.1)
    lammps(text + "compute E fluid sph/energy\n" f"thermo_style custom step c_E {columns('in', 'out')}\nthermo 40\n"
           "thermo_modify norm no format float %.17g\nrun 2000\n", ranks=2)
    (table,) = lammps.results[-1].thermo()
    gain, heat = table["c_E"] - table["c_E"][0], table["f_in[27]"] + table["f_out[27]"]
    assert np.abs(gain - heat).max() < 1e-11 * gain.max()
    flow = np.diff(table["f_in[27]"])[-1] / 4.0, -np.diff(table["f_out[27]"])[-1] / 4.0
    print(gain[-1], flow)
    assert gain[-1] == pytest.approx(0.5 * CV * 12 * 6, rel=0.02)
    assert flow[0] == pytest.approx(flow[1], rel=1e-2) and flow[0] == pytest.approx(2.0 * 6 / (12 + 0.4 * channel.support), rel=0.02)


# ---------------------------------------------------------------------------------------------
# how the same is computed in other ways


def repeat(lammps):
    """What an input needs after a restart file."""
    text = hot_inlet(lammps, "tait", 0.1, None)
    return text, re.sub(r"(?m)^(read_data|group|pair_|dimension|boundary|newton|units|atom_style).*\n", "", text)


@pytest.mark.parametrize("ranks, after", [(1, 1), (2, 4)])
def test_restart(lammps, ranks, after):
    """The entropy of the particles of the zones is in the file."""
    first, again = repeat(lammps)
    lammps(first + TEMPERATURE + "run 100\nwrite_restart state.restart\n" + dump("whole.dump", 200, "c_T") + "run 100\n", ranks=ranks)
    lammps("read_restart state.restart\n" + again + TEMPERATURE + dump("parts.dump", 200, "c_T") + "run 100\n", ranks=after)
    whole, parts = lammps.frames("whole.dump")[-1], lammps.frames("parts.dump")[-1]
    assert whole.step == parts.step == 200 and np.array_equal(whole["id"], parts["id"])
    for key in ("x", "v", "c_T"):
        assert relative(parts[key] - whole[key], whole[key]) < 1e-10, key


BEFORE = {"write_restart": "write_restart state.restart\n", "write_data": "write_data out.data\n", "balance": "balance 1.0 shift x 5 1.0\n",
          "run 0": "run 0\n", "run 0 twice": "run 0\nrun 0\n", "all": "write_restart a.restart\nwrite_data out.data\nrun 0\nwrite_restart b.restart\n",
          "read": "write_restart state.restart\n", "run 0, read": "run 0\nwrite_restart state.restart\n"}


def both_ends(lammps, walls, implicit, before=""):
    """Input of a stream between ends of two temperatures, neither of them that of the fluid."""
    channel = Channel(length=10, width=8, box="walls" if walls else "straight")
    return channel.text(lammps, f"velocity {channel.vector(U)} temperature 1.2", "pressure 0.0 temperature 1.1", velocity=stream, timestep=0.02,
                        coeff="1.0 3.0 0.1 0.2 {R} cv 2.0 conductivity 0.4 gruneisen 0.4 1.0", before=before,
                        integrate="density rho0 temperature 1.0" + implicit * " viscous implicit tolerance 1e-13")


@pytest.mark.parametrize("walls", [False, True])
@pytest.mark.parametrize("implicit", [False, True])
@pytest.mark.parametrize("before", BEFORE)
def test_zone_is_new_until_the_first_forces(lammps, before, implicit, walls):
    """What prepares the particles before the first run leaves the temperatures to it."""
    text = both_ends(lammps, walls, implicit)
    lammps(text + TEMPERATURE + dump("once.dump", 20, "c_T") + "run 20\n", ranks=2)
    if "read" in before:
        lammps(text + BEFORE[before], ranks=2)
        text = "read_restart state.restart\n" + re.sub(r"(?m)^(read_data|group|pair_|dimension|boundary|newton|units|atom_style).*\n", "", text)
        before = ""
    lammps(text + TEMPERATURE + BEFORE.get(before, "") + dump("again.dump", 20, "c_T") + "run 20\n", ranks=2)
    once, again = lammps.frame("once.dump"), lammps.frame("again.dump")
    assert np.array_equal(once["id"], again["id"])
    out = once["x"][:, 0] > 14.0
    assert np.abs(once["c_T"][out & (once["c_T"] > 0)] / 1.1 - 1.0).max() < 0.01
    for key in ("x", "v", "c_T"):
        assert relative(again[key] - once[key], once[key]) < 1e-10, key


@pytest.mark.parametrize("implicit", [False, True])
def test_zone_with_spins_is_new_until_the_first_forces(lammps, implicit):
    """Their moments of inertia need densities before the first forces."""
    channel, frames = Channel(length=10, width=8), []
    for before in ("", "write_restart state.restart\n"):
        text = channel.text(lammps, f"velocity {channel.vector(U)} temperature 1.2", "pressure 0.0 temperature 1.1", velocity=stream, timestep=0.02, style="sph/micropolar",
                            coeff="1.0 3.0 0.1 0.2 0.05 0.05 -0.05 {R} cv 2.0 conductivity 0.4 gruneisen 0.4 1.0", spin=0.1,
                            integrate="inertia 0.1 0.01 density rho0 temperature 1.0" + implicit * " viscous implicit tolerance 1e-13")
        lammps(text + TEMPERATURE + before + dump("out.dump", 20, "c_T") + "run 20\n", ranks=2)
        frames.append(lammps.frame("out.dump"))
    for key in ("x", "v", "c_T"):
        assert relative(frames[1][key] - frames[0][key], frames[0][key]) < 1e-10, key


@pytest.mark.parametrize("fault, words", [("set group in mass 3.0", "the masses of the zone"), ("region R block INF 0 2 3 INF INF\ndelete_atoms region R", "rows of the zone"),
                                          ("", "of the zone have no heat")])
@pytest.mark.parametrize("before", ["", "write_restart", "write_data", "balance", "run 0", "all", "read"])
def test_warnings_of_a_new_zone_come_once(lammps, fault, words, before):
    """With the first run, after whatever prepares the particles."""
    text = both_ends(lammps, False, False) + fault + "\n"
    if not fault:
        text = re.sub(r" temperature \S+$", "", text, flags=re.MULTILINE)
    runs = [lammps(text + BEFORE.get(before, "") + "run 5\n" * (before != "read") + "run 5\n" * (before == ""))]
    if before == "read":
        runs.append(lammps("read_restart state.restart\n" + re.sub(r"(?m)^(read_data|group|pair_|dimension|boundary|newton|units|atom_style).*\n", "", text).replace(fault, "")
                           + "run 5\n"))
    found = [line for result in runs for line in result.warnings if words in line]
    assert len(found) == (2 if words == "of the zone have no heat" else 1), found


@pytest.mark.parametrize("eos", ["tait", "ideal"])
def test_ranks_and_newton(lammps, eos):
    frames = []
    for ranks, newton in ((1, "on"), (4, "on"), (2, "off")):
        lammps(hot_inlet(lammps, eos, 0.1, None, newton) + TEMPERATURE + dump("out.dump", 200, "c_T") + "run 200\n", ranks=ranks)
        frames.append(lammps.frame("out.dump"))
    for other in frames[1:]:
        assert np.array_equal(other["id"], frames[0]["id"])
        for key in ("x", "v", "c_T"):
            assert relative(other[key] - frames[0][key], frames[0][key]) < 1e-9, key


@pytest.mark.parametrize("eos", ["tait", "ideal"])
def test_entropy_of_what_leaves(lammps, eos):
    """Sound of a large amplitude goes out with the stream: what has left keeps its entropy, T rho^-Gamma, while both change with the sound."""
    T, amplitude, u = 0.15, 0.05, 0.2
    exponent = 0.4 if eos == "ideal" else GAMMA
    channel = Channel(length=40, width=7)
    def velocity(place):
        return place * 0 + np.outer(u + 2 * amplitude * np.exp(-(((place[:, 0] - 20.0) / 6.0) ** 2)), [1, 0, 0])
    text = channel.text(lammps, f"velocity {u} 0 0 pressure {pressure(eos, T)} temperature {T}", f"pressure {pressure(eos, T)} average 400",
                        velocity=velocity, timestep=0.05, options=f"eos {eos} shear none bulk none", coeff=COEFF[eos].replace("0.05 0.1", "0.0 0.0"),
                        integrate=f"density rho0 temperature {T}")
    lammps(text + TEMPERATURE + dump("out.dump", 50, "c_T") + "run 1500\n")
    change, entropy = 0.0, 0.0
    for frame in lammps.frames("out.dump"):
        zone = (frame["x"][:, 0] > 40.0) & (frame["x"][:, 0] < 44.0)
        change = max(change, np.abs(frame["c_T"][zone] / T - 1.0).max())
        entropy = max(entropy, np.abs(frame["c_T"][zone] * frame["c_RHO"][zone] ** -exponent / T - 1.0).max())
    print(eos, change, entropy)
    assert change > 0.02 and entropy < 1e-4


def test_gas_does_not_depend_on_c0(lammps):
    """The default average and the memory of waves are those of the speed of sound in the gas."""
    frames = []
    for c0 in (0.01, 1.0, 1000.0):
        channel = Channel(length=16, width=7)
        lammps(channel.text(lammps, f"velocity {U} 0 0 temperature 0.15", f"pressure {pressure('ideal', 0.15)}", velocity=agitated, timestep=0.2,
                            options="eos ideal", coeff=COEFF["ideal"].replace("1.0 1.0", f"1.0 {c0}", 1), integrate="density rho0 temperature 0.15")
               + TEMPERATURE + dump("out.dump", 400, "c_T") + "run 400\n", ranks=2)
        frames.append(lammps.frame("out.dump"))
    for other in frames[1:]:
        for key in ("x", "v", "c_T"):
            assert np.array_equal(other[key], frames[0][key]), key


def test_default_average_of_a_hot_liquid(lammps):
    """The liquid of other c0 and T0 that is the same at this temperature."""
    frames = []
    cc = 1.0 + GAMMA * (GAMMA + 1) * CV * (0.15 - T0)
    for c0, zero, pb in ((1.0, T0, PB), (np.sqrt(cc), 0.15, PB + GAMMA * CV * (0.15 - T0))):
        channel = Channel(length=16, width=7)
        lammps(channel.text(lammps, f"velocity {U} 0 0 temperature 0.15", f"pressure {pressure('linear', 0.15)}", velocity=agitated, timestep=0.2,
                            coeff=f"1.0 {c0} 0.05 0.1 {{R}} pb {pb} cv {CV} gruneisen {GAMMA} {zero}", integrate="density rho0 temperature 0.15")
               + TEMPERATURE + dump("out.dump", 200, "c_T") + "run 200\n", ranks=2)
        frames.append(lammps.frame("out.dump"))
    for key in ("x", "v", "c_T"):
        assert relative(frames[1][key] - frames[0][key], frames[0][key]) < 1e-10, key


# ---------------------------------------------------------------------------------------------
# what is refused, and what is warned of


@pytest.mark.parametrize("words, coeff, options, message", [
    ("temperature 1.0 energy 1.0", "cv 1.0", "", "energy and temperature cannot both be given, one follows from the other"),
    ("temperature -1.0", "cv 1.0", "", "-1 cannot be used: temperature must be >= 0"),
    ("temperature v_cold", "cv 1.0", "", "variable cold is -.* for particle .*: temperature must be >= 0"),
    ("temperature 0.0", "cv 1.0", "eos ideal", "0 cannot be used: temperature must be > 0 with eos ideal"),
    ("temperature 1.0", "", "", "Fix sph/open temperature needs the heat capacity of type 1, keyword cv of pair_coeff"),
    ("temperature inside", "cv 1.0", "", "Expected floating point parameter"),
    ("energy 1.0", "cv 1.0 gruneisen 0.5 1.0", "", "energy cannot be used with gruneisen of pair_coeff, which type 1 has: give the temperature instead"),
    ("energy 1.0", "cv 1.0 conductivity 0.1", "", "energy cannot be used with conductivity of pair_coeff, which type 1 has: give the temperature instead"),
])
def test_errors(lammps, words, coeff, options, message):
    channel = Channel(length=6, width=7)
    text = channel.text(lammps, f"velocity {U} 0 0 {words}", "pressure 1.0", velocity=stream, options=options, esph=2.5,
                        coeff=f"1.0 1.0 0.1 0.2 {{R}} {coeff}", before="variable cold atom x\n") + "run 10\n"
    for ranks in (1, 4):
        result = lammps(text, ranks=ranks, check=False, timeout=60)
        assert result.code != 0 and re.search(message, errors(result)), errors(result) or result.output[-800:]


@pytest.mark.parametrize("inlet, fluid, number", [("", "", 56), ("temperature 1.0", "", 0), ("", "temperature 1.0", 0)])
def test_warning_of_cold_zones(lammps, inlet, fluid, number):
    channel = Channel(length=6, width=7)
    result = lammps(channel.text(lammps, f"velocity {U} 0 0 {inlet}", "pressure 0.0 temperature 1.0", velocity=stream, integrate=f"density rho0 {fluid}",
                                 coeff="1.0 1.0 0.1 0.2 {R} cv 1.0 conductivity 0.1") + "run 0\n", ranks=2)
    found = re.findall(r"Fix sph/open (\S+): (\d+) of (\d+) particles of the zone have no heat", " ".join(result.warnings))
    assert found == ([("in", str(number), str(number))] if number else [])
