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

#include "fix_sph_open.h"

#include "atom.h"
#include "citeme.h"
#include "comm.h"
#include "error.h"
#include "fix_sph_bulk.h"
#include "group.h"
#include "math_extra.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_balance.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_keywords.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_open.h"
#include "sph_dissipation_open_stage.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace SPHDissipation;

static constexpr double NODES = 3.0;          // nodes of the plane per radius of the measured fluid
static constexpr double AVERAGING = 100.0;    // default time, support radii over sound speed

// Numbers in restart files: -format, size, balance, rows, clock, point and normal of the plane; then the waves.  Files
// without a format begin with the size.

static constexpr int FORMAT = 1004;
enum {
  SIZE = 1,
  BALANCE,
  LATTICE = BALANCE + OpenBalance::NVALUE,
  CLOCK = LATTICE + ZoneLattice::NSTATE,
  PLANE,
  NHEAD = PLANE + 6
};

// Places in the vector of the fix, behind the balance

enum { COUNT = OpenBalance::NVALUE, PRESSURE, VELOCITY, NVECTOR = VELOCITY + 3 };

static const char cite_open[] =
    "fix sph/open command: https://doi.org/10.1002/fld.1971\n\n"
    "@Article{Lastiwka2009,\n"
    " author =  {M. Lastiwka and M. Basa and N. J. Quinlan},\n"
    " title =   {Permeable and non-reflecting boundary conditions in {SPH}},\n"
    " journal = {International Journal for Numerical Methods in Fluids},\n"
    " year =    2009,\n"
    " volume =  61,\n"
    " pages =   {709--724},\n"
    " doi =     {10.1002/fld.1971},\n"
    "}\n\n";

/* ---------------------------------------------------------------------- */

FixSPHOpen::FixSPHOpen(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg), totals(NVECTOR)
{
  demand_words(lmp, fmt::format("fix {}", style), narg,
               fmt::format("ID group-ID {} fluid-ID x y z nx ny nz length", style));
  const std::string owner = fmt::format("Fix {}", style);
  plane.reset(new OpenPlane(lmp, owner));
  values.reset(new OpenValues(lmp, owner));
  samples.reset(new OpenSamples(lmp, *plane));
  condition.reset(new OpenCondition(lmp, owner, *plane, *values, *samples));
  lattice.reset(new ZoneLattice(lmp, owner, *plane, groupbit));
  balance.reset(new OpenBalance(lmp));

  fluid_name = arg[3];
  const int fluid_group = group->find(fluid_name);
  if (fluid_group < 0) error->all(FLERR, "Fix {}: group {} does not exist", style, fluid_name);
  plane->set(arg + 4);
  for (Keywords key(lmp, owner, 11, narg, arg); key.next();) {
    values->read(key);
    condition->read(key);
    if (key.is("region")) plane->set_region(key.word());
    if (key.is("area")) area = key.positive();
    if (key.is("spacing")) lattice->set_spacing(key.positive());
  }
  values->check();
  condition->check();
  if (area > 0.0 && lattice->has_spacing())
    error->all(FLERR, "Fix {}: area and spacing cannot both be given", style);
  if (area > 0.0 && !values->given(OpenValues::RHO))
    error->all(FLERR, "Fix {} area needs a density, from which the distance of particles follows",
               style);

  if (atom->tag_enable == 0) error->all(FLERR, "Fix {} requires atom IDs", style);
  if (fluid_group == 0 || igroup == 0 || fluid_group == igroup)
    error->all(FLERR,
               "Fix {}: the groups of the zone and of the fluid must be two, neither of them all: "
               "particles that cross the plane change from one to the other",
               style);

  time_integrate = 1;
  restart_global = 1;
  vector_flag = 1;
  size_vector = NVECTOR;
  global_freq = 1;
  extvector = 0;    // sums are not to be scaled by the number of atoms

  if (lmp->citeme) lmp->citeme->add(cite_open);
}

/* ---------------------------------------------------------------------- */

FixSPHOpen::~FixSPHOpen()
{
  if (auto *fluid = find_fluid(force)) fluid->open->remove(this);
}

/* ---------------------------------------------------------------------- */

int FixSPHOpen::setmask()
{
  return PRE_EXCHANGE | PRE_NEIGHBOR | INITIAL_INTEGRATE | POST_INTEGRATE | FINAL_INTEGRATE;
}

/* ---------------------------------------------------------------------- */

void FixSPHOpen::init()
{
  fluid = find_fluid(lmp, fmt::format("Fix {}", style));
  if (update->whichflag == 2)
    error->all(FLERR, "Fix {} cannot be used in a minimization: its particles have a velocity",
               style);
  if (is_rerun(lmp))
    error->all(FLERR,
               "Fix {} cannot be used with rerun: snapshots have neither the groups of the "
               "particles nor the waves in the zone",
               style);
  if (fluid->model->choice.thermal)
    error->all(FLERR,
               "Fix {} cannot be used with temp of the pair style: its particles do not fluctuate",
               style);
  if (update->dt < 0.0)
    error->all(
        FLERR,
        "Fix {}: the time step must not be negative: particles that have left do not come back",
        style);
  fluid->open->add(this);
  fields = Fields::of(atom);

  const int fluid_group = group->find(fluid_name);
  if (fluid_group < 0) error->all(FLERR, "Fix {}: group {} does not exist", style, fluid_name);
  fluidbit = group->bitmask[fluid_group];
  check_groups(fluid_group);
  check_lists();
  integrator = find_integrator(fluid_group);

  const double support = fluid->support_radius();
  plane->init();
  values->init(fluid->model->choice.eos == Eos::IDEAL);
  for (int i = 1; i <= atom->ntypes; i++)
    if (const char *keyword = fluid->model->keyword_that_needs(NO_OPEN_ENDS, i))
      error->all(FLERR, "Fix {} cannot be used with {} of pair_coeff, which type {} has", style,
                 keyword, i);
  check_heat();
  condition->init(*fluid->model);
  if (area > 0.0)
    lattice->set_distance([this](int i) {
      return atom->rmass[i] / (area * (*values)(OpenValues::RHO, i));
    });
  lattice->init(support, fluidbit);
  if (lattice->are_new()) warn_of_styles();

  // choose a small radius, because averages smooth the profile, but large enough for a few particles

  constexpr double PART = 0.6, WIDTHS = 2.2;
  radius = std::min(support, std::max(PART * support, WIDTHS * lattice->width()));
  plane->set_nodes(radius / NODES);

  samples->init();
  if (!waves_before.empty() && !samples->unpack(waves_before)) warn_of_other_plane();
  waves_before.clear();
}

/* ----------------------------------------------------------------------
   Set the averaging time from the mean, and the memory of waves from the least speed of sound near the plane, the latter with
   new neighbor lists: heat and fix adapt change the speed.  crossings = sums of measure_sound() over all processors.
------------------------------------------------------------------------- */

void FixSPHOpen::set_times(const double *crossings)
{
  if (!(crossings[0] > 0.0)) return;
  if (neighbor->ago == 0 || longest == 0.0)
    MPI_Allreduce(&my_longest, &longest, 1, MPI_DOUBLE, MPI_MAX, world);
  const double given = condition->averaging_time;
  samples->set_times(given > 0.0 ? given : AVERAGING * crossings[1] / crossings[0],
                     10.0 * (plane->length / fluid->support_radius() + 1.0) * longest);
}

/* ----------------------------------------------------------------------
   Append number and sum of the times in which sound crosses a support radius, of particles of zone and fluid near the plane.
------------------------------------------------------------------------- */

void FixSPHOpen::measure_sound(std::vector<double> &mine)
{
  double number = 0.0, sum = 0.0;
  my_longest = 0.0;
  for (const int i : members) {
    if (!(atom->mask[i] & (groupbit | fluidbit))) continue;
    const double sound = condition->sound_at_rest(i, atom->mask[i] & groupbit);
    if (!(sound > 0.0)) continue;
    const double crossing = fluid->support_radius() / sound;
    number += 1.0;
    sum += crossing;
    my_longest = std::max(my_longest, crossing);
  }
  mine.push_back(number);
  mine.push_back(sum);
}

/* ----------------------------------------------------------------------
   Return whether a particle at x may have pairs of zone and fluid: near the plane, or anywhere in a zone with a region, which
   may have fluid at the sides.
------------------------------------------------------------------------- */

bool FixSPHOpen::zone_near(const double *x, double reach) const
{
  const double height = plane->height(x);
  return height < reach && height > -reach - (plane->limited() ? plane->length : 0.0);
}

/* ----------------------------------------------------------------------
   Set the velocities of the zone, unless the run continues another run or a restart file.  A command that moves particles
   between processors before the first run leaves the zone new.
------------------------------------------------------------------------- */

void FixSPHOpen::setup_pre_exchange()
{
  if (update->whichflag == 0 && lattice->are_new()) return;
  set_up = true;
  states.clear();
  condition->is_new = lattice->are_new();
  if (condition->is_new && condition->has_heat())
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & groupbit) condition->density_of_energy(i) = atom->rho[i];
  check_places();
  values->evaluate(igroup);
  if (condition->given_velocity() && !samples->any()) {
    fluid->note_change();
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & groupbit) set_velocity(i);
  }
  check_length();
  is_new = lattice->are_new();
  if (is_new && integrator->has_set_masses()) warn_of_masses();
  pre_exchange();
}

/* ----------------------------------------------------------------------
   Set the internal energies of the zone after the last computation of the forces: a step may have several.
------------------------------------------------------------------------- */

void FixSPHOpen::setup(int /*vflag*/)
{
  keep_states();
}

void FixSPHOpen::keep_states()
{
  for (const auto &one : states) condition->keep(one.first, one.second);
  condition->is_new = false;
}

/* ----------------------------------------------------------------------
   Find the particles of the zone, and fluid of any zone near it, before each neighbor list, and so before all forces of a setup.
   Number and order of the particles do not change from one list to the next, unless has_lost_members().
------------------------------------------------------------------------- */

void FixSPHOpen::find_members()
{
  const double reach = fluid->support_radius() + neighbor->skin;
  const OpenGroups groups = fluid->open->groups();
  members.clear();
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & groupbit) ||
        (groups.zone_of(atom->mask[i]) == 0.0 && zone_near(atom->x[i], reach)))
      members.push_back(i);
}

bool FixSPHOpen::zone_varies() const
{
  return values->vary();
}

/* ----------------------------------------------------------------------
   Return true if another fix, such as sph/refine, may have changed number and order of the particles in this step.
------------------------------------------------------------------------- */

bool FixSPHOpen::has_lost_members() const
{
  const auto &fixes = modify->get_fix_list();
  return std::any_of(fixes.begin(), fixes.end(), [this](const Fix *other) {
    return other->force_reneighbor && other->next_reneighbor == update->ntimestep;
  });
}

/* ----------------------------------------------------------------------
   Add the impact of the forces at the start of the step, over half a step, to the balance.  Move the particles of the zone
   with their velocity at this time.
------------------------------------------------------------------------- */

void FixSPHOpen::initial_integrate(int /*vflag*/)
{
  check_set_up(lmp, this, set_up);
  balance->advance(0.5 * update->dt);
  condition->clock += update->dt;
  totals_known = false;
  for (const int i : members)
    if (atom->mask[i] & groupbit)
      for (int d = 0; d < 3; d++) atom->x[i][d] += update->dt * atom->v[i][d];
}

/* ----------------------------------------------------------------------
   Correct the move to the mean velocity of the step, and let particles enter and leave.  Along the plane, particles move with
   the given velocity, if any: with their own velocity, particles that leave would gather, or enter walls.
------------------------------------------------------------------------- */

void FixSPHOpen::post_integrate()
{
  if (has_lost_members()) {
    find_members();
    states.clear();
  }
  values->evaluate(igroup);
  double farthest = 0.0;
  for (const int i : members) {
    double *const x = atom->x[i], *const v = atom->v[i];
    if (atom->mask[i] & groupbit) {
      double u[3], mean[3], motion[3] = {0.0, 0.0, 0.0};
      condition->velocity(i, u);
      set_spin(i);
      if (condition->given_velocity()) condition->prescribed_velocity(i, motion);
      for (int d = 0; d < 3; d++) mean[d] = 0.5 * (v[d] + u[d]);
      const double across = MathExtra::dot3(mean, plane->normal);
      const double change = across - MathExtra::dot3(motion, plane->normal);
      for (int d = 0; d < 3; d++) {
        motion[d] += change * plane->normal[d];
        x[d] += update->dt * (motion[d] - v[d]);
        v[d] = atom->vest[i][d] = u[d];
      }
      farthest = std::max(farthest, across * update->dt);
      if (plane->height(x) >= 0.0) enter(i, mean);
    } else if (atom->mask[i] & fluidbit) {
      const double height = plane->height(x);
      if (height < 0.0 && height >= -plane->length && !plane->beside(x)) leave(i);
    }
  }
  lattice->note_motion(farthest);
  states.clear();
  totals_known = false;
}

/* ----------------------------------------------------------------------
   Turn a particle of the zone into fluid; the integrator of the fluid does the second half of the step.
------------------------------------------------------------------------- */

void FixSPHOpen::enter(int i, const double *v)
{
  atom->mask[i] = (atom->mask[i] & ~groupbit) | fluidbit;
  std::copy_n(v, 3, atom->v[i]);
  compress(i);
  integrator->arrive(i);
  balance->carry(OpenBalance::IN, i, v, atom->esph[i], *fields);
}

/* ----------------------------------------------------------------------
   Change the density of a particle, at constant entropy, to its density in the fluid: the sum over neighbors at the end of
   the step.
------------------------------------------------------------------------- */

void FixSPHOpen::compress(int i)
{
  const auto found =
      std::lower_bound(states.begin(), states.end(), i, [](const auto &one, int other) {
        return one.first < other;
      });
  if (found == states.end() || found->first != i) return;
  if (fluid->model->choice.continuity) return;    // the particle keeps its density
  const double rho = sums[found - states.begin()] + update->dt * atom->drho[i];
  condition->keep(i, condition->at_density(i, found->second, rho));
}

/* ----------------------------------------------------------------------
   Turn a particle of the fluid into a particle of the zone, without strain.  The integrator has extrapolated the internal
   energy to the end of the step: subtract the second half; so energy and density belong to the same time.
------------------------------------------------------------------------- */

void FixSPHOpen::leave(int i)
{
  atom->mask[i] = (atom->mask[i] & ~fluidbit) | groupbit;
  atom->esph[i] -= 0.5 * update->dt * fields->desph_before[i];
  balance->carry(OpenBalance::OUT, i, atom->v[i], atom->esph[i], *fields);
  integrator->depart(i);
  if (!condition->has_heat()) return;
  atom->esph[i] -= fluid->open->state_energy(i);
  condition->density_of_energy(i) = atom->rho[i] + 0.5 * update->dt * atom->drho[i];
}

/* ----------------------------------------------------------------------
   Set the velocity of a particle of the zone that no step has moved.
------------------------------------------------------------------------- */

void FixSPHOpen::set_velocity(int i)
{
  double u[3];
  condition->velocity(i, u);
  for (int d = 0; d < 3; d++) atom->v[i][d] = atom->vest[i][d] = u[d];
  set_spin(i);
}

/* ----------------------------------------------------------------------
   Set spin and internal energy of a particle of the zone to the given values, if the particle moves into the fluid.
   set_state() sets the energy if states include the heat.
------------------------------------------------------------------------- */

void FixSPHOpen::set_spin(int i)
{
  if (values->given(OpenValues::ENERGY) && !condition->has_heat() &&
      MathExtra::dot3(atom->v[i], plane->normal) > 0.0)
    atom->esph[i] = atom->rmass[i] * (*values)(OpenValues::ENERGY, i);
  if (!fields->has_spins) return;
  double *const omega = atom->omega[i];
  if (values->given(OpenValues::WX) && MathExtra::dot3(atom->v[i], plane->normal) > 0.0)
    for (int d = 0; d < 3; d++)
      omega[d] = (*values)(static_cast<OpenValues::Quantity>(OpenValues::WX + d), i);
  std::copy_n(omega, 3, fields->omegaest[i]);
}

/* ---------------------------------------------------------------------- */

void FixSPHOpen::pre_exchange()
{
  check_region();
  lattice->renew([this](const std::vector<int> &created) {
    if (!values->vary()) return;
    values->evaluate(igroup);
    for (const int i : created) set_velocity(i);
  });
}

/* ---------------------------------------------------------------------- */

void FixSPHOpen::final_integrate()
{
  balance->advance(0.5 * update->dt);
  keep_states();
  totals_known = false;
}

/* ---------------------------------------------------------------------- */

void FixSPHOpen::set_impact(const OpenImpact &impact)
{
  balance->set_impact(impact);
}

/* ---------------------------------------------------------------------- */

void FixSPHOpen::set_states(OpenStage &stage, const double *all)
{
  set_times(all + 1);
  samples->finish(condition->clock, all + 3);
  warn(all[0]);
  if (is_new) {
    warn_of_density();
    warn_of_cold_zone();
  }
  is_new = false;
  states.clear();
  sums.clear();
  for (const int i : members)
    if (atom->mask[i] & groupbit) set_state(stage, i);
  totals_known = false;
}

/* ----------------------------------------------------------------------
   Measure the fluid near the plane, and count particles of the fluid that leave faster than sound.  Both need the values of
   variables at these particles: so these particles are in the group of the zone during the evaluation.
------------------------------------------------------------------------- */

void FixSPHOpen::measure(const OpenStage &stage, std::vector<double> &mine)
{
  std::vector<int> near;
  for (const int i : members) {
    if (!(atom->mask[i] & fluidbit)) continue;
    const double height = plane->height(atom->x[i]);
    if (height >= 0.0 && height < radius && !plane->beside(atom->x[i])) near.push_back(i);
  }
  for (const int i : near) atom->mask[i] |= groupbit;
  values->evaluate(igroup);
  for (const int i : near) atom->mask[i] &= ~groupbit;

  samples->begin(condition->clock);
  for (const int i : near) {
    const Particle &particle = stage.particle(i);
    samples->add(particle.x, plane->height(particle.x), particle.vol,
                 condition->sample(i, particle, stage.state_pressure(i)),
                 fluid->model->choice.kernel, radius);
  }
  double fast = 0.0;    // counted with new neighbor lists only
  for (const int i : near)
    if (neighbor->ago == 0 && condition->is_supersonic(i, stage.particle(i))) fast += 1.0;
  mine.push_back(fast);
  measure_sound(mine);
  samples->append(mine);
}

/* ----------------------------------------------------------------------
   With each new neighbor list, check for a gap, and for fluid that leaves faster than sound; warn once of each.  No wave
   comes back from such fluid: no value can be prescribed.  nsupersonic = number of such particles of all processors.
------------------------------------------------------------------------- */

void FixSPHOpen::warn(double nsupersonic)
{
  if (neighbor->ago > 0) return;
  if (!gap) gap = warn_of_gap();
  if (supersonic || !(condition->given_velocity() || condition->given_state())) return;
  supersonic = nsupersonic > 0.0;
  if (supersonic && comm->me == 0)
    error->warning(FLERR,
                   "Fix {} {}: {} particles leave faster than sound at step {}, where only "
                   "condition fixed with velocity, density and pressure from inside is right",
                   style, id, static_cast<bigint>(nsupersonic), update->ntimestep);
}

/* ----------------------------------------------------------------------
   Set density and pressure of a particle of the zone.  The particle keeps its own bulk term: where the term acts on fluid,
   the particle has a full support.
------------------------------------------------------------------------- */

void FixSPHOpen::set_state(OpenStage &stage, int i)
{
  const OpenState state = condition->state(i);
  const double sum = atom->rho[i];
  if (!(state.rho > 0.0) || std::isinf(state.rho)) {
    const double energy = condition->heat(i);
    if (fluid->model->choice.eos == Eos::IDEAL && !(energy > 0.0))
      error->one(FLERR,
                 "Fix {} {}: particle {} has an internal energy of {:g} per mass at step {}, from "
                 "which eos ideal makes no pressure: give the zone one by keyword energy or set",
                 style, id, atom->tag[i], energy, update->ntimestep);
    error->one(FLERR, "Fix {} {}: particle {} would have density {:g} and pressure {:g} at step {}",
               style, id, atom->tag[i], state.rho, state.p, update->ntimestep);
  }
  stage.set_state(i, state.rho, state.p);
  if (!condition->has_heat()) return;
  stage.set_temperature(i, condition->temperature(i, state));
  states.emplace_back(i, state);
  sums.push_back(sum);
}

/* ----------------------------------------------------------------------
   Return a value of the balance, see OpenBalance; behind the balance: number of particles of the zone, mean pressure and mean
   velocity of the fluid at the plane.
------------------------------------------------------------------------- */

double FixSPHOpen::compute_vector(int n)
{
  if (!totals_known) {
    balance->total(totals.data());
    double count = 0.0;
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & groupbit) count += 1.0;
    MPI_Allreduce(&count, &totals[COUNT], 1, MPI_DOUBLE, MPI_SUM, world);
    samples->mean_at_plane(&totals[PRESSURE], &totals[VELOCITY]);
    totals_known = true;
  }
  return totals[n];
}

/* ---------------------------------------------------------------------- */

void FixSPHOpen::write_restart(FILE *fp)
{
  std::vector<double> state(NHEAD);
  balance->total(&state[BALANCE]);
  lattice->pack(&state[LATTICE]);
  state[CLOCK] = condition->clock;
  std::copy_n(plane->point, 3, &state[PLANE]);
  std::copy_n(plane->normal, 3, &state[PLANE + 3]);
  if (comm->me != 0) return;
  const std::vector<double> waves = samples->pack();
  state.insert(state.end(), waves.begin(), waves.end());
  state[0] = -FORMAT;
  state[SIZE] = static_cast<double>(state.size());
  if (state.size() * sizeof(double) > MAXSMALLINT)
    error->one(FLERR, "Fix {} {}: the waves in the zone are too many for a restart file", style,
               id);
  const int size = static_cast<int>(state.size() * sizeof(double));
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(state.data(), sizeof(double), state.size(), fp);
}

/* ---------------------------------------------------------------------- */

void FixSPHOpen::restart(char *buf)
{
  const auto *const state = reinterpret_cast<double *>(buf);
  check_format(lmp, this, state[0], FORMAT);
  balance->restart(state + BALANCE);
  condition->clock = state[CLOCK];
  if (plane->is_at(state + PLANE)) {
    lattice->unpack(state + LATTICE);
    waves_before.assign(state + NHEAD, state + static_cast<int>(state[SIZE]));
  } else
    warn_of_other_plane();
}

/* ----------------------------------------------------------------------
   Warn that the restart file has waves and rows of another plane, and that the run does not use these.
------------------------------------------------------------------------- */

void FixSPHOpen::warn_of_other_plane()
{
  if (comm->me == 0)
    error->warning(FLERR,
                   "Fix {} {}: the plane is not that of the restart file, waves that had left "
                   "through it are forgotten",
                   style, id);
}

/* ---------------------------------------------------------------------- */

double FixSPHOpen::memory_usage()
{
  return samples->memory_usage() + values->memory_usage() + bytes(members, sums) +
      static_cast<double>(states.capacity() * sizeof(std::pair<int, OpenState>));
}
