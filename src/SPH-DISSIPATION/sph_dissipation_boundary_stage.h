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

  // Boundary particles get the velocity, volume, pressure and spin that act in the pair forces

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
    bool has_symmetric_friction() const { return symmetric_bits != 0; }    // any of them
    bool is_body(int i) const;    // of one that the fluid moves
    bool has_bodies() const { return body_bits != 0; }
    int bits_of_bodies() const { return body_bits; }
    bool has_mean_pressure() const { return mean_bits != 0; }    // any of them
    bool conducts() const    // they take part in the conduction of heat
    {
      return !boundaries.empty() && engine.constants().conducts();
    }
    bool gives_heat() const;    // any of them, to a fluid that conducts it

    // after the densities: see ParticleRows::set_reference_volume()
    void set_reference_volume();

    // after the pressures, before pass 2
    void run(NeighList *);

    // the same again in this step, for other velocities and pressures of the fluid; increments: of velocities alone, after
    // PressureStage::set_bulk_term(), linear in them, where particles with symmetric friction have the velocity that they have
    void extend(bool increments);

    // after run() and before increments: without tension a mean pressure below zero is none
    void note_pressures();

    // after run(): of the pairs of fluid and walls, what rates of shear are made of
    void set_squares();

    // the temperatures alone, or increments of them
    void extend_temperatures(bool increments);

    // After pass 2: add the friction, with its noise, of boundaries where it is symmetric to the sums of the engine; all its
    // heat goes to the fluid

    void add_friction(PairTally *, const StepNoise &);

    // the same of given velocities, linear and without noise: forces and torques alone

    void add_linear_friction();

    // With thermal noise, the forces of walls on the fluid have an energy; with free surfaces, their repulsion has.  After
    // pass 2: add the repulsion of the surfaces to the forces of the engine and of LAMMPS, and take its work, with
    // noise also that of the pressure of the walls, from the internal energies

    void repel(PairTally *);

    // The same energy, of each particle, is no heat: after run(), where particles have temperatures, into the engine,
    // which has the energies that lack the work over this time.

    void find_energies(double missing);

    // After pass 1: these energies where the particles are, without what it needs the motion for

    void find_energies_at_rest(NeighList *);

    // add that energy to those of the particles (nullptr: to none); return its sum on this processor

    double energy(double *each_atom) const;

    // From Boundary::set_boundary(), of one of its owned particles: density and pressure without bulk term,
    // from which volume and P/c^2 follow; or all that the fluid around it brings, with its sums;
    // spin in the pair forces, to be set before, nullptr without spins

    void set_state(int i, double rho, double pressure);
    void extend_fluid(int i, const WallCondition &, const Surface &, const BoundarySum &,
                      const double *acceleration);
    double *spin(int i) { return engine.has_spin() ? engine.spin[i].w : nullptr; }

    // the pressure of frozen fluid of the same body; the gravity that acts on the fluid, for its beginning with density
    // continuity

    void set_frozen(int i, const double *gravity);

    // number of the body of an owned or ghost particle, see Boundary::number_bodies()

    int body(int i) const { return static_cast<int>(body_of[i]); }

    // function(i) for each i < n, shared among the threads
    template <class Function> void for_each(int n, const Function &function)
    {
      engine.for_each(n, function);
    }

    // the same if the fluid conducts heat: temperature at the surface, or heat per area and time

    void set_heat(int i, WallHeat, double value, const Surface &);

    // after the conduction: heat per time of owned and ghost atoms by the surfaces that give one, added to the fluid and
    // taken from the boundary particles

    void add_surface_heat(std::vector<double> &flow);

    // what run() consists of, for another one that does the sums elsewhere: the surfaces of the
    // owned and ghost atoms, when the neighbor list is new, from the vectors toward the fluid of the
    // owned ones, in order; and the end of a run with a particle inside a wall

    const std::vector<Boundary *> &all() const { return boundaries; }
    const Surface *find_surface(const std::vector<double> &sides);
    [[noreturn]] void stop_for(int i) const;

    double memory_usage() const override;

   private:
    std::vector<BoundarySum> sum;    // of owned and ghost atoms; empty if no boundary needs them
    std::vector<BoundaryHeatSum> heat_sum;    // the same; empty if nothing conducts
    std::vector<double>
        reference_volume;       // of owned and ghost atoms, where the loops have no such weight
    BoundaryPairs pairs;        // of this step
    const std::string style;    // of the pair style, for messages
    std::vector<Boundary *> boundaries;
    int group_bits = 0, symmetric_bits = 0, body_bits = 0, mean_bits = 0;
    int sum_bits = 0;    // of those that need sums over the fluid

    int rows_bits = 0;    // that the rows of the pairs were found for

    std::vector<char> pushes;    // whether owned particles have a pressure that changes

    std::vector<NearKernel> near, contact;    // of boundary atoms until the list is built anew
    // part of the supports of contact around owned and ghost atoms that they fill; not set where nothing repels
    std::vector<double> filled;

    ThreadSums<double> filled_sums, flow_sums;
    std::vector<ForceSum> repulsion;    // of several threads
    ThreadSums<ForceSum> repulsion_sums;
    SurfaceStage surface;
    bigint surface_step = -1;    // that the normals of the surface are for

    std::vector<SurfacePairs> surface_pairs;    // with symmetric friction, of each thread

    // numbers of the bodies of owned and ghost atoms, 0: none; sums over the other particles of the same body, of owned
    // atoms; empty without bodies

    std::vector<double> body_of, own_numden;

    void find_bodies();
    void sum_bodies();
    bool warned_of_contact = false;
    void warn_of_contact();
    double begin_frozen(int i, const double *gravity);
    enum class FrictionPart { ALL, ADDED, BODY };    // factor of surface_factor(), less 1, 1
    void find_surface_pairs();
    void run_friction(FrictionPart, PairTally *, const StepNoise *, bool linear);

    bool has_energy() const    // with thermal noise, or free surfaces
    {
      return engine.constants().thermal || engine.constants().continuity;
    }
    double conductivity(int i) const;
    double over(int i) const { return beyond_surface(filled[i]); }
    double stiffness(int i) const;
    void find_bits();
    void begin(NeighList *);

    // what pair of the fluid and a wall does: force on the particle of the fluid along r by the pressure of the wall, times
    // 1/r, if that has an energy, and by the repulsion; minus r.u

    struct WallForce {
      double r[3], approach, pressing, repulsion;
    };
    WallForce force_of(const BoundaryPair &) const;
    void add_energies(int n, const std::function<void(int, double)> &add) const;
    std::vector<NearKernel> of_boundaries(const std::function<NearKernel(double)> &of_volume) const;
    void find_filled(Kernel, const std::vector<NearKernel> &, std::vector<double> &part);
    bool are_across(int mask, int other) const    // one of the fluid, and one of a boundary
    {
      return static_cast<bool>(mask & group_bits) != static_cast<bool>(other & group_bits);
    }
    void find_candidates(NeighList *);
    void find_pairs();
    void set_excess();
    void accumulate();
    void accumulate_heat();
    void check(bool found);    // particles inside of a wall; found: the neighbor list is new
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
