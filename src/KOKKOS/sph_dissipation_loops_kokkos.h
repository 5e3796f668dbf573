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

#ifndef LMP_SPH_DISSIPATION_LOOPS_KOKKOS_H
#define LMP_SPH_DISSIPATION_LOOPS_KOKKOS_H

// The two pair loops on the device, over full neighbor lists: each particle sums up its own pairs, so
// that nothing is added to another one, and the sums do not depend on the number of threads.

#include "kokkos_type.h"

#include "sph_dissipation_coeffs.h"
#include "sph_dissipation_kernel.h"
#include "sph_dissipation_particle_terms.h"

namespace LAMMPS_NS {
namespace SPHDissipation {
  // force on i and half of the heat of the shear term, as in force_loop() of the CPU styles, which has
  // vectors of pairs, and noise and spins in the midst of them.  r = r_i - r_j, u = u_i - u_j,
  // vv_slope = F V_i V_j, 0 if r = 0; central = what pressure and bulk term put before r

  template <Shear SHEAR>
  KOKKOS_FORCEINLINE_FUNCTION double pair_terms(const double *r, const double *u, double rsq,
                                                double approach, double vv_slope, double central,
                                                const PairCoeff &coeff, double *force)
  {
    constexpr bool ALONG_R =
        (SHEAR == Shear::MG || SHEAR == Shear::MG_FR || SHEAR == Shear::ESPANOL);
    constexpr bool ALONG_U = (SHEAR == Shear::MORRIS || SHEAR == Shear::ESPANOL);
    constexpr double TINY = 1.0e-300;    // two particles at the same point exert no force

    double heat = 0.0;
    if constexpr (ALONG_R) {
      const double metric = (SHEAR == Shear::MG_FR) ? Kokkos::sqrt(rsq) : rsq;
      const double drag = coeff.along_r * vv_slope / (metric + TINY) * approach;
      central -= drag;
      heat = 0.5 * drag * approach;
    }
    for (int d = 0; d < 3; d++) force[d] = central * r[d];
    if constexpr (ALONG_U) {
      const double drag = coeff.along_u * vv_slope;
      for (int d = 0; d < 3; d++) force[d] -= drag * u[d];
      heat += 0.5 * drag * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    }
    return heat;
  }

  // what the loops read of a particle, owned or ghost

  struct alignas(64) ParticleKokkos {
    double x[3], u[3];
    double vol, g;
  };

  struct DensityKokkos {
    double c, cdot;
  };

  // coefficients of a type

  struct TypeKokkos {
    EosParams eos;
    double zeta;
  };

  // Input, output and scratch space of the loops, as class LoopData of the CPU styles

  template <class DeviceType> struct LoopDataKokkos {
    typedef ArrayTypes<DeviceType> AT;

    typename AT::t_int_1d ilist, numneigh;
    typename AT::t_neighbors_2d neighbors;

    Kokkos::View<ParticleKokkos *, DeviceType> particle;
    Kokkos::View<DensityKokkos *, DeviceType> density;
    Kokkos::View<double *, DeviceType>
        weight;    // reference volume w of particle i: weight(i * each)
    int each;      // 0: it is the same for all, 1
    Kokkos::View<double *, DeviceType> zeta_term;    // zeta cdot/c
    Kokkos::View<double *, DeviceType> heat[2];      // of owned particles: shear, bulk
    Kokkos::View<PairCoeff *, DeviceType> coeff;     // coeff(type[i] * ntypes_1 + type[j * typed])
    int ntypes_1;
    int typed;    // 0: the coefficients of all pairs are the same

    typename AT::t_int_1d type;
    typename AT::t_kkacc_1d_3 f;
    Kokkos::View<double *, Kokkos::LayoutRight, DeviceType> desph;
    Kokkos::View<double *[6], Kokkos::LayoutRight, DeviceType> vatom;    // if it is asked for

    Bulk bulk;
    double support, weight_norm, slope_norm, self_weight;
  };

  // pass 1: c_i = sum_j w_j W, cdot_i = -sum_j w_j F r_ij.u_ij

  template <class DeviceType, class K> struct DensityLoopKokkos {
    LoopDataKokkos<DeviceType> data;

    KOKKOS_INLINE_FUNCTION void operator()(int ii) const
    {
      const int i = data.ilist(ii);
      const ParticleKokkos pi = data.particle(i);
      const double support_sq = data.support * data.support;
      const double support_inv = 1.0 / data.support;
      double c = data.self_weight * data.weight(i * data.each), cdot = 0.0;

      const int jnum = data.numneigh(i);
      for (int jj = 0; jj < jnum; jj++) {
        const int j = data.neighbors(i, jj) & NEIGHMASK;
        const ParticleKokkos &pj = data.particle(j);
        const double dx = pi.x[0] - pj.x[0], dy = pi.x[1] - pj.x[1], dz = pi.x[2] - pj.x[2];
        const double rsq = dx * dx + dy * dy + dz * dz;
        if (rsq >= support_sq) continue;
        const double approach =
            dx * (pi.u[0] - pj.u[0]) + dy * (pi.u[1] - pj.u[1]) + dz * (pi.u[2] - pj.u[2]);
        const double q = Kokkos::sqrt(rsq) * support_inv;
        const double weight = data.weight(j * data.each);
        c += weight * data.weight_norm * K::shape(q);
        cdot -= weight * data.slope_norm * K::slope(q) * approach;
      }
      data.density(i) = {c, cdot};
    }
  };

  // pass 2, as force_loop() of the CPU styles

  template <class DeviceType, class K, Shear SHEAR, bool VOLUME> struct ForceLoopKokkos {
    LoopDataKokkos<DeviceType> data;

    KOKKOS_INLINE_FUNCTION void operator()(int ii) const
    {
      double virial[6];
      row<false>(ii, virial);
    }

    // with the virial

    KOKKOS_INLINE_FUNCTION void operator()(int ii, EV_FLOAT &ev) const
    {
      double virial[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
      row<true>(ii, virial);
      for (int k = 0; k < 6; k++) ev.v[k] += virial[k];
      if (data.vatom.extent(0))
        for (int k = 0; k < 6; k++) data.vatom(data.ilist(ii), k) = virial[k];
    }

    template <bool VIRIAL> KOKKOS_INLINE_FUNCTION void row(int ii, double *virial) const
    {
      const int i = data.ilist(ii);
      const ParticleKokkos pi = data.particle(i);
      const double support_sq = data.support * data.support;
      const double support_inv = 1.0 / data.support;
      const double zeta_term_i = data.zeta_term(i);
      const double weight_i = data.weight(i * data.each);
      const PairCoeff *const coeff = &data.coeff(data.type(i) * data.ntypes_1);
      double fx = 0.0, fy = 0.0, fz = 0.0, heat = 0.0, divergence = 0.0;

      const int jnum = data.numneigh(i);
      for (int jj = 0; jj < jnum; jj++) {
        const int j = data.neighbors(i, jj) & NEIGHMASK;
        const ParticleKokkos &pj = data.particle(j);
        const double r[3] = {pi.x[0] - pj.x[0], pi.x[1] - pj.x[1], pi.x[2] - pj.x[2]};
        const double rsq = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
        if (rsq >= support_sq) continue;
        const double u[3] = {pi.u[0] - pj.u[0], pi.u[1] - pj.u[1], pi.u[2] - pj.u[2]};
        const double approach = r[0] * u[0] + r[1] * u[1] + r[2] * u[2];
        const double slope = data.slope_norm * K::slope(Kokkos::sqrt(rsq) * support_inv);
        const double vv_slope = (rsq > 0.0) ? pi.vol * pj.vol * slope : 0.0;

        double central = (pi.g + pj.g) * slope * weight_i * data.weight(j * data.each);
        if constexpr (VOLUME) {
          central += (zeta_term_i + data.zeta_term(j)) * vv_slope;
          divergence -= slope * approach * pj.vol;
        }
        double force[3];
        heat += pair_terms<SHEAR>(r, u, rsq, approach, vv_slope, central,
                                  coeff[data.type(j * data.typed)], force);
        fx += force[0];
        fy += force[1];
        fz += force[2];

        if constexpr (VIRIAL) {    // half for each partner
          virial[0] += 0.5 * r[0] * force[0];
          virial[1] += 0.5 * r[1] * force[1];
          virial[2] += 0.5 * r[2] * force[2];
          virial[3] += 0.5 * r[0] * force[1];
          virial[4] += 0.5 * r[0] * force[2];
          virial[5] += 0.5 * r[1] * force[2];
        }
      }

      const double bulk =
          bulk_heat(data.bulk, zeta_term_i, pi.vol, weight_i, data.density(i).cdot, divergence);
      data.f(i, 0) += fx;
      data.f(i, 1) += fy;
      data.f(i, 2) += fz;
      data.heat[0](i) = heat;
      data.heat[1](i) = bulk;
      data.desph(i) += heat + bulk;
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
