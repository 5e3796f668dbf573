#!/usr/bin/env bash
# ways.sh WAY LAMMPS TREE: builds LAMMPS with the package by one of the ways that README.md describes, in the folder
# TREE, and runs the smoke input. WAY is hook, make or plugin, or upstream: the patches that make the package a part of
# LAMMPS, without the hook, one after the other: each is compiled, and runs LAMMPS's own testers of styles on the package's reference
# data; LAMMPS is a version to obtain, 26 or 25, or the folder of a source tree. WAY mismatch compiles
# a plugin for another version than that of the LAMMPS which WAY plugin left in TREE.
# Environment: ROOT (the package's repository), PYTHON, REFERENCE (result of the smoke input to compare with), LAUNCHER
# (ccache, or empty), SPHD_JOBS, SPHD_CACHE, GOOGLETEST (folder of its sources, or empty: no testers).
set -euo pipefail
export CCACHE_DIR=$SPHD_CACHE/ccache

here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
jobs=${SPHD_JOBS:-$(nproc)}

# expect_error TEXT COMMAND: LAMMPS must stop with an error message that has the text, not by a crash.
expect_error() {
  local text=$1 output code=0
  shift
  output=$("$@" -log none 2>&1 </dev/null) || code=$?
  if [[ $code -eq 0 || $code -ge 128 || $output != *ERROR*"$text"* ]]; then
    printf '%s\n' "$output"
    echo "$* stopped with code $code; expected was an error message with: $text"
    exit 1
  fi
}

way=$1 lammps=$2 tree=$3
if [[ $lammps == 26 || $lammps == 25 ]]; then
  lammps=$(cmake -D SPH_DISSIPATION_LAMMPS="$lammps" -P "$ROOT/cmake/ObtainLAMMPS.cmake" | tee /dev/stderr | tail -n 1)
fi
mkdir -p "$tree"
cd "$tree"
# Package and LAMMPS under names that are the same in every build folder: so the compiler cache serves all of them.
mkdir -p package
ln -sfn "$ROOT/cmake" package/cmake
ln -sfn "$ROOT/src" package/src
ln -sfn "$ROOT/plugin" package/plugin

# -O1, which takes half the time to compile: what is asked here is whether the ways lead into LAMMPS.
configure() {    # SOURCE BUILD [options]
  local source=$1 build=$2
  shift 2
  mkdir -p "$build"
  ln -sfn "$lammps" "$build/lammps-source"
  cmake -S "$source" -B "$build" -G Ninja -D CMAKE_BUILD_TYPE=Release \
    -D CMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" -D CMAKE_CXX_COMPILER_LAUNCHER="$LAUNCHER" -D CMAKE_C_COMPILER_LAUNCHER="$LAUNCHER" "$@" >"$build.log" 2>&1 || { tail -n 30 "$build.log"; exit 1; }
}

configure_lammps() {    # BUILD [options]
  local build=$1
  shift
  configure "$build/lammps-source/cmake" "$build" -D BUILD_SHARED_LIBS=on -D BUILD_OMP=off -D PKG_SPH=on -D PKG_DPD-SMOOTH=on \
    -D PKG_PLUGIN=on "$@"
}

lammps_by_cmake() {    # BUILD [options]
  local build=$1
  configure_lammps "$@"
  ninja -C "$build" -j "$jobs" lmp >>"$build.log" 2>&1 || { tail -n 30 "$build.log"; exit 1; }
}

smoke() {    # LMP RESULT [options]
  "$PYTHON" "$here/smoke.py" "$@" --reference "$REFERENCE"
}

# spectrum LMP: compute sph/spectrum runs, and the energies of the modes add up to that of the particles
printf '%s\n' "include $here/in.smoke" "compute S all sph/spectrum 6 6 6" "variable k equal c_S[1]+c_S[2]" \
  "thermo_style custom v_k c_S[8]" "run 0" 'print "spectrum $(v_k>0&&c_S[8]>0)"' >spectrum.in
spectrum() {
  "$@" -log none -var result none >spectrum.out 2>&1 && grep -qx "spectrum 1" spectrum.out ||
    { tail -n 5 spectrum.out; exit 1; }
}

# fft_of BUILD: the symbols of the package's one file that knows LAMMPS's FFTs
fft_of() {
  local object
  object=$(ninja -C "$1" -t targets all | sed -n 's/^\(.*sph_dissipation_fft.cpp.o\): .*/\1/p')
  ninja -C "$1" "$object" >>"$1.log" 2>&1 || { tail -n 30 "$1.log" >&2; exit 1; }
  nm -C "$1/$object"
}

no_spectrum="needs the FFTs of the KSPACE package"

case $way in
  hook)
    hook=(-D PKG_SPH-DISSIPATION=on -D CMAKE_PROJECT_lammps_INCLUDE="$tree/package/cmake/SPH-DISSIPATION.cmake")
    lammps_by_cmake build "${hook[@]}"
    smoke build/lmp smoke
    spectrum build/lmp -in spectrum.in
    fft_of build | grep FFT3d >/dev/null || { echo "the FFTs of KSPACE are not used"; exit 1; }

    # SPH_DISSIPATION_FFT=off: nothing of KSPACE is compiled, nor asked for
    configure_lammps build-no-fft "${hook[@]}" -D SPH_DISSIPATION_FFT=off
    ! grep -q "KSPACE/[a-z0-9_]*[.]cpp" build-no-fft/build.ninja || { echo "KSPACE is in the build without FFTs"; exit 1; }
    ! fft_of build-no-fft | grep FFT3d || { echo "FFTs are used in the build without them"; exit 1; }
    ;;

  upstream)
    rm -rf patched patches build
    "$PYTHON" "$ROOT/tools/upstream.py" "$lammps" patches
    mkdir patched
    ln -s "$lammps"/* patched
    for folder in src cmake unittest; do
      rm "patched/$folder"
      cp -r "$lammps/$folder" patched
    done
    lammps=$tree/patched
    options=(-D PKG_MISC=on)
    testers=()
    if [[ -n $GOOGLETEST ]]; then
      # LAMMPS compiles a GoogleTest of its own: here that of the distribution
      tar -czf googletest.tar.gz -C "$GOOGLETEST/.." "$(basename "$GOOGLETEST")"
      options+=(-D ENABLE_TESTING=on -D GTEST_URL="file://$tree/googletest.tar.gz"
        -D GTEST_SHA256="$(sha256sum <googletest.tar.gz | cut -d ' ' -f 1)")
      testers=(test_pair_style test_fix_timestep)
    fi
    for patch in patches/*.patch; do
      GIT_CEILING_DIRECTORIES=$tree git -C patched apply --include="src/*" --include="cmake/*" --include="unittest/*" "../$patch"
      configure_lammps build "${options[@]}"
      ninja -C build -j "$jobs" lmp ${testers[@]+"${testers[@]}"} >>build.log 2>&1 || { tail -n 30 build.log; exit 1; }
      echo "$patch compiles"
      if [[ $patch == patches/0001-* ]]; then
        build/lmp -in "$here/in.dump" -log none >dump.out 2>&1 || { tail -n 5 dump.out; exit 1; }
        # the lines of each snapshot of the dump are in the order of their first column
        awk '/^ITEM/ { last = 0; atoms = /ATOMS/; next } atoms { if ($1 <= last) exit 1; last = $1; n++ } END { if (!n) exit 1 }' dump.txt ||
          { echo "a sorted dump is not in order"; exit 1; }
        options+=(-D PKG_SPH-DISSIPATION=on)
        continue
      fi
      smoke build/lmp smoke
      files=$(cd patched/unittest/force-styles/tests && printf '%s\n' *sph_*.yaml | grep -c -E '^(atomic-pair|fix-timestep)-sph_(bulk|micropolar|torque|wall)')
      if [[ -n $GOOGLETEST ]]; then
        ctest --test-dir build/unittest/force-styles -R '^(AtomicPairStyle|FixTimestep):sph_(bulk|micropolar|torque|wall)' --verbose \
          --no-tests=error >testers.log || { tail -n 60 testers.log; exit 1; }
        # a tester whose style is missing passes, and skips all
        ! grep "SKIPPED .*[.]plain" testers.log || { echo "skipped in the testers of LAMMPS"; exit 1; }
        count=$(grep -c "^ *[0-9]*/[0-9]* Test .* Passed " testers.log)
        [[ $count -eq $files ]] || { echo "LAMMPS's testers ran $count of $files files"; exit 1; }
        echo "$patch: $count files of reference data in LAMMPS's testers"
      fi
    done
    [[ $files -eq $(cd "$ROOT/unittest/force-styles/tests" && printf '%s\n' *.yaml | wc -l) ]] || { echo "only $files files of reference data"; exit 1; }
    expect_error "$no_spectrum" build/lmp -in spectrum.in -var result none
    build/lmp -h | grep SPH-DISSIPATION >/dev/null || { echo "lmp -h does not name the package"; exit 1; }
    ;;

  make)
    if [[ ! -d lammps ]]; then
      mkdir copy
      cp -r "$lammps/src" copy
      mv copy lammps
    fi
    # files that the package no longer has must not stay behind
    if [[ -d lammps/src/SPH-DISSIPATION ]]; then make -s -C lammps/src no-sph-dissipation >/dev/null; rm -r lammps/src/SPH-DISSIPATION; fi
    cp -r "$ROOT/src/SPH-DISSIPATION" lammps/src
    {
      make -C lammps/src yes-sph-dissipation
      make -C lammps/src -j "$jobs" mpi CC="$LAUNCHER mpicxx" CCFLAGS="-O1 -std=c++17"
    } >make.log 2>&1 || { tail -n 30 make.log; exit 1; }
    smoke lammps/src/lmp_mpi smoke
    expect_error "$no_spectrum" lammps/src/lmp_mpi -in spectrum.in -var result none
    # ccache's direct mode does not see that a header is there now for which __has_include has looked in vain
    export CCACHE_NODIRECT=true
    {
      make -C lammps/src yes-kspace
      make -C lammps/src yes-sph-dissipation
      make -C lammps/src -j "$jobs" mpi CC="$LAUNCHER mpicxx" CCFLAGS="-O1 -std=c++17"
    } >>make.log 2>&1 || { tail -n 30 make.log; exit 1; }
    spectrum lammps/src/lmp_mpi -in spectrum.in
    {
      make -C lammps/src no-kspace
      make -C lammps/src yes-sph-dissipation
    } >>make.log 2>&1 || { tail -n 30 make.log; exit 1; }
    ;;

  plugin)
    lammps_by_cmake build -D PKG_KSPACE=on
    expect_error "Unrecognized atom style 'sph/bulk'" build/lmp -in "$here/in.smoke" -var result none
    configure "$tree/package/plugin" plugin -D LAMMPS_SOURCE_DIR="$lammps"
    ninja -C plugin -j "$jobs" >>plugin.log 2>&1 || { tail -n 30 plugin.log; exit 1; }
    plugin=$tree/plugin/sphdissipationplugin.so
    smoke build/lmp smoke --plugin "$plugin"

    # compute sph/spectrum, if the plugin is told that LAMMPS has KSPACE
    printf '%s\n' "plugin load $plugin" "include spectrum.in" >without.in
    expect_error "$no_spectrum" build/lmp -in without.in -var result none
    configure "$tree/package/plugin" plugin-kspace -D LAMMPS_SOURCE_DIR="$lammps" -D PKG_KSPACE=on
    ninja -C plugin-kspace -j "$jobs" >>plugin-kspace.log 2>&1 || { tail -n 30 plugin-kspace.log; exit 1; }
    printf '%s\n' "plugin load $tree/plugin-kspace/sphdissipationplugin.so" "include spectrum.in" >with.in
    spectrum build/lmp -in with.in

    # "clear" takes the atom style away until the plugin is loaded again
    printf '%s\n' "plugin load $plugin" "clear" "include $here/in.smoke" >clear.in
    expect_error "Unrecognized atom style 'sph/bulk'" build/lmp -in clear.in -var result none
    printf '%s\n' "plugin load $plugin" "clear" "plugin load $plugin" "include $here/in.smoke" \
      "clear" "plugin load $plugin" "include $here/in.smoke" >again.in
    build/lmp -in again.in -log none -var result again >again.out || { tail -n 5 again.out; exit 1; }

    # replicate would need the atom style in a new Atom object; for other atom styles it works as ever
    printf '%s\n' "plugin load $plugin" "region box block 0 1 0 1 0 1" "create_box 1 box" "create_atoms 1 single 0 0 0" \
      "replicate 2 2 2" >replicate.in
    build/lmp -in replicate.in -log none | grep " 8 atoms" >/dev/null || { echo "replicate is broken for other atom styles"; exit 1; }
    printf '%s\n' "plugin load $plugin" "include $here/in.smoke" "replicate 2 2 2" >replicate.in
    expect_error "Cannot replicate atom style sph/bulk loaded from a plugin" build/lmp -in replicate.in -var result none

    # unloading the pair and fix style leaves an atom style in use that must stay alive
    printf '%s\n' "plugin load $plugin" "include $here/in.smoke" "plugin clear" "group half id 1:100" \
      "delete_atoms group half" "write_data unload.data" >unload.in
    build/lmp -in unload.in -log none -var result unload >unload.out || { tail -n 5 unload.out; exit 1; }
    ;;

  mismatch)
    mkdir -p other/src
    ln -sfn "$lammps"/src/*.h "$lammps/src/fmt" "$lammps/src/nlohmann" other/src
    rm other/src/version.h
    echo '#define LAMMPS_VERSION "1 Jan 2025"' >other/src/version.h
    configure "$tree/package/plugin" plugin-other -D LAMMPS_SOURCE_DIR="$tree/other"
    ninja -C plugin-other -j "$jobs" >>plugin-other.log 2>&1 || { tail -n 30 plugin-other.log; exit 1; }
    echo "plugin load $tree/plugin-other/sphdissipationplugin.so" >other.in
    expect_error "was compiled for LAMMPS version 20250101" build/lmp -in other.in
    ;;

  *)
    echo "unknown way $way"
    exit 2
    ;;
esac
