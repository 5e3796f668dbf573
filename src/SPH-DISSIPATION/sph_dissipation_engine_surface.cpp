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

void SurfacePairs::find(BoundaryRows &rows, int nall, const std::function<int(int)> &body)
{
  struct Copy {
    int place, body;
  };
  std::vector<Copy> last(nall, {-1, -1});    // of each particle of the fluid
  index.assign(BLOCK, {-1, -1});
  row.clear();
  subset.begin();
  rows.candidate_copy.assign(rows.candidate.size(), 0);
  for (int m = 0; m < rows.size(); m++) {
    const int wall = rows.wall[m], number = body(wall);
    if (number < 0) continue;
    row.push_back(m);
    subset.rows.push_back(static_cast<int>(index.size()));
    subset.first.push_back(rows.first[m]);
    index.push_back({wall, wall});
    for (bigint k = rows.first[m]; k < rows.first[m + 1]; k++) {
      const int i = rows.candidate[k];
      if (i >= nall) break;    // a spare one
      if (last[i].body != number) {
        last[i] = {static_cast<int>(index.size()), number};
        index.push_back({i, wall});
      }
      rows.candidate_copy[k] = last[i].place;
    }
  }
  subset.count.resize(row.size());
  subset.slope.resize(rows.slope.size());
  if (row.empty()) rows.candidate_copy.clear();
  rows.copy.assign(row.empty() ? 0 : rows.fluid.size(), 0);
}

/* ---------------------------------------------------------------------- */

void SurfacePairs::begin(const BoundaryRows &rows, bool spins,
                         const std::function<void(int, int, Particle &, Spin &)> &copy)
{
  const std::size_t n = index.size();
  particle.resize(n);
  spin.resize(spins ? n : 0);
  std::fill_n(particle.begin(), BLOCK, Particle());
  std::fill_n(spin.begin(), spins ? BLOCK : 0, Spin());
  Spin none;
  for (std::size_t k = BLOCK; k < n; k++)
    copy(index[k].particle, index[k].wall, particle[k], spins ? spin[k] : none);
  for (std::size_t m = 0; m < row.size(); m++) subset.count[m] = rows.count[row[m]];
}

/* ----------------------------------------------------------------------
   a number of each copy, by value(index of the atom)
------------------------------------------------------------------------- */

template <class T, class Value>
void SurfacePairs::fill(std::vector<T> &values, const T &spare, Value &&value)
{
  values.resize(index.size());
  std::fill_n(values.begin(), BLOCK, spare);
  for (std::size_t k = BLOCK; k < index.size(); k++) values[k] = value(index[k].particle);
}

/* ---------------------------------------------------------------------- */

namespace {

// of copies, to that of the atoms

class TallyOfCopies : public PairTally {
 public:
  TallyOfCopies(PairTally *all, const std::function<int(int)> &atom_of) : all(all), atom_of(atom_of)
  {
  }
  void tally(int i, int j, const double *force_on_i, const double *rij) override
  {
    all->tally(atom_of(i), atom_of(j), force_on_i, rij);
  }

 private:
  PairTally *all;
  std::function<int(int)> atom_of;
};

}    // namespace

/* ---------------------------------------------------------------------- */

void Engine::accumulate_friction(SurfacePairs &some, BoundaryRows &rows, PairTally *tally,
                                 const StepNoise *of_step, int thread)
{
  const std::size_t n = some.index.size();
  some.force.assign(n, ForceSum());
  some.side.set(side.columns);
  some.side.resize(n);
  std::fill(some.side.rows.begin(), some.side.rows.end(), 0.0);
  if (some.empty()) return;

  some.fill(some.type, 1, [&](int i) {
    return atom->type[i];
  });
  some.weight.resize(n, 1.0);

  LoopData part = data;
  part.inum = static_cast<int>(some.subset.rows.size());
  part.ilist = some.subset.rows.data();
  part.first = some.subset.first.data();
  part.count = some.subset.count.data();
  part.neighbor = rows.copy.data();
  part.slope = some.subset.slope.data();
  part.particle = some.particle.data();
  part.spin = some.spin.data();
  part.spare = 0;
  part.excess = nullptr;
  part.type = some.type.data();
  part.weight = some.weight.data();
  part.force = some.force.data();
  part.side = some.side.rows.data();
  TallyOfCopies of_copies(tally, [&](int k) {
    return some.index[k].particle;
  });
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
  return bytes(side, index, row, force, particle, spin, weight, type, subset, tag, mobility, noise);
}
