"""Run LAMMPS on an input text, read what it leaves behind, and make particle sets.

The executables come from the environment: SPHD_LMP (the LAMMPS executable) and SPHD_MPIEXEC
(the MPI launcher, none: tests on several ranks are skipped); ctest sets both. With SPHD_WORKERS=none each run is a process of its own (see Worker).
"""

import atexit
import json
import os
import re
import select
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, replace

import numpy as np
import pytest

from sph_dissipation import each_frame, thermo

LMP = os.environ.get("SPHD_LMP") or shutil.which("lmp") or "lmp"
MPIEXEC = os.environ.get("SPHD_MPIEXEC") or shutil.which("mpiexec") or "mpiexec"
SWITCHES = os.environ.get("SPHD_SWITCHES", "").split()  # of an accelerator package
LIBRARY = os.path.join(os.path.dirname(os.path.realpath(LMP)), "liblammps.so")
KOKKOS = any(word in ("kk", "kk/device") for word in SWITCHES)
DEVICE_LOOPS = "kk/device" in SWITCHES or "g" in SWITCHES  # the pair loops of a GPU, wherever

# Containers run as root and have fewer cores than ranks; Open MPI has to be told that this is meant.
# The other settings save time in hundreds of short runs: no wait for ranks that an error has ended, no search
# for network cards, displays, and other devices.
MPI_ENVIRONMENT = {
    "OMP_NUM_THREADS": "1",
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OMPI_MCA_mpi_yield_when_idle": "1",
    "OMPI_MCA_odls_base_sigkill_timeout": "0",
    "OMPI_MCA_pml": "ob1",
    "OMPI_MCA_btl": "self,vader",
    "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
    "HWLOC_COMPONENTS": "-pci,-linuxio",
    "HWLOC_PLUGINS_PATH": "none",  # those for PCI and displays
    "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
    "PRTE_MCA_hwloc_default_binding_policy": "none",
}

# A single rank needs no daemon, which takes 0.4 s to start; without one, those of several runs at once would share a
# session folder and remove it under each other.
SINGLE_RANK = {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_orte_create_session_dirs": "0"}

SUPPORT = {1: 4.0, 2: 3.0, 3: 2.5}  # default support radius in particle spacings
VECTORS = {"x": ("xu", "yu", "zu"), "v": ("vx", "vy", "vz"), "f": ("fx", "fy", "fz"),
           "vest": ("vestx", "vesty", "vestz")}
FIELDS = ("numden", "dnumden", "vol", "rho", "esph", "desph", "vestx", "vesty", "vestz")


# ---------------------------------------------------------------------------------------------
# running


@dataclass
class Result:
    """What one LAMMPS run left behind."""

    code: int
    output: str
    log: str

    @property
    def error(self):
        """The error messages alone: without the input line that LAMMPS echoes below them."""
        messages = re.findall(r"^ERROR[^:]*:.*?(?=^Last |^-->|^MPI_ABORT|^-----|\Z)",
                              self.output, re.MULTILINE | re.DOTALL)
        return "\n".join(messages)

    @property
    def warnings(self):
        """Lines of the log, without those of LAMMPS about GPU-aware MPI."""
        return [line for line in re.findall(r"^WARNING.*$", self.log, re.MULTILINE) if "GPU-aware MPI" not in line]

    def thermo(self):
        """Thermodynamic output of every run: a list of {column: array}."""
        return thermo(self.log)


class Worker:
    """LAMMPS's library in a process per rank, see worker.py: an input takes 0.02 s, a start of the executable 0.1 s, of mpiexec 0.5 s."""

    started = {}  # by the number of ranks

    @classmethod
    def on(cls, ranks):
        """None: each run is a process of its own."""
        if SWITCHES or "ASAN_OPTIONS" in os.environ or os.environ.get("SPHD_WORKERS") == "none" or not os.path.exists(LIBRARY):
            return None
        worker = cls.started.get(ranks)
        if not (worker and worker.connections and worker.process.poll() is None):
            cls.started[ranks] = cls(ranks)
        return cls.started[ranks] if cls.started[ranks].connections else None

    def __init__(self, ranks):
        self.folder = tempfile.mkdtemp(prefix="sphd-")
        atexit.register(self.close)
        environment = {**os.environ, **MPI_ENVIRONMENT, "OMPI_MCA_orte_tmpdir_base": self.folder}
        address = os.path.join(self.folder, "socket")
        command = [sys.executable, os.path.join(os.path.dirname(os.path.abspath(__file__)), "worker.py"), LIBRARY, address]
        if ranks > 1:
            command = [MPIEXEC, "-n", str(ranks), *command]
        else:
            environment.update(SINGLE_RANK)
        self.connections = []
        with socket.socket(socket.AF_UNIX) as listener:
            listener.bind(address)
            listener.listen(ranks)
            listener.settimeout(0.1)
            self.process = subprocess.Popen(command, cwd=self.folder, env=environment, stdin=subprocess.DEVNULL,
                                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
            while len(self.connections) < ranks:
                try:
                    self.connections.append(listener.accept()[0])
                except TimeoutError:
                    if self.process.poll() is not None:
                        self.close()
                        return

    def run(self, folder, number, timeout):
        """0; 1 after an error; -1 if a process has died; None if there is no end in time."""
        variables = {name: value for name, value in os.environ.items() if name.startswith("LAMMPS_")}
        for connection in self.connections:
            connection.sendall((json.dumps([str(folder), number, variables]) + "\n").encode())
        waiting, answers, end = set(self.connections), {0}, time.monotonic() + timeout
        while waiting and answers <= {0, 1}:
            ready, _, _ = select.select(list(waiting), [], [], max(end - time.monotonic(), 0.0))
            if not ready:
                answers.add(None)
            for connection in ready:
                answers.add(int(connection.recv(100) or -1))    # nothing: the process has died
                waiting.remove(connection)
        if not answers <= {0, 1}:
            self.close()
        if None in answers:
            return None
        return -1 if -1 in answers and 2 not in answers else int(answers != {0})

    def close(self):
        for connection in self.connections:
            connection.close()
        self.connections = []
        try:
            self.process.wait(2)
        except subprocess.TimeoutExpired:
            os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)
        atexit.unregister(self.close)


class Lammps:
    """Runs LAMMPS inside one folder; files of earlier runs stay, so that a run may continue another."""

    def __init__(self, folder):
        self.folder = folder
        self.results = []

    def path(self, name):
        return self.folder / name

    def __call__(self, text, ranks=1, timeout=120, check=True, switches=SWITCHES):
        result = (None if switches else self.run_in_worker(text, ranks, timeout)) or self.run(text, ranks, timeout, switches)
        if result.code and "with PID 0 on" in result.output and "\nTotal wall time" in result.log:
            # LAMMPS has ended well; under load, mpiexec of Open MPI 4 may miss the end of a rank, for which it has no number yet
            result = self.run(text, ranks, timeout, switches)
        self.results.append(result)
        if check:
            assert result.code == 0, f"LAMMPS failed with status {result.code}:\n{result.output[-3000:]}"
        return result

    def run_in_worker(self, text, ranks, timeout):
        """None: there is no worker."""
        worker = None if ranks > 1 and MPIEXEC == "none" else Worker.on(ranks)
        if not worker:
            return None
        number = len(self.results)
        text_file, out, log = (self.path(f"{name}.{number}") for name in ("in", "out", "log"))
        text_file.write_text(text)
        code = worker.run(self.folder, number, timeout)
        output, messages = (file.read_text(errors="replace") if file.exists() else "" for file in (out, log))
        if code is None:
            raise AssertionError(f"LAMMPS hangs (no end after {timeout} s):\n{output[-3000:]}")
        return Result(code, output, messages)

    def run(self, text, ranks, timeout, switches):
        name = f"in.{len(self.results)}"
        log = self.path(f"log.{len(self.results)}")
        self.path(name).write_text(text)
        command = [LMP, "-in", name, "-log", log.name, "-nocite", *switches]
        environment = {**os.environ, **MPI_ENVIRONMENT}
        if ranks > 1 and MPIEXEC == "none":
            pytest.skip("no MPI")
        if ranks > 1:
            command = [MPIEXEC, "-n", str(ranks), *command]
            # concurrent starts of Open MPI 4 fail where they make one session folder at the same time
            environment["OMPI_MCA_orte_tmpdir_base"] = str(self.folder)
        else:
            environment.update(SINGLE_RANK)
        process = subprocess.Popen(command, cwd=self.folder, env=environment,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True, errors="replace",
                                   start_new_session=True)
        try:
            output, _ = process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            output, _ = process.communicate()
            raise AssertionError(f"LAMMPS hangs (no end after {timeout} s):\n{output[-3000:]}") from None
        return Result(process.returncode, output, log.read_text() if log.exists() else "")

    def skip_without(self, simd):
        """Skips a test of an instruction set that this processor does not have."""
        if "not in this processor" in self(f"pair_style sph/bulk simd {simd}\n", check=False).output:
            pytest.skip(f"no {simd} here")

    def frames(self, name):
        return read_dump(self.path(name))

    def frame(self, name):
        """The last frame of a dump file."""
        return self.frames(name)[-1]


@dataclass
class Frame:
    """One snapshot of a dump file, sorted by atom id."""

    step: int
    columns: dict

    def __getitem__(self, name):
        if name in VECTORS:
            return np.column_stack([self.columns[part] for part in VECTORS[name]])
        return self.columns[name]


def read_dump(path):
    """All frames of a dump file written by the commands of dump()."""
    return [Frame(step, {dump_name(name): values for name, values in columns.items()}) for step, columns in each_frame(path)]


def dump_name(word):
    """c_F[k] is the k-th of FIELDS; anything else keeps its name."""
    match = re.fullmatch(r"c_F\[(\d+)\]", word)
    return FIELDS[int(match[1]) - 1] if match else word


def dump(name, every=1, extra=""):
    """Input lines that dump every field to a file; with undump() they may stand around each of several runs."""
    return (f"compute F all property/atom {' '.join(FIELDS)}\n"
            f"dump D all custom {every} {name} id type mass x y z xu yu zu vx vy vz fx fy fz c_F[*] {extra}\n"
            "dump_modify D sort id format float %.17g\n")


def undump():
    return "undump D\nuncompute F\n"


# ---------------------------------------------------------------------------------------------
# particle sets


@dataclass
class Particles:
    """Particles in a periodic box; tilt = (xy, xz, yz) makes it triclinic."""

    dim: int
    x: np.ndarray
    v: np.ndarray
    mass: np.ndarray
    esph: np.ndarray
    type: np.ndarray
    lo: np.ndarray
    hi: np.ndarray
    tilt: tuple = None
    charge: np.ndarray = None

    def __len__(self):
        return len(self.x)

    def where(self, mask):
        """The particles selected by a mask, renumbered."""
        return replace(self, **{name: getattr(self, name)[mask] for name in ("x", "v", "mass", "esph", "type")})

    def write(self, path, ntypes=None, style="sph/bulk"):
        ntypes = ntypes or int(self.type.max())
        lines = ["LAMMPS data file of a test", "", f"{len(self)} atoms", f"{ntypes} atom types", ""]
        lines += [f"{lo} {hi} {axis}lo {axis}hi"
                  for axis, lo, hi in zip("xyz", self.lo.tolist(), self.hi.tolist())]
        if self.tilt is not None:
            lines.append(" ".join(repr(float(t)) for t in self.tilt) + " xy xz yz")
        lines += ["", f"Atoms # {style}", ""]
        for i, (x, m, e, t) in enumerate(zip(self.x.tolist(), self.mass.tolist(), self.esph.tolist(), self.type), 1):
            place = " ".join(map(repr, x))
            lines.append(f"{i} {t} {m} {e} {place}" if style == "sph/bulk"
                         else f"{i} {t} {place} {m} {e} {self.charge[i - 1]}")
        lines += ["", "Velocities", ""]
        lines += [f"{i} " + " ".join(map(repr, v)) for i, v in enumerate(self.v.tolist(), 1)]
        path.write_text("\n".join(lines) + "\n")


def lattice(dim, cells, spacing=1.0):
    """A square or cubic lattice of particles at rest in a periodic box of `cells` cells per direction."""
    counts = [cells] * dim if np.isscalar(cells) else list(cells)
    grid = np.stack(np.meshgrid(*[np.arange(n) + 0.5 for n in counts], indexing="ij"), axis=-1).reshape(-1, dim)
    x = np.zeros((len(grid), 3))
    x[:, :dim] = grid * spacing
    lo, hi = np.full(3, -0.5), np.full(3, 0.5)
    lo[:dim], hi[:dim] = 0.0, np.array(counts) * spacing
    if dim == 1:  # a line in a box that is too wide for images across it to be seen
        lo[1], hi[1] = -10.0, 10.0
    number = len(x)
    return Particles(dim, x, np.zeros((number, 3)), np.ones(number), np.full(number, 5.0),
                     np.ones(number, dtype=int), lo, hi)


def disordered(dim, cells, seed=1, jitter=0.2, speed=0.5, ntypes=1, tilt=None, spread=0.1):
    """A lattice with random displacements, velocities, masses, energies and types."""
    random = np.random.default_rng(seed)
    particles = lattice(dim, cells)
    number = len(particles)
    shift = np.zeros((number, 3))
    shift[:, :dim] = random.uniform(-jitter, jitter, (number, dim))
    particles.x = particles.x + shift
    particles.v[:, :dim] = random.normal(0.0, speed, (number, dim))
    particles.mass = random.uniform(1.0 - spread, 1.0 + spread, number)
    particles.esph = particles.mass * random.uniform(4.0, 6.0, number)
    particles.type = random.integers(1, ntypes + 1, number)
    if tilt is not None:
        xy, xz, yz = tilt
        length = particles.hi - particles.lo
        y, z = ((particles.x - particles.lo) / length)[:, 1:].T
        particles.x[:, 0] += xy * y + xz * z
        particles.x[:, 1] += yz * z
        particles.tilt = tilt
    return particles


def drop(dim, radius, seed=1, rate=0.1, speed=0.3):
    """An isolated disordered drop that rotates; its box must not be periodic (boundary())."""
    particles = disordered(dim, 2 * int(radius) + 2, seed=seed, speed=speed)
    centre = 0.5 * (particles.lo + particles.hi)
    x = particles.x - centre
    if dim == 2:
        x[:, 2] = 0.0
    particles.x = x
    axis = np.array([0.0, 0.0, rate]) if dim == 2 else rate * np.array([0.6, -0.5, 0.8])
    particles.v += np.cross(axis, x)
    particles = particles.where(np.linalg.norm(x, axis=1) < radius)
    reach = np.array([4.0 * radius] * dim + [0.5] * (3 - dim))
    return replace(particles, lo=-reach, hi=reach)


# ---------------------------------------------------------------------------------------------
# units: a number of an input may have one behind it, as the 3.0 of "drag 3.0[pt/ll]"


@dataclass(frozen=True)
class Units:
    """Changes the units of an input: each number with a unit is multiplied by a power of two, which changes no digit of it.

    A unit has the letters l, t, m, and T of length, time, mass, and temperature, and v, r, p, and e of velocity, density,
    pressure, and energy. Each of the four has an exponent of two here; without one, T has that of an energy, as with kB = 1.
    """

    length: int = 0
    time: int = 0
    mass: int = 0
    temperature: int = None
    dim: int = 2

    def exponent(self, unit):
        energy = self.mass + 2 * (self.length - self.time)
        of = {"l": self.length, "t": self.time, "m": self.mass, "T": energy if self.temperature is None else self.temperature,
              "v": self.length - self.time, "r": self.mass - self.dim * self.length, "p": energy - self.dim * self.length, "e": energy}
        above, _, below = unit.partition("/")
        return sum(of[letter] for letter in above.strip("1")) - sum(of[letter] for letter in below)

    def of_input(self, text):
        """The text of an input in these units, without the units behind its numbers."""
        return re.sub(r"(?<![\w.])([\d.]+(?:e[-+]?\d+)?)\[([ltmTvrpe1/]+)\]", lambda found: self.number(*found.groups()), text)

    def number(self, digits, unit):
        power = self.exponent(unit)
        return repr(float(digits) * 2.0**power) if power else digits

    def in_first(self, values, unit):
        """Values of the output in the units in which the input was written."""
        return np.ldexp(values, -self.exponent(unit))


# ---------------------------------------------------------------------------------------------
# input text


def header(dim, newton="on", boundary="p p p", style="sph/bulk"):
    return (f"units lj\ndimension {max(dim, 2)}\nboundary {boundary}\nnewton {newton}\n"
            f"atom_style {style}\n")


def free(dim):
    """Boundary setting of an isolated set of particles."""
    return "f f p" if dim < 3 else "f f f"


def fluid(dim, options="", coeff=None, mu=0.5, kappa=2.0, c0=10.0, rho0=1.0, support=None, keywords=""):
    """pair_style and pair_coeff of one fluid; `options` are pair_style keywords, `keywords` those of pair_coeff."""
    support = support or SUPPORT[dim]
    coeff = coeff or f"pair_coeff * * {rho0} {c0} {mu} {kappa} {support} {keywords}\n"
    return f"pair_style sph/bulk dim {dim} {options}\n{coeff}"


INTEGRATE = "fix FLUID all sph/bulk\ntimestep 0.005\n"


def as_written(values):
    """Single numbers of particles as data files have them, with 16 digits; vectors are there with all digits."""
    return np.vectorize(lambda value: float(f"{value:.16g}"))(values)


def relative(difference, scale):
    """Largest absolute entry of `difference` over that of `scale`."""
    return np.abs(difference).max() / np.abs(scale).max()


def momentum_errors(first, last):
    """Changes of momentum and of angular momentum between two frames, each over the sum of the absolute values of the first."""
    def each(frame):
        p = frame["mass"][:, None] * frame["v"]
        return p, np.cross(frame["x"], p)

    return [np.abs((after - before).sum(axis=0)).max() / np.abs(before).sum() for before, after in zip(each(first), each(last), strict=True)]
