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

// The loops over pairs of fluid and boundary particles; sph_dissipation_loops.h includes this file inside its namespace.

#include "sph_dissipation_boundary_terms.h"

// Load r = x_w - x_f of a block of pairs; r[3] = the number behind x in the rows

SPH_INLINE void load_r(const Particle &wall, const Particle *particle, const Offset *j, Vec *r)
{
  load_4_columns<WIDTH<Particle>>(numbers(particle), j, r);
  for (int d = 0; d < 3; d++) r[d] = wall.x[d] - r[d];
}

// Load W of a block of pairs

template <class K> SPH_INLINE Vec load_weight(const Parameters &par, const double *distance)
{
  return par.weight_norm * K::shape(smaller(load(distance) * (1.0 / par.support), all(1.0)));
}

// Find the pairs inside the support among all candidates

template <class K> void boundary_pairs_loop(const LoopData &data, BoundaryRows &rows)
{
  const Parameters &par = *data.par;
  const double slope_norm = par.slope_norm, support_inv = 1.0 / par.support;
  const Vec support_sq = all(par.support * par.support);
  const bool copies = !rows.candidate_copy.empty();

  for (int m = 0; m < rows.size(); m++) {
    const Particle &wall = data.particle[rows.wall[m]];
    const bigint first = rows.first[m];
    bigint next = first;

    for (bigint k = first; k < rows.first[m + 1]; k += LANES) {
      const Offset *const j = &rows.candidate[k];
      Vec r[4];
      load_r(wall, data.particle, j, r);
      const Vec rsq = dot(r, r), distance = square_root(rsq);
      const int inside = bits_below(rsq, support_sq);
      if (!inside) continue;
      const Vec slope = slope_norm * K::slope(smaller(distance * support_inv, all(1.0)));
      pack(&rows.distance[next], distance, inside);
      pack(&rows.slope[next], slope, inside);
      pack(&rows.fluid[next], j, inside);
      if (copies) pack(&rows.copy[next], &rows.candidate_copy[k], inside);
      next += count_bits(inside);
    }
    rows.count[m] = static_cast<int>(next - first);
    store(&rows.distance[next], all(par.support));
    store(&rows.slope[next], all(0.0));
    for (int l = 0; l < LANES; l++) {
      rows.fluid[next + l] = rows.candidate[first];
      if (copies) rows.copy[next + l] = offset_of(l);
    }
  }
}

// Add the parts of the NearKernel supports of fluid particles that boundary particles fill

template <class K>
void filled_loop(const BoundaryRows &rows, const NearKernel *near, double *filled)
{
  for (int m = 0; m < rows.size(); m++) {
    const NearKernel wall = near[rows.wall[m]];
    const bigint first = rows.first[m];
    for (bigint k = first; k < first + rows.count[m]; k += LANES) {
      double part[LANES];
      store(part, part_filled<K>(wall, load(&rows.distance[k])));
      for (int l = 0; l < LANES && k + l < first + rows.count[m]; l++)
        filled[index_of(rows.fluid[k + l])] += part[l];
    }
  }
}

// Sums of BoundarySum

struct OneVector {
  typedef Vec type;
};

struct FluidColumns {
  Vec u[3], vol, g;
};

template <class Sums> SPH_INLINE void add_sums(const Sums &total, double *to, int n)
{
  for (int c = 0; c < n; c++) to[c] += sum(reinterpret_cast<const Vec *>(&total)[c]);
}

template <class K, bool SPINS>
void boundary_sum_loop(const LoopData &data, const BoundaryRows &rows, const BoundarySumData &to)
{
  for (int m = 0; m < rows.size(); m++) {
    const int i = rows.wall[m];
    if (!(to.mask[i] & to.bits)) continue;
    const Particle wall = data.particle[i];
    const Surface surface = to.surface[i];
    const bigint first = rows.first[m];
    BoundarySums<OneVector> total = {};

    for (bigint k = first; k < first + rows.count[m]; k += LANES) {
      const Offset *const j = &rows.fluid[k];
      Vec r[4], other[4];
      load_r(wall, data.particle, j, r);
      load_4_columns<WIDTH<Particle>>(numbers(data.particle) + 4, j, other);
      const FluidColumns fluid = {{r[3], other[0], other[1]}, other[2], other[3]};
      const Vec kernel_weight = load_weight<K>(*data.par, &rows.distance[k]);
      const Vec w = data.weight ? gather(data.weight, j) : all(1.0);
      const Vec height =
          add_fluid(fluid, wall, r, kernel_weight, surface, gather(to.rho, j), w,
                    gather(to.reference_volume, j), gather(data.zeta_term, j), total);
      if constexpr (SPINS) {
        Vec spin[4];
        load_4_columns<WIDTH<Spin>>(numbers(data.spin), j, spin);
        add_fluid_spin(spin, fluid.vol * kernel_weight, height, surface, total);
      }
    }
    add_sums(total, numbers(&to.sum[i]), WIDTH<BoundarySum> - (SPINS ? 0 : BoundarySum::OF_SPIN));
  }
}

// Sums of BoundaryHeatSum

struct FlowColumns {
  Vec vol, value, coefficient;
};

template <class K>
void boundary_heat_loop(const LoopData &data, const BoundaryRows &rows, const BoundaryHeatData &to)
{
  for (int m = 0; m < rows.size(); m++) {
    const int i = rows.wall[m];
    const Particle wall = data.particle[i];
    const Surface surface = to.surface[i];
    const double coefficient = to.coefficient[to.type[i]];
    const bigint first = rows.first[m];
    BoundaryHeatSums<OneVector> total = {};

    for (bigint k = first; k < first + rows.count[m]; k += LANES) {
      const Offset *const j = &rows.fluid[k];
      Vec r[4], state[2], flow[4];
      load_r(wall, data.particle, j, r);
      load_2_columns<WIDTH<Particle>>(numbers(data.particle) + 6, j, state);    // volume and g
      load_4_columns<WIDTH<FlowRow>>(numbers(to.flow), j, flow);
      const Vec weight = state[0] * load_weight<K>(*data.par, &rows.distance[k]);
      add_fluid_heat(FlowColumns{flow[0], flow[1], flow[2]}, weight, load(&rows.slope[k]),
                     height_above(surface, r), coefficient, total);
    }
    add_sums(total, numbers(&to.sum[i]), WIDTH<BoundaryHeatSum>);
  }
}

// Set slope = F (surface_factor() - less) of the pairs in some of the rows

inline void surface_slope_loop(const LoopData &data, const BoundaryRows &rows,
                               const std::vector<int> &some, const Surface *surfaces, double less,
                               double *slope)
{
  for (const int m : some) {
    const Particle &wall = data.particle[rows.wall[m]];
    const Surface surface = surfaces[rows.wall[m]];
    const bigint first = rows.first[m];
    for (bigint k = first; k < first + rows.count[m]; k += LANES) {
      Vec r[4];
      load_r(wall, data.particle, &rows.fluid[k], r);
      const Vec factor = surface_factor(surface, r, data.par->support);
      store(slope + k, load(&rows.slope[k]) * (factor - less));
    }
  }
}

inline BoundaryLoops choose_boundary_loops(Kernel kernel)
{
  return LOOPS::with_kernel(kernel, [](auto k) -> BoundaryLoops {
    using K = decltype(k);
    return {boundary_pairs_loop<K>,
            filled_loop<K>,
            {boundary_sum_loop<K, false>, boundary_sum_loop<K, true>},
            boundary_heat_loop<K>};
  });
}
