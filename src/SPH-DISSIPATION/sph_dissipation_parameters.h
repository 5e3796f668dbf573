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

#ifndef LMP_SPH_DISSIPATION_PARAMETERS_H
#define LMP_SPH_DISSIPATION_PARAMETERS_H

// Parameters of the fluid, for loops, stages, noise, and device.  No LAMMPS include.

#include "sph_dissipation_channels.h"

#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Parameters of a type

  struct TypeParameters {
    EosParams eos;
    double zeta = 0.0;    // coefficient of the bulk term
    // mu of pair_coeff; if mu is not constant, zeta = zeta_at_0 + zeta_by_mu mu
    double mu = 0.0, zeta_at_0 = 0.0, zeta_by_mu = 0.0;
    double heat_capacity = 0.0;         // per mass
    double flow[Flows::NUMBER] = {};    // coefficients
    TypeCoeffs keywords;                // of the channels
    int other = 1;                      // 1: the type belongs to another style of pair_style hybrid
    States::Numbers states;             // for the time step

    // temperature(): return the temperature at heat q per mass, with a heat capacity; heat(): return q at a temperature
    SPH_FUNCTION double temperature(double q) const
    {
      return keywords.temperature(heat_capacity, q);
    }
    SPH_FUNCTION double heat(double T) const { return keywords.heat(heat_capacity, T); }
    bool has_solid() const { return keywords.rheology()[Rheology::SOLID_FACTOR] != 0.0; }
  };

  // Settings and coefficients of the fluid and the numbers that follow from both, for one run or until a coefficient changes.
  // FluidModel::derive() sets this struct; all other code reads the struct.

  struct Parameters : Constants {
    std::vector<TypeParameters> type;    // by type, from 1
    std::vector<PairCoeff> pair;         // of types i and j: pair[i * ntypes_1 + j]
    std::vector<double> pair_energy;     // a of the energy of pairs, as pair; empty: none
    std::vector<double> cohesion;        // A of the energy of cohesion, as pair; empty: none

    void set_uniform();          // sets uniform, inviscid, and optional, from pair
    void set_alike();            // sets the numbers of flows and sound, from type
    void set_step(double dt);    // sets the numbers of the states for a time step
    // true: each partner of a pair has its own random number, see NoiseStage
    bool directed_noise() const;
  };

  inline void Parameters::set_uniform()
  {
    uniform = inviscid = true;
    optional = false;
    for (const PairCoeff &one : pair)
      if (optional_channel(one)) optional = true;
    for (int i = 1; i < ntypes_1; i++)
      for (int j = 1; j < ntypes_1; j++)
        for (int k = 0; k < Channels::NPAIR; k++) {
          const double a = pair[i * ntypes_1 + j].a[k];
          if (a != pair[ntypes_1 + 1].a[k]) uniform = false;
          if (a != 0.0) inviscid = false;
        }
    for (const TypeParameters &one : type)
      if (one.has_solid()) uniform = false;                   // harmonic means within a fluid
    for (int i = 1; i < ntypes_1 && own_temperatures; i++)    // the noise has the flow of heat
      if (type[i].flow[HEAT_FLOW] != type[1].flow[HEAT_FLOW]) uniform = false;
  }

  inline void Parameters::set_alike()
  {
    thermal_pressure = false;
    impedes_alike = true;
    flows = 0;
    flows_alike = ~0;
    const TypeParameters *first = nullptr;
    for (const TypeParameters &one : type) {
      if (one.other) continue;
      if (!first) first = &one;
      if (one.eos.gruneisen != 0.0) thermal_pressure = true;
      for (int k = 0; k < Flows::NUMBER; k++) {
        if (one.flow[k] > 0.0) flows |= 1 << k;
        if (one.flow[k] != first->flow[k]) flows_alike &= ~(1 << k);
      }
      if (one.eos.impedance() != first->eos.impedance()) impedes_alike = false;
    }
    if (first) impedance = first->eos.impedance();
    loops_of_flows = own_temperatures ? flows & ~Flows::in_pass_2() : flows;
  }

  inline bool Parameters::directed_noise() const
  {
    return thermal && !own_temperatures && limit != Limit::NO &&
        std::any_of(type.begin(), type.end(), [](const TypeParameters &one) {
             return !one.other && one.zeta < 0.0;
           });
  }

  inline void Parameters::set_step(double dt)
  {
    step = dt;
    states = false;
    for (TypeParameters &one : type) {
      one.states = one.other ? States::Numbers()
                             : States::numbers(one.keywords, one.eos.rho0, one.heat_capacity, dt);
      states = states || one.states.any();
    }
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
