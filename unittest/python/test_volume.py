"""Volumes from reference volumes (volume mass): a jump of the particle size, equality with volume number where all
particles are equal, conservation with unequal ones."""

import numpy as np
import pytest

from helpers import INTEGRATE, Lammps, Particles, disordered, dump, fluid, free, header, lattice, relative


def two_sizes(dim, cells):
    """Half of a periodic box filled with a lattice of spacing 1, the other half with one of 1/2."""
    def fill(spacing, begin):
        counts = [int(round(cells / spacing / 2))] + [int(round(cells / spacing))] * (dim - 1)
        grid = np.stack(np.meshgrid(*[np.arange(n) + 0.5 for n in counts], indexing="ij"), axis=-1)
        x = np.zeros((grid[..., 0].size, 3))
        x[:, :dim] = grid.reshape(-1, dim) * spacing
        x[:, 0] += begin
        return x, np.full(len(x), spacing**dim)

    coarse, fine = fill(1.0, 0.0), fill(0.5, 0.5 * cells)
    x, mass = np.concatenate([coarse[0], fine[0]]), np.concatenate([coarse[1], fine[1]])
    lo, hi = np.full(3, -0.5), np.full(3, 0.5)
    lo[:dim], hi[:dim] = 0.0, cells
    if dim == 1:
        lo[1], hi[1] = -10.0, 10.0
    return Particles(dim, x, np.zeros_like(x), mass, np.full(len(x), 5.0), np.ones(len(x), dtype=int), lo, hi)


def volumes(lammps, particles, volume, support, ranks=1):
    """Volumes over those of a lattice of their own, at uniform pressure 1."""
    particles.write(lammps.path("box.data"))
    lammps(header(particles.dim) + "read_data box.data\n"
           + fluid(particles.dim, f"volume {volume}", c0=1e-6, support=support, keywords="pb 1.0") + INTEGRATE
           + dump("box.dump") + "run 0\n", ranks=ranks)
    frame = lammps.frame("box.dump")
    return frame["vol"] / particles.mass, frame


@pytest.mark.parametrize("ranks", [1, 2, 4])
def test_four_to_one(tmp_path, ranks):
    """2d, support of four coarse spacings: number densities are wrong by half, reference volumes by 1 %."""
    particles = two_sizes(2, 24)
    ratio, frame = volumes(Lammps(tmp_path), particles, "mass", 4.0, ranks)
    assert np.abs(ratio - 1.0).max() < 0.01
    spurious = np.abs(frame["f"]).max(axis=1) / particles.mass  # over p V/dx of a coarse particle
    assert spurious.max() < 0.012
    ratio, _ = volumes(Lammps(tmp_path), particles, "number", 4.0, ranks)
    assert 0.4 < np.abs(ratio - 1.0).max() < 0.5


@pytest.mark.parametrize("dim, cells", [(1, 40), (3, 12)])
def test_jump_in_one_and_three_dimensions(tmp_path, dim, cells):
    ratio, _ = volumes(Lammps(tmp_path), two_sizes(dim, cells), "mass", 4.0)
    assert np.abs(ratio - 1.0).max() < 0.015


@pytest.mark.parametrize("dim", [1, 2, 3])
@pytest.mark.parametrize("options", ["", "eos tait bulk volume", "eos ideal shear morris", "limit yes"])
def test_equal_particles(tmp_path, dim, options):
    """Where all reference volumes are equal nothing depends on them but the round-off, with two types, too."""
    lammps = Lammps(tmp_path)
    particles = disordered(dim, {1: 40, 2: 12, 3: 6}[dim], ntypes=2)
    particles.mass = np.where(particles.type == 1, 0.8, 1.2)
    particles.write(lammps.path("box.data"))
    kappa = 0.0 if "limit" in options else 2.0
    coeff = "".join(f"pair_coeff {t} {t} {rho0} 10.0 0.5 {kappa} 3.0 pb 1.0\n" for t, rho0 in ((1, 1.6), (2, 2.4)))
    text = header(dim) + "read_data box.data\n" + INTEGRATE
    for volume in ("number", "mass"):
        text += fluid(dim, f"volume {volume} {options}", coeff=coeff) + dump(f"{volume}.dump") \
            + "run 0\nundump D\nuncompute F\n"
    lammps(text)
    number, mass = lammps.frame("number.dump"), lammps.frame("mass.dump")
    for name in ("f", "vol", "rho", "numden", "dnumden", "desph"):
        assert relative(number[name] - mass[name], number[name]) < 1e-13, name


@pytest.mark.parametrize("ranks", [1, 2, 4])
def test_conservation(tmp_path, ranks):
    """A free drop of particles whose masses differ four times: momentum and angular momentum to round-off, energy to
    second order in the time step."""
    lammps = Lammps(tmp_path)
    particles = lattice(2, 12)
    random = np.random.default_rng(5)
    particles.x[:, :2] += random.uniform(-0.2, 0.2, (len(particles), 2)) - 6.0
    particles.v[:, :2] = random.normal(0.0, 0.3, (len(particles), 2))
    particles.mass = random.choice([0.4, 1.6], len(particles))
    particles.lo, particles.hi = np.array([-40.0, -40.0, -0.5]), np.array([40.0, 40.0, 0.5])
    particles.write(lammps.path("drop.data"))
    mass = particles.mass[:, None]
    lost = []
    for steps in (400, 800):
        lammps(header(2, boundary=free(2)) + "read_data drop.data\n" + fluid(2, "volume mass")
               + f"fix FLUID all sph/bulk\ntimestep {0.1 / steps}\n" + dump("drop.dump", steps) + f"run {steps}\n",
               ranks=ranks)
        first, last = lammps.frames("drop.dump")
        for name, value in (("momentum", lambda f: mass * f["v"]),
                            ("angular momentum", lambda f: mass * np.cross(f["x"], f["v"]))):
            change = (value(last) - value(first)).sum(axis=0)
            assert np.abs(change).max() < 1e-13 * np.abs(value(first)).sum(), name
        lost.append(sum(sign * ((0.5 * mass * f["v"]**2).sum() + f["esph"].sum())
                        for sign, f in ((1.0, first), (-1.0, last))))
    assert abs(lost[0]) < 2e-3 * (0.5 * mass * first["v"]**2).sum()
    assert 3.8 < lost[0] / lost[1] < 4.2


def test_walls_and_spin(tmp_path):
    """A micropolar channel of equal particles: forces, torques and the state of the wall as with volume number."""
    lammps = Lammps(tmp_path)
    text = """
units lj
dimension 2
atom_style sph/micropolar
lattice sq 1.0 origin 0.5 0.5 0
region box block 0 12 0 18 -0.5 0.5
create_box 1 box
create_atoms 1 box
set group all mass 1.0
region floor block INF INF INF 3 INF INF
region lid block INF INF 15 INF INF INF
group floor region floor
group lid region lid
group fluid subtract all floor lid
displace_atoms fluid random 0.1 0.1 0.0 4711
velocity fluid create 0.1 4711
fix 1 fluid sph/micropolar inertia 0.1666 0.0 shift 0.5
fix F floor sph/wall spin rate 0.5
fix L lid sph/wall velocity 1.0 0.0 0.0
timestep 0.002
"""
    for volume in ("number", "mass"):
        text += f"""
pair_style sph/micropolar volume {volume}
pair_coeff * * 1.0 10.0 0.5 2.0 0.1 0.2 -0.2 3.0
dump {volume} all custom 1 {volume}.dump id fx fy tqz
dump_modify {volume} sort id format float %.17g
run 0
undump {volume}
"""
    lammps(text)
    number, mass = lammps.frame("number.dump"), lammps.frame("mass.dump")
    for name in ("fx", "fy", "tqz"):
        assert relative(number[name] - mass[name], number[name]) < 1e-12, name


@pytest.mark.parametrize("volume, ratio, warned", [("number", 1.3, True), ("number", 1.05, False),
                                                   ("mass", 1.3, False)])
def test_warning_of_unequal_masses(tmp_path, volume, ratio, warned):
    lammps = Lammps(tmp_path)
    particles = lattice(2, 12)
    particles.mass = np.where(np.arange(len(particles)) % 2 == 0, 1.0, ratio)
    particles.write(lammps.path("box.data"))
    result = lammps(header(2) + "read_data box.data\n" + fluid(2, f"volume {volume}") + INTEGRATE + "run 0\nrun 0\n",
                    ranks=2)
    found = [line for line in result.warnings if "use volume mass" in line]
    assert len(found) == (1 if warned else 0)
    if warned:
        assert "masses of type 1 differ by a factor of 1.3" in found[0]


@pytest.mark.parametrize("volume", ["number", "mass"])
def test_restart_holds_the_volume(tmp_path, volume):
    lammps = Lammps(tmp_path)
    two_sizes(2, 12).write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\n" + fluid(2, f"volume {volume}") + INTEGRATE + "run 0\n"
           "write_restart box.restart\n" + dump("first.dump") + "run 0\n")
    lammps("read_restart box.restart\n" + INTEGRATE + dump("second.dump") + "run 0\n", ranks=2)
    first, second = lammps.frame("first.dump"), lammps.frame("second.dump")
    assert relative(first["f"] - second["f"], first["f"]) < 1e-13
