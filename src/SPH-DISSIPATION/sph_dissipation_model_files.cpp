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
#include "error.h"
#include "sph_dissipation_fields.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// Return the first number of the settings in a restart file: VERSION in the lower 16 bits, and a hash of the names of all
// coefficients above.  Raise VERSION with any other change of the stored numbers.  Older versions begin with a number below
// 10.

static constexpr int VERSION = 1008;

int FluidModel::format_number() const
{
  std::string names;
  for (int k = 0; k < nviscosity(); k++) names += fmt::format("{} ", VISCOSITY_NAMES[k]);
  for (const auto &one : of_pairs) names += one.first + " ";
  for (const auto &one : keywords) names += fmt::format("{} {} ", one.name, one.count);
  std::uint32_t sum = 2166136261u;    // FNV-1a
  for (const char c : names) sum = (sum ^ static_cast<unsigned char>(c)) * 16777619u;
  return VERSION + static_cast<int>((sum >> 17) << 16);
}

/* ----------------------------------------------------------------------
   Write and read numbers of a restart file; rank 0 reads and checks them, all ranks get them.
------------------------------------------------------------------------- */

static void put(FILE *fp, int value)
{
  fwrite(&value, sizeof(int), 1, fp);
}

static void put(FILE *fp, double value)
{
  fwrite(&value, sizeof(double), 1, fp);
}

namespace {
class Reader : protected Pointers {
 public:
  Reader(LAMMPS *lmp, FILE *fp, const std::string &style) : Pointers(lmp), fp(fp), style(style) {}

  int format()
  {
    int value = 0;
    if (comm->me == 0) utils::sfread(FLERR, &value, sizeof(int), 1, fp, nullptr, error);
    MPI_Bcast(&value, 1, MPI_INT, 0, world);
    return value;
  }

  int integer(const char *what, int lo, int hi)
  {
    int value = 0;
    if (comm->me == 0) {
      utils::sfread(FLERR, &value, sizeof(int), 1, fp, nullptr, error);
      if (value < lo || value > hi)
        error->one(FLERR, "Restart file is damaged: pair style {} {} is {}, not {} to {}", style,
                   what, value, lo, hi);
    }
    MPI_Bcast(&value, 1, MPI_INT, 0, world);
    return value;
  }

  double number(const char *what, bool positive = false)
  {
    double value = 0.0;
    if (comm->me == 0) {
      utils::sfread(FLERR, &value, sizeof(double), 1, fp, nullptr, error);
      if (!std::isfinite(value) || (positive && !(value > 0.0)))
        error->one(FLERR, "Restart file is damaged: pair style {} {} is {}", style, what, value);
    }
    MPI_Bcast(&value, 1, MPI_DOUBLE, 0, world);
    return value;
  }

 private:
  FILE *fp;
  const std::string &style;
};
}    // namespace

/* ----------------------------------------------------------------------
   Write the settings to a restart file, on rank 0.
------------------------------------------------------------------------- */

void FluidModel::write_settings(FILE *fp) const
{
  put(fp, format_number());
  put(fp, static_cast<int>(choice.kernel));
  put(fp, static_cast<int>(choice.eos));
  put(fp, static_cast<int>(choice.shear));
  put(fp, static_cast<int>(choice.bulk));
  put(fp, choice.dim);
  put(fp, static_cast<int>(choice.limit));
  put(fp, static_cast<int>(choice.volume));
  put(fp, static_cast<int>(choice.thermal));
  put(fp, choice.temperature);
  put(fp, static_cast<int>(choice.own_temperatures));
  put(fp, choice.heat_capacity);
  put(fp, choice.seed);
  put(fp, static_cast<int>(choice.continuity));
  put(fp, choice.delta);
  put(fp, static_cast<int>(choice.tension));
  put(fp, static_cast<double>(clock.step));
  put(fp, static_cast<double>(clock.offset));
  put(fp, diffusion_age);
  put(fp, shift_age);
  put(fp, static_cast<int>(hash_of_forces));
  put(fp, static_cast<int>(hash_of_forces >> 32));
}

/* ----------------------------------------------------------------------
   Read the settings from a restart file on rank 0, and broadcast them.
------------------------------------------------------------------------- */

void FluidModel::read_settings(FILE *fp)
{
  Reader read(lmp, fp, style);
  const int format = read.format(), own = format_number(), version = format & 0xffff;
  if (format != own)
    error->all(FLERR, Error::NOLASTLINE,
               "Restart file was written by {} version of pair style {}, format {}, not {}",
               (version > VERSION)       ? "a newer"
                   : (version < VERSION) ? "an older"
                                         : "another",
               style, format, own);

  choice.kernel = static_cast<Kernel>(read.integer("kernel", 0, static_cast<int>(Kernel::LUCY)));
  choice.eos = static_cast<Eos>(read.integer("eos", 0, static_cast<int>(Eos::IDEAL)));
  choice.shear =
      static_cast<Shear>(read.integer("shear", 0, static_cast<int>(Shear::MICROPOLAR_FR2)));
  if (has_spins(choice.shear) != spins)
    error->all(FLERR, Error::NOLASTLINE,
               "Restart file is damaged: pair style {} has no such shear form", style);
  choice.bulk = static_cast<Bulk>(read.integer("bulk", 0, static_cast<int>(Bulk::VOLUME)));
  choice.dim = read.integer("dim", 0, 3);
  choice.limit = static_cast<Limit>(read.integer("limit", 0, static_cast<int>(Limit::YES)));
  choice.volume = static_cast<Volume>(read.integer("volume", 0, static_cast<int>(Volume::MASS)));
  choice.thermal = read.integer("flag of thermal noise", 0, 1);
  choice.temperature = read.number("temperature");
  choice.own_temperatures = read.integer("flag of temperatures", 0, 1);
  choice.heat_capacity = read.number("heat capacity");
  choice.seed = read.integer("seed", 0, MAXSMALLINT);
  choice.continuity = read.integer("flag of density continuity", 0, 1);
  atom->rho_flag = choice.continuity;
  choice.delta = read.number("delta");
  choice.tension = read.integer("flag of tension", 0, 1);
  clock.step = static_cast<bigint>(read.number("step of the noise"));
  clock.offset = static_cast<bigint>(read.number("offset of the noise"));
  diffusion_age = read.integer("age of the diffusion", 0, MAXSMALLINT);
  shift_age = read.integer("age of the shift", 0, MAXSMALLINT);
  constexpr int LOWEST = std::numeric_limits<int>::min(), HIGHEST = std::numeric_limits<int>::max();
  hash_of_forces = static_cast<std::uint32_t>(read.integer("hash", LOWEST, HIGHEST));
  hash_of_forces |= static_cast<std::uint64_t>(read.integer("hash", LOWEST, HIGHEST)) << 32;
}

/* ----------------------------------------------------------------------
   Return the FNV-1a hash of the bits of all settings and coefficients.
------------------------------------------------------------------------- */

std::uint64_t FluidModel::hash() const
{
  std::uint64_t sum = 14695981039346656037ull;
  auto add = [&](double value) {
    std::uint64_t bits;
    value += 0.0;    // -0 is 0
    memcpy(&bits, &value, sizeof(bits));
    for (int k = 0; k < 8; k++) sum = (sum ^ (bits >> 8 * k & 255)) * 1099511628211ull;
  };
  for (const int value :
       {static_cast<int>(choice.kernel), static_cast<int>(choice.eos),
        static_cast<int>(choice.shear), static_cast<int>(choice.bulk), choice.dim,
        static_cast<int>(choice.limit), static_cast<int>(choice.volume),
        static_cast<int>(choice.thermal), static_cast<int>(choice.own_temperatures), choice.seed})
    add(value);
  add(choice.temperature);
  add(choice.heat_capacity);
  add(choice.continuity);
  add(choice.delta);
  add(choice.tension);
  for (int i = 1; i <= atom->ntypes; i++) {
    const TypeCoeff &type = coeffs[i];
    add(type.other);
    if (type.other) continue;
    for (const double value : {type.eos.rho0, type.eos.c0, type.eos.pb, type.gamma, type.cv,
                               type.intrinsic ? -1.0 : type.kappa, type.rc})
      add(value);
    for (const double value : type.keywords) add(value);
    for (int j = 1; j <= i; j++)
      for (int k = 0; k < npair(); k++) add(viscosity(k, i, j));
  }
  return sum;
}

/* ----------------------------------------------------------------------
   Write coefficients to a restart file, on rank 0: of types with coefficients, and of unlike types with given numbers.
------------------------------------------------------------------------- */

void FluidModel::write_coeffs(FILE *fp, int **setflag) const
{
  put(fp, nviscosity());
  for (int i = 1; i <= atom->ntypes; i++) {
    put(fp, setflag[i][i]);
    if (setflag[i][i]) {
      const TypeCoeff &type = coeffs[i];
      for (double value :
           {type.eos.rho0, type.eos.c0, type.eos.pb, type.gamma, type.cv, type.kappa, type.rc})
        put(fp, value);
      put(fp, type.intrinsic);
      for (const double value : type.keywords) put(fp, value);
      for (int k = 0; k < nviscosity(); k++) put(fp, type.viscosity[k]);
    }
    for (int j = i + 1; j <= atom->ntypes; j++)
      for (int k = 0; k < npair(); k++) {
        put(fp, is_given[k][i][j]);
        if (is_given[k][i][j]) put(fp, pair_given[k][i][j]);
      }
  }
}

/* ----------------------------------------------------------------------
   Read coefficients from a restart file on rank 0, and broadcast them.
------------------------------------------------------------------------- */

void FluidModel::read_coeffs(FILE *fp, int **setflag)
{
  Reader read(lmp, fp, style);
  read.integer("number of viscosities", nviscosity(), nviscosity());
  for (int i = 1; i <= atom->ntypes; i++) {
    setflag[i][i] = read.integer("flag of a type", 0, 1);
    if (setflag[i][i]) {
      TypeCoeff &type = coeffs[i];
      type.eos.rho0 = read.number("rho0", true);
      type.eos.c0 = read.number("c0", true);
      type.eos.pb = read.number("pb");
      type.gamma = read.number("gamma");
      type.cv = read.number("cv");
      type.kappa = read.number("kappa");
      type.rc = read.number("rc", true);
      type.intrinsic = read.integer("flag of intrinsic kappa", 0, 1);
      for (double &value : type.keywords) value = read.number("coefficient of a channel");
      for (int k = 0; k < nviscosity(); k++) type.viscosity[k] = read.number(VISCOSITY_NAMES[k]);
    }
    for (int j = i + 1; j <= atom->ntypes; j++)
      for (int k = 0; k < npair(); k++) {
        const int set = read.integer("flag of two types", 0, 1);
        is_given[k][i][j] = is_given[k][j][i] = set;
        if (!set) continue;
        pair_given[k][i][j] = pair_given[k][j][i] = read.number(variables[k].name.c_str());
        setflag[i][j] = 1;
      }
  }
}

/* ----------------------------------------------------------------------
   Write coefficients of types to a data file, on rank 0.
------------------------------------------------------------------------- */

void FluidModel::write_data(FILE *fp) const
{
  for (int i = 1; i <= atom->ntypes; i++)
    put_line(fp, fmt::format("{} {}", i, type_line(i)), style + " coefficients");
}

/* ----------------------------------------------------------------------
   Write coefficients of types and of unlike pairs to a data file, on rank 0.
------------------------------------------------------------------------- */

void FluidModel::write_data_all(FILE *fp) const
{
  for (int i = 1; i <= atom->ntypes; i++) {
    put_line(fp, fmt::format("{} {} {}", i, i, type_line(i)), style + " coefficients");
    for (int j = i + 1; j <= atom->ntypes; j++) {
      std::string line = fmt::format("{} {}", i, j);
      for (int k = 0; k < npair(); k++)
        if (k < nviscosity() || is_given[k][i][j])
          line += fmt::format(" {} {}", variables[k].name,
                              is_given[k][i][j] ? fmt::format("{}", viscosity(k, i, j)) : "mean");
      put_line(fp, line, style + " coefficients");
    }
  }
}

/* ----------------------------------------------------------------------
   Write a line of a data file; stop if it exceeds the buffer of read_data, which would drop the rest.
------------------------------------------------------------------------- */

void FluidModel::put_line(FILE *fp, const std::string &line, const std::string &what) const
{
  if (line.size() > MOST_OF_DATA_LINE)
    error->one(FLERR,
               "Cannot write a data file: a line of {} has {} characters, and read_data takes {}; "
               "use write_restart: {}",
               what, line.size(), MOST_OF_DATA_LINE, line);
  utils::print(fp, "{}\n", line);
}

/* ----------------------------------------------------------------------
   Return the arguments of pair_coeff I I: numbers with all digits that restore them, and keywords with non-default values.
------------------------------------------------------------------------- */

std::string FluidModel::type_line(int i) const
{
  const TypeCoeff &c = coeffs[i];
  std::string line = fmt::format("{} {} {} {}", c.eos.rho0, c.eos.c0, c.viscosity[0],
                                 c.intrinsic ? "intrinsic" : fmt::format("{}", c.kappa));
  for (int k = 1; k < nviscosity(); k++) line += fmt::format(" {}", c.viscosity[k]);
  line += fmt::format(" {}", c.rc);
  if (c.gamma > 0.0) line += fmt::format(" gamma {}", c.gamma);
  if (c.eos.pb != 0.0) line += fmt::format(" pb {}", c.eos.pb);
  if (c.cv > 0.0) line += fmt::format(" cv {}", c.cv);
  for (const TypeKeyword &one : keywords) {
    const double *const a = c.keywords.data() + one.first;
    if (std::all_of(a, a + one.count, [](double value) {
          return value == 0.0;
        }))
      continue;
    int count = one.count;
    while (one.group && a[count - 1] == 0.0) count--;
    line += fmt::format(" {}", one.name);
    for (int k = one.marked ? 1 : 0; k < count; k++) line += fmt::format(" {}", a[k]);
  }
  return line;
}
