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

#include "sph_dissipation_wall_checks.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "group.h"
#include "lammps.h"
#include "math_extra.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_hybrid.h"
#include "sph_dissipation_cells.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_create.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <vector>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

void SPHDissipation::check_wall_particles(LAMMPS *lmp, const Fix *fix)
{
  const Atom *const atom = lmp->atom;
  const char *const group_name = lmp->group->names[fix->igroup];
  if (lmp->group->count(fix->igroup) == 0)
    lmp->error->all(FLERR, "Fix {} group {} has no particles", fix->style, group_name);

  for (const auto &other : lmp->modify->get_fix_list()) {
    if (!other->time_integrate || other == fix) continue;
    const auto shared = first_particle(lmp, [&](int i) {
      return (atom->mask[i] & fix->groupbit) && (atom->mask[i] & other->groupbit);
    });
    if (!shared.empty())
      lmp->error->all(FLERR, "Fix {}: {} of the wall of fix {} {} is also moved by fix {} {}",
                      fix->style, shared, fix->id, fix->style, other->id, other->style);
  }
}

/* ----------------------------------------------------------------------
   Tell whether the pair style of the fluid gets them: also pair style hybrid must let them through.
------------------------------------------------------------------------- */

static bool have_pairs(LAMMPS *lmp, const Fluid *fluid, const Kind &a, const Kind &b)
{
  if (!in_neighbor_lists(lmp, a, b)) return false;
  auto *const hybrid = dynamic_cast<PairHybrid *>(lmp->force->pair);
  if (!hybrid) return true;
  char *const name = lmp->force->pair_match_ptr(fluid->pair);
  return hybrid->check_ijtype(std::min(a.first, b.first), std::max(a.first, b.first), name);
}

/* ---------------------------------------------------------------------- */

std::set<int> SPHDissipation::check_wall_interacts(LAMMPS *lmp, const Fix *fix, const Fluid *fluid,
                                                   bool warn)
{
  int walls = 0;
  for (const auto &wall : lmp->modify->get_fix_by_style("^sph/wall")) walls |= wall->groupbit;

  std::vector<Kind> solid, liquid;
  for (const Kind &kind : all_kinds(lmp)) {
    const bool has_coefficients = fluid->has_type(kind.first);
    if (kind.second & fix->groupbit) {
      if (!has_coefficients)
        lmp->error->all(FLERR,
                        "The wall of fix {} {} has particles of type {}, for which there are no "
                        "coefficients of the pair style of the fluid",
                        fix->id, fix->style, kind.first);
      solid.push_back(kind);
    } else if (has_coefficients && !(kind.second & walls))
      liquid.push_back(kind);
  }

  std::set<int> felt, ignored;    // types of the fluid
  for (const Kind &f : liquid) {
    const bool feels = std::any_of(solid.begin(), solid.end(), [&](const Kind &wall) {
      return have_pairs(lmp, fluid, f, wall);
    });
    (feels ? felt : ignored).insert(f.first);
  }
  if (ignored.empty()) return felt;
  const char *const reason =
      "no pair coefficients of the fluid's style between their types, neigh_modify exclude, or "
      "neigh_modify include";
  if (felt.empty())
    lmp->error->all(FLERR, "The fluid does not interact with the wall of fix {} {}: {}", fix->id,
                    fix->style, reason);
  if (warn && lmp->comm->me == 0)
    lmp->error->warning(FLERR,
                        "A part of the fluid, of type {}, does not interact with the wall of fix "
                        "{} {}: {}",
                        *ignored.begin(), fix->id, fix->style, reason);
  return felt;
}

/* ----------------------------------------------------------------------
   Warn if the wall does not fill the support of the fluid at its surface.  The first layer has fluid at
   the distance of the particle spacing; below it, the wall must go as deep as the support radius minus
   one spacing.  The neighbor lists have no pairs of wall particles, hence the cells.
   Warn if the masses do not fit the distances, for the spacing is that of the masses.
------------------------------------------------------------------------- */

void SPHDissipation::check_wall_thickness(LAMMPS *lmp, const Fix *fix, const Fluid *fluid)
{
  const Atom *const atom = lmp->atom;
  double **x = atom->x;
  const int nall = atom->nlocal + atom->nghost;
  const double support = fluid->support_radius();
  const int dim = fluid->dimension();

  std::vector<int> everything(nall);
  std::iota(everything.begin(), everything.end(), 0);
  const Cells cells(x, everything, support);

  // for each particle j within the support radius of particle i

  auto for_neighbors = [&](int i, auto &&function) {
    cells.near(x[i], support, [&](int j, const double *r, double rsq) {
      if (j != i) function(j, r, sqrt(rsq));
    });
  };

  double worst[2] = {0.0, 0.0}, worst_all[2];    // spacing - depth, spacing over depth of bad ones
  double sum[2] = {0.0, 0.0}, sum_all[2];        // of particles, of nearest particle over spacing
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & fix->groupbit)) continue;
    const double rho0 = fluid->model->coeffs[atom->type[i]].eos.rho0;
    const double spacing = pow(atom->rmass[i] / rho0, 1.0 / dim);

    double nearest = support, normal[3] = {0.0, 0.0, 0.0}, closest = support;
    for_neighbors(i, [&](int j, const double *r, double distance) {
      closest = std::min(closest, distance);
      if (fluid->is_boundary(j)) return;
      nearest = std::min(nearest, distance);
      const double weight = (support - distance) * (support - distance) / distance;
      for (int d = 0; d < 3; d++) normal[d] += weight * r[d];
    });
    sum[0] += 1.0;
    sum[1] += closest / spacing;
    if (nearest > 1.25 * spacing || !(MathExtra::len3(normal) > 0.0)) continue;
    MathExtra::norm3(normal);

    double depth = 0.0;
    for_neighbors(i, [&](int j, const double *r, double) {
      if (fluid->is_boundary(j)) depth = std::max(depth, -MathExtra::dot3(normal, r));
    });
    const double missing = support - (depth + spacing);
    if (missing > 0.5 * spacing) {
      worst[0] = std::max(worst[0], missing);
      worst[1] = std::max(worst[1], ceil(support / spacing - 1.0e-6));
    }
  }
  MPI_Allreduce(worst, worst_all, 2, MPI_DOUBLE, MPI_MAX, lmp->world);
  if (worst_all[0] > 0.0 && lmp->comm->me == 0)
    lmp->error->warning(
        FLERR,
        "The wall of fix {} {} is thinner than the support radius {:g}, by {:.3g}: it "
        "needs {:g} layers of particles",
        fix->id, fix->style, support, worst_all[0], worst_all[1]);

  // on lattices the nearest particle is 1 to 1.12 spacings away

  MPI_Allreduce(sum, sum_all, 2, MPI_DOUBLE, MPI_SUM, lmp->world);
  const double ratio = sum_all[1] / sum_all[0];
  if ((ratio < 0.6 || ratio > 1.6) && lmp->comm->me == 0)
    lmp->error->warning(
        FLERR,
        "The masses of the wall of fix {} {} are those of particles {:.2g} times as "
        "far apart as they are: a mass should be rho0 of its type times the volume",
        fix->id, fix->style, 1.0 / ratio);
}
