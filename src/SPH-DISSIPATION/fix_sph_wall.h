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

#include <memory>
#include <set>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {
  class Bodies;
  class Fluid;
  class Value;
  class WallMotion;
  struct ContactLaw;
  struct WallCondition;
  enum class WallHeat;
  struct WallVelocity;
}    // namespace SPHDissipation

// Solid wall of particles for the fluids sph/bulk and sph/micropolar: moves the wall particles, extrapolates velocity,
// pressure, spin and temperature of the fluid to them, sums up force and torque on them and the heat that they give.
// S. Adami, X. Y. Hu, N. A. Adams, J. Comput. Phys. 231, 7057 (2012).

class FixSPHWall : public Fix, public SPHDissipation::Boundary {
 public:
  FixSPHWall(class LAMMPS *, int, char **);
  ~FixSPHWall() override;
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup_pre_force(int vflag) override { pre_force(vflag); }
  void setup(int) override;
  void min_setup(int vflag) override { min_post_force(vflag); }
  void initial_integrate(int) override;
  void post_integrate() override;
  void final_integrate() override;
  void end_of_step() override;
  void pre_force(int) override;
  void post_force(int) override;
  void min_post_force(int) override;
  void post_run() override;
  double compute_vector(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  void grow_arrays(int) override;
  void set_arrays(int) override;
  void copy_arrays(int, int, int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  double memory_usage() override;

  int boundary_bit() const override { return groupbit; }
  void move_surface(SPHDissipation::BoundaryStage &, SPHDissipation::Surface *, bool) override;
  void set_boundary(SPHDissipation::BoundaryStage &, const SPHDissipation::Surface *,
                    const SPHDissipation::BoundarySum *) override;
  bool has_symmetric_friction() const override { return noise || bodies; }
  bool has_bodies() const override { return bodies != nullptr; }
  bool has_elastic_bodies() const override { return elastic; }
  bool has_mean_pressure() const override { return !bodies && !noise; }
  int number_bodies(int, double *) override;
  SPHDissipation::RigidMotions *rigid_motions() override;
  const SPHDissipation::ContactLaw *contact() const override { return law.get(); }
  bool gives_heat() const override;
  void set_heat(SPHDissipation::BoundaryStage &, const SPHDissipation::Surface *, bool) override;

 protected:
  const std::unique_ptr<SPHDissipation::WallMotion>
      motion;    // of the wall; torques are about the point on the axis of the motion
  const std::unique_ptr<SPHDissipation::WallCondition> condition;
  bool move = true;
  std::unique_ptr<SPHDissipation::Bodies> bodies;     // which the fluid moves; nullptr: a wall
  bool elastic = false;                               // bodies whose particles move one by one
  int first_number = 0;                               // of the first body in BoundaryStage
  std::unique_ptr<SPHDissipation::ContactLaw> law;    // of the contact of bodies; nullptr: none
  bool noise = false;                                 // the fluid has thermal noise
  bool checked = false;    // setup() has run, and has checked the thickness

  double total[6] = {}, total_all[6] = {};    // force and torque: of this rank; of all ranks
  bool total_summed = false;

  SPHDissipation::WallHeat heat;
  const std::unique_ptr<SPHDissipation::Value>
      heat_value;    // temperature, or heat per area and time
  const std::unique_ptr<SPHDissipation::Value[]>
      gravity;    // acceleration of the fluid by a body force along x, y, z
  bool gravity_varies() const;

  bool turns_surface(bool before) const;
  void book_heat();
  void add_contact();

 private:
  // Heat that this rank's part of the wall gives to the fluid; on rank 0 also the heat of a restart file

  double heat_rate = 0.0;     // per time, in the last step
  double heat_given = 0.0;    // since the fix was defined

  // bodies that the fluid moves: one for each molecule; keyword body is given

  bool by_molecule, split_given = false;
  void read_bodies(const std::string &others);
  void check_bodies(const SPHDissipation::Fluid *) const;
  bool check_movers() const;
  void check_integrator() const;
  const char *kind() const { return elastic ? "elastic" : "rigid"; }    // of move
  void check_masses() const;
  void check_tension(const SPHDissipation::Fluid *) const;
  void check_pieces(const SPHDissipation::Fluid *) const;
  void set_acting();
  void note_forces();
  void add_rest_of_heat();

  bool is_wrong(double value) const;    // true: keyword heat cannot have this value
  void check_heat() const;
  void from_point(int, const SPHDissipation::WallVelocity &, double *) const;
  bool set_velocity();    // returns true if the velocity of an owned particle has changed

  // in fix_sph_wall_checks.cpp

  std::vector<int> excluded;    // groups whose pairs with the wall this fix has excluded

  void exclude_walls();
  void include_walls();
  int find_excluded(int first, int second) const;
  void check_particles() const;
  std::set<int> interacting_types(const SPHDissipation::Fluid *) const;
  void check_thickness(const SPHDissipation::Fluid *) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
