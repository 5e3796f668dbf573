/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "sph_dissipation_characteristics.h"

#include <gtest/gtest.h>

using namespace LAMMPS_NS::SPHDissipation;

static constexpr double IMPEDANCE = 2.6;    // rho c

// d'Alembert: p' = rho c u' in a wave that travels out of the fluid, p' = -rho c u' in one that comes in

TEST(Characteristics, wave_that_leaves_is_found_again)
{
  for (const double u : {-0.3, 0.0, 0.2}) {
    const double wave = outgoing_wave(IMPEDANCE, u, IMPEDANCE * u);
    EXPECT_NEAR(wave_velocity(IMPEDANCE, wave), u, 1e-16);
    EXPECT_NEAR(wave_pressure(wave), IMPEDANCE * u, 1e-16);
  }
}

TEST(Characteristics, wave_that_comes_in_is_not_seen)
{
  for (const double u : {-0.3, 0.2}) EXPECT_EQ(outgoing_wave(IMPEDANCE, u, -IMPEDANCE * u), 0.0);
}

TEST(Characteristics, both_at_once)
{
  const double out = 0.7, in = -0.4;    // pressures
  const double u = (out - in) / IMPEDANCE, p = out + in;
  const double wave = outgoing_wave(IMPEDANCE, u, p);
  EXPECT_NEAR(wave_pressure(wave), out, 1e-15);
  EXPECT_NEAR(wave_velocity(IMPEDANCE, wave), out / IMPEDANCE, 1e-15);
}
