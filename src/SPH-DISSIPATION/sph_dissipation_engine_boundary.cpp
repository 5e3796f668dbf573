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

// Further sums over the pairs that pass 1 has found: what the fluid near a wall hands to it, and
// where particles are crowded.

#include "sph_dissipation_engine.h"

#include "atom.h"
#include "domain.h"
#include "math_extra.h"
#include "memory.h"
#include "neigh_list.h"
#include "neighbor.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

enum : char { INTERIOR, EDGE, BOUNDARY };    // Engine::place

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

      BoundarySum &total = boundary_sum[pair.wall];
      total.weight += weight;
      for (int d = 0; d < 3; d++) {
        total.u[d] += weight * f.u[d];
        total.r[d] += weight * r[d];
        if (has_spin) total.w[d] += weight * spin[pair.fluid].w[d];
      }
      total.rho += weight * rho[pair.fluid];
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

void Engine::accumulate_gradient(NeighList *list, int bits)
{
  if (nmax_vorticity < nmax) {
    nmax_vorticity = nmax;
    memory->sfree(gradient);
    memory->sfree(vorticity);
    gradient = (GradientSum *) memory->smalloc(nmax * sizeof(GradientSum), "sph:gradient");
    vorticity = (double(*)[3]) memory->smalloc(nmax * sizeof(*vorticity), "sph:vorticity");
  }
  memset(gradient, 0, (atom->nlocal + atom->nghost) * sizeof(GradientSum));

  // the gradient is wanted where there are boundary particles in the support

  const int nall = atom->nlocal + atom->nghost;
  place.resize(nall);
  for (int i = 0; i < nall; i++)
    place[i] = (atom->mask[i] & bits) ? BOUNDARY : (boundary_sum[i].weight > 0.0) ? EDGE : INTERIOR;

  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    if (place[i] == BOUNDARY) continue;
    for (bigint entry = first[ii]; entry < first[ii] + data.count[ii]; entry++) {
      const int j = data.neighbor[entry];
      if (place[j] == BOUNDARY || place[i] + place[j] == INTERIOR) continue;
      const Particle &a = particle[i];
      const Particle &b = particle[j];
      double r[3], u[3];
      for (int d = 0; d < 3; d++) {
        r[d] = a.x[d] - b.x[d];
        u[d] = a.u[d] - b.u[d];
      }
      auto add = [&](GradientSum &sum, double vol) {
        const double weight = vol * data.slope[entry];
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

/* ---------------------------------------------------------------------- */

void Engine::solve_vorticity()
{
  constexpr double SINGULAR = 1.0e-9;
  for (int i = 0; i < atom->nlocal; i++) {
    double(&curl)[3] = vorticity[i];
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

void Engine::accumulate_boundary_vorticity(int bits)
{
  for (int i = 0; i < atom->nlocal + atom->nghost; i++)
    if (atom->mask[i] & bits) vorticity[i][0] = vorticity[i][1] = vorticity[i][2] = 0.0;
  for (const auto &pair : boundary_pairs)
    for (int d = 0; d < 3; d++) vorticity[pair.wall][d] += pair.weight * vorticity[pair.fluid][d];
}

/* ---------------------------------------------------------------------- */

void Engine::accumulate_crowding(NeighList *list)
{
  constexpr double PAIRING = 0.2;
  if (nmax_crowding < nmax) {
    nmax_crowding = nmax;
    memory->sfree(crowding);
    crowding = (double(*)[3]) memory->smalloc(nmax * sizeof(*crowding), "sph:crowding");
  }
  memset(crowding, 0, (atom->nlocal + atom->nghost) * sizeof(*crowding));

  const int nall = atom->nlocal + atom->nghost;
  contact.resize(nall);
  with_kernel(kernel, [&](auto k) {
    for (int i = 0; i < nall; i++) {
      const double vol = particle[i].vol;
      const double spacing = (dim == 1) ? vol : (dim == 2) ? sqrt(vol) : cbrt(vol);
      contact[i] = 1.0 / k.shape(std::min(spacing / data.support, 0.9));
    }

    for (int ii = 0; ii < list->inum; ii++) {
      const int i = list->ilist[ii];
      const Particle &a = particle[i];
      for (bigint entry = first[ii]; entry < first[ii] + data.count[ii]; entry++) {
        const int j = data.neighbor[entry];
        const Particle &b = particle[j];
        double r[3], rsq = 0.0;
        for (int d = 0; d < 3; d++) {
          r[d] = a.x[d] - b.x[d];
          rsq += r[d] * r[d];
        }
        const double shape = k.shape(sqrt(rsq) / data.support);
        auto push = [&](int n) {
          const double close = shape * contact[n] * shape * contact[n];
          return data.slope[entry] * (1.0 + PAIRING * close * close);
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
}
