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
ComputeStyle(sph/gauge,ComputeSPHGauge);
// clang-format on
#else

#ifndef LMP_COMPUTE_SPH_GAUGE_H
#define LMP_COMPUTE_SPH_GAUGE_H

#include "compute.h"

#include <vector>

namespace LAMMPS_NS {

// Pressures at points, and levels of the fluid along axes: one number per gauge.

class ComputeSPHGauge : public Compute {
 public:
  ComputeSPHGauge(class LAMMPS *, int, char **);
  ~ComputeSPHGauge() override;
  void init() override;
  void compute_vector() override;

 private:
  struct Gauge {
    double place[3];
    int axis;    // of a level; -1: a pressure
  };
  std::vector<Gauge> gauges;
};

}    // namespace LAMMPS_NS

#endif
#endif
