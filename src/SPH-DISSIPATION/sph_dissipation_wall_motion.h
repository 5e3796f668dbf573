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

#ifndef LMP_SPH_DISSIPATION_WALL_MOTION_H
#define LMP_SPH_DISSIPATION_WALL_MOTION_H

#include "pointers.h"
#include "sph_dissipation_value.h"
#include "sph_dissipation_wall_terms.h"

#include <string>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Motion of a rigid wall: a velocity, and a rotation about an axis through a point that moves with this velocity.  Each
  // component is a number or an equal-style variable.

  class WallMotion : protected Pointers {
   public:
    // owner: for messages
    WallMotion(class LAMMPS *lmp, const std::string &owner) : Pointers(lmp), owner(owner) {}

    // Read and check the arguments of the commands

    void set_velocity(char **);    // vx vy vz
    void set_rotation(char **);    // px py pz ax ay az omega

    void init();       // Find the variables, before a run.
    void start();      // Evaluate them, and their rates of change, at the start of a run.
    void stop();       // Let the wall stand still until the next start().
    void advance();    // Go to the end of a step.

    WallVelocity velocity() const;    // at the end of the last step
    WallStep last_step() const;       // for r from the point on the axis
    void move_point();                // with the wall
    bool has_variables() const { return any_variable; }

    // Write and read the point on the axis in restart files, and the given rotation.  The point is valid only if the
    // rotation is the same in the input

    static constexpr int NRESTART = 9;
    bool rotates() const { return rotation_given; }
    void pack_restart(double *) const;
    void restart(const double *);

   private:
    struct Component {
      Value value;
      double now = 0.0;     // at the end of the last step
      double mean = 0.0;    // mean of the values at both ends of this step
      double rate = 0.0;    // time derivative
    };
    static constexpr int NVALUES = 4;

    const std::string owner;
    Component values[NVALUES];    // velocity along x, y, z and angular velocity
    bool rotation_given = false;
    double given[6] = {0.0, 0.0, 0.0,
                       0.0, 0.0, 1.0};    // point and direction of the axis as in the input
    double point[3] = {}, axis[3] = {0.0, 0.0, 1.0};
    bool any_variable = false;
    bigint known_step = -1;    // step of the values, -1: none

    void read(Component &, const char *);
    bool evaluate(double *);
    void demand_finite() const;
    void estimate_rates();
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
