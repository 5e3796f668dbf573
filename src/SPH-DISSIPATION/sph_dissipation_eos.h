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

#ifndef LMP_SPH_DISSIPATION_EOS_H
#define LMP_SPH_DISSIPATION_EOS_H

// Equations of state of package SPH-DISSIPATION.  No LAMMPS include.
//
//   linear  p = c0^2 (rho - rho0) + pb
//   tait    p = rho0 c0^2 / gamma [(rho/rho0)^gamma - 1] + pb
//   ideal   p = (gamma - 1) rho e + pb,   e = internal energy per mass
//
// elastic_energy() is the energy per mass from which the pressure follows, p = rho^2 de/drho,
// zero at rho0.  The ideal gas has none: its energy is the internal energy that is integrated.

#include "sph_dissipation_function.h"

#include <cmath>

namespace LAMMPS_NS {
namespace SPHDissipation {

  enum class Eos { LINEAR, TAIT, IDEAL };

  inline const char *eos_name(Eos eos)
  {
    return (eos == Eos::LINEAR) ? "linear" : (eos == Eos::TAIT) ? "tait" : "ideal";
  }

  inline double default_gamma(Eos eos)
  {
    return (eos == Eos::IDEAL) ? 1.4 : 7.0;
  }

  // the defaults are those of a type without coefficients: no pressure, no energy

  struct EosParams {
    SPH_FUNCTION EosParams() : rho0(1.0), c0(0.0), pb(0.0), gamma(7.0) {}

    double rho0;     // reference density, mass/length^n
    double c0;       // sound speed at rho0
    double pb;       // background pressure
    double gamma;    // exponent of tait and ideal
  };

  // x^gamma, without pow() for the usual exponent of water

  SPH_FUNCTION double tait_power(double x, double gamma)
  {
    if (gamma == 7.0) {
      const double x3 = x * x * x;
      return x3 * x3 * x;
    }
    return std::pow(x, gamma);
  }

  // pressure at density rho; e = internal energy per mass, used by the ideal gas only

  SPH_FUNCTION double pressure(Eos eos, const EosParams &par, double rho, double e)
  {
    switch (eos) {
      case Eos::TAIT:
        return par.rho0 * par.c0 * par.c0 / par.gamma *
            (tait_power(rho / par.rho0, par.gamma) - 1.0) +
            par.pb;
      case Eos::IDEAL:
        return (par.gamma - 1.0) * rho * e + par.pb;
      default:
        return par.c0 * par.c0 * (rho - par.rho0) + par.pb;
    }
  }

  // elastic energy per mass at density rho

  SPH_FUNCTION double elastic_energy(Eos eos, const EosParams &par, double rho)
  {
    if (eos == Eos::IDEAL) return 0.0;
    const double background = par.pb * (1.0 / par.rho0 - 1.0 / rho);
    if (eos == Eos::LINEAR)
      return par.c0 * par.c0 * (std::log(rho / par.rho0) + par.rho0 / rho - 1.0) + background;
    const double b = par.rho0 * par.c0 * par.c0 / par.gamma;
    const double x = rho / par.rho0;
    const double power =
        (par.gamma == 1.0) ? std::log(x) : (tait_power(x, par.gamma) / x - 1.0) / (par.gamma - 1.0);
    return b / par.rho0 * power + b * (1.0 / rho - 1.0 / par.rho0) + background;
  }

  // density at pressure p; of the ideal gas: at internal energy e per mass

  inline double density_at(Eos eos, const EosParams &par, double p, double e)
  {
    switch (eos) {
      case Eos::TAIT: {
        const double b = par.rho0 * par.c0 * par.c0 / par.gamma;
        return par.rho0 * std::pow((p - par.pb) / b + 1.0, 1.0 / par.gamma);
      }
      case Eos::IDEAL:
        return (p - par.pb) / ((par.gamma - 1.0) * e);
      default:
        return par.rho0 + (p - par.pb) / (par.c0 * par.c0);
    }
  }

  // speed of sound at density rho, c^2 = dp/drho at constant entropy, de = p/rho^2 drho

  inline double sound_speed(Eos eos, const EosParams &par, double rho, double e)
  {
    switch (eos) {
      case Eos::TAIT:
        return par.c0 * std::sqrt(tait_power(rho / par.rho0, par.gamma) * par.rho0 / rho);
      case Eos::IDEAL:
        return std::sqrt((par.gamma - 1.0) * (par.gamma * e + par.pb / rho));
      default:
        return par.c0;
    }
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS
#endif
