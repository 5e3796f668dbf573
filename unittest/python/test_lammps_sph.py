"""Against LAMMPS's own sph/taitwater/morris and sph/heatconduction, which take the density from us."""

import numpy as np
import pytest

from helpers import INTEGRATE, disordered, dump, fluid, header, lattice, relative

MASS, RHO0, C0 = 1.25, 1.2, 10.0


def ours_and_theirs(lammps, dim, ours, theirs, ranks=1, newton="on", particles=None):
    """One disordered set under sph/bulk and, with the density that it found, under a pair style of LAMMPS.

    ours = (options of pair_style sph/bulk, mu, keywords of pair_coeff); theirs = pair_style line, pair_coeff line without the types.
    """
    cells, support = {2: (14, 3.0), 3: (7, 2.5)}[dim]
    particles = particles or disordered(dim, cells)
    particles.mass[:] = MASS
    particles.write(lammps.path("box.data"))
    options, mu, *keywords = ours
    lammps(header(dim, newton=newton) + "read_data box.data\n"
           + fluid(dim, options, rho0=RHO0, c0=C0, mu=mu, kappa="intrinsic", support=support, keywords=" ".join(keywords))
           + INTEGRATE + dump("ours.dump") + "run 0\n", ranks=ranks)
    ours = lammps.frame("ours.dump")

    text = lammps.path("box.data").read_text()
    atoms = [f"{i:.0f} 1 {rho} {esph} 1.0 " + " ".join(map(repr, x))
             for i, rho, esph, x in zip(ours["id"], ours["rho"].tolist(), ours["esph"].tolist(), particles.x.tolist())]
    head, tail = text.split("Atoms # sph/bulk")[0], text[text.index("Velocities"):]
    lammps.path("sph.data").write_text(head + "Atoms # sph\n\n" + "\n".join(atoms) + "\n\n" + tail)
    pair_style, pair_coeff = theirs
    lammps(header(dim, style="sph", newton=newton) + f"read_data sph.data\nmass 1 {MASS}\n"
           f"{pair_style}\npair_coeff * * {pair_coeff} {support}\nfix F all sph\n"
           "run 0\n"  # LAMMPS's fix sets vest after the ghosts have got theirs: only a second run starts with it
           "compute F all property/atom rho drho desph\n"
           "dump D all custom 1 theirs.dump id vx vy vz fx fy fz c_F[*]\n"
           "dump_modify D sort id format float %.17g colname 8 rho colname 9 drho colname 10 desph\n"
           "run 0\n", ranks=ranks)
    theirs = lammps.frame("theirs.dump")
    assert relative(theirs["rho"] - ours["rho"], ours["rho"]) < 1e-15
    return ours, theirs


@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "off")])
@pytest.mark.parametrize("dim", [2, 3])
def test_forces_of_taitwater_morris(lammps, dim, ranks, newton):
    """Lucy kernel, Tait equation of state, Morris viscosity, no bulk term: the same forces and heating."""
    ours, theirs = ours_and_theirs(
        lammps, dim, ("kernel lucy eos tait shear morris bulk none", 0.6),
        ("pair_style sph/taitwater/morris", f"{RHO0} {C0} 0.6"), ranks, newton)
    assert relative(theirs["f"] - ours["f"], ours["f"]) < 1e-12
    assert relative(theirs["drho"] - ours["mass"] * ours["dnumden"], theirs["drho"]) < 1e-12
    # each of a pair gets half of the pair's work there, its own p V^2 cdot here; the total is the same
    assert abs(theirs["desph"].sum() - ours["desph"].sum()) < 1e-12 * abs(ours["desph"]).sum()


@pytest.mark.parametrize("dim", [2, 3])
def test_conduction(lammps, dim):
    """One material on a lattice, k = D rho cv: heat flows as energy diffuses with sph/heatconduction."""
    particles = lattice(dim, {2: 14, 3: 7}[dim])
    particles.esph[:] = np.random.default_rng(5).uniform(1.0, 2.0, len(particles))
    ours, theirs = ours_and_theirs(lammps, dim, ("kernel lucy eos ideal shear morris bulk none", 0.6, "cv 2.5 conductivity 0.3"),
                                   ("pair_style sph/heatconduction", "1.0"), particles=particles)
    expected = 0.3 / (ours["rho"] * 2.5) * theirs["desph"]
    assert relative(ours["desph"] - expected, expected) < 1e-12
