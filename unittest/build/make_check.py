"""The package in a LAMMPS tree, as the patches of tools/upstream.py put it there, before the checks that LAMMPS makes of itself: `make
check` and the spelling of the manual. The tree is one of links; what the checks find without the package does not count.

Exit status: 0 if nothing is found, 1 if something is, 77 if this LAMMPS comes without its checks.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

from upstream import LAST      # noqa: E402

FOLDERS = ("src", "doc", "cmake", "examples/PACKAGES", "potentials", "unittest/force-styles/tests")
FILE_CHECKS = ("whitespace", "permissions", "homepage", "errordocs", "fmtlib", "versiontags")
MANUAL_CHECKS = {
    "anchor_check": "python3 utils/converters/lammpsdoc/rst_anchor_check.py src/*.rst",
    "style_check": "python3 utils/check-styles.py -s ../src -d src",
    "package_check": "python3 utils/check-packages.py -s ../src -d src",
    "char_check": "make -s char_check",
    "role_check": "make -s role_check",
}
SUMMARY = re.compile(r"(Found|Parsed|Total|No) |\W*$|make.*:| +\w+ styles: ")


def link_tree(source, target):
    """A tree of links to the files of LAMMPS."""
    for folder in FOLDERS:
        shutil.copytree(source / folder, target / folder, copy_function=os.symlink, symlinks=True)


def add_files(source, target):
    """Files of source in the place of links of target."""
    for file in (path for path in source.rglob("*") if path.is_file()):
        place = target / file.relative_to(source)
        place.parent.mkdir(parents=True, exist_ok=True)
        place.unlink(missing_ok=True)
        shutil.copy2(file, place)


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


def check_spelling(tree, folder):
    """Words of the package's pages that are neither in the dictionary nor in LAMMPS's list of words, as the patch has it."""
    sphinx = shutil.which("sphinx-build", path="/usr/bin:" + os.environ.get("PATH", ""))
    has = sphinx and subprocess.run(["/usr/bin/python3", "-c", "import sphinxcontrib.spelling, enchant; enchant.Dict('en_US')"],
                                    stderr=subprocess.DEVNULL).returncode == 0
    if not has:
        print("spelling: not checked, sphinxcontrib.spelling or the dictionary en_US is missing")
        return
    words = tree / "doc" / "utils" / "sphinx-config" / "false_positives.txt"
    subprocess.run([sphinx, "-q", "-b", "spelling", "-D", "spelling_lang=en_US", "-D", f"spelling_word_list_filename={words}",
                    "-D", "extensions=sphinx.ext.mathjax,lammps_pages,sphinxcontrib.spelling",
                    str(ROOT / "doc" / "src"), str(folder)],
                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    results = sorted(folder.rglob("*.spelling"))
    if not (folder / ".doctrees").exists():
        sys.exit("spelling: sphinx-build failed")
    yield from (("spelling", line) for file in results for line in file.read_text().splitlines())


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("lammps", type=Path)
    parser.add_argument("folder", type=Path, help="for the trees; emptied first")
    args = parser.parse_args()
    lammps, folder = args.lammps.resolve(), args.folder.resolve()
    if not all((lammps / name).exists() for name in ("tools/coding_standard", "doc/utils/check-styles.py", "doc/Makefile")):
        print("this LAMMPS comes without its checks")
        sys.exit(77)
    if '"4 Jul 2026"' not in (lammps / "src" / "version.h").read_text():
        print("the patch is for LAMMPS 4 Jul 2026")
        sys.exit(77)
    shutil.rmtree(folder, ignore_errors=True)
    plain, found = folder / "plain", []
    link_tree(lammps, plain)
    for patches in range(1, LAST + 1):    # each patch leaves a manual without faults
        changed, package = folder / f"changed{patches}", folder / f"package{patches}"
        subprocess.run([sys.executable, str(ROOT / "tools" / "upstream.py"), str(lammps), str(folder / "patches"), "--tree", str(changed),
                        "--upto", str(patches), "--version", "4Jul2026"], check=True, stdout=subprocess.DEVNULL)
        link_tree(lammps, package)
        add_files(changed, package)
        found += [(f"{name} with {patches} patches", line) for name, line in check_manual(plain, package)]
    found += [*check_files(lammps, changed), *check_spelling(package, folder / "spelling")]
    found.sort()
    for name, line in found:
        print(f"FOUND ({name}): {line}")
    if found:
        sys.exit(1)
    shutil.rmtree(folder)


main()
