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

// Numbers of a pair:
//   forms along e only: 0 = along e, 1 = back
//   2d: 0 = along e, 1 = across e, 2 = spin, 3 = back
//   3d: 0 = along e, 1 to 3 = vector; more: 0 to 2 = vector of the spin, 3 = back
// "Back" is the number of the particle with the higher ID, if each of both has its own along e, then
// "along e" is that of the other one.  Vectors are those of the particle with the lower ID, and
// opposite for the other one; numbers along and across e need no sign, since e_ji = -e_ij.

SPH_INLINE void numbers_of(const Words *counter, const PhiloxKeys &keys, Vec *number_of)
{
  Words random[4];
  philox(counter, keys, random);
  for (int k = 0; k < 4; k++) number_of[k] = uniform(random[k]);
}

// keys and part of the counter that are the same for all pairs

struct NoiseStep {
  PhiloxKeys pair, more, pressure;
  std::uint64_t low, high;

  NoiseStep(const NoiseData &data) :
      pair(keys_of(data, NoiseChannel::PAIR)), more(keys_of(data, NoiseChannel::PAIR_MORE)),
      pressure(keys_of(data, NoiseChannel::PRESSURE)), low(data.step & 0xffffffff),
      high(data.step >> 32)
  {
  }
  static PhiloxKeys keys_of(const NoiseData &data, NoiseChannel channel)
  {
    return {data.seed, static_cast<std::uint64_t>(channel)};
  }
};

// Counter of a pair: both IDs, the step.  IDs of more than 32 bits have at most 46; the upper bits of
// both go to those of the step, beside the 4 which that needs then.

struct PairCounter {
  Words word[4];
  Vec sign;    // 1 where i has the lower ID, else -1

  SPH_INLINE PairCounter(const NoiseStep &step, double tag_i, Vec tag_j)
  {
    word[0] = words(smaller(all(tag_i), tag_j));
    word[1] = words(larger(all(tag_i), tag_j));
    word[2] = all_words(step.low);
    word[3] = all_words(step.high);
    if constexpr (sizeof(tagint) > 4)
      word[3] = xor3(word[3], product(shifted<32>(word[0]), all_words(1 << 4)),
                     product(shifted<32>(word[1]), all_words(1 << 18)));
    sign = if_positive(tag_j - all(tag_i), all(2.0)) - all(1.0);
  }
};

// neighbors of a block, relative to particle i

struct NoiseBlock {
  Vec row[8], dx, dy, dz, rsq;

  SPH_INLINE NoiseBlock(const NoiseData &data, const NoiseRow &i, const int *j)
  {
    load_4_columns<WIDTH<NoiseRow>>(numbers(data.row), j, row);
    load_4_columns<WIDTH<NoiseRow>>(numbers(data.row) + 4, j, row + 4);
    dx = i.x[0] - row[0];
    dy = i.x[1] - row[1];
    dz = i.x[2] - row[2];
    rsq = dx * dx + dy * dy + dz * dz;
  }
  SPH_INLINE Vec vol() const { return row[3]; }
  SPH_INLINE Vec tag() const { return row[4]; }
  SPH_INLINE Vec reach() const { return row[5]; }
  SPH_INLINE Vec share() const { return row[6]; }
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

// gamma_ij = root times reach of j over c of i

template <bool FR> SPH_INLINE Vec root_of(Vec slope, Vec rsq, Vec inverse_central)
{
  const Vec metric = FR ? square_root(rsq) : rsq;
  return square_root(slope * metric * inverse_central);
}

// eta_i c_i = sum_j c_i gamma_ij xi_ij with the number xi_ij of i

template <bool FR, int TRANSVERSE> void eta_loop(const LoopData &pairs, const NoiseData &data)
{
  NoiseCoeffs coeff(data.coeff[pairs.ntypes_1 + 1]);
  const NoiseStep step(data);
  for (int ii = 0; ii < pairs.inum; ii++) {
    const int i = pairs.ilist[ii];
    const NoiseRow own = data.row[i];
    const int n = pairs.count[ii];
    const int *const neighbor = pairs.neighbor + pairs.first[ii];
    const double *const slope_of = pairs.slope + pairs.first[ii];
    Vec total = all(0.0);
    for (int k = 0; k < n; k += LANES) {
      const int *const j = neighbor + k;
      const NoiseBlock block(data, own, j);
      if (!pairs.uniform) coeff.load(pairs, data, i, j, n - k);
      const PairCounter counter(step, own.tag, block.tag());
      Vec z[4];
      numbers_of(counter.word, step.pair, z);
      const Vec forth = z[0];
      if constexpr (TRANSVERSE == 3) numbers_of(counter.word, step.more, z);
      const Vec back = z[TRANSVERSE ? 3 : 1];
      const Vec mean = 0.5 * (forth + back);
      const Vec odd = 0.5 * counter.sign * (forth - back);
      const Vec root = root_of<FR>(load(slope_of + k), block.rsq, coeff.inverse_central);
      total += block.reach() * root * (mean + odd);
      add_column<1>(data.eta, j, own.reach * root * (mean - odd));
    }
    data.eta[i] += sum(total);
  }
}

// random forces and torques of the pairs, onto the sums of both particles

template <bool FR, int TRANSVERSE, bool SPIN, bool DIRECTED>
void impulse_loop(const LoopData &pairs, const NoiseData &data)
{
  NoiseCoeffs coeff(data.coeff[pairs.ntypes_1 + 1]);
  const NoiseStep step(data);
  for (int ii = 0; ii < pairs.inum; ii++) {
    const int i = pairs.ilist[ii];
    const NoiseRow own = data.row[i];
    const int n = pairs.count[ii];
    const int *const neighbor = pairs.neighbor + pairs.first[ii];
    const double *const slope_of = pairs.slope + pairs.first[ii];
    Vec total_f[3] = {all(0.0), all(0.0), all(0.0)};
    Vec total_t[3] = {all(0.0), all(0.0), all(0.0)};

    for (int k = 0; k < n; k += LANES) {
      const int *const j = neighbor + k;
      const NoiseBlock block(data, own, j);
      for (int l = 0; l < LANES; l++) {
        prefetch(data.row + j[l + AHEAD]);
        if constexpr (SPIN) {
          prefetch(data.force + j[l + AHEAD]);
          prefetch(data.torque + j[l + AHEAD]);
        }
      }
      const Vec dx = block.dx, dy = block.dy, dz = block.dz, rsq = block.rsq;
      const Vec slope = load(slope_of + k);
      const Vec vv_slope = if_positive(rsq, own.vol * block.vol() * slope);
      const Vec vv = FR ? vv_slope * square_root(rsq) : vv_slope;
      const Vec inverse_rsq = 1.0 / (rsq + TINY);
      if (!pairs.uniform) coeff.load(pairs, data, i, j, n - k);

      const PairCounter counter(step, own.tag, block.tag());
      Vec z[4], more[4];
      numbers_of(counter.word, step.pair, z);
      if constexpr (TRANSVERSE == 3 && (SPIN || DIRECTED))
        numbers_of(counter.word, step.more, more);

      Vec along = z[0];
      if constexpr (DIRECTED) {
        const Vec root = root_of<FR>(slope, rsq, coeff.inverse_central);
        const Vec back = (TRANSVERSE == 3) ? more[3] : z[TRANSVERSE ? 3 : 1];
        along += back - root * (block.reach() * own.share + own.reach * block.share());
      }

      const Vec by_r = square_root(vv * inverse_rsq);
      const Vec central = coeff.central * by_r * along;
      Vec fx = central * dx, fy = central * dy, fz = central * dz;
      Vec spin[3] = {all(0.0), all(0.0), all(0.0)};
      if constexpr (TRANSVERSE == 2) {
        const Vec across = coeff.transverse * by_r * z[1];
        fx -= across * dy;
        fy += across * dx;
        if constexpr (SPIN) spin[2] = counter.sign * coeff.spin_across * square_root(vv) * z[2];
      }

      // of a vector, the part across e, or different parts along and across it

      if constexpr (TRANSVERSE == 3) {
        const Vec strength = counter.sign * square_root(vv);
        const Vec across = strength * coeff.transverse;
        const Vec part = across * (dx * z[1] + dy * z[2] + dz * z[3]) * inverse_rsq;
        fx += across * z[1] - part * dx;
        fy += across * z[2] - part * dy;
        fz += across * z[3] - part * dz;
        if constexpr (SPIN) {
          const Vec spin_across = strength * coeff.spin_across;
          const Vec remainder = (strength * coeff.spin_along - spin_across) * inverse_rsq *
              (dx * more[0] + dy * more[1] + dz * more[2]);
          spin[0] = spin_across * more[0] + remainder * dx;
          spin[1] = spin_across * more[1] + remainder * dy;
          spin[2] = spin_across * more[2] + remainder * dz;
        }
      }

      // the torque that balances the force is the same for both, that of the spins opposite

      if constexpr (SPIN) {
        const Vec torque[3] = {-0.5 * (dy * fz - dz * fy), -0.5 * (dz * fx - dx * fz),
                               -0.5 * (dx * fy - dy * fx)};
        for (int d = 0; d < 3; d++) total_t[d] += torque[d] + spin[d];
        const Vec on_j[4] = {torque[0] - spin[0], torque[1] - spin[1], torque[2] - spin[2],
                             all(0.0)};
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
  const NoiseStep step(data);
  for (int k = 0; k < n; k += LANES) {
    double lane[LANES];
    for (int l = 0; l < LANES; l++) lane[l] = data.row[k + l].tag;
    const Words tag = words(load(lane));
    const Words counter[4] = {tag, shifted<32>(tag), all_words(step.low), all_words(step.high)};
    Vec z[4];
    numbers_of(counter, step.pressure, z);
    store(data.pressure + k, z[0]);
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
