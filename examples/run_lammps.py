# SPDX-License-Identifier: GPL-2.0-only
"""What the run.py of an example needs to run LAMMPS: several inputs at a time on the cores there are. What it prints is kept in
results.txt; a copy beside the README is what the numbers of the README are compared with."""

import argparse
import csv
import fcntl
import os
import shlex
import shutil
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import FIRST_COMPLETED, CancelledError, ThreadPoolExecutor, wait
from contextlib import contextmanager
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python"))
from sph_dissipation import averages, exponents, fluids, frames, progress, pyplot, read_array, read_grid, save, series, thermo      # noqa: E402, F401

TABLE = Path(__file__).with_name("examples.csv")    # what each example shows, takes, and has for a picture
PATIENCE = 30      # seconds without a word, at most
SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]


def table():
    """Rows of the table of all examples: {name: {column: text}}."""
    with open(TABLE, newline="", encoding="utf-8") as file:
        return {row["example"]: row for row in csv.DictReader(file)}


@contextmanager
def csv_rows(path, header):
    """Writes a table; gives the function that takes each row."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        write = csv.writer(file, lineterminator="\n").writerow
        write(header)
        yield write


class Kept:
    """Standard output that goes to a file as well, which is locked."""

    def __init__(self, path):
        self.file = open(path, "a", encoding="utf-8", buffering=1)
        try:
            fcntl.flock(self.file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise SystemExit(f"another run writes into {path.parent}: wait for it, or name another folder by --out") from None
        except OSError:
            pass    # a file system without locks
        self.file.truncate(0)

    def write(self, text):
        sys.__stdout__.write(text)
        self.file.write(text)

    def flush(self):
        sys.__stdout__.flush()


def processor_time():
    """of this process and of what it has started; under ./sphd run also of the build, which this process was before"""
    return sum(os.times()[:4])


def tell(text):
    """For the screen alone: paths and times of this machine."""
    print(text, file=sys.__stdout__, flush=True)


class Example:
    """An example in a folder: its command line, its runs of LAMMPS and its figures of merit."""

    def __init__(self, folder, description):
        self.folder, self.name = folder, folder.name
        self.begin, self.spent = time.monotonic(), processor_time()
        self.missed = []
        self.processes, self.ended, self.lock = set(), False, threading.Lock()
        self.parser = argparse.ArgumentParser(prog=f"./sphd run {self.name}" if Path(sys.argv[0]).stem == "run" else None,
                                              description=description)
        self.parser.add_argument("--quick", action="store_true", help="a small version, for tests")
        self.parser.add_argument("--np", type=int, default=1, metavar="N", help="MPI ranks per run (1)")
        self.parser.add_argument("--switches", type=shlex.split, default=[], metavar="WORDS",
                                 help='more switches of LAMMPS, in one word, for instance "-k on g 1 -sf kk"')
        self.parser.add_argument("--out", type=Path, default=folder / "results", metavar="DIR",
                                 help="folder for results (%(default)s)")
        self.parser.add_argument("--no-run", action="store_true", help="tables and figures of what an earlier run has left in --out")
        self.parser.add_argument("--check", action="store_true", help="exit with 1 if a figure of merit is missed")

    def arguments(self):
        """With SPHD_PARSE_ONLY, nothing but a look at the arguments, before LAMMPS is built."""
        self.args = self.parser.parse_args()
        parse_only = bool(os.environ.get("SPHD_PARSE_ONLY"))
        if self.args.np < 1:
            self.parser.error("--np must be at least 1")
        self.mpi = shlex.split(os.environ.get("SPHD_MPIEXEC", "")) or ([] if parse_only else ["mpiexec"])
        if self.args.np > 1 and self.mpi and not shutil.which(self.mpi[0]):
            self.parser.error(f"no {self.mpi[0]}, which starts MPI programs; name one by SPHD_MPIEXEC")
        self.out = self.args.out.resolve()
        if self.out.exists() and not self.out.is_dir():
            self.parser.error(f"--out: {self.out} is not a folder")
        if self.args.no_run and not any(self.out.glob("*.log")):
            self.parser.error(f"--no-run: no results in {self.out}; run the example without it")
        if parse_only:
            sys.exit()
        path = os.environ.get("SPHD_LMP") or str(self.folder.parent.parent / "build" / "lmp")
        self.lmp = shutil.which(path)
        if not self.lmp and not self.args.no_run:
            raise SystemExit(f"{self.name}: no LAMMPS executable {path}; set SPHD_LMP or run ./sphd run {self.name}")
        script = Path(sys.argv[0]).stem
        try:
            self.out.mkdir(parents=True, exist_ok=True)
            self.kept = Kept(self.out / ("results.txt" if script == "run" else f"results_{script}.txt"))
        except OSError as error:
            self.parser.error(f"--out: {error}")
        row = table().get(self.name, {})
        if script == "run" and not self.args.quick and row.get("processor time"):
            tell(f"{self.name}: processor time of all runs: {row['processor time']}")
        sys.stdout = self.kept
        return self.args

    def run(self, jobs, inputs=None):
        """jobs: {name: variables of in.<example>}, the longest first; output files begin with the name.
        inputs: {name: path} of those that have an input of their own
        """
        if self.args.no_run:
            missing = [name for name in jobs if not (self.out / f"{name}.log").exists()]
            if missing:
                raise SystemExit(f"{self.name}: no results of {missing[0]} in {self.out}; run the example without --no-run")
            return
        cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
        ranks = self.args.np
        workers = max(1, min(len(jobs), cores // ranks))
        tell(f"{len(jobs)} runs of {self.lmp} on {ranks} MPI rank(s) each, {workers} at a time")
        report, self.ended = Report(self.out, len(jobs), workers), False
        with self._signals(), ThreadPoolExecutor(workers) as pool:
            try:
                waiting = {pool.submit(self._run, os.path.abspath(self.lmp), name, variables, ranks, cores, (inputs or {}).get(name), report)
                           for name, variables in jobs.items()}
                while waiting:
                    finished, waiting = wait(waiting, PATIENCE, FIRST_COMPLETED)
                    for name, seconds in sorted((job.result() for job in finished), key=lambda one: list(jobs).index(one[0])):
                        report.done(name, seconds)
                    if not finished:
                        report.running()
            finally:
                self._end()

    @contextmanager
    def _signals(self):
        """A signal that ends this program ends its runs of LAMMPS, too."""
        def stop(number, _):
            for one in before:
                signal.signal(one, signal.SIG_DFL)    # the next one at once
            tell(f"{self.name}: {signal.Signals(number).name} ends all runs")
            raise SystemExit(128 + number)

        before = {number: signal.getsignal(number) for number in SIGNALS}
        before = {number: handler for number, handler in before.items() if handler != signal.SIG_IGN}    # nohup
        for number in before:
            signal.signal(number, stop)
        try:
            yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)

    def _end(self):
        """No run starts from now on, and those under way end."""
        with self.lock:
            self.ended = True
        processes = list(self.processes)
        for process in processes:
            process.terminate()
        for process in processes:
            try:
                process.wait(5)
            except subprocess.TimeoutExpired:
                process.kill()

    def _run(self, lmp, name, variables, ranks, cores, path, report):
        """Name and seconds of a run that has ended well."""
        begin = report.began[name] = time.monotonic()
        mpi = [*self.mpi, "-n", str(ranks)] if ranks > 1 else []
        words = [word for key, value in {**variables, "out": name}.items() for word in ("-var", key, str(value))]
        command = [*mpi, lmp, "-in", str(path or self.folder / f"in.{self.name}"), "-screen", "none",
                   "-log", f"{name}.log", *self.args.switches, *words]
        # LAMMPS writes its error messages to the log as well; a launcher has only stderr. The process holds the lock of the folder, too.
        with self.lock:
            if self.ended:
                raise CancelledError
            process = subprocess.Popen(command, env=environment(ranks, cores), text=True, cwd=self.out, stdin=subprocess.DEVNULL,
                                       stdout=subprocess.PIPE, stderr=subprocess.STDOUT, pass_fds=[self.kept.file.fileno()])
            self.processes.add(process)
        output = process.communicate()[0]
        self.processes.discard(process)
        if process.returncode != 0:
            log = self.out / f"{name}.log"
            tail = log.read_text(errors="replace").splitlines()[-15:] if log.exists() else []
            raise SystemExit("\n".join([f"{self.name}: LAMMPS failed ({process.returncode}) for {name}:", output.strip(), *tail]))
        return name, time.monotonic() - begin

    def merit(self, what, value, lower, upper):
        """One figure of merit: printed, and missed if outside of the range."""
        ok = lower <= value <= upper
        line = f"{what}: {value:.4g}, wanted {lower:.4g} to {upper:.4g}"
        print(line + ("  ok" if ok else "  MISSED"))
        if not ok:
            self.missed.append(line)

    def finish(self, *paths):
        for path in paths:
            tell(f"wrote {path}")
        tell(f"{self.name}: {time.monotonic() - self.begin:.1f} s, {processor_time() - self.spent:.1f} s of processor time")
        if self.missed:
            print("\n  ".join(["missed:", *self.missed]))
        elif self.args.check:
            print("all figures of merit reached")
        return 1 if self.args.check and self.missed else 0


class Report:
    """What the screen says of runs under way: which has ended, how many of how many, and how long the others take."""

    def __init__(self, out, count, workers):
        self.out, self.count, self.workers = out, count, workers
        self.began, self.seconds, self.seen, self.told = {}, [], {}, 0.0

    def done(self, name, seconds):
        """The longest runs come first: what those that have ended took is the most that the others take."""
        self.began.pop(name)
        self.seconds.append(seconds)
        left = self.count - len(self.seconds)
        if left and time.monotonic() - self.told < 1:
            return      # hundreds of short runs
        self.told = time.monotonic()
        mean = sum(self.seconds) / len(self.seconds)
        tell(f"[{len(self.seconds)}/{self.count}] {name}: {duration(seconds)}" + (f", at most {duration(mean * left / self.workers)} left" if left else ""))

    def running(self):
        """Steps of the runs under way, and how long each takes at its speed since the last time."""
        for name, begin in list(self.began.items()):
            now, log = time.monotonic(), self.out / f"{name}.log"
            step, last = progress(log.read_text(errors="replace")) if log.exists() else (None, None)
            before, self.seen[name] = self.seen.get(name), (step, last, now)
            line = f"[{len(self.seconds)}/{self.count}] {name}: runs for {duration(now - begin)}"
            if step is not None and step < last:
                line += f", step {step} of {last}"
                if before and before[1] == last and before[0] < step:
                    line += f", {duration((last - step) * (now - before[2]) / (step - before[0]))} left"
            tell(line)


def duration(seconds):
    return f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.0f} min"


def environment(ranks, cores):
    """What makes short runs get along with each other on the same cores (Open MPI; root as in a container)."""
    env = dict(os.environ, OMP_NUM_THREADS="1")
    if ranks > 1:
        env.setdefault("OMPI_MCA_rmaps_base_oversubscribe", "1")
        env.setdefault("OMPI_MCA_hwloc_base_binding_policy", "none")
        env.setdefault("PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe")
        if hasattr(os, "geteuid") and os.geteuid() == 0:
            env["OMPI_ALLOW_RUN_AS_ROOT"] = env["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] = "1"
    if ranks > cores:
        # a rank that waits without yielding keeps the rank it waits for from running
        env.setdefault("OMPI_MCA_mpi_yield_when_idle", "1")
    return env
