"""fix sph/open: what the zones carry and do accounts for every change of the totals of the fluid."""

import numpy as np
import pytest

from open_boundaries import IMPULSE, IN, OUT, Channel, account, columns

U = 0.1
COEFF = {"sph/bulk": "1.0 1.0 0.1 0.2 {R}", "sph/micropolar": "1.0 1.0 0.1 0.2 0.05 0.05 -0.05 {R}"}


def agitated(channel, size=0.05):
    """A stream with eddies and a random part in the fluid and at rest in the zones: everything there is unsteady."""
    def velocity(place):
        s, t = 2 * np.pi * place[:, 0] / channel.length, 2 * np.pi * place[:, 1] / channel.width
        inside = ((place[:, 0] > 0) & (place[:, 0] < channel.length) & (place[:, 1] > 0) & (place[:, 1] < channel.width))[:, None]
        random = np.random.default_rng(1).normal(0.0, 0.02, place.shape) * [1, 1, 0]
        swirl = np.column_stack([np.sin(s) * np.cos(t), -np.cos(s) * np.sin(t), 0 * s])
        return inside * (np.array([U, 0, 0]) + size * swirl + random)
    return velocity


def output(channel, style, every=1):
    """Totals of the fluid about the origin, and all accounts."""
    orbit = ("compute X all property/atom xu yu zu\n"
             "variable lx atom mass*(c_X[2]*vz-c_X[3]*vy)\nvariable ly atom mass*(c_X[3]*vx-c_X[1]*vz)\n"
             "variable lz atom mass*(c_X[1]*vy-c_X[2]*vx)\ncompute L fluid reduce sum v_lx v_ly v_lz\n")
    spin = "compute L fluid sph/angmom point 0 0 0\n"
    walls = " ".join(f"f_W[{k}]" for k in range(1, 4)) if channel.box == "walls" else ""
    return ((orbit if style == "sph/bulk" else spin) + "variable n equal count(fluid)\nvariable m equal mass(fluid)\n"
            + "".join(f"variable p{d} equal vcm(fluid,{d})*mass(fluid)\n" for d in "xyz") + "compute E fluid sph/energy\n"
            + f"thermo {every}\nthermo_style custom step v_n v_m v_px v_py v_pz c_L[1] c_L[2] c_L[3] c_E {columns('in', 'out')} {walls}\n"
            "thermo_modify norm no format float %.17g\n")


TOTALS = {"n": "v_n", "m": "v_m", "px": "v_px", "py": "v_py", "pz": "v_pz", "lx": "c_L[1]", "ly": "c_L[2]", "lz": "c_L[3]"}


def assert_balance(table, names, other=None, tolerance=1e-12):
    """Largest error of the account of each total, over the sum of what was carried and exerted."""
    for name in names:
        found = table[TOTALS[name]] + (other or {}).get(name, 0.0)
        error = np.abs((found - found[0]) - (account(table, name) - account(table, name)[0])).max()
        scale = max(np.abs(table[f"f_{fix}[{k}]"]).max() for fix in ("in", "out")
                    for k in (IN[name], OUT[name], IMPULSE.get(name, IN[name])))
        scale = max(scale, np.abs(found).max())
        print(f"{name}: {error:.1e} of {scale:.3g}")
        assert error < tolerance * max(scale, 1.0), name


def keywords(style, **more):
    integrate = "density rho0" + (" inertia 0.1 0.01" if style != "sph/bulk" else "")
    return {**dict(style=style, coeff=COEFF[style], integrate=integrate, timestep=0.25), **more}


PLANE = ("n", "m", "px", "py", "lz")


SETTINGS = [("sph/bulk", "bulk density"), ("sph/bulk", "bulk volume"), ("sph/bulk", "volume mass bulk volume"), ("sph/bulk", "volume mass eos tait"),
            ("sph/micropolar", ""), ("sph/micropolar", "bulk volume volume mass"), ("sph/bulk", "shear morris")]
SHORT = {2: SETTINGS[1:6:2], 4: SETTINGS[0:6:2]}  # each setting on one number of ranks besides 1


@pytest.mark.parametrize("style, options, ranks, newton", [
    *[(*setting, 1, "on") for setting in SETTINGS],
    *[pytest.param(*setting, ranks, newton, marks=[] if setting in SHORT[ranks] else pytest.mark.long)
      for ranks, newton in ((2, "off"), (4, "on")) for setting in SETTINGS[:-1]]])
def test_ledger(lammps, style, options, ranks, newton):
    """Number, mass, momentum, angular momentum about the origin, in a jet without walls; spin of what enters."""
    channel = Channel(box="free", zone=9.0)
    names = PLANE if "morris" not in options else PLANE[:-1]
    spin = "spin 0 0 0.3" if style != "sph/bulk" else ""
    size = 0.02 if "tait" in options else 0.05  # it has no density at pressures of strong tension
    lammps(channel.text(lammps, f"velocity {channel.vector(U)} average 40 {spin}", "density 1.0", velocity=agitated(channel, size),
                        newton=newton, options=options, spin=0.2, **keywords(style)) + output(channel, style) + "run 300\n", ranks=ranks)
    (table,) = lammps.results[-1].thermo()
    assert table["f_in[1]"][-1] > 8 and table["f_out[11]"][-1] > 8
    assert np.abs(account(table, "lz")).max() > 1.0 and np.ptp(table["c_L[3]"]) > 1.0
    assert_balance(table, names)


@pytest.mark.parametrize("ranks", [1, 4])
def test_ledger_in_space(lammps, ranks):
    """All components, in three dimensions, with spin, in a direction of no axis."""
    channel = Channel(dim=3, box="free", direction=(2, 1, 1), support=2.5, zone=7.0, width=5, length=6)
    lammps(channel.text(lammps, f"velocity {channel.vector(U)} average 40 spin 0.1 0.2 0.3", "density 1.0",
                        velocity=agitated(channel), spin=0.2, **keywords("sph/micropolar"))
           + output(channel, "sph/micropolar") + "run 100\n", ranks=ranks)
    (table,) = lammps.results[-1].thermo()
    assert min(np.ptp(table[TOTALS[name]]) for name in ("px", "py", "pz", "lx", "ly", "lz")) > 0.05
    assert_balance(table, TOTALS)


@pytest.mark.parametrize("condition", ["characteristic", "fixed"])
def test_ledger_of_other_conditions(lammps, condition):
    channel = Channel(box="free", zone=9.0)
    lammps(channel.text(lammps, f"velocity {channel.vector(U)} condition {condition}", f"density 1.0 condition {condition}",
                        velocity=agitated(channel), **keywords("sph/bulk")) + output(channel, "sph/bulk") + "run 300\n")
    assert_balance(lammps.results[-1].thermo()[0], PLANE)


@pytest.mark.parametrize("style, ranks", [("sph/bulk", 1), ("sph/micropolar", 2), pytest.param("sph/bulk", 4, marks=pytest.mark.long)])
def test_ledger_with_walls_and_body_force(lammps, style, ranks):
    """fix sph/wall and fix addforce have accounts of their own for the rest: by the trapezoidal rule, exactly.  The walls are
    beyond the reach of the zones, whose particles press on walls, too."""
    channel = Channel(box="walls", zone=9.0)
    force = 0.004
    lammps(channel.text(lammps, f"velocity {channel.vector(U)} average 40", "density 1.0", velocity=agitated(channel),
                        wall="", after_read="region middle block 3.5 12.5 INF INF INF INF\ngroup middle region middle\n"
                        "group ends subtract wall middle\ndelete_atoms group ends compress no\n", **keywords(style)) + f"fix A fluid addforce {force} 0 0\n" + output(channel, style)
           + "run 300\n", ranks=ranks)
    (table,) = lammps.results[-1].thermo()
    other = {}
    for k, name in ((1, "px"), (2, "py")):
        power = -table[f"f_W[{k}]"] + (force * table["v_n"] if name == "px" else 0.0)
        other[name] = -np.concatenate([[0.0], np.cumsum(0.25 * 0.5 * (power[1:] + power[:-1]))])
        assert np.abs(other[name]).max() > 0.05
    assert_balance(table, ("n", "m", "px", "py"), other)


@pytest.mark.parametrize("runs", ["run 100\nrun 100\nrun 100\n", "run 0\nrun 100\nrun 100 pre no\nrun 0\nrun 100\n",
                                  "run 300 every 50 \"print x\"\n"])
def test_ledger_goes_on_from_run_to_run(lammps, runs):
    channel = Channel(box="free", zone=9.0)
    lammps(channel.text(lammps, f"velocity {channel.vector(U)} average 40 spin 0 0 0.3", "density 1.0",
                        velocity=agitated(channel), spin=0.2, **keywords("sph/micropolar"))
           + output(channel, "sph/micropolar") + runs)
    tables = lammps.results[-1].thermo()
    table = {key: np.concatenate([one[key] for one in tables]) for key in tables[0]}
    assert table["Step"][-1] == 300 and len(tables) >= 3
    assert_balance(table, PLANE)


@pytest.mark.parametrize("before, after", [(1, 4), (4, 1), (2, 3)])
def test_ledger_goes_on_after_a_restart(lammps, before, after):
    channel = Channel(box="free", zone=9.0)
    style, velocity = "sph/micropolar", f"velocity {channel.vector(U)} average 40 spin 0 0 0.3"
    lammps(channel.text(lammps, velocity, "density 1.0", velocity=agitated(channel), spin=0.2, **keywords(style))
           + output(channel, style) + "run 101\nwrite_restart state.restart\n", ranks=before)
    lammps("read_restart state.restart\nfix 1 fluid sph/micropolar density rho0 inertia 0.1 0.01\ntimestep 0.25\n"
           f"fix in {channel.plane('in')} {velocity}\nfix out {channel.plane('out')} density 1.0\nprint \"from the file: $(f_in[1])\"\n"
           + output(channel, style) + "run 101\n", ranks=after)
    first, second = (result.thermo()[0] for result in lammps.results)
    assert f"from the file: {first['f_in[1]'][-1]:g}" in lammps.results[-1].log
    assert_balance({key: np.concatenate([first[key], second[key]]) for key in first}, PLANE)


# ---------------------------------------------------------------------------------------------
# energy


@pytest.mark.parametrize("style, options", [("sph/bulk", "bulk density"), ("sph/bulk", "bulk volume eos tait"),
                                            ("sph/bulk", "volume mass"), ("sph/micropolar", ""), ("sph/bulk", "eos ideal")])
def test_energy(lammps, style, options):
    """Kinetic and internal, to the second order of the time step, as without zones."""
    more = dict(coeff="1.0 1.0 0.1 0.2 {R}", esph=2.5) if "ideal" in options else {}
    inlet = f"velocity {{}} average 40 {'energy 2.5' if more else ''}"
    outlet = "pressure 1.0" if more else "density 1.0"
    errors = []
    for timestep in (0.1, 0.05, 0.025):
        channel = Channel(box="straight", zone=9.0)
        lammps(channel.text(lammps, inlet.format(channel.vector(U)), outlet, velocity=agitated(channel), options=options, spin=0.2,
                            **keywords(style, **{**more, "timestep": timestep}))
               + output(channel, style) + f"run {int(30 / timestep)}\n")
        (table,) = lammps.results[-1].thermo()
        change = account(table, "ke") + account(table, "e") + sum(table[f"f_{fix}[{IMPULSE['work']}]"] for fix in ("in", "out"))
        errors.append(np.abs((table["c_E"] - table["c_E"][0]) - (change - change[0])).max())
    scale = max(np.abs(table[f"f_{fix}[{IMPULSE['work']}]"]).max() for fix in ("in", "out"))
    print(errors, "of", np.ptp(table["c_E"]), "work", scale)
    assert errors[0] < 0.02 * np.ptp(table["c_E"])
    assert errors[1] < 0.35 * errors[0] and errors[2] < 0.35 * errors[1]


# ---------------------------------------------------------------------------------------------
# a variable that reads the account


def test_flow_that_depends_on_its_own_account(lammps):
    """What the variable reads in the middle of a step is not what the output then shows."""
    channel = Channel()
    lammps(channel.text(lammps, "velocity v_U 0 0", "density 1.0", before="variable U equal 0.1+1e-3*f_out[13]\n",
                        **keywords("sph/bulk")) + output(channel, "sph/bulk") + "run 200\n")
    (table,) = lammps.results[-1].thermo()
    assert_balance(table, ("n", "m", "px", "py"))
