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

#include "sph_dissipation_refine_rest.h"

#include "atom.h"
#include "domain.h"
#include "neigh_list.h"
#include "sph_dissipation_refine_items.h"
#include "sph_dissipation_refine_pairs.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ----------------------------------------------------------------------
   from one point to another one
------------------------------------------------------------------------- */

void RefineRest::offset(int from, int to, double *r) const
{
  const RefineItem &a = items[from], &b = items[to];
  for (int d = 0; d < 3; d++) r[d] = (b.lump.x[d] - a.lump.x[d]) + (b.center[d] - a.center[d]);
}

/* ---------------------------------------------------------------------- */

bool RefineRest::give(NeighList *full, int i, const double *angmom)
{
  Shell shell;
  const int *const neighbors = full->firstneigh[i];
  for (int k = 0; k < full->numneigh[i]; k++) {
    const int j = neighbors[k] & NEIGHMASK;
    if (!(items[j].mass > 0.0)) continue;
    double r[3];
    offset(i, j, r);
    const double weight = shell_weight(dot(r, r), radius);
    if (weight > 0.0) shell.add(weight * items[j].mass, r, items[j].u);
  }
  const bool taken = shell.take(angmom, domain->dimension, items[i].rotation);
  items[i].gives = taken ? 1.0 : 0.0;
  return taken;
}

/* ---------------------------------------------------------------------- */

void RefineRest::clear()
{
  du.assign(3 * atom->nlocal, 0.0);
  works.assign(atom->nlocal, 0.0);
}

/* ---------------------------------------------------------------------- */

void RefineRest::take(NeighList *full)
{
  clear();
  for (int ii = 0; ii < full->inum; ii++) {
    const int i = full->ilist[ii];
    if (items[i].is(APART)) continue;
    const int point = (items[i].mass > 0.0) ? i : pairs.mate(i);
    const int *const neighbors = full->firstneigh[i];
    for (int k = 0; k < full->numneigh[i]; k++) {
      const int j = neighbors[k] & NEIGHMASK;
      if (items[j].gives == 0.0 || j == point) continue;
      double r[3], one[3] = {0.0, 0.0, 0.0};
      offset(j, point, r);
      const double weight = shell_weight(dot(r, r), radius);
      if (!(weight > 0.0)) continue;
      items[j].rotation.velocity(weight, r, one);
      for (int d = 0; d < 3; d++) {
        du[3 * i + d] += one[d];
        works[i] += items[i].mass * (items[i].u[d] - items[j].rotation.mean[d]) * one[d];
      }
    }
    works[i] += 0.5 * items[i].mass * dot(&du[3 * i], &du[3 * i]);
  }
}
