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

#ifndef LMP_SPH_DISSIPATION_REFINE_ITEMS_H
#define LMP_SPH_DISSIPATION_REFINE_ITEMS_H

#include "pointers.h"
#include "sph_dissipation_split.h"

#include <vector>

namespace LAMMPS_NS {
class Fix;

namespace SPHDissipation {

  // what a particle does in an event

  enum RefineState { APART, KEEPS, SPLITS, MERGES };    // APART: no fluid

  // A particle and what its neighbors are to know of it in an event; all doubles, to be sent as rows

  struct RefineItem {
    double state;     // RefineState, see is()
    double mask;      // bits of its groups
    double volume;    // now
    double most;      // volume that a merge may give it
    double family;    // of the daughters of one split, the lowest of their new IDs; 0: none
    Lump lump;

    // partner of a merge: ID of the particle that it would merge with, or the family that does as a
    // whole; nonzero once that is settled

    double choice, settled;
    double withheld;    // of the lowest ID of those that merge, or of one that splits: not now

    // The particle as its neighbors will meet it: a pair that merges is a point in its centre of
    // mass, whose mass the lower ID has, the other none

    double mass, center[3], u[3];    // center: from the particle

    double gives;    // its neighbors take over its rest of angular momentum
    Rotation rotation;

    bool is(RefineState one) const { return state == static_cast<double>(one); }
  };

  // Items of all owned and ghost particles during one event

  class RefineItems : protected Pointers {
   public:
    RefineItems(class LAMMPS *lmp, Fix *fix) : Pointers(lmp), fix(fix), first(0), count(0) {}

    void resize();    // for the particles that there are; zero
    RefineItem &operator[](int i) { return items[i]; }
    const RefineItem &operator[](int i) const { return items[i]; }

    // sends members of the items to the ghosts; all but the places of the particles themselves, which
    // ghosts have in frames of their own

    static constexpr int SIZE = sizeof(RefineItem) / sizeof(double);
    void forward_all();
    void forward_choice();
    void forward_settled();
    void forward_withheld();
    void forward_point();
    void forward_rotation();

    int pack(int n, const int *list, double *buf) const;
    void unpack(int n, int from, const double *buf);
    double memory_usage() const { return items.capacity() * sizeof(RefineItem); }

   private:
    Fix *fix;
    std::vector<RefineItem> items;
    int first, count;    // of the doubles of an item that are sent

    void forward(int first, int count);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
