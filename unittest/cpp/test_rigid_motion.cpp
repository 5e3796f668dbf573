/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// Translation and rotation of a free drop, and the balance of forces and torques: what conserves
// angular momentum and by how much the Laplacian form of the shear term does not.

#include "configuration.h"
#include "dense_reference.h"
#include "expected.h"
#include "lammps_driver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

using DenseReference::Model;
using DenseReference::Real;
using DenseReference::Vector;

static bool conserves_angular_momentum(const std::string &shear)
{
  return shear != "morris" && shear != "espanol";
}

static const std::array<double, 3> DRIFT = {0.6, -0.9, 0.4};

static std::array<double, 3> spin(int dim)
{
  if (dim == 3) return {0.7, -0.5, 1.2};
  return {0.0, 0.0, dim == 2 ? 1.2 : 0.0};
}

// The pressure force is removed by a linear equation of state of a fluid so soft, c0 = 1e-20, that
// it is below the round-off of any viscous force.

static Model viscous_model(const Configuration &config, const std::string &kernel)
{
  Model model = test_model(config, kernel);
  for (auto &fluid : model.fluids) {
    fluid.c0 = 1e-20;
    fluid.pb = 0.0;
  }
  return model;
}

static double largest(const std::vector<double> &values)
{
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::fabs(value));
  return result;
}

// sum of r x f over particles and the scale of its terms, the sum of |r| |f|

template <class Force>
static std::array<Real, 4> torque(const Configuration &config, const Force &f)
{
  std::array<Real, 4> sum = {0.0L, 0.0L, 0.0L, 0.0L};
  for (int i = 0; i < config.size(); i++) {
    const double *x = &config.x[3 * i];
    Real rr = 0.0L, ff = 0.0L;
    for (int k = 0; k < 3; k++) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      sum[k] += static_cast<Real>(x[l]) * f[3 * i + m] - static_cast<Real>(x[m]) * f[3 * i + l];
      rr += x[k] * x[k];
      ff += f[3 * i + k] * f[3 * i + k];
    }
    sum[3] += std::sqrt(rr * ff);
  }
  return sum;
}

/* ---------------------------------------------------------------------- */

TEST(RigidMotion, no_viscous_force)
{
  Record record;
  for (int dim = 1; dim <= 3; dim++) {
    const Configuration random = free_drop(dim, 300 + dim);
    Configuration drift = random, rotation = random;
    set_rigid_motion(drift, DRIFT, {0.0, 0.0, 0.0});
    set_rigid_motion(rotation, DRIFT, spin(dim));
    for (const auto &kernel : DenseReference::kernel_names()) {
      const Model model = viscous_model(random, kernel);
      for (const auto &shear : ALL_SHEAR) {
        for (const auto &bulk : ALL_BULK) {
          if (shear == "none" && bulk == "none") continue;
          std::vector<double> force[3], heat[3];
          const Configuration *const motions[3] = {&random, &drift, &rotation};
          for (int k = 0; k < 3; k++) {
            lammps().create(*motions[k], Layout());
            lammps().pair_style(model, "linear", shear, bulk);
            const Computed computed = lammps().run0();
            force[k] = computed.force;
            heat[k] = computed.desph;
          }
          if (LammpsDriver::rank() != 0) continue;
          const std::string where =
              "dim " + std::to_string(dim) + " " + kernel + " shear " + shear + " bulk " + bulk;
          const double typical = largest(force[0]);
          EXPECT_GT(typical, 1e-3) << where;
          record.check("translation", largest(force[1]) / typical, 1.0e-13, where);
          if (conserves_angular_momentum(shear)) {
            record.check("rotation", largest(force[2]) / typical, 1.0e-13, where);
            record.check("heat of rotation", largest(heat[2]) / largest(heat[0]), 1.0e-13, where);
          } else if (dim > 1) {
            EXPECT_GT(largest(force[2]) / typical, 1.0e-2) << where;
          }
        }
      }
    }
  }
  if (LammpsDriver::rank() == 0) record.print();
}

TEST(RigidMotion, forces_and_torques_balance)
{
  Record record;
  for (int dim = 1; dim <= 3; dim++) {
    const Configuration config = free_drop(dim, 310 + dim);
    lammps().create(config, Layout());
    for (const std::string kernel : {"wendland/c2", "quintic"}) {
      const Model model = test_model(config, kernel);
      for (const auto &shear : ALL_SHEAR) {
        for (const auto &bulk : ALL_BULK) {
          lammps().pair_style(model, "tait", shear, bulk);
          const Computed computed = lammps().run0();
          if (LammpsDriver::rank() != 0) continue;

          const std::string where =
              "dim " + std::to_string(dim) + " " + kernel + " shear " + shear + " bulk " + bulk;
          Real sum[3] = {0.0L, 0.0L, 0.0L}, size = 0.0L;
          for (std::size_t i = 0; i < computed.force.size(); i++) {
            sum[i % 3] += computed.force[i];
            size += std::fabs(computed.force[i]);
          }
          for (const Real component : sum)
            record.check("momentum", static_cast<double>(std::fabs(component) / size), 1.0e-14,
                         where);
          if (!conserves_angular_momentum(shear)) continue;
          const auto moment = torque(config, computed.force);
          for (int k = 0; k < 3; k++)
            record.check("angular momentum", static_cast<double>(std::fabs(moment[k]) / moment[3]),
                         1.0e-14, where);
        }
      }
    }
  }
  if (LammpsDriver::rank() == 0) record.print();
}

// the others lose angular momentum, at the rate that the dense reference gives

TEST(RigidMotion, angular_momentum_lost_by_laplacian_forms)
{
  Record record;
  for (int dim = 2; dim <= 3; dim++) {
    Configuration rotation = free_drop(dim, 320 + dim);
    set_rigid_motion(rotation, DRIFT, spin(dim));
    for (const Configuration &config : {free_drop(dim, 320 + dim), rotation}) {
      const Model model = viscous_model(config, "wendland/c2");
      lammps().create(config, Layout());
      for (const auto &shear : ALL_SHEAR) {
        if (conserves_angular_momentum(shear)) continue;
        lammps().pair_style(model, "linear", shear, "density");
        const Computed computed = lammps().run0();
        if (LammpsDriver::rank() != 0) continue;

        const std::string where = "dim " + std::to_string(dim) + " shear " + shear;
        Expected expected(config, model);
        const auto lost = torque(config, expected.force("linear", shear, "density"));
        const auto moment = torque(config, computed.force);
        Real difference = 0.0L, size = 0.0L;
        for (int k = 0; k < 3; k++) {
          difference = std::max(difference, std::fabs(moment[k] - lost[k]));
          size = std::max(size, std::fabs(lost[k]));
        }
        EXPECT_GT(size, 1.0e-3L * lost[3]) << where;
        record.check("torque", static_cast<double>(difference / size), 1.0e-12, where);
      }
    }
  }
  if (LammpsDriver::rank() == 0) record.print();
}
