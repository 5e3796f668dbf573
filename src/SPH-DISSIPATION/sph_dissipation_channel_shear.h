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

// Shear viscosity: drag between two particles, by the difference of their velocities.  The forms of the shear force are sums
// of two terms, along e and along u, with the coefficients of shear_factor().
// Included by sph_dissipation_channel_list.h; sph_dissipation_channels.h has the notation.

#ifdef CHANNEL_CLASS
// clang-format off
ChannelClass(ShearChannel)
// clang-format on
#elif defined(CHANNEL_TERMS)

// -a F V_i V_j/metric (u.r) r with the metric r^2, P2 (41), P3 (11), or r, P1 (15)
template <bool BY_R> struct AlongR : PairTerm<ShearChannel, ShearChannel::ALONG_R> {
  static constexpr bool CENTRAL = true, BY_DISTANCE = BY_R;
  template <class Pair> static SPH_INLINE void add_central(Pair &pair)
  {
    const auto drag = pair.coeff[FIRST] * pair.by_metric * pair.approach;
    pair.central -= drag;
    pair.heat[CHANNEL] += 0.5 * drag * pair.approach;
  }
};

// -a F V_i V_j (u.r) r
typedef AlongBySquare<ShearChannel, ShearChannel::BY_SQUARE> AlongRBySquare;

// AlongR or, with FR2, AlongRBySquare, with a mean of mu of both particles: within a fluid, the arithmetic mean, which has a
// dissipation function; between two fluids, and with solid, the harmonic mean: so a solid does not hold the fluid within the
// support; next to a boundary (mu < 0), mu of the fluid.  ONE_FLUID: all pairs have the arithmetic mean
template <bool ONE_FLUID, bool FR2>
struct ByRate : PairTerm<ShearChannel, ShearChannel::ALIKE, ShearChannel::UNLIKE> {
  static constexpr bool CENTRAL = true, BY_RATE = true;
  template <class Pair> static SPH_INLINE void add_central(Pair &pair)
  {
    const auto a = larger(pair.mu[0], if_positive(-pair.mu[0], pair.mu[1]));
    const auto b = larger(pair.mu[1], if_positive(-pair.mu[1], pair.mu[0]));
    auto mean = 0.5 * pair.coeff[FIRST] * (a + b);
    if constexpr (!ONE_FLUID) mean += pair.coeff[LAST] * mean_coefficient(a, b);
    const auto drag = mean * (FR2 ? pair.vv : pair.by_metric) * pair.approach;
    pair.central -= drag;
    pair.heat[CHANNEL] += 0.5 * drag * pair.approach;
  }
};

// -a F V_i V_j u
struct AlongU : PairTerm<ShearChannel, ShearChannel::ALONG_U> {
  static constexpr bool VECTOR = true;
  template <class Pair> static SPH_INLINE void add_vector(Pair &pair)
  {
    const auto drag = pair.coeff[FIRST] * pair.vv;
    for (int d = 0; d < 3; d++) pair.f[d] -= drag * pair.u[d];
    pair.heat[CHANNEL] += 0.5 * drag * dot(pair.u, pair.u);
  }
};

#else

#ifndef LMP_SPH_DISSIPATION_CHANNEL_SHEAR_H
#define LMP_SPH_DISSIPATION_CHANNEL_SHEAR_H

namespace LAMMPS_NS {
namespace SPHDissipation {

  // mg:      f_i = -2 (n+2) mu sum_j F (u.e) e V_i V_j        P2 (41)
  // mg/fr:   f_i = -eta sum_j F r (u.e) e V_i V_j             P1 (15), (49)
  // mg/fr2:  f_i = -2 n mu/<r^2> sum_j F (u.r) r V_i V_j      a weight that is smooth at r = 0: sums over lattices and
  //                                                           rows are nearly the integrals; see the theory page
  // morris:  f_i = -2 mu sum_j F u V_i V_j                    Laplacian of the velocity
  // espanol: f_i = -a sum_j F [u + (u.e) e] V_i V_j           P. Espanol, M. Revenga, Phys. Rev. E 67,
  //                                                           026705 (2003), with bulk term zero
  // micropolar: f_i = -sum_j F V_i V_j [zeta1 (e.u*) e + zeta2 u*], u* = u - Omega_mean x r   P3 (6), (11)
  // micropolar mg/fr2: if zeta1 > 0, the term with zeta1 is the term of mg/fr2.  A negative zeta1 keeps the weight of zeta2:
  // with this weight, a negative zeta1 is admissible.

  // Return the prefactor of the shear term per mu, in dimension n; mean_radius, mean_square = integrals of r W and r^2 W
  inline double shear_factor(Shear shear, int n, double mean_radius, double mean_square)
  {
    switch (shear) {
      case Shear::MG:
      case Shear::MICROPOLAR:
        return 2.0 * (n + 2);
      case Shear::MG_FR:
        return 2.0 * n * (n + 2) / ((n + 1) * mean_radius);
      case Shear::MG_FR2:
      case Shear::MICROPOLAR_FR2:
        return 2.0 * n / mean_square;
      case Shear::MORRIS:
        return 2.0;
      case Shear::ESPANOL:
        return 2.0 * (n + 2) / (n + 3);
      default:
        return 0.0;
    }
  }

  inline double shear_factor(const PairFluid &fluid)
  {
    return shear_factor(fluid.shear, fluid.dim, fluid.mean_radius, fluid.mean_square);
  }

  // Return the bulk viscosity of the shear term, kappa = lambda + 2 mu/n, with lambda = mu for mg and lambda = -mu for
  // morris; P1 (66).  The form espanol is the sum of mg with mu/(n+3) and morris with mu (n+2)/(n+3).
  inline double intrinsic_kappa(Shear shear, int n, double mu)
  {
    switch (shear) {
      case Shear::MG:
      case Shear::MG_FR:
      case Shear::MG_FR2:
      case Shear::MICROPOLAR:
      case Shear::MICROPOLAR_FR2:
        return (1.0 + 2.0 / n) * mu;
      case Shear::MORRIS:
        return (2.0 / n - 1.0) * mu;
      case Shear::ESPANOL:
        return (2.0 / n - (n + 1.0) / (n + 3.0)) * mu;
      default:
        return 0.0;
    }
  }

  // Return the largest eigenvalue of the friction matrix, in units of nu/h^2, for all kernels, on lattices of 1, 2, 3
  // dimensions and in disorder, and next to walls (morris); surface: next to walls with surface_factor()
  inline double shear_rate(Shear shear, bool surface)
  {
    switch (shear) {
      case Shear::MG:
        return surface ? 45.0 : 21.0;
      case Shear::MG_FR:
        return surface ? 38.0 : 17.0;
      case Shear::MG_FR2:
        return surface ? 38.0 : 15.0;
      case Shear::MORRIS:
        return surface ? 20.0 : 8.0;
      case Shear::ESPANOL:
        return surface ? 24.0 : 10.0;
      default:
        return 0.0;
    }
  }

  // Return the rate of two terms, along e and along u, for an inertia per volume
  inline double rate_of_terms(int n, double hsq, double inertia, double along_r, double along_u,
                              bool surface = false)
  {
    const double mg = std::max(along_r, 0.0) / shear_factor(Shear::MG, n, 0.0, 0.0);
    const double morris = along_u / shear_factor(Shear::MORRIS, n, 0.0, 0.0);
    return (shear_rate(Shear::MG, surface) * mg + shear_rate(Shear::MORRIS, surface) * morris) /
        (inertia * hsq);
  }

  // Return zeta2 of a micropolar fluid; along_r is zeta1: mu = zeta1/(2(n+2)) + zeta2/4, mu_r = zeta2/4; P3 (28) with
  // the bulk term
  inline double slip_coefficient(const PairFluid &fluid)
  {
    return 4.0 * fluid.viscosity[MU_R];
  }

  struct ShearChannel : BaseChannel {
    static constexpr const char *NAME = "shear";
    enum { ALONG_R, BY_SQUARE, ALONG_U, ALIKE, UNLIKE, NPAIR };    // ALIKE, UNLIKE: per mu
    static constexpr int NTYPE = Rheology::NUMBER;
    static constexpr std::array<TypeKeyword, 7> TYPE_KEYWORDS = {
        {{"power", "n mu_min mu_max", 3, 0, RHEOLOGY},
         {"carreau", "lambda n a mu_inf", 4, 0, RHEOLOGY},
         {"cross", "lambda m mu_inf", 3, 0, RHEOLOGY},
         {"yield", "tau_y m", 2, 0, RHEOLOGY},
         {"smagorinsky", "length mu_max", 2, 0, RHEOLOGY},
         {"arrhenius", "E T0 factor_max", 3, 0, HEAT_CAPACITY | RHEOLOGY},
         {"solid", "factor", 1, 0, HEAT_CAPACITY | RHEOLOGY}}};
    static constexpr std::array<TypeVariable, 2> TYPE_VARIABLES = {
        {{"power_n", Rheology::POWER_N}, {"yield_stress", Rheology::YIELD_STRESS}}};

    static void set_coefficients(const PairFluid &fluid, const OwnWords &, double *own)
    {
      const double mu = fluid.viscosity[MU], factor = shear_factor(fluid);
      if (has_spins(fluid.shear)) {
        const double rest = mu - fluid.viscosity[MU_R];
        if (fluid.shear == Shear::MICROPOLAR_FR2 && rest > 0.0)
          own[BY_SQUARE] = factor * rest;
        else
          own[ALONG_R] = shear_factor(Shear::MICROPOLAR, fluid.dim, 0.0, 0.0) * rest;
        return;
      }
      if (fluid.by_rate) own[fluid.alike ? ALIKE : UNLIKE] = factor;
      if (fluid.shear == Shear::MG_FR2)
        own[BY_SQUARE] = factor * mu;
      else if (fluid.shear != Shear::MORRIS)
        own[ALONG_R] = factor * mu;
      if (fluid.shear == Shear::MORRIS || fluid.shear == Shear::ESPANOL) own[ALONG_U] = factor * mu;
    }
    SPH_FUNCTION static void add_friction(const double *own, PairFriction &friction)
    {
      friction.along += own[ALONG_R] + own[ALONG_U];
      friction.across += own[ALONG_U];
      friction.along_by_square += own[BY_SQUARE];
    }
    template <class Add>
    static void add_columns(const PairFluid &fluid, const OwnWords &, const double *own, Add &&add)
    {
      const double along = (own[BY_SQUARE] > 0.0) ? own[BY_SQUARE] : own[ALONG_R];
      if (has_spins(fluid.shear))
        add("zeta1", along);
      else
        add("shear_coeff", std::max(along, own[ALONG_U]));
      if (fluid.by_rate) add("largest_mu", fluid.largest_mu);
    }
    static double intrinsic_kappa(const PairFluid &fluid)
    {
      return SPHDissipation::intrinsic_kappa(fluid.shear, fluid.dim, fluid.viscosity[MU]);
    }
    static const char *inadmissible(const PairFluid &fluid, const OwnWords &)
    {
      return (fluid.viscosity[MU] >= 0.0) ? nullptr : "mu must be >= 0";
    }
    static const char *inadmissible_type(const double *type, int)
    {
      return Rheology::inadmissible(type);
    }
    static double rate(const PairFluid &fluid, const OwnWords &, const double *own,
                       const PairInertia &inertia)
    {
      if (has_spins(fluid.shear)) {
        const double by_square = shear_rate(Shear::MG_FR2, inertia.surface) * own[BY_SQUARE] /
            (shear_factor(fluid) * inertia.rho * inertia.hsq);
        return by_square +
            rate_of_terms(fluid.dim, inertia.hsq, inertia.rho, own[ALONG_R],
                          slip_coefficient(fluid), inertia.surface);
      }
      const double mu = fluid.by_rate ? fluid.largest_mu : fluid.viscosity[MU];
      return shear_rate(fluid.shear, inertia.surface) * mu / inertia.rho / inertia.hsq;
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
#endif
