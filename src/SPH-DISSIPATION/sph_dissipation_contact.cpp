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

#include "sph_dissipation_contact.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "math_extra.h"
#include "neighbor.h"
#include "sph_dissipation_boundary_stage.h"
#include "sph_dissipation_cells.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_particle_terms.h"
#include "sph_dissipation_surface.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <map>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// Stiffness of a surface, pressure over depth, in rho0 c0^2 over the spacing

static constexpr double STIFFNESS = 4.0;

// Speed, in c0, below which restitution and friction fall to zero with the speed

static constexpr double SLOW = 1.0e-4;

// Largest distance at which a tangential plane acts, and the length that keeps the weight finite, in spacings

static constexpr double REACH = 1.5, SOFT = 0.5;

// Least depth, in spacings, of a particle below its tangential plane; a particle less deep belongs to an edge

static constexpr double FLAT = 0.4;

static constexpr int NROWS = 7;    // force, torque, heat of a body

/* ----------------------------------------------------------------------
   Return whether two bodies, or a body and a wall, have a law of contact: of two bodies the geometric mean of their laws.
------------------------------------------------------------------------- */

bool ContactStage::law_of(int body, int other, ContactLaw &law) const
{
  const ContactLaw *laws[2] = {nullptr, nullptr};
  const int numbers[2] = {body, other};
  for (int k = 0; k < 2; k++)
    if (numbers[k] > 0) laws[k] = bodies[numbers[k] - 1].owner->contact();
  if (!laws[0] && !laws[1]) return false;
  const ContactLaw &a = *(laws[0] ? laws[0] : laws[1]), &b = *(laws[1] ? laws[1] : laws[0]);
  law.restitution = sqrt(a.restitution * b.restitution);
  law.friction = sqrt(a.friction * b.friction);
  return true;
}

/* ---------------------------------------------------------------------- */

double ContactStage::volume(int i) const
{
  return engine.rows().reference_volume(i);
}

double ContactStage::spacing(int i) const
{
  return spacing_of(engine.constants().dim, volume(i));
}

// Return the distance at which a plane acts: less than the support by a spacing, since ghosts are as far as the support

double ContactStage::reach(double spacing) const
{
  return std::min(REACH * spacing, engine.constants().support - spacing);
}

// Return the part of the stiffness for balls of a body or wall: 1 for the finer of two.  With the same spacing, each of two
// bodies has 1/2; a wall has 0, since the surface of a wall is flatter than the surface of a body with edges.

double ContactStage::share(int body, double spacing, int other, double spacing_of_other)
{
  constexpr double SAME = 1.1;
  if (spacing * SAME < spacing_of_other) return 1.0;
  if (spacing > SAME * spacing_of_other) return 0.0;
  return (body == 0) ? 0.0 : (other == 0) ? 1.0 : 0.5;
}

bool ContactStage::is_ball(int i) const
{
  return MathExtra::lensq3(surface[i].normal) == 0.0;
}

/* ----------------------------------------------------------------------
   Find the bodies of all boundaries, in order; begin() sets stiffness and mobility.
------------------------------------------------------------------------- */

void ContactStage::find_bodies()
{
  bodies.clear();
  for (auto one : boundary.all()) {
    RigidMotions *const motions = one->rigid_motions();
    for (int k = 0; motions && k < motions->size(); k++)
      bodies.push_back({motions, k, one, 0.0, 0.0, 0.0, 0.0});
  }
}

/* ----------------------------------------------------------------------
   Set the largest stable time step, 2 over the frequency of a body with contacts on all of its surface, pressed from both
   sides by a body like itself.
------------------------------------------------------------------------- */

void ContactStage::begin()
{
  find_bodies();
  step = UNLIMITED_STEP;
  const auto n = static_cast<int>(bodies.size());
  const Parameters &par = engine.parameters();
  std::vector<int> members, owned;
  for (int i = 0; i < atom->nlocal + atom->nghost; i++)
    if (boundary.is_body(i)) {
      members.push_back(i);
      if (i < atom->nlocal) owned.push_back(i);
    }
  const Cells cells(atom->x, members, par.support);
  enum { STIFF, SQUARE, SPEED, NMOST };
  std::vector<double> most(NMOST * n, 0.0), area(n, 0.0);
  for (const int i : owned) {
    const int number = boundary.body(i);
    Body &body = bodies[number - 1];
    const EosParams &eos = par.type[atom->type[i]].eos;
    const double own = spacing(i);
    double r[3];
    domain->unmap(atom->x[i], atom->image[i], r);
    MathExtra::sub3(r, body.motions->center(body.place), r);
    double *const values = &most[NMOST * (number - 1)];
    values[STIFF] = std::max(values[STIFF], STIFFNESS * eos.rho0 * eos.c0 * eos.c0 / own);
    values[SQUARE] = std::max(values[SQUARE], MathExtra::lensq3(r));
    values[SPEED] = std::max(values[SPEED], eos.c0);
    const SurfacePlane plane(cells, atom->x[i], own, par.support, par.dim, [&](int j) {
      return (boundary.body(j) == number) ? volume(j) : 0.0;
    });
    if (plane.outer) area[number - 1] += whole_power(own, par.dim - 1);
  }
  MPI_Allreduce(MPI_IN_PLACE, most.data(), NMOST * n, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(MPI_IN_PLACE, area.data(), n, MPI_DOUBLE, MPI_SUM, world);
  for (int k = 0; k < n; k++) {
    Body &body = bodies[k];
    const double *const values = &most[NMOST * k];
    const double moment = body.motions->least_moment(body.place);
    body.stiffness = values[STIFF];
    body.slow = SLOW * values[SPEED];
    body.mobility =
        1.0 / body.motions->mass(body.place) + (moment > 0.0 ? values[SQUARE] / moment : 0.0);
    const double square = body.stiffness * area[k] * body.mobility;
    if (body.owner->contact() && square > 0.0) step = std::min(step, 2.0 / sqrt(square));
  }
}

/* ---------------------------------------------------------------------- */

void ContactStage::run()
{
  total_energy = 0.0;
  on_walls.assign(6 * boundary.all().size(), 0.0);
  if (neighbor->ago == 0) {
    if (update->setupflag) begin();
    find();
  } else if (active) {
    const bool before = (surface_step != update->ntimestep);
    for (auto one : boundary.all()) one->move_surface(boundary, surface.data(), before);
  }
  surface_step = update->ntimestep;
  if (!active) return;
  for (Pair &pair : pairs) find_overlap(pair);
  sum_elastic();
  add_forces();
  warn();
}

/* ----------------------------------------------------------------------
   With a new neighbor list, find the balls that may come below another surface before the next list, and the particles of
   that surface around them.
------------------------------------------------------------------------- */

void ContactStage::find()
{
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  const Parameters &par = engine.parameters();
  pairs.clear();
  near.clear();
  std::vector<int> members, owned, moving;
  double widest = 0.0;
  for (int i = 0; i < nall; i++) {
    if (!(atom->mask[i] & boundary.bits())) continue;
    members.push_back(i);
    if (boundary.is_body(i)) moving.push_back(i);
    widest = std::max(widest, spacing(i));
  }

  // owned particles that may be a ball, or a plane for a ball

  const auto range = [&](int i, int j) {
    const double a = spacing(i), b = spacing(j);
    return 0.5 * (a + b) + reach(std::max(a, b)) + neighbor->skin;
  };
  const double most = widest + reach(widest) + neighbor->skin;
  const Cells of_all(atom->x, members, most), of_bodies(atom->x, moving, most);
  ContactLaw law;
  for (int i = 0; i < nlocal; i++) {
    if (!(atom->mask[i] & boundary.bits())) continue;
    bool found = false;
    const Cells &others = boundary.is_body(i) ? of_all : of_bodies;
    others.near(atom->x[i], most, [&](int j, const double *, double rsq) {
      const int a = boundary.body(i), b = boundary.body(j);
      if (found || a == b) return;
      const double far = range(i, j);
      found = rsq < far * far && law_of(a, b, law);
    });
    if (found) owned.push_back(i);
  }
  active = over_all<int>(world, !owned.empty(), MPI_MAX);
  if (!active) return surface.clear();

  find_surfaces(of_all, owned);
  for (auto one : boundary.all()) one->move_surface(boundary, surface.data(), false);
  std::map<int, std::vector<int>> of_body;
  for (const int i : owned) {
    if (!(surface[i].spacing > 0.0)) continue;
    const int own = boundary.body(i);
    of_body.clear();
    of_all.near(atom->x[i], most, [&](int j, const double *, double rsq) {
      const double far = range(i, j);
      if (boundary.body(j) != own && surface[j].spacing > 0.0 && rsq < far * far)
        of_body[boundary.body(j)].push_back(j);
    });
    for (const auto &one : of_body) {
      Pair pair = {};
      pair.particle = i;
      pair.body = own;
      pair.other = one.first;
      if (!law_of(own, one.first, pair.law)) continue;
      pair.first = static_cast<int>(near.size());
      pair.number = static_cast<int>(one.second.size());
      near.insert(near.end(), one.second.begin(), one.second.end());
      double stiffness = HUGE_VAL;
      for (const int k : {own, one.first})
        if (k > 0) stiffness = std::min(stiffness, bodies[k - 1].stiffness);
      const double part =
          share(own, surface[i].spacing, one.first, surface[near[pair.first]].spacing);
      pair.stiffness = part * stiffness * whole_power(surface[i].spacing, par.dim - 1);
      if (part > 0.0) pairs.push_back(pair);
    }
  }
}

/* ----------------------------------------------------------------------
   Find normals and depths of the outer layers, on all sides.  All walls together are one arrangement.  A particle at an edge
   or a corner, or a particle without normal, as in a thin plate, is a ball.
------------------------------------------------------------------------- */

void ContactStage::find_surfaces(const Cells &cells, const std::vector<int> &owned)
{
  const Parameters &par = engine.parameters();
  const int nall = atom->nlocal + atom->nghost;
  surface.assign(nall, Surface());
  shift.assign(3 * static_cast<std::size_t>(nall), 0.0);
  for (const int i : owned) {
    Surface &s = surface[i];
    const double own = spacing(i);
    const int number = boundary.body(i);
    const SurfacePlane plane(cells, atom->x[i], own, par.support, par.dim, [&](int j) {
      return (boundary.body(j) == number) ? volume(j) : 0.0;
    });
    domain->unmap(atom->x[i], atom->image[i], &shift[3 * i]);
    if (!plane.outer) continue;
    const bool flat = plane.directed && plane.depth > FLAT * own;
    s.spacing = own;
    s.depth = flat ? plane.depth : 0.5 * own;
    for (int d = 0; d < 3 && flat; d++) s.normal[d] = -plane.inward[d] / plane.length;
  }
  Surface *const first = surface.data();
  exchange.forward({field(first, first->normal, 3),
                    field(first, &first->depth, 1),
                    field(first, &first->spacing, 1),
                    {shift.data(), 3, 3}},
                   boundary.bits());
  for (int i = 0; i < nall; i++)
    for (int d = 0; d < 3; d++) shift[3 * i + d] -= atom->x[i][d];
}

/* ----------------------------------------------------------------------
   Find how deep a particle, a ball with the diameter of a spacing, is below the other surface.  The distance from the surface
   is the mean of the distances from planes and balls of the surface, as in implicit moving least squares; R. Kolluri, Proc.
   SODA, 1008 (2005).  The weight falls with the eighth power of the distance: planes round a corner do not matter.
------------------------------------------------------------------------- */

void ContactStage::find_overlap(Pair &pair) const
{
  const int i = pair.particle;
  const double *const place = atom->x[i], ball = 0.5 * surface[i].spacing;
  double weights = 0.0, distance = 0.0, closest = HUGE_VAL;
  double slope[3] = {}, turn[3] = {}, along[3] = {};    // sums
  pair.overlap = 0.0;
  for (int m = pair.first; m < pair.first + pair.number; m++) {
    const int j = near[m];
    const Surface &plane = surface[j];
    const double radius = reach(plane.spacing), soft = SOFT * plane.spacing;
    double normal[3], q[3],
        above;    // q: from the point of the plane, or the nearest point of the ball
    MathExtra::sub3(place, atom->x[j], q);
    if (is_ball(j)) {
      const double length = MathExtra::len3(q);
      above = length - plane.depth;
      for (int d = 0; d < 3; d++) {
        normal[d] = (length > 0.0) ? q[d] / length : 0.0;
        q[d] = above * normal[d];
      }
    } else {
      std::copy_n(plane.normal, 3, normal);
      for (int d = 0; d < 3; d++) q[d] -= plane.depth * normal[d];
      above = MathExtra::dot3(normal, q);
    }
    const double rsq = MathExtra::lensq3(q), left = radius * radius - rsq;
    if (!(left > 0.0)) continue;
    const double part = left / (radius * radius), inverse = soft * soft / (rsq + soft * soft);
    const double weight = part * part * part * inverse * inverse * inverse * inverse;
    const double change = -6.0 / left - 8.0 / (rsq + soft * soft);    // of log(weight), along q
    weights += weight;
    distance += weight * above;
    for (int d = 0; d < 3; d++) {
      slope[d] += weight * normal[d];
      turn[d] += weight * change * q[d];
      along[d] += weight * change * q[d] * above;
    }
    if (rsq >= closest) continue;
    closest = rsq;
    pair.partner = j;
  }
  if (!(weights > 0.0)) return;
  const double mean = distance / weights;
  pair.overlap = std::max(ball - mean, 0.0);
  if (pair.overlap == 0.0) return;
  for (int d = 0; d < 3; d++) pair.normal[d] = (slope[d] + along[d] - mean * turn[d]) / weights;
  pair.slope = MathExtra::len3(pair.normal);
  for (int d = 0; d < 3; d++) {
    if (pair.slope > 0.0) pair.normal[d] /= pair.slope;
    pair.point[d] = place[d] - ball * pair.normal[d];
  }
  double other[3];
  velocity_at(pair.point, i, pair.u);
  velocity_at(pair.point, pair.partner, other);
  MathExtra::sub3(pair.u, other, pair.u);
}

/* ----------------------------------------------------------------------
   Find the velocity, at a point, of the body or wall of a particle.
------------------------------------------------------------------------- */

void ContactStage::velocity_at(const double *point, int i, double *u) const
{
  double r[3];
  MathExtra::sub3(point, atom->x[i], r);
  cross_product(surface[i].omega, r, u);
  for (int d = 0; d < 3; d++) u[d] += atom->vest[i][d];
}

/* ----------------------------------------------------------------------
   Sum the magnitudes of the elastic forces on each body.  These sums bound the coefficients of damping and friction: so
   damping and friction do not reverse the velocity of the body within a step.
------------------------------------------------------------------------- */

void ContactStage::sum_elastic()
{
  std::vector<double> sums(bodies.size(), 0.0);
  for (const Pair &pair : pairs) {
    const double elastic = pair.stiffness * pair.overlap * pair.slope;
    for (const int k : {pair.body, pair.other})
      if (k > 0) sums[k - 1] += elastic;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                world);
  for (std::size_t k = 0; k < bodies.size(); k++) bodies[k].force = sums[k];
}

/* ----------------------------------------------------------------------
   Add the forces.  While a ball leaves, the elastic force has the factor e^2, with the restitution e: so a contact gives back
   the part e^2 of the energy taken, whatever the masses and the shape of the contact.  Between slow speeds of approach and
   departure, the factor is linear in the speed.
------------------------------------------------------------------------- */

void ContactStage::add_forces()
{
  std::vector<double> rows(NROWS * bodies.size(), 0.0);
  const std::size_t nbody = rows.size();
  rows.resize(nbody + on_walls.size());
  const auto &boundaries = boundary.all();
  const double dt = update->dt;

  // add a force at a point to the body, or the wall, of a particle

  const auto push = [&](int number, int i, const double *force, const double *point, double heat) {
    double *row = nullptr, r[3], torque[3];
    for (int d = 0; d < 3; d++) r[d] = point[d] + shift[3 * i + d];
    if (number > 0) {
      const Body &body = bodies[number - 1];
      row = &rows[NROWS * (number - 1)];
      MathExtra::sub3(r, body.motions->center(body.place), r);
      row[6] += heat;
    } else
      for (std::size_t k = 0; k < boundaries.size() && !row; k++)
        if (atom->mask[i] & boundaries[k]->boundary_bit()) row = &rows[nbody + 6 * k];
    cross_product(r, force, torque);
    for (int d = 0; d < 3; d++) {
      row[d] += force[d];
      row[3 + d] += torque[d];
    }
  };

  for (const Pair &pair : pairs) {
    if (!(pair.overlap > 0.0)) continue;
    const double elastic = pair.stiffness * pair.overlap * pair.slope;
    total_energy += 0.5 * pair.stiffness * pair.overlap * pair.overlap;

    double slow = HUGE_VAL, stopping = 0.0;
    int nmoving = 0;
    for (const int k : {pair.body, pair.other}) {
      if (k == 0) continue;
      const Body &body = bodies[k - 1];
      slow = std::min(slow, body.slow);
      stopping += dt * body.force * body.mobility;
      nmoving++;
    }
    const double *const normal = pair.normal;
    const double leaving = MathExtra::dot3(normal, pair.u);
    const double lost = 0.5 * (1.0 - pair.law.restitution * pair.law.restitution);
    const double speed = std::max(-1.0, std::min(1.0, leaving / (slow + lost * stopping)));
    const double pressing = elastic * (1.0 - lost * (1.0 + speed));
    double force[3], sliding[3], minus[3];
    for (int d = 0; d < 3; d++) sliding[d] = pair.u[d] - leaving * normal[d];
    const double rate = MathExtra::len3(sliding);
    const double drag =
        pair.law.friction * pressing / std::max(rate, slow + pair.law.friction * stopping);
    for (int d = 0; d < 3; d++) {
      force[d] = pressing * normal[d] - drag * sliding[d];
      minus[d] = -force[d];
    }
    const double heat = -MathExtra::dot3(force, pair.u) / nmoving;
    push(pair.body, pair.particle, force, pair.point, heat);
    push(pair.other, pair.partner, minus, pair.point, heat);
  }

  MPI_Allreduce(MPI_IN_PLACE, rows.data(), static_cast<int>(rows.size()), MPI_DOUBLE, MPI_SUM,
                world);
  std::copy(rows.begin() + static_cast<std::ptrdiff_t>(nbody), rows.end(), on_walls.begin());
  std::size_t first = 0;    // body of a fix
  for (auto one : boundaries) {
    RigidMotions *const motions = one->rigid_motions();
    if (!motions) continue;
    std::vector<double> forces(RigidMotions::WIDTH * motions->size());
    for (int k = 0; k < motions->size(); k++)
      std::copy_n(&rows[NROWS * (first + k)], RigidMotions::WIDTH,
                  &forces[RigidMotions::WIDTH * k]);
    motions->accelerate(forces.data(), [&](int i, const double *a) {
      const int number = boundary.body(i);
      const Body &body = bodies[number - 1];
      for (int d = 0; d < 3; d++) atom->f[i][d] += atom->rmass[i] * a[d];
      atom->desph[i] +=
          rows[NROWS * (number - 1) + 6] * atom->rmass[i] / body.motions->mass(body.place);
    });
    first += motions->size();
  }
}

/* ----------------------------------------------------------------------
   Warn once of a deep overlap, at the start of a run or of a list: the balls of one body may already be inside of another.
------------------------------------------------------------------------- */

void ContactStage::warn()
{
  constexpr double DEEP = 0.5;
  if (warned || neighbor->ago != 0) return;
  double deepest = 0.0;
  for (const Pair &pair : pairs)
    deepest = std::max(deepest, pair.overlap / surface[pair.particle].spacing);
  deepest = over_all(world, deepest, MPI_MAX);
  warned = deepest > DEEP;
  if (warned && comm->me == 0)
    error->warning(FLERR,
                   "Pair style {}: two bodies, or a body and a wall, overlap by {:.2g} spacings in "
                   "step {}; move them apart, or use a larger c0",
                   style, deepest, update->ntimestep);
}

/* ---------------------------------------------------------------------- */

double ContactStage::energy(double *each_atom) const
{
  for (const Pair &pair : pairs)
    if (each_atom) each_atom[pair.particle] += 0.5 * pair.stiffness * pair.overlap * pair.overlap;
  return total_energy;
}

/* ---------------------------------------------------------------------- */

void ContactStage::force_on(const Boundary *wall, double *force) const
{
  const auto &all = boundary.all();
  const auto k = static_cast<std::size_t>(std::find(all.begin(), all.end(), wall) - all.begin());
  for (int d = 0; d < 6; d++) force[d] = (6 * k < on_walls.size()) ? on_walls[6 * k + d] : 0.0;
}

/* ---------------------------------------------------------------------- */

double ContactStage::memory_usage() const
{
  return bytes(surface) + bytes(shift) + bytes(pairs) + bytes(near);
}
