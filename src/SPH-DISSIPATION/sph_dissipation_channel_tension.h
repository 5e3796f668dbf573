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

// Tension between two unlike fluids, from the energy of a pair a w_i w_j W(r) with the reference volumes w = m/rho0: a
// central force, without curvature or normals.  A plane that divides two fluids has the tension a <|z|>/2, with <|z|> the
// integral of |z| W.  PairEnergyKernel has W, which is not the kernel of the densities.
// Included by sph_dissipation_channel_list.h; sph_dissipation_channels.h has the notation.

#ifdef CHANNEL_CLASS
// clang-format off
ChannelClass(TensionChannel)
// clang-format on
#elif !defined(CHANNEL_TERMS)

#ifndef LMP_SPH_DISSIPATION_CHANNEL_TENSION_H
#define LMP_SPH_DISSIPATION_CHANNEL_TENSION_H

namespace LAMMPS_NS {
namespace SPHDissipation {

  struct TensionChannel : BaseChannel {
    static constexpr const char *NAME = "tension";
    static constexpr bool OF_MOTION = false, OPTIONAL = true, PAIR_ENERGY = true;
    enum { SIGMA };    // of two unlike types: energy/area, in two dimensions energy/length
    static constexpr std::array<const char *, 1> UNLIKE_KEYWORDS = {"tension"};

    static double pair_energy(const PairFluid &fluid, const OwnWords &words)
    {
      return 2.0 * words.unlike[SIGMA] / PairEnergyKernel::mean_distance(fluid.dim, fluid.support);
    }
    template <class Add>
    static void add_columns(const PairFluid &, const OwnWords &words, const double *, Add &&add)
    {
      add("tension", words.unlike[SIGMA]);
    }
    static const char *inadmissible(const PairFluid &, const OwnWords &words)
    {
      const double sigma = words.unlike[SIGMA];
      return (sigma >= 0.0 && std::isfinite(sigma)) ? nullptr : "tension must be >= 0";
    }
    // Return the step of capillary waves, J. P. Morris, Int. J. Numer. Methods Fluids 33, 333 (2000)
    static double wave_step(const OwnWords &words, const PairInertia &inertia)
    {
      return capillary_step(inertia.rho, inertia.hsq, words.unlike[SIGMA]);
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
#endif
