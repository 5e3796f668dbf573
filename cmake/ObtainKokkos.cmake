# sph_dissipation_link_lammps(LAMMPS TARGET): makes TARGET a LAMMPS source tree that is LAMMPS. With PKG_KOKKOS it gets a
# Kokkos if LAMMPS's own lib/kokkos is missing or another one is wanted; the tree LAMMPS itself is never written to.
# The Kokkos is, in this order,
#   1. SPH_DISSIPATION_KOKKOS, a source tree of Kokkos or a tarball of one, if the user names it;
#   2. lib/kokkos of LAMMPS: release tarballs bring it;
#   3. the one that LAMMPS's own build downloads (DOWNLOAD_KOKKOS).

set(SPH_DISSIPATION_KOKKOS "" CACHE PATH "Kokkos for PKG_KOKKOS: source tree or tarball (empty: that of LAMMPS, or its download)")

# Sets RESULT to the folder of the Kokkos that the user has named.
function(sph_dissipation_named_kokkos result)
  set(kokkos "${SPH_DISSIPATION_KOKKOS}")
  if(EXISTS "${kokkos}" AND NOT IS_DIRECTORY "${kokkos}")
    file(SHA256 "${kokkos}" sum)
    string(SUBSTRING ${sum} 0 10 sum)
    set(folder "${SPH_DISSIPATION_CACHE}/kokkos/${sum}")
    if(NOT EXISTS "${folder}")
      string(RANDOM suffix)
      set(scratch "${folder}.${suffix}")
      file(ARCHIVE_EXTRACT INPUT "${kokkos}" DESTINATION "${scratch}")
      file(RENAME "${scratch}" "${folder}")
    endif()
    file(GLOB top "${folder}/CMakeLists.txt" "${folder}/*/CMakeLists.txt")
    list(GET top 0 top)
    get_filename_component(kokkos "${top}" DIRECTORY)
  endif()
  if(NOT EXISTS "${kokkos}/core/src/Kokkos_Core.hpp" OR NOT EXISTS "${kokkos}/CMakeLists.txt")
    message(FATAL_ERROR "SPH_DISSIPATION_KOKKOS=${SPH_DISSIPATION_KOKKOS} is no source tree of Kokkos, nor a tarball of one: "
                        "it has no core/src/Kokkos_Core.hpp or no CMakeLists.txt.")
  endif()
  set(${result} "${kokkos}" PARENT_SCOPE)
endfunction()

function(sph_dissipation_link_lammps lammps target)
  # what an earlier configuration left: a link, or a folder of links
  if(IS_SYMLINK "${target}" OR EXISTS "${target}/lib")
    file(REMOVE_RECURSE "${target}")
  endif()
  if(NOT PKG_KOKKOS OR (NOT SPH_DISSIPATION_KOKKOS AND EXISTS "${lammps}/lib/kokkos/CMakeLists.txt"))
    file(CREATE_LINK "${lammps}" "${target}" SYMBOLIC)
    return()
  endif()
  if(NOT SPH_DISSIPATION_KOKKOS)
    message(STATUS "KOKKOS: ${lammps}/lib has no Kokkos, and SPH_DISSIPATION_KOKKOS names none: it is downloaded")
    set(DOWNLOAD_KOKKOS ON CACHE BOOL "Download the KOKKOS library instead of using the bundled one" FORCE)
    file(CREATE_LINK "${lammps}" "${target}" SYMBOLIC)
    return()
  endif()
  sph_dissipation_named_kokkos(kokkos)
  file(MAKE_DIRECTORY "${target}/lib")
  file(GLOB entries LIST_DIRECTORIES true "${lammps}/*" "${lammps}/lib/*")
  foreach(entry IN LISTS entries)
    file(RELATIVE_PATH name "${lammps}" "${entry}")
    if(NOT name MATCHES "^lib(/kokkos)?$")
      file(CREATE_LINK "${entry}" "${target}/${name}" SYMBOLIC)
    endif()
  endforeach()
  file(CREATE_LINK "${kokkos}" "${target}/lib/kokkos" SYMBOLIC)
endfunction()
