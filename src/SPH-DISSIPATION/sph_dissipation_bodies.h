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

#ifndef LMP_SPH_DISSIPATION_BODIES_H
#define LMP_SPH_DISSIPATION_BODIES_H

#include "pointers.h"
#include "sph_dissipation_boundary.h"

#include <string>
#include <unordered_map>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {
  struct ForceSum;

  // Rigid bodies of particles that another fix moves.  Finds place and velocity of each body from the particles of the body,
  // and extrapolates the acting velocity (the velocity in the forces) from the middle of the step to the end

  class Bodies : public RigidMotions, protected Pointers {
   public:
    struct Body {
      double mass, x[3], v[3], omega[3];    // x: center of mass; v, omega: acting velocity
      double angular[3], inertia[6];        // angular momentum, about the center: xx yy zz xy xz yz
      double v_end[3], angular_end[3];      // v and angular at the end of the last step
      double axis[3][3], moment[3];         // principal axes and moments; 0 without inertia
      double v_middle[3], angular_middle[3];    // v and angular in the middle of the last step
      double own[2][3], others[2][3];    // last force, torque: of the pair style; of other styles
      double rest;                       // see rest_of_heat()
      double rotation[3][3];             // rotation of the last step
    };

    Bodies(class LAMMPS *lmp, int groupbit, const std::string &owner, const std::string &id) :
        Pointers(lmp), groupbit(groupbit), owner(owner), id(id)
    {
    }

    // At the start of a run, find the bodies: each molecule, or all particles as one body.  lagging: the fix that moves the
    // bodies gives the particles the angular velocity of the orientation in the middle of the step
    void init(bool by_molecule, bool lagging);

    int size() const override { return static_cast<int>(bodies.size()); }
    const Body &operator[](int k) const { return bodies[k]; }
    int of(int i) const;    // body of an owned particle

    // Set v to the acting velocity of the body of an owned particle, at the place of the particle
    void velocity_at(int i, double *v) const;

    // At the start of a run, take the velocities of the particles; return whether the bodies still have the velocities of the
    // end of the last step.  With keep, bodies with these velocities take the acting velocity from vest
    bool start(bool keep);
    // After the particles have moved, set the acting velocity to the velocity in the middle of the step plus extrapolation
    // times the increment since the end of the last step
    void advance(double extrapolation);
    void end_step();    // takes the velocities at the end of the step

    // Take the forces of the pair style on the owned particles, at the end of a step and at the start of a run
    void note_forces(const ForceSum *);

    // Return the share of an owned particle in the energy that the heat misses in half a kick: work of the forces of the pair
    // style at the acting velocity, less work of these forces at the mean velocity of the kick
    double rest_of_heat(int i) const;

    void append(bool starts, RigidRows &) const override;
    void velocities(const double *,
                    const std::function<void(int, const double *)> &) const override;
    void add_forces(const std::function<const double *(int)> &, double *) const override;
    void act(const double *) override;
    double mass(int k) const override { return bodies[k].mass; }
    const double *center(int k) const override { return bodies[k].x; }
    double least_moment(int k) const override;
    void accelerate(const double *,
                    const std::function<void(int, const double *)> &) const override;

    // Motion at the end of the last step in restart files: the name of each body and six numbers for its velocity
    static constexpr int NRESTART = 7;
    void pack_restart(std::vector<double> &) const;
    void restart(const double *, int n);

   private:
    const int groupbit;
    const std::string owner, id;
    bool by_molecule = false, lagging = false, begun = false;
    std::unordered_map<tagint, int> number;    // index of a body, by molecule
    std::vector<tagint> names;
    std::vector<Body> bodies;
    std::unordered_map<tagint, std::vector<double>> known;    // motions from a restart file

    void sum(double **velocity);
    void check(double **velocity) const;
    void find_axes(Body &) const;
    void velocity_of(int i, const double *center, const double *omega, double *v) const;
    void sum_forces(const std::function<const double *(int)> &, double *) const;
    double rest_between(const Body &, const double *v, const double *angular, const double *v_after,
                        const double *angular_after) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
