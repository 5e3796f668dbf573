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

#ifndef LMP_SPH_DISSIPATION_TENSOR_H
#define LMP_SPH_DISSIPATION_TENSOR_H

// Products of vectors, and symmetric tensors in one, two, and three dimensions, given by the rows of their upper halves: xx,
// xy, (xz,) yy, (yz, zz).  No LAMMPS include.

#include "sph_dissipation_function.h"

#include <cmath>

namespace LAMMPS_NS {
namespace SPHDissipation {

  SPH_FUNCTION double inner_product(const double *a, const double *b)
  {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  SPH_FUNCTION void cross_product(const double *a, const double *b, double *c)
  {
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
  }

  constexpr int MOST_OF_TENSOR = 6;

  SPH_FUNCTION int size_of_tensor(int dim)
  {
    return dim * (dim + 1) / 2;
  }

  // add weight * r r

  SPH_FUNCTION void add_square(int dim, double weight, const double *r, double *t)
  {
    int m = 0;
    for (int a = 0; a < dim; a++)
      for (int b = a; b < dim; b++) t[m++] += weight * r[a] * r[b];
  }

  // Smallest eigenvalue

  SPH_FUNCTION double smallest_eigenvalue(int dim, const double *t)
  {
    if (dim == 1) return t[0];
    if (dim == 2) {
      const double half = 0.5 * (t[0] - t[2]);
      return 0.5 * (t[0] + t[2]) - std::sqrt(half * half + t[1] * t[1]);
    }
    const double mean = (t[0] + t[3] + t[5]) / 3.0;
    const double a = t[0] - mean, b = t[3] - mean, c = t[5] - mean;
    const double off = t[1] * t[1] + t[2] * t[2] + t[4] * t[4];
    const double p = std::sqrt((a * a + b * b + c * c + 2.0 * off) / 6.0);
    if (!(p > 1.0e-12 * mean)) return mean;
    const double det = a * (b * c - t[4] * t[4]) - t[1] * (t[1] * c - t[4] * t[2]) +
        t[2] * (t[1] * t[4] - b * t[2]);
    const double cosine = std::fmin(std::fmax(0.5 * det / (p * p * p), -1.0), 1.0);
    constexpr double THIRD_OF_CIRCLE = 2.0943951023931954923;
    return mean + 2.0 * p * std::cos(std::acos(cosine) / 3.0 + THIRD_OF_CIRCLE);
  }

  // Solve t x = d, for a tensor t that has an inverse

  SPH_FUNCTION void solve_tensor(int dim, const double *t, const double *d, double *x)
  {
    if (dim == 1)
      x[0] = d[0] / t[0];
    else if (dim == 2) {
      const double inverse = 1.0 / (t[0] * t[2] - t[1] * t[1]);
      x[0] = inverse * (t[2] * d[0] - t[1] * d[1]);
      x[1] = inverse * (t[0] * d[1] - t[1] * d[0]);
    } else {
      const double xx = t[3] * t[5] - t[4] * t[4], xy = t[2] * t[4] - t[1] * t[5];
      const double xz = t[1] * t[4] - t[2] * t[3], yy = t[0] * t[5] - t[2] * t[2];
      const double yz = t[1] * t[2] - t[0] * t[4], zz = t[0] * t[3] - t[1] * t[1];
      const double inverse = 1.0 / (t[0] * xx + t[1] * xy + t[2] * xz);
      x[0] = inverse * (xx * d[0] + xy * d[1] + xz * d[2]);
      x[1] = inverse * (xy * d[0] + yy * d[1] + yz * d[2]);
      x[2] = inverse * (xz * d[0] + yz * d[1] + zz * d[2]);
    }
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
