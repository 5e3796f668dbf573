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

// The part of the pair engine for boundaries: what the fluid near a wall hands to it.

#include "sph_dissipation_engine.h"

#include "atom.h"
#include "memory.h"
#include "neigh_list.h"
#include "neighbor.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ----------------------------------------------------------------------
   find the pairs of a fluid and a boundary particle, then sum over them
------------------------------------------------------------------------- */

void Engine::accumulate_boundary(NeighList *list, int bits)
{
  const int *const mask = atom->mask;
  const double *const rho = atom->rho;
  const bool has_spin = (shear == Shear::MICROPOLAR);

  if (neighbor->ago == 0 || bits != boundary_bits) {
    boundary_bits = bits;
    boundary_rows.clear();
    for (int ii = 0; ii < list->inum; ii++) {
      const int i = list->ilist[ii];
      const bool wall = mask[i] & bits;
      for (int jj = 0; jj < list->numneigh[i]; jj++)
        if (static_cast<bool>(mask[list->firstneigh[i][jj] & NEIGHMASK] & bits) != wall) {
          boundary_rows.push_back(ii);
          break;
        }
    }
  }

  boundary_pairs.clear();
  for (const int ii : boundary_rows) {
    const int i = list->ilist[ii];
    const bool wall = mask[i] & bits;
    for (bigint entry = first[ii]; entry < first[ii] + data.count[ii]; entry++) {
      const int j = data.neighbor[entry];
      if (static_cast<bool>(mask[j] & bits) == wall) continue;
      boundary_pairs.push_back({wall ? j : i, wall ? i : j, entry, 0.0});
    }
  }

  if (nmax_boundary < nmax) {
    nmax_boundary = nmax;
    memory->sfree(boundary_sum);
    boundary_sum = (BoundarySum *) memory->smalloc(nmax * sizeof(BoundarySum), "sph:boundary_sum");
  }
  memset(boundary_sum, 0, (atom->nlocal + atom->nghost) * sizeof(BoundarySum));

  with_kernel(kernel, [&](auto k) {
    for (auto &pair : boundary_pairs) {
      const Particle &f = particle[pair.fluid];
      const Particle &w = particle[pair.wall];
      double r[3], rsq = 0.0;
      for (int d = 0; d < 3; d++) {
        r[d] = w.x[d] - f.x[d];
        rsq += r[d] * r[d];
      }
      const double kernel_weight = data.weight_norm * k.shape(sqrt(rsq) / data.support);
      const double weight = pair.weight = f.vol * kernel_weight;
      const double weight_rho = weight * rho[pair.fluid];

      BoundarySum &total = boundary_sum[pair.wall];
      total.weight += weight;
      for (int d = 0; d < 3; d++) {
        total.u[d] += weight * f.u[d];
        total.rho_r[d] += weight_rho * r[d];
        if (has_spin) total.w[d] += weight * spin[pair.fluid].w[d];
      }
      total.rho += weight_rho;
      total.pressure += kernel_weight * f.g / f.vol;
      total.zeta_term += weight * zeta_term[pair.fluid];
      boundary_sum[pair.fluid].weight += w.vol * kernel_weight;
    }
    return 0;
  });
}

/* ---------------------------------------------------------------------- */

void Engine::update_boundary_velocity()
{
  for (const auto &pair : boundary_pairs) {
    const Particle &f = particle[pair.fluid];
    const Particle &w = particle[pair.wall];
    double approach = 0.0;
    for (int d = 0; d < 3; d++) approach += (f.x[d] - w.x[d]) * (f.u[d] - w.u[d]);
    data.approach[pair.entry] = approach;
  }
}

/* ---------------------------------------------------------------------- */

void Engine::accumulate_vorticity(NeighList *list)
{
  if (nmax_vorticity < nmax) {
    nmax_vorticity = nmax;
    memory->sfree(vorticity);
    vorticity = (double(*)[3]) memory->smalloc(nmax * sizeof(*vorticity), "sph:vorticity");
  }
  memset(vorticity, 0, (atom->nlocal + atom->nghost) * sizeof(*vorticity));

  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    const Particle &a = particle[i];
    for (bigint entry = first[ii]; entry < first[ii] + data.count[ii]; entry++) {
      const int j = data.neighbor[entry];
      const Particle &b = particle[j];
      double r[3], u[3];
      for (int d = 0; d < 3; d++) {
        r[d] = a.x[d] - b.x[d];
        u[d] = a.u[d] - b.u[d];
      }
      for (int d = 0; d < 3; d++) {
        const int e = (d + 1) % 3, g = (d + 2) % 3;
        const double curl = data.slope[entry] * (r[e] * u[g] - r[g] * u[e]);
        vorticity[i][d] += b.vol * curl;
        vorticity[j][d] += a.vol * curl;
      }
    }
  }
}

/* ---------------------------------------------------------------------- */

void Engine::accumulate_boundary_vorticity(int bits)
{
  for (int i = 0; i < atom->nlocal + atom->nghost; i++)
    if (atom->mask[i] & bits) vorticity[i][0] = vorticity[i][1] = vorticity[i][2] = 0.0;
  for (const auto &pair : boundary_pairs)
    for (int d = 0; d < 3; d++) vorticity[pair.wall][d] += pair.weight * vorticity[pair.fluid][d];
}
