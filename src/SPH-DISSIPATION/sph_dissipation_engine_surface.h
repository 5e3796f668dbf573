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

  // Pairs of the fluid and boundary particles, whose friction and noise the loops of pass 2 work off apart from all others: each
  // with a slope of its own, and with the rigid body at rest.  Engine::accumulate_friction() has the sums.
  // What the loops read are the spare particles, and each boundary particle with those of the fluid after it, one for each pair

  class SurfacePairs {
   public:
    void begin(bool spins);
    bool starts(int wall) const    // it is not the last one
    {
      return subset.rows.empty() || index.back().wall != wall;
    }
    void start(int wall, const Particle &);
    void add(int fluid, const Particle &, const Spin &, double slope);
    void end();    // after the last pair

    // function(fluid, wall, k) for each pair, and function(wall, k) for each boundary particle; k: place in the sums
    template <class Function> void visit(Function &&function) const
    {
      for (std::size_t k = BLOCK; k < index.size(); k++)
        if (index[k].fluid >= 0) function(index[k].fluid, index[k].wall, k);
    }
    template <class Function> void visit_walls(Function &&function) const
    {
      for (const int row : subset.rows) function(index[row].wall, row);
    }

    std::vector<ForceSum> force;
    ChannelSums side;

    double memory_usage() const;

   private:
    friend class Engine;
    struct Index {
      int fluid, wall;    // fluid = -1: the boundary particle itself
    };
    std::vector<Index> index;
    std::vector<Particle> particle;
    std::vector<Spin> spin;    // empty without spins
    std::vector<int> type;
    PairSubset subset;
    std::vector<double> weight, tag, mobility;
    std::vector<NoiseRow> row;

    template <class T, class Value> void fill(std::vector<T> &, const T &spare, Value &&);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
