/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#include "sph_dissipation_boundary_pairs.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_noise_data.h"
#include "sph_dissipation_parameters.h"

// The pair loops for processors with AVX-512, chosen at run time

#ifdef SPH_DISSIPATION_DISPATCH

#include <cmath>
#include <cstdint>
#include <immintrin.h>

#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2,fma,avx512f,avx512dq,avx512vl"))), \
                             apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,fma,avx512f,avx512dq,avx512vl,prefer-vector-width=512")
#endif
#define LOOPS loops_of_avx512
#define LOOPS_SET loops_avx512
#define LOOPS_NAME "avx512"
#define LOOPS_AVX512
#include "sph_dissipation_loops.h"
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

#endif
