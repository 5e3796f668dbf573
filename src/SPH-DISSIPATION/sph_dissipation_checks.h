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

#ifndef LMP_SPH_DISSIPATION_CHECKS_H
#define LMP_SPH_DISSIPATION_CHECKS_H

#include <string>

namespace LAMMPS_NS {
class LAMMPS;

namespace SPHDissipation {

  // What a particle fluid needs from the rest of the simulation.  Called by all ranks; errors name the
  // pair style.

  // atom style, integrator, units; no other pair style that cannot be there

  void check_styles(LAMMPS *, const std::string &style);

  // the support radius fits into the ghost cutoff and, for dim = 1, into the box

  void check_support(LAMMPS *, const std::string &style, int dim, double support);

  // all masses are positive; also during a run, for fixes that insert particles, whose mass is zero at
  // first

  void check_masses(LAMMPS *, const std::string &style);

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
