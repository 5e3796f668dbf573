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

#include "atom.h"
#include "math_extra.h"
#include "sph_dissipation_boundary_stage.h"
#include "sph_dissipation_channels.h"
#include "sph_dissipation_contact.h"
#include "sph_dissipation_diffusion_terms.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_eos.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_kernel.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_particle_terms.h"
#include "sph_dissipation_solvers.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// Parts of the largest stable time step that keep the error of the energy below 1 and 0.1 percent of the kinetic energy at
// the start, for a drop far from equilibrium; the error is of second order.  unittest/python/test_lattices.py checks both

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

/* ----------------------------------------------------------------------
   Return the coefficients and the largest stable time steps of the pairs of types, for the fluid as it is now.  All code
   that needs the largest stable time step calls this function.  Of each type it takes the fastest particle, walls included,
   with the speed of sound at its density and energy, and the smallest density of the fluid.  A type without particles
   counts with its coefficients.
   A heavy body pushes light fluid with its own modulus: its sound counts as sound in the light fluid, times 1/2, since the
   body fills half of the kernel.  Walls act with the pressure of the fluid, and the pressure does not move walls: neither
   the speed of sound nor the density of their type counts.
------------------------------------------------------------------------- */

CoeffTable Stability::table() const
{
  const double inertia = smallest_inertia();
  const int n = atom->ntypes;
  const Eos eos = model.choice.eos;
  // maxima of v + acting c, c, acting c, v, rho0/rho (0: no fluid), and 0 fluid, 1 wall, 2 body
  enum { SPEED, SOUND, ACTING, MOTION, THINNESS, KIND, NMOST };
  std::vector<double> mine(NMOST * (n + 1), 0.0), all(NMOST * (n + 1));
  const auto most = [n](std::vector<double> &of, int what, int type) -> double & {
    return of[what * (n + 1) + type];
  };

  // the place of type 0, which does not exist, has the maximum of all types

  double &fastest = most(mine, MOTION, 0);
  const auto sound_of = sound();
  const double lightest = boundary.has_bodies() ? lightest_fluid() : 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    const int type = atom->type[i];
    const TypeCoeff &coeff = model.coeffs[type];
    if (coeff.other) continue;
    const double rho = atom->rho[i], c = sound_of(i, rho), v = MathExtra::len3(atom->v[i]);
    const bool body = boundary.is_body(i);
    const double acting = body ? c * std::max(1.0, 0.5 * sqrt(coeff.eos.rho0 / lightest)) : c;
    fastest = std::max(fastest, v);
    const bool fluid = !boundary.is_boundary(i);
    const double values[NMOST] = {acting + v,
                                  c,
                                  acting,
                                  v,
                                  fluid ? coeff.eos.rho0 / rho : 0.0,
                                  body ? 2.0 : fluid ? 0.0 : 1.0};
    for (int k = 0; k < NMOST; k++) most(mine, k, type) = std::max(most(mine, k, type), values[k]);
  }
  MPI_Allreduce(mine.data(), all.data(), NMOST * (n + 1), MPI_DOUBLE, MPI_MAX, world);
  std::vector<bool> walls_alone(n + 1);
  double slowest = HUGE_VAL, thinnest = HUGE_VAL;    // of the fluid
  for (int i = 1; i <= n; i++) {
    const bool empty = (most(all, SPEED, i) == 0.0), fluid = (most(all, THINNESS, i) > 0.0);
    walls_alone[i] = !fluid && most(all, KIND, i) == 1.0;
    if (fluid) {
      slowest = std::min(slowest, most(all, SOUND, i));
      thinnest = std::min(thinnest, model.coeffs[i].eos.rho0 / most(all, THINNESS, i));
    }
    if (empty && eos != Eos::IDEAL)
      most(all, SPEED, i) = most(all, SOUND, i) = most(all, ACTING, i) = model.coeffs[i].eos.c0;
    if (!fluid) most(all, THINNESS, i) = 1.0;
  }
  for (int i = 1; i <= n; i++)
    if (walls_alone[i] && most(all, ACTING, i) > slowest) {
      most(all, ACTING, i) = slowest;
      most(all, SPEED, i) = most(all, MOTION, i) + slowest;
    }
  const auto density = [&](int i) {
    return walls_alone[i] ? HUGE_VAL : model.coeffs[i].eos.rho0 / most(all, THINNESS, i);
  };

  const double h = length(), hsq = h * h;
  CoeffTable table(most(all, MOTION, 0));
  const auto sound_step = [&](int type) {
    const double speed = most(all, SPEED, type), c = most(all, ACTING, type);
    return acoustic_step(h, speed, [&](double dt) {
      const double more = model.stiffness(type, dt);
      return (more > 0.0) ? most(all, MOTION, type) + sqrt(c * c + more) - speed : 0.0;
    });
  };
  for (int i = 1; i <= n; i++)
    for (int j = i; j <= n; j++) {
      const TypeCoeff &a = model.coeffs[i], &b = model.coeffs[j];
      if (a.other || b.other) continue;
      const double least = std::min(density(i), density(j));
      const double rho = (least < HUGE_VAL) ? least : (thinnest < HUGE_VAL) ? thinnest : a.eos.rho0;
      PairInertia damped;
      damped.hsq = hsq;
      damped.rho = rho;
      damped.rho_inertia = rho * inertia;
      damped.surface = boundary.has_symmetric_friction();
      double diffusion_of = 0.0;
      if (model.choice.delta > 0.0) {
        const auto stiffness = [&](int type) {
          const double c = most(all, SOUND, type);
          return model.coeffs[type].eos.rho0 * c * c;
        };
        diffusion_of = diffusion_rate(model.choice.delta, 0.5 * model.constants().support, hsq,
                                      std::max(stiffness(i), stiffness(j)),
                                      0.5 * (a.eos.impedance() + b.eos.impedance()));
      }
      table.add_row(i, j, model.pair_fluid(i, j), damped, std::min(sound_step(i), sound_step(j)),
                    diffusion_of);
    }
  if (boundary.has_contact()) table.add_contact(contact.largest_step());
  return table;
}

/* ----------------------------------------------------------------------
   Return the smallest reference density of the types of fluid particles, of all ranks; infinity without such particles.
------------------------------------------------------------------------- */

double Stability::lightest_fluid() const
{
  double mine = HUGE_VAL;
  for (int i = 0; i < atom->nlocal; i++)
    if (model.has_type(atom->type[i]) && !boundary.is_boundary(i))
      mine = std::min(mine, model.coeffs[atom->type[i]].eos.rho0);
  return over_all(world, mine, MPI_MIN);
}

/* ----------------------------------------------------------------------
   Return the function (i, rho) with the speed of sound of owned particle i at density rho, with its heat as it is now and
   its states frozen; c0 for walls of a liquid, which have no heat.
------------------------------------------------------------------------- */

std::function<double(int, double)> Stability::sound() const
{
  return [this, states = engine.states()](int i, double rho) {
    const Eos eos = model.choice.eos;
    const EosParams &par = model.coeffs[atom->type[i]].eos;
    if (boundary.is_boundary(i) && eos != Eos::IDEAL && par.gruneisen > 0.0) return par.c0;
    const double q = (atom->esph[i] - states.energy(i)) / atom->rmass[i] -
        SPHDissipation::elastic_energy(eos, par, atom->rho[i]);
    return sound_speed(eos, par, rho, SPHDissipation::elastic_energy(eos, par, rho) + q);
  };
}

/* ----------------------------------------------------------------------
   Return the smallest moment of inertia > 0 per mass, length^2, of all particles; UNLIMITED_STEP if there is none.
------------------------------------------------------------------------- */

double Stability::smallest_inertia() const
{
  double mine = UNLIMITED_STEP;
  if (model.constants().spins()) {
    const double *const inertia = Fields::of(atom)->inertia;
    for (int i = 0; i < atom->nlocal; i++)
      if (inertia[i] > 0.0 && model.has_type(atom->type[i])) mine = std::min(mine, inertia[i]);
  }
  return over_all(world, mine, MPI_MIN);
}

/* ---------------------------------------------------------------------- */

double Stability::length() const
{
  const Constants &par = model.constants();
  return sqrt(stability_length_squared(kernel_slope_integral(par.kernel, par.dim, par.support)));
}

/* ---------------------------------------------------------------------- */

double Stability::fall_time() const
{
  double mine = 0.0, largest;    // acceleration
  for (int i = 0; i < atom->nlocal; i++)
    if (model.has_type(atom->type[i]) && !boundary.is_boundary(i))
      mine = std::max(mine, MathExtra::len3(atom->f[i]) / atom->rmass[i]);
  MPI_Allreduce(&mine, &largest, 1, MPI_DOUBLE, MPI_MAX, world);
  return (largest > 0.0) ? sqrt(length() / largest) : UNLIMITED_STEP;
}
