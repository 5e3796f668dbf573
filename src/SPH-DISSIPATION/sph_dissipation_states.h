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

#ifndef LMP_SPH_DISSIPATION_STATES_H
#define LMP_SPH_DISSIPATION_STATES_H

// The states of a particle: numbers that channels keep from one step to the next.  A channel with states also derives from
// BaseState; StateList has all states, and all other code calls StateList.  Forces only read states; the integrator
// advances them at the beginning of a step.  No LAMMPS include.

#include "sph_dissipation_function.h"

#include <cmath>
#include <type_traits>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  constexpr int MOST_STATES = 16;    // of a particle: room in arrays

  // Change of a state where particles split, merge, or get another mass
  enum class StateKind {
    STRAIN,    // density at rest, mass/length^n: the strain ln(rho/state) stays, means are by mass
    PER_MASS,    // the state stays, means are by mass
    EXTENSIVE    // the state is shared, added up, and proportional to the mass
  };

  // Return ln(a/b); return e^x.  Near 1, series without a function call are exact to rounding errors

  SPH_FUNCTION double log_of_ratio(double a, double b)
  {
    const double q = (a - b) / (a + b), s = q * q;
    if (!(s < 1.0e-4)) return std::log(a / b);
    return 2.0 * q * (1.0 + s * (1.0 / 3.0 + s * (1.0 / 5.0 + s * (1.0 / 7.0 + s * (1.0 / 9.0)))));
  }

  SPH_FUNCTION double exp_of(double x)
  {
    if (!(std::fabs(x) < 0.01)) return std::exp(x);
    const double far = 1.0 / 24.0 + x * (1.0 / 120.0 + x * (1.0 / 720.0));
    return 1.0 + x * (1.0 + x * (1.0 / 2.0 + x * (1.0 / 6.0 + x * far)));
  }

  // Return the strain ln(density/rest), with the density at rest; 0 if one of them is not positive

  SPH_FUNCTION double strain_at(double density, double rest)
  {
    return (rest > 0.0 && density > 0.0) ? log_of_ratio(density, rest) : 0.0;
  }

  // A state of a particle, as its channel reads it: own = numbers of the state for the time step, rows = StateRows

  template <class Rows, class Channel> struct Site {
    const Rows &rows;
    int i, slot;    // particle; place of the state among all
    const typename Channel::Numbers &own;

    SPH_FUNCTION double &state() const { return rows.state[slot][i]; }
    SPH_FUNCTION double strain() const { return strain_at(rho(), state()); }
    SPH_FUNCTION double mass() const { return rows.rmass[i]; }
    SPH_FUNCTION double rho() const { return rows.rho[i]; }
    SPH_FUNCTION double shear_rate() const { return rows.shear_rate[i]; }    // with by_rate
    // Return the rate of the state by the flow of the channel
    SPH_FUNCTION double flow() const { return rows.template rate_of<Channel>(i); }
  };

  // Defaults of the members of a state.  The channel must define: FIELD, the name of the custom property (with MOST > 1, the
  // number of the state follows this name); KEYWORD or Room; count(type), the number of states of a type; and process(type,
  // k, rho0, cv, dt), which returns the Numbers of state k for a time step.

  struct BaseState {
    static constexpr int MOST = 1;    // of a particle
    static constexpr StateKind KIND = StateKind::PER_MASS;
    // KEYWORD: keyword of the atom style that makes room, with a number N if MOST > 1.  Or Room: an earlier channel of the
    // list, whose keyword makes room; then data files have the state in the last of the N columns of the earlier channel.
    static constexpr const char *KEYWORD = nullptr;
    using Room = void;
    static constexpr bool GHOSTS = false;          // ghosts have the state
    static constexpr double LARGEST = HUGE_VAL;    // of a state per mass
    static constexpr bool READS_RATE = false;      // advance() reads the rate of the temperature
    // Coefficient to use instead of a state whose time(type, k) is far below the time step; nullptr: none
    static constexpr const char *INSTEAD = nullptr;

    // Return pressure over density; the energy, elastic for StateKind::STRAIN; the heat of this energy per mass and time
    template <class Site> SPH_FUNCTION static double pressure(const Site &) { return 0.0; }
    template <class Site> SPH_FUNCTION static double energy(const Site &) { return 0.0; }
    template <class Site> SPH_FUNCTION static double heat(const Site &) { return 0.0; }
    // Return the addition of the state to mu; return the largest addition for a type.  The keyword must need RHEOLOGY
    template <class Site> SPH_FUNCTION static double viscosity(const Site &) { return 0.0; }
    static double largest_viscosity(const double *) { return 0.0; }
    // Set the state of a particle if the particle is new (state 0); not called for StateKind::STRAIN.  Argument: temperature
    // of the new particle; negative: the particle already has its internal energy
    template <class Site> SPH_FUNCTION static void begin(const Site &, double) {}
    // Advance by a time step.  Arguments: rate of the temperature at constant states; noise of strength noise(), or 0
    template <class Site> SPH_FUNCTION static void advance(const Site &, double, double) {}
    template <class Numbers> static double noise(const Numbers &)
    {
      return 0.0;
    }    // of sqrt(kB T/m) xi
    // Return the sum that all states of a type add to the square of the speed of sound, with a time step
    static double stiffness(const double *, double, double) { return 0.0; }
  };

  // Numbers of the states of a channel, for a type and a time step
  template <class Channel> struct Slots {
    int count = 0;
    typename Channel::Numbers of[Channel::MOST] = {};
  };

  // The states of a channel as data, for code that only stores and moves states
  struct StateInfo {
    const char *name, *field, *keyword;
    StateKind kind;
    int first, most;    // places of its states
    int owner;          // first place of the channel with the keyword that makes room
    bool ghosts;
    double largest;
    // Return the number of states of a type with these coefficients; the time of state k (nullptr without INSTEAD)
    int (*count)(const double *coeffs);
    double (*time)(const double *coeffs, int k);
    const char *instead;
    bool has_column() const { return owner == first; }    // data files have its own column
  };

  template <class... One> struct StateList {
    static constexpr int MOST = (One::MOST + ...);    // states of a particle

    struct Numbers : Slots<One>... {
      SPH_FUNCTION bool any() const { return ((Slots<One>::count > 0) || ...); }
      SPH_FUNCTION bool read_rate() const
      {
        return ((One::READS_RATE && Slots<One>::count > 0) || ...);
      }
    };

    // Return the place of the first state of a channel
    template <class Channel> SPH_FUNCTION static constexpr int first()
    {
      int before = 0;
      bool found = false;
      ((found = found || std::is_same<One, Channel>::value, before += found ? 0 : One::MOST), ...);
      return before;
    }
    template <class Channel>
    using Owner = std::conditional_t<std::is_void<typename Channel::Room>::value, Channel,
                                     typename Channel::Room>;

    template <class Coeffs> static std::vector<StateInfo> table()
    {
      return {{One::NAME, One::FIELD, One::KEYWORD, One::KIND, first<One>(), One::MOST,
               first<Owner<One>>(), One::GHOSTS, One::LARGEST, count_of<One, Coeffs>,
               time_of<One, Coeffs>(), One::INSTEAD}...};
    }

    // Call function(channel) for each channel; call function(channel, site) for each state of particle i
    template <class Function> static void visit(Function &&function) { (function(One()), ...); }
    template <class Rows, class Function>
    SPH_FUNCTION static void each(const Rows &rows, int i, Function &&function)
    {
      (each_of<One>(rows.numbers(i), rows, i, function), ...);
    }

    template <class Coeffs>
    static Numbers numbers(const Coeffs &type, double rho0, double cv, double dt)
    {
      Numbers result;
      (set(type, rho0, cv, dt, static_cast<Slots<One> &>(result)), ...);
      return result;
    }
    template <class Coeffs> static double stiffness(const Coeffs &type, double rho0, double dt)
    {
      return (One::stiffness(type.template of<One>(), rho0, dt) + ...);
    }
    template <class Coeffs> static double largest_viscosity(const Coeffs &type)
    {
      return (One::largest_viscosity(type.template of<One>()) + ...);
    }
    // Return the strength of the noise of the state at a place
    static double noise(const Numbers &numbers, int slot)
    {
      return (noise_of<One>(numbers, slot - first<One>()) + ...);
    }

    // Drop the states that the type of a particle does not have; return the bits of the dropped places.  A state -1 comes
    // from a data file: its number is in the last column of another channel that is > 0 and that the type does not need.
    template <class Rows> static int keep(const Rows &rows, int i)
    {
      int others = 0;
      Spare spare = {0.0, 0};
      (keep_of<One>(rows.numbers(i), rows, i, spare, others), ...);
      return others;
    }

   private:
    struct Spare {
      double value;
      int bit;    // bit of the place
    };
    template <class Channel, class Coeffs> static int count_of(const double *coeffs)
    {
      return Channel::count(coeffs + Coeffs::template first_of<Channel>());
    }
    template <class Channel, class Coeffs> static auto time_of()
    {
      double (*time)(const double *, int) = nullptr;
      if constexpr (Channel::INSTEAD != nullptr)
        time = [](const double *coeffs, int k) {
          return Channel::time(coeffs + Coeffs::template first_of<Channel>(), k);
        };
      return time;
    }
    template <class Channel, class Rows, class Function>
    SPH_FUNCTION static void each_of(const Slots<Channel> &own, const Rows &rows, int i,
                                     Function &&function)
    {
      for (int k = 0; k < own.count; k++)
        function(Channel(), Site<Rows, Channel>{rows, i, first<Channel>() + k, own.of[k]});
    }
    template <class Channel, class Coeffs>
    static void set(const Coeffs &type, double rho0, double cv, double dt, Slots<Channel> &own)
    {
      const double *const words = type.template of<Channel>();
      own.count = Channel::count(words);
      for (int k = 0; k < own.count; k++) own.of[k] = Channel::process(words, k, rho0, cv, dt);
    }
    template <class Channel> static double noise_of(const Slots<Channel> &own, int k)
    {
      return (k >= 0 && k < own.count) ? Channel::noise(own.of[k]) : 0.0;
    }
    template <class Channel, class Rows>
    static void keep_of(const Slots<Channel> &own, const Rows &rows, int i, Spare &spare,
                        int &others)
    {
      double *const *const state = rows.state + first<Channel>();
      if (!std::is_void<typename Channel::Room>::value && state[0] && state[0][i] < 0.0) {
        state[0][i] = own.count ? spare.value : 0.0;
        if (own.count) others &= ~spare.bit;
      }
      for (int k = own.count; k < Channel::MOST && state[k]; k++) {
        const int bit = 1 << (first<Channel>() + k);
        if (state[k][i] != 0.0) others |= bit;
        if (state[k][i] > 0.0) spare = {state[k][i], bit};
        state[k][i] = 0.0;
      }
    }
  };

  // handed_on(): return the number per mass that a particle of this mass and density hands on when it splits or merges.
  // taken_over(): return the state of a particle that gets this number; for a density at rest, minus its ratio to the
  // density that the next forces find.  rescaled(): return the state after the mass was multiplied by a factor at the same
  // volume.

  inline double handed_on(StateKind kind, double state, double mass, double rho)
  {
    if (kind == StateKind::EXTENSIVE) return state / mass;
    return (kind == StateKind::STRAIN) ? strain_at(rho, state) : state;
  }
  inline double taken_over(StateKind kind, double state, double mass, double value)
  {
    if (kind == StateKind::EXTENSIVE) return value * mass;
    if (kind == StateKind::PER_MASS) return value;
    return (state != 0.0) ? -std::exp(-value) : 0.0;    // 0: the type does not have the state
  }
  inline double rescaled(StateKind kind, double state, double factor)
  {
    const bool waits = (kind == StateKind::STRAIN && state < 0.0);
    return (waits || kind == StateKind::PER_MASS) ? state : state * factor;
  }

  // List of the channels that derive from a base class

  template <class Base, class List, class... Rest> struct ListOf {
    typedef List type;
  };
  template <class Base, template <class...> class List, class... Found, class One, class... Rest>
  struct ListOf<Base, List<Found...>, One, Rest...> :
      std::conditional_t<std::is_base_of<Base, One>::value,
                         ListOf<Base, List<Found..., One>, Rest...>,
                         ListOf<Base, List<Found...>, Rest...>> {
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
