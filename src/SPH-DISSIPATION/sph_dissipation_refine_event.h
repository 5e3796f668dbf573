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

  class RefineBalance;

  // All splits and merges of one time step, on all processors at once.  What happens is found out with
  // the particles as they are, then they are changed, then the lists of particles.

  class RefineEvent : protected Pointers {
   public:
    RefineEvent(class LAMMPS *, Fix *, RefineBalance &);

    void init(double support, double smallest_share);

    // what each owned particle is to do; volume: now, target: to have, both as they are
    void begin();
    void set(int i, RefineState, double volume, double most, double target, double family);

    // who merges with whom, who splits how; at most so many events; returns their number on all
    // processors, and changes nothing but the items
    bigint plan(NeighList *full, bigint most);

    // changed(i, family) is called for each owned particle that has come from an event
    typedef std::function<void(int i, double family)> Changed;
    void carry_out(NeighList *full, const Changed &changed);

    RefineItems items;
    tagint highest;    // ID that was ever given

   private:
    RefineBalance &balance;
    RefinePairs pairs;
    RefineRest rest;
    double support;
    double smallest;    // volume of a daughter over the target
    bool spinning;

    struct Split {
      int i;
      Stencil stencil;
    };
    struct Merge {
      int i;
      std::vector<Lump> parts;
      Lump whole;
      double heat, rest[3];
    };
    std::vector<double> targets;
    std::vector<Split> splits;
    std::vector<Merge> merges;

    Lump lump(int i) const;
    void set_lump(int i, const Lump &);
    bool merging(int i) const;
    bool families() const;    // that all daughters of one split can merge as a whole
    bool find_stencil(NeighList *full, int i, Stencil &) const;
    bigint withhold(bigint most);
    void give_rest(NeighList *full);
    void move_others(const std::vector<char> &own_event);
    void create(const std::vector<tagint> &first, const Changed &changed);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
