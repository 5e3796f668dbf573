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

/* ----------------------------------------------------------------------
   Contributing authors: the SPH-DISSIPATION authors
------------------------------------------------------------------------- */

#include "fix_sph_torque.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_sph_bulk.h"
#include "modify.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_keywords.h"
#include "sph_dissipation_masks.h"
#include "sph_dissipation_value.h"
#include "update.h"

#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

FixSPHTorque::FixSPHTorque(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), value(new Value[3])
{
  if (!Fields::with_spins(atom))
    error->all(FLERR, "Fix {} requires atom style sph/micropolar", style);
  demand_words(lmp, fmt::format("fix {}", style), narg,
               fmt::format("ID group-ID {} Tx Ty Tz", style));
  Keywords(lmp, fmt::format("Fix {}", style), 6, narg, arg).end_here();

  for (int d = 0; d < 3; d++) value[d].set(lmp, arg[3 + d]);

  restart_global = 1;
  scalar_flag = vector_flag = 1;
  size_vector = 3;
  global_freq = 1;
  extscalar = extvector = 1;
  set_masks();
}

/* ---------------------------------------------------------------------- */

FixSPHTorque::~FixSPHTorque() = default;

/* ---------------------------------------------------------------------- */

int FixSPHTorque::setmask()
{
  return POST_FORCE;
}

/* ---------------------------------------------------------------------- */

void FixSPHTorque::init()
{
  if (domain->dimension == 2 && !(value[0].is_zero() && value[1].is_zero()))
    error->all(FLERR, "Fix {}: torque must be along z in 2d", style);
  for (int d = 0; d < 3; d++)
    if (!value[d].init(lmp, fmt::format("fix {}", style), true))
      error->all(FLERR, "Variable {} for fix {} is of invalid style", value[d].name(), style);

  receiving_groups = 0;
  for (const auto &ifix : modify->get_fix_by_style("^sph/micropolar"))
    receiving_groups |= ifix->groupbit;
  datamask_read = datamask_modify = ALL_MASK;    // for setup()
}

/* ---------------------------------------------------------------------- */

void FixSPHTorque::setup(int vflag)
{
  set_up = true;
  check_receivers();
  const double before = work;
  post_force(vflag);
  work = before;
  datamask_modify = ALL_MASK;    // also the inertia
}

/* ----------------------------------------------------------------------
   Set the fields that KOKKOS copies for post_force(); a variable may read any.
------------------------------------------------------------------------- */

void FixSPHTorque::set_masks()
{
  const bool any_variable = value[0].varies() || value[1].varies() || value[2].varies();
  datamask_read = any_variable ? ALL_MASK : MASK_MASK | TORQUE_MASK | INERTIA_MASK | OMEGAEST_MASK;
  datamask_modify = TORQUE_MASK;
}

/* ----------------------------------------------------------------------
   Refuse a group without, and warn of particles without, a spin that follows a torque: a spin with an inertia that a fix
   integrates.  First let the integrators set the inertia, which they would do later in their setup().
------------------------------------------------------------------------- */

void FixSPHTorque::check_receivers()
{
  for (const auto &ifix : modify->get_fix_by_style("^sph/micropolar"))
    dynamic_cast<FixSPHBulk *>(ifix)->set_inertia();

  const double *const inertia = Fields::of(atom)->inertia;
  bigint count[2] = {0, 0},
         all[2];    // particles of the group; those without integrator or inertia
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    count[0]++;
    if (!(atom->mask[i] & receiving_groups) || !(inertia[i] > 0.0)) count[1]++;
  }
  MPI_Allreduce(count, all, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all[1] && all[1] == all[0])
    error->all(FLERR,
               "Fix {}: no particle of its group has an inertia > 0 and a fix sph/micropolar that "
               "integrates its spin",
               style);
  if (all[1] && all[1] != not_receiving && comm->me == 0)
    error->warning(FLERR,
                   "Fix {}: {} of the {} particles of its group get no torque, for they have no "
                   "inertia or their spin is not integrated by a fix sph/micropolar",
                   style, all[1], all[0]);
  not_receiving = all[1];
}

/* ----------------------------------------------------------------------
   Add the torque to the particles.  The torque acts at the end of the step: the power is that with the spins extrapolated
   there, and the work of a step that of the mean power at both ends.
------------------------------------------------------------------------- */

void FixSPHTorque::post_force(int /*vflag*/)
{
  check_set_up(lmp, this, set_up);
  const bool any_variable = value[0].varies() || value[1].varies() || value[2].varies();
  if (any_variable) modify->clearstep_compute();
  for (int d = 0; d < 3; d++) {
    value[d].evaluate(lmp, igroup);
    value[d].demand_finite(lmp, groupbit, fmt::format("Fix {}", style));
  }
  if (any_variable) modify->addstep_compute(update->ntimestep + 1);

  const Fields &fields = *Fields::of(atom);
  const int *const mask = atom->mask;
  const double power_before = power;
  power = total[0] = total[1] = total[2] = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(mask[i] & groupbit) || !(mask[i] & receiving_groups) || !(fields.inertia[i] > 0.0))
      continue;
    for (int d = 0; d < 3; d++) {
      const double torque = value[d](i);
      atom->torque[i][d] += torque;
      total[d] += torque;
      power += torque * fields.omegaest[i][d];
    }
  }
  work += 0.5 * update->dt * (power_before + power);
  set_masks();
}

/* ----------------------------------------------------------------------
   Return the work of the torque since the fix was defined.
------------------------------------------------------------------------- */

double FixSPHTorque::compute_scalar()
{
  return over_all(world, work, MPI_SUM);
}

/* ----------------------------------------------------------------------
   Return the torque on the particles of the group in the last step.
------------------------------------------------------------------------- */

double FixSPHTorque::compute_vector(int d)
{
  return over_all(world, total[d], MPI_SUM);
}

/* ----------------------------------------------------------------------
   Restart files hold the work.
------------------------------------------------------------------------- */

void FixSPHTorque::write_restart(FILE *fp)
{
  const double all = compute_scalar();
  if (comm->me != 0) return;
  const int size = sizeof(double);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(&all, sizeof(double), 1, fp);
}

void FixSPHTorque::restart(char *buf)
{
  if (comm->me == 0) memcpy(&work, buf, sizeof(double));
}

/* ---------------------------------------------------------------------- */

double FixSPHTorque::memory_usage()
{
  return value[0].memory_usage() + value[1].memory_usage() + value[2].memory_usage();
}
