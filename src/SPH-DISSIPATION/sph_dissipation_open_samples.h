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
#include "sph_dissipation_open_plane.h"

#include <deque>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // What the fluid does at the plane of an open zone, at the nodes on it: sums over the fluid within a
  // radius, weighted with the kernel and the volumes; the waves that have left through it; averages
  // over time.  The same on all processors.

  // weighted sum of a node; d = distance of a fluid particle from the plane, u = its velocity

  struct NodeSum {
    double weight;         // 1
    double d, d2;          // d, d^2
    double wave;           // J = rho c u' + p', see sph_dissipation_characteristics.h
    double p, pd;          // pressure, times d
    double u[3], ud[3];    // velocity, times d
  };

  // a quantity at a height over the plane, < 0 in the zone, from its sums; order 1: with its slope, as
  // far as that is known

  double continued(const NodeSum &, double sum, double sum_d, double height, int order);

  class OpenSamples : protected Pointers {
   public:
    OpenSamples(class LAMMPS *, const OpenPlane &);

    void init(double averaging_time, double memory);    // memory: longest lag, time units

    // sums of this step: begin(); add() for each owned particle of the fluid; finish()
    void begin();
    NodeSum &sum(int node) { return sums[node]; }
    void finish(double time);

    // at the place of a zone particle on the plane

    NodeSum at(const double *x) const;                            // sums of now
    double wave(const double *x, double time) const;              // J at a time before
    struct Average {
      double u[3], p, wave;
    };
    bool average(const double *x, Average &) const;    // over time; false: no fluid here
    void mean_at_plane(double *p, double *u) const;               // of all nodes, now
    bool any() const { return !history.empty(); }

    double memory_usage() const;    // bytes

    // state in a restart file
    std::vector<double> pack() const;
    bool unpack(const double *, int n);    // false if it is of other nodes

   private:
    struct Past {
      double time;
      std::vector<double> wave;    // of the nodes
    };
    static constexpr int NMEAN = sizeof(Average) / sizeof(double);

    const OpenPlane &plane;
    double averaging_time, memory;
    std::vector<NodeSum> sums, my_sums;
    std::vector<double> mean;    // NMEAN of each node
    std::deque<Past> history;    // the oldest first

    void update_means(double elapsed);
    double node_wave(int node, double time) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
