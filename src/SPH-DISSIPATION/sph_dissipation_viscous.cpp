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
#include "sph_dissipation_particle_terms.h"
#include "update.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

void StiffScheme::configure(const ViscousSettings &settings_in, int groups,
                            const std::string &style_in)
{
  settings = settings_in;
  group_bits = groups;
  style = style_in;
}

void StiffScheme::begin_run()
{
  warned = false;
  statistics[APPLICATIONS] = 0.0;
}

void StiffScheme::begin()
{
  if (update->setupflag) outdated = true;
  statistics[ITERATIONS] = statistics[RESIDUAL] = 0.0;
}

/* ---------------------------------------------------------------------- */

bool StiffScheme::estimates() const
{
  constexpr int OFTEN = 20;    // steps between estimates
  return outdated || (update->ntimestep % OFTEN == 0 && !update->setupflag);
}

void StiffScheme::set_estimate(double estimate)
{
  constexpr double SAFETY = 1.15;    // factor of estimates, which are too low
  check_finite(std::isfinite(estimate));
  rate = std::max(known_rate, SAFETY * estimate);
  outdated = false;
}

int StiffScheme::stages_for(double interval)
{
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
  return s;
}

/* ----------------------------------------------------------------------
   Take the result of an iteration; warn once in a run, or stop, if the iterations did not converge.
------------------------------------------------------------------------- */

void StiffScheme::note(const Solution &found)
{
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

std::string StiffScheme::moment() const
{
  return fmt::format("{}{}", update->ntimestep, where);
}

/* ----------------------------------------------------------------------
   Stop if values are not finite; all processors pass the same argument.
------------------------------------------------------------------------- */

void StiffScheme::check_finite(bool finite) const
{
  if (!finite)
    error->all(FLERR, Error::NOLASTLINE,
               "Fix {} viscous rkl2 or implicit: positions, velocities, or forces are not finite "
               "numbers at step {}",
               style, moment());
}

/* ---------------------------------------------------------------------- */

void ForcesAside::set()
{
  const std::size_t nall = atom->nlocal + atom->nghost;
  if (nall == 0) return;
  double *const f = atom->f[0];
  forces.assign(f, f + 3 * nall);
  std::fill_n(f, 3 * nall, 0.0);
  heat.assign(atom->desph, atom->desph + nall);
  if (!engine.has_spin()) return;
  double *const torque = atom->torque[0];
  torques.assign(torque, torque + 3 * nall);
  std::fill_n(torque, 3 * nall, 0.0);
}

/* ---------------------------------------------------------------------- */

void ForcesAside::restore()
{
  if (atom->nlocal + atom->nghost == 0) return;
  std::copy(forces.begin(), forces.end(), atom->f[0]);
  std::copy(heat.begin(), heat.end(), atom->desph);
  if (engine.has_spin()) std::copy(torques.begin(), torques.end(), atom->torque[0]);
}

/* ---------------------------------------------------------------------- */

template <class Function> void TemperatureStage::for_unknown(const Function &function)
{
  engine.for_each(atom->nlocal, [&](int i) {
    if (mass[i] > 0.0) function(i);
  });
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
  const std::vector<double> first = guess;
  solve_step();

  double *const desph_before = Fields::of(atom)->desph_before;
  const double rate = update->setupflag ? -1.0 : (update->dt > 0.0) ? 2.0 / update->dt : 0.0;
  for_unknown([&](int i) {
    guess[i] = first[i] + x[i];
    const double change = mass[i] * (scaled_heat(i, guess[i]) - scaled_heat(i, temperature[i]));
    atom->esph[i] += change;
    desph_before[i] += rate * change;
  });
  set_temperatures();
  scheme.statistics[StiffScheme::SECONDS] = platform::walltime() - begin;
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
  resize();
  const double *const desph_before = Fields::of(atom)->desph_before;
  const double half = update->setupflag ? 1.0 : -0.5 * update->dt;
  const double later = update->setupflag ? 0.0 : 0.5 * update->dt;
  const ParticleRows &rows = engine.rows();
  const auto &types = engine.parameters().type;
  melts = std::any_of(types.begin(), types.end(), [](const TypeParameters &one) {
    return one.keywords.melts();
  });
  engine.for_each(nlocal, [&](int i) {
    temperature[i] = heat[i].value;
    const TypeParameters &type = types[atom->type[i]];
    const bool conducts = (atom->mask[i] & scheme.groups()) && !(atom->mask[i] & prescribed) &&
        !type.other && heat[i].coefficient > 0.0;
    mass[i] = conducts ? atom->rmass[i] * type.heat_capacity : 0.0;
    inverse_mass[i] = conducts ? 1.0 / mass[i] : 0.0;
    force[i] = before[i] = guess[i] = 0.0;
    if (!conducts) return;
    const ParticleRows::Work work = rows.work(i);
    force[i] = -work.elastic - (takes_end() ? 0.5 * work.thermal : 0.0);
    before[i] = scaled_heat(i, temperature[i]) +
        (half * desph_before[i] + later * work.elastic) * inverse_mass[i];
    guess[i] = (scheme.choice().mode == Viscous::RKL2) ? unscaled(i, before[i]) : temperature[i];
  });
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

const double *TemperatureStage::driving(const double *increments)
{
  if (!melts) return increments;
  driven.assign(atom->nlocal, 0.0);
  for_unknown([&](int i) {
    driven[i] = unscaled(i, before[i] + increments[i]) - unscaled(i, before[i]);
  });
  return driven.data();
}

/* ----------------------------------------------------------------------
   Set force to the heat per time at the guess, with conduction.
------------------------------------------------------------------------- */

void TemperatureStage::gather()
{
  if (scheme.choice().mode == Viscous::RKL2) set_temperatures();
  engine.accumulate_flow(HEAT_FLOW, flow);
  boundary.add_surface_heat(flow);
  engine.for_each(space.nforce(), [&](int i) {
    flow[i] += atom->desph[i];
  });
  exchange.reverse({{flow.data(), 1, 1}});

  double sums[2] = {0.0, 0.0};
  for (int i = 0; i < atom->nlocal; i++) {
    force[i] += flow[i];
    sums[0] += mass[i] * before[i];
    sums[1] += mass[i];
  }
  if (scheme.choice().mode != Viscous::IMPLICIT) return;    // rkl2 needs no scale
  sum(sums, 2);
  mean = (sums[1] > 0.0) ? sums[0] / sums[1] : 0.0;
}

/* ---------------------------------------------------------------------- */

void TemperatureStage::set_temperatures()
{
  engine.for_each(atom->nlocal, [&](int i) {
    engine.heat()[i].value = temperature[i];
  });
  for_unknown([&](int i) {
    engine.heat()[i].value = guess[i];
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

void TemperatureStage::friction(const double *in, double *out)
{
  engine.for_each(atom->nlocal, [&](int i) {
    engine.heat()[i].value = in[i];
  });
  send_temperatures();
  boundary.extend_temperatures(true);
  engine.accumulate_flow(HEAT_FLOW, flow);
  exchange.reverse({{flow.data(), 1, 1}});
  engine.for_each(atom->nlocal, [&](int i) {
    out[i] = -flow[i];
  });
}

/* ----------------------------------------------------------------------
   Return the square of the scale of the residual.  The scale includes the rounding error of temperatures: a smaller residual
   needs no iteration.
------------------------------------------------------------------------- */

double TemperatureStage::scale_sq() const
{
  const double rounded = DBL_EPSILON / scheme.choice().tolerance;
  return total([&](int k, double &all) {
    const double t0 = before[k] - mean, end = guess[k] + x[k], t = end - mean;
    all += mass[k] * (0.5 * (t0 * t0 + t * t) + rounded * rounded * end * end);
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
