"""Elastic bodies and chains in the fluid, fix sph/wall move elastic: LAMMPS's fix nve and bonds move the particles."""

import subprocess

import numpy as np
import pytest

from helpers import LMP, relative
from test_bodies import BODY, FLUID, FULL, OMEGA, SPEED, VELOCITY, cross_of, dense_friction, forces, small

pytestmark = pytest.mark.skipif("MOLECULE" not in subprocess.run([LMP, "-h"], capture_output=True, text=True, check=True).stdout,
                                reason="LAMMPS was built without bonds")
RIGID = "fix 2 body rigid single\nfix 3 body sph/wall move rigid\n"
ELASTIC = "fix 2 body nve\nfix 3 body sph/wall move elastic\n"


def alone(lammps, coeff, options=""):
    """The five particles of test_bodies without bonds."""
    text = small(lammps, coeff, options)
    assert RIGID in text
    return text.replace(RIGID, ELASTIC)


@pytest.mark.parametrize("coeff, options", [("1.0 1e-9 0.7 1.8 2.5", ""), ("1.0 5.0 0.7 1.8 2.5 pb 1.5", ""), ("1.0 5.0 0.7 1.8 2.5", "density continuity"),
                                            ("1.0 5.0 0.7 1.8 2.5", "volume mass temp 0.3 5")])
def test_forces_are_those_on_a_rigid_body(lammps, coeff, options):
    """On every particle, as long as the body moves as one."""
    want = forces(lammps, small(lammps, coeff, options) + "run 0\n")[1]
    for ranks in (1, 2):
        found = forces(lammps, alone(lammps, coeff, options) + "run 0\n", ranks)[1]
        assert np.abs(found - want).max() < 1e-13 * np.abs(want).max()


def test_friction_is_that_of_the_dense_matrix(lammps):
    """With a velocity of each particle; the matrix is symmetric, and rigid motions of all have no friction."""
    x, body = FLUID + BODY, [False] * 12 + [True] * 5
    v = np.array(list(SPEED) + [VELOCITY + cross_of(at, OMEGA) for at in BODY])
    shake = np.random.default_rng(3).normal(size=(5, 2))
    v[12:] += shake
    lines = "".join(f"set atom {13 + k} vx {u[0]:.17g} vy {u[1]:.17g}\n" for k, u in enumerate(v[12:]))
    gamma, _ = dense_friction(x, body, 0.7, 0.4, 2.5, rigid=False)
    f = forces(lammps, alone(lammps, "1.0 1e-9 0.7 1.8 2.5", "temp 1e-30 1") + lines + "run 0\n")[1]
    np.testing.assert_allclose(f[:, :2].ravel(), -gamma @ v.ravel(), rtol=0, atol=1e-11)
    assert np.abs(gamma - gamma.T).max() < 1e-13 and np.abs(np.linalg.eigvalsh(gamma)[:3]).max() < 1e-13


def test_covariance_of_the_impulses(lammps):
    """Random impulses of all particles in a step dt have the covariance 2 kT Gamma dt."""
    samples, step, kt = 20000, 1e-12, 0.3
    gamma, _ = dense_friction(FLUID + BODY, [False] * 12 + [True] * 5, 0.7, 0.4, 2.5, rigid=False)
    text = alone(lammps, "1.0 1e-9 0.7 1.8 2.5", f"temp {kt} 5").replace("id x y z vx vy vz fx fy fz", "fx fy").replace("float %.17g", "float %.9g")
    lammps(text + f"velocity all set 0.0 0.0 0.0\nthermo {samples}\ntimestep {step}\nrun {samples}\n")
    lines = np.array(lammps.path("out.dump").read_text().split("\n")[:-1]).reshape(-1, 9 + 17)[1:, 9:]
    impulses = step * np.array(" ".join(lines.ravel()).split(), dtype=float).reshape(samples, 34)
    rates, modes = np.linalg.eigh(gamma)
    kept = rates > 1e-10
    scaled = impulses @ modes / np.sqrt(2 * kt * step * np.maximum(rates, rates[kept].min()))
    assert np.abs(scaled[:, ~kept]).max() < 1e-5
    n = kept.sum()
    covariance = scaled[:, kept].T @ scaled[:, kept] / samples
    deviations = ((covariance - np.eye(n)) * np.sqrt(samples / (1 + np.eye(n))))[np.triu_indices(n)]
    print(n, np.mean(deviations**2), np.abs(deviations).max())
    assert abs(np.mean(deviations**2) - 1) < 3 * np.sqrt(2 / len(deviations)) and np.abs(deviations).max() < 5.0


def drop(options="", newton="on", dim=2, step=0.01, boundary="f f f", mass=1.0, extra="", shift=0.0):
    """A drop of fluid in an open box, or a fluid in a periodic one, with a block of bonds in it; all turn and travel."""
    z = "-9 9" if dim == 3 else "-0.5 0.5"
    region = f"sphere 0 0 0 {6.5 if dim == 2 else 4.6}" if boundary[0] == "f" else "block EDGE EDGE EDGE EDGE EDGE EDGE"
    body = "block -2.1 3.1 -1.1 1.1 INF INF" if dim == 2 else "block -1.1 2.1 -1.1 1.1 -0.1 1.1"
    return (f"units lj\ndimension {dim}\nboundary {boundary if dim == 3 else boundary[:-1] + 'p'}\nnewton {newton}\n"
            f"atom_style hybrid sph/bulk bond\nlattice {'sq' if dim == 2 else 'sc'} 1.0\nregion box block -9 9 -9 9 {z}\n"
            "create_box 2 box bond/types 2 extra/bond/per/atom 18 extra/special/per/atom 60\n"
            f"region drop {region}\ncreate_atoms 1 region drop\nreset_atoms id sort yes\nregion body {body}\nset region body type 2\n"
            f"set type 1 mass 1.0\nset type 2 mass {mass}\ngroup fluid type 1\ngroup body type 2\n"
            "bond_style harmonic\nbond_coeff 1 100.0 1.0\nbond_coeff 2 50.0 $(sqrt(2))\n"
            "pair_style zero 2.0\npair_coeff * *\nspecial_bonds lj 0 1 1\n"
            "create_bonds many body body 1 0.9 1.1\ncreate_bonds many body body 2 1.3 1.5\nspecial_bonds lj 1 1 1\n"
            f"displace_atoms fluid random 0.1 0.1 {0.1 if dim == 3 else 0.0} 5\ndisplace_atoms all move {shift} 0 0\n"
            "velocity all create 0.05 4 loop geom\nvelocity all ramp vx -0.3 0.3 y -6 6 sum yes\n"
            f"neighbor 0.5 bin\npair_style sph/bulk {options}\npair_coeff * * 1.0 10.0 0.3 0.8 2.6\n"
            f"pair_coeff 2 2 {mass} {10.0 * mass**-0.5:.12g} 0.3 0.8 2.6\n"
            f"fix 1 fluid sph/bulk\n{ELASTIC}timestep {step}\n"
            "variable px atom mass*vx\nvariable py atom mass*vy\nvariable pz atom mass*vz\n"
            "compute U all property/atom xu yu zu\nvariable lx atom mass*(c_U[2]*vz-c_U[3]*vy)\n"
            "variable ly atom mass*(c_U[3]*vx-c_U[1]*vz)\nvariable lz atom mass*(c_U[1]*vy-c_U[2]*vx)\n"
            "compute L all reduce sum v_lx v_ly v_lz\ncompute P all reduce sum v_px v_py v_pz\ncompute E all sph/energy\n"
            "compute B all pe bond\nvariable e equal c_E+c_B\nthermo_style custom step c_P[*] c_L[*] ke pe c_B v_e\n" + FULL + extra)


@pytest.mark.parametrize("dim, options, mass, ranks, newton", [
    (2, "", 1.0, 1, "on"), (2, "temp 0.02 7", 3.0, 2, "off"), (3, "shear mg/fr2", 0.5, 4, "on"), (2, "density continuity", 2.0, 4, "on")])
def test_momentum_and_angular_momentum(lammps, dim, options, mass, ranks, newton):
    table = lammps(drop(options, newton, dim, mass=mass) + "thermo 20\nrun 300\n", ranks=ranks).thermo()[-1]
    assert np.ptp(table["c_B"]) > 0.1
    for kind in "PL":
        value = np.column_stack([table[f"c_{kind}[{k}]"] for k in (1, 2, 3)])
        assert np.abs(value - value[0]).max() < 2e-13 * max(np.abs(value).max(), 20.0), (kind, value[-1] - value[0])


@pytest.mark.parametrize("dim, mass, options, boundary", [(2, 1.0, "", "f f f"), (3, 2.0, "", "f f f"), (2, 1.0, "density continuity", "f f f"),
                                                          (2, 3.0, "density continuity delta 0 tension yes", "p p p")])
def test_energy(lammps, dim, mass, options, boundary):
    """Kinetic energy, internal energies, and the energy of bonds, to second order in the step."""
    drift = {}
    for step in (0.004, 0.002):
        table = lammps(drop(options, dim=dim, mass=mass, step=step, boundary=boundary) + f"thermo 5\nrun {round(1.0 / step)}\n").thermo()[-1]
        drift[step] = np.abs(table["v_e"] - table["v_e"][0]).max()
        turned = np.ptp(table["c_B"])
    print(drift, turned)
    assert turned > 0.2 and drift[0.004] < 0.2 * turned and drift[0.002] < 0.3 * drift[0.004]


def test_ranks_and_restart(lammps):
    """A body across the border of the box, on any number of ranks, in one run, in two, and from a restart file.

    The start of a run finds the surface of the body anew, as each neighbor list does: with a list in each step, the forces are the same."""
    dump = "dump D all custom 60 {}.dump id xu yu zu vx vy vz fx fy fz\ndump_modify D sort id format float %.17g\n"
    want = None
    for options in ("", "density continuity"):
        text = drop(options, boundary="p p p", shift=8.0).replace("neighbor 0.5 bin", "neighbor 0.5 bin\nneigh_modify check no")
        for ranks, newton in ((1, "on"), (2, "off"), (4, "on")):
            lammps(text.replace("newton on", f"newton {newton}") + dump.format("out") + "run 60\n", ranks=ranks)
            frame = lammps.frames("out.dump")[-1]
            want = frame if ranks == 1 else want
            assert relative(frame["x"] - want["x"], want["x"]) < 1e-11 and relative(frame["f"] - want["f"], want["f"]) < 1e-10, ranks
        lammps(text + dump.format("twice") + "run 30\nwrite_restart box.restart\nrun 30\n")
        after = text[text.index("neighbor 0.5 bin"):]
        lammps("newton on\natom_style hybrid sph/bulk bond\nread_restart box.restart\nspecial_bonds lj 1 1 1\n" + after[:after.index("pair_style")] + after[after.index("fix 1 fluid"):]
               + dump.format("read") + "run 30\n")
        for name in ("twice", "read"):
            frame = lammps.frames(f"{name}.dump")[-1]
            for what in ("x", "v", "f"):
                assert relative(frame[what] - want[what], want[what]) < 1e-10, (options, name, what)


def test_a_velocity_that_a_command_sets(lammps):
    """... between two runs acts in the first forces of the second: no motion, no friction."""
    text = drop() + "run 20\nvelocity all set 0.0 0.0 0.0\ncompute H all sph/dissipation\nthermo_style custom step c_H[1] c_H[2]\nrun 0\n"
    table = lammps(text).thermo()[-1]
    assert table["c_H[1]"][0] == table["c_H[2]"][0] == 0.0


@pytest.mark.parametrize("options", ["", "density continuity"])
def test_strains_have_no_pressure(lammps, options):
    """The density of a body far from the fluid is that of its first shape."""
    text = alone(lammps, "1.0 5.0 0.7 1.8 2.5", options) + "displace_atoms fluid move 0 5.8 0\nset group fluid y 7.5\n"
    text += "compute rho all property/atom rho\ncompute R body reduce sum c_rho\nthermo_style custom step c_R\n" + FULL
    first, then = lammps(text + "velocity all set 0 0 0\nrun 0\ndisplace_atoms body ramp x -0.2 0.3 x -1 1\nrun 0\n").thermo()[-2:]
    assert first["c_R"][0] > 2.0 and first["c_R"][0] == pytest.approx(then["c_R"][0], rel=1e-13)


def test_free_fall(lammps):
    """Fluid and body under the same gravity: nothing moves relatively."""
    text = drop(boundary="p p p", step=0.004).replace("displace_atoms fluid random 0.1 0.1 0.0 5\n", "").replace(
        "fix 1 fluid", "velocity all set 0 0 0\nvariable r equal vcm(body,y)-vcm(fluid,y)\nthermo_style custom step v_r\nfix 1 fluid")
    table = lammps(text + "fix g all gravity 1.0 vector 0 -1 0\nthermo_style custom step v_r\nthermo 100\nrun 500\n").thermo()[-1]
    assert np.abs(table["v_r"]).max() < 1e-12


def test_held_particles(lammps):
    """*fix setforce* holds them."""
    text = drop().replace("fix 1 fluid", "group held id <= 75\ngroup hold intersect held body\nvelocity hold set 0 0 0\nfix 1 fluid")
    lammps(text + "fix 4 hold setforce 0 0 0\ndump D hold custom 50 out.dump id xu yu zu vx vy vz fx fy fz\ndump_modify D sort id format float %.17g\nrun 100\n")
    frames = lammps.frames("out.dump")
    assert len(frames[0]["x"]) > 2 and np.abs(frames[-1]["x"] - frames[0]["x"]).max() == 0.0


def filament(kt, steps, n=8, size=14):
    """A straight chain in a fluctuating fluid, its bonds and angles harmonic; twice the energy of each kind over kT and its number of modes.

    The pressure of the fluid changes the mean length of a bond: the energy of the mean length is none of the fluctuations."""
    hardness = 1000.0 * kt
    first = size // 2 * size + 4
    row = range(first, first + n)
    angles = "".join(f"create_bonds single/angle 1 {k} {k + 1} {k + 2}\n" for k in row[:-2])
    return (f"units lj\ndimension 2\nboundary p p p\natom_style hybrid sph/bulk angle\nlattice sq 1.0 origin 0.5 0.5 0\n"
            f"region box block 0 {size} 0 {size} -0.5 0.5\n"
            "create_box 2 box bond/types 1 angle/types 1 extra/bond/per/atom 2 extra/angle/per/atom 3 extra/special/per/atom 6\ncreate_atoms 1 box\n"
            f"group body id {row[0]}:{row[-1]}\nset group body type 2\nset group all mass 1.0\ngroup fluid type 1\n"
            f"bond_style harmonic\nbond_coeff 1 {hardness} 1.0\nangle_style harmonic\nangle_coeff 1 {100.0 * kt} 180.0\n"
            f"pair_style zero 2.0\npair_coeff * *\nspecial_bonds lj 0 1 1\ncreate_bonds many body body 1 0.9 1.1\n{angles}special_bonds lj 1 1 1\n"
            f"displace_atoms fluid random 0.1 0.1 0 5\nvelocity all create {kt} 4 loop geom\nneighbor 0.5 bin\n"
            f"pair_style sph/bulk temp {kt} 7\npair_coeff * * 1.0 10.0 0.3 0.8 3.0\nfix 1 fluid sph/bulk\n{ELASTIC}timestep 0.005\n"
            f"compute B all pe bond\nvariable b equal c_B*{2 / (kt * (n - 1))}\ncompute A all pe angle\nvariable a equal c_A*{2 / (kt * (n - 2))}\n"
            f"compute K body ke\nvariable k equal c_K*{1 / (kt * n * (1 - 1 / size**2))}\ncompute each body bond/local dist\ncompute r body reduce ave c_each inputs local\n"
            "thermo_style custom step v_b v_a v_k c_r\nthermo_modify norm no format float %.10g\nthermo 20\n"
            f"run 2000\nrun {steps}\n")


@pytest.mark.long
def test_modes_of_a_filament(lammps):
    """Bonds, angles, and velocities each have kT/2, within three standard errors.  In two dimensions this is exact for harmonic bonds and angles."""
    table = lammps(filament(0.1, 160000)).thermo()[-1]
    table["v_b"] -= 2 * 1000.0 * (table["c_r"][1:].mean() - 1.0) ** 2
    print(f"mean length of a bond {table['c_r'][1:].mean():.5f}")
    for name in ("v_b", "v_a", "v_k"):
        blocks = np.array(np.split(table[name][1:], 40)).mean(axis=1)
        mean, error = blocks.mean(), blocks.std(ddof=1) / np.sqrt(40)
        print(f"{name}: {mean:.4f} +- {error:.4f}")
        assert error < 0.02 and abs(mean - 1.0) < 3 * error, name


@pytest.mark.parametrize("change, words", [
    (("move elastic", "move elastic velocity 1 0 0"), "move elastic cannot be used with velocity"),
    (("move elastic", "move elastic contact 0.5 0.3"), "contact requires move rigid"),
    (("move elastic", "move elastic gravity 0 -1 0"), "cannot be used with gravity"),
    (("move elastic", "move elastic body molecule"), "requires molecule IDs"),
    (("pair_style sph/bulk ", "pair_style sph/bulk shear morris"), "shear morris or espanol"),
    (("fix 2 body nve\n", ""), "must be moved by one fix nve"),
    (("fix 2 body nve\n", "fix 2 body nve\nfix 4 body nve\n"), "must be moved by one fix nve"),
    (("fix 2 body nve\n", "fix 2 body rigid single\n"), "is moved by fix 2 rigid, not by fix nve"),
    (("run 0", "minimize 0 0 1 1"), "a minimization"),
    (("fix 1 fluid sph/bulk", "fix 1 fluid sph/bulk viscous rkl2"), "viscous rkl2 or implicit"),
    (("fix 1 fluid sph/bulk", "fix 1 fluid sph/bulk viscous implicit"), "viscous rkl2 or implicit"),
])
def test_errors(lammps, change, words):
    text = alone(lammps, "1.0 5.0 0.7 1.8 2.5") + "run 0\n"
    for old, new in zip(change[::2], change[1::2]):
        assert old in text
        text = text.replace(old, new)
    result = lammps(text, check=False)
    assert result.code and words in result.error, result.error
