/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// Global and per-atom virial and potential energy of pair style sph/bulk against the sums of
// r_ij (x) f_ij and of the elastic energy of the dense reference.

#include "configuration.h"
#include "dense_reference.h"
#include "expected.h"
#include "lammps_driver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

using DenseReference::Matrix;
using DenseReference::Model;
using DenseReference::System;
using DenseReference::Vector;

static constexpr double TOLERANCE = 1.0e-12;

static void check_virial(const Configuration &config, const std::string &kernel,
                         const std::vector<std::string> &all_eos, bool newton, Record &record)
{
  const Model model = test_model(config, kernel);
  std::unique_ptr<System> system;
  if (LammpsDriver::rank() == 0)
    system = std::make_unique<System>(model, config.reference_box(), config.reference_particles());

  Layout layout;
  layout.newton = newton;
  lammps().create(config, layout);
  for (const auto &eos : all_eos) {
    for (const auto &shear : ALL_SHEAR) {
      for (const auto &bulk : ALL_BULK) {
        lammps().pair_style(model, eos, shear, bulk);
        const Computed computed = lammps().run0(true);
        if (!system) continue;

        const std::string where = "dim " + std::to_string(config.dim) + " " + eos + " shear " +
            shear + " bulk " + bulk + (newton ? " newton on" : " newton off");
        const Matrix virial = system->virial(eos, shear, bulk);
        const Vector total = virial.rowwise().sum();
        const Vector per_atom = Eigen::Map<const Vector>(virial.data(), virial.size());
        record.check("virial", deviation({computed.total_virial, computed.total_virial + 6}, total),
                     TOLERANCE, where);
        record.check("virial/atom", deviation(computed.atom_virial, per_atom), TOLERANCE, where);

        const Vector energy = system->elastic_energy(eos);
        record.check("energy/atom", deviation(computed.atom_energy, energy), TOLERANCE, where);
        const Vector sum = Vector::Constant(1, energy.sum());
        record.check("energy", deviation({computed.total_energy}, sum), TOLERANCE, where);
      }
    }
  }
}

/* ---------------------------------------------------------------------- */

TEST(Virial, periodic_fluids)
{
  Record record;
  for (int dim = 1; dim <= 3; dim++)
    for (const bool newton : {true, false})
      check_virial(periodic_fluid(dim, false, 200 + dim), "wendland/c2", ALL_EOS, newton, record);
  if (LammpsDriver::rank() == 0) record.print();
}

TEST(Virial, volume_by_mass)
{
  Record record;
  for (int dim = 1; dim <= 3; dim++)
    for (const bool newton : {true, false})
      check_virial(by_mass(periodic_fluid(dim, false, 205 + dim)), "wendland/c2", {"tait"}, newton,
                   record);
  if (LammpsDriver::rank() == 0) record.print();
}

TEST(Virial, triclinic_boxes)
{
  Record record;
  for (int dim = 2; dim <= 3; dim++)
    for (const bool newton : {true, false})
      check_virial(periodic_fluid(dim, true, 210 + dim), "cubic", {"linear"}, newton, record);
  if (LammpsDriver::rank() == 0) record.print();
}

TEST(Virial, free_drops)
{
  Record record;
  for (int dim = 1; dim <= 3; dim++)
    for (const bool newton : {true, false})
      check_virial(free_drop(dim, 220 + dim), "wendland/c6", {"tait"}, newton, record);
  if (LammpsDriver::rank() == 0) record.print();
}

// the dissipative part is in the virial: it changes when a velocity does

TEST(Virial, contains_the_viscous_forces)
{
  Configuration config = periodic_fluid(3, false, 230);
  const Model model = test_model(config, "wendland/c2");
  double virial[2] = {0.0, 0.0};
  for (int moving = 0; moving < 2; moving++) {
    config.v = periodic_fluid(3, false, 230).v;
    if (!moving) config.v.assign(config.v.size(), 0.0);
    lammps().create(config, Layout());
    lammps().pair_style(model, "linear", "mg", "density");
    virial[moving] = lammps().run0(true).total_virial[0];
  }
  EXPECT_GT(std::fabs(virial[1] - virial[0]), 1e-3 * std::fabs(virial[0]));
}
