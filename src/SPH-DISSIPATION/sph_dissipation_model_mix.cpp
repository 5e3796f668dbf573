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

#include "sph_dissipation_model.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "memory.h"
#include "sph_dissipation_diffusion_terms.h"
#include "sph_dissipation_parameters.h"
#include "sph_dissipation_steps.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

TypeCoeff::TypeCoeff() : keywords(Channels::NTYPE) {}

/* ---------------------------------------------------------------------- */

FluidModel::FluidModel(LAMMPS *lmp, const std::string &style, bool spins) :
    Pointers(lmp), style(style), spins(spins), par(new Parameters), keywords(type_keywords()),
    of_types(type_variables()), of_pairs(unlike_keywords(spins))
{
  auto add = [&](const std::string &name) {
    variables.push_back({name, nullptr, nullptr});
  };
  for (int k = 0; k < nviscosity(); k++) add(VISCOSITY_NAMES[k]);
  for (const auto &one : of_pairs) add(one.first);
  for (const auto &name : {"c0", "kappa", "pb"}) add(name);
  for (const auto &one : of_types) add(one.first);
}

/* ---------------------------------------------------------------------- */

FluidModel::~FluidModel()
{
  memory->destroy(pair_given);
  memory->destroy(is_given);
  for (auto &one : variables) {
    memory->destroy(one.value);
    memory->destroy(one.known);
  }
  delete[] coeffs;
}

/* ----------------------------------------------------------------------
   Return the smallest and the largest viscosity of a type, with its states.
------------------------------------------------------------------------- */

static Rheology::Range range_of_viscosity(const TypeCoeffs &type, double mu)
{
  return {Rheology::range(type.rheology(), mu).least,
          Rheology::range(type.rheology(), mu + States::largest_viscosity(type)).most};
}

/* ---------------------------------------------------------------------- */

void FluidModel::derive(int dim, double support)
{
  const int n = atom->ntypes;
  static_cast<Settings &>(*par) = choice;
  par->drag = false;
  par->by_rate = has_rheology();
  par->set_kernel(choice.kernel, dim, support);
  par->ntypes_1 = n + 1;
  par->type.assign(n + 1, TypeParameters());
  par->pair.assign((n + 1) * (n + 1), PairCoeff());
  par->pair_energy.assign((n + 1) * (n + 1), 0.0);
  par->cohesion.assign((n + 1) * (n + 1), 0.0);
  for (int i = 1; i <= n; i++) {
    mix(i);
    par->type[i].keywords = TypeCoeffs(coeffs[i].keywords);
    Flows::coefficients(par->type[i].keywords, coeffs[i].eos.rho0, par->type[i].flow);
    par->type[i].mu = coeffs[i].viscosity[MU];
    par->type[i].heat_capacity = heat_capacity(i);
    for (int j = 1; j <= i; j++) {
      if (!coeffs[i].other && !coeffs[j].other) check_pair(i, j);
      const TypePair pair = pair_fluid(i, j);
      const int ij = i * (n + 1) + j, ji = j * (n + 1) + i;
      par->pair[ij] = par->pair[ji] = pair_coefficients(pair);
      par->pair_energy[ij] = par->pair_energy[ji] = pair_energy(pair);
      par->cohesion[ij] = par->cohesion[ji] = cohesion(pair);
    }
    TypeCoeff &type = coeffs[i];
    const double intrinsic = intrinsic_kappa(i, i);
    TypeParameters &derived = par->type[i];
    if (!type.intrinsic && choice.bulk != Bulk::NONE)
      derived.zeta = bulk_coefficient(type.kappa, intrinsic);
    derived.zeta_at_0 = derived.zeta;
    derived.zeta_by_mu = 0.0;
    if (keyword_that_needs(RHEOLOGY, i) && !type.intrinsic && !derived.has_solid()) {
      derived.zeta_at_0 = type.kappa;
      derived.zeta_by_mu = -SPHDissipation::intrinsic_kappa(choice.shear, dim, 1.0);
    }
    if (type.intrinsic) type.kappa = intrinsic;
    publish(npair() + KAPPA, i);
    derived.eos = type.eos;
    derived.other = type.other;
    if (!type.other && derived.keywords.drag() > 0.0) par->drag = true;
    if (!type.other) check_keywords(i);
    if (!type.other && par->by_rate) check_rheology(i);
    if (choice.thermal) check_balance(i);
  }
  const auto is_none = [](const auto &a) {
    return std::all_of(a.begin(), a.end(), [](const auto &one) {
      return one == 0.0;
    });
  };
  if (is_none(par->pair_energy)) par->pair_energy.clear();
  if (is_none(par->cohesion)) par->cohesion.clear();
  par->rate_factor = 0.5 * shear_factor(pair_fluid(1, 1));
  par->set_uniform();
  for (const PairCoeff &one : par->pair)
    if (par->by_rate && optional_channel(one))
      error->all(FLERR, Error::NOLASTLINE,
                 "Pair style {}: viscosities that are not constant cannot be used with {}", style,
                 optional_channel(one));
  for (const PairCoeff &one : par->pair)
    if (choice.shear == Shear::MG_FR && optional_channel(one))
      error->all(FLERR, Error::NOLASTLINE, "Pair style {} shear mg/fr cannot be used with {}",
                 style, optional_channel(one));
  par->set_alike();
  par->set_step(par->step);
  if (par->drag && choice.own_temperatures)
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style {} temp energy cannot be used with a drag of single particles", style);
  if (par->drag && choice.thermal && dim == 1)
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style {} temp with dim 1 cannot be used with a drag of single particles",
               style);
  par->shared = shared;
}

/* ----------------------------------------------------------------------
   Derive the equation of state of type i, and publish() all variables but kappa for pairs of i with types up to i.
------------------------------------------------------------------------- */

void FluidModel::mix(int i)
{
  TypeCoeff &type = coeffs[i];
  type.eos.gamma = (type.gamma > 0.0) ? type.gamma : default_gamma(choice.eos);
  if (choice.eos == Eos::IDEAL && !(type.eos.gamma > 1.0))
    error->all(FLERR, Error::NOLASTLINE,
               "Pair_coeff gamma must be > 1 with eos ideal, not {} for type {}", type.eos.gamma,
               i);
  const TypeCoeffs keywords_of(type.keywords);
  type.eos.derive(choice.eos, keywords_of.gamma(), heat_capacity(i) * keywords_of.T0(),
                  choice.tension);
  for (int k = 0; k < static_cast<int>(variables.size()); k++)
    if (k != npair() + KAPPA) publish(k, i);
}

/* ---------------------------------------------------------------------- */

TypePair FluidModel::pair_fluid(int i, int j) const
{
  TypePair fluid;
  fluid.shear = choice.shear;
  fluid.dim = par->dim;
  fluid.support = par->support;
  fluid.mean_radius = kernel_mean(par->kernel, par->dim, 1, par->support);
  fluid.mean_square = kernel_mean(par->kernel, par->dim, 2, par->support);
  fluid.zeta = 0.5 * (par->type[i].zeta + par->type[j].zeta);
  for (int k = 0; k < Flows::NUMBER; k++)
    fluid.flow[k] = mean_coefficient(par->type[i].flow[k], par->type[j].flow[k]);
  fluid.heat_capacity = std::min(heat_capacity(i), heat_capacity(j));
  for (int k = 0; k < Channels::NTYPE; k++) {
    const double a = par->type[i].keywords.a[k], b = par->type[j].keywords.a[k];
    fluid.type.a[k] = std::max(a, b);
    fluid.smaller.a[k] = std::min(a, b);
  }
  for (int k = 0; k < nviscosity(); k++) fluid.viscosity[k] = viscosity(k, i, j);
  fluid.by_rate = par->by_rate;
  if (fluid.by_rate) {
    Rheology::Range range[2];
    for (int k = 0; k < 2; k++) {
      const TypeParameters &one = par->type[k ? j : i];
      range[k] = range_of_viscosity(one.keywords, one.mu);
      for (const double mu : {range[k].least, range[k].most})
        fluid.largest_zeta =
            std::max(fluid.largest_zeta, std::fabs(one.zeta_at_0 + one.zeta_by_mu * mu));
    }
    fluid.alike = is_alike(i, j) && !par->type[i].has_solid();
    fluid.largest_mu = std::max(range[0].most, range[1].most);
  }
  for (std::size_t k = 0; k < of_pairs.size(); k++)
    fluid.unlike[of_pairs[k].second] = viscosity(nviscosity() + static_cast<int>(k), i, j);
  return fluid;
}

/* ---------------------------------------------------------------------- */

double FluidModel::diffusion_rate() const
{
  const double hsq =
      stability_length_squared(kernel_slope_integral(par->kernel, par->dim, par->support));
  double rate = 0.0;
  for (int i = 1; i < par->ntypes_1; i++)
    for (int j = 1; j <= i; j++) {
      const EosParams &a = par->type[i].eos, &b = par->type[j].eos;
      if (par->type[i].other || par->type[j].other) continue;
      rate = std::max(
          rate,
          SPHDissipation::diffusion_rate(par->delta, 0.5 * par->support, hsq,
                                         std::max(a.impedance() * a.c0, b.impedance() * b.c0),
                                         0.5 * (a.impedance() + b.impedance())));
    }
  return rate;
}

/* ---------------------------------------------------------------------- */

double FluidModel::intrinsic_kappa(int i, int j) const
{
  return SPHDissipation::intrinsic_kappa(pair_fluid(i, j));
}

/* ---------------------------------------------------------------------- */

bool FluidModel::has_torques() const
{
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = 1; j <= atom->ntypes; j++)
      for (int k = MU_R; k < nviscosity(); k++)
        if (viscosity(k, i, j) != 0.0) return true;
  return false;
}

/* ---------------------------------------------------------------------- */

void FluidModel::check_pair(int i, int j) const
{
  if (choice.shear == Shear::NONE && viscosity(MU, i, j) != 0.0)
    error->all(FLERR, Error::NOLASTLINE,
               "Pair_coeff mu must be 0 with shear none, not {} for types {} {}",
               viscosity(MU, i, j), j, i);
  const char *const violated = inadmissible(pair_fluid(i, j));
  if (!violated) return;
  std::string values;
  for (int k = 0; k < (i == j ? nviscosity() : npair()); k++)
    if (k < nviscosity() || viscosity(k, i, j) != 0.0)
      values += fmt::format(" {} = {}", variables[k].name, viscosity(k, i, j));
  error->all(FLERR, Error::NOLASTLINE, "Pair_coeff {}, not{} of types {} {}", violated, values, j,
             i);
}

/* ----------------------------------------------------------------------
   Check that the bulk term of type i has a noise: a negative coefficient has noise only up to the bound of each particle.
------------------------------------------------------------------------- */

void FluidModel::check_balance(int i) const
{
  constexpr double ROUNDOFF = 1.0e-12;
  const TypeCoeff &type = coeffs[i];
  const double intrinsic = intrinsic_kappa(i, i);
  if (type.other || par->type[i].zeta >= -ROUNDOFF * std::fabs(intrinsic)) return;
  if (choice.own_temperatures)
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style {} temp energy cannot be used with kappa {} of type {}, below the {} of "
               "its shear term",
               style, type.kappa, i, intrinsic);
  if (choice.limit == Limit::YES) return;
  error->all(FLERR, Error::NOLASTLINE,
             "Pair style {} temp requires limit yes with kappa {} of type {}, below the {} of its "
             "shear term: particles beyond the bound have no noise in balance with their friction",
             style, type.kappa, i, intrinsic);
}

/* ----------------------------------------------------------------------
   Check that pair_style and the heat capacity fit the keywords of type i.
------------------------------------------------------------------------- */

void FluidModel::check_keywords(int i) const
{
  const int not_with_noise = choice.own_temperatures ? NO_NOISE : NO_NOISE | HEAT_CAPACITY;
  const char *keyword = choice.thermal ? keyword_that_needs(not_with_noise, i) : nullptr;
  if (keyword)
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style {} temp cannot be used with {} of pair_coeff, which type {} has", style,
               keyword, i);
  keyword = keyword_that_needs(HEAT_CAPACITY, i);
  if (keyword && heat_capacity(i) == 0.0)
    error->all(FLERR, Error::NOLASTLINE,
               "Pair_coeff {} of type {} needs its heat capacity, keyword cv", keyword, i);
  if (par->type[i].has_solid() && !par->type[i].keywords.melts())
    error->all(
        FLERR, Error::NOLASTLINE,
        "Pair_coeff solid of type {} requires melt, which gives the range of temperatures; use "
        "melt",
        i);
  if (par->type[i].has_solid() && par->type[i].zeta < -1e-12 * intrinsic_kappa(i, i))
    error->all(
        FLERR, Error::NOLASTLINE,
        "Pair_coeff kappa must be >= {} with solid, that of its shear term, not {} for type {}",
        intrinsic_kappa(i, i), coeffs[i].kappa, i);
  keyword = keyword_that_needs((choice.eos == Eos::IDEAL) ? NOT_EOS_IDEAL : EOS_IDEAL, i);
  if (keyword)
    error->all(FLERR, Error::NOLASTLINE, "Pair_coeff {} of type {} cannot be used with eos {}",
               keyword, i, eos_name(choice.eos));
  keyword = choice.tension ? nullptr : keyword_that_needs(TENSION, i);
  if (keyword)
    error->all(
        FLERR, Error::NOLASTLINE,
        "Pair_coeff {} of type {} with density continuity requires tension yes in pair_style",
        keyword, i);
  if (!(coeffs[i].eos.c_el > 0.0))
    error->all(
        FLERR, Error::NOLASTLINE,
        "Pair_coeff gruneisen {} {} of type {}: the heat alone makes sound faster than c0 {}",
        par->type[i].keywords.gamma(), par->type[i].keywords.T0(), i, coeffs[i].eos.c0);
}

/* ----------------------------------------------------------------------
   Refuse the settings that cannot be used with a viscosity that is not constant.
------------------------------------------------------------------------- */

void FluidModel::check_rheology(int i) const
{
  const auto refuse = [&](const std::string &what) {
    for (int k = 1; k <= atom->ntypes; k++)
      if (const char *keyword = keyword_that_needs(RHEOLOGY, k))
        error->all(FLERR, Error::NOLASTLINE,
                   "Pair_coeff {} of type {}, a viscosity that is not constant, {}", keyword, k,
                   what);
  };
  if ((choice.shear != Shear::MG && choice.shear != Shear::MG_FR2) || choice.bulk != Bulk::DENSITY)
    refuse(fmt::format(
        "requires pair style sph/bulk with shear mg or mg/fr2 and bulk density, not {} with "
        "shear {} and bulk {}",
        style, shear_name(choice.shear), bulk_name(choice.bulk)));
  if (par->dim == 1) refuse("requires dim 2 or 3: on a line there is no shear");
  if (choice.limit != Limit::NO) refuse("cannot be used with limit of pair_style");
  if (choice.thermal)
    refuse("cannot be used with temp of pair_style: no noise without drift is in balance with a "
           "friction that is not constant");
  for (int j = 1; j <= atom->ntypes; j++)
    if (j != i && !coeffs[j].other && !is_mixed(i, j))
      refuse(fmt::format("cannot be used with a mu of the unlike types {} {}: it is the harmonic "
                         "mean of both particles",
                         std::min(i, j), std::max(i, j)));
}

/* ---------------------------------------------------------------------- */

bool FluidModel::has_rheology() const
{
  for (int i = 1; coeffs && i <= atom->ntypes; i++)
    if (keyword_that_needs(RHEOLOGY, i)) return true;
  return false;
}

/* ----------------------------------------------------------------------
   Return true if two types have the same mu and the same law of viscosity.
------------------------------------------------------------------------- */

bool FluidModel::is_alike(int i, int j) const
{
  const auto &a = coeffs[i].keywords, &b = coeffs[j].keywords;
  return coeffs[i].viscosity[MU] == coeffs[j].viscosity[MU] &&
      std::all_of(keywords.begin(), keywords.end(), [&](const TypeKeyword &one) {
           const auto first = a.begin() + one.first;
           return !(one.needs & (RHEOLOGY | MELTS)) ||
               std::equal(first, first + one.count, b.begin() + one.first);
         });
}

/* ---------------------------------------------------------------------- */

const char *FluidModel::keyword_that_needs(int requirements, int type) const
{
  if (coeffs[type].other) return nullptr;
  for (const TypeKeyword &one : keywords)
    if ((one.needs & requirements) && coeffs[type].keywords[one.first] != 0.0) return one.name;
  return nullptr;
}

/* ---------------------------------------------------------------------- */

bool FluidModel::varies_no_flow(const char *name) const
{
  bool found = false;
  Flows::visit(~0, [&](auto channel, int k) {
    double of[Flows::NUMBER], sum = 0.0;
    for (int i = 1; i <= atom->ntypes; i++) {
      Flows::coefficients(TypeCoeffs(coeffs[i].keywords), coeffs[i].eos.rho0, of);
      sum += of[k];
    }
    for (const TypeVariable &one : channel.TYPE_VARIABLES)
      if (sum == 0.0 && strcmp(name, one.name) == 0) found = true;
  });
  return found;
}

/* ---------------------------------------------------------------------- */

bool FluidModel::has_noise_of_states() const
{
  for (int i = 1; coeffs && i <= atom->ntypes; i++) {
    if (coeffs[i].other) continue;
    const States::Numbers own =
        States::numbers(TypeCoeffs(coeffs[i].keywords), coeffs[i].eos.rho0, heat_capacity(i), 1.0);
    for (int slot = 0; slot < States::MOST; slot++)
      if (States::noise(own, slot) != 0.0) return true;
  }
  return false;
}

/* ----------------------------------------------------------------------
   Return true if pair_coeff gives any type, or any two types, the coefficient of a pair energy.
------------------------------------------------------------------------- */

bool FluidModel::has_pair_energy() const
{
  bool found = false;
  Channels::visit(spins, [&](auto channel) {
    for (const char *name : channel.UNLIKE_KEYWORDS)
      for (int i = 1; channel.PAIR_ENERGY && coeffs && i <= atom->ntypes; i++)
        for (int j = 1; j < i; j++)
          if (pair_given[variable_of_pairs(name)][i][j] != 0.0) found = true;
    for (const TypeKeyword &one : channel.TYPE_KEYWORDS)
      for (int i = 1; channel.PAIR_ENERGY && coeffs && i <= atom->ntypes; i++)
        if (!coeffs[i].other && coeffs[i].keywords[keyword(one.name)->first] != 0.0) found = true;
  });
  return found;
}

bool FluidModel::is_of_pair_energy(const char *name) const
{
  bool found = false;
  Channels::visit(spins, [&](auto channel) {
    for (const char *own : channel.UNLIKE_KEYWORDS)
      if (channel.PAIR_ENERGY && strcmp(name, own) == 0) found = true;
    for (const TypeVariable &own : channel.TYPE_VARIABLES)
      if (channel.PAIR_ENERGY && strcmp(name, own.name) == 0) found = true;
  });
  return found;
}

/* ---------------------------------------------------------------------- */

double FluidModel::temperature(int type, double q) const
{
  return (heat_capacity(type) > 0.0) ? par->type[type].temperature(q) : 0.0;
}

double FluidModel::heat(int type, double T) const
{
  return par->type[type].heat(T);
}

bool FluidModel::has_temperatures() const
{
  if (!coeffs) return choice.own_temperatures;
  for (int i = 1; i <= atom->ntypes; i++)
    if (!coeffs[i].other && heat_capacity(i) > 0.0) return true;
  return false;
}

/* ---------------------------------------------------------------------- */

void FluidModel::warn_of_ignored() const
{
  if (comm->me) return;
  for (int i = 1; i <= atom->ntypes; i++) {
    const TypeCoeff &type = coeffs[i];
    if (type.other) continue;
    if (choice.eos == Eos::LINEAR && type.gamma > 0.0)
      error->warning(FLERR, "Pair_coeff gamma {} of type {} is ignored with eos linear", type.gamma,
                     i);
    const TypeCoeffs keywords_of(type.keywords);
    report_ignored(keywords_of, [&](const char *what) {
      error->warning(FLERR, "Pair_coeff: {} of type {} is ignored", what, i);
    });
    const char *const law = keyword_that_needs(RHEOLOGY, i);
    if (law && range_of_viscosity(keywords_of, type.viscosity[MU]).most == 0.0)
      error->warning(FLERR, "Pair_coeff {} of type {} is ignored: mu is 0; give mu > 0", law, i);
    const double intrinsic = intrinsic_kappa(i, i);
    if (choice.bulk != Bulk::NONE || type.kappa == intrinsic) continue;
    error->warning(FLERR,
                   "Pair_coeff kappa {} of type {} is ignored with bulk none: the shear "
                   "term gives kappa {}",
                   type.kappa, i, intrinsic);
  }
}

/* ----------------------------------------------------------------------
   Return a variable that another command may vary; nullptr if the variable has no effect.  Torques, flows, and energies of
   pairs must not begin during a run, because nothing has checked inertia, states, and styles for them.
------------------------------------------------------------------------- */

void *FluidModel::extract(const char *name, int &dim)
{
  dim = 2;
  if (!coeffs) return nullptr;
  if (choice.shear == Shear::NONE && strcmp(name, "mu") == 0) return nullptr;
  if (choice.bulk == Bulk::NONE && strcmp(name, "kappa") == 0) return nullptr;
  if (choice.eos == Eos::IDEAL && strcmp(name, "c0") == 0) return nullptr;
  const int k = variable_of_pairs(name);
  if (k > MU && k < nviscosity() && !has_torques()) return nullptr;
  if (varies_no_flow(name) || (is_of_pair_energy(name) && !has_pair_energy())) return nullptr;
  for (const auto &one : variables)
    if (one.name == name) return one.value;
  return nullptr;
}

/* ----------------------------------------------------------------------
   Return the k-th variable of type i.
------------------------------------------------------------------------- */

double &FluidModel::type_value(int k, int i)
{
  TypeCoeff &type = coeffs[i];
  if (k < nviscosity()) return type.viscosity[k];
  switch (k - npair()) {
    case C0:
      return type.eos.c0;
    case KAPPA:
      return type.kappa;
    case PB:
      return type.eos.pb;
    default:
      return type.keywords[of_types[k - npair() - NOTHER].second];
  }
}

/* ----------------------------------------------------------------------
   Return the k-th variable of two types, as given or mixed: viscosities by the harmonic mean.
------------------------------------------------------------------------- */

double FluidModel::pair_value(int k, int i, int j)
{
  if (k >= nviscosity() && k < npair()) return (i == j) ? 0.0 : pair_given[k][i][j];
  const double a = type_value(k, i), b = type_value(k, j);
  if (i == j) return a;
  if (k >= npair()) return 0.5 * (a + b);
  if (is_given[k][i][j]) return pair_given[k][i][j];
  return (a * b > 0.0) ? 2.0 * a * b / (a + b) : 0.0;
}

/* ----------------------------------------------------------------------
   Put the k-th variable of type i with types up to i into the arrays for extract().
------------------------------------------------------------------------- */

void FluidModel::publish(int k, int i)
{
  const Variable &one = variables[k];
  for (int j = 1; j <= i; j++)
    one.value[i][j] = one.value[j][i] = one.known[i][j] = one.known[j][i] = pair_value(k, i, j);
}

/* ----------------------------------------------------------------------
   Return true if a coefficient belongs to a group of numbers, or to a marked keyword, that pair_coeff has not given to this
   type.
------------------------------------------------------------------------- */

bool FluidModel::is_of_missing_group(int coefficient, int type) const
{
  for (const TypeKeyword &one : keywords)
    if ((one.group || one.marked) && coefficient >= one.first &&
        coefficient < one.first + one.count) {
      const int each = one.group ? one.group : one.count;
      const int first = coefficient - (coefficient - one.first) % each;
      return coeffs[type].keywords[first] == 0.0;
    }
  return false;
}

/* ----------------------------------------------------------------------
   Take over the values that other commands have put into the arrays of extract(); return true if any value is new.  A mixed
   value may change only together with those of both types, to the mean of these.
------------------------------------------------------------------------- */

bool FluidModel::adopt()
{
  constexpr double ROUNDOFF = 1.0e-12;
  if (!coeffs) return false;
  bool changed = false;
  for (int k = 0; k < static_cast<int>(variables.size()); k++) {
    const Variable &one = variables[k];
    auto is_changed = [&](int i, int j) {
      const double value = one.value[i][j];
      if (value == one.known[i][j]) return false;
      if (!std::isfinite(value) || (one.name == "c0" && !(value > 0.0)) ||
          ((one.name == "mu" || one.name == "kappa") && !(value >= 0.0)))
        error->all(FLERR, Error::NOLASTLINE,
                   "Pair style {}: {} of types {} {} was changed to {}, which is not admissible",
                   style, one.name, i, j, value);
      one.known[i][j] = value;
      changed = true;
      return true;
    };

    for (int i = 1; i <= atom->ntypes; i++) {
      if (!is_changed(i, i)) continue;
      if (one.name == "kappa" && coeffs[i].intrinsic)
        error->all(FLERR, Error::NOLASTLINE,
                   "Pair style {}: kappa of type {} is intrinsic and cannot be changed", style, i);
      if (k >= nviscosity() && k < npair())
        error->all(FLERR, Error::NOLASTLINE,
                   "Pair style {}: {} of type {} was changed, but it belongs to two unlike types",
                   style, one.name, i);
      if (k >= npair() + NOTHER && is_of_missing_group(of_types[k - npair() - NOTHER].second, i))
        error->all(
            FLERR, Error::NOLASTLINE,
            "Pair style {}: {} of type {} cannot be changed: its pair_coeff does not have it",
            style, one.name, i);
      type_value(k, i) = one.value[i][i];
      if (const char *violated = inadmissible_keywords(coeffs[i]))
        error->all(FLERR, Error::NOLASTLINE, "Pair style {}: {}, not {} of type {}", style,
                   violated, one.value[i][i], i);
    }

    for (int i = 1; i <= atom->ntypes; i++)
      for (int j = i + 1; j <= atom->ntypes; j++) {
        if (!is_changed(i, j)) continue;
        const double value = one.value[i][j], mixed = pair_value(k, i, j);
        if (k < npair() && (k >= nviscosity() || is_given[k][i][j])) {
          pair_given[k][i][j] = pair_given[k][j][i] = value;
          is_given[k][i][j] = is_given[k][j][i] = 1;
        } else if (std::fabs(value - mixed) > ROUNDOFF * std::fabs(mixed))
          error->all(FLERR, Error::NOLASTLINE,
                     "Pair style {}: {} of types {} {} was changed to {}, but it {}", style,
                     one.name, i, j, value,
                     (k < nviscosity()) ? "is the mean of the types; set it by pair_coeff first"
                                        : "belongs to a type, not to a pair of types");
      }
  }
  return changed;
}

/* ---------------------------------------------------------------------- */

const char *FluidModel::inadmissible_keywords(const TypeCoeff &type) const
{
  return inadmissible(TypeCoeffs(type.keywords), domain->dimension);
}

/* ---------------------------------------------------------------------- */

const Constants &FluidModel::constants() const
{
  return *par;
}

/* ---------------------------------------------------------------------- */

void FluidModel::set_step(double dt)
{
  par->set_step(dt);
}

/* ---------------------------------------------------------------------- */

bool FluidModel::conducts(int type) const
{
  double of[Flows::NUMBER];
  Flows::coefficients(TypeCoeffs(coeffs[type].keywords), coeffs[type].eos.rho0, of);
  return of[HEAT_FLOW] > 0.0;
}

/* ---------------------------------------------------------------------- */

bool FluidModel::heat_acts(int type) const
{
  return coeffs[type].eos.gruneisen != 0.0 || keyword_that_needs(HEAT_CAPACITY, type);
}

/* ---------------------------------------------------------------------- */

double FluidModel::stiffness(int type, double dt) const
{
  return States::stiffness(par->type[type].keywords, par->type[type].eos.rho0, dt);
}
