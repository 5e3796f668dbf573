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

// Words for random numbers, beside the vectors of sph_dissipation_simd.h: a Words holds one unsigned
// number of 64 bits of each of LANES pairs.  + and ^ act on it as on a number.
//
//   all_words(a)        a in every lane
//   xor3(a, b, c)       a ^ b ^ c
//   product(a, b)       product of the lower 32 bits of each
//   shifted<N>(a)       a shifted to the right by N bits
//   masked(a, bits, b)  (a & bits) ^ b; bits = one number for all lanes
//   middle(a, bits)     the bits of a that are set in bits as a number, + 1/2
//   pattern(a)          the bits of a number; value(a): the number that has these bits
//   words(a)            whole numbers 0 <= a < 2^52

namespace LAMMPS_NS {
namespace SPHDissipation {
  namespace LOOPS {

#if defined(LOOPS_AVX512)

    typedef __m512i Words;

    SPH_INLINE Words all_words(std::uint64_t a)
    {
      return _mm512_set1_epi64(static_cast<long long>(a));
    }
    SPH_INLINE Words product(Words a, Words b)
    {
      return _mm512_mul_epu32(a, b);
    }
    SPH_INLINE Words xor3(Words a, Words b, Words c)
    {
      return _mm512_ternarylogic_epi64(a, b, c, 0x96);
    }
    template <int N> SPH_INLINE Words shifted(Words a)
    {
      return _mm512_srli_epi64(a, N);
    }
    SPH_INLINE Words masked(Words a, std::uint64_t bits, Words b)
    {
      return _mm512_ternarylogic_epi64(a, all_words(bits), b, 0x6a);
    }

#elif defined(LOOPS_AVX2)

    typedef __m256i Words;

    SPH_INLINE Words all_words(std::uint64_t a)
    {
      return _mm256_set1_epi64x(static_cast<long long>(a));
    }
    SPH_INLINE Words product(Words a, Words b)
    {
      return _mm256_mul_epu32(a, b);
    }
    SPH_INLINE Words xor3(Words a, Words b, Words c)
    {
      return a ^ b ^ c;
    }
    template <int N> SPH_INLINE Words shifted(Words a)
    {
      return _mm256_srli_epi64(a, N);
    }
    SPH_INLINE Words masked(Words a, std::uint64_t bits, Words b)
    {
      return _mm256_and_si256(a, all_words(bits)) ^ b;
    }

#else

    typedef std::uint64_t Words;

    SPH_INLINE Words all_words(std::uint64_t a)
    {
      return a;
    }
    SPH_INLINE Words product(Words a, Words b)
    {
      return (a & 0xffffffff) * (b & 0xffffffff);
    }
    SPH_INLINE Words xor3(Words a, Words b, Words c)
    {
      return a ^ b ^ c;
    }
    template <int N> SPH_INLINE Words shifted(Words a)
    {
      return a >> N;
    }
    SPH_INLINE Words masked(Words a, std::uint64_t bits, Words b)
    {
      return (a & bits) ^ b;
    }

#endif

    // One version for all instruction sets

    SPH_INLINE Words pattern(Vec a)
    {
      Words bits;
      std::memcpy(&bits, &a, sizeof(bits));
      return bits;
    }

    SPH_INLINE Vec value(Words a)
    {
      Vec number;
      std::memcpy(&number, &a, sizeof(number));
      return number;
    }

    // Upper bits of the numbers from 2^52 to 2^53, whose lower bits are a whole number; 2^52

    constexpr std::uint64_t OFFSET_PATTERN = 0x4330000000000000;
    constexpr double OFFSET = 4503599627370496.0;

    SPH_INLINE Vec middle(Words a, std::uint64_t bits)
    {
      return value(masked(a, bits, all_words(OFFSET_PATTERN))) - all(OFFSET - 0.5);
    }
    SPH_INLINE Words words(Vec a)
    {
      return pattern(a + all(OFFSET)) ^ all_words(OFFSET_PATTERN);
    }

  }    // namespace LOOPS
}    // namespace SPHDissipation
}    // namespace LAMMPS_NS
