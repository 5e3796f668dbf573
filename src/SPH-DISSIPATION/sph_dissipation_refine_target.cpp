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

#include "sph_dissipation_refine_target.h"

#include "atom.h"
#include "error.h"
#include "group.h"
#include "input.h"
#include "modify.h"
#include "update.h"
#include "variable.h"

#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

static constexpr double WIDEST = 1.0 / 1.5;    // spacing, over the support radius

/* ---------------------------------------------------------------------- */

RefineTarget::RefineTarget(LAMMPS *lmp, const std::string &owner) :
    Pointers(lmp), owner(owner), spacing(false), variable(-1), by_atom(false), given(0.0),
    number(0.0), largest(0.0), dim(0)
{
}

/* ---------------------------------------------------------------------- */

void RefineTarget::set(bool spacing_in, const char *word_in)
{
  spacing = spacing_in;
  word = word_in;
  if (utils::strmatch(word, "^v_"))
    name = word.substr(2);
  else
    given = utils::numeric(FLERR, word, false, lmp);
}

/* ---------------------------------------------------------------------- */

void RefineTarget::init(double support, int dim_in)
{
  dim = dim_in;
  largest = pow(WIDEST * support, dim);
  if (name.empty()) {
    number = checked(given, 0);
    return;
  }
  variable = input->variable->find(name.c_str());
  if (variable < 0) error->all(FLERR, "Variable {} for {} does not exist", name, owner);
  by_atom = input->variable->atomstyle(variable);
  if (!by_atom && !input->variable->equalstyle(variable))
    error->all(FLERR, "Variable {} for {} is neither of equal style nor of atom style", name,
               owner);
}

/* ----------------------------------------------------------------------
   volume of a value that was asked for; tag 0: of all particles
------------------------------------------------------------------------- */

double RefineTarget::checked(double value, tagint tag) const
{
  const double volume = spacing ? pow(value, dim) : value;
  const std::string where = tag ? fmt::format(" for particle {}", tag) : "";
  if (!std::isfinite(value) || !(value > 0.0)) {
    const std::string message =
        fmt::format("{}: the target {} is {}{}, must be > 0", owner, word, value, where);
    if (tag) error->one(FLERR, message);
    error->all(FLERR, message);
  }
  if (volume > largest) {
    const std::string message =
        fmt::format("{}: the target {}{} is a volume of {:g}, larger than {:g}: particles would "
                    "have hardly any neighbors within the support radius",
                    owner, word, where, volume, largest);
    if (tag) error->one(FLERR, message);
    error->all(FLERR, message);
  }
  return volume;
}

/* ---------------------------------------------------------------------- */

void RefineTarget::evaluate(int igroup)
{
  if (name.empty()) return;
  modify->clearstep_compute();
  if (by_atom) {
    const int groupbit = group->bitmask[igroup];
    column.resize(atom->nmax);
    input->variable->compute_atom(variable, igroup, column.data(), 1, 0);
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & groupbit) column[i] = checked(column[i], atom->tag[i]);
  } else
    number = checked(input->variable->compute_equal(variable), 0);
  modify->addstep_compute(update->ntimestep + 1);
}
