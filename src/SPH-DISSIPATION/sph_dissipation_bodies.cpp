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

#include "sph_dissipation_bodies.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "math_eigen.h"
#include "math_extra.h"
#include "neighbor.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_wall_terms.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <set>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// sums over the particles of a body

enum {
  MASS,
  PLACE,
  MOMENTUM = PLACE + 3,
  ANGULAR = MOMENTUM + 3,
  SECOND = ANGULAR + 3,
  NSUM = SECOND + 6
};

/* ----------------------------------------------------------------------
   bodies in the order of their molecules, on all processors
------------------------------------------------------------------------- */

void Bodies::init(bool by_molecule_in)
{
  by_molecule = by_molecule_in;
  std::set<tagint> found;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) found.insert(by_molecule ? atom->molecule[i] : 1);
  std::vector<tagint> all =
      gather_all(world, std::vector<tagint>(found.begin(), found.end()), MPI_LMP_TAGINT);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  if (begun && all == names) return;
  begun = false;
  names = all;
  number.clear();
  for (std::size_t k = 0; k < names.size(); k++) number[names[k]] = static_cast<int>(k);
  bodies.assign(names.size(), Body());
}

/* ---------------------------------------------------------------------- */

int Bodies::of(int i) const
{
  return by_molecule ? number.at(atom->molecule[i]) : 0;
}

/* ----------------------------------------------------------------------
   Center, velocity, and inertia of all bodies.  Sums are about the last known center, so that they lose no digits.
------------------------------------------------------------------------- */

void Bodies::sum(double **velocity)
{
  const std::size_t n = bodies.size();
  std::vector<double> mine(n * NSUM, 0.0), all(n * NSUM);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const int k = of(i);
    double r[3], turn[3];
    domain->unmap(atom->x[i], atom->image[i], r);
    for (int d = 0; d < 3; d++) r[d] -= bodies[k].x[d];
    const double mass = atom->rmass[i], *const v = velocity[i];
    cross_product(r, v, turn);
    double *const own = &mine[k * NSUM];
    own[MASS] += mass;
    for (int d = 0; d < 3; d++) {
      own[PLACE + d] += mass * r[d];
      own[MOMENTUM + d] += mass * v[d];
      own[ANGULAR + d] += mass * turn[d];
      own[SECOND + d] += mass * r[d] * r[d];
    }
    own[SECOND + 3] += mass * r[0] * r[1];
    own[SECOND + 4] += mass * r[0] * r[2];
    own[SECOND + 5] += mass * r[1] * r[2];
  }
  MPI_Allreduce(mine.data(), all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, world);
  for (std::size_t k = 0; k < n; k++) {
    Body &body = bodies[k];
    const double *const own = &all[k * NSUM];
    const double mass = own[MASS], *const p = own + MOMENTUM, *const s = own + SECOND;
    double center[3], turn[3];
    for (int d = 0; d < 3; d++) {
      center[d] = own[PLACE + d] / mass;
      body.x[d] += center[d];
      body.v[d] = p[d] / mass;
    }
    cross_product(center, p, turn);
    for (int d = 0; d < 3; d++) body.angular[d] = own[ANGULAR + d] - turn[d];
    const double second[6] = {
        s[0] - mass * center[0] * center[0], s[1] - mass * center[1] * center[1],
        s[2] - mass * center[2] * center[2], s[3] - mass * center[0] * center[1],
        s[4] - mass * center[0] * center[2], s[5] - mass * center[1] * center[2]};
    const double trace = second[0] + second[1] + second[2];
    body.mass = mass;
    for (int d = 0; d < 3; d++) {
      body.inertia[d] = trace - second[d];
      body.inertia[3 + d] = -second[3 + d];
    }
  }
}

/* ----------------------------------------------------------------------
   Omega = I^-1 L, without the directions in which a line or a point has no inertia
------------------------------------------------------------------------- */

void Bodies::set_acting(Body &body, const double *v, const double *angular) const
{
  constexpr double NOTHING = 1.0e-7;    // of the largest moment of inertia
  const double angular_now[3] = {angular[0], angular[1], angular[2]};
  for (int d = 0; d < 3; d++) {
    body.v[d] = v[d];
    body.omega[d] = 0.0;
  }
  const double *const I = body.inertia;
  if (domain->dimension == 2) {
    if (I[2] > 0.0) body.omega[2] = angular_now[2] / I[2];
    return;
  }
  const double tensor[3][3] = {{I[0], I[3], I[4]}, {I[3], I[1], I[5]}, {I[4], I[5], I[2]}};
  double moment[3], axis[3][3];
  MathEigen::jacobi3(tensor, moment, axis);    // columns
  const double most = std::max({moment[0], moment[1], moment[2]});
  for (int k = 0; k < 3; k++) {
    if (!(moment[k] > NOTHING * most)) continue;
    double part = 0.0;
    for (int d = 0; d < 3; d++) part += axis[d][k] * angular_now[d];
    for (int d = 0; d < 3; d++) body.omega[d] += axis[d][k] * part / moment[k];
  }
}

/* ---------------------------------------------------------------------- */

void Bodies::velocity_at(int i, double *v) const
{
  const Body &body = bodies[of(i)];
  double r[3];
  domain->unmap(atom->x[i], atom->image[i], r);
  for (int d = 0; d < 3; d++) r[d] -= body.x[d];
  cross_product(body.omega, r, v);
  for (int d = 0; d < 3; d++) v[d] += body.v[d];
}

/* ---------------------------------------------------------------------- */

bool Bodies::start(bool keep)
{
  constexpr double ROUNDOFF = 1.0e-12;
  if (!begun) sum(atom->v);    // centers, about which the next sums are
  sum(atom->v);
  bool same = true;
  for (int k = 0; k < size(); k++) {
    Body &body = bodies[k];
    double before[6];
    std::copy_n(body.v_end, 3, before);
    std::copy_n(body.angular_end, 3, before + 3);
    const auto found = known.find(names[k]);
    const bool has_end = begun || found != known.end();
    if (!begun && found != known.end()) std::copy_n(found->second.begin(), 6, before);
    const double arm = sqrt((body.inertia[0] + body.inertia[1] + body.inertia[2]) / body.mass);
    double change = 0.0, scale = 0.0;
    for (int d = 0; d < 3; d++) {
      change = std::max({change, std::fabs(body.v[d] - before[d]),
                         std::fabs(body.angular[d] - before[3 + d]) / (body.mass * arm)});
      scale =
          std::max({scale, std::fabs(body.v[d]), std::fabs(body.angular[d]) / (body.mass * arm)});
    }
    if (!has_end || change > ROUNDOFF * scale) same = false;
    std::copy_n(body.v, 3, body.v_end);
    std::copy_n(body.angular, 3, body.angular_end);
  }
  known.clear();
  begun = true;
  if (keep && same) sum(atom->vest);
  for (Body &body : bodies) {
    set_acting(body, body.v, body.angular);
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < 3; b++) body.rotation[a][b] = (a == b) ? 1.0 : 0.0;
  }
  return same;
}

/* ----------------------------------------------------------------------
   The rotation of a step is that by the angular velocity in its middle.
------------------------------------------------------------------------- */

void Bodies::advance(bool extrapolate)
{
  sum(atom->v);
  for (Body &body : bodies) {
    double v[3], angular[3];
    std::copy_n(body.v, 3, v);
    std::copy_n(body.angular, 3, angular);
    set_acting(body, v, angular);
    const double rate = MathExtra::len3(body.omega), angle = rate * update->dt;
    const double s = sin(angle), c = 1.0 - cos(angle);
    double axis[3] = {0.0, 0.0, 0.0};
    for (int d = 0; d < 3 && rate > 0.0; d++) axis[d] = body.omega[d] / rate;
    const double cross[3][3] = {
        {0.0, -axis[2], axis[1]}, {axis[2], 0.0, -axis[0]}, {-axis[1], axis[0], 0.0}};
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < 3; b++)
        body.rotation[a][b] = (a == b ? 1.0 - c : 0.0) + s * cross[a][b] + c * axis[a] * axis[b];
  }
  if (neighbor->ago == 0 || update->ntimestep == update->firststep + 1) check(atom->v);
  if (!extrapolate) return;
  for (Body &body : bodies) {
    double v[3], angular[3];
    for (int d = 0; d < 3; d++) {
      v[d] = 2.0 * body.v[d] - body.v_end[d];
      angular[d] = 2.0 * body.angular[d] - body.angular_end[d];
    }
    set_acting(body, v, angular);
  }
}

/* ---------------------------------------------------------------------- */

void Bodies::end_step()
{
  std::vector<Body> acting = bodies;
  sum(atom->v);
  for (int k = 0; k < size(); k++) {
    std::copy_n(bodies[k].v, 3, bodies[k].v_end);
    std::copy_n(bodies[k].angular, 3, bodies[k].angular_end);
    std::copy_n(acting[k].v, 3, bodies[k].v);
    std::copy_n(acting[k].omega, 3, bodies[k].omega);
  }
}

/* ---------------------------------------------------------------------- */

void Bodies::check(double **velocity) const
{
  constexpr double MOST = 1.0e-8;
  double mine[2] = {0.0, 0.0}, all[2];    // squares
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    double v[3];
    velocity_at(i, v);
    mine[0] = std::max(mine[0], MathExtra::distsq3(v, velocity[i]));
    mine[1] = std::max(mine[1], MathExtra::lensq3(velocity[i]));
  }
  MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_MAX, world);
  if (all[0] > MOST * MOST * all[1])
    error->all(FLERR, Error::NOLASTLINE,
               "Fix {} {}: the particles of a body do not move as a rigid body; each body of the "
               "fix that moves them must be one {}, with image flags that make it one piece",
               id, owner, by_molecule ? "molecule" : "group of such a fix");
}

/* ---------------------------------------------------------------------- */

void Bodies::pack_restart(std::vector<double> &state) const
{
  for (int k = 0; k < size(); k++) {
    state.push_back(static_cast<double>(names[k]));
    state.insert(state.end(), bodies[k].v_end, bodies[k].v_end + 3);
    state.insert(state.end(), bodies[k].angular_end, bodies[k].angular_end + 3);
  }
}

void Bodies::restart(const double *state, int n)
{
  for (int k = 0; k < n; k++, state += NRESTART)
    known[static_cast<tagint>(state[0])] = std::vector<double>(state + 1, state + NRESTART);
}
