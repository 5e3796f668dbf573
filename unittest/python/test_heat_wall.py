"""Heat at walls of fix sph/wall: a reference, flat walls with known temperatures and fluxes, friction, energy, ranks, files, bad input."""

import re

import numpy as np
import pytest

import wall_reference as ref
from helpers import SUPPORT, disordered, dump, header, lattice, relative
from test_micropolar import write as write_micropolar
from test_wall import groups, odd_shapes

FULL = "thermo_modify norm no format float %.17g\n"
TEMPERATURE = "compute T all property/atom tsph\n"


# ---------------------------------------------------------------------------------------------
# heating of a fluid at rest against sums over all pairs of a set of particles

FLUIDS = [dict(rho0=1.0, cv=2.0, k=0.7), dict(rho0=1.1, cv=1.2, k=2.3)]


def coefficients(style, fluids, R):
    spin = " 0.1 0.02 -0.02" if style == "sph/micropolar" else ""
    return "".join(f"pair_coeff {i} {i} {one['rho0']} 10.0 0.5 2.0{spin} {R} cv {one['cv']}"
                   + (f" conductivity {one['k']}" if one["k"] else "") + "\n" for i, one in enumerate(fluids, 1))


def lattice_sums(dim, R, spacing):
    """Sums of V W and of V F r^2/n over a cubic lattice."""
    if dim == 1:
        q = np.arange(-int(R / spacing), int(R / spacing) + 1) * spacing / R
        a = np.abs(q)
        return spacing * (1.5 / R * (1 - a) ** 4 * (1 + 4 * a)).sum(), spacing * (1.5 / R**3 * 20 * (1 - a) ** 3 * (q * R) ** 2).sum()
    model = ref.Model(dim, [], R)
    reach = np.arange(-int(R / spacing) - 1, int(R / spacing) + 2) * spacing
    r = np.linalg.norm(np.stack(np.meshgrid(*[reach] * dim)), axis=0)
    W, F = model.kernel_at(r)
    return spacing**dim * W.sum(), spacing**dim * (F * r * r).sum() / dim


def crossing(curvature, depth, up, dist):
    """Projection of the way from a wall particle to the fluid on the normal where it crosses the surface; up: on that of the particle."""
    if curvature <= 0.0:
        return up + 0.5 * curvature * (dist**2 - up**2)
    radius = 1.0 / curvature  # of the place of the wall particle on a sphere
    a, b, c = dist**2, radius * up, radius**2 - (radius + depth) ** 2  # where |radius normal + part way| = radius + depth
    part = np.minimum((-b + np.sqrt(b**2 - a * c)) / a, 1.0)
    return (radius * up + part * dist**2) / (radius + depth)


def heating(particles, owner, fluids, T, walls, volume="number"):
    """Heat per time from the particle j to the particle i; walls: ("temp" or "flux", value by particle) or None for each wall."""
    dim, R = particles.dim, SUPPORT[particles.dim]
    model = ref.Model(dim, [], R)
    of = {key: np.array([fluids[t - 1][key] for t in particles.type]) for key in fluids[0]}
    solid = owner >= 0
    wet = ~solid
    r = particles.x[:, None] - particles.x
    length = particles.hi - particles.lo
    r -= length * np.round(r / length)
    dist = np.linalg.norm(r, axis=2)
    W, F = model.kernel_at(dist)
    np.fill_diagonal(F, 0.0)
    F[np.ix_(solid, solid)] = 0.0
    w = particles.mass / of["rho0"] if volume == "mass" else np.ones(len(owner))
    V = w / (W @ w)
    cell = particles.mass / of["rho0"]
    density = cell / V
    weight = np.where(wet, V * W, 0.0)
    seen = solid & (weight.sum(axis=1) > 0.0)
    V[seen] = cell[seen] * weight.sum(axis=1)[seen] / (weight @ (density * wet))[seen]
    normal, depth, below_planes = ref.surface_of(model, -r, dist, F, solid, wet, cell)

    weight = np.where(of["k"] > 0.0, weight, 0.0)
    k, T = np.where(wet, of["k"], 0.0), np.where(wet, T, 0.0)
    flow = np.zeros_like(F)
    for wall, heat in enumerate(walls):
        for i in np.flatnonzero((owner == wall) & (weight.sum(axis=1) > 0.0)):
            if heat is None:
                continue
            kind, value = heat[0], np.broadcast_to(heat[1], len(owner))[i]
            near, spacing = np.flatnonzero(weight[i]), cell[i] ** (1 / dim)
            if kind == "flux":
                zeroth, second = lattice_sums(dim, R, spacing)
                up = r[near, i] @ normal[i]
                turn = ref.curvature(-r[i], dist[i], normal[i], normal, solid, R, spacing)
                got = 2 * value * V[near] * cell[i] * zeroth / second * F[i, near] * crossing(turn, below_planes[i], up, dist[i, near])
                flow[near, i] += got
                flow[i, near] -= got
                continue
            share = weight[i, near] / weight[i].sum()
            d = np.maximum(-r[i, near] @ normal[i] - depth[i], 0.25 * spacing)
            d = d * max(0.45 * spacing / (share @ d), 1.0)
            T[i] = value + ref.beyond("zero", depth[i], d, T[near] - value, share)[0]
            k[i] = share @ of["k"][near]
    mean = np.divide(2 * k[:, None] * k, k[:, None] + k, out=np.zeros_like(F), where=k[:, None] * k > 0.0)
    return flow + 2 * mean * F * V[:, None] * V * (T - T[:, None])


@pytest.mark.parametrize("newton, ranks", [("on", 1), ("on", 4), ("off", 2)])
@pytest.mark.parametrize("dim, style, volume, second", [(2, "sph/bulk", "number", 2.3), (2, "sph/bulk", "mass", 0.0), (3, "sph/bulk", "number", 0.7),
                                                        (2, "sph/micropolar", "mass", 2.3)])
def test_dense_reference(lammps, dim, style, volume, second, newton, ranks):
    """Two fluids, one of which may not conduct, around a body with temperatures by place and a ragged floor with a flux."""
    particles, owner = odd_shapes(dim)
    particles.v[:] = 0.0
    fluids = [FLUIDS[0], dict(FLUIDS[1], k=second)]
    if style == "sph/bulk":
        particles.write(lammps.path("box.data"))
    else:
        write_micropolar(particles, lammps.path("box.data"), np.zeros_like(particles.x))
    text = (header(dim, newton, style=style) + "read_data box.data\n" + groups(owner) + f"pair_style {style} volume {volume}\n"
            + coefficients(style, fluids, SUPPORT[dim]) + "variable T atom 2.0+0.1*x+0.05*y\nvariable H atom 3.0+0.2*x\nvariable Q equal 0.4+0.1\n"
            f"fix FLUID fluid {style} temperature v_T\nfix W0 wall0 sph/wall heat temp v_H\nfix W1 wall1 sph/wall heat flux v_Q\n"
            "thermo_style custom step f_W0[7] f_W1[7] f_W0[8] f_W1[8]\n" + FULL)
    (table,) = lammps(text + dump("f.dump") + "run 0\n", ranks=ranks).thermo()
    x = particles.x
    flow = heating(particles, owner, fluids, 2.0 + 0.1 * x[:, 0] + 0.05 * x[:, 1], [("temp", 3.0 + 0.2 * x[:, 0]), ("flux", 0.5)], volume)
    rate = lammps.frame("f.dump")["desph"]
    # with a single conducting neighbor, the fit behind the surface divides by 0.01 of its terms, and multiplies by (depth/d)^2: round-off, too
    bound = 2e-13 if second else 1.5e-11
    assert relative((rate - flow.sum(axis=1))[owner < 0], flow.sum(axis=1)) < bound
    scale = np.abs(flow.sum(axis=1)).sum()
    for wall in (0, 1):
        given = -flow[owner == wall].sum()
        assert abs(given) > 1e-3 * scale
        assert table[f"f_W{wall}[7]"][0] == pytest.approx(given, abs=0.1 * bound * scale)
        assert table[f"f_W{wall}[8]"][0] == 0.0


# ---------------------------------------------------------------------------------------------
# flat walls


def channel(lammps, N, wide=4, R=None, dim=2, fluids="pair_coeff * * 1.0 10.0 1.0 2.0 {R} cv 1.0 conductivity 1.0\n", low="", high="", T="1.0",
            form="shear morris", hold=True, extra=""):
    """Fluid at rest between walls at y = 0 and y = 1 (dim 1: x), N particles across; everything up to the run."""
    dx = 1.0 / N
    R = (R or SUPPORT[dim]) * dx
    layers = int(np.ceil(R / dx))
    cells = (N + 2 * layers,) if dim == 1 else (wide, N + 2 * layers)
    particles = lattice(dim, cells, dx)
    across = 0 if dim == 1 else 1
    for place in (particles.x[:, across], particles.lo[across:across + 1], particles.hi[across:across + 1]):
        place -= layers * dx
    particles.mass[:] = dx**dim
    particles.esph[:] = 0.0
    axis = "xy"[across]
    particles.write(lammps.path("box.data"), ntypes=2)
    below, above = ("INF 0", "1 INF") if dim == 1 else ("INF INF INF 0", "INF INF 1 INF")
    rest = " INF INF INF INF" if dim == 1 else " INF INF"
    return (header(dim, boundary="f p p" if dim == 1 else "p f p") + "read_data box.data\n"
            f"region LOW block {below}{rest} units box\nregion HIGH block {above}{rest} units box\ngroup low region LOW\ngroup high region HIGH\n"
            "group wall union low high\ngroup fluid subtract all wall\n"
            f"variable s atom {axis}\nset group all type 1\n{extra}pair_style sph/bulk dim {dim} {form}\n{fluids.format(R=R)}"
            f"variable T atom {T}\nfix FLUID fluid sph/bulk temperature v_T\n" + ("fix HOLD all setforce 0 0 0\n" if hold else "")
            + f"fix LOW low sph/wall {low}\nfix HIGH high sph/wall {high}\n" + TEMPERATURE
            + "compute E all property/atom esph\ncompute SUM fluid reduce sum c_E\n")


def across(frame, dim=2):
    """Places and temperatures of the fluid."""
    s = frame["x"][:, 0 if dim == 1 else 1]
    wet = (s > 0.0) & (s < 1.0)
    return s[wet], frame["c_T"][wet]


@pytest.mark.parametrize("dim, R", [(1, 4.0), (2, 3.0), (2, 4.5)])
def test_straight_profile_is_steady(lammps, dim, R):
    """Between walls of the temperatures 1 and 3; each gives what passes any plane."""
    text = channel(lammps, 10, R=R, dim=dim, low="heat temp 1.0", high="heat temp 3.0", T="1.0+2.0*v_s")
    (table,) = lammps(text + "thermo_style custom step f_LOW[7] f_HIGH[7]\n" + FULL + dump("f.dump") + "run 0\n").thermo()
    frame = lammps.frame("f.dump")
    flux = table["f_HIGH[7]"][0]
    s = frame["x"][:, 0 if dim == 1 else 1]
    assert np.abs(frame["desph"][(s > 0.0) & (s < 1.0)]).max() < 1e-4 * flux  # the place of the surface is that good
    assert table["f_LOW[7]"][0] == pytest.approx(-flux, rel=1e-12)
    zeroth, second = lattice_sums(dim, R, 1.0)
    width = {1: 1.0, 2: 0.4}[dim]
    assert flux == pytest.approx(2.0 * width * second / zeroth**2, rel=1e-4)  # volumes are 1/c


def test_slab_relaxes_to_the_straight_profile(lammps):
    text = channel(lammps, 10, dim=1, low="heat temp 1.0", high="heat temp 3.0", T="2.5")
    lammps(text + dump("f.dump", 2000, "c_T") + "timestep 0.002\nrun 2000\n")
    s, T = across(lammps.frame("f.dump"), 1)
    assert np.abs(T - 1.0 - 2.0 * s).max() < 1e-5


def test_second_order(lammps):
    """The slowest temperature wave between walls: its rate."""
    error = []
    zeroth, second = lattice_sums(1, 4.0, 1.0)
    for N in (8, 16, 32):
        text = channel(lammps, N, dim=1, low="heat temp 1.0", high="heat temp 1.0", T="1.0+0.5*sin(PI*v_s)")
        dt = 0.05 / N**2
        steps = [round(t / dt) for t in (0.05, 0.1)]
        lammps(text + dump("f.dump", 1, "c_T") + f"dump_modify D every {steps[0]}\ntimestep {dt}\nrun {steps[1]}\n")
        a, b = (across(frame, 1)[1] - 1.0 for frame in lammps.frames("f.dump")[-2:])
        rate = np.log(a.sum() / b.sum()) / (dt * (steps[1] - steps[0]))
        error.append(abs(rate / (np.pi**2 * second / zeroth**2) - 1.0))
    print(error)
    assert error[0] < 0.06 and error[1] < 0.35 * error[0] and error[2] < 0.35 * error[1]


def test_slab_of_two_materials(lammps):
    """The flux of two layers between walls, and the temperature where they touch."""
    k1, k2, N = 1.0, 0.25, 24
    fluids = f"pair_coeff 1 1 1.0 10.0 1.0 2.0 {{R}} cv 0.25 conductivity {k1}\npair_coeff 2 2 1.0 10.0 1.0 2.0 {{R}} cv 0.25 conductivity {k2}\n"
    text = channel(lammps, N, dim=1, fluids=fluids, low="heat temp 1.0", high="heat temp 2.0", T="1.5",
                   extra="variable upper atom x>0.5\ngroup upper variable upper\nset group upper type 2\n")
    flux = 1.0 / (0.5 / k1 + 0.5 / k2)
    (table,) = lammps(text + "thermo_style custom step f_LOW[7] f_HIGH[7]\nthermo 10000\n" + FULL + dump("f.dump", 10000, "c_T")
                      + "timestep 0.0001\nrun 10000\n").thermo()
    assert table["f_HIGH[7]"][-1] == pytest.approx(-table["f_LOW[7]"][-1], rel=1e-3)
    zeroth, second = lattice_sums(1, 4.0, 1.0)
    assert table["f_HIGH[7]"][-1] * zeroth**2 / second == pytest.approx(flux, rel=0.01)
    s, T = across(lammps.frame("f.dump"), 1)
    exact = np.where(s < 0.5, 1.0 + flux * s / k1, 2.0 - flux * (1.0 - s) / k2)
    assert np.abs(T - exact).max() < 0.01


@pytest.mark.parametrize("dim, R", [(1, 4.0), (2, 3.0), (2, 4.2)])
def test_flux(lammps, dim, R):
    """Of a heated and a cooled wall: energy to rounding errors, and the parabola of a slab that both warm."""
    width = {1: 1.0, 2: 0.4}[dim]
    text = channel(lammps, 10, R=R, dim=dim, low="heat flux 0.5", high="heat flux v_Q", T="1.0", extra="variable Q equal 0.2+0.1\n")
    (table,) = lammps(text + "thermo_style custom step c_SUM f_LOW[7] f_LOW[8] f_HIGH[8]\n" + FULL + "thermo 200\n" + dump("f.dump", 600, "c_T")
                      + "timestep 0.001\nrun 600\n").thermo()
    t = 0.001 * table["Step"]
    assert np.abs(table["f_LOW[7]"] - 0.5 * width).max() < 1e-13
    assert np.abs(table["f_LOW[8]"] - 0.5 * width * t).max() < 1e-13 and np.abs(table["f_HIGH[8]"] - 0.3 * width * t).max() < 1e-13
    assert np.abs(table["c_SUM"] - table["c_SUM"][0] - 0.8 * width * t).max() < 1e-12
    s, T = across(lammps.frame("f.dump"), dim)
    profile = 0.5 * (1 - s) ** 2 / 2 + 0.3 * s**2 / 2
    assert np.abs((T - T.mean()) - (profile - profile.mean())).max() < 0.01


@pytest.mark.parametrize("shape", ["hexagonal", "cup", "cubic"])
def test_flux_through_other_surfaces(lammps, shape):
    """Area of a wall of another lattice, of a cylinder, of a wall in three dimensions."""
    box = {"hexagonal": "lattice hex 1.1547005383792517\nregion BOX block 0 12 0 12 -0.5 0.5\n",
           "cup": "lattice sq 1.0\nregion BOX block 0 48 0 48 -0.5 0.5 units box\n",
           "cubic": "lattice sc 1.0\nregion BOX block 0 6 0 16 0 6\n"}[shape]
    solid = {"hexagonal": "region SOLID block INF INF 3 9 INF INF side out\n", "cup": "region SOLID cylinder z 24 24 20 INF INF side out units box\n",
             "cubic": "region SOLID block INF INF 3 13 INF INF side out\n"}[shape]
    dim = 3 if shape == "cubic" else 2
    table = lammps(f"units lj\ndimension {dim}\natom_style sph/bulk\n" + box + "create_box 1 BOX\ncreate_atoms 1 box\n" + solid +
                   f"set group all mass {0.8660254037844386 if shape == 'hexagonal' else 1.0}\ngroup solid region SOLID\ngroup fluid subtract all solid\n"
                   f"pair_style sph/bulk dim {dim}\npair_coeff 1 1 1.0 10.0 0.5 2.0 3.0 cv 1.0 conductivity 1.0\n"
                   "fix FLUID fluid sph/bulk temperature 1.0\nfix WALL solid sph/wall heat flux 1.0\nthermo_style custom step f_WALL[7] lx\n"
                   + FULL + "run 0\n").thermo()[0]
    area = {"hexagonal": 2 * table["Lx"][0], "cup": 2 * np.pi * 20.0, "cubic": 72.0}[shape]
    ratio = table["f_WALL[7]"][0] / area
    print(shape, ratio)
    assert abs(ratio - 1.0) < {"hexagonal": 0.005, "cup": 0.012, "cubic": 1e-12}[shape]


@pytest.mark.parametrize("dim, radius, error", [(2, 4.1, 0.012), (2, 3.1, 0.012), (2, 2.2, 0.022), (3, 4.1, 0.012), (3, 3.1, 0.035)])
def test_flux_of_small_bodies(lammps, dim, radius, error):
    """Area of discs and spheres of few spacings, whose size is that of their particles."""
    depth, where = ("-0.5 0.5", "lattice sq 1.0 origin 0.5 0.5 0") if dim == 2 else ("0 18", "lattice sc 1.0 origin 0.5 0.5 0.5")
    body = f"cylinder z 9 9 {radius} INF INF" if dim == 2 else f"sphere 9 9 9 {radius}"
    table = lammps(f"units lj\ndimension {dim}\natom_style sph/bulk\n{where}\nregion BOX block 0 18 0 18 {depth}\ncreate_box 1 BOX\n"
                   f"create_atoms 1 box\nset group all mass 1.0\nregion BODY {body}\ngroup body region BODY\ngroup fluid subtract all body\n"
                   "pair_style sph/bulk\npair_coeff 1 1 1.0 10.0 0.5 2.0 2.7 cv 1.0 conductivity 1.0\nvariable n equal count(body)\n"
                   "fix FLUID fluid sph/bulk temperature 1.0\nfix WALL body sph/wall heat flux 1.0\nthermo_style custom step f_WALL[7] v_n\n"
                   + FULL + "run 0\n").thermo()[0]
    n = table["v_n"][0]
    area = 2.0 * np.sqrt(np.pi * n) if dim == 2 else (36.0 * np.pi * n**2) ** (1 / 3)
    assert table["f_WALL[7]"][0] == pytest.approx(area, rel=error)


# what edges take of a flux: part of the heat of a square or a cube, inside or around the fluid, of so many spacings

EDGES = {("body", 2, 6): 0.93, ("body", 3, 6): 0.85, ("vessel", 2, 10): 0.98, ("vessel", 2, 12): 0.98, ("vessel", 3, 10): 0.95, ("vessel", 3, 12): 0.96}


@pytest.mark.parametrize("wall, dim, size", EDGES)
def test_flux_at_edges(lammps, wall, dim, size):
    """The numbers of the page of the fix."""
    length = size + 8 + size % 2
    low, high = (length - size) // 2, (length + size) // 2
    depth, where, z = ("-0.5 0.5", "lattice sq 1.0 origin 0.5 0.5 0", "INF INF") if dim == 2 else (f"0 {length}", "lattice sc 1.0 origin 0.5 0.5 0.5", f"{low} {high}")
    outside = " side out" if wall == "vessel" else ""
    table = lammps(f"units lj\ndimension {dim}\natom_style sph/bulk\n{where}\nregion BOX block 0 {length} 0 {length} {depth}\ncreate_box 1 BOX\n"
                   f"create_atoms 1 box\nset group all mass 1.0\nregion WALL block {low} {high} {low} {high} {z}{outside}\ngroup solid region WALL\n"
                   "group fluid subtract all solid\npair_style sph/bulk\npair_coeff 1 1 1.0 10.0 0.5 2.0 2.7 cv 1.0 conductivity 1.0\n"
                   "fix FLUID fluid sph/bulk temperature 1.0\nfix WALL solid sph/wall heat flux 1.0\nthermo_style custom step f_WALL[7]\n"
                   + FULL + "run 0\n").thermo()[0]
    ratio = table["f_WALL[7]"][0] / (2 * dim * size ** (dim - 1))
    print(wall, dim, size, ratio)
    assert round(ratio, 2) == EDGES[wall, dim, size]


@pytest.mark.parametrize("flux, run, warned", [(-50.0, 60, True), (-50.0, 0, False), (50.0, 60, False)])
def test_more_heat_than_there_is(lammps, flux, run, warned):
    """A warning at the end of the run, one for each wall."""
    text = channel(lammps, 6, low=f"heat flux {flux}", high="heat adiabatic") + f"timestep 0.001\nrun {run}\n"
    lines = [line for line in lammps(text, ranks=2).warnings if re.search(r"Fix LOW sph/wall\S* heat flux has taken more heat than there is", line)]
    assert len(lines) == warned


def test_friction_heats(lammps):
    """Couette flow: the middle is warmer than the walls by mu U^2/(8 k), and an adiabatic lid than the floor by mu U^2/(2 k)."""
    for high, rise in (("heat temp 1.0", 0.5 * 4.0 * 0.25), ("heat adiabatic", 0.5 * 4.0)):
        text = channel(lammps, 12, wide=8, R=4.0, low="heat temp 1.0", high=f"velocity 2.0 0 0 move no {high}", hold=False,
                       fluids="pair_coeff * * 1.0 20.0 1.0 2.0 {R} pb 20.0 cv 0.5 conductivity 1.0\n")
        lammps(text + dump("f.dump", 2500, "c_T") + "timestep 0.0005\nrun 2500\n")
        s, T = across(lammps.frame("f.dump"))
        exact = 1.0 + (4.0 * 0.5 * s * (1.0 - s) if rise < 1.0 else 4.0 * 0.5 * (2.0 * s - s**2))
        print(high, np.abs(T - exact).max() / rise)
        assert np.abs(T - exact).max() < 0.05 * rise


# ---------------------------------------------------------------------------------------------
# energy, ranks, files


def vessel(lammps, newton="on"):
    """A hot body that moves and a floor with a flux in a disordered fluid in motion."""
    particles, owner = odd_shapes(2)
    particles.v[:] *= 0.2
    particles.write(lammps.path("box.data"))
    return (header(2, newton) + "read_data box.data\n" + groups(owner) + "pair_style sph/bulk\n" + coefficients("sph/bulk", FLUIDS, 3.0)
            + "compute E all property/atom esph\ncompute SUM fluid reduce sum c_E\n"
            "variable t equal step*dt\nvariable H atom 3.0+0.2*x+2.0*v_t\nvariable Q equal 0.5*cos(3.0*v_t)\ntimestep 0.002\n")


WALLS = ("fix FLUID fluid sph/bulk temperature 2.0\nfix W0 wall0 sph/wall {} heat temp v_H\nfix W1 wall1 sph/wall heat flux v_Q\n"
         "thermo_style custom step c_SUM f_W0[7] f_W0[8] f_W1[7] f_W1[8]\n" + FULL)
MOVING = WALLS.format("velocity 0.2 0.1 0")


@pytest.mark.parametrize("ranks", [1, 2])
def test_energy(lammps, ranks):
    """Of a fluid at rest: what it gains is what the walls have given, however they vary in time and place."""
    (table,) = lammps(vessel(lammps) + "velocity all set 0 0 0\nfix HOLD all setforce 0 0 0\n" + WALLS.format("") + "thermo 20\nrun 100\n", ranks=ranks).thermo()
    given = table["f_W0[8]"] + table["f_W1[8]"]
    assert np.abs(given[1:]).min() > 0.01
    assert np.abs(table["c_SUM"] - table["c_SUM"][0] - given).max() < 2e-14 * np.abs(table["c_SUM"]).max()


def test_ranks_and_newton(lammps):
    results = []
    for ranks, newton in ((1, "on"), (2, "on"), (4, "on"), (2, "off"), (1, "off")):
        (table,) = lammps(vessel(lammps, newton) + MOVING + dump("f.dump", 60) + "thermo 20\nrun 60\n", ranks=ranks).thermo()
        results.append((lammps.frame("f.dump"), table))
    for frame, table in results[1:]:
        for key in ("x", "v", "esph"):
            assert relative(frame[key] - results[0][0][key], results[0][0][key]) < 1e-11, key
        for key, column in results[0][1].items():
            assert relative(table[key] - column, column) < 1e-10, key


@pytest.mark.parametrize("ranks", [1, 2])
def test_restart(lammps, ranks):
    """State and heat go on; also in a second run, and without a new setup."""
    whole = lammps(vessel(lammps) + MOVING + "run 20\nwrite_restart state.restart\n" + dump("whole.dump", 20) + "thermo 20\nrun 20\n",
                   ranks=ranks).thermo()[-1]
    text = vessel(lammps)
    setup = text[text.index("group"):]
    setup = "\n".join(line for line in setup.splitlines() if not re.match("group|pair_", line)) + "\n"
    parts = lammps("read_restart state.restart\n" + setup + MOVING.replace(" temperature 2.0", "") + dump("parts.dump", 20) + "thermo 20\nrun 20\n",
                   ranks=ranks).thermo()[-1]
    for key, column in whole.items():
        assert relative(parts[key] - column, column) < 1e-12, key
    a, b = lammps.frame("whole.dump"), lammps.frame("parts.dump")
    assert relative(a["esph"] - b["esph"], a["esph"]) < 1e-12
    pre_no = lammps(vessel(lammps) + MOVING + "run 20\nrun 20 pre no\n", ranks=ranks).thermo()[-1]
    assert pre_no["f_W0[8]"][-1] == pytest.approx(whole["f_W0[8]"][-1], rel=1e-12)


def test_no_heat_without_conduction(lammps):
    """In a minimization, which has no time, and after fix adapt has set the conductivity of all types to zero."""
    end = "".join(f"variable k{i} equal {one['k']}*(step<40)\nfix A{i} all adapt 1 pair sph/bulk conductivity {i} {i} v_k{i}\n"
                  for i, one in enumerate(FLUIDS, 1))
    first, pause, last = lammps(vessel(lammps) + MOVING + "thermo 10\nrun 10\nminimize 0 1e-6 5 5\nreset_timestep 30\n" + end + "run 20\n").thermo()
    for wall in ("W0", "W1"):
        rate, given = f"f_{wall}[7]", f"f_{wall}[8]"
        assert (first[rate] != 0.0).all() and (pause[rate] == 0.0).all() and (pause[given] == first[given][-1]).all()
        assert last[rate][0] != 0.0 and (last[rate][1:] == 0.0).all()
        assert last[given][0] == first[given][-1] and last[given][1] == last[given][2] != last[given][0]


def test_adiabatic_is_the_default(lammps):
    """To the last bit, and with a vector of 6."""
    frames = []
    for word in ("", "heat adiabatic"):
        walls = f"fix FLUID fluid sph/bulk temperature 2.0\nfix W0 wall0 sph/wall velocity 0.2 0.1 0 {word}\nfix W1 wall1 sph/wall {word}\n"
        lammps(vessel(lammps) + walls + dump("f.dump", 30) + "run 30\n")
        frames.append(lammps.frame("f.dump"))
        result = lammps(vessel(lammps) + walls + "thermo_style custom step f_W0[7]\nrun 0\n", check=False)
        assert result.code and "out-of-range" in result.error
    assert np.array_equal(frames[0]["esph"], frames[1]["esph"]) and np.array_equal(frames[0]["x"], frames[1]["x"])


# ---------------------------------------------------------------------------------------------
# stability, buoyancy


@pytest.mark.parametrize("wall", ["temp 1.0", "flux 0.0"])
def test_largest_stable_step(lammps, wall):
    """In a disordered fluid next to plane walls and round a body, conduction is stable at the step of the table."""
    particles, owner = odd_shapes(2)
    particles.v[:] = 0.0
    particles.write(lammps.path("box.data"))
    text = (header(2) + "read_data box.data\n" + groups(owner) + "pair_style sph/bulk shear none\n"
            "pair_coeff * * 1.0 1.0 0.0 0.0 3.0 cv 1.0 conductivity 5.0\nvariable T atom random(0.5,1.5,91)\nfix FLUID fluid sph/bulk temperature v_T\n"
            f"fix HOLD all setforce 0 0 0\nfix W0 wall0 sph/wall heat {wall}\nfix W1 wall1 sph/wall heat {wall}\n" + TEMPERATURE)
    limit = float(re.search(r"exceeds the largest stable time step (\S+)", lammps(text + "timestep 5.0\nrun 0\n").log)[1])
    lammps(text + dump("f.dump", 1000, "c_T") + f"timestep {limit}\nrun 1000\n")
    T = lammps.frame("f.dump")["c_T"][owner < 0]
    assert np.ptp(T) < 1e-3 and 0.9 < T.mean() < 1.1


@pytest.mark.parametrize("mode", ["viscous implicit", "viscous rkl2"])
def test_stiff_conduction(lammps, mode):
    """Between a wall with a temperature and one with a flux, with steps far above the explicit limit: energy, and the steady profile."""
    text = channel(lammps, 20, dim=1, low="heat temp 1.0", high="heat flux 0.5", T="1.0").replace("temperature v_T", f"temperature v_T {mode}")
    (table,) = lammps(text + "thermo_style custom step c_SUM f_LOW[7] f_LOW[8] f_HIGH[8]\n" + FULL + dump("f.dump", 200, "c_T")
                      + "timestep 0.02\nthermo 200\nrun 200\n").thermo()
    gain, given = np.ptp(table["c_SUM"]), table["f_LOW[8]"][-1] + table["f_HIGH[8]"][-1]
    assert gain == pytest.approx(given, abs=1e-12)
    assert table["f_LOW[7]"][-1] == pytest.approx(-0.5, rel=2e-3)
    zeroth, second = lattice_sums(1, 4.0, 1.0)
    s, T = across(lammps.frame("f.dump"), 1)
    assert np.abs(T - 1.0 - 0.5 * s * zeroth**2 / second).max() < 5e-3


def test_hot_fluid_rises(lammps):
    """A box with a hot left and a cold right wall: density depends on temperature, and gravity drives the circulation."""
    N, layers = 10, 3
    particles = lattice(2, N + 2 * layers)
    particles.esph[:] = 0.0
    inside = (np.abs(particles.x[:, :2] - 0.5 * (N + 2 * layers)) < 0.5 * N).all(axis=1)
    particles.x[inside, :2] += np.random.default_rng(4).uniform(-0.1, 0.1, (N * N, 2))
    particles.write(lammps.path("box.data"))
    a, b = layers, N + layers
    text = (header(2, boundary="f f p") + "read_data box.data\n"
            f"region IN block {a} {b} {a} {b} INF INF units box\ngroup fluid region IN\nregion LEFT block INF {a} INF INF INF INF units box\n"
            f"region RIGHT block {b} INF INF INF INF INF units box\ngroup left region LEFT\ngroup right region RIGHT\n"
            "group ends subtract all fluid left right\npair_style sph/bulk\n"
            "pair_coeff 1 1 1.0 20.0 0.2 4.0 3.0 pb 20.0 cv 1.0 conductivity 1.0 gruneisen 2.0 10.0\n"
            "fix FLUID fluid sph/bulk temperature 10.0\nfix G fluid gravity 1.0 vector 0 -1 0\nfix L left sph/wall gravity 0 -1.0 0 heat temp 15.0\n"
            "fix R right sph/wall gravity 0 -1.0 0 heat temp 5.0\nfix ENDS ends sph/wall gravity 0 -1.0 0\n"
            "thermo_style custom step f_L[7] f_R[7]\nthermo 3000\ntimestep 0.01\n" + FULL + TEMPERATURE + dump("f.dump", 3000, "c_T") + "run 3000\n")
    table = lammps(text).thermo()[-1]
    frame = lammps.frame("f.dump")
    x, y = frame["x"][:, 0] - a, frame["x"][:, 1] - a
    inside = (x > 0.0) & (x < N) & (y > 0.25 * N) & (y < 0.75 * N)
    up, down = frame["v"][inside & (x < 0.4 * N), 1].mean(), frame["v"][inside & (x > 0.6 * N), 1].mean()
    print(up, down, table)
    assert up > 0.001 and down < -0.001
    assert table["f_L[7]"][-1] == pytest.approx(10.0, rel=0.1) and table["f_R[7]"][-1] == pytest.approx(-10.0, rel=0.1)


# ---------------------------------------------------------------------------------------------
# what is refused


@pytest.mark.parametrize("heat, keywords, words", [
    ("heat", "cv 1.0 conductivity 1.0", "[Mm]issing"),
    ("heat temp", "cv 1.0 conductivity 1.0", "[Mm]issing"),
    ("heat warm 1.0", "cv 1.0 conductivity 1.0", "heat must be adiabatic, temp, or flux, not warm"),
    ("heat temp hot", "cv 1.0 conductivity 1.0", "[Ee]xpected floating point parameter|hot"),
    ("heat temp -1.0", "cv 1.0 conductivity 1.0", "Fix sph/wall heat temp must be >= 0, not -1"),
    ("heat temp nan", "cv 1.0 conductivity 1.0", "heat temp must be >= 0, not nan|nan"),
    ("heat flux inf", "cv 1.0 conductivity 1.0", "heat flux must be finite, not inf|inf"),
    ("heat temp v_no", "cv 1.0 conductivity 1.0", "Variable no for fix sph/wall heat does not exist"),
    ("heat temp v_S", "cv 1.0 conductivity 1.0", "Variable S for fix sph/wall heat is neither of equal style nor of atom style"),
    ("heat temp v_N", "cv 1.0 conductivity 1.0", "Fix sph/wall heat temp must be >= 0, not -1"),
    ("heat temp v_A", "cv 1.0 conductivity 1.0", r"Fix sph/wall heat temp must be >= 0, not -\S+ for particle \d+"),
    ("heat temp 1.0", "cv 1.0", "Fix sph/wall heat: the fluid at the wall conducts no heat"),
    ("heat flux 1.0", "", "Fix sph/wall heat: the fluid at the wall conducts no heat"),
])
def test_refused(lammps, heat, keywords, words):
    lattice(2, 12).write(lammps.path("box.data"))
    text = (header(2) + "read_data box.data\nregion WALL block INF INF 0 4 INF INF\ngroup wall region WALL\ngroup fluid subtract all wall\n"
            "variable S string word\nvariable N equal -1.0\nvariable A atom 5.0-x\n"
            f"pair_style sph/bulk\npair_coeff * * 1.0 10.0 0.5 2.0 3.0 {keywords}\nfix FLUID fluid sph/bulk\nfix W wall sph/wall {heat}\nrun 1\n")
    result = lammps(text, ranks=2, check=False)
    assert result.code and re.search(words.replace("sph/wall", r"sph/wall\S*"), result.error, re.DOTALL), result.output[-600:]


def test_without_forces(lammps):
    """pair_modify compute no: nothing conducts, and the wall gives no heat."""
    text = channel(lammps, 6, low="heat flux 2.0", high="heat flux 2.0") + "thermo_style custom step f_LOW[7]\nrun 2\n"
    rates = [table["f_LOW[7]"][-1] for table in lammps(text + "pair_modify compute no\nrun 5\n").thermo()]
    assert rates[0] > 0.0 and rates[1] == 0.0
    lammps(text.replace("run 2", "pair_modify compute no\nrun 2"))
