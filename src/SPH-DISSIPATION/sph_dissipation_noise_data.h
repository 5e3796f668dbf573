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

  // Random numbers belong to a pair or a particle, the step, and a channel: the keys of the generator
  // are the seed and the channel, its counter the two IDs and the number of the step.

  enum class NoiseChannel {
    PRESSURE,
    PAIR,
    DRAG,
    STATE,            // and those that follow, one for every four states
    SURFACE = 1000    // pairs of a surface, if those of PAIR have others
  };

  // the step of the last random numbers, and what is added to a step to get numbers that no step before had

  struct NoiseClock {
    std::int64_t step = -1, offset = 0;
  };

  // of the pairs of two types: what the random numbers are multiplied with, in units of
  // sqrt(F V_i V_j), with F r instead of F for mg/fr; central_by_square = square of what belongs to F r^2

  struct NoiseCoeff {
    double central;            // along e
    double transverse;         // across e
    double spin_along;         // of the spins, along e
    double spin_across;        // across e
    double inverse_central;    // 1 / what the shear term puts before (u.e)^2, or 0
    double conduction;         // of heat
    double central_by_square;
  };

  // Of a particle that has a temperature of its own.  One of a wall has minus the temperature of the wall, no mobility and
  // softness, and 1 or 0 instead of the pressure: whether heat passes its surface.

  struct NoiseRow {
    double temperature;
    double spin_mobility;                                       // dt/J
    double pressure;                                            // random pressure / c^2
    double softness;                                            // k/C
    enum { TEMPERATURE, SPIN_MOBILITY, PRESSURE, SOFTNESS };    // numbers of a row
  };

  // of a particle, when the work of its pairs is shared

  struct Acceleration {
    double v[3];
    double by_inertia;    // 1/J
    double w[3];          // of the spin
    double unused;        // rows are loaded by four numbers
  };

  // input and output of the loops, beside the pairs that pass 1 has found; arrays of owned, ghost, and spare particles

  struct NoiseData {
    const double *tag;      // ID; zero of spare particles
    const double *reach;    // c sqrt(V), if DIRECTED
    const double *
        share;    // s eta/(D c), of those whose bulk term has a negative coefficient, see NoiseStage
    const NoiseRow *row;       // if ENERGY
    const double *mobility;    // dt/m, 0 of walls, if ENERGY
    bool unequal;              // the masses of the particles of the fluid differ
    double strength;           // square of central per unit friction along e
    std::uint64_t seed, step;
    NoiseChannel of_pairs;      // whose numbers pairs have
    double heat;                // 2 k/dt, of the random flow of heat
    const NoiseCoeff *coeff;    // by types of i and j, as in LoopData
    double dt;
    const Acceleration *acceleration;    // of all forces and torques, after them
    double *total;                       // what a loop sums up for each particle, accumulated
  };

  constexpr int MOST_NUMBERS = 16;    // kept for a pair: 8 random ones, 8 of the temperatures

  // DIRECTED: two numbers along e, one of each partner
  // ENERGY: at the temperatures of the particles, with the energy of motion and heat together constant

  // CONDUCTION: the same with conduction and its random flow, and with walls

  enum class NoiseKind { PLAIN, DIRECTED, ENERGY, CONDUCTION };

  // which numbers a pair needs

  struct NoiseForm {
    Terms terms;
    int dim;    // of the kernel
    NoiseKind kind;
  };

  // the noise of one pass 2: of pairs, and of the pairs of surfaces, data = nullptr: none; a random force of each owned
  // particle, or nullptr

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
