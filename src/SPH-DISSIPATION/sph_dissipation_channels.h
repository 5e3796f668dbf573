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

// The dissipative channels of a fluid.  Its dissipation function is a sum of terms, and a term is a
// rate, a coefficient, and a weight.  Each channel has them in its own header; all other code goes
// through the lists of channels in this file.
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
// The headers of the channels have parts, as the headers of LAMMPS's styles.  With CHANNEL_CLASS: their place in the
// list.  With CHANNEL_TERMS: the terms of a pair, for the loops, which include them in more than one namespace.  Without:
// all else.  No LAMMPS include.

#ifdef CHANNEL_TERMS

#include "sph_dissipation_channel_list.h"

// the terms that the loops of each form of the shear force have
template <Shear SHEAR, class... Term> struct Form {
  static constexpr Shear shear = SHEAR;
  static constexpr bool CENTRAL = (Term::CENTRAL || ...);
  static constexpr bool VECTOR = (Term::VECTOR || ...);
  static constexpr bool BY_DISTANCE = (Term::BY_DISTANCE || ...);
  static constexpr bool SPINS = (Term::SPINS || ...);
  // has heat of this channel; the last one of terms with spins
  static constexpr bool heats(int channel) { return ((channel == Term::CHANNEL) || ...); }
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

// call function(Form()) of that form
template <class Function> void with_form(Shear shear, Function &&function)
{
  switch (shear) {
    case Shear::MG:
      return function(Form<Shear::MG, AlongR<false>>());
    case Shear::MG_FR:
      return function(Form<Shear::MG_FR, AlongR<true>>());
    case Shear::MORRIS:
      return function(Form<Shear::MORRIS, AlongU>());
    case Shear::ESPANOL:
      return function(Form<Shear::ESPANOL, AlongR<false>, AlongU>());
    case Shear::MICROPOLAR:
      return function(Form<Shear::MICROPOLAR, AlongR<false>, Slip, SpinDiffusion>());
    default:
      return function(Form<Shear::NONE>());
  }
}

#else

#ifndef LMP_SPH_DISSIPATION_CHANNELS_H
#define LMP_SPH_DISSIPATION_CHANNELS_H

#include "sph_dissipation_states.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // viscosities of the pairs of types, in the order of pair_coeff
  enum Viscosity { MU, MU_R, GAMMA1, GAMMA2, NVISCOSITY };
  constexpr const char *VISCOSITY_NAMES[] = {"mu", "mu_r", "gamma1", "gamma2"};
  inline int number_of_viscosities(bool spins)
  {
    return spins ? NVISCOSITY : MU_R;
  }

  // Coefficients of single types, by keyword of pair_coeff, each with its values one after another: once, or
  // in groups of which there may be fewer.  The keyword with no name ends the list, as in the one of the names by
  // which another command may vary a coefficient.
  constexpr int MOST_PROCESSES = 8;
  enum TypeCoefficient {
    DRAG_B,
    DRAG_UX,
    DRAG_UY,
    DRAG_UZ,
    CONDUCTIVITY,
    GRUNEISEN,    // of the equation of state: Gamma, and the temperature of c0 and pb
    GRUNEISEN_T0,
    VIBRATION,    // heat capacity cvib and time tau_v
    VIBRATION_TAU,
    RELAX,    // kappa_r and tau of each process
    NTYPECOEFF = RELAX + 2 * MOST_PROCESSES
  };
  struct TypeKeyword {
    const char *name;
    int first, count;    // of enum TypeCoefficient
    int group;           // as many values belong together; 0: all
  };
  constexpr TypeKeyword TYPE_KEYWORDS[] = {{"drag", DRAG_B, 4, 0},
                                           {"conductivity", CONDUCTIVITY, 1, 0},
                                           {"gruneisen", GRUNEISEN, 2, 0},
                                           {"vibration", VIBRATION, 2, 2},
                                           {"relax", RELAX, 2 * MOST_PROCESSES, 2},
                                           {nullptr, NTYPECOEFF, 0, 0}};
  struct TypeVariable {
    const char *name;
    int coefficient;
  };
  constexpr TypeVariable TYPE_VARIABLES[] = {
      {"drag", DRAG_B},         {"conductivity", CONDUCTIVITY},
      {"kappa_r", RELAX},       {"tau", RELAX + 1},
      {"kappa_r2", RELAX + 2},  {"tau2", RELAX + 3},
      {"kappa_r3", RELAX + 4},  {"tau3", RELAX + 5},
      {"kappa_r4", RELAX + 6},  {"tau4", RELAX + 7},
      {"kappa_r5", RELAX + 8},  {"tau5", RELAX + 9},
      {"kappa_r6", RELAX + 10}, {"tau6", RELAX + 11},
      {"kappa_r7", RELAX + 12}, {"tau7", RELAX + 13},
      {"kappa_r8", RELAX + 14}, {"tau8", RELAX + 15},
      {nullptr, NTYPECOEFF}};
  struct TypeCoeffs {
    double a[NTYPECOEFF + 1] = {};
  };

  // Friction of a pair as a tensor, in units of F V_i V_j (mg/fr: F r V_i V_j): on the velocity of slip and
  // on the difference of the spins, along e and across it.  The noise is its root.
  struct PairFriction {
    double along, across, spin_along, spin_across;
  };

  enum class Shear;

  // what the coefficients of a pair of types follow from
  struct PairFluid {
    Shear shear = Shear(0);
    int dim = 0;                 // of the kernel
    double mean_radius = 0.0;    // integral of r W
    double viscosity[NVISCOSITY] = {};
    double zeta = 0.0;             // coefficient of the bulk term, mean of the types
    TypeCoeffs type;               // the larger ones of both types
    double conductivity = 0.0;     // mean of the types
    double heat_capacity = 0.0;    // per mass, the smaller one of both types
  };

  // inertia of the motion that a channel damps, for its fastest rate
  struct PairInertia {
    double hsq = 0.0;    // of the smoothing length for stability, see stability_length_squared()
    double rho = 0.0;    // of velocities
    double rho_inertia = 0.0;    // of spins
  };

  // drag of a single particle against a stream, force -b V (u - stream)
  struct Drag {
    double b = 0.0;    // pressure * time / length^2
    double stream[3] = {0.0, 0.0, 0.0};
  };

  // Defaults for what a channel does not have
  struct BaseChannel {
    static constexpr bool SPINS = false;    // it needs particles that spin
    // it stores energy: it has no rate of its own, but belongs to the sound
    static constexpr bool ELASTIC = false;
    // it turns motion into heat, which compute sph/dissipation gives out
    static constexpr bool OF_MOTION = true;
    // the table leaves it out if no type, of these largest coefficients, has it
    static bool in_use(const TypeCoeffs &) { return true; }
    // Number of the coefficients of its terms for a pair of types; what they are, and the same as a tensor, for the
    // noise.  own = these coefficients, here and below
    enum { NPAIR };
    static void set_coefficients(const PairFluid &, double *) {}
    SPH_FUNCTION static void add_friction(const double *, PairFriction &) {}
    // call add(name, value) for each column of coefficients in the table of the log
    template <class Add> static void add_columns(const PairFluid &, const double *, Add &&) {}
    // bulk viscosity that it brings with it
    static double intrinsic_kappa(const PairFluid &) { return 0.0; }
    // the inequality that the viscosities of a pair, or the coefficients of a type in a box of this dimension,
    // violate, or nullptr
    static const char *inadmissible(const PairFluid &) { return nullptr; }
    static const char *inadmissible_type(const TypeCoeffs &, int) { return nullptr; }
    // rate of its fastest mode, 1/time
    static double rate(const PairFluid &, const double *, const PairInertia &) { return 0.0; }

    // of single particles: force, heat, and noise follow from it
    SPH_FUNCTION static Drag drag(const TypeCoeffs &) { return {}; }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#include "sph_dissipation_channel_list.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // The list of the channels.  Each of them has a NAME, of its time step in the table of the log, and the members of
  // BaseChannel; its terms, in the other part of its header, derive from PairTerm.
  template <class Base, class... One> struct ChannelList {
    // those that turn motion into heat: how many there are, and the place of a channel among them
    static constexpr int NUMBER = ((One::OF_MOTION ? 1 : 0) + ...);
    template <class Channel> static constexpr int place()
    {
      int before = 0;
      bool found = false;
      ((found = found || std::is_same<One, Channel>::value,
        before += (One::OF_MOTION && !found) ? 1 : 0),
       ...);
      return before;
    }
    template <class Function> static void visit(bool spins, Function &&function)
    {
      ((One::SPINS && !spins ? void() : function(One())), ...);
    }
    // coefficients of the terms of a pair of types: how many there are, and the first one of a channel
    static constexpr int NPAIR = (One::NPAIR + ...);
    template <class Channel> static constexpr int first()
    {
      int before = 0;
      bool found = false;
      ((found = found || std::is_same<One, Channel>::value, before += found ? 0 : One::NPAIR), ...);
      return before;
    }

    // friction of a pair of types with these coefficients as a tensor
    SPH_FUNCTION static PairFriction friction(bool spins, const double *coeff)
    {
      PairFriction sum = {};
      ((One::SPINS && !spins ? void() : One::add_friction(coeff + first<One>(), sum)), ...);
      return sum;
    }
    // sum of the coefficients of drag
    SPH_FUNCTION static double drag(const TypeCoeffs &type) { return (One::drag(type).b + ...); }

    // add the drag of a particle of volume vol and velocity u to its force and, by channel, to its heat, energy
    // per time; linear: relative to rest instead of the stream
    SPH_FUNCTION static void add_drag(const TypeCoeffs &type, double vol, const double *u,
                                      bool linear, double *force, double *heat)
    {
      int channel = 0;
      ((One::OF_MOTION ? add_drag(One::drag(type), vol, u, linear, force, heat[channel++])
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
  // those with a state
  using States = WithState<StateList<>
#include "sph_dissipation_channel_list.h"
                           >::type;
#undef ChannelClass
#undef CHANNEL_CLASS
  // clang-format on

  constexpr int NCHANNEL = Channels::NUMBER;    // of those that turn motion into heat

  // Coefficients of the terms of two types, one channel after the other:
  //   f_i = -sum_j F V_i V_j [along_r (e.u) e + along_u u + zeta2 u*]
  //   tau_i = 1/2 sum_j F V_i V_j zeta2 r x u* - sum_j F V_i V_j [xi1 (e.dOmega) e + xi2 dOmega]
  // with F r instead of F before along_r for mg/fr
  struct PairCoeff {
    double a[Channels::NPAIR];

    // those of a channel
    template <class Channel> const double *of() const { return a + Channels::first<Channel>(); }
    template <class Channel> double *of() { return a + Channels::first<Channel>(); }
  };

  // Columns of a row of sums over pairs: torque, if there are spins, then the heat of each of the channels with these bits
  // but the first
  struct ChannelColumns {
    bool spins;
    int bits;
    constexpr bool heats(int channel) const { return channel > 0 && (bits >> channel & 1); }
    constexpr int heat(int channel) const
    {
      int column = spins ? 3 : 0;
      for (int c = 1; c < channel; c++) column += heats(c) ? 1 : 0;
      return column;
    }
    constexpr int width() const { return heat(NCHANNEL); }
  };

  inline PairCoeff pair_coefficients(const PairFluid &fluid)
  {
    PairCoeff coeff = {};
    Channels::visit(fluid.shear == Shear::MICROPOLAR, [&](auto channel) {
      channel.set_coefficients(fluid, coeff.of<decltype(channel)>());
    });
    return coeff;
  }
  // prefactor of (u.e)^2 in the dissipation of a pair at distance r, in units of F V_i V_j
  SPH_FUNCTION double central_weight(Shear shear, const PairCoeff &coeff, double r)
  {
    const double along = Channels::friction(shear == Shear::MICROPOLAR, coeff.a).along;
    return (shear == Shear::MG_FR) ? along * r : along;
  }

  // bulk viscosity of the pair terms; P1 (66)
  inline double intrinsic_kappa(const PairFluid &fluid)
  {
    double kappa = 0.0;
    Channels::visit(fluid.shear == Shear::MICROPOLAR, [&](auto channel) {
      kappa += channel.intrinsic_kappa(fluid);
    });
    return kappa;
  }

  // the inequality that coefficients by keyword violate in a box of dimension dim, or nullptr
  inline const char *inadmissible(const TypeCoeffs &type, int dim)
  {
    const char *violated = nullptr;
    Channels::visit(true, [&](auto channel) {
      if (!violated) violated = channel.inadmissible_type(type, dim);
    });
    return violated;
  }

  // the inequality that the viscosities violate, or nullptr if the fluid dissipates: those of a type,
  // 2 mu |dev E|^2 + kappa (tr E)^2 >= 0, and all those of a pair of types
  inline const char *inadmissible(double mu, double kappa)
  {
    if (!(mu >= 0.0)) return "mu must be >= 0";
    if (!(kappa >= 0.0)) return "kappa must be >= 0";
    return nullptr;
  }
  inline const char *inadmissible(const PairFluid &fluid)
  {
    const char *violated = nullptr;
    Channels::visit(fluid.shear == Shear::MICROPOLAR, [&](auto channel) {
      if (!violated) violated = channel.inadmissible(fluid);
    });
    return violated;
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
#endif
