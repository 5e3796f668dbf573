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

#include "sph_dissipation_density.h"

#include "atom.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   particles of other styles keep their density
------------------------------------------------------------------------- */

void DensityStage::run(NeighList *list, double **vest, double **omegaest)
{
  engine.accumulate_density(list, vest, omegaest);

  DensitySum *const density = engine.density;
  const Field sums = field(density, &density->c, 2);
  exchange.reverse({sums});
  if (engine.parameters().eos == Eos::IDEAL)    // which needs the energy of ghost atoms
    exchange.forward({sums, {atom->esph, 1, 1}});
  else
    exchange.forward({sums});

  const double *const rmass = atom->rmass;
  const int *const type = atom->type;
  const Parameters &par = engine.parameters();
  double *const rho = atom->rho;
  double *const drho = atom->drho;
  double *const vfrac = atom->vfrac;
  const int nall = atom->nlocal + atom->nghost;
  engine.for_each(nall, [&](int i) {
    const double weight = engine.weight(i);
    engine.particle[i].vol = weight / density[i].c;
    if (par.shared && par.type[type[i]].other) return;
    const double mass = rmass[i] / weight;
    rho[i] = mass * density[i].c;
    drho[i] = mass * density[i].cdot;
    vfrac[i] = engine.particle[i].vol;
  });
}
