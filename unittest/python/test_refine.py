"""Particles that split and merge (fix sph/refine): what is conserved, the ledger, numbers of ranks, files, errors."""

import re
import struct

import numpy as np
import pytest

from helpers import Lammps, disordered, drop, fluid, free, header, lattice, relative
from test_micropolar import fluid as micropolar_fluid, spins, write as write_micropolar

SPLITS, MERGES, NUMBER, MASS, MOMENTUM, ANGMOM, KINETIC, ELASTIC, INTERNAL, HEAT, ROTATION, COLDEST = \
    1, 2, 3, 4, 5, 8, 11, 12, 13, 14, 15, 16
LEDGER = "".join(f" f_R[{k}]" for k in range(1, 17))

# half of the fluid is to be fine, every other hundred steps
PHASES = """variable phase equal "floor((step+1)/{period})%2"
variable target atom "1.0 - 0.8*v_phase*(x>{middle})"
"""


def fluid_box(lammps, particles, spin, boundary="p p p", newton="on", support=None):
    """Input lines that make the particles, with pair style and integrator."""
    dim, style = particles.dim, "sph/micropolar" if spin else "sph/bulk"
    if spin:
        write_micropolar(particles, lammps.path("box.data"), omega=spins(particles, size=0.1))
        pair = micropolar_fluid(dim, "volume mass")
    else:
        particles.write(lammps.path("box.data"))
        pair = fluid(dim, "volume mass", support=support)
    return (header(dim, boundary=boundary, style=style, newton=newton) + "read_data box.data\n" + pair
            + f"fix FLUID all {style}\ntimestep 0.002\n")


def output(spin, every, name="refine.dump"):
    columns = "id type mass x y z xu yu zu vx vy vz c_P[1]" + (" omegax omegay omegaz c_P[2]" if spin else " c_P[2]")
    return (f"compute P all property/atom esph {'inertia' if spin else 'vol'}\n"
            f"compute E all sph/energy\nthermo_style custom step atoms c_E[*] pe{LEDGER}\n"
            f"thermo_modify norm no format float %.17g\nthermo {every}\n"
            f"dump D all custom {every} {name} {columns}\ndump_modify D sort id format float %.17g\n")


def ledger(result, k, run=-1):
    return result.thermo()[run][f"f_R[{k}]"][-1]


def sums(frame, spin):
    m = frame["mass"][:, None]
    angmom = m * np.cross(frame["x"], frame["v"])
    parts = angmom
    if spin:
        omega = np.column_stack([frame[f"omega{d}"] for d in "xyz"])
        parts = angmom + m * frame["c_P[2]"][:, None] * omega
    return {"mass": m.sum(axis=0), "centre": (m * frame["x"]).sum(axis=0), "momentum": (m * frame["v"]).sum(axis=0),
            "angular momentum": parts.sum(axis=0)}, {
        "mass": m.sum(), "centre": np.abs(m * frame["x"]).sum(), "momentum": np.abs(m * frame["v"]).sum(),
        "angular momentum": np.abs(angmom).sum()}


def cluster(lammps, dim, spin, ranks=1, newton="on", keywords="wait 0.0", steps=300):
    particles = drop(dim, 8 if dim == 2 else 4, speed=0.05)
    text = fluid_box(lammps, particles, spin, boundary=free(dim), newton=newton)
    text += PHASES.format(period=100, middle=0.0) + f"fix R all sph/refine 5 volume v_target {keywords}\n"
    return lammps(text + output(spin, steps) + f"run {steps}\n", ranks=ranks), lammps.frames("refine.dump")


# ---------------------------------------------------------------------------------------------
# conservation


@pytest.mark.parametrize("spin", [False, True])
@pytest.mark.parametrize("dim", [2, 3])
def test_random_cluster(lammps, dim, spin):
    """A thousand events: mass, momentum, angular momentum to round-off; energy by the ledger."""
    result, (first, last) = cluster(lammps, dim, spin, steps=600 if dim == 2 else 300)
    assert ledger(result, SPLITS) > 300 and ledger(result, MERGES) > 500
    assert ledger(result, NUMBER) == len(last["mass"]) - len(first["mass"])
    (before, scale), (after, _) = sums(first, spin), sums(last, spin)
    for name in ("mass", "momentum", "angular momentum"):
        assert np.abs(after[name] - before[name]).max() < 1e-13 * scale[name], name
    for k in range(MASS, KINETIC):
        assert abs(ledger(result, k)) < 1e-13 * scale["angular momentum"], k
    assert ledger(result, COLDEST) >= 0.0
    kinetic, internal = ledger(result, KINETIC), ledger(result, INTERNAL)
    heat, rotation = ledger(result, HEAT), ledger(result, ROTATION)
    assert heat > 0.0 and (rotation == 0.0) == spin
    assert abs(kinetic + internal) < 1e-12 * abs(kinetic)
    assert abs(internal - (heat - rotation)) < 1e-12 * abs(internal)


@pytest.mark.parametrize("spin", [False, True])
def test_centre_of_mass(lammps, spin):
    """Events alone, without a motion between them."""
    particles = drop(2, 8, speed=0.05)
    text = fluid_box(lammps, particles, spin, boundary=free(2)).replace("timestep 0.002", "timestep 1e-12")
    text += PHASES.format(period=10, middle=0.0) + "fix R all sph/refine 1 volume v_target wait 0.0\n"
    result = lammps(text + output(spin, 100) + "run 100\n")
    first, last = lammps.frames("refine.dump")
    assert ledger(result, SPLITS) > 300 and ledger(result, MERGES) > 300
    (before, scale), (after, _) = sums(first, spin), sums(last, spin)
    for name in before:
        assert np.abs(after[name] - before[name]).max() < 1e-13 * scale[name], name


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("spin", [False, True])
def test_number_of_ranks(tmp_path, dim, spin):
    """The same particles, with the same IDs, on 1, 2, and 4 ranks, with and without newton."""
    keywords = "wait 0.01 fraction 0.05" if spin else "wait 0.0"
    frames = []
    for ranks, newton in ((1, "on"), (2, "on"), (2, "off"), (4, "on")):
        folder = tmp_path / f"{ranks}{newton}"
        folder.mkdir()
        frames.append(cluster(Lammps(folder), dim, spin, ranks, newton, keywords, steps=200)[1][-1])
    one = frames[0]
    for other in frames[1:]:
        assert np.array_equal(one["id"], other["id"])
        for name in ("x", "v", "mass", "c_P[1]"):
            assert relative(one[name] - other[name], one[name]) < 1e-10, name


def test_strain_of_relaxing_processes(lammps):
    """Parts and wholes keep it, all others keep their state.  The process relaxes so slowly that it is elastic."""
    particles = drop(2, 8, speed=0.05)
    text = fluid_box(lammps, particles, False, boundary=free(2)).replace("atom_style sph/bulk", "atom_style sph/bulk relax 1")
    data = lammps.path("box.data").read_text().split("\n\n")
    atoms = data.index(next(one for one in data if one.startswith("Atoms"))) + 1
    data[atoms] = "\n".join(" ".join([*words[:4], "-0.97", *words[4:]]) for words in map(str.split, data[atoms].splitlines()))
    lammps.path("box.data").write_text("\n\n".join(data))
    text = text.replace("\nfix FLUID", " relax 2e12 1e12\nfix FLUID").replace("timestep 0.002", "timestep 0.0002")
    text += PHASES.format(period=10, middle=0.0) + "fix R all sph/refine 5 volume v_target wait 0.0\n"
    result = lammps(text + output(False, 1).replace("c_P[1]", "c_P[1] d_rho_relaxed1 c_RHO").replace("compute P", "compute RHO all property/atom rho\ncompute P", 1)
                    + "run 40\n")
    assert ledger(result, SPLITS) > 100 and ledger(result, MERGES) > 100 and ledger(result, ROTATION) > 0.0
    frames = lammps.frames("refine.dump")
    for old, new in zip(frames, frames[1:]):
        known, place = np.isin(new["id"], old["id"]), np.searchsorted(old["id"], new["id"])
        place[~known] = 0
        same = known & (old["mass"][place] == new["mass"])
        state = new["d_rho_relaxed1"]
        assert np.abs(state / old["d_rho_relaxed1"][place] - 1.0)[same].max() < 1e-9
        changed = known & ~same
        if changed.any():
            before, after = (np.log(one["c_RHO"] / one["d_rho_relaxed1"]) for one in (old, new))
            assert before.min() - 1e-3 < after[changed].min() and after[changed].max() < before.max() + 1e-3


@pytest.mark.parametrize("dim, spin, tilt", [(2, False, None), (2, False, (3.0, 0.0, 0.0)), (3, True, None)])
def test_periodic_box(tmp_path, dim, spin, tilt):
    """Merges across periodic boundaries and borders of processors."""
    frames = []
    for ranks in (1, 2, 4):
        folder = tmp_path / str(ranks)
        folder.mkdir()
        lammps = Lammps(folder)
        particles = disordered(dim, 16 if dim == 2 else 7, speed=0.1, tilt=tilt, spread=0.3)
        text = fluid_box(lammps, particles, spin) + 'variable phase equal "floor((step+1)/20)%2"\n' \
            'variable target equal "0.3+1.5*v_phase"\nfix R all sph/refine 5 volume v_target wait 0.0\n'
        result = lammps(text + output(spin, 100) + "run 100\n", ranks=ranks)
        first, last = lammps.frames("refine.dump")
        (before, scale), (after, _) = sums(first, spin), sums(last, spin)
        for name in ("mass", "momentum"):
            assert np.abs(after[name] - before[name]).max() < 1e-13 * scale[name], name
        assert ledger(result, MERGES) > 300 and ledger(result, SPLITS) > 200
        frames.append(last)
    for other in frames[1:]:
        assert np.array_equal(frames[0]["id"], other["id"])
        assert relative(frames[0]["v"] - other["v"], other["v"]) < 1e-9


@pytest.mark.parametrize("ranks", [1, 4])
@pytest.mark.parametrize("rate", [0.0, 0.3])
@pytest.mark.parametrize("dim, spin", [(2, False), (2, True), (3, False), (3, True)])
def test_back_again(lammps, dim, spin, rate, ranks):
    """Particles that split alone, and merge back: the parents return, at rest and in rigid rotation."""
    cells = 13 if dim == 2 else 7
    particles = lattice(dim, cells)
    place = np.floor(particles.x[:, :dim]).astype(int)
    particles.type = np.where(np.all((place % 3 == 1) & (place < cells - 2), axis=1), 2, 1)
    particles.x = particles.x - 0.5 * cells * (np.arange(3) < dim)
    turn = rate * np.array([0.0, 0.0, 1.0] if dim == 2 else [0.4, -0.7, 1.0])
    particles.v = np.cross(turn, particles.x)
    particles.lo[:dim], particles.hi[:dim] = -20.0, 20.0
    nsplit = np.count_nonzero(particles.type == 2)
    text = fluid_box(lammps, particles, spin, boundary=free(dim)).replace("timestep 0.002", "timestep 1e-17")
    if spin:
        text += f"set group all omega {turn[0]} {turn[1]} {turn[2]}\n"
    lammps(text + "group some type 2\n" + output(spin, 1).replace(LEDGER, "")
           + 'variable target equal "0.15+0.85*(step>1)"\n'
           "fix R some sph/refine 1 volume v_target wait 0.0 merge 0.7\nrun 5\n", ranks=ranks)
    frames = lammps.frames("refine.dump")
    first, split, last = frames[0], frames[1], frames[-1]
    assert len(split["id"]) == len(first["id"]) + (2**dim - 1) * nsplit
    assert np.array_equal(first["id"], last["id"])
    names = ["x", "v", "mass", "c_P[1]"] + (["omegax", "omegay", "omegaz", "c_P[2]"] if spin else [])
    for name in names:
        assert np.abs(first[name] - last[name]).max() < 1e-12 * (1.0 + np.abs(first[name]).max()), name


@pytest.mark.parametrize("spin", [False, True])
def test_rotating_drop(lammps, spin):
    """Half of a drop refined and merged again and again in 10,000 steps."""
    particles = lattice(2, 20)
    particles.x[:, :2] -= 10.0
    particles = particles.where(np.linalg.norm(particles.x, axis=1) < 7.0)
    particles.v = np.cross([0.0, 0.0, 0.1], particles.x)
    particles.lo[:2], particles.hi[:2] = -40.0, 40.0
    text = fluid_box(lammps, particles, spin, boundary=free(2))
    text += PHASES.format(period=500, middle=0.0) + "fix R all sph/refine 20 volume v_target\n"
    result = lammps(text.replace("timestep 0.002", "timestep 0.005") + output(spin, 10000) + "run 10000\n", timeout=300)
    first, last = lammps.frames("refine.dump")
    assert ledger(result, SPLITS) > 1000 and ledger(result, MERGES) > 2000
    (before, scale), (after, _) = sums(first, spin), sums(last, spin)
    for name in ("momentum", "angular momentum"):
        assert np.abs(after[name] - before[name]).max() < 1e-12 * scale[name], name


# ---------------------------------------------------------------------------------------------
# what happens, and to whom


def test_fluid_at_rest(tmp_path):
    """Coarse and fine particles under a background pressure: densities, and velocities after relaxation."""
    errors = []
    for support, bound in ((3.0, 0.017), (4.0, 0.0072), (5.0, 0.0047), (6.0, 0.0032)):
        lammps = Lammps(tmp_path)
        particles = lattice(2, 24)
        particles.write(lammps.path("box.data"))
        result = lammps(
            header(2) + "read_data box.data\n" + fluid(2, "volume mass", mu=2.0, kappa=4.0, support=support, keywords="pb 10.0")
            + 'fix FLUID all sph/bulk\ntimestep 0.005\nvariable target atom "1.0-0.75*(x>12)"\n'
            "fix R all sph/refine 1 volume v_target\n"
            'variable speed atom "sqrt(vx*vx+vy*vy)"\ncompute V all reduce max v_speed\n'
            "compute RHO all property/atom rho\ncompute LO all reduce min c_RHO\ncompute HI all reduce max c_RHO\n"
            "thermo_style custom step atoms c_V c_LO c_HI f_R[1] f_R[2]\nthermo 1\nrun 1\n"
            + ("thermo 1600\nrun 1600\n" if support == 4.0 else ""), timeout=300)
        split = result.thermo()[0]
        assert split["Atoms"][-1] == 24 * 24 * 2.5
        uniform = split["c_LO"][0]  # a lattice of one size has an error of its own
        errors.append(max(split["c_HI"][1] - uniform, uniform - split["c_LO"][1]))
        assert max(split["c_HI"][1] - 1.0, 1.0 - split["c_LO"][1]) < bound
        if support == 4.0:
            relaxed = result.thermo()[1]
            assert relaxed["c_V"][-1] < 1e-3 * 10.0
            assert relaxed["f_R[1]"][-1] == 24 * 12
            assert relaxed["f_R[2]"][-1] == 0.0
    assert np.all(np.diff(errors) < 0.0)


def test_along_the_axis(lammps):
    """Particles stretched in x split in two along x, into a lattice."""
    particles = lattice(2, 12)
    particles.x[:, 0] *= 2.0
    particles.hi[0] *= 2.0
    particles.mass[:] = 2.0
    text = fluid_box(lammps, particles, False, support=4.0)
    result = lammps(text + "fix R all sph/refine 1 volume 1.0\n" + output(False, 1) + "run 1\n")
    last = lammps.frame("refine.dump")
    assert ledger(result, NUMBER) == 144
    x = np.sort(np.unique(np.round(last["x"][:, 0], 6)))
    assert len(x) == 24
    assert np.ptp(np.diff(x)) < 0.25  # the spacing of the neighbors is an estimate
    assert len(np.unique(np.round(last["x"][:, 1], 6))) == 12


def test_types_groups_and_walls(lammps):
    """No pairs across types, groups, and walls; new particles are in the groups of their parents."""
    particles = disordered(2, 20, ntypes=2, speed=0.1, spread=0.0)
    text = fluid_box(lammps, particles, False)
    text = text.replace("fix FLUID all sph/bulk", """region floor block INF INF INF 4.0 INF INF
region left block INF 10.0 INF INF INF INF
group wall region floor
group moving subtract all wall
group left region left
fix W wall sph/wall
fix FLUID moving sph/bulk""")
    text += """variable mass1 equal mass(all)
group one type 1
variable m1 equal mass(one)
variable ml equal mass(left)
variable mw equal mass(wall)
variable nw equal count(wall)
variable phase equal "floor((step+1)/10)%2"
variable target equal "0.3+1.5*v_phase"
fix R all sph/refine 5 volume v_target wait 0.0
thermo_style custom step atoms v_m1 v_ml v_mw v_nw f_R[1] f_R[2]
thermo_modify format float %.15g
thermo 50
run 50
"""
    table = lammps(text, ranks=2).thermo()[0]
    assert table["f_R[1]"][-1] > 100 and table["f_R[2]"][-1] > 100
    for name in ("v_m1", "v_ml", "v_mw", "v_nw"):
        assert abs(table[name][-1] - table[name][0]) < 1e-12 * table[name][0], name


@pytest.mark.parametrize("ranks", [1, 2, 4])
def test_open_boundaries(lammps, ranks):
    """A stream from an inlet to an outlet that is fine in between: the account of its mass closes."""
    table = lammps(header(2, boundary="f p p") + """lattice sq 1.0 origin 0.5 0.5 0.0
region box block -10 34 0 8 -0.5 0.5
create_box 1 box
region filled block -9 33 INF INF INF INF
create_atoms 1 region filled
set group all mass 1.0
region middle block 0 24 INF INF INF INF
region west block INF 0 INF INF INF INF
region east block 24 INF INF INF INF INF
group fluid region middle
group in region west
group out region east
velocity all set 1.0 0.0 0.0
pair_style sph/bulk volume mass
pair_coeff * * 1.0 10.0 0.5 1.0 3.0 pb 10.0
fix FLUID fluid sph/bulk density rho0
fix I in sph/open fluid 0 0 0 1 0 0 9 velocity 1.0 0 0
fix O out sph/open fluid 24 0 0 -1 0 0 9 pressure 10.0
variable target atom "1.0-0.75*(x>8)*(x<16)"
fix R all sph/refine 5 volume v_target
timestep 0.01
variable m equal mass(fluid)
variable balance equal v_m-f_I[2]+f_I[12]-f_O[2]+f_O[12]
compute LO fluid reduce min vx
compute HI fluid reduce max vx
thermo_style custom step atoms v_balance c_LO c_HI f_R[1] f_R[2] f_R[4] f_I[1] f_I[28] f_O[11]
thermo_modify format float %.15g
thermo 100
run 800
""", ranks=ranks).thermo()[0]
    assert table["f_R[1]"][-1] > 100 and table["f_R[2]"][-1] > 150
    assert table["f_I[1]"][-1] == table["f_O[11]"][-1] == 64
    assert np.ptp(table["v_balance"]) < 1e-12 * table["v_balance"][0]
    assert 0.9 < table["c_LO"].min() and table["c_HI"].max() < 1.1


def test_wait_and_fraction(lammps):
    """One event per particle and waiting time; no more events at once than asked for."""
    text = fluid_box(lammps, lattice(2, 16), False) + "fix R all sph/refine 1 volume 0.05 split 1.6 {}\n" + output(False, 1)
    waits = lammps(text.format("wait 0.02") + "run 25\n").thermo()[0]["Atoms"]
    changes = np.flatnonzero(np.diff(waits)) + 1
    assert changes.tolist() == [1, 11, 21][:len(changes)] and len(changes) >= 2
    once = lammps(text.format("wait 1e300") + "run 12\n").thermo()[0]
    assert once["f_R[1]"].tolist() == [0.0] + 12 * [256.0]
    some = lammps(text.format("wait 0.0 fraction 0.1") + "run 3\n").thermo()[0]
    assert np.diff(some["f_R[1]"]).max() <= 0.1 * some["Atoms"].max()
    assert some["f_R[1]"][1] == 25


@pytest.mark.parametrize("dim, spin", [(2, False), (3, True)])
def test_restart(lammps, dim, spin):
    """A continued run goes on as if it had not stopped, with its ledger, its waiting times, and whose daughter each particle is."""
    particles = drop(dim, 6 if dim == 2 else 4, speed=0.05)
    text = fluid_box(lammps, particles, spin, boundary=free(dim))
    rest = PHASES.format(period=25, middle=0.0) + "fix R all sph/refine 5 volume v_target wait 0.05\n"
    whole = lammps(text + rest + output(spin, 50) + "run 35\nwrite_restart half\nrun 65\n")
    one = lammps.frame("refine.dump")
    style = f"fix FLUID all {'sph/micropolar' if spin else 'sph/bulk'}\ntimestep 0.002\n"
    again = lammps("read_restart half\n" + style + rest + output(spin, 50) + "run 65\n", ranks=2)
    other = lammps.frame("refine.dump")
    assert np.array_equal(one["id"], other["id"])
    for name in ("v", "c_P[2]"):
        assert relative(one[name] - other[name], one[name]) < 1e-9, name
    for k in range(1, 17):
        assert abs(ledger(whole, k) - ledger(again, k)) < 1e-9 * (1.0 + abs(ledger(whole, k))), k


def test_family_in_a_narrow_box(lammps):
    """Of two images of a daughter, the nearer one merges, and no other instead of one that is missing."""
    particles = disordered(3, (8, 8, 1), jitter=0.0, speed=0.2, spread=0.0)
    write_micropolar(particles, lammps.path("box.data"), omega=spins(particles, size=0.1))
    text = (header(3, style="sph/micropolar") + "read_data box.data\npair_style sph/micropolar volume mass\n"
            "pair_coeff * * 1.0 6.0 0.3 0.8 0.1 0.02 -0.02 2.0\nfix FLUID all sph/micropolar\ntimestep 0.004\n"
            'neigh_modify one 20000 page 1000000\nvariable target equal "1.0-0.875*(step<8)"\n'
            "fix R all sph/refine 4 volume v_target wait 0.0\n" + output(True, 4) + "run 8\n")
    for ranks in (1, 2):
        lammps(text, ranks=ranks)
        first, fine, last = lammps.frames("refine.dump")
        assert len(first["id"]) == 64 and len(fine["id"]) == 512 and len(last["id"]) < 300
        (before, scale), (after, _) = sums(first, True), sums(last, True)
        for name in ("mass", "momentum"):
            assert abs(after[name] - before[name]).max() < 1e-13 * scale[name].max(), name


def test_images_at_the_same_distance(tmp_path):
    """On a lattice two cells wide, a partner is as far on both sides: the place of the merged particle is the same on any ranks."""
    found = []
    for ranks, newton in ((1, "on"), (2, "off"), (4, "on")):
        (tmp_path / str(ranks)).mkdir()
        lammps = Lammps(tmp_path / str(ranks))
        text = fluid_box(lammps, lattice(3, (2, 6, 2)), False, newton=newton, support=4.0)
        lammps(text + "fix R all sph/refine 1 volume 2.0 wait 0.0\n" + output(False, 1) + "run 1\n", ranks=ranks)
        found.append(lammps.frame("refine.dump"))
        assert len(found[-1]["id"]) == 12
    for other in found[1:]:
        assert np.array_equal(found[0]["id"], other["id"])
        assert np.abs(found[0]["x"] - other["x"]).max() < 1e-12


@pytest.mark.parametrize("form, word", [(0.0, "an older"), (-1002.0, "an older"), (-1004.0, "a newer")])
def test_restart_file_of_another_version(lammps, form, word):
    fix = "fix R all sph/refine 5 volume 1.0\n"
    lammps(fluid_box(lammps, lattice(2, 8), False) + fix + "write_restart whole\n")
    data = lammps.path("whole").read_bytes()
    head = struct.pack("<d", -1003.0)
    assert data.count(head) == 1
    lammps.path("whole").write_bytes(data.replace(head, struct.pack("<d", form)))
    result = lammps("read_restart whole\n" + fix, ranks=2, check=False)
    assert result.code != 0 and f"Fix sph/refine R: the restart file was written by {word} version of this fix" in result.error


def test_life(lammps):
    """Read before a run, runs of all kinds, steps counted anew, defined anew, particles deleted and created between runs."""
    text = fluid_box(lammps, disordered(2, 12, speed=0.1, spread=0.3), False)
    fix = "fix R all sph/refine 5 volume v_target wait 0.0\n"
    result = lammps(text + 'variable phase equal "floor((step+1)/20)%2"\nvariable target equal "0.3+1.5*v_phase"\n' + fix
                    + """comm_style tiled
fix B all balance 10 1.0 rcb
variable early equal f_R[1]
print "EARLY ${early}"
fix A all store/state 0 vx vy
run 0
run 20
run 20 pre no
run 40 every 10 NULL
reset_timestep 3
variable m equal mass(all)
thermo_style custom step atoms v_m f_R[1] f_R[2]
thermo_modify format float %.15g
run 40
region half block 0 6 INF INF INF INF
delete_atoms region half
unfix R
""" + fix + "create_atoms 1 single 3 3 0\nset region half mass 1.0\nrun 40\nminimize 0 0 3 3\n", ranks=4)
    assert "EARLY 0" in result.output
    for table in (result.thermo()[-3], result.thermo()[-2]):
        assert abs(table["v_m"][-1] / table["v_m"][0] - 1.0) < 1e-13
        assert table["f_R[1]"][-1] + table["f_R[2]"][-1] > 50


def test_nothing_to_do(lammps):
    """A fix without an event changes no bit of a run."""
    text = fluid_box(lammps, disordered(2, 12, speed=0.1, spread=0.0), False)
    lammps(text + output(False, 50).replace(LEDGER, "") + "run 50\n")
    one = lammps.frame("refine.dump")
    result = lammps(text + "fix R all sph/refine 10 volume 1.0 split 9.0 merge 0.1\n" + output(False, 50) + "run 50\n")
    assert ledger(result, SPLITS) == ledger(result, MERGES) == 0.0
    other = lammps.frame("refine.dump")
    assert np.array_equal(one["x"], other["x"]) and np.array_equal(one["v"], other["v"])


@pytest.mark.parametrize("spin", [False, True])
def test_thermal_noise(tmp_path, spin):
    """New particles have noise of their own, the same on any number of ranks; fine and coarse ones come to its temperature."""
    temperature, last = 0.2, []
    style, viscosities = ("sph/micropolar", " 0.1 0.02 -0.02") if spin else ("sph/bulk", "")
    for ranks in (1, 2):
        folder = tmp_path / str(ranks)
        folder.mkdir()
        lammps = Lammps(folder)
        particles = lattice(2, 14)
        if spin:
            write_micropolar(particles, lammps.path("box.data"), omega=np.zeros((196, 3)))
        else:
            particles.write(lammps.path("box.data"))
        text = (header(2, style=style) + "read_data box.data\n"
                f"velocity all create {temperature} 87 loop all\npair_style {style} volume mass temp {temperature} 99\n"
                f"pair_coeff * * 1.0 6.0 0.3 0.8{viscosities} 3.0 pb 20.0\n"
                f"fix FLUID all {style}{' inertia 0.16 0.0' if spin else ''}\ntimestep 0.003\n"
                'variable target atom "1.0-0.7*(x>7.0)"\nfix R all sph/refine 10 volume v_target wait 0.1\n'
                "thermo_style custom step atoms f_R[1] f_R[2]\nthermo 60\n"
                "dump D all custom 60 noise.dump id type mass x y z xu yu zu vx vy vz\n"
                "dump_modify D sort id format float %.17g\nrun 60\nundump D\n")
        if ranks == 1:
            text += ("run 240\nthermo_style one\nunfix R\nvariable fine atom mass<0.6\ngroup fine variable fine\ngroup coarse subtract all fine\n"
                     "variable n equal count(fine)\ncompute F fine sph/temp\ncompute C coarse sph/temp\nrun 200\n"
                     "reset_timestep 0\nfix av all ave/time 2 1500 3000 c_F c_C c_F[4] c_C[4]\n"
                     "thermo_style custom step f_av[*] v_n\nthermo 3000\nrun 3000\n")
        result = lammps(text, ranks=ranks, timeout=300)
        if ranks == 1:
            found = {name: column[-1] for name, column in result.thermo()[-1].items()}
            events = [result.thermo()[1][f"f_R[{k}]"][-1] for k in (1, 2)]
        last.append(lammps.frame("noise.dump"))
    assert np.array_equal(last[0]["id"], last[1]["id"]) and len(last[0]["id"]) > 300
    assert relative(last[0]["v"] - last[1]["v"], last[0]["v"]) < 1e-9
    assert events[0] >= 98 and sum(events) > 98
    # as in test_noise.py: one independent sample per time of 1
    nfine = found["v_n"]
    assert nfine > 200
    for k, number in ((1, nfine), (2, 98.0)):
        error = temperature * np.sqrt(1.0 / (number * 9.0))
        assert abs(found[f"f_av[{k}]"] - temperature) < 5 * error, (k, found)
        if spin:
            assert abs(found[f"f_av[{2 + k}]"] - temperature) < 5 * np.sqrt(2.0) * error, (k, found)


# ---------------------------------------------------------------------------------------------
# bad input

BAD = [("fix R all sph/refine 1", "Illegal fix sph/refine"),
       ("fix R all sph/refine 0 volume 1.0", "must be > 0, not 0"),
       ("fix R all sph/refine 1 mass 1.0", "must be volume or spacing, not mass"),
       ("fix R all sph/refine 1 volume -1.0", "the target -1.0 is -1"),
       ("fix R all sph/refine 1 volume 1e-12", "asks for"),
       ("fix R all sph/refine 1 volume 0.01", "144 particles are to become smaller than a volume of 0.017"),
       ("fix R all sph/refine 1 spacing 2.5", "hardly any neighbors"),
       ("fix R all sph/refine 1 volume v_none", "Variable none"),
       ("variable a string b\nfix R all sph/refine 1 volume v_a", "neither of equal style"),
       ('variable a atom "x-100.0"\nfix R all sph/refine 1 volume v_a', "for particle"),
       ("fix R all sph/refine 1 volume 1.0 split 0.5", "split must be > 1"),
       ("fix R all sph/refine 1 volume 1.0 merge 2", "merge must be between 0 and 1"),
       ("fix R all sph/refine 1 volume 1.0 split 1.1 merge 0.9", "at least twice"),
       ("fix R all sph/refine 1 volume 1.0 wait -1", "wait must be >= 0"),
       ("fix R all sph/refine 1 volume 1.0 fraction 0", "fraction must be > 0"),
       ("fix R all sph/refine 1 volume 1.0 fraction", "Illegal fix sph/refine fraction"),
       ("fix R all sph/refine 1 volume 1.0 color 1", "Unknown fix sph/refine keyword: color"),
       ("fix R all sph/refine 1 volume 1.0\nfix S all sph/refine 1 volume 2.0", "both have 144 particles"),
       ("pair_style sph/bulk\npair_coeff * * 1.0 10.0 0.5 2.0 3.0\nfix R all sph/refine 1 volume 1.0", "volume number"),
       ("pair_style zero 3.0\npair_coeff * *\nfix R all sph/refine 1 volume 1.0", "requires pair style sph/bulk"),
       ("neigh_modify once yes\nfix R all sph/refine 1 volume 1.0", "once must be no"),
       ("comm_modify vel yes\nfix D all deform 1 x erate 0.1 remap v\nfix R all sph/refine 1 volume 1.0", "fix deform with remap v"),
       ("fix R all sph/refine 1 volume v_", "Variable  for Fix sph/refine does not exist")]


@pytest.mark.parametrize("line, words", BAD)
@pytest.mark.parametrize("ranks", [1, 2])
def test_refused(lammps, line, words, ranks):
    if ranks == 2 and BAD.index((line, words)) % 4:
        return
    result = lammps(fluid_box(lammps, disordered(2, 12), False) + line + "\nrun 2\n", ranks=ranks, check=False)
    assert result.code != 0
    assert words in result.error


@pytest.mark.parametrize("style, words", [("atomic", "requires atom style sph/bulk"),
                                          ("sph/bulk\natom_modify id no", "requires atom IDs"),
                                          ("hybrid sph/bulk bond", "molecules or bonds")])
def test_refused_atom_styles(lammps, style, words):
    text = (f"units lj\ndimension 2\natom_style {style}\nregion box block 0 9 0 9 -0.5 0.5\ncreate_box 1 box\n"
            "fix R all sph/refine 1 volume 1.0\n")
    result = lammps(text, check=False)
    if "MOLECULE package" in result.error:
        pytest.skip("this LAMMPS has no molecules")
    assert result.code != 0
    assert words in result.error


def test_default_wait_is_that_of_the_speed_of_sound(lammps):
    """Of a gas, whose c0 has no effect, and of a liquid: the support radius over it."""
    seen = []
    particles = lattice(2, 16)
    for eos, c0 in (("ideal", 0.01), ("ideal", 1.0), ("ideal", 1000.0), ("linear", np.sqrt(1.4 * 0.4 * 2.0))):
        text = fluid_box(lammps, particles, False)
        support = re.search(r"pair_coeff (.*)", text)[1].split()[6]
        text = re.sub(r"pair_style.*", f"pair_style sph/bulk eos {eos} volume mass", text)
        text = re.sub(r"pair_coeff.*", f"pair_coeff * * 1.0 {c0} 0.0 0.0 {support} cv 2.0", text)
        text = text.replace("all sph/bulk", "all sph/bulk temperature 1.0").replace("timestep 0.002", f"timestep {0.1 * float(support) / np.sqrt(1.4 * 0.4 * 2.0) * 1.0001}")
        atoms = lammps(text + "fix R all sph/refine 1 volume 0.05 split 1.6 fraction 1.0\nthermo 1\nthermo_style custom step atoms\nrun 12\n").thermo()[0]["Atoms"]
        seen.append((np.flatnonzero(np.diff(atoms)) + 1).tolist())
    assert seen[0] == seen[1] == seen[2] == seen[3] == [1, 11], seen
