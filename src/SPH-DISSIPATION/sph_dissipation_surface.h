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

#ifndef LMP_SPH_DISSIPATION_SURFACE_H
#define LMP_SPH_DISSIPATION_SURFACE_H

#include "sph_dissipation_stages.h"

#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  struct Surface;
  class Cells;

  // a pair of a fluid and a boundary particle inside the support

  struct BoundaryPair {
    int fluid, wall;
    bigint entry;    // of the pairs of the engine
  };

  // Where the surface of the boundary is, seen from each of its particles: from the arrangement of
  // the boundary particles alone, on those sides where there is fluid

  class SurfaceStage : public Stage {
   public:
    SurfaceStage(class LAMMPS *, Engine &, Exchange &);
    ~SurfaceStage() override;

    // when the neighbor list is new: normal, depth and spacing of the owned and ghost atoms with one
    // of these bits, from their volumes; omega is for the boundary to set
    void run(int bits, const std::vector<BoundaryPair> &);

    // the same with vectors toward the fluid that are known, of the owned ones in their order
    void run(int bits, const std::vector<double> &sides);

    double memory_usage() const override;

    Surface *surface;    // of owned and ghost atoms
    bool has_flux;       // of heat: what that needs is found, too

   private:
    int nmax;

    void begin();
    void find(int bits);
    void find_sides(const std::vector<BoundaryPair> &);
    void find_outer_layer(const Cells &, const std::vector<int> &);
    void find_depth(const Cells &, const std::vector<int> &);
    void find_curvature(const Cells &, const std::vector<int> &);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
