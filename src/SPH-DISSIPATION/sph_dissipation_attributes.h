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

#ifndef LMP_SPH_DISSIPATION_ATTRIBUTES_H
#define LMP_SPH_DISSIPATION_ATTRIBUTES_H

#include "fix.h"
#include "modify.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Fixes, computes, and variables set what they have of a new particle, a copy of another one; all but
  // fix adapt: what that has is copied, and where it has nothing LAMMPS uses a pointer that was never set.

  inline void create_attributes(Modify *modify, int i)
  {
    const auto adapting = modify->get_fix_by_style("^adapt$");
    for (auto *fix : adapting) fix->create_attribute = 0;
    modify->create_attribute(i);
    for (auto *fix : adapting) fix->create_attribute = 1;
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
