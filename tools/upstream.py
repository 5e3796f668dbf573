#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Puts the package SPH-DISSIPATION into a LAMMPS source tree as LAMMPS keeps its own packages.

    upstream.py LAMMPS PATCH [--tree DIR] [--version TAG]

LAMMPS is an unmodified tree of 4 Jul 2026, which is only read; PATCH is written, to be applied with `git apply` in it. With --tree DIR the changed and added files are left in DIR, too, in their places. The pages say that the
styles are new in version TBD, which LAMMPS's maintainers replace at a release; --version names another one.

What goes where: sources to src, those with suffix kk to src/KOKKOS, styles into every table and list of the manual and of both ways to build, pages to doc/src,
examples without pictures and with their dumps commented out to examples/PACKAGES, reference data of LAMMPS's style testers
to unittest, fluids to potentials. A style or a page that this script has no line for is an error.
"""
import argparse
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = "SPH-DISSIPATION"
SOURCES = ROOT / "src" / PACKAGE
KOKKOS = ROOT / "src" / "KOKKOS"
PAGES = ROOT / "doc" / "src"
EXAMPLES = Path("examples/PACKAGES/sph-dissipation")
PICTURES = "../../examples/"    # of the pages: those of the examples

# one line about each style, for the lists of the manual

STYLES = {
    "pair": {
        "sph/bulk": "viscous SPH fluid with independent shear and bulk viscosity",
        "sph/micropolar": "viscous SPH fluid of particles with spin",
    },
    "fix": {
        "sph/bulk": "time integration for pair style sph/bulk",
        "sph/dt": "time step that follows the limits of an SPH fluid",
        "sph/micropolar": "time integration for pair style sph/micropolar",
        "sph/open": "open boundaries of an SPH fluid",
        "sph/refine": "split and merge particles of an SPH fluid",
        "sph/torque": "body torque on SPH particles with spin",
        "sph/wall": "solid walls for an SPH fluid",
    },
    "compute": {
        "sph/angmom": "angular momentum of an SPH fluid, orbital and spin",
        "sph/dissipation": "power dissipated by an SPH fluid, by channel",
        "sph/energy": "kinetic, elastic, and internal energy of an SPH fluid",
        "sph/grid": "fields of an SPH fluid on a grid",
        "sph/spectrum": "spectra of the solenoidal and dilatational motion of an SPH fluid",
        "sph/temp": "translational and rotational temperature of an SPH fluid",
    },
    "atom": {
        "sph/bulk": ("*atomic* + rmass, rho, esph, vest, vfrac", "SPH fluid with bulk viscosity"),
        "sph/micropolar": ("*sph/bulk* + omega, torque, d_inertia", "SPH fluid of particles with spin"),
    },
}

# pages that have another name in the manual of LAMMPS; None = left out, its links go to the page named by LINKS

RENAMED = {
    "theory_sph_dissipation": "Howto_sph_theory",
    "theory_sph_equations": "Howto_sph_theory_equations",
    "theory_sph_walls": "Howto_sph_theory_walls",
    "theory_sph_noise": "Howto_sph_theory_noise",
    "theory_sph_heat": "Howto_sph_theory_heat",
    "theory_sph_time": "Howto_sph_theory_time",
    "design_sph_dissipation": "Developer_sph_dissipation",
    "design_sph_stages": "Developer_sph_stages",
    "index": None,
    "Build_SPH_DISSIPATION": None,
    "Howto_sph_citing": None,
    "Howto_sph_clusters": None,
    "Howto_sph_gallery": None,
}
LINKS = {"index": "Howto_sph_overview", "Build_SPH_DISSIPATION": "Build_package", "Howto_sph_citing": "Errors_bugs",
         "Howto_sph_clusters": "Build_package", "Howto_sph_gallery": "Howto_sph_overview"}

# files of an example that belong there: inputs, logs, what makes initial states

EXAMPLE_FILES = ("in.*", "log.*", "field.py")

DETAILS = """.. _PKG-SPH-DISSIPATION:

SPH-DISSIPATION package
-----------------------

**Contents:**

A viscous, compressible fluid of SPH particles (smoothed particle
hydrodynamics) whose bulk viscosity is set independently of its shear
viscosity, and which conserves linear and angular momentum exactly;
particles with spin (a micropolar fluid), walls, open boundaries,
particles that split and merge, thermal noise, and spectra of turbulence.

**Install:**

Compute style *sph/spectrum* uses the FFTs of the KSPACE package, if that
is installed as well.

**Supporting info:**

* ``src/SPH-DISSIPATION``: filenames -> commands
* ``src/SPH-DISSIPATION/README``
* :doc:`pair_style sph/bulk <pair_sph_bulk>`
* :doc:`pair_style sph/micropolar <pair_sph_micropolar>`
{links}
* ``examples/PACKAGES/sph-dissipation``

----------

"""

OVERVIEW = """   * - :ref:`SPH-DISSIPATION <PKG-SPH-DISSIPATION>`
     - SPH fluids with independent shear and bulk viscosity
     - :doc:`pair_style sph/bulk <pair_sph_bulk>`
     - ``PACKAGES/sph-dissipation``
     - no
"""


def insert(text, item, key, block):
    """Inserts block into a list that is in the order of its keys: behind the item with the largest key below this one.

    item: pattern of the first line of an item, its key is group 1; further lines of an item are indented deeper.
    """
    lines = text.splitlines(keepends=True)
    before = None
    for number, line in enumerate(lines):
        match = re.match(item, line)
        if match and match[1] < key and (before is None or match[1] > before[0]):
            before = match[1], number, len(line) - len(line.lstrip())
    if before is None:
        raise SystemExit(f"upstream: no place for {key} in a list of {item}")
    end = before[1] + 1
    while end < len(lines) and lines[end].strip() and len(lines[end]) - len(lines[end].lstrip()) > before[2]:
        end += 1
    lines.insert(end, block)
    return "".join(lines)


class Tree:
    """The changes to a tree: files in target, those of source that change in before."""

    def __init__(self, source, target, before, version):
        self.source, self.target, self.before, self.version = source, target, before, version

    def read(self, path):
        changed = self.target / path
        return (changed if changed.exists() else self.source / path).read_text(encoding="utf-8")

    def has(self, path):
        return (self.source / path).exists()

    def write(self, path, text):
        if self.has(path) and not (self.before / path).exists():
            (self.before / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(self.source / path, self.before / path)
        (self.target / path).parent.mkdir(parents=True, exist_ok=True)
        (self.target / path).write_text(text, encoding="utf-8")

    def add(self, path, file):
        self.add_text(path, file.read_text(encoding="utf-8"))
        (self.target / path).chmod(0o644)

    def add_text(self, path, text):
        if self.has(path):
            raise SystemExit(f"upstream: LAMMPS has a file {path} of its own")
        self.write(path, text)

    def add_picture(self, path, file):
        if self.has(path):
            raise SystemExit(f"upstream: LAMMPS has a file {path} of its own")
        (self.target / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, self.target / path)

    def insert(self, path, item, key, block):
        self.write(path, insert(self.read(path), item, key, block))

    def replace(self, path, old, new):
        text = self.read(path)
        if text.count(old) != 1:
            raise SystemExit(f"upstream: {path} has {text.count(old)} times {old!r}, expected once")
        self.write(path, text.replace(old, new))


def styles():
    """{kind: {style: page}} from the headers of the package"""
    found = {kind: {} for kind in STYLES}
    for header in SOURCES.glob("*.h"):
        for kind, name in re.findall(r"^(Pair|Fix|Compute|Atom)Style\(([\w/]+),", header.read_text(), re.MULTILINE):
            kind = kind.lower()
            if name.endswith("/kk"):
                continue
            if name not in STYLES[kind]:
                raise SystemExit(f"upstream: no line about {kind} style {name}")
            found[kind][name] = f"{'atom_style' if kind == 'atom' else kind}_{name.replace('/', '_')}"
    return found


def letters(kind, name):
    """how the tables of commands mark accelerated variants: k = KOKKOS"""
    declared = f"{kind.capitalize()}Style({name}/kk,"
    return " (k)" if any(declared in header.read_text() for header in KOKKOS.glob("*.h")) else ""


KOKKOS_SOURCES = """if(PKG_{package})
  if(NOT (KOKKOS_PREC STREQUAL "DOUBLE"))
    message(FATAL_ERROR "Must use KOKKOS_PREC=double with package {package}")
  endif()
{sources}endif()

"""


def add_kokkos_sources(tree):
    """LAMMPS's CMake finds the files of styles, others are to be named."""
    others = [file.name for file in sorted(KOKKOS.glob("*.cpp"))
              if not re.search(r"^(Pair|Fix|Compute|Atom)Style\(", file.with_suffix(".h").read_text(), re.MULTILINE)]
    sources = [f"${{KOKKOS_PKG_SOURCES_DIR}}/{name}" for name in others]
    if sources:
        sources = "  list(APPEND KOKKOS_PKG_SOURCES " + ("\n" + 33 * " ").join(sources) + ")\n"
    block = KOKKOS_SOURCES.format(package=PACKAGE, sources=sources or "")
    before = "if(PKG_ML-IAP)\n  if(NOT (KOKKOS_PREC"
    tree.replace("cmake/Modules/Packages/KOKKOS.cmake", before, block + before)


def add_sources(tree):
    for file in SOURCES.iterdir():
        if file.suffix in (".cpp", ".h") or file.name in ("README", "Install.sh"):
            tree.add(f"src/{PACKAGE}/{file.name}", file)
    for file in sorted(KOKKOS.iterdir()):
        if file.suffix not in (".cpp", ".h"):
            continue
        tree.add(f"src/KOKKOS/{file.name}", file)
        without = SOURCES / file.name.replace("_kokkos", "")
        needs = without.name if without.exists() else "pair_sph_bulk.h"
        tree.insert("src/KOKKOS/Install.sh", r"action (\S+\.(?:cpp|h))(?: \S+)?$", file.name,
                    f"action {file.name} {needs}\n")
    add_kokkos_sources(tree)
    # compute sph/spectrum has the FFTs of KSPACE if that is installed: compiled anew when it comes or goes
    tree.replace("src/Depend.sh", 'if (test $1 = "KSPACE") then\n', f'if (test $1 = "KSPACE") then\n  depend {PACKAGE}\n')
    package = PACKAGE.lower()
    text = tree.read("src/Makefile")
    tree.write("src/Makefile", re.sub(r"^\tsph \\\n", rf"\tsph \\\n\t{package} \\\n", text, flags=re.MULTILINE))
    if tree.has("src/.gitignore"):
        files = sorted(file.name for file in SOURCES.iterdir() if file.suffix in (".cpp", ".h"))
        tree.write("src/.gitignore", tree.read("src/.gitignore") + "".join(f"/{name}\n" for name in files))
    tree.insert("cmake/CMakeLists.txt", r"  ([A-Z][A-Z0-9-]+)\)?$", PACKAGE, f"  {PACKAGE}\n")
    for preset in sorted((tree.source / "cmake" / "presets").glob("*.cmake")):
        path = f"cmake/presets/{preset.name}"
        if re.search(r"^  SPH$", tree.read(path), re.MULTILINE):
            tree.insert(path, r"  ([A-Z][A-Z0-9-]+)\)?$", PACKAGE, f"  {PACKAGE}\n")


def add_styles(tree):
    for kind, names in styles().items():
        for name, page in sorted(names.items()):
            about = STYLES[kind][name]
            if kind == "atom":
                attributes, purpose = about
                tree.insert("doc/src/atom_style.rst", r"   \* - \*([\w/]+)\*$", name,
                            f"   * - *{name}*\n     - {attributes}\n     - :ref:`{PACKAGE} <PKG-{PACKAGE}>`\n"
                            f"     - {purpose}, see :doc:`{page}`\n")
                tree.insert("doc/src/commands_list.rst", r"   (\w+)$", page, f"   {page}\n")
                continue
            listed = {"pair": "pair_style.rst", "fix": "fix.rst", "compute": "compute.rst"}[kind]
            tree.insert(f"doc/src/{listed}", r"\* :doc:`([\w/]+) <", name, f"* :doc:`{name} <{page}>` - {about}\n")
            tree.insert(f"doc/src/Commands_{kind}.rst", r"   \* :doc:`([\w/]+)(?: \(\w+\))? <", name,
                        f"   * :doc:`{name}{letters(kind, name)} <{page}>`\n")
    accelerated = [name for name in sorted(STYLES["atom"]) if letters("atom", name)]
    text = tree.read("doc/src/atom_style.rst")
    tree.write("doc/src/atom_style.rst", re.sub(r"^(\* accelerated styles .*)$", r"\1" + "".join(f" or *{name}/kk*" for name in accelerated),
                                                text, count=1, flags=re.MULTILINE))
    old = re.search(r"or \*sph\* or", tree.read("doc/src/atom_style.rst"))[0]
    tree.replace("doc/src/atom_style.rst", old, "or *sph* or *sph/bulk* or *sph/micropolar* or")


def page_name(name):
    return RENAMED.get(name, name)


def add_pages(tree):
    for page in sorted(PAGES.glob("*.rst")):
        name = page_name(page.stem)
        if name is None:
            continue
        text = page.read_text(encoding="utf-8")
        text = re.sub(r"^(\.\. version\w+::) TBD$", rf"\1 {tree.version}", text, flags=re.MULTILINE)
        # LAMMPS's text about accelerated styles stands where a page becomes general; that of atom styles is on a page of its own
        if "Accelerator Variants:" in text and not name.startswith("atom_style"):
            text, count = re.subn(r"^(?:-{5,}\n\n)?((?:Mixing|Restart), .*\n\"{5,}\n)",
                                  r"----------\n\n.. include:: accel_styles.rst\n\n----------\n\n\1", text, count=1, flags=re.MULTILINE)
            if count != 1:
                raise SystemExit(f"upstream: no place for the text about accelerated styles in {page.name}")
        for old, new in RENAMED.items():
            text = re.sub(rf"<{old}>`", f"<{new or LINKS[old]}>`", text)
            text = re.sub(rf":doc:`{old}`", f":doc:`{new or LINKS[old]}`", text)
        for figure in re.findall(r"^\.\. (?:image|figure):: *(\S+)", text, re.MULTILINE):
            if not figure.startswith(PICTURES):
                raise SystemExit(f"upstream: {page.name} has a picture that is not of an example: {figure}")
            image = f"JPG/sph_{figure[len(PICTURES):].replace('/', '_')}"
            text = text.replace(f":: {figure}\n", f":: {image}\n")
            tree.add_picture(f"doc/src/{image}", PAGES / figure)
        tree.add_text(f"doc/src/{name}.rst", text)
    howtos = sorted(page_name(page.stem) for page in PAGES.glob("*.rst")
                    if (page_name(page.stem) or "").startswith("Howto_"))
    tree.replace("doc/src/Howto.rst", "   Howto_rheo\n", "   Howto_rheo\n" + "".join(f"   {name}\n" for name in howtos))
    toctree = re.search(r"(   Developer_\w+\n)+", tree.read("doc/src/Developer.rst"))[0]
    tree.replace("doc/src/Developer.rst", toctree, toctree + "   Developer_sph_dissipation\n   Developer_sph_stages\n")
    tree.replace("doc/src/Packages_details.rst", "   * :ref:`SPH <PKG-SPH>`\n",
                 f"   * :ref:`SPH <PKG-SPH>`\n   * :ref:`{PACKAGE} <PKG-{PACKAGE}>`\n")
    links = "\n".join(f"* :doc:`{name.replace('_', ' ')} <{name}>`" for name in howtos)
    tree.replace("doc/src/Packages_details.rst", ".. _PKG-SPIN:\n", DETAILS.format(links=links) + ".. _PKG-SPIN:\n")
    tree.insert("doc/src/Packages.rst", r"   \* - :ref:`([A-Z0-9-]+) <", PACKAGE, OVERVIEW)
    words = PAGES.parent / "spelling.txt"
    path = "doc/utils/sphinx-config/false_positives.txt"
    known = tree.read(path).splitlines()
    new = set(words.read_text(encoding="utf-8").split()) - set(known)
    tree.write(path, "".join(f"{word}\n" for word in sorted({*known, *new}, key=lambda word: (word.lower(), word))))


def first_lines(readme):
    """title and first paragraph of a README"""
    title, _, rest = readme.read_text(encoding="utf-8").partition("\n")
    return title.lstrip("# "), rest.strip().split("\n\n")[0]


def add_examples(tree):
    text = ["Examples of the package SPH-DISSIPATION. Variables at the top of an input are set by -var NAME VALUE.\n"]
    for folder in sorted(path for path in (ROOT / "examples").iterdir() if (path / "README.md").exists()):
        for pattern in EXAMPLE_FILES:
            for file in sorted(folder.glob(pattern)):
                content = file.read_text(encoding="utf-8")
                if file.name.startswith("in."):
                    content = re.sub(r"^((?:un)?dump(?:_modify)? )", r"#\1", content, flags=re.MULTILINE)
                tree.add_text(str(EXAMPLES / folder.name / file.name), content)
        title, about = first_lines(folder / "README.md")
        text += [f"{folder.name}: {title}\n", about + "\n"]
    tree.add_text(str(EXAMPLES / "README"), "\n".join(text))
    for file in ("fluids.sph", "gases.sph"):
        tree.add(f"potentials/{file}", ROOT / "potentials" / file)
    for file in sorted((ROOT / "unittest" / "force-styles" / "tests").iterdir()):
        tree.add(f"unittest/force-styles/tests/{file.name}", file)


def write_patch(tree, patch):
    folder = tree.target.parent
    done = subprocess.run(["git", "diff", "--no-index", "--binary", "--no-prefix", "--no-color", tree.before.name, tree.target.name],
                          cwd=folder, stdout=subprocess.PIPE, env={"PATH": "/usr/bin:/bin", "GIT_CONFIG_NOSYSTEM": "1",
                                                                   "HOME": str(folder)})
    if done.returncode != 1:
        raise SystemExit("upstream: git diff failed")
    patch.parent.mkdir(parents=True, exist_ok=True)
    patch.write_bytes(done.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lammps", type=Path)
    parser.add_argument("patch", type=Path)
    parser.add_argument("--tree", type=Path, metavar="DIR", help="folder for the files, made or filled up")
    parser.add_argument("--version", metavar="TAG", default="TBD", help="in which the styles are new (%(default)s)")
    args = parser.parse_args()
    version = args.lammps / "src" / "version.h"
    if not version.exists() or '"4 Jul 2026"' not in version.read_text():
        raise SystemExit(f"upstream: {args.lammps} is no source tree of LAMMPS 4 Jul 2026")
    if not (args.lammps / "doc" / "src").is_dir():
        raise SystemExit(f"upstream: {args.lammps} comes without the sources of the manual")
    with tempfile.TemporaryDirectory() as folder:
        tree = Tree(args.lammps.resolve(), Path(folder, "b"), Path(folder, "a"), args.version)
        tree.before.mkdir()
        for step in (add_sources, add_styles, add_pages, add_examples):
            step(tree)
        write_patch(tree, args.patch)
        if args.tree:
            shutil.copytree(tree.target, args.tree, dirs_exist_ok=True)
    print(f"{args.patch}: apply it with  git apply  in a tree of LAMMPS 4 Jul 2026")


if __name__ == "__main__":
    sys.exit(main())
