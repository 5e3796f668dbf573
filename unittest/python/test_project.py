"""What stands around the code: papers that a run names, version, citation file, forms for reports, workflows, the manual by version."""

import os
import re
import shutil
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


@pytest.mark.skipif(not VERSION.endswith("-dev"), reason="this is a release")
def test_commands_of_a_release(tmp_path):
    """They write one version and one date into all files that test_version compares."""
    for name in ("VERSION", "CITATION.cff", "CHANGELOG.md", "doc/src/Howto_sph_citing.rst"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    commands = re.search(r"^```\n(version=.*?)^```$", (ROOT / "doc" / "contributing" / "release.md").read_text(), re.MULTILINE | re.DOTALL)[1]
    subprocess.run(["bash", "-e", "-c", commands], cwd=tmp_path, check=True)
    version, citation = (tmp_path / "VERSION").read_text().strip(), yaml.safe_load((tmp_path / "CITATION.cff").read_text(encoding="utf-8"))
    assert version == VERSION.partition("-")[0] == citation["version"]
    assert f"version = {{{version}}}" in (tmp_path / "doc" / "src" / "Howto_sph_citing.rst").read_text(encoding="utf-8")
    changes = re.findall(r"^## (.*)", (tmp_path / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert changes[0] == f"{version} ({citation['date-released']})" and "Unreleased" not in changes


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


WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_workflow_runs_what_is_there(path):
    """... says when GitHub has run it last, and adds no cache with each commit."""
    text = path.read_text()
    jobs = yaml.safe_load(text)["jobs"]
    assert len(re.findall(r"^# Last run by GitHub: (?:never|\d{4}-\d\d-\d\d, .+)\.$", text, re.MULTILINE)) == 1
    for job in jobs.values():
        assert 0 < job["timeout-minutes"] <= 180
    steps = [step for job in jobs.values() for step in job["steps"]]
    for command in [step["run"].split()[0] for step in steps if "run" in step]:
        assert command in ("sudo", "brew", "clang-format-14") or os.access(ROOT / command, os.X_OK)
    for step in steps:
        if step.get("uses", "").startswith("actions/cache@"):
            assert "sha" not in step["with"]["key"] and step["with"]["key"].startswith(step["with"]["restore-keys"])
            for pattern in re.findall(r"'([^']*)'", step["with"]["key"]):
                assert list(ROOT.glob(pattern))


def test_workflows_run_the_tests_and_the_manual():
    text = "".join(path.read_text() for path in WORKFLOWS)
    for command in (".ci/run", "./sphd test --kokkos", "./sphd doc", ".ci/pages", ".ci/packaging", "brew"):
        assert f"- run: {command}" in text


# -- the manual by version ---------------------------------------------------------------------------------------


def test_pages(tmp_path):
    """A folder for each version in a branch of one commit; what other versions have stays, what is wrong is refused and changes nothing."""
    clone, origin = tmp_path / "a clone", tmp_path / "origin.git"
    (clone / ".ci").mkdir(parents=True)
    shutil.copy(ROOT / ".ci" / "pages", clone / ".ci")
    (clone / ".gitignore").write_text("/build\n*.log\n")
    environment = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")} | {"GIT_CONFIG_NOSYSTEM": "1", "HOME": str(tmp_path)}

    def git(*words):
        done = subprocess.run(["git", *words], cwd=clone, env=environment, stdout=subprocess.PIPE, text=True, check=True)
        return done.stdout.split()

    def publish(name, version, content=None):
        """error"""
        (clone / "VERSION").write_text(version + "\n")
        shutil.rmtree(clone / "build", ignore_errors=True)
        for file in content or []:
            (clone / "build" / "doc" / file).parent.mkdir(parents=True, exist_ok=True)
            (clone / "build" / "doc" / file).write_text(version)
        done = subprocess.run([str(clone / ".ci" / "pages"), name], env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        assert bool(done.returncode) == bool(done.stderr), done.stderr
        return done.stderr

    def published():
        return set(git("--git-dir", str(origin), "ls-tree", "-r", "--name-only", "gh-pages"))

    def start():
        (word,) = re.findall(r'url=(\S+)/"', " ".join(git("--git-dir", str(origin), "show", "gh-pages:index.html")))
        return word

    git("init", "-q", "-b", "main", "--bare", str(origin))
    git("init", "-q", "-b", "main", ".")
    git("remote", "add", "origin", str(origin))
    site = {".nojekyll", "index.html", "versions.html"}
    assert not publish("main", "1.0.0-dev", ["index.html", "_static/a.log", ".doctrees/x", "old.html"])
    assert published() == site | {"dev/index.html", "dev/_static/a.log", "dev/old.html"} and start() == "dev"
    assert not publish("main", "1.0.0-dev", ["index.html"])
    assert not publish("v1.9.0", "1.9.0", ["index.html"])
    assert not publish("v1.10.0", "1.10.0", ["index.html"])
    assert not publish("v1.9.1", "1.9.1", ["index.html"])
    everything = site | {f"{version}/index.html" for version in ("dev", "1.9.0", "1.9.1", "1.10.0")}
    assert published() == everything and start() == "1.10.0"
    listed = re.findall(r'"(\S+)/"', " ".join(git("--git-dir", str(origin), "show", "gh-pages:versions.html")))
    assert listed == ["1.10.0", "1.9.1", "1.9.0", "dev"]
    assert git("--git-dir", str(origin), "rev-list", "--count", "gh-pages") == ["1"]
    before = git("--git-dir", str(origin), "rev-parse", "gh-pages")
    assert "VERSION has 1.0.0" in publish("v2.0.0", "1.0.0", ["index.html"])
    assert "not from \"else\"" in publish("else", "1.0.0", ["index.html"])
    assert "./sphd doc builds it" in publish("main", "1.0.0-dev")
    assert git("--git-dir", str(origin), "rev-parse", "gh-pages") == before
    assert git("status", "--porcelain") == ["??", ".ci/", "??", ".gitignore", "??", "VERSION"]
    origin.rename(tmp_path / "elsewhere")
    assert "origin cannot be read" in publish("main", "1.0.0-dev", ["index.html"])
