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

// What the pair loops read of each particle, and what they sum up for it.  No LAMMPS include.

#include "sph_dissipation_function.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Index of a particle in the lists of the loops, times 8: the distance in bytes of the number with this index in an array
  // of doubles.  The address of a row is found from it without a shift

  typedef unsigned int Offset;

  SPH_INLINE Offset offset_of(int i)
  {
    return sizeof(double) * static_cast<Offset>(i);
  }
  SPH_INLINE int index_of(Offset offset)
  {
    return offset / sizeof(double);
  }

  // The loops read and write these structures as rows of doubles; 16 bytes are what a GPU loads at
  // once.

  // what the pair loops read of a particle: one cache line

  struct alignas(16) Particle {
    double x[3];    // position
    double u[3];    // velocity extrapolated to the end of the step
    double vol;     // V = w/c
    double g;       // (p + zeta cdot/c) / c^2 (bulk density), p/c^2 (otherwise)
  };

  // number density and its rate: what pass 1 accumulates

  struct alignas(16) DensitySum {
    double c, cdot;
  };

  // force, and heat of the first channel: what pass 2 accumulates

  struct alignas(16) ForceSum {
    double f[3];
    double heat;
  };

  // spin, extrapolated to the end of the step

  struct alignas(16) Spin {
    double w[3];
    double unused;    // rows are read by fours
  };

  // What velocity and spin of a boundary particle in the pair forces exceed its own by; of other particles zero

  struct alignas(16) Excess {
    double u[3];
    double is_boundary;    // 1
    double w[3];
    double crosses;    // 1 if its row of the neighbor list has pairs of the fluid with a boundary
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
