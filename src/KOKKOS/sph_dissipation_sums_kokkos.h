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

#ifndef LMP_SPH_DISSIPATION_SUMS_KOKKOS_H
#define LMP_SPH_DISSIPATION_SUMS_KOKKOS_H

// Other sums over the pairs of each particle

#include "atom.h"
#include "neigh_list.h"
#include "pair.h"
#include "sph_dissipation_kernel.h"
#include "sph_dissipation_loops_kokkos.h"
#include "sph_dissipation_pair_sums.h"
#include "sph_dissipation_space_kokkos.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // A sum of sph_dissipation_pair_sums.h

  template <class DeviceType, class K, class Sum> struct PairSumKokkos {
    LoopDataKokkos<DeviceType> data;
    Sum sum;

    KOKKOS_INLINE_FUNCTION void operator()(int ii) const
    {
      const int i = data.ilist(ii);
      auto total = typename Sum::Row();
      for_neighbors(data, i, [&](int j, const double *r, double rsq) {
        const double length = Kokkos::sqrt(rsq), q = length / data.par.support;
        const PairPlace pair = {{r[0], r[1], r[2]},
                                rsq,
                                length,
                                data.par.slope_norm * K::slope(q),
                                Sum::SHAPE ? K::shape(q) : 0.0};
        sum.add(data, i, j, pair, sum.shared(data, i, j, pair), total);
      });
      sum.finish(data, i, total);
    }
  };

  template <class DeviceType>
  template <class Sum>
  void DeviceSpace<DeviceType>::sum_pairs(const char *name, const Sum &sum)
  {
    with_kernel(data->par.kernel, [&](auto kernel) {
      for_each(name, pair->list->inum,
               PairSumKokkos<DeviceType, decltype(kernel), Sum>{*data, sum});
    });
  }

  template <class DeviceType>
  template <class Loop>
  void DeviceSpace<DeviceType>::run_loop(const char *name, int n, const Loop &loop, bool tally)
  {
    const auto range = Kokkos::RangePolicy<DeviceType>(0, n);
    VirialLoopKokkos<Loop> with_virial = {loop};
    if (!tally) return Kokkos::parallel_for(name, range, with_virial);
    auto &vatom = with_virial.loop.data.vatom;
    if (pair->vflag_atom) vatom = std::decay_t<decltype(vatom)>("sph:vatom", atom->nlocal);
    EV_FLOAT ev;
    Kokkos::parallel_reduce(name, range, with_virial, ev);
    if (pair->vflag_global)
      for (int k = 0; k < 6; k++) pair->virial[k] += ev.v[k];
    if (!pair->vflag_atom) return;
    const auto from = Kokkos::create_mirror_view_and_copy(LMPHostType(), vatom);
    for (int i = 0; i < atom->nlocal; i++)
      for (int k = 0; k < 6; k++) pair->vatom[i][k] += from(i, k);
  }

  // Rates of densities, as the loop of the CPU styles for the rates alone

  struct RateSum {
    typedef double Row;
    static constexpr bool SHAPE = false;

    SPH_FUNCTION double shared(const ParticleRows &of, int i, int j, const PairPlace &pair) const
    {
      const Particle &a = of.particle[i], &b = of.particle[j];
      double approach = 0.0;
      for (int d = 0; d < 3; d++) approach += pair.r[d] * (a.u[d] - b.u[d]);
      return pair.slope * approach;
    }
    SPH_FUNCTION void add(const ParticleRows &of, int, int j, const PairPlace &, double both,
                          double &sum) const
    {
      sum -= of.weight[j * of.each] * both;
    }
    SPH_FUNCTION void finish(const ParticleRows &of, int i, double sum) const
    {
      of.density[i].cdot = sum;
    }
  };

  // A flow, as flow_loop() of the CPU styles

  template <class DeviceType, class K> struct FlowLoopKokkos {
    LoopDataKokkos<DeviceType> data;
    int place;       // of the flow
    double *rate;    // amount that each particle gets per time

    KOKKOS_INLINE_FUNCTION void operator()(int ii) const
    {
      const int i = data.ilist(ii);
      const FlowRow *const row = data.flow[place];
      const FlowRow own = row[i];
      double sum = 0.0;
      if (own.vol != 0.0)
        for_neighbors(data, i, [&](int j, const double *, double rsq) {
          const FlowRow &other = row[j];
          const double slope = data.par.slope_norm * K::slope(Kokkos::sqrt(rsq) / data.par.support);
          sum += flow_of_pair(mean_coefficient(own.coefficient, other.coefficient),
                              own.vol * other.vol * slope, own.value, other.value);
        });
      rate[i] = sum;
    }
  };

  // The diffusion of volume: the arrays of DiffusionStage, on the device

  struct DiffusionRowsKokkos {
    DiffusionRow *row;          // of owned and ghost particles, as the next one
    const double *impedance;    // not read if it is the same for all
    double factor;              // of a_ij, which the loops leave out
    double *rate, *heat;        // of owned particles, see Fields, as the next one
    double *support;
  };

  // Return F of a pair; return a of the pair without this factor

  template <class K, class DeviceType>
  KOKKOS_FORCEINLINE_FUNCTION double pair_slope(const LoopDataKokkos<DeviceType> &data, double rsq)
  {
    return data.par.slope_norm * K::slope(Kokkos::sqrt(rsq) / data.par.support);
  }
  template <class DeviceType>
  KOKKOS_FORCEINLINE_FUNCTION double diffusion_slope(const LoopDataKokkos<DeviceType> &data,
                                                     const DiffusionRowsKokkos &rows, int i, int j,
                                                     double slope)
  {
    if (data.par.impedes_alike) return slope;
    return slope_by_impedance(slope, rows.impedance[i], rows.impedance[j]);
  }

  // Set the gradient of the pressure in the row of each particle, as diffusion_sums() of the CPU styles

  template <class DeviceType, class K, int DIM> struct GradientLoopKokkos {
    typedef DiffusionPlaces<DIM> At;
    LoopDataKokkos<DeviceType> data;
    DiffusionRowsKokkos rows;

    KOKKOS_INLINE_FUNCTION void operator()(int ii) const
    {
      const int i = data.ilist(ii);
      double *const own = rows.row[i].a;
      rows.support[i] = 0.0;
      for (int d = 0; d < DIM; d++) own[At::G + d] = 0.0;
      if (own[At::VOL] == 0.0) return;
      double sum[At::NSUM] = {}, filled[At::NTENSOR] = {};
      for_neighbors(data, i, [&](int j, const double *, double rsq) {
        const double *const other = rows.row[j].a;
        const double slope = pair_slope<K>(data, rsq);
        const double part = diffusion_slope(data, rows, i, j, slope);
        double r[DIM], term[At::NSUM];
        for (int d = 0; d < DIM; d++) r[d] = own[d] - other[d];
        const double difference = own[At::P] - other[At::P];
        gradient_terms<DIM>(part, difference, r, term);
        for (int m = 0; m < At::NSUM; m++) sum[m] += other[At::VOL] * term[m];
        if (data.par.impedes_alike) return;
        gradient_terms<DIM>(slope, difference, r, term);
        for (int m = 0; m < At::NTENSOR; m++) filled[m] += other[At::VOL] * term[m];
      });
      rows.support[i] =
          pressure_gradient(DIM, sum, data.par.impedes_alike ? sum : filled, own + At::G);
    }
  };

  // Set the rates from the gradients, as diffusion_flow()

  template <class DeviceType, class K, int DIM> struct DiffusionLoopKokkos {
    typedef DiffusionPlaces<DIM> At;
    LoopDataKokkos<DeviceType> data;
    DiffusionRowsKokkos rows;

    KOKKOS_INLINE_FUNCTION void operator()(int ii) const
    {
      const int i = data.ilist(ii);
      const DiffusionRow row = rows.row[i];
      const double *const own = row.a;
      double flow[2] = {0.0, 0.0};
      if (own[At::VOL] > 0.0)
        for_neighbors(data, i, [&](int j, const double *, double rsq) {
          const double *const other = rows.row[j].a;
          double r[DIM];
          for (int d = 0; d < DIM; d++) r[d] = own[d] - other[d];
          const double difference = own[At::P] - other[At::P];
          const double by_i = without_gradient<DIM>(difference, own + At::G, r);
          const double by_j = without_gradient<DIM>(difference, other + At::G, r);
          const double part = diffusion_slope(data, rows, i, j, pair_slope<K>(data, rsq));
          const double from_j = part * other[At::VOL];
          flow[0] += from_j * (0.5 * (by_i + by_j));
          flow[1] += from_j * by_i * by_i;
        });
      volume_rates(own + At::VOL, flow, rows.factor, rows.rate[i], rows.heat[i]);
    }
  };

  // Forces of the energies of pairs, after pass 2, and the energies, half of each pair, see PairEnergyStage

  template <class DeviceType> struct TensionLoopKokkos {
    LoopDataKokkos<DeviceType> data;
    const double *unlike, *cohesion;    // a and A by types, as in Parameters; nullptr: none
    PairEnergyKernel unlike_kernel;
    CohesionKernel cohesion_kernel;
    double *energy;    // of owned particles

    template <bool VIRIAL> KOKKOS_INLINE_FUNCTION int row(int ii, double *virial) const
    {
      const int i = data.ilist(ii), dim = data.par.dim, first = data.type[i] * data.par.ntypes_1;
      const double w_i = data.reference_volume(i);
      double total[3] = {0.0, 0.0, 0.0}, sum = 0.0;
      for_neighbors(data, i, [&](int j, const double *r, double rsq) {
        const int types = first + data.type[j];
        const double ww = w_i * data.reference_volume(j);
        double central = 0.0;
        if (unlike && unlike[types] != 0.0) {
          const double a = unlike[types] * ww *
              unlike_kernel.of_rows(spacing_of(dim, w_i),
                                    spacing_of(dim, data.reference_volume(j)));
          central += a * unlike_kernel.slope(rsq);
          sum += 0.5 * a * unlike_kernel.weight(rsq);
        }
        if (cohesion && cohesion[types] != 0.0) {
          const double distance = Kokkos::sqrt(rsq), a = cohesion[types] * ww;
          central += a * cohesion_kernel.slope(distance);
          sum += 0.5 * a * cohesion_kernel.weight(distance);
        }
        const double f[3] = {central * r[0], central * r[1], central * r[2]};
        for (int d = 0; d < 3; d++) total[d] += f[d];
        if constexpr (VIRIAL) add_virial(f, r, virial);
      });
      for (int d = 0; d < 3; d++) data.f(i, d) += total[d];
      energy[i] = sum;
      return i;
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
