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

// Random numbers and random forces of pairs, on host and device.  Files include this header inside a namespace, after
// sph_dissipation_simd.h and sph_dissipation_words.h or after their counterparts for one pair: so the header has no guard
// and no namespace.

#include "sph_dissipation_random.h"

// Random numbers of a pair, mean 0 and variance 1:
//   forms along e only: 0 = along e, 1 = back
//   1d, 2d: 0 = along e, 1 = across e, 2 = spin, 3 = back
//   3d: 0 to 2 = vector
//   3d with more, 16 bits each: 0 to 2 = vector, 3 = along e, 4 to 6 = vector of the spin, 7 = back
// DIRECTED: the particle with the lower ID has "along e", its partner has "back".  A random flow of heat (never DIRECTED)
// has the number "back", or number 3 after three-dimensional vectors.  Vectors and the flow belong to the particle with the
// lower ID, and are opposite for the other particle.  Numbers along and across e need no sign, since e_ji = -e_ij.

template <int ACROSS, bool SPIN, bool DIRECTED, bool CONDUCTS = false> struct PairNumbers {
  static constexpr bool MANY = (ACROSS == 3 && (SPIN || DIRECTED));
  static constexpr int NONE = -1;
  static constexpr int ALONG = MANY ? 3 : (ACROSS == 3) ? NONE : 0;
  static constexpr int BACK = MANY ? 7 : (ACROSS == 3) ? NONE : (ACROSS == 2) ? 3 : 1;
  static constexpr int FLOW = (BACK == NONE) ? 3 : BACK;
  static constexpr int N = MANY ? 8 : 4;
  Vec z[N];

  SPH_INLINE static constexpr bool is_used(int k)
  {
    if (k == FLOW && CONDUCTS) return true;
    if (k == BACK) return DIRECTED;
    if (k == ALONG) return DIRECTED || ACROSS != 3;
    return k < ACROSS || (SPIN && is_of_vector(k));
  }
  SPH_INLINE static constexpr bool is_of_vector(int k)
  {
    if (k == FLOW && CONDUCTS) return true;
    return (ACROSS == 3) ? k != ALONG && k != BACK : ACROSS == 2 && k == 2;
  }

  // sign: 1 where i has the lower ID, else -1
  SPH_INLINE PairNumbers(const Words *random, Vec sign)
  {
    for (int k = 0; k < N; k++) {
      const Vec factor = is_of_vector(k) ? sign : all(1.0);
      if constexpr (MANY)
        z[k] = uniform_of_half((k < 4) ? random[k] : shifted<16>(random[k - 4]), factor);
      else
        z[k] = uniform(random[k], factor);
    }
  }
};

// Keys of the generator, and the part of the counter that is the same for all pairs

struct NoiseStep {
  PhiloxKeys pair;
  std::uint64_t low, high;

  NoiseStep(const NoiseData &data) :
      pair(keys_of(data, data.of_pairs)), low(data.step & 0xffffffff), high(data.step >> 32)
  {
  }
  static PhiloxKeys keys_of(const NoiseData &data, NoiseChannel channel)
  {
    return {data.seed, static_cast<std::uint64_t>(channel)};
  }
};

// Set the counter of a pair: both IDs, and the step.  IDs of 64 bits count with their lower 46 bits: the upper 14 of these
// bits of each ID share the last word with the upper 4 bits of the step.

SPH_INLINE void set_counter(Words *word, const NoiseStep &step, double tag_i, Vec tag_j)
{
  word[0] = words(smaller(all(tag_i), tag_j));
  word[1] = words(larger(all(tag_i), tag_j));
  word[2] = all_words(step.low);
  word[3] = all_words(step.high);
  if constexpr (sizeof(tagint) > 4)
    word[3] = xor3(word[3], product(shifted<32>(word[0]), all_words(1 << 4)),
                   product(shifted<32>(word[1]), all_words(1 << 18)));
}

// Set the counter of a particle and turn it into random words

SPH_INLINE void draw_for_particle(Words (*word)[4], const NoiseStep &step, const PhiloxKeys &keys,
                                  Vec tag)
{
  word[0][0] = words(tag);
  word[0][1] = shifted<32>(word[0][0]);
  word[0][2] = all_words(step.low);
  word[0][3] = all_words(step.high);
  philox<1>(word, keys);
}

// Return 1 where i has the lower ID, else -1

SPH_INLINE Vec sign_of(double tag_i, Vec tag_j)
{
  return if_positive(tag_j - all(tag_i), all(2.0)) - all(1.0);
}

// Places of the numbers in NoiseCoeff

enum {
  CENTRAL,
  TRANSVERSE,
  SPIN_ALONG,
  SPIN_ACROSS,
  INVERSE_CENTRAL,
  PAIR_CONDUCTION,
  CENTRAL_BY_SQUARE
};
// Return the factor of the random number along e, in units of sqrt(F V_i V_j); forms with BY_SQUARE have rsq as metric

template <bool BY_SQUARE> SPH_INLINE Vec central_of(const Vec *coeff, Vec rsq)
{
  if constexpr (BY_SQUARE)
    return square_root(coeff[CENTRAL] * coeff[CENTRAL] + coeff[CENTRAL_BY_SQUARE] * rsq);
  else
    return coeff[CENTRAL];
}

// Return root = sqrt(F r^2/a_ij); gamma_ij of NoiseStage = root c_j sqrt(V_j)/c_i.  metric = r^2, or r for mg/fr

template <bool BY_SQUARE>
SPH_INLINE Vec root_of(const NoiseData &data, const Vec *coeff, Vec slope, Vec metric)
{
  if constexpr (BY_SQUARE) {
    const Vec central = central_of<true>(coeff, metric);
    return if_positive(central, square_root(data.strength * slope * metric) / (central + TINY));
  } else
    return square_root(slope * metric * coeff[INVERSE_CENTRAL]);
}

// Random force of a pair, and its torques

template <int ACROSS, bool SPIN, bool DIRECTED, bool BY_SQUARE> struct RandomForce {
  static constexpr bool VECTOR = (ACROSS == 3);

  Vec central;      // force on i along r_ij, times 1/r
  Vec rest[3];      // force on i in other directions, if there is any
  Vec torque[3];    // torque on both, which balances the force
  Vec spin[3];      // torque on i, opposite on j

  // Set forces and torques from the numbers z of PairNumbers; along_e = random number along e, if there is one.  coeff =
  // numbers of NoiseCoeff; (dx, dy, dz) = r_ij; vv = F V_i V_j; by_metric = vv/metric; inverse = 1/r^2 if VECTOR

  SPH_INLINE void set(const Vec *coeff, const Vec *z, Vec along_e, Vec dx, Vec dy, Vec dz, Vec vv,
                      Vec metric, Vec by_metric, Vec inverse)
  {
    if constexpr (DIRECTED || !VECTOR) {
      const Vec by_r = square_root(by_metric);
      central = central_of<BY_SQUARE>(coeff, metric) * by_r * along_e;
      if constexpr (ACROSS == 2) {
        const Vec across = coeff[TRANSVERSE] * by_r * z[1];
        rest[0] = -across * dy;
        rest[1] = across * dx;
        torque[2] = -0.5 * across * metric;
        if constexpr (SPIN) spin[2] = coeff[SPIN_ACROSS] * square_root(vv) * z[2];
      }
    }

    // DIRECTED: the random vector acts across e only; else with different factors along and across e

    if constexpr (VECTOR) {
      const Vec strength = square_root(vv);
      const Vec across = strength * coeff[TRANSVERSE];
      const Vec along = DIRECTED ? -across
                                 : strength * central_of<BY_SQUARE>(coeff, metric) - across;
      const Vec part = along * inverse * (dx * z[0] + dy * z[1] + dz * z[2]);
      if constexpr (DIRECTED)
        central += part;
      else
        central = part;
      for (int k = 0; k < 3; k++) rest[k] = across * z[k];
      if constexpr (SPIN) {
        torque[0] = -0.5 * (dy * rest[2] - dz * rest[1]);
        torque[1] = -0.5 * (dz * rest[0] - dx * rest[2]);
        torque[2] = -0.5 * (dx * rest[1] - dy * rest[0]);
        const Vec spin_across = strength * coeff[SPIN_ACROSS];
        const Vec remainder = (strength * coeff[SPIN_ALONG] - spin_across) * inverse *
            (dx * z[4] + dy * z[5] + dz * z[6]);
        spin[0] = spin_across * z[4] + remainder * dx;
        spin[1] = spin_across * z[5] + remainder * dy;
        spin[2] = spin_across * z[6] + remainder * dz;
      }
    }
  }

  SPH_INLINE void add_force(Vec &fx, Vec &fy, Vec &fz) const
  {
    if constexpr (ACROSS > 0) {
      fx += rest[0];
      fy += rest[1];
    }
    if constexpr (VECTOR) fz += rest[2];
  }

  // Add the equal torques on i and j to on_both, and the torque on j that is opposite on i to on_j

  SPH_INLINE void add_torque(Vec *on_both, Vec *on_j) const
  {
    for (int k = VECTOR ? 0 : 2; k < 3; k++) {
      on_both[k] += torque[k];
      on_j[k] -= spin[k];
    }
  }
};
