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

#include "sph_dissipation_open_stage.h"

#include "atom.h"
#include "math_extra.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_particle_terms.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

void OpenImpact::add(const Particle &particle, const ForceSum &sum, double heat)
{
  double moment[3];
  MathExtra::cross3(particle.x, sum.f, moment);
  for (int d = 0; d < 3; d++) {
    force[d] += sum.f[d];
    torque[d] += moment[d];
    power += sum.f[d] * particle.u[d];
  }
  power += sum.heat + heat;
}

void OpenImpact::add(const Spin &spin, const double *couple)
{
  for (int d = 0; d < 3; d++) {
    torque[d] += couple[d];
    power += couple[d] * spin.w[d];
  }
}

/* ---------------------------------------------------------------------- */

void OpenStage::add(OpenZone *zone)
{
  remove(zone);
  zones.push_back(zone);
  zone_bits |= zone->zone_bit();
}

/* ---------------------------------------------------------------------- */

void OpenStage::remove(OpenZone *zone)
{
  zones.erase(std::remove(zones.begin(), zones.end(), zone), zones.end());
  zone_bits = 0;
  for (const auto &one : zones) zone_bits |= one->zone_bit();
}

/* ---------------------------------------------------------------------- */

int OpenStage::bits_of(int fluid_bit) const
{
  int bits = 0;
  for (const auto &one : zones)
    if (one->fluid_bit() == fluid_bit) bits |= one->zone_bit();
  return bits;
}

/* ---------------------------------------------------------------------- */

double OpenStage::state_energy(int i) const
{
  return engine.constants().states ? engine.states().energy(i) : 0.0;
}

/* ---------------------------------------------------------------------- */

void OpenStage::run()
{
  set_states();
  const OpenGroups now = groups();
  zone_of.resize(atom->nlocal + atom->nghost);
  for (int i = 0; i < atom->nlocal; i++) zone_of[i] = now.zone_of(atom->mask[i]);
  Particle *const particle = engine.particle;
  exchange.forward({field(particle, &particle->vol, 2), {zone_of.data(), 1, 1}});
  Flows::visit(engine.constants().flows, [&](auto, int k) {
    FlowRow *const row = engine.flow[k].data();
    exchange.forward({field(row, &row->vol, 3)});
  });
  update_ghosts(now);
}

/* ---------------------------------------------------------------------- */

void OpenStage::set_states()
{
  std::vector<double> mine;
  std::vector<std::size_t> first;    // index of the first number of each zone
  for (auto *zone : zones) {
    first.push_back(mine.size());
    zone->measure(*this, mine);
  }
  std::vector<double> sums(mine.size());
  MPI_Allreduce(mine.data(), sums.data(), static_cast<int>(mine.size()), MPI_DOUBLE, MPI_SUM,
                world);
  for (std::size_t k = 0; k < zones.size(); k++)
    zones[k]->set_states(*this, sums.data() + first[k]);
}

/* ---------------------------------------------------------------------- */

void OpenStage::set_state(int i, double rho, double pressure)
{
  if (engine.constants().bulk == Bulk::DENSITY) pressure += engine.zeta_term[i];
  engine.rows().set_state(i, rho, pressure);
}

/* ---------------------------------------------------------------------- */

void OpenStage::set_temperature(int i, double temperature)
{
  if (!engine.constants().conducts()) return;
  engine.rows().set_flow(HEAT_FLOW, i, 0);
  engine.heat()[i].value = temperature;
}

/* ---------------------------------------------------------------------- */

OpenGroups OpenStage::groups() const
{
  OpenGroups all;
  for (const auto &zone : zones) {
    all.fluid[all.n] = zone->fluid_bit();
    all.zone[all.n++] = zone->zone_bit();
  }
  return all;
}

/* ----------------------------------------------------------------------
   Set density and group of ghost particles to the values of their owners.
------------------------------------------------------------------------- */

void OpenStage::update_ghosts(const OpenGroups &now)
{
  for (int i = atom->nlocal; i < atom->nlocal + atom->nghost; i++) {
    atom->mask[i] = now.mask_in(zone_of[i], atom->mask[i]);
    if (!(zone_of[i] > 0.0)) continue;
    atom->vfrac[i] = engine.particle[i].vol;
    atom->rho[i] = atom->rmass[i] / atom->vfrac[i];
  }
}

/* ---------------------------------------------------------------------- */

void OpenStage::sum_impacts(NeighList *list)
{
  if (neighbor->ago == 0 || rows.size() != zones.size()) find_rows(list);
  for (std::size_t k = 0; k < zones.size(); k++) zones[k]->set_impact(impact(list, k));
}

/* ----------------------------------------------------------------------
   Find the rows of the neighbor list near the plane of each zone: these rows have all pairs of zone and fluid.
------------------------------------------------------------------------- */

void OpenStage::find_rows(NeighList *list)
{
  const double reach = engine.constants().support + neighbor->skin;
  rows.assign(zones.size(), {});
  for (int ii = 0; ii < list->inum; ii++)
    for (std::size_t k = 0; k < zones.size(); k++)
      if (zones[k]->zone_near(atom->x[list->ilist[ii]], reach)) rows[k].push_back(ii);
}

/* ----------------------------------------------------------------------
   Sum up the impact of a zone on the fluid, over their pairs: force, couple, half of the heat of shear and spin, the heat of
   conduction, and the part P V w_j (-F r.u) / c of the work of the pressure.
------------------------------------------------------------------------- */

OpenImpact OpenStage::impact(NeighList *list, std::size_t k)
{
  const double zone = static_cast<double>(k + 1);
  const Particle *const particle = engine.particle;
  const bool by_volume = (engine.constants().bulk == Bulk::VOLUME);
  const bool conducts = engine.constants().conducts();

  // with newton off, the owner of a ghost atom sums the same pair itself

  const int mine = nforce();

  OpenImpact total = OpenImpact();
  pairs.begin();
  for (const int ii : rows[k]) {
    pairs.add_row(list->ilist[ii]);
    engine.visit_pairs(ii, [&](int i, int j, bigint entry) {
      if (!(zone_of[i] == zone && zone_of[j] == 0.0) && !(zone_of[j] == zone && zone_of[i] == 0.0))
        return;
      const double slope = engine.slope(i, j, entry);
      pairs.add(j, slope);
      const int fluid = (zone_of[i] == 0.0) ? i : j, other = (zone_of[i] == 0.0) ? j : i;
      if (fluid >= mine) return;
      const Particle &f = particle[fluid], &z = particle[other];
      double flux = 0.0;
      for (int d = 0; d < 3; d++) flux += slope * (f.x[d] - z.x[d]) * (f.u[d] - z.u[d]);
      total.power -= engine.weight(fluid) * engine.weight(other) * f.g * flux;
      if (by_volume) total.power -= engine.zeta_term[fluid] * f.vol * z.vol * flux;
    });
    pairs.end_row(engine.pairs().spare);
  }

  const std::size_t nrow = (std::size_t) atom->nlocal + atom->nghost + BLOCK;
  forces.resize(std::max(forces.size(), nrow));
  divergence.resize(forces.size());
  side.set(engine.side.columns);
  side.resize(forces.size());
  engine.accumulate_forces(pairs, forces.data(), side, divergence.data());
  if (conducts) {
    flow.resize(nrow);
    engine.accumulate_flow(HEAT_FLOW, pairs, flow.data());
  }

  pairs.visit([&](int i) {
    if (i < mine && zone_of[i] == 0.0) {
      total.add(particle[i], forces[i], side.heat(i));
      if (engine.has_spin()) total.add(engine.spin[i], side.torque(i));
      if (conducts) total.power += flow[i];
    }
    forces[i] = ForceSum();
    divergence[i] = 0.0;
    if (conducts) flow[i] = 0.0;
    side.clear(i);
  });
  return total;
}
