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

// Vortex viscosity mu_r of a micropolar fluid: drag along the velocity of slip at the point of contact,
// which couples spin and flow.
// Included by sph_dissipation_channel_list.h; sph_dissipation_channels.h has the notation.

#ifdef CHANNEL_CLASS
// clang-format off
ChannelClass(VortexChannel)
// clang-format on
#elif defined(CHANNEL_TERMS)

// Force -a F V_i V_j u*, and half of its torque on each particle, the same on both: 1/2 a F V_i V_j r x u*; P3 (12)
struct Slip : PairTerm<VortexChannel, VortexChannel::ZETA2> {
  static constexpr bool VECTOR = true, SPINS = true;
  template <class Pair> static SPH_INLINE void add_vector(Pair &pair)
  {
    const auto drag = pair.coeff[FIRST] * pair.vv;
    const auto half = 0.5 * drag;
    const auto *const r = pair.r, *const u = pair.u;
    for (int d = 0; d < 3; d++) pair.f[d] -= drag * u[d];
    pair.t[0] += half * (r[1] * u[2] - r[2] * u[1]);
    pair.t[1] += half * (r[2] * u[0] - r[0] * u[2]);
    pair.t[2] += half * (r[0] * u[1] - r[1] * u[0]);
    pair.heat[CHANNEL] += half * dot(u, u);
  }
};

#else

#ifndef LMP_SPH_DISSIPATION_CHANNEL_VORTEX_H
#define LMP_SPH_DISSIPATION_CHANNEL_VORTEX_H

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Rate at which the spin relaxes to half the vorticity, in units of zeta2/(rho I)
  constexpr double VORTEX_RATE = 1.0;

  struct VortexChannel : BaseChannel {
    static constexpr const char *NAME = "vortex";
    static constexpr bool SPINS = true;
    enum { ZETA2, NPAIR };

    static void set_coefficients(const PairFluid &fluid, const OwnWords &, double *own)
    {
      own[ZETA2] = slip_coefficient(fluid);
    }
    SPH_FUNCTION static void add_friction(const double *own, PairFriction &friction)
    {
      friction.along += own[ZETA2];
      friction.across += own[ZETA2];
    }
    template <class Add>
    static void add_columns(const PairFluid &, const OwnWords &, const double *own, Add &&add)
    {
      add("zeta2", own[ZETA2]);
    }
    static double intrinsic_kappa(const PairFluid &fluid)    // lambda = mu - mu_r
    {
      return -fluid.viscosity[MU_R];
    }
    // Check zeta2 >= 0 and zeta1 + zeta2 >= 0
    static const char *inadmissible(const PairFluid &fluid, const OwnWords &)
    {
      const double mu_r = fluid.viscosity[MU_R];
      if (!(mu_r >= 0.0)) return "mu_r must be >= 0";
      if (!(fluid.dim * mu_r <= (fluid.dim + 2) * fluid.viscosity[MU] * (1.0 + 1.0e-14)))
        return "mu_r must be <= mu (1 + 2/n)";
      return nullptr;
    }
    static double rate(const PairFluid &, const OwnWords &, const double *own,
                       const PairInertia &inertia)
    {
      return VORTEX_RATE * own[ZETA2] / inertia.rho_inertia;
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
#endif
