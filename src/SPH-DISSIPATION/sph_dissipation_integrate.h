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

#ifndef LMP_SPH_DISSIPATION_INTEGRATE_H
#define LMP_SPH_DISSIPATION_INTEGRATE_H

// Velocity Verlet of package SPH-DISSIPATION, for the numbers of one particle.  No LAMMPS include.

#include "sph_dissipation_function.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  struct TimeStep {
    double dtv, dtf;
    double keep;             // 0: the extrapolated velocity is the increment alone
    double extrapolation;    // of the velocity over half a step
    bool balanced;           // the forces are random

    // each component; dtfm = dtf/m

    SPH_FUNCTION void begin(double dtfm, double f, double &x, double &v, double &vest) const
    {
      const double dv = dtfm * f;
      v += dv;
      vest = keep * v + extrapolation * dv;
      x += dtv * v;
    }
    SPH_FUNCTION void end(double dtfm, double f, double &v) const { v += dtfm * f; }

    // the same of a spin; dti = dtf/(m I)

    SPH_FUNCTION void begin_spin(double dti, double torque, double &omega, double &omegaest) const
    {
      const double domega = dti * torque;
      omega += domega;
      omegaest = omega + extrapolation * domega;
    }

    // without inertia a particle keeps its spin, and must have no torque

    SPH_FUNCTION static double inverse_inertia(double mass, double inertia)
    {
      return (inertia > 0.0) ? 1.0 / (mass * inertia) : 0.0;
    }

    // The internal energy, too, is extrapolated to the end of the step, so that the pressure of an
    // ideal gas is accurate to second order in the time step; the end corrects it with the new rate.
    // With random forces, which have no future, it gets half of the rate at each end of the step.
    // At the end, rate_before becomes what this has added, for a run that continues.

    SPH_FUNCTION void begin_energy(double rate, double &energy, double &rate_before) const
    {
      rate_before = balanced ? 0.0 : rate;
      energy += (balanced ? 0.5 : 1.0) * dtv * rate;
    }
    SPH_FUNCTION void end_energy(double rate, double &rate_before, double &energy) const
    {
      rate_before = 0.5 * dtv * (rate - rate_before);
      energy += rate_before;
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
