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

#include "sph_dissipation_fields.h"

#include "atom.h"
#include "atom_vec.h"
#include "sph_dissipation_channels.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

const std::vector<StateInfo> &SPHDissipation::state_table()
{
  static const std::vector<StateInfo> table = States::table<TypeCoeffs>();
  return table;
}

/* ---------------------------------------------------------------------- */

const StateInfo &SPHDissipation::state_info(int slot)
{
  const StateInfo *one = state_table().data();
  while (slot >= one->first + one->most) one++;
  return *one;
}

/* ---------------------------------------------------------------------- */

Fields *Fields::of(Atom *atom)
{
  if (auto *fields = dynamic_cast<Fields *>(atom->avec)) return fields;
  for (const char *const style : {"sph/bulk", "sph/micropolar"})    // of hybrid
    if (auto *fields = dynamic_cast<Fields *>(atom->style_match(style))) return fields;
  return nullptr;
}

/* ---------------------------------------------------------------------- */

Fields *Fields::with_spins(Atom *atom)
{
  Fields *const fields = of(atom);
  return fields && fields->has_spins ? fields : nullptr;
}

/* ---------------------------------------------------------------------- */

int Fields::room(const StateInfo &one) const
{
  return std::count_if(slots.begin(), slots.end(), [&](int slot) {
    return slot >= one.first && slot < one.first + one.most;
  });
}

/* ---------------------------------------------------------------------- */

std::string Fields::state_name(int slot)
{
  const StateInfo &one = state_info(slot);
  return (one.most > 1) ? one.field + std::to_string(slot - one.first + 1) : one.field;
}
