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

#include "sph_dissipation_checks.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

void SPHDissipation::check_styles(LAMMPS *lmp, const std::string &style)
{
  Force *force = lmp->force;
  Error *error = lmp->error;
  if (!lmp->atom->style_match(style.c_str()))
    error->all(FLERR, "Pair style {} requires atom style {}", style, style);
  if (lmp->modify->get_fix_by_style("^" + style + "$").empty())
    error->all(FLERR, "Pair style {} requires fix {}", style, style);
  if (force->mvv2e != 1.0)
    error->all(FLERR,
               "Pair style {} requires units in which mass * velocity^2 is an energy, not units {}",
               style, lmp->update->unit_style);

  // LAMMPS's own particle fluids read the masses of types, which do not exist here

  for (const char *other : {"sph/heatconduction", "sph/idealgas", "sph/lj", "sph/rhosum",
                            "sph/taitwater", "sph/taitwater/morris", "sdpd/taitwater/isothermal"})
    if (force->pair_match(other, 1))
      error->all(FLERR,
                 "Pair style {} cannot be combined with pair style {}, which needs masses by type",
                 style, other);
}

/* ----------------------------------------------------------------------
   dim 1: the periodic images across the line must not interact
------------------------------------------------------------------------- */

static void check_line_of_particles(LAMMPS *lmp, const std::string &style, double support)
{
  Atom *atom = lmp->atom;
  Domain *domain = lmp->domain;
  Error *error = lmp->error;
  constexpr double FAR = 1.0e300;
  double extent[4] = {-FAR, -FAR, -FAR, -FAR}, all[4];    // largest x, -x, y, -y
  for (int i = 0; i < atom->nlocal; i++)
    for (int d = 0; d < 2; d++) {
      extent[2 * d] = std::max(extent[2 * d], atom->x[i][d]);
      extent[2 * d + 1] = std::max(extent[2 * d + 1], -atom->x[i][d]);
    }
  MPI_Allreduce(extent, all, 4, MPI_DOUBLE, MPI_MAX, lmp->world);

  const int across = (all[0] + all[1] < all[2] + all[3]) ? 0 : 1;
  const double *const prd = domain->prd;
  if (domain->periodicity[across] && prd[across] <= support)
    error->all(FLERR,
               "Pair_style {}: box too narrow for dim 1: its {} extent {} must be "
               "larger than the support radius {}",
               style, "xy"[across], prd[across], support);
}

/* ---------------------------------------------------------------------- */

void SPHDissipation::check_support(LAMMPS *lmp, const std::string &style, int dim, double support)
{
  Comm *comm = lmp->comm;
  Error *error = lmp->error;
  if (comm->cutghostuser > 0.0 && comm->cutghostuser < support)
    error->all(FLERR,
               "The ghost cutoff {} of comm_modify is smaller than the support radius {} of "
               "pair style {}",
               comm->cutghostuser, support, style);
  if (dim == 1) check_line_of_particles(lmp, style, support);
}

/* ---------------------------------------------------------------------- */

void SPHDissipation::check_masses(LAMMPS *lmp, const std::string &style)
{
  Atom *atom = lmp->atom;
  Error *error = lmp->error;
  double lightest = 1.0;
  tagint id = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if (!(atom->rmass[i] > 0.0)) {
      lightest = 0.0;
      id = atom->tag[i];
    }
  double lightest_all;
  tagint id_all;
  MPI_Allreduce(&lightest, &lightest_all, 1, MPI_DOUBLE, MPI_MIN, lmp->world);
  MPI_Allreduce(&id, &id_all, 1, MPI_LMP_TAGINT, MPI_MAX, lmp->world);
  if (lightest_all <= 0.0)
    error->all(FLERR,
               "Pair style {}: mass must be > 0, which that of particle {} is not; "
               "use the set command",
               style, id_all);
}
