"""Shear viscosities that are not constant: keywords power, carreau, cross, yield, smagorinsky, and arrhenius of pair_coeff.

The reference is made of sums over all pairs, with the laws and the kernel written down here.
"""

import numpy as np
import pytest

from helpers import SUPPORT, Particles, disordered, drop, dump, fluid, free, header, relative

FULL = "thermo_modify norm no format float %.17g\n"
RATE = "compute G all property/atom shear_rate\n"
HEAT = "compute Q all sph/dissipation\n"
RHO0, C0, MU, KAPPA = 1.0, 10.0, 0.5, 2.0
LAWS = {
    "power 0.6 0.01 5": lambda g, rho: np.clip(MU * g**-0.4, 0.01, 5.0),
    "power 1.4 0.01 5": lambda g, rho: np.clip(MU * g**0.4, 0.01, 5.0),
    "carreau 2 0.4 2.5 0.1": lambda g, rho: 0.1 + (MU - 0.1) * (1 + (2 * g)**2.5)**(-0.6 / 2.5),
    "cross 3 0.8 0.05": lambda g, rho: 0.05 + (MU - 0.05) / (1 + (3 * g)**0.8),
    "yield 0.3 40": lambda g, rho: MU + 0.3 * (1 - np.exp(-40 * g)) / g,
    "power 0.6 0.01 5 yield 0.3 40": lambda g, rho: np.clip(MU * g**-0.4, 0.01, 5.0) + 0.3 * (1 - np.exp(-40 * g)) / g,
    "smagorinsky 0.7 3": lambda g, rho: MU + np.minimum(rho * 0.7**2 * g, 3.0),
}


class Reference:
    """All sums of a periodic or isolated set of particles."""

    def __init__(self, particles, volume="number", periodic=True, shear="mg"):
        p, n = particles, particles.dim
        self.n, self.m, R = n, p.mass, SUPPORT[n]
        self.w = p.mass / RHO0 if volume == "mass" else np.ones(len(p))
        r = p.x[:, None] - p.x[None]
        if periodic:
            length = p.hi - p.lo
            r[..., :n] -= (length * np.round(r / length))[..., :n]
        d = np.linalg.norm(r, axis=2)
        q = np.minimum(d / R, 1.0)
        norm = {2: 7 / (np.pi * R**2), 3: 21 / (2 * np.pi * R**3)}[n]
        self.F = norm * 20 * (1 - q)**3 / R**2
        np.fill_diagonal(self.F, 0.0)
        self.r = r
        # weight of (r.u)^2 F, with the mean of r^2 W as its unit: 5/36 and 1/5 of R^2
        self.weight = (n + 2) / np.where(d > 0, d, 1.0)**2 if shear == "mg" else n / ({2: 5 / 36, 3: 1 / 5}[n] * R**2)
        self.c = (self.w * norm * (1 - q)**4 * (1 + 4 * q)).sum(axis=1)
        self.V = self.w / self.c
        self.rho = self.m / self.V

    def rates(self, v):
        """gamma^2, cdot/c, and r.u of all pairs."""
        approach = (self.r * (v[:, None] - v[None])).sum(axis=2)
        dilation = -(self.w * self.F * approach).sum(axis=1) / self.c
        square = (self.V * self.F * approach**2 * self.weight).sum(axis=1) - (1 + 2 / self.n) * dilation**2
        return square, dilation, approach

    def forces(self, v, law, like=None, zeta=None):
        """mg with the mean of mu, pressure, and bulk term; mu, and the heats of both channels."""
        square, dilation, approach = self.rates(v)
        mu = law(np.sqrt(square), self.rho)
        a, b = mu[:, None], mu[None]
        mean = 0.5 * (a + b) if like is None else np.where(like, 0.5 * (a + b), 2 * a * b / (a + b))
        zeta = KAPPA - (1 + 2 / self.n) * mu if zeta is None else zeta
        P = C0**2 * (self.rho - RHO0) + zeta * dilation
        g = P / self.c**2
        drag = 2 * self.weight * mean * self.F * np.outer(self.V, self.V) * approach
        central = np.outer(self.w, self.w) * self.F * (g[:, None] + g[None]) - drag
        heat = 0.5 * (drag * approach).sum(axis=1), zeta * self.V * dilation**2
        return (central[..., None] * self.r).sum(axis=1), mu, heat


def run_0(lammps, particles, keywords, name="f", options="", ranks=1, newton="on", periodic=True, model=None):
    particles.write(lammps.path("box.data"))
    text = header(particles.dim, newton, "p p p" if periodic else free(particles.dim)) + "read_data box.data\n"
    text += (model or fluid(particles.dim, options, mu=MU, kappa=KAPPA, c0=C0, keywords=keywords))
    text += "fix FLUID all sph/bulk\ntimestep 0.0001\n" + RATE + HEAT + dump(name, extra="c_G c_Q")
    text += "thermo_style custom step c_Q c_Q[1] c_Q[2]\n" + FULL + "run 0\n"
    table = lammps(text, ranks=ranks).thermo()[-1]
    return lammps.frame(name), table


# ---- forces ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("keywords, shear", [*((law, "mg") for law in LAWS), ("power 0.6 0.01 5", "mg/fr2"), ("yield 0.3 40", "mg/fr2")])
def test_forces_and_heat(lammps, keywords, shear):
    """Those of the reference, 2d; the heat is that of both rates."""
    particles = disordered(2, 12)
    reference = Reference(particles, shear=shear)
    force, mu, heat = reference.forces(particles.v, LAWS[keywords])
    square, dilation, _ = reference.rates(particles.v)
    frame, table = run_0(lammps, particles, keywords, options=f"shear {shear}")
    assert square.min() > 0 and mu.max() > 1.1 * mu.min()
    assert relative(frame["c_G"] - np.sqrt(square), np.sqrt(square)) < 1e-12
    assert relative(frame["f"] - force, force) < 1e-12
    assert relative(frame["c_Q"] - heat[0] - heat[1], heat[0]) < 1e-12
    assert table["c_Q[1]"][0] == pytest.approx(heat[0].sum(), rel=1e-12)
    assert table["c_Q[2]"][0] == pytest.approx(heat[1].sum(), rel=1e-11)
    power = (reference.V * (mu * square + KAPPA * dilation**2)).sum()
    assert table["c_Q"][0] == pytest.approx(power, rel=1e-12)


@pytest.mark.parametrize("dim, options", [(2, "volume mass"), (3, ""), (2, "simd none"), (3, "volume mass simd none")])
@pytest.mark.parametrize("ranks, newton", [(1, "off"), (2, "on"), (4, "off")])
def test_ranks(lammps, dim, options, ranks, newton):
    particles = disordered(dim, {2: 12, 3: 6}[dim])
    volume = "mass" if "mass" in options else "number"
    keywords = "power 0.6 0.01 5"
    force, mu, heat = Reference(particles, volume).forces(particles.v, LAWS[keywords])
    frame, table = run_0(lammps, particles, keywords, options=options, ranks=ranks, newton=newton)
    assert relative(frame["f"] - force, force) < 1e-12
    assert table["c_Q"][0] == pytest.approx(heat[0].sum() + heat[1].sum(), rel=1e-12)


def test_two_fluids(lammps):
    """The harmonic mean between a fluid with and one without a law; types that are alike are one fluid."""
    particles = disordered(2, 12, ntypes=3)
    law = LAWS["cross 3 0.8 0.05"]
    model = "pair_style sph/bulk\n" + "".join(
        f"pair_coeff {k} {k} {RHO0} {C0} {mu} {KAPPA} {SUPPORT[2]} {keywords}\n"
        for k, mu, keywords in ((1, MU, "cross 3 0.8 0.05"), (2, 0.2, ""), (3, MU, "cross 3 0.8 0.05")))
    second = particles.type == 2
    force, mu, heat = Reference(particles).forces(
        particles.v, lambda g, rho: np.where(second, 0.2, law(g, rho)), like=second[:, None] == second[None])
    for ranks in (1, 2):
        frame, table = run_0(lammps, particles, "", model=model, ranks=ranks)
        assert relative(frame["f"] - force, force) < 1e-12
        assert table["c_Q[1]"][0] == pytest.approx(heat[0].sum(), rel=1e-12)


@pytest.mark.parametrize("keywords", ["carreau 2 0.4 2.5 0.1", "power 1.4 0.01 5", "yield 0.3 4"])
def test_force_is_the_derivative_of_the_dissipation_function(lammps, keywords):
    """-d/du sum_i V_i [phi(gamma_i) + kappa/2 (cdot/c)^2] with phi' = mu gamma."""
    law = {**LAWS, "yield 0.3 4": lambda g, rho: MU + 0.3 * (1 - np.exp(-4 * g)) / g}[keywords]
    particles = disordered(2, 8, speed=0.5)
    moving, _ = run_0(lammps, particles, keywords)
    v = particles.v.copy()
    particles.v[:] = 0.0
    resting, _ = run_0(lammps, particles, keywords)
    viscous = moving["f"] - resting["f"]
    reference = Reference(particles)
    nodes, weights = np.polynomial.legendre.leggauss(60)

    def dissipation(v):
        square, dilation, _ = reference.rates(v)
        rate = np.sqrt(square)
        at = rate[:, None] * 0.5 * (nodes + 1)
        phi = (law(at, RHO0) * at * weights).sum(axis=1) * 0.5 * rate
        return reference.V * (phi + 0.5 * KAPPA * dilation**2)

    h = 2e-3
    for i, d in ((0, 0), (17, 1), (30, 0), (63, 1)):
        change = np.zeros_like(v)
        change[i, d] = h
        one, two = ((dissipation(v + k * change) - dissipation(v - k * change)).sum() / (2 * k * h) for k in (1, 2))
        derivative = (4 * one - two) / 3
        assert abs(viscous[i, d] + derivative) < 1e-8 * np.abs(viscous).max()


def test_rigid_rotation_has_no_rate(lammps):
    particles = drop(2, 6.0, rate=3.0, speed=0.0)
    frame, table = run_0(lammps, particles, "power 0.6 0.01 5", periodic=False)
    assert np.abs(frame["c_G"]).max() < 1e-6 and table["c_Q"][0] < 1e-20
    assert np.linalg.norm(particles.v, axis=1).max() > 10


@pytest.mark.parametrize("arrangement, support, along, diagonal, shear", [
    ("hex", 3, 0.989, 0.989, "mg"), ("hex", 4, 0.997, 0.997, "mg"), ("hex", 6, 0.9995, 0.9995, "mg"),
    ("sq", 3, 0.881, 1.103, "mg"), ("sq", 4, 0.958, 1.038, "mg"), ("sq", 6, 0.991, 1.009, "mg"), ("sq", 3, 0.991, 1.038, "mg/fr2")])
def test_rate_on_lattices(lammps, arrangement, support, along, diagonal, shear):
    """Factors of the square of the rate, in the middle of a patch in shear along the lattice and at 45 degrees."""
    a = np.sqrt(2 / np.sqrt(3)) if arrangement == "hex" else 1.0
    b = 1 / a
    size = int(2.2 * support / b) + 2
    i, j = (one.ravel() for one in np.meshgrid(np.arange(-size, size + 1), np.arange(-size, size + 1)))
    x = np.column_stack([a * (i + 0.5 * (j % 2) * (arrangement == "hex")), b * j, 0.0 * i])
    x = x[np.linalg.norm(x, axis=1) < 2.2 * support]
    ones = np.ones(len(x))
    middle = np.argmin(np.linalg.norm(x, axis=1))
    reach = np.array([20.0, 20.0, 0.5])
    for gradient, factor in ((np.array([[0, 1], [0, 0]]), along), (np.array([[0.5, 0.5], [-0.5, -0.5]]), diagonal)):
        v = np.zeros_like(x)
        v[:, :2] = x[:, :2] @ gradient.T
        patch = Particles(2, x, v, ones, 5 * ones, ones.astype(int), -reach, reach)
        model = f"pair_style sph/bulk shear {shear}\npair_coeff * * {RHO0} {C0} {MU} {KAPPA} {support} yield 0.3 1\n"
        frame, _ = run_0(lammps, patch, "", periodic=False, model=model)
        assert frame["c_G"][middle]**2 == pytest.approx(factor, abs=1.5e-3 if factor < 0.999 or factor > 1.001 else 2e-4)


def test_momentum_and_angular_momentum(lammps):
    particles = drop(2, 6.0)
    frame, _ = run_0(lammps, particles, "yield 0.3 40", periodic=False)
    f = frame["f"]
    assert np.abs(f.sum(axis=0)).max() < 1e-13 * np.abs(f).sum()
    torque = (frame["x"][:, 0] * f[:, 1] - frame["x"][:, 1] * f[:, 0])
    assert abs(torque.sum()) < 1e-13 * np.abs(torque).sum()


# ---- constant viscosities ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("keywords", ["power 1 0 1", "carreau 2 1 2 0.1", "cross 2 1 0.5"])
def test_constant_law_is_the_newtonian_fluid(lammps, keywords):
    particles = disordered(2, 12)
    plain, _ = run_newtonian(lammps, particles)
    frame, _ = run_0(lammps, particles, keywords)
    assert relative(frame["f"] - plain["f"], plain["f"]) < 1e-13
    assert relative(frame["desph"] - plain["desph"], plain["desph"]) < 1e-13


def run_newtonian(lammps, particles):
    particles.write(lammps.path("box.data"))
    lammps(header(particles.dim) + "read_data box.data\n" + fluid(2, mu=MU, kappa=KAPPA, c0=C0)
           + "fix FLUID all sph/bulk\n" + dump("n") + "run 0\n")
    return lammps.frame("n"), None


# ---- temperatures ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("keywords, law", [("", lambda g, rho: MU), ("power 0.6 0.01 5", LAWS["power 0.6 0.01 5"]),
                                           ("yield 0.3 40", LAWS["yield 0.3 40"])])
@pytest.mark.parametrize("ranks", [1, 2])
def test_arrhenius(lammps, keywords, law, ranks):
    """Each particle has the factor of its own temperature, up to the bound, and in the cold the bound."""
    particles = disordered(2, 12)
    particles.esph[:] = np.random.default_rng(4).uniform(0.0, 6.0, len(particles))
    particles.esph[::9] = 0.0
    particles.write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\n" + fluid(2, mu=MU, kappa=KAPPA, c0=C0, keywords=f"cv 2 {keywords} arrhenius 3 1 4")
           + "fix FLUID all sph/bulk\n" + HEAT + "compute T all property/atom tsph\n" + dump("f", extra="c_T c_Q") + "run 0\n", ranks=ranks)
    frame = lammps.frame("f")
    T = frame["c_T"]
    factor = np.minimum(np.where(T > 0, np.exp(3 * (1 / np.where(T > 0, T, 1.0) - 1)), 4.0), 4.0)
    assert factor.min() < 0.2 and T.min() <= 0.0 and 5 < (factor == 4.0).sum() < 60
    force, mu, heat = Reference(particles).forces(particles.v, lambda g, rho: law(g, rho) * factor)
    assert relative(frame["f"] - force, force) < 1e-12
    assert relative(frame["c_Q"] - heat[0] - heat[1], heat[0]) < 1e-12


def test_arrhenius_of_two_fluids(lammps):
    """The harmonic mean of two fluids that differ in E alone, after write_data too; a warning of a fluid without heat."""
    particles = disordered(2, 12, ntypes=2)
    particles.esph[:] = 3.0
    particles.write(lammps.path("box.data"))
    keywords = {k: f"cv 2 arrhenius {E} 1 4" for k, E in ((1, 1), (2, 3))}
    model = "pair_style sph/bulk\n" + "".join(f"pair_coeff {k} {k} {RHO0} {C0} {MU} {KAPPA} {SUPPORT[2]} {keywords[k]}\n" for k in (1, 2))
    rest = "fix FLUID all sph/bulk\ncompute T all property/atom tsph\n"
    lammps(header(2) + "read_data box.data\n" + model + rest + dump("f", extra="c_T") + "run 0\nwrite_data out.data\n")
    frame = lammps.frame("f")
    law = MU * np.minimum(np.exp((2 * particles.type - 1) * (1 / frame["c_T"] - 1)), 4.0)
    force, _, _ = Reference(particles).forces(particles.v, lambda g, rho: law, like=particles.type[:, None] == particles.type[None])
    assert relative(frame["f"] - force, force) < 1e-12
    lammps(header(2) + "pair_style sph/bulk\nread_data out.data\n" + rest + dump("d") + "run 0\n")
    assert relative(lammps.frame("d")["f"] - force, force) < 1e-12
    particles.esph[:] = 0.0
    particles.write(lammps.path("box.data"))
    assert any("viscosity depends on heat" in line for line in lammps(header(2) + "read_data box.data\n" + model + rest + "run 0\n").warnings)


@pytest.mark.parametrize("keywords, ignored", [("arrhenius 3 1 4", True), ("cross 1 1 0", True), ("power 0.5 0 1", True), ("power 1.5 0.1 1", False), ("arrhenius 3 1 4 yield 0.3 40", False)])
def test_law_without_a_viscosity(lammps, keywords, ignored):
    disordered(2, 12).write(lammps.path("box.data"))
    found = lammps(header(2) + "read_data box.data\n" + fluid(2, mu=0.0, keywords=f"cv 2 {keywords}") + "fix FLUID all sph/bulk\nrun 0\n").warnings
    assert any("of type 1 is ignored: mu is 0" in line for line in found) == ignored


@pytest.mark.parametrize("law, integrator, factor, bound", [
    ("arrhenius 2 1 1", "", lambda T: np.exp(2 * (1 / T - 1)), 0.006), ("arrhenius 2 1 1", "viscous rkl2", lambda T: np.exp(2 * (1 / T - 1)), 0.006),
    ("melt 1.2 1.8 0.1 solid 10", "viscous rkl2", lambda T: 10**np.interp(T, [1.2, 1.8], [1, 0]), 0.015),
    ("melt 1.45 1.55 0.1 solid 1e4", "viscous rkl2", lambda T: 1e4**np.interp(T, [1.45, 1.55], [1, 0]), 0.09)])
def test_couette_flow_between_walls_of_two_temperatures(lammps, law, integrator, factor, bound):
    """The stress is uniform, so that the slope of the velocity is that of 1/mu(T) with the linear profile of T; means over time."""
    text = channel(f"cv 1 conductivity 1.5 {law}", integrator=f"temperature v_T {integrator}", before="variable T atom 1+y/10\n")
    for old, new in (("0.1*sin(PI*x/6)", "0"), ("0.2*y+0.1*sin(2*PI*y/10)", "0.02*y"), ("velocity 2.0 0 0 move no", "velocity 0.2 0 0 move no heat temp 2"),
                     ("fix low low sph/wall", "fix low low sph/wall heat temp 1"), ("all property/atom shear_rate", "all property/atom tsph")):
        assert old in text
        text = text.replace(old, new)
    steps = 1000 if "solid 1e4" in law else 4000
    lammps(text + f"run {3 * steps}\nfix A all ave/atom 10 {steps // 10} {steps} vx y c_G\nrun {steps}\n"
           "write_dump all custom end id type f_A[*] modify sort id format float %.17g\n")
    frame = lammps.frame("end")
    u, y, T = (frame[f"f_A[{k}]"][frame["type"] == 1] for k in (1, 2, 3))
    nodes = (np.arange(2000) + 0.5) / 200
    slope = 1 / factor(1 + 0.1 * nodes)
    exact = 0.2 * np.interp(y, nodes + 0.0025, np.cumsum(slope) / slope.sum())
    print(np.abs(T - 1 - 0.1 * y).max(), np.abs(u - exact).max() / 0.2, np.abs(0.02 * y - exact).max() / 0.2)
    assert np.abs(T - 1 - 0.1 * y).max() < (0.005 if "solid" in law else 0.001)  # friction heats the liquid
    assert np.abs(u - exact).max() < bound * 0.2
    assert np.abs(0.02 * y - exact).max() > 0.1 * 0.2


# ---- walls, integrators, files -----------------------------------------------------------------------------------


def channel(law, mu=MU, integrator="", rows=10, before=""):
    """A flow between walls, one moving, from a start with shear."""
    return f"""units lj
dimension 2
boundary p f p
atom_style sph/bulk
lattice sq 1.0 origin 0.5 0.5 0
region box block 0 12 -4 {rows + 4} -0.5 0.5 units box
create_box 2 box
create_atoms 1 box
region low block INF INF INF 0 INF INF units box
region high block INF INF {rows} INF INF INF units box
group low region low
group high region high
group walls union low high
group fluid subtract all walls
set group walls type 2
set group all mass 1.0
pair_style sph/bulk
pair_coeff * * {RHO0} {C0} {mu} {KAPPA} 3 pb 1.0 {law}
variable vx atom 0.2*y+0.1*sin(2*PI*y/{rows})
variable vy atom 0.1*sin(PI*x/6)
velocity fluid set v_vx v_vy NULL
fix FLUID fluid sph/bulk {integrator}
fix low low sph/wall
fix high high sph/wall velocity {0.2 * rows} 0 0 move no
fix flat all enforce2d
timestep 0.01
compute G all property/atom shear_rate
{before}"""


OUTPUT = "thermo_style custom step ke c_E\nthermo 1\n" + FULL
ENERGY = "compute E fluid sph/energy\n"


def state(name):
    return f"write_dump all custom {name} id type x y vx vy fx fy d_shear_rate modify sort id format float %.17g\n"


@pytest.mark.parametrize("integrator", ["", "viscous rkl2"])
def test_constant_law_between_walls(lammps, integrator):
    frames = []
    for law in ("", "power 1 0 1"):
        lammps(channel(law, integrator=integrator) + "run 20\n" + state("s"))
        frames.append(lammps.frame("s"))
    assert relative(frames[1]["vx"] - frames[0]["vx"], frames[0]["vx"]) < 1e-12
    assert relative(frames[1]["fx"] - frames[0]["fx"], frames[0]["fx"]) < 1e-10


def test_shear_between_walls(lammps):
    """In Couette flow the rate is uniform up to the walls."""
    text = channel("power 0.6 0.01 5").replace("+0.1*sin(2*PI*y/10)", "").replace("0.1*sin(PI*x/6)", "0")
    lammps(text + "run 0\n" + state("s"))
    frame = lammps.frame("s")
    fluid_rate = frame["d_shear_rate"][frame["type"] == 1]
    inner = fluid_rate[(frame["y"][frame["type"] == 1] > 3) & (frame["y"][frame["type"] == 1] < 7)].mean()
    assert inner == pytest.approx(0.2 * np.sqrt(0.881), rel=2e-3)
    assert np.abs(fluid_rate / inner - 1).max() < 0.02
    assert np.all(frame["d_shear_rate"][frame["type"] == 2] == 0)


@pytest.mark.parametrize("law, integrator", [("power 0.6 0.01 5 yield 0.1 10", ""), ("power 0.6 0.01 5 yield 0.1 10", "viscous rkl2"),
                                             ("cv 0.2 conductivity 0.05 power 0.6 0.01 5 arrhenius 2 1 3", "temperature v_T"),
                                             ("cv 0.2 conductivity 0.05 melt 0.9 1.1 0.1 solid 20 arrhenius 2 1 3", "temperature v_T viscous rkl2")])
def test_runs_restarts_and_ranks(lammps, law, integrator):
    """Two runs, a restart file between them, and other numbers of ranks are one long run."""
    text = channel(law, integrator=integrator).replace("fix FLUID", "variable T atom 1+0.5*sin(x)\nfix FLUID")
    again = text[text.index("variable T atom"):]
    lammps(text + "write_data start.data nocoeff\n")
    text = text[:text.index("lattice")] + "read_data start.data\n" + text[text.index("region low"):]
    lammps(text + "run 20\n" + state("one"))
    lammps(text + "run 8\nwrite_restart r\nrun 12\n" + state("two"))
    lammps("read_restart r\n" + again + "run 12\n" + state("three"))
    lammps(text + "run 20\n" + state("four"), ranks=4)
    one = lammps.frame("one")
    for name in ("two", "three", "four"):
        other = lammps.frame(name)
        for column in ("y", "vx", "fx", "d_shear_rate"):
            assert relative(other[column] - one[column], one[column]) < 1e-10, (name, column)


@pytest.mark.parametrize("integrator, keywords", [("", "power 0.6 0.01 5 yield 0.1 10"), ("viscous rkl2", "power 0.6 0.01 5 yield 0.1 10"),
                                                  ("", "cv 0.05 conductivity 0.01 arrhenius 2 1 1.5"),
                                                  ("viscous rkl2", "cv 0.05 conductivity 0.01 gruneisen 0.1 1 arrhenius 2 1 20")])
def test_energy(lammps, integrator, keywords):
    particles = disordered(2, 12, jitter=0.05, speed=0.3)
    particles.esph[:] = 0.05
    particles.write(lammps.path("box.data"))
    changes = []
    for dt in (0.004, 0.002):
        text = (header(2) + "read_data box.data\n" + fluid(2, mu=MU, keywords=keywords)
                + f"fix FLUID all sph/bulk {integrator}\ntimestep {dt}\ncompute E all sph/energy\n" + OUTPUT + f"run {round(0.4 / dt)}\n")
        table = lammps(text).thermo()[-1]
        changes.append(np.abs(table["c_E"] - table["c_E"][0]).max() / table["KinEng"][0])
    if integrator:
        assert changes[0] < 1e-12
    else:
        assert changes[1] < 1e-3 and changes[0] / changes[1] > 3.0


def test_data_file_and_adapt(lammps):
    """write_data keeps the laws; fix adapt varies exponent, yield stress, and mu."""
    particles = disordered(2, 12)
    keywords = "power 0.6 0.01 5 yield 0.3 40"
    frame, _ = run_0(lammps, particles, keywords)
    text = header(2) + "read_data box.data\n"
    lammps(text + fluid(2, mu=MU, kappa=KAPPA, c0=C0, keywords=keywords) + "fix FLUID all sph/bulk\nrun 0\nwrite_data out.data\n")
    lammps(header(2) + "pair_style sph/bulk\nread_data out.data\nfix FLUID all sph/bulk\n" + RATE + dump("d") + "run 0\n")
    assert relative(lammps.frame("d")["f"] - frame["f"], frame["f"]) < 1e-13
    adapt = ("variable n equal 0.6\nvariable t equal 0.3\nvariable mu equal 0.5\nfix A all adapt 1 pair sph/bulk power_n * * v_n "
             "pair sph/bulk yield_stress * * v_t pair sph/bulk mu * * v_mu\n")
    lammps(text + fluid(2, mu=0.7, kappa=KAPPA, c0=C0, keywords="power 0.9 0.01 5 yield 0.1 40") + "fix FLUID all sph/bulk\n"
           + adapt + dump("a") + "run 0\n")
    assert relative(lammps.frame("a")["f"] - frame["f"], frame["f"]) < 1e-13


def test_table_has_the_largest_viscosity(lammps):
    particles = disordered(2, 12)
    found = {}
    for mu, keywords in ((12.5, ""), (0.5, "yield 0.3 40"), (0.5, "power 0.6 0.01 12.5"), (0.1, "carreau 2 0.4 2 12.5"), (0.5, "smagorinsky 1 12"), (0.5, "cv 1 arrhenius 3 1 25")):
        particles.write(lammps.path("box.data"))
        log = lammps(header(2) + "read_data box.data\n" + fluid(2, mu=mu, kappa=KAPPA, keywords=keywords) + "fix FLUID all sph/bulk\ntimestep 1e-5\nrun 0\n").log
        line = next(line for line in log.splitlines() if line.startswith("  1-1"))
        found[keywords] = float(line.split("|")[1].split()[1])
        if keywords:
            assert "largest_mu" in log and float(line.split("|")[0].split()[5]) == 12.5
    assert len(set(found.values())) == 1


# ---- bad input ---------------------------------------------------------------------------------------------------

COEFF = f"pair_coeff * * 1 10 0.5 2 {SUPPORT[2]} "


@pytest.mark.parametrize("model, words", [
    (f"pair_style sph/bulk\n{COEFF}power 0.5 2 1", "power must have n > 0"),
    (f"pair_style sph/bulk\n{COEFF}power 0 0 1", "power must have n > 0"),
    (f"pair_style sph/bulk\n{COEFF}power -1 0 1", "must have numbers >= 0"),
    (f"pair_style sph/bulk\n{COEFF}carreau 1 1.5 2 0", "n <= 1"),
    (f"pair_style sph/bulk\n{COEFF}cross 1 0 0", "m > 0"),
    (f"pair_style sph/bulk\n{COEFF}yield 0 3", "tau_y > 0"),
    (f"pair_style sph/bulk\n{COEFF}smagorinsky 1 0", "mu_max > 0"),
    (f"pair_style sph/bulk\n{COEFF}cv 1 arrhenius 2 0 3", "T0 > 0"),
    (f"pair_style sph/bulk\n{COEFF}cv 1 arrhenius 2 1 0.5", "factor_max >= 1"),
    (f"pair_style sph/bulk\n{COEFF}arrhenius 2 1 3", "heat capacity"),
    (f"pair_style sph/bulk temp 1 4711\n{COEFF}cv 1 arrhenius 2 1 3", "temp cannot be used with arrhenius"),
    (f"pair_style sph/bulk temp energy 100 4711\n{COEFF}cv 1 arrhenius 2 1 3", "no noise without drift"),
    (f"pair_style sph/bulk\n{COEFF}power 0.5 0 1 cross 1 1 0", "not be given together"),
    (f"pair_style sph/bulk\n{COEFF}power 0.5 0", "Illegal pair_coeff power command: missing argument"),
    (f"pair_style sph/bulk shear morris\n{COEFF}yield 1 1", "requires pair style sph/bulk with shear mg"),
    (f"pair_style sph/bulk bulk volume\n{COEFF}yield 1 1", "bulk density"),
    (f"pair_style sph/bulk limit yes\n{COEFF}yield 1 1", "limit"),
    (f"pair_style sph/bulk temp 1 4711\n{COEFF}yield 1 1", "drift"),
    (f"pair_style sph/bulk temp energy 100 4711\n{COEFF}yield 1 1", "drift"),
    (f"pair_style sph/bulk dim 1\n{COEFF}yield 1 1", "on a line there is no shear"),
    (f"pair_style sph/bulk\n{COEFF}yield 1 1\npair_coeff 1 2 mu 0.1", "unlike types 1 2"),
])
def test_errors(lammps, model, words):
    particles = disordered(2, 12, ntypes=2)
    if "dim 1" in model:
        particles = disordered(1, 20)
    particles.write(lammps.path("box.data"))
    result = lammps(header(2) + f"read_data box.data\n{model}\nfix FLUID all sph/bulk\nrun 0\n", check=False)
    assert result.code and words in result.error.replace("\n", " "), result.output[-1500:]


@pytest.mark.parametrize("end", ["rerun frame dump x y vx vy\n", "minimize 0 0 1 1\n", "unfix FLUID\nfix FLUID one sph/bulk viscous rkl2\nrun 1\n"])
def test_keywords_of_a_type_that_another_style_has_taken(lammps, end):
    """They are not the fluid's."""
    disordered(2, 12, ntypes=2).write(lammps.path("box.data"))
    lammps(header(2) + "read_data box.data\npair_style hybrid sph/bulk soft 1.0\npair_coeff * * sph/bulk 1 10 0.5 2 3 cv 2 gruneisen 0.1 1 arrhenius 2 1 3\n"
           "pair_coeff 1 1 sph/bulk 1 10 0.5 2 3\npair_coeff * 2 soft 1.0\ngroup one type 1\ngroup two type 2\nfix FLUID one sph/bulk\n"
           "fix OTHER two nve\nwrite_dump all custom frame id type x y z vx vy vz\n" + end)


def test_errors_of_other_commands(lammps):
    """The property and the integrator; test_combinations.py has open ends."""
    particles = disordered(2, 12)
    particles.write(lammps.path("box.data"))
    text = header(2) + "read_data box.data\n"
    cases = [(fluid(2) + "fix FLUID all sph/bulk\n" + RATE + dump("p", extra="c_G"), "shear_rate needs a pair style with power"),
             (fluid(2, keywords="yield 0.3 5") + "fix FLUID all sph/bulk viscous implicit\n", "use viscous rkl2"),
             (fluid(2, keywords="cv 1 arrhenius 2 1 3") + "fix FLUID all sph/bulk viscous implicit\n", "use viscous rkl2")]
    for lines, words in cases:
        result = lammps(text + lines + "run 0\n", check=False)
        assert result.code and words in result.error, result.output[-1500:]
