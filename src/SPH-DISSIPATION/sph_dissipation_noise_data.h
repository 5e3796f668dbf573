/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#ifndef LMP_SPH_DISSIPATION_NOISE_DATA_H
#define LMP_SPH_DISSIPATION_NOISE_DATA_H

#include "sph_dissipation_settings.h"

#include <cstdint>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // A random number belongs to a pair or a particle, a step, and a channel: the keys of the generator
  // are the seed and the channel, its counter the two IDs and the number of the step.

  enum class NoiseChannel {
    PRESSURE,
    PAIR,
    DRAG,
    STATE,            // this number and the next ones: one for every four states
    SURFACE = 1000    // added noise of pairs across a surface, besides PAIR
  };

  // Step of the last random numbers; offset of all steps, so that no two steps have the same numbers

  struct NoiseClock {
    std::int64_t step = -1, offset = 0;
  };

  // Factors of the random numbers of pairs of two types, in units of sqrt(F V_i V_j), with F r instead of F for mg/fr;
  // central_by_square = square of the factor for F r^2

  struct NoiseCoeff {
    double central;            // along e
    double transverse;         // across e
    double spin_along;         // of the spins, along e
    double spin_across;        // across e
    double inverse_central;    // 1 / coefficient of (u.e)^2 of the friction; 0 without friction
    double conduction;         // mean coefficient of conduction
    double central_by_square;
  };

  // Row of a particle with temp energy.  temperature < 0: a wall particle.  The number is then minus the temperature of the
  // wall, mobility and softness are 0, and pressure is 1 if heat passes the surface, else 0.

  struct NoiseRow {
    double temperature;
    double spin_mobility;                                       // dt/J
    double pressure;                                            // random pressure / c^2
    double softness;                                            // k/C
    enum { TEMPERATURE, SPIN_MOBILITY, PRESSURE, SOFTNESS };    // numbers of a row
  };

  // Accelerations of a particle, for the loop that shares the work of its pairs

  struct Acceleration {
    double v[3];
    double by_inertia;    // 1/J
    double w[3];          // rate of the spin
    double unused;        // rows are loaded by four numbers
  };

  // Input and output of the loops, besides the pairs that pass 1 has found; arrays of owned, ghost, and spare particles

  struct NoiseData {
    const double *tag;      // ID; zero of spare particles
    const double *reach;    // c sqrt(V), if DIRECTED
    const double *
        share;    // s eta/(D c) where the bulk term has a negative coefficient, else 0, see NoiseStage
    const NoiseRow *row;       // if ENERGY
    const double *mobility;    // dt/m, 0 of walls, if ENERGY
    bool unequal;              // the masses of the particles of the fluid differ
    double strength;           // square of central per unit friction along e
    std::uint64_t seed, step;
    NoiseChannel of_pairs;      // channel of the numbers of pairs
    double heat;                // 2 k/dt, for the random flow of heat
    const NoiseCoeff *coeff;    // by types of i and j, as in LoopData
    double dt;
    const Acceleration *acceleration;    // by all forces and torques
    double *total;                       // sums of a loop by particle, accumulated
  };

  constexpr int MOST_NUMBERS = 16;    // kept for a pair: 8 random ones, 8 of the temperatures

  // DIRECTED: two numbers along e, one for each partner
  // ENERGY: temperatures of the particles; kinetic energy and heat together are constant
  // CONDUCTION: ENERGY with conduction and its random flow, and with walls

  enum class NoiseKind { PLAIN, DIRECTED, ENERGY, CONDUCTION };

  // Selects the random numbers of a pair

  struct NoiseForm {
    Terms terms;
    int dim;    // of the kernel
    NoiseKind kind;
  };

  // Noise of one pass 2: of pairs, and of pairs across surfaces, data = nullptr: none; drag = three components of a random
  // force for each owned particle, or nullptr

  struct StepNoise {
    struct Part {
      NoiseForm form;
      const NoiseData *data;
    };
    Part pairs, surfaces;
    const double *drag;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
