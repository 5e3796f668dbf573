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

#ifndef LMP_SPH_DISSIPATION_FLUID_H
#define LMP_SPH_DISSIPATION_FLUID_H

#include "pointers.h"
#include "sph_dissipation_table.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class NeighList;
class Pair;

namespace SPHDissipation {

  class BoundaryStage;
  struct Changes;
  class ShiftStage;
  class DensityStage;
  class DiffusionStage;
  class Engine;
  class Exchange;
  class FluidModel;
  struct ForceSum;
  class ForceStage;
  class FlowStage;
  class FluidState;
  class LimitStage;
  class NeighborSearch;
  class NoiseStage;
  class OpenStage;
  class PairEnergyStage;
  class PairTally;
  struct StepPlan;
  class PressureStage;
  class StateStage;
  class TemperatureStage;
  class Threads;
  class ViscosityStage;
  class ViscousStage;

  // Particle fluid with independent shear and bulk viscosity: pressure of an equation of state,
  // viscous forces between pairs, and a bulk force from the rate of change of the particle volume.
  // It owns what the commands set, the pair loops, and the stages around them, and runs them in
  // their order.  The pair style is LAMMPS's interface to it; fixes and computes get it from
  // find_fluid().

  class Fluid : protected Pointers {
   public:
    // pair = of LAMMPS, which has the neighbor list and the communication; spins: particles rotate
    Fluid(class LAMMPS *, Pair *, bool spins);
    ~Fluid() override;

    Pair *const pair;
    const bool spins;
    const std::string style;    // of pair, atoms, and integrator, without suffix

    const std::unique_ptr<FluidModel> model;    // what the pair style's commands set

   protected:
    const std::unique_ptr<Engine> engine;
    const std::unique_ptr<Exchange> exchange;
    const std::unique_ptr<NeighborSearch> search;
    const std::unique_ptr<DensityStage> density;
    const std::unique_ptr<LimitStage> limit;
    const std::unique_ptr<ViscosityStage> viscosity;
    const std::unique_ptr<PressureStage> pressure;
    const std::unique_ptr<ForceStage> forces;
    const std::unique_ptr<StateStage> state;
    const std::unique_ptr<FlowStage> flows;
    const std::unique_ptr<DiffusionStage> diffusion;
    const std::unique_ptr<PairEnergyStage> pair_energies;

   public:
    // stages that fixes call directly.  A boundary or an open zone is registered until its fix is
    // deleted; the fluid may be another one by then.

    const std::unique_ptr<OpenStage> open;
    const std::unique_ptr<BoundaryStage> boundary;
    const std::unique_ptr<ShiftStage> shift;
    const std::unique_ptr<NoiseStage> noise;
    const std::unique_ptr<ViscousStage> viscous;
    const std::unique_ptr<TemperatureStage> temperature;    // of viscous as well

    // From the pair style: its commands; init() at the start of every run; derive_anew() after another
    // command has changed coefficients

    void settings(int narg, char **arg);
    void coeff(int narg, char **arg);
    void init();
    virtual void request_list();    // after init()
    void derive_anew() { stale = true; }
    virtual void adopt();                               // before each compute()
    Exchange &messages() const { return *exchange; }    // whose packing the pair style hands on
    virtual double memory_usage() const;                // bytes

    // Forces: add them to those of LAMMPS, with a tally of each pair or nullptr; return the number of
    // particles on this processor that are beyond the bound of the limit

    virtual bigint compute(PairTally *);

    // From the integrator: a run begins, with the states as a step of dt has left them, and with what has changed since the
    // last one; such a step begins

    virtual void begin_run(double dt, bool continues, const Changes &);
    // with density continuity: owned particles keep their densities where sums change that are not due to motion, of
    // particles that come, go, split, or merge
    void keep_densities();

    // with the diffusion of volume: steps from one evaluation of its rates to the next one; the last forces have evaluated
    // them
    int diffusion_interval() const;
    bool diffusion_is_new() const;
    void begin_step(double dt);
    // in the middle of a step, see ShiftStage::run()
    virtual void shift_particles(double keep);

    // Potential energy of the last forces, on this processor, added to those of the particles (nullptr: to none)

    double energy(double *each_atom) const;

    // energy of the equation of state alone, on this processor: of the last forces, or where particles,
    // with their ghosts, are now

    enum Moment { LAST_FORCES, NOW };
    virtual double elastic_energy(Moment);

    // energy of pairs of unlike types, of the last forces, on this processor, of the particles of a group, half of each
    // pair; whether any two types have one

    bool has_pair_energy() const;
    double pair_energy(int groupbit) const;

    // energy that states hold on this processor, of particles of these groups

    double state_energy(int groupbits) const;

    // Temperatures of owned particles, with their densities and energies as they are now; 0 of those that have no heat
    // capacity, and of walls.  Give a temperature to those of a group and of its open zones, where particles, with their
    // ghosts, are now, by function(particle); errors, in the name of the user, if it is negative or there is no heat
    // capacity.

    void temperatures(double *) const;
    void set_temperature(int groupbit, const std::function<double(int)> &, const std::string &user);

    // of the last forces: see ForceStage::heating(); forces and torques on owned particles, without
    // what other styles add

    bool
    has_forces() const;    // on all processors, for the particles that are there now; asked by all
    virtual void heating(double *heat, double *power) const;
    static int number_of_heats();                        // by channel
    virtual double received_heat(int groupbit) const;    // by conduction, per time, on this rank
    const ForceSum *own_forces() const;
    const double *own_torque(int i) const;

    // Start of a run, from the integrator.  Masses of the particles of a group, times a factor of each
    // type, for which their mean density is rho0; volumes, from the positions alone; then the table of
    // viscosities, coefficients, and time steps if the coefficients are new, checks, and warnings, with
    // the particles and their properties as they enter the first step

    void set_mean_density(int groupbit);
    void find_volumes();
    void announce();

    // before the first forces of a run that may continue the last one: one of the integrators begins anew; on any rank,
    // what the fluid touches moves otherwise

    void begin_anew() { continued = false; }
    void note_change() { changed = true; }

    bool is_set_up() const;    // what the commands say is in effect

    // particles and types

    int not_fluid() const;            // bits of the groups of all boundaries and open zones
    bool is_boundary(int i) const;    // owned or ghost particle
    bool has_type(int type) const;    // its particles are of this fluid
    // of the owned particles as they are now: speed of sound of particle i if it had this density
    std::function<double(int i, double rho)> sound() const;
    int dimension() const { return dim; }    // of the kernel
    Threads &team() const;                   // that share its work
    double support_radius() const { return support; }

    // of the fluid as it is now: largest stable time steps; time in which a particle falls by the length
    // that stability knows, at least

    CoeffTable coeff_table();
    double fall_time() const;
    void check_time_step(const CoeffTable &);    // warning about one that is too large

   protected:
    int dim = 0;              // dimension of the kernel
    double support = 0.0;     // support radius rc
    bool stale = false;       // what follows from the coefficients is to be derived anew
    bool own_list = false;    // the neighbor list is not built by LAMMPS, but when it is needed

    // run a task on the particles and the half neighbor list of the host; it may set densities and masses

    virtual void on_host(const std::function<void()> &task) { task(); }

    // the same for a report, which needs the pairs of the last forces

    virtual void for_report(const std::function<void()> &task) { task(); }

    NeighList *neighbors();    // half, of the particles as they are now

    // what compute() consists of, on the host; another one may do each of them elsewhere.  set_pressure()
    // returns the number of owned particles that are beyond the bound of the limit

    virtual void sum_density();
    virtual void set_step(double dt);    // of the states
    virtual void advance_states();
    virtual void sum_bound();
    virtual void set_reference_volume();    // of boundary particles
    virtual bigint set_pressure();
    virtual void set_boundary();
    virtual void sum_forces(PairTally *, const StepPlan &);
    virtual void sum_flows();             // of conduction
    virtual void evaluate_diffusion();    // of volume
    virtual void add_diffusion_heat();
    virtual double wall_energy(double *each_atom) const;    // as energy()

    virtual bool has_own_forces() const;    // on this processor
    void report();
    double missing_time() const;
    bool
    at_rest() const;    // strains are zero: in a minimization; in a rerun, which does not know them
    double **extrapolated_spin() const;    // nullptr without spins
    int integrated = 0;                    // bits of the groups of its integrators
    // what is checked at the next neighbor list, of the particles
    bool checks_speed() const;
    bool checks_expansion() const;

   private:
    bool set_up = false;       // since pair_style and pair_coeff
    bool announced = false;    // the table of coefficients is up to date
    bool continued =
        false;               // the run continues the last one, with the velocities of its last step
    bool touched = false;    // by a command, which may have given the same coefficients
    bool follows =
        false;    // the first forces of the run change densities as their sums have changed
    std::vector<double> densities_before;    // such forces, of owned particles
    bool changed =
        false;    // other coefficients, or motions of walls, than those of the last forces
    double warned_step = 0.0;      // the time step that the last warning was about
    double noise_step = 0.0;       // the time step that was announced with the noise
    bool checks_places = false;    // at the first forces of a run
    bigint shared_places = 0;      // pairs of particles in the same place that a warning was about
    int fast_lists = 0;    // neighbor lists in a row with fast particles; -1: there was a warning
    bool expanded = false;      // there was a warning
    double look_after = 0.0;    // time to the next look at the motion of a fluid from rest, or 0
    double moving = 0.0;        // time since the last one

    void check_setup();
    void check_places();
    void remember_densities();
    void check_speed();
    void check_expansion();
    void check_elasticity(FluidState &);
    void find_own_types();
    void check_all_interact();
    bool step_follows() const;    // a fix sets the time step by the limits
    void derive_coeffs();
    bigint sum_before_forces(StepPlan &, bool find_rates = true);
    void find_viscosities(bool find_rates);
    const double *bound() const;    // of the limit, nullptr without
    void sum_diffusion();
    void find_viscous_velocity(StepPlan &);
    void find_temperature();
    double stability_length() const;
    double smallest_inertia() const;
    double lightest_fluid() const;
    std::string skin_text(const CoeffTable &) const;
    std::function<double(int i)> pressures() const;    // of owned particles, with that of states
    void announce_noise(double rate);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
