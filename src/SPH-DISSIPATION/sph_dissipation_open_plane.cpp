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

#include "domain.h"
#include "error.h"
#include "fix.h"
#include "math_extra.h"
#include "modify.h"
#include "region.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

static constexpr double PARALLEL = 1.0e-10;    // sine of an angle that counts as zero

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
  for (double &component : normal) component /= largest;    // squares may be out of range
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
   Return the offset of the image with the least distance from the normal: in a box that is not orthogonal, the closest image
   along the edges may be another one.
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
   Set two directions of the plane, along periodic directions of the box if there are any in the plane.
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
    double axis[3] = {0.0, 0.0, 0.0};    // coordinate axis farthest from the normal
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

/* ---------------------------------------------------------------------- */

void OpenSamples::set_times(double averaging_time_in, double memory_in)
{
  averaging_time = averaging_time_in;
  memory = memory_in;
}

/* ---------------------------------------------------------------------- */

void OpenSamples::init()
{
  const std::size_t n = plane.nnodes();
  if (nodes.size() != n) {
    nodes.assign(n, Node());
    before = nodes;
    history.clear();
  }
  sums.assign(n, Sums());
  my_sums.assign(n, Sums());
}

/* ----------------------------------------------------------------------
   Begin to measure at a time; undo a measurement at the same time: LAMMPS computes forces again at the start of a run, and
   the fluid computes forces twice in a step with viscous rkl2 or implicit.
------------------------------------------------------------------------- */

void OpenSamples::begin(double time)
{
  std::fill(my_sums.begin(), my_sums.end(), Sums());
  bool repeated = false;
  while (!history.empty() && history.back().time >= time) {
    history.pop_back();
    repeated = true;
  }
  if (repeated)
    nodes = before;
  else
    before = nodes;
}

/* ---------------------------------------------------------------------- */

void OpenSamples::add(const double *x, double height, double volume, const OpenSample &sample,
                      Kernel kernel, double radius)
{
  const auto *const value = reinterpret_cast<const double *>(&sample);
  with_kernel(kernel, [&](auto k) {
    plane.near(x, radius, [&](int node, const double *l) {
      const double q = sqrt(height * height + l[0] * l[0] + l[1] * l[1]) / radius;
      if (q >= 1.0) return;
      const double weight = volume * k.shape(q);
      Sums &sum = my_sums[node];
      sum.weight += weight;
      sum.d += weight * height;
      sum.dd += weight * height * height;
      for (int a = 0; a < 2; a++) {
        sum.l[a] += weight * l[a];
        sum.ll[a] += weight * l[a] * l[a];
      }
      sum.ll[2] += weight * l[0] * l[1];
      for (int v = 0; v < NVALUE; v++) {
        const double part = weight * value[v];
        sum.value[v] += part;
        sum.value_d[v] += part * height;
        for (int a = 0; a < 2; a++) sum.value_l[v][a] += part * l[a];
      }
    });
    return 0;
  });
}

/* ---------------------------------------------------------------------- */

void OpenSamples::append(std::vector<double> &mine) const
{
  const auto *const first = reinterpret_cast<const double *>(my_sums.data());
  mine.insert(mine.end(), first, first + my_sums.size() * sizeof(Sums) / sizeof(double));
}

/* ---------------------------------------------------------------------- */

void OpenSamples::finish(double time, const double *all)
{
  std::copy_n(all, sums.size() * sizeof(Sums) / sizeof(double),
              reinterpret_cast<double *>(sums.data()));

  const double part = history.empty() ? 1.0
                                      : 1.0 - exp((history.back().time - time) / averaging_time);
  history.push_back({time, std::vector<double>(NWAVE * nodes.size(), 0.0)});
  for (std::size_t n = 0; n < nodes.size(); n++) {
    Node &node = nodes[n];
    node.weight = sums[n].weight;
    if (!(node.weight > 0.0)) continue;
    fit(sums[n], node);
    const double share = (node.known > 0.0) ? part : 1.0;    // averages begin with the first value
    for (int v = 0; v < NVALUE; v++) node.mean[v] += share * (node.value[v] - node.mean[v]);
    node.known = 1.0;
    std::copy_n(node.value, NWAVE, &history.back().wave[NWAVE * n]);
  }
  while (history.size() > 2 && history[1].time <= time - memory) history.pop_front();
}

/* ----------------------------------------------------------------------
   Fit a linear profile by least squares along the plane and along the normal: next to a wall, fluid is on one side of a node
   only.  The slope is 0 along a direction in which the fluid is too thin.
------------------------------------------------------------------------- */

void OpenSamples::fit(const Sums &sum, Node &node) const
{
  constexpr double THIN = 1.0e-4;    // variance over the square of the distance of nodes
  const double norm = 1.0 / sum.weight;
  const double least = THIN * plane.node_distance() * plane.node_distance();
  const double l[2] = {sum.l[0] * norm, sum.l[1] * norm}, d = sum.d * norm;
  double a = sum.ll[0] * norm - l[0] * l[0], b = sum.ll[1] * norm - l[1] * l[1];
  double c = sum.ll[2] * norm - l[0] * l[1];
  const bool first = a > least, second = b > least;
  if (!first || !second) c = 0.0;
  if (!first) a = 1.0;
  if (!second) b = 1.0;
  const double det = a * b - c * c;
  const double variance = sum.dd * norm - d * d;
  node.distance = d;
  for (int v = 0; v < NVALUE; v++) {
    const double mean = sum.value[v] * norm;
    const double along0 = first ? sum.value_l[v][0] * norm - mean * l[0] : 0.0;
    const double along1 = second ? sum.value_l[v][1] * norm - mean * l[1] : 0.0;
    const double slope0 = (b * along0 - c * along1) / det, slope1 = (a * along1 - c * along0) / det;
    node.value[v] = mean - slope0 * l[0] - slope1 * l[1];
    node.slope[v] = (variance > least) ? (sum.value_d[v] * norm - mean * d) / variance : 0.0;
  }
}

/* ----------------------------------------------------------------------
   Set the values to the weighted means of of_node(node, k) over the nodes with fluid around a place; set zero and return
   false if there are no such nodes.
------------------------------------------------------------------------- */

template <class Function>
bool OpenSamples::interpolate(const Spot &spot, int nvalue, double *value, Function &&of_node) const
{
  double total = 0.0;
  std::fill_n(value, nvalue, 0.0);
  for (int c = 0; c < spot.n; c++) {
    if (!(nodes[spot.node[c]].weight > 0.0)) continue;
    for (int k = 0; k < nvalue; k++) value[k] += spot.weight[c] * of_node(spot.node[c], k);
    total += spot.weight[c];
  }
  if (!(total > 0.0)) return false;
  for (int k = 0; k < nvalue; k++) value[k] /= total;
  return true;
}

/* ---------------------------------------------------------------------- */

bool OpenSamples::now(const Spot &spot, double height, int order, OpenSample &result) const
{
  return interpolate(spot, NVALUE, reinterpret_cast<double *>(&result), [&](int n, int k) {
    const double ahead = (order > 0) ? height - nodes[n].distance : 0.0;
    return nodes[n].value[k] + ahead * nodes[n].slope[k];
  });
}

/* ---------------------------------------------------------------------- */

bool OpenSamples::average(const Spot &spot, OpenSample &result) const
{
  return interpolate(spot, NVALUE, reinterpret_cast<double *>(&result), [&](int n, int k) {
    return nodes[n].mean[k];
  });
}

/* ----------------------------------------------------------------------
   Interpolate the wave between two times of the history, or return the first or the last wave.
------------------------------------------------------------------------- */

OpenWave OpenSamples::wave(const Spot &spot, double time) const
{
  if (history.empty()) return {0.0, 0.0};
  const auto after =
      std::lower_bound(history.begin(), history.end(), time, [](const Past &past, double t) {
        return past.time < t;
      });
  const Past &b = (after == history.end()) ? history.back() : *after;
  const Past &a = (after == history.end() || after == history.begin()) ? b : *(after - 1);
  const double part = (b.time > a.time) ? (time - a.time) / (b.time - a.time) : 0.0;

  OpenWave value;
  interpolate(spot, NWAVE, reinterpret_cast<double *>(&value), [&](int n, int k) {
    const int one = NWAVE * n + k;
    return a.wave[one] + part * (b.wave[one] - a.wave[one]);
  });
  return value;
}

/* ---------------------------------------------------------------------- */

double OpenSamples::distance(const Spot &spot) const
{
  double value;
  interpolate(spot, 1, &value, [&](int n, int) {
    return nodes[n].distance;
  });
  return value;
}

/* ---------------------------------------------------------------------- */

void OpenSamples::mean_at_plane(double *p, double *u) const
{
  double total = 0.0;
  *p = u[0] = u[1] = u[2] = 0.0;
  for (const auto &sum : sums) {
    OpenSample value;
    std::copy_n(sum.value, static_cast<int>(NVALUE), reinterpret_cast<double *>(&value));
    total += sum.weight;
    *p += value.p;
    for (int d = 0; d < 3; d++) u[d] += value.u[d];
  }
  if (!(total > 0.0)) return;
  *p /= total;
  for (int d = 0; d < 3; d++) u[d] /= total;
}

/* ---------------------------------------------------------------------- */

double OpenSamples::memory_usage() const
{
  return static_cast<double>(
      nodes.size() *
      (2 * sizeof(Sums) + 2 * sizeof(Node) + history.size() * NWAVE * sizeof(double)));
}

/* ---------------------------------------------------------------------- */

std::vector<double> OpenSamples::pack() const
{
  std::vector<double> buf = {static_cast<double>(nodes.size()),
                             static_cast<double>(history.size())};
  for (const auto *const all : {&nodes, &before})
    for (const Node &node : *all) {
      const auto *const from = reinterpret_cast<const double *>(&node);
      buf.insert(buf.end(), from, from + sizeof(Node) / sizeof(double));
    }
  for (const auto &past : history) {
    buf.push_back(past.time);
    buf.insert(buf.end(), past.wave.begin(), past.wave.end());
  }
  return buf;
}

/* ---------------------------------------------------------------------- */

bool OpenSamples::unpack(const std::vector<double> &state)
{
  constexpr std::size_t WIDTH = sizeof(Node) / sizeof(double);
  const std::size_t n = nodes.size();
  if (state.size() < 2 || static_cast<std::size_t>(state[0]) != n) return false;
  const auto npast = static_cast<std::size_t>(state[1]);
  if (state.size() != 2 + 2 * n * WIDTH + npast * (1 + NWAVE * n)) return false;
  const double *buf = state.data() + 2;
  for (auto *const all : {&nodes, &before})
    for (Node &node : *all) {
      std::copy_n(buf, WIDTH, reinterpret_cast<double *>(&node));
      buf += WIDTH;
    }
  history.clear();
  for (std::size_t k = 0; k < npast; k++, buf += 1 + NWAVE * n)
    history.push_back({buf[0], std::vector<double>(buf + 1, buf + 1 + NWAVE * n)});
  return true;
}
