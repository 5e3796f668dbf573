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

#ifndef LMP_SPH_DISSIPATION_TABLE_H
#define LMP_SPH_DISSIPATION_TABLE_H

#include "pointers.h"
#include "sph_dissipation_steps.h"

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  class BoundaryStage;
  class ContactStage;
  class Engine;
  class FluidModel;
  struct PairInertia;
  struct TypePair;

  // Table in the log of the coefficients and the largest stable time steps of the pairs of types: one row for each pair; all
  // rows have the same columns.

  class CoeffTable {
   public:
    // fastest = speed of any particle
    CoeffTable(double fastest) : fastest(fastest) {}

    // Add the row of types i and j; arguments: largest stable time step for sound in these types, rate of the diffusion of
    // volume
    void add_row(int i, int j, const TypePair &, const PairInertia &, double acoustic_step,
                 double diffusion_rate);
    void add_contact(double step);    // largest stable time step of the contact of bodies
    // Return the table, with lines on the accuracy of these steps, and on the needs of the time step dt
    std::string text(double dt) const;
    double smallest_step() const { return smallest; }    // of all rows, with all terms together
    // Step of sound and other waves, of the diffusion of volume, and of flows that are not stiff
    double acoustic_step() const { return acoustic; }
    double dissipative_step() const { return dissipative; }       // without sound
    double fastest_rate() const { return rate_of(viscous); }      // of the viscous terms
    double fastest_heat_rate() const { return rate_of(heat); }    // of conduction

    // Return a line with the fastest skin of the neighbor list at these speeds; empty if that skin saves less than a tenth
    // of the time per step, and at rest
    std::string skin_text(double skin, double dt, double support, int dim) const;

   private:
    std::string lines() const;

    struct Column {
      std::string name;
      int channel;    // number in the list of all channels; -1: none
      double value;
    };
    struct Row {
      std::string types;
      std::vector<Column> coefficients, steps;
    };

    const double fastest;
    std::vector<Row> rows;
    std::set<int> left_out;    // optional channels that no row uses
    double smallest = UNLIMITED_STEP, acoustic = UNLIMITED_STEP, contact = UNLIMITED_STEP;
    double viscous = UNLIMITED_STEP, dissipative = UNLIMITED_STEP, heat = UNLIMITED_STEP;

    static double rate_of(double step) { return (step < UNLIMITED_STEP) ? 1.0 / step : 0.0; }
  };

  // Largest stable time steps of a fluid in its present state.  All ranks call these functions.

  class Stability : protected Pointers {
   public:
    Stability(class LAMMPS *lmp, const FluidModel &model, Engine &engine,
              const BoundaryStage &boundary, const ContactStage &contact) :
        Pointers(lmp),
        model(model), engine(engine), boundary(boundary), contact(contact)
    {
    }

    // Return the coefficients and the largest stable time steps of all pairs of types

    CoeffTable table() const;

    // Return the smallest sqrt(h/a) of fluid particles, with the stability length h and the acceleration a
    // (UNLIMITED_STEP without fluid particles)

    double fall_time() const;

    // Return the function with the speed of sound of owned particle i, in its present state but at density rho

    std::function<double(int i, double rho)> sound() const;

   private:
    const FluidModel &model;
    Engine &engine;
    const BoundaryStage &boundary;
    const ContactStage &contact;

    double length() const;    // h
    double lightest_fluid() const;
    double smallest_inertia() const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
