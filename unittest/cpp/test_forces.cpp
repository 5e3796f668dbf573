/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// Forces, heating, number density, its rate, volume and density of pair style sph/bulk against the
// dense reference.

#include "configuration.h"
#include "dense_reference.h"
#include "expected.h"
#include "lammps_driver.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

using DenseReference::Model;

static std::string label(const Configuration &config, const Model &model, const std::string &eos,
                         const std::string &shear, const std::string &bulk)
{
  return "dim " + std::to_string(config.dim) + " " + model.kernel + " " + eos + " shear " + shear +
      " bulk " + bulk;
}

// run the forms of a model on the particles that LAMMPS has now; the reference exists on rank 0

static void check_forms(const Configuration &config, const Model &model, Expected *expected,
                        const std::vector<std::string> &all_eos, Record &record)
{
  for (const auto &eos : all_eos) {
    for (const auto &shear : ALL_SHEAR) {
      for (const auto &bulk : ALL_BULK) {
        lammps().pair_style(model, eos, shear, bulk);
        const Computed computed = lammps().run0();
        if (expected)
          compare(computed, *expected, eos, shear, bulk, record,
                  label(config, model, eos, shear, bulk));
      }
    }
  }
}

static std::unique_ptr<Expected> reference(const Configuration &config, const Model &model)
{
  if (LammpsDriver::rank() != 0) return nullptr;
  return std::make_unique<Expected>(config, model);
}

// all layouts of the same particles, which share one reference

static void check_layouts(const Configuration &config, const std::vector<std::string> &kernels,
                          const std::vector<std::string> &all_eos,
                          const std::vector<Layout> &layouts)
{
  Record record;
  for (const auto &kernel : kernels) {
    const Model model = test_model(config, kernel);
    const auto expected = reference(config, model);
    for (const auto &layout : layouts) {
      SCOPED_TRACE((layout.newton ? "newton on, processors " : "newton off, processors ") +
                   layout.processors + (layout.tiled ? ", tiled " : " ") + layout.simd);
      lammps().create(config, layout);
      check_forms(config, model, expected.get(), all_eos, record);
    }
  }
  if (LammpsDriver::rank() == 0) record.print();
}

static Layout newton(bool on)
{
  Layout layout;
  layout.newton = on;
  return layout;
}

/* ---------------------------------------------------------------------- */

// every kernel, equation of state, shear and bulk form, newton on and off

TEST(Forces, all_forms_1d)
{
  check_layouts(periodic_fluid(1, false, 101), DenseReference::kernel_names(), ALL_EOS,
                {newton(true), newton(false)});
}

TEST(Forces, all_forms_2d)
{
  check_layouts(periodic_fluid(2, false, 102), DenseReference::kernel_names(), ALL_EOS,
                {newton(true), newton(false)});
}

TEST(Forces, all_forms_3d)
{
  check_layouts(periodic_fluid(3, false, 103), DenseReference::kernel_names(), ALL_EOS,
                {newton(true), newton(false)});
}

// masses of one type that differ by up to 2.3 times

TEST(Forces, volume_by_mass)
{
  Layout tiled;
  tiled.tiled = true;
  for (int dim = 1; dim <= 3; dim++) {
    check_layouts(by_mass(periodic_fluid(dim, false, 104 + dim)), {"wendland/c2", "quintic"},
                  ALL_EOS, {newton(true), newton(false), tiled});
    check_layouts(by_mass(free_drop(dim, 114 + dim)), {"wendland/c4"}, {"tait"},
                  {newton(true), newton(false)});
  }
}

TEST(Forces, free_drops)
{
  for (int dim = 1; dim <= 3; dim++)
    check_layouts(free_drop(dim, 110 + dim), {"wendland/c2", "quintic"}, {"tait"},
                  {newton(true), newton(false)});
}

TEST(Forces, triclinic_boxes)
{
  for (int dim = 2; dim <= 3; dim++)
    check_layouts(periodic_fluid(dim, true, 120 + dim), {"wendland/c4", "cubic"}, {"linear"},
                  {newton(true), newton(false)});
}

TEST(Forces, processor_grids_and_tiles)
{
  const std::string n = std::to_string(LammpsDriver::ranks());
  for (int dim = 1; dim <= 3; dim++) {
    std::vector<Layout> layouts;
    for (const bool on : {true, false}) {
      // with slabs along y some ranks have no particle of the line
      for (const auto &processors : {n + " 1 1", "1 " + n + " 1"}) {
        layouts.push_back(newton(on));
        layouts.back().processors = processors;
      }
      layouts.push_back(newton(on));
      layouts.back().tiled = true;
    }
    check_layouts(periodic_fluid(dim, false, 130 + dim), {"wendland/c2"}, {"ideal"}, layouts);
    if (dim > 1) check_layouts(periodic_fluid(dim, true, 140 + dim), {"lucy"}, {"tait"}, layouts);
  }
}

// the pair loops are compiled for several instruction sets, of which one is chosen at run time

TEST(Forces, instruction_sets)
{
  std::vector<Layout> layouts;
  for (const auto &simd : lammps().instruction_sets()) {
    layouts.emplace_back();
    layouts.back().simd = simd;
  }
  for (int dim = 1; dim <= 3; dim++)
    check_layouts(periodic_fluid(dim, false, 150 + dim), DenseReference::kernel_names(), {"tait"},
                  layouts);
}

TEST(Forces, intrinsic_bulk_viscosity_and_one_fluid)
{
  Record record;
  for (int dim = 1; dim <= 3; dim++) {
    Configuration config = periodic_fluid(dim, false, 160 + dim);
    Model model = test_model(config, "wendland/c2");
    model.fluids[1].intrinsic = true;
    lammps().create(config, Layout());
    check_forms(config, model, reference(config, model).get(), {"linear"}, record);

    config.type.assign(config.size(), 1);
    model.fluids.resize(1);
    model.mu_unlike.clear();
    lammps().create(config, Layout());
    check_forms(config, model, reference(config, model).get(), {"linear"}, record);
  }
  if (LammpsDriver::rank() == 0) record.print();
}

TEST(Forces, limit_on_negative_bulk_coefficients)
{
  Record record;
  for (int run = 0; run < 6; run++) {    // three dimensions, volumes by number and by mass
    const int dim = 1 + run % 3;
    Configuration config = periodic_fluid(dim, false, 190 + dim);
    if (run >= 3) config = by_mass(config);
    Model model = test_model(config, "wendland/c2");
    for (auto &fluid : model.fluids) fluid.kappa = 0.0L;
    const auto expected = reference(config, model);
    for (const bool on : {true, false}) {
      lammps().create(config, newton(on));
      for (const std::string shear : {"mg", "mg/fr", "mg/fr2"}) {
        for (const std::string limit : {"count", "yes"}) {
          lammps().pair_style(model, "linear", shear, "density", "limit " + limit);
          const Computed computed = lammps().run0();
          if (!expected) continue;
          expected->set_limited(limit == "yes");
          compare(computed, *expected, "linear", shear, "density", record,
                  label(config, model, "linear", shear, "density limit " + limit));
          EXPECT_EQ(computed.beyond_limit, expected->system().beyond_limit(shear));
          EXPECT_GT(computed.beyond_limit, 0);
        }
      }
    }
  }
  if (LammpsDriver::rank() == 0) record.print();
}

// The comparison must notice errors of the size of the tolerance: with one input of the reference
// wrong by 2e-11 of its value the forces differ by more.

TEST(Forces, comparison_notices_wrong_coefficients)
{
  constexpr double MUTATION = 1.0 + 2.0e-11;
  for (int dim = 1; dim <= 3; dim++) {
    const Configuration config = periodic_fluid(dim, false, 170 + dim);
    const Model model = test_model(config, "wendland/c2");
    lammps().create(config, Layout());
    for (const std::string bulk : {"density", "volume"}) {
      lammps().pair_style(model, "tait", "mg", bulk);
      const Computed computed = lammps().run0();
      if (LammpsDriver::rank() != 0) continue;

      std::vector<Model> mutants(6, model);
      for (auto &fluid : mutants[0].fluids) fluid.mu *= MUTATION;
      for (auto &fluid : mutants[1].fluids) fluid.kappa *= MUTATION;
      for (auto &fluid : mutants[2].fluids) fluid.c0 *= MUTATION;
      for (auto &fluid : mutants[3].fluids) fluid.rho0 *= MUTATION;
      mutants[4].mu_unlike[{1, 3}] *= MUTATION;
      mutants[5].support *= MUTATION;
      for (std::size_t k = 0; k < mutants.size(); k++) {
        const auto force = Expected(config, mutants[k]).force("tait", "mg", bulk);
        EXPECT_GT(deviation(computed.force, force), 1.0e-12) << "mutant " << k << " dim " << dim;
      }

      // a wrong form
      Expected right(config, model);
      EXPECT_LE(deviation(computed.force, right.force("tait", "mg", bulk)), 1.0e-12);
      const std::string other = bulk == "density" ? "volume" : "density";
      EXPECT_GT(deviation(computed.force, right.force("tait", "mg", other)), 1.0e-3);
      EXPECT_GT(deviation(computed.force, right.force("tait", "mg/fr", bulk)), 1.0e-3);
    }
  }
}

/* ---------------------------------------------------------------------- */

// two particles at the same point count for each other's number density, W(0), and do nothing else

TEST(Forces, coincident_particles)
{
  for (int dim = 1; dim <= 3; dim++) {
    Configuration config = periodic_fluid(dim, false, 180 + dim);
    for (int k = 0; k < 3; k++) config.x[3 * 1 + k] = config.x[k];
    Record record;
    for (const std::string kernel : {"wendland/c2", "cubic", "quintic"}) {
      const Model model = test_model(config, kernel);
      const auto expected = reference(config, model);
      for (const bool on : {true, false}) {
        lammps().create(config, newton(on));
        check_forms(config, model, expected.get(), {"linear"}, record);
      }
    }

    // nobody else near: no force at all
    for (int k = 0; k < dim; k++) config.v[k] = 0.7;
    config.x.resize(6);
    config.v.resize(6);
    config.mass.resize(2);
    config.energy.resize(2);
    config.type = {1, 3};
    lammps().create(config, Layout());
    const Model model = test_model(config, "cubic");
    for (const auto &shear : ALL_SHEAR) {
      for (const auto &bulk : ALL_BULK) {
        lammps().pair_style(model, "tait", shear, bulk);
        const Computed computed = lammps().run0();
        for (const double f : computed.force) EXPECT_EQ(f, 0.0) << shear << " " << bulk;
        for (const double q : computed.desph) EXPECT_EQ(q, 0.0) << shear << " " << bulk;
      }
    }
    if (LammpsDriver::rank() == 0) record.print();
  }
}
