"""Thermal noise, keyword temp: numbers that belong to the pair, conservation, temperatures, restart, errors.

That its covariance is that of the friction is tested in unittest/cpp/test_noise.cpp.
"""

import re

import numpy as np
import pytest

from helpers import disordered, drop, dump, free, header, lattice, relative, undump

HOT = "temp 30.0 4711"
STOKES = "limit yes"


def deck(style="sph/bulk", dim=2, options=HOT, newton="on", skin=0.3, boundary="p p p", kappa=2.0, extra="",
         coeff=None):
    """A box of particles with noise; the table of coefficients of both styles is the same."""
    spin = ""
    if style == "sph/micropolar":
        gamma2 = -0.02 if dim == 2 else 0.01
        spin = f" 0.2 0.02 {gamma2}"
    support = {1: 4.0, 2: 3.0, 3: 2.5}[dim]
    coeff = coeff or f"pair_coeff * * 1.0 10.0 0.5 {kappa}{spin} {support} pb 10.0\n"
    inertia = " inertia 0.2 0.01" if spin else ""
    return (header(dim, newton, boundary, style) + "read_data box.data\n" + f"neighbor {skin} bin\n"
            + f"pair_style {style} dim {dim} {options}\n" + coeff + f"fix FLUID all {style}{inertia}\n"
            + "timestep 0.002\n" + extra)


def make_box(lammps, dim=2, style="sph/bulk", **keywords):
    cells = {1: 20, 2: (9, 8), 3: (6, 6, 5)}[dim]
    particles = disordered(dim, cells, spread=0.04, **keywords)
    write(lammps, particles, style)
    return particles


def write(lammps, particles, style):
    if style == "sph/bulk":
        particles.write(lammps.path("box.data"))
        return
    # mass and internal energy by hand: the atom lines of sph/micropolar have the inertia, too
    particles.write(lammps.path("box.data"))
    text = lammps.path("box.data").read_text()
    lines, atoms = [], False
    for line in text.splitlines():
        if line.startswith("Atoms"):
            atoms, line = True, "Atoms # sph/micropolar"
        elif line.startswith("Velocities"):
            atoms = False
        words = line.split()
        if atoms and len(words) == 7:
            line = " ".join(words[:4] + ["0.2"] + words[4:])
        elif not atoms and len(words) == 4 and lines and "Velocities" in text[:text.index(line)]:
            line += " 0 0 0"
        lines.append(line)
    lammps.path("box.data").write_text("\n".join(lines) + "\n")


def forces(lammps, text, name="f.dump", ranks=1):
    lammps(text + dump(name) + "run 0\n", ranks=ranks)
    return lammps.frame(name)["f"]


# ---- the same numbers --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("dim", [1, 2, 3])
@pytest.mark.parametrize("options, kappa", [(HOT, 4.0), (f"{HOT} {STOKES}", 0.0)])
def test_same_noise_on_any_number_of_ranks_with_newton_on_and_off_and_any_skin(lammps, dim, options, kappa):
    make_box(lammps, dim)
    cold = forces(lammps, deck(dim=dim, options=options.replace("30.0", "0.0"), kappa=kappa))
    reference = forces(lammps, deck(dim=dim, options=options, kappa=kappa)) - cold
    assert np.abs(reference).max() > np.abs(cold).max()
    for ranks, newton, skin in ((1, "off", 0.3), (1, "on", 0.1), (1, "on", 1.0), (2, "on", 0.3), (2, "off", 1.0),
                                (4, "on", 0.1), (4, "off", 0.3)):
        noise = forces(lammps, deck(dim=dim, options=options, kappa=kappa, newton=newton, skin=skin),
                       ranks=ranks) - cold
        assert relative(noise - reference, reference) < 1e-13, (ranks, newton, skin)


def test_other_steps_and_seeds_have_other_noise(lammps):
    make_box(lammps)
    cold = forces(lammps, deck(options="temp 0.0 1"))
    noise = {}
    for seed in (1, 2):
        for step in (0, 1, 2**32, 2**32 + 1):
            text = deck(options=f"temp 30.0 {seed}", extra=f"reset_timestep {step}\n")
            noise[seed, step] = forces(lammps, text) - cold
    names = list(noise)
    for k, one in enumerate(names):
        for other in names[:k]:
            a, b = noise[one][:, :2].ravel(), noise[other][:, :2].ravel()
            assert abs(np.dot(a, b)) < 0.4 * np.linalg.norm(a) * np.linalg.norm(b), (one, other)


@pytest.mark.parametrize("style", ["sph/bulk", "sph/micropolar"])
def test_a_restarted_run_continues_with_the_same_numbers(lammps, style):
    make_box(lammps, style=style)
    dumps = lambda name: dump(name, 5)
    lammps(deck(style) + "run 10\nwrite_restart ten.restart\n" + dumps("whole.dump") + "run 10\n")
    rest = "read_restart ten.restart\nfix FLUID all " + style + "\n"
    if style == "sph/micropolar":
        rest = rest.replace("\nfix FLUID all sph/micropolar", "\nfix FLUID all sph/micropolar inertia 0.2 0.01")
    for ranks in (1, 2):
        lammps(rest + "timestep 0.002\n" + dumps("rest.dump") + "run 10\n", ranks=ranks)
        for one, other in zip(lammps.frames("whole.dump"), lammps.frames("rest.dump")):
            assert one.step == other.step
            for field in "xvf":
                assert relative(one[field] - other[field], one[field]) < 1e-12, (one.step, field)


@pytest.mark.parametrize("viscous", ["", " viscous implicit"])
def test_random_numbers_go_on_after_reset_timestep(lammps, viscous):
    """As in one run without it; the offset is in restart files.  The implicit step computes forces twice."""
    make_box(lammps)
    rest = f"fix FLUID all sph/bulk{viscous}\ntimestep 0.002\n"
    box = deck().replace("fix FLUID all sph/bulk\ntimestep 0.002\n", rest)
    lammps(box + "run 10\n" + dump("whole.dump") + "run 0\n")
    lammps(box + "run 4\nreset_timestep 0\nrun 2\nreset_timestep 0\nrun 2\nwrite_restart eight.restart\nrun 2\n"
           + dump("parts.dump") + "run 0\n")
    lammps("read_restart eight.restart\n" + rest + "reset_timestep 1\nrun 2\n" + dump("read.dump") + "run 0\n", ranks=2)
    lammps(box + "thermo_style custom step\nrun 4\nreset_timestep 0\nrun 2 pre no\nreset_timestep 1\nrun 1 pre no\nreset_timestep 1\nrun 1 pre no\n"
           "reset_timestep 0\nrun 2\n" + dump("pre.dump") + "run 0\n")
    whole = lammps.frame("whole.dump")
    for name in ("parts.dump", "read.dump", "pre.dump"):
        for field in "xvf":
            assert relative(lammps.frame(name)[field] - whole[field], whole[field]) < 1e-11, (name, field)


def test_rerun_repeats_the_random_numbers(lammps):
    """Of the steps of the file, also after a run that has passed them."""
    make_box(lammps)
    again = "rerun run.dump first 1 dump x y vx vy\n"
    lammps(deck() + "dump T all custom 1 run.dump id x y vx vy\ndump_modify T sort id format float %.17g\nrun 3\n"
           "undump T\n" + dump("after.dump") + again)
    lammps(deck() + dump("alone.dump") + again)
    for after, alone in zip(lammps.frames("after.dump"), lammps.frames("alone.dump")):
        assert after.step == alone.step
        assert relative(after["f"] - alone["f"], alone["f"]) < 1e-13


# ---- what is conserved -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("style, options, kappa", [("sph/bulk", HOT, 4.0), ("sph/bulk", f"{HOT} {STOKES}", 0.0),
                                                   ("sph/bulk", f"{HOT} shear morris", 4.0),
                                                   ("sph/micropolar", HOT, 4.0)])
def test_momentum_to_round_off(lammps, style, options, kappa):
    particles = make_box(lammps, style=style)
    text = deck(style, options=options, kappa=kappa, extra="velocity all zero linear\n")
    text += "variable p equal sqrt(vcm(all,x)^2+vcm(all,y)^2)*mass(all)\nthermo_style custom step ke v_p\nthermo 100\n"
    thermo = lammps(text + "run 2000\n").thermo()[0]
    scale = np.sqrt(2.0 * thermo["KinEng"][-1] * particles.mass.mean() * len(particles)) * np.sqrt(len(particles))
    assert thermo["v_p"].max() < 1e-14 * scale * np.sqrt(2000)


@pytest.mark.parametrize("options, kappa", [("temp 0.01 5", 4.0), (f"temp 0.01 5 {STOKES}", 0.0)])
def test_angular_momentum_of_a_drop_over_10000_steps(lammps, options, kappa):
    """Orbital and spin, of a micropolar drop under tension that fluctuates."""
    particles = drop(2, 4.0, rate=0.2, speed=0.0)
    particles.mass[:] = 1.0
    write(lammps, particles, "sph/micropolar")
    coeff = f"pair_coeff * * 0.95 10.0 0.5 {kappa} 0.2 0.02 -0.02 3.0\n"
    text = deck("sph/micropolar", options=options, boundary="f f p", coeff=coeff)
    text += ("compute L all sph/angmom point 0 0 0\ncompute moving all reduce sum vx\n"
             "thermo_style custom step ke c_L[3] c_L[6] c_L[9]\nthermo 1000\nthermo_modify format float %.17g\n")
    thermo = lammps(text + "run 10000\n", timeout=300).thermo()[0]
    momentum = thermo["c_L[3]"]
    size = np.abs(momentum[0])
    assert size > 1.0
    assert np.abs(momentum - momentum[0]).max() < 1e-12 * size
    assert np.ptp(thermo["c_L[9]"]) > 1e-3 * size  # the spins do fluctuate


# ---- temperatures ------------------------------------------------------------------------------------------------

TEMPERATURES = """
compute T all sph/temp
run 400
reset_timestep 0
fix av all ave/time 1 3000 3000 c_T c_T[*]
thermo_style custom step f_av[*]
thermo 3000
run 3000
"""


@pytest.mark.parametrize("style, dim, options, kappa", [
    ("sph/bulk", 2, "", 0.8), ("sph/bulk", 2, STOKES, 0.0), ("sph/bulk", 2, "volume mass shear espanol", 0.8),
    ("sph/bulk", 3, "shear morris", 0.8), ("sph/micropolar", 2, "", 0.8), ("sph/micropolar", 3, STOKES, 0.0)])
@pytest.mark.parametrize("ranks", [1, 2])
def test_temperature(lammps, style, dim, options, kappa, ranks):
    """Of all directions and spins, of 400 particles in a short run: within five standard errors."""
    if ranks == 2 and (dim == 3 or options):
        pytest.skip("one case is enough")
    spin = " 0.1 0.02 -0.02" if dim == 2 else " 0.1 0.02 0.01"
    text = (f"units lj\ndimension {dim}\natom_style {style}\nlattice {'sq' if dim == 2 else 'sc'} 1.0\n"
            + ("region box block 0 20 0 20 -0.5 0.5\n" if dim == 2 else "region box block 0 7 0 7 0 8\n")
            + "create_box 2 box\ncreate_atoms 1 box\nset group all mass 1.0\nset group all type/fraction 2 0.5 77\n"
            + "set type 2 mass 2.0\n"
            + f"displace_atoms all random 0.1 0.1 {0.1 if dim == 3 else 0.0} 5\n"
            + f"velocity all create 1.7 87 loop geom\n"
            + f"pair_style {style} {options} temp 1.7 99\n")
    coeff = "{0} {0} {1}.0 6.0 0.3 {2}{3} {4} pb 20.0\n"
    for type in (1, 2):
        text += "pair_coeff " + coeff.format(type, type, kappa, spin if style == "sph/micropolar" else "",
                                             3.0 if dim == 2 else 2.5)
    text += f"fix 1 all {style}" + (" inertia 0.16 0.0" if "micro" in style else "") + "\ntimestep 0.006\n"
    result = lammps(text + TEMPERATURES, ranks=ranks, timeout=300)
    rate = float(re.findall(r"largest viscous rate times time step ([\d.e+-]+)", result.log)[0])
    assert rate < 0.12
    number = 400 if dim == 2 else 392
    values = {name: column[-1] for name, column in result.thermo()[-1].items() if name.startswith("f_av")}
    # at least one independent sample per relaxation time of about 1
    error = 1.7 * np.sqrt(2.0 / (number * 20.0))
    assert abs(values["f_av[1]"] - 1.7) < 5 * error / np.sqrt(dim)
    for k in range(dim):
        assert abs(values[f"f_av[{2 + k}]"] - 1.7) < 5 * error
    if "micro" in style:
        assert abs(values["f_av[5]"] - 1.7) < 5 * error
    else:
        assert values["f_av[5]"] == 0.0


def test_compute_temp_counts_degrees_of_freedom(lammps):
    """Against sums over the particles; velocities are relative to the mean."""
    style = "sph/micropolar"
    particles = make_box(lammps, style=style)
    text = deck(style, extra="compute T all sph/temp\nthermo_style custom step c_T c_T[*]\n"
                "thermo_modify format float %.17g\nset group all omega 0 0 0.7\n"
                "dump D all custom 1 t.dump id mass vx vy omegaz d_inertia\n"
                "dump_modify D sort id format float %.17g\n")
    thermo = lammps(text + "run 5\n").thermo()[0]
    frame = lammps.frame("t.dump")
    mass, n = frame["mass"], len(particles)
    for k, name in enumerate(("vx", "vy")):
        v = frame[name] - np.dot(mass, frame[name]) / mass.sum()
        assert thermo[f"c_T[{k + 1}]"][-1] == pytest.approx(np.dot(mass, v * v) / (n - 1), rel=1e-13)
    assert thermo["c_T[3]"][-1] == 0.0
    spin = np.dot(mass * frame["d_inertia"], frame["omegaz"]**2) / n
    assert thermo["c_T[4]"][-1] == pytest.approx(spin, rel=1e-13)
    mean = 0.5 * (thermo["c_T[1]"][-1] + thermo["c_T[2]"][-1])
    assert thermo["c_T"][-1] == pytest.approx(mean, rel=1e-13)


# ---- virial ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("style", ["sph/bulk", "sph/micropolar"])
def test_virial_by_pairs_and_in_total_agree(lammps, style):
    make_box(lammps, 3, style=style)
    text = deck(style, 3, extra="compute S all stress/atom NULL virial\n"
                "compute sum all reduce sum c_S[1] c_S[2] c_S[3]\ncompute P all pressure NULL virial\n"
                "thermo_style custom step c_P c_sum[*] vol\nthermo_modify norm no format float %.17g\n")
    hot = lammps(text + "run 3\n").thermo()[0]
    by_atom = -(hot["c_sum[1]"] + hot["c_sum[2]"] + hot["c_sum[3]"]) / (3.0 * hot["Volume"])
    assert relative(by_atom - hot["c_P"], hot["c_P"]) < 1e-12
    cold = lammps(text.replace("30.0", "0.0") + "run 0\n").thermo()[0]
    assert abs(hot["c_P"][0] - cold["c_P"][0]) > 1e-3 * abs(cold["c_P"][0])  # it is in both


# ---- errors ------------------------------------------------------------------------------------------------------


def fails(lammps, text, words, ranks=(1, 2)):
    for n in ranks:
        result = lammps(text, ranks=n, check=False)
        assert result.code != 0 and re.search(words, result.error), result.error or result.output[-2000:]


@pytest.mark.parametrize("options, words", [
    ("temp -1.0 5", "temp must be >= 0, not -1.0"), ("temp nan 5", "temp|nan"), ("temp 1.0 0", "seed must be > 0, not 0"),
    ("temp 1.0 -3", "seed must be > 0, not -3"), ("temp 1.0", "[Mm]issing"), ("temp", "[Mm]issing"),
    ("temp 1.0 2.5", "2.5"), ("temp hot 5", "hot"),
    ("temp 1.0 5 bulk volume", "bulk volume.*not symmetric"), ("temp 1.0 5 eos ideal", "eos ideal"),
])
def test_wrong_arguments(lammps, options, words):
    make_box(lammps)
    fails(lammps, deck(options=options) + "run 1\n", words)


def test_stokes_fluid_needs_the_limit(lammps):
    make_box(lammps)
    for options in ("", "limit count"):
        fails(lammps, deck(options=f"{HOT} {options}", kappa=0.9) + "run 1\n", "requires limit yes with kappa 0.9 of type 1")
    lammps(deck(options=f"{HOT} limit yes", kappa=0.9) + "run 1\n")
    lammps(deck(options=HOT, coeff="pair_coeff * * 1.0 10.0 0.3 0.6 3.0\n") + "run 1\n")  # zeta = 0 but for round-off


def test_what_noise_does_not_go_with(lammps):
    make_box(lammps)
    fails(lammps, deck() + "minimize 0 0 1 1\n", "temp cannot be used in a minimization")
    fails(lammps, deck(extra="timestep 0.0\n") + "run 1\n", "needs a time step > 0, not 0")
    fails(lammps, deck(extra="fix D all dt/reset 1 0.001 0.002 0.1\n") + "run 1\n", "cannot be used with fix dt/reset")
    fails(lammps, deck().replace("fix FLUID all sph/bulk", "fix FLUID all sph/bulk shift 0.1") + "run 1\n",
          "shift cannot be used with temp")
    for slip in ("slip free", "spin free", "spin rate 1.0"):
        text = deck().replace("fix FLUID all", "region low block INF INF INF 2.9 INF INF\ngroup wall region low\n"
                              "group fluid subtract all wall\nfix FLUID fluid")
        fails(lammps, text + f"fix W wall sph/wall {slip}\nrun 1\n", "only slip no and spin zero")


def test_particles_need_ids(lammps):
    fails(lammps, "units lj\ndimension 2\natom_style sph/bulk\natom_modify id no\nlattice sq 1.0\n"
          "region b block 0 8 0 8 -0.5 0.5\ncreate_box 1 b\ncreate_atoms 1 box\nset group all mass 1.0\n"
          "pair_style sph/bulk temp 1.0 5\npair_coeff * * 1.0 10.0 0.5 2.0 3.0\nfix 1 all sph/bulk\nrun 1\n",
          "needs particles with IDs")


@pytest.mark.parametrize("cells, words", [((5, 9), "x extent 5"), ((9, 5), "y extent 5")])
def test_box_narrower_than_two_supports(lammps, cells, words):
    lattice(2, cells).write(lammps.path("box.data"))
    fails(lammps, deck() + "run 1\n", f"{words}.*at least two support radii, 6")


def test_box_that_becomes_narrower_in_a_run(lammps):
    lattice(2, (7, 9)).write(lammps.path("box.data"))
    text = deck(extra="fix D all deform 1 x final 0 5.5 remap x\nneigh_modify delay 0 every 1\n")
    fails(lammps, text + "run 500\n", "x extent 5.9")


def test_narrow_box_that_is_not_periodic(lammps):
    lattice(2, (5, 9)).write(lammps.path("box.data"))
    lammps(deck(boundary="f p p") + "run 1\n")


# ---- messages ----------------------------------------------------------------------------------------------------


def test_rate_times_time_step_is_printed_and_warned_of(lammps):
    make_box(lammps)
    result = lammps(deck() + "run 1\nrun 1\ntimestep 0.05\nrun 1\n")
    lines = re.findall(r"thermal noise of temperature 30, seed 4711, largest viscous rate times time step (\S+)",
                       result.log)
    assert len(lines) == 2
    assert float(lines[1]) == pytest.approx(25.0 * float(lines[0]), rel=0.01)
    assert len([line for line in result.warnings if "hotter" in line]) == 1


@pytest.mark.parametrize("temperature, speed", [(24.0, None), (100.0, "1")])
def test_thermal_velocity_near_that_of_sound(lammps, temperature, speed):
    """The particles have the mass 1, the fluid the speed of sound 10."""
    make_box(lammps)
    warned = [re.search(r"the thermal velocity .* is (\S+) c0", line) for line in lammps(deck(options=f"temp {temperature} 1") + "run 0\n").warnings]
    assert [found[1] for found in warned if found] == ([speed] if speed else [])


def test_temp_without_viscosity_is_warned_of(lammps):
    make_box(lammps)
    for viscosities, temperature, count in (("0.0 0.0", 1.0, 1), ("0.0 0.5", 1.0, 0), ("0.5 2.0", 1.0, 0), ("0.0 0.0", 0.0, 0)):
        text = deck(options=f"temp {temperature} 5", coeff=f"pair_coeff * * 1.0 10.0 {viscosities} 3.0\n")
        result = lammps(text + "run 1\nrun 1\n")
        assert len([line for line in result.warnings if "temp has no effect without viscosity" in line]) == count


def test_open_boundaries_do_not_fluctuate(lammps):
    make_box(lammps)
    text = deck(extra="region low block INF 1.5 INF INF INF INF\ngroup inflow region low\n").replace(
        "boundary p p p", "boundary f p p")
    fails(lammps, text + "fix IN inflow sph/open 1.5 0.0 0.0 1.0 0.0 0.0 velocity 0.5 0.0 0.0\nrun 1\n", "sph/open")


# ---- walls -------------------------------------------------------------------------------------------------------


def at_walls(dim, form, velocity, support, commands, wall="", jitter=0.0):
    """Fluid on a lattice between two walls, y = -0.5 and 9.5."""
    ux, uy = velocity
    return (f"units lj\ndimension {dim}\nboundary p f p\natom_style sph/bulk\nlattice {'sq' if dim == 2 else 'sc'} 1.0\n"
            f"region box block 0 9 -5 15 {'-0.5 0.5' if dim == 2 else '0 7'}\ncreate_box 1 box\ncreate_atoms 1 box\n"
            "set group all mass 1.0\nregion fluid block INF INF -0.25 9.75 INF INF\ngroup fluid region fluid\n"
            "group wall subtract all fluid\nregion half block INF INF INF 4.75 INF INF\ngroup half region half\n"
            f"group near intersect fluid half\ndisplace_atoms fluid random {jitter} {jitter} {jitter if dim == 3 else 0.0} 5\n"
            f"variable u atom {ux}\nvariable v atom {uy}\nvelocity fluid set v_u v_v 0.0\n"
            f"pair_style sph/bulk shear {form} temp 1e-30 1\npair_coeff * * 1.0 10.0 0.5 2.0 {support} pb 3.0\n"
            f"fix 1 fluid sph/bulk\nfix W wall sph/wall {wall}\ntimestep 0.002\n"
            + commands + "thermo_modify norm no format float %.17g\nrun 0\n")


@pytest.mark.parametrize("dim, support", [(2, 3.0), (2, 4.0), (3, 3.0)])
@pytest.mark.parametrize("form", ["mg", "mg/fr", "mg/fr2", "morris", "espanol"])
def test_surface_of_walls(lammps, dim, support, form):
    """A linear profile that is zero at the surface has no force; how far off it is, from the force of another velocity.  A wall
    without the factor is 0.53 to 0.73 spacings off."""
    commands = "compute F near reduce sum fx\nthermo_style custom step c_F\n"
    force = [lammps(at_walls(dim, form, (velocity, "0.0"), support, commands)).thermo()[-1]["c_F"][0]
             for velocity in ("y+0.5", "1.0")]
    assert abs(force[0] / force[1]) < 0.003


@pytest.mark.parametrize("form", ["mg", "mg/fr", "mg/fr2", "morris", "espanol"])
def test_power_at_walls(lammps, form):
    """Energy of motion and heat with the work of a wall that travels, and turns where the forces have angular momentum; a fluid
    that turns with its wall has no friction then."""
    turns = form.startswith("mg")
    commands = ("variable p atom fx*vx+fy*vy\ncompute P fluid reduce sum v_p\ncompute E all property/atom desph\n"
                "compute H fluid reduce sum c_E\ncompute D all sph/dissipation\n"
                "thermo_style custom step c_P c_H f_W[*] c_D c_D[*]\n")
    wall = "velocity 0.3 0.2 0.0 move no" + " rotate 4.0 3.0 0.0 0.0 0.0 1.0 0.4" * turns
    random = ("normal(0.0,0.5,8)", "normal(0.0,0.5,9)")
    (table,) = lammps(at_walls(2, form, random, 3.0, commands, wall, jitter=0.2)).thermo()
    given = table["c_P"] + table["c_H"] + 0.3 * table["f_W[1]"] + 0.2 * table["f_W[2]"] + 0.4 * turns * table["f_W[6]"]
    assert table["c_D"][0] > 10.0 and abs(given[0]) < 1e-12 * table["c_D"][0]
    if turns:
        with_wall = ("0.3-0.4*(y-3.0)", "0.2+0.4*(x-4.0)")
        text = at_walls(2, form, with_wall, 3.0, commands, wall).replace("boundary p f p", "boundary f f p")
        (table,) = lammps(text).thermo()
        assert abs(table["c_D"][0]) < 1e-25


@pytest.mark.parametrize("options, kappa", [("", 0.8), (STOKES, 0.0)])
def test_temperature_between_walls(lammps, options, kappa):
    """Of the whole fluid and of the layer next to the walls; what the fluid loses the walls get."""
    text = ("units lj\ndimension 2\nboundary p f p\natom_style sph/bulk\nlattice sq 1.0\n"
            "region box block 0 20 -4 14 -0.5 0.5\ncreate_box 1 box\ncreate_atoms 1 box\nset group all mass 1.0\n"
            "region fluid block INF INF -0.25 9.75 INF INF\ngroup fluid region fluid\ngroup wall subtract all fluid\n"
            "displace_atoms fluid random 0.1 0.1 0.0 5\nvelocity fluid create 0.3 87 loop geom\n"
            f"pair_style sph/bulk {options} temp 0.3 99\npair_coeff * * 1.0 6.0 0.3 {kappa} 3.0 pb 20.0\n"
            "fix 1 fluid sph/bulk\nfix W wall sph/wall\ntimestep 0.006\n"
            "region near block INF INF INF 0.75 INF INF\ngroup near dynamic fluid region near every 1\n"
            "compute T fluid sph/temp\ncompute near near temp/partial 1 1 0\ncompute N near reduce sum v_one\n"
            "variable one atom 1\nvariable p equal vcm(fluid,y)*mass(fluid)\n"
            "run 1000\nreset_timestep 0\nfix av all ave/time 1 6000 6000 c_T c_T[1] c_T[2]\n"
            "thermo_style custom step f_av[*] v_p\nthermo 6000\nrun 6000\n")
    text = text.replace("compute near near temp/partial 1 1 0\ncompute N near reduce sum v_one\n", "")
    thermo = lammps(text, timeout=300).thermo()[-1]
    error = 0.3 * np.sqrt(2.0 / (200 * 36 * 0.5))
    for name in ("f_av[1]", "f_av[2]", "f_av[3]"):
        assert abs(thermo[name][-1] - 0.3) < 5 * error, name


def channel(style="sph/bulk", size=(20, 14), options="limit yes temp 0.3 1", coeff="0.5 0.5", extra="", pb=0.0):
    """A fluid between two walls of four rows, with a thermal speed of 0.09 of that of sound and no pressure on average."""
    spin = " 0.2 0.02 -0.02" if style == "sph/micropolar" else ""
    width, height = size
    return (f"units lj\ndimension 2\nboundary p f p\natom_style {style}\nlattice sq 1.0\n"
            f"region box block 0 {width} -4 {height + 4} -0.5 0.5\ncreate_box 1 box\ncreate_atoms 1 box\n"
            f"set group all mass 1.0\nregion fluid block INF INF -0.25 {height - 0.25} INF INF\n"
            "group fluid region fluid\ngroup wall subtract all fluid\nvelocity fluid create 0.3 1 loop geom\n"
            f"pair_style {style} {options}\npair_coeff * * 1.0 6.0 {coeff}{spin} 3.6 pb {pb}\nfix 1 fluid {style}"
            + (" inertia 0.16 0.0" if spin else "") + "\nfix W wall sph/wall\ntimestep 0.004\n"
            "compute low fluid reduce min y\ncompute high fluid reduce max y\n" + extra
            + "thermo_modify norm no format float %.17g\n")


SPLITTING = """variable phase equal "floor((step+1)/1000)%2"
variable target atom "1.0-0.75*v_phase*((y<3)+(y>10))"
fix R fluid sph/refine 20 volume v_target split 1.6 merge 0.7
"""


@pytest.mark.parametrize("style, options, extra", [
    ("sph/bulk", "limit yes temp 0.3 1", ""), ("sph/micropolar", "limit yes temp 0.3 1", ""),
    ("sph/bulk", "volume mass limit yes temp 0.07 1", SPLITTING)])
def test_no_particle_enters_a_wall(lammps, style, options, extra):
    """The surfaces are at -0.5 and 13.5: 0.25 beyond, the repulsion has 10 kT between two particles of the wall; a quarter of the spacing
    beyond if particles split there."""
    text = channel(style, options=options, extra=extra + "thermo_style custom step c_low c_high\nthermo 25\n")
    thermo = lammps(text + "run 2500\n", timeout=300).thermo()[-1]
    deepest = 0.25 if not extra else 0.5
    assert thermo["c_low"].min() > -0.5 - deepest and thermo["c_high"].max() < 13.5 + deepest
    assert thermo["c_low"].min() < -0.4


@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "off")])
def test_forces_of_walls_have_an_energy(lammps, ranks, newton):
    """Without friction there is no noise: energy is constant up to the square of the step, and the walls get the momentum."""
    drift = {}
    for dt in (0.004, 0.002):
        text = channel(size=(10, 8), options="temp 0.3 1", coeff="0.0 0.0", pb=4.0, extra=(
            f"displace_atoms fluid random 0.2 0.2 0.0 7\nvelocity fluid create 0.5 5 loop geom\ntimestep {dt}\n"
            "variable E equal ke+pe\nvariable p equal vcm(fluid,y)*mass(fluid)\n"
            "thermo_style custom step v_E ke pe c_low v_p f_W[2]\nthermo 1\n"))
        thermo = lammps(f"newton {newton}\n" + text + f"run {round(1.2 / dt)}\n", ranks=ranks).thermo()[-1]
        drift[dt] = np.abs(thermo["v_E"] - thermo["v_E"][0]).max()
        force = thermo["f_W[2]"]
        impulse = np.cumsum(0.5 * dt * (force[1:] + force[:-1]))
        assert thermo["c_low"].min() < -0.52 and np.ptp(thermo["KinEng"]) > 5.0
        assert np.abs(thermo["v_p"][1:] - thermo["v_p"][0] + impulse).max() < 1e-11
    assert drift[0.004] < 2e-3
    assert drift[0.002] < 0.3 * drift[0.004]


def test_repulsion_on_any_number_of_ranks_and_in_the_virial(lammps):
    lammps(channel(size=(16, 8), extra="displace_atoms fluid random 0.7 0.7 0.0 7\n") + "write_restart box.restart\n")
    text = ("read_restart box.restart\nfix 1 fluid sph/bulk\nfix W wall sph/wall\ntimestep 0.004\n"
            "compute low fluid reduce min y\ncompute S all stress/atom NULL virial\n"
            "compute sum all reduce sum c_S[1] c_S[2]\ncompute each all pe/atom\ncompute pe all reduce sum c_each\n"
            "compute P all pressure NULL virial\nthermo_style custom step c_P c_sum[*] vol pe c_pe c_low\n"
            "thermo_modify norm no format float %.17g\n" + dump("f.dump") + "run 0\n")
    reference = None
    for ranks, newton in ((1, "on"), (1, "off"), (2, "on"), (2, "off")):
        thermo = lammps(f"newton {newton}\n" + text, ranks=ranks).thermo()[-1]
        force, energy = lammps.frame("f.dump")["f"], thermo["PotEng"]
        assert thermo["c_low"][0] < -0.52
        assert relative(thermo["c_pe"] - energy, energy) < 1e-13
        by_atom = -(thermo["c_sum[1]"] + thermo["c_sum[2]"]) / (2.0 * thermo["Volume"])
        assert relative(by_atom - thermo["c_P"], thermo["c_P"]) < 1e-12
        reference = reference or (force, energy)
        assert relative(force - reference[0], reference[0]) < 1e-12, (ranks, newton)
        assert relative(energy - reference[1], energy) < 1e-13, (ranks, newton)


# ---- temperatures of the particles -------------------------------------------------------------------------------

ENERGY = "temp energy 20.0 4711"


def heated(style="sph/bulk", options="", ranks=1, extra="", mass=2.0, kappa=0.8, dt=0.004):
    """Two fluids with heat capacities of their own; all particles begin at temperature 1."""
    spin = " 0.1 0.02 -0.02" if style == "sph/micropolar" else ""
    return (f"units lj\ndimension 2\natom_style {style}\nlattice sq 1.0\nregion box block 0 12 0 12 -0.5 0.5\n"
            "create_box 2 box\ncreate_atoms 1 box\nset group all type/fraction 2 0.5 77\n"
            f"set type 1 mass 1.0\nset type 2 mass {mass}\n"
            "displace_atoms all random 0.1 0.1 0.0 5\nvelocity all create 1.0 87 loop geom\n"
            f"pair_style {style} {ENERGY} {options}\n"
            f"pair_coeff 1 1 1.0 6.0 0.3 {kappa}{spin} 3.0 pb 20.0\n"
            f"pair_coeff 2 2 {mass} 6.0 0.3 {kappa}{spin} 3.0 pb 20.0 cv 15.0\n"
            f"fix 1 all {style}" + (" inertia 0.16 0.0" if spin else "") + f"\ntimestep {dt}\n"
            "set group all sph/e 1000.0\ncompute elastic all pe/atom\nrun 0\n"
            f"variable start atom c_elastic+mass*(20.0*(type==1)+15.0*(type==2))\n"
            "dump D all custom 1 start.dump v_start\nrun 0\nundump D\nset group all sph/e v_start\n"
            "compute E all sph/energy\ncompute T all sph/temp\nthermo_modify norm no\n" + extra)


@pytest.mark.parametrize("style, options", [
    ("sph/bulk", ""), ("sph/bulk", "shear mg/fr volume mass"), ("sph/bulk", "shear mg/fr2"), ("sph/micropolar", "shear mg/fr2"), ("sph/bulk", "shear espanol"), ("sph/bulk", "bulk none"),
    ("sph/micropolar", "")])
@pytest.mark.parametrize("ranks, newton", [(1, "on"), (1, "off"), (2, "on")])
def test_total_energy_over_1000_steps(lammps, style, options, ranks, newton):
    """Motion, spin, and internal energy together are constant; each of them is not."""
    if (ranks == 2 or newton == "off") and style == "sph/bulk":
        pytest.skip("one case is enough")
    text = f"newton {newton}\n" + heated(style, options, extra="thermo_style custom step c_E c_E[1] c_E[2] c_T[5]\nthermo 50\n"
                  "thermo_modify norm no format float %.17g\n")
    thermo = lammps(text + "run 1000\n", ranks=ranks, timeout=300).thermo()[-1]
    energy = thermo["c_E"]
    assert np.abs(energy - energy[0]).max() < 1e-13 * energy[0]
    assert np.ptp(thermo["c_E[1]"]) > 1e-3 * energy[0]
    assert thermo["c_T[5]"][0] == pytest.approx(1.0, rel=1e-12)


def test_same_noise_of_own_temperatures_on_any_number_of_ranks(lammps):
    lammps(heated("sph/micropolar", mass=3.0) + "write_restart hot.restart\n")
    reference = None
    for ranks, newton in ((1, "on"), (1, "off"), (2, "on"), (4, "off")):
        lammps(f"newton {newton}\nread_restart hot.restart\nfix 1 all sph/micropolar inertia 0.16 0.0\ntimestep 0.004\n"
               + dump("f.dump", 1) + "run 5\n", ranks=ranks)
        frame = lammps.frames("f.dump")[-1]
        reference = frame["f"] if reference is None else reference
        assert relative(frame["f"] - reference, reference) < 1e-11, (ranks, newton)


PAIRS, APART = 500, 20.0


@pytest.mark.parametrize("mass", [1.0, 3.0])
def test_energy_of_two_particles(lammps, mass):
    """Of the motion of a pair that shares a constant energy with the heat of both, which remain equal: mean
    0.5/(2 C/k - 0.5) of it.  Without the terms of order k/C in the friction it would be 15 percent lower."""
    capacity, total = 3.0, 1e-6
    exact = 0.5 / (2.0 * capacity - 0.5)
    heat = 0.5 * total * (1.0 - exact)
    reduced = mass / (1.0 + mass)
    speed = np.sqrt(2.0 * (total - 2.0 * heat) / reduced)
    atoms, velocities = "", ""
    for k in range(PAIRS):
        for one, (place, m, sign) in enumerate(((5.0, 1.0, 1.0), (6.0, mass, -1.0))):
            atoms += f"{2 * k + one + 1} {one + 1} {m} {heat:.17g} {APART * k + place} 0 0\n"
            velocities += f"{2 * k + one + 1} {sign * speed * reduced / m:.17g} 0 0\n"
    lammps.path("pairs.data").write_text(
        f"pairs\n\n{2 * PAIRS} atoms\n2 atom types\n0 {APART * PAIRS} xlo xhi\n-10 10 ylo yhi\n-0.5 0.5 zlo zhi\n\n"
        f"Atoms # sph/bulk\n\n{atoms}\nVelocities\n\n{velocities}")
    result = lammps(
        "units lj\ndimension 2\natom_style sph/bulk\nread_data pairs.data\nneighbor 1.0 bin\n"
        f"pair_style sph/bulk dim 1 temp energy {capacity} 5\npair_coeff 1 1 1.0 1e-7 0.4 intrinsic 3.0\n"
        f"pair_coeff 2 2 {mass} 1e-7 0.4 intrinsic 3.0 cv {capacity / mass}\nfix 1 all sph/bulk\ntimestep 0.02\n"
        "compute E all sph/energy\nthermo_style custom step c_E[1] c_E\nthermo 50\n"
        "thermo_modify norm no format float %.17g\nrun 3000\nrun 20000\n", timeout=300)
    thermo = result.thermo()[-1]
    share = thermo["c_E[1]"] / thermo["c_E"]
    assert np.ptp(thermo["c_E"]) < 1e-13 * thermo["c_E"][0]
    blocks = share[1:].reshape(20, -1).mean(axis=1)
    error = blocks.std(ddof=1) / np.sqrt(len(blocks))
    assert error < 0.01 * exact
    assert abs(share.mean() - exact) < 4 * error + 0.01 * exact  # and one percent of the time step


def test_heat_of_each_mass_without_shear_viscosity(lammps):
    """A fluid that only has bulk viscosity is the limit of one with a little shear viscosity, particle by particle."""
    heats = []
    for mu in (0.0, 1e-30):
        text = heated(mass=4.0).replace(" 6.0 0.3 ", f" 6.0 {mu} ")
        lammps(text + "compute e all property/atom esph\ndump E all custom 50 e.dump id c_e\n"
               "dump_modify E sort id format float %.17g\nrun 50\n")
        heats.append(lammps.frame("e.dump")["c_e"])
    assert relative(heats[1] - heats[0], heats[0]) < 1e-12


@pytest.mark.parametrize("style", ["sph/bulk", "sph/micropolar"])
@pytest.mark.parametrize("ranks, newton", [(1, "on"), (1, "off"), (2, "on")])
def test_work_of_another_force_is_not_paid_by_the_heat(lammps, style, ranks, newton):
    """Each particle on a spring: energy of motion, heat, and springs, which first-order terms of the step would drain."""
    text = f"newton {newton}\n" + heated(style, extra=(
        "fix SPRING all spring/self 5.0\nvariable E equal c_E+f_SPRING\n"
        "thermo_style custom step c_E c_E[1] f_SPRING v_E\nthermo 250\nthermo_modify norm no format float %.17g\n"))
    thermo = lammps(text + "run 2000\n", ranks=ranks, timeout=300).thermo()[-1]
    drift = np.polyfit(thermo["Step"] * 0.004, thermo["v_E"], 1)[0]
    assert abs(drift) < 0.002 * thermo["c_E[1]"].mean()  # per time unit


def test_motion_spin_and_heat_have_one_temperature(lammps):
    """Kinetic temperature, that of the spins, and that of the heat of the particles agree, and those of both masses."""
    text = heated("sph/micropolar", mass=3.0, extra=(
        "group light type 1\ngroup heavy type 2\ncompute light light sph/temp\ncompute heavy heavy sph/temp\nrun 1000\n"
        "reset_timestep 0\nfix av all ave/time 1 6000 6000 c_T c_T[4] c_T[5] c_light c_heavy c_light[5] c_heavy[5]\n"
        "thermo_style custom step f_av[*]\nthermo 6000\n"))
    thermo = lammps(text + "run 6000\n", timeout=300).thermo()[-1]
    values = [column[-1] for name, column in thermo.items() if name.startswith("f_av")]
    error = np.sqrt(2.0 / (144 * 24 * 0.5))
    for value in values:
        assert abs(value / values[0] - 1.0) < 5 * error
    for light, heavy in ((3, 4), (5, 6)):
        assert abs(values[light] / values[heavy] - 1.0) < 10 * error


def test_restart_keeps_the_temperatures(lammps):
    lammps(heated() + "run 10\nwrite_restart ten.restart\n" + dump("whole.dump", 5) + "run 10\n")
    lammps("read_restart ten.restart\nfix 1 all sph/bulk\ntimestep 0.004\n" + dump("rest.dump", 5) + "run 10\n")
    for one, other in zip(lammps.frames("whole.dump"), lammps.frames("rest.dump")):
        for field in "xvf":
            assert relative(one[field] - other[field], one[field]) < 1e-12, (one.step, field)


@pytest.mark.parametrize("options, words", [
    ("temp energy 0.0 5", "heat capacity must be > 0, not 0.0"), ("temp energy -1.0 5", "must be > 0, not -1.0"),
    ("temp energy 5", "[Mm]issing"), ("temp energy", "[Mm]issing"), ("temp energy 1.0 0", "seed must be > 0, not 0"),
    ("temp energy 1.0 5", "particles have no heat.*set ... sph/e"), ("temp energy 1.0 5 limit yes", "kappa 0.1 of type 1"),
    ("temp energy 1.0 5 bulk volume", "bulk volume.*not symmetric")])
def test_wrong_arguments_of_temp_energy(lammps, options, words):
    make_box(lammps)
    kappa = 0.1 if "limit" in options else 2.0
    fails(lammps, deck(options=options, kappa=kappa, extra="set group all sph/e 0.0\n") + "run 1\n", words, ranks=(1,))
