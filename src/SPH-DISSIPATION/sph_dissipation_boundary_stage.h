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

#ifndef LMP_SPH_DISSIPATION_BOUNDARY_STAGE_H
#define LMP_SPH_DISSIPATION_BOUNDARY_STAGE_H

#include "sph_dissipation_boundary.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_engine_surface.h"
#include "sph_dissipation_surface.h"
#include "sph_dissipation_wall_terms.h"

#include <functional>
#include <string>
#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {

  class PairTally;

  // Sets velocity, volume, pressure and spin of boundary particles for the pair forces

  class BoundaryStage : public Stage {
   public:
    BoundaryStage(class LAMMPS *lmp, Engine &engine, Exchange &exchange, const std::string &style) :
        Stage(lmp, engine, exchange), style(style), surface(lmp, engine, exchange)
    {
    }

    void add(Boundary *);       // no effect if it is there
    void remove(Boundary *);    // no effect if it is not there
    bool empty() const { return boundaries.empty(); }
    int bits() const { return group_bits; }    // of the groups of all boundaries
    bool has_symmetric_friction() const { return symmetric_bits != 0; }    // any boundary
    int bits_of_symmetric_friction() const { return symmetric_bits; }
    bool is_boundary(int i) const;    // owned or ghost particle i belongs to a wall or body
    bool is_body(int i) const;        // i belongs to a body that the fluid moves
    bool has_bodies() const { return body_bits != 0; }
    bool has_contact() const;    // any body has contact forces
    int bits_of_bodies() const { return body_bits; }
    int bits_of_elastic_bodies() const { return elastic_bits; }
    bool has_mean_pressure() const { return mean_bits != 0; }    // any boundary
    bool conducts() const    // boundaries take part in the conduction of heat
    {
      return !boundaries.empty() && engine.constants().conducts();
    }
    bool gives_heat() const;    // any boundary, to a fluid that conducts heat

    // After the densities: see ParticleRows::set_reference_volume()
    void set_reference_volume();

    // After the pressures, before pass 2: set the values of all boundary particles
    void run(NeighList *);

    // After run(): set the values again for other velocities and pressures of the fluid.  increments: pressures are set by
    // PressureStage::set_bulk_term(), all values are linear in the velocities, and symmetric friction changes no velocity
    void extend(bool increments);

    // After run() and before increments: note which particles push: without tension, only those with a positive pressure
    void note_pressures();

    // After run(): set F (e.u)^2 of the pairs of fluid and boundaries, for the rates of shear
    void set_squares();

    // Set only the temperatures of boundary particles, or the increments of these temperatures
    void extend_temperatures(bool increments);

    // After pass 2: add the symmetric friction of boundaries and its noise to the sums of the engine, all heat to the fluid

    void add_friction(PairTally *, const StepNoise &);

    // Add forces and torques of the symmetric friction at given velocities, linear and without noise

    void add_linear_friction();

    // With thermal noise, all forces of walls have an energy; with free surfaces, only the repulsion has one.  After pass 2:
    // add the repulsion to the forces of the engine and of LAMMPS; subtract its work, and with noise also the work of the
    // pressure of walls, from the heating

    void repel(PairTally *);

    // The energy of walls is not heat.  After run(), with temp energy: hand the energy to the engine, and add the work of
    // the forces over the missing time to the internal energies

    void find_energies(double missing);

    // After pass 1: hand the energies at the present places to the engine, without any motion

    void find_energies_at_rest(NeighList *);

    // Add the energy of walls to the energies of particles (nullptr: to none); return its sum on this processor

    double energy(double *each_atom) const;
    double energy_of_bodies(double *each_atom) const;    // of their equation of state alone

    // Called by Boundary::set_boundary() for an owned particle of the boundary.  rest_at_surface(), extend_fluid(): the
    // functions of sph_dissipation_wall_terms.h.  spin(): return the spin in the pair forces, to be set before; nullptr
    // without spins

    void rest_at_surface(int i, const WallCondition &, const Surface &, const double *acceleration);
    void extend_fluid(int i, const WallCondition &, const Surface &, const BoundarySum &,
                      const double *acceleration);
    double *spin(int i) { return engine.has_spin() ? engine.spin[i].w : nullptr; }

    // Give a body particle the pressure of frozen fluid.  gravity = acceleration of the fluid; density continuity reads it
    // for the first density

    void set_frozen(int i, const double *gravity);

    // Return the number of the body of an owned or ghost particle, see Boundary::number_bodies()

    int body(int i) const { return body_of.empty() ? 0 : static_cast<int>(body_of[i]); }

    // Call function(i) for each i < n, shared among the threads
    template <class Function> void for_each(int n, const Function &function)
    {
      engine.for_each(n, function);
    }

    // Called by Boundary::set_heat() if the fluid conducts heat; value = temperature of the surface, or heat per area and
    // time

    void set_heat(int i, WallHeat, double value, const Surface &);

    // After the conduction: add the heat per time of surfaces with a flux to the fluid, and subtract it from the boundary
    // particles; flow = by owned and ghost atom

    void add_surface_heat(std::vector<double> &flow);

    // Parts of run() for the sums on a device.  find_surface(): with a new neighbor list, find the bodies; return the
    // surfaces of owned and ghost atoms from sides, the vectors toward the fluid of owned boundary particles.
    // density_of_body(): number density of owned particle i from the other particles of its body.  thermal_stiffness(): of
    // the repulsion with temp T, else 0.  stop_for(): particle i is in a wall

    const std::vector<Boundary *> &all() const { return boundaries; }
    const Surface *find_surface(const std::vector<double> &sides);
    double density_of_body(int i) const { return own_numden[i]; }
    double thermal_stiffness() const;
    [[noreturn]] void stop_for(int i) const;

    double memory_usage() const override;

   private:
    std::vector<BoundarySum> sum;    // of owned and ghost atoms; empty if no boundary needs them
    std::vector<BoundaryHeatSum> heat_sum;    // as sum; empty if nothing conducts
    std::vector<double>
        reference_volume;       // of owned and ghost atoms, unless it is the weight in the loops
    BoundaryPairs pairs;        // of this step
    const std::string style;    // of the pair style, for messages
    std::vector<Boundary *> boundaries;
    int group_bits = 0, symmetric_bits = 0, body_bits = 0, elastic_bits = 0, mean_bits = 0;
    int sum_bits = 0;    // of the boundaries that need sums over the fluid

    int rows_bits = 0;    // group_bits when the rows of the pairs were found

    std::vector<char> pushes;    // 1: the pressure of this owned particle has increments

    std::vector<NearKernel> near, contact;    // of boundary atoms until the list is built anew
    // part of the contact support that boundary atoms fill, of owned and ghost atoms; not set if nothing repels
    std::vector<double> filled;

    ThreadSums<double> filled_sums, flow_sums;
    std::vector<ForceSum> repulsion;    // of several threads
    ThreadSums<ForceSum> repulsion_sums;
    SurfaceStage surface;
    bigint surface_step = -1;    // step of the normals of the surface

    std::vector<SurfacePairs> surface_pairs;    // pairs with symmetric friction, of each thread

    // body_of: number of the body of each owned and ghost atom, 0: none.  own_numden: number density of each owned atom from
    // the other particles of its body, of an elastic body in its first shape.  Both empty without bodies

    std::vector<double> body_of, own_numden;

    void find_bodies();
    void sum_bodies();
    void keep_first_shape();
    double weight(int i) const;            // in the loops
    double resting_volume(int i) const;    // mass over the reference density
    bool warned_of_contact = false;
    void warn_of_contact();
    enum class FrictionPart { ALL, ADDED, BODY };    // factor: surface_factor(), this less 1, 1
    void find_surface_pairs();
    void run_friction(FrictionPart, PairTally *, const StepNoise *, bool linear);

    bool has_energy() const    // with thermal noise, or free surfaces
    {
      return engine.constants().thermal || engine.constants().continuity;
    }
    double conductivity(int i) const;
    double over(int i) const { return beyond_surface(filled[i]); }
    Repulsion repulsion_of(int i) const;
    void find_bits();
    void begin(NeighList *);

    // Force on the fluid particle of a pair along r, over r.  pressing: by the pressure of the wall, 0 unless this pressure
    // has an energy.  repulsion: by the repulsion.  approach = -r.u

    struct WallForce {
      double r[3], approach, pressing, repulsion;
    };
    WallForce force_of(const BoundaryPair &) const;
    void add_energies(int n, const std::function<void(int, double)> &add) const;
    std::vector<NearKernel> of_boundaries(const std::function<NearKernel(double)> &of_volume) const;
    void find_filled(Kernel, const std::vector<NearKernel> &, std::vector<double> &part);
    bool are_across(int mask, int other) const    // a particle of the fluid and one of a boundary
    {
      return static_cast<bool>(mask & group_bits) != static_cast<bool>(other & group_bits);
    }
    void find_candidates(NeighList *);
    void find_pairs();
    void set_excess();
    void accumulate();
    void accumulate_heat();
    void check(bool found);    // for particles inside of a wall; found: the neighbor list is new
    bool is_inside(int i) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
