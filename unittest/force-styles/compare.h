/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// What CMake includes in front of LAMMPS's testers, so that their single numbers are in the margin
// that a test prints. Vectors: compare.cpp.

#ifndef SPHD_COMPARE_H
#define SPHD_COMPARE_H

#include "error_stats.h"
#include "margin.h"
#include "test_main.h"

#include <algorithm>

#undef EXPECT_FP_LE_WITH_EPS
#define EXPECT_FP_LE_WITH_EPS(val1, val2, eps)                        \
  do {                                                                \
    const double one = val1, other = val2;                            \
    const double size = std::min(std::fabs(one), std::fabs(other));   \
    const double difference = std::fabs(one - other);                 \
    const double error = size > 0.0 ? difference / size : difference; \
    stats.add(error);                                                 \
    EXPECT_LE(error, eps) << #val1;                                   \
  } while (0)

#endif
