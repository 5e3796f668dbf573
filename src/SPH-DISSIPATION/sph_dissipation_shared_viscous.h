/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#ifndef LMP_SPH_DISSIPATION_SHARED_VISCOUS_H
#define LMP_SPH_DISSIPATION_SHARED_VISCOUS_H

// Functions of StiffStage and ViscousStage, on the host and on a device; included by the sources that compile them

#include "platform.h"
#include "sph_dissipation_boundary_stage.h"
#include "sph_dissipation_integrate.h"
#include "sph_dissipation_shared_stages.h"
#include "sph_dissipation_viscous.h"

#include <cfloat>
#include <cmath>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Find x from before, guess, and force.

  template <class Space> void StiffStage<Space>::solve_step()
  {
    scheme.begin();
    if (this->update->setupflag)
      start();
    else
      step(this->update->dt);
    scheme.end();
  }

  template <class Space> void StiffStage<Space>::resize()
  {
    for (Values *one : {&mass, &inverse_mass, &x, &residual, &before, &guess, &force})
      Space::reach(*one, "sph:unknowns", count());
  }

  template <class Space> double *StiffStage<Space>::room(int k)
  {
    return Space::reach(rooms[k], "sph:unknowns", count());
  }

  // Set out = (M + h Gamma) in.

  template <class Space> void StiffStage<Space>::apply(const double *in, double *out)
  {
    scheme.statistics[StiffScheme::APPLICATIONS] += 1.0;
    friction(in, out);
    const double *const m = mass.data();
    const double interval = h;
    for_each(SPH_LAMBDA(int k) { out[k] = m[k] * in[k] + interval * out[k]; });
  }

  template <class Space> void StiffStage<Space>::sum(double *values, int n) const
  {
    MPI_Allreduce(MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_SUM, this->world);
  }

  // Solve (M + h Gamma) x = residual.

  template <class Space> void StiffStage<Space>::solve()
  {
    double *const solution = x.data();
    for_each(SPH_LAMBDA(int k) { solution[k] = 0.0; });
    const ViscousSettings &settings = scheme.choice();
    Krylov<StiffStage<Space>> krylov(*this, settings.tolerance, settings.iterations);
    scheme.note(symmetric ? krylov.conjugate_gradients() : krylov.bi_conjugate_gradients());
  }

  // Find x = y_b - guess for a step of this length.

  template <class Space> void StiffStage<Space>::step(double interval)
  {
    const ViscousSettings &settings = scheme.choice();
    if (settings.mode == Viscous::RKL2)
      rkl2_step(interval);
    else if (settings.scheme == Scheme::SDIRK2)
      sdirk2_step(interval);
    else
      implicit_step((settings.scheme == Scheme::EULER) ? interval : 0.5 * interval);
  }

  /* ----------------------------------------------------------------------
     Find y_b at the start of a run, when y- belongs to the time of the positions.  Extrapolate from y_b of two intervals:
     then y_b is y- to second order.  With these intervals, the half kick removes all stiff motion; the trapezoidal step needs
     twice the interval of the other schemes.
  ------------------------------------------------------------------------- */

  template <class Space> void StiffStage<Space>::start()
  {
    const double interval = (scheme.choice().trapezoidal() ? 3.0 : 1.5) * this->update->dt;
    double *const first = room(7), *const half = room(8), *const now = guess.data();
    for_each(SPH_LAMBDA(int k) { first[k] = now[k]; });
    step(0.5 * interval);
    double *const solution = x.data();
    for_each(SPH_LAMBDA(int k) {
      half[k] = solution[k];
      now[k] = first[k];
    });
    step(interval);
    for_each(SPH_LAMBDA(int k) { solution[k] = 2.0 * half[k] - solution[k]; });
  }

  // Solve M (y_b - y-) = h F(y_b) with y_b = guess + x, F(y_b) = F(guess) - Gamma x.

  template <class Space> void StiffStage<Space>::implicit_step(double part)
  {
    h = part;
    const double *const m = mass.data(), *const old = before.data(), *const first = guess.data(),
                        *const f = force.data();
    double *const b = residual.data();
    for_each(SPH_LAMBDA(int k) { b[k] = m[k] * (old[k] - first[k]) + part * f[k]; });
    solve();
  }

  /* ----------------------------------------------------------------------
     Solve M (Y1 - y-) = h F(Y1), M (Y2 - y-) = (dt - h) F(Y1) + h F(Y2), h = gamma dt.  The residual of the first solution,
     h F(Y1) - M (Y1 - y-), gives F(Y1) without another application of Gamma.
  ------------------------------------------------------------------------- */

  template <class Space> void StiffStage<Space>::sdirk2_step(double interval)
  {
    implicit_step(SDIRK2_GAMMA * interval);
    const double *const m = mass.data(), *const old = before.data();
    double *const first = room(6), *const solution = x.data(), *const b = residual.data(),
                  *const now = guess.data();
    for_each(SPH_LAMBDA(int k) {
      first[k] = solution[k];
      now[k] += first[k];
      b[k] = (1.0 / SDIRK2_GAMMA - 1.0) * m[k] * (now[k] - old[k]) + b[k] / SDIRK2_GAMMA;
    });
    solve();
    for_each(SPH_LAMBDA(int k) { solution[k] = first[k] + SDIRK2_GAMMA * solution[k]; });
  }

  /* ----------------------------------------------------------------------
     Return a lower estimate of the rate of the fastest mode, by power iteration from a disordered vector.  The rate of
     disordered particles, and of particles near free surfaces, where volumes are large, may be larger than on lattices.
  ------------------------------------------------------------------------- */

  template <class Space> double StiffStage<Space>::estimated_rate()
  {
    constexpr int NITERATION = 12;
    const double unit = 1.0 / this->space.parameters().support;
    const double *const m = mass.data(), *const m_inv = inverse_mass.data();
    double *const u = room(0), *const drag = room(1);
    const int nparticles = first_of_bodies(), each = width;
    const VectorField position = this->space.x();
    for_each(SPH_LAMBDA(int k) {
      const double waves[6] = {391.7, 577.3, 733.1, 811.9, 929.3, 1117.7};    // per support radius
      double phase = waves[0] * (k - nparticles + 1);
      if (k < nparticles) {
        const int i = k / each, d = k % each;
        phase = unit *
            (position.at(i, 0) * waves[d] + position.at(i, 1) * waves[(d + 1) % 6] +
             position.at(i, 2) * waves[(d + 2) % 6]);
      }
      drag[k] = m[k] * sin(phase);
    });

    double estimate = 0.0;
    for (int iteration = 0; iteration <= NITERATION; iteration++) {
      double square =
          total(SPH_LAMBDA(int k, double &all) { all += drag[k] * m_inv[k] * drag[k]; });
      sum(&square, 1);
      estimate = sqrt(square);
      if (iteration == NITERATION || !(square > 0.0)) break;
      for_each(SPH_LAMBDA(int k) { u[k] = m_inv[k] * drag[k] / estimate; });
      scheme.statistics[StiffScheme::APPLICATIONS] += 1.0;
      friction(u, drag);
    }
    return estimate;
  }

  /* ----------------------------------------------------------------------
     Compute the increments Y_j of the stages, and Z_j with M Y_j = dt (theta_j F(y-) - Gamma Z_j), theta_s = 1:
     y_b = y- + Z_s, and x = Z_s since the guess is y-.
  ------------------------------------------------------------------------- */

  template <class Space> void StiffStage<Space>::rkl2_step(double interval)
  {
    if (scheme.estimates()) scheme.set_estimate(estimated_rate());
    const int s = scheme.stages_for(interval);
    const RKL2 rkl2(s);
    const double of_first = rkl2.first().mu_rate;
    const double *const m_inv = inverse_mass.data(), *const f = force.data();
    double *const first = room(0), *const y = room(1), *const y_old = room(2),
                  *const z_old = room(3), *const drag = room(4), *const z = x.data();
    for_each(SPH_LAMBDA(int k) {
      first[k] = interval * m_inv[k] * f[k];
      y[k] = of_first * first[k];
      y_old[k] = z_old[k] = z[k] = 0.0;
    });
    for (int j = 2; j <= s; j++) {
      const RKL2::Stage stage = rkl2.stage(j);
      const double *const acting = driving(y);
      for_each(SPH_LAMBDA(int k) {
        const double now = z[k];
        z[k] = stage.mu * now + stage.nu * z_old[k] + stage.mu_rate * acting[k];
        z_old[k] = now;
      });
      if (j == s) break;
      scheme.statistics[StiffScheme::APPLICATIONS] += 1.0;
      friction(acting, drag);
      for_each(SPH_LAMBDA(int k) {
        const double now = y[k];
        y[k] = stage.mu * now + stage.nu * y_old[k] + stage.gamma_rate * first[k] +
            stage.mu_rate * (first[k] - interval * m_inv[k] * drag[k]);
        y_old[k] = now;
      });
    }
  }

  template <class Space> double StiffStage<Space>::memory_usage() const
  {
    double all = 0.0;
    for (const Values &one : rooms) all += Space::bytes_of(one);
    return all + Space::bytes_of(mass, inverse_mass, x, residual, before, guess, force);
  }

  /* ---------------------------------------------------------------------- */

  template <class Space> OwnForces ViscousStage<Space>::own_forces()
  {
    OwnForces own = {this->space.forces(), this->space.torques()};
    if (!this->scheme.active()) return own;
    const int n = 3 * this->atom->nlocal;
    own.ahead = Space::reach(ahead, "sph:ahead", n);
    if (this->space.parameters().spins())
      own.ahead_spin = Space::reach(ahead_spin, "sph:ahead_spin", n);
    own.mask = this->space.mask();
    own.groups = this->scheme.groups();
    own.prescribed = this->prescribed;
    return own;
  }

  template <class Space> void ViscousStage<Space>::begin(int prescribed)
  {
    this->prescribed = prescribed;
    this->width = this->space.parameters().spins() ? 6 : 3;
    find_unknowns();
    set_guess();
  }

  template <class Space>
  void ViscousStage<Space>::run(NeighList *list, const double *bound, bool symmetric)
  {
    this->list = list;
    this->bound = bound;
    this->symmetric = symmetric;
    const double begin = platform::walltime();
    this->space.collect_forces();
    gather();
    if (walls.has_mean_pressure()) {
      walls.note_pressures();
      find_rest();
    }
    this->solve_step();
    add_velocities(this->x.data());
    std::vector<double> acting = rigid.of().guess;    // increments are on the first processor
    for (int k = 0; k < this->rows_of_bodies; k++)
      acting[k] += this->x[this->first_of_bodies() + k];
    rigid.act(acting.data());
    this->scheme.statistics[StiffScheme::SECONDS] = platform::walltime() - begin;
  }

  /* ----------------------------------------------------------------------
     Find the unknown particles and bodies, their masses, and their velocities before the step.  Particles without inertia
     have no torques: their spin does not change.
  ------------------------------------------------------------------------- */

  template <class Space> void ViscousStage<Space>::find_unknowns()
  {
    Space &space = this->space;
    rigid.find(this->update->setupflag);
    this->rows_of_bodies = rigid.size();
    this->resize();
    double *const m = this->mass.data(), *const m_inv = this->inverse_mass.data(),
                  *const y = this->before.data();
    double *const other = Space::reach(others, "sph:unknowns", this->count());
    const StateRows of = space.states();
    const int *const mask = space.mask();
    const VectorField v = space.v(), omega = space.omega();
    const double *const inertia = space.inertia();
    const int each = this->width, groups = this->scheme.groups(), known = this->prescribed;
    space.for_each(
        "sph:unknowns", this->atom->nlocal, SPH_LAMBDA(int i) {
          const bool moves =
              (mask[i] & groups) && !(mask[i] & known) && !of.types[of.type[i]].other;
          for (int d = 0; d < each; d++) {
            const int k = each * i + d;
            m[k] = !moves ? 0.0 : (d < 3) ? of.rmass[i] : of.rmass[i] * inertia[i];
            m_inv[k] = (m[k] > 0.0) ? 1.0 / m[k] : 0.0;
            y[k] = (d < 3) ? v.at(i, d) : omega.at(i, d - 3);
          }
        });
    const RigidRows &bodies = rigid.of();
    for (int k = 0; k < this->rows_of_bodies; k++) {
      const int row = this->first_of_bodies() + k;
      m[row] = bodies.mass[k];
      m_inv[row] = (m[row] > 0.0) ? 1.0 / m[row] : 0.0;
      y[row] = bodies.before[k];
      other[row] = bodies.others[k];
    }
  }

  /* ----------------------------------------------------------------------
     Take the forces of other styles from vest, and set vest to the guess of the integrator.  Set vest to v- if the order of
     the particles may have changed, and at the start of a run, when vest contains no forces.
  ------------------------------------------------------------------------- */

  template <class Space> void ViscousStage<Space>::set_guess()
  {
    Space &space = this->space;
    const bool starts = this->update->setupflag, spins = turns();
    const int nlocal = this->atom->nlocal, nall = this->nall(), each = this->width;
    const double dt = this->update->dt, rate = (starts || dt == 0.0) ? 0.0 : 1.0 / dt;
    const bool same = !starts && this->neighbor->ago > 0 && ahead.size() >= 3u * nlocal &&
        (!spins || ahead_spin.size() >= 3u * nlocal);
    const double *const m = this->mass.data(), *const y = this->before.data();
    const double *const kept = ahead.data(), *const kept_spin = ahead_spin.data();
    double *const other = others.data();
    double *const difference =
        Space::reach(change, "sph:change", static_cast<std::size_t>(each) * nall);
    const VectorField vest = space.vest(), omegaest = space.omegaest();
    const int groups = this->scheme.groups(), known = this->prescribed;
    const StateRows of = space.states();
    const int *const mask = space.mask();
    space.for_each(
        "sph:guess", nlocal, SPH_LAMBDA(int i) {
          const bool moves =
              (mask[i] & groups) && !(mask[i] & known) && !of.types[of.type[i]].other;
          for (int d = 0; d < each; d++) {
            const int k = each * i + d;
            const double carried = moves ? ((d < 3) ? vest.at(i, d) : omegaest.at(i, d - 3)) - y[k]
                                         : 0.0;
            const double step =
                (same && moves) ? ((d < 3) ? kept[3 * i + d] : kept_spin[3 * i + d - 3]) : 0.0;
            other[k] = rate * m[k] * carried;
            difference[k] = step - carried;
          }
        });
    rigid.velocities(rigid.of().guess.data(), [&](int i, const double *u) {
      for (int c = 0; c < 3; c++) difference[each * i + c] = u[c] - vest.at(i, c);
    });

    space.forward({{difference, static_cast<std::size_t>(each), each}});
    space.for_each(
        "sph:guess", nall, SPH_LAMBDA(int i) {
          for (int d = 0; d < each; d++)
            ((d < 3) ? vest.at(i, d) : omegaest.at(i, d - 3)) += difference[each * i + d];
        });
  }

  // Set guess and force of all unknowns, from vest and the forces of the trial, and the mean velocity.

  template <class Space> void ViscousStage<Space>::gather()
  {
    Space &space = this->space;
    const int each = this->width, nlocal = this->atom->nlocal;
    const VectorField vest = space.vest(), omegaest = space.omegaest(), forces = space.forces(),
                      torques = space.torques();
    const double *const other = others.data();
    double *const y = this->guess.data(), *const f = this->force.data();
    space.for_each(
        "sph:gather", nlocal, SPH_LAMBDA(int i) {
          for (int d = 0; d < each; d++) {
            const int k = each * i + d;
            y[k] = (d < 3) ? vest.at(i, d) : omegaest.at(i, d - 3);
            f[k] = ((d < 3) ? forces.at(i, d) : torques.at(i, d - 3)) + other[k];
          }
        });
    const double *const on_bodies = rigid.forces([&](int i) {
      return &forces.at(i, 0);
    });
    for (int k = 0; k < this->rows_of_bodies; k++) {
      const int row = this->first_of_bodies() + k;
      y[row] = rigid.of().guess[k];
      f[row] = on_bodies[k] + other[row];
    }
    if (this->scheme.choice().mode != Viscous::IMPLICIT) return;    // rkl2 needs no scale
    const double *const m = this->mass.data(), *const old = this->before.data();
    double sums[4];
    for (int d = 0; d < 4; d++)
      sums[d] = space.template sum<double>(
          "sph:mean", nlocal, SPH_LAMBDA(int i, double &all) {
            all += (d < 3) ? m[each * i + d] * old[each * i + d] : m[each * i];
          });
    this->sum(sums, 4);
    for (int d = 0; d < 3; d++) mean[d] = (sums[3] > 0.0) ? sums[d] / sums[3] : 0.0;
  }

  // Set the velocities of owned and ghost particles for the loops to increments, 0 for particles with known velocities.

  template <class Space> void ViscousStage<Space>::set_velocities(const double *values)
  {
    Space &space = this->space;
    const ParticleRows rows = space.rows();
    Spin *const spin = space.spins();
    const int each = this->width;
    space.for_each(
        "sph:increments", this->atom->nlocal, SPH_LAMBDA(int i) {
          for (int d = 0; d < 3; d++) {
            rows.particle[i].u[d] = values[each * i + d];
            if (spin) spin[i].w[d] = values[each * i + 3 + d];
          }
        });
    rigid.velocities(values + this->first_of_bodies(), [&](int i, const double *u) {
      std::copy_n(u, 3, rows.particle[i].u);
    });
    std::vector<Field> fields = {field(rows.particle, rows.particle->u, 3)};
    if (spin) fields.push_back(field(spin, spin->w, 3));
    space.forward(fields);
  }

  // Find cdot and the bulk term of owned and ghost particles from the velocities in the rows.

  template <class Space> void ViscousStage<Space>::set_bulk_term()
  {
    if (this->space.parameters().bulk != Bulk::NONE) {
      this->space.sum_rates();
      DensitySum *const density = this->space.rows().density;
      this->space.forward({field(density, &density->cdot, 1)});
    }
    pressure.set_bulk_term(bound, walls.bits());
  }

  // Store the values of boundary particles if all increments of the fluid are 0; friction() subtracts these values.

  template <class Space> void ViscousStage<Space>::find_rest()
  {
    double *const zero = this->x.data();
    this->for_each(SPH_LAMBDA(int k) { zero[k] = 0.0; });
    set_velocities(zero);
    set_bulk_term();
    walls.extend(true);
    const ParticleRows rows = this->space.rows();
    const Spin *const spin = this->space.spins();
    const int bits = walls.bits();
    BoundaryRest *const at_rest = Space::reach(rest, "sph:rest", this->nall());
    this->space.for_each(
        "sph:rest", this->nall(), SPH_LAMBDA(int i) {
          if (!(rows.mask[i] & bits)) return;
          const Particle &p = rows.particle[i];
          BoundaryRest &one = at_rest[i];
          one.g = p.g;
          one.zeta_term = rows.zeta_term[i];
          for (int d = 0; d < 3; d++) {
            one.u[d] = p.u[d];
            one.w[d] = spin ? spin[i].w[d] : 0.0;
          }
        });
  }

  // Set out = Gamma in: minus the linear friction forces and torques at the velocity increments in.

  template <class Space> void ViscousStage<Space>::friction(const double *in, double *out)
  {
    Space &space = this->space;
    set_velocities(in);
    set_bulk_term();
    if (walls.has_mean_pressure()) {
      walls.extend(true);
      const ParticleRows rows = space.rows();
      Spin *const spin = space.spins();
      const int bits = walls.bits();
      const BoundaryRest *const at_rest = rest.data();
      space.for_each(
          "sph:rest", this->nall(), SPH_LAMBDA(int i) {
            if (!(rows.mask[i] & bits)) return;
            Particle &p = rows.particle[i];
            const BoundaryRest &one = at_rest[i];
            p.g -= one.g;
            rows.zeta_term[i] -= one.zeta_term;
            for (int d = 0; d < 3; d++) {
              p.u[d] -= one.u[d];
              if (spin) spin[i].w[d] -= one.w[d];
            }
          });
    }

    space.sum_friction(list, this->prescribed);
    walls.add_linear_friction();
    space.collect_forces();
    const int each = this->width;
    const VectorField forces = space.forces(), torques = space.torques();
    space.for_each(
        "sph:friction", this->atom->nlocal, SPH_LAMBDA(int i) {
          for (int d = 0; d < each; d++)
            out[each * i + d] = -((d < 3) ? forces.at(i, d) : torques.at(i, d - 3));
        });
    const double *const on_bodies = rigid.forces([&](int i) {
      return &forces.at(i, 0);
    });
    for (int k = 0; k < this->rows_of_bodies; k++) out[this->first_of_bodies() + k] = -on_bodies[k];
  }

  /* ----------------------------------------------------------------------
     Return the square of the scale of the residual.  The scale includes the velocity that moves particles by the rounding
     error of positions: a smaller residual needs no iteration.  Bodies, which may be heavy, do not count: the tolerance holds
     for the velocities of the fluid.
  ------------------------------------------------------------------------- */

  template <class Space> double ViscousStage<Space>::scale_sq() const
  {
    const double distance = DBL_EPSILON * this->space.parameters().support, dt = this->update->dt;
    const double still = (dt > 0.0) ? distance / (dt * this->scheme.choice().tolerance) : 0.0;
    const double *const m = this->mass.data(), *const old = this->before.data(),
                        *const y = this->guess.data(), *const increment = this->x.data();
    const double frame[3] = {mean[0], mean[1], mean[2]};
    const int each = this->width;
    return this->space.template sum<double>(
        "sph:scale", this->first_of_bodies(), SPH_LAMBDA(int k, double &all) {
          const int d = k % each;
          const double of_frame = (d < 3) ? frame[d] : 0.0;
          const double v0 = old[k] - of_frame, v = y[k] + increment[k] - of_frame;
          all += 0.5 * m[k] * (v0 * v0 + v * v);
          if (d == 0) all += m[k] * still * still;
        });
  }

  /* ----------------------------------------------------------------------
     Add an increment to the velocities and spins of owned particles and of ghosts, whose velocities fix deform may have
     changed.
  ------------------------------------------------------------------------- */

  template <class Space> void ViscousStage<Space>::add_velocities(const double *increment)
  {
    set_velocities(increment);
    const ParticleRows rows = this->space.rows();
    const Spin *const spin = this->space.spins();
    const VectorField vest = this->space.vest(), omegaest = this->space.omegaest();
    this->space.for_each(
        "sph:velocities", this->nall(), SPH_LAMBDA(int i) {
          for (int d = 0; d < 3; d++) {
            vest.at(i, d) += rows.particle[i].u[d];
            if (spin) omegaest.at(i, d) += spin[i].w[d];
          }
        });
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
