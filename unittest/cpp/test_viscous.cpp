/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// Keyword viscous of the integrators: forces, torques and heat at the start of a run against those at
// the velocity v_b, from two intervals, that dense solutions with the friction matrix of the reference give.

#include "configuration.h"
#include "dense_reference.h"
#include "expected.h"
#include "lammps_driver.h"

#include <Eigen/IterativeLinearSolvers>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using DenseReference::Matrix;
using DenseReference::Model;
using DenseReference::Real;
using DenseReference::Sparse;
using DenseReference::System;
using DenseReference::Vector;

static constexpr double TOLERANCE = 1.0e-12;
static constexpr double DT = 0.05;
static constexpr int STAGES = 27;
static constexpr int SMALL = 400;    // unknowns of a dense solution

struct Case {
  Configuration config;
  Model model;
  std::string shear, bulk;
  bool spins() const { return DenseReference::has_spins(shear); }
  std::string label() const
  {
    return "dim " + std::to_string(config.dim) + " " + shear + " bulk " + bulk +
        (config.volume_by_mass ? " volume mass" : "");
  }
};

static Case make(Configuration config, const std::string &shear, const std::string &bulk)
{
  Case one{config, test_model(config, "wendland/c2"), shear, bulk};
  for (auto &fluid : one.model.fluids) fluid.kappa = 60.0L;
  if (!one.spins()) return one;
  add_spins(one.config, 77);
  one.model.spins = {{0.3L, 0.02L, 0.01L}, {0.7L, 0.05L, 0.03L}, {0.31L, 0.03L, 0.015L}};
  one.model.spin_unlike[{1, 3}] = {0.2L, 0.04L, -0.015L};
  if (config.dim == 2) {
    for (auto &spin : one.model.spins) spin.gamma2 = -spin.gamma1;
    one.model.spin_unlike[{1, 3}].gamma2 = -0.04L;
  }
  return one;
}

// M, Gamma, velocities with spins, and the forces without friction, all in the order of the reference

struct Dense {
  System system;
  Matrix gamma;
  Vector mass, v, force;

  explicit Dense(const Case &one) :
      system(one.model, one.config.reference_box(), one.config.reference_particles())
  {
    const int dim = one.config.dim, size = system.size(), nu = dim * size;
    gamma = one.spins() ? system.micropolar(one.shear).R : system.shear(one.shear).R;
    if (one.bulk != "none") gamma.topLeftCorner(nu, nu) += system.bulk(one.bulk, one.shear).R;
    v = one.spins() ? system.velocity_and_spin() : system.velocity();
    mass = Vector(v.size());
    force = Vector::Zero(v.size());
    force.head(nu) = system.conservative_force("linear");
    const int s = (dim == 3) ? 3 : 1;
    for (int k = 0; k < v.size(); k++) {
      const int i = (k < nu) ? k / dim : (k - nu) / s;
      mass(k) = one.config.mass[i];
      if (k >= nu)
        mass(k) *= 0.2 * std::pow(static_cast<double>(system.volume()(i)), 2.0 / dim) + 0.01;
    }
  }

  // (M + h Gamma) x = b

  Vector solve(Real h, const Vector &b) const
  {
    const Matrix A = Matrix(mass.asDiagonal()) + h * gamma;
    if (b.size() <= SMALL) return A.partialPivLu().solve(b);
    const Sparse entries = A.sparseView();
    Eigen::BiCGSTAB<Sparse> solver(entries);
    solver.setTolerance(1.0e-17L);
    const Vector x = solver.solve(b);
    EXPECT_LT(static_cast<double>((b - A * x).norm() / b.norm()), 1.0e-16);
    return x;
  }
  Vector F(const Vector &u) const { return force - gamma * u; }

  // the velocity that acts in the friction, over a time

  Vector trapezoidal(Real t) const
  {
    return solve(0.5L * t, mass.cwiseProduct(v) + 0.5L * t * force);
  }
  Vector euler(Real t) const { return solve(t, mass.cwiseProduct(v) + t * force); }
  Vector sdirk2(Real t) const
  {
    const Real g = 1.0L - 1.0L / std::sqrt(2.0L);
    const Vector y1 = solve(g * t, mass.cwiseProduct(v) + g * t * force);
    const Vector y2 = solve(g * t, mass.cwiseProduct(v) + (1.0L - g) * t * F(y1) + g * t * force);
    return (1.0L - g) * y1 + g * y2;
  }

  // the force is the mean one, M (y_s - y_0)/t, of the stages as the literature has them

  Vector rkl2_force(Real t, int s) const
  {
    auto b = [](int j) {
      return (j < 3) ? 1.0L / 3.0L : (j * j + j - 2.0L) / (2.0L * j * (j + 1.0L));
    };
    auto L = [&](const Vector &y) {
      return Vector(F(y).cwiseQuotient(mass));
    };
    const Real w1 = 4.0L / (s * s + s - 2.0L);
    Vector before = v, y = v + b(1) * w1 * t * L(v);
    for (int j = 2; j <= s; j++) {
      const Real mu = (2.0L * j - 1.0L) * b(j) / (j * b(j - 1));
      const Real nu = -(j - 1.0L) * b(j) / (j * b(j - 2));
      const Real gamma_rate = -(1.0L - b(j - 1)) * mu * w1;
      const Vector next =
          mu * y + nu * before + (1.0L - mu - nu) * v + mu * w1 * t * L(y) + gamma_rate * t * L(v);
      before = y;
      y = next;
    }
    return mass.cwiseProduct(y - v) / t;
  }
};

static Vector spread(const Vector &v, int first_row, int rows, int first, int size)
{
  Vector result = Vector::Zero(3 * size);
  for (int i = 0; i < size; i++)
    for (int k = 0; k < rows; k++) result(3 * i + first + k) = v(first_row + rows * i + k);
  return result;
}

static void check(const Case &one, const std::vector<Layout> &layouts, Record &record)
{
  const int dim = one.config.dim, size = one.config.size(), s = (dim == 3) ? 3 : 1;
  const bool root = LammpsDriver::rank() == 0;
  const std::vector<std::string> modes = {
      "implicit tolerance 1e-14", "implicit scheme euler tolerance 1e-14",
      "implicit scheme sdirk2 tolerance 1e-14", "rkl2 stages " + std::to_string(STAGES)};
  std::vector<Vector> expected(modes.size());
  std::vector<Real> heat(modes.size(), 0.0L);    // of the friction
  if (root) {
    const Dense dense(one);
    const Real half = 0.75L * DT, all = 1.5L * DT;
    const Vector acting[3] = {2.0L * dense.trapezoidal(2.0L * half) - dense.trapezoidal(2.0L * all),
                              2.0L * dense.euler(half) - dense.euler(all),
                              2.0L * dense.sdirk2(half) - dense.sdirk2(all)};
    for (int k = 0; k < 3; k++) {
      expected[k] = dense.F(acting[k]);
      heat[k] = acting[k].dot(dense.gamma * acting[k]);
    }
    expected[3] = 2.0L * dense.rkl2_force(half, STAGES) - dense.rkl2_force(all, STAGES);
  }
  for (const auto &layout : layouts) {
    lammps().create(one.config, layout);
    lammps().command("timestep " + std::to_string(DT));
    for (std::size_t k = 0; k < modes.size(); k++) {
      lammps().command("unfix integrator");
      lammps().command("fix integrator all " +
                       std::string(one.spins() ? "sph/micropolar inertia 0.2 0.01" : "sph/bulk") +
                       " viscous " + modes[k]);
      lammps().pair_style(one.model, "linear", one.shear, one.bulk);
      const Computed computed = lammps().run0();
      if (!root) continue;
      const std::string where = one.label() + " viscous " + modes[k] +
          (layout.newton ? " newton on " : " newton off ") + layout.processors + " " + layout.simd;
      record.check("force " + modes[k],
                   deviation(computed.force, spread(expected[k], 0, dim, 0, size)), TOLERANCE,
                   where);
      if (!one.spins()) continue;
      record.check("torque " + modes[k],
                   deviation(computed.torque, spread(expected[k], dim * size, s, 3 - s, size)),
                   TOLERANCE, where);
      if (heat[k] == 0.0L) continue;
      Real power = 0.0L;
      for (const double channel : computed.power) power += channel;
      record.check("heat " + modes[k], static_cast<double>(std::abs(power / heat[k] - 1.0L)),
                   TOLERANCE, where);
    }
  }
}

static Layout newton(bool on)
{
  Layout layout;
  layout.newton = on;
  return layout;
}

static Configuration small(int dim, unsigned seed)
{
  const Configuration drop = free_drop(dim, seed);
  return (dim == 1) ? drop : within(drop, (dim == 2) ? 1.8 : 0.8);
}

static std::vector<std::string> forms(int dim)
{
  if (dim == 1) return {"mg", "mg/fr", "mg/fr2", "morris", "espanol", "none"};
  if (dim == 2) return {"mg", "mg/fr2", "morris", "espanol", "none", "micropolar"};
  return {"mg", "mg/fr", "morris", "espanol", "none", "micropolar/fr2"};
}

/* ---------------------------------------------------------------------- */

TEST(Viscous, all_forms)
{
  Record record;
  for (int dim = 1; dim <= 3; dim++)
    for (const auto &shear : forms(dim))
      for (const std::string bulk : {"density", "volume", "none"}) {
        if (shear == "none" && bulk == "none") continue;
        check(make(small(dim, 630 + dim), shear, bulk), {newton(true), newton(false)}, record);
      }
  if (LammpsDriver::rank() == 0) record.print();
}

TEST(Viscous, periodic_boxes_and_volume_by_mass)
{
  Record record;
  for (int dim = 1; dim <= 2; dim++)
    for (const std::string shear : {"mg", "micropolar"})
      for (const std::string bulk : {"density", "volume"}) {
        if (dim == 1 && shear == "micropolar") continue;
        check(make(periodic_fluid(dim, false, 640 + dim), shear, bulk), {newton(true)}, record);
        check(make(by_mass(periodic_fluid(dim, dim > 1, 650 + dim)), shear, bulk),
              {newton(true), newton(false)}, record);
        check(make(by_mass(small(3, 655)), shear, bulk), {newton(true)}, record);
      }
  if (LammpsDriver::rank() == 0) record.print();
}

TEST(Viscous, processor_grids_tiles_and_instruction_sets)
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
  check(make(periodic_fluid(2, false, 660), "micropolar", "density"), layouts, record);
  check(make(by_mass(small(3, 661)), "mg", "density"), layouts, record);
  if (LammpsDriver::rank() == 0) record.print();
}
