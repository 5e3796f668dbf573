/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#include "sph_dissipation_noise.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "input.h"
#include "neighbor.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_particle_terms.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

double NoiseStage::prepare(int not_fluid)
{
  if (neighbor->ago == 0) check_box();
  const bool energy = engine.parameters().own_temperatures;
  form = {engine.parameters().terms(), engine.parameters().dim,
          !energy                                           ? NoiseKind::PLAIN
              : engine.parameters().conducts() || not_fluid ? NoiseKind::CONDUCTION
                                                            : NoiseKind::ENERGY};
  if (engine.parameters().directed_noise()) form.kind = NoiseKind::DIRECTED;

  data.seed = static_cast<std::uint64_t>(engine.parameters().seed);
  data.step = static_cast<std::uint64_t>(update->ntimestep + clock.offset);

  data.of_pairs = NoiseChannel::PAIR;
  data.heat = 2.0 * force->boltz / update->dt;
  return energy ? data.heat : data.heat * engine.parameters().temperature;
}

/* ---------------------------------------------------------------------- */

StepNoise NoiseStage::run(const double *bound, int not_fluid, bool continued)
{
  const double factor = prepare(not_fluid);
  const bool energy = engine.parameters().own_temperatures;
  set_tags();
  if (energy) set_temperatures(continued, not_fluid);
  add_pressure(factor, not_fluid);
  StepNoise noise = {};
  if (engine.parameters().drag) noise.drag = draw_drag(factor, not_fluid);
  if (!set_coeffs(factor) && !energy) return noise;    // pairs share the work of a random pressure
  noise.pairs = noise.surfaces = {form, &data};
  if (form.kind == NoiseKind::DIRECTED) {
    set_shares(bound, not_fluid);
    set_surface_noise();
    noise.surfaces = {{form.terms, form.dim, NoiseKind::PLAIN}, &surface_data};
  }
  return noise;
}

/* ----------------------------------------------------------------------
   Set the noise of the friction that surfaces add to pairs: this noise has separate random numbers, one along e.
------------------------------------------------------------------------- */

void NoiseStage::set_surface_noise()
{
  surface_coeff = coeff;
  for (NoiseCoeff &one : surface_coeff) {
    one.central *= sqrt(2.0);
    one.central_by_square *= 2.0;
  }
  surface_data = data;
  surface_data.of_pairs = NoiseChannel::SURFACE;
  surface_data.coeff = surface_coeff.data();
}

/* ---------------------------------------------------------------------- */

void NoiseStage::begin_step(int not_fluid)
{
  count_step();
  if (engine.parameters().own_temperatures && (neighbor->ago == 0 || update->setupflag))
    find_masses(not_fluid);
}

/* ----------------------------------------------------------------------
   Raise the offset if reset_timestep goes back: so random numbers continue.  A setup repeats the numbers of the last step, a
   step has the numbers of the next step.  rerun repeats the numbers.
------------------------------------------------------------------------- */

void NoiseStage::count_step()
{
  if (input->command && strcmp(input->command, "rerun") == 0) return;
  const bigint now = update->ntimestep;
  if (update->setupflag) {
    if (now < clock.step) clock.offset += clock.step - now;
  } else if (now < clock.step || (now == clock.step && now == update->firststep + 1))
    clock.offset += clock.step + 1 - now;
  clock.step = now;
}

/* ----------------------------------------------------------------------
   Stop if a periodic box is so small that two images of a particle in one support would get the same number.
------------------------------------------------------------------------- */

void NoiseStage::check_box() const
{
  const double *const h_inv = domain->h_inv;
  const double heights[3] = {
      1.0 / sqrt(h_inv[0] * h_inv[0] + h_inv[5] * h_inv[5] + h_inv[4] * h_inv[4]),
      1.0 / sqrt(h_inv[1] * h_inv[1] + h_inv[3] * h_inv[3]), 1.0 / h_inv[2]};
  const double support = engine.parameters().support;
  for (int d = 0; d < domain->dimension; d++)
    if (domain->periodicity[d] && heights[d] < 2.0 * support)
      error->all(FLERR, Error::NOLASTLINE,
                 "Pair style with temp: the {} extent {} of the periodic box must be at least two "
                 "support radii, {}, or two images of a particle would get the same random number",
                 "xyz"[d], heights[d], 2.0 * support);
}

/* ---------------------------------------------------------------------- */

void NoiseStage::set_tags()
{
  const int nall = atom->nlocal + atom->nghost;
  tag.resize(nall + BLOCK);
  pressure.resize(nall + BLOCK);
  engine.for_each(nall, [&](int i) {
    tag[i] = atom->tag[i];
  });
  std::fill_n(tag.begin() + nall, BLOCK, 0.0);
  data.tag = tag.data();
}

/* ----------------------------------------------------------------------
   Set the rows and mobilities of all particles.  A particle without heat has temperature 0: such a particle gets no noise,
   and friction heats the particle.  At the start of a run, stop or warn if there are such particles.
------------------------------------------------------------------------- */

void NoiseStage::set_temperatures(bool continued, int not_fluid)
{
  const int nlocal = atom->nlocal;
  const int nall = nlocal + atom->nghost;
  const bool spins = engine.has_spin();
  const StateRows &states = engine.rows().states;
  const double *const inertia = Fields::of(atom)->inertia;
  constexpr double SMALLEST = 1.0e-300;    // not 0: a negative temperature marks a wall
  row.resize(nall + BLOCK);
  mobility.assign(nall + BLOCK, 0.0);
  std::fill_n(row.begin() + nall, BLOCK, NoiseRow());
  const double step = update->dt * force->ftm2v, boltz = force->boltz;
  std::vector<double> by_capacity(atom->ntypes + 1, 0.0);
  for (int type = 1; type <= atom->ntypes; type++)
    if (!engine.parameters().type[type].other)
      by_capacity[type] = 1.0 / engine.parameters().type[type].heat_capacity;
  const int without = engine.team().sum<int>(nall, [&](int i, int &count) {
    const int type = atom->type[i];
    row[i] = NoiseRow();
    if (engine.parameters().type[type].other) return;
    if (atom->mask[i] & not_fluid) {
      const bool passes = engine.parameters().conducts() && engine.heat()[i].coefficient > 0.0;
      row[i].temperature = -std::max(passes ? engine.heat()[i].value : 1.0, SMALLEST);
      row[i].pressure = passes ? 1.0 : 0.0;
      return;
    }
    const double mass_inv = 1.0 / atom->rmass[i], capacity_inv = mass_inv * by_capacity[type];
    mobility[i] = step * mass_inv;
    row[i].softness = boltz * capacity_inv;
    if (i >= nlocal) return;
    if (spins && inertia[i] > 0.0) row[i].spin_mobility = mobility[i] / inertia[i];
    const double heat = states.thermal_energy(i);
    if (!(heat > 0.0)) count++;
    row[i].temperature = std::max(heat, 0.0) * capacity_inv;
  });
  data.row = row.data();
  data.mobility = mobility.data();
  exchange.forward({field(row.data(), &row.data()->temperature, spins ? 2 : 1)});

  if (!update->setupflag) {
    if (neighbor->ago == 0 && !cold_arrival) find_cold_arrivals(not_fluid);
    return;
  }
  cold_arrival = false;
  bigint own[2] = {without, 0}, all[2];
  for (int i = 0; i < nlocal; i++)
    if (row[i].softness > 1.0) own[1]++;
  MPI_Allreduce(own, all, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all[0] && !continued)
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style with temp energy: {} particles have no heat, an internal energy that "
               "does not exceed their elastic energy; use set ... sph/e",
               all[0]);
  if (comm->me != 0) return;
  if (all[0]) warn_of_cold(all[0]);
  if (all[1] && !continued)
    error->warning(
        FLERR,
        "Pair style with temp energy: {} particles have a heat capacity, mass times cv, "
        "below Boltzmann's constant, with which most of their heats are near zero; use a "
        "larger cv",
        all[1]);
}

void NoiseStage::warn_of_cold(bigint number) const
{
  error->warning(FLERR,
                 "Pair style with temp energy: {} particles have no heat, and no noise until "
                 "friction or conduction warms them",
                 number);
}

/* ----------------------------------------------------------------------
   Warn once in a run of particles without internal energy, which a fix may have created before the neighbor list was built.
------------------------------------------------------------------------- */

void NoiseStage::find_cold_arrivals(int not_fluid)
{
  bigint own = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if (!engine.parameters().type[atom->type[i]].other && !(atom->mask[i] & not_fluid) &&
        atom->esph[i] == 0.0)
      own++;
  const bigint all = over_all(world, own, MPI_SUM);
  cold_arrival = all > 0;
  if (cold_arrival && comm->me == 0) warn_of_cold(all);
}

/* ----------------------------------------------------------------------
   Set the factors of random numbers by pair of types; return false if there is no friction between pairs.
------------------------------------------------------------------------- */

bool NoiseStage::set_coeffs(double factor)
{
  const Parameters &par = engine.parameters();
  const double share = (form.kind == NoiseKind::DIRECTED) ? 0.5 : 1.0;
  data.strength = share * factor;
  bool any = false;
  coeff.assign(par.pair.size(), NoiseCoeff());
  for (std::size_t k = 0; k < par.pair.size(); k++) {
    PairFriction friction = Channels::friction(par.spins(), par.pair[k].a);
    friction.along = std::max(friction.along, 0.0);
    friction.spin_along = std::max(friction.spin_along, 0.0);
    coeff[k].central = sqrt(data.strength * friction.along);
    coeff[k].central_by_square = data.strength * friction.along_by_square;
    coeff[k].transverse = (par.dim == 1) ? 0.0 : sqrt(factor * friction.across);
    coeff[k].spin_along = sqrt(factor * friction.spin_along);
    coeff[k].spin_across = sqrt(factor * friction.spin_across);
    coeff[k].inverse_central = (friction.along > 0.0) ? 1.0 / friction.along : 0.0;
    const TypeParameters &first = par.type[k / par.ntypes_1], &second = par.type[k % par.ntypes_1];
    coeff[k].conduction = mean_coefficient(first.flow[HEAT_FLOW], second.flow[HEAT_FLOW]);
    if (friction.along > 0.0 || friction.across > 0.0 || friction.spin_along > 0.0 ||
        friction.spin_across > 0.0 || friction.along_by_square > 0.0)
      any = true;
  }
  data.coeff = coeff.data();
  return any;
}

/* ---------------------------------------------------------------------- */

bool NoiseStage::is_negative(int i) const
{
  return form.kind == NoiseKind::DIRECTED && engine.parameters().type[atom->type[i]].zeta < 0.0;
}

/* ----------------------------------------------------------------------
   Add the random pressure of owned and ghost particles.  A ghost gets the number of its owner, without communication.
------------------------------------------------------------------------- */

void NoiseStage::add_pressure(double factor, int not_fluid)
{
  const int nall = atom->nlocal + atom->nghost;
  engine.draw_numbers(data, NoiseChannel::PRESSURE, nall, 1, pressure.data());
  const bool energy = engine.parameters().own_temperatures;
  std::vector<double> amplitude(atom->ntypes + 1, 0.0);
  for (int type = 1; type <= atom->ntypes; type++)
    if (!engine.parameters().type[type].other)
      amplitude[type] = factor * std::max(engine.parameters().type[type].zeta, 0.0);
  for (int type = 1; type <= atom->ntypes && !energy; type++)
    amplitude[type] = sqrt(amplitude[type]);
  engine.for_each(nall, [&](int i) {
    const double strength = amplitude[atom->type[i]];
    if (!(strength > 0.0) || (atom->mask[i] & not_fluid)) return;
    Particle &particle = engine.particle[i];
    const double c_inv = particle.vol / engine.weight(i);
    if (energy) {
      const double own = pressure[i] * sqrt(strength * row[i].temperature / particle.vol);
      row[i].pressure = own * c_inv * c_inv;
      engine.zeta_term[i] += own;
      particle.g += row[i].pressure;
    } else
      particle.g += strength * pressure[i] / sqrt(particle.vol) * c_inv * c_inv;
  });
}

/* ----------------------------------------------------------------------
   Return the random force of each owned particle, sqrt(2 kT b V/dt) xi, for the drags b of single particles.
------------------------------------------------------------------------- */

const double *NoiseStage::draw_drag(double factor, int not_fluid)
{
  const Parameters &par = engine.parameters();
  const int nlocal = atom->nlocal, n = nlocal + BLOCK;
  drag.resize(3 * n);
  drag_force.assign(3 * nlocal, 0.0);
  engine.draw_numbers(data, NoiseChannel::DRAG, nlocal, 3, drag.data());
  engine.for_each(nlocal, [&](int i) {
    const TypeParameters &type = par.type[atom->type[i]];
    if (type.other || (atom->mask[i] & not_fluid)) return;
    const double strength = sqrt(factor * type.keywords.drag() * engine.particle[i].vol);
    for (int d = 0; d < par.dim; d++) drag_force[3 * i + d] = strength * drag[d * n + i];
  });
  return drag_force.data();
}

/* ---------------------------------------------------------------------- */

const std::vector<double> &NoiseStage::draw_for_states()
{
  const Parameters &par = engine.parameters();
  const int nlocal = atom->nlocal, n = nlocal + BLOCK;
  constexpr int AT_ONCE = 4;    // numbers of a counter
  const StateRows states = engine.states();
  int end = 0;    // behind the last place of a state with noise
  for (const TypeParameters &type : par.type)
    for (int slot = 0; slot < States::MOST; slot++)
      if (States::noise(type.states, slot) != 0.0) end = std::max(end, slot + 1);
  data.step = static_cast<std::uint64_t>(clock.step + 1 + clock.offset);
  numbers.resize(AT_ONCE * static_cast<std::size_t>(n));
  change.assign(end * static_cast<std::size_t>(nlocal), 0.0);
  for (int first = 0; first < end; first += AT_ONCE) {
    const int count = std::min(end - first, AT_ONCE);
    const int channel = static_cast<int>(NoiseChannel::STATE) + first / AT_ONCE;
    engine.draw_numbers(data, static_cast<NoiseChannel>(channel), nlocal, count, numbers.data());
    engine.for_each(nlocal, [&](int i) {
      const States::Numbers &own = states.numbers(i);
      if (!own.any()) return;
      double temperature = par.temperature;
      if (par.own_temperatures) temperature = std::max(states.temperature(i), 0.0);
      const double strength = sqrt(force->boltz * temperature / atom->rmass[i]);
      for (int k = first; k < first + count; k++)
        change[k * static_cast<std::size_t>(nlocal) + i] =
            strength * States::noise(own, k) * numbers[(k - first) * static_cast<bigint>(n) + i];
    });
  }
  return change;
}

/* ---------------------------------------------------------------------- */

void NoiseStage::find_masses(int not_fluid)
{
  double own[2] = {-1.0e300, -1.0e300}, all[2];    // minus the smallest one, the largest one
  for (int i = 0; i < atom->nlocal; i++) {
    if (engine.parameters().type[atom->type[i]].other || (atom->mask[i] & not_fluid)) continue;
    own[0] = std::max(own[0], -atom->rmass[i]);
    own[1] = std::max(own[1], atom->rmass[i]);
  }
  MPI_Allreduce(own, all, 2, MPI_DOUBLE, MPI_MAX, world);
  data.unequal = (-all[0] != all[1]);
}

/* ---------------------------------------------------------------------- */

void NoiseStage::share_work()
{
  if (!data.unequal) return;
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  const bool spins = engine.has_spin();
  acceleration.assign(nall + BLOCK, Acceleration());
  flow.assign(nall + BLOCK, 0.0);
  const double by_dt = 1.0 / update->dt;
  engine.for_each(nlocal, [&](int i) {
    if (row[i].temperature < 0.0) return;
    Acceleration &own = acceleration[i];
    for (int d = 0; d < 3; d++) own.v[d] = by_dt * mobility[i] * engine.force[i].f[d];
    if (!spins) return;
    own.by_inertia = by_dt * row[i].spin_mobility;
    for (int d = 0; d < 3; d++) own.w[d] = own.by_inertia * engine.side.torque(i)[d];
  });
  Acceleration *const first = acceleration.data();
  exchange.forward({field(first, first->v, spins ? 7 : 3)});
  data.dt = update->dt;
  data.acceleration = first;
  data.total = flow.data();
  engine.accumulate_work(form, data);
  engine.for_each(nforce(), [&](int i) {
    atom->desph[i] += flow[i];
  });
}

/* ----------------------------------------------------------------------
   Set reach and share, see NoiseStage, from eta and the bounds of particles with a negative coefficient of the bulk term.
------------------------------------------------------------------------- */

void NoiseStage::set_shares(const double *bound, int not_fluid)
{
  constexpr double ROUNDOFF = 1.0e-15;    // of 1 + 2 zeta D, which is 0 at the bound
  const int nlocal = atom->nlocal;
  const int nall = nlocal + atom->nghost;
  eta.assign(nall + BLOCK, 0.0);
  reach.assign(nall + BLOCK, 0.0);
  share.assign(nall + BLOCK, 0.0);
  engine.for_each(nall, [&](int i) {
    reach[i] = engine.weight(i) / sqrt(engine.particle[i].vol);
  });
  data.total = eta.data();
  data.reach = reach.data();
  data.share = share.data();
  engine.accumulate_numbers(form, data);
  exchange.reverse({{eta.data(), 1, 1}});

  engine.for_each(nlocal, [&](int i) {
    const TypeParameters &type = engine.parameters().type[atom->type[i]];
    if (type.other || (atom->mask[i] & not_fluid) || !is_negative(i)) return;
    const double zeta = beyond_bound(type.zeta, bound[i]) ? zeta_at_bound(bound[i]) : type.zeta;
    if (!(zeta < 0.0)) return;    // no bound: a pair without friction
    const double rest = 1.0 + 2.0 * zeta * bound[i];
    const double s = 1.0 - ((rest > ROUNDOFF) ? sqrt(rest) : 0.0);
    const double c_inv = engine.particle[i].vol / engine.weight(i);
    share[i] = (bound[i] > 0.0) ? s * eta[i] * c_inv * c_inv / bound[i] : 0.0;
  });
  exchange.forward({{share.data(), 1, 1}});
}

/* ---------------------------------------------------------------------- */

double NoiseStage::memory_usage() const
{
  return bytes(row, acceleration, mobility, tag, reach, share, eta, drag, numbers, change, flow,
               drag_force, pressure);
}
