"""Runs the checks of LAMMPS's `make check` on the package: those of single files on its own files, those of the manual on
a LAMMPS tree (of links) into which the package is copied, less what they find without it.

What they find must be the registration of the package in LAMMPS's lists; that is printed.
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
FOLDERS = ("src", "doc")
FILE_CHECKS = ("whitespace", "permissions", "homepage", "errordocs", "fmtlib")
MANUAL_CHECKS = {
    "anchor_check": "python3 utils/converters/lammpsdoc/rst_anchor_check.py src/*.rst",
    "style_check": "python3 utils/check-styles.py -s ../src -d src",
    "package_check": "python3 utils/check-packages.py -s ../src -d src",
    "char_check": "make -s char_check",
    "role_check": "make -s role_check",
}
REGISTRATION = re.compile(r"\w+ (style|index) entry sph/\w+ is missing( or incomplete in \w+\.rst)?$"
                          r"|Package SPH-DISSIPATION missing in \w+\.rst$")
SUMMARY = re.compile(r"(Found|Parsed|Total|No) |\W*$|make.*:| +\w+ styles: ")


def link_tree(source, target):
    """A tree of links to the files of LAMMPS."""
    for folder in FOLDERS:
        shutil.copytree(source / folder, target / folder, copy_function=os.symlink, symlinks=True)


def add_package(target):
    shutil.copytree(ROOT / "src" / "SPH-DISSIPATION", target / "src" / "SPH-DISSIPATION")
    (target / "doc" / "src").mkdir(parents=True, exist_ok=True)
    for page in (ROOT / "doc" / "src").glob("*.rst"):
        if page.name != "index.rst":
            assert not (target / "doc" / "src" / page.name).exists(), f"LAMMPS has a page {page.name} of its own"
            shutil.copy(page, target / "doc" / "src")
    shutil.copytree(ROOT / "unittest" / "force-styles" / "tests", target / "unittest" / "force-styles" / "tests")
    shutil.copytree(ROOT / "examples", target / "examples" / "PACKAGES" / "sph-dissipation",
                    ignore=shutil.ignore_patterns("__pycache__"))


def findings(command, folder, tree):
    done = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, errors="replace")
    if "Traceback" in done.stdout:
        sys.exit(f"{command} failed:\n{done.stdout}")
    lines = {line.replace(str(tree), "").rstrip() for line in done.stdout.splitlines()}
    return {line for line in lines if not SUMMARY.match(line)}


def check_files(lammps, tree):
    for name in FILE_CHECKS:
        command = [sys.executable, str(lammps / "tools" / "coding_standard" / f"{name}.py"), "."]
        yield from ((name, line) for line in findings(command, tree, tree))


def check_manual(plain, package):
    for name, check in MANUAL_CHECKS.items():
        command = ["bash", "-c", check.replace("python3", f'"{sys.executable}"')]
        with_package, without = (findings(command, tree / "doc", tree) for tree in (package, plain))
        yield from ((name, line) for line in with_package - without)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("lammps", type=Path)
    parser.add_argument("folder", type=Path, help="for the trees; emptied first")
    args = parser.parse_args()
    lammps, folder = args.lammps.resolve(), args.folder.resolve()
    if not all((lammps / name).exists() for name in ("tools/coding_standard", "doc/utils/check-styles.py", "doc/Makefile")):
        print("this LAMMPS comes without its checks")
        sys.exit(77)
    shutil.rmtree(folder, ignore_errors=True)
    alone, plain, package = folder / "alone", folder / "plain", folder / "package"
    for tree in (plain, package):
        link_tree(lammps, tree)
    for tree in (alone, package):
        add_package(tree)

    failed = False
    for name, line in sorted([*check_files(lammps, alone), *check_manual(plain, package)]):
        registration = REGISTRATION.match(line)
        failed = failed or not registration
        print(f"{'to register' if registration else 'FOUND'} ({name}): {line}")
    if failed:
        sys.exit(1)
    shutil.rmtree(folder)


main()
