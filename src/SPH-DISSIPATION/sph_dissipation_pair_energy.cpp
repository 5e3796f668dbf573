/* -----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#include "sph_dissipation_pair_energy.h"

#include "atom.h"
#include "math_extra.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_kernel.h"
#include "sph_dissipation_particle_terms.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

bool PairEnergyStage::active() const
{
  const Parameters &par = engine.parameters();
  return !par.pair_energy.empty() || !par.cohesion.empty();
}

void PairEnergyStage::forget()
{
  pairs.clear();
  energies.clear();
}

void PairEnergyStage::find_pairs(NeighList *list, const PairEnergyKernel &kernel)
{
  const Parameters &par = engine.parameters();
  const ParticleRows &particles = engine.rows();
  const int *const type = atom->type;
  energies = par.pair_energy;
  pairs.clear();
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    const double *const with = &energies[type[i] * par.ntypes_1];
    const double w_i = particles.reference_volume(i);
    for (int jj = 0; jj < list->numneigh[i]; jj++) {
      const int j = list->firstneigh[i][jj] & NEIGHMASK;
      if (with[type[j]] == 0.0) continue;
      const double w_j = particles.reference_volume(j);
      pairs.push_back({i, j,
                       with[type[j]] * w_i * w_j *
                           kernel.of_rows(spacing_of(par.dim, w_i), spacing_of(par.dim, w_j))});
    }
  }
}

template <class Function>
void PairEnergyStage::visit(std::size_t from, std::size_t to, Function &&function) const
{
  const Particle *const particle = engine.particle;
  const double support_sq = engine.parameters().support * engine.parameters().support;
  for (std::size_t m = from; m < to; m++) {
    const UnlikePair &pair = pairs[m];
    double r[3];
    MathExtra::sub3(particle[pair.i].x, particle[pair.j].x, r);
    const double rsq = MathExtra::lensq3(r);
    if (rsq < support_sq) function(pair, r, rsq);
  }
}

/* ---------------------------------------------------------------------- */

void PairEnergyStage::run(NeighList *list, PairTally *tally)
{
  if (engine.parameters().pair_energy.empty()) return forget();
  const PairEnergyKernel kernel(engine.parameters().dim, engine.parameters().support);
  if (neighbor->ago == 0 || energies != engine.parameters().pair_energy) find_pairs(list, kernel);

  auto add = [&](std::size_t from, std::size_t to, ForceSum *force) {
    visit(from, to, [&](const UnlikePair &pair, const double *r, double rsq) {
      const double central = pair.energy * kernel.slope(rsq);
      double push[3];
      for (int d = 0; d < 3; d++) {
        push[d] = central * r[d];
        force[pair.i].f[d] += push[d];
        force[pair.j].f[d] -= push[d];
      }
      if (tally) tally->tally(pair.i, pair.j, push, r);
    });
  };

  const std::size_t number = pairs.size();
  Threads &team = engine.team();
  if (tally || team.size() == 1) return add(0, number, engine.force);
  sums.run(team, engine.force, atom->nlocal + atom->nghost, [&](int k, ForceSum *sum) {
    const int parts = team.size();
    add(number * k / parts, number * (k + 1) / parts, sum);
  });
}

double PairEnergyStage::energy(double *each_atom, int groupbit) const
{
  const Parameters &par = engine.parameters();
  const int *const mask = atom->mask;
  const int n = nforce();
  double total = 0.0;
  const auto add = [&](int i, int j, double energy) {
    const double half = 0.5 * energy;
    for (const int one : {i, j}) {
      if (one >= n || !(mask[one] & groupbit)) continue;
      total += half;
      if (each_atom) each_atom[one] += half;
    }
  };
  const PairEnergyKernel kernel(par.dim, par.support);
  visit(0, pairs.size(), [&](const UnlikePair &pair, const double *, double rsq) {
    add(pair.i, pair.j, pair.energy * kernel.weight(rsq));
  });
  if (par.cohesion.empty()) return total;
  const CohesionKernel cohesion(par.dim, par.support);
  engine.visit_pairs([&](int i, int j, bigint) {
    const double a = engine.strength[i] * engine.strength[j];
    const double rsq = MathExtra::distsq3(engine.particle[i].x, engine.particle[j].x);
    if (a > 0.0) add(i, j, a * cohesion.weight(sqrt(rsq)));
  });
  return total;
}
