"""Against LAMMPS's own sph/taitwater/morris, which takes the density from us."""

import numpy as np
import pytest

from helpers import INTEGRATE, disordered, dump, fluid, header, relative


@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "off")])
@pytest.mark.parametrize("dim, cells, support", [(2, 14, 3.0), (3, 7, 2.5)])
def test_forces_of_taitwater_morris(lammps, dim, cells, support, ranks, newton):
    """Lucy kernel, Tait equation of state, Morris viscosity, no bulk term: the same forces and heating."""
    particles = disordered(dim, cells)
    particles.mass[:] = 1.25
    particles.write(lammps.path("box.data"))
    lammps(header(dim, newton=newton) + "read_data box.data\n"
           + fluid(dim, "kernel lucy eos tait shear morris bulk none", rho0=1.2, mu=0.6, kappa="intrinsic",
                   support=support) + INTEGRATE + dump("ours.dump") + "run 0\n", ranks=ranks)
    ours = lammps.frame("ours.dump")

    text = lammps.path("box.data").read_text()
    atoms = [f"{i:.0f} 1 {rho!r} {esph!r} 1.0 " + " ".join(map(repr, x))
             for i, rho, esph, x in zip(ours["id"], ours["rho"].tolist(), ours["esph"].tolist(), particles.x.tolist())]
    head, tail = text.split("Atoms # sph/bulk")[0], text[text.index("Velocities"):]
    lammps.path("sph.data").write_text(head + "Atoms # sph\n\n" + "\n".join(atoms) + "\n\n" + tail)
    lammps(header(dim, style="sph", newton=newton) + "read_data sph.data\nmass 1 1.25\n"
           f"pair_style sph/taitwater/morris\npair_coeff * * 1.2 10.0 0.6 {support}\nfix F all sph\n"
           "run 0\n"  # LAMMPS's fix sets vest after the ghosts have got theirs: only a second run starts with it
           "compute F all property/atom rho drho desph\n"
           "dump D all custom 1 theirs.dump id fx fy fz c_F[*]\n"
           "dump_modify D sort id format float %.17g colname 5 rho colname 6 drho colname 7 desph\n"
           "run 0\n", ranks=ranks)
    theirs = lammps.frame("theirs.dump")
    assert relative(theirs["rho"] - ours["rho"], ours["rho"]) < 1e-15
    assert relative(theirs["f"] - ours["f"], ours["f"]) < 1e-12
    assert relative(theirs["drho"] - ours["mass"] * ours["dnumden"], theirs["drho"]) < 1e-12
    # each of a pair gets half of the pair's work there, its own p V^2 cdot here; the total is the same
    assert abs(theirs["desph"].sum() - ours["desph"].sum()) < 1e-12 * np.abs(ours["desph"]).sum()
