#!/usr/bin/env python3
"""Copies of Kokkos and LAMMPS in which host and device each have their own copy of an array, as with a GPU, though the device is the
host (OpenMP; the host is Serial). So the tests find a field that is not synchronized, and one that both have modified, without a GPU.

    python3 unittest/kokkos/two_memories.py KOKKOS LAMMPS FOLDER        source trees of Kokkos and of LAMMPS 4 Jul 2026
    export SPHD_KOKKOS=FOLDER/kokkos LAMMPS_SOURCE_DIR=FOLDER/lammps
    ./sphd build --kokkos
    export SPHD_LMP=$PWD/build/lmp_kokkos OMP_NUM_THREADS=1
    SPHD_SWITCHES="-k on g 1 t 1 -sf kk -pk kokkos neigh half newton on gpu/aware off" \\
      python3 -m pytest -q -p no:cacheprovider unittest/python/test_kokkos.py

With "gpu/aware on", the messages are packed on the device.
"""

import re
import shutil
import sys
from pathlib import Path

HOST = "Kokkos::Device<Kokkos::Serial, Kokkos::HostSpace>"
MIRRORS = """
  template <class To, class From> static To copy_of(const From& from) {
    if constexpr (std::is_same_v<typename t_dev::execution_space, Kokkos::Serial>)
      return from;
    else
      return To(Kokkos::view_alloc(from.label()), from.layout());
  }
"""


def host_view(traits, access=""):
    memory = f", Kokkos::MemoryTraits<{access}>" if access else ""
    return f"View<typename t_dev::HostMirror::{traits}, typename t_dev::HostMirror::array_layout, {HOST}{memory}>"


# file: (pattern, replacement, how many times)
CHANGES = {
    "kokkos/containers/src/Kokkos_DualView.hpp": [
        (r"using t_host = typename t_dev::HostMirror;", f"using t_host = {host_view('data_type')};{MIRRORS}", 1),
        (r"using t_host_const = typename t_dev_const::HostMirror;", f"using t_host_const = {host_view('const_data_type')};", 1),
        (r"using t_host_const_randomread = typename t_dev_const_randomread::HostMirror;",
         f"using t_host_const_randomread = {host_view('const_data_type', 'Kokkos::RandomAccess')};", 1),
        (r"using t_host_const_randomread_um =\s*typename t_dev_const_randomread_um::HostMirror;",
         f"using t_host_const_randomread_um = {host_view('const_data_type', 'Kokkos::Unmanaged | Kokkos::RandomAccess')};", 1),
        (r"h_view\(create_mirror_view\(d_view\)\)", "h_view(copy_of<t_host>(d_view))", 1),
        (r"h_view =\s*(?:Kokkos::)?create_mirror_view\([^;]*d_view\);", "h_view = copy_of<t_host>(d_view);", 6),
        (r"d_view =\s*(?:Kokkos::)?create_mirror_view\([^;]*h_view\);", "d_view = copy_of<t_dev>(h_view);", 2)],
    "lammps/src/KOKKOS/kokkos_type.h": [
        (r"#if defined\(KOKKOS_ENABLE_CUDA\)[^\n]*\n#define LMP_KOKKOS_GPU", "#if 1\n#define LMP_KOKKOS_GPU", 1),
        (r"typedef Kokkos::HostSpace::execution_space LMPHostType;", "typedef Kokkos::Serial LMPHostType;", 1),
        (r"#ifdef KOKKOS_ENABLE_CUDA\ntemplate<>\nstruct ExecutionSpaceFromDevice<Kokkos::Cuda>",
         "#if 1\ntemplate<>\nstruct ExecutionSpaceFromDevice<Kokkos::OpenMP>", 1),
        (r"// create simple LMPDeviceSpace", "typedef Kokkos::OpenMP LMPDeviceSpace;\n// create simple LMPDeviceSpace", 1),
        (r"Kokkos::SpaceAccessibility<LMPDeviceType::memory_space,LMPHostType::memory_space>::accessible", "false", None)],
    # teams of as many threads as a GPU has
    "lammps/src/KOKKOS/comm_kokkos.cpp": [(r"if \(exec_space == Device\)(\s+team_size = 128;)", r"if (false)\1", 1)],
    "lammps/src/KOKKOS/npair_kokkos.cpp": [
        (r"\n( +)if \(ExecutionSpaceFromDevice<DeviceType>::space == Device\)", r"\n\1if (false)", 2)]}


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    kokkos, lammps, folder = map(Path, sys.argv[1:])
    shutil.copytree(kokkos, folder / "kokkos", symlinks=True)
    shutil.copytree(lammps, folder / "lammps", symlinks=True)
    for name, changes in CHANGES.items():
        text = (folder / name).read_text()
        for pattern, replacement, times in changes:
            text, found = re.subn(pattern, replacement, text)
            if found != times and (times or not found):
                sys.exit(f"{name}: {pattern} was found {found} times, not {times or 'at least once'}: another version of Kokkos or LAMMPS?")
        (folder / name).write_text(text)


if __name__ == "__main__":
    main()
