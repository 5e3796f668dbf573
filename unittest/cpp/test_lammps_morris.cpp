/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// Kernel lucy, eos tait, shear morris, bulk none against LAMMPS's own pair style
// sph/taitwater/morris, which is given the density that pair style sph/bulk computed.

#include "configuration.h"
#include "dense_reference.h"
#include "expected.h"
#include "lammps_driver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

using DenseReference::Model;
using DenseReference::Vector;

static std::string number(double value)
{
  char text[32];
  snprintf(text, sizeof(text), " %.17g", value);
  return text;
}

static void check(Configuration config, int ntypes, Record &record)
{
  // LAMMPS's pressure force has m_i m_j p_i/rho_i^2 where ours has p_i V_i^2: equal if masses are
  for (int i = 0; i < config.size(); i++) {
    config.type[i] = std::min(config.type[i], ntypes);
    config.mass[i] = config.mass[0];
  }

  Model model;
  model.kernel = "lucy";
  model.n = config.dim;
  model.support = config.support;
  model.fluids = test_fluids();
  model.fluids.resize(ntypes);
  for (auto &fluid : model.fluids) {    // what LAMMPS's style has built in
    fluid.pb = 0.0;
    fluid.gamma = 0.0;
  }

  lammps().create(config, Layout());
  lammps().pair_style(model, "tait", "morris", "none");
  const Computed ours = lammps().run0();

  // LAMMPS's style has no summed density: all ranks need ours
  std::vector<double> density = ours.density;
  LammpsDriver::broadcast(density);
  lammps().create_lammps_sph(config, density);
  lammps().command("pair_style sph/taitwater/morris");
  // a line for unlike types sets the type properties of the first one: like types come last
  for (int apart = ntypes - 1; apart >= 0; apart--) {
    for (int i = 1; i + apart <= ntypes; i++) {
      const int j = i + apart;
      const auto &a = model.fluids[i - 1], &b = model.fluids[j - 1];
      const double mu = i == j ? a.mu : 2.0 * a.mu * b.mu / (a.mu + b.mu);
      lammps().command("pair_coeff " + std::to_string(i) + " " + std::to_string(j) +
                       number(a.rho0) + number(a.c0) + number(mu) + number(model.support));
    }
  }
  const Computed theirs = lammps().run0();
  if (LammpsDriver::rank() != 0) return;

  const std::string where = "dim " + std::to_string(config.dim);
  const Vector force = Eigen::Map<const Eigen::VectorXd>(theirs.force.data(), theirs.force.size())
                           .cast<DenseReference::Real>();
  record.check("f", deviation(ours.force, force), 1.0e-12, where);

  // each style splits the pressure work of a pair in its own way, the sum is the same
  double heat[2] = {0.0, 0.0}, size = 0.0;
  for (int i = 0; i < config.size(); i++) {
    heat[0] += ours.desph[i];
    heat[1] += theirs.desph[i];
    size += std::fabs(ours.desph[i]);
  }
  record.check("sum of desph", std::fabs(heat[0] - heat[1]) / size, 1.0e-12, where);
}

/* ---------------------------------------------------------------------- */

TEST(LammpsMorris, forces_of_one_fluid)
{
  Record record;
  for (int dim = 2; dim <= 3; dim++) check(periodic_fluid(dim, false, 400 + dim), 1, record);
  if (LammpsDriver::rank() == 0) record.print();
}

TEST(LammpsMorris, forces_of_three_fluids)
{
  Record record;
  for (int dim = 2; dim <= 3; dim++) check(periodic_fluid(dim, false, 410 + dim), 3, record);
  if (LammpsDriver::rank() == 0) record.print();
}

TEST(LammpsMorris, free_drops)
{
  Record record;
  for (int dim = 2; dim <= 3; dim++) check(free_drop(dim, 420 + dim), 3, record);
  if (LammpsDriver::rank() == 0) record.print();
}
