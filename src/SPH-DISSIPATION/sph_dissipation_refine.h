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

  // A particle, with all numbers that its neighbors need in an event.  All members are doubles, for messages.

  struct RefineItem {
    double state;     // RefineState, see is()
    double mask;      // bits of its groups
    double volume;    // present volume
    double most;      // largest volume that a merge may give the particle
    double family;    // lowest new ID of the daughters of its split; 0: none
    Lump lump;

    // Partner of a merge: ID of the chosen particle, or number of the family that merges as a whole; settled: nonzero when
    // the choice is final

    double choice, settled;
    double postponed;    // nonzero: no event in this step; for particles that split or lead a merge

    // The particle in the sums of its neighbors.  A pair that merges counts as a point in the center of mass of the pair: the
    // particle with the lower ID has all mass, its partner has no mass

    double mass, center[3], u[3];    // center: relative to the particle

    double gives;    // nonzero: neighbors take the residual angular momentum of this particle
    Rotation rotation;

    bool is(RefineState one) const { return state == static_cast<double>(one); }
  };

  // Items of all owned and ghost particles during one event

  class RefineItems : protected Pointers {
   public:
    RefineItems(class LAMMPS *lmp, Fix *fix) : Pointers(lmp), fix(fix) {}

    void resize();    // makes room for the present particles; sets zeros
    RefineItem &operator[](int i) { return items[i]; }
    const RefineItem &operator[](int i) const { return items[i]; }

    // Send numbers of the items to ghosts, from member first on; number = 0: all numbers from there on.  Ghosts keep the
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
    int first = 0, count = 0;    // first and count of the numbers of an item in a message
  };

  // Finds the partners of merges.  Each particle that should merge chooses the nearest possible partner; two particles that
  // have chosen each other are settled, the others choose again.  IDs decide between distances that are equal up to
  // round-off: so the pairs do not depend on the number of processors.
  //
  // A family is all daughters of one split.  Families of spinning particles in three dimensions merge first and as a whole:
  // merges of one pair after the other would not restore the moment of inertia of the parent.

  class RefinePairs : protected Pointers {
   public:
    RefinePairs(class LAMMPS *lmp, RefineItems &items) : Pointers(lmp), items(items) {}

    void clear();
    void find_families(NeighList *full, double farthest, int size);
    void find(NeighList *full, double farthest);
    int mate(int i) const { return mates[i]; }    // owned or ghost particle; -1: none
    bool leads(int i) const;                      // owned particle of a pair: true if i stays
    std::vector<int> members(int i) const;        // particles of the merge that i leads

   private:
    RefineItems &items;
    std::vector<int>
        mates;    // partner; in a family: a member for the leader, the leader for other members
    std::map<int, std::vector<int>> families;    // members, by leader

    void settle();    // marks owned particles with a partner; sends the marks to ghosts
    bool is_first(int i) const;
    bool fits(int i, int j) const;    // types, groups, and volumes of i and j let both merge
    double distance_sq(int i, int j) const;
    bool nearer(int i, int j, int other) const;    // j is nearer to i than other
    std::vector<int> family(int i, const int *neighbors, int n, double farthest_sq) const;
    int nearest(int i, const int *neighbors, int n, double farthest_sq) const;    // -1: none
  };

  // Gives the residual angular momentum of a merge, which a particle without spin cannot hold, to the neighbors as a
  // rigid rotation.  Each planned pair counts as one point, even if the pair does not merge in the end.

  class RefineResidual : protected Pointers {
   public:
    RefineResidual(class LAMMPS *lmp, RefineItems &items, const RefinePairs &pairs) :
        Pointers(lmp), items(items), pairs(pairs)
    {
    }

    void init(double radius_in) { radius = radius_in; }

    // Find the rotation of the neighbors of owned particle i.  Return false if no rotation has this angular momentum.
    bool give(NeighList *full, int i, const double *angmom);

    // Sum the velocity change of each owned particle, and the work of the change; in a pair, the lower ID has both.
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

  // Does all splits and merges of one time step, on all processors at once: plan() decides from the present particles,
  // carry_out() changes the particles.

  class RefineEvent : protected Pointers {
   public:
    RefineEvent(class LAMMPS *lmp, Fix *fix, RefineBalance &balance) :
        Pointers(lmp), items(lmp, fix), balance(balance), pairs(lmp, items),
        residual(lmp, items, pairs)
    {
    }

    void init(const Fluid &, double smallest_share);

    // For each owned particle, set the action, the present volume, the most volume after a merge, and the target volume.
    void begin();
    void set(int i, RefineState, double volume, double most, double target, double family);

    // Decide which particles merge and how particles split, in at most that many events: changes the items alone.  Return
    // the number of events on all processors.
    bigint plan(NeighList *full, bigint most);

    // Split and merge.  Calls changed(i, family) for each owned particle that an event has made.
    typedef std::function<void(int i, double family)> Changed;
    void carry_out(NeighList *full, const Changed &changed);

    RefineItems items;
    tagint highest = 0;    // highest ID ever given

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

    Lump lump(int i) const;                // of owned particle i, from the arrays of LAMMPS
    void set_lump(int i, const Lump &);    // sets these arrays, states and density excepted
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
