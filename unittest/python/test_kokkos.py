"""The /kk styles against the CPU styles in the same LAMMPS, one built with the package KOKKOS.

SPHD_SWITCHES has the switches that turn the suffix on, for instance "-k on t 2 -sf kk".
"""

import numpy as np
import pytest

from helpers import FIELDS, INTEGRATE, SUPPORT, SWITCHES, disordered, dump, fluid, header, relative

pytestmark = pytest.mark.skipif("kk" not in SWITCHES, reason="no LAMMPS with the package KOKKOS, see ./sphd --help")

THERMO = ("compute HEAT all sph/dissipation\ncompute E all sph/energy\n"
          "thermo_style custom step temp pe press pxx pyy pzz pxy pxz pyz c_HEAT c_HEAT[1] c_HEAT[2] c_E\n"
          "thermo_modify norm no format float %.17g\n")


def script(particles, model, steps, newton="on", extra="", integrate=INTEGRATE, every=None, vfrac=0.0):
    return (f"{header(particles.dim, newton)}read_data data.txt\n{model}neighbor 0.2 bin\n"
            f"neigh_modify delay 0 every 1 check yes\n{integrate}{extra}{THERMO}"
            f"{dump('dump.txt', every or max(steps, 1))}thermo {every or max(steps, 1)}\nrun {steps}\n")


def both(lammps, particles, text, ranks=1):
    """Last frame and thermodynamic output of the CPU styles and of the /kk styles."""
    particles.write(lammps.path("data.txt"))
    results = []
    for switches in ([], SWITCHES):
        result = lammps(text, ranks=ranks, switches=switches)
        results.append((lammps.frame("dump.txt"), result.thermo()[-1], result))
    assert "sph/bulk/kk" in results[1][2].log, "the suffix had no effect"
    return results


def compare(lammps, particles, text, ranks=1, bound=1e-9):
    (cpu, thermo, _), (kokkos, thermo_kokkos, result) = both(lammps, particles, text, ranks)
    assert np.abs(cpu["x"] - kokkos["x"]).max() < bound  # in units of the spacing, 1
    for name in ("v", "f", *FIELDS[:6], "vest"):
        scale = np.abs(cpu[name]).max()
        assert np.abs(cpu[name] - kokkos[name]).max() <= bound * max(scale, 1e-3), name
    for name, column in thermo.items():
        assert relative(column - thermo_kokkos[name], np.append(column, 1e-3)) < bound, name
    return result


def fluids(dim, ntypes=1, keywords="", options="", kappa=2.0):
    if ntypes == 1:
        return fluid(dim, options, kappa=kappa, keywords=keywords)
    rc = SUPPORT[dim]
    coeff = (f"pair_coeff 1 1 1.0 10.0 0.5 {kappa} {rc} {keywords}\n"
             f"pair_coeff 2 2 1.2 9.0 0.3 1.5 {rc} {keywords}\n")
    return fluid(dim, options, coeff=coeff)


# ---------------------------------------------------------------------------------------------
# trajectories


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("ranks", [1, 2, 4])
def test_trajectory(lammps, newton, ranks):
    """200 steps, in which particles change processors and the neighbor lists are built anew."""
    particles = disordered(2, 20, seed=3, jitter=0.1, speed=0.5, spread=0.0)
    compare(lammps, particles, script(particles, fluids(2), 200, newton), ranks)


@pytest.mark.parametrize("options", ["eos tait shear morris", "eos linear shear espanol bulk volume",
                                     "eos ideal", "volume mass shear mg/fr", "volume mass bulk volume",
                                     "bulk none shear none"])
@pytest.mark.parametrize("ntypes", [1, 2])
def test_forms(lammps, options, ntypes):
    kappa = 0.0 if "none" in options else 2.0
    particles = disordered(2, 14, seed=4, jitter=0.1, ntypes=ntypes, speed=0.3, spread=0.0)
    model = fluids(2, ntypes, options=options, kappa=kappa)
    if "none" in options:
        model = fluid(2, options, mu=0.0, kappa=0.0)
    compare(lammps, particles, script(particles, model, 50), ranks=2)


@pytest.mark.parametrize("kernel", ["wendland/c2", "wendland/c4", "wendland/c6", "cubic", "quintic", "lucy"])
def test_kernels(lammps, kernel):
    particles = disordered(3, 8, seed=5, jitter=0.1, speed=0.3, spread=0.0)
    compare(lammps, particles, script(particles, fluids(3, options=f"kernel {kernel}"), 10), ranks=2)


def test_triclinic_box_and_sorting(lammps):
    particles = disordered(2, 16, seed=6, jitter=0.1, tilt=(3.0, 0.0, 0.0), spread=0.0)
    text = script(particles, fluids(2), 100).replace("read_data", "atom_modify sort 10 2.0\nread_data")
    compare(lammps, particles, text, ranks=2)


def test_velocities_of_ghosts(lammps):
    """comm_modify vel yes sends more than the own fields."""
    particles = disordered(2, 16, seed=7, jitter=0.1, spread=0.0)
    compare(lammps, particles, script(particles, fluids(2), 50).replace("read_data", "comm_modify vel yes\nread_data"),
            ranks=2)


def test_particles_of_another_integrator(lammps):
    particles = disordered(2, 16, seed=8, jitter=0.1, spread=0.0)
    integrate = ("region LOW block INF INF 0 5 INF INF\ngroup LOW region LOW\ngroup REST subtract all LOW\n"
                 "velocity LOW set 0.3 0.0 0.0\nfix FLUID REST sph/bulk\nfix MOVE LOW nve/noforce\ntimestep 0.005\n")
    compare(lammps, particles, script(particles, fluids(2), 50, integrate=integrate), ranks=2)


# ---------------------------------------------------------------------------------------------
# output


def test_stress_of_atoms(lammps):
    particles = disordered(2, 14, seed=9, jitter=0.1, spread=0.0)
    extra = ("compute S all stress/atom NULL virial\ncompute P all pe/atom\ncompute SUM all reduce sum c_S[1] c_S[4] c_P\n"
             "compute Q all sph/dissipation\n")
    text = script(particles, fluids(2), 10, extra=extra).replace(" c_E\n", " c_E c_SUM[*]\n")
    compare(lammps, particles, text, ranks=2)


def test_output_on_the_way(lammps):
    """Every output of a run sees the values of its step."""
    particles = disordered(2, 14, seed=10, jitter=0.1, spread=0.0)
    text = script(particles, fluids(2), 20, every=5)
    (_, thermo, _), (_, thermo_kokkos, _) = both(lammps, particles, text)
    frames = lammps.frames("dump.txt")
    lammps(text, switches=[])
    for cpu, kokkos in zip(lammps.frames("dump.txt"), frames):
        for name in ("x", "v", "f", *FIELDS[:6], "vest"):
            assert relative(cpu[name] - kokkos[name], np.append(cpu[name], 1e-3)) < 1e-10, (cpu.step, name)
    assert len(frames) == 5 and len(thermo["Step"]) == 5
    for name, column in thermo.items():
        assert relative(column - thermo_kokkos[name], np.append(column, 1e-3)) < 1e-10, name


@pytest.mark.parametrize("writer", ["cpu", "kk"])
def test_restart(lammps, writer):
    """A run continued by the other family goes on as one without a break."""
    first, second = ([], SWITCHES) if writer == "cpu" else (SWITCHES, [])
    particles = disordered(2, 14, seed=11, jitter=0.1, spread=0.0)
    particles.write(lammps.path("data.txt"))
    lammps(script(particles, fluids(2), 40) + "write_restart file.restart\n", switches=first, ranks=2)
    lammps(f"read_restart file.restart\n{INTEGRATE}{dump('again.txt', 20)}run 20\n", switches=second)
    lammps(script(particles, fluids(2), 40) + "write_restart file.restart\n", switches=[], ranks=2)
    lammps(f"read_restart file.restart\n{INTEGRATE}{dump('cpu.txt', 20)}run 20\n", switches=[])
    cpu, mixed = lammps.frame("cpu.txt"), lammps.frame("again.txt")
    for name in ("x", "v", "esph", "rho", "f"):
        assert relative(cpu[name] - mixed[name], cpu[name]) < 1e-9, name


def test_density_keyword(lammps):
    particles = disordered(2, 14, seed=12, jitter=0.1, spread=0.0)
    integrate = "fix FLUID all sph/bulk density rho0\ntimestep 0.005\n"
    compare(lammps, particles, script(particles, fluids(2), 20, integrate=integrate), ranks=2)


# ---------------------------------------------------------------------------------------------
# limit and shift: further sums


@pytest.mark.parametrize("options", ["limit yes", "limit count", "limit yes volume mass shear mg/fr"])
@pytest.mark.parametrize("ntypes", [1, 2])
def test_limit(lammps, options, ntypes):
    """A coefficient of the bulk term that is below the bound of some of the particles, and their number."""
    rc = SUPPORT[2]
    coeff = f"pair_coeff 1 1 1.0 10.0 0.5 0.0 {rc}\n"
    if ntypes == 2:
        coeff += f"pair_coeff 2 2 1.2 9.0 0.3 0.0 {rc}\n"
    particles = disordered(2, 14, seed=23, jitter=0.1, ntypes=ntypes, speed=0.3, spread=0.0)
    text = script(particles, fluid(2, options, coeff=coeff), 20, extra="compute B all pair sph/bulk\n", every=20)
    text = text.replace(" c_E\n", " c_E c_B[1]\n")
    result = compare(lammps, particles, text, ranks=2)
    beyond = result.thermo()[-1]["c_B[1]"]
    assert 0 < beyond[-1] < len(particles), beyond
    assert not any("on the host" in line for line in result.warnings)


SHIFT = "fix FLUID all sph/bulk shift 0.5\ntimestep 0.005\n"


@pytest.mark.parametrize("dim, options, ranks, newton", [(2, "", 1, "on"), (2, "kernel cubic", 4, "off"), (3, "volume mass", 2, "on")])
def test_shift(lammps, dim, options, ranks, newton):
    particles = disordered(dim, {2: 16, 3: 7}[dim], seed=24, jitter=0.2, speed=0.2, spread=0.0)
    result = compare(lammps, particles, script(particles, fluids(dim, options=options), 100, newton, integrate=SHIFT), ranks)
    assert not any("on the host" in line for line in result.warnings)


def test_shift_at_walls(lammps):
    particles = disordered(2, 20, seed=25, jitter=0.1, speed=0.2, spread=0.0)
    text = with_walls(particles, "cavity", fluids(2), 100).replace("fix FLUID REST sph/bulk\n", "fix FLUID REST sph/bulk shift 0.5\n")
    compare_walls(lammps, particles, text, 2)


# ---------------------------------------------------------------------------------------------
# walls

CHANNEL = ("region LOW block INF INF INF 3.2 INF INF\nregion HIGH block INF INF 16.8 INF INF INF\n"
           "group FLOOR region LOW\ngroup LID region HIGH\ngroup REST subtract all FLOOR LID\n")
CAVITY = ("region IN block 3.2 16.8 3.2 16.8 INF INF\nregion HIGH block 3.2 16.8 16.8 INF INF INF\n"
          "group REST region IN\ngroup LID region HIGH\ngroup FLOOR subtract all REST LID\n")
WHEEL = CHANNEL.replace("group REST subtract all FLOOR LID", "region HUB cylinder z 10 10 2.6 INF INF\ngroup HUB region HUB\n"
                        "group REST subtract all FLOOR LID HUB")
BODY = "fix G REST addforce 0.3 -0.2 0\n"
VESSELS = {
    "channel": (CHANNEL + BODY, "gravity 0.3 -0.2 0", "gravity 0.3 -0.2 0"),
    "slip": (CHANNEL + BODY, "slip free gravity 0.3 -0.2 0", "velocity 0.5 0 0 move no slip free"),
    "cavity": (CAVITY, "", "velocity 0.5 0 0 move no"),
    "wheel": (WHEEL + "fix HUB HUB sph/wall rotate 10 10 0 0 0 1 0.5 velocity 0.2 0 0\n", "velocity -0.3 0 0", "slip free"),
    "variable": (CHANNEL + "variable U equal 0.4*sin(20*step*dt)\nvariable Y equal -0.1-0.2*vcm(REST,y)\n",
                 "velocity v_U 0 0", "velocity 0.2 v_Y 0"),
}


def with_walls(particles, name, model, steps, newton="on", every=None, step=0.005):
    groups, floor, lid = VESSELS[name]
    integrate = (groups + "fix FLUID REST sph/bulk\n" + f"fix FLOOR FLOOR sph/wall {floor}\nfix LID LID sph/wall {lid}\ntimestep {step}\n")
    text = script(particles, model, steps, newton, integrate=integrate, every=every)
    columns = " ".join(f"f_{wall}[{k}]" for wall in ("FLOOR", "LID") for k in (1, 2, 6))
    return text.replace(" c_E\n", f" c_E {columns}\n").replace("c_F[*] ", "c_F[*] f_FLOOR[*] f_LID[*] ")


def compare_walls(lammps, particles, text, ranks=1, bound=1e-9):
    cpu, kokkos = (result[0] for result in both(lammps, particles, text, ranks))
    scale = np.abs(cpu["f"]).max()
    for name in cpu.columns:
        if name.startswith("f_"):
            assert np.abs(cpu[name] - kokkos[name]).max() < bound * scale, name
    assert np.abs(cpu["f_LID[1]"]).max() > 1e-3 * scale
    result = compare(lammps, particles, text, ranks, bound)
    assert not any("on the host" in line or "legacy" in line for line in result.warnings), result.warnings
    return result


@pytest.mark.parametrize("name", VESSELS)
@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "off"), (4, "on")])
def test_walls(lammps, name, ranks, newton):
    """Walls at rest, moving, turning; forces on them; particles that change processors, the wall's own among them."""
    particles = disordered(2, 20, seed=16, jitter=0.1, speed=0.2, spread=0.0)
    compare_walls(lammps, particles, with_walls(particles, name, fluids(2), 200, newton), ranks)


@pytest.mark.parametrize("options", ["eos tait shear morris bulk volume", "eos ideal", "volume mass shear espanol",
                                     "kernel quintic bulk none"])
def test_walls_of_several_types(lammps, options):
    particles = disordered(2, 20, seed=17, jitter=0.1, ntypes=2, speed=0.2, spread=0.0)
    compare_walls(lammps, particles, with_walls(particles, "channel", fluids(2, 2, options=options, kappa=2.0), 40), 2)


def test_walls_in_three_dimensions(lammps):
    particles = disordered(3, (6, 20, 6), seed=18, jitter=0.1, speed=0.2, spread=0.0)
    compare_walls(lammps, particles, with_walls(particles, "slip", fluids(3), 40), 2)


def test_walls_in_an_oblique_box_and_sorting(lammps):
    particles = disordered(2, 20, seed=19, jitter=0.1, speed=0.2, tilt=(3.0, 0.0, 0.0), spread=0.0)
    text = with_walls(particles, "channel", fluids(2), 60).replace("read_data", "atom_modify sort 10 2.0\nread_data")
    compare_walls(lammps, particles, text, 2)


def test_output_of_walls_on_the_way(lammps):
    particles = disordered(2, 20, seed=20, jitter=0.1, speed=0.2, spread=0.0)
    text = with_walls(particles, "wheel", fluids(2), 20, every=4)
    (_, thermo, _), (_, thermo_kokkos, _) = both(lammps, particles, text)
    frames = lammps.frames("dump.txt")
    lammps(text, switches=[])
    for cpu, kokkos in zip(lammps.frames("dump.txt"), frames):
        for name in ("x", "v", *FIELDS, *(name for name in cpu.columns if name.startswith("f_"))):
            assert relative(cpu[name] - kokkos[name], np.append(cpu["f"], 1.0)) < 1e-11, (cpu.step, name)
    assert len(frames) == 6
    for name, column in thermo.items():
        assert relative(column - thermo_kokkos[name], np.append(column, 1e-3)) < 1e-10, name


@pytest.mark.parametrize("writer", ["cpu", "kk"])
def test_restart_with_walls(lammps, writer):
    """The point that the wheel turns about goes on, whichever family has written the file."""
    particles = disordered(2, 20, seed=21, jitter=0.1, speed=0.2, spread=0.0)
    particles.write(lammps.path("data.txt"))
    frames = []
    for first, second in (([], []), ([], SWITCHES) if writer == "cpu" else (SWITCHES, [])):
        text = with_walls(particles, "wheel", fluids(2), 40)
        lammps(text + "write_restart file.restart\n", switches=first, ranks=2)
        again = "read_restart file.restart\n" + "".join(line + "\n" for line in text.splitlines()
                                                       if line.startswith(("fix ", "timestep", "neigh")))
        lammps(again + dump("again.txt", 40) + "run 40\n", switches=second, ranks=2)
        frames.append(lammps.frame("again.txt"))
    for name in ("x", "v", "esph", "rho", "f"):
        assert relative(frames[0][name] - frames[1][name], frames[0][name]) < 1e-9, name


@pytest.mark.parametrize("ranks", [1, 2])
def test_particle_in_a_wall(lammps, ranks):
    particles = disordered(2, 20, seed=22, jitter=0.05, speed=0.0, spread=0.0)
    shot = np.flatnonzero((np.abs(particles.x[:, 1] - 4.5) < 0.3) & (np.abs(particles.x[:, 0] - 8.5) < 0.4))[0]
    particles.v[shot] = [0.0, -300.0, 0.0]
    particles.write(lammps.path("data.txt"))
    result = lammps(with_walls(particles, "channel", fluids(2), 100, step=0.002), ranks=ranks, check=False)
    assert result.code != 0 and f"Particle {shot + 1} of the fluid of pair style sph/bulk is inside a wall" in result.error


# ---------------------------------------------------------------------------------------------
# what the CPU style does, on the host


@pytest.mark.parametrize("reason, options, integrate", [
    ("keyword temp", "temp 0.01 1234", INTEGRATE),
    ("fix sph/wall", "", "region LOW block INF INF 0 3.2 INF INF\ngroup WALL region LOW\ngroup REST subtract all WALL\n"
     "fix FLUID REST sph/bulk\nsuffix off\nfix WALL WALL sph/wall\ntimestep 0.005\n"),
])
def test_on_the_host(lammps, reason, options, integrate):
    particles = disordered(2, 20, seed=13, jitter=0.1, speed=0.1, spread=0.0)
    result = compare(lammps, particles, script(particles, fluids(2, options=options), 20, integrate=integrate), ranks=2)
    assert any("on the host" in line and reason in line for line in result.warnings), result.warnings


def test_no_warning_on_the_device(lammps):
    particles = disordered(2, 14, seed=14, jitter=0.1, spread=0.0)
    result = compare(lammps, particles, script(particles, fluids(2), 5))
    assert not any("on the host" in line for line in result.warnings)


def test_hybrid_is_refused(lammps):
    particles = disordered(2, 14, seed=15, jitter=0.1, spread=0.0)
    particles.write(lammps.path("data.txt"))
    model = f"pair_style hybrid/overlay sph/bulk dim 2\npair_coeff * * sph/bulk 1.0 10.0 0.5 2.0 {SUPPORT[2]}\n"
    result = lammps(script(particles, model, 1), check=False)
    assert result.code != 0 and "hybrid" in result.error
