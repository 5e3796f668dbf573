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

#ifndef LMP_SPH_DISSIPATION_FUNCTION_H
#define LMP_SPH_DISSIPATION_FUNCTION_H

// Formulas that also run on a GPU are SPH_FUNCTION: after the headers of Kokkos, the compiler makes them for both.

#ifdef KOKKOS_INLINE_FUNCTION
#define SPH_FUNCTION KOKKOS_INLINE_FUNCTION
#else
#define SPH_FUNCTION inline
#endif

// Functions that the pair loops call for every pair are SPH_INLINE, or SPH_HOST_INLINE if no GPU runs them: one file has
// many long loops, in which compilers would otherwise stop inlining.

#ifdef __GNUC__
#define SPH_HOST_INLINE inline __attribute__((always_inline))
#define SPH_NOINLINE __attribute__((noinline))
#else
#define SPH_HOST_INLINE inline
#define SPH_NOINLINE
#endif

#ifdef KOKKOS_FORCEINLINE_FUNCTION
#define SPH_INLINE KOKKOS_FORCEINLINE_FUNCTION
#else
#define SPH_INLINE SPH_HOST_INLINE
#endif

// Lambdas that a space runs for each particle: by value, since a device has its own memory

#ifdef KOKKOS_LAMBDA
#define SPH_LAMBDA KOKKOS_LAMBDA
#else
#define SPH_LAMBDA [=]
#endif

#include <cmath>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Powers and roots with the same digits in units that differ by powers of two; digits of pow() and cbrt() depend on units.

  SPH_FUNCTION double whole_power(double x, int n)
  {
    double power = 1.0;
    for (int k = 0; k < n; k++) power *= x;
    return power;
  }

  SPH_FUNCTION double cube_root(double x)
  {
    int exponent;
    const double part = frexp(x, &exponent);
    const int rest = (exponent % 3 + 3) % 3;
    return ldexp(cbrt(ldexp(part, rest)), (exponent - rest) / 3);
  }

  // Return the spacing of particles of this volume on a square or cubic lattice; return its square

  SPH_FUNCTION double spacing_of(int dim, double volume)
  {
    return (dim == 1) ? volume : (dim == 2) ? sqrt(volume) : cube_root(volume);
  }

  SPH_FUNCTION double spacing_squared(int dim, double volume)
  {
    return (dim == 2) ? volume : whole_power(spacing_of(dim, volume), 2);
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
