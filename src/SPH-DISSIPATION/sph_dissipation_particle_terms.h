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

#ifndef LMP_SPH_DISSIPATION_PARTICLE_TERMS_H
#define LMP_SPH_DISSIPATION_PARTICLE_TERMS_H

// Between the passes: what follows for one particle from its density; its relaxing strain and its heat.  No LAMMPS
// include.

#include "sph_dissipation_parameters.h"
#include "sph_dissipation_rows.h"

#include <cmath>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // P/c^2 of pass 2, of the pressure P with the bulk term (bulk density) or without (otherwise), the
  // volume V = w/c, and the reference volume w

  SPH_FUNCTION double pressure_term(double total, double vol, double weight)
  {
    const double c_inv = vol / weight;
    return total * c_inv * c_inv;
  }

  // ln(a/b) and e^x where a/b and e^x are mostly near 1: then by their series to rounding errors, without a call

  SPH_FUNCTION double log_of_ratio(double a, double b)
  {
    const double q = (a - b) / (a + b), s = q * q;
    if (!(s < 1.0e-4)) return std::log(a / b);
    return 2.0 * q * (1.0 + s * (1.0 / 3.0 + s * (1.0 / 5.0 + s * (1.0 / 7.0 + s * (1.0 / 9.0)))));
  }

  SPH_FUNCTION double exp_of(double x)
  {
    if (!(std::fabs(x) < 0.01)) return std::exp(x);
    const double far = 1.0 / 24.0 + x * (1.0 / 120.0 + x * (1.0 / 720.0));
    return 1.0 + x * (1.0 + x * (1.0 / 2.0 + x * (1.0 / 6.0 + x * far)));
  }

  // The relaxing processes and the heat of owned particles, on the host or on a device, with their densities and
  // internal energies, and the rates of these; energies are those of the last forces.  The state of a process is the
  // relaxed density of a strain, that of the vibrations their temperature T_v.  See RelaxChannel and Eos.

  struct StrainRows {
    const TypeParameters *types;    // by type, from 1
    const int *type;
    const double *rmass, *rho, *drho;
    Eos eos;
    const double *esph, *desph;
    double *relaxed[MOST_PROCESSES];    // of which there is room for so many
    double *tvib;
    int room;
    const double *by_walls =
        nullptr;    // energy that the walls hold of each particle; nullptr: none

    // strain x at a density, of the relaxed density rest; of process k

    SPH_FUNCTION static double strain_at(double density, double rest)
    {
      return (rest > 0.0 && density > 0.0) ? log_of_ratio(density, rest) : 0.0;
    }
    SPH_FUNCTION double strain(int i, int k) const { return strain_at(rho[i], relaxed[k][i]); }

    // the state of process k for which the next forces find the strain x

    SPH_FUNCTION static double state_of(double x) { return -std::exp(-x); }

    // of the vibrations: whether there are any, temperature, energy

    SPH_FUNCTION bool vibrates(int i) const
    {
      const TypeParameters &par = types[type[i]];
      return par.nprocess > par.nstrain;
    }
    SPH_FUNCTION double &vibration(int i) const { return tvib[i]; }
    SPH_FUNCTION double vibrational_energy(int i) const
    {
      if (!vibrates(i)) return 0.0;
      return rmass[i] * types[type[i]].vibration.heat_capacity * vibration(i);
    }

    // Set the state of a new particle: its vibrations are in equilibrium with the rest of its heat; or they have the
    // temperature that the rest gets.

    SPH_FUNCTION void begin(int i) const
    {
      begin_strains(i);
      if (!vibrates(i)) return;
      if (vibration(i) < 0.0) keep(i);
      if (vibration(i) > 0.0) return;
      const TypeParameters &par = types[type[i]];
      vibration(i) = 0.0;
      const double heat = thermal_energy(i);
      if (heat > 0.0)
        vibration(i) = heat / (rmass[i] * (par.heat_capacity + par.vibration.heat_capacity));
    }
    SPH_FUNCTION void begin(int i, double temperature) const
    {
      begin_strains(i);
      if (!vibrates(i)) return;
      if (vibration(i) < 0.0) keep(i);
      if (!(vibration(i) > 0.0)) vibration(i) = temperature;
    }
    SPH_FUNCTION void begin_strains(int i) const
    {
      for (int k = 0; k < types[type[i]].nstrain; k++) {
        double &rest = relaxed[k][i];
        if (!(rest > 0.0)) rest = (rest < 0.0) ? -rest * rho[i] : rho[i];
      }
    }

    // pressure rho g phi x of all strains

    SPH_FUNCTION double pressure(int i) const
    {
      const TypeParameters &par = types[type[i]];
      double sum = 0.0;
      for (int k = 0; k < par.nstrain; k++) sum += par.process[k].stiffness * strain(i, k);
      return rho[i] * sum;
    }

    // the strains have relaxed

    SPH_FUNCTION void relax(int i) const
    {
      for (int k = 0; k < types[type[i]].nstrain; k++) relaxed[k][i] = rho[i];
    }

    // A particle keeps the states that its type has, and takes the temperature of its vibrations from where a data file
    // has it: the last relaxed density, or the first one that its type does not have.  Returns whether it had others

    SPH_FUNCTION bool keep(int i) const
    {
      const int nstrain = types[type[i]].nstrain;
      const bool from_file = tvib[i] < 0.0;
      if (from_file) {
        tvib[i] = 0.0;
        if (vibrates(i)) {
          const double last = relaxed[room - 1][i];
          tvib[i] = (last > 0.0) ? last : relaxed[nstrain][i];
          if (tvib[i] < 0.0) tvib[i] = 0.0;
        }
      }
      bool others = false;
      for (int k = nstrain; k < room; k++) {
        others = others || (relaxed[k][i] != 0.0 && !(from_file && vibrates(i)));
        relaxed[k][i] = 0.0;
      }
      if (!vibrates(i)) {
        others = others || tvib[i] > 0.0;
        tvib[i] = 0.0;
      }
      return others;
    }

    // particles that are not fluid have no state

    SPH_FUNCTION void forget(int i) const
    {
      for (int k = 0; k < room; k++) relaxed[k][i] = 0.0;
      tvib[i] = 0.0;
    }

    // one time step later: ln rho_r grows by (1 - e^-a) x, and by change[k * each] for process k, nullptr: by nothing
    // else; T_v by that of T - T_v and of the rate of T

    SPH_FUNCTION void advance(int i, const double *change, int each) const
    {
      const TypeParameters &par = types[type[i]];
      const double rate = vibrates(i) ? temperature_rate(i) : 0.0;
      for (int k = 0; k < par.nstrain; k++)
        relaxed[k][i] *=
            exp_of(par.process[k].part * strain(i, k) + (change ? change[k * each] : 0.0));
      if (vibrates(i))
        vibration(i) +=
            par.vibration.part * (temperature(i) - vibration(i)) + par.vibration.delay * rate;
    }

    // rate of the temperature at constant states: of what the rate of the internal energy leaves besides the energy
    // of the equation of state without heat, and of the strains

    SPH_FUNCTION double temperature_rate(int i) const
    {
      const TypeParameters &par = types[type[i]];
      const double p = elastic_pressure(eos, par.eos, rho[i]) + pressure(i);
      return (desph[i] / rmass[i] - p * drho[i] / (rho[i] * rho[i])) / par.heat_capacity;
    }

    // m g phi x^2/2 of all strains

    SPH_FUNCTION double energy(int i) const
    {
      const TypeParameters &par = types[type[i]];
      double sum = 0.0;
      for (int k = 0; k < par.nstrain; k++) {
        const double x = strain(i, k);
        sum += par.process[k].stiffness * x * x;
      }
      return 0.5 * rmass[i] * sum;
    }

    // energy per time that becomes heat, V p^2/kappa_r of all strains; of the vibrations T times the rate of entropy,
    // m cvib/tau_v (T - T_v)^2/T_v

    SPH_FUNCTION double heat(int i) const
    {
      const TypeParameters &par = types[type[i]];
      double sum = 0.0;
      for (int k = 0; k < par.nstrain; k++) {
        const double p = par.process[k].stiffness * strain(i, k);
        sum += p * p * par.process[k].fluidity;
      }
      if (vibrates(i) && vibration(i) > 0.0) {
        const double difference = temperature(i) - vibration(i);
        sum += par.vibration.heat_capacity * par.vibration.rate * difference * difference /
            vibration(i);
      }
      return rmass[i] * sum;
    }

    // what the internal energy has beyond that of the equation of state without heat, of the strains, of the
    // vibrations, and of walls

    SPH_FUNCTION double thermal_energy(int i) const
    {
      return esph[i] - held(i) - rmass[i] * elastic_energy(eos, types[type[i]].eos, rho[i]);
    }
    SPH_FUNCTION double held(int i) const
    {
      const double own = energy(i) + vibrational_energy(i);
      return by_walls ? own + by_walls[i] : own;
    }

    // temperature, 0 without heat capacity; the internal energy at a temperature

    SPH_FUNCTION double temperature(int i) const
    {
      const double cv = types[type[i]].heat_capacity;
      return (cv > 0.0) ? thermal_energy(i) / (rmass[i] * cv) : 0.0;
    }
    SPH_FUNCTION double energy_at(int i, double temperature) const
    {
      const TypeParameters &par = types[type[i]];
      return rmass[i] * (elastic_energy(eos, par.eos, rho[i]) + par.heat_capacity * temperature) +
          held(i);
    }
  };

  // Owned and ghost particles, on the host or on a device: rows of the loops, and arrays of LAMMPS.  A
  // function is about particle i; the stages of the host and those of the device call it for each of them.
  // bound = of LimitStage, nullptr without; not_fluid = bits of the groups of boundary particles

  struct ParticleRows {
    Constants par;
    const TypeParameters *types;    // by type, from 1
    int nlocal;

    Particle *particle;
    DensitySum *density;     // of pass 1
    double *zeta_term;       // zeta cdot/c
    const double *weight;    // reference volume w of particle i: weight[i * each]
    int each;                // 0: it is 1 for all, 1

    const int *type, *mask;
    const double *rmass;
    double *esph;
    double *rho, *drho, *vfrac;
    double *desph;    // zero when the step begins

    StrainRows strains;
    double *strain_pressure;      // of relaxing processes; read if there are any
    Conductor *conductor;         // if any type conducts heat
    double *rho_sum = nullptr;    // see Fields; with density continuity

    // w of the form volume mass

    SPH_FUNCTION double reference_volume(int i) const { return rmass[i] / types[type[i]].eos.rho0; }

    // volume V = w/c, mass density rho = m/V and its rate; particles of other styles keep their density.
    // P1 (5), (6)

    SPH_FUNCTION void set_density(int i) const
    {
      const double w = weight[i * each];
      const double vol = w / density[i].c;
      particle[i].vol = vol;
      if (par.shared && types[type[i]].other) return;
      const double mass = rmass[i] / w;
      rho[i] = mass * density[i].c;
      drho[i] = mass * density[i].cdot;
      vfrac[i] = vol;
    }

    // Density continuity: c of an owned particle, a sum, becomes rho/m.  Since the last forces, rho has changed as the
    // sum has; at the first ones it is what it was, or rho0.  Particles of walls and open zones have a sum alone.

    SPH_FUNCTION void add_offset(int i, int not_fluid) const
    {
      constexpr double LEAST =
          0.1;    // of rho0, for spray, where the sum has lost nearly all neighbors
      double &sum = rho_sum[i];
      const double before = sum, mass = rmass[i] / weight[i * each];
      sum = 0.0;
      if (!is_fluid(i, not_fluid)) return;
      sum = mass * density[i].c;
      const double rho0 = types[type[i]].eos.rho0;
      double now = rho[i];
      if (before > 0.0)
        now += sum - before;
      else if (!(now > 0.0))
        now = rho0;
      if (now < LEAST * rho0) now = LEAST * rho0;
      rho[i] = now;
      density[i].c = now / mass;
    }

    // density and pressure P, see pressure_term(), where they do not follow from pass 1; volume and P/c^2
    // of them

    SPH_FUNCTION void set_state(int i, double density_of, double total) const
    {
      const double vol = rmass[i] / density_of;
      particle[i].vol = vol;
      particle[i].g = pressure_term(total, vol, weight[i * each]);
      rho[i] = density_of;
      vfrac[i] = vol;
    }

    // boundary particles have no density of their own, for most of their neighbors are not there, but the
    // reference density of their type

    SPH_FUNCTION void set_reference_volume(int i, int not_fluid) const
    {
      if (!(mask[i] & not_fluid)) return;
      set_state(i, types[type[i]].eos.rho0, 0.0);
      drho[i] = zeta_term[i] = 0.0;
    }

    SPH_FUNCTION bool is_fluid(int i, int not_fluid) const
    {
      return !types[type[i]].other && !(mask[i] & not_fluid);
    }

    SPH_FUNCTION bool is_beyond(int i, const double *bound) const
    {
      return bound && beyond_bound(types[type[i]].zeta, bound[i]);
    }

    // coefficient of the bulk term in effect

    SPH_FUNCTION double zeta(int i, const double *bound) const
    {
      if (par.limit == Limit::YES && is_beyond(i, bound)) return zeta_at_bound(bound[i]);
      return types[type[i]].zeta;
    }

    // Pressure of the relaxing processes of an owned particle, of its density; at_rest: they have relaxed.
    // not_fluid = bits of the groups of particles of walls and open zones

    SPH_FUNCTION void set_strain_pressure(int i, int not_fluid, bool at_rest) const
    {
      strain_pressure[i] = 0.0;
      if (!is_fluid(i, not_fluid)) return;
      if (at_rest) strains.relax(i);
      strains.begin(i);
      strain_pressure[i] = strains.pressure(i);
      if (!par.thermal_pressure) return;    // heat is what strains and vibrations do not have
      const double held = strains.energy(i) + strains.vibrational_energy(i);
      strain_pressure[i] -= thermal_pressure(types[type[i]].eos, rho[i], held / rmass[i]);
    }

    // The internal energy of an owned particle, which lacks the work of its pressure over this time, gets it.  The
    // pressure is that of the result.

    SPH_FUNCTION void complete_energy(int i, double time, int not_fluid) const
    {
      if (!is_fluid(i, not_fluid)) return;
      const EosParams &eos = types[type[i]].eos;
      const double shrinks = time * particle[i].vol * density[i].cdot / density[i].c;
      const double by_mass = 1.0 / rmass[i];
      double p = pressure(par.eos, eos, rho[i], esph[i] * by_mass);
      if (par.nprocess) p += strain_pressure[i];
      esph[i] += shrinks * p / (1.0 - shrinks * thermal_pressure(eos, rho[i], by_mass));
    }

    // What the conduction of heat reads: the temperature of an owned particle; of owned and ghost particles, with
    // their volumes, all else.  Particles that are not fluid conduct nothing, unless a boundary says so later.

    SPH_FUNCTION void set_temperature(int i) const
    {
      conductor[i].temperature = strains.temperature(i);
    }
    SPH_FUNCTION void set_conductor(int i, int not_fluid) const
    {
      const bool conducts = is_fluid(i, not_fluid);
      conductor[i].vol = conducts ? particle[i].vol : 0.0;
      conductor[i].conductivity = conducts ? types[type[i]].conductivity : 0.0;
      conductor[i].flux = 0.0;
    }

    // pressure without bulk term, of density and energy

    SPH_FUNCTION double total_pressure(int i) const
    {
      const double p = pressure(par.eos, types[type[i]].eos, rho[i], esph[i] / rmass[i]);
      return par.nprocess ? p + strain_pressure[i] : p;
    }

    // work per time of that pressure on the particle: what heat adds to it, and all else, which becomes elastic energy
    // or strain

    struct Work {
      double thermal, elastic;
    };
    SPH_FUNCTION Work work(int i) const
    {
      const double rate = particle[i].vol * density[i].cdot / density[i].c;
      const double thermal =
          thermal_pressure(types[type[i]].eos, rho[i], strains.thermal_energy(i) / rmass[i]);
      return {thermal * rate, (total_pressure(i) - thermal) * rate};
    }

    // pressure and bulk term, of volume and density: what pass 2 multiplies with F r_ij, and the work of
    // the pressure; zero for particles that are not fluid.  P1 (12), (18)

    SPH_FUNCTION void set_pressure(int i, const double *bound, int not_fluid) const
    {
      if (!is_fluid(i, not_fluid)) {
        zeta_term[i] = particle[i].g = 0.0;
        return;
      }
      const double vol = particle[i].vol, w = weight[i * each];
      const double rate = density[i].cdot * (vol / w);
      const double p = total_pressure(i);
      const double bulk_term = zeta(i, bound) * rate;
      zeta_term[i] = bulk_term;
      particle[i].g = pressure_term((par.bulk == Bulk::DENSITY) ? p + bulk_term : p, vol, w);
      if (i < nlocal) desph[i] += p * vol * rate;
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
