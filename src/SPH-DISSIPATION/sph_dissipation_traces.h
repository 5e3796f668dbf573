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

#ifndef LMP_SPH_DISSIPATION_TRACES_H
#define LMP_SPH_DISSIPATION_TRACES_H

#include "lmptype.h"

#include <functional>

namespace LAMMPS_NS {
class LAMMPS;

namespace SPHDissipation {

  // Changes by commands between two runs.  At the end of a run, each particle gets a trace: hashes of its traits, which the
  // particle keeps, also in restart files.  The next run compares the hashes.

  // Traits of a particle

  enum Trait { PLACE, VELOCITY, SPIN, TYPE, MASS, DENSITY, ENERGY, STATES, NTRAIT };

  // Traced traits: REST, for walls, has place, type, and mass alone

  enum class Traced { NOTHING, REST, ALL };

  struct Changes {
    bool known = false;        // a run has ended before
    bool particles = false;    // particles have come or gone
    bool box = false;          // the box has changed, in periodic directions
    bool step = false;         // the number of the step has changed
    bool of[NTRAIT] = {};      // this trait has changed, of particles that have stayed

    // Return true if nothing has changed motion or neighbors
    bool none_of_motion() const
    {
      return known && !particles && !box && !of[PLACE] && !of[VELOCITY] && !of[SPIN] && !of[TYPE];
    }
    // Return true for the same particles at other places: then densities of density continuity change as their sums, as in a
    // motion; otherwise, and if a command has set any of these densities, all densities stay
    bool places_alone() const
    {
      return known && !particles && of[PLACE] && !of[TYPE] && !of[MASS] && !of[DENSITY];
    }
    // Return true if positions belong to another time: velocities, or the number of the step, have changed as well
    bool other_time() const { return of[PLACE] && (of[VELOCITY] || step); }
  };

  void leave_traces(LAMMPS *, const std::function<Traced(int)> &);
  Changes find_changes(LAMMPS *, const std::function<Traced(int)> &);    // on all processors

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
