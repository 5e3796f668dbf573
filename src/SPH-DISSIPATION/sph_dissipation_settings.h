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

#ifndef LMP_SPH_DISSIPATION_SETTINGS_H
#define LMP_SPH_DISSIPATION_SETTINGS_H

// Choices of pair_style, words of pair_coeff, and numbers that do not need the formulas of the channels: nearly all files
// include no more of the fluid.  No LAMMPS include.

#include "sph_dissipation_eos.h"
#include "sph_dissipation_flows.h"
#include "sph_dissipation_kernel.h"

#include <cmath>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Forms of the shear force, see the header of this channel

  enum class Shear { NONE, MG, MG_FR, MORRIS, ESPANOL, MICROPOLAR, MG_FR2, MICROPOLAR_FR2 };

  SPH_FUNCTION constexpr bool has_spins(Shear shear)
  {
    return shear == Shear::MICROPOLAR || shear == Shear::MICROPOLAR_FR2;
  }

  inline const char *shear_name(Shear shear)
  {
    switch (shear) {
      case Shear::MG:
      case Shear::MICROPOLAR:
        return "mg";
      case Shear::MG_FR2:
      case Shear::MICROPOLAR_FR2:
        return "mg/fr2";
      case Shear::MG_FR:
        return "mg/fr";
      case Shear::MORRIS:
        return "morris";
      case Shear::ESPANOL:
        return "espanol";
      default:
        return "none";
    }
  }

  // Return the forms of the shear force of a style with or without spins
  inline std::vector<Shear> shear_forms(bool spins)
  {
    if (spins) return {Shear::MICROPOLAR, Shear::MICROPOLAR_FR2};
    return {Shear::NONE, Shear::MG, Shear::MG_FR, Shear::MG_FR2, Shear::MORRIS, Shear::ESPANOL};
  }

  enum class Bulk { NONE, DENSITY, VOLUME };

  inline const char *bulk_name(Bulk bulk)
  {
    return (bulk == Bulk::DENSITY) ? "density" : (bulk == Bulk::VOLUME) ? "volume" : "none";
  }

  // number: c_i = sum_j W, V_i = 1/c_i                                         P1 (5)
  // mass:   c_i = sum_j w_j W, V_i = w_i/c_i with the reference volume w_i = m_i/rho0 of particle i
  enum class Volume { NUMBER, MASS };

  inline const char *volume_name(Volume volume)
  {
    return (volume == Volume::MASS) ? "mass" : "number";
  }

  // Treatment of negative coefficients of the bulk term beyond the bound of a particle: ignore, count, limit

  enum class Limit { NO, COUNT, YES };

  // default of keyword delta, with density continuity

  constexpr double DEFAULT_DELTA = 0.1;

  // Choices of the pair_style command

  struct Settings {
    Kernel kernel = Kernel::WENDLAND_C2;
    Eos eos = Eos::LINEAR;
    Shear shear = Shear::MG;
    Bulk bulk = Bulk::DENSITY;
    int dim = 0;    // 0: dimension of the simulation
    Limit limit = Limit::NO;
    Volume volume = Volume::NUMBER;
    bool thermal = false;             // thermal noise
    double temperature = 0.0;         // of the noise
    bool own_temperatures = false;    // noise at the temperatures of the internal energies instead
    double heat_capacity = 0.0;       // per mass, of types without cv in pair_coeff
    int seed = 0;
    bool continuity = false;    // the density is a sum and an offset that particles keep
    double delta = 0.0;         // strength of the diffusion of volume
    bool tension = true;        // the pressure may be negative
  };

  // Viscosities of the pairs of types, in the order of pair_coeff
  enum Viscosity { MU, MU_R, GAMMA1, GAMMA2, NVISCOSITY };
  constexpr const char *VISCOSITY_NAMES[] = {"mu", "mu_r", "gamma1", "gamma2"};
  inline int number_of_viscosities(bool spins)
  {
    return spins ? NVISCOSITY : MU_R;
  }

  // Requirements of keywords of pair_coeff, see FluidModel::keyword_that_needs()
  enum Requirement {
    NOTHING = 0,
    HEAT_CAPACITY = 1,    // temperatures: a heat capacity, and no heat bath of one temperature
    NO_NOISE = 2,
    EOS_IDEAL = 4,
    NOT_EOS_IDEAL = 8,
    NO_OPEN_ENDS = 16,
    TENSION = 32,
    RHEOLOGY = 64,    // mu that may not be constant, see FluidModel::check_rheology()
    MELTS = 128,      // the heat capacity depends on the temperature
    NO_RERUN = 256    // forces depend on a state that snapshots do not have
  };

  // Keyword of pair_coeff with coefficients of a type: count numbers, or up to count in groups of equal size.
  struct TypeKeyword {
    const char *name;
    const char *words;    // names of the numbers, of one group, for messages
    int count;            // coefficients, at most
    int group;            // coefficients of a group; 0: no groups
    int needs;            // bits of enum Requirement
    // true: the number 0 has an effect.  The first coefficient is no number of the command, but 1 if the keyword is given
    bool marked = false;
    int first = 0;    // place among the coefficients of all channels, set by type_keywords()

    int numbers() const { return marked ? count - 1 : count; }    // in the command
  };

  // Return the inequality that the viscosities of a type violate, or nullptr if the fluid dissipates:
  // 2 mu |dev E|^2 + kappa (tr E)^2 >= 0
  inline const char *inadmissible(double mu, double kappa)
  {
    if (!(mu >= 0.0)) return "mu must be >= 0";
    if (!(kappa >= 0.0)) return "kappa must be >= 0";
    return nullptr;
  }

  // Pair terms of a run: terms of a form of the shear force, with or without optional terms
  struct Terms {
    Shear shear;
    bool optional;
    bool by_rate;    // mu is not constant
    bool
        one_fluid;    // all pairs have the same coefficients, and the arithmetic mean; read with by_rate
  };

  // Columns of the sums of a particle over pairs: with spins the torque (3 numbers), then the heat of each channel with a
  // bit, but not of the first channel
  struct ChannelColumns {
    bool spins;
    int bits;
    constexpr bool heats(int channel) const { return channel > 0 && (bits >> channel & 1); }
    constexpr int heat(int channel) const
    {
      int column = spins ? 3 : 0;
      for (int c = 1; c < channel; c++) column += heats(c) ? 1 : 0;
      return column;
    }
    constexpr int width() const
    {
      int channel = 1;
      while (bits >> channel) channel++;
      return heat(channel);
    }
  };

  // Constants of all types; a device gets a copy of this struct

  struct Constants : Settings {
    double support = 0.0;             // R
    double self_weight = 0.0;         // W(0)
    double weight_norm = 0.0;         // W = weight_norm * shape(r/R)
    double slope_norm = 0.0;          // F = slope_norm * slope(r/R)
    int ntypes_1 = 1;                 // number of types + 1
    bool uniform = true;              // the coefficients of type 1 hold for all pairs
    bool inviscid = true;             // the coefficients of all pairs are zero
    bool optional = false;            // pairs have optional terms
    bool by_rate = false;             // mu of any type is not constant
    double rate_factor = 0.0;         // of the sum in shear_rate_squared()
    bool drag = false;                // any type has a drag of single particles
    bool thermal_pressure = false;    // the pressure of any type depends on the internal energy
    int flows = 0;                    // bits of the flows of any type
    int loops_of_flows = 0;           // bits of the flows that have loops apart from pass 2
    int flows_alike = 0;              // bits of the flows with one coefficient of all types
    bool impedes_alike = true;        // all types have the same rho0 c0
    double impedance = 1.0;           // rho0 c0 of the first fluid
    bool shared = false;              // some types belong to other styles
    bool states = false;              // any type has states
    double step = 0.0;                // time step of the numbers of the states

    bool spins() const { return has_spins(shear); }
    bool conducts() const { return flows >> HEAT_FLOW & 1; }
    Terms terms() const { return {shear, optional, by_rate, uniform}; }
    void set_kernel(Kernel, int dim, double support);
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

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
