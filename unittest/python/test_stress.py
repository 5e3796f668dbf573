"""All nine components of the stress per atom: it is not symmetric where forces are not central or particles spin."""

import numpy as np
import pytest

from helpers import INTEGRATE, disordered, drop, fluid, free, header, lattice, relative
from test_micropolar import STYLE, integrate, two_fluids, write
from test_virial import lattice_sums

NINE = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2), (1, 0), (2, 0), (2, 1))  # first the position, then the force
MIRROR = [0, 1, 2, 6, 7, 8]  # of the components of a symmetric tensor
OUTPUT = ("compute P all pressure NULL virial\ncompute S all stress/atom NULL virial\n"
          "compute C all centroid/stress/atom NULL virial\n"
          "thermo_style custom step vol c_P[*]\nthermo_modify norm no format float %.17g\n"
          "dump D all custom 1 out.dump id xu yu zu vx vy vz fx fy fz {} c_S[*] c_C[*]\n"
          "dump_modify D sort id format float %.17g\n")


def stresses(lammps, text, ranks=1, steps=0, columns=""):
    """(pressure tensor times volume, minus the six and minus the nine components per atom, the snapshot) at step 0."""
    table = lammps(text + OUTPUT.format(columns) + f"run {steps}\n", ranks=ranks).thermo()[0]
    frame = lammps.frames("out.dump")[0]
    named = {"S": 6, "C": 9}
    six, nine = (-np.column_stack([frame.columns[f"c_{name}[{k}]"] for k in range(1, n + 1)]) for name, n in named.items())
    pressure = np.array([table[f"c_P[{k}]"][0] for k in range(1, 7)]) * table["Volume"][0]
    return pressure, six, nine, frame


def bulk_input(lammps, particles, shear="mg", **options):
    particles.write(lammps.path("box.data"))
    return (header(particles.dim, **options) + "read_data box.data\n" + fluid(particles.dim, f"shear {shear}") + INTEGRATE)


def micropolar_input(lammps, particles, omega=None, overlay=False, **options):
    write(particles, lammps.path("box.data"), omega=omega)
    pair = two_fluids(particles.dim)
    if overlay:
        pair = pair.replace(f"pair_style {STYLE}", f"pair_style hybrid/overlay zero 1.0 {STYLE}")
        pair = pair.replace("pb 1\n", "pb 1\npair_coeff * * zero\n", 1)
        for types in ("1 1", "2 2", "1 2"):
            pair = pair.replace(f"pair_coeff {types}", f"pair_coeff {types} {STYLE}")
    return header(particles.dim, style=STYLE, **options) + "read_data box.data\n" + pair + integrate()


@pytest.mark.parametrize("dim, cells", [(2, 12), (3, 6)])
@pytest.mark.parametrize("style", ["mg", "mg/fr bulk volume", "mg/fr2", "morris", "espanol", STYLE, "hybrid/overlay"])
def test_nine_components_against_six(lammps, dim, cells, style):
    """On one rank, two and four, with newton on and off: one tensor, and what LAMMPS computes of it by other ways."""
    particles = disordered(dim, cells, ntypes=2 if "/" in style and "mg" not in style else 1)
    results = []
    for ranks, newton in ((1, "on"), (1, "off"), (2, "on"), (4, "off")):
        if "mg" in style or style in ("morris", "espanol"):
            text = bulk_input(lammps, particles, style, newton=newton)
        else:
            text = micropolar_input(lammps, particles, overlay="hybrid" in style, newton=newton)
        pressure, six, nine, _ = stresses(lammps, text, ranks)
        assert relative(nine[:, :6] - six, nine) < 1e-14
        assert relative(nine.sum(0)[:6] - pressure, pressure) < 1e-12
        results.append(nine)
    for nine in results[1:]:
        assert relative(nine - results[0], nine) < 1e-12
    asymmetry = relative(nine[:, :6] - nine[:, MIRROR], nine)
    if "mg" in style:
        assert asymmetry < 1e-14
    else:
        assert asymmetry > 1e-3


@pytest.mark.parametrize("dim, radius", [(2, 6.0), (3, 3.5)])
@pytest.mark.parametrize("style", ["morris", STYLE])
def test_isolated_drop(lammps, dim, radius, style):
    """Sum over particles of position times force, for each of the nine components."""
    particles = drop(dim, radius)
    if style == STYLE:
        particles.type[::2] = 2
        text = micropolar_input(lammps, particles, boundary=free(dim))
    else:
        text = bulk_input(lammps, particles, style, boundary=free(dim))
    _, _, nine, frame = stresses(lammps, text)
    expected = np.array([(frame["x"][:, a] * frame["f"][:, b]).sum() for a, b in NINE])
    assert relative(nine.sum(0) - expected, expected) < 1e-12


@pytest.mark.parametrize("dim, cells", [(2, 12), (3, 6)])
def test_antisymmetric_part_of_a_micropolar_flow(lammps, dim, cells):
    """Shear of a fluid whose spin is not half its vorticity: stress_ab - stress_ba = -2 mu_r (2 Omega - curl u)_c, the torque."""
    support, mu, mu_r, gamma = 2.9, 0.5, 0.3, 0.04
    gradient = np.zeros((3, 3))  # du_a / dx_b
    gradient[0, 1] = 0.3
    omega = np.array([0.0, 0.0, 0.7])
    deform = "xy erate 0.3"
    if dim == 3:
        gradient[1, 2] = -0.2
        omega[:2] = 0.5, -0.4
        deform += " yz erate -0.2"
    particles = lattice(dim, cells)
    particles.v = particles.x @ gradient.T
    write(particles, lammps.path("box.data"), omega=np.broadcast_to(omega, particles.x.shape))
    text = (header(dim, style=STYLE) + "read_data box.data\nchange_box all triclinic\n"
            f"pair_style {STYLE}\npair_coeff * * 1.0 10.0 {mu} 1.0 {mu_r} {gamma} {-gamma if dim == 2 else gamma} {support}\n"
            + integrate() + f"comm_modify vel yes\nfix D all deform 1 {deform} remap v\n")
    _, _, nine, frame = stresses(lammps, text, steps=1, columns="tqx tqy tqz")  # at `run 0` LAMMPS knows no rate

    volume, moment, _, _ = lattice_sums(dim, support)
    curl = np.array([gradient[2, 1] - gradient[1, 2], gradient[0, 2] - gradient[2, 0], gradient[1, 0] - gradient[0, 1]])
    continuum = -2.0 * mu_r * (2.0 * omega - curl) * volume
    # P = -stress: (yz - zy, zx - xz, xy - yx)
    antisymmetric = -(nine[:, [5, 7, 3]] - nine[:, [8, 4, 6]])
    assert relative(antisymmetric - continuum * moment[0, 0] / volume, continuum) < 1e-11
    assert moment[0, 0] == pytest.approx(volume, rel=0.02)
    torque = np.column_stack([frame.columns[f"tq{a}"] for a in "xyz"])
    assert relative(antisymmetric - torque, torque) < 1e-11
    assert relative(torque - continuum, continuum) < 0.02
