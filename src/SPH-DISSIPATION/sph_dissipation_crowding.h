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

#ifndef LMP_SPH_DISSIPATION_CROWDING_H
#define LMP_SPH_DISSIPATION_CROWDING_H

#include "sph_dissipation_stage.h"

#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Where particles are crowded, for particle shifting:
  //   crowding_i = sum_j V_j F r_ij [1 + 0.2 (W_ij/W(V_i^(1/n)))^4]  (1/length)
  // points away from there.  The second term keeps particles from pairing, P. N. Sun et al., Comput.
  // Methods Appl. Mech. Eng. 315, 25 (2017).

  class CrowdingStage : public Stage {
   public:
    CrowdingStage(class LAMMPS *, Engine &, Exchange &);
    ~CrowdingStage() override;

    bool wanted;    // by a fix that shifts particles, from its init(), in every run

    void run();    // with the volumes of particles set
    double memory_usage() const override;

    double **crowding;    // of owned atoms

   private:
    int nmax;
    std::vector<double> contact;    // 1/W(V^(1/n)) of atoms, in units of the norm of the kernel
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
