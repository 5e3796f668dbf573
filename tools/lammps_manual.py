#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Builds LAMMPS's own manual with the package in it, and tells what Sphinx says about the package.

    lammps_manual.py LAMMPS FOLDER [--part] [--upto N]

LAMMPS is an unmodified tree of 4 Jul 2026, which is only read; FOLDER is emptied first, the manual is in FOLDER/html. With --part
only the pages that tools/upstream.py adds or changes, and the lists that lead to them, are built: seconds in the place of minutes.

LAMMPS asks for a Sphinx and for extensions that a distribution may not have. In a copy of its configuration what is
missing is switched off, and listed. Exit status 1 if there is a warning about a page that is added or changed, but for
directives and roles of extensions that are off, and, with --part, for links to pages and labels that are there, but left out;
77 if LAMMPS is another version or comes without its manual.
"""
import argparse
import importlib.util
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

GLOBBED = "utils/make-globbed-tocs.py"    # writes the lists of all styles
FIRST = "Manual"


def without_missing(doc):
    """Switches off what is missing; returns what that is."""
    import sphinx

    folder = doc / "utils" / "sphinx-config"
    text = (folder / "conf.py.in").read_text()
    for name, path in (("LAMMPS_DOC_DIR", doc), ("LAMMPS_SOURCE_DIR", doc.parent / "src"), ("LAMMPS_PYTHON_DIR", doc.parent / "python"),
                       ("DOXYGEN_XML_DIR", doc / "doxygen" / "xml")):
        text = text.replace(f"@{name}@", str(path))
    off = []
    listed = re.search(r"^extensions = \[(.*?)\]", text, re.MULTILINE | re.DOTALL)
    kept = []
    for name in re.findall(r"'([\w.]+)'", listed[1]):
        own = name == "lammps_theme" or (doc / "src" / "_ext" / f"{name}.py").exists()
        if name == "breathe":
            off.append("breathe (would need the output of doxygen)")
        elif own or importlib.util.find_spec(name.split(".")[0]) and importlib.util.find_spec(name):
            kept.append(name)
        else:
            off.append(name)
    text = text.replace(listed[0], f"extensions = {kept!r}")
    theme = folder / "_themes" / "lammps_theme"
    wanted = r"app\.require_sphinx\('(\d+)\.(\d+)'\)"
    needs = tuple(map(int, re.search(wanted, (theme / "__init__.py").read_text()).groups()))
    if sphinx.version_info < needs:
        off.append(f"the theme's demand for Sphinx {needs[0]}.{needs[1]}: here it is {sphinx.__version__}")
        (theme / "__init__.py").write_text(re.sub(wanted, "", (theme / "__init__.py").read_text()))
    shutil.copyfile(theme / "local_search.html", theme / "search.html")
    (folder / "conf.py").write_text(text)
    return off


def leave_out(doc, pages):
    """Builds these pages and those whose tables of contents lead to them, up to the first one."""
    entries = {page.stem: set(re.findall(r"^   (\w+)$", page.read_text(), re.MULTILINE)) for page in (doc / "src").glob("*.rst")}
    kept, more = set(), set(pages)
    while more:
        kept |= more
        more = {page for page, names in entries.items() if names & more} - kept
    rest = sorted(f"{page}.rst" for page in entries.keys() - kept)
    conf = doc / "utils" / "sphinx-config" / "conf.py"
    conf.write_text(conf.read_text() + f"\nexclude_patterns += {rest!r}\n")
    return {name[:-len(".rst")] for name in rest}


def is_known(message, source, left_out, labels):
    """Warnings that come from what is switched off or left out."""
    if re.search(r"Unknown (directive type|interpreted text role)|No (directive entry|role entry)", message):
        return True
    link = re.search(r"unknown document: '?([\w./]+)|excluded document '([\w./]+)'", message)
    if link:
        return (link[1] or link[2]) in left_out
    label = re.search(r"undefined label: '?([^\s']+)", message)
    return bool(label) and label[1].lower() in labels and bool(left_out)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lammps", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--part", action="store_true", help="only the pages that the patches add or changes")
    parser.add_argument("--upto", metavar="N", help="the first N patches only")
    parser.add_argument("--jobs", default="1", metavar="N", help="processes (%(default)s)")
    args = parser.parse_args()
    lammps, folder = args.lammps.resolve(), args.folder.resolve()
    if not (lammps / "doc" / GLOBBED).exists() or '"4 Jul 2026"' not in (lammps / "src" / "version.h").read_text():
        print("no manual of LAMMPS 4 Jul 2026 in", lammps)
        sys.exit(77)
    shutil.rmtree(folder, ignore_errors=True)
    changed, doc = folder / "changed", folder / "tree" / "doc"
    subprocess.run([sys.executable, str(ROOT / "tools" / "upstream.py"), str(lammps), str(folder / "patches"),
                    "--tree", str(changed), *(["--upto", args.upto] if args.upto else [])], check=True, stdout=subprocess.DEVNULL)
    shutil.copytree(lammps / "doc", doc)
    for name in ("src", "python", "fortran", "examples"):
        (doc.parent / name).symlink_to(lammps / name)
    shutil.copytree(changed / "doc", doc, dirs_exist_ok=True)
    subprocess.run([sys.executable, str(doc / GLOBBED), "-d", str(doc / "src")], check=True, stdout=subprocess.DEVNULL)

    for what in without_missing(doc):
        print(f"switched off: {what}")
    pages = {page.stem for page in (changed / "doc" / "src").glob("*.rst")}
    left_out = leave_out(doc, pages) if args.part else set()
    labels = {label.strip("`").lower() for page in left_out
              for label in re.findall(r"^ *\.\. _([^:\n]+):$", (doc / "src" / f"{page}.rst").read_text(), re.MULTILINE)}
    log = folder / "warnings.txt"
    done = subprocess.run([sys.executable, "-m", "sphinx", "-q", "-E", "-j", args.jobs, "-b", "html", "-w", str(log),
                           "-c", str(doc / "utils" / "sphinx-config"), "-d", str(folder / "doctrees"), str(doc / "src"),
                           str(folder / "html")], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    if done.returncode != 0 or not (folder / "html" / f"{FIRST}.html").exists():
        sys.exit(f"Sphinx failed, see {log}:\n{log.read_text()[-3000:] if log.exists() else ''}")
    built = {page.stem for page in (folder / "html").glob("*.html")}
    found = [f"not built: {page}" for page in sorted(pages - built)]
    for source, line, message in re.findall(r"^(?:\S*/)?(\w+)\.rst:(\d*):? ?((?:WARNING|ERROR|CRITICAL|SEVERE).*)", log.read_text(),
                                            re.MULTILINE):
        if source in pages and not is_known(message, source, left_out, labels):
            found.append(f"{source}.rst:{line} {message}")
    for line in found:
        print(f"FOUND: {line}")
    print(f"{len(pages)} pages of the patches in {folder / 'html' / FIRST}.html; all that Sphinx says: {log}")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
