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

#ifndef LMP_SPH_DISSIPATION_ENGINE_SURFACE_H
#define LMP_SPH_DISSIPATION_ENGINE_SURFACE_H

#include "sph_dissipation_engine.h"
#include "sph_dissipation_noise_data.h"

#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Pair of a particle of the fluid and one of a boundary

  struct SurfacePair {
    int fluid, wall;
    double slope;    // F times the factor of its friction
    double u[3];     // velocity of the fluid relative to the rigid body of the boundary there
    double w[3];     // the same of the spin (micropolar)
  };

  // Such pairs, whose friction and noise the loops of pass 2 work off apart from all others: each with a slope of its own,
  // and with the rigid body at rest.  Engine::accumulate_friction() has the sums

  class SurfacePairs {
   public:
    // in the order of the boundary particles, whose numbers are below n
    void set(const std::vector<SurfacePair> &, const std::vector<int> &number, int n);

    // function(pair, k, row): k, row = the fluid's and the boundary particle's place in the sums
    template <class Function> void visit(Function &&function) const
    {
      for (std::size_t row = 0; row < walls.size(); row++)
        for (int k = begin[row]; k < begin[row + 1]; k++) function(pairs[k], walls.size() + k, row);
    }
    std::size_t rows() const { return walls.size(); }
    int wall(std::size_t row) const { return walls[row]; }

    std::vector<ForceSum> force;
    ChannelSums side;

    double memory_usage() const;

   private:
    friend class Engine;
    std::vector<SurfacePair> pairs;
    std::vector<int> walls, begin;    // begin[row]: its first pair

    // what the loops read: first the boundary particles, then those of the fluid, one for each pair

    std::vector<Particle> particle;
    std::vector<Spin> spin;
    std::vector<int> type;
    PairSubset subset;
    std::vector<double> weight, tag, mobility;
    std::vector<NoiseRow> row;

    std::size_t size() const { return walls.size() + pairs.size(); }
    template <class T, class Value> void fill(std::vector<T> &, Value &&);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
