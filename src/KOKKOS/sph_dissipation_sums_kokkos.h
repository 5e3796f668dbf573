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

// Other sums over the pairs of each particle, as classes LimitStage, FlowStage, DiffusionStage and ShiftStage of the CPU
// styles

#include "sph_dissipation_loops_kokkos.h"
#include "sph_dissipation_shift_terms.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // A flow, as flow_loop() of the CPU styles

  template <class DeviceType, class K> struct FlowLoopKokkos {
    LoopDataKokkos<DeviceType> data;
    int place;         // of the flow
    double *rate;      // amount that each particle gets per time; nullptr: not needed
    bool of_energy;    // the amount is added to the rate of the internal energy

    KOKKOS_INLINE_FUNCTION void operator()(int ii) const
    {
      const int i = data.ilist(ii);
      const FlowRow *const row = data.flow[place];
      const FlowRow own = row[i];
      if (rate) rate[i] = 0.0;
      if (own.vol == 0.0) return;
      double sum = 0.0;
      for_neighbors(data, i, [&](int j, const double *, double rsq) {
        const FlowRow &other = row[j];
        const double slope = data.par.slope_norm * K::slope(Kokkos::sqrt(rsq) / data.par.support);
        sum += flow_of_pair(mean_coefficient(own.coefficient, other.coefficient),
                            own.vol * other.vol * slope, own.value, other.value);
      });
      if (of_energy) data.desph[i] += sum;
      if (rate) rate[i] = sum;
    }
  };

  // The diffusion of volume: the arrays of DiffusionStage, on the device

  struct DiffusionRowsKokkos {
    DiffusionRow *row;      // of owned and ghost particles, as the next one
    double *impedance;      // not read if it is the same for all
    double factor;          // of a_ij, which the loops leave out
    double *rate, *heat;    // of owned particles, see Fields, as the next one
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

  template <class DeviceType, class K> struct BoundLoopKokkos {
    LoopDataKokkos<DeviceType> data;
    double *bound;

    KOKKOS_INLINE_FUNCTION void operator()(int ii) const
    {
      const int i = data.ilist(ii);
      const double vol_i = data.particle[i].vol, weight_i = data.weight[i * data.each];
      const PairCoeff *const coeff = &data.coeff[data.type[i] * data.par.ntypes_1];
      double sum = 0.0;
      for_neighbors(data, i, [&](int j, const double *, double rsq) {
        const double r = Kokkos::sqrt(rsq);
        const double slope = data.par.slope_norm * K::slope(r / data.par.support);
        const double weight = central_weight(data.par.shear, coeff[data.type[j * data.typed]], r);
        sum += bound_of_pair(weight, slope, rsq, vol_i, weight_i, data.particle[j].vol,
                             data.weight[j * data.each])
                   .i;
      });
      bound[i] = sum;
    }
  };

  // A shift of the particles, as ShiftStage::run(): four loops over the pairs of the last forces

  template <class DeviceType> struct ShiftDataKokkos {
    LoopDataKokkos<DeviceType> data;
    ShiftLaw law;
    ShiftRow *row;    // of owned and ghost particles

    KOKKOS_INLINE_FUNCTION void velocity(int i, double *v) const
    {
      velocity_in_shift(row[i], data.particle[i].u, v);
    }

    // Call function(j, a_ij, r_ij at the new places) for the neighbors with which particle i shifts

    template <class K, class Function>
    KOKKOS_INLINE_FUNCTION void for_partners(int i, const Function &function) const
    {
      if (row[i].vol == 0.0) return;
      for_neighbors(data, i, [&](int j, const double *r, double rsq) {
        const double share = shift_share(pair_slope<K>(data, rsq), row[i], row[j]);
        if (share == 0.0) return;
        double moved[3];
        for (int d = 0; d < 3; d++) moved[d] = r[d] + (row[i].d[d] - row[j].d[d]);
        function(j, share, moved);
      });
    }
  };

  template <class DeviceType, class K> struct ShiftLoopKokkos : ShiftDataKokkos<DeviceType> {
    KOKKOS_INLINE_FUNCTION void operator()(int ii) const
    {
      const auto &data = this->data;
      const auto &law = this->law;
      const int i = data.ilist(ii);
      ShiftRow &own = this->row[i];
      if (own.vol == 0.0) return;
      ShiftSum sum;
      for_neighbors(data, i, [&](int j, const double *r, double rsq) {
        const Particle &other = data.particle[j];
        const double slope = pair_slope<K>(data, rsq);
        const double shape = K::shape(Kokkos::sqrt(rsq) / law.support);
        double u[3];
        for (int d = 0; d < 3; d++) u[d] = data.particle[i].u[d] - other.u[d];
        add_to_shift(law, r, u, other.vol, slope,
                     concentration_push(other.vol, slope, shape, own.contact),
                     shift_share(slope, own, this->row[j]), sum);
      });
      set_shift(law, sum, own);
    }
  };

  template <class DeviceType, class K> struct ShiftExchangeKokkos : ShiftDataKokkos<DeviceType> {
    KOKKOS_INLINE_FUNCTION void operator()(int ii) const
    {
      const int i = this->data.ilist(ii);
      ShiftExchange sum;
      double own[3], other[3];
      this->velocity(i, own);
      this->template for_partners<K>(i, [&](int j, double share, const double *) {
        this->velocity(j, other);
        for (int d = 0; d < 3; d++) {
          sum.moved[d] += share * this->row[j].q[d];
          sum.slip[d] += share * (own[d] - other[d]);
        }
      });
      set_displacement(sum, this->row[i]);
    }
  };

  template <class DeviceType, class K> struct ShiftTensorKokkos : ShiftDataKokkos<DeviceType> {
    KOKKOS_INLINE_FUNCTION void operator()(int ii) const
    {
      const int i = this->data.ilist(ii);
      ShiftTensor sum;
      this->template for_partners<K>(i, [&](int, double share, const double *r) {
        add_square(this->law.dim, share, r, sum.a);
      });
      set_return(this->law.dim, sum, this->row[i]);
    }
  };

  template <class DeviceType, class K> struct ShiftReturnKokkos : ShiftDataKokkos<DeviceType> {
    ShiftReturn *sum;    // of owned particles

    KOKKOS_INLINE_FUNCTION void operator()(int ii) const
    {
      const int i = this->data.ilist(ii);
      ShiftReturn total;
      double own[3], other[3], push[3];
      this->velocity(i, own);
      this->template for_partners<K>(i, [&](int j, double share, const double *r) {
        this->velocity(j, other);
        total.work += impulse_of_pair(share, this->row[i], this->row[j], own, other, r, push);
        for (int d = 0; d < 3; d++) total.impulse[d] += push[d];
      });
      sum[i] = total;
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
