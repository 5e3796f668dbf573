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

/* ----------------------------------------------------------------------
   Contributing authors: the SPH-DISSIPATION authors
------------------------------------------------------------------------- */

#include "compute_sph_energy.h"

#include "atom.h"
#include "error.h"
#include "force.h"
#include "math_extra.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_keywords.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

enum { KINETIC, INTERNAL, ROTATIONAL, STATES, PAIRS, NENERGY };    // states: a part of internal

/* ---------------------------------------------------------------------- */

ComputeSPHEnergy::ComputeSPHEnergy(LAMMPS *lmp, int narg, char **arg) : Compute(lmp, narg, arg)
{
  Keywords(lmp, fmt::format("Compute {}", style), 3, narg, arg).end_here();
  if (!atom->esph_flag || !atom->rmass_flag)
    error->all(FLERR, "Compute {} requires atom style sph/bulk or sph/micropolar", style);

  scalar_flag = vector_flag = 1;
  size_vector = NENERGY;
  extscalar = extvector = 1;
  vector = new double[size_vector];
}

/* ---------------------------------------------------------------------- */

ComputeSPHEnergy::~ComputeSPHEnergy()
{
  delete[] vector;
}

/* ---------------------------------------------------------------------- */

double ComputeSPHEnergy::compute_scalar()
{
  compute_vector();
  invoked_scalar = update->ntimestep;
  scalar = vector[KINETIC] + vector[INTERNAL] + vector[ROTATIONAL] + vector[PAIRS];
  return scalar;
}

/* ---------------------------------------------------------------------- */

void ComputeSPHEnergy::compute_vector()
{
  invoked_vector = update->ntimestep;

  const double *const rmass = atom->rmass;
  const Fields *const fields = Fields::with_spins(atom);

  double energy[NENERGY] = {};
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    energy[KINETIC] += rmass[i] * MathExtra::lensq3(atom->v[i]);
    energy[INTERNAL] += atom->esph[i];
    if (fields)
      energy[ROTATIONAL] += rmass[i] * fields->inertia[i] * MathExtra::lensq3(atom->omega[i]);
  }
  energy[KINETIC] *= 0.5 * force->mvv2e;
  energy[ROTATIONAL] *= 0.5 * force->mvv2e;
  if (const Fluid *fluid = find_fluid(force)) {
    energy[STATES] = fluid->state_energy(groupbit);
    if (fluid->has_pair_energy()) {
      if (!fluid->is_set_up() || !fluid->has_forces())
        error->all(FLERR, "Compute {} needs the forces of the present particles: use run 0 first",
                   style);
      energy[PAIRS] = fluid->pair_energy(groupbit);
    }
  }
  MPI_Allreduce(energy, vector, NENERGY, MPI_DOUBLE, MPI_SUM, world);
}
