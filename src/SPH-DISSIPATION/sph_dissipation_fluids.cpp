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
#include "sph_dissipation_channels.h"
#include "tokenizer.h"
#include "utils.h"

#include <cmath>
#include <cstdlib>
#include <map>
#include <vector>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

static constexpr int NCOLUMN = 6;    // name temperature rho c mu kappa

/* ----------------------------------------------------------------------
   one line of any length; false at the end of the file
   (LAMMPS's readers cut long lines and do not number them)
------------------------------------------------------------------------- */

static bool read_line(FILE *fp, std::string &line)
{
  char part[1024];
  line.clear();
  while (fgets(part, sizeof(part), fp)) {
    line += part;
    if (line.back() == '\n') return true;
  }
  return !line.empty();
}

/* ----------------------------------------------------------------------
   the fluid of one line
------------------------------------------------------------------------- */

static FluidLine fluid_of_line(LAMMPS *lmp, const std::string &where,
                               const std::vector<std::string> &words)
{
  Error *error = lmp->error;
  if (words.size() != NCOLUMN)
    error->one(FLERR, "{}: a fluid has {} columns (name temperature rho c mu kappa), not {}", where,
               NCOLUMN, words.size());

  double value[NCOLUMN];
  for (int k = 1; k < NCOLUMN; k++) {
    value[k] = utils::is_double(words[k]) ? strtod(words[k].c_str(), nullptr) : NAN;
    if (!std::isfinite(value[k])) error->one(FLERR, "{}: '{}' is not a number", where, words[k]);
  }
  const FluidLine fluid = {value[1], value[2], value[3], value[4], value[5]};

  if (!(fluid.rho > 0.0)) error->one(FLERR, "{}: rho must be > 0, not {}", where, words[2]);
  if (!(fluid.c > 0.0)) error->one(FLERR, "{}: c must be > 0, not {}", where, words[3]);
  if (const char *violated = inadmissible(fluid.mu, fluid.kappa))
    error->one(FLERR, "{}: {}, not mu = {} kappa = {}", where, violated, words[4], words[5]);
  return fluid;
}

/* ---------------------------------------------------------------------- */

FluidLine SPHDissipation::read_fluid(LAMMPS *lmp, const std::string &file, const std::string &name)
{
  Error *error = lmp->error;
  FluidLine fluid = {};

  if (lmp->comm->me == 0) {
    FILE *fp = utils::open_potential(file, lmp, nullptr);
    if (!fp)
      error->one(FLERR,
                 "Cannot open file of fluids {}, which is looked for in the current folder and in "
                 "those of the environment variable LAMMPS_POTENTIALS: {}",
                 file, utils::getsyserror());

    std::string line;
    int number = 0;
    std::map<std::string, int> line_of;
    std::string known;
    while (read_line(fp, line)) {
      number++;
      const auto words = Tokenizer(utils::trim_comment(line)).as_vector();
      if (words.empty()) continue;
      const FluidLine one = fluid_of_line(lmp, fmt::format("{}:{}", file, number), words);
      if (line_of.count(words[0]))
        error->one(FLERR, "{}:{}: fluid {} stands already in line {}", file, number, words[0],
                   line_of[words[0]]);
      line_of[words[0]] = number;
      known += " " + words[0];
      if (words[0] == name) fluid = one;
    }
    fclose(fp);
    if (!line_of.count(name))
      error->one(FLERR, "No fluid {} in file {}, which has:{}", name, file, known);
  }

  MPI_Bcast(&fluid, sizeof(FluidLine), MPI_BYTE, 0, lmp->world);
  return fluid;
}
