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

// Flows of amounts Q between particles by the differences of a value q, such as heat by the temperature.  Particle i gets
//   dQ_i/dt = sum_j 2 k_ij F V_i V_j (q_j - q_i),   k_ij = 2 k_i k_j/(k_i + k_j)
// with the coefficients k: the Laplacian of the form morris with q instead of u.  With the harmonic mean, the flow through
// an interface is the same from both sides, P. W. Cleary, J. J. Monaghan, J. Comput. Phys. 148, 227 (1999).
// No pair changes the sum of Q.  A channel with a flow also derives from BaseFlow; FlowList has all flows, and all other
// code uses FlowList.  No LAMMPS include.

#include "sph_dissipation_states.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Input of the flow loop; all numbers are 0 for particles without a flow.  A boundary particle has either a volume, a
  // value, and a coefficient, or a flux.  Rows are read by fours.
  struct alignas(16) FlowRow {
    double vol;            // V
    double value;          // q
    double coefficient;    // k
    double flux;           // per area and time, from a boundary particle to the fluid
  };

  // Place of the flow of heat, the only one that passes walls and open zones
  constexpr int HEAT_FLOW = 0;

  // Return k_ij of two types with these coefficients
  SPH_FUNCTION double mean_coefficient(double a, double b)
  {
    return (a > 0.0 && b > 0.0) ? 2.0 * a * b / (a + b) : 0.0;
  }

  // A particle, for the channel of a flow: rows = StateRows
  template <class Rows, class Channel> struct FlowSite {
    const Rows &rows;
    int i;

    SPH_FUNCTION double state() const { return rows.template state_of<Channel>(i); }
    SPH_FUNCTION double temperature() const { return rows.temperature(i); }
    SPH_FUNCTION double mass() const { return rows.rmass[i]; }
    SPH_FUNCTION double rho() const { return rows.rho[i]; }
  };

  // Defaults of the members of a flow.  Its channel must define coefficient(type, rho0) of a type with this reference
  // density, value(site) of a particle, and OF_MOTION = false.  The flow changes the internal energy, or the state of the
  // channel, see FlowingState.
  struct BaseFlow {
    // true: with viscous, the integrator solves for the value; false: the flow always limits the time step
    static constexpr bool STIFF = false;
    // true: with temp energy, pass 2 has the flow, with its noise; false: the flow always has its own loop
    static constexpr bool IN_PASS_2 = false;
  };

  // A state that flows: an amount, whose sum no pair changes; the amount per mass drives the flow.  Its channel must define
  // FIELD, KEYWORD, count(), and coefficient(), rho0 D for a diffusivity D.
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
    // Return the bits of the flows that pass 2 has with temp energy
    static constexpr int in_pass_2() { return ((One::IN_PASS_2 ? 1 << place<One>() : 0) + ...); }
    // Call function(channel, place) for each flow with its bit
    template <class Function> SPH_FUNCTION static void visit(int bits, Function &&function)
    {
      ((bits >> place<One>() & 1 ? function(One(), place<One>()) : void()), ...);
    }
    // Set of[k] to the coefficient of flow k of a type
    template <class Coeffs> static void coefficients(const Coeffs &type, double rho0, double *of)
    {
      ((of[place<One>()] = One::coefficient(type.template of<One>(), rho0)), ...);
    }
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
