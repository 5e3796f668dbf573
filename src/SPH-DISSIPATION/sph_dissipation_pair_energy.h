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

#ifndef LMP_SPH_DISSIPATION_PAIR_ENERGY_H
#define LMP_SPH_DISSIPATION_PAIR_ENERGY_H

#include "sph_dissipation_stages.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  struct PairEnergyKernel;
  struct CohesionKernel;

  // Energies of pairs, with the reference volumes w = m/rho0: of unlike types, a w_i w_j W(r), see
  // BaseChannel::pair_energy() and PairEnergyKernel, with their forces after pass 2; of cohesion, see
  // BaseChannel::cohesion() and CohesionKernel, with their forces in pass 2

  class PairEnergyStage : public Stage {
   public:
    using Stage::Stage;

    bool active() const;
    void forget();    // while it is not active, its pairs do not follow the neighbor lists
    // Add the forces of unlike types to the sums of the engine, with a tally of each pair, or nullptr
    void run(NeighList *, PairTally *);
    // Return the energy of the particles of a group, half of each pair, at the last run(), on this processor; add it to the
    // energies of the particles (nullptr: to none)
    double energy(double *each_atom, int groupbit) const;

    double memory_usage() const override { return bytes(pairs, sums); }

   private:
    struct UnlikePair {
      int i, j;
      double energy;    // a w_i w_j, with the factor of rows
    };
    std::vector<UnlikePair> pairs;    // of the neighbor list
    std::vector<double> energies;     // a of the types when they were found
    ThreadSums<ForceSum> sums;

    void find_pairs(NeighList *, const PairEnergyKernel &);
    // Call function(pair, r_ij, r^2) for the pairs of unlike types within the support radius
    template <class Function>
    void visit(std::size_t from, std::size_t to, Function &&function) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
