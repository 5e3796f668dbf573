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

#include "sph_dissipation_stress.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

CentroidTally::CentroidTally(PairTally &next_in, double **stress_in, int nlocal_in,
                             int newton_pair_in) :
    next(next_in),
    stress(stress_in), nlocal(nlocal_in), newton_pair(newton_pair_in)
{
}

/* ---------------------------------------------------------------------- */

void CentroidTally::tally(int i, int j, const double *force_on_i, const double *rij)
{
  static constexpr int POSITION[9] = {0, 1, 2, 0, 0, 1, 1, 2, 2};
  static constexpr int FORCE[9] = {0, 1, 2, 1, 2, 2, 0, 0, 1};

  for (int k = 0; k < 9; k++) {
    const double half = 0.5 * rij[POSITION[k]] * force_on_i[FORCE[k]];
    if (newton_pair || i < nlocal) stress[i][k] += half;
    if (newton_pair || j < nlocal) stress[j][k] += half;
  }
  next.tally(i, j, force_on_i, rij);
}
