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

#include "sph_dissipation_wall_motion.h"

#include "compute.h"
#include "domain.h"
#include "error.h"
#include "math_extra.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

enum { OMEGA = 3 };    // index of the angular velocity, after the velocity

/* ---------------------------------------------------------------------- */

void WallMotion::set_velocity(char **arg)
{
  for (int d = 0; d < 3; d++) read(values[d], arg[d]);
  if (domain->dimension == 2 && !values[2].value.is_zero())
    error->all(FLERR, "{}: velocity and gravity must lie in the plane in 2d", owner);
}

/* ---------------------------------------------------------------------- */

void WallMotion::set_rotation(char **arg)
{
  for (int k = 0; k < 6; k++) given[k] = utils::numeric(FLERR, arg[k], false, lmp);
  std::copy(given, given + 3, point);
  std::copy(given + 3, given + 6, axis);
  if (!(MathExtra::len3(axis) > 0.0))
    error->all(FLERR, "{} rotate: the direction of the axis must not be zero", owner);
  if (domain->dimension == 2 && (axis[0] != 0.0 || axis[1] != 0.0))
    error->all(FLERR, "{}: the axis of rotation must be along z in 2d", owner);
  MathExtra::norm3(axis);
  read(values[OMEGA], arg[6]);
  rotation_given = true;
}

/* ---------------------------------------------------------------------- */

void WallMotion::read(Component &one, const char *word)
{
  one = Component();
  one.value.set(lmp, word);
  any_variable = any_variable || one.value.varies();
}

/* ---------------------------------------------------------------------- */

void WallMotion::init()
{
  for (auto &one : values)
    if (!one.value.init(lmp, owner, false))
      error->all(FLERR, "Variable {} for {} is not an equal-style variable", one.value.name(),
                 owner);
}

/* ----------------------------------------------------------------------
   Evaluate all values at this time step; return true if a variable reads a compute.
------------------------------------------------------------------------- */

bool WallMotion::evaluate(double *result)
{
  if (any_variable) modify->clearstep_compute();
  for (int k = 0; k < NVALUES; k++) {
    values[k].value.evaluate(lmp, 0);
    result[k] = values[k].value.now();
  }
  if (!any_variable) return false;
  const auto &computes = modify->get_compute_list();
  return std::any_of(computes.begin(), computes.end(), [](const Compute *compute) {
    return compute->invoked_flag != Compute::INVOKED_NONE;
  });
}

/* ---------------------------------------------------------------------- */

void WallMotion::demand_finite() const
{
  for (const auto &one : values) one.value.demand_finite(lmp, 0, owner);
}

/* ----------------------------------------------------------------------
   Set values and rates at the start of a run.  Variables that are functions of time get their rate from the values in the
   next steps.  Variables that depend on the particles are not known in advance: they keep the rate of the last step of the
   last run, as variables that no longer change do.
------------------------------------------------------------------------- */

void WallMotion::start()
{
  const bool continues = (known_step == update->ntimestep);
  known_step = update->ntimestep;

  double now[NVALUES];
  const bool of_particles = evaluate(now);
  demand_finite();
  if (any_variable) modify->addstep_compute(update->ntimestep + 1);
  for (int k = 0; k < NVALUES; k++) {
    if (!continues || (!of_particles && values[k].now != now[k])) values[k].rate = 0.0;
    values[k].now = values[k].mean = now[k];
  }
  if (any_variable && !of_particles && update->dt != 0.0) estimate_rates();
}

/* ----------------------------------------------------------------------
   Lay a parabola through the present values and the values of the next two steps.  Set the rates to the change of the
   parabola over the previous step.  In a run of no steps, ramp() of variables would have no slope.
------------------------------------------------------------------------- */

void WallMotion::estimate_rates()
{
  const bigint ntimestep = update->ntimestep, endstep = update->endstep;
  if (endstep == update->beginstep) update->endstep = MAXBIGINT;
  double next[NVALUES], second[NVALUES];
  update->ntimestep = ntimestep + 1;
  evaluate(next);
  update->ntimestep = ntimestep + 2;
  evaluate(second);
  update->ntimestep = ntimestep;
  update->endstep = endstep;

  for (int k = 0; k < NVALUES; k++) {
    Component &value = values[k];
    if (next[k] == value.now && second[k] == value.now) continue;
    const double rate = (3.0 * next[k] - second[k] - 2.0 * value.now) / update->dt;
    value.rate = std::isfinite(rate) ? rate : 0.0;
  }
}

/* ---------------------------------------------------------------------- */

void WallMotion::stop()
{
  known_step = -1;
  for (auto &value : values) value.now = value.mean = value.rate = 0.0;
}

/* ----------------------------------------------------------------------
   Go to the end of a step.  With a time step of zero, nothing changes in time.
------------------------------------------------------------------------- */

void WallMotion::advance()
{
  double now[NVALUES];
  evaluate(now);
  demand_finite();
  if (any_variable) modify->addstep_compute(update->ntimestep + 1);
  known_step = update->ntimestep;
  for (int k = 0; k < NVALUES; k++) {
    Component &value = values[k];
    value.mean = 0.5 * (value.now + now[k]);
    value.rate = (update->dt != 0.0) ? (now[k] - value.now) / update->dt : 0.0;
    value.now = now[k];
  }
}

/* ---------------------------------------------------------------------- */

WallStep WallMotion::last_step() const
{
  WallStep step;
  double quaternion[4];
  MathExtra::axisangle_to_quat(axis, values[OMEGA].mean * update->dt, quaternion);
  MathExtra::quat_to_mat(quaternion, step.rotation);
  for (int d = 0; d < 3; d++) step.shift[d] = values[d].mean * update->dt;
  return step;
}

/* ---------------------------------------------------------------------- */

void WallMotion::move_point()
{
  if (!rotation_given) return;
  for (int d = 0; d < 3; d++) point[d] += values[d].mean * update->dt;
}

/* ---------------------------------------------------------------------- */

WallVelocity WallMotion::velocity() const
{
  WallVelocity now;
  for (int d = 0; d < 3; d++) {
    now.point[d] = point[d];
    now.axis[d] = axis[d];
    now.u[d] = values[d].now;
    now.rate[d] = values[d].rate;
  }
  now.omega = values[OMEGA].now;
  now.turning = values[OMEGA].rate;
  return now;
}

/* ---------------------------------------------------------------------- */

void WallMotion::pack_restart(double *buf) const
{
  std::copy(given, given + 6, buf);
  std::copy(point, point + 3, buf + 6);
}

/* ---------------------------------------------------------------------- */

void WallMotion::restart(const double *buf)
{
  if (rotation_given && std::equal(given, given + 6, buf)) std::copy(buf + 6, buf + 9, point);
}
