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

#include "compute_sph_dissipation.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_keywords.h"
#include "sph_dissipation_stages.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

ComputeSPHDissipation::ComputeSPHDissipation(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg)
{
  Keywords(lmp, fmt::format("Compute {}", style), 3, narg, arg).end_here();
  if (igroup != 0) error->all(FLERR, "Compute {} must use group all", style);

  scalar_flag = vector_flag = peratom_flag = 1;
  size_vector = Fluid::number_of_heats();
  size_peratom_cols = 0;
  extscalar = extvector = 1;
  comm_reverse = 1;
  vector = new double[size_vector];
}

/* ---------------------------------------------------------------------- */

ComputeSPHDissipation::~ComputeSPHDissipation()
{
  delete[] vector;
}

/* ---------------------------------------------------------------------- */

void ComputeSPHDissipation::init()
{
  find_fluid(lmp, fmt::format("Compute {}", style));
}

/* ----------------------------------------------------------------------
   Get the heat of each particle (not if nullptr) and the total power by channel.  Look the fluid up at every use, because
   another pair style may have replaced the last one.
------------------------------------------------------------------------- */

void ComputeSPHDissipation::collect(double *heat_of_each, double *power)
{
  const Fluid *const fluid = find_fluid(lmp, fmt::format("Compute {}", style));
  if (!fluid->has_forces())
    error->all(FLERR, "Compute {} needs the forces of the present particles: use run 0 first",
               style);

  std::vector<double> own(size_vector);
  fluid->heating(heat_of_each, own.data());
  MPI_Allreduce(own.data(), power, size_vector, MPI_DOUBLE, MPI_SUM, world);
}

/* ---------------------------------------------------------------------- */

double ComputeSPHDissipation::compute_scalar()
{
  compute_vector();
  invoked_scalar = update->ntimestep;
  scalar = 0.0;
  for (int k = 0; k < size_vector; k++) scalar += vector[k];
  return scalar;
}

/* ---------------------------------------------------------------------- */

void ComputeSPHDissipation::compute_vector()
{
  invoked_vector = update->ntimestep;
  collect(nullptr, vector);
}

/* ---------------------------------------------------------------------- */

void ComputeSPHDissipation::compute_peratom()
{
  invoked_peratom = update->ntimestep;
  heat.resize(atom->nmax);
  vector_atom = heat.data();

  std::vector<double> power(size_vector);
  collect(heat.data(), power.data());
  if (force->newton_pair) comm->reverse_comm(this);
}

/* ---------------------------------------------------------------------- */

int ComputeSPHDissipation::pack_reverse_comm(int n, int nfirst, double *buf)
{
  int m = 0;
  for (int i = nfirst; i < nfirst + n; i++) buf[m++] = heat[i];
  return m;
}

/* ---------------------------------------------------------------------- */

void ComputeSPHDissipation::unpack_reverse_comm(int n, int *sendlist, double *buf)
{
  for (int k = 0; k < n; k++) heat[sendlist[k]] += buf[k];
}
