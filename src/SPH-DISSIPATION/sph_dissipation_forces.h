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

#ifndef LMP_SPH_DISSIPATION_FORCES_H
#define LMP_SPH_DISSIPATION_FORCES_H

#include "sph_dissipation_rows.h"
#include "sph_dissipation_stage.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  class PairTally;

  // Pass 2: forces, torques and heating of owned atoms and the contributions to ghost atoms, onto
  // the arrays of LAMMPS, which sums up those of the ghosts itself

  class ForceStage : public Stage {
   public:
    using Stage::Stage;

    void run(NeighList *, PairTally *);    // tally of each pair, or nullptr

    // what ghosts have got onto the force and torque of their owners in the engine, too

    void collect();

    // Heat of the dissipative forces, energy per time: of each owned and ghost atom as this rank
    // summed it (with newton on, the sums of ghosts belong to their owners), heat may be nullptr; by
    // channel, the sum on this rank.  not_fluid = bits of the groups of particles that are left out

    void heating(double *heat, double *power, int not_fluid) const;

   private:
    int nforce() const;    // atoms that forces act on
    double bulk_heat(int) const;
    void add_drag_heat(int, double *channel) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
