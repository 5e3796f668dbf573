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
#include "comm.h"
#include "error.h"
#include "force.h"
#include "math_extra.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "sph_dissipation_cells.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_particle_terms.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// Repulsion of the surfaces with thermal noise, see contact_kernel(): inside of a lattice a particle has the energy 32 kT

static constexpr double HARDNESS = 150.0;           // k/2 of the repulsion with temp T, over kT
static constexpr double HARDNESS_OF_SOUND = 0.5;    // the same with temp energy, over m c0^2

/* ---------------------------------------------------------------------- */

void BoundaryStage::add(Boundary *boundary)
{
  remove(boundary);
  boundaries.push_back(boundary);
  find_bits();
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::remove(Boundary *boundary)
{
  boundaries.erase(std::remove(boundaries.begin(), boundaries.end(), boundary), boundaries.end());
  find_bits();
}

void BoundaryStage::find_bits()
{
  group_bits = symmetric_bits = body_bits = elastic_bits = mean_bits = 0;
  for (const auto &one : boundaries) {
    group_bits |= one->boundary_bit();
    if (one->has_symmetric_friction()) symmetric_bits |= one->boundary_bit();
    if (one->has_bodies()) body_bits |= one->boundary_bit();
    if (one->has_elastic_bodies()) elastic_bits |= one->boundary_bit();
    if (one->has_mean_pressure()) mean_bits |= one->boundary_bit();
  }
  sum_bits = group_bits & ~body_bits;
  engine.body_bits = body_bits;
  if (boundaries.empty()) engine.forget_wall_energy();
  if (group_bits == symmetric_bits) engine.excess.clear();
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::set_reference_volume()
{
  const ParticleRows &rows = engine.rows();
  engine.for_each(atom->nlocal + atom->nghost, [&](int i) {
    rows.set_reference_volume(i, group_bits);
  });
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::rest_at_surface(int i, const WallCondition &condition,
                                    const Surface &surface_of, const double *acceleration)
{
  SPHDissipation::rest_at_surface(engine.rows(), i, condition, surface_of, acceleration);
}

void BoundaryStage::extend_fluid(int i, const WallCondition &condition, const Surface &surface_of,
                                 const BoundarySum &sum_of, const double *acceleration)
{
  SPHDissipation::extend_fluid(engine.rows(), i, condition, surface_of, sum_of, acceleration,
                               spin(i));
}

void BoundaryStage::set_heat(int i, WallHeat heat, double value, const Surface &surface_of)
{
  if (engine.parameters().own_temperatures)
    engine.heat()[i] = {0.0, value, (heat == WallHeat::TEMPERATURE) ? 1.0 : 0.0, 0.0};
  else if (!heat_sum.empty() && heat_sum[i].weight > 0.0)
    engine.heat()[i] =
        wall_conductor(heat, value, atom->vfrac[i], conductivity(i), surface_of, heat_sum[i]);
}

double BoundaryStage::conductivity(int i) const
{
  return engine.parameters().type[atom->type[i]].flow[HEAT_FLOW];
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::run(NeighList *list)
{
  begin(list);
  extend(false);
  set_excess();
  extend_temperatures(false);
}

/* ----------------------------------------------------------------------
   Find the pairs of this step and move the surfaces; with a new neighbor list, first find candidates, bodies, and surfaces.
------------------------------------------------------------------------- */

void BoundaryStage::begin(NeighList *list)
{
  const bool found = (neighbor->ago == 0 || group_bits != rows_bits);
  if (found) {
    find_candidates(list);
    find_bodies();
    find_surface_pairs();
  }
  find_pairs();
  surface.conducts = conducts();
  check(found);
  if (found) {
    surface.run(group_bits, pairs, body_of);
    sum_bodies();
    warn_of_contact();
  }
  const bool before = (!found && surface_step != update->ntimestep);
  surface_step = update->ntimestep;
  for (auto boundary : boundaries) boundary->move_surface(*this, surface.surface.data(), before);
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::find_bodies()
{
  body_of.clear();
  if (!body_bits) return;
  body_of.assign(atom->nlocal + atom->nghost, 0.0);
  int next = 1;
  for (auto boundary : boundaries) next = boundary->number_bodies(next, body_of.data());
  exchange.forward({{body_of.data(), 1, 1}});
}

/* ---------------------------------------------------------------------- */

double BoundaryStage::resting_volume(int i) const
{
  return atom->rmass[i] / engine.parameters().type[atom->type[i]].eos.rho0;
}

double BoundaryStage::weight(int i) const
{
  return (engine.constants().volume == Volume::MASS) ? resting_volume(i) : 1.0;
}

/* ----------------------------------------------------------------------
   Sum the number density of each body particle over the other particles of its body: neighbor lists do not have these pairs.
   The sums are constant until the next neighbor list, those of an elastic body longer.
------------------------------------------------------------------------- */

void BoundaryStage::sum_bodies()
{
  own_numden.clear();
  if (!body_bits) return;
  const Parameters &par = engine.parameters();
  own_numden.assign(atom->nlocal, 0.0);
  std::vector<int> members;
  for (int i = 0; i < atom->nlocal + atom->nghost; i++)
    if (atom->mask[i] & body_bits) members.push_back(i);
  const Cells cells(atom->x, members, par.support);
  with_kernel(par.kernel, [&](auto kernel) {
    engine.for_each(atom->nlocal, [&](int i) {
      if (!(atom->mask[i] & body_bits)) return;
      cells.near(atom->x[i], par.support, [&](int j, const double *, double rsq) {
        if (j == i || body_of[j] != body_of[i]) return;
        own_numden[i] += weight(j) * par.weight_norm * kernel.shape(sqrt(rsq) / par.support);
      });
    });
    return 0;
  });
  if (elastic_bits && !par.continuity) keep_first_shape();
}

/* ----------------------------------------------------------------------
   An elastic body keeps the number densities of its first shape: so strains make no pressure.  vol_support stores them, with
   the particle itself, as the filled part of the support.  With density continuity, rho and rho_sum keep them instead.
------------------------------------------------------------------------- */

void BoundaryStage::keep_first_shape()
{
  const Parameters &par = engine.parameters();
  double *const filled_part = Fields::of(atom)->vol_support;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & elastic_bits)) continue;
    const double own = weight(i) * par.self_weight, whole = weight(i) / resting_volume(i);
    if (!(filled_part[i] > 0.0)) filled_part[i] = (own_numden[i] + own) / whole;
    own_numden[i] = filled_part[i] * whole - own;
  }
}

/* ----------------------------------------------------------------------
   Warn once if particles of two bodies, or of a body and a wall, are so close that no fluid fits between them.  With
   pair_style hybrid, another style may keep them apart.
------------------------------------------------------------------------- */

void BoundaryStage::warn_of_contact()
{
  constexpr double CLOSE = 1.5,
                   ELASTIC = 0.7;    // spacings; elastic bodies may be clamped to walls
  if (!body_bits || warned_of_contact || utils::strmatch(force->pair_style, "^hybrid")) return;
  std::vector<int> members;
  for (int i = 0; i < atom->nlocal + atom->nghost; i++)
    if (atom->mask[i] & group_bits) members.push_back(i);
  const Parameters &par = engine.parameters();
  const Cells cells(atom->x, members, par.support);
  int with_contact = 0, touching = 0;
  for (const auto one : boundaries)
    if (one->contact()) with_contact |= one->boundary_bit();
  for (int i = 0; i < atom->nlocal && !touching; i++) {
    if (!(atom->mask[i] & body_bits)) continue;
    const double close = (atom->mask[i] & elastic_bits) ? ELASTIC : CLOSE;
    cells.near(atom->x[i], close * spacing_of(par.dim, resting_volume(i)),
               [&](int j, const double *, double) {
                 if (body_of[j] != body_of[i] && !((atom->mask[i] | atom->mask[j]) & with_contact))
                   touching = 1;
               });
  }
  warned_of_contact = over_all(world, touching, MPI_MAX);
  if (warned_of_contact && comm->me == 0)
    error->warning(FLERR,
                   "Pair style {}: a body touches another one, or a wall, in step {}: bodies have "
                   "no contact forces, only the fluid keeps them apart; use contact of fix "
                   "sph/wall for rigid bodies, pair_style hybrid for elastic ones",
                   style, update->ntimestep);
}

/* ---------------------------------------------------------------------- */

bool BoundaryStage::has_contact() const
{
  return body_bits && std::any_of(boundaries.begin(), boundaries.end(), [](const Boundary *one) {
           return one->contact() != nullptr;
         });
}

bool BoundaryStage::is_boundary(int i) const
{
  return atom->mask[i] & group_bits;
}

bool BoundaryStage::is_body(int i) const
{
  return atom->mask[i] & body_bits;
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::set_frozen(int i, const double *gravity)
{
  SPHDissipation::set_frozen(engine.rows(), i, own_numden[i],
                             (sum_bits & body_bits) ? &sum[i] : nullptr, gravity);
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::extend(bool increments)
{
  if (increments && !mean_bits) return;
  const bool bodies_begin = engine.constants().continuity && update->setupflag;
  sum_bits = bodies_begin ? group_bits : group_bits & ~body_bits;
  accumulate();
  for (auto boundary : boundaries)
    if (!(increments && boundary->has_symmetric_friction()))
      boundary->set_boundary(*this, surface.surface.data(), sum.data());

  if (increments)
    engine.for_each(atom->nlocal, [&](int i) {
      if (!(atom->mask[i] & mean_bits) || !(sum[i].weight > 0.0)) return;
      const double p = pushes[i] ? sum[i].pressure / sum[i].weight : 0.0;
      engine.particle[i].g = pressure_term(p, atom->vfrac[i], engine.weight(i));
    });

  // volume 0 turns off friction in pass 2: add_friction() adds all, unless the noise has numbers of each partner

  if (symmetric_bits && !engine.parameters().directed_noise())
    engine.for_each(atom->nlocal, [&](int i) {
      if (atom->mask[i] & symmetric_bits) engine.particle[i].vol = 0.0;
    });

  Particle *const particle = engine.particle;
  const Field state = field(particle, particle->u, 5);    // u, vol and g
  exchange.forward({state, {engine.zeta_term, 1, 1}, engine.spins()}, group_bits);
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::note_pressures()
{
  pushes.resize(atom->nlocal);
  engine.for_each(atom->nlocal, [&](int i) {
    pushes[i] = (engine.particle[i].g > 0.0 || engine.parameters().tension);
  });
}

/* ----------------------------------------------------------------------
   Set the excess of boundary particles without symmetric friction, so that pass 2 gives all heat of friction to the fluid.
   A minimization has no velocities: do nothing.
------------------------------------------------------------------------- */

void BoundaryStage::set_excess()
{
  if (engine.excess.empty() || update->whichflag == 2) return;
  engine.for_each(atom->nlocal + atom->nghost, [&](int i) {
    if (atom->mask[i] & group_bits & ~symmetric_bits)
      SPHDissipation::set_excess(engine.excess[i], engine.particle[i], atom->vest[i], spin(i),
                                 surface.surface[i]);
  });
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::set_squares()
{
  const int *const mask = atom->mask;
  engine.team().run([&](int k) {
    for (const int ii : pairs.rows[k])
      engine.visit_pairs(ii, [&](int i, int j, bigint entry) {
        if (are_across(mask[i], mask[j])) engine.set_square(i, j, entry);
      });
  });
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::extend_temperatures(bool increments)
{
  if (!conducts()) return heat_sum.clear();
  if (engine.parameters().own_temperatures)
    heat_sum.clear();
  else {
    accumulate_heat();
    BoundaryHeatSum *const heat = heat_sum.data();
    exchange.reverse({field(heat, &heat->weight, sizeof(*heat) / sizeof(double))}, group_bits);
  }
  for (auto boundary : boundaries) boundary->set_heat(*this, surface.surface.data(), increments);
  FlowRow *const heat = engine.heat().data();
  exchange.forward({field(heat, &heat->vol, 4)}, group_bits);
}

/* ---------------------------------------------------------------------- */

bool BoundaryStage::gives_heat() const
{
  return engine.parameters().conducts() &&
      std::any_of(boundaries.begin(), boundaries.end(), [](const Boundary *one) {
           return one->gives_heat();
         });
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::add_surface_heat(std::vector<double> &flow)
{
  if (heat_sum.empty()) return;
  flow_sums.run(engine.team(), flow.data(), flow.size(), pairs.touched, [&](int k, double *sum) {
    pairs.of_thread[k].visit([&](const BoundaryPair &pair) {
      const double flux = engine.heat()[pair.wall].flux;
      if (flux == 0.0 || !(engine.heat()[pair.fluid].coefficient > 0.0)) return;
      const Particle &f = engine.particle[pair.fluid], &w = engine.particle[pair.wall];
      double r[3];
      for (int d = 0; d < 3; d++) r[d] = w.x[d] - f.x[d];
      const double heat = surface_heat(flux, f.vol, r, pair.slope, surface.surface[pair.wall]);
      sum[pair.fluid] += heat;
      sum[pair.wall] -= heat;
    });
  });
}

/* ---------------------------------------------------------------------- */

double BoundaryStage::thermal_stiffness() const
{
  const Parameters &par = engine.parameters();
  return par.thermal ? 2.0 * HARDNESS * force->boltz * par.temperature : 0.0;
}

Repulsion BoundaryStage::repulsion_of(int i) const
{
  const Parameters &par = engine.parameters();
  if (par.thermal && !par.own_temperatures) return {thermal_stiffness(), 0.0};
  const double mass = atom->rmass[i], c0 = par.type[atom->type[i]].eos.c0;
  if (par.thermal) return {2.0 * HARDNESS_OF_SOUND * mass * c0 * c0, 0.0};
  return repulsion_of_surface(mass, c0);
}

/* ----------------------------------------------------------------------
   Return the force of a pair.  For a ghost, over() needs `filled`: forward this array first.
------------------------------------------------------------------------- */

BoundaryStage::WallForce BoundaryStage::force_of(const BoundaryPair &pair) const
{
  const Particle &f = engine.particle[pair.fluid], &w = engine.particle[pair.wall];
  WallForce force = {};
  for (int d = 0; d < 3; d++) {
    force.r[d] = f.x[d] - w.x[d];
    force.approach -= force.r[d] * (f.u[d] - w.u[d]);
  }
  if (engine.parameters().thermal && !is_body(pair.wall))
    force.pressing = engine.weight(pair.fluid) * engine.weight(pair.wall) * w.g * pair.slope;
  force.repulsion = force_of_repulsion(repulsion_of(pair.fluid), over(pair.fluid),
                                       contact[pair.wall], pair.distance);
  return force;
}

/* ----------------------------------------------------------------------
   Find the pairs with symmetric friction.  The particles of one boundary, or of one body, are rigid together.
------------------------------------------------------------------------- */

void BoundaryStage::find_surface_pairs()
{
  surface_pairs.resize(symmetric_bits ? pairs.of_thread.size() : 0);
  if (!symmetric_bits) return;
  const int nall = atom->nlocal + atom->nghost, nboundary = static_cast<int>(boundaries.size());
  auto body_number = [&](int i) {
    const int bits = atom->mask[i] & symmetric_bits;
    if (bits & body_bits) return nboundary + body(i);
    for (int k = 0; k < nboundary; k++)
      if (bits & boundaries[k]->boundary_bit()) return k;
    return -1;
  };
  engine.team().run([&](int k) {
    surface_pairs[k].find(pairs.of_thread[k], nall, body_number);
  });
}

/* ----------------------------------------------------------------------
   Compute the sums of surface_pairs.  Copies have g = 0, and boundary particles the volume vfrac, since extend() may have
   set vol = 0 for pass 2.  Copies have u - omega x r and relative spins, so that differences are those in the frame of the
   body.
------------------------------------------------------------------------- */

void BoundaryStage::run_friction(FrictionPart part, PairTally *tally, const StepNoise *noise,
                                 bool linear)
{
  auto copy = [&](int i, int wall, Particle &particle, Spin *spin) {
    particle = engine.particle[i];
    particle.g = 0.0;
    if (i == wall) particle.vol = atom->vfrac[i];
    if (!linear) {
      double turn[3];
      cross_product(surface.surface[wall].omega, particle.x, turn);
      for (int d = 0; d < 3; d++) particle.u[d] -= turn[d];
    }
    for (int d = 0; spin && d < 3; d++) spin->w[d] = engine.spin[i].w[d] - engine.spin[wall].w[d];
  };
  auto run = [&](int k) {
    SurfacePairs &own = surface_pairs[k];
    BoundaryRows &rows = pairs.of_thread[k];
    own.begin(rows, engine.has_spin(), copy);
    const bool added = (part == FrictionPart::ADDED);
    if (part != FrictionPart::BODY)
      engine.loop_set().surface_slopes(engine.pairs(), rows, own.places(), surface.surface.data(),
                                       added ? 1.0 : 0.0, own.slope.data());
    double *const slope = (part == FrictionPart::BODY) ? rows.slope.data() : own.slope.data();
    engine.accumulate_friction(own, rows, slope, tally, noise, k);
  };
  if (tally)
    for (int k = 0; k < engine.team().size(); k++) run(k);
  else
    engine.team().run(run);
}

/* ----------------------------------------------------------------------
   Add forces, torques and heat of surface_pairs.  With temp energy, the loops give all heat of friction to the fluid, and
   the flow of heat to both partners.  Else the loops share the heat equally, and the fluid gets both halves here.
------------------------------------------------------------------------- */

void BoundaryStage::add_friction(PairTally *tally, const StepNoise &noise)
{
  if (!symmetric_bits) return;
  const bool directed = engine.parameters().directed_noise();
  const bool shared = !engine.parameters().own_temperatures;
  ChannelSums &side = engine.side;
  const int first_heat = side.columns.spins ? 3 : 0;

  run_friction(directed ? FrictionPart::ADDED : FrictionPart::ALL, tally, &noise, false);
  for (const auto &own : surface_pairs)
    own.visit([&](int i, bool is_boundary, std::size_t k) {
      const double part = !shared ? 1.0 : is_boundary ? 0.0 : 2.0;
      const double *const row = own.side.torque(k);
      for (int d = 0; d < 3; d++) engine.force[i].f[d] += own.force[k].f[d];
      engine.force[i].heat += part * own.force[k].heat;
      for (int c = 0; c < side.width; c++)
        side.torque(i)[c] += ((c < first_heat) ? 1.0 : part) * row[c];
    });
  if (!directed) return;

  // give the fluid also the half of the heat that pass 2 gave the wall

  run_friction(FrictionPart::BODY, nullptr, nullptr, false);
  for (const auto &own : surface_pairs)
    own.visit([&](int i, bool is_boundary, std::size_t k) {
      if (is_boundary) return;
      engine.force[i].heat += own.force[k].heat;
      for (int c = first_heat; c < side.width; c++) side.torque(i)[c] += own.side.torque(k)[c];
    });
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::add_linear_friction()
{
  if (!symmetric_bits) return;
  run_friction(engine.parameters().directed_noise() ? FrictionPart::ADDED : FrictionPart::ALL,
               nullptr, nullptr, true);
  for (const auto &own : surface_pairs)
    own.visit([&](int i, bool is_boundary, std::size_t k) {
      for (int d = 0; d < 3; d++) {
        engine.force[i].f[d] += own.force[k].f[d];
        if (engine.has_spin() && !is_boundary) engine.side.torque(i)[d] += own.side.torque(k)[d];
      }
    });
}

/* ----------------------------------------------------------------------
   Add forces and heating of the repulsion.  With noise, subtract the work of the pressure of walls, whose force pass 2 has.
------------------------------------------------------------------------- */

void BoundaryStage::repel(PairTally *tally)
{
  if (!has_energy()) return;
  exchange.forward({{filled.data(), 1, 1}});
  const int nall = atom->nlocal + atom->nghost, n = nforce();

  auto add_force = [&](int i, const double *f) {
    for (int d = 0; d < 3; d++) {
      engine.force[i].f[d] += f[d];
      if (i < n) atom->f[i][d] += f[d];
    }
  };
  auto add_heat = [&](int i, double heat) {
    if (i < n) atom->desph[i] += heat;
  };
  auto visit = [&](const BoundaryRows &some, const auto &force_on, const auto &heat_of) {
    some.visit([&](const BoundaryPair &pair) {
      const WallForce force = force_of(pair);
      heat_of(pair.fluid, (force.pressing + force.repulsion) * force.approach);
      if (force.repulsion == 0.0) return;
      double push[3], minus[3];
      for (int d = 0; d < 3; d++) {
        push[d] = force.repulsion * force.r[d];
        minus[d] = -push[d];
      }
      force_on(pair.fluid, push);
      force_on(pair.wall, minus);
      if (tally) tally->tally(pair.fluid, pair.wall, push, force.r);
    });
  };

  if (tally || engine.team().size() == 1) {
    for (const auto &some : pairs.of_thread) visit(some, add_force, add_heat);
    return;
  }
  repulsion.resize(nall);
  engine.for_each(nall, [&](int i) {
    repulsion[i] = ForceSum();
  });
  repulsion_sums.run(engine.team(), repulsion.data(), nall, pairs.touched,
                     [&](int k, ForceSum *own) {
                       visit(
                           pairs.of_thread[k],
                           [=](int i, const double *f) {
                             for (int d = 0; d < 3; d++) own[i].f[d] += f[d];
                           },
                           [=](int i, double heat) {
                             own[i].heat += heat;
                           });
                     });
  engine.for_each(nall, [&](int i) {
    add_force(i, repulsion[i].f);
    add_heat(i, repulsion[i].heat);
  });
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::find_energies(double missing)
{
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  std::vector<double> each(nall, 0.0), work(nall, 0.0);
  exchange.forward({{filled.data(), 1, 1}});
  add_energies(nall, [&](int i, double energy) {
    each[i] += energy;
  });
  pairs.visit([&](const BoundaryPair &pair) {
    const WallForce force = force_of(pair);
    work[pair.fluid] += (force.pressing + force.repulsion) * force.approach;
  });
  exchange.reverse({{each.data(), 1, 1}, {work.data(), 1, 1}});
  engine.set_wall_energy(each.data());
  for (int i = 0; i < nlocal; i++) engine.rows().esph[i] += missing * work[i];
}

void BoundaryStage::find_energies_at_rest(NeighList *list)
{
  set_reference_volume();
  begin(list);
  extend(false);
  find_energies(0.0);
}

/* ---------------------------------------------------------------------- */

double BoundaryStage::energy_of_bodies(double *each_atom) const
{
  double total = 0.0;
  const Parameters &par = engine.parameters();
  for (int i = 0; i < atom->nlocal && body_bits; i++) {
    if (!(atom->mask[i] & body_bits)) continue;
    const double energy =
        atom->rmass[i] * elastic_energy(par.eos, par.type[atom->type[i]].eos, atom->rho[i]);
    total += energy;
    if (each_atom) each_atom[i] += energy;
  }
  return total;
}

double BoundaryStage::energy(double *each_atom) const
{
  double total = energy_of_bodies(each_atom);
  if (!has_energy()) return total;
  add_energies(nforce(), [&](int i, double energy) {
    total += energy;
    if (each_atom) each_atom[i] += energy;
  });
  return total;
}

/* ----------------------------------------------------------------------
   Call add(i, energy) for the repulsion of each owned fluid particle i; with noise, also for the pressure of walls, for each
   pair of a fluid particle i < n and a wall particle.
------------------------------------------------------------------------- */

void BoundaryStage::add_energies(int n, const std::function<void(int, double)> &add) const
{
  const Parameters &par = engine.parameters();
  with_kernel(engine.parameters().kernel, [&](auto k) {
    pairs.visit([&](const BoundaryPair &pair) {
      if (pair.fluid >= n || !par.thermal || is_body(pair.wall)) return;
      const double pressing =
          engine.weight(pair.fluid) * engine.weight(pair.wall) * engine.particle[pair.wall].g;
      add(pair.fluid, pressing * par.weight_norm * k.shape(pair.distance / par.support));
    });
    return 0;
  });
  for (int i = 0; i < atom->nlocal; i++)
    if (!(atom->mask[i] & group_bits)) add(i, energy_of_repulsion(repulsion_of(i), over(i)));
}

/* ----------------------------------------------------------------------
   Find the pairs of fluid and boundary particles in a new neighbor list, and share them among the threads.
------------------------------------------------------------------------- */

void BoundaryStage::find_candidates(NeighList *list)
{
  Threads &threads = engine.team();
  const int parts = threads.size(), nall = atom->nlocal + atom->nghost;
  const int *const mask = atom->mask;
  const Parameters &par = engine.parameters();
  rows_bits = group_bits;
  contact.clear();
  if (has_energy())
    contact = of_boundaries([&](double volume) {
      return contact_kernel(par.dim, par.support, ContactKernel::norm(par.dim), volume);
    });

  // candidates of each thread, in the order of the list

  struct Candidate {
    int fluid, wall;
  };
  std::vector<std::vector<Candidate>> found(parts);
  pairs.rows.assign(parts, {});
  threads.in_parts(list->inum, [&](int k, int from, int to) {
    for (int ii = from; ii < to; ii++) {
      const int i = list->ilist[ii];
      const std::size_t before = found[k].size();
      for (int jj = 0; jj < list->numneigh[i]; jj++) {
        const int j = list->firstneigh[i][jj] & NEIGHMASK;
        if (!are_across(mask[i], mask[j])) continue;
        found[k].push_back((mask[i] & group_bits) ? Candidate{j, i} : Candidate{i, j});
      }
      if (found[k].size() > before) pairs.rows[k].push_back(ii);
    }
  });

  engine.excess.clear();
  if (group_bits != symmetric_bits) {
    engine.excess.resize(nall + BLOCK);
    for (const auto &part : pairs.rows)
      for (const int ii : part) engine.excess[list->ilist[ii]].crosses = 1.0;
  }

  // sort the candidates by boundary particle; each boundary particle belongs to one thread

  std::vector<bigint> next(nall + 1, 0);
  for (const auto &part : found)
    for (const auto &pair : part) next[pair.wall + 1]++;
  std::partial_sum(next.begin(), next.end(), next.begin());
  const std::vector<bigint> first = next;
  const bigint total = first[nall];
  std::vector<int> ordered(total);
  for (const auto &part : found)
    for (const auto &pair : part) ordered[next[pair.wall]++] = pair.fluid;
  pairs.of_thread.resize(parts);
  for (int k = 0, i = 0; k < parts; k++) {
    BoundaryRows &rows = pairs.of_thread[k];
    rows.begin();
    for (; i < nall && first[i] < total * (k + 1) / parts; i++)
      if (first[i + 1] > first[i])
        rows.add(i, &ordered[first[i]], static_cast<int>(first[i + 1] - first[i]), nall);
    rows.end();
  }

  pairs.touched.resize(parts);
  threads.run([&](int k) {
    if (k == 0) return;
    std::vector<bool> known(nall + BLOCK);
    auto &touched = pairs.touched[k];
    touched.clear();
    auto touch = [&](int i) {
      if (i < nall && !known[i]) touched.push_back(i);
      known[i] = true;
    };
    for (const int i : pairs.of_thread[k].wall) touch(i);
    for (const Offset i : pairs.of_thread[k].candidate) touch(index_of(i));
  });
}

/* ---------------------------------------------------------------------- */

std::vector<NearKernel>
BoundaryStage::of_boundaries(const std::function<NearKernel(double)> &of_volume) const
{
  std::vector<NearKernel> all(atom->nlocal + atom->nghost);
  engine.for_each(static_cast<int>(all.size()), [&](int i) {
    if (atom->mask[i] & group_bits) all[i] = of_volume(atom->vfrac[i]);
  });
  return all;
}

/* ----------------------------------------------------------------------
   Set part[i] to the part of the kernel support of owned atom i that boundary particles fill.
------------------------------------------------------------------------- */

void BoundaryStage::find_filled(Kernel kernel, const std::vector<NearKernel> &kernels,
                                std::vector<double> &part)
{
  const auto loop = engine.loop_set().boundary(kernel).filled;
  part.assign(kernels.size(), 0.0);
  filled_sums.run(engine.team(), part.data(), part.size(), pairs.touched, [&](int k, double *own) {
    loop(pairs.of_thread[k], kernels.data(), own);
  });
  exchange.reverse({{part.data(), 1, 1}});
}

/* ----------------------------------------------------------------------
   Find the pairs inside the support and, if walls repel, the filled parts of owned atoms.
------------------------------------------------------------------------- */

void BoundaryStage::find_pairs()
{
  const auto loop = engine.loop_set().boundary(engine.parameters().kernel).pairs;
  engine.team().run([&](int k) {
    loop(engine.pairs(), pairs.of_thread[k]);
  });
  if (has_energy()) find_filled(CONTACT_KERNEL, contact, filled);
}

/* ----------------------------------------------------------------------
   Sum up the fluid around the owned particles of the boundaries in sum_bits.
------------------------------------------------------------------------- */

void BoundaryStage::accumulate()
{
  sum.resize(sum_bits ? atom->nmax : 0);
  if (!sum_bits) return;
  const int nall = atom->nlocal + atom->nghost;
  engine.for_each(nall, [&](int i) {
    if (atom->mask[i] & sum_bits) sum[i] = BoundarySum();
  });
  const bool has_spin = engine.has_spin();
  const auto loop = engine.loop_set().boundary(engine.parameters().kernel).sums[has_spin];
  const ParticleRows &rows = engine.rows();
  const bool by_mass = (engine.parameters().volume == Volume::MASS);
  if (!by_mass) {
    reference_volume.resize(nall);
    engine.for_each(nall, [&](int i) {
      reference_volume[i] = rows.reference_volume(i);
    });
  }
  const BoundarySumData data = {atom->mask,
                                sum_bits,
                                surface.surface.data(),
                                atom->rho,
                                by_mass ? rows.weight : reference_volume.data(),
                                sum.data()};
  engine.team().run([&](int k) {
    loop(engine.pairs(), pairs.of_thread[k], data);
  });

  BoundarySum *const first = sum.data();
  constexpr int OF_SPIN = BoundarySum::OF_SPIN, ALL = sizeof(BoundarySum) / sizeof(double);
  exchange.reverse({field(first, &first->weight, ALL - OF_SPIN),
                    field(first, first->wd3, has_spin ? OF_SPIN : 0)},
                   sum_bits);
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::accumulate_heat()
{
  const int nall = atom->nlocal + atom->nghost;
  heat_sum.resize(nall);
  engine.for_each(nall, [&](int i) {
    heat_sum[i] = BoundaryHeatSum();
  });
  const auto loop = engine.loop_set().boundary(engine.parameters().kernel).heat_sums;
  std::vector<double> conductivity;
  for (const auto &type : engine.parameters().type) conductivity.push_back(type.flow[HEAT_FLOW]);
  const BoundaryHeatData data = {atom->type, conductivity.data(), surface.surface.data(),
                                 engine.heat().data(), heat_sum.data()};
  engine.team().run([&](int k) {
    loop(engine.pairs(), pairs.of_thread[k], data);
  });
}

/* ----------------------------------------------------------------------
   Stop if a particle of the fluid is inside a wall.  Check with each new neighbor list, and in each step unless LAMMPS
   builds lists as soon as a particle has moved by half the skin.
------------------------------------------------------------------------- */

void BoundaryStage::check(bool found)
{
  const bool follows =
      neighbor->dist_check && neighbor->every == 1 && neighbor->delay == 0 && !neighbor->build_once;
  if (!found && follows) return;
  const Parameters &par = engine.parameters();
  if (found)
    near = of_boundaries([&](double volume) {
      return near_kernel(par.dim, par.support, par.weight_norm, volume);
    });
  std::vector<double> part;
  find_filled(par.kernel, near, part);
  for (int i = 0; i < atom->nlocal; i++)
    if (part[i] > INSIDE_WALL && !(atom->mask[i] & group_bits) && is_inside(i)) stop_for(i);
}

/* ----------------------------------------------------------------------
   Return whether a particle of the fluid that boundaries surround is inside of one body, or of walls, alone.  Between a body
   and a wall, or two bodies, it is caught in a gap.
------------------------------------------------------------------------- */

bool BoundaryStage::is_inside(int i) const
{
  if (!body_bits) return true;
  std::map<int, double> part;    // by the number of the body
  with_kernel(engine.parameters().kernel, [&](auto kernel) {
    for (int j = 0; j < atom->nlocal + atom->nghost; j++) {
      if (!(atom->mask[j] & group_bits)) continue;
      const double distance = near[j].scale * sqrt(MathExtra::distsq3(atom->x[i], atom->x[j]));
      if (distance < 1.0) part[body(j)] += near[j].norm * kernel.shape(distance);
    }
    return 0;
  });
  return std::any_of(part.begin(), part.end(), [](const auto &one) {
    return one.second > INSIDE_WALL;
  });
}

/* ---------------------------------------------------------------------- */

void BoundaryStage::stop_for(int i) const
{
  const double *const x = atom->x[i];
  error->one(
      FLERR,
      "Particle {} of the fluid of pair style {} is inside a wall in step {}, at {:g} {:g} "
      "{:g} with the speed {:g}: use a time step below the largest stable one of the log, a speed "
      "of sound of 10 times the largest speed, or a gentler start",
      atom->tag[i], style, update->ntimestep, x[0], x[1], x[2], MathExtra::len3(atom->v[i]));
}

/* ---------------------------------------------------------------------- */

const Surface *BoundaryStage::find_surface(const std::vector<double> &sides)
{
  find_bodies();
  surface.conducts = conducts();
  surface.run(group_bits, sides, body_of);
  sum_bodies();
  warn_of_contact();
  return surface.surface.data();
}

/* ---------------------------------------------------------------------- */

double BoundaryStage::memory_usage() const
{
  return bytes(surface_pairs, sum, filled, pairs, filled_sums, flow_sums, repulsion_sums, surface,
               heat_sum, reference_volume, repulsion, near, contact, body_of, own_numden, pushes);
}
