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

#include "sph_dissipation_create.h"

#include "atom.h"
#include "atom_vec.h"
#include "domain.h"
#include "fix.h"
#include "lammps.h"
#include "modify.h"

#include <algorithm>
#include <map>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

bool SPHDissipation::in_box(LAMMPS *lmp, const double *x)
{
  const Domain *const domain = lmp->domain;
  double place[3] = {x[0], x[1], x[2]}, unit[3] = {x[0], x[1], x[2]};
  if (domain->triclinic) lmp->domain->x2lamda(place, unit);
  const double *const lo = domain->triclinic ? domain->boxlo_lamda : domain->boxlo;
  const double *const hi = domain->triclinic ? domain->boxhi_lamda : domain->boxhi;
  for (int d = 0; d < domain->dimension; d++)
    if (!domain->periodicity[d] && (unit[d] < lo[d] || unit[d] >= hi[d])) return false;
  return true;
}

/* ---------------------------------------------------------------------- */

void SPHDissipation::begin_change(LAMMPS *lmp)
{
  Atom *const atom = lmp->atom;
  if (atom->map_style != Atom::MAP_NONE) atom->map_clear();
  atom->nghost = 0;
  atom->avec->clear_bonus();
}

/* ----------------------------------------------------------------------
   Copy a particle; fixes, computes, and variables set their values of the new one.  Not fix adapt: its values are copied,
   and without values LAMMPS uses a pointer that was never set.
------------------------------------------------------------------------- */

int SPHDissipation::create_copy(LAMMPS *lmp, int i, tagint id, const double *x)
{
  Atom *const atom = lmp->atom;
  const double place[3] = {x[0], x[1],
                           x[2]};    // x may be the place of an atom, which moves in memory
  const int j = atom->nlocal;
  if (j == atom->nmax) atom->avec->grow(0);
  atom->avec->copy(i, j, 0);
  atom->nlocal++;
  atom->tag[j] = id;
  std::copy_n(place, 3, atom->x[j]);

  const auto adapting = lmp->modify->get_fix_by_style("^adapt$");
  for (auto *fix : adapting) fix->create_attribute = 0;
  lmp->modify->create_attribute(j);
  for (auto *fix : adapting) fix->create_attribute = 1;
  return j;
}

/* ---------------------------------------------------------------------- */

void SPHDissipation::remove_particle(LAMMPS *lmp, int i)
{
  Atom *const atom = lmp->atom;
  atom->avec->copy(atom->nlocal - 1, i, 1);
  atom->nlocal--;
}

/* ---------------------------------------------------------------------- */

void SPHDissipation::end_change(LAMMPS *lmp, int nlocal_before)
{
  end_change_by(lmp, over_all<bigint>(lmp->world, lmp->atom->nlocal - nlocal_before, MPI_SUM));
}

void SPHDissipation::end_change_by(LAMMPS *lmp, bigint change)
{
  Atom *const atom = lmp->atom;
  atom->natoms += change;
  if (atom->map_style != Atom::MAP_NONE) {
    atom->map_init();
    atom->map_set();
  }
}

/* ---------------------------------------------------------------------- */

bool SPHDissipation::new_ids(LAMMPS *lmp, const std::vector<NewIDs> &mine, tagint &highest,
                             std::vector<tagint> &first)
{
  constexpr tagint HIGHEST = -1;    // instead of a number, marks the highest ID of a processor
  const Atom *const atom = lmp->atom;
  for (int i = 0; i < atom->nlocal; i++) highest = std::max(highest, atom->tag[i]);
  std::vector<tagint> flat = {highest, HIGHEST};
  for (const NewIDs &one : mine) flat.insert(flat.end(), {one.first, one.second});
  flat = gather_all(lmp->world, flat, MPI_LMP_TAGINT);
  std::map<tagint, tagint> number, first_of;    // by the IDs of the particles
  for (std::size_t k = 0; k < flat.size(); k += 2) {
    if (flat[k + 1] == HIGHEST)
      highest = std::max(highest, flat[k]);
    else
      number[flat[k]] = flat[k + 1];
  }
  for (const auto &one : number) {
    if (highest >= MAXTAGINT - one.second) return false;
    first_of[one.first] = highest + 1;
    highest += one.second;
  }
  first.clear();
  for (const NewIDs &one : mine) first.push_back(first_of[one.first]);
  return true;
}
