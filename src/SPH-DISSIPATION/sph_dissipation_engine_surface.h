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

#include "sph_dissipation_boundary_pairs.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_noise_data.h"

#include <functional>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Pairs of the fluid and boundary particles of one thread, whose friction and noise the loops of pass 2 work off apart from all
  // others: each with a slope of its own, and in the frame of the rigid body of the boundary.  So what the loops read are
  // copies: spare particles; the boundary particles; those of the fluid, one for each body that they are near to.
  // Engine::accumulate_friction() has the sums.

  class SurfacePairs {
   public:
    // when the neighbor list is new: those of the rows with a body(i), number from 0 on, of boundary particle i; sets
    // BoundaryRows::candidate_copy
    void find(BoundaryRows &, int nall, const std::function<int(int)> &body);
    bool empty() const { return subset.rows.empty(); }

    // the pairs of this step; copy(i, wall, particle, spin) sets those of particle i in the frame of the body of this boundary
    // particle
    void begin(const BoundaryRows &, bool spins,
               const std::function<void(int, int, Particle &, Spin &)> &copy);
    double *slope() { return subset.slope.data(); }    // of the pairs of BoundaryRows, to be set

    // function(i, is_boundary, k) for each copy of a particle i; k: its place in the sums
    template <class Function> void visit(Function &&function) const
    {
      for (std::size_t k = BLOCK; k < index.size(); k++)
        function(index[k].particle, index[k].particle == index[k].wall, k);
    }

    std::vector<ForceSum> force;
    ChannelSums side;

    double memory_usage() const;

   private:
    friend class Engine;
    struct Index {
      int particle,
          wall;    // wall: a particle of the body, that one itself if it is of the boundary
    };
    std::vector<Index> index;
    std::vector<int> row;    // of BoundaryRows, of each row here
    std::vector<Particle> particle;
    std::vector<Spin> spin;    // empty without spins
    std::vector<int> type;
    PairSubset subset;
    std::vector<double> weight, tag, mobility;
    std::vector<NoiseRow> noise;

    template <class T, class Value> void fill(std::vector<T> &, const T &spare, Value &&);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
