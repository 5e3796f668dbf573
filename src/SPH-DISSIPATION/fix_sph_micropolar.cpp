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
#include "pair_sph_micropolar.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

FixSPHMicropolar::FixSPHMicropolar(LAMMPS *lmp, int narg, char **arg) :
    FixSPHBulk(lmp, 3, arg), avec(nullptr), inertia_flag(0), factor(0.0), offset(0.0),
    inertia_done(0)
{
  restart_global = 1;

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
}

/* ---------------------------------------------------------------------- */

void FixSPHMicropolar::init()
{
  FixSPHBulk::init();
  avec = dynamic_cast<AtomVecSPHMicropolar *>(atom->style_match(style));
}

/* ----------------------------------------------------------------------
   the first force computation has given the volumes that the inertia is set from
------------------------------------------------------------------------- */

void FixSPHMicropolar::setup(int vflag)
{
  int *mask = atom->mask;
  if (inertia_flag && !inertia_done) {
    const double power = 2.0 / domain->dimension;
    for (int i = 0; i < atom->nlocal; i++)
      if (mask[i] & groupbit) avec->inertia[i] = factor * pow(atom->vfrac[i], power) + offset;
  }
  inertia_done = 1;
  FixSPHBulk::setup(vflag);

  auto *pair = dynamic_cast<PairSPHMicropolar *>(force->pair_match(style, 1));
  if (!pair || !pair->has_torques()) return;
  tagint id = 0, id_all;
  for (int i = 0; i < atom->nlocal; i++)
    if ((mask[i] & groupbit) && !(avec->inertia[i] > 0.0)) id = atom->tag[i];
  MPI_Allreduce(&id, &id_all, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if (id_all)
    error->all(FLERR,
               "Fix {}: inertia must be > 0, which that of particle {} is not; use the inertia "
               "keyword or a data file",
               style, id_all);
}

/* ---------------------------------------------------------------------- */

void FixSPHMicropolar::reset_extrapolation(int i)
{
  FixSPHBulk::reset_extrapolation(i);
  for (int d = 0; d < 3; d++) avec->omegaest[i][d] = atom->omega[i][d];
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
   half a step; particles without inertia keep their spin; setup() has seen to it
   that they have no torque
------------------------------------------------------------------------- */

void FixSPHMicropolar::integrate_spin(bool extrapolate)
{
  double **omega = atom->omega;
  double **torque = atom->torque;
  double *rmass = atom->rmass;
  int *mask = atom->mask;
  const int nlocal = nlocal_group();
  for (int i = 0; i < nlocal; i++) {
    if (!(mask[i] & groupbit)) continue;
    const double inertia = rmass[i] * avec->inertia[i];
    const double dtirotate = (inertia > 0.0) ? dtf / inertia : 0.0;
    for (int d = 0; d < 3; d++) {
      const double domega = dtirotate * torque[i][d];
      omega[i][d] += domega;
      if (extrapolate) avec->omegaest[i][d] = omega[i][d] + domega;
    }
  }
}

/* ----------------------------------------------------------------------
   the inertia is set once; a continued run keeps the one of its restart file
------------------------------------------------------------------------- */

void FixSPHMicropolar::write_restart(FILE *fp)
{
  if (comm->me == 0) {
    const int size = sizeof(double);
    const double done = inertia_done;
    fwrite(&size, sizeof(int), 1, fp);
    fwrite(&done, sizeof(double), 1, fp);
  }
}

/* ---------------------------------------------------------------------- */

void FixSPHMicropolar::restart(char *buf)
{
  inertia_done = static_cast<int>(reinterpret_cast<double *>(buf)[0]);
}
