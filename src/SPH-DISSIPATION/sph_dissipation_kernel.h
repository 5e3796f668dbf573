/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#ifndef LMP_SPH_DISSIPATION_KERNEL_H
#define LMP_SPH_DISSIPATION_KERNEL_H

// Smoothing kernels of package SPH-DISSIPATION.  No LAMMPS include.
//
// With R the support radius, q = r/R and n the dimension of the kernel
//
//   W(r) = A_n / R^n     * shape(q)     number density weight, units 1/length^n
//   F(r) = A_n / R^(n+2) * slope(q)     = -(1/r) dW/dr >= 0, units 1/length^(n+2)
//
// both zero for r >= R, with the integral of W over all space equal to one.
// slope(0) is finite and positive.  shape() and slope() expect 0 <= q <= 1, are
// free of branches, and can be evaluated for many pairs at once.
//
// Wendland functions: H. Wendland, Adv. Comput. Math. 4, 389 (1995), the polynomials of
// 2 and 3 dimensions for every n.  Lucy: Astron. J. 82, 1013 (1977).  Splines: J. J. Monaghan,
// Rep. Prog. Phys. 68, 1703 (2005).

#include "sph_dissipation_function.h"

#include <cmath>

namespace LAMMPS_NS {
namespace SPHDissipation {

  constexpr double KERNEL_PI = 3.14159265358979323846;

  // Return the surface of the unit sphere in n = 1, 2, 3 dimensions

  inline double unit_sphere_surface(int n)
  {
    return (n == 1) ? 2.0 : (n == 2) ? 2.0 * KERNEL_PI : 4.0 * KERNEL_PI;
  }

  enum class Kernel { WENDLAND_C2, WENDLAND_C4, WENDLAND_C6, CUBIC, QUINTIC, LUCY };

#include "sph_dissipation_kernel_shapes.h"

  inline const char *kernel_name(Kernel kernel)
  {
    return with_kernel(kernel, [](auto k) {
      return decltype(k)::name;
    });
  }

  // Return W(r), and F(r) = -(1/r) dW/dr, of one pair; the pair loops use shape() and slope() directly

  inline double kernel_weight(Kernel kernel, int n, double r, double support)
  {
    if (r >= support) return 0.0;
    double volume = support;
    for (int d = 1; d < n; d++) volume *= support;
    return with_kernel(kernel, [=](auto k) {
      return k.norm(n) / volume * k.shape(r / support);
    });
  }

  inline double kernel_slope(Kernel kernel, int n, double r, double support)
  {
    if (r >= support) return 0.0;
    double volume = support * support * support;
    for (int d = 1; d < n; d++) volume *= support;
    return with_kernel(kernel, [=](auto k) {
      return k.norm(n) / volume * k.slope(r / support);
    });
  }

  // Return the integral of integrand(q) over the unit n-ball, by Gauss-Legendre with 8 points on each sixth of [0,1]: exact
  // for every kernel above, whose pieces join at multiples of 1/6 and stay below degree 16.

  template <class Function> double unit_ball_integral(int n, Function &&integrand)
  {
    constexpr int PANELS = 6;
    constexpr int POINTS = 4;
    constexpr double NODE[POINTS] = {0.18343464249564980494, 0.52553240991632898582,
                                     0.79666647741362673959, 0.96028985649753623168};
    constexpr double WEIGHT[POINTS] = {0.36268378337836198297, 0.31370664587788728734,
                                       0.22238103445337447054, 0.10122853629037625915};
    double sum = 0.0;
    for (int panel = 0; panel < PANELS; panel++)
      for (int point = 0; point < 2 * POINTS; point++) {
        const double node = (point < POINTS) ? NODE[point] : -NODE[point - POINTS];
        const double q = (panel + 0.5 + 0.5 * node) / PANELS;
        double measure = 1.0;
        for (int d = 1; d < n; d++) measure *= q;
        sum += WEIGHT[point % POINTS] * measure * integrand(q);
      }
    return unit_sphere_surface(n) * sum / (2.0 * PANELS);
  }

  // Return the integral of r^power W, power = 1 or 2; <r> is in the weight F r of P1 (15) and (49), <r^2> in the weight F
  // r^2

  inline double kernel_mean(Kernel kernel, int n, int power, double support)
  {
    const double mean = with_kernel(kernel, [=](auto k) {
      return k.norm(n) * unit_ball_integral(n, [=](double q) {
               return (power == 2) ? q * q * k.shape(q) : q * k.shape(q);
             });
    });
    return (power == 2) ? support * support * mean : support * mean;
  }

  // Kernel of the energy of pairs of unlike types, W = norm (1 - q^2)^2: the force is small at short distances, so the energy
  // of an interface hardly depends on the arrangement of the particles next to the interface.
  // Particles at a plane form rows at the distance d = V^(1/n), the first one d/2 from the plane.  The sum over the rows is
  // less than the integral of z W_1(z), with W_1 the integral of W over a plane: by d^2 W_1(0)/12, the first term of Euler
  // and Maclaurin, which is the part ROWS d^2/R^2 of the integral.

  struct PairEnergyKernel {
    double weight_norm, slope_norm, support_sq_inv, rows;

    PairEnergyKernel(int n, double support) : support_sq_inv(1.0 / (support * support))
    {
      constexpr double NORM[] = {0.0, 15.0 / 16.0, 3.0 / KERNEL_PI, 105.0 / (32.0 * KERNEL_PI)};
      constexpr double ROWS[] = {0.0, 1.0 / 2.0, 7.0 / 12.0, 2.0 / 3.0};
      weight_norm = NORM[n];
      for (int d = 0; d < n; d++) weight_norm /= support;
      slope_norm = 4.0 * weight_norm * support_sq_inv;
      rows = ROWS[n] * support_sq_inv;
    }
    SPH_FUNCTION double weight(double rsq) const
    {
      const double rest = 1.0 - rsq * support_sq_inv;
      return weight_norm * rest * rest;
    }
    SPH_FUNCTION double slope(double rsq) const
    {
      return slope_norm * (1.0 - rsq * support_sq_inv);
    }
    // Return the factor that corrects the sum over rows of particles with these distances V^(1/n)
    SPH_FUNCTION double of_rows(double d_i, double d_j) const { return 1.0 + rows * d_i * d_j; }

    // Return the integral of |z| W, a length
    static double mean_distance(int n, double support)
    {
      constexpr double MEAN[] = {0.0, 5.0 / 16.0, 32.0 / (35.0 * KERNEL_PI), 35.0 / 128.0};
      return MEAN[n] * support;
    }
  };

  // Kernel of the energy of cohesion, A w_i w_j [W(r; b R) - W(r; R)] with Wendland C6 and b = INNER.  Both parts
  // have the integral 1: the energy and the pressure inside of a fluid vanish, and a surface lacks the energy A (1 - b) <|x|>/4
  // per area.  The Fourier transform of the difference is positive, so that the energy keeps particles apart.

  struct CohesionKernel {
    static constexpr double INNER = 0.85;
    double support_inv[2], weight_norm[2], slope_norm[2];    // of the inner part, of the outer part

    CohesionKernel(int n, double support)
    {
      for (int k = 0; k < 2; k++) {
        const double radius = (k == 0) ? INNER * support : support;
        support_inv[k] = 1.0 / radius;
        weight_norm[k] = WendlandC6::norm(n);
        for (int d = 0; d < n; d++) weight_norm[k] *= support_inv[k];
        slope_norm[k] = weight_norm[k] * support_inv[k] * support_inv[k];
      }
    }
    SPH_FUNCTION double weight(double r) const { return part(0, r, true) - part(1, r, true); }
    SPH_FUNCTION double slope(double r) const { return part(0, r, false) - part(1, r, false); }

    // Return A for this tension of a free surface.  The particles at a surface are no section of a uniform fluid: the
    // tension of drops is SURFACE times the integral's tension, see test_cohesion.py
    static double coefficient(int n, double support, double sigma)
    {
      constexpr double ALONG[] = {0.0, 1.0, 2.0 / KERNEL_PI, 0.5};    // <|x|>/<r>
      constexpr double SURFACE[] = {1.0, 1.0, 1.33, 1.37};
      const double mean = ALONG[n] * kernel_mean(Kernel::WENDLAND_C6, n, 1, support);
      return 4.0 * sigma / (SURFACE[n] * (1.0 - INNER) * mean);
    }

   private:
    SPH_FUNCTION double part(int k, double r, bool weight) const
    {
      const double q = r * support_inv[k];
      if (q >= 1.0) return 0.0;
      return weight ? weight_norm[k] * WendlandC6::shape(q) : slope_norm[k] * WendlandC6::slope(q);
    }
  };

  // Sums of V W and of V F r^2/n over a cubic lattice of this spacing, V = spacing^n: the integrals of both are 1

  struct LatticeSums {
    double zeroth, second;
  };

  inline LatticeSums kernel_lattice_sums(Kernel kernel, int n, double support, double spacing)
  {
    const int reach = static_cast<int>(support / spacing);
    LatticeSums sum = {0.0, 0.0};
    double vol = 1.0;
    for (int d = 0; d < n; d++) vol *= spacing;
    for (int i = -reach; i <= reach; i++)
      for (int j = (n > 1) ? -reach : 0; j <= ((n > 1) ? reach : 0); j++)
        for (int k = (n > 2) ? -reach : 0; k <= ((n > 2) ? reach : 0); k++) {
          const double r = spacing * std::sqrt(static_cast<double>(i * i + j * j + k * k));
          sum.zeroth += vol * kernel_weight(kernel, n, r, support);
          sum.second += vol * r * r * kernel_slope(kernel, n, r, support) / n;
        }
    return sum;
  }

  // Return the integral of F, 1/length^2: 14/R^2 for Wendland C2 in 2 and 3 dimensions

  inline double kernel_slope_integral(Kernel kernel, int n, double support)
  {
    return with_kernel(kernel,
                       [=](auto k) {
                         return k.norm(n) * unit_ball_integral(n, [=](double q) {
                                  return k.slope(q);
                                });
                       }) /
        (support * support);
  }

  // Return the Fourier transform of W, the integral of W(r) exp(i k.r), 1 for k = 0.  A shell of radius r has the transform
  // cos(k r), J_0(k r), sin(k r)/(k r) in 1, 2, 3 dimensions.

  inline double kernel_transform(Kernel kernel, int n, double k, double support)
  {
    return with_kernel(kernel, [=](auto shape) {
      return shape.norm(n) * unit_ball_integral(n, [=](double q) {
               const double kr = k * support * q;
               const double wave = (n == 1) ? std::cos(kr)
                   : (n == 2)               ? ::j0(kr)
                                            : (kr > 0.0 ? std::sin(kr) / kr : 1.0);
               return wave * shape.shape(q);
             });
    });
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS
#endif
