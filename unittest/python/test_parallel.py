"""The same particles move alike on any number of ranks, any processor grid and any kind of communication."""

import numpy as np
import pytest

from helpers import INTEGRATE, SUPPORT, Lammps, disordered, drop, dump, fluid, header

STEPS = 200
BOUND = 1e-12  # of a spacing

SYSTEMS = {
    "line": disordered(1, 100, ntypes=2),
    "2d": disordered(2, 20, ntypes=2),
    "2d triclinic": disordered(2, 20, ntypes=2, tilt=(7.0, 0.0, 0.0)),
    "3d": disordered(3, (7, 8, 9), ntypes=2),
    "3d triclinic": disordered(3, (8, 8, 8), ntypes=2, tilt=(2.0, -3.0, 1.5)),
}

EVERYWHERE = [
    (2, "", ""),
    (4, "", ""),
    (4, "processors 4 1 1", ""),
    (4, "newton off", ""),
    (4, "comm_style tiled", "balance 1.0 rcb"),
]
ONCE = [
    ("2d", 1, "newton off", ""),
    ("3d", 1, "newton off", ""),
    ("2d", 1, "neighbor 1.1 nsq", ""),
    ("2d", 1, "comm_modify cutoff 7.0\natom_modify sort 0 0.0", ""),
    ("2d", 2, "newton off\ncomm_style tiled", "balance 1.0 rcb"),
    ("2d", 2, "neighbor 0.3 multi\ncomm_modify mode multi", ""),
    ("2d", 2, "", "group A type 1\natom_modify first A"),
    ("2d", 4, "processors 1 4 1", ""),
    ("2d", 4, "", "balance 1.0 shift xy 10 1.05"),
    ("2d", 4, "", "fix B all balance 50 1.0 shift xy 10 1.05"),
    ("2d", 4, "comm_style tiled", "fix B all balance 50 1.0 rcb"),
    ("3d", 4, "processors 1 2 2", ""),
    ("3d", 4, "processors 2 1 2\nnewton off", ""),
    ("3d triclinic", 4, "comm_style tiled\nnewton off", "balance 1.0 rcb"),
]
CASES = [(name, *case) for name in SYSTEMS for case in EVERYWHERE if (name, case[0]) != ("line", 4) or not case[2]]


def trajectory(lammps, particles, ranks=1, before="", after="", options="eos tait"):
    """Positions before and after; type 1 and 2 differ in every property."""
    dim = particles.dim
    particles.write(lammps.path("box.data"))
    support = SUPPORT[dim]
    coeff = (f"pair_coeff 1 1 1.0 10.0 0.5 2.0 {support} gamma 5\n"
             f"pair_coeff 2 2 1.1 12.0 0.2 0.8 {support} pb 2\n"
             "pair_coeff 1 2 mu 0.3\n")
    newton = "off" if "newton off" in before else "on"
    before = before.replace("newton off", "")
    lammps(header(dim, newton=newton) + before + "\nread_data box.data\n" + after + "\n"
           + fluid(dim, options, coeff=coeff) + INTEGRATE + dump("out.dump", STEPS) + f"run {STEPS}\n", ranks=ranks)
    first, last = lammps.frames("out.dump")
    return first["x"], last["x"]


@pytest.fixture(scope="module")
def serial(tmp_path_factory):
    """Serial trajectories of all systems, each computed once."""
    known = {}

    def get(name):
        if name not in known:
            first, last = trajectory(Lammps(tmp_path_factory.mktemp("serial")), SYSTEMS[name])
            assert np.linalg.norm(last - first, axis=1).max() > 0.3, "the set hardly moves"
            known[name] = last
        return known[name]

    return get


@pytest.mark.parametrize("name, ranks, before, after", CASES + ONCE)
def test_same_trajectory(lammps, serial, name, ranks, before, after):
    first, last = trajectory(lammps, SYSTEMS[name], ranks, before, after)
    difference = np.abs(last - serial(name)).max()
    print(f"largest difference {difference:.2e}")
    assert difference < BOUND


@pytest.mark.parametrize("newton", ["", "newton off"])
def test_ideal_gas(lammps, newton):
    """Its pressure follows the internal energy, which has to travel with the particles and to their ghosts."""
    gas = disordered(2, 20, ntypes=2, speed=1.0)
    places = [trajectory(lammps, gas, ranks, before, options="eos ideal")[1]
              for ranks, before in ((1, ""), (4, f"processors 2 2 1\n{newton}"))]
    assert np.abs(places[1] - places[0]).max() < BOUND


@pytest.mark.parametrize("newton", ["", "newton off"])
def test_ranks_without_particles(lammps, newton):
    """A small set in the corner of a large box leaves most ranks empty."""
    corner = drop(2, 4.0)
    corner.x -= [11.0, 11.0, 0.0]
    corner.type[::2] = 2
    places = [trajectory(lammps, corner, ranks, before)[1]
              for ranks, before in ((1, ""), (4, f"processors 4 1 1\n{newton}"))]
    assert np.abs(places[1] - places[0]).max() < BOUND


def test_a_tilt_by_one_box_length_is_the_same_crystal(lammps):
    """A box tilted by its own length has the same periodic images as the orthogonal one."""
    straight = disordered(2, 16, ntypes=2)
    moves = []
    for tilt in (None, (16.0, 0.0, 0.0)):
        straight.tilt = tilt
        first, last = trajectory(lammps, straight, before="box tilt large")
        moves.append(last - first)
    difference = np.abs(moves[1] - moves[0]).max()
    print(f"largest difference {difference:.2e}")
    assert difference < BOUND
