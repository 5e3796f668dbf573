/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// A list of states with one more, and a list of flows with one more, which nothing but its struct tells.

#include "sph_dissipation_channels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace LAMMPS_NS::SPHDissipation;

struct Solute : BaseState {
  static constexpr const char *NAME = "solute", *FIELD = "solute", *KEYWORD = "solute";
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

using Three =
    ListOf<BaseState, StateList<>, BulkChannel, RelaxChannel, VibrationChannel, Solute>::type;

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
  EXPECT_EQ(Three::MOST, RelaxChannel::MOST + VibrationChannel::MOST + 1);
  const std::vector<StateInfo> table = Three::table<TypeCoeffs>();
  ASSERT_EQ(table.size(), 3u);
  EXPECT_STREQ(table[2].field, "solute");
  EXPECT_TRUE(table[2].has_column() && table[2].ghosts);
  EXPECT_EQ(table[0].most, RelaxChannel::MOST);
  EXPECT_EQ(table[1].first, RelaxChannel::MOST);
  EXPECT_FALSE(table[1].has_column());
  EXPECT_EQ(table[1].owner, 0);

  // with coefficients of all channels
  const TypeCoeffs type = coefficients(2, true, 0.0).type;
  EXPECT_EQ(table[0].count(type.a), 2);
  EXPECT_EQ(table[1].count(type.a), 1);
  EXPECT_EQ(table[0].time(type.a, 1), RelaxChannel::time(type.of<RelaxChannel>(), 1));
  EXPECT_EQ(table[2].time, nullptr);
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
  EXPECT_NEAR(handed_on(strain, 2.0, 4.0, 3.0), std::log(1.5), 1e-15);
  EXPECT_NEAR(taken_over(strain, 2.0, 4.0, 0.5), -std::exp(-0.5), 1e-15);
  EXPECT_EQ(taken_over(strain, 0.0, 4.0, 0.5), 0.0);
  EXPECT_EQ(rescaled(strain, 2.0, 3.0), 6.0);
  EXPECT_EQ(rescaled(strain, -0.9, 3.0), -0.9);
  EXPECT_EQ(handed_on(mean, 2.0, 4.0, 3.0), 2.0);
  EXPECT_EQ(taken_over(mean, 2.0, 4.0, 3.0), 3.0);
  EXPECT_EQ(handed_on(sum, 2.0, 4.0, 3.0), 0.5);
  EXPECT_EQ(taken_over(sum, 2.0, 4.0, 3.0), 12.0);
  EXPECT_EQ(rescaled(mean, 2.0, 3.0), 2.0);
  EXPECT_EQ(rescaled(sum, 2.0, 3.0), 6.0);
  EXPECT_EQ(rescaled(sum, -2.0, 3.0), -6.0);    // an extensive state may be negative
}

/* ---------------------------------------------------------------------- */

struct Dye : FlowingState {
  static constexpr const char *NAME = "dye", *FIELD = "dye", *KEYWORD = "dye";
  static int count(const double *diffusivity) { return *diffusivity > 0.0 ? 1 : 0; }
  static double coefficient(const double *diffusivity, double rho0) { return rho0 * *diffusivity; }
};

using Two = ListOf<BaseFlow, FlowList<>, BulkChannel, HeatChannel, RelaxChannel, Dye>::type;
using WithDye = ListOf<BaseState, StateList<>, HeatChannel, Dye>::type;

struct DyeCoeffs {
  TypeCoeffs type;
  double diffusivity = 0.3;

  template <class Channel> const double *of() const
  {
    if constexpr (std::is_same<Channel, Dye>::value)
      return &diffusivity;
    else
      return type.of<Channel>();
  }
};

struct DyeRows {
  WithDye::Numbers own = WithDye::numbers(DyeCoeffs(), 2.0, 1.0, 0.1);
  double amount = 6.0, mass = 4.0, *state[WithDye::MOST] = {&amount}, *rmass = &mass;

  const WithDye::Numbers &numbers(int) const { return own; }
  double temperature(int) const { return 7.0; }
  template <class Channel> double state_of(int i) const { return state[0][i]; }
  template <class Channel> double rate_of(int) const { return -20.0; }
};

TEST(Flows, list)
{
  EXPECT_EQ(Two::NUMBER, 2);
  EXPECT_EQ(Two::in_pass_2(), 1);
  DyeCoeffs type;
  type.type.a[Channels::first_of_type<HeatChannel>() + HeatChannel::CONDUCTIVITY] = 5.0;
  double coefficient[2];
  Two::coefficients(type, 2.0, coefficient);
  EXPECT_EQ(coefficient[0], 5.0);
  EXPECT_EQ(coefficient[1], 0.6);
  EXPECT_EQ(WithDye::table<TypeCoeffs>()[0].kind, StateKind::EXTENSIVE);

  DyeRows rows;
  for (const int bits : {1, 2, 3}) {
    std::vector<double> values;
    Two::visit(bits, [&](auto channel, int) {
      values.push_back(channel.value(FlowSite<DyeRows, decltype(channel)>{rows, 0}));
    });
    EXPECT_EQ(values,
              (bits == 1       ? std::vector<double>{7.0}
                   : bits == 2 ? std::vector<double>{1.5}
                               : std::vector<double>{7.0, 1.5}));
  }
}

// the integrator adds the rate of the last forces, times the time step

TEST(Flows, state)
{
  DyeRows rows;
  WithDye::each(rows, 0, [&](auto channel, const auto &site) {
    channel.advance(site, 0.0, 0.0);
  });
  EXPECT_EQ(rows.amount, 4.0);
}
