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

#ifndef LMP_SPH_DISSIPATION_RHEOLOGY_H
#define LMP_SPH_DISSIPATION_RHEOLOGY_H

// Shear viscosities that depend on the rate of shear gamma = sqrt(2 E:E), E = deviator of the rate of strain, and on the
// temperature T.
// In three laws, mu of pair_coeff is the first parameter; a fluid has at most one of these laws:
//   power:    mu gamma^(n-1), between two bounds
//   carreau:  mu_inf + (mu - mu_inf) [1 + (lambda gamma)^a]^((n-1)/a)
//             P. J. Carreau, Trans. Soc. Rheol. 16, 99 (1972); K. Yasuda, R. C. Armstrong, R. E. Cohen, Rheol. Acta 20,
//             163 (1981)
//   cross:    mu_inf + (mu - mu_inf)/[1 + (lambda gamma)^m]       M. M. Cross, J. Colloid Sci. 20, 417 (1965)
// Two terms are added to one of these laws, or to a constant mu:
//   yield:        tau_y [1 - exp(-m gamma)]/gamma                 T. C. Papanastasiou, J. Rheol. 31, 385 (1987)
//   smagorinsky:  rho l^2 gamma up to a bound                     J. Smagorinsky, Mon. Weather Rev. 91, 99 (1963)
// A Bingham fluid has yield, a Herschel-Bulkley fluid has yield with power.  The sum has two factors:
//   arrhenius:    exp[E (1/T - 1/T0)] up to a bound; E = energy of activation over the gas constant
//                 S. Arrhenius, Z. Phys. Chem. 4, 226 (1889)
//   solid:        factor^s with the solid fraction s of keyword melt
// No LAMMPS include.

#include "sph_dissipation_function.h"

#include <algorithm>
#include <cmath>

namespace LAMMPS_NS {
namespace SPHDissipation {

  struct Rheology {
    // Coefficients of a type; the first coefficient of a law is 0 if the type does not have the law
    enum {
      POWER_N,
      POWER_LEAST,
      POWER_MOST,
      CARREAU_LAMBDA,
      CARREAU_N,
      CARREAU_A,
      CARREAU_INF,
      CROSS_LAMBDA,
      CROSS_M,
      CROSS_INF,
      YIELD_STRESS,
      YIELD_M,
      SMAGORINSKY_LENGTH,
      SMAGORINSKY_MOST,
      ARRHENIUS_E,
      ARRHENIUS_T0,
      ARRHENIUS_MOST,
      SOLID_FACTOR,
      NUMBER
    };

    SPH_FUNCTION static double between(double least, double value, double most)
    {
      return (value < least) ? least : (value > most) ? most : value;
    }

    // Return the factor of arrhenius at a temperature; the bound of the factor if T <= 0
    SPH_FUNCTION static double thermal_factor(const double *a, double T)
    {
      if (!(T > 0.0)) return a[ARRHENIUS_MOST];
      const double factor = exp(a[ARRHENIUS_E] * (1.0 / T - 1.0 / a[ARRHENIUS_T0]));
      return (factor < a[ARRHENIUS_MOST]) ? factor : a[ARRHENIUS_MOST];
    }

    // Return the viscosity at this rate of shear, mass density, temperature, and solid fraction
    SPH_FUNCTION static double viscosity(const double *a, double mu, double rho, double rate,
                                         double T, double solid)
    {
      double sum = mu;
      if (a[POWER_N] != 0.0) {
        const double exponent = a[POWER_N] - 1.0;
        const bool constant = exponent == 0.0 || mu == 0.0;
        if (constant || rate > 0.0)
          sum = between(a[POWER_LEAST], constant ? mu : mu * pow(rate, exponent), a[POWER_MOST]);
        else
          sum = (exponent < 0.0) ? a[POWER_MOST] : a[POWER_LEAST];
      } else if (a[CARREAU_LAMBDA] != 0.0) {
        const double x = a[CARREAU_LAMBDA] * rate, exponent = a[CARREAU_A];
        const double x_to_a = (exponent == 2.0) ? x * x
                                                : pow(x, exponent);    // Carreau's 2 is fast
        sum = a[CARREAU_INF] +
            (mu - a[CARREAU_INF]) * pow(1.0 + x_to_a, (a[CARREAU_N] - 1.0) / exponent);
      } else if (a[CROSS_LAMBDA] != 0.0)
        sum = a[CROSS_INF] + (mu - a[CROSS_INF]) / (1.0 + pow(a[CROSS_LAMBDA] * rate, a[CROSS_M]));
      if (a[YIELD_STRESS] != 0.0)
        sum += a[YIELD_STRESS] * ((rate > 0.0) ? -expm1(-a[YIELD_M] * rate) / rate : a[YIELD_M]);
      if (a[SMAGORINSKY_LENGTH] != 0.0)
        sum += between(0.0, rho * a[SMAGORINSKY_LENGTH] * a[SMAGORINSKY_LENGTH] * rate,
                       a[SMAGORINSKY_MOST]);
      if (a[ARRHENIUS_E] != 0.0) sum *= thermal_factor(a, T);
      if (a[SOLID_FACTOR] != 0.0 && solid > 0.0) sum *= pow(a[SOLID_FACTOR], solid);
      return sum;
    }

    // Return the smallest and the largest viscosity of the laws; both grow with mu
    struct Range {
      double least, most;
    };
    static Range range(const double *a, double mu)
    {
      Range of = {mu, mu};
      if (a[POWER_N] == 1.0 || (a[POWER_N] != 0.0 && mu == 0.0))
        of.least = of.most = between(a[POWER_LEAST], mu, a[POWER_MOST]);
      else if (a[POWER_N] != 0.0)
        of = {a[POWER_LEAST], a[POWER_MOST]};
      else if (a[CARREAU_LAMBDA] != 0.0 || a[CROSS_LAMBDA] != 0.0) {
        const double at_end = a[CARREAU_LAMBDA] != 0.0 ? a[CARREAU_INF] : a[CROSS_INF];
        of = {std::min(mu, at_end), std::max(mu, at_end)};
      }
      if (a[YIELD_STRESS] != 0.0) of.most += a[YIELD_STRESS] * a[YIELD_M];
      if (a[SMAGORINSKY_LENGTH] != 0.0) of.most += a[SMAGORINSKY_MOST];
      if (a[ARRHENIUS_E] != 0.0) {
        of.least *= exp(-a[ARRHENIUS_E] / a[ARRHENIUS_T0]);    // T = infinity
        of.most *= a[ARRHENIUS_MOST];
      }
      if (a[SOLID_FACTOR] != 0.0) of.most *= a[SOLID_FACTOR];
      return of;
    }

    // Return the inequality that the coefficients violate, or nullptr
    static const char *inadmissible(const double *a)
    {
      for (int k = 0; k < NUMBER; k++)
        if (!(a[k] >= 0.0 && std::isfinite(a[k])))
          return "power, carreau, cross, yield, smagorinsky, arrhenius, and solid must have "
                 "numbers >= 0";
      if ((a[POWER_N] != 0.0) + (a[CARREAU_LAMBDA] != 0.0) + (a[CROSS_LAMBDA] != 0.0) > 1)
        return "power, carreau, and cross must not be given together";
      const auto some = [a](int from, int to) {
        return std::any_of(a + from, a + to + 1, [](double one) {
          return one != 0.0;
        });
      };
      if (some(POWER_N, POWER_MOST) &&
          !(a[POWER_N] > 0.0 && a[POWER_MOST] > 0.0 && a[POWER_LEAST] <= a[POWER_MOST]))
        return "power must have n > 0 and 0 <= mu_min <= mu_max > 0";
      if (some(CARREAU_LAMBDA, CARREAU_INF) &&
          !(a[CARREAU_LAMBDA] > 0.0 && a[CARREAU_N] <= 1.0 && a[CARREAU_A] > 0.0))
        return "carreau must have lambda > 0, n <= 1, and a > 0";
      if (some(CROSS_LAMBDA, CROSS_INF) && !(a[CROSS_LAMBDA] > 0.0 && a[CROSS_M] > 0.0))
        return "cross must have lambda > 0 and m > 0";
      if (some(YIELD_STRESS, YIELD_M) && !(a[YIELD_STRESS] > 0.0 && a[YIELD_M] > 0.0))
        return "yield must have tau_y > 0 and m > 0";
      if (some(SMAGORINSKY_LENGTH, SMAGORINSKY_MOST) &&
          !(a[SMAGORINSKY_LENGTH] > 0.0 && a[SMAGORINSKY_MOST] > 0.0))
        return "smagorinsky must have length > 0 and mu_max > 0";
      if (some(ARRHENIUS_E, ARRHENIUS_MOST) &&
          !(a[ARRHENIUS_E] > 0.0 && a[ARRHENIUS_T0] > 0.0 && a[ARRHENIUS_MOST] >= 1.0))
        return "arrhenius must have E > 0, T0 > 0, and factor_max >= 1";
      if (a[SOLID_FACTOR] != 0.0 && !(a[SOLID_FACTOR] >= 1.0)) return "solid must be >= 1";
      return nullptr;
    }
  };

  // Return the square of the rate of shear of a particle, 2 E:E to second order; the result may be negative.
  // sum = sum_j V_j F (e.u)^2, with mg/fr2 (r.u)^2; factor = shear_factor()/2; rate = cdot/c; n = dimension.  V (mu gamma^2
  // + kappa (cdot/c)^2) is the heat of the shear and the bulk term.  So the force with the mean of mu_i and mu_j is the
  // derivative of sum_i V_i phi(gamma_i), phi' = mu gamma (theory page).
  SPH_FUNCTION double shear_rate_squared(int n, double factor, double sum, double rate)
  {
    return factor * sum - (1.0 + 2.0 / n) * rate * rate;
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
