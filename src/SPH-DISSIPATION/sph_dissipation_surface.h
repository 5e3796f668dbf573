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

#include "math_const.h"
#include "math_extra.h"
#include "sph_dissipation_boundary_pairs.h"
#include "sph_dissipation_cells.h"
#include "sph_dissipation_stages.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Plane of the surface of a boundary at one of its particles, from the arrangement of the particles around it

  struct SurfacePlane {
    // Width and cutoff, in particle spacings, of the Gaussian that finds the outer layer: on lattices, its sums are as
    // accurate as integrals
    static constexpr double WIDTH = 0.7, CUTOFF = 3.0;

    // Largest filled part of space around a particle of the outer layer: 1/2 at the surface, 0.67 to 0.79 in the outer layer
    // of lattices, and at least 0.87 in the next one
    static constexpr double OUTER = 0.85;

    // A sum of vectors has a direction if it is longer than this part of the sum of their lengths: a shorter one is the
    // residual of vectors that cancel each other
    static constexpr double RESIDUAL = 0.1;

    // A body of a single layer has fluid on both sides: vectors at ends and bends of the layer are shorter than this part of
    // the width; vectors of a body of two layers are longer
    static constexpr double THIN = 0.2;

    double filled = 0.0,
           inward[3] = {0.0, 0.0, 0.0};    // filled part of space; vector to its center
    double length = 0.0;                   // of inward
    bool outer = false;                    // the particle is of the outer layer
    bool directed = false;                 // the vector has a direction
    double depth = 0.0;                    // of the particle below the surface

    // Return 1 inside of a sphere, and smoothly 0 at its surface, on which particles of lattices lie
    static double edge(double rsq, double radius)
    {
      constexpr double WITHIN = 0.97;
      const double part = (1.0 - rsq / (radius * radius)) / (1.0 - WITHIN);
      return (part < 1.0) ? part * part * (3.0 - 2.0 * part) : 1.0;
    }

    static double radius(double support, double spacing)
    {
      return std::min(support, CUTOFF * spacing);
    }

    // volume(j): of particle j, 0 if j does not belong to the same boundary.  In the outer layer of a plane wall, the filled
    // part is 1/2 + b g(0)/2 with the distance b between layers and the Gaussian g across the wall: half of the layer more
    // than half of space, as the whole layer counts.  The surface is b/2 away.
    template <class Volume>
    SurfacePlane(const Cells &cells, const double *place, double spacing, double support, int dim,
                 const Volume &volume)
    {
      const double width = WIDTH * spacing, reach = radius(support, spacing);
      const double norm = 1.0 / whole_power(width * sqrt(MathConst::MY_2PI), dim);
      cells.near(place, reach, [&](int j, const double *r, double rsq) {
        const double part = volume(j) * norm * exp(-0.5 * rsq / (width * width)) * edge(rsq, reach);
        filled += part;
        for (int d = 0; d < 3; d++) inward[d] += part * r[d];
      });
      length = MathExtra::len3(inward);
      outer = filled < OUTER;
      directed = length > RESIDUAL * RESIDUAL * width;
      depth = (filled - 0.5) * width * sqrt(MathConst::MY_2PI);
    }
  };

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
    void run(int bits, const std::vector<double> &sides, const std::vector<double> &body);

    double memory_usage() const override { return bytes(surface); }

    std::vector<Surface> surface;    // by owned and ghost atom
    bool conducts = false;           // boundaries conduct heat, which needs flux_volume

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
