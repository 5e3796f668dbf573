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

// The two pair loops, compiled once per instruction set: a source file includes what stands
// below, switches the compiler to the instruction set, defines LOOPS and includes this file.
// Nothing else may be included after the switch, or inline functions of other headers would be
// compiled for a processor that a user may not have.

#include "sph_dissipation_simd.h"
#include "sph_dissipation_words.h"

namespace LAMMPS_NS {
namespace SPHDissipation {
  namespace LOOPS {

#include "sph_dissipation_kernel_shapes.h"
#include "sph_dissipation_pair_terms.h"

    // pass 2 has the processor fetch the rows of the neighbors that come two blocks later

    constexpr int AHEAD = 2 * LANES;

    // particles and sums as rows of numbers

    template <class Row> constexpr int WIDTH = sizeof(Row) / sizeof(double);

    template <class Row> SPH_INLINE const double *numbers(const Row *row)
    {
      return reinterpret_cast<const double *>(row);
    }
    template <class Row> SPH_INLINE double *numbers(Row *row)
    {
      return reinterpret_cast<double *>(row);
    }

    // pass 1: c_i = sum_j w_j W, cdot_i = -sum_j w_j F r_ij.u_ij, with w = 1 unless WEIGHTED
    // leaves the pairs inside the support for pass 2

    template <class K, bool WEIGHTED> void density_loop(LoopData &data)
    {
      const Particle *const particle = data.particle;
      const Vec support_sq = all(data.support * data.support);
      const double support_inv = 1.0 / data.support;
      bigint next = data.begin;

      for (int ii = 0; ii < data.inum; ii++) {
        const int i = data.ilist[ii];
        const int *const jlist = data.firstneigh[i];
        const int jnum = data.numneigh[i];
        const Particle pi = particle[i];
        int *const neighbor = data.neighbor + next;
        double *const slope = data.slope + next;
        int n = 0;
        Vec total[2] = {all(0.0), all(0.0)};

        copy_neighbors(neighbor, jlist, jnum, data.spare);

        for (int jj = 0; jj < jnum; jj += LANES) {
          const int *const j = neighbor + jj;
          Vec pj[8];
          load_4_columns<WIDTH<Particle>>(numbers(particle), j, pj);
          load_4_columns<WIDTH<Particle>>(numbers(particle) + 4, j, pj + 4);
          const Vec dx = pi.x[0] - pj[0], dy = pi.x[1] - pj[1], dz = pi.x[2] - pj[2];
          const Vec ux = pi.u[0] - pj[3], uy = pi.u[1] - pj[4], uz = pi.u[2] - pj[5];
          const Vec rsq = dx * dx + dy * dy + dz * dz;
          const Vec approach = dx * ux + dy * uy + dz * uz;
          int inside = bits_below(rsq, support_sq);
          if (jnum - jj < LANES) inside &= (1 << (jnum - jj)) - 1;

          const Vec q = square_root(rsq) * support_inv;
          const Vec f = data.slope_norm * K::slope(q);
          Vec sums[2] = {if_bits(inside, data.weight_norm * K::shape(q)),
                         if_bits(inside, -f * approach)};
          if constexpr (WEIGHTED) {
            const Vec weight = gather(data.weight, j);
            for (int c = 0; c < 2; c++) {
              total[c] += weight * sums[c];
              sums[c] *= data.weight[i];
            }
          } else
            for (int c = 0; c < 2; c++) total[c] += sums[c];
          add_2_columns<WIDTH<DensitySum>>(numbers(data.density), j, sums);

          pack(slope + n, f, inside);
          pack(neighbor + n, j, inside);
          n += count_bits(inside);
        }
        data.density[i].c += sum(total[0]);
        data.density[i].cdot += sum(total[1]);

        // fill up the last block with spare particles and F = 0

        store(slope + n, all(0.0));
        for (int l = 0; l < LANES; l++) neighbor[n + l] = data.spare + l;
        data.count[ii] = n;
        data.first[ii] = next;
        next += (n + LANES - 1) / LANES * LANES;
      }
      for (int k = 0; k < AHEAD; k++) data.neighbor[next + k] = data.spare;
    }

    // cdot of pass 1 alone, by the pairs that it has left

    template <bool WEIGHTED> void rate_loop(LoopData &data)
    {
      const Particle *const particle = data.particle;
      double *const cdot = numbers(data.density) + 1;

      for (int ii = 0; ii < data.inum; ii++) {
        const int i = data.ilist[ii];
        const Particle pi = particle[i];
        const int *const neighbor = data.neighbor + data.first[ii];
        const double *const slope_of = data.slope + data.first[ii];
        Vec total = all(0.0);

        for (int k = 0; k < data.count[ii]; k += LANES) {
          const int *const j = neighbor + k;
          Vec pj[8];
          load_4_columns<WIDTH<Particle>>(numbers(particle), j, pj);
          load_4_columns<WIDTH<Particle>>(numbers(particle) + 4, j, pj + 4);
          for (int l = 0; l < LANES; l++) prefetch(particle + j[l + AHEAD]);
          const Vec dx = pi.x[0] - pj[0], dy = pi.x[1] - pj[1], dz = pi.x[2] - pj[2];
          const Vec ux = pi.u[0] - pj[3], uy = pi.u[1] - pj[4], uz = pi.u[2] - pj[5];
          const Vec flux = load(slope_of + k) * (dx * ux + dy * uy + dz * uz);
          if constexpr (WEIGHTED) {
            total -= gather(data.weight, j) * flux;
            add_column<WIDTH<DensitySum>>(cdot, j, -data.weight[i] * flux);
          } else {
            total -= flux;
            add_column<WIDTH<DensitySum>>(cdot, j, -flux);
          }
        }
        data.density[i].cdot += sum(total);
      }
    }

    // coefficients of the pair terms of a block of pairs

    struct Coeff {
      Vec along_r, along_u, xi1, xi2;

      SPH_INLINE Coeff(const PairCoeff &pair) :
          along_r(all(pair.along_r)), along_u(all(pair.along_u)), xi1(all(pair.xi1)),
          xi2(all(pair.xi2))
      {
      }
      SPH_INLINE void load(const LoopData &data, int i, const int *j, int n)
      {
        const PairCoeff *const coeff = data.coeff + data.type[i] * data.ntypes_1;
        double column[4][LANES];
        for (int l = 0; l < LANES; l++) {
          const PairCoeff &pair =
              coeff[(l < n) ? data.type[j[l]] : 1];    // a spare one has no type
          column[0][l] = pair.along_r;
          column[1][l] = pair.along_u;
          column[2][l] = pair.xi1;
          column[3][l] = pair.xi2;
        }
        along_r = LOOPS::load(column[0]);
        along_u = LOOPS::load(column[1]);
        xi1 = LOOPS::load(column[2]);
        xi2 = LOOPS::load(column[3]);
      }
    };

    inline void tally_block(PairTally *tally, int i, const int *j, int n, const Vec *f,
                            const Vec *r)
    {
      double f_lane[3][LANES], r_lane[3][LANES];
      for (int d = 0; d < 3; d++) {
        store(f_lane[d], f[d]);
        store(r_lane[d], r[d]);
      }
      for (int l = 0; l < LANES && l < n; l++) {
        const double force_on_i[3] = {f_lane[0][l], f_lane[1][l], f_lane[2][l]};
        const double rij[3] = {r_lane[0][l], r_lane[1][l], r_lane[2][l]};
        tally->tally(i, j[l], force_on_i, rij);
      }
    }

#include "sph_dissipation_noise_loops.h"

    // pass 2: pressure, shear and bulk forces and the heating of shear (half to each partner)
    // VOLUME: the bulk form P1 (64) with its own pair weights, and D_i = -sum_j V_j F r_ij.u_ij, by
    // which it heats; the form P1 (18) acts through g and heats by cdot
    // MICROPOLAR: torques, too; half of the torque of a pair force to each partner, P3 (12), (18)
    // Noise: random forces and torques of the pairs; Noise::ENERGY: what they do to the motion comes out of the heat

    template <Shear SHEAR, bool VOLUME, bool WEIGHTED, class Noise = NoNoise>
    void force_loop(LoopData &data)
    {
      constexpr bool SPIN = (SHEAR == Shear::MICROPOLAR);
      constexpr bool ALONG_R =
          (SHEAR == Shear::MG || SHEAR == Shear::MG_FR || SHEAR == Shear::ESPANOL || SPIN);
      constexpr bool ALONG_U = (SHEAR == Shear::MORRIS || SHEAR == Shear::ESPANOL || SPIN);

      const Particle *const particle = data.particle;
      Coeff coeff(data.coeff[data.ntypes_1 + 1]);
      Noise noise(data);

      for (int ii = 0; ii < data.inum; ii++) {
        const int i = data.ilist[ii];
        noise.begin(ii);
        const Particle pi = particle[i];
        const Spin spin_i = SPIN ? data.spin[i] : Spin();
        const double zeta_term_i = VOLUME ? data.zeta_term[i] : 0.0;
        const int n = data.count[ii];
        const int *const neighbor = data.neighbor + data.first[ii];
        const double *const slope_of = data.slope + data.first[ii];

        Vec total_f[4] = {all(0.0), all(0.0), all(0.0), all(0.0)};
        Vec total_t[4] = {all(0.0), all(0.0), all(0.0), all(0.0)};
        Vec total_spin = all(0.0), total_flux = all(0.0);

        for (int k = 0; k < n; k += LANES) {
          const int *const j = neighbor + k;
          Vec pj[8];
          load_4_columns<WIDTH<Particle>>(numbers(particle), j, pj);
          load_4_columns<WIDTH<Particle>>(numbers(particle) + 4, j, pj + 4);
          const Vec r[3] = {pi.x[0] - pj[0], pi.x[1] - pj[1], pi.x[2] - pj[2]};
          Vec u[3] = {pi.u[0] - pj[3], pi.u[1] - pj[4], pi.u[2] - pj[5]};
          const Vec vol = pj[6], g = pj[7];
          for (int l = 0; l < LANES; l++) {
            prefetch(particle + j[l + AHEAD]);
            if constexpr (SPIN) {    // without, the force is in the cache anyway
              prefetch(data.spin + j[l + AHEAD]);
              prefetch(data.force + j[l + AHEAD]);
              prefetch(data.torque + j[l + AHEAD]);
            }
          }
          const Vec slope = load(slope_of + k);
          const Vec rsq = dot(r, r);
          const Vec vv_slope = volumes_slope(rsq, pi.vol, vol, slope);
          const Vec approach = dot(r, u);
          Vec heat = all(0.0);
          Vec central = pressing_term(pi.g, g, slope), pressing = slope;
          if constexpr (WEIGHTED) {
            const Vec weights = data.weight[i] * gather(data.weight, j);
            central *= weights;
            pressing *= weights;
          }

          const Vec by_pressure = central;
          Vec given = all(0.0);    // heat, to i by j

          if ((ALONG_R || ALONG_U) && !data.uniform) coeff.load(data, i, j, n - k);

          const Vec metric = metric_of<SHEAR == Shear::MG_FR>(rsq);
          Vec by_metric = all(0.0), inverse = all(0.0);
          if constexpr (Noise::VECTOR) {
            inverse = 1.0 / (rsq + TINY);
            by_metric = vv_slope * inverse;
          } else if constexpr (ALONG_R || Noise::ON)
            by_metric = vv_slope / (metric + TINY);

          if constexpr (Noise::ON) {
            noise.draw(j, n - k, r[0], r[1], r[2], slope, vv_slope, metric, by_metric, inverse);
            central += noise.central;
          }
          Vec vv_drag = vv_slope, by_drag = by_metric;
          if constexpr (Noise::ENERGY) {
            vv_drag *= noise.friction;
            by_drag *= noise.friction;
          }

          if constexpr (ALONG_R) {
            const Vec drag = drag_along_r(coeff.along_r, by_drag, approach);
            central -= drag;
            heat = half_heat_along_r(drag, approach);
          }
          if constexpr (VOLUME) {
            central += volume_term(zeta_term_i, gather(data.zeta_term, j), vv_slope);
            const Vec flux = divergence_term(slope, approach);
            total_flux += flux * vol;
            add_column<1>(data.divergence, j, -pi.vol * flux);
          }
          Vec f[3] = {central * r[0], central * r[1], central * r[2]};
          if constexpr (Noise::ON) noise.add_force(f[0], f[1], f[2]);
          Vec w[4];
          if constexpr (SPIN) {
            load_4_columns<WIDTH<Spin>>(numbers(data.spin), j, w);
            slip_velocity(spin_i.w, w, r, u);
          }
          if constexpr (ALONG_U) {
            const Vec drag = coeff.along_u * vv_drag;
            const Vec half_drag = 0.5 * drag;
            add_drag_along_u(drag, u, f);
            const Vec heat_u = half_heat_along_u(half_drag, u);
            if constexpr (SPIN) {
              Vec t[3], spin[3];
              half_torque(half_drag, r, u, t);
              const Vec s[3] = {spin_i.w[0] - w[0], spin_i.w[1] - w[1], spin_i.w[2] - w[2]};
              const Vec along = dot(r, s);
              const Vec drag1 = drag_along_r(coeff.xi1, by_drag, along);
              const Vec drag2 = coeff.xi2 * vv_drag;
              spin_torque(drag1, drag2, r, s, spin);
              Vec heat_spin = half_heat_of_spins(drag1, drag2, along, s);
              if constexpr (Noise::ENERGY) heat_spin -= 0.5 * noise.spin_power(s[0], s[1], s[2]);
              if constexpr (Noise::ON) noise.add_torque(t, spin);
              if constexpr (Noise::ENERGY) given = noise.given_by_torque(t, spin);
              const Vec on_j[4] = {t[0] + spin[0], t[1] + spin[1], t[2] + spin[2], heat_u};
              add_4_columns<WIDTH<TorqueSum>>(numbers(data.torque), j, on_j);
              add_column<WIDTH<TorqueSum>>(numbers(data.torque) + 4, j, heat_spin);
              for (int d = 0; d < 3; d++) total_t[d] += t[d] - spin[d];
              total_t[3] += heat_u;
              total_spin += heat_spin;
            } else
              heat += heat_u;
          }

          for (int d = 0; d < 3; d++) total_f[d] += f[d];
          Vec heat_j = heat;
          if constexpr (Noise::ENERGY) {
            const Vec work = 0.5 * noise.power(approach, u[0], u[1], u[2]);
            const Vec viscous[3] = {f[0] - by_pressure * r[0], f[1] - by_pressure * r[1],
                                    f[2] - by_pressure * r[2]};
            given += noise.given(viscous, rsq, pressing);
            heat -= work - given;
            heat_j -= work + given;
          }
          total_f[3] += heat;
          const Vec on_j[4] = {-f[0], -f[1], -f[2], heat_j};
          add_4_columns<WIDTH<ForceSum>>(numbers(data.force), j, on_j);

          if (data.tally) tally_block(data.tally, i, j, n - k, f, r);
        }

        ForceSum &fi = data.force[i];
        for (int d = 0; d < 3; d++) fi.f[d] += sum(total_f[d]);
        fi.heat += sum(total_f[3]);
        if constexpr (SPIN) {
          TorqueSum &ti = data.torque[i];
          for (int d = 0; d < 3; d++) ti.t[d] += sum(total_t[d]);
          ti.heat_vortex += sum(total_t[3]);
          ti.heat_spin += sum(total_spin);
        }
        if constexpr (VOLUME) data.divergence[i] -= sum(total_flux);
      }
    }

    template <bool WEIGHTED> Loop choose_kernel(Kernel kernel)
    {
      switch (kernel) {
        case Kernel::WENDLAND_C4:
          return density_loop<WendlandC4, WEIGHTED>;
        case Kernel::WENDLAND_C6:
          return density_loop<WendlandC6, WEIGHTED>;
        case Kernel::CUBIC:
          return density_loop<CubicSpline, WEIGHTED>;
        case Kernel::QUINTIC:
          return density_loop<QuinticSpline, WEIGHTED>;
        case Kernel::LUCY:
          return density_loop<Lucy, WEIGHTED>;
        default:
          return density_loop<WendlandC2, WEIGHTED>;
      }
    }

    template <bool VOLUME, bool WEIGHTED> Loop choose_shear(Shear shear)
    {
      switch (shear) {
        case Shear::MG:
          return force_loop<Shear::MG, VOLUME, WEIGHTED>;
        case Shear::MG_FR:
          return force_loop<Shear::MG_FR, VOLUME, WEIGHTED>;
        case Shear::MORRIS:
          return force_loop<Shear::MORRIS, VOLUME, WEIGHTED>;
        case Shear::ESPANOL:
          return force_loop<Shear::ESPANOL, VOLUME, WEIGHTED>;
        case Shear::MICROPOLAR:
          return force_loop<Shear::MICROPOLAR, VOLUME, WEIGHTED>;
        default:
          return force_loop<Shear::NONE, VOLUME, WEIGHTED>;
      }
    }

    inline Loop choose_density_loop(Kernel kernel, Volume volume)
    {
      return (volume == Volume::MASS) ? choose_kernel<true>(kernel) : choose_kernel<false>(kernel);
    }

    inline Loop choose_rate_loop(Volume volume)
    {
      return (volume == Volume::MASS) ? rate_loop<true> : rate_loop<false>;
    }

    template <bool WEIGHTED> Loop choose_bulk(Shear shear, Bulk bulk)
    {
      return (bulk == Bulk::VOLUME) ? choose_shear<true, WEIGHTED>(shear)
                                    : choose_shear<false, WEIGHTED>(shear);
    }

    inline Loop choose_force_loop(Shear shear, Bulk bulk, Volume volume)
    {
      return (volume == Volume::MASS) ? choose_bulk<true>(shear, bulk)
                                      : choose_bulk<false>(shear, bulk);
    }

    // with noise: forms that only act along e, and all in one dimension, have no numbers across; there is no noise for
    // the bulk form volume

    template <Shear SHEAR, bool WEIGHTED, NoiseKind KIND> Loop choose_noise_of(int dim)
    {
      constexpr bool SPIN = (SHEAR == Shear::MICROPOLAR);
      if constexpr (SHEAR != Shear::MG && SHEAR != Shear::MG_FR) {
        if (dim == 3) return force_loop<SHEAR, false, WEIGHTED, PairNoise<3, SPIN, KIND>>;
        if (dim == 2 || SPIN) return force_loop<SHEAR, false, WEIGHTED, PairNoise<2, SPIN, KIND>>;
      }
      if constexpr (!SPIN) return force_loop<SHEAR, false, WEIGHTED, PairNoise<0, false, KIND>>;
    }

    template <bool WEIGHTED, NoiseKind KIND> Loop choose_noise(const NoiseForm &form)
    {
      switch (form.shear) {
        case Shear::MG_FR:
          return choose_noise_of<Shear::MG_FR, WEIGHTED, KIND>(form.dim);
        case Shear::MORRIS:
          return choose_noise_of<Shear::MORRIS, WEIGHTED, KIND>(form.dim);
        case Shear::ESPANOL:
          return choose_noise_of<Shear::ESPANOL, WEIGHTED, KIND>(form.dim);
        case Shear::MICROPOLAR:
          return choose_noise_of<Shear::MICROPOLAR, WEIGHTED, KIND>(form.dim);
        default:
          return choose_noise_of<Shear::MG, WEIGHTED, KIND>(form.dim);
      }
    }

    template <bool WEIGHTED> Loop choose_noise_kind(const NoiseForm &form)
    {
      switch (form.kind) {
        case NoiseKind::DIRECTED:
          return choose_noise<WEIGHTED, NoiseKind::DIRECTED>(form);
        case NoiseKind::ENERGY:
          return choose_noise<WEIGHTED, NoiseKind::ENERGY>(form);
        default:
          return choose_noise<WEIGHTED, NoiseKind::PLAIN>(form);
      }
    }

    inline Loop choose_noisy_force_loop(const NoiseForm &form, Volume volume)
    {
      return (volume == Volume::MASS) ? choose_noise_kind<true>(form)
                                      : choose_noise_kind<false>(form);
    }

    inline NoiseLoop choose_eta_loop(const NoiseForm &form)
    {
      if (form.shear == Shear::MG_FR) return eta_loop<true, 0>;
      if (form.shear == Shear::MG || form.dim == 1) return eta_loop<false, 0>;
      return (form.dim == 3) ? eta_loop<false, 3> : eta_loop<false, 2>;
    }

  }    // namespace LOOPS
}    // namespace SPHDissipation
}    // namespace LAMMPS_NS
