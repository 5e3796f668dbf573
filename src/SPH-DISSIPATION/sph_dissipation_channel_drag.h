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
// layer (Rayleigh, Hele-Shaw) or in a porous medium (Darcy, Brinkman).  Half its heat is the dissipation
// function, 1/2 sum_i b V_i |u_i - U|^2; H. C. Brinkman, Appl. Sci. Res. A 1, 27 (1949).
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

    static bool in_use(const TypeCoeffs &type) { return type.a[DRAG_B] > 0.0; }
    SPH_FUNCTION static Drag drag(const TypeCoeffs &type)
    {
      return {type.a[DRAG_B], {type.a[DRAG_UX], type.a[DRAG_UY], type.a[DRAG_UZ]}};
    }
    template <class Add> static void add_columns(const PairFluid &fluid, const double *, Add &&add)
    {
      add("drag", fluid.type.a[DRAG_B]);
    }
    static const char *inadmissible_type(const TypeCoeffs &type, int dim)
    {
      if (!(type.a[DRAG_B] >= 0.0)) return "drag must be >= 0";
      if (dim == 2 && type.a[DRAG_UZ] != 0.0) return "drag must have a stream of Uz = 0 in 2d";
      return nullptr;
    }
    static double rate(const PairFluid &fluid, const double *, const PairInertia &inertia)
    {
      return fluid.type.a[DRAG_B] / inertia.rho;
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
#endif
