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

// Formulas that run on a GPU, too, are SPH_FUNCTION: where the headers of Kokkos have been included
// before, the compiler makes them for both.

#ifdef KOKKOS_INLINE_FUNCTION
#define SPH_FUNCTION KOKKOS_INLINE_FUNCTION
#else
#define SPH_FUNCTION inline
#endif

// Functions that the pair loops call for every pair are SPH_INLINE: the loops are long, and one
// file has many of them, so that compilers would stop inlining.  Those that no GPU runs are SPH_HOST_INLINE.

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

#endif
