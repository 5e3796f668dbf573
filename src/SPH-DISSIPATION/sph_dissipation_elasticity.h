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

#ifndef LMP_SPH_DISSIPATION_ELASTICITY_H
#define LMP_SPH_DISSIPATION_ELASTICITY_H

#include "sph_dissipation_stage.h"

#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // How the number density of particles changes in a shear gamma of their arrangement: d2c/dgamma2
  // over c, which times the pressure is the shear modulus of a lattice (theory page).

  class LatticeStrain : public Stage {
   public:
    using Stage::Stage;

    // sums over the pairs of pass 1; weight = of owned and ghost particles

    void run(const std::vector<double> &weight);

    // sum of weight times d2c/dgamma2 over c, the largest in size of all directions of the shear

    double largest(int type) const;

   private:
    struct Sum {
      double second[6], fourth[6][6];    // coefficients of any shear
    };
    std::vector<Sum> sums;    // by type
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
