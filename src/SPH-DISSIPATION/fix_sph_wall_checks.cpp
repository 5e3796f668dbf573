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

#include "fix_sph_wall.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "math_const.h"
#include "math_extra.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_hybrid.h"
#include "sph_dissipation_bodies.h"
#include "sph_dissipation_cells.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_value.h"
#include "sph_dissipation_wall_motion.h"
#include "sph_dissipation_wall_terms.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <set>
#include <vector>

using namespace LAMMPS_NS;
using namespace MathConst;
using namespace SPHDissipation;

// Checks of a wall of particles, called by all ranks, and the pairs that it has in the neighbor lists.

/* ----------------------------------------------------------------------
   Exclude pairs of this wall with itself and with other walls from the neighbor lists, as neigh_modify exclude group does.
   Undo exclusions of an earlier run, but not those of the input.
------------------------------------------------------------------------- */

void FixSPHWall::exclude_walls()
{
  include_walls();
  for (const auto &wall : modify->get_fix_by_style("^sph/wall")) {
    const int other = wall->igroup;
    if (find_excluded(igroup, other) >= 0 || find_excluded(other, igroup) >= 0) continue;
    neighbor->modify_params(
        fmt::format("exclude group {} {}", group->names[igroup], group->names[other]));
    excluded.push_back(other);
  }
}

/* ----------------------------------------------------------------------
   Undo exclude_walls().  The group bits of the lists in use do not change until Neighbor::init() sets them again.
   (Neighbor::exclusion_group_group_delete() would write past their end if groups have been excluded since then.)  The
   command clear, and the end of LAMMPS, delete the neighbor lists before the fixes.
------------------------------------------------------------------------- */

void FixSPHWall::include_walls()
{
  for (std::size_t k = 0; k < excluded.size() && neighbor; k++) {
    const int n = find_excluded(igroup, excluded[k]);
    if (n < 0) continue;    // neigh_modify exclude none
    const int last = neighbor->nex_group--;
    std::copy(neighbor->ex1_group + n + 1, neighbor->ex1_group + last, neighbor->ex1_group + n);
    std::copy(neighbor->ex2_group + n + 1, neighbor->ex2_group + last, neighbor->ex2_group + n);
  }
  excluded.clear();
}

/* ----------------------------------------------------------------------
   Return the index of two groups in the list of Neighbor, -1 if the list does not have the groups.
------------------------------------------------------------------------- */

int FixSPHWall::find_excluded(int first, int second) const
{
  for (int n = 0; n < neighbor->nex_group; n++)
    if (neighbor->ex1_group[n] == first && neighbor->ex2_group[n] == second) return n;
  return -1;
}

/* ----------------------------------------------------------------------
   Check that the wall has particles, and that no other fix moves them.
------------------------------------------------------------------------- */

void FixSPHWall::check_particles() const
{
  const char *const group_name = group->names[igroup];
  if (group->count(igroup) == 0)
    error->all(FLERR, "Fix {} group {} has no particles", style, group_name);

  for (const auto &other : modify->get_fix_list()) {
    if (!other->time_integrate || other == this) continue;
    const auto shared = first_particle(lmp, [&](int i) {
      return (atom->mask[i] & groupbit) && (atom->mask[i] & other->groupbit);
    });
    if (!shared.empty())
      error->all(FLERR, "Fix {}: {} of the wall of fix {} {} is also moved by fix {} {}", style,
                 shared, id, style, other->id, other->style);
  }
}

/* ----------------------------------------------------------------------
   Check the keywords beside move rigid and elastic; others = a given keyword that bodies cannot have, or empty.
------------------------------------------------------------------------- */

void FixSPHWall::read_bodies(const std::string &others)
{
  if (!others.empty())
    error->all(FLERR, "Fix {} move {} cannot be used with {}", style, kind(), others);
  if (by_molecule && !atom->molecule_flag)
    error->all(FLERR, "Fix {} body molecule requires molecule IDs, fix property/atom mol", style);
}

/* ----------------------------------------------------------------------
   Refuse settings of the fluid, fixes, and commands that cannot be used with bodies.
------------------------------------------------------------------------- */

void FixSPHWall::check_bodies(const Fluid *fluid) const
{
  const Settings &choice = fluid->model->choice;
  auto refuse = [&](bool is_used, const std::string &what) {
    if (is_used) error->all(FLERR, "Fix {} move {} cannot be used with {}", style, kind(), what);
  };
  refuse(update->whichflag == 2, "a minimization");
  for (int d = 0; d < 3; d++)
    refuse(!gravity[d].is_zero() && !choice.continuity,
           "gravity: the pressure of frozen fluid has it already");
  refuse(is_rerun(lmp), "rerun");
  refuse(fluid->spins, "pair style sph/micropolar");
  refuse(choice.shear == Shear::MORRIS || choice.shear == Shear::ESPANOL,
         "shear morris or espanol of the pair style, whose forces have no angular momentum");
  refuse(choice.bulk == Bulk::VOLUME, "bulk volume of the pair style");
  refuse(choice.own_temperatures, "temp energy of the pair style");
  refuse(fluid->model->constants().thermal_pressure,
         "eos ideal or gruneisen: the pressure of a body does not follow the heat of the fluid");
  refuse(fluid->model->constants().optional, "vortex viscosity or interdrag of the fluid");
  refuse(fluid->model->has_rheology(), "viscosities that are not constant");
  if (law && choice.thermal && (law->restitution < 1.0 || law->friction > 0.0))
    error->all(
        FLERR,
        "Fix {} contact: with temp of the pair style, the restitution must be 1 and the friction "
        "0: a contact that dissipates has no noise in balance with it",
        style);
  refuse(!modify->get_fix_by_style("^sph/open").empty(), "fix sph/open");
  refuse(!modify->get_fix_by_style("^sph/torque").empty(), "fix sph/torque");
}

/* ----------------------------------------------------------------------
   Check that one fix nve moves each particle of elastic bodies.
------------------------------------------------------------------------- */

void FixSPHWall::check_integrator() const
{
  if (group->count(igroup) == 0)
    error->all(FLERR, "Fix {} group {} has no particles", style, group->names[igroup]);
  std::vector<int> movers(atom->nlocal, 0);
  for (const auto &other : modify->get_fix_list()) {
    if (other == this || !(other->time_integrate || dynamic_cast<FixSPHWall *>(other))) continue;
    const bool nve = !strcmp(other->style, "nve") || !strcmp(other->style, "nve/omp") ||
        utils::strmatch(other->style, "^nve/kk");
    const auto shared = first_particle(lmp, [&](int i) {
      const bool both = (atom->mask[i] & groupbit) && (atom->mask[i] & other->groupbit);
      if (both && nve) movers[i]++;
      return both && !nve;
    });
    if (!shared.empty())
      error->all(FLERR,
                 "Fix {} {} move elastic: {} of a body is moved by fix {} {}, not by fix nve", id,
                 style, shared, other->id, other->style);
  }
  const auto wrong = first_particle(lmp, [&](int i) {
    return (atom->mask[i] & groupbit) && movers[i] != 1;
  });
  if (!wrong.empty())
    error->all(FLERR, "Fix {} {} move elastic: {} must be moved by one fix nve", id, style, wrong);
}

/* ----------------------------------------------------------------------
   Check that one fix for rigid bodies, and no other fix, moves the particles of the bodies.  Return true if the fix moves
   them with the angular velocity of the orientation in the middle of the step, as all but rigid/nve and similar fixes do.
------------------------------------------------------------------------- */

bool FixSPHWall::check_movers() const
{
  if (group->count(igroup) == 0)
    error->all(FLERR, "Fix {} group {} has no particles", style, group->names[igroup]);
  std::vector<int> movers(atom->nlocal, 0);
  bool lagging = false, on_step = false;    // some movers do so
  for (const auto &other : modify->get_fix_list()) {
    if (other == this || !(other->time_integrate || dynamic_cast<FixSPHWall *>(other))) continue;
    if (other->rigid_flag) {
      const bool thermostat = (other->setmask() & FixConst::POST_FORCE) ||
          utils::strmatch(other->style, "/n[pv][th]");
      if (noise && thermostat)
        error->all(FLERR,
                   "Fix {} {} move rigid cannot be used with the thermostat of fix {} {}: the "
                   "noise of the pair style, keyword temp, is one",
                   id, style, other->id, other->style);
      bool is_mover = false;
      for (int i = 0; i < atom->nlocal; i++)
        if ((atom->mask[i] & groupbit) && (atom->mask[i] & other->groupbit)) {
          movers[i]++;
          is_mover = true;
        }
      if (over_all<int>(world, is_mover, MPI_MAX))
        (utils::strmatch(other->style, "^rigid/n") ? on_step : lagging) = true;
      continue;
    }
    const auto shared = first_particle(lmp, [&](int i) {
      return (atom->mask[i] & groupbit) && (atom->mask[i] & other->groupbit);
    });
    if (!shared.empty())
      error->all(FLERR, "Fix {} {} move rigid: {} of a body is also moved by fix {} {}", id, style,
                 shared, other->id, other->style);
  }
  const auto wrong = first_particle(lmp, [&](int i) {
    return (atom->mask[i] & groupbit) && movers[i] != 1;
  });
  if (!wrong.empty())
    error->all(FLERR,
               "Fix {} {} move rigid: {} must be moved by one fix for rigid bodies, as fix rigid "
               "or rigid/small",
               id, style, wrong);
  if (on_step && lagging)
    error->all(FLERR,
               "Fix {} {} move rigid has bodies of fix rigid/nve and of fix rigid, which move in "
               "different ways; give each kind a fix {} of its own",
               id, style, style);
  return lagging;
}

/* ----------------------------------------------------------------------
   Check that a body has at least the mass of its particles in the fix that moves the body.  The solver of large viscosities
   uses the mass of the particles: with half the mass in the fix, the error of the acting velocity grows from step to step.
------------------------------------------------------------------------- */

void FixSPHWall::check_masses() const
{
  constexpr double LEAST = 0.99;
  for (const auto &other : modify->get_fix_list()) {
    int dim;
    const auto *const body =
        static_cast<int *>(other->rigid_flag ? other->extract("body", dim) : nullptr);
    if (!over_all<int>(world, body != nullptr, MPI_MAX)) continue;
    const auto *const mass = static_cast<double *>(other->extract("masstotal", dim));
    const auto light = first_particle(lmp, [&](int i) {
      return mass && (atom->mask[i] & groupbit) && (atom->mask[i] & other->groupbit) &&
          body[i] >= 0 && mass[body[i]] < LEAST * (*bodies)[bodies->of(i)].mass;
    });
    if (!light.empty())
      error->all(
          FLERR,
          "Fix {} {} move rigid: with viscous rkl2 and implicit, fix {} {} must not give the "
          "body of {} less mass than its particles have",
          id, style, other->id, other->style, light);
  }
}

/* ----------------------------------------------------------------------
   Warn if a periodic border cuts a body, or a rotating wall, in two: particles lie on both sides of the border, some other
   part of the box has none, and the first part of the box does not continue the image of the last part.
------------------------------------------------------------------------- */

void FixSPHWall::check_pieces(const Fluid *fluid) const
{
  using Bits = long long;
  constexpr double WIDTH = 1.5;    // least width of a part of the box, in spacings
  constexpr int MOST = 60;
  if (!bodies && !motion->rotates()) return;
  const std::size_t n = bodies ? bodies->size() : 1;
  double spacing = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit)
      spacing = std::max(spacing,
                         spacing_of(fluid->dimension(),
                                    atom->rmass[i] / fluid->model->coeffs[atom->type[i]].eos.rho0));
  spacing = over_all(world, spacing, MPI_MAX);

  const double *const h = domain->h;
  const double edges[3][3] = {{h[0], 0.0, 0.0}, {h[5], h[1], 0.0}, {h[4], h[3], h[2]}};
  std::vector<int> cut(n, 0);
  for (int d = 0; d < domain->dimension; d++) {
    double across[3];
    MathExtra::cross3(edges[d], motion->velocity().axis, across);
    if (!domain->periodicity[d] ||
        (!bodies && MathExtra::len3(across) < 1.0e-6 * MathExtra::len3(edges[d])))
      continue;
    const int parts = static_cast<int>(
        std::min(static_cast<double>(MOST), floor(MathExtra::len3(edges[d]) / (WIDTH * spacing))));
    if (parts < 3) continue;
    std::vector<Bits> filled(n, 0), filled_all(n);
    std::vector<int> image(2 * n, MAXSMALLINT), image_all(2 * n);    // least of first part, - last
    for (int i = 0; i < atom->nlocal; i++) {
      if (!(atom->mask[i] & groupbit)) continue;
      const int shift[3] = {static_cast<int>((atom->image[i] & IMGMASK) - IMGMAX),
                            static_cast<int>((atom->image[i] >> IMGBITS & IMGMASK) - IMGMAX),
                            static_cast<int>((atom->image[i] >> IMG2BITS) - IMGMAX)};
      double place[3];
      domain->x2lamda(atom->x[i], place);
      const int part = std::min(std::max(static_cast<int>(parts * place[d]), 0), parts - 1);
      const int k = bodies ? bodies->of(i) : 0;
      filled[k] |= Bits(1) << part;
      if (part == 0) image[2 * k] = std::min(image[2 * k], shift[d]);
      if (part == parts - 1) image[2 * k + 1] = std::min(image[2 * k + 1], -shift[d]);
    }
    const int size = static_cast<int>(n);
    MPI_Allreduce(filled.data(), filled_all.data(), size, MPI_LONG_LONG, MPI_BOR, world);
    MPI_Allreduce(image.data(), image_all.data(), 2 * size, MPI_INT, MPI_MIN, world);
    for (std::size_t k = 0; k < n; k++) {
      const bool at_both = (filled_all[k] & 1) && (filled_all[k] >> (parts - 1) & 1);
      const bool through = filled_all[k] == (Bits(1) << parts) - 1;
      if (at_both && !through && image_all[2 * k] != 1 - image_all[2 * k + 1]) cut[k] = 1;
    }
  }
  const int number = std::accumulate(cut.begin(), cut.end(), 0);
  if (number && comm->me == 0)
    error->warning(FLERR,
                   "Fix {} {}: a periodic border cuts {} in two, which turns about a wrong center; "
                   "use set image, so that it is one piece",
                   style, id, bodies ? fmt::format("{} of {} bodies", number, n) : "the wall");
}

/* ----------------------------------------------------------------------
   Warn if particles of bodies are dry with tension yes.  With density continuity, such particles have the density of their
   body alone, and would pull on the fluid.
------------------------------------------------------------------------- */

void FixSPHWall::check_tension(const Fluid *fluid) const
{
  constexpr double DRY = 0.9;    // of rho0; at the surface of a body it is 0.7 and less
  const Settings &choice = fluid->model->choice;
  if (!choice.continuity || !choice.tension) return;
  const bigint dry = count_particles(lmp, [&](int i) {
    return (atom->mask[i] & groupbit) &&
        atom->rho[i] < DRY * fluid->model->coeffs[atom->type[i]].eos.rho0;
  });
  if (dry && comm->me == 0)
    error->warning(FLERR,
                   "Fix {} {} move {}: {} particles of bodies are dry; with tension yes of the "
                   "pair style they pull on fluid that comes near: use tension no",
                   style, id, kind(), dry);
}

/* ----------------------------------------------------------------------
   Return whether the pair style of the fluid gets the pairs of two kinds of particles, also from pair style hybrid.
------------------------------------------------------------------------- */

static bool have_pairs(LAMMPS *lmp, const Fluid *fluid, const Kind &a, const Kind &b)
{
  if (!in_neighbor_lists(lmp, a, b)) return false;
  auto *const hybrid = dynamic_cast<PairHybrid *>(lmp->force->pair);
  if (!hybrid) return true;
  char *const name = lmp->force->pair_match_ptr(fluid->pair);
  return hybrid->check_ijtype(std::min(a.first, b.first), std::max(a.first, b.first), name);
}

/* ----------------------------------------------------------------------
   Check that pair coefficients, exclusions, and neigh_modify include let fluid and wall interact; warn, in the first run, if
   only a part of the fluid interacts with the wall.  Return the types of the fluid that interact.
------------------------------------------------------------------------- */

std::set<int> FixSPHWall::interacting_types(const Fluid *fluid) const
{
  int walls = 0;
  for (const auto &wall : modify->get_fix_by_style("^sph/wall")) walls |= wall->groupbit;

  std::vector<Kind> solid, liquid;
  for (const Kind &kind : all_kinds(lmp)) {
    const bool has_coefficients = fluid->has_type(kind.first);
    if (kind.second & groupbit) {
      if (!has_coefficients)
        error->all(FLERR,
                   "The wall of fix {} {} has particles of type {}, for which there are no "
                   "coefficients of the pair style of the fluid",
                   id, style, kind.first);
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
    error->all(FLERR, "The fluid does not interact with the wall of fix {} {}: {}", id, style,
               reason);
  if (!checked && comm->me == 0)
    error->warning(FLERR,
                   "A part of the fluid, of type {}, does not interact with the wall of fix "
                   "{} {}: {}",
                   *ignored.begin(), id, style, reason);
  return felt;
}

/* ----------------------------------------------------------------------
   Warn if the wall, ghost atoms included, does not fill the support of the fluid at its surface.  The first layer has fluid
   at the distance of the particle spacing; below it, the wall must be as deep as the support radius minus one spacing.  The
   neighbor lists have no pairs of wall particles: use cells.
   Warn if masses of particles with a full support are not rho0 times their volume, that is the integral of a kernel
   (1 - r^2/R^2)^2 over its sum.
------------------------------------------------------------------------- */

void FixSPHWall::check_thickness(const Fluid *fluid) const
{
  constexpr double FULL = 0.03, MASS_ERROR = 0.2, ONE_SIDE = 0.1;
  double **x = atom->x;
  const int nall = atom->nlocal + atom->nghost;
  const double support = fluid->support_radius();
  const int dim = fluid->dimension();

  std::vector<int> members;    // fluid and walls, not particles of other pair styles
  for (int i = 0; i < nall; i++)
    if (fluid->has_type(atom->type[i])) members.push_back(i);
  const Cells cells(x, members, support);

  // call function(j, r, distance) for each particle j within the support radius of particle i

  auto for_neighbors = [&](int i, auto &&function) {
    cells.near(x[i], support, [&](int j, const double *r, double rsq) {
      if (j != i) function(j, r, sqrt(rsq));
    });
  };

  const double ball[] = {2.0, MY_PI, 4.0 / 3.0 * MY_PI};               // of radius 1, 1d to 3d
  const double mean_weight[] = {8.0 / 15.0, 1.0 / 3.0, 8.0 / 35.0};    // in it
  const double integral = ball[dim - 1] * mean_weight[dim - 1] * whole_power(support, dim);
  double worst[2] = {0.0, 0.0}, worst_all[2];    // spacing - depth, spacing over depth of bad ones
  double sum[2] = {0.0, 0.0}, sum_all[2];        // of particles with a full support: masses, rho0 V
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double rho0 = fluid->model->coeffs[atom->type[i]].eos.rho0;
    const double spacing = spacing_of(dim, atom->rmass[i] / rho0);

    double nearest = support, normal[3] = {0.0, 0.0, 0.0}, lengths = 0.0;
    double weights = 1.0, moment[3] = {0.0, 0.0, 0.0};
    for_neighbors(i, [&](int j, const double *r, double distance) {
      const double near = 1.0 - distance * distance / (support * support);
      weights += near * near;
      for (int d = 0; d < 3; d++) moment[d] += near * near * r[d];
      if (fluid->is_boundary(j)) return;
      nearest = std::min(nearest, distance);
      const double weight = (support - distance) * (support - distance) / distance;
      lengths += weight * distance;
      for (int d = 0; d < 3; d++) normal[d] += weight * r[d];
    });
    if (MathExtra::len3(moment) < FULL * weights * support) {
      sum[0] += atom->rmass[i];
      sum[1] += rho0 * integral / weights;
    }
    if (nearest > 1.25 * spacing || !(lengths > 0.0)) continue;

    double depth = 0.0;    // stays 0 for one layer with fluid on both sides, where normals cancel
    if (MathExtra::len3(normal) > ONE_SIDE * lengths) {
      MathExtra::norm3(normal);
      for_neighbors(i, [&](int j, const double *r, double) {
        if (fluid->is_boundary(j)) depth = std::max(depth, -MathExtra::dot3(normal, r));
      });
    }
    const double missing = support - (depth + spacing);
    if (missing > 0.5 * spacing) {
      worst[0] = std::max(worst[0], missing);
      worst[1] = std::max(worst[1], ceil(support / spacing - 1.0e-6));
    }
  }
  MPI_Allreduce(worst, worst_all, 2, MPI_DOUBLE, MPI_MAX, world);
  if (worst_all[0] > 0.0 && comm->me == 0 && (!bodies || heat == WallHeat::FLUX))
    error->warning(FLERR,
                   "The wall of fix {} {} is thinner than the support radius {:g}, by {:.3g}: it "
                   "needs {:g} layers of particles",
                   id, style, support, worst_all[0], worst_all[1]);

  MPI_Allreduce(sum, sum_all, 2, MPI_DOUBLE, MPI_SUM, world);
  const double ratio = sum_all[1] > 0.0 ? sum_all[0] / sum_all[1] : 1.0;
  if (fabs(ratio - 1.0) > MASS_ERROR && comm->me == 0)
    error->warning(
        FLERR,
        "The masses of the wall of fix {} {} are {:.2g} times rho0 of its type times the "
        "volume of a particle",
        id, style, ratio);
}
