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
#include "neigh_list.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

CrowdingStage::CrowdingStage(LAMMPS *lmp, Engine &engine, Exchange &exchange) :
    Stage(lmp, engine, exchange), crowding(nullptr), nmax(0)
{
}

/* ---------------------------------------------------------------------- */

CrowdingStage::~CrowdingStage()
{
  memory->destroy(crowding);
}

/* ---------------------------------------------------------------------- */

void CrowdingStage::run(NeighList *list)
{
  constexpr double PAIRING = 0.2;
  const int nall = atom->nlocal + atom->nghost;
  if (nmax < atom->nmax) {
    nmax = atom->nmax;
    memory->destroy(crowding);
    memory->create(crowding, nmax, 3, "sph:crowding");
  }
  std::fill_n(&crowding[0][0], 3 * (std::size_t) nall, 0.0);
  contact.resize(nall);

  const LoopData &pairs = engine.pairs();
  const int dim = engine.dimension();
  with_kernel(engine.kernel_form(), [&](auto k) {
    for (int i = 0; i < nall; i++) {
      const double vol = engine.particle[i].vol;
      const double spacing = (dim == 1) ? vol : (dim == 2) ? sqrt(vol) : cbrt(vol);
      contact[i] = 1.0 / k.shape(std::min(spacing / pairs.support, 0.9));
    }

    for (int ii = 0; ii < list->inum; ii++) {
      const int i = list->ilist[ii];
      const Particle &a = engine.particle[i];
      for (bigint entry = pairs.first[ii]; entry < pairs.first[ii] + pairs.count[ii]; entry++) {
        const int j = pairs.neighbor[entry];
        const Particle &b = engine.particle[j];
        double r[3], rsq = 0.0;
        for (int d = 0; d < 3; d++) {
          r[d] = a.x[d] - b.x[d];
          rsq += r[d] * r[d];
        }
        const double shape = k.shape(sqrt(rsq) / pairs.support);
        auto push = [&](int n) {
          const double close = shape * contact[n] * shape * contact[n];
          return pairs.slope[entry] * (1.0 + PAIRING * close * close);
        };
        const double push_i = b.vol * push(i), push_j = a.vol * push(j);
        for (int d = 0; d < 3; d++) {
          crowding[i][d] += push_i * r[d];
          crowding[j][d] -= push_j * r[d];
        }
      }
    }
    return 0;
  });

  exchange.reverse({{&crowding[0][0], 3, 3}});
}

/* ---------------------------------------------------------------------- */

double CrowdingStage::memory_usage() const
{
  return (double) nmax * 3 * sizeof(double) + (double) contact.capacity() * sizeof(double);
}
