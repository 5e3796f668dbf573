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

#ifndef LMP_SPH_DISSIPATION_TABLE_H
#define LMP_SPH_DISSIPATION_TABLE_H

#include "sph_dissipation_coeffs.h"

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // heads and values of columns

  class Columns : public std::vector<std::pair<std::string, double>> {
   public:
    Columns(std::initializer_list<value_type> columns) : vector(columns) {}
  };

  // Table of the coefficients and the largest stable time steps of the pairs of types, as it goes to
  // the log: a row each, the same columns in all rows.

  class CoeffTable {
   public:
    CoeffTable() : smallest(UNLIMITED_STEP), acoustic(UNLIMITED_STEP), viscous(UNLIMITED_STEP) {}

    // values = viscosities and coefficients, viscous_steps = time steps of the viscous terms

    void add_row(int i, int j, const Columns &values, double acoustic_of_pair,
                 const Columns &viscous_steps);
    // with lines on the accuracy of these steps, and on what dt needs
    std::string text(double dt) const;
    double smallest_step() const { return smallest; }    // with all terms together, of all rows
    double acoustic_step() const { return acoustic; }    // without the viscous terms
    double viscous_step() const { return viscous; }      // with the viscous terms alone
    double fastest_rate() const { return (viscous < UNLIMITED_STEP) ? 1.0 / viscous : 0.0; }

   private:
    std::string lines;
    double smallest, acoustic, viscous;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
