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

#include "sph_dissipation_exclusions.h"

#include "group.h"
#include "neighbor.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

Exclusions::Exclusions(LAMMPS *lmp) : Pointers(lmp) {}

/* ----------------------------------------------------------------------
   clear and the end of LAMMPS delete the neighbor lists before fixes
------------------------------------------------------------------------- */

Exclusions::~Exclusions()
{
  if (neighbor) take_back();
}

/* ---------------------------------------------------------------------- */

void Exclusions::set(const std::vector<Groups> &wanted)
{
  take_back();
  for (const auto &groups : wanted) {
    if (find(groups) >= 0 || find({groups.second, groups.first}) >= 0) continue;
    neighbor->modify_params(fmt::format("exclude group {} {}", group->names[groups.first],
                                        group->names[groups.second]));
    own.push_back(groups);
  }
}

/* ----------------------------------------------------------------------
   index in the list of Neighbor, -1 if it is not there
------------------------------------------------------------------------- */

int Exclusions::find(const Groups &groups) const
{
  for (int n = 0; n < neighbor->nex_group; n++)
    if (neighbor->ex1_group[n] == groups.first && neighbor->ex2_group[n] == groups.second) return n;
  return -1;
}

/* ----------------------------------------------------------------------
   the group bits of the lists in use do not change until Neighbor::init() sets them anew
   (Neighbor::exclusion_group_group_delete() would write past their end if groups have been excluded
   since then)
------------------------------------------------------------------------- */

void Exclusions::take_back()
{
  for (const auto &groups : own) {
    const int n = find(groups);
    if (n < 0) continue;    // neigh_modify exclude none
    const int last = neighbor->nex_group--;
    std::copy(neighbor->ex1_group + n + 1, neighbor->ex1_group + last, neighbor->ex1_group + n);
    std::copy(neighbor->ex2_group + n + 1, neighbor->ex2_group + last, neighbor->ex2_group + n);
  }
  own.clear();
}
