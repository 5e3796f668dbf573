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

#ifndef LMP_SPH_DISSIPATION_FLOWS_H
#define LMP_SPH_DISSIPATION_FLOWS_H

// What flows between particles along the difference of a value, as heat along that of the temperature.  Particle i gets
//   dQ_i/dt = sum_j 2 k_ij F V_i V_j (q_j - q_i),   k_ij = 2 k_i k_j/(k_i + k_j)
// of the values q and the coefficients k: the Laplacian of the form morris with q instead of u, with the harmonic mean, for
// which the flow through a plane between two materials is the same from both sides, P. W. Cleary, J. J. Monaghan, J. Comput.
// Phys. 148, 227 (1999).  No pair changes the sum of Q.  A channel that has a flow derives from BaseFlow as well; FlowList has
// all of them, and all other code goes through it.  No LAMMPS include.

#include "sph_dissipation_states.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // What the loop reads of a particle; all numbers are 0 of others.  A boundary particle has either a volume, a value, and
  // a coefficient, or what its surface gives.  Rows are read by fours.
  struct alignas(16) FlowRow {
    double vol;            // V
    double value;          // q
    double coefficient;    // k
    double flux;           // per area and time, from a boundary particle to the fluid
  };

  // place of the flow that walls and open zones take part in, the one of heat
  constexpr int HEAT_FLOW = 0;

  // k_ij of two types with these coefficients
  SPH_FUNCTION double mean_coefficient(double a, double b)
  {
    return (a > 0.0 && b > 0.0) ? 2.0 * a * b / (a + b) : 0.0;
  }

  // A particle as the channel of a flow sees it: rows = StateRows
  template <class Rows, class Channel> struct FlowSite {
    const Rows &rows;
    int i;

    SPH_FUNCTION double state() const { return rows.template state_of<Channel>(i); }
    SPH_FUNCTION double temperature() const { return rows.temperature(i); }
    SPH_FUNCTION double mass() const { return rows.rmass[i]; }
    SPH_FUNCTION double rho() const { return rows.rho[i]; }
  };

  // Defaults for what a flow does not have.  Its channel says coefficient(type, rho0), of a type of this reference density, and
  // value(site) of a particle, and has OF_MOTION = false.  What flows is added to the internal energy, or to the state of
  // the channel, see FlowingState.
  struct BaseFlow {
    // with viscous, the integrator solves for the value; else the flow limits the time step in any case
    static constexpr bool STIFF = false;
    // with temp energy, pass 2 has the flow, with its noise; else the flow has a loop of its own in any case
    static constexpr bool IN_PASS_2 = false;
  };

  // A state that flows: an amount, which no pair changes the sum of, of which the amount per mass drives the flow.  Its channel says
  // FIELD, KEYWORD, count(), and coefficient(), for a diffusivity D rho0 D.
  struct FlowingState : BaseState, BaseFlow {
    static constexpr StateKind KIND = StateKind::EXTENSIVE;
    struct Numbers {
      double dt;
    };
    static Numbers process(const double *, int, double, double, double dt) { return {dt}; }

    template <class Site> SPH_FUNCTION static double value(const Site &site)
    {
      return site.state() / site.mass();
    }
    template <class Site> SPH_FUNCTION static void advance(const Site &site, double, double)
    {
      site.state() += site.own.dt * site.flow();
    }
  };

  template <class... One> struct FlowList {
    static constexpr int NUMBER = sizeof...(One);

    template <class Channel> SPH_FUNCTION static constexpr int place()
    {
      int k = 0;
      bool found = false;
      ((found = found || std::is_same<One, Channel>::value, k += found ? 0 : 1), ...);
      return k;
    }
    // bits of those that pass 2 has with temp energy
    static constexpr int in_pass_2() { return ((One::IN_PASS_2 ? 1 << place<One>() : 0) + ...); }
    // call function(channel, place) of each flow with its bit
    template <class Function> SPH_FUNCTION static void visit(int bits, Function &&function)
    {
      ((bits >> place<One>() & 1 ? function(One(), place<One>()) : void()), ...);
    }
    // of a type
    template <class Coeffs> static void coefficients(const Coeffs &type, double rho0, double *of)
    {
      ((of[place<One>()] = One::coefficient(type.template of<One>(), rho0)), ...);
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
