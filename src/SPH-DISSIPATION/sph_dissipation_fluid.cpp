/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#include "sph_dissipation_fluid.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "group.h"
#include "math_extra.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_hybrid.h"
#include "sph_dissipation_boundary_stage.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_contact.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_eos.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_kernel.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_neighbors.h"
#include "sph_dissipation_noise.h"
#include "sph_dissipation_open_stage.h"
#include "sph_dissipation_pair_energy.h"
#include "sph_dissipation_particle_terms.h"
#include "sph_dissipation_stages.h"
#include "sph_dissipation_state.h"
#include "sph_dissipation_traces.h"
#include "sph_dissipation_viscous.h"
#include "timer.h"
#include "update.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// Largest viscous rate times time step without a warning: between the steps, a mode of this rate is 5 % too hot.

static constexpr double ACCURATE_NOISE = 0.1;

// Largest sqrt(kT/m)/c0 without a warning: the relative standard deviation of the density in the volume of a particle.

static constexpr double FAST_NOISE = 0.5;

// Data that stages leave for later ones, see list_stages() and the design page

static constexpr int NOTHING = 0, RANDOM = 1, MOTION = 2, VOLUMES = 4, SLOPES = 8,
                     WALL_VOLUMES = 16, BOUNDS = 32, VISCOSITIES = 64, PRESSURES = 128, WALLS = 256,
                     SUMS = 512, FORCES = 1024, TEMPERATURES = 2048;

/* ---------------------------------------------------------------------- */

Fluid::Fluid(LAMMPS *lmp, Pair *pair, bool spins) :
    Pointers(lmp), pair(pair), spins(spins), style(spins ? "sph/micropolar" : "sph/bulk"),
    model(new FluidModel(lmp, style, spins)), engine(new Engine(lmp)),
    exchange(new Exchange(lmp, pair)), search(new NeighborSearch(lmp, *exchange)),
    host(new HostSpace(lmp, *engine, *exchange)), density(new DensityStage<HostSpace>(lmp, *host)),
    limit(new LimitStage<HostSpace>(lmp, *host)),
    viscosity(new ViscosityStage<HostSpace>(lmp, *host)),
    pressure(new PressureStage<HostSpace>(lmp, *host)),
    forces(new ForceStage(lmp, *engine, *exchange)), state(new StateStage<HostSpace>(lmp, *host)),
    flows(new FlowStage<HostSpace>(lmp, *host)),
    diffusion(new DiffusionStage<HostSpace>(lmp, *host)),
    pair_energies(new PairEnergyStage(lmp, *engine, *exchange)),
    open(new OpenStage(lmp, *engine, *exchange)),
    boundary(new BoundaryStage(lmp, *engine, *exchange, style)),
    contact(new ContactStage(lmp, *engine, *exchange, *boundary, style)),
    shift(new ShiftStage<HostSpace>(lmp, *host)),
    noise(new NoiseStage(lmp, *engine, *exchange, model->clock)),
    viscous(new ViscousStage(lmp, *engine, *exchange, *pressure, *boundary)),
    temperature(new TemperatureStage(lmp, *engine, *exchange, *boundary))
{
}

Fluid::~Fluid() = default;

/* ----------------------------------------------------------------------
   Read the arguments of pair_style.
------------------------------------------------------------------------- */

void Fluid::settings(int narg, char **arg)
{
  model->settings(narg, arg);

  if (!over_all<int>(world, engine->choose_loops(model->simd), MPI_MIN))
    error->all(FLERR,
               "Pair_style {} simd {}: not in this processor, or not in this executable of LAMMPS",
               style, model->simd);
  announced = set_up = false;
}

/* ----------------------------------------------------------------------
   Read the arguments of pair_coeff.
------------------------------------------------------------------------- */

void Fluid::coeff(int narg, char **arg)
{
  model->adopt();    // keep the coefficients that other commands have set
  model->coeff(narg, arg, pair->setflag);
  announced = set_up = false;
}

/* ---------------------------------------------------------------------- */

void Fluid::init()
{
  continued = false;
  shift->movers.clear();
  integrated = 0;
  for (const Fix *const fix : modify->get_fix_by_style("^" + style)) integrated |= fix->groupbit;
  viscous->configure(ViscousSettings(), 0, style);
  temperature->configure(ViscousSettings(), 0, style);
  check_setup();
  derive_coeffs();
  set_up = true;
}

/* ----------------------------------------------------------------------
   Request an occasional neighbor list, which NeighborSearch fills, or, with a line in the log, one that LAMMPS builds.
------------------------------------------------------------------------- */

void Fluid::request_list()
{
  const std::string reason = search->left_to_lammps();
  own_list = reason.empty();
  if (!own_list) {
    if (comm->me == 0)
      utils::logmesg(lmp, "Pair style {}: LAMMPS builds the neighbor list because of {}\n", style,
                     reason);
    neighbor->add_request(pair);
    return;
  }
  search->init(&engine->loop_set(), &engine->team(), support);
  neighbor->add_request(pair, NeighConst::REQ_OCCASIONAL);
}

NeighList *Fluid::neighbors()
{
  if (own_list) search->update(pair->list);
  return pair->list;
}

/* ---------------------------------------------------------------------- */

bool Fluid::is_set_up() const
{
  return pair->list && set_up;
}

/* ----------------------------------------------------------------------
   Set dim and support; stop with an error if the rest of the simulation does not fit the fluid.
------------------------------------------------------------------------- */

void Fluid::check_setup()
{
  if (spins && model->dimension() == 1)
    error->all(FLERR, Error::NOLASTLINE, "Pair_style {} needs dim 2 or 3: no spin in dim 1", style);
  const FluidChecks check(lmp, style, *model);
  check.styles();
  find_own_types();
  check.rerun();
  if (update->whichflag == 2 && model->choice.eos == Eos::IDEAL)
    error->all(FLERR,
               "Pair style {} with eos ideal cannot be used in a minimization: its energy depends "
               "on the heat of the particles, not on their positions alone",
               style);
  for (int i = 1; i <= atom->ntypes && update->whichflag == 2; i++)
    if (has_type(i) && TypeCoeffs(model->coeffs[i].keywords).gamma() > 0.0)
      error->all(
          FLERR,
          "Pair style {} with gruneisen cannot be used in a minimization: its energy depends "
          "on the heat of the particles, not on their positions alone",
          style);
  if (model->choice.thermal) check.noise();
  dim = model->dimension();
  support = model->common_support(pair->setflag);
  check.fluid_lists();
  check.room();
  check.support(dim, support);
  if (!announced) check.skin(dim, support);
  if (spins) check.spins();
}

/* ----------------------------------------------------------------------
   Set TypeCoeff::other of the types of other styles of pair_style hybrid, even if a type also has coefficients here; stop if
   this style acts between such a type and another one.
------------------------------------------------------------------------- */

void Fluid::find_own_types()
{
  auto *hybrid = dynamic_cast<PairHybrid *>(force->pair);
  std::string name = style;
  auto ours = [&](int i, int j) {
    return pair->setflag[i][j] && (!hybrid || hybrid->check_ijtype(i, j, &name[0]));
  };

  model->shared = false;
  for (int i = 1; i <= atom->ntypes; i++) {
    model->coeffs[i].other = !ours(i, i);
    if (model->coeffs[i].other) model->shared = true;
  }
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i + 1; j <= atom->ntypes; j++)
      if (ours(i, j) && (model->coeffs[i].other || model->coeffs[j].other))
        error->all(
            FLERR, Error::NOLASTLINE,
            "Pair style {} acts between types {} and {}, but type {} has no coefficients of it",
            style, i, j, model->coeffs[i].other ? i : j);
}

/* ----------------------------------------------------------------------
   Warn, on rank 0, of two types of this fluid whose pairs belong to other styles of pair_style hybrid only.
------------------------------------------------------------------------- */

void Fluid::check_all_interact()
{
  auto *const hybrid = dynamic_cast<PairHybrid *>(force->pair);
  if (!hybrid || comm->me != 0) return;
  std::string name = style;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i + 1; j <= atom->ntypes; j++)
      if (has_type(i) && has_type(j) && !hybrid->check_ijtype(i, j, &name[0])) {
        error->warning(FLERR,
                       "Pair style {}: particles of types {} and {} do not interact, since "
                       "pair_coeff gives these types to other styles only; use pair_coeff {} {} {}",
                       style, i, j, i, j, style);
        return;
      }
}

/* ----------------------------------------------------------------------
   Derive the parameters of the loops from the coefficients that the commands have set.
------------------------------------------------------------------------- */

void Fluid::derive_coeffs()
{
  stale = false;
  if (model->adopt()) announced = false;
  stages.clear();
  viscous->forget_rates();
  temperature->forget_rates();
  model->derive(dim, support);
  engine->setup(model->parameters());
}

/* ----------------------------------------------------------------------
   Take over coefficients that another command, such as fix adapt, has changed; during a run, warn of a time step that is
   too large now, unless fix sph/dt sets the time step.
------------------------------------------------------------------------- */

void Fluid::adopt()
{
  if (!stale) return;
  derive_coeffs();
  if (!update->setupflag && update->whichflag == 1 && !step_follows())
    check_time_step(coeff_table());
}

/* ---------------------------------------------------------------------- */

bigint Fluid::compute(PairTally *tally)
{
  begin_forces();
  StepData step;
  step.not_fluid = not_fluid();
  const bool timed = timer->has_full() && !update->setupflag;
  if (timed && times.size() != stages.size()) times.assign(stages.size(), {});
  for (std::size_t k = 0; k < stages.size(); k++) {
    const double begin = timed ? platform::walltime() : 0.0;
    step.tally = stages[k].trial ? nullptr : tally;
    stages[k].run(step);
    if (!timed) continue;
    fence();
    times[k].name = stages[k].name;
    times[k].seconds += platform::walltime() - begin;
    times[k].calls++;
  }
  changed = false;
  if (update->setupflag) stages.clear();    // later forces have others
  return step.nbeyond;
}

/* ----------------------------------------------------------------------
   Check the particles of a new neighbor list and of the first forces of a run, update the list, and list the stages.
------------------------------------------------------------------------- */

void Fluid::begin_forces()
{
  const FluidChecks check(lmp, style, *model);
  if (neighbor->ago == 0) {
    check.masses();
    if (checks_speed()) check_speed();
    if (checks_expansion()) check_expansion();
  }
  if (update->setupflag) {
    check.numbers();
    viscous->begin_run();
    temperature->begin_run();
  }
  remember_densities();
  if (own_list && search->update(pair->list)) timer->stamp(Timer::NEIGH);
  if (stages.empty()) list_stages();
}

/* ---------------------------------------------------------------------- */

Fluid::Forces Fluid::kind() const
{
  if (!update->setupflag) return Forces::LATER;
  if (!continued) return Forces::FIRST;
  return changed ? Forces::CHANGED : Forces::REPEATED;
}

/* ----------------------------------------------------------------------
   List the stages of the next forces, each with its condition, name, the data that it needs of earlier stages, and those that
   it leaves.  An implicit step first needs the forces of a trial; repeated forces have its solution from the last run.
------------------------------------------------------------------------- */

void Fluid::list_stages()
{
  const std::uint64_t hash = model->hash();
  changed = changed || hash != model->hash_of_forces;
  model->hash_of_forces = hash;
  stages.clear();
  if (!pair_energies->active()) pair_energies->forget();

  const Constants &par = model->constants();
  const bool walls = !boundary->empty(), zones = !open->empty(), noisy = par.thermal,
             warm = par.own_temperatures, solves = kind() != Forces::REPEATED,
             stiff = viscous->active() && solves,
             stiff_heat = temperature->active() && par.conducts() && solves;
  const int bits = boundary->bits(), all_bits = not_fluid();
  NeighList *const list = pair->list;
  bool trial = false;
  int left = MOTION | TEMPERATURES;    // by the integrator
  const auto add = [&](bool listed, const char *name, int needs, int leaves,
                       const std::function<void(StepData &)> &run) {
    if (!listed) return;
    assert(!(needs & ~left));
    left |= leaves;
    stages.push_back({name, needs, trial, run});
  };
  const auto call = [](auto &stage, auto function, auto... args) {
    return [=, &stage](StepData &) {
      (stage.*function)(args...);
    };
  };
  const auto add_wall_volumes = [&](bool listed) {
    add(listed, "wall volumes", VOLUMES, WALL_VOLUMES,
        call(*boundary, &BoundaryStage::set_reference_volume));
  };
  const auto add_passes = [&](bool rates) {
    add(true, "densities", MOTION, VOLUMES | SLOPES, call(*this, &Fluid::sum_density));
    add_wall_volumes(walls && noisy);    // the bound of the noise is with these volumes
    add(par.limit != Limit::NO, "bound", VOLUMES | SLOPES, BOUNDS,
        call(*limit, &LimitStage<HostSpace>::run));
    add_wall_volumes(walls && !noisy);
    add(par.by_rate && rates, "shear rates", VOLUMES, VISCOSITIES,
        call(*this, &Fluid::find_viscosities));
    add(par.by_rate && !rates && !stiff, "kept viscosities", VOLUMES, VISCOSITIES,
        call(*viscosity, &ViscosityStage<HostSpace>::keep));
    add(true, "pressures", VOLUMES, PRESSURES, [this, bits](StepData &step) {
      step.nbeyond = pressure->run(bound(), bits);
    });
    add(zones, "zones", PRESSURES, PRESSURES, call(*open, &OpenStage::run));
    add(walls, "walls", PRESSURES | WALL_VOLUMES, WALLS,
        call(*boundary, &BoundaryStage::run, list));
    add(walls && warm, "wall energies", WALLS, TEMPERATURES, [this](StepData &) {
      boundary->find_energies(missing_time());
    });
    add(noisy, "noise", RANDOM | SLOPES | PRESSURES, PRESSURES, [this, bits](StepData &step) {
      step.noise = noise->run(bound(), bits, kind() != Forces::FIRST);
    });
    add(true, "pairs", PRESSURES, SUMS, [this, list](StepData &step) {
      engine->accumulate_forces(list, step);
    });
    add(boundary->has_symmetric_friction(), "wall friction", WALLS | SUMS, SUMS,
        [this](StepData &step) {
          boundary->add_friction(step.tally, step.noise);
        });
    add(pair_energies->active(), "tension", VOLUMES | SUMS, SUMS, [this, list](StepData &step) {
      pair_energies->run(list, step.tally);
    });
    add(true, "forces", SUMS, FORCES, call(*forces, &ForceStage::run, all_bits));
    add(walls && (noisy || par.continuity), "repulsion", WALLS | FORCES, FORCES,
        [this](StepData &step) {
          boundary->repel(step.tally);
        });
  };
  const auto add_temperatures = [&](bool listed) {
    add(listed, "temperatures", SLOPES | FORCES, TEMPERATURES,
        call(*this, &Fluid::find_temperature));
  };

  add(noisy, "numbers", NOTHING, RANDOM, call(*noise, &NoiseStage::begin_step, bits));
  if (stiff) {
    trial = true;
    add(true, "guess", NOTHING, MOTION, [this, all_bits](StepData &) {
      viscous->begin(all_bits, extrapolated_spin(), spins ? Fields::of(atom)->inertia : nullptr);
    });
    add_passes(true);
    add(true, "velocities", SLOPES | FORCES, MOTION, call(*this, &Fluid::find_velocity));
  }
  if (stiff_heat && par.thermal_pressure) {
    trial = true;
    add(true, "aside", NOTHING, NOTHING, call(*temperature, &StiffStage::set_aside));
    add_passes(!viscous->active());
    add_temperatures(true);
    add(true, "restored", NOTHING, NOTHING, call(*temperature, &StiffStage::restore));
  }
  trial = false;
  add_passes(!viscous->active());    // else the viscosities are those of the guess
  add_temperatures(stiff_heat && !par.thermal_pressure);    // no force depends on heat
  add(par.loops_of_flows, "flows", SLOPES | FORCES, FORCES, [this](StepData &) {
    flows->run([this]() {
      boundary->add_surface_heat(engine->flow_rate[HEAT_FLOW]);
    });
  });
  if (par.delta > 0.0 && update->whichflag != 2) {
    add(true, "diffusion", SLOPES | PRESSURES, NOTHING, [this, all_bits](StepData &) {
      if (diffusion_is_due()) diffusion->evaluate(all_bits, integrated);
    });
    add(true, "diffusion heat", FORCES, FORCES,
        call(*diffusion, &DiffusionStage<HostSpace>::add_heat, all_bits, integrated));
  }
  add(zones, "ledger", SLOPES | PRESSURES, NOTHING, call(*open, &OpenStage::sum_impacts, list));
  add(viscous->active() || warm, "totals", SUMS, SUMS, call(*forces, &ForceStage::collect));
  add(warm, "work", SUMS | FORCES, FORCES, call(*noise, &NoiseStage::share_work));
  add(boundary->has_contact(), "contact", WALLS | FORCES, FORCES,
      call(*contact, &ContactStage::run));
}

/* ---------------------------------------------------------------------- */

void Fluid::finish()
{
  if (times.empty()) return;
  std::string lines;
  double own = timer->get_wall(Timer::TOTAL), total = 0.0;
  MPI_Reduce(&own, &total, 1, MPI_DOUBLE, MPI_SUM, 0, world);
  total /= comm->nprocs;
  for (StageTime &one : times) {
    double least, mean, most;
    MPI_Reduce(&one.seconds, &least, 1, MPI_DOUBLE, MPI_MIN, 0, world);
    MPI_Reduce(&one.seconds, &mean, 1, MPI_DOUBLE, MPI_SUM, 0, world);
    MPI_Reduce(&one.seconds, &most, 1, MPI_DOUBLE, MPI_MAX, 0, world);
    mean /= comm->nprocs;
    lines += fmt::format("{:<15} | {:<10} | {:<10.5g} | {:<10.5g} | {:<10.5g} |{:6.2f}\n", one.name,
                         one.calls, least, mean, most, 100.0 * mean / total);
  }
  if (comm->me == 0)
    utils::logmesg(
        lmp,
        "\nStages of pair style {}:\n{:<15} |   calls    |  min time  |  avg time  |  max "
        "time  |%total\n{}\n{}",
        style, "Stage", std::string(71, '-'), lines);
  times.clear();
}

/* ----------------------------------------------------------------------
   Set viscosities that are not constant, from the rates of shear of the present velocities.  For the rates, boundary
   particles have the velocity of the extended fluid; later their own.
------------------------------------------------------------------------- */

void Fluid::find_viscosities()
{
  if (boundary->empty()) return viscosity->run(0);
  const int nall = atom->nlocal + atom->nghost;
  Particle *const particle = engine->particle;
  engine->for_each(nall, [&](int i) {
    particle[i].g = engine->zeta_term[i] = 0.0;
  });
  boundary->run(neighbors());
  boundary->set_squares();
  viscosity->run(boundary->bits());
  const bool moves = update->whichflag != 2;
  engine->for_each(nall, [&](int i) {
    if (!is_boundary(i)) return;
    for (int d = 0; d < 3; d++) particle[i].u[d] = moves ? atom->vest[i][d] : 0.0;
  });
  boundary->set_reference_volume();
}

/* ----------------------------------------------------------------------
   Check, at the first forces of a run, for particles in the same place, by the pairs of pass 1.
------------------------------------------------------------------------- */

void Fluid::check_places()
{
  if (!checks_places) return;
  checks_places = false;
  shared_places = FluidChecks(lmp, style, *model).places(*engine, support, shared_places);
}

/* ----------------------------------------------------------------------
   Run pass 1.  In a minimization, which minimizes the energy of the equation of state, all velocities are zero.
------------------------------------------------------------------------- */

void Fluid::sum_density()
{
  const bool minimize = (update->whichflag == 2);
  const bool slopes_read = viscous->active() || !shift->movers.empty() ||
      std::any_of(stages.begin(), stages.end(), [](const ListedStage &one) {
                             return one.needs & SLOPES;
                           });
  density->run(neighbors(), minimize ? nullptr : atom->vest,
               minimize ? nullptr : extrapolated_spin(), at_rest(), missing_time(), not_fluid(),
               slopes_read);
  check_places();
}

/* ----------------------------------------------------------------------
   Return the time for which internal energies lack the work of the pressure.  In a step, energies are half a step behind.
   Their last rate has the velocities of half a step before, unless NoiseStage::share_work() corrects the rate.
------------------------------------------------------------------------- */

double Fluid::missing_time() const
{
  if (kind() == Forces::FIRST) return 0.0;
  return (noise->shares_work() ? 0.5 : 1.0) * update->dt;
}

bool Fluid::at_rest() const
{
  return update->whichflag == 2 || is_rerun(lmp);
}

/* ---------------------------------------------------------------------- */

void Fluid::begin_run(double dt, bool continues, const Changes &changes)
{
  continued = continues;
  set_step(dt);
  flows->forget();
  checks_places = true;
  follows =
      model->choice.continuity && changes.places_alone() && model->hash() == model->hash_of_forces;
  if (!follows) keep_densities();
  const FluidChecks check(lmp, style, *model);
  check.kept_states(changes, follows);
  if (Fields::of(atom)->slots.empty()) return;
  check.states();
  const auto [others, places] = state->keep();
  if (!others || comm->me != 0) return;
  std::vector<std::string> names;
  for (const int slot : Fields::of(atom)->slots)
    if (places >> slot & 1) names.push_back("d_" + Fields::state_name(slot));
  error->warning(FLERR,
                 "Pair style {}: {} particles have {}, which their type does not have and which is "
                 "lost; states of its own begin anew",
                 style, others, utils::join_words(names, ", "));
}

/* ---------------------------------------------------------------------- */

void Fluid::remember_densities()
{
  if (follows && densities_before.empty())
    densities_before.assign(atom->rho, atom->rho + atom->nlocal);
}

void Fluid::keep_densities()
{
  double *const sum = Fields::of(atom)->rho_sum;
  for (int i = 0; i < atom->nlocal; i++) sum[i] = std::min(sum[i], 0.0);
  engine->keeps_bodies = true;
}

void Fluid::begin_step(double dt)
{
  if (look_after > 0.0 && (moving += dt) > look_after)
    for_report([this]() {
      FluidState state(lmp, *engine, *exchange, *model);
      state.run(1, not_fluid(), pressures());
      check_elasticity(state);
    });
  if (!engine->constants().states) return;
  set_step(dt);
  advance_states();
}

void Fluid::set_step(double dt)
{
  if (dt != model->constants().step) model->set_step(dt);
}

/* ---------------------------------------------------------------------- */

void Fluid::advance_states()
{
  const auto random = model->choice.thermal ? noise->draw_for_states() : std::vector<double>();
  state->advance(not_fluid(), boundary->bits(), random.data(),
                 atom->nlocal ? random.size() / atom->nlocal : 0);
}

/* ---------------------------------------------------------------------- */

const double *Fluid::bound() const
{
  return (model->choice.limit != Limit::NO) ? limit->bound.data() : nullptr;
}

/* ---------------------------------------------------------------------- */

void Fluid::shift_in_step(double keep)
{
  shifted = !shift->movers.empty() && model->shift_age == 0;
  if (shift->movers.empty()) return;
  int &age = model->shift_age;
  if (shifted) shift_particles(keep);
  age = (age + 1 < shift->interval()) ? age + 1 : 0;
}

void Fluid::shift_particles(double keep)
{
  shift->run(keep);
}

/* ---------------------------------------------------------------------- */

double Fluid::received_heat(int groupbit) const
{
  if (!model->constants().conducts() || !pair->compute_flag) return 0.0;
  if (!model->choice.own_temperatures) return flows->received(groupbit);
  double total = 0.0;    // pass 2 leaves no other heat in desph
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) total += atom->desph[i];
  return total;
}

/* ----------------------------------------------------------------------
   Solve for the implicit velocities, after the passes of the guess.  The matrix is not symmetric if walls extend the velocity of the fluid, or with the
   form P1 (64), bulk volume.
------------------------------------------------------------------------- */

void Fluid::find_velocity()
{
  if (neighbor->ago == 0 || viscous->has_old_rates())
    viscous->set_rate(coeff_table().fastest_rate());
  const bool symmetric = !boundary->has_mean_pressure() && model->choice.bulk != Bulk::VOLUME;
  viscous->run(neighbors(), bound(), symmetric);
}

/* ----------------------------------------------------------------------
   Solve for the implicit temperatures, after pass 2, which gives the heat of friction.
------------------------------------------------------------------------- */

void Fluid::find_temperature()
{
  if (neighbor->ago == 0 || temperature->has_old_rates())
    temperature->set_rate(coeff_table().fastest_heat_rate());
  temperature->run(not_fluid());
}

/* ----------------------------------------------------------------------
   Count the steps to the next diffusion of volume.  Repeated forces keep the rates of the last run.
------------------------------------------------------------------------- */

bool Fluid::diffusion_is_due()
{
  int &age = model->diffusion_age;
  const Forces now = kind();
  if (now == Forces::LATER)
    age = (age + 1 < diffusion_interval()) ? age + 1 : 0;
  else if (now != Forces::REPEATED)
    age = 0;
  return age == 0;
}

/* ----------------------------------------------------------------------
   Return the number of steps between two evaluations: the largest n <= 3 with n * rate * dt <= 0.6, at least 1.
   rate = of the fastest mode of the diffusion, at the reference densities.
------------------------------------------------------------------------- */

int Fluid::diffusion_interval() const
{
  constexpr int MOST = 3;
  constexpr double CHANGE = 0.6;
  const double change = model->diffusion_rate() * update->dt;
  for (int n = MOST; n > 1; n--)
    if (n * change <= CHANGE) return n;
  return 1;
}

bool Fluid::diffusion_is_new() const
{
  return model->diffusion_age == 0;
}

/* ---------------------------------------------------------------------- */

double Fluid::energy(double *each_atom) const
{
  constexpr int ALL = 1;    // bit of the group
  double energy = pressure->elastic_energy(each_atom, not_fluid());
  if (!boundary->empty()) energy += wall_energy(each_atom);
  if (boundary->has_contact()) energy += contact->energy(each_atom);
  if (pair_energies->active()) energy += tension_energy(each_atom, ALL);
  return energy;
}

bool Fluid::has_pair_energy() const
{
  return model->has_pair_energy();
}

double Fluid::pair_energy(int groupbit) const
{
  return tension_energy(nullptr, groupbit);
}

double Fluid::tension_energy(double *each_atom, int groupbit) const
{
  return pair_energies->energy(each_atom, groupbit);
}

double Fluid::wall_energy(double *each_atom) const
{
  return boundary->energy(each_atom);
}

/* ---------------------------------------------------------------------- */

double Fluid::elastic_energy(Moment moment)
{
  if (moment == NOW) find_volumes();
  return pressure->elastic_energy(nullptr, not_fluid());
}

/* ---------------------------------------------------------------------- */

double Fluid::state_energy(int groupbits) const
{
  return engine->constants().states ? state->energy(groupbits, not_fluid()) : 0.0;
}

/* ----------------------------------------------------------------------
   Set the temperature of each owned particle; 0 for particles of walls, which have no internal energy, and of other styles.
------------------------------------------------------------------------- */

void Fluid::temperatures(double *temperature) const
{
  const StateRows states = engine->states();
  for (int i = 0; i < atom->nlocal; i++)
    temperature[i] = (has_type(atom->type[i]) && !is_boundary(i)) ? states.temperature(i) : 0.0;
}

/* ---------------------------------------------------------------------- */

void Fluid::set_temperature(int groupbit, const std::function<double(int)> &value,
                            const std::string &user)
{
  double *const desph_before = Fields::of(atom)->desph_before;
  on_host([&]() {
    remember_densities();
    density->run(neighbors(), nullptr, nullptr, not_fluid());
    if (!boundary->empty() && model->choice.own_temperatures)
      boundary->find_energies_at_rest(neighbors());
    const StateRows states = engine->states();
    const int zone_bits = open->bits_of(groupbit);
    const auto gets_one = [&](int i) {
      return (atom->mask[i] & (zone_bits | groupbit)) && has_type(atom->type[i]) && !is_boundary(i);
    };
    double wrong;
    const auto type_of = [&](int i) {
      return atom->type[i];
    };
    const auto without = [&](int i) {
      return gets_one(i) && model->heat_capacity(atom->type[i]) == 0.0;
    };
    const auto cannot_be = [&](int i) {
      return gets_one(i) && !(value(i) >= 0.0 && std::isfinite(value(i)));
    };
    if (!first_particle(lmp, without, type_of, wrong).empty())
      error->all(FLERR, "{} needs the heat capacity of type {}, keyword cv of pair_coeff", user,
                 wrong);
    if (!first_particle(lmp, cannot_be, value, wrong).empty())
      error->all(FLERR, "{} must be >= 0, not {}", user, wrong);
    for (int i = 0; i < atom->nlocal; i++) {
      if (!gets_one(i)) continue;
      const int type = atom->type[i];
      const bool in_zone = atom->mask[i] & zone_bits;
      const double temperature = value(i);
      desph_before[i] = 0.0;
      if (in_zone) {    // the density of the zone is not known yet
        atom->esph[i] = atom->rmass[i] * engine->parameters().type[type].heat(temperature);
        continue;
      }
      states.begin(i, temperature);
      atom->esph[i] = states.energy_at(i, temperature);
    }
  });
}

/* ---------------------------------------------------------------------- */

bool Fluid::checks_speed() const
{
  return fast_lists >= 0 && model->choice.eos != Eos::IDEAL && !model->choice.thermal;
}

/* ----------------------------------------------------------------------
   Warn once if over 10 % of the particles are faster than a limit at two successive neighbor lists: 0.1 c0 with density
   continuity (the density varies by 1 %), else 0.3 c0 (5 %, as in flows with sound).  Single drops of spray do not count.
   Without walls and open ends, speeds are relative to the center of mass.
------------------------------------------------------------------------- */

void Fluid::check_speed()
{
  constexpr double MANY = 0.1;                                   // part of the particles
  const double fast = (model->choice.continuity) ? 0.1 : 0.3;    // speed over c0
  bigint mine[2] = {0, 0}, all[2];
  double mean[3] = {0.0, 0.0, 0.0};
  if (boundary->empty() && open->empty()) group->vcm(0, group->mass(0), mean);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!has_type(atom->type[i]) || is_boundary(i)) continue;
    double v[3];
    MathExtra::sub3(atom->v[i], mean, v);
    mine[0]++;
    if (MathExtra::len3(v) > fast * model->coeffs[atom->type[i]].eos.c0) mine[1]++;
  }
  MPI_Allreduce(mine, all, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  fast_lists = (all[1] > MANY * all[0]) ? fast_lists + 1 : 0;
  if (fast_lists < 2) return;
  fast_lists = -1;
  if (comm->me == 0)
    error->warning(FLERR,
                   "Pair style {}: {} of {} particles are faster than {:g} c0: the liquid is "
                   "compressed; use a c0 of 10 times the largest speed",
                   style, all[1], all[0], fast);
}

/* ---------------------------------------------------------------------- */

bool Fluid::checks_expansion() const
{
  return !expanded && !model->constants().tension && !update->setupflag;
}

/* ----------------------------------------------------------------------
   Warn once if over half of the particles have densities below 0.9 times that at which the pressure ends.  Without tension,
   no force holds such a fluid together.  Spray is a small part of a fluid.
------------------------------------------------------------------------- */

void Fluid::check_expansion()
{
  constexpr double MANY = 0.5,
                   THIN = 0.9;    // part of the particles; density over rho_min
  bigint mine[2] = {0, 0}, all[2];
  for (int i = 0; i < atom->nlocal; i++) {
    if (!has_type(atom->type[i]) || is_boundary(i)) continue;
    mine[0]++;
    if (atom->rho[i] < THIN * model->coeffs[atom->type[i]].eos.rho_min) mine[1]++;
  }
  MPI_Allreduce(mine, all, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  expanded = (all[1] > MANY * all[0]);
  if (expanded && comm->me == 0)
    error->warning(FLERR,
                   "Pair style {} tension no: the density of {} of {} particles is below {:g} of "
                   "that at which the pressure ends: the fluid flies apart without resistance; use "
                   "tension yes where a flow needs suction",
                   style, all[1], all[0], THIN);
}

/* ---------------------------------------------------------------------- */

bool Fluid::has_forces() const
{
  return over_all<int>(world, has_own_forces(), MPI_MIN);
}

bool Fluid::has_own_forces() const
{
  return engine->has_forces();
}

/* ---------------------------------------------------------------------- */

void Fluid::heating(double *heat, double *power) const
{
  forces->heating(heat, power, not_fluid());
}

/* ---------------------------------------------------------------------- */

const ForceSum *Fluid::own_forces() const
{
  return engine->force;
}

const double *Fluid::own_torque(int i) const
{
  return engine->side.torque(i);
}

/* ---------------------------------------------------------------------- */

void Fluid::find_volumes()
{
  on_host([this]() {
    remember_densities();
    density->run(neighbors(), nullptr, nullptr, not_fluid());
  });
}

/* ---------------------------------------------------------------------- */

void Fluid::set_mean_density(int groupbit)
{
  constexpr int MOST = 100;
  constexpr double CLOSE = 1.0e-12;

  // iterate: with volume mass, volumes depend on the masses of neighbors of other types

  on_host([&]() {
    FluidChecks(lmp, style, *model).masses();
    FluidState state(lmp, *engine, *exchange, *model);
    std::vector<double> factor(atom->ntypes + 1, 1.0);
    for (int k = 0; k < MOST; k++) {
      density->run(neighbors(), nullptr, nullptr, not_fluid());
      state.run(groupbit, not_fluid(), pressures());
      if (state.scale_masses(factor, open->bits()) < CLOSE) break;
    }
    state.report_masses(factor, style);
  });
}

/* ---------------------------------------------------------------------- */

void Fluid::announce()
{
  if (pair->compute_flag)    // pair_modify compute yes
    for_report([this]() {
      report();
    });
}

/* ---------------------------------------------------------------------- */

void Fluid::report()
{
  const FluidChecks check(lmp, style, *model);
  const CoeffTable table = coeff_table();
  check_places();    // no effect if sum_density() has called it
  if (!announced) {
    model->warn_of_ignored();
    warned_step = noise_step = 0.0;
    FluidState state(lmp, *engine, *exchange, *model);
    state.run(1, not_fluid(), pressures());
    if (comm->me == 0)
      utils::logmesg(lmp, "Pair style {}: {}, {} loops\n{}{}", style, model->summary(dim, support),
                     engine->instruction_set(), table.text(update->dt) + skin_text(table),
                     state.table());
    check_all_interact();
    check.sizes(not_fluid());
    check.state_times();
    check.surface();
    state.warn_of_density(style);
    state.warn_of_support(style);
    moving = 0.0;
    check_elasticity(state);
  }
  announced = true;
  if (follows) check.followed_densities(densities_before);
  densities_before.clear();
  follows = false;
  if (model->choice.thermal && update->dt != noise_step) announce_noise(table.fastest_rate());

  if (!step_follows()) check_time_step(table);
  const StateRows states = engine->states();
  const auto heat = [&](int i) {
    return states.thermal_energy(i);
  };
  check.energies(heat, not_fluid());
}

/* ----------------------------------------------------------------------
   Warn of a shear elasticity of the arrangement.  Check a fluid at rest again after the time look_after, unless it has
   noise.  Shifting prevents such an elasticity.
------------------------------------------------------------------------- */

void Fluid::check_elasticity(FluidState &state)
{
  look_after = 0.0;
  if (!shift->movers.empty()) return;
  const double wait = state.warn_of_elasticity(style, moving);
  if (!model->choice.thermal) look_after = wait;
  moving = 0.0;
}

/* ----------------------------------------------------------------------
   Return the line of the log about the fastest skin.  The line is empty with noise, since thermal motion goes to and fro,
   and if new lists do not depend on how far particles have moved.
------------------------------------------------------------------------- */

std::string Fluid::skin_text(const CoeffTable &table) const
{
  if (model->choice.thermal || !neighbor->dist_check) return "";
  return table.skin_text(neighbor->skin, update->dt, support, dim);
}

/* ----------------------------------------------------------------------
   Log the noise.  Warn if it has no effect, if rate * dt is large, or if sqrt(kT/m)/c0 is large.  rate = of the fastest
   viscous mode.
------------------------------------------------------------------------- */

void Fluid::announce_noise(double rate)
{
  noise_step = update->dt;
  const std::string temperature = model->choice.own_temperatures
      ? "the temperatures of the particles"
      : fmt::format("temperature {:g}", model->choice.temperature);
  if (comm->me == 0)
    utils::logmesg(lmp,
                   "Pair style {}: thermal noise of {}, seed {}, largest viscous rate times time "
                   "step {:.3g}\n",
                   style, temperature, model->choice.seed, rate * update->dt);
  const bool other = model->constants().states || model->constants().conducts();
  if (rate == 0.0 && !other &&
      (model->choice.own_temperatures || model->choice.temperature > 0.0) && comm->me == 0)
    error->warning(FLERR, "Pair style {}: temp has no effect without viscosity", style);
  if (rate * update->dt > 1.001 * ACCURATE_NOISE && !viscous->active() && comm->me == 0)
    error->warning(
        FLERR,
        "Pair style {}: the largest viscous rate times the time step is {:.4g}, above {:g}; "
        "velocities between steps, and with them the structure of the fluid, are hotter "
        "than the temperature of the noise",
        style, rate * update->dt, ACCURATE_NOISE);
  if (model->choice.own_temperatures || model->choice.eos == Eos::IDEAL) return;

  double fastest = 0.0, fastest_all;    // sqrt(kT/m)/c0
  for (int i = 0; i < atom->nlocal; i++) {
    const TypeCoeff &coeff = model->coeffs[atom->type[i]];
    if (!coeff.other && !is_boundary(i))
      fastest = std::max(
          fastest, sqrt(force->boltz * model->choice.temperature / atom->rmass[i]) / coeff.eos.c0);
  }
  MPI_Allreduce(&fastest, &fastest_all, 1, MPI_DOUBLE, MPI_MAX, world);
  if (fastest_all > FAST_NOISE && comm->me == 0)
    error->warning(
        FLERR,
        "Pair style {}: the thermal velocity sqrt(kT/m) of the lightest particles is {:.2g} c0, "
        "above {:g}: the noise compresses the fluid; use a lower temperature, a larger "
        "c0, or heavier particles",
        style, fastest_all, FAST_NOISE);
}

/* ----------------------------------------------------------------------
   Return true if fix sph/dt sets the time step, and checks it.
------------------------------------------------------------------------- */

bool Fluid::step_follows() const
{
  return !modify->get_fix_by_style("^sph/dt").empty();
}

/* ---------------------------------------------------------------------- */

void Fluid::check_time_step(const CoeffTable &table)
{
  const double smallest = viscous->active() ? table.acoustic_step() : table.smallest_step();
  if (!(update->dt > smallest) || update->dt == warned_step) return;
  warned_step = update->dt;
  if (comm->me == 0)
    error->warning(FLERR,
                   "The time step {:g} exceeds the largest stable time step {:g} of pair "
                   "style {}",
                   update->dt, smallest, style);
}

/* ----------------------------------------------------------------------
   Return the coefficients and the largest stable time steps of the pairs of types, for the fluid as it is now.  All code
   that needs the largest stable time step calls this function.  Of each type it takes the fastest particle, walls included,
   with the speed of sound at its density and energy, and the smallest density of the fluid.  A type without particles
   counts with its coefficients.
   A heavy body pushes light fluid with its own modulus: its sound counts as sound in the light fluid, times 1/2, since the
   body fills half of the kernel.  Walls act with the pressure of the fluid, and the pressure does not move walls: neither
   the speed of sound nor the density of their type counts.
------------------------------------------------------------------------- */

CoeffTable Fluid::coeff_table()
{
  const double inertia = smallest_inertia();
  const int n = atom->ntypes;
  const Eos eos = model->choice.eos;
  // maxima of v + acting c, c, acting c, v, rho0/rho (0: no fluid), and 0 fluid, 1 wall, 2 body
  enum { SPEED, SOUND, ACTING, MOTION, THINNESS, KIND, NMOST };
  std::vector<double> mine(NMOST * (n + 1), 0.0), all(NMOST * (n + 1));
  const auto most = [n](std::vector<double> &of, int what, int type) -> double & {
    return of[what * (n + 1) + type];
  };

  // the place of type 0, which does not exist, has the maximum of all types

  double &fastest = most(mine, MOTION, 0);
  const auto sound_of = sound();
  const double lightest = boundary->has_bodies() ? lightest_fluid() : 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    const int type = atom->type[i];
    const TypeCoeff &coeff = model->coeffs[type];
    if (coeff.other) continue;
    const double rho = atom->rho[i], c = sound_of(i, rho), v = MathExtra::len3(atom->v[i]);
    const bool body = boundary->is_body(i);
    const double acting = body ? c * std::max(1.0, 0.5 * sqrt(coeff.eos.rho0 / lightest)) : c;
    fastest = std::max(fastest, v);
    const bool fluid = !is_boundary(i);
    const double values[NMOST] = {acting + v,
                                  c,
                                  acting,
                                  v,
                                  fluid ? coeff.eos.rho0 / rho : 0.0,
                                  body ? 2.0 : fluid ? 0.0 : 1.0};
    for (int k = 0; k < NMOST; k++) most(mine, k, type) = std::max(most(mine, k, type), values[k]);
  }
  MPI_Allreduce(mine.data(), all.data(), NMOST * (n + 1), MPI_DOUBLE, MPI_MAX, world);
  std::vector<bool> walls_alone(n + 1);
  double slowest = HUGE_VAL, thinnest = HUGE_VAL;    // of the fluid
  for (int i = 1; i <= n; i++) {
    const bool empty = (most(all, SPEED, i) == 0.0), fluid = (most(all, THINNESS, i) > 0.0);
    walls_alone[i] = !fluid && most(all, KIND, i) == 1.0;
    if (fluid) {
      slowest = std::min(slowest, most(all, SOUND, i));
      thinnest = std::min(thinnest, model->coeffs[i].eos.rho0 / most(all, THINNESS, i));
    }
    if (empty && eos != Eos::IDEAL)
      most(all, SPEED, i) = most(all, SOUND, i) = most(all, ACTING, i) = model->coeffs[i].eos.c0;
    if (!fluid) most(all, THINNESS, i) = 1.0;
  }
  for (int i = 1; i <= n; i++)
    if (walls_alone[i] && most(all, ACTING, i) > slowest) {
      most(all, ACTING, i) = slowest;
      most(all, SPEED, i) = most(all, MOTION, i) + slowest;
    }
  const auto density = [&](int i) {
    return walls_alone[i] ? HUGE_VAL : model->coeffs[i].eos.rho0 / most(all, THINNESS, i);
  };

  const double h = stability_length(), hsq = h * h;
  CoeffTable table(most(all, MOTION, 0));
  const auto sound_step = [&](int type) {
    const double speed = most(all, SPEED, type), c = most(all, ACTING, type);
    return acoustic_step(h, speed, [&](double dt) {
      const double more = model->stiffness(type, dt);
      return (more > 0.0) ? most(all, MOTION, type) + sqrt(c * c + more) - speed : 0.0;
    });
  };
  for (int i = 1; i <= n; i++)
    for (int j = i; j <= n; j++) {
      const TypeCoeff &a = model->coeffs[i], &b = model->coeffs[j];
      if (a.other || b.other) continue;
      const double least = std::min(density(i), density(j));
      const double rho = (least < HUGE_VAL) ? least : (thinnest < HUGE_VAL) ? thinnest : a.eos.rho0;
      PairInertia damped;
      damped.hsq = hsq;
      damped.rho = rho;
      damped.rho_inertia = rho * inertia;
      damped.surface = boundary->has_symmetric_friction();
      double diffusion_of = 0.0;
      if (model->choice.delta > 0.0) {
        const auto stiffness = [&](int type) {
          const double c = most(all, SOUND, type);
          return model->coeffs[type].eos.rho0 * c * c;
        };
        diffusion_of = diffusion_rate(model->choice.delta, 0.5 * support, hsq,
                                      std::max(stiffness(i), stiffness(j)),
                                      0.5 * (a.eos.impedance() + b.eos.impedance()));
      }
      table.add_row(i, j, model->pair_fluid(i, j), damped, std::min(sound_step(i), sound_step(j)),
                    diffusion_of);
    }
  if (boundary->has_contact()) table.add_contact(contact->largest_step());
  return table;
}

/* ----------------------------------------------------------------------
   Return the smallest reference density of the types of fluid particles, of all ranks; infinity without such particles.
------------------------------------------------------------------------- */

double Fluid::lightest_fluid() const
{
  double mine = HUGE_VAL;
  for (int i = 0; i < atom->nlocal; i++)
    if (has_type(atom->type[i]) && !is_boundary(i))
      mine = std::min(mine, model->coeffs[atom->type[i]].eos.rho0);
  return over_all(world, mine, MPI_MIN);
}

/* ----------------------------------------------------------------------
   Return the function (i, rho) with the speed of sound of owned particle i at density rho, with its heat as it is now and
   its states frozen; c0 for walls of a liquid, which have no heat.
------------------------------------------------------------------------- */

std::function<double(int, double)> Fluid::sound() const
{
  return [this, states = engine->states()](int i, double rho) {
    const Eos eos = model->choice.eos;
    const EosParams &par = model->coeffs[atom->type[i]].eos;
    if (is_boundary(i) && eos != Eos::IDEAL && par.gruneisen > 0.0) return par.c0;
    const double q = (atom->esph[i] - states.energy(i)) / atom->rmass[i] -
        SPHDissipation::elastic_energy(eos, par, atom->rho[i]);
    return sound_speed(eos, par, rho, SPHDissipation::elastic_energy(eos, par, rho) + q);
  };
}

/* ---------------------------------------------------------------------- */

std::function<double(int)> Fluid::pressures() const
{
  return [this, states = engine->states()](int i) {
    const double energy = (atom->esph[i] - states.energy(i)) / atom->rmass[i];
    return SPHDissipation::pressure(model->choice.eos, model->coeffs[atom->type[i]].eos,
                                    atom->rho[i], energy) +
        states.pressure(i);
  };
}

/* ---------------------------------------------------------------------- */

int Fluid::number_of_heats()
{
  return NCHANNEL;
}

/* ----------------------------------------------------------------------
   Return the smallest moment of inertia per mass, length^2, of all particles that have one; else UNLIMITED_STEP.
------------------------------------------------------------------------- */

double Fluid::smallest_inertia() const
{
  double mine = UNLIMITED_STEP;
  if (spins) {
    const double *const inertia = Fields::of(atom)->inertia;
    for (int i = 0; i < atom->nlocal; i++)
      if (inertia[i] > 0.0 && has_type(atom->type[i])) mine = std::min(mine, inertia[i]);
  }
  return over_all(world, mine, MPI_MIN);
}

/* ---------------------------------------------------------------------- */

double **Fluid::extrapolated_spin() const
{
  return spins ? Fields::of(atom)->omegaest : nullptr;
}

/* ---------------------------------------------------------------------- */

double Fluid::stability_length() const
{
  return sqrt(stability_length_squared(kernel_slope_integral(model->choice.kernel, dim, support)));
}

/* ---------------------------------------------------------------------- */

double Fluid::fall_time() const
{
  double mine = 0.0, largest;    // acceleration
  for (int i = 0; i < atom->nlocal; i++)
    if (has_type(atom->type[i]) && !is_boundary(i))
      mine = std::max(mine, MathExtra::len3(atom->f[i]) / atom->rmass[i]);
  MPI_Allreduce(&mine, &largest, 1, MPI_DOUBLE, MPI_MAX, world);
  return (largest > 0.0) ? sqrt(stability_length() / largest) : UNLIMITED_STEP;
}

/* ---------------------------------------------------------------------- */

int Fluid::not_fluid() const
{
  return boundary->bits() | open->bits();
}

/* ---------------------------------------------------------------------- */

Threads &Fluid::team() const
{
  return engine->team();
}

/* ---------------------------------------------------------------------- */

bool Fluid::is_boundary(int i) const
{
  return atom->mask[i] & boundary->bits();
}

bool Fluid::has_type(int type) const
{
  return !model->coeffs[type].other;
}

/* ---------------------------------------------------------------------- */

double Fluid::memory_usage() const
{
  return engine->memory_usage() + search->memory_usage() + limit->memory_usage() +
      open->memory_usage() + boundary->memory_usage() + contact->memory_usage() +
      shift->memory_usage() + noise->memory_usage() + host->memory_usage() +
      viscous->memory_usage() + temperature->memory_usage() + diffusion->memory_usage() +
      pair_energies->memory_usage();
}
