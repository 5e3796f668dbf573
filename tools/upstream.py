#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Puts the package SPH-DISSIPATION into a LAMMPS source tree as LAMMPS keeps its own packages: a series of patches.

    upstream.py LAMMPS FOLDER [--tree DIR] [--upto N] [--version TAG] [--author "NAME <ADDRESS>"]

LAMMPS is an unmodified tree of 4 Jul 2026, which is only read; the patches are written to FOLDER, to be applied in their order with
`git apply` in it. With --tree DIR the changed and added files are left in DIR, too, in their places, those of the first N patches. The
pages say that the styles are new in version TBD, which LAMMPS's maintainers replace at a release; --version names another one.

What goes where: sources to src, those with suffix kk to src/KOKKOS, styles into every table and list of the manual and of both ways to build, pages to doc/src,
examples without pictures and with their dumps commented out to examples/PACKAGES, reference data of LAMMPS's style testers
to unittest, fluids to potentials. A style or a page that this script has no line for is an error.

Which patch: PATCHES has the styles of each. A source comes with the first style that includes it, directly or not; a .cpp file with
its header, or, without one, with the first header that it includes. A page comes with its style, other pages with the last style that they name
(PLACED has exceptions); a link to a page that comes later is plain text until then. An example comes with the last style that it uses,
a file of LAMMPS's testers with its style. Each patch begins with its text in tools/upstream, and is a tree that builds and passes LAMMPS's tests.
"""
import argparse
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = "SPH-DISSIPATION"
SOURCES = ROOT / "src" / PACKAGE
KOKKOS = ROOT / "src" / "KOKKOS"
PAGES = ROOT / "doc" / "src"
TEXTS = ROOT / "tools" / "upstream"
AUTHOR = "Contributing authors: the SPH-DISSIPATION authors"
BY_AUTHOR = f"""
/* ----------------------------------------------------------------------
   {AUTHOR}
------------------------------------------------------------------------- */
"""
EXAMPLES = Path("examples/PACKAGES/sph-dissipation")
PICTURES = "../../examples/"    # of the pages: those of the examples

# the series: name of each patch, also that of its text, and the styles that come with it; the styles of KOKKOS are PACKAGE_KOKKOS

PATCHES = (
    ("core", ()),
    ("fluid", ("atom sph/bulk", "atom sph/micropolar", "pair sph/bulk", "pair sph/micropolar", "fix sph/bulk", "fix sph/micropolar",
               "fix sph/torque", "compute sph/angmom", "compute sph/dissipation", "compute sph/energy")),
    ("walls", ("fix sph/wall", "fix sph/dt", "compute sph/gauge")),
    ("noise", ("compute sph/temp",)),
    ("open", ("fix sph/open", "fix sph/refine", "compute sph/grid", "compute sph/spectrum", "KOKKOS")),
)
NUMBER = {name: number for number, (name, _) in enumerate(PATCHES, 1)}
LAST = len(PATCHES)

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
        "sph/gauge": "pressures and levels of an SPH fluid at points",
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

# pages that do not come with the last style that they name, by their names in LAMMPS's manual

PLACED = {
    "Howto_sph_theory_heat": "fluid",
    "Howto_sph_theory_time": "fluid",
    "Howto_sph_theory_walls": "fluid",
    "Howto_sph_theory_noise": "noise",
    "Howto_sph_kokkos": "open",
    "Howto_sph_validation": "open",
    "Developer_sph_dissipation": "open",
}

# what an example uses besides styles

USES = {
    "walls": r"\bviscous (?:rkl2|implicit)|\bconductivity\b",
    "noise": r"^pair_style .* temp ",
}

# what the core of LAMMPS needs: file, what stands there, what takes its place

CORE = (
    ("src/neighbor.cpp", """    ex2_group[m - 1] = ex2_group[m];
    ex1_bit[m - 1] = ex1_bit[m];
    ex2_bit[m - 1] = ex2_bit[m];
""", """    ex2_group[m - 1] = ex2_group[m];
"""),
    ("src/neighbor.cpp", """   remove the first group-group exclusion matching group1, group2
""", """   remove the first group-group exclusion matching group1, group2
   takes effect as one that is added: init() sets ex1_bit and ex2_bit, which
   may be shorter than the list of groups until then
"""),
    ("src/dump.cpp", """    //           min/max IDs of group match size of group
""", """    //           min/max IDs of group match size of group
    // sort() tests for each snapshot that IDs are still the same
"""),
    ("src/dump.cpp", """    int gcmcflag = 0;
    for (const auto &fix : modify->get_fix_list())
      if (utils::strmatch(fix->style,"^gcmc"))
        gcmcflag = 1;

    if (sortcol == 0 && atom->tag_consecutive() && !gcmcflag) {
""", """    if (sortcol == 0 && atom->tag_consecutive()) {
"""),
    ("src/dump.cpp", """  // if reorder flag is set & total/per-proc counts match pre-computed values,
  // then create index directly from idsort
""", """  // if reorder flag is set & total/per-proc counts match pre-computed values,
  // and IDs are still consecutive: not if atoms were deleted and others created,
  // then create index directly from idsort
"""),
    ("src/dump.cpp", """    if (nme != nme_reorder) flag = 1;
    int flagall;
""", """    if (nme != nme_reorder) flag = 1;
    for (i = 0; i < nme && !flag; i++)
      if (idsort[i] < idlo || idsort[i] >= idlo+nme) flag = 1;
    int flagall;
"""),
)

# files of an example that belong there: inputs, logs, what makes initial states

EXAMPLE_FILES = ("in.*", "log.*", "field.py")

DETAILS = """.. _PKG-SPH-DISSIPATION:

SPH-DISSIPATION package
-----------------------

**Contents:**

A viscous, compressible fluid of SPH particles (smoothed particle
hydrodynamics) whose bulk viscosity is set independently of its shear
viscosity, and which conserves linear and angular momentum exactly;
particles with spin (a micropolar fluid){contents}.

{install}**Supporting info:**

* ``src/SPH-DISSIPATION``: filenames -> commands
* ``src/SPH-DISSIPATION/README``
* :doc:`pair_style sph/bulk <pair_sph_bulk>`
* :doc:`pair_style sph/micropolar <pair_sph_micropolar>`
{links}
* ``examples/PACKAGES/sph-dissipation``

----------

"""

CONTENTS = {"walls": ",\nwalls", "noise": ", thermal noise", "open": ", open boundaries,\nparticles that split and merge, spectra of turbulence"}

INSTALL = """**Install:**

Compute style *sph/spectrum* uses the FFTs of the KSPACE package, if that
is installed as well.

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
    """A tree with the first patches, upto this number: the files that they change or add are in target."""

    def __init__(self, source, target, upto, version, author):
        self.source, self.target, self.upto, self.version, self.author = source, target, upto, version, author
        self.target.mkdir(parents=True)

    def comes(self, number):
        return number <= self.upto

    def read(self, path):
        changed = self.target / path
        return (changed if changed.exists() else self.source / path).read_text(encoding="utf-8")

    def has(self, path):
        return (self.source / path).exists()

    def write(self, path, text):
        (self.target / path).parent.mkdir(parents=True, exist_ok=True)
        (self.target / path).write_text(text, encoding="utf-8")

    def add(self, path, file):
        self.add_text(path, file.read_text(encoding="utf-8"))
        (self.target / path).chmod(0o644)

    def add_source(self, path, file):
        """A source has the name of its author at the top: a .cpp file, or a header that has none."""
        text = file.read_text(encoding="utf-8")
        if AUTHOR not in text and (file.suffix == ".cpp" or not file.with_suffix(".cpp").exists()):
            end = text.index("*/\n") + len("*/\n")
            text = text[:end] + BY_AUTHOR + text[end:]
        self.add_text(path, text.replace(AUTHOR, f"Contributing author: {self.author}") if self.author else text)
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


def letters(tree, kind, name):
    """how the tables of commands mark accelerated variants: k = KOKKOS"""
    declared = f"{kind.capitalize()}Style({name}/kk,"
    return " (k)" if tree.comes(KOKKOS_NUMBER) and any(declared in header.read_text() for header in KOKKOS.glob("*.h")) else ""


def number_of_styles():
    """{style: number of the patch that it comes with}"""
    found = {style: NUMBER[name] for name, listed in PATCHES for style in listed}
    there = {f"{kind} {name}" for kind, names in styles().items() for name in names} | {"KOKKOS"}
    if found.keys() != there:
        raise SystemExit(f"upstream: not in both lists of styles: {', '.join(sorted(found.keys() ^ there))}")
    return found


KOKKOS_NUMBER = number_of_styles()["KOKKOS"]


def number_of_sources():
    """{file: number of the patch that it comes with}"""
    files = {file.name: file for folder in (SOURCES, KOKKOS) for file in folder.iterdir() if file.suffix in (".cpp", ".h")}
    includes = {name: [other for other in re.findall(r'^ *# *include "([\w.]+)"', file.read_text(), re.MULTILINE) if other in files]
                for name, file in files.items()}
    home = {}    # of the .cpp files of a header
    for name in files:
        if name.endswith(".cpp"):
            header = f"{name[:-len('.cpp')]}.h"
            home.setdefault(header if header in files else includes[name][0], []).append(name)
    numbers = number_of_styles()
    found = {}
    for number in range(1, LAST + 1):
        todo = []
        for name, file in files.items():
            for kind, style in re.findall(r"^(Pair|Fix|Compute|Atom)Style\(([\w/]+),", file.read_text(), re.MULTILINE):
                if number == (KOKKOS_NUMBER if "/kk" in style else numbers[f"{kind.lower()} {style}"]):
                    todo.append(name)
        while todo:
            name = todo.pop()
            if name not in found:
                found[name] = number
                todo += includes[name] + home.get(name, [])
    left = files.keys() - found.keys()
    if left:
        raise SystemExit(f"upstream: no style includes {', '.join(sorted(left))}")
    return found


KOKKOS_SOURCES = """if(PKG_{package})
  if(NOT (KOKKOS_PREC STREQUAL "DOUBLE"))
    message(FATAL_ERROR "Must use KOKKOS_PREC=double with package {package}")
  endif()
{sources}endif()

"""


def add_kokkos_sources(tree):
    """LAMMPS's CMake finds the files of styles, others are to be named."""
    styles = [header.stem for header in KOKKOS.glob("*.h") if re.search(r"^(Pair|Fix|Compute|Atom)Style\(", header.read_text(), re.MULTILINE)]
    others = [file.name for file in sorted(KOKKOS.glob("*.cpp")) if file.stem not in styles]
    sources = [f"${{KOKKOS_PKG_SOURCES_DIR}}/{name}" for name in others]
    if sources:
        sources = "  list(APPEND KOKKOS_PKG_SOURCES " + ("\n" + 33 * " ").join(sources) + ")\n"
    block = KOKKOS_SOURCES.format(package=PACKAGE, sources=sources or "")
    before = "if(PKG_ML-IAP)\n  if(NOT (KOKKOS_PREC"
    tree.replace("cmake/Modules/Packages/KOKKOS.cmake", before, block + before)


def add_core(tree):
    for path, old, new in CORE:
        tree.replace(path, old, new)


def add_sources(tree):
    numbers = number_of_sources()
    for file in SOURCES.iterdir():
        if file.name in ("README", "Install.sh"):
            tree.add(f"src/{PACKAGE}/{file.name}", file)
        elif tree.comes(numbers.get(file.name, LAST + 1)):
            tree.add_source(f"src/{PACKAGE}/{file.name}", file)
    for file in sorted(KOKKOS.iterdir()):
        if not tree.comes(numbers.get(file.name, LAST + 1)):
            continue
        tree.add_source(f"src/KOKKOS/{file.name}", file)
        without = SOURCES / file.name.replace("_kokkos", "")
        needs = without.name if without.exists() else "pair_sph_bulk.h"
        tree.insert("src/KOKKOS/Install.sh", r"action (\S+\.(?:cpp|h))(?: \S+)?$", file.name,
                    f"action {file.name} {needs}\n")
    if tree.comes(KOKKOS_NUMBER):
        add_kokkos_sources(tree)
    # compute sph/spectrum has the FFTs of KSPACE if that is installed: compiled anew when it comes or goes
    if tree.comes(numbers["sph_dissipation_fft.cpp"]):
        tree.replace("src/Depend.sh", 'if (test $1 = "KSPACE") then\n', f'if (test $1 = "KSPACE") then\n  depend {PACKAGE}\n')
    package = PACKAGE.lower()
    text = tree.read("src/Makefile")
    tree.write("src/Makefile", re.sub(r"^\tsph \\\n", rf"\tsph \\\n\t{package} \\\n", text, flags=re.MULTILINE))
    if tree.has("src/.gitignore"):
        files = sorted(file.name for file in SOURCES.iterdir() if tree.comes(numbers.get(file.name, LAST + 1)))
        tree.write("src/.gitignore", tree.read("src/.gitignore") + "".join(f"/{name}\n" for name in files))
    tree.insert("cmake/CMakeLists.txt", r"  ([A-Z][A-Z0-9-]+)\)?$", PACKAGE, f"  {PACKAGE}\n")
    for preset in sorted((tree.source / "cmake" / "presets").glob("*.cmake")):
        path = f"cmake/presets/{preset.name}"
        if re.search(r"^  SPH$", tree.read(path), re.MULTILINE):
            tree.insert(path, r"  ([A-Z][A-Z0-9-]+)\)?$", PACKAGE, f"  {PACKAGE}\n")


def add_styles(tree):
    numbers = number_of_styles()
    for kind, names in styles().items():
        for name, page in sorted(names.items()):
            if not tree.comes(numbers[f"{kind} {name}"]):
                continue
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
                        f"   * :doc:`{name}{letters(tree, kind, name)} <{page}>`\n")
    accelerated = [name for name in sorted(STYLES["atom"]) if letters(tree, "atom", name)]
    text = tree.read("doc/src/atom_style.rst")
    tree.write("doc/src/atom_style.rst", re.sub(r"^(\* accelerated styles .*)$", r"\1" + "".join(f" or *{name}/kk*" for name in accelerated),
                                                text, count=1, flags=re.MULTILINE))
    old = re.search(r"or \*sph\* or", tree.read("doc/src/atom_style.rst"))[0]
    tree.replace("doc/src/atom_style.rst", old, "or *sph* or *sph/bulk* or *sph/micropolar* or")


def page_name(name):
    return RENAMED.get(name, name)


def without_kokkos(text):
    """a page before the styles of KOKKOS come"""
    text = re.sub(r"^\.\. index:: .*/kk\n", "", text, flags=re.MULTILINE)
    return re.sub(r"^Accelerator Variants: .*\n\n", "", text, flags=re.MULTILINE)


def pages(tree):
    """{page: text} of all pages, as they are in the manual in the end"""
    found = {}
    for page in sorted(PAGES.glob("*.rst")):
        name = page_name(page.stem)
        if name is None:
            continue
        text = page.read_text(encoding="utf-8")
        text = re.sub(r"^(\.\. version\w+::) TBD$", rf"\1 {tree.version}", text, flags=re.MULTILINE)
        # LAMMPS's text about accelerated styles stands where a page becomes general; that of atom styles is on a page of its own
        if "Accelerator Variants:" in text and not name.startswith("atom_style") and tree.comes(KOKKOS_NUMBER):
            text, count = re.subn(r"^(?:-{5,}\n\n)?((?:Mixing|Restart), .*\n\"{5,}\n)",
                                  r"----------\n\n.. include:: accel_styles.rst\n\n----------\n\n\1", text, count=1, flags=re.MULTILINE)
            if count != 1:
                raise SystemExit(f"upstream: no place for the text about accelerated styles in {page.name}")
        for old, new in RENAMED.items():
            text = re.sub(rf"<{old}>`", f"<{new or LINKS[old]}>`", text)
            text = re.sub(rf":doc:`{old}`", f":doc:`{new or LINKS[old]}`", text)
        found[name] = text if tree.comes(KOKKOS_NUMBER) else without_kokkos(text)
    return found


def number_of_pages(texts):
    """{page: number of the patch that it comes with}"""
    numbers = number_of_styles()
    of_style = {page: numbers[f"{kind} {name}"] for kind, names in styles().items() for name, page in names.items()}
    found = {}
    for name, text in texts.items():
        own = [page for page in of_style if name == page or name.startswith(f"{page}_")]
        if own:
            found[name] = of_style[max(own, key=len)]
        elif name in PLACED:
            found[name] = NUMBER[PLACED[name]]
        else:
            links = set(re.findall(r"<(\w+)>`", text)) | set(re.findall(r":doc:`(\w+)`", text))
            named = {page for page in of_style if re.search(rf"\*(?:\w+ )?{page.partition('_')[2].replace('_', '/')}\*", text)
                     and not page.startswith("atom_style")}
            found[name] = max((of_style[page] for page in (links | named) & of_style.keys()), default=NUMBER["fluid"])
    return found


def without_links(name, text, later, labels):
    """Links to pages of later patches, and to labels there, become plain text."""
    def plain(match):
        role, title, target = match[1], match[2], match[3] or match[4]
        if target not in (later if role == "doc" else labels):
            return match[0]
        if role == "eq" or (role == "ref" and not title):
            raise SystemExit(f"upstream: {name}.rst needs {target}, which comes later: put it into PLACED")
        return title or target.replace("_", " ")
    return re.sub(r":(doc|ref|eq):`(?:([^`<]*?)\s*<(\w+)>|(\w+))`", plain, text)


def in_order(word):
    return word.lower(), word


def add_pages(tree):
    texts = pages(tree)
    numbers = number_of_pages(texts)
    later = {name for name, number in numbers.items() if not tree.comes(number)}
    labels = {label for name in later for label in re.findall(r"^ *\.\. _(\w+):|^ *:label: (\w+)", texts[name], re.MULTILINE) for label in label}
    for name, text in texts.items():
        if name in later:
            continue
        text = without_links(name, text, later, labels)
        for figure in re.findall(r"^\.\. (?:image|figure):: *(\S+)", text, re.MULTILINE):
            if not figure.startswith(PICTURES):
                raise SystemExit(f"upstream: {name}.rst has a picture that is not of an example: {figure}")
            image = f"JPG/sph_{figure[len(PICTURES):].replace('/', '_')}"
            text = text.replace(f":: {figure}\n", f":: {image}\n")
            tree.add_picture(f"doc/src/{image}", PAGES / figure)
        tree.add_text(f"doc/src/{name}.rst", text)
    howtos = sorted(name for name in texts if name.startswith("Howto_") and name not in later)
    tree.replace("doc/src/Howto.rst", "   Howto_rheo\n", "   Howto_rheo\n" + "".join(f"   {name}\n" for name in howtos))
    toctree = re.search(r"(   Developer_\w+\n)+", tree.read("doc/src/Developer.rst"))[0]
    developer = sorted(name for name in texts if name.startswith("Developer_") and name not in later)
    tree.replace("doc/src/Developer.rst", toctree, toctree + "".join(f"   {name}\n" for name in developer))
    tree.replace("doc/src/Packages_details.rst", "   * :ref:`SPH <PKG-SPH>`\n",
                 f"   * :ref:`SPH <PKG-SPH>`\n   * :ref:`{PACKAGE} <PKG-{PACKAGE}>`\n")
    links = "\n".join(f"* :doc:`{name.replace('_', ' ')} <{name}>`" for name in howtos)
    contents = "".join(more for name, more in CONTENTS.items() if tree.comes(NUMBER[name]))
    details = DETAILS.format(links=links, contents=contents, install=INSTALL if "compute_sph_spectrum" not in later else "")
    tree.replace("doc/src/Packages_details.rst", ".. _PKG-SPIN:\n", details + ".. _PKG-SPIN:\n")
    tree.insert("doc/src/Packages.rst", r"   \* - :ref:`([A-Z0-9-]+) <", PACKAGE, OVERVIEW)
    words = PAGES.parent / "spelling.txt"
    path = "doc/utils/sphinx-config/false_positives.txt"
    known = tree.read(path).splitlines()
    listed = list(known)
    for word in sorted(set(words.read_text(encoding="utf-8").split()) - set(known), key=in_order):
        before = max((other for other in listed if in_order(other) < in_order(word)), key=in_order)
        listed.insert(listed.index(before) + 1, word)
    tree.write(path, "".join(f"{word}\n" for word in listed))


def first_lines(readme):
    """title and first paragraph of a README"""
    title, _, rest = readme.read_text(encoding="utf-8").partition("\n")
    return title.lstrip("# "), rest.strip().split("\n\n")[0]


def number_of_example(folder):
    """of the patch that an example comes with"""
    text = "".join(file.read_text(encoding="utf-8") for file in folder.glob("in.*"))
    used = [number for style, number in number_of_styles().items() if re.search(rf"\b{style.split()[-1]}\b", text)]
    used += [NUMBER[name] for name, pattern in USES.items() if re.search(pattern, text, re.MULTILINE)]
    return max(used)


def number_of_tester(name, numbers):
    """of the patch that a file of LAMMPS's testers comes with"""
    kind = {"atomic-pair-": "pair", "fix-timestep-": "fix"}
    for prefix, style in kind.items():
        if name.startswith(prefix):
            rest = name[len(prefix):].partition(".")[0]
            own = [words for words in numbers if words.startswith(f"{style} ") and
                   re.match(rf"{words.split()[1].replace('/', '_')}(?:_|$)", rest)]
            return numbers[max(own, key=len)]
    return NUMBER["fluid"]


def add_examples(tree):
    numbers = number_of_styles()
    text = ["Examples of the package SPH-DISSIPATION. Variables at the top of an input are set by -var NAME VALUE.\n"]
    for folder in sorted(path for path in (ROOT / "examples").iterdir() if (path / "README.md").exists()):
        if not tree.comes(number_of_example(folder)):
            continue
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
        if tree.comes(number_of_tester(file.name, numbers)):
            tree.add_text(f"unittest/force-styles/tests/{file.name}", with_epsilon_of_lammps(file.read_text(encoding="utf-8")))


def with_epsilon_of_lammps(text):
    """LAMMPS's testers compare each number with itself, also one that is small by cancellation; ours compares with the largest one."""
    return re.sub(r"^epsilon: (\S+)", lambda one: f"epsilon: {100 * float(one[1]):.3g}", text, flags=re.MULTILINE)


STEPS = (add_sources, add_styles, add_pages, add_examples)


def make_tree(lammps, target, upto, version, author):
    tree = Tree(lammps, target, upto, version, author)
    add_core(tree)
    if tree.comes(NUMBER["fluid"]):
        for step in STEPS:
            step(tree)
    return tree


def contents(changed):
    """What a patch has, for its text: {kind of file: number of new files and lines}."""
    kinds = {"C++ sources": r"src/.*\.(?:cpp|h)$", "pages of the manual": r"doc/src/\w+\.rst$", "files of reference data and inputs for the testers": "unittest/",
             "inputs of examples": r"examples/.*/in\.[^/]*$"}
    for kind, pattern in kinds.items():
        lines = [after.count("\n") for path, (before, after) in changed.items() if before is None and re.match(pattern, path)]
        if lines:
            yield f"  {len(lines)} {kind}, {sum(lines)} lines"
    if any(before is not None for before, _ in changed.values()):
        yield "  changed: " + ", ".join(path for path, (before, _) in sorted(changed.items()) if before is not None)


def patch_text(number, changed, author):
    """Its text as `git am` reads it; `git apply` skips it."""
    name = PATCHES[number - 1][0]
    title, _, text = (TEXTS / f"{name}.txt").read_text(encoding="utf-8").partition("\n")
    wrap = textwrap.TextWrapper(width=78, initial_indent="  ", subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)
    listed = "\n".join(wrap.fill(line.strip()) for line in contents(changed))
    sender = f"From: {author}\n" if author else ""
    return f"{sender}Subject: [PATCH {number}/{LAST}] {title}\n\n{text.strip()}\n\nContents:\n\n{listed}\n---\n"


def write_patch(number, before, after, source, patch, author):
    """The difference between two trees."""
    with tempfile.TemporaryDirectory() as folder:
        changed = {}
        for file in sorted(path for path in after.rglob("*") if path.is_file()):
            path = str(file.relative_to(after))
            old = next((tree / path for tree in (before, source) if tree and (tree / path).exists()), None)
            if old and old.read_bytes() == file.read_bytes():
                continue
            is_text = file.suffix not in (".png", ".jpg", ".gif")
            changed[path] = tuple(place and (place.read_text(encoding="utf-8") if is_text else "") for place in (old, file))
            for place, side in ((old, "a"), (file, "b")):
                if place:
                    Path(folder, side, path).parent.mkdir(parents=True, exist_ok=True)
                    shutil.copy2(place, Path(folder, side, path))
        done = subprocess.run(["git", "diff", "--no-index", "--binary", "--no-prefix", "--no-color", "a", "b"],
                              cwd=folder, stdout=subprocess.PIPE, env={"PATH": "/usr/bin:/bin", "GIT_CONFIG_NOSYSTEM": "1", "HOME": folder})
        if done.returncode != 1:
            raise SystemExit("upstream: git diff failed")
    patch.write_bytes(patch_text(number, changed, author).encode() + done.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lammps", type=Path)
    parser.add_argument("folder", type=Path, help="for the patches; those of an earlier call are removed")
    parser.add_argument("--tree", type=Path, metavar="DIR", help="folder for the files, made or filled up")
    parser.add_argument("--upto", type=int, choices=range(1, LAST + 1), default=LAST, metavar="N", help="the first N patches only")
    parser.add_argument("--version", metavar="TAG", default="TBD", help="in which the styles are new (%(default)s)")
    parser.add_argument("--author", metavar="'NAME <ADDRESS>'", help="for the sources and the patches, as LAMMPS requires")
    args = parser.parse_args()
    version = args.lammps / "src" / "version.h"
    if not version.exists() or '"4 Jul 2026"' not in version.read_text():
        raise SystemExit(f"upstream: {args.lammps} is no source tree of LAMMPS 4 Jul 2026")
    if not (args.lammps / "doc" / "src").is_dir():
        raise SystemExit(f"upstream: {args.lammps} comes without the sources of the manual")
    args.folder.mkdir(parents=True, exist_ok=True)
    for old in args.folder.glob("0*.patch"):
        old.unlink()
    lammps = args.lammps.resolve()
    with tempfile.TemporaryDirectory() as folder:
        before = None
        for number in range(1, args.upto + 1):
            after = Path(folder, str(number))
            make_tree(lammps, after, number, args.version, args.author)
            patch = args.folder / f"{number:04}-{PATCHES[number - 1][0]}.patch"
            write_patch(number, before, after, lammps, patch, args.author)
            print(patch)
            before = after
        if args.tree:
            shutil.copytree(before, args.tree, dirs_exist_ok=True)
    print("Apply them in this order with  git apply  in a tree of LAMMPS 4 Jul 2026.")


if __name__ == "__main__":
    sys.exit(main())
