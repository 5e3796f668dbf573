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

// Extrapolation of a field of the fluid behind a surface, by a least-squares fit with weights d^2,
// where d are the distances of fluid particles from the surface; next to the surface, q/d is no
// slope.  The fit needs the means <q d^3>, <q d^4>, and those of d^3 to d^6. The weights decide how
// fast viscous forces damp what changes from one layer of particles to the next: with these, not
// faster than inside of the fluid.  The distances are bounded from below, each by CLOSEST spacings
// of the particles, their mean by CLOSEST_MEAN, which on lattices is that of the first layer.

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
    double d3, d4, d5, d6;

    // q is zero at the surface.  Least of <d^2 (q - slope d - bend d^2)^2> + STIFF depth^2 (bend depth^2)^2:
    // the second term penalizes a bend by what it adds at this depth, so that the field is straight
    // deep in a wall, where only the first layer contributes.  It is also straight where all
    // distances are equal, because <d^6> is raised by the share alike.  A field without a bend is
    // exact.  The share is smaller for the spin, because its diffusion and the vortex viscosity
    // bend it next to the surface.

    static constexpr double STIFF = 0.001, ALIKE = 0.01, ALIKE_SPIN = 0.001;

    SPH_FUNCTION Extension stuck(double f_d3, double f_d4, double depth, double alike) const
    {
      const double depth_cubed = depth * depth * depth;
      const double sixth = (1.0 + alike) * d6 + STIFF * depth_cubed * depth_cubed;
      const double norm = 1.0 / (d4 * sixth - d5 * d5);
      return {0.0, norm * (f_d3 * sixth - f_d4 * d5), norm * (f_d4 * d4 - f_d3 * d5)};
    }

    // The same for what follows, which stays inside of the range of the fluid: the share is larger

    static constexpr double DAMPING = 0.1;

    // its derivative is zero there

    SPH_FUNCTION Extension free(double f_d3, double f_d4) const
    {
      const double sixth = (1.0 + DAMPING) * d6;
      const double norm = 1.0 / (d3 * sixth - d5 * d4);
      return {norm * (f_d3 * sixth - f_d4 * d5), 0.0, norm * (f_d4 * d3 - f_d3 * d4)};
    }

    // derivative of the straight line through q

    SPH_FUNCTION double straight_slope(double f_d3, double f_d4) const
    {
      return (f_d4 * d3 - f_d3 * d4) / ((1.0 + DAMPING) * d3 * d5 - d4 * d4);
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
