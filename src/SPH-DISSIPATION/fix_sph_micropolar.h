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
FixStyle(sph/micropolar,FixSPHMicropolar);
// clang-format on
#else

#ifndef LMP_FIX_SPH_MICROPOLAR_H
#define LMP_FIX_SPH_MICROPOLAR_H

#include "fix_sph_bulk.h"

namespace LAMMPS_NS {

// The integrator of sph/bulk, and the spin of the particles: m I d(omega)/dt = torque with a moment
// of inertia that stays constant, so that angular momentum is conserved exactly.

class FixSPHMicropolar : public FixSPHBulk {
 public:
  FixSPHMicropolar(class LAMMPS *, int, char **);
  void init() override;
  void setup_pre_force(int) override;
  void setup(int) override;
  void initial_integrate(int) override;
  void pre_force(int) override;
  void final_integrate() override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  void arrive(int) override;
  void depart(int) override;
  void set_inertia() override;

 protected:
  void reset_extrapolation(int, int, int) override;
  const double *spin_of(int) const override;

  // a particle without inertia gets one, or is an error, when the neighbor list is new
  bool needs_inertia() const { return inertia_flag || has_torques(); }

 private:
  int inertia_flag;    // 1: the keyword is there, I = factor V^(2/n) + offset
  double factor, offset;
  bool inertia_done;    // the particles have the inertia of these numbers, but for new ones

  class AtomVecSPHMicropolar *spinning() const;
  bool has_torques() const;
  void set_inertia_of_arrivals();
  void set_inertia_of(int i);    // unless it has one
  void check_inertia() const;
  void integrate_spin(bool);
};

}    // namespace LAMMPS_NS

#endif
#endif
