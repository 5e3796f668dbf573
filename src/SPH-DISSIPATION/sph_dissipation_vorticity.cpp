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

#include "sph_dissipation_vorticity.h"

#include "atom.h"
#include "domain.h"
#include "math_extra.h"
#include "memory.h"
#include "neigh_list.h"
#include "sph_dissipation_boundary.h"
#include "sph_dissipation_boundary_stage.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"

#include <cstring>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

enum : char { INTERIOR, EDGE, BOUNDARY };    // place

/* ---------------------------------------------------------------------- */

VorticityStage::VorticityStage(LAMMPS *lmp, Engine &engine, Exchange &exchange) :
    Stage(lmp, engine, exchange), vorticity(nullptr), gradient(nullptr), nmax(0)
{
}

/* ---------------------------------------------------------------------- */

VorticityStage::~VorticityStage()
{
  memory->destroy(vorticity);
  memory->sfree(gradient);
}

/* ---------------------------------------------------------------------- */

void VorticityStage::run(NeighList *list, int bits, const std::vector<BoundaryPair> &pairs,
                         const BoundarySum *sum)
{
  if (nmax < atom->nmax) {
    nmax = atom->nmax;
    memory->sfree(gradient);
    memory->destroy(vorticity);
    gradient = (GradientSum *) memory->smalloc(nmax * sizeof(GradientSum), "sph:gradient");
    memory->create(vorticity, nmax, 3, "sph:vorticity");
  }

  // the gradient is wanted where there are boundary particles in the support

  const int nall = atom->nlocal + atom->nghost;
  place.resize(nall);
  for (int i = 0; i < nall; i++)
    place[i] = (atom->mask[i] & bits) ? BOUNDARY : (sum[i].weight > 0.0) ? EDGE : INTERIOR;

  accumulate_gradient(list);
  exchange.reverse(
      {field(gradient, &gradient->rr[0][0], 9), field(gradient, &gradient->ru[0][0], 9)});
  solve();
  const Field values = {&vorticity[0][0], 3, 3};
  exchange.forward({values});

  for (int i = 0; i < nall; i++)
    if (place[i] == BOUNDARY) vorticity[i][0] = vorticity[i][1] = vorticity[i][2] = 0.0;
  for (const auto &pair : pairs)
    for (int d = 0; d < 3; d++) vorticity[pair.wall][d] += pair.weight * vorticity[pair.fluid][d];
  exchange.reverse({values});
}

/* ---------------------------------------------------------------------- */

void VorticityStage::accumulate_gradient(NeighList *list)
{
  memset(gradient, 0, (atom->nlocal + atom->nghost) * sizeof(GradientSum));
  const LoopData &pairs = engine.pairs();

  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    if (place[i] == BOUNDARY) continue;
    for (bigint entry = pairs.first[ii]; entry < pairs.first[ii] + pairs.count[ii]; entry++) {
      const int j = pairs.neighbor[entry];
      if (place[j] == BOUNDARY || place[i] + place[j] == INTERIOR) continue;
      const Particle &a = engine.particle[i];
      const Particle &b = engine.particle[j];
      double r[3], u[3];
      for (int d = 0; d < 3; d++) {
        r[d] = a.x[d] - b.x[d];
        u[d] = a.u[d] - b.u[d];
      }
      auto add = [&](GradientSum &sum, double vol) {
        const double weight = vol * pairs.slope[entry];
        for (int d = 0; d < 3; d++) {
          const double weight_r = weight * r[d];
          for (int e = 0; e < 3; e++) {
            sum.rr[d][e] += weight_r * r[e];
            sum.ru[d][e] += weight_r * u[e];
          }
        }
      };
      if (place[i] == EDGE) add(gradient[i], b.vol);
      if (place[j] == EDGE) add(gradient[j], a.vol);
    }
  }
}

/* ----------------------------------------------------------------------
   vorticity of owned fluid atoms next to a boundary; zero elsewhere and if the
   fluid around lies in a plane or line
------------------------------------------------------------------------- */

void VorticityStage::solve()
{
  constexpr double SINGULAR = 1.0e-9;
  for (int i = 0; i < atom->nlocal; i++) {
    double *const curl = vorticity[i];
    curl[0] = curl[1] = curl[2] = 0.0;
    if (place[i] != EDGE) continue;
    double(*const rr)[3] = gradient[i].rr;
    if (domain->dimension == 2) rr[2][2] = 0.5 * (rr[0][0] + rr[1][1]);
    const double mean = (rr[0][0] + rr[1][1] + rr[2][2]) / 3.0;
    if (!(MathExtra::det3(rr) > SINGULAR * mean * mean * mean)) continue;
    double inverse[3][3], grad[3][3];    // grad[d][e] = derivative of u_e along d
    MathExtra::invert3(rr, inverse);
    MathExtra::times3(inverse, gradient[i].ru, grad);
    for (int d = 0; d < 3; d++) {
      const int e = (d + 1) % 3, g = (d + 2) % 3;
      curl[d] = grad[e][g] - grad[g][e];
    }
  }
}

/* ---------------------------------------------------------------------- */

double VorticityStage::memory_usage() const
{
  return (double) nmax * (sizeof(GradientSum) + 3 * sizeof(double)) + (double) place.capacity();
}
