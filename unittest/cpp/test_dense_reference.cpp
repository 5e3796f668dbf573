/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// Tests of the dense reference itself, without LAMMPS.

#include "configuration.h"
#include "dense_reference.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>

using namespace DenseReference;

static const std::vector<std::string> SHEAR = {"mg", "mg/fr", "mg/fr2", "morris", "espanol", "none"};
static const std::vector<std::string> BULK = {"density", "volume", "none"};
static const std::vector<std::string> EOS = {"linear", "tait", "ideal"};

static Model test_model(const Configuration &config, const std::string &kernel)
{
  Model model;
  model.kernel = kernel;
  model.n = config.dim;
  model.support = config.support;
  model.fluids = test_fluids();
  model.mu_unlike[{1, 3}] = 0.45L;
  return model;
}

static System make_system(const Configuration &config, const Model &model)
{
  return System(model, config.reference_box(), config.reference_particles());
}

// one drop per dimension, small enough for eigenvalues in long double

static Configuration small_drop(int dim, unsigned seed)
{
  Configuration full = free_drop(dim, seed), config = full;
  config.x.clear();
  config.v.clear();
  config.mass.clear();
  config.energy.clear();
  config.type.clear();
  const double radius = dim == 1 ? 5.0 : (dim == 2 ? 1.6 : 0.9);
  for (int i = 0; i < full.size(); i++) {
    if (std::hypot(full.x[3 * i], full.x[3 * i + 1], full.x[3 * i + 2]) > radius) continue;
    config.x.insert(config.x.end(), &full.x[3 * i], &full.x[3 * i] + 3);
    config.v.insert(config.v.end(), &full.v[3 * i], &full.v[3 * i] + 3);
    config.mass.push_back(full.mass[i]);
    config.energy.push_back(full.energy[i]);
    config.type.push_back(full.type[i]);
  }
  return config;
}

/* ---------------------------------------------------------------------- */

// composite Simpson rule on the values of the kernel, not its polynomial; the intervals are those
// of the splines' pieces

template <class Function> static Real simpson(Function f, Real end)
{
  constexpr int intervals = 6 * 2000;
  const Real width = end / intervals;
  Real sum = 0.0L;
  for (int k = 0; k < intervals; k++)
    sum += f(k * width) + 4.0L * f((k + 0.5L) * width) + f((k + 1) * width);
  return sum * width / 6.0L;
}

TEST(DenseReferenceKernel, moments)
{
  const Real sphere[3] = {2.0L, 2.0L * std::acos(-1.0L), 4.0L * std::acos(-1.0L)};
  const Real R = 1.7L;
  for (const auto &name : kernel_names()) {
    for (int n = 1; n <= 3; n++) {
      SCOPED_TRACE(name + " n = " + std::to_string(n));
      const Kernel kernel(name, n, R);
      const Real one = sphere[n - 1] *
          simpson(
                           [&](Real r) {
                             return kernel.W(r) * std::pow(r, n - 1.0L);
                           },
                           R);
      const Real dim = sphere[n - 1] *
          simpson(
                           [&](Real r) {
                             return r == 0.0L ? 0.0L : kernel.F(r) * std::pow(r, n + 1.0L);
                           },
                           R);
      const Real mean = sphere[n - 1] *
          simpson(
                            [&](Real r) {
                              return kernel.W(r) * std::pow(r, n + 0.0L);
                            },
                            R);
      EXPECT_NEAR(one, 1.0L, 1e-14L);
      EXPECT_NEAR(dim, n, 1e-14L * n);
      EXPECT_NEAR(mean, kernel.mean_distance(), 1e-14L);
    }
  }
}

TEST(DenseReferenceKernel, slope)
{
  const Real R = 1.7L, step = 1e-5L;
  for (const auto &name : kernel_names()) {
    for (int n = 1; n <= 3; n++) {
      const Kernel kernel(name, n, R);
      for (Real r = 0.0313L; r < R; r += 0.0571L) {
        const Real slope = (kernel.W(r + step) - kernel.W(r - step)) / (2.0L * step);
        EXPECT_NEAR(kernel.F(r), -slope / r, 1e-7L * kernel.F(0.01L))
            << name << " r = " << (double) r;
        EXPECT_GT(kernel.F(r), 0.0L);
      }
      EXPECT_EQ(kernel.W(R), 0.0L);
      EXPECT_EQ(kernel.F(R), 0.0L);
    }
  }
}

/* ---------------------------------------------------------------------- */

TEST(DenseReference, conservative_force_is_minus_gradient_of_energy)
{
  for (int run = 0; run < 6; run++) {    // three dimensions, volumes by number and by mass
    const int dim = 1 + run % 3;
    Configuration config = small_drop(dim, 7 + dim);
    if (run >= 3) config = by_mass(config);
    for (const auto &kernel : kernel_names()) {
      const Model model = test_model(config, kernel);
      for (const auto &eos : {"linear", "tait"}) {
        const Vector f = make_system(config, model).conservative_force(eos);
        const Real scale = f.cwiseAbs().maxCoeff();
        const Particles particles = config.reference_particles();
        for (int i = 0; i < config.size(); i += 7) {
          for (int k = 0; k < dim; k++) {
            const Real step = 2e-6L;
            Real energy[2];
            for (int side = 0; side < 2; side++) {
              Particles moved = particles;
              moved.x(k, i) += side == 0 ? -step : step;
              energy[side] = System(model, config.reference_box(), moved).elastic_energy(eos).sum();
            }
            EXPECT_NEAR(-(energy[1] - energy[0]) / (2.0L * step), f(dim * i + k), 1e-9L * scale)
                << kernel << " " << eos << " n = " << dim;
          }
        }
      }
    }
  }
}

TEST(DenseReference, matrix_is_symmetric)
{
  for (int dim = 1; dim <= 3; dim++) {
    for (bool free : {true, false}) {
      const Configuration config = free ? free_drop(dim, 3) : periodic_fluid(dim, dim > 1, 5);
      const System system = make_system(config, test_model(config, "wendland/c2"));
      auto asymmetry = [](const Matrix &R) {
        return static_cast<double>((R - R.transpose()).cwiseAbs().maxCoeff() /
                                   R.cwiseAbs().maxCoeff());
      };
      for (const auto &form : {"mg", "mg/fr", "mg/fr2", "morris", "espanol"})
        EXPECT_LT(asymmetry(system.shear(form).R), 1e-16) << form;
      EXPECT_LT(asymmetry(system.bulk("density", "mg").R), 1e-16);
      EXPECT_GT(asymmetry(system.bulk("volume", "mg").R), 1e-3);
    }
  }
}

static Vector eigenvalues(const System &system, const std::string &form)
{
  const Matrix R = system.shear(form).R + system.bulk("density", form).R;
  return Eigen::SelfAdjointEigenSolver<Matrix>(R, Eigen::EigenvaluesOnly).eigenvalues();
}

TEST(DenseReference, eigenvalues_are_not_negative)
{
  for (int dim = 1; dim <= 3; dim++) {
    Configuration config = small_drop(dim, 11);
    Model model = test_model(config, "wendland/c2");
    auto set_kappa = [&](Real of_intrinsic) {
      for (auto &fluid : model.fluids) fluid.kappa = of_intrinsic * fluid.mu * (1.0L + 2.0L / dim);
    };

    // several fluids: shear alone, then with a bulk term of zeta > 0
    for (const auto &form : {"mg", "mg/fr", "mg/fr2"}) {
      for (const Real kappa : {1.0L, 2.0L}) {
        set_kappa(kappa);
        const Vector spectrum = eigenvalues(make_system(config, model), form);
        EXPECT_GT(spectrum.minCoeff(), -1e-15L * spectrum.maxCoeff()) << form << " n = " << dim;
      }
    }

    // one fluid: zeta < 0 as well, and far outside of the admissible range the bound must fail
    config.type.assign(config.size(), 1);
    set_kappa(0.1L);
    const Vector inside = eigenvalues(make_system(config, model), "mg");
    EXPECT_GT(inside.minCoeff(), -1e-15L * inside.maxCoeff()) << " n = " << dim;
    set_kappa(-2.0L);
    const Vector outside = eigenvalues(make_system(config, model), "mg");
    EXPECT_LT(outside.minCoeff(), -1e-3L * outside.maxCoeff()) << " n = " << dim;
  }
}

// Several fluids with zeta < 0 violate positivity where types meet, because a pair has less shear
// viscosity than its thicker partner; the limit on zeta restores it, for kappa down to zero.

TEST(DenseReference, limit_on_zeta_restores_positivity)
{
  for (int dim = 1; dim <= 3; dim++) {
    const Configuration config = small_drop(dim, 12);
    Model model = test_model(config, "wendland/c2");
    model.mu_unlike.clear();
    for (auto &fluid : model.fluids) fluid.kappa = 0.0L;
    const System system = make_system(config, model);
    for (const auto &form : {"mg", "mg/fr", "mg/fr2"}) {
      EXPECT_GT(system.beyond_limit(form), 0);
      const Matrix shear = system.shear(form).R;
      for (const bool limited : {false, true}) {
        const Matrix R = shear + system.bulk("density", form, limited).R;
        const Vector spectrum =
            Eigen::SelfAdjointEigenSolver<Matrix>(R, Eigen::EigenvaluesOnly).eigenvalues();
        const Real relative = spectrum.minCoeff() / spectrum.maxCoeff();
        if (limited)
          EXPECT_GT(relative, -1e-15L) << form << " n = " << dim;
        else
          EXPECT_LT(relative, -1e-6L) << form << " n = " << dim;
      }
    }
  }
}

TEST(DenseReference, rigid_motion_is_in_the_null_space)
{
  for (int dim = 1; dim <= 3; dim++) {
    Configuration config = free_drop(dim, 21);
    const System system = make_system(config, test_model(config, "cubic"));
    for (const auto &form : SHEAR) {
      for (const auto &bulk : BULK) {
        const Matrix R = system.shear(form).R + system.bulk(bulk, form).R;
        if (R.cwiseAbs().maxCoeff() == 0.0L) continue;
        const Real size = (R * system.velocity()).cwiseAbs().maxCoeff();
        set_rigid_motion(config, {0.5, -0.8, 0.3}, {0.0, 0.0, 0.0});
        const Vector translation = make_system(config, test_model(config, "cubic")).velocity();
        EXPECT_LT((R * translation).cwiseAbs().maxCoeff(), 1e-16L * size) << form << " " << bulk;
        if (dim == 1) continue;
        set_rigid_motion(config, {0.5, -0.8, 0.3},
                         {dim > 2 ? 0.4 : 0.0, dim > 2 ? -0.9 : 0.0, 1.1});
        const Vector rotation = make_system(config, test_model(config, "cubic")).velocity();
        const Real residual = (R * rotation).cwiseAbs().maxCoeff();
        // velocities are numbers of double precision
        const Real parts = (R.cwiseAbs() * rotation.cwiseAbs()).maxCoeff();
        if (form == "morris" || form == "espanol")
          EXPECT_GT(residual, 1e-2L * size);
        else
          EXPECT_LT(residual, 4e-16L * parts) << form << " " << bulk;
      }
    }
  }
}

TEST(DenseReference, power_is_the_sum_of_heating)
{
  for (int dim = 1; dim <= 3; dim++) {
    const Configuration config = periodic_fluid(dim, false, 31);
    const System system = make_system(config, test_model(config, "lucy"));
    const Vector u = system.velocity();
    for (const auto &form : SHEAR) {
      const Viscous shear = system.shear(form);
      EXPECT_NEAR(-u.dot(shear.force), shear.heating.sum(),
                  1e-15L * shear.heating.cwiseAbs().sum());
      EXPECT_GE(shear.heating.minCoeff(), 0.0L);
      for (const auto &bulk : BULK) {
        const Viscous volume = system.bulk(bulk, form);
        EXPECT_LE((volume.force + volume.R * u).cwiseAbs().maxCoeff(),
                  1e-17L * (volume.R.cwiseAbs() * u.cwiseAbs()).maxCoeff());
        EXPECT_NEAR(-u.dot(volume.force), volume.heating.sum(),
                    1e-15L * volume.heating.cwiseAbs().sum());
      }
    }
    for (const auto &eos : EOS) {
      const Vector power = system.compression_power(eos);
      EXPECT_NEAR(-u.dot(system.conservative_force(eos)), power.sum(),
                  1e-15L * power.cwiseAbs().sum());
    }
  }
}

// the viscosities themselves: dissipation of a uniform dilation and of a shear flow on a fine
// square lattice, per volume, against kappa (div u)^2 and mu (shear rate)^2

TEST(DenseReference, effective_viscosities)
{
  constexpr int cells = 15;
  const Real spacing = 0.25L;
  const Fluid fluid{1.0L, 1.0L, 0.4L, 1.5L};
  for (const auto &form : {"mg", "mg/fr", "mg/fr2"}) {
    Particles particles;
    particles.x.resize(2, cells * cells);
    particles.v.resize(2, cells * cells);
    for (int i = 0; i < cells * cells; i++) {
      particles.x(0, i) = spacing * (i % cells - cells / 2);
      particles.x(1, i) = spacing * (i / cells - cells / 2);
      particles.mass.push_back(spacing * spacing);
      particles.energy.push_back(0.0L);
      particles.type.push_back(1);
    }
    Model model;
    model.n = 2;
    model.support = 6.0L * spacing;
    model.fluids = {fluid};
    Box box{Matrix::Identity(2, 2), {false, false, false}};
    const int centre = cells * cells / 2;

    particles.v = particles.x;
    const System dilating(model, box, particles);
    const Real dilation =
        (dilating.shear(form).heating + dilating.bulk("density", form).heating)(centre);
    EXPECT_NEAR(dilation * dilating.numden()(centre) / 4.0L, fluid.kappa, 0.02L * fluid.kappa);

    particles.v.row(0) = particles.x.row(1);
    particles.v.row(1).setZero();
    const System sheared(model, box, particles);
    const Real shear =
        (sheared.shear(form).heating + sheared.bulk("density", form).heating)(centre);
    EXPECT_NEAR(shear * sheared.numden()(centre), fluid.mu, 0.03L * fluid.mu);
  }
}
