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

#ifdef PAIR_CLASS
// clang-format off
PairStyle(sph/bulk,PairSPHBulk);
// clang-format on
#else

#ifndef LMP_PAIR_SPH_BULK_H
#define LMP_PAIR_SPH_BULK_H

#include "pair.h"

namespace LAMMPS_NS {
namespace SPHDissipation {
  class Boundary;
  class BoundaryStage;
  class CoeffTable;
  class CrowdingStage;
  class DensityStage;
  class Engine;
  class Exchange;
  class FluidModel;
  class ForceStage;
  class LimitStage;
  class NoiseStage;
  class OpenStage;
  class OpenZone;
  class PairTally;
  class PressureStage;
  class ViscousStage;
  struct ViscousSettings;
}    // namespace SPHDissipation

// Particle fluid with independent shear and bulk viscosity: pressure of an equation of state,
// shear force by pairs, bulk force through the rate of change of the particle volume.

class PairSPHBulk : public Pair {
 public:
  PairSPHBulk(class LAMMPS *);
  ~PairSPHBulk() override;

  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
  void *extract(const char *, int &) override;
  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *) override;
  void write_data(FILE *) override;
  void write_data_all(FILE *) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  double memory_usage() override;

  // the fluid's pair style, of whatever name, alone or in hybrid/overlay; nullptr if there is none

  static PairSPHBulk *find(class Force *);

  // table of viscosities, model coefficients and time-step limits by type pair, when the
  // coefficients are new; warning when the time step is too large.  From the setup() of the
  // integrator, in every run, with the particles and their properties as they enter the first step

  virtual void announce();

  // masses of the particles of a group, times a factor of each type, for which their mean density
  // is rho0; from the setup_pre_force() of the integrator

  virtual void set_mean_density(int groupbit);

  // of the last force computation, see ForceStage::heating()

  virtual void heating(double *heat, double *power) const;
  virtual bool has_forces() const;    // of the last step, for the particles that are there now

  // of the equation of state, on this processor: of the last force computation, or where particles,
  // with their ghosts, are now

  enum Moment { LAST_FORCES, NOW };
  virtual double elastic_energy(Moment);

  // From the init() of a fix: its particles are a boundary, not fluid.  It stays one until it is
  // removed, when the fix is deleted; the pair style may be another one then, see find().

  void add_boundary(SPHDissipation::Boundary *);
  void remove_boundary(SPHDissipation::Boundary *);
  bool is_boundary(int i) const;    // owned or ghost particle

  // the same for particles of the fluid with a prescribed state, where it enters or leaves

  void add_open_zone(SPHDissipation::OpenZone *);
  void remove_open_zone(SPHDissipation::OpenZone *);
  int not_fluid() const;    // bits of the groups of all boundaries and open zones

  // from the init() of a fix, in every run: it shifts particles to where they are less crowded.
  // Then crowding() of an owned particle, 1/length, points there.

  void request_crowding() { crowding_requested = true; }
  const double *crowding(int i) const;

  // from the init() of all integrators of the fluid, in every run, with the bits of their groups
  void set_viscous(const SPHDissipation::ViscousSettings &, int groups);
  bool has_viscous_stage() const;    // the velocity in the friction is found by a stage of its own
  const double *viscous_statistics() const;    // see ViscousStage

  // from them, of a particle that they have moved: this stage needs what other styles add to the forces

  void carry_other_force(int i, double keep);
  void carry_other_torque(int i);

  // from the setup_pre_exchange() of all integrators: the run continues the last one, and the velocities in
  // the friction are those of its last step
  void set_continued(bool flag) { continued = flag; }
  bool is_continued() const { return continued; }

  // from all ranks before the first forces of a run: what the fluid touches moves in another way than in the
  // last step, whose velocities in the friction are not those of this run
  void note_change() { changed = true; }

  // of the last step, on an owned particle, without what other styles add
  const double *own_force(int i) const;
  const double *own_torque(int i) const;

  virtual void find_volumes();    // before the first step, from the positions alone

  // of the fluid as it is now: largest stable time steps; time in which a particle falls by the length
  // that stability knows, at least

  SPHDissipation::CoeffTable coeff_table();
  double fall_time() const;

  bool has_noise() const;               // keyword temp
  bool has_own_temperatures() const;    // temp energy: of the particles
  double internal_temperature(int i) const;

  bool is_set_up() const { return list && set_up; }    // what the commands say is in effect

  double support_radius() const { return support; }
  int dimension() const { return dim; }    // of the kernel
  double reference_density(int) const;     // of a type
  bool has_type(int) const;                // particles of a type are of this fluid
  const SPHDissipation::FluidModel &fluid() const { return *model; }
  double bulk_viscosity(int) const;    // of a type, in effect in the last force computation

 protected:
  class StressTally;

  const std::string fluid_style;        // also of the atom style and the integrator
  SPHDissipation::FluidModel *model;    // what pair_style and pair_coeff set
  int dim;                              // dimension of the kernel
  double support;                       // support radius rc
  bool set_up;                          // since pair_style and pair_coeff
  bool announced;                       // the table of coefficients is up to date
  bool stale;                           // what follows from the coefficients is to be derived anew
  double warned_step;                   // the time step that the last warning was about
  double noise_step;                    // the time step that was announced with the noise

  // the two pair loops, and the stages around them

  SPHDissipation::Engine *engine;
  SPHDissipation::Exchange *exchange;
  SPHDissipation::DensityStage *density;
  SPHDissipation::LimitStage *limit;
  SPHDissipation::PressureStage *pressure;
  SPHDissipation::OpenStage *open;
  SPHDissipation::BoundaryStage *boundary;
  SPHDissipation::CrowdingStage *crowd;
  SPHDissipation::NoiseStage *noise;
  SPHDissipation::ForceStage *forces;
  SPHDissipation::ViscousStage *viscous;
  bool crowding_requested;
  bool continued;
  bool changed;    // other coefficients, or motions of walls, than those of the last forces

  PairSPHBulk(class LAMMPS *, const std::string &, bool spins);

  virtual void allocate();

  virtual double **extrapolated_spin() { return nullptr; }
  virtual const double *spin_inertia() { return nullptr; }    // per mass
  double smallest_inertia();    // per mass, of all particles that have one

  virtual void check_setup();
  void find_own_types();
  void derive_coeffs();
  bigint sum_before_forces();
  void sum_forces(SPHDissipation::PairTally *);
  void find_viscous_velocity();
  void adopt_changes();
  void check_time_step(const SPHDissipation::CoeffTable &);
  double stability_length() const;
  void announce_noise(double rate);
  void tally_energy();
};

}    // namespace LAMMPS_NS

#endif
#endif
