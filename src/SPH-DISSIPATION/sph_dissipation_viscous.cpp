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

#include "sph_dissipation_viscous.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "neighbor.h"
#include "platform.h"
#include "sph_dissipation_boundary_stage.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_integrate.h"
#include "sph_dissipation_particle_terms.h"
#include "sph_dissipation_solvers.h"
#include "sph_dissipation_stages.h"
#include "update.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <utility>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

void StiffStage::configure(const ViscousSettings &settings_in, int groups_in,
                           const std::string &style_in)
{
  settings = settings_in;
  groups = groups_in;
  style = style_in;
}

/* ----------------------------------------------------------------------
   Set increment to acting - keep * now; then set acting to keep * now + scale * (f - own).  acting = velocity in the forces,
   now = present velocity, f = total force, own = force of the pair style, so f - own = force of other styles.
------------------------------------------------------------------------- */

static void carry(double scale, const double *f, const double *own, const double *now, double keep,
                  double *acting, double *increment)
{
  for (int d = 0; d < 3; d++) {
    increment[d] = acting[d] - keep * now[d];
    acting[d] = keep * now[d] + scale * (f[d] - own[d]);
  }
}

/* ---------------------------------------------------------------------- */

void ViscousStage::begin_carrying()
{
  const auto needed = 3 * static_cast<std::size_t>(atom->nlocal);
  if (ahead.size() < needed) ahead.resize(3 * atom->nmax);
  if (engine.has_spin() && ahead_spin.size() < needed) ahead_spin.resize(3 * atom->nmax);
}

/* ---------------------------------------------------------------------- */

void ViscousStage::carry_force(int i, double keep)
{
  if (!is_unknown(i)) return;
  carry(update->dt / atom->rmass[i], atom->f[i], engine.force[i].f, atom->v[i], keep, atom->vest[i],
        &ahead[3 * i]);
}

/* ---------------------------------------------------------------------- */

void ViscousStage::carry_torque(int i, const double *inertia, double **spins)
{
  if (!is_unknown(i)) return;
  carry(update->dt * TimeStep::inverse_inertia(atom->rmass[i], inertia[i]), atom->torque[i],
        engine.side.torque(i), atom->omega[i], 1.0, spins[i], &ahead_spin[3 * i]);
}

/* ---------------------------------------------------------------------- */

void ViscousStage::begin(int prescribed_in, double **omegaest_in, const double *inertia)
{
  prescribed = prescribed_in;
  omegaest = omegaest_in;
  width = omegaest ? 6 : 3;
  find_unknowns(inertia);
  set_guess();
  set_aside();
}

/* ---------------------------------------------------------------------- */

void StiffStage::set_aside()
{
  const std::size_t nall = atom->nlocal + atom->nghost;
  if (nall == 0) return;
  double *const f = atom->f[0];
  forces_before.assign(f, f + 3 * nall);
  std::fill_n(f, 3 * nall, 0.0);
  heat_before.assign(atom->desph, atom->desph + nall);
  if (!engine.has_spin()) return;
  double *const torque = atom->torque[0];
  torques_before.assign(torque, torque + 3 * nall);
  std::fill_n(torque, 3 * nall, 0.0);
}

/* ---------------------------------------------------------------------- */

void StiffStage::restore()
{
  if (atom->nlocal + atom->nghost == 0) return;
  std::copy(forces_before.begin(), forces_before.end(), atom->f[0]);
  std::copy(heat_before.begin(), heat_before.end(), atom->desph);
  if (engine.has_spin()) std::copy(torques_before.begin(), torques_before.end(), atom->torque[0]);
}

/* ---------------------------------------------------------------------- */

void StiffStage::begin_run()
{
  warned = false;
  statistics[APPLICATIONS] = 0.0;
}

/* ---------------------------------------------------------------------- */

void ViscousStage::run(NeighList *list_in, const double *bound_in, bool symmetric_in)
{
  const double begin = platform::walltime();
  list = list_in;
  bound = bound_in;
  symmetric = symmetric_in;

  exchange.reverse({{atom->nmax ? atom->f[0] : nullptr, 3, 3},
                    {omegaest && atom->nmax ? atom->torque[0] : nullptr, 3, omegaest ? 3 : 0}});
  gather();
  restore();
  if (boundary.has_mean_pressure()) {
    boundary.note_pressures();
    find_rest();
  }

  solve_step();
  add_velocities(x);
  Unknowns acting(x.begin() + first_of_bodies(), x.end());
  for (std::size_t k = 0; k < acting.size(); k++) acting[k] += rigid.of().guess[k];
  rigid.act(acting.data());
  statistics[SECONDS] = platform::walltime() - begin;
}

/* ----------------------------------------------------------------------
   Find x from before, guess, and force.
------------------------------------------------------------------------- */

void StiffStage::solve_step()
{
  if (update->setupflag) outdated = true;
  statistics[ITERATIONS] = statistics[RESIDUAL] = 0.0;
  if (update->setupflag)
    start();
  else
    step(update->dt);
  outdated = false;
}

/* ---------------------------------------------------------------------- */

bool StiffStage::is_unknown(int i) const
{
  return (atom->mask[i] & groups) && !(atom->mask[i] & prescribed) &&
      !engine.parameters().type[atom->type[i]].other;
}

/* ---------------------------------------------------------------------- */

void StiffStage::resize()
{
  for (Unknowns *one : {&mass, &inverse_mass, &x, &residual, &before, &guess, &force})
    one->resize(first_of_bodies() + rows_of_bodies);
}

/* ----------------------------------------------------------------------
   Find the unknown particles and bodies, their masses, and their velocities before the step.  Particles without inertia have
   no torques: their spin does not change.
------------------------------------------------------------------------- */

void ViscousStage::find_unknowns(const double *inertia)
{
  unknown.clear();
  for (int i = 0; i < atom->nlocal; i++)
    if (is_unknown(i)) unknown.push_back(i);
  rigid.find(update->setupflag);
  rows_of_bodies = rigid.size();

  resize();
  others.resize(x.size());
  for_unknown([&](int i, std::size_t first) {
    for (int d = 0; d < width; d++) {
      const bool turns = (d >= 3);
      const std::size_t row = first + d;
      mass[row] = turns ? atom->rmass[i] * inertia[i] : atom->rmass[i];
      inverse_mass[row] = (mass[row] > 0.0) ? 1.0 / mass[row] : 0.0;
      before[row] = turns ? atom->omega[i][d - 3] : atom->v[i][d];
    }
  });
  for (int k = 0; k < rows_of_bodies; k++) {
    const std::size_t row = first_of_bodies() + k;
    mass[row] = rigid.of().mass[k];
    inverse_mass[row] = (mass[row] > 0.0) ? 1.0 / mass[row] : 0.0;
    before[row] = rigid.of().before[k];
    others[row] = rigid.of().others[k];
  }
}

/* ----------------------------------------------------------------------
   Take the forces of other styles from vest, and set vest to the guess of the integrator.  Set vest to v- if the order of the
   particles may have changed, and at the start of a run, when vest contains no forces.
------------------------------------------------------------------------- */

void ViscousStage::set_guess()
{
  const bool starts = update->setupflag;
  const std::size_t nall = atom->nlocal + atom->nghost, nlocal = atom->nlocal;
  const double rate = (starts || update->dt == 0.0) ? 0.0 : 1.0 / update->dt;
  const bool same = !starts && neighbor->ago > 0 && ahead.size() >= 3 * nlocal &&
      (!omegaest || ahead_spin.size() >= 3 * nlocal);
  std::vector<double> change[2];    // of vest, and omegaest
  for (int s = 0; s < width / 3; s++) change[s].assign(3 * nall, 0.0);
  for_unknown([&](int i, std::size_t first) {
    for (int d = 0; d < width; d++) {
      const int s = d / 3, c = d % 3;
      const std::size_t row = first + d;
      const double carried = (s ? omegaest[i][c] : atom->vest[i][c]) - before[row];
      others[row] = rate * mass[row] * carried;
      change[s][3 * i + c] = (same ? (s ? ahead_spin : ahead)[3 * i + c] : 0.0) - carried;
    }
  });
  rigid.velocities(rigid.of().guess.data(), [&](int i, const double *u) {
    for (int c = 0; c < 3; c++) change[0][3 * i + c] = u[c] - atom->vest[i][c];
  });

  exchange.forward({{change[0].data(), 3, 3}, {change[1].data(), 3, omegaest ? 3 : 0}});
  engine.for_each(static_cast<int>(nall), [&](int i) {
    for (int c = 0; c < 3; c++) {
      atom->vest[i][c] += change[0][3 * i + c];
      if (omegaest) omegaest[i][c] += change[1][3 * i + c];
    }
  });
}

/* ----------------------------------------------------------------------
   Set guess and force of all unknowns, from vest and the forces of LAMMPS, and the mean velocity.
------------------------------------------------------------------------- */

void ViscousStage::gather()
{
  double sums[4] = {0.0, 0.0, 0.0, 0.0};
  for (std::size_t k = 0; k < unknown.size(); k++) {
    const int i = unknown[k];
    for (int d = 0; d < width; d++) {
      const bool turns = (d >= 3);
      const std::size_t row = width * k + d;
      guess[row] = turns ? omegaest[i][d - 3] : atom->vest[i][d];
      force[row] = (turns ? atom->torque[i][d - 3] : atom->f[i][d]) + others[row];
      if (!turns) sums[d] += mass[row] * before[row];
    }
    sums[3] += atom->rmass[i];
  }
  const double *const on_bodies = rigid.forces([this](int i) {
    return atom->f[i];
  });
  for (int k = 0; k < rows_of_bodies; k++) {
    const std::size_t row = first_of_bodies() + k;
    guess[row] = rigid.of().guess[k];
    force[row] = on_bodies[k] + others[row];
  }
  if (settings.mode != Viscous::IMPLICIT) return;    // rkl2 needs no scale
  sum(sums, 4);
  for (int d = 0; d < 3; d++) mean[d] = (sums[3] > 0.0) ? sums[d] / sums[3] : 0.0;
}

/* ----------------------------------------------------------------------
   Set the velocities of owned and ghost particles for the loops to increments, 0 for particles with known velocities.
------------------------------------------------------------------------- */

void ViscousStage::set_velocities(const Unknowns &values)
{
  Particle *const particle = engine.particle;
  engine.for_each(atom->nlocal, [&](int i) {
    std::fill_n(particle[i].u, 3, 0.0);
    if (omegaest) std::fill_n(engine.spin[i].w, 3, 0.0);
  });
  for_unknown([&](int i, std::size_t row) {
    std::copy_n(&values[row], 3, particle[i].u);
    if (omegaest) std::copy_n(&values[row + 3], 3, engine.spin[i].w);
  });
  rigid.velocities(values.data() + first_of_bodies(), [&](int i, const double *u) {
    std::copy_n(u, 3, particle[i].u);
  });
  exchange.forward({field(particle, particle->u, 3), engine.spins()});
}

/* ----------------------------------------------------------------------
   Find cdot and the bulk term of owned and ghost particles from the velocities in engine.particle[].
------------------------------------------------------------------------- */

void ViscousStage::set_bulk_term()
{
  DensitySum *const density = engine.density;
  if (engine.constants().bulk != Bulk::NONE) {
    engine.accumulate_rates();
    const Field cdot = field(density, &density->cdot, 1);
    exchange.reverse({cdot});
    exchange.forward({cdot});
  }
  pressure.set_bulk_term(bound, boundary.bits());
}

/* ----------------------------------------------------------------------
   Store the values of boundary particles if all increments of the fluid are 0; friction() subtracts these values.
------------------------------------------------------------------------- */

void ViscousStage::find_rest()
{
  rest.clear();
  set_velocities(Unknowns(x.size(), 0.0));
  set_bulk_term();
  boundary.extend(true);
  for (int i = 0; i < atom->nlocal + atom->nghost; i++) {
    if (!(atom->mask[i] & boundary.bits())) continue;
    const Particle &p = engine.particle[i];
    Rest one = {i, {p.u[0], p.u[1], p.u[2]}, p.g, engine.zeta_term[i], {0.0, 0.0, 0.0}};
    if (omegaest) std::copy_n(engine.spin[i].w, 3, one.w);
    rest.push_back(one);
  }
}

/* ----------------------------------------------------------------------
   Set out = Gamma in: minus the linear friction forces and torques at the velocity increments in.
------------------------------------------------------------------------- */

void ViscousStage::friction(const Unknowns &in, Unknowns &out)
{
  set_velocities(in);
  set_bulk_term();
  if (boundary.has_mean_pressure()) {
    boundary.extend(true);
    for (const auto &one : rest) {
      Particle &p = engine.particle[one.i];
      p.g -= one.g;
      engine.zeta_term[one.i] -= one.zeta_term;
      for (int d = 0; d < 3; d++) {
        p.u[d] -= one.u[d];
        if (omegaest) engine.spin[one.i].w[d] -= one.w[d];
      }
    }
  }

  engine.accumulate_friction(list, prescribed);
  boundary.add_linear_friction();
  exchange.reverse({field(engine.force, engine.force->f, 3), engine.torques()});
  for_unknown([&](int i, std::size_t row) {
    for (int d = 0; d < 3; d++) {
      out[row + d] = -engine.force[i].f[d];
      if (omegaest) out[row + 3 + d] = -engine.side.torque(i)[d];
    }
  });
  const double *const on_bodies = rigid.forces([this](int i) {
    return engine.force[i].f;
  });
  for (int k = 0; k < rows_of_bodies; k++) out[first_of_bodies() + k] = -on_bodies[k];
}

/* ----------------------------------------------------------------------
   Set out = (M + h Gamma) in.
------------------------------------------------------------------------- */

void StiffStage::apply(const Unknowns &in, Unknowns &out)
{
  statistics[APPLICATIONS] += 1.0;
  friction(in, out);
  engine.for_each(static_cast<int>(in.size()), [&](int k) {
    out[k] = mass[k] * in[k] + h * out[k];
  });
}

Threads &StiffStage::team() const
{
  return engine.team();
}

/* ---------------------------------------------------------------------- */

void StiffStage::sum(double *values, int n) const
{
  MPI_Allreduce(MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_SUM, world);
}

/* ----------------------------------------------------------------------
   Return the square of the scale of the residual.  The scale includes the velocity that moves particles by the rounding
   error of positions: a smaller residual needs no iteration.  Bodies, which may be heavy, do not count: the tolerance holds
   for the velocities of the fluid.
------------------------------------------------------------------------- */

double ViscousStage::scale_sq() const
{
  const double distance = DBL_EPSILON * engine.constants().support;
  const double rest = (update->dt > 0.0) ? distance / (update->dt * settings.tolerance) : 0.0;
  return team().sum<double>(static_cast<int>(first_of_bodies()), [&](int k, double &total) {
    const int d = k % width;
    const double frame = (d < 3) ? mean[d] : 0.0;
    const double v0 = before[k] - frame, v = guess[k] + x[k] - frame;
    total += 0.5 * mass[k] * (v0 * v0 + v * v);
    if (d == 0) total += mass[k] * rest * rest;
  });
}

/* ----------------------------------------------------------------------
   Solve (M + h Gamma) x = residual; warn once in a run, or stop, if the iterations do not converge.
------------------------------------------------------------------------- */

void StiffStage::solve()
{
  std::fill(x.begin(), x.end(), 0.0);
  Krylov<StiffStage> krylov(*this, settings.tolerance, settings.iterations);
  const Solution found = symmetric ? krylov.conjugate_gradients() : krylov.bi_conjugate_gradients();
  statistics[ITERATIONS] += found.applications;
  statistics[RESIDUAL] = std::max(statistics[RESIDUAL], found.residual);
  check_finite(found.finite);
  if (found.converged) return;

  if (found.indefinite)
    error->all(FLERR, Error::NOLASTLINE,
               "Fix {} viscous implicit: there is a motion with negative friction at step {}; the "
               "bulk viscosity is too small for the arrangement of the particles, use limit yes of "
               "pair style {} or a larger kappa",
               style, moment(), style);
  const std::string message =
      fmt::format("Fix {} viscous implicit: residual {:.3g}, above the tolerance {:g}, after {} "
                  "iterations at step {}",
                  style, found.residual, settings.tolerance, found.applications, moment());
  if (settings.must_converge) error->all(FLERR, Error::NOLASTLINE, message);
  if (found.residual >= 1.0)
    error->all(
        FLERR, Error::NOLASTLINE,
        "Fix {} viscous implicit: residual {:.3g}, which is no solution, after {} iterations "
        "at step {}; use a smaller time step or more iterations",
        style, found.residual, found.applications, moment());
  if (!warned && comm->me == 0) error->warning(FLERR, message);
  warned = true;
}

/* ---------------------------------------------------------------------- */

std::string StiffStage::moment() const
{
  return fmt::format("{}{}", update->ntimestep, where);
}

/* ----------------------------------------------------------------------
   Stop if values are not finite; all processors pass the same argument.
------------------------------------------------------------------------- */

void StiffStage::check_finite(bool finite) const
{
  if (!finite)
    error->all(FLERR, Error::NOLASTLINE,
               "Fix {} viscous rkl2 or implicit: positions, velocities, or forces are not finite "
               "numbers at step {}",
               style, moment());
}

/* ----------------------------------------------------------------------
   Find x = y_b - guess for a step of this length.
------------------------------------------------------------------------- */

void StiffStage::step(double interval)
{
  if (settings.mode == Viscous::RKL2)
    rkl2_step(interval);
  else if (settings.scheme == Scheme::SDIRK2)
    sdirk2_step(interval);
  else
    implicit_step((settings.scheme == Scheme::EULER) ? interval : 0.5 * interval);
}

/* ----------------------------------------------------------------------
   Find y_b at the start of a run, when y- belongs to the time of the positions.  Extrapolate from y_b of two intervals: then
   y_b is y- to second order.  With these intervals, the half kick removes all stiff motion; the trapezoidal step needs twice
   the interval of the other schemes.
------------------------------------------------------------------------- */

void StiffStage::start()
{
  const double interval = (settings.trapezoidal() ? 3.0 : 1.5) * update->dt;
  const Unknowns guess_before = guess;
  step(0.5 * interval);
  const Unknowns half = x;
  guess = guess_before;
  step(interval);
  for (std::size_t k = 0; k < x.size(); k++) x[k] = 2.0 * half[k] - x[k];
}

/* ----------------------------------------------------------------------
   Solve M (y_b - y-) = h F(y_b) with y_b = guess + x, F(y_b) = F(guess) - Gamma x.
------------------------------------------------------------------------- */

void StiffStage::implicit_step(double part)
{
  h = part;
  for (std::size_t k = 0; k < x.size(); k++)
    residual[k] = mass[k] * (before[k] - guess[k]) + h * force[k];
  solve();
}

/* ----------------------------------------------------------------------
   Solve M (Y1 - y-) = h F(Y1), M (Y2 - y-) = (dt - h) F(Y1) + h F(Y2), h = gamma dt.  The residual of the first solution,
   h F(Y1) - M (Y1 - y-), gives F(Y1) without another application of Gamma.
------------------------------------------------------------------------- */

void StiffStage::sdirk2_step(double interval)
{
  constexpr double GAMMA = SDIRK2_GAMMA;
  implicit_step(GAMMA * interval);
  const Unknowns first = x;
  for (std::size_t k = 0; k < x.size(); k++) {
    guess[k] += first[k];
    residual[k] = (1.0 / GAMMA - 1.0) * mass[k] * (guess[k] - before[k]) + residual[k] / GAMMA;
  }
  solve();
  for (std::size_t k = 0; k < x.size(); k++) x[k] = first[k] + GAMMA * x[k];
}

/* ----------------------------------------------------------------------
   Return a lower estimate of the rate of the fastest mode, by power iteration from a disordered vector.  The rate of
   disordered particles, and of particles near free surfaces, where volumes are large, may be larger than on lattices.
------------------------------------------------------------------------- */

double StiffStage::estimated_rate()
{
  constexpr int NITERATION = 12;
  constexpr double WAVES[6] = {391.7, 577.3, 733.1, 811.9, 929.3, 1117.7};    // per support radius
  const double unit = 1.0 / engine.constants().support;
  const std::size_t n = mass.size();
  Unknowns u(n), drag(n);
  for (std::size_t k = 0; k < n; k++) {
    if (k >= first_of_bodies()) {
      drag[k] = mass[k] * sin(WAVES[0] * (k - first_of_bodies() + 1));
      continue;
    }
    const double *const position = atom->x[unknown[k / width]];
    const std::size_t d = k % width;
    const double phase = position[0] * WAVES[d] + position[1] * WAVES[(d + 1) % 6] +
        position[2] * WAVES[(d + 2) % 6];
    drag[k] = mass[k] * sin(phase * unit);
  }

  double estimate = 0.0;
  for (int iteration = 0; iteration <= NITERATION; iteration++) {
    double square = 0.0;
    for (std::size_t k = 0; k < n; k++) square += drag[k] * inverse_mass[k] * drag[k];
    sum(&square, 1);
    estimate = sqrt(square);
    if (iteration == NITERATION || !(square > 0.0)) break;
    for (std::size_t k = 0; k < n; k++) u[k] = inverse_mass[k] * drag[k] / estimate;
    statistics[APPLICATIONS] += 1.0;
    friction(u, drag);
  }
  return estimate;
}

/* ----------------------------------------------------------------------
   Compute the increments Y_j of the stages, and Z_j with M Y_j = dt (theta_j F(y-) - Gamma Z_j), theta_s = 1:
   y_b = y- + Z_s, and x = Z_s since the guess is y-.
------------------------------------------------------------------------- */

void StiffStage::rkl2_step(double interval)
{
  constexpr int OFTEN = 20;          // steps between estimates
  constexpr double SAFETY = 1.15;    // factor of estimates, which are too low
  if (outdated || (update->ntimestep % OFTEN == 0 && !update->setupflag)) {
    const double estimate = estimated_rate();
    check_finite(std::isfinite(estimate));
    rate = std::max(known_rate, SAFETY * estimate);
    outdated = false;
  }
  const double modes = rate * interval;
  const double needed = RKL2::stages_for(modes);
  if (!(needed <= RKL2::MOST))
    error->all(
        FLERR, Error::NOLASTLINE,
        "Fix {} viscous rkl2: the largest viscous rate times the time step is {:.4g} at step "
        "{}, which needs {:.4g} stages, and {} are the most; use viscous "
        "implicit or a smaller time step",
        style, modes, moment(), needed, static_cast<int>(RKL2::MOST));
  const int fewest = static_cast<int>(needed);
  const int s = !settings.stages ? fewest
      : update->setupflag        ? std::max(settings.stages, fewest)
                                 : settings.stages;
  if (modes > RKL2::rate_limit(s))
    error->all(
        FLERR, Error::NOLASTLINE,
        "Fix {} viscous rkl2: the largest viscous rate times the time step is {:.4g} at step {}, "
        "which needs {} stages, not {}",
        style, modes, moment(), fewest, s);
  statistics[ITERATIONS] = s;

  const RKL2 rkl2(s);
  const auto n = static_cast<int>(x.size());
  Unknowns first(n), y(n), y_old(n, 0.0), z_old(n, 0.0), drag(n);
  Unknowns &z = x;
  std::fill(z.begin(), z.end(), 0.0);
  for (int k = 0; k < n; k++) {
    first[k] = interval * inverse_mass[k] * force[k];
    y[k] = rkl2.first().mu_rate * first[k];
  }
  for (int j = 2; j <= s; j++) {
    const RKL2::Stage stage = rkl2.stage(j);
    const Unknowns &acting = driving(y);
    engine.for_each(n, [&](int k) {
      z_old[k] = stage.mu * z[k] + stage.nu * z_old[k] + stage.mu_rate * acting[k];
      std::swap(z[k], z_old[k]);
    });
    if (j == s) break;
    statistics[APPLICATIONS] += 1.0;
    friction(acting, drag);
    engine.for_each(n, [&](int k) {
      y_old[k] = stage.mu * y[k] + stage.nu * y_old[k] + stage.gamma_rate * first[k] +
          stage.mu_rate * (first[k] - interval * inverse_mass[k] * drag[k]);
      std::swap(y[k], y_old[k]);
    });
  }
}

/* ----------------------------------------------------------------------
   Add an increment to the velocities and spins of owned particles and of ghosts, whose velocities fix deform may have
   changed.
------------------------------------------------------------------------- */

void ViscousStage::add_velocities(const Unknowns &increment)
{
  set_velocities(increment);
  engine.for_each(atom->nlocal + atom->nghost, [&](int i) {
    for (int d = 0; d < 3; d++) {
      atom->vest[i][d] += engine.particle[i].u[d];
      if (omegaest) omegaest[i][d] += engine.spin[i].w[d];
    }
  });
}

/* ---------------------------------------------------------------------- */

double StiffStage::memory_usage() const
{
  return bytes(mass, inverse_mass, x, residual, before, guess, force, forces_before, torques_before,
               heat_before, unknown);
}

/* ----------------------------------------------------------------------
   Find T_b, and change esph and desph_before accordingly.  At the start of a run, desph_before is the energy that the last
   step added after the forces; later, desph_before is the rate that advances the energy from the middle to the end of a step.
------------------------------------------------------------------------- */

void TemperatureStage::run(int prescribed_in)
{
  const double begin = platform::walltime();
  prescribed = prescribed_in;
  symmetric = !boundary.gives_heat();
  find_unknowns();
  gather();
  const Unknowns first = guess;
  solve_step();

  double *const desph_before = Fields::of(atom)->desph_before;
  const double rate = update->setupflag ? -1.0 : (update->dt > 0.0) ? 2.0 / update->dt : 0.0;
  for (std::size_t k = 0; k < unknown.size(); k++) {
    const int i = unknown[k];
    guess[k] = first[k] + x[k];
    const double change = mass[k] * (scaled_heat(i, guess[k]) - scaled_heat(i, temperature[i]));
    atom->esph[i] += change;
    desph_before[i] += rate * change;
  }
  set_temperatures();
  statistics[SECONDS] = platform::walltime() - begin;
}

/* ----------------------------------------------------------------------
   Find the unknown particles, their heat capacities, their temperatures before the step, and the heat of pressure.  The
   temperature follows from the energy and the present density.  Elastic work is not heat: subtract the elastic work since the
   middle of the step.  The scheme euler finds the temperature at the end of the interval, but the pressure needs the
   temperature in the middle: count half of the work of the thermal pressure, so that sound is not damped.
------------------------------------------------------------------------- */

void TemperatureStage::find_unknowns()
{
  const FlowRow *const heat = engine.heat().data();
  const int nlocal = atom->nlocal;
  temperature.resize(nlocal);
  unknown.clear();
  for (int i = 0; i < nlocal; i++) {
    temperature[i] = heat[i].value;
    if (is_unknown(i) && heat[i].coefficient > 0.0) unknown.push_back(i);
  }

  resize();
  const double *const desph_before = Fields::of(atom)->desph_before;
  const double half = update->setupflag ? 1.0 : -0.5 * update->dt;
  const double later = update->setupflag ? 0.0 : 0.5 * update->dt;
  const ParticleRows &rows = engine.rows();
  const auto &types = engine.parameters().type;
  melts = std::any_of(types.begin(), types.end(), [](const TypeParameters &one) {
    return one.keywords.melts();
  });
  for (std::size_t k = 0; k < unknown.size(); k++) {
    const int i = unknown[k];
    mass[k] = atom->rmass[i] * engine.parameters().type[atom->type[i]].heat_capacity;
    inverse_mass[k] = 1.0 / mass[k];
    const ParticleRows::Work work = rows.work(i);
    force[k] = -work.elastic - (takes_end() ? 0.5 * work.thermal : 0.0);
    before[k] = scaled_heat(i, temperature[i]) +
        (half * desph_before[i] + later * work.elastic) * inverse_mass[k];
    guess[k] = (settings.mode == Viscous::RKL2) ? unscaled(i, before[k]) : temperature[i];
  }
}

/* ---------------------------------------------------------------------- */

double TemperatureStage::scaled_heat(int i, double T) const
{
  const TypeParameters &par = engine.parameters().type[atom->type[i]];
  return melts ? par.heat(T) / par.heat_capacity : T;
}

double TemperatureStage::unscaled(int i, double heat) const
{
  const TypeParameters &par = engine.parameters().type[atom->type[i]];
  return melts ? par.temperature(heat * par.heat_capacity) : heat;
}

const Unknowns &TemperatureStage::driving(const Unknowns &increments)
{
  if (!melts) return increments;
  driven.resize(increments.size());
  for_unknown([&](int i, std::size_t k) {
    driven[k] = unscaled(i, before[k] + increments[k]) - unscaled(i, before[k]);
  });
  return driven;
}

/* ----------------------------------------------------------------------
   Set force to the heat per time at the guess, with conduction.
------------------------------------------------------------------------- */

void TemperatureStage::gather()
{
  if (settings.mode == Viscous::RKL2) set_temperatures();
  engine.accumulate_flow(HEAT_FLOW, flow);
  boundary.add_surface_heat(flow);
  engine.for_each(nforce(), [&](int i) {
    flow[i] += atom->desph[i];
  });
  exchange.reverse({{flow.data(), 1, 1}});

  double sums[2] = {0.0, 0.0};
  for (std::size_t k = 0; k < unknown.size(); k++) {
    const int i = unknown[k];
    force[k] += flow[i];
    sums[0] += mass[k] * before[k];
    sums[1] += mass[k];
  }
  if (settings.mode != Viscous::IMPLICIT) return;    // rkl2 needs no scale
  sum(sums, 2);
  mean = (sums[1] > 0.0) ? sums[0] / sums[1] : 0.0;
}

/* ---------------------------------------------------------------------- */

void TemperatureStage::set_temperatures()
{
  engine.for_each(atom->nlocal, [&](int i) {
    engine.heat()[i].value = temperature[i];
  });
  for_unknown([&](int i, std::size_t k) {
    engine.heat()[i].value = guess[k];
  });
  send_temperatures();
  boundary.extend_temperatures(false);
}

void TemperatureStage::send_temperatures()
{
  FlowRow *const heat = engine.heat().data();
  exchange.forward({field(heat, &heat->value, 1)});
}

/* ----------------------------------------------------------------------
   Set out = Lambda in, for increments of the temperature.  Increments of prescribed temperatures are 0.
------------------------------------------------------------------------- */

void TemperatureStage::friction(const Unknowns &in, Unknowns &out)
{
  engine.for_each(atom->nlocal, [&](int i) {
    engine.heat()[i].value = 0.0;
  });
  for_unknown([&](int i, std::size_t k) {
    engine.heat()[i].value = in[k];
  });
  send_temperatures();
  boundary.extend_temperatures(true);
  engine.accumulate_flow(HEAT_FLOW, flow);
  exchange.reverse({{flow.data(), 1, 1}});
  for_unknown([&](int i, std::size_t k) {
    out[k] = -flow[i];
  });
}

/* ----------------------------------------------------------------------
   Return the square of the scale of the residual.  The scale includes the rounding error of temperatures: a smaller residual
   needs no iteration.
------------------------------------------------------------------------- */

double TemperatureStage::scale_sq() const
{
  const double rounded = DBL_EPSILON / settings.tolerance;
  return team().sum<double>(static_cast<int>(x.size()), [&](int k, double &total) {
    const double t0 = before[k] - mean, end = guess[k] + x[k], t = end - mean;
    total += mass[k] * (0.5 * (t0 * t0 + t * t) + rounded * rounded * end * end);
  });
}

/* ----------------------------------------------------------------------
   Find T_b at the start of a run; with euler by a step to the middle of the first interval, which makes no new extremum.
------------------------------------------------------------------------- */

void TemperatureStage::start()
{
  if (takes_end())
    implicit_step(0.5 * update->dt);
  else
    StiffStage::start();
}
