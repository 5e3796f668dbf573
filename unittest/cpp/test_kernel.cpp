/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "sph_dissipation_kernel.h"

#include "quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace LAMMPS_NS::SPHDissipation;

static constexpr Kernel KERNELS[] = {Kernel::WENDLAND_C2, Kernel::WENDLAND_C4, Kernel::WENDLAND_C6,
                                     Kernel::CUBIC,       Kernel::QUINTIC,     Kernel::LUCY};

static const long double PI = std::acos(-1.0L);
static constexpr double R = 1.7;

// a multiple of 6 makes the panels end where the pieces of the splines do

static constexpr int PANELS = 240;

// integral over space of a function of the distance

template <class Function> static long double space_integral(int n, const Function &f)
{
  const long double sphere[3] = {2.0L, 2.0L * PI, 4.0L * PI};
  return sphere[n - 1] *
      quadrature(
             [&](long double r) {
               return std::pow(r, n - 1.0L) * f(r);
             },
             0.0L, R, PANELS);
}

template <class Function> static void for_every_kernel(const Function &f)
{
  for (const Kernel kernel : KERNELS) {
    for (int n = 1; n <= 3; n++) {
      SCOPED_TRACE(std::string(kernel_name(kernel)) + " n = " + std::to_string(n));
      f(kernel, n);
    }
  }
}

/* ---------------------------------------------------------------------- */

TEST(Kernel, names)
{
  const char *names[] = {"wendland/c2", "wendland/c4", "wendland/c6", "cubic", "quintic", "lucy"};
  for (int k = 0; k < 6; k++) EXPECT_STREQ(kernel_name(KERNELS[k]), names[k]);
}

TEST(Kernel, integral_is_one)
{
  for_every_kernel([](Kernel kernel, int n) {
    const auto W = [=](long double r) {
      return kernel_weight(kernel, n, r, R);
    };
    EXPECT_NEAR(space_integral(n, W), 1.0L, 1e-13L);
  });
}

TEST(Kernel, second_moment_of_slope_is_dimension)
{
  for_every_kernel([](Kernel kernel, int n) {
    const auto Frr = [=](long double r) {
      return r * r * kernel_slope(kernel, n, r, R);
    };
    EXPECT_NEAR(space_integral(n, Frr), n, 1e-13L * n);
  });
}

// W is the integral of r F from r to the support, to round-off

TEST(Kernel, weight_is_integral_of_slope)
{
  for_every_kernel([](Kernel kernel, int n) {
    const double size = kernel_weight(kernel, n, 0.0, R);
    for (int k = 0; k < 12; k++) {
      const long double r = k * static_cast<long double>(R) / 12.0L;
      const auto rF = [=](long double s) {
        return s * kernel_slope(kernel, n, s, R);
      };
      EXPECT_NEAR(quadrature(rF, r, R, 20 * (12 - k)), kernel_weight(kernel, n, r, R),
                  1e-14 * size);
    }
  });
}

TEST(Kernel, slope_by_finite_differences)
{
  for_every_kernel([](Kernel kernel, int n) {
    const double size = kernel_slope(kernel, n, 0.0, R), step = 2e-4;
    const auto W = [=](double r) {
      return kernel_weight(kernel, n, r, R);
    };
    // far enough from the joints of the splines, at multiples of R/6, for the five-point formula
    for (double q = 0.02; q < 1.0; q += 1.0 / 24.0) {
      const double r = q * R;
      const double derivative =
          (8.0 * (W(r + step) - W(r - step)) - (W(r + 2.0 * step) - W(r - 2.0 * step))) /
          (12.0 * step);
      EXPECT_NEAR(kernel_slope(kernel, n, r, R), -derivative / r, 1e-9 * size) << "q = " << q;
    }
  });
}

TEST(Kernel, slope_is_finite_at_zero_and_positive_inside)
{
  for_every_kernel([](Kernel kernel, int n) {
    const double at_zero = kernel_slope(kernel, n, 0.0, R);
    EXPECT_TRUE(std::isfinite(at_zero));
    EXPECT_NEAR(kernel_slope(kernel, n, 1e-10 * R, R), at_zero, 1e-8 * at_zero);
    for (int k = 0; k < 1000; k++) EXPECT_GT(kernel_slope(kernel, n, k * R / 1000.0, R), 0.0);
  });
}

TEST(Kernel, zero_from_the_support_on)
{
  for_every_kernel([](Kernel kernel, int n) {
    for (const double r : {R, 1.0000001 * R, 2.0 * R, 100.0 * R}) {
      EXPECT_EQ(kernel_weight(kernel, n, r, R), 0.0);
      EXPECT_EQ(kernel_slope(kernel, n, r, R), 0.0);
    }
    const double size = kernel_slope(kernel, n, 0.0, R);
    EXPECT_LT(kernel_slope(kernel, n, 0.99999 * R, R), 1e-7 * size);
    EXPECT_LT(kernel_weight(kernel, n, 0.99999 * R, R), 1e-12 * kernel_weight(kernel, n, 0.0, R));
  });
}

TEST(Kernel, pieces_of_the_splines_join)
{
  for (const Kernel kernel : {Kernel::CUBIC, Kernel::QUINTIC}) {
    for (int n = 1; n <= 3; n++) {
      for (const double q : {1.0 / 3.0, 0.5, 2.0 / 3.0}) {
        const double below = R * q * (1.0 - 1e-14), above = R * q * (1.0 + 1e-14);
        EXPECT_NEAR(kernel_weight(kernel, n, below, R), kernel_weight(kernel, n, above, R),
                    1e-12 * kernel_weight(kernel, n, 0.0, R));
        EXPECT_NEAR(kernel_slope(kernel, n, below, R), kernel_slope(kernel, n, above, R),
                    1e-12 * kernel_slope(kernel, n, 0.0, R));
      }
    }
  }
}

TEST(Kernel, scales_with_the_support)
{
  for_every_kernel([](Kernel kernel, int n) {
    const double ratio = kernel_weight(kernel, n, 0.3, 1.0) / kernel_weight(kernel, n, 0.6, 2.0);
    EXPECT_NEAR(ratio, std::pow(2.0, n), 1e-13 * ratio);
    const double slopes = kernel_slope(kernel, n, 0.3, 1.0) / kernel_slope(kernel, n, 0.6, 2.0);
    EXPECT_NEAR(slopes, std::pow(2.0, n + 2), 1e-13 * slopes);
  });
}

/* ---------------------------------------------------------------------- */

TEST(Kernel, mean_radius)
{
  for_every_kernel([](Kernel kernel, int n) {
    const auto rW = [=](long double r) {
      return r * kernel_weight(kernel, n, r, R);
    };
    EXPECT_NEAR(kernel_mean(kernel, n, 1, R), space_integral(n, rW), 1e-13);
  });
}

// eta h / mu of the F r weighting, P1 (49) with h = R/2: 7, 8, 9 for Wendland C2

TEST(Kernel, mean_radius_of_wendland_c2)
{
  for (int n = 1; n <= 3; n++) {
    const double eta =
        2.0 * n * (n + 2) / ((n + 1) * kernel_mean(Kernel::WENDLAND_C2, n, 1, R));
    EXPECT_NEAR(eta * 0.5 * R, 6.0 + n, 1e-13 * (6.0 + n));
  }
}

TEST(Kernel, slope_integral)
{
  for_every_kernel([](Kernel kernel, int n) {
    const auto F = [=](long double r) {
      return kernel_slope(kernel, n, r, R);
    };
    const double integral = kernel_slope_integral(kernel, n, R);
    EXPECT_NEAR(integral, space_integral(n, F), 1e-13 * integral);
  });
}
