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

#ifndef LMP_SPH_DISSIPATION_SYMMETRIC_H
#define LMP_SPH_DISSIPATION_SYMMETRIC_H

// Symmetric tensors of three dimensions for package SPH-DISSIPATION.  No LAMMPS include.

#include <cmath>

namespace LAMMPS_NS {
namespace SPHDissipation {

  struct Symmetric {
    double a[3][3] = {};

    void add_product(double factor, const double *r)
    {
      for (int d = 0; d < 3; d++)
        for (int e = 0; e < 3; e++) a[d][e] += factor * r[d] * r[e];
    }
    double trace() const { return a[0][0] + a[1][1] + a[2][2]; }

    // of the moments sum m r r: the tensor of inertia

    Symmetric inertia() const
    {
      Symmetric result;
      const double sum = trace();
      for (int d = 0; d < 3; d++)
        for (int e = 0; e < 3; e++) result.a[d][e] = (d == e ? sum : 0.0) - a[d][e];
      return result;
    }
  };

  struct Eigen3 {
    double value[3];
    double axis[3][3];    // unit vectors
  };

  // Jacobi's method.  What is off the diagonal by round-off alone stays there, so that axes of an
  // isotropic tensor are those of the coordinates whatever the round-off.

  inline Eigen3 eigen(Symmetric s)
  {
    constexpr int SWEEPS = 30;
    constexpr double ROUNDOFF = 1.0e-11;
    Eigen3 result = {{0.0, 0.0, 0.0}, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    auto &a = s.a;
    const double small = ROUNDOFF * (std::fabs(a[0][0]) + std::fabs(a[1][1]) + std::fabs(a[2][2]));
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
      bool done = true;
      for (int p = 0; p < 2; p++)
        for (int q = p + 1; q < 3; q++) {
          if (!(std::fabs(a[p][q]) > (sweep ? 1.0e-6 : 1.0) * small)) continue;
          done = false;
          const double theta = 0.5 * (a[q][q] - a[p][p]) / a[p][q];
          const double t =
              (theta < 0.0 ? -1.0 : 1.0) / (std::fabs(theta) + std::sqrt(theta * theta + 1.0));
          const double c = 1.0 / std::sqrt(t * t + 1.0), sn = t * c;
          for (int k = 0; k < 3; k++) {
            const double x = a[k][p], y = a[k][q];
            a[k][p] = c * x - sn * y;
            a[k][q] = sn * x + c * y;
          }
          for (int k = 0; k < 3; k++) {
            const double x = a[p][k], y = a[q][k];
            a[p][k] = c * x - sn * y;
            a[q][k] = sn * x + c * y;
          }
          for (int k = 0; k < 3; k++) {
            const double x = result.axis[p][k], y = result.axis[q][k];
            result.axis[p][k] = c * x - sn * y;
            result.axis[q][k] = sn * x + c * y;
          }
        }
      if (done) break;
    }
    for (int d = 0; d < 3; d++) result.value[d] = a[d][d];
    return result;
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
