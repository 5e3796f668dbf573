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

#ifndef LMP_SPH_DISSIPATION_ENGINE_H
#define LMP_SPH_DISSIPATION_ENGINE_H

#include "pointers.h"
#include "sph_dissipation_diffusion_terms.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_noise_data.h"
#include "sph_dissipation_rows.h"
#include "sph_dissipation_settings.h"
#include "sph_dissipation_threads.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

// GCC, Clang, and their descendants can compile single functions for other instruction sets than the rest of LAMMPS.
// NVIDIA's compilers define the macros of GCC, but cannot do this; MinGW's GCC does not align the stack for the registers
// (GCC bug 54412).

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__EDG__) && !defined(__NVCC__) &&         \
    !defined(__NVCOMPILER) && !defined(__PGI) && !(defined(__MINGW32__) && !defined(__clang__)) && \
    !defined(SPH_DISSIPATION_NO_SIMD)
#define SPH_DISSIPATION_DISPATCH
#endif

namespace LAMMPS_NS {
class NeighList;

namespace SPHDissipation {

  // Receives the force on i from j of each pair, for virials that are summed by pair

  class PairTally {
   public:
    virtual ~PairTally() = default;
    virtual void tally(int i, int j, const double *force_on_i, const double *rij) = 0;
  };

  struct Parameters;
  struct ParticleRows;
  struct StateRows;

  // Loops run over blocks of pairs.  A block has as many pairs as a vector has doubles, at most BLOCK.  BLOCK spare particles
  // behind the owned and ghost particles fill up the last block of a particle.

  constexpr int BLOCK = 8;

  static_assert(NEIGHMASK < (1u << 29), "offsets of all neighbors have 32 bits");

  // Cohesion in pass 2.  strength: A^(1/2) w of owned, ghost, and spare particles, with A of the particle's type; nullptr: no
  // cohesion.  The rest is of CohesionKernel

  struct CohesionData {
    const double *strength;
    double support_inv[2], slope_norm[2];
  };

  // Input, output and scratch space of the two loops.  Pass 1 runs over a half neighbor list and stores the pairs inside the
  // support, and F of each pair, for pass 2.

  struct LoopData {
    int inum;
    const int *ilist, *numneigh;
    const int *const *firstneigh;

    const Particle *particle;    // owned and ghost
    int spare;                   // index of the first spare particle
    const Spin *spin;            // owned and ghost (micropolar)
    const int *type;             // read if the coefficients differ between types
    const double *zeta_term;     // zeta cdot/c of each particle (bulk volume)
    const double *viscosity;     // mu of each particle, if mu is not constant
    const Excess *excess;        // owned and ghost; nullptr: no particle has an excess
    const double *weight;        // w, owned and ghost; nullptr if all w are 1 and no loop reads w
    double *divergence;          // -sum_j V_j F r_ij.u_ij, accumulated by pass 2 (bulk volume)
    DensitySum *density;         // owned and ghost, accumulated by pass 1
    ForceSum *force;             // owned and ghost, accumulated by pass 2
    double *side;                // ChannelSums::rows, owned and ghost, accumulated by pass 2

    const Parameters *par;

    // pairs of the ii-th atom of ilist: entries first[ii] ... first[ii] + count[ii] - 1; the first entry is begin

    bigint begin;
    bigint *first;
    int *count;
    Offset *neighbor;
    double *slope;     // F, or nullptr: pass 2 computes F again
    double *square;    // F (e.u)^2, if mu is not constant

    CohesionData cohesion;     // of pass 2
    const NoiseData *noise;    // of pass 2 with noise
    double *random;            // room for the random numbers of the pairs of one particle
    PairTally *tally;          // nullptr: none
  };

  typedef void (*Loop)(LoopData &);
  typedef void (*NoiseLoop)(const LoopData &, const NoiseData &);
  typedef void (*FlowLoop)(const LoopData &, const FlowRow *, double *rate);
  typedef void (*RateLoop)(const LoopData &, const double *vol, double *rate);
  typedef void (*DiffusionLoop)(const LoopData &, const DiffusionData &, double *sums);
  enum class DiffusionPart { SUMS, FLOW };    // sums for the gradient; flow, with the gradient

  // PlaceColumns: positions and indices of particles sorted into cells.  CandidateColumns: the same of candidates for
  // neighbors, relative to the corner of a cell.  Both have room for a vector of 16 numbers behind the last entry

  struct PlaceColumns {
    const double *x[3];
    const int *index;
  };

  struct CandidateColumns {
    float *x[3];
    int *index;
    int n;
  };

  // Limits of the squared distances of candidates from a place, in cutoffs of the list.  Close candidates are below close,
  // far candidates between close and bound.  Below safe, rounding errors cannot move a candidate beyond the cutoff

  struct Reach {
    float close, safe, bound;
  };
  struct Found {
    int *close, *far;    // indices of close and far candidates, written to
    int nclose, nfar;
    bool doubt;    // a far candidate is not below safe
  };

  // Loops over the pairs of fluid and boundary particles of one thread

  struct BoundaryRows;
  struct BoundarySumData;
  struct BoundaryHeatData;
  struct NearKernel;
  struct Surface;
  struct BoundaryLoops {
    void (*pairs)(const LoopData &, BoundaryRows &);    // finds the pairs inside the support
    // add the parts of the NearKernel supports of fluid particles that boundary particles fill
    void (*filled)(const BoundaryRows &, const NearKernel *, double *filled);
    // add the sums over the fluid, without [0] and with [1] spins
    void (*sums[2])(const LoopData &, const BoundaryRows &, const BoundarySumData &);
    void (*heat_sums)(const LoopData &, const BoundaryRows &, const BoundaryHeatData &);
  };

  // The loops compiled for one instruction set

  struct LoopSet {
    const char *name;
    bool computes_slopes;    // pass 2 can compute F again, without spins
    // pass 1: stores the pairs inside the support; slopes: also F; squares: also F (e.u)^2, for the rates of shear
    Loop (*density)(Kernel, Volume, bool slopes, bool squares);
    Loop (*rates)(Volume);
    RateLoop shear_rates;
    Loop (*forces)(const Terms &, Bulk, Volume);
    int (*channels)(const Terms &);    // returns the bits of the channels that these terms heat
    Loop (*noisy_forces)(const NoiseForm &);
    NoiseLoop (*noise_sums)(const NoiseForm &);
    NoiseLoop (*shared_work)(const NoiseForm &);
    void (*particle_numbers)(const NoiseData &, NoiseChannel, int from, int to, int n, int count,
                             double *numbers);
    FlowLoop (*flow)(bool alike);    // alike: all particles with a volume have one coefficient
    DiffusionLoop (*diffusion)(DiffusionPart, int dim, bool alike);    // alike: one impedance
    BoundaryLoops (*boundary)(Kernel);
    // set slope = F (surface_factor() - less) of the pairs in some of the rows
    void (*surface_slopes)(const LoopData &, const BoundaryRows &, const std::vector<int> &some,
                           const Surface *, double less, double *slope);
    // take (x - corner) * scale
    void (*take_candidates)(const PlaceColumns &, int from, int to, const double *corner,
                            double scale, CandidateColumns &);
    // find the candidates around a place
    void (*near)(const CandidateColumns &, const float *place, const Reach &, Found &);
  };

  extern const LoopSet loops_plain, loops_avx2, loops_avx512;

  // Sums of pass 2 for each particle: torque (micropolar), then the heat per time of each channel but the first.  ForceSum
  // has the heat of the first channel.

  struct ChannelSums {
    ChannelColumns columns = {false, 0};
    int width = 0;    // numbers in a row
    std::vector<double> rows;

    void set(const ChannelColumns &wanted)
    {
      columns = wanted;
      width = columns.width();
    }
    void resize(std::size_t n) { rows.resize(n * width); }
    double *torque(int i) { return rows.data() + (std::size_t) i * width; }
    const double *torque(int i) const { return rows.data() + (std::size_t) i * width; }
    // add_heat(): add the heat of each channel but the first to heat[]; heat(): return the sum over these channels
    void add_heat(int i, double *heat) const
    {
      for (int c = 1; columns.bits >> c; c++)
        if (columns.heats(c)) heat[c] += torque(i)[columns.heat(c)];
    }
    double heat(int i) const
    {
      double sum = 0.0;
      for (int k = columns.spins ? 3 : 0; k < width; k++) sum += rows[(std::size_t) i * width + k];
      return sum;
    }
    void clear(int i) { std::fill_n(rows.begin() + (std::size_t) i * width, width, 0.0); }
    double memory_usage() const { return bytes(rows); }
  };

  // Some of the pairs that pass 1 has found, as input of pass 2: begin(); for each row add_row(), add() its pairs, end_row()

  class SurfacePairs;

  class PairSubset {
   public:
    void begin();
    void add_row(int i);
    void add(int j, double slope);
    void end_row(int spare);    // fills up the last block
    double memory_usage() const { return bytes(rows, count, neighbor, first, slope); }

    // Call function(i) for all particles of the pairs, once or more often, and for spare particles
    template <class Function> void visit(Function &&function) const
    {
      for (const int i : rows) function(i);
      for (const Offset j : neighbor) function(index_of(j));
    }

   private:
    friend class Engine;
    std::vector<int> rows, count;
    std::vector<Offset> neighbor;
    std::vector<bigint> first;
    std::vector<double> slope;
  };

  // Values that stages of a step set for later stages, besides the arrays of the engine
  struct StepData {
    int not_fluid = 0;       // bits of groups whose particles have no drag: walls and open zones
    StepNoise noise = {};    // in pass 2
    PairTally *tally = nullptr;    // of each pair in pass 2
    bigint nbeyond = 0;    // owned particles with a bulk term beyond the bound of LimitStage
  };

  // Pair engine of the particle fluid styles: pass 1, a loop over the neighbor list, sums number density and its rate; pass
  // 2 sums forces and heating.  In between, the stages set the input of pass 2.  Each thread has some rows of the neighbor
  // list and its own sums, which the engine adds up at the end; loops with a tally of each pair run on one thread.

  class Engine : protected Pointers {
   public:
    Engine(class LAMMPS *);
    ~Engine() override;

    // Choose the loops: simd = auto, for the widest vectors of this processor; none, avx2, or avx512.  Return false if
    // processor or compiler do not have these instructions
    bool choose_loops(const std::string &simd);

    void set_threads(Threads *team) { threads = team; }    // the caller owns the team
    Threads &team() const { return *threads; }
    const LoopSet &loop_set() const { return *loops; }
    template <class Task> void for_each(int n, const Task &task) { threads->for_each(n, task); }

    // Choose the loops for these parameters, which the loops read until the next call
    void setup(const Parameters &);

    // Make room for owned and ghost atoms, and set rows() for these atoms, for stages of the host while the loops run on a
    // device
    void prepare_rows(const std::vector<int> &);

    // Pass 1: set particle[] from atom->x and vest (nullptr: zero), spin[] from omegaest (micropolar; nullptr: zero).  Sum
    // density[] of owned atoms (with the particle itself) and the contributions to ghost atoms.  slopes_read: stages, or
    // loops other than the loop of the forces, read F
    void accumulate_density(NeighList *, double **vest, double **omegaest, bool slopes_read);

    // Sum cdot of density[] again, over the pairs of pass 1.  The caller has set the velocities in particle[] of owned and
    // ghost atoms
    void accumulate_rates();

    // Pass 2: sum force[] and side, and add the drag of single particles.  The caller has set vol and g in particle[] of
    // owned and ghost atoms
    void accumulate_forces(NeighList *, const StepData &);

    // Add to noise.total, which has room for owned, ghost, and spare particles: before pass 2 the sums for the noise, by
    // accumulate_numbers(); after pass 2 the heat that partners share, by accumulate_work()
    void accumulate_numbers(const NoiseForm &, const NoiseData &noise);
    void accumulate_work(const NoiseForm &, const NoiseData &noise);

    // Draw count random numbers for each of the first n atoms: number k of atom i is numbers[k * (n + BLOCK) + i]
    void draw_numbers(const NoiseData &, NoiseChannel, int n, int count, double *numbers);

    // Sum as accumulate_forces(), but without noise and linear in the velocities: the streams of the drag are 0
    void accumulate_friction(NeighList *, int not_fluid);

    // After pass 2, on this thread: sum the friction of the pairs in these rows, with these values of F and the noise of
    // surfaces (nullptr: none)
    void accumulate_friction(SurfacePairs &, BoundaryRows &, double *slope, PairTally *,
                             const StepNoise *, int thread);

    // Set rates of owned and ghost atoms, with room for spare particles, to sum_j V_j F (e.u)^2, from V in particle[] and F
    // (e.u)^2 of pass 1.  set_square(): compute F (e.u)^2 of a pair from other velocities in particle[]
    void accumulate_shear_rates(std::vector<double> &rates);
    void set_square(int i, int j, bigint entry);

    // Sum the rates of owned and ghost atoms, with room for spare particles, by flow[place], place in the list Flows
    void accumulate_flow(int place, std::vector<double> &rate);

    // Sum the diffusion of volume: width numbers for each owned and ghost atom, with room for spare particles
    void accumulate_diffusion(DiffusionPart, const DiffusionData &, int width,
                              std::vector<SumBlock> &sums);

    // After pass 2: add forces, torques, heat and divergence of these pairs, or their flow, to arrays with room for the
    // spare particles; without noise
    void accumulate_forces(PairSubset &, ForceSum *, ChannelSums &, double *divergence);
    void accumulate_flow(int place, PairSubset &, double *rate) const;

    // Add the drag of an owned particle to its force and, by channel, its heat per time; relative to rest if linear, and in
    // a minimization, which has no velocities
    void add_drag(int i, int not_fluid, bool linear, double *force_of, double *heat) const;
    bool has_forces() const;    // force[] belongs to the present owned and ghost atoms

    // The pairs inside the support that pass 1 has found, for the sums of stages.  visit_pairs(): call function(i, j, entry)
    // for each pair, or for each pair in row ii of the neighbor list
    const LoopData &pairs() const { return data; }
    double slope(int i, int j, bigint entry) const    // F
    {
      return data.slope ? data.slope[entry] : slope_of(i, j);
    }
    template <class Function> void visit_pairs(Function &&function) const
    {
      for (int ii = 0; ii < data.inum; ii++) visit_pairs(ii, function);
    }
    template <class Function> void visit_pairs(int ii, Function &&function) const
    {
      const int i = data.ilist[ii];
      const bigint end = data.first[ii] + data.count[ii];
      for (bigint entry = data.first[ii]; entry < end; entry++)
        function(i, index_of(data.neighbor[entry]), entry);
    }

    // Sum over these pairs on all threads, each with its rows of the neighbor list.  function(i, j, entry, sum) adds to
    // sum[0] ... sum[n - 1]; sum is total, or is added to total later
    template <class Function> void sum_pairs(double *total, std::size_t n, Function &&function)
    {
      scalar_sums.run(*threads, total, n, [&](int k, double *sum) {
        for (int ii = first_row[k]; ii < first_row[k + 1]; ii++)
          visit_pairs(ii, [&](int i, int j, bigint entry) {
            function(i, j, entry, sum);
          });
      });
    }

    const Parameters &parameters() const { return *par; }
    const Constants &constants() const { return *fixed; }    // of these parameters
    // Rows of owned and ghost atoms between the passes; valid from pass 1 until atoms move to other processors
    const ParticleRows &rows() const { return *atom_rows; }
    StateRows states() const;    // of the owned atoms as they are now
    // reference volume of a particle, owned or ghost
    double weight(int i) const { return data.weight ? data.weight[i] : 1.0; }
    bool has_spin() const { return fixed->spins(); }
    double memory_usage() const;
    const char *instruction_set() const { return loops->name; }

    Particle *particle = nullptr;
    DensitySum *density = nullptr;
    ForceSum *force = nullptr;
    ChannelSums side;
    // fields of messages, without numbers if there are no spins
    Field torques() { return {side.rows.data(), (std::size_t) side.width, has_spin() ? 3 : 0}; }
    Field spins() { return field(spin, has_spin() ? spin->w : nullptr, has_spin() ? 3 : 0); }
    double *zeta_term = nullptr;         // zeta cdot/c, set by the caller on owned and ghost atoms
    double *state_pressure = nullptr;    // owned and ghost atoms; unset without states
    std::vector<std::vector<FlowRow>> flow;    // of owned and ghost atoms, by place in Flows
    std::vector<FlowRow> &heat() { return flow[HEAT_FLOW]; }
    std::vector<std::vector<double>> flow_rate;    // rates of each flow in the last forces
    std::vector<double> viscosity;                 // mu of atoms, if any mu is not constant
    std::vector<double>
        energy;    // internal energy of owned and ghost atoms, if particles have temperatures (temp energy)
    void set_wall_energy(const double *);    // energy in the forces of walls, of owned atoms
    void forget_wall_energy();
    std::vector<Excess> excess;      // of owned and ghost atoms; empty: no particle has an excess
    std::vector<double> strength;    // of cohesion in the last forces, see CohesionData

    // Group bits of bodies; keeps_bodies: the next densities do not change rho of bodies, see ParticleRows::add_offset()
    int body_bits = 0;
    bool keeps_bodies = false;
    double *divergence =
        nullptr;    // -sum_j V_j F r_ij.u_ij, divergence of the velocity; bulk volume only, by pass 2
    Spin *spin = nullptr;    // micropolar only

   private:
    mutable std::vector<double> wall_energy;         // empty: no energy
    mutable std::vector<tagint> wall_energy_tags;    // IDs of the atoms of wall_energy
    void follow_atoms() const;                       // sorts wall_energy by the present owned atoms
    const LoopSet *loops = &loops_plain;
    const Parameters *par;
    const Constants *fixed;
    Loop rate_loop = nullptr, force_loop = nullptr;
    LoopData data = {};
    const std::unique_ptr<ParticleRows> atom_rows;
    Threads one_thread, *threads = &one_thread;
    double *weights = nullptr;    // reference volumes of atoms
    std::vector<double> square, volume;
    std::vector<int> types;    // of owned, ghost, and spare particles, if their coefficients differ

    // thread k has the rows first_row[k] ... first_row[k+1] - 1 of the neighbor list; its pairs begin at entry first_pair[k]

    std::vector<int> first_row;
    std::vector<bigint> first_pair;
    std::vector<std::vector<double>>
        random;    // numbers of the pairs of one particle, of each thread
    ThreadSums<DensitySum> density_sums;
    ThreadSums<ForceSum> force_sums;
    ThreadSums<double> side_sums;
    ThreadSums<double> scalar_sums;    // for all other sums

    double *slopes = nullptr;    // F of pairs, if pass 1 leaves them

    int nlocal_forces = -1, nghost_forces = -1;    // # of atoms at the last pass 2
    int nmax = 0, nmax_weights = 0, imax = 0;
    bigint pair_max = 0, slope_max = 0;

    double slope_of(int i, int j) const;
    void grow_atoms();
    void set_rows();
    void grow_flows();
    void grow_weights();
    void set_weights();
    void grow_pairs(NeighList *, bool leaves_slopes);
    LoopData part(int thread) const;    // the rows of the neighbor list of this thread
    LoopData part(PairSubset &) const;
    double *room_for_numbers(int thread, const LoopData &);
    void run_density(Loop);
    void run_noise(NoiseLoop, const NoiseData &);
    CohesionData cohesion();    // sets strength
    void run_forces(NeighList *, const StepData &, bool linear);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
