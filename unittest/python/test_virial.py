"""Pressure: global against per-atom, against sums over positions, and against the equation of state."""

import numpy as np
import pytest

from helpers import INTEGRATE, disordered, drop, dump, fluid, free, header, lattice, relative

TENSOR = ("Pxx", "Pyy", "Pzz", "Pxy", "Pxz", "Pyz")
THERMO = ("compute P all pressure NULL virial\ncompute S all stress/atom NULL virial\n"
          "compute T all reduce sum c_S[*]\n"
          "thermo_style custom step vol c_P c_P[*] c_T[*]\nthermo_modify norm no format float %.17g\n")
MODELS = {"mg": "shear mg bulk density", "mg/fr": "shear mg/fr bulk volume eos tait", "mg/fr2": "shear mg/fr2",
          "morris": "shear morris bulk density"}


def pressure(lammps, particles, model, ranks=1, extra="", steps=0, **head):
    """(scalar pressure, pressure tensor, the same from the sum of per-atom stresses) times the volume, at step 0."""
    particles.write(lammps.path("box.data"))
    result = lammps(header(particles.dim, **head) + "read_data box.data\n" + model + extra + INTEGRATE + THERMO
                    + dump("out.dump") + f"run {steps}\n", ranks=ranks)
    table = {name: values[0] for name, values in result.thermo()[0].items()}
    tensor = np.array([table[f"c_P[{k}]"] for k in range(1, 7)]) * table["Volume"]
    atoms = -np.array([table[f"c_T[{k}]"] for k in range(1, 7)])
    return table["c_P"] * table["Volume"], tensor, atoms


@pytest.mark.parametrize("dim, tilt", [(2, None), (3, None), (3, (1.0, -2.0, 1.5))])
@pytest.mark.parametrize("model", MODELS)
def test_global_and_per_atom_virial_agree(lammps, dim, tilt, model):
    """On one rank and two, with newton on and off."""
    particles = disordered(dim, {2: 12, 3: 6}[dim], tilt=tilt)
    results = [pressure(lammps, particles, fluid(dim, MODELS[model]), ranks, newton=newton)
               for ranks, newton in ((1, "on"), (1, "off"), (2, "on"), (2, "off"))]
    scalar, tensor, _ = results[0]
    assert scalar == pytest.approx(tensor[:dim].sum() / dim, rel=1e-12)
    for _, other, atoms in results:
        assert relative(other - tensor, tensor) < 1e-12
        assert relative(atoms - tensor, tensor) < 1e-12


@pytest.mark.parametrize("dim, radius", [(2, 6.0), (3, 3.5)])
@pytest.mark.parametrize("extra", ["", "pair_modify nofdotr\n"])
def test_virial_of_an_isolated_drop(lammps, dim, radius, extra):
    """The sum over particles of position times force."""
    particles = drop(dim, radius)
    _, tensor, atoms = pressure(lammps, particles, fluid(dim), extra=extra, boundary=free(dim))
    frame = lammps.frame("out.dump")
    x, f = frame["x"], frame["f"]
    expected = np.array([(x[:, a] * f[:, b]).sum() for a, b in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))])
    assert relative(tensor - expected, expected) < 1e-12
    assert relative(atoms - expected, expected) < 1e-12


def wendland_c2(dim, support, r):
    """W and F = -W'/r of (1 - q)^4 (1 + 4 q)."""
    norm = {1: 3 / 2, 2: 7 / np.pi, 3: 21 / (2 * np.pi)}[dim] / support**dim
    q = np.minimum(r / support, 1.0)
    return norm * (1 - q)**4 * (1 + 4 * q), 20 * norm * (1 - q)**3 / support**2


def lattice_sums(dim, support):
    """Number density and V^2 sum F r_a r_b of the square or cubic lattice of unit spacing."""
    reach = np.arange(-int(support) - 1, int(support) + 2)
    r = np.stack(np.meshgrid(*[reach] * dim, indexing="ij"), axis=-1).reshape(-1, dim).astype(float)
    weight, factor = wendland_c2(dim, support, np.linalg.norm(r, axis=1))
    volume = 1.0 / weight.sum()
    return volume, volume**2 * np.einsum("k,ka,kb->ab", factor, r, r), r, factor


@pytest.mark.parametrize("dim, cells, support", [(2, 12, 3.0), (2, 16, 4.0), (3, 8, 3.0)])
@pytest.mark.parametrize("pb", [0.0, 5.0])
def test_pressure_of_a_lattice_at_rest(lammps, dim, cells, support, pb):
    """The pressure of the equation of state times V sum F r^2 / n, which is close to one."""
    particles = lattice(dim, cells)
    scalar, tensor, _ = pressure(lammps, particles, fluid(dim, rho0=0.9, support=support, keywords=f"pb {pb}"))
    volume, moment, _, _ = lattice_sums(dim, support)
    eos = 10.0**2 * (1.0 / volume - 0.9) + pb
    expected = eos * moment[0, 0]
    assert scalar / len(particles) == pytest.approx(expected, rel=1e-12)
    assert tensor[:dim] / len(particles) == pytest.approx(expected, rel=1e-12)
    assert np.abs(tensor[3:]).max() < 1e-12 * abs(scalar)
    assert expected == pytest.approx(eos, rel=0.02)


@pytest.mark.parametrize("shear", ["mg", "morris", "espanol"])
@pytest.mark.parametrize("dim, cells", [(2, 12), (3, 6)])
def test_viscous_stress_of_a_uniform_flow(lammps, dim, cells, shear):
    """Shear and dilation, fed through fix deform: the lattice sums exactly, the Newtonian fluid approximately."""
    support, mu, kappa, rate, growth = 2.9, 0.5, 3.0, 0.3, 0.2
    gradient = np.zeros((dim, dim))
    gradient[0, 1] = rate
    gradient += growth * np.eye(dim)
    particles = lattice(dim, cells)
    particles.tilt = (0.0, 0.0, 0.0)
    particles.v[:, :dim] = particles.x[:, :dim] @ gradient.T
    stretch = " ".join(f"{axis} erate {growth}" for axis in "xyz"[:dim])
    deform = f"comm_modify vel yes\nfix D all deform 1 {stretch} xy erate {rate} remap v\n"
    _, tensor, atoms = pressure(lammps, particles, fluid(dim, f"shear {shear}", support=support, mu=mu, kappa=kappa,
                                                         rho0=1.0), extra=deform, steps=1)  # at `run 0` LAMMPS knows no rate
    assert relative(tensor - atoms, tensor) < 1e-12

    volume, moment, r, factor = lattice_sums(dim, support)
    frame = lammps.frames("out.dump")[0]
    eos = 10.0**2 * (1.0 / volume - 1.0)
    flow = r @ gradient.T
    along = (r * flow).sum(axis=1)
    distance2 = np.maximum((r**2).sum(axis=1), 1e-300)
    central = (factor * along / distance2)[:, None] * r
    laplacian = factor[:, None] * flow
    if shear == "mg":
        pair = 2 * (dim + 2) * mu * volume**2 * central
        intrinsic = (1 + 2 / dim) * mu
    elif shear == "morris":
        pair = 2 * mu * volume**2 * laplacian
        intrinsic = (2 / dim - 1) * mu
    else:
        pair = 2 * (dim + 2) / (dim + 3) * mu * volume**2 * (laplacian + central)
        intrinsic = (2 / dim - (dim + 1) / (dim + 3)) * mu
    zeta = kappa - intrinsic
    stress = 0.5 * r.T @ pair
    rate_of_density = -volume * (factor * along).sum()  # cdot / c
    np.testing.assert_allclose(frame["dnumden"] * frame["vol"], rate_of_density, rtol=1e-12)
    expected = (eos + zeta * rate_of_density) * moment - stress
    measured = np.zeros((3, 3))
    measured[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]] = tensor / len(particles)
    entries = [(a, a) for a in range(dim)] + ([(0, 1)] if shear == "mg" else [])  # the other stresses are not symmetric
    for a, b in entries:
        assert measured[a, b] == pytest.approx(expected[a, b], rel=1e-11), (a, b)
    # no force anywhere: the ghosts beyond the faces move with the flow
    assert np.abs(frame["f"]).max() < 1e-11 * np.abs(pair).max() * len(r)

    viscous = measured[:dim, :dim] - eos * moment
    if shear == "mg":
        assert viscous[0, 1] == pytest.approx(-mu * rate, rel=0.15)
    assert np.trace(viscous) / dim == pytest.approx(-kappa * dim * growth, rel=0.1)
