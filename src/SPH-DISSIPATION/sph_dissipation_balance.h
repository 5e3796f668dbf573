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

#ifndef LMP_SPH_DISSIPATION_BALANCE_H
#define LMP_SPH_DISSIPATION_BALANCE_H

#include "pointers.h"
#include "sph_dissipation_split.h"

namespace LAMMPS_NS {

namespace SPHDissipation {

  struct OpenImpact;

  // What particles have carried into the fluid and out of it through an open zone, and what the forces
  // of the zone have done to the fluid.  Sums of this processor; total() of all.

  class OpenLedger : protected Pointers {
   public:
    enum Direction { IN, OUT };
    enum {
      NUMBER,
      MASS,
      MOMENTUM,
      ANGMOM = 5,
      KINETIC = 8,
      INTERNAL,
      NCARRIED
    };    // each direction
    enum { IMPULSE = 2 * NCARRIED, ANGULAR_IMPULSE = IMPULSE + 3, WORK = IMPULSE + 6, NVALUE };

    OpenLedger(class LAMMPS *);

    // an owned particle changes sides with this velocity and internal energy
    void carry(Direction, int i, const double *v, double esph);

    void set_impact(const OpenImpact &);    // of the present forces
    void advance(double time);              // those act for this time

    void total(double *all) const;    // NVALUE
    void restart(const double *all);

   private:
    double sum[NVALUE];
    double rate[NVALUE - IMPULSE];
  };

  // What splits and merges have changed.  Sums of this processor; total() of all.

  class RefineLedger : protected Pointers {
   public:
    enum {
      SPLITS,    // particles that have split
      MERGES,    // pairs that have merged
      NUMBER,    // of the particles, and so on: afterwards - before
      MASS,
      MOMENTUM,
      ANGMOM = MOMENTUM + 3,
      KINETIC = ANGMOM + 3,    // with that of the spin
      ELASTIC,                 // of the equation of state
      INTERNAL,
      HEAT,        // of merges, in the internal energy
      ROTATION,    // energy that the rotation of neighbors took, out of the internal one
      COLDEST,     // smallest heat of a merge
      NVALUE
    };

    RefineLedger(class LAMMPS *);

    void add(int k, double value) { sum[k] += value; }
    void merged(double heat);

    // a particle that is there afterwards, factor 1, or was there before, factor -1
    void count(double factor, const Lump &);

    void total(double *all) const;    // NVALUE
    void restart(const double *all);

   private:
    double sum[NVALUE];
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
