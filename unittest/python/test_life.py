"""Objects that come and go: particles in a run, fixes, styles, computes, instances of LAMMPS; and minimization."""

import os
import re
import subprocess
import sys
import textwrap

import numpy as np
import pytest

from helpers import DEVICE_LOOPS, INTEGRATE, KOKKOS, LMP, MPI_ENVIRONMENT, SUPPORT, disordered, drop, dump, fluid, free, header, relative
import test_micropolar as micropolar

# Python is not built with the sanitizers, whose library would have to be loaded first
UNSANITIZED = pytest.mark.skipif("detect_leaks" in os.environ.get("ASAN_OPTIONS", ""), reason="LAMMPS with the sanitizers")

FULL = "thermo_modify norm no format float %.17g\n"


# ---------------------------------------------------------------------------------------------
# minimization: velocities and spins have no place in it


def start(lammps, style, particles):
    """A fluid in motion."""
    if style == "sph/bulk":
        particles.write(lammps.path("box.data"))
        return header(2) + "read_data box.data\n" + fluid(2) + INTEGRATE
    micropolar.write(particles, lammps.path("box.data"))
    return header(2, style=style) + "read_data box.data\n" + micropolar.fluid(2) + micropolar.integrate()


@pytest.mark.parametrize("style", ["sph/bulk", "sph/micropolar"])
@pytest.mark.parametrize("ranks", [1, 2])
def test_minimize_after_a_run_reaches_the_tolerance(lammps, style, ranks):
    text = start(lammps, style, disordered(2, 12, speed=2.0))
    result = lammps(text + "thermo 1000\nrun 40\nmin_style cg\nminimize 0 1e-4 10000 20000\n", ranks=ranks)
    assert "Stopping criterion = force tolerance" in result.log
    initial, final = re.search(r"next-to-last, final = *\n *(\S+) +\S+ +(\S+)", result.log).groups()
    assert float(final) < 0.05 * float(initial)


@pytest.mark.parametrize("ranks", [1, 2])
def test_densities_stay_in_a_minimization(lammps, ranks):
    """density continuity: particles that a command deletes or creates take nothing from the densities of others."""
    text = start(lammps, "sph/bulk", disordered(2, 12, speed=0.1)).replace("pair_style sph/bulk", "pair_style sph/bulk density continuity")
    text += ("region LEFT block INF 6 INF INF INF INF\ncompute RHO all property/atom rho\ncompute MIN all reduce min c_RHO\ncompute MAX all reduce max c_RHO\n"
             "thermo_style custom step atoms c_MIN c_MAX\nrun 5\ndelete_atoms region LEFT compress no\n" + FULL)
    kept = lammps(text + "run 0\n", ranks=ranks).thermo()[-1]
    found = lammps(text + "minimize 0 0 0 0\n", ranks=ranks).thermo()[-1]
    assert kept["Atoms"][-1] < 100
    for name in "c_MIN", "c_MAX":
        assert found[name][0] == pytest.approx(kept[name][-1], rel=1e-14)
    assert kept["c_MIN"][-1] > 0.9


def test_fire_does_not_heat(lammps):
    text = start(lammps, "sph/bulk", disordered(2, 12, speed=2.0))
    result = lammps(text + "compute E all sph/energy\nthermo_style custom step pe c_E[2]\nthermo 10\n" + FULL
                    + "run 40\nmin_style fire\nminimize 0 1e-4 3000 6000\n")
    _, table = result.thermo()
    energy = table["PotEng"]
    assert energy.max() == energy[0] and energy[-1] < 0.05 * energy[0]
    np.testing.assert_allclose(table["c_E[2]"], table["c_E[2]"][0], rtol=1e-14, err_msg="the internal energy takes no part")


@pytest.mark.parametrize("style", ["sph/bulk", "sph/micropolar"])
def test_forces_of_a_minimization_are_those_at_rest(lammps, style):
    """After a run, without steps: the forces of the same positions without any velocity and spin."""
    text = start(lammps, style, disordered(2, 10, speed=2.0)) + "run 5\n"
    columns = "id fx fy fz" + (" tqx tqy tqz" if style != "sph/bulk" else "")
    show = f"write_dump all custom NAME {columns} modify sort id format float %.17g\n"
    stop = "set group all omega 0 0 0\n" if style != "sph/bulk" else ""
    lammps(text + "minimize 0 0 0 0\n" + show.replace("NAME", "min.dump")
           + "velocity all set 0 0 0\n" + stop + "run 0\n" + show.replace("NAME", "rest.dump"))
    minimum, rest = lammps.frame("min.dump"), lammps.frame("rest.dump")
    for name in columns.split()[1:]:
        assert np.abs(minimum[name] - rest[name]).max() <= 1e-13 * np.abs(rest["f"]).max(), name


def test_force_of_a_minimization_is_the_slope_of_the_energy(lammps):
    """Central differences of fourth order in the position of one particle."""
    step, moves = 1e-3, (-2, -1, 1, 2)
    text = start(lammps, "sph/bulk", disordered(2, 10, speed=2.0)) + "group one id 37\nrun 5\n"
    text += "thermo_style custom step pe\n" + FULL + "compute f one reduce sum fx fy\nvariable e equal pe\n"
    text += "minimize 0 0 0 0\nprint 'FORCE $(c_f[1]:%.17g) $(c_f[2]:%.17g)'\n"
    for axis in ("{} 0 0", "0 {} 0"):
        for k in moves:
            there, back = (axis.format(sign * k * step) for sign in (1, -1))
            text += (f"displace_atoms one move {there} units box\nminimize 0 0 0 0\nprint 'ENERGY $(v_e:%.17g)'\n"
                     f"displace_atoms one move {back} units box\n")
    log = lammps(text).log
    force = np.array(re.findall(r"^FORCE (\S+) (\S+)", log, re.MULTILINE)[0], dtype=float)
    energy = np.array(re.findall(r"^ENERGY (\S+)", log, re.MULTILINE), dtype=float).reshape(2, 4)
    slope = energy @ np.array([1.0, -8.0, 8.0, -1.0]) / (12.0 * step)
    print(force, -slope)
    assert relative(force + slope, force) < 1e-8


def test_an_ideal_gas_is_not_minimized(lammps):
    disordered(2, 8).write(lammps.path("box.data"))
    result = lammps(header(2) + "read_data box.data\n" + fluid(2, "eos ideal") + INTEGRATE + "minimize 0 1e-4 10 20\n",
                    check=False)
    assert "eos ideal cannot be used in a minimization" in result.error


# ---------------------------------------------------------------------------------------------
# particles that arrive


INERTIA = (0.16, 0.1)    # of a particle of mass 1.2 and density 1 in 2d: 0.16 * 1.2 + 0.1
ARRIVING_MASS = 1.2


def arrivals(lammps, style, keywords="", velocity="vx 0.5 0.5 vy -1.0 -1.0", ranks=1, number=3, steps=80, check=True, options="", energy=None):
    """A drop that turns and gets a particle in every 20th step."""
    particles = drop(2, 7.0)
    lammps.path("one.mol").write_text(
        f"a particle\n\n1 atoms\n\nCoords\n\n1 0 0 0\n\nTypes\n\n1 1\n\nMasses\n\n1 {ARRIVING_MASS}\n")
    if style == "sph/bulk":
        particles.esph[:] = energy or particles.esph
        particles.write(lammps.path("box.data"))
        model = fluid(2, options)
    else:
        micropolar.write(particles, lammps.path("box.data"), inertia=0.0)
        model = micropolar.fluid(2)
    return lammps(header(2, boundary=free(2), style=style) + "read_data box.data\n" + model
                  + f"fix FLUID all {style} {keywords}\ntimestep 0.002\n"
                  "molecule one one.mol\nregion top block -3 3 7.0 8.0 0 0 units box\n"
                  f"fix D all deposit {number} 0 20 4711 mol one region top near 0.4 {velocity} units box\n"
                  "compute V all property/atom vestx vesty vestz\n"
                  + ("compute S all property/atom inertia omegaestz\ncompute L all sph/angmom point 0 0 0\n"
                     "thermo_style custom step atoms c_L[3]\n" if style != "sph/bulk" else
                     "thermo_style custom step atoms\n") + "thermo 1\n" + FULL
                  + "dump D all custom 1 out.dump id mass xu yu zu vx vy vz c_V[*] "
                  + ("c_S[*]" if style != "sph/bulk" else "") + "\ndump_modify D sort id format float %.17g\n"
                  f"run {steps}\n", ranks=ranks, check=check)


def first_frame_with(frames, number):
    return next(frame for frame in frames if len(frame["id"]) == number)


@pytest.mark.parametrize("ranks", [1, 2, 4])
def test_a_new_particle_has_inertia_and_keeps_angular_momentum(lammps, ranks):
    result = arrivals(lammps, "sph/micropolar", "inertia {} {}".format(*INERTIA), ranks=ranks)
    (table,) = result.thermo()
    frames = lammps.frames("out.dump")
    first, last = frames[0], frames[-1]
    old = len(first["id"])
    assert len(last["id"]) == old + 3
    expected = INERTIA[0] * ARRIVING_MASS + INERTIA[1]
    np.testing.assert_allclose(last["c_S[1]"][old:], expected, rtol=1e-14)
    assert np.all(last["c_S[1]"][:old] == first["c_S[1]"]), "the others keep theirs"

    # constant while nobody arrives
    size = np.abs(table["c_L[3]"]).max()
    for number in np.unique(table["Atoms"]):
        momentum = table["c_L[3]"][table["Atoms"] == number]
        assert np.ptp(momentum) < 1e-12 * size


@pytest.mark.parametrize("style", ["sph/bulk", "sph/micropolar"])
def test_a_new_particle_moves_as_it_arrives(lammps, style):
    """The forces of the step in which it arrives see its velocity."""
    arrivals(lammps, style, "inertia 0.16 0.1" if style != "sph/bulk" else "")
    frames = lammps.frames("out.dump")
    old = len(frames[0]["id"])
    for new in (1, 2, 3):
        frame = first_frame_with(frames, old + new)
        assert [frame[f"c_V[{k}]"][-1] for k in (1, 2, 3)] == [0.5, -1.0, 0.0]


@pytest.mark.parametrize("ranks", [1, 2])
def test_new_particles_without_heat_are_told_once(lammps, ranks):
    """Noise at the temperatures of the particles leaves them cold; fix deposit gives them no energy."""
    result = arrivals(lammps, "sph/bulk", options="temp energy 10.0 5", energy=100.0, ranks=ranks)
    cold = [line for line in result.warnings if "particles have no heat" in line]
    assert len(cold) == 1 and "1 particles have no heat, and no noise until" in cold[0], result.warnings


def test_a_new_particle_without_inertia_is_refused_when_it_arrives(lammps):
    """The particles there have one from the set command; the new one comes in step 1, nobody gives it one."""
    particles = drop(2, 7.0)
    micropolar.write(particles, lammps.path("box.data"), inertia=0.2)
    lammps.path("one.mol").write_text("a particle\n\n1 atoms\n\nCoords\n\n1 0 0 0\n\nTypes\n\n1 1\n\nMasses\n\n1 1.0\n")
    text = (header(2, boundary=free(2), style="sph/micropolar") + "read_data box.data\n" + micropolar.fluid(2)
            + micropolar.integrate() + "molecule one one.mol\nregion top block -3 3 7.0 8.0 0 0 units box\n"
            "fix D all deposit 1 0 20 4711 mol one region top near 0.4 vy -1.0 -1.0 units box\n")
    for ranks in (1, 2):
        result = lammps(text + "run 5\n", check=False, ranks=ranks)
        assert "inertia must be > 0" in result.error and "that of 1 particles" in result.error
        assert "use the inertia keyword" in result.error


def test_particles_created_between_runs_get_their_inertia(lammps):
    particles = disordered(2, 10)
    micropolar.write(particles, lammps.path("box.data"), inertia=0.0)
    result = lammps(header(2, style="sph/micropolar") + "read_data box.data\n" + micropolar.fluid(2)
                    + micropolar.integrate("inertia 0.16 0.1") + micropolar.dump("out.dump", 5) + "run 5\n"
                    "create_atoms 1 single 5 5 0 units box\ngroup new id 101\nset group new mass 1\nrun 5\n")
    frames = lammps.frames("out.dump")
    before, after = frames[0]["c_G[1]"], frames[-1]["c_G[1]"]
    assert len(after) == len(before) + 1 and after[-1] > 0.1
    assert np.all(after[:-1] == before)
    assert not result.error


# what was stored does not beat what the input says


@pytest.mark.parametrize("first, then, set_anew", [
    ("inertia 0.16 0.1", "inertia 0.16 0.1", False),
    ("inertia 0.16 0.1", "", False),
    ("inertia 0.16 0.1", "inertia 0.16 0.2", True),
    ("", "inertia 0.16 0.2", True),
    ("", "", False)])
def test_inertia_of_a_continued_run(lammps, first, then, set_anew):
    particles = disordered(2, 10)
    micropolar.write(particles, lammps.path("box.data"), inertia=0.3)
    define = "compute V all property/atom inertia vol\n"
    show = "write_dump all custom NAME id c_V[*] modify sort id format float %.17g\n"
    lammps(header(2, style="sph/micropolar") + "read_data box.data\n" + micropolar.fluid(2) + micropolar.integrate(first)
           + define + "run 5\n" + show.replace("NAME", "first.dump") + "write_restart box.restart\n")
    lammps("read_restart box.restart\n" + micropolar.integrate(then) + define + "run 0\n"
           + show.replace("NAME", "then.dump"))
    before, after = lammps.frame("first.dump"), lammps.frame("then.dump")
    if set_anew:
        np.testing.assert_allclose(after["c_V[1]"], 0.16 * after["c_V[2]"] + 0.2, rtol=1e-14)
    else:
        assert np.all(after["c_V[1]"] == before["c_V[1]"])


def test_set_and_dump_of_the_inertia(lammps):
    """It is a property that other commands know."""
    particles = disordered(2, 8)
    micropolar.write(particles, lammps.path("box.data"), inertia=0.0)
    lammps(header(2, style="sph/micropolar") + "read_data box.data\n" + micropolar.fluid(2) + micropolar.integrate()
           + "variable I atom 0.1+0.01*id\nset group all d_inertia v_I\nrun 1\n"
           "write_dump all custom out.dump id d_inertia d2_omegaest[3] omegaz modify sort id format float %.17g\n")
    frame = lammps.frame("out.dump")
    np.testing.assert_allclose(frame["d_inertia"], 0.1 + 0.01 * frame["id"], rtol=1e-15)
    assert np.abs(frame["d2_omegaest[3]"] - frame["omegaz"]).max() < 0.1


# ---------------------------------------------------------------------------------------------
# who integrates whom


def test_particles_of_two_integrators_are_refused(lammps):
    disordered(2, 8).write(lammps.path("box.data"))
    text = header(2) + "read_data box.data\n" + fluid(2) + "group A id 1:10\ngroup B id 8:64\n"
    for ranks in (1, 2):
        result = lammps(text + "fix 1 A sph/bulk\nfix 2 B sph/bulk\nrun 0\n", check=False, ranks=ranks)
        assert "Fixes 1 and 2 both integrate 3 particles" in result.error
    result = lammps(text + "fix 1 A sph/bulk\nfix 2 B nve\nrun 0\n")
    assert any("time integrated more than once" in warning for warning in result.warnings)
    lammps(text + "group B clear\ngroup B id 11:64\nfix 1 A sph/bulk\nfix 2 B sph/bulk\nrun 2\n")


def test_particles_that_nobody_integrates_are_told_once(lammps):
    disordered(2, 8).write(lammps.path("box.data"))
    text = (header(2) + "read_data box.data\n" + fluid(2) + "group A id 1:10\ngroup B id 11:64\n"
            "fix 1 B sph/bulk\ntimestep 0.005\n")

    def told(result):
        return [int(re.search(r"(\d+) particles of the fluid", line)[1]) for line in result.warnings
                if "in the group of no fix that integrates them" in line]

    assert told(lammps(text + "run 1\nrun 1\n", ranks=2)) == [10]
    assert told(lammps(text + "run 1\ngroup B id 1:4\nrun 1\n")) == [10, 6]
    assert told(lammps(text + "fix 2 A move linear 1 0 0\nrun 1\n")) == []
    assert told(lammps(text + "fix 2 A sph/wall\nrun 1\n")) == []


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_torque_that_nobody_gets(lammps, ranks):
    """Particles 1 to 20 are not integrated, 21 to 30 have no inertia."""
    particles = disordered(2, 8)
    inertia = np.full(64, 0.2)
    inertia[20:30] = 0.0
    micropolar.write(particles, lammps.path("box.data"), inertia=inertia, omega=np.zeros((64, 3)))
    text = (header(2, style="sph/micropolar") + "read_data box.data\n" + micropolar.fluid(2, mu_r=0.0, gamma1=0.0)
            + "group moving id 21:64\ngroup still id 1:20\nfix T GROUP sph/torque 0 0 0.25\n"
            "fix 1 moving sph/micropolar\ntimestep 0.002\nthermo_style custom step f_T[3] f_T\n" + FULL)
    result = lammps(text.replace("GROUP", "all") + "compute S all sph/angmom\nthermo_style custom step f_T[3] f_T c_S[9]\n"
                    + FULL + "run 10\nrun 0\n", ranks=ranks)
    assert len([line for line in result.warnings if "30 of the 64 particles of its group get no torque" in line]) == 1
    table = result.thermo()[0]
    np.testing.assert_allclose(table["f_T[3]"], 34 * 0.25, rtol=1e-14)
    assert table["c_S[9]"][-1] == pytest.approx(34 * 0.25 * 10 * 0.002, rel=1e-12)
    result = lammps(text.replace("GROUP", "still") + "run 1\n", ranks=ranks, check=False)
    assert "no particle of its group has an inertia > 0" in result.error
    result = lammps(text.replace("GROUP", "moving").replace("fix 1 moving sph/micropolar",
                                                            "fix 1 moving sph/micropolar inertia 0.1 0.1") + "run 1\n")
    assert not [line for line in result.warnings if "torque" in line], "the inertia comes in time"


# ---------------------------------------------------------------------------------------------
# computes


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("change, use, words", [
    ("pair_style none\n", "$(c_Q)", "requires pair style sph/bulk or sph/micropolar"),
    ("create_atoms 1 random 20000 4711 NULL\n", "$(c_Q)", "use run 0 first"),
    ("create_atoms 1 random 20000 4711 NULL\n", "$(c_Q[2])", "use run 0 first"),
    ("create_atoms 1 random 20000 4711 NULL\n", "$(c_R)", "use run 0 first"),
    ("delete_atoms group half\n", "$(c_Q)", "use run 0 first")])
def test_dissipation_of_forces_that_are_gone(lammps, change, use, words, ranks):
    disordered(2, 10).write(lammps.path("box.data"))
    text = (header(2) + "read_data box.data\n" + fluid(2) + INTEGRATE + "compute Q all sph/dissipation\n"
            "compute R all reduce sum c_Q\ngroup half id 1:50\nrun 2\n")
    result = lammps(text + change + f"print \"{use}\"\n", check=False, ranks=ranks)
    assert words in result.error, result.output[-1500:]


def test_dissipation_before_the_first_run(lammps):
    disordered(2, 10).write(lammps.path("box.data"))
    result = lammps(header(2) + "read_data box.data\n" + fluid(2) + INTEGRATE + "compute Q all sph/dissipation\n"
                    "print \"$(c_Q)\"\n", check=False)
    assert result.code != 0 and "ERROR" in result.error


def test_computes_at_the_same_step_see_what_has_changed(lammps):
    disordered(2, 10).write(lammps.path("box.data"))
    log = lammps(header(2) + "read_data box.data\n" + fluid(2) + INTEGRATE + "compute Q all sph/dissipation\n"
                 "compute E all sph/energy\nthermo_style custom step c_Q c_E\nrun 0\n"
                 "print 'VALUE $(c_Q[1]) $(c_Q) $(c_E)'\npair_coeff * * 1 10 1.0 2.0 3.0\nset group all sph/e 1\nrun 0\n"
                 "print 'VALUE $(c_Q) $(c_Q[1]) $(c_E)'\n").log
    (shear, before, energy), (after, shear_after, energy_after) = (
        map(float, words) for words in re.findall(r"^VALUE (\S+) (\S+) (\S+)", log, re.MULTILINE))
    assert shear_after == pytest.approx(2.0 * shear, rel=1e-5) and after != before and energy != energy_after


@UNSANITIZED
@pytest.mark.parametrize("ranks", [1, 2])
def test_a_process_that_dies_is_no_error_of_an_input(lammps, ranks):
    """And the next input runs."""
    good = "region box block 0 1 0 1 0 1\ncreate_box 1 box\n"
    assert lammps(good + "crazy\n", ranks=ranks, check=False).code == 1
    assert lammps(good + "shell 'kill -KILL $PPID'\nrun 0\n", ranks=ranks, check=False).code not in (0, 1)
    lammps(good, ranks=ranks)


# ---------------------------------------------------------------------------------------------
# the library: several instances in one process, and its view of the particles


LIBRARY = """
import ctypes, sys
import numpy as np

lib = ctypes.CDLL(sys.argv[1], ctypes.RTLD_GLOBAL)
lib.lammps_open_no_mpi.restype = ctypes.c_void_p
lib.lammps_extract_atom.restype = ctypes.c_void_p
lib.lammps_get_natoms.restype = ctypes.c_double


class Instance:
    def __init__(self):
        arguments = [b"lammps", b"-screen", b"none", b"-log", b"none", b"-nocite"]
        self.handle = ctypes.c_void_p(lib.lammps_open_no_mpi(len(arguments),
                                                             (ctypes.c_char_p * len(arguments))(*arguments), None))

    def __call__(self, text):
        lib.lammps_commands_string(self.handle, text.encode())
        if lib.lammps_has_error(self.handle):
            message = ctypes.create_string_buffer(1000)
            lib.lammps_get_last_error_message(self.handle, message, 1000)
            raise SystemExit(message.value.decode())

    def vector(self, name):
        pointer = lib.lammps_extract_atom(self.handle, name.encode())
        assert pointer, name
        number = int(lib.lammps_get_natoms(self.handle))
        return np.ctypeslib.as_array(ctypes.cast(pointer, ctypes.POINTER(ctypes.c_double)), (number,)).copy()

    def integers(self, name):
        pointer = lib.lammps_extract_atom(self.handle, name.encode())
        number = int(lib.lammps_get_natoms(self.handle))
        return np.ctypeslib.as_array(ctypes.cast(pointer, ctypes.POINTER(ctypes.c_int)), (number,)).copy()

    def array(self, name):
        pointer = lib.lammps_extract_atom(self.handle, name.encode())
        assert pointer, name
        number = int(lib.lammps_get_natoms(self.handle))
        rows = ctypes.cast(pointer, ctypes.POINTER(ctypes.POINTER(ctypes.c_double)))
        return np.array([[rows[i][d] for d in range(3)] for i in range(number)])

    def close(self):
        lib.lammps_close(self.handle)
"""


def library(lammps, body, code=0):
    script = lammps.path("script.py")
    script.write_text(LIBRARY + textwrap.dedent(body))
    path = os.path.join(os.path.dirname(os.path.realpath(LMP)), "liblammps.so")
    if not os.path.exists(path):
        pytest.skip("LAMMPS was built without its shared library")
    process = subprocess.run([sys.executable, str(script), path], cwd=lammps.folder, stdin=subprocess.DEVNULL,
                             env={**os.environ, **MPI_ENVIRONMENT}, text=True, timeout=120,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert process.returncode == code, process.stdout[-3000:]
    return process.stdout


def micropolar_text(lammps):
    micropolar.write(disordered(2, 8), lammps.path("box.data"))
    return (header(2, style="sph/micropolar") + "read_data box.data\n" + micropolar.fluid(2) + micropolar.integrate())


@UNSANITIZED
def test_library_knows_inertia_and_spin(lammps):
    text = micropolar_text(lammps)
    library(lammps, f"""
        one = Instance()
        one({text!r})
        one("set group all omega 0 0 2.5\\nrun 0")
        assert np.all(one.vector("d_inertia") == 0.2)
        assert np.all(one.array("omega") == [0, 0, 2.5])
        assert np.all(one.array("d2_omegaest") == [0, 0, 2.5])
        assert np.all(one.vector("d_desph_before") == 0.0)
        for name in ("vfrac", "rho", "esph", "desph", "rmass"):
            assert np.all(np.isfinite(one.vector(name)))
        one.close()
        """)


@UNSANITIZED
def test_several_instances_in_one_process(lammps):
    """Interleaved, made and closed in any order, and with atom styles that follow each other: the same results."""
    text = micropolar_text(lammps)
    library(lammps, f"""
        text = {text!r}

        def result(instance):
            return np.concatenate([instance.vector("d_inertia")[:, None], instance.array("omega"), instance.array("x")], 1)

        alone = Instance()
        alone(text + "run 20")
        expected = result(alone)
        alone.close()
        for repetition in range(20):
            one, two, three = Instance(), Instance(), Instance()
            one("atom_style hybrid sph/micropolar charge\\natom_style sph/micropolar\\natom_style sph/bulk\\n"
                "atom_style hybrid sph/bulk charge\\natom_style charge\\n" + text)
            two(text + "run 5")
            three(text + "replicate 2 1 1\\nreplicate 1 2 1\\nrun 1")
            one("run 20")
            three.close()
            two("run 15 pre no")
            assert np.all(result(one) == expected)
            assert np.all(result(two) == expected)
            one("clear\\n" + text + "run 20")
            two.close()
            assert np.all(result(one) == expected)
            one.close()
        """)


# ---------------------------------------------------------------------------------------------
# between runs: what is defined after a run, and what was replaced since


BOX = """units lj
dimension 2
atom_style {style}
boundary {boundary} p p
lattice sq 1.0
region box block 0 24 0 12 -0.5 0.5
create_box 1 box
create_atoms 1 box
set group all mass 1.0
set group all sph/e 1.0
region floor block INF INF INF 3.9 INF INF
group wall region floor
region in block INF 7.9 INF INF INF INF
group in region in
group fluid subtract all wall in
pair_style {style} volume mass
pair_coeff * * {coeff}
fix FLUID fluid {style} {keywords}
timestep 0.001
thermo_style custom step atoms pe
variable target equal "0.3+1.5*(floor((step+1)/2)%2)"
variable torque equal 0.1
"""
FIXES = {"refine": "fix NEW fluid sph/refine 1 volume v_target wait 0.0", "dt": "fix NEW all sph/dt 1",
         "wall": "fix NEW wall sph/wall velocity 0.1 0 0", "torque": "fix NEW fluid sph/torque 0 0 v_torque",
         "open": "fix NEW in sph/open fluid 8 0 0 1 0 0 8 velocity 0.1 0 0", "integrator": "fix NEW fluid {style} {keywords}",
         "rkl2": "fix NEW fluid {style} viscous rkl2"}
PAIRS = {"none": "pair_style none", "zero": "pair_style zero 3.0\npair_coeff * *", "new": "pair_style none\npair_style {style} volume mass",
         "hybrid": "pair_style hybrid {style} volume mass zero 3.0"}


def between_runs(name, text):
    spin = (name == "torque")
    words = {"style": "sph/micropolar" if spin else "sph/bulk", "keywords": "inertia 0.1667 0.0" if spin else "",
             "boundary": "f" if name == "open" else "p",
             "coeff": "1.0 10.0 0.5 1.0 " + ("0.1 0.05 -0.05 3.0" if spin else "3.0")}
    keep = name not in ("integrator", "rkl2")
    box = BOX if keep else BOX.replace("fix FLUID", "#")
    return (box + text).replace("FIX", FIXES[name]).format(**words)


def test_refine_defined_after_a_run(lammps):
    """... and the time step changed then: it waits for the same time as if that had been in the other order."""
    fix = FIXES["refine"].replace("0.0", "0.002")
    numbers = []
    for commands in (f"{fix}\ntimestep 0.0005", f"timestep 0.0005\n{fix}"):
        result = lammps(between_runs("refine", f"run 2\n{commands}\nthermo 1\nrun 8\n"))
        numbers.append(result.thermo()[-1]["Atoms"])
    assert len(np.unique(numbers[0])) > 2 and np.all(numbers[0] == numbers[1])


@pytest.mark.parametrize("name, pair", [(name, pair) for name in FIXES for pair in PAIRS if name == "refine" or pair in ("zero", "new")])
def test_pair_style_replaced(lammps, name, pair):
    """Another time step, other particles, output, the end of the fix; a run with pre no is refused."""
    values = "" if name in ("integrator",) else "print '$(f_NEW[1])'\n"
    text = f"FIX\nrun 2\n{PAIRS[pair]}\n"
    lammps(between_runs(name, text + "timestep 0.0005\ncreate_atoms 1 single 9.3 7.1 0\n" + values + "unfix NEW\nclear\n"))
    result = lammps(between_runs(name, text + "run 1 pre no\n"), check=False)
    assert result.code == 1 and "changed after the last run was set up" in result.error, result.output[-2000:]


@pytest.mark.parametrize("change", ["pair_coeff * * 1.0 10.0 0.5 2.0 3.0", "pair_style sph/bulk volume mass eos tait"])
def test_new_coefficients_and_no_setup(lammps, change):
    """What follows from the coefficients is derived when a run is set up."""
    result = lammps(between_runs("wall", f"FIX\nrun 2\n{change}\nrun 2 pre no\n"), check=False, ranks=2)
    assert result.code == 1 and "changed after the last run was set up" in result.error, result.output[-2000:]
    lammps(between_runs("wall", f"FIX\nrun 2\n{change}\nrun 2\nrun 2 pre no\n"))


@pytest.mark.parametrize("name", FIXES)
def test_fix_defined_again_and_no_setup(lammps, name):
    result = lammps(between_runs(name, "FIX\nrun 2\nFIX\ntimestep 0.0005\nrun 2 pre no\n"), check=False)
    assert result.code == 1 and "was defined after the last run was set up" in result.error, result.output[-2000:]
    lammps(between_runs(name, "FIX\nrun 2\nFIX\nrun 2\nrun 2 pre no\n"))


@pytest.mark.parametrize("neighbor", ["bin", "nsq"])
@pytest.mark.parametrize("ranks", [1, 2])
def test_a_file_between_runs_and_no_setup(lammps, neighbor, ranks):
    """A stream goes on after write_data, with lists of the package, of LAMMPS, and of KOKKOS."""
    if KOKKOS and neighbor == "nsq":
        pytest.skip("KOKKOS has lists with bins alone")
    text = f"neighbor 0.3 {neighbor}\nvelocity fluid set 8 3 0\nFIX\ntimestep 0.002\n"
    whole, parts = (lammps(between_runs("wall", text + runs), ranks=ranks).thermo()[-1]["PotEng"][-1]
                    for runs in ("run 60\n", "run 30\nwrite_data new.data\nrun 30 pre no\n"))
    assert whole > 0.1 and abs(parts / whole - 1) < 1e-10


@pytest.mark.skipif(not DEVICE_LOOPS, reason="KOKKOS alone moves a fluid to a device")
def test_a_fluid_that_goes_to_the_device_and_no_setup(lammps):
    """write_data moves the fluid to the device, whose list is not built."""
    text = "suffix off\nFIX\nsuffix on\nrun 2\nunfix NEW\nwrite_data new.data\nrun 4 pre no\n"
    result = lammps(between_runs("wall", text), check=False)
    assert result.code == 1 and "changed after the last run was set up" in result.error, result.output[-2000:]


NEW_PAIR = "FIX\nrun 2\npair_style none\npair_style {style} volume mass\npair_coeff * * {coeff}\n"


@pytest.mark.parametrize("name, commands", [("wall", NEW_PAIR), ("rkl2", NEW_PAIR), ("wall", "FIX\npair_modify compute no\nrun 2\npair_modify compute yes\n")])
def test_new_forces_and_no_setup(lammps, name, commands):
    """write_data initializes the pair style; forces are those of a setup."""
    result = lammps(between_runs(name, commands + "write_data new.data\nrun 2 pre no\n"), check=False)
    assert result.code == 1 and "changed after the last run was set up" in result.error, result.output[-2000:]


def test_energy_of_a_tension_that_has_no_forces(lammps):
    text = between_runs("wall", "FIX\nrun 2\npair_coeff * * {coeff} cohesion 0.1\nwrite_data new.data\nprint '$(c_E)'\n")
    text = text.replace("thermo_style", "compute E all sph/energy\nthermo_style").replace("volume mass", "density continuity tension yes")
    result = lammps(text, check=False)
    assert result.code == 1 and "needs the forces of the present particles" in result.error, result.output[-2000:]


def test_minimization_and_no_setup(lammps):
    """The volumes and velocities of a run begin in its setup."""
    result = lammps(between_runs("wall", "FIX\nrun 1\nminimize 0 0 3 10\nrun 50 pre no\n"), check=False)
    assert result.code == 1 and "the state is that of a minimization" in result.error, result.output[-2000:]


def test_temperature_of_a_pair_style_without_coefficients(lammps):
    text = between_runs("wall", "").replace("volume mass", "temp energy 1.0 5 volume mass") + "compute T all sph/temp\nrun 2\n"
    for ranks in (1, 2):
        result = lammps(text + "pair_style none\npair_style sph/bulk temp energy 1.0 5\nprint '$(c_T[5])'\n", check=False, ranks=ranks)
        assert "Compute sph/temp needs the coefficients of the present pair style" in result.error, result.output[-2000:]


def test_a_custom_property_of_the_same_name_is_refused(lammps):
    result = lammps("fix 1 all property/atom d_inertia\natom_style sph/micropolar\n", check=False)
    assert "inertia" in result.error
    result = lammps("atom_style sph/micropolar\nfix 1 all property/atom d_inertia\n", check=False)
    assert "vector name already exists" in result.error
