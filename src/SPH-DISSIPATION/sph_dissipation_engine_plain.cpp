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

#include <cmath>
#include <cstdint>
#include <cstring>

// The pair loops without vectors, for every processor and compiler

#define LOOPS loops_of_plain
#define LOOPS_SET loops_plain
#define LOOPS_NAME "plain"
#include "sph_dissipation_loops.h"
