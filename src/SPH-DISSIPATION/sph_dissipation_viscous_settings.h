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

// How the integrators of the particle fluid treat the viscous terms: what their keywords set

#ifndef LMP_SPH_DISSIPATION_VISCOUS_SETTINGS_H
#define LMP_SPH_DISSIPATION_VISCOUS_SETTINGS_H

namespace LAMMPS_NS {
namespace SPHDissipation {

  enum class Viscous { EXPLICIT, RKL2, IMPLICIT };
  enum class Scheme { TRAPEZOIDAL, SDIRK2, EULER };

  // of SDIRK2, 1 - 1/sqrt(2): stiffly accurate and L-stable, R. Alexander, SIAM J. Numer. Anal. 14, 1006
  // (1977)

  constexpr double SDIRK2_GAMMA = 0.29289321881345247560;

  struct ViscousSettings {
    Viscous mode = Viscous::EXPLICIT;
    Scheme scheme = Scheme::TRAPEZOIDAL;
    int stages = 0;    // 0: as many as the rates need
    double tolerance = 1.0e-6;
    int iterations = 1000;    // at most
    bool must_converge = false;

    bool trapezoidal() const { return mode == Viscous::IMPLICIT && scheme == Scheme::TRAPEZOIDAL; }

    // The force is the mean one of a decay over the whole time step.  In a longer one it overshoots,
    // with more kinetic energy above twice the step; that of the trapezoidal step is the force of
    // one moment, and what overshoots the next step takes back.

    bool force_is_a_mean() const { return mode != Viscous::EXPLICIT && !trapezoidal(); }

    bool operator==(const ViscousSettings &b) const
    {
      return mode == b.mode && scheme == b.scheme && stages == b.stages &&
          tolerance == b.tolerance && iterations == b.iterations &&
          must_converge == b.must_converge;
    }
    bool operator!=(const ViscousSettings &b) const { return !(*this == b); }

    // Velocity that the forces are to see first: this many increments of half a step after the one
    // in the middle of the step.  The time whose velocity acts in the friction of the scheme is
    // the best guess where the velocity is smooth; the stages of RKL2 begin in the middle, and noise
    // is not smooth.

    double extrapolation(bool noise) const
    {
      if (noise || mode == Viscous::RKL2) return 0.0;
      if (mode == Viscous::EXPLICIT || scheme == Scheme::TRAPEZOIDAL) return 1.0;
      return (scheme == Scheme::SDIRK2) ? 2.0 * SDIRK2_GAMMA : 2.0;
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
