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

#ifndef LMP_SPH_DISSIPATION_OPEN_BAND_H
#define LMP_SPH_DISSIPATION_OPEN_BAND_H

#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  class OpenPlane;

  // Particles near the far end of an open zone, of all processors, and not only those of the zone

  class OpenBand : protected Pointers {
   public:
    // those between two heights
    OpenBand(class LAMMPS *, const OpenPlane &, int groupbit, double lo, double hi);

    // one of the zone behind x, not farther beside it than this
    bool has_behind(const double *x, double beside) const;

    // distance of the nearest one of the zone behind x, or in front of it, not farther beside it than
    // this; infinite if there is none
    double next(const double *x, double beside, bool behind) const;

    // any one behind x, not farther beside it than this
    bool has_any_behind(const double *x, double beside) const;

    // any one, or one that is not of the zone, closer to x than this
    bool has_near(const double *x, double distance) const;
    bool has_other_near(const double *x, double distance) const;

   private:
    const OpenPlane &plane;
    std::vector<double> place;    // 3 each
    std::vector<char> of_zone;
    std::vector<std::vector<int>> at_node;    // of the plane

    int nearest_node(const double *x) const;
    template <class Function> bool any(const double *x, double reach, Function &&function) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
