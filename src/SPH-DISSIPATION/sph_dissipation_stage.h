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

#ifndef LMP_SPH_DISSIPATION_STAGE_H
#define LMP_SPH_DISSIPATION_STAGE_H

#include "pointers.h"

namespace LAMMPS_NS {
class NeighList;

namespace SPHDissipation {

  class Engine;
  class Exchange;

  // A stage of the force computation: sums of its own over the pairs that pass 1 of the engine has
  // found, and what it sends to ghost atoms or gets back from them.  Fluid::compute() lists the stages
  // in their order.

  class Stage : protected Pointers {
   public:
    Stage(class LAMMPS *lmp, Engine &engine, Exchange &exchange) :
        Pointers(lmp), engine(engine), exchange(exchange)
    {
    }
    ~Stage() override = default;

    virtual double memory_usage() const { return 0.0; }    // bytes

   protected:
    Engine &engine;
    Exchange &exchange;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
