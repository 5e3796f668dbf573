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

#include "fix_sph_dt.h"

#include "error.h"
#include "fix_sph_bulk.h"
#include "force.h"
#include "modify.h"
#include "output.h"
#include "pair.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_keywords.h"
#include "sph_dissipation_masks.h"
#include "sph_dissipation_report.h"
#include "sph_dissipation_steps.h"
#include "sph_dissipation_table.h"
#include "sph_dissipation_viscous.h"
#include "update.h"

#include <algorithm>
#include <vector>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace SPHDissipation;

// Largest factor between a time step and the next one: the forces depend on the time step before

static constexpr double GROWTH = 1.25;

// Fields that the limits depend on

static constexpr uint64_t READ = TYPE_MASK | MASK_MASK | RMASS_MASK | V_MASK | F_MASK |
    SPH_RHO_MASK | ESPH_MASK | STATES_MASK | INERTIA_MASK;

// Return a part of a time; UNLIMITED_STEP if the time is unlimited.

static double part_of(double part, double time)
{
  return (time < UNLIMITED_STEP) ? part * time : UNLIMITED_STEP;
}

/* ---------------------------------------------------------------------- */

FixSPHDt::FixSPHDt(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), part{SPHDissipation::ACOUSTIC, 1.0, 0.25}, largest(UNLIMITED_STEP)
{
  demand_words(lmp, "fix sph/dt", narg, "ID group-ID sph/dt N");
  if (igroup != 0) error->all(FLERR, "Fix {} must use group all", style);
  nevery = utils::inumeric(FLERR, arg[3], false, lmp);
  if (nevery < 1) error->all(FLERR, "Fix {} N must be >= 1, not {}", style, arg[3]);

  const char *const names[NLIMIT] = {"acoustic", "viscous", "force"};
  for (Keywords key(lmp, fmt::format("Fix {}", style), 4, narg, arg); key.next();) {
    for (int k = 0; k < NLIMIT; k++)
      if (key.is(names[k])) {
        part[k] = key.positive();
        given[k] = true;
      }
    if (key.is("min")) smallest = key.positive();
    if (key.is("max")) largest = key.positive();
  }
  if (smallest > largest)
    error->all(FLERR, "Fix {} min {:g} is larger than max {:g}", style, smallest, largest);

  time_depend = 1;    // the elapsed time is not the number of steps times the time step
  scalar_flag = vector_flag = 1;
  size_vector = NLIMIT;
  extscalar = extvector = 0;
  global_freq = 1;
  datamask_read = datamask_modify = EMPTY_MASK;    // fields are copied when the step is set
}

/* ---------------------------------------------------------------------- */

int FixSPHDt::setmask()
{
  return PRE_FORCE | END_OF_STEP;
}

/* ---------------------------------------------------------------------- */

void FixSPHDt::init()
{
  if (modify->get_fix_by_style("^sph/dt").size() + modify->get_fix_by_style("^dt/reset").size() > 1)
    error->all(FLERR, "Fix {}: only one fix can set the time step", style);
  fluid = find_fluid(force);
  if (!fluid || !fluid->pair->compute_flag)
    error->all(FLERR, "Fix {} requires pair style sph/bulk or sph/micropolar", style);
}

/* ----------------------------------------------------------------------
   Set the time step before the first forces, which may act for half a step; the limit of forces is not known yet.  First let
   integrators set masses and inertia, which they would do later in their setup().
------------------------------------------------------------------------- */

void FixSPHDt::setup_pre_force(int /*vflag*/)
{
  fluid->get_from_device(ALL_MASK);
  std::vector<FixSPHBulk *> integrators;
  for (const auto &ifix : modify->get_fix_list())
    if (auto *integrator = dynamic_cast<FixSPHBulk *>(ifix)) integrators.push_back(integrator);
  for (const auto &integrator : integrators) integrator->set_masses();
  fluid->find_volumes();
  for (const auto &integrator : integrators) integrator->set_inertia();
  fluid->give_to_device();

  limits[FORCE] = UNLIMITED_STEP;
  reset_step(allowed_step(fluid->stability->table()));
}

/* ----------------------------------------------------------------------
   Set the time step after the first forces.  With viscous rkl2 or implicit, these forces are the mean of half the old step,
   and must not act in a longer step.
------------------------------------------------------------------------- */

void FixSPHDt::setup(int /*vflag*/)
{
  set_up = true;
  fluid->get_from_device(READ);
  limits[FORCE] = part_of(part[FORCE], fluid->stability->fall_time());
  const CoeffTable table = fluid->stability->table();
  const double step = allowed_step(table);
  reset_step(fluid->viscous->active() ? std::min(step, update->dt) : step);
  fluid->log->check_time_step(table);
}

/* ---------------------------------------------------------------------- */

void FixSPHDt::end_of_step()
{
  check_set_up(lmp, this, set_up);
  fluid->get_from_device(READ);
  limits[FORCE] = part_of(part[FORCE], fluid->stability->fall_time());
  reset_step(std::min(allowed_step(fluid->stability->table()), GROWTH * update->dt));
}

/* ----------------------------------------------------------------------
   Return the time step that the limits allow; the present one without any limit.  viscous rkl2 or implicit allows any time
   step: then the limit of viscosity, one of accuracy, acts only if the keyword is given.
------------------------------------------------------------------------- */

double FixSPHDt::allowed_step(const CoeffTable &table)
{
  limits[ACOUSTIC] = part_of(part[ACOUSTIC] / SPHDissipation::ACOUSTIC, table.acoustic_step());
  const bool limited = given[VISCOUS] || !fluid->viscous->active();
  limits[VISCOUS] = limited ? part_of(part[VISCOUS], table.dissipative_step()) : UNLIMITED_STEP;
  double step = *std::min_element(limits, limits + NLIMIT);
  if (step >= UNLIMITED_STEP && largest >= UNLIMITED_STEP) step = update->dt;
  return std::max(smallest, std::min(step, largest));
}

/* ----------------------------------------------------------------------
   Set the time step, as fix dt/reset does.
------------------------------------------------------------------------- */

void FixSPHDt::reset_step(double dt)
{
  if (dt == update->dt) return;
  update->update_time();
  update->dt = dt;
  update->dt_default = 0;
  force->pair->reset_dt();
  for (const auto &ifix : modify->get_fix_list()) ifix->reset_dt();
  output->reset_dt();
}

/* ---------------------------------------------------------------------- */

double FixSPHDt::compute_scalar()
{
  return update->dt;
}
