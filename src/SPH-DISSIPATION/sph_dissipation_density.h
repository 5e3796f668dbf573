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

#ifndef LMP_SPH_DISSIPATION_DENSITY_H
#define LMP_SPH_DISSIPATION_DENSITY_H

#include "sph_dissipation_stage.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Pass 1: density c of the reference volumes w, for w = 1 of the number of particles, and its rate;
  // then the volume V = w/c, the mass density rho = m/V and its rate.  P1 (5), (6)

  class DensityStage : public Stage {
   public:
    using Stage::Stage;

    // extrapolated velocity and spin, each nullptr where it is zero

    void run(NeighList *, double **vest, double **omegaest);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
