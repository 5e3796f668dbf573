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

#include "sph_dissipation_stages.h"

#include "atom.h"
#include "force.h"
#include "math_extra.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_kernel.h"
#include "sph_dissipation_particle_terms.h"
#include "sph_dissipation_shift_terms.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

int Stage::nforce() const
{
  return force->newton_pair ? atom->nlocal + atom->nghost : atom->nlocal;
}

/* ---------------------------------------------------------------------- */

void DensityStage::run(NeighList *list, double **vest, double **omegaest, int not_fluid,
                       bool slopes_read)
{
  sum(list, vest, omegaest, not_fluid, slopes_read);
  send(false, 0, 0, 0);
}

/* ---------------------------------------------------------------------- */

void DensityStage::sum(NeighList *list, double **vest, double **omegaest, int not_fluid,
                       bool slopes_read)
{
  engine.accumulate_density(list, vest, omegaest, slopes_read);
  exchange.reverse({field(engine.density, &engine.density->c, 2)});
  if (!engine.parameters().continuity) return;
  const ParticleRows &rows = engine.rows();
  engine.for_each(atom->nlocal, [&](int i) {
    rows.add_offset(i, not_fluid, engine.body_bits, engine.keeps_bodies);
  });
  engine.keeps_bodies = false;
}

/* ---------------------------------------------------------------------- */

void DensityStage::run(NeighList *list, double **vest, double **omegaest, bool at_rest,
                       double missing, int not_fluid, bool slopes_read)
{
  const bool states = engine.parameters().states;
  const bool completes = engine.parameters().own_temperatures;
  const int flows = engine.parameters().loops_of_flows;
  if (!states && !flows && !completes) return run(list, vest, omegaest, not_fluid, slopes_read);
  sum(list, vest, omegaest, not_fluid, slopes_read);
  const ParticleRows &rows = engine.rows();
  engine.for_each(atom->nlocal, [&](int i) {
    rows.set_density(i);
    if (states) rows.set_state_pressure(i, not_fluid, at_rest);
    if (completes) rows.complete_energy(i, missing, not_fluid);
    if (!flows) return;
    rows.set_flow_values(i);
    rows.set_flows(i, not_fluid);
  });
  send(states, flows, not_fluid, atom->nlocal);
}

/* ----------------------------------------------------------------------
   Send the values of owned particles to ghosts; then set the densities of all particles from number first on.
------------------------------------------------------------------------- */

void DensityStage::send(bool with_states, int flows, int not_fluid, int first)
{
  const int energy = engine.parameters().thermal_pressure ? 1 : 0;    // of ghosts, for it
  std::vector<Field> fields = {field(engine.density, &engine.density->c, 2),
                               {engine.rows().esph, 1, energy},
                               {engine.state_pressure, 1, with_states ? 1 : 0}};
  for (int k = 0; k < Flows::NUMBER; k++)
    if (flows >> k & 1) fields.push_back(field(engine.flow[k].data(), &engine.flow[k][0].value, 1));
  exchange.forward(fields);
  const ParticleRows &rows = engine.rows();
  engine.for_each(atom->nlocal + atom->nghost - first, [&](int k) {
    rows.set_density(first + k);
    if (flows) rows.set_flows(first + k, not_fluid);
  });
}

/* ---------------------------------------------------------------------- */

void LimitStage::run()
{
  const int nall = atom->nlocal + atom->nghost;
  bound.resize(atom->nmax);
  std::fill_n(bound.begin(), nall, 0.0);

  const Particle *const particle = engine.particle;
  const int *const type = atom->type;
  const Parameters &par = engine.parameters();

  engine.sum_pairs(sums, bound.data(), nall, [&](int i, int j, bigint entry, double *sum) {
    const double rsq = MathExtra::distsq3(particle[i].x, particle[j].x);
    const double weight =
        central_weight(par.shear, par.pair[type[i] * par.ntypes_1 + type[j]], sqrt(rsq));
    const PairBound pair = bound_of_pair(weight, engine.slope(i, j, entry), rsq, particle[i].vol,
                                         engine.weight(i), particle[j].vol, engine.weight(j));
    sum[i] += pair.i;
    sum[j] += pair.j;
  });

  exchange.reverse({{bound.data(), 1, 1}});
  exchange.forward({{bound.data(), 1, 1}});
}

/* ---------------------------------------------------------------------- */

void ViscosityStage::run(int walls)
{
  engine.accumulate_shear_rates(rates);
  exchange.reverse({{rates.data(), 1, 1}});
  const ParticleRows &rows = engine.rows();
  double *const shear_rate = Fields::of(atom)->shear_rate;
  double *const viscosity = Fields::of(atom)->shear_mu;
  engine.for_each(atom->nlocal, [&](int i) {
    const DensitySum &density = engine.density[i];
    shear_rate[i] = rows.is_fluid(i, walls)
        ? sqrt(std::max(shear_rate_squared(rows.par.dim, rows.par.rate_factor, rates[i],
                                           density.cdot / density.c),
                        0.0))
        : 0.0;
    rows.set_viscosity(i, shear_rate[i], walls);
    viscosity[i] = engine.viscosity[i];
  });
  exchange.forward({{engine.viscosity.data(), 1, 1}});
}

void ViscosityStage::keep()
{
  const double *const kept = Fields::of(atom)->shear_mu;
  std::copy_n(kept, atom->nlocal, engine.viscosity.begin());
  exchange.forward({{engine.viscosity.data(), 1, 1}});
}

/* ---------------------------------------------------------------------- */

bigint PressureStage::run(const double *bound, int not_fluid)
{
  const ParticleRows &rows = engine.rows();
  engine.for_each(atom->nlocal + atom->nghost, [&](int i) {
    rows.set_pressure(i, bound, not_fluid);
  });

  if (!bound) return 0;
  return engine.team().sum<bigint>(atom->nlocal, [&](int i, bigint &nbeyond) {
    if (rows.is_fluid(i, not_fluid) && rows.is_beyond(i, bound)) nbeyond++;
  });
}

/* ----------------------------------------------------------------------
   The volume of a particle of an open zone is prescribed; its c is a sum.
------------------------------------------------------------------------- */

void PressureStage::set_bulk_term(const double *bound, int not_fluid) const
{
  const ParticleRows &rows = engine.rows();
  const bool by_density = (rows.par.bulk == Bulk::DENSITY);
  engine.for_each(atom->nlocal + atom->nghost, [&](int i) {
    Particle &particle = engine.particle[i];
    engine.zeta_term[i] = particle.g = 0.0;
    if (!rows.is_fluid(i, not_fluid)) return;
    engine.zeta_term[i] = rows.zeta(i, bound) * engine.density[i].cdot / engine.density[i].c;
    if (by_density) particle.g = pressure_term(engine.zeta_term[i], particle.vol, engine.weight(i));
  });
}

/* ---------------------------------------------------------------------- */

double PressureStage::elastic_energy(double *each_atom, int not_fluid) const
{
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

void StateStage::advance(int not_fluid, const std::vector<double> &noise) const
{
  const StateRows states = engine.states();
  const Parameters &par = engine.parameters();
  const int nlocal = atom->nlocal, end = nlocal ? noise.size() / nlocal : 0;
  engine.for_each(nlocal, [&](int i) {
    if (par.type[atom->type[i]].other || (atom->mask[i] & not_fluid))
      states.forget(i);
    else
      states.advance(i, noise.data() + i, nlocal, end);
  });
}

/* ---------------------------------------------------------------------- */

std::pair<bigint, int> StateStage::keep() const
{
  const StateRows states = engine.states();
  bigint mine = 0;
  int bits = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    const int others = States::keep(states, i);
    if (others) mine++;
    bits |= others;
  }
  return {over_all(world, mine, MPI_SUM), over_all(world, bits, MPI_BOR)};
}

/* ---------------------------------------------------------------------- */

double StateStage::energy(int groupbits, int not_fluid) const
{
  const StateRows states = engine.states();
  double total = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & groupbits) && !(atom->mask[i] & not_fluid)) total += states.energy(i);
  return total;
}

/* ---------------------------------------------------------------------- */

void FlowStage::run(const std::function<void(std::vector<double> &)> &add)
{
  Flows::visit(engine.parameters().loops_of_flows, [&](auto channel, int k) {
    std::vector<double> &rate = engine.flow_rate[k];
    engine.accumulate_flow(k, rate);
    if constexpr (std::is_base_of<BaseState, decltype(channel)>::value)
      exchange.reverse({{rate.data(), 1, 1}});
    else {
      add(rate);
      double *const desph = atom->desph;
      engine.for_each(nforce(), [&](int i) {
        desph[i] += rate[i];
      });
    }
  });
}

void FlowStage::forget()
{
  for (auto &rate : engine.flow_rate) rate.clear();
}

double FlowStage::received(int groupbit) const
{
  const std::vector<double> &heat = engine.flow_rate[HEAT_FLOW];
  return engine.team().sum<double>(nforce(), [&](int i, double &total) {
    if (atom->mask[i] & groupbit) total += heat[i];
  });
}

/* ----------------------------------------------------------------------
   The pressure is the pressure of the equation of state: strains do not change.
------------------------------------------------------------------------- */

void DiffusionStage::evaluate(int not_fluid, int integrated)
{
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

  const double factor = par.delta * par.support / (alike ? impedances[0] : 1.0);
  engine.for_each(atom->nlocal, [&](int i) {
    volume_rates(rows[i].a + vol, flow_of + 2 * i, factor, fields.vol_rate[i], fields.vol_heat[i]);
  });
}

/* ---------------------------------------------------------------------- */

void DiffusionStage::add_heat(int not_fluid, int integrated) const
{
  const Fields &fields = *Fields::of(atom);
  double *const desph = atom->desph;
  engine.for_each(atom->nlocal, [&](int i) {
    if (!engine.rows().diffuses(i, not_fluid, integrated))
      fields.vol_rate[i] = fields.vol_heat[i] = 0.0;
    desph[i] += fields.vol_heat[i];
  });
}

/* ---------------------------------------------------------------------- */

void DiffusionStage::set_rows(int not_fluid, int integrated)
{
  const ParticleRows &of = engine.rows();
  const int nall = atom->nlocal + atom->nghost;
  rows.resize(nall + BLOCK);
  impedances.resize(nall + BLOCK);
  engine.for_each(nall, [&](int i) {
    of.set_diffusion(i, not_fluid, integrated, rows[i], impedances[i]);
  });
  std::fill_n(rows.begin() + nall, BLOCK, DiffusionRow());
  std::fill_n(impedances.begin() + nall, BLOCK, 1.0);
}

/* ---------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Return the number of steps between two shifts: at most the time in which sound crosses the support radius.
------------------------------------------------------------------------- */

int ShiftStage::interval() const
{
  constexpr int MOST = 8;
  const Parameters &par = engine.parameters();
  double fastest = 0.0;
  for (int i = 1; i < par.ntypes_1; i++) fastest = std::max(fastest, par.type[i].eos.c0);
  const double way = fastest * update->dt;
  return (MOST * way <= par.support) ? MOST : std::max(1, static_cast<int>(par.support / way));
}

ShiftLaw ShiftStage::law() const
{
  const Parameters &par = engine.parameters();
  return {par.dim, par.support, interval() * update->dt,
          kernel_slope_integral(par.kernel, par.dim, par.support), par.continuity};
}

template <class Sum, class Add> const Sum *ShiftStage::sum_up(const Add &add)
{
  constexpr int WIDTH = sizeof(Sum) / sizeof(double);
  sums.assign(WIDTH * rows.size(), 0.0);
  engine.sum_pairs(thread_sums, sums.data(), sums.size(),
                   [&](int i, int j, bigint entry, double *total) {
                     auto *const sum = reinterpret_cast<Sum *>(total);
                     add(i, j, entry, sum[i], sum[j]);
                   });
  exchange.reverse({{sums.data(), WIDTH, WIDTH}});
  return reinterpret_cast<const Sum *>(sums.data());
}

void ShiftStage::run(double keep)
{
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  const ShiftLaw law = this->law();
  const Particle *const particle = engine.particle;
  rows.resize(nall);
  with_kernel(engine.parameters().kernel, [&](auto kernel) {
    engine.for_each(nall, [&](int i) {
      const double vol = particle[i].vol;
      ShiftRow &row = rows[i];
      row = ShiftRow();
      row.mass = atom->rmass[i];
      row.contact = contact_inverse<decltype(kernel)>(law.dim, law.support, vol);
      for (const ShiftMover &mover : movers)
        if (atom->mask[i] & mover.groupbit) let_shift(mover, law.support, vol, row);
      for (int d = 0; d < 3; d++) row.v[d] = atom->v[i][d] - particle[i].u[d];
    });
    const auto crowding =
        sum_up<ShiftSum>([&](int i, int j, bigint entry, ShiftSum &a, ShiftSum &b) {
          const Particle &p = particle[i], &q = particle[j];
          double r[3], u[3], back[3], other[3];
          MathExtra::sub3(p.x, q.x, r);
          MathExtra::sub3(p.u, q.u, u);
          MathExtra::sub3(q.x, p.x, back);
          MathExtra::sub3(q.u, p.u, other);
          const double slope = engine.slope(i, j, entry);
          const double shape = kernel.shape(MathExtra::len3(r) / law.support);
          const double share = shift_share(slope, rows[i], rows[j]);
          const double push_i = concentration_push(q.vol, slope, shape, rows[i].contact);
          const double push_j = concentration_push(p.vol, slope, shape, rows[j].contact);
          add_to_shift(law, r, u, q.vol, slope, push_i, share, a);
          add_to_shift(law, back, other, p.vol, slope, push_j, share, b);
        });
    engine.for_each(nlocal, [&](int i) {
      set_shift(law, crowding[i], rows[i]);
    });
    return 0;
  });
  exchange.forward({field(rows.data(), rows[0].q, 6)});

  const auto share_of = [&](int i, int j, bigint entry) {
    return shift_share(engine.slope(i, j, entry), rows[i], rows[j]);
  };
  const auto velocities = [&](int i, int j, double *v, double *w) {
    velocity_in_shift(rows[i], particle[i].u, v);
    velocity_in_shift(rows[j], particle[j].u, w);
  };
  const auto exchanged =
      sum_up<ShiftExchange>([&](int i, int j, bigint entry, ShiftExchange &a, ShiftExchange &b) {
        const double share = share_of(i, j, entry);
        if (share == 0.0) return;
        double v[3], w[3];
        velocities(i, j, v, w);
        for (int d = 0; d < 3; d++) {
          a.moved[d] += share * rows[j].q[d];
          b.moved[d] += share * rows[i].q[d];
          a.slip[d] += share * (v[d] - w[d]);
          b.slip[d] -= share * (v[d] - w[d]);
        }
      });
  engine.for_each(nlocal, [&](int i) {
    set_displacement(exchanged[i], rows[i]);
  });
  exchange.forward({field(rows.data(), rows[0].d, 3)});

  const auto distance = [&](int i, int j, double *r) {
    for (int d = 0; d < 3; d++)
      r[d] = particle[i].x[d] - particle[j].x[d] + (rows[i].d[d] - rows[j].d[d]);
  };
  const auto tensors =
      sum_up<ShiftTensor>([&](int i, int j, bigint entry, ShiftTensor &a, ShiftTensor &b) {
        const double share = share_of(i, j, entry);
        if (share == 0.0) return;
        double r[3];
        distance(i, j, r);
        add_square(law.dim, share, r, a.a);
        add_square(law.dim, share, r, b.a);
      });
  engine.for_each(nlocal, [&](int i) {
    set_return(law.dim, tensors[i], rows[i]);
  });
  exchange.forward({field(rows.data(), rows[0].w, 3)});

  const auto returned =
      sum_up<ShiftReturn>([&](int i, int j, bigint entry, ShiftReturn &a, ShiftReturn &b) {
        const double share = share_of(i, j, entry);
        if (share == 0.0) return;
        double r[3], v[3], w[3], push[3];
        distance(i, j, r);
        velocities(i, j, v, w);
        const double work = impulse_of_pair(share, rows[i], rows[j], v, w, r, push);
        for (int d = 0; d < 3; d++) {
          a.impulse[d] += push[d];
          b.impulse[d] -= push[d];
        }
        a.work += work;
        b.work -= work;
      });
  engine.for_each(nlocal, [&](int i) {
    if (rows[i].vol > 0.0)
      finish_shift(rows[i], returned[i], update->dt, keep, force->mvv2e, atom->x[i], atom->v[i],
                   atom->vest[i], atom->esph[i]);
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

void ForceStage::collect()
{
  exchange.reverse({field(engine.force, engine.force->f, 3), engine.torques()});
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
