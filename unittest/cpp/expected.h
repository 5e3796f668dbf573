/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// What the dense reference says about a whole case, in the order of Computed, and the measure in
// which LAMMPS must agree with it.

#ifndef SPHD_EXPECTED_H
#define SPHD_EXPECTED_H

#include "configuration.h"
#include "dense_reference.h"
#include "lammps_driver.h"

#include <map>
#include <string>
#include <vector>

extern const std::vector<std::string> ALL_EOS, ALL_SHEAR, ALL_BULK;

// the three test fluids with an explicit viscosity for one pair of types

DenseReference::Model test_model(const Configuration &config, const std::string &kernel);

// largest difference, relative to the largest expected value; infinite if anything is not finite

double deviation(const std::vector<double> &computed, const DenseReference::Vector &expected);

// One configuration and model. Terms are computed once and shared by all cases that contain them.

class Expected {
 public:
  Expected(const Configuration &config, const DenseReference::Model &model);

  DenseReference::Vector force(const std::string &eos, const std::string &shear,
                               const std::string &bulk);    // 3 per particle
  DenseReference::Vector viscous_force(const std::string &shear, const std::string &bulk);
  DenseReference::Vector desph(const std::string &eos, const std::string &shear,
                               const std::string &bulk);
  const DenseReference::System &system() const { return dense; }

  // for all further calls: the bulk coefficients are limited to what is surely dissipative
  void set_limited(bool on);

 private:
  struct Term {
    DenseReference::Vector force, heating;
  };
  const Term &conservative(const std::string &eos);
  const Term &shear(const std::string &form);
  const Term &bulk(const std::string &form, const std::string &shear_form);
  DenseReference::Vector three_components(const DenseReference::Vector &v) const;

  DenseReference::System dense;
  int dim;
  bool limited;
  std::map<std::string, Term> terms;
};

// largest deviations seen, for the report at the end of a test

class Record {
 public:
  // fails the test if the deviation is above the tolerance
  void check(const std::string &field, double deviation, double tolerance,
             const std::string &where);
  void print() const;

 private:
  std::map<std::string, double> worst;
};

// all fields of a case but the virial

void compare(const Computed &computed, Expected &expected, const std::string &eos,
             const std::string &shear, const std::string &bulk, Record &record,
             const std::string &where);

#endif
