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

#include "fix_sph_open.h"

#include "atom.h"
#include "atom_vec_sph_micropolar.h"
#include "comm.h"
#include "error.h"
#include "fix_sph_bulk.h"
#include "force.h"
#include "group.h"
#include "math_extra.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_characteristics.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_open_ledger.h"
#include "sph_dissipation_open_plane.h"
#include "sph_dissipation_open_rows.h"
#include "sph_dissipation_open_samples.h"
#include "sph_dissipation_open_values.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace SPHDissipation;

static constexpr double NODES = 3.0;          // of the plane, per radius of what is measured there
static constexpr double AVERAGING = 100.0;    // default time, support radii over sound speed

// in restart files: size, ledger, rows, clock, point and normal of the plane; then the waves

enum {
  LEDGER = 1,
  ROWS = LEDGER + OpenLedger::NVALUE,
  CLOCK = ROWS + OpenRows::NSTATE,
  PLANE,
  NHEAD = PLANE + 6
};

// the vector of the fix, after the ledger

enum { COUNT = OpenLedger::NVALUE, PRESSURE, VELOCITY, NVECTOR = VELOCITY + 3 };

/* ---------------------------------------------------------------------- */

FixSPHOpen::FixSPHOpen(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), plane(nullptr), values(nullptr), samples(nullptr), rows(nullptr),
    ledger(nullptr), pair(nullptr), integrator(nullptr), avec(nullptr), spinning(nullptr),
    fluidbit(0), condition(LAGGED), order(-1), averaging_time(0.0), radius(0.0), area(0.0),
    clock(0.0), supersonic(false), totals_known(false), totals(new double[NVECTOR])
{
  if (narg < 11) utils::missing_cmd_args(FLERR, fmt::format("fix {}", style), error);
  const std::string owner = fmt::format("Fix {}", style);
  plane = new OpenPlane(lmp, owner);
  values = new OpenValues(lmp, owner);
  samples = new OpenSamples(lmp, *plane);
  rows = new OpenRows(lmp, owner, *plane, groupbit);
  ledger = new OpenLedger(lmp);

  fluid_name = arg[3];
  const int fluid_group = group->find(fluid_name);
  if (fluid_group < 0) error->all(FLERR, "Fix {}: group {} does not exist", style, fluid_name);
  plane->set(arg + 4);
  for (int iarg = 11; iarg < narg;) iarg += keyword_argument(iarg, narg, arg);
  check_keywords();

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
  extvector = 0;    // an account is not to be scaled by the number of atoms
}

/* ---------------------------------------------------------------------- */

int FixSPHOpen::keyword_argument(int iarg, int narg, char **arg)
{
  const std::string keyword = arg[iarg];
  auto needs = [&](int n) {
    if (iarg + n >= narg)
      utils::missing_cmd_args(FLERR, fmt::format("fix {} {}", style, keyword), error);
  };
  auto positive = [&](double &number) {
    needs(1);
    number = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    if (!(number > 0.0))
      error->all(FLERR, "Fix {} {} must be > 0, not {}", style, keyword, arg[iarg + 1]);
    return 2;
  };
  auto take = [&](OpenValues::Quantity first, int n) {
    needs(1);
    values->forget(first, n);
    if (strcmp(arg[iarg + 1], "inside") == 0) return 2;
    needs(n);
    for (int k = 0; k < n; k++)
      values->set(static_cast<OpenValues::Quantity>(first + k), arg[iarg + 1 + k]);
    return n + 1;
  };

  if (keyword == "velocity") return take(OpenValues::VX, 3);
  if (keyword == "density") return take(OpenValues::RHO, 1);
  if (keyword == "pressure") return take(OpenValues::P, 1);
  if (keyword == "energy") return take(OpenValues::ENERGY, 1);
  if (keyword == "spin") return take(OpenValues::WX, 3);
  if (keyword == "average") return positive(averaging_time);
  if (keyword == "area") return positive(area);
  needs(1);
  const std::string word = arg[iarg + 1];
  if (keyword == "spacing") {
    double spacing;
    const int n = positive(spacing);
    rows->set_spacing(spacing);
    return n;
  }
  if (keyword == "region") {
    plane->set_region(arg[iarg + 1]);
    return 2;
  }
  if (keyword == "order") {
    order = utils::inumeric(FLERR, arg[iarg + 1], false, lmp);
    if (order != 0 && order != 1)
      error->all(FLERR, "Fix {} order must be 0 or 1, not {}", style, order);
    return 2;
  }
  if (keyword == "condition") {
    if (word == "lagged")
      condition = LAGGED;
    else if (word == "characteristic")
      condition = CHARACTERISTIC;
    else if (word == "fixed")
      condition = FIXED;
    else
      error->all(FLERR, "Unknown fix {} condition: {}", style, word);
    return 2;
  }
  error->all(FLERR, "Unknown fix {} keyword: {}", style, keyword);
  return 0;
}

/* ----------------------------------------------------------------------
   what would have no effect, or leaves something open
------------------------------------------------------------------------- */

void FixSPHOpen::check_keywords()
{
  const bool density = values->given(OpenValues::RHO);
  if (density && values->given(OpenValues::P))
    error->all(FLERR,
               "Fix {}: density and pressure cannot both be given, one follows from the other",
               style);
  if (order >= 0 && (condition != FIXED || (given_velocity() && given_state())))
    error->all(FLERR, "Fix {} order is for values from inside with condition fixed only", style);
  if (averaging_time > 0.0 && (condition == FIXED || (given_velocity() && given_state())))
    error->all(
        FLERR,
        "Fix {} average is for values from inside with condition lagged or characteristic only",
        style);
  if (condition != FIXED && !given_velocity() && !given_state())
    error->all(FLERR, "Fix {} condition {} needs a velocity, a density, or a pressure", style,
               condition == LAGGED ? "lagged" : "characteristic");
  if (area > 0.0 && !density)
    error->all(FLERR, "Fix {} area needs a density, from which the distance of particles follows",
               style);
  if (values->given(OpenValues::WX) && !atom->omega)
    error->all(FLERR, "Fix {} spin requires atom style sph/micropolar", style);
  order = std::max(order, 0);
}

/* ---------------------------------------------------------------------- */

FixSPHOpen::~FixSPHOpen()
{
  if (auto *fluid = PairSPHBulk::find(force)) fluid->remove_open_zone(this);
  delete ledger;
  delete rows;
  delete samples;
  delete values;
  delete plane;
  delete[] totals;
}

/* ---------------------------------------------------------------------- */

int FixSPHOpen::setmask()
{
  return PRE_EXCHANGE | INITIAL_INTEGRATE | POST_INTEGRATE | PRE_FORCE | FINAL_INTEGRATE;
}

/* ---------------------------------------------------------------------- */

void FixSPHOpen::init()
{
  pair = PairSPHBulk::find(force);
  if (!pair) error->all(FLERR, "Fix {} requires pair style sph/bulk or sph/micropolar", style);
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix {} does not support run_style respa", style);
  if (update->whichflag == 2)
    error->all(FLERR, "Fix {} cannot be used in a minimization: its particles have a velocity",
               style);
  if (pair->has_noise())
    error->all(FLERR,
               "Fix {} cannot be used with temp of the pair style: its particles do not fluctuate",
               style);
  pair->add_open_zone(this);
  spinning = dynamic_cast<AtomVecSPHMicropolar *>(atom->style_match("sph/micropolar"));
  avec = spinning ? spinning : dynamic_cast<AtomVecSPHBulk *>(atom->style_match("sph/bulk"));
  check_groups();
  check_integrator();

  const double support = pair->support_radius();
  values->init();
  if (area > 0.0)
    rows->set_distance([this](int i) {
      return atom->rmass[i] / (area * (*values)(OpenValues::RHO, i));
    });
  rows->init(support);

  // a small radius, for it smooths the profile, but with a few particles

  constexpr double PART = 0.6, WIDTHS = 2.2;
  radius = std::min(support, std::max(PART * support, WIDTHS * rows->width()));
  plane->init(radius / NODES);

  double slowest = 1.0e300;
  for (int type = 1; type <= atom->ntypes; type++)
    if (pair->has_type(type)) slowest = std::min(slowest, pair->fluid().coeffs[type].eos.c0);
  const double crossing = support / slowest;
  samples->init(averaging_time > 0.0 ? averaging_time : AVERAGING * crossing,
                10.0 * (plane->length / support + 1.0) * crossing);
  if (!waves_before.empty() && !samples->unpack(waves_before)) warn_of_other_plane();
  waves_before.clear();
}

/* ---------------------------------------------------------------------- */

void FixSPHOpen::check_groups()
{
  const int fluid_group = group->find(fluid_name);
  if (fluid_group < 0) error->all(FLERR, "Fix {}: group {} does not exist", style, fluid_name);
  fluidbit = group->bitmask[fluid_group];
  for (const int g : {igroup, fluid_group})
    if (group->dynamic[g])
      error->all(FLERR, "Fix {} cannot use dynamic group {}", style, group->names[g]);
  if (atom->firstgroupname)
    error->all(FLERR, "Fix {} cannot be used with atom_modify first: groups change within a step",
               style);

  bigint number[2] = {0, 0}, all[2];    // in the zone, in both groups
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    number[0]++;
    if (atom->mask[i] & fluidbit) number[1]++;
    if (!pair->has_type(atom->type[i]))
      error->one(FLERR, "Fix {}: particle {} of type {} is not of the fluid", style, atom->tag[i],
                 atom->type[i]);
  }
  MPI_Allreduce(number, all, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  if (!all[0])
    error->all(FLERR,
               "Fix {}: group {} is empty; the zone must be filled with particles of the fluid",
               style, group->names[igroup]);
  if (all[1])
    error->all(FLERR, "Fix {}: {} particles are in both groups {} and {}", style, all[1],
               group->names[igroup], fluid_name);

  for (const auto &other : modify->get_fix_by_style("^sph/open$"))
    if (other != this && other->igroup == igroup)
      error->all(FLERR, "Fix {} {}: group {} has the zone of fix {} already", style, id,
                 group->names[igroup], other->id);
  for (const auto &other : modify->get_fix_list()) {
    if (other == this || !other->time_integrate) continue;
    bigint count = 0, total;
    for (int i = 0; i < atom->nlocal; i++)
      if ((atom->mask[i] & groupbit) && (atom->mask[i] & other->groupbit)) count++;
    MPI_Allreduce(&count, &total, 1, MPI_LMP_BIGINT, MPI_SUM, world);
    if (total)
      error->all(
          FLERR,
          "Fix {}: {} particles of group {} are also moved by fix {} of style {}; that should "
          "be a fix of group {}",
          style, total, group->names[igroup], other->id, other->style, fluid_name);
  }
}

/* ----------------------------------------------------------------------
   what enters is in the group of the fluid and in no other one that it was not in before
------------------------------------------------------------------------- */

void FixSPHOpen::check_integrator()
{
  integrator = nullptr;
  for (const auto &other : modify->get_fix_list()) {
    auto *const candidate = dynamic_cast<FixSPHBulk *>(other);
    if (candidate && (group->bitmask[candidate->igroup] == fluidbit)) integrator = candidate;
  }
  if (!integrator)
    error->all(FLERR,
               "Fix {}: there is no fix sph/bulk or sph/micropolar of group {}, so that nothing "
               "moves what enters",
               style, fluid_name);
}

/* ----------------------------------------------------------------------
   particles of the fluid are in front of the plane, those of the zone behind it
------------------------------------------------------------------------- */

void FixSPHOpen::check_places()
{
  bigint number[3] = {0, 0, 0}, all[3];           // fluid behind, zone in front, others in the zone
  const double slack = 1.0e-6 * plane->length;    // particles may be placed on the plane
  int others = 0;
  for (const auto &fix : modify->get_fix_by_style("^sph/open$"))
    if (fix != this) others |= fix->groupbit;
  for (int i = 0; i < atom->nlocal; i++) {
    const double height = plane->height(atom->x[i]);
    const bool behind = height < -slack && height > -plane->length && !plane->beside(atom->x[i]);
    if ((atom->mask[i] & fluidbit) && behind) number[0]++;
    if ((atom->mask[i] & groupbit) && height > slack) number[1]++;
    if ((atom->mask[i] & others) && behind) number[2]++;
  }
  MPI_Allreduce(number, all, 3, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all[0] || all[1])
    error->all(
        FLERR,
        "Fix {}: {} particles of the fluid are behind the plane and {} of the zone in front of "
        "it, seen along the normal, which must point into the fluid",
        style, all[0], all[1]);
  if (all[2])
    error->all(FLERR,
               "Fix {}: {} particles of other open zones are in this one; limit it by the keyword "
               "region",
               style, all[2]);
}

/* ----------------------------------------------------------------------
   A particle of the zone needs a full support as long as the fluid sees it, and rows may be shorter
   by one spacing and by what the fluid moves between two neighbor lists
------------------------------------------------------------------------- */

void FixSPHOpen::check_length()
{
  const double least = 2.0 * pair->support_radius() + rows->largest_spacing() + neighbor->skin;
  if (plane->length < least)
    error->all(FLERR,
               "Fix {}: the zone must be at least {:g} long, not {:g}: two support radii, the "
               "distance of two particles, and the neighbor skin",
               style, least, plane->length);
}

/* ---------------------------------------------------------------------- */

bool FixSPHOpen::given_velocity() const
{
  return values->given(OpenValues::VX);
}

bool FixSPHOpen::given_state() const
{
  return values->given(OpenValues::RHO) || values->given(OpenValues::P);
}

const EosParams &FixSPHOpen::eos(int i) const
{
  return pair->fluid().coeffs[atom->type[i]].eos;
}

/* ----------------------------------------------------------------------
   a zone with fluid at its sides has pairs with it all along
------------------------------------------------------------------------- */

bool FixSPHOpen::zone_near(const double *x, double reach) const
{
  const double height = plane->height(x);
  return height < reach && height > -reach - (plane->limited() ? plane->length : 0.0);
}

/* ----------------------------------------------------------------------
   internal energy per mass, which the ideal gas needs
------------------------------------------------------------------------- */

double FixSPHOpen::energy(int i) const
{
  if (values->given(OpenValues::ENERGY)) return (*values)(OpenValues::ENERGY, i);
  return atom->esph[i] / atom->rmass[i];
}

/* ----------------------------------------------------------------------
   what is prescribed, or the average of what the fluid had, at a particle of zone or fluid
------------------------------------------------------------------------- */

FixSPHOpen::Reference FixSPHOpen::reference(int i, const OpenPlane::Spot &spot) const
{
  const Eos form = pair->fluid().choice.eos;
  const double e = energy(i);
  Reference ref;
  if (values->given(OpenValues::RHO)) {
    ref.rho = (*values)(OpenValues::RHO, i);
    ref.p = pressure(form, eos(i), ref.rho, e);
  } else {
    OpenSample inside;
    ref.p = pressure(form, eos(i), eos(i).rho0, e);
    if (values->given(OpenValues::P))
      ref.p = (*values)(OpenValues::P, i);
    else if (samples->any() && samples->average(spot, inside))
      ref.p = inside.p;
    ref.rho = density_at(form, eos(i), ref.p, e);
  }
  ref.c = sound_speed(form, eos(i), ref.rho, e);
  return ref;
}

/* ---------------------------------------------------------------------- */

void FixSPHOpen::prescribed_velocity(int i, double *u) const
{
  for (int d = 0; d < 3; d++)
    u[d] = (*values)(static_cast<OpenValues::Quantity>(OpenValues::VX + d), i);
}

/* ----------------------------------------------------------------------
   the same of the velocity out of the fluid
------------------------------------------------------------------------- */

double FixSPHOpen::outward_velocity(int i, const OpenPlane::Spot &spot) const
{
  double u[3];
  OpenSample inside;
  if (given_velocity())
    prescribed_velocity(i, u);
  else if (samples->any() && samples->average(spot, inside))
    std::copy_n(inside.u, 3, u);
  else
    std::copy_n(atom->v[i], 3, u);
  return -MathExtra::dot3(u, plane->normal);
}

/* ----------------------------------------------------------------------
   the wave at a particle of the zone: that of now, or the one that has come as far by now
------------------------------------------------------------------------- */

double FixSPHOpen::wave(int i, const OpenPlane::Spot &spot, const Reference &ref, double out) const
{
  double lag = 0.0;
  if (condition == LAGGED)
    lag =
        (samples->distance(spot) - plane->height(atom->x[i])) / std::max(ref.c + out, 0.1 * ref.c);
  return samples->wave(spot, clock - lag);
}

/* ----------------------------------------------------------------------
   Of a quantity that is given, where the other one is from inside, only the changes of the wave: so it
   holds in the mean over time.
------------------------------------------------------------------------- */

double FixSPHOpen::changes(const OpenPlane::Spot &spot, double wave) const
{
  OpenSample inside;
  return samples->average(spot, inside) ? wave - inside.wave : wave;
}

/* ----------------------------------------------------------------------
   velocity of a particle of the zone; along the plane, what leaves keeps its own one.
------------------------------------------------------------------------- */

void FixSPHOpen::velocity(int i, double *u) const
{
  const double *const normal = plane->normal;
  const OpenPlane::Spot spot = plane->spot(atom->x[i]);
  double prescribed[3];
  prescribed_velocity(i, prescribed);

  if (condition == FIXED) {
    if (given_velocity()) {
      std::copy_n(prescribed, 3, u);
      return;
    }
    OpenSample inside;
    const bool found = samples->now(spot, plane->height(atom->x[i]), order, inside);
    std::copy_n(found ? inside.u : atom->v[i], 3, u);
    return;
  }

  const Reference ref = reference(i, spot);
  const double out = outward_velocity(i, spot);
  double leaving = wave(i, spot, ref, out);
  if (given_velocity() && !given_state()) leaving = changes(spot, leaving);
  const double now = out + wave_velocity(ref.rho * ref.c, leaving);
  std::copy_n((given_velocity() && out < 0.0) ? prescribed : atom->v[i], 3, u);
  const double change = -now - MathExtra::dot3(u, normal);
  for (int d = 0; d < 3; d++) u[d] += change * normal[d];
}

/* ----------------------------------------------------------------------
   a run that continues another one, or a restart file, goes on with the velocities that are there
------------------------------------------------------------------------- */

void FixSPHOpen::setup_pre_exchange()
{
  check_places();
  values->evaluate(igroup);
  if (given_velocity() && !samples->any())
    for (int i = 0; i < atom->nlocal; i++) {
      if (!(atom->mask[i] & groupbit)) continue;
      double u[3];
      velocity(i, u);
      for (int d = 0; d < 3; d++) atom->v[i][d] = atom->vest[i][d] = u[d];
      set_spin(i);
    }
  check_length();
  pre_exchange();
}

/* ----------------------------------------------------------------------
   particles stay what they are in number and order from one neighbor list to the next
------------------------------------------------------------------------- */

void FixSPHOpen::setup_pre_force(int /*vflag*/)
{
  const double reach = pair->support_radius() + neighbor->skin;
  members.clear();
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & groupbit) || ((atom->mask[i] & fluidbit) && zone_near(atom->x[i], reach)))
      members.push_back(i);
}

/* ---------------------------------------------------------------------- */

void FixSPHOpen::pre_force(int vflag)
{
  if (neighbor->ago == 0) setup_pre_force(vflag);
}

/* ----------------------------------------------------------------------
   the first half of the step has the forces of its start; particles of the zone are where the
   velocity of then brings them
------------------------------------------------------------------------- */

void FixSPHOpen::initial_integrate(int /*vflag*/)
{
  ledger->advance(0.5 * update->dt);
  clock += update->dt;
  totals_known = false;
  for (const int i : members)
    if (atom->mask[i] & groupbit)
      for (int d = 0; d < 3; d++) atom->x[i][d] += update->dt * atom->v[i][d];
}

/* ----------------------------------------------------------------------
   ... and then where the mean velocity of the step brings them.  Along the plane they move with the
   velocity given, if there is one: with their own, those that leave would gather, or enter walls.
------------------------------------------------------------------------- */

void FixSPHOpen::post_integrate()
{
  values->evaluate(igroup);
  double farthest = 0.0;
  for (const int i : members) {
    double *const x = atom->x[i], *const v = atom->v[i];
    if (atom->mask[i] & groupbit) {
      double u[3], mean[3], motion[3] = {0.0, 0.0, 0.0};
      velocity(i, u);
      set_spin(i);
      if (given_velocity()) prescribed_velocity(i, motion);
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
  rows->note_motion(farthest);
  totals_known = false;
}

/* ----------------------------------------------------------------------
   the second half of the step is that of the fluid, with the forces at its end
------------------------------------------------------------------------- */

void FixSPHOpen::enter(int i, const double *v)
{
  atom->mask[i] = (atom->mask[i] & ~groupbit) | fluidbit;
  std::copy_n(v, 3, atom->v[i]);
  integrator->arrive(i);
  ledger->carry(OpenLedger::IN, i, v, atom->esph[i]);
}

/* ----------------------------------------------------------------------
   the first half was that of the fluid, which has extrapolated the internal energy to the end
------------------------------------------------------------------------- */

void FixSPHOpen::leave(int i)
{
  atom->mask[i] = (atom->mask[i] & ~fluidbit) | groupbit;
  atom->esph[i] -= 0.5 * update->dt * avec->desph_before[i];
  ledger->carry(OpenLedger::OUT, i, atom->v[i], atom->esph[i]);
  std::copy_n(atom->vest[i], 3, atom->v[i]);
  if (spinning) std::copy_n(spinning->omegaest[i], 3, atom->omega[i]);
}

/* ----------------------------------------------------------------------
   what enters brings its spin and its internal energy
------------------------------------------------------------------------- */

void FixSPHOpen::set_spin(int i)
{
  if (values->given(OpenValues::ENERGY) && MathExtra::dot3(atom->v[i], plane->normal) > 0.0)
    atom->esph[i] = atom->rmass[i] * (*values)(OpenValues::ENERGY, i);
  if (!spinning) return;
  double *const omega = atom->omega[i];
  if (values->given(OpenValues::WX) && MathExtra::dot3(atom->v[i], plane->normal) > 0.0)
    for (int d = 0; d < 3; d++)
      omega[d] = (*values)(static_cast<OpenValues::Quantity>(OpenValues::WX + d), i);
  std::copy_n(omega, 3, spinning->omegaest[i]);
}

/* ---------------------------------------------------------------------- */

void FixSPHOpen::pre_exchange()
{
  rows->renew([this](const std::vector<int> &created) {
    if (!values->vary()) return;
    values->evaluate(igroup);
    for (const int i : created) {
      double u[3];
      velocity(i, u);
      for (int d = 0; d < 3; d++) atom->v[i][d] = atom->vest[i][d] = u[d];
      set_spin(i);
    }
  });
}

/* ---------------------------------------------------------------------- */

void FixSPHOpen::final_integrate()
{
  ledger->advance(0.5 * update->dt);
  totals_known = false;
}

/* ---------------------------------------------------------------------- */

void FixSPHOpen::set_impact(const OpenImpact &impact)
{
  ledger->set_impact(impact);
}

/* ---------------------------------------------------------------------- */

void FixSPHOpen::set_state(Engine &engine)
{
  sample(engine);
  for (const int i : members)
    if (atom->mask[i] & groupbit) set_pressure(engine, i);
  totals_known = false;
}

/* ----------------------------------------------------------------------
   variables are needed for the zone and for the fluid near its plane, which is in its group for a
   moment
------------------------------------------------------------------------- */

void FixSPHOpen::sample(Engine &engine)
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

  samples->begin();
  for (const int i : near) add_sample(engine, i);
  samples->finish(clock);
  if (neighbor->ago == 0) check_speed(engine, near);
}

/* ----------------------------------------------------------------------
   no sound comes back from where the fluid leaves faster than sound: nothing can be prescribed there
------------------------------------------------------------------------- */

void FixSPHOpen::check_speed(Engine &engine, const std::vector<int> &near)
{
  if (supersonic || (condition == FIXED && !given_velocity() && !given_state())) return;
  bigint count = 0, all;
  for (const int i : near) {
    const double c =
        sound_speed(pair->fluid().choice.eos, eos(i), atom->rho[i], atom->esph[i] / atom->rmass[i]);
    if (-MathExtra::dot3(engine.particle[i].u, plane->normal) > c) count++;
  }
  MPI_Allreduce(&count, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (!all) return;
  supersonic = true;
  if (comm->me == 0)
    error->warning(FLERR,
                   "Fix {} {}: {} particles leave faster than sound at step {}, where only "
                   "condition fixed with velocity, density and pressure from inside is right",
                   style, id, all, update->ntimestep);
}

/* ---------------------------------------------------------------------- */

void FixSPHOpen::add_sample(Engine &engine, int i)
{
  const Particle &particle = engine.particle[i];
  const double support = pair->support_radius();
  const double height = plane->height(particle.x);
  const double p =
      pressure(pair->fluid().choice.eos, eos(i), atom->rho[i], atom->esph[i] / atom->rmass[i]);
  double wave = 0.0;
  if (condition != FIXED) {
    const OpenPlane::Spot spot = plane->spot(particle.x);
    const Reference ref = reference(i, spot);
    const double out = outward_velocity(i, spot);
    const bool known = samples->any();
    const double du =
        (given_velocity() || known) ? -MathExtra::dot3(particle.u, plane->normal) - out : 0.0;
    const double dp = (given_state() || known) ? p - ref.p : 0.0;
    wave = outgoing_wave(ref.rho * ref.c, du, dp);
  }
  samples->add(particle.x, plane->height(particle.x), particle.vol,
               {wave, p, {particle.u[0], particle.u[1], particle.u[2]}}, engine.kernel_form(),
               radius);
}

/* ----------------------------------------------------------------------
   the bulk term of a particle of the zone is its own: it has a full support where it counts
------------------------------------------------------------------------- */

void FixSPHOpen::set_pressure(Engine &engine, int i)
{
  const Eos form = pair->fluid().choice.eos;
  const OpenPlane::Spot spot = plane->spot(atom->x[i]);
  Reference ref = reference(i, spot);
  if (condition == FIXED) {
    OpenSample inside;
    if (!given_state() && samples->now(spot, plane->height(atom->x[i]), order, inside)) {
      ref.p = inside.p;
      ref.rho = density_at(form, eos(i), ref.p, energy(i));
    }
  } else {
    double leaving = wave(i, spot, ref, outward_velocity(i, spot));
    if (!(given_velocity() && given_state())) leaving = changes(spot, leaving);
    const double dp = wave_pressure(leaving);
    ref.p += dp;
    ref.rho = (form == Eos::IDEAL) ? ref.rho + dp / (ref.c * ref.c)
                                   : density_at(form, eos(i), ref.p, 0.0);
  }

  if (!(ref.rho > 0.0))
    error->one(FLERR, "Fix {} {}: particle {} would have density {:g} and pressure {:g} at step {}",
               style, id, atom->tag[i], ref.rho, ref.p, update->ntimestep);

  Particle &particle = engine.particle[i];
  atom->rho[i] = ref.rho;
  atom->vfrac[i] = particle.vol = atom->rmass[i] / ref.rho;
  const double c_inv = particle.vol / engine.weight(i);
  if (engine.bulk_form() == Bulk::DENSITY) ref.p += engine.zeta_term[i];
  particle.g = ref.p * c_inv * c_inv;
}

/* ----------------------------------------------------------------------
   the ledger, see OpenLedger; number of particles of the zone; mean pressure and velocity of the fluid
   at the plane
------------------------------------------------------------------------- */

double FixSPHOpen::compute_vector(int n)
{
  if (!totals_known) {
    ledger->total(totals);
    double count = 0.0;
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & groupbit) count += 1.0;
    MPI_Allreduce(&count, totals + COUNT, 1, MPI_DOUBLE, MPI_SUM, world);
    samples->mean_at_plane(totals + PRESSURE, totals + VELOCITY);
    totals_known = true;
  }
  return totals[n];
}

/* ---------------------------------------------------------------------- */

void FixSPHOpen::write_restart(FILE *fp)
{
  std::vector<double> state(NHEAD);
  ledger->total(&state[LEDGER]);
  rows->pack(&state[ROWS]);
  state[CLOCK] = clock;
  std::copy_n(plane->point, 3, &state[PLANE]);
  std::copy_n(plane->normal, 3, &state[PLANE + 3]);
  if (comm->me != 0) return;
  const std::vector<double> waves = samples->pack();
  state.insert(state.end(), waves.begin(), waves.end());
  state[0] = static_cast<double>(state.size());
  const int size = static_cast<int>(state.size() * sizeof(double));
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(state.data(), sizeof(double), state.size(), fp);
}

/* ---------------------------------------------------------------------- */

void FixSPHOpen::restart(char *buf)
{
  const auto *const state = reinterpret_cast<double *>(buf);
  ledger->restart(state + LEDGER);
  clock = state[CLOCK];
  if (plane->is_at(state + PLANE)) {
    rows->unpack(state + ROWS);
    waves_before.assign(state + NHEAD, state + static_cast<int>(state[0]));
  } else
    warn_of_other_plane();
}

/* ----------------------------------------------------------------------
   what a zone remembers of rows and waves is of its plane
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
  return samples->memory_usage();
}
