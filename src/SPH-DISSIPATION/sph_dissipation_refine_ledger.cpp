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

#include "sph_dissipation_refine_ledger.h"

#include "comm.h"
#include "force.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

static constexpr double NONE = 1.0e300;    // coldest merge, if there was none

/* ---------------------------------------------------------------------- */

RefineLedger::RefineLedger(LAMMPS *lmp) : Pointers(lmp), sum()
{
  sum[COLDEST] = NONE;
}

/* ---------------------------------------------------------------------- */

void RefineLedger::merged(double heat)
{
  sum[MERGES] += 1.0;
  sum[HEAT] += heat;
  sum[COLDEST] = std::min(sum[COLDEST], heat);
}

/* ---------------------------------------------------------------------- */

void RefineLedger::count(double factor, const Lump &one)
{
  const double mass = factor * one.mass;
  sum[NUMBER] += factor;
  sum[MASS] += mass;
  for (int d = 0; d < 3; d++) {
    sum[MOMENTUM + d] += mass * one.u[d];
    sum[ANGMOM + d] += mass * one.inertia * one.spin[d];
  }
  add_cross(mass, one.x, one.u, sum + ANGMOM);
  sum[KINETIC] +=
      0.5 * force->mvv2e * mass * (dot(one.u, one.u) + one.inertia * dot(one.spin, one.spin));
  sum[INTERNAL] += factor * one.energy;
}

/* ---------------------------------------------------------------------- */

void RefineLedger::total(double *all) const
{
  MPI_Allreduce(sum, all, COLDEST, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(sum + COLDEST, all + COLDEST, 1, MPI_DOUBLE, MPI_MIN, world);
  if (all[COLDEST] == NONE) all[COLDEST] = 0.0;
}

/* ---------------------------------------------------------------------- */

void RefineLedger::restart(const double *all)
{
  std::fill_n(sum, static_cast<int>(NVALUE), 0.0);
  if (comm->me == 0) std::copy_n(all, static_cast<int>(NVALUE), sum);
  if (comm->me != 0 || sum[MERGES] == 0.0) sum[COLDEST] = NONE;
}
