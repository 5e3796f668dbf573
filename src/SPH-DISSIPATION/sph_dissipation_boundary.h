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

#ifndef LMP_SPH_DISSIPATION_BOUNDARY_H
#define LMP_SPH_DISSIPATION_BOUNDARY_H

#include <functional>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  class BoundaryStage;
  class OpenStage;
  struct BoundarySum;
  struct OpenImpact;
  struct Surface;

  // Rigid bodies as unknowns of ViscousStage.  A body has six numbers: velocity, and angular velocity along the principal
  // axes; or force, and torque along these axes.  All processors have these rows of all bodies.

  struct RigidRows {
    std::vector<double> mass, before, guess, others;    // see ViscousStage
  };

  class RigidMotions {
   public:
    static constexpr int WIDTH = 6;
    virtual int size() const = 0;    // number of bodies

    // Append the rows of the bodies; starts: at the start of a run, velocities belong to the time of the positions
    virtual void append(bool starts, RigidRows &) const = 0;

    // Call function(i, velocity) for each owned particle of the bodies
    virtual void velocities(const double *rows,
                            const std::function<void(int, const double *)> &) const = 0;

    // Add force(i) on the owned particles to the rows of forces and torques of the bodies
    virtual void add_forces(const std::function<const double *(int)> &, double *rows) const = 0;

    virtual void act(const double *rows) = 0;    // set the velocities on which the forces depend

    // Body k: mass, center of mass, and least principal moment of inertia > 0 (0 if there is none)
    virtual double mass(int k) const = 0;
    virtual const double *center(int k) const = 0;
    virtual double least_moment(int k) const = 0;

    // Call function(i, acceleration) for each owned particle; forces: force and torque, along x, y, z, on each body
    virtual void accelerate(const double *forces,
                            const std::function<void(int, const double *)> &) const = 0;

   protected:
    ~RigidMotions() = default;
  };

  // Dry contact of a body with another body or with a wall: coefficients of restitution and of friction

  struct ContactLaw {
    double restitution = 1.0, friction = 0.0;
  };

  // Interface of a fix whose particles are a wall or a body at the edge of the fluid, for the work between the two passes of
  // the pair style.  The fix calls BoundaryStage::add() in its init() and remove() when it is deleted.

  class Boundary {
   public:
    virtual int boundary_bit() const = 0;    // bit of the group of its particles

    // Set Surface::omega of owned and ghost particles of the fix.  before: the normals are older than the last step: turn the
    // normals by the motion of that step

    virtual void move_surface(BoundaryStage &, Surface *, bool before) = 0;

    // Set the values of owned particles of the fix in the pair forces, from the sums over the fluid around them, by
    // BoundaryStage::rest_at_surface() or extend_fluid() and, if there are spins, spin()

    virtual void set_boundary(BoundaryStage &, const Surface *, const BoundarySum *) = 0;

    // Return true if the friction is symmetric: friction with the velocity of the rigid body, times surface_factor(), instead
    // of friction with the values of set_boundary()

    virtual bool has_symmetric_friction() const { return false; }

    // Set body[i] of owned particles in bodies that the fluid moves to the number of the body, from first on; return the next
    // number.  The surface of a body depends on its own particles alone.  Particles of bodies have the pressure of frozen
    // fluid, with the energy of the equation of state, see BoundaryStage::set_frozen()

    virtual bool has_bodies() const { return false; }
    virtual bool has_elastic_bodies() const
    {
      return false;
    }    // each particle has its own velocity
    virtual int number_bodies(int first, double * /*body*/) { return first; }
    virtual RigidMotions *rigid_motions() { return nullptr; }
    virtual const ContactLaw *contact() const { return nullptr; }    // of the bodies; nullptr: none

    // Return true if the boundary has the mean pressure of the fluid, bulk term included: then friction is not symmetric
    virtual bool has_mean_pressure() const { return true; }

    // gives_heat(): return whether heat passes the surface.  set_heat(): set the values of particles in heat conduction, by
    // BoundaryStage::set_heat(); increments: for increments of the temperatures, which are zero at the surface

    virtual bool gives_heat() const { return false; }
    virtual void set_heat(BoundaryStage &, const Surface *, bool /*increments*/) {}

   protected:
    ~Boundary() = default;    // no code deletes a fix through this class
  };

  // Interface of a fix with a buffer zone: its particles have a prescribed state, and enter the fluid or have left it.  The
  // fix calls OpenStage::add() in its init() and remove() when it is deleted.

  class OpenZone {
   public:
    virtual int zone_bit() const = 0;     // bit of the group of its particles
    virtual int fluid_bit() const = 0;    // bit of the group of the fluid that ends at the zone
    // Return whether a particle at x may have pairs across the border of zone and fluid, if pairs are as long as reach
    virtual bool zone_near(const double *x, double reach) const = 0;

    // Return the owned particles of the zone, and those of the fluids of all zones that may have pairs across the border of
    // this zone until the next neighbor list
    virtual const std::vector<int> &zone_particles() const = 0;

    virtual bool zone_varies() const = 0;    // return whether variables prescribe values

    // Append numbers of this processor, as many on each processor; set_states() gets the sums over all processors.  One
    // message has the numbers of all zones
    virtual void measure(const OpenStage &, std::vector<double> &mine) = 0;

    // Set density and pressure of the zone's owned particles by OpenStage::set_state()
    virtual void set_states(OpenStage &, const double *sums) = 0;

    // Take the force, work and heat of the zone on the fluid, of this processor, in each force computation
    virtual void set_impact(const OpenImpact &) = 0;

   protected:
    ~OpenZone() = default;    // no code deletes a fix through this class
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
