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

    // The force is the mean one of a decay over the whole time step.  In a longer one it overshoots,
    // with more kinetic energy above twice the step; that of the trapezoidal step is the force of
    // one moment, and what overshoots the next step takes back.

    bool force_is_a_mean() const { return mode != Viscous::EXPLICIT && !trapezoidal(); }

    bool operator==(const ViscousSettings &b) const
    {
      return mode == b.mode && scheme == b.scheme && stages == b.stages &&
          tolerance == b.tolerance && iterations == b.iterations &&
          must_converge == b.must_converge;
    }
    bool operator!=(const ViscousSettings &b) const { return !(*this == b); }

    // Velocity that the forces are to see first: this many increments of half a step after the one
    // in the middle of the step.  The time whose velocity acts in the friction of the scheme is
    // the best guess where the velocity is smooth; the stages of RKL2 begin in the middle, and noise
    // is not smooth.

    double extrapolation(bool noise) const
    {
      if (noise || mode == Viscous::RKL2) return 0.0;
      if (mode == Viscous::EXPLICIT || scheme == Scheme::TRAPEZOIDAL) return 1.0;
      return (scheme == Scheme::SDIRK2) ? 2.0 * SDIRK2_GAMMA : 2.0;
    }
  };

  class BoundaryStage;
  class PressureStage;

  // Large viscosities.  In the step from the middle of one to the middle of the next, v- to v+ with the
  // positions of the time between, the velocities obey M dv/dt = F(v) with F(v) = F(0) - Gamma v.  What
  // an integrator makes of it is v+ = v- + dt M^-1 F(v_b): this stage finds v_b and sets it as
  // the velocity that the forces see (vest, omegaest), on owned and ghost atoms.
  //   rkl2:         v_b = a combination of v- and of the velocities of the stages, see RKL2
  //   trapezoidal:  v_b = (v- + v+)/2
  //   euler:        v_b = v+
  //   sdirk2:       v_b = (1 - gamma) Y1 + gamma Y2 of its two stages
  // Unknown are the velocities, with spins, of the particles of the fluid that the integrators move.
  // One application of Gamma is pass 1 for cdot and pass 2 without the equation of state.
  //
  // F contains the forces of other styles, which come after those of the pair style: as they were in the
  // step before.  In the first half step of a run they are not known, and v- is the velocity at the
  // time of the positions: v_b is that velocity to second order in the time step, without the fast motions
  // that would not be stable, see start().

  class ViscousStage : public Stage {
   public:
    ViscousStage(class LAMMPS *, Engine &, Exchange &, const PressureStage &, BoundaryStage &);

    // of all integrators of the fluid, and bits of their groups; style = of the fluid, for messages

    void configure(const ViscousSettings &, int groups, const std::string &style);
    bool active() const { return settings.mode != Viscous::EXPLICIT; }
    const ViscousSettings &choice() const { return settings; }

    // of the fastest mode, on lattices; other coefficients have others

    void set_rate(double rate_in) { known_rate = rate_in; }
    void forget_rates() { outdated = true; }
    bool has_old_rates() const { return outdated; }

    // From the integrator at the beginning of a step, of a particle that it has moved: vest, or omegaest,
    // travels with it as v + dt/m times the forces of other styles, until begin() makes it the
    // guess again, extrapolated if the particle is still where it was.  keep: 0 if v is added later

    void carry_force(int i, double keep);
    void carry_torque(int i, const double *inertia, double **omegaest);

    void begin_run();    // run() calls it if it is there for the first forces

    // One step: begin() sets the forces aside; then the passes, with the guess of v_b that vest is; then
    // run(), after which the forces are those of begin() again, and the passes follow with v_b.
    // Particles with a bit of prescribed are not unknown; omega, omegaest and inertia: nullptr
    // without spin

    void begin(int prescribed, double **omegaest, const double *inertia);
    void run(NeighList *, const double *bound, bool symmetric);

    // of the last step: iterations, or stages; residual; seconds; and applications of Gamma in this run

    enum { ITERATIONS, RESIDUAL, SECONDS, APPLICATIONS, NSTATISTICS };
    double statistics[NSTATISTICS];

    double memory_usage() const override;

    // The system of equations, see Krylov.  The scale is the velocity, relative to the mean one, of the
    // fluid before the step and in the solution.

    Unknowns mass, inverse_mass, x, residual;
    void apply(const Unknowns &in, Unknowns &out);
    void sum(double *values, int n) const;
    double scale_sq() const;

   private:
    const PressureStage &pressure;
    BoundaryStage &boundary;
    ViscousSettings settings;
    std::string style;
    int groups;
    double known_rate, rate;    // of the fastest mode: on lattices; of these particles, at least
    bool outdated;              // are the two
    bool warned;                // of iterations that were not enough, in this run

    // of this step

    NeighList *list;
    const double *bound;
    double **omegaest;
    bool symmetric;
    int prescribed;
    int width;                   // unknowns per particle: velocity, and spin
    double h;                    // of M + h Gamma
    std::vector<int> unknown;    // owned particles
    Unknowns before;             // v-
    Unknowns guess, force;       // v_b, F(v_b) of the beginning
    Unknowns others;             // forces of other styles
    double mean[3];              // velocity

    // increments on v-, spin-, of the integrator's guess, by particles as they were then

    std::vector<double> ahead, ahead_spin;

    // forces, torques and heat of begin()

    std::vector<double> forces_before, torques_before, heat_before;

    // what a boundary particle brings in where the fluid is at rest

    struct Rest {
      int i;
      double u[3], g, zeta_term, w[3];
    };
    std::vector<Rest> rest;

    bool is_unknown(int i) const;
    void find_unknowns(const double *inertia);
    void set_guess();
    void gather();
    void restore();
    void set_velocities(const Unknowns &);
    void set_bulk_term();
    void find_rest();
    void friction(const Unknowns &in, Unknowns &out);
    void solve();
    void check_finite(bool finite) const;
    void implicit_step(double interval);
    void sdirk2_step(double interval);
    void rkl2_step(double interval);
    void step(double interval);
    void start();
    double estimated_rate();
    void add_velocities(const Unknowns &increment);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
