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

#ifdef FIX_CLASS
// clang-format off
FixStyle(sph/micropolar,FixSPHMicropolar);
// clang-format on
#else

#ifndef LMP_FIX_SPH_MICROPOLAR_H
#define LMP_FIX_SPH_MICROPOLAR_H

#include "fix_sph_bulk.h"

namespace LAMMPS_NS {

// The integration of sph/bulk, with the fluid and the atom style sph/micropolar

class FixSPHMicropolar : public FixSPHBulk {
 public:
  FixSPHMicropolar(class LAMMPS *lmp, int narg, char **arg) : FixSPHBulk(lmp, narg, arg) {}
};

}    // namespace LAMMPS_NS

#endif
#endif
