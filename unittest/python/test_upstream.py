"""The patches for LAMMPS: they apply one after the other to an unmodified tree, and what they bring follows the strict rules of
LAMMPS for contributions: the pages Modify_requirements and Modify_style of its manual. What its own programs check is in
unittest/build/make_check.py, that each patch compiles and passes LAMMPS's testers in unittest/build/ways.sh."""

import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from helpers import LMP

ROOT = Path(__file__).resolve().parents[2]
LAMMPS = Path(LMP).resolve().parent / "lammps-source"
AUTHOR = "Maria Muster <m.muster@example.org>"
ENVIRONMENT = {**os.environ, "GIT_CONFIG_NOSYSTEM": "1", "GIT_CONFIG_GLOBAL": os.devnull, "GIT_COMMITTER_NAME": "Tester",
               "GIT_COMMITTER_EMAIL": "tester@example.org"}

pytestmark = pytest.mark.skipif(not (LAMMPS / "doc" / "src").is_dir() or '"4 Jul 2026"' not in (LAMMPS / "src" / "version.h").read_text(),
                                reason="needs LAMMPS 4 Jul 2026 with the sources of its manual")


def upstream(lammps, folder, *options):
    done = subprocess.run([sys.executable, str(ROOT / "tools" / "upstream.py"), str(lammps), str(folder / "patches"), "--tree",
                           str(folder / "tree"), *options], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert done.returncode == 0, done.stdout
    return sorted((folder / "patches").iterdir())


def of_patch(patch):
    """names of the files that a patch changes or adds"""
    return {line[len("+++ b/"):] for line in patch.read_text(encoding="utf-8", errors="replace").splitlines() if line.startswith("+++ b/")}


def files_in(folder):
    return {str(path.relative_to(folder)): path for path in folder.rglob("*") if path.is_file() and ".git" not in path.parts}


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    """What the patches change of LAMMPS, as in a clone, which has the file .gitignore that its releases lack."""
    folder = tmp_path_factory.mktemp("lammps")
    for name in ("src/version.h", "src/dump.cpp", "src/neighbor.cpp", "src/Makefile", "src/Depend.sh", "src/KOKKOS/Install.sh", "cmake",
                 "doc/src", "doc/utils/sphinx-config/false_positives.txt"):
        place = folder / name
        place.parent.mkdir(parents=True, exist_ok=True)
        if (LAMMPS / name).is_dir():
            shutil.copytree(LAMMPS / name, place, ignore=shutil.ignore_patterns("*.png", "*.jpg", "*.gif", "*.pdf", "PDF", "JPG"))
        else:
            shutil.copy2(LAMMPS / name, place)
    (folder / "src" / ".gitignore").write_text("/Makefile.package\n/*_kokkos.h\n/*_kokkos.cpp\n")
    return folder


@pytest.fixture(scope="module")
def series(tmp_path_factory, plain):
    """the patches, and the folder "tree" of all files that they change or add"""
    folder = tmp_path_factory.mktemp("upstream")
    return upstream(plain, folder, "--author", AUTHOR), folder / "tree"


@pytest.fixture(scope="module")
def tree(series):
    """{path: text} of all files that are no pictures"""
    return {path: file.read_text(encoding="utf-8") for path, file in files_in(series[1]).items() if file.suffix not in (".png", ".jpg", ".gif")}


def test_apply_in_order(series, plain, tmp_path):
    """git am takes the patches one by one, in a clone of LAMMPS; then the files are those of the whole tree."""
    patches, whole = series
    assert [patch.name[:4] for patch in patches] == ["0001", "0002", "0003", "0004", "0005"]
    clone = tmp_path / "clone"
    shutil.copytree(plain, clone)

    def git(*args):
        done = subprocess.run(["git", *args], cwd=clone, env=ENVIRONMENT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        assert done.returncode == 0, done.stdout
        return done.stdout

    git("init", "-q")
    git("add", "-A", "-f")
    git("-c", "user.name=Tester", "-c", "user.email=tester@example.org", "commit", "-q", "-m", "LAMMPS")
    for patch in patches:
        git("am", "-q", "--whitespace=nowarn", str(patch))    # LAMMPS's logs have trailing blanks
        assert git("log", "-1", "--format=%an <%ae>").strip() == AUTHOR
        assert not git("status", "--porcelain")
    expected = {path: plain / path for path in files_in(plain)} | files_in(whole)
    found = files_in(clone)
    assert found.keys() == expected.keys()
    assert [path for path in found if found[path].read_bytes() != expected[path].read_bytes()] == []


def test_git_apply_without_a_clone(plain, tmp_path):
    """as the manual says, in a tree of a release, with all patches in one command, and nobody's name"""
    release = tmp_path / "release"
    shutil.copytree(plain, release)
    (release / "src" / ".gitignore").unlink()
    patches = upstream(release, tmp_path)
    done = subprocess.run(["git", "apply", *map(str, patches)], cwd=release, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, env={**ENVIRONMENT, "GIT_CEILING_DIRECTORIES": str(tmp_path)})
    assert done.returncode == 0, done.stdout
    found = files_in(release)
    assert [path for path, file in files_in(tmp_path / "tree").items() if found[path].read_bytes() != file.read_bytes()] == []


def test_texts(series):
    """Each patch says what it is, why, how it is tested, what it costs, and what reviewers will ask."""
    for patch in series[0]:
        text = patch.read_text(encoding="utf-8", errors="replace").partition("\n---\n")[0]
        assert re.search(r"^Subject: \[PATCH \d/5\] \S.{10,60}$", text, re.MULTILINE)
        assert re.findall(r"^(\w[\w ]*)\n=+$", text, re.MULTILINE) == ["What", "Why", "Tests", "Cost", "What reviewers will ask"]
        assert max(map(len, text.splitlines())) <= 80


def test_a_style_comes_with_what_belongs_to_it(series, tree):
    """source, page, entry in the lists, reference data, all in the same patch"""
    patches, _ = series
    came = {path: number for number, patch in reversed(list(enumerate(patches, 1))) for path in of_patch(patch)}
    for header, kind, style in styles(tree):
        page = f"doc/src/{'atom_style' if kind == 'atom' else kind}_{style.replace('/', '_').removesuffix('_kk')}.rst"
        if style.endswith("/kk"):
            assert came[header] == 5
            continue
        assert came[page] == came[header], (style, page)
        for name in ("atomic-pair" if kind == "pair" else f"{kind}-timestep",):
            data = f"unittest/force-styles/tests/{name}-{style.replace('/', '_')}.yaml"
            assert came.get(data, came[header]) == came[header]
    assert of_patch(patches[0]) == {"src/dump.cpp", "src/neighbor.cpp"}


def symbols(file):
    """(defined, needed) of an object file"""
    lines = subprocess.run(["nm", "-C", str(file)], stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines()
    found = [line[17:].partition(" ") for line in lines]
    return {name for kind, _, name in found if kind in "TDBR"}, {name for kind, _, name in found if kind == "U"}


def test_each_patch_links(series):
    """What the sources of the first patches need is not in those of a later one: in the objects of the build that is tested."""
    objects = {file.name: file for file in Path(LMP).resolve().parent.rglob("*sph_*.cpp.o") if "SPH-DISSIPATION" in str(file)}
    if not objects or not shutil.which("nm"):
        pytest.skip("no objects of the package beside the executable, or no nm")
    # of each patch; a build folder may still have objects of files that are gone
    came = [{Path(path).name for path in of_patch(patch) if path.startswith("src/SPH-DISSIPATION/") and path.endswith(".cpp")} for patch in series[0]]
    table = {f"{name}.o": symbols(objects[f"{name}.o"]) for name in set().union(*came)}
    everywhere = set().union(*(defined for defined, _ in table.values()))
    there = set()
    for new in came:
        there |= {f"{name}.o" for name in new}
        defined = set().union(*(table[name][0] for name in there))
        missing = set().union(*(table[name][1] for name in there)) & everywhere - defined
        assert not missing


@pytest.mark.long
def test_without_mpi():
    """The stand-in for MPI that LAMMPS has is stricter than MPI: what its collective functions read is not const."""
    compiler = shutil.which("c++")
    if not compiler or not (LAMMPS / "src" / "STUBS").is_dir():
        pytest.skip("no compiler, or no LAMMPS/src/STUBS")
    folder = ROOT / "src" / "SPH-DISSIPATION"
    call = re.compile(r"MPI_|over_all|gather_all")
    command = [compiler, "-fsyntax-only", "-std=c++17", "-w", *(f"-I{place}" for place in (LAMMPS / "src" / "STUBS", LAMMPS / "src", folder))]
    with ThreadPoolExecutor(2) as team:
        done = team.map(lambda path: subprocess.run([*command, str(path)], stderr=subprocess.PIPE, text=True),
                        [path for path in sorted(folder.glob("*.cpp")) if call.search(path.read_text())])
    assert not "".join(one.stderr for one in done if one.returncode)


# -- the rules ---------------------------------------------------------------------------------------------------


def sources(tree, suffix=""):
    return {path: text for path, text in tree.items() if path.startswith(("src/SPH-DISSIPATION/", "src/KOKKOS/"))
            and path.endswith((".cpp", ".h")) and path.endswith(suffix)}


def styles(tree):
    """(header, kind, style) of each"""
    for path, text in sources(tree, ".h").items():
        for kind, style in re.findall(r"^(Pair|Fix|Compute|Atom)Style\(([\w/]+),", text, re.MULTILINE):
            if not style.endswith(("/kk/host", "/kk/device")):
                yield path, kind.lower(), style


def without_comments(text):
    """code without comments and without what is between quotation marks"""
    return re.sub(r'//[^\n]*|/\*.*?\*/|"(?:[^"\\\n]|\\.)*"', '""', text, flags=re.DOTALL)


def license_and_author(tree):
    for path, text in sources(tree).items():
        head = text[:2500]
        if "LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator" not in head or "the GNU General Public License" not in head:
            yield f"{path}: no copyright notice"
        own_cpp = path.endswith(".h") and f"{path[:-2]}.cpp" in tree
        if not own_cpp and f"Contributing author: {AUTHOR}" not in head:
            yield f"{path}: no name and address of the author"


def names_of_styles(tree):
    """compute some/name stands in compute_some_name.h, class ComputeSomeName, guard LMP_COMPUTE_SOME_NAME_H"""
    for path, kind, style in styles(tree):
        stem = f"{'atom_vec' if kind == 'atom' else kind}_{style.removesuffix('/kk').replace('/', '_')}{'_kokkos' if style.endswith('/kk') else ''}"
        if Path(path).stem != stem:
            yield f"{path}: {kind} {style} belongs into {stem}.h"
        if f"#ifndef LMP_{stem.upper()}_H" not in tree[path]:
            yield f"{path}: the include guard is not LMP_{stem.upper()}_H"
        if not re.search(rf"^(?:template .*)?class {stem.replace('_', '')} ", tree[path], re.MULTILINE | re.IGNORECASE):
            yield f"{path}: no class of the name of {kind} {style}"
        if not re.fullmatch(r"[a-z0-9/]+", style):
            yield f"{path}: {style} has other characters than small letters, numbers, slashes"
        if f'clang-format off\n{kind.capitalize()}Style(' not in tree[path] or not re.search(r"Style\([^;\n]*\);\n// clang-format on", tree[path]):
            yield f"{path}: clang-format is not off around the macro of the style"


OF_KOKKOS = ("kokkos_type.h", "pair_kokkos.h")    # what all styles of KOKKOS include in LAMMPS


def headers_of_styles(tree):
    """Of LAMMPS and of the package, a header with a style includes its base classes alone; it has no using outside of a class."""
    names = {Path(path).name: text for path, text in sources(tree, ".h").items()}
    for path in {path for path, _, _ in styles(tree)}:
        listed = " ".join(re.findall(r"\bclass \w+ :([^{]*)", tree[path]))
        bases = set(re.findall(r"(?:virtual )?public\s+(?:\w+::)*(\w+)", listed))
        for include in re.findall(r'^#include "([\w.]+)"', tree[path], re.MULTILINE):
            text = names.get(include) or (LAMMPS / "src" / include if (LAMMPS / "src" / include).exists() else LAMMPS / "src" / "KOKKOS" / include).read_text()
            has = set(re.findall(r"^ *(?:template .*)?(?:class|struct) (\w+) (?::|\{|final)", text, re.MULTILINE))
            if not bases & has and include not in OF_KOKKOS:
                yield f"{path}: {include} is not the header of a base class ({', '.join(sorted(bases))})"
        if re.search(r"^using ", tree[path], re.MULTILINE):
            yield f"{path}: using"


def namespaces_of_headers(tree):
    for path, text in sources(tree, ".h").items():
        if re.search(r"\busing namespace\b", text):
            yield f"{path}: using namespace"


def messages_of_errors(tree):
    for path, text in sources(tree).items():
        for found in re.finditer(r"error->(?:all|one|warning)\(\s*([^\s,]*)", text):
            if found[1] != "FLERR":
                yield f"{path}: {found[0]}"


def language(tree):
    for path, text in sources(tree).items():
        code = without_comments(text)
        for pattern, what in ((r"#include <(?:std(?:io|lib|def|int)|string|math|ctype|errno|limits|time)\.h>", "headers of C"),
                              (r"#include <(?:iostream|fstream|iomanip)>|\bstd::(?:cout|cerr|endl)\b", "iostreams"),
                              (r"[\w)] +(?:and|or|xor|bitand|bitor|not_eq) +[\w(]|[(=] *not +\w", "alternative tokens"),
                              (r"\bexit *\(|\babort *\(\)", "the end of the program without class Error"),
                              (r"\b(?:co_await|co_yield|concept|requires) ", "C++20")):
            found = re.search(pattern, code)
            if found:
                yield f"{path}: {what}: {found[0]}"
        if re.search(r"~\w+\(\) override (?:= default;|\{\})", code) and "public Fix" in code:
            yield f"{path}: an empty destructor"


def characters(tree):
    """no tabs, no trailing blanks, Unix lines with an end; ASCII alone"""
    for path, text in tree.items():
        added = path.startswith(("src/SPH-DISSIPATION/", "examples/", "unittest/", "potentials/")) or (path.startswith("src/KOKKOS/") and "sph" in path) \
            or re.match(r"doc/src/\w*sph_\w+\.rst", path)
        if not added:
            continue
        if "\t" in text:
            yield f"{path}: tabs"
        if re.search(r"[ \r]$", text, re.MULTILINE) and not Path(path).name.startswith("log."):
            yield f"{path}: trailing blanks"
        if not text.endswith("\n"):
            yield f"{path}: the last line has no end"
        if not text.isascii() and not path.startswith("examples/"):
            yield f"{path}: not ASCII: " + re.search(r"[^ -~\n]", text)[0]


def permissions(tree, folder):
    for path, file in files_in(folder).items():
        wanted = 0o755 if path.endswith((".sh", ".py")) and os.access(file, os.X_OK) else 0o644
        if file.stat().st_mode & 0o777 != wanted:
            yield f"{path}: {file.stat().st_mode & 0o777:o}"


def ignored_by_git(tree):
    """what make copies to src"""
    listed = tree["src/.gitignore"].splitlines()
    for path in sources(tree):
        if not any(Path(f"/{Path(path).name}").match(pattern) for pattern in listed):
            yield f"{path} is not in src/.gitignore"


def pages(tree):
    """Each style has its page with all sections, which says that the package is needed, and its lines in the lists."""
    sections = ("Syntax", "Examples", "Description", "Restrictions", "Default")
    for _, kind, style in styles(tree):
        if style.endswith("/kk"):
            continue
        page = f"{'atom_style' if kind == 'atom' else kind}_{style.replace('/', '_')}"
        text = tree[f"doc/src/{page}.rst"]
        for section in sections if kind != "atom" else sections[:-1]:
            if not re.search(rf"^{section}\n\"+$", text, re.MULTILINE):
                yield f"{page}.rst: no section {section}"
        if "SPH-DISSIPATION package" not in text:
            yield f"{page}.rst does not say which package is needed"
        if not re.search(rf"^\.\. index:: {kind}[ _]style {style}$|^\.\. index:: {kind} {style}$", text, re.MULTILINE):
            yield f"{page}.rst: no index entry of {kind} {style}"
        lists = {"pair": ("Commands_pair", "pair_style"), "fix": ("Commands_fix", "fix"), "compute": ("Commands_compute", "compute"),
                 "atom": ("atom_style", "commands_list")}[kind]
        for name in lists:
            if not re.search(rf"<{page}>|`{page}`|^   {page}$", tree[f"doc/src/{name}.rst"], re.MULTILINE):
                yield f"{kind} {style} is not in {name}.rst"
    for path in tree:
        if re.match(r"doc/src/Howto_sph_\w+\.rst", path) and f"   {Path(path).stem}\n" not in tree["doc/src/Howto.rst"]:
            yield f"{path} is not in Howto.rst"


def examples(tree):
    for path, text in tree.items():
        if not path.startswith("examples/"):
            continue
        name = Path(path).name
        if not re.match(r"(?:in|log|data)\.|README$|\w+\.py$", name):
            yield f"{path}: not a name of an input, a log, or data"
        if name.startswith("in."):
            found = re.search(r"^(?:log|echo|package|processors|suffix|dump|undump|dump_modify) .*", text, re.MULTILINE)
            if found and not re.match(r"processors +\* +[*1] +1$", found[0]):
                yield f"{path}: {found[0]}"


RULES = (license_and_author, names_of_styles, headers_of_styles, namespaces_of_headers, messages_of_errors, language, characters, permissions,
         ignored_by_git, pages, examples)


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.__name__)
def test_rule(rule, series, tree):
    found = list(rule(tree, series[1]) if rule is permissions else rule(tree))
    assert not found, "\n" + "\n".join(found)
