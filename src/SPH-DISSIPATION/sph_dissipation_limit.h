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

#ifndef LMP_SPH_DISSIPATION_LIMIT_H
#define LMP_SPH_DISSIPATION_LIMIT_H

#include "sph_dissipation_stage.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // How negative the coefficient of the bulk term of a particle may be:
  //   B_i = sum_j (c_j/c_i)^2 V_j F r^2 / a_ij,
  // where a_ij F V_i V_j is what the shear term puts before (u.e)^2.  The total dissipation is
  // non-negative for any velocities if zeta_i B_i >= -1/2 for all particles (theory page).

  class LimitStage : public Stage {
   public:
    LimitStage(class LAMMPS *, Engine &, Exchange &);
    ~LimitStage() override;

    void run();    // with the volumes of particles set
    double memory_usage() const override;

    double *bound;    // B of owned and ghost atoms

   private:
    int nmax;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
