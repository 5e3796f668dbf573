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

#ifndef LMP_SPH_DISSIPATION_VALUE_H
#define LMP_SPH_DISSIPATION_VALUE_H

#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;

namespace SPHDissipation {

  // A value in the arguments of a command: a number, or v_name, a variable of equal or of atom style.
  // Variables are evaluated between Modify::clearstep_compute() and Modify::addstep_compute().

  class Value {
   public:
    // Read a word of the input; stop if the word is neither.
    void set(LAMMPS *, const std::string &word);

    // Find the variable, at the start of a run; stop, with a message in the name of the owner, if there is none.
    // Return false if it is neither of equal style nor, if may_be_by_atom, of atom style.
    [[nodiscard]] bool init(LAMMPS *, const std::string &owner, bool may_be_by_atom);

    // Evaluate the variable at this step; if it is of atom style, for owned particles of the group.
    void evaluate(LAMMPS *, int igroup);
    // Stop, on all ranks, if the variable is not finite, for any particle of a group
    void demand_finite(LAMMPS *, int groupbit, const std::string &owner) const;

    const std::string &name() const { return variable_name; }    // name of the variable
    bool varies() const { return is_variable; }
    bool is_by_atom() const { return by_atom; }
    bool is_zero() const { return !varies() && number == 0.0; }    // at all times
    double now() const { return number; }                          // unless it is of atom style
    double operator()(int i) const { return column.empty() ? number : column[i]; }
    double memory_usage() const    // bytes
    {
      return static_cast<double>(column.capacity() * sizeof(double));
    }

   private:
    bool is_variable = false;
    std::string variable_name;
    int variable = -1;    // index of the variable
    bool by_atom = false;
    double number = 0.0;
    std::vector<double> column;    // by owned particle
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
