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

// A thin layer over the vector registers of one instruction set, for sph_dissipation_loops.h, which
// includes this file once per instruction set.  A Vec holds one number of each of LANES pairs.
// +, -, * and / act on a Vec as on a double: GCC and Clang have these operators for the vector types
// of the processor, and where no instruction set is switched on a Vec is a double.
//
//   all(a)              a in every lane
//   if_positive(a, b)   b where a > 0, else 0
//   smaller(a, b), larger(a, b)
//   bits_below(a, b)    one bit per lane, set where a < b; for pack()
//   count_bits(bits)    number of bits that are set
//   pack(to, a, bits)   write the lanes whose bits are set one after another; what follows them in
//                       the next LANES entries is undefined
//   copy_neighbors()    the offsets of n indices, without the bits that LAMMPS puts into them, and in the rest of the last
//                       block those of fill, fill + 1, ...
//   gather(from, i)     from[i[0]] to from[i[LANES-1]]
//   indices_of(from, i) the whole numbers from[i[0]] to from[i[LANES-1]], for pick()
//   pick(from, indices) numbers of from, at the indices modulo LANES
//   sum(a)              sum of all lanes
//   store_floats(to, a) store in single precision
//   prefetch(p)         fetch the cache line of p
//
// Rows are structures of N doubles, one per particle; columns are the same numbers, each member in one
// Vec.  load_4_columns<N>(row, i, column) reads the first four members of the rows i[0] to i[LANES-1], load_2_columns<N>()
// two, add_4_columns<N>(), add_2_columns<N>() and add_column<N>() add to the first members of the rows,
// one row after another: an index may occur twice.

// Floats holds FLOATS numbers of single precision, for distances: all_floats(), load_floats(), bits_below(), and
// pack_indices(), which writes the indices whose bits are set one after another, as pack() does.
// copy_indices(to, from, n) writes whole vectors.

namespace LAMMPS_NS {
namespace SPHDissipation {
  namespace LOOPS {

    // Return the address of a row of N doubles

    template <int N, class Number> SPH_INLINE Number *at(Number *row, Offset offset)
    {
      return reinterpret_cast<Number *>(reinterpret_cast<std::uintptr_t>(row) +
                                        N * static_cast<std::uintptr_t>(offset));
    }

#if defined(LOOPS_AVX512) || defined(LOOPS_AVX2)

    SPH_INLINE int count_bits(int bits)
    {
      return __builtin_popcount(bits);
    }
    SPH_INLINE void prefetch(const void *p)
    {
      _mm_prefetch(static_cast<const char *>(p), _MM_HINT_T0);
    }
    SPH_INLINE void add_128(double *to, __m128d a)
    {
      _mm_storeu_pd(to, _mm_loadu_pd(to) + a);
    }

#endif

#if defined(LOOPS_AVX512)

    constexpr int LANES = 8;
    typedef __m512d Vec;

    SPH_INLINE Vec all(double a)
    {
      return _mm512_set1_pd(a);
    }
    SPH_INLINE Vec load(const double *from)
    {
      return _mm512_loadu_pd(from);
    }
    SPH_INLINE void store(double *to, Vec a)
    {
      _mm512_storeu_pd(to, a);
    }
    SPH_INLINE Vec gather(const double *from, const Offset *i)
    {
      return _mm512_setr_pd(*at<1>(from, i[0]), *at<1>(from, i[1]), *at<1>(from, i[2]),
                            *at<1>(from, i[3]), *at<1>(from, i[4]), *at<1>(from, i[5]),
                            *at<1>(from, i[6]), *at<1>(from, i[7]));
    }
    typedef __m512i Indices;
    SPH_INLINE Indices indices_of(const int *from, const Offset *i)
    {
      int a[LANES];
      for (int l = 0; l < LANES; l++) a[l] = from[index_of(i[l])];
      return _mm512_cvtepi32_epi64(
          _mm256_setr_epi32(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]));
    }
    SPH_INLINE Vec pick(const double *from, Indices indices)
    {
      return _mm512_permutexvar_pd(indices, load(from));
    }
    SPH_INLINE Vec square_root(Vec a)
    {
      return _mm512_sqrt_pd(a);
    }
    SPH_INLINE Vec smaller(Vec a, Vec b)
    {
      return _mm512_min_pd(a, b);
    }
    SPH_INLINE Vec larger(Vec a, Vec b)
    {
      return _mm512_max_pd(a, b);
    }
    SPH_INLINE Vec if_positive(Vec a, Vec value)
    {
      return _mm512_maskz_mov_pd(_mm512_cmp_pd_mask(a, _mm512_setzero_pd(), _CMP_GT_OQ), value);
    }
    SPH_INLINE int bits_below(Vec a, Vec bound)
    {
      return _mm512_cmp_pd_mask(a, bound, _CMP_LT_OQ);
    }
    SPH_INLINE void pack(double *to, Vec a, int bits)
    {
      _mm512_storeu_pd(to, _mm512_maskz_compress_pd(static_cast<__mmask8>(bits), a));
    }
    SPH_INLINE void pack(Offset *to, const Offset *from, int bits)
    {
      const __m256i a = _mm256_loadu_si256(reinterpret_cast<const __m256i *>(from));
      _mm256_storeu_si256(reinterpret_cast<__m256i *>(to),
                          _mm256_maskz_compress_epi32(static_cast<__mmask8>(bits), a));
    }
    SPH_INLINE void copy_neighbors(Offset *to, const int *from, int n, int fill)
    {
      const __m256i fills =
          _mm256_add_epi32(_mm256_set1_epi32(fill), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
      for (int k = 0; k < n; k += LANES) {
        const __mmask8 there = (n - k < LANES) ? (1 << (n - k)) - 1 : 0xff;
        const __m256i j = _mm256_maskz_loadu_epi32(there, from + k);
        const __m256i indices =
            _mm256_mask_and_epi32(fills, there, j, _mm256_set1_epi32(NEIGHMASK));
        _mm256_storeu_si256(reinterpret_cast<__m256i *>(to + k), _mm256_slli_epi32(indices, 3));
      }
    }
    SPH_INLINE double sum(Vec a)
    {
      const __m256d half = _mm512_castpd512_pd256(a) + _mm512_extractf64x4_pd(a, 1);
      const __m128d pair = _mm256_castpd256_pd128(half) + _mm256_extractf128_pd(half, 1);
      return _mm_cvtsd_f64(pair) + _mm_cvtsd_f64(_mm_unpackhi_pd(pair, pair));
    }

    constexpr int FLOATS = 16;
    typedef __m512 Floats;

    SPH_INLINE Floats all_floats(float a)
    {
      return _mm512_set1_ps(a);
    }
    SPH_INLINE Floats load_floats(const float *from)
    {
      return _mm512_loadu_ps(from);
    }
    SPH_INLINE void store_floats(float *to, Vec a)
    {
      _mm256_storeu_ps(to, _mm512_cvtpd_ps(a));
    }
    SPH_INLINE int bits_below(Floats a, Floats bound)
    {
      return _mm512_cmp_ps_mask(a, bound, _CMP_LT_OQ);
    }
    SPH_INLINE void copy_indices(int *to, const int *from, int n)
    {
      for (int k = 0; k < n; k += FLOATS) _mm512_storeu_si512(to + k, _mm512_loadu_si512(from + k));
    }
    SPH_INLINE void pack_indices(int *to, const int *from, int bits)
    {
      _mm512_storeu_si512(
          to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), _mm512_loadu_si512(from)));
    }

    SPH_INLINE Vec load_halves(const double *lower, const double *upper)
    {
      return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(lower)),
                                _mm256_loadu_pd(upper), 1);
    }

    template <int N> SPH_INLINE void load_4_columns(const double *row, const Offset *i, Vec *column)
    {
      const Vec a = load_halves(at<N>(row, i[0]), at<N>(row, i[2]));
      const Vec b = load_halves(at<N>(row, i[1]), at<N>(row, i[3]));
      const Vec c = load_halves(at<N>(row, i[4]), at<N>(row, i[6]));
      const Vec d = load_halves(at<N>(row, i[5]), at<N>(row, i[7]));
      const Vec ab_even = _mm512_unpacklo_pd(a, b), cd_even = _mm512_unpacklo_pd(c, d);
      const Vec ab_odd = _mm512_unpackhi_pd(a, b), cd_odd = _mm512_unpackhi_pd(c, d);
      column[0] = _mm512_shuffle_f64x2(ab_even, cd_even, 0x88);
      column[1] = _mm512_shuffle_f64x2(ab_odd, cd_odd, 0x88);
      column[2] = _mm512_shuffle_f64x2(ab_even, cd_even, 0xdd);
      column[3] = _mm512_shuffle_f64x2(ab_odd, cd_odd, 0xdd);
    }

    SPH_INLINE Vec load_4_of_128(const double *a, const double *b, const double *c, const double *d)
    {
      Vec r = _mm512_castpd128_pd512(_mm_loadu_pd(a));
      r = _mm512_insertf64x2(r, _mm_loadu_pd(b), 1);
      r = _mm512_insertf64x2(r, _mm_loadu_pd(c), 2);
      return _mm512_insertf64x2(r, _mm_loadu_pd(d), 3);
    }

    template <int N> SPH_INLINE void load_2_columns(const double *row, const Offset *i, Vec *column)
    {
      const Vec even =
          load_4_of_128(at<N>(row, i[0]), at<N>(row, i[2]), at<N>(row, i[4]), at<N>(row, i[6]));
      const Vec odd =
          load_4_of_128(at<N>(row, i[1]), at<N>(row, i[3]), at<N>(row, i[5]), at<N>(row, i[7]));
      column[0] = _mm512_unpacklo_pd(even, odd);
      column[1] = _mm512_unpackhi_pd(even, odd);
    }

    SPH_INLINE void add_256(double *to, __m256d a)
    {
      _mm256_storeu_pd(to, _mm256_loadu_pd(to) + a);
    }

    template <int N> SPH_INLINE void add_4_columns(double *row, const Offset *i, const Vec *column)
    {
      const Vec even01 = _mm512_unpacklo_pd(column[0], column[1]);
      const Vec even23 = _mm512_unpacklo_pd(column[2], column[3]);
      const Vec odd01 = _mm512_unpackhi_pd(column[0], column[1]);
      const Vec odd23 = _mm512_unpackhi_pd(column[2], column[3]);
      const __m512i lower = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11);
      const __m512i upper = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
      const Vec rows02 = _mm512_permutex2var_pd(even01, lower, even23);
      const Vec rows13 = _mm512_permutex2var_pd(odd01, lower, odd23);
      const Vec rows46 = _mm512_permutex2var_pd(even01, upper, even23);
      const Vec rows57 = _mm512_permutex2var_pd(odd01, upper, odd23);
      add_256(at<N>(row, i[0]), _mm512_castpd512_pd256(rows02));
      add_256(at<N>(row, i[1]), _mm512_castpd512_pd256(rows13));
      add_256(at<N>(row, i[2]), _mm512_extractf64x4_pd(rows02, 1));
      add_256(at<N>(row, i[3]), _mm512_extractf64x4_pd(rows13, 1));
      add_256(at<N>(row, i[4]), _mm512_castpd512_pd256(rows46));
      add_256(at<N>(row, i[5]), _mm512_castpd512_pd256(rows57));
      add_256(at<N>(row, i[6]), _mm512_extractf64x4_pd(rows46, 1));
      add_256(at<N>(row, i[7]), _mm512_extractf64x4_pd(rows57, 1));
    }

    template <int N> SPH_INLINE void add_2_columns(double *row, const Offset *i, const Vec *column)
    {
      const Vec even = _mm512_unpacklo_pd(column[0], column[1]);
      const Vec odd = _mm512_unpackhi_pd(column[0], column[1]);
      add_128(at<N>(row, i[0]), _mm512_castpd512_pd128(even));
      add_128(at<N>(row, i[1]), _mm512_castpd512_pd128(odd));
      add_128(at<N>(row, i[2]), _mm512_extractf64x2_pd(even, 1));
      add_128(at<N>(row, i[3]), _mm512_extractf64x2_pd(odd, 1));
      add_128(at<N>(row, i[4]), _mm512_extractf64x2_pd(even, 2));
      add_128(at<N>(row, i[5]), _mm512_extractf64x2_pd(odd, 2));
      add_128(at<N>(row, i[6]), _mm512_extractf64x2_pd(even, 3));
      add_128(at<N>(row, i[7]), _mm512_extractf64x2_pd(odd, 3));
    }

#elif defined(LOOPS_AVX2)

    constexpr int LANES = 4;
    typedef __m256d Vec;

    SPH_INLINE Vec all(double a)
    {
      return _mm256_set1_pd(a);
    }
    SPH_INLINE Vec load(const double *from)
    {
      return _mm256_loadu_pd(from);
    }
    SPH_INLINE void store(double *to, Vec a)
    {
      _mm256_storeu_pd(to, a);
    }
    SPH_INLINE Vec gather(const double *from, const Offset *i)
    {
      return _mm256_setr_pd(*at<1>(from, i[0]), *at<1>(from, i[1]), *at<1>(from, i[2]),
                            *at<1>(from, i[3]));
    }
    typedef __m256i Indices;    // each lane as a pair of 32-bit halves
    SPH_INLINE Indices indices_of(const int *from, const Offset *i)
    {
      int a[LANES];
      for (int l = 0; l < LANES; l++) a[l] = 2 * from[index_of(i[l])];
      const __m256i two = _mm256_cvtepu32_epi64(_mm_setr_epi32(a[0], a[1], a[2], a[3]));
      return _mm256_or_si256(two,
                             _mm256_slli_epi64(_mm256_add_epi64(two, _mm256_set1_epi64x(1)), 32));
    }
    SPH_INLINE Vec pick(const double *from, Indices indices)
    {
      return _mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(load(from)), indices));
    }
    SPH_INLINE Vec square_root(Vec a)
    {
      return _mm256_sqrt_pd(a);
    }
    SPH_INLINE Vec smaller(Vec a, Vec b)
    {
      return _mm256_min_pd(a, b);
    }
    SPH_INLINE Vec larger(Vec a, Vec b)
    {
      return _mm256_max_pd(a, b);
    }
    SPH_INLINE Vec if_positive(Vec a, Vec value)
    {
      return _mm256_and_pd(_mm256_cmp_pd(a, _mm256_setzero_pd(), _CMP_GT_OQ), value);
    }
    SPH_INLINE int bits_below(Vec a, Vec bound)
    {
      return _mm256_movemask_pd(_mm256_cmp_pd(a, bound, _CMP_LT_OQ));
    }

    // PACK[bits]: order of the lanes, those with their bit set first, each lane as a pair of 32-bit halves

    alignas(32) constexpr int PACK[16][8] = {
        {0, 1, 2, 3, 4, 5, 6, 7}, {0, 1, 2, 3, 4, 5, 6, 7}, {2, 3, 0, 1, 4, 5, 6, 7},
        {0, 1, 2, 3, 4, 5, 6, 7}, {4, 5, 0, 1, 2, 3, 6, 7}, {0, 1, 4, 5, 2, 3, 6, 7},
        {2, 3, 4, 5, 0, 1, 6, 7}, {0, 1, 2, 3, 4, 5, 6, 7}, {6, 7, 0, 1, 2, 3, 4, 5},
        {0, 1, 6, 7, 2, 3, 4, 5}, {2, 3, 6, 7, 0, 1, 4, 5}, {0, 1, 2, 3, 6, 7, 4, 5},
        {4, 5, 6, 7, 0, 1, 2, 3}, {0, 1, 4, 5, 6, 7, 2, 3}, {2, 3, 4, 5, 6, 7, 0, 1},
        {0, 1, 2, 3, 4, 5, 6, 7}};

    SPH_INLINE void pack(double *to, Vec a, int bits)
    {
      const __m256i order = _mm256_load_si256(reinterpret_cast<const __m256i *>(PACK[bits]));
      const __m256 packed = _mm256_permutevar8x32_ps(_mm256_castpd_ps(a), order);
      _mm256_storeu_pd(to, _mm256_castps_pd(packed));
    }
    // PACK_BYTES[bits]: order of the 32-bit lanes, those with their bit set first, byte by byte

    struct PackBytes {
      alignas(16) unsigned char order[16][16];
      constexpr PackBytes() : order()
      {
        for (int bits = 0; bits < 16; bits++)
          for (int lane = 0, n = 0; lane < 4; lane++) {
            if (!((bits >> lane) & 1)) continue;
            for (int byte = 0; byte < 4; byte++)
              order[bits][4 * n + byte] = static_cast<unsigned char>(4 * lane + byte);
            n++;
          }
      }
    };
    constexpr PackBytes PACK_BYTES;

    SPH_INLINE void pack(Offset *to, const Offset *from, int bits)
    {
      const __m128i order =
          _mm_load_si128(reinterpret_cast<const __m128i *>(PACK_BYTES.order[bits]));
      const __m128i a = _mm_loadu_si128(reinterpret_cast<const __m128i *>(from));
      _mm_storeu_si128(reinterpret_cast<__m128i *>(to), _mm_shuffle_epi8(a, order));
    }
    SPH_INLINE void copy_neighbors(Offset *to, const int *from, int n, int fill)
    {
      const __m128i lanes = _mm_setr_epi32(0, 1, 2, 3), bits = _mm_set1_epi32(NEIGHMASK);
      int k = 0;
      for (; k + LANES <= n; k += LANES) {
        const __m128i j = _mm_loadu_si128(reinterpret_cast<const __m128i *>(from + k));
        _mm_storeu_si128(reinterpret_cast<__m128i *>(to + k),
                         _mm_slli_epi32(_mm_and_si128(j, bits), 3));
      }
      const __m128i there = _mm_cmpgt_epi32(_mm_set1_epi32(n - k), lanes);
      const __m128i j = _mm_and_si128(_mm_maskload_epi32(from + k, there), bits);
      const __m128i fills = _mm_add_epi32(_mm_set1_epi32(fill), lanes);
      _mm_storeu_si128(reinterpret_cast<__m128i *>(to + k),
                       _mm_slli_epi32(_mm_blendv_epi8(fills, j, there), 3));
    }
    SPH_INLINE double sum(Vec a)
    {
      const __m128d pair = _mm256_castpd256_pd128(a) + _mm256_extractf128_pd(a, 1);
      return _mm_cvtsd_f64(pair) + _mm_cvtsd_f64(_mm_unpackhi_pd(pair, pair));
    }

    constexpr int FLOATS = 8;
    typedef __m256 Floats;

    SPH_INLINE Floats all_floats(float a)
    {
      return _mm256_set1_ps(a);
    }
    SPH_INLINE Floats load_floats(const float *from)
    {
      return _mm256_loadu_ps(from);
    }
    SPH_INLINE void store_floats(float *to, Vec a)
    {
      _mm_storeu_ps(to, _mm256_cvtpd_ps(a));
    }
    SPH_INLINE int bits_below(Floats a, Floats bound)
    {
      return _mm256_movemask_ps(_mm256_cmp_ps(a, bound, _CMP_LT_OQ));
    }

    SPH_INLINE void copy_indices(int *to, const int *from, int n)
    {
      for (int k = 0; k < n; k += FLOATS)
        _mm256_storeu_si256(reinterpret_cast<__m256i *>(to + k),
                            _mm256_loadu_si256(reinterpret_cast<const __m256i *>(from + k)));
    }

    // PACK_8[bits]: order of the 32-bit lanes of 256 bits, those with their bit set first

    struct Pack8 {
      alignas(8) unsigned char lane[256][8];
      constexpr Pack8() : lane()
      {
        for (int bits = 0; bits < 256; bits++)
          for (int l = 0, n = 0; l < 8; l++)
            if ((bits >> l) & 1) lane[bits][n++] = static_cast<unsigned char>(l);
      }
    };
    constexpr Pack8 PACK_8;

    SPH_INLINE void pack_indices(int *to, const int *from, int bits)
    {
      const __m128i lanes = _mm_loadl_epi64(reinterpret_cast<const __m128i *>(PACK_8.lane[bits]));
      const __m256i a = _mm256_loadu_si256(reinterpret_cast<const __m256i *>(from));
      _mm256_storeu_si256(reinterpret_cast<__m256i *>(to),
                          _mm256_permutevar8x32_epi32(a, _mm256_cvtepu8_epi32(lanes)));
    }

    SPH_INLINE void transpose(Vec &a, Vec &b, Vec &c, Vec &d)
    {
      const Vec ab_even = _mm256_unpacklo_pd(a, b), cd_even = _mm256_unpacklo_pd(c, d);
      const Vec ab_odd = _mm256_unpackhi_pd(a, b), cd_odd = _mm256_unpackhi_pd(c, d);
      a = _mm256_permute2f128_pd(ab_even, cd_even, 0x20);
      b = _mm256_permute2f128_pd(ab_odd, cd_odd, 0x20);
      c = _mm256_permute2f128_pd(ab_even, cd_even, 0x31);
      d = _mm256_permute2f128_pd(ab_odd, cd_odd, 0x31);
    }

    template <int N> SPH_INLINE void load_4_columns(const double *row, const Offset *i, Vec *column)
    {
      for (int l = 0; l < LANES; l++) column[l] = load(at<N>(row, i[l]));
      transpose(column[0], column[1], column[2], column[3]);
    }

    template <int N> SPH_INLINE void load_2_columns(const double *row, const Offset *i, Vec *column)
    {
      const Vec even =
          _mm256_set_m128d(_mm_loadu_pd(at<N>(row, i[2])), _mm_loadu_pd(at<N>(row, i[0])));
      const Vec odd =
          _mm256_set_m128d(_mm_loadu_pd(at<N>(row, i[3])), _mm_loadu_pd(at<N>(row, i[1])));
      column[0] = _mm256_unpacklo_pd(even, odd);
      column[1] = _mm256_unpackhi_pd(even, odd);
    }

    template <int N> SPH_INLINE void add_4_columns(double *row, const Offset *i, const Vec *column)
    {
      Vec r[4] = {column[0], column[1], column[2], column[3]};
      transpose(r[0], r[1], r[2], r[3]);
      for (int l = 0; l < LANES; l++) {
        double *const to = at<N>(row, i[l]);
        store(to, load(to) + r[l]);
      }
    }

    template <int N> SPH_INLINE void add_2_columns(double *row, const Offset *i, const Vec *column)
    {
      const Vec even = _mm256_unpacklo_pd(column[0], column[1]);
      const Vec odd = _mm256_unpackhi_pd(column[0], column[1]);
      add_128(at<N>(row, i[0]), _mm256_castpd256_pd128(even));
      add_128(at<N>(row, i[1]), _mm256_castpd256_pd128(odd));
      add_128(at<N>(row, i[2]), _mm256_extractf128_pd(even, 1));
      add_128(at<N>(row, i[3]), _mm256_extractf128_pd(odd, 1));
    }

#else

    constexpr int LANES = 1;
    typedef double Vec;

    SPH_INLINE Vec all(double a)
    {
      return a;
    }
    SPH_INLINE Vec load(const double *from)
    {
      return *from;
    }
    SPH_INLINE void store(double *to, Vec a)
    {
      *to = a;
    }
    SPH_INLINE Vec gather(const double *from, const Offset *i)
    {
      return *at<1>(from, *i);
    }
    typedef int Indices;
    SPH_INLINE Indices indices_of(const int *, const Offset *)
    {
      return 0;
    }
    SPH_INLINE Vec pick(const double *from, Indices)
    {
      return *from;
    }
    SPH_INLINE Vec square_root(Vec a)
    {
      return std::sqrt(a);
    }
    SPH_INLINE Vec smaller(Vec a, Vec b)
    {
      return (a < b) ? a : b;
    }
    SPH_INLINE Vec larger(Vec a, Vec b)
    {
      return (a < b) ? b : a;
    }
    SPH_INLINE Vec if_positive(Vec a, Vec value)
    {
      return (a > 0.0) ? value : 0.0;
    }
    SPH_INLINE int bits_below(Vec a, Vec bound)
    {
      return (a < bound) ? 1 : 0;
    }
    SPH_INLINE void pack(double *to, Vec a, int)
    {
      *to = a;
    }
    SPH_INLINE void pack(Offset *to, const Offset *from, int)
    {
      *to = *from;
    }
    SPH_INLINE void copy_neighbors(Offset *to, const int *from, int n, int)
    {
      for (int k = 0; k < n; k++) to[k] = offset_of(from[k] & NEIGHMASK);
    }
    SPH_INLINE int count_bits(int bits)
    {
      return bits;
    }
    SPH_INLINE double sum(Vec a)
    {
      return a;
    }
    SPH_INLINE void prefetch(const void *) {}

    constexpr int FLOATS = 1;
    typedef float Floats;

    SPH_INLINE Floats all_floats(float a)
    {
      return a;
    }
    SPH_INLINE Floats load_floats(const float *from)
    {
      return *from;
    }
    SPH_INLINE void store_floats(float *to, Vec a)
    {
      *to = static_cast<float>(a);
    }
    SPH_INLINE int bits_below(Floats a, Floats bound)
    {
      return (a < bound) ? 1 : 0;
    }
    SPH_INLINE void copy_indices(int *to, const int *from, int n)
    {
      for (int k = 0; k < n; k++) to[k] = from[k];
    }
    SPH_INLINE void pack_indices(int *to, const int *from, int)
    {
      *to = *from;
    }

    template <int N> SPH_INLINE void load_4_columns(const double *row, const Offset *i, Vec *column)
    {
      for (int c = 0; c < 4; c++) column[c] = at<N>(row, *i)[c];
    }
    template <int N> SPH_INLINE void load_2_columns(const double *row, const Offset *i, Vec *column)
    {
      for (int c = 0; c < 2; c++) column[c] = at<N>(row, *i)[c];
    }
    template <int N> SPH_INLINE void add_4_columns(double *row, const Offset *i, const Vec *column)
    {
      for (int c = 0; c < 4; c++) at<N>(row, *i)[c] += column[c];
    }
    template <int N> SPH_INLINE void add_2_columns(double *row, const Offset *i, const Vec *column)
    {
      for (int c = 0; c < 2; c++) at<N>(row, *i)[c] += column[c];
    }

#endif

    // One version for all instruction sets

    template <int N> SPH_INLINE void add_column(double *row, const Offset *i, Vec column)
    {
      double lane[LANES];
      store(lane, column);
      for (int l = 0; l < LANES; l++) *at<N>(row, i[l]) += lane[l];
    }

  }    // namespace LOOPS
}    // namespace SPHDissipation
}    // namespace LAMMPS_NS
