"""Copies the package into a LAMMPS tree (of links) and runs the checks of LAMMPS's `make check` with and without it.

What they find with the package only must be its registration in LAMMPS's lists; that is printed.
Exit status: 0 if there is nothing else, 1 if there is, 77 if this LAMMPS comes without its checks.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("src", "doc", "tools/coding_standard")
CHECKS = {name: [sys.executable, f"tools/coding_standard/{name}.py", "."]
          for name in ("whitespace", "permissions", "homepage", "errordocs", "fmtlib")}
CHECKS.update({
    "anchor_check": "python3 utils/converters/lammpsdoc/rst_anchor_check.py src/*.rst",
    "style_check": "python3 utils/check-styles.py -s ../src -d src",
    "package_check": "python3 utils/check-packages.py -s ../src -d src",
    "char_check": "make -s char_check",
    "role_check": "make -s role_check",
})
REGISTRATION = re.compile(r"\w+ (style|index) entry sph/\w+ is missing( or incomplete in \w+\.rst)?$"
                          r"|Package SPH-DISSIPATION missing in \w+\.rst$")
SUMMARY = re.compile(r"(Found|Parsed|Total|No) |\W*$|make.*:| +\w+ styles: ")


def link_tree(source, target):
    """A tree of links to the files of LAMMPS."""
    for folder in FOLDERS:
        (target / folder).parent.mkdir(parents=True, exist_ok=True)
        shutil.copytree(source / folder, target / folder, copy_function=os.symlink, symlinks=True)


def add_package(target):
    shutil.copytree(ROOT / "src" / "SPH-DISSIPATION", target / "src" / "SPH-DISSIPATION")
    for page in (ROOT / "doc" / "src").glob("*.rst"):
        if page.name != "index.rst":
            assert not (target / "doc" / "src" / page.name).exists(), f"LAMMPS has a page {page.name} of its own"
            shutil.copy(page, target / "doc" / "src")
    shutil.copytree(ROOT / "unittest" / "force-styles" / "tests", target / "unittest" / "force-styles" / "tests")
    shutil.copytree(ROOT / "examples", target / "examples" / "PACKAGES" / "sph-dissipation",
                    ignore=shutil.ignore_patterns("__pycache__"))


def findings(tree, check):
    in_doc = isinstance(check, str)
    command = ["bash", "-c", check.replace("python3", f'"{sys.executable}"')] if in_doc else check
    done = subprocess.run(command, cwd=tree / "doc" if in_doc else tree, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, errors="replace")
    if "Traceback" in done.stdout:
        sys.exit(f"{command} failed:\n{done.stdout}")
    lines = {line.replace(str(tree), "").rstrip() for line in done.stdout.splitlines()}
    return {line for line in lines if not SUMMARY.match(line)}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("lammps", type=Path)
    parser.add_argument("folder", type=Path, help="for the two trees; emptied first")
    args = parser.parse_args()
    if not all((args.lammps / name).exists() for name in ("tools/coding_standard", "doc/utils/check-styles.py", "doc/Makefile")):
        print("this LAMMPS comes without its checks")
        sys.exit(77)
    shutil.rmtree(args.folder, ignore_errors=True)
    plain, package = args.folder.resolve() / "plain", args.folder.resolve() / "package"
    for tree in (plain, package):
        link_tree(args.lammps.resolve(), tree)
    add_package(package)

    failed = False
    for name, check in CHECKS.items():
        for line in sorted(findings(package, check) - findings(plain, check)):
            registration = REGISTRATION.match(line)
            failed = failed or not registration
            print(f"{'to register' if registration else 'FOUND'} ({name}): {line}")
    if failed:
        sys.exit(1)
    shutil.rmtree(args.folder)


main()
