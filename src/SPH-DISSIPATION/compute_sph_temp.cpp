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

#include "compute_sph_temp.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_keywords.h"
#include "sph_dissipation_model.h"
#include "update.h"

#include <algorithm>
#include <vector>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

enum { SPIN = 3, INTERNAL, NVALUE };    // after the three directions

/* ---------------------------------------------------------------------- */

ComputeSPHTemp::ComputeSPHTemp(LAMMPS *lmp, int narg, char **arg) : Compute(lmp, narg, arg)
{
  Keywords(lmp, fmt::format("Compute {}", style), 3, narg, arg).end_here();

  scalar_flag = vector_flag = 1;
  size_vector = NVALUE;
  extscalar = extvector = 0;
  vector = new double[size_vector];
}

/* ---------------------------------------------------------------------- */

ComputeSPHTemp::~ComputeSPHTemp()
{
  delete[] vector;
}

/* ---------------------------------------------------------------------- */

void ComputeSPHTemp::init()
{
  if (!Fields::of(atom))
    error->all(FLERR, "Compute {} requires atom style sph/bulk or sph/micropolar", style);
}

/* ----------------------------------------------------------------------
   Set the temperature of each direction, relative to the mean velocity of the group: N-1 degrees of freedom, whether the
   momentum of the group is constant or not.
------------------------------------------------------------------------- */

void ComputeSPHTemp::translational(double *temperature) const
{
  double **const v = atom->v;
  const double *const rmass = atom->rmass;

  enum { MASS, NUMBER, MOMENTUM, NSUM = 5 };
  double own[NSUM] = {}, all[NSUM];
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    own[MASS] += rmass[i];
    own[NUMBER] += 1.0;
    for (int d = 0; d < 3; d++) own[MOMENTUM + d] += rmass[i] * v[i][d];
  }
  MPI_Allreduce(own, all, NSUM, MPI_DOUBLE, MPI_SUM, world);
  const double count = all[NUMBER];
  std::fill(temperature, temperature + 3, 0.0);
  if (count < 2.0) return;

  double square[3] = {};
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    for (int d = 0; d < 3; d++) {
      const double u = v[i][d] - all[MOMENTUM + d] / all[MASS];
      square[d] += rmass[i] * u * u;
    }
  }
  MPI_Allreduce(square, temperature, 3, MPI_DOUBLE, MPI_SUM, world);
  for (int d = 0; d < 3; d++) temperature[d] *= force->mvv2e / (force->boltz * (count - 1.0));
}

/* ---------------------------------------------------------------------- */

double ComputeSPHTemp::rotational() const
{
  const Fields *const fields = Fields::with_spins(atom);
  if (!fields) return 0.0;
  double own[2] = {}, all[2];    // particles with inertia, and their J omega^2
  for (int i = 0; i < atom->nlocal; i++) {
    const double inertia = atom->rmass[i] * fields->inertia[i];
    if (!(atom->mask[i] & groupbit) || !(inertia > 0.0)) continue;
    const double *const omega = atom->omega[i];
    own[0] += 1.0;
    own[1] += inertia * (omega[0] * omega[0] + omega[1] * omega[1] + omega[2] * omega[2]);
  }
  MPI_Allreduce(own, all, 2, MPI_DOUBLE, MPI_SUM, world);
  const int axes = (domain->dimension == 2) ? 1 : 3;
  return (all[0] > 0.0) ? force->mvv2e * all[1] / (force->boltz * axes * all[0]) : 0.0;
}

/* ----------------------------------------------------------------------
   Return the temperature of the heat of the particles, sum of Q_i over sum of C_i.
------------------------------------------------------------------------- */

double ComputeSPHTemp::internal() const
{
  const auto *const fluid = SPHDissipation::find_fluid(force);
  if (!fluid || !fluid->model->has_temperatures()) return 0.0;
  if (!fluid->is_set_up())
    error->all(FLERR,
               "Compute {} needs the coefficients of the present pair style: use run 0 "
               "first",
               style);
  std::vector<double> temperatures(atom->nlocal);
  fluid->temperatures(temperatures.data());
  double own[2] = {}, all[2];    // heat capacity and heat
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit) || !fluid->has_type(atom->type[i]) || fluid->is_boundary(i))
      continue;
    const double capacity = atom->rmass[i] * fluid->model->heat_capacity(atom->type[i]);
    own[0] += capacity;
    own[1] += capacity * temperatures[i];
  }
  MPI_Allreduce(own, all, 2, MPI_DOUBLE, MPI_SUM, world);
  return (all[0] > 0.0) ? all[1] / all[0] : 0.0;
}

/* ----------------------------------------------------------------------
   Return the mean of the directions in which particles move.
------------------------------------------------------------------------- */

double ComputeSPHTemp::compute_scalar()
{
  invoked_scalar = update->ntimestep;
  double temperature[3];
  translational(temperature);
  scalar = 0.0;
  for (int d = 0; d < domain->dimension; d++) scalar += temperature[d] / domain->dimension;
  return scalar;
}

/* ---------------------------------------------------------------------- */

void ComputeSPHTemp::compute_vector()
{
  invoked_vector = update->ntimestep;
  translational(vector);
  vector[SPIN] = rotational();
  vector[INTERNAL] = internal();
}
