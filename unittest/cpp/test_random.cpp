/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// The random numbers of the thermal noise: known answers, distribution, independence.

#include "sph_dissipation_noise_data.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

// the header is written for vectors of any width; here, of one number

#define LOOPS one_number
#define NEIGHMASK 0x1FFFFFFF
typedef std::int64_t bigint;
#include "sph_dissipation_rows.h"
#include "sph_dissipation_simd.h"
#include "sph_dissipation_words.h"
namespace LAMMPS_NS {
namespace SPHDissipation {
  namespace one_number {
#include "sph_dissipation_random.h"
  }
}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

using namespace LAMMPS_NS::SPHDissipation::one_number;

static std::array<Words, 4> random_words(std::array<Words, 4> counter, Words key0, Words key1)
{
  Words word[2][4] = {{1, 2, 3, 4}, {counter[0], counter[1], counter[2], counter[3]}};
  philox<2>(word, PhiloxKeys(key0, key1));
  for (Words &one : word[1]) one &= 0xffffffff;
  return {word[1][0], word[1][1], word[1][2], word[1][3]};
}

// of Random123, file kat_vectors, philox4x32 7

TEST(Random, known_answers)
{
  using Answer = std::array<Words, 4>;
  EXPECT_EQ(random_words({0, 0, 0, 0}, 0, 0),
            (Answer{0x5f6fb709, 0x0d893f64, 0x4f121f81, 0x4f730a48}));
  const Words ones = 0xffffffff;
  EXPECT_EQ(random_words({ones, ones, ones, ones}, ones, ones),
            (Answer{0x5207ddc2, 0x45165e59, 0x4d8ee751, 0x8c52f662}));
  EXPECT_EQ(random_words({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, 0xa4093822, 0x299f31d0),
            (Answer{0x4dfccaba, 0x190a87f0, 0xc47362ba, 0xb6b5242a}));
}

TEST(Random, bits_above_32_do_not_count)
{
  const Words high = 0x1234567800000000;
  EXPECT_EQ(random_words({1 + high, 2 + high, 3 + high, 4 + high}, 5 + high, 6 + high),
            random_words({1, 2, 3, 4}, 5, 6));
}

TEST(Random, uniform_distribution)
{
  const double edge = std::sqrt(3.0);
  EXPECT_GT(uniform(0, 1.0), -edge);
  EXPECT_LT(uniform(0xffffffff, 1.0), edge);
  for (const Words word : {0u, 1u, 77u, 0x7fffffffu, 0xfffffffeu, 0xffffffffu}) {
    EXPECT_NEAR(uniform(word, 1.0), edge * (2.0 * (word + 0.5) / 4294967296.0 - 1.0), 1e-15);
    EXPECT_NEAR(uniform(0xffffffff - word, 1.0), -uniform(word, 1.0), 1e-15);
  }
}

// half a word: as few as 65536 numbers, whose mean and variance are exact

TEST(Random, uniform_distribution_of_half_a_word)
{
  long double mean = 0.0L, square = 0.0L;
  for (Words word = 0; word < 65536; word++) {
    const double z = uniform_of_half(word, 1.0);
    EXPECT_NEAR(uniform_of_half(65535 - word, 1.0), -z, 1e-9);
    EXPECT_EQ(uniform_of_half(word, -1.0), -z);
    mean += z / 65536.0L;
    square += z * (z / 65536.0L);
  }
  EXPECT_NEAR(mean, 0.0, 1e-9);
  EXPECT_NEAR(square, 1.0, 1e-15);
}

TEST(Random, words_and_numbers)
{
  for (const double a : {0.0, 1.0, 4294967295.0, 4294967296.0, 70368744177663.0}) {
    EXPECT_EQ(words(a), static_cast<Words>(a));
    EXPECT_EQ(middle(words(a), 0xffffffffffff) - 0.5, a);
  }
}

// numbers of a million pairs, counters as in the loops: two IDs next to each other, steps in a row

static std::vector<std::array<double, 4>> many_numbers()
{
  std::vector<std::array<double, 4>> numbers;
  for (Words step = 0; step < 10; step++)
    for (Words low = 1; low <= 1000; low++)
      for (Words neighbor = 1; neighbor <= 100; neighbor++) {
        const auto word = random_words({low, low + neighbor, step, 0}, 4711, 1);
        numbers.push_back({uniform(word[0], 1.0), uniform(word[1], 1.0), uniform(word[2], 1.0),
                           uniform(word[3], 1.0)});
      }
  return numbers;
}

TEST(Random, moments_and_correlations_of_a_million_pairs)
{
  const auto numbers = many_numbers();
  const double n = numbers.size();
  ASSERT_EQ(numbers.size(), 1000000u);
  for (int a = 0; a < 4; a++) {
    double mean = 0.0, square = 0.0, cube = 0.0, fourth = 0.0;
    for (const auto &z : numbers) {
      mean += z[a] / n;
      square += z[a] * z[a] / n;
      cube += z[a] * z[a] * z[a] / n;
      fourth += z[a] * z[a] * z[a] * z[a] / n;
    }
    // four standard errors: z^2, z^4, z^6, z^8 of the uniform distribution have the means 1, 9/5, 27/7, 9
    EXPECT_NEAR(mean, 0.0, 4.0 * std::sqrt(1.0 / n));
    EXPECT_NEAR(square, 1.0, 4.0 * std::sqrt((9.0 / 5.0 - 1.0) / n));
    EXPECT_NEAR(cube, 0.0, 4.0 * std::sqrt(27.0 / 7.0 / n));
    EXPECT_NEAR(fourth, 9.0 / 5.0, 4.0 * std::sqrt((9.0 - 81.0 / 25.0) / n));
  }

  // between the numbers of a pair and those of the next pair, of the same pair one step later, and of
  // the neighboring particle

  auto correlation = [&](int a, int b, std::size_t offset, bool squares) {
    double sum = 0.0;
    for (std::size_t k = 0; k + offset < numbers.size(); k++) {
      const double x = numbers[k][a], y = numbers[k + offset][b];
      sum += squares ? 1.25 * (x * x - 1.0) * (y * y - 1.0) : x * y;
    }
    return sum / (n - offset);
  };
  for (int a = 0; a < 4; a++)
    for (int b = 0; b < 4; b++)
      for (const std::size_t offset : {0, 1, 100, 100000})
        if (a != b || offset > 0)
          for (const bool squares : {false, true})
            EXPECT_NEAR(correlation(a, b, offset, squares), 0.0, 4.0 / std::sqrt(n - offset))
                << a << " " << b << " " << offset << " " << squares;
}
