"""How particles move: rest, rigid motion, walls, deforming boxes, runs in pieces."""

import numpy as np
import pytest

from helpers import INTEGRATE, disordered, dump, fluid, header, lattice, relative


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("dim, cells", [(1, 40), (2, 12), (3, 7)])
def test_a_lattice_at_rest_stays_at_rest(lammps, dim, cells, ranks):
    lattice(dim, cells).write(lammps.path("box.data"))
    lammps(header(dim) + "read_data box.data\n" + fluid(dim, keywords="pb 5") + INTEGRATE + dump("out.dump", 200)
           + "run 200\n", ranks=ranks)
    first, last = lammps.frames("out.dump")
    assert np.abs(last["x"] - first["x"]).max() < 1e-12
    assert np.abs(last["v"]).max() < 1e-12


def test_uniform_motion_changes_nothing(lammps):
    """A boost of all particles shifts the trajectory and no more."""
    moves, text = [], header(2) + "read_data {0}.data\n" + fluid(2) + INTEGRATE + dump("{0}.dump", 100) + "run 100\n"
    for name, boost in (("rest", 0.0), ("boosted", 2.0)):
        particles = disordered(2, 12)
        particles.v[:, 0] += boost
        particles.write(lammps.path(f"{name}.data"))
        lammps(text.format(name))
        last = lammps.frame(f"{name}.dump")
        moves.append(last["x"] - [boost * 0.5, 0.0, 0.0])
    assert np.abs(moves[1] - moves[0]).max() < 1e-10


def channel(cells=(10, 14)):
    """Fluid (type 1) between walls (type 2) of three layers each."""
    particles = lattice(2, cells)
    layers = np.minimum(particles.x[:, 1], cells[1] - particles.x[:, 1])
    particles.type[layers < 3.0] = 2
    return particles


GROUPS = "group FLUID type 1\ngroup WALL type 2\n"


def test_particles_without_integrator_are_a_wall(lammps):
    """They stay where they are, carry their force, and the fluid feels them."""
    particles = channel()
    wall = particles.type == 2
    random = np.random.default_rng(3)
    particles.v[~wall, :2] = random.normal(0.0, 0.5, (np.count_nonzero(~wall), 2))
    particles.write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\n" + fluid(2) + GROUPS + "fix F FLUID sph/bulk\ntimestep 0.005\n"
           + dump("out.dump", 400) + "run 400\n")
    first, last = lammps.frames("out.dump")
    assert (last["x"][wall] == first["x"][wall]).all()
    assert (last["v"][wall] == 0.0).all() and (last["vest"][wall] == 0.0).all()
    assert np.abs(last["f"].sum(0)).max() < 1e-12 * np.abs(last["f"]).sum()
    y = last["x"][~wall, 1]
    assert 2.5 < y.min() and y.max() < 11.5, "fluid went through the wall"
    assert np.abs(last["v"][~wall]).max() < 0.9 * np.abs(first["v"]).max()


def test_the_wall_carries_the_driving_force(lammps):
    """Steady flow in a channel: on average the walls take up the body force."""
    channel().write(lammps.path("box.data"))
    push = 0.02
    lammps(header(2) + "read_data box.data\n" + fluid(2, mu=5.0, kappa=10.0) + GROUPS
           + f"fix F FLUID sph/bulk\ntimestep 0.005\nfix G FLUID addforce {push} 0.0 0.0\nrun 3000\n"
           + dump("out.dump", 20) + "run 2000\n")
    frames = lammps.frames("out.dump")
    wall = frames[0]["type"] == 2
    driving = push * np.count_nonzero(~wall)
    drag = np.array([frame["f"][wall, 0].sum() for frame in frames])
    total = np.array([frame["f"][:, 0].sum() for frame in frames])
    print(f"drag / driving force - 1 = {drag.mean() / driving - 1:.2e}, spread {drag.std() / driving:.2e}")
    np.testing.assert_allclose(total, driving, rtol=1e-11)
    assert drag.mean() == pytest.approx(driving, rel=1e-2)
    assert frames[-1]["v"][~wall, 0].min() > 0.0


@pytest.mark.parametrize("ranks", [1, 2])
def test_fix_move_moves_a_wall_that_the_fluid_feels(lammps, ranks):
    """A wall moved by fix move and a fluid that moves along exert no force on each other."""
    particles = channel()
    particles.v[:, 0] = 0.7
    particles.write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\n" + fluid(2) + GROUPS + "fix F FLUID sph/bulk\ntimestep 0.005\n"
           "fix M WALL move linear 0.7 0.0 0.0\n" + dump("out.dump", 200) + "run 200\n", ranks=ranks)
    first, last = lammps.frames("out.dump")
    assert np.abs(last["x"] - first["x"] - [0.7, 0.0, 0.0]).max() < 1e-11
    assert np.abs(last["f"]).max() < 1e-10


def test_fix_move_drags_the_fluid(lammps):
    """A wall that starts to move only with the run, and swings, pulls the fluid with its present velocity."""
    particles = channel()
    particles.write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\n" + fluid(2, mu=2.0, kappa=4.0) + GROUPS
           + "fix F FLUID sph/bulk\ntimestep 0.005\nfix M WALL move wiggle 0.5 0.0 0.0 4.0\n"
           + dump("out.dump", 50) + "run 200\n")
    for frame in lammps.frames("out.dump")[1:]:
        wall = frame["type"] == 2
        time = 0.005 * frame.step
        expected = 0.5 * (2 * np.pi / 4.0) * np.cos(2 * np.pi * time / 4.0)
        np.testing.assert_allclose(frame["v"][wall, 0], expected, atol=1e-12)
        np.testing.assert_allclose(frame["vest"][wall, 0], expected, atol=1e-12)
    assert np.abs(lammps.frames("out.dump")[1]["v"][~wall, 0]).max() > 0.05


@pytest.mark.parametrize("ranks, newton, style", [(1, "on", "brick"), (4, "on", "brick"), (4, "off", "brick"),
                                                  (4, "on", "tiled")])
def test_shear_flow_by_fix_deform(lammps, ranks, newton, style):
    """A lattice in uniform shear is free of force while the box deforms and particles cross its faces."""
    rate = 0.2
    particles = lattice(2, 12)
    particles.tilt = (0.0, 0.0, 0.0)
    particles.v[:, 0] = rate * particles.x[:, 1]
    particles.v[:, 1] = 0.0
    particles.write(lammps.path("box.data"))
    balance = "balance 1.0 rcb\n" if style == "tiled" else ""
    lammps(header(2, newton=newton) + f"comm_style {style}\ncomm_modify vel yes\nread_data box.data\n" + balance
           + fluid(2) + "neigh_modify every 1 delay 0 check no\n" + INTEGRATE
           + f"fix D all deform 1 xy erate {rate} remap v\n" + dump("out.dump", 50) + "run 300\n", ranks=ranks)
    frames = lammps.frames("out.dump")
    assert np.abs(frames[0]["f"]).max() < 1e-12
    # LAMMPS moves the box after the forces, so that ghosts lag by a step: an error of order dt
    for frame in frames[1:]:
        assert np.abs(frame["f"]).max() < 3e-4
        y = particles.x[:, 1]
        crossings = np.round((frame["v"][:, 0] - rate * y) / (rate * 12))
        np.testing.assert_allclose(frame["v"][:, 0], rate * (y + 12 * crossings), atol=2e-4)
        np.testing.assert_allclose(frame["vest"], frame["v"], atol=1e-6)
        np.testing.assert_allclose(frame["y"], y, atol=1e-4)
    assert frames[-1].step * 0.005 * rate * 12 > 1.0, "no particle crosses a face"


def test_box_that_deforms_without_remapping_velocities(lammps):
    """fix deform remap x moves the particles itself; no ghost velocities are needed."""
    particles = disordered(2, 12)
    particles.write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\n" + fluid(2) + INTEGRATE + "fix D all deform 1 x erate -0.05 remap x\n"
           + dump("out.dump", 100) + "run 100\n")
    first, last = lammps.frames("out.dump")
    assert (1 / last["vol"]).mean() > 1.015 * (1 / first["vol"]).mean()


@pytest.mark.parametrize("deform, most", [("", 1e-13), ("fix D all deform 1 xy erate 0.2 remap v\n", 1e-4)], ids=["", "deform"])
def test_a_run_in_two_pieces(lammps, deform, most):
    """A new run begins with the extrapolated velocity of the last step; in a box that shears, with ghosts that do not lag."""
    disordered(2, 12, tilt=(0.0, 0.0, 0.0)).write(lammps.path("box.data"))
    places = []
    for runs in ("run 100\n", "run 50\nrun 50\n"):
        lammps(header(2) + "comm_modify vel yes\nread_data box.data\n" + fluid(2) + INTEGRATE + deform + dump("out.dump", 100) + runs)
        places.append(lammps.frame("out.dump")["x"])
    assert np.abs(places[1] - places[0]).max() < most


KERNELS = ("wendland/c2", "wendland/c4", "wendland/c6", "cubic", "quintic", "lucy")


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("kernel", KERNELS)
@pytest.mark.parametrize("dim, cells", [(1, 30), (2, 10), (3, 6)])
def test_two_particles_at_the_same_point(lammps, dim, cells, kernel, newton):
    """They exert no force on each other: each feels what the rest does, and nothing becomes NaN."""
    particles = disordered(dim, cells, jitter=0.0, speed=0.0)
    particles.mass[:], particles.esph[:] = 1.0, 5.0
    particles.x[1] = particles.x[0]
    particles.v[1, 0] = 0.5
    particles.write(lammps.path("box.data"))
    result = lammps(header(dim, newton=newton) + "read_data box.data\n" + fluid(dim, f"kernel {kernel}", mu=0.0,
                    kappa=0.0) + INTEGRATE + dump("out.dump", 20) + "thermo_style custom step pe press\nrun 20\n")
    first, last = lammps.frames("out.dump")
    np.testing.assert_allclose(first["f"][0], first["f"][1], atol=1e-12 * np.abs(first["f"]).max())
    assert first["numden"][0] == pytest.approx(first["numden"][1], rel=1e-14)
    for key in ("x", "v", "f", "numden", "desph"):
        assert np.isfinite(first[key]).all() and np.isfinite(last[key]).all()
    assert "nan" not in result.log.lower().split()


@pytest.mark.parametrize("shear", ["mg", "mg/fr", "mg/fr2", "morris", "espanol"])
def test_two_particles_alone_at_the_same_point(lammps, shear):
    """No force although their velocities differ."""
    particles = lattice(2, 10).where(np.arange(100) < 2)
    particles.x[:] = 5.0, 5.0, 0.0
    particles.v[1, 0] = 0.5
    particles.write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\n" + fluid(2, f"shear {shear}", keywords="pb 1") + INTEGRATE
           + dump("out.dump") + "run 0\n")
    frame = lammps.frame("out.dump")
    assert np.isfinite(frame["desph"]).all()
    assert (frame["f"] == 0.0).all()


def test_restarted_neighbor_lists(lammps):
    """A run that rebuilds its neighbour lists at every step moves the particles as one that rarely does."""
    disordered(2, 14, speed=1.0).write(lammps.path("box.data"))
    places = []
    for lists in ("neigh_modify every 1 delay 0 check no\n", "neighbor 0.6 bin\nneigh_modify every 1 delay 0 check yes\n"):
        lammps(header(2) + "read_data box.data\n" + fluid(2) + lists + INTEGRATE + dump("out.dump", 200) + "run 200\n")
        places.append(lammps.frame("out.dump")["x"])
    assert relative(places[1] - places[0], 1.0) < 1e-9
