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

#include "sph_dissipation_open_samples.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

OpenSamples::OpenSamples(LAMMPS *lmp, const OpenPlane &plane) :
    Pointers(lmp), plane(plane), averaging_time(0.0), memory(0.0)
{
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
   Forces are computed again at the start of a run, and twice in a step with a viscous stage: what the
   first time found is taken back.
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

void OpenSamples::finish(double time)
{
  MPI_Allreduce(my_sums.data(), sums.data(),
                static_cast<int>(sizeof(Sums) / sizeof(double)) * plane.nnodes(), MPI_DOUBLE,
                MPI_SUM, world);

  const double part = history.empty() ? 1.0
                                      : 1.0 - exp((history.back().time - time) / averaging_time);
  history.push_back({time, std::vector<double>(nodes.size(), 0.0)});
  for (std::size_t n = 0; n < nodes.size(); n++) {
    Node &node = nodes[n];
    node.weight = sums[n].weight;
    if (!(node.weight > 0.0)) continue;
    fit(sums[n], node);
    const double share = (node.known > 0.0) ? part : 1.0;    // averages begin with the first value
    for (int v = 0; v < NVALUE; v++) node.mean[v] += share * (node.value[v] - node.mean[v]);
    node.known = 1.0;
    history.back().wave[n] = node.value[0];
  }
  while (history.size() > 2 && history[1].time <= time - memory) history.pop_front();
}

/* ----------------------------------------------------------------------
   least squares: along the plane, so that next to a wall, where there is fluid on one side only, a
   linear profile is found as it is, and along the normal.  No slope where the fluid is too thin.
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
   function(node, weight) for the nodes with fluid around a place; returns the sum of their weights
------------------------------------------------------------------------- */

template <class Function>
double OpenSamples::interpolate(const Spot &spot, Function &&function) const
{
  double total = 0.0;
  for (int c = 0; c < spot.n; c++) {
    if (!(nodes[spot.node[c]].weight > 0.0)) continue;
    function(spot.node[c], spot.weight[c]);
    total += spot.weight[c];
  }
  return total;
}

/* ---------------------------------------------------------------------- */

bool OpenSamples::now(const Spot &spot, double height, int order, OpenSample &result) const
{
  double value[NVALUE] = {};
  const double total = interpolate(spot, [&](int n, double weight) {
    const Node &node = nodes[n];
    const double ahead = (order > 0) ? height - node.distance : 0.0;
    for (int v = 0; v < NVALUE; v++) value[v] += weight * (node.value[v] + ahead * node.slope[v]);
  });
  if (!(total > 0.0)) return false;
  auto *const to = reinterpret_cast<double *>(&result);
  for (int v = 0; v < NVALUE; v++) to[v] = value[v] / total;
  return true;
}

/* ---------------------------------------------------------------------- */

bool OpenSamples::average(const Spot &spot, OpenSample &result) const
{
  double value[NVALUE] = {};
  const double total = interpolate(spot, [&](int n, double weight) {
    for (int v = 0; v < NVALUE; v++) value[v] += weight * nodes[n].mean[v];
  });
  if (!(total > 0.0)) return false;
  auto *const to = reinterpret_cast<double *>(&result);
  for (int v = 0; v < NVALUE; v++) to[v] = value[v] / total;
  return true;
}

/* ----------------------------------------------------------------------
   between two times that are known, or at the first or the last one
------------------------------------------------------------------------- */

double OpenSamples::wave(const Spot &spot, double time) const
{
  if (history.empty()) return 0.0;
  const auto after =
      std::lower_bound(history.begin(), history.end(), time, [](const Past &past, double t) {
        return past.time < t;
      });
  const Past &b = (after == history.end()) ? history.back() : *after;
  const Past &a = (after == history.end() || after == history.begin()) ? b : *(after - 1);
  const double part = (b.time > a.time) ? (time - a.time) / (b.time - a.time) : 0.0;

  double value = 0.0;
  const double total = interpolate(spot, [&](int n, double weight) {
    value += weight * (a.wave[n] + part * (b.wave[n] - a.wave[n]));
  });
  return (total > 0.0) ? value / total : 0.0;
}

/* ---------------------------------------------------------------------- */

double OpenSamples::distance(const Spot &spot) const
{
  double value = 0.0;
  const double total = interpolate(spot, [&](int n, double weight) {
    value += weight * nodes[n].distance;
  });
  return (total > 0.0) ? value / total : 0.0;
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
      nodes.size() * (2 * sizeof(Sums) + 2 * sizeof(Node) + history.size() * sizeof(double)));
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
  if (state.size() != 2 + 2 * n * WIDTH + npast * (1 + n)) return false;
  const double *buf = state.data() + 2;
  for (auto *const all : {&nodes, &before})
    for (Node &node : *all) {
      std::copy_n(buf, WIDTH, reinterpret_cast<double *>(&node));
      buf += WIDTH;
    }
  history.clear();
  for (std::size_t k = 0; k < npast; k++, buf += n + 1)
    history.push_back({buf[0], std::vector<double>(buf + 1, buf + 1 + n)});
  return true;
}
