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

// Stabilised explicit steps of second order, RKL2: C. D. Meyer, D. S. Balsara, T. D. Aslam, J. Comput.
// Phys. 257, 594 (2014), (16)-(17).  For dy/dt = L(y), with tau the time step and s stages:
//   y_1 = y_0 + mu~_1 tau L(y_0)
//   y_j = mu_j y_(j-1) + nu_j y_(j-2) + (1 - mu_j - nu_j) y_0 + mu~_j tau L(y_(j-1)) + gamma~_j tau L(y_0)
// y_s is y(tau).  Stable for modes of rates up to rate_limit(s)/tau; an odd s damps the fastest ones.

#ifndef LMP_SPH_DISSIPATION_RKL2_H
#define LMP_SPH_DISSIPATION_RKL2_H

#include <algorithm>
#include <cmath>

namespace LAMMPS_NS {
namespace SPHDissipation {

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

    // the fewest stages, an odd number, for rate times time step; may be more than MOST

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
