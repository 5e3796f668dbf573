"""What ./sphd installs and configures on a machine that has nothing: apt-get, dpkg-query, and CMake are stand-ins here."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BUILD = {"g++", "make", "cmake", "ninja-build", "ccache", "ca-certificates", "openmpi-bin", "libopenmpi-dev",
         "libfftw3-dev"}
TESTS = {"libeigen3-dev", "libgtest-dev", "libgmock-dev", "libyaml-dev", "valgrind", "git", "hunspell-en-us"}
STAND_INS = {
    "dpkg-query": "exit 1",  # none of the packages is there
    "sudo": 'exec "$@"',
    "apt-get": 'echo "$@" >>"$RECORD/apt-get"',
    "cmake": 'echo "$@" >>"$RECORD/cmake"; exit 1',  # ends the build
    "c++": "exit 0", "ninja": "exit 0", "mpiexec": "exit 0",
}


@pytest.fixture
def machine(tmp_path):
    """Runs ./sphd of a clone that was never built; returns (exit status, output, packages installed, options of CMake)."""
    for name, body in STAND_INS.items():
        script = tmp_path / "bin" / name
        script.parent.mkdir(exist_ok=True)
        script.write_text(f"#!/bin/sh\n{body}\n")
        script.chmod(0o755)
    clone = tmp_path / "a clone"
    clone.mkdir()
    shutil.copy(ROOT / "sphd", clone)
    (clone / "examples").symlink_to(ROOT / "examples")

    def sphd(*args, **variables):
        environment = {name: value for name, value in os.environ.items()
                       if not name.startswith("SPHD_") and name != "LAMMPS_SOURCE_DIR"}
        environment.update(PATH=f"{tmp_path / 'bin'}:/usr/bin:/bin", RECORD=str(tmp_path), SPHD_CACHE=str(tmp_path / "cache"),
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
    (["test", "--sanitize", "--valgrind"], {}, "leave one of them out"),
    (["test", "--all", "-R", "wall"], {}, "--all runs every test"),
    (["test", "--all", "--sanitize"], {}, "--all runs every test"),
    (["build"], {"LAMMPS_SOURCE_DIR": "/tmp", "SPHD_LAMMPS": "25"}, "both set"),
    (["run", "sound_pulse"], {"SPHD_PYTHON": "/bin/false"}, "SPHD_PYTHON=/bin/false does not run or lacks one of"),
])
def test_wrong_use_is_an_error_before_anything_is_installed(machine, args, variables, message):
    status, output, installed, options = machine(*args, **variables)
    assert status == 1
    assert message in output
    assert not installed and not options


@pytest.mark.parametrize("command", ["run", "test", "doc", "build"])
def test_help(machine, command):
    status, output, installed, _ = machine(command, "--help")
    assert status == 0 and output.startswith("./sphd run EXAMPLE") and not installed
