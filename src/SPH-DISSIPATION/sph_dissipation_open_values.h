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

#ifndef LMP_SPH_DISSIPATION_OPEN_VALUES_H
#define LMP_SPH_DISSIPATION_OPEN_VALUES_H

#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // What an open zone prescribes: numbers, or variables of equal or atom style

  class OpenValues : protected Pointers {
   public:
    enum Quantity { VX, VY, VZ, RHO, P, ENERGY, WX, WY, WZ, NQUANTITY };

    OpenValues(class LAMMPS *, const std::string &owner);    // owner: for messages

    // # of words of the keyword at arg[iarg], with which it sets quantities; 0 if it is none of those
    int keyword_argument(int iarg, int narg, char **arg);
    void check() const;
    void init(bool needs_energy);    // finds the variables; the energies must then be > 0

    bool given(Quantity k) const { return value[k].given; }
    bool vary() const { return any_variable; }

    // values at the current time of the owned particles with a group bit; igroup: for messages only
    // particles that get no value of their own have 0
    void evaluate(int igroup);

    double memory_usage() const;    // bytes

    double operator()(Quantity k, int i) const
    {
      return column[k].empty() ? number[k] : column[k][i];
    }

   private:
    struct Value {
      bool given = false;
      std::string name;    // of a variable
      int variable = -1;
      bool by_atom = false;
    };

    const std::string owner;
    Value value[NQUANTITY];
    double number[NQUANTITY];                 // now, where it is the same for all particles
    std::vector<double> column[NQUANTITY];    // now, by owned particle, where it is not
    bool any_variable, needs_energy;

    const char *fault(Quantity, double) const;    // what a value must not be; nullptr: nothing
    void set(Quantity, const char *word);         // a number or v_name
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
