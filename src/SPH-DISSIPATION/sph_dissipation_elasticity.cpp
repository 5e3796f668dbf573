/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#include "sph_dissipation_elasticity.h"

#include "atom.h"
#include "math_const.h"
#include "math_extra.h"
#include "sph_dissipation_engine.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

using MathConst::MY_PI;

/* ----------------------------------------------------------------------
   Shear gamma s k, with unit vectors k and s at right angles, moves a neighbor at r by
   gamma s (k.r): d2c/dgamma2 = -sum_j w_j [F (k.r)^2 + F'/r (k.r)^2 (s.r)^2]
   here the sums over the products of components of r, xx yy zz yz xz xy
------------------------------------------------------------------------- */

void LatticeStrain::run(const std::vector<double> &weight)
{
  constexpr double DQ = 1.0e-4;    // for F' by differences
  const LoopData &pairs = engine.pairs();
  const Particle *const particle = engine.particle;
  const int *const type = atom->type;
  const int n = atom->ntypes + 1;
  std::vector<Sum> my_sums(n, Sum());

  with_kernel(engine.parameters().kernel, [&](auto k) {
    engine.visit_pairs([&](int i, int j, bigint entry) {
      if (weight[i] + weight[j] == 0.0) return;
      double r[3];
      for (int d = 0; d < 3; d++) r[d] = particle[i].x[d] - particle[j].x[d];
      const double product[6] = {r[0] * r[0], r[1] * r[1], r[2] * r[2],
                                 r[1] * r[2], r[0] * r[2], r[0] * r[1]};
      const double dist = sqrt(product[0] + product[1] + product[2]);
      if (dist == 0.0) return;
      const double q = dist / engine.parameters().support;
      const double from = std::max(q - DQ, 0.0), to = std::min(q + DQ, 1.0);
      const double derivative = engine.parameters().slope_norm * (k.slope(to) - k.slope(from)) /
          (to - from) / (engine.parameters().support * dist);
      for (const int one : {i, j}) {
        const double each = weight[one] * engine.weight(i + j - one) / engine.density[one].c;
        Sum &sum = my_sums[type[one]];
        for (int a = 0; a < 6; a++) {
          sum.second[a] -= each * pairs.slope[entry] * product[a];
          for (int b = 0; b < 6; b++)
            sum.fourth[a][b] -= each * derivative * product[a] * product[b];
        }
      }
    });
    return 0;
  });

  sums.resize(n);
  MPI_Allreduce(my_sums.data(), sums.data(), n * sizeof(Sum) / sizeof(double), MPI_DOUBLE, MPI_SUM,
                world);
}

/* ----------------------------------------------------------------------
   of the directions of small integer components, among them those in which square, cubic and
   hexagonal lattices have their extremes
------------------------------------------------------------------------- */

double LatticeStrain::largest(int type) const
{
  constexpr int MOST = 3, TURNS = 12;
  const Sum &sum = sums[type];
  const bool flat = (engine.parameters().dim == 2);
  const int most_z = flat ? 0 : MOST, turns = flat ? 1 : TURNS;
  double found = 0.0;

  for (int l = -MOST; l <= MOST; l++)
    for (int m = -MOST; m <= MOST; m++)
      for (int n = -most_z; n <= most_z; n++) {
        if (l == 0 && m == 0 && n == 0) continue;
        double k[3] = {(double) l, (double) m, (double) n}, a[3], b[3] = {0.0, 0.0, 1.0};
        if (l == 0 && m == 0) std::swap(b[0], b[2]);
        MathExtra::norm3(k);
        MathExtra::cross3(k, b, a);
        MathExtra::norm3(a);
        MathExtra::cross3(k, a, b);
        const double square[6] = {k[0] * k[0],       k[1] * k[1],       k[2] * k[2],
                                  2.0 * k[1] * k[2], 2.0 * k[0] * k[2], 2.0 * k[0] * k[1]};
        for (int turn = 0; turn < turns; turn++) {
          const double angle = MY_PI * turn / TURNS;
          double s[3];
          for (int d = 0; d < 3; d++) s[d] = cos(angle) * a[d] + sin(angle) * b[d];
          const double mixed[6] = {k[0] * s[0],
                                   k[1] * s[1],
                                   k[2] * s[2],
                                   k[1] * s[2] + k[2] * s[1],
                                   k[0] * s[2] + k[2] * s[0],
                                   k[0] * s[1] + k[1] * s[0]};
          double change = 0.0;
          for (int c = 0; c < 6; c++) {
            change += square[c] * sum.second[c];
            for (int d = 0; d < 6; d++) change += mixed[c] * sum.fourth[c][d] * mixed[d];
          }
          if (fabs(change) > fabs(found)) found = change;
        }
      }
  return found;
}
