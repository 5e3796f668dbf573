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

#ifndef LMP_SPH_DISSIPATION_OPEN_CHECKS_H
#define LMP_SPH_DISSIPATION_OPEN_CHECKS_H

#include "lmptype.h"

#include <vector>

namespace LAMMPS_NS {
class Fix;
class FixSPHBulk;
class LAMMPS;

namespace SPHDissipation {
  class Fluid;
  class OpenCondition;
  class OpenPlane;
  class OpenValues;

  // Checks of a buffer zone and the fluid in front of it.  Called by all ranks; errors name the style of
  // the fix.

  // the groups are static, no particle is in both, those of the zone are of the fluid and moved by no
  // other fix

  void check_open_groups(LAMMPS *, const Fix *, const Fluid *, int fluid_group);

  // the fix that moves what enters

  FixSPHBulk *find_open_integrator(LAMMPS *, const Fix *, int fluid_group);

  // particles of the fluid are in front of the plane, those of the zone, and of no other one, behind it

  void check_open_places(LAMMPS *, const Fix *, const OpenPlane &, int fluid_bit);

  // Each particle of the zone, and the place at that height in front of it, is in the region; slack:
  // no farther beside it than this

  void check_open_region(LAMMPS *, const Fix *, const OpenPlane &, double height, double slack);

  // the neighbor lists have the pairs of the zone with the fluid and with itself, and are built anew

  void check_open_lists(LAMMPS *, const Fix *, int fluid_bit);

  // the energy, or temperature, that is prescribed for the zone is enough for its heat

  void check_open_heat(LAMMPS *, const Fix *, const Fluid *, const OpenValues &);

  // A warning if particles of a new zone have no heat, though it conducts or has a pressure; owned = those of this processor

  void warn_of_cold_zone(LAMMPS *, const Fix *, const Fluid *, const OpenCondition &,
                         const std::vector<int> &owned);

  // a warning if other pair styles, whose forces are not in the balance, act between zone and fluid

  void check_open_styles(LAMMPS *, const Fix *, const Fluid *, int fluid_bit);

  // A warning if the masses of the zone are not quite those of the fluid, as when density rho0 has set
  // the latter before the zone was there

  void check_open_masses(LAMMPS *, const Fix *, int fluid_bit);

  // a warning if the sums of the kernel give the zone other densities than are prescribed; ratios of
  // the two of particles of this processor

  void check_open_density(LAMMPS *, const Fix *, const std::vector<double> &ratios);

  // Warn of a gap between what enters and the fluid in front of it, wider than two particles, up to two
  // support radii from the plane; spacing = of the zone, radius = of the fluid that a node of the plane
  // sees.  True if there is one.

  bool warn_of_gap(LAMMPS *, const Fix *, const OpenPlane &, const Fluid *, int fluid_bit,
                   double radius, double spacing);

  // The zone is so long that its particles have a full support while they are within the support
  // radius of the fluid, even if rows are shorter by one spacing and by the motion of the fluid
  // between two neighbor lists

  void check_open_length(LAMMPS *, const Fix *, const OpenPlane &, double support, double spacing);

  // Where the fluid leaves faster than sound, no wave comes back, and nothing can be prescribed.
  // number = of such particles; true if there are any, after a warning

  bool warn_of_supersonic(LAMMPS *, const Fix *, bigint number);

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
