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

#include "sph_dissipation_forces.h"

#include "atom.h"
#include "force.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_particle_terms.h"

#include <algorithm>
#include <iterator>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

int ForceStage::nforce() const
{
  return force->newton_pair ? atom->nlocal + atom->nghost : atom->nlocal;
}

/* ---------------------------------------------------------------------- */

void ForceStage::run(NeighList *list, PairTally *tally)
{
  engine.accumulate_forces(list, tally);

  double **f = atom->f;
  double *const desph = atom->desph;
  const int n = nforce();
  engine.for_each(n, [&](int i) {
    const ForceSum &total = engine.force[i];
    for (int d = 0; d < 3; d++) f[i][d] += total.f[d];
    desph[i] += total.heat + bulk_heat(i);
  });
  if (engine.parameters().drag)
    engine.for_each(atom->nlocal, [&](int i) {
      double channel[NCHANNEL] = {};
      add_drag_heat(i, channel);
      for (const double heat : channel) desph[i] += heat;
    });

  if (!engine.has_spin()) return;
  double **torque = atom->torque;
  engine.for_each(n, [&](int i) {
    const TorqueSum &total = engine.torque[i];
    for (int d = 0; d < 3; d++) torque[i][d] += total.t[d];
    for (const double heat : total.heat) desph[i] += heat;
  });
}

/* ---------------------------------------------------------------------- */

void ForceStage::collect()
{
  const Field f = field(engine.force, engine.force->f, 3);
  if (engine.has_spin())
    exchange.reverse({f, field(engine.torque, engine.torque->t, 3)});
  else
    exchange.reverse({f});
}

/* ----------------------------------------------------------------------
   of the particle itself (density); summed by pairs, also on ghost atoms (volume)
------------------------------------------------------------------------- */

double ForceStage::bulk_heat(int i) const
{
  if (engine.parameters().bulk != Bulk::VOLUME && i >= atom->nlocal) return 0.0;
  return SPHDissipation::bulk_heat(engine.parameters().bulk, engine.zeta_term[i],
                                   engine.particle[i].vol, engine.weight(i), engine.density[i].cdot,
                                   engine.divergence[i]);
}

/* ---------------------------------------------------------------------- */

void ForceStage::add_drag_heat(int i, double *channel) const
{
  double force[3] = {0.0, 0.0, 0.0};
  engine.add_drag(i, false, force, channel);
}

/* ---------------------------------------------------------------------- */

void ForceStage::heating(double *heat, double *power, int not_fluid) const
{
  std::fill(power, power + NCHANNEL, 0.0);
  const int n = nforce();
  for (int i = 0; i < n; i++) {
    if (heat) heat[i] = 0.0;
    if (atom->mask[i] & not_fluid) continue;
    double channel[NCHANNEL] = {engine.force[i].heat, bulk_heat(i)};
    if (engine.has_spin()) {
      std::copy(engine.torque[i].heat, std::end(engine.torque[i].heat), channel + VORTEX);
    }
    if (i < atom->nlocal) add_drag_heat(i, channel);
    for (int k = 0; k < NCHANNEL; k++) {
      if (heat) heat[i] += channel[k];
      power[k] += channel[k];
    }
  }
}
