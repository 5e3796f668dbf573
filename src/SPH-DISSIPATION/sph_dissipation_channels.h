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

// The dissipative channels of a fluid.  The dissipation function is a sum of terms; a term has a rate, a coefficient, and a
// weight.  Each channel defines its terms in its own header; all other code uses the lists of channels in this file.
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
//
// The header of a channel has four parts; a macro selects one.  CHANNEL_CLASS: the name of the channel in the list.
// CHANNEL_TERMS: the terms of a pair; the loops include these in more than one namespace.  OPTIONAL_TERMS: the names of the
// terms that any form of the shear force may have.  None of the three: the struct of the channel.  No LAMMPS include.

#ifdef CHANNEL_TERMS

#include "sph_dissipation_channel_list.h"

// A form of the pair force: a list of terms, for the loops

template <class... Term> struct Form {
  static constexpr bool CENTRAL = (Term::CENTRAL || ...);
  static constexpr bool VECTOR = (Term::VECTOR || ...);
  static constexpr bool BY_DISTANCE = (Term::BY_DISTANCE || ...);
  static constexpr bool BY_SQUARE = (Term::BY_SQUARE || ...);
  static constexpr bool SPINS = (Term::SPINS || ...);
  static constexpr bool BY_RATE = (Term::BY_RATE || ...);

  // Return whether a term heats this channel; return the bits of all heated channels; return the last channel with spins
  static SPH_INLINE constexpr bool heats(int channel)
  {
    return ((channel == Term::CHANNEL) || ...);
  }
  static constexpr int channels()
  {
    int bits = 0;
    ((bits |= 1 << Term::CHANNEL), ...);
    return bits;
  }
  static constexpr int of_spins()
  {
    int last = 0;
    ((Term::SPINS ? void(last = Term::CHANNEL) : void()), ...);
    return last;
  }
  static constexpr bool uses(int coefficient)
  {
    return ((coefficient >= Term::FIRST && coefficient <= Term::LAST) || ...);
  }
  template <class Pair> static SPH_INLINE void add_central(Pair &pair)
  {
    (Term::add_central(pair), ...);
  }
  template <class Pair> static SPH_INLINE void add_vector(Pair &pair)
  {
    (Term::add_vector(pair), ...);
  }
};

// Forms with all optional terms, for runs with any of these terms.  The form espanol has all other terms of fluids without
// spins, and also uses FullForm.
#undef CHANNEL_TERMS
#define OPTIONAL_TERMS
#define OptionalTerm(One) , One
// clang-format off
using FullForm = Form<AlongR<false>, AlongRBySquare, AlongU
#include "sph_dissipation_channel_list.h"
                      >;
using FullSpinForm = Form<AlongR<false>, AlongRBySquare, Slip, SpinDiffusion
#include "sph_dissipation_channel_list.h"
                          >;
// clang-format on
#undef OptionalTerm
#undef OPTIONAL_TERMS
#define CHANNEL_TERMS

// Call function(Form()) for the form with these terms

template <class Function> void with_form(const Terms &terms, Function &&function)
{
  if (terms.by_rate) {
    const bool one_fluid = terms.one_fluid;
    if (terms.shear == Shear::MG_FR2)
      return one_fluid ? function(Form<ByRate<true, true>>())
                       : function(Form<ByRate<false, true>>());
    return one_fluid ? function(Form<ByRate<true, false>>())
                     : function(Form<ByRate<false, false>>());
  }
  if (terms.optional && has_spins(terms.shear)) return function(FullSpinForm());
  if (terms.optional) return function(FullForm());
  switch (terms.shear) {
    case Shear::MG:
      return function(Form<AlongR<false>>());
    case Shear::MG_FR:
      return function(Form<AlongR<true>>());
    case Shear::MG_FR2:
      return function(Form<AlongRBySquare>());
    case Shear::MORRIS:
      return function(Form<AlongU>());
    case Shear::ESPANOL:
      return function(FullForm());
    case Shear::MICROPOLAR:
      return function(Form<AlongR<false>, Slip, SpinDiffusion>());
    case Shear::MICROPOLAR_FR2:
      return function(Form<AlongR<false>, AlongRBySquare, Slip, SpinDiffusion>());
    default:
      return function(Form<>());
  }
}

#else

#ifndef LMP_SPH_DISSIPATION_CHANNELS_H
#define LMP_SPH_DISSIPATION_CHANNELS_H

#include "sph_dissipation_kernel.h"
#include "sph_dissipation_rheology.h"
#include "sph_dissipation_settings.h"
#include "sph_dissipation_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Name for other commands that vary a coefficient of a type; coefficient = its number in the channel.  In the second and
  // later groups of a keyword, the number of the group follows the name.
  struct TypeVariable {
    const char *name;
    int coefficient;
  };

  // Friction tensor of a pair along and across e, for the slip velocity and for the difference of the spins, in units of
  // F V_i V_j (mg/fr: F r V_i V_j); along_by_square: in units of F r^2 V_i V_j.  The noise is the root of this tensor.
  struct PairFriction {
    double along, across, spin_along, spin_across, along_by_square;
  };

  // Input of the coefficients of a pair of types
  struct PairFluid {
    Shear shear = Shear(0);
    int dim = 0;                                                   // of the kernel
    double support = 0.0, mean_radius = 0.0, mean_square = 0.0;    // integrals of r W and r^2 W
    double viscosity[NVISCOSITY] = {};
    double zeta = 0.0;             // coefficient of the bulk term, mean of the types
    double heat_capacity = 0.0;    // per mass, the smaller one of both types
    // by_rate: mu of any type is not constant.  Only then: alike, both types are one fluid; largest mu and largest |zeta|
    bool by_rate = false, alike = false;
    double largest_mu = 0.0, largest_zeta = 0.0;
  };

  // Coefficients from pair_coeff for one channel.  type, smaller: coefficients of a type, or the larger and the smaller
  // coefficients of two types; unlike: coefficients of unlike types
  struct OwnWords {
    const double *type, *smaller, *unlike;
    double flow = 0.0;    // mean coefficient of the flow of the channel
  };

  // Inertia of the motion that a channel damps, for the rate of the fastest mode
  struct PairInertia {
    double hsq = 0.0;            // square of the stability length, see stability_length_squared()
    double rho = 0.0;            // density: inertia of velocities
    double rho_inertia = 0.0;    // density times moment of inertia per mass: inertia of spins
    bool surface = false;        // next to surfaces with surface_factor()
  };

  // Drag of a single particle against a stream, force -b V (u - stream)
  struct Drag {
    double b = 0.0;    // pressure * time / length^2
    double stream[3] = {0.0, 0.0, 0.0};
  };

  // Defaults of the members of a channel
  struct BaseChannel {
    static constexpr bool SPINS = false;    // needs particles that spin
    // stores energy: the channel has no rate, but raises the speed of sound
    static constexpr bool ELASTIC = false;
    // turns motion into heat: compute sph/dissipation has a number for the channel
    static constexpr bool OF_MOTION = true;
    // true: if all coefficients of pairs are 0, the loops leave out the terms, and the table leaves out the columns
    static constexpr bool OPTIONAL = false;
    // pairs have an energy, see pair_energy() and cohesion(), and the surface has waves, see wave_step()
    static constexpr bool PAIR_ENERGY = false;
    // Keywords of pair_coeff for a type, with NTYPE coefficients in all; names for other commands that vary these; keywords
    // of unlike types, each with one number (default 0), which are also the names for other commands
    static constexpr int NTYPE = 0;
    static constexpr std::array<TypeKeyword, 0> TYPE_KEYWORDS = {};
    static constexpr std::array<TypeVariable, 0> TYPE_VARIABLES = {};
    static constexpr std::array<const char *, 0> UNLIKE_KEYWORDS = {};
    // Return the inequality that the coefficients of a type violate in a box of this dimension; return the inequality that a
    // pair of types violates; return the name of ignored coefficients of a type.  nullptr: there is none
    static const char *inadmissible_type(const double *, int) { return nullptr; }
    static const char *inadmissible(const PairFluid &, const OwnWords &) { return nullptr; }
    static const char *ignored(const double *) { return nullptr; }
    // NPAIR: number of coefficients for a pair of types.  Set these coefficients, own; add their friction tensor
    enum { NPAIR };
    static void set_coefficients(const PairFluid &, const OwnWords &, double *) {}
    SPH_FUNCTION static void add_friction(const double *, PairFriction &) {}
    // Call add(name, value) for each column of coefficients in the table of the log
    template <class Add>
    static void add_columns(const PairFluid &, const OwnWords &, const double *, Add &&)
    {
    }
    // Return the bulk viscosity of the pair terms of the channel
    static double intrinsic_kappa(const PairFluid &) { return 0.0; }
    // Return the rate of the fastest mode of the channel, 1/time
    static double rate(const PairFluid &, const OwnWords &, const double *, const PairInertia &)
    {
      return 0.0;
    }

    // Return a in the energy of a pair of unlike types, a w_i w_j W(r), W of PairEnergyKernel; return A of CohesionKernel;
    // return the largest stable step of the waves
    static double pair_energy(const PairFluid &, const OwnWords &) { return 0.0; }
    static double cohesion(const PairFluid &, const OwnWords &) { return 0.0; }
    static double wave_step(const OwnWords &, const PairInertia &) { return UNLIMITED_STEP; }

    // Return the drag of single particles with these coefficients of their type, for force, heat, and noise
    SPH_FUNCTION static Drag drag(const double *) { return {}; }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#include "sph_dissipation_channel_list.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // The list of the channels.  Each channel has the members of BaseChannel, and a NAME: the title of its time step in the
  // table of the log.  The terms of a channel derive from PairTerm.
  template <class Base, class... One> struct ChannelList {
    // Return the sum of number[k] over the channels before Channel
    template <class Channel>
    SPH_FUNCTION static constexpr int sum_before(const int (&number)[sizeof...(One)])
    {
      int sum = 0, k = 0;
      bool found = false;
      ((found = found || std::is_same<One, Channel>::value, sum += found ? 0 : number[k++]), ...);
      return sum;
    }

    // Number of channels that turn motion into heat; return the place of a channel among these
    static constexpr int NUMBER = ((One::OF_MOTION ? 1 : 0) + ...);
    template <class Channel> SPH_FUNCTION static constexpr int place()
    {
      return sum_before<Channel>({One::OF_MOTION...});
    }
    // Numbers of coefficients of pairs of types, of types, and of unlike types; return the first coefficient of a channel
    static constexpr int NPAIR = (One::NPAIR + ...), NTYPE = (One::NTYPE + ...);
    static constexpr int NUNLIKE = (static_cast<int>(One::UNLIKE_KEYWORDS.size()) + ...);
    template <class Channel> SPH_FUNCTION static constexpr int first()
    {
      return sum_before<Channel>({One::NPAIR...});
    }
    template <class Channel> SPH_FUNCTION static constexpr int first_of_type()
    {
      return sum_before<Channel>({One::NTYPE...});
    }
    template <class Channel> static constexpr int first_of_unlike()
    {
      return sum_before<Channel>({static_cast<int>(One::UNLIKE_KEYWORDS.size())...});
    }

    template <class Function> static void visit(bool spins, Function &&function)
    {
      ((One::SPINS && !spins ? void() : function(One())), ...);
    }
    // Return the friction tensor of a pair of types with these coefficients
    SPH_FUNCTION static PairFriction friction(bool spins, const double *coeff)
    {
      PairFriction sum = {};
      ((One::SPINS && !spins ? void() : One::add_friction(coeff + first<One>(), sum)), ...);
      return sum;
    }
    // Return the sum of the coefficients of drag; type = coefficients of a type, of all channels
    SPH_FUNCTION static double drag(const double *type)
    {
      return (One::drag(type + first_of_type<One>()).b + ...);
    }

    // Add the drag of a particle of volume vol and velocity u to the force and, by channel, to the heat per time.  linear:
    // the drag is relative to rest instead of the stream
    SPH_FUNCTION static void add_drag(const double *type, double vol, const double *u, bool linear,
                                      double *force, double *heat)
    {
      int channel = 0;
      ((One::OF_MOTION ? add_drag(One::drag(type + first_of_type<One>()), vol, u, linear, force,
                                  heat[channel++])
                       : void()),
       ...);
    }
    SPH_FUNCTION static void add_drag(const Drag &drag, double vol, const double *u, bool linear,
                                      double *force, double &heat)
    {
      for (int d = 0; d < 3; d++) {
        const double slip = u[d] - (linear ? 0.0 : drag.stream[d]);
        force[d] -= drag.b * vol * slip;
        heat += drag.b * vol * slip * slip;
      }
    }
  };

  // clang-format off
#define CHANNEL_CLASS
#define ChannelClass(One) , One
  using Channels = ChannelList<BaseChannel
#include "sph_dissipation_channel_list.h"
                               >;
  // the channels with a state
  using States = ListOf<BaseState, StateList<>
#include "sph_dissipation_channel_list.h"
                        >::type;
  // the channels with a flow
  using Flows = ListOf<BaseFlow, FlowList<>
#include "sph_dissipation_channel_list.h"
                       >::type;
#undef ChannelClass
#undef CHANNEL_CLASS
  // clang-format on

  constexpr int NCHANNEL = Channels::NUMBER;    // channels that turn motion into heat

  // Place of the heat of the bulk term.  This term is not a term of pairs

  constexpr int BULK_HEAT = Channels::place<BulkChannel>();

  static_assert(HEAT_FLOW == Flows::place<HeatChannel>(), "HEAT_FLOW is the place of another flow");
  static_assert(States::MOST <= MOST_STATES, "MOST_STATES is too small");

  // Coefficients of the terms of two types, one channel after the other:
  //   f_i = -sum_j F V_i V_j [along_r (e.u) e + along_u u + zeta2 u*]
  //   tau_i = 1/2 sum_j F V_i V_j zeta2 r x u* - sum_j F V_i V_j [xi1 (e.dOmega) e + xi2 dOmega]
  // mg/fr has F r instead of F before along_r; mg/fr2 has a term F r^2 V_i V_j by_square (e.u) e.  The coefficients of
  // optional terms follow, see the headers of these channels
  struct PairCoeff {
    double a[Channels::NPAIR];

    // Return the coefficients of a channel
    template <class Channel> const double *of() const { return a + Channels::first<Channel>(); }
    template <class Channel> double *of() { return a + Channels::first<Channel>(); }
  };

  // Coefficients of a type by keyword, one channel after the other
  struct TypeCoeffs {
    double a[Channels::NTYPE] = {};

    TypeCoeffs() = default;
    explicit TypeCoeffs(const std::vector<double> &all)
    {
      std::copy_n(all.begin(), Channels::NTYPE, a);
    }

    // Return the first place, and the coefficients, of a channel
    template <class Channel> SPH_FUNCTION static constexpr int first_of()
    {
      return Channels::first_of_type<Channel>();
    }
    template <class Channel> SPH_FUNCTION const double *of() const
    {
      return a + first_of<Channel>();
    }
    SPH_FUNCTION const double *rheology() const { return of<ShearChannel>(); }
    SPH_FUNCTION double drag() const { return Channels::drag(a); }
    double gamma() const { return of<HeatChannel>()[HeatChannel::GAMMA]; }    // gruneisen
    double T0() const { return of<HeatChannel>()[HeatChannel::T0]; }
    // Return the temperature at a heat per mass; return this heat; return the solid fraction, 0 without melt
    SPH_FUNCTION double temperature(double cv, double q) const
    {
      return HeatChannel::temperature(of<HeatChannel>(), cv, q);
    }
    SPH_FUNCTION double heat(double cv, double T) const
    {
      return HeatChannel::heat(of<HeatChannel>(), cv, T);
    }
    SPH_FUNCTION double solid_fraction(double T) const
    {
      return HeatChannel::solid_fraction(of<HeatChannel>(), T);
    }
    bool melts() const { return solid_fraction(0.0) > 0.0; }
  };

  // A pair of types with its coefficients from pair_coeff for all channels
  struct TypePair : PairFluid {
    TypeCoeffs type, smaller;    // the larger and the smaller coefficients of both types
    double unlike[Channels::NUNLIKE + 1] = {};
    double flow[Flows::NUMBER] = {};    // mean of the types

    // Return the coefficients for a channel
    template <class Channel> OwnWords words() const
    {
      double own = 0.0;
      if constexpr (std::is_base_of<BaseFlow, Channel>::value) own = flow[Flows::place<Channel>()];
      return {type.of<Channel>(), smaller.of<Channel>(),
              unlike + Channels::first_of_unlike<Channel>(), own};
    }
  };

  // Return the keywords of the coefficients of a type, of all channels
  inline std::vector<TypeKeyword> type_keywords()
  {
    std::vector<TypeKeyword> all;
    int first = 0;
    Channels::visit(true, [&](auto channel) {
      for (TypeKeyword one : channel.TYPE_KEYWORDS) {
        one.first = first;
        first += one.count;
        all.push_back(one);
      }
    });
    return all;
  }

  // Return the names for other commands that vary coefficients of a type, with the places in TypeCoeffs; groups are in the
  // order of their numbers
  inline std::vector<std::pair<std::string, int>> type_variables()
  {
    std::vector<std::pair<std::string, int>> all;
    const std::vector<TypeKeyword> keywords = type_keywords();
    Channels::visit(true, [&](auto channel) {
      for (const TypeVariable &one : channel.TYPE_VARIABLES) {
        const int k = Channels::first_of_type<decltype(channel)>() + one.coefficient;
        for (const TypeKeyword &word : keywords) {
          if (k < word.first || k >= word.first + word.count) continue;
          const int ngroup = word.group ? word.count / word.group : 1;
          for (int n = 0; n < ngroup; n++)
            all.emplace_back(one.name + (n ? std::to_string(n + 1) : std::string()),
                             k + n * word.group);
        }
      }
    });
    return all;
  }

  // Return the keywords of unlike types with their places in TypePair::unlike
  inline std::vector<std::pair<std::string, int>> unlike_keywords(bool spins)
  {
    std::vector<std::pair<std::string, int>> all;
    Channels::visit(spins, [&](auto channel) {
      int k = Channels::first_of_unlike<decltype(channel)>();
      for (const char *name : channel.UNLIKE_KEYWORDS) all.emplace_back(name, k++);
    });
    return all;
  }

  // Return the name of an optional channel with a coefficient that is not 0, or nullptr
  inline const char *optional_channel(const PairCoeff &coeff)
  {
    const char *name = nullptr;
    Channels::visit(true, [&](auto channel) {
      const double *const own = coeff.of<decltype(channel)>();
      for (int k = 0; channel.OPTIONAL && k < channel.NPAIR; k++)
        if (own[k] != 0.0) name = channel.NAME;
    });
    return name;
  }

  inline PairCoeff pair_coefficients(const TypePair &pair)
  {
    PairCoeff coeff = {};
    Channels::visit(has_spins(pair.shear), [&](auto channel) {
      using One = decltype(channel);
      channel.set_coefficients(pair, pair.words<One>(), coeff.of<One>());
    });
    return coeff;
  }
  // Return a of the energy of a pair, the sum over the channels
  inline double pair_energy(const TypePair &pair)
  {
    double sum = 0.0;
    Channels::visit(has_spins(pair.shear), [&](auto channel) {
      sum += channel.pair_energy(pair, pair.words<decltype(channel)>());
    });
    return sum;
  }

  // Return A of the energy of cohesion of a pair, the sum over the channels
  inline double cohesion(const TypePair &pair)
  {
    double sum = 0.0;
    Channels::visit(has_spins(pair.shear), [&](auto channel) {
      sum += channel.cohesion(pair, pair.words<decltype(channel)>());
    });
    return sum;
  }

  // Return the prefactor of (u.e)^2 in the dissipation of a pair at distance r, in units of F V_i V_j
  SPH_FUNCTION double central_weight(Shear shear, const PairCoeff &coeff, double r)
  {
    const PairFriction friction = Channels::friction(has_spins(shear), coeff.a);
    const double along = (shear == Shear::MG_FR) ? friction.along * r : friction.along;
    return along + friction.along_by_square * r * r;
  }

  // Return the bulk viscosity of the pair terms; P1 (66)
  inline double intrinsic_kappa(const PairFluid &fluid)
  {
    double kappa = 0.0;
    Channels::visit(has_spins(fluid.shear), [&](auto channel) {
      kappa += channel.intrinsic_kappa(fluid);
    });
    return kappa;
  }

  // Return the inequality that coefficients by keyword violate in a box of dimension dim, or nullptr
  inline const char *inadmissible(const TypeCoeffs &type, int dim)
  {
    const char *violated = nullptr;
    Channels::visit(true, [&](auto channel) {
      if (!violated) violated = channel.inadmissible_type(type.of<decltype(channel)>(), dim);
    });
    return violated;
  }

  // Call report(what) for each ignored coefficient of a type
  template <class Report> void report_ignored(const TypeCoeffs &type, Report &&report)
  {
    Channels::visit(true, [&](auto channel) {
      if (const char *what = channel.ignored(type.of<decltype(channel)>())) report(what);
    });
  }

  // Return the inequality that a pair of types violates, or nullptr if the fluid dissipates
  inline const char *inadmissible(const TypePair &pair)
  {
    const char *violated = nullptr;
    Channels::visit(has_spins(pair.shear), [&](auto channel) {
      if (!violated) violated = channel.inadmissible(pair, pair.words<decltype(channel)>());
    });
    return violated;
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
#endif
