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

// Bulk viscosity that relaxes: each process is a spring of the modulus rho g in series with a dashpot, a
// Maxwell element of the volume.  Its strain is x = ln(rho/rho_r) with the relaxed density rho_r of the
// particle, its pressure rho g x, d(ln rho_r)/dt = x/tau, and kappa_r = rho g tau its bulk viscosity at
// frequency 0.  L. I. Mandelstam, M. A. Leontovich, Zh. Eksp. Teor. Fiz. 7, 438 (1937); L. D. Landau,
// E. M. Lifshitz, Fluid Mechanics, section 81.
//
// For every ratio a = dt/tau of the time step: the pressure is rho g phi(a) x, phi = (1 - e^-a)/a, and after
// the forces ln rho_r grows by (1 - e^-a) x.  For a -> 0 this is the equation, for a -> infinity the bulk
// term kappa_r dlnrho/dt, and the mean power of a wave is positive at every frequency (theory page).
// Thermal noise adds sqrt(2 kB T dt/(m g tau)) xi to x.
//
// Vibration gives a gas such a relaxing bulk viscosity by energies: the vibrations of the molecules have the part m cvib T_v
// of the internal energy of a particle, the rest, m cv T, makes the pressure, and
//   dT_v/dt = (T - T_v)/tau_v,   dT/dt = w - cvib/cv (T - T_v)/tau_v
// with the rate w from work and all other heat.  In a time step dt of constant w, with
// tau_r = tau_v cv/(cv + cvib) and a = dt/tau_r, T_v grows by exactly
//   tau_r/tau_v [(1 - e^-a) (T - T_v) + w (dt - tau_r (1 - e^-a))].
// For sound this is the spring of tau = tau_r and rho g tau = p tau_v R cvib/(cv + cvib)^2, R = (gamma - 1) cv.
// K. F. Herzfeld, T. A. Litovitz, Absorption and Dispersion of Ultrasonic Waves (1959).
// Included by sph_dissipation_channel_list.h; sph_dissipation_channels.h has the notation.

#ifdef CHANNEL_CLASS
// clang-format off
ChannelClass(RelaxChannel)
ChannelClass(VibrationChannel)
// clang-format on
#elif !defined(CHANNEL_TERMS)

#ifndef LMP_SPH_DISSIPATION_CHANNEL_RELAX_H
#define LMP_SPH_DISSIPATION_CHANNEL_RELAX_H

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Numbers of a process of a type for a time step
  struct Relaxation {
    double stiffness;    // g phi, velocity^2
    double part;         // 1 - e^-a, part of the strain that relaxes
    double fluidity;     // 1/(g tau), time/velocity^2
    double noise;        // sqrt(2 dt/(g tau)), 1/velocity
  };

  // Numbers of the vibrations of a type for a time step: T_v grows by part (T - T_v) + delay w
  struct Vibration {
    double heat_capacity;    // cvib, per mass
    double rate;             // 1/tau_v
    double part;
    double delay;    // time
  };

  struct RelaxChannel : BaseChannel, BaseState {
    static constexpr const char *NAME = "relax";
    static constexpr bool ELASTIC = true, OPTIONAL = true;
    static constexpr int MOST = 8;    // processes
    enum { KAPPA_R, TAU, GROUP };     // numbers of a process
    static constexpr int NTYPE = GROUP * MOST;
    static constexpr std::array<TypeKeyword, 1> TYPE_KEYWORDS = {
        {{"relax", "kappa_r tau", NTYPE, GROUP, NOTHING}}};
    static constexpr std::array<TypeVariable, 2> TYPE_VARIABLES = {
        {{"kappa_r", KAPPA_R}, {"tau", TAU}}};
    static constexpr const char *FIELD = "rho_relaxed", *KEYWORD = "relax";
    static constexpr const char *INSTEAD = "a kappa that is larger by its kappa_r";
    static constexpr StateKind KIND = StateKind::STRAIN;
    typedef Relaxation Numbers;

    // Return the number of processes of a type
    static int count(const double *type)
    {
      int n = 0;
      while (n < MOST && type[GROUP * n] > 0.0) n++;
      return n;
    }
    static double kappa(const double *type, int k) { return type[GROUP * k]; }
    static double time(const double *type, int k) { return type[GROUP * k + TAU]; }

    // Return the numbers of process k of a type with the reference density rho0, for a time step dt
    static Relaxation process(const double *type, int k, double rho0, double, double dt)
    {
      const double g_tau = kappa(type, k) / rho0, a = dt / time(type, k);
      const double part = -std::expm1(-a);
      return {g_tau / time(type, k) * (a > 0.0 ? part / a : 1.0), part, 1.0 / g_tau,
              std::sqrt(2.0 * dt / g_tau)};
    }

    static double stiffness(const double *type, double rho0, double dt)
    {
      double sum = 0.0;
      for (int k = 0; k < count(type); k++) sum += process(type, k, rho0, 0.0, dt).stiffness;
      return sum;
    }

    // Return pressure over density, g phi x; energy, m g phi x^2/2; heat per mass and time, (p/rho)^2/(g tau)
    template <class Site> SPH_FUNCTION static double pressure(const Site &site)
    {
      return site.own.stiffness * site.strain();
    }
    template <class Site> SPH_FUNCTION static double energy(const Site &site)
    {
      const double x = site.strain();
      return 0.5 * site.mass() * (site.own.stiffness * x * x);
    }
    template <class Site> SPH_FUNCTION static double heat(const Site &site)
    {
      const double p = pressure(site);
      return p * p * site.own.fluidity;
    }
    template <class Site> SPH_FUNCTION static void advance(const Site &site, double, double noise)
    {
      site.state() *= exp_of(site.own.part * site.strain() + noise);
    }
    static double noise(const Relaxation &process) { return -process.noise; }

    template <class Add>
    static void add_columns(const PairFluid &, const OwnWords &words, const double *, Add &&add)
    {
      double sum = 0.0;
      for (int k = 0; k < MOST; k++) sum += kappa(words.type, k);
      add("kappa_r", sum);
    }
    static const char *inadmissible_type(const double *type, int)
    {
      for (int k = 0; k < MOST; k++) {
        const double *const one = type + GROUP * k;
        const bool none = (one[0] == 0.0 && one[1] == 0.0 && k >= count(type));
        const bool finite = std::isfinite(one[0]) && std::isfinite(one[1]);
        if (!none && !(one[0] > 0.0 && one[1] > 0.0 && finite))
          return "relax must have kappa_r > 0 and tau > 0";
      }
      return nullptr;
    }
  };

  struct VibrationChannel : BaseChannel, BaseState {
    static constexpr const char *NAME = "vibration";
    static constexpr bool ELASTIC = true, OPTIONAL = true;
    static constexpr bool OF_MOTION = false;    // RelaxChannel gives out the heat
    enum { CVIB, TAU };
    static constexpr int NTYPE = 2;
    static constexpr std::array<TypeKeyword, 1> TYPE_KEYWORDS = {
        {{"vibration", "cvib tau_v", NTYPE, NTYPE,
          HEAT_CAPACITY | NO_NOISE | EOS_IDEAL | NO_OPEN_ENDS}}};

    static constexpr const char *FIELD = "tvib";
    using Room = RelaxChannel;
    static constexpr bool READS_RATE = true;
    typedef Vibration Numbers;

    static int count(const double *type) { return (type[CVIB] > 0.0) ? 1 : 0; }

    // Return the numbers of a type with the heat capacity cv per mass, without vibrations, for a time step dt
    static Vibration process(const double *type, int, double, double cv, double dt)
    {
      const double cvib = type[CVIB], tau_v = type[TAU];
      const double share = cv / (cv + cvib), tau = tau_v * share, a = dt / tau;
      const double part = -std::expm1(-a);
      return {cvib, 1.0 / tau_v, share * part, share * tau * (a - part)};
    }

    template <class Site> SPH_FUNCTION static double energy(const Site &site)
    {
      return site.mass() * site.own.heat_capacity * site.state();
    }
    // Return T times the rate of entropy, per mass: cvib/tau_v (T - T_v)^2/T_v
    template <class Site> SPH_FUNCTION static double heat(const Site &site)
    {
      if (!(site.state() > 0.0)) return 0.0;
      const double difference = site.rows.temperature(site.i) - site.state();
      return site.own.heat_capacity * site.own.rate * difference * difference / site.state();
    }
    // Set T_v of a new particle in equilibrium with the rest of the heat
    template <class Site> SPH_FUNCTION static void begin(const Site &site, double temperature)
    {
      if (site.state() > 0.0) return;
      site.state() = 0.0;
      if (temperature < 0.0) {
        const double cv = site.rows.types[site.rows.type[site.i]].heat_capacity;
        temperature =
            site.rows.thermal_energy(site.i) / (site.mass() * (cv + site.own.heat_capacity));
      }
      if (temperature > 0.0) site.state() = temperature;
    }
    template <class Site> SPH_FUNCTION static void advance(const Site &site, double rate, double)
    {
      site.state() +=
          site.own.part * (site.rows.temperature(site.i) - site.state()) + site.own.delay * rate;
    }

    template <class Add>
    static void add_columns(const PairFluid &, const OwnWords &words, const double *, Add &&add)
    {
      add("cvib", words.type[CVIB]);
    }
    static const char *inadmissible_type(const double *type, int)
    {
      const double cvib = type[CVIB], tau_v = type[TAU];
      if (cvib == 0.0 && tau_v == 0.0) return nullptr;
      if (!(cvib > 0.0 && tau_v > 0.0 && std::isfinite(cvib) && std::isfinite(tau_v)))
        return "vibration must have cvib > 0 and tau_v > 0";
      return nullptr;
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
#endif
