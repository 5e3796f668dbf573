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

#ifndef LMP_SPH_DISSIPATION_COEFFS_H
#define LMP_SPH_DISSIPATION_COEFFS_H

// From the viscosities of the fluid to the coefficients of the particle model, the range in which
// the model dissipates, and the time steps that it allows.  No LAMMPS include.
//
// mu = shear viscosity, kappa = bulk viscosity, stress = 2 mu dev(E) + kappa tr(E), both in
// pressure * time (in dimension n = 1 kappa is the longitudinal viscosity).
//
// Micropolar fluid: mu_r = vortex (microrotation) viscosity in the units of mu, gamma1 and gamma2 =
// spin viscosities in units of mu * length^2,
//   rho du/dt = ... + (mu + mu_r) lap u + (mu + lambda - mu_r) grad div u + 2 mu_r curl Omega,
//   rho I dOmega/dt = -2 mu_r (2 Omega - curl u) + gamma1 lap Omega + (gamma1 + gamma2) grad div Omega.
//
// P1 = Bonet Avalos, Antuono, Colagrossi, Souto-Iglesias, Phys. Rev. E 101, 013302 (2020)
// P2 = Colagrossi, Durante, Souto-Iglesias, Bonet Avalos, constitutive properties of the SPH bulk
//      viscosity
// P3 = Souto-Iglesias, Bonet Avalos, Antuono, Colagrossi, SPHERIC 2022; Phys. Rev. E 104, 015315
//      (2021)

#include "sph_dissipation_function.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // mg:      f_i = -2 (n+2) mu sum_j F (u.e) e V_i V_j        P2 (41)
  // mg/fr:   f_i = -eta sum_j F r (u.e) e V_i V_j             P1 (15), (49)
  // morris:  f_i = -2 mu sum_j F u V_i V_j                    Laplacian of the velocity
  // espanol: f_i = -a sum_j F [u + (u.e) e] V_i V_j           P. Espanol, M. Revenga, Phys. Rev. E 67,
  //                                                           026705 (2003), with bulk term zero

  // micropolar: f_i = -sum_j F V_i V_j [zeta1 (e.u*) e + zeta2 u*], u* = u - Omega_mean x r   P3 (12)

  enum class Shear { NONE, MG, MG_FR, MORRIS, ESPANOL, MICROPOLAR };

  // density: f_i = zeta sum_j (V_i^3 cdot_i + V_j^3 cdot_j) F r_ij             P1 (18)
  // volume:  f_i = zeta sum_j (V_i cdot_i + V_j cdot_j) F r_ij V_i V_j         P1 (64)

  enum class Bulk { NONE, DENSITY, VOLUME };

  inline const char *shear_name(Shear shear)
  {
    return (shear == Shear::MG)        ? "mg"
        : (shear == Shear::MG_FR)      ? "mg/fr"
        : (shear == Shear::MORRIS)     ? "morris"
        : (shear == Shear::ESPANOL)    ? "espanol"
        : (shear == Shear::MICROPOLAR) ? "micropolar"
                                       : "none";
  }

  inline const char *bulk_name(Bulk bulk)
  {
    return (bulk == Bulk::DENSITY) ? "density" : (bulk == Bulk::VOLUME) ? "volume" : "none";
  }

  // number: c_i = sum_j W, V_i = 1/c_i                                         P1 (5)
  // mass:   c_i = sum_j w_j W, V_i = w_i/c_i with the reference volume w_i = m_i/rho0 of particle i

  enum class Volume { NUMBER, MASS };

  inline const char *volume_name(Volume volume)
  {
    return (volume == Volume::MASS) ? "mass" : "number";
  }

  // prefactor of the shear term per unit mu, in dimension n; mean_radius = integral of r W

  inline double shear_factor(Shear shear, int n, double mean_radius)
  {
    switch (shear) {
      case Shear::MG:
        return 2.0 * (n + 2);
      case Shear::MG_FR:
        return 2.0 * n * (n + 2) / ((n + 1) * mean_radius);
      case Shear::MORRIS:
        return 2.0;
      case Shear::ESPANOL:
        return 2.0 * (n + 2) / (n + 3);
      default:
        return 0.0;
    }
  }

  // coefficients of the pair terms of two types:
  //   f_i = -sum_j F V_i V_j [along_r (e.u*) e + along_u u*]
  //   tau_i = 1/2 sum_j F V_i V_j along_u r x u* - sum_j F V_i V_j [xi1 (e.dOmega) e + xi2 dOmega]
  // with F r instead of F for mg/fr

  struct PairCoeff {
    SPH_FUNCTION PairCoeff() : along_r(0.0), along_u(0.0), xi1(0.0), xi2(0.0) {}

    double along_r, along_u, xi1, xi2;
  };

  inline PairCoeff shear_coefficients(Shear shear, int n, double mu, double mean_radius)
  {
    const double coefficient = shear_factor(shear, n, mean_radius) * mu;
    PairCoeff coeff;
    if (shear != Shear::MORRIS) coeff.along_r = coefficient;
    if (shear == Shear::MORRIS || shear == Shear::ESPANOL) coeff.along_u = coefficient;
    return coeff;
  }

  // inverse of mu = zeta1/(2(n+2)) + zeta2/4, mu_r = zeta2/4 (P3 (29)-(32) with the bulk term) and of
  // gamma1 = xi1/10 + xi2/2, gamma2 = xi1/10 - xi2/2 (n = 3), gamma1 = -gamma2 = xi2/2 (n = 2)

  inline PairCoeff micropolar_coefficients(int n, double mu, double mu_r, double gamma1,
                                           double gamma2)
  {
    PairCoeff coeff;
    coeff.along_r = 2.0 * (n + 2) * (mu - mu_r);
    coeff.along_u = 4.0 * mu_r;
    coeff.xi1 = (n == 3) ? 5.0 * (gamma1 + gamma2) : 0.0;
    coeff.xi2 = gamma1 - gamma2;
    return coeff;
  }

  // what the shear term puts before (u.e)^2 in the dissipation of a pair at distance r, in units of
  // F V_i V_j

  SPH_FUNCTION double central_weight(Shear shear, const PairCoeff &coeff, double r)
  {
    return (shear == Shear::MG_FR) ? coeff.along_r * r : coeff.along_r + coeff.along_u;
  }

  // What a pair of slope F and square distance rsq > 0 adds to the bound of the limit of particle i, times
  // (c_j/c_i)^2 V_j: F r^2 / a_ij

  SPH_FUNCTION double bound_of_pair(Shear shear, const PairCoeff &coeff, double slope, double rsq)
  {
    return slope * rsq / central_weight(shear, coeff, sqrt(rsq));
  }

  // A negative coefficient of the bulk term beyond what the shear terms of the particle's pairs make up
  // for, bound = sum_j (c_j/c_i)^2 V_j F r^2 / a_ij with their central weights a_ij; and the one at the
  // edge

  SPH_FUNCTION bool beyond_bound(double zeta, double bound)
  {
    return zeta * bound < -0.5;
  }

  SPH_FUNCTION double zeta_at_bound(double bound)
  {
    return -0.5 / bound;
  }

  // bulk viscosity that the shear term brings with it: lambda = mu for mg and
  // lambda = -mu for Morris, kappa = lambda + 2 mu/n; P1 (66).  The form of Espanol and Revenga
  // is the sum of mg with mu/(n+3) and Morris with mu (n+2)/(n+3).

  inline double intrinsic_kappa(Shear shear, int n, double mu)
  {
    switch (shear) {
      case Shear::MG:
      case Shear::MG_FR:
        return (1.0 + 2.0 / n) * mu;
      case Shear::MORRIS:
        return (2.0 / n - 1.0) * mu;
      case Shear::ESPANOL:
        return (2.0 / n - (n + 1.0) / (n + 3.0)) * mu;
      default:
        return 0.0;
    }
  }

  // the same for the micropolar pair terms: lambda = mu - mu_r

  inline double intrinsic_kappa_micropolar(int n, double mu, double mu_r)
  {
    return (1.0 + 2.0 / n) * mu - mu_r;
  }

  // coefficient of the bulk term, for intrinsic = what the shear term brings with it; P1 (67)

  inline double bulk_coefficient(double kappa, double intrinsic)
  {
    return kappa - intrinsic;
  }

  // the inequality that (mu, kappa) violates, or nullptr if the fluid dissipates:
  // 2 mu |dev E|^2 + kappa (tr E)^2 >= 0

  inline const char *inadmissible(double mu, double kappa)
  {
    if (!(mu >= 0.0)) return "mu must be >= 0";
    if (!(kappa >= 0.0)) return "kappa must be >= 0";
    return nullptr;
  }

  // the same for a micropolar fluid; the particle model needs along_r + along_u >= 0 and
  // xi1 + xi2 >= 0, too, and has one spin viscosity in two dimensions

  inline const char *inadmissible(int n, double mu, double kappa, double mu_r, double gamma1,
                                  double gamma2)
  {
    if (const char *violated = inadmissible(mu, kappa)) return violated;
    if (!(mu_r >= 0.0)) return "mu_r must be >= 0";
    if (!(n * mu_r <= (n + 2) * mu * (1.0 + 1.0e-14))) return "mu_r must be <= mu (1 + 2/n)";
    if (n == 2 && gamma2 != -gamma1) return "gamma2 must be -gamma1 in 2d";
    if (!(gamma1 - gamma2 >= 0.0)) return "gamma1 - gamma2 must be >= 0";
    if (!(n == 2 || 6.0 * gamma1 + 4.0 * gamma2 >= 0.0)) return "6 gamma1 + 4 gamma2 must be >= 0";
    return nullptr;
  }

  // effective smoothing length for stability: the h of a Wendland C2 kernel (support 2h) with the
  // same integral of F, which sets the damping rate of the shortest waves

  inline double stability_length_squared(double slope_integral)
  {
    return 3.5 / slope_integral;
  }

  // Largest stable time steps.  The forces see the velocity extrapolated to the end of the step, for which
  // a mode of damping rate g is stable for g dt < 1.  The largest rates of the friction matrix on lattices
  // of 1, 2, 3 dimensions, for all kernels, in order and in disorder, and next to walls (Morris), are
  // nu/h^2 (shear), zeta/(rho h^2) (bulk), and zeta2/(rho I) (vortex) times these numbers.  SAFETY is
  // the part of its inverse that each step is.

  constexpr double UNLIMITED_STEP = 1.0e300;
  constexpr double SAFETY = 0.9;
  constexpr double BULK_RATE = 1.6, VORTEX_RATE = 1.0;

  inline double shear_rate(Shear shear)
  {
    return (shear == Shear::MG)     ? 21.0
        : (shear == Shear::MG_FR)   ? 17.0
        : (shear == Shear::ESPANOL) ? 10.0
                                    : 8.0;
  }

  // of a mode of this rate

  inline double viscous_step(double rate)
  {
    return (rate > 0.0) ? SAFETY / rate : UNLIMITED_STEP;
  }

  // Sound: linear waves are stable up to several times this step, but the energy of a fluid far from
  // equilibrium is not right even at it; J. J. Monaghan, Rep. Prog. Phys. 68, 1703 (2005)

  constexpr double ACOUSTIC = 0.25;

  inline double acoustic_step(double h, double speed)
  {
    return (speed > 0.0) ? ACOUSTIC * h / speed : UNLIMITED_STEP;
  }

  inline double shear_step(Shear shear, double hsq, double nu)
  {
    return viscous_step((shear == Shear::NONE) ? 0.0 : shear_rate(shear) * nu / hsq);
  }

  inline double bulk_step(double hsq, double zeta_over_rho)
  {
    return viscous_step(BULK_RATE * std::fabs(zeta_over_rho) / hsq);
  }

  // relaxation of the spin to the vorticity

  inline double vortex_step(double rho_inertia, double zeta2)
  {
    return viscous_step(VORTEX_RATE * zeta2 / rho_inertia);
  }

  // Pair terms of a micropolar fluid: one as of mg (zeta1, xi1) and one as of Morris (zeta2, xi2),
  // whose rates add; inertia = rho for velocities, rho I for spins

  inline double micropolar_step(int n, double hsq, double inertia, double central, double laplacian)
  {
    const double mg = std::max(central, 0.0) / shear_factor(Shear::MG, n, 1.0);
    const double morris = laplacian / shear_factor(Shear::MORRIS, n, 1.0);
    return viscous_step((shear_rate(Shear::MG) * mg + shear_rate(Shear::MORRIS) * morris) /
                        (inertia * hsq));
  }

  // all limits together: the rates of the viscous terms add

  inline double combined_step(double acoustic, const std::vector<double> &viscous)
  {
    double rate = 0.0;
    for (const double step : viscous)
      if (step < UNLIMITED_STEP) rate += 1.0 / step;
    return (rate > 0.0) ? std::min(acoustic, 1.0 / rate) : acoustic;
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS
#endif
