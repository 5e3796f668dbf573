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

#include "compute_sph_dissipation.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_forces.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

ComputeSPHDissipation::ComputeSPHDissipation(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), pair(nullptr), nmax(0), heat(nullptr)
{
  if (narg > 3) error->all(FLERR, "Unknown compute {} keyword: {}", style, arg[3]);
  if (igroup != 0) error->all(FLERR, "Compute {} must use group all", style);

  scalar_flag = vector_flag = peratom_flag = 1;
  size_vector = NCHANNEL;
  size_peratom_cols = 0;
  extscalar = extvector = 1;
  comm_reverse = 1;
  vector = new double[size_vector];
}

/* ---------------------------------------------------------------------- */

ComputeSPHDissipation::~ComputeSPHDissipation()
{
  memory->destroy(heat);
  delete[] vector;
}

/* ---------------------------------------------------------------------- */

void ComputeSPHDissipation::init()
{
  pair = PairSPHBulk::find(force);
  if (!pair) error->all(FLERR, "Compute {} requires pair style sph/bulk or sph/micropolar", style);
}

/* ---------------------------------------------------------------------- */

double ComputeSPHDissipation::compute_scalar()
{
  if (invoked_vector != update->ntimestep) compute_vector();
  invoked_scalar = update->ntimestep;
  scalar = 0.0;
  for (int k = 0; k < size_vector; k++) scalar += vector[k];
  return scalar;
}

/* ---------------------------------------------------------------------- */

void ComputeSPHDissipation::compute_vector()
{
  invoked_vector = update->ntimestep;
  double power[NCHANNEL];
  pair->heating(nullptr, power);
  MPI_Allreduce(power, vector, NCHANNEL, MPI_DOUBLE, MPI_SUM, world);
}

/* ---------------------------------------------------------------------- */

void ComputeSPHDissipation::compute_peratom()
{
  invoked_peratom = update->ntimestep;
  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->destroy(heat);
    memory->create(heat, nmax, "sph/dissipation:heat");
    vector_atom = heat;
  }

  double power[NCHANNEL];
  pair->heating(heat, power);
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

/* ---------------------------------------------------------------------- */

double ComputeSPHDissipation::memory_usage()
{
  return (double) nmax * sizeof(double);
}
