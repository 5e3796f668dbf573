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

#ifndef LMP_SPH_DISSIPATION_VISCOUS_KEYWORDS_H
#define LMP_SPH_DISSIPATION_VISCOUS_KEYWORDS_H

#include "pointers.h"
#include "sph_dissipation_viscous.h"

#include <string>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // The keywords of an integrator that say how it treats the viscous terms: viscous, scheme, stages,
  // tolerance, iterations

  class ViscousKeywords : protected Pointers {
   public:
    ViscousKeywords(class LAMMPS *lmp, const std::string &style) : Pointers(lmp), style(style) {}

    // # of words of the keyword at arg[iarg], 0 if it is none of these
    int argument(int iarg, int narg, char **arg);

    // after the last one; errors for what has no effect
    const ViscousSettings &settings() const;

   private:
    const std::string style;    // of the fix
    ViscousSettings chosen;
    std::string implicit_only, rkl2_only;    // a keyword that was given
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
