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

// The two pair loops on the device, over full neighbor lists: each particle sums up its own pairs and adds nothing to other
// particles, so that sums do not depend on the number of threads.

#include "sph_dissipation_arrays_kokkos.h"
#include "sph_dissipation_parameters.h"
#include "sph_dissipation_particle_terms.h"
#include "sph_dissipation_rows.h"
#include "sph_dissipation_wall_terms.h"

namespace LAMMPS_NS {
namespace SPHDissipation {
  // Functions for the formulas of a pair, see sph_dissipation_simd.h

  typedef double Vec;
  SPH_INLINE double square_root(double a)
  {
    return Kokkos::sqrt(a);
  }
  SPH_INLINE double if_positive(double a, double value)
  {
    return (a > 0.0) ? value : 0.0;
  }
  SPH_INLINE double smaller(double a, double b)
  {
    return (a < b) ? a : b;
  }
  SPH_INLINE double larger(double a, double b)
  {
    return (a < b) ? b : a;
  }

#include "sph_dissipation_boundary_terms.h"
#include "sph_dissipation_pair_terms.h"

  // Input, output and scratch space of the loops, as class LoopData of the CPU styles

  template <class DeviceType> struct LoopDataKokkos : ParticleRows {
    typedef ArrayTypes<DeviceType> AT;

    typename AT::t_int_1d ilist, numneigh;
    typename AT::t_neighbors_2d neighbors;

    Spin *spin;                                           // micropolar, else nullptr
    const Excess *excess;                                 // nullptr without boundaries
    Kokkos::View<double *[NCHANNEL], DeviceType> heat;    // of owned particles
    int typed;    // 0: the coefficients of all pairs are the same, and pair[] is read for types 1 alone

    int not_fluid;    // bits of the groups whose particles have no drag
    bool linear;      // friction at increments of the velocities: the drag is relative to rest
    typename AT::t_kkacc_1d_3 f, torque;                                 // torque: micropolar
    Kokkos::View<double *[6], Kokkos::LayoutRight, DeviceType> vatom;    // empty: not requested
  };

  // The row of a neighbor.  What limits the loops on a GPU is the number of loads of such rows, so each load has 16 bytes, and
  // is there once: the place is read at first, the rest only inside the support

  struct TwoNumbers {
    double a, b;
  };

  class NeighborRow {
   public:
    SPH_FUNCTION NeighborRow(const Particle &row) :
        row(row), first(load(row.x)), second(load(row.x + 2))
    {
    }
    // Set r = r_i - r_j; return r^2
    SPH_FUNCTION double distance(const Particle &pi, double *r) const
    {
      r[0] = pi.x[0] - first.a;
      r[1] = pi.x[1] - first.b;
      r[2] = pi.x[2] - second.a;
      return dot(r, r);
    }
    SPH_FUNCTION void velocity(const Particle &pi, double *u) const
    {
      const TwoNumbers third = load(row.u + 1);
      u[0] = pi.u[0] - second.b;
      u[1] = pi.u[1] - third.a;
      u[2] = pi.u[2] - third.b;
    }
    SPH_FUNCTION void volume_and_g(double &vol, double &g) const
    {
      const TwoNumbers fourth = load(&row.vol);
      vol = fourth.a;
      g = fourth.b;
    }

   private:
    const Particle &row;
    const TwoNumbers first, second;

    static SPH_FUNCTION TwoNumbers load(const double *from)
    {
#ifdef __CUDA_ARCH__
      const double2 two = __ldg(reinterpret_cast<const double2 *>(from));
      return {two.x, two.y};
#else
      return {from[0], from[1]};
#endif
    }
  };

  // Call function(j, r = r_i - r_j, r^2, row) for each neighbor of particle i inside the support

  template <class DeviceType, class Function>
  KOKKOS_FORCEINLINE_FUNCTION void for_rows(const LoopDataKokkos<DeviceType> &data, int i,
                                            const Function &function)
  {
    const Particle pi = data.particle[i];
    const int jnum = data.numneigh(i);
    for (int jj = 0; jj < jnum; jj++) {
      const int j = data.neighbors(i, jj) & NEIGHMASK;
      const NeighborRow row(data.particle[j]);
      double r[3];
      const double rsq = row.distance(pi, r);
      if (rsq < data.par.support * data.par.support) function(j, r, rsq, row);
    }
  }

  // Call function(j, r, r^2)

  template <class DeviceType, class Function>
  KOKKOS_FORCEINLINE_FUNCTION void for_neighbors(const LoopDataKokkos<DeviceType> &data, int i,
                                                 const Function &function)
  {
    for_rows(data, i, [&](int j, const double *r, double rsq, const NeighborRow &) {
      function(j, r, rsq);
    });
  }

  // Runs a loop with or without virial; loop.row(k, virial) adds the virial of a particle and returns the number of the
  // particle

  template <class Loop> struct VirialLoopKokkos {
    Loop loop;

    KOKKOS_INLINE_FUNCTION void operator()(int k) const { loop.template row<false>(k, nullptr); }
    KOKKOS_INLINE_FUNCTION void operator()(int k, EV_FLOAT &ev) const
    {
      double virial[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
      const int i = loop.template row<true>(k, virial);
      for (int c = 0; c < 6; c++) ev.v[c] += virial[c];
      if (loop.data.vatom.extent(0))
        for (int c = 0; c < 6; c++) loop.data.vatom(i, c) += virial[c];
    }
  };

  // Add half of the virial of a pair; a and b are r and the force on i, in any order but for round-off

  SPH_INLINE void add_virial(const double *a, const double *b, double *virial)
  {
    for (int d = 0; d < 3; d++) virial[d] += 0.5 * a[d] * b[d];
    virial[3] += 0.5 * a[0] * b[1];
    virial[4] += 0.5 * a[0] * b[2];
    virial[5] += 0.5 * a[1] * b[2];
  }

  // Pass 1: sum c_i = sum_j w_j W, cdot_i = -sum_j w_j F r_ij.u_ij

  template <class DeviceType, class K> struct DensityLoopKokkos {
    LoopDataKokkos<DeviceType> data;

    KOKKOS_INLINE_FUNCTION void operator()(int ii) const
    {
      const int i = data.ilist(ii);
      const Particle pi = data.particle[i];
      const double support_inv = 1.0 / data.par.support;
      double c = data.par.self_weight * data.weight[i * data.each], cdot = 0.0;

      for_rows(data, i, [&](int j, const double *r, double rsq, const NeighborRow &row) {
        double u[3];
        row.velocity(pi, u);
        const double q = Kokkos::sqrt(rsq) * support_inv;
        const double weight = data.weight[j * data.each];
        c += weight * data.par.weight_norm * K::shape(q);
        cdot -= weight * data.par.slope_norm * K::slope(q) * dot(r, u);
      });
      data.density[i] = {c, cdot};
    }
  };

  // Pass 2, as force_loop() of the CPU styles

  template <class DeviceType, class K, class Form, bool VOLUME> struct ForceLoopKokkos {
    LoopDataKokkos<DeviceType> data;

    template <bool VIRIAL> KOKKOS_INLINE_FUNCTION int row(int ii, double *virial) const
    {
      const int i = data.ilist(ii);
      const Particle pi = data.particle[i];
      const Spin spin_i = Form::SPINS ? data.spin[i] : Spin();
      const double support_sq = data.par.support * data.par.support;
      const double support_inv = 1.0 / data.par.support;
      const double zeta_term_i = data.zeta_term[i];
      const double weight_i = data.weight[i * data.each];
      const PairCoeff *const coeff_i = &data.pair[data.type[i] * data.par.ntypes_1];
      double total_f[3] = {0.0, 0.0, 0.0}, total_t[3] = {0.0, 0.0, 0.0}, divergence = 0.0;
      double heat[NCHANNEL] = {};
      const bool crosses = data.excess && data.excess[i].crosses != 0.0;

      const int jnum = data.numneigh(i);
      for (int jj = 0; jj < jnum; jj++) {
        const int j = data.neighbors(i, jj) & NEIGHMASK;
        const NeighborRow row(data.particle[j]);
        PairState pair;
        const double rsq = row.distance(pi, pair.r);
        if (rsq >= support_sq) continue;
        row.velocity(pi, pair.u);
        double vol_j, g_j;
        row.volume_and_g(vol_j, g_j);
        const double slope = data.par.slope_norm * K::slope(square_root(rsq) * support_inv);
        pair.coeff = coeff_i[data.type[j * data.typed]].a;
        pair.approach = dot(pair.r, pair.u);
        pair.vv = volumes_slope(rsq, pi.vol, vol_j, slope);
        for (int c = 0; c < NCHANNEL; c++) pair.heat[c] = 0.0;
        if constexpr (Form::SPINS)
          for (int d = 0; d < 3; d++) pair.t[d] = pair.spin[d] = 0.0;

        pair.central = pressing_term(pi.g, g_j, slope) * weight_i * data.weight[j * data.each];
        if constexpr (Form::CENTRAL)
          pair.by_metric = pair.vv / (metric_of<Form::BY_DISTANCE>(rsq) + TINY);
        if constexpr (Form::BY_RATE) {
          pair.mu[0] = data.viscosity[i];
          pair.mu[1] = data.viscosity[j];
        }
        Form::add_central(pair);
        if constexpr (VOLUME) {
          pair.central += volume_term(zeta_term_i, data.zeta_term[j], pair.vv);
          divergence -= slope * pair.approach * vol_j;
        }
        for (int d = 0; d < 3; d++) pair.f[d] = pair.central * pair.r[d];
        if constexpr (Form::SPINS) {
          const Spin &spin_j = data.spin[j];
          slip_velocity(spin_i.w, spin_j.w, pair.r, pair.u);
          for (int d = 0; d < 3; d++) pair.s[d] = spin_i.w[d] - spin_j.w[d];
        }
        Form::add_vector(pair);
        if (crosses && data.excess[i].is_boundary != data.excess[j].is_boundary)
          give_boundary_heat(pair, data.excess[i], data.excess[j]);
        if constexpr (Form::SPINS)
          for (int d = 0; d < 3; d++) total_t[d] += pair.t[d] - pair.spin[d];
        for (int d = 0; d < 3; d++) total_f[d] += pair.f[d];
        for (int c = 0; c < NCHANNEL; c++) heat[c] += pair.heat[c];

        if constexpr (VIRIAL) add_virial(pair.r, pair.f, virial);
      }

      heat[BULK_HEAT] =
          bulk_heat(data.par.bulk, zeta_term_i, pi.vol, weight_i, data.density[i].cdot, divergence);
      if (data.par.drag && !(data.mask[i] & data.not_fluid))
        Channels::add_drag(data.types[data.type[i]].keywords.a, pi.vol, pi.u, data.linear, total_f,
                           heat);
      for (int d = 0; d < 3; d++) data.f(i, d) += total_f[d];
      if constexpr (Form::SPINS)
        for (int d = 0; d < 3; d++) data.torque(i, d) += total_t[d];
      for (int c = 0; c < NCHANNEL; c++) {
        data.heat(i, c) = heat[c];
        data.desph[i] += heat[c];
      }
      return i;
    }

    // Give the fluid all heat of a pair with a boundary

    KOKKOS_INLINE_FUNCTION void give_boundary_heat(PairState &pair, const Excess &own,
                                                   const Excess &other) const
    {
      PairState more = pair;
      for (int d = 0; d < 3; d++) more.u[d] = own.u[d] - other.u[d];
      more.approach = dot(pair.r, more.u);
      if constexpr (Form::SPINS) {
        slip_velocity(own.w, other.w, pair.r, more.u);
        for (int d = 0; d < 3; d++) more.s[d] = own.w[d] - other.w[d];
      }
      add_boundary_heat<Form>(pair, more, 1.0);
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
