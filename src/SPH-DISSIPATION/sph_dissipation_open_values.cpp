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

#include "sph_dissipation_open_values.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "group.h"
#include "input.h"
#include "modify.h"
#include "update.h"
#include "variable.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

OpenValues::OpenValues(LAMMPS *lmp, const std::string &owner) :
    Pointers(lmp), owner(owner), number(), any_variable(false), needs_energy(false)
{
}

/* ---------------------------------------------------------------------- */

int OpenValues::keyword_argument(int iarg, int narg, char **arg)
{
  struct Keyword {
    const char *name;
    Quantity first;
    int n;
    bool or_inside;    // can be taken from inside
  };
  static constexpr Keyword KEYWORDS[] = {{"velocity", VX, 3, true},
                                         {"density", RHO, 1, true},
                                         {"pressure", P, 1, true},
                                         {"energy", ENERGY, 1, false},
                                         {"spin", WX, 3, false}};
  for (const auto &keyword : KEYWORDS) {
    if (strcmp(arg[iarg], keyword.name) != 0) continue;
    auto needs = [&](int n) {
      if (iarg + n >= narg)
        utils::missing_cmd_args(FLERR, fmt::format("{} {}", utils::lowercase(owner), keyword.name),
                                error);
    };
    needs(1);
    for (int k = 0; k < keyword.n; k++) value[keyword.first + k] = Value();
    if (keyword.or_inside && strcmp(arg[iarg + 1], "inside") == 0) return 2;
    needs(keyword.n);
    for (int k = 0; k < keyword.n; k++)
      set(static_cast<Quantity>(keyword.first + k), arg[iarg + 1 + k]);
    return keyword.n + 1;
  }
  return 0;
}

/* ---------------------------------------------------------------------- */

void OpenValues::set(Quantity k, const char *word)
{
  value[k].given = true;
  if (utils::strmatch(word, "^v_"))
    value[k].name = word + 2;
  else
    number[k] = utils::numeric(FLERR, word, false, lmp);
}

/* ---------------------------------------------------------------------- */

void OpenValues::check() const
{
  if (given(RHO) && given(P))
    error->all(FLERR, "{}: density and pressure cannot both be given, one follows from the other",
               owner);
  if (given(WX) && !atom->omega)
    error->all(FLERR, "{} spin requires atom style sph/micropolar", owner);
}

/* ---------------------------------------------------------------------- */

const char *OpenValues::fault(Quantity k, double x) const
{
  if (!std::isfinite(x)) return "values must be finite";
  if (domain->dimension == 2 && x != 0.0) {
    if (k == VZ) return "velocity must lie in the plane in 2d";
    if (k == WX || k == WY) return "spin must be along z in 2d";
  }
  if (k == ENERGY && needs_energy && !(x > 0.0)) return "energy must be > 0 with eos ideal";
  return nullptr;
}

/* ---------------------------------------------------------------------- */

void OpenValues::init(bool needs_energy_in)
{
  any_variable = false;
  needs_energy = needs_energy_in;
  for (int k = 0; k < NQUANTITY; k++) {
    Value &one = value[k];
    column[k].clear();
    if (one.name.empty()) {
      const char *const wrong = fault(static_cast<Quantity>(k), number[k]);
      if (one.given && wrong)
        error->all(FLERR, "{}: {:g} cannot be used: {}", owner, number[k], wrong);
      continue;
    }
    any_variable = true;
    one.variable = input->variable->find(one.name.c_str());
    if (one.variable < 0) error->all(FLERR, "Variable {} for {} does not exist", one.name, owner);
    one.by_atom = input->variable->atomstyle(one.variable);
    if (!one.by_atom && !input->variable->equalstyle(one.variable))
      error->all(FLERR, "Variable {} for {} is neither of equal style nor of atom style", one.name,
                 owner);
  }
}

/* ---------------------------------------------------------------------- */

void OpenValues::evaluate(int igroup)
{
  if (!any_variable) return;
  const int groupbit = group->bitmask[igroup];
  const int nlocal = atom->nlocal;
  modify->clearstep_compute();
  for (int k = 0; k < NQUANTITY; k++) {
    const Value &one = value[k];
    if (one.name.empty()) continue;
    if (!one.by_atom) {
      number[k] = input->variable->compute_equal(one.variable);
      if (const char *const wrong = fault(static_cast<Quantity>(k), number[k]))
        error->all(FLERR, "{}: variable {} is {} at step {}: {}", owner, one.name, number[k],
                   update->ntimestep, wrong);
      continue;
    }
    column[k].resize(atom->nmax);
    input->variable->compute_atom(one.variable, igroup, column[k].data(), 1, 0);
    for (int i = 0; i < nlocal; i++) {
      if (!(atom->mask[i] & groupbit)) continue;
      if (const char *const wrong = fault(static_cast<Quantity>(k), column[k][i]))
        error->one(FLERR, "{}: variable {} is {} for particle {} at step {}: {}", owner, one.name,
                   column[k][i], atom->tag[i], update->ntimestep, wrong);
    }
  }
  modify->addstep_compute(update->ntimestep + 1);
}

/* ---------------------------------------------------------------------- */

double OpenValues::memory_usage() const
{
  double bytes = 0.0;
  for (const auto &one : column) bytes += static_cast<double>(one.capacity() * sizeof(double));
  return bytes;
}
