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

#ifdef ATOM_CLASS
// clang-format off
AtomStyle(sph/micropolar,AtomVecSPHMicropolar);
// clang-format on
#else

#ifndef LMP_ATOM_VEC_SPH_MICROPOLAR_H
#define LMP_ATOM_VEC_SPH_MICROPOLAR_H

#include "atom_vec_sph_bulk.h"

namespace LAMMPS_NS {

// The fields of sph/bulk and of spins

class AtomVecSPHMicropolar : public AtomVecSPHBulk {
 public:
  AtomVecSPHMicropolar(class LAMMPS *lmp) : AtomVec(lmp), AtomVecSPHBulk(lmp, true) {}
};

}    // namespace LAMMPS_NS

#endif
#endif
