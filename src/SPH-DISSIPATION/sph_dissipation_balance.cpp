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
#include "atom_vec_sph_micropolar.h"
#include "comm.h"
#include "domain.h"
#include "force.h"
#include "math_extra.h"
#include "sph_dissipation_open_stage.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

OpenLedger::OpenLedger(LAMMPS *lmp) : Pointers(lmp), sum(), rate() {}

/* ---------------------------------------------------------------------- */

void OpenLedger::carry(Direction direction, int i, const double *v, double esph)
{
  double *const to = sum + (direction == IN ? 0 : NCARRIED);
  const double mass = atom->rmass[i];
  double x[3], moment[3];
  domain->unmap(atom->x[i], atom->image[i], x);
  MathExtra::cross3(x, v, moment);
  to[NUMBER] += 1.0;
  to[MASS] += mass;
  for (int d = 0; d < 3; d++) {
    to[MOMENTUM + d] += mass * v[d];
    to[ANGMOM + d] += mass * moment[d];
  }
  to[KINETIC] += 0.5 * force->mvv2e * mass * MathExtra::lensq3(v);
  to[INTERNAL] += esph;

  auto *spinning = dynamic_cast<AtomVecSPHMicropolar *>(atom->style_match("sph/micropolar"));
  if (!spinning) return;
  const double inertia = mass * spinning->inertia[i];
  const double *const omega = atom->omega[i];
  for (int d = 0; d < 3; d++) to[ANGMOM + d] += inertia * omega[d];
  to[KINETIC] += 0.5 * force->mvv2e * inertia * MathExtra::lensq3(omega);
}

/* ---------------------------------------------------------------------- */

void OpenLedger::set_impact(const OpenImpact &impact)
{
  for (int d = 0; d < 3; d++) {
    rate[d] = force->ftm2v * impact.force[d];
    rate[3 + d] = force->ftm2v * impact.torque[d];
  }
  rate[6] = impact.power;
}

/* ---------------------------------------------------------------------- */

void OpenLedger::advance(double time)
{
  for (int k = IMPULSE; k < NVALUE; k++) sum[k] += time * rate[k - IMPULSE];
}

/* ---------------------------------------------------------------------- */

void OpenLedger::total(double *all) const
{
  MPI_Allreduce(sum, all, NVALUE, MPI_DOUBLE, MPI_SUM, world);
}

/* ---------------------------------------------------------------------- */

void OpenLedger::restart(const double *all)
{
  if (comm->me == 0)
    std::copy_n(all, static_cast<int>(NVALUE), sum);
  else
    std::fill_n(sum, static_cast<int>(NVALUE), 0.0);
}

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
