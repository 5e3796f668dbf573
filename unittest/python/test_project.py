"""What stands around the code: papers that a run names, version, citation file, forms for reports, workflow."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from helpers import LMP, MPI_ENVIRONMENT, MPIEXEC, SINGLE_RANK, thermo

ROOT = Path(__file__).resolve().parents[2]
VERSION = (ROOT / "VERSION").read_text().strip()
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
PAGE = (ROOT / "doc" / "src" / "Howto_sph_citing.rst").read_text(encoding="utf-8")
LITERAL = r'"((?:[^"\\]|\\.)*)"'

# -- papers ------------------------------------------------------------------------------------------------------


def entries():
    """{key: text} of the citations in the sources"""
    found = {}
    for file in sorted((ROOT / "src" / "SPH-DISSIPATION").glob("*.cpp")):
        for literals in re.findall(rf"^static const char cite_\w+\[\] =\s*((?:{LITERAL}\s*)+);", file.read_text(), re.MULTILINE):
            text = "".join(re.findall(LITERAL, literals[0])).replace(r"\n", "\n").replace(r"\\", "\\")
            found[re.search(r"^@Article{(\w+),$", text, re.MULTILINE)[1]] = text
    return found


ENTRIES = entries()

BULK = {"BonetAvalos2020"}


def tutorial(step, pair="", fix=""):
    """An input of the tutorial as two short runs, with more keywords of its pair style and fix."""
    text = (ROOT / "examples" / "tutorial" / f"in.{step}").read_text()
    text = re.sub(r"^(pair_style +sph/bulk)$", rf"\1 {pair}", text, flags=re.MULTILINE)
    text = text.replace("sph/bulk density rho0", f"sph/bulk density rho0 {fix}")
    return re.sub(r"^run .*", "run 3\nrun 2", text, flags=re.MULTILINE)


CASES = {
    "bulk": (tutorial(1), BULK),
    "no bulk term": (tutorial(1, pair="bulk none"), set()),
    "noise": (tutorial(1, pair="temp 1e-4 8"), BULK | {"Espanol2003"}),
    "espanol": (tutorial(1, pair="shear espanol"), BULK | {"Espanol2003"}),
    "shift": (tutorial(1, fix="shift 1.0"), BULK | {"Sun2017"}),
    "rkl2": (tutorial(1, fix="viscous rkl2"), BULK | {"Meyer2014"}),
    "implicit": (tutorial(1, fix="viscous implicit shift 0"), BULK),
    "walls": (tutorial(4), BULK | {"Adami2012"}),
    "spin": (tutorial(6), BULK | {"SoutoIglesias2021", "Adami2012"}),
    "open": (tutorial(7), BULK | {"Lastiwka2009", "Adami2012"}),
}


def run(folder, commands, *switches, ranks=1):
    """screen and log"""
    (folder / "in").write_text(commands)
    command = [LMP, "-in", "in", *switches]
    environment = {**os.environ, **MPI_ENVIRONMENT, **({} if ranks > 1 else SINGLE_RANK)}
    if ranks > 1:
        command = [MPIEXEC, "-n", str(ranks), *command]
    done = subprocess.run(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, timeout=120)
    assert done.returncode == 0, done.stdout
    return done.stdout, (folder / "log.lammps").read_text()


@pytest.mark.parametrize("name", CASES)
def test_run_names_its_papers(tmp_path, name):
    """Once, by one rank of two, although the input has two runs: one line on the screen, the entry in the log; results are as without."""
    commands, wanted = CASES[name]
    screen, log = run(tmp_path, commands, ranks=2)
    for key, entry in ENTRIES.items():
        assert log.count(entry) == (key in wanted), key
        assert screen.count(entry.partition("\n")[0]) == (key in wanted), key
        assert f"@Article{{{key}" not in screen
    _, without = run(tmp_path, commands, "-nocite", ranks=2)
    assert "@Article" not in without
    numbers = [[{key: list(column) for key, column in one.items() if key != "CPU"} for one in thermo(one)] for one in (log, without)]
    assert numbers[0] == numbers[1] and len(numbers[0]) == 2


def test_restart_names_papers(tmp_path):
    """The pair style comes from the file."""
    run(tmp_path, CASES["noise"][0] + "write_restart flow.restart\n", "-nocite")
    _, log = run(tmp_path, "read_restart flow.restart\nfix 1 all sph/bulk\ntimestep 0.001\nrun 1\n")
    assert [key for key, entry in ENTRIES.items() if log.count(entry) == 1] == ["BonetAvalos2020", "Espanol2003"]


def test_each_paper_is_on_the_page_and_in_the_citation_file():
    wanted = set.union(*(keys for _, keys in CASES.values()))
    assert set(ENTRIES) == wanted
    blocks = {re.search(r"@\w+{(\w+),", block)[1]: re.sub(r"^   ", "", block, flags=re.MULTILINE).strip()
              for block in re.findall(r"^\.\. code-block:: bibtex\n\n((?:   .*\n)+)", PAGE, re.MULTILINE)}
    assert set(blocks) == {*ENTRIES, "SPHDissipation", "Thompson2022"}
    listed = {reference["doi"]: reference for reference in CITATION["references"]}
    for key, entry in ENTRIES.items():
        head, _, bibtex = entry.partition("\n\n")
        assert blocks[key] == bibtex.strip()
        doi = re.search(r"doi = +{(.*)}", bibtex)[1]
        assert head.endswith(f": https://doi.org/{doi}") and entry.endswith("}\n\n")
        assert listed[doi]["year"] == int(re.search(r"year = +(\d+)", bibtex)[1])
        assert str(listed[doi]["volume"]) == re.search(r"volume = +(\d+)", bibtex)[1]
        pages = [str(listed[doi][word]) for word in ("start", "end") if word in listed[doi]]
        assert "--".join(pages) == re.search(r"pages = +{(.*)}", bibtex)[1]
        names = [author["family-names"] for author in listed[doi]["authors"]]
        assert len(names) == bibtex.count(" and ") - bibtex.partition("title")[2].count(" and ") + 1
    assert set(listed) == {re.search(r"doi = +{(.*)}", block)[1] for key, block in blocks.items() if key != "SPHDissipation"}
    for block in blocks.values():
        assert block.count("{") == block.count("}")


# -- version -----------------------------------------------------------------------------------------------------


def test_version():
    """VERSION is the only source. A release has a date and a section of its own among the changes."""
    assert re.fullmatch(r"\d+\.\d+\.\d+(-dev)?", VERSION)
    assert CITATION["version"] == VERSION and f"version = {{{VERSION}}}" in PAGE
    changes = re.findall(r"^## (.*)", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    if VERSION.endswith("-dev"):
        assert "date-released" not in CITATION and changes[0] == "Unreleased"
    else:
        assert changes[0] == f"{VERSION} ({CITATION['date-released']})"
    done = subprocess.run(["bash", str(ROOT / "sphd"), "--version"], stdout=subprocess.PIPE, text=True, check=True)
    assert done.stdout.startswith(f"SPH-DISSIPATION {VERSION}, commit ")


def test_version_of_the_manual(monkeypatch):
    configuration = {"__file__": str(ROOT / "doc" / "src" / "conf.py")}
    monkeypatch.setattr(sys, "path", list(sys.path))
    exec((ROOT / "doc" / "src" / "conf.py").read_text(), configuration)
    assert configuration["release"] == VERSION


# -- forms -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("form", sorted(path.name for path in (ROOT / ".github" / "ISSUE_TEMPLATE").glob("*.yml") if path.stem != "config"))
def test_form(form):
    """of an issue: what the site requires"""
    content = yaml.safe_load((ROOT / ".github" / "ISSUE_TEMPLATE" / form).read_text())
    assert set(content) == {"name", "description", "labels", "body"}
    ids = [item["id"] for item in content["body"] if item["type"] != "markdown"]
    assert ids and len(set(ids)) == len(ids)
    for item in content["body"]:
        assert ("value" if item["type"] == "markdown" else "label") in item["attributes"]


def test_workflow_runs_what_is_there():
    content = yaml.safe_load((ROOT / ".github" / "workflows" / "test.yml").read_text())
    commands = [step["run"] for job in content["jobs"].values() for step in job["steps"] if "run" in step]
    assert ".ci/run" in commands
    for command in commands:
        assert os.access(ROOT / command.split()[0], os.X_OK)
