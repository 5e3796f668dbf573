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

#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  class Fields;
  struct OpenImpact;

  // Balance of what a fix has added to and taken from the fluid since the fix was defined: sums of this processor; total()
  // sums over all processors.

  class Balance : protected Pointers {
   public:
    void add(int k, double value) { sum[k] += value; }
    void total(double *all) const;
    void restart(const double *all);

   protected:
    std::vector<double> sum;

    Balance(LAMMPS *lmp, int n) : Pointers(lmp), sum(n, 0.0) {}

    // Add a particle, times a factor, at these places of the sums, all but its internal energy:
    // number, mass, momentum, angular momentum about the origin, kinetic energy, also of the spin.
    void count(int first, double factor, const Lump &);
    enum { MASS = 1, MOMENTUM = 2, ANGMOM = 5, KINETIC = 8, NCOUNTED };    // after the first
  };

  // Particles that have come through the plane of a buffer zone; impulse and work of the forces of the zone on the fluid

  class OpenBalance : public Balance {
   public:
    enum Direction { IN, OUT };
    enum { INTERNAL = NCOUNTED, NCARRIED };    // after number ... kinetic energy, each direction
    enum { IMPULSE = 2 * NCARRIED, ANGULAR_IMPULSE = IMPULSE + 3, WORK = IMPULSE + 6, NVALUE };

    OpenBalance(LAMMPS *lmp) : Balance(lmp, NVALUE), rate() {}

    // Add an owned particle that changes sides with this velocity and internal energy
    void carry(Direction, int i, const double *v, double esph, const Fields &);

    void set_impact(const OpenImpact &);    // of the present forces
    void advance(double time);              // adds the impact of these forces over a time

   private:
    double rate[NVALUE - IMPULSE];
  };

  // Changes by splits and merges: afterwards - before

  class RefineBalance : public Balance {
   public:
    enum {
      SPLITS,    // particles that have split
      MERGES,    // pairs that have merged
      NUMBER,
      ELASTIC = NUMBER + NCOUNTED,    // energy of the equation of state
      INTERNAL,
      HEAT,        // heat of merges, in the internal energy
      ROTATION,    // energy of the rotation of neighbors, from the internal energy
      COLDEST,     // smallest heat of a merge
      NVALUE
    };

    RefineBalance(LAMMPS *);

    void merged(double heat);

    // Add a particle that is there afterwards, factor 1, or was there before, factor -1
    void count(double factor, const Lump &);

    void total(double *all) const;
    void restart(const double *all);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
