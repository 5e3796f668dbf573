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

#include "sph_dissipation_boundary_stage.h"

#include "atom.h"
#include "error.h"
#include "memory.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "sph_dissipation_boundary.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_vorticity.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

BoundaryStage::BoundaryStage(LAMMPS *lmp, Engine &engine, Exchange &exchange,
                             const FluidModel &model, const std::string &style) :
    Stage(lmp, engine, exchange),
    sum(nullptr), model(model), style(style), group_bits(0), rows_bits(0), nmax(0),
    vorticity(new VorticityStage(lmp, engine, exchange))
{
}

/* ---------------------------------------------------------------------- */

BoundaryStage::~BoundaryStage()
{
  memory->sfree(sum);
  delete vorticity;
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::add(Boundary *boundary)
{
  remove(boundary);
  boundaries.push_back(boundary);
  group_bits |= boundary->boundary_bit();
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::remove(Boundary *boundary)
{
  boundaries.erase(std::remove(boundaries.begin(), boundaries.end(), boundary), boundaries.end());
  group_bits = 0;
  for (const auto &one : boundaries) group_bits |= one->boundary_bit();
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::set_reference_volume()
{
  for (int i = 0; i < atom->nlocal + atom->nghost; i++) {
    if (!(atom->mask[i] & group_bits)) continue;
    atom->rho[i] = model.coeffs[atom->type[i]].eos.rho0;
    atom->drho[i] = 0.0;
    atom->vfrac[i] = engine.particle[i].vol = atom->rmass[i] / atom->rho[i];
  }
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::run(NeighList *list)
{
  if (nmax < atom->nmax) {
    nmax = atom->nmax;
    memory->sfree(sum);
    sum = (BoundarySum *) memory->smalloc(nmax * sizeof(BoundarySum), "sph:boundary_sum");
  }
  find_pairs(list);
  accumulate();
  const Field sums = field(sum, &sum->weight, offsetof(BoundarySum, w) / sizeof(double));
  if (engine.has_spin())
    exchange.reverse({sums, field(sum, sum->w, 3)});
  else
    exchange.reverse({sums});
  check();

  bool needs_vorticity = false;
  for (auto boundary : boundaries) {
    boundary->set_boundary(engine, sum);
    needs_vorticity = needs_vorticity || boundary->boundary_vorticity();
  }

  // ghost atoms of the fluid get what they have already; the weight is for the vorticity

  Particle *const particle = engine.particle;
  const Field state = field(particle, particle->u, 3),
              pressure = field(particle, &particle->vol, 2);
  const Field zeta_term = {engine.zeta_term, 1, 1}, weight = field(sum, &sum->weight, 1);
  if (engine.has_spin())
    exchange.forward({state, pressure, zeta_term, weight, field(engine.spin, engine.spin->w, 3)});
  else
    exchange.forward({state, pressure, zeta_term});
  if (!needs_vorticity || !engine.has_spin()) return;

  vorticity->run(list, group_bits, pairs, sum);
  for (auto boundary : boundaries)
    if (boundary->boundary_vorticity())
      boundary->set_boundary_spin(engine, sum, vorticity->vorticity);
  exchange.forward({field(engine.spin, engine.spin->w, 3)});
}

/* ----------------------------------------------------------------------
   a kernel that sees the nearest particles only, however large the support radius of the
   fluid: with as many particle spacings as a fluid has at least
------------------------------------------------------------------------- */

void BoundaryStage::set_near()
{
  constexpr double SPACINGS[] = {0.0, 4.0, 3.0, 2.5};    // by dimension
  const LoopData &all = engine.pairs();
  const int dim = engine.dimension();
  near.resize(atom->nlocal + atom->nghost);
  for (int i = 0; i < atom->nlocal + atom->nghost; i++) {
    if (!(atom->mask[i] & group_bits)) continue;
    const double vol = engine.particle[i].vol;
    const double radius = std::min(all.support, SPACINGS[dim] * pow(vol, 1.0 / dim));
    near[i].norm = vol * all.weight_norm * pow(all.support / radius, dim);
    near[i].scale = 1.0 / radius;
  }
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::find_pairs(NeighList *list)
{
  const int *const mask = atom->mask;
  if (neighbor->ago == 0 || group_bits != rows_bits) {
    rows_bits = group_bits;
    set_near();
    rows.clear();
    for (int ii = 0; ii < list->inum; ii++) {
      const int i = list->ilist[ii];
      const bool wall = mask[i] & group_bits;
      for (int jj = 0; jj < list->numneigh[i]; jj++)
        if (static_cast<bool>(mask[list->firstneigh[i][jj] & NEIGHMASK] & group_bits) != wall) {
          rows.push_back(ii);
          break;
        }
    }
  }

  pairs.clear();
  const LoopData &all = engine.pairs();
  for (const int ii : rows) {
    const int i = list->ilist[ii];
    const bool wall = mask[i] & group_bits;
    for (bigint entry = all.first[ii]; entry < all.first[ii] + all.count[ii]; entry++) {
      const int j = all.neighbor[entry];
      if (static_cast<bool>(mask[j] & group_bits) == wall) continue;
      pairs.push_back({wall ? j : i, wall ? i : j, entry, 0.0});
    }
  }
}

/* ----------------------------------------------------------------------
   sums of owned atoms and the contributions to ghost atoms
------------------------------------------------------------------------- */

void BoundaryStage::accumulate()
{
  memset(sum, 0, (atom->nlocal + atom->nghost) * sizeof(BoundarySum));
  const double *const rho = atom->rho;
  const bool has_spin = engine.has_spin();
  const LoopData &all = engine.pairs();

  with_kernel(engine.kernel_form(), [&](auto k) {
    for (auto &pair : pairs) {
      const Particle &f = engine.particle[pair.fluid];
      const Particle &w = engine.particle[pair.wall];
      double r[3], rsq = 0.0;
      for (int d = 0; d < 3; d++) {
        r[d] = w.x[d] - f.x[d];
        rsq += r[d] * r[d];
      }
      const double distance = sqrt(rsq);
      const double kernel_weight = all.weight_norm * k.shape(distance / all.support);
      const double weight = pair.weight = f.vol * kernel_weight;

      BoundarySum &total = sum[pair.wall];
      total.weight += weight;
      for (int d = 0; d < 3; d++) {
        total.u[d] += weight * f.u[d];
        total.r[d] += weight * r[d];
        if (has_spin) total.w[d] += weight * engine.spin[pair.fluid].w[d];
      }
      total.rho += weight * rho[pair.fluid];
      total.pressure += kernel_weight * f.g / f.vol;
      total.zeta_term += weight * engine.zeta_term[pair.fluid];
      sum[pair.fluid].weight += w.vol * kernel_weight;
      const NearKernel &wall = near[pair.wall];
      const double q = distance * wall.scale;
      if (q < 1.0) sum[pair.fluid].filled += wall.norm * k.shape(q);
    }
    return 0;
  });
}

/* ----------------------------------------------------------------------
   the near support of a fluid particle at a plane surface is half full of boundary particles,
   that of one in the corner of a box 7/8; more only inside.  A larger one would be as full
   in a pore as wide as the particle itself.
------------------------------------------------------------------------- */

void BoundaryStage::check() const
{
  constexpr double INSIDE = 0.9;
  for (int i = 0; i < atom->nlocal; i++)
    if (sum[i].filled > INSIDE && !(atom->mask[i] & group_bits))
      error->one(FLERR, "Particle {} of the fluid of pair style {} is inside a wall", atom->tag[i],
                 style);
}

/* ---------------------------------------------------------------------- */

double BoundaryStage::memory_usage() const
{
  return (double) nmax * sizeof(BoundarySum) + (double) pairs.capacity() * sizeof(BoundaryPair) +
      (double) rows.capacity() * sizeof(int) + vorticity->memory_usage();
}
