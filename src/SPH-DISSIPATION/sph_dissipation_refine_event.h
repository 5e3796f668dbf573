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

#ifndef LMP_SPH_DISSIPATION_REFINE_EVENT_H
#define LMP_SPH_DISSIPATION_REFINE_EVENT_H

#include "pointers.h"
#include "sph_dissipation_refine_pairs.h"

#include <functional>
#include <vector>

namespace LAMMPS_NS {
class NeighList;

namespace SPHDissipation {

  class Fields;
  class Fluid;
  class RefineBalance;
  struct Parameters;

  // Does all splits and merges of one time step, on all processors at once: plan() decides with the
  // particles as they are, carry_out() changes them.

  class RefineEvent : protected Pointers {
   public:
    RefineEvent(class LAMMPS *, Fix *, RefineBalance &);

    void init(const Fluid &, double smallest_share);

    // Set what each owned particle is to do, its volume now and that of its target.
    void begin();
    void set(int i, RefineState, double volume, double most, double target, double family);

    // Decide who merges with whom and who splits how, in at most so many events.  Changes the items
    // only.  Returns the number of events on all processors.
    bigint plan(NeighList *full, bigint most);

    // Split and merge.  Calls changed(i, family) for each owned particle that has come from an event.
    typedef std::function<void(int i, double family)> Changed;
    void carry_out(NeighList *full, const Changed &changed);

    RefineItems items;
    tagint highest;    // ID that was ever given

   private:
    RefineBalance &balance;
    RefinePairs pairs;
    RefineResidual residual;
    double support;
    double smallest;    // volume of a daughter over the target
    Fields *fields;

    struct Split {
      int i;
      Stencil stencil;
    };
    struct Merge {
      int i;
      std::vector<Lump> parts;
      Lump whole;
      double heat, residual[3];
    };
    std::vector<double> targets;
    std::vector<Split> splits;
    std::vector<Merge> merges;

    Lump lump(int i) const;
    void set_lump(int i, const Lump &);
    void set_states(int i, const Lump &);
    bool merging(int i) const;
    bool families() const;    // all daughters of one split can merge as a whole
    bool find_stencil(NeighList *full, int i, Stencil &) const;
    bigint withhold(bigint most);
    void give_residual(NeighList *full);
    void move_others(const std::vector<char> &own_event);
    void create(const std::vector<tagint> &first, const Changed &changed);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
