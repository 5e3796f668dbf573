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

// Random numbers that are a function of a counter and a key: whoever asks, and in which order, gets the
// same ones.  For one counter or, in the loops, for a vector of them: included in more than one
// namespace, after sph_dissipation_simd.h and sph_dissipation_words.h, hence without guard and without
// a namespace of its own, as sph_dissipation_kernel_shapes.h.

// Four random words of 32 bits: Philox4x32-10, J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw,
// Parallel random numbers: as easy as 1, 2, 3, Proc. SC11 (2011).  Only the lower 32 bits of counter
// and key count; those above them are garbage during the rounds.

SPH_INLINE void philox(const Words *counter, Words key0, Words key1, Words *random)
{
  const Words multiplier0 = all_words(0xD2511F53), multiplier1 = all_words(0xCD9E8D57);
  const Words weyl0 = all_words(0x9E3779B9), weyl1 = all_words(0xBB67AE85);
  Words c0 = counter[0], c1 = counter[1], c2 = counter[2], c3 = counter[3];
  for (int round = 0; round < 10; round++) {
    const Words p0 = product(multiplier0, c0), p1 = product(multiplier1, c2);
    c0 = shifted<32>(p1) ^ c1 ^ key0;
    c1 = p1;
    c2 = shifted<32>(p0) ^ c3 ^ key1;
    c3 = p0;
    key0 = key0 + weyl0;
    key1 = key1 + weyl1;
  }
  random[0] = masked(c0, 0xffffffff);
  random[1] = masked(c1, 0xffffffff);
  random[2] = masked(c2, 0xffffffff);
  random[3] = masked(c3, 0xffffffff);
}

// natural logarithm of a normal number > 0: exponent, and a series for a mantissa between sqrt(1/2)
// and sqrt(2), whose error is below 1e-15

SPH_INLINE Vec logarithm(Vec a)
{
  constexpr std::uint64_t ONE = 0x3ff0000000000000, SQRT_HALF = 0x3fe6a09e667f3bcd;
  constexpr std::uint64_t MANTISSA = 0x000fffffffffffff;
  const Words split = pattern(a) + all_words(ONE - SQRT_HALF);
  const Vec exponent = number(shifted<52>(split)) - all(1023.0);
  const Vec f = value(masked(split, MANTISSA) + all_words(SQRT_HALF)) - all(1.0);
  const Vec s = f / (f + all(2.0));
  const Vec z = s * s;
  Vec series = all(2.0 / 19.0);
  for (const double odd : {17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0})
    series = series * z + all(2.0 / odd);
  return exponent * all(0.69314718055994530942) + series * s;
}

// Two independent numbers of the normal distribution with mean 0 and variance 1 from two words, G. E.
// P. Box, M. E. Muller, Ann. Math. Statist. 29, 610 (1958): radius from the first; from the second,
// the lowest bit says to which side of the circle, the others which angle between -pi/2 and pi/2.
// Below 6.8, as the words have 32 bits.

SPH_INLINE void normal_pair(Words first, Words second, Vec &x, Vec &y)
{
  constexpr double SIN[] = {-2.294842899726987311e-8,    7.9520540014755127848e-7,
                            -0.000021915353447830215827, 0.00046630280576761256442,
                            -0.0073704309457143507773,   0.082145886611128228799,
                            -0.59926452932079207689,     2.5501640398773454439,
                            -5.1677127800499700292,      3.1415926535897932385};
  constexpr double COS[] = {3.6047307974625009339e-9,
                            -1.3878952462213772114e-7,
                            4.3030695870329470073e-6,
                            -0.00010463810492484570712,
                            0.0019295743094039230479,
                            -0.025806891390014060013,
                            0.23533063035889320454,
                            -1.3352627688545894959,
                            4.0587121264167682182,
                            -4.9348022005446793094,
                            1.0};
  constexpr double UNIT = 1.0 / 4294967296.0;

  const Vec uniform = (number(first) + all(0.5)) * all(UNIT);
  const Vec radius = square_root(all(-2.0) * logarithm(uniform));
  const Vec side = all(1.0) - all(2.0) * number(masked(second, 1));
  const Vec turn = (number(masked(second, 0xfffffffe)) + all(1.0)) * all(UNIT) - all(0.5);
  const Vec z = turn * turn;
  Vec sine = all(0.0), cosine = all(0.0);    // of pi turn
  for (const double c : SIN) sine = sine * z + all(c);
  for (const double c : COS) cosine = cosine * z + all(c);
  const Vec signed_radius = radius * side;
  x = signed_radius * cosine;
  y = signed_radius * sine * turn;
}
