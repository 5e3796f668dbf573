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

  // What a fix does between the two passes of the pair style whose particles are not fluid, but
  // stand for what lies beyond the edge of the fluid.  The fix hands itself to
  // PairSPHBulk::add_boundary() in its init().

  class Boundary {
   public:
    virtual int boundary_bit() const = 0;           // bit of the group of its particles
    virtual bool boundary_vorticity() const = 0;    // spins depend on the vorticity of the fluid

    // set what its owned particles bring into the pair forces, from Engine::boundary_sum: u, vol
    // and g of Engine::particle, Engine::zeta_term and, if there are spins, Engine::spin

    virtual void set_boundary(Engine &) = 0;

    // set Engine::spin from the vorticity of the fluid, summed in Engine::vorticity; only if
    // boundary_vorticity()

    virtual void set_boundary_spin(Engine &) = 0;

   protected:
    ~Boundary() = default;    // nobody deletes a fix through this
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
