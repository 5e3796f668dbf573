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

#ifndef LMP_SPH_DISSIPATION_GRID_H
#define LMP_SPH_DISSIPATION_GRID_H

#include "compute.h"
#include "sph_dissipation_kernel.h"

#include <complex>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class Grid2d;
class Grid3d;

namespace SPHDissipation {
  class Fluid;
  class Keywords;

  // Values of points from values of particles: averages weighted by V W, or (linear) the weighted linear regression through
  // the particles, which is exact for linear fields (moving least squares: P. Lancaster, K. Salkauskas, Math. Comput. 37,
  // 141 (1981)).

  struct Smoothing {
    Kernel kernel;
    double support;
    bool linear;
  };

  // Points in the centers of the cells of a regular grid over the box, each on the processor of its sub-domain: so a point
  // needs owned and ghost particles only, and no values of points are communicated.  In the dimension of the simulation, for
  // orthogonal boxes.

  class ParticleGrid : protected Pointers {
   public:
    ParticleGrid(class LAMMPS *, const int *count);
    ~ParticleGrid() override;

    // Map the values of owned and ghost particles to the points.  values[i] = volume, > 0 if the particle counts, then
    // nfield values.  Return the number of points, of all processors, without a particle in the support; their value is 0.

    bigint map(const Smoothing &, double **values, int nfield);
    const double *field(int k) const    // at the owned points, the first index fastest
    {
      return fields[k].data();
    }

    bool fits() const;    // the points still fill the sub-domain of this processor

    bigint npoint() const { return points; }    // owned
    Grid2d *lammps_grid2d() const { return grid2d.get(); }
    Grid3d *lammps_grid3d() const { return grid3d.get(); }
    double memory_usage() const
    {
      return (double) points * (moments.size() + fields.size()) * sizeof(double);
    }

    int count[3];                              // points of the box
    int lo[3] = {}, hi[3] = {};                // range of the owned points
    int ghost_lo[3] = {}, ghost_hi[3] = {};    // range with LAMMPS's ghost points, unused here

   private:
    const int dim;
    bigint points = 1;
    std::unique_ptr<Grid2d> grid2d;
    std::unique_ptr<Grid3d> grid3d;

    double origin[3] = {}, spacing[3] = {};    // of the points, in the present box
    std::vector<std::vector<double>> moments, fields;
    std::vector<double> weight, offset;    // points of one row around a particle

    template <class Function> void near_rows(const double *, double, Function &&);
    template <class KernelShape, class Function>
    void weigh_rows(const Smoothing &, double **, Function &&);
    template <class KernelShape> void sum_moments(const Smoothing &, double **);
    template <class KernelShape> void sum_fields(const Smoothing &, double **, int);
    template <class KernelShape> void weigh_row(const Smoothing &, double, double, double, int);
    bigint solve(bool linear);
  };

  // Fourier transform of a field on the points of a grid, by the distributed FFT of LAMMPS's KSPACE
  // package, if LAMMPS is built with it.

  class FourierGrid : protected Pointers {
   public:
    FourierGrid(class LAMMPS *, const ParticleGrid &);
    ~FourierGrid() override;

    static bool available();

    // Find the amplitudes a_k of f = sum_k a_k exp(i k.x), x from the first point: mode (i,j,k) of the box is on the
    // processor and at the place in the array of the point (i,j,k)

    void transform(const double *field, std::complex<double> *modes);
    double memory_usage() const;

   private:
    struct Plan;    // knows LAMMPS's FFTs
    std::unique_ptr<Plan> plan;
  };

  // A compute of the fluid on a grid: compute ID group style Nx Ny Nz ... order 0|1.  Makes the grid and maps values of the
  // particles to the grid.

  class GridCompute : public Compute {
   public:
    GridCompute(class LAMMPS *, int, char **);
    ~GridCompute() override;
    void init() override;
    void reset_grid() override;
    int pack_forward_comm(int, int *, double *, int, int *) override;
    void unpack_forward_comm(int, int, double *) override;
    double memory_usage() override
    {
      return (double) nmax * comm_forward * sizeof(double) + grid->memory_usage();
    }

   protected:
    int count[3] = {};     // points
    bool linear = true;    // order 1
    std::unique_ptr<ParticleGrid> grid;

    bool add_value(const std::string &);    // adds a value to map; false if unknown
    int nvalue() const { return static_cast<int>(names.size()); }
    void read_order(Keywords &);    // reads keyword order

    Fluid *fluid() const;
    bool is_mapped(const Fluid *, int) const;    // owned particle
    bigint map();    // maps all values; returns # of points without particles, of all ranks

   private:
    using Value = double (*)(const Atom *, int);

    std::vector<std::string> names;
    std::vector<Value> getters;
    int nmax = 0;
    double **values =
        nullptr;    // owned and ghost particles: volume (0: not mapped), then the values to map
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
