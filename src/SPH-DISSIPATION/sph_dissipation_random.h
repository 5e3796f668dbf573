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

// Random numbers that are a function of a counter and a key: they do not depend on the processor and the order of the calls.
// For one counter or, in the loops, for a vector of counters.  Included in more than one namespace, after
// sph_dissipation_simd.h and sph_dissipation_words.h, hence without guard and namespace.

// Four random words of 32 bits: Philox4x32-7, J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, Parallel random numbers:
// as easy as 1, 2, 3, Proc. SC11 (2011).  7 rounds are the fewest that pass all tests of BigCrush.  Only the lower 32 bits
// of counter and keys count.

constexpr int ROUNDS = 7;

struct PhiloxKeys {
  std::uint64_t first[ROUNDS], second[ROUNDS];    // keys of each round

  PhiloxKeys(std::uint64_t key0, std::uint64_t key1)
  {
    for (int round = 0; round < ROUNDS; round++) {
      first[round] = key0 + round * 0x9E3779B9ull;
      second[round] = key1 + round * 0xBB67AE85ull;
    }
  }
};

// Replace N counters by their random words, with garbage above the 32 bits of a word; N > 1: the chains of operations
// overlap

template <int N> SPH_INLINE void philox(Words (*word)[4], const PhiloxKeys &keys)
{
  const Words multiplier0 = all_words(0xD2511F53), multiplier1 = all_words(0xCD9E8D57);
  for (int round = 0; round < ROUNDS; round++)
    for (int k = 0; k < N; k++) {
      Words *const c = word[k];
      const Words p0 = product(multiplier0, c[0]), p1 = product(multiplier1, c[2]);
      c[0] = xor3(shifted<32>(p1), c[1], all_words(keys.first[round]));
      c[1] = p1;
      c[2] = xor3(shifted<32>(p0), c[3], all_words(keys.second[round]));
      c[3] = p0;
    }
}

// Return a word, times a sign, as a number uniform between -sqrt(3) and sqrt(3), with mean 0 and variance 1.  The balance of
// noise and friction needs no other moments, B. Duenweg, W. Paul, Int. J. Mod. Phys. C 2, 817 (1991); the velocities, sums
// of many such numbers, have a normal distribution.

SPH_INLINE Vec uniform(Words word, Vec sign)
{
  constexpr double SQRT_3 = 1.7320508075688772935, UNIT = 1.0 / 2147483648.0;
  return middle(word, 0xffffffff) * (sign * all(SQRT_3 * UNIT)) - sign * all(SQRT_3);
}

// Return such a number from the lower 16 bits of a word, with the factor that makes the variance of these 65,536 numbers 1.

SPH_INLINE Vec uniform_of_half(Words word, Vec sign)
{
  constexpr double SQRT_3 = 1.7320508075688772935 * (1.0 + 0.5 / 4294967296.0);
  constexpr double UNIT = 1.0 / 32768.0;
  return middle(word, 0xffff) * (sign * all(SQRT_3 * UNIT)) - sign * all(SQRT_3);
}
