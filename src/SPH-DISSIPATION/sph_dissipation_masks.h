/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#ifndef LMP_SPH_DISSIPATION_MASKS_H
#define LMP_SPH_DISSIPATION_MASKS_H

#include "atom_masks.h"

// LAMMPS of 4 Feb 2025 has macros with names of the fields below

#undef DRHO_MASK
#undef VFRAC_MASK
#undef VEST_MASK

// Bits of the package's own fields for sync() and modified() of class AtomKokkos, which passes them to the atom style: from
// the highest bit down, while LAMMPS's atom_masks.h begins with the lowest.  With KOKKOS, LAMMPS copies the fields in
// datamask_read of a fix without suffix to the host before each call, and those in datamask_modify back: all fields, if the
// fix does not say otherwise.

namespace LAMMPS_NS {
namespace SPHDissipation {

  constexpr uint64_t SPH_RHO_MASK = uint64_t(1) << 63;
  constexpr uint64_t DRHO_MASK = uint64_t(1) << 62;
  constexpr uint64_t VFRAC_MASK = uint64_t(1) << 61;
  constexpr uint64_t ESPH_MASK = uint64_t(1) << 60;
  constexpr uint64_t DESPH_MASK = uint64_t(1) << 59;
  constexpr uint64_t DESPH_BEFORE_MASK = uint64_t(1) << 58;
  constexpr uint64_t VEST_MASK = uint64_t(1) << 57;
  constexpr uint64_t INERTIA_MASK = uint64_t(1) << 56;
  constexpr uint64_t OMEGAEST_MASK = uint64_t(1) << 55;
  constexpr uint64_t STATES_MASK = uint64_t(1) << 54;    // all states
  constexpr uint64_t OFFSET_MASK = uint64_t(1) << 53;    // rho_sum, vol_rate, ...
  constexpr uint64_t TRACE_MASK = uint64_t(1) << 52;

  // Fields that density continuity reads and modifies besides

  constexpr uint64_t CONTINUITY_MASK = SPH_RHO_MASK | OFFSET_MASK;

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
