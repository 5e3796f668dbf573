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

// Spin viscosities gamma1, gamma2 of a micropolar fluid: diffusion of the spin between particles.
// Included by sph_dissipation_channel_list.h; sph_dissipation_channels.h has the notation.

#ifdef CHANNEL_CLASS
// clang-format off
ChannelClass(SpinChannel)
// clang-format on
#elif defined(CHANNEL_TERMS)

// Torque F V_i V_j [xi1 (s.e) e + xi2 s] on j, opposite on i, with s = w_i - w_j; P3 (25)
struct SpinDiffusion : PairTerm<SpinChannel, SpinChannel::XI1, SpinChannel::XI2> {
  static constexpr bool VECTOR = true, SPINS = true;
  template <class Pair> static SPH_INLINE void add_vector(Pair &pair)
  {
    const auto along = dot(pair.r, pair.s);
    const auto drag1 = pair.coeff[FIRST] * pair.by_metric * along;
    const auto drag2 = pair.coeff[LAST] * pair.vv;
    for (int d = 0; d < 3; d++) pair.spin[d] += drag1 * pair.r[d] + drag2 * pair.s[d];
    pair.heat[CHANNEL] += 0.5 * (drag1 * along + drag2 * dot(pair.s, pair.s));
  }
};

#else

#ifndef LMP_SPH_DISSIPATION_CHANNEL_SPIN_H
#define LMP_SPH_DISSIPATION_CHANNEL_SPIN_H

namespace LAMMPS_NS {
namespace SPHDissipation {

  struct SpinChannel : BaseChannel {
    static constexpr const char *NAME = "spin";
    static constexpr bool SPINS = true;
    enum { XI1, XI2, NPAIR };

    // Solve gamma1 = xi1/10 + xi2/2, gamma2 = xi1/10 - xi2/2 (n = 3), gamma1 = -gamma2 = xi2/2 (n = 2)
    static void set_coefficients(const PairFluid &fluid, const OwnWords &, double *own)
    {
      const double gamma1 = fluid.viscosity[GAMMA1], gamma2 = fluid.viscosity[GAMMA2];
      if (fluid.dim == 3) own[XI1] = 5.0 * (gamma1 + gamma2);
      own[XI2] = gamma1 - gamma2;
    }
    SPH_FUNCTION static void add_friction(const double *own, PairFriction &friction)
    {
      friction.spin_along += own[XI1] + own[XI2];
      friction.spin_across += own[XI2];
    }
    template <class Add>
    static void add_columns(const PairFluid &, const OwnWords &, const double *own, Add &&add)
    {
      add("xi1", own[XI1]);
      add("xi2", own[XI2]);
    }

    // Check xi2 >= 0 and xi1 + xi2 >= 0; two dimensions have one spin viscosity
    static const char *inadmissible(const PairFluid &fluid, const OwnWords &)
    {
      const double gamma1 = fluid.viscosity[GAMMA1], gamma2 = fluid.viscosity[GAMMA2];
      const bool flat = (fluid.dim == 2);
      if (flat && gamma2 != -gamma1) return "gamma2 must be -gamma1 in 2d";
      if (!(gamma1 - gamma2 >= 0.0)) return "gamma1 - gamma2 must be >= 0";
      if (!(flat || 6.0 * gamma1 + 4.0 * gamma2 >= 0.0)) return "6 gamma1 + 4 gamma2 must be >= 0";
      return nullptr;
    }
    static double rate(const PairFluid &fluid, const OwnWords &, const double *own,
                       const PairInertia &inertia)
    {
      return rate_of_terms(fluid.dim, inertia.hsq, inertia.rho_inertia, own[XI1], own[XI2],
                           inertia.surface);
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
#endif
