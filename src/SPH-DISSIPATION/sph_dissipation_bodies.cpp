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
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_wall_terms.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <set>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// Places of the sums over the particles of a body

enum {
  MASS,
  PLACE,
  MOMENTUM = PLACE + 3,
  ANGULAR = MOMENTUM + 3,
  SECOND = ANGULAR + 3,
  NSUM = SECOND + 6
};

/* ----------------------------------------------------------------------
   Find the bodies, in the order of their molecules, on all processors.
------------------------------------------------------------------------- */

void Bodies::init(bool by_molecule_in, bool lagging_in)
{
  by_molecule = by_molecule_in;
  lagging = lagging_in;
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
  if (!by_molecule) return 0;
  const auto found = number.find(atom->molecule[i]);
  if (found == number.end())
    error->one(FLERR, Error::NOLASTLINE,
               "Fix {} {}: molecule {} of particle {} was no body when the run began; bodies must "
               "be there at the start of a run",
               id, owner, atom->molecule[i], atom->tag[i]);
  return found->second;
}

/* ----------------------------------------------------------------------
   Find center, velocity, and inertia of all bodies.  The sums are about the last known center: so sums lose no digits.
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
    find_axes(body);
  }
}

/* ----------------------------------------------------------------------
   Find the principal axes and moments.  The moment about an axis without inertia is 0, as for a line or a point.
------------------------------------------------------------------------- */

void Bodies::find_axes(Body &body) const
{
  constexpr double NOTHING = 1.0e-7;    // of the largest moment of inertia
  const double *const I = body.inertia;
  double moment[3] = {0.0, 0.0, I[2]}, columns[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  if (domain->dimension == 3) {
    const double tensor[3][3] = {{I[0], I[3], I[4]}, {I[3], I[1], I[5]}, {I[4], I[5], I[2]}};
    MathEigen::jacobi3(tensor, moment, columns);
  }
  const double most = std::max({moment[0], moment[1], moment[2]});
  for (int k = 0; k < 3; k++) {
    body.moment[k] = (moment[k] > NOTHING * most) ? moment[k] : 0.0;
    for (int d = 0; d < 3; d++) body.axis[k][d] = columns[d][k];
  }
}

/* ----------------------------------------------------------------------
   turn_along(): find omega = I^-1 L along the principal axes.  from_axes(): find omega along x, y, z.  set_acting(): set the
   acting velocity and omega.  rotation_by(): find the rotation matrix for a time.
------------------------------------------------------------------------- */

static void turn_along(const Bodies::Body &body, const double *angular, double *rate)
{
  for (int k = 0; k < 3; k++)
    rate[k] = (body.moment[k] > 0.0) ? inner_product(body.axis[k], angular) / body.moment[k] : 0.0;
}

static void from_axes(const Bodies::Body &body, const double *rate, double *omega)
{
  for (int d = 0; d < 3; d++)
    omega[d] = rate[0] * body.axis[0][d] + rate[1] * body.axis[1][d] + rate[2] * body.axis[2][d];
}

static void set_acting(Bodies::Body &body, const double *v, const double *angular)
{
  double rate[3];
  turn_along(body, angular, rate);
  from_axes(body, rate, body.omega);
  if (v != body.v) std::copy_n(v, 3, body.v);
}

static void rotation_by(const double *omega, double time, double rotation[3][3])
{
  const double rate = MathExtra::len3(omega), angle = rate * time;
  const double s = sin(angle), c = 1.0 - cos(angle);
  double axis[3] = {0.0, 0.0, 0.0};
  for (int d = 0; d < 3 && rate > 0.0; d++) axis[d] = omega[d] / rate;
  const double cross[3][3] = {
      {0.0, -axis[2], axis[1]}, {axis[2], 0.0, -axis[0]}, {-axis[1], axis[0], 0.0}};
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++)
      rotation[a][b] = (a == b ? 1.0 - c : 0.0) + s * cross[a][b] + c * axis[a] * axis[b];
}

/* ---------------------------------------------------------------------- */

void Bodies::velocity_at(int i, double *v) const
{
  const Body &body = bodies[of(i)];
  velocity_of(i, body.v, body.omega, v);
}

void Bodies::velocity_of(int i, const double *center, const double *omega, double *v) const
{
  double r[3];
  domain->unmap(atom->x[i], atom->image[i], r);
  for (int d = 0; d < 3; d++) r[d] -= bodies[of(i)].x[d];
  cross_product(omega, r, v);
  for (int d = 0; d < 3; d++) v[d] += center[d];
}

/* ---------------------------------------------------------------------- */

bool Bodies::start(bool keep)
{
  constexpr double ROUNDOFF = 1.0e-12;
  if (!begun) sum(atom->v);    // finds the centers for the next sums
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
   Find the motion of a step.  The rotation has the angular velocity in the middle of the step.  If lagging, the fix adds the
   torques to an angular momentum that belongs to the orientation in the middle: turn this momentum back by half a step.  The
   forces of other styles are the rate of momentum in the first half of the step, less the forces of the pair style.
------------------------------------------------------------------------- */

void Bodies::advance(double extrapolation)
{
  const std::vector<Body> before = bodies;
  const double dt = update->dt, rate = (dt > 0.0) ? 2.0 / dt : 0.0;
  sum(atom->v);
  for (Body &body : bodies) {
    set_acting(body, body.v, body.angular);
    rotation_by(body.omega, dt, body.rotation);
  }
  if (neighbor->ago == 0 || update->ntimestep == update->firststep + 1) check(atom->v);

  for (int k = 0; k < size(); k++) {
    Body &body = bodies[k];
    std::copy_n(body.v, 3, body.v_middle);
    std::copy_n(body.angular, 3, body.angular_middle);
    if (lagging) {
      double back[3][3];
      rotation_by(body.omega, -0.5 * dt, back);
      MathExtra::matvec(back, body.angular, body.angular_middle);
    }
    body.rest =
        rest_between(before[k], body.v_end, body.angular_end, body.v_middle, body.angular_middle);
    double v[3], angular[3];
    for (int d = 0; d < 3; d++) {
      const double dv = body.v_middle[d] - body.v_end[d];
      const double turn = body.angular_middle[d] - body.angular_end[d];
      body.others[0][d] = rate * body.mass * dv - body.own[0][d];
      body.others[1][d] = rate * turn - body.own[1][d];
      v[d] = body.v_middle[d] + extrapolation * dv;
      angular[d] = body.angular_middle[d] + extrapolation * turn;
    }
    set_acting(body, v, angular);
  }
}

/* ---------------------------------------------------------------------- */

void Bodies::end_step()
{
  const std::vector<Body> acting = bodies;
  sum(atom->v);
  for (int k = 0; k < size(); k++) {
    std::copy_n(bodies[k].v, 3, bodies[k].v_end);
    std::copy_n(bodies[k].angular, 3, bodies[k].angular_end);
    std::copy_n(acting[k].v, 3, bodies[k].v);
  }
}

/* ---------------------------------------------------------------------- */

void Bodies::note_forces(const ForceSum *forces)
{
  std::vector<double> all(WIDTH * bodies.size(), 0.0);
  sum_forces(
      [=](int i) {
        return forces[i].f;
      },
      all.data());
  MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, world);
  for (int k = 0; k < size(); k++) {
    Body &body = bodies[k];
    std::copy_n(&all[WIDTH * k], WIDTH, body.own[0]);
    body.rest =
        rest_between(body, body.v_middle, body.angular_middle, body.v_end, body.angular_end);
  }
}

void Bodies::sum_forces(const std::function<const double *(int)> &force, double *sums) const
{
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const int k = of(i);
    double r[3], torque[3];
    domain->unmap(atom->x[i], atom->image[i], r);
    for (int d = 0; d < 3; d++) r[d] -= bodies[k].x[d];
    const double *const f = force(i);
    cross_product(r, f, torque);
    for (int d = 0; d < 3; d++) {
      sums[WIDTH * k + d] += f[d];
      sums[WIDTH * k + 3 + d] += torque[d];
    }
  }
}

/* ----------------------------------------------------------------------
   Return the missing heat of a body, see rest_of_heat(), for half a kick from velocity v to velocity v_after.
------------------------------------------------------------------------- */

double Bodies::rest_between(const Body &body, const double *v, const double *angular,
                            const double *v_after, const double *angular_after) const
{
  double mean[3], rate[3], omega[3], power = 0.0;
  for (int d = 0; d < 3; d++) mean[d] = 0.5 * (angular[d] + angular_after[d]);
  turn_along(body, mean, rate);
  from_axes(body, rate, omega);
  for (int d = 0; d < 3; d++)
    power += body.own[0][d] * (body.v[d] - 0.5 * (v[d] + v_after[d])) +
        body.own[1][d] * (body.omega[d] - omega[d]);
  return 0.5 * update->dt * power;
}

double Bodies::rest_of_heat(int i) const
{
  const Body &body = bodies[of(i)];
  return body.rest * atom->rmass[i] / body.mass;
}

/* ---------------------------------------------------------------------- */

void Bodies::append(bool starts, RigidRows &rows) const
{
  for (const Body &body : bodies) {
    double before[WIDTH], guess[WIDTH], others[WIDTH];
    std::copy_n(starts ? body.v_end : body.v_middle, 3, before);
    turn_along(body, starts ? body.angular_end : body.angular_middle, before + 3);
    std::copy_n(body.v, 3, guess);
    std::copy_n(body.others[0], 3, others);
    for (int k = 0; k < 3; k++) {
      guess[3 + k] = inner_product(body.axis[k], body.omega);
      others[3 + k] = inner_product(body.axis[k], body.others[1]);
    }
    for (int k = 0; k < WIDTH; k++) {
      rows.mass.push_back((k < 3) ? body.mass : body.moment[k - 3]);
      rows.before.push_back(before[k]);
      rows.guess.push_back(starts ? before[k] : guess[k]);
      rows.others.push_back(starts ? 0.0 : others[k]);
    }
  }
}

/* ---------------------------------------------------------------------- */

void Bodies::velocities(const double *rows,
                        const std::function<void(int, const double *)> &function) const
{
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const int k = of(i);
    double omega[3], v[3];
    from_axes(bodies[k], rows + WIDTH * k + 3, omega);
    velocity_of(i, rows + WIDTH * k, omega, v);
    function(i, v);
  }
}

void Bodies::add_forces(const std::function<const double *(int)> &force, double *rows) const
{
  std::vector<double> sums(WIDTH * bodies.size(), 0.0);
  sum_forces(force, sums.data());
  for (int k = 0; k < size(); k++) {
    const double *const own = &sums[WIDTH * k];
    for (int d = 0; d < 3; d++) {
      rows[WIDTH * k + d] += own[d];
      rows[WIDTH * k + 3 + d] += inner_product(bodies[k].axis[d], own + 3);
    }
  }
}

void Bodies::act(const double *rows)
{
  for (int k = 0; k < size(); k++) {
    std::copy_n(rows + WIDTH * k, 3, bodies[k].v);
    from_axes(bodies[k], rows + WIDTH * k + 3, bodies[k].omega);
  }
}

/* ---------------------------------------------------------------------- */

double Bodies::least_moment(int k) const
{
  double least = 0.0;
  for (const double moment : bodies[k].moment)
    if (moment > 0.0 && !(least > 0.0 && least < moment)) least = moment;
  return least;
}

void Bodies::accelerate(const double *forces,
                        const std::function<void(int, const double *)> &function) const
{
  std::vector<double> rows(WIDTH * bodies.size());
  for (int k = 0; k < size(); k++) {
    for (int d = 0; d < 3; d++) rows[WIDTH * k + d] = forces[WIDTH * k + d] / bodies[k].mass;
    turn_along(bodies[k], forces + WIDTH * k + 3, &rows[WIDTH * k + 3]);
  }
  velocities(rows.data(), function);    // a rigid field, of accelerations here
}

/* ---------------------------------------------------------------------- */

void Bodies::check(double **velocity) const
{
  constexpr double MOST = 1.0e-8;
  double mine[2] = {0.0, 0.0}, all[2];    // largest squared difference, velocity
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
