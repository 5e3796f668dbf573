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

#ifndef LMP_SPH_DISSIPATION_CREATE_H
#define LMP_SPH_DISSIPATION_CREATE_H

#include "sph_dissipation_exchange.h"

#include "lmptype.h"

#include <utility>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;

namespace SPHDissipation {

  // Return whether x is inside the boundaries of the box that are not periodic.

  bool in_box(LAMMPS *, const double *x);

  // Create and delete particles, for fixes that do it between two neighbor lists.  All processors call
  // begin_change(), from which on there are no ghosts, create and remove owned particles, and call
  // end_change() with the former number of owned particles, or end_change_by() with the change of
  // the number on all processors together, if they know it.

  void begin_change(LAMMPS *);
  void end_change(LAMMPS *, int nlocal_before);
  void end_change_by(LAMMPS *, bigint change);

  // Append a copy of owned particle i with another ID and position; return its index.
  int create_copy(LAMMPS *, int i, tagint id, const double *x);

  // Remove owned particle i.  The last owned particle gets the index i.
  void remove_particle(LAMMPS *, int i);

  // Find new IDs for particles, successive IDs for each, in the order of the particles' own IDs, which does not depend on the
  // number of processors.  first = first new ID of each, highest = largest ID ever given, before and after.  Return false if
  // there are not enough IDs.

  using NewIDs = std::pair<tagint, tagint>;    // ID of a particle, number of new ones
  [[nodiscard]] bool new_ids(LAMMPS *, const std::vector<NewIDs> &mine, tagint &highest,
                             std::vector<tagint> &first);

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
