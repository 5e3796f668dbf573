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

#include "compute_sph_angmom.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "group.h"
#include "math_extra.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_keywords.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

enum { TOTAL = 0, ORBITAL = 3, SPIN = 6, NVALUE = 9 };

/* ---------------------------------------------------------------------- */

ComputeSPHAngmom::ComputeSPHAngmom(LAMMPS *lmp, int narg, char **arg) : Compute(lmp, narg, arg)
{
  if (!Fields::with_spins(atom))
    error->all(FLERR, "Compute {} requires atom style sph/micropolar", style);

  for (Keywords key(lmp, fmt::format("Compute {}", style), 3, narg, arg); key.next();)
    if (key.is("point", "x y z")) {
      fixed_point = 1;
      for (int d = 0; d < 3; d++) point[d] = key.number(d);
    }

  vector_flag = 1;
  size_vector = NVALUE;
  extvector = 1;
  vector = new double[size_vector];
}

/* ---------------------------------------------------------------------- */

ComputeSPHAngmom::~ComputeSPHAngmom()
{
  delete[] vector;
}

/* ---------------------------------------------------------------------- */

void ComputeSPHAngmom::compute_vector()
{
  invoked_vector = update->ntimestep;
  if (!fixed_point) group->xcm(igroup, group->mass(igroup), point);

  const double *const inertia = Fields::of(atom)->inertia;
  const double *const rmass = atom->rmass;
  double sum[NVALUE] = {};

  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    double x[3], moment[3];
    domain->unmap(atom->x[i], atom->image[i], x);
    for (int d = 0; d < 3; d++) x[d] -= point[d];
    MathExtra::cross3(x, atom->v[i], moment);
    for (int d = 0; d < 3; d++) {
      sum[ORBITAL + d] += rmass[i] * moment[d];
      sum[SPIN + d] += rmass[i] * inertia[i] * atom->omega[i][d];
    }
  }
  for (int d = 0; d < 3; d++) sum[TOTAL + d] = sum[ORBITAL + d] + sum[SPIN + d];
  MPI_Allreduce(sum, vector, NVALUE, MPI_DOUBLE, MPI_SUM, world);
}
