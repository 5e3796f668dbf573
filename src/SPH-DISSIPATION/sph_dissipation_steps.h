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

#ifndef LMP_SPH_DISSIPATION_STEPS_H
#define LMP_SPH_DISSIPATION_STEPS_H

// Largest stable time steps, from the rates of the channels; the skin of the neighbor list.  No LAMMPS include.

#include <algorithm>
#include <cmath>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Return the square of the smoothing length for stability: h of a Wendland C2 kernel (support 2h) with the same integral
  // of F, which sets the damping rate of the shortest waves

  inline double stability_length_squared(double slope_integral)
  {
    return 3.5 / slope_integral;
  }

  // Return the largest stable time step of a mode with damping rate g, SAFETY/g.  Forces use the velocity extrapolated to the
  // end of the step: so the mode is stable for g dt < 1.

  constexpr double UNLIMITED_STEP = 1.0e300;
  constexpr double SAFETY = 0.9;

  inline double viscous_step(double rate)
  {
    return (rate > 0.0) ? SAFETY / rate : UNLIMITED_STEP;
  }

  // Return the largest step for sound.  Linear waves are stable up to several times this step, but the energy of a fluid far
  // from equilibrium is inaccurate even with this step; J. J. Monaghan, Rep. Prog. Phys. 68, 1703 (2005)

  constexpr double ACOUSTIC = 0.25;

  inline double acoustic_step(double h, double speed)
  {
    return (speed > 0.0) ? ACOUSTIC * h / speed : UNLIMITED_STEP;
  }

  // Return the largest step for sound of the speed speed + extra(dt).  extra(dt), from states, falls with dt: states are stiff
  // in steps shorter than the relaxation times of these states

  template <class Extra> double acoustic_step(double h, double speed, Extra &&extra)
  {
    if (extra(0.0) == 0.0) return acoustic_step(h, speed);
    double low = acoustic_step(h, speed + extra(0.0)), high = acoustic_step(h, speed);
    for (int k = 0; k < 100 && high < UNLIMITED_STEP; k++) {
      const double middle = 0.5 * (low + high);
      (middle < acoustic_step(h, speed + extra(middle)) ? low : high) = middle;
    }
    return low;
  }

  // Return the step for capillary waves of length h, hsq = h^2: J. P. Morris, Int. J. Numer. Methods Fluids 33, 333 (2000)

  inline double capillary_step(double rho, double hsq, double tension)
  {
    constexpr double TWO_PI = 6.28318530717958647692;
    return (tension > 0.0) ? ACOUSTIC * sqrt(rho * hsq * sqrt(hsq) / (TWO_PI * tension))
                           : UNLIMITED_STEP;
  }

  // Return the step for all limits together: the rates of the viscous terms add

  inline double combined_step(double acoustic, const std::vector<double> &viscous)
  {
    double rate = 0.0;
    for (const double step : viscous)
      if (step < UNLIMITED_STEP) rate += 1.0 / step;
    return (rate > 0.0) ? std::min(acoustic, 1.0 / rate) : acoustic;
  }

  // Return the time per step over the time with a skin of zero and no rebuilds.  A list lasts until a particle has moved by
  // half of the skin.  A rebuild takes as long as REBUILD steps; LISTED is the part of a step that is proportional to the
  // length of the list, (support + skin)^dim.  Both numbers are measured: bench/README.md.

  constexpr double REBUILD = 0.75, LISTED = 0.15;

  inline double time_with_skin(double skin, double motion_per_step, double support, int dim)
  {
    const double steps = 0.5 * skin / motion_per_step;
    return 1.0 - LISTED + LISTED * pow(1.0 + skin / support, dim) + REBUILD / std::max(steps, 1.0);
  }

  // Return the skin with the least time per step, to first order in skin/support, at most half of the support radius

  inline double fastest_skin(double motion_per_step, double support, int dim)
  {
    return std::min(0.5 * support,
                    sqrt(2.0 * REBUILD / (LISTED * dim) * motion_per_step * support));
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
