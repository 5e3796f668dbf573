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

#include "sph_dissipation_neighbors.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "force.h"
#include "math_extra.h"
#include "neigh_list.h"
#include "neighbor.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

static constexpr int ROOM = 16;    // entries that the widest vector may write behind the last one
static constexpr double SPARSE = 16.0;    // most cells per particle
static constexpr int COLUMN = 6;          // cells in y and z of one column
static constexpr double ROUND_OFF = 1.0e-9;
static constexpr double FLOAT_ROUND_OFF =
    1.0e-6;    // error of a squared distance, in units of the squared cutoff

/* ---------------------------------------------------------------------- */

std::string NeighborSearch::left_to_lammps() const
{
  if (neighbor->style == Neighbor::NSQ) return "neighbor style nsq";
  if (neighbor->style != Neighbor::BIN) return "neighbor style multi";
  if (neighbor->includegroup) return "neigh_modify include";
  return "";
}

/* ---------------------------------------------------------------------- */

void NeighborSearch::init(const LoopSet *loops_in, Threads *threads_in, double support_in)
{
  loops = loops_in;
  threads = threads_in;
  support = support_in;
  cutoff = support + neighbor->skin;
  ncalls = lastcall = -1;
}

/* ---------------------------------------------------------------------- */

bool NeighborSearch::update(NeighList *list)
{
  if (ncalls == neighbor->ncalls && lastcall == neighbor->lastcall) return false;
  if (ncalls < 0) copy_neighbor_info();    // as the styles of LAMMPS, once per setup of a run
  ncalls = neighbor->ncalls;
  lastcall = neighbor->lastcall;
  if (list->copy) {    // copy of a list that LAMMPS builds for other styles
    neighbor->build_one(list);
    return true;
  }
  list->grow(atom->nlocal, atom->nlocal + atom->nghost);
  build(list);
  list->np->last_build = lastcall;    // so LAMMPS does not build the list again for a copy
  return true;
}

/* ---------------------------------------------------------------------- */

void NeighborSearch::build(NeighList *list)
{
  list->inum = list->gnum = 0;
  find_members(list);
  if (members.empty()) return;
  choose_cells();
  find_rows();
  sort(owned, 0, nowned);
  sort(ghosts, nowned, static_cast<int>(members.size()));

  skips = false;
  if (list->ijskip)
    for (int i = 1; i <= atom->ntypes; i++)
      for (int j = 1; j <= atom->ntypes; j++)
        if (!list->iskip[i] && !list->iskip[j] && list->ijskip[i][j]) skips = true;

  order_cells();
  const int nthread = threads->size();
  parts.resize(nthread);
  std::vector<std::size_t> begin(nthread + 1, 0);    // about as many particles for each thread
  bigint n = 0;
  for (int k = 0; k < nthread; k++) {
    std::size_t &end = begin[k + 1] = begin[k];
    for (; n * nthread < static_cast<bigint>(nowned) * (k + 1); end++)
      n += owned.start[order[end] + 1] - owned.start[order[end]];
  }
  threads->run([&](int k) {
    search(begin[k], begin[k + 1], list, parts[k]);
  });
  for (const auto &part : parts) {
    std::copy(part.rows.begin(), part.rows.end(), list->ilist + list->inum);
    list->inum += static_cast<int>(part.rows.size());
  }
}

/* ----------------------------------------------------------------------
   Find the neighbors of the owned particles in some of the cells: first neighbors in the same cell, then within the support,
   then beyond the support, in the skin.  In this order, most vectors of the pair loops are full or have no pair
   inside the support.
------------------------------------------------------------------------- */

void NeighborSearch::search(std::size_t from, std::size_t to, NeighList *list, Part &part) const
{
  const double longest = *std::max_element(size, size + 3);
  const double error = FLOAT_ROUND_OFF * (2.0 + 2.0 * longest / cutoff);
  const double ratio = support / cutoff;
  const Reach reach = {static_cast<float>(std::min(ratio * ratio, 1.0 - error)),
                       static_cast<float>(1.0 - error), static_cast<float>(1.0 + error)};
  part.rows.clear();
  part.offset.clear();
  bigint end = 0;

  for (std::size_t m = from; m < to; m++) {
    const int c = order[m], first = owned.start[c], last = owned.start[c + 1];
    const int place[3] = {c % ncell[0], c / ncell[0] % ncell[1], c / ncell[0] / ncell[1]};
    double corner[3];
    for (int d = 0; d < 3; d++) corner[d] = lo[d] + place[d] * size[d];
    find_candidates(owned, upper_rows, place, corner, part.owned);
    find_candidates(ghosts, all_rows, place, corner, part.ghosts);

    const int most = part.owned.columns.n + part.ghosts.columns.n + last - first + 2 * ROOM;
    if (static_cast<int>(part.far.size()) < most) part.far.resize(most);
    for (int p = first; p < last; p++) {
      const int i = owned.index[p];
      if (static_cast<bigint>(part.neighbors.size()) < end + most)
        part.neighbors.resize(end + end / 8 + std::max(most, 1024));
      int *const found = part.neighbors.data() + end;
      float at[3];
      for (int d = 0; d < 3; d++) at[d] = static_cast<float>((owned.x[d][p] - corner[d]) / cutoff);

      int n = last - p - 1;    // owned particles in the same cell
      std::copy_n(owned.index.begin() + p + 1, n, found);
      n = check(i, found, n);

      int nfar = 0;
      for (const Candidates *candidates : {&part.owned, &part.ghosts}) {
        Found some = {found + n, part.far.data() + nfar, 0, 0, false};
        loops->near(candidates->columns, at, reach, some);
        if (some.doubt) some.nfar = check(i, some.far, some.nfar);
        if (by_id && candidates == &part.ghosts) {
          auto keep = [&](int j) {
            return has_pair(i, j);
          };
          some.nclose = filter(some.close, some.nclose, keep);
          some.nfar = filter(some.far, some.nfar, keep);
        }
        n += some.nclose;
        nfar += some.nfar;
      }
      std::copy_n(part.far.data(), nfar, found + n);
      n += nfar;
      if (skips || has_exclusions(i))
        n = filter(found, n, [&](int j) {
          return is_wanted(list, i, j);
        });
      list->numneigh[i] = n;
      part.rows.push_back(i);
      part.offset.push_back(end);
      end += n;
    }
  }
  for (std::size_t k = 0; k < part.rows.size(); k++)
    list->firstneigh[part.rows[k]] = part.neighbors.data() + part.offset[k];
}

/* ----------------------------------------------------------------------
   Find the owned particles of the types of the fluid, and the ghosts of these types that may be in pairs.
------------------------------------------------------------------------- */

void NeighborSearch::find_members(const NeighList *list)
{
  const int nlocal = atom->nlocal, nall = atom->nlocal + atom->nghost;
  auto add = [&](int i) {
    if (!list->iskip || !list->iskip[atom->type[i]]) members.push_back(i);
  };
  members.clear();
  for (int i = 0; i < nlocal; i++) add(i);
  nowned = static_cast<int>(members.size());
  by_id = force->newton_pair && comm->style != Comm::BRICK;
  if (force->newton_pair && !by_id)
    for (const int i : exchange.ghosts_from_above()) add(i);
  else
    for (int i = nlocal; i < nall; i++) add(i);
}

/* ----------------------------------------------------------------------
   Choose the size of the cells: half of the cutoff is long enough for few cells and short enough for few candidates; cells
   are larger if most of the space is empty.  The cells divide the domain of the processor as LAMMPS's bins for sorting do: so
   the particles of a cell are close in memory.  LAMMPS's bins have checked that all positions are finite.
------------------------------------------------------------------------- */

void NeighborSearch::choose_cells()
{
  double **const x = atom->x;
  double first[3], last[3];    // of the positions
  for (int d = 0; d < 3; d++) first[d] = last[d] = x[members[0]][d];
  for (const int i : members)
    for (int d = 0; d < 3; d++) {
      first[d] = std::min(first[d], x[i][d]);
      last[d] = std::max(last[d], x[i][d]);
    }
  double sublo[3], subhi[3];
  if (domain->triclinic)
    domain->bbox(domain->sublo_lamda, domain->subhi_lamda, sublo, subhi);
  else {
    std::copy_n(domain->sublo, 3, sublo);
    std::copy_n(domain->subhi, 3, subhi);
  }
  const double most = SPARSE * static_cast<double>(members.size()) + 1000.0;
  double length = 0.5 * cutoff, total;
  do {
    total = 1.0;
    for (int d = 0; d < 3; d++) {
      const double domain_length = subhi[d] - sublo[d];
      size[d] = std::max(domain_length / std::max(std::floor(domain_length / length), 1.0), length);
      lo[d] = sublo[d] + size[d] * std::floor((first[d] - sublo[d]) / size[d]);
      total *= std::floor((last[d] - lo[d]) / size[d]) + 1.0;
    }
    length *= 1.25;
  } while (total > most);
  for (int d = 0; d < 3; d++) ncell[d] = static_cast<int>((last[d] - lo[d]) / size[d]) + 1;
}

/* ----------------------------------------------------------------------
   Find the rows of cells along x, relative to the cell of a particle, that may have neighbors of the particle.
------------------------------------------------------------------------- */

void NeighborSearch::find_rows()
{
  const double reach_sq = cutoff * cutoff * (1.0 + ROUND_OFF);
  auto gap_sq = [this](int n, int d) {
    const double gap = (n == 0) ? 0.0 : (std::abs(n) - 1) * size[d];
    return gap * gap;
  };
  const int zmost = std::min(ncell[2] - 1, static_cast<int>(cutoff / size[2]) + 1);
  const int ymost = std::min(ncell[1] - 1, static_cast<int>(cutoff / size[1]) + 1);
  all_rows.clear();
  upper_rows.clear();
  for (int z = -zmost; z <= zmost; z++)
    for (int y = -ymost; y <= ymost; y++) {
      const double left = reach_sq - gap_sq(y, 1) - gap_sq(z, 2);
      if (!(left > 0.0)) continue;
      const auto reach = static_cast<int>(std::ceil(std::sqrt(left) / size[0]));
      all_rows.push_back({y, z, -reach, reach});
      if (z > 0 || (z == 0 && y > 0)) upper_rows.push_back({y, z, -reach, reach});
      if (z == 0 && y == 0) upper_rows.push_back({y, z, 1, reach});
    }
}

/* ----------------------------------------------------------------------
   Sort members into cells, by counting.
------------------------------------------------------------------------- */

void NeighborSearch::sort(Sorted &sorted, int from, int to)
{
  double **const x = atom->x;
  const int *const begin = members.data() + from;
  const int n = to - from;
  auto &start = sorted.start;
  start.assign(ncell[0] * ncell[1] * ncell[2] + 1, 0);
  cell.resize(n);
  threads->for_each(n, [&](int m) {
    int place[3];
    for (int d = 0; d < 3; d++)
      place[d] = std::min(static_cast<int>((x[begin[m]][d] - lo[d]) / size[d]), ncell[d] - 1);
    cell[m] = (place[2] * ncell[1] + place[1]) * ncell[0] + place[0];
  });
  for (const int c : cell) start[c]++;
  int sum = 0;
  for (int &entry : start) {
    sum += entry;
    entry = sum;
  }
  if (static_cast<int>(sorted.index.size()) < n + ROOM) {
    for (auto &column : sorted.x) column.resize(n + n / 16 + ROOM);
    sorted.index.resize(n + n / 16 + ROOM);
  }
  for (int m = n - 1; m >= 0; m--) {
    const int entry = --start[cell[m]];
    sorted.index[entry] = begin[m];
    for (int d = 0; d < 3; d++) sorted.x[d][entry] = x[begin[m]][d];
  }
}

/* ----------------------------------------------------------------------
   Order the cells with owned particles for the rows of the list: one square column of cells along x after the other, so the
   second-level cache keeps the neighbors of successive rows.
------------------------------------------------------------------------- */

void NeighborSearch::order_cells()
{
  order.clear();
  for (int z = 0; z < ncell[2]; z += COLUMN)
    for (int y = 0; y < ncell[1]; y += COLUMN)
      for (int x = 0; x < ncell[0]; x++)
        for (int k = z; k < std::min(z + COLUMN, ncell[2]); k++)
          for (int j = y; j < std::min(y + COLUMN, ncell[1]); j++) {
            const int c = (k * ncell[1] + j) * ncell[0] + x;
            if (owned.start[c] < owned.start[c + 1]) order.push_back(c);
          }
}

/* ----------------------------------------------------------------------
   Copy the particles in some rows of cells around a cell, relative to the corner of the cell, in units of the cutoff.
------------------------------------------------------------------------- */

void NeighborSearch::find_candidates(const Sorted &sorted, const std::vector<CellRow> &rows,
                                     const int *place, const double *corner,
                                     Candidates &candidates) const
{
  const PlaceColumns places = {{sorted.x[0].data(), sorted.x[1].data(), sorted.x[2].data()},
                               sorted.index.data()};
  CandidateColumns &columns = candidates.columns;
  columns.n = 0;
  for (const auto &row : rows) {
    const int y = place[1] + row.y, z = place[2] + row.z;
    if (y < 0 || y >= ncell[1] || z < 0 || z >= ncell[2]) continue;
    const int base = (z * ncell[1] + y) * ncell[0];
    const int from = sorted.start[base + std::max(place[0] + row.first, 0)];
    const int to = sorted.start[base + std::min(place[0] + row.last, ncell[0] - 1) + 1];
    if (from >= to) continue;
    const std::size_t room = columns.n + to - from + 2 * ROOM;
    if (candidates.index.size() < room) {
      for (int d = 0; d < 3; d++) {
        candidates.x[d].resize(2 * room);
        columns.x[d] = candidates.x[d].data();
      }
      candidates.index.resize(2 * room);
      columns.index = candidates.index.data();
    }
    loops->take_candidates(places, from, to, corner, 1.0 / cutoff, columns);
  }
}

/* ----------------------------------------------------------------------
   Keep the particles within the cutoff, in double precision; return the number of these particles.
------------------------------------------------------------------------- */

int NeighborSearch::check(int i, int *found, int n) const
{
  double **const x = atom->x;
  return filter(found, n, [&](int j) {
    return MathExtra::distsq3(x[i], x[j]) <= cutoff * cutoff;
  });
}

/* ----------------------------------------------------------------------
   Return true if neither pair_style hybrid nor neigh_modify exclude removes the pair.
------------------------------------------------------------------------- */

bool NeighborSearch::is_wanted(const NeighList *list, int i, int j) const
{
  const int itype = atom->type[i], jtype = atom->type[j];
  if (skips && list->ijskip[itype][jtype]) return false;
  return !exclude || !exclusion(i, j, itype, jtype, atom->mask, atom->molecule);
}

/* ----------------------------------------------------------------------
   Return true if neigh_modify exclude names the type of a particle, one of its groups, or its molecule.
------------------------------------------------------------------------- */

bool NeighborSearch::has_exclusions(int i) const
{
  if (!exclude) return false;
  const int bits = atom->mask[i];
  for (int m = 0; m < nex_type; m++)
    if (atom->type[i] == ex1_type[m] || atom->type[i] == ex2_type[m]) return true;
  for (int m = 0; m < nex_group; m++)
    if (bits & (ex1_bit[m] | ex2_bit[m])) return true;
  for (int m = 0; m < nex_mol; m++)
    if (bits & ex_mol_bit[m]) return true;
  return false;
}

/* ----------------------------------------------------------------------
   Return true if this processor has the pair of an owned particle and a ghost, with newton on: by the IDs, as class NPairNsq
   of LAMMPS; by position for images of one particle.
------------------------------------------------------------------------- */

bool NeighborSearch::has_pair(int i, int j) const
{
  const tagint itag = atom->tag[i], jtag = atom->tag[j];
  if (itag != jtag) return (itag > jtag) == ((itag ^ jtag) & 1);
  double **const x = atom->x;
  for (const int d : {2, 1})
    if (std::fabs(x[j][d] - x[i][d]) > ROUND_OFF * cutoff) return x[j][d] > x[i][d];
  return x[j][0] > x[i][0];
}

/* ---------------------------------------------------------------------- */

double NeighborSearch::memory_usage() const
{
  std::size_t bytes = (cell.capacity() + order.capacity() + members.capacity()) * sizeof(int);
  for (const Sorted *some : {&owned, &ghosts})
    bytes += some->start.capacity() * sizeof(int) +
        some->index.capacity() * (3 * sizeof(double) + sizeof(int));
  for (const auto &part : parts)
    bytes +=
        (part.neighbors.capacity() + part.far.capacity() + part.rows.capacity()) * sizeof(int) +
        part.offset.capacity() * sizeof(bigint) +
        (part.owned.index.capacity() + part.ghosts.index.capacity()) *
            (3 * sizeof(float) + sizeof(int));
  return static_cast<double>(bytes);
}
