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

#include "sph_dissipation_boundary_pairs.h"
#include "sph_dissipation_stages.h"

#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  class Cells;

  // Finds the surface of the boundary near each of its particles, from the arrangement of the boundary particles alone, on
  // the sides with fluid

  class SurfaceStage : public Stage {
   public:
    using Stage::Stage;

    // When the neighbor list is new: find normal, depth and spacing of the owned and ghost atoms with one of these bits,
    // from their volumes; Boundary::move_surface() sets omega.  body: number of the body of each atom, 0 for walls; empty
    // without bodies.  The particles of a body alone define its surface.
    void run(int bits, const BoundaryPairs &, const std::vector<double> &body);

    // Do the same with known vectors toward the fluid, three numbers for each owned particle with one of these bits, in
    // order.
    void run(int bits, const std::vector<double> &sides);

    double memory_usage() const override { return bytes(surface); }

    std::vector<Surface> surface;    // by owned and ghost atom
    bool has_flux = false;           // walls have a flux of heat, which needs curvatures

   private:
    const double *body = nullptr;

    bool together(int i, int j) const { return !body || body[i] == body[j]; }
    template <class Task> void for_each(const std::vector<int> &, const Task &);
    void begin();
    void find(int bits);
    void find_sides(const BoundaryPairs &);
    void find_outer_layer(const Cells &, const std::vector<int> &);
    void find_depth(const Cells &, const std::vector<int> &);
    void find_curvature(const Cells &, const std::vector<int> &);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
