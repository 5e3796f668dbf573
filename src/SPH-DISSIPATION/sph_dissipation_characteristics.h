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

#ifndef LMP_SPH_DISSIPATION_CHARACTERISTICS_H
#define LMP_SPH_DISSIPATION_CHARACTERISTICS_H

// Sound waves at an open end of the fluid.  No LAMMPS include.
// M. Lastiwka, M. Basa, N. J. Quinlan, Int. J. Numer. Meth. Fluids 61, 709 (2009)
//
// u = component of the velocity out of the fluid, impedance = rho c, both ' = deviations from the
// reference state of the end.  The wave that leaves has J = rho c u' + p', the wave that would
// enter has -rho c u' + p' = 0.  This holds for inlets and outlets.

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Return the amplitude J of the wave that leaves, a pressure

  inline double outgoing_wave(double impedance, double u, double p)
  {
    return impedance * u + p;
  }

  // Return the deviations of velocity and pressure where only this wave exists

  inline double wave_velocity(double impedance, double wave)
  {
    return 0.5 * wave / impedance;
  }

  inline double wave_pressure(double wave)
  {
    return 0.5 * wave;
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS
#endif
