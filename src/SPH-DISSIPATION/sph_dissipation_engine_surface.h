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

#include <algorithm>
#include <functional>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Pairs of fluid and boundary particles of one thread with separate runs of the loops of pass 2, for friction and noise:
  // each pair has its own slope, in the frame of the rigid body of the boundary.  The loops read copies: of spare particles;
  // of boundary particles; of fluid particles, one for each body near them.  Engine::accumulate_friction() runs the loops.

  class SurfacePairs {
   public:
    // When the neighbor list is new: find the rows whose boundary particle i has a body, body(i) >= 0; set
    // BoundaryRows::candidate_copy
    void find(BoundaryRows &, int nall, const std::function<int(int)> &body);
    const std::vector<int> &places() const { return place; }    // of these rows in BoundaryRows

    // Begin a step: copy(i, wall, particle, spin) sets the copy of particle i in the frame of the body of boundary particle
    // wall; spin: nullptr without spins
    template <class Copy> void begin(const BoundaryRows &rows, bool spins, Copy &&copy)
    {
      const std::size_t n = index.size();
      particle.resize(n);
      spin.resize(spins ? n : 0);
      std::fill_n(particle.begin(), BLOCK, Particle());
      std::fill_n(spin.begin(), spins ? BLOCK : 0, Spin());
      for (std::size_t k = BLOCK; k < n; k++)
        copy(index[k].particle, index[k].wall, particle[k], spins ? &spin[k] : nullptr);
      for (std::size_t m = 0; m < place.size(); m++) count[m] = rows.count[place[m]];
    }

    // Call function(i, is_boundary, k) for each copy of a particle i; k: place in the sums
    template <class Function> void visit(Function &&function) const
    {
      for (std::size_t k = BLOCK; k < index.size(); k++)
        function(index[k].particle, index[k].particle == index[k].wall, k);
    }

    std::vector<double> slope;    // of the pairs of BoundaryRows
    std::vector<ForceSum> force;
    ChannelSums side;

    double memory_usage() const;

   private:
    friend class Engine;
    struct Index {
      int particle;
      int wall;    // a particle of the body; for a boundary particle itself
    };
    std::vector<Index> index;
    // By row of pairs: place in BoundaryRows, copy of the boundary particle, number of pairs
    std::vector<int> place, rows, count;
    std::vector<bigint> first;
    std::vector<Particle> particle;
    std::vector<Spin> spin;    // empty without spins
    std::vector<int> type;
    std::vector<double> weight, tag, mobility;
    std::vector<NoiseRow> noise;

    template <class T, class Value> void fill(std::vector<T> &, const T &spare, Value &&);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
