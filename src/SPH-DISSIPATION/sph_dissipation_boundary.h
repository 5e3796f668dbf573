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

  // Rigid bodies as unknowns of the large viscosities: six rows each, velocity and, along the principal axes, angular
  // velocity; forces and torques have the same rows.  All processors have those of all bodies

  struct RigidRows {
    std::vector<double> mass, before, guess, others;    // as those of ViscousStage
  };

  class RigidMotions {
   public:
    static constexpr int WIDTH = 6;
    virtual int size() const = 0;    // bodies

    // starts: at the start of a run, with the velocities of the time of the positions
    virtual void append(bool starts, RigidRows &) const = 0;

    // function(i, velocity) for each of the owned particles
    virtual void velocities(const double *rows,
                            const std::function<void(int, const double *)> &) const = 0;

    // of force(i) on the owned particles
    virtual void add_forces(const std::function<const double *(int)> &, double *rows) const = 0;

    virtual void act(const double *rows) = 0;    // these are the velocities that forces depend on

   protected:
    ~RigidMotions() = default;
  };

  // Interface of a fix whose particles are not fluid, but represent what lies beyond its edge: what
  // the fix does between the two passes of the pair style.  The fix hands itself to
  // BoundaryStage::add() in its init() and takes itself back when it is deleted.

  class Boundary {
   public:
    virtual int boundary_bit() const = 0;    // bit of the group of its particles

    // set Surface::omega of its owned and ghost particles; turn their normals by the motion of the
    // last step if they date from before it

    virtual void move_surface(BoundaryStage &, Surface *, bool before) = 0;

    // set the values of its owned particles in the pair forces, from the sums over the fluid around
    // them: BoundaryStage::set_state() or extend_fluid() and, if there are spins, spin()

    virtual void set_boundary(BoundaryStage &, const Surface *, const BoundarySum *) = 0;

    // The friction of the fluid with its particles is symmetric, that of the velocity of its rigid body with
    // surface_factor(), instead of that of values that set_boundary() sets

    virtual bool has_symmetric_friction() const { return false; }

    // Bodies that the fluid moves: numbers of those of its owned particles, from first on, into body[]; returns the next
    // number.  Where the surface is follows from the particles of a body alone.  Their pressure is that of frozen fluid,
    // BoundaryStage::set_frozen(), whose energy is that of the equation of state

    virtual bool has_bodies() const { return false; }
    virtual int number_bodies(int first, double * /*body*/) { return first; }
    virtual RigidMotions *rigid_motions() { return nullptr; }

    // The pressure of its particles is that of the fluid around them, bulk viscosity included: friction is not symmetric
    virtual bool has_mean_pressure() const { return true; }

    // set the values of its particles in the conduction of heat: BoundaryStage::set_heat(); the
    // same for increments of the temperatures, which are zero at the surface; whether heat passes
    // the surface

    virtual bool gives_heat() const { return false; }
    virtual void set_heat(BoundaryStage &, const Surface *, bool /*increments*/) {}

   protected:
    ~Boundary() = default;    // nobody deletes a fix through this
  };

  // A buffer zone, as a fix provides it between the two passes: its particles are fluid with a prescribed
  // state, as it enters or leaves.  The fix hands itself to OpenStage::add() in its init() and takes itself
  // back when it is deleted.

  class OpenZone {
   public:
    virtual int zone_bit() const = 0;     // bit of the group of its particles
    virtual int fluid_bit() const = 0;    // bit of the group of the fluid that ends there
    // whether a particle at x may have pairs across the border of zone and fluid, of this length
    virtual bool zone_near(const double *x, double reach) const = 0;

    // Append numbers of this processor, equally many on each; set_states() gets their sums over all
    // processors, in one message for all zones
    virtual void measure(const OpenStage &, std::vector<double> &mine) = 0;

    // set density and pressure of its owned particles by OpenStage::set_state()
    virtual void set_states(OpenStage &, const double *sums) = 0;

    // sums of this processor, for each force computation
    virtual void set_impact(const OpenImpact &) = 0;

   protected:
    ~OpenZone() = default;    // nobody deletes a fix through this
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
