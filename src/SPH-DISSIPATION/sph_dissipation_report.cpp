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

#include "sph_dissipation_report.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "math_extra.h"
#include "neighbor.h"
#include "pair_hybrid.h"
#include "sph_dissipation_boundary_stage.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_state.h"
#include "sph_dissipation_table.h"
#include "sph_dissipation_viscous.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// Largest viscous rate times time step without a warning: between the steps, a mode of this rate is 5 % too hot.

static constexpr double ACCURATE_NOISE = 0.1;

// Largest sqrt(kT/m)/c0 without a warning: the relative standard deviation of the density in the volume of a particle.

static constexpr double FAST_NOISE = 0.5;

/* ---------------------------------------------------------------------- */

void FluidReport::check_list(int not_fluid)
{
  if (reads_velocities()) check_speed(!not_fluid);
  if (reads_densities()) check_expansion();
}

bool FluidReport::reads_velocities() const
{
  return fast_lists >= 0 && model.choice.eos != Eos::IDEAL && !model.choice.thermal;
}

/* ----------------------------------------------------------------------
   Warn once if over 10 % of the particles are faster than a limit at two successive neighbor lists: 0.1 c0 with density
   continuity (the density varies by 1 %), else 0.3 c0 (5 %, as in flows with sound).  Single drops of spray do not count.
   Without walls and open ends, speeds are relative to the center of mass.
------------------------------------------------------------------------- */

void FluidReport::check_speed(bool all_is_fluid)
{
  constexpr double MANY = 0.1;                                  // part of the particles
  const double fast = (model.choice.continuity) ? 0.1 : 0.3;    // speed over c0
  bigint mine[2] = {0, 0}, all[2];
  double mean[3] = {0.0, 0.0, 0.0};
  if (all_is_fluid) group->vcm(0, group->mass(0), mean);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!model.has_type(atom->type[i]) || boundary.is_boundary(i)) continue;
    double v[3];
    MathExtra::sub3(atom->v[i], mean, v);
    mine[0]++;
    if (MathExtra::len3(v) > fast * model.coeffs[atom->type[i]].eos.c0) mine[1]++;
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

bool FluidReport::reads_densities() const
{
  return !expanded && !model.constants().tension && !update->setupflag;
}

/* ----------------------------------------------------------------------
   Warn once if over half of the particles have densities below 0.9 times the density without pressure.  Without tension,
   no force holds such a fluid together.  Spray is a small part of a fluid.
------------------------------------------------------------------------- */

void FluidReport::check_expansion()
{
  constexpr double MANY = 0.5,
                   THIN = 0.9;    // part of the particles; density over rho_min
  bigint mine[2] = {0, 0}, all[2];
  for (int i = 0; i < atom->nlocal; i++) {
    if (!model.has_type(atom->type[i]) || boundary.is_boundary(i)) continue;
    mine[0]++;
    if (atom->rho[i] < THIN * model.coeffs[atom->type[i]].eos.rho_min) mine[1]++;
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

void FluidReport::begin_run(const CoeffTable &table, const std::function<double(int)> &pressure,
                            int not_fluid)
{
  if (is_new) {
    const FluidChecks check(lmp, style, model);
    const Constants &par = model.constants();
    model.warn_of_ignored();
    warned_step = noise_step = 0.0;
    FluidState state(lmp, engine, exchange, model);
    state.run(1, not_fluid, pressure);
    if (comm->me == 0)
      utils::logmesg(lmp, "Pair style {}: {}, {} loops\n{}{}", style,
                     model.summary(par.dim, par.support), engine.instruction_set(),
                     table.text(update->dt) + skin_text(table), state.table());
    check_all_interact();
    check.sizes(not_fluid);
    check.state_times();
    check.surface();
    state.warn_of_density(style);
    state.warn_of_support(style);
    moving = 0.0;
    check_elasticity(state);
  }
  is_new = false;
  if (model.choice.thermal && update->dt != noise_step) announce_noise(table.fastest_rate());
}

/* ----------------------------------------------------------------------
   Warn of a shear elasticity of the arrangement.  Check a fluid at rest again after the time look_after, unless it has
   noise.  Shifting prevents such an elasticity.
------------------------------------------------------------------------- */

void FluidReport::check_elasticity(const std::function<double(int)> &pressure, int not_fluid)
{
  FluidState state(lmp, engine, exchange, model);
  state.run(1, not_fluid, pressure);
  check_elasticity(state);
}

void FluidReport::check_elasticity(FluidState &state)
{
  look_after = 0.0;
  if (!shift.movers.empty()) return;
  const double wait = state.warn_of_elasticity(style, moving);
  if (!model.choice.thermal) look_after = wait;
  moving = 0.0;
}

/* ----------------------------------------------------------------------
   Return the line of the log about the fastest skin.  The line is empty with noise, since thermal motion goes to and fro,
   and if new lists do not depend on how far particles have moved.
------------------------------------------------------------------------- */

std::string FluidReport::skin_text(const CoeffTable &table) const
{
  if (model.choice.thermal || !neighbor->dist_check) return "";
  return table.skin_text(neighbor->skin, update->dt, model.constants().support,
                         model.constants().dim);
}

/* ----------------------------------------------------------------------
   Log the noise.  Warn if the noise has no effect, if rate * dt is large, or if sqrt(kT/m)/c0 is large.  rate = rate of the
   fastest viscous mode.
------------------------------------------------------------------------- */

void FluidReport::announce_noise(double rate)
{
  noise_step = update->dt;
  const std::string temperature = model.choice.own_temperatures
      ? "the temperatures of the particles"
      : fmt::format("temperature {:g}", model.choice.temperature);
  if (comm->me == 0)
    utils::logmesg(lmp,
                   "Pair style {}: thermal noise of {}, seed {}, largest viscous rate times time "
                   "step {:.3g}\n",
                   style, temperature, model.choice.seed, rate * update->dt);
  const bool other = model.constants().states || model.constants().conducts();
  if (rate == 0.0 && !other && (model.choice.own_temperatures || model.choice.temperature > 0.0) &&
      comm->me == 0)
    error->warning(FLERR, "Pair style {}: temp has no effect without viscosity", style);
  if (rate * update->dt > 1.001 * ACCURATE_NOISE && !viscous.active() && comm->me == 0)
    error->warning(
        FLERR,
        "Pair style {}: the largest viscous rate times the time step is {:.4g}, above {:g}; "
        "velocities between steps, and with them the structure of the fluid, are hotter "
        "than the temperature of the noise",
        style, rate * update->dt, ACCURATE_NOISE);
  if (model.choice.own_temperatures || model.choice.eos == Eos::IDEAL) return;

  double fastest = 0.0, fastest_all;    // sqrt(kT/m)/c0
  for (int i = 0; i < atom->nlocal; i++) {
    const TypeCoeff &coeff = model.coeffs[atom->type[i]];
    if (!coeff.other && !boundary.is_boundary(i))
      fastest = std::max(
          fastest, sqrt(force->boltz * model.choice.temperature / atom->rmass[i]) / coeff.eos.c0);
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

/* ---------------------------------------------------------------------- */

void FluidReport::check_time_step(const CoeffTable &table)
{
  const double smallest = viscous.active() ? table.acoustic_step() : table.smallest_step();
  if (!(update->dt > smallest) || update->dt == warned_step) return;
  warned_step = update->dt;
  if (comm->me == 0)
    error->warning(FLERR,
                   "The time step {:g} exceeds the largest stable time step {:g} of pair "
                   "style {}",
                   update->dt, smallest, style);
}

/* ----------------------------------------------------------------------
   Warn, on rank 0, of two types of this fluid whose pairs belong to other styles of pair_style hybrid only.
------------------------------------------------------------------------- */

void FluidReport::check_all_interact()
{
  auto *const hybrid = dynamic_cast<PairHybrid *>(force->pair);
  if (!hybrid || comm->me != 0) return;
  std::string name = style;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i + 1; j <= atom->ntypes; j++)
      if (model.has_type(i) && model.has_type(j) && !hybrid->check_ijtype(i, j, &name[0])) {
        error->warning(FLERR,
                       "Pair style {}: particles of types {} and {} do not interact, since "
                       "pair_coeff gives these types to other styles only; use pair_coeff {} {} {}",
                       style, i, j, i, j, style);
        return;
      }
}
