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

#include <cstdint>
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
  template <class Space> class ShiftStage;
  template <class Space> class DensityStage;
  template <class Space> class DiffusionStage;
  class Engine;
  class Exchange;
  class FluidModel;
  class FluidReport;
  struct ForceSum;
  class ContactStage;
  class ForceStage;
  template <class Space> class FlowStage;
  class HostSpace;
  template <class Space> class LimitStage;
  class NeighborSearch;
  class NoiseStage;
  class OpenStage;
  class PairEnergyStage;
  class PairTally;
  class Stability;
  struct StepData;
  template <class Space> class PressureStage;
  template <class Space> class StateStage;
  class ForcesAside;
  struct OwnForces;
  class RigidStage;
  class StiffScheme;
  class TemperatureStage;
  class Threads;
  template <class Space> class ViscosityStage;
  template <class Space> class ViscousStage;

  // Particle fluid with independent shear and bulk viscosity.  Forces: pressure of an equation of state, viscous forces
  // between pairs, and a bulk force from the rate of change of the particle volume.  This class owns the settings, the pair
  // loops, and the stages around the loops, and runs the stages in their order.  The pair style is the interface of LAMMPS
  // to this class; fixes and computes call find_fluid().

  class Fluid : protected Pointers {
   public:
    // pair = the pair style, whose neighbor list and communication the fluid uses; spins: particles rotate
    Fluid(class LAMMPS *, Pair *, bool spins);
    ~Fluid() override;

    Pair *const pair;
    const bool spins;
    const std::string style;    // name of pair, atom, and integrator style, without suffix

    const std::unique_ptr<FluidModel> model;    // settings and coefficients

   protected:
    const std::unique_ptr<Engine> engine;
    const std::unique_ptr<Exchange> exchange;
    const std::unique_ptr<NeighborSearch> search;
    const std::unique_ptr<HostSpace> host;
    const std::unique_ptr<DensityStage<HostSpace>> density;
    const std::unique_ptr<LimitStage<HostSpace>> limit;
    const std::unique_ptr<ViscosityStage<HostSpace>> viscosity;
    const std::unique_ptr<PressureStage<HostSpace>> pressure;
    const std::unique_ptr<ForceStage> forces;
    const std::unique_ptr<StateStage<HostSpace>> state;
    const std::unique_ptr<FlowStage<HostSpace>> flows;
    const std::unique_ptr<DiffusionStage<HostSpace>> diffusion;
    const std::unique_ptr<PairEnergyStage> pair_energies;
    const std::unique_ptr<ForcesAside> aside;

   public:
    // Stages that fixes call directly.  A boundary or an open zone stays registered until its fix is deleted, even if
    // another fluid has replaced this one.

    const std::unique_ptr<OpenStage> open;
    const std::unique_ptr<BoundaryStage> boundary;
    const std::unique_ptr<ContactStage> contact;
    const std::unique_ptr<ShiftStage<HostSpace>> shift;
    const std::unique_ptr<NoiseStage> noise;
    const std::unique_ptr<StiffScheme> viscous, temperature;    // of velocities, of conduction

    const std::unique_ptr<Stability> stability;    // largest stable time steps
    const std::unique_ptr<FluidReport> log;        // lines and warnings of the log

    // Called by the pair style.  settings(), coeff(): for its commands; init(): at the start of every run; derive_anew():
    // after another command has changed coefficients, so that the next adopt() derives the parameters

    void settings(int narg, char **arg);
    void coeff(int narg, char **arg);
    void init();
    virtual void request_list();    // after init()
    void derive_anew() { stale = true; }
    virtual void adopt();                               // before each compute()
    Exchange &messages() const { return *exchange; }    // packs the messages of the pair style
    virtual double memory_usage() const;                // bytes

    // Add the forces to the arrays of LAMMPS, with a tally of each pair or nullptr; return the number of owned particles
    // beyond the bound of the limit

    virtual bigint compute(PairTally *);
    void finish();    // after a run: with timer full, print the times of the stages

    // Called by the integrator when a run begins; dt = time step of the states; Changes since the last run

    virtual void begin_run(double dt, bool continues, const Changes &);
    // With density continuity: keep the densities of owned particles at the next forces.  The sums of these forces change
    // not by motion, but by particles that come, go, split, or merge
    void keep_densities();

    // Return the interval of the diffusion of volume, in steps; return true if the last forces have evaluated the diffusion
    int diffusion_interval() const;
    bool diffusion_is_new() const;
    void begin_step(double dt);    // advances the states
    // In the middle of each step: shift the particles every few steps, see ShiftStage::run()
    void shift_in_step(double keep);
    bool has_shifted() const { return shifted; }    // in this step
    virtual void shift_particles(double keep);

    // Return the potential energy of the last forces on this rank; add it to the energies of particles (nullptr: to none)

    double energy(double *each_atom) const;

    // Return the energy of the equation of state alone, on this processor: at the last forces, or at the present places of
    // the particles and their ghosts

    enum Moment { LAST_FORCES, NOW };
    virtual double elastic_energy(Moment);

    // Return whether pairs of any two unlike types have an energy; return this energy at the last forces, on this processor,
    // for the particles of a group, half of each pair

    bool has_pair_energy() const;
    double pair_energy(int groupbit) const;

    // Return the energy of the states of particles of these groups, on this processor

    double state_energy(int groupbits) const;

    // temperatures(): get the temperatures of owned particles from the present densities and energies; particles without
    // heat capacity and walls have 0.  set_temperature(): set the energies and the first states of the particles of a group
    // and of its open zones, at the present places, for the temperatures function(particle).  Stop if a temperature is
    // negative or a type has no heat capacity, with a message that names the user.

    void temperatures(double *) const;
    void set_temperature(int groupbit, const std::function<double(int)> &, const std::string &user);

    // Values of the last forces: heating, see ForceStage::heating(); forces and torques of this style on owned particles.
    // has_forces(): return true if the last forces are of the present particles; all processors must call

    bool has_forces() const;
    virtual void heating(double *heat, double *power) const;
    static int number_of_heats();                        // numbers in power, one per channel
    virtual double received_heat(int groupbit) const;    // by conduction, per time, on this rank
    const ForceSum *own_forces() const;
    virtual OwnForces forces_for_steps();    // on the device if computes_on_device()
    virtual bool computes_on_device() const { return false; }

    // Called by the integrator at the start of a run.  set_mean_density(): multiply the masses of a group by a factor for
    // each type, so that the mean density is rho0.  Then: find the volumes from the positions alone; check the particles as
    // they enter the first step, and warn; log the table of viscosities and time steps if the coefficients are new

    void set_mean_density(int groupbit);
    void find_volumes();
    void announce();

    // Before the first forces of a run that may continue the last one: note that an integrator begins anew; or, on any rank,
    // that the motion of walls or open ends has changed

    void begin_anew() { continued = false; }
    void note_change() { changed = true; }

    // Since the last pair_style and pair_coeff: is_set_up(): init() has run; is_ready(): the setup of a run or minimization
    // has computed forces as well, unless pair_modify compute is no; was_minimized(): the last setup was that of a
    // minimization

    bool is_set_up() const;
    bool is_ready() const;
    bool was_minimized() const { return last_setup == 2; }

    // For a fix that acts in few steps: with KOKKOS, copy these fields of the particles to the host; note that the host has
    // changed the particles

    virtual void get_from_device(uint64_t /*fields*/) const {}
    virtual void give_to_device() const {}

    // particles and types

    int not_fluid() const;            // bits of the groups of all boundaries and open zones
    bool is_boundary(int i) const;    // owned or ghost particle
    bool has_type(int type) const;    // its particles are of this fluid
    // Return the function with the pressure of owned particle i, with its states
    std::function<double(int i)> pressures() const;
    int dimension() const { return dim; }    // of the kernel
    Threads &team() const;                   // threads that share the work of the loops
    double support_radius() const { return support; }

   protected:
    // Large viscosities and stiff conduction on the host

    const std::unique_ptr<RigidStage> rigid;
    const std::unique_ptr<ViscousStage<HostSpace>> velocities;
    const std::unique_ptr<TemperatureStage> stiff_heat;

    int dim = 0;              // dimension of the kernel
    double support = 0.0;     // support radius rc
    bool stale = false;       // adopt() must derive the parameters from the coefficients
    bool own_list = false;    // NeighborSearch builds the neighbor list, not LAMMPS
    int last_setup = 0;       // since the last pair_coeff: 0 none, 1 of a run, 2 of a minimization

    // Run a task on the particles and the half neighbor list of the host; the task may set densities and masses

    virtual void on_host(const std::function<void()> &task) { task(); }

    // Run a report, which needs the pairs of the last forces on the host

    virtual void for_report(const std::function<void()> &task) { task(); }

    NeighList *neighbors();    // half list of the particles at their present places

    // Stages of the forces of a step, in their order; FluidKokkos replaces functions by those of a device

    struct ListedStage {
      const char *name;
      int needs;     // data of earlier stages
      bool trial;    // for the solution of an implicit step
      std::function<void(StepData &)> run;
    };
    std::vector<ListedStage> stages;    // of the next forces; empty: to be listed
    virtual void list_stages();

    virtual void set_step(double dt);    // for the numbers of the states
    virtual void advance_states();
    bool diffusion_is_due();                                // once in each step
    virtual void fence() const {}                           // wait for the device
    virtual double wall_energy(double *each_atom) const;    // see energy(), pair_energy()
    virtual double tension_energy(double *each_atom, int groupbit) const;

    virtual bool has_own_forces() const;    // on this processor
    void report();
    double missing_time() const;
    bool
    at_rest() const;    // strains are zero: in a minimization, and in a rerun, which has no strains
    double **extrapolated_spin() const;    // nullptr without spins
    void find_rate();                      // of the fastest mode of the friction on lattices
    bool has_symmetric_matrix() const;
    int integrated = 0;    // bits of the groups of its integrators

   private:
    bool shifted = false;    // by shift_in_step(), in this step
    bool set_up = false;     // init() has run since the last pair_style or pair_coeff
    bool continued =
        false;    // the run continues the last one, with the velocities of its last step
    bool follows =
        false;    // commands have moved particles: the first forces change densities as their sums have changed
    std::vector<double> densities_before;    // densities of owned particles before such forces
    bool changed =
        false;    // coefficients, or motions of walls, differ from those of the last forces
    bool checks_places = false;    // the next forces, the first of a run, check_places()
    bigint shared_places = 0;      // pairs of particles in the same place at the last check

    // Kinds of forces.  FIRST: the first forces of a run that does not continue the last run.  CHANGED, REPEATED: the first
    // forces of a run that does, after a change of coefficients or walls, and without.  LATER: all other forces of a run

    enum class Forces { FIRST, CHANGED, REPEATED, LATER };
    Forces kind() const;

    struct StageTime {
      const char *name;
      double seconds;
      bigint calls;
    };
    std::vector<StageTime> times;    // on this processor since the last finish()

    void begin_forces();
    void check_setup();
    void check_places();
    void remember_densities();
    void find_own_types();
    bool step_follows() const;    // a fix sets the time step by the limits
    void derive_coeffs();
    void find_viscosities();
    const double *bound() const;    // of LimitStage, by particle; nullptr without limit
    void sum_density();
    void find_velocity();
    void find_temperature();
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
