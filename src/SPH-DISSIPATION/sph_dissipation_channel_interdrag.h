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

// Drag between two unlike fluids that flow through each other, per volume of the mixture b phi_I phi_J (u_J - u_I) with the
// volume fractions phi (Maxwell-Stefan).  The force is along the line of centers, so that angular momentum is conserved.
// The dissipation function is 1/2 sum over pairs b F V_i V_j (u.r)^2.  The continuum limit needs no factor, since the
// integral of F r r is the unit tensor.
// Included by sph_dissipation_channel_list.h; sph_dissipation_channels.h has the notation.

#ifdef CHANNEL_CLASS
// clang-format off
ChannelClass(InterdragChannel)
// clang-format on
#elif defined(OPTIONAL_TERMS)
// clang-format off
OptionalTerm(RelativeDrag)
// clang-format on
#elif defined(CHANNEL_TERMS)

// -b F V_i V_j (u.r) r
typedef AlongBySquare<InterdragChannel, InterdragChannel::DRAG> RelativeDrag;

#else

#ifndef LMP_SPH_DISSIPATION_CHANNEL_INTERDRAG_H
#define LMP_SPH_DISSIPATION_CHANNEL_INTERDRAG_H

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Largest eigenvalue of the friction matrix, in units of b/rho of the lighter fluid, found as those of shear_rate(),
  // with types in layers, in turn, and at random
  constexpr double INTERDRAG_RATE = 2.1;

  struct InterdragChannel : BaseChannel {
    static constexpr const char *NAME = "interdrag";

    static constexpr bool OPTIONAL = true;
    enum { B };    // coefficient of two unlike types
    static constexpr std::array<const char *, 1> UNLIKE_KEYWORDS = {"interdrag"};
    enum { DRAG, NPAIR };

    static void set_coefficients(const PairFluid &, const OwnWords &words, double *own)
    {
      own[DRAG] = words.unlike[B];
    }
    SPH_FUNCTION static void add_friction(const double *own, PairFriction &friction)
    {
      friction.along_by_square += own[DRAG];
    }
    template <class Add>
    static void add_columns(const PairFluid &, const OwnWords &words, const double *, Add &&add)
    {
      add("interdrag", words.unlike[B]);
    }
    static const char *inadmissible(const PairFluid &, const OwnWords &words)
    {
      return (words.unlike[B] >= 0.0) ? nullptr : "interdrag must be >= 0";
    }
    static double rate(const PairFluid &, const OwnWords &words, const double *,
                       const PairInertia &inertia)
    {
      return INTERDRAG_RATE * words.unlike[B] / inertia.rho;
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
#endif
