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

#ifndef LMP_SPH_DISSIPATION_CONTACT_H
#define LMP_SPH_DISSIPATION_CONTACT_H

#include "sph_dissipation_boundary.h"
#include "sph_dissipation_stages.h"
#include "sph_dissipation_steps.h"
#include "sph_dissipation_wall_terms.h"

#include <cstddef>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  class BoundaryStage;
  class Cells;

  // Forces between bodies that touch each other or a wall.  The particles of the outer layer are balls; the surface of
  // another body is a mean of tangential planes.  The force on a ball below this surface acts at one point on both bodies;
  // the energy of the force depends on the places of the bodies alone.

  class ContactStage : public Stage {
   public:
    ContactStage(class LAMMPS *lmp, Engine &engine, Exchange &exchange, BoundaryStage &boundary,
                 const std::string &style) :
        Stage(lmp, engine, exchange),
        boundary(boundary), style(style), step(UNLIMITED_STEP)
    {
    }

    // After the forces: add the contact forces to the forces of LAMMPS, and the work that bodies lose to the heating
    void run();

    double energy(double *each_atom) const;    // of this processor; each_atom may be nullptr
    double largest_step() const { return step; }

    // Get force and torque, about the origin, of the bodies on a wall in the last step
    void force_on(const Boundary *, double *force) const;

    double memory_usage() const override;

   private:
    // A ball of one body or wall, and the particles near the ball of another body or wall

    struct Pair {
      int particle;         // the ball
      int body, other;      // numbers of the bodies, 0: walls
      int first, number;    // place in near, and number, of the particles of the other body
      ContactLaw law;
      double stiffness;    // force over the overlap

      // in this step

      double point[3], normal[3];    // contact point; normal outward of the other body
      double overlap;
      double slope;    // of the distance from the other body, 1 at a plane
      double u[3];     // velocity of the point relative to the other body
      int partner;     // nearest particle of the other body
    };

    // A body that the fluid moves

    struct Body {
      RigidMotions *motions;    // with this body
      int place;                // in motions
      const Boundary *owner;
      double stiffness;    // pressure over the depth of an overlap
      double
          mobility;    // largest acceleration of a point of the surface by a force of 1 on this point
      double slow;     // speed below which a contact counts as at rest
      double force;    // sum of the magnitudes of elastic forces on the body, in this step
    };

    BoundaryStage &boundary;
    const std::string style;
    std::vector<Body> bodies;        // by their number less 1
    std::vector<Surface> surface;    // by owned and ghost atom; spacing 0: not of the outer layer
    std::vector<double>
        shift;    // vector from the wrapped to the unwrapped position of each particle
    std::vector<Pair> pairs;
    std::vector<int> near;
    std::vector<double> on_walls;    // force and torque on each boundary, sum over processors
    bool active = false;             // any processor has pairs
    bigint surface_step = -1;
    double step, total_energy = 0.0;    // step: UNLIMITED_STEP before the first begin()
    bool warned = false;

    bool law_of(int body, int other, ContactLaw &) const;
    double volume(int i) const;
    double spacing(int i) const;
    double reach(double spacing) const;
    static double share(int body, double spacing, int other, double spacing_of_other);
    bool is_ball(int i) const;
    void begin();    // when a run begins: finds the bodies and the largest stable time step
    void find();
    void find_bodies();
    void find_surfaces(const Cells &, const std::vector<int> &);
    void find_overlaps();
    void find_overlap(Pair &) const;
    void velocity_at(const double *point, int i, double *u) const;
    void sum_elastic();
    void add_forces();
    void warn();
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
