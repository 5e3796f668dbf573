"""What ./sphd run says of the runs of an example while they go on."""

import re
import sys

import run_lammps

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
    found = example(tmp_path, monkeypatch, "spin_relaxation", "--no-run")
    found.run({"bad": {}})
