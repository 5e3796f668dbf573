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

#ifndef LMP_SPH_DISSIPATION_PRESSURE_H
#define LMP_SPH_DISSIPATION_PRESSURE_H

#include "sph_dissipation_stage.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Pressure and bulk term of all particles of the fluid, of volume and density as pass 1 left them:
  // what pass 2 multiplies with F r_ij, and the work of the pressure.  P1 (12), (18)

  class PressureStage : public Stage {
   public:
    using Stage::Stage;

    // bound = of LimitStage, nullptr without; not_fluid = bits of the groups of boundary particles,
    // which get zero.  Returns the number of owned particles whose coefficient is beyond the bound.

    bigint run(const double *bound, int not_fluid);

    // the bulk term alone, of the rates that pass 1 has left: what the passes leave of Gamma u

    void set_bulk_term(const double *bound, int not_fluid) const;

    // elastic energy of owned particles; each_atom = what it is added to, or nullptr

    double elastic_energy(double *each_atom, int not_fluid) const;

   private:
    bool is_beyond(int i, const double *bound) const;
    double bulk_coefficient(int i, const double *bound) const;    // in effect
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
