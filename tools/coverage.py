#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Which lines of the C++ sources the tests run, by gcov.

    CXXFLAGS=--coverage ./sphd test         # or parts of it: -R NAME; a build folder of its own
    tools/coverage.py "$(dirname "$(readlink -f build/lmp)")"

Prints the table per file: lines, lines not run, share that is run; with --lines also the lines that no test runs.
A line that several objects contain, as those of headers, is run if it is in one of them.
"""
import argparse
import collections
import gzip
import json
import subprocess
import tempfile
from pathlib import Path


def counts(build):
    """{source: {line: times}} of the package's objects"""
    found = collections.defaultdict(collections.Counter)
    with tempfile.TemporaryDirectory() as folder:
        for data in sorted(build.rglob("*.gcda")):
            if "SPH-DISSIPATION" not in str(data):
                continue
            subprocess.run(["gcov", "--json-format", data], cwd=folder, check=True, capture_output=True)
            for report in Path(folder).glob("*.gcov.json.gz"):
                for file in json.loads(gzip.decompress(report.read_bytes()))["files"]:
                    if "/src/SPH-DISSIPATION/" in file["file"]:
                        for line in file["lines"]:
                            found[Path(file["file"]).name][line["line_number"]] += line["count"]
                report.unlink()
    return found


def ranges(lines):
    """[1, 2, 3, 7] as 1-3, 7"""
    groups = []
    for line in sorted(lines):
        if groups and line == groups[-1][1] + 1:
            groups[-1][1] = line
        else:
            groups.append([line, line])
    return ", ".join(f"{a}-{b}" if b > a else str(a) for a, b in groups)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path)
    parser.add_argument("--lines", action="store_true")
    options = parser.parse_args()
    total = missed = 0
    for name, lines in sorted(counts(options.build).items()):
        not_run = [line for line, times in lines.items() if not times]
        total, missed = total + len(lines), missed + len(not_run)
        print(f"{name:45s} {len(lines):5d} {len(not_run):5d} {1.0 - len(not_run) / len(lines):7.1%}")
        if options.lines and not_run:
            print(f"    {ranges(not_run)}")
    print(f"{'all':45s} {total:5d} {missed:5d} {1.0 - missed / total:7.1%}")


if __name__ == "__main__":
    main()
