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

#include "sph_dissipation_open_plane.h"

#include "domain.h"
#include "error.h"
#include "fix.h"
#include "math_extra.h"
#include "modify.h"
#include "region.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

static constexpr double PARALLEL = 1.0e-10;    // sine of an angle that counts as zero

/* ---------------------------------------------------------------------- */

OpenPlane::OpenPlane(LAMMPS *lmp, const std::string &owner) :
    Pointers(lmp), point{0.0, 0.0, 0.0}, normal{1.0, 0.0, 0.0}, length(0.0), owner(owner),
    region(nullptr), tangent(), lo{0.0, 0.0}, step{1.0, 1.0}, count{1, 1}, periodic{false, false}
{
}

/* ---------------------------------------------------------------------- */

void OpenPlane::set(char **arg)
{
  for (int d = 0; d < 3; d++) {
    point[d] = utils::numeric(FLERR, arg[d], false, lmp);
    normal[d] = utils::numeric(FLERR, arg[3 + d], false, lmp);
  }
  length = utils::numeric(FLERR, arg[6], false, lmp);
  double largest = 0.0;
  for (const double component : normal) largest = std::max(largest, fabs(component));
  if (!(largest > 0.0)) error->all(FLERR, "{}: the normal of the plane must not be zero", owner);
  if (domain->dimension == 2 && normal[2] != 0.0)
    error->all(FLERR, "{}: the normal of the plane must lie in the xy plane in 2d", owner);
  if (!(length > 0.0)) error->all(FLERR, "{}: length must be > 0, not {}", owner, arg[6]);
  for (double &component : normal) component /= largest;    // whose square may be out of range
  MathExtra::norm3(normal);
}

/* ---------------------------------------------------------------------- */

void OpenPlane::init()
{
  region = nullptr;
  if (!region_id.empty()) {
    region = domain->get_region_by_id(region_id);
    if (!region) error->all(FLERR, "{}: region {} does not exist", owner, region_id);
    if (region->dynamic_check())
      error->all(FLERR, "{}: region {} must not move or change", owner, region_id);
    region->prematch();
  }
  check_box();
  set_tangents();
}

/* ---------------------------------------------------------------------- */

bool OpenPlane::beside(const double *x) const
{
  return region && !region->match(x[0], x[1], x[2]);
}

bool OpenPlane::beside(const double *x, double slack) const
{
  if (!beside(x)) return false;
  for (const double *const side : {tangent[0], tangent[1]})
    for (const double shift : {slack, -slack}) {
      double near[3];
      for (int d = 0; d < 3; d++) near[d] = x[d] + shift * side[d];
      if (!beside(near)) return false;
    }
  return true;
}

/* ----------------------------------------------------------------------
   In a box that is not orthogonal, the image that is closest along its edges need not be the one that is
   least beside the normal
------------------------------------------------------------------------- */

OpenPlane::Offset OpenPlane::offset(const double *from, const double *to) const
{
  double image[3], r[3];
  domain->closest_image(from, to, image);
  MathExtra::sub3(image, from, r);
  for (int k = 0; k < 2; k++) {
    if (!periodic[k]) continue;
    const double period = count[k] * step[k];
    const double beside = period * std::round(MathExtra::dot3(r, tangent[k]) / period);
    for (int d = 0; d < 3; d++) r[d] -= beside * tangent[k][d];
  }
  const double ahead = MathExtra::dot3(r, normal);
  return {sqrt(std::max(MathExtra::lensq3(r) - ahead * ahead, 0.0)), ahead};
}

/* ---------------------------------------------------------------------- */

bool OpenPlane::is_at(const double *place) const
{
  for (int d = 0; d < 3; d++)
    if (place[d] != point[d] || place[3 + d] != normal[d]) return false;
  return true;
}

/* ---------------------------------------------------------------------- */

void OpenPlane::check_box() const
{
  for (int d = 0; d < domain->dimension; d++)
    if ((domain->boundary[d][0] > 1 || domain->boundary[d][1] > 1) && fabs(normal[d]) > PARALLEL)
      error->all(FLERR,
                 "{}: the box must not be shrink-wrapped across the zone, use boundary f for {}",
                 owner, "xyz"[d]);
  for (const auto &ifix : modify->get_fix_list())
    if (ifix->box_change & ~Fix::BOX_CHANGE_DOMAIN)
      error->all(FLERR, "{} cannot be used with fix {}, which changes the box", owner, ifix->style);
}

/* ----------------------------------------------------------------------
   along the periodic directions of the box, if there are any in the plane
------------------------------------------------------------------------- */

void OpenPlane::set_tangents()
{
  const double *const h = domain->h;
  double edge[3][3] = {{h[0], 0.0, 0.0}, {0.0, h[1], 0.0}, {0.0, 0.0, h[2]}};
  if (domain->triclinic) {
    edge[1][0] = h[5];
    edge[2][0] = h[4];
    edge[2][1] = h[3];
  }

  int known = 0;
  double period[2] = {0.0, 0.0};
  for (int d = 0; d < domain->dimension; d++) {
    if (!domain->periodicity[d]) continue;
    const double size = MathExtra::len3(edge[d]);
    if (fabs(MathExtra::dot3(edge[d], normal)) > PARALLEL * size) {
      if (region) continue;
      error->all(
          FLERR,
          "{}: the box is periodic in {} and the plane crosses that direction; give the zone "
          "a region or make the boundary f",
          owner, "xyz"[d]);
    }
    if (known == 1 && fabs(MathExtra::dot3(edge[d], tangent[0])) > PARALLEL * size)
      error->all(FLERR, "{}: periodic directions in the plane must be perpendicular", owner);
    for (int k = 0; k < 3; k++) tangent[known][k] = edge[d][k] / size;
    period[known++] = size;
  }

  if (known == 0) {
    double axis[3] = {0.0, 0.0, 0.0};    // the one farthest from the normal
    if (domain->dimension == 2)
      axis[2] = 1.0;
    else
      axis[std::min_element(normal, normal + 3,
                            [](double a, double b) {
                              return fabs(a) < fabs(b);
                            }) -
           normal] = 1.0;
    MathExtra::cross3(axis, normal, tangent[0]);
    MathExtra::norm3(tangent[0]);
  }
  if (known < 2) MathExtra::cross3(normal, tangent[0], tangent[1]);
  for (int k = 0; k < 2; k++) {
    periodic[k] = (period[k] > 0.0);
    count[k] = 1;
    step[k] = period[k];
  }
}

/* ---------------------------------------------------------------------- */

void OpenPlane::set_nodes(double distance)
{
  double boxlo[3], boxhi[3];
  for (int d = 0; d < 3; d++) {
    boxlo[d] = domain->triclinic ? domain->boxlo_bound[d] : domain->boxlo[d];
    boxhi[d] = domain->triclinic ? domain->boxhi_bound[d] : domain->boxhi[d];
  }
  if (region && region->bboxflag) {
    const double regionlo[3] = {region->extent_xlo, region->extent_ylo, region->extent_zlo};
    const double regionhi[3] = {region->extent_xhi, region->extent_yhi, region->extent_zhi};
    for (int d = 0; d < 3; d++) {
      boxlo[d] = std::max(boxlo[d], regionlo[d]);
      boxhi[d] = std::min(boxhi[d], regionhi[d]);
    }
  }

  for (int k = 0; k < 2; k++) {
    lo[k] = 0.0;
    double least = 1.0e300, most = -1.0e300;
    for (int corner = 0; corner < 8; corner++) {
      double x[3];
      for (int d = 0; d < 3; d++) x[d] = (corner >> d & 1) ? boxhi[d] : boxlo[d];
      least = std::min(least, along(k, x));
      most = std::max(most, along(k, x));
    }
    if (k == 1 && domain->dimension == 2) {
      count[k] = 1;
      step[k] = 1.0;
      periodic[k] = false;
      continue;
    }
    lo[k] = least;
    const double extent = periodic[k] ? step[k] : most - least;
    const int parts = std::max(static_cast<int>(std::ceil(extent / distance)), 1);
    count[k] = periodic[k] ? parts : parts + 1;
    step[k] = extent / parts;
  }
}

/* ---------------------------------------------------------------------- */

double OpenPlane::along(int k, const double *x) const
{
  return MathExtra::dot3(x, tangent[k]) - lo[k];
}

/* ---------------------------------------------------------------------- */

int OpenPlane::wrap(int k, int n) const
{
  if (n >= 0 && n < count[k]) return n;
  if (!periodic[k]) return (n < 0) ? 0 : count[k] - 1;
  return (n % count[k] + count[k]) % count[k];
}

/* ---------------------------------------------------------------------- */

OpenPlane::Spot OpenPlane::spot(const double *x) const
{
  int n[2], sides[2];
  double part[2];
  for (int k = 0; k < 2; k++) {
    sides[k] = (count[k] == 1) ? 1 : 2;
    const double at = (count[k] == 1) ? 0.0 : along(k, x) / step[k];
    n[k] = static_cast<int>(std::floor(at));
    part[k] = at - n[k];
  }
  Spot spot;
  spot.n = 0;
  for (int m = 0; m < sides[1]; m++)
    for (int l = 0; l < sides[0]; l++) {
      spot.node[spot.n] = wrap(1, n[1] + m) * count[0] + wrap(0, n[0] + l);
      spot.weight[spot.n] = (m ? part[1] : 1.0 - part[1]) * (l ? part[0] : 1.0 - part[0]);
      spot.n++;
    }
  return spot;
}
