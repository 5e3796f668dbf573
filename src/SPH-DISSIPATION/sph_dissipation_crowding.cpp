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

#include "sph_dissipation_crowding.h"

#include "atom.h"
#include "memory.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_shift_terms.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

CrowdingStage::CrowdingStage(LAMMPS *lmp, Engine &engine, Exchange &exchange) :
    Stage(lmp, engine, exchange), wanted(false), crowding(nullptr), nmax(0)
{
}

/* ---------------------------------------------------------------------- */

CrowdingStage::~CrowdingStage()
{
  memory->destroy(crowding);
}

/* ---------------------------------------------------------------------- */

void CrowdingStage::run()
{
  const int nall = atom->nlocal + atom->nghost;
  if (nmax < atom->nmax) {
    nmax = atom->nmax;
    memory->destroy(crowding);
    memory->create(crowding, nmax, 3, "sph:crowding");
  }
  std::fill_n(&crowding[0][0], 3 * (std::size_t) nall, 0.0);
  contact.resize(nall);

  const LoopData &pairs = engine.pairs();
  const int dim = engine.parameters().dim;
  with_kernel(engine.parameters().kernel, [&](auto k) {
    for (int i = 0; i < nall; i++)
      contact[i] =
          contact_inverse<decltype(k)>(dim, engine.parameters().support, engine.particle[i].vol);

    engine.visit_pairs([&](int i, int j, bigint entry) {
      const Particle &a = engine.particle[i], &b = engine.particle[j];
      double r[3], rsq = 0.0;
      for (int d = 0; d < 3; d++) {
        r[d] = a.x[d] - b.x[d];
        rsq += r[d] * r[d];
      }
      const double shape = k.shape(sqrt(rsq) / engine.parameters().support);
      const double push_i = b.vol * crowding_push(pairs.slope[entry], shape, contact[i]);
      const double push_j = a.vol * crowding_push(pairs.slope[entry], shape, contact[j]);
      for (int d = 0; d < 3; d++) {
        crowding[i][d] += push_i * r[d];
        crowding[j][d] -= push_j * r[d];
      }
    });
    return 0;
  });

  exchange.reverse({{&crowding[0][0], 3, 3}});
}

/* ---------------------------------------------------------------------- */

double CrowdingStage::memory_usage() const
{
  return (double) nmax * 3 * sizeof(double) + (double) contact.capacity() * sizeof(double);
}
