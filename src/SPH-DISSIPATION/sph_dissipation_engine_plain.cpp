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

#include "sph_dissipation_engine.h"
#include "sph_dissipation_noise_data.h"

#include <cmath>
#include <cstdint>
#include <cstring>

// the pair loops without vectors, for every processor and compiler

#define LOOPS loops_of_plain
#include "sph_dissipation_loops.h"

namespace LAMMPS_NS {
namespace SPHDissipation {
  const LoopSet loops_plain = {"plain",
                               LOOPS::choose_density_loop,
                               LOOPS::choose_rate_loop,
                               LOOPS::choose_force_loop,
                               LOOPS::choose_noisy_force_loop,
                               LOOPS::choose_eta_loop,
                               LOOPS::particle_numbers};
}
}    // namespace LAMMPS_NS
