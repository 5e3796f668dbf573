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

#include "sph_dissipation_open.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "math_extra.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_create.h"
#include "sph_dissipation_fluid.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// The particles of all processors near the far end of a buffer zone, of the zone or not

class SPHDissipation::OpenBand : protected Pointers {
 public:
  // Collect the particles between two heights.
  OpenBand(class LAMMPS *, const OpenPlane &, int groupbit, double lo, double hi);

  // Return whether a particle of the zone, or of any kind, is behind x, closer than beside to the normal through x.
  bool has_behind(const double *x, double beside, bool any_kind = false) const;

  // Return the distance along the normal of the nearest particle of the zone behind x, or in front of x, closer than beside
  // to the normal through x; infinite if there is none.
  double next(const double *x, double beside, bool behind) const;

  // Return whether any particle (other: any particle not of the zone) is closer to x than this distance.
  bool has_near(const double *x, double distance, bool other = false) const;

 private:
  const OpenPlane &plane;
  std::vector<double> place;    // x y z of each
  std::vector<char> of_zone;
  std::vector<std::vector<int>> at_node;    // particles next to each node of the plane

  int nearest_node(const double *x) const;
  template <class Function> bool any(const double *x, double reach, Function &&function) const;
};

/* ---------------------------------------------------------------------- */

OpenBand::OpenBand(LAMMPS *lmp, const OpenPlane &plane, int groupbit, double lo, double hi) :
    Pointers(lmp), plane(plane), at_node(plane.nnodes())
{
  const Fluid *const fluid = find_fluid(force);
  std::vector<double> mine;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!fluid->has_type(atom->type[i])) continue;
    const double *const x = atom->x[i];
    const bool mine_of_zone = atom->mask[i] & groupbit;
    const double height = plane.height(x);
    if (height < lo || height > hi) continue;
    if (!mine_of_zone && plane.beside(x)) continue;
    mine.insert(mine.end(), {x[0], x[1], x[2], mine_of_zone ? 1.0 : 0.0});
  }

  const std::vector<double> all = gather_all(world, mine, MPI_DOUBLE);
  for (std::size_t k = 0; k < all.size(); k += 4) {
    at_node[nearest_node(&all[k])].push_back(static_cast<int>(of_zone.size()));
    place.insert(place.end(), &all[k], &all[k] + 3);
    of_zone.push_back(all[k + 3] > 0.0);
  }
}

/* ---------------------------------------------------------------------- */

int OpenBand::nearest_node(const double *x) const
{
  const OpenPlane::Spot spot = plane.spot(x);
  return spot.node[std::max_element(spot.weight, spot.weight + spot.n) - spot.weight];
}

/* ----------------------------------------------------------------------
   Return whether function(k, offset from x) is true for any particle k closer than reach to the normal through x.  Calls the
   function for all of these particles, and for some farther ones, until the result is true.
------------------------------------------------------------------------- */

template <class Function>
bool OpenBand::any(const double *x, double reach, Function &&function) const
{
  bool found = false;
  plane.near(x, reach + plane.node_distance(), [&](int node, const double *) {
    for (const int k : at_node[node]) found = found || function(k, plane.offset(x, &place[3 * k]));
  });
  return found;
}

/* ---------------------------------------------------------------------- */

bool OpenBand::has_behind(const double *x, double beside, bool any_kind) const
{
  return any(x, beside, [&](int k, const OpenPlane::Offset &to) {
    return (any_kind || of_zone[k]) && to.beside < beside && to.ahead < 0.0;
  });
}

double OpenBand::next(const double *x, double beside, bool behind) const
{
  double nearest = INFINITY;
  any(x, beside, [&](int k, const OpenPlane::Offset &to) {
    const double distance = behind ? -to.ahead : to.ahead;
    if (of_zone[k] && to.beside < beside && distance > 0.0) nearest = std::min(nearest, distance);
    return false;
  });
  return nearest;
}

bool OpenBand::has_near(const double *x, double distance, bool other) const
{
  return any(x, distance, [&](int k, const OpenPlane::Offset &to) {
    return !(other && of_zone[k]) && to.distance() < distance;
  });
}

static constexpr double FAR = 1.0e300;
static constexpr double ROUND_OFF = 1.0e-9;    // tolerance of lengths
static constexpr double STRAIGHT =
    0.01;    // sideways tolerance of a row, over the size of a particle

/* ---------------------------------------------------------------------- */

void ZoneLattice::init(double support_in, int fluid_bit)
{
  support = support_in;
  fluidbit = fluid_bit;
  unknown_end = true;
  interrupt_ids();
  if (half_width == 0.0) unknown_sides = true;
  if (unknown_sides) find_rows();
  if (given_spacing > 0.0) spacing = given_spacing;
  if (!by_distance() && spacing == 0.0)
    error->all(FLERR,
               "{}: cannot find the distance of the particles in a row, for no particle stands "
               "straight behind the particle nearest to the plane; use the keyword spacing",
               owner);
}

/* ----------------------------------------------------------------------
   Give one particle of the zone the next free ID, if all IDs are consecutive.  Sorted dumps assume that consecutive IDs do
   not change while the number of particles is the same (Dump::init() and Dump::sort()).
------------------------------------------------------------------------- */

void ZoneLattice::interrupt_ids()
{
  if (!atom->tag_consecutive()) return;
  tagint mine = 0, last;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) mine = std::max(mine, atom->tag[i]);
  MPI_Allreduce(&mine, &last, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  const auto next = static_cast<tagint>(atom->natoms) + 1;

  begin_change(lmp);
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->tag[i] == last) atom->tag[i] = next;
  end_change(lmp, atom->nlocal);
}

/* ---------------------------------------------------------------------- */

double ZoneLattice::step(int i) const
{
  if (!by_distance()) return spacing;
  const double length = distance(i);
  if (!(length > 0.0))
    error->one(FLERR, "{}: the density of particle {} gives {:g} as the distance from the next one",
               owner, atom->tag[i], length);
  return length;
}

/* ----------------------------------------------------------------------
   Return the height at which the zone ends, with a tolerance: a layer of a lattice at the end is as a whole on one side of
   the end, on any number of processors.
------------------------------------------------------------------------- */

double ZoneLattice::end() const
{
  return -(1.0 + ROUND_OFF) * plane.length;
}

/* ----------------------------------------------------------------------
   Measure spacing and width of the rows at the particle nearest to the plane: the distance of the next particle straight
   behind this particle, and the distance of the nearest row.
------------------------------------------------------------------------- */

void ZoneLattice::find_rows()
{
  struct {
    double height;
    int proc;
  } mine = {-FAR, comm->me}, front;
  int front_i = -1;
  double size = FAR, all_size;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double height = plane.height(atom->x[i]);
    if (height > mine.height) {
      mine.height = height;
      front_i = i;
    }
  }
  MPI_Allreduce(&mine, &front, 1, MPI_DOUBLE_INT, MPI_MAXLOC, world);
  double x[3] = {0.0, 0.0, 0.0};
  if (front.proc == comm->me && front_i >= 0) std::copy_n(atom->x[front_i], 3, x);
  MPI_Bcast(x, 3, MPI_DOUBLE, front.proc, world);

  // the distance of the nearest neighbor is the size of a particle

  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double r = plane.offset(x, atom->x[i]).distance();
    if (r > 0.0) size = std::min(size, r);
  }
  MPI_Allreduce(&size, &all_size, 1, MPI_DOUBLE, MPI_MIN, world);

  double nearest[2] = {FAR, FAR}, all[2];    // behind, beside
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const OpenPlane::Offset to = plane.offset(x, atom->x[i]);
    if (to.beside > STRAIGHT * all_size)
      nearest[1] = std::min(nearest[1], to.beside);
    else if (to.ahead < 0.0)
      nearest[0] = std::min(nearest[0], -to.ahead);
  }
  MPI_Allreduce(nearest, all, 2, MPI_DOUBLE, MPI_MIN, world);
  const bool in_order = all[0] < FAR;
  spacing = in_order ? all[0] : 0.0;
  half_width = 0.5 * ((in_order && all[1] < FAR) ? all[1] : all_size);
}

/* ---------------------------------------------------------------------- */

double ZoneLattice::my_largest_spacing() const
{
  if (!by_distance()) return spacing;
  double largest = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    largest = std::max(largest, step(i));
  }
  return largest;
}

double ZoneLattice::largest_spacing() const
{
  if (!by_distance()) return spacing;
  return over_all(world, my_largest_spacing(), MPI_MAX);
}

/* ---------------------------------------------------------------------- */

void ZoneLattice::renew(const Refresh &refresh)
{
  const int nbefore = atom->nlocal;
  begin_change(lmp);
  remove_beyond();
  bigint removed = nbefore - atom->nlocal, change = 0;
  if (by_distance()) refresh({});    // particles have changed sides, and places in memory

  // largest distance of the last particle of a row from the end, by the motion since the last time

  double mine[2] = {moved, my_largest_spacing()};
  double all[2];
  MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_MAX, world);
  const double moved_all = all[0], largest = all[1];
  moved = 0.0;
  if (!unknown_end && plane.length - moved_all - largest < support)
    error->all(FLERR,
               "{}: the fluid moved by {:g} between two neighbor lists, so that the zone of length "
               "{:g} ran empty; build them more often or make the zone longer",
               owner, moved_all, plane.length);
  const double depth = unknown_end ? plane.length : moved_all + 2.5 * largest;
  const OpenBand band(lmp, plane, groupbit, end(), depth - plane.length);
  if (unknown_sides) {
    check_alone(band);
    check_lattice(band, largest);
  }
  unknown_end = unknown_sides = false;

  std::vector<int> last = last_ones(band);
  while (fill(last, band, refresh, removed, change)) {}
  end_change_by(lmp, change);
}

/* ---------------------------------------------------------------------- */

void ZoneLattice::remove_beyond()
{
  for (int i = atom->nlocal - 1; i >= 0; i--) {
    highest = std::max(highest, atom->tag[i]);
    if ((atom->mask[i] & groupbit) && plane.height(atom->x[i]) < end()) remove_particle(lmp, i);
  }
}

/* ----------------------------------------------------------------------
   Return the owned particles that move into the fluid and have no particle behind them in the row.
------------------------------------------------------------------------- */

std::vector<int> ZoneLattice::last_ones(const OpenBand &band) const
{
  std::vector<int> last;
  for (int i = 0; i < atom->nlocal; i++) {
    const double *const x = atom->x[i];
    if (!(atom->mask[i] & groupbit)) continue;
    if (!(MathExtra::dot3(atom->v[i], plane.normal) > 0.0)) continue;
    if (plane.height(x) - step(i) < end()) continue;
    if (!band.has_behind(x, half_width)) last.push_back(i);
  }
  return last;
}

/* ----------------------------------------------------------------------
   Create a particle behind each last particle of a row, and replace the last by the new particle in the list.  Return false
   if no processor created any.  The mass between two particles of a row is the mass of one particle: so the distance of the new
   particle is the harmonic mean of the distances at both places, to second order.
------------------------------------------------------------------------- */

bool ZoneLattice::fill(std::vector<int> &last, const OpenBand &band, const Refresh &refresh,
                       bigint &removed, bigint &change)
{
  constexpr int CORRECTIONS = 3;
  last.erase(std::remove_if(last.begin(), last.end(),
                            [&](int i) {
                              return !(plane.height(atom->x[i]) - step(i) >= end());
                            }),
             last.end());
  const int n = static_cast<int>(last.size());
  bigint mine[2] = {n, removed};
  bigint all[2];
  MPI_Allreduce(mine, all, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  removed = 0;
  change += all[0] - all[1];
  if (!all[0]) return false;

  std::vector<NewIDs> one_each;
  for (const int i : last) one_each.emplace_back(atom->tag[i], 1);
  std::vector<tagint> ids;
  if (!new_ids(lmp, one_each, highest, ids))
    error->all(FLERR, "{}: too many particles have entered for their IDs", owner);
  std::vector<int> created;
  for (int k = 0; k < n; k++) {
    const int i = last[k];
    double x[3];
    for (int d = 0; d < 3; d++) x[d] = atom->x[i][d] - step(i) * plane.normal[d];
    created.push_back(create_copy(lmp, i, ids[k], x));
  }

  refresh(created);
  if (by_distance())
    for (int turn = 0; turn < CORRECTIONS; turn++) {
      for (int k = 0; k < n; k++) {
        const int i = last[k], j = created[k];
        const double mean = 2.0 / (1.0 / step(i) + 1.0 / step(j));
        for (int d = 0; d < 3; d++) atom->x[j][d] = atom->x[i][d] - mean * plane.normal[d];
      }
      refresh(created);
    }

  for (const int j : created) check_seat(atom->x[j], band);
  last = created;
  return true;
}

/* ----------------------------------------------------------------------
   Refuse other particles in the zone.
------------------------------------------------------------------------- */

void ZoneLattice::check_alone(const OpenBand &band) const
{
  bigint count = 0, all;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    if (band.has_near(atom->x[i], half_width, true)) count++;
  }
  MPI_Allreduce(&count, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all)
    error->all(FLERR,
               "{}: {} particles of the zone overlap with others, such as those of a wall, which "
               "must be beside it",
               owner, all);
}

/* ----------------------------------------------------------------------
   Give an error for gaps in the rows of a lattice, which must fill the zone from the plane to the end, and warn of fluid at
   the plane with neither a row nor a wall behind the fluid.  fill() later creates missing particles at the end of rows that
   move into the fluid.  A zone without a lattice, such as a zone that the fluid has filled, has no rows.
------------------------------------------------------------------------- */

void ZoneLattice::check_lattice(const OpenBand &band, double largest) const
{
  constexpr double GAP = 1.5, FIRST = 1.2, LAST = 1.5;    // distances of particles in a row
  constexpr double APART = 1.5;    // over half the width of a row: farther than the next row
  enum { NUMBER, IN_ROWS, GAPS, BARE, NSUM };
  bigint sum[NSUM] = {0, 0, 0, 0}, all[NSUM];
  const double straight = STRAIGHT * 2.0 * half_width;
  for (int i = 0; i < atom->nlocal; i++) {
    const double *const x = atom->x[i];
    const double height = plane.height(x);
    if ((atom->mask[i] & fluidbit) && height >= 0.0 && height < largest && !plane.beside(x) &&
        !band.has_behind(x, APART * half_width, true))
      sum[BARE]++;
    if (!(atom->mask[i] & groupbit)) continue;
    const double one = step(i);
    const double ahead = band.next(x, straight, false), behind = band.next(x, straight, true);
    const double inward = MathExtra::dot3(atom->v[i], plane.normal);
    sum[NUMBER]++;
    if (std::min(ahead, behind) < GAP * one) sum[IN_ROWS]++;
    if (std::isinf(ahead) && height < -(inward < 0.0 ? GAP : FIRST) * one) sum[GAPS]++;
    if (behind > GAP * one && height - LAST * one > -plane.length &&
        !(std::isinf(behind) && inward > 0.0))
      sum[GAPS]++;
  }
  MPI_Allreduce(sum, all, NSUM, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all[IN_ROWS] < all[NUMBER]) return;
  if (all[GAPS])
    error->all(FLERR,
               "{}: the rows of the zone have {} gaps; it must be filled from the plane to its end",
               owner, all[GAPS]);
  if (all[BARE] && comm->me == 0)
    error->warning(FLERR,
                   "{}: {} particles of the fluid at the plane have neither the zone nor a wall "
                   "behind them: rows of the zone are missing",
                   owner, all[BARE]);
}

/* ---------------------------------------------------------------------- */

void ZoneLattice::check_seat(const double *x, const OpenBand &band) const
{
  constexpr double APART = 0.5;    // over half the width of a row
  if (!in_box(lmp, x))
    error->one(FLERR,
               "{}: the zone reaches beyond the box, where a particle enters at {:g} {:g} {:g}",
               owner, x[0], x[1], x[2]);
  if (band.has_near(x, APART * half_width))
    error->one(FLERR, "{}: at {:g} {:g} {:g}, where a particle enters, there is another one", owner,
               x[0], x[1], x[2]);
}

/* ---------------------------------------------------------------------- */

void ZoneLattice::pack(double *buf) const
{
  buf[0] = unknown_sides ? 0.0 : spacing;
  buf[1] = unknown_sides ? 0.0 : half_width;
  buf[2] = static_cast<double>(over_all(world, highest, MPI_MAX));
}

void ZoneLattice::unpack(const double *buf)
{
  spacing = buf[0];
  half_width = buf[1];
  unknown_sides = (half_width == 0.0);
  highest = static_cast<tagint>(buf[2]);
}
