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

// Linear drag of each particle against a uniform stream, per volume -b (u - U): friction on the bottom of a thin
// layer (Rayleigh, Hele-Shaw) or in a porous medium (Darcy, Brinkman).  The dissipation function is half of the heat,
// 1/2 sum_i b V_i |u_i - U|^2; H. C. Brinkman, Appl. Sci. Res. A 1, 27 (1949).
// Included by sph_dissipation_channel_list.h; sph_dissipation_channels.h has the notation.

#ifdef CHANNEL_CLASS
// clang-format off
ChannelClass(DragChannel)
// clang-format on
#elif !defined(CHANNEL_TERMS)

#ifndef LMP_SPH_DISSIPATION_CHANNEL_DRAG_H
#define LMP_SPH_DISSIPATION_CHANNEL_DRAG_H

namespace LAMMPS_NS {
namespace SPHDissipation {

  struct DragChannel : BaseChannel {
    static constexpr const char *NAME = "drag";

    static constexpr bool OPTIONAL = true;
    enum { B, UX, UY, UZ };
    static constexpr int NTYPE = 4;
    static constexpr std::array<TypeKeyword, 1> TYPE_KEYWORDS = {
        {{"drag", "b Ux Uy Uz", 4, 0, NOTHING}}};
    static constexpr std::array<TypeVariable, 1> TYPE_VARIABLES = {{{"drag", B}}};

    SPH_FUNCTION static Drag drag(const double *type)
    {
      return {type[B], {type[UX], type[UY], type[UZ]}};
    }
    template <class Add>
    static void add_columns(const PairFluid &, const OwnWords &words, const double *, Add &&add)
    {
      add("drag", words.type[B]);
    }
    static const char *inadmissible_type(const double *type, int dim)
    {
      if (!(type[B] >= 0.0)) return "drag must be >= 0";
      if (dim == 2 && type[UZ] != 0.0) return "drag must have a stream of Uz = 0 in 2d";
      return nullptr;
    }
    static const char *ignored(const double *type)
    {
      const bool moves = type[UX] != 0.0 || type[UY] != 0.0 || type[UZ] != 0.0;
      return (type[B] == 0.0 && moves) ? "the stream of drag 0" : nullptr;
    }
    static double rate(const PairFluid &, const OwnWords &words, const double *,
                       const PairInertia &inertia)
    {
      return words.type[B] / inertia.rho;
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
#endif
