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

#include "sph_dissipation_value.h"

#include "atom.h"
#include "error.h"
#include "input.h"
#include "lammps.h"
#include "sph_dissipation_checks.h"
#include "update.h"
#include "variable.h"

#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

void Value::set(LAMMPS *lmp, const std::string &word)
{
  *this = Value();
  is_variable = utils::strmatch(word, "^v_");
  if (is_variable)
    variable_name = word.substr(2);
  else
    number = utils::numeric(FLERR, word, false, lmp);
}

/* ---------------------------------------------------------------------- */

bool Value::init(LAMMPS *lmp, const std::string &owner, bool may_be_by_atom)
{
  if (!varies()) return true;
  Variable *const variables = lmp->input->variable;
  variable = variables->find(variable_name.c_str());
  if (variable < 0)
    lmp->error->all(FLERR, "Variable {} for {} does not exist", variable_name, owner);
  by_atom = may_be_by_atom && variables->atomstyle(variable);
  column.clear();
  return by_atom || variables->equalstyle(variable);
}

/* ---------------------------------------------------------------------- */

void Value::evaluate(LAMMPS *lmp, int igroup)
{
  if (!varies()) return;
  if (by_atom) {
    column.resize(lmp->atom->nmax);
    lmp->input->variable->compute_atom(variable, igroup, column.data(), 1, 0);
  } else
    number = lmp->input->variable->compute_equal(variable);
}

/* ---------------------------------------------------------------------- */

void Value::demand_finite(LAMMPS *lmp, int groupbit, const std::string &owner) const
{
  if (!varies()) return;
  double odd = number;
  std::string where;
  if (by_atom) {
    where = first_particle(
        lmp,
        [&](int i) {
          return (lmp->atom->mask[i] & groupbit) && !std::isfinite(column[i]);
        },
        [&](int i) {
          return column[i];
        },
        odd);
    if (where.empty()) return;
    where = " for " + where;
  } else if (std::isfinite(number))
    return;
  lmp->error->all(FLERR, "{}: variable {} is {}{} at step {}: values must be finite", owner,
                  variable_name, odd, where, lmp->update->ntimestep);
}
