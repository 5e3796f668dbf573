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

  // What the commands between two runs have changed.  When a run ends, each particle gets a trace, hashes of what it has; it
  // takes them along, also through restart files.  When the next run begins, the hashes are compared.

  // what a particle has

  enum Trait { PLACE, VELOCITY, SPIN, TYPE, MASS, DENSITY, ENERGY, STATES, NTRAIT };

  // what is traced of it: REST leaves out what moves and what flows, of walls

  enum class Traced { NOTHING, REST, ALL };

  struct Changes {
    bool known = false;        // a run has ended before
    bool particles = false;    // some have come or gone
    bool box = false;          // in periodic directions
    bool step = false;         // its number
    bool of[NTRAIT] = {};      // of particles that have stayed

    // neither motion nor neighbors
    bool none_of_motion() const
    {
      return known && !particles && !box && !of[PLACE] && !of[VELOCITY] && !of[SPIN] && !of[TYPE];
    }
    // The same particles at other places: then densities of density continuity follow their sums as in a motion, otherwise
    // they stay.  Those that a command has set stay, and all others with them
    bool places_alone() const
    {
      return known && !particles && of[PLACE] && !of[TYPE] && !of[MASS] && !of[DENSITY];
    }
    // positions are those of another time: a command may read them, with the velocities, or set the number of the step
    bool other_time() const { return of[PLACE] && (of[VELOCITY] || step); }
  };

  void leave_traces(LAMMPS *, const std::function<Traced(int)> &);
  Changes find_changes(LAMMPS *, const std::function<Traced(int)> &);    // on all processors

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
