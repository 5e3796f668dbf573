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

#include "compute_sph_spectrum.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "group.h"
#include "math_extra.h"
#include "memory.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_keywords.h"
#include "sph_dissipation_model.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// Spectra of a periodic flow.
//
// A velocity field u = sum_k u_k exp(i k.x) is the sum of a solenoidal part, u_k at right angles to k, and a dilatational
// part, u_k along k (Helmholtz); a uniform flow, k = 0, counts as solenoidal.  The mean of the product of two real fields is
// the sum of a_k b_k^* over all modes (Parseval).  Notation: P. Sagaut, C. Cambon, Homogeneous Turbulence Dynamics
// (Springer, 2018).

using Amplitude = std::complex<double>;

// Return the wave number of mode i of n points along a length, which has -n/2 to (n-1)/2 wave lengths

static double wave_number(int i, int n, double length)
{
  return 2.0 * KERNEL_PI / length * (i <= (n - 1) / 2 ? i : i - n);
}

// One mode of a velocity field: energies |u|^2/2 of both parts, squares of curl and divergence

struct ModeEnergies {
  double solenoidal, dilatational, curl2, div2;
};

static ModeEnergies split(const double *k, const Amplitude *u)
{
  const double ksq = k[0] * k[0] + k[1] * k[1] + k[2] * k[2];
  if (ksq == 0.0)
    return {0.5 * (std::norm(u[0]) + std::norm(u[1]) + std::norm(u[2])), 0.0, 0.0, 0.0};
  const double div2 = std::norm(k[0] * u[0] + k[1] * u[1] + k[2] * u[2]);
  const double curl2 = std::norm(k[1] * u[2] - k[2] * u[1]) + std::norm(k[2] * u[0] - k[0] * u[2]) +
      std::norm(k[0] * u[1] - k[1] * u[0]);
  return {0.5 * curl2 / ksq, 0.5 * div2 / ksq, curl2, div2};
}

// Return the coefficient of <div^2>, also called lambda + 2 mu, in the power per volume that a Newtonian fluid of uniform
// viscosities dissipates in a periodic box, mu <curl^2> + (kappa + 2 mu (1 - 1/n)) <div^2>.  The power is exact, since the
// cross terms of the strain rates are divergences.

static double longitudinal_viscosity(double mu, double kappa, int n)
{
  return kappa + 2.0 * mu * (1.0 - 1.0 / n);
}

// Return the factor of the squared amplitude of a mode that undoes the smoothing by the kernel, 1/W_k^2; at most 4, where
// less than half of the amplitude is left.

static double deconvolution(Kernel kernel, int n, double k, double support)
{
  const double transform = kernel_transform(kernel, n, k, support);
  return 1.0 / (transform > 0.5 ? transform * transform : 0.25);
}

// Columns of the array; elements of the vector

enum { WAVE, MODES, SOLENOIDAL, DILATATIONAL, ENSTROPHY, DENSITY, KINETIC, SPIN, NCOLUMN };
enum {
  SUM_SOLENOIDAL,
  SUM_DILATATIONAL,
  CURL2,
  DIV2,
  POWER_CURL,
  POWER_DIV,
  DENSITY2,
  SUM_KINETIC,
  SUM_SPIN,
  NTOTAL
};

// Fields of the modes: velocity, density, velocity times the root of the density, spin

enum { U = 0, RHO = 3, ROOT = 4, OMEGA = 7, NFIELD = 10 };

/* ---------------------------------------------------------------------- */

ComputeSPHSpectrum::ComputeSPHSpectrum(LAMMPS *lmp, int narg, char **arg) :
    GridCompute(lmp, narg, arg), micropolar(Fields::with_spins(atom))
{
  if (!FourierGrid::available())
    error->all(FLERR,
               "Compute {} needs the FFTs of the KSPACE package: build LAMMPS with it, then "
               "SPH-DISSIPATION",
               style);

  for (Keywords key(lmp, fmt::format("Compute {}", style), 6, narg, arg); key.next();) {
    read_order(key);
    if (key.is("deconvolve")) deconvolve = utils::logical(FLERR, key.word(), false, lmp);
    if (key.is("shells")) {
      nshell = key.whole_number();
      key.demand(nshell >= 1, "at least 1");
    }
  }

  for (const char *name : {"vx", "vy", "vz", "rho"}) add_value(name);
  if (micropolar)
    for (const char *name : {"omegax", "omegay", "omegaz"}) add_value(name);

  vector_flag = array_flag = 1;
  extvector = extarray = 0;
  size_vector = NTOTAL;
  size_array_rows = 1 + (nshell ? nshell : last_shell());
  size_array_cols = NCOLUMN;
  vector = new double[NTOTAL];
  memory->create(array, size_array_rows, size_array_cols, "sph/spectrum:array");
  fourier = std::make_unique<FourierGrid>(lmp, *grid);
}

/* ---------------------------------------------------------------------- */

ComputeSPHSpectrum::~ComputeSPHSpectrum()
{
  delete[] vector;
  memory->destroy(array);
}

/* ---------------------------------------------------------------------- */

void ComputeSPHSpectrum::init()
{
  GridCompute::init();
  if (domain->nonperiodic)
    error->all(FLERR, "Compute {} needs a box that is periodic in all directions", style);

  // the grid does not resolve waves shorter than two of its spacings

  double shortest = KERNEL_PI * count[0] / domain->prd[0];
  for (int d = 1; d < domain->dimension; d++)
    shortest = std::min(shortest, KERNEL_PI * count[d] / domain->prd[d]);
  const int most = static_cast<int>(shortest / shell_width() * (1.0 + 1.0e-12));
  if (nshell > most)
    error->all(FLERR, "Compute {}: the grid is too coarse for {} shells, it has {}", style, nshell,
               most);

  const double points = static_cast<double>(count[0]) * count[1] * count[2];
  const bigint particles = group->count(igroup);
  if (points > static_cast<double>(particles) && !checked && comm->me == 0)
    error->warning(
        FLERR,
        "Compute {}: the grid has {:.0f} points for {} particles: its shortest waves are "
        "interpolated, not simulated",
        style, points, particles);
  checked = true;
}

/* ---------------------------------------------------------------------- */

void ComputeSPHSpectrum::reset_grid()
{
  GridCompute::reset_grid();
  fourier = std::make_unique<FourierGrid>(lmp, *grid);
  raise.clear();
}

/* ----------------------------------------------------------------------
   Return the width of a shell: shell s has the wave numbers from (s - 1/2) to (s + 1/2) widths.
------------------------------------------------------------------------- */

double ComputeSPHSpectrum::shell_width() const
{
  double longest = domain->prd[0];
  for (int d = 1; d < domain->dimension; d++) longest = std::max(longest, domain->prd[d]);
  return 2.0 * KERNEL_PI / longest;
}

/* ---------------------------------------------------------------------- */

int ComputeSPHSpectrum::last_shell() const
{
  double ksq = 0.0;
  for (int d = 0; d < domain->dimension; d++) {
    const double k = wave_number(count[d] / 2, count[d], domain->prd[d]);
    ksq += k * k;
  }
  return static_cast<int>(std::sqrt(ksq) / shell_width() + 0.5);
}

/* ----------------------------------------------------------------------
   Calculate vector and array at once.
------------------------------------------------------------------------- */

void ComputeSPHSpectrum::compute_vector()
{
  invoked_vector = invoked_array = update->ntimestep;
  invoked_flag |= INVOKED_VECTOR | INVOKED_ARRAY;

  const bigint empty = map();
  if (empty)
    error->all(FLERR, "Compute {}: {} points of the grid have no particle in reach", style, empty);
  transform_fields();
  if (deconvolve) set_raise();
  sum_modes();
  set_dissipation();
}

/* ---------------------------------------------------------------------- */

void ComputeSPHSpectrum::transform_fields()
{
  const bigint npoint = grid->npoint();
  modes.resize(micropolar ? NFIELD : OMEGA);
  for (auto &mode : modes) mode.resize(npoint);
  for (int k = 0; k <= RHO; k++) fourier->transform(grid->field(k), modes[k].data());
  if (micropolar)
    for (int d = 0; d < 3; d++)
      fourier->transform(grid->field(RHO + 1 + d), modes[OMEGA + d].data());

  // energy per volume is the square of sqrt(rho/2) u

  std::vector<double> product(npoint);
  const double *const rho = grid->field(RHO);
  for (int d = 0; d < 3; d++) {
    const double *const u = grid->field(U + d);
    for (bigint m = 0; m < npoint; m++) product[m] = std::sqrt(std::max(rho[m], 0.0)) * u[m];
    fourier->transform(product.data(), modes[ROOT + d].data());
  }
}

/* ----------------------------------------------------------------------
   Call function(k, k^2) for the wave vectors of the modes of this processor, in their order.
------------------------------------------------------------------------- */

template <class Function> void ComputeSPHSpectrum::for_modes(Function &&function) const
{
  for (int iz = grid->lo[2]; iz <= grid->hi[2]; iz++)
    for (int iy = grid->lo[1]; iy <= grid->hi[1]; iy++)
      for (int ix = grid->lo[0]; ix <= grid->hi[0]; ix++) {
        const double k[3] = {wave_number(ix, count[0], domain->prd[0]),
                             wave_number(iy, count[1], domain->prd[1]),
                             wave_number(iz, count[2], domain->prd[2])};
        function(k, MathExtra::lensq3(k));
      }
}

/* ---------------------------------------------------------------------- */

void ComputeSPHSpectrum::set_raise()
{
  const double *const prd = domain->prd;
  const double support = fluid()->support_radius();
  const Kernel kernel = fluid()->model->choice.kernel;
  const std::vector<double> made_for = {prd[0], prd[1], prd[2], support,
                                        static_cast<double>(kernel)};
  if (!raise.empty() && made_for == raised_for) return;
  raised_for = made_for;
  raise.clear();
  raise.reserve(grid->npoint());
  for_modes([&](const double *, double ksq) {
    raise.push_back(deconvolution(kernel, domain->dimension, std::sqrt(ksq), support));
  });
}

/* ----------------------------------------------------------------------
   Sum up the totals, and each shell over its width.
------------------------------------------------------------------------- */

void ComputeSPHSpectrum::sum_modes()
{
  const double width = shell_width();
  std::vector<double> own(NTOTAL + size_array_rows * NCOLUMN, 0.0), all(own.size());
  double *const total = own.data();
  auto square = [this](int field, bigint m) {
    return std::norm(modes[field][m]) + std::norm(modes[field + 1][m]) +
        std::norm(modes[field + 2][m]);
  };

  bigint m = 0;
  for_modes([&](const double *k, double ksq) {
    const Amplitude u[3] = {modes[U][m], modes[U + 1][m], modes[U + 2][m]};
    const double factor = deconvolve ? raise[m] : 1.0;
    const ModeEnergies mode = split(k, u);
    double column[NCOLUMN];
    column[MODES] = 1.0;
    column[SOLENOIDAL] = factor * mode.solenoidal;
    column[DILATATIONAL] = factor * mode.dilatational;
    column[ENSTROPHY] = 0.5 * factor * mode.curl2;
    column[DENSITY] = factor * std::norm(modes[RHO][m]);
    column[KINETIC] = 0.5 * factor * square(ROOT, m);
    column[SPIN] = micropolar ? 0.5 * factor * square(OMEGA, m) : 0.0;

    total[SUM_KINETIC] += column[KINETIC];
    total[SUM_SPIN] += column[SPIN];
    if (ksq > 0.0) {    // all but the means
      total[SUM_SOLENOIDAL] += column[SOLENOIDAL];
      total[SUM_DILATATIONAL] += column[DILATATIONAL];
      total[CURL2] += factor * mode.curl2;
      total[DIV2] += factor * mode.div2;
      total[DENSITY2] += column[DENSITY];
    }

    // all shells; in a box that has changed, modes beyond the last shell belong to the last one

    int shell = static_cast<int>(std::sqrt(ksq) / width + 0.5);
    if (!nshell) shell = std::min(shell, size_array_rows - 1);
    m++;
    if (shell >= size_array_rows) return;
    double *const row = &own[NTOTAL + shell * NCOLUMN];
    for (int c = MODES; c < NCOLUMN; c++) row[c] += column[c];
  });

  MPI_Allreduce(own.data(), all.data(), static_cast<int>(own.size()), MPI_DOUBLE, MPI_SUM, world);
  std::copy(all.begin(), all.begin() + NTOTAL, vector);
  for (int shell = 0; shell < size_array_rows; shell++) {
    const double *const row = &all[NTOTAL + shell * NCOLUMN];
    array[shell][WAVE] = shell * width;
    array[shell][MODES] = row[MODES];
    for (int c = SOLENOIDAL; c < NCOLUMN; c++) array[shell][c] = row[c] / width;
  }
}

/* ---------------------------------------------------------------------- */

void ComputeSPHSpectrum::set_dissipation()
{
  vector[POWER_CURL] = vector[POWER_DIV] = 0.0;
  const Fluid *const mapped = fluid();
  if (mapped->model->has_rheology()) return;    // each particle has its own viscosity

  // largest and smallest values, of all particles of all processors

  double own[4] = {-1.0, -1.0, -HUGE_VAL, -HUGE_VAL}, most[4];
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_mapped(mapped, i)) continue;
    const double mu = mapped->model->viscosity(0, atom->type[i], atom->type[i]);
    const double kappa = mapped->model->bulk_viscosity(atom->type[i]);
    own[0] = std::max(own[0], mu);
    own[1] = std::max(own[1], kappa);
    own[2] = std::max(own[2], -mu);
    own[3] = std::max(own[3], -kappa);
  }
  MPI_Allreduce(own, most, 4, MPI_DOUBLE, MPI_MAX, world);
  if (most[0] != -most[2] || most[1] != -most[3])
    error->all(FLERR,
               "Compute {} needs one viscosity, but mu is from {} to {} and kappa from {} to {}",
               style, -most[2], most[0], -most[3], most[1]);
  vector[POWER_CURL] = most[0] * vector[CURL2];
  vector[POWER_DIV] = longitudinal_viscosity(most[0], most[1], domain->dimension) * vector[DIV2];
}

/* ---------------------------------------------------------------------- */

double ComputeSPHSpectrum::memory_usage()
{
  return GridCompute::memory_usage() + fourier->memory_usage() +
      (double) modes.size() * grid->npoint() * sizeof(Amplitude) + raise.size() * sizeof(double);
}
