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

// Conduction of heat: the flow of sph_dissipation_flows.h with the temperature T and the conductivity k.  Each pair raises
// the entropy, by 2 k_ij F V_i V_j (T_i - T_j)^2/(T_i T_j) per time.
// With melt, the heat q per mass also holds the latent heat L, evenly over a range of temperatures:
//   q = cv T + L phi,   phi = (T - T_s)/(T_l - T_s) between 0 and 1, the liquid fraction
// V. R. Voller, C. Prakash, Int. J. Heat Mass Transfer 30, 1709 (1987).
// Included by sph_dissipation_channel_list.h; sph_dissipation_channels.h has the notation.

#ifdef CHANNEL_CLASS
// clang-format off
ChannelClass(HeatChannel)
// clang-format on
#elif defined(CHANNEL_TERMS)

// Return the square of the random flow, in units of 2 k_B/dt
template <class Real>
SPH_INLINE Real heat_noise(Real conductivity, Real vv, double temperature_i, Real temperature_j)
{
  return 2.0 * conductivity * vv * temperature_i * temperature_j;
}

#else

#ifndef LMP_SPH_DISSIPATION_CHANNEL_HEAT_H
#define LMP_SPH_DISSIPATION_CHANNEL_HEAT_H

namespace LAMMPS_NS {
namespace SPHDissipation {

  struct HeatChannel : BaseChannel, BaseFlow {
    static constexpr const char *NAME = "heat";
    static constexpr bool OF_MOTION = false, OPTIONAL = true;
    static constexpr bool STIFF = true, IN_PASS_2 = true;
    // GAMMA and T0 belong to the equation of state
    enum { CONDUCTIVITY, GAMMA, T0, SOLIDUS, LIQUIDUS, LATENT, NTYPE };
    static constexpr std::array<TypeKeyword, 3> TYPE_KEYWORDS = {
        {{"conductivity", "k", 1, 0, HEAT_CAPACITY},
         {"gruneisen", "Gamma T0", 2, 0, HEAT_CAPACITY | NOT_EOS_IDEAL | TENSION},
         {"melt", "T_s T_l L", 3, 0, HEAT_CAPACITY | NOT_EOS_IDEAL | NO_NOISE | MELTS}}};
    static constexpr std::array<TypeVariable, 1> TYPE_VARIABLES = {
        {{"conductivity", CONDUCTIVITY}}};

    // Return the temperature of a type with heat q per mass; return the heat at a temperature; return the solid fraction
    SPH_FUNCTION static double temperature(const double *type, double cv, double q)
    {
      const double solid = cv * type[SOLIDUS], range = type[LIQUIDUS] - type[SOLIDUS];
      if (type[SOLIDUS] == 0.0 || q <= solid) return q / cv;
      const double capacity = cv + type[LATENT] / range;
      if (q < solid + capacity * range) return type[SOLIDUS] + (q - solid) / capacity;
      return (q - type[LATENT]) / cv;
    }
    SPH_FUNCTION static double heat(const double *type, double cv, double T)
    {
      return (type[SOLIDUS] == 0.0) ? cv * T
                                    : cv * T + type[LATENT] * (1.0 - solid_fraction(type, T));
    }
    SPH_FUNCTION static double solid_fraction(const double *type, double T)
    {
      if (type[SOLIDUS] == 0.0 || T >= type[LIQUIDUS]) return 0.0;
      if (T <= type[SOLIDUS]) return 1.0;
      return (type[LIQUIDUS] - T) / (type[LIQUIDUS] - type[SOLIDUS]);
    }

    static double coefficient(const double *type, double) { return type[CONDUCTIVITY]; }
    template <class Site> SPH_FUNCTION static double value(const Site &site)
    {
      return site.temperature();
    }

    template <class Add>
    static void add_columns(const PairFluid &, const OwnWords &words, const double *, Add &&add)
    {
      add("conductivity", words.flow);
    }
    static const char *inadmissible_type(const double *type, int)
    {
      const auto none = [&](int k) {
        return !(type[k] >= 0.0 && std::isfinite(type[k]));
      };
      if (none(CONDUCTIVITY)) return "conductivity must be >= 0";
      if (none(GAMMA) || none(T0)) return "gruneisen must have Gamma >= 0 and T0 >= 0";
      if (none(SOLIDUS) || none(LIQUIDUS) || none(LATENT) ||
          ((type[LIQUIDUS] != 0.0 || type[LATENT] != 0.0) &&
           !(type[SOLIDUS] > 0.0 && type[LIQUIDUS] > type[SOLIDUS])))
        return "melt must have 0 < T_s < T_l and L >= 0";
      if (type[SOLIDUS] != 0.0 && type[GAMMA] != 0.0)
        return "melt and gruneisen must not be given together";
      return nullptr;
    }
    static const char *ignored(const double *type)
    {
      return (type[GAMMA] == 0.0 && type[T0] != 0.0) ? "T0 of gruneisen 0" : nullptr;
    }
    // Return the rate of the form morris, with k/(rho cv) instead of mu/rho
    static double rate(const PairFluid &fluid, const OwnWords &words, const double *,
                       const PairInertia &inertia)
    {
      if (words.flow == 0.0) return 0.0;
      return shear_rate(Shear::MORRIS, inertia.surface) * words.flow /
          (inertia.rho * fluid.heat_capacity * inertia.hsq);
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
#endif
