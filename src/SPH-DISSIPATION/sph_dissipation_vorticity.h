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

#ifndef LMP_SPH_DISSIPATION_VORTICITY_H
#define LMP_SPH_DISSIPATION_VORTICITY_H

#include "sph_dissipation_stage.h"

#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  struct BoundaryPair;
  struct BoundarySum;

  // Velocity gradient of the fluid around a fluid particle i, of fluid particles j alone and thus
  // with the matrix that makes it exact for linear fields: sums of V_j F times the products

  struct GradientSum {
    double rr[3][3];    // r_ij r_ij
    double ru[3][3];    // r_ij u_ij: first index of r, second of u
  };

  // The vorticity of the fluid next to boundary particles, for the spin that they bring into the pair
  // forces

  class VorticityStage : public Stage {
   public:
    VorticityStage(class LAMMPS *, Engine &, Exchange &);
    ~VorticityStage() override;

    // bits = of the groups of boundary particles; pairs, sum = of BoundaryStage

    void run(NeighList *, int bits, const std::vector<BoundaryPair> &pairs, const BoundarySum *sum);
    double memory_usage() const override;

    double **vorticity;    // of boundary particles: sum_f V_f W vorticity_f

   private:
    GradientSum *gradient;
    std::vector<char> place;    // of atoms
    int nmax;

    void accumulate_gradient(NeighList *);
    void solve();
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
