/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// Solvers of (M + h Gamma) x = b against Eigen, and the stages of RKL2 against
// the exponential

#include "sph_dissipation_solvers.h"
#include "sph_dissipation_threads.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <thread>
#include <vector>

using LAMMPS_NS::SPHDissipation::Krylov;
using LAMMPS_NS::SPHDissipation::RKL2;
using LAMMPS_NS::SPHDissipation::Threads;
using Unknowns = std::vector<double>;

class ThreeThreads : public Threads {
public:
  int size() const override { return 3; }
  void run(const std::function<void(int)> &task) override {
    std::vector<std::thread> team;
    for (int k = 0; k < size(); k++)
      team.emplace_back(task, k);
    for (auto &one : team)
      one.join();
  }
};

struct System {
  Eigen::MatrixXd A;
  Unknowns mass, inverse_mass, x, residual;
  double scale = 1.0;
  Threads one_thread, *threads = &one_thread;

  System(const Eigen::MatrixXd &gamma, const Eigen::VectorXd &m,
         const Eigen::VectorXd &b)
      : A(Eigen::MatrixXd(m.asDiagonal()) + gamma),
        mass(m.data(), m.data() + m.size()), x(m.size()),
        residual(b.data(), b.data() + b.size()) {
    for (const double one : mass)
      inverse_mass.push_back(one > 0.0 ? 1.0 / one : 0.0);
  }
  void apply(const double *in, double *out) const {
    Eigen::Map<Eigen::VectorXd>(out, x.size()) =
        A * Eigen::Map<const Eigen::VectorXd>(in, x.size());
  }
  Unknowns rooms[6];
  double *room(int k) {
    rooms[k].resize(x.size());
    return rooms[k].data();
  }
  template <class Function> void for_each(const Function &function) {
    threads->for_each(static_cast<int>(x.size()), function);
  }
  template <class Function> double total(const Function &add) {
    return threads->sum<double>(static_cast<int>(x.size()), add);
  }
  void sum(double *, int) const {}
  double scale_sq() const { return scale * scale; }
};

struct Problem {
  Eigen::MatrixXd gamma;
  Eigen::VectorXd mass, b;

  explicit Problem(int n, bool symmetric = true) {
    std::mt19937 engine(4711);
    auto random = [&](double) { return engine() * (2.0 / 4294967296.0) - 1.0; };
    const Eigen::MatrixXd B = Eigen::MatrixXd::Zero(n, n / 2).unaryExpr(random);
    gamma = 10.0 * B * B.transpose();
    if (!symmetric)
      gamma += 0.5 * Eigen::MatrixXd::Zero(n, n).unaryExpr(random);
    mass = Eigen::VectorXd::Zero(n).unaryExpr(random).array() + 2.0;
    b = Eigen::VectorXd::Zero(n).unaryExpr(random);
  }
};

static double error(const System &system, const Eigen::VectorXd &b) {
  const Eigen::VectorXd exact = system.A.fullPivLu().solve(b);
  const Eigen::Map<const Eigen::VectorXd> x(system.x.data(), b.size());
  return (x - exact).norm() / exact.norm();
}

// relative to the sums of the magnitudes in A x

static double residual(const System &system, const Eigen::VectorXd &b) {
  const Eigen::Map<const Eigen::VectorXd> x(system.x.data(), b.size());
  return (b - system.A * x).norm() /
         (system.A.cwiseAbs() * x.cwiseAbs()).norm();
}

TEST(Krylov, conjugate_gradients) {
  const Problem problem(60);
  System system(problem.gamma, problem.mass, problem.b);
  const auto found = Krylov<System>(system, 1.0e-14, 500).conjugate_gradients();
  EXPECT_TRUE(found.converged);
  EXPECT_FALSE(found.indefinite);
  EXPECT_LT(found.applications, 200);
  EXPECT_LT(error(system, problem.b), 1.0e-12);
}

TEST(Krylov, bi_conjugate_gradients) {
  for (const bool symmetric : {true, false}) {
    const Problem problem(60, symmetric);
    System system(problem.gamma, problem.mass, problem.b);
    const auto found =
        Krylov<System>(system, 1.0e-13, 2000).bi_conjugate_gradients();
    EXPECT_TRUE(found.converged);
    EXPECT_LT(residual(system, problem.b), 2.0e-15);
  }
}

TEST(Krylov, several_threads) {
  ThreeThreads threads;
  for (const bool symmetric : {true, false}) {
    const Problem problem(60, symmetric);
    System system(problem.gamma, problem.mass, problem.b);
    system.threads = &threads;
    Krylov<System> krylov(system, 1.0e-13, 2000);
    const auto found = symmetric ? krylov.conjugate_gradients()
                                 : krylov.bi_conjugate_gradients();
    EXPECT_TRUE(found.converged);
    EXPECT_LT(residual(system, problem.b), 2.0e-15);
  }
}

TEST(Krylov, unknowns_without_mass_stay_zero) {
  Problem problem(20);
  for (const int k : {3, 17}) {
    problem.mass(k) = problem.b(k) = 0.0;
    problem.gamma.row(k).setZero();
    problem.gamma.col(k).setZero();
  }
  System system(problem.gamma, problem.mass, problem.b);
  EXPECT_TRUE(
      Krylov<System>(system, 1.0e-12, 500).conjugate_gradients().converged);
  EXPECT_EQ(system.x[3], 0.0);
  EXPECT_EQ(system.x[17], 0.0);
}

TEST(Krylov, ends) {
  const Problem problem(60);
  System system(problem.gamma, problem.mass, problem.b);
  auto found = Krylov<System>(system, 1.0e-14, 3).conjugate_gradients();
  EXPECT_FALSE(found.converged);
  EXPECT_EQ(found.applications, 3);
  EXPECT_GT(found.residual, 1.0e-14);
  EXPECT_GT(error(system, problem.b), 1.0e-6);

  // negative friction, where a division would give a solution without meaning

  System negative(-problem.gamma, problem.mass, problem.b);
  found = Krylov<System>(negative, 1.0e-14, 500).conjugate_gradients();
  EXPECT_TRUE(found.indefinite);
  EXPECT_FALSE(found.converged);
  for (const double x : negative.x)
    EXPECT_TRUE(std::isfinite(x));

  // nothing to be done

  System rest(problem.gamma, problem.mass, Eigen::VectorXd::Zero(60));
  rest.scale = 0.0;
  found = Krylov<System>(rest, 1.0e-6, 500).conjugate_gradients();
  EXPECT_TRUE(found.converged);
  EXPECT_EQ(found.applications, 0);
}

// of dy/dt = -rate y over the time 1

static double rkl2(double rate, int s) {
  const RKL2 stages(s);
  double before = 1.0, y = 1.0 - stages.first().mu_rate * rate;
  for (int j = 2; j <= s; j++) {
    const auto one = stages.stage(j);
    const double next = one.mu * y + one.nu * before + (1.0 - one.mu - one.nu) -
                        one.mu_rate * rate * y - one.gamma_rate * rate;
    before = y;
    y = next;
  }
  return y;
}

TEST(RKL2, second_order_and_stable_to_the_limit) {
  for (const int s : {3, 5, 9, 15, 45}) {
    for (const double rate : {1.0e-2, 1.0e-3})
      EXPECT_NEAR((rkl2(rate, s) - std::exp(-rate)) / (rate * rate * rate), 0.0,
                  0.2);
    const double limit = RKL2::rate_limit(s);
    for (double rate = 0.0; rate <= limit; rate += limit / 1000.0)
      EXPECT_LE(std::abs(rkl2(rate, s)), 1.0 + 1.0e-12);
    EXPECT_GT(std::abs(rkl2(1.5 * limit, s)), 1.0);
  }
}

TEST(RKL2, number_of_stages) {
  for (double rate = 0.0; rate < 2000.0; rate += 0.25) {
    const int s = RKL2::stages_for(rate);
    EXPECT_EQ(s % 2, 1);
    EXPECT_GE(s, 3);
    EXPECT_LE(rate, RKL2::rate_limit(s));
    if (s > 3)
      EXPECT_GT(rate, RKL2::rate_limit(s - 2));
  }
  EXPECT_EQ(RKL2::stages_for(100.0), 15); // as in the literature
  EXPECT_EQ(RKL2::stages_for(RKL2::rate_limit(RKL2::MOST)), RKL2::MOST);
  EXPECT_GT(RKL2::stages_for(1.0e30), 1.0e15); // no overflow
}
