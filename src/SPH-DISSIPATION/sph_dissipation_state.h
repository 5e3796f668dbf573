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

#ifndef LMP_SPH_DISSIPATION_STATE_H
#define LMP_SPH_DISSIPATION_STATE_H

#include "sph_dissipation_stages.h"

#include <functional>
#include <string>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  class FluidModel;

  // Finds the change of the number density c of particles in a shear gamma of their arrangement: d2c/dgamma2 over c.  Times
  // the pressure, this number is the shear modulus of a lattice (theory page).

  class LatticeStrain : public Stage {
   public:
    using Stage::Stage;

    // Sum over the pairs of pass 1; weight = of owned and ghost particles

    void run(const std::vector<double> &weight);

    // Return the sum of weight times d2c/dgamma2 over c, for the direction of shear with the largest |sum|

    double largest(int type) const;

    // Return the sum of weight times the square of the vorticity, and times the square of the relative rate of the density

    double vorticity_squared(int type) const { return sums[type].vorticity_sq; }
    double rate_squared(int type) const { return sums[type].rate_sq; }

   private:
    struct Sum {
      double second[6], fourth[6][6];    // coefficients of any shear
      double vorticity_sq, rate_sq;
    };
    std::vector<Sum> sums;    // by type
  };

  // Density and pressure of the fluid at the first step, by type, and the shear elasticity that the pressure gives to a
  // regular arrangement.  Means are over the particles with a full support, which contains no free surface; over all
  // particles if there are no such particles.

  class FluidState : public Stage {
   public:
    FluidState(class LAMMPS *lmp, Engine &engine, Exchange &exchange, const FluidModel &model) :
        Stage(lmp, engine, exchange), model(model)
    {
    }

    // Find the means from the densities of pass 1, of particles with a bit of group and none of not_fluid

    void run(int group, int not_fluid, const std::function<double(int)> &pressure);

    bool has_type(int type) const { return count(type, ALL) > 0.0; }
    bool has_full_support(int type) const { return count(type, FULL) > 0.0; }
    double mean_density(int type) const;
    double spread(int type) const;    // standard deviation of the density over rho0
    double mean_pressure(int type) const;
    std::string table() const;    // for the log

    // Warn, on rank 0, of types whose density is far from rho0.  fix_style = the integrator, whose keyword helps

    void warn_of_density(const std::string &fix_style) const;

    // Warn, on rank 0, of types whose particles are farther apart than half of the support radius

    void warn_of_support(const std::string &style) const;

    // Warn, on rank 0, of the type whose arrangement has the largest shear elasticity over its viscosity, if its motion is a
    // shear that the arrangement survives.  moving = time since the start or the last call; 0 at the start.  Return the time
    // until the next call, the decay time of the longest waves, if there is no such motion yet, else 0.

    double warn_of_elasticity(const std::string &fix_style, double moving);

    // Multiply factor[type] and the masses of owned and ghost particles, of run() and with a bit of also, by one factor for
    // each type: then the mean density of the type is rho0, if volumes do not depend on masses.  Return the largest
    // |factor - 1|.

    double scale_masses(std::vector<double> &factor, int also) const;

    // Log the factors of the masses; warn of types without a full support

    void report_masses(const std::vector<double> &factor, const std::string &fix_style) const;

   private:
    enum Set { ALL, FULL, NSET };
    struct Mean {
      double count, excess, excess_sq, pressure;    // sums; excess = rho/rho0 - 1
      double sum;       // over the part of rho/rho0 that is a sum over neighbors
      double volume;    // sum, from the sum over neighbors
    };
    struct Range {
      double smallest, minus_largest;    // of the excess
    };

    const FluidModel &model;
    int group = 0, not_fluid = 0;
    std::vector<double> full;     // 1 for particles with full support, owned and ghost
    std::vector<Mean> means;      // by type and set
    std::vector<Range> ranges;    // by type and set

    double count(int type, Set set) const { return means[type * NSET + set].count; }
    bool is_far_off(int type, double density) const;
    int best(int type) const { return type * NSET + (has_full_support(type) ? FULL : ALL); }
    void find_full_support();
    void add_up(const std::function<double(int)> &pressure);
    double longest_wave() const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
