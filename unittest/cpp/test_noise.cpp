/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// Thermal noise of the pair styles: forces and torques of a step against the dense reference, whose noise
// has the covariance 2 kT times its friction matrix.

#include "configuration.h"
#include "dense_reference.h"
#include "expected.h"
#include "lammps_driver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

using DenseReference::Matrix;
using DenseReference::Model;
using DenseReference::Noise;
using DenseReference::NoiseNumber;
using DenseReference::Real;
using DenseReference::System;
using DenseReference::Vector;

static constexpr double TOLERANCE = 1.0e-12;
static constexpr double KT = 50.0, DT = 0.003;
static constexpr std::uint32_t SEED = 987654321;

// ---- the numbers, from the description of the generator ------------------------------------------

static std::array<std::uint32_t, 4> random_words(std::array<std::uint32_t, 4> c, std::uint32_t k0,
                                                 std::uint32_t k1)
{
  for (int round = 0; round < 7; round++) {
    const std::uint64_t p0 = 0xD2511F53ull * c[0], p1 = 0xCD9E8D57ull * c[2];
    c = {static_cast<std::uint32_t>(p1 >> 32) ^ c[1] ^ k0, static_cast<std::uint32_t>(p1),
         static_cast<std::uint32_t>(p0 >> 32) ^ c[3] ^ k1, static_cast<std::uint32_t>(p0)};
    k0 += 0x9E3779B9;
    k1 += 0xBB67AE85;
  }
  return c;
}

// number of 2^bits, of the mean 0 and the variance 1

static Real uniform(std::uint32_t number, int bits)
{
  const Real levels = std::pow(2.0L, bits);
  return std::sqrt(3.0L / (1.0L - 1.0L / (levels * levels))) *
      (2.0L * (number + 0.5L) / levels - 1.0L);
}

static Real value(const NoiseNumber &number, std::uint64_t step)
{
  const auto lo = static_cast<std::uint32_t>(step), hi = static_cast<std::uint32_t>(step >> 32);
  const auto low = static_cast<std::uint32_t>(number.low + 1);
  if (number.high < 0) return uniform(random_words({low, 0, lo, hi}, SEED, 0)[0], 32);
  const auto high = static_cast<std::uint32_t>(number.high + 1);
  const auto word = random_words({low, high, lo, hi}, SEED, number.surface ? 1000 : 1);
  const int half = number.index - NoiseNumber::HALVES;
  if (half < 0) return uniform(word[number.index], 32);
  return (half < 4) ? uniform(word[half] & 0xffff, 16) : uniform(word[half - 4] >> 16, 16);
}

// ---- cases ----------------------------------------------------------------------------------------

struct Case {
  Configuration config;
  Model model;
  std::string shear, bulk;
  bool limited;
  std::string label() const
  {
    return "dim " + std::to_string(config.dim) + " " + shear + " bulk " + bulk +
        (limited ? " limit yes" : "") + (config.volume_by_mass ? " volume mass" : "") +
        (config.wall.empty() ? "" : " wall");
  }
};

static Matrix friction(const Case &one, const System &system)
{
  Matrix R;
  if (DenseReference::has_spins(one.shear))
    R = system.micropolar(one.shear).R;
  else
    R = system.shear(one.shear).R;
  const int nu = system.size() * one.config.dim;
  if (one.bulk != "none")
    R.topLeftCorner(nu, nu) += system.bulk("density", one.shear, one.limited).R;
  return R;
}

// largest element of B B^T - 2 kT Gamma, relative to that of 2 kT Gamma

static double imbalance(const Case &one)
{
  const System system(one.model, one.config.reference_box(), one.config.reference_particles());
  const Noise noise = system.noise(one.shear, one.bulk != "none", one.limited, KT);
  const Matrix covariance = Matrix(noise.B * noise.B.transpose());
  const Matrix expected = 2.0L * KT * friction(one, system);
  return static_cast<double>((covariance - expected).cwiseAbs().maxCoeff() /
                             expected.cwiseAbs().maxCoeff());
}

static void create(const Case &one, const Layout &layout)
{
  lammps().create(one.config, layout);
  lammps().command("timestep 0.003");
  if (one.config.wall.empty()) return;
  std::string ids;
  for (int i = 0; i < one.config.size(); i++)
    if (one.config.wall[i]) ids += " " + std::to_string(i + 1);
  lammps().command("group wall id" + ids);
  lammps().command("group fluid subtract all wall");
  lammps().command("unfix integrator");
  lammps().command(
      "fix integrator fluid " +
      std::string(one.config.spin.empty() ? "sph/bulk" : "sph/micropolar inertia 0.2 0.01"));
  lammps().command("fix wall wall sph/wall");
}

static std::vector<double> forces_and_torques(const Case &one, double temperature,
                                              std::uint64_t step)
{
  lammps().command("reset_timestep " + std::to_string(step));
  lammps().pair_style(one.model, "linear", one.shear, one.bulk,
                      "temp " + std::to_string(temperature) + " " + std::to_string(SEED) +
                          (one.limited ? " limit yes" : ""));
  Computed computed = lammps().run0();
  computed.force.insert(computed.force.end(), computed.torque.begin(), computed.torque.end());
  return computed.force;
}

static void check(const Case &one, const std::vector<Layout> &layouts, Record &record,
                  std::uint64_t step = 7)
{
  Vector expected;
  const int dim = one.config.dim, size = one.config.size();
  if (LammpsDriver::rank() == 0) {
    const System system(one.model, one.config.reference_box(), one.config.reference_particles());
    const Noise noise = system.noise(one.shear, one.bulk != "none", one.limited, KT);
    Vector numbers(noise.numbers.size());
    for (std::size_t k = 0; k < noise.numbers.size(); k++)
      numbers(k) = value(noise.numbers[k], step);
    const Vector rows = noise.B * numbers / std::sqrt(static_cast<Real>(DT));
    const bool spins = (DenseReference::has_spins(one.shear));
    expected = Vector::Zero((spins ? 6 : 3) * size);
    const int s = (dim == 3) ? 3 : 1;
    for (int i = 0; i < size; i++) {
      expected.segment(3 * i, dim) = rows.segment(dim * i, dim);
      if (spins)
        expected.segment(3 * size + 3 * i + 3 - s, s) = rows.segment(dim * size + s * i, s);
    }
  }
  for (const auto &layout : layouts) {
    create(one, layout);
    const auto cold = forces_and_torques(one, 0.0, step);
    auto hot = forces_and_torques(one, KT, step);
    if (!one.config.wall.empty()) {    // which repel in proportion to T
      const auto hotter = forces_and_torques(one, 4.0 * KT, step);
      for (std::size_t k = 0; k < hot.size(); k++)
        hot[k] = 2.0 * hot[k] - 0.5 * (hotter[k] + cold[k]);
    }
    if (LammpsDriver::rank() != 0) continue;
    for (std::size_t k = 0; k < hot.size(); k++) hot[k] -= cold[k];
    const std::string where = one.label() + (layout.newton ? " newton on " : " newton off ") +
        layout.processors + " " + layout.simd;
    for (int part = 0; part < (DenseReference::has_spins(one.shear) ? 2 : 1); part++) {
      const std::vector<double> computed(hot.begin() + 3 * part * size,
                                         hot.begin() + 3 * (part + 1) * size);
      record.check(part ? "torque" : "force",
                   deviation(computed, expected.segment(3 * part * size, 3 * size)), TOLERANCE,
                   where);
    }
  }
}

static Layout newton(bool on)
{
  Layout layout;
  layout.newton = on;
  return layout;
}

// kappa: as the test fluids have it, or 0 where the shear term gives more, then with limit yes

static Case make(Configuration config, const std::string &shear, bool stokes = false)
{
  Case one{config, test_model(config, "wendland/c2"), shear, "density", stokes};
  if (DenseReference::has_spins(shear)) {
    add_spins(one.config, 77);
    one.model.spins = {{0.3L, 0.02L, 0.01L}, {0.7L, 0.05L, 0.03L}, {0.31L, 0.03L, 0.015L}};
    one.model.spin_unlike[{1, 3}] = {0.2L, 0.04L, -0.015L};
    if (config.dim == 2) {
      for (auto &spin : one.model.spins) spin.gamma2 = -spin.gamma1;
      one.model.spin_unlike[{1, 3}].gamma2 = -0.04L;
    }
  }
  for (auto &fluid : one.model.fluids) fluid.kappa = 4.0L;
  if (stokes) {    // one fluid with zeta > 0 among them
    one.model.fluids[0].kappa = 0.0L;
    one.model.fluids[1].kappa = 0.1L;
  }
  return one;
}

static std::vector<std::string> forms(int dim, bool stokes)
{
  // of two weights of one form, one dimension has both
  if (stokes) {    // those whose bulk viscosity is positive
    if (dim == 1) return {"mg", "mg/fr", "mg/fr2", "morris", "espanol"};
    if (dim == 2) return {"mg", "mg/fr2", "espanol", "micropolar/fr2"};
    return {"mg/fr", "mg/fr2", "micropolar"};
  }
  if (dim == 1) return {"mg", "mg/fr", "mg/fr2", "morris", "espanol", "none"};
  if (dim == 2) return {"mg", "mg/fr2", "morris", "espanol", "none", "micropolar"};
  return {"mg", "mg/fr", "morris", "espanol", "none", "micropolar/fr2"};
}

// a wall of the particles with y (1d: x) in the lowest third; masses of the reference density

static Configuration with_wall(Configuration config)
{
  const int axis = (config.dim == 1) ? 0 : 1;
  const double edge = config.lo[axis] + 0.35 * (config.hi[axis] - config.lo[axis]);
  config.wall.resize(config.size());
  for (int i = 0; i < config.size(); i++) {
    config.wall[i] = config.x[3 * i + axis] < edge;
    if (config.wall[i])
      for (int d = 0; d < 3; d++) config.v[3 * i + d] = 0.0;
  }
  return config;
}

/* ---------------------------------------------------------------------- */

// the identity itself, in the precision of the reference

TEST(Noise, covariance_is_that_of_the_friction)
{
  if (LammpsDriver::rank() != 0) return;
  for (int dim = 1; dim <= 3; dim++)
    for (const bool stokes : {false, true})
      for (const auto &shear : forms(dim, stokes)) {
        Configuration small = free_drop(dim, 500 + dim);
        if (dim > 1) small = within(small, dim == 2 ? 1.8 : 0.8);
        for (const auto &config : {small, by_mass(small)}) {
          const Case one = make(config, shear, stokes);
          EXPECT_LE(imbalance(one), 1.0e-16) << one.label();
        }
        if (dim < 3) {
          const Case one = make(with_wall(periodic_fluid(dim, false, 510 + dim)), shear, stokes);
          EXPECT_LE(imbalance(one), 1.0e-16) << one.label();
        }
      }
}

// a wrong number in it would be seen

TEST(Noise, covariance_notices_a_wrong_temperature_or_a_missing_channel)
{
  if (LammpsDriver::rank() != 0) return;
  Case one = make(within(free_drop(2, 520), 1.8), "micropolar");
  const System system(one.model, one.config.reference_box(), one.config.reference_particles());
  const Matrix expected = 2.0L * KT * friction(one, system);
  auto off = [&](const Noise &noise) {
    const Matrix covariance = Matrix(noise.B * noise.B.transpose());
    return static_cast<double>((covariance - expected).cwiseAbs().maxCoeff() /
                               expected.cwiseAbs().maxCoeff());
  };
  EXPECT_GT(off(system.noise("micropolar", true, false, KT * (1.0L + 1.0e-11L))), 1.0e-12);
  EXPECT_GT(off(system.noise("micropolar", false, false, KT)), 1.0e-3);
}

// forces and torques of the package

TEST(Noise, all_forms)
{
  Record record;
  for (int dim = 1; dim <= 3; dim++)
    for (const bool stokes : {false, true})
      for (const auto &shear : forms(dim, stokes)) {
        const Configuration config = periodic_fluid(dim, false, 530 + dim);
        check(make(config, shear, stokes), {newton(true), newton(false)}, record);
        check(make(by_mass(config), shear, stokes), {newton(true)}, record);
      }
  if (LammpsDriver::rank() == 0) record.print();
}

TEST(Noise, drops_bulk_none_and_late_steps)
{
  Record record;
  for (int dim = 1; dim <= 3; dim++)
    for (const auto &shear : forms(dim, false)) {
      Case one = make(free_drop(dim, 540 + dim), shear);
      check(one, {newton(true), newton(false)}, record, 5000000017ull);
      one.bulk = "none";
      check(one, {newton(true)}, record);
    }
  if (LammpsDriver::rank() == 0) record.print();
}

TEST(Noise, processor_grids_tiles_and_instruction_sets)
{
  Record record;
  const std::string n = std::to_string(LammpsDriver::ranks());
  std::vector<Layout> layouts;
  for (const bool on : {true, false}) {
    for (const auto &processors : {n + " 1 1", "1 " + n + " 1"}) {
      layouts.push_back(newton(on));
      layouts.back().processors = processors;
    }
    layouts.push_back(newton(on));
    layouts.back().tiled = true;
  }
  for (const auto &simd : lammps().instruction_sets()) {
    layouts.push_back(newton(true));
    layouts.back().simd = simd;
  }
  for (int dim = 1; dim <= 3; dim++) {
    for (const auto &shear : forms(dim, true))
      check(make(periodic_fluid(dim, false, 550 + dim), shear, true), layouts, record);
    check(make(periodic_fluid(dim, dim == 2, 560 + dim), dim == 1 ? "morris" : "micropolar"),
          layouts, record);
  }
  if (LammpsDriver::rank() == 0) record.print();
}

// one fluid: the loops take another way

TEST(Noise, one_fluid)
{
  Record record;
  for (int dim = 1; dim <= 3; dim++)
    for (const bool stokes : {false, true})
      for (const auto &shear : forms(dim, stokes)) {
        Case one = make(periodic_fluid(dim, false, 570 + dim), shear, stokes);
        one.config.type.assign(one.config.size(), 1);
        one.model.fluids.resize(1);
        if (DenseReference::has_spins(shear)) one.model.spins.resize(1);
        one.model.mu_unlike.clear();
        one.model.spin_unlike.clear();
        check(one, {newton(true)}, record);
      }
  if (LammpsDriver::rank() == 0) record.print();
}

TEST(Noise, walls)
{
  Record record;
  for (int dim = 1; dim <= 3; dim++)
    for (const bool stokes : {false, true})
      for (const auto &shear : forms(dim, stokes)) {
        const Configuration config = with_wall(periodic_fluid(dim, false, 580 + dim));
        check(make(config, shear, stokes), {newton(true), newton(false)}, record);
        check(make(by_mass(config), shear, stokes), {newton(true)}, record);
      }
  if (LammpsDriver::rank() == 0) record.print();
}

// Samples of the real generator: the power of the noise along any velocity q has the variance
// 2 kT q.Gamma q / dt, within four standard errors; with zero mean.

TEST(Noise, variance_of_samples)
{
  constexpr int SAMPLES = 1500;
  for (int dim = 2; dim <= 3; dim++)
    for (const bool stokes : {false, true}) {
      const Case one =
          make(within(free_drop(dim, 590 + dim), dim == 2 ? 1.5 : 0.7), "micropolar", stokes);
      create(one, newton(true));
      const auto cold = forces_and_torques(one, 0.0, 0);
      const int size = one.config.size(), s = (dim == 3) ? 3 : 1;
      Random random(600);
      std::vector<Vector> directions(5, Vector(size * (dim + s)));
      for (auto &q : directions)
        for (int k = 0; k < q.size(); k++) q(k) = random();
      std::vector<Real> mean(directions.size(), 0.0L), square(directions.size(), 0.0L);
      std::vector<double> hot = forces_and_torques(one, KT, 1);
      for (int step = 0; step < SAMPLES; step++) {
        lammps().command("reset_timestep " + std::to_string(1000 + step));
        Computed computed = lammps().run0();
        if (LammpsDriver::rank() != 0) continue;
        for (std::size_t k = 0; k < directions.size(); k++) {
          Real power = 0.0L;
          for (int i = 0; i < size; i++) {
            for (int d = 0; d < dim; d++)
              power += directions[k](dim * i + d) * (computed.force[3 * i + d] - cold[3 * i + d]);
            for (int d = 0; d < s; d++) {
              const int c = 3 * i + 3 - s + d;
              power +=
                  directions[k](dim * size + s * i + d) * (computed.torque[c] - cold[3 * size + c]);
            }
          }
          mean[k] += power / SAMPLES;
          square[k] += power * power / SAMPLES;
        }
      }
      if (LammpsDriver::rank() != 0) continue;
      const System system(one.model, one.config.reference_box(), one.config.reference_particles());
      const Matrix R = friction(one, system);
      for (std::size_t k = 0; k < directions.size(); k++) {
        const Real variance = 2.0L * KT * directions[k].dot(R * directions[k]) / DT;
        EXPECT_NEAR(static_cast<double>(square[k] / variance), 1.0, 4.0 * std::sqrt(2.0 / SAMPLES))
            << one.label();
        EXPECT_NEAR(static_cast<double>(mean[k] / std::sqrt(variance)), 0.0,
                    4.0 / std::sqrt(1.0 * SAMPLES));
      }
    }
}
