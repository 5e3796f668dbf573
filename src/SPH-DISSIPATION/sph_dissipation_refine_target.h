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

#ifndef LMP_SPH_DISSIPATION_REFINE_TARGET_H
#define LMP_SPH_DISSIPATION_REFINE_TARGET_H

#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // The volume that particles are to have: a number, or a variable of equal or atom style; of the
  // volume itself or of the spacing, its n-th root

  class RefineTarget : protected Pointers {
   public:
    RefineTarget(class LAMMPS *, const std::string &owner);    // owner: for messages

    void set(bool spacing, const char *word);    // a number or v_name
    void init(double support, int dim);

    // at the current time, for owned particles with a group bit
    void evaluate(int igroup);
    double volume(int i) const { return by_atom ? column[i] : number; }

   private:
    const std::string owner;
    bool spacing;
    std::string word, name;    // of a variable, empty: a number
    int variable;
    bool by_atom;
    double given, number;
    double largest;    // volume that leaves enough neighbors
    int dim;
    std::vector<double> column;

    double checked(double value, tagint tag) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
