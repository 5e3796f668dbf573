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

#ifndef LMP_SPH_DISSIPATION_OPEN_CONDITION_H
#define LMP_SPH_DISSIPATION_OPEN_CONDITION_H

#include "pointers.h"
#include "sph_dissipation_open_plane.h"
#include "sph_dissipation_value.h"

#include <string>

namespace LAMMPS_NS {

namespace SPHDissipation {

  // What a buffer zone prescribes: velocity, density or pressure, internal energy or temperature, and spin

  class OpenValues : protected Pointers {
   public:
    enum Quantity { VX, VY, VZ, RHO, P, ENERGY, TEMPERATURE, WX, WY, WZ, NQUANTITY };

    OpenValues(class LAMMPS *, const std::string &owner);    // owner: for messages

    // Set the quantities of the keyword at arg[iarg]; return its number of words, 0 if it is none of them.
    int keyword_argument(int iarg, int narg, char **arg);
    void check() const;
    void init(bool needs_heat);    // finds the variables; heat must then be > 0

    bool given(Quantity k) const { return is_given[k]; }
    bool vary() const { return any_variable; }

    // Evaluate the variables now, for owned particles of the group; others have 0.
    void evaluate(int igroup);

    double memory_usage() const;    // bytes

    double operator()(Quantity k, int i) const { return value[k](i); }

   private:
    const std::string owner;
    Value value[NQUANTITY];
    bool is_given[NQUANTITY];
    bool any_variable, needs_heat;

    const char *fault(int k, double) const;    // what a value must not be; nullptr: nothing
  };

  class Fields;
  class FluidModel;
  struct EosParams;
  struct Particle;

  // State of a particle of a zone: pressure, density, heat per mass

  struct OpenState {
    double p, rho, q;
  };

  // Boundary condition of a buffer zone: velocity, pressure, density, and heat of its particles, from what is
  // prescribed and from what the fluid does.
  // M. Lastiwka, M. Basa, N. J. Quinlan, Int. J. Numer. Meth. Fluids 61, 709 (2009).

  class OpenCondition : protected Pointers {
   public:
    OpenCondition(class LAMMPS *, const std::string &owner, const OpenPlane &, const OpenValues &,
                  const OpenSamples &);    // owner: for messages

    double averaging_time;    // 0: by the support radius
    double clock;             // time of the zone, which reset_timestep does not change
    bool is_new;              // no particle has a state yet: the heat of each is that without waves

    // Set what the keyword at arg[iarg] says; return its number of words, 0 if it is none of a condition.
    int keyword_argument(int iarg, int narg, char **arg);
    void check();    // errors for keywords without an effect, and for too few of them

    void init(const FluidModel &);
    bool given_velocity() const;
    bool given_state() const;                 // density or pressure
    bool has_heat() const { return warm; }    // states include the heat

    // of an owned particle of the zone

    void prescribed_velocity(int i, double *u) const;
    void velocity(int i, double *u) const;
    OpenState state(int i) const;
    double prescribed_density(int i) const { return reference(i, ZONE).rho; }    // without waves
    double heat(int i) const;                              // per mass, without waves
    double temperature(int i, const OpenState &) const;    // with which it conducts heat
    double sound_at_rest(int i, bool of_zone) const;       // at the density rho0; also of the fluid

    OpenState at_density(int i, const OpenState &, double rho) const;    // and the same entropy
    void keep(int i, const OpenState &) const;    // the particle has this state

    // Density at which a particle has its internal energy, 0: not known.  No force computation changes it, and it
    // moves to other processors and into restart files with the particle.

    double &density_of_energy(int i) const;

    // of an owned particle of the fluid near the plane; more = its pressure beyond the equation of state

    OpenSample sample(int i, const Particle &, double more) const;
    bool is_supersonic(int i, const Particle &) const;    // on its way out

   private:
    enum Kind { LAGGED, CHARACTERISTIC, FIXED };
    enum Side { ZONE, FLUID };

    const std::string owner;
    const OpenPlane &plane;
    const OpenValues &values;
    const OpenSamples &samples;
    const FluidModel *fluid;
    const Fields *fields;
    bool warm;
    Kind kind;
    int order;    // of values from inside, kind fixed

    // The state from which waves are counted at a particle of zone or fluid: what is prescribed, else the
    // average over time of what the fluid had

    struct Reference {
      OpenPlane::Spot spot;
      double height;
      bool known;          // there is an average, or none is needed
      OpenSample mean;     // over time
      double p, rho, c;    // pressure, density, sound speed
      double q;            // heat per mass
      bool at_heat;        // which is known, and not the entropy
      double out;          // velocity out of the fluid
    };

    const EosParams &eos(int i) const;
    double sound(int i, double rho, double q) const;
    bool enters(int i) const;
    bool gets_heat(int i, Side) const;
    OpenState own_state(int i, Side) const;
    Reference reference(int i, Side) const;
    OpenState at_pressure(int i, const Reference &, double p, double strain) const;
    OpenWave wave(const Reference &) const;
    double changes(const Reference &, double wave) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
