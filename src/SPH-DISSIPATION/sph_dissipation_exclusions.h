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

#ifndef LMP_SPH_DISSIPATION_EXCLUSIONS_H
#define LMP_SPH_DISSIPATION_EXCLUSIONS_H

#include "pointers.h"

#include <utility>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Pairs of groups without pairs in the neighbor lists, like those of neigh_modify exclude group,
  // but taken back when their owner asks for others or is deleted.  Those of the input stay.

  class Exclusions : protected Pointers {
   public:
    using Groups = std::pair<int, int>;    // indices of groups

    Exclusions(class LAMMPS *);
    ~Exclusions() override;

    void set(const std::vector<Groups> &);    // before Neighbor::init()

   private:
    std::vector<Groups> own;

    int find(const Groups &) const;
    void take_back();
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
