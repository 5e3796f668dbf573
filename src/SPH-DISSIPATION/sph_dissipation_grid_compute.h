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

#ifndef LMP_SPH_DISSIPATION_GRID_COMPUTE_H
#define LMP_SPH_DISSIPATION_GRID_COMPUTE_H

#include "compute.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {
  class Fluid;
  class ParticleGrid;

  // A compute of the fluid on a grid: compute ID group style Nx Ny Nz ... order 0|1.  It makes the grid
  // and maps values of the particles to it.

  class GridCompute : public Compute {
   public:
    GridCompute(class LAMMPS *, int, char **);
    ~GridCompute() override;
    void init() override;
    void reset_grid() override;
    int pack_forward_comm(int, int *, double *, int, int *) override;
    void unpack_forward_comm(int, int, double *) override;
    double memory_usage() override;

   protected:
    int count[3];    // points
    bool linear;     // order 1
    ParticleGrid *grid;

    bool add_value(const std::string &);    // a value of the particles to map; false if unknown
    int nvalue() const { return static_cast<int>(names.size()); }
    bool order_keyword(int &iarg, int narg, char **arg);

    Fluid *fluid() const;
    bool is_mapped(const Fluid *, int) const;    // owned particle
    bigint map();    // all values, to ParticleGrid::field(); points without particles, of all ranks

   private:
    using Value = double (GridCompute::*)(int) const;

    std::vector<std::string> names;
    std::vector<Value> getters;
    int nmax;
    double **values;    // of owned and ghost particles: volume (0: not mapped), then those to map

    template <int DIM> double velocity(int) const;
    template <int DIM> double spin(int) const;
    double density(int) const;
    double energy(int) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
