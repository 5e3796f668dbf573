/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "sph_dissipation_eos.h"

#include "quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace LAMMPS_NS::SPHDissipation;

static EosParams params(Eos eos, double gamma, double pb, double gruneisen = 0.0,
                        double reference_heat = 0.0)
{
  EosParams par;
  par.rho0 = 1.3;
  par.c0 = 2.1;
  par.pb = pb;
  par.gamma = gamma;
  par.derive(eos, gruneisen, reference_heat);
  return par;
}

/* ---------------------------------------------------------------------- */

TEST(Eos, names_and_default_exponents)
{
  EXPECT_STREQ(eos_name(Eos::LINEAR), "linear");
  EXPECT_STREQ(eos_name(Eos::TAIT), "tait");
  EXPECT_STREQ(eos_name(Eos::IDEAL), "ideal");
  EXPECT_EQ(default_gamma(Eos::TAIT), 7.0);
  EXPECT_EQ(default_gamma(Eos::IDEAL), 1.4);
}

TEST(Eos, pressure_as_numbers)
{
  const double pb = 0.25;
  EXPECT_NEAR(pressure(Eos::LINEAR, params(Eos::LINEAR, 7.0, pb), 1.5, 9.0), 4.41 * 0.2 + 0.25,
              1e-14);
  // 1.3 * 4.41 / 7 = 0.819; 2^7 - 1 = 127
  EXPECT_NEAR(pressure(Eos::TAIT, params(Eos::TAIT, 7.0, pb), 2.6, 9.0), 0.819 * 127.0 + 0.25,
              1e-12);
  const double heat = 9.0 - 0.25 * (1.0 / 1.3 - 1.0 / 1.5);
  EXPECT_NEAR(pressure(Eos::IDEAL, params(Eos::IDEAL, 1.4, pb), 1.5, 9.0), 0.4 * 1.5 * heat + 0.25,
              1e-14);
}

TEST(Eos, background_pressure_at_the_reference_density)
{
  for (const double gamma : {1.4, 3.5, 7.0})
    for (const Eos eos : {Eos::LINEAR, Eos::TAIT})
      EXPECT_NEAR(pressure(eos, params(eos, gamma, -0.6), 1.3, 5.0), -0.6, 1e-14);
}

TEST(Eos, sound_speed_at_the_reference_density)
{
  const double step = 1e-5;
  for (const double gamma : {1.0, 1.4, 3.5, 7.0}) {
    for (const Eos eos : {Eos::LINEAR, Eos::TAIT}) {
      const EosParams par = params(eos, gamma, 0.4);
      const double slope =
          (pressure(eos, par, 1.3 + step, 0.0) - pressure(eos, par, 1.3 - step, 0.0)) /
          (2.0 * step);
      EXPECT_NEAR(slope, 2.1 * 2.1, 1e-7);
    }
  }
}

// p = rho^2 de/drho in integral form, to round-off

TEST(Eos, elastic_energy_is_the_work_of_the_pressure)
{
  for (const double gamma : {1.0, 1.4, 3.5, 7.0}) {
    for (const double pb : {0.0, 0.7, -0.3}) {
      for (const Eos eos : {Eos::LINEAR, Eos::TAIT}) {
        const EosParams par = params(eos, gamma, pb);
        EXPECT_NEAR(elastic_energy(eos, par, par.rho0), 0.0, 1e-15);
        for (const double rho : {0.5, 0.9, 1.2999, 1.3001, 1.7, 2.9}) {
          const auto work = [&](long double s) {
            return pressure(eos, par, s, 0.0) / (s * s);
          };
          const double expected = quadrature(work, 1.3L, rho, 400);
          // the sizes of the terms, which cancel near rho0
          const double x = rho / par.rho0, n = (eos == Eos::LINEAR) ? 1.0 : gamma;
          const double power = (n == 1.0) ? std::fabs(std::log(x))
                                          : (std::pow(x, n - 1.0) + 1.0) / (n - 1.0);
          const double parts = par.c_el * par.c_el / n * (power + 1.0 / x + 1.0) +
              std::fabs(pb) / par.rho0 * (1.0 + 1.0 / x);
          EXPECT_NEAR(elastic_energy(eos, par, rho), expected, 1.5e-15 * parts)
              << eos_name(eos) << " gamma = " << gamma << " rho = " << rho;
        }
      }
    }
  }
}

TEST(Eos, elastic_energy_of_the_ideal_gas_is_that_of_the_background_pressure)
{
  EXPECT_EQ(elastic_energy(Eos::IDEAL, params(Eos::IDEAL, 1.4, 0.0), 1.9), 0.0);
  EXPECT_NEAR(elastic_energy(Eos::IDEAL, params(Eos::IDEAL, 1.4, 0.5), 1.9),
              0.5 * (1.0 / 1.3 - 1.0 / 1.9), 1e-15);
}

// c0 and pb are what the fluid has at rho0 and the reference heat; no heat, no difference

TEST(Eos, reference_state_with_thermal_pressure)
{
  const double q = 0.6, gruneisen = 0.8;
  for (const Eos eos : {Eos::LINEAR, Eos::TAIT}) {
    const EosParams par = params(eos, 7.0, 0.4, gruneisen, q);
    EXPECT_NEAR(pressure(eos, par, 1.3, q), 0.4, 1e-14);
    EXPECT_NEAR(sound_speed(eos, par, 1.3, q), 2.1, 1e-14);
    EXPECT_NEAR(elastic_pressure(eos, par, 1.3), 0.4 - gruneisen * 1.3 * q, 1e-14);
    const EosParams without = params(eos, 7.0, 0.4);
    EXPECT_EQ(without.c_el, without.c0);
    EXPECT_EQ(without.pb_el, without.pb);
    EXPECT_TRUE(std::isnan(params(eos, 7.0, 0.4, 2.0, 1.0).c_el));
  }
}

TEST(Eos, shortcut_of_the_usual_exponent)
{
  for (const double x : {0.1, 0.99, 1.0, 1.01, 3.0})
    EXPECT_NEAR(tait_power(x, 7.0), std::pow(x, 7.0), 1e-15 * std::pow(x, 7.0));
  EXPECT_EQ(tait_power(1.7, 2.5), std::pow(1.7, 2.5));
}

// density_at() is the inverse of pressure() at given heat, density_at_entropy() along an adiabatic change

TEST(Eos, density_at_a_pressure)
{
  for (const double gamma : {1.4, 3.5, 7.0})
    for (const double pb : {0.0, 0.7, -0.3}) {
      for (const Eos eos : {Eos::LINEAR, Eos::TAIT, Eos::IDEAL}) {
        const EosParams par = params(eos, gamma, pb);
        for (const double rho : {0.5, 0.9, 1.3, 1.7, 2.9})
          EXPECT_NEAR(density_at(eos, par,
                                 pressure(eos, par, rho, 2.3 + elastic_energy(eos, par, rho)), 2.3),
                      rho, 1e-13)
              << eos_name(eos) << " gamma = " << gamma << " rho = " << rho;
      }
      EXPECT_NEAR(density_at(Eos::TAIT, params(Eos::TAIT, gamma, pb), pb, 0.0), 1.3, 1e-15);
      for (const Eos eos : {Eos::LINEAR, Eos::TAIT, Eos::IDEAL})
        for (const double gruneisen : {0.0, 0.8}) {
          const EosParams par = params(eos, gamma, pb, gruneisen, 0.5);
          const auto p = [&](double rho, double q) {
            return pressure(eos, par, rho, q + elastic_energy(eos, par, rho));
          };
          for (const double from : {0.9, 1.3, 1.7})
            for (const double to : {0.8, 1.3, 2.0}) {
              const double q = heat_at(par, 2.3, from, to);
              EXPECT_NEAR(density_at(eos, par, p(to, 2.3), 2.3), to, 1e-13);
              EXPECT_NEAR(density_at_entropy(eos, par, p(to, q), 2.3, from), to, 1e-13);

              // dq = Gamma q/rho drho
              const double step = 2e-4;
              const auto change = [&](double by) {
                return heat_at(par, 2.3, from, to + by) - heat_at(par, 2.3, from, to - by);
              };
              EXPECT_NEAR((8.0 * change(step) - change(2.0 * step)) / (12.0 * step),
                          par.gruneisen * q / to, 1e-11 * q);
            }
        }
    }
}

// c^2 = dp/drho at constant entropy: along de = p/rho^2 drho, which counts where heat has a pressure

TEST(Eos, sound_speed_at_any_density)
{
  const double e = 2.3;
  for (const double pb : {0.0, 0.7, -0.3})
    for (const double gamma : {1.4, 3.5, 7.0}) {
      for (const Eos eos : {Eos::LINEAR, Eos::TAIT, Eos::IDEAL})
        for (const double gruneisen : {0.0, 0.8})
          for (const double rho : {0.9, 1.3, 1.7}) {
            const EosParams par = params(eos, gamma, pb, gruneisen, 0.5);
            const double step = 1e-5 * rho;
            const auto p = [&](double d) {
              return pressure(eos, par, rho + d, e + pressure(eos, par, rho, e) / (rho * rho) * d);
            };
            const double c = sound_speed(eos, par, rho, e);
            EXPECT_NEAR((p(step) - p(-step)) / (2.0 * step), c * c, 1e-7 * c * c)
                << eos_name(eos) << " gamma = " << gamma << " rho = " << rho;
          }
      EXPECT_NEAR(sound_speed(Eos::TAIT, params(Eos::TAIT, gamma, pb), 1.3, e), 2.1, 1e-15);
      EXPECT_EQ(sound_speed(Eos::LINEAR, params(Eos::LINEAR, gamma, pb), 2.0, e), 2.1);
    }
}
