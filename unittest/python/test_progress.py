"""What ./sphd run says of the runs of an example while they go on, what ends them, and what it says of wrong arguments."""

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

import run_lammps

ROOT = Path(__file__).resolve().parents[2]

LOG = """variable steps index 300
run 0
Per MPI rank memory allocation (min/avg/max) = 4.2 | 4.2 | 4.2 Mbytes
   Step          Time     v_x
         0   0              1
Loop time of 1e-06 on 1 procs for 0 steps with 10 atoms
run ${steps}
run 300
Per MPI rank memory allocation (min/avg/max) = 4.2 | 4.2 | 4.2 Mbytes
   Step          Time     v_x
       100   1.0            1
WARNING: Something in between (src/thermo.cpp:1)
       150   1.5           -2
"""
LMP = """#!/bin/sh
while [ "$1" != -log ]; do shift; done
printf '%s\\n' "run 10" "   Step  Time" " 0 0.0" " 4 0.4" > "$2"
case $2 in slow*) sleep 1.2 ;; bad*) echo "ERROR: on purpose"; exit 1 ;; esac
"""


def test_steps_of_a_log():
    assert run_lammps.progress(LOG) == (150, 400)
    assert run_lammps.progress(LOG.replace("run 300", "run 300 upto")) == (150, 300)
    assert run_lammps.progress("LAMMPS (4 Jul 2026)\nrun 300\n") == run_lammps.progress("") == (None, None)
    finished = LOG[:LOG.index("run ${steps}")]
    assert run_lammps.progress(finished) == (0, 0)


def example(tmp_path, monkeypatch, name, *arguments):
    (tmp_path / "lmp").write_text(LMP)
    (tmp_path / "lmp").chmod(0o755)
    monkeypatch.setenv("SPHD_LMP", str(tmp_path / "lmp"))
    monkeypatch.setattr(sys, "argv", ["run.py", "--out", str(tmp_path / "results"), *arguments])
    monkeypatch.setattr(run_lammps, "PATIENCE", 0.4)
    monkeypatch.setattr(run_lammps.os, "sched_getaffinity", lambda _: {0})
    folder = tmp_path / name
    folder.mkdir()
    found = run_lammps.Example(folder, "An example.")
    found.arguments()
    sys.stdout = sys.__stdout__
    return found


def test_each_run_is_named(tmp_path, monkeypatch, capfd):
    found = example(tmp_path, monkeypatch, "spin_relaxation")
    found.run({"slow": {}, "fast": {}})
    found.finish()
    text = capfd.readouterr().out
    assert f"spin_relaxation: processor time of all runs: {run_lammps.table()['spin_relaxation']['processor time']}" in text
    assert "2 runs of" in text and "1 at a time" in text
    assert re.search(r"^\[0/2\] slow: runs for \d s, step 4 of 10$", text, re.MULTILINE)
    assert re.search(r"^\[1/2\] slow: 1 s, at most 1 s left$", text, re.MULTILINE)
    assert re.search(r"^\[2/2\] fast: 0 s$", text, re.MULTILINE)
    assert re.search(r"^spin_relaxation: \d\.\d s, \d+\.\d s of processor time$", text, re.MULTILINE)


def test_a_run_that_fails_ends_the_others(tmp_path, monkeypatch, capfd):
    found = example(tmp_path, monkeypatch, "spin_relaxation", "--quick")
    try:
        found.run({"bad": {}, "slow": {}, "slower": {}})
    except SystemExit as stop:
        assert "LAMMPS failed (1) for bad" in str(stop) and "ERROR: on purpose" in str(stop)
    else:
        raise AssertionError("nothing was wrong")
    assert not (tmp_path / "results" / "slower.log").exists()
    assert "processor time of all" not in capfd.readouterr().out


def test_figures_of_an_earlier_run(tmp_path, monkeypatch):
    (tmp_path / "results").mkdir()
    (tmp_path / "results" / "bad.log").touch()
    found = example(tmp_path, monkeypatch, "spin_relaxation", "--no-run")
    found.run({"bad": {}})
    with pytest.raises(SystemExit, match="no results of other in"):
        found.run({"bad": {}, "other": {}})


def test_an_error_ends_the_other_runs(tmp_path, monkeypatch):
    """... at once: they may take hours."""
    found = example(tmp_path, monkeypatch, "spin_relaxation", "--quick")
    monkeypatch.setattr(run_lammps.os, "sched_getaffinity", lambda _: {0, 1})
    (tmp_path / "lmp").write_text(LMP.replace("sleep 1.2", "exec sleep 60").replace("bad*) ", "bad*) sleep 0.5; "))
    begin = time.monotonic()
    with pytest.raises(SystemExit, match="LAMMPS failed \\(1\\) for bad"):
        found.run({"slow": {}, "bad": {}})
    assert time.monotonic() - begin < 20


def test_processor_time_of_the_example(tmp_path):
    """./sphd run is one process with its build, whose processor time is not that of the example."""
    (tmp_path / "run.py").write_text(SCRIPT.format(folder=str(ROOT / "examples"), here=str(tmp_path)).rpartition("example.run")[0] + "example.finish()\n")
    build = f"{sys.executable} -c 'import time\nwhile time.process_time() < 1.5: pass'"
    done = subprocess.run(["bash", "-c", f"{build}; exec {sys.executable} {tmp_path / 'run.py'}"], stdout=subprocess.PIPE, text=True, check=True,
                          env={**os.environ, "SPHD_LMP": sys.executable})
    assert float(re.search(r", (\S+) s of processor time$", done.stdout, re.MULTILINE)[1]) < 0.5, done.stdout


SCRIPT = """import sys
sys.path.insert(0, {folder!r})
import run_lammps
from pathlib import Path
example = run_lammps.Example(Path({here!r}), "An example.")
example.arguments()
example.run({{"slow": {{}}, "slow2": {{}}}})
"""


@pytest.fixture
def script(tmp_path):
    """Starts a run.py whose LAMMPS sleeps for a minute, and writes its process id."""
    (tmp_path / "run.py").write_text(SCRIPT.format(folder=str(ROOT / "examples"), here=str(tmp_path)))
    (tmp_path / "lmp").write_text("#!/bin/sh\necho $$ >>pids\nexec sleep 60\n")
    (tmp_path / "lmp").chmod(0o755)

    def start(*arguments, **variables):
        return subprocess.Popen([sys.executable, str(tmp_path / "run.py"), *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                env={**os.environ, "SPHD_LMP": str(tmp_path / "lmp"), **variables})

    return start


def running(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def ids(folder):
    """of the sleeping processes, once there is one"""
    for _ in range(300):
        if (folder / "pids").exists() and (folder / "pids").read_text().endswith("\n"):
            break
        time.sleep(0.1)
    return [int(word) for word in (folder / "pids").read_text().split()]


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP])
def test_signals(tmp_path, script, number):
    """What ends run.py ends its LAMMPS."""
    process = script()
    ids(tmp_path / "results")
    process.send_signal(number)
    output = process.communicate(timeout=30)[0]
    assert process.returncode == 128 + number and f"{number.name} ends all runs" in output and "Traceback" not in output, output
    assert not any(running(pid) for pid in ids(tmp_path / "results"))


def test_one_run_per_folder(tmp_path, script):
    """A folder is locked as long as a run or its LAMMPS writes into it; what the first one has written stays."""
    first = script()
    pids = ids(tmp_path / "results")
    kept = tmp_path / "results" / "results.txt"
    kept.write_text("a table\n")
    second = script()
    output = second.communicate(timeout=30)[0]
    assert second.returncode == 1 and output == f"another run writes into {kept.parent}: wait for it, or name another folder by --out\n"
    first.kill()
    first.communicate(timeout=30)
    third = script()
    assert "another run writes into" in third.communicate(timeout=30)[0] and kept.read_text() == "a table\n"
    pids = ids(tmp_path / "results")
    for pid in pids:
        os.kill(pid, signal.SIGKILL)
    time.sleep(0.3)
    (tmp_path / "results" / "pids").unlink()
    fourth = script()
    ids(tmp_path / "results")
    fourth.terminate()
    assert "SIGTERM ends all runs" in fourth.communicate(timeout=30)[0]


def test_wrong_arguments(tmp_path, script):
    """One line, at once."""
    (tmp_path / "empty").mkdir()
    (tmp_path / "file").touch()
    for arguments, variables, message in [(["--no-run", "--out", str(tmp_path / "empty")], {}, "--no-run: no results in"),
                                          (["--no-run", "--out", str(tmp_path / "none")], {}, "--no-run: no results in"),
                                          (["--out", str(tmp_path / "file")], {}, "is not a folder"),
                                          (["--out", str(tmp_path / "file" / "below")], {}, "--out: "),
                                          (["--np", "2"], {"SPHD_MPIEXEC": "no-such"}, "no no-such, which starts MPI programs"),
                                          ([], {"SPHD_LMP": "no-such"}, "no LAMMPS executable no-such")]:
        process = script(*arguments, **variables)
        output = process.communicate(timeout=30)[0]
        assert process.returncode in (1, 2) and message in output.splitlines()[-1] and "Traceback" not in output, output
    assert not (tmp_path / "none").exists() and not list((tmp_path / "empty").iterdir())
