/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories

   This software is distributed under the GNU General Public License,
   version 2. See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// Disordered test configurations, the same on every MPI rank.

#ifndef SPHD_CONFIGURATION_H
#define SPHD_CONFIGURATION_H

#include "dense_reference.h"

#include <array>
#include <random>
#include <string>
#include <vector>

// What both LAMMPS and the dense reference are given. Box and positions are those of LAMMPS:
// three components, a 2d box for a line of particles.

struct Configuration {
  int dim;                         // dimension of the kernel
  bool periodic;                   // in the directions that the particles fill
  std::array<double, 3> lo, hi;    // box, before tilting
  std::array<double, 3> tilt;      // xy xz yz
  double support;
  std::vector<double> x, v;            // 3 per particle
  std::vector<double> mass, energy;    // energy of the whole particle
  std::vector<int> type;               // from 1
  std::vector<double> spin;            // 3 per particle of a micropolar fluid, otherwise empty
  std::vector<bool> wall;              // particles of a wall, or empty
  bool volume_by_mass = false;         // volumes from reference volumes m/rho0

  int size() const { return static_cast<int>(mass.size()); }
  int box_dim() const { return dim == 3 ? 3 : 2; }
  bool triclinic() const { return tilt[0] != 0.0 || tilt[1] != 0.0 || tilt[2] != 0.0; }

  DenseReference::Box reference_box() const;
  DenseReference::Particles reference_particles() const;
};

// uniform in [-1, 1) with the same numbers on every platform

class Random {
 public:
  explicit Random(unsigned seed) : engine(seed) {}
  double operator()() { return engine() * (2.0 / 4294967296.0) - 1.0; }

 private:
  std::mt19937 engine;
};

// Jittered lattice of three types of fluid with unequal masses and random velocities that fills a
// periodic box, each side longer than two supports

Configuration periodic_fluid(int dim, bool triclinic, unsigned seed);

// The same fluid as a free drop (line, disc, ball) away from the walls of a non-periodic box

Configuration free_drop(int dim, unsigned seed);

// Give all particles the velocity of a rigid motion about the origin; omega has one component (z)
// unless dim is 3

void set_rigid_motion(Configuration &config, const std::array<double, 3> &translation,
                      const std::array<double, 3> &omega);

// The same particles with volumes from reference volumes

Configuration by_mass(Configuration config);

// Random spins, along z unless dim is 3

void add_spins(Configuration &config, unsigned seed);

// The particles within a radius of the origin

Configuration within(const Configuration &config, double radius);

// Three fluids for the types of the configurations, scaled so that conservative and viscous forces
// are of the same size

std::vector<DenseReference::Fluid> test_fluids();

#endif
