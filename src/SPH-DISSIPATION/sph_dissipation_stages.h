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
#include "sph_dissipation_threads.h"

#include <functional>
#include <vector>

namespace LAMMPS_NS {
class NeighList;

namespace SPHDissipation {

  class Engine;
  class Exchange;
  class PairTally;
  struct PairEnergyKernel;
  struct StepPlan;

  // A stage of the force computation: sums of its own over the pairs that pass 1 of the engine has
  // found, and what it sends to ghost atoms or gets back from them.  Fluid::compute() lists the stages
  // in their order.

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
    // atoms that forces and heat go to: owned ones and, with newton on, ghosts
    int nforce() const;
  };

  // Pass 1: density c of the reference volumes w, for w = 1 of the number of particles, and its rate;
  // then volume and mass density, see ParticleRows::set_density()

  class DensityStage : public Stage {
   public:
    using Stage::Stage;

    // extrapolated velocity and spin, each nullptr where it is zero.  not_fluid = bits of the groups of particles of
    // walls and open zones

    void run(NeighList *, double **vest, double **omegaest, int not_fluid, bool slopes_read = true);

    // for forces, with the pressure of states: at_rest, strains are zero; with the values of the
    // flows; and, where particles have the noise of their temperatures, with the internal energies at the end
    // of the step, which lack the work of the pressure over this time.  not_fluid = bits of the groups of particles of
    // walls and open zones

    void run(NeighList *, double **vest, double **omegaest, bool at_rest, double missing,
             int not_fluid, bool slopes_read);

   private:
    void sum(NeighList *, double **vest, double **omegaest, int not_fluid, bool slopes_read);
    void send(bool with_states, int flows, int not_fluid, int first);
  };

  // How negative the coefficient of the bulk term of a particle may be:
  //   B_i = sum_j (c_j/c_i)^2 V_j F r^2 / a_ij,
  // where a_ij F V_i V_j is what the shear term puts before (u.e)^2.  The total dissipation is
  // non-negative for any velocities if zeta_i B_i >= -1/2 for all particles (theory page).

  class LimitStage : public Stage {
   public:
    using Stage::Stage;

    void run();    // with the volumes of particles set
    double memory_usage() const override { return bytes(bound, sums); }

    std::vector<double> bound;    // B of owned and ghost atoms

   private:
    ThreadSums<double> sums;
  };

  // Viscosities that are not constant, see sph_dissipation_rheology.h; with the volumes of particles set

  class ViscosityStage : public Stage {
   public:
    using Stage::Stage;

    // of the rates of shear at the velocities of the particles, which owned ones keep; of the rates that they have kept
    void run(int not_fluid);
    void keep(int not_fluid);

    double memory_usage() const override { return bytes(rates); }

   private:
    std::vector<double> rates;    // of owned and ghost atoms
  };

  // Pressure and bulk term of all particles of the fluid, of volume and density as pass 1 left them, see
  // ParticleRows::set_pressure()

  class PressureStage : public Stage {
   public:
    using Stage::Stage;

    // bound = of LimitStage, nullptr without; not_fluid = bits of the groups of boundary particles,
    // which get zero.  Returns the number of owned particles whose coefficient is beyond the bound.

    bigint run(const double *bound, int not_fluid);

    // the bulk term alone, of the rates that pass 1 has left: what the passes leave of Gamma u

    void set_bulk_term(const double *bound, int not_fluid) const;

    // elastic energy of owned particles, with that of their strains; each_atom = what it is added to, or nullptr

    double elastic_energy(double *each_atom, int not_fluid) const;
  };

  // The states of particles: see StateList

  class StateStage : public Stage {
   public:
    using Stage::Stage;

    // Advance them by the time step for which the parameters hold, from the last forces; not_fluid as above.
    // noise[k * nlocal + i] = thermal noise of the state at place k

    void advance(int not_fluid, const std::vector<double> &noise) const;

    // owned particles keep the states that their types have; returns how many particles, of all processors, had others, and
    // bits of the places of these
    std::pair<bigint, int> keep() const;

    // energy that they hold, of owned particles of these groups, not_fluid as above

    double energy(int groupbits, int not_fluid) const;
  };

  // The flows, after pass 2, see FlowList: onto the heating of LAMMPS as ForceStage, or for the state that the integrator
  // will advance

  class FlowStage : public Stage {
   public:
    using Stage::Stage;

    // with the heat per time of owned and ghost atoms that another stage adds
    void run(const std::function<void(std::vector<double> &heat)> &add);

    // heat per time that particles of a group got in run(), on this processor
    double received(int groupbit) const;

    void forget();    // the rates of the last forces
  };

  // Energy of pairs of unlike types, a w_i w_j W(r) with the reference volumes w = m/rho0, see
  // BaseChannel::pair_energy() and PairEnergyKernel: their force, after pass 2

  class PairEnergyStage : public Stage {
   public:
    using Stage::Stage;

    bool active() const;
    // add the forces to the sums of the engine, with a tally of each pair, or nullptr
    void run(NeighList *, PairTally *);
    // Energy of the particles of a group, half of each pair, on this processor, added to those of the particles (nullptr:
    // to none); of the pairs of the last run()
    double energy(double *each_atom, int groupbit) const;

    double memory_usage() const override { return bytes(pairs, sums); }

   private:
    struct UnlikePair {
      int i, j;
      double energy;    // a w_i w_j, with the factor of rows
    };
    std::vector<UnlikePair> pairs;    // of the neighbor list
    std::vector<double> energies;     // a of the types when they were found
    ThreadSums<ForceSum> sums;

    void find_pairs(NeighList *, const PairEnergyKernel &);
    // function(pair, r_ij, r^2) for those within the support radius
    template <class Function>
    void visit(std::size_t from, std::size_t to, Function &&function) const;
  };

  // Diffusion of volume, after pass 2, see sph_dissipation_diffusion_terms.h.  The rates of volumes and energies are kept
  // with the particles: between two evaluations they stay as they are, with which no sum changes.

  class DiffusionStage : public Stage {
   public:
    using Stage::Stage;

    // find the rates; how full the support of a particle is: the smallest eigenvalue of its tensor, 1 inside of the fluid,
    // about 1/2 at a plane surface, 0 of particles that have no neighbors or are not fluid; integrated = bits of the groups
    // whose volumes change, of others, as the particles of a rigid body, none does

    void evaluate(int not_fluid, int integrated);

    // onto the heating

    void add_heat(int not_fluid, int integrated) const;

    double memory_usage() const override { return bytes(rows, impedances, sums, flow); }

   private:
    std::vector<DiffusionRow> rows;    // of owned, ghost, and spare particles, as the next three
    std::vector<double> impedances;
    std::vector<SumBlock> sums, flow;

    void set_rows(int not_fluid, int integrated);
  };

  // Particle shifting, see sph_dissipation_shift_terms.h: not in a force computation, but every few steps, after the first
  // half of the step, with the pairs and the volumes of the last forces

  class ShiftStage : public Stage {
   public:
    using Stage::Stage;

    std::vector<ShiftMover> movers;    // by the fixes, from their init(), in every run

    int interval() const;    // steps from one shift to the next one
    ShiftLaw law() const;

    // Change positions, velocities, extrapolated velocities, and internal energies of owned particles.  keep: as of TimeStep
    void run(double keep);
    double memory_usage() const override { return bytes(rows, sums, thread_sums); }

   private:
    std::vector<ShiftRow> rows;    // of owned and ghost particles
    std::vector<double> sums;      // rows of one of the structs of sums
    ThreadSums<double> thread_sums;

    // sums of owned particles of what add(i, j, entry, sum of i, sum of j) adds for each pair
    template <class Sum, class Add> const Sum *sum_up(const Add &);
  };

  // Pass 2: forces, torques and heating of owned atoms and the contributions to ghost atoms, onto
  // the arrays of LAMMPS, which sums up those of the ghosts itself

  class ForceStage : public Stage {
   public:
    using Stage::Stage;

    // tally of each pair, or nullptr; add_more: to the sums of the engine, after pass 2
    void run(NeighList *, PairTally *, const StepPlan &, const std::function<void()> &add_more);

    // also add the force and torque of ghosts to those of their owners in the engine

    void collect();

    // Heat of the dissipative forces, energy per time: of each owned and ghost atom as this rank
    // summed it (with newton on, the sums of ghosts belong to their owners), heat may be nullptr; by
    // channel, the sum on this rank.  not_fluid = bits of the groups of particles that are left out

    void heating(double *heat, double *power, int not_fluid) const;

   private:
    double bulk_heat(int) const;
    void add_drag_heat(int, int not_fluid, double *channel) const;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
