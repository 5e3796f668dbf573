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

#include "sph_dissipation_balance.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "force.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_open_stage.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

static constexpr double NONE = 1.0e300;    // coldest merge, if there was none

/* ---------------------------------------------------------------------- */

void Balance::count(int first, double factor, const Lump &one)
{
  double *const to = sum.data() + first;
  const double mass = factor * one.mass;
  to[0] += factor;
  to[MASS] += mass;
  for (int d = 0; d < 3; d++) {
    to[MOMENTUM + d] += mass * one.u[d];
    to[ANGMOM + d] += mass * one.inertia * one.spin[d];
  }
  add_cross(mass, one.x, one.u, to + ANGMOM);
  to[KINETIC] +=
      0.5 * force->mvv2e * mass * (dot(one.u, one.u) + one.inertia * dot(one.spin, one.spin));
}

/* ---------------------------------------------------------------------- */

void Balance::total(double *all) const
{
  std::copy(sum.begin(), sum.end(), all);
  MPI_Allreduce(MPI_IN_PLACE, all, static_cast<int>(sum.size()), MPI_DOUBLE, MPI_SUM, world);
}

/* ---------------------------------------------------------------------- */

void Balance::restart(const double *all)
{
  if (comm->me == 0)
    std::copy_n(all, sum.size(), sum.data());
  else
    std::fill(sum.begin(), sum.end(), 0.0);
}

/* ---------------------------------------------------------------------- */

void OpenBalance::carry(Direction direction, int i, const double *v, double esph,
                        const Fields &fields)
{
  const int first = (direction == IN ? 0 : NCARRIED);
  Lump one;
  one.mass = atom->rmass[i];
  domain->unmap(atom->x[i], atom->image[i], one.x);
  std::copy_n(v, 3, one.u);
  if (fields.has_spins) {
    one.inertia = fields.inertia[i];
    std::copy_n(atom->omega[i], 3, one.spin);
  }
  count(first, 1.0, one);
  sum[first + INTERNAL] += esph;
}

/* ---------------------------------------------------------------------- */

void OpenBalance::set_impact(const OpenImpact &impact)
{
  for (int d = 0; d < 3; d++) {
    rate[d] = force->ftm2v * impact.force[d];
    rate[3 + d] = force->ftm2v * impact.torque[d];
  }
  rate[6] = impact.power;
}

/* ---------------------------------------------------------------------- */

void OpenBalance::advance(double time)
{
  for (int k = IMPULSE; k < NVALUE; k++) sum[k] += time * rate[k - IMPULSE];
}

/* ---------------------------------------------------------------------- */

RefineBalance::RefineBalance(LAMMPS *lmp) : Balance(lmp, NVALUE)
{
  sum[COLDEST] = NONE;
}

/* ---------------------------------------------------------------------- */

void RefineBalance::merged(double heat)
{
  sum[MERGES] += 1.0;
  sum[HEAT] += heat;
  sum[COLDEST] = std::min(sum[COLDEST], heat);
}

/* ---------------------------------------------------------------------- */

void RefineBalance::count(double factor, const Lump &one)
{
  Balance::count(NUMBER, factor, one);
  sum[INTERNAL] += factor * one.energy;
}

/* ---------------------------------------------------------------------- */

void RefineBalance::total(double *all) const
{
  Balance::total(all);
  all[COLDEST] = over_all(world, sum[COLDEST], MPI_MIN);
  if (all[COLDEST] == NONE) all[COLDEST] = 0.0;
}

/* ---------------------------------------------------------------------- */

void RefineBalance::restart(const double *all)
{
  Balance::restart(all);
  if (comm->me != 0 || sum[MERGES] == 0.0) sum[COLDEST] = NONE;
}
