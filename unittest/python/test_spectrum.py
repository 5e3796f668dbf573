"""compute sph/spectrum and sph/grid: plane waves, Parseval, numpy's FFT of the same grid, ranks, decay of modes, errors."""

import re
from math import pi

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import j0

from helpers import INTEGRATE, disordered, drop, fluid, free, header, relative
from spectrum_reference import COLUMNS, TOTALS, read_array, read_grid, spectra, wave_vectors

EXACT = 1e-12
FULL = "thermo_modify norm no format float %.17g\n"


def measure(count, keywords="", values="vx vy vz rho", order="", name="out"):
    """Input lines: the spectrum to files, and the fields of the same grid."""
    grid = " ".join(map(str, count))
    fields = len(values.split())
    return (f"compute S all sph/spectrum {grid} {keywords} {order}\ncompute G all sph/grid {grid} {values} {order}\n"
            f"compute P all property/grid {grid} {'ix iy iz' if count[2] > 1 else 'ix iy'}\n"
            f"fix S all ave/time 1 1 1 c_S[*] mode vector file {name}.spectrum format \" %.17g\"\n"
            f"dump G all grid 1 {name}.grid c_P:grid:data[*] "
            + ("" if count[2] > 1 else "c_G:grid:data[1] ")
            + ("c_G:grid:data" if fields == 1 else "c_G:grid:data[*]") + "\ndump_modify G format float %.17g\n"
            "thermo_style custom step c_S[*]\n" + FULL)


def totals_of(result):
    table = result.thermo()[-1]
    return {name: table[f"c_S[{k}]"][-1] for k, name in enumerate(TOTALS, 1)}


def box(dim, count):
    return tuple(count) if dim == 3 else (*count[:2], 1)


def set_wave(particles, k, direction, amplitude=1.0):
    particles.v[:] = amplitude * np.cos(particles.x @ k + 0.4)[:, None] * direction


# ---------------------------------------------------------------------------------------------
# known fields


@pytest.mark.parametrize("dim, cells, waves", [(3, 36, [(1, 0, 0), (1, 1, 0)]), (2, 64, [(1, 0, 0), (1, -2, 0)])])
@pytest.mark.parametrize("part", ["solenoidal", "dilatational"])
def test_plane_waves_on_jittered_particles(lammps, dim, cells, waves, part):
    """k h < 0.5, h half the support radius: energy of the wave within 1e-4, less than 1e-6 of it in the other part."""
    support = {2: 4.0, 3: 3.0}[dim]
    particles = disordered(dim, cells, jitter=0.2, spread=0.0)
    for wave in waves:
        k = 2 * pi / cells * np.array(wave, dtype=float)
        assert np.linalg.norm(k) * support / 2 < 0.5
        along = k / np.linalg.norm(k)
        across = np.array([-along[1], along[0], 0.0])
        set_wave(particles, k, across if part == "solenoidal" else along)
        particles.write(lammps.path("box.data"))
        result = lammps(header(dim) + "read_data box.data\n" + fluid(dim, support=support) + INTEGRATE
                        + measure(box(dim, [cells] * 3), "deconvolve yes") + "run 0\n")
        totals = totals_of(result)
        other = "dilatational" if part == "solenoidal" else "solenoidal"
        energy, leak = totals[part] / 0.25, totals[other] / totals[part]
        print(f"{dim}d {part} {wave}: energy {energy:.5f}, leak {leak:.1e}")
        assert energy == pytest.approx(1.0, abs=1e-4)
        assert leak < 1e-6
        (array,) = read_array(lammps.path("out.spectrum"))
        row = array[int(np.linalg.norm(wave) + 0.5)]
        width = 2 * pi / cells
        assert row[COLUMNS.index(part)] * width == pytest.approx(0.25, rel=0.01)
        square = totals["curl2" if part == "solenoidal" else "div2"]
        assert square == pytest.approx(0.5 * k @ k, rel=0.02)


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("order", [0, 1])
def test_uniform_and_linear_fields(lammps, dim, order):
    """Order 0 keeps a uniform field, order 1 also a linear one, to rounding errors; away from where the field jumps."""
    particles = disordered(dim, 12, jitter=0.2, spread=0.3)
    gradient = np.array([[0.3, -0.2, 0.5], [0.7, 0.1, -0.4], [-0.6, 0.2, 0.9]])
    gradient[:, dim:] = 0.0
    uniform = np.array([0.4, -1.3, 0.8 if dim == 3 else 0.0])
    centre = 0.5 * (particles.lo + particles.hi)
    for linear in (0.0, 1.0):
        particles.v = uniform + linear * (particles.x - centre) @ gradient.T
        if dim == 2:
            particles.v[:, 2] = 0.0
        particles.write(lammps.path("box.data"))
        lammps(header(dim) + "read_data box.data\n" + fluid(dim) + INTEGRATE
               + measure(box(dim, [10, 11, 9]), order=f"order {order}") + "run 0\n")
        length, field = read_grid(lammps.path("out.grid"))[-1]
        points = np.stack(np.meshgrid(*[(np.arange(n) + 0.5) / n * ell + lo for n, ell, lo
                                        in zip(field.shape, length, particles.lo)], indexing="ij"), axis=-1)
        expected = uniform + linear * (points - centre) @ gradient.T
        inside = (abs(points - centre) < 2.0)[..., :dim].all(axis=-1)
        error = abs(field[..., :dim] - expected[..., :dim])[inside].max()
        if linear and order == 0:
            assert error > 1e-3
        else:
            assert error < EXACT


# ---------------------------------------------------------------------------------------------
# the same as numpy


def random_box(dim, cells, seed=3):
    particles = disordered(dim, cells, seed=seed, jitter=0.2, spread=0.1)
    particles.v[:, :dim] += [0.3, -0.2, 0.1][:dim]
    return particles


@pytest.mark.parametrize("dim, cells, count", [(3, (10, 8, 6), (10, 8, 6)), (3, (10, 8, 6), (9, 7, 5)),
                                               (3, 7, (8, 8, 8)), (2, (14, 9), (14, 9, 1)), (2, (14, 9), (8, 13, 1))])
@pytest.mark.parametrize("deconvolve", ["no", "yes"])
def test_equal_to_numpy(lammps, dim, cells, count, deconvolve):
    """Array and totals from the dumped grid, boxes of unequal sides, even and odd numbers of points; Parseval."""
    random_box(dim, cells).write(lammps.path("box.data"))
    support = {2: 3.0, 3: 2.5}[dim]
    result = lammps(header(dim) + "read_data box.data\n" + fluid(dim, mu=0.7, kappa=3.0) + INTEGRATE
                    + measure(count, f"deconvolve {deconvolve}") + "run 0\n")
    length, field = read_grid(lammps.path("out.grid"))[-1]
    raised = None
    if deconvolve == "yes":
        def raised(k):
            values, where = np.unique(np.round(k, 10), return_inverse=True)
            factor = [1 / max(transform(dim, value * support), 0.5)**2 for value in values]
            return np.array(factor)[where].reshape(k.shape)
    array, totals = spectra(length, field, dim, raised)
    (found,) = read_array(lammps.path("out.spectrum"))
    assert found.shape == array.shape
    tolerance = EXACT if deconvolve == "no" else 1e-9    # rounded wave numbers, quadrature
    for column, name in enumerate(COLUMNS):
        assert relative(found[:, column] - array[:, column], array[:, column] if name != "spin" else 1.0) < tolerance, name
    sums = totals_of(result)
    for name, value in totals.items():
        assert sums[name] == pytest.approx(value, rel=tolerance), name
    assert sums["power_curl"] == pytest.approx(0.7 * totals["curl2"], rel=tolerance)
    assert sums["power_div"] == pytest.approx((3.0 + 2 * 0.7 * (1 - 1 / dim)) * totals["div2"], rel=tolerance)
    if deconvolve == "no":    # Parseval
        width = 2 * pi / length[:dim].max()
        energy = width * found[:, 2:4].sum()
        assert energy == pytest.approx(0.5 * (field[..., :3]**2).sum(axis=-1).mean(), rel=EXACT)
        assert width * found[:, 6].sum() == pytest.approx(
            0.5 * (field[..., 3] * (field[..., :3]**2).sum(axis=-1)).mean(), rel=EXACT)
        assert width * found[:, 5].sum() == pytest.approx((field[..., 3]**2).mean(), rel=EXACT)
        assert found[:, 1].sum() == np.prod(count)


def transform(dim, kr):
    """Fourier transform of Wendland C2 by adaptive quadrature."""
    norm = {2: 7 / pi, 3: 21 / (2 * pi)}[dim]

    def integrand(q):
        shell = 2 * pi * q * j0(kr * q) if dim == 2 else 4 * pi * q**2 * np.sinc(kr * q / pi)
        return norm * (1 - q)**4 * (1 + 4 * q) * shell
    return quad(integrand, 0, 1, epsabs=1e-13, epsrel=1e-13, limit=200)[0]


def test_order_0_and_shells(lammps):
    """order 0 against numpy; shells N keeps the first rows and all of the totals."""
    random_box(3, 8).write(lammps.path("box.data"))
    text = header(3) + "read_data box.data\n" + fluid(3) + INTEGRATE
    full = lammps(text + measure((8, 8, 8), "order 0", name="full").replace("vx vy vz rho", "vx vy vz rho order 0")
                  + "run 0\n")
    array, totals = spectra(*read_grid(lammps.path("full.grid"))[-1], 3)
    (found,) = read_array(lammps.path("full.spectrum"))
    assert relative(found[:, 2:] - array[:, 2:], array[:, 2:]) < EXACT
    some = lammps(text + measure((8, 8, 8), "order 0 shells 4", name="some") + "run 0\n")
    (rows,) = read_array(lammps.path("some.spectrum"))
    assert rows.shape == (5, len(COLUMNS))
    assert (rows == found[:5]).all()
    assert totals_of(some) == totals_of(full)


def test_spin(lammps):
    """The spin of a micropolar fluid has a column and a total."""
    text = (header(3, style="sph/micropolar") + "lattice sc 1.0\nregion box block 0 7 0 7 0 7\ncreate_box 1 box\n"
            "create_atoms 1 box\ndisplace_atoms all random 0.2 0.2 0.2 4711\nset group all mass 1.0\n"
            "variable wx atom sin(0.3*x+y)\nvariable wy atom 0.5+cos(x)\nvariable wz atom x*y/30\n"
            "set group all omega v_wx v_wy v_wz\nvelocity all set v_wy v_wz v_wx\n"
            "pair_style sph/micropolar\npair_coeff * * 1.0 10.0 0.5 2.0 0.05 0.02 0.01 2.5\n"
            "fix FLUID all sph/micropolar inertia 0.154 0.0\ntimestep 0.005\n")
    values = "vx vy vz rho omegax omegay omegaz"
    result = lammps(text + measure((7, 7, 7), values=values) + "run 0\n")
    array, totals = spectra(*read_grid(lammps.path("out.grid"))[-1], 3)
    (found,) = read_array(lammps.path("out.spectrum"))
    assert relative(found[:, 2:] - array[:, 2:], array[:, 2:]) < EXACT
    assert totals_of(result)["spin"] == pytest.approx(totals["spin"], rel=EXACT) and totals["spin"] > 0.1


@pytest.mark.parametrize("shear, bulk, kappa", [("mg", "none", 5 / 3 * 0.7), ("morris", "none", None),
                                                ("espanol", "density", 2.0)])
def test_viscosities_in_effect(lammps, shear, bulk, kappa):
    """Without a bulk term the bulk viscosity is that of the shear term."""
    random_box(3, 6).write(lammps.path("box.data"))
    kappa = kappa if kappa is not None else (2 / 3 - 1) * 0.7
    given = "intrinsic" if bulk == "none" else kappa
    result = lammps(header(3) + "read_data box.data\n" + fluid(3, f"shear {shear} bulk {bulk}", mu=0.7, kappa=given)
                    + INTEGRATE + measure((6, 6, 6)) + "run 0\n")
    totals = totals_of(result)
    assert totals["power_div"] == pytest.approx((kappa + 4 / 3 * 0.7) * totals["div2"], rel=EXACT)
    assert totals["power_curl"] == pytest.approx(0.7 * totals["curl2"], rel=EXACT)


def test_viscosities_that_are_not_constant(lammps):
    """The powers are 0, not those of the mu of pair_coeff; all else is as without the keyword."""
    random_box(3, 6).write(lammps.path("box.data"))
    text = header(3) + "read_data box.data\n" + fluid(3, mu=0.7) + INTEGRATE + measure((6, 6, 6)) + "run 0\n"
    plain = totals_of(lammps(text))
    found = totals_of(lammps(text.replace("fix ", "pair_coeff * * " + re.search(r"pair_coeff \* \* (.*)", text)[1] + " power 0.6 0.01 5\nfix ", 1)))
    assert plain["power_curl"] > 0.0 and plain["power_div"] > 0.0
    assert found == {**plain, "power_curl": 0.0, "power_div": 0.0}


# ---------------------------------------------------------------------------------------------
# ranks


RANKS = [(2, "", ""), (4, "", ""), (4, "processors 4 1 1\n", ""), (4, "processors 1 4 1\n", ""),
         (2, "", "comm_style tiled\nbalance 1.0 rcb\n"), (4, "", "comm_style tiled\nbalance 1.0 rcb\n"),
         (4, "processors 4 1 1\n", "balance 1.0 x 0.1 0.4 0.5\n")]


@pytest.fixture(scope="module")
def one_rank(shared_lammps):
    result = {}
    for dim, count in ((2, (11, 9, 1)), (3, (9, 10, 3)), (3, (9, 10, 8))):
        name = f"d{dim}n{count[2]}"
        random_box(dim, (12, 10, 9)[:dim]).write(shared_lammps.path(f"{name}.data"))
        totals = totals_of(shared_lammps(rank_input(name, dim, count)))
        result[name] = (dim, count, totals, read_array(shared_lammps.path(f"{name}.spectrum")),
                        read_grid(shared_lammps.path(f"{name}.grid"))[-1][1])
    return result


def rank_input(name, dim, count, before="", after=""):
    return (header(dim).replace("atom_style", f"{before}atom_style") + f"read_data {name}.data\n" + after
            + fluid(dim, mu=0.7) + INTEGRATE + measure(count, "deconvolve yes", name=name) + "run 5\n")


@pytest.mark.parametrize("name", ["d2n1", "d3n3", "d3n8"])
@pytest.mark.parametrize("ranks, before, after", RANKS + [(4, "processors 1 1 4\n", "")])
def test_the_same_on_any_ranks(lammps, one_rank, name, ranks, before, after):
    """Also where a sub-domain has fewer points than others, or none; and after five steps."""
    dim, count, totals, arrays, field = one_rank[name]
    if dim == 2 and "1 1 4" in before:
        pytest.skip("2d")
    random_box(dim, (12, 10, 9)[:dim]).write(lammps.path(f"{name}.data"))
    found = totals_of(lammps(rank_input(name, dim, count, before, after), ranks=ranks))
    for key, value in totals.items():
        assert found[key] == pytest.approx(value, rel=EXACT, abs=1e-300), key
    for mine, expected in zip(read_array(lammps.path(f"{name}.spectrum")), arrays):
        assert (abs(mine - expected) <= EXACT * abs(expected).max(axis=0)).all()
    assert relative(read_grid(lammps.path(f"{name}.grid"))[-1][1] - field, field) < EXACT


def test_rebalancing_in_a_run(lammps):
    """fix balance moves the sub-domains between two outputs."""
    particles = random_box(3, 10)
    particles = particles.where(np.random.default_rng(1).uniform(size=len(particles)) > 0.3 * particles.x[:, 0] / 10)
    particles.write(lammps.path("box.data"))
    text = (header(3) + "read_data box.data\n" + fluid(3) + INTEGRATE + "{}" + measure((9, 9, 9)) + "thermo 2\nrun 6\n")
    expected = lammps(text.format(""))
    found = lammps(text.format("fix B all balance 2 1.0 shift xy 5 1.0\n"), ranks=4)
    for name, values in expected.thermo()[-1].items():
        assert found.thermo()[-1][name] == pytest.approx(values, rel=1e-11, abs=1e-300), name


ALONE = "compute S all sph/spectrum 16 6 6 deconvolve yes\nthermo_style custom step c_S[*]\n" + FULL


@pytest.mark.parametrize("ranks, before, between", [(2, "processors 2 1 1\n", "balance 1.0 x 0.2\n"), (4, "", "replicate 1 1 4\n"),
                                                    (4, "processors 4 1 1\n", "balance 1.0 x 0.7 0.8 0.9\n"),
                                                    (3, "", "comm_style tiled\nbalance 1.0 rcb\n")])
def test_other_subdomains_after_the_command(lammps, ranks, before, between):
    """The points move to the processors that have the particles around them."""
    random_box(3, (16, 6, 6)).write(lammps.path("box.data"))
    text = (header(3).replace("atom_style", "{}atom_style") + "read_data box.data\n" + fluid(3) + INTEGRATE + ALONE + "{}run 2\n")
    one = totals_of(lammps(text.format("", between if "replicate" in between else "")))
    found = totals_of(lammps(text.format(before, between), ranks=ranks))
    for key, value in one.items():
        assert found[key] == pytest.approx(value, rel=EXACT, abs=1e-300), key


def test_rebalancing_far_in_a_run(lammps):
    """A border that moves by more than ghost particles reach; without another compute that asks for new grids."""
    particles = disordered(3, (16, 6, 6), spread=0.0)
    particles = particles.where((np.random.default_rng(1).uniform(size=len(particles)) > 0.5) | (particles.x[:, 0] < 4.0))
    particles.write(lammps.path("box.data"))
    text = (header(3).replace("atom_style", "{}atom_style") + "read_data box.data\n" + fluid(3) + INTEGRATE + "{}" + ALONE
            + "thermo 3\nrun 6\n")
    one = lammps(text.format("", "")).thermo()[-1]
    found = lammps(text.format("processors 2 1 1\n", "balance 1.1 x 0.8\nfix B all balance 3 1.0 shift x 10 1.0\n"), ranks=2).thermo()[-1]
    for name, values in one.items():
        assert found[name] == pytest.approx(values, rel=1e-11, abs=1e-300), name


@pytest.mark.parametrize("ranks, processors", [(2, ""), (4, "processors 1 4 1\n"), (3, "")])
def test_box_that_changes(lammps, ranks, processors):
    """fix deform moves the particles after the forces; those of other processors and the images have to follow."""
    random_box(3, (16, 6, 6)).write(lammps.path("box.data"))
    text = (header(3).replace("atom_style", "{}atom_style") + "read_data box.data\n" + fluid(3) + INTEGRATE + ALONE
            + "fix D all deform 1 x erate 2.0 y scale 0.8 z volume remap x\nthermo 5\nrun 10\n")
    one, found = lammps(text.format("")).thermo()[-1], lammps(text.format(processors), ranks=ranks).thermo()[-1]
    for name, values in one.items():
        assert found[name] == pytest.approx(values, rel=1e-11, abs=1e-300), name


@pytest.mark.parametrize("options, support", [("", 2.8), ("kernel wendland/c6", 2.5)])
def test_kernel_that_changes_between_runs(lammps, options, support):
    """What deconvolve undoes is the kernel of the run."""
    random_box(3, (16, 6, 6)).write(lammps.path("box.data"))
    start = header(3) + "read_data box.data\n{}" + INTEGRATE + ALONE + "run 0\n"
    new = fluid(3, options, support=support)
    expected = totals_of(lammps(start.format(new)))
    found = totals_of(lammps(start.format(fluid(3, support=2.2)) + new + "run 0\n"))
    for key, value in expected.items():
        assert found[key] == pytest.approx(value, rel=EXACT, abs=1e-300), key


# ---------------------------------------------------------------------------------------------
# grid output


@pytest.mark.parametrize("dim", [2, 3])
def test_free_surface(lammps, dim):
    """Outside of a drop, order 1 does not extrapolate to any size."""
    drop(dim, 4).write(lammps.path("box.data"))
    lammps(header(dim, boundary=free(dim)) + "read_data box.data\n" + fluid(dim) + INTEGRATE
           + f"compute G all sph/grid 40 40 {40 if dim == 3 else 1} vx rho\ndump G all grid 1 out.grid c_G:grid:data[*]\n"
           "dump_modify G format float %.17g\n" + "dump D all custom 1 out.dump vx\nrun 0\n")
    field = np.array([line.split() for line in lammps.path("out.grid").read_text().split("GRID CELLS")[1].splitlines()[1:]], dtype=float)
    most = abs(lammps.frame("out.dump")["vx"]).max()
    print(f"{dim}d: {abs(field[:, 0]).max():.2f} of {most:.2f}, density up to {field[:, 1].max():.2f}")
    assert 0.5 * most < abs(field[:, 0]).max() < 2.0 * most
    assert field[:, 1].max() < 2.0


def test_fix_ave_grid(lammps):
    """The mean of two steps by fix ave/grid is that of two dumps."""
    random_box(3, 6).write(lammps.path("box.data"))
    lammps(header(3) + "read_data box.data\n" + fluid(3) + INTEGRATE + measure((6, 6, 6), values="rho")
           + "fix A all ave/grid 1 2 2 6 6 6 c_G:grid:data\ndump A all grid 2 mean.grid c_P:grid:data[*] f_A:grid:data\n"
           "dump_modify A format float %.17g\nrun 2\n")
    frames = [frame for _, frame in read_grid(lammps.path("out.grid"))]
    mean = read_grid(lammps.path("mean.grid"))[-1][1]
    assert relative(mean - 0.5 * (frames[1] + frames[2]), mean) < EXACT


def test_points_without_particles_are_zero(lammps):
    """sph/grid in a box with a drop: inside the fields, outside zero; internal energy per volume."""
    particles = disordered(3, 6, jitter=0.1, spread=0.0)
    particles.v[:] = (1.0, 2.0, 3.0)
    particles.lo, particles.hi = np.full(3, -10.0), np.full(3, 16.0)
    particles.write(lammps.path("box.data"))
    lammps(header(3, boundary="f f f") + "read_data box.data\n" + fluid(3) + INTEGRATE
           + "compute G all sph/grid 13 13 13 vx esph vz\ncompute P all property/grid 13 13 13 ix iy iz\n"
           "dump G all grid 1 out.grid c_P:grid:data[*] c_G:grid:data[*]\ndump_modify G format float %.17g\nrun 0\n")
    field = read_grid(lammps.path("out.grid"))[-1][1]
    assert (field[0] == 0.0).all()
    assert field[6, 6, 6] == pytest.approx([1.0, 5.0, 3.0], rel=0.15)
    assert field[6, 6, 6, 0] == pytest.approx(1.0, rel=EXACT)


@pytest.mark.parametrize("dim", [2, 3])
def test_group(lammps, dim):
    """Only particles of the group count."""
    particles = disordered(dim, 8, jitter=0.1)
    particles.v[:] = np.where(np.arange(len(particles)) % 2, 1.0, -2.0)[:, None]
    particles.write(lammps.path("box.data"))
    grid, place = ("6 6 6", "ix iy iz") if dim == 3 else ("6 6 1", "ix iy ix")
    lammps(header(dim) + "read_data box.data\nvariable odd atom id%2\ngroup half variable odd\n" + fluid(dim) + INTEGRATE
           + f"compute G half sph/grid {grid} vx\ncompute P all property/grid {grid} {place}\n"
           "dump G all grid 1 out.grid c_P:grid:data[*] c_G:grid:data\ndump_modify G format float %.17g\nrun 0\n")
    assert abs(read_grid(lammps.path("out.grid"))[-1][1] + 2.0).max() < EXACT


# ---------------------------------------------------------------------------------------------
# cost


@pytest.mark.parametrize("dim, keywords, per_point", [(3, "deconvolve yes", 264), (3, "", 256), (3, "order 0", 184),
                                                      (2, "deconvolve yes", 232)])
@pytest.mark.parametrize("ranks", [1, 4])
def test_memory(lammps, dim, keywords, per_point, ranks):
    """Bytes per point of the grid on the processor that owns it, as the page counts them; next to none before the first use."""
    disordered(dim, {3: 12, 2: 30}[dim]).write(lammps.path("box.data"))
    counts = [(18, 18, 18), (36, 36, 36)] if dim == 3 else [(150, 150, 1), (300, 300, 1)]
    used = []
    for count in counts:
        text = (header(dim) + "read_data box.data\n" + fluid(dim) + INTEGRATE + "run 0\n"
                + f"compute S all sph/spectrum {' '.join(map(str, count))} {keywords}\nrun 0\n"
                "thermo_style custom step c_S[1]\nrun 0\nrun 0\n")
        log = lammps(text, ranks=ranks).log
        before, idle, _, after = [2**20 * float(found) for found in re.findall(r"Per MPI.*\| (\S+) \| \S+ Mbytes", log)]
        print(f"{count}: {before:.4g} bytes, idle {idle - before:.4g}, used {after - before:.4g}")
        assert idle - before < 0.4 * (after - before)
        used.append(after - before)
    points = [np.prod(count) / ranks for count in counts]
    found = (used[1] - used[0]) / (points[1] - points[0])
    print(f"{found:.1f} bytes per point")
    assert per_point * 0.99 < found < 1.01 * (per_point + (0 if ranks == 1 else 24))    # buffers of the FFT


def test_time(lammps):
    """A spectrum takes less time than ten steps without vector loops, which it does not have either: processor time, the smallest of two runs."""
    disordered(3, 16).write(lammps.path("box.data"))
    text = (header(3) + "read_data box.data\n" + fluid(3, "simd none", support=4.0) + INTEGRATE + "run 10\n"
            "compute S all sph/spectrum 16 16 16 deconvolve yes\nfix S all ave/time 1 1 1 c_S[1]\nrun 10\n")
    steps, both = [], []
    for _ in range(2):
        log = lammps(text).log
        loops = re.findall(r"Loop time of (\S+)", log)
        use = re.findall(r"(\S+)% CPU use", log)
        for times, loop, share in zip((steps, both), loops, use):
            times.append(float(loop) * float(share) / 100 / 10)
    step, spectrum = min(steps), min(both) - min(steps)
    print(f"step {step:.4f} s, spectrum {spectrum:.4f} s: {spectrum / step:.1f} steps")
    assert spectrum < 10 * step


# ---------------------------------------------------------------------------------------------
# physics: each mode decays with its own rate


@pytest.mark.parametrize("part", ["solenoidal", "dilatational"])
def test_modes_decay(lammps, part):
    """Random fields of small amplitude: nu k^2, and Gamma k^2 = (lambda + 2 mu)/(2 rho) k^2, each mode within 3 %."""
    cells, support, mu, kappa, c0 = 110, 5.0, 1.0, 4.0, 10.0
    k0 = 2 * pi / cells
    modes = [(1, 0), (0, 1), (1, 1), (1, -1), (2, 0), (0, 2)]
    assert 2 * k0 * support / 2 < 0.3
    random = np.random.default_rng(7)
    particles = disordered(2, cells, jitter=0.0, spread=0.0, speed=0.0)
    particles.esph[:] = 0.0
    for mode in modes:
        k = k0 * np.array([*mode, 0.0])
        along = k / np.linalg.norm(k)
        direction = along if part == "dilatational" else np.array([-along[1], along[0], 0.0])
        particles.v += (1e-3 * random.uniform(0.5, 1.0)
                        * np.cos(particles.x @ k + random.uniform(0, 2 * pi))[:, None] * direction)
    particles.write(lammps.path("box.data"))
    viscosity = mu if part == "solenoidal" else 0.5 * (kappa + mu)
    steps, dt = 500, 0.1
    lammps(header(2) + "read_data box.data\n" + fluid(2, mu=mu, kappa=kappa, c0=c0, support=support)
           + "fix FLUID all sph/bulk\n" + f"timestep {dt}\n" + measure((cells, cells, 1)).replace("grid 1 ", f"grid {steps // 10} ", 1)
           .replace("ave/time 1 1 1", f"ave/time {steps} 1 {steps}") + f"thermo {steps}\nrun {steps}\n")
    amplitude = {mode: [] for mode in modes}
    for _, field in read_grid(lammps.path("out.grid")):
        hat = np.fft.fft2(field[:, :, 0, [0, 1, 3]], axes=(0, 1)) / cells**2
        for mode in modes:
            u, v, rho = hat[mode]
            k = np.array(mode) / np.linalg.norm(mode)
            if part == "solenoidal":
                amplitude[mode].append(abs(-k[1] * u + k[0] * v))
            else:    # with the density the energy of a sound wave, which does not oscillate
                w = c0
                amplitude[mode].append(np.hypot(abs(k[0] * u + k[1] * v), abs(w * rho)))
    time = steps // 10 * dt * np.arange(11)
    for mode in modes:
        rate = -np.polyfit(time, np.log(amplitude[mode]), 1)[0]
        ratio = rate / (viscosity * k0**2 * (mode[0]**2 + mode[1]**2))
        print(f"{part} {mode}: rate over theory {ratio:.4f}")
        assert ratio == pytest.approx(1.0, abs=0.03)


# ---------------------------------------------------------------------------------------------
# errors


def start(dim=3, more="", boundary="p p p"):
    return header(dim, boundary=boundary) + "read_data box.data\n" + fluid(dim) + INTEGRATE + more


ERRORS = [
    ("compute S all sph/spectrum 8 8", "Illegal compute sph/spectrum command: missing argument"),
    ("compute S all sph/spectrum 8 8 0", "at least one point per direction"),
    ("compute S all sph/spectrum 8 8 8 shells", "missing argument"),
    ("compute S all sph/spectrum 8 8 8 shells 0", "shells must be at least 1"),
    ("compute S all sph/spectrum 8 8 8 order 2", "order must be 0 or 1"),
    ("compute S all sph/spectrum 8 8 8 nonsense 2", "Unknown compute sph/spectrum keyword: nonsense"),
    ("compute S all sph/spectrum 8 8 8 deconvolve maybe", "Expected boolean parameter instead of 'maybe'"),
    ("compute S all sph/spectrum 8 8 8 shells 5\nrun 0", "the grid is too coarse for 5 shells, it has 4"),
    ("compute S all sph/grid 8 8 8", "needs at least one value"),
    ("compute S all sph/grid 8 8 8 vx nonsense", "Unknown compute sph/grid keyword: nonsense"),
    ("compute S all sph/grid 8 8 8 vx order 0 vy", "Unknown compute sph/grid keyword: vy"),
    ("compute S all sph/grid 8 8 8 omegax", "requires atom style sph/micropolar"),
    ("pair_style none\ncompute S all sph/grid 8 8 8 vx\nrun 0", "requires pair style sph/bulk or sph/micropolar"),
    ("compute S all sph/spectrum 8 8 8\nvariable s equal c_S[1]\nrun 0\n"
     "delete_atoms random count 1 yes all NULL 4711\nprint $s", "use run 0 first"),
    ("group one id 1\ncompute S one sph/spectrum 8 8 8\nthermo_style custom step c_S[1]\nrun 0",
     "points of the grid have no particle in reach"),
    ("change_box all triclinic\ncompute S all sph/spectrum 8 8 8\nrun 0", "needs an orthogonal box"),
    ("compute S all sph/spectrum 8 8 8\nchange_box all triclinic\nrun 0", "needs an orthogonal box"),
    ("compute S all sph/grid 8 8 8 vx\nchange_box all triclinic\nrun 0", "needs an orthogonal box"),
    ("compute S all sph/spectrum 8 8 8\nchange_box all boundary p p f\nrun 0", "periodic in all directions"),
]


@pytest.mark.parametrize("commands, message", ERRORS)
@pytest.mark.parametrize("ranks", [1, 2])
def test_errors(lammps, commands, message, ranks):
    disordered(3, 8).write(lammps.path("box.data"))
    result = lammps(start(3, commands + "\n"), ranks=ranks, check=False)
    assert result.code == 1
    assert message in " ".join(result.error.split()), result.output[-2000:]


def test_errors_of_the_setup(lammps):
    disordered(2, 8).write(lammps.path("box.data"))
    result = lammps(start(2, "compute S all sph/spectrum 8 8 8\n"), check=False)
    assert "Nz must be 1 in 2d" in result.error
    disordered(1, 8).write(lammps.path("box.data"))
    result = lammps(start(1, "compute S all sph/spectrum 8 1 1\nrun 0\n"), check=False)
    assert "needs a kernel of the dimension of the simulation, not dim 1" in " ".join(result.error.split())
    result = lammps("region b block 0 1 0 1 0 1\ncreate_box 1 b\ncompute S all sph/grid 8 8 8 vx\n", check=False)
    assert "requires atom style sph/bulk or sph/micropolar" in result.error
    result = lammps("atom_style sph/bulk\ncompute S all sph/spectrum 8 8 8\n", check=False)
    assert "requires a simulation box" in result.error
    particles = disordered(3, 8, ntypes=2)
    particles.write(lammps.path("box.data"))
    two = fluid(3, coeff="pair_coeff 1 1 1.0 10.0 0.5 2.0 2.5\npair_coeff 2 2 1.0 10.0 0.7 2.0 2.5\n")
    result = lammps(header(3) + "read_data box.data\n" + two + INTEGRATE
                    + "compute S all sph/spectrum 8 8 8\nthermo_style custom step c_S[1]\nrun 0\n", check=False)
    assert "needs one viscosity, but mu is from 0.5 to 0.7" in " ".join(result.error.split())


def test_warning_about_a_grid_finer_than_the_particles(lammps):
    disordered(3, 8).write(lammps.path("box.data"))
    text = start(3, "compute S all sph/spectrum {0} 8 8\nthermo_style custom step c_S[1]\nrun 0\nrun 0\n")
    assert not any("points for" in line for line in lammps(text.format(8)).warnings)
    warnings = [line for line in lammps(text.format(9)).warnings if "points for" in line]
    assert len(warnings) == 1 and "576 points for 512 particles" in warnings[0]
