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

  // How the number density of particles changes in a shear gamma of their arrangement: d2c/dgamma2
  // over c, which times the pressure is the shear modulus of a lattice (theory page).

  class LatticeStrain : public Stage {
   public:
    using Stage::Stage;

    // sums over the pairs of pass 1; weight = of owned and ghost particles

    void run(const std::vector<double> &weight);

    // sum of weight times d2c/dgamma2 over c, the largest in size of all directions of the shear

    double largest(int type) const;

    // sums of weight times the square of the vorticity, and of the rate of the density over the density

    double vorticity_squared(int type) const { return sums[type].vorticity_sq; }
    double rate_squared(int type) const { return sums[type].rate_sq; }

   private:
    struct Sum {
      double second[6], fourth[6][6];    // coefficients of any shear
      double vorticity_sq, rate_sq;
    };
    std::vector<Sum> sums;    // by type
  };

  // The fluid as it enters the first step, by type: density, pressure, and the shear elasticity that
  // the pressure gives to a regular arrangement.  The means are over the particles with a full
  // support, that is without a free surface in reach; over all if there are no such particles.

  class FluidState : public Stage {
   public:
    FluidState(class LAMMPS *lmp, Engine &engine, Exchange &exchange, const FluidModel &model) :
        Stage(lmp, engine, exchange), model(model)
    {
    }

    // with the densities of pass 1; of particles with the bit of group, without one of not_fluid

    void run(int group, int not_fluid, const std::function<double(int)> &pressure);

    bool has_type(int type) const { return count(type, ALL) > 0.0; }
    bool has_full_support(int type) const { return count(type, FULL) > 0.0; }
    double mean_density(int type) const;
    double spread(int type) const;    // standard deviation of the density over rho0
    double mean_pressure(int type) const;
    std::string table() const;    // for the log

    // Warn, on rank 0, of types whose density is far from rho0.  fix_style = the integrator, whose keyword helps

    void warn_of_density(const std::string &fix_style) const;

    // Warn, on rank 0, of the type whose arrangement has the largest shear elasticity over its viscosity, if its motion is a
    // shear that the arrangement survives.  moving = time for which what drives it has acted, 0: at the start.  Returns that
    // after which to look again, the decay time of the longest waves, if there is no such motion yet, else 0.

    double warn_of_elasticity(const std::string &fix_style, double moving);

    // masses of the owned and ghost particles of run(), and of those with a bit of also, times one
    // factor for each type, so that the mean density of the type is rho0 if the volumes do not depend
    // on masses; factor[type] is multiplied by it.  Returns the largest |factor - 1|.

    double scale_masses(std::vector<double> &factor, int also) const;

    // what the masses were multiplied with, in the log

    void report_masses(const std::vector<double> &factor, const std::string &fix_style) const;

   private:
    enum Set { ALL, FULL, NSET };
    struct Mean {
      double count, excess, excess_sq, pressure;    // sums; excess = rho/rho0 - 1
      double sum;    // of the part of rho/rho0 that is a sum over neighbors
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
