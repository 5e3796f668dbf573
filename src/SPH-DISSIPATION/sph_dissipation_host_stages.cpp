/* -----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#include "atom.h"
#include "force.h"
#include "math_extra.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_shared_stages.h"
#include "sph_dissipation_shared_viscous.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// The space of the host; stages, and functions of stages, that run on the host alone; the shared ones on the host

/* ---------------------------------------------------------------------- */

int Stage::nforce() const
{
  return force->newton_pair ? atom->nlocal + atom->nghost : atom->nlocal;
}

int HostSpace::nforce() const
{
  return force->newton_pair ? atom->nlocal + atom->nghost : atom->nlocal;
}

StateRows HostSpace::states() const
{
  return engine.states();
}

const int *HostSpace::mask() const
{
  return atom->mask;
}

static VectorField field_of(double **array)
{
  return {array ? array[0] : nullptr, 3, 1};
}

VectorField HostSpace::x() const
{
  return field_of(atom->x);
}

VectorField HostSpace::v() const
{
  return field_of(atom->v);
}

VectorField HostSpace::vest() const
{
  return field_of(atom->vest);
}

VectorField HostSpace::omega() const
{
  return field_of(atom->omega);
}

VectorField HostSpace::omegaest() const
{
  return field_of(Fields::of(atom)->omegaest);
}

const double *HostSpace::inertia() const
{
  return Fields::of(atom)->inertia;
}

double *HostSpace::energies() const
{
  return atom->esph;
}

/* ---------------------------------------------------------------------- */

void HostSpace::sum_density(NeighList *list, double **vest, double **omegaest, bool slopes_read)
{
  engine.accumulate_density(list, vest, omegaest, slopes_read);
  exchange.reverse({field(engine.density, &engine.density->c, 2)});
}

/* ----------------------------------------------------------------------
   Sum over the pairs of pass 1, on all threads.
------------------------------------------------------------------------- */

template <class Sum> void HostSpace::sum_pairs(const char *, const Sum &sum)
{
  typedef typename Sum::Row Row;
  constexpr int WIDTH = sizeof(Row) / sizeof(double);
  const ParticleRows &of = engine.rows();
  const double support_inv = 1.0 / of.par.support;
  scratch.assign((std::size_t) WIDTH * (atom->nlocal + atom->nghost), 0.0);
  const auto add_all = [&](const auto &shape) {
    engine.sum_pairs(scratch.data(), scratch.size(), [&](int i, int j, bigint entry, double *to) {
      Row *const total = reinterpret_cast<Row *>(to);
      PairPlace pair;
      MathExtra::sub3(of.particle[i].x, of.particle[j].x, pair.r);
      pair.rsq = MathExtra::lensq3(pair.r);
      pair.length = sqrt(pair.rsq);
      pair.slope = engine.slope(i, j, entry);
      pair.shape = shape(pair.length * support_inv);
      const double both = sum.shared(of, i, j, pair);
      sum.add(of, i, j, pair, both, total[i]);
      MathExtra::negate3(pair.r);
      sum.add(of, j, i, pair, both, total[j]);
    });
  };
  if constexpr (Sum::SHAPE)
    with_kernel(of.par.kernel, [&](auto kernel) {
      add_all([](double q) {
        return decltype(kernel)::shape(q);
      });
    });
  else
    add_all([](double) {
      return 0.0;
    });
  exchange.reverse({{scratch.data(), WIDTH, WIDTH}});
  const Row *const total = reinterpret_cast<const Row *>(scratch.data());
  engine.for_each(atom->nlocal, [&](int i) {
    sum.finish(of, i, total[i]);
  });
}

/* ---------------------------------------------------------------------- */

void HostSpace::set_shear_rates(int not_fluid)
{
  engine.accumulate_shear_rates(scratch);
  exchange.reverse({{scratch.data(), 1, 1}});
  const ParticleRows &rows = engine.rows();
  engine.for_each(atom->nlocal, [&](int i) {
    rows.set_shear_rate(i, scratch[i], not_fluid);
  });
}

/* ---------------------------------------------------------------------- */

double *HostSpace::sum_flow(int k)
{
  engine.accumulate_flow(k, engine.flow_rate[k]);
  return engine.flow_rate[k].data();
}

void HostSpace::sum_rates()
{
  engine.accumulate_rates();
  exchange.reverse({field(engine.density, &engine.density->cdot, 1)});
}

void HostSpace::sum_friction(NeighList *list, int not_fluid)
{
  engine.accumulate_friction(list, not_fluid);
}

void HostSpace::collect_forces()
{
  exchange.reverse({field(engine.force, engine.force->f, 3), engine.torques()});
}

VectorField HostSpace::forces() const
{
  return {engine.force->f, sizeof(ForceSum) / sizeof(double), 1};
}

VectorField HostSpace::torques() const
{
  return {engine.side.rows.data(), (std::size_t) engine.side.width, 1};
}

/* ---------------------------------------------------------------------- */

void HostSpace::forget_flows()
{
  for (auto &rate : engine.flow_rate) rate.clear();
}

/* ---------------------------------------------------------------------- */

template <class Space>
double PressureStage<Space>::elastic_energy(double *each_atom, int not_fluid) const
{
  Engine &engine = this->space.engine;
  Atom *const atom = this->atom;
  const Parameters &par = engine.parameters();
  const StateRows states = engine.states();
  double total = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (par.type[atom->type[i]].other || (atom->mask[i] & not_fluid)) continue;
    double energy = atom->rmass[i] *
        SPHDissipation::elastic_energy(par.eos, par.type[atom->type[i]].eos, atom->rho[i]);
    if (par.states) energy += states.energy(i, true);
    total += energy;
    if (each_atom) each_atom[i] += energy;
  }
  return total;
}

/* ---------------------------------------------------------------------- */

template <class Space> std::pair<bigint, int> StateStage<Space>::keep() const
{
  Engine &engine = this->space.engine;
  Atom *const atom = this->atom;
  const StateRows states = engine.states();
  bigint mine = 0;
  int bits = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    const int others = States::keep(states, i);
    if (others) mine++;
    bits |= others;
  }
  return {over_all(this->world, mine, MPI_SUM), over_all(this->world, bits, MPI_BOR)};
}

/* ---------------------------------------------------------------------- */

template <class Space> double StateStage<Space>::energy(int groupbits, int not_fluid) const
{
  Engine &engine = this->space.engine;
  Atom *const atom = this->atom;
  const StateRows states = engine.states();
  double total = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & groupbits) && !(atom->mask[i] & not_fluid)) total += states.energy(i);
  return total;
}

/* ----------------------------------------------------------------------
   The pressure is the pressure of the equation of state: strains do not change.
------------------------------------------------------------------------- */

template <class Space> void DiffusionStage<Space>::evaluate(int not_fluid, int integrated)
{
  Engine &engine = this->space.engine;
  Exchange &exchange = this->space.exchange;
  Atom *const atom = this->atom;
  const Parameters &par = engine.parameters();
  const bool alike = par.impedes_alike;
  const int dim = par.dim, nsum = number_of_sums(dim, alike), width = width_of_sums(dim, alike);
  const int vol = place_of_volume(dim), p = vol + 1;
  constexpr std::size_t WIDTH = sizeof(DiffusionRow) / sizeof(double);
  const Fields &fields = *Fields::of(atom);
  set_rows(not_fluid, integrated);
  const DiffusionData data = {rows.data(), impedances.data()};
  engine.accumulate_diffusion(DiffusionPart::SUMS, data, width, sums);
  double *const sum = sums[0].a;
  exchange.reverse({{sum, static_cast<std::size_t>(width), nsum}});
  engine.for_each(atom->nlocal, [&](int i) {
    double *const row = rows[i].a, *const own = sum + width * i;
    double *const rest = own + number_of_sums(dim, true);
    for (int m = 0; m < size_of_tensor(dim) && !alike; m++) rest[m] += impedances[i] * own[m];
    const double *const filled = alike ? own : rest;
    fields.vol_support[i] = (row[vol] > 0.0) ? pressure_gradient(dim, own, filled, row + p + 1)
                                             : 0.0;
  });
  exchange.forward({{rows[0].a + p + 1, WIDTH, dim}});
  engine.accumulate_diffusion(DiffusionPart::FLOW, data, 2, flow);
  double *const flow_of = flow[0].a;
  exchange.reverse({{flow_of, 2, 2}});

  // factor of a_ij that the loops leave out

  const double factor = par.delta * par.support / (alike ? par.impedance : 1.0);
  engine.for_each(atom->nlocal, [&](int i) {
    volume_rates(rows[i].a + vol, flow_of + 2 * i, factor, fields.vol_rate[i], fields.vol_heat[i]);
  });
}

/* ----------------------------------------------------------------------
   Return the heat of the bulk term: of an owned particle (form density); summed by pairs, also on ghosts (form volume).
------------------------------------------------------------------------- */

inline double ForceStage::bulk_heat(int i) const
{
  if (engine.parameters().bulk != Bulk::VOLUME && i >= atom->nlocal) return 0.0;
  return SPHDissipation::bulk_heat(engine.parameters().bulk, engine.zeta_term[i],
                                   engine.particle[i].vol, engine.weight(i), engine.density[i].cdot,
                                   engine.divergence[i]);
}

/* ---------------------------------------------------------------------- */

void ForceStage::run(int not_fluid)
{
  double **f = atom->f;
  double *const desph = atom->desph;
  const int n = nforce(), nlocal = atom->nlocal;
  auto add = [&](int i) {
    const ForceSum &total = engine.force[i];
    for (int d = 0; d < 3; d++) f[i][d] += total.f[d];
    desph[i] += total.heat + bulk_heat(i);
  };
  engine.for_each(nlocal, add);    // more work for each of them than for a ghost
  engine.for_each(n - nlocal, [&](int k) {
    add(nlocal + k);
  });
  if (engine.parameters().drag)
    engine.for_each(atom->nlocal, [&](int i) {
      double channel[NCHANNEL] = {};
      add_drag_heat(i, not_fluid, channel);
      for (const double heat : channel) desph[i] += heat;
    });

  if (engine.side.width == 0) return;
  double **const torque = engine.has_spin() ? atom->torque : nullptr;
  engine.for_each(n, [&](int i) {
    for (int d = 0; torque && d < 3; d++) torque[i][d] += engine.side.torque(i)[d];
    desph[i] += engine.side.heat(i);
  });
}

/* ---------------------------------------------------------------------- */

void ForceStage::add_drag_heat(int i, int not_fluid, double *channel) const
{
  double force[3] = {0.0, 0.0, 0.0};
  engine.add_drag(i, not_fluid, false, force, channel);
}

/* ---------------------------------------------------------------------- */

void ForceStage::heating(double *heat, double *power, int not_fluid) const
{
  std::fill(power, power + NCHANNEL, 0.0);
  const StateRows states = engine.states();
  const int n = nforce();
  for (int i = 0; i < n; i++) {
    if (heat) heat[i] = 0.0;
    if (atom->mask[i] & not_fluid) continue;
    double channel[NCHANNEL] = {engine.force[i].heat};
    channel[BULK_HEAT] = bulk_heat(i);
    engine.side.add_heat(i, channel);
    if (i < atom->nlocal) {
      add_drag_heat(i, not_fluid, channel);
      states.add_heat(i, channel);
    }
    for (int k = 0; k < NCHANNEL; k++) {
      if (heat) heat[i] += channel[k];
      power[k] += channel[k];
    }
  }
}

/* ---------------------------------------------------------------------- */

namespace LAMMPS_NS {
namespace SPHDissipation {
  template class DensityStage<HostSpace>;
  template class LimitStage<HostSpace>;
  template class ViscosityStage<HostSpace>;
  template class PressureStage<HostSpace>;
  template class StateStage<HostSpace>;
  template class FlowStage<HostSpace>;
  template class DiffusionStage<HostSpace>;
  template class ShiftStage<HostSpace>;
  template class StiffStage<HostSpace>;
  template class ViscousStage<HostSpace>;
}    // namespace SPHDissipation
}    // namespace LAMMPS_NS
