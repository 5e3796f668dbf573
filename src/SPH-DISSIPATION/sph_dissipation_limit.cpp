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

#include "sph_dissipation_limit.h"

#include "atom.h"
#include "memory.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

LimitStage::LimitStage(LAMMPS *lmp, Engine &engine, Exchange &exchange) :
    Stage(lmp, engine, exchange), bound(nullptr), nmax(0)
{
}

/* ---------------------------------------------------------------------- */

LimitStage::~LimitStage()
{
  memory->destroy(bound);
}

/* ---------------------------------------------------------------------- */

void LimitStage::run()
{
  if (nmax < atom->nmax) {
    nmax = atom->nmax;
    memory->destroy(bound);
    memory->create(bound, nmax, "sph:bound");
  }
  std::fill_n(bound, atom->nlocal + atom->nghost, 0.0);

  const LoopData &pairs = engine.pairs();
  const Particle *const particle = engine.particle;
  const int *const type = atom->type;
  const Parameters &par = engine.parameters();

  engine.visit_pairs([&](int i, int j, bigint entry) {
    double rsq = 0.0;
    for (int d = 0; d < 3; d++) {
      const double del = particle[i].x[d] - particle[j].x[d];
      rsq += del * del;
    }
    if (rsq == 0.0) return;
    const PairCoeff &c = par.pair[type[i] * par.ntypes_1 + type[j]];
    const double pair = bound_of_pair(par.shear, c, pairs.slope[entry], rsq);
    const double ratio = particle[i].vol * engine.weight(j) / (particle[j].vol * engine.weight(i));
    bound[i] += ratio * ratio * particle[j].vol * pair;
    bound[j] += particle[i].vol * pair / (ratio * ratio);
  });

  exchange.reverse({{bound, 1, 1}});
  exchange.forward({{bound, 1, 1}});
}

/* ---------------------------------------------------------------------- */

double LimitStage::memory_usage() const
{
  return (double) nmax * sizeof(double);
}
