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

// Terms of single particles between the passes: values that follow from the density, states, and heat.  No LAMMPS include.

#include "sph_dissipation_diffusion_terms.h"
#include "sph_dissipation_parameters.h"
#include "sph_dissipation_rows.h"

#include <cmath>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Return P/c^2 for pass 2, from the pressure P with the bulk term (bulk density) or without the term (otherwise), the
  // volume V = w/c, and the reference volume w

  SPH_FUNCTION double pressure_term(double total, double vol, double weight)
  {
    const double c_inv = vol / weight;
    return total * c_inv * c_inv;
  }

  // States and heat of owned particles, on the host or on a device, from densities, internal energies of the last forces, and
  // the rates of densities and energies.  See StateList and Eos.

  struct StateRows {
    const TypeParameters *types;    // by type, from 1
    const int *type;
    const double *rmass, *rho, *drho;
    Eos eos;
    const double *esph, *desph;
    double *state[States::MOST];    // nullptr without room
    const double *by_walls =
        nullptr;    // energy of each particle in the forces of walls; nullptr: none
    const double *rate[Flows::NUMBER] = {};    // by each flow in the last forces; nullptr: none
    const double *shear_rate = nullptr;        // in the last forces

    // Return the state of a channel with a single state; return the rate of this state by the flow of the channel
    template <class Channel> SPH_FUNCTION double state_of(int i) const
    {
      return state[States::first<Channel>()][i];
    }
    template <class Channel> SPH_FUNCTION double rate_of(int i) const
    {
      const double *const own = rate[Flows::place<Channel>()];
      return own ? own[i] : 0.0;
    }

    SPH_FUNCTION const States::Numbers &numbers(int i) const { return types[type[i]].states; }

    // Set the states of a new particle at this temperature; negative: the particle already has its energy.  at_rest: set the
    // strains of any particle to zero

    SPH_FUNCTION void begin(int i, double temperature = -1.0, bool at_rest = false) const
    {
      States::each(*this, i, [&](auto channel, const auto &site) {
        if constexpr (decltype(channel)::KIND == StateKind::STRAIN) {
          double &rest = site.state();
          if (at_rest || !(rest > 0.0)) rest = (rest < 0.0 && !at_rest) ? -rest * rho[i] : rho[i];
        } else
          channel.begin(site, temperature);
      });
    }

    // Set the states to 0, for particles that are not fluid

    SPH_FUNCTION void forget(int i) const
    {
      for (double *one : state)
        if (one) one[i] = 0.0;
    }

    // Set strains to zero; other states stay
    SPH_FUNCTION void relax(int i) const
    {
      States::each(*this, i, [&](auto channel, const auto &site) {
        if (channel.KIND == StateKind::STRAIN) site.state() = 0.0;
      });
    }

    // Advance the states by a time step; noise[k * each] = noise of the state at place k < end

    SPH_FUNCTION void advance(int i, const double *noise, std::size_t each, int end) const
    {
      const double rate = numbers(i).read_rate() ? temperature_rate(i) : 0.0;
      States::each(*this, i, [&](auto channel, const auto &site) {
        channel.advance(site, rate, (site.slot < end) ? noise[site.slot * each] : 0.0);
      });
    }

    // pressure(), viscosity(), energy(): return the sum over the states of pressure, addition to mu, and energy or elastic
    // energy.  add_heat(): add the heat of the states per time to the heat of each channel

    SPH_FUNCTION double pressure(int i) const
    {
      double sum = 0.0;
      States::each(*this, i, [&](auto channel, const auto &site) {
        sum += channel.pressure(site);
      });
      return rho[i] * sum;
    }
    SPH_FUNCTION double viscosity(int i) const
    {
      double sum = 0.0;
      States::each(*this, i, [&](auto channel, const auto &site) {
        sum += channel.viscosity(site);
      });
      return sum;
    }
    SPH_FUNCTION double energy(int i, bool elastic = false) const
    {
      double sum = 0.0;
      States::each(*this, i, [&](auto channel, const auto &site) {
        if (!elastic || channel.KIND == StateKind::STRAIN) sum += channel.energy(site);
      });
      return sum;
    }
    SPH_FUNCTION void add_heat(int i, double *heat) const
    {
      States::each(*this, i, [&](auto channel, const auto &site) {
        typedef States::Owner<decltype(channel)> Owner;
        if constexpr (Owner::OF_MOTION)
          heat[Channels::place<Owner>()] += rmass[i] * channel.heat(site);
      });
    }

    // Return the rate of the temperature at constant states and heat capacity: rate of the internal energy, less the work of
    // elastic pressure and states, over the heat capacity

    SPH_FUNCTION double temperature_rate(int i) const
    {
      const TypeParameters &par = types[type[i]];
      const double p = elastic_pressure(eos, par.eos, rho[i]) + pressure(i);
      return (desph[i] / rmass[i] - p * drho[i] / (rho[i] * rho[i])) / par.heat_capacity;
    }

    // Return the heat: internal energy less elastic energy of the equation of state, less held().  held(): return the energy
    // of the states and of the forces of walls

    SPH_FUNCTION double thermal_energy(int i) const
    {
      return esph[i] - held(i) - rmass[i] * elastic_energy(eos, types[type[i]].eos, rho[i]);
    }
    SPH_FUNCTION double held(int i) const { return by_walls ? energy(i) + by_walls[i] : energy(i); }

    // temperature(): return the temperature, 0 without heat capacity.  energy_at(): return the energy at a temperature

    SPH_FUNCTION double temperature(int i) const
    {
      const TypeParameters &par = types[type[i]];
      return (par.heat_capacity > 0.0) ? par.temperature(thermal_energy(i) / rmass[i]) : 0.0;
    }
    SPH_FUNCTION double energy_at(int i, double temperature) const
    {
      const TypeParameters &par = types[type[i]];
      return rmass[i] * (elastic_energy(eos, par.eos, rho[i]) + par.heat(temperature)) + held(i);
    }
  };

  // Owned and ghost particles, on the host or on a device: rows of the loops, and arrays of LAMMPS.  Each function is for
  // one particle i; stages on the host and on the device call these functions.  bound = bound of LimitStage, or nullptr;
  // not_fluid = bits of the groups of boundary particles

  struct ParticleRows {
    Constants par;
    const TypeParameters *types;    // by type, from 1
    int nlocal;

    Particle *particle;
    DensitySum *density;     // of pass 1
    double *zeta_term;       // zeta cdot/c
    const double *weight;    // reference volume w of particle i: weight[i * each]
    int each;                // 1; or 0: weight[0] = 1 for all

    const int *type, *mask;
    const double *rmass;
    double *esph;
    double *rho, *drho, *vfrac;
    double *desph;    // zero before the forces

    StateRows states;
    double *state_pressure;          // read if any type has states
    FlowRow *flow[Flows::NUMBER];    // of the flows of any type
    double *rho_sum = nullptr;       // see Fields, as the next five; with density continuity
    double *shear_rate = nullptr;    // of owned particles, as the next four
    double *shear_mu = nullptr;
    double *vol_rate = nullptr, *vol_heat = nullptr, *vol_support = nullptr;
    double *viscosity = nullptr;        // mu, if mu of any type is not constant
    const PairCoeff *pair = nullptr;    // of types i and j: pair[i * par.ntypes_1 + j]

    // Group bits of bodies; keeps_bodies: the densities of this step do not change rho of bodies, see add_offset()
    int body_bits = 0;
    bool keeps_bodies = false;

    // Return w of the form volume mass

    SPH_FUNCTION double reference_volume(int i) const { return rmass[i] / types[type[i]].eos.rho0; }

    // Return the volume of the equation of state, m/rho

    SPH_FUNCTION double elastic_volume(int i) const { return rmass[i] / rho[i]; }

    // Set the volume V = w/c, the mass density rho = m/V and its rate; particles of other styles keep their density.
    // P1 (1), (5), (16).  Without tension, V is at most m/rho_min: a lone particle of spray has only its own term of c, and the
    // rate of its bulk term, which goes with V^3, would be far above that of the fluid.

    SPH_FUNCTION void set_density(int i) const
    {
      const double w = weight[i * each];
      double vol = w / density[i].c;
      particle[i].vol = vol;
      if (par.shared && types[type[i]].other) return;
      const double mass = rmass[i] / w;
      rho[i] = mass * density[i].c;
      drho[i] = mass * density[i].cdot;
      const double rho_min = types[type[i]].eos.rho_min;
      if (rho[i] < rho_min) particle[i].vol = vol = rmass[i] / rho_min;
      vfrac[i] = vol;
    }

    // Density continuity: replace c of an owned particle, the sum of pass 1, by rho/m.  Add the change of the sum since the
    // last forces to rho; at the first forces keep rho, or set rho0 if rho is 0.  Walls and open zones keep c as the sum; so do
    // bodies, until BoundaryStage::set_frozen() sets their density.  rho_sum of a body particle is minus the sum without
    // particles of the same body.

    SPH_FUNCTION void add_offset(int i, int not_fluid) const
    {
      constexpr double LEAST =
          0.1;    // least rho over rho0: a particle of spray has hardly any neighbors in the sum
      double &sum = rho_sum[i];
      const double before = sum, mass = rmass[i] / weight[i * each];
      const double all = mass * density[i].c, rho0 = types[type[i]].eos.rho0;
      double now = rho[i];
      sum = 0.0;
      if (is_fluid(i, not_fluid)) {
        sum = all;
        if (before > 0.0)
          now += all - before;
        else if (!(now > 0.0))
          now = rho0;
      } else {
        if (!(mask[i] & body_bits) || !(before < 0.0 && now > 0.0)) return;
        sum = -all;
        if (!keeps_bodies) now += all + before;
      }
      if (now < LEAST * rho0) now = LEAST * rho0;
      rho[i] = now;
      density[i].c = now / mass;
    }

    // Set density, volume, and P/c^2 of a particle to a density and a pressure P, see pressure_term(), not from pass 1

    SPH_FUNCTION void set_state(int i, double density_of, double total) const
    {
      const double vol = rmass[i] / density_of;
      particle[i].vol = vol;
      particle[i].g = pressure_term(total, vol, weight[i * each]);
      rho[i] = density_of;
      vfrac[i] = vol;
    }

    // Give a body particle the density and the pressure of frozen fluid with the number density c; its volume stays

    SPH_FUNCTION void freeze(int i, double c) const
    {
      const double w = weight[i * each], vol = w / c;
      const double p = pressure(par.eos, types[type[i]].eos, rmass[i] / vol, 0.0);
      particle[i].g = pressure_term(p, vol, w);
      zeta_term[i] = 0.0;
      rho[i] = rmass[i] / vol;
      desph[i] += p * vol * density[i].cdot * (vol / w);
    }

    // Give a boundary particle the reference density of its type and no pressure: most of its neighbors are missing

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

    // Return the rate of shrinking -div u in the dissipation function

    SPH_FUNCTION double shrinking(int i) const
    {
      return density[i].cdot * (particle[i].vol / weight[i * each]);
    }

    // Return the coefficient of the bulk term that acts: at the viscosity of the particle, or within the bound

    SPH_FUNCTION double zeta(int i, const double *bound) const
    {
      const TypeParameters &own = types[type[i]];
      if (par.by_rate) return own.zeta_at_0 + own.zeta_by_mu * viscosity[i];
      if (par.limit == Limit::YES && is_beyond(i, bound)) return zeta_at_bound(bound[i]);
      return own.zeta;
    }

    // Set the rate of shear of an owned particle from the sum of shear_rate_squared(); 0: not fluid

    SPH_FUNCTION void set_shear_rate(int i, double sum, int not_fluid) const
    {
      const double square = is_fluid(i, not_fluid)
          ? shear_rate_squared(par.dim, par.rate_factor, sum, shrinking(i))
          : 0.0;
      shear_rate[i] = (square > 0.0) ? sqrt(square) : 0.0;
    }

    // Set mu of an owned particle at its rate of shear; -1 if not fluid: pairs then have mu of the fluid particle

    SPH_FUNCTION void set_viscosity(int i, int not_fluid) const
    {
      const TypeParameters &own = types[type[i]];
      const double T = states.temperature(i);
      viscosity[i] = is_fluid(i, not_fluid)
          ? Rheology::viscosity(own.keywords.rheology(), own.mu + states.viscosity(i), rho[i],
                                shear_rate[i], T, own.keywords.solid_fraction(T))
          : -1.0;
    }

    // Set the pressure of the states of an owned particle at its density; at_rest: strains are zero.
    // not_fluid = bits of the groups of particles of walls and open zones

    SPH_FUNCTION void set_state_pressure(int i, int not_fluid, bool at_rest) const
    {
      state_pressure[i] = 0.0;
      if (!is_fluid(i, not_fluid)) return;
      states.begin(i, -1.0, at_rest);
      state_pressure[i] = states.pressure(i);
      if (!par.thermal_pressure) return;    // the energy of states is no heat
      const double held = states.energy(i);
      state_pressure[i] -= thermal_pressure(types[type[i]].eos, rho[i], held / rmass[i]);
    }

    // Add the work of the pressure over this time to the internal energy of an owned particle, with the pressure at the new
    // energy.

    SPH_FUNCTION void complete_energy(int i, double time, int not_fluid) const
    {
      if (!is_fluid(i, not_fluid)) return;
      const EosParams &eos = types[type[i]].eos;
      const double shrinks = time * elastic_volume(i) * density[i].cdot / density[i].c;
      const double by_mass = 1.0 / rmass[i];
      double p = pressure(par.eos, eos, rho[i], esph[i] * by_mass);
      if (par.states) p += state_pressure[i];
      esph[i] += shrinks * p / (1.0 - shrinks * thermal_pressure(eos, rho[i], by_mass));
    }

    // Set the input of the flow loops.  set_flow_values(): values of an owned particle.  set_flows(): volume and
    // coefficients of an owned or ghost particle; 0 for particles that are not fluid, until a boundary sets the numbers.

    SPH_FUNCTION void set_flow_values(int i) const
    {
      const StateRows &from = states;
      Flows::visit(par.loops_of_flows, [&](auto channel, int k) {
        using Site = FlowSite<StateRows, decltype(channel)>;
        flow[k][i].value = channel.value(Site{from, i});
      });
    }
    SPH_FUNCTION void set_flows(int i, int not_fluid) const
    {
      for (int k = 0; k < Flows::NUMBER; k++)
        if (par.loops_of_flows >> k & 1) set_flow(k, i, not_fluid);
    }
    SPH_FUNCTION void set_flow(int k, int i, int not_fluid) const
    {
      const bool flows = is_fluid(i, not_fluid);
      flow[k][i].vol = flows ? particle[i].vol : 0.0;
      flow[k][i].coefficient = flows ? types[type[i]].flow[k] : 0.0;
      flow[k][i].flux = 0.0;
    }

    // diffuses(): return whether an owned or ghost particle takes part in the diffusion of volume.  set_diffusion(): set its
    // row, with the pressure of the equation of state, since strains stay.  integrated = bits of groups whose volumes change

    SPH_FUNCTION bool diffuses(int i, int not_fluid, int integrated) const
    {
      return is_fluid(i, not_fluid) && (mask[i] & integrated);
    }
    SPH_FUNCTION void set_diffusion(int i, int not_fluid, int integrated, DiffusionRow &of,
                                    double &impedance) const
    {
      double *const row = of.a;
      const EosParams &eos = types[type[i]].eos;
      const int vol = place_of_volume(par.dim);
      for (int d = 0; d < par.dim; d++) row[d] = particle[i].x[d];
      if (par.dim == 1) row[0] += particle[i].x[1];    // of a line along x or y
      const bool takes_part = diffuses(i, not_fluid, integrated);
      row[vol] = takes_part ? elastic_volume(i) : 0.0;
      row[vol + 1] = takes_part ? pressure(par.eos, eos, rho[i], esph[i] / rmass[i]) : 0.0;
      impedance = types[type[i]].other ? par.impedance : eos.impedance();
    }

    // Return the pressure without bulk term, from density and energy

    SPH_FUNCTION double total_pressure(int i) const
    {
      const double p = pressure(par.eos, types[type[i]].eos, rho[i], esph[i] / rmass[i]);
      return par.states ? p + state_pressure[i] : p;
    }

    // Return the work per time of total_pressure() on the particle: by the thermal part, and by the rest, which becomes
    // elastic energy or strain

    struct Work {
      double thermal, elastic;
    };
    SPH_FUNCTION Work work(int i) const
    {
      const double rate = elastic_volume(i) * density[i].cdot / density[i].c;
      const double thermal =
          thermal_pressure(types[type[i]].eos, rho[i], states.thermal_energy(i) / rmass[i]);
      return {thermal * rate, (total_pressure(i) - thermal) * rate};
    }

    // Set g and zeta_term from volume and density (0 for particles that are not fluid); add the work of the pressure to the
    // heating.  P1 (12), (18)

    SPH_FUNCTION void set_pressure(int i, const double *bound, int not_fluid) const
    {
      set_bulk_term(i, bound, not_fluid);
      if (!is_fluid(i, not_fluid)) return;
      const double vol = elastic_volume(i), w = weight[i * each];
      const double p = total_pressure(i);
      particle[i].g += pressure_term(p, vol, w);
      if (i < nlocal) desph[i] += p * vol * density[i].cdot * (vol / w);
    }

    // The bulk term alone

    SPH_FUNCTION void set_bulk_term(int i, const double *bound, int not_fluid) const
    {
      zeta_term[i] = particle[i].g = 0.0;
      if (!is_fluid(i, not_fluid)) return;
      zeta_term[i] = zeta(i, bound) * shrinking(i);
      if (par.bulk == Bulk::DENSITY)
        particle[i].g = pressure_term(zeta_term[i], particle[i].vol, weight[i * each]);
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
