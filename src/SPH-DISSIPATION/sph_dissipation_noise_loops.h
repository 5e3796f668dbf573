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

// Thermal noise in loops over the pairs that pass 1 has found: sums before pass 2, and the random forces of pass 2.
// sph_dissipation_loops.h includes this file inside its namespace.

#include "sph_dissipation_noise_terms.h"

// Numbers of NoiseCoeff that a loop loads

template <int ACROSS, bool SPIN, NoiseKind KIND, bool BY_SQUARE> struct NoiseUses {
  static constexpr bool uses(int k)
  {
    if (k == CENTRAL_BY_SQUARE) return BY_SQUARE;
    if (k == INVERSE_CENTRAL) return KIND == NoiseKind::DIRECTED;
    if (k == PAIR_CONDUCTION) return KIND == NoiseKind::CONDUCTION;
    return k == CENTRAL || (k == TRANSVERSE && ACROSS > 0) || SPIN;
  }
};

// A pair with temp energy: the noise has the temperature 2 T_i T_j/(T_i + T_j), the friction the factor
// 1 - T_i T_j/(T_i + T_j)^2 (k/C_i + k/C_j), see the theory page

struct OwnTemperatures {
  Vec inverse, half_mean;
  SPH_INLINE OwnTemperatures(Vec own, Vec its)
  {
    inverse = 1.0 / (own + its + TINY);
    half_mean = own * its * inverse;
  }
  SPH_INLINE Vec of_noise() const { return half_mean + half_mean; }
  SPH_INLINE Vec friction(Vec softness) const    // sum of both k/C
  {
    return 1.0 - half_mean * inverse * softness;
  }
};

// Add eta_i c_i = sum_j c_i gamma_ij xi_ij to data.total, with the random number xi_ij that particle i has for the pair

template <bool FR, bool BY_SQUARE, int ACROSS>
void eta_loop(const LoopData &pairs, const NoiseData &data)
{
  const CoeffTable<NoiseCoeff> table(data.coeff, pairs);
  Coeffs<NoiseCoeff, NoiseUses<0, false, NoiseKind::DIRECTED, BY_SQUARE>> coeff(table);
  const NoiseStep step(data);
  for (int ii = 0; ii < pairs.inum; ii++) {
    const int i = pairs.ilist[ii];
    const Particle &pi = pairs.particle[i];
    const int n = pairs.count[ii];
    const Offset *const neighbor = pairs.neighbor + pairs.first[ii];
    const double *const slope_of = pairs.slope + pairs.first[ii];
    Vec total = all(0.0);
    for (int k = 0; k < n; k += LANES) {
      const Offset *const j = neighbor + k;
      Vec pj[4];
      load_4_columns<WIDTH<Particle>>(numbers(pairs.particle), j, pj);
      const Vec dx = pi.x[0] - pj[0], dy = pi.x[1] - pj[1], dz = pi.x[2] - pj[2];
      const Vec rsq = dx * dx + dy * dy + dz * dz;
      const Vec metric = metric_of<FR>(rsq);
      if (!pairs.par->uniform) coeff.load(table, i, j);
      const Vec tag = gather(data.tag, j);
      Words word[1][4];
      set_counter(word[0], step, data.tag[i], tag);
      philox<1>(word, step.pair);
      using Numbers = PairNumbers<ACROSS, false, true>;
      const Vec sign = sign_of(data.tag[i], tag);
      const Numbers random(word[0], sign);
      const Vec forth = random.z[Numbers::ALONG], back = random.z[Numbers::BACK];
      const Vec mean = 0.5 * (forth + back);
      const Vec odd = 0.5 * sign * (forth - back);
      const Vec root = root_of<BY_SQUARE>(data, coeff.a, load(slope_of + k), metric);
      total += gather(data.reach, j) * root * (mean + odd);
      add_column<1>(data.total, j, data.reach[i] * root * (mean - odd));
    }
    data.total[i] += sum(total);
  }
}

// Pass 2 without noise

struct NoNoise {
  static constexpr bool ON = false, VECTOR = false, ENERGY = false, CONDUCTS = false;
  struct Table {
    SPH_INLINE Table(const LoopData &) {}
  };
  SPH_INLINE NoNoise(const LoopData &, const Table &) {}
  SPH_INLINE void begin(int) {}
};

// Noise of pass 2.  begin() draws the random numbers of all pairs of a particle, for two blocks of pairs at once: so the
// long chains of operations of two blocks overlap.  draw() then sets the noise of one block.

template <int ACROSS, bool SPIN, NoiseKind KIND, bool BY_SQUARE>
struct PairNoise : RandomForce<ACROSS, SPIN, KIND == NoiseKind::DIRECTED, BY_SQUARE> {
  static constexpr bool ON = true, VECTOR = (ACROSS == 3), CENTRAL_ONLY = (ACROSS == 0);
  static constexpr bool DIRECTED = (KIND == NoiseKind::DIRECTED);
  static constexpr bool CONDUCTS = (KIND == NoiseKind::CONDUCTION);
  static constexpr bool ENERGY = (KIND == NoiseKind::ENERGY || CONDUCTS);
  using Force = RandomForce<ACROSS, SPIN, DIRECTED, BY_SQUARE>;
  using Force::central;
  using Force::rest;
  using Force::spin;

  Vec friction;    // factor of the friction of the pair, if ENERGY
  Vec flow;        // heat that i gets from j per time, if CONDUCTS
  Vec wall;        // if CONDUCTS: 1 where j belongs to a wall, -1 where i does, else 0

  struct Table : CoeffTable<NoiseCoeff> {
    Table(const LoopData &pairs) : CoeffTable(pairs.noise->coeff, pairs) {}
  };
  SPH_INLINE PairNoise(const LoopData &pairs, const CoeffTable<NoiseCoeff> &table) :
      pairs(pairs), data(*pairs.noise), step(data), table(table), coeff(table)
  {
  }
  SPH_INLINE void begin(int ii)
  {
    i = pairs.ilist[ii];
    const int n = pairs.count[ii];
    const Offset *const neighbor = pairs.neighbor + pairs.first[ii];
    next = pairs.random;
    int k = 0;
    for (; k + LANES < n; k += 2 * LANES) keep_numbers<2>(neighbor + k);
    if (k < n) keep_numbers<1>(neighbor + k);
    next_number = pairs.random;
    if constexpr (ENERGY) {
      double *const first = next;
      for (k = 0; k < n; k += LANES) keep_temperatures(neighbor + k);
      next = first;
    }
  }

  // Set the noise of a block of pairs; d = r_ij, by_metric = vv/metric, inverse = 1/r^2 if VECTOR

  SPH_INLINE void draw(const Offset *j, Vec dx, Vec dy, Vec dz, Vec slope, Vec vv, Vec metric,
                       Vec by_metric, Vec inverse)
  {
    if (!pairs.par->uniform) coeff.load(table, i, j);
    Vec z[Numbers::N];
    for (int c = 0; c < Numbers::N; c++)
      if (Numbers::is_used(c)) z[c] = kept(next_number);
    if constexpr (CONDUCTS) {
      const double own = std::fabs(data.row[i].temperature);
      const Vec temperature = kept(next);
      const Vec conductivity = coeff.a[PAIR_CONDUCTION] * kept(next);
      wall = kept(next);
      flow = flow_of_pair(conductivity, vv, own, temperature) +
          z[Numbers::FLOW] *
              square_root(data.heat * heat_noise(conductivity, vv, own, temperature));
    }
    if constexpr (ENERGY) {
      const Vec common = kept(next);
      friction = kept(next);
      pressure = kept(next);
      if constexpr (SPIN) spin_mobility = kept(next);
      mobility = data.unequal ? kept(next) : all(data.mobility[i]);
      vv *= common;
      by_metric *= common;
    }

    Vec along = all(0.0);
    if constexpr (DIRECTED || !VECTOR) along = z[Numbers::ALONG];
    if constexpr (DIRECTED) {
      const Vec root = root_of<BY_SQUARE>(data, coeff.a, slope, metric);
      along += z[Numbers::BACK] -
          root * (gather(data.reach, j) * data.share[i] + data.reach[i] * gather(data.share, j));
    }
    Force::set(coeff.a, z, along, dx, dy, dz, vv, metric, by_metric, inverse);
  }

  // Return the power of the noise; u = relative velocity at the point of contact, s = difference of the spins

  SPH_INLINE Vec power(Vec approach, Vec ux, Vec uy, Vec uz) const
  {
    Vec sum = central * approach;
    if constexpr (ACROSS > 0) sum += rest[0] * ux + rest[1] * uy;
    if constexpr (VECTOR) sum += rest[2] * uz;
    return sum;
  }
  SPH_INLINE Vec spin_power(Vec sx, Vec sy, Vec sz) const
  {
    Vec sum = spin[2] * sz;
    if constexpr (VECTOR) sum += spin[0] * sx + spin[1] * sy;
    return sum;
  }

  // Return the heat that i gets from j, averaged over the noise.  The integrator takes the kinetic energy that a particle
  // gets by the impulses of a step from the heat of the particle.  With this heat, each partner pays half for the
  // impulses of the pair, and a particle pays all for its random pressure.  square = random force times (random force +
  // friction) of the pair; pressing = force over r, per P/c^2.  work_loop(): for friction and pressures without noise.

  SPH_INLINE Vec given(Vec square, Vec rsq, Vec pressing) const
  {
    const NoiseRow &own = data.row[i];
    const Vec by_i = own.pressure * pressing, by_j = pressure * pressing;
    const Vec heat = 0.5 * rsq * (by_j * by_j * data.mobility[i] - by_i * by_i * mobility);
    return data.unequal ? heat + 0.25 * square * (data.mobility[i] - mobility) : heat;
  }

  // Return the same heat for the torques, see add_torque()

  SPH_INLINE Vec given_by_torque(const Vec *on_both, const Vec *on_j) const
  {
    Vec square_i = all(0.0), square_j = all(0.0);
    for (int k = VECTOR ? 0 : 2; k < 3; k++) {
      const Vec torque_i = on_both[k] - on_j[k], torque_j = on_both[k] + on_j[k];
      square_i += torque_i * torque_i;
      square_j += torque_j * torque_j;
    }
    return 0.25 * (square_i * data.row[i].spin_mobility - square_j * spin_mobility);
  }

 private:
  using Numbers = PairNumbers<ACROSS, SPIN, DIRECTED, CONDUCTS>;
  const LoopData &pairs;
  const NoiseData &data;
  const NoiseStep step;
  const CoeffTable<NoiseCoeff> &table;
  Coeffs<NoiseCoeff, NoiseUses<ACROSS, SPIN, KIND, BY_SQUARE>> coeff;
  int i;
  double *next_number, *next;               // next values that begin() has kept for the pairs of i
  Vec mobility, pressure, spin_mobility;    // of j

  // Draw the random numbers of N blocks, and keep them

  template <int N> SPH_INLINE void keep_numbers(const Offset *j)
  {
    Words word[N][4];
    Vec sign[N];
    for (int k = 0; k < N; k++) {
      const Vec tag = gather(data.tag, j + k * LANES);
      set_counter(word[k], step, data.tag[i], tag);
      sign[k] = sign_of(data.tag[i], tag);
    }
    philox<N>(word, step.pair);
    for (int k = 0; k < N; k++) {
      const Numbers random(word[k], sign[k]);
      for (int c = 0; c < Numbers::N; c++)
        if (Numbers::is_used(c)) keep(random.z[c]);
    }
  }

  // Keep the temperatures of a block.  Friction with a wall has temperature and heat of the fluid particle alone.

  SPH_INLINE void keep_temperatures(const Offset *j)
  {
    Vec other[WIDTH<NoiseRow>];
    load_4_columns<WIDTH<NoiseRow>>(numbers(data.row), j, other);
    Vec own = all(data.row[i].temperature), its = other[NoiseRow::TEMPERATURE],
        with_wall = all(0.0);
    if constexpr (CONDUCTS) {
      keep(larger(its, -its));
      if (data.row[i].temperature < 0.0) {
        keep(all(data.row[i].pressure));
        with_wall = all(-1.0);
        own = its;
      } else {
        with_wall = if_positive(-its, all(1.0));
        keep(1.0 - with_wall + with_wall * other[NoiseRow::PRESSURE]);
        its = (1.0 - with_wall) * its + with_wall * own;
      }
      keep(with_wall);
    }
    const OwnTemperatures both(own, its);
    keep(both.of_noise());
    Vec softness = data.row[i].softness + other[NoiseRow::SOFTNESS];
    if constexpr (CONDUCTS) softness *= 1.0 - with_wall * with_wall;
    keep(both.friction(softness));
    keep(other[NoiseRow::PRESSURE]);
    if constexpr (SPIN) keep(other[NoiseRow::SPIN_MOBILITY]);
    if (data.unequal) keep(gather(data.mobility, j));
  }

  SPH_INLINE void keep(Vec a)
  {
    store(next, a);
    next += LANES;
  }
  static SPH_INLINE Vec kept(double *&from)
  {
    from += LANES;
    return load(from - LANES);
  }
};

// Draw count random numbers for each of the particles from ... to - 1 of n, rounded up to whole vectors of particles; number
// c of particle k is numbers[c * (n + BLOCK) + k]

inline void particle_numbers(const NoiseData &data, NoiseChannel channel, int from, int to, int n,
                             int count, double *numbers)
{
  const NoiseStep step(data);
  const PhiloxKeys keys = NoiseStep::keys_of(data, channel);
  for (int k = from; k < to; k += LANES) {
    Words counter[1][4];
    draw_for_particle(counter, step, keys, load(data.tag + k));
    for (int c = 0; c < count; c++)
      store(numbers + c * static_cast<bigint>(n + BLOCK) + k, uniform(counter[0][c], all(1.0)));
  }
}
