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

#include "fix_sph_micropolar.h"

#include "atom.h"
#include "atom_vec_sph_micropolar.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "neighbor.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_integrate.h"
#include "sph_dissipation_model.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

enum { DONE, FACTOR, OFFSET, MASSES, MOTION, NSTATE = MOTION + 4 };    // of a restart file

/* ---------------------------------------------------------------------- */

FixSPHMicropolar::FixSPHMicropolar(LAMMPS *lmp, int narg, char **arg) :
    FixSPHBulk(lmp, 3, arg), inertia_flag(0), factor(0.0), offset(0.0), inertia_done(false)
{
  for (int iarg = 3; iarg < narg;) {
    if (strcmp(arg[iarg], "inertia") != 0) {
      iarg += keyword_argument(iarg, narg, arg);
      continue;
    }
    if (iarg + 3 > narg)
      utils::missing_cmd_args(FLERR, fmt::format("fix {} inertia", style), error);
    inertia_flag = 1;
    factor = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    offset = utils::numeric(FLERR, arg[iarg + 2], false, lmp);
    if (!(factor >= 0.0) || !(offset >= 0.0) || !(factor + offset > 0.0))
      error->all(FLERR, "Fix {} inertia needs two numbers >= 0, one of them > 0, not {} {}", style,
                 arg[iarg + 1], arg[iarg + 2]);
    iarg += 3;
  }
  finish_keywords();
}

/* ---------------------------------------------------------------------- */

void FixSPHMicropolar::init()
{
  FixSPHBulk::init();
  if (inertia_flag && !pair)
    error->all(FLERR, "Fix {} inertia requires pair style {}, which gives the volumes", style,
               style);
}

/* ---------------------------------------------------------------------- */

void FixSPHMicropolar::setup_pre_force(int vflag)
{
  FixSPHBulk::setup_pre_force(vflag);
  if (!has_viscous_stage()) return;    // which needs the inertia for the first forces
  pair->find_volumes();
  set_inertia();
}

/* ---------------------------------------------------------------------- */

void FixSPHMicropolar::setup(int vflag)
{
  set_inertia();
  check_inertia();
  FixSPHBulk::setup(vflag);
}

/* ----------------------------------------------------------------------
   from the volumes of the force computation before; particles that have got their
   inertia keep it, so that angular momentum is conserved
------------------------------------------------------------------------- */

void FixSPHMicropolar::set_inertia()
{
  double *const inertia = spinning()->inertia;
  const double power = 2.0 / domain->dimension;
  if (inertia_flag)
    for (int i = 0; i < atom->nlocal; i++)
      if ((atom->mask[i] & groupbit) && !(inertia_done && inertia[i] > 0.0))
        inertia[i] = factor * pow(atom->vfrac[i], power) + offset;
  inertia_done = true;
}

/* ----------------------------------------------------------------------
   particles that arrive in a run come with a new neighbor list; their volume is not
   known before the forces, so that they get the inertia of their reference volume
------------------------------------------------------------------------- */

void FixSPHMicropolar::pre_force(int vflag)
{
  FixSPHBulk::pre_force(vflag);
  if (neighbor->ago != 0) return;
  set_inertia_of_arrivals();
  check_inertia();
}

/* ---------------------------------------------------------------------- */

void FixSPHMicropolar::set_inertia_of_arrivals()
{
  if (!inertia_flag) return;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) set_inertia_of(i);
}

void FixSPHMicropolar::arrive(int i)
{
  FixSPHBulk::arrive(i);
  if (inertia_flag) set_inertia_of(i);
  if (has_viscous_stage()) pair->carry_other_torque(i);
}

/* ---------------------------------------------------------------------- */

void FixSPHMicropolar::depart(int i)
{
  FixSPHBulk::depart(i);
  const double dti = dtf * TimeStep::inverse_inertia(atom->rmass[i], spinning()->inertia[i]);
  for (int d = 0; d < 3; d++)
    spinning()->omegaest[i][d] = atom->omega[i][d] += dti * atom->torque[i][d];
}

/* ---------------------------------------------------------------------- */

void FixSPHMicropolar::set_inertia_of(int i)
{
  double &inertia = spinning()->inertia[i];
  if (inertia > 0.0) return;
  const auto *pair = PairSPHBulk::find(force);
  const double volume = atom->rmass[i] / pair->reference_density(atom->type[i]);
  inertia = factor * pow(volume, 2.0 / domain->dimension) + offset;
}

/* ---------------------------------------------------------------------- */

bool FixSPHMicropolar::has_torques() const
{
  return pair->fluid().has_torques();
}

/* ----------------------------------------------------------------------
   a torque on a particle without inertia would be lost, and angular momentum with it
------------------------------------------------------------------------- */

void FixSPHMicropolar::check_inertia() const
{
  if (!has_torques()) return;
  const double *const inertia = spinning()->inertia;
  bigint count = 0, all;
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & groupbit) && !(inertia[i] > 0.0)) count++;
  MPI_Allreduce(&count, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all)
    error->all(FLERR,
               "Fix {}: inertia must be > 0 where the fluid exerts torques, which that of {} "
               "particles is not; use {}a data file, or set d_inertia",
               style, all, inertia_flag ? "" : "the inertia keyword, ");
}

/* ---------------------------------------------------------------------- */

void FixSPHMicropolar::reset_extrapolation(int from, int to, int except)
{
  FixSPHBulk::reset_extrapolation(from, to, except);
  double **omega = atom->omega;
  double **omegaest = spinning()->omegaest;
  for (int i = from; i < to; i++) {
    if (atom->mask[i] & except) continue;
    for (int d = 0; d < 3; d++) omegaest[i][d] = omega[i][d];
  }
}

/* ---------------------------------------------------------------------- */

const double *FixSPHMicropolar::spin_of(int i) const
{
  return atom->omega[i];
}

/* ---------------------------------------------------------------------- */

void FixSPHMicropolar::initial_integrate(int vflag)
{
  FixSPHBulk::initial_integrate(vflag);
  integrate_spin(true);
}

/* ---------------------------------------------------------------------- */

void FixSPHMicropolar::final_integrate()
{
  FixSPHBulk::final_integrate();
  integrate_spin(false);
}

/* ----------------------------------------------------------------------
   half a step
------------------------------------------------------------------------- */

void FixSPHMicropolar::integrate_spin(bool begin)
{
  double **omega = atom->omega;
  double **torque = atom->torque;
  double **omegaest = spinning()->omegaest;
  const double *const inertia = spinning()->inertia;
  const double *const rmass = atom->rmass;
  const int *const mask = atom->mask;
  const int nlocal = nlocal_group();
  const TimeStep step = time_step();
  for (int i = 0; i < nlocal; i++) {
    if (!(mask[i] & groupbit)) continue;
    const double inverse = TimeStep::inverse_inertia(rmass[i], inertia[i]);
    const double dti = dtf * inverse;
    if (exact) {
      const double rest =
          rest_of_heat(omega[i], omegaest[i], torque[i], pair->own_torque(i), inverse);
      atom->esph[i] += rest;
      if (!begin) avec()->desph_before[i] += rest;
    }
    for (int d = 0; d < 3; d++) {
      if (begin)
        step.begin_spin(dti, torque[i][d], omega[i][d], omegaest[i][d]);
      else
        step.end(dti, torque[i][d], omega[i][d]);
    }
    if (begin && has_viscous_stage()) pair->carry_other_torque(i);
  }
}

/* ----------------------------------------------------------------------
   a continued run keeps the inertia that its particles have, unless its input gives
   other numbers for it than those by which it was set
------------------------------------------------------------------------- */

void FixSPHMicropolar::write_restart(FILE *fp)
{
  const Motion motion = restart_motion();
  if (comm->me == 0) {
    const double state[NSTATE] = {static_cast<double>(inertia_done),
                                  factor,
                                  offset,
                                  static_cast<double>(density_done),
                                  static_cast<double>(motion.known),
                                  static_cast<double>(motion.sum[0]),
                                  static_cast<double>(motion.sum[1]),
                                  motion.dt};
    const int size = sizeof(state);
    fwrite(&size, sizeof(int), 1, fp);
    fwrite(state, sizeof(double), NSTATE, fp);
  }
}

/* ---------------------------------------------------------------------- */

void FixSPHMicropolar::restart(char *buf)
{
  const auto *state = reinterpret_cast<double *>(buf);
  inertia_done = state[DONE] != 0.0 && state[FACTOR] == factor && state[OFFSET] == offset;
  density_done = (state[MASSES] != 0.0);
  restart_motion(state + MOTION);
}

/* ---------------------------------------------------------------------- */

AtomVecSPHMicropolar *FixSPHMicropolar::spinning() const
{
  return dynamic_cast<AtomVecSPHMicropolar *>(avec());
}
