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

#ifndef LMP_SPH_DISSIPATION_OPEN_KOKKOS_H
#define LMP_SPH_DISSIPATION_OPEN_KOKKOS_H

// Open ends on the device, as class OpenStage on the host

#include "sph_dissipation_loops_kokkos.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  struct SlopeKokkos {
    double q;
    template <class K> KOKKOS_INLINE_FUNCTION double operator()(K) const { return K::slope(q); }
  };

  // The impact of a zone on the fluid, as OpenStage::impact(): each particle of the fluid sums up its own pairs.  These are
  // few, so kernel and bulk term are chosen for each pair.  v = force and torque, evdwl = work and heat

  template <class DeviceType, class Form> struct ZoneImpactKokkos {
    LoopDataKokkos<DeviceType> data;
    Kokkos::View<int *, DeviceType> list;    // of owned particles near zones
    const double *zone_of;                   // see OpenGroups
    double zone;
    bool conducts;

    KOKKOS_INLINE_FUNCTION void operator()(int k, EV_FLOAT &total) const
    {
      const int i = list(k);
      if (zone_of[i] != 0.0) return;
      const Particle pi = data.particle[i];
      const double weight_i = data.weight[i * data.each];
      double force[3] = {0.0, 0.0, 0.0}, couple[3] = {0.0, 0.0, 0.0}, power = 0.0;
      for_neighbors(data, i, [&](int j, const double *r, double rsq) {
        if (zone_of[j] != zone) return;
        const Particle &pj = data.particle[j];
        const double slope = data.par.slope_norm *
            with_kernel(data.par.kernel, SlopeKokkos{Kokkos::sqrt(rsq) / data.par.support});
        const double weights = weight_i * data.weight[j * data.each];
        PairState pair = {};
        for (int d = 0; d < 3; d++) {
          pair.r[d] = r[d];
          pair.u[d] = pi.u[d] - pj.u[d];
        }
        pair.coeff = data.pair[data.type[i] * data.par.ntypes_1 + data.type[j]].a;
        pair.approach = dot(pair.r, pair.u);
        pair.vv = volumes_slope(rsq, pi.vol, pj.vol, slope);
        pair.central = pressing_term(pi.g, pj.g, slope) * weights;
        if constexpr (Form::CENTRAL)
          pair.by_metric = pair.vv / (metric_of<Form::BY_DISTANCE>(rsq) + TINY);
        if constexpr (Form::BY_RATE) {
          pair.mu[0] = data.viscosity[i];
          pair.mu[1] = data.viscosity[j];
        }
        Form::add_central(pair);
        if (data.par.bulk == Bulk::VOLUME) {
          pair.central += volume_term(data.zeta_term[i], data.zeta_term[j], pair.vv);
          power -= data.zeta_term[i] * pair.vv * pair.approach;
        }
        for (int d = 0; d < 3; d++) pair.f[d] = pair.central * r[d];
        if constexpr (Form::SPINS) {
          const double *const w_i = data.spin[i].w, *const w_j = data.spin[j].w;
          slip_velocity(w_i, w_j, pair.r, pair.u);
          for (int d = 0; d < 3; d++) pair.s[d] = w_i[d] - w_j[d];
        }
        Form::add_vector(pair);
        power -= weights * pi.g * slope * pair.approach;
        for (int c = 0; c < NCHANNEL; c++) power += pair.heat[c];
        for (int d = 0; d < 3; d++) force[d] += pair.f[d];
        if constexpr (Form::SPINS)
          for (int d = 0; d < 3; d++) couple[d] += pair.t[d] - pair.spin[d];
        if (!conducts) return;
        const FlowRow &own = data.flow[HEAT_FLOW][i], &other = data.flow[HEAT_FLOW][j];
        power += flow_of_pair(mean_coefficient(own.coefficient, other.coefficient),
                              own.vol * other.vol * slope, own.value, other.value);
      });
      double moment[3];
      cross_product(pi.x, force, moment);
      for (int d = 0; d < 3; d++) {
        power += force[d] * pi.u[d];
        if constexpr (Form::SPINS) power += couple[d] * data.spin[i].w[d];
        total.v[d] += force[d];
        total.v[3 + d] += moment[d] + couple[d];
      }
      total.evdwl += power;
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
