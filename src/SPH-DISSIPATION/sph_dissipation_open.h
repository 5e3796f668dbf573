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

#ifndef LMP_SPH_DISSIPATION_OPEN_H
#define LMP_SPH_DISSIPATION_OPEN_H

#include "pointers.h"
#include "sph_dissipation_kernel.h"
#include "sph_dissipation_value.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class Region;

namespace SPHDissipation {

  class Fields;
  class FluidModel;
  class Keywords;
  struct EosParams;
  struct Particle;

  // The plane between the fluid and a buffer zone, the space behind the plane, and a grid of nodes on the plane.
  // Periodic directions of the box lie in the plane, or the zone has a region.

  class OpenPlane : protected Pointers {
   public:
    // owner: for messages
    OpenPlane(class LAMMPS *lmp, const std::string &owner) : Pointers(lmp), owner(owner) {}

    void set(char **arg);    // x y z nx ny nz length
    void set_region(const char *id) { region_id = id; }
    const std::string &region_name() const { return region_id; }
    void init();                             // sets region and directions, which must fit the box
    void set_nodes(double node_distance);    // sets nodes on all of the plane in box and region

    // distance of a place from the plane, > 0 in the fluid
    double height(const double *x) const
    {
      return (x[0] - point[0]) * normal[0] + (x[1] - point[1]) * normal[1] +
          (x[2] - point[2]) * normal[2];
    }
    bool beside(const double *x) const;                  // beyond the sides of the zone
    bool beside(const double *x, double slack) const;    // ... by more than slack

    // Vector between two places, with periodic images: distance from the normal through the first place, and along the normal
    struct Offset {
      double beside, ahead;
      double distance() const { return std::sqrt(beside * beside + ahead * ahead); }
    };
    Offset offset(const double *from, const double *to) const;

    bool is_at(const double *) const;    // true: point and normal are these six numbers
    bool limited() const { return region; }

    int nnodes() const { return count[0] * count[1]; }
    double node_distance() const { return std::max(step[0], count[1] > 1 ? step[1] : 0.0); }

    // Call function(node, l) for the nodes within the radius of x in both directions of the plane; l[2] = distance of x from
    // the node along each direction.
    template <class Function> void near(const double *x, double radius, Function &&function) const;

    // The nodes around the projection of x on the plane, and the weights of the nodes, with the sum 1
    struct Spot {
      int n;
      int node[4];
      double weight[4];
    };
    Spot spot(const double *x) const;

    double point[3] = {}, normal[3] = {1.0, 0.0, 0.0}, length = 0.0;

   private:
    const std::string owner;
    std::string region_id;
    Region *region = nullptr;
    double tangent[2][3] = {};    // directions of the plane; 2d: only the first direction counts
    double lo[2] = {}, step[2] = {1.0, 1.0};
    int count[2] = {1, 1};
    bool periodic[2] = {};

    void check_box() const;
    void set_tangents();
    double along(int k,
                 const double *x) const;    // coordinate along direction k
    int wrap(int k, int n) const;           // index of a node in the periodic or finite grid
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

  // Measured quantities of the fluid

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

  // Measures the fluid at the nodes of the plane: linear fits to the fluid within a radius, weighted with the kernel and
  // the volumes; averages over time; the waves that have left the fluid.  All processors have the same results.

  class OpenSamples : protected Pointers {
   public:
    typedef OpenPlane::Spot Spot;

    OpenSamples(class LAMMPS *lmp, const OpenPlane &plane) : Pointers(lmp), plane(plane) {}

    void init();
    void set_times(double averaging_time, double memory);    // memory: longest lag, time units

    // To measure at a time, call begin(); add() for each owned particle of the fluid; finish() with the sums over all
    // processors of the numbers of append().  Before finish(), the functions below return results of the step before.
    void begin(double time);
    void add(const double *x, double height, double volume, const OpenSample &, Kernel,
             double radius);
    void append(std::vector<double> &mine) const;
    void finish(double time, const double *all);

    // Interpolate between the nodes; return false if there is no fluid.

    bool now(const Spot &, double height, int order, OpenSample &) const;    // order 1: with slope
    bool average(const Spot &, OpenSample &) const;                          // mean over time
    OpenWave wave(const Spot &, double time) const;                          // at a past time
    double distance(const Spot &) const;    // from the plane to the middle of the measured fluid

    void mean_at_plane(double *p, double *u) const;    // mean over all nodes, now
    bool any() const { return !history.empty(); }

    double memory_usage() const;    // bytes

    // State in a restart file
    std::vector<double> pack() const;
    bool unpack(const std::vector<double> &);    // false if the state has other nodes

   private:
    static constexpr int NVALUE = sizeof(OpenSample) / sizeof(double);
    static constexpr int NWAVE = sizeof(OpenWave) / sizeof(double);    // first of the NVALUE

    // Weighted sums over the fluid around a node; l = position along the plane relative to the node, d = height

    struct Sums {
      double weight, l[2], ll[3], d, dd;    // ll: l0 l0, l1 l1, l0 l1
      double value[NVALUE], value_l[NVALUE][2], value_d[NVALUE];
    };

    struct Node {
      double weight, distance;    // of the measured fluid: sum of weights, distance from the plane
      double value[NVALUE];       // at the node and this distance
      double slope[NVALUE];       // along the normal
      double mean[NVALUE];        // mean over time
      double known;               // > 0: fluid was here at any time
    };

    struct Past {
      double time;
      std::vector<double> wave;    // NWAVE values per node
    };

    const OpenPlane &plane;
    double averaging_time = 0.0, memory = 0.0;
    std::vector<Sums> my_sums, sums;
    std::vector<Node> nodes, before;    // before: before the last measurement
    std::deque<Past> history;           // oldest first

    void fit(const Sums &, Node &) const;
    template <class Function>
    bool interpolate(const Spot &, int nvalue, double *value, Function &&of_node) const;
  };

  // Prescribed values of a buffer zone: velocity, density or pressure, internal energy or temperature, and spin

  class OpenValues : protected Pointers {
   public:
    enum Quantity { VX, VY, VZ, RHO, P, ENERGY, TEMPERATURE, WX, WY, WZ, NQUANTITY };

    // owner: for messages
    OpenValues(class LAMMPS *lmp, const std::string &owner) : Pointers(lmp), owner(owner) {}

    void read(Keywords &);    // Set the quantities of the keyword, if the keyword has any.
    void check() const;
    void init(bool needs_heat);    // finds the variables; needs_heat: heat must be > 0

    bool given(Quantity k) const { return is_given[k]; }
    bool vary() const { return any_variable; }

    // Evaluate the variables now, for owned particles of the group; other particles get 0.
    void evaluate(int igroup);

    double memory_usage() const;    // bytes

    double operator()(Quantity k, int i) const { return value[k](i); }

   private:
    const std::string owner;
    Value value[NQUANTITY];
    bool is_given[NQUANTITY] = {};
    bool any_variable = false, needs_heat = false;

    const char *fault(int k, double) const;    // why a value is inadmissible; nullptr: admissible
  };

  // State of a particle of a zone: pressure, density, heat per mass

  struct OpenState {
    double p, rho, q;
  };

  // Boundary condition of a buffer zone: velocity, pressure, density, and heat of its particles, from the prescribed values
  // and from the samples of the fluid.
  // M. Lastiwka, M. Basa, N. J. Quinlan, Int. J. Numer. Meth. Fluids 61, 709 (2009).

  class OpenCondition : protected Pointers {
   public:
    // owner: for messages
    OpenCondition(class LAMMPS *lmp, const std::string &owner, const OpenPlane &plane,
                  const OpenValues &values, const OpenSamples &samples) :
        Pointers(lmp),
        owner(owner), plane(plane), values(values), samples(samples)
    {
    }

    double averaging_time = 0.0;    // 0: by the support radius
    double clock = 0.0;             // time of the zone, which reset_timestep does not change
    bool is_new = false;            // no particle has a state yet: each has the heat without waves

    void read(Keywords &);    // Read the keyword, if the keyword belongs to a condition.
    void check();             // Stop for keywords without an effect, and for too few keywords.

    void init(const FluidModel &);
    bool given_velocity() const { return values.given(OpenValues::VX); }
    bool given_state() const    // density or pressure
    {
      return values.given(OpenValues::RHO) || values.given(OpenValues::P);
    }
    bool has_heat() const { return warm; }    // states include the heat

    // Functions of an owned particle of the zone

    void prescribed_velocity(int i, double *u) const;
    void velocity(int i, double *u) const;
    OpenState state(int i) const;
    double prescribed_density(int i) const { return reference(i, ZONE).rho; }    // without waves
    double heat(int i) const { return reference(i, ZONE).q; }    // per mass, without waves
    double temperature(int i, const OpenState &) const;          // in the conduction of heat
    double sound_at_rest(int i, bool of_zone) const;             // speed at rho0, of zone or fluid

    OpenState at_density(int i, const OpenState &, double rho) const;    // at the same entropy
    void keep(int i, const OpenState &) const;    // gives the particle this state

    // Density at which a particle has its internal energy, 0: not known.  No force computation changes this density.  The
    // density migrates with the particle, also into restart files.

    double &density_of_energy(int i) const;

    // Functions of an owned particle of the fluid near the plane; more = pressure of the particle beyond the equation of state

    OpenSample sample(int i, const Particle &, double more) const;
    bool is_supersonic(int i, const Particle &) const;    // the particle leaves faster than sound

   private:
    enum Kind { LAGGED, CHARACTERISTIC, FIXED };
    enum Side { ZONE, FLUID };

    const std::string owner;
    const OpenPlane &plane;
    const OpenValues &values;
    const OpenSamples &samples;
    const FluidModel *fluid = nullptr;
    const Fields *fields = nullptr;
    bool warm = false;
    Kind kind = LAGGED;
    int order = -1;    // extrapolation of values from inside, kind fixed

    // Reference state of waves at a particle of zone or fluid: the prescribed state, else the average of the fluid over time

    struct Reference {
      OpenPlane::Spot spot;
      double height;
      bool known;          // there is an average, or no average is needed
      OpenSample mean;     // average over time
      double p, rho, c;    // pressure, density, sound speed
      double q;            // heat per mass
      bool at_heat;        // the heat is prescribed, not the entropy
      double out;          // velocity out of the fluid
    };

    const EosParams &eos(int i) const;
    double sound(int i, double rho, double q) const;
    bool enters(int i) const;    // the particle moves toward the fluid
    bool gets_heat(int i, Side) const;
    OpenState own_state(int i, Side) const;
    Reference reference(int i, Side) const;
    OpenState at_pressure(int i, const Reference &, double p, double strain) const;
    OpenWave wave(const Reference &) const;
    double changes(const Reference &, double wave) const;
  };

  class OpenBand;

  // Creates and deletes the particles at the far end of a buffer zone, before new neighbor lists.  Particles form rows along
  // the normal of the plane.  When the last particle of a row moves on, create a copy behind this particle; delete particles
  // beyond the end of the zone.  Results do not depend on the number of processors.

  class ZoneLattice : protected Pointers {
   public:
    ZoneLattice(class LAMMPS *lmp, const std::string &owner, const OpenPlane &plane, int groupbit) :
        Pointers(lmp), owner(owner), plane(plane), groupbit(groupbit)
    {
    }

    void set_spacing(double a) { given_spacing = a; }
    bool has_spacing() const { return given_spacing > 0.0; }

    // Distance of an owned particle from the next particle of the row; instead of a spacing
    typedef std::function<double(int i)> Distance;
    void set_distance(Distance f) { distance = std::move(f); }
    bool by_distance() const { return static_cast<bool>(distance); }

    // Measure width of rows, and distance of particles in rows, of a zone that is new: until the first renew().
    void init(double support, int fluid_bit);
    bool are_new() const { return unknown_sides; }
    double width() const { return 2.0 * half_width; }    // width of a row
    double largest_spacing() const;                      // of present particles, all processors

    // Add the largest distance by which particles have moved along the normal in a step.
    void note_motion(double most) { moved += most; }

    // Delete and create particles.  Calls refresh(indices) for owned particles that are new or have moved, to set their
    // velocities and the values that their distances depend on.
    typedef std::function<void(const std::vector<int> &)> Refresh;
    void renew(const Refresh &refresh);

    static constexpr int NSTATE = 3;
    void pack(double *) const;    // for the restart file
    void unpack(const double *);

   private:
    const std::string owner;
    const OpenPlane &plane;
    const int groupbit;
    int fluidbit = 0;
    double given_spacing = 0.0, spacing = 0.0, half_width = 0.0, support = 0.0;
    double moved = 0.0;
    tagint highest = 0;           // highest ID ever given
    bool unknown_end = true;      // where the rows end is not known
    bool unknown_sides = true;    // width of rows, and other particles among them, are not known
    Distance distance;

    double step(int i) const;    // from an owned particle to the next particle of the row
    double my_largest_spacing() const;
    double end() const;    // height where the zone ends
    void interrupt_ids();
    void find_rows();
    void remove_beyond();
    std::vector<int> last_ones(const OpenBand &) const;
    // removed = particles that this processor has deleted, not yet in change = change of the number on all processors
    bool fill(std::vector<int> &last, const OpenBand &, const Refresh &, bigint &removed,
              bigint &change);
    void check_alone(const OpenBand &) const;
    void check_lattice(const OpenBand &, double largest) const;
    void check_seat(const double *x, const OpenBand &) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
