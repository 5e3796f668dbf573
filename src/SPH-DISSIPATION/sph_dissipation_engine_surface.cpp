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

void SurfacePairs::begin(bool spins)
{
  index.assign(BLOCK, {-1, -1});
  particle.assign(BLOCK, Particle());
  spin.assign(spins ? BLOCK : 0, Spin());
  subset.begin();
}

void SurfacePairs::end()
{
  if (!subset.rows.empty()) subset.end_row(0);
}

void SurfacePairs::start(int wall, const Particle &one)
{
  end();
  subset.add_row(static_cast<int>(index.size()));
  index.push_back({-1, wall});
  particle.push_back(one);
  if (!spin.empty()) spin.push_back(Spin());
}

void SurfacePairs::add(int fluid, const Particle &one, const Spin &spin_of, double slope)
{
  subset.add(static_cast<int>(index.size()), slope);
  index.push_back({fluid, index.back().wall});
  particle.push_back(one);
  if (!spin.empty()) spin.push_back(spin_of);
}

/* ----------------------------------------------------------------------
   a number of each particle, by value(index of the atom)
------------------------------------------------------------------------- */

template <class T, class Value>
void SurfacePairs::fill(std::vector<T> &values, const T &spare, Value &&value)
{
  values.resize(index.size());
  std::fill_n(values.begin(), BLOCK, spare);
  for (std::size_t k = BLOCK; k < index.size(); k++)
    values[k] = value((index[k].fluid < 0) ? index[k].wall : index[k].fluid);
}

/* ---------------------------------------------------------------------- */

void Engine::accumulate_friction(SurfacePairs &some, const StepNoise *of_step, int thread)
{
  const std::size_t n = some.index.size();
  some.force.assign(n, ForceSum());
  some.side.set(side.columns);
  some.side.resize(n);
  std::fill(some.side.rows.begin(), some.side.rows.end(), 0.0);
  if (some.subset.rows.empty()) return;

  some.fill(some.type, 1, [&](int i) {
    return atom->type[i];
  });
  some.weight.resize(n, 1.0);

  LoopData part = this->part(some.subset, 0);
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
  some.fill(some.tag, 0.0, [&](int i) {
    return of_all.tag[i];
  });
  noise.tag = some.tag.data();
  if (fixed->own_temperatures) {
    some.fill(some.row, NoiseRow(), [&](int i) {
      return of_all.row[i];
    });
    some.fill(some.mobility, 0.0, [&](int i) {
      return of_all.mobility[i];
    });
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
  return bytes(side, index, force, particle, spin, weight, type, subset, tag, mobility, row);
}
