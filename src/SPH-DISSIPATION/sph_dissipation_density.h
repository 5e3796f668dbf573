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

  class FluidModel;

  // Pass 1: number density c and its rate of all particles, then their volume V = 1/c, their mass
  // density rho = m c and drho = m dc/dt.  P1 (5), (6)

  class DensityStage : public Stage {
   public:
    DensityStage(class LAMMPS *, Engine &, Exchange &, const FluidModel &);
    static constexpr int FORWARD = 3, REVERSE = 2;    // values per atom

    // extrapolated velocity and spin, each nullptr where it is zero

    void run(NeighList *, double **vest, double **omegaest);

   private:
    const FluidModel &model;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
