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

#ifndef LMP_SPH_DISSIPATION_WALL_CHECKS_H
#define LMP_SPH_DISSIPATION_WALL_CHECKS_H

#include <set>

namespace LAMMPS_NS {
class Fix;
class LAMMPS;

namespace SPHDissipation {
  class Fluid;

  // Checks of a wall of particles.  Called by all ranks; messages name the fix.

  // there are particles, and no other fix moves them

  void check_wall_particles(LAMMPS *, const Fix *);

  // pair coefficients, exclusions and neigh_modify include let fluid and wall interact; if only a
  // part of the fluid does, a warning if wanted.  Returns the types of the fluid that do.

  std::set<int> check_wall_interacts(LAMMPS *, const Fix *, const Fluid *, bool warn);

  // the wall fills the support of the fluid at its surface; a warning if not.  Needs ghost atoms.

  void check_wall_thickness(LAMMPS *, const Fix *, const Fluid *);

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
