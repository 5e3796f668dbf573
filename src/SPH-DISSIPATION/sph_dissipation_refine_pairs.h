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

#include <vector>

namespace LAMMPS_NS {
class NeighList;

namespace SPHDissipation {

  class RefineItems;

  // Partners of merges: each particle that is to merge chooses the nearest one that may be its
  // partner, two that have chosen each other are settled, the others choose again.  Which of two
  // distances is the smaller one is known up to round-off only; equal ones are decided by the IDs,
  // so that the pairs do not depend on the number of processors.

  class RefinePairs : protected Pointers {
   public:
    RefinePairs(class LAMMPS *lmp, RefineItems &items) : Pointers(lmp), items(items) {}

    void find(NeighList *full, double farthest);
    int mate(int i) const { return mates[i]; }    // owned or ghost particle; -1: none
    bool leads(int i) const;                      // owned, of a pair: it is the one that stays

   private:
    RefineItems &items;
    std::vector<int> mates;

    bool fits(int i, int j) const;
    int nearest(int i, const int *neighbors, int n, double farthest_sq) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
