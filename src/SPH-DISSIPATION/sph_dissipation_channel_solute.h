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

// Diffusion of a solute: the flow of sph_dissipation_flows.h with the amount Q of a particle over its mass and, for the
// diffusivity D, k = rho0 D.  Each pair lowers the sum of Q^2/m, by 4 k_ij F V_i V_j (q_i - q_j)^2 per time.
// Included by sph_dissipation_channel_list.h; sph_dissipation_channels.h has the notation.

#ifdef CHANNEL_CLASS
// clang-format off
ChannelClass(SoluteChannel)
// clang-format on
#elif !defined(CHANNEL_TERMS)

#ifndef LMP_SPH_DISSIPATION_CHANNEL_SOLUTE_H
#define LMP_SPH_DISSIPATION_CHANNEL_SOLUTE_H

namespace LAMMPS_NS {
namespace SPHDissipation {

  struct SoluteChannel : BaseChannel, FlowingState {
    static constexpr const char *NAME = "solute";
    static constexpr bool OF_MOTION = false, OPTIONAL = true;
    enum { GIVEN, D };    // with D = 0, particles keep their amounts
    static constexpr int NTYPE = 2;
    static constexpr std::array<TypeKeyword, 1> TYPE_KEYWORDS = {
        {{"solute", "D", NTYPE, 0, NO_NOISE, true}}};
    static constexpr std::array<TypeVariable, 1> TYPE_VARIABLES = {{{"solute", D}}};
    static constexpr const char *FIELD = "solute", *KEYWORD = "solute";

    static int count(const double *type) { return (type[GIVEN] != 0.0) ? 1 : 0; }
    static double coefficient(const double *type, double rho0) { return rho0 * type[D]; }

    template <class Add>
    static void add_columns(const PairFluid &, const OwnWords &words, const double *, Add &&add)
    {
      add("rho0*D", words.flow);
    }
    static const char *inadmissible_type(const double *type, int)
    {
      return (type[D] >= 0.0 && std::isfinite(type[D])) ? nullptr : "solute must be >= 0";
    }
    // Return the rate of the form morris, with rho0 D/rho instead of mu/rho
    static double rate(const PairFluid &, const OwnWords &words, const double *,
                       const PairInertia &inertia)
    {
      if (words.flow == 0.0) return 0.0;
      return shear_rate(Shear::MORRIS, false) * words.flow / (inertia.rho * inertia.hsq);
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
#endif
