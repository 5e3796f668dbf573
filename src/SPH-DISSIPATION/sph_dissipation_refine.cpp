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

#include "sph_dissipation_refine.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "math_extra.h"
#include "neigh_list.h"
#include "sph_dissipation_balance.h"
#include "sph_dissipation_create.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_model.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

static constexpr int ROUNDS = 30;
static constexpr double EQUAL = 1.0e-9;     // tolerance of squares of distances
static constexpr double ONE_CLASS = 2.5;    // largest ratio of volumes in a merge
static constexpr double FARTHEST = 0.35;    // largest distance in a merge, over the support
static constexpr double RESIDUAL_RADIUS =
    0.5;    // largest distance in RefineResidual, over the support
static constexpr double STRETCHED =
    1.4;                               // largest over mean spacing, above which splits are in two
static constexpr double NEXT = 1.6;    // distance of neighbors that split together, in spacings

/* ---------------------------------------------------------------------- */

void RefineItems::resize()
{
  items.assign(atom->nlocal + atom->nghost, RefineItem());
}

/* ---------------------------------------------------------------------- */

void RefineItems::forward(double RefineItem::*member, int number)
{
  const RefineItem one = RefineItem();
  first = static_cast<int>(&(one.*member) - reinterpret_cast<const double *>(&one));
  count = number ? number : SIZE - first;
  comm->forward_comm(fix, count);
}

/* ---------------------------------------------------------------------- */

void RefineItems::forward_all()
{
  forward(&RefineItem::state, SIZE);
  const int nall = atom->nlocal + atom->nghost;
  for (int i = atom->nlocal; i < nall; i++) std::copy_n(atom->x[i], 3, items[i].lump.x);
}

/* ---------------------------------------------------------------------- */

int RefineItems::pack(int n, const int *list, double *buf) const
{
  for (int k = 0; k < n; k++) {
    const double *const row = reinterpret_cast<const double *>(&items[list[k]]) + first;
    buf = std::copy_n(row, count, buf);
  }
  return n * count;
}

/* ---------------------------------------------------------------------- */

void RefineItems::unpack(int n, int from, const double *buf)
{
  for (int i = from; i < from + n; i++, buf += count)
    std::copy_n(buf, count, reinterpret_cast<double *>(&items[i]) + first);
}

/* ---------------------------------------------------------------------- */

bool RefinePairs::leads(int i) const
{
  return mates[i] >= 0 && atom->tag[i] < atom->tag[mates[i]];
}

/* ---------------------------------------------------------------------- */

std::vector<int> RefinePairs::members(int i) const
{
  const auto found = families.find(i);
  if (found != families.end()) return found->second;
  return {i, mates[i]};
}

/* ---------------------------------------------------------------------- */

double RefinePairs::distance_sq(int i, int j) const
{
  return MathExtra::distsq3(atom->x[i], atom->x[j]);
}

/* ---------------------------------------------------------------------- */

bool RefinePairs::fits(int i, int j) const
{
  const RefineItem &a = items[i], &b = items[j];
  return b.is(MERGES) && b.settled == 0.0 && atom->type[i] == atom->type[j] && a.mask == b.mask &&
      a.volume <= ONE_CLASS * b.volume && b.volume <= ONE_CLASS * a.volume &&
      a.volume + b.volume <= std::min(a.most, b.most) && atom->tag[i] != atom->tag[j];
}

/* ----------------------------------------------------------------------
   Return whether j is nearer to i than the other particle.  At equal distances, IDs decide; in a narrow box, positions decide
   between two images of one particle.
------------------------------------------------------------------------- */

bool RefinePairs::nearer(int i, int j, int other) const
{
  const double rsq = distance_sq(i, j), other_sq = distance_sq(i, other);
  if (rsq < (1.0 - EQUAL) * other_sq) return true;
  if (rsq > (1.0 + EQUAL) * other_sq) return false;
  const tagint *const tag = atom->tag;
  if (tag[j] != tag[other]) return std::minmax(tag[i], tag[j]) < std::minmax(tag[i], tag[other]);
  for (int d = 0; d < 3; d++) {
    const double ahead = atom->x[j][d] - atom->x[other][d];
    if (ahead * ahead > EQUAL * rsq) return ahead > 0.0;
  }
  return false;
}

/* ---------------------------------------------------------------------- */

int RefinePairs::nearest(int i, const int *neighbors, int n, double farthest_sq) const
{
  int best = -1;
  for (int k = 0; k < n; k++) {
    const int j = neighbors[k] & NEIGHMASK;
    if (!fits(i, j) || distance_sq(i, j) > (1.0 + EQUAL) * farthest_sq) continue;
    if (best < 0 || nearer(i, j, best)) best = j;
  }
  return best;
}

/* ---------------------------------------------------------------------- */

void RefinePairs::clear()
{
  mates.assign(atom->nlocal, -1);
  families.clear();
}

/* ---------------------------------------------------------------------- */

void RefinePairs::settle()
{
  for (int i = 0; i < atom->nlocal; i++)
    if (mates[i] >= 0) items[i].settled = 1.0;
  items.forward(&RefineItem::settled);
}

/* ----------------------------------------------------------------------
   Return whether i leads its family: the first daughter has the ID of the parent, below the new IDs.
------------------------------------------------------------------------- */

bool RefinePairs::is_first(int i) const
{
  return items[i].family > static_cast<double>(atom->tag[i]);
}

/* ----------------------------------------------------------------------
   Return the members of the family that i leads, in the order of IDs, each member once, as the image nearest to i.  Return no
   members if the merged particle would be too large.
------------------------------------------------------------------------- */

std::vector<int> RefinePairs::family(int i, const int *neighbors, int n, double farthest_sq) const
{
  std::vector<int> found = {i};
  double volume = items[i].volume, most = items[i].most;
  for (int k = 0; k < n; k++) {
    const int j = neighbors[k] & NEIGHMASK;
    if (items[j].family != items[i].family || !fits(i, j)) continue;
    if (distance_sq(i, j) > farthest_sq) continue;
    const auto image = std::find_if(found.begin(), found.end(), [&](int other) {
      return atom->tag[other] == atom->tag[j];
    });
    if (image != found.end()) {
      if (nearer(i, j, *image)) *image = j;
      continue;
    }
    found.push_back(j);
    volume += items[j].volume;
    most = std::min(most, items[j].most);
  }
  if (volume > most) return {};
  std::sort(found.begin(), found.end(), [&](int a, int b) {
    return atom->tag[a] < atom->tag[b];
  });
  return found;
}

/* ---------------------------------------------------------------------- */

void RefinePairs::find_families(NeighList *full, double farthest, int size)
{
  auto may_merge = [&](int i) {
    return items[i].is(MERGES) && items[i].family != 0.0;
  };
  for (int ii = 0; ii < full->inum; ii++) {
    const int i = full->ilist[ii];
    if (!may_merge(i) || !is_first(i)) continue;
    const std::vector<int> found =
        family(i, full->firstneigh[i], full->numneigh[i], farthest * farthest);
    if (static_cast<int>(found.size()) != size) continue;
    items[i].choice = items[i].family;
    mates[i] = found[1];
    families[i] = found;
  }
  items.forward(&RefineItem::choice);

  for (int ii = 0; ii < full->inum; ii++) {
    const int i = full->ilist[ii];
    if (!may_merge(i) || is_first(i)) continue;
    const int *const neighbors = full->firstneigh[i];
    for (int k = 0; k < full->numneigh[i]; k++) {
      const int j = neighbors[k] & NEIGHMASK;
      if (items[j].choice == items[i].family && is_first(j)) mates[i] = j;
    }
  }
  settle();
}

/* ---------------------------------------------------------------------- */

void RefinePairs::find(NeighList *full, double farthest)
{
  std::vector<int> choice(atom->nlocal, -1);
  for (int round = 0; round < ROUNDS; round++) {
    for (int ii = 0; ii < full->inum; ii++) {
      const int i = full->ilist[ii];
      choice[i] = -1;
      if (items[i].is(MERGES) && items[i].settled == 0.0)
        choice[i] = nearest(i, full->firstneigh[i], full->numneigh[i], farthest * farthest);
      items[i].choice = choice[i] < 0 ? 0.0 : static_cast<double>(atom->tag[choice[i]]);
    }
    items.forward(&RefineItem::choice);

    int found = 0;
    for (int i = 0; i < atom->nlocal; i++) {
      const int j = choice[i];
      if (j < 0 || items[j].choice != static_cast<double>(atom->tag[i])) continue;
      mates[i] = j;
      found = 1;
    }
    settle();
    if (!over_all(world, found, MPI_MAX)) break;
  }
}

/* ----------------------------------------------------------------------
   Set r to the vector from the point of one item to the point of another item.
------------------------------------------------------------------------- */

void RefineResidual::offset(int from, int to, double *r) const
{
  const RefineItem &a = items[from], &b = items[to];
  for (int d = 0; d < 3; d++) r[d] = (b.lump.x[d] - a.lump.x[d]) + (b.center[d] - a.center[d]);
}

/* ---------------------------------------------------------------------- */

bool RefineResidual::give(NeighList *full, int i, const double *angmom)
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

void RefineResidual::clear()
{
  du.assign(3 * atom->nlocal, 0.0);
  works.assign(atom->nlocal, 0.0);
}

/* ---------------------------------------------------------------------- */

void RefineResidual::take(NeighList *full)
{
  clear();
  for (int ii = 0; ii < full->inum; ii++) {
    const int i = full->ilist[ii];
    if (items[i].is(NOT_FLUID)) continue;
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

/* ---------------------------------------------------------------------- */

void RefineEvent::init(const Fluid &fluid, double smallest_share)
{
  support = fluid.support_radius();
  smallest = smallest_share;
  fields = Fields::of(atom);
  residual.init(RESIDUAL_RADIUS * support);
}

/* ---------------------------------------------------------------------- */

void RefineEvent::begin()
{
  items.resize();
  targets.assign(atom->nlocal, 0.0);
}

/* ---------------------------------------------------------------------- */

void RefineEvent::set(int i, RefineState state, double volume, double most, double target,
                      double family)
{
  RefineItem &item = items[i];
  item.state = state;
  item.mask = atom->mask[i];
  item.volume = volume;
  item.most = most;
  item.family = family;
  item.lump = lump(i);
  item.mass = item.lump.mass;
  std::copy_n(item.lump.u, 3, item.u);
  targets[i] = target;
}

/* ---------------------------------------------------------------------- */

Lump RefineEvent::lump(int i) const
{
  Lump one;
  one.mass = atom->rmass[i];
  one.energy = atom->esph[i];
  one.energy_rate = fields->desph_before[i];
  one.diffusion[0] = fields->vol_rate[i];
  one.diffusion[1] = fields->vol_rate_before[i];
  one.diffusion[2] = fields->vol_heat[i];
  const double rho = atom->rho[i] + update->dt * atom->drho[i];    // at the end of the step
  for (int slot : fields->slots)
    one.state[slot] = handed_on(state_info(slot).kind, fields->state[slot][i], one.mass, rho);
  std::copy_n(atom->x[i], 3, one.x);
  std::copy_n(atom->v[i], 3, one.u);
  std::copy_n(atom->vest[i], 3, one.u_end);
  if (!fields->has_spins) return one;
  one.inertia = fields->inertia[i];
  std::copy_n(atom->omega[i], 3, one.spin);
  std::copy_n(fields->omegaest[i], 3, one.spin_end);
  return one;
}

/* ---------------------------------------------------------------------- */

void RefineEvent::set_lump(int i, const Lump &one)
{
  atom->vfrac[i] *= one.mass / atom->rmass[i];
  atom->rmass[i] = one.mass;
  atom->esph[i] = one.energy;
  fields->desph_before[i] = one.energy_rate;
  fields->vol_rate[i] = one.diffusion[0];
  fields->vol_rate_before[i] = one.diffusion[1];
  fields->vol_heat[i] = one.diffusion[2];
  std::copy_n(one.x, 3, atom->x[i]);
  std::copy_n(one.u, 3, atom->v[i]);
  std::copy_n(one.u_end, 3, atom->vest[i]);
  if (!fields->has_spins) return;
  fields->inertia[i] = one.inertia;
  std::copy_n(one.spin, 3, atom->omega[i]);
  std::copy_n(one.spin_end, 3, fields->omegaest[i]);
}

/* ----------------------------------------------------------------------
   Set the states of a particle that has split or merged, since its density has changed.
------------------------------------------------------------------------- */

void RefineEvent::set_states(int i, const Lump &one)
{
  for (int slot : fields->slots) {
    double &state = fields->state[slot][i];
    state = taken_over(state_info(slot).kind, state, one.mass, one.state[slot]);
  }
}

/* ----------------------------------------------------------------------
   Return whether particle i merges in this event.
------------------------------------------------------------------------- */

bool RefineEvent::merging(int i) const
{
  if (pairs.mate(i) < 0) return false;
  return items[pairs.leads(i) ? i : pairs.mate(i)].postponed == 0.0;
}

/* ---------------------------------------------------------------------- */

bool RefineEvent::families() const
{
  return fields->has_spins && domain->dimension == 3;
}

/* ---------------------------------------------------------------------- */

bigint RefineEvent::plan(NeighList *full, bigint most)
{
  items.forward_all();
  pairs.clear();
  if (families()) pairs.find_families(full, FARTHEST * support, 1 << domain->dimension);
  pairs.find(full, FARTHEST * support);
  splits.clear();
  for (int ii = 0; ii < full->inum; ii++) {
    const int i = full->ilist[ii];
    Split one = {i, Stencil()};
    if (items[i].is(SPLITS) && find_stencil(full, i, one.stencil)) splits.push_back(one);
  }
  return postpone(most);
}

/* ----------------------------------------------------------------------
   Choose how particle i splits: into the parts of a cube; or into two parts along the axis on which the neighbors are
   farthest, if neighbors are arranged unevenly or cubes would be too small.  Return false if a daughter would leave the box.
------------------------------------------------------------------------- */

bool RefineEvent::find_stencil(NeighList *full, int i, Stencil &stencil) const
{
  const int dim = domain->dimension;
  const double spacing = spacing_of(dim, items[i].volume);
  Arrangement arrangement;
  bool alone = true;
  const int *const neighbors = full->firstneigh[i];
  for (int k = 0; k < full->numneigh[i]; k++) {
    const int j = neighbors[k] & NEIGHMASK;
    double r[3];
    for (int d = 0; d < 3; d++) r[d] = atom->x[j][d] - atom->x[i][d];
    arrangement.add(r);
    if (items[j].is(SPLITS) && dot(r, r) < NEXT * NEXT * spacing * spacing) alone = false;
  }
  double axis[3], ratio;
  const double widest = arrangement.widest(dim, items[i].volume, axis, ratio);
  const double part = alone ? SPLIT_ALONE : SPLIT_IN_BLOCK;
  const int parts = 1 << dim;
  if (ratio < STRETCHED && items[i].volume > parts * smallest * targets[i])
    stencil = cube_stencil(dim, part * spacing);
  else
    stencil = axis_stencil(axis, part * widest);

  for (int k = 0; k < stencil.n; k++) {
    double x[3];
    for (int d = 0; d < 3; d++) x[d] = atom->x[i][d] + stencil.d[k][d];
    if (!in_box(lmp, x)) return false;
  }
  return true;
}

/* ----------------------------------------------------------------------
   Drop the events of the highest IDs if there are more events than most.  Return the number of events that take place.
------------------------------------------------------------------------- */

bigint RefineEvent::postpone(bigint most)
{
  std::vector<tagint> mine;
  for (const Split &one : splits) mine.push_back(atom->tag[one.i]);
  for (int i = 0; i < atom->nlocal; i++)
    if (pairs.leads(i)) mine.push_back(atom->tag[i]);
  const bigint all = over_all<bigint>(world, mine.size(), MPI_SUM);
  if (all <= most) return all;

  std::vector<tagint> tags = gather_all(world, mine, MPI_LMP_TAGINT);
  std::nth_element(tags.begin(), tags.begin() + most, tags.end());
  const tagint end = tags[most];
  for (int i = 0; i < atom->nlocal; i++) items[i].postponed = (atom->tag[i] >= end) ? 1.0 : 0.0;
  items.forward(&RefineItem::postponed);
  splits.erase(std::remove_if(splits.begin(), splits.end(),
                              [&](const Split &one) {
                                return atom->tag[one.i] >= end;
                              }),
               splits.end());
  return most;
}

/* ----------------------------------------------------------------------
   Give the residual angular momentum of the merges to neighbors.  A pair does not merge if the neighbors cannot take this
   angular momentum.
------------------------------------------------------------------------- */

void RefineEvent::give_residual(NeighList *full)
{
  for (int i = 0; i < atom->nlocal; i++)
    if (items[i].is(NOT_FLUID) || (merging(i) && !pairs.leads(i))) items[i].mass = 0.0;
  for (const Merge &one : merges) {
    RefineItem &item = items[one.i];
    item.mass = one.whole.mass;
    for (int d = 0; d < 3; d++) item.center[d] = one.whole.x[d] - item.lump.x[d];
    std::copy_n(one.whole.u, 3, item.u);
  }
  items.forward(&RefineItem::mass, 7);

  std::vector<Merge> taken;
  for (const Merge &one : merges) {
    if (residual.give(full, one.i, one.residual))
      taken.push_back(one);
    else
      items[one.i].postponed = 1.0;
  }
  merges = taken;
  items.forward(&RefineItem::postponed);
  items.forward(&RefineItem::gives, 0);
  residual.take(full);
}

/* ---------------------------------------------------------------------- */

void RefineEvent::carry_out(NeighList *full, const Changed &changed)
{
  merges.clear();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!merging(i) || !pairs.leads(i)) continue;
    Merge one;
    one.i = i;
    for (int j : pairs.members(i)) {
      one.parts.push_back(items[j].lump);
      one.volume += atom->rmass[j] / atom->rho[j];
    }
    one.heat = merge(one.parts.data(), one.parts.size(), domain->dimension, fields->has_spins,
                     one.whole, one.residual);
    merges.push_back(one);
  }
  residual.clear();
  if (!fields->has_spins) give_residual(full);

  // change particles first, then create, then remove

  std::vector<NewIDs> daughters;
  for (const Split &one : splits) daughters.emplace_back(atom->tag[one.i], one.stencil.n - 1);
  std::vector<tagint> first;
  if (!new_ids(lmp, daughters, highest, first))
    error->all(FLERR, "Fix sph/refine: too many particles have split for their IDs");
  const int nbefore = atom->nlocal;
  std::vector<char> own_event(nbefore, 0), dead(nbefore, 0);
  for (const Split &one : splits) own_event[one.i] = 1;
  for (int i = 0; i < nbefore; i++)
    if (merging(i)) {
      own_event[i] = 1;
      dead[i] = !pairs.leads(i);
    }
  move_others(own_event);

  for (Merge &one : merges) {
    Lump &whole = one.whole;
    for (const Lump &part : one.parts) balance.count(-1.0, part);
    for (int d = 0; d < 3; d++) {
      whole.u[d] += residual.velocity(one.i)[d];
      whole.u_end[d] += residual.velocity(one.i)[d];
    }
    whole.energy += force->mvv2e * (one.heat - residual.work(one.i));
    set_lump(one.i, whole);
    set_states(one.i, whole);
    atom->rho[one.i] = whole.mass / one.volume;
    balance.count(1.0, whole);
    balance.merged(force->mvv2e * one.heat);
    changed(one.i, 0.0);
  }
  for (int i = 0; i < nbefore; i++)
    balance.add(RefineBalance::ROTATION, force->mvv2e * residual.work(i));

  begin_change(lmp);
  create(first, changed);
  for (int i = nbefore - 1; i >= 0; i--)
    if (dead[i]) remove_particle(lmp, i);
  end_change(lmp, nbefore);
}

/* ----------------------------------------------------------------------
   Move the neighbors that take residual angular momentum and have no event of their own.
------------------------------------------------------------------------- */

void RefineEvent::move_others(const std::vector<char> &own_event)
{
  for (int i = 0; i < atom->nlocal; i++) {
    const double *const du = residual.velocity(i);
    if (own_event[i] || dot(du, du) == 0.0) continue;
    Lump one = items[i].lump;
    balance.count(-1.0, one);
    for (int d = 0; d < 3; d++) {
      one.u[d] += du[d];
      one.u_end[d] += du[d];
    }
    one.energy -= force->mvv2e * residual.work(i);
    set_lump(i, one);
    balance.count(1.0, one);
  }
}

/* ----------------------------------------------------------------------
   Replace each particle that splits by its first daughter, and create the others.
------------------------------------------------------------------------- */

void RefineEvent::create(const std::vector<tagint> &first, const Changed &changed)
{
  for (std::size_t k = 0; k < splits.size(); k++) {
    const int i = splits[k].i, n = splits[k].stencil.n;
    Lump parent = items[i].lump, daughters[Stencil::MOST];
    balance.count(-1.0, parent);
    for (int d = 0; d < 3; d++) {
      parent.u[d] += residual.velocity(i)[d];
      parent.u_end[d] += residual.velocity(i)[d];
    }
    parent.energy -= force->mvv2e * residual.work(i);
    split(parent, splits[k].stencil, domain->dimension, daughters);
    const bool whole = families() && splits[k].stencil.isotropic;
    const double family = whole ? static_cast<double>(first[k]) : 0.0;
    for (int m = 0; m < n; m++) {
      const int j = (m == 0) ? i : create_copy(lmp, i, first[k] + m - 1, atom->x[i]);
      set_lump(j, daughters[m]);
      set_states(j, daughters[m]);
      balance.count(1.0, daughters[m]);
      changed(j, family);
    }
    balance.add(RefineBalance::SPLITS, 1.0);
  }
}
