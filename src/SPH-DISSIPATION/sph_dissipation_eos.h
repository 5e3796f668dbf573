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
// The internal energy per mass is e = e_el(rho) + q with the heat q:
//   p = p_el(rho) + Gamma rho q,   T = q/cv,   c^2 = c_el^2(rho) + Gamma (Gamma + 1) q
// with the constant Gamma of Mie and Grueneisen: at constant entropy dq = Gamma q/rho drho.
//
//   linear  p_el = c_el^2 (rho - rho0) + pb_el
//   tait    p_el = rho0 c_el^2 / gamma [(rho/rho0)^gamma - 1] + pb_el
//   ideal   p_el = pb,   Gamma = gamma - 1
//
// Without tension, p_el is 0 below rho_min, the density without pressure; there e_el is constant, e_el(rho_min).
//
// elastic_energy() is the energy e_el per mass from which p_el follows, p_el = rho^2 de_el/drho, zero at rho0.

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

  // Parameters of a type; with the defaults, for a type without coefficients, pressure and energy are 0

  struct EosParams {

    double rho0 = 1.0;     // reference density, mass/length^3 in every dimension
    double c0 = 0.0;       // adiabatic sound speed at rho0, and at the reference temperature
    double pb = 0.0;       // background pressure, at rho0 and at the reference temperature
    double gamma = 7.0;    // exponent of tait and ideal

    // set by derive()
    double gruneisen = 0.0;            // Gamma
    double c_el = 0.0, pb_el = 0.0;    // sound speed and background pressure without heat
    double rho_min = -HUGE_VAL;    // density below which there is no pressure; -inf with tension

    SPH_FUNCTION double impedance() const { return rho0 * c0; }    // acoustic
    void derive(Eos eos, double gruneisen_in, double reference_heat, bool tension = true);
  };

  // Return the density at which the elastic pressure of linear and tait is 0; 0 if it is positive at all densities

  inline double density_without_pressure(Eos eos, const EosParams &par)
  {
    const double cc = par.c_el * par.c_el;
    if (eos == Eos::LINEAR) return std::fmax(par.rho0 - par.pb_el / cc, 0.0);
    const double power = 1.0 - par.pb_el * par.gamma / (par.rho0 * cc);
    return (power > 0.0) ? par.rho0 * std::pow(power, 1.0 / par.gamma) : 0.0;
  }

  // Set gruneisen, c_el, pb_el, and rho_min from c0, pb, gamma, Grueneisen's constant (read for linear and tait), and the
  // heat per mass cv T0 at the reference temperature; c_el is NaN if the heat alone makes sound faster than c0.

  inline void EosParams::derive(Eos eos, double gruneisen_in, double reference_heat, bool tension)
  {
    rho_min = -HUGE_VAL;
    gruneisen = (eos == Eos::IDEAL) ? gamma - 1.0 : gruneisen_in;
    c_el = c0;
    pb_el = pb;
    if (!tension) rho_min = density_without_pressure(eos, *this);
    if (eos == Eos::IDEAL || gruneisen == 0.0) return;
    c_el = std::sqrt(c0 * c0 - gruneisen * (gruneisen + 1.0) * reference_heat);
    pb_el -= gruneisen * rho0 * reference_heat;
  }

  // Return x^gamma, without pow() for the usual exponent of water

  SPH_FUNCTION double tait_power(double x, double gamma)
  {
    if (gamma == 7.0) {
      const double x3 = x * x * x;
      return x3 * x3 * x;
    }
    return std::pow(x, gamma);
  }

  // Return the pressure p_el at density rho, without the pressure of the heat

  SPH_FUNCTION double elastic_pressure(Eos eos, const EosParams &par, double rho)
  {
    if (rho < par.rho_min) return 0.0;
    switch (eos) {
      case Eos::TAIT:
        return par.rho0 * par.c_el * par.c_el / par.gamma *
            (tait_power(rho / par.rho0, par.gamma) - 1.0) +
            par.pb_el;
      case Eos::IDEAL:
        return par.pb_el;
      default:
        return par.c_el * par.c_el * (rho - par.rho0) + par.pb_el;
    }
  }

  // Return the elastic energy per mass at density rho

  SPH_FUNCTION double elastic_energy(Eos eos, const EosParams &par, double rho)
  {
    if (eos == Eos::IDEAL && par.pb_el == 0.0) return 0.0;
    if (rho < par.rho_min) rho = par.rho_min;
    const double rest = par.rho0 / rho;
    const double background = par.pb_el / par.rho0 * (1.0 - rest);
    if (eos == Eos::IDEAL) return background;
    const double x = rho / par.rho0;
    if (eos == Eos::LINEAR) return par.c_el * par.c_el * (std::log(x) + rest - 1.0) + background;
    const double power = (par.gamma == 1.0)
        ? std::log(x)
        : (tait_power(x, par.gamma) * rest - 1.0) / (par.gamma - 1.0);
    return par.c_el * par.c_el / par.gamma * (power + rest - 1.0) + background;
  }

  // Return the pressure of heat q per mass at density rho

  SPH_FUNCTION double thermal_pressure(const EosParams &par, double rho, double q)
  {
    return par.gruneisen * rho * q;
  }

  // Return the pressure at density rho; e = internal energy per mass, read only if heat has a pressure

  SPH_FUNCTION double pressure(Eos eos, const EosParams &par, double rho, double e)
  {
    const double p = elastic_pressure(eos, par, rho);
    if (par.gruneisen == 0.0) return p;
    return p + thermal_pressure(par, rho, e - elastic_energy(eos, par, rho));
  }

  // Return the speed of sound at density rho and internal energy e per mass: c^2 = dp/drho at constant entropy,
  // de = p/rho^2 drho

  inline double sound_speed(Eos eos, const EosParams &par, double rho, double e)
  {
    const double q = (par.gruneisen == 0.0) ? 0.0 : e - elastic_energy(eos, par, rho);
    if (eos == Eos::IDEAL) return std::sqrt(par.gruneisen * (par.gamma * q));
    if (rho < par.rho_min) rho = par.rho_min;
    const double c = (eos == Eos::TAIT)
        ? par.c_el * std::sqrt(tait_power(rho / par.rho0, par.gamma) * par.rho0 / rho)
        : par.c_el;
    return (q == 0.0) ? c : std::sqrt(c * c + par.gruneisen * (par.gruneisen + 1.0) * q);
  }

  // Return the heat per mass at density rho, at the entropy of heat q at density rho_q

  inline double heat_at(const EosParams &par, double q, double rho_q, double rho)
  {
    return (par.gruneisen == 0.0) ? q : q * std::pow(rho / rho_q, par.gruneisen);
  }

  // Return the density at pressure p, by Newton's method from density rho with heat q per mass; NaN if there is none.  The
  // heat (n = 0) or the entropy (n = Gamma) is constant.  The pressure is a convex function of the density.

  inline double density_by_steps(Eos eos, const EosParams &par, double p, double q, double rho,
                                 double n)
  {
    constexpr int MOST = 100;
    constexpr double CLOSE = 1.0e-10;    // relative step; the next one would be its square
    const double start = rho;
    for (int k = 0; k < MOST; k++) {
      const double now = (n == 0.0) ? q : heat_at(par, q, start, rho);
      const double c = sound_speed(eos, par, rho, elastic_energy(eos, par, rho) + now);
      const double slope = c * c - par.gruneisen * (par.gruneisen - n) * now;
      const double more = p - elastic_pressure(eos, par, rho) - thermal_pressure(par, rho, now);
      rho += more / slope;
      if (std::fabs(more / slope) <= CLOSE * rho) return rho;
    }
    return NAN;
  }

  // Return the density at pressure p without heat, not of an ideal gas

  SPH_FUNCTION double cold_density_at(Eos eos, const EosParams &par, double p)
  {
    const double cc = par.c_el * par.c_el;
    if (eos != Eos::TAIT) return par.rho0 + (p - par.pb_el) / cc;
    const double b = par.rho0 * cc / par.gamma;
    return par.rho0 * std::pow((p - par.pb_el) / b + 1.0, 1.0 / par.gamma);
  }

  // Return the density at pressure p and heat q per mass

  inline double density_at(Eos eos, const EosParams &par, double p, double q)
  {
    const double heat = par.gruneisen * q;
    switch (eos) {
      case Eos::TAIT: {
        const double cold = cold_density_at(eos, par, p);
        return (heat == 0.0) ? cold : density_by_steps(eos, par, p, q, cold, 0.0);
      }
      case Eos::IDEAL:
        return (p - par.pb_el) / heat;
      default: {
        const double cc = par.c_el * par.c_el;
        if (heat == 0.0) return cold_density_at(eos, par, p);
        return (p - par.pb_el + cc * par.rho0) / (cc + heat);
      }
    }
  }

  // Return the density at pressure p, at the entropy of heat q per mass at density rho

  inline double density_at_entropy(Eos eos, const EosParams &par, double p, double q, double rho)
  {
    if (par.gruneisen == 0.0) return density_at(eos, par, p, q);
    return density_by_steps(eos, par, p, q, rho, par.gruneisen);
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS
#endif
