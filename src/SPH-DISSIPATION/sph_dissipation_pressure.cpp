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

#include "sph_dissipation_pressure.h"

#include "atom.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_particle_terms.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

bool PressureStage::is_beyond(int i, const double *bound) const
{
  return bound && beyond_bound(engine.parameters().type[atom->type[i]].zeta, bound[i]);
}

double PressureStage::bulk_coefficient(int i, const double *bound) const
{
  const Parameters &par = engine.parameters();
  if (par.limit == Limit::YES && is_beyond(i, bound)) return zeta_at_bound(bound[i]);
  return par.type[atom->type[i]].zeta;
}

/* ---------------------------------------------------------------------- */

bigint PressureStage::run(const double *bound, int not_fluid)
{
  const double *const rmass = atom->rmass;
  const double *const rho = atom->rho;
  const double *const esph = atom->esph;
  const int *const type = atom->type;
  const int *const mask = atom->mask;
  double *const desph = atom->desph;
  const int nlocal = atom->nlocal;
  const int nall = nlocal + atom->nghost;
  const Parameters &par = engine.parameters();

  engine.for_each(nall, [&](int i) {
    Particle &particle = engine.particle[i];
    const TypeParameters &of_type = par.type[type[i]];
    if (of_type.other || (mask[i] & not_fluid)) {
      engine.zeta_term[i] = particle.g = 0.0;
      return;
    }

    const ParticleTerms terms =
        particle_terms(par.eos, of_type.eos, par.bulk, bulk_coefficient(i, bound), particle.vol,
                       engine.weight(i), engine.density[i].cdot, rho[i], esph[i] / rmass[i]);
    engine.zeta_term[i] = terms.zeta_term;
    particle.g = terms.g;
    if (i < nlocal) desph[i] += terms.work;
  });

  bigint nbeyond = 0;
  if (bound)
    for (int i = 0; i < nlocal; i++)
      if (!par.type[type[i]].other && !(mask[i] & not_fluid) && is_beyond(i, bound)) nbeyond++;
  return nbeyond;
}

/* ----------------------------------------------------------------------
   the volume of a particle of an open zone is prescribed, its c is not
------------------------------------------------------------------------- */

void PressureStage::set_bulk_term(const double *bound, int not_fluid) const
{
  const Parameters &par = engine.parameters();
  const bool by_density = (par.bulk == Bulk::DENSITY);
  for (int i = 0; i < atom->nlocal + atom->nghost; i++) {
    Particle &particle = engine.particle[i];
    engine.zeta_term[i] = particle.g = 0.0;
    if (par.type[atom->type[i]].other || (atom->mask[i] & not_fluid)) continue;
    engine.zeta_term[i] = bulk_coefficient(i, bound) * engine.density[i].cdot / engine.density[i].c;
    if (by_density) particle.g = pressure_term(engine.zeta_term[i], particle.vol, engine.weight(i));
  }
}

/* ---------------------------------------------------------------------- */

double PressureStage::elastic_energy(double *each_atom, int not_fluid) const
{
  const Parameters &par = engine.parameters();
  double total = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (par.type[atom->type[i]].other || (atom->mask[i] & not_fluid)) continue;
    const double energy = atom->rmass[i] *
        SPHDissipation::elastic_energy(par.eos, par.type[atom->type[i]].eos, atom->rho[i]);
    total += energy;
    if (each_atom) each_atom[i] += energy;
  }
  return total;
}
