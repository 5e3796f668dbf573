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

#include "fix_sph_bulk.h"

#include "atom.h"
#include "atom_vec_sph_bulk.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_crowding.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_integrate.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_shift_terms.h"
#include "sph_dissipation_suffix.h"
#include "sph_dissipation_viscous.h"
#include "sph_dissipation_viscous_keywords.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

FixSPHBulk::FixSPHBulk(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), fluid_style(without_suffix(style)), dtv(0.0), dtf(0.0), dt_of_forces(0.0),
    extrapolation(1.0), balanced(false), exact(false), density_done(0), shift_speed(0.0),
    remap_v_flag(0), integrated_groups(0), first_instance(false),
    viscous(new ViscousKeywords(lmp, style)), fluid(nullptr), last(), density_flag(0),
    set_up(false), energy_extrapolated(false), setup_step(0), last_instance(false),
    not_integrated(0)
{
  if (!atom->style_match(style)) error->all(FLERR, "Fix {} requires atom style {}", style, style);
  for (int iarg = 3; iarg < narg;) iarg += keyword_argument(iarg, narg, arg);
  finish_keywords();

  time_integrate = 1;
  create_attribute = 1;
  restart_global = 1;
}

/* ---------------------------------------------------------------------- */

FixSPHBulk::~FixSPHBulk()
{
  delete viscous;
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::finish_keywords()
{
  if (viscous->settings().mode == Viscous::EXPLICIT) return;
  vector_flag = 1;
  size_vector = ViscousStage::NSTATISTICS;
  extvector = 0;
  global_freq = 1;
}

/* ---------------------------------------------------------------------- */

int FixSPHBulk::keyword_argument(int iarg, int narg, char **arg)
{
  if (strcmp(arg[iarg], "density") == 0) {
    if (iarg + 2 > narg)
      utils::missing_cmd_args(FLERR, fmt::format("fix {} density", style), error);
    if (strcmp(arg[iarg + 1], "rho0") != 0 && strcmp(arg[iarg + 1], "keep") != 0)
      error->all(FLERR, "Fix {} density must be rho0 or keep, not {}", style, arg[iarg + 1]);
    density_flag = (strcmp(arg[iarg + 1], "rho0") == 0);
    return 2;
  }
  if (const int nwords = viscous->argument(iarg, narg, arg)) return nwords;
  if (strcmp(arg[iarg], "shift") != 0)
    error->all(FLERR, "Unknown fix {} keyword: {}", style, arg[iarg]);
  if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, fmt::format("fix {} shift", style), error);
  shift_speed = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
  if (!(shift_speed >= 0.0))
    error->all(FLERR, "Fix {} shift must be >= 0, not {}", style, arg[iarg + 1]);
  return 2;
}

/* ---------------------------------------------------------------------- */

int FixSPHBulk::setmask()
{
  return PRE_EXCHANGE | INITIAL_INTEGRATE | POST_INTEGRATE | PRE_FORCE | MIN_PRE_FORCE |
      FINAL_INTEGRATE;
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
  first_instance = (integrators.front() == this);
  last_instance = (integrators.back() == this);

  if (first_instance) check_integrated_once();

  fluid = find_own_fluid();
  const bool noise = fluid && fluid->model->choice.thermal;
  extrapolation = viscous->settings().extrapolation(noise);
  balanced = fluid && fluid->model->choice.own_temperatures && fluid->pair->compute_flag;
  exact = balanced || has_viscous_stage();
  if (noise && shift_speed > 0.0)
    error->all(FLERR,
               "Fix {} shift cannot be used with temp of pair style {}: a shifted fluid has no "
               "thermal equilibrium",
               style, style);
  if (density_flag && !fluid)
    error->all(FLERR, "Fix {} density requires pair style {}", style, style);
  if (shift_speed > 0.0 && update->whichflag != 2) {
    if (!fluid) error->all(FLERR, "Fix {} shift requires pair style {}", style, style);
    if (!fluid->pair->compute_flag)
      error->all(FLERR,
                 "Fix {} shift needs the forces of pair style {}, which pair_modify compute no "
                 "leaves out",
                 style, style);
    fluid->crowding->wanted = true;
  }

  init_viscous();

  remap_v_flag = domain->deform_vremap;
  if (remap_v_flag && !comm->ghost_velocity)
    error->all(FLERR, "Fix {} requires comm_modify vel yes when fix deform remaps velocities",
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
  const ViscousSettings &settings = viscous->settings();
  for (const auto &ifix : modify->get_fix_by_style("^" + fluid_style)) {
    const auto *other = dynamic_cast<FixSPHBulk *>(ifix);
    if (other && other->viscous->settings() != settings)
      error->all(FLERR,
                 "Fixes {} and {} treat the viscous terms in different ways: keyword viscous, and "
                 "those that belong to it, must be the same in all fixes {}",
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
  fluid->viscous->configure(settings, integrated_groups, fluid_style);
}

/* ---------------------------------------------------------------------- */

bool FixSPHBulk::has_viscous_stage() const
{
  return viscous->settings().mode != Viscous::EXPLICIT;
}

/* ----------------------------------------------------------------------
   of the friction, see ViscousStage
------------------------------------------------------------------------- */

double FixSPHBulk::compute_vector(int n)
{
  const auto *now = find_fluid(force);    // it may have been replaced since
  return now ? now->viscous->statistics[n] : 0.0;
}

/* ----------------------------------------------------------------------
   a particle in the groups of two such fixes would move twice in every step
------------------------------------------------------------------------- */

void FixSPHBulk::check_integrated_once()
{
  const auto &fixes = modify->get_fix_list();
  for (std::size_t k = 0; k < fixes.size(); k++)
    for (std::size_t l = k + 1; l < fixes.size(); l++) {
      if (!dynamic_cast<FixSPHBulk *>(fixes[k]) || !dynamic_cast<FixSPHBulk *>(fixes[l])) continue;
      bigint count = 0, all;
      for (int i = 0; i < atom->nlocal; i++)
        if ((atom->mask[i] & fixes[k]->groupbit) && (atom->mask[i] & fixes[l]->groupbit)) count++;
      MPI_Allreduce(&count, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
      if (all)
        error->all(FLERR,
                   "Fixes {} and {} both integrate {} particles: a particle must be in the group "
                   "of one fix {} only",
                   fixes[k]->id, fixes[l]->id, all, style);
    }
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::setup(int /*vflag*/)
{
  set_up = true;
  dt_of_forces = dtv;
  if (energy_extrapolated)
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & groupbit) atom->esph[i] += avec()->desph_before[i];
  energy_extrapolated = false;
  if (!fluid || !last_instance) return;
  fluid->announce();
  warn_not_integrated();
}

/* ----------------------------------------------------------------------
   fixed particles are legal, forgotten ones are not meant; walls are no fluid
------------------------------------------------------------------------- */

void FixSPHBulk::warn_not_integrated()
{
  int integrated = 0;
  for (const auto &ifix : modify->get_fix_list())
    if (ifix->time_integrate) integrated |= ifix->groupbit;

  bigint count = 0, all;
  for (int i = 0; i < atom->nlocal; i++) {
    const int type = atom->type[i];
    if (!(atom->mask[i] & integrated) && fluid->has_type(type) && !fluid->is_boundary(i)) count++;
  }
  MPI_Allreduce(&count, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);

  if (all && all != not_integrated && comm->me == 0)
    error->warning(FLERR,
                   "{} particles of the fluid are in the group of no fix that integrates them: "
                   "they stay where they are; fix sph/wall makes walls of such particles",
                   all);
  not_integrated = all;
}

/* ----------------------------------------------------------------------
   A run that continues the last one begins with the extrapolated velocity and energy of its last step, others
   with velocity and energy themselves.  Before the exchange of atoms, so that ghost atoms get it with their borders.
   With velocity remapping vest holds the increment only, see add_remapped_velocity()
------------------------------------------------------------------------- */

void FixSPHBulk::setup_pre_exchange()
{
  if (update->whichflag == 0) return;    // from a command that moves particles between processors
  const bool continued = is_continued();
  if (first_instance) reset_extrapolation(0, atom->nlocal, integrated_groups);
  if (fluid) fluid->continued = continued && (first_instance || fluid->continued);
  double *const desph_before = avec()->desph_before;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    if (!continued) {
      reset_extrapolation(i, i + 1, 0);
      desph_before[i] = 0.0;
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
  last = find_motion();
  last.known = (update->whichflag == 1 && extrapolated);
}

/* ----------------------------------------------------------------------
   Sums of two numbers of 32 bits that follow from the bits of the velocity and the spin, the position, as
   far as writing a restart file leaves it alone, the type, and the ID.  Walls set their velocity themselves,
   see Fluid::note_change().
------------------------------------------------------------------------- */

FixSPHBulk::Motion FixSPHBulk::find_motion() const
{
  const double length = std::max({domain->xprd, domain->yprd, domain->zprd});
  const double fine =
      0.75487766624669276 * 16777216.0 / length;    // no fraction: lattices have those
  Motion motion = {0, {0, 0}, dtv};
  for (int i = 0; i < atom->nlocal; i++) {
    const bool wall = fluid && fluid->is_boundary(i);
    const bool driven = first_instance && fluid && fluid->has_type(atom->type[i]) &&
        !(atom->mask[i] & (integrated_groups | fluid->not_fluid()));
    const bool moves = driven || (atom->mask[i] & groupbit);
    if (!moves && !wall) continue;
    std::uint64_t number =
        (atom->tag_enable ? atom->tag[i] : 0) * (atom->ntypes + 1) + atom->type[i];
    double place[3];
    domain->unmap(atom->x[i], atom->image[i], place);
    for (double &x : place) x = std::floor(x * fine + 0.5);
    for (const double *values :
         {moves ? static_cast<const double *>(atom->v[i]) : nullptr, moves ? spin_of(i) : nullptr,
          static_cast<const double *>(place)}) {
      if (!values) continue;
      std::uint64_t bits[3];
      memcpy(bits, values, sizeof(bits));
      for (const auto word : bits) {
        number = (number ^ word) * 0x9E3779B97F4A7C15;
        number ^= number >> 32;
      }
    }
    motion.sum[0] += static_cast<bigint>(number & 0xffffffff);
    motion.sum[1] += static_cast<bigint>(number >> 32);
  }
  return motion;
}

/* ---------------------------------------------------------------------- */

FixSPHBulk::Motion FixSPHBulk::sum_of(const Motion &mine, MPI_Comm world)
{
  constexpr bigint EXACT = (bigint(1) << 52) - 1;    // as a number of a restart file
  Motion all = mine;
  MPI_Allreduce(&mine.known, &all.known, 1, MPI_LMP_BIGINT, MPI_MAX, world);
  MPI_Allreduce(mine.sum, all.sum, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  for (auto &sum : all.sum) sum &= EXACT;
  return all;
}

/* ----------------------------------------------------------------------
   on all processors; not in a minimization, which has no velocities, nor for the snapshots of a rerun.
   With large viscosities, the extrapolated velocity makes a step of one length only.
------------------------------------------------------------------------- */

bool FixSPHBulk::is_continued() const
{
  if (update->whichflag == 2 || is_rerun(lmp)) return false;
  const Motion before = sum_of(last, world), now = sum_of(find_motion(), world);
  return before.known && (before.dt == now.dt || !has_viscous_stage()) &&
      std::equal(now.sum, now.sum + 2, before.sum);
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::reset_extrapolation(int from, int to, int except)
{
  double **v = atom->v;
  double **vest = atom->vest;
  const double keep = remap_v_flag ? 0.0 : 1.0;
  for (int i = from; i < to; i++) {
    if (atom->mask[i] & except) continue;
    for (int d = 0; d < 3; d++) vest[i][d] = keep * v[i][d];
  }
}

/* ----------------------------------------------------------------------
   a particle that arrives in a run does so at the end of a step, with its velocity
   before the borders are set up, so that its ghosts get it, too
------------------------------------------------------------------------- */

void FixSPHBulk::set_arrays(int i)
{
  if (first_instance) reset_extrapolation(i, i + 1, 0);
}

/* ----------------------------------------------------------------------
   the second half of the kick is that of the forces at the end of the step
------------------------------------------------------------------------- */

void FixSPHBulk::arrive(int i)
{
  avec()->desph_before[i] = 0.0;
  if (has_viscous_stage()) fluid->viscous->carry_force(i, time_step().keep);
}

/* ----------------------------------------------------------------------
   with its velocity at the end of the step, extrapolated, which vest need not be
------------------------------------------------------------------------- */

void FixSPHBulk::depart(int i)
{
  const double dtfm = dtf / atom->rmass[i];
  for (int d = 0; d < 3; d++) atom->vest[i][d] = atom->v[i][d] += dtfm * atom->f[i][d];
}

/* ----------------------------------------------------------------------
   of a run, or of a minimization
------------------------------------------------------------------------- */

void FixSPHBulk::setup_pre_force(int /*vflag*/)
{
  set_masses();
  if (update->whichflag == 1) add_remapped_velocity();
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::set_masses()
{
  if (!density_flag || density_done) return;
  fluid->set_mean_density(groupbit);
  density_done = 1;
}

/* ---------------------------------------------------------------------- */

TimeStep FixSPHBulk::time_step() const
{
  return {dtv, dtf, remap_v_flag ? 0.0 : 1.0, extrapolation, balanced};
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::initial_integrate(int /*vflag*/)
{
  check_set_up();
  warn_of_jump();
  double **x = atom->x;
  double **v = atom->v;
  double **f = atom->f;
  double **vest = atom->vest;
  double *rmass = atom->rmass;
  double *esph = atom->esph;
  double *desph = atom->desph;
  double *desph_before = avec()->desph_before;
  int *mask = atom->mask;
  const int nlocal = nlocal_group();
  const TimeStep step = time_step();
  const bool stage = has_viscous_stage();

  for (int i = 0; i < nlocal; i++) {
    if (!(mask[i] & groupbit)) continue;
    const double dtfm = dtf / rmass[i];
    step.begin_energy(desph[i], esph[i], desph_before[i]);
    if (exact) esph[i] += rest_of_heat(v[i], vest[i], f[i], fluid->own_force(i), 1.0 / rmass[i]);
    for (int d = 0; d < 3; d++) step.begin(dtfm, f[i][d], x[i][d], v[i][d], vest[i][d]);
    if (stage) fluid->viscous->carry_force(i, step.keep);
  }
  if (shift_speed > 0.0) shift_particles();
}

/* ----------------------------------------------------------------------
   the time step, the pair style, and its forces are those of another fix then, or none
------------------------------------------------------------------------- */

void FixSPHBulk::check_set_up()
{
  SPHDissipation::check_set_up(lmp, this, set_up);
  const Fluid *const now = find_own_fluid();
  if (now != fluid || (now && !now->is_set_up()))
    error->all(FLERR, Error::NOLASTLINE,
               "Fix {} {}: the pair style or its coefficients were changed after the last run was "
               "set up: the next one cannot be a run with pre no",
               id, style);
}

/* ----------------------------------------------------------------------
   of the time step, by commands between runs of which the second one has no setup
------------------------------------------------------------------------- */

void FixSPHBulk::warn_of_jump() const
{
  constexpr double MOST = 2.0;
  if (!(dtv > MOST * dt_of_forces) || !first_instance || !viscous->settings().force_is_a_mean())
    return;
  if (comm->me == 0)
    error->warning(
        FLERR,
        "Fix {} viscous: the time step {:g} is more than twice that of the forces, {:g}, "
        "which may create kinetic energy; use run without pre no, or fix sph/dt",
        style, dtv, dt_of_forces);
}

/* ----------------------------------------------------------------------
   The heat that the pair style books is the work of its forces against the velocity that acts in the
   friction, acting.  Over half a kick, before it, they do their work at the mean velocity of the kick: the
   difference, with which kinetic and internal energy are conserved exactly.  The same of spins.
------------------------------------------------------------------------- */

double FixSPHBulk::rest_of_heat(const double *v, const double *acting, const double *f,
                                const double *own, double mass_inv) const
{
  double power = 0.0;
  for (int d = 0; d < 3; d++) power += own[d] * (acting[d] - v[d] - 0.5 * dtf * mass_inv * f[d]);
  return 0.5 * dtv * power;
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::shift_particles()
{
  const double support = fluid->support_radius();
  const int nlocal = nlocal_group();
  for (int i = 0; i < nlocal; i++)
    if (atom->mask[i] & groupbit)
      shift_particle(shift_speed, support, dtv, fluid->crowding->crowding[i], atom->x[i]);
}

/* ----------------------------------------------------------------------
   particles that no fix of this kind integrates move with the velocity that
   another fix gave them
------------------------------------------------------------------------- */

void FixSPHBulk::post_integrate()
{
  if (!first_instance || (integrated_groups & 1)) return;
  reset_extrapolation(0, atom->nlocal, integrated_groups);
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::pre_force(int /*vflag*/)
{
  add_remapped_velocity();
}

/* ----------------------------------------------------------------------
   velocities of ghost atoms change when fix deform remaps them at a periodic
   boundary: add the velocity after the communication, on owned and ghost atoms
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
  dt_of_forces = dtv;
  double **v = atom->v;
  double **f = atom->f;
  double *rmass = atom->rmass;
  double *esph = atom->esph;
  double *desph = atom->desph;
  double *desph_before = avec()->desph_before;
  int *mask = atom->mask;
  double **vest = atom->vest;
  const int nlocal = nlocal_group();
  const TimeStep step = time_step();

  for (int i = 0; i < nlocal; i++) {
    if (!(mask[i] & groupbit)) continue;
    const double dtfm = dtf / rmass[i];
    step.end_energy(desph[i], desph_before[i], esph[i]);
    if (exact) {
      const double rest = rest_of_heat(v[i], vest[i], f[i], fluid->own_force(i), 1.0 / rmass[i]);
      esph[i] += rest;
      desph_before[i] += rest;
    }
    for (int d = 0; d < 3; d++) step.end(dtfm, f[i][d], v[i][d]);
  }
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
   not kept, for replicate makes a new one
------------------------------------------------------------------------- */

AtomVecSPHBulk *FixSPHBulk::avec() const
{
  return dynamic_cast<AtomVecSPHBulk *>(atom->style_match(fluid_style.c_str()));
}

/* ----------------------------------------------------------------------
   the masses are set once; a continued run keeps those of its restart file
------------------------------------------------------------------------- */

void FixSPHBulk::write_restart(FILE *fp)
{
  const Motion motion = restart_motion();
  if (comm->me == 0) {
    const double state[1 + NMOTION] = {
        static_cast<double>(density_done), static_cast<double>(motion.known),
        static_cast<double>(motion.sum[0]), static_cast<double>(motion.sum[1]), motion.dt};
    const int size = sizeof(state);
    fwrite(&size, sizeof(int), 1, fp);
    fwrite(state, sizeof(double), 1 + NMOTION, fp);
  }
}

/* ---------------------------------------------------------------------- */

void FixSPHBulk::restart(char *buf)
{
  const auto *state = reinterpret_cast<double *>(buf);
  density_done = static_cast<int>(state[0]);
  restart_motion(state + 1);
}

/* ---------------------------------------------------------------------- */

FixSPHBulk::Motion FixSPHBulk::restart_motion() const
{
  const bool known = (update->whichflag == 1) || is_continued();
  Motion motion = sum_of(find_motion(), world);
  motion.known = known;
  if (update->whichflag == 0) motion.dt = last.dt;
  return motion;
}

void FixSPHBulk::restart_motion(const double *state)
{
  last = {static_cast<bigint>(state[0]), {0, 0}, state[3]};
  if (comm->me == 0)
    for (int k = 0; k < 2; k++) last.sum[k] = static_cast<bigint>(state[1 + k]);
}
