/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "sph_dissipation_channels.h"
#include "sph_dissipation_steps.h"

#include "configuration.h"
#include "dense_reference.h"
#include "quadrature.h"
#include "sph_dissipation_kernel.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

using namespace LAMMPS_NS::SPHDissipation;

static constexpr Shear FORMS[] = {Shear::MG, Shear::MG_FR, Shear::MG_FR2, Shear::MORRIS,
                                   Shear::ESPANOL};

/* ---------------------------------------------------------------------- */

TEST(Coeffs, names)
{
  EXPECT_STREQ(shear_name(Shear::MG), "mg");
  EXPECT_STREQ(shear_name(Shear::MG_FR), "mg/fr");
  EXPECT_STREQ(shear_name(Shear::MG_FR2), "mg/fr2");
  EXPECT_STREQ(shear_name(Shear::MORRIS), "morris");
  EXPECT_STREQ(shear_name(Shear::ESPANOL), "espanol");
  EXPECT_STREQ(shear_name(Shear::NONE), "none");
  EXPECT_STREQ(bulk_name(Bulk::DENSITY), "density");
  EXPECT_STREQ(bulk_name(Bulk::VOLUME), "volume");
  EXPECT_STREQ(bulk_name(Bulk::NONE), "none");
}

// Force per volume of the shear term, unit mu, in a continuum with the velocity u_a = x^2 along
// direction a, at the origin. It must be 2 mu for a transverse direction (laplacian) and
// 2 (lambda + 2 mu) for the longitudinal one.

static long double continuum_force(Shear shear, Kernel kernel, int n, bool longitudinal)
{
  constexpr double R = 1.3;
  constexpr int angles = 12;
  const long double pi = std::acos(-1.0L);
  const double factor = shear_factor(shear, n, kernel_mean(kernel, n, 1, R), kernel_mean(kernel, n, 2, R));

  // mean over directions e of e_x^2 times the diagonal element a of the pair matrix
  const auto integrand = [&](long double ex, long double ea) {
    if (shear == Shear::MORRIS) return ex * ex;
    if (shear == Shear::ESPANOL) return ex * ex * (1.0L + ea * ea);
    return ex * ex * ea * ea;
  };
  long double mean = 0.0L;
  if (n == 1) {
    mean = integrand(1.0L, 1.0L);
  } else if (n == 2) {
    for (int k = 0; k < angles; k++) {
      const long double phi = 2.0L * pi * k / angles;
      mean += integrand(std::cos(phi), longitudinal ? std::cos(phi) : std::sin(phi)) / angles;
    }
  } else {
    for (int k = 0; k < angles; k++) {
      const long double phi = 2.0L * pi * k / angles;
      const auto ring = [&](long double z) {
        const long double ex = std::sqrt(1.0L - z * z) * std::cos(phi);
        const long double ey = std::sqrt(1.0L - z * z) * std::sin(phi);
        return 0.5L * integrand(ex, longitudinal ? ex : ey);
      };
      mean += quadrature(ring, -1.0L, 1.0L, 1) / angles;
    }
  }

  const long double sphere[3] = {2.0L, 2.0L * pi, 4.0L * pi};
  const auto radial = [&](long double r) {
    const long double weighting = shear == Shear::MG_FR ? r : shear == Shear::MG_FR2 ? r * r : 1.0L;
    return std::pow(r, n + 1.0L) * weighting * kernel_slope(kernel, n, r, R);
  };
  return factor * mean * sphere[n - 1] * quadrature(radial, 0.0L, R, 120);
}

TEST(Coeffs, shear_and_intrinsic_bulk_viscosity_of_the_continuum)
{
  for (const Kernel kernel : {Kernel::WENDLAND_C2, Kernel::CUBIC, Kernel::WENDLAND_C6}) {
    for (const Shear shear : FORMS) {
      for (int n = 1; n <= 3; n++) {
        SCOPED_TRACE(std::string(shear_name(shear)) + " n = " + std::to_string(n));
        if (n > 1) { EXPECT_NEAR(continuum_force(shear, kernel, n, false), 2.0, 1e-13); }
        const double longitudinal = 0.5 * continuum_force(shear, kernel, n, true);
        EXPECT_NEAR(longitudinal - 2.0 * (1.0 - 1.0 / n), intrinsic_kappa(shear, n, 1.0), 1e-13);
      }
    }
  }
}

TEST(Coeffs, factors_as_numbers)
{
  const double mg[3] = {6.0, 8.0, 10.0}, kappa[3] = {3.0, 2.0, 5.0 / 3.0};
  const double morris_kappa[3] = {1.0, 0.0, -1.0 / 3.0};
  const double espanol[3] = {1.5, 1.6, 5.0 / 3.0}, espanol_kappa[3] = {1.5, 0.4, 0.0};
  for (int n = 1; n <= 3; n++) {
    EXPECT_EQ(shear_factor(Shear::MG, n, 0.7, 0.6), mg[n - 1]);
    EXPECT_EQ(shear_factor(Shear::MORRIS, n, 0.7, 0.6), 2.0);
    EXPECT_NEAR(shear_factor(Shear::ESPANOL, n, 0.7, 0.6), espanol[n - 1], 1e-15);
    EXPECT_EQ(shear_factor(Shear::NONE, n, 0.7, 0.6), 0.0);
    EXPECT_DOUBLE_EQ(intrinsic_kappa(Shear::MG, n, 2.0), 2.0 * kappa[n - 1]);
    EXPECT_EQ(intrinsic_kappa(Shear::MG, n, 2.0), intrinsic_kappa(Shear::MG_FR, n, 2.0));
    EXPECT_EQ(intrinsic_kappa(Shear::MG, n, 2.0), intrinsic_kappa(Shear::MG_FR2, n, 2.0));
    EXPECT_EQ(shear_factor(Shear::MG_FR2, n, 0.7, 0.6), 2.0 * n / 0.6);
    EXPECT_NEAR(intrinsic_kappa(Shear::MORRIS, n, 2.0), 2.0 * morris_kappa[n - 1], 1e-15);
    EXPECT_NEAR(intrinsic_kappa(Shear::ESPANOL, n, 2.0), 2.0 * espanol_kappa[n - 1], 1e-15);
    EXPECT_EQ(intrinsic_kappa(Shear::NONE, n, 2.0), 0.0);
  }
}

TEST(Coeffs, bulk_coefficient_is_the_inverse)
{
  for (const Shear shear : {Shear::MG, Shear::MG_FR, Shear::MG_FR2, Shear::MORRIS, Shear::ESPANOL,
                            Shear::NONE}) {
    for (int n = 1; n <= 3; n++) {
      const double intrinsic = intrinsic_kappa(shear, n, 0.8);
      for (const double kappa : {0.0, 0.3, 4.0}) {
        const double zeta = bulk_coefficient(kappa, intrinsic);
        EXPECT_NEAR(intrinsic + zeta, kappa, 1e-15);
      }
      EXPECT_EQ(bulk_coefficient(intrinsic, intrinsic), 0.0);
    }
  }
  // lower edge of the admissible range: zeta = -(1 + 2/n) mu
  EXPECT_NEAR(bulk_coefficient(0.0, intrinsic_kappa(Shear::MG, 2, 0.8)), -1.6, 1e-15);
}

TEST(Coeffs, admissible_range)
{
  const double tiny = std::numeric_limits<double>::denorm_min();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(inadmissible(0.0, 0.0), nullptr);
  EXPECT_EQ(inadmissible(1.0, 0.0), nullptr);
  EXPECT_EQ(inadmissible(0.0, 1.0), nullptr);
  EXPECT_STREQ(inadmissible(-tiny, 1.0), "mu must be >= 0");
  EXPECT_STREQ(inadmissible(1.0, -tiny), "kappa must be >= 0");
  EXPECT_STREQ(inadmissible(nan, 1.0), "mu must be >= 0");
  EXPECT_STREQ(inadmissible(1.0, nan), "kappa must be >= 0");
}

/* ---------------------------------------------------------------------- */

// largest stable time step of one channel alone

static PairInertia inertia_of(double hsq, double rho_inertia)
{
  PairInertia inertia;
  inertia.hsq = hsq;
  inertia.rho = 1.0;
  inertia.rho_inertia = rho_inertia;
  return inertia;
}

static PairFluid fluid_of(Shear shear, int dim)
{
  PairFluid fluid;
  fluid.shear = shear;
  fluid.dim = dim;
  fluid.mean_radius = fluid.mean_square = 1.0;
  return fluid;
}

static double shear_step(Shear shear, double hsq, double nu)
{
  PairFluid fluid = fluid_of(shear, 2);
  fluid.viscosity[MU] = nu;
  return viscous_step(ShearChannel::rate(fluid, {}, nullptr, inertia_of(hsq, 1.0)));
}

static double bulk_step(double hsq, double zeta_over_rho)
{
  PairFluid fluid = fluid_of(Shear::MG, 2);
  fluid.zeta = zeta_over_rho;
  return viscous_step(BulkChannel::rate(fluid, {}, nullptr, inertia_of(hsq, 1.0)));
}

static double vortex_step(double rho_inertia, double zeta2)
{
  return viscous_step(VortexChannel::rate(PairFluid(), {}, &zeta2, inertia_of(1.0, rho_inertia)));
}

static double micropolar_step(int n, double hsq, double inertia, double along_r, double along_u)
{
  return viscous_step(rate_of_terms(n, hsq, inertia, along_r, along_u));
}

TEST(TimeStep, limits_as_numbers)
{
  // h = R/2 for the kernel whose stability length is the reference
  for (int n = 2; n <= 3; n++)
    EXPECT_NEAR(stability_length_squared(kernel_slope_integral(Kernel::WENDLAND_C2, n, 0.6)), 0.09,
                1e-15);
  EXPECT_NEAR(acoustic_step(0.2, 10.0), 0.005, 1e-17);
  EXPECT_EQ(acoustic_step(0.2, 0.0), UNLIMITED_STEP);
  // all others: 0.9 over the largest rate
  EXPECT_NEAR(shear_step(Shear::MG, 0.04, 0.5), 0.9 * 0.08 / 21.0, 1e-17);
  EXPECT_NEAR(shear_step(Shear::MG_FR, 0.04, 0.5), 0.9 * 0.08 / 17.0, 1e-17);
  EXPECT_NEAR(shear_step(Shear::MG_FR2, 0.04, 0.5), 0.9 * 0.08 / 15.0, 1e-17);
  EXPECT_NEAR(shear_step(Shear::MORRIS, 0.04, 0.5), 0.9 * 0.08 / 8.0, 1e-17);
  EXPECT_NEAR(shear_step(Shear::ESPANOL, 0.04, 0.5), 0.9 * 0.08 / 10.0, 1e-17);
  EXPECT_NEAR(bulk_step(0.04, 0.5), 0.9 * 0.08 / 1.6, 1e-16);
  EXPECT_NEAR(bulk_step(0.04, -0.5), 0.9 * 0.08 / 1.6, 1e-16);
  EXPECT_NEAR(vortex_step(0.5, 4.0), 0.9 * 0.125, 1e-16);
  // zeta1 = 2 (n + 2) for mg with unit viscosity, zeta2 = 2 for Morris
  EXPECT_NEAR(micropolar_step(2, 0.04, 0.5, 8.0, 0.0), shear_step(Shear::MG, 0.04, 2.0), 1e-17);
  EXPECT_NEAR(micropolar_step(3, 0.04, 0.5, -1.0, 2.0), shear_step(Shear::MORRIS, 0.04, 2.0),
              1e-17);
  EXPECT_NEAR(micropolar_step(2, 0.04, 0.5, 8.0, 2.0), 0.9 * 0.02 / 29.0, 1e-17);
  EXPECT_EQ(shear_step(Shear::NONE, 0.04, 0.5), UNLIMITED_STEP);
  EXPECT_EQ(shear_step(Shear::MG, 0.04, 0.0), UNLIMITED_STEP);
  EXPECT_EQ(bulk_step(0.04, 0.0), UNLIMITED_STEP);
  EXPECT_EQ(vortex_step(0.5, 0.0), UNLIMITED_STEP);
}

TEST(TimeStep, rates_of_viscous_terms_add)
{
  EXPECT_NEAR(combined_step(1.0, {0.3, 0.6}), 0.2, 1e-16);
  EXPECT_EQ(combined_step(0.1, {0.3, 0.6}), 0.1);
  EXPECT_EQ(combined_step(0.1, {UNLIMITED_STEP, UNLIMITED_STEP}), 0.1);
  EXPECT_NEAR(combined_step(1.0, {0.3, UNLIMITED_STEP}), 0.3, 1e-16);
}

// the largest damping rate of a periodic lattice, exact and jittered, from the dense matrix, times
// the step is below the bound 1 of forces that see the extrapolated velocity, and not needlessly
// far below

static double largest_rate(const DenseReference::Matrix &R)
{
  const Eigen::MatrixXd A = R.cast<double>();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

static DenseReference::Particles lattice(int n, int cells, double jitter)
{
  int count = 1;
  for (int k = 0; k < n; k++) count *= cells;
  DenseReference::Particles particles;
  particles.x.resize(n, count);
  particles.v = DenseReference::Matrix::Zero(n, count);
  particles.mass.assign(count, 1.0L);
  particles.energy.assign(count, 0.0L);
  particles.type.assign(count, 1);
  Random random(17);
  for (int i = 0; i < count; i++)
    for (int k = 0, rest = i; k < n; k++, rest /= cells)
      particles.x(k, i) = 0.5 + rest % cells + jitter * random();
  return particles;
}

// the blocks of the spins alone, moment of inertia 1: relaxation and diffusion

static std::array<double, 2> products_of_spin(DenseReference::Model model,
                                              const DenseReference::Box &box,
                                              DenseReference::Particles particles, double hsq)
{
  const int n = model.n;
  particles.spin = DenseReference::Matrix::Zero(n == 2 ? 1 : 3, particles.size());
  std::array<double, 2> products = {};
  for (const bool diffusion : {false, true}) {
    DenseReference::SpinFluid fluid;
    fluid.mu_r = diffusion ? 0.0L : 0.25L;
    fluid.gamma1 = diffusion ? 0.5L : 0.0L;
    fluid.gamma2 = (n == 2) ? -fluid.gamma1 : 0.0L;
    model.spins = {fluid};
    const DenseReference::Matrix R = DenseReference::System(model, box, particles).micropolar().R;
    const int nspin = static_cast<int>(particles.spin.size());
    TypePair pair;
    static_cast<PairFluid &>(pair) = fluid_of(Shear::MICROPOLAR, n);
    pair.viscosity[MU] = 1.0;
    pair.viscosity[MU_R] = double(fluid.mu_r);
    pair.viscosity[GAMMA1] = double(fluid.gamma1);
    pair.viscosity[GAMMA2] = double(fluid.gamma2);
    const PairCoeff coeff = pair_coefficients(pair);
    const double *const diffusive = coeff.of<SpinChannel>();
    products[diffusion] = largest_rate(R.bottomRightCorner(nspin, nspin)) *
        (diffusion ? micropolar_step(n, hsq, 1.0, diffusive[SpinChannel::XI1],
                                     diffusive[SpinChannel::XI2])
                   : vortex_step(1.0, *coeff.of<VortexChannel>()));
  }
  return products;
}

TEST(TimeStep, viscous_limits_against_damping_rates)
{
  const int cells[3] = {40, 12, 6};
  const Kernel kernels[6] = {Kernel::WENDLAND_C2, Kernel::WENDLAND_C4, Kernel::WENDLAND_C6,
                             Kernel::CUBIC,       Kernel::QUINTIC,     Kernel::LUCY};
  double smallest = 1.0, largest = 0.0;
  for (int n = 1; n <= 3; n++) {
    const DenseReference::Matrix cell = DenseReference::Matrix::Identity(n, n) * cells[n - 1];
    for (const double jitter : {0.0, 0.25}) {
      const auto particles = lattice(n, cells[n - 1], jitter);
      for (const Kernel kernel : kernels) {
        DenseReference::Model model;
        model.kernel = kernel_name(kernel);
        model.n = n;
        model.support = n == 1 ? 8.0L : n == 2 ? 4.0L : 3.0L;
        model.fluids = {DenseReference::Fluid{1.0L, 1.0L, 1.0L, 1.0L}};
        const DenseReference::System system(model, {cell, {true, true, true}}, particles);
        const double hsq =
            stability_length_squared(kernel_slope_integral(kernel, n, model.support));

        std::vector<double> products;
        for (const Shear shear : FORMS)
          products.push_back(largest_rate(system.shear(shear_name(shear)).R) *
                             shear_step(shear, hsq, 1.0));
        products.push_back(largest_rate(system.bulk("density", "none").R) * bulk_step(hsq, 1.0));
        if (n == 2 || (n == 3 && kernel == kernels[0]))
          for (const double product :
               products_of_spin(model, {cell, {true, true, true}}, particles, hsq))
            products.push_back(product);
        for (std::size_t k = 0; k < products.size(); k++) {
          SCOPED_TRACE(model.kernel + " n = " + std::to_string(n) + " term " + std::to_string(k));
          EXPECT_LT(products[k], 1.0);
          EXPECT_GT(products[k], 0.4);
          smallest = std::min(smallest, products[k]);
          largest = std::max(largest, products[k]);
        }
      }
    }
  }
  printf("damping rate times recommended step: %.3f to %.3f\n", smallest, largest);
}
