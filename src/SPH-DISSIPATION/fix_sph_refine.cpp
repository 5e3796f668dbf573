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

/* ----------------------------------------------------------------------
   Contributing authors: the SPH-DISSIPATION authors
------------------------------------------------------------------------- */

#include "fix_sph_refine.h"

#include "atom.h"
#include "atom_masks.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "math_const.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neigh_request.h"
#include "neighbor.h"
#include "npair.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_balance.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_keywords.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_refine.h"
#include "sph_dissipation_table.h"
#include "sph_dissipation_value.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace SPHDissipation;

static constexpr double SPLIT = 1.6, MERGE = 0.6;    // defaults: volume over target
static constexpr double WIDEST = 1.0 / 1.5;          // target spacing over the support radius
static constexpr double NEVER = -INFINITY;           // step of the last event

// Numbers of each particle: step of the last event; family = lowest new ID of the daughters of a split that they can undo as
// a whole, else 0

enum { STEP, FAMILY, NPAST };

// Numbers in restart files: -format, balance, highest ID that was ever given.  The numbers of each particle have the same
// format.  Files without a format begin with the number of splits.

static constexpr int FORMAT = 1003;
enum { BALANCE = 1, HIGHEST = BALANCE + RefineBalance::NVALUE, NSTATE };

/* ---------------------------------------------------------------------- */

FixSPHRefine::FixSPHRefine(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), target(new Value), split_above(SPLIT), merge_below(MERGE),
    totals(RefineBalance::NVALUE)
{
  demand_words(lmp, fmt::format("fix {}", style), narg,
               fmt::format("ID group-ID {} N volume|spacing target", style));
  nevery = utils::inumeric(FLERR, arg[3], false, lmp);
  if (nevery <= 0) error->all(FLERR, "Fix {} N must be > 0, not {}", style, arg[3]);
  if (strcmp(arg[4], "volume") != 0 && strcmp(arg[4], "spacing") != 0)
    error->all(FLERR, "Fix {}: the target must be volume or spacing, not {}", style, arg[4]);
  balance.reset(new RefineBalance(lmp));
  event.reset(new RefineEvent(lmp, this, *balance));
  by_spacing = (strcmp(arg[4], "spacing") == 0);
  target_word = arg[5];
  target->set(lmp, target_word);
  for (Keywords key(lmp, fmt::format("Fix {}", style), 6, narg, arg); key.next();) {
    if (key.is("split")) {
      split_above = (strcmp(key.word(), "no") == 0) ? INFINITY : key.number();
      key.demand(split_above > 1.0, "> 1");
    } else if (key.is("merge")) {
      const bool no = (strcmp(key.word(), "no") == 0);
      merge_below = no ? 0.0 : key.number();
      key.demand(no || (merge_below > 0.0 && merge_below < 1.0), "between 0 and 1");
    } else if (key.is("wait")) {
      wait = key.number();
      key.demand(wait >= 0.0, ">= 0");
    } else if (key.is("fraction")) {
      fraction = key.number();
      key.demand(fraction > 0.0 && fraction <= 1.0, "> 0 and at most 1");
    }
  }
  if (split_above < 2.0 * merge_below)
    error->all(FLERR,
               "Fix {}: split must be at least twice merge, not {} and {}: particles that have "
               "split would merge again",
               style, split_above, merge_below);
  check_setup();

  force_reneighbor = 1;
  next_reneighbor = -1;
  restart_global = 1;
  restart_peratom = 1;
  create_attribute = 1;
  vector_flag = 1;
  size_vector = RefineBalance::NVALUE;
  global_freq = 1;
  extvector = 0;
  comm_forward = RefineItems::SIZE;
  datamask_read = datamask_modify = EMPTY_MASK;    // particles are copied in the steps of a check
  grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  for (int i = 0; i < atom->nlocal; i++) set_arrays(i);
}

/* ---------------------------------------------------------------------- */

void FixSPHRefine::check_setup()
{
  if (!Fields::of(atom))
    error->all(FLERR, "Fix {} requires atom style sph/bulk or sph/micropolar", style);
  if (atom->tag_enable == 0) error->all(FLERR, "Fix {} requires atom IDs", style);
  if (atom->molecular != Atom::ATOMIC)
    error->all(FLERR,
               "Fix {} cannot be used with molecules or bonds: a particle that merges would "
               "leave bonds without an end",
               style);
}

/* ---------------------------------------------------------------------- */

FixSPHRefine::~FixSPHRefine()
{
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
  memory->destroy(past);
}

/* ---------------------------------------------------------------------- */

int FixSPHRefine::setmask()
{
  return POST_INTEGRATE | POST_FORCE;
}

/* ---------------------------------------------------------------------- */

void FixSPHRefine::init()
{
  fluid = find_fluid(lmp, fmt::format("Fix {}", style));
  check_setup();
  if (fluid->model->choice.volume != Volume::MASS)
    error->all(FLERR,
               "Fix {} requires pair_style {} volume mass: with volume number, particles of "
               "unequal size next to each other have volumes that are wrong by half, whatever "
               "their distance",
               style, fluid->style);
  if (fluid->dimension() != domain->dimension)
    error->all(FLERR, "Fix {} requires a kernel of the dimension of the simulation", style);
  if (domain->deform_vremap)
    error->all(FLERR, "Fix {} does not support fix deform with remap v", style);
  if (neighbor->build_once)
    error->all(FLERR, "Fix {} needs new neighbor lists: neigh_modify once must be no", style);
  if (is_rerun(lmp))
    error->all(
        FLERR,
        "Fix {} cannot be used with rerun: snapshots have no masses, and the fix changes masses",
        style);
  check_overlap();

  const double support = fluid->support_radius();
  largest_volume = whole_power(WIDEST * support, domain->dimension);
  if (!target->init(lmp, fmt::format("Fix {}", style), true))
    error->all(FLERR, "Variable {} for Fix {} is neither of equal style nor of atom style",
               target->name(), style);
  if (!target->varies()) check_target(target->now(), "");
  event->init(*fluid, merge_below);
  neighbor->add_request(this, NeighConst::REQ_FULL | NeighConst::REQ_OCCASIONAL);
  set_up = true;
}

/* ----------------------------------------------------------------------
   Return the volume that belongs to a value of the target.
------------------------------------------------------------------------- */

double FixSPHRefine::target_volume(double value) const
{
  return by_spacing ? whole_power(value, domain->dimension) : value;
}

bool FixSPHRefine::is_target(double value) const
{
  return value > 0.0 && target_volume(value) <= largest_volume;
}

/* ----------------------------------------------------------------------
   Refuse a value that cannot be a target, on all processors; where = " for " and the particle, or empty.
------------------------------------------------------------------------- */

void FixSPHRefine::check_target(double value, const std::string &where) const
{
  if (is_target(value)) return;
  if (!std::isfinite(value) || !(value > 0.0))
    error->all(FLERR, "Fix {}: the target {} is {}{}, must be > 0", style, target_word, value,
               where);
  error->all(FLERR,
             "Fix {}: the target {}{} is a volume of {:g}, larger than {:g}: particles would have "
             "hardly any neighbors within the support radius",
             style, target_word, where, target_volume(value), largest_volume);
}

/* ---------------------------------------------------------------------- */

void FixSPHRefine::evaluate_target()
{
  if (!target->varies()) return;
  modify->clearstep_compute();
  target->evaluate(lmp, igroup);
  if (target->is_by_atom()) {
    double wrong;
    const std::string where = first_particle(
        lmp,
        [&](int i) {
          return (atom->mask[i] & groupbit) && !is_target((*target)(i));
        },
        [&](int i) {
          return (*target)(i);
        },
        wrong);
    if (!where.empty()) check_target(wrong, " for " + where);
  } else
    check_target(target->now(), "");
  modify->addstep_compute(update->ntimestep + 1);
}

/* ----------------------------------------------------------------------
   Return the number of steps from one event of a particle to the next, with the present time step and speed of sound.
------------------------------------------------------------------------- */

double FixSPHRefine::waiting(const Sound &sound, int i) const
{
  constexpr double ROUNDOFF = 1.0e-6;
  const double rho0 = fluid->model->coeffs[atom->type[i]].eos.rho0;
  const double time = (wait < 0.0) ? fluid->support_radius() / sound(i, rho0) : wait;
  return ceil(time / update->dt - ROUNDOFF);
}

/* ----------------------------------------------------------------------
   Refuse two fixes for one particle: what one splits, the other would merge.
------------------------------------------------------------------------- */

void FixSPHRefine::check_overlap()
{
  for (const auto &other : modify->get_fix_by_style("^sph/refine$")) {
    if (other == this) continue;
    const bigint all = count_particles(lmp, [&](int i) {
      return (atom->mask[i] & groupbit) && (atom->mask[i] & other->groupbit);
    });
    if (all)
      error->all(FLERR, "Fixes {} and {} of style {} both have {} particles in their groups", id,
                 other->id, style, all);
  }
}

/* ---------------------------------------------------------------------- */

bool FixSPHRefine::is_fluid(int i) const
{
  return !(atom->mask[i] & not_fluid) && fluid->has_type(atom->type[i]);
}

/* ----------------------------------------------------------------------
   Return whether the last event of a particle is long enough ago.  An event in the future, by a reset_timestep before this
   fix existed, does not count.
------------------------------------------------------------------------- */

bool FixSPHRefine::may_change(const Sound &sound, int i) const
{
  const double since = static_cast<double>(update->ntimestep) - past[i][STEP];
  return since < 0.0 || since >= waiting(sound, i);
}

/* ----------------------------------------------------------------------
   Shift the steps of the last events after reset_timestep, so that they are as long ago as before.
------------------------------------------------------------------------- */

void FixSPHRefine::count_anew(bigint step)
{
  const bigint change = step - last_step;
  if (last_step >= 0 && change != 0) {
    for (int i = 0; i < atom->nlocal; i++) past[i][STEP] += static_cast<double>(change);
    event_step += change;
  }
  last_step = step;
}

/* ----------------------------------------------------------------------
   Split and merge, after the particles have moved and before LAMMPS decides on new neighbor lists:
   lists and ghosts of the last step still fit the particles.
------------------------------------------------------------------------- */

void FixSPHRefine::post_integrate()
{
  check_set_up(lmp, this, set_up);
  count_anew(update->ntimestep - 1);
  last_step = update->ntimestep;
  if (update->ntimestep % nevery != 0 && !postponed) return;

  // ghosts are gone if another fix of this style has just changed particles

  postponed = false;
  for (const auto &other : modify->get_fix_by_style("^sph/refine$"))
    if (dynamic_cast<FixSPHRefine *>(other)->event_step == update->ntimestep) postponed = true;
  if (postponed) return;

  fluid->get_from_device(ALL_MASK);
  evaluate_target();
  not_fluid = fluid->not_fluid();
  bigint nfluid;
  if (!wanted(nfluid)) return;

  comm->forward_comm();
  list->np->last_build = -1;    // KOKKOS does not notice that its particles are gone
  neighbor->build_one(list);
  set_items();
  const auto most = static_cast<bigint>(fraction * static_cast<double>(nfluid));
  if (!event->plan(list, std::max(most, static_cast<bigint>(1)))) return;

  totals_known = false;
  balance->add(RefineBalance::ELASTIC, -fluid->elastic_energy(Fluid::NOW));
  event->carry_out(list, [this](int i, double family) {
    past[i][STEP] = static_cast<double>(update->ntimestep);
    past[i][FAMILY] = family;
  });
  fluid->keep_densities();
  fluid->give_to_device();
  event_step = next_reneighbor = update->ntimestep;
}

/* ----------------------------------------------------------------------
   Return the volume within which neighbors are in the lists.
------------------------------------------------------------------------- */

double FixSPHRefine::list_volume() const
{
  const double r = neighbor->cutneighmax;
  return domain->dimension == 3 ? 4.0 / 3.0 * MathConst::MY_PI * r * r * r
                                : MathConst::MY_PI * r * r;
}

/* ----------------------------------------------------------------------
   Return whether any particle should split or merge; count the particles of the fluid.
------------------------------------------------------------------------- */

bool FixSPHRefine::wanted(bigint &nfluid)
{
  enum { FLUID, EVENTS, DAUGHTERS, CROWDED, NSUM };
  double sum[NSUM] = {0.0, 0.0, 0.0, 0.0}, all[NSUM];
  const double smallest = list_volume() / neighbor->oneatom;
  const Sound sound = fluid->stability->sound();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit) || !is_fluid(i)) continue;
    sum[FLUID] += 1.0;
    const double ratio = atom->vfrac[i] / target_volume((*target)(i));
    if (ratio > split_above) {
      sum[DAUGHTERS] += ratio;
      if (target_volume((*target)(i)) < smallest) sum[CROWDED] += 1.0;
    }
    if ((ratio > split_above || ratio < merge_below) && may_change(sound, i)) sum[EVENTS] += 1.0;
  }
  MPI_Allreduce(sum, all, NSUM, MPI_DOUBLE, MPI_SUM, world);
  const double room =
      std::min(static_cast<double>(MAXTAGINT), static_cast<double>(MAXSMALLINT) * comm->nprocs);
  if (all[DAUGHTERS] > room)
    error->all(FLERR,
               "Fix {}: the target asks for {:g} particles, which is more than the {:g} for which "
               "there are IDs and room",
               style, all[DAUGHTERS], room);
  if (all[CROWDED] > 0.0 && all[DAUGHTERS] > neighbor->oneatom)
    error->all(FLERR,
               "Fix {}: {:.0f} particles are to become smaller than a volume of {:g}, with which "
               "their neighbors would be more than the {} of neigh_modify one; choose a larger "
               "target, a smaller support radius, or raise that limit",
               style, all[CROWDED], smallest, neighbor->oneatom);
  nfluid = static_cast<bigint>(all[FLUID]);
  return all[EVENTS] > 0.0;
}

/* ---------------------------------------------------------------------- */

void FixSPHRefine::set_items()
{
  event->begin();
  const Sound sound = fluid->stability->sound();
  for (int i = 0; i < atom->nlocal; i++) {
    RefineState state = is_fluid(i) ? KEEPS : NOT_FLUID;
    double goal = 0.0;
    if (state == KEEPS && (atom->mask[i] & groupbit)) {
      goal = target_volume((*target)(i));
      const double ratio = atom->vfrac[i] / goal;
      const bool splits = ratio > split_above;
      if ((splits || ratio < merge_below) && may_change(sound, i)) state = splits ? SPLITS : MERGES;
    }
    event->set(i, state, atom->vfrac[i], split_above * goal, goal, past[i][FAMILY]);
  }
}

/* ---------------------------------------------------------------------- */

void FixSPHRefine::post_force(int /*vflag*/)
{
  if (event_step != update->ntimestep) return;
  balance->add(RefineBalance::ELASTIC, fluid->elastic_energy(Fluid::LAST_FORCES));
  totals_known = false;
}

/* ---------------------------------------------------------------------- */

double FixSPHRefine::compute_vector(int n)
{
  if (!totals_known) {
    balance->total(totals.data());
    totals_known = true;
  }
  return totals[n];
}

/* ---------------------------------------------------------------------- */

int FixSPHRefine::pack_forward_comm(int n, int *sendlist, double *buf, int /*pbc_flag*/,
                                    int * /*pbc*/)
{
  return event->items.pack(n, sendlist, buf);
}

void FixSPHRefine::unpack_forward_comm(int n, int first, double *buf)
{
  event->items.unpack(n, first, buf);
}

/* ---------------------------------------------------------------------- */

void FixSPHRefine::grow_arrays(int nmax)
{
  memory->grow(past, nmax, NPAST, "sph/refine:past");
}

void FixSPHRefine::copy_arrays(int i, int j, int /*delflag*/)
{
  std::copy_n(past[i], static_cast<int>(NPAST), past[j]);
}

void FixSPHRefine::set_arrays(int i)
{
  past[i][STEP] = NEVER;
  past[i][FAMILY] = 0.0;
}

int FixSPHRefine::pack_exchange(int i, double *buf)
{
  std::copy_n(past[i], static_cast<int>(NPAST), buf);
  return NPAST;
}

int FixSPHRefine::unpack_exchange(int nlocal, double *buf)
{
  std::copy_n(buf, static_cast<int>(NPAST), past[nlocal]);
  return NPAST;
}

int FixSPHRefine::pack_restart(int i, double *buf)
{
  buf[0] = 1 + NPAST;
  std::copy_n(past[i], static_cast<int>(NPAST), buf + 1);
  return 1 + NPAST;
}

void FixSPHRefine::unpack_restart(int nlocal, int nth)
{
  int m = 0;
  for (int k = 0; k < nth; k++) m += static_cast<int>(atom->extra[nlocal][m]);
  std::copy_n(&atom->extra[nlocal][m + 1], static_cast<int>(NPAST), past[nlocal]);
}

int FixSPHRefine::size_restart(int /*nlocal*/)
{
  return 1 + NPAST;
}

int FixSPHRefine::maxsize_restart()
{
  return 1 + NPAST;
}

/* ---------------------------------------------------------------------- */

void FixSPHRefine::write_restart(FILE *fp)
{
  count_anew(update->ntimestep);    // before the particles are written
  double state[NSTATE];
  state[0] = -FORMAT;
  balance->total(state + BALANCE);
  state[HIGHEST] = static_cast<double>(event->highest);
  if (comm->me != 0) return;
  const int size = sizeof(state);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(state, sizeof(state), 1, fp);
}

void FixSPHRefine::restart(char *buf)
{
  const auto *state = reinterpret_cast<double *>(buf);
  check_format(lmp, this, state[0], FORMAT);
  balance->restart(state + BALANCE);
  event->highest = static_cast<tagint>(state[HIGHEST]);
}

/* ---------------------------------------------------------------------- */

double FixSPHRefine::memory_usage()
{
  return static_cast<double>(atom->nmax * NPAST * sizeof(double)) + event->items.memory_usage();
}
