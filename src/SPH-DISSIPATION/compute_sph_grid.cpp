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

#include "compute_sph_grid.h"

#include "domain.h"
#include "error.h"
#include "memory.h"
#include "sph_dissipation_keywords.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

ComputeSPHGrid::ComputeSPHGrid(LAMMPS *lmp, int narg, char **arg) : GridCompute(lmp, narg, arg)
{
  int iarg = 6;
  while (iarg < narg && add_value(arg[iarg])) iarg++;
  for (Keywords key(lmp, fmt::format("Compute {}", style), iarg, narg, arg); key.next();)
    read_order(key);
  if (nvalue() == 0) error->all(FLERR, "Compute {} needs at least one value", style);
  allocate();
}

/* ---------------------------------------------------------------------- */

ComputeSPHGrid::~ComputeSPHGrid()
{
  deallocate();
}

/* ----------------------------------------------------------------------
   Allocate arrays in the layout of LAMMPS's grids.
------------------------------------------------------------------------- */

void ComputeSPHGrid::allocate()
{
  const int *const lo = grid->ghost_lo, *const hi = grid->ghost_hi;
  if (domain->dimension == 2) {
    if (nvalue() == 1)
      memory->create2d_offset(vector2d, lo[1], hi[1], lo[0], hi[0], "sph/grid:vector2d");
    else
      memory->create3d_offset_last(array2d, lo[1], hi[1], lo[0], hi[0], nvalue(),
                                   "sph/grid:array2d");
  } else {
    if (nvalue() == 1)
      memory->create3d_offset(vector3d, lo[2], hi[2], lo[1], hi[1], lo[0], hi[0],
                              "sph/grid:vector3d");
    else
      memory->create4d_offset_last(array3d, lo[2], hi[2], lo[1], hi[1], lo[0], hi[0], nvalue(),
                                   "sph/grid:array3d");
  }
}

/* ---------------------------------------------------------------------- */

void ComputeSPHGrid::deallocate()
{
  const int *const lo = grid->ghost_lo;
  memory->destroy2d_offset(vector2d, lo[1], lo[0]);
  memory->destroy3d_offset_last(array2d, lo[1], lo[0]);
  memory->destroy3d_offset(vector3d, lo[2], lo[1], lo[0]);
  memory->destroy4d_offset_last(array3d, lo[2], lo[1], lo[0]);
}

/* ---------------------------------------------------------------------- */

void ComputeSPHGrid::reset_grid()
{
  deallocate();
  GridCompute::reset_grid();
  allocate();
}

/* ---------------------------------------------------------------------- */

void ComputeSPHGrid::compute_pergrid()
{
  invoked_pergrid = update->ntimestep;
  map();

  const int *const lo = grid->lo, *const hi = grid->hi;
  for (int k = 0; k < nvalue(); k++) {
    const double *value = grid->field(k);
    for (int iz = lo[2]; iz <= hi[2]; iz++)
      for (int iy = lo[1]; iy <= hi[1]; iy++)
        for (int ix = lo[0]; ix <= hi[0]; ix++, value++) {
          if (vector2d)
            vector2d[iy][ix] = *value;
          else if (array2d)
            array2d[iy][ix][k] = *value;
          else if (vector3d)
            vector3d[iz][iy][ix] = *value;
          else
            array3d[iz][iy][ix][k] = *value;
        }
  }
}

/* ----------------------------------------------------------------------
   The only grid has the name "grid"; the only data on this grid have the name "data".
------------------------------------------------------------------------- */

int ComputeSPHGrid::get_grid_by_name(const std::string &name, int &dim)
{
  if (name != "grid") return -1;
  dim = domain->dimension;
  return 0;
}

/* ---------------------------------------------------------------------- */

void *ComputeSPHGrid::get_grid_by_index(int index)
{
  if (index != 0) return nullptr;
  if (domain->dimension == 2) return grid->lammps_grid2d();
  return grid->lammps_grid3d();
}

/* ---------------------------------------------------------------------- */

int ComputeSPHGrid::get_griddata_by_name(int igrid, const std::string &name, int &ncol)
{
  if (igrid != 0 || name != "data") return -1;
  ncol = (nvalue() == 1) ? 0 : nvalue();
  return 0;
}

/* ---------------------------------------------------------------------- */

void *ComputeSPHGrid::get_griddata_by_index(int index)
{
  if (index != 0) return nullptr;
  if (domain->dimension == 2) return (nvalue() == 1) ? (void *) vector2d : (void *) array2d;
  return (nvalue() == 1) ? (void *) vector3d : (void *) array3d;
}

/* ---------------------------------------------------------------------- */

double ComputeSPHGrid::memory_usage()
{
  return GridCompute::memory_usage() + (double) grid->npoint() * nvalue() * sizeof(double);
}
