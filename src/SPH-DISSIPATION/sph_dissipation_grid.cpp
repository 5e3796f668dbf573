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

#include "sph_dissipation_grid.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "grid2d.h"
#include "grid3d.h"
#include "memory.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_keywords.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_value.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

ParticleGrid::ParticleGrid(LAMMPS *lmp, const int *count_) :
    Pointers(lmp), count{count_[0], count_[1], count_[2]}, dim(domain->dimension)
{
  if (dim == 2) {
    grid2d.reset(new Grid2d(lmp, world, count[0], count[1]));
    grid2d->setup_grid(lo[0], hi[0], lo[1], hi[1], ghost_lo[0], ghost_hi[0], ghost_lo[1],
                       ghost_hi[1]);
  } else {
    grid3d.reset(new Grid3d(lmp, world, count[0], count[1], count[2]));
    grid3d->setup_grid(lo[0], hi[0], lo[1], hi[1], lo[2], hi[2], ghost_lo[0], ghost_hi[0],
                       ghost_lo[1], ghost_hi[1], ghost_lo[2], ghost_hi[2]);
  }
  for (int d = 0; d < 3; d++) points *= hi[d] - lo[d] + 1;
}

/* ---------------------------------------------------------------------- */

ParticleGrid::~ParticleGrid() = default;

/* ---------------------------------------------------------------------- */

bool ParticleGrid::fits() const
{
  const ParticleGrid now(lmp, count);
  return std::equal(lo, lo + 3, now.lo) && std::equal(hi, hi + 3, now.hi);
}

/* ---------------------------------------------------------------------- */

bigint ParticleGrid::map(const Smoothing &smoothing, double **values, int nfield)
{
  for (int d = 0; d < 3; d++) {
    spacing[d] = domain->prd[d] / count[d];
    origin[d] = domain->boxlo[d] + 0.5 * spacing[d];
  }

  // moments of each point: 1 and, if linear, r and r r

  const int nmoment = smoothing.linear ? 1 + dim + dim * (dim + 1) / 2 : 1;
  moments.assign(nmoment, std::vector<double>(points, 0.0));
  fields.assign(nfield, std::vector<double>(points, 0.0));
  weight.resize(count[0]);
  offset.resize(count[0]);

  bigint empty = 0;
  with_kernel(smoothing.kernel, [&](auto shape) {
    sum_moments<decltype(shape)>(smoothing, values);
    empty = solve(smoothing.linear);
    sum_fields<decltype(shape)>(smoothing, values, nfield);
  });
  return over_all(world, empty, MPI_SUM);
}

/* ----------------------------------------------------------------------
   Call function(index of the first point, number of points, r) for each row of owned points around a place; r = first point
   - place.
------------------------------------------------------------------------- */

template <class Function>
void ParticleGrid::near_rows(const double *place, double radius, Function &&function)
{
  double at[3] = {};    // in spacings
  int from[3] = {}, to[3] = {};
  for (int d = 0; d < dim; d++) {
    at[d] = (place[d] - origin[d]) / spacing[d];
    const double reach = radius / spacing[d];
    if (at[d] + reach < lo[d] || at[d] - reach > hi[d]) return;
    from[d] = std::max(lo[d], static_cast<int>(std::ceil(at[d] - reach)));
    to[d] = std::min(hi[d], static_cast<int>(std::floor(at[d] + reach)));
  }

  const int nx = hi[0] - lo[0] + 1, ny = hi[1] - lo[1] + 1;
  for (int iz = from[2]; iz <= to[2]; iz++)
    for (int iy = from[1]; iy <= to[1]; iy++) {
      double r[3] = {0.0, (iy - at[1]) * spacing[1], (dim == 3) ? (iz - at[2]) * spacing[2] : 0.0};
      const double rest = radius * radius - r[1] * r[1] - r[2] * r[2];
      if (rest <= 0.0) continue;
      const double half = std::sqrt(rest) / spacing[0];
      const int first = std::max(from[0], static_cast<int>(std::ceil(at[0] - half)));
      const int last = std::min(to[0], static_cast<int>(std::floor(at[0] + half)));
      if (last < first) continue;
      r[0] = (first - at[0]) * spacing[0];
      const bigint row = (static_cast<bigint>(iz - lo[2]) * ny + iy - lo[1]) * nx;
      function(row + first - lo[0], last - first + 1, r);
    }
}

/* ----------------------------------------------------------------------
   Set weight to V W (but for the norm of the kernel, which drops out) of the points of a row, and offset to their distances
   along it; lengths in support radii.
------------------------------------------------------------------------- */

template <class KernelShape>
void ParticleGrid::weigh_row(const Smoothing &smoothing, double volume, double first,
                             double rsq_across, int n)
{
  const double scale = 1.0 / smoothing.support;
  const double step = spacing[0] * scale;
  double *const w = weight.data(), *const x = offset.data();
  for (int m = 0; m < n; m++) {
    x[m] = first + m * step;
    const double q = std::sqrt(x[m] * x[m] + rsq_across);
    w[m] = volume * KernelShape::shape(q < 1.0 ? q : 1.0);
  }
}

/* ----------------------------------------------------------------------
   Call function(i, point, n, ry, rz) for each particle i and row of n points in its support, with weight and offset set;
   r = particle - point in support radii, rx = -offset.
------------------------------------------------------------------------- */

template <class KernelShape, class Function>
void ParticleGrid::weigh_rows(const Smoothing &smoothing, double **values, Function &&function)
{
  double **x = atom->x;
  const int nall = atom->nlocal + atom->nghost;
  const double scale = 1.0 / smoothing.support;
  for (int i = 0; i < nall; i++) {
    if (!(values[i][0] > 0.0)) continue;
    near_rows(x[i], smoothing.support, [&](bigint point, int n, const double *r) {
      const double ry = -r[1] * scale, rz = -r[2] * scale;
      weigh_row<KernelShape>(smoothing, values[i][0], r[0] * scale, ry * ry + rz * rz, n);
      function(i, point, n, ry, rz);
    });
  }
}

/* ----------------------------------------------------------------------
   Sum the moments 1, r, r r over the particles around each point, r = particle - point in support radii.
------------------------------------------------------------------------- */

template <class KernelShape>
void ParticleGrid::sum_moments(const Smoothing &smoothing, double **values)
{
  weigh_rows<KernelShape>(smoothing, values, [&](int, bigint point, int n, double ry, double rz) {
    const double *const w = weight.data(), *const away = offset.data();
    double *const one = moments[0].data() + point;
    for (int m = 0; m < n; m++) one[m] += w[m];
    if (!smoothing.linear) return;

    const auto add = [&](int k, int power, double across) {    // rx^power times across
      double *const sum = moments[k].data() + point;
      for (int m = 0; m < n; m++) {
        const double rx = -away[m];
        sum[m] += w[m] * (across * (power == 0 ? 1.0 : power == 1 ? rx : rx * rx));
      }
    };
    const double across[3] = {1.0, ry, rz};
    for (int d = 0, k = 1 + 2 * dim; d < dim; d++) {
      add(1 + d, d == 0 ? 1 : 0, across[d]);
      add(1 + dim + d, d == 0 ? 2 : 0, across[d] * across[d]);
      for (int e = d + 1; e < dim; e++, k++) add(k, d == 0 ? 1 : 0, across[d] * across[e]);
    }
  });
}

/* ----------------------------------------------------------------------
   Replace the moments of each point by the coefficients a of the weights V W (a_0 + a.r) of its particles; return the number
   of points without particles.  With the mean distance b of the particles and their covariance C: a = -C^-1 b and
   a_0 = 1 + b C^-1 b, over the sum of V W.
------------------------------------------------------------------------- */

bigint ParticleGrid::solve(bool linear)
{
  constexpr double FLAT = 1.0e-6;    // particles on a line or plane, or a single one: only the mean
  constexpr double FAR = 4.0;        // outside of them, by two standard deviations: only the mean
  bigint empty = 0;
  for (bigint point = 0; point < points; point++) {
    const double sum = moments[0][point];
    if (!(sum > 0.0)) {
      empty++;
      continue;
    }
    moments[0][point] = 1.0 / sum;
    if (!linear) continue;

    double b[3] = {}, c[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    double trace = 0.0;
    for (int d = 0; d < dim; d++) b[d] = moments[1 + d][point] / sum;
    for (int d = 0; d < dim; d++) {
      c[d][d] = moments[1 + dim + d][point] / sum - b[d] * b[d];
      trace += c[d][d];
    }
    for (int d = 0, k = 1 + 2 * dim; d < dim; d++)
      for (int e = d + 1; e < dim; e++, k++)
        c[d][e] = c[e][d] = moments[k][point] / sum - b[d] * b[e];

    double cofactor[3][3];
    for (int d = 0; d < 3; d++)
      for (int e = 0; e < 3; e++) {
        const int d1 = (d + 1) % 3, d2 = (d + 2) % 3, e1 = (e + 1) % 3, e2 = (e + 2) % 3;
        cofactor[d][e] = c[d1][e1] * c[d2][e2] - c[d1][e2] * c[d2][e1];
      }
    const double det =
        c[0][0] * cofactor[0][0] + c[0][1] * cofactor[0][1] + c[0][2] * cofactor[0][2];
    double a[3] = {}, bcb = 0.0;
    if (trace > FLAT && det > FLAT * whole_power(trace / dim, dim))
      for (int d = 0; d < dim; d++) {
        for (int e = 0; e < dim; e++) a[d] -= cofactor[d][e] * b[e] / det;
        bcb -= a[d] * b[d];
      }
    const double share = (bcb < FAR) ? 1.0 : 0.0;
    for (int d = 0; d < dim; d++) moments[1 + d][point] = share * a[d] / sum;
    moments[0][point] += share * bcb / sum;
  }
  return empty;
}

/* ---------------------------------------------------------------------- */

template <class KernelShape>
void ParticleGrid::sum_fields(const Smoothing &smoothing, double **values, int nfield)
{
  weigh_rows<KernelShape>(smoothing, values, [&](int i, bigint point, int n, double ry, double rz) {
    double *const w = weight.data();
    const double *const rx = offset.data();
    const double *const a0 = moments[0].data() + point;
    if (smoothing.linear) {
      const double *const ax = moments[1].data() + point, *const ay = moments[2].data() + point;
      const double *const az = moments[dim].data() + point;    // in 2d times rz = 0
      for (int m = 0; m < n; m++) w[m] *= a0[m] - ax[m] * rx[m] + ay[m] * ry + az[m] * rz;
    } else
      for (int m = 0; m < n; m++) w[m] *= a0[m];
    for (int k = 0; k < nfield; k++) {
      double *const sum = fields[k].data() + point;
      const double value = values[i][1 + k];
      for (int m = 0; m < n; m++) sum[m] += w[m] * value;
    }
  });
}

/* ---------------------------------------------------------------------- */

GridCompute::GridCompute(LAMMPS *lmp, int narg, char **arg) : Compute(lmp, narg, arg)
{
  if (!domain->box_exist)
    error->all(FLERR, "Compute {} requires a simulation box, which comes later", style);
  demand_words(lmp, fmt::format("compute {}", style), narg,
               fmt::format("ID group-ID {} Nx Ny Nz", style));
  for (int d = 0; d < 3; d++) {
    count[d] = utils::inumeric(FLERR, arg[3 + d], false, lmp);
    if (count[d] < 1)
      error->all(FLERR, "Compute {}: the grid must have at least one point per direction", style);
  }
  if (domain->dimension == 2 && count[2] != 1)
    error->all(FLERR, "Compute {}: Nz must be 1 in 2d", style);
  if (!Fields::of(atom))
    error->all(FLERR, "Compute {} requires atom style sph/bulk or sph/micropolar", style);

  pergrid_flag = 1;    // asks for reset_grid() when sub-domains change in a run
  comm_forward = 1;
  grid.reset(new ParticleGrid(lmp, count));
}

/* ---------------------------------------------------------------------- */

GridCompute::~GridCompute()
{
  memory->destroy(values);
}

/* ----------------------------------------------------------------------
   Make a new grid if the sub-domains have changed: replicate does not call reset_grid().
------------------------------------------------------------------------- */

void GridCompute::init()
{
  if (!over_all<int>(world, grid->fits(), MPI_MIN)) reset_grid();

  if (domain->triclinic)
    error->all(FLERR, "Compute {} needs an orthogonal box, not a triclinic one", style);
  if (fluid()->dimension() != domain->dimension)
    error->all(FLERR, "Compute {} needs a kernel of the dimension of the simulation, not dim {}",
               style, fluid()->dimension());
}

/* ----------------------------------------------------------------------
   Return the fluid of the present pair style, which may have replaced another one.
------------------------------------------------------------------------- */

Fluid *GridCompute::fluid() const
{
  return find_fluid(lmp, fmt::format("Compute {}", style));
}

/* ----------------------------------------------------------------------
   Make a new grid, after a change of the sub-domains.
------------------------------------------------------------------------- */

void GridCompute::reset_grid()
{
  grid.reset(new ParticleGrid(lmp, count));
}

/* ---------------------------------------------------------------------- */

template <int DIM> static double velocity(const Atom *atom, int i)
{
  return atom->v[i][DIM];
}

template <int DIM> static double spin(const Atom *atom, int i)
{
  return atom->omega[i][DIM];
}

static double density(const Atom *atom, int i)
{
  return atom->rho[i];
}

static double energy(const Atom *atom, int i)
{
  return atom->esph[i] / atom->vfrac[i];
}

bool GridCompute::add_value(const std::string &name)
{
  static const struct {
    const char *name;
    Value getter;
    bool spin;
  } KNOWN[] = {
      {"vx", velocity<0>, false}, {"vy", velocity<1>, false}, {"vz", velocity<2>, false},
      {"rho", density, false},    {"esph", energy, false},    {"omegax", spin<0>, true},
      {"omegay", spin<1>, true},  {"omegaz", spin<2>, true},
  };
  for (const auto &value : KNOWN) {
    if (Fields::field_name(name) != value.name) continue;
    if (value.spin && !Fields::with_spins(atom))
      error->all(FLERR, "Compute {} {} requires atom style sph/micropolar", style, name);
    names.push_back(name);
    getters.push_back(value.getter);
    comm_forward = 1 + nvalue();
    return true;
  }
  return false;
}

/* ---------------------------------------------------------------------- */

void GridCompute::read_order(Keywords &key)
{
  if (key.is("order")) linear = (key.choice({"0", "1"}) == 1);
}

/* ---------------------------------------------------------------------- */

bool GridCompute::is_mapped(const Fluid *mapped, int i) const
{
  return (atom->mask[i] & groupbit) && mapped->has_type(atom->type[i]) && !mapped->is_boundary(i);
}

/* ---------------------------------------------------------------------- */

bigint GridCompute::map()
{
  const Fluid *const mapped = fluid();
  if (!mapped->has_forces())
    error->all(FLERR, "Compute {} needs the volumes of the present particles: use run 0 first",
               style);

  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->destroy(values);
    memory->create(values, nmax, comm_forward, "sph/grid:values");
  }
  for (int i = 0; i < atom->nlocal; i++) {
    values[i][0] = is_mapped(mapped, i) ? atom->vfrac[i] : 0.0;
    for (int k = 0; k < nvalue(); k++) values[i][1 + k] = getters[k](atom, i);
  }

  // a fix may have changed the box at the end of the step, and with it the places of owned particles

  if (domain->box_change) comm->forward_comm();
  comm->forward_comm(this);

  return grid->map({mapped->model->choice.kernel, mapped->support_radius(), linear}, values,
                   nvalue());
}

/* ---------------------------------------------------------------------- */

int GridCompute::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  int m = 0;
  for (int i = 0; i < n; i++)
    for (int k = 0; k < comm_forward; k++) buf[m++] = values[list[i]][k];
  return m;
}

/* ---------------------------------------------------------------------- */

void GridCompute::unpack_forward_comm(int n, int nfirst, double *buf)
{
  int m = 0;
  for (int i = nfirst; i < nfirst + n; i++)
    for (int k = 0; k < comm_forward; k++) values[i][k] = buf[m++];
}
