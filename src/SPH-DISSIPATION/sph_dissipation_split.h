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

#ifndef LMP_SPH_DISSIPATION_SPLIT_H
#define LMP_SPH_DISSIPATION_SPLIT_H

// Particles that split and merge, for package SPH-DISSIPATION.  No LAMMPS include.
//
// Each event conserves mass (and with it the reference volume m/rho0), center of mass, momentum, and angular momentum,
// orbital plus spin.  A split keeps the kinetic energy; a merge turns the energy of the relative motion into heat >= 0.
// merge() returns the residual angular momentum that a particle without spin cannot hold; a Shell of neighbors takes it as a
// rigid rotation.
//
// The daughters of a spinning particle move with its rigid rotation, u + Omega x d, and spin with Omega: by the parallel
// axis theorem, this keeps angular momentum and energy if sum m d_perp^2 + sum m_k I_k = m I, which holds for the inertia
// V^(2/n)/6 of cubes.

#include "sph_dissipation_states.h"

#include <algorithm>
#include <cmath>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Symmetric tensor in three dimensions

  struct Symmetric {
    double a[3][3] = {};

    void add_product(double factor, const double *r)
    {
      for (int d = 0; d < 3; d++)
        for (int e = 0; e < 3; e++) a[d][e] += factor * r[d] * r[e];
    }
    double trace() const { return a[0][0] + a[1][1] + a[2][2]; }

    // Return the tensor of inertia, from the moments sum m r r

    Symmetric inertia() const
    {
      Symmetric result;
      const double sum = trace();
      for (int d = 0; d < 3; d++)
        for (int e = 0; e < 3; e++) result.a[d][e] = (d == e ? sum : 0.0) - a[d][e];
      return result;
    }
  };

  struct Eigen3 {
    double value[3];
    double axis[3][3];    // unit vectors
  };

  // Return eigenvalues and axes by Jacobi's method.  Off-diagonal elements of round-off size stay, so that the axes of an
  // isotropic tensor are always the coordinate axes.

  inline Eigen3 eigen(Symmetric s)
  {
    constexpr int SWEEPS = 30;
    constexpr double ROUNDOFF = 1.0e-11;
    Eigen3 result = {{0.0, 0.0, 0.0}, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    auto &a = s.a;
    const double small = ROUNDOFF * (std::fabs(a[0][0]) + std::fabs(a[1][1]) + std::fabs(a[2][2]));
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
      bool done = true;
      for (int p = 0; p < 2; p++)
        for (int q = p + 1; q < 3; q++) {
          if (!(std::fabs(a[p][q]) > (sweep ? 1.0e-6 : 1.0) * small)) continue;
          done = false;
          const double theta = 0.5 * (a[q][q] - a[p][p]) / a[p][q];
          const double t =
              (theta < 0.0 ? -1.0 : 1.0) / (std::fabs(theta) + std::sqrt(theta * theta + 1.0));
          const double c = 1.0 / std::sqrt(t * t + 1.0), sn = t * c;
          for (int k = 0; k < 3; k++) {
            const double x = a[k][p], y = a[k][q];
            a[k][p] = c * x - sn * y;
            a[k][q] = sn * x + c * y;
          }
          for (int k = 0; k < 3; k++) {
            const double x = a[p][k], y = a[q][k];
            a[p][k] = c * x - sn * y;
            a[q][k] = sn * x + c * y;
          }
          for (int k = 0; k < 3; k++) {
            const double x = result.axis[p][k], y = result.axis[q][k];
            result.axis[p][k] = c * x - sn * y;
            result.axis[q][k] = sn * x + c * y;
          }
        }
      if (done) break;
    }
    for (int d = 0; d < 3; d++) result.value[d] = a[d][d];
    return result;
  }

  inline double dot(const double *a, const double *b)
  {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  // Add factor a x b to sum

  inline void add_cross(double factor, const double *a, const double *b, double *sum)
  {
    sum[0] += factor * (a[1] * b[2] - a[2] * b[1]);
    sum[1] += factor * (a[2] * b[0] - a[0] * b[2]);
    sum[2] += factor * (a[0] * b[1] - a[1] * b[0]);
  }

  // A particle as splits and merges need it: conserved quantities, states, present velocity and spin (u, spin), and velocity
  // and spin extrapolated to the end of the step (u_end, spin_end)

  struct Lump {
    double mass = 0.0;
    double inertia = 0.0;    // per mass, length^2
    double energy = 0.0;     // internal energy, and its rate
    double energy_rate = 0.0;
    double diffusion[3] = {};    // by diffusion: rates of volume, now and before; rate of energy
    double state[MOST_STATES] = {};    // numbers from handed_on()
    double x[3] = {};
    double u[3] = {}, spin[3] = {};
    double u_end[3] = {}, spin_end[3] = {};
  };

  // Places of equal daughters around their parent; the sum of the places is zero

  struct Stencil {
    static constexpr int MOST = 8;
    int n = 0;
    bool isotropic = false;    // sum d d is isotropic
    double d[MOST][3] = {};
  };

  // Distance of the daughters from their parent along each axis, over the spacing.  IN_BLOCK, where neighbors split as well:
  // distance of the centers of the parts of a cube; less for a particle that splits alone

  constexpr double SPLIT_IN_BLOCK = 0.25;
  constexpr double SPLIT_ALONE = 0.2;

  inline Stencil cube_stencil(int dim, double distance)
  {
    Stencil stencil;
    stencil.n = 1 << dim;
    stencil.isotropic = true;
    for (int k = 0; k < stencil.n; k++)
      for (int d = 0; d < dim; d++) stencil.d[k][d] = ((k >> d) & 1) ? distance : -distance;
    return stencil;
  }

  inline Stencil axis_stencil(const double *axis, double distance)
  {
    Stencil stencil;
    stencil.n = 2;
    for (int d = 0; d < 3; d++) {
      stencil.d[0][d] = -distance * axis[d];
      stencil.d[1][d] = distance * axis[d];
    }
    return stencil;
  }

  // Return the inertia per mass of the daughters.  Set rotate to false, and return the inertia of the parent, if daughters
  // must not take part in the rotation: daughters at places that are not isotropic would precess; daughters too far apart
  // would have hardly any inertia left, and the smallest torque would spin these daughters up.

  inline double daughter_inertia(const Lump &parent, const Stencil &stencil, int dim, bool &rotate)
  {
    constexpr double LEAST = 0.8;    // over the inertia of a body of the same shape
    double second = 0.0;
    for (int k = 0; k < stencil.n; k++) second += dot(stencil.d[k], stencil.d[k]) / stencil.n;
    const double remaining = parent.inertia - (dim == 3 ? 2.0 / 3.0 : 1.0) * second;
    const double least = LEAST * std::pow(stencil.n, -2.0 / dim) * parent.inertia;
    rotate = remaining > 0.0 && remaining >= least && (dim < 3 || stencil.isotropic);
    return rotate ? remaining : parent.inertia;
  }

  inline void split(const Lump &parent, const Stencil &stencil, int dim, Lump *daughters)
  {
    bool rotate;
    const double inertia = daughter_inertia(parent, stencil, dim, rotate);
    for (int k = 0; k < stencil.n; k++) {
      Lump &one = daughters[k];
      one = parent;
      one.mass = parent.mass / stencil.n;
      one.energy = parent.energy / stencil.n;
      one.energy_rate = parent.energy_rate / stencil.n;
      for (double &rate : one.diffusion) rate /= stencil.n;
      one.inertia = inertia;
      for (int d = 0; d < 3; d++) one.x[d] += stencil.d[k][d];
      if (!rotate) continue;
      add_cross(1.0, parent.spin, stencil.d[k], one.u);
      add_cross(1.0, parent.spin_end, stencil.d[k], one.u_end);
    }
  }

  // Angular momentum and kinetic energy of particles that merge, relative to their center of mass x; mean: mean velocity

  struct InternalMotion {
    double angmom[3];
    double energy;    // in units of mass velocity^2
  };

  template <class Velocity, class Spin>
  InternalMotion internal_motion(const Lump *parts, int n, const double *x, Velocity velocity,
                                 Spin spin, double *mean)
  {
    InternalMotion motion = {{0.0, 0.0, 0.0}, 0.0};
    double mass = 0.0, relative[3], r[3];
    for (int k = 0; k < n; k++) mass += parts[k].mass;
    for (int d = 0; d < 3; d++) {
      mean[d] = 0.0;
      for (int k = 0; k < n; k++) mean[d] += parts[k].mass / mass * velocity(parts[k])[d];
    }
    for (int k = 0; k < n; k++) {
      const Lump &part = parts[k];
      for (int d = 0; d < 3; d++) {
        relative[d] = velocity(part)[d] - mean[d];
        r[d] = part.x[d] - x[d];
        motion.angmom[d] += part.mass * part.inertia * spin(part)[d];
      }
      add_cross(part.mass, r, relative, motion.angmom);
      motion.energy +=
          0.5 * part.mass * (dot(relative, relative) + part.inertia * dot(spin(part), spin(part)));
    }
    return motion;
  }

  // Merge n particles into one; return the heat in units of mass velocity^2; whole.energy does not contain it yet.  A
  // spinning particle gets the largest principal moment of inertia of its parts: then the energy of the spin is at most the
  // energy of the parts, L^2/(2 J) <= L J^-1 L/2.  residual = angular momentum that a particle without spin cannot hold.

  inline double merge(const Lump *parts, int n, int dim, bool spinning, Lump &whole,
                      double *residual)
  {
    whole = Lump();
    for (int k = 0; k < n; k++) {
      whole.mass += parts[k].mass;
      whole.energy += parts[k].energy;
      whole.energy_rate += parts[k].energy_rate;
      for (int d = 0; d < 3; d++) whole.diffusion[d] += parts[k].diffusion[d];
    }
    for (int k = 0; k < n; k++)
      for (int l = 0; l < MOST_STATES; l++)
        whole.state[l] += parts[k].mass / whole.mass * parts[k].state[l];

    // relative to one of the parts, to keep round-off small

    for (int d = 0; d < 3; d++) {
      double shift = 0.0;
      for (int k = 1; k < n; k++) shift += parts[k].mass * (parts[k].x[d] - parts[0].x[d]);
      whole.x[d] = parts[0].x[d] + shift / whole.mass;
    }

    const InternalMotion now = internal_motion(
        parts, n, whole.x,
        [](const Lump &part) {
          return part.u;
        },
        [](const Lump &part) {
          return part.spin;
        },
        whole.u);
    const InternalMotion end = internal_motion(
        parts, n, whole.x,
        [](const Lump &part) {
          return part.u_end;
        },
        [](const Lump &part) {
          return part.spin_end;
        },
        whole.u_end);

    for (int d = 0; d < 3; d++) residual[d] = spinning ? 0.0 : now.angmom[d];
    if (!spinning) return now.energy;

    Symmetric moments;
    double spins = 0.0;
    for (int k = 0; k < n; k++) {
      double r[3];
      for (int d = 0; d < 3; d++) r[d] = parts[k].x[d] - whole.x[d];
      moments.add_product(parts[k].mass, r);
      spins += parts[k].mass * parts[k].inertia;
    }
    double moment = moments.trace();
    if (dim == 3) {
      const Eigen3 principal = eigen(moments.inertia());
      moment = *std::max_element(principal.value, principal.value + 3);
    }
    moment += spins;
    whole.inertia = moment / whole.mass;
    if (!(moment > 0.0)) return now.energy;
    for (int d = 0; d < 3; d++) {
      whole.spin[d] = now.angmom[d] / moment;
      whole.spin_end[d] = end.angmom[d] / moment;
    }
    return std::max(now.energy - 0.5 * dot(now.angmom, now.angmom) / moment, 0.0);
  }

  // Rotation of the neighbors of a merged particle, at r from the particle, which take its residual angular momentum

  struct Rotation {
    double rate[3];      // added angular velocity
    double center[3];    // center of the rotation
    double mean[3];      // mean velocity of the neighbors

    // Add the velocity of a neighbor at r with this weight to du

    void velocity(double weight, const double *r, double *du) const
    {
      double from[3];
      for (int d = 0; d < 3; d++) from[d] = r[d] - center[d];
      add_cross(weight, rate, from, du);
    }
  };

  // Return the weight of a neighbor.  The weight is zero at the radius: so round-off decides nothing, and results do not
  // depend on the number of processors

  inline double shell_weight(double rsq, double radius)
  {
    const double inside = 1.0 - rsq / (radius * radius);
    return inside > 0.0 ? inside * inside : 0.0;
  }

  struct Shell {    // sums over the neighbors that take residual angular momentum
    double mass = 0.0;
    double mx[3] = {}, mu[3] = {};
    Symmetric mxx;

    void add(double weighted_mass, const double *r, const double *u)
    {
      mass += weighted_mass;
      for (int d = 0; d < 3; d++) {
        mx[d] += weighted_mass * r[d];
        mu[d] += weighted_mass * u[d];
      }
      mxx.add_product(weighted_mass, r);
    }

    // Find the rigid rotation of these neighbors that has this angular momentum; return false if there is no rotation

    bool take(const double *angmom, int dim, Rotation &rotation) const
    {
      constexpr double THIN = 1.0e-3;    // smallest of the moments of inertia, over the largest
      rotation = Rotation();
      if (!(mass > 0.0)) return false;
      for (int d = 0; d < 3; d++) {
        rotation.center[d] = mx[d] / mass;
        rotation.mean[d] = mu[d] / mass;
      }
      Symmetric moments = mxx;
      moments.add_product(-mass, rotation.center);
      if (dim < 3) {
        if (!(moments.trace() > THIN * mxx.trace())) return false;
        rotation.rate[2] = angmom[2] / moments.trace();
        return true;
      }
      const Eigen3 principal = eigen(moments.inertia());
      const double most = *std::max_element(principal.value, principal.value + 3);
      for (int k = 0; k < 3; k++) {
        if (!(principal.value[k] > THIN * most)) return false;
        const double part = dot(angmom, principal.axis[k]) / principal.value[k];
        for (int d = 0; d < 3; d++) rotation.rate[d] += part * principal.axis[k][d];
      }
      return true;
    }
  };

  // Spacings of the neighbors of a particle along each axis.  Near neighbors count most: on a lattice of spacings a, the sum
  // of e e/r^8 has eigenvalues of about a^-8.

  class Arrangement {
   public:
    void add(const double *r)
    {
      const double rsq = dot(r, r);
      if (rsq > 0.0) near.add_product(1.0 / whole_power(rsq, 5), r);
    }

    // Return the largest of the spacings along three axes (the first of equal ones), for a particle of this volume; ratio =
    // this spacing over the spacing of an isotropic arrangement

    double widest(int dim, double volume, double *axis, double &ratio) const
    {
      constexpr double EQUAL = 1.0e-6;
      const double even = spacing_of(dim, volume);
      const Eigen3 principal = eigen(near);
      int least = 0;
      double mean = 1.0;    // geometric mean, by roots: a product may leave the range of numbers
      for (int d = 0; d < dim; d++) {
        mean *= spacing_of(dim, std::max(principal.value[d], 0.0));
        if (principal.value[d] < (1.0 - EQUAL) * principal.value[least]) least = d;
      }
      for (int d = 0; d < 3; d++) axis[d] = principal.axis[least][d];

      // all neighbors on a line, or none: no spacing across is known

      constexpr double MOST = 2.0;
      ratio = MOST;
      if (principal.value[least] > 0.0)
        ratio = std::min(std::pow(mean / principal.value[least], 0.125), MOST);
      return ratio * even;
    }

   private:
    Symmetric near;
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
