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
#include "neigh_list.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

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

static constexpr int ROUNDS = 30;
static constexpr double EQUAL = 1.0e-9;     // distances squared
static constexpr double ONE_CLASS = 2.5;    // ratio of the volumes of two that may merge

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
  double rsq = 0.0;
  for (int d = 0; d < 3; d++) {
    const double r = atom->x[j][d] - atom->x[i][d];
    rsq += r * r;
  }
  return rsq;
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
   Tell whether j is nearer to i than the other one.  At equal distances the IDs decide, for two images
   of one particle, in a narrow box, the positions.
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
   Tell the leader of a family: the first daughter has the ID of the parent, below the new ones.
------------------------------------------------------------------------- */

bool RefinePairs::is_first(int i) const
{
  return items[i].family > static_cast<double>(atom->tag[i]);
}

/* ----------------------------------------------------------------------
   Return the members of the family that i leads, in the order of their IDs, each once, in its nearest
   image.  Empty if the whole would be too large.
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

    int found = 0, found_all;
    for (int i = 0; i < atom->nlocal; i++) {
      const int j = choice[i];
      if (j < 0 || items[j].choice != static_cast<double>(atom->tag[i])) continue;
      mates[i] = j;
      found = 1;
    }
    settle();
    MPI_Allreduce(&found, &found_all, 1, MPI_INT, MPI_MAX, world);
    if (!found_all) break;
  }
}

/* ----------------------------------------------------------------------
   Set r to the way from the point of one item to that of another one.
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
