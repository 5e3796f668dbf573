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

#ifndef LMP_SPH_DISSIPATION_OPEN_SAMPLES_H
#define LMP_SPH_DISSIPATION_OPEN_SAMPLES_H

#include "pointers.h"
#include "sph_dissipation_kernel.h"
#include "sph_dissipation_open_plane.h"

#include <deque>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // what is measured of the fluid

  struct OpenSample {
    double wave;    // J = rho c u' + p', see sph_dissipation_characteristics.h
    double p;       // pressure
    double u[3];    // velocity
  };

  // What the fluid does at the plane of an open zone, at the nodes on it: linear fits to the fluid
  // within a radius, weighted with the kernel and the volumes; the waves that have left through it;
  // averages over time.  The same on all processors.

  class OpenSamples : protected Pointers {
   public:
    typedef OpenPlane::Spot Spot;

    OpenSamples(class LAMMPS *, const OpenPlane &);

    void init();
    void set_times(double averaging_time, double memory);    // memory: longest lag, time units

    // this time: begin(); add() for each owned particle of the fluid; finish(), until which
    // what is asked for below is that of the step before
    void begin(double time);
    void add(const double *x, double height, double volume, const OpenSample &, Kernel,
             double radius);
    void finish(double time);

    // at a place, behind the plane or not; false: no fluid there

    bool now(const Spot &, double height, int order, OpenSample &) const;    // order 1: with slope
    bool average(const Spot &, OpenSample &) const;                          // over time
    double wave(const Spot &, double time) const;                            // J at a time before
    double distance(const Spot &) const;    // mean distance of what is measured from the plane

    void mean_at_plane(double *p, double *u) const;    // of all nodes, now
    bool any() const { return !history.empty(); }

    double memory_usage() const;    // bytes

    // state in a restart file
    std::vector<double> pack() const;
    bool unpack(const std::vector<double> &);    // false if it is of other nodes

   private:
    static constexpr int NVALUE = sizeof(OpenSample) / sizeof(double);

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
      std::vector<double> wave;    // of the nodes
    };

    const OpenPlane &plane;
    double averaging_time, memory;
    std::vector<Sums> my_sums, sums;
    std::vector<Node> nodes, before;    // before: without the last time
    std::deque<Past> history;           // the oldest first

    void fit(const Sums &, Node &) const;
    template <class Function> double interpolate(const Spot &, Function &&function) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
