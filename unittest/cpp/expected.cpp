/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "expected.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using DenseReference::Vector;

const std::vector<std::string> ALL_EOS = {"linear", "tait", "ideal"};
const std::vector<std::string> ALL_SHEAR = {"mg", "mg/fr", "mg/fr2", "morris", "espanol", "none"};
const std::vector<std::string> ALL_BULK = {"density", "volume", "none"};

static constexpr double TOLERANCE = 1.0e-12;

/* ---------------------------------------------------------------------- */

DenseReference::Model test_model(const Configuration &config, const std::string &kernel)
{
  DenseReference::Model model;
  model.kernel = kernel;
  model.n = config.dim;
  model.support = config.support;
  model.volume_by_mass = config.volume_by_mass;
  model.fluids = test_fluids();
  model.mu_unlike[{1, 3}] = 0.45;
  return model;
}

double deviation(const std::vector<double> &computed, const Vector &expected)
{
  if (computed.size() != static_cast<std::size_t>(expected.size()))
    return std::numeric_limits<double>::infinity();
  DenseReference::Real difference = 0.0L, size = 0.0L;
  for (std::size_t i = 0; i < computed.size(); i++) {
    if (!std::isfinite(computed[i])) return std::numeric_limits<double>::infinity();
    difference = std::max(difference, std::fabs(computed[i] - expected(i)));
    size = std::max(size, std::fabs(expected(i)));
  }
  return difference == 0.0L ? 0.0 : static_cast<double>(difference / size);
}

/* ---------------------------------------------------------------------- */

Expected::Expected(const Configuration &config, const DenseReference::Model &model) :
    dense(model, config.reference_box(), config.reference_particles()), dim(config.dim),
    limited(false)
{
}

void Expected::set_limited(bool on)
{
  limited = on;
}

Vector Expected::three_components(const Vector &v) const
{
  Vector result = Vector::Zero(3 * dense.size());
  for (int i = 0; i < dense.size(); i++) result.segment(3 * i, dim) = v.segment(dim * i, dim);
  return result;
}

const Expected::Term &Expected::conservative(const std::string &eos)
{
  const std::string key = "eos " + eos;
  if (terms.count(key) == 0)
    terms[key] = {dense.conservative_force(eos), dense.compression_power(eos)};
  return terms[key];
}

const Expected::Term &Expected::shear(const std::string &form)
{
  const std::string key = "shear " + form;
  if (terms.count(key) == 0) {
    const auto viscous = dense.shear(form);
    terms[key] = {viscous.force, viscous.heating};
  }
  return terms[key];
}

const Expected::Term &Expected::bulk(const std::string &form, const std::string &shear_form)
{
  const std::string key = (limited ? "limited bulk " : "bulk ") + form + " with " + shear_form;
  if (terms.count(key) == 0) {
    const auto viscous = dense.bulk(form, shear_form, limited, false);
    terms[key] = {viscous.force, viscous.heating};
  }
  return terms[key];
}

Vector Expected::viscous_force(const std::string &shear_form, const std::string &bulk_form)
{
  return three_components(shear(shear_form).force + bulk(bulk_form, shear_form).force);
}

Vector Expected::force(const std::string &eos, const std::string &shear_form,
                       const std::string &bulk_form)
{
  return three_components(conservative(eos).force) + viscous_force(shear_form, bulk_form);
}

Vector Expected::desph(const std::string &eos, const std::string &shear_form,
                       const std::string &bulk_form)
{
  return conservative(eos).heating + shear(shear_form).heating +
      bulk(bulk_form, shear_form).heating;
}

/* ---------------------------------------------------------------------- */

void Record::check(const std::string &field, double deviation, double tolerance,
                   const std::string &where)
{
  EXPECT_LE(deviation, tolerance) << field << " of " << where;
  worst[field] = std::max(worst[field], deviation);
}

void Record::print() const
{
  printf("largest relative deviation:");
  for (const auto &entry : worst) printf(" %s %.1e", entry.first.c_str(), entry.second);
  printf("\n");
}

void compare(const Computed &computed, Expected &expected, const std::string &eos,
             const std::string &shear, const std::string &bulk, Record &record,
             const std::string &where)
{
  const auto &system = expected.system();
  record.check("f", deviation(computed.force, expected.force(eos, shear, bulk)), TOLERANCE, where);
  record.check("desph", deviation(computed.desph, expected.desph(eos, shear, bulk)), TOLERANCE,
               where);
  record.check("numden", deviation(computed.numden, system.numden()), TOLERANCE, where);
  record.check("dnumden", deviation(computed.dnumden, system.dnumden()), TOLERANCE, where);
  record.check("vol", deviation(computed.volume, system.volume()), TOLERANCE, where);
  record.check("rho", deviation(computed.density, system.density()), TOLERANCE, where);
}
