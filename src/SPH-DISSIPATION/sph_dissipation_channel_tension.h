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

// Tension, from energies of pairs with the reference volumes w = m/rho0: central forces, without curvature or normals.
// tension: of the interface of two unlike fluids, a w_i w_j W(r).  A plane that divides the fluids has the tension a <|z|>/2,
// with <|z|> the integral of |z| W.  PairEnergyKernel has W, which is not the kernel of the densities.
// cohesion: of the free surface of a type, between types the geometric mean; CohesionKernel has the energy.
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
    enum { SIGMA };       // of two unlike types: energy/area, in two dimensions energy/length
    enum { COHESION };    // of a type, in the same unit
    static constexpr int NTYPE = 1;
    static constexpr std::array<TypeKeyword, 1> TYPE_KEYWORDS = {
        {{"cohesion", "sigma", 1, 0, TENSION}}};
    static constexpr std::array<TypeVariable, 1> TYPE_VARIABLES = {{{"cohesion", COHESION}}};
    static constexpr std::array<const char *, 1> UNLIKE_KEYWORDS = {"tension"};

    static double pair_energy(const PairFluid &fluid, const OwnWords &words)
    {
      return 2.0 * words.unlike[SIGMA] / PairEnergyKernel::mean_distance(fluid.dim, fluid.support);
    }
    // Return the geometric mean of two types
    static double mean_cohesion(const OwnWords &words)
    {
      return sqrt(words.type[COHESION] * words.smaller[COHESION]);
    }
    static double cohesion(const PairFluid &fluid, const OwnWords &words)
    {
      return CohesionKernel::coefficient(fluid.dim, fluid.support, mean_cohesion(words));
    }
    template <class Add>
    static void add_columns(const PairFluid &, const OwnWords &words, const double *, Add &&add)
    {
      add("tension", words.unlike[SIGMA]);
      add("cohesion", mean_cohesion(words));
    }
    static const char *inadmissible_type(const double *type, int)
    {
      const double sigma = type[COHESION];
      return (sigma >= 0.0 && std::isfinite(sigma)) ? nullptr : "cohesion must be >= 0";
    }
    static const char *inadmissible(const PairFluid &, const OwnWords &words)
    {
      const double sigma = words.unlike[SIGMA];
      return (sigma >= 0.0 && std::isfinite(sigma)) ? nullptr : "tension must be >= 0";
    }
    // Return the step of capillary waves, J. P. Morris, Int. J. Numer. Methods Fluids 33, 333 (2000)
    static double wave_step(const OwnWords &words, const PairInertia &inertia)
    {
      return capillary_step(inertia.rho, inertia.hsq,
                            std::max(words.unlike[SIGMA], words.type[COHESION]));
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
#endif
