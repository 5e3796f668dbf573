/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// The comparisons of LAMMPS's testers of styles, in place of those in its test_main.cpp, which
// measure each component against itself. A component is a sum over many pairs. Where the sum
// cancels, its relative round-off depends on the processor and has no bound. So a component is
// measured against the largest one of all particles.

#include "compare.h"

#include "atom.h"

#include <iostream>
#include <vector>

using LAMMPS_NS::Atom;

static void compare(const std::string &name, const std::vector<double> &computed,
                    const std::vector<double> &expected, double epsilon)
{
  double size = 0.0;
  for (const double value : expected) size = std::max(size, std::fabs(value));
  const std::string place = test_config.basename + ", " + name;
  ErrorStats stats;
  for (std::size_t i = 0; i < expected.size(); i++) {
    const double difference = std::fabs(computed[i] - expected[i]);
    const double error = size > 0.0 ? difference / size : difference;
    stats.add(error);
    if (!(error <= epsilon))
      ADD_FAILURE() << name << ", number " << i << ": " << computed[i] << " is not " << expected[i]
                    << ", error " << error << " of the largest";
    Margin::note(error, epsilon, place.c_str(), static_cast<int>(i));
  }
  if (print_stats) std::cerr << name << " stats: " << stats << std::endl;
}

static void compare(const std::string &name, Atom *atom, double **computed,
                    const std::vector<coord_t> &expected, double epsilon)
{
  ASSERT_EQ(static_cast<std::size_t>(atom->nlocal) + 1, expected.size());
  std::vector<double> all_computed, all_expected;
  for (int i = 0; i < atom->nlocal; i++) {
    const auto &one = expected[atom->tag[i]];
    all_computed.insert(all_computed.end(), computed[i], computed[i] + 3);
    all_expected.insert(all_expected.end(), {one.x, one.y, one.z});
  }
  compare(name, all_computed, all_expected, epsilon);
}

/* ---------------------------------------------------------------------- */

void EXPECT_STRESS(const std::string &name, double *stress, const stress_t &expected,
                   double epsilon)
{
  compare(name, {stress, stress + 6},
          {expected.xx, expected.yy, expected.zz, expected.xy, expected.xz, expected.yz}, epsilon);
}

void EXPECT_FORCES(const std::string &name, Atom *atom, const std::vector<coord_t> &expected,
                   double epsilon)
{
  compare(name, atom, atom->f, expected, epsilon);
}

void EXPECT_POSITIONS(const std::string &name, Atom *atom, const std::vector<coord_t> &expected,
                      double epsilon)
{
  compare(name, atom, atom->x, expected, epsilon);
}

void EXPECT_VELOCITIES(const std::string &name, Atom *atom, const std::vector<coord_t> &expected,
                       double epsilon)
{
  compare(name, atom, atom->v, expected, epsilon);
}

void EXPECT_TORQUES(const std::string &name, Atom *atom, const std::vector<coord_t> &expected,
                    double epsilon)
{
  compare(name, atom, atom->torque, expected, epsilon);
}
