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

#ifndef LMP_SPH_DISSIPATION_RIGID_H
#define LMP_SPH_DISSIPATION_RIGID_H

#include "sph_dissipation_boundary.h"
#include "sph_dissipation_stages.h"

#include <functional>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  class BoundaryStage;

  // The bodies of all boundaries as unknowns of ViscousStage.  Their rows are those of the first processor, the others have
  // none; all processors call all functions

  class RigidStage : public Stage {
   public:
    RigidStage(class LAMMPS *lmp, Engine &engine, Exchange &exchange,
               const BoundaryStage &boundary) :
        Stage(lmp, engine, exchange),
        boundary(boundary)
    {
    }

    void find(bool starts);    // of this moment, see RigidMotions::append()
    int size() const;          // rows of this processor
    const RigidRows &of() const { return rows; }

    // function(i, velocity) for each owned particle of a body, from the rows of the first processor (nullptr on others)
    void velocities(const double *, const std::function<void(int, const double *)> &);

    // forces and torques on the bodies, on all processors, from force(i) on their particles; in a vector of this object
    const double *forces(const std::function<const double *(int)> &force);

    void act(const double *);    // the acting velocities are these, of the first processor

    double memory_usage() const override;

   private:
    const BoundaryStage &boundary;
    RigidRows rows;
    std::vector<double> values;    // of all bodies

    int count() const { return static_cast<int>(rows.mass.size()); }
    void send(const double *);
    template <class Function> void for_motions(const Function &) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
