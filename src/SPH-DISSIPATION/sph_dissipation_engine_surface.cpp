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

#include "sph_dissipation_engine_surface.h"

#include "atom.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

void SurfacePairs::find(BoundaryRows &all, int nall, const std::function<int(int)> &body)
{
  place.clear();
  rows.clear();
  first.clear();
  index.assign(BLOCK, {-1, -1});
  std::vector<int> number(all.size());
  for (int m = 0; m < all.size(); m++) {
    number[m] = body(all.wall[m]);
    if (number[m] >= 0) place.push_back(m);
  }
  std::stable_sort(place.begin(), place.end(), [&](int m, int n) {
    return number[m] < number[n];
  });

  struct Copy {
    int place, body;
  };
  std::vector<Copy> last(nall, {-1, -1});    // of each particle of the fluid
  all.candidate_copy.assign(place.empty() ? 0 : all.candidate.size(), 0);
  all.copy.assign(place.empty() ? 0 : all.fluid.size(), 0);
  for (const int m : place) {
    rows.push_back(static_cast<int>(index.size()));
    first.push_back(all.first[m]);
    index.push_back({all.wall[m], all.wall[m]});
    for (bigint k = all.first[m]; k < all.first[m + 1]; k++) {
      const int i = index_of(all.candidate[k]);
      if (i >= nall) break;    // a spare one
      if (last[i].body != number[m]) {
        last[i] = {static_cast<int>(index.size()), number[m]};
        index.push_back({i, all.wall[m]});
      }
      all.candidate_copy[k] = offset_of(last[i].place);
    }
  }
  count.assign(place.size(), 0);
  slope.assign(all.slope.size(), 0.0);
}

/* ----------------------------------------------------------------------
   Set a number of each copy to value(index of the atom), and the number of spare particles to spare.
------------------------------------------------------------------------- */

template <class T, class Value>
void SurfacePairs::fill(std::vector<T> &values, const T &spare, Value &&value)
{
  values.resize(index.size());
  std::fill_n(values.begin(), BLOCK, spare);
  for (std::size_t k = BLOCK; k < index.size(); k++) values[k] = value(index[k].particle);
}

/* ---------------------------------------------------------------------- */

void Engine::accumulate_friction(SurfacePairs &some, BoundaryRows &rows, double *slope,
                                 PairTally *tally, const StepNoise *of_step, int thread)
{
  struct TallyOfCopies : PairTally {
    PairTally *all;
    const std::vector<SurfacePairs::Index> &index;

    TallyOfCopies(PairTally *all, const std::vector<SurfacePairs::Index> &index) :
        all(all), index(index)
    {
    }
    void tally(int i, int j, const double *force_on_i, const double *rij) override
    {
      all->tally(index[i].particle, index[j].particle, force_on_i, rij);
    }
  } of_copies(tally, some.index);

  const std::size_t n = some.index.size();
  some.force.assign(n, ForceSum());
  some.side.set(side.columns);
  some.side.resize(n);
  std::fill(some.side.rows.begin(), some.side.rows.end(), 0.0);
  if (some.rows.empty()) return;

  some.fill(some.type, 1, [&](int i) {
    return atom->type[i];
  });
  some.weight.resize(n, 1.0);

  LoopData part = data;
  part.inum = static_cast<int>(some.rows.size());
  part.ilist = some.rows.data();
  part.first = some.first.data();
  part.count = some.count.data();
  part.neighbor = rows.copy.data();
  part.slope = slope;
  part.particle = some.particle.data();
  part.spin = some.spin.data();
  part.spare = 0;
  part.cohesion = {};
  part.excess = nullptr;
  part.type = some.type.data();
  part.weight = some.weight.data();
  part.force = some.force.data();
  part.side = some.side.rows.data();
  part.tally = tally ? &of_copies : nullptr;
  if (!of_step || !of_step->surfaces.data) return force_loop(part);

  const NoiseData &of_all = *of_step->surfaces.data;
  NoiseData noise = of_all;
  some.fill(some.tag, 0.0, [&](int i) {
    return of_all.tag[i];
  });
  noise.tag = some.tag.data();
  if (fixed->own_temperatures) {
    some.fill(some.noise, NoiseRow(), [&](int i) {
      return of_all.row[i];
    });
    some.fill(some.mobility, 0.0, [&](int i) {
      return of_all.mobility[i];
    });
    noise.row = some.noise.data();
    noise.mobility = some.mobility.data();
  }
  part.noise = &noise;
  part.random = room_for_numbers(thread, part);
  loops->noisy_forces(of_step->surfaces.form)(part);
}

/* ---------------------------------------------------------------------- */

double SurfacePairs::memory_usage() const
{
  return bytes(slope, side, index, place, rows, count, first, force, particle, spin, weight, type,
               tag, mobility, noise);
}
