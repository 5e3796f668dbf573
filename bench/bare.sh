#!/usr/bin/env bash
# The /kk styles on a machine with a GPU and CUDA, but without network and without MPI: brings along LAMMPS, its stand-in for MPI
# (src/STUBS), and Kokkos.
#
#   bench/bare.sh pack sph-dissipation-bare.tar.xz     here: about 5 MB, of this clone as it is committed
#   tar xf sph-dissipation-bare.tar.xz                 there, in an empty folder; then
#   sph-dissipation/bench/bare.sh run                  there: builds, tests, times
#   sph-dissipation/bench/bare.sh run serial           ... for the processor, where there is no GPU
#
# There: GCC for C++20, CMake 3.20 or newer, Ninja or make, Python 3; for the tests numpy and pytest. Each part of "run" may be called alone:
# build, test, bench. A build that was interrupted goes on where it ended.
#   LAMMPS_SOURCE_DIR, SPHD_KOKKOS   (pack) source trees of LAMMPS 4 Jul 2026 and Kokkos (default: those of ./sphd); a tarball of Kokkos is taken, too
#   SPHD_KOKKOS_ARCH   the GPU in the words of Kokkos, HOPPER90, AMPERE80, ... (default: asks nvidia-smi)
#   SPHD_JOBS          compilers at once (default: one for each processor)
#   SPHD_BARE_BUILD    folder of the build (default: build-bare beside the unpacked folders)
set -euo pipefail

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
top=${root%/*}
tree=${SPHD_BARE_BUILD:-$top/build-bare}

die() { printf 'bare.sh: %s\n' "$*" >&2; exit 1; }

pack() {
  [[ $# -eq 1 ]] || die "name the archive: bare.sh pack FILE.tar.xz"
  local lammps=${LAMMPS_SOURCE_DIR:-${SPHD_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/sph-dissipation}/lammps/4Jul2026}
  local kokkos=${SPHD_KOKKOS:-$lammps/lib/kokkos} package
  [[ -e $lammps/src/KOKKOS ]] || die "no LAMMPS with KOKKOS in $lammps: name its source tree by LAMMPS_SOURCE_DIR"
  [[ -e $kokkos ]] || die "no Kokkos in $kokkos: name a source tree or a tarball by SPHD_KOKKOS"
  scratch=$(mktemp -d)    # not local: removed at the end
  trap 'rm -rf "$scratch"' EXIT
  mkdir -p "$scratch/lammps/src" "$scratch/lammps/lib" "$scratch/kokkos"
  git -C "$root" archive --prefix=sph-dissipation/ HEAD | tar -C "$scratch" -x --exclude='*.gif' --exclude='*.png' --exclude='log.*'
  # of LAMMPS what the build reads: the core, the packages below, and the names of all packages
  cp -r "$lammps"/{LICENSE,README,cmake} "$scratch/lammps"
  for package in third_party tools/offline python/lammps; do
    if [[ -d $lammps/$package ]]; then mkdir -p "$scratch/lammps/${package%/*}" && cp -r "$lammps/$package" "$scratch/lammps/$package"; fi
  done
  cp "$lammps"/src/*.{cpp,h} "$scratch/lammps/src"
  cp -r "$lammps"/src/[a-z]*/ "$scratch/lammps/src"    # libraries that LAMMPS contains
  for package in STUBS KOKKOS KSPACE SPH DPD-SMOOTH PLUGIN; do cp -r "$lammps/src/$package" "$scratch/lammps/src"; done
  if [[ -d $kokkos ]]; then
    cp -r "$kokkos"/. "$scratch/kokkos"
  else
    tar -C "$scratch/kokkos" --strip-components=1 -xf "$kokkos"
  fi
  tar -C "$scratch" -cJf "$1" sph-dissipation lammps kokkos
  printf '%s: %s\n' "$1" "$(du -h "$1" | cut -f1)"
}

# architecture: the GPU of this machine in the words of Kokkos
architecture() {
  local capability
  capability=$(nvidia-smi --query-gpu=compute_cap --format=csv,noheader 2>/dev/null | head -n 1) ||
    die "nvidia-smi finds no GPU: name it by SPHD_KOKKOS_ARCH, or say: bare.sh run serial"
  case $capability in
    7.0) echo VOLTA70 ;;
    7.5) echo TURING75 ;;
    8.0) echo AMPERE80 ;;
    8.6) echo AMPERE86 ;;
    8.9) echo ADA89 ;;
    9.0) echo HOPPER90 ;;
    10.0) echo BLACKWELL100 ;;
    12.0) echo BLACKWELL120 ;;
    *) die "compute capability \"$capability\": name the GPU by SPHD_KOKKOS_ARCH" ;;
  esac
}

configure() {
  local settings=(-S "$root" -B "$tree" -D CMAKE_BUILD_TYPE=Release -D "LAMMPS_SOURCE_DIR=$top/lammps" -D "SPH_DISSIPATION_KOKKOS=$top/kokkos"
    -D BUILD_MPI=OFF -D PKG_KOKKOS=ON -D CMAKE_CXX_STANDARD=20 -D Kokkos_ENABLE_SERIAL=ON -D FFT=KISS -D FFT_KOKKOS=KISS)
  if command -v ninja >/dev/null; then settings+=(-G Ninja); fi
  if [[ $backend == cuda ]]; then
    command -v nvcc >/dev/null || die "no nvcc on the PATH"
    local arch=${SPHD_KOKKOS_ARCH:-}
    if [[ -z $arch ]]; then arch=$(architecture); fi
    chmod +x "$top/kokkos/bin/nvcc_wrapper"
    settings+=(-D Kokkos_ENABLE_CUDA=ON -D "Kokkos_ARCH_$arch=ON" -D "CMAKE_CXX_COMPILER=$top/kokkos/bin/nvcc_wrapper")
  fi
  cmake "${settings[@]}"
}

build() {
  [[ -d $top/lammps && -d $top/kokkos ]] || die "no folders lammps and kokkos beside $root: unpack what \"bare.sh pack\" has made"
  # once: with each configuration CMake writes the headers of LAMMPS's styles anew
  if [[ ! -e $tree/CMakeCache.txt ]]; then configure || { rm -f "$tree/CMakeCache.txt"; die "configuring failed"; }; fi
  cmake --build "$tree" --target lmp -j "${SPHD_JOBS:-$(nproc)}"
}

switches() { if [[ $backend == cuda ]]; then echo "-k on g 1 -sf kk -pk kokkos neigh half newton on"; else echo "-k on -sf kk/device"; fi; }

# the /kk styles against the CPU styles, on one rank
tests() {
  if ! python3 -c 'import numpy, pytest' 2>/dev/null; then
    echo "bare.sh: no numpy or no pytest: the tests are left out"
    return
  fi
  SPHD_LMP=$tree/lmp SPHD_MPIEXEC=none SPHD_SWITCHES=$(switches) PYTHONDONTWRITEBYTECODE=1 OMP_NUM_THREADS=1 \
    python3 -m pytest -q -p no:cacheprovider "$root/unittest/python/test_kokkos.py"
}

bench() {
  if [[ $backend == cuda ]]; then
    python3 "$root/bench/kokkos.py" --lmp "$tree/lmp" --repeat 3 --gpu
  else
    python3 "$root/bench/run.py" --lmp "$tree/lmp" --repeat 3 --ranks 1
  fi
}

command=${1:-}
backend=${2:-cuda}
case $command in
  pack) shift; pack "$@" ;;
  run | build | test | bench)
    [[ $backend == cuda || $backend == serial ]] || die "the backends are cuda and serial, not \"$backend\""
    if [[ $command == run || $command == build ]]; then build; fi
    if [[ $command == run || $command == test ]]; then tests; fi
    if [[ $command == run || $command == bench ]]; then bench; fi
    ;;
  *) sed -n '2,/^set/{/^#/s/^# \?//p}' "${BASH_SOURCE[0]}" ;;
esac
