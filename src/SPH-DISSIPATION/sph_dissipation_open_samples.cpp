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

static constexpr int NSUM = sizeof(NodeSum) / sizeof(double);

/* ----------------------------------------------------------------------
   least squares; of one layer of particles only the mean is known
------------------------------------------------------------------------- */

double SPHDissipation::continued(const NodeSum &node, double sum, double sum_d, double height,
                                 int order)
{
  constexpr double THIN = 1.0e-3;    // variance of d over its square
  const double mean = sum / node.weight, d = node.d / node.weight;
  const double variance = node.d2 / node.weight - d * d;
  if (order == 0 || !(variance > THIN * d * d)) return mean;
  const double slope = (sum_d / node.weight - d * mean) / variance;
  return mean + slope * (height - d);
}

/* ---------------------------------------------------------------------- */

OpenSamples::OpenSamples(LAMMPS *lmp, const OpenPlane &plane) :
    Pointers(lmp), plane(plane), averaging_time(0.0), memory(0.0)
{
}

/* ---------------------------------------------------------------------- */

void OpenSamples::init(double averaging_time_in, double memory_in)
{
  averaging_time = averaging_time_in;
  memory = memory_in;
  const std::size_t n = plane.nnodes();
  if (mean.size() != NMEAN * n) {
    mean.assign(NMEAN * n, 0.0);
    history.clear();
  }
  sums.assign(n, NodeSum());
  my_sums.assign(n, NodeSum());
}

/* ---------------------------------------------------------------------- */

void OpenSamples::begin()
{
  std::fill(sums.begin(), sums.end(), NodeSum());
}

/* ----------------------------------------------------------------------
   a force computation that is repeated, at the start of a run, replaces what it found before
------------------------------------------------------------------------- */

void OpenSamples::finish(double time)
{
  my_sums = sums;
  MPI_Allreduce(my_sums.data(), sums.data(), NSUM * plane.nnodes(), MPI_DOUBLE, MPI_SUM, world);

  while (!history.empty() && history.back().time >= time) history.pop_back();
  update_means(history.empty() ? 0.0 : time - history.back().time);

  history.push_back({time, std::vector<double>(sums.size(), 0.0)});
  for (std::size_t n = 0; n < sums.size(); n++)
    if (sums[n].weight > 0.0) history.back().wave[n] = sums[n].wave / sums[n].weight;
  while (history.size() > 2 && history[1].time <= time - memory) history.pop_front();
}

/* ----------------------------------------------------------------------
   exponential averages, as long as the time that has been sampled, at most averaging_time
------------------------------------------------------------------------- */

void OpenSamples::update_means(double elapsed)
{
  const double part = history.empty() ? 1.0 : 1.0 - exp(-elapsed / averaging_time);
  for (std::size_t n = 0; n < sums.size(); n++) {
    if (!(sums[n].weight > 0.0)) continue;
    const double now[NMEAN] = {sums[n].u[0], sums[n].u[1], sums[n].u[2], sums[n].p, sums[n].wave};
    for (int k = 0; k < NMEAN; k++)
      mean[NMEAN * n + k] += part * (now[k] / sums[n].weight - mean[NMEAN * n + k]);
  }
}

/* ---------------------------------------------------------------------- */

NodeSum OpenSamples::at(const double *x) const
{
  OpenPlane::Corner corner[OpenPlane::CORNERS];
  plane.corners(x, corner);
  NodeSum total = NodeSum();
  auto *const to = reinterpret_cast<double *>(&total);
  for (const auto &one : corner) {
    const auto *const from = reinterpret_cast<const double *>(&sums[one.node]);
    for (int k = 0; k < NSUM; k++) to[k] += one.weight * from[k];
  }
  return total;
}

/* ---------------------------------------------------------------------- */

double OpenSamples::wave(const double *x, double time) const
{
  if (history.empty()) return 0.0;
  OpenPlane::Corner corner[OpenPlane::CORNERS];
  plane.corners(x, corner);
  double total = 0.0, weight = 0.0;
  for (const auto &one : corner) {
    const double part = one.weight * sums[one.node].weight;
    if (!(part > 0.0)) continue;
    total += part * node_wave(one.node, time);
    weight += part;
  }
  return (weight > 0.0) ? total / weight : 0.0;
}

/* ---------------------------------------------------------------------- */

double OpenSamples::node_wave(int node, double time) const
{
  const auto after =
      std::lower_bound(history.begin(), history.end(), time, [](const Past &past, double t) {
        return past.time < t;
      });
  if (after == history.end()) return history.back().wave[node];
  if (after == history.begin()) return history.front().wave[node];
  const Past &a = *(after - 1), &b = *after;
  const double part = (time - a.time) / (b.time - a.time);
  return a.wave[node] + part * (b.wave[node] - a.wave[node]);
}

/* ---------------------------------------------------------------------- */

bool OpenSamples::average(const double *x, Average &result) const
{
  OpenPlane::Corner corner[OpenPlane::CORNERS];
  plane.corners(x, corner);
  double total[NMEAN] = {}, weight = 0.0;
  for (const auto &one : corner) {
    const double part = one.weight * sums[one.node].weight;
    for (int k = 0; k < NMEAN; k++) total[k] += part * mean[NMEAN * one.node + k];
    weight += part;
  }
  if (!(weight > 0.0)) return false;
  for (double &value : total) value /= weight;
  result = {{total[0], total[1], total[2]}, total[3], total[4]};
  return true;
}

/* ---------------------------------------------------------------------- */

void OpenSamples::mean_at_plane(double *p, double *u) const
{
  double weight = 0.0;
  *p = u[0] = u[1] = u[2] = 0.0;
  for (const auto &node : sums) {
    weight += node.weight;
    *p += node.p;
    for (int d = 0; d < 3; d++) u[d] += node.u[d];
  }
  if (!(weight > 0.0)) return;
  *p /= weight;
  for (int d = 0; d < 3; d++) u[d] /= weight;
}

/* ---------------------------------------------------------------------- */

double OpenSamples::memory_usage() const
{
  return static_cast<double>((2 * NSUM + NMEAN + history.size()) * sums.size() * sizeof(double));
}

/* ---------------------------------------------------------------------- */

std::vector<double> OpenSamples::pack() const
{
  const std::size_t n = plane.nnodes();
  std::vector<double> buf = {static_cast<double>(n), static_cast<double>(history.size())};
  for (const auto &one : sums) buf.insert(buf.end(), {one.weight, one.d});
  buf.insert(buf.end(), mean.begin(), mean.end());
  for (const auto &past : history) {
    buf.push_back(past.time);
    buf.insert(buf.end(), past.wave.begin(), past.wave.end());
  }
  return buf;
}

/* ---------------------------------------------------------------------- */

bool OpenSamples::unpack(const double *buf, int nbuf)
{
  const std::size_t n = sums.size();
  if (nbuf < 2 || static_cast<std::size_t>(buf[0]) != n) return false;
  const auto npast = static_cast<std::size_t>(buf[1]);
  if (static_cast<std::size_t>(nbuf) != 2 + n * (2 + NMEAN) + npast * (1 + n)) return false;
  buf += 2;
  for (auto &one : sums) {
    one.weight = *buf++;
    one.d = *buf++;
  }
  mean.assign(buf, buf + NMEAN * n);
  buf += NMEAN * n;
  history.clear();
  for (std::size_t k = 0; k < npast; k++, buf += n + 1)
    history.push_back({buf[0], std::vector<double>(buf + 1, buf + 1 + n)});
  return true;
}
