# Adds the package SPH-DISSIPATION to the CMake build of an unmodified LAMMPS:
#
#   cmake -S lammps/cmake -B build -D PKG_SPH-DISSIPATION=on \
#         -D CMAKE_PROJECT_lammps_INCLUDE=/path/to/cmake/SPH-DISSIPATION.cmake
#
# CMake includes this file at the end of LAMMPS's own project() command: the target "lammps" does not exist yet,
# and LAMMPS has not yet written the style headers (style_pair.h, ...) from its lists of headers.

option(PKG_SPH-DISSIPATION "Build SPH-DISSIPATION Package" OFF)
if(NOT PKG_SPH-DISSIPATION)
  return()
endif()

option(SPH_DISSIPATION_FFT "Compute sph/spectrum: without the KSPACE package, compile the FFTs of KSPACE alone" ON)

get_filename_component(SPH_DISSIPATION_SOURCE_DIR "${CMAKE_CURRENT_LIST_DIR}/../src/SPH-DISSIPATION" ABSOLUTE)
get_filename_component(SPH_DISSIPATION_KOKKOS_DIR "${CMAKE_CURRENT_LIST_DIR}/../src/KOKKOS" ABSOLUTE)

function(sph_dissipation_check_lammps_version)
  file(STRINGS "${CMAKE_CURRENT_SOURCE_DIR}/../src/version.h" line REGEX "LAMMPS_VERSION")
  if(NOT line MATCHES "\"([0-9]+) ([A-Z][a-z][a-z])[a-z]* ([0-9]+)\"")
    message(FATAL_ERROR "No LAMMPS version found in ${CMAKE_CURRENT_SOURCE_DIR}/../src/version.h: "
                        "SPH-DISSIPATION needs the complete LAMMPS source tree.")
  endif()
  set(name "${CMAKE_MATCH_1} ${CMAKE_MATCH_2} ${CMAKE_MATCH_3}")
  set(tested "4 Feb 2025" "4 Jul 2026")
  if(name IN_LIST tested)
    return()
  endif()
  set(months Jan Feb Mar Apr May Jun Jul Aug Sep Oct Nov Dec)
  list(FIND months "${CMAKE_MATCH_2}" month)
  math(EXPR date "(${CMAKE_MATCH_3} * 12 + ${month}) * 31 + ${CMAKE_MATCH_1}")
  math(EXPR oldest "(2025 * 12 + 1) * 31 + 4")
  if(date LESS oldest)
    message(FATAL_ERROR "SPH-DISSIPATION does not support LAMMPS ${name}: it is tested with the versions "
                        "4 Feb 2025 and 4 Jul 2026. Take one of these, or a newer one at your own risk.")
  endif()
  message(WARNING "SPH-DISSIPATION is tested with LAMMPS 4 Feb 2025 and 4 Jul 2026; this is ${name}. "
                  "Run the package's tests before you trust its results.")
endfunction()

function(sph_dissipation_add_sources)
  file(GLOB sources CONFIGURE_DEPENDS "${SPH_DISSIPATION_SOURCE_DIR}/[^.]*.cpp")
  target_sources(lammps PRIVATE ${sources})
  target_include_directories(lammps PRIVATE "${SPH_DISSIPATION_SOURCE_DIR}")
  # where pair_coeff finds the files of fluids without the variable LAMMPS_POTENTIALS
  get_filename_component(potentials "${SPH_DISSIPATION_SOURCE_DIR}/../../potentials" ABSOLUTE)
  set_property(SOURCE "${SPH_DISSIPATION_SOURCE_DIR}/sph_dissipation_fluids.cpp" TARGET_DIRECTORY lammps APPEND PROPERTY
    COMPILE_DEFINITIONS "SPH_DISSIPATION_POTENTIALS=\"${potentials}\"")
endfunction()

# compute sph/spectrum needs the distributed FFTs of KSPACE and finds their headers in the include path if they are there.
# The package's own file for CMake looks for FFTW3 (else LAMMPS has an FFT of its own) and has the options FFT, FFT_SINGLE, ...
function(sph_dissipation_add_ffts)
  if(PKG_KSPACE OR NOT SPH_DISSIPATION_FFT)
    return()
  endif()
  set(kspace "${LAMMPS_SOURCE_DIR}/KSPACE")
  target_sources(lammps PRIVATE ${kspace}/fft3d.cpp ${kspace}/fft3d_wrap.cpp ${kspace}/remap.cpp ${kspace}/remap_wrap.cpp)
  target_include_directories(lammps PRIVATE "${kspace}")
  include(Packages/KSPACE)
endfunction()

# The styles with the suffix /kk, where LAMMPS is built with its package KOKKOS. They are written for the AtomVecKokkos of
# 4 Jul 2026; with an older LAMMPS only the others are there.
function(sph_dissipation_add_kokkos)
  if(NOT PKG_KOKKOS)
    return()
  endif()
  file(STRINGS "${CMAKE_CURRENT_SOURCE_DIR}/../src/version.h" line REGEX "LAMMPS_VERSION")
  if(line MATCHES "\"4 Feb 2025\"")
    message(WARNING "The /kk styles of SPH-DISSIPATION need LAMMPS 4 Jul 2026 or newer: they are left out.")
    return()
  endif()
  string(TOLOWER "${KOKKOS_PREC}" precision)    # LAMMPS takes it in any case
  if(precision AND NOT precision STREQUAL "double")
    message(WARNING "The /kk styles of SPH-DISSIPATION need KOKKOS_PREC=double: they are left out.")
    return()
  endif()
  RegisterStyles("${SPH_DISSIPATION_KOKKOS_DIR}")
  cmake_language(DEFER CALL sph_dissipation_add_kokkos_sources)
endfunction()

function(sph_dissipation_add_kokkos_sources)
  file(GLOB sources CONFIGURE_DEPENDS "${SPH_DISSIPATION_KOKKOS_DIR}/[^.]*.cpp")
  target_sources(lammps PRIVATE ${sources})
  target_include_directories(lammps PRIVATE "${SPH_DISSIPATION_KOKKOS_DIR}")
  # nvcc only warns of a loop on the device that calls a function of the host alone, and the loop computes nonsense
  if(Kokkos_ENABLE_CUDA AND CMAKE_CXX_COMPILER MATCHES "nvcc_wrapper$")
    set_property(SOURCE ${sources} TARGET_DIRECTORY lammps APPEND PROPERTY COMPILE_OPTIONS
      -Werror=cross-execution-space-call -Xcudafe --diag_error=20013)
  endif()
endfunction()

# LAMMPS lists only packages of its own as installed ("lmp -h", lammps_config_has_package()).
function(sph_dissipation_add_to_installed_packages)
  set(header "${LAMMPS_STYLE_HEADERS_DIR}/lmpinstalledpkgs.h")
  file(READ "${header}" text)
  string(REPLACE "  NULL\n" "  \"SPH-DISSIPATION\",\n  NULL\n" text "${text}")
  file(WRITE "${header}" "${text}")
endfunction()

sph_dissipation_check_lammps_version()
include("${CMAKE_CURRENT_SOURCE_DIR}/Modules/StyleHeaderUtils.cmake")
RegisterStyles("${SPH_DISSIPATION_SOURCE_DIR}")
sph_dissipation_add_kokkos()
cmake_language(DEFER CALL sph_dissipation_add_sources)
cmake_language(DEFER CALL sph_dissipation_add_ffts)
cmake_language(DEFER CALL sph_dissipation_add_to_installed_packages)
