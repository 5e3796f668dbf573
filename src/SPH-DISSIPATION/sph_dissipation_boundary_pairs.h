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

#ifndef LMP_SPH_DISSIPATION_BOUNDARY_PAIRS_H
#define LMP_SPH_DISSIPATION_BOUNDARY_PAIRS_H

#include "sph_dissipation_engine.h"
#include "sph_dissipation_wall_terms.h"

#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Pair of a fluid and a boundary particle inside the support

  struct BoundaryPair {
    int fluid, wall;
    double distance, slope;    // r, F
  };

  // Pairs of fluid and boundary particles of one thread, one row for each boundary particle.  The pairs of row m have the
  // places first[m], first[m] + 1, ... in the arrays of pairs.

  struct BoundaryRows {
    std::vector<int> wall;        // boundary particle of each row
    std::vector<bigint> first;    // place of each row, and the end

    // All pairs that may come into the support before the next neighbor list: the fluid particles, and the copies of these
    // particles in SurfacePairs (empty without copies); spare particles fill up a row

    std::vector<Offset> candidate, candidate_copy;

    // Pairs inside the support in this step: number of pairs in each row; fluid particles, copies, r, and F.  The first
    // particle and a spare copy at the distance of the support radius, where F is 0, fill up a block

    std::vector<int> count;
    std::vector<Offset> fluid, copy;
    std::vector<double> distance, slope;

    // Fill by begin(), add() for each row of n candidates, end()
    void begin()
    {
      wall.clear();
      candidate.clear();
      first.assign(1, 0);
    }
    void add(int wall_in, const int *fluid_in, int n, int spare)
    {
      wall.push_back(wall_in);
      for (int k = 0; k < n; k++) candidate.push_back(offset_of(fluid_in[k]));
      for (int l = 0; candidate.size() % BLOCK; l++) candidate.push_back(offset_of(spare + l));
      first.push_back(static_cast<bigint>(candidate.size()));
    }
    void end()
    {
      constexpr int ROOM = 3 * BLOCK;    // loops write whole blocks and look ahead
      candidate_copy.clear();
      count.assign(wall.size(), 0);
      fluid.assign(candidate.size() + ROOM, 0);
      distance.assign(fluid.size(), 0.0);
      slope.assign(fluid.size(), 0.0);
    }
    int size() const { return static_cast<int>(wall.size()); }
    template <class Function> void visit(Function &&function) const
    {
      for (int m = 0; m < size(); m++)
        for (bigint k = first[m]; k < first[m] + count[m]; k++)
          function(BoundaryPair{index_of(fluid[k]), wall[m], distance[k], slope[k]});
    }
    double memory_usage() const
    {
      return bytes(wall, first, candidate, candidate_copy, count, fluid, copy, distance, slope);
    }
  };

  struct BoundaryPairs {
    std::vector<BoundaryRows> of_thread;
    // By thread: rows of the neighbor list with such pairs; particles in the pairs (not of the first thread), each once
    std::vector<std::vector<int>> rows, touched;

    template <class Function> void visit(Function &&function) const
    {
      for (const auto &some : of_thread) some.visit(function);
    }
    double memory_usage() const { return bytes(of_thread, rows, touched); }
  };

  // Input and output of the sums over the fluid around boundary particles with these bits in their mask

  struct BoundarySumData {
    const int *mask;
    int bits;
    const Surface *surface;
    const double *rho, *reference_volume;
    BoundarySum *sum;    // the loops add to it
  };

  // Input and output of the sums over the fluid that conducts heat

  struct BoundaryHeatData {
    const int *type;
    const double *coefficient;    // by type
    const Surface *surface;
    const FlowRow *flow;
    BoundaryHeatSum *sum;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
