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

#ifndef LMP_SPH_DISSIPATION_VISCOUS_H
#define LMP_SPH_DISSIPATION_VISCOUS_H

#include "sph_dissipation_rigid.h"
#include "sph_dissipation_solvers.h"
#include "sph_dissipation_stages.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  struct OwnForces;

  enum class Viscous { EXPLICIT, RKL2, IMPLICIT };
  enum class Scheme { TRAPEZOIDAL, SDIRK2, EULER };

  // gamma of SDIRK2, 1 - 1/sqrt(2): stiffly accurate and L-stable, R. Alexander, SIAM J. Numer. Anal. 14, 1006 (1977)

  constexpr double SDIRK2_GAMMA = 0.29289321881345247560;

  struct ViscousSettings {
    Viscous mode = Viscous::EXPLICIT;
    Scheme scheme = Scheme::TRAPEZOIDAL;
    int stages = 0;    // of rkl2; 0: as many as the rates need
    double tolerance = 1.0e-6;
    int iterations = 1000;    // at most
    bool must_converge = false;

    bool trapezoidal() const { return mode == Viscous::IMPLICIT && scheme == Scheme::TRAPEZOIDAL; }

    // Return true if the force is the mean of a decay over the whole time step.  Such a force overshoots in a longer step,
    // and adds kinetic energy in a step of more than twice the length.  The force of the trapezoidal step belongs to one
    // time: there, the next step removes the overshoot.

    bool force_is_a_mean() const { return mode != Viscous::EXPLICIT && !trapezoidal(); }

    bool operator==(const ViscousSettings &b) const
    {
      return mode == b.mode && scheme == b.scheme && stages == b.stages &&
          tolerance == b.tolerance && iterations == b.iterations &&
          must_converge == b.must_converge;
    }
    bool operator!=(const ViscousSettings &b) const { return !(*this == b); }

    // Return the time for the first guess of the velocity in the forces, in half steps after the middle of the step.  For a
    // smooth velocity, the best time is the time of the velocity in the friction of the scheme.  The stages of RKL2 begin in
    // the middle.  With noise, the velocity is not smooth.

    double extrapolation(bool noise) const
    {
      if (noise || mode == Viscous::RKL2) return 0.0;
      if (mode == Viscous::EXPLICIT || scheme == Scheme::TRAPEZOIDAL) return 1.0;
      return (scheme == Scheme::SDIRK2) ? 2.0 * SDIRK2_GAMMA : 2.0;
    }
  };

  // Numbers and messages of a StiffStage, on the host or on a device: the choice of the integrators, the rate of the fastest
  // mode, and the number of stages.  where = text after the number of the time step, in messages

  class StiffScheme : protected Pointers {
   public:
    StiffScheme(class LAMMPS *lmp, const std::string &where) : Pointers(lmp), where(where) {}

    // Take the settings, the same for all integrators of the fluid, and the bits of the integrators' groups; style = style of
    // the fluid, for messages

    void configure(const ViscousSettings &, int groups, const std::string &style);
    bool active() const { return settings.mode != Viscous::EXPLICIT; }
    const ViscousSettings &choice() const { return settings; }
    int groups() const { return group_bits; }

    // set_rate(): set the rate of the fastest mode on lattices.  forget_rates(): coefficients, and so rates, have changed

    void set_rate(double rate_in) { known_rate = rate_in; }
    void forget_rates() { outdated = true; }
    bool has_old_rates() const { return outdated; }

    void begin_run();    // before the first forces

    // Called by the stage: begin(), end() of a step; of rkl2, whether the rate is to be estimated, the estimate, and the
    // number of stages for this interval; the result of an iteration, with warnings and errors

    void begin();
    void end() { outdated = false; }
    bool estimates() const;
    void set_estimate(double);
    int stages_for(double interval);
    void note(const Solution &);

    // Numbers of the last step: iterations, or stages; residual; seconds; and applications of Gamma in this run

    enum { ITERATIONS, RESIDUAL, SECONDS, APPLICATIONS, NSTATISTICS };
    double statistics[NSTATISTICS] = {};

   private:
    const std::string where;
    ViscousSettings settings;
    std::string style;
    int group_bits = 0;
    double known_rate = 0.0,
           rate = 0.0;       // of the fastest mode: on lattices; estimated for present particles
    bool outdated = true;    // both rates are outdated
    bool warned = false;     // true: this run has warned of too few iterations

    std::string moment() const;
    void check_finite(bool finite) const;
  };

  // Solves M dy/dt = F(y), F(y) = F(0) - Gamma y, for velocities or temperatures y at fixed positions, stable for all rates.
  // From the middle of one step, y-, to the middle of the next one, y+, the integrator makes y+ = y- + dt M^-1 F(y_b).
  // This class finds y_b, which the forces use:
  //   rkl2:         y_b = a combination of y- and of the stages, see RKL2
  //   trapezoidal:  y_b = (y- + y+)/2
  //   euler:        y_b = y+
  //   sdirk2:       y_b = (1 - gamma) Y1 + gamma Y2 of its two stages
  // In the first half step of a run, y- belongs to the time of the positions.  Then y_b is y- to second order in the time
  // step, without the fast modes, which would be unstable, see start().
  //
  // Each owned particle has `width` unknowns, which have no mass and stay zero if the value of the particle is known; then
  // follow the unknowns of bodies.  The functions are in sph_dissipation_shared_viscous.h.

  template <class Space> class StiffStage : public SharedStage<Space> {
   public:
    typedef typename Space::template Array<double> Values;

    StiffStage(class LAMMPS *lmp, Space &space, StiffScheme &scheme) :
        SharedStage<Space>(lmp, space), scheme(scheme)
    {
    }

    virtual double memory_usage() const;

    // The system of equations, see Krylov

    Values mass, inverse_mass, x, residual;
    double *room(int k);
    void apply(const double *in, double *out);
    template <class Function> void for_each(const Function &function) const
    {
      this->space.for_each("sph:stiff", count(), function);
    }
    template <class Function> double total(const Function &add) const
    {
      return this->space.template sum<double>("sph:stiff", count(), add);
    }
    void sum(double *values, int n) const;
    virtual double scale_sq() const = 0;

    // public, because CUDA requires this of functions with lambdas

    virtual void start();
    void solve();
    void implicit_step(double interval);
    void sdirk2_step(double interval);
    void rkl2_step(double interval);
    double estimated_rate();

   protected:
    StiffScheme &scheme;
    bool symmetric = true;     // Gamma is symmetric
    int prescribed = 0;        // bits of the groups whose particles have known values
    int width = 1;             // unknowns per particle
    int rows_of_bodies = 0;    // unknowns of bodies
    Values before;             // y-
    Values guess, force;       // first y_b and its F(y_b); the solution is y_b = guess + x

    int first_of_bodies() const { return width * this->atom->nlocal; }
    int count() const { return first_of_bodies() + rows_of_bodies; }    // all unknowns
    void resize();                                                      // all arrays of unknowns
    void solve_step();

    virtual void friction(const double *in, double *out) = 0;    // out = Gamma in
    // Return the values that drive the flows at these increments over y-, for rkl2: with melt the temperatures
    virtual const double *driving(const double *increments) { return increments; }

   private:
    static constexpr int NROOMS = 9;
    Values rooms[NROOMS];    // intermediate results
    double h = 0.0;          // time in the matrix M + h Gamma

    void step(double interval);
  };

  // Values of a boundary particle if all increments of the fluid are 0

  struct BoundaryRest {
    double u[3], g, zeta_term, w[3];
  };

  // Large viscosities.  The unknowns are the velocities and spins of the fluid particles that the integrators move, and the
  // velocities of bodies that the fluid moves; a device has no bodies.  This stage sets the velocity in the forces (vest,
  // omegaest) to v_b, on owned and ghost atoms.  One application of Gamma is pass 1 for cdot and pass 2 without the equation
  // of state.
  //
  // F contains the forces of other styles.  LAMMPS computes these forces after the pair style: so F contains the forces of
  // the step before, and 0 in the first half step of a run.

  template <class Space> class ViscousStage : public StiffStage<Space> {
   public:
    ViscousStage(class LAMMPS *lmp, Space &space, StiffScheme &scheme,
                 const PressureStage<Space> &pressure, typename Space::Boundaries &walls,
                 RigidStage &rigid) :
        StiffStage<Space>(lmp, space, scheme),
        pressure(pressure), walls(walls), rigid(rigid)
    {
    }

    // For the integrators, at the beginning and at the end of a step; the values that OwnForces keeps in vest and omegaest
    // migrate with the particles until begin()

    OwnForces own_forces();

    // One step: begin() sets vest to the guess of v_b; the passes run; run() finds v_b; the passes run with v_b.  Particles
    // in groups with a bit of prescribed have known velocities

    void begin(int prescribed);
    void run(NeighList *, const double *bound, bool symmetric);

    double memory_usage() const override
    {
      return StiffStage<Space>::memory_usage() +
          Space::bytes_of(others, ahead, ahead_spin, change, rest);
    }

    // Return the scale of the residual, from the velocities before the step and in the solution, relative to their mean
    double scale_sq() const override;

    // public, because CUDA requires this of functions with lambdas

    void find_unknowns();
    void set_guess();
    void gather();
    void set_velocities(const double *);
    void find_rest();
    void friction(const double *in, double *out) override;
    void add_velocities(const double *increment);

   private:
    typedef typename StiffStage<Space>::Values Values;
    const PressureStage<Space> &pressure;
    typename Space::Boundaries &walls;
    RigidStage &rigid;

    // of this step

    NeighList *list = nullptr;
    const double *bound = nullptr;
    Values others;          // forces of other styles
    double mean[3] = {};    // mean velocity

    // guess of the integrator less v-, and of spin less spin-, in the order of the particles at the beginning of the step

    Values ahead, ahead_spin;
    Values change;    // of vest, or omegaest, of owned and ghost atoms

    typename Space::template Array<BoundaryRest> rest;    // by owned and ghost atom

    bool turns() const { return this->width > 3; }
    void set_bulk_term();
  };

  // Forces and heat of LAMMPS while the passes of a trial use its arrays, on the host

  class ForcesAside : public Stage {
   public:
    using Stage::Stage;
    void set();        // stores forces, torques, and heat; sets forces and torques to zero
    void restore();    // sets all three back
    double memory_usage() const override { return bytes(forces, torques, heat); }

   private:
    std::vector<double> forces, torques, heat;
  };

  // Stiff conduction of heat, C dT/dt = R - Lambda T, with the heat capacities C and the flows of heat of the pairs.  The
  // unknowns are the temperatures of the particles that conduct and whose energy the integrators advance.  During the
  // forces, this stage sets the internal energy of owned atoms, so that conduction and pressure have T_b.  The stage also sets
  // desph_before, so that the energy at the end of the step contains the flows at T_b.  R is all other heat, from the last
  // pass 2 with the velocities of the step.  With melt, the unknown of rkl2 is the heat over cv; the temperatures, which
  // follow from this heat, drive the flows.

  class TemperatureStage : public StiffStage<HostSpace> {
   public:
    TemperatureStage(class LAMMPS *lmp, HostSpace &space, StiffScheme &scheme,
                     BoundaryStage &boundary) :
        StiffStage(lmp, space, scheme),
        boundary(boundary), engine(space.engine), exchange(space.exchange)
    {
    }

    // After pass 2: solve for T_b; prescribed: see ViscousStage::begin()
    void run(int prescribed);

    double memory_usage() const override
    {
      return StiffStage::memory_usage() + bytes(flow, temperature, driven);
    }

    // Return the scale of the residual, from the temperatures before the step and in the solution, relative to their mean
    double scale_sq() const override;

   private:
    BoundaryStage &boundary;
    Engine &engine;
    Exchange &exchange;
    std::vector<double> flow;           // heat per time that owned and ghost atoms get
    std::vector<double> temperature;    // of owned atoms, from their energies before run()
    std::vector<double> driven;         // result of driving()
    bool melts = false;                 // any type melts, in this step
    double mean = 0.0;                  // mean temperature before the step

    // Call function(i) for each particle with unknown temperature
    template <class Function> void for_unknown(const Function &);
    void find_unknowns();
    void gather();
    void set_temperatures();     // of owned and ghost atoms, to the guess or the known value
    void send_temperatures();    // of owned atoms to ghosts
    void friction(const double *in, double *out) override;
    const double *driving(const double *increments) override;
    // scaled_heat(): return the heat of an owned particle over m cv at T; unscaled(): return T at this scaled heat
    double scaled_heat(int i, double T) const;
    double unscaled(int i, double heat) const;
    void start() override;
    bool takes_end() const
    {
      const ViscousSettings &settings = scheme.choice();
      return settings.mode == Viscous::IMPLICIT && settings.scheme == Scheme::EULER;
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
