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

namespace LAMMPS_NS {
namespace SPHDissipation {

  class BoundaryStage;

  // Where the surface is, seen from a boundary particle w

  struct Surface {
    double normal[3];    // toward the fluid; zero: unknown
    double depth;        // distance of w from the surface
    double spacing;      // of the particles
    double omega[3];     // angular velocity of the rigid body that w belongs to
  };

  // What the fluid around a boundary particle w adds up to, weighted with the kernel: sums over fluid
  // particles f of V_f W(r_wf) times the quantity, S. Adami et al., J. Comput. Phys. 231, 7057 (2012)
  // of a fluid particle: filled is the part of a support of a few particle spacings, or of its own if
  // that is smaller, that boundary particles fill
  // relative: to the velocity that the rigid body of w has at f; d: distance of f from the surface

  struct BoundarySum {
    double weight;        // 1
    double r[3];          // x_w - x_f
    double rho;           // density
    double pressure;      // p + zeta cdot/c (bulk density), p (otherwise)
    double zeta_term;     // zeta cdot/c
    double filled;        // fluid particles only
    double occupied;      // the same of a smaller support, with thermal noise; fluid particles only
    double d, d3;         // d, d^3
    double d4, d5, d6;    // d^4, d^5, d^6
    double u[3];          // relative velocity
    double ud3[3];        // relative velocity times d^3
    double ud4[3];        // relative velocity times d^4
    double wd3[3];        // relative spin times d^3 (micropolar)
    double wd4[3];        // relative spin times d^4 (micropolar)
  };

  // What a fix does between the two passes of the pair style whose particles are not fluid, but
  // stand for what lies beyond the edge of the fluid.  The fix hands itself to BoundaryStage::add() in
  // its init() and takes itself back when it is deleted.

  class Boundary {
   public:
    virtual int boundary_bit() const = 0;    // bit of the group of its particles

    // set Surface::omega of its owned and ghost particles; turn their normals by the motion of the
    // last step if they date from before it

    virtual void move_surface(Surface *, bool before) = 0;

    // set what its owned particles bring into the pair forces, from the sums over the fluid around
    // them: BoundaryStage::set_state() or extend_fluid() and, if there are spins, spin()

    virtual void set_boundary(BoundaryStage &, const Surface *, const BoundarySum *) = 0;

   protected:
    ~Boundary() = default;    // nobody deletes a fix through this
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
