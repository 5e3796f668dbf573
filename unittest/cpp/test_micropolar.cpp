/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// Forces, torques and heating of pair style sph/micropolar against the dense reference, and the
// properties of its friction matrix.

#include "configuration.h"
#include "dense_reference.h"
#include "expected.h"
#include "lammps_driver.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

using DenseReference::Matrix;
using DenseReference::Model;
using DenseReference::Real;
using DenseReference::SpinFluid;
using DenseReference::System;
using DenseReference::Vector;

static constexpr double TOLERANCE = 1.0e-12;

static Configuration spinning_fluid(int dim, bool triclinic, unsigned seed)
{
  Configuration config = periodic_fluid(dim, triclinic, seed);
  add_spins(config, seed + 1000);
  return config;
}

static Configuration spinning_drop(int dim, unsigned seed)
{
  Configuration config = free_drop(dim, seed);
  add_spins(config, seed + 1000);
  return config;
}

// unlike viscosities by explicit values for types 1 and 3, by the harmonic mean for the others

static Model micropolar_model(const Configuration &config, const std::string &kernel)
{
  Model model = test_model(config, kernel);
  if (config.dim == 3) {
    model.spins = {{0.3L, 0.02L, 0.01L}, {0.7L, 0.05L, 0.03L}, {0.31L, 0.03L, 0.015L}};
    model.spin_unlike[{1, 3}] = {0.2L, 0.04L, -0.015L};
  } else {
    model.spins = {{0.3L, 0.02L, -0.02L}, {1.1L, 0.05L, -0.05L}, {0.35L, 0.03L, -0.03L}};
    model.spin_unlike[{1, 3}] = {0.2L, 0.04L, -0.04L};
  }
  return model;
}

static System make_system(const Configuration &config, const Model &model)
{
  return System(model, config.reference_box(), config.reference_particles());
}

// three components per particle from the rows that the reference has

static Vector spread(const Vector &v, int size, int dim, bool axial)
{
  const int rows = (dim == 3) ? 3 : (axial ? 1 : 2);
  const int first = (axial && dim == 2) ? 2 : 0;
  Vector result = Vector::Zero(3 * size);
  for (int i = 0; i < size; i++)
    for (int k = 0; k < rows; k++) result(3 * i + first + k) = v(rows * i + k);
  return result;
}

struct Reference {
  Vector force, torque, desph, power;
};

static Reference reference(const Configuration &config, const System &system,
                           const DenseReference::Micropolar &micropolar, const std::string &eos,
                           const std::string &bulk)
{
  const auto volume = system.bulk(bulk, "micropolar", false, false);
  Reference result;
  result.force = spread(system.conservative_force(eos) + micropolar.force + volume.force,
                        config.size(), config.dim, false);
  result.torque = spread(micropolar.torque, config.size(), config.dim, true);
  result.desph = system.compression_power(eos) + micropolar.central + micropolar.vortex +
      micropolar.spin + volume.heating;
  result.power = Vector(4);
  result.power << micropolar.central.sum(), volume.heating.sum(), micropolar.vortex.sum(),
      micropolar.spin.sum();
  return result;
}

static void check(const Configuration &config, const std::vector<std::string> &kernels,
                  const std::vector<std::string> &all_eos, const std::vector<std::string> &all_bulk,
                  const std::vector<Layout> &layouts)
{
  Record record;
  for (const auto &kernel : kernels) {
    const Model model = micropolar_model(config, kernel);
    const bool root = LammpsDriver::rank() == 0;
    std::map<std::string, Reference> references;
    if (root) {
      const System system = make_system(config, model);
      const auto micropolar = system.micropolar();
      for (const auto &eos : all_eos)
        for (const auto &bulk : all_bulk)
          references[eos + bulk] = reference(config, system, micropolar, eos, bulk);
    }
    for (const auto &layout : layouts) {
      lammps().create(config, layout);
      for (const auto &eos : all_eos) {
        for (const auto &bulk : all_bulk) {
          lammps().pair_style(model, eos, "micropolar", bulk);
          const Computed computed = lammps().run0();
          if (!root) continue;
          const auto &expected = references[eos + bulk];
          const std::string where = "dim " + std::to_string(config.dim) + " " + kernel + " " + eos +
              " bulk " + bulk + (layout.newton ? " newton on" : " newton off") + " processors " +
              layout.processors + " " + layout.simd;
          record.check("f", deviation(computed.force, expected.force), TOLERANCE, where);
          record.check("torque", deviation(computed.torque, expected.torque), TOLERANCE, where);
          record.check("desph", deviation(computed.desph, expected.desph), TOLERANCE, where);
          Vector power = Vector::Zero(computed.power.size());    // no other channel has coefficients
          power.head(expected.power.size()) = expected.power;
          record.check("power", deviation(computed.power, power), TOLERANCE, where);
        }
      }
    }
  }
  if (LammpsDriver::rank() == 0) record.print();
}

static Layout newton(bool on)
{
  Layout layout;
  layout.newton = on;
  return layout;
}

static const std::vector<std::string> TWO_EOS = {"linear", "tait"};

/* ---------------------------------------------------------------------- */

TEST(Micropolar, all_kernels)
{
  for (int dim = 2; dim <= 3; dim++)
    check(spinning_fluid(dim, false, 200 + dim), DenseReference::kernel_names(), TWO_EOS, ALL_BULK,
          {newton(true), newton(false)});
}

TEST(Micropolar, ideal_gas_drops_and_triclinic_boxes)
{
  for (int dim = 2; dim <= 3; dim++) {
    check(spinning_fluid(dim, true, 210 + dim), {"wendland/c2"}, {"ideal"}, {"density"},
          {newton(true), newton(false)});
    check(spinning_drop(dim, 220 + dim), {"wendland/c4"}, {"tait"}, {"density", "volume"},
          {newton(true), newton(false)});
  }
}

TEST(Micropolar, volume_by_mass)
{
  for (int dim = 2; dim <= 3; dim++)
    check(by_mass(spinning_fluid(dim, false, 225 + dim)), {"wendland/c2"}, TWO_EOS,
          {"density", "volume"}, {newton(true), newton(false)});
}

TEST(Micropolar, processor_grids_tiles_and_instruction_sets)
{
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
  for (int dim = 2; dim <= 3; dim++)
    check(spinning_fluid(dim, false, 230 + dim), {"lucy"}, {"tait"}, {"density"}, layouts);
}

// one fluid: the pair loop takes another way

TEST(Micropolar, one_fluid_at_the_edge_of_the_admissible_range)
{
  for (int dim = 2; dim <= 3; dim++) {
    Configuration config = spinning_fluid(dim, false, 240 + dim);
    config.type.assign(config.size(), 1);
    Model model = micropolar_model(config, "quintic");
    model.mu_unlike.clear();
    model.spin_unlike.clear();
    model.fluids.resize(1);
    model.spins.resize(1);
    model.spins[0].mu_r = model.fluids[0].mu * (1.0L + 2.0L / dim);
    lammps().create(config, Layout());
    lammps().pair_style(model, "tait", "micropolar", "density");
    const Computed computed = lammps().run0();
    if (LammpsDriver::rank() != 0) continue;
    const System system = make_system(config, model);
    const auto expected = reference(config, system, system.micropolar(), "tait", "density");
    EXPECT_LE(deviation(computed.force, expected.force), TOLERANCE);
    EXPECT_LE(deviation(computed.torque, expected.torque), TOLERANCE);
    EXPECT_LE(deviation(computed.desph, expected.desph), TOLERANCE);
  }
}

/* ---------------------------------------------------------------------- */

// shear mg/fr2: the central part has the weight F r^2 where it is positive

TEST(Micropolar, weight_fr2)
{
  for (int dim = 2; dim <= 3; dim++) {
    const Configuration config = spinning_fluid(dim, false, 240 + dim);
    const Model model = micropolar_model(config, "wendland/c2");
    lammps().create(config, Layout());
    lammps().pair_style(model, "tait", "micropolar/fr2", "density");
    const Computed computed = lammps().run0();
    if (LammpsDriver::rank() != 0) continue;
    const System system = make_system(config, model);
    const auto expected =
        reference(config, system, system.micropolar("micropolar/fr2"), "tait", "density");
    EXPECT_LE(deviation(computed.force, expected.force), TOLERANCE);
    EXPECT_LE(deviation(computed.torque, expected.torque), TOLERANCE);
    EXPECT_LE(deviation(computed.desph, expected.desph), TOLERANCE);
  }
}

/* ---------------------------------------------------------------------- */

// the friction matrix of velocities and spins together, with the bulk term

static Matrix friction(const System &system, int dim)
{
  Matrix R = system.micropolar().R;
  const int nu = system.size() * dim;
  R.topLeftCorner(nu, nu) += system.bulk("density", "micropolar").R;
  return R;
}

TEST(Micropolar, friction_matrix_is_symmetric_and_positive)
{
  if (LammpsDriver::rank() != 0) return;
  for (int dim = 2; dim <= 3; dim++) {
    Configuration config = within(spinning_drop(dim, 250 + dim), dim == 2 ? 1.5 : 0.7);
    config.type.assign(config.size(), 1);
    Model model = micropolar_model(config, "wendland/c2");
    model.mu_unlike.clear();
    model.spin_unlike.clear();
    const Real mu = model.fluids[0].mu, edge = mu * (1.0L + 2.0L / dim);
    SpinFluid &spin = model.spins[0];
    for (const Real mu_r : {0.0L, 0.6L * mu, mu, edge}) {
      spin.mu_r = mu_r;
      // zeta > 0: all terms are sums of squares
      model.fluids[0].kappa = 2.0L * edge;
      for (int corner = 0; corner < 3; corner++) {
        // both ends of the range of gamma2 in 3d, xi2 = 0 and xi1 + xi2 = 0, and no spin diffusion
        spin.gamma1 = corner < 2 ? 0.04L : 0.0L;
        spin.gamma2 = dim == 2 ? -spin.gamma1 : (corner == 0 ? 1.0L : -1.5L) * spin.gamma1;
        const Matrix R = friction(make_system(config, model), dim);
        EXPECT_LE((R - R.transpose()).cwiseAbs().maxCoeff(), 1e-17L * R.cwiseAbs().maxCoeff());
        const Vector spectrum =
            Eigen::SelfAdjointEigenSolver<Matrix>(R, Eigen::EigenvaluesOnly).eigenvalues();
        EXPECT_GT(spectrum.minCoeff(), -1e-15L * spectrum.maxCoeff())
            << "dim " << dim << " mu_r/mu " << (double) (mu_r / mu) << " corner " << corner;
      }
    }
    // zeta < 0, close to the limit kappa = 0
    spin.mu_r = 0.5L * mu;
    model.fluids[0].kappa = 0.05L * edge;
    const Vector thin = Eigen::SelfAdjointEigenSolver<Matrix>(
                            friction(make_system(config, model), dim), Eigen::EigenvaluesOnly)
                            .eigenvalues();
    EXPECT_GT(thin.minCoeff(), -1e-15L * thin.maxCoeff());
    // beyond the edge a pair can be driven; without the bulk term nothing makes up for it
    spin.mu_r = 1.5L * edge;
    const Matrix R = make_system(config, model).micropolar().R;
    const Vector spectrum =
        Eigen::SelfAdjointEigenSolver<Matrix>(R, Eigen::EigenvaluesOnly).eigenvalues();
    EXPECT_LT(spectrum.minCoeff(), -1e-6L * spectrum.maxCoeff());
  }
}

// translation and rigid rotation with the spin of the rotation; with another spin not

TEST(Micropolar, rigid_motion_with_spin_is_in_the_null_space)
{
  for (int dim = 2; dim <= 3; dim++) {
    Configuration config = spinning_drop(dim, 260 + dim);
    const Model model = micropolar_model(config, "cubic");
    lammps().create(config, Layout());
    lammps().pair_style(model, "linear", "micropolar", "density");
    const Computed moving = lammps().run0();
    const std::array<double, 3> omega = {dim > 2 ? 0.4 : 0.0, dim > 2 ? -0.9 : 0.0, 1.1};

    std::array<Computed, 3> computed;    // at rest, rigid, rigid with a spin of its own
    for (int k = 0; k < 3; k++) {
      if (k == 0)
        set_rigid_motion(config, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
      else
        set_rigid_motion(config, {0.5, -0.8, 0.3}, omega);
      for (int i = 0; i < config.size(); i++)
        for (int d = 0; d < 3; d++)
          config.spin[3 * i + d] = k == 0 ? 0.0 : (k == 1 ? 1.0 : 0.5) * omega[d];
      lammps().create(config, Layout());
      lammps().pair_style(model, "linear", "micropolar", "density");
      computed[k] = lammps().run0();
      if (LammpsDriver::rank() != 0) continue;

      const Matrix R = friction(make_system(config, model), dim);
      const Vector q = make_system(config, model).velocity_and_spin();
      const Real residual = (R * q).cwiseAbs().maxCoeff();
      // velocities are numbers of double precision
      const Real parts = (R.cwiseAbs() * q.cwiseAbs()).maxCoeff();
      if (k == 2)
        EXPECT_GT(residual, 1e-3L * parts);
      else
        EXPECT_LE(residual, 4e-16L * parts);
    }
    if (LammpsDriver::rank() != 0) continue;

    auto largest = [](const std::vector<double> &values, const std::vector<double> &minus) {
      double result = 0.0;
      for (std::size_t k = 0; k < values.size(); k++)
        result = std::max(result, std::fabs(values[k] - (minus.empty() ? 0.0 : minus[k])));
      return result;
    };
    const double force = largest(moving.force, computed[0].force);
    const double torque = largest(moving.torque, {});
    EXPECT_LE(largest(computed[1].force, computed[0].force), 1e-13 * force);
    EXPECT_LE(largest(computed[1].torque, {}), 1e-13 * torque);
    EXPECT_GT(largest(computed[2].force, computed[0].force), 1e-3 * force);
    EXPECT_GT(largest(computed[2].torque, {}), 1e-3 * torque);
  }
}

// sum of r x f + torque, and of f, with unlike viscosities

TEST(Micropolar, total_angular_momentum_is_conserved)
{
  for (int dim = 2; dim <= 3; dim++) {
    const Configuration config = spinning_drop(dim, 270 + dim);
    for (const bool on : {true, false}) {
      for (const auto &bulk : ALL_BULK) {
        lammps().create(config, newton(on));
        lammps().pair_style(micropolar_model(config, "wendland/c6"), "tait", "micropolar", bulk);
        const Computed computed = lammps().run0();
        if (LammpsDriver::rank() != 0) continue;
        for (int d = 0; d < 3; d++) {
          const int a = (d + 1) % 3, b = (d + 2) % 3;
          double rate = 0.0, size = 0.0, spin = 0.0, force = 0.0, force_size = 0.0;
          for (int i = 0; i < config.size(); i++) {
            const double *x = &config.x[3 * i], *f = &computed.force[3 * i];
            rate += x[a] * f[b] - x[b] * f[a] + computed.torque[3 * i + d];
            spin += computed.torque[3 * i + d];
            size += std::fabs(x[a] * f[b]) + std::fabs(x[b] * f[a]) +
                std::fabs(computed.torque[3 * i + d]);
            force += f[d];
            force_size += std::fabs(f[d]);
          }
          EXPECT_LE(std::fabs(rate), 1e-14 * size) << "dim " << dim << " bulk " << bulk;
          EXPECT_LE(std::fabs(force), 1e-14 * force_size);
          if (dim == 3 || d == 2) EXPECT_GT(std::fabs(spin), 1e-6 * size);
        }
      }
    }
  }
}

TEST(Micropolar, without_spin_viscosities_equals_sph_bulk)
{
  for (int dim = 2; dim <= 3; dim++) {
    Configuration config = spinning_fluid(dim, false, 280 + dim);
    Model model = test_model(config, "wendland/c2");
    for (const auto &bulk : ALL_BULK) {
      model.spins.assign(3, SpinFluid());
      config.spin.resize(config.x.size(), 0.7);
      if (dim == 2)
        for (std::size_t k = 0; k < config.spin.size(); k++)
          if (k % 3 != 2) config.spin[k] = 0.0;
      lammps().create(config, Layout());
      lammps().pair_style(model, "tait", "micropolar", bulk);
      const Computed micropolar = lammps().run0();
      Configuration plain = config;
      plain.spin.clear();
      model.spins.clear();
      lammps().create(plain, Layout());
      lammps().pair_style(model, "tait", "mg", bulk);
      const Computed computed = lammps().run0();
      if (LammpsDriver::rank() != 0) continue;
      auto vector = [](const std::vector<double> &v) {
        return Vector(Eigen::Map<const Eigen::VectorXd>(v.data(), v.size()).cast<Real>());
      };
      EXPECT_LE(deviation(micropolar.force, vector(computed.force)), 1e-14);
      EXPECT_LE(deviation(micropolar.desph, vector(computed.desph)), 1e-14);
      for (const double t : micropolar.torque) EXPECT_EQ(t, 0.0);
    }
  }
}

// The package's own response to two states p and q of velocity and spin: p.(R q) = q.(R p), and
// q.(R q) is the sum of the heating.

TEST(Micropolar, friction_of_the_package_is_symmetric)
{
  for (int dim = 2; dim <= 3; dim++) {
    Configuration states[3];
    Computed computed[3];
    for (int k = 0; k < 3; k++) {
      states[k] = spinning_fluid(dim, false, 290 + dim);
      Random random(300 + k);
      for (std::size_t c = 0; c < states[k].v.size(); c++) {
        const int axis = c % 3;
        states[k].v[c] = (k == 0 || axis >= dim) ? 0.0 : random();
        states[k].spin[c] = (k == 0 || (dim == 2 && axis != 2)) ? 0.0 : 2.0 * random();
      }
      lammps().create(states[k], Layout());
      lammps().pair_style(micropolar_model(states[k], "wendland/c2"), "tait", "micropolar",
                          "density");
      computed[k] = lammps().run0();
    }
    if (LammpsDriver::rank() != 0) continue;
    auto power = [&](int p, int q) {
      Real sum = 0.0L;
      for (std::size_t c = 0; c < states[p].v.size(); c++)
        sum -= states[p].v[c] * (computed[q].force[c] - computed[0].force[c]) +
            states[p].spin[c] * computed[q].torque[c];
      return static_cast<double>(sum);
    };
    EXPECT_NEAR(power(1, 2), power(2, 1), 1e-13 * power(1, 1));
    for (int k = 1; k < 3; k++) {
      double heat = 0.0;
      for (const double channel : computed[k].power) heat += channel;
      EXPECT_NEAR(heat, power(k, k), 1e-13 * heat);
    }
  }
}

// The comparison must notice errors of the size of the tolerance, and wrong signs

TEST(Micropolar, comparison_notices_wrong_coefficients)
{
  constexpr double MUTATION = 1.0 + 4.0e-11;
  for (int dim = 2; dim <= 3; dim++) {
    const Configuration config = spinning_fluid(dim, false, 310 + dim);
    const Model model = micropolar_model(config, "wendland/c2");
    lammps().create(config, Layout());
    lammps().pair_style(model, "tait", "micropolar", "density");
    const Computed computed = lammps().run0();
    if (LammpsDriver::rank() != 0) continue;

    auto evaluate = [&](const Configuration &mutant_config, const Model &mutant) {
      const System system = make_system(mutant_config, mutant);
      const auto expected =
          reference(mutant_config, system, system.micropolar(), "tait", "density");
      return std::array<double, 2>{deviation(computed.force, expected.force),
                                   deviation(computed.torque, expected.torque)};
    };
    const auto right = evaluate(config, model);
    EXPECT_LE(right[0], TOLERANCE);
    EXPECT_LE(right[1], TOLERANCE);

    std::vector<Model> mutants(6, model);
    for (auto &spin : mutants[0].spins) spin.mu_r *= MUTATION;
    mutants[1].spin_unlike[{1, 3}].mu_r *= MUTATION;
    for (auto &fluid : mutants[2].fluids) fluid.mu *= MUTATION;
    for (auto &spin : mutants[3].spins) spin.gamma1 *= MUTATION;
    mutants[4].spin_unlike[{1, 3}].gamma1 *= MUTATION;
    mutants[5].spin_unlike[{1, 3}].gamma2 *= MUTATION;
    const int count = (dim == 3) ? 6 : 5;    // gamma2 has no part of its own in 2d
    for (int k = 0; k < count; k++) {
      const auto off = evaluate(config, mutants[k]);
      EXPECT_GT(k < 3 ? off[0] : off[1], TOLERANCE) << "mutant " << k << " dim " << dim;
      if (k < 2) EXPECT_GT(off[1], TOLERANCE) << "mutant " << k << " dim " << dim;
    }

    Configuration reversed = config;
    for (auto &w : reversed.spin) w = -w;
    const auto off = evaluate(reversed, model);
    EXPECT_GT(off[0], 1e-3);
    EXPECT_GT(off[1], 1e-3);
  }
}

// the reference's coefficients, found from integrals over the kernel, act as the continuum does

TEST(Micropolar, effective_viscosities_of_the_reference)
{
  if (LammpsDriver::rank() != 0) return;
  constexpr int cells = 17;
  const Real spacing = 0.25L;
  DenseReference::Particles particles;
  particles.x.resize(2, cells * cells);
  particles.v = Matrix::Zero(2, cells * cells);
  particles.spin = Matrix::Ones(1, cells * cells);
  for (int i = 0; i < cells * cells; i++) {
    particles.x(0, i) = spacing * (i % cells - cells / 2);
    particles.x(1, i) = spacing * (i / cells - cells / 2);
    particles.mass.push_back(spacing * spacing);
    particles.energy.push_back(0.0L);
    particles.type.push_back(1);
  }
  Model model;
  model.n = 2;
  model.support = 7.0L * spacing;
  model.fluids = {{1.0L, 1.0L, 0.4L, 1.5L}};
  model.spins = {{0.15L, 0.03L, -0.03L}};
  DenseReference::Box box{Matrix::Identity(2, 2), {false, false, false}};
  const int centre = cells * cells / 2;
  auto dissipation = [&]() {
    const System system(model, box, particles);
    const auto m = system.micropolar();
    return static_cast<double>(
        (m.central + m.vortex + m.spin +
         system.bulk("density", "micropolar").heating)(centre) *system.numden()(centre));
  };
  // spin in fluid at rest: 4 mu_r
  EXPECT_NEAR(dissipation(), 0.6, 0.02 * 0.6);
  // dilation: kappa (div u)^2
  particles.v = particles.x;
  particles.spin.setZero();
  EXPECT_NEAR(dissipation(), 1.5 * 4.0, 0.02 * 6.0);
  // shear with the spin of the vorticity, -1/2: mu; without spin mu + mu_r
  particles.v.row(0) = particles.x.row(1);
  particles.v.row(1).setZero();
  EXPECT_NEAR(dissipation(), 0.55, 0.03 * 0.55);
  particles.spin.setConstant(-0.5L);
  EXPECT_NEAR(dissipation(), 0.4, 0.03 * 0.4);
  // gradient of spin with no spin at the centre: gamma1 times its square; without mu_r, because the
  // mean spin of a pair differs from that of the centre
  particles.v.setZero();
  model.spins[0].mu_r = 0.0L;
  particles.spin = 3.0L * particles.x.row(0);
  EXPECT_NEAR(dissipation(), 0.03 * 9.0, 0.02 * 0.27);
}
