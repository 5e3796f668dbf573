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

#ifndef LMP_SPH_DISSIPATION_STRESS_H
#define LMP_SPH_DISSIPATION_STRESS_H

#include "sph_dissipation_engine.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Adds the dyad r_ij f_ij of each pair, half to each particle, to all nine components of the
  // stress per atom in LAMMPS's order xx yy zz xy xz yz yx zx zy: first index of r, second of f.
  // The forces are not central in general, nor is the stress symmetric: xy - yx is the torque on
  // the spins.

  class CentroidTally : public PairTally {
   public:
    // then calls next; without newton_pair, ghosts (from nlocal on) get nothing
    CentroidTally(PairTally &next, double **stress, int nlocal, int newton_pair);
    void tally(int i, int j, const double *force_on_i, const double *rij) override;

   private:
    PairTally &next;
    double **stress;
    int nlocal, newton_pair;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
