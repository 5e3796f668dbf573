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

#include <string>
#include <unordered_map>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Rigid bodies of particles that another fix moves: place and velocity of each from those of its particles, and the
  // velocity at the end of a step, extrapolated from that of its middle

  class Bodies : protected Pointers {
   public:
    struct Body {
      double mass, x[3], v[3], omega[3];    // center of mass; acting velocity, of the forces
      double angular[3], inertia[6];        // angular momentum, about the center: xx yy zz xy xz yz
      double v_end[3], angular_end[3];      // at the end of the last step
      double rotation[3][3];                // of the last step
    };

    Bodies(class LAMMPS *lmp, int groupbit, const std::string &owner, const std::string &id) :
        Pointers(lmp), groupbit(groupbit), owner(owner), id(id)
    {
    }

    // a body is a molecule, or all particles are one; at the start of a run
    void init(bool by_molecule);

    int size() const { return static_cast<int>(bodies.size()); }
    const Body &operator[](int k) const { return bodies[k]; }
    int of(int i) const;    // body of an owned particle

    // velocity of a body at the place of an owned particle
    void velocity_at(int i, double *v) const;

    // At the start of a run, with the velocities of the particles; keep: the acting velocity is vest of the particles.
    // Returns whether the bodies move as at the end of the last step.
    bool start(bool keep);
    // after the particles have moved: the acting velocity is that of the middle of the step, or extrapolated to its end
    void advance(bool extrapolate);
    void end_step();    // with the velocities at the end of the step

    // motion at the end of the last step in restart files: a number of each body and six for its velocity
    static constexpr int NRESTART = 7;
    void pack_restart(std::vector<double> &) const;
    void restart(const double *, int n);

   private:
    const int groupbit;
    const std::string owner, id;
    bool by_molecule = false, begun = false;
    std::unordered_map<tagint, int> number;    // of molecules
    std::vector<tagint> names;
    std::vector<Body> bodies;
    std::unordered_map<tagint, std::vector<double>> known;    // from a restart file

    void sum(double **velocity);
    void check(double **velocity) const;
    void set_acting(Body &, const double *v, const double *angular) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
