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
ComputeStyle(sph/dissipation,ComputeSPHDissipation);
// clang-format on
#else

#ifndef LMP_COMPUTE_SPH_DISSIPATION_H
#define LMP_COMPUTE_SPH_DISSIPATION_H

#include "compute.h"

#include <vector>

namespace LAMMPS_NS {

// Power that the dissipative forces of the last force computation turn into heat: total, by channel, and by particle.

class ComputeSPHDissipation : public Compute {
 public:
  ComputeSPHDissipation(class LAMMPS *, int, char **);
  ~ComputeSPHDissipation() override;
  void init() override;
  double compute_scalar() override;
  void compute_vector() override;
  void compute_peratom() override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  double memory_usage() override { return (double) heat.capacity() * sizeof(double); }

 private:
  std::vector<double> heat;

  void collect(double *, double *);
};

}    // namespace LAMMPS_NS

#endif
#endif
