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

#ifndef LMP_SPH_DISSIPATION_REFINE_H
#define LMP_SPH_DISSIPATION_REFINE_H

#include "pointers.h"
#include "sph_dissipation_split.h"

#include <functional>
#include <map>
#include <vector>

namespace LAMMPS_NS {
class Fix;
class NeighList;

namespace SPHDissipation {

  class Fields;
  class Fluid;
  class RefineBalance;

  // Action of a particle in an event

  enum RefineState { NOT_FLUID, KEEPS, SPLITS, MERGES };

  // A particle, with all that its neighbors need in an event.  All doubles, to be sent as rows.

  struct RefineItem {
    double state;     // RefineState, see is()
    double mask;      // bits of its groups
    double volume;    // now
    double most;      // volume that a merge may give it
    double family;    // lowest new ID of the daughters of its split; 0: none
    Lump lump;

    // partner of a merge: ID of the chosen particle, or family that merges as a whole; settled: nonzero when the choice is
    // final

    double choice, settled;
    double
        postponed;    // nonzero: the event is over the limit of this step; set for who splits or leads a merge

    // The particle in the sums of its neighbors.  A pair that merges is a point in its center of mass: the particle with the
    // lower ID has all mass, the other one has none

    double mass, center[3], u[3];    // center: from the particle

    double gives;    // nonzero: its neighbors take its residual angular momentum
    Rotation rotation;

    bool is(RefineState one) const { return state == static_cast<double>(one); }
  };

  // Items of all owned and ghost particles during one event

  class RefineItems : protected Pointers {
   public:
    RefineItems(class LAMMPS *lmp, Fix *fix) : Pointers(lmp), fix(fix) {}

    void resize();    // for the present particles; sets zeros
    RefineItem &operator[](int i) { return items[i]; }
    const RefineItem &operator[](int i) const { return items[i]; }

    // Send so many numbers of the items, from member first on, to the ghosts; 0: all following numbers.  Ghosts keep the
    // positions of their periodic images.

    static constexpr int SIZE = sizeof(RefineItem) / sizeof(double);
    void forward(double RefineItem::*first, int number = 1);
    void forward_all();

    int pack(int n, const int *list, double *buf) const;
    void unpack(int n, int from, const double *buf);
    double memory_usage() const { return items.capacity() * sizeof(RefineItem); }

   private:
    Fix *fix;
    std::vector<RefineItem> items;
    int first = 0, count = 0;    // numbers of an item in the message
  };

  // Finds the partners of merges.  Each particle that should merge chooses the nearest possible partner; two that have
  // chosen each other are settled, the others choose again.  IDs decide between distances that are equal up to round-off, so
  // that the pairs do not depend on the number of processors.
  //
  // A family, all daughters of one split, merges first and as a whole, for spinning particles in three dimensions: pairs,
  // one after the other, would not restore the moment of inertia of the parent.

  class RefinePairs : protected Pointers {
   public:
    RefinePairs(class LAMMPS *lmp, RefineItems &items) : Pointers(lmp), items(items) {}

    void clear();
    void find_families(NeighList *full, double farthest, int size);
    void find(NeighList *full, double farthest);
    int mate(int i) const { return mates[i]; }    // owned or ghost particle; -1: none
    bool leads(int i) const;                  // owned particle of a pair: i is the one that stays
    std::vector<int> members(int i) const;    // particles of the merge that i leads

   private:
    RefineItems &items;
    std::vector<int>
        mates;    // partners; in a family: a member for the leader, the leader for the others
    std::map<int, std::vector<int>> families;    // members, by their leader

    void settle();
    bool is_first(int i) const;
    bool fits(int i, int j) const;
    double distance_sq(int i, int j) const;
    bool nearer(int i, int j, int other) const;    // j is nearer to i than other
    std::vector<int> family(int i, const int *neighbors, int n, double farthest_sq) const;
    int nearest(int i, const int *neighbors, int n, double farthest_sq) const;
  };

  // Gives the residual angular momentum of a merge, which a particle without spin cannot hold, to the neighbors as a
  // rotation.  Each planned pair counts as one point, even if the pair does not merge in the end.

  class RefineResidual : protected Pointers {
   public:
    RefineResidual(class LAMMPS *lmp, RefineItems &items, const RefinePairs &pairs) :
        Pointers(lmp), items(items), pairs(pairs)
    {
    }

    void init(double radius_in) { radius = radius_in; }

    // Find the rotation of the neighbors of owned particle i.  Return false if there is none.
    bool give(NeighList *full, int i, const double *angmom);

    // Sum up the velocity that each owned particle gets, and its work; the lower ID has those of a pair.
    void take(NeighList *full);
    const double *velocity(int i) const { return &du[3 * i]; }
    double work(int i) const { return works[i]; }
    void clear();

   private:
    RefineItems &items;
    const RefinePairs &pairs;
    double radius = 0.0;
    std::vector<double> du, works;

    void offset(int from, int to, double *r) const;
  };

  // Does all splits and merges of one time step, on all processors at once: plan() decides with the
  // particles as they are, carry_out() changes them.

  class RefineEvent : protected Pointers {
   public:
    RefineEvent(class LAMMPS *lmp, Fix *fix, RefineBalance &balance) :
        Pointers(lmp), items(lmp, fix), balance(balance), pairs(lmp, items),
        residual(lmp, items, pairs)
    {
    }

    void init(const Fluid &, double smallest_share);

    // Set the action of each owned particle, its present volume, the most that a merge may give it, and the target volume.
    void begin();
    void set(int i, RefineState, double volume, double most, double target, double family);

    // Decide which particles merge and how particles split, in at most so many events.  Changes the items only.  Return the
    // number of events on all processors.
    bigint plan(NeighList *full, bigint most);

    // Split and merge.  Calls changed(i, family) for each owned particle that has come from an event.
    typedef std::function<void(int i, double family)> Changed;
    void carry_out(NeighList *full, const Changed &changed);

    RefineItems items;
    tagint highest = 0;    // highest ID that was ever given

   private:
    RefineBalance &balance;
    RefinePairs pairs;
    RefineResidual residual;
    double support = 0.0;
    double smallest = 0.0;    // volume of a daughter over the target
    Fields *fields = nullptr;

    struct Split {
      int i;
      Stencil stencil;
    };
    struct Merge {
      int i;
      std::vector<Lump> parts;
      double volume = 0.0;
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
    bigint postpone(bigint most);
    void give_residual(NeighList *full);
    void move_others(const std::vector<char> &own_event);
    void create(const std::vector<tagint> &first, const Changed &changed);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
