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

/* ----------------------------------------------------------------------
   Contributing authors: the SPH-DISSIPATION authors
------------------------------------------------------------------------- */

#include "fix_sph_bulk.h"

#include "atom.h"
#include "citeme.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_boundary_stage.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_integrate.h"
#include "sph_dissipation_keywords.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_open_stage.h"
#include "sph_dissipation_rows.h"
#include "sph_dissipation_solvers.h"
#include "sph_dissipation_stages.h"
#include "sph_dissipation_threads.h"
#include "sph_dissipation_traces.h"
#include "sph_dissipation_value.h"
#include "sph_dissipation_viscous.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace SPHDissipation;

static const char cite_shift[] =
    "fix sph/bulk command, keyword shift: https://doi.org/10.1016/j.cma.2016.10.028\n\n"
    "@Article{Sun2017,\n"
    " author =  {P. N. Sun and A. Colagrossi and S. Marrone and A. M. Zhang},\n"
    " title =   {The {$\\delta$}plus-{SPH} model: Simple procedures for a further improvement of "
    "the {SPH} scheme},\n"
    " journal = {Computer Methods in Applied Mechanics and Engineering},\n"
    " year =    2017,\n"
    " volume =  315,\n"
    " pages =   {25--49},\n"
    " doi =     {10.1016/j.cma.2016.10.028},\n"
    "}\n\n";

static const char cite_rkl2[] =
    "fix sph/bulk command, keyword viscous rkl2: https://doi.org/10.1016/j.jcp.2013.08.021\n\n"
    "@Article{Meyer2014,\n"
    " author =  {C. D. Meyer and D. S. Balsara and T. D. Aslam},\n"
    " title =   {A stabilized {Runge-Kutta-Legendre} method for explicit super-time-stepping of "
    "parabolic and mixed equations},\n"
    " journal = {Journal of Computational Physics},\n"
    " year =    2014,\n"
    " volume =  257,\n"
    " pages =   {594--626},\n"
    " doi =     {10.1016/j.jcp.2013.08.021},\n"
    "}\n\n";

// Version of the data in restart files, which begin with -FORMAT

static constexpr int FORMAT = 1101;

// Return the name of a style without the suffix of an accelerator package of LAMMPS

static std::string without_suffix(const std::string &style)
{
  return style.substr(0, style.find("/kk"));
}

namespace {

// Arrays of class Atom and class Fields as functions, see TimeStep

struct Scalars {
  double *array;
  SPH_FUNCTION double &operator()(int i) const { return array[i]; }
};

struct Vectors {
  double **array;
  SPH_FUNCTION double &operator()(int i, int d) const { return array[i][d]; }
};

struct Particles {
  Vectors x, v, f, vest, omega, torque, omegaest;
  Scalars rmass, esph, desph, desph_before, inertia;
  bool has_spins;

  Particles(const Atom *atom, const Fields &fields) :
      x{atom->x}, v{atom->v}, f{atom->f}, vest{atom->vest}, omega{atom->omega},
      torque{atom->torque}, omegaest{fields.omegaest}, rmass{atom->rmass}, esph{atom->esph},
      desph{atom->desph}, desph_before{fields.desph_before}, inertia{fields.inertia},
      has_spins(fields.has_spins)
  {
  }
};

}    // namespace

/* ---------------------------------------------------------------------- */

FixSPHBulk::FixSPHBulk(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), fluid_style(without_suffix(style)), spins(Fields::with_spins(atom)),
    viscous(new ViscousSettings), changes(new Changes)
{
  if (!atom->style_match(style)) error->all(FLERR, "Fix {} requires atom style {}", style, style);
  read_keywords(narg, arg);
  if (lmp->citeme && shifts_particles()) lmp->citeme->add(cite_shift);
  if (lmp->citeme && viscous->mode == Viscous::RKL2) lmp->citeme->add(cite_rkl2);

  time_integrate = 1;
  create_attribute = 1;
  restart_global = 1;
  if (!has_viscous_stage()) return;
  vector_flag = 1;
  size_vector = 2 * StiffScheme::NSTATISTICS;
  extvector = 0;
  global_freq = 1;
}

/* ---------------------------------------------------------------------- */

FixSPHBulk::~FixSPHBulk() = default;

/* ---------------------------------------------------------------------- */

void FixSPHBulk::read_keywords(int narg, char **arg)
{
  std::string rkl2_only, implicit_only;    // a keyword that was given
  for (Keywords key(lmp, fmt::format("Fix {}", style), 3, narg, arg); key.next();) {
    if (key.is("density"))
      density_flag = (key.choice({"rho0", "keep"}) == 0);
    else if (spins && key.is("inertia", "C I_micro")) {
      inertia_flag = 1;
      factor = key.number(0);
      offset = key.number(1);
      if (!(factor >= 0.0) || !(offset >= 0.0) || !(factor + offset > 0.0))
        error->all(FLERR, "Fix {} inertia needs two numbers >= 0, one of them > 0, not {} {}",
                   style, key.word(0), key.word(1));
    } else if (key.is("temperature")) {
      if (!temperature) temperature.reset(new Value);
      temperature->set(lmp, key.word());
    } else if (key.is("shift")) {
      shift_by_rate = (strcmp(key.word(), "auto") == 0);
      shift_speed = shift_by_rate ? 0.0 : key.number();
      key.demand(shift_speed >= 0.0, "auto or >= 0");
    } else if (key.is("viscous")) {
      viscous->mode = static_cast<Viscous>(key.choice({"explicit", "rkl2", "implicit"}));
    } else if (key.is("stages")) {
      rkl2_only = key.name();
      const bool automatic = (strcmp(key.word(), "auto") == 0);
      const int stages = viscous->stages = automatic ? 0 : key.whole_number();
      key.demand(automatic || (stages >= RKL2::FEWEST && stages <= RKL2::MOST && stages % 2 == 1),
                 fmt::format("auto or an odd number from {} to {}", +RKL2::FEWEST, +RKL2::MOST));
    } else if (key.is("scheme")) {
      implicit_only = key.name();
      viscous->scheme = static_cast<Scheme>(key.choice({"trapezoidal", "sdirk2", "euler"}));
    } else if (key.is("tolerance")) {
      implicit_only = key.name();
      viscous->tolerance = key.number();
      key.demand(viscous->tolerance > 0.0 && viscous->tolerance < 1.0, "> 0 and < 1");
    } else if (key.is("iterations", "N warn|error")) {
      implicit_only = key.name();
      viscous->iterations = key.whole_number();
      key.demand(viscous->iterations >= 1, ">= 1");
      viscous->must_converge = (strcmp(key.word(1), "error") == 0);
      if (!viscous->must_converge && strcmp(key.word(1), "warn") != 0)
        error->all(FLERR, "Fix {} iterations must end with warn or error, not {}", style,
                   key.word(1));
    }
  }
  if (viscous->mode != Viscous::RKL2 && !rkl2_only.empty())
    error->all(FLERR, "Fix {} {} is for viscous rkl2 only", style, rkl2_only);
  if (viscous->mode != Viscous::IMPLICIT && !implicit_only.empty())
    error->all(FLERR, "Fix {} {} is for viscous implicit only", style, implicit_only);
}

/* ---------------------------------------------------------------------- */

int FixSPHBulk::setmask()
{
  return PRE_EXCHANGE | MIN_PRE_EXCHANGE | INITIAL_INTEGRATE | POST_INTEGRATE | PRE_FORCE |
      MIN_PRE_FORCE | FINAL_INTEGRATE;
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::init()
{
  reset_dt();

  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix {} does not support run_style respa", style);

  const auto &integrators = modify->get_fix_by_style("^" + fluid_style);
  integrated_groups = 0;
  for (const auto &ifix : integrators) integrated_groups |= ifix->groupbit;
  first = dynamic_cast<FixSPHBulk *>(integrators.front());
  first_instance = (first == this);
  last_instance = (integrators.back() == this);

  if (first_instance) check_integrated_once();

  fluid = find_own_fluid();
  const bool noise = fluid && fluid->model->choice.thermal;
  extrapolation = viscous->extrapolation(noise);
  balanced = fluid && fluid->model->choice.own_temperatures && fluid->pair->compute_flag;
  exact = balanced || has_viscous_stage();
  if (noise && shifts_particles())
    error->all(FLERR,
               "Fix {} shift cannot be used with temp of pair style {}: a shifted fluid has no "
               "thermal equilibrium",
               style, style);
  diffuses = fluid && fluid->model->choice.delta > 0.0 && fluid->pair->compute_flag;
  if (density_flag && fluid && fluid->model->choice.continuity)
    error->all(FLERR,
               "Fix {} density rho0 cannot be used with density continuity of pair style {}, which "
               "begins with rho0 for any masses: use set mass, and set sph/rho for other densities",
               style, style);
  if (density_flag && !fluid)
    error->all(FLERR, "Fix {} density requires pair style {}", style, style);
  if (shifts_particles() && update->whichflag != 2) {
    if (!fluid) error->all(FLERR, "Fix {} shift requires pair style {}", style, style);
    if (!fluid->pair->compute_flag)
      error->all(FLERR,
                 "Fix {} shift needs the forces of pair style {}, which pair_modify compute no "
                 "leaves out",
                 style, style);
    fluid->shift->movers.push_back({groupbit, shift_by_rate, shift_speed});
  }

  if (temperature) {
    if (!fluid) error->all(FLERR, "Fix {} temperature requires pair style {}", style, style);
    if (!temperature->init(lmp, fmt::format("fix {}", style), true))
      error->all(FLERR, "Variable {} for fix {} is of invalid style", temperature->name(), style);
  }

  init_viscous();

  remap_v_flag = domain->deform_vremap;
  if (remap_v_flag && !comm->ghost_velocity)
    error->all(FLERR, "Fix {} requires comm_modify vel yes when fix deform remaps velocities",
               style);
  if (inertia_flag && !fluid)
    error->all(FLERR, "Fix {} inertia requires pair style {}, which gives the volumes", style,
               style);
}

/* ---------------------------------------------------------------------- */

Fluid *FixSPHBulk::find_own_fluid() const
{
  Fluid *const found = find_fluid(force);
  return (found && found->style == fluid_style) ? found : nullptr;
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::init_viscous()
{
  const ViscousSettings &settings = *viscous;
  for (const auto &ifix : modify->get_fix_by_style("^" + fluid_style)) {
    const auto *other = dynamic_cast<FixSPHBulk *>(ifix);
    if (other && *other->viscous != settings)
      error->all(FLERR,
                 "Fixes {} and {} treat the viscous terms in different ways: keyword viscous and "
                 "its options must be the same in all fixes {}",
                 id, ifix->id, style);
  }
  if (settings.mode == Viscous::EXPLICIT) return;

  if (update->whichflag == 2)
    error->all(FLERR,
               "Fix {} viscous rkl2 or implicit cannot be used in a minimization, which has no "
               "velocities",
               style);
  if (!fluid || !fluid->pair->compute_flag)
    error->all(FLERR, "Fix {} viscous rkl2 or implicit requires the forces of pair style {}", style,
               style);
  if (settings.force_is_a_mean() && !modify->get_fix_by_style("^dt/reset").empty())
    error->all(
        FLERR,
        "Fix {} viscous rkl2, or implicit with scheme sdirk2 or euler, cannot be used with fix "
        "dt/reset, whose time step may jump, which creates kinetic energy; use fix sph/dt",
        style);
  if (fluid->model->choice.thermal && !settings.trapezoidal())
    error->all(FLERR,
               "Pair style {} with temp needs fix {} viscous explicit or implicit with scheme "
               "trapezoidal: others damp the fast motions more than the noise excites them",
               style, style);
  if (fluid->model->choice.own_temperatures)
    error->all(FLERR,
               "Pair style {} with temp energy needs fix {} viscous explicit: its friction depends "
               "on the temperatures",
               style, style);
  for (int i = 1; i <= atom->ntypes; i++)
    if (const char *keyword = fluid->model->keyword_that_needs(MELTS, i);
        keyword && settings.mode == Viscous::IMPLICIT)
      error->all(FLERR,
                 "Fix {} viscous implicit cannot be used with {} of pair_coeff, which type {} has: "
                 "its heat capacity depends on the temperature; use viscous rkl2",
                 style, keyword, i);
  if (fluid->model->has_rheology() && settings.mode == Viscous::IMPLICIT)
    error->all(FLERR,
               "Fix {} viscous implicit cannot be used with a viscosity that is not constant; use "
               "viscous rkl2",
               style);
  fluid->viscous->configure(settings, integrated_groups, fluid_style);
  fluid->temperature->configure(settings, integrated_groups, fluid_style);
}

/* ---------------------------------------------------------------------- */

bool FixSPHBulk::has_viscous_stage() const
{
  return viscous->mode != Viscous::EXPLICIT;
}

/* ----------------------------------------------------------------------
   Return numbers of the solver, see StiffStage: first of the friction, then of the conduction of heat.
------------------------------------------------------------------------- */

double FixSPHBulk::compute_vector(int n)
{
  const auto *now = find_fluid(force);    // a command may have replaced the fluid
  if (!now) return 0.0;
  constexpr int each = StiffScheme::NSTATISTICS;
  return (n < each) ? now->viscous->statistics[n] : now->temperature->statistics[n - each];
}

/* ----------------------------------------------------------------------
   Stop if a particle is in the groups of two such fixes, since particles must move once in a step; warn of LAMMPS's fixes.
------------------------------------------------------------------------- */

void FixSPHBulk::check_integrated_once()
{
  const auto &fixes = modify->get_fix_list();
  for (std::size_t k = 0; k < fixes.size(); k++)
    for (std::size_t l = k + 1; l < fixes.size(); l++) {
      const bool ours[] = {dynamic_cast<FixSPHBulk *>(fixes[k]) != nullptr,
                           dynamic_cast<FixSPHBulk *>(fixes[l]) != nullptr};
      if (!(ours[0] || ours[1]) || !fixes[k]->time_integrate || !fixes[l]->time_integrate) continue;
      const bigint all = count_particles(lmp, [&](int i) {
        return (atom->mask[i] & fixes[k]->groupbit) && (atom->mask[i] & fixes[l]->groupbit);
      });
      if (all && ours[0] && ours[1])
        error->all(FLERR,
                   "Fixes {} and {} both integrate {} particles: a particle must be in the group "
                   "of one fix {} only",
                   fixes[k]->id, fixes[l]->id, all, style);
      const Fix *const other = fixes[ours[0] ? l : k];
      if (all && comm->me == 0 &&
          !utils::strmatch(other->style, "^sph/"))    // those check their groups
        error->warning(FLERR,
                       "Fix {} {} also integrates {} particles of fix {}, which thus move twice in "
                       "a step; use fix {} alone",
                       other->id, other->style, all, style, style);
    }
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::setup(int /*vflag*/)
{
  set_inertia();
  check_inertia();
  set_up = true;
  dt_of_forces = dtv;
  const double *const desph_before = fields().desph_before;
  if (energy_extrapolated)
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & groupbit) atom->esph[i] += desph_before[i];
  if (diffuses && !last.known) {
    const Fields &kept = fields();
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & groupbit) kept.vol_rate_before[i] = kept.vol_rate[i];
  }
  energy_extrapolated = false;
  if (!fluid || !last_instance) return;
  fluid->announce();
  warn_not_integrated();
}

/* ----------------------------------------------------------------------
   Warn of fluid particles without an integrator, forgotten or fixed on purpose, and of fluid particles that only LAMMPS's
   rigid bodies move: these particles act as fluid.  Walls do not count.
------------------------------------------------------------------------- */

void FixSPHBulk::warn_not_integrated()
{
  int integrated = 0, rigid = 0;
  for (const auto &ifix : modify->get_fix_list()) {
    if (ifix->time_integrate) integrated |= ifix->groupbit;
    if (ifix->rigid_flag) rigid |= ifix->groupbit;
  }
  const auto is_new = [&](bigint &before, const auto &is_one) {
    const bigint all = count_particles(lmp, [&](int i) {
      return is_one(atom->mask[i]) && fluid->has_type(atom->type[i]) && !fluid->is_boundary(i);
    });
    const bool is = (all && all != before);
    before = all;
    return is && comm->me == 0;
  };
  if (is_new(not_integrated, [=](int mask) {
        return !(mask & integrated);
      }))
    error->warning(FLERR,
                   "{} particles of the fluid are in the group of no fix that integrates them: "
                   "they stay where they are; fix sph/wall makes walls of such particles",
                   not_integrated);
  if (is_new(rigid_alone, [=](int mask) {
        return mask & rigid;
      }))
    error->warning(FLERR,
                   "{} particles of the fluid belong to rigid bodies: the fluid around slips along "
                   "these bodies, and its forces act on them half a step late; use fix sph/wall "
                   "move rigid if possible",
                   rigid_alone);
}

/* ----------------------------------------------------------------------
   Set vest and the energy for the first forces.  A run that continues the last run begins with the extrapolated velocity and
   energy of the last step, other runs with velocity and energy themselves.  The exchange of atoms comes later: so ghost atoms
   get these values.  With velocity remapping, vest is only the increment, see add_remapped_velocity().
------------------------------------------------------------------------- */

void FixSPHBulk::setup_pre_exchange()
{
  if (update->whichflag == 0) return;    // from a command that moves particles between processors
  if (first_instance) {
    *changes = is_rerun(lmp) ? Changes() : find_changes(lmp, [this](int i) {
      return traced(i);
    });
  }
  const bool continued = is_continued();
  if (first_instance) reset_extrapolation();
  if (!continued || !(dt_of_states > 0.0)) dt_of_states = dtv;
  if (fluid && first_instance) fluid->begin_run(dt_of_states, continued, *changes);
  if (fluid && !continued) fluid->begin_anew();
  double *const desph_before = fields().desph_before;
  const Particles particles(atom, fields());
  const TimeStep step = time_step();
  double *const vol_rate_before = fields().vol_rate_before;
  const int bodies = (fluid && first_instance) ? fluid->boundary->bits_of_elastic_bodies() : 0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!continued && (atom->mask[i] & bodies)) {
      step.follow(particles, i);
      desph_before[i] = 0.0;
    }
    if (!(atom->mask[i] & groupbit)) continue;
    if (!continued) {
      step.follow(particles, i);
      desph_before[i] = vol_rate_before[i] = 0.0;
    } else if (remap_v_flag)
      for (int d = 0; d < 3; d++) atom->vest[i][d] -= atom->v[i][d];
    atom->esph[i] -= desph_before[i];
  }
  energy_extrapolated = true;
  last.known = continued;
  setup_step = update->ntimestep;
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::post_run()
{
  const bool extrapolated = last.known || update->ntimestep > setup_step;
  last = {update->whichflag == 1 && extrapolated, dtv};
  leave_traces();
}

/* ----------------------------------------------------------------------
   Leave traces of the particles of all integrators, of other fixes, and of walls.  Walls set their velocity themselves, see
   Fluid::note_change().
------------------------------------------------------------------------- */

void FixSPHBulk::leave_traces()
{
  if (first_instance)
    SPHDissipation::leave_traces(lmp, [this](int i) {
      return traced(i);
    });
}

Traced FixSPHBulk::traced(int i) const
{
  const int mask = atom->mask[i];
  if (mask & integrated_groups) return Traced::ALL;
  if (!fluid) return Traced::NOTHING;
  if (mask & fluid->boundary->bits_of_elastic_bodies()) return Traced::ALL;
  if (fluid->is_boundary(i)) return Traced::REST;
  return (fluid->has_type(atom->type[i]) && !(mask & fluid->not_fluid())) ? Traced::ALL
                                                                          : Traced::NOTHING;
}

/* ----------------------------------------------------------------------
   Return, on all processors, whether the run continues the last run.  A minimization has no velocities, and rerun has
   unrelated snapshots: return false.  With large viscosities, the extrapolated velocity is valid for one time step only.
------------------------------------------------------------------------- */

bool FixSPHBulk::is_continued() const
{
  if (update->whichflag == 2 || is_rerun(lmp)) return false;
  return last.known && (last.dt == dtv || !has_viscous_stage()) && first->changes->none_of_motion();
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::reset_extrapolation()
{
  const Particles particles(atom, fields());
  const TimeStep step = time_step();
  const int except = bits_not_followed();
  for (int i = 0; i < atom->nlocal; i++)
    if (!(atom->mask[i] & except)) step.follow(particles, i);
}

int FixSPHBulk::bits_not_followed() const
{
  return integrated_groups | (fluid ? fluid->boundary->bits_of_bodies() : 0);
}

/* ----------------------------------------------------------------------
   Set the extrapolated velocities of a particle that arrives in a run, at the end of a step.  LAMMPS sets up the borders
   later: so ghosts get these velocities, too.
------------------------------------------------------------------------- */

void FixSPHBulk::set_arrays(int i)
{
  if (first_instance) time_step().follow(Particles(atom, fields()), i);
}

/* ----------------------------------------------------------------------
   Let a particle join the group.  The forces at the end of the step do the second half of the particle's kick.
------------------------------------------------------------------------- */

void FixSPHBulk::arrive(int i)
{
  fields().desph_before[i] = fields().vol_rate[i] = fields().vol_rate_before[i] = 0.0;
  if (inertia_flag) set_inertia_of(i, fields().inertia[i]);
  if (has_viscous_stage() && fluid->has_type(atom->type[i]))
    fluid->forces_for_steps().keep(time_step(), Particles(atom, fields()), i);
}

/* ----------------------------------------------------------------------
   Let a particle leave the group.  Set vest and omegaest to the extrapolated values at the end of the step.
------------------------------------------------------------------------- */

void FixSPHBulk::depart(int i)
{
  const Particles particles(atom, fields());
  TimeStep step = time_step();
  step.keep = 1.0;
  step.kick(particles, i);
  step.follow(particles, i);
}

/* ----------------------------------------------------------------------
   Prepare the first forces of a run, or of a minimization.
------------------------------------------------------------------------- */

void FixSPHBulk::setup_pre_force(int /*vflag*/)
{
  set_masses();
  set_temperatures();
  if (update->whichflag == 1) add_remapped_velocity();
  if (!spins || !exact) return;    // the first forces depend on the inertia
  fluid->find_volumes();
  set_inertia();
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::set_masses()
{
  if (!density_flag || density_done) return;
  fluid->set_mean_density(groupbit);
  density_done = 1;
}

/* ----------------------------------------------------------------------
   Set the temperatures, after the masses of all integrators: densities depend on masses.  A minimization does not change
   internal energies.
------------------------------------------------------------------------- */

void FixSPHBulk::set_temperatures()
{
  if (!sets_temperatures()) return;
  for (const auto &ifix : modify->get_fix_by_style("^" + fluid_style))
    if (auto *const other = dynamic_cast<FixSPHBulk *>(ifix)) other->set_masses();

  // open zones are in the group while the variable is evaluated

  const int zone_bits = fluid->open->bits_of(groupbit);
  const std::vector<int> masks(atom->mask, atom->mask + atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++)
    if (masks[i] & zone_bits) atom->mask[i] |= groupbit;
  modify->clearstep_compute();
  temperature->evaluate(lmp, igroup);
  modify->addstep_compute(update->ntimestep + 1);
  std::copy(masks.begin(), masks.end(), atom->mask);
  const auto value = [this](int i) {
    return (*temperature)(i);
  };
  fluid->set_temperature(groupbit, value, fmt::format("Fix {} temperature", style));
  temperature_done = true;
}

bool FixSPHBulk::sets_temperatures() const
{
  return temperature && !temperature_done && update->whichflag == 1 && !is_rerun(lmp);
}

/* ----------------------------------------------------------------------
   Set the inertia from the volumes of the last force computation.  Particles with inertia keep their inertia: so angular
   momentum is conserved.
------------------------------------------------------------------------- */

void FixSPHBulk::set_inertia()
{
  double *const inertia = fields().inertia;
  if (inertia_flag)
    for (int i = 0; i < atom->nlocal; i++)
      if ((atom->mask[i] & groupbit) && !(inertia_done && inertia[i] > 0.0))
        inertia[i] = factor * spacing_squared(domain->dimension, atom->vfrac[i]) + offset;
  inertia_done = true;
}

/* ----------------------------------------------------------------------
   Set the inertia of a particle that arrives in a run, from its reference volume: the volume is not known before the forces.
------------------------------------------------------------------------- */

void FixSPHBulk::set_inertia_of(int i, double &inertia) const
{
  if (inertia > 0.0) return;
  const FluidModel &model = *find_fluid(force)->model;
  const double volume = atom->rmass[i] / model.coeffs[atom->type[i]].eos.rho0;
  inertia = factor * spacing_squared(domain->dimension, volume) + offset;
}

/* ---------------------------------------------------------------------- */

bool FixSPHBulk::has_torques() const
{
  return fluid && fluid->model->has_torques();
}

/* ----------------------------------------------------------------------
   Stop if particles with torques have no inertia: angular momentum would be lost.
------------------------------------------------------------------------- */

void FixSPHBulk::check_inertia() const
{
  if (!has_torques()) return;
  const double *const inertia = fields().inertia;
  const bigint all = count_particles(lmp, [&](int i) {
    return (atom->mask[i] & groupbit) && !(inertia[i] > 0.0);
  });
  if (all)
    error->all(FLERR,
               "Fix {}: inertia must be > 0 where the fluid exerts torques, which that of {} "
               "particles is not; use {}a data file, or set d_inertia",
               style, all, inertia_flag ? "" : "the inertia keyword, ");
}

/* ---------------------------------------------------------------------- */

TimeStep FixSPHBulk::time_step() const
{
  return {dtv, dtf, remap_v_flag ? 0.0 : 1.0, extrapolation, forces_jump, balanced};
}

VolumeStep FixSPHBulk::volume_step() const
{
  return {dtv, fluid->diffusion_interval() * dt_of_forces, fluid->diffusion_is_new()};
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::initial_integrate(int /*vflag*/)
{
  check_set_up();
  begin_step();
  integrate(BEGIN);
}

/* ----------------------------------------------------------------------
   Begin a step, also for particles of the fluid that no fix of this kind integrates.
------------------------------------------------------------------------- */

void FixSPHBulk::begin_step()
{
  warn_of_jump();
  dt_of_states = dtv;
  if (first_instance && fluid && fluid->pair->compute_flag) fluid->begin_step(dtv);
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::integrate(Half half)
{
  const int nlocal = nlocal_group();
  const OwnForces own = exact ? fluid->forces_for_steps() : OwnForces();
  const bool changes_volume = diffuses && half == BEGIN;
  VolumeStep volume = {};
  if (changes_volume) {
    const Fields &kept = fields();
    volume = volume_step();
    volume.rho = atom->rho;
    volume.rmass = atom->rmass;
    volume.rate = kept.vol_rate;
    volume.rate_before = kept.vol_rate_before;
    for (int slot : kept.slots)
      if (state_info(slot).kind == StateKind::STRAIN)
        volume.strain[volume.nstrains++] = kept.state[slot];
  }

  Threads one_thread;
  (fluid ? fluid->team() : one_thread).in_parts(nlocal, [&](int, int from, int to) {
    const Fields &kept = fields();
    const Particles particles(atom, kept);
    const TimeStep step = time_step();
    for (int i = from; i < to; i++) {
      if (!(atom->mask[i] & groupbit)) continue;
      if (exact)
        own.step(step, particles, i, half == BEGIN, fluid->has_type(atom->type[i]));
      else if (half == BEGIN)
        step.begin(particles, i);
      else
        step.end(particles, i);
      if (changes_volume) volume.begin(i);
    }
  });
}

/* ----------------------------------------------------------------------
   Stop if no setup has run: time step, pair style, and forces would be missing, or of another fix.
------------------------------------------------------------------------- */

void FixSPHBulk::check_set_up()
{
  SPHDissipation::check_set_up(lmp, this, set_up);
  const Fluid *const now = find_own_fluid();
  if (now != fluid || (now && !now->is_ready()))
    error->all(FLERR, Error::NOLASTLINE,
               "Fix {} {}: the pair style or its coefficients were changed after the last run was "
               "set up: the next one cannot be a run with pre no",
               id, style);
  if (now && now->was_minimized())
    error->all(FLERR, Error::NOLASTLINE,
               "Fix {} {}: the state is that of a minimization: the next run cannot be a run with "
               "pre no",
               id, style);
}

/* ----------------------------------------------------------------------
   Warn if commands between two runs have more than doubled the time step, and the second run has no setup.
------------------------------------------------------------------------- */

void FixSPHBulk::warn_of_jump() const
{
  constexpr double MOST = 2.0;
  if (!(dtv > MOST * dt_of_forces) || !first_instance || !viscous->force_is_a_mean()) return;
  if (comm->me == 0)
    error->warning(
        FLERR,
        "Fix {} viscous: the time step {:g} is more than twice that of the forces, {:g}, "
        "which may create kinetic energy; use run without pre no, or fix sph/dt",
        style, dtv, dt_of_forces);
}

/* ----------------------------------------------------------------------
   Shift the particles of all fixes of this kind, after the first half of the step.  Particles without such a fix move with
   the velocity that another fix has set.
------------------------------------------------------------------------- */

void FixSPHBulk::post_integrate()
{
  shift_particles();
  if (first_instance && !(integrated_groups & 1)) reset_extrapolation();
}

void FixSPHBulk::shift_particles()
{
  if (first_instance && fluid) fluid->shift_in_step(time_step().keep);
  forces_jump = fluid && fluid->has_shifted() && !exact && dtv > 0.0;
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::pre_force(int /*vflag*/)
{
  add_remapped_velocity();
  if (neighbor->ago != 0) return;    // particles arrive with a new neighbor list
  double *const inertia = fields().inertia;
  if (inertia_flag)
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & groupbit) set_inertia_of(i, inertia[i]);
  check_inertia();
}

/* ----------------------------------------------------------------------
   Add the velocity to vest after the communication, on owned and ghost atoms: fix deform may remap the velocities of ghost
   atoms at a periodic boundary.
------------------------------------------------------------------------- */

void FixSPHBulk::add_remapped_velocity()
{
  if (!remap_v_flag || !first_instance) return;

  double **v = atom->v;
  double **vest = atom->vest;
  const int nall = atom->nlocal + atom->nghost;
  for (int i = 0; i < nall; i++)
    for (int d = 0; d < 3; d++) vest[i][d] += v[i][d];
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::final_integrate()
{
  end_step();
  integrate(END);
}

void FixSPHBulk::end_step()
{
  dt_of_forces = dtv;
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::reset_dt()
{
  dtv = update->dt;
  dtf = 0.5 * update->dt * force->ftm2v;
}

/* ---------------------------------------------------------------------- */

int FixSPHBulk::nlocal_group() const
{
  return (igroup == atom->firstgroup) ? atom->nfirst : atom->nlocal;
}

/* ----------------------------------------------------------------------
   Return the fields of the atom style.  Do not keep the pointer: replicate makes a new atom style.
------------------------------------------------------------------------- */

Fields &FixSPHBulk::fields() const
{
  return *Fields::of(atom);
}

/* ----------------------------------------------------------------------
   Write which masses, temperatures, and inertia are set.  A continued run keeps masses, temperatures, and
   inertia of the restart file, unless the input has other numbers for temperature or inertia.
------------------------------------------------------------------------- */

void FixSPHBulk::write_restart(FILE *fp)
{
  if (update->whichflag != 0) {
    last = {update->whichflag == 1, dtv};
    leave_traces();
  }
  if (comm->me != 0) return;
  const auto &end = fields().end;
  std::vector<double> state = {-FORMAT};
  if (spins) state.insert(state.end(), {static_cast<double>(inertia_done), factor, offset});
  for (const bigint number :
       {bigint(density_done), bigint(last.known), end.number, end.box, end.step})
    state.push_back(static_cast<double>(number));
  for (const double number : {end.length, last.dt, dt_of_states}) state.push_back(number);
  state.push_back(static_cast<double>(temperature_done));
  state.push_back(temperature && !temperature->varies() ? temperature->now() : 0.0);
  const int size = static_cast<int>(state.size() * sizeof(double));
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(state.data(), sizeof(double), state.size(), fp);
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::restart(char *buf)
{
  const auto *state = reinterpret_cast<double *>(buf);
  check_format(lmp, this, *state++, FORMAT);
  if (spins) {
    inertia_done = state[0] != 0.0 && state[1] == factor && state[2] == offset;
    state += 3;
  }
  density_done = static_cast<int>(state[0]);
  auto &end = fields().end;
  end.number = static_cast<bigint>(state[2]);
  end.box = static_cast<bigint>(state[3]);
  end.step = static_cast<bigint>(state[4]);
  end.length = state[5];
  last = {state[1] != 0.0, state[6]};
  dt_of_states = state[7];
  const bool other = temperature && !temperature->varies() && temperature->now() != state[9];
  temperature_done = state[8] != 0.0 && !other;
}
