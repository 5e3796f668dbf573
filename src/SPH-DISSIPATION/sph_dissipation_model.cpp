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
#include "sph_dissipation_fluids.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

FluidModel::FluidModel(LAMMPS *lmp, const std::string &style,
                       const std::vector<std::string> &viscosities) :
    Pointers(lmp),
    coeffs(nullptr), style(style), viscosity_names(viscosities), pair_viscosity(nullptr),
    viscosity_set(nullptr)
{
}

/* ---------------------------------------------------------------------- */

FluidModel::~FluidModel()
{
  memory->destroy(pair_viscosity);
  memory->destroy(viscosity_set);
  delete[] coeffs;
}

/* ---------------------------------------------------------------------- */

void FluidModel::allocate()
{
  const int n = atom->ntypes + 1;
  memory->create(pair_viscosity, nviscosity(), n, n, "pair:viscosity");
  memory->create(viscosity_set, nviscosity(), n, n, "pair:viscosity_set");
  std::fill_n(&pair_viscosity[0][0][0], nviscosity() * n * n, 0.0);
  std::fill_n(&viscosity_set[0][0][0], nviscosity() * n * n, 0);
  coeffs = new TypeCoeff[n];
}

/* ----------------------------------------------------------------------
   set choice to the entry of table that has this name; false if there is none
------------------------------------------------------------------------- */

template <class Choice>
static bool choose(Choice &choice, const std::string &word,
                   const std::vector<std::pair<std::string, Choice>> &table)
{
  for (const auto &entry : table)
    if (entry.first == word) {
      choice = entry.second;
      return true;
    }
  return false;
}

/* ----------------------------------------------------------------------
   global settings
------------------------------------------------------------------------- */

void FluidModel::settings(int narg, char **arg, Shear default_shear)
{
  choice = Settings();
  choice.shear = default_shear;

  for (int iarg = 0; iarg < narg; iarg += 2) {
    const std::string keyword = arg[iarg];
    if (keyword != "kernel" && keyword != "dim" && keyword != "eos" && keyword != "bulk" &&
        keyword != "limit" && (keyword != "shear" || default_shear != Shear::MG))
      error->all(FLERR, "Unknown pair_style {} keyword: {}", style, keyword);
    if (iarg + 2 > narg)
      utils::missing_cmd_args(FLERR, "pair_style " + style + " " + keyword, error);
    const std::string word = arg[iarg + 1];
    auto unknown = [&](const char *what) {
      error->all(FLERR, "Unknown {} {} for pair_style {}", what, word, style);
    };

    if (keyword == "kernel") {
      std::vector<std::pair<std::string, Kernel>> kernels;
      for (auto k : {Kernel::WENDLAND_C2, Kernel::WENDLAND_C4, Kernel::WENDLAND_C6, Kernel::CUBIC,
                     Kernel::QUINTIC, Kernel::LUCY})
        kernels.emplace_back(kernel_name(k), k);
      if (!choose(choice.kernel, word, kernels)) unknown("kernel");
    } else if (keyword == "eos") {
      if (!choose(choice.eos, word,
                  {{"linear", Eos::LINEAR}, {"tait", Eos::TAIT}, {"ideal", Eos::IDEAL}}))
        unknown("eos");
    } else if (keyword == "shear") {
      if (!choose(choice.shear, word,
                  {{"mg", Shear::MG},
                   {"mg/fr", Shear::MG_FR},
                   {"morris", Shear::MORRIS},
                   {"espanol", Shear::ESPANOL},
                   {"none", Shear::NONE}}))
        unknown("shear form");
    } else if (keyword == "bulk") {
      if (!choose(choice.bulk, word,
                  {{"density", Bulk::DENSITY}, {"volume", Bulk::VOLUME}, {"none", Bulk::NONE}}))
        unknown("bulk form");
    } else if (keyword == "limit") {
      if (!choose(choice.limit, word,
                  {{"no", Limit::NO}, {"count", Limit::COUNT}, {"yes", Limit::YES}}))
        unknown("limit");
    } else {
      choice.dim = utils::inumeric(FLERR, word, false, lmp);
      if (choice.dim < 1 || choice.dim > 3)
        error->all(FLERR, "Pair_style {} dim must be 1, 2, or 3, not {}", style, word);
    }
  }
  if (choice.limit != Limit::NO && choice.bulk != Bulk::DENSITY)
    error->all(FLERR, "Pair_style {} limit requires bulk density", style);
}

/* ----------------------------------------------------------------------
   words of pair_coeff that belong to a type
------------------------------------------------------------------------- */

static bool is_type_keyword(const std::string &word)
{
  for (const auto &keyword : {"rho0", "c0", "kappa", "rc", "pb", "gamma"})
    if (word == keyword) return true;
  return false;
}

/* ----------------------------------------------------------------------
   set coeffs for one or more type pairs
   I J rho0 c0 mu kappa rc [pb p] [gamma g]: the types I = J of both ranges
   I J FILE NAME rc [pb p] [gamma g]: the same, from a file of fluids
   I J mu VALUE: the unlike pairs of both ranges
   derived styles have more viscosities, which follow kappa
------------------------------------------------------------------------- */

void FluidModel::coeff(int narg, char **arg, int **setflag)
{
  if (narg < 3) utils::missing_cmd_args(FLERR, "pair_coeff", error);
  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);

  const std::string word = arg[2];
  int count;
  if (utils::is_double(word))
    count = type_coeff(narg, arg, ilo, ihi, jlo, jhi, setflag);
  else if (narg < 5 || nviscosity() > 1 || is_viscosity(word) >= 0 || is_type_keyword(word))
    count = unlike_coeff(narg, arg, ilo, ihi, jlo, jhi, setflag);
  else
    count = fluid_coeff(narg, arg, ilo, ihi, jlo, jhi, setflag);

  if (count == 0)
    error->all(
        FLERR,
        "Pair_coeff {} {} {}: the coefficients rho0 c0 mu kappa ... rc are for a type, I = J; "
        "viscosities by keyword are for unlike types",
        arg[0], arg[1], arg[2]);
}

/* ----------------------------------------------------------------------
   index of a viscosity that unlike types may have of their own, or -1
------------------------------------------------------------------------- */

int FluidModel::is_viscosity(const std::string &word) const
{
  for (int k = 0; k < nviscosity(); k++)
    if (word == viscosity_names[k]) return k;
  return -1;
}

/* ----------------------------------------------------------------------
   coefficients of a type; return # of types
------------------------------------------------------------------------- */

int FluidModel::type_coeff(int narg, char **arg, int ilo, int ihi, int jlo, int jhi, int **setflag)
{
  const int nvalues = 6 + nviscosity();
  if (narg < nvalues) utils::missing_cmd_args(FLERR, "pair_coeff", error);

  auto positive = [&](const char *what, const char *word) {
    const double value = utils::numeric(FLERR, word, false, lmp);
    if (!(value > 0.0) || !std::isfinite(value))
      error->all(FLERR, "Pair_coeff {} must be > 0, not {}", what, word);
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

  for (int iarg = nvalues; iarg < narg; iarg += 2) {
    const std::string keyword = arg[iarg];
    if (keyword != "pb" && keyword != "gamma")
      error->all(FLERR, "Unknown pair_coeff keyword for pair_style {}: {}", style, keyword);
    if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "pair_coeff " + keyword, error);
    if (keyword == "pb")
      one.eos.pb = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    else
      one.gamma = positive("gamma", arg[iarg + 1]);
  }

  if (const char *violated = inadmissible(one.viscosity[0], one.kappa))
    error->all(FLERR, "Pair_coeff {}, not mu = {} kappa = {}", violated, arg[4], arg[5]);

  int count = 0;
  for (int i = std::max(ilo, jlo); i <= std::min(ihi, jhi); i++) {
    coeffs[i] = one;
    setflag[i][i] = 1;
    count++;
  }

  // pairs of unlike types in both ranges are ours, too, if another style shares the simulation

  for (int i = ilo; i <= ihi; i++)
    for (int j = std::max(jlo, i); j <= jhi; j++) setflag[i][j] = 1;
  return count;
}

/* ----------------------------------------------------------------------
   coefficients of a type from a file of fluids; return # of types
------------------------------------------------------------------------- */

int FluidModel::fluid_coeff(int narg, char **arg, int ilo, int ihi, int jlo, int jhi, int **setflag)
{
  const Fluid fluid = read_fluid(lmp, arg[2], arg[3]);
  std::vector<std::string> words = {arg[0], arg[1]};
  for (double value : {fluid.rho, fluid.c, fluid.mu, fluid.kappa})
    words.push_back(fmt::format("{:.17g}", value));
  words.insert(words.end(), arg + 4, arg + narg);

  std::vector<char *> pointers;
  for (auto &word : words) pointers.push_back(&word[0]);
  return type_coeff(static_cast<int>(pointers.size()), pointers.data(), ilo, ihi, jlo, jhi,
                    setflag);
}

/* ----------------------------------------------------------------------
   viscosity between unlike types; return # of pairs
------------------------------------------------------------------------- */

int FluidModel::unlike_coeff(int narg, char **arg, int ilo, int ihi, int jlo, int jhi,
                             int **setflag)
{
  std::vector<std::pair<int, double>> given;
  for (int iarg = 2; iarg < narg; iarg += 2) {
    const std::string keyword = arg[iarg];
    if (is_type_keyword(keyword))
      error->all(FLERR, "Pair_coeff keyword {} belongs to a type, not to a pair of types", keyword);
    const int k = is_viscosity(keyword);
    if (k < 0)
      error->all(FLERR, "Unknown pair_coeff keyword for pair_style {}: {}", style, keyword);
    if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "pair_coeff " + keyword, error);
    const double value = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    if (k == 0 && !(value >= 0.0))
      error->all(FLERR, "Pair_coeff mu must be >= 0, not {}", arg[iarg + 1]);
    given.emplace_back(k, value);
  }

  int count = 0;
  for (int i = ilo; i <= ihi; i++)
    for (int j = jlo; j <= jhi; j++) {
      if (i == j) continue;
      for (const auto &one : given) {
        pair_viscosity[one.first][i][j] = pair_viscosity[one.first][j][i] = one.second;
        viscosity_set[one.first][i][j] = viscosity_set[one.first][j][i] = 1;
      }
      setflag[std::min(i, j)][std::max(i, j)] = 1;
      count++;
    }
  return count;
}

/* ----------------------------------------------------------------------
   dimension of the kernel
------------------------------------------------------------------------- */

int FluidModel::dimension() const
{
  const int dim = choice.dim ? choice.dim : domain->dimension;
  if (dim == 1 && domain->dimension == 3)
    error->all(FLERR, "Pair_style {} dim 1 requires a 2d box", style);
  if (dim != 1 && dim != domain->dimension)
    error->all(FLERR, "Pair_style {} dim {} does not match the {}-d simulation box", style, dim,
               domain->dimension);
  return dim;
}

/* ----------------------------------------------------------------------
   support radius of all types
------------------------------------------------------------------------- */

double FluidModel::common_support(int **setflag) const
{
  double support = 0.0;
  for (int i = 1; i <= atom->ntypes; i++) {
    if (!setflag[i][i]) continue;
    if (support == 0.0) support = coeffs[i].rc;
    if (coeffs[i].rc != support)
      error->all(FLERR,
                 "Pair style {} rc must be the same for all types: {} of type {} differs from {}",
                 style, coeffs[i].rc, i, support);
  }
  return support;
}

/* ---------------------------------------------------------------------- */

std::string FluidModel::summary(int dim, double support) const
{
  return fmt::format("kernel {}, dim {}, eos {}, shear {}, bulk {}, support radius {:g}",
                     kernel_name(choice.kernel), dim, eos_name(choice.eos),
                     shear_name(choice.shear), bulk_name(choice.bulk), support);
}

/* ----------------------------------------------------------------------
   exponent of the equation of state of type i, its viscosities with types up to i
------------------------------------------------------------------------- */

void FluidModel::mix(int i)
{
  TypeCoeff &type = coeffs[i];
  type.eos.gamma = (type.gamma > 0.0) ? type.gamma : default_gamma(choice.eos);
  if (choice.eos == Eos::IDEAL && !(type.eos.gamma > 1.0))
    error->all(FLERR, "Pair_coeff gamma must be > 1 with eos ideal, not {} for type {}",
               type.eos.gamma, i);

  for (int k = 0; k < nviscosity(); k++) {
    pair_viscosity[k][i][i] = type.viscosity[k];
    for (int j = 1; j < i; j++)
      if (!viscosity_set[k][i][j]) {
        const double a = type.viscosity[k], b = coeffs[j].viscosity[k];
        pair_viscosity[k][i][j] = pair_viscosity[k][j][i] = (a * b > 0.0) ? 2.0 * a * b / (a + b)
                                                                          : 0.0;
      }
  }
}

/* ----------------------------------------------------------------------
   coefficient of the bulk term of type i, whose shear term gives bulk viscosity intrinsic
------------------------------------------------------------------------- */

void FluidModel::set_bulk(int i, double intrinsic, bool warn)
{
  TypeCoeff &type = coeffs[i];
  const bool none = (choice.bulk == Bulk::NONE);
  type.zeta = (type.intrinsic || none) ? 0.0 : bulk_coefficient(type.kappa, intrinsic);
  if (warn && none && !type.intrinsic && type.kappa != intrinsic && comm->me == 0)
    error->warning(FLERR,
                   "Pair_coeff kappa {} of type {} is ignored with bulk none: the shear "
                   "term gives kappa {}",
                   type.kappa, i, intrinsic);
}

/* ----------------------------------------------------------------------
   proc 0 writes choices to restart file
------------------------------------------------------------------------- */

void FluidModel::write_settings(FILE *fp) const
{
  fwrite(&choice, sizeof(Settings), 1, fp);
}

/* ----------------------------------------------------------------------
   proc 0 reads choices from restart file, bcasts
------------------------------------------------------------------------- */

void FluidModel::read_settings(FILE *fp)
{
  if (comm->me == 0) utils::sfread(FLERR, &choice, sizeof(Settings), 1, fp, nullptr, error);
  MPI_Bcast(&choice, sizeof(Settings), MPI_BYTE, 0, world);
}

/* ----------------------------------------------------------------------
   the members of a type that pair_coeff sets, as a restart file holds them
------------------------------------------------------------------------- */

static constexpr int NSCALAR = 7;
static constexpr int NSTORED = NSCALAR + TypeCoeff::MAXVISCOSITY;

static void store(const TypeCoeff &type, double *buf)
{
  const EosParams &eos = type.eos;
  const double stored[NSCALAR] = {eos.rho0,
                                  eos.c0,
                                  eos.pb,
                                  type.gamma,
                                  type.kappa,
                                  type.rc,
                                  static_cast<double>(type.intrinsic)};
  std::copy(stored, stored + NSCALAR, buf);
  std::copy(type.viscosity, type.viscosity + TypeCoeff::MAXVISCOSITY, buf + NSCALAR);
}

static void restore(TypeCoeff &type, const double *buf)
{
  type.eos.rho0 = buf[0];
  type.eos.c0 = buf[1];
  type.eos.pb = buf[2];
  type.gamma = buf[3];
  type.kappa = buf[4];
  type.rc = buf[5];
  type.intrinsic = static_cast<int>(buf[6]);
  std::copy(buf + NSCALAR, buf + NSTORED, type.viscosity);
}

/* ----------------------------------------------------------------------
   proc 0 writes coefficients to restart file
------------------------------------------------------------------------- */

void FluidModel::write_coeffs(FILE *fp, int **setflag) const
{
  for (int i = 1; i <= atom->ntypes; i++) {
    fwrite(&setflag[i][i], sizeof(int), 1, fp);
    double stored[NSTORED];
    store(coeffs[i], stored);
    fwrite(stored, sizeof(double), NSTORED, fp);
    for (int k = 0; k < nviscosity(); k++) {
      fwrite(viscosity_set[k][i], sizeof(int), atom->ntypes + 1, fp);
      fwrite(pair_viscosity[k][i], sizeof(double), atom->ntypes + 1, fp);
    }
  }
}

/* ----------------------------------------------------------------------
   proc 0 reads coefficients from restart file, bcasts
------------------------------------------------------------------------- */

void FluidModel::read_coeffs(FILE *fp, int **setflag)
{
  const int n = atom->ntypes + 1;
  for (int i = 1; i < n; i++) {
    double stored[NSTORED];
    if (comm->me == 0) {
      utils::sfread(FLERR, &setflag[i][i], sizeof(int), 1, fp, nullptr, error);
      utils::sfread(FLERR, stored, sizeof(double), NSTORED, fp, nullptr, error);
    }
    MPI_Bcast(&setflag[i][i], 1, MPI_INT, 0, world);
    MPI_Bcast(stored, NSTORED, MPI_DOUBLE, 0, world);
    restore(coeffs[i], stored);
    for (int k = 0; k < nviscosity(); k++) {
      if (comm->me == 0) {
        utils::sfread(FLERR, viscosity_set[k][i], sizeof(int), n, fp, nullptr, error);
        utils::sfread(FLERR, pair_viscosity[k][i], sizeof(double), n, fp, nullptr, error);
      }
      MPI_Bcast(viscosity_set[k][i], n, MPI_INT, 0, world);
      MPI_Bcast(pair_viscosity[k][i], n, MPI_DOUBLE, 0, world);
      for (int j = i + 1; j < n; j++)
        if (viscosity_set[k][i][j]) setflag[i][j] = 1;
    }
  }
}

/* ----------------------------------------------------------------------
   proc 0 writes coefficients of types to data file
------------------------------------------------------------------------- */

void FluidModel::write_data(FILE *fp) const
{
  for (int i = 1; i <= atom->ntypes; i++) utils::print(fp, "{} {}\n", i, type_line(i));
}

/* ----------------------------------------------------------------------
   proc 0 writes coefficients of types and of unlike pairs to data file
------------------------------------------------------------------------- */

void FluidModel::write_data_all(FILE *fp) const
{
  for (int i = 1; i <= atom->ntypes; i++) {
    utils::print(fp, "{} {} {}\n", i, i, type_line(i));
    for (int j = i + 1; j <= atom->ntypes; j++) {
      utils::print(fp, "{} {}", i, j);
      for (int k = 0; k < nviscosity(); k++)
        utils::print(fp, " {} {:.17g}", viscosity_names[k], pair_viscosity[k][i][j]);
      utils::print(fp, "\n");
    }
  }
}

/* ----------------------------------------------------------------------
   arguments of pair_coeff I I
------------------------------------------------------------------------- */

std::string FluidModel::type_line(int i) const
{
  const TypeCoeff &c = coeffs[i];
  std::string line = fmt::format("{:.17g} {:.17g} {:.17g} {}", c.eos.rho0, c.eos.c0, c.viscosity[0],
                                 c.intrinsic ? "intrinsic" : fmt::format("{:.17g}", c.kappa));
  for (int k = 1; k < nviscosity(); k++) line += fmt::format(" {:.17g}", c.viscosity[k]);
  line += fmt::format(" {:.17g} pb {:.17g}", c.rc, c.eos.pb);
  if (c.gamma > 0.0) line += fmt::format(" gamma {:.17g}", c.gamma);
  return line;
}
