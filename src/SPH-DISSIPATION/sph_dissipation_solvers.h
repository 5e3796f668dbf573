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

// Solution of (M + h Gamma) x = b with a diagonal M of masses, whose inverse is the preconditioner: the
// residual r = b - (M + h Gamma) x and the search directions M^-1 r have the momentum of b, and the
// error of x is at most the residual in the norm of M.
//   conjugate gradients, for a symmetric Gamma
//   BiCGSTAB, H. A. van der Vorst, SIAM J. Sci. Stat. Comput. 13, 631 (1992), for any other Gamma
// Unknowns without mass stay zero.

#ifndef LMP_SPH_DISSIPATION_SOLVERS_H
#define LMP_SPH_DISSIPATION_SOLVERS_H

#include "sph_dissipation_function.h"

#include <algorithm>
#include <cmath>

namespace LAMMPS_NS {
namespace SPHDissipation {

  struct Solution {
    int applications;    // calls of apply()
    double residual;     // relative to the scale
    bool converged;
    bool indefinite;    // the operator is not positive: no solution by conjugate gradients
    bool finite;        // all values are numbers
  };

  // System, on the host or on a device, has
  //   mass, inverse_mass, x     arrays; x is 0 at the start and the solution at the end
  //   residual                  array; b at the start, b - (M + h Gamma) x at the end
  //   double *room(k)           returns array k < 6, for intermediate results
  //   void apply(in, out)       out = (M + h Gamma) in
  //   void for_each(f)          calls f(k) for each unknown k of this processor
  //   double total(f)           returns the sum of what f(k, sum) adds
  //   void sum(values, n)       over all processors, in place
  //   double scale_sq()         this processor's part of the square of the scale, in the norm of M; the largest
  //                             residual is tolerance times the scale, which may depend on x

  template <class System> class Krylov {
   public:
    Krylov(System &system, double tolerance, int most) :
        system(system), tolerance(tolerance), most(most), x(system.x.data()),
        r(system.residual.data()), inverse_mass(system.inverse_mass.data())
    {
    }

    Solution conjugate_gradients()
    {
      double *const p = system.room(0), *const ap = system.room(1);
      double *const x = this->x, *const r = this->r;
      const double *const inverse_mass = this->inverse_mass;
      double before = 1.0;
      while (!finished()) {
        const bool first = (result.applications == 0);
        const double beta = first ? 0.0 : rr / before;
        system.for_each(
            SPH_LAMBDA(int k) { p[k] = inverse_mass[k] * r[k] + (first ? 0.0 : beta * p[k]); });
        apply(p, ap);
        double curvature =
            system.total(SPH_LAMBDA(int k, double &total) { total += p[k] * ap[k]; });
        system.sum(&curvature, 1);
        result.finite = std::isfinite(curvature);
        if (!(curvature > 0.0)) {
          result.indefinite = true;
          break;
        }
        const double alpha = rr / curvature;
        system.for_each(SPH_LAMBDA(int k) {
          x[k] += alpha * p[k];
          r[k] -= alpha * ap[k];
        });
        before = rr;
      }
      return result;
    }

    Solution bi_conjugate_gradients()
    {
      double *const p = system.room(0), *const ap = system.room(1), *const q = system.room(2),
                    *const aq = system.room(3), *const z = system.room(4),
                    *const shadow = system.room(5);
      double *const x = this->x, *const r = this->r;
      const double *const inverse_mass = this->inverse_mass;
      system.for_each(SPH_LAMBDA(int k) {
        p[k] = ap[k] = 0.0;
        shadow[k] = r[k];
      });
      double rho = 1.0, alpha = 1.0, omega = 1.0;
      while (!finished()) {
        double next = product(shadow, r);
        system.sum(&next, 1);
        if (next == 0.0) break;
        const double beta = (result.applications == 0) ? 0.0 : next / rho * alpha / omega;
        rho = next;
        system.for_each(SPH_LAMBDA(int k) {
          p[k] = r[k] + beta * (p[k] - omega * ap[k]);
          z[k] = inverse_mass[k] * p[k];
        });
        apply(z, ap);
        double along = product(shadow, ap);
        system.sum(&along, 1);
        if (along == 0.0) break;
        alpha = rho / along;
        system.for_each(SPH_LAMBDA(int k) {
          x[k] += alpha * z[k];
          r[k] -= alpha * ap[k];
        });
        if (finished()) break;
        system.for_each(SPH_LAMBDA(int k) { q[k] = inverse_mass[k] * r[k]; });
        apply(q, aq);
        double sums[2] = {product(aq, r), product(aq, aq)};
        system.sum(sums, 2);
        result.finite = std::isfinite(sums[0]) && std::isfinite(sums[1]);
        if (!(sums[1] > 0.0) || sums[0] == 0.0) break;
        omega = sums[0] / sums[1];
        system.for_each(SPH_LAMBDA(int k) {
          x[k] += omega * q[k];
          r[k] -= omega * aq[k];
        });
      }
      return result;
    }

    // public, because CUDA requires this of functions with lambdas

    double product(const double *a, const double *b)
    {
      const double *const inverse_mass = this->inverse_mass;
      return system.total(
          SPH_LAMBDA(int k, double &total) { total += a[k] * inverse_mass[k] * b[k]; });
    }

   private:
    System &system;
    const double tolerance;
    const int most;
    double *const x, *const r;
    const double *const inverse_mass;
    Solution result = {0, 0.0, false, false, true};
    double rr = 0.0;    // square of the residual

    void apply(const double *in, double *out)
    {
      system.apply(in, out);
      result.applications++;
    }

    bool finished()
    {
      double sums[2] = {product(r, r), system.scale_sq()};
      system.sum(sums, 2);
      rr = sums[0];
      result.finite = std::isfinite(sums[0]) && std::isfinite(sums[1]);
      result.residual = (sums[1] > 0.0) ? std::sqrt(rr / sums[1]) : (rr > 0.0) ? 1.0 : 0.0;
      result.converged = (rr <= tolerance * tolerance * sums[1]);
      return result.converged || !result.finite || result.applications >= most;
    }
  };

  // Stabilised explicit steps of second order, RKL2: C. D. Meyer, D. S. Balsara, T. D. Aslam, J. Comput.
  // Phys. 257, 594 (2014), (16)-(17).  For dy/dt = L(y), with tau the time step and s stages:
  //   y_1 = y_0 + mu~_1 tau L(y_0)
  //   y_j = mu_j y_(j-1) + nu_j y_(j-2) + (1 - mu_j - nu_j) y_0 + mu~_j tau L(y_(j-1)) + gamma~_j tau L(y_0)
  // y_s is y(tau).  Stable for modes of rates up to rate_limit(s)/tau; an odd s damps the fastest ones.

  class RKL2 {
   public:
    static constexpr int FEWEST = 3, MOST = 1001;

    struct Stage {
      double mu, nu, mu_rate, gamma_rate;    // with the tilde
    };

    explicit RKL2(int nstages) : w1(2.0 / rate_limit(nstages)) {}

    Stage first() const { return {0.0, 0.0, w1 / 3.0, 0.0}; }

    Stage stage(int j) const    // j >= 2
    {
      const double mu = (2.0 * j - 1.0) / j * b(j) / b(j - 1);
      const double nu = -(j - 1.0) / j * b(j) / b(j - 2);
      return {mu, nu, w1 * mu, -(1.0 - b(j - 1)) * w1 * mu};
    }

    static double rate_limit(double nstages) { return 0.5 * (nstages * nstages + nstages - 2.0); }

    // Return the fewest stages, an odd number, for rate times time step; may be more than MOST

    static double stages_for(double rate)
    {
      const double s = std::ceil(0.5 * (std::sqrt(9.0 + 8.0 * rate) - 1.0));
      return std::max<double>(FEWEST, (std::fmod(s, 2.0) == 0.0) ? s + 1.0 : s);
    }

   private:
    double w1;
    static double b(double j)
    {
      return (j < 2.5) ? 1.0 / 3.0 : (j * j + j - 2.0) / (2.0 * j * (j + 1.0));
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
