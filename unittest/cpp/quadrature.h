/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// Composite Gauss-Legendre quadrature in long double for the tests of the physics headers: five
// points on each panel, exact for polynomials up to degree 9 per panel.

#ifndef SPHD_QUADRATURE_H
#define SPHD_QUADRATURE_H

#include <cmath>

template <class Function>
long double quadrature(const Function &f, long double a, long double b, int panels)
{
  const long double outer = std::sqrt(5.0L + 2.0L * std::sqrt(10.0L / 7.0L)) / 3.0L;
  const long double inner = std::sqrt(5.0L - 2.0L * std::sqrt(10.0L / 7.0L)) / 3.0L;
  const long double node[5] = {-outer, -inner, 0.0L, inner, outer};
  const long double low = (322.0L - 13.0L * std::sqrt(70.0L)) / 900.0L;
  const long double high = (322.0L + 13.0L * std::sqrt(70.0L)) / 900.0L;
  const long double weight[5] = {low, high, 128.0L / 225.0L, high, low};

  const long double half = 0.5L * (b - a) / panels;
  long double sum = 0.0L;
  for (int p = 0; p < panels; p++)
    for (int k = 0; k < 5; k++) sum += weight[k] * f(a + half * (2 * p + 1 + node[k]));
  return half * sum;
}

#endif
