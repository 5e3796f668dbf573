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

// Conduction of heat between pairs by their temperatures, heat Q_i per time
//   dQ_i/dt = sum_j 2 k_ij F V_i V_j (T_j - T_i),   k_ij = 2 k_i k_j/(k_i + k_j):
// the Laplacian of the form morris with T instead of u, with the harmonic mean, for which the heat flow through a
// plane between two materials is the same from both sides, P. W. Cleary, J. J. Monaghan, J. Comput. Phys. 148,
// 227 (1999).  No pair changes the sum of the heats, and each one raises the entropy, by
// 2 k_ij F V_i V_j (T_i - T_j)^2/(T_i T_j) per time.
// Included by sph_dissipation_channel_list.h; sph_dissipation_channels.h has the notation.

#ifdef CHANNEL_CLASS
// clang-format off
ChannelClass(HeatChannel)
// clang-format on
#elif defined(CHANNEL_TERMS)

// mean of the conductivities of two particles, 0 if one of them has none
template <class Real> SPH_INLINE Real mean_conductivity(double a, Real b)
{
  return 2.0 * a * b / (a + b + TINY);
}

// heat that i gets from j per time; F V_i V_j = vv
template <class Real>
SPH_INLINE Real heat_flow(Real conductivity, Real vv, double temperature_i, Real temperature_j)
{
  return 2.0 * conductivity * vv * (temperature_j - temperature_i);
}

// square of the random flow, in units of 2 k_B/dt
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

  // What the loop reads of a particle that conducts; all numbers are 0 of others.  A boundary particle has either
  // a volume, a temperature and a conductivity, or the heat that its surface gives.  Rows are read by fours.
  struct alignas(16) Conductor {
    double vol;             // V
    double temperature;     // T
    double conductivity;    // k
    double flux;            // heat per area and time from a boundary particle to the fluid
  };

  struct HeatChannel : BaseChannel {
    static constexpr const char *NAME = "heat";
    static constexpr bool OF_MOTION = false;

    static constexpr bool OPTIONAL = true;
    enum { CONDUCTIVITY, GAMMA, T0 };    // the last two: of the equation of state
    static constexpr int NTYPE = 3;
    static constexpr std::array<TypeKeyword, 2> TYPE_KEYWORDS = {
        {{"conductivity", 1, 0, HEAT_CAPACITY},
         {"gruneisen", 2, 0, HEAT_CAPACITY | NOT_EOS_IDEAL | TENSION}}};
    static constexpr std::array<TypeVariable, 1> TYPE_VARIABLES = {
        {{"conductivity", CONDUCTIVITY}}};

    // of two types with these conductivities
    static double mean(double a, double b)
    {
      return (a > 0.0 && b > 0.0) ? 2.0 * a * b / (a + b) : 0.0;
    }

    template <class Add>
    static void add_columns(const PairFluid &fluid, const OwnWords &, const double *, Add &&add)
    {
      add("conductivity", fluid.conductivity);
    }
    static const char *inadmissible_type(const double *type, int)
    {
      const auto none = [&](int k) {
        return !(type[k] >= 0.0 && std::isfinite(type[k]));
      };
      if (none(CONDUCTIVITY)) return "conductivity must be >= 0";
      if (none(GAMMA) || none(T0)) return "gruneisen must have Gamma >= 0 and T0 >= 0";
      return nullptr;
    }
    static const char *ignored(const double *type)
    {
      return (type[GAMMA] == 0.0 && type[T0] != 0.0) ? "T0 of gruneisen 0" : nullptr;
    }
    // of the form morris, with k/(rho cv) instead of mu/rho
    static double rate(const PairFluid &fluid, const OwnWords &, const double *,
                       const PairInertia &inertia)
    {
      if (fluid.conductivity == 0.0) return 0.0;
      return shear_rate(Shear::MORRIS, inertia.surface) * fluid.conductivity /
          (inertia.rho * fluid.heat_capacity * inertia.hsq);
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
#endif
