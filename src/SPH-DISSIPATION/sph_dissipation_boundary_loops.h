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

// The loops over pairs of the fluid and boundary particles; compiled as sph_dissipation_loops.h, which includes this file inside
// its namespace.

#include "sph_dissipation_boundary_terms.h"

// of all candidates the pairs inside the support

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
      const int *const j = &rows.candidate[k];
      Vec r[4];
      load_4_columns<WIDTH<Particle>>(numbers(data.particle), j, r);
      for (int d = 0; d < 3; d++) r[d] = wall.x[d] - r[d];
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
      if (copies) rows.copy[next + l] = l;
    }
  }
}

// what they fill of the supports of NearKernel around particles of the fluid

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
        filled[rows.fluid[k + l]] += part[l];
    }
  }
}

// the sums of BoundarySum

struct OneVector {
  typedef Vec type;
};

struct FluidColumns {
  Vec x[3], u[3], vol, g;
};

SPH_INLINE FluidColumns load_fluid(const Particle *particle, const int *j)
{
  Vec p[8];
  load_4_columns<WIDTH<Particle>>(numbers(particle), j, p);
  load_4_columns<WIDTH<Particle>>(numbers(particle) + 4, j, p + 4);
  return {{p[0], p[1], p[2]}, {p[3], p[4], p[5]}, p[6], p[7]};
}

template <class Sums> SPH_INLINE void add_sums(const Sums &total, double *to, int n)
{
  for (int c = 0; c < n; c++) to[c] += sum(reinterpret_cast<const Vec *>(&total)[c]);
}

template <class K, bool SPINS>
void boundary_sum_loop(const LoopData &data, const BoundaryRows &rows, const BoundarySumData &to)
{
  const double weight_norm = data.par->weight_norm, support_inv = 1.0 / data.par->support;

  for (int m = 0; m < rows.size(); m++) {
    const int i = rows.wall[m];
    if (!(to.mask[i] & to.bits)) continue;
    const Particle wall = data.particle[i];
    const Surface surface = to.surface[i];
    const bigint first = rows.first[m];
    BoundarySums<OneVector> total = {};

    for (bigint k = first; k < first + rows.count[m]; k += LANES) {
      const int *const j = &rows.fluid[k];
      const FluidColumns fluid = load_fluid(data.particle, j);
      const Vec r[3] = {wall.x[0] - fluid.x[0], wall.x[1] - fluid.x[1], wall.x[2] - fluid.x[2]};
      const Vec q = smaller(load(&rows.distance[k]) * support_inv, all(1.0));
      const Vec kernel_weight = weight_norm * K::shape(q);
      const Vec w = data.weight ? gather(data.weight, j) : all(1.0);
      const Vec height = add_fluid(fluid, wall, r, kernel_weight, surface, gather(to.rho, j), w,
                                   gather(data.zeta_term, j), total);
      if constexpr (SPINS) {
        Vec spin[4];
        load_4_columns<WIDTH<Spin>>(numbers(data.spin), j, spin);
        add_fluid_spin(spin, fluid.vol * kernel_weight, height, surface, total);
      }
    }
    add_sums(total, numbers(&to.sum[i]), WIDTH<BoundarySum> - (SPINS ? 0 : BoundarySum::OF_SPIN));
  }
}

// those of BoundaryHeatSum

struct FlowColumns {
  Vec vol, value, coefficient;
};

template <class K>
void boundary_heat_loop(const LoopData &data, const BoundaryRows &rows, const BoundaryHeatData &to)
{
  const double weight_norm = data.par->weight_norm, support_inv = 1.0 / data.par->support;

  for (int m = 0; m < rows.size(); m++) {
    const int i = rows.wall[m];
    const Particle wall = data.particle[i];
    const Surface surface = to.surface[i];
    const double coefficient = to.coefficient[to.type[i]];
    const bigint first = rows.first[m];
    BoundaryHeatSums<OneVector> total = {};

    for (bigint k = first; k < first + rows.count[m]; k += LANES) {
      const int *const j = &rows.fluid[k];
      const FluidColumns fluid = load_fluid(data.particle, j);
      const Vec r[3] = {wall.x[0] - fluid.x[0], wall.x[1] - fluid.x[1], wall.x[2] - fluid.x[2]};
      const Vec q = smaller(load(&rows.distance[k]) * support_inv, all(1.0));
      Vec flow[4];
      load_4_columns<WIDTH<FlowRow>>(numbers(to.flow), j, flow);
      add_fluid_heat(FlowColumns{flow[0], flow[1], flow[2]},
                     Vec(fluid.vol * weight_norm * K::shape(q)), load(&rows.slope[k]),
                     height_above(surface, r), coefficient, total);
    }
    add_sums(total, numbers(&to.sum[i]), WIDTH<BoundaryHeatSum>);
  }
}

// F times surface_factor() less a number, of some of the rows

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
      load_4_columns<WIDTH<Particle>>(numbers(data.particle), &rows.fluid[k], r);
      for (int d = 0; d < 3; d++) r[d] = wall.x[d] - r[d];
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
