#!/usr/bin/env bash
# ways.sh WAY LAMMPS TREE: builds LAMMPS with the package by one of the ways that README.md describes, in the folder
# TREE, and runs the smoke input. LAMMPS is the source tree, which stays as it is. WAY is hook, make or plugin.
# Environment: ROOT (the package's repository), PYTHON, REFERENCE (result of the smoke input to compare with), LAUNCHER
# (compiler cache, may be empty), SPHD_JOBS.
set -euo pipefail

way=$1 lammps=$2 tree=$3
jobs=${SPHD_JOBS:-$(nproc)}
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
mkdir -p "$tree"
cd "$tree"
# Package and LAMMPS under names that are the same in every build folder: so the compiler cache serves all of them.
mkdir -p package
ln -sfn "$ROOT/cmake" package/cmake
ln -sfn "$ROOT/src" package/src

configure() {    # SOURCE BUILD [options]
  local source=$1 build=$2
  shift 2
  mkdir -p "$build"
  ln -sfn "$lammps" "$build/lammps-source"
  cmake -S "$source" -B "$build" -G Ninja -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_COMPILER_LAUNCHER="$LAUNCHER" \
    -D CMAKE_C_COMPILER_LAUNCHER="$LAUNCHER" "$@" >"$build.log" 2>&1 || { tail -n 30 "$build.log"; exit 1; }
}

lammps_by_cmake() {    # BUILD [options]
  local build=$1
  shift
  configure "$build/lammps-source/cmake" "$build" -D BUILD_SHARED_LIBS=on -D BUILD_OMP=off -D PKG_SPH=on -D PKG_DPD-SMOOTH=on \
    -D PKG_PLUGIN=on "$@"
  ninja -C "$build" -j "$jobs" lmp >>"$build.log" 2>&1 || { tail -n 30 "$build.log"; exit 1; }
}

smoke() {    # LMP RESULT [options]
  "$PYTHON" "$here/smoke.py" "$@" --reference "$REFERENCE"
}

# expect_error TEXT LMP ARGUMENTS: the run must stop with an error of LAMMPS that contains the text, not by a crash.
expect_error() {
  local text=$1 output code=0
  shift
  output=$("$@" -log none 2>&1 </dev/null) || code=$?
  if [[ $code -eq 0 || $code -ge 128 || $output != *ERROR*"$text"* ]]; then
    printf '%s\n' "$output"
    echo "$* stopped with code $code; expected was a LAMMPS error with: $text"
    exit 1
  fi
}

case $way in
  hook)
    lammps_by_cmake build -D PKG_SPH-DISSIPATION=on -D CMAKE_PROJECT_lammps_INCLUDE="$tree/package/cmake/SPH-DISSIPATION.cmake"
    smoke build/lmp smoke
    ;;

  make)
    if [[ ! -d lammps ]]; then
      mkdir copy
      cp -r "$lammps/src" copy
      mv copy lammps
    fi
    cp -r "$ROOT/src/SPH-DISSIPATION" lammps/src
    {
      make -C lammps/src yes-sph-dissipation
      make -C lammps/src -j "$jobs" mpi CC="${LAUNCHER//;/ } mpicxx"
    } >make.log 2>&1 || { tail -n 30 make.log; exit 1; }
    smoke lammps/src/lmp_mpi smoke
    ;;

  plugin)
    lammps_by_cmake build
    expect_error "Unrecognized atom style 'sph/bulk'" build/lmp -in "$here/in.smoke" -var result none
    configure "$ROOT/plugin" plugin -D LAMMPS_SOURCE_DIR="$lammps"
    ninja -C plugin -j "$jobs" >>plugin.log 2>&1 || { tail -n 30 plugin.log; exit 1; }
    plugin=$tree/plugin/sphdissipationplugin.so
    smoke build/lmp smoke --plugin "$plugin"
    # the same after "clear", which takes the atom style away until the plugin is loaded again
    printf '%s\n' "plugin load $plugin" "clear" "include $here/in.smoke" >in.clear
    expect_error "Unrecognized atom style 'sph/bulk'" build/lmp -in in.clear -var result none
    ;;

  *)
    echo "unknown way $way"
    exit 2
    ;;
esac
