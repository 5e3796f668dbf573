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

#ifndef LMP_SPH_DISSIPATION_SUFFIX_H
#define LMP_SPH_DISSIPATION_SUFFIX_H

#include <string>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // the style of which another one, with the suffix of an accelerator package of LAMMPS, is a variant

  inline std::string without_suffix(const std::string &style)
  {
    return style.substr(0, style.find("/kk"));
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
