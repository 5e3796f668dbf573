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
FixStyle(sph/wall,FixSPHWall);
// clang-format on
#else

#ifndef LMP_FIX_SPH_WALL_H
#define LMP_FIX_SPH_WALL_H

#include "fix.h"

#include "sph_dissipation_boundary.h"

namespace LAMMPS_NS {

// Solid wall of particles for the fluids sph/bulk and sph/micropolar: moves them, extrapolates
// velocity, pressure and spin of the fluid to them, sums up force and torque on them.
// S. Adami, X. Y. Hu, N. A. Adams, J. Comput. Phys. 231, 7057 (2012).

class FixSPHWall : public Fix, public SPHDissipation::Boundary {
 public:
  FixSPHWall(class LAMMPS *, int, char **);
  ~FixSPHWall() override;
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void post_force(int) override;
  double compute_vector(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  double memory_usage() override;

  int boundary_bit() const override { return groupbit; }
  bool boundary_vorticity() const override;
  void set_boundary(SPHDissipation::Engine &, const SPHDissipation::BoundarySum *) override;
  void set_boundary_spin(SPHDissipation::Engine &, const SPHDissipation::BoundarySum *,
                         double **) override;

 private:
  // number, or equal-style variable, and its value at the ends of the last step

  struct Value {
    char *name = nullptr;    // of the variable
    int variable = -1;       // its index
    double now = 0.0, before = 0.0;
  };
  enum Spin { ZERO, RATE, FREE };

  Value velocity[3], spin_rate;    // of the wall; spin_rate = angular velocity
  double point[3], axis[3];        // of the rotation; the torque is about the point
  double gravity[3];
  bool rotates, move, slip;
  Spin spin;
  double rate;    // alpha of spin rate

  class PairSPHBulk *pair;
  bool thickness_checked;
  int nmax;
  double total[6], total_all[6];    // force and torque, of this rank and of all
  bool total_summed;

  void value_argument(Value &, const char *);
  void evaluate(Value &);
  void evaluate_all();
  void from_point(int, double *) const;
  void set_velocity();
  void angular_velocity(double *) const;
  void check_group();
  void check_thickness();
};

}    // namespace LAMMPS_NS

#endif
#endif
