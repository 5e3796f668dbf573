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

#ifndef LMP_SPH_DISSIPATION_OPEN_LEDGER_H
#define LMP_SPH_DISSIPATION_OPEN_LEDGER_H

#include "pointers.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  class Fields;
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
    void carry(Direction, int i, const double *v, double esph, const Fields &);

    void set_impact(const OpenImpact &);    // of the present forces
    void advance(double time);              // those act for this time

    void total(double *all) const;    // NVALUE
    void restart(const double *all);

   private:
    double sum[NVALUE];
    double rate[NVALUE - IMPULSE];
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
