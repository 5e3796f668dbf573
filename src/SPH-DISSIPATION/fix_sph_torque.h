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
FixStyle(sph/torque,FixSPHTorque);
// clang-format on
#else

#ifndef LMP_FIX_SPH_TORQUE_H
#define LMP_FIX_SPH_TORQUE_H

#include "fix.h"

#include <memory>

namespace LAMMPS_NS {
namespace SPHDissipation {
  class Value;
}

// Torque on every particle of a group from numbers or variables, and its work: the body torque m G
// of a micropolar fluid, P3 (15).

class FixSPHTorque : public Fix {
 public:
  FixSPHTorque(class LAMMPS *, int, char **);
  ~FixSPHTorque() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void post_force(int) override;
  double compute_scalar() override;
  double compute_vector(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  double memory_usage() override;

 private:
  const std::unique_ptr<SPHDissipation::Value[]> value;    // three
  double total[3] = {};    // torque on all particles in the last step, of this rank
  double power = 0.0;      // on this rank in the last step
  double work = 0.0;       // since the fix was defined, of this rank

  int receiving_groups = 0;    // bits of the groups whose spin is integrated
  bigint not_receiving = 0;    // # of particles in the last warning
  bool set_up = false;         // setup() has run since the fix was defined

  void check_receivers();
  void set_masks();
};

}    // namespace LAMMPS_NS

#endif
#endif
