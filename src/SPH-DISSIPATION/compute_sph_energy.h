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
ComputeStyle(sph/energy,ComputeSPHEnergy);
// clang-format on
#else

#ifndef LMP_COMPUTE_SPH_ENERGY_H
#define LMP_COMPUTE_SPH_ENERGY_H

#include "compute.h"

namespace LAMMPS_NS {

// Kinetic, internal and rotational energy of a particle fluid, the energy of pairs of unlike types, and the sum of all.

class ComputeSPHEnergy : public Compute {
 public:
  ComputeSPHEnergy(class LAMMPS *, int, char **);
  ~ComputeSPHEnergy() override;
  void init() override {}
  double compute_scalar() override;
  void compute_vector() override;
};

}    // namespace LAMMPS_NS

#endif
#endif
