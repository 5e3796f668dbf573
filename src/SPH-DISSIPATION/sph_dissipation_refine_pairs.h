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

#ifndef LMP_SPH_DISSIPATION_REFINE_PAIRS_H
#define LMP_SPH_DISSIPATION_REFINE_PAIRS_H

#include "pointers.h"

#include <map>
#include <vector>

namespace LAMMPS_NS {
class NeighList;

namespace SPHDissipation {

  class RefineItems;

  // Partners of merges: each particle that is to merge chooses the nearest one that may be its
  // partner, two that have chosen each other are settled, the others choose again.  Which of two
  // distances is the smaller one is known up to round-off only; equal ones are decided by the IDs,
  // so that the pairs do not depend on the number of processors.
  //
  // Before that, all daughters of one split may merge as a whole: what pairs, one after the other,
  // do not give back is the moment of inertia of a spinning particle in three dimensions.

  class RefinePairs : protected Pointers {
   public:
    RefinePairs(class LAMMPS *lmp, RefineItems &items) : Pointers(lmp), items(items) {}

    void clear();
    void find_families(NeighList *full, double farthest, int size);
    void find(NeighList *full, double farthest);
    int mate(int i) const { return mates[i]; }    // owned or ghost particle; -1: none
    bool leads(int i) const;                      // owned, of a pair: it is the one that stays
    std::vector<int> members(int i) const;        // of the merge that i leads

   private:
    RefineItems &items;
    std::vector<int>
        mates;    // of a family: of the one that leads any other one, of these that one
    std::map<int, std::vector<int>> families;

    void settle();
    bool is_first(int i) const;
    bool fits(int i, int j) const;
    double distance_sq(int i, int j) const;
    bool nearer(int i, int j, int other) const;    // to i, j than the other one
    std::vector<int> family(int i, const int *neighbors, int n, double farthest_sq) const;
    int nearest(int i, const int *neighbors, int n, double farthest_sq) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
