/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "sph_dissipation_split.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace LAMMPS_NS::SPHDissipation;

namespace {

struct Totals {
  double mass = 0.0, mx[3] = {}, p[3] = {}, angmom[3] = {}, kinetic = 0.0, internal = 0.0;
  double p_end[3] = {}, angmom_end[3] = {};
};

Totals totals(const std::vector<Lump> &lumps)
{
  Totals sum;
  for (const Lump &one : lumps) {
    sum.mass += one.mass;
    for (int d = 0; d < 3; d++) {
      sum.mx[d] += one.mass * one.x[d];
      sum.p[d] += one.mass * one.u[d];
      sum.p_end[d] += one.mass * one.u_end[d];
      sum.angmom[d] += one.mass * one.inertia * one.spin[d];
      sum.angmom_end[d] += one.mass * one.inertia * one.spin_end[d];
    }
    add_cross(one.mass, one.x, one.u, sum.angmom);
    add_cross(one.mass, one.x, one.u_end, sum.angmom_end);
    sum.kinetic += 0.5 * one.mass * (dot(one.u, one.u) + one.inertia * dot(one.spin, one.spin));
    sum.internal += one.energy;
  }
  return sum;
}

double kinetic(const std::vector<Lump> &lumps)
{
  return totals(lumps).kinetic;
}

void expect_near(const double *a, const double *b, double tolerance, const char *what)
{
  for (int d = 0; d < 3; d++) EXPECT_NEAR(a[d], b[d], tolerance) << what << d;
}

// what a merge leaves over goes to all others; returns the energy that takes

double give(const double *rest, int dim, const Lump &whole, std::vector<Lump> &others,
            double radius)
{
  Shell shell;
  auto offset = [&](const Lump &one, double *r) {
    for (int d = 0; d < 3; d++) r[d] = one.x[d] - whole.x[d];
    return shell_weight(dot(r, r), radius);
  };
  double r[3];
  for (const Lump &one : others) {
    const double weight = offset(one, r);
    if (weight > 0.0) shell.add(weight * one.mass, r, one.u);
  }
  Rotation rotation;
  EXPECT_TRUE(shell.take(rest, dim, rotation));
  double work = 0.0;
  for (Lump &one : others) {
    double du[3] = {0.0, 0.0, 0.0};
    const double weight = offset(one, r);
    if (weight > 0.0) rotation.velocity(weight, r, du);
    for (int d = 0; d < 3; d++) {
      work += one.mass * (one.u[d] - rotation.mean[d] + 0.5 * du[d]) * du[d];
      one.u[d] += du[d];
      one.u_end[d] += du[d];
    }
  }
  return work;
}

}    // namespace

/* ---------------------------------------------------------------------- */

class Split : public ::testing::TestWithParam<std::tuple<int, bool>> {
 protected:
  int dim() const { return std::get<0>(GetParam()); }
  bool spinning() const { return std::get<1>(GetParam()); }
  std::mt19937 random{17};
  double number() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); }

  std::vector<Lump> cluster(int n)
  {
    std::vector<Lump> lumps(n);
    for (Lump &one : lumps) {
      one.mass = 1.5 + number();
      one.energy = 3.0 + number();
      if (spinning()) one.inertia = 0.3 + 0.1 * number();
      for (int d = 0; d < dim(); d++) {
        one.x[d] = 3.0 * number();
        one.u[d] = number();
        one.u_end[d] = number();
      }
      if (spinning())
        for (int d = (dim() == 3) ? 0 : 2; d < 3; d++) {
          one.spin[d] = number();
          one.spin_end[d] = number();
        }
    }
    return lumps;
  }

  Stencil stencil()
  {
    if (random() % 2) return cube_stencil(dim(), 0.1);
    double axis[3] = {number(), number(), dim() == 3 ? number() : 0.0};
    const double length = std::sqrt(dot(axis, axis));
    for (double &a : axis) a /= length;
    return axis_stencil(axis, 0.1);
  }
};

/* ----------------------------------------------------------------------
   what is conserved in a thousand events, and the ledger of what is not
------------------------------------------------------------------------- */

TEST_P(Split, random_cluster)
{
  std::vector<Lump> lumps = cluster(40);
  const Totals first = totals(lumps);
  double heat = 0.0, work = 0.0, coldest = 1.0;
  int nsplit = 0, nmerge = 0;
  for (int event = 0; event < 1000; event++) {
    const std::size_t k = random() % lumps.size();
    if (lumps.size() < 30 || (lumps.size() < 60 && random() % 3 == 0)) {
      Lump daughters[Stencil::MOST];
      const Stencil places = stencil();
      const double before = kinetic({lumps[k]});
      split(lumps[k], places, dim(), daughters);
      EXPECT_NEAR(kinetic(std::vector<Lump>(daughters, daughters + places.n)), before,
                  1e-14 * (1.0 + before));
      lumps.erase(lumps.begin() + k);
      lumps.insert(lumps.end(), daughters, daughters + places.n);
      nsplit++;
      continue;
    }
    const int n = 2 + random() % 3;
    std::vector<Lump> parts;
    for (int m = 0; m < n; m++) {
      const std::size_t l = random() % lumps.size();
      parts.push_back(lumps[l]);
      lumps.erase(lumps.begin() + l);
    }
    Lump whole;
    double rest[3];
    const double released = merge(parts.data(), n, dim(), spinning(), whole, rest);
    whole.energy += released;
    heat += released;
    coldest = std::min(coldest, released);
    if (!spinning()) {
      const double taken = give(rest, dim(), whole, lumps, 20.0);
      whole.energy -= taken;
      work += taken;
    }
    lumps.push_back(whole);
    nmerge++;
  }
  EXPECT_GT(nsplit, 100);
  EXPECT_GT(nmerge, 100);
  EXPECT_GE(coldest, 0.0);

  const Totals last = totals(lumps);
  const double scale = first.mass * 3.0;    // times the size of the cluster and a speed
  EXPECT_NEAR(last.mass, first.mass, 1e-13 * first.mass);
  expect_near(last.mx, first.mx, 1e-13 * scale, "centre of mass ");
  expect_near(last.p, first.p, 1e-13 * scale, "momentum ");
  expect_near(last.angmom, first.angmom, 1e-13 * scale, "angular momentum ");
  expect_near(last.p_end, first.p_end, 1e-13 * scale, "momentum at the end ");
  if (spinning())
    expect_near(last.angmom_end, first.angmom_end, 1e-13 * scale, "angular momentum at the end ");
  const double energy = first.kinetic + first.internal;
  EXPECT_NEAR(last.kinetic + last.internal, energy, 1e-12 * energy);
  EXPECT_NEAR(last.kinetic - first.kinetic, work - heat, 1e-12 * energy);
  EXPECT_GT(heat, 0.0);
}

/* ----------------------------------------------------------------------
   parts of a cube merge back into it; so do pairs of pairs in two dimensions
------------------------------------------------------------------------- */

TEST_P(Split, back_again)
{
  for (Lump parent : cluster(20)) {
    for (const double distance : {0.25, 0.05}) {
      Lump daughters[Stencil::MOST], whole;
      double rest[3];
      const Stencil places = cube_stencil(dim(), distance);
      split(parent, places, dim(), daughters);
      double released = merge(daughters, places.n, dim(), spinning(), whole, rest);
      if (dim() == 2) {
        Lump half[2];
        double rest_half[3];
        for (int k = 0; k < 2; k++)
          released += merge(daughters + 2 * k, 2, 2, spinning(), half[k], rest_half);
        released += merge(half, 2, 2, spinning(), whole, rest);
      }
      EXPECT_NEAR(released, 0.0, 1e-15);
      EXPECT_DOUBLE_EQ(whole.mass, parent.mass);
      EXPECT_NEAR(whole.energy, parent.energy, 1e-14);
      expect_near(whole.x, parent.x, 1e-14, "x ");
      expect_near(whole.u, parent.u, 1e-14, "u ");
      expect_near(whole.u_end, parent.u_end, 1e-14, "u at the end ");
      bool rotates;
      daughter_inertia(parent, places, dim(), rotates);
      if (!spinning()) expect_near(rest, std::vector<double>(3).data(), 1e-15, "rest ");
      if (!spinning() || !rotates) continue;
      EXPECT_NEAR(whole.inertia, parent.inertia, 1e-14);
      expect_near(whole.spin, parent.spin, 1e-13, "spin ");
      expect_near(whole.spin_end, parent.spin_end, 1e-13, "spin at the end ");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Split, Split,
                         ::testing::Combine(::testing::Values(2, 3), ::testing::Bool()));

/* ----------------------------------------------------------------------
   the inertia V^(2/n)/6 + I_micro of a cube is that of its parts
------------------------------------------------------------------------- */

TEST(SplitInertia, of_cubes)
{
  for (const int dim : {2, 3}) {
    const double a = 1.7, micro = 0.02;
    Lump parent;
    parent.mass = 1.0;
    parent.inertia = a * a / 6.0 + micro;
    bool rotate;
    const double inertia =
        daughter_inertia(parent, cube_stencil(dim, SPLIT_IN_BLOCK * a), dim, rotate);
    EXPECT_TRUE(rotate);
    EXPECT_NEAR(inertia, 0.25 * a * a / 6.0 + micro, 1e-15);
  }
}

/* ----------------------------------------------------------------------
   a trace as the moment of inertia of a merged particle would cool it
------------------------------------------------------------------------- */

TEST(SplitHeat, of_a_rod)
{
  Lump parts[2], whole;
  double rest[3];
  for (int k = 0; k < 2; k++) {
    const double side = k ? 1.0 : -1.0;
    parts[k].mass = 1.0;
    parts[k].inertia = 0.01;
    parts[k].x[0] = 0.5 * side;
    parts[k].u[1] = 0.5 * side;
    parts[k].spin[2] = 1.0;
  }
  EXPECT_NEAR(merge(parts, 2, 3, true, whole, rest), 0.0, 1e-15);
  EXPECT_NEAR(whole.inertia, 0.26, 1e-15);
  EXPECT_NEAR(whole.spin[2], 1.0, 1e-15);
}

TEST(SplitArrangement, widest_axis)
{
  for (const int dim : {2, 3}) {
    for (const double unit : {1.0, 1e-15, 1e15}) {
      for (const double stretch : {1.0, 1.5, 2.0}) {
        Arrangement neighbors;
        double axis[3], ratio;
        for (int i = -3; i <= 3; i++)
          for (int j = -3; j <= 3; j++)
            for (int k = (dim == 3 ? -3 : 0); k <= (dim == 3 ? 3 : 0); k++) {
              const double r[3] = {unit * i, unit * stretch * j, unit * k};
              neighbors.add(r);
            }
        const double spacing =
            neighbors.widest(dim, stretch * std::pow(unit, dim), axis, ratio) / unit;
        EXPECT_NEAR(std::fabs(axis[stretch > 1.0 ? 1 : 0]), 1.0, 1e-9);
        EXPECT_NEAR(spacing, stretch, 0.15 * stretch);
      }
    }
    double axis[3], ratio;
    EXPECT_GT(Arrangement().widest(dim, 1.0, axis, ratio), 0.0);
  }
}

TEST(Symmetric, eigenvalues)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int turn = 0; turn < 100; turn++) {
    Symmetric tensor;
    for (int k = 0; k < 4; k++) {
      const double r[3] = {uniform(random), uniform(random), uniform(random)};
      tensor.add_product(1.0, r);
    }
    const double trace = tensor.a[0][0] + tensor.a[1][1] + tensor.a[2][2];
    const Eigen3 principal = eigen(tensor);
    for (int d = 0; d < 3; d++)
      for (int e = 0; e < 3; e++) {
        double sum = 0.0;
        for (int k = 0; k < 3; k++)
          sum += principal.value[k] * principal.axis[k][d] * principal.axis[k][e];
        EXPECT_NEAR(sum, tensor.a[d][e], 5e-15 * trace);
      }
  }
}
