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

#include "sph_dissipation_open_checks.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_sph_bulk.h"
#include "group.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_open_plane.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// particles of the zone that another fix moves, too

static void check_moved_once(LAMMPS *lmp, const Fix *fix, const char *fluid_name)
{
  const Atom *const atom = lmp->atom;
  for (const auto &other : lmp->modify->get_fix_list()) {
    if (other == fix || !other->time_integrate) continue;
    bigint count = 0, total;
    for (int i = 0; i < atom->nlocal; i++)
      if ((atom->mask[i] & fix->groupbit) && (atom->mask[i] & other->groupbit)) count++;
    MPI_Allreduce(&count, &total, 1, MPI_LMP_BIGINT, MPI_SUM, lmp->world);
    if (total)
      lmp->error->all(
          FLERR,
          "Fix {}: {} particles of group {} are also moved by fix {} of style {}; that should "
          "be a fix of group {}",
          fix->style, total, lmp->group->names[fix->igroup], other->id, other->style, fluid_name);
  }
}

/* ---------------------------------------------------------------------- */

void SPHDissipation::check_open_groups(LAMMPS *lmp, const Fix *fix, const PairSPHBulk *pair,
                                       int fluid_group)
{
  const Atom *const atom = lmp->atom;
  const Group *const group = lmp->group;
  const char *const zone_name = group->names[fix->igroup];
  const char *const fluid_name = group->names[fluid_group];
  for (const int g : {fix->igroup, fluid_group})
    if (group->dynamic[g])
      lmp->error->all(FLERR, "Fix {} cannot use dynamic group {}", fix->style, group->names[g]);
  if (atom->firstgroupname)
    lmp->error->all(FLERR,
                    "Fix {} cannot be used with atom_modify first: groups change within a step",
                    fix->style);

  bigint number[2] = {0, 0}, all[2];    // in the zone, in both groups
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & fix->groupbit)) continue;
    number[0]++;
    if (atom->mask[i] & group->bitmask[fluid_group]) number[1]++;
    if (!pair->has_type(atom->type[i]))
      lmp->error->one(FLERR, "Fix {}: particle {} of type {} is not of the fluid", fix->style,
                      atom->tag[i], atom->type[i]);
  }
  MPI_Allreduce(number, all, 2, MPI_LMP_BIGINT, MPI_SUM, lmp->world);
  if (!all[0])
    lmp->error->all(
        FLERR, "Fix {}: group {} is empty; the zone must be filled with particles of the fluid",
        fix->style, zone_name);
  if (all[1])
    lmp->error->all(FLERR, "Fix {}: {} particles are in both groups {} and {}", fix->style, all[1],
                    zone_name, fluid_name);

  for (const auto &other : lmp->modify->get_fix_by_style("^sph/open$"))
    if (other != fix && other->igroup == fix->igroup)
      lmp->error->all(FLERR, "Fix {} {}: group {} has the zone of fix {} already", fix->style,
                      fix->id, zone_name, other->id);
  check_moved_once(lmp, fix, fluid_name);
}

/* ----------------------------------------------------------------------
   what enters is in the group of the fluid and in no other one that it was not in before
------------------------------------------------------------------------- */

FixSPHBulk *SPHDissipation::find_open_integrator(LAMMPS *lmp, const Fix *fix, int fluid_group)
{
  FixSPHBulk *integrator = nullptr;
  for (const auto &other : lmp->modify->get_fix_list()) {
    auto *const candidate = dynamic_cast<FixSPHBulk *>(other);
    if (candidate && candidate->igroup == fluid_group) integrator = candidate;
  }
  if (!integrator)
    lmp->error->all(FLERR,
                    "Fix {}: there is no fix sph/bulk or sph/micropolar of group {}, so that "
                    "nothing moves what enters",
                    fix->style, lmp->group->names[fluid_group]);
  return integrator;
}

/* ---------------------------------------------------------------------- */

void SPHDissipation::check_open_places(LAMMPS *lmp, const Fix *fix, const OpenPlane &plane,
                                       int fluid_bit)
{
  const Atom *const atom = lmp->atom;
  bigint number[3] = {0, 0, 0}, all[3];          // fluid behind, zone in front, others in the zone
  const double slack = 1.0e-6 * plane.length;    // particles may be placed on the plane
  int others = 0;
  for (const auto &other : lmp->modify->get_fix_by_style("^sph/open$"))
    if (other != fix) others |= other->groupbit;
  for (int i = 0; i < atom->nlocal; i++) {
    const double height = plane.height(atom->x[i]);
    const bool behind = height < -slack && height > -plane.length && !plane.beside(atom->x[i]);
    if ((atom->mask[i] & fluid_bit) && behind) number[0]++;
    if ((atom->mask[i] & fix->groupbit) && height > slack) number[1]++;
    if ((atom->mask[i] & others) && behind) number[2]++;
  }
  MPI_Allreduce(number, all, 3, MPI_LMP_BIGINT, MPI_SUM, lmp->world);
  if (all[0] || all[1])
    lmp->error->all(
        FLERR,
        "Fix {}: {} particles of the fluid are behind the plane and {} of the zone in front of "
        "it, seen along the normal, which must point into the fluid",
        fix->style, all[0], all[1]);
  if (all[2])
    lmp->error->all(
        FLERR,
        "Fix {}: {} particles of other open zones are in this one; limit it by the keyword "
        "region",
        fix->style, all[2]);
}

/* ---------------------------------------------------------------------- */

void SPHDissipation::check_open_length(LAMMPS *lmp, const Fix *fix, const OpenPlane &plane,
                                       double support, double spacing)
{
  const double least = 2.0 * support + spacing + lmp->neighbor->skin;
  if (plane.length < least)
    lmp->error->all(FLERR,
                    "Fix {}: the zone must be at least {:g} long, not {:g}: two support radii, the "
                    "distance of two particles, and the neighbor skin",
                    fix->style, least, plane.length);
}

/* ---------------------------------------------------------------------- */

bool SPHDissipation::warn_of_supersonic(LAMMPS *lmp, const Fix *fix, bigint number)
{
  bigint all;
  MPI_Allreduce(&number, &all, 1, MPI_LMP_BIGINT, MPI_SUM, lmp->world);
  if (all && lmp->comm->me == 0)
    lmp->error->warning(FLERR,
                        "Fix {} {}: {} particles leave faster than sound at step {}, where only "
                        "condition fixed with velocity, density and pressure from inside is right",
                        fix->style, fix->id, all, lmp->update->ntimestep);
  return all > 0;
}
