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

  enum class Viscous { EXPLICIT, RKL2, IMPLICIT };
  enum class Scheme { TRAPEZOIDAL, SDIRK2, EULER };

  // of SDIRK2, 1 - 1/sqrt(2): stiffly accurate and L-stable, R. Alexander, SIAM J. Numer. Anal. 14, 1006
  // (1977)

  constexpr double SDIRK2_GAMMA = 0.29289321881345247560;

  struct ViscousSettings {
    Viscous mode = Viscous::EXPLICIT;
    Scheme scheme = Scheme::TRAPEZOIDAL;
    int stages = 0;    // 0: as many as the rates need
    double tolerance = 1.0e-6;
    int iterations = 1000;    // at most
    bool must_converge = false;

    bool trapezoidal() const { return mode == Viscous::IMPLICIT && scheme == Scheme::TRAPEZOIDAL; }

    // The force is the mean one of a decay over the whole time step.  In a longer step it
    // overshoots, and adds kinetic energy above twice the step.  The force of the trapezoidal step
    // is that of one moment, and the next step removes the excess.

    bool force_is_a_mean() const { return mode != Viscous::EXPLICIT && !trapezoidal(); }

    bool operator==(const ViscousSettings &b) const
    {
      return mode == b.mode && scheme == b.scheme && stages == b.stages &&
          tolerance == b.tolerance && iterations == b.iterations &&
          must_converge == b.must_converge;
    }
    bool operator!=(const ViscousSettings &b) const { return !(*this == b); }

    // First guess of the velocity in the forces: this many increments of half a step after the one
    // in the middle of the step.  The time whose velocity acts in the friction of the scheme is the
    // best guess where the velocity is smooth; the stages of RKL2 begin in the middle, and noise is
    // not smooth.

    double extrapolation(bool noise) const
    {
      if (noise || mode == Viscous::RKL2) return 0.0;
      if (mode == Viscous::EXPLICIT || scheme == Scheme::TRAPEZOIDAL) return 1.0;
      return (scheme == Scheme::SDIRK2) ? 2.0 * SDIRK2_GAMMA : 2.0;
    }
  };

  class BoundaryStage;
  class PressureStage;

  // A step of M dy/dt = F(y), F(y) = F(0) - Gamma y, that is stable for all rates, at fixed
  // positions: for velocities, or for temperatures.  In the step from the middle of one to the
  // middle of the next, y- to y+, what an integrator makes of it is y+ = y- + dt M^-1 F(y_b).  This
  // finds y_b, which the forces use:
  //   rkl2:         y_b = a combination of y- and of those of the stages, see RKL2
  //   trapezoidal:  y_b = (y- + y+)/2
  //   euler:        y_b = y+
  //   sdirk2:       y_b = (1 - gamma) Y1 + gamma Y2 of its two stages
  // In the first half step of a run, y- is that of the time of the positions: y_b is the same to second
  // order in the time step, without the fast motions that would not be stable, see start().

  class StiffStage : public Stage {
   public:
    // where = for messages, after the number of the step
    StiffStage(class LAMMPS *lmp, Engine &engine, Exchange &exchange, const std::string &where) :
        Stage(lmp, engine, exchange), where(where)
    {
    }

    // of all integrators of the fluid, and bits of their groups; style = of the fluid, for messages

    void configure(const ViscousSettings &, int groups, const std::string &style);
    bool active() const { return settings.mode != Viscous::EXPLICIT; }
    const ViscousSettings &choice() const { return settings; }

    // of the fastest mode, on lattices; other coefficients have others

    void set_rate(double rate_in) { known_rate = rate_in; }
    void forget_rates() { outdated = true; }
    bool has_old_rates() const { return outdated; }

    void begin_run();    // run() calls it if it is there for the first forces

    // set forces, torques and heat of LAMMPS aside, with forces and torques zero afterwards; bring them back
    void set_aside();
    void restore();

    // of the last step: iterations, or stages; residual; seconds; and applications of Gamma in this run

    enum { ITERATIONS, RESIDUAL, SECONDS, APPLICATIONS, NSTATISTICS };
    double statistics[NSTATISTICS] = {};

    double memory_usage() const override;

    // The system of equations, see Krylov

    Unknowns mass, inverse_mass, x, residual;
    void apply(const Unknowns &in, Unknowns &out);
    void sum(double *values, int n) const;
    virtual double scale_sq() const = 0;
    Threads &team() const;

   protected:
    ViscousSettings settings;
    std::string style;
    int groups = 0;
    bool symmetric = true;       // Gamma is
    int prescribed = 0;          // bits of the groups of particles that are not unknown
    int width = 1;               // unknowns per particle
    std::vector<int> unknown;    // owned particles
    int rows_of_bodies = 0;      // unknowns behind those of the particles
    Unknowns before;             // y-
    Unknowns guess, force;       // y_b, F(y_b) of the beginning; the solution is y_b = guess + x

    bool is_unknown(int i) const;
    // function(i, row) for each unknown particle i, whose unknowns are row ... row + width - 1; shared among the threads
    template <class Function> void for_unknown(const Function &function)
    {
      team().for_each(static_cast<int>(unknown.size()), [&](int k) {
        function(unknown[k], width * static_cast<std::size_t>(k));
      });
    }
    void resize();    // of all unknowns
    std::size_t first_of_bodies() const { return width * unknown.size(); }
    void solve_step();

    virtual void friction(const Unknowns &in, Unknowns &out) = 0;    // out = Gamma in
    virtual void start();

    void implicit_step(double interval);
    void step(double interval);

   private:
    const std::string where;
    double known_rate = 0.0,
           rate = 0.0;       // of the fastest mode: on lattices; of these particles, at least
    bool outdated = true;    // are the two
    bool warned = false;     // of iterations that were not enough, in this run
    double h = 0.0;          // of M + h Gamma
    std::vector<double> forces_before, torques_before, heat_before;

    std::string moment() const;
    void solve();
    void check_finite(bool finite) const;
    void sdirk2_step(double interval);
    void rkl2_step(double interval);
    double estimated_rate();
  };

  // Large viscosities.  Unknown are the velocities, with spins, of the particles of the fluid that the integrators
  // move, and those of bodies that the fluid moves.  This stage sets v_b as the velocity that the forces see (vest,
  // omegaest), on owned and ghost atoms.
  // One application of Gamma is pass 1 for cdot and pass 2 without the equation of state.
  //
  // F contains the forces of other styles.  They come after those of the pair style, so F has those
  // of the step before.  In the first half step of a run they are not known.

  class ViscousStage : public StiffStage {
   public:
    ViscousStage(class LAMMPS *lmp, Engine &engine, Exchange &exchange,
                 const PressureStage &pressure, BoundaryStage &boundary) :
        StiffStage(lmp, engine, exchange, ""),
        pressure(pressure), boundary(boundary), rigid(lmp, engine, exchange, boundary)
    {
    }

    // From the integrator at the beginning of a step, of a particle that it has moved: vest, or omegaest,
    // travels with it as v + dt/m times the forces of other styles, until begin() makes it the
    // guess again, extrapolated if the particle is still where it was.  keep: 0 if v is added later

    void begin_carrying();    // before these, which threads may call for different particles
    void carry_force(int i, double keep);
    void carry_torque(int i, const double *inertia, double **omegaest);

    // One step: begin() sets the forces aside; then the passes, with the guess of v_b that vest is; then
    // run(), after which the forces are those of begin() again, and the passes follow with v_b.
    // Particles with a bit of prescribed are not unknown; omega, omegaest and inertia: nullptr
    // without spin

    void begin(int prescribed, double **omegaest, const double *inertia);
    void run(NeighList *, const double *bound, bool symmetric);

    double memory_usage() const override
    {
      return StiffStage::memory_usage() + rigid.memory_usage() +
          bytes(others, ahead, ahead_spin, rest);
    }

    // the velocity, relative to the mean one, of the fluid before the step and in the solution
    double scale_sq() const override;

   private:
    const PressureStage &pressure;
    BoundaryStage &boundary;
    RigidStage rigid;

    // of this step

    NeighList *list = nullptr;
    const double *bound = nullptr;
    double **omegaest = nullptr;
    Unknowns others;        // forces of other styles
    double mean[3] = {};    // velocity

    // increments on v-, spin-, of the integrator's guess, by particles as they were then

    std::vector<double> ahead, ahead_spin;

    // what a boundary particle brings in where the fluid is at rest

    struct Rest {
      int i;
      double u[3], g, zeta_term, w[3];
    };
    std::vector<Rest> rest;

    void find_unknowns(const double *inertia);
    void set_guess();
    void gather();
    void set_velocities(const Unknowns &);
    void set_bulk_term();
    void find_rest();
    void friction(const Unknowns &in, Unknowns &out) override;
    void add_velocities(const Unknowns &increment);
  };

  // The same of heat, C dT/dt = R - Lambda T with the heat capacities C and the flow of heat of each pair.
  // Unknown are the temperatures of the particles that conduct and whose energy the integrators advance.  This stage sets
  // T_b as the temperature that conduction and the pressure see, by the internal energy of owned atoms as
  // they are during the forces, and by desph_before, so that the energy at the end of the step is that of the
  // flows at T_b.  R is the heat of all else: of the last pass 2 that has seen the velocities of the step.

  class TemperatureStage : public StiffStage {
   public:
    TemperatureStage(class LAMMPS *lmp, Engine &engine, Exchange &exchange,
                     BoundaryStage &boundary) :
        StiffStage(lmp, engine, exchange, " in the conduction of heat"),
        boundary(boundary)
    {
    }

    // after pass 2; prescribed as ViscousStage::begin()
    void run(int prescribed);

    double memory_usage() const override
    {
      return StiffStage::memory_usage() + bytes(flow, temperature);
    }

    // temperature, relative to the mean one, before the step and in the solution
    double scale_sq() const override;

   private:
    BoundaryStage &boundary;
    std::vector<double> flow;           // heat per time that owned and ghost atoms get
    std::vector<double> temperature;    // of owned atoms, of their energies before run()
    double mean = 0.0;                  // temperature before the step

    void find_unknowns();
    void gather();
    void set_temperatures();     // of owned and ghost atoms, those of the guess
    void send_temperatures();    // of owned atoms to ghosts
    void friction(const Unknowns &in, Unknowns &out) override;
    void start() override;
    bool takes_end() const
    {
      return settings.mode == Viscous::IMPLICIT && settings.scheme == Scheme::EULER;
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
