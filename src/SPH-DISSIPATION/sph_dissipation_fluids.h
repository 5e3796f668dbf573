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

#ifndef LMP_SPH_DISSIPATION_FLUIDS_H
#define LMP_SPH_DISSIPATION_FLUIDS_H

#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;

namespace SPHDissipation {

  // One line of a file of fluids, in the units that the file declares

  struct FluidLine {
    double rho;                   // density
    double c;                     // sound speed, of frequency 0
    double mu;                    // shear viscosity
    double kappa;                 // bulk viscosity, without relaxing processes
    std::vector<double> relax;    // kappa_r and tau of each relaxing process
  };

  // Return the fluid called name from a file of fluids, which names its columns, see potentials/fluids.sph and gases.sph; a
  // gas has the density and the sound speed of an ideal gas.  All ranks call, rank 0 reads.  Errors name the file and the
  // line: a word that is not a number, an inadmissible value, a missing column, a name that occurs twice or never, other
  // units.

  FluidLine read_fluid(LAMMPS *, const std::string &file, const std::string &name);

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
