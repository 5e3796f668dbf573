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

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(sph/angmom,ComputeSPHAngmom);
// clang-format on
#else

#ifndef LMP_COMPUTE_SPH_ANGMOM_H
#define LMP_COMPUTE_SPH_ANGMOM_H

#include "compute.h"

namespace LAMMPS_NS {

// Angular momentum of a group of spinning particles about a point: total, orbital, spin.

class ComputeSPHAngmom : public Compute {
 public:
  ComputeSPHAngmom(class LAMMPS *, int, char **);
  ~ComputeSPHAngmom() override;
  void init() override {}
  void compute_vector() override;

 private:
  int fixed_point = 0;    // 0: about the center of mass
  double point[3] = {};
};

}    // namespace LAMMPS_NS

#endif
#endif
