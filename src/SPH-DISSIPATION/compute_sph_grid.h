/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(sph/grid,ComputeSPHGrid);
// clang-format on
#else

#ifndef LMP_COMPUTE_SPH_GRID_H
#define LMP_COMPUTE_SPH_GRID_H

#include "sph_dissipation_grid.h"

namespace LAMMPS_NS {

// Fields of the fluid on a regular grid, for dump grid and fix ave/grid.

class ComputeSPHGrid : public SPHDissipation::GridCompute {
 public:
  ComputeSPHGrid(class LAMMPS *, int, char **);
  ~ComputeSPHGrid() override;
  void compute_pergrid() override;
  void reset_grid() override;
  int get_grid_by_name(const std::string &, int &) override;
  void *get_grid_by_index(int) override;
  int get_griddata_by_name(int, const std::string &, int &) override;
  void *get_griddata_by_index(int) override;
  double memory_usage() override;

 private:
  // one of these is in use, by the dimension and by one or more values per point

  double **vector2d = nullptr, ***vector3d = nullptr;
  double ***array2d = nullptr, ****array3d = nullptr;

  void allocate();
  void deallocate();
};

}    // namespace LAMMPS_NS

#endif
#endif
