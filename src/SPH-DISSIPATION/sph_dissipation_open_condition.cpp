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

#include "sph_dissipation_open.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "group.h"
#include "math_extra.h"
#include "modify.h"
#include "sph_dissipation_characteristics.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_eos.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_keywords.h"
#include "sph_dissipation_model.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

void OpenValues::read(Keywords &key)
{
  struct Keyword {
    const char *name;
    Quantity first;
    int n;
    bool or_inside;      // the fluid inside can give the quantity
    const char *more;    // names of the values behind the first value
  };
  static constexpr Keyword KEYWORDS[] = {{"velocity", VX, 3, true, "vy vz"},
                                         {"density", RHO, 1, true, ""},
                                         {"pressure", P, 1, true, ""},
                                         {"energy", ENERGY, 1, false, ""},
                                         {"temperature", TEMPERATURE, 1, false, ""},
                                         {"spin", WX, 3, false, "wy wz"}};
  for (const auto &keyword : KEYWORDS) {
    if (!key.is(keyword.name)) continue;
    for (int k = 0; k < keyword.n; k++) is_given[keyword.first + k] = false;
    if (keyword.or_inside && strcmp(key.word(), "inside") == 0) return;
    if (keyword.n > 1) key.more(keyword.more);
    for (int k = 0; k < keyword.n; k++) {
      value[keyword.first + k].set(lmp, key.word(k));
      is_given[keyword.first + k] = true;
    }
  }
}

/* ---------------------------------------------------------------------- */

void OpenValues::check() const
{
  if (given(RHO) && given(P))
    error->all(FLERR, "{}: density and pressure cannot both be given, one follows from the other",
               owner);
  if (given(ENERGY) && given(TEMPERATURE))
    error->all(FLERR, "{}: energy and temperature cannot both be given, one follows from the other",
               owner);
  if (given(WX) && !atom->omega)
    error->all(FLERR, "{} spin requires atom style sph/micropolar", owner);
}

/* ---------------------------------------------------------------------- */

const char *OpenValues::fault(int k, double x) const
{
  if (!std::isfinite(x)) return "values must be finite";
  if (domain->dimension == 2 && x != 0.0) {
    if (k == VZ) return "velocity must lie in the plane in 2d";
    if (k == WX || k == WY) return "spin must be along z in 2d";
  }
  if (k == ENERGY && needs_heat && !(x > 0.0)) return "energy must be > 0 with eos ideal";
  if (k == TEMPERATURE && needs_heat && !(x > 0.0)) return "temperature must be > 0 with eos ideal";
  if (k == TEMPERATURE && !(x >= 0.0)) return "temperature must be >= 0";
  return nullptr;
}

/* ---------------------------------------------------------------------- */

void OpenValues::init(bool needs_heat_in)
{
  any_variable = false;
  needs_heat = needs_heat_in;
  for (int k = 0; k < NQUANTITY; k++) {
    if (!is_given[k]) continue;
    Value &one = value[k];
    if (!one.init(lmp, owner, true))
      error->all(FLERR, "Variable {} for {} is neither of equal style nor of atom style",
                 one.name(), owner);
    any_variable = any_variable || one.varies();
    const char *const wrong = one.varies() ? nullptr : fault(k, one.now());
    if (wrong) error->all(FLERR, "{}: {:g} cannot be used: {}", owner, one.now(), wrong);
  }
}

/* ---------------------------------------------------------------------- */

void OpenValues::evaluate(int igroup)
{
  if (!any_variable) return;
  const int groupbit = group->bitmask[igroup];
  modify->clearstep_compute();
  for (int k = 0; k < NQUANTITY; k++) {
    Value &one = value[k];
    if (!is_given[k] || !one.varies()) continue;
    one.evaluate(lmp, igroup);
    if (!one.is_by_atom()) {
      if (const char *const wrong = fault(k, one.now()))
        error->all(FLERR, "{}: variable {} is {} at step {}: {}", owner, one.name(), one.now(),
                   update->ntimestep, wrong);
      continue;
    }
    double odd;
    const std::string where = first_particle(
        lmp,
        [&](int i) {
          return (atom->mask[i] & groupbit) && fault(k, one(i));
        },
        [&](int i) {
          return one(i);
        },
        odd);
    if (!where.empty())
      error->all(FLERR, "{}: variable {} is {} for {} at step {}: {}", owner, one.name(), odd,
                 where, update->ntimestep, fault(k, odd));
  }
  modify->addstep_compute(update->ntimestep + 1);
}

/* ---------------------------------------------------------------------- */

double OpenValues::memory_usage() const
{
  double bytes = 0.0;
  for (const auto &one : value) bytes += one.memory_usage();
  return bytes;
}

/* ---------------------------------------------------------------------- */

void OpenCondition::read(Keywords &key)
{
  if (key.is("average")) averaging_time = key.positive();
  if (key.is("order")) order = key.choice({"0", "1"});
  if (key.is("condition"))
    kind = static_cast<Kind>(key.choice({"lagged", "characteristic", "fixed"}));
}

/* ---------------------------------------------------------------------- */

void OpenCondition::check()
{
  const bool all_given = given_velocity() && given_state();
  if (order >= 0 && (kind != FIXED || all_given))
    error->all(FLERR, "{} order is for values from inside with condition fixed only", owner);
  if (averaging_time > 0.0 && (kind == FIXED || all_given))
    error->all(FLERR,
               "{} average is for values from inside with condition lagged or characteristic only",
               owner);
  if (kind != FIXED && !given_velocity() && !given_state())
    error->all(FLERR, "{} condition {} needs a velocity, a density, or a pressure", owner,
               kind == LAGGED ? "lagged" : "characteristic");
  order = std::max(order, 0);
}

/* ---------------------------------------------------------------------- */

void OpenCondition::init(const FluidModel &fluid_in)
{
  fluid = &fluid_in;
  fields = Fields::of(atom);
  const Constants &par = fluid->constants();
  warm = par.thermal_pressure || par.conducts() || values.given(OpenValues::TEMPERATURE);
  for (int i = 1; i < par.ntypes_1; i++) warm = warm || fluid_in.heat_acts(i);
}

/* ---------------------------------------------------------------------- */

const EosParams &OpenCondition::eos(int i) const
{
  return fluid->coeffs[atom->type[i]].eos;
}

/* ----------------------------------------------------------------------
   Return the speed of waves that leave; with states, a speed between the speeds of slow and fast waves.
------------------------------------------------------------------------- */

double OpenCondition::sound(int i, double rho, double q) const
{
  const Eos form = fluid->choice.eos;
  const double e = warm ? elastic_energy(form, eos(i), rho) + q : 0.0;
  const double c = sound_speed(form, eos(i), rho, e);
  const double more = fluid->stiffness(atom->type[i], fluid->constants().step);
  return (more > 0.0) ? sqrt(c * c + 0.5 * more) : c;
}

/* ---------------------------------------------------------------------- */

double OpenCondition::sound_at_rest(int i, bool of_zone) const
{
  const double q = (of_zone && is_new) ? heat(i) : own_state(i, of_zone ? ZONE : FLUID).q;
  return sound_speed(fluid->choice.eos, eos(i), eos(i).rho0, q);
}

/* ---------------------------------------------------------------------- */

bool OpenCondition::enters(int i) const
{
  return MathExtra::dot3(atom->v[i], plane.normal) > 0.0;
}

/* ----------------------------------------------------------------------
   Return the density of energy.  Particles of a zone do not have a certain rate: its field stores this density.
------------------------------------------------------------------------- */

double &OpenCondition::density_of_energy(int i) const
{
  return fields->desph_before[i];
}

/* ----------------------------------------------------------------------
   Return whether a particle gets the prescribed heat: entering particles do, and all particles of a new zone.
------------------------------------------------------------------------- */

bool OpenCondition::gets_heat(int i, Side side) const
{
  return (values.given(OpenValues::ENERGY) || values.given(OpenValues::TEMPERATURE)) &&
      (enters(i) || (is_new && side == ZONE));
}

/* ----------------------------------------------------------------------
   Return the density and the heat of a particle; rho0 if the density is not known.
------------------------------------------------------------------------- */

OpenState OpenCondition::own_state(int i, Side side) const
{
  if (!warm) return {0.0, 0.0, 0.0};
  double rho = (side == ZONE) ? density_of_energy(i) : atom->rho[i];
  if (!(rho > 0.0)) rho = eos(i).rho0;
  return {0.0, rho,
          atom->esph[i] / atom->rmass[i] - elastic_energy(fluid->choice.eos, eos(i), rho)};
}

/* ----------------------------------------------------------------------
   Return the temperature of a particle in conduction.  A given temperature holds for the whole zone, so that heat is also
   conducted against a stream that leaves.
------------------------------------------------------------------------- */

double OpenCondition::temperature(int i, const OpenState &state) const
{
  if (values.given(OpenValues::TEMPERATURE)) return values(OpenValues::TEMPERATURE, i);
  return fluid->temperature(atom->type[i], state.q);
}

/* ---------------------------------------------------------------------- */

OpenState OpenCondition::at_density(int i, const OpenState &state, double rho) const
{
  const double q = heat_at(eos(i), state.q, state.rho, rho);
  return {elastic_pressure(fluid->choice.eos, eos(i), rho) + thermal_pressure(eos(i), rho, q), rho,
          q};
}

/* ---------------------------------------------------------------------- */

void OpenCondition::keep(int i, const OpenState &state) const
{
  atom->esph[i] = atom->rmass[i] * (elastic_energy(fluid->choice.eos, eos(i), state.rho) + state.q);
  density_of_energy(i) = state.rho;
}

/* ---------------------------------------------------------------------- */

void OpenCondition::prescribed_velocity(int i, double *u) const
{
  for (int d = 0; d < 3; d++)
    u[d] = values(static_cast<OpenValues::Quantity>(OpenValues::VX + d), i);
}

/* ---------------------------------------------------------------------- */

OpenCondition::Reference OpenCondition::reference(int i, Side side) const
{
  const Eos form = fluid->choice.eos;
  const EosParams &par = eos(i);
  Reference ref = Reference();
  ref.spot = plane.spot(atom->x[i]);
  ref.height = plane.height(atom->x[i]);
  ref.known = (given_velocity() && given_state()) || samples.average(ref.spot, ref.mean);

  const OpenState own = own_state(i, side);
  const bool gets = gets_heat(i, side);
  ref.q = own.q;
  if (gets)
    ref.q = values.given(OpenValues::ENERGY)
        ? values(OpenValues::ENERGY, i)
        : fluid->heat(atom->type[i], values(OpenValues::TEMPERATURE, i));
  ref.at_heat = gets || (side == ZONE && (is_new || !(density_of_energy(i) > 0.0)));

  if (values.given(OpenValues::RHO)) {
    ref.rho = values(OpenValues::RHO, i);
    if (!ref.at_heat) ref.q = heat_at(par, own.q, own.rho, ref.rho);
    ref.p = elastic_pressure(form, par, ref.rho) + thermal_pressure(par, ref.rho, ref.q);
  } else {
    if (values.given(OpenValues::P))
      ref.p = values(OpenValues::P, i);
    else
      ref.p = ref.known
          ? ref.mean.p
          : elastic_pressure(form, par, par.rho0) + thermal_pressure(par, par.rho0, ref.q);
    if (ref.at_heat)
      ref.rho = density_at(form, par, ref.p, ref.q);
    else {
      ref.rho = density_at_entropy(form, par, ref.p, own.q, own.rho);
      ref.q = heat_at(par, own.q, own.rho, ref.rho);
    }
  }
  ref.c = sound(i, ref.rho, ref.q);

  double u[3];
  if (given_velocity())
    prescribed_velocity(i, u);
  else
    std::copy_n(ref.known ? ref.mean.u : atom->v[i], 3, u);
  ref.out = -MathExtra::dot3(u, plane.normal);
  return ref;
}

/* ----------------------------------------------------------------------
   Return the wave at a particle of the zone; with condition lagged, the wave that left the fluid before and arrives now.
------------------------------------------------------------------------- */

OpenWave OpenCondition::wave(const Reference &ref) const
{
  double lag = 0.0;
  if (kind == LAGGED)
    lag = (samples.distance(ref.spot) - ref.height) / std::max(ref.c + ref.out, 0.1 * ref.c);
  return samples.wave(ref.spot, clock - lag);
}

/* ----------------------------------------------------------------------
   Return the wave less the mean over time of the wave.  If velocity or state is given, and the other of the two is from
   inside, then the given value holds in the mean over time.
------------------------------------------------------------------------- */

double OpenCondition::changes(const Reference &ref, double wave) const
{
  return ref.known ? wave - ref.mean.wave : wave;
}

/* ----------------------------------------------------------------------
   Set u to the velocity of a particle of the zone.  The component along the plane is the prescribed component where fluid
   enters; particles that leave keep their component.
------------------------------------------------------------------------- */

void OpenCondition::velocity(int i, double *u) const
{
  double prescribed[3];
  prescribed_velocity(i, prescribed);

  if (kind == FIXED) {
    if (given_velocity()) {
      std::copy_n(prescribed, 3, u);
      return;
    }
    OpenSample inside;
    const double *const x = atom->x[i];
    const bool found = samples.now(plane.spot(x), plane.height(x), order, inside);
    std::copy_n(found ? inside.u : atom->v[i], 3, u);
    return;
  }

  const Reference ref = reference(i, ZONE);
  double leaving = wave(ref).j;
  if (given_velocity() && !given_state()) leaving = changes(ref, leaving);
  double now = ref.out;
  if (leaving != 0.0)
    now += wave_velocity(ref.rho * ref.c, leaving);    // a gas may have no heat yet
  std::copy_n((given_velocity() && ref.out < 0.0) ? prescribed : atom->v[i], 3, u);
  const double change = -now - MathExtra::dot3(u, plane.normal);
  for (int d = 0; d < 3; d++) u[d] += change * plane.normal[d];
}

/* ---------------------------------------------------------------------- */

OpenState OpenCondition::state(int i) const
{
  const Eos form = fluid->choice.eos;
  const EosParams &par = eos(i);
  const Reference ref = reference(i, ZONE);
  if (kind == FIXED) {
    OpenSample inside;
    if (given_state() || !samples.now(ref.spot, ref.height, order, inside))
      return {ref.p, ref.rho, ref.q};
    if (ref.at_heat)
      return {inside.p, density_at(form, par, inside.p - inside.strain, ref.q), ref.q};
    return at_pressure(i, ref, inside.p, inside.strain);
  }
  const OpenWave all = wave(ref);
  const bool given = given_velocity() && given_state();
  const double leaving = given ? all.j : changes(ref, all.j);
  return at_pressure(i, ref, ref.p + wave_pressure(leaving), all.strain);
}

/* ----------------------------------------------------------------------
   Return the state at another pressure and the same entropy; strain = pressure of states, on which the density does not
   depend.
------------------------------------------------------------------------- */

OpenState OpenCondition::at_pressure(int i, const Reference &ref, double p, double strain) const
{
  const double rho = density_at_entropy(fluid->choice.eos, eos(i), p - strain, ref.q, ref.rho);
  return {p, rho, heat_at(eos(i), ref.q, ref.rho, rho)};
}

/* ---------------------------------------------------------------------- */

OpenSample OpenCondition::sample(int i, const Particle &particle, double more) const
{
  const double p =
      more + pressure(fluid->choice.eos, eos(i), atom->rho[i], atom->esph[i] / atom->rmass[i]);
  double wave = 0.0;
  if (kind != FIXED) {
    const Reference ref = reference(i, FLUID);
    const double du = (given_velocity() || ref.known)
        ? -MathExtra::dot3(particle.u, plane.normal) - ref.out
        : 0.0;
    const double dp = (given_state() || ref.known) ? p - ref.p : 0.0;
    wave = outgoing_wave(ref.rho * ref.c, du, dp);
  }
  return {wave, more, p, {particle.u[0], particle.u[1], particle.u[2]}};
}

/* ---------------------------------------------------------------------- */

bool OpenCondition::is_supersonic(int i, const Particle &particle) const
{
  const double c = sound(i, atom->rho[i], own_state(i, FLUID).q);
  return -MathExtra::dot3(particle.u, plane.normal) > c;
}
