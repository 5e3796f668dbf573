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

#include "sph_dissipation_table.h"

#include "sph_dissipation_channels.h"
#include "sph_dissipation_solvers.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// Parts of the largest stable time step that keep the error of the energy below 1 and 0.1 percent of the kinetic energy at
// the start, for a drop far from equilibrium; the error is of second order.  unittest/python/test_lattices.py checks them

static constexpr double ONE_PERCENT_STEP = 0.15, TENTH_PERCENT_STEP = 0.05;

/* ---------------------------------------------------------------------- */

std::string CoeffTable::text(double dt) const
{
  std::string result = lines();
  if (contact < UNLIMITED_STEP)
    result += fmt::format("  largest stable time step of the contact of bodies: {:.4g}\n", contact);
  result += fmt::format(
      "  a stable time step need not be accurate: {:g} of the largest one keeps the energy within "
      "1 %, {:g} within 0.1 %\n",
      ONE_PERCENT_STEP, TENTH_PERCENT_STEP);
  if (!(std::min(viscous, heat) < UNLIMITED_STEP)) return result;
  const auto stages_for = [](double rate) {
    const double stages = RKL2::stages_for(rate);
    return (stages <= RKL2::MOST) ? fmt::format("would take {:.0f} stages", stages)
                                  : std::string("cannot be used");
  };
  const double rate = fastest_rate() * dt, of_heat = fastest_heat_rate() * dt;
  result += fmt::format("  largest stable time step with viscous explicit {:.4g}, with rkl2 or "
                        "implicit {:.4g}; the time step {:g} times the largest ",
                        smallest, acoustic, dt);
  if (rate > 0.0) result += fmt::format("viscous rate is {:.3g}: rkl2 {}", rate, stages_for(rate));
  if (rate > 0.0 && of_heat > 0.0) result += ", times that ";
  if (rate == 0.0) result += "rate ";
  if (of_heat > 0.0)
    result +=
        fmt::format("of the conduction of heat is {:.3g}: rkl2 {}", of_heat, stages_for(of_heat));
  return result + "\n";
}

/* ---------------------------------------------------------------------- */

void CoeffTable::add_contact(double step)
{
  contact = step;
  smallest = std::min(smallest, step);
  acoustic = std::min(acoustic, step);
}

/* ---------------------------------------------------------------------- */

std::string CoeffTable::skin_text(double skin, double dt, double support, int dim) const
{
  constexpr double GAIN = 0.1;
  const double motion = fastest * fabs(dt);
  if (!(motion > 0.0)) return "";
  const double best = fastest_skin(motion, support, dim);
  const double part =
      time_with_skin(best, motion, support, dim) / time_with_skin(skin, motion, support, dim);
  if (!(part < 1.0 - GAIN)) return "";
  return fmt::format(
      "  at the largest speed, {:.3g}, a neighbor list with skin {:.3g} lasts {:.0f} "
      "steps; the fastest skin is {:.2g}, with an estimated {:.0f} % less time per "
      "step\n",
      fastest, skin, std::max(1.0, ceil(0.5 * skin / motion)), best, 100.0 * (1.0 - part));
}

/* ---------------------------------------------------------------------- */

void CoeffTable::add_row(int i, int j, const TypePair &pair, const PairInertia &inertia,
                         double waves, double diffusion_rate)
{
  constexpr int NONE = -1;
  const bool spins = has_spins(pair.shear);
  const PairCoeff coeff = pair_coefficients(pair);
  Row row = {fmt::format("{}-{}", i, j), {}, {{"acoustic", NONE, waves}}};
  std::vector<double> numbers, of_motion, of_heat, of_flows;

  for (int k = 0; k < number_of_viscosities(spins); k++) {
    row.coefficients.push_back({VISCOSITY_NAMES[k], NONE, pair.viscosity[k]});
    if (k == MU) row.coefficients.push_back({"kappa", NONE, pair.zeta + intrinsic_kappa(pair)});
  }
  row.coefficients.push_back({"zeta", NONE, pair.zeta});
  int number = 0;
  Channels::visit(spins, [&](auto channel) {
    using One = decltype(channel);
    const double *const own = coeff.of<One>();
    const OwnWords words = pair.words<One>();
    const int k = number++;
    bool used = !channel.OPTIONAL;
    channel.add_columns(pair, words, own, [&](const char *name, double value) {
      row.coefficients.push_back({name, k, value});
      used = used || value != 0.0;
    });
    if (!used && rows.empty()) left_out.insert(k);
    if (used) left_out.erase(k);
    if (channel.ELASTIC) return;
    if (channel.PAIR_ENERGY) {
      waves = std::min(waves, channel.wave_step(words, inertia));
      row.steps.push_back({channel.NAME, k, channel.wave_step(words, inertia)});
      return;
    }
    numbers.push_back(SPHDissipation::viscous_step(channel.rate(pair, words, own, inertia)));
    bool stiff = true;
    if constexpr (std::is_base_of<BaseFlow, One>::value) stiff = One::STIFF;
    (channel.OF_MOTION ? of_motion : stiff ? of_heat : of_flows).push_back(numbers.back());
    row.steps.push_back({channel.NAME, k, numbers.back()});
  });
  if (diffusion_rate > 0.0) {
    numbers.push_back(SPHDissipation::viscous_step(diffusion_rate));
    row.steps.push_back({"diffusion", NONE, numbers.back()});
  }
  row.steps.push_back({"all", NONE, combined_step(waves, numbers)});
  smallest = std::min(smallest, row.steps.back().value);
  acoustic = std::min({acoustic, waves, SPHDissipation::viscous_step(diffusion_rate),
                       combined_step(UNLIMITED_STEP, of_flows)});
  viscous = std::min(viscous, combined_step(UNLIMITED_STEP, of_motion));
  dissipative = std::min(dissipative, combined_step(UNLIMITED_STEP, numbers));
  heat = std::min(heat, combined_step(UNLIMITED_STEP, of_heat));
  rows.push_back(row);
}

/* ----------------------------------------------------------------------
   Return the rows, with a header, without the columns of channels that no row uses.
------------------------------------------------------------------------- */

std::string CoeffTable::lines() const
{
  std::string header, result;
  for (const Row &row : rows) {
    std::string names = "  types   ";
    result += fmt::format("  {:<8}", row.types);
    for (const Column &one : row.coefficients) {
      if (left_out.count(one.channel)) continue;
      names += fmt::format(" {:<11}", one.name);
      result += fmt::format(" {:<11.4g}", one.value);
    }
    names += " | largest stable time step:";
    result += " |                          ";
    for (const Column &one : row.steps) {
      if (left_out.count(one.channel)) continue;
      names += fmt::format(" {:<10}", one.name);
      result += (one.value < UNLIMITED_STEP) ? fmt::format(" {:<10.4g}", one.value)
                                             : fmt::format(" {:<10}", "-");
    }
    header = names + "\n";
    result += "\n";
  }
  return header + result;
}
