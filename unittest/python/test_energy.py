"""Where the energy goes: instantaneous balance, sign of the heating, conservation along a run."""

import itertools

import numpy as np
import pytest

from helpers import INTEGRATE, Lammps, disordered, dump, fluid, header, relative, undump

EOS = ("linear", "tait", "ideal")
SHEAR = ("mg", "mg/fr", "mg/fr2", "morris", "espanol", "none")
BULK = ("density", "volume", "none")
KERNELS = ("wendland/c2", "wendland/c4", "wendland/c6", "cubic", "quintic", "lucy")
CELLS = {1: 60, 2: 12, 3: 6}


def combination(dim, eos="linear", shear="mg", bulk="density", kernel="wendland/c2", mu=0.5, kappa=2.0):
    return fluid(dim, f"kernel {kernel} eos {eos} shear {shear} bulk {bulk}", keywords="pb 0.5",
                 mu=0.0 if shear == "none" else mu, kappa="intrinsic" if bulk == "none" else kappa)


@pytest.fixture(scope="module")
def balance(tmp_path_factory):
    """Fields of one disordered set for every combination of keywords, one LAMMPS run per dimension."""
    known = {}

    def get(dim):
        if dim not in known:
            lammps = Lammps(tmp_path_factory.mktemp("balance"))
            disordered(dim, CELLS[dim]).write(lammps.path("box.data"))
            models = {key: combination(dim, *key) for key in itertools.product(EOS, SHEAR, BULK)}
            models.update({kernel: combination(dim, kernel=kernel) for kernel in KERNELS})
            text = header(dim) + "read_data box.data\n" + INTEGRATE
            for number, model in enumerate(models.values()):
                text += model + dump(f"{number}.dump") + "run 0\n" + undump() + "pair_style none\n"
            lammps(text)
            known[dim] = {key: lammps.frame(f"{number}.dump") for number, key in enumerate(models)}
        return known[dim]

    return get


@pytest.mark.parametrize("dim", [1, 2, 3])
@pytest.mark.parametrize("key", [*itertools.product(EOS, SHEAR, BULK), *KERNELS], ids=str)
def test_kinetic_plus_internal_energy_is_stationary(balance, dim, key):
    """sum(f . v) + sum(desph) = 0 to round-off."""
    frame = balance(dim)[key]
    power = frame["f"] * frame["v"]
    assert abs(power.sum() + frame["desph"].sum()) < 1e-13 * np.abs(power).sum()


@pytest.mark.parametrize("dim", [1, 2, 3])
@pytest.mark.parametrize("shear, bulk", [("mg", "none"), ("mg/fr", "none"), ("mg/fr2", "none"), ("morris", "none"), ("espanol", "none"),
                                         ("none", "density"), ("mg", "density"),
                                         ("morris", "density")])
def test_no_particle_is_cooled_by_viscosity(balance, dim, shear, bulk):
    """desph less that of the inviscid fluid is the heating; it is the same for every equation of state."""
    heat = [balance(dim)[eos, shear, bulk]["desph"] - balance(dim)[eos, "none", "none"]["desph"] for eos in EOS]
    assert heat[0].min() >= -1e-13 * heat[0].max()
    assert heat[0].sum() > 1e-2 * len(heat[0])
    for other in heat[1:]:
        assert relative(other - heat[0], heat[0]) < 1e-12


@pytest.mark.parametrize("dim", [1, 2, 3])
def test_dissipation_channels_add_up(balance, dim):
    """Shear and bulk terms do not know of each other: forces of both together are the sum."""
    frames = balance(dim)
    pressure = frames["linear", "none", "none"]["f"]
    shear = frames["linear", "mg", "none"]["f"] - pressure
    bulk = frames["linear", "none", "density"]["f"] - pressure
    both = frames["linear", "mg", "density"]["f"] - pressure
    intrinsic = 0.5 * (1 + 2 / dim)  # kappa of the Monaghan-Gingold term
    expected = shear + bulk * (2.0 - intrinsic) / 2.0
    assert relative(both - expected, both) < 1e-12


def test_kappa_below_the_intrinsic_one_still_dissipates(lammps):
    """kappa = 0 means a negative coefficient of the bulk term; all heating together stays positive."""
    disordered(2, 12).write(lammps.path("box.data"))
    text = header(2) + "read_data box.data\n" + INTEGRATE
    for name, model in {"none": combination(2, shear="none", bulk="none"), "zero": combination(2, kappa=0.0),
                        "plain": combination(2, bulk="none")}.items():
        text += model + dump(f"{name}.dump") + "run 0\n" + undump() + "pair_style none\n"
    lammps(text)
    cold, heat, plain = (lammps.frame(f"{name}.dump")["desph"].sum() for name in ("none", "zero", "plain"))
    assert 0.0 < heat - cold < plain - cold


@pytest.fixture
def random_line(lammps):
    """Random points on a line, the only sets found so far that violate the bound on a negative bulk coefficient."""
    particles = disordered(1, 80)
    particles.x[:, 0] = np.random.default_rng(5).uniform(0.0, 80.0, 80)
    particles.write(lammps.path("box.data"))
    return particles


def limited(lammps, limit, ranks=1, newton="on"):
    """Heating of the random line with the lowest admissible bulk viscosity, and what the pair style counts."""
    name = f"{limit}{ranks}{newton}.dump"
    result = lammps(header(1, newton=newton) + "read_data box.data\n" + INTEGRATE
                    + fluid(1, f"limit {limit}", kappa=0.0) + dump(name) + "compute N all pair sph/bulk\n"
                    "thermo_style custom step c_N[1]\nrun 0\n", ranks=ranks)
    return lammps.frame(name), result.thermo()[0]["c_N[1]"][0]


def test_limit_on_a_negative_bulk_coefficient(lammps, random_line):
    """`count` counts and changes nothing; `yes` changes the particles counted, and energy balances as before."""
    (free, none), (counted, beyond), (held, beyond_held) = (limited(lammps, word) for word in ("no", "count", "yes"))
    assert none == 0 and 0 < beyond < len(random_line) and beyond_held == beyond
    assert (counted["f"] == free["f"]).all() and (counted["desph"] == free["desph"]).all()
    assert relative(held["f"] - free["f"], free["f"]) > 1e-6
    power = held["f"] * held["v"]
    assert abs(power.sum() + held["desph"].sum()) < 1e-13 * np.abs(power).sum()
    for ranks, newton in ((2, "on"), (4, "off")):
        frame, number = limited(lammps, "yes", ranks, newton)
        assert number == beyond
        assert relative(frame["f"] - held["f"], held["f"]) < 1e-12


def largest_energy_error(lammps, model, dt, column, dim=2):
    """Largest deviation of the total energy from its first value over a given time."""
    disordered(dim, CELLS[dim], jitter=0.1, speed=0.3).write(lammps.path("box.data"))
    steps = round(0.5 / dt)
    result = lammps(header(dim) + "read_data box.data\n" + model + INTEGRATE + f"timestep {dt}\n"
                    + dump("out.dump", steps // 10) + f"thermo {steps // 10}\nthermo_style custom step pe\n"
                    "thermo_modify norm no format float %.17g\n" f"run {steps}\n")
    frames, (table,) = lammps.frames("out.dump"), result.thermo()
    kinetic = np.array([0.5 * (f["mass"][:, None] * f["v"] ** 2).sum() for f in frames])
    total = kinetic + (table["PotEng"] if column == "pe" else [f["esph"].sum() for f in frames])
    assert np.abs(kinetic - kinetic[0]).max() > 0.05 * kinetic[0], "no energy is exchanged"
    return np.abs(total - total[0]).max() / kinetic[0]


@pytest.mark.parametrize("column, options, dissipation", [
    ("pe", dict(eos="linear"), False), ("pe", dict(eos="tait"), False),
    ("esph", dict(eos="linear"), False), ("esph", dict(eos="tait"), False), ("esph", dict(eos="ideal"), False),
    ("esph", dict(eos="linear"), True), ("esph", dict(eos="ideal", shear="mg/fr", bulk="volume"), True)], ids=str)
def test_energy_error_is_second_order_in_the_time_step(lammps, column, options, dissipation):
    """pe + ke of an inviscid fluid; esph + ke always: the internal energy receives work and heat."""
    model = combination(2, **options) if dissipation else combination(2, mu=0.0, shear="none", bulk="none",
                                                                      eos=options["eos"])
    steps = (0.01, 0.005, 0.0025)
    errors = [largest_energy_error(lammps, model, dt, column) for dt in steps]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    print(f"errors {errors}, orders {orders}")
    assert errors[-1] < 1e-3
    assert (orders > 1.8).all()


def test_potential_energy_is_the_sum_over_particles(lammps):
    """pe = sum of compute pe/atom; of the ideal gas, whose energy is esph, that of the background pressure alone."""
    disordered(2, 12).write(lammps.path("box.data"))
    text = (header(2) + "read_data box.data\n" + INTEGRATE + "compute E all pe/atom\ncompute S all reduce sum c_E\n"
            "thermo_style custom step pe c_S\nthermo_modify norm no format float %.17g\n")
    for eos in EOS:
        text += combination(2, eos=eos) + "run 0\n"
    text += combination(2, eos="ideal").replace("pb 0.5", "") + "run 0\n"
    tables = lammps(text, ranks=2).thermo()
    for table in tables:
        assert table["c_S"][0] == pytest.approx(table["PotEng"][0], rel=1e-13, abs=0.0)
    assert [table["PotEng"][0] != 0.0 for table in tables] == [True, True, True, False]


def test_esph_follows_the_elastic_energy_of_an_inviscid_fluid(lammps):
    """Without dissipation the work done on esph is the change of the elastic energy, up to O(dt^2)."""
    disordered(2, 12, jitter=0.1, speed=0.3).write(lammps.path("box.data"))
    misfit = []
    for dt in (0.01, 0.005, 0.0025):
        result = lammps(header(2) + "read_data box.data\n" + combination(2, shear="none", bulk="none") + INTEGRATE
                        + f"timestep {dt}\n" + dump("out.dump", round(0.5 / dt))
                        + "thermo_style custom step pe\nthermo_modify norm no format float %.17g\n"
                        + f"run {round(0.5 / dt)}\n")
        first, last = lammps.frames("out.dump")
        work = last["esph"].sum() - first["esph"].sum()
        pe = result.thermo()[0]["PotEng"]
        misfit.append(abs(work - (pe[-1] - pe[0])) / abs(work))
    orders = np.log2(np.array(misfit[:-1]) / misfit[1:])
    print(f"misfit {misfit}, orders {orders}")
    assert (orders > 1.8).all()
