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
#include "fix.h"
#include "force.h"
#include "group.h"
#include "input.h"
#include "lammps.h"
#include "math_extra.h"
#include "modify.h"
#include "neighbor.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_traces.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <vector>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

std::string SPHDissipation::first_particle(LAMMPS *lmp, const std::function<bool(int)> &wrong)
{
  double ignored;
  return first_particle(
      lmp, wrong,
      [](int) {
        return 0.0;
      },
      ignored);
}

/* ----------------------------------------------------------------------
   Find the particle with the lowest ID; without IDs, the first such particle on the first rank that has any.
------------------------------------------------------------------------- */

std::string SPHDissipation::first_particle(LAMMPS *lmp, const std::function<bool(int)> &wrong,
                                           const std::function<double(int)> &value, double &found)
{
  const Atom *const atom = lmp->atom;
  const int me = lmp->comm->me;
  tagint mine = MAXTAGINT;
  for (int i = 0; i < atom->nlocal; i++) {
    const tagint tag = atom->tag_enable ? atom->tag[i] : me;
    if (tag >= mine || !wrong(i)) continue;
    mine = tag;
    found = value(i);
  }
  const tagint first = over_all(lmp->world, mine, MPI_MIN);
  if (first == MAXTAGINT) return "";
  MPI_Bcast(&found, 1, MPI_DOUBLE, over_all(lmp->world, mine == first ? me : 0, MPI_MAX),
            lmp->world);
  return atom->tag_enable ? fmt::format("particle {}", first) : "a particle";
}

/* ---------------------------------------------------------------------- */

bigint SPHDissipation::count_particles(LAMMPS *lmp, const std::function<bool(int)> &counts)
{
  bigint mine = 0;
  for (int i = 0; i < lmp->atom->nlocal; i++) mine += counts(i) ? 1 : 0;
  return over_all(lmp->world, mine, MPI_SUM);
}

/* ---------------------------------------------------------------------- */

void SPHDissipation::check_set_up(LAMMPS *lmp, const Fix *fix, bool set_up)
{
  if (!set_up)
    lmp->error->all(FLERR, Error::NOLASTLINE,
                    "Fix {} {} was defined after the last run was set up: the next one cannot be a "
                    "run with pre no",
                    fix->id, fix->style);
}

/* ---------------------------------------------------------------------- */

void SPHDissipation::check_format(LAMMPS *lmp, const Fix *fix, double first, int format)
{
  if (first != -format)
    lmp->error->all(FLERR,
                    "Fix {} {}: the restart file was written by {} version of this fix; give the "
                    "fix another ID to begin anew",
                    fix->style, fix->id, (first < -format) ? "a newer" : "an older");
}

/* ---------------------------------------------------------------------- */

bool SPHDissipation::is_rerun(LAMMPS *lmp)
{
  return lmp->input->command && strcmp(lmp->input->command, "rerun") == 0;
}

/* ---------------------------------------------------------------------- */

void FluidChecks::rerun() const
{
  if (!is_rerun(lmp)) return;
  const bool gas = (model.choice.eos == Eos::IDEAL);
  if (gas || model.choice.own_temperatures)
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style {} {} cannot be used with rerun: snapshots have no internal "
               "energies of the particles",
               style, gas ? "eos ideal" : "temp energy");
  for (int i = 1; i <= atom->ntypes; i++)
    if (const char *keyword = model.keyword_that_needs(HEAT_CAPACITY, i))
      error->all(FLERR, Error::NOLASTLINE,
                 "Pair style {} with {} of type {} cannot be used with rerun: snapshots have no "
                 "internal energies of the particles",
                 style, keyword, i);
  for (int i = 1; i <= atom->ntypes; i++)
    if (const char *keyword = model.keyword_that_needs(NO_RERUN, i))
      error->all(FLERR, Error::NOLASTLINE,
                 "Pair style {} with {} of type {} cannot be used with rerun: snapshots have no "
                 "states of the particles",
                 style, keyword, i);
  if (model.choice.continuity)
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style {} density continuity cannot be used with rerun: snapshots have no "
               "densities of the particles",
               style);
  for (int i = 1; i <= atom->ntypes; i++)
    for (const StateInfo &one : state_table())
      if (one.kind == StateKind::STRAIN && one.count(model.coeffs[i].keywords.data()) &&
          comm->me == 0)
        error->warning(
            FLERR,
            "Pair style {} with rerun: snapshots have no strains of {}, which for type {} are "
            "taken to be zero",
            style, one.name, i);
  if (Fields::with_spins(atom) && comm->me == 0)
    error->warning(FLERR,
                   "Pair style {} with rerun: snapshots have no spins, forces are those of "
                   "the spins that the particles have now",
                   style);
}

/* ---------------------------------------------------------------------- */

void FluidChecks::styles() const
{
  if (!atom->style_match(style.c_str()))
    error->all(FLERR, Error::NOLASTLINE, "Pair style {} requires atom style {}", style, style);
  if (modify->get_fix_by_style("^" + style).empty())
    error->all(FLERR, Error::NOLASTLINE, "Pair style {} requires fix {}", style, style);
  if (force->mvv2e != 1.0)
    error->all(
        FLERR, Error::NOLASTLINE,
        "Pair style {} requires units in which mass * velocity^2 is an energy: use units lj, "
        "si, cgs, micro, or nano, not {}",
        style, update->unit_style);

  // number density, forces, and walls of one fluid do not include another fluid

  Pair *const first = force->pair_match("^" + style, 0, 1),
              *const second = force->pair_match("^" + style, 0, 2);
  if ((second && second != first) ||
      (force->pair_match("^sph/bulk", 0, 1) && force->pair_match("^sph/micropolar", 0, 1)))
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style {} cannot be combined with another sph/bulk or sph/micropolar: "
               "use one with all types",
               style);

  // other atom styles sum drho of ghost atoms, which this pair style has communicated already

  for (const auto &other : utils::split_words(atom->get_style()))
    if (other == "sph" || other == "rheo" || other == "rheo/thermal" || other == "mdpd")
      error->all(
          FLERR, Error::NOLASTLINE,
          "Atom style {} cannot be combined with atom style {}, which has a density of its own",
          style, other);

  // LAMMPS takes pairs with a factor of zero out of the neighbor list, and thus out of the density

  if (atom->molecular != Atom::ATOMIC)
    for (int k = 1; k <= 3; k++)
      if (force->special_lj[k] != 1.0)
        error->all(FLERR, Error::NOLASTLINE,
                   "Pair style {} needs all neighbors of a particle, also bonded ones: use "
                   "special_bonds lj 1 1 1",
                   style);

  // LAMMPS's own particle fluids read the masses of types, which do not exist here

  for (const char *other : {"sph/heatconduction", "sph/idealgas", "sph/lj", "sph/rhosum",
                            "sph/taitwater", "sph/taitwater/morris", "sdpd/taitwater/isothermal"})
    if (force->pair_match(other, 1))
      error->all(FLERR, Error::NOLASTLINE,
                 "Pair style {} cannot be combined with pair style {}, which needs masses by type",
                 style, other);
}

/* ---------------------------------------------------------------------- */

void FluidChecks::noise() const
{
  if (update->whichflag == 2)
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style {} with temp cannot be used in a minimization: random forces have no "
               "energy",
               style);
  if (!atom->tag_enable)
    error->all(
        FLERR, Error::NOLASTLINE,
        "Pair style {} with temp needs particles with IDs, to which its random numbers belong",
        style);
  if (!(update->dt > 0.0))
    error->all(
        FLERR, Error::NOLASTLINE,
        "Pair style {} with temp needs a time step > 0, not {}: its random forces are those of "
        "one step",
        style, update->dt);
  for (const std::string fix_style : {"dt/reset", "sph/dt"})
    if (!modify->get_fix_by_style("^" + fix_style).empty())
      error->all(
          FLERR, Error::NOLASTLINE,
          "Pair style {} with temp cannot be used with fix {}: its random forces are those of "
          "one time step",
          style, fix_style);
}

/* ----------------------------------------------------------------------
   Check, for dim 1, that the particles are on a line along x or y, and that periodic images of the line do not interact.
------------------------------------------------------------------------- */

void FluidChecks::line_of_particles(double support) const
{
  const double *const prd = domain->prd;
  constexpr double ROUNDOFF = 1.0e-10;

  // distances from one of the particles, across a periodic boundary if that is shorter

  double corner[2] = {-1.0e300, -1.0e300}, reference[2], spread[2] = {0.0, 0.0}, widest[2];
  for (int i = 0; i < atom->nlocal; i++)
    if (!model.coeffs[atom->type[i]].other)
      for (int d = 0; d < 2; d++) corner[d] = std::max(corner[d], atom->x[i][d]);
  MPI_Allreduce(corner, reference, 2, MPI_DOUBLE, MPI_MAX, world);
  for (int i = 0; i < atom->nlocal; i++)
    if (!model.coeffs[atom->type[i]].other)
      for (int d = 0; d < 2; d++) {
        double distance = reference[d] - atom->x[i][d];
        if (domain->periodicity[d]) distance = std::min(distance, std::fabs(prd[d] - distance));
        spread[d] = std::max(spread[d], distance);
      }
  MPI_Allreduce(spread, widest, 2, MPI_DOUBLE, MPI_MAX, world);

  const int across = (widest[0] < widest[1]) ? 0 : 1;
  if (widest[across] > ROUNDOFF * std::max(prd[0], prd[1]))
    error->all(
        FLERR, Error::NOLASTLINE,
        "Pair_style {} dim 1: the particles must lie on a line along x or y, but they spread "
        "over {:g} along x and {:g} along y",
        style, widest[0], widest[1]);
  if (domain->periodicity[across] && prd[across] <= support)
    error->all(FLERR, Error::NOLASTLINE,
               "Pair_style {}: box too narrow for dim 1: its {} extent {} must be "
               "larger than the support radius {}",
               style, "xy"[across], prd[across], support);
}

/* ---------------------------------------------------------------------- */

void FluidChecks::support(int dim, double support) const
{
  if (comm->cutghostuser > 0.0 && comm->cutghostuser < support)
    error->all(FLERR, Error::NOLASTLINE,
               "The ghost cutoff {} of comm_modify is smaller than the support radius {} of "
               "pair style {}",
               comm->cutghostuser, support, style);
  if (dim == 1) line_of_particles(support);
}

/* ---------------------------------------------------------------------- */

void FluidChecks::skin(int dim, double support) const
{
  const double skin = neighbor->skin;
  if (skin > support && comm->me == 0)
    error->warning(
        FLERR,
        "Pair style {}: the skin of the neighbor list, {:.3g}, is {:.2g} support radii, "
        "with which the list is {:.2g} times as long as without; use neighbor {:.1g} bin",
        style, skin, skin / support, pow(1.0 + skin / support, dim), 0.1 * support);
}

/* ---------------------------------------------------------------------- */

void FluidChecks::spins() const
{
  if (domain->dimension != 2) return;
  const auto tilted = first_particle(lmp, [&](int i) {
    const double *const omega = atom->omega[i];
    return !model.coeffs[atom->type[i]].other && (omega[0] != 0.0 || omega[1] != 0.0);
  });
  if (!tilted.empty())
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style {}: spin must be along z in 2d, which that of {} is not", style, tilted);
}

/* ---------------------------------------------------------------------- */

std::set<Kind> SPHDissipation::all_kinds(LAMMPS *lmp)
{
  const Atom *const atom = lmp->atom;
  std::set<Kind> own;
  Kind last{0, 0};    // successive particles are often alike
  for (int i = 0; i < atom->nlocal; i++) {
    const Kind kind{atom->type[i], atom->mask[i]};
    if (kind != last) own.insert(last = kind);
  }

  std::vector<int> mine;
  for (const Kind &kind : own) mine.insert(mine.end(), {kind.first, kind.second});
  const std::vector<int> every = gather_all(lmp->world, mine, MPI_INT);
  std::set<Kind> all;
  for (std::size_t k = 0; k < every.size(); k += 2) all.insert({every[k], every[k + 1]});
  return all;
}

/* ----------------------------------------------------------------------
   Return whether there can be pairs of two kinds, by the rules of NPair.
------------------------------------------------------------------------- */

bool SPHDissipation::in_neighbor_lists(LAMMPS *lmp, const Kind &a, const Kind &b)
{
  const Neighbor *const neighbor = lmp->neighbor;
  const int *const bitmask = lmp->group->bitmask;
  const int included = neighbor->includegroup ? bitmask[neighbor->includegroup] : ~0;
  if (!(a.second & b.second & included)) return false;
  for (int n = 0; n < neighbor->nex_type; n++) {
    const int first = neighbor->ex1_type[n], second = neighbor->ex2_type[n];
    if ((a.first == first && b.first == second) || (b.first == first && a.first == second))
      return false;
  }
  for (int n = 0; n < neighbor->nex_group; n++) {
    const int first = bitmask[neighbor->ex1_group[n]], second = bitmask[neighbor->ex2_group[n]];
    if (((a.second & first) && (b.second & second)) || ((b.second & first) && (a.second & second)))
      return false;
  }
  return true;
}

/* ----------------------------------------------------------------------
   Check also particles that another fix moves, such as rigid bodies: their densities need all neighbors.
------------------------------------------------------------------------- */

void FluidChecks::fluid_lists() const
{
  if (!neighbor->nex_type && !neighbor->nex_group && !neighbor->includegroup) return;
  int others = 0;    // groups that other checks cover
  for (const auto &name : {"^sph/wall", "^sph/open"})
    for (const auto &ifix : modify->get_fix_by_style(name)) others |= ifix->groupbit;

  const std::set<Kind> kinds = all_kinds(lmp);
  const auto is_fluid = [&](const Kind &kind) {
    return !model.coeffs[kind.first].other && !(kind.second & others);
  };
  for (const Kind &a : kinds)
    for (const Kind &b : kinds)
      if (a.first == b.first && is_fluid(a) && is_fluid(b) && !in_neighbor_lists(lmp, a, b))
        error->all(FLERR, Error::NOLASTLINE,
                   "Pair style {}: neigh_modify exclude or include leaves out pairs of the "
                   "fluid of type {}",
                   style, a.first);
}

/* ---------------------------------------------------------------------- */

void FluidChecks::room() const
{
  const Fields &fields = *Fields::of(atom);
  for (int i = 1; i <= atom->ntypes; i++)
    for (const StateInfo &one : state_table()) {
      int count = 0;
      for (const StateInfo &guest : state_table())
        if (guest.owner == one.first) count += guest.count(model.coeffs[i].keywords.data());
      if (model.coeffs[i].other || count <= fields.room(one)) continue;
      error->all(FLERR, Error::NOLASTLINE,
                 "Pair style {}: the states of {} of type {} are {}, but particles have room "
                 "for {}; use atom_style {} {}{}",
                 style, one.keyword, i, count, fields.room(one), style, one.keyword,
                 (one.most > 1) ? fmt::format(" {}", count) : "");
    }
}

/* ---------------------------------------------------------------------- */

void FluidChecks::state_times() const
{
  constexpr double SHORT = 1.0e-3;    // time over the time step
  if (comm->me != 0) return;
  for (int i = 1; i <= atom->ntypes; i++) {
    if (model.coeffs[i].other) continue;
    const double *const coeffs = model.coeffs[i].keywords.data();
    for (const StateInfo &one : state_table())
      for (int k = 0; one.instead && k < one.count(coeffs); k++)
        if (one.time(coeffs, k) < SHORT * update->dt)
          error->warning(FLERR,
                         "Pair style {}: the time {:g} of {} of type {} is far below the "
                         "time step {:g}; {} does the same",
                         style, one.time(coeffs, k), one.name, i, update->dt, one.instead);
  }
}

/* ---------------------------------------------------------------------- */

void FluidChecks::surface() const
{
  if (!model.choice.continuity || comm->me != 0) return;
  for (int i = 1; i <= atom->ntypes; i++) {
    const TypeCoeff &type = model.coeffs[i];
    if (!type.other && type.eos.pb > 0.0)
      error->warning(FLERR,
                     "Pair style {} density continuity: pb {:g} of type {} presses free "
                     "surfaces outward; use pb 0",
                     style, type.eos.pb, i);
  }
  const Shear shear = model.choice.shear;
  constexpr double LEAST_KAPPA = 0.4;    // of mu: theory page, admissible range
  for (int i = 1; i <= atom->ntypes; i++) {
    const TypeCoeff &type = model.coeffs[i];
    const double mu = type.viscosity[MU];
    if ((shear == Shear::MG_FR2 || shear == Shear::MICROPOLAR_FR2) && !type.other &&
        model.choice.limit != Limit::YES && type.kappa < LEAST_KAPPA * mu)
      error->warning(FLERR,
                     "Pair style {} density continuity: with shear mg/fr2, motions of a free "
                     "surface may gain energy where kappa {:g} of type {} is below {:g} mu; use a "
                     "larger kappa, limit yes, or shear mg",
                     style, type.kappa, i, LEAST_KAPPA);
  }
  if ((shear == Shear::MORRIS || shear == Shear::ESPANOL) && !model.constants().inviscid)
    error->warning(FLERR,
                   "Pair style {} density continuity: shear {} exerts a torque on a fluid "
                   "with a free surface that rotates; use shear mg",
                   style, shear_name(shear));
}

/* ---------------------------------------------------------------------- */

void FluidChecks::masses() const
{
  int integrated = 0;
  for (const auto &ifix : modify->get_fix_by_style("^" + style)) integrated |= ifix->groupbit;

  const auto weightless = first_particle(lmp, [&](int i) {
    const bool matters = !model.coeffs[atom->type[i]].other || (atom->mask[i] & integrated);
    return matters && !(atom->rmass[i] > 0.0);
  });
  if (!weightless.empty())
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style {}: mass must be > 0, which that of {} is not; use the set command",
               style, weightless);
}

/* ----------------------------------------------------------------------
   Leave out states that a command has set for any particle.  Between two times, diffusion changes the offsets of densities.
------------------------------------------------------------------------- */

void FluidChecks::kept_states(const Changes &changes, bool densities_follow) const
{
  if (!changes.known || comm->me != 0) return;
  const bool *const of = changes.of;
  const bool other_time = changes.other_time();
  std::vector<std::string> kept, changed;
  if (model.choice.continuity && of[PLACE] && !of[DENSITY] &&
      (!densities_follow || (other_time && model.choice.delta > 0.0)))
    kept.push_back("sph/rho");
  bool heat_acts = model.choice.own_temperatures;
  for (int i = 1; i <= atom->ntypes; i++)
    if (!model.coeffs[i].other && model.heat_acts(i)) heat_acts = true;
  if (heat_acts && (of[PLACE] || of[MASS] || of[TYPE]) && !of[ENERGY]) kept.push_back("sph/e");
  for (const StateInfo &one : state_table()) {
    if (of[STATES] || !(other_time || (of[MASS] && one.kind != StateKind::PER_MASS))) continue;
    int most = 0;
    for (int i = 1; i <= atom->ntypes; i++)
      if (!model.coeffs[i].other) most = std::max(most, one.count(model.coeffs[i].keywords.data()));
    for (int k = 0; k < most; k++) kept.push_back("d_" + Fields::state_name(one.first + k));
  }
  if (Fields::with_spins(atom) && other_time && !of[SPIN]) kept.push_back("omega");
  if (kept.empty()) return;
  if (of[PLACE]) changed.push_back("positions");
  if (of[VELOCITY]) changed.push_back("velocities");
  if (of[MASS]) changed.push_back("masses");
  if (of[TYPE]) changed.push_back("types");
  error->warning(FLERR,
                 "Pair style {}: commands have changed {} after the last run, but {} stay as they "
                 "are; use the set command for these, or ignore this warning if they shall stay",
                 style, utils::join_words(changed, ", "), utils::join_words(kept, ", "));
}

/* ---------------------------------------------------------------------- */

void FluidChecks::followed_densities(const std::vector<double> &before) const
{
  constexpr double MUCH = 0.1;    // of rho0
  const bigint all = count_particles(lmp, [&](int i) {
    const TypeCoeff &type = model.coeffs[atom->type[i]];
    return !type.other && std::fabs(atom->rho[i] - before[i]) > MUCH * type.eos.rho0;
  });
  if (all && comm->me == 0)
    error->warning(FLERR,
                   "Pair style {}: commands have moved particles after the last run, which changes "
                   "the densities of {} of "
                   "them by more than {:g} rho0; use set ... sph/rho 0 to begin with rho0",
                   style, all, MUCH);
}

/* ---------------------------------------------------------------------- */

void FluidChecks::numbers() const
{
  const auto demand = [&](const std::string &name, const std::string &what, const std::string &help,
                          const std::function<bool(int)> &good) {
    const auto odd = first_particle(lmp, [&](int i) {
      return !model.coeffs[atom->type[i]].other && !good(i);
    });
    if (!odd.empty())
      error->all(FLERR, Error::NOLASTLINE,
                 "Pair style {}: {} must be {}, which that of {} is not; {}", style, name, what,
                 odd, help);
  };
  const auto check = [&](const std::string &name, const std::string &help,
                         const std::function<bool(int)> &finite) {
    demand(name, "a finite number", help, finite);
  };
  const auto finite = [](const double *a) {
    return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
  };
  const Fields &fields = *Fields::of(atom);
  check("mass", "use the set command", [&](int i) {
    return std::isfinite(atom->rmass[i]);
  });
  check("velocity", "use velocity create after set mass, and see the variables that have set it",
        [&](int i) {
          return finite(atom->v[i]);
        });
  if (fields.has_spins) {
    check("spin", "see the variables that have set it", [&](int i) {
      return finite(atom->omega[i]);
    });
    check("inertia", "use the set command", [&](int i) {
      return std::isfinite(fields.inertia[i]);
    });
    demand("inertia", ">= 0", "use the set command", [&](int i) {
      return fields.inertia[i] >= 0.0;
    });
  }
  for (const int slot : fields.slots)
    check("d_" + Fields::state_name(slot), "use the set command", [&](int i) {
      return std::isfinite(fields.state[slot][i]);
    });
  if (model.choice.continuity) {
    check("density", "use set sph/rho", [&](int i) {
      return std::isfinite(atom->rho[i]);
    });
    demand("density", ">= 0", "use set sph/rho, where 0 stands for rho0", [&](int i) {
      return atom->rho[i] >= 0.0;
    });
  }
  check("internal energy", "use the set command", [&](int i) {
    return std::isfinite(atom->esph[i]);
  });
}

/* ---------------------------------------------------------------------- */

void FluidChecks::states() const
{
  constexpr double IN_ANOTHER_COLUMN = -1.0;
  const Fields &fields = *Fields::of(atom);
  for (const int slot : fields.slots) {
    const StateInfo info = state_info(slot);
    if (info.kind != StateKind::PER_MASS) continue;
    const double *const state = fields.state[slot], most = info.largest * (1.0 + 1.0e-9);
    const auto odd = first_particle(lmp, [&](int i) {
      return (state[i] < 0.0 || state[i] > most) &&
          (state[i] != IN_ANOTHER_COLUMN || info.has_column());
    });
    if (!odd.empty())
      error->all(FLERR, Error::NOLASTLINE,
                 "Pair style {}: d_{} must be >= 0{}, which that of {} is not; use the set command",
                 style, Fields::state_name(slot),
                 std::isfinite(info.largest) ? fmt::format(" and <= {:g}", info.largest) : "", odd);
  }
}

/* ---------------------------------------------------------------------- */

void FluidChecks::sizes(int boundary_bits) const
{
  if (model.choice.volume != Volume::NUMBER) return;
  constexpr double FAR = 1.0e300, TOLERATED = 1.1;
  const int n = atom->ntypes;
  std::vector<double> extent(2 * (n + 1), -FAR), all(2 * (n + 1));    // largest m, -m by type
  for (int i = 0; i < atom->nlocal; i++) {
    const int type = atom->type[i];
    if (model.coeffs[type].other || (atom->mask[i] & boundary_bits)) continue;
    extent[2 * type] = std::max(extent[2 * type], atom->rmass[i]);
    extent[2 * type + 1] = std::max(extent[2 * type + 1], -atom->rmass[i]);
  }
  MPI_Allreduce(extent.data(), all.data(), 2 * (n + 1), MPI_DOUBLE, MPI_MAX, world);
  for (int type = 1; type <= n; type++)
    if (all[2 * type] > -TOLERATED * all[2 * type + 1] && comm->me == 0)
      error->warning(FLERR,
                     "Pair style {}: masses of type {} differ by a factor of {:.3g}, and with "
                     "volume number neighbors of different size get wrong volumes; use volume mass "
                     "if their sizes differ and not their densities",
                     style, type, -all[2 * type] / all[2 * type + 1]);
}

/* ---------------------------------------------------------------------- */

void FluidChecks::energies(const std::function<double(int)> &heat, int boundary_bits) const
{
  const bool gas = (model.choice.eos == Eos::IDEAL);
  bigint number[2] = {0, 0}, all[2];    // of particles whose heat counts; of these, without heat
  for (int i = 0; i < atom->nlocal; i++) {
    const TypeCoeff &type = model.coeffs[atom->type[i]];
    if (type.other || (atom->mask[i] & boundary_bits)) continue;
    if (!model.heat_acts(atom->type[i])) continue;
    number[0]++;
    if (atom->esph[i] == 0.0 || !(heat(i) > 0.0)) number[1]++;
  }
  MPI_Allreduce(number, all, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all[1] && !gas && comm->me == 0)
    error->warning(FLERR,
                   "Pair style {}: {} of {} particles have no heat, though they conduct heat, or "
                   "their pressure or viscosity depends on heat; use keyword temperature of fix {}",
                   style, all[1], all[0], style);
  if (all[1] && gas && comm->me == 0)
    error->warning(FLERR,
                   "Pair style {} eos ideal: {} of {} particles have no internal energy and thus "
                   "no pressure; use set ... sph/e",
                   style, all[1], all[0]);
}

/* ----------------------------------------------------------------------
   Count pairs in the same place, to the digits of data files; with newton off, the owners of both particles have a pair.
------------------------------------------------------------------------- */

bigint FluidChecks::places(const Engine &engine, double support, bigint before) const
{
  constexpr double SAME = 1.0e-6;    // of the support radius
  const double same_sq = SAME * SAME * support * support;
  const Particle *const particle = engine.particle;
  bigint twice = 0;
  tagint first = MAXTAGINT;
  engine.visit_pairs([&](int i, int j, bigint) {
    if (MathExtra::distsq3(particle[i].x, particle[j].x) > same_sq) return;
    twice += (force->newton_pair || j < atom->nlocal) ? 2 : 1;
    if (atom->tag_enable) first = std::min({first, atom->tag[i], atom->tag[j]});
  });
  const bigint all = over_all(world, twice, MPI_SUM) / 2;
  if (all <= before) return all;
  first = over_all(world, first, MPI_MIN);
  const std::string one = atom->tag_enable ? fmt::format(", one of them particle {}", first) : "";
  if (comm->me == 0)
    error->warning(
        FLERR,
        "Pair style {}: {} pairs of particles are in the same place{}: they exert no "
        "force on each other and stay together; use delete_atoms overlap where regions overlap",
        style, all, one);
  return all;
}
