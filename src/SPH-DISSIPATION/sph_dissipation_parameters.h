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

// What the loops, the stages, the noise, and the device read of the fluid.  No LAMMPS include.

#include "sph_dissipation_channels.h"
#include "sph_dissipation_eos.h"
#include "sph_dissipation_kernel.h"

#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // number: c_i = sum_j W, V_i = 1/c_i                                         P1 (5)
  // mass:   c_i = sum_j w_j W, V_i = w_i/c_i with the reference volume w_i = m_i/rho0 of particle i
  enum class Volume { NUMBER, MASS };

  inline const char *volume_name(Volume volume)
  {
    return (volume == Volume::MASS) ? "mass" : "number";
  }

  // negative coefficients of the bulk term beyond the bound of a particle: ignore, count, limit

  enum class Limit { NO, COUNT, YES };

  // defaults of density continuity

  constexpr double DEFAULT_DELTA = 0.1;

  // choices of the pair_style command

  struct Settings {
    Kernel kernel = Kernel::WENDLAND_C2;
    Eos eos = Eos::LINEAR;
    Shear shear = Shear::MG;
    Bulk bulk = Bulk::DENSITY;
    int dim = 0;    // 0: dimension of the simulation
    Limit limit = Limit::NO;
    Volume volume = Volume::NUMBER;
    bool thermal = false;             // thermal noise
    double temperature = 0.0;         // of it
    bool own_temperatures = false;    // each particle has that of its internal energy instead
    double heat_capacity = 0.0;       // per mass, of types that have none of their own
    int seed = 0;
    bool continuity = false;    // the density is a sum and an offset that particles keep
    double delta = 0.0;         // of the diffusion of volume
    bool tension = true;        // the pressure may be negative
  };

  // of a type

  struct TypeParameters {
    EosParams eos;
    double zeta = 0.0;    // coefficient of the bulk term
    // if mu depends on the rate of shear, and zeta on mu: zeta = zeta_at_0 + zeta_by_mu mu
    double mu = 0.0, zeta_at_0 = 0.0, zeta_by_mu = 0.0;
    double heat_capacity = 0.0;         // per mass
    double flow[Flows::NUMBER] = {};    // coefficients
    TypeCoeffs keywords;                // of the channels
    int other = 1;             // its particles belong to another style of pair_style hybrid
    States::Numbers states;    // in a time step
  };

  // what belongs to all types: a device copies it as a whole

  struct Constants : Settings {
    double support = 0.0;             // R
    double self_weight = 0.0;         // W(0)
    double weight_norm = 0.0;         // W = weight_norm * shape(r/R)
    double slope_norm = 0.0;          // F = slope_norm * slope(r/R)
    int ntypes_1 = 1;                 // number of types + 1
    bool uniform = true;              // the coefficients of type 1 hold for all pairs
    bool inviscid = true;             // they are zero
    bool optional = false;            // pairs have optional terms
    bool by_rate = false;             // mu of any type depends on the rate of shear
    bool drag = false;                // of single particles, of any type
    bool thermal_pressure = false;    // of any type: it depends on the internal energy
    int flows = 0;                    // bits of the flows of any type
    int loops_of_flows = 0;           // of those that pass 2 does not have
    int flows_alike = 0;              // of those with the same coefficient of all types
    bool impedes_alike = true;        // all types have the same rho0 c0
    bool shared = false;              // there are types of other styles
    bool states = false;              // any type has some
    double step = 0.0;                // time step that their numbers are of

    bool spins() const { return shear == Shear::MICROPOLAR; }
    bool conducts() const { return flows >> HEAT_FLOW & 1; }
    Terms terms() const { return {shear, optional, by_rate}; }
    void set_kernel(Kernel, int dim, double support);
  };

  // What pair_style and pair_coeff have set and what follows from it, for one run or until a coefficient is
  // changed.  FluidModel::derive() makes it; all others read it.

  struct Parameters : Constants {
    std::vector<TypeParameters> type;    // by type, from 1
    std::vector<PairCoeff> pair;         // of types i and j: pair[i * ntypes_1 + j]

    void set_uniform();          // uniform, inviscid, and optional, from pair
    void set_alike();            // what belongs to flows and sound, from type
    void set_step(double dt);    // the time step of the states
    // each partner of a pair has a random number of its own, see NoiseStage
    bool directed_noise() const;
  };

  inline void Constants::set_kernel(Kernel kernel_in, int dim_in, double support_in)
  {
    kernel = kernel_in;
    dim = dim_in;
    support = support_in;
    self_weight = kernel_weight(kernel, dim, 0.0, support);
    weight_norm = self_weight / with_kernel(kernel, [](auto k) {
                    return k.shape(0.0);
                  });
    slope_norm = weight_norm / (support * support);
  }

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
    for (int i = 1; i < ntypes_1 && own_temperatures; i++)    // of which the noise has coefficients
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
