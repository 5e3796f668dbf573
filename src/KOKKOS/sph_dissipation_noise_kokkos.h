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

#ifndef LMP_SPH_DISSIPATION_NOISE_KOKKOS_H
#define LMP_SPH_DISSIPATION_NOISE_KOKKOS_H

// Thermal noise on the device: the numbers and the forces of the CPU styles, for one pair

#include "sph_dissipation_loops_kokkos.h"
#include "sph_dissipation_noise_data.h"

#include <cstring>

namespace LAMMPS_NS {
namespace SPHDissipation {
  SPH_INLINE double all(double a)
  {
    return a;
  }
}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#define LOOPS on_device
#include "sph_dissipation_words.h"
#undef LOOPS

namespace LAMMPS_NS {
namespace SPHDissipation {
  namespace on_device {

#include "sph_dissipation_noise_terms.h"

    // All pairs of the owned particles, with the functions of SurfacePairsKokkos

    template <class DeviceType> struct AllPairsKokkos {
      KOKKOS_INLINE_FUNCTION int particle(const LoopDataKokkos<DeviceType> &data, int k) const
      {
        return data.ilist(k);
      }
      template <class Function>
      KOKKOS_FORCEINLINE_FUNCTION void for_each(const LoopDataKokkos<DeviceType> &data, int k,
                                                const Function &function) const
      {
        const int i = data.ilist(k);
        const double vol = data.particle[i].vol;
        for_neighbors(data, i, [&](int j, const double *r, double rsq) {
          function(j, r, rsq, vol, data.particle[j].vol, 1.0);
        });
      }
    };

    // Random forces and torques of the pairs, besides pass 2; without temp energy

    template <class DeviceType, class K, int ACROSS, bool SPIN, bool BY_SQUARE, bool BY_DISTANCE,
              class Pairs>
    struct NoiseLoopKokkos {
      typedef PairNumbers<ACROSS, SPIN, false> Numbers;
      LoopDataKokkos<DeviceType> data;
      Pairs pairs;
      NoiseStep step;
      const NoiseCoeff *coeff;    // as data.pair
      const tagint *tag;

      template <bool VIRIAL> KOKKOS_INLINE_FUNCTION int row(int k, double *virial) const
      {
        const int i = pairs.particle(data, k);
        const double tag_i = static_cast<double>(tag[i]);
        const NoiseCoeff *const coeff_i = &coeff[data.type[i] * data.par.ntypes_1];
        double total[3] = {0.0, 0.0, 0.0}, torque[3] = {0.0, 0.0, 0.0};
        pairs.for_each(
            data, k,
            [&](int j, const double *r, double rsq, double vol_i, double vol_j, double factor) {
              const double tag_j = static_cast<double>(tag[j]);
              Words word[1][4];
              set_counter(word[0], step, tag_i, tag_j);
              philox<1>(word, step.pair);
              const Numbers random(word[0], sign_of(tag_i, tag_j));
              const double slope =
                  factor * data.par.slope_norm * K::slope(square_root(rsq) / data.par.support);
              const double vv = volumes_slope(rsq, vol_i, vol_j, slope);
              const double metric = metric_of<BY_DISTANCE>(rsq);
              const double inverse = 1.0 / (rsq + TINY);
              const double by_metric = vv * ((ACROSS == 3) ? inverse : 1.0 / (metric + TINY));
              RandomForce<ACROSS, SPIN, false, BY_SQUARE> force;
              double along = 0.0;
              if constexpr (ACROSS != 3) along = random.z[Numbers::ALONG];
              force.set(&coeff_i[data.type[j * data.typed]].central, random.z, along, r[0], r[1],
                        r[2], vv, metric, by_metric, inverse);
              double f[3];
              for (int d = 0; d < 3; d++) f[d] = force.central * r[d];
              force.add_force(f[0], f[1], f[2]);
              for (int d = 0; d < 3; d++) total[d] += f[d];
              if constexpr (SPIN) {
                double on_both[3] = {0.0, 0.0, 0.0}, on_j[3] = {0.0, 0.0, 0.0};
                force.add_torque(on_both, on_j);
                for (int d = 0; d < 3; d++) torque[d] += on_both[d] - on_j[d];
              }
              if constexpr (VIRIAL) add_virial(r, f, virial);
            });
        for (int d = 0; d < 3; d++) data.f(i, d) += total[d];
        if constexpr (SPIN)
          for (int d = 0; d < 3; d++) data.torque(i, d) += torque[d];
        return i;
      }
    };

    // Random pressure of owned and ghost particles, see NoiseStage::add_pressure()

    struct RandomPressureKokkos {
      ParticleRows rows;
      NoiseStep step;
      PhiloxKeys keys;
      double factor;    // 2 kT/dt
      const tagint *tag;
      int not_fluid;

      KOKKOS_INLINE_FUNCTION void operator()(int i) const
      {
        const double zeta = rows.types[rows.type[i]].zeta;
        if (!(zeta > 0.0) || (rows.mask[i] & not_fluid)) return;
        Words word[1][4];
        draw_for_particle(word, step, keys, static_cast<double>(tag[i]));
        const Particle &particle = rows.particle[i];
        const double c_inv = particle.vol / rows.weight[i * rows.each];
        rows.particle[i].g +=
            sqrt(factor * zeta) * uniform(word[0][0], 1.0) / sqrt(particle.vol) * c_inv * c_inv;
      }
    };

    // Random forces of the drags of single particles, see NoiseStage::draw_drag()

    template <class DeviceType> struct RandomDragKokkos {
      LoopDataKokkos<DeviceType> data;
      NoiseStep step;
      PhiloxKeys keys;
      double factor;
      const tagint *tag;

      KOKKOS_INLINE_FUNCTION void operator()(int i) const
      {
        if (data.mask[i] & data.not_fluid) return;
        const double drag = data.types[data.type[i]].keywords.drag();
        Words word[1][4];
        draw_for_particle(word, step, keys, static_cast<double>(tag[i]));
        const double strength = sqrt(factor * drag * data.particle[i].vol);
        for (int d = 0; d < data.par.dim; d++) data.f(i, d) += strength * uniform(word[0][d], 1.0);
      }
    };

  }    // namespace on_device
}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
