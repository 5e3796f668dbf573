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

#include "sph_dissipation_fluids.h"

#include "comm.h"
#include "error.h"
#include "lammps.h"
#include "sph_dissipation_keywords.h"
#include "sph_dissipation_settings.h"
#include "tokenizer.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <sstream>
#include <vector>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

using Words = std::vector<std::string>;

static constexpr double GAS_CONSTANT = 8.31446261815324;    // J/(mol K), exact since 2019

/* ----------------------------------------------------------------------
   Return the text of a file of fluids on all ranks; rank 0 reads it.  (LAMMPS's readers cut long lines.)
------------------------------------------------------------------------- */

static std::string text_of(LAMMPS *lmp, const std::string &file)
{
  enum { READ, NO_FILE, FAILED };
  int state = READ;
  std::string text, reason;
  if (lmp->comm->me == 0) {
    FILE *fp = utils::open_potential(file, lmp, nullptr);
#ifdef SPH_DISSIPATION_POTENTIALS
    const int no_file = errno;
    if (!fp) fp = fopen((SPH_DISSIPATION_POTENTIALS "/" + file).c_str(), "rb");
    if (!fp) errno = no_file;
#endif
    if (fp) {
      char part[1024];
      for (std::size_t n; (n = fread(part, 1, sizeof(part), fp)) > 0;) text.append(part, n);
      if (ferror(fp)) state = FAILED;
    } else
      state = NO_FILE;
    reason = utils::getsyserror();
    if (fp) fclose(fp);
  }
  MPI_Bcast(&state, 1, MPI_INT, 0, lmp->world);
  if (state == NO_FILE)
    lmp->error->all(
        FLERR,
        "Cannot open file of fluids {}, which is looked for in the current folder and in "
        "those of the environment variable LAMMPS_POTENTIALS: {}; for a file of this package: "
        "export LAMMPS_POTENTIALS=FOLDER/potentials, with the folder of the package",
        file, reason);
  if (state == FAILED) lmp->error->all(FLERR, "Cannot read file of fluids {}: {}", file, reason);

  bigint size = static_cast<bigint>(text.size());
  MPI_Bcast(&size, 1, MPI_LMP_BIGINT, 0, lmp->world);
  text.resize(size);
  MPI_Bcast(&text[0], static_cast<int>(size), MPI_CHAR, 0, lmp->world);
  return text;
}

/* ---------------------------------------------------------------------- */

static bool contains(const Words &words, const std::string &word)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

/* ----------------------------------------------------------------------
   Return the columns that a file names, in any order; stop if a needed column is missing.
------------------------------------------------------------------------- */

static Words named_columns(LAMMPS *lmp, const std::string &where, const Words &words)
{
  Error *error = lmp->error;
  const Words columns(words.begin() + 1, words.end());
  if (columns.empty() || columns[0] != "name")
    error->all(FLERR, "{}: the first column must be name", where);
  Words needed = {"temperature", "pressure", "M", "gamma", "mu", "kappa"};
  if (contains(columns, "rho")) needed = {"rho", "c", "mu", "kappa"};
  for (const auto &column : columns) {
    if (std::count(columns.begin(), columns.end(), column) > 1)
      error->all(FLERR, "{}: there are two columns {}", where, column);
    if (utils::strmatch(column, "^kappa_r\\d+$")) needed.push_back("tau" + column.substr(7));
    if (utils::strmatch(column, "^tau\\d+$")) needed.push_back("kappa_r" + column.substr(3));
  }
  for (const auto &column : needed)
    if (!contains(columns, column)) error->all(FLERR, "{}: there is no column {}", where, column);
  return columns;
}

/* ----------------------------------------------------------------------
   Return the fluid of one line; the word - stands for a missing value.
------------------------------------------------------------------------- */

static FluidLine fluid_of_line(LAMMPS *lmp, const std::string &where, const Words &columns,
                               const Words &words)
{
  Error *error = lmp->error;
  if (words.size() != columns.size())
    error->all(FLERR, "{}: a fluid has {} columns ({}), not {}", where, columns.size(),
               utils::join_words(columns, " "), words.size());

  std::map<std::string, double> value;
  std::map<std::string, std::string> text;
  for (std::size_t k = 1; k < words.size(); k++) {
    const bool none = (words[k] == "-");
    value[columns[k]] = utils::is_double(words[k]) ? strtod(words[k].c_str(), nullptr) : NAN;
    text[columns[k]] = words[k];
    if (!none && !std::isfinite(value[columns[k]]))
      error->all(FLERR, "{}: '{}' is not a number", where, words[k]);
  }
  auto positive = [&](const char *column) {
    if (!(value[column] > 0.0))
      error->all(FLERR, "{}: {} must be > 0, not {}", where, column, text[column]);
    return value[column];
  };

  FluidLine fluid = {};
  if (value.count("rho")) {
    fluid.rho = positive("rho");
    fluid.c = positive("c");
  } else {
    // ideal gas: p = rho R T/M, c^2 = gamma p/rho
    if (strcmp(lmp->update->unit_style, "si") != 0)
      error->all(FLERR, "{}: a gas without a column rho needs units si", where);
    const double p = positive("pressure");
    fluid.rho = p * positive("M") / (GAS_CONSTANT * positive("temperature"));
    fluid.c = std::sqrt(positive("gamma") * p / fluid.rho);
  }
  fluid.mu = value["mu"];
  fluid.kappa = value["kappa"];
  if (const char *violated = inadmissible(fluid.mu, fluid.kappa))
    error->all(FLERR, "{}: {}, not mu = {} kappa = {}", where, violated, text["mu"], text["kappa"]);

  for (const auto &column : columns) {
    if (!utils::strmatch(column, "^kappa_r\\d+$")) continue;
    const std::string tau = "tau" + column.substr(7);
    if (text[column] == "-" && text[tau] == "-") continue;
    for (const auto &one : {column, tau}) fluid.relax.push_back(positive(one.c_str()));
  }
  return fluid;
}

/* ----------------------------------------------------------------------
   Return the fluid of this name, or the first one whose name differs in upper and lower case only.
------------------------------------------------------------------------- */

FluidLine SPHDissipation::read_fluid(LAMMPS *lmp, const std::string &file, const std::string &name)
{
  Error *error = lmp->error;
  std::istringstream text(text_of(lmp, file));
  std::string line;
  int number = 0;
  std::map<std::string, int> line_of;
  Words known, columns = {"name", "temperature", "rho", "c", "mu", "kappa"};
  FluidLine exact = {}, in_any_case = {};
  bool found = false;
  while (std::getline(text, line)) {
    number++;
    const auto words = Tokenizer(utils::trim_comment(line)).as_vector();
    if (words.empty()) continue;
    const std::string where = fmt::format("{}:{}", file, number);
    if (words[0] == "columns") {
      columns = named_columns(lmp, where, words);
      continue;
    }
    const FluidLine one = fluid_of_line(lmp, where, columns, words);
    if (line_of.count(words[0]))
      error->all(FLERR, "{}: fluid {} stands already in line {}", where, words[0],
                 line_of[words[0]]);
    line_of[words[0]] = number;
    known.push_back(words[0]);
    if (words[0] == name) exact = one;
    if (!found && utils::lowercase(words[0]) == utils::lowercase(name)) {
      in_any_case = one;
      found = true;
    }
  }
  if (known.empty()) error->all(FLERR, "File {} has no fluids", file);
  if (!found)
    unknown_word(lmp, name.c_str(), fmt::format("No fluid {} in file {}", name, file), known);
  return line_of.count(name) ? exact : in_any_case;
}
