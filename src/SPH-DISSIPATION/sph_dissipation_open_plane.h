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

#ifndef LMP_SPH_DISSIPATION_OPEN_PLANE_H
#define LMP_SPH_DISSIPATION_OPEN_PLANE_H

#include "pointers.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace LAMMPS_NS {
class Region;

namespace SPHDissipation {

  // Where the fluid ends in an open zone: a plane, the space behind it, and a grid of nodes on it.
  // Periodic directions lie in the plane, or the zone has a region.

  class OpenPlane : protected Pointers {
   public:
    OpenPlane(class LAMMPS *, const std::string &owner);    // owner: for messages

    void set(char **arg);    // x y z nx ny nz length
    void set_region(const char *id) { region_id = id; }
    const std::string &region_name() const { return region_id; }
    void init();                             // region and directions, which must fit the box
    void set_nodes(double node_distance);    // grid of nodes, as far as box and region reach

    // distance of a place from the plane, > 0 in the fluid
    double height(const double *x) const
    {
      return (x[0] - point[0]) * normal[0] + (x[1] - point[1]) * normal[1] +
          (x[2] - point[2]) * normal[2];
    }
    bool beside(const double *x) const;                  // beyond the sides of the zone
    bool beside(const double *x, double slack) const;    // ... and no place so near is within them

    // how far a place is, with periodic images, beside the line along the normal through another one,
    // and how far ahead
    struct Offset {
      double beside, ahead;
      double distance() const { return std::sqrt(beside * beside + ahead * ahead); }
    };
    Offset offset(const double *from, const double *to) const;

    bool is_at(const double *) const;    // this point, with this normal after it
    bool limited() const { return region; }

    int nnodes() const { return count[0] * count[1]; }
    double node_distance() const { return std::max(step[0], count[1] > 1 ? step[1] : 0.0); }

    // function(node, place of x along the plane from there, 2 values) for the nodes within the radius
    // of x in both of them
    template <class Function> void near(const double *x, double radius, Function &&function) const;

    // the nodes around the place of x on the plane and their weights, whose sum is 1
    struct Spot {
      int n;
      int node[4];
      double weight[4];
    };
    Spot spot(const double *x) const;

    double point[3], normal[3], length;

   private:
    const std::string owner;
    std::string region_id;
    Region *region;
    double tangent[2][3];    // of the plane; in 2d only the first one counts
    double lo[2], step[2];
    int count[2];
    bool periodic[2];

    void check_box() const;
    void set_tangents();
    double along(int k, const double *x) const;
    int wrap(int k, int n) const;
  };

  template <class Function>
  void OpenPlane::near(const double *x, double radius, Function &&function) const
  {
    double at[2];
    int from[2], to[2];
    for (int k = 0; k < 2; k++) {
      at[k] = along(k, x);
      from[k] = static_cast<int>(std::ceil((at[k] - radius) / step[k]));
      to[k] = static_cast<int>(std::floor((at[k] + radius) / step[k]));
      if (count[k] == 1) from[k] = to[k] = 0, at[k] = 0.0;
      if (!periodic[k]) {
        from[k] = std::max(from[k], 0);
        to[k] = std::min(to[k], count[k] - 1);
      }
    }
    for (int m = from[1]; m <= to[1]; m++)
      for (int n = from[0]; n <= to[0]; n++) {
        const double r[2] = {at[0] - n * step[0], at[1] - m * step[1]};
        function(wrap(1, m) * count[0] + wrap(0, n), r);
      }
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
