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
#include "input.h"
#include "memory.h"
#include "sph_dissipation_fluids.h"
#include "sph_dissipation_keywords.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

void FluidModel::allocate()
{
  const int n = atom->ntypes + 1;
  memory->create(pair_given, npair(), n, n, "pair:pair_given");
  memory->create(is_given, npair(), n, n, "pair:is_given");
  std::fill_n(&pair_given[0][0][0], npair() * n * n, 0.0);
  std::fill_n(&is_given[0][0][0], npair() * n * n, 0);
  for (auto &one : variables) {
    memory->create(one.value, n, n, "pair:variable");
    memory->create(one.known, n, n, "pair:variable");
    std::fill_n(&one.value[0][0], n * n, 0.0);
    std::fill_n(&one.known[0][0], n * n, 0.0);
  }
  coeffs = new TypeCoeff[n];
}

/* ----------------------------------------------------------------------
   Read the arguments of pair_style.
------------------------------------------------------------------------- */

void FluidModel::settings(int narg, char **arg)
{
  static constexpr const char *KEYWORDS[] = {"kernel", "dim",     "eos",   "shear",
                                             "bulk",   "volume",  "limit", "density",
                                             "delta",  "tension", "simd",  "temp"};
  choice = Settings();
  simd = "auto";
  if (spins) choice.shear = Shear::MICROPOLAR;
  const char *delta = nullptr, *tension = nullptr;

  for (int iarg = 0, nwords; iarg < narg; iarg += nwords) {
    const std::string keyword = arg[iarg];
    const bool energy =
        (keyword == "temp" && iarg + 1 < narg && strcmp(arg[iarg + 1], "energy") == 0);
    nwords = energy ? 4 : (keyword == "temp") ? 3 : 2;
    if (std::find(std::begin(KEYWORDS), std::end(KEYWORDS), keyword) == std::end(KEYWORDS))
      unknown_word(lmp, arg[iarg], fmt::format("Unknown pair_style {} keyword: {}", style, keyword),
                   {std::begin(KEYWORDS), std::end(KEYWORDS)});
    demand_words(lmp, fmt::format("pair_style {} {}", style, keyword), narg - iarg - 1,
                 energy            ? "energy cv seed"
                     : nwords == 3 ? "T seed"
                                   : "value");
    if (keyword == "temp")
      set_temperature(arg + iarg + 1, energy);
    else if (keyword == "dim") {
      choice.dim = utils::inumeric(FLERR, arg[iarg + 1], false, lmp);
      if (choice.dim < 1 || choice.dim > 3)
        error->all(FLERR, place(lmp, arg[iarg + 1]), "Pair_style {} dim must be 1, 2, or 3, not {}",
                   style, arg[iarg + 1]);
    } else if (keyword == "delta")
      delta = arg[iarg + 1];
    else {
      if (keyword == "tension") tension = arg[iarg + 1];
      set_choice(keyword, arg[iarg + 1]);
    }
  }
  set_surface(delta, tension);
  atom->rho_flag = choice.continuity;    // for the set command

  if (choice.limit != Limit::NO && choice.bulk != Bulk::DENSITY)
    error->all(FLERR, "Pair_style {} limit requires bulk density", style);
  if (choice.thermal && choice.bulk == Bulk::VOLUME)
    error->all(FLERR,
               "Pair_style {} temp cannot be used with bulk volume: its friction matrix is not "
               "symmetric, so that no noise is in balance with it",
               style);
  if (choice.thermal && !choice.own_temperatures && choice.eos == Eos::IDEAL)
    error->all(FLERR,
               "Pair_style {} temp cannot be used with eos ideal: the heat of the viscous forces, "
               "without end at a given temperature, would raise its pressure",
               style);
}

/* ----------------------------------------------------------------------
   Set the choices that density continuity decides; delta, tension = words of these keywords, which need density continuity,
   nullptr: not given.
------------------------------------------------------------------------- */

void FluidModel::set_surface(const char *delta, const char *tension)
{
  if (!choice.continuity) {
    for (const auto &one : {std::make_pair("delta", delta), std::make_pair("tension", tension)})
      if (one.second)
        error->all(FLERR, place(lmp, one.second), "Pair_style {} {} requires density continuity",
                   style, one.first);
    return;
  }
  choice.delta = DEFAULT_DELTA;
  if (!tension) choice.tension = false;
  if (delta) {
    choice.delta = utils::numeric(FLERR, delta, false, lmp);
    if (!(choice.delta >= 0.0) || !std::isfinite(choice.delta))
      error->all(FLERR, place(lmp, delta), "Pair_style {} delta must be >= 0, not {}", style,
                 delta);
  }
  if (choice.eos == Eos::IDEAL)
    error->all(FLERR,
               "Pair_style {} density continuity cannot be used with eos ideal: a gas has no free "
               "surface",
               style);
  if (choice.thermal && choice.delta > 0.0)
    error->all(FLERR,
               "Pair_style {} temp with density continuity requires delta 0: no noise is in "
               "balance with the diffusion of volume",
               style);
}

/* ----------------------------------------------------------------------
   Set the choice of a keyword whose values are words.
------------------------------------------------------------------------- */

void FluidModel::set_choice(const std::string &keyword, const char *word)
{
  std::vector<std::string> words;
  std::string what = keyword;
  bool known = false;
  const auto choose = [&](auto &choice, const std::vector<std::string> &all) {
    words = all;
    const auto found = std::find(words.begin(), words.end(), word);
    known = (found != words.end());
    if (known) choice = static_cast<std::decay_t<decltype(choice)>>(found - words.begin());
  };

  if (keyword == "kernel") {
    std::vector<std::string> kernels;
    for (int k = 0; k <= static_cast<int>(Kernel::LUCY); k++)
      kernels.emplace_back(kernel_name(static_cast<Kernel>(k)));
    choose(choice.kernel, kernels);
  } else if (keyword == "eos") {
    choose(choice.eos, {"linear", "tait", "ideal"});
  } else if (keyword == "shear") {
    what = "shear form";
    for (const Shear form : shear_forms(spins)) {
      words.emplace_back(shear_name(form));
      if (word != words.back()) continue;
      choice.shear = form;
      known = true;
    }
  } else if (keyword == "bulk") {
    what = "bulk form";
    choose(choice.bulk, {"none", "density", "volume"});
  } else if (keyword == "volume") {
    choose(choice.volume, {"number", "mass"});
  } else if (keyword == "limit") {
    choose(choice.limit, {"no", "count", "yes"});
  } else if (keyword == "density") {
    choose(choice.continuity, {"sum", "continuity"});
  } else if (keyword == "tension") {
    choose(choice.tension, {"no", "yes"});
  } else {
    int any;
    choose(any, {"auto", "none", "avx2", "avx512"});
    simd = word;
  }
  if (!known)
    unknown_word(lmp, word, fmt::format("Unknown {} {} for pair_style {}", what, word, style),
                 words);
}

/* ----------------------------------------------------------------------
   Read temp T seed, or temp energy cv seed; words = the arguments behind temp.
------------------------------------------------------------------------- */

void FluidModel::set_temperature(char **words, bool energy)
{
  choice.thermal = true;
  choice.own_temperatures = energy;
  const char *const value = words[energy ? 1 : 0], *const seed = words[energy ? 2 : 1];
  const double number = utils::numeric(FLERR, value, false, lmp);
  if (energy) {
    choice.heat_capacity = number;
    if (!(number > 0.0) || !std::isfinite(number))
      error->all(FLERR, place(lmp, value),
                 "Pair_style {} temp energy: the heat capacity must be > 0, not {}", style, value);
  } else {
    choice.temperature = number;
    if (!(number >= 0.0))
      error->all(FLERR, place(lmp, value), "Pair_style {} temp must be >= 0, not {}", style, value);
  }
  choice.seed = utils::inumeric(FLERR, seed, false, lmp);
  if (choice.seed <= 0)
    error->all(FLERR, place(lmp, seed), "Pair_style {} temp: the seed must be > 0, not {}", style,
               seed);
}

/* ----------------------------------------------------------------------
   Return the keyword of a channel for a type, or nullptr.  is_type_keyword() also accepts the other coefficients of a type.
------------------------------------------------------------------------- */

const TypeKeyword *FluidModel::keyword(const std::string &word) const
{
  for (const TypeKeyword &one : keywords)
    if (word == one.name) return &one;
  return nullptr;
}

bool FluidModel::is_type_keyword(const std::string &word) const
{
  if (variable_of_pairs(word) >= 0) return false;
  for (const auto &name : {"rho0", "c0", "kappa", "rc", "pb", "gamma", "cv"})
    if (word == name) return true;
  return keyword(word) != nullptr;
}

/* ----------------------------------------------------------------------
   Return the names of the numbers of a type; stop at an unknown keyword.
------------------------------------------------------------------------- */

std::string FluidModel::names_of_numbers() const
{
  std::string names = "rho0 c0 mu kappa ";
  for (int k = 1; k < nviscosity(); k++) names += std::string(VISCOSITY_NAMES[k]) + " ";
  return names + "rc";
}

void FluidModel::unknown_keyword(const char *word, const std::vector<std::string> &names) const
{
  unknown_word(lmp, word,
               fmt::format("Unknown pair_coeff keyword for pair_style {}: {}", style, word), names);
}

/* ----------------------------------------------------------------------
   Read the arguments of pair_coeff:
   I J rho0 c0 mu kappa rc [pb p] [gamma g]: the types I = J of both ranges
   I J FILE NAME rc [pb p] [gamma g]: the same, from a file of fluids
   I J mu VALUE or mean: the unlike pairs of both ranges
   In sph/micropolar, mu_r gamma1 gamma2 follow kappa.
------------------------------------------------------------------------- */

void FluidModel::coeff(int narg, char **arg, int **setflag)
{
  demand_words(lmp, "pair_coeff", std::min(narg, 2), "I J");
  const std::string numbers = names_of_numbers();
  if (narg == 2) demand_words(lmp, "pair_coeff", 0, numbers);
  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);

  const std::string word = arg[2];
  int count;
  if (utils::is_double(word))
    count = type_coeff(narg, arg, ilo, ihi, jlo, jhi, setflag);
  else if (narg < 5 || nviscosity() > 1 || variable_of_pairs(word) >= 0 || is_type_keyword(word))
    count = unlike_coeff(narg, arg, ilo, ihi, jlo, jhi, setflag);
  else
    count = fluid_coeff(narg, arg, ilo, ihi, jlo, jhi, setflag);

  if (count == 0)
    error->all(
        FLERR, place(lmp, arg[2]),
        "Pair_coeff {} {} {}: the coefficients rho0 c0 mu kappa ... rc are for a type, I = J; "
        "viscosities and other coefficients by keyword are for unlike types",
        arg[0], arg[1], arg[2]);
}

/* ----------------------------------------------------------------------
   Return the index of a viscosity or another coefficient that pair_coeff may give to two unlike types, or -1.
------------------------------------------------------------------------- */

int FluidModel::variable_of_pairs(const std::string &word) const
{
  for (int k = 0; k < npair(); k++)
    if (word == variables[k].name) return k;
  return -1;
}

/* ----------------------------------------------------------------------
   Read the coefficients of types; return the number of types.
------------------------------------------------------------------------- */

int FluidModel::type_coeff(int narg, char **arg, int ilo, int ihi, int jlo, int jhi, int **setflag)
{
  const int nvalues = 6 + nviscosity();
  int numbers = 0;
  while (numbers < nvalues - 2 && numbers + 2 < narg && !is_type_keyword(arg[numbers + 2]))
    numbers++;
  demand_words(lmp, "pair_coeff", numbers, names_of_numbers());

  auto positive = [&](const char *what, const char *word) {
    const double value = utils::numeric(FLERR, word, false, lmp);
    if (!(value > 0.0) || !std::isfinite(value))
      error->all(FLERR, place(lmp, word), "Pair_coeff {} must be > 0, not {}", what, word);
    return value;
  };

  TypeCoeff one;
  one.eos.rho0 = positive("rho0", arg[2]);
  one.eos.c0 = positive("c0", arg[3]);
  one.viscosity[0] = utils::numeric(FLERR, arg[4], false, lmp);
  one.intrinsic = (strcmp(arg[5], "intrinsic") == 0) ? 1 : 0;
  if (!one.intrinsic) one.kappa = utils::numeric(FLERR, arg[5], false, lmp);
  for (int k = 1; k < nviscosity(); k++)
    one.viscosity[k] = utils::numeric(FLERR, arg[5 + k], false, lmp);
  one.rc = positive("rc", arg[nvalues - 1]);

  std::vector<std::string> given;
  for (int iarg = nvalues, nwords; iarg < narg; iarg += nwords) {
    const std::string keyword = arg[iarg];
    const TypeKeyword *const own = this->keyword(keyword);
    nwords = 1 + (own ? number_of_values(*own, narg - iarg, arg + iarg) : 1);
    if (variable_of_pairs(keyword) >= nviscosity())
      error->all(FLERR, place(lmp, arg[iarg]), "Pair_coeff keyword {} belongs to two unlike types",
                 keyword);
    if (!own && keyword != "pb" && keyword != "gamma" && keyword != "cv") {
      std::vector<std::string> names = {"pb", "gamma", "cv"};
      for (const TypeKeyword &one : keywords) names.emplace_back(one.name);
      unknown_keyword(arg[iarg], names);
    }
    if (iarg + nwords > narg)
      demand_words(lmp, "pair_coeff " + keyword, narg - iarg - 1, own ? own->words : "value");
    if (!(own && own->group) && std::find(given.begin(), given.end(), keyword) != given.end())
      error->all(FLERR, place(lmp, arg[iarg]), "Pair_coeff keyword {} is given twice", keyword);
    given.push_back(keyword);
    if (own) {
      double *a = one.keywords.data() + own->first;
      const double *const end = a + own->count;
      while (own->group && a < end && *a != 0.0) a += own->group;    // groups given before
      if (end - a < nwords - 1)
        error->all(FLERR, place(lmp, arg[iarg]), "Pair_coeff {} has more than {} groups of numbers",
                   keyword, own->count / own->group);
      if (own->marked) *a++ = 1.0;
      for (int k = 1; k < nwords; k++) a[k - 1] = utils::numeric(FLERR, arg[iarg + k], false, lmp);
      if (const char *violated = inadmissible_keywords(one)) {
        std::string words;
        for (int k = 1; k < nwords; k++) words += std::string(" ") + arg[iarg + k];
        error->all(FLERR, place(lmp, arg[iarg + 1]), "Pair_coeff {}, not{}", violated, words);
      }
      for (int k = 1; own->group && k < nwords; k += own->group)
        if (a[k - 1] == 0.0)
          error->all(FLERR, place(lmp, arg[iarg + k]), "Pair_coeff {}: {} {} is no process",
                     keyword, arg[iarg + k], arg[iarg + k + 1]);
    } else if (keyword == "pb")
      one.eos.pb = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    else if (keyword == "cv")
      one.cv = positive("cv", arg[iarg + 1]);
    else
      one.gamma = positive("gamma", arg[iarg + 1]);
  }

  if (const char *violated = inadmissible(one.viscosity[0], one.kappa))
    error->all(FLERR, place(lmp, arg[one.viscosity[0] >= 0.0 ? 5 : 4]),
               "Pair_coeff {}, not mu = {} kappa = {}", violated, arg[4], arg[5]);

  int count = 0;
  for (int i = std::max(ilo, jlo); i <= std::min(ihi, jhi); i++) {
    coeffs[i] = one;
    setflag[i][i] = 1;
    count++;
  }

  // reset pairs of types with new coefficients: the mean of the viscosities, no other coefficient of unlike types

  for (int i = std::max(ilo, jlo); i <= std::min(ihi, jhi); i++)
    for (int j = std::max(ilo, jlo); j <= std::min(ihi, jhi); j++)
      for (int k = 0; k < npair(); k++) {
        pair_given[k][i][j] = 0.0;
        is_given[k][i][j] = 0;
      }

  // pairs of unlike types in both ranges belong to this style as well, if another style shares the simulation

  for (int i = ilo; i <= ihi; i++)
    for (int j = std::max(jlo, i); j <= jhi; j++) setflag[i][j] = 1;
  return count;
}

/* ----------------------------------------------------------------------
   Return true for a number, also for inf and nan, which utils::numeric() refuses.
------------------------------------------------------------------------- */

static bool is_number(const char *word)
{
  char *end = nullptr;
  strtod(word, &end);
  return end != word && *end == 0;
}

/* ----------------------------------------------------------------------
   Return how many numbers follow the keyword arg[0]; for groups, count all numbers up to the next word.
------------------------------------------------------------------------- */

int FluidModel::number_of_values(const TypeKeyword &keyword, int narg, char **arg) const
{
  if (!keyword.group) return keyword.numbers();
  int n = 0;
  while (n + 1 < narg && is_number(arg[n + 1])) n++;
  if (n == 0) demand_words(lmp, std::string("pair_coeff ") + keyword.name, n, keyword.words);
  if (n % keyword.group)
    error->all(FLERR, place(lmp, arg[0]),
               "Pair_coeff {} needs groups of {} numbers, of which {} are left", keyword.name,
               keyword.group, n % keyword.group);
  return n;
}

/* ----------------------------------------------------------------------
   Read the coefficients of types from a file of fluids; return the number of types.
------------------------------------------------------------------------- */

int FluidModel::fluid_coeff(int narg, char **arg, int ilo, int ihi, int jlo, int jhi, int **setflag)
{
  const FluidLine fluid = read_fluid(lmp, arg[2], arg[3]);
  const int dim = dimension();
  if (dim < 3 && fluid.mu > 0.0 && comm->me == 0)
    error->warning(FLERR,
                   "Pair_coeff {} {}: kappa {:g} of the file is that of three dimensions; sound in "
                   "{}d is damped as there with kappa {:g}, which needs rho0 c0 mu kappa rc as "
                   "numbers",
                   arg[2], arg[3], fluid.kappa, dim,
                   fluid.kappa + fluid.mu * (dim == 1 ? 4.0 : 1.0) / 3.0);
  std::vector<std::string> words = {arg[0], arg[1]};
  for (double value : {fluid.rho, fluid.c, fluid.mu, fluid.kappa})
    words.push_back(fmt::format("{:.17g}", value));
  words.push_back(arg[4]);
  if (!fluid.relax.empty()) words.push_back("relax");
  for (double value : fluid.relax) words.push_back(fmt::format("{:.17g}", value));
  words.insert(words.end(), arg + 5, arg + narg);

  std::vector<char *> pointers;
  for (auto &word : words) pointers.push_back(&word[0]);
  return type_coeff(static_cast<int>(pointers.size()), pointers.data(), ilo, ihi, jlo, jhi,
                    setflag);
}

/* ----------------------------------------------------------------------
   Read viscosities and other coefficients of unlike types; return the number of pairs.
------------------------------------------------------------------------- */

int FluidModel::unlike_coeff(int narg, char **arg, int ilo, int ihi, int jlo, int jhi,
                             int **setflag)
{
  struct Given {
    int k, set;
    double value;
  };
  std::vector<Given> given;
  for (int iarg = 2; iarg < narg; iarg += 2) {
    const std::string keyword = arg[iarg];
    if (is_type_keyword(keyword))
      error->all(FLERR, place(lmp, arg[iarg]),
                 "Pair_coeff keyword {} belongs to a type, not to a pair of types", keyword);
    const int k = variable_of_pairs(keyword);
    if (k < 0 && narg == 4 && nviscosity() == 1 && !is_number(arg[3]))
      error->all(FLERR, place(lmp, arg[2]),
                 "Pair_coeff {} {}: a fluid of a file needs the support radius rc behind its name",
                 arg[2], arg[3]);
    if (k < 0) {
      std::vector<std::string> names;
      for (int one = 0; one < npair(); one++) names.push_back(variables[one].name);
      unknown_keyword(arg[iarg], names);
    }
    demand_words(lmp, "pair_coeff " + keyword, narg - iarg - 1, "value");
    for (const Given &one : given)
      if (one.k == k)
        error->all(FLERR, place(lmp, arg[iarg]), "Pair_coeff keyword {} is given twice", keyword);
    const bool mean = (k < nviscosity() && strcmp(arg[iarg + 1], "mean") == 0);
    const double value = mean ? 0.0 : utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    if (k == 0 && !(value >= 0.0))
      error->all(FLERR, place(lmp, arg[iarg + 1]), "Pair_coeff mu must be >= 0, not {}",
                 arg[iarg + 1]);
    given.push_back({k, mean ? 0 : 1, value});
  }

  int count = 0;
  for (int i = ilo; i <= ihi; i++)
    for (int j = jlo; j <= jhi; j++) {
      if (i == j) continue;
      for (const auto &one : given) {
        pair_given[one.k][i][j] = pair_given[one.k][j][i] = one.value;
        is_given[one.k][i][j] = is_given[one.k][j][i] = one.set;
      }
      setflag[std::min(i, j)][std::max(i, j)] = 1;
      count++;
    }
  return count;
}

/* ----------------------------------------------------------------------
   Return the dimension of the kernel.
------------------------------------------------------------------------- */

int FluidModel::dimension() const
{
  const int dim = choice.dim ? choice.dim : domain->dimension;
  if (dim == 1 && domain->dimension == 3)
    error->all(FLERR, Error::NOLASTLINE, "Pair_style {} dim 1 requires a 2d box", style);
  if (dim != 1 && dim != domain->dimension)
    error->all(FLERR, Error::NOLASTLINE,
               "Pair_style {} dim {} does not match the {}-d simulation box", style, dim,
               domain->dimension);
  return dim;
}

/* ----------------------------------------------------------------------
   Return the support radius, the same for all types.
------------------------------------------------------------------------- */

double FluidModel::common_support(int **setflag) const
{
  double support = 0.0;
  for (int i = 1; i <= atom->ntypes; i++) {
    if (!setflag[i][i]) continue;
    if (support == 0.0) support = coeffs[i].rc;
    if (coeffs[i].rc != support)
      error->all(FLERR, Error::NOLASTLINE,
                 "Pair style {} rc must be the same for all types: {} of type {} differs from {}",
                 style, coeffs[i].rc, i, support);
  }
  return support;
}

/* ---------------------------------------------------------------------- */

std::string FluidModel::summary(int dim, double support) const
{
  const std::string surface = choice.continuity
      ? fmt::format("density continuity, delta {:g}, tension {}, ", choice.delta,
                    choice.tension ? "yes" : "no")
      : "";
  return fmt::format(
      "kernel {}, dim {}, eos {}, shear {}, bulk {}, volume {}, {}support radius {:g}",
      kernel_name(choice.kernel), dim, eos_name(choice.eos), shear_name(choice.shear),
      bulk_name(choice.bulk), volume_name(choice.volume), surface, support);
}
