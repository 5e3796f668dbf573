#!/usr/bin/env python3
"""The code of a GPU, compiled by nvcc for an H100; no GPU is needed. All sources of src/KOKKOS compile, which those of a host do not show:
there, a function for the host alone is a function for the device as well. Both pair loops read the row of a neighbor by loads of 16
bytes, three and four, and spill no register.

    python3 unittest/kokkos/cuda.py SOURCES LAMMPS KOKKOS FOLDER       of the package, of LAMMPS 4 Jul 2026, of Kokkos; nvcc is on the PATH
"""

import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

ARCHITECTURE = "sm_90", "HOPPER90"
LOADS = {"DensityLoop": 3, "ForceLoop": 4}  # of 16 bytes, for each neighbor: vol and g are not in the sums of pass 1


def output_of(*command, cwd=None):
    """What a command prints; ends the test if the command fails."""
    run = subprocess.run([str(word) for word in command], cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if run.returncode:
        sys.exit(f"{' '.join(map(str, command))[:300]} ... failed:\n{run.stdout[-6000:]}")
    return run.stdout


def configure(sources, lammps, kokkos, folder):
    output_of("cmake", "--preset", "release", "-B", folder, "-D", f"LAMMPS_SOURCE_DIR={lammps}", "-D", f"SPH_DISSIPATION_KOKKOS={kokkos}",
              "-D", f"CMAKE_CXX_COMPILER={kokkos / 'bin' / 'nvcc_wrapper'}", "-D", "CMAKE_CXX_STANDARD=20", "-D", "PKG_KOKKOS=ON",
              "-D", "Kokkos_ENABLE_SERIAL=ON", "-D", "Kokkos_ENABLE_CUDA=ON", "-D", f"Kokkos_ARCH_{ARCHITECTURE[1]}=ON",
              "-D", "SPH_DISSIPATION_TESTS=OFF", cwd=sources)


def compile_all(folder):
    """The objects of src/KOKKOS; returns the options of the compiler."""
    commands = [one for one in json.loads(output_of("ninja", "-t", "compdb", cwd=folder)) if "/package/src/KOKKOS/" in one["file"]]
    output_of("ninja", *(one["output"] for one in commands), cwd=folder)
    words = shlex.split(commands[0]["command"])
    return [word for word in words[1:words.index("-MD")] if word != "-fPIC" and not word.startswith("-W")]


def check_loops(folder, options):
    ptx = folder / "loops.ptx"
    output_of("nvcc", "-x", "cu", *options, "-ptx", "-o", ptx, Path(__file__).with_name("loops.cpp"), cwd=folder)
    resources = output_of("ptxas", "-v", "-arch", ARCHITECTURE[0], ptx, "-o", os.devnull)
    wrong = []
    for loop, wanted in LOADS.items():
        body, = re.findall(rf"\.entry \w*{loop}Kokkos\w*\(.*?\n}}", ptx.read_text(), re.S)
        inner = body[body.find("ld.global.nc.v2.f64"):]  # some neighbors, one after the other
        neighbors = len(re.findall(r"setp\.(?:ge|geu|lt|ltu)\.f64[^;]*;\s*@!?%p\d+ bra", inner))  # inside the support?
        loads, own = inner.count("ld.global.nc.v2.f64"), inner.count("ld.global.v2.f64")
        stack, = re.findall(rf"Function properties for \w*{loop}Kokkos.*?\n\s*(.*)", resources)
        registers, = re.findall(rf"Compiling entry function '\w*{loop}Kokkos[^']*'.*?Used (\d+) registers", resources, re.S)
        print(f"{loop}: {loads} loads of 16 bytes for {neighbors} neighbors, {registers} registers, {stack}")
        if not neighbors or loads != wanted * neighbors:
            wrong.append(f"{loop}: not {wanted} loads for each neighbor")
        if own:
            wrong.append(f"{loop}: its own row is read again for each neighbor")
        if re.search(r"[1-9]", stack):
            wrong.append(f"{loop}: registers are spilled")
    return wrong


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    sources, lammps, kokkos, folder = (Path(name).resolve() for name in sys.argv[1:])
    configure(sources, lammps, kokkos, folder)
    wrong = check_loops(folder, compile_all(folder))
    sys.exit("\n".join(wrong) or 0)


if __name__ == "__main__":
    main()
