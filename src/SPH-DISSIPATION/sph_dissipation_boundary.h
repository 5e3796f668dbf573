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

  class Engine;

  // What the fluid around a boundary particle w adds up to, weighted with the kernel: sums over fluid
  // particles f of V_f W(r_wf) times the quantity, S. Adami et al., J. Comput. Phys. 231, 7057 (2012)
  // of a fluid particle: weight is the part of its support that boundary particles fill, filled that
  // of a support of a few particle spacings, or of its own if that is smaller

  struct BoundarySum {
    double weight;       // 1
    double u[3];         // velocity
    double r[3];         // x_w - x_f
    double rho;          // density
    double pressure;     // p + zeta V cdot (bulk density), p (otherwise)
    double zeta_term;    // zeta V cdot
    double filled;       // fluid particles only
    double w[3];         // spin (micropolar)
  };

  // What a fix does between the two passes of the pair style whose particles are not fluid, but
  // stand for what lies beyond the edge of the fluid.  The fix hands itself to
  // PairSPHBulk::add_boundary() in its init() and takes itself back when it is deleted.

  class Boundary {
   public:
    virtual int boundary_bit() const = 0;           // bit of the group of its particles
    virtual bool boundary_vorticity() const = 0;    // spins depend on the vorticity of the fluid

    // set what its owned particles bring into the pair forces, from the sums over the fluid around
    // them: u, vol and g of Engine::particle, Engine::zeta_term and, if there are spins, Engine::spin

    virtual void set_boundary(Engine &, const BoundarySum *) = 0;

    // set Engine::spin, with the vorticity of the fluid summed up like the rest, weighted with the
    // kernel; only if boundary_vorticity()

    virtual void set_boundary_spin(Engine &, const BoundarySum *, double **vorticity) = 0;

   protected:
    ~Boundary() = default;    // nobody deletes a fix through this
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
