"""pair_style density continuity: the density is the sum and an offset of each particle; diffusion of volume.

The reference is dense and shares no code with the package: it is the formulas of the theory page, with numpy.
"""

import re

import numpy as np
import pytest

from helpers import KOKKOS, Particles, dump, free, header, lattice, relative

# Ten particles: x y vx vy m rho; and what an independent program finds for Wendland C2, rc = 0.5, rho0 = 1, c0 = 10, mu = 0.1,
# kappa = 0.3, delta = 0.1: offset, rate of rho by motion, force, rate of the internal energy without diffusion; dV/dt by
# diffusion, heat of it

TEN = np.array("""
0.0193 0.0053 0.2486 0.3621 0.023275 1.0195
0.1603 -0.0171 -0.0909 0.4994 0.021045 1.0181
0.2862 -0.0145 -0.3616 0.3265 0.024457 1.0159
0.4323 0.0094 -0.3587 -0.0491 0.020280 1.0129
0.0043 0.1695 -0.0843 -0.3943 0.024711 1.0094
0.1700 0.1511 0.2539 -0.4946 0.020569 1.0053
0.3064 0.1310 0.3999 -0.2877 0.023916 1.0011
0.4334 0.1388 0.2433 0.0978 0.021773 0.9967
-0.0152 0.3130 -0.0974 0.4226 0.022449 0.9926
0.1584 0.3181 -0.3645 0.4849 0.023323 0.9888
""".split(), dtype=float).reshape(10, 6)
VALUES = np.array("""
2.009249473048e+01 1.630034370015 -2.237483770874e-01 -1.714494087318e-01 1.238095607472e-01 -2.707787069383e-04 3.043363869202e-05
1.792750598022e+01 1.795909733289 -2.944167959597e-02 -2.087896897310e-01 1.282001603430e-01 -2.167202169495e-04 3.193030138377e-05
9.935054857093 1.734576655576 1.540129150302e-01 -2.108846073752e-01 1.328541923410e-01 -4.802112643020e-05 4.417649031100e-05
2.488658807047e+01 7.604159368599e-01 1.715209119154e-01 -4.744820170324e-02 4.665070051792e-02 3.364517696688e-04 3.162805526636e-05
1.324055461997e+01 -3.235905965669e-01 -5.458119000385e-02 2.915393942926e-01 7.927415909362e-02 5.748023585363e-04 1.355771876148e-04
1.298095834279e+01 4.437263127305e-01 -5.725240524728e-02 3.691504501974e-01 1.441046153713e-01 4.736716999585e-04 7.678117771610e-05
7.410784850602 3.700818622496e-01 -5.765048310403e-02 2.378266138214e-01 6.876386146726e-02 -3.340474057763e-04 6.411517878246e-05
2.075124167455e+01 -3.341770313847e-01 1.429596433051e-02 1.918500547477e-02 9.964672865887e-03 -1.723427718490e-04 3.418289528644e-05
2.381368184803e+01 -1.019506671015 5.808580760951e-02 -1.033872303835e-01 7.461046036880e-02 -3.262968926663e-04 3.451291405177e-05
1.957840942901e+01 -1.675480864497 2.475853615290e-02 -1.757423258614e-01 1.319909274934e-01 -1.671870755408e-05 2.572205264622e-05
""".split(), dtype=float).reshape(10, 7)

FIELDS = "compute G all property/atom offset surface\n"
WANTED = "c_G[*] d_rho_sum d_vol_rate"


def write(path, particles, rho=None):
    """A data file with a column of densities, 0: rho0."""
    rho = np.zeros(len(particles)) if rho is None else rho
    particles.write(path)
    head, rest = path.read_text().split("Atoms # sph/bulk\n\n")
    atoms, velocities = rest.split("\n\nVelocities")
    lines = [line.split() for line in atoms.splitlines()]
    lines = [" ".join([*line[:4], repr(float(r)), *line[4:]]) for line, r in zip(lines, rho)]
    path.write_text(head + "Atoms # sph/bulk\n\n" + "\n".join(lines) + "\n\nVelocities" + velocities)


def text(dim, options="", coeff="1.0 10.0 0.1 0.3 3.0", boundary="p p p", newton="on", extra="", fix="", coeffs=None):
    return (header(dim, newton, boundary, "sph/bulk rho") + "atom_modify map array\ncomm_modify vel yes\n"
            f"pair_style sph/bulk dim {dim} {options}\nread_data box.data\n"
            + (coeffs or f"pair_coeff * * {coeff}\n") + f"fix FLUID all sph/bulk {fix}\n" + extra)


def ten_particles(volume="number"):
    x, v = np.zeros((10, 3)), np.zeros((10, 3))
    x[:, :2], v[:, :2] = TEN[:, :2], TEN[:, 2:4]
    box = np.array([2.0, 2.0, 0.5])
    return Particles(2, x, v, TEN[:, 4], np.zeros(10), np.ones(10, dtype=int), -box, box)


@pytest.mark.parametrize("simd", ["auto", "none", "avx2"])
def test_ten_particles(lammps, simd):
    lammps.skip_without(simd)
    write(lammps.path("box.data"), ten_particles(), TEN[:, 5])
    lammps(text(2, f"density continuity tension yes simd {simd}", "1.0 10.0 0.1 0.3 0.5") + FIELDS + dump("a.dump", extra=WANTED) + "run 0\n")
    frame = lammps.frame("a.dump")
    mass, rho = TEN[:, 4:6].T
    change, heat = VALUES[:, 5:7].T
    pressure = 100.0 * (rho - 1.0)
    assert relative(frame["rho"] - rho, rho) < 1e-15
    assert relative(frame["c_G[1]"] - VALUES[:, 0], VALUES[:, 0]) < 1e-11
    assert relative(frame["dnumden"] * mass - VALUES[:, 1], VALUES[:, 1]) < 1e-11
    assert relative(frame["f"][:, :2] - VALUES[:, 2:4], VALUES[:, 2:4]) < 1e-11
    assert relative(frame["d_vol_rate"] - change, change) < 1e-11
    assert relative(frame["desph"] - (VALUES[:, 4] - pressure * change + heat), VALUES[:, 4]) < 1e-11
    assert abs(frame["d_vol_rate"].sum()) < 5e-16 * np.abs(frame["d_vol_rate"]).sum()


# ---------------------------------------------------------------------------------------------
# larger sets against the dense reference


def wendland(dim, r, rc):
    """W and F = -W'/r, by their own formulas in the usual smoothing length h = rc/2."""
    h, q = rc / 2, r / (rc / 2)
    norm = {1: 3 / 4 / h, 2: 7 / (4 * np.pi) / h**2, 3: 21 / (16 * np.pi) / h**3}[dim]
    if dim == 1:  # (1 - q/2)^4 (1 + 2q) as in two and three dimensions
        norm = 3 / (4 * h)
    inside = q < 2
    return (norm * np.where(inside, (1 - q / 2)**4 * (2 * q + 1), 0.0),
            norm * np.where(inside, 5 * (1 - q / 2)**3, 0.0) / h**2)


def dense(p, rho, rho0, c0, rc, delta, by_mass, tension=True):
    """Offset, and rates of density and energy by diffusion, for given densities; periodic images by the nearest one."""
    length = p.hi - p.lo
    r = p.x[:, None] - p.x[None]
    r -= length * np.round(r / length)
    weight, slope = wendland(p.dim, np.linalg.norm(r, axis=2), rc)
    np.fill_diagonal(slope, 0.0)
    w = p.mass / rho0 if by_mass else np.ones(len(p))
    offset = w / p.mass * rho - weight @ w
    volume, pressure = p.mass / rho, c0**2 * (rho - rho0)
    if not tension:
        pressure = np.maximum(pressure, 0.0)
    impedance = rho0 * c0
    a = 4 * delta * rc / 2 * slope / (impedance[:, None] + impedance)
    r = r[..., :p.dim]
    jump = pressure[:, None] - pressure
    tensor = np.einsum("ij,j,ijx,ijy->ixy", a, volume, r, r)
    vector = np.einsum("ij,j,ij,ijx->ix", a, volume, jump, r)
    lowest = np.linalg.eigvalsh(np.einsum("ij,j,ijx,ijy->ixy", slope, volume, r, r))[:, 0]
    gradient = np.array([np.linalg.solve(t, d) if low >= 0.01 else np.zeros(p.dim)
                         for t, d, low in zip(tensor, vector, lowest)])
    chi = jump - 0.5 * np.einsum("ijx,ijx->ij", gradient[:, None] + gradient, r)
    change = volume * ((a * chi) @ volume)
    misfit = jump - np.einsum("ix,ijx->ij", gradient, r)
    heat = 0.5 * volume * ((a * misfit**2) @ volume)
    return offset, change, heat - pressure * change, heat, lowest


def random_set(dim, cells, seed=1, ntypes=1, jitter=0.3, keep=0.7):
    """A disordered set with holes, and densities."""
    random = np.random.default_rng(seed)
    p = lattice(dim, cells)
    shift = np.zeros((len(p), 3))
    shift[:, :dim] = random.uniform(-jitter, jitter, (len(p), dim))
    p.x = p.x + shift
    if dim == 1:
        p.x[:, 1] = 0.3
    p.mass = random.uniform(0.9, 1.1, len(p))
    p.v[:, :dim] = random.normal(0.0, 0.3, (len(p), dim))
    p.esph[:] = 0.0
    p.type = random.integers(1, ntypes + 1, len(p))
    p.type[0] = ntypes
    p = p.where(random.uniform(0, 1, len(p)) < keep)
    return p, random.uniform(0.97, 1.05, len(p))


@pytest.mark.parametrize("dim, cells, types, volume, newton, ranks, options", [
    (1, 40, 1, "number", "on", 1, ""), (2, 14, 1, "number", "on", 1, ""), (3, 7, 1, "number", "on", 1, ""),
    (2, 14, 2, "mass", "on", 1, ""), (2, 14, 2, "number", "off", 2, ""), (3, 7, 2, "mass", "on", 4, ""),
    (2, 14, 1, "number", "on", 4, "tension no"), (3, 7, 2, "number", "off", 1, "simd none"), (1, 40, 2, "number", "on", 2, "simd avx2")])
def test_dense_reference(lammps, dim, cells, types, volume, newton, ranks, options):
    if "simd" in options:
        lammps.skip_without(options.split()[-1])
    p, rho = random_set(dim, cells, ntypes=types)
    rho0, c0 = np.array([1.0, 1.5]), np.array([10.0, 7.0])
    rho *= rho0[p.type - 1]
    rc = {1: 4.0, 2: 3.2, 3: 2.4}[dim]
    tension = "tension no" not in options
    write(lammps.path("box.data"), p, rho)
    coeffs = "".join(f"pair_coeff {k} {k} {rho0[k - 1]} {c0[k - 1]} 0.0 0.0 {rc}\n" for k in range(1, types + 1))
    lammps(text(dim, f"density continuity delta 0.15 volume {volume} {'tension yes' if tension else ''} {options}", newton=newton, coeffs=coeffs)
           + FIELDS + dump("a.dump", extra=WANTED) + "run 0\n", ranks=ranks)
    frame = lammps.frame("a.dump")
    offset, rate, energy_rate, _, lowest = dense(p, rho, rho0[p.type - 1], c0[p.type - 1], rc, 0.15, volume == "mass", tension)
    work = c0[p.type - 1]**2 * (rho - rho0[p.type - 1])
    work = (work if tension else np.maximum(work, 0.0)) * p.mass * frame["dnumden"] * p.mass / rho**2
    assert relative(frame["c_G[1]"] - (offset * (rho0[p.type - 1] / p.mass if volume == "mass" else 1.0)) / 1.0, frame["numden"]) < 1e-13 \
        or volume == "mass"
    assert relative(frame["d_vol_rate"] - rate, rate) < 1e-11
    assert relative(frame["desph"] - work - energy_rate, energy_rate) < 1e-11
    assert relative(frame["c_G[2]"] - lowest, lowest) < 1e-12
    assert abs(frame["d_vol_rate"].sum()) < 1e-13 * np.abs(rate).max()


@pytest.mark.parametrize("dim, cells", [(1, 16), (2, 10), (3, 8)])
def test_surface_in_a_full_box_of_two_fluids(lammps, dim, cells):
    """Densities 1000 : 1, as water and air: the support of no particle has a gap; a lattice has one value."""
    p = lattice(dim, cells)
    p.x[:, 1] = 0.3 if dim == 1 else p.x[:, 1]
    p.type = np.where(p.x[:, 0] > cells / 2, 2, 1)
    p.mass = np.where(p.type == 2, 1e-3, 1.0)
    found = []
    for second in ("1.0", "0.001"):
        write(lammps.path("box.data"), p)
        lammps(text(dim, "density continuity", coeffs="".join(f"pair_coeff {k} {k} {rho} 10.0 0.1 0.3 2.5\n" for k, rho in ((1, "1.0"), (2, second))))
               + f"set group all mass 1.0\nset type 2 mass {second}\n" + FIELDS + dump("a.dump", extra=WANTED) + "run 0\n")
        found.append(lammps.frame("a.dump")["c_G[2]"])
    assert np.abs(found[0] - found[0][0]).max() < 1e-14 and abs(found[0][0] - 1.0) < 0.1
    assert np.abs(found[1] - found[0]).max() < 1e-14


def test_gradient_of_a_light_particle_in_a_heavy_fluid(lammps):
    """All of its neighbors are heavy. It has the gradient of their pressure, so that no volume flows in a hydrostatic column."""
    p = lattice(2, 12)
    p.type = np.where(np.arange(len(p)) == 78, 2, 1)
    rho0, c0 = np.where(p.type == 2, 1e-3, 1.0), np.where(p.type == 2, 30.0, 10.0)
    p.mass = 1.0 * rho0
    pressure = 2.0 - 0.1 * p.x[:, 1]
    write(lammps.path("box.data"), p, rho0 + pressure / c0**2)
    coeffs = "pair_coeff 1 1 1.0 10.0 0.1 0.3 2.5\npair_coeff 2 2 0.001 30.0 0.1 0.3 2.5\n"
    lammps(text(2, "density continuity tension yes", coeffs=coeffs, boundary=free(2)) + FIELDS + dump("a.dump", extra=WANTED) + "run 0\n")
    frame = lammps.frame("a.dump")
    assert p.x[78, 1] == 6.5 and abs(frame["c_G[2]"][78] - 1.0) < 0.1
    assert abs(frame["d_vol_rate"][78]) < 1e-13


def test_surface_does_not_count_walls(lammps):
    p = lattice(2, 10)
    write(lammps.path("box.data"), p)
    wall = "region low block INF INF INF 4 INF INF units box\ngroup low region low\ngroup fluid subtract all low\n"
    start = text(2, "density continuity", boundary="p f p").replace("fix FLUID all", wall + "fix FLUID fluid") + FIELDS
    lammps(start + "fix W low sph/wall\n" + dump("with.dump", extra=WANTED) + "run 0\n")
    lammps(start + "delete_atoms group low compress no\n" + dump("without.dump", extra=WANTED) + "run 0\n")
    beside = lammps.frame("with.dump")["c_G[2]"][np.isin(lammps.frame("with.dump")["id"], lammps.frame("without.dump")["id"])]
    assert np.abs(beside - lammps.frame("without.dump")["c_G[2]"]).max() < 1e-14 and beside.min() < 0.6


def test_heat_is_never_negative(lammps):
    """Of spray: single particles, pairs, lines, lumps; without viscosity all that is left besides the work is the heat."""
    random = np.random.default_rng(3)
    p, _ = random_set(2, 90, seed=4, jitter=0.5, keep=0.25)
    rho = random.uniform(0.9, 1.1, len(p))
    p.v[:] = 0.0
    write(lammps.path("box.data"), p, rho)
    lammps(text(2, "density continuity tension yes", "1.0 10.0 0.0 0.0 2.5") + FIELDS + dump("a.dump", extra=WANTED) + "run 0\n")
    frame = lammps.frame("a.dump")
    work = -100.0 * (rho - 1.0) * frame["d_vol_rate"]
    heat = frame["desph"] - work
    assert heat.min() > -1e-13 * np.abs(work).max() and heat.max() > 0.01
    assert abs(frame["desph"].sum()) < 1e-13 * np.abs(frame["desph"]).sum()
    assert len(np.unique(np.round(frame["c_G[2]"], 2))) > 50 and (frame["c_G[2]"] == 0.0).sum() > 20


# ---------------------------------------------------------------------------------------------
# the sum, without offsets


def test_without_offsets_it_is_the_sum(lammps):
    p, _ = random_set(2, 14, jitter=0.2, keep=1.0)
    write(lammps.path("box.data"), p)
    more = "compute G all property/atom offset\n" + dump("{}.dump", 500, "c_G") + "timestep 0.002\nrun 1000\n"
    lammps(text(2, "density sum") + more.format("sum"))
    lammps(text(2) + more.format("default"))
    assert lammps.path("sum.dump").read_text() == lammps.path("default.dump").read_text()
    summed = lammps.frames("sum.dump")
    write(lammps.path("box.data"), p, summed[0]["rho"])
    lammps(text(2, "density continuity delta 0 tension yes") + more.format("state"))
    for one, other, limit in zip(summed, lammps.frames("state.dump"), (1e-12, 1e-9, 1e-9)):
        assert relative(one["f"] - other["f"], one["f"]) < limit and relative(one["rho"] - other["rho"], one["rho"]) < limit
    assert relative(lammps.frame("state.dump")["c_G"], summed[0]["numden"]) < 1e-11


def test_noise_without_offsets_is_that_of_the_sum(lammps):
    p, _ = random_set(2, 14, jitter=0.1, keep=1.0)
    write(lammps.path("box.data"), p)
    more = dump("{}.dump", 50) + "timestep 0.002\nrun 50\n"
    lammps(text(2, "temp 0.1 4711") + more.format("sum"))
    write(lammps.path("box.data"), p, lammps.frames("sum.dump")[0]["rho"])
    lammps(text(2, "density continuity delta 0 tension yes temp 0.1 4711") + more.format("state"))
    one, other = lammps.frame("sum.dump"), lammps.frame("state.dump")
    assert relative(one["f"] - other["f"], one["f"]) < 1e-11 and relative(one["v"] - other["v"], one["v"]) < 1e-11


# ---------------------------------------------------------------------------------------------
# a free drop


def free_drop(two=False, n=14):
    p = lattice(2, n)
    centre = 0.5 * (p.lo + p.hi)
    p.x = p.x - centre
    p.x[:, 2] = 0.0
    p = p.where(np.hypot(p.x[:, 0], p.x[:, 1]) < n / 2 + 0.01)
    p.lo, p.hi = np.array([-2.0 * n, -2.0 * n, -0.5]), np.array([2.0 * n, 2.0 * n, 0.5])
    p.v[:, 0], p.v[:, 1] = 0.03 * p.x[:, 0] - 0.02 * p.x[:, 1], -0.03 * p.x[:, 1] + 0.02 * p.x[:, 0]
    p.esph[:] = 0.0
    if two:
        p.type = np.where(p.x[:, 0] > 0, 2, 1)
        p.mass = np.where(p.x[:, 0] > 0, 1.3, 1.0)
    return p


TWO = "pair_coeff 1 1 1.0 10.0 0.02 0.3 3.2\npair_coeff 2 2 1.3 6.0 0.01 0.2 3.2\n"
TOTALS = ("compute E all reduce sum c_EK c_EI\nvariable ke atom 0.5*mass*(vx^2+vy^2)\n"
          "variable px equal xcm(all,x)\n")


def energy(frame):
    return 0.5 * (frame["mass"] * (frame["v"]**2).sum(axis=1)).sum() + frame["esph"].sum()


@pytest.mark.parametrize("two, ranks, newton, volume", [(False, 1, "on", "number"), (True, 2, "on", "mass"), (True, 4, "off", "number"), (True, 4, "on", "mass")])
def test_conservation_of_a_free_drop(lammps, two, ranks, newton, volume):
    p = free_drop(two)
    random = np.random.default_rng(5)
    write(lammps.path("box.data"), p, random.uniform(1.0, 1.02, len(p)) * np.where(p.type == 2, 1.3, 1.0))
    lammps(text(2, f"density continuity tension yes volume {volume}", boundary=free(2), newton=newton, coeffs=TWO if two else TWO.split("\n")[0] + "\n")
           + FIELDS + dump("a.dump", 200, WANTED) + "timestep 0.02\nrun 400\n", ranks=ranks)
    frames = lammps.frames("a.dump")
    for frame in frames:
        rate = frame["d_vol_rate"]
        assert abs(rate.sum()) < 1e-13 * np.abs(rate).max() * np.sqrt(len(p))
    momentum = [(f["mass"][:, None] * f["v"]).sum(axis=0) for f in frames]
    spin = [(f["mass"] * (f["x"][:, 0] * f["v"][:, 1] - f["x"][:, 1] * f["v"][:, 0])).sum() for f in frames]
    speed = (frames[0]["mass"] * np.linalg.norm(frames[0]["v"], axis=1)).sum()
    assert np.abs(momentum[-1] - momentum[0]).max() < 1e-13 * speed
    assert abs(spin[-1] - spin[0]) < 1e-12 * abs(spin[0])


@pytest.mark.parametrize("delta, interval", [(0.1, 3), (0.15, 2), (0.5, 1)])
def test_rates_are_evaluated_as_often_as_stability_needs(lammps, delta, interval):
    """7 n delta c0 dt/h <= 0.6; in between they stay with the particles, whatever the number of the step is."""
    p = free_drop()
    random = np.random.default_rng(5)
    write(lammps.path("box.data"), p, random.uniform(1.0, 1.02, len(p)))
    lammps(text(2, f"density continuity delta {delta} tension yes", "1.0 10.0 0.02 0.3 3.2", free(2)) + dump("a.dump", extra="d_vol_rate")
           + "timestep 0.04\nrun 3\nundump D\nuncompute F\nreset_timestep 0\n" + dump("b.dump", extra="d_vol_rate") + "run 4\n")
    rates = [frame["d_vol_rate"] for frame in lammps.frames("a.dump")] + [frame["d_vol_rate"] for frame in lammps.frames("b.dump")[1:]]
    for step, (one, other) in enumerate(zip(rates, rates[1:]), 1):
        assert (relative(one - other, one) < 1e-10) != (step % interval == 0), step


def test_results_do_not_depend_on_the_number_of_ranks(lammps):
    p = free_drop(True)
    write(lammps.path("box.data"), p)
    frames = []
    for ranks, newton in ((1, "on"), (2, "off"), (4, "on")):
        lammps(text(2, "density continuity volume mass", boundary="p p p", newton=newton, coeffs=TWO) + FIELDS + dump("a.dump", 300, WANTED)
               + "neigh_modify delay 0 every 1 check yes\nfix B all balance 50 1.0 shift xy 10 1.01\ntimestep 0.02\nrun 300\n", ranks=ranks)
        frames.append(lammps.frame("a.dump"))
    for other in frames[1:]:
        for name in ("f", "rho", "esph", "d_vol_rate", "c_G[1]", "c_G[2]"):
            assert relative(frames[0][name] - other[name], frames[0][name]) < 1e-9, name


def test_energy_is_of_second_order(lammps):
    p = free_drop()
    write(lammps.path("box.data"), p, 1.0 + 0.002 * (49.0 - (p.x[:, :2]**2).sum(axis=1)) / 49.0)
    errors = []
    for steps in (400, 800, 1600):
        lammps(text(2, "density continuity", "1.0 10.0 0.02 0.3 3.2", free(2)) + dump("a.dump", steps) + f"timestep {8.0 / steps}\nrun {steps}\n")
        first, last = lammps.frames("a.dump")
        errors.append(energy(last) - energy(first))
    assert all(abs(a) > 3.5 * abs(b) for a, b in zip(errors, errors[1:])), errors


# ---------------------------------------------------------------------------------------------
# sound


@pytest.mark.parametrize("delta, kappa, expected, within", [(0.1, 0.0, 0.0110, 0.0005), (0.0, 0.0, 0.0, 0.0002), (0.1, 0.2, 0.1959, 0.001)])
def test_damping_of_sound(lammps, delta, kappa, expected, within):
    """A wave of 24 spacings; time and amplitude at the crests of its velocity, where the wave has no energy but the kinetic one."""
    p = lattice(2, (24, 8))
    k = 2 * np.pi / 24
    p.v[:, 0] = 1e-4 * np.cos(k * p.x[:, 0])
    p.esph[:] = 0.0
    write(lammps.path("box.data"), p)
    lammps(text(2, f"density continuity delta {delta} tension yes", f"1.0 1.0 0.0 {kappa} 4.0")
           + f"variable c atom cos({k}*x)*vx\ncompute A all reduce ave v_c\nvariable A equal 2*c_A\nthermo_style custom step v_A\n"
           "thermo_modify format float %.15g\nthermo 1\ntimestep 0.1\nrun 2600\n")
    table = lammps.results[-1].thermo()[0]
    amplitude = table["v_A"]
    crest = [m for m in range(1, len(amplitude) - 1) if abs(amplitude[m]) > abs(amplitude[m - 1]) and abs(amplitude[m]) >= abs(amplitude[m + 1])]
    times, heights = [0.0], [amplitude[0]]
    for m in crest:
        a, b, c = np.abs(amplitude[m - 1:m + 2])
        times.append(0.1 * (m + 0.5 * (a - c) / (a - 2 * b + c)))
        heights.append(b - 0.125 * (a - c)**2 / (a - 2 * b + c))
    rate = -np.polyfit(times[1:], np.log(heights[1:]), 1)[0]
    assert len(crest) > 18 and abs(2 * rate / k**2 - expected) < within, 2 * rate / k**2


# ---------------------------------------------------------------------------------------------
# the state of a particle


def test_restart_and_data_files(lammps):
    p = free_drop(True)
    write(lammps.path("box.data"), p)
    first = text(2, "density continuity volume mass", boundary=free(2), coeffs=TWO, extra="timestep 0.02\n")
    wanted = FIELDS + dump("{}.dump", 100, WANTED)
    lammps(first + wanted.format("whole") + "run 200\n", ranks=2)
    whole = lammps.frames("whole.dump")
    lammps(first + "run 100\nwrite_restart half.restart\nwrite_data half.data\n")
    restart = "read_restart half.restart\nfix FLUID all sph/bulk\ntimestep 0.02\n"
    lammps(restart + wanted.format("restart") + "run 100\n")
    data = text(2, "density continuity volume mass", boundary=free(2), coeffs=TWO, extra="timestep 0.02\n").replace("box.data", "half.data")
    lammps(data + wanted.format("data") + "run 100\n", ranks=2)
    lammps(first + "run 100\n" + wanted.format("twice") + "run 100\n")
    for name, limit in (("restart", 1e-10), ("twice", 1e-10), ("data", 1e-3)):
        begin, end = lammps.frames(f"{name}.dump")
        assert relative(begin["rho"] - whole[1]["rho"], whole[1]["rho"] - 1.0) < min(limit, 1e-3), name
        assert relative(begin["c_G[1]"] - whole[1]["c_G[1]"], whole[1]["c_G[1]"]) < 1e-3, name
        assert relative(end["rho"] - whole[2]["rho"], whole[2]["rho"] - 1.0) < limit, name
        assert relative(end["f"] - whole[2]["f"], whole[2]["f"]) < 10 * limit, name


def test_new_particles_and_set(lammps):
    """The density of a new particle is rho0 of its type; set gives another one; both stay what they are through replicate and displacement."""
    p = free_drop(True)
    p.lo[:2], p.hi[:2] = -12.0, 12.0
    write(lammps.path("box.data"), p)
    first = text(2, "density continuity volume mass", boundary="p p p", coeffs=TWO)
    dumped = lambda name: FIELDS.replace("offset surface", "offset") + dump(name, extra="c_G d_rho_sum") + "run 0\nundump D\nuncompute F\nuncompute G\n"  # noqa: E731
    lammps(first + dumped("a.dump") + "variable r atom 1.01+0.001*y\nset type 1 sph/rho v_r\n" + dumped("b.dump")
           + "displace_atoms all move 3 0 0\nreplicate 2 1 1\n" + dumped("c.dump"))
    begin, again, copies = (lammps.frame(name) for name in ("a.dump", "b.dump", "c.dump"))
    assert np.abs(begin["rho"] - np.where(p.type == 2, 1.3, 1.0)).max() < 1e-15
    wanted = np.where(p.type == 2, 1.3, 1.01 + 0.001 * p.x[:, 1])
    assert np.abs(again["rho"] - wanted).max() < 1e-13
    assert np.abs(copies["rho"] - np.concatenate([wanted, wanted])).max() < 1e-13


def test_deleted_neighbors_do_not_change_the_density(lammps):
    p = free_drop()
    write(lammps.path("box.data"), p)
    lammps(text(2, "density continuity", boundary=free(2), extra="timestep 0.02\n") + "run 20\nregion R block 0 INF INF INF INF INF\n"
           + FIELDS + dump("a.dump", extra=WANTED) + "run 0\nundump D\nuncompute F\ndelete_atoms region R compress no\n"
           + dump("b.dump", extra=WANTED) + "run 0\n")
    before, after = lammps.frame("a.dump"), lammps.frame("b.dump")
    left = np.isin(before["id"], after["id"])
    assert left.sum() < 0.6 * len(p)
    assert np.abs(before["rho"][left] - after["rho"]).max() < 1e-13
    assert np.abs(before["c_G[1]"][left] - after["c_G[1]"]).max() > 0.2


@pytest.mark.parametrize("lines", [
    "pair_style sph/bulk density continuity kernel wendland/c4\n", "pair_coeff * * 1.0 10.0 0.1 0.3 3.5\n", "set group all mass 1.2\n",
    "pair_style sph/bulk\nrun 5\nundump D\nuncompute F\n" + dump("a.dump") + "run 0\npair_style sph/bulk density continuity\n"])
def test_new_settings_do_not_change_the_density(lammps, lines):
    """The sum changes by other means than motion; the offset follows."""
    write(lammps.path("box.data"), free_drop())
    lammps(text(2, "density continuity", boundary=free(2), extra="timestep 0.02\n") + "run 20\n" + dump("a.dump") + "run 0\n" + lines
           + "undump D\nuncompute F\n" + dump("b.dump") + "run 0\n")
    before, after = lammps.frame("a.dump"), lammps.frame("b.dump")
    assert np.abs(before["rho"] - after["rho"]).max() < 1e-13


def test_density_0_is_rho0_in_a_later_run(lammps):
    write(lammps.path("box.data"), free_drop())
    lammps(text(2, "density continuity", boundary=free(2), extra="timestep 0.02\n") + "run 20\nset group all sph/rho 0\n" + dump("a.dump") + "run 0\n")
    assert np.abs(lammps.frame("a.dump")["rho"] - 1.0).max() < 1e-15


def test_particles_that_are_not_integrated_take_no_volume(lammps):
    """What flows between all others adds up to nothing, next to a rigid body and next to particles that stay."""
    p = free_drop()
    random = np.random.default_rng(5)
    p.v[:] = 0.0
    write(lammps.path("box.data"), p, random.uniform(1.0, 1.02, len(p)))
    for body in ("fix B body rigid/nve single\n", ""):
        lammps(text(2, "density continuity", boundary=free(2), extra="timestep 0.02\n")
               .replace("fix FLUID all", f"group body id 1:40\ngroup fluid subtract all body\n{body}fix FLUID fluid")
               + FIELDS + dump("a.dump", extra=WANTED) + "run 2\n", ranks=2)
        frame = lammps.frame("a.dump")
        rate, inside = frame["d_vol_rate"], frame["id"] > 40
        assert np.abs(rate[~inside]).max() == 0.0 and np.abs(frame["c_G[2]"][~inside]).max() == 0.0
        assert abs(rate.sum()) < 1e-13 * np.abs(rate).max() and np.abs(rate).max() > 1e-4


def test_merges_hand_on_the_rates_of_volume(lammps):
    """Also in a step between two evaluations of the diffusion, which is each third one."""
    p = free_drop()
    random = np.random.default_rng(8)
    write(lammps.path("box.data"), p, random.uniform(0.98, 1.02, len(p)))
    lammps(text(2, "density continuity volume mass tension yes", "1.0 10.0 0.0 0.0 3.2", free(2))
           + "variable t atom 1.0-0.7*(x>0)+1.3*(x<-3)\nfix R all sph/refine 4 volume v_t\ntimestep 0.01\n" + dump("a.dump", extra="d_vol_rate") + "run 4\n")
    begin, end = lammps.frames("a.dump")[::4]
    assert len(end["id"]) > len(begin["id"]) and not np.isin(begin["id"], end["id"]).all()
    assert abs(end["d_vol_rate"].sum()) < 1e-13 * np.abs(end["d_vol_rate"]).max()


def test_no_tension(lammps):
    """Particles that are stretched have no pressure and the energy of rho0; the time step is that of c0."""
    p = free_drop()
    rho = np.linspace(0.5, 1.1, len(p))
    write(lammps.path("box.data"), p, rho)
    for eos, energy_of in (("linear", lambda x: 100 * (np.log(x) + 1 / x - 1)),
                           ("tait", lambda x: 100 / 7 * ((x**6 - 1) / 6 + 1 / x - 1))):
        result = lammps(text(2, f"density continuity eos {eos}", "1.0 10.0 0.0 0.0 3.2", free(2)) + "thermo_style custom step pe\n"
                        "thermo_modify norm no format float %.15g\n" + dump("a.dump") + "run 0\n")
        expected = np.where(rho > 1.0, energy_of(rho), 0.0).sum()
        assert abs(result.thermo()[0]["PotEng"][0] / expected - 1) < 1e-13
    alone = rho < 0.9
    alone &= np.array([rho[np.linalg.norm(p.x - x, axis=1) < 3.3].max() <= 1.0 for x in p.x])
    assert alone.sum() > 20 and np.abs(lammps.frame("a.dump")["f"][alone]).max() == 0.0


def test_table_and_time_step(lammps):
    write(lammps.path("box.data"), free_drop())
    result = lammps(text(2, "density continuity delta 2", "1.0 10.0 0.0 0.0 3.2", free(2)) + "fix DT all sph/dt 1\nthermo_style custom step dt\nrun 1\n")
    assert "density continuity, delta 2, tension no, support radius 3.2" in result.log
    step = 0.9 / (7 * 2 * 10 / 1.6)
    head, row = re.search(r"largest stable time step:(.*)\n.*\|(.*)\n", result.log).groups()
    values = dict(zip(head.split(), map(float, row.replace(" - ", " inf ").split())))
    assert abs(values["diffusion"] / step - 1) < 1e-3 and abs(values["all"] / step - 1) < 1e-3
    assert abs(result.thermo()[0]["Dt"][-1] / step - 1) < 1e-3


# ---------------------------------------------------------------------------------------------
# words


@pytest.mark.parametrize("options, message", [
    ("density yes", "Unknown density yes for pair_style sph/bulk"), ("density", "Illegal pair_style sph/bulk density command"),
    ("delta 0.1", "delta requires density continuity"), ("density sum tension no", "tension requires density continuity"),
    ("density continuity delta -1", "delta must be >= 0"), ("density continuity delta nan", "instead of 'nan'"),
    ("density continuity tension maybe", "Unknown tension maybe"), ("density continuity eos ideal", "a gas has no free surface"),
    ("density continuity temp 1.0 3", "requires delta 0")])
def test_settings_that_are_refused(lammps, options, message):
    write(lammps.path("box.data"), free_drop())
    result = lammps(text(2, options) + "run 0\n", check=False)
    assert result.code and message in result.error, result.error or result.output[-500:]


@pytest.mark.parametrize("lines, message", [
    ("unfix FLUID\nfix FLUID all sph/bulk density rho0\nrun 0\n", "density rho0 cannot be used with density continuity"),
    ("pair_coeff * * 1 10 0.1 0.3 3 cv 1 gruneisen 1 0\nrun 0\n", "requires tension yes"),
    ("set atom 3 sph/rho -1\nrun 0\n", "density must be >= 0, which that of particle 3 is not"),
    ("compute G all property/atom surface\ndump D all custom 1 a.dump id c_G\npair_style sph/bulk\npair_coeff * * 1 10 0.1 0.3 3\nrun 0\n",
     "surface needs a pair style with density continuity")])
def test_commands_that_are_refused(lammps, lines, message):
    write(lammps.path("box.data"), free_drop())
    result = lammps(text(2, "density continuity") + lines, check=False)
    assert result.code and message in result.error, result.error or result.output[-500:]


def test_data_file_with_a_negative_density(lammps):
    p = free_drop()
    write(lammps.path("box.data"), p, np.where(np.arange(len(p)) == 7, -1.0, 1.0))
    for ranks in (1, 2):
        result = lammps(text(2, "density continuity") + "run 0\n", check=False, ranks=ranks)
        assert result.code and "Invalid density -1" in result.error


@pytest.mark.parametrize("words, options, lines, warning", [
    ("1 10 0.1 0.3 3 pb 1", "", "run 0\n", "presses free surfaces outward"), ("1 10 0.1 0.3 3", "shear morris", "run 0\n", "shear morris exerts a torque"),
    ("1 10 0.1 0.3 3", "shear espanol", "run 0\n", "shear espanol exerts a torque"),
    ("1 10 0.1 0.039 3", "shear mg/fr2", "run 0\n", "may gain energy where kappa 0.039 of type 1 is below 0.4 mu"),
    ("1 10 0.1 0.3 3", "", "neigh_modify every 1 check no\nvelocity all ramp vx -2 2 y -1 1\nrun 1\n", "are faster than 0.1 c0")])
def test_warnings(lammps, words, options, lines, warning):
    write(lammps.path("box.data"), free_drop())
    result = lammps(text(2, f"density continuity {options}", words) + lines)
    assert len([one for one in result.warnings if warning in one]) == 1, result.warnings


@pytest.mark.parametrize("lines, warning", [
    ("set group all mass 0.8\nrun 0\n", "masses of type 1 have the mean density 0.7"), ("set group all mass 1000\nrun 0\n", "use set mass"),
    ("run 1\npair_coeff * * 1.3 10 0.1 0.3 3\nset group all mass 1.3\nrun 0\n", "mean density 1 of type 1 is far from its rho0 1.3; use set sph/rho")])
def test_warnings_of_masses_and_densities(lammps, lines, warning):
    write(lammps.path("box.data"), free_drop())
    result = lammps(text(2, "density continuity", "1 10 0.1 0.3 3", boundary=free(2)) + lines)
    assert len(result.warnings) == 1 and warning in result.warnings[0], result.warnings


def test_no_warning_of_the_shear_elasticity(lammps):
    """Its remedies, density rho0, no pb, and shift, are none for a fluid whose pressure is that of its weight."""
    p = lattice(2, 14)
    p.esph[:] = 0.0
    p.v[:, 0] = 0.01 * np.sin(2 * np.pi * p.x[:, 1] / 14)
    write(lammps.path("box.data"), p, np.full(len(p), 1.05))
    for options, warns in (("density continuity", False), ("density sum", True)):
        result = lammps(text(2, options, "1.0 10.0 0.01 0.3 3.0" + (" pb 5.0" if warns else "")) + "run 0\n")
        assert any("shear elasticity" in one for one in result.warnings) == warns, result.warnings


@pytest.mark.parametrize("tension, omega, warned", [("no", 1.0, True), ("yes", 1.0, False), ("no", 0.05, False)])
def test_warning_of_a_fluid_that_flies_apart(lammps, tension, omega, warned):
    """A square that rotates, Mach number 0.1."""
    p = lattice(2, 16)
    p.x[:, :2] -= 8.0
    p.lo, p.hi = np.array([-60.0, -60.0, -0.5]), np.array([60.0, 60.0, 0.5])
    p.v[:, 0], p.v[:, 1] = omega * p.x[:, 1], -omega * p.x[:, 0]
    p.esph[:] = 0.0
    write(lammps.path("box.data"), p)
    result = lammps(text(2, f"density continuity tension {tension}", "1.0 113.0 0.1 0.3 3.0", boundary=free(2)) + "timestep 0.003\nrun 300\nrun 50\n",
                    ranks=2)
    lines = [one for one in result.warnings if "flies apart" in one]
    assert len(lines) == warned and (not warned or "of 256 particles is below 0.9" in lines[0]), lines


def test_no_warning_of_a_quiet_fluid(lammps):
    write(lammps.path("box.data"), free_drop())
    result = lammps(text(2, "density continuity") + "run 20\nwrite_data a.data\n")
    assert not result.warnings


@pytest.mark.parametrize("ranks, style, options", [(1, "sph/bulk", ""), (2, "sph/bulk", "nocoeff"), (1, "sph/bulk", "pair ij"),
                                                   (1, "hybrid sph/bulk charge", "nocoeff")])
def test_data_file_without_densities(lammps, ranks, style, options):
    drop = free_drop()
    if style != "sph/bulk":
        drop.charge = np.zeros(len(drop))
    drop.write(lammps.path("box.data"), style=style)
    result = lammps(text(2, "density continuity").replace("sph/bulk rho", style) + f"run 0\nwrite_data a.data {options}\n", ranks=ranks)
    assert len([one for one in result.warnings if "without the densities" in one]) == 1


# ---------------------------------------------------------------------------------------------
# with other features


def test_splits_and_merges_keep_densities(lammps):
    """Volumes of daughters are parts of the parent's, that of a merge is their sum; all other particles keep theirs."""
    p = free_drop()
    random = np.random.default_rng(8)
    rho = random.uniform(0.95, 1.05, len(p))
    p.v[:] = 0.0
    write(lammps.path("box.data"), p, rho)
    lammps(text(2, "density continuity volume mass delta 0 tension yes", "1.0 10.0 0.0 0.0 3.2", free(2))
           + "variable t atom 1.0-0.7*(x>0)+1.3*(x<-3)\nfix R all sph/refine 1 volume v_t\ntimestep 1e-9\n"
           + "compute G all property/atom offset\n" + dump("a.dump", extra="c_G") + "run 1\n")
    begin, end = lammps.frames("a.dump")
    assert len(end["id"]) > len(begin["id"]) and not np.isin(begin["id"], end["id"]).all()
    assert abs((end["mass"] / end["rho"]).sum() / (begin["mass"] / begin["rho"]).sum() - 1) < 1e-9
    same = {i: (m, r) for i, m, r in zip(begin["id"], begin["mass"], begin["rho"])}
    kept = [(r, same[i][1]) for i, m, r in zip(end["id"], end["mass"], end["rho"]) if i in same and abs(m - same[i][0]) < 1e-12]
    assert len(kept) > 10 and max(abs(r / before - 1) for r, before in kept) < 1e-9
    assert np.abs(end["c_G"]).max() > 0.1


@pytest.mark.skipif(KOKKOS, reason="pair_style hybrid takes no pair styles of KOKKOS")
@pytest.mark.parametrize("c0", [10.0, 20.0])
def test_particles_of_other_styles_take_no_part_in_the_diffusion(lammps, c0):
    """The first particle belongs to another pair style, and has no impedance."""
    drop = free_drop()
    drop.type = np.where(drop.x[:, 0] > 0, 2, 1)
    wall = drop.where(drop.x[:, 1] < -4)
    wall.x[:, 1] -= 12.0
    wall.type[:] = 3
    both = wall.where(wall.type == 3)
    for name in "x", "v", "mass", "esph", "type":
        setattr(both, name, np.concatenate([getattr(wall, name), getattr(drop, name)]))
    density = "density continuity tension yes"
    types = "pair_coeff 1 1 sph/bulk 1.0 10.0 0.1 0.3 3.0\npair_coeff 2 2 sph/bulk 1.0 {c0} 0.1 0.3 3.0\n".format(c0=c0)
    alone = text(2, density, coeffs=types.replace("sph/bulk ", ""), boundary=free(2))
    beside = text(2, density, coeffs=types + "pair_coeff * 3 zero\n", boundary=free(2)).replace(
        f"pair_style sph/bulk dim 2 {density}", f"pair_style hybrid sph/bulk dim 2 {density} zero 3.0")
    rho = []
    for particles, lines in (drop, alone), (both, beside):
        write(lammps.path("box.data"), particles)
        lammps(lines + "timestep 0.005\n" + dump("a.dump", 20) + "run 20\n")
        rho.append(lammps.frame("a.dump")["rho"][-len(drop):])
    assert np.ptp(rho[0]) > 1e-4
    assert relative(rho[1] - rho[0], rho[0]) < 1e-13


def test_relaxing_processes(lammps):
    """The diffusion does not strain a process that is at rest; energy stays of second order."""
    start = (header(2, "on", free(2), "sph/bulk relax 1") + "atom_modify map array\ncomm_modify vel yes\nregion B block -30 30 -30 30 -0.5 0.5\n"
             "create_box 1 B\nlattice sq 1\nregion C cylinder z 0 0 7.2 INF INF\ncreate_atoms 1 region C\nset group all mass 1\n"
             "pair_style sph/bulk density continuity\npair_coeff * * 1 10 0.02 0.3 3.2 relax 2 0.5\n"
             "variable r atom 1+0.01*random(0,1,34)\nset group all sph/rho v_r\nfix 1 all sph/bulk\n")
    lammps(start + dump("a.dump", extra="d_rho_relaxed1 d_vol_rate") + "timestep 1e-7\nrun 2\n")
    begin, _, end = lammps.frames("a.dump")
    change = end["rho"] / begin["rho"] - 1
    assert np.abs(change).max() > 1e-9 and np.abs(end["d_rho_relaxed1"] / end["rho"] - 1).max() < 1e-6 * np.abs(change).max() + 1e-14
    errors = []
    for steps in (200, 400, 800):
        result = lammps(start + "variable vx atom 0.05*x-0.03*y\nvariable vy atom -0.05*y+0.03*x\nvelocity all set v_vx v_vy 0\ncompute E all sph/energy\n"
                        f"thermo_style custom step c_E\nthermo_modify norm no format float %.15g\nthermo {steps}\ntimestep {4 / steps}\nrun {steps}\n")
        values = result.thermo()[0]["c_E"]
        errors.append(values[-1] - values[0])
    assert all(abs(a) > 3.3 * abs(b) for a, b in zip(errors, errors[1:])), errors


def test_fluid_that_enters_has_the_density_of_its_zone(lammps):
    """A stream between two zones, whose offsets differ from those of the fluid: the density stays that of the zones."""
    p = lattice(2, (30, 6))
    p.lo[0], p.hi[0] = -2.0, 32.0
    p.v[:, 0] = 0.5
    p.esph[:] = 0.0
    write(lammps.path("box.data"), p)
    groups = "region I block INF 8 INF INF INF INF\nregion O block 22 INF INF INF INF INF\ngroup in region I\ngroup out region O\ngroup fluid subtract all in out\n"
    base = text(2, "density continuity", "1.0 10.0 0.1 0.3 3.2", "f p p").replace("fix FLUID all", groups + "fix FLUID fluid")
    lammps(base + "fix I in sph/open fluid 8 0 0 1 0 0 8 velocity 0.5 0 0\nfix O out sph/open fluid 22 0 0 -1 0 0 8 pressure 0\n"
           + FIELDS + dump("a.dump", 600, WANTED) + "timestep 0.01\nrun 1200\n")
    last = lammps.frame("a.dump")
    inside = (last["x"][:, 0] > 8) & (last["x"][:, 0] < 22)
    entered = inside & (last["id"] > 30 * 6)
    assert entered.sum() >= 0 and inside.sum() > 70
    assert np.abs(last["rho"][inside] - 1).max() < 1e-3
    assert np.abs(last["v"][inside] - [0.5, 0, 0]).max() < 0.02
