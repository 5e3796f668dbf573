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

#include "sph_dissipation_open_band.h"

#include "atom.h"
#include "sph_dissipation_gather.h"
#include "sph_dissipation_open_plane.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

OpenBand::OpenBand(LAMMPS *lmp, const OpenPlane &plane, int groupbit, double lo, double hi) :
    Pointers(lmp), plane(plane), at_node(plane.nnodes())
{
  std::vector<double> mine;
  for (int i = 0; i < atom->nlocal; i++) {
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
   whether function(k, offset from x) holds for a particle k that is not farther than reach, seen along
   the normal, and perhaps for some farther ones
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

bool OpenBand::has_behind(const double *x, double beside) const
{
  return any(x, beside, [&](int k, const OpenPlane::Offset &to) {
    return of_zone[k] && to.beside < beside && to.ahead < 0.0;
  });
}

bool OpenBand::has_any_behind(const double *x, double beside) const
{
  return any(x, beside, [&](int, const OpenPlane::Offset &to) {
    return to.beside < beside && to.ahead < 0.0;
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

bool OpenBand::has_near(const double *x, double distance) const
{
  return any(x, distance, [&](int, const OpenPlane::Offset &to) {
    return to.distance() < distance;
  });
}

bool OpenBand::has_other_near(const double *x, double distance) const
{
  return any(x, distance, [&](int k, const OpenPlane::Offset &to) {
    return !of_zone[k] && to.distance() < distance;
  });
}
