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
// P1 = Bonet Avalos, Antuono, Colagrossi, Souto-Iglesias, Phys. Rev. E 101, 013302 (2020)

namespace LAMMPS_NS {
namespace SPHDissipation {

  // mg:      f_i = -2 (n+2) mu sum_j F (u.e) e V_i V_j        P1 (12)
  // mg/fr:   f_i = -eta sum_j F r (u.e) e V_i V_j             P1 (15), (49)
  // morris:  f_i = -2 mu sum_j F u V_i V_j                    Laplacian of the velocity
  // espanol: f_i = -a sum_j F [u + (u.e) e] V_i V_j           P. Espanol, M. Revenga, Phys. Rev. E 67,
  //                                                           026705 (2003), with bulk term zero

  enum class Shear { NONE, MG, MG_FR, MORRIS, ESPANOL };

  // density: f_i = zeta sum_j (V_i^3 cdot_i + V_j^3 cdot_j) F r_ij             P1 (18)
  // volume:  f_i = zeta sum_j (V_i cdot_i + V_j cdot_j) F r_ij V_i V_j         P1 (64)

  enum class Bulk { NONE, DENSITY, VOLUME };

  inline const char *shear_name(Shear shear)
  {
    return (shear == Shear::MG)     ? "mg"
        : (shear == Shear::MG_FR)   ? "mg/fr"
        : (shear == Shear::MORRIS)  ? "morris"
        : (shear == Shear::ESPANOL) ? "espanol"
                                    : "none";
  }

  inline const char *bulk_name(Bulk bulk)
  {
    return (bulk == Bulk::DENSITY) ? "density" : (bulk == Bulk::VOLUME) ? "volume" : "none";
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

  // what the shear term puts before (u.e)^2 in the dissipation of a pair at distance r, in units of
  // shear_factor mu F V_i V_j

  inline double central_weight(Shear shear, double r)
  {
    return (shear == Shear::MG_FR) ? r : (shear == Shear::ESPANOL) ? 2.0 : 1.0;
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

  // coefficient of the bulk term; P1 (67)

  inline double bulk_coefficient(Shear shear, int n, double mu, double kappa)
  {
    return kappa - intrinsic_kappa(shear, n, mu);
  }

  // the inequality that (mu, kappa) violates, or nullptr if the fluid dissipates:
  // 2 mu |dev E|^2 + kappa (tr E)^2 >= 0

  inline const char *inadmissible(double mu, double kappa)
  {
    if (!(mu >= 0.0)) return "mu must be >= 0";
    if (!(kappa >= 0.0)) return "kappa must be >= 0";
    return nullptr;
  }

  // effective smoothing length for stability: the h of a Wendland C2 kernel (support 2h) with the
  // same integral of F, which sets the damping rate of the shortest waves

  inline double stability_length_squared(double slope_integral)
  {
    return 3.5 / slope_integral;
  }

  // Largest recommended time steps.  The forces see the velocity extrapolated to the end of the
  // step, for which a mode of damping rate g is stable for g dt < 1.  The largest rates on lattices
  // of 1, 2, 3 dimensions, for all kernels, are 21 nu/h^2 (mg, on a line), 17 nu/h^2 (mg/fr),
  // 7.2 nu/h^2 (Morris), 10 nu/h^2 (Espanol) and 1.4 zeta/(rho h^2) (bulk); up to 6 percent more in
  // disorder.

  constexpr double UNLIMITED_STEP = 1.0e300;

  inline double acoustic_step(double h, double speed)
  {
    return 0.25 * h / speed;
  }

  inline double shear_step(Shear shear, double hsq, double nu)
  {
    if (shear == Shear::NONE || nu == 0.0) return UNLIMITED_STEP;
    const double fraction = (shear == Shear::MG) ? 0.045
        : (shear == Shear::MG_FR)                ? 0.05
        : (shear == Shear::ESPANOL)              ? 0.091
                                                 : 0.126;
    return fraction * hsq / nu;
  }

  inline double bulk_step(double hsq, double zeta_over_rho)
  {
    if (zeta_over_rho == 0.0) return UNLIMITED_STEP;
    return 0.4 * hsq / (zeta_over_rho > 0.0 ? zeta_over_rho : -zeta_over_rho);
  }

  // all limits together: the rates of the viscous terms add

  inline double combined_step(double acoustic, double shear, double bulk)
  {
    const double viscous = 1.0 / (1.0 / shear + 1.0 / bulk);
    return (viscous < acoustic) ? viscous : acoustic;
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS
#endif
