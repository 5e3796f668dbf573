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

// How a field of the fluid goes on behind a surface.  Known are its means f = <q> and fd = <q d> over
// fluid particles at distances d from the surface, and those of d, d^2 and d^3.  The distances are
// bounded from below, for a field divided by a distance next to zero is no slope: each by CLOSEST
// spacings of the particles, their mean by CLOSEST_MEAN, which on lattices is that of the first layer.

#ifndef LMP_SPH_DISSIPATION_EXTENSION_H
#define LMP_SPH_DISSIPATION_EXTENSION_H

#include "sph_dissipation_function.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  constexpr double CLOSEST = 0.25;
  constexpr double CLOSEST_MEAN = 0.45;

  // q = level + slope d + bend d^2 next to the surface, d < 0 behind it

  struct Extension {
    double level, slope, bend;
    SPH_FUNCTION double behind(double depth) const
    {
      return level + depth * (bend * depth - slope);
    }
  };

  // means of the powers of the distance

  struct DistanceMeans {
    double d, d2, d3;

    // Share by which <d^3> is raised, which draws the bend toward zero: little where the distances
    // spread over the support, altogether where they are all alike and say nothing about it.  A
    // field without a bend is met exactly.

    static constexpr double DAMPING = 0.1;

    // q is zero at the surface

    SPH_FUNCTION Extension stuck(double f, double fd) const
    {
      const double third = (1.0 + DAMPING) * d3;
      const double norm = 1.0 / (d * third - d2 * d2);
      return {0.0, norm * (f * third - fd * d2), norm * (fd * d - f * d2)};
    }

    // its derivative is zero there

    SPH_FUNCTION Extension free(double f, double fd) const
    {
      const double bend = (fd - d * f) / ((1.0 + DAMPING) * d3 - d * d2);
      return {f - bend * d2, 0.0, bend};
    }

    // derivative of the straight line through q

    SPH_FUNCTION double straight_slope(double f, double fd) const
    {
      return (fd - d * f) / ((1.0 + DAMPING) * d2 - d * d);
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
