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
FixStyle(sph/bulk,FixSPHBulk);
// clang-format on
#else

#ifndef LMP_FIX_SPH_BULK_H
#define LMP_FIX_SPH_BULK_H

#include "fix.h"

#include <memory>

namespace LAMMPS_NS {
namespace SPHDissipation {
  struct Changes;
  class Fields;
  class Fluid;
  class Value;
  struct ViscousSettings;
  enum class Traced;
  struct TimeStep;
  struct VolumeStep;
}    // namespace SPHDissipation

// Velocity Verlet for position, velocity and internal energy of a particle fluid.  The forces have the velocity extrapolated
// to the end of the step: vest = v + dt f/m.  With thermal noise, vest is the velocity in the middle of the step: then, in
// the linear regime, the velocities at both ends have exactly the temperature of the noise, for any time step.  With large
// viscosities, vest carries the forces of other styles to ViscousStage.  sph/micropolar also integrates spins: m I
// d(omega)/dt = torque, with a constant moment of inertia, so that angular momentum is conserved exactly.

class FixSPHBulk : public Fix {
 public:
  enum Half { BEGIN, END };    // of a step

  FixSPHBulk(class LAMMPS *, int, char **);
  ~FixSPHBulk() override;
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup_pre_force(int) override;
  void setup(int) override;
  void initial_integrate(int) override;
  void post_integrate() override;
  void pre_force(int) override;
  void final_integrate() override;
  void reset_dt() override;
  double compute_vector(int) override;
  void set_arrays(int) override;
  void post_run() override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  // Set masses, then inertia from the volumes, once, before the first forces.  A fix that needs masses or inertia before the
  // setup of the integrator also calls these functions
  void set_masses();
  void set_inertia();
  bool has_set_masses() const { return density_flag && density_done; }

  // Let a particle join the group, or leave it, within a step, after the first half of the kick
  void arrive(int i);
  void depart(int i);

  bool shifts_particles() const { return shift_by_rate || shift_speed > 0.0; }
  bool has_viscous_stage() const;

 protected:
  double dtv = 0.0, dtf = 0.0;
  bool diffuses = false;          // densities change by the diffusion of volume
  bool exact = false;             // motion and heat exchange energy exactly, see integrate()
  double shift_speed = 0.0;       // U of particle shifting, twice the limit of its velocity
  bool forces_jump = false;       // particles were shifted in this step, without exact
  bool shift_by_rate = false;     // U follows the local rate of shear instead
  int remap_v_flag = 0;           // fix deform remaps velocities at periodic boundaries
  int integrated_groups = 0;      // bits of all groups with an integrator of this kind
  bool first_instance = false;    // this fix acts for particles outside all these groups, too
  SPHDissipation::Fluid *fluid = nullptr;    // fluid of the same style; nullptr: none
  void check_set_up();
  void begin_step();
  void end_step();
  void shift_particles();    // the first instance shifts particles of all instances
  int nlocal_group() const;
  int bits_not_followed() const;    // groups for which reset_extrapolation() does not set vest
  SPHDissipation::TimeStep time_step() const;
  SPHDissipation::VolumeStep volume_step() const;    // without arrays

  bool sets_temperatures() const;    // in setup_pre_force()

  // Return true if particles without inertia get one at a new neighbor list, or are an error
  bool needs_inertia() const { return inertia_flag || has_torques(); }

 private:
  const std::string fluid_style;    // also of the atom style and the pair style, without suffix
  const bool spins;                 // the particles have spins
  double dt_of_forces = 0.0;        // time step of the last forces
  double dt_of_states = 0.0;        // time step for which the states hold
  double extrapolation = 1.0;       // of velocities over half a step: 1, with thermal noise 0
  bool balanced = false;            // heat gets half of its rate at each end of a step, temp energy
  const std::unique_ptr<SPHDissipation::ViscousSettings> viscous;
  std::unique_ptr<SPHDissipation::Value> temperature;    // at the start, nullptr without
  bool temperature_done = false;    // particles have the temperature, also from a restart file

  SPHDissipation::Fields &fields() const;
  void read_keywords(int narg, char **arg);
  void integrate(Half);

  void reset_extrapolation();    // of particles that no such fix integrates

  // A run continues the last run with the extrapolated quantities of the last step, if neither positions nor velocities of
  // particles and walls have changed between the runs

  struct Last {
    bool known;    // a step was taken
    double dt;     // length of the step
  };
  Last last = {};
  std::unique_ptr<SPHDissipation::Changes>
      changes;    // between the runs, of all groups; first instance only
  SPHDissipation::Traced traced(int i) const;
  void leave_traces();
  bool is_continued() const;
  void check_integrated_once();
  void warn_of_jump() const;
  void init_viscous();
  SPHDissipation::Fluid *find_own_fluid() const;
  void warn_not_integrated();
  void add_remapped_velocity();
  bool has_torques() const;
  void set_temperatures();
  void set_inertia_of(int i, double &inertia) const;    // unless the particle has inertia
  void check_inertia() const;

  int inertia_flag = 0;    // 1: the keyword is there, I = factor V^(2/n) + offset
  double factor = 0.0, offset = 0.0;
  bool inertia_done = false;           // particles have inertia from these numbers, except new ones
  int density_done = 0;                // the masses were set, in this run or before a restart
  int density_flag = 0;                // set the masses so that the mean density is rho0
  bool set_up = false;                 // a setup has run since the fix was defined
  FixSPHBulk *first = nullptr;         // the first instance
  bool energy_extrapolated = false;    // for the first forces of a run
  bigint setup_step = 0;               // step of the last setup
  bool last_instance = false;          // this fix acts after the setup of all instances
  bigint not_integrated = 0,
         rigid_alone = 0;    // # of fluid particles in the last warnings
};

}    // namespace LAMMPS_NS

#endif
#endif
