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

#ifdef FIX_CLASS
// clang-format off
FixStyle(sph/dt,FixSPHDt);
// clang-format on
#else

#ifndef LMP_FIX_SPH_DT_H
#define LMP_FIX_SPH_DT_H

#include "fix.h"

namespace LAMMPS_NS {
namespace SPHDissipation {
  class CoeffTable;
  class Fluid;
}    // namespace SPHDissipation

// Adapts the time step to the limits of sound, viscosity, and forces.

class FixSPHDt : public Fix {
 public:
  FixSPHDt(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup_pre_force(int) override;
  void setup(int) override;
  void end_of_step() override;
  double compute_scalar() override;
  double compute_vector(int n) override { return limits[n]; }

 private:
  enum { ACOUSTIC, VISCOUS, FORCE, NLIMIT };
  SPHDissipation::Fluid *fluid = nullptr;
  double part[NLIMIT];               // factors of the limits
  bool given[NLIMIT] = {};           // factors from keywords
  double smallest = 0.0, largest;    // bounds of the time step
  double limits[NLIMIT] = {};        // the last limits of the time step
  bool set_up = false;               // setup() has run since the fix was defined

  double allowed_step(const SPHDissipation::CoeffTable &);
  void reset_step(double);
};

}    // namespace LAMMPS_NS

#endif
#endif
