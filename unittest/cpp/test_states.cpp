/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// A list of states with one more, which nothing but its struct tells.

#include "sph_dissipation_channels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace LAMMPS_NS::SPHDissipation;

struct Solute : BaseState {
  static constexpr const char *FIELD = "solute", *KEYWORD = "solute";
  static constexpr StateKind KIND = StateKind::EXTENSIVE;
  static constexpr bool GHOSTS = true, READS_RATE = true;
  struct Numbers {
    double modulus;
  };
  static int count(const double *modulus) { return *modulus > 0.0 ? 1 : 0; }
  static Numbers process(const double *modulus, int, double rho0, double, double dt)
  {
    return {*modulus * rho0 * dt};
  }
  static double noise(const Numbers &own) { return 10.0 * own.modulus; }
  template <class Site> static double pressure(const Site &site)
  {
    return site.own.modulus * site.state();
  }
};

using Three = WithState<StateList<>, BulkChannel, RelaxChannel, VibrationChannel, Solute>::type;

// coefficients of a type, with that of the solute

struct Coeffs {
  TypeCoeffs type;
  double modulus = 0.0;

  template <class Channel> const double *of() const
  {
    if constexpr (std::is_same<Channel, Solute>::value)
      return &modulus;
    else
      return type.of<Channel>();
  }
};

struct Rows {
  Three::Numbers own;
  std::vector<double> values;
  double *state[Three::MOST] = {};
  double mass = 1.0, density = 2.0, *rmass = &mass, *rho = &density;

  Rows(const Coeffs &type, int room) :
      own(Three::numbers(type, 2.0, 1.0, 0.1)), values(Three::MOST, 0.0)
  {
    for (int k = 0; k < Three::MOST; k++)
      if (k < room || k >= RelaxChannel::MOST) state[k] = &values[k];
  }
  const Three::Numbers &numbers(int) const { return own; }
};

static Coeffs coefficients(int nprocess, bool vibrates, double modulus)
{
  Coeffs own;
  double *const relax = own.type.a + Channels::first_of_type<RelaxChannel>();
  for (int k = 0; k < nprocess; k++) {
    relax[RelaxChannel::GROUP * k + RelaxChannel::KAPPA_R] = 3.0;
    relax[RelaxChannel::GROUP * k + RelaxChannel::TAU] = 0.5;
  }
  double *const vibration = own.type.a + Channels::first_of_type<VibrationChannel>();
  vibration[VibrationChannel::CVIB] = vibrates ? 1.0 : 0.0;
  vibration[VibrationChannel::TAU] = 1.0;
  own.modulus = modulus;
  return own;
}

/* ---------------------------------------------------------------------- */

TEST(States, list)
{
  EXPECT_EQ(Three::MOST, States::MOST + 1);
  const StateInfo &last = Three::info(Three::MOST - 1);
  EXPECT_STREQ(last.field, "solute");
  EXPECT_TRUE(last.has_column() && last.ghosts);
  EXPECT_STREQ(Three::info(0).field, Three::info(7).field);
  EXPECT_FALSE(Three::info(8).has_column());
  EXPECT_EQ(Three::info(8).owner, 0);
  EXPECT_TRUE(Three::numbers(coefficients(0, false, 1.0), 2.0, 1.0, 0.1).read_rate());
  EXPECT_FALSE(Three::numbers(coefficients(2, false, 0.0), 2.0, 1.0, 0.1).read_rate());
  EXPECT_FALSE(Three::numbers(coefficients(0, false, 0.0), 2.0, 1.0, 0.1).any());
}

TEST(States, each_state_of_a_type)
{
  Rows rows(coefficients(2, true, 4.0), 3);
  rows.values = {1.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 7.0, 5.0};
  std::vector<int> places;
  double pressure = 0.0;
  Three::each(rows, 0, [&](auto channel, const auto &site) {
    places.push_back(site.slot);
    pressure += channel.pressure(site);
  });
  EXPECT_EQ(places, (std::vector<int>{0, 1, 8, 9}));
  const double stiffness = 3.0 / 2.0 / 0.5 * -std::expm1(-0.2) / 0.2;
  EXPECT_NEAR(pressure, stiffness * (std::log(2.0) + std::log(0.5)) + 0.8 * 5.0, 1e-14);
  EXPECT_NEAR(Three::noise(rows.own, 1), -std::sqrt(0.2 / 1.5), 1e-15);
  EXPECT_EQ(Three::noise(rows.own, 2), 0.0);
  EXPECT_EQ(Three::noise(rows.own, 8), 0.0);
  EXPECT_DOUBLE_EQ(Three::noise(rows.own, 9), 8.0);
}

// what a type does not have is dropped; -1, from a data file, is in the last column that the type does not need

TEST(States, keep)
{
  Rows rows(coefficients(1, true, 0.0), 3);
  rows.values = {1.5, 0.0, 0.7, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0};
  EXPECT_FALSE(Three::keep(rows, 0));
  EXPECT_EQ(rows.values, (std::vector<double>{1.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.7, 0.0}));
  EXPECT_FALSE(Three::keep(rows, 0));
  rows.values[9] = 3.0;
  EXPECT_TRUE(Three::keep(rows, 0));
  EXPECT_EQ(rows.values[9], 0.0);

  Rows other(coefficients(1, false, 1.0), 2);
  other.values = {1.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 2.0};
  EXPECT_FALSE(Three::keep(other, 0));
  EXPECT_EQ(other.values[8], 0.0);
  other.values[1] = 0.3;
  EXPECT_TRUE(Three::keep(other, 0));
  EXPECT_EQ(other.values, (std::vector<double>{1.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0}));
}

TEST(States, kinds)
{
  const auto strain = StateKind::STRAIN, mean = StateKind::PER_MASS, sum = StateKind::EXTENSIVE;
  EXPECT_NEAR(handed_on(strain, 2.0, 3.0), std::log(1.5), 1e-15);
  EXPECT_NEAR(taken_over(strain, 2.0, 0.5), -std::exp(-0.5), 1e-15);
  EXPECT_EQ(taken_over(strain, 0.0, 0.5), 0.0);
  EXPECT_EQ(rescaled(strain, 2.0, 3.0), 6.0);
  EXPECT_EQ(rescaled(strain, -0.9, 3.0), -0.9);
  for (const auto kind : {mean, sum}) {
    EXPECT_EQ(handed_on(kind, 2.0, 3.0), 2.0);
    EXPECT_EQ(taken_over(kind, 2.0, 3.0), 3.0);
  }
  EXPECT_EQ(rescaled(mean, 2.0, 3.0), 2.0);
  EXPECT_EQ(rescaled(sum, 2.0, 3.0), 6.0);
  EXPECT_EQ(rescaled(sum, -2.0, 3.0), -6.0);    // an extensive state may be negative
}
