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

// Thixotropy: a structure of the fluid that shear breaks down and that builds up again, the state lambda of each particle, from
// 0 to 1, with the rate of shear gamma:
//   d lambda/dt = a (1 - lambda) - b gamma lambda,   mu + mu1 lambda in the place of mu
// F. Moore, Trans. Br. Ceram. Soc. 58, 470 (1959).  The step is exact for a constant rate of shear.
// Included by sph_dissipation_channel_list.h; sph_dissipation_channels.h has the notation.

#ifdef CHANNEL_CLASS
// clang-format off
ChannelClass(ThixotropyChannel)
// clang-format on
#elif !defined(CHANNEL_TERMS)

#ifndef LMP_SPH_DISSIPATION_CHANNEL_THIXOTROPY_H
#define LMP_SPH_DISSIPATION_CHANNEL_THIXOTROPY_H

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Numbers of a type for a time step
  struct Thixotropy {
    double viscosity;    // mu1
    double build_up;     // a dt
    double breakdown;    // b dt
  };

  struct ThixotropyChannel : BaseChannel, BaseState {
    static constexpr const char *NAME = "thixotropy";
    static constexpr bool OF_MOTION = false, OPTIONAL = true, ELASTIC = true;    // no rate
    enum { MU1, A, B };
    static constexpr int NTYPE = 3;
    static constexpr std::array<TypeKeyword, 1> TYPE_KEYWORDS = {
        {{"thixotropy", "mu1 a b", NTYPE, 0, RHEOLOGY | NO_RERUN}}};
    static constexpr std::array<TypeVariable, 1> TYPE_VARIABLES = {{{"thixotropy", MU1}}};
    static constexpr const char *FIELD = "structure", *KEYWORD = "thixotropy";
    static constexpr double LARGEST = 1.0;
    typedef Thixotropy Numbers;

    static int count(const double *type) { return (type[MU1] > 0.0) ? 1 : 0; }
    static Thixotropy process(const double *type, int, double, double, double dt)
    {
      return {type[MU1], type[A] * dt, type[B] * dt};
    }
    static double largest_viscosity(const double *type) { return type[MU1]; }
    template <class Site> SPH_FUNCTION static double viscosity(const Site &site)
    {
      return site.own.viscosity * site.state();
    }
    template <class Site> SPH_FUNCTION static void advance(const Site &site, double, double)
    {
      const double up = site.own.build_up, down = site.own.breakdown * site.shear_rate();
      const double x = up + down;
      if (x > 0.0) site.state() -= std::expm1(-x) * (up / x - site.state());
    }

    template <class Add>
    static void add_columns(const PairFluid &, const OwnWords &words, const double *, Add &&add)
    {
      add("mu1", words.type[MU1]);
    }
    static const char *inadmissible_type(const double *type, int)
    {
      const double mu1 = type[MU1], a = type[A], b = type[B];
      const bool none = (mu1 == 0.0 && a == 0.0 && b == 0.0);
      const bool finite = std::isfinite(mu1) && std::isfinite(a) && std::isfinite(b);
      if (none || (mu1 > 0.0 && a >= 0.0 && b >= 0.0 && a + b > 0.0 && finite)) return nullptr;
      return "thixotropy must have mu1 > 0, a >= 0, b >= 0, and one of a and b > 0";
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
#endif
