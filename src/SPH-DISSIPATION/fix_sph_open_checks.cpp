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

#include "fix_sph_open.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_sph_bulk.h"
#include "force.h"
#include "group.h"
#include "math_extra.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_hybrid.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_eos.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_open.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <vector>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// Checks of a buffer zone and the fluid in front of it, called by all ranks.

/* ----------------------------------------------------------------------
   Check that the groups are static, that no particle is in both, and that the particles of the zone are
   fluid, which no other zone and no other fix has.
------------------------------------------------------------------------- */

void FixSPHOpen::check_groups(int fluid_group)
{
  const char *const zone_name = group->names[igroup];
  for (const int g : {igroup, fluid_group})
    if (group->dynamic[g])
      error->all(FLERR, "Fix {} cannot use dynamic group {}", style, group->names[g]);
  if (atom->firstgroupname)
    error->all(FLERR, "Fix {} cannot be used with atom_modify first: groups change within a step",
               style);

  bigint number[2] = {0, 0}, all[2];    // in the zone, in both groups
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    number[0]++;
    if (atom->mask[i] & fluidbit) number[1]++;
  }
  double type;
  const std::string other = first_particle(
      lmp,
      [&](int i) {
        return (atom->mask[i] & groupbit) && !fluid->has_type(atom->type[i]);
      },
      [&](int i) {
        return atom->type[i];
      },
      type);
  if (!other.empty())
    error->all(FLERR, "Fix {}: {} of type {} is not of the fluid", style, other, type);
  MPI_Allreduce(number, all, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  if (!all[0])
    error->all(FLERR,
               "Fix {}: group {} is empty; the zone must be filled with particles of the fluid",
               style, zone_name);
  if (all[1])
    error->all(FLERR, "Fix {}: {} particles are in both groups {} and {}", style, all[1], zone_name,
               fluid_name);

  for (const auto &other : modify->get_fix_by_style("^sph/open"))
    if (other != this && other->igroup == igroup)
      error->all(FLERR, "Fix {} {}: group {} has the zone of fix {} already", style, id, zone_name,
                 other->id);

  for (const auto &other : modify->get_fix_list()) {
    if (other == this || !other->time_integrate) continue;
    const bigint total = count_particles(lmp, [&](int i) {
      return (atom->mask[i] & groupbit) && (atom->mask[i] & other->groupbit);
    });
    if (total)
      error->all(FLERR,
                 "Fix {}: {} particles of group {} are also moved by fix {} of style {}; that "
                 "should be a fix of group {}",
                 style, total, zone_name, other->id, other->style, fluid_name);
  }
}

/* ----------------------------------------------------------------------
   Return the integrator of the group of the fluid: particles that enter are in no other group with an integrator.
------------------------------------------------------------------------- */

FixSPHBulk *FixSPHOpen::find_integrator(int fluid_group)
{
  FixSPHBulk *integrator = nullptr;
  for (const auto &other : modify->get_fix_list()) {
    auto *const candidate = dynamic_cast<FixSPHBulk *>(other);
    if (candidate && candidate->igroup == fluid_group) integrator = candidate;
  }
  if (!integrator)
    error->all(FLERR,
               "Fix {}: there is no fix sph/bulk or sph/micropolar of group {}, so that no fix "
               "moves the particles that enter",
               style, fluid_name);
  return integrator;
}

/* ----------------------------------------------------------------------
   Check that the fluid is in front of the plane, and the particles of this zone, and of no other one,
   behind it.
------------------------------------------------------------------------- */

void FixSPHOpen::check_places()
{
  bigint number[3] = {0, 0, 0}, all[3];           // fluid behind, zone in front, others in the zone
  const double slack = 1.0e-6 * plane->length;    // particles may be placed on the plane
  int others = 0;
  for (const auto &other : modify->get_fix_by_style("^sph/open"))
    if (other != this) others |= other->groupbit;
  for (int i = 0; i < atom->nlocal; i++) {
    const double height = plane->height(atom->x[i]);
    const bool behind = height < -slack && height > -plane->length && !plane->beside(atom->x[i]);
    if ((atom->mask[i] & fluidbit) && behind) number[0]++;
    if ((atom->mask[i] & groupbit) && height > slack) number[1]++;
    if ((atom->mask[i] & others) && behind) number[2]++;
  }
  MPI_Allreduce(number, all, 3, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all[0] || all[1])
    error->all(
        FLERR,
        "Fix {}: {} particles of the fluid are behind the plane and {} of the zone in front of "
        "it, seen along the normal, which must point into the fluid",
        style, all[0], all[1]);
  if (all[2])
    error->all(FLERR,
               "Fix {}: {} particles of other open zones are in this one; limit it by the keyword "
               "region",
               style, all[2]);
}

/* ----------------------------------------------------------------------
   Check that the region of the zone is as wide and as long as the zone: that it contains each particle,
   and the place as far in front of the plane as the fluid is measured.
------------------------------------------------------------------------- */

void FixSPHOpen::check_region()
{
  if (!plane->limited()) return;
  const double play = 1.0e-6 * plane->length;
  const double beside = std::max(lattice->are_new() ? 0.0 : 0.5 * lattice->width(), play);
  bigint number[2] = {0, 0}, all[2];    // particles outside, particles without a region in front
  for (int i = 0; i < atom->nlocal; i++) {
    double x[3], front[3];
    std::copy_n(atom->x[i], 3, x);
    const double height = plane->height(x);
    if (!(atom->mask[i] & groupbit) || height < -plane->length - play) continue;
    for (int d = 0; d < 3; d++) front[d] = x[d] + (radius - play - height) * plane->normal[d];
    domain->remap(x);
    domain->remap(front);
    if (plane->beside(x, beside))
      number[0]++;
    else if (plane->beside(front, beside))
      number[1]++;
  }
  MPI_Allreduce(number, all, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all[0])
    error->all(FLERR,
               "Fix {}: {} particles of group {} are outside of region {}, which must contain "
               "the zone",
               style, all[0], group->names[igroup], plane->region_name());
  if (all[1])
    error->all(FLERR,
               "Fix {}: region {} must reach {:g} into the fluid, where its state is measured, "
               "in front of all particles of the zone; it does not for {} of them",
               style, plane->region_name(), radius, all[1]);
}

/* ----------------------------------------------------------------------
   Check that LAMMPS builds new neighbor lists, and that they have the pairs of the zone with itself and with the fluid, also
   of particles that have entered and have the group of the fluid.
------------------------------------------------------------------------- */

void FixSPHOpen::check_lists()
{
  if (neighbor->build_once)
    error->all(FLERR, "Fix {} needs new neighbor lists: neigh_modify once must be no", style);
  const std::set<Kind> kinds = all_kinds(lmp);
  for (const Kind &zone : kinds) {
    if (!(zone.second & groupbit)) continue;
    const Kind entered = {zone.first, (zone.second & ~groupbit) | fluidbit};
    bool complete = in_neighbor_lists(lmp, zone, zone) && in_neighbor_lists(lmp, zone, entered);
    for (const Kind &other : kinds)
      if ((other.second & fluidbit) && other.first == zone.first)
        complete = complete && in_neighbor_lists(lmp, zone, other);
    if (!complete)
      error->all(FLERR,
                 "Fix {} {}: neigh_modify exclude or include leaves out pairs of the zone "
                 "with the fluid or with itself",
                 style, id);
  }
}

/* ----------------------------------------------------------------------
   Check that the prescribed energy, or temperature, of the zone is enough for heat > 0.
------------------------------------------------------------------------- */

void FixSPHOpen::check_heat()
{
  const FluidModel &model = *fluid->model;
  for (int i = 1; i <= atom->ntypes; i++) {
    const char *const keyword = model.keyword_that_needs(HEAT_CAPACITY, i);
    if (keyword && values->given(OpenValues::ENERGY) && model.choice.eos != Eos::IDEAL)
      error->all(FLERR,
                 "Fix {} energy cannot be used with {} of pair_coeff, which type {} has: give "
                 "the temperature instead",
                 style, keyword, i);
  }
  if (!values->given(OpenValues::TEMPERATURE)) return;
  double type;
  const std::string cold = first_particle(
      lmp,
      [&](int i) {
        return (atom->mask[i] & groupbit) && model.heat_capacity(atom->type[i]) == 0.0;
      },
      [&](int i) {
        return atom->type[i];
      },
      type);
  if (!cold.empty())
    error->all(FLERR, "{} needs the heat capacity of type {}, keyword cv of pair_coeff",
               fmt::format("Fix {} temperature", style), type);
}

/* ----------------------------------------------------------------------
   Warn of particles of a new zone without heat, though it conducts heat or heat has a pressure.
------------------------------------------------------------------------- */

void FixSPHOpen::warn_of_cold_zone()
{
  if (fluid->model->choice.eos == Eos::IDEAL || !condition->has_heat()) return;
  bigint number[2] = {0, 0}, all[2];
  for (const int i : members) {
    if (!(atom->mask[i] & groupbit)) continue;
    number[0]++;
    if (!(condition->heat(i) > 0.0)) number[1]++;
  }
  MPI_Allreduce(number, all, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all[1] && comm->me == 0)
    error->warning(
        FLERR,
        "Fix {} {}: {} of {} particles of the zone have no heat, though heat is "
        "conducted or acts on pressure or viscosity; use keyword temperature of this fix or of "
        "that of the fluid",
        style, id, all[1], all[0]);
}

/* ----------------------------------------------------------------------
   Warn of other styles of hybrid/overlay between zone and fluid, whose forces are not in the balance;
   pair style zero has none.
------------------------------------------------------------------------- */

void FixSPHOpen::warn_of_styles()
{
  auto *const hybrid = dynamic_cast<PairHybrid *>(force->pair);
  if (!hybrid) return;
  std::set<int> zone, both;    // types
  for (const Kind &kind : all_kinds(lmp)) {
    if (kind.second & groupbit) zone.insert(kind.first);
    if (kind.second & (groupbit | fluidbit)) both.insert(kind.first);
  }

  std::string found;
  for (const char *const names : {"^[^h]", "^h[^y]"}) {    // all but hybrid itself
    const Pair *last = nullptr;
    for (int n = 1;; n++) {
      Pair *const other = force->pair_match(names, 0, n);
      if (!other || other == last) break;
      last = other;
      char *const name = force->pair_match_ptr(other);
      bool acts = false;
      for (const int a : zone)
        for (const int b : both)
          if (hybrid->check_ijtype(std::min(a, b), std::max(a, b), name)) acts = true;
      if (acts && other != fluid->pair && strcmp(name, "zero") != 0)
        found += (found.empty() ? "" : ", ") + std::string(name);
    }
  }
  if (!found.empty() && comm->me == 0)
    error->warning(FLERR,
                   "Fix {} {}: the impulse and the energy of the forces of pair style {} "
                   "between zone and fluid are not in the ledger",
                   style, id, found);
}

/* ----------------------------------------------------------------------
   Warn if masses of zone and fluid differ slightly, as when density rho0 has set the
   latter before the zone was there.  Particles of sizes that differ on purpose have masses that differ
   by more.
------------------------------------------------------------------------- */

void FixSPHOpen::warn_of_masses()
{
  constexpr double SAME = 1.0e-6, ALIKE = 0.05;
  const int n = atom->ntypes + 1;
  std::vector<double> sum(2 * n, 0.0), zone(2 * n), ratio(n, INFINITY), all(n);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    sum[atom->type[i]] += 1.0;
    sum[n + atom->type[i]] += atom->rmass[i];
  }
  MPI_Allreduce(sum.data(), zone.data(), 2 * n, MPI_DOUBLE, MPI_SUM, world);

  // compare with the particle of the fluid that is most like the particles of the zone

  for (int i = 0; i < atom->nlocal; i++) {
    const int type = atom->type[i];
    if (!(atom->mask[i] & fluidbit) || zone[type] == 0.0) continue;
    ratio[type] = std::min(ratio[type], fabs(atom->rmass[i] * zone[type] / zone[n + type] - 1.0));
  }
  MPI_Allreduce(ratio.data(), all.data(), n, MPI_DOUBLE, MPI_MIN, world);
  for (int type = 1; type < n; type++)
    if (all[type] > SAME && all[type] < ALIKE && comm->me == 0)
      error->warning(FLERR,
                     "Fix {} {}: keyword density has set the masses of the fluid before; those "
                     "of the zone, of type {}, differ from them by a part of {:.2g}",
                     style, id, type, all[type]);
}

/* ----------------------------------------------------------------------
   Warn if the sums of the kernel give the zone, where its particles have a full support, another density than the prescribed
   one.  At the side of a jet the density of single particles may be lower, hence the largest and the mean.
------------------------------------------------------------------------- */

void FixSPHOpen::warn_of_density()
{
  constexpr double THIN = 0.6, DENSE = 1.1;
  double mine[2] = {0.0, 0.0}, sum[2], largest = 0.0, all;
  for (const int i : members) {
    if (!(atom->mask[i] & groupbit) ||
        plane->height(atom->x[i]) <= fluid->support_radius() - plane->length)
      continue;
    const double ratio = atom->rho[i] / condition->prescribed_density(i);
    mine[0] += 1.0;
    mine[1] += ratio;
    largest = std::max(largest, ratio);
  }
  MPI_Allreduce(mine, sum, 2, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(&largest, &all, 1, MPI_DOUBLE, MPI_MAX, world);
  const double mean = sum[1] / std::max(sum[0], 1.0);
  if ((all < THIN || mean > DENSE) && comm->me == 0)
    error->warning(FLERR,
                   "Fix {} {}: the masses of the zone, where its particles are, make {:.3g} "
                   "times the density that is prescribed: a mass should be that density times "
                   "the volume",
                   style, id, mean);
}

/* ----------------------------------------------------------------------
   Warn of a gap, wider than two particles, between entering particles and the fluid, up to two support radii from the plane.
   Return true if there is one; a gas may have any density.
   Mark, by one bit each, for each node of the plane, the parts of the depth with fluid, and the sides of the node on which
   particles enter.  Only nodes with particles on all sides count, not those at a wall or at the side of a jet, which may
   contract.
------------------------------------------------------------------------- */

bool FixSPHOpen::warn_of_gap()
{
  using Bits = long long;
  constexpr int PARTS = 58;
  constexpr double GAP = 2.0;    // in sizes of a particle, the distance of lattice layers
  if (fluid->model->choice.eos == Eos::IDEAL) return false;
  const double spacing = lattice->largest_spacing();
  const int nodes = plane->nnodes(), sides = 2 * (domain->dimension - 1);
  const double depth = 2.0 * fluid->support_radius(), part = depth / PARTS;
  std::vector<Bits> mine(2 * nodes, 0), all(2 * nodes);    // parts, then sides, of the nodes
  double size = 0.0, largest;
  for (int i = 0; i < atom->nlocal; i++) {
    const double *const x = atom->x[i];
    const double height = plane->height(x);
    if (height < -spacing || height >= depth) continue;
    const bool in_zone = atom->mask[i] & groupbit;
    if (in_zone ? !(MathExtra::dot3(atom->v[i], plane->normal) > 0.0)
                : (!(atom->mask[i] & fluidbit) || height < 0.0 || plane->beside(x)))
      continue;
    plane->near(x, radius, [&](int node, const double *l) {
      if (!in_zone) mine[node] |= Bits(1) << static_cast<int>(height / part);
      for (int k = 0; k < sides && in_zone; k++)
        if ((k % 2 ? -l[k / 2] : l[k / 2]) > 0.5 * radius) mine[nodes + node] |= Bits(1) << k;
    });
    size = std::max(size, atom->rmass[i] / fluid->model->coeffs[atom->type[i]].eos.rho0);
  }
  MPI_Allreduce(mine.data(), all.data(), 2 * nodes, MPI_LONG_LONG, MPI_BOR, world);
  MPI_Allreduce(&size, &largest, 1, MPI_DOUBLE, MPI_MAX, world);

  double widest = 0.0;
  for (int node = 0; node < nodes; node++) {
    if (all[nodes + node] != (Bits(1) << sides) - 1) continue;
    int end = 0;    // of the last part with fluid
    for (int k = 0; k < PARTS; k++)
      if (all[node] >> k & 1) {
        widest = std::max(widest, (k - end) * part);
        end = k + 1;
      }
  }
  if (widest < GAP * std::max(spacing, spacing_of(fluid->dimension(), largest))) return false;
  if (comm->me == 0)
    error->warning(
        FLERR,
        "Fix {} {}: there is a gap of {:.3g} in the fluid in front of the particles that enter at "
        "step {}: the fluid tears off",
        style, id, widest, update->ntimestep);
  return true;
}

/* ----------------------------------------------------------------------
   Check that the zone is so long that its particles have a full support while they are within the
   support radius of the fluid, even if rows are shorter by one spacing and by the motion of the fluid
   between two neighbor lists.
------------------------------------------------------------------------- */

void FixSPHOpen::check_length()
{
  const double least = 2.0 * fluid->support_radius() + lattice->largest_spacing() + neighbor->skin;
  if (plane->length < least)
    error->all(FLERR,
               "Fix {}: the zone must be at least {:g} long, not {:g}: two support radii, the "
               "distance of two particles, and the neighbor skin",
               style, least, plane->length);
}
