"""The micropolar fluid as a user meets it: conservation, ranks, files, commands, energy, body torque, bad input."""

import re

import numpy as np
import pytest

from helpers import SUPPORT, as_written, disordered, drop, free, header, relative

STYLE = "sph/micropolar"
STEPS = 10000
FULL = "thermo_modify norm no format float %.17g\n"
COLUMNS = "id mass xu yu zu vx vy vz fx fy fz omegax omegay omegaz tqx tqy tqz"
TIMESTEP = "timestep 0.002\n"


def spins(particles, seed=7, size=1.0):
    """Random spins (along z in 2d)."""
    random = np.random.default_rng(seed)
    omega = np.zeros((len(particles), 3))
    axes = slice(0, 3) if particles.dim == 3 else slice(2, 3)
    omega[:, axes] = random.normal(0.5, size, omega[:, axes].shape)
    return omega


def write(particles, path, omega=None, inertia=0.2, style=STYLE):
    """Data file of particles that spin."""
    omega = spins(particles) if omega is None else omega
    inertia = np.broadcast_to(inertia, len(particles))
    lines = ["LAMMPS data file of a test", "", f"{len(particles)} atoms", f"{int(particles.type.max())} atom types", ""]
    lines += [f"{lo} {hi} {axis}lo {axis}hi"
              for axis, lo, hi in zip("xyz", particles.lo.tolist(), particles.hi.tolist())]
    if particles.tilt is not None:
        lines.append(" ".join(repr(float(t)) for t in particles.tilt) + " xy xz yz")
    lines += ["", f"Atoms # {style}", ""]
    for i in range(len(particles)):
        place = " ".join(map(repr, particles.x[i].tolist()))
        own = f"{particles.mass[i]:.17g} {inertia[i]:.17g} {particles.esph[i]:.17g}"
        lines.append(f"{i + 1} {particles.type[i]} {own} {place}" if style == STYLE
                     else f"{i + 1} {particles.type[i]} {place} {own} 0.25")
    lines += ["", "Velocities", ""]
    for i in range(len(particles)):
        lines.append(f"{i + 1} " + " ".join(map(repr, particles.v[i].tolist() + omega[i].tolist())))
    path.write_text("\n".join(lines) + "\n")


def gammas(dim, gamma1=0.05):
    return f"{gamma1} {-gamma1 if dim == 2 else 0.4 * gamma1}"


def fluid(dim, options="", mu=0.5, kappa=2.0, mu_r=0.3, gamma1=0.05):
    return (f"pair_style {STYLE} {options}\n"
            f"pair_coeff * * 1.0 10.0 {mu} {kappa} {mu_r} {gammas(dim, gamma1)} {SUPPORT[dim]}\n")


def two_fluids(dim, options=""):
    return (f"pair_style {STYLE} kernel wendland/c4 {options}\n"
            f"pair_coeff 1 1 1.0 10.0 0.5 2.0 0.3 {gammas(dim)} {SUPPORT[dim]} pb 1\n"
            f"pair_coeff 2 2 1.1 12.0 0.2 0.8 0.1 {gammas(dim, 0.02)} {SUPPORT[dim]}\n"
            "pair_coeff 1 2 mu 0.3 mu_r 0.2 gamma1 0.03 gamma2 " + ("-0.03\n" if dim == 2 else "0.01\n"))


def integrate(keywords=""):
    return f"fix FLUID all {STYLE} {keywords}\n" + TIMESTEP


def dump(name, every=1, extra=""):
    return ("compute G all property/atom inertia vol esph desph\n"
            f"dump D all custom {every} {name} {COLUMNS} c_G[*] {extra}\n"
            "dump_modify D sort id format float %.17g\n")


def vector(frame, *names):
    return np.column_stack([frame.columns[name] for name in names])


def omega_of(frame):
    return vector(frame, "omegax", "omegay", "omegaz")


def torque_of(frame):
    return vector(frame, "tqx", "tqy", "tqz")


# ---------------------------------------------------------------------------------------------
# conservation


@pytest.mark.parametrize("dim, radius", [(2, 7.0), (3, 3.5)])
@pytest.mark.parametrize("bulk", ["density", "volume"])
def test_angular_momentum_of_an_isolated_drop(lammps, dim, radius, bulk):
    """Orbital and spin parts exchange, their sum stays."""
    particles = drop(dim, radius)
    write(particles, lammps.path("box.data"), omega=3.0 * spins(particles))
    columns = " ".join(f"c_L[{k}]" for k in range(1, 10))
    text = (header(dim, boundary=free(dim), style=STYLE) + "read_data box.data\n" + fluid(dim, f"bulk {bulk}") + integrate()
            + "compute L all sph/angmom\n"
            f"thermo_style custom step {columns}\nthermo {STEPS // 10}\n" + FULL
            + dump("out.dump", STEPS) + f"run {STEPS}\n")
    (table,) = lammps(text, timeout=1200).thermo()
    first, last = lammps.frames("out.dump")
    assert len(last["id"]) == len(particles), "particles left the box"
    total, orbital, spin = (np.column_stack([table[f"c_L[{k}]"] for k in range(a, a + 3)]) for a in (1, 4, 7))
    np.testing.assert_allclose(total, orbital + spin, rtol=0, atol=1e-13 * np.abs(total).max())
    size = np.linalg.norm(total[0])
    drift = np.abs(total - total[0]).max() / size
    exchange = np.abs(spin - spin[0]).max() / np.linalg.norm(spin[0])
    print(f"angular momentum drift {drift:.2e}, part of the spin exchanged {exchange:.2f}")
    assert drift < 1e-12
    assert exchange > 0.1
    momentum = [frame["mass"][:, None] * frame["v"] for frame in (first, last)]
    linear = np.abs(momentum[1].sum(0) - momentum[0].sum(0)).max() / np.linalg.norm(momentum[0], axis=1).sum()
    print(f"linear momentum drift {linear:.2e}")
    assert linear < 1e-14

    # the compute agrees with the sums over the dumped particles
    x = first["x"] - np.average(first["x"], axis=0, weights=first["mass"])
    mass = first["mass"][:, None]
    by_hand = (mass * np.cross(x, first["v"])).sum(0), (mass * first["c_G[1]"][:, None] * omega_of(first)).sum(0)
    np.testing.assert_allclose(orbital[0], by_hand[0], rtol=0, atol=1e-12 * size)
    np.testing.assert_allclose(spin[0], by_hand[1], rtol=0, atol=1e-12 * size)


def test_angular_momentum_about_a_point_and_of_a_group(lammps):
    particles = disordered(2, 10, ntypes=2)
    write(particles, lammps.path("box.data"))
    (table,) = lammps(header(2, style=STYLE) + "read_data box.data\n" + two_fluids(2) + integrate()
                      + "group A type 1\ncompute L A sph/angmom point 1 2 0\nthermo_style custom step c_L[*]\n" + FULL
                      + "run 0\n").thermo()
    one = particles.type == 1
    x, v, m = particles.x[one] - [1, 2, 0], particles.v[one], particles.mass[one]
    orbital = (m * (x[:, 0] * v[:, 1] - x[:, 1] * v[:, 0])).sum()
    spin = (m * 0.2 * spins(particles)[one, 2]).sum()
    assert table["c_L[6]"][0] == pytest.approx(orbital, rel=1e-12)
    assert table["c_L[9]"][0] == pytest.approx(spin, rel=1e-12)
    assert table["c_L[3]"][0] == pytest.approx(orbital + spin, rel=1e-12)


# ---------------------------------------------------------------------------------------------
# ranks, files, commands


SYSTEMS = {2: disordered(2, 16, ntypes=2), 3: disordered(3, 7, ntypes=2)}


def trajectory(lammps, dim, ranks=1, before="", after="", style=STYLE, newton="on", head=None, keywords="", steps=100):
    write(SYSTEMS[dim], lammps.path("box.data"), style=style)
    lammps((head or header(dim, newton=newton, style=style)) + before + "read_data box.data\n" + after + two_fluids(dim)
           + integrate(keywords) + dump("out.dump", steps) + f"run {steps}\n", ranks=ranks)
    return lammps.frame("out.dump")


def assert_same(one, other, bound=1e-12):
    assert np.abs(one["x"] - other["x"]).max() < bound
    assert np.abs(omega_of(one) - omega_of(other)).max() < bound * np.abs(omega_of(one)).max()
    assert np.abs(one["c_G[3]"] - other["c_G[3]"]).max() < bound * np.abs(one["c_G[3]"]).max()


@pytest.fixture(scope="module")
def reference(shared_lammps):
    known = {}

    def get(dim):
        if dim not in known:
            known[dim] = trajectory(shared_lammps, dim)
        return known[dim]

    return get


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("ranks, newton", [(1, "off"), (2, "on"), (4, "on"), (4, "off")])
def test_ranks(lammps, reference, dim, ranks, newton):
    assert_same(reference(dim), trajectory(lammps, dim, ranks, newton=newton))


@pytest.mark.parametrize("before, after", [("comm_style tiled\n", "balance 1.0 rcb\n"), ("comm_modify vel yes\n", "")])
def test_communication(lammps, reference, before, after):
    assert_same(reference(2), trajectory(lammps, 2, 2, before=before, after=after))


@pytest.mark.parametrize("ranks", [1, 2])
def test_atom_style_hybrid(lammps, reference, ranks):
    assert_same(reference(2), trajectory(lammps, 2, ranks, style="hybrid sph/micropolar charge"))


@pytest.mark.parametrize("prefix", ["atom_style sph/micropolar\n", "atom_style sph/bulk\n", "atom_style atomic\n",
                                    "atom_style hybrid sph/micropolar charge\n"])
def test_second_atom_style(lammps, reference, prefix):
    assert_same(reference(2), trajectory(lammps, 2, head="units lj\n" + prefix + header(2, style=STYLE)))


def test_clear(lammps, reference):
    write(SYSTEMS[3], lammps.path("first.data"))
    earlier = header(3, style=STYLE) + "read_data first.data\n" + two_fluids(3) + integrate() + "run 5\nclear\n"
    assert_same(reference(2), trajectory(lammps, 2, head=earlier + header(2, style=STYLE)))


@pytest.mark.parametrize("dim, before, after, keywords", [(2, 1, 1, ""), (3, 2, 4, ""), (2, 1, 2, "inertia 0.1667 0.05")])
def test_continue_from_a_restart_file(lammps, dim, before, after, keywords):
    """The inertia, once set from the volumes, is not set again."""
    write(SYSTEMS[dim], lammps.path("box.data"))
    lammps(header(dim, style=STYLE) + "read_data box.data\n" + two_fluids(dim) + integrate(keywords) + "run 100\n"
           "write_restart state.restart\n" + dump("whole.dump", 100) + "run 100\n", ranks=before)
    lammps("read_restart state.restart\n" + integrate(keywords) + dump("parts.dump", 100) + "run 100\n", ranks=after)
    whole, parts = lammps.frames("whole.dump"), lammps.frames("parts.dump")
    assert (whole[0]["c_G[1]"] == parts[0]["c_G[1]"]).all()
    assert_same(whole[1], parts[1])


def test_data_file_round_trip(lammps):
    write(SYSTEMS[3], lammps.path("box.data"), inertia=np.linspace(0.1, 0.3, len(SYSTEMS[3])))
    pair_style = two_fluids(3).splitlines()[0] + "\n"
    lammps(header(3, style=STYLE) + "read_data box.data\n" + two_fluids(3) + integrate() + "run 20\n"
           "velocity all scale 0.3\nwrite_data out.data pair ij\n" + dump("before.dump") + "run 0\n")
    lammps(header(3, style=STYLE) + pair_style + "read_data out.data\n" + integrate() + dump("after.dump") + "run 0\n")
    before, after = lammps.frame("before.dump"), lammps.frame("after.dump")
    for name in ("omegax", "omegay", "omegaz"):
        np.testing.assert_array_equal(after[name], before[name])
    np.testing.assert_array_equal(after["c_G[1]"], as_written(before["c_G[1]"]))
    assert relative(after["f"] - before["f"], before["f"]) < 1e-13
    assert relative(torque_of(after) - torque_of(before), torque_of(before)) < 1e-13


def test_replicate(lammps):
    write(SYSTEMS[2], lammps.path("box.data"))
    frames = []
    for name, command in (("one", ""), ("many", "replicate 2 2 1\n")):
        lammps(header(2, style=STYLE) + "read_data box.data\n" + command + two_fluids(2) + integrate()
               + dump(f"{name}.dump") + "run 0\n")
        frames.append(lammps.frame(f"{name}.dump"))
    one, many = frames
    for image in np.split(torque_of(many), 4):
        assert relative(image - torque_of(one), torque_of(one)) < 1e-12
    for image in np.split(omega_of(many), 4):
        assert (image == omega_of(one)).all()


def test_set_omega(lammps):
    """set ... omega gives what the data file would have given."""
    particles = SYSTEMS[3]
    omega = spins(particles)
    omega[particles.type == 2] = [0.25, -0.5, 1.5]
    frames = []
    for name, given, command in (("set", spins(particles), "set type 2 omega 0.25 -0.5 1.5\n"), ("data", omega, "")):
        write(particles, lammps.path("box.data"), omega=given)
        lammps(header(3, style=STYLE) + "read_data box.data\n" + command + two_fluids(3) + integrate()
               + dump(f"{name}.dump") + "run 0\n")
        frames.append(lammps.frame(f"{name}.dump"))
    assert (omega_of(frames[0]) == omega_of(frames[1])).all()
    assert relative(torque_of(frames[0]) - torque_of(frames[1]), torque_of(frames[1])) < 1e-13


def test_inertia_from_the_volume(lammps):
    """c V^(2/n) + I, from the state at the start, constant afterwards."""
    for dim in (2, 3):
        write(SYSTEMS[dim], lammps.path("box.data"), inertia=0.0)
        lammps(header(dim, style=STYLE) + "read_data box.data\n" + two_fluids(dim) + integrate("inertia 0.1667 0.05")
               + dump("out.dump", 20) + "run 20\nrun 20\n")
        frames = lammps.frames("out.dump")
        expected = 0.1667 * frames[0]["c_G[2]"] ** (2.0 / dim) + 0.05
        np.testing.assert_allclose(frames[0]["c_G[1]"], expected, rtol=1e-14)
        assert np.abs(frames[-1]["c_G[2]"] - frames[0]["c_G[2]"]).max() > 1e-3
        assert (frames[-1]["c_G[1]"] == frames[0]["c_G[1]"]).all()


# ---------------------------------------------------------------------------------------------
# energy


@pytest.mark.parametrize("dim", [2, 3])
def test_energy_balance_is_of_second_order(lammps, dim):
    """Kinetic + rotational + internal energy, which has the work of the pressure: halving the step divides the error by four."""
    write(SYSTEMS[dim], lammps.path("box.data"))
    errors = []
    for steps in (50, 100, 200):
        (table,) = lammps(header(dim, style=STYLE) + "read_data box.data\n" + two_fluids(dim) + integrate()
                          + f"timestep {0.1 / steps}\ncompute E all sph/energy\n"
                          "thermo_style custom step c_E c_E[1] c_E[2] c_E[3]\n" + FULL + f"thermo {steps}\nrun {steps}\n"
                          ).thermo()
        total = table["c_E"]
        np.testing.assert_allclose(table["c_E"], sum(table[f"c_E[{k}]"] for k in (1, 2, 3)), rtol=1e-14)
        assert table["c_E[3]"][0] - table["c_E[3]"][-1] > 0.1 * table["c_E[3]"][0]
        errors.append(abs(total[-1] - total[0]) / (table["c_E[1]"][0] + table["c_E[3]"][0]))
    ratios = [errors[k] / errors[k + 1] for k in (0, 1)]
    print("energy errors", errors, "ratios", ratios)
    assert errors[-1] < 1e-3
    assert ratios[-1] == pytest.approx(4.0, abs=0.8)


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "on"), (4, "off")])
@pytest.mark.parametrize("bulk", ["density", "volume", "none"])
def test_dissipation_is_the_work_of_forces_and_torques(lammps, dim, ranks, newton, bulk):
    write(SYSTEMS[dim], lammps.path("box.data"))
    model = two_fluids(dim, f"bulk {bulk}")
    text = (header(dim, newton=newton, style=STYLE) + "read_data box.data\n" + model + integrate()
            + "compute Q all sph/dissipation\ncompute S all reduce sum c_Q\nthermo_style custom step c_Q c_Q[*] c_S\n"
            + FULL + dump("moving.dump", extra="c_Q") + "run 0\nundump D\nuncompute G\n"
            "velocity all set 0 0 0\nset group all omega 0 0 0\n" + dump("rest.dump") + "run 0\n")
    table = lammps(text, ranks=ranks).thermo()[0]
    moving, rest = lammps.frame("moving.dump"), lammps.frame("rest.dump")
    assert np.abs(torque_of(rest)).max() == 0.0
    work = -((moving["f"] - rest["f"]) * moving["v"]).sum() - (torque_of(moving) * omega_of(moving)).sum()
    channels = [table[f"c_Q[{k}]"][0] for k in (1, 2, 3, 4)]
    assert table["c_Q"][0] == pytest.approx(work, rel=1e-12)
    assert sum(channels) == pytest.approx(work, rel=1e-12)
    assert table["c_S"][0] == pytest.approx(work, rel=1e-12)
    assert (channels[1] == 0.0) == (bulk == "none")
    assert min(channels[0], channels[2], channels[3]) > 0.0


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "on"), (2, "off")])
def test_pressure_is_the_sum_of_stress_per_atom(lammps, dim, ranks, newton):
    write(SYSTEMS[dim], lammps.path("box.data"))
    table = lammps(header(dim, newton=newton, style=STYLE) + "read_data box.data\n" + two_fluids(dim) + integrate()
                   + "compute P all pressure NULL virial\nthermo_style custom step vol c_P[1] c_P[2] c_P[3]\n" + FULL
                   + "run 0\ncompute S all stress/atom NULL virial\ncompute T all reduce sum c_S[1] c_S[2] c_S[3]\n"
                   "thermo_style custom step vol c_T[1] c_T[2] c_T[3]\n" + FULL + "run 0\n", ranks=ranks).thermo()
    for k in range(1, dim + 1):
        total = -table[1][f"c_T[{k}]"][0] / table[1]["Volume"][0]
        assert abs(total) > 0.01
        assert table[0][f"c_P[{k}]"][0] == pytest.approx(total, rel=1e-12)


# ---------------------------------------------------------------------------------------------
# body torque


def torque_run(lammps, definitions, arguments, ranks=1, dim=2, steps=200, group="all"):
    particles = SYSTEMS[dim]
    write(particles, lammps.path("box.data"))
    text = (header(dim, style=STYLE) + "read_data box.data\n" + two_fluids(dim) + integrate() + "timestep 0.0005\n"
            + "group one type 1\n" + definitions + f"fix G {group} sph/torque {arguments}\ncompute E all sph/energy\n"
            "compute L all sph/angmom\nthermo_style custom step time c_E f_G f_G[*] c_L[*]\n" + FULL
            + f"thermo {steps}\n" + dump("out.dump", steps) + f"run {steps}\n")
    (table,) = lammps(text, ranks=ranks).thermo()
    return table, lammps.frames("out.dump")


CASES = {
    "constant": ("", "0 0 0.5", 2),
    "constant 3d": ("", "0.3 -0.2 0.5", 3),
    "equal": ("variable T equal 0.5+2*step*dt\n", "0 0 v_T", 2),
    "atom": ("variable T atom 0.4*sin(x)+0.3*id/256\n", "0 0 v_T", 2),
    "atom 3d": ("variable T atom 0.4*sin(x)+0.3*y\nvariable U equal 0.2\n", "v_T v_U -0.1", 3),
}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("name", CASES)
def test_work_of_a_body_torque_is_the_energy_gained(lammps, name, ranks):
    definitions, arguments, dim = CASES[name]
    table, _ = torque_run(lammps, definitions, arguments, ranks, dim)
    gained = table["c_E"]
    work = table["f_G"][-1] - table["f_G"][0]
    print(f"work {work:.6g}, gained {gained[-1] - gained[0]:.6g}")
    assert table["f_G"][0] == 0.0
    assert abs(work) > 0.1
    assert gained[-1] - gained[0] == pytest.approx(work, rel=5e-4)


@pytest.mark.parametrize("before, after", [(1, 1), (2, 1), (1, 2)])
def test_work_of_a_body_torque_goes_on_after_a_restart(lammps, before, after):
    write(SYSTEMS[2], lammps.path("box.data"))
    torque = "fix G all sph/torque 0 0 0.5\nthermo_style custom step f_G\n" + FULL + "thermo 20\n"
    whole = lammps(header(2, style=STYLE) + "read_data box.data\n" + two_fluids(2) + integrate() + torque
                   + "run 20\nwrite_restart state.restart\nrun 20\n", ranks=before).thermo()
    parts = lammps("read_restart state.restart\n" + integrate() + torque + "run 20\n", ranks=after).thermo()
    first, middle, last = whole[0]["f_G"][0], whole[1]["f_G"][0], whole[1]["f_G"][-1]
    assert first == 0.0 and abs(last - middle) > 0.01
    np.testing.assert_allclose(parts[0]["f_G"], [middle, last], rtol=1e-12)


def test_body_torque_of_every_kind(lammps):
    """Equal- and atom-style variables of a constant value are the constant; a group is respected."""
    _, constant = torque_run(lammps, "", "0 0 0.5", steps=20)
    for definitions, word in (("variable T equal 0.5\n", "v_T"), ("variable T atom 0.5+0*id\n", "v_T")):
        table, frames = torque_run(lammps, definitions, f"0 0 {word}", steps=20)
        assert (torque_of(frames[0]) == torque_of(constant[0])).all()
        assert table["f_G[3]"][0] == pytest.approx(0.5 * len(SYSTEMS[2]), rel=1e-12)
        assert_same(frames[-1], constant[-1])
    _, without = torque_run(lammps, "", "0 0 0", steps=20)
    table, frames = torque_run(lammps, "", "0 0 0.5", steps=20, group="one")
    one = SYSTEMS[2].type == 1
    np.testing.assert_allclose(torque_of(frames[0])[:, 2] - torque_of(without[0])[:, 2], 0.5 * one, rtol=0, atol=1e-12)
    assert table["f_G[3]"][0] == pytest.approx(0.5 * one.sum(), rel=1e-12)


# ---------------------------------------------------------------------------------------------
# bad input

GOOD = {"units": "units lj", "dimension": "dimension 2", "atom_style": f"atom_style {STYLE}", "box": "read_data box.data",
        "pair_style": f"pair_style {STYLE}", "pair_coeff": "pair_coeff * * 1.0 10.0 0.5 2.0 0.3 0.05 -0.05 3.0",
        "fix": f"fix 1 all {STYLE}", "extra": "", "timestep": "timestep 0.002", "run": "run 2"}
IN_3D = dict(dimension="dimension 3", box="read_data box3.data")
BOX = "region B block 0 9 0 9 -.5 .5\ncreate_box 2 B\ncreate_atoms 1 random 50 1 B\n"


def coeff(words, arguments, **changes):
    return words, dict(pair_coeff=f"pair_coeff {arguments}", **changes)


BAD = [
    coeff(r"mu_r must be <= mu \(1 \+ 2/n\)", "* * 1.0 10.0 0.5 2.0 1.001 0.05 -0.05 3.0"),
    coeff(r"mu_r must be <= mu \(1 \+ 2/n\)", "* * 1.0 10.0 0.5 2.0 0.834 0.05 0.02 2.5", **IN_3D),
    coeff("mu_r must be >= 0", "* * 1.0 10.0 0.5 2.0 -0.1 0.05 -0.05 3.0"),
    coeff("gamma1 - gamma2 must be >= 0", "* * 1.0 10.0 0.5 2.0 0.3 -0.05 0.05 3.0"),
    coeff("gamma1 - gamma2 must be >= 0", "* * 1.0 10.0 0.5 2.0 0.3 0.05 0.06 2.5", **IN_3D),
    coeff("6 gamma1 . 4 gamma2 must be >= 0", "* * 1.0 10.0 0.5 2.0 0.3 0.05 -0.08 2.5", **IN_3D),
    coeff("gamma2 must be -gamma1 in 2d", "* * 1.0 10.0 0.5 2.0 0.3 0.05 0.02 3.0"),
    coeff("mu must be >= 0", "* * 1.0 10.0 -0.5 2.0 0.3 0.05 -0.05 3.0"),
    coeff("kappa must be >= 0", "* * 1.0 10.0 0.5 -2.0 0.3 0.05 -0.05 3.0"),
    coeff("[Mm]issing", "* * 1.0 10.0 0.5 2.0 0.3 0.05 -0.05"),
    coeff("fast", "* * 1.0 10.0 0.5 2.0 fast 0.05 -0.05 3.0"),
    coeff(r"mu_r must be <= .* 1 2", GOOD["pair_coeff"][11:] + "\npair_coeff 1 2 mu_r 1.1"),
    coeff("Unknown pair_coeff keyword.*: xi1", GOOD["pair_coeff"][11:] + "\npair_coeff 1 2 xi1 1.1"),
    ("inertia must be > 0", dict(box="read_data zero.data")),
    ("inertia", dict(box="read_data negative.data")),
    ("spin must be along z in 2d", dict(extra="set type 1 omega 0.1 0 0")),
    ("requires atom style sph/micropolar", dict(atom_style="atom_style sph/bulk", box=BOX, fix="")),
    ("requires atom style sph/micropolar", dict(atom_style="atom_style sph/bulk", box=BOX, pair_style="pair_style sph/bulk",
                                                pair_coeff="pair_coeff * * 1 10 0.5 2 3.0")),
    ("requires fix sph/micropolar", dict(fix="")),
    ("requires fix sph/micropolar", dict(fix="fix 1 all nve")),
    ("dim 2 or 3", dict(pair_style=f"pair_style {STYLE} dim 1")),
    ("does not match", dict(pair_style=f"pair_style {STYLE} dim 3")),
    ("Unknown shear form morris for pair_style sph/micropolar", dict(pair_style=f"pair_style {STYLE} shear morris")),
    ("Unknown fix sph/micropolar keyword: inertial", dict(fix=f"fix 1 all {STYLE} inertial 0.1 0.1")),
    ("[Mm]issing", dict(fix=f"fix 1 all {STYLE} inertia 0.1")),
    ("inertia needs", dict(fix=f"fix 1 all {STYLE} inertia -0.1 0.2")),
    ("inertia needs", dict(fix=f"fix 1 all {STYLE} inertia 0 0")),
    ("heavy", dict(fix=f"fix 1 all {STYLE} inertia heavy 0.2")),
    ("[Mm]issing", dict(extra="fix 2 all sph/torque 0 0")),
    ("Unknown fix sph/torque keyword: 1", dict(extra="fix 2 all sph/torque 0 0 1 1")),
    ("nowhere", dict(extra="fix 2 all sph/torque 0 0 v_nowhere")),
    ("strong", dict(extra="fix 2 all sph/torque 0 0 strong")),
    ("style", dict(extra="variable T string hello\nfix 2 all sph/torque 0 0 v_T")),
    ("along z in 2d", dict(extra="fix 2 all sph/torque 0.1 0 0")),
    ("Unknown compute sph/angmom keyword: centre", dict(extra="compute L all sph/angmom centre 0 0 0")),
    ("[Mm]issing", dict(extra="compute L all sph/angmom point 0 0")),
    ("Unknown compute sph/angmom keyword: 4", dict(extra="compute L all sph/angmom point 0 0 0 4")),
    ("requires atom style sph/micropolar", dict(atom_style="atom_style sph/bulk", box=BOX, fix="", pair_style="",
                                                pair_coeff="", extra="compute L all sph/angmom")),
    ("requires atom style sph/micropolar", dict(atom_style="atom_style sph/bulk", box=BOX, fix="", pair_style="",
                                                pair_coeff="", extra="fix 2 all sph/torque 0 0 1")),
]


@pytest.fixture
def box(lammps):
    write(disordered(2, 10, ntypes=2, spread=0.04), lammps.path("box.data"))
    write(disordered(3, 6, ntypes=2, spread=0.04), lammps.path("box3.data"))
    write(disordered(2, 10, ntypes=2, spread=0.04), lammps.path("zero.data"), inertia=0.0)
    write(disordered(2, 10, ntypes=2, spread=0.04), lammps.path("negative.data"), inertia=-0.1)
    return lammps


def deck(**changes):
    assert set(changes) <= set(GOOD)
    return "\n".join({**GOOD, **changes}.values()) + "\n"


@pytest.mark.parametrize("words, changes", BAD, ids=[" | ".join(c[1].values()).replace("\n", "; ")[:90] for c in BAD])
def test_refused(box, words, changes):
    for ranks in (1, 2) if BAD.index((words, changes)) % 5 == 0 else (1,):
        result = box(deck(**changes), ranks=ranks, check=False, timeout=60)
        assert result.code == 1, f"ended by status {result.code}:\n{result.output[-2000:]}"
        assert re.search(words, result.error), f"the message lacks '{words}':\n{result.error or result.output[-2000:]}"


@pytest.mark.parametrize("changes", [
    {}, dict(pair_coeff="pair_coeff * * 1.0 10.0 0.5 2.0 1.0 0.05 -0.05 3.0"),
    dict(pair_coeff="pair_coeff * * 1.0 10.0 0.5 2.0 0.3 0.05 0.05 2.5", **IN_3D),
    dict(pair_coeff="pair_coeff * * 1.0 10.0 0.5 intrinsic 0.83333333333333333 0.04 -0.06 2.5", **IN_3D),
    dict(pair_coeff="pair_coeff * * 1.0 10.0 0.5 2.0 0.0 0.0 0.0 3.0", box="read_data zero.data")],
    ids=["usual", "mu_r", "xi2", "xi1", "without spin"])
def test_limits_of_the_admissible_range_are_accepted(box, changes):
    result = box(deck(**changes))
    assert not result.warnings, result.warnings
    assert not re.search(r"\bnan\b", result.log)


@pytest.mark.parametrize("fix, step", [(f"fix 1 all {STYLE}", 0.002), (f"fix 1 all {STYLE} inertia 0.001 0.0", 0.002)])
def test_small_inertia_limits_the_time_step(box, fix, step):
    """The same step is allowed with the inertia of the data file and not with a small one."""
    small = "inertia" in fix
    result = box(deck(fix=fix, timestep=f"timestep {step}", run="run 0"))
    assert any("time step" in line and "exceeds" in line for line in result.warnings) == small, result.warnings
    assert re.search("vortex", result.log) and re.search(r"\bspin\b", result.log)
