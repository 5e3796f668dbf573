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

#include "sph_dissipation_states.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  struct TimeStep {
    double dtv, dtf;
    double keep;             // 1; or 0: vest gets the increment alone
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

  // Diffusion of volume, at constant strains.  As internal energies, volumes get the old rate in a step, and half of the
  // change of the rate when the next step begins: so, between steps, densities are the densities in the forces.

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
