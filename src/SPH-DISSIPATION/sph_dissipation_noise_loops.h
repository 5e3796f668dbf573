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

// The loops of the thermal noise, over the pairs that pass 1 has found; compiled as
// sph_dissipation_loops.h, which includes this file inside its namespace.

#include "sph_dissipation_random.h"

// Numbers of a pair, each from the normal distribution:
//   forms along e only: 0 = along e, 1 = back
//   2d: 0 = along e, 1 = across e, 2 = spin, 3 = back
//   3d: 0 = along e, 1 to 3 = vector; more: 0 to 2 = vector of the spin, 3 = back
// "Back" is the number of the particle with the higher ID, if each of both has its own along e, then
// "along e" is that of the other one.  Vectors are those of the particle with the lower ID, and
// opposite for the other one; numbers along and across e need no sign, since e_ji = -e_ij.

struct PairCounter {
  Words word[4];
  Words high;    // bits of both IDs above 32
  Vec sign;      // 1 where i has the lower ID, else -1

  SPH_INLINE PairCounter(const NoiseData &data, int i, const int *j)
  {
    std::uint64_t low[LANES], up[LANES];
    double lane_sign[LANES];
    const std::uint64_t tag_i = data.tag[i];
    for (int l = 0; l < LANES; l++) {
      const std::uint64_t tag_j = data.tag[j[l]];
      low[l] = (tag_i < tag_j) ? tag_i : tag_j;
      up[l] = (tag_i < tag_j) ? tag_j : tag_i;
      lane_sign[l] = (tag_i < tag_j) ? 1.0 : -1.0;
    }
    word[0] = load_words(low);
    word[1] = load_words(up);
    word[2] = all_words(data.step & 0xffffffff);
    word[3] = all_words(data.step >> 32);
    high = pair_of_high(shifted<32>(word[0]), shifted<32>(word[1]));
    sign = load(lane_sign);
  }

  // IDs have at most 46 bits: 14 above 32 of each, next to each other

  static SPH_INLINE Words pair_of_high(Words low, Words up)
  {
    return low ^ product(up, all_words(1 << 14));
  }
};

SPH_INLINE void random_words(const NoiseData &data, const Words *counter, Words high,
                             NoiseChannel channel, Words *random)
{
  const Words in_channel = all_words(static_cast<std::uint64_t>(channel) << 28);
  philox(counter, all_words(data.seed), high ^ in_channel, random);
}

// the two numbers along e: sum, and those of i and of j

template <int TRANSVERSE> struct AlongNumbers {
  Vec forth, back;

  SPH_INLINE AlongNumbers(const NoiseData &data, const PairCounter &counter)
  {
    Words random[4];
    Vec unused;
    random_words(data, counter.word, counter.high, NoiseChannel::PAIR, random);
    normal_pair(random[0], random[1], forth, back);
    if constexpr (TRANSVERSE == 2) normal_pair(random[2], random[3], unused, back);
    if constexpr (TRANSVERSE == 3) {
      random_words(data, counter.word, counter.high, NoiseChannel::PAIR_MORE, random);
      normal_pair(random[2], random[3], unused, back);
    }
  }
};

struct NoiseCoeffs {
  Vec central, transverse, spin_along, spin_across, inverse_central;

  SPH_INLINE NoiseCoeffs(const NoiseCoeff &pair) :
      central(all(pair.central)), transverse(all(pair.transverse)),
      spin_along(all(pair.spin_along)), spin_across(all(pair.spin_across)),
      inverse_central(all(pair.inverse_central))
  {
  }
  SPH_INLINE void load(const LoopData &pairs, const NoiseData &data, int i, const int *j, int n)
  {
    const NoiseCoeff *const coeff = data.coeff + data.type[i] * pairs.ntypes_1;
    double column[5][LANES];
    for (int l = 0; l < LANES; l++) {
      const NoiseCoeff &pair = coeff[(l < n) ? data.type[j[l]] : 1];    // a spare one has no type
      column[0][l] = pair.central;
      column[1][l] = pair.transverse;
      column[2][l] = pair.spin_along;
      column[3][l] = pair.spin_across;
      column[4][l] = pair.inverse_central;
    }
    central = LOOPS::load(column[0]);
    transverse = LOOPS::load(column[1]);
    spin_along = LOOPS::load(column[2]);
    spin_across = LOOPS::load(column[3]);
    inverse_central = LOOPS::load(column[4]);
  }
};

SPH_INLINE void gather_shares(const NoiseData &data, const int *j, Vec &reach, Vec &share)
{
  double lane[2][LANES];
  for (int l = 0; l < LANES; l++) {
    lane[0][l] = data.share[j[l]].reach;
    lane[1][l] = data.share[j[l]].share;
  }
  reach = load(lane[0]);
  share = load(lane[1]);
}

// gamma_ij = root times reach of j over c of i

template <bool FR> SPH_INLINE Vec root_of(Vec slope, Vec rsq, Vec inverse_central)
{
  const Vec metric = FR ? square_root(rsq) : rsq;
  return square_root(slope * metric * inverse_central);
}

// eta_i c_i = sum_j c_i gamma_ij xi_ij with the number xi_ij of i

template <bool FR, int TRANSVERSE> void eta_loop(const LoopData &pairs, const NoiseData &data)
{
  const Particle *const particle = pairs.particle;
  NoiseCoeffs coeff(data.coeff[pairs.ntypes_1 + 1]);
  for (int ii = 0; ii < pairs.inum; ii++) {
    const int i = pairs.ilist[ii];
    const Particle pi = particle[i];
    const int n = pairs.count[ii];
    const int *const neighbor = pairs.neighbor + pairs.first[ii];
    const double *const slope_of = pairs.slope + pairs.first[ii];
    Vec total = all(0.0);
    for (int k = 0; k < n; k += LANES) {
      const int *const j = neighbor + k;
      Vec pj[4], reach, share;
      load_4_columns<WIDTH<Particle>>(numbers(particle), j, pj);
      const Vec dx = pi.x[0] - pj[0], dy = pi.x[1] - pj[1], dz = pi.x[2] - pj[2];
      const Vec rsq = dx * dx + dy * dy + dz * dz;
      if (!pairs.uniform) coeff.load(pairs, data, i, j, n - k);
      const PairCounter counter(data, i, j);
      const AlongNumbers<TRANSVERSE> along(data, counter);
      const Vec mean = 0.5 * (along.forth + along.back);
      const Vec odd = 0.5 * counter.sign * (along.forth - along.back);
      const Vec root = root_of<FR>(load(slope_of + k), rsq, coeff.inverse_central);
      gather_shares(data, j, reach, share);
      total += reach * root * (mean + odd);
      add_column<1>(data.eta, j, data.share[i].reach * root * (mean - odd));
    }
    data.eta[i] += sum(total);
  }
}

// random forces and torques of the pairs, onto the sums of both particles

template <bool FR, int TRANSVERSE, bool SPIN, bool DIRECTED>
void impulse_loop(const LoopData &pairs, const NoiseData &data)
{
  const Particle *const particle = pairs.particle;
  NoiseCoeffs coeff(data.coeff[pairs.ntypes_1 + 1]);
  for (int ii = 0; ii < pairs.inum; ii++) {
    const int i = pairs.ilist[ii];
    const Particle pi = particle[i];
    const int n = pairs.count[ii];
    const int *const neighbor = pairs.neighbor + pairs.first[ii];
    const double *const slope_of = pairs.slope + pairs.first[ii];
    Vec total_f[3] = {all(0.0), all(0.0), all(0.0)};
    Vec total_t[3] = {all(0.0), all(0.0), all(0.0)};

    for (int k = 0; k < n; k += LANES) {
      const int *const j = neighbor + k;
      Vec pj[8];
      load_4_columns<WIDTH<Particle>>(numbers(particle), j, pj);
      load_4_columns<WIDTH<Particle>>(numbers(particle) + 4, j, pj + 4);
      const Vec dx = pi.x[0] - pj[0], dy = pi.x[1] - pj[1], dz = pi.x[2] - pj[2];
      const Vec rsq = dx * dx + dy * dy + dz * dz;
      const Vec slope = load(slope_of + k);
      const Vec vv_slope = if_positive(rsq, pi.vol * pj[6] * slope);
      const Vec vv = FR ? vv_slope * square_root(rsq) : vv_slope;
      const Vec by_r = square_root(vv / (rsq + TINY));    // strength of the pair over r
      if (!pairs.uniform) coeff.load(pairs, data, i, j, n - k);

      Words random[4];
      Vec number_of[4];
      const PairCounter counter(data, i, j);
      random_words(data, counter.word, counter.high, NoiseChannel::PAIR, random);
      normal_pair(random[0], random[1], number_of[0], number_of[1]);
      if constexpr (TRANSVERSE) normal_pair(random[2], random[3], number_of[2], number_of[3]);
      Vec back = number_of[TRANSVERSE ? 3 : 1];

      Vec more[4];
      if constexpr (TRANSVERSE == 3 && (SPIN || DIRECTED)) {
        random_words(data, counter.word, counter.high, NoiseChannel::PAIR_MORE, random);
        normal_pair(random[0], random[1], more[0], more[1]);
        normal_pair(random[2], random[3], more[2], more[3]);
        back = more[3];
      }

      Vec along = number_of[0];
      if constexpr (DIRECTED) {
        Vec reach, share;
        gather_shares(data, j, reach, share);
        const Vec root = root_of<FR>(slope, rsq, coeff.inverse_central);
        const NoiseShare &own = data.share[i];
        along += back - root * (reach * own.share + own.reach * share);
      }
      const Vec central = coeff.central * by_r * along;
      Vec fx = central * dx, fy = central * dy, fz = central * dz;
      Vec tx = all(0.0), ty = all(0.0), tz = all(0.0);    // same on both
      Vec sx = all(0.0), sy = all(0.0), sz = all(0.0);    // opposite
      if constexpr (TRANSVERSE == 2) {
        const Vec across = coeff.transverse * by_r * number_of[1];
        fx -= across * dy;
        fy += across * dx;
        if constexpr (SPIN) sz = counter.sign * coeff.spin_across * square_root(vv) * number_of[2];
      }
      if constexpr (TRANSVERSE == 3) {
        const Vec inverse_rsq = 1.0 / (rsq + TINY);
        const Vec strength = counter.sign * square_root(vv);
        const Vec *const v = number_of + 1;
        const Vec across = strength * coeff.transverse;
        const Vec part = (dx * v[0] + dy * v[1] + dz * v[2]) * inverse_rsq;
        fx += across * (v[0] - part * dx);
        fy += across * (v[1] - part * dy);
        fz += across * (v[2] - part * dz);
        if constexpr (SPIN) {
          const Vec spin_part = (dx * more[0] + dy * more[1] + dz * more[2]) * inverse_rsq;
          const Vec spin_across = strength * coeff.spin_across;
          const Vec remainder = (strength * coeff.spin_along - spin_across) * spin_part;
          sx = spin_across * more[0] + remainder * dx;
          sy = spin_across * more[1] + remainder * dy;
          sz = spin_across * more[2] + remainder * dz;
        }
      }
      if constexpr (SPIN) {
        tx = -0.5 * (dy * fz - dz * fy);
        ty = -0.5 * (dz * fx - dx * fz);
        tz = -0.5 * (dx * fy - dy * fx);
        total_t[0] += tx + sx;
        total_t[1] += ty + sy;
        total_t[2] += tz + sz;
        const Vec on_j[4] = {tx - sx, ty - sy, tz - sz, all(0.0)};
        add_4_columns<WIDTH<TorqueSum>>(numbers(data.torque), j, on_j);
      }
      total_f[0] += fx;
      total_f[1] += fy;
      total_f[2] += fz;
      const Vec on_j[4] = {-fx, -fy, -fz, all(0.0)};
      add_4_columns<WIDTH<ForceSum>>(numbers(data.force), j, on_j);

      if (data.tally) {
        const Vec f[3] = {fx, fy, fz}, r[3] = {dx, dy, dz};
        tally_block(data.tally, i, j, n - k, f, r);
      }
    }
    for (int d = 0; d < 3; d++) data.force[i].f[d] += sum(total_f[d]);
    if constexpr (SPIN)
      for (int d = 0; d < 3; d++) data.torque[i].t[d] += sum(total_t[d]);
  }
}

// one number of each of n particles, and of some behind them

inline void pressure_loop(const NoiseData &data, int n)
{
  for (int k = 0; k < n; k += LANES) {
    const Words tag = load_words(data.tag + k);
    const Words counter[4] = {tag, all_words(0), all_words(data.step & 0xffffffff),
                              all_words(data.step >> 32)};
    Words random[4];
    random_words(data, counter, shifted<32>(tag), NoiseChannel::PRESSURE, random);
    Vec number_of, unused;
    normal_pair(random[0], random[1], number_of, unused);
    store(data.pressure + k, number_of);
  }
}

// forms that only act along e, and all in one dimension, have no numbers across

inline int transverse_of(const NoiseForm &form)
{
  const bool central = (form.shear == Shear::MG || form.shear == Shear::MG_FR || form.dim == 1);
  return central ? 0 : form.dim;
}

inline NoiseLoop choose_eta_loop(const NoiseForm &form)
{
  if (form.shear == Shear::MG_FR) return eta_loop<true, 0>;
  switch (transverse_of(form)) {
    case 2:
      return eta_loop<false, 2>;
    case 3:
      return eta_loop<false, 3>;
    default:
      return eta_loop<false, 0>;
  }
}

template <bool DIRECTED> NoiseLoop choose_impulse(const NoiseForm &form)
{
  const bool spin = (form.shear == Shear::MICROPOLAR);
  if (form.shear == Shear::MG_FR) return impulse_loop<true, 0, false, DIRECTED>;
  switch (transverse_of(form)) {
    case 2:
      return spin ? impulse_loop<false, 2, true, DIRECTED>
                  : impulse_loop<false, 2, false, DIRECTED>;
    case 3:
      return spin ? impulse_loop<false, 3, true, DIRECTED>
                  : impulse_loop<false, 3, false, DIRECTED>;
    default:
      return impulse_loop<false, 0, false, DIRECTED>;
  }
}

inline NoiseLoop choose_impulse_loop(const NoiseForm &form)
{
  return form.directed ? choose_impulse<true>(form) : choose_impulse<false>(form);
}
