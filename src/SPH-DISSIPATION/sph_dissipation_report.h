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

#ifndef LMP_SPH_DISSIPATION_REPORT_H
#define LMP_SPH_DISSIPATION_REPORT_H

#include "sph_dissipation_stages.h"

#include <functional>
#include <string>

namespace LAMMPS_NS {
namespace SPHDissipation {

  class BoundaryStage;
  class CoeffTable;
  class FluidModel;
  class FluidState;
  class StiffScheme;

  // Lines of a fluid in the log, and warnings about the fluid at the start of a run and during a run.  All ranks call these
  // functions; pressure(i) = pressure of owned particle i; not_fluid = bits of the groups of walls and open zones.

  class FluidReport : public Stage {
   public:
    FluidReport(class LAMMPS *lmp, Engine &engine, Exchange &exchange, const std::string &style,
                const FluidModel &model, const BoundaryStage &boundary,
                const ShiftStage<HostSpace> &shift, const StiffScheme &viscous) :
        Stage(lmp, engine, exchange),
        style(style), model(model), boundary(boundary), shift(shift), viscous(viscous)
    {
    }

    // The coefficients are new: log their table, with the warnings of a first run, at the next begin_run()
    void renew() { is_new = true; }
    bool has_new() const { return is_new; }
    void begin_run(const CoeffTable &, const std::function<double(int)> &pressure, int not_fluid);

    // Warn once of each time step that is too large
    void check_time_step(const CoeffTable &);

    // At a neighbor list: warn once of fast particles and of a fluid that flies apart.  Return whether the next call reads
    // the velocities or the densities
    void check_list(int not_fluid);
    bool reads_velocities() const;
    bool reads_densities() const;

    // A step of the length dt has passed: return true if the elasticity of the arrangement is to be checked again
    bool elasticity_is_due(double dt) { return look_after > 0.0 && (moving += dt) > look_after; }
    void check_elasticity(const std::function<double(int)> &pressure, int not_fluid);

   private:
    const std::string &style;
    const FluidModel &model;
    const BoundaryStage &boundary;
    const ShiftStage<HostSpace> &shift;
    const StiffScheme &viscous;

    bool is_new = true;          // the log does not have the table of the present coefficients
    double warned_step = 0.0;    // time step of the last warning
    double noise_step = 0.0;     // time step of the last line about the noise
    int fast_lists = 0;       // neighbor lists in a row with fast particles; -1: after the warning
    bool expanded = false;    // check_expansion() has warned
    double look_after = 0.0;    // time until the elasticity is checked again; 0: never
    double moving = 0.0;        // time since the last check of the elasticity

    void check_all_interact();
    void check_speed(bool all_is_fluid);
    void check_expansion();
    void check_elasticity(FluidState &);
    std::string skin_text(const CoeffTable &) const;
    void announce_noise(double rate);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
