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

  // The bodies of all boundaries as unknowns of ViscousStage, six rows for each body.  The first processor has all rows, the
  // others have no rows; all processors call all functions

  class RigidStage : public Stage {
   public:
    RigidStage(class LAMMPS *lmp, Engine &engine, Exchange &exchange,
               const BoundaryStage &boundary) :
        Stage(lmp, engine, exchange),
        boundary(boundary)
    {
    }

    void find(bool starts);    // sets the rows, see RigidMotions::append()
    int size() const;          // rows of this processor
    const RigidRows &of() const { return rows; }

    // Call function(i, velocity) for each owned particle of a body; argument: rows of the first processor, else nullptr
    void velocities(const double *, const std::function<void(int, const double *)> &);

    // Return forces and torques on the bodies, on all processors, from force(i) on their particles; valid until the next
    // call
    const double *forces(const std::function<const double *(int)> &force);

    void act(const double *);    // sets the acting velocities to the rows of the first processor

    double memory_usage() const override;

   private:
    const BoundaryStage &boundary;
    RigidRows rows;
    std::vector<double> values;    // rows of all bodies, on all processors

    int count() const { return static_cast<int>(rows.mass.size()); }
    void send(const double *);
    template <class Function> void for_motions(const Function &) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
