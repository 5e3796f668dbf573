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
ComputeStyle(sph/temp,ComputeSPHTemp);
// clang-format on
#else

#ifndef LMP_COMPUTE_SPH_TEMP_H
#define LMP_COMPUTE_SPH_TEMP_H

#include "compute.h"

namespace LAMMPS_NS {

// Temperatures of the translation, in all directions and in each of them, of the spins, and of the heat of the particles

class ComputeSPHTemp : public Compute {
 public:
  ComputeSPHTemp(class LAMMPS *, int, char **);
  ~ComputeSPHTemp() override;
  void init() override;
  double compute_scalar() override;
  void compute_vector() override;

 private:
  void translational(double *) const;    // three directions
  double rotational() const;
  double internal() const;
};

}    // namespace LAMMPS_NS

#endif
#endif
