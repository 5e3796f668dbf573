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
#include "sph_dissipation_kernel.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class Region;

namespace SPHDissipation {

  // The plane between the fluid and a buffer zone, the space behind it, and a grid of nodes on it.
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

    // Distance of a place from the line along the normal through another one, and along that line, with
    // periodic images
    struct Offset {
      double beside, ahead;
      double distance() const { return std::sqrt(beside * beside + ahead * ahead); }
    };
    Offset offset(const double *from, const double *to) const;

    bool is_at(const double *) const;    // this point, with this normal after it
    bool limited() const { return region; }

    int nnodes() const { return count[0] * count[1]; }
    double node_distance() const { return std::max(step[0], count[1] > 1 ? step[1] : 0.0); }

    // Call function(node, l) for the nodes within the radius of x in both directions of the plane; l[2] =
    // how far x is from the node in each.
    template <class Function> void near(const double *x, double radius, Function &&function) const;

    // The nodes around the place of x on the plane, and their weights, whose sum is 1
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

  // What is measured of the fluid

  struct OpenWave {
    double j;         // rho c u' + p', see sph_dissipation_characteristics.h
    double strain;    // pressure of states
  };

  struct OpenSample {
    double wave;      // J
    double strain;    // part of p
    double p;         // pressure
    double u[3];      // velocity
  };

  // Measures the fluid at the nodes of the plane: linear fits to the fluid within a radius, weighted with
  // the kernel and the volumes; averages over time; the waves that have left.  The same on all
  // processors.

  class OpenSamples : protected Pointers {
   public:
    typedef OpenPlane::Spot Spot;

    OpenSamples(class LAMMPS *, const OpenPlane &);

    void init();
    void set_times(double averaging_time, double memory);    // memory: longest lag, time units

    // Measure at this time: begin(); add() each owned particle of the fluid; finish() with the sums over all
    // processors of the numbers that append() gives.  Until then, what is asked for below is of the step before.
    void begin(double time);
    void add(const double *x, double height, double volume, const OpenSample &, Kernel,
             double radius);
    void append(std::vector<double> &mine) const;
    void finish(double time, const double *all);

    // Interpolate between the nodes; false if there is no fluid.

    bool now(const Spot &, double height, int order, OpenSample &) const;    // order 1: with slope
    bool average(const Spot &, OpenSample &) const;                          // over time
    OpenWave wave(const Spot &, double time) const;                          // at a time before
    double distance(const Spot &) const;    // from the plane to the middle of what is measured

    void mean_at_plane(double *p, double *u) const;    // of all nodes, now
    bool any() const { return !history.empty(); }

    double memory_usage() const;    // bytes

    // state in a restart file
    std::vector<double> pack() const;
    bool unpack(const std::vector<double> &);    // false if it is of other nodes

   private:
    static constexpr int NVALUE = sizeof(OpenSample) / sizeof(double);
    static constexpr int NWAVE = sizeof(OpenWave) / sizeof(double);    // the first values

    // weighted sums of a node over the fluid; l = place along the plane from there, d = height

    struct Sums {
      double weight, l[2], ll[3], d, dd;    // ll: l0 l0, l1 l1, l0 l1
      double value[NVALUE], value_l[NVALUE][2], value_d[NVALUE];
    };

    struct Node {
      double weight, distance;    // of what is measured from the plane
      double value[NVALUE];       // at the node and that distance
      double slope[NVALUE];       // along the normal
      double mean[NVALUE];        // over time
      double known;               // > 0: there has been fluid
    };

    struct Past {
      double time;
      std::vector<double> wave;    // of the nodes, NWAVE each
    };

    const OpenPlane &plane;
    double averaging_time, memory;
    std::vector<Sums> my_sums, sums;
    std::vector<Node> nodes, before;    // before: without the last time
    std::deque<Past> history;           // the oldest first

    void fit(const Sums &, Node &) const;
    template <class Function>
    bool interpolate(const Spot &, int nvalue, double *value, Function &&of_node) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
