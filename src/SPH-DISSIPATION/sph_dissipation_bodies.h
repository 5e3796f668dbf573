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

  // Rigid bodies of particles that another fix moves: place and velocity of each from those of its particles, and the
  // velocity at the end of a step, extrapolated from that of its middle

  class Bodies : public RigidMotions, protected Pointers {
   public:
    struct Body {
      double mass, x[3], v[3], omega[3];    // center of mass; acting velocity, of the forces
      double angular[3], inertia[6];        // angular momentum, about the center: xx yy zz xy xz yz
      double v_end[3], angular_end[3];      // at the end of the last step
      double axis[3][3], moment[3];         // principal ones; 0 without inertia
      double v_middle[3], angular_middle[3];    // in the middle of the last step
      double own[2][3], others[2][3];    // last force and torque of the pair style, of others
      double rest;                       // see rest_of_heat()
      double rotation[3][3];             // of the last step
    };

    Bodies(class LAMMPS *lmp, int groupbit, const std::string &owner, const std::string &id) :
        Pointers(lmp), groupbit(groupbit), owner(owner), id(id)
    {
    }

    // A body is a molecule, or all particles are one; at the start of a run.  lagging: the fix that moves them gives them the
    // angular velocity of the orientation in the middle of the step
    void init(bool by_molecule, bool lagging);

    int size() const override { return static_cast<int>(bodies.size()); }
    const Body &operator[](int k) const { return bodies[k]; }
    int of(int i) const;    // body of an owned particle

    // velocity of a body at the place of an owned particle
    void velocity_at(int i, double *v) const;

    // At the start of a run, with the velocities of the particles; keep: the acting velocity is vest of the particles.
    // Returns whether the bodies move as at the end of the last step.
    bool start(bool keep);
    // after the particles have moved: the acting velocity is that of the middle of the step, with this part of the increment
    // on it that there was since the last step
    void advance(double extrapolation);
    void end_step();    // with the velocities at the end of the step

    // of the pair style, at the end of a step and at the start of a run, on the owned particles
    void note_forces(const ForceSum *);

    // with these: energy of half a step, by which the forces of the pair style work at another velocity than the acting one, of an
    // owned particle of its body
    double rest_of_heat(int i) const;

    void append(bool starts, RigidRows &) const override;
    void velocities(const double *,
                    const std::function<void(int, const double *)> &) const override;
    void add_forces(const std::function<const double *(int)> &, double *) const override;
    void act(const double *) override;

    // motion at the end of the last step in restart files: a number of each body and six for its velocity
    static constexpr int NRESTART = 7;
    void pack_restart(std::vector<double> &) const;
    void restart(const double *, int n);

   private:
    const int groupbit;
    const std::string owner, id;
    bool by_molecule = false, lagging = false, begun = false;
    std::unordered_map<tagint, int> number;    // of molecules
    std::vector<tagint> names;
    std::vector<Body> bodies;
    std::unordered_map<tagint, std::vector<double>> known;    // from a restart file

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
