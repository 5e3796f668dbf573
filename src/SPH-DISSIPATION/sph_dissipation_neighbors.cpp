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
#include "domain.h"
#include "force.h"
#include "neigh_list.h"
#include "neighbor.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

static constexpr int ROOM = 16;    // entries that the widest vector may write behind the last one
static constexpr double SPARSE = 16.0;    // most cells per particle
static constexpr double ROUND_OFF = 1.0e-9;
static constexpr double FLOAT_ROUND_OFF =
    1.0e-6;    // of the square of a distance as long as the largest coordinate

/* ---------------------------------------------------------------------- */

NeighborSearch::NeighborSearch(LAMMPS *lmp) :
    NPair(lmp), loops(nullptr), threads(nullptr), cutoff(0.0), ncalls(-1), lastcall(-1),
    halved(true), skips(false), lo(), hi(), size(), nbox(), first(), ncell(), sorted()
{
}

/* ---------------------------------------------------------------------- */

std::string NeighborSearch::left_to_lammps() const
{
  if (neighbor->style == Neighbor::NSQ) return "neighbor style nsq";
  if (neighbor->style != Neighbor::BIN) return "neighbor style multi";
  if (neighbor->includegroup) return "neigh_modify include";
  if (atom->molecular != Atom::ATOMIC) return "an atom style with bonds";
  return "";
}

/* ---------------------------------------------------------------------- */

void NeighborSearch::init(const LoopSet *loops_in, Threads *threads_in, double support)
{
  loops = loops_in;
  threads = threads_in;
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
  if (list->copy) {    // of one that LAMMPS builds for others
    neighbor->build_one(list);
    return true;
  }
  list->grow(atom->nlocal, atom->nlocal + atom->nghost);
  build(list);
  list->np->last_build = lastcall;    // LAMMPS does not build it for a list that is a copy of it
  return true;
}

/* ---------------------------------------------------------------------- */

void NeighborSearch::build(NeighList *list)
{
  halved = force->newton_pair && !domain->triclinic;
  list->inum = list->gnum = 0;
  find_members(list);
  if (members.empty()) return;
  choose_cells();
  find_rows();
  sort();

  skips = false;
  if (list->ijskip)
    for (int i = 1; i <= atom->ntypes; i++)
      for (int j = 1; j <= atom->ntypes; j++)
        if (!list->iskip[i] && !list->iskip[j] && list->ijskip[i][j]) skips = true;

  const int total = ncell[0] * ncell[1] * ncell[2];
  const int nthread = threads->size();
  parts.resize(nthread);
  threads->run([&](int k) {
    auto first_cell = [&](int thread) {    // about as many particles for each
      const auto entry = static_cast<int>(static_cast<bigint>(start[total]) * thread / nthread);
      return static_cast<int>(std::lower_bound(start.begin(), start.end(), entry) - start.begin());
    };
    search(first_cell(k), (k + 1 < nthread) ? first_cell(k + 1) : total, list, parts[k]);
  });
  for (const auto &part : parts) {
    std::copy(part.rows.begin(), part.rows.end(), list->ilist + list->inum);
    list->inum += static_cast<int>(part.rows.size());
  }
}

/* ----------------------------------------------------------------------
   neighbors of the owned particles in some of the cells
------------------------------------------------------------------------- */

void NeighborSearch::search(int from, int to, NeighList *list, Part &part) const
{
  const double longest = *std::max_element(size, size + 3);
  const double error = FLOAT_ROUND_OFF * cutoff * (2.0 * cutoff + 2.0 * longest);
  const auto bound = static_cast<float>(cutoff * cutoff + error);
  const auto safe = static_cast<float>(cutoff * cutoff - error);
  const int nlocal = atom->nlocal;
  part.rows.clear();
  part.offset.clear();
  bigint end = 0;

  for (int c = from; c < to; c++) {
    if (start[c] == start[c + 1] || sorted.index[start[c]] >= nlocal) continue;    // ghosts at most
    const int place[3] = {c % ncell[0], c / ncell[0] % ncell[1], c / ncell[0] / ncell[1]};
    double corner[3];
    for (int d = 0; d < 3; d++) corner[d] = lo[d] + (first[d] + place[d]) * size[d];
    find_candidates(place, corner, part);

    const int most = part.candidates.n + start[c + 1] - start[c] + ROOM;
    for (int p = start[c]; p < start[c + 1] && sorted.index[p] < nlocal; p++) {
      const int i = sorted.index[p];
      if (static_cast<bigint>(part.neighbors.size()) < end + most)
        part.neighbors.resize(end + end / 8 + std::max(most, 1024));
      int *const found = part.neighbors.data() + end;
      int n = halved ? add_own_cell(p, start[c + 1], found) : 0;
      float at[3];
      for (int d = 0; d < 3; d++) at[d] = static_cast<float>(sorted.x[d][p] - corner[d]);
      bool doubt = false;
      const int nnear = loops->near(part.candidates, at, bound, safe, found + n, doubt);
      n += doubt ? check(i, found + n, nnear) : nnear;
      if (skips || !halved || has_exclusions(i)) n = filter(list, i, found, n);
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
   owned and ghost particles of the types of the fluid
------------------------------------------------------------------------- */

void NeighborSearch::find_members(const NeighList *list)
{
  const int nall = atom->nlocal + atom->nghost;
  members.clear();
  for (int i = 0; i < nall; i++)
    if (!list->iskip || !list->iskip[atom->type[i]]) members.push_back(i);
}

/* ----------------------------------------------------------------------
   as class NBinStandard of LAMMPS: the cells fill the box, and what is outside of it is in none of those inside.  That class
   has looked at all positions: they are numbers
------------------------------------------------------------------------- */

int NeighborSearch::cell_of(double x, int d) const
{
  if (x >= hi[d]) return static_cast<int>((x - hi[d]) / size[d]) + nbox[d];
  if (x >= lo[d]) return std::min(static_cast<int>((x - lo[d]) / size[d]), nbox[d] - 1);
  return static_cast<int>((x - lo[d]) / size[d]) - 1;
}

void NeighborSearch::choose_cells()
{
  for (int d = 0; d < 3; d++) {
    lo[d] = bboxlo[d];
    hi[d] = bboxhi[d];
  }

  // the same cells on all processors; larger ones where most of the box is empty

  const double most_cells = SPARSE * static_cast<double>(atom->natoms) + 1000.0;
  double total, length = 0.5 * cutoff;
  do {
    total = 1.0;
    for (int d = 0; d < 3; d++) total *= std::max(1.0, std::floor((hi[d] - lo[d]) / length));
    if (total > most_cells) length *= 1.25;
  } while (total > most_cells);
  for (int d = 0; d < 3; d++) {
    nbox[d] = std::max(1, static_cast<int>((hi[d] - lo[d]) / length));
    size[d] = (hi[d] - lo[d]) / nbox[d];
  }

  double least[3] = {hi[0], hi[1], hi[2]}, most[3] = {lo[0], lo[1], lo[2]};
  double **const x = atom->x;
  for (const int i : members)
    for (int d = 0; d < 3; d++) {
      least[d] = std::min(least[d], x[i][d]);
      most[d] = std::max(most[d], x[i][d]);
    }
  for (int d = 0; d < 3; d++) {
    first[d] = cell_of(least[d], d);
    ncell[d] = cell_of(most[d], d) - first[d] + 1;
  }
}

/* ----------------------------------------------------------------------
   the cells that may have a neighbor of a particle: all, or those above its own
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
  rows.clear();
  for (int z = halved ? 0 : -zmost; z <= zmost; z++)
    for (int y = (halved && z == 0) ? 0 : -ymost; y <= ymost; y++) {
      const double left = reach_sq - gap_sq(y, 1) - gap_sq(z, 2);
      if (left > 0.0)
        rows.push_back({y, z, static_cast<int>(std::ceil(std::sqrt(left) / size[0]))});
    }
}

/* ----------------------------------------------------------------------
   counting sort; in each cell the owned particles come before the ghosts
------------------------------------------------------------------------- */

void NeighborSearch::sort()
{
  double **const x = atom->x;
  const std::size_t n = members.size();
  start.assign(ncell[0] * ncell[1] * ncell[2] + 1, 0);
  cell.resize(n);
  threads->for_each(static_cast<int>(n), [&](int m) {
    int place[3];
    for (int d = 0; d < 3; d++) place[d] = cell_of(x[members[m]][d], d) - first[d];
    cell[m] = (place[2] * ncell[1] + place[1]) * ncell[0] + place[0];
  });
  for (const int c : cell) start[c]++;
  int sum = 0;
  for (int &entry : start) {
    sum += entry;
    entry = sum;
  }
  if (sorted_index.size() < n + ROOM) {
    for (auto &column : sorted_x) column.resize(n + n / 16 + ROOM);
    sorted_index.resize(n + n / 16 + ROOM);
  }
  for (std::size_t m = n; m-- > 0;) {
    const int to = --start[cell[m]];
    sorted_index[to] = members[m];
    for (int d = 0; d < 3; d++) sorted_x[d][to] = x[members[m]][d];
  }
  sorted = {{sorted_x[0].data(), sorted_x[1].data(), sorted_x[2].data()}, sorted_index.data()};
}

/* ----------------------------------------------------------------------
   of one cell: the particles of the rows of cells around it, relative to its corner
------------------------------------------------------------------------- */

void NeighborSearch::find_candidates(const int *place, const double *corner, Part &part) const
{
  CandidateColumns &candidates = part.candidates;
  candidates.n = 0;
  const int x = place[0];
  for (const auto &row : rows) {
    const int y = place[1] + row.y, z = place[2] + row.z;
    if (y < 0 || y >= ncell[1] || z < 0 || z >= ncell[2]) continue;
    const bool own = halved && row.y == 0 && row.z == 0;
    const int base = (z * ncell[1] + y) * ncell[0];
    const int from = start[base + (own ? x + 1 : std::max(x - row.reach, 0))];
    const int to = start[base + std::min(x + row.reach, ncell[0] - 1) + 1];
    if (from >= to) continue;
    const std::size_t room = candidates.n + to - from + 2 * ROOM;
    if (part.index.size() < room) {
      for (int d = 0; d < 3; d++) {
        part.x[d].resize(2 * room);
        candidates.x[d] = part.x[d].data();
      }
      part.index.resize(2 * room);
      candidates.index = part.index.data();
    }
    loops->take_candidates(sorted, from, to, corner, candidates);
  }
}

/* ----------------------------------------------------------------------
   neighbors of the p-th sorted particle in its own cell: owned ones after it, and ghosts above it
------------------------------------------------------------------------- */

int NeighborSearch::add_own_cell(int p, int end, int *found) const
{
  const double here[3] = {sorted.x[0][p], sorted.x[1][p], sorted.x[2][p]};
  auto is_above = [&](int q) {
    for (const int d : {2, 1, 0})
      if (sorted.x[d][q] != here[d]) return sorted.x[d][q] > here[d];
    return true;
  };
  int n = 0;
  for (int q = p + 1; q < end; q++) {
    if (sorted.index[q] >= atom->nlocal && !is_above(q)) continue;
    double rsq = 0.0;
    for (int d = 0; d < 3; d++) rsq += (here[d] - sorted.x[d][q]) * (here[d] - sorted.x[d][q]);
    if (rsq <= cutoff * cutoff) found[n++] = sorted.index[q];
  }
  return n;
}

/* ----------------------------------------------------------------------
   keeps those within the cutoff, in double precision; returns how many
------------------------------------------------------------------------- */

int NeighborSearch::check(int i, int *found, int n) const
{
  double **const x = atom->x;
  int kept = 0;
  for (int k = 0; k < n; k++) {
    const int j = found[k];
    double rsq = 0.0;
    for (int d = 0; d < 3; d++) rsq += (x[i][d] - x[j][d]) * (x[i][d] - x[j][d]);
    found[kept] = j;
    if (rsq <= cutoff * cutoff) kept++;
  }
  return kept;
}

/* ----------------------------------------------------------------------
   keeps the pairs that this list is to have; returns how many
------------------------------------------------------------------------- */

int NeighborSearch::filter(const NeighList *list, int i, int *found, int n) const
{
  const int *const type = atom->type;
  int kept = 0;
  for (int k = 0; k < n; k++) {
    const int j = found[k];
    if (!halved && !has_pair(i, j)) continue;
    if (skips && list->ijskip[type[i]][type[j]]) continue;
    if (exclude && exclusion(i, j, type[i], type[j], atom->mask, atom->molecule)) continue;
    found[kept++] = j;
  }
  return kept;
}

/* ----------------------------------------------------------------------
   whether neigh_modify exclude names the type of a particle or one of its groups
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
   newton off: pairs of owned particles once, others on both processors; on: by ID, as class NPairBin of LAMMPS does in
   triclinic boxes, and by position for images of the same particle
------------------------------------------------------------------------- */

bool NeighborSearch::has_pair(int i, int j) const
{
  if (j < atom->nlocal || !force->newton_pair) return j > i;
  const tagint itag = atom->tag[i], jtag = atom->tag[j];
  if (itag != jtag) return (itag > jtag) == ((itag + jtag) % 2 == 1);
  const double delta = 0.01 * force->angstrom;
  double **const x = atom->x;
  for (const int d : {2, 1})
    if (std::fabs(x[j][d] - x[i][d]) > delta) return x[j][d] > x[i][d];
  return x[j][0] > x[i][0];
}

/* ---------------------------------------------------------------------- */

double NeighborSearch::memory_usage() const
{
  std::size_t bytes = (start.capacity() + cell.capacity() + members.capacity()) * sizeof(int) +
      sorted_index.capacity() * (3 * sizeof(double) + sizeof(int));
  for (const auto &part : parts)
    bytes += (part.neighbors.capacity() + part.rows.capacity()) * sizeof(int) +
        part.offset.capacity() * sizeof(bigint) +
        part.index.capacity() * (3 * sizeof(float) + sizeof(int));
  return static_cast<double>(bytes);
}
