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

#ifndef LMP_SPH_DISSIPATION_STAGES_H
#define LMP_SPH_DISSIPATION_STAGES_H

#include "pointers.h"
#include "sph_dissipation_diffusion_terms.h"
#include "sph_dissipation_rows.h"
#include "sph_dissipation_shift_terms.h"
#include "sph_dissipation_space.h"

#include <functional>
#include <vector>

namespace LAMMPS_NS {
class NeighList;

namespace SPHDissipation {

  class Engine;
  class Exchange;
  class PairTally;

  // A stage of the force computation: its sums over the pairs of pass 1, and its messages to and from ghost atoms.
  // Fluid::list_stages() has the order of the stages.

  class Stage : protected Pointers {
   public:
    Stage(class LAMMPS *lmp, Engine &engine, Exchange &exchange) :
        Pointers(lmp), engine(engine), exchange(exchange)
    {
    }
    ~Stage() override = default;

    virtual double memory_usage() const { return 0.0; }    // bytes

   protected:
    Engine &engine;
    Exchange &exchange;
    // Return the number of atoms that get forces and heat: owned atoms and, with newton on, ghosts
    int nforce() const;
  };

  // A stage that runs on the host or on a device: the functions are in sph_dissipation_shared_stages.h.  They are public,
  // because CUDA requires this of functions with lambdas.  not_fluid = bits of the groups of walls and open zones

  template <class Space> class SharedStage : protected Pointers {
   public:
    template <class T> using Array = typename Space::template Array<T>;

    SharedStage(class LAMMPS *lmp, Space &space) : Pointers(lmp), space(space) {}

   protected:
    Space &space;
    int nall() const;    // owned and ghost atoms
  };

  // Pass 1: density c of the reference volumes w (number density if w = 1), and its rate; then volume and mass density, see
  // ParticleRows::set_density()

  template <class Space> class DensityStage : public SharedStage<Space> {
   public:
    using SharedStage<Space>::SharedStage;

    // Run with extrapolated velocity and spin; nullptr: zero

    void run(NeighList *, double **vest, double **omegaest, int not_fluid, bool slopes_read = true);

    // Run for the forces: also set the pressure of states (at_rest: strains are zero) and the values of flows.  With
    // temp energy, complete the internal energies to the end of the step by the work of the pressure over the missing time

    void run(NeighList *, double **vest, double **omegaest, bool at_rest, double missing,
             int not_fluid, bool slopes_read);

    // Send the values of owned particles to ghosts; then set the densities of all particles from number first on

    void send(bool with_states, int flows, int not_fluid, int first);
  };

  // Bound on negative coefficients of the bulk term of a particle:
  //   B_i = sum_j (c_j/c_i)^2 V_j F r^2 / a_ij,
  // where a_ij F V_i V_j is the coefficient of (u.e)^2 in the shear term.  The total dissipation is non-negative for any
  // velocities if zeta_i B_i >= -1/2 for all particles (theory page).

  template <class Space> class LimitStage : public SharedStage<Space> {
   public:
    using SharedStage<Space>::SharedStage;

    void run();    // the volumes of particles are set
    double memory_usage() const { return Space::bytes_of(bound); }

    typename Space::template Array<double> bound;    // B of owned and ghost atoms
  };

  // Viscosities that are not constant, see sph_dissipation_rheology.h; needs the volumes of particles

  template <class Space> class ViscosityStage : public SharedStage<Space> {
   public:
    using SharedStage<Space>::SharedStage;

    // run(): set viscosities from the rates of shear at the present velocities; owned particles keep both numbers.  Particles
    // of open zones have viscosities as fluid; walls (bits of groups) have none.  keep(): set the kept viscosities
    void run(int walls);
    void keep();
  };

  // Pressure and bulk term of all fluid particles, from the volume and density of pass 1, see ParticleRows::set_pressure()

  template <class Space> class PressureStage : public SharedStage<Space> {
   public:
    using SharedStage<Space>::SharedStage;

    // Boundary particles (groups not_fluid) get zero.  Return the number of owned particles with a coefficient beyond the
    // bound of LimitStage (nullptr: no bound)

    bigint run(const double *bound, int not_fluid);

    // Set the bulk term alone, from the rates of pass 1, for the product Gamma u

    void set_bulk_term(const double *bound, int not_fluid) const;

    // Return the elastic energy of owned particles, strains included; add it to each_atom, unless this is nullptr

    double elastic_energy(double *each_atom, int not_fluid) const;
  };

  // The states of particles: see StateList

  template <class Space> class StateStage : public SharedStage<Space> {
   public:
    using SharedStage<Space>::SharedStage;

    // Advance the states by the time step of the parameters, from the last forces.  Particles of open zones keep states other
    // than strains; walls (bits of groups) keep no state.  noise[k * nlocal + i] = thermal noise of the state at place k < end

    void advance(int not_fluid, int walls, const double *noise, int end) const;

    // Drop states that the types of owned particles do not have; return the number of particles with such states, of all
    // processors, and the bits of the places of these states
    std::pair<bigint, int> keep() const;

    // Return the energy of the states of owned particles of these groups

    double energy(int groupbits, int not_fluid) const;
  };

  // The flows, after pass 2, see FlowList: added to the heating of LAMMPS, or kept for the next advance of a state

  template <class Space> class FlowStage : public SharedStage<Space> {
   public:
    using SharedStage<Space>::SharedStage;

    // Run; add_more() adds heat per time to Space::flow_rate(HEAT_FLOW)
    void run(const std::function<void()> &add_more);

    // Return the heat per time that particles of a group got in run(), on this processor
    double received(int groupbit) const;

    void forget() { this->space.forget_flows(); }    // drops the rates of the last forces
  };

  // Diffusion of volume, after pass 2, see sph_dissipation_diffusion_terms.h.  The particles keep the rates of volumes and
  // energies constant between two evaluations: so the sums over all particles do not change.

  template <class Space> class DiffusionStage : public SharedStage<Space> {
   public:
    using SharedStage<Space>::SharedStage;

    // Find the rates, and the filled part of each support: the smallest eigenvalue of the tensor, 1 inside of the fluid,
    // about 1/2 at a plane surface, 0 for particles without neighbors or that are not fluid.  integrated = bits of the
    // groups whose volumes change: volumes of rigid bodies do not change.  HostSpace; a device has loops of its own

    void evaluate(int not_fluid, int integrated);

    void set_rows(int not_fluid, int integrated);    // the input of the loops

    // Add the heat of the last rates to the heating

    void add_heat(int not_fluid, int integrated) const;

    double memory_usage() const { return Space::bytes_of(rows, impedances) + bytes(sums, flow); }

    // Of owned, ghost, and spare particles, like the next two members

    typename Space::template Array<DiffusionRow> rows;
    typename Space::template Array<double> impedances;

   private:
    std::vector<SumBlock> sums, flow;
  };

  // Particle shifting, see sph_dissipation_shift_terms.h: every few steps, after the first half of the step, with the pairs
  // and the volumes of the last forces

  template <class Space> class ShiftStage : public SharedStage<Space> {
   public:
    using SharedStage<Space>::SharedStage;

    std::vector<ShiftMover> movers;    // by the fixes, from their init(), in every run

    int interval() const;    // steps from one shift to the next one
    ShiftLaw law() const;

    // Change positions, velocities, extrapolated velocities, and internal energies of owned particles; keep: see TimeStep
    void run(double keep);
    double memory_usage() const { return Space::bytes_of(rows); }

    template <class K> void set_rows(const ShiftLaw &);

   private:
    typename Space::template Array<ShiftRow> rows;    // of owned and ghost particles
  };

  // After pass 2: adds the engine's sums of forces, torques, and heating, of owned and ghost atoms, to the arrays of LAMMPS,
  // which sends the sums of ghosts to their owners

  class ForceStage : public Stage {
   public:
    using Stage::Stage;

    void run(int not_fluid);    // as above

    // Get the heat of the dissipative forces, energy per time.  heat: for each owned and ghost atom, as summed on this rank
    // (with newton on, the sums of ghosts belong to their owners), or nullptr.  power: by channel, the sum on this rank.
    // Particles of the groups not_fluid do not count

    void heating(double *heat, double *power, int not_fluid) const;

   private:
    double bulk_heat(int) const;
    void add_drag_heat(int, int not_fluid, double *channel) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
