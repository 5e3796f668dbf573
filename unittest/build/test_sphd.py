"""What ./sphd installs and configures on a machine that has nothing, or all, or no administrator: apt-get, dpkg-query, compiler,
and CMake are stand-ins here."""

import fcntl
import os
import re
import shutil
import subprocess
import tarfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BUILD = {"g++", "make", "cmake", "ninja-build", "ccache", "ca-certificates", "openmpi-bin", "libopenmpi-dev",
         "libfftw3-dev", "libpng-dev"}
TESTS = {"libeigen3-dev", "libgtest-dev", "libgmock-dev", "libyaml-dev", "valgrind", "git", "hunspell-en-us"}
SYSTEM = ["awk", "bash", "cat", "cp", "cut", "date", "df", "dirname", "env", "flock", "grep", "gzip", "head", "id", "ls", "mkdir",
          "nproc", "python3", "realpath", "rm", "sed", "sh", "sha256sum", "sort", "tail", "tar", "tee", "tput", "uname", "wc"]
STAND_INS = {
    "dpkg-query": "exit 1",  # none of the packages is there
    "sudo": '[ "$1" != -n ] || shift\nexec "$@"',
    "apt-get": 'echo "$@" >>"$RECORD/apt-get"\ncase "$*" in *" install "*) cp "$RECORD"/tools/* "$RECORD/bin" ;; esac',
}
TOOLS = {
    "cmake": 'echo "$@" >>"$RECORD/cmake"; exit 1',  # ends the build
    "c++": "exit 1",  # has no header of any library
    "ninja": "exit 0", "mpiexec": "exit 0", "mpicxx": "exit 0",
}


def write(folder, scripts):
    folder.mkdir(exist_ok=True)
    for name, body in scripts.items():
        script = folder / name
        script.unlink(missing_ok=True)    # which may be a link to a command of the system
        script.write_text(f"#!/bin/sh\n{body}\n")
        script.chmod(0o755)


@pytest.fixture
def machine(tmp_path):
    """Runs ./sphd of a clone that was never built; returns (exit status, output, packages installed, options of CMake)."""
    write(tmp_path / "bin", STAND_INS)
    write(tmp_path / "tools", TOOLS)
    for name in SYSTEM:
        (tmp_path / "bin" / name).symlink_to(shutil.which(name))
    clone = tmp_path / "a clone"
    clone.mkdir()
    for name in ("sphd", "VERSION"):
        shutil.copy(ROOT / name, clone)
    for name in ("examples", "bench"):
        (clone / name).symlink_to(ROOT / name)

    def sphd(*args, **variables):
        environment = {name: value for name, value in os.environ.items()
                       if not name.startswith("SPHD_") and name != "LAMMPS_SOURCE_DIR"}
        environment.update(PATH=str(tmp_path / "bin"), RECORD=str(tmp_path), SPHD_CACHE=str(tmp_path / "cache"),
                           **variables)
        done = subprocess.run(["bash", str(clone / "sphd"), *args], env=environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=60)
        record = {name: (tmp_path / name).read_text() if (tmp_path / name).exists() else "" for name in ("apt-get", "cmake")}
        installed = set()
        for line in record["apt-get"].splitlines():
            if " install " in line:
                installed.update(word for word in line.split(" install ")[1].split() if not word.startswith("-"))
        return done.returncode, done.stdout, installed, record["cmake"]

    return sphd


@pytest.mark.parametrize("args, tests", [(["build"], False), (["run", "sound_pulse"], False), (["bench"], False),
                                         (["test"], True), (["test", "--all"], True), (["test", "--sanitize"], True)])
def test_only_the_tests_install_what_only_tests_need(machine, args, tests):
    status, output, installed, options = machine(*args)
    assert "configuring failed" in output and status == 1, output
    python = {name for name in installed if name.startswith("python3")}
    assert installed - python == (BUILD | TESTS if tests else BUILD)
    assert args != ["build"] or not python
    assert f"SPH_DISSIPATION_TESTS={'ON' if tests else 'OFF'}" in options
    assert ("SPHD_PYTHON" in options) == tests


@pytest.mark.parametrize("args, variables, message", [
    (["build", "release"], {}, "build takes no arguments"),
    (["doc", "--pdf"], {}, "doc takes no arguments"),
    (["--help", "run"], {}, "--help takes no arguments"),
    (["run"], {}, "There are: brownian cavity"),
    (["run", "nowhere"], {}, 'no example "nowhere"'),
    (["build", "--kokkos", "foo"], {}, 'the backends are openmp, serial, and cuda, not "foo"'),
    (["test", "--sanitize", "--valgrind"], {}, "leave one of them out"),
    (["test", "--all", "-R", "wall"], {}, "--all runs every test"),
    (["test", "--all", "--sanitize"], {}, "--all runs every test"),
    (["--version", "2"], {}, "--version takes no arguments"),
    (["report", "in.nowhere"], {}, 'report: no file "in.nowhere"'),
    (["build"], {"LAMMPS_SOURCE_DIR": "/tmp", "SPHD_LAMMPS": "25"}, "both set"),
    (["run", "sound_pulse"], {"SPHD_PYTHON": "/bin/false"}, "SPHD_PYTHON=/bin/false does not run or lacks one of"),
])
def test_wrong_use_is_an_error_before_anything_is_installed(machine, args, variables, message):
    status, output, installed, options = machine(*args, **variables)
    assert status == 1
    assert message in output
    assert not installed and not options


@pytest.mark.parametrize("args", [["run", "sound_pulse", "--nonsense"], ["run", "shock", "--np", "0"], ["run", "cavity", "--cases", "none"],
                                  ["bench", "nonsense"], ["bench", "--flows", "--nonsense"], ["bench", "--kokkos", "--scaling", "--gpu"],
                                  ["bench", "--repeat", "0"], ["run", "shock", "--no-run", "--out", "/dev/null"]])
def test_wrong_arguments_of_a_script(machine, args):
    """... are an error before anything is built."""
    status, output, _, options = machine(*args)
    assert status == 2 and re.search(r"^\S.*: error: ", output, re.MULTILINE) and "configuring" not in output and not options, output


@pytest.mark.parametrize("version, packages, more, source, message", [
    ("4 Jul 2026", "PLUGIN SPH", "", "", ""), ("22 Jul 2025 - Update 2", "PLUGIN KSPACE", "-DLAMMPS_BIGBIG\nFFT precision  = single", "/lammps", ""),
    ("4 Jul 2026", "SPH", "", "", "has not LAMMPS's package PLUGIN"), ("22 Jul 2025 - Update 2", "PLUGIN", "", "", "is LAMMPS 22 Jul 2025: name its source tree"),
    ("4 Jul 2026", "PLUGIN SPH-DISSIPATION", "", "", None)])
def test_plugin_for_an_installed_lammps(machine, tmp_path, version, packages, more, source, message):
    """... is built alone, in the way of that LAMMPS; nothing is built for one that has the package."""
    help = f"Large-scale Atomic/Molecular Massively Parallel Simulator - {version}\n{more}\nInstalled packages:\n\n{packages}\n\nList of"
    write(tmp_path / "bin", {"lmp": f"cat <<'TEXT'\n{help}\nTEXT"})
    write(tmp_path / "tools", {**TOOLS, "cmake": 'echo "$@" >>"$RECORD/cmake"; case "$*" in *ObtainLAMMPS*) echo /obtained ;; *) exit 1 ;; esac'})
    write(tmp_path / "bin", {"python": "exit 0"})
    variables = {"SPHD_LMP": "lmp", "SPHD_PYTHON": "python", "SPHD_MPIEXEC": "mpiexec", **({"LAMMPS_SOURCE_DIR": source} if source else {})}
    status, output, installed, options = machine("run", "sound_pulse", **variables)
    assert status == (message is not None) and (message or "") in output, output
    if message == "":
        assert "configuring failed" in output and "libopenmpi-dev" in installed and "libgtest-dev" not in installed
        assert "/plugin -B " in options and f"LAMMPS_SOURCE_DIR={source or '/obtained'}" in options
        assert [word in options for word in ("PKG_KSPACE=ON", "FFT_SINGLE=ON", "LAMMPS_SIZES=bigbig")] == [bool(source)] * 3
    else:
        assert not options and (not installed or message)


def test_modules_of_the_working_folder(machine, tmp_path, monkeypatch):
    """A file numpy.py there is no numpy."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "absent.py").touch()
    find = (ROOT / "sphd").read_text()
    code = re.search(r"^has_modules\(\) \{\n(.*?)^\}", find, re.MULTILINE | re.DOTALL)[0]
    for module, status in [("json", 0), ("absent", 1)]:
        assert subprocess.run(["bash", "-c", f"{code}\nhas_modules python3 {module}"], check=False).returncode == status


def test_lammps_is_obtained_once(tmp_path):
    """Two clones that build at once share the folder: the second waits for the first, and takes its tree."""
    folder = tmp_path / "lammps"
    folder.mkdir()
    with open(folder / "lock", "w") as lock:
        fcntl.lockf(lock, fcntl.LOCK_EX)
        cmake = subprocess.Popen(["cmake", "-D", "SPH_DISSIPATION_LAMMPS=26", "-D", f"SPH_DISSIPATION_CACHE={tmp_path}", "-P",
                                  str(ROOT / "cmake" / "ObtainLAMMPS.cmake")], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                 env={name: value for name, value in os.environ.items() if name != "LAMMPS_SOURCE_DIR"})
        assert "another build obtains it: waiting" in cmake.stdout.readline()
        (folder / "4Jul2026" / "src").mkdir(parents=True)
        (folder / "4Jul2026" / "src" / "version.h").touch()
    assert cmake.communicate(timeout=30)[0] == f"{folder / '4Jul2026'}\n"


def test_what_is_there_from_elsewhere_is_not_installed(machine, tmp_path):
    """Compiler, MPI and so on of modules or of an environment, no root and no sudo: what only saves time may be missing."""
    write(tmp_path / "bin", {**TOOLS, "c++": "exit 0", "id": "echo 65534"})
    (tmp_path / "bin" / "sudo").unlink()
    status, output, installed, options = machine("build")
    assert "configuring failed" in output and options and not installed
    assert "going on without what these packages bring: make ccache ca-certificates" in output


def test_compiler_and_mpi_of_other_names(machine, tmp_path):
    """The compiler is that of CXX, and has MPI in itself; srun starts programs."""
    tools = {name: body for name, body in TOOLS.items() if name not in ("c++", "mpicxx", "mpiexec")}
    write(tmp_path / "bin", {**tools, "CC": "exit 0", "srun": "exit 0", "id": "echo 65534"})
    (tmp_path / "bin" / "sudo").unlink()
    status, output, installed, options = machine("build", CXX="CC")
    assert "configuring failed" in output and options and not installed
    status, output, installed, options = machine("build", CXX="CC -pipe")
    assert "configuring failed" in output and not installed


def test_no_password_for_what_is_not_needed(machine, tmp_path):
    """sudo asks for a password: not where only what saves time is missing."""
    sudo = 'echo "asked: $*" >>"$RECORD/sudo"\n[ "$1" != -n ] || exit 1\nexec "$@"'
    write(tmp_path / "bin", {**TOOLS, "c++": "exit 0", "id": "echo 65534", "sudo": sudo})
    status, output, installed, options = machine("build")
    assert "going on without what these packages bring: make ccache ca-certificates" in output and options and not installed
    assert (tmp_path / "sudo").read_text() == "asked: -n true\n"
    (tmp_path / "bin" / "ninja").unlink()
    status, output, installed, options = machine("build")
    assert "ninja-build" in installed and "installing for building LAMMPS: make ninja-build ccache ca-certificates" in output


@pytest.mark.parametrize("missing, package", [("c++", "g++"), ("mpicxx", "libopenmpi-dev"), ("ninja", "ninja-build")])
def test_without_root_the_administrator_is_asked(machine, tmp_path, missing, package):
    write(tmp_path / "bin", {**TOOLS, "id": "echo 65534"})
    for name in ("sudo", missing):
        (tmp_path / "bin" / name).unlink()
    status, output, installed, options = machine("build")
    assert status == 1 and not installed and not options
    assert "ask the administrator for: apt-get install " in output and package in output.split("apt-get install ")[1].split()


def test_mpi_without_its_headers(machine, tmp_path):
    """openmpi-bin alone, which brings mpicxx"""
    write(tmp_path / "bin", {**TOOLS, "mpicxx": "exit 1"})
    status, output, installed, options = machine("build")
    assert "libopenmpi-dev" in installed and "openmpi-bin" not in installed and options


def test_more_packages_have_a_folder_of_their_own(machine, tmp_path):
    machine("build")
    folders = len(list((tmp_path / "cache" / "build").glob("*.lock")))
    status, output, installed, options = machine("build", SPHD_PACKAGES="KSPACE VTK")
    assert "SPH_DISSIPATION_PACKAGES=KSPACE;VTK" in options.splitlines()[-1]
    assert len(list((tmp_path / "cache" / "build").glob("*.lock"))) == folders + 1


def test_build_asks_for_python(machine, tmp_path):
    """... since LAMMPS does."""
    (tmp_path / "bin" / "python3").unlink()
    status, output, installed, options = machine("build")
    assert status == 1 and installed == BUILD | {"python3"} and "python3 not found" in output and not options


def test_install_nothing(machine, tmp_path):
    status, output, installed, options = machine("build", SPHD_INSTALL="0")
    assert status == 1 and "c++ not found" in output and not installed
    write(tmp_path / "bin", {name: body for name, body in TOOLS.items() if name != "mpicxx"})
    status, output, installed, options = machine("build", SPHD_INSTALL="0")
    assert status == 1 and "no MPI: neither mpicxx nor c++ finds mpi.h" in output and not options
    write(tmp_path / "bin", TOOLS)
    status, output, installed, options = machine("build", SPHD_INSTALL="0")
    assert "configuring failed" in output and options and not installed


def test_lock_of_the_package_lists(machine, tmp_path):
    """Packages are not known yet, and somebody else is fetching their lists."""
    write(tmp_path / "bin", {"sleep": "exit 0", "apt-get": """echo "$@" >>"$RECORD/apt-get"
case "$*" in
*update*) if [ ! -e "$RECORD/free" ]; then
  : >"$RECORD/free"
  echo "E: Could not get lock /var/lib/apt/lists/lock. It is held by process 17 (apt-get)" >&2
  exit 100
fi
: >"$RECORD/lists" ;;
*install*) [ -e "$RECORD/lists" ] || exit 100
cp "$RECORD"/tools/* "$RECORD/bin" ;;
esac"""})
    status, output, installed, options = machine("build")
    assert "waiting: Could not get lock /var/lib/apt/lists/lock. It is held by process 17" in output
    assert "configuring failed" in output and options and installed == BUILD


def test_lock_of_the_packages(machine, tmp_path):
    """Somebody else is installing."""
    write(tmp_path / "bin", {"sleep": "exit 0", "apt-get": """echo "$@" >>"$RECORD/apt-get"
[ -e "$RECORD/free" ] || { : >"$RECORD/free"
echo "E: Could not get lock /var/lib/dpkg/lock-frontend. It is held by process 17 (apt-get)
N: Be aware that removing the lock file is not a solution and may break your system.
E: Unable to acquire the dpkg frontend lock (/var/lib/dpkg/lock-frontend), is another process using it?" >&2
exit 100; }
cp "$RECORD"/tools/* "$RECORD"/bin"""})
    status, output, installed, options = machine("build")
    assert output.count("waiting: Could not get lock /var/lib/dpkg/lock-frontend. It is held by process 17") == 1
    assert "configuring failed" in output and options and installed == BUILD
    assert "update" not in (tmp_path / "apt-get").read_text()


def test_apt_fails(machine, tmp_path):
    """... for good, which matters for what is needed."""
    write(tmp_path / "bin", {"apt-get": "echo no network; exit 100"})
    status, output, _, options = machine("build")
    assert status == 1 and "no network" in output and "apt-get could not install g++" in output and not options
    write(tmp_path / "bin", TOOLS)
    status, output, _, options = machine("build")
    assert "going on without" in output and "configuring failed" in output and options


def test_help_of_an_example(machine):
    """... is there before anything is built."""
    status, output, installed, options = machine("run", "sound_pulse", "--help")
    assert status == 0 and output.startswith("usage: ./sphd run sound_pulse ") and not installed and not options


@pytest.mark.parametrize("command", ["run", "test", "doc", "build"])
def test_help(machine, command):
    status, output, installed, _ = machine(command, "--help")
    assert status == 0 and output.startswith("./sphd run EXAMPLE") and not installed


@pytest.mark.parametrize("precision, there", [("double", True), ("DOUBLE", True), ("", True), ("mixed", False), ("SINGLE", False)])
def test_precision_of_kokkos(tmp_path, precision, there):
    """The hook into LAMMPS's build adds the /kk styles for double precision, which LAMMPS takes in any case."""
    for name, text in {"cmake/Modules/StyleHeaderUtils.cmake": 'function(RegisterStyles folder)\nmessage(STATUS "styles of ${folder}")\nendfunction()\n',
                       "src/version.h": '#define LAMMPS_VERSION "4 Jul 2026"\n',
                       "cmake/CMakeLists.txt": f'cmake_minimum_required(VERSION 3.20)\nproject(lammps NONE)\ninclude("{ROOT}/cmake/SPH-DISSIPATION.cmake")\n'}.items():
        file = tmp_path / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    done = subprocess.run(["cmake", "-S", str(tmp_path / "cmake"), "-B", str(tmp_path / "build"), "-D", "PKG_SPH-DISSIPATION=on",
                           "-D", "PKG_KOKKOS=on", "-D", f"KOKKOS_PREC={precision}"],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)    # there is nothing to build
    assert f"styles of {ROOT}/src/SPH-DISSIPATION" in done.stdout, done.stdout
    assert (f"styles of {ROOT}/src/KOKKOS" in done.stdout) == there and ("KOKKOS_PREC=double" in done.stdout) != there, done.stdout


def test_report(machine, tmp_path, monkeypatch):
    """Versions, the logs of ./sphd and of LAMMPS, and the files named, two of one name included; what is large stays out."""
    (tmp_path / "a").mkdir()
    monkeypatch.chdir(tmp_path)
    (tmp_path / "log.lammps").write_text("Loop time\n")
    (tmp_path / "in.flow").write_text("units lj\n")
    (tmp_path / "a" / "in.flow").write_text("units si\n")
    (tmp_path / "large.data").write_bytes(bytes(10_000_001))
    machine("build")    # leaves build/sphd.log
    build = tmp_path / "a clone" / "build"
    write(build, {"lmp": "echo 'Large-scale Simulator - 4 Jul 2026'; echo 'Usage example'; echo 'OS: Linux'; echo 'List of individual style'"})
    status, output, _, _ = machine("report", "in.flow", "a/in.flow", "large.data", OMP_NUM_THREADS="3")
    assert status == 0, output
    with tarfile.open(build / "report.tar.gz") as archive:
        files = {Path(name).name: archive.extractfile(name).read().decode() for name in archive.getnames() if name != "report"}
    assert sorted(files) == ["2.in.flow", "in.flow", "log.lammps", "sphd.log", "versions.txt"]
    assert files["in.flow"] == "units lj\n" and files["2.in.flow"] == "units si\n"
    assert "SPH-DISSIPATION " + (ROOT / "VERSION").read_text() in files["versions.txt"].replace(", commit unknown", "")
    for line in ("OMP_NUM_THREADS=3", "Large-scale Simulator - 4 Jul 2026", "OS: Linux"):
        assert f"{line}\n" in files["versions.txt"]
    assert "Usage" not in files["versions.txt"] and "List" not in files["versions.txt"]
    assert "large.data has more than 10 MB" in output
    for name in files:
        assert re.search(rf"^ *\d+ {re.escape(name)}$", output, re.MULTILINE), output
