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
#include "sph_dissipation_integrate.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_neighbors.h"
#include "sph_dissipation_noise.h"
#include "sph_dissipation_open_stage.h"
#include "sph_dissipation_pair_energy.h"
#include "sph_dissipation_particle_terms.h"
#include "sph_dissipation_report.h"
#include "sph_dissipation_stages.h"
#include "sph_dissipation_state.h"
#include "sph_dissipation_table.h"
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
    aside(new ForcesAside(lmp, *engine, *exchange)), open(new OpenStage(lmp, *engine, *exchange)),
    boundary(new BoundaryStage(lmp, *engine, *exchange, style)),
    contact(new ContactStage(lmp, *engine, *exchange, *boundary, style)),
    shift(new ShiftStage<HostSpace>(lmp, *host)),
    noise(new NoiseStage(lmp, *engine, *exchange, model->clock)), viscous(new StiffScheme(lmp, "")),
    temperature(new StiffScheme(lmp, " in the conduction of heat")),
    stability(new Stability(lmp, *model, *engine, *boundary, *contact)),
    log(new FluidReport(lmp, *engine, *exchange, style, *model, *boundary, *shift, *viscous)),
    rigid(new RigidStage(lmp, *engine, *exchange, *boundary)),
    velocities(new ViscousStage<HostSpace>(lmp, *host, *viscous, *pressure, *boundary, *rigid)),
    stiff_heat(new TemperatureStage(lmp, *host, *temperature, *boundary))
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
  log->renew();
  set_up = false;
  last_setup = 0;
}

/* ----------------------------------------------------------------------
   Read the arguments of pair_coeff.
------------------------------------------------------------------------- */

void Fluid::coeff(int narg, char **arg)
{
  model->adopt();    // keep the coefficients that other commands have set
  model->coeff(narg, arg, pair->setflag);
  log->renew();
  set_up = false;
  last_setup = 0;
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
   Request a neighbor list: NeighborSearch fills an occasional list.  A list that LAMMPS builds gets a line in the log.
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

bool Fluid::is_ready() const
{
  return is_set_up() && (last_setup != 0 || !pair->compute_flag);
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
  if (log->has_new()) check.skin(dim, support);
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
   Derive the parameters of the loops from the coefficients that the commands have set.
------------------------------------------------------------------------- */

void Fluid::derive_coeffs()
{
  stale = false;
  if (model->adopt()) log->renew();
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
    log->check_time_step(stability->table());
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
  if (update->setupflag) stages.clear();    // later forces have other stages
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
    log->check_list(not_fluid());
  }
  if (update->setupflag) {
    last_setup = update->whichflag;
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
   List the stages of the next forces.  Each line gives the condition of a stage, its name, the data that the stage needs, and
   the data that the stage leaves.  An implicit step first needs the forces of a trial; repeated forces have the solution of
   the last run.
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
    add_wall_volumes(walls && noisy);    // with noise, the bound needs these volumes
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
      velocities->begin(all_bits);
      aside->set();
    });
    add_passes(true);
    add(true, "velocities", SLOPES | FORCES, MOTION, call(*this, &Fluid::find_velocity));
  }
  if (stiff_heat && par.thermal_pressure) {
    trial = true;
    add(true, "aside", NOTHING, NOTHING, call(*aside, &ForcesAside::set));
    add_passes(!viscous->active());
    add_temperatures(true);
    add(true, "restored", NOTHING, NOTHING, call(*aside, &ForcesAside::restore));
  }
  trial = false;
  add_passes(!viscous->active());    // large viscosities: those of the guess stay
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
  add(viscous->active() || warm, "totals", SUMS, SUMS, call(*host, &HostSpace::collect_forces));
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
   Return the time for which internal energies lack the work of the pressure: 0 at the first forces.  Later, energies are of
   the middle of the step, half a step behind.  Unless NoiseStage::share_work() corrects it, their last rate has the velocities
   of half a step before, another half a step.
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
  densities_before.clear();
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
  error->warning(
      FLERR,
      "Pair style {}: {} particles have values of {}, which their type does not have: these "
      "values are lost, and the states of the type begin with their first values",
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
  if (log->elasticity_is_due(dt))
    for_report([this]() {
      log->check_elasticity(pressures(), not_fluid());
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
   Solve for the implicit velocities, after the passes of the guess.  The matrix is not symmetric in two cases: walls extend
   the velocity of the fluid, or the bulk term has the form volume, P1 (64).
------------------------------------------------------------------------- */

void Fluid::find_velocity()
{
  find_rate();
  velocities->run(neighbors(), bound(), has_symmetric_matrix());
  aside->restore();
}

void Fluid::find_rate()
{
  if (neighbor->ago == 0 || viscous->has_old_rates())
    viscous->set_rate(stability->table().fastest_rate());
}

bool Fluid::has_symmetric_matrix() const
{
  return !boundary->has_mean_pressure() && model->choice.bulk != Bulk::VOLUME;
}

/* ----------------------------------------------------------------------
   Solve for the implicit temperatures, after pass 2, which gives the heat of friction.
------------------------------------------------------------------------- */

void Fluid::find_temperature()
{
  if (neighbor->ago == 0 || temperature->has_old_rates())
    temperature->set_rate(stability->table().fastest_heat_rate());
  stiff_heat->run(not_fluid());
}

/* ----------------------------------------------------------------------
   Count the steps to the next diffusion of volume.  Repeated forces keep the count.
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

bool Fluid::has_forces() const
{
  return over_all<int>(world, last_setup != 0 && has_own_forces(), MPI_MIN);
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

OwnForces Fluid::forces_for_steps()
{
  return velocities->own_forces();
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
      if (state.scale_masses(factor, open->bits_of(groupbit)) < CLOSE) break;
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

void Fluid::report()
{
  const FluidChecks check(lmp, style, *model);
  const CoeffTable table = stability->table();
  check_places();    // no effect if sum_density() has called it
  log->begin_run(table, pressures(), not_fluid());
  if (follows) check.followed_densities(densities_before);
  densities_before.clear();
  follows = false;
  if (!step_follows()) log->check_time_step(table);
  const StateRows states = engine->states();
  const auto heat = [&](int i) {
    return states.thermal_energy(i);
  };
  check.energies(heat, not_fluid());
}

/* ----------------------------------------------------------------------
   Return true if fix sph/dt sets the time step, and checks it.
------------------------------------------------------------------------- */

bool Fluid::step_follows() const
{
  return !modify->get_fix_by_style("^sph/dt").empty();
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

/* ---------------------------------------------------------------------- */

double **Fluid::extrapolated_spin() const
{
  return spins ? Fields::of(atom)->omegaest : nullptr;
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
  return boundary->is_boundary(i);
}

bool Fluid::has_type(int type) const
{
  return model->has_type(type);
}

/* ---------------------------------------------------------------------- */

double Fluid::memory_usage() const
{
  return engine->memory_usage() + search->memory_usage() + limit->memory_usage() +
      open->memory_usage() + boundary->memory_usage() + contact->memory_usage() +
      shift->memory_usage() + noise->memory_usage() + host->memory_usage() +
      velocities->memory_usage() + stiff_heat->memory_usage() + aside->memory_usage() +
      rigid->memory_usage() + diffusion->memory_usage() + pair_energies->memory_usage();
}
