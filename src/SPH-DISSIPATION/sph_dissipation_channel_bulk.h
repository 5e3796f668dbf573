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

// Bulk viscosity: each particle has a pressure that is proportional to the rate of its volume.
// Included by sph_dissipation_channel_list.h; sph_dissipation_channels.h has the notation.

#ifdef CHANNEL_CLASS
// clang-format off
ChannelClass(BulkChannel)
// clang-format on
#elif defined(CHANNEL_TERMS)

// Return the force F V_i V_j (zeta_i cdot_i/c_i + zeta_j cdot_j/c_j) r of the form volume, over r; P1 (64)
template <class Real> SPH_INLINE Real volume_term(double zeta_term_i, Real zeta_term_j, Real vv)
{
  return (zeta_term_i + zeta_term_j) * vv;
}

#else

#ifndef LMP_SPH_DISSIPATION_CHANNEL_BULK_H
#define LMP_SPH_DISSIPATION_CHANNEL_BULK_H

namespace LAMMPS_NS {
namespace SPHDissipation {

  // density: f_i = zeta sum_j (V_i^3 cdot_i + V_j^3 cdot_j) F r_ij             P1 (18)
  // volume:  f_i = zeta sum_j (V_i cdot_i + V_j cdot_j) F r_ij V_i V_j         P1 (64)

  // Return the coefficient of the bulk term; intrinsic = bulk viscosity of the pair terms; P1 (67)
  inline double bulk_coefficient(double kappa, double intrinsic)
  {
    return kappa - intrinsic;
  }

  // Return the heat of a particle, energy per time: zeta V (cdot/c)^2 (density); zeta V cdot/c D with the divergence
  // D_i = -sum_j V_j F r.u (volume)
  SPH_FUNCTION double bulk_heat(Bulk bulk, double zeta_term, double vol, double weight, double cdot,
                                double divergence)
  {
    return zeta_term * vol * ((bulk == Bulk::VOLUME) ? divergence : cdot * vol / weight);
  }

  // With a negative coefficient, bulk term and drag of the pairs together dissipate if zeta B >= -1/2 with the bound
  // B_i = sum_j (c_j/c_i)^2 V_j F r^2 / a_ij, where a_ij is the central weight of a pair (theory page).  bound_of_pair()
  // returns F r^2 / a_ij of a pair of slope F and square distance rsq
  SPH_FUNCTION double bound_of_pair(double central_weight, double slope, double rsq)
  {
    return (rsq > 0.0) ? slope * rsq / central_weight : 0.0;
  }
  SPH_FUNCTION bool beyond_bound(double zeta, double bound)
  {
    return zeta * bound < -0.5;
  }
  SPH_FUNCTION double zeta_at_bound(double bound)
  {
    return -0.5 / bound;
  }

  // Rate of the fastest mode, in units of zeta/(rho h^2), found as the rates of shear_rate()
  constexpr double BULK_RATE = 1.6;

  struct BulkChannel : BaseChannel {
    static constexpr const char *NAME = "bulk";

    static double rate(const PairFluid &fluid, const OwnWords &, const double *,
                       const PairInertia &inertia)
    {
      const double zeta = fluid.by_rate ? fluid.largest_zeta : fluid.zeta;
      return BULK_RATE * std::fabs(zeta / inertia.rho) / inertia.hsq;
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
#endif
