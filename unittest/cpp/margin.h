/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// How near the deviations of a test program are to their tolerances, printed at its end. CMake
// includes this file in front of every source of the tests: EXPECT_NEAR, EXPECT_LT and EXPECT_LE
// compare as those of GoogleTest, and record the largest ratio of each place. conftest.py does the
// same for the Python tests.
//
// Only tolerances of round-off are recorded: these deviations are others on another processor.
// Errors of a method are the same everywhere.

#ifndef SPHD_MARGIN_H
#define SPHD_MARGIN_H

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <type_traits>

namespace Margin {

constexpr double ROUND_OFF = 2.0e-7, ROOM = 4.0;

struct Worst {
  double ratio, tolerance;
};
inline std::map<std::string, Worst> worst;    // by place

class Printer : public ::testing::Environment {
 public:
  void TearDown() override
  {
    const Worst *nearest = nullptr;
    for (const auto &[place, one] : worst) {
      if (!nearest || one.ratio > nearest->ratio) nearest = &one;
      if (one.ratio * ROOM > 1.0)
        printf("less than a factor of %g of room: %.2g of the tolerance %.1e, %s\n", ROOM,
               one.ratio, one.tolerance, place.c_str());
    }
    if (nearest) printf("largest deviation: %.2g of its tolerance\n", nearest->ratio);
  }
};
inline const auto *const printer = ::testing::AddGlobalTestEnvironment(new Printer);

inline void note(double deviation, double tolerance, const char *file, int line)
{
  if (!(tolerance > 0.0) || tolerance >= ROUND_OFF || !(deviation >= 0.0)) return;
  std::string place = file;
  place = place.substr(place.find_last_of('/') + 1) + ":" + std::to_string(line);
  auto &one = worst.emplace(place, Worst{-1.0, 0.0}).first->second;
  if (deviation / tolerance > one.ratio) one = {deviation / tolerance, tolerance};
}

inline auto near(const char *file, int line)
{
  return [=](const char *a_text, const char *b_text, const char *tolerance_text, double a, double b,
             double tolerance) {
    note(std::fabs(a - b), tolerance, file, line);
    return ::testing::internal::DoubleNearPredFormat(a_text, b_text, tolerance_text, a, b,
                                                     tolerance);
  };
}

template <class A, class B> void note_less(const A &a, const B &b, const char *file, int line)
{
  if constexpr (std::is_floating_point_v<A> && std::is_floating_point_v<B>)
    note(static_cast<double>(a), static_cast<double>(b), file, line);
}

inline auto less(const char *file, int line)
{
  return [=](const char *a_text, const char *b_text, const auto &a, const auto &b) {
    note_less(a, b, file, line);
    return ::testing::internal::CmpHelperLT(a_text, b_text, a, b);
  };
}

inline auto less_or_equal(const char *file, int line)
{
  return [=](const char *a_text, const char *b_text, const auto &a, const auto &b) {
    note_less(a, b, file, line);
    return ::testing::internal::CmpHelperLE(a_text, b_text, a, b);
  };
}

}    // namespace Margin

#undef EXPECT_NEAR
#undef EXPECT_LT
#undef EXPECT_LE
#define EXPECT_NEAR(a, b, tolerance) \
  EXPECT_PRED_FORMAT3(Margin::near(__FILE__, __LINE__), a, b, tolerance)
#define EXPECT_LT(a, b) EXPECT_PRED_FORMAT2(Margin::less(__FILE__, __LINE__), a, b)
#define EXPECT_LE(a, b) EXPECT_PRED_FORMAT2(Margin::less_or_equal(__FILE__, __LINE__), a, b)

#endif
