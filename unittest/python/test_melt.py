"""Melting and freezing: keywords melt and solid of pair_coeff."""

from math import erf, erfc, exp, pi, sqrt

import numpy as np
import pytest

from helpers import SUPPORT, disordered, drop, dump, fluid, free, header, momentum_errors, relative
from test_rheology import C0, KAPPA, MU, RHO0, Reference

FULL = "thermo_modify norm no format float %.17g\n"
TEMPERATURE = "compute T all property/atom tsph\n"
CV, SOLIDUS, LIQUIDUS, LATENT = 2.0, 1.2, 1.5, 3.0
MELT = f"cv {CV} melt {SOLIDUS} {LIQUIDUS} {LATENT}"


def temperature(q, solidus=SOLIDUS, liquidus=LIQUIDUS, latent=LATENT):
    """The curve of heat over temperature through its corners, read the other way round."""
    T = np.array([-100.0, solidus, liquidus, 100.0])
    return np.interp(q, CV * T + latent * np.array([0, 0, 1, 1]), T)


def solid(T, solidus=SOLIDUS, liquidus=LIQUIDUS):
    return np.interp(T, [solidus, liquidus], [1.0, 0.0])


@pytest.mark.parametrize("ranks", [1, 2])
def test_temperature_and_viscosity(lammps, ranks):
    """Each particle has the temperature of its heat and the viscosity of its solid fraction; all pairs have the harmonic mean."""
    particles = disordered(2, 12, ntypes=2)
    particles.esph = particles.mass * np.random.default_rng(3).uniform(1.0, 8.0, len(particles))
    particles.write(lammps.path("box.data"))
    model = "pair_style sph/bulk\n" + "".join(f"pair_coeff {k} {k} {RHO0} {C0} {MU} {KAPPA} {SUPPORT[2]} {words} solid 1e3\n"
                                            for k, words in ((1, MELT), (2, f"cv {CV} melt 1 1.3 2")))
    lammps(header(2) + "read_data box.data\n" + model + "fix FLUID all sph/bulk\n" + TEMPERATURE + dump("f", extra="c_T") + "run 0\n", ranks=ranks)
    frame = lammps.frame("f")
    found = Reference(particles)
    x = found.rho / RHO0
    q = particles.esph / particles.mass - C0**2 * (np.log(x) + 1 / x - 1)
    one = particles.type == 1
    T = np.where(one, temperature(q), temperature(q, 1.0, 1.3, 2.0))
    s = np.where(one, solid(T), solid(T, 1.0, 1.3))
    assert min((s == 0).sum(), (s == 1).sum(), ((s > 0) & (s < 1)).sum()) > 20
    assert np.abs(frame["c_T"] - T).max() < 1e-12
    force, _, _ = found.forces(particles.v, lambda g, rho: MU * 1e3**s, like=np.zeros(2 * (len(s),), bool), zeta=KAPPA - 2 * MU)
    assert relative(frame["f"] - force, force) < 1e-11


def test_given_temperature(lammps):
    """Keyword temperature gives the heat of each temperature, the latent heat included; write_data keeps the keywords."""
    particles = disordered(2, 12)
    particles.write(lammps.path("box.data"))
    rest = TEMPERATURE + dump("f", extra="c_T") + "run 0\n"
    lammps(header(2) + "read_data box.data\n" + fluid(2, keywords=f"{MELT} solid 10") + "variable T atom 1.0+0.7*x/12\nfix FLUID all sph/bulk temperature v_T\n"
           + rest + "write_data out.data\n")
    first = lammps.frame("f")
    assert np.abs(first["c_T"] - 1.0 - 0.7 * first["x"][:, 0] / 12).max() < 1e-12
    lammps(header(2) + "pair_style sph/bulk\nread_data out.data\nfix FLUID all sph/bulk\n" + rest)
    again = lammps.frame("f")
    assert np.abs(again["c_T"] - first["c_T"]).max() < 1e-12 and relative(again["f"] - first["f"], first["f"]) < 1e-11


# ---- the Stefan problem ------------------------------------------------------------------------------------------


def front(wall, start, latent):
    """lambda of the similarity solution s = 2 lambda sqrt(alpha t) of both phases with the same k and cv = 1, melting at 1 (J. Stefan, 1889; F. Neumann)."""
    hot, cold = abs(wall - 1), abs(start - 1)
    least, most = 1e-6, 3.0
    for _ in range(60):
        x = 0.5 * (least + most)
        gain = exp(-x * x) * (hot / erf(x) - cold / erfc(x)) - x * sqrt(pi) * latent
        least, most = (x, most) if gain > 0 else (least, x)
    return least


@pytest.mark.parametrize("wall, start, c0, k, dt, integrator, ranks", [(2.0, 0.8, 10, 1.0, 0.05, "", 1), (0.2, 1.1, 10, 1.0, 0.05, "", 2),
                                                                        (2.0, 0.8, 1, 20.0, 0.25, "viscous rkl2", 2)])
def test_front(lammps, wall, start, c0, k, dt, integrator, ranks):
    """Position of the front of melting and of freezing within 2 percent; with rkl2 the step is 11 times the largest explicit one."""
    table = lammps(f"""units lj
dimension 2
boundary f p p
atom_style sph/bulk
lattice hex $(2/sqrt(3)) origin 0.25 0.25 0
region box block -5 45 0 $(2*sqrt(3)) -0.5 0.5 units box
create_box 1 box
create_atoms 1 box
set group all mass $(sqrt(3)/2)
region wall block INF 0 INF INF INF INF units box
region end block 40 INF INF INF INF INF units box
group wall region wall
group end region end
group fluid subtract all wall end
neighbor 0.3 bin
pair_style sph/bulk
pair_coeff * * 1 {c0} 0.4 intrinsic 4 pb {0.01 * c0**2} cv 1 conductivity {k} melt 0.99 1.01 2
fix 1 fluid sph/bulk density rho0 temperature {start} {integrator}
fix wall wall sph/wall heat temp {wall}
fix end end sph/wall
timestep {dt}
compute T fluid property/atom tsph
variable liquid atom (c_T>=1.01)+(c_T>0.99)*(c_T<1.01)*(c_T-0.99)/0.02
variable solid atom 1-v_liquid
compute new fluid reduce sum v_{"liquid" if wall > 1 else "solid"}
variable front equal c_new*$(sqrt(3)/2)/ly
thermo_style custom step time v_front
thermo {round(40 / k / dt)}
run {round(160 / k / dt)}
""", ranks=ranks).thermo()[-1]
    exact = 2 * front(wall, start, 2.0) * np.sqrt(k * table["Time"])
    print(table["v_front"], exact)
    assert np.abs(table["v_front"][1:] / exact[1:] - 1).max() < 0.02


# ---- motion ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("ranks", [1, 2, 4])
def test_conservation(lammps, ranks):
    """A drop that melts and freezes in free space, with mu of the solid 1e4 times larger, at the step of sound: energy and momenta are exact."""
    particles = drop(2, 8.0, rate=0.05, speed=0.01)
    particles.esph = particles.mass * np.where(particles.x[:, 0] < 0, 2.3, 9.0)
    particles.write(lammps.path("box.data"))
    table = lammps(header(2, boundary=free(2)) + "read_data box.data\n" + fluid(2, "density continuity", mu=MU, kappa=KAPPA, keywords=f"{MELT} conductivity 3 solid 1e4")
                   + "fix FLUID all sph/bulk viscous rkl2\ntimestep 0.03\ncompute E all sph/energy\n" + TEMPERATURE + dump("f", 250, extra="c_T")
                   + f"thermo_style custom step c_E ke f_FLUID[1] f_FLUID[5]\nthermo 10\n{FULL}run 250\n", ranks=ranks).thermo()[-1]
    first, last = (lammps.frames("f")[k] for k in (0, -1))
    crossed = [np.count_nonzero((first["c_T"] - T) * (last["c_T"] - T) < 0) for T in (SOLIDUS, LIQUIDUS)]
    momentum = momentum_errors(first, last)
    drift = np.abs(table["c_E"] / table["c_E"][0] - 1).max()
    print(crossed, momentum, drift, table["f_FLUID[1]"].max(), table["KinEng"])
    assert min(crossed) > 10 and table["f_FLUID[1]"].max() > 30
    assert max(momentum) < 1e-13 and drift < 1e-13


# ---- bad input ---------------------------------------------------------------------------------------------------

COEFF = f"pair_coeff * * 1 10 0.5 2 {SUPPORT[2]} "


@pytest.mark.parametrize("model, words, integrator", [
    (f"pair_style sph/bulk\n{COEFF}melt 1 2 3", "heat capacity", ""),
    (f"pair_style sph/bulk\n{COEFF}cv 1 melt 0 2 3", "melt must have 0 < T_s < T_l and L >= 0", ""),
    (f"pair_style sph/bulk\n{COEFF}cv 1 melt 2 2 3", "melt must have 0 < T_s < T_l", ""),
    (f"pair_style sph/bulk\n{COEFF}cv 1 melt 1 2 -3", "melt must have 0 < T_s < T_l", ""),
    (f"pair_style sph/bulk\n{COEFF}cv 1 melt 1 2 3 gruneisen 0.1 1", "melt and gruneisen must not be given together", ""),
    (f"pair_style sph/bulk eos ideal\n{COEFF}cv 1 melt 1 2 3", "melt of type 1 cannot be used with eos ideal", ""),
    (f"pair_style sph/bulk temp 1 4711\n{COEFF}cv 1 melt 1 2 3", "temp cannot be used with melt", ""),
    (f"pair_style sph/bulk temp energy 100 4711\n{COEFF}cv 1 melt 1 2 3", "temp cannot be used with melt", ""),
    (f"pair_style sph/bulk\n{COEFF}cv 1 solid 10", "solid of type 1 requires melt", ""),
    (f"pair_style sph/bulk\n{COEFF}cv 1 melt 1 2 3 solid 0.5", "solid must be >= 1", ""),
    (f"pair_style sph/bulk\n{COEFF.replace('0.5 2', '0.5 0.9')}cv 1 melt 1 2 3 solid 10", "kappa must be >= 1 with solid", ""),
    (f"pair_style sph/bulk shear morris\n{COEFF}cv 1 melt 1 2 3 solid 10", "requires pair style sph/bulk with shear mg", ""),
    (f"pair_style sph/bulk\n{COEFF}cv 1 melt 1 2 3", "viscous implicit cannot be used with melt of pair_coeff", "viscous implicit"),
])
def test_errors(lammps, model, words, integrator):
    disordered(2, 12).write(lammps.path("box.data"))
    result = lammps(header(2) + f"read_data box.data\n{model}\nfix FLUID all sph/bulk {integrator}\nrun 0\n", check=False)
    assert result.code and words in result.error.replace("\n", " "), result.output[-1500:]
