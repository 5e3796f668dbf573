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

#ifndef LMP_SPH_DISSIPATION_REFINE_REST_H
#define LMP_SPH_DISSIPATION_REFINE_REST_H

#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {
class NeighList;

namespace SPHDissipation {

  class RefineItems;
  class RefinePairs;

  // Angular momentum that merged particles without spin leave over: their neighbors take it as a
  // rotation.  A pair that merges counts as one point, whether it then does or not.

  class RefineRest : protected Pointers {
   public:
    RefineRest(class LAMMPS *lmp, RefineItems &items, const RefinePairs &pairs) :
        Pointers(lmp), items(items), pairs(pairs), radius(0.0)
    {
    }

    void init(double radius_in) { radius = radius_in; }

    // the neighbors of owned particle i are to rotate; false if there is no such rotation
    bool give(NeighList *full, int i, const double *angmom);

    // velocity that each owned particle gets, and the energy that takes, of a pair that of its lower ID
    void take(NeighList *full);
    const double *velocity(int i) const { return &du[3 * i]; }
    double work(int i) const { return works[i]; }
    void clear();

   private:
    RefineItems &items;
    const RefinePairs &pairs;
    double radius;
    std::vector<double> du, works;

    void offset(int from, int to, double *r) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
