"""The /kk styles against the CPU styles in the same LAMMPS, one built with the package KOKKOS.

SPHD_SWITCHES has the switches that turn the suffix on, for instance "-k on t 2 -sf kk"; the pair loops are those of a GPU with
"-sf kk/device".
"""

import os
import subprocess
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from helpers import DEVICE_LOOPS, FIELDS, KOKKOS, SUPPORT, SWITCHES, VECTORS, disordered, dump, fluid, header, lattice, relative
import open_boundaries
import test_continuity as continuity
import test_micropolar as micropolar
import test_open_ledger as ledger
import test_relax as relax

pytestmark = pytest.mark.skipif(not KOKKOS, reason="no LAMMPS with the package KOKKOS, see ./sphd --help")

STYLES = ("sph/bulk", "sph/micropolar")
SPIN_VECTORS = {"omega": ("omegax", "omegay", "omegaz"), "torque": ("tqx", "tqy", "tqz"),
                "omegaest": ("c_SPIN[2]", "c_SPIN[3]", "c_SPIN[4]")}


@pytest.fixture(params=STYLES)
def style(request):
    """Each test runs for both fluids."""
    return request.param


def spinning(style):
    return style == "sph/micropolar"


def integrate(style, keywords="", group="all"):
    inertia = "inertia 0.3 0.05 " if spinning(style) else ""
    return f"fix FLUID {group} {style} {inertia}{keywords}\ntimestep 0.005\n"


def output(style, every):
    """Everything that the particles have, and the totals."""
    channels = "c_HEAT[*]"
    text = "compute HEAT all sph/dissipation\ncompute E all sph/energy\n"
    extra = ""
    if spinning(style):
        text += "compute L all sph/angmom\ncompute SPIN all property/atom inertia omegaestx omegaesty omegaestz\n"
        channels += " c_L[3]"
        extra = "omegax omegay omegaz tqx tqy tqz c_SPIN[*] d_inertia"
    return (f"{text}thermo_style custom step temp pe press pxx pyy pzz pxy pxz pyz c_HEAT {channels} c_E[4] c_E\n"
            f"thermo_modify norm no format float %.17g\n{dump('dump.txt', every, extra)}thermo {every}\n")


def script(style, particles, model, steps, newton="on", extra="", fixes=None, every=None):
    fixes = integrate(style) if fixes is None else fixes
    return (f"{header(particles.dim, newton, style=style)}read_data data.txt\n{model}neighbor 0.2 bin\n"
            f"neigh_modify delay 0 every 1 check yes\n{fixes}{extra}{output(style, every or max(steps, 1))}run {steps}\n")


def write(lammps, style, particles):
    if spinning(style):
        micropolar.write(particles, lammps.path("data.txt"))
    else:
        particles.write(lammps.path("data.txt"))


def both(lammps, style, particles, text, ranks=1):
    """Last frame and thermodynamic output of the CPU styles and of the /kk styles."""
    write(lammps, style, particles)
    results = []
    for switches in ([], SWITCHES):
        result = lammps(text, ranks=ranks, switches=switches)
        results.append((lammps.frame("dump.txt"), result.thermo()[-1], result))
    assert f"{style}/kk" in results[1][2].log, "the suffix had no effect"
    return results


def fields(style, frame):
    """By name; of a vector all components."""
    result = {name: frame[name] for name in (*FIELDS[:6], *VECTORS)}
    if spinning(style):
        result.update((name, micropolar.vector(frame, *columns)) for name, columns in SPIN_VECTORS.items())
        result["inertia"] = frame["c_SPIN[1]"]
        assert np.all(frame["d_inertia"] == frame["c_SPIN[1]"])
    return result


def assert_same(style, cpu, kokkos, bound):
    cpu, kokkos = fields(style, cpu), fields(style, kokkos)
    assert np.abs(cpu["x"] - kokkos["x"]).max() < bound  # in units of the spacing, 1
    for name, values in cpu.items():
        assert np.abs(values - kokkos[name]).max() <= bound * max(np.abs(values).max(), 1e-3), name


def assert_same_totals(cpu, kokkos, bound):
    for name, column in cpu.items():
        assert relative(column - kokkos[name], np.append(column, 1e-3)) < bound, name


def compare(lammps, style, particles, text, ranks=1, bound=1e-9):
    (cpu, thermo, _), (kokkos, thermo_kokkos, result) = both(lammps, style, particles, text, ranks)
    assert_same(style, cpu, kokkos, bound)
    assert_same_totals(thermo, thermo_kokkos, bound)
    return result


def fluids(style, dim, ntypes=1, options="", kappa=2.0):
    rc = SUPPORT[dim]
    if spinning(style):
        return micropolar.fluid(dim, options, kappa=kappa) if ntypes == 1 else micropolar.two_fluids(dim, options)
    if ntypes == 1:
        return fluid(dim, options, kappa=kappa)
    return fluid(dim, options, coeff=f"pair_coeff 1 1 1.0 10.0 0.5 {kappa} {rc}\npair_coeff 2 2 1.2 9.0 0.3 1.5 {rc}\n")


# ---------------------------------------------------------------------------------------------
# trajectories


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("ranks", [1, 2, 4])
def test_trajectory(lammps, style, newton, ranks):
    """200 steps, in which particles change processors and the neighbor lists are built anew."""
    particles = disordered(2, 20, seed=3, jitter=0.1, speed=0.5, spread=0.0)
    compare(lammps, style, particles, script(style, particles, fluids(style, 2), 200, newton), ranks)


def test_trajectory_in_3d(lammps, style):
    particles = disordered(3, 8, seed=3, jitter=0.1, speed=0.5, spread=0.0, ntypes=2)
    compare(lammps, style, particles, script(style, particles, fluids(style, 3, 2), 200), ranks=2)


@pytest.mark.parametrize("style, options", [
    *(("sph/bulk", options) for options in (
        "eos tait shear morris", "eos linear shear espanol bulk volume", "eos ideal", "volume mass shear mg/fr", "shear mg/fr2",
        "volume mass bulk volume", "bulk none shear none")),
    *(("sph/micropolar", options) for options in (
        "eos tait bulk volume", "eos ideal", "volume mass bulk volume", "bulk none"))])
@pytest.mark.parametrize("ntypes", [1, 2])
def test_forms(lammps, style, options, ntypes):
    particles = disordered(2, 14, seed=4, jitter=0.1, ntypes=ntypes, speed=0.3, spread=0.0)
    model = fluids(style, 2, ntypes, options=options)
    if "shear none" in options:
        model = fluid(2, options, mu=0.0, kappa=0.0)
    compare(lammps, style, particles, script(style, particles, model, 50), ranks=2)


@pytest.mark.parametrize("ranks", [1, 2])
def test_drag(lammps, style, ranks):
    """One of two types, changed on the way."""
    particles = disordered(2, 14, seed=4, jitter=0.1, ntypes=2, speed=0.3, spread=0.0)
    lines = fluids(style, 2, 2).splitlines()
    model = "".join(line + (" drag 0.4 0.2 -0.1 0" if line.startswith("pair_coeff 2 2") else "") + "\n" for line in lines)
    extra = f"variable B equal 0.4+0.02*step\nfix CHANGE all adapt 5 pair {style} drag 2 2 v_B\n"
    compare(lammps, style, particles, script(style, particles, model, 50, extra=extra), ranks)


@pytest.mark.parametrize("ranks, options", [(1, ""), (2, "limit yes"), (2, "bulk volume"), (1, "temp 0.01 1234")])
def test_drag_between_fluids(lammps, style, ranks, options):
    """Changed on the way, from zero."""
    particles = disordered(2, 14, seed=4, jitter=0.1, ntypes=2, speed=0.3, spread=0.0)
    extra = f"variable B equal 0.04*step\nfix CHANGE all adapt 5 pair {style} interdrag 1 2 v_B\n"
    compare(lammps, style, particles, script(style, particles, fluids(style, 2, 2, options), 50, extra=extra), ranks)


@pytest.mark.parametrize("ranks, options", [(1, "eos ideal"), (2, "volume mass"), (4, "")])
def test_relaxing_processes(lammps, style, ranks, options):
    """Two of one type and one of the other, changed on the way; of the gas another one of the vibrations; particles are sorted, and
    move between processors."""
    particles = disordered(2, 14, seed=4, jitter=0.1, ntypes=2, speed=2.0, spread=0.0)
    particles.esph[:] = 80.0
    strain = np.random.default_rng(3).uniform(-0.05, 0.05, (len(particles), 2))
    strain[particles.type == 2, 1] = 0.0
    relax.write(particles, lammps.path("room.txt"), relax.strained(strain), style)
    words = {"pair_coeff 1 1": " relax 8.0 0.01 4.0 1.0", "pair_coeff 2 2": " relax 5.0 0.2"}
    if "ideal" in options:
        words["pair_coeff 2 2"] += " cv 2.5 vibration 1.0 0.05"
    model = "".join(line + words.get(line[:14], "") + "\n" for line in fluids(style, 2, 2, options).splitlines())
    extra = f"variable T equal 0.2+0.002*step\nfix CHANGE all adapt 5 pair {style} tau 2 2 v_T\natom_modify sort 5 1.5\n"
    text = script(style, particles, model, 50, extra=extra).replace("data.txt", "room.txt")
    compare(lammps, style, particles, text.replace(f"atom_style {style}", f"atom_style {style} relax 2"), ranks)


@pytest.mark.parametrize("ranks", [1, 2])
def test_most_processes(lammps, style, ranks):
    """As many as there are, in all arrays that migrate; the other type has vibrations."""
    particles = disordered(2, 14, seed=4, jitter=0.1, ntypes=2, speed=2.0, spread=0.0)
    particles.esph[:] = 80.0
    strain = np.random.default_rng(3).uniform(-0.05, 0.05, (len(particles), 8))
    strain[particles.type == 2, 1:] = 0.0
    relax.write(particles, lammps.path("room.txt"), relax.strained(strain), style)
    words = {"pair_coeff 1 1": " relax" + "".join(f" {k} {0.01 * k}" for k in range(1, 9)), "pair_coeff 2 2": " relax 5.0 0.2 cv 2.5 vibration 1.0 0.05"}
    model = "".join(line + words.get(line[:14], "") + "\n" for line in fluids(style, 2, 2, "eos ideal").splitlines())
    text = script(style, particles, model, 50, extra="atom_modify sort 5 1.5\n").replace("data.txt", "room.txt")
    compare(lammps, style, particles, text.replace(f"atom_style {style}", f"atom_style {style} relax 8"), ranks)


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("options, viscous", [("eos tait", ""), ("eos ideal volume mass", ""), ("eos tait", " viscous rkl2")])
def test_conduction_of_heat(lammps, style, ranks, options, viscous):
    """Two types with thermal pressure, temperatures that the fix has set, a conductivity that changes on the way."""
    particles = disordered(2, 14, seed=4, jitter=0.1, ntypes=2, speed=0.3, spread=0.0)
    gruneisen = "" if "ideal" in options else " gruneisen 0.6 2.0"
    words = {"pair_coeff 1 1": " cv 2.0 conductivity 0.7" + gruneisen, "pair_coeff 2 2": " cv 1.2 conductivity 0.4" + gruneisen}
    lines = fluids(style, 2, 2, options=options).splitlines()
    model = "".join(line + words.get(line[:14], "") + "\n" for line in lines)
    extra = (f"variable K equal 0.4+0.02*step\nfix CHANGE all adapt 5 pair {style} conductivity 2 2 v_K\nvariable T atom 2.0+0.1*x\n")
    text = script(style, particles, model, 50, extra=extra).replace(f"fix FLUID all {style}", f"fix FLUID all {style} temperature v_T{viscous}")
    assert "temperature v_T" in text
    result = compare(lammps, style, particles, text, ranks)
    warned = any("on the host" in line and "viscous with conduction of heat" in line for line in result.warnings)
    assert warned == (DEVICE_LOOPS and bool(viscous)), result.warnings


@pytest.mark.parametrize("ranks, diffusivity", [(1, 0.0), (2, 0.3), (4, 0.3)])
def test_solute(lammps, style, ranks, diffusivity):
    """Of one of two types, with a diffusivity that changes on the way, while the other one's stays; particles are sorted."""
    particles = disordered(2, 14, seed=4, jitter=0.1, ntypes=2, speed=2.0, spread=0.0)
    amount = np.random.default_rng(3).uniform(-1.0, 3.0, (len(particles), 1))
    relax.write(particles, lammps.path("room.txt"), amount, style)
    words = {"pair_coeff 1 1": f" solute {diffusivity}", "pair_coeff 2 2": " solute 0.1"}
    model = "".join(line + words.get(line[:14], "") + "\n" for line in fluids(style, 2, 2).splitlines())
    extra = f"variable D equal {diffusivity}+0.02*step\nfix CHANGE all adapt 5 pair {style} solute 1 1 v_D\natom_modify sort 5 1.5\n"
    text = script(style, particles, model, 50, extra=extra).replace("data.txt", "room.txt").replace("c_F[*] ", "c_F[*] d_solute ")
    (cpu, _, _), (kokkos, _, _) = both(lammps, style, particles, text.replace(f"atom_style {style}", f"atom_style {style} solute"), ranks)
    assert_same(style, cpu, kokkos, 1e-9)
    assert relative(cpu["d_solute"] - kokkos["d_solute"], cpu["d_solute"]) < 1e-9
    assert abs(kokkos["d_solute"].sum() - amount.sum()) < 1e-12 * np.abs(amount).sum()
    assert relative(cpu["d_solute"] - amount[:, 0], amount) > 1e-2


@pytest.mark.parametrize("ranks, options, walls", [(1, "eos ideal", False), (2, "volume mass", False), (1, "", True), (2, "", True)])
def test_noise_of_heat(lammps, style, ranks, options, walls):
    """Temperatures of particles of two masses, their conduction and its random flow; between a heat bath and an adiabatic wall."""
    particles = disordered(2, 20 if walls else 14, seed=4, jitter=0.1, ntypes=2, speed=0.3, spread=0.0)
    particles.esph[:] = 80.0
    words = {"pair_coeff 1 1": " cv 20.0 conductivity 7.0", "pair_coeff 2 2": " cv 12.0 conductivity 4.0"}
    lines = fluids(style, 2, 2, options=f"temp energy 20.0 77 {options}").splitlines()
    model = "".join(line + words.get(line[:14], "") + "\n" for line in lines)
    fixes = integrate(style)
    if walls:
        fixes = ("region LOW block INF INF 0 3.2 INF INF\nregion HIGH block INF INF 16.8 INF INF INF\ngroup LOW region LOW\n"
                 "group HIGH region HIGH\ngroup REST subtract all LOW HIGH\n" + integrate(style, group="REST")
                 + "fix LOW LOW sph/wall heat temp 5.0\nfix HIGH HIGH sph/wall velocity 0.1 0 0\n")
    text = script(style, particles, model, 30, fixes=fixes)
    if walls:
        text = text.replace(" c_E\n", " c_E f_LOW[7] f_LOW[8]\n")
    compare(lammps, style, particles, text, ranks)


@pytest.mark.parametrize("kernel", ["wendland/c2", "wendland/c4", "wendland/c6", "cubic", "quintic", "lucy"])
def test_kernels(lammps, style, kernel):
    particles = disordered(3, 8, seed=5, jitter=0.1, speed=0.3, spread=0.0)
    compare(lammps, style, particles, script(style, particles, fluids(style, 3, options=f"kernel {kernel}"), 10), ranks=2)


def test_triclinic_box_and_sorting(lammps, style):
    particles = disordered(2, 16, seed=6, jitter=0.1, tilt=(3.0, 0.0, 0.0), spread=0.0)
    text = script(style, particles, fluids(style, 2), 100).replace("read_data", "atom_modify sort 10 2.0\nread_data")
    compare(lammps, style, particles, text, ranks=2)


@pytest.mark.parametrize("before", ["comm_modify vel yes\n", "comm_style tiled\n", "atom_modify map hash\n"])
def test_communication(lammps, style, before):
    """comm_modify vel yes sends more than the own fields."""
    particles = disordered(2, 16, seed=7, jitter=0.1, spread=0.0)
    text = script(style, particles, fluids(style, 2), 50).replace("read_data", before + "read_data")
    compare(lammps, style, particles, text, ranks=2)


def test_messages_of_several_processors(lammps, style):
    """Three parts of the box, so that tiles have two neighbors on one side; with velocities in the messages."""
    particles = disordered(2, 20, seed=7, jitter=0.1, spread=0.0)
    text = script(style, particles, fluids(style, 2), 20, extra="balance 1.0 rcb\n")
    compare(lammps, style, particles, text.replace("read_data", "comm_style tiled\ncomm_modify vel yes\nread_data"), ranks=3)


def test_particles_of_another_integrator(lammps, style):
    particles = disordered(2, 16, seed=8, jitter=0.1, spread=0.0)
    fixes = ("region LOW block INF INF 0 5 INF INF\ngroup LOW region LOW\ngroup REST subtract all LOW\n"
             "velocity LOW set 0.3 0.0 0.0\nfix MOVE LOW nve/noforce\n" + integrate(style, group="REST"))
    compare(lammps, style, particles, script(style, particles, fluids(style, 2), 50, fixes=fixes), ranks=2)


@pytest.mark.parametrize("keywords", ["", "viscous rkl2"])
def test_velocities_that_are_remapped(lammps, style, keywords):
    particles = disordered(2, 16, seed=8, jitter=0.1, tilt=(0.0, 0.0, 0.0), spread=0.0)
    text = script(style, particles, fluids(style, 2), 50, fixes=integrate(style, keywords), extra="fix SHEAR all deform 1 xy erate 0.2 remap v\n")
    result = compare(lammps, style, particles, text.replace("read_data", "comm_modify vel yes\nread_data"), ranks=2)
    warned = any("on the host" in line and "viscous with fix deform remap v" in line for line in result.warnings)
    assert warned == (DEVICE_LOOPS and bool(keywords)), result.warnings


# ---------------------------------------------------------------------------------------------
# output


def test_stress_of_atoms(lammps, style):
    particles = disordered(2, 14, seed=9, jitter=0.1, spread=0.0)
    extra = ("compute S all stress/atom NULL virial\ncompute P all pe/atom\ncompute SUM all reduce sum c_S[1] c_S[4] c_P\n"
             "compute Q all sph/dissipation\n")
    text = script(style, particles, fluids(style, 2), 10, extra=extra).replace(" c_E\n", " c_E c_SUM[*]\n")
    compare(lammps, style, particles, text, ranks=2)


def test_output_on_the_way(lammps, style):
    """Every output of a run sees the values of its step."""
    particles = disordered(2, 14, seed=10, jitter=0.1, spread=0.0)
    text = script(style, particles, fluids(style, 2), 20, every=5)
    (_, thermo, _), (_, thermo_kokkos, _) = both(lammps, style, particles, text)
    frames = lammps.frames("dump.txt")
    lammps(text, switches=[])
    for cpu, kokkos in zip(lammps.frames("dump.txt"), frames):
        assert_same(style, cpu, kokkos, 1e-10)
    assert len(frames) == 5 and len(thermo["Step"]) == 5
    assert_same_totals(thermo, thermo_kokkos, 1e-10)


@pytest.mark.parametrize("options", ["", "density continuity"])
@pytest.mark.parametrize("writer", ["cpu", "kk"])
def test_restart(lammps, style, writer, options):
    """A run continued by the other family goes on as one without a break."""
    particles = disordered(2, 14, seed=11, jitter=0.1, spread=0.0)
    write(lammps, style, particles)
    frames = []
    for first, then in (([], []), ([], SWITCHES) if writer == "cpu" else (SWITCHES, [])):
        lammps(script(style, particles, fluids(style, 2, options=options), 40) + "write_restart file.restart\n", switches=first, ranks=2)
        result = lammps(f"read_restart file.restart\n{integrate(style)}{output(style, 20)}run 20\n", switches=then)
        assert (f"{style}/kk" in result.log) == bool(then)
        frames.append(lammps.frame("dump.txt"))
    assert_same(style, *frames, 1e-9)


def test_data_file(lammps, style):
    """One written by the /kk styles, read by the CPU styles."""
    particles = disordered(2, 14, seed=11, jitter=0.1, spread=0.0)
    write(lammps, style, particles)
    frames = []
    for switches in ([], SWITCHES):
        lammps(script(style, particles, fluids(style, 2), 40) + "write_data then.data nocoeff\n", switches=switches, ranks=2)
        lammps(f"{header(2, style=style)}read_data then.data\n{fluids(style, 2)}{integrate(style)}{output(style, 1)}run 0\n",
               switches=[])
        frames.append(lammps.frame("dump.txt"))
    assert_same(style, *frames, 1e-9)


@pytest.mark.parametrize("writer", ["cpu", "kk"])
def test_data_file_with_densities(lammps, writer):
    """Of density continuity, written by one family, read by the other."""
    style = "sph/bulk"
    particles = disordered(2, 14, seed=11, jitter=0.1, spread=0.0)
    rho = 1.0 + 0.01 * np.sin(particles.x[:, 0])
    room = f"atom_style {style} rho"
    model = fluids(style, 2, options="density continuity")
    frames = []
    for first, then in (([], []), ([], SWITCHES) if writer == "cpu" else (SWITCHES, [])):
        continuity.write(lammps.path("data.txt"), particles, rho)
        text = script(style, particles, model, 40).replace(f"atom_style {style}", room)
        lammps(text + "write_data then.data nocoeff\n", switches=first, ranks=2)
        head = header(2, style=style).replace(f"atom_style {style}", room)
        lammps(f"{head}read_data then.data\n{model}{integrate(style)}{output(style, 1)}run 0\n", switches=then)
        frames.append(lammps.frame("dump.txt"))
    assert_same(style, *frames, 1e-9)


def test_density_keyword(lammps, style):
    particles = disordered(2, 14, seed=12, jitter=0.1, spread=0.0)
    text = script(style, particles, fluids(style, 2), 20, fixes=integrate(style, "density rho0"))
    compare(lammps, style, particles, text, ranks=2)


def test_custom_properties(lammps):
    """d_inertia and d2_omegaest, next to those of fix property/atom, set on the way.

    LAMMPS has no property/atom/kk/device, and the fix without suffix aborts under KOKKOS."""
    style = "sph/micropolar"
    particles = disordered(2, 14, seed=12, jitter=0.1, spread=0.0)
    place = "fix PLACE all property/atom"
    fixes = (f'if $(is_active(package,kokkos)) then "{place}/kk d_weight" else "{place} d_weight"\nvariable I atom 0.1+0.001*id\nset group all d_inertia v_I\n'
             f"set group all d_weight 3.0\nfix FLUID all {style}\ntimestep 0.005\n")
    text = (script(style, particles, fluids(style, 2), 10, fixes=fixes)
            + "set group all d_inertia 0.5\nset type 1 omega 0 0 2\nrun 10\nrun 10 every 5 \"set group all d_inertia 0.3\"\n"
            "write_dump all custom out.dump id d_inertia d_weight d2_omegaest[3] omegaz modify sort id format float %.17g\n")
    compare(lammps, style, particles, text, ranks=2)
    frame = lammps.frame("out.dump")
    assert np.all(frame["d_inertia"] == 0.3) and np.all(frame["d_weight"] == 3.0)
    assert 0.0 < np.abs(frame["d2_omegaest[3]"] - frame["omegaz"]).max() < 0.1


# ---------------------------------------------------------------------------------------------
# limit and shift: further sums


@pytest.mark.parametrize("style, options", [
    ("sph/bulk", "limit yes"), ("sph/bulk", "limit count"), ("sph/bulk", "limit yes volume mass shear mg/fr"),
    ("sph/micropolar", "limit yes"), ("sph/micropolar", "limit count volume mass")])
@pytest.mark.parametrize("ntypes", [1, 2])
def test_limit(lammps, style, options, ntypes):
    """A coefficient of the bulk term that is below the bound of some of the particles, and their number."""
    particles = disordered(2, 14, seed=23, jitter=0.1, ntypes=ntypes, speed=0.3, spread=0.0)
    model = fluids(style, 2, ntypes, options).replace(" 0.5 2.0 ", " 0.5 0.0 ").replace(" 0.3 1.5 ", " 0.3 0.0 ")
    text = script(style, particles, model, 20, extra=f"compute B all pair {style}\n")
    result = compare(lammps, style, particles, text.replace(" c_E\n", " c_E c_B[1]\n"), ranks=2)
    beyond = result.thermo()[-1]["c_B[1]"]
    assert 0 < beyond[-1] < len(particles), beyond
    assert not any("on the host" in line for line in result.warnings)


@pytest.mark.parametrize("dim, options, ranks, newton", [(2, "", 1, "on"), (2, "kernel cubic", 4, "off"), (3, "volume mass", 2, "on")])
def test_shift(lammps, style, dim, options, ranks, newton):
    particles = disordered(dim, {2: 16, 3: 7}[dim], seed=24, jitter=0.2, speed=0.2, spread=0.0)
    text = script(style, particles, fluids(style, dim, options=options), 100, newton, fixes=integrate(style, "shift 0.5"))
    result = compare(lammps, style, particles, text, ranks)
    assert not any("on the host" in line for line in result.warnings)


def test_shift_at_walls(lammps, style):
    particles = disordered(2, 20, seed=25, jitter=0.1, speed=0.2, spread=0.0)
    text = with_walls(style, particles, "cavity", fluids(style, 2), 100).replace(
        integrate(style, group="REST"), integrate(style, "shift 0.5", "REST"))
    compare_walls(lammps, style, particles, text, 2)


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


def with_walls(style, particles, name, model, steps, newton="on", every=None, step=0.005, spins=("free", "rate 0.7")):
    groups, floor, lid = VESSELS[name]
    if spinning(style):
        floor, lid = f"{floor} spin {spins[0]}", f"{lid} spin {spins[1]}"
    fixes = (groups + integrate(style, group="REST") + f"fix FLOOR FLOOR sph/wall {floor}\nfix LID LID sph/wall {lid}\n"
             f"timestep {step}\n")
    text = script(style, particles, model, steps, newton, fixes=fixes, every=every)
    columns = " ".join(f"f_{wall}[{k}]" for wall in ("FLOOR", "LID") for k in (1, 2, 6))
    return text.replace(" c_E\n", f" c_E {columns}\n").replace("c_F[*] ", "c_F[*] f_FLOOR[*] f_LID[*] ")


def compare_walls(lammps, style, particles, text, ranks=1, bound=1e-9, wall="LID"):
    (cpu, thermo, _), (kokkos, thermo_kokkos, result) = both(lammps, style, particles, text, ranks)
    assert_same(style, cpu, kokkos, bound)
    assert_same_totals(thermo, thermo_kokkos, bound)
    scale = np.abs(cpu["f"]).max()
    for name in cpu.columns:
        if name.startswith("f_"):
            assert np.abs(cpu[name] - kokkos[name]).max() < bound * scale, name
    assert np.abs(cpu[f"f_{wall}[1]"]).max() > 1e-3 * scale
    legacy = wall == "LID"    # of bodies, fix property/atom and fix rigid of LAMMPS are exchanged on the host
    assert not any("on the host" in line or (legacy and "legacy" in line) for line in result.warnings), result.warnings
    return result


@pytest.mark.parametrize("name", VESSELS)
@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "off"), (4, "on")])
def test_walls(lammps, style, name, ranks, newton):
    """Walls at rest, moving, turning; forces on them; particles that change processors, the wall's own among them."""
    particles = disordered(2, 20, seed=16, jitter=0.1, speed=0.2, spread=0.0)
    compare_walls(lammps, style, particles, with_walls(style, particles, name, fluids(style, 2), 200, newton), ranks)


def test_spin_of_walls(lammps):
    style = "sph/micropolar"
    particles = disordered(2, 20, seed=16, jitter=0.1, speed=0.2, spread=0.0)
    text = with_walls(style, particles, "wheel", fluids(style, 2), 100, spins=("zero", "rate 0.7"))
    compare_walls(lammps, style, particles, text, ranks=2)


@pytest.mark.parametrize("style, options", [
    *(("sph/bulk", options) for options in ("eos tait shear morris bulk volume", "eos ideal", "volume mass shear espanol",
                                            "kernel quintic bulk none")),
    ("sph/micropolar", "eos tait bulk volume"), ("sph/micropolar", "volume mass")])
def test_walls_of_several_types(lammps, style, options):
    particles = disordered(2, 20, seed=17, jitter=0.1, ntypes=2, speed=0.2, spread=0.0)
    text = with_walls(style, particles, "channel", fluids(style, 2, 2, options=options), 40)
    compare_walls(lammps, style, particles, text, 2)


def test_walls_in_three_dimensions(lammps, style):
    particles = disordered(3, (6, 20, 6), seed=18, jitter=0.1, speed=0.2, spread=0.0)
    compare_walls(lammps, style, particles, with_walls(style, particles, "slip", fluids(style, 3), 40), 2)


def test_walls_in_an_oblique_box_and_sorting(lammps, style):
    particles = disordered(2, 20, seed=19, jitter=0.1, speed=0.2, tilt=(3.0, 0.0, 0.0), spread=0.0)
    text = with_walls(style, particles, "channel", fluids(style, 2), 60)
    text = text.replace("read_data", "atom_modify sort 10 2.0\nread_data")
    compare_walls(lammps, style, particles, text, 2)


def test_output_of_walls_on_the_way(lammps, style):
    particles = disordered(2, 20, seed=20, jitter=0.1, speed=0.2, spread=0.0)
    text = with_walls(style, particles, "wheel", fluids(style, 2), 20, every=4)
    (_, thermo, _), (_, thermo_kokkos, _) = both(lammps, style, particles, text)
    frames = lammps.frames("dump.txt")
    lammps(text, switches=[])
    for cpu, kokkos in zip(lammps.frames("dump.txt"), frames):
        for name in ("x", "v", *FIELDS, *(name for name in cpu.columns if name.startswith("f_"))):
            assert relative(cpu[name] - kokkos[name], np.append(cpu["f"], 1.0)) < 1e-11, (cpu.step, name)
    assert len(frames) == 6
    assert_same_totals(thermo, thermo_kokkos, 1e-10)


@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "off")])
def test_heat_of_walls(lammps, style, ranks, newton):
    """A wall with a temperature, one that gives a flux of heat and moves, one without either."""
    particles = disordered(2, 20, seed=27, jitter=0.1, ntypes=2, speed=0.2, spread=0.0)
    words = {"pair_coeff 1 1": " cv 2.0 conductivity 0.7 gruneisen 0.6 2.0", "pair_coeff 2 2": " cv 1.2 conductivity 0.4"}
    model = "".join(line + words.get(line[:14], "") + "\n" for line in fluids(style, 2, 2).splitlines())
    text = with_walls(style, particles, "wheel", model, 60, newton)
    for wall, heat in (("FLOOR", "temp 3.0"), ("LID", "flux 0.4")):
        text = text.replace(f"fix {wall} {wall} sph/wall", f"fix {wall} {wall} sph/wall heat {heat}")
    text = text.replace("f_LID[6]", "f_LID[6] f_LID[7] f_LID[8] f_FLOOR[8]")
    result = compare_walls(lammps, style, particles, text, ranks)
    assert np.abs(result.thermo()[-1]["f_LID[8]"][-1]) > 0.01


@pytest.mark.parametrize("writer", ["cpu", "kk"])
def test_restart_with_walls(lammps, style, writer):
    """The point that the wheel turns about goes on, whichever family has written the file."""
    particles = disordered(2, 20, seed=21, jitter=0.1, speed=0.2, spread=0.0)
    write(lammps, style, particles)
    frames = []
    for first, second in (([], []), ([], SWITCHES) if writer == "cpu" else (SWITCHES, [])):
        text = with_walls(style, particles, "wheel", fluids(style, 2), 40)
        lammps(text + "write_restart file.restart\n", switches=first, ranks=2)
        again = "read_restart file.restart\n" + "".join(line + "\n" for line in text.splitlines()
                                                       if line.startswith(("fix ", "timestep", "neigh")))
        lammps(again + dump("again.txt", 40) + "run 40\n", switches=second, ranks=2)
        frames.append(lammps.frame("again.txt"))
    for name in ("x", "v", "esph", "rho", "f"):
        assert relative(frames[0][name] - frames[1][name], frames[0][name]) < 1e-9, name


@pytest.mark.parametrize("ranks", [1, 2])
def test_particle_in_a_wall(lammps, style, ranks):
    particles = disordered(2, 20, seed=22, jitter=0.05, speed=0.0, spread=0.0)
    shot = np.flatnonzero((np.abs(particles.x[:, 1] - 4.5) < 0.3) & (np.abs(particles.x[:, 0] - 8.5) < 0.4))[0]
    particles.v[shot] = [0.0, -300.0, 0.0]
    write(lammps, style, particles)
    result = lammps(with_walls(style, particles, "channel", fluids(style, 2), 100, step=0.002), ranks=ranks, check=False)
    assert result.code != 0 and f"Particle {shot + 1} of the fluid of pair style {style} is inside a wall" in result.error


# ---------------------------------------------------------------------------------------------
# bodies that the fluid moves; test_bodies.py and test_elastic.py have the references

DISCS = {2: ("region DISC cylinder z 6.5 10 2.3 INF INF\nregion BRICK block 11.7 14.6 8.2 12.8 INF INF\n"),
         3: ("region DISC sphere 2.6 4 4 1.6\nregion BRICK block 4.7 7.2 2.2 5.3 2.2 5.3\n")}
RIGID = "fix RIGID BODIES {mover}\nfix BODY BODIES sph/wall move rigid body molecule\n"
ELASTIC = "fix NVE BODIES nve\nfix BODY BODIES sph/wall move elastic\n"


def with_bodies(particles, model, steps, newton="on", fixes=RIGID, walls="", mover="rigid molecule"):
    groups = (f"fix MOL all property/atom mol ghost yes\n{DISCS[particles.dim]}group DISC region DISC\ngroup BRICK region BRICK\n"
              "group BODIES union DISC BRICK\nset group DISC mol 1\nset group BRICK mol 2\n")
    if walls:
        groups += "region IN block 1.2 18.8 1.2 18.8 INF INF\ngroup IN region IN\ngroup FRAME subtract all IN\n" + walls
    groups += f"group REST subtract all BODIES{' FRAME' if walls else ''}\n"
    text = script("sph/bulk", particles, model, steps, newton, fixes=groups + integrate("sph/bulk", group="REST") + fixes.format(mover=mover))
    return text.replace(" c_E\n", " c_E f_BODY[1] f_BODY[2] f_BODY[6]\n").replace("c_F[*] ", "c_F[*] f_BODY[*] ")


@pytest.mark.parametrize("ranks, newton, options", [(1, "on", ""), (2, "off", ""), (4, "on", ""), (2, "on", "volume mass kernel quintic"),
                                                    (1, "on", "temp 0.01 1234"), (2, "off", "temp 0.01 1234 shear mg/fr2"),
                                                    (2, "on", "density continuity tension yes"), (4, "on", "density continuity")])
def test_bodies(lammps, ranks, newton, options):
    """A disc and a brick, which change processors and turn; the forces on their particles."""
    particles = disordered(2, 20, seed=41, jitter=0.1, speed=0.3, spread=0.0)
    text = with_bodies(particles, fluids("sph/bulk", 2, options=options), 100, newton)
    compare_walls(lammps, "sph/bulk", particles, text, ranks, wall="BODY")


@pytest.mark.parametrize("ranks, mover, options", [(1, "rigid/nve molecule", "temp 0.01 1234"), (2, "rigid/small molecule", "")])
def test_bodies_in_3d(lammps, ranks, mover, options):
    particles = disordered(3, 8, seed=42, jitter=0.1, speed=0.3, spread=0.0)
    text = with_bodies(particles, fluids("sph/bulk", 3, options=options), 40, mover=mover).replace("read_data", "atom_modify map array\nread_data")
    compare_walls(lammps, "sph/bulk", particles, text, ranks, wall="BODY")


@pytest.mark.parametrize("ranks, options", [(1, ""), (2, "temp 0.01 1234"), (4, "density continuity")])
def test_bodies_in_a_vessel(lammps, ranks, options):
    """Walls of both kinds: with a temperature, and symmetric friction of the bodies alone, or of both."""
    particles = disordered(2, 20, seed=43, jitter=0.1, speed=0.3, spread=0.0)
    cold = "temp" in options
    model = "".join(line + " cv 2.0 conductivity 0.7" * (line.startswith("pair_coeff") and not cold) + "\n"
                    for line in fluids("sph/bulk", 2, options=options).splitlines())
    text = with_bodies(particles, model, 60, walls=f"fix FRAME FRAME sph/wall{'' if cold else ' heat temp 3.0'}\n")
    compare_walls(lammps, "sph/bulk", particles, text, ranks, wall="BODY")


@pytest.mark.parametrize("ranks, newton, options", [(1, "on", ""), (2, "off", "temp 0.01 1234"), (4, "on", "density continuity")])
def test_elastic_bodies(lammps, ranks, newton, options):
    particles = disordered(2, 20, seed=44, jitter=0.1, speed=0.1, spread=0.0)
    text = with_bodies(particles, fluids("sph/bulk", 2, options=options), 40, newton, fixes=ELASTIC)
    compare_walls(lammps, "sph/bulk", particles, text, ranks, wall="BODY")


# ---------------------------------------------------------------------------------------------
# free surfaces; test_continuity.py has the reference


@pytest.mark.parametrize("ranks, newton, options, steps, bound, speed", [
    (1, "on", "", 20, 1e-12, 0), (1, "on", "", 200, 1e-9, 0), (2, "off", "delta 0", 200, 1e-9, 0), (2, "on", "volume mass kernel cubic", 200, 1e-9, 0),
    (4, "on", "tension yes delta 0.5", 200, 1e-9, 0), (1, "on", "", 30, 1e-9, 5)])
def test_dam_break(lammps, style, ranks, newton, options, steps, bound, speed):
    """A column of fluid that falls between walls, which repel it: densities that were set, their diffusion, energy and stress of particles, which
    change processors and places."""
    particles = lattice(2, 20)
    x, y = particles.x[:, :2].T
    inside = (np.abs(x - 10) < 6.8) & (np.abs(y - 10) < 6.8)
    particles.x[inside, :2] += np.random.default_rng(31).uniform(-0.1, 0.1, (inside.sum(), 2))
    particles = particles.where(~inside | ((x < 10) & (y < 14)))
    text = with_walls(style, particles, "cavity", fluids(style, 2, options=f"density continuity {options}"), steps, newton)
    text = text.replace("fix FLOOR FLOOR sph/wall", "variable R atom 1.0+0.01*(14-y)\nset group REST sph/rho v_R\n"
                        f"velocity REST set {-speed} {-speed} 0 sum yes\nfix G REST gravity 2.0 vector 0 -1 0\nfix B all balance 40 1.0 shift x 5 1.01\natom_modify sort 25 2.0\n"
                        "compute P all pe/atom\ncompute S all stress/atom NULL virial\n"
                        f"compute G all property/atom offset {'id' if options == 'delta 0' else 'surface'}\nfix FLOOR FLOOR sph/wall gravity 0 -2 0", 1)
    own = ("c_G[1]", "c_G[2]", "d_rho_sum", "d_vol_rate", "d_vol_rate_before", "d_vol_heat", "d_vol_support", "c_P", "c_S[1]", "c_S[2]", "c_S[4]")
    text = text.replace("c_F[*] ", f"c_F[*] {' '.join(own)} ")
    (cpu, thermo, _), (kokkos, thermo_kokkos, result) = both(lammps, style, particles, text, ranks)
    assert_same(style, cpu, kokkos, bound)
    assert_same_totals(thermo, thermo_kokkos, bound)
    for name in (*own, *(name for name in cpu.columns if name.startswith("f_"))):
        assert np.abs(cpu[name] - kokkos[name]).max() <= bound * max(np.abs(cpu[name]).max(), 1e-3), name
    assert (np.abs(cpu["d_vol_rate"]).max() > 0.0) == (options != "delta 0")
    assert not any("on the host" in line for line in result.warnings), result.warnings


def test_drops_of_two_fluids_in_3d(lammps, style):
    """Without walls; two impedances; a strained process; some particles stay, and take no volume."""
    particles = disordered(3, 8, seed=33, jitter=0.1, ntypes=2, speed=0.2, spread=0.0)
    particles = particles.where(np.linalg.norm(particles.x - 0.5 * (particles.lo + particles.hi), axis=1) < 3.6)
    relax.write(particles, lammps.path("room.txt"), relax.strained(np.full((len(particles), 1), 0.01)), style)
    words = {"pair_coeff 1 1": " relax 8.0 0.05"}
    model = "".join(line + words.get(line[:14], "") + "\n" for line in fluids(style, 3, 2, "density continuity tension yes volume mass").splitlines())
    fixes = "group STAY id 1:9\ngroup MOVE subtract all STAY\n" + integrate(style, group="MOVE")
    text = script(style, particles, model, 40, fixes=fixes).replace("data.txt", "room.txt").replace(f"atom_style {style}", f"atom_style {style} relax 1")
    text = text.replace("c_F[*] ", "c_F[*] d_vol_rate d_vol_support d_rho_relaxed1 ")
    (cpu, thermo, _), (kokkos, thermo_kokkos, result) = both(lammps, style, particles, text, 2)
    assert_same(style, cpu, kokkos, 1e-11)
    assert_same_totals(thermo, thermo_kokkos, 1e-11)
    for name in ("d_vol_rate", "d_vol_support", "d_rho_relaxed1"):
        assert relative(cpu[name] - kokkos[name], cpu[name]) < 1e-11, name
    assert np.abs(kokkos["d_vol_rate"].sum()) < 1e-13 * np.abs(kokkos["d_vol_rate"]).max()
    assert np.all(kokkos["d_vol_rate"][kokkos["id"] < 10] == 0.0)
    assert not any("on the host" in line for line in result.warnings), result.warnings


# ---------------------------------------------------------------------------------------------
# open ends

PRESSED = ("velocity {U} average 40", "density 1.0")
ENDS = [  # box, style, its options and coefficients, inlet and outlet
    ("free", "sph/bulk", "bulk density", "", PRESSED), ("walls", "sph/bulk", "bulk volume", "", ("velocity v_U 0 0", "pressure v_P")),
    ("straight", "sph/bulk", "volume mass eos tait", "", ("pressure 0.01", "density 1.0 condition characteristic")),
    ("triclinic", "sph/micropolar", "bulk volume volume mass", "", ("velocity {U} spin 0 0 0.3", "density 1.0 condition fixed order 1")),
    ("straight", "sph/bulk", "eos ideal", "cv 2.0 conductivity 0.3", ("velocity {U} temperature 0.6", "pressure 0.4")),
    ("straight", "sph/bulk", "", "cv 2.0 conductivity 0.3", ("velocity {U} temperature 0.6", "density 1.0")),
    ("straight", "sph/bulk", "", "relax 0.3 2.0", PRESSED), ("walls", "sph/bulk", "density continuity", "", PRESSED),
    ("free", "sph/bulk", "shear mg/fr2", "power 0.6 0.01 1.0", PRESSED), ("free", "sph/bulk", "limit yes", "", PRESSED)]


@pytest.mark.parametrize("box, style, options, coeff, ends, ranks, newton", [
    pytest.param(*case, ranks, newton, marks=[] if k % 3 == n else pytest.mark.long)
    for k, case in enumerate(ENDS) for n, (ranks, newton) in enumerate([(1, "on"), (2, "off"), (4, "on")])])
def test_open_ends(lammps, box, style, options, coeff, ends, ranks, newton):
    """Particles that enter and leave, with all that the zones carry and do; the device computes the forces."""
    channel = open_boundaries.Channel(box=box, zone=9.0, direction=(2, 1) if box == "triclinic" else (1, 0))
    words = ledger.keywords(style)
    words["coeff"] += f" {coeff}"
    if "continuity" in options:
        words["integrate"] = ""
    before = "variable U equal 0.1+0.02*sin(0.1*time)\nvariable P atom 0.002*y\n"
    spin = "omegaz" if spinning(style) else ""
    text = channel.text(lammps, ends[0].format(U=channel.vector(0.1)), ends[1], velocity=ledger.agitated(channel, 0.02), newton=newton,
                        options=options, spin=0.2, before=before, esph=1.0 if "cv" in coeff else 0.0, **words)
    if "relax" in coeff:
        text = text.replace(f"atom_style {style}", f"atom_style {style} relax 1")
        relax.write(channel.particles(ledger.agitated(channel, 0.02)), lammps.path("box.data"), [-1.0])
    text += ledger.output(channel, style, 20) + open_boundaries.dump("dump.txt", 200, spin) + "run 200\n"
    compare_ends(lammps, box, text, ranks)


def test_open_ends_before_the_integrator(lammps):
    """The integrator then shifts the fluid after the zones have moved, before their states are found."""
    channel = open_boundaries.Channel(box="walls", zone=9.0)
    text = channel.text(lammps, "velocity 0.1 0 0", "density 1.0", velocity=ledger.agitated(channel, 0.05),
                        **ledger.keywords("sph/bulk", integrate="density rho0 shift auto"))
    lines = text.splitlines(keepends=True)
    (integrator,) = [line for line in lines if line.startswith("fix 1 ")]
    text = "".join(line for line in lines if line != integrator) + integrator
    compare_ends(lammps, "walls", text + ledger.output(channel, "sph/bulk", 20) + open_boundaries.dump("dump.txt", 200) + "run 200\n", 2)


def test_open_ends_of_two_groups(lammps):
    """The outlet of one fluid acts on the other one, too, and its ledger says so, until fluid of the other group is deep in the outlet."""
    channel = open_boundaries.Channel(box="free", zone=9.0)
    text = channel.text(lammps, "velocity 0.1 0 0", "density 1.0", velocity=ledger.agitated(channel, 0.02), after_read=(
        "region LOW block INF INF INF 3.9 INF INF\ngroup low region LOW\ngroup ink intersect fluid low\ngroup water subtract fluid ink\n"),
                        **ledger.keywords("sph/bulk", integrate=""))
    text = text.replace("fix 1 fluid sph/bulk", "fix 2 water sph/bulk\nfix 1 ink sph/bulk")
    text = text.replace("in sph/open fluid", "in sph/open ink").replace("out sph/open fluid", "out sph/open water")
    compare_ends(lammps, "free", text + ledger.output(channel, "sph/bulk", 20) + open_boundaries.dump("dump.txt", 100) + "run 100\n", 2)


def test_open_ends_with_most_fields(lammps):
    style = "sph/micropolar"
    channel = open_boundaries.Channel(box="straight", zone=9.0)
    words = ledger.keywords(style)
    words["coeff"] += " relax" + "".join(f" {0.02 * k} {k}" for k in range(1, 9))
    text = channel.text(lammps, "velocity 0.1 0 0", "density 1.0", **words)
    relax.write(channel.particles(ledger.agitated(channel, 0.02)), lammps.path("box.data"), [-1.0] * 8, style)
    text = text.replace(f"atom_style {style}", f"atom_style {style} relax 8")
    compare_ends(lammps, "straight", text + ledger.output(channel, style, 20) + open_boundaries.dump("dump.txt", 200) + "run 200\n", 2)


def compare_ends(lammps, box, text, ranks):
    results = []
    for switches in ([], SWITCHES):
        result = lammps(text, ranks=ranks, switches=switches)
        results.append((lammps.frame("dump.txt"), result.thermo()[-1], result))
    (cpu, thermo, _), (kokkos, thermo_kokkos, result) = results
    assert not any("on the host" in line for line in result.warnings), result.warnings
    assert thermo["f_in[1]"][-1] > 5 and np.array_equal(cpu["id"], kokkos["id"])
    for name in ("x", "y", "vx", "vy", "c_RHO", *(["omegaz"] if "omegaz" in cpu.columns else [])):
        assert np.abs(cpu[name] - kokkos[name]).max() < 1e-9 * max(np.abs(cpu[name]).max(), 1.0), name
    images = [f"f_{end}[{k}]" for end in ("in", "out") for k in (24, 25, 26)] if box in ("straight", "triclinic") else []
    for name, column in thermo.items():
        if name not in images:    # the torque on a particle across a periodic border depends on the image that has the force
            assert np.abs(column - thermo_kokkos[name]).max() < 1e-8 * max(np.abs(column).max(), 1.0), name


# ---------------------------------------------------------------------------------------------
# what the CPU style does, on the host


@pytest.mark.parametrize("reason, options, keywords, extra", [
    ("keyword temp", "temp 0.01 1234 limit yes", "", ""),
    ("viscous with temp and walls", "temp 0.01 1234", "viscous implicit", "fix WALL WALL sph/wall\n"),
    ("fix sph/wall", "", "", "suffix off\nfix WALL WALL sph/wall\n"),
])
@pytest.mark.parametrize("newton", ["on", "off"])
def test_on_the_host(lammps, style, newton, reason, options, keywords, extra):
    particles = disordered(2, 20, seed=13, jitter=0.1, speed=0.1, spread=0.0)
    group = "REST" if extra else "all"
    fixes = ("region LOW block INF INF 0 3.2 INF INF\ngroup WALL region LOW\ngroup REST subtract all WALL\n"
             + integrate(style, keywords, group) + extra)
    text = script(style, particles, fluids(style, 2, options=options), 20, newton, fixes=fixes)
    result = compare(lammps, style, particles, text, ranks=2)
    warned = any("on the host" in line and reason in line for line in result.warnings)
    assert warned == DEVICE_LOOPS, result.warnings


@pytest.mark.parametrize("style, dim, options", [
    ("sph/bulk", 2, "temp 0.01 1234"), ("sph/bulk", 2, "temp 0.01 1234 shear mg/fr2"), ("sph/bulk", 2, "temp 0.01 1234 shear espanol"),
    ("sph/micropolar", 2, "temp 0.01 1234"), ("sph/bulk", 2, "temp 0.01 1234 limit yes"), ("sph/bulk", 3, "temp 0.01 1234 shear espanol volume mass"),
    ("sph/bulk", 3, "temp 0.01 1234 limit yes shear morris"), ("sph/micropolar", 3, "temp 0.01 1234"),
    ("sph/bulk", 2, "temp energy 20.0 1234 volume mass"), ("sph/micropolar", 2, "temp energy 20.0 1234")])
@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "off")])
def test_noise(lammps, style, dim, options, ranks, newton):
    """The same numbers, with conduction of heat and different masses; momentum, and energy of motion and heat, to round-off.  A device
    has the noise of one temperature without limit."""
    own = "energy" in options
    particles = disordered(dim, {2: 16, 3: 8}[dim], seed=28, jitter=0.1, ntypes=2, speed=0.1, spread=0.3 if own else 0.0)
    particles.esph[:] = 100.0
    words = " conductivity 0.7" if own else ""
    model = "".join(line + words * (line[:14] in ("pair_coeff 1 1", "pair_coeff 2 2")) + "\n"
                    for line in fluids(style, dim, 2, options).splitlines())
    if "limit" in options:
        model = model.replace(" 0.5 2.0 ", " 0.5 0.0 ").replace(" 0.3 1.5 ", " 0.3 0.0 ")
    text = script(style, particles, model, 20, newton, every=5)
    (cpu, thermo, _), (kokkos, thermo_kokkos, result) = both(lammps, style, particles, text, ranks)
    assert any("on the host" in line for line in result.warnings) == (DEVICE_LOOPS and (own or "limit" in options))
    assert_same(style, cpu, kokkos, 1e-9)
    assert_same_totals(thermo, thermo_kokkos, 1e-9)
    before = particles.mass @ particles.v
    assert np.abs(kokkos["mass"] @ kokkos["v"] - before).max() < 1e-14 * len(particles)
    if own:
        assert np.ptp(thermo_kokkos["c_E"]) < 1e-13 * thermo_kokkos["c_E"][0]


@pytest.mark.parametrize("style, dim, ranks, newton, options", [
    *((style, 2, ranks, newton, "") for style in STYLES for ranks, newton in ((1, "on"), (2, "off"), (4, "on"))),
    *(("sph/bulk", 2, 2, "on", options) for options in ("volume mass shear morris", "shear mg/fr2 kernel quintic", "shear espanol", "density continuity delta 0")),
    ("sph/bulk", 3, 2, "on", "shear espanol"), ("sph/micropolar", 3, 1, "on", "")])
def test_noise_at_walls(lammps, style, dim, ranks, newton, options):
    """Particles that the walls repel, the energy of that by particle, and their stress."""
    particles = disordered(dim, {2: 20, 3: (6, 20, 6)}[dim], seed=29, jitter=0.45, speed=0.2, spread=0.0)
    text = with_walls(style, particles, "cavity" if dim == 2 else "channel", fluids(style, dim, options=f"temp 0.05 1234 {options}"), 40, newton,
                      spins=("zero", "zero"))
    text = text.replace("fix FLUID", "compute P all pe/atom\ncompute S all stress/atom NULL virial\nfix FLUID", 1).replace("c_F[*] ", "c_F[*] c_P c_S[1] c_S[4] ")
    (cpu, thermo, _), (kokkos, thermo_kokkos, result) = both(lammps, style, particles, text, ranks)
    assert_same(style, cpu, kokkos, 1e-9)
    assert_same_totals(thermo, thermo_kokkos, 1e-9)
    for name in ("c_P", "c_S[1]", "c_S[4]", *(name for name in cpu.columns if name.startswith("f_"))):
        assert relative(cpu[name] - kokkos[name], np.append(cpu[name], 1e-3)) < 1e-9, name
    assert not any("on the host" in line or "legacy" in line for line in result.warnings), result.warnings


@pytest.mark.parametrize("options, ranks", [("temp 0.05 1234", 1), ("temp 0 1234", 1), ("density continuity", 2)])
def test_walls_that_go(lammps, options, ranks):
    """Walls that repel the fluid, not at the temperature 0; in a second run they are gone."""
    style = "sph/bulk"
    particles = disordered(2, 20, seed=29, jitter=0.45, speed=0.2, spread=0.0)
    fixes = CAVITY + integrate(style, group="REST") + "fix FLOOR FLOOR sph/wall\nfix LID LID sph/wall\ntimestep 0.005\n"
    text = script(style, particles, fluids(style, 2, options=options), 10, fixes=fixes, every=15)
    gone = "unfix FLOOR\nunfix LID\ngroup GONE subtract all REST\ndelete_atoms group GONE compress no\nrun 5\n"
    compare(lammps, style, particles, text + gone, ranks)


def test_diffusion_with_steps_of_several_lengths(lammps, style):
    """The diffusion of volume takes the time step of the last forces."""
    particles = disordered(2, 14, seed=23, jitter=0.2, spread=0.05)
    text = script(style, particles, fluids(style, 2, options="density continuity delta 0.5"), 10, every=40)
    steps = "".join(f"timestep {step}\nrun 10 pre no\n" for step in (0.002, 0.01, 0.004))
    compare(lammps, style, particles, text + steps)
    compare(lammps, style, particles, text + "fix DT all sph/dt 4 max 0.01\nrun 30\n")


@pytest.mark.parametrize("options", ["", " kernel quintic volume mass"])
def test_noise_of_drag(lammps, style, options):
    """Random forces of single particles and of the pairs of two fluids, with stress of each particle."""
    particles = disordered(2, 14, seed=30, jitter=0.1, ntypes=2, speed=0.2, spread=0.0)
    model = "".join(line + " drag 0.4 0 0 0" * line.startswith("pair_coeff 1 1") + "\n"
                    for line in fluids(style, 2, 2, f"temp 0.01 1234{options}").splitlines())
    text = script(style, particles, model, 40, extra="compute S all stress/atom NULL virial\n").replace("c_F[*] ", "c_F[*] c_S[1] c_S[4] ")
    (cpu, thermo, _), (kokkos, thermo_kokkos, result) = both(lammps, style, particles, text, 2)
    assert_same(style, cpu, kokkos, 1e-9)
    assert_same_totals(thermo, thermo_kokkos, 1e-9)
    for name in ("c_S[1]", "c_S[4]"):
        assert relative(cpu[name] - kokkos[name], cpu[name]) < 1e-9, name
    assert not any("on the host" in line for line in result.warnings), result.warnings


def test_noise_of_relaxing_processes_and_drag(lammps, style):
    particles = disordered(2, 14, seed=30, jitter=0.1, ntypes=2, speed=0.2, spread=0.0)
    words = {"pair_coeff 1 1": " relax 8.0 0.01 4.0 1.0 drag 0.4 0 0 0", "pair_coeff 2 2": " relax 5.0 0.2"}
    model = "".join(line + words.get(line[:14], "") + "\n" for line in fluids(style, 2, 2, "temp 0.01 1234").splitlines())
    relax.write(particles, lammps.path("room.txt"), relax.strained(np.zeros((len(particles), 2))), style)
    text = script(style, particles, model, 40).replace("data.txt", "room.txt")
    compare(lammps, style, particles, text.replace(f"atom_style {style}", f"atom_style {style} relax 2"))


def test_shift_on_the_host(lammps, style):
    """A fix without the suffix, which reads what the pair style sums up for it."""
    particles = disordered(2, 20, seed=13, jitter=0.1, speed=0.1, spread=0.0)
    fixes = "suffix off\n" + integrate(style, "shift 0.1")
    result = compare(lammps, style, particles, script(style, particles, fluids(style, 2), 20, fixes=fixes), ranks=2)
    assert any("on the host" in line and "shift" in line for line in result.warnings) == DEVICE_LOOPS, result.warnings


def test_walls_on_the_host(lammps, style):
    """The walls of a pair style that computes on the host, as those of the CPU style."""
    particles = disordered(2, 20, seed=26, jitter=0.1, speed=0.2, spread=0.0)
    model = fluids(style, 2).rstrip() + " cv 2.0 conductivity 0.7\n"
    text = with_walls(style, particles, "wheel", model, 60)
    fixed = integrate(style, group="REST").splitlines()[0].rstrip()
    result = compare(lammps, style, particles, text.replace(fixed, f"{fixed} viscous rkl2"), ranks=2)
    warned = any("on the host" in line and "viscous" in line for line in result.warnings)
    assert warned == DEVICE_LOOPS, result.warnings


@pytest.mark.parametrize("fixes, options", [(RIGID, ""), (None, "temp 0.01 1234")])
def test_large_viscosities_on_the_host(lammps, fixes, options):
    """With bodies, and with noise and walls."""
    particles = disordered(2, 20, seed=46, jitter=0.1, speed=0.2, spread=0.0)
    model = fluids("sph/bulk", 2, options=options)
    text = with_bodies(particles, model, 20, fixes=fixes) if fixes else with_walls("sph/bulk", particles, "channel", model, 20)
    fixed = integrate("sph/bulk", group="REST").splitlines()[0]
    result = compare(lammps, "sph/bulk", particles, text.replace(fixed, f"{fixed} viscous implicit tolerance 1e-11"), ranks=2)
    warned = any("on the host" in line and "viscous" in line for line in result.warnings)
    assert warned == DEVICE_LOOPS, result.warnings


def test_no_warning_on_the_device(lammps, style):
    particles = disordered(2, 14, seed=14, jitter=0.1, spread=0.0)
    result = compare(lammps, style, particles, script(style, particles, fluids(style, 2), 5))
    assert not any("on the host" in line for line in result.warnings)


def test_hybrid_is_refused(lammps, style):
    particles = disordered(2, 14, seed=15, jitter=0.1, spread=0.0)
    write(lammps, style, particles)
    model = fluids(style, 2).replace("pair_style ", "pair_style hybrid/overlay ").replace("* * ", f"* * {style} ")
    result = lammps(script(style, particles, model, 1), check=False)
    assert result.code != 0 and "hybrid" in result.error


def test_hybrid_atom_style_is_refused(lammps, style):
    text = (header(2, style=f"hybrid {style} charge") + "region BOX block 0 12 0 12 -0.5 0.5\ncreate_box 1 BOX\nlattice sq 1.0\n"
            f"create_atoms 1 box\nset group all mass 1.0\n{fluids(style, 2)}{integrate(style)}run 0\n")
    assert f"Atom style {style}/kk cannot be part of atom_style hybrid" in lammps(text, check=False).error


def test_group_of_neighbors_is_refused(lammps, style):
    """LAMMPS's neighbor lists of KOKKOS have the particles outside of it, too."""
    particles = disordered(2, 14, seed=15, jitter=0.1, spread=0.0)
    write(lammps, style, particles)
    text = script(style, particles, fluids(style, 2), 1, extra="neigh_modify include LOW\n")
    text = text.replace("read_data data.txt\n", "atom_modify first LOW\nread_data data.txt\ngroup LOW union all\n")
    assert lammps(text, check=False, switches=[]).code == 0
    assert "cannot be used with neigh_modify include" in lammps(text, check=False).error


def test_torque_without_inertia_is_refused(lammps):
    style = "sph/micropolar"
    particles = disordered(2, 14, seed=15, jitter=0.1, spread=0.0)
    micropolar.write(particles, lammps.path("data.txt"), inertia=0.0)
    fixes = f"fix FLUID all {style}\ntimestep 0.005\n"
    result = lammps(script(style, particles, fluids(style, 2), 1, fixes=fixes), check=False)
    assert result.code != 0 and "inertia must be > 0" in result.error


def test_pair_style_without_the_suffix_is_refused(lammps, style):
    """Nothing would clear or add up the heat that it leaves."""
    particles = disordered(2, 14, seed=15, jitter=0.1, spread=0.0)
    write(lammps, style, particles)
    model = f"suffix off\n{fluids(style, 2)}suffix on\n"
    result = lammps(script(style, particles, model, 1), check=False)
    assert result.code != 0 and f"the pair style must be one of them, too, not {style}" in result.error


@pytest.mark.parametrize("model", ["pair_modify compute no\n", "pair_style zero 3.0\npair_coeff * *\n"])
def test_no_heat_without_forces(lammps, style, model):
    """That of the last forces before is not integrated any longer."""
    particles = disordered(2, 14, seed=15, jitter=0.1, spread=0.0)
    write(lammps, style, particles)
    fixes = f"fix FLUID all {style}\ntimestep 0.005\n"
    text = script(style, particles, fluids(style, 2), 5, fixes=fixes, every=5)
    before = "run 5\nuncompute E\nuncompute HEAT\n" + ("uncompute L\n" if spinning(style) else "")
    lammps(text.replace("run 5\n", f"{before}{model}thermo_style one\nrun 5\n"))
    frames = lammps.frames("dump.txt")
    assert np.abs(frames[0]["desph"]).max() > 0.1 and np.all(frames[-1]["desph"] == 0.0)
    assert np.all(frames[-1]["esph"] == frames[-2]["esph"])


def test_without_the_suffix(lammps, style):
    """KOKKOS alone has no atom style: LAMMPS says so."""
    particles = disordered(2, 14, seed=15, jitter=0.1, spread=0.0)
    write(lammps, style, particles)
    result = lammps(script(style, particles, fluids(style, 2), 1), switches=[word for word in SWITCHES if word not in ("-sf", "kk", "kk/device")], check=False)
    assert result.code != 0 and "Kokkos-enabled atom_style" in result.error


# ---------------------------------------------------------------------------------------------
# what does not change from step to step


@pytest.mark.parametrize("change", [
    f"pair_coeff * * 1.0 10.0 1.5 1.0 {SUPPORT[2]}\n",
    fluid(2, "volume mass bulk volume"), fluid(2, "eos tait kernel quintic shear morris"),
    "variable MU equal 0.5+0.02*(step-20)\nfix CHANGE all adapt 5 pair sph/bulk mu * * v_MU\n"])
def test_changes_of_the_model(lammps, change):
    """Coefficients and options that the runs do not share."""
    style = "sph/bulk"
    particles = disordered(2, 14, seed=23, jitter=0.1, spread=0.2)
    text = script(style, particles, fluids(style, 2), 20)
    compare(lammps, style, particles, text + change + "run 20\n")
    changed = lammps(text + change + "run 20\n", switches=[]).thermo()[-1]
    same = lammps(text + "run 20\n", switches=[]).thermo()[-1]
    assert relative(same["Press"] - changed["Press"], same["Press"]) > 1e-6, "nothing has changed"


LAWS = ("power 0.6 0.01 5 yield 0.1 10", "carreau 2 0.5 2 0.1 smagorinsky 0.5 3", "cross 2 0.7 0.1 cv 2 arrhenius 1 1.2 40", "thixotropy 1.5 2 5",
        "cv 2 conductivity 0.3 melt 1.1 1.2 0.5 solid 20")


@pytest.mark.parametrize("ranks, options", [(1, ""), (2, "shear mg/fr2 volume mass"), (4, "density continuity")])
@pytest.mark.parametrize("law", LAWS)
def test_rate_of_shear(lammps, law, ranks, options):
    """Viscosities that are not constant, in one fluid and between two; the rates and structures move with particles that change processors."""
    particles = disordered(2, 14, ntypes=2, jitter=0.1, speed=0.5, spread=0.0)
    relax.write(particles, lammps.path("room.txt"), np.full((len(particles), 1), 0.3) * (particles.type[:, None] == 1), "sph/bulk")
    words = {"pair_coeff 1 1": f" {law}", "pair_coeff 2 2": " cv 2" * ("cv" in law)}
    model = "".join(line + words.get(line[:14], "") + "\n" for line in fluids("sph/bulk", 2, 2, options).splitlines())
    text = script("sph/bulk", particles, model, 60, extra="compute G all property/atom shear_rate\n").replace("data.txt", "room.txt")
    text = text.replace("c_F[*] ", "c_F[*] c_G d_structure ").replace("atom_style sph/bulk", "atom_style sph/bulk thixotropy")
    if "cv" in law:
        text = text.replace("fix FLUID all sph/bulk", "variable T atom 1.0+0.02*x\nfix FLUID all sph/bulk temperature v_T")
    (cpu, thermo, _), (kokkos, thermo_kokkos, result) = both(lammps, "sph/bulk", particles, text, ranks)
    assert_same("sph/bulk", cpu, kokkos, 1e-9)
    assert_same_totals(thermo, thermo_kokkos, 1e-9)
    for name in ("c_G", "d_structure"):
        assert relative(cpu[name] - kokkos[name], np.append(cpu[name], 1e-3)) < 1e-9, name
    assert cpu["c_G"].max() > 0.1 and (np.ptp(cpu["d_structure"][cpu["type"] == 1]) > 0.1) == ("thixotropy" in law)
    assert not any("on the host" in line for line in result.warnings), result.warnings


@pytest.mark.parametrize("ranks, vessel, newton", [(1, "channel", "on"), (2, "wheel", "off")])
def test_rate_of_shear_with_walls(lammps, ranks, vessel, newton):
    """The rate of a particle beside a wall is that with the velocity of the wall in the forces."""
    style = "sph/bulk"
    particles = disordered(2, 20, seed=22, jitter=0.05, speed=0.3, spread=0.0)
    model = fluid(2, "", keywords=LAWS[0])
    text = with_walls(style, particles, vessel, model, 60, newton).replace("c_F[*] ", "c_F[*] c_G ")
    result = compare(lammps, style, particles, text.replace("fix FLOOR FLOOR", "compute G all property/atom shear_rate\nfix FLOOR FLOOR", 1), ranks)
    assert not any("on the host" in line for line in result.warnings), result.warnings


@pytest.mark.parametrize("dim, ranks, newton, cohesion, tension", [
    (2, 1, "on", (0, 0), 0.7), (2, 2, "off", (0.4, 0.9), 0.2), (3, 4, "on", (0.4, 0), 0.7), (2, 1, "on", (0, 0.4), 0)])
def test_tension(lammps, dim, ranks, newton, cohesion, tension):
    """Of two fluids and of free surfaces, in energy and stress of each particle; a coefficient changes on the way."""
    style = "sph/bulk"
    particles = disordered(dim, 8 if dim == 3 else 14, ntypes=2, jitter=0.1, speed=0.3, spread=0.0)
    particles = particles.where(np.linalg.norm(particles.x - 0.5 * (particles.lo + particles.hi), axis=1) < (3.6 if dim == 3 else 6.5))
    words = {f"pair_coeff {k} {k}": f" cohesion {cohesion[k - 1]}" * (cohesion[k - 1] > 0) for k in (1, 2)}
    model = "".join(line + words.get(line[:14], "") + "\n" for line in fluids(style, dim, 2).splitlines())
    if tension:
        model += f"pair_coeff 1 2 tension {tension}\n"
    extra = ("compute P all pe/atom\ncompute S all stress/atom NULL virial\nvariable T equal 0.5+0.01*step\n"
             "compute U all reduce sum c_P\n")
    if tension:
        extra += f"fix CHANGE all adapt 5 pair {style} tension 1 2 v_T\n"
    own = ("c_P", *(f"c_S[{k}]" for k in range(1, 7)))
    text = script(style, particles, model, 40, newton, extra=extra).replace("c_F[*] ", f"c_F[*] {' '.join(own)} ").replace(" c_E\n", " c_E c_E[5] c_U\n")
    (cpu, thermo, _), (kokkos, thermo_kokkos, result) = both(lammps, style, particles, text, ranks)
    assert_same(style, cpu, kokkos, 1e-9)
    assert_same_totals(thermo, thermo_kokkos, 1e-9)
    assert np.abs(thermo["c_E[5]"]).max() > 0.1
    for name in own:
        assert relative(cpu[name] - kokkos[name], np.append(cpu[name], 1e-3)) < 1e-9, name
    assert not any("on the host" in line for line in result.warnings), result.warnings


# ---------------------------------------------------------------------------------------------
# large viscosities

SCHEMES = ("rkl2", "implicit tolerance 1e-11", "implicit scheme sdirk2 tolerance 1e-11", "implicit scheme euler tolerance 1e-11")


def stiff(style, dim, options="", keywords=""):
    """A fluid with viscous rates of many times the inverse time step, in shear and bulk."""
    return micropolar.fluid(dim, options, 150.0, 1600.0) if spinning(style) else fluid(dim, options, mu=150.0, kappa=1600.0, keywords=keywords)


def same_on_the_device(lammps, style, particles, text, ranks=1, bound=1e-9):
    result = compare(lammps, style, particles, text, ranks, bound)
    assert not any("on the host" in line for line in result.warnings), result.warnings
    return result


@pytest.mark.parametrize("viscous", SCHEMES)
@pytest.mark.parametrize("dim, ranks, newton", [(2, 1, "on"), (2, 2, "off"), (3, 4, "on")])
def test_large_viscosities(lammps, style, viscous, dim, ranks, newton):
    """Forces of another style, and another group of particles that only move; the number of stages or iterations."""
    particles = disordered(dim, {2: 14, 3: 7}[dim], seed=43, jitter=0.1, speed=0.3, spread=0.0)
    fixes = ("region LOW block INF 4.0 INF INF INF INF\ngroup LOW region LOW\ngroup REST subtract all LOW\nvelocity LOW set 0.3 0.0 0.0\n"
             "fix MOVE LOW nve/noforce\n" + integrate(style, f"viscous {viscous}", "REST") + "fix PULL REST addforce 0.2 -0.3 0\n")
    text = script(style, particles, stiff(style, dim), 40, newton, fixes=fixes).replace(" c_E\n", " c_E f_FLUID[1] f_FLUID[4]\n")
    result = same_on_the_device(lammps, style, particles, text, ranks)
    assert result.thermo()[-1]["f_FLUID[1]"][-1] >= (5 if "rkl2" in viscous else 3)


@pytest.mark.parametrize("options, words", [
    ("limit yes", ""), ("volume mass bulk volume", ""), ("density continuity", ""), ("bulk none", ""), ("eos ideal", ""), ("", "drag 0.4 0.2 -0.1 0"),
    ("", "relax 8.0 0.01"), ("", "1 2 tension 0.7"), ("", "1 2 interdrag 3.0")])
def test_large_viscosities_of_two_fluids(lammps, options, words):
    """With unequal viscosities, and all terms of a fluid."""
    style, rc = "sph/bulk", SUPPORT[2]
    particles = disordered(2, 14, ntypes=2, jitter=0.1, speed=0.5, spread=0.0)
    particles.esph[:] = 80.0
    own = "" if words.startswith("1 2") else words
    model = fluid(2, options, coeff=f"pair_coeff 1 1 1.0 10.0 40.0 90.0 {rc} {own}\npair_coeff 2 2 1.2 9.0 3.0 200.0 {rc}\n")
    if words and not own:
        model += f"pair_coeff {words}\n"
    text = script(style, particles, model, 40, fixes=integrate(style, "viscous rkl2"))
    if "relax" in words:
        relax.write(particles, lammps.path("room.txt"), relax.strained(np.full((len(particles), 1), 0.01)), style)
        text = text.replace("data.txt", "room.txt").replace(f"atom_style {style}", f"atom_style {style} relax 1")
    same_on_the_device(lammps, style, particles, text, ranks=2)


@pytest.mark.parametrize("viscous", SCHEMES[:3])
@pytest.mark.parametrize("name, ranks, newton", [("channel", 1, "on"), ("slip", 2, "off"), ("wheel", 4, "on"), ("variable", 2, "on")])
def test_large_viscosities_at_walls(lammps, style, viscous, name, ranks, newton):
    particles = disordered(2, 20, seed=44, jitter=0.1, speed=0.2, spread=0.0)
    text = with_walls(style, particles, name, stiff(style, 2), 40, newton)
    fixed = integrate(style, group="REST").splitlines()[0]
    compare_walls(lammps, style, particles, text.replace(fixed, f"{fixed} viscous {viscous}"), ranks)


@pytest.mark.parametrize("walls", [False, True])
@pytest.mark.parametrize("law", LAWS[:4])
def test_large_viscosities_by_rate(lammps, law, walls):
    """Several runs: the first forces of a run that continues have the viscosities that the particles keep."""
    style = "sph/bulk"
    particles = disordered(2, 20 if walls else 14, seed=45, jitter=0.1, speed=0.5, spread=0.0)
    relax.write(particles, lammps.path("room.txt"), np.full((len(particles), 1), 0.3), style)
    model = stiff(style, 2, keywords=law)
    if walls:
        text = with_walls(style, particles, "channel", model, 20)
    else:
        text = script(style, particles, model, 20)
    fixed = integrate(style, group="REST" if walls else "all").splitlines()[0]
    text = text.replace(fixed, f"{fixed} viscous rkl2").replace("data.txt", "room.txt").replace("atom_style sph/bulk", "atom_style sph/bulk thixotropy")
    if "cv" in law:
        text = text.replace("fix FLUID", "variable T atom 1.0+0.02*x\nfix FLUID").replace(" viscous", " temperature v_T viscous")
    again = "run 0\nrun 15\nrun 5 pre no\n"
    compared = compare_walls if walls else same_on_the_device
    compared(lammps, style, particles, text + again, ranks=2)


@pytest.mark.parametrize("writer", ["cpu", "kk"])
def test_restart_with_large_viscosities(lammps, style, writer):
    particles = disordered(2, 14, seed=11, jitter=0.1, spread=0.0)
    write(lammps, style, particles)
    fixes = integrate(style, "viscous rkl2")
    frames = []
    for first, then in (([], []), ([], SWITCHES) if writer == "cpu" else (SWITCHES, [])):
        lammps(script(style, particles, stiff(style, 2), 30, fixes=fixes) + "write_restart file.restart\n", switches=first, ranks=2)
        lammps(f"read_restart file.restart\n{fixes}{output(style, 20)}run 20\n", switches=then)
        frames.append(lammps.frame("dump.txt"))
    assert_same(style, *frames, 1e-9)


# ---------------------------------------------------------------------------------------------
# what is copied between host and device

INERTIA, OMEGAEST, TORQUE, MASK = 1 << 56, 1 << 55, 1 << 36, 1 << 5    # bits of the fields


@pytest.fixture(scope="session")
def counter(tmp_path_factory):
    """The library that writes down each copy, see its source."""
    source = Path(__file__).parents[1] / "kokkos" / "copies.cpp"
    library = tmp_path_factory.mktemp("copies") / "copies.so"
    subprocess.run([os.environ.get("CXX", "c++"), "-std=c++17", "-shared", "-fPIC", source, "-o", library, "-ldl"], check=True)
    return library


def copies(lammps, counter, monkeypatch, text, least):
    """From one pass 1 to the next, the first of which is that of the setup: fields (bits) and arrays (bytes) that are copied, arrays from
    least bytes on; the calls that name fields."""
    for name in ("LD_PRELOAD", "KOKKOS_TOOLS_LIBS"):
        monkeypatch.setenv(name, str(counter))
    monkeypatch.setenv("COPIES", "copies.txt")
    result = lammps(text)
    steps, calls = [[]], [Counter()]
    for line in lammps.path("copies.txt").read_text().splitlines():
        word, *rest = line.split()
        if word == "to":
            steps[-1].append((rest[0], int(rest[1], 16)))
        elif word == "call":
            calls[-1][rest[0], int(rest[1], 16)] += 1
        elif word == "copy" and int(rest[-1]) >= least:
            steps[-1].append(("array", " ".join(rest)))
        elif line == "loop sph:density":
            steps.append([])
            calls.append(Counter())
    return steps, calls, result


@pytest.mark.skipif(not DEVICE_LOOPS, reason="nothing is on a device")
@pytest.mark.parametrize("inlet, varies", [("velocity 0.1 0 0", False), ("velocity v_U 0 0", True)])
def test_copies_of_open_ends(lammps, counter, monkeypatch, inlet, varies):
    """Between two neighbor lists the host gets the groups of all particles, and no other field, unless variables prescribe values."""
    channel = open_boundaries.Channel()
    text = channel.text(lammps, inlet, "density 1.0", before="variable U equal 0.1\n", **ledger.keywords("sph/bulk"))
    text += "neigh_modify delay 100 every 100 check no\nrun 10\n"
    steps, _, result = copies(lammps, counter, monkeypatch, text, least=8 * len(channel.place))
    assert len(steps) == 12 and not any("copies all" in line for line in result.warnings)
    if not any(kind == "array" for kind, _ in steps[1]):
        pytest.skip("host and device share their memory")
    copied = {one for step in steps[2:-1] for one in step}
    groups = {("host", MASK), ("device", MASK)}
    others = {one for one in copied - groups if "atom:mask" not in str(one[1])}
    assert bool(others) == varies and (varies or groups < copied), copied


@pytest.mark.skipif(not DEVICE_LOOPS, reason="nothing is on a device")
@pytest.mark.parametrize("fix, options, words", [
    ("sph/dt 10", "", ""), ("sph/refine 10 volume 1.0 wait 0.0", "volume mass", ""), ("sph/torque 0.1 0.2 0.3", "", ""),
    ("sph/torque 0.0 0.0 v_T", "", "variable T equal 0.1\n"), ("ave/time 10 1 10 c_thermo_temp", "", ""), ("momentum 1 linear 1 1 1", "", "suffix off\n")])
def test_copies(lammps, style, counter, monkeypatch, fix, options, words):
    """A fix without suffix that acts every ten steps names no fields in the other steps, which are those of a run without it;
    sph/torque names torques and spins.  With two memories, the arrays that are copied are counted as well."""
    if "torque" in fix and not spinning(style):
        pytest.skip("no spins")
    dim = 3 if "0.1 0.2" in fix else 2
    particles = disordered(dim, {2: 20, 3: 8}[dim], seed=41, jitter=0.1, speed=0.1, spread=0.0)
    write(lammps, style, particles)

    def run(fixes):
        text = script(style, particles, fluids(style, dim, options=options), 25, fixes=integrate(style) + fixes, every=25)
        text = text.replace("delay 0 every 1 check yes", "delay 100 every 100 check no")
        steps, calls, result = copies(lammps, counter, monkeypatch, text, least=8 * len(particles))
        assert len(steps) == 27 and calls[1], "nothing is counted"
        return steps, calls, result

    _, without, _ = run("")
    assert all(one == without[2] for one in without[2:-1])
    steps, calls, result = run(f"{words}fix F all {fix}\nsuffix on\n")
    added = [one - without[2] for one in calls[2:-1]]    # the last one has the output
    acts = [8, 18] if "refine" in fix else [9, 19]    # sph/refine acts before pass 1
    apart = any(kind == "array" for kind, _ in steps[1])    # the memories of host and device
    assert apart == any("copies all particles" in line for line in result.warnings) or not ("momentum" in fix or "v_T" in fix)
    if "torque" in fix and not words:
        named = {mask for one in added for _, mask in one}
        assert all(added) and not any(mask & ~(TORQUE | OMEGAEST | MASK | INERTIA) for mask in named), named
    elif words:
        assert all(added)
    else:
        assert [k for k, one in enumerate(added) if one] == acts, added
    if apart and not words:
        every = steps[2:-1]
        if "torque" in fix:
            assert all({one for one in step if one[0] != "array"} == {("host", TORQUE | OMEGAEST | INERTIA), ("device", TORQUE)} and len(step) == 6
                       for step in every[1:]), every
        else:
            assert [k for k, step in enumerate(every) if step] == acts, every
            assert not any(kind == "device" for step in every for kind, _ in step) or "ave/time" in fix, every
