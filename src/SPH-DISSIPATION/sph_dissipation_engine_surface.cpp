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

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

void SurfacePairs::set(const std::vector<SurfacePair> &unsorted, const std::vector<int> &number,
                       int n)
{
  std::vector<int> end(n + 1, 0);
  for (const SurfacePair &pair : unsorted) end[number[pair.wall] + 1]++;
  walls.clear();
  begin.clear();
  for (int k = 0; k < n; k++) {
    if (end[k + 1] > 0) begin.push_back(end[k]);
    end[k + 1] += end[k];
  }
  begin.push_back(static_cast<int>(unsorted.size()));
  pairs.resize(unsorted.size());
  for (const SurfacePair &pair : unsorted) pairs[end[number[pair.wall]]++] = pair;
  for (std::size_t row = 0; row + 1 < begin.size(); row++) walls.push_back(pairs[begin[row]].wall);
}

/* ----------------------------------------------------------------------
   a number of each particle of the rows and of the pairs, by value(index of the atom)
------------------------------------------------------------------------- */

template <class T, class Value> void SurfacePairs::fill(std::vector<T> &values, Value &&value)
{
  values.clear();
  for (const int w : walls) values.push_back(value(w));
  for (const SurfacePair &pair : pairs) values.push_back(value(pair.fluid));
}

/* ---------------------------------------------------------------------- */

void Engine::accumulate_friction(SurfacePairs &some, const StepNoise *of_step, int thread)
{
  const std::size_t nrow = some.rows(), spare = some.size(), n = spare + BLOCK;
  some.force.assign(n, ForceSum());
  some.side.set(side.columns);
  some.side.resize(n);
  std::fill(some.side.rows.begin(), some.side.rows.end(), 0.0);
  if (nrow == 0) return;

  some.fill(some.particle, [&](int i) {
    Particle one = particle[i];
    one.vol = atom->vfrac[i];    // pass 2 has none of a boundary particle
    one.g = one.u[0] = one.u[1] = one.u[2] = 0.0;
    return one;
  });
  some.fill(some.type, [&](int i) {
    return atom->type[i];
  });
  some.visit([&](const SurfacePair &pair, std::size_t k, std::size_t) {
    some.particle[k].vol = particle[pair.fluid].vol;
    for (int d = 0; d < 3; d++) some.particle[k].u[d] = pair.u[d];
  });
  some.particle.resize(n);
  some.type.resize(n, 1);
  some.weight.assign(n, 1.0);
  if (has_spin()) {
    some.spin.assign(n, Spin());
    some.visit([&](const SurfacePair &pair, std::size_t k, std::size_t) {
      for (int d = 0; d < 3; d++) some.spin[k].w[d] = pair.w[d];
    });
  }

  // the pairs of each row, with spare particles up to a whole block

  some.subset.begin();
  for (std::size_t k = 0; k < nrow; k++) {
    some.subset.add_row(static_cast<int>(k));
    for (int p = some.begin[k]; p < some.begin[k + 1]; p++)
      some.subset.add(static_cast<int>(nrow) + p, some.pairs[p].slope);
    some.subset.end_row(static_cast<int>(spare));
  }

  LoopData part = this->part(some.subset, static_cast<int>(spare));
  part.particle = some.particle.data();
  part.spin = some.spin.data();
  part.excess = nullptr;
  part.type = some.type.data();
  part.weight = some.weight.data();
  part.force = some.force.data();
  part.side = some.side.rows.data();
  if (!of_step || !of_step->surfaces.data) return force_loop(part);

  const NoiseData &of_all = *of_step->surfaces.data;
  NoiseData noise = of_all;
  some.fill(some.tag, [&](int i) {
    return of_all.tag[i];
  });
  some.tag.resize(n);
  noise.tag = some.tag.data();
  if (fixed->own_temperatures) {
    some.fill(some.row, [&](int i) {
      return of_all.row[i];
    });
    some.fill(some.mobility, [&](int i) {
      return of_all.mobility[i];
    });
    some.row.resize(n);
    some.mobility.resize(n);
    noise.row = some.row.data();
    noise.mobility = some.mobility.data();
  }
  part.noise = &noise;
  part.random = room_for_numbers(thread, part);
  loops->noisy_forces(of_step->surfaces.form)(part);
}

/* ---------------------------------------------------------------------- */

double SurfacePairs::memory_usage() const
{
  return bytes(side, pairs, walls, begin, force, particle, spin, weight, type, subset, tag,
               mobility, row);
}
