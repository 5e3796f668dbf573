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

#ifndef LMP_SPH_DISSIPATION_ROWS_H
#define LMP_SPH_DISSIPATION_ROWS_H

// Input and sums of the pair loops for each particle, the rows.  No LAMMPS include.

#include "sph_dissipation_function.h"

#include <cstddef>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Index of a particle in the lists of the loops, times 8: the offset in bytes in an array of doubles, so that the loops
  // need no shift for the address of a row

  typedef unsigned int Offset;

  SPH_INLINE Offset offset_of(int i)
  {
    return sizeof(double) * static_cast<Offset>(i);
  }
  SPH_INLINE int index_of(Offset offset)
  {
    return offset / sizeof(double);
  }

  // A row: one of these structures, which the loops read and write as doubles; a GPU loads 16 bytes at once.

  // Input of the pair loops: one cache line

  struct alignas(16) Particle {
    double x[3];    // position
    double u[3];    // velocity extrapolated to the end of the step
    double vol;     // V = w/c
    double g;       // (p + zeta cdot/c) / c^2 (bulk density), p/c^2 (otherwise)
  };

  // Sums of pass 1: number density and its rate

  struct alignas(16) DensitySum {
    double c, cdot;
  };

  // Sums of pass 2: force, and heat of the first channel

  struct alignas(16) ForceSum {
    double f[3];
    double heat;
  };

  // Spin, extrapolated to the end of the step

  struct alignas(16) Spin {
    double w[3];
    double unused;    // loops read rows by four numbers
  };

  // Velocity and spin of a boundary particle in the pair forces, less its own velocity and the spin of its body; else 0

  struct alignas(16) Excess {
    double u[3];
    double is_boundary;    // 1 for a boundary particle
    double w[3];
    double crosses;    // 1 if its row of the neighbor list has pairs of the fluid with a boundary
  };

  // A pair within the support, from the side of particle i

  struct PairPlace {
    double r[3];           // r_i - r_j
    double rsq, length;    // |r|^2, |r|
    double slope;          // F
    double shape;          // W/W(0), for sums with SHAPE
  };

  // Component d of a vector of particle i, with the strides of the array

  struct VectorField {
    double *first;
    std::size_t by_particle, by_component;
    SPH_FUNCTION double &at(int i, int d) const
    {
      return first[i * by_particle + d * by_component];
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
