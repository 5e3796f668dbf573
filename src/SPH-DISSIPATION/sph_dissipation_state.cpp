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

#include "sph_dissipation_state.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "math_const.h"
#include "math_extra.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_model.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace MathConst;
using namespace SPHDissipation;

using MathConst::MY_2PI;

/* ---------------------------------------------------------------------- */

void FluidState::run(int group_in, int not_fluid_in, const std::function<double(int)> &pressure)
{
  group = group_in;
  not_fluid = not_fluid_in;
  find_full_support();
  add_up(pressure);
}

/* ----------------------------------------------------------------------
   Find the particles of full support, which contains no particle of a free surface.  At a free surface,
   R |sum_j w_j F r_ij| / c is between 1.4 and 2.4, for R of 2.5 to 6 spacings in 1 to 3 dimensions; inside it is 0 on
   lattices and below 1 if disordered.
------------------------------------------------------------------------- */

void FluidState::find_full_support()
{
  constexpr double SURFACE = 1.2;
  const int nlocal = atom->nlocal;
  const int nall = nlocal + atom->nghost;
  const Particle *const particle = engine.particle;

  std::vector<double> lopsided(3 * (std::size_t) nall, 0.0), surface(nall, 0.0), near(nall, 0.0);
  engine.visit_pairs([&](int i, int j, bigint entry) {
    const double slope = engine.slope(i, j, entry);
    for (int d = 0; d < 3; d++) {
      const double pull = slope * (particle[i].x[d] - particle[j].x[d]);
      lopsided[3 * i + d] += engine.weight(j) * pull;
      lopsided[3 * j + d] -= engine.weight(i) * pull;
    }
  });
  exchange.reverse({{lopsided.data(), 3, 3}});

  for (int i = 0; i < nlocal; i++) {
    const double *const a = &lopsided[3 * i];
    const double limit = SURFACE * engine.density[i].c / engine.constants().support;
    if (!(atom->mask[i] & not_fluid) && a[0] * a[0] + a[1] * a[1] + a[2] * a[2] > limit * limit)
      surface[i] = 1.0;
  }
  exchange.forward({{surface.data(), 1, 1}});

  engine.visit_pairs([&](int i, int j, bigint) {
    near[i] += surface[j];
    near[j] += surface[i];
  });
  exchange.reverse({{near.data(), 1, 1}});

  full.assign(nall, 0.0);
  for (int i = 0; i < nlocal; i++)
    if (surface[i] + near[i] == 0.0 && (atom->mask[i] & group) && !(atom->mask[i] & not_fluid))
      full[i] = 1.0;
  exchange.forward({{full.data(), 1, 1}});
}

/* ----------------------------------------------------------------------
   Sum up means and ranges by type and set, over all ranks.
------------------------------------------------------------------------- */

void FluidState::add_up(const std::function<double(int)> &pressure)
{
  constexpr double FAR = 1.0e300;
  const int n = (atom->ntypes + 1) * NSET;
  std::vector<Mean> my_means(n, Mean());
  std::vector<Range> my_ranges(n, {FAR, FAR});
  const double *const sum = model.choice.continuity ? Fields::of(atom)->rho_sum : atom->rho;

  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & group) || (atom->mask[i] & not_fluid)) continue;
    const int type = atom->type[i];
    if (model.coeffs[type].other) continue;
    const EosParams &eos = model.coeffs[type].eos;
    const double excess = atom->rho[i] / eos.rho0 - 1.0;
    const double p = pressure(i);
    for (int set = ALL; set <= (full[i] > 0.0 ? FULL : ALL); set++) {
      Mean &mean = my_means[type * NSET + set];
      mean.count += 1.0;
      mean.excess += excess;
      mean.excess_sq += excess * excess;
      mean.pressure += p;
      mean.sum += sum[i] / eos.rho0;
      mean.volume += atom->rmass[i] / sum[i];
      Range &range = my_ranges[type * NSET + set];
      range.smallest = std::min(range.smallest, excess);
      range.minus_largest = std::min(range.minus_largest, -excess);
    }
  }

  means.resize(n);
  ranges.resize(n);
  MPI_Allreduce(my_means.data(), means.data(), n * sizeof(Mean) / sizeof(double), MPI_DOUBLE,
                MPI_SUM, world);
  MPI_Allreduce(my_ranges.data(), ranges.data(), n * sizeof(Range) / sizeof(double), MPI_DOUBLE,
                MPI_MIN, world);
}

/* ---------------------------------------------------------------------- */

double FluidState::mean_density(int type) const
{
  const Mean &mean = means[best(type)];
  return model.coeffs[type].eos.rho0 * (1.0 + mean.excess / mean.count);
}

double FluidState::spread(int type) const
{
  const Mean &mean = means[best(type)];
  const double excess = mean.excess / mean.count;
  return sqrt(std::max(mean.excess_sq / mean.count - excess * excess, 0.0));
}

double FluidState::mean_pressure(int type) const
{
  const Mean &mean = means[best(type)];
  return mean.pressure / mean.count;
}

/* ---------------------------------------------------------------------- */

double FluidState::scale_masses(std::vector<double> &factor, int also) const
{
  std::vector<double> next(atom->ntypes + 1, 1.0);
  double largest = 0.0;
  for (int type = 1; type <= atom->ntypes; type++) {
    if (!has_type(type)) continue;
    next[type] = model.coeffs[type].eos.rho0 / mean_density(type);
    factor[type] *= next[type];
    largest = std::max(largest, fabs(next[type] - 1.0));
  }
  const Fields *const fields = Fields::of(atom);
  for (int i = 0; i < atom->nlocal + atom->nghost; i++)
    if ((atom->mask[i] & also) || ((atom->mask[i] & group) && !(atom->mask[i] & not_fluid))) {
      const double one = next[atom->type[i]];
      atom->rmass[i] *= one;
      if (i >= atom->nlocal) continue;
      for (int slot : fields->slots)
        fields->state[slot][i] = rescaled(state_info(slot).kind, fields->state[slot][i], one);
    }
  return largest;
}

/* ---------------------------------------------------------------------- */

void FluidState::report_masses(const std::vector<double> &factor,
                               const std::string &fix_style) const
{
  if (comm->me != 0) return;
  for (int type = 1; type <= atom->ntypes; type++) {
    if (!has_type(type)) continue;
    utils::logmesg(lmp, "Fix {}: masses of type {} times {:.8g} for the mean density rho0\n",
                   fix_style, type, factor[type]);
    if (!has_full_support(type))
      error->warning(FLERR,
                     "Fix {} density: all particles of type {} are near a free surface, the masses "
                     "are too large for the inside of a fluid",
                     fix_style, type);
  }
}

/* ---------------------------------------------------------------------- */

std::string FluidState::table() const
{
  std::string lines;
  for (int type = 1; type <= atom->ntypes; type++) {
    if (!has_type(type)) continue;
    if (lines.empty())
      lines = fmt::format("  {:<8} {:<11} {:<15} | {:<11} {:<11} {:<11} {:<11} | {}\n", "type",
                          "particles", "full support", "rho/rho0", "spread", "smallest", "largest",
                          "mean pressure");
    const Mean &mean = means[best(type)];
    const Range &range = ranges[best(type)];
    const double excess = mean.excess / mean.count;
    lines += fmt::format("  {:<8} {:<11.0f} {:<15.0f} | {:<11.6f} {:<11.2g} {:<11.6f} {:<11.6f} "
                         "| {:.4g}\n",
                         type, count(type, ALL), count(type, FULL), 1.0 + excess, spread(type),
                         1.0 + range.smallest, 1.0 - range.minus_largest, mean_pressure(type));
  }
  return lines;
}

/* ----------------------------------------------------------------------
   Return the largest extent of the box, in periodic directions, or of the fluid, in others.
------------------------------------------------------------------------- */

double FluidState::longest_wave() const
{
  constexpr double FAR = 1.0e300;
  double edge[6] = {FAR, FAR, FAR, FAR, FAR, FAR}, all[6];    // smallest x, -x, y, -y, z, -z
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & group) || (atom->mask[i] & not_fluid) ||
        model.coeffs[atom->type[i]].other)
      continue;
    for (int d = 0; d < 3; d++) {
      edge[2 * d] = std::min(edge[2 * d], atom->x[i][d]);
      edge[2 * d + 1] = std::min(edge[2 * d + 1], -atom->x[i][d]);
    }
  }
  MPI_Allreduce(edge, all, 6, MPI_DOUBLE, MPI_MIN, world);

  double length = 0.0;
  for (int d = 0; d < engine.constants().dim; d++)
    length =
        std::max(length, domain->periodicity[d] ? domain->prd[d] : -(all[2 * d] + all[2 * d + 1]));
  return length;
}

/* ----------------------------------------------------------------------
   Sum up d2c/dgamma2 for any shear gamma s k, with unit vectors k and s at right angles, which moves a
   neighbor at r by gamma s (k.r): -sum_j w_j [F (k.r)^2 + F'/r (k.r)^2 (s.r)^2], as sums over the
   products of components of r, xx yy zz yz xz xy.  The vorticity is that of the velocities in the friction.
------------------------------------------------------------------------- */

void LatticeStrain::run(const std::vector<double> &weight)
{
  constexpr double DQ = 1.0e-4;    // for F' by differences
  const Particle *const particle = engine.particle;
  const int *const type = atom->type;
  const int n = atom->ntypes + 1;
  std::vector<Sum> my_sums(n, Sum());
  std::vector<double> curl(3 * (std::size_t)(atom->nlocal + atom->nghost), 0.0);

  with_kernel(engine.constants().kernel, [&](auto k) {
    engine.visit_pairs([&](int i, int j, bigint entry) {
      if (weight[i] + weight[j] == 0.0) return;
      const double slope = engine.slope(i, j, entry);
      double r[3], v[3], turn[3];
      for (int d = 0; d < 3; d++) {
        r[d] = particle[i].x[d] - particle[j].x[d];
        v[d] = atom->vest[i][d] - atom->vest[j][d];
      }
      MathExtra::cross3(r, v, turn);
      for (int d = 0; d < 3; d++) {
        curl[3 * i + d] += engine.weight(j) * slope * turn[d];
        curl[3 * j + d] += engine.weight(i) * slope * turn[d];
      }
      const double product[6] = {r[0] * r[0], r[1] * r[1], r[2] * r[2],
                                 r[1] * r[2], r[0] * r[2], r[0] * r[1]};
      const double dist = sqrt(product[0] + product[1] + product[2]);
      if (dist == 0.0) return;
      const double q = dist / engine.constants().support;
      const double from = std::max(q - DQ, 0.0), to = std::min(q + DQ, 1.0);
      const double derivative = engine.constants().slope_norm * (k.slope(to) - k.slope(from)) /
          (to - from) / (engine.constants().support * dist);
      for (const int one : {i, j}) {
        const double each = weight[one] * engine.weight(i + j - one) / engine.density[one].c;
        Sum &sum = my_sums[type[one]];
        for (int a = 0; a < 6; a++) {
          sum.second[a] -= each * slope * product[a];
          for (int b = 0; b < 6; b++)
            sum.fourth[a][b] -= each * derivative * product[a] * product[b];
        }
      }
    });
    return 0;
  });
  exchange.reverse({{curl.data(), 3, 3}});
  for (int i = 0; i < atom->nlocal; i++) {
    const double by_density = weight[i] / (engine.density[i].c * engine.density[i].c);
    my_sums[type[i]].vorticity_sq += by_density * MathExtra::lensq3(&curl[3 * i]);
    my_sums[type[i]].rate_sq += by_density * engine.density[i].cdot * engine.density[i].cdot;
  }

  sums.resize(n);
  MPI_Allreduce(my_sums.data(), sums.data(), n * sizeof(Sum) / sizeof(double), MPI_DOUBLE, MPI_SUM,
                world);
}

/* ----------------------------------------------------------------------
   Search the directions with small integer components, among them the extremes of square, cubic and hexagonal lattices.
------------------------------------------------------------------------- */

double LatticeStrain::largest(int type) const
{
  constexpr int MOST = 3, TURNS = 12;
  const Sum &sum = sums[type];
  const bool flat = (engine.constants().dim == 2);
  const int most_z = flat ? 0 : MOST, turns = flat ? 1 : TURNS;
  double found = 0.0;

  for (int l = -MOST; l <= MOST; l++)
    for (int m = -MOST; m <= MOST; m++)
      for (int n = -most_z; n <= most_z; n++) {
        if (l == 0 && m == 0 && n == 0) continue;
        double k[3] = {(double) l, (double) m, (double) n}, a[3], b[3] = {0.0, 0.0, 1.0};
        if (l == 0 && m == 0) std::swap(b[0], b[2]);
        MathExtra::norm3(k);
        MathExtra::cross3(k, b, a);
        MathExtra::norm3(a);
        MathExtra::cross3(k, a, b);
        const double square[6] = {k[0] * k[0],       k[1] * k[1],       k[2] * k[2],
                                  2.0 * k[1] * k[2], 2.0 * k[0] * k[2], 2.0 * k[0] * k[1]};
        for (int turn = 0; turn < turns; turn++) {
          const double angle = MY_PI * turn / TURNS;
          double s[3];
          for (int d = 0; d < 3; d++) s[d] = cos(angle) * a[d] + sin(angle) * b[d];
          const double mixed[6] = {k[0] * s[0],
                                   k[1] * s[1],
                                   k[2] * s[2],
                                   k[1] * s[2] + k[2] * s[1],
                                   k[0] * s[2] + k[2] * s[0],
                                   k[0] * s[1] + k[1] * s[0]};
          double change = 0.0;
          for (int c = 0; c < 6; c++) {
            change += square[c] * sum.second[c];
            for (int d = 0; d < 6; d++) change += mixed[c] * sum.fourth[c][d] * mixed[d];
          }
          if (fabs(change) > fabs(found)) found = change;
        }
      }
  return found;
}

/* ---------------------------------------------------------------------- */

bool FluidState::is_far_off(int type, double density) const
{
  constexpr double FAR_OFF = 0.1;    // relative difference from rho0
  constexpr double SPARSE = 0.01;    // density over rho0, where no particle has a full support
  const double rho0 = model.coeffs[type].eos.rho0;
  const double least = has_full_support(type) ? 1.0 - FAR_OFF : SPARSE;
  return density < least * rho0 || density > (1.0 + FAR_OFF) * rho0;
}

/* ---------------------------------------------------------------------- */

void FluidState::warn_of_density(const std::string &fix_style) const
{
  if (comm->me != 0) return;
  for (int type = 1; type <= atom->ntypes; type++) {
    if (!has_type(type)) continue;
    const double rho = mean_density(type), rho0 = model.coeffs[type].eos.rho0;
    if (model.choice.continuity) {
      const Mean &mean = means[best(type)];
      const double by_masses = rho0 * mean.sum / mean.count;
      if (is_far_off(type, by_masses))
        error->warning(FLERR,
                       "The masses of type {} have the mean density {:g}, which is far from its "
                       "rho0 {:g}: the mass of a particle should be rho0 times its volume, also "
                       "with density continuity; use set mass",
                       type, by_masses, rho0);
      if (is_far_off(type, rho))
        error->warning(
            FLERR, "The mean density {:g} of type {} is far from its rho0 {:g}; use set sph/rho",
            rho, type, rho0);
    } else if (is_far_off(type, rho))
      error->warning(FLERR,
                     "The mean density {:g} of type {} is far from its rho0 {:g}: the mass of a "
                     "particle should be rho0 times its volume; use the set command, or keyword "
                     "density of fix {}",
                     rho, type, rho0, fix_style);
  }
}

/* ----------------------------------------------------------------------
   Compare the support radius R with the root of the volume, the distance of the particles.  A sum over few neighbors finds
   too small a volume: their ratio is 1.3 to 1.9 at a support of 1.2 distances, by the kernel, and 2.0 to 2.1 at two.
------------------------------------------------------------------------- */

void FluidState::warn_of_support(const std::string &style) const
{
  constexpr double FEWEST = 2.0;    // distances of particles
  if (comm->me != 0) return;
  const double support = engine.constants().support;
  const int dim = engine.constants().dim;
  for (int type = 1; type <= atom->ntypes; type++) {
    if (!has_type(type) || count(type, ALL) <= 2.0 * dim) continue;
    const Mean &mean = means[best(type)];
    if (support < FEWEST * pow(mean.volume / mean.count, 1.0 / dim))
      error->warning(FLERR,
                     "Pair style {}: the support radius {:g} is less than {:g} distances of the "
                     "particles of type {}, which thus have too few neighbors; use an rc of three "
                     "to four particle distances",
                     style, support, FEWEST, type);
  }
}

/* ----------------------------------------------------------------------
   Warn of a shear elasticity G of the arrangement.  A shear wave of wave number k with the viscosity mu has the rates
   g = nu k^2/2 +- sqrt[(nu k^2/2)^2 - G k^2/rho]: for a small G, mu appears to be too small by the part G rho/(mu k)^2; from
   1/4 on, the wave oscillates.  If G < 0, the wave grows in the end, and short waves grow from rounding errors, at the rate
   |G|/mu at most.  The arrangement yields to waves of a vorticity beyond k sqrt(|G|/rho), whose strains exceed 1; sound has
   no vorticity.  Without elasticity, a flow that is driven from rest has most of its velocity after the time 1/(nu k^2).
------------------------------------------------------------------------- */

double FluidState::warn_of_elasticity(const std::string &fix_style, double moving)
{
  constexpr double REGULAR = 0.001;         // spread of the density; disordered particles yield
  constexpr double ELASTIC_PART = 0.25;     // missing part of the viscosity
  constexpr double FEW = 10.0;              // fewer particles may have equal densities by chance
  constexpr double SHEARED = 0.1;           // vorticity over the rate of density
  constexpr double STRAINED = 0.001;        // vorticity times the time of a driven flow
  constexpr double FROM_ROUNDOFF = 20.0;    // ln of the growth of a wave that is no longer small

  // with density continuity, the pressure belongs to the flow, and equal densities are no regular arrangement

  if (engine.constants().dim == 1 || model.choice.continuity) return 0.0;
  LatticeStrain strain(lmp, engine, exchange);
  strain.run(full);
  const double k = MY_2PI / longest_wave();

  int worst = 0;    // type with the largest part
  double largest_part = ELASTIC_PART, elasticity_of_worst = 0.0, wait = 0.0;
  for (int type = 1; type <= atom->ntypes; type++) {
    if (!has_type(type)) continue;
    const double rho = mean_density(type), mu = model.viscosity(0, type, type);
    if (is_far_off(type, rho) || count(type, FULL) < FEW || spread(type) > REGULAR || mu == 0.0)
      continue;
    const double elasticity = mean_pressure(type) * strain.largest(type) / count(type, FULL);
    const double part = fabs(elasticity) * rho / (mu * mu * k * k);
    const double vorticity_sq = strain.vorticity_squared(type) / count(type, FULL);
    const double rate_sq = strain.rate_squared(type) / count(type, FULL);
    const double growth = std::min(
        fabs(elasticity) / mu, MY_2PI * sqrt(fabs(elasticity) / rho) / engine.constants().support);
    const bool rearranges =
        (elasticity < 0.0 && growth * update->dt * update->nsteps > FROM_ROUNDOFF);
    const bool strained = (moving == 0.0 || vorticity_sq * moving * moving > STRAINED * STRAINED);
    const bool sheared = (strained && vorticity_sq > SHEARED * SHEARED * rate_sq);
    if (part < ELASTIC_PART || vorticity_sq > k * k * fabs(elasticity) / rho) continue;
    if (!sheared && !rearranges) {
      wait = std::max(wait, rho / (mu * k * k));
      continue;
    }
    if (part < largest_part) continue;
    worst = type;
    largest_part = part;
    elasticity_of_worst = elasticity;
  }
  if (!worst) return wait;
  if (comm->me == 0)
    error->warning(FLERR,
                   "The mean pressure {:.3g} of type {} gives its arrangement of particles a shear "
                   "elasticity of {:.2g}, which exceeds the viscosity: shear waves as long as the "
                   "box {} instead of decaying. Use keyword density of fix {} and no background "
                   "pressure or, for large strains, its keyword shift",
                   mean_pressure(worst), worst, elasticity_of_worst,
                   elasticity_of_worst < 0.0 ? "grow" : "oscillate", fix_style);
  return 0.0;
}
