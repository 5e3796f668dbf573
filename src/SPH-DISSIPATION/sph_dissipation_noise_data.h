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

#include "sph_dissipation_coeffs.h"

#include <cstdint>

namespace LAMMPS_NS {
namespace SPHDissipation {

  class PairTally;
  struct ForceSum;
  struct TorqueSum;

  // Random numbers belong to a pair or a particle, the step, and a channel: the keys of the generator
  // are the seed and the channel, its counter the two IDs and the number of the step.

  enum class NoiseChannel { PRESSURE, PAIR, PAIR_MORE };

  // of the pairs of two types: what the random numbers are multiplied with, in units of
  // sqrt(F V_i V_j), with F r instead of F for mg/fr

  struct NoiseCoeff {
    double central;            // along e
    double transverse;         // across e
    double spin_along;         // of the spins, along e
    double spin_across;        // across e
    double inverse_central;    // 1 / what the shear term puts before (u.e)^2, or 0
  };

  // what the loops of the noise read of a particle: one cache line

  struct NoiseRow {
    double x[3];     // position
    double vol;      // V
    double tag;      // ID; zero for spare ones
    double reach;    // c sqrt(V)
    double share;    // s eta/(D c), if its bulk term has a negative coefficient, see NoiseStage
    double unused;
  };

  // input and output of the loops of the noise, beside the pairs that pass 1 has found

  struct NoiseData {
    const NoiseRow *row;    // owned, ghost, and spare
    std::uint64_t seed, step;
    const int *type;            // read if the coefficients differ between types
    const NoiseCoeff *coeff;    // by types of i and j, as in LoopData
    double *eta;                // sums of the numbers of a particle, accumulated
    double *pressure;           // number of each particle
    ForceSum *force;            // owned, ghost, and spare; accumulated
    TorqueSum *torque;          // the same
    PairTally *tally;           // nullptr if nobody asks
  };

  // which numbers a pair needs

  struct NoiseForm {
    Shear shear;
    int dim;          // of the kernel
    bool directed;    // two numbers along e, one of each partner
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
