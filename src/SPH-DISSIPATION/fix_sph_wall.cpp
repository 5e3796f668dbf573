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

#include "fix_sph_wall.h"

#include "atom.h"
#include "citeme.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "math_extra.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_bodies.h"
#include "sph_dissipation_boundary_stage.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_contact.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_integrate.h"
#include "sph_dissipation_keywords.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_value.h"
#include "sph_dissipation_viscous.h"
#include "sph_dissipation_wall_motion.h"
#include "sph_dissipation_wall_terms.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <vector>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace SPHDissipation;

// numbers in restart files: -format, motion, heat given, number of bodies, bodies

static constexpr int FORMAT = 1002;
enum { MOTION = 1, HEAT = MOTION + WallMotion::NRESTART, NBODIES, NSTATE };

static const char cite_wall[] =
    "fix sph/wall command: https://doi.org/10.1016/j.jcp.2012.05.005\n\n"
    "@Article{Adami2012,\n"
    " author =  {S. Adami and X. Y. Hu and N. A. Adams},\n"
    " title =   {A generalized wall boundary condition for smoothed particle hydrodynamics},\n"
    " journal = {Journal of Computational Physics},\n"
    " year =    2012,\n"
    " volume =  231,\n"
    " pages =   {7057--7075},\n"
    " doi =     {10.1016/j.jcp.2012.05.005},\n"
    "}\n\n";

/* ---------------------------------------------------------------------- */

FixSPHWall::FixSPHWall(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), motion(new WallMotion(lmp, fmt::format("Fix {}", style))),
    condition(new WallCondition{false, WallSpin::ZERO, 0.0, {0.0, 0.0, 0.0}}),
    heat(WallHeat::ADIABATIC), heat_value(new Value), gravity(new Value[3]),
    by_molecule(atom->molecule_flag)
{
  std::string others;    // first keyword that bodies do not have
  for (Keywords key(lmp, fmt::format("Fix {}", style), 3, narg, arg); key.next();) {
    if (key.is("velocity", "vx vy vz")) motion->set_velocity(key.words());
    if (key.is("rotate", "px py pz ax ay az omega")) motion->set_rotation(key.words());
    for (const char *one : {"velocity", "rotate", "slip", "spin"})
      if (key.name() == one && others.empty()) others = one;
    if (key.is("move")) {
      elastic = (strcmp(key.word(), "elastic") == 0);
      const bool moved = elastic || strcmp(key.word(), "rigid") == 0;
      bodies.reset(moved ? new Bodies(lmp, groupbit, style, id) : nullptr);
      move = moved || utils::logical(FLERR, key.word(), false, lmp);
    }
    if (key.is("body")) {
      split_given = true;
      by_molecule = (key.choice({"single", "molecule"}) == 1);
    }
    if (key.is("contact", "e mu")) {
      law.reset(new ContactLaw{key.number(0), key.number(1)});
      key.demand(law->restitution >= 0.0 && law->restitution <= 1.0, "between 0 and 1");
      if (law->friction < 0.0)
        error->all(FLERR, "Fix {} contact: the coefficient of friction must be >= 0, not {}", style,
                   key.word(1));
    }
    if (key.is("slip")) condition->slip = (key.choice({"no", "free"}) == 1);
    if (key.is("spin")) {
      condition->spin = static_cast<WallSpin>(key.choice({"zero", "rate", "free"}));
      if (condition->spin == WallSpin::RATE) {
        key.more("alpha");
        condition->alpha = key.number(1);
      }
    }
    if (key.is("heat")) {
      heat = static_cast<WallHeat>(key.choice({"adiabatic", "temp", "flux"}));
      *heat_value = Value();
      if (gives_heat()) {
        key.more(heat == WallHeat::TEMPERATURE ? "T" : "q");
        heat_value->set(lmp, key.word(1));
      }
    }
    if (key.is("gravity", "gx gy gz"))
      for (int d = 0; d < 3; d++) {
        gravity[d] = Value();
        gravity[d].set(lmp, key.word(d));
        condition->gravity[d] = gravity[d].now();
      }
  }

  if (domain->dimension == 2 && !gravity[2].is_zero())
    error->all(FLERR, "Fix {}: velocity and gravity must lie in the plane in 2d", style);
  if (group->dynamic[igroup])
    error->all(FLERR, "Fix {} cannot use dynamic group {}", style, group->names[igroup]);

  if (split_given && !bodies)
    error->all(FLERR, "Fix {} body requires move rigid or move elastic", style);
  if (law && !(bodies && !elastic)) error->all(FLERR, "Fix {} contact requires move rigid", style);
  if (bodies) read_bodies(others);

  time_integrate = bodies ? 0 : 1;
  restart_global = motion->rotates() || gives_heat() || (bodies && !elastic);
  create_attribute = 1;
  vector_flag = peratom_flag = 1;
  size_peratom_cols = 6;
  size_vector = gives_heat() ? 8 : 6;
  global_freq = peratom_freq = 1;
  extvector = 1;
  maxexchange = 6;

  if (lmp->citeme) lmp->citeme->add(cite_wall);

  FixSPHWall::grow_arrays(atom->nmax);
  for (int i = 0; i < atom->nlocal; i++) FixSPHWall::set_arrays(i);
  atom->add_callback(Atom::GROW);
}

/* ---------------------------------------------------------------------- */

FixSPHWall::~FixSPHWall()
{
  if (auto *fluid = find_fluid(force)) fluid->boundary->remove(this);
  include_walls();
  atom->delete_callback(id, Atom::GROW);
  memory->destroy(array_atom);
}

/* ---------------------------------------------------------------------- */

int FixSPHWall::setmask()
{
  return PRE_EXCHANGE | INITIAL_INTEGRATE |
      (bodies ? POST_INTEGRATE | FINAL_INTEGRATE | END_OF_STEP : 0) |
      (heat_value->varies() || gravity_varies() ? PRE_FORCE : 0) | POST_FORCE | MIN_PRE_EXCHANGE |
      MIN_POST_FORCE;
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::init()
{
  Fluid *const fluid = find_fluid(lmp, fmt::format("Fix {}", style));
  if (domain->deform_vremap)
    error->all(FLERR, "Fix {} cannot be used when fix deform remaps velocities", style);

  noise = fluid->model->choice.thermal;
  if (noise && (condition->slip || condition->spin != WallSpin::ZERO))
    error->all(FLERR,
               "Fix {}: only slip no and spin zero can be used with temp of the pair style: the "
               "force of other walls is no friction with which a noise can be in balance",
               style);

  if (fluid->model->choice.own_temperatures && heat == WallHeat::FLUX)
    error->all(
        FLERR,
        "Fix {} heat flux cannot be used with temp energy of the pair style: a given flow of "
        "heat has no equilibrium that a noise can be in balance with",
        style);
  if (fluid->model->choice.own_temperatures && fluid->model->constants().thermal_pressure)
    error->all(FLERR,
               "Fix {} cannot be used with temp energy and eos ideal or gruneisen of the pair "
               "style: the pressure of a wall, whose force must have an energy, does not follow "
               "the heat of the fluid",
               style);

  if (bodies) check_bodies(fluid);
  if (elastic) check_integrator();
  motion->init();
  if (!heat_value->init(lmp, fmt::format("fix {} heat", style), true))
    error->all(FLERR, "Variable {} for fix {} heat is neither of equal style nor of atom style",
               heat_value->name(), style);
  if (!heat_value->varies()) check_heat();
  for (int d = 0; d < 3; d++)
    if (!gravity[d].init(lmp, fmt::format("fix {} gravity", style), false))
      error->all(FLERR, "Variable {} for fix {} gravity is not an equal-style variable",
                 gravity[d].name(), style);
  fluid->boundary->add(this);

  exclude_walls();
  if (bodies)
    bodies->init(by_molecule, !elastic && check_movers());
  else
    check_particles();
  const std::set<int> felt = interacting_types(fluid);
  const auto conducts = [&](int type) {
    return fluid->model->conducts(type);
  };
  if (gives_heat() &&
      (!fluid->model->constants().conducts() ||
       (!felt.empty() && std::none_of(felt.begin(), felt.end(), conducts))))
    error->all(FLERR,
               "Fix {} heat: the fluid at the wall conducts no heat, keyword conductivity of "
               "pair_coeff",
               style);
  if (!gives_heat() || !fluid->model->choice.own_temperatures) return;
  const auto is_cold = [&](int i) {    // where only the coefficients of pairs of types act
    return (atom->mask[i] & groupbit) && !conducts(atom->type[i]);
  };
  if (count_particles(lmp, is_cold))
    error->all(FLERR,
               "Fix {} heat: with temp energy of the pair style, the types of the wall need "
               "a conductivity as well, keyword conductivity of pair_coeff",
               style);
}

/* ---------------------------------------------------------------------- */

bool FixSPHWall::gives_heat() const
{
  return heat != WallHeat::ADIABATIC;
}

/* ---------------------------------------------------------------------- */

bool FixSPHWall::is_wrong(double value) const
{
  return !std::isfinite(value) || (heat == WallHeat::TEMPERATURE && value < 0.0);
}

/* ----------------------------------------------------------------------
   Evaluate the variable of keyword heat when the particles are where the forces are computed.
------------------------------------------------------------------------- */

void FixSPHWall::pre_force(int /*vflag*/)
{
  if (!heat_value->varies() && !gravity_varies()) return;
  modify->clearstep_compute();
  if (heat_value->varies()) heat_value->evaluate(lmp, igroup);
  for (int d = 0; d < 3; d++) {
    gravity[d].evaluate(lmp, igroup);
    gravity[d].demand_finite(lmp, groupbit, fmt::format("Fix {} gravity", style));
    condition->gravity[d] = gravity[d].now();
  }
  modify->addstep_compute(update->ntimestep + 1);
  if (heat_value->varies()) check_heat();
}

/* ---------------------------------------------------------------------- */

bool FixSPHWall::gravity_varies() const
{
  return gravity[0].varies() || gravity[1].varies() || gravity[2].varies();
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::check_heat() const
{
  const char *const what = (heat == WallHeat::TEMPERATURE) ? "temp must be >= 0"
                                                           : "flux must be finite";
  if (!heat_value->is_by_atom()) {
    if (is_wrong(heat_value->now()))
      error->all(FLERR, "Fix {} heat {}, not {}", style, what, heat_value->now());
    return;
  }
  double wrong;
  const std::string where = first_particle(
      lmp,
      [&](int i) {
        return (atom->mask[i] & groupbit) && is_wrong((*heat_value)(i));
      },
      [&](int i) {
        return (*heat_value)(i);
      },
      wrong);
  if (!where.empty()) error->all(FLERR, "Fix {} heat {}, not {} for {}", style, what, wrong, where);
}

/* ----------------------------------------------------------------------
   Set the velocity before the exchange of atoms, so that ghost atoms get it with their borders.  In a minimization, nothing
   moves.
------------------------------------------------------------------------- */

void FixSPHWall::setup_pre_exchange()
{
  if (elastic) {    // fix sph/bulk begins the run for them, as for the fluid
    if (find_fluid(force)->viscous->active())
      error->all(FLERR, "Fix {} move {} cannot be used with {}", style, kind(),
                 "viscous rkl2 or implicit of fix sph/bulk");
    return;
  }
  if (bodies) {
    const bool same = bodies->start(true);
    if (!same) {
      find_fluid(force)->note_change();
      for (int i = 0; i < atom->nlocal; i++)
        if (atom->mask[i] & groupbit) Fields::of(atom)->desph_before[i] = 0.0;
    }
    return set_acting();
  }
  if (update->whichflag == 2)
    motion->stop();
  else
    motion->start();
  if (over_all<int>(world, set_velocity(), MPI_MAX)) find_fluid(force)->note_change();
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::setup(int vflag)
{
  if (!checked) check_thickness(find_fluid(force));
  if (!checked && !elastic) check_pieces(find_fluid(force));
  if (!checked && bodies) check_tension(find_fluid(force));
  checked = true;
  if (bodies && !elastic) {
    if (find_fluid(force)->viscous->active()) check_masses();
    note_forces();
  }
  post_force(vflag);
}

/* ----------------------------------------------------------------------
   Move the wall by the mean velocity of the step, and set the velocities of wall particles; for bodies, begin the step of the
   internal energies.
------------------------------------------------------------------------- */

void FixSPHWall::initial_integrate(int /*vflag*/)
{
  check_set_up(lmp, this, checked);
  if (bodies) {
    const TimeStep step = {update->dt, 0.0, 1.0, 1.0, false};
    double *const before = Fields::of(atom)->desph_before;
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & groupbit) step.begin_energy(atom->desph[i], atom->esph[i], before[i]);
    return;
  }
  motion->advance();

  if (move) {
    const WallVelocity now = motion->velocity();
    const WallStep step = motion->last_step();
    double r[3];
    for (int i = 0; i < atom->nlocal; i++) {
      if (!(atom->mask[i] & groupbit)) continue;
      from_point(i, now, r);
      step.move(r, atom->x[i]);
    }
    motion->move_point();
  }
  set_velocity();
}

/* ----------------------------------------------------------------------
   Take the motion of bodies that another fix has moved; for particles that move one by one, from their last forces.
------------------------------------------------------------------------- */

void FixSPHWall::post_integrate()
{
  if (elastic) {
    const double ahead = find_fluid(force)->viscous->choice().extrapolation(noise);
    const double dtf = 0.5 * ahead * update->dt * force->ftm2v;
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & groupbit)
        for (int d = 0; d < 3; d++)
          atom->vest[i][d] = atom->v[i][d] + dtf / atom->rmass[i] * atom->f[i][d];
    return;
  }
  bodies->advance(find_fluid(force)->viscous->choice().extrapolation(noise));
  add_rest_of_heat();
  set_acting();
}

void FixSPHWall::set_acting()
{
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) bodies->velocity_at(i, atom->vest[i]);
}

void FixSPHWall::final_integrate()
{
  const TimeStep step = {update->dt, 0.0, 1.0, 1.0, false};
  double *const before = Fields::of(atom)->desph_before;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) step.end_energy(atom->desph[i], before[i], atom->esph[i]);
}

void FixSPHWall::end_of_step()
{
  if (elastic) return;
  bodies->end_step();
  note_forces();
  add_rest_of_heat();
}

void FixSPHWall::note_forces()
{
  const Fluid *const fluid = find_fluid(force);
  if (fluid->viscous->active()) bodies->note_forces(fluid->own_forces());
}

/* ----------------------------------------------------------------------
   With viscous rkl2 or implicit, add the heat that the forces leave out, as fix sph/bulk does for the fluid.
------------------------------------------------------------------------- */

void FixSPHWall::add_rest_of_heat()
{
  if (!find_fluid(force)->viscous->active()) return;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) atom->esph[i] += bodies->rest_of_heat(i);
}

/* ---------------------------------------------------------------------- */

int FixSPHWall::number_bodies(int first, double *body)
{
  if (!bodies) return first;
  first_number = first;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) body[i] = first + bodies->of(i);
  return first + bodies->size();
}

RigidMotions *FixSPHWall::rigid_motions()
{
  return elastic ? nullptr : bodies.get();
}

/* ---------------------------------------------------------------------- */

bool FixSPHWall::set_velocity()
{
  constexpr double ROUNDOFF = 1.0e-10;
  const WallVelocity now = motion->velocity();
  double r[3];
  bool changed = false;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    from_point(i, now, r);
    double *const v = atom->v[i], before[3] = {v[0], v[1], v[2]};
    now.at(r, v);
    std::copy_n(v, 3, atom->vest[i]);
    if (atom->omega) now.angular(atom->omega[i]);
    changed = changed ||
        MathExtra::distsq3(v, before) > ROUNDOFF * ROUNDOFF * MathExtra::lensq3(before);
  }
  return changed;
}

/* ----------------------------------------------------------------------
   Return whether the normals turn with the motion of the last step.
------------------------------------------------------------------------- */

bool FixSPHWall::turns_surface(bool before) const
{
  return before && motion->rotates() && move && update->whichflag == 1;
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::move_surface(BoundaryStage &stage, Surface *surface, bool before)
{
  if (elastic) return;    // the surface stays until the next list; the friction needs no omega
  const WallVelocity now = motion->velocity();
  const bool turns = bodies ? before : turns_surface(before);
  const WallStep step = motion->last_step();
  stage.for_each(atom->nlocal + atom->nghost, [&](int i) {
    if (!(atom->mask[i] & groupbit)) return;
    const Bodies::Body *const body = bodies ? &(*bodies)[stage.body(i) - first_number] : nullptr;
    if (body)
      std::copy_n(body->omega, 3, surface[i].omega);
    else
      now.angular(surface[i].omega);
    if (!turns) return;
    double turned[3];
    MathExtra::matvec(body ? body->rotation : step.rotation, surface[i].normal, turned);
    std::copy_n(turned, 3, surface[i].normal);
  });
}

/* ----------------------------------------------------------------------
   Set the values of the wall particles in the pair forces.  An extrapolated pressure has no energy: a minimization sets
   it to zero, so that the forces are the gradient of the energy of the fluid.
------------------------------------------------------------------------- */

void FixSPHWall::set_boundary(BoundaryStage &stage, const Surface *surfaces,
                              const BoundarySum *sums)
{
  if (update->whichflag == 2) return;

  if (bodies) {
    stage.for_each(atom->nlocal, [&](int i) {
      if (!(atom->mask[i] & groupbit)) return;
      stage.set_frozen(i, condition->gravity);
    });
    return;
  }

  const WallVelocity now = motion->velocity();
  stage.for_each(atom->nlocal, [&](int i) {
    if (!(atom->mask[i] & groupbit)) return;
    const BoundarySum &sum = sums[i];
    double *const spin = stage.spin(i);
    if (spin) now.angular(spin);
    if (!(sum.weight > 0.0)) return;

    double r[3], acceleration[3];
    from_point(i, now, r);
    now.acceleration_at(r, acceleration);

    if (noise)
      stage.rest_at_surface(i, *condition, surfaces[i], acceleration);
    else
      stage.extend_fluid(i, *condition, surfaces[i], sum, acceleration);
  });
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::set_heat(BoundaryStage &stage, const Surface *surfaces, bool increments)
{
  if (update->whichflag == 2) return;
  stage.for_each(atom->nlocal, [&](int i) {
    if (atom->mask[i] & groupbit)
      stage.set_heat(i, heat, increments ? 0.0 : (*heat_value)(i), surfaces[i]);
  });
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::post_force(int /*vflag*/)
{
  double **f = atom->f;
  double **torque = atom->torque;
  std::fill(total, total + 6, 0.0);
  total_summed = false;
  const WallVelocity now = motion->velocity();
  if (neighbor->ago == 0 && atom->nlocal > 0)    // rows of other particles stay zero
    std::fill_n(array_atom[0], 6 * static_cast<std::size_t>(atom->nlocal), 0.0);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    double *const one = array_atom[i];
    double r[3], moment[3];
    from_point(i, now, r);
    cross_product(r, f[i], moment);
    for (int d = 0; d < 3; d++) {
      one[d] = f[i][d];
      if (torque) one[3 + d] = torque[i][d];
      total[d] += one[d];
      total[3 + d] += moment[d] + one[3 + d];
    }
  }
  if (!bodies) add_contact();
  book_heat();
}

/* ----------------------------------------------------------------------
   Add force and torque of the bodies that touch the wall, which are in no sum of a wall particle.
------------------------------------------------------------------------- */

void FixSPHWall::add_contact()
{
  const Fluid *const fluid = find_fluid(force);
  if (comm->me != 0 || !fluid->boundary->has_contact()) return;
  double pushed[6], moment[3];
  fluid->contact->force_on(this, pushed);
  cross_product(motion->velocity().point, pushed, moment);
  for (int d = 0; d < 3; d++) {
    total[d] += pushed[d];
    total[3 + d] += pushed[3 + d] - moment[d];
  }
}

/* ----------------------------------------------------------------------
   Add the heat of a step, from the mean of the rates at both ends, as in the internal energies of the fluid.
------------------------------------------------------------------------- */

void FixSPHWall::book_heat()
{
  if (!gives_heat()) return;
  const double before = heat_rate;
  heat_rate = 0.0 - find_fluid(force)->received_heat(groupbit);
  if (update->whichflag == 1 && !update->setupflag)
    heat_given += 0.5 * update->dt * (before + heat_rate);
}

/* ----------------------------------------------------------------------
   Warn if a wall with a flux has cooled particles below the temperature 0.
------------------------------------------------------------------------- */

void FixSPHWall::post_run()
{
  if (heat != WallHeat::FLUX || !(compute_vector(6) < 0.0)) return;
  const Fluid *const fluid = find_fluid(force);
  std::vector<double> temperature(atom->nlocal);
  fluid->temperatures(temperature.data());
  bigint cold = 0, all;
  double lowest = 0.0, lowest_all;
  for (const double T : temperature) {
    if (T < 0.0) cold++;
    lowest = std::min(lowest, T);
  }
  MPI_Allreduce(&cold, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  MPI_Allreduce(&lowest, &lowest_all, 1, MPI_DOUBLE, MPI_MIN, world);
  if (all && comm->me == 0)
    error->warning(FLERR,
                   "Fix {} {} heat flux has taken more heat than there is: {} particles of the "
                   "fluid have a temperature below 0, down to {:g}",
                   id, style, all, lowest_all);
}

/* ----------------------------------------------------------------------
   Set the forces on the wall to 0: a minimizer must not move the wall.
------------------------------------------------------------------------- */

void FixSPHWall::min_post_force(int vflag)
{
  post_force(vflag);
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) std::fill_n(atom->f[i], 3, 0.0);
}

/* ----------------------------------------------------------------------
   Return a component of force (n = 0 to 2) and torque (3 to 5) on the wall; heat per time (6) and heat (7) given to the
   fluid.
------------------------------------------------------------------------- */

double FixSPHWall::compute_vector(int n)
{
  if (n >= 6) return over_all(world, (n == 6) ? heat_rate : heat_given, MPI_SUM);
  if (!total_summed) MPI_Allreduce(total, total_all, 6, MPI_DOUBLE, MPI_SUM, world);
  total_summed = true;
  return total_all[n];
}

/* ----------------------------------------------------------------------
   Set r to the vector from the point on the axis to a particle.
------------------------------------------------------------------------- */

void FixSPHWall::from_point(int i, const WallVelocity &now, double *r) const
{
  domain->unmap(atom->x[i], atom->image[i], r);
  for (int d = 0; d < 3; d++) r[d] -= now.point[d];
}

/* ----------------------------------------------------------------------
   Write the motion with the point on the axis, since this point moves with the wall; the heat given so far; the bodies.
------------------------------------------------------------------------- */

void FixSPHWall::write_restart(FILE *fp)
{
  std::vector<double> state(NSTATE, 0.0);
  state[0] = -FORMAT;
  MPI_Reduce(&heat_given, &state[HEAT], 1, MPI_DOUBLE, MPI_SUM, 0, world);
  if (comm->me != 0) return;
  motion->pack_restart(&state[MOTION]);
  const bool rigid = bodies && !elastic;
  state[NBODIES] = rigid ? bodies->size() : 0;
  if (rigid) bodies->pack_restart(state);
  const int size = static_cast<int>(state.size() * sizeof(double));
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(state.data(), sizeof(double), state.size(), fp);
}

/* ---------------------------------------------------------------------- */

void FixSPHWall::restart(char *buf)
{
  const auto *const state = reinterpret_cast<double *>(buf);
  check_format(lmp, this, state[0], FORMAT);
  motion->restart(state + MOTION);
  if (bodies && !elastic) bodies->restart(state + NSTATE, static_cast<int>(state[NBODIES]));
  if (gives_heat() && comm->me == 0) heat_given = state[HEAT];
}

/* ----------------------------------------------------------------------
   Force and couple on each particle, array_atom: rows of wall particles migrate, rows of other particles are 0.
------------------------------------------------------------------------- */

void FixSPHWall::grow_arrays(int nmax)
{
  memory->grow(array_atom, nmax, 6, "sph/wall:array_atom");
}

void FixSPHWall::set_arrays(int i)
{
  std::fill_n(array_atom[i], 6, 0.0);
}

void FixSPHWall::copy_arrays(int i, int j, int /*delflag*/)
{
  std::copy_n(array_atom[i], 6, array_atom[j]);
}

int FixSPHWall::pack_exchange(int i, double *buf)
{
  if (!(atom->mask[i] & groupbit)) return 0;
  std::copy_n(array_atom[i], 6, buf);
  return 6;
}

int FixSPHWall::unpack_exchange(int i, double *buf)
{
  set_arrays(i);
  if (!(atom->mask[i] & groupbit)) return 0;
  std::copy_n(buf, 6, array_atom[i]);
  return 6;
}

/* ---------------------------------------------------------------------- */

double FixSPHWall::memory_usage()
{
  return 6.0 * atom->nmax * sizeof(double) + heat_value->memory_usage();
}
