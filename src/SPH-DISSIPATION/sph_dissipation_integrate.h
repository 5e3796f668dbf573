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

#ifndef LMP_SPH_DISSIPATION_INTEGRATE_H
#define LMP_SPH_DISSIPATION_INTEGRATE_H

// Velocity Verlet of package SPH-DISSIPATION, for one particle.  No LAMMPS include.

#include "sph_dissipation_rows.h"
#include "sph_dissipation_states.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  struct TimeStep {
    double dtv, dtf;         // time step; half of it times ftm2v
    double keep;             // 1; 0 if add_remapped_velocity() adds v to vest later
    double extrapolation;    // time of vest, in half steps after the middle of the step
    bool shifted;            // a shift in this step: the forces of particles jump
    bool balanced;           // temp energy: internal energies get half of the rate at each end

    // begin(), end(): begin or end the step of particle i.  kick(): add half a kick alone.  follow(): set vest and omegaest
    // as without forces.  Particles: arrays, on host or device, functions of i and direction; some are empty without spins.

    template <class Particles> SPH_FUNCTION void begin(const Particles &p, int i) const
    {
      const double dtfm = dtf / p.rmass(i);
      begin_energy(p.desph(i), p.esph(i), p.desph_before(i));
      for (int d = 0; d < 3; d++) {
        const double dv = dtfm * p.f(i, d);
        p.v(i, d) += dv;
        p.vest(i, d) = keep * p.v(i, d) + extrapolation * dv;
        p.x(i, d) += dtv * p.v(i, d);
      }
      if (!p.has_spins) return;
      const double dti = dtf * inverse_inertia(p.rmass(i), p.inertia(i));
      for (int d = 0; d < 3; d++) {
        const double domega = dti * p.torque(i, d);
        p.omega(i, d) += domega;
        p.omegaest(i, d) = p.omega(i, d) + extrapolation * domega;
      }
    }

    template <class Particles> SPH_FUNCTION void end(const Particles &p, int i) const
    {
      end_energy(p.desph(i), p.desph_before(i), p.esph(i));
      if (shifted) {
        const double heat = heat_of_jump(p, i);
        p.esph(i) -= heat;
        p.desph_before(i) -= heat;
      }
      kick(p, i);
    }

    // Return the kinetic and internal energy, dt^2/(4m) (df)^2, that a particle gains if the force changes by df in a step:
    // of second order in smooth motion, of first order where the force jumps.  vest has the force before the jump

    template <class Particles> SPH_FUNCTION double heat_of_jump(const Particles &p, int i) const
    {
      double sum = 0.0;
      for (int d = 0; d < 3; d++) {
        const double jump = dtf / p.rmass(i) * p.f(i, d) - (p.vest(i, d) - p.v(i, d));
        sum += jump * jump;
      }
      return 0.5 * dtv / dtf * p.rmass(i) * sum;
    }

    template <class Particles> SPH_FUNCTION void kick(const Particles &p, int i) const
    {
      const double dtfm = dtf / p.rmass(i);
      for (int d = 0; d < 3; d++) p.v(i, d) += dtfm * p.f(i, d);
      if (!p.has_spins) return;
      const double dti = dtf * inverse_inertia(p.rmass(i), p.inertia(i));
      for (int d = 0; d < 3; d++) p.omega(i, d) += dti * p.torque(i, d);
    }

    template <class Particles> SPH_FUNCTION void follow(const Particles &p, int i) const
    {
      for (int d = 0; d < 3; d++) p.vest(i, d) = keep * p.v(i, d);
      if (!p.has_spins) return;
      for (int d = 0; d < 3; d++) p.omegaest(i, d) = p.omega(i, d);
    }

    // Return 1/(mass * inertia); 0 without inertia: such a particle keeps its spin, and must have no torque

    SPH_FUNCTION static double inverse_inertia(double mass, double inertia)
    {
      return (inertia > 0.0) ? 1.0 / (mass * inertia) : 0.0;
    }

    // Extrapolate the internal energy to the end of the step, so that the pressure of an ideal gas is accurate to second
    // order in the time step; end_energy() corrects the energy with the new rate.  balanced: the energy gets half of the rate
    // at each end of the step, since random forces cannot be extrapolated.  end_energy() sets rate_before to the added
    // energy, for a run that continues.

    SPH_FUNCTION void begin_energy(double rate, double &energy, double &rate_before) const
    {
      rate_before = balanced ? 0.0 : rate;
      energy += (balanced ? 0.5 : 1.0) * dtv * rate;
    }
    SPH_FUNCTION void end_energy(double rate, double &rate_before, double &energy) const
    {
      rate_before = 0.5 * dtv * (rate - rate_before);
      energy += rate_before;
    }
  };

  // Forces and torques of the pair style alone on owned particles, on the host or on a device: for steps in which motion and
  // heat exchange energy exactly.  At the beginning of a step with large viscosities, vest and omegaest keep v + dt/m times
  // the forces of other styles, for ViscousStage.

  struct OwnForces {
    VectorField force, torque;
    double *
        ahead =
           nullptr,    // increment of vest, and of omegaest, at the beginning of a step; nullptr: nothing is kept
        *ahead_spin = nullptr;
    const int *mask = nullptr;
    int groups = 0,
        prescribed = 0;    // bits of groups of integrators, and of particles with known velocities

    template <class Particles>
    SPH_FUNCTION void step(const TimeStep &now, const Particles &p, int i, bool begins,
                           bool of_fluid) const
    {
      const double mass_inv = 1.0 / p.rmass(i);
      double rest[2] = {0.0, 0.0};
      rest[0] = rest_of_heat(now, i, p.v, p.vest, p.f, force, mass_inv);
      if (p.has_spins)
        rest[1] = rest_of_heat(now, i, p.omega, p.omegaest, p.torque, torque,
                               TimeStep::inverse_inertia(p.rmass(i), p.inertia(i)));
      if (begins)
        now.begin(p, i);
      else
        now.end(p, i);
      for (const double heat : rest) {
        p.esph(i) += heat;
        if (!begins) p.desph_before(i) += heat;
      }
      if (begins && of_fluid) keep(now, p, i);
    }

    // Keep the forces of other styles on a particle of the fluid, unless its velocity is known

    template <class Particles>
    SPH_FUNCTION void keep(const TimeStep &now, const Particles &p, int i) const
    {
      if (!ahead || !(mask[i] & groups) || (mask[i] & prescribed)) return;
      keep_one(now.dtv / p.rmass(i), i, p.f, force, p.v, now.keep, p.vest, ahead);
      if (p.has_spins)
        keep_one(now.dtv * TimeStep::inverse_inertia(p.rmass(i), p.inertia(i)), i, p.torque, torque,
                 p.omega, 1.0, p.omegaest, ahead_spin);
    }

   private:
    // Return, before half a kick, the heat that conserves the sum of kinetic and internal energy exactly.  own: forces of the
    // pair style, whose heat is -own.acting, with the velocity acting of the friction.  The kick dv does the work
    // own.(v + dv/2).  The result is dtv/2 own.(acting - v - dv/2), an energy; for torques likewise, with spins.

    template <class Velocity, class Acting, class Force>
    static SPH_FUNCTION double rest_of_heat(const TimeStep &now, int i, const Velocity &v,
                                            const Acting &acting, const Force &f,
                                            const VectorField &own, double mass_inv)
    {
      double power = 0.0;
      for (int d = 0; d < 3; d++)
        power += own.at(i, d) * (acting(i, d) - v(i, d) - 0.5 * now.dtf * mass_inv * f(i, d));
      return 0.5 * now.dtv * power;
    }

    // Set increment to acting - part * v; then set acting to part * v + scale * (f - own): f - own = force of other styles

    template <class Velocity, class Acting, class Force>
    static SPH_FUNCTION void keep_one(double scale, int i, const Force &f, const VectorField &own,
                                      const Velocity &v, double part, const Acting &acting,
                                      double *increment)
    {
      for (int d = 0; d < 3; d++) {
        increment[3 * i + d] = acting(i, d) - part * v(i, d);
        acting(i, d) = part * v(i, d) + scale * (f(i, d) - own.at(i, d));
      }
    }
  };

  // Diffusion of volume, at constant strains.  A step changes volumes by dt times the last rate.  If the last forces have
  // evaluated new rates, the next step begins with interval/2 times the change of the rate: so, between steps, densities are
  // the densities in the forces.

  struct VolumeStep {
    double dt, interval;    // time step; time between two evaluations of the rates
    bool is_new;            // the last forces have evaluated the rates

    // Arrays of owned particles, on host or device

    double *rho = nullptr;
    const double *rmass = nullptr, *rate = nullptr;
    double *rate_before = nullptr;
    int nstrains = 0;
    double *strain[MOST_STATES] = {};    // densities at rest

    SPH_FUNCTION void begin(int i) const
    {
      double change = dt * rate[i];
      if (is_new) {
        change += 0.5 * interval * (rate[i] - rate_before[i]);
        rate_before[i] = rate[i];
      }
      const double factor = 1.0 - change * rho[i] / rmass[i];
      rho[i] *= factor;
      for (int k = 0; k < nstrains; k++) strain[k][i] *= factor;
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
