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

#ifndef LMP_SPH_DISSIPATION_PAIR_SUMS_H
#define LMP_SPH_DISSIPATION_PAIR_SUMS_H

// Sums over the pairs of each particle, on the host and on a device.  add() adds a pair to the sum of particle i alone: a
// host calls add() for both particles of a pair, a device for each particle and its neighbors; both = shared(), a number that
// both particles of the pair have.  finish() gets the complete sum of an owned particle, on a device while other particles still
// sum up: so finish() must not change data that add() and shared() read.  No LAMMPS include.

#include "sph_dissipation_particle_terms.h"
#include "sph_dissipation_shift_terms.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // The bound B of LimitStage

  struct BoundSum {
    typedef double Row;
    static constexpr bool SHAPE = false;
    double *bound;

    SPH_FUNCTION double shared(const ParticleRows &of, int i, int j, const PairPlace &pair) const
    {
      const PairCoeff &coeff = of.pair[of.type[i] * of.par.ntypes_1 + of.type[j]];
      return bound_of_pair(central_weight(of.par.shear, coeff, pair.length), pair.slope, pair.rsq);
    }
    SPH_FUNCTION void add(const ParticleRows &of, int i, int j, const PairPlace &, double both,
                          double &sum) const
    {
      const double vol_i = of.particle[i].vol, vol_j = of.particle[j].vol;
      const double ratio = vol_i * of.weight[j * of.each] / (vol_j * of.weight[i * of.each]);
      sum += ratio * ratio * vol_j * both;
    }
    SPH_FUNCTION void finish(const ParticleRows &, int i, double sum) const { bound[i] = sum; }
  };

  // Rates of shear of owned particles, see shear_rate_squared().  On the host, a loop in vectors has this sum

  struct ShearRateSum {
    typedef double Row;
    static constexpr bool SHAPE = false;
    int not_fluid;

    SPH_FUNCTION double shared(const ParticleRows &of, int i, int j, const PairPlace &pair) const
    {
      const Particle &a = of.particle[i], &b = of.particle[j];
      double approach = 0.0;
      for (int d = 0; d < 3; d++) approach += pair.r[d] * (a.u[d] - b.u[d]);
      const double metric = (of.par.shear == Shear::MG_FR2) ? 1.0 : pair.rsq;
      return (pair.rsq > 0.0) ? pair.slope * approach * (approach / metric) : 0.0;
    }
    SPH_FUNCTION void add(const ParticleRows &of, int, int j, const PairPlace &, double both,
                          double &sum) const
    {
      sum += of.particle[j].vol * both;
    }
    SPH_FUNCTION void finish(const ParticleRows &of, int i, double sum) const
    {
      of.set_shear_rate(i, sum, not_fluid);
    }
  };

  // The four sums of a shift, see sph_dissipation_shift_terms.h

  struct ShiftPairs {
    static constexpr bool SHAPE = false;
    ShiftLaw law;
    ShiftRow *row;    // of owned and ghost particles

    // Return a_ij; set r to r' = r_ij at the new places; set v to the velocity of a particle
    SPH_FUNCTION double shared(const ParticleRows &, int i, int j, const PairPlace &pair) const
    {
      return shift_share(pair.slope, row[i], row[j]);
    }
    SPH_FUNCTION void distance(int i, int j, const PairPlace &pair, double *r) const
    {
      for (int d = 0; d < 3; d++) r[d] = pair.r[d] + (row[i].d[d] - row[j].d[d]);
    }
    SPH_FUNCTION void velocity(const ParticleRows &of, int i, double *v) const
    {
      velocity_in_shift(row[i], of.particle[i].u, v);
    }
  };

  struct CrowdingSum : ShiftPairs {
    typedef ShiftSum Row;
    static constexpr bool SHAPE = true;

    SPH_FUNCTION void add(const ParticleRows &of, int i, int j, const PairPlace &pair, double share,
                          ShiftSum &sum) const
    {
      const Particle &a = of.particle[i], &b = of.particle[j];
      const double u[3] = {a.u[0] - b.u[0], a.u[1] - b.u[1], a.u[2] - b.u[2]};
      const double push = concentration_push(b.vol, pair.slope, pair.shape, row[i].contact);
      add_to_shift(law, pair.r, u, b.vol, pair.slope, push, share, sum);
    }
    SPH_FUNCTION void finish(const ParticleRows &, int i, const ShiftSum &sum) const
    {
      set_shift(law, sum, row[i]);
    }
  };

  struct ExchangeSum : ShiftPairs {
    typedef ShiftExchange Row;

    SPH_FUNCTION void add(const ParticleRows &of, int i, int j, const PairPlace &pair, double share,
                          ShiftExchange &sum) const
    {
      if (share == 0.0) return;
      double v[3], w[3];
      velocity(of, i, v);
      velocity(of, j, w);
      for (int d = 0; d < 3; d++) {
        sum.moved[d] += share * row[j].q[d];
        sum.slip[d] += share * (v[d] - w[d]);
      }
    }
    SPH_FUNCTION void finish(const ParticleRows &, int i, const ShiftExchange &sum) const
    {
      set_displacement(sum, row[i]);
    }
  };

  struct ReturnTensorSum : ShiftPairs {
    typedef ShiftTensor Row;

    SPH_FUNCTION void add(const ParticleRows &, int i, int j, const PairPlace &pair, double share,
                          ShiftTensor &sum) const
    {
      if (share == 0.0) return;
      double r[3];
      distance(i, j, pair, r);
      add_square(law.dim, share, r, sum.a);
    }
    SPH_FUNCTION void finish(const ParticleRows &, int i, const ShiftTensor &sum) const
    {
      set_return(law.dim, sum, row[i]);
    }
  };

  struct ReturnSum : ShiftPairs {
    typedef ShiftReturn Row;
    VectorField x, v, vest;    // of owned particles, like the next member
    double *energy;
    double dt, keep, mvv2e;    // see finish_shift()

    SPH_FUNCTION void add(const ParticleRows &of, int i, int j, const PairPlace &pair, double share,
                          ShiftReturn &sum) const
    {
      if (share == 0.0) return;
      double r[3], v_i[3], v_j[3], push[3];
      distance(i, j, pair, r);
      velocity(of, i, v_i);
      velocity(of, j, v_j);
      sum.work += impulse_of_pair(share, row[i], row[j], v_i, v_j, r, push);
      for (int d = 0; d < 3; d++) sum.impulse[d] += push[d];
    }
    SPH_FUNCTION void finish(const ParticleRows &, int i, const ShiftReturn &sum) const
    {
      if (row[i].vol == 0.0) return;
      double to[3][3];
      for (int d = 0; d < 3; d++) {
        to[0][d] = x.at(i, d);
        to[1][d] = v.at(i, d);
        to[2][d] = vest.at(i, d);
      }
      finish_shift(row[i], sum, dt, keep, mvv2e, to[0], to[1], to[2], energy[i]);
      for (int d = 0; d < 3; d++) {
        x.at(i, d) = to[0][d];
        v.at(i, d) = to[1][d];
        vest.at(i, d) = to[2][d];
      }
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
