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

#ifndef LMP_SPH_DISSIPATION_SHIFT_TERMS_H
#define LMP_SPH_DISSIPATION_SHIFT_TERMS_H

// Particle shifting.  No LAMMPS include.
//
// In a time t, a particle moves from dense to thin regions by
//   delta_i = t U_i R g_i, at most t U_i/2,   g_i = sum_j V_j F r_ij [1 + 0.2 (W/W(V_i^(1/n)))^4],
// with the support radius R: S. J. Lind et al., J. Comput. Phys. 231, 1499 (2012); P. N. Sun et al., Comput. Methods Appl.
// Mech. Eng. 315, 25 (2017).  The velocity stays.  U_i is a given speed, or 5 R times the local rate of shear.
//
// Neighbors move back, so that the center of mass does not move: the displacement is
//   D_i = delta_i - (1/m_i) sum_j a_ij q_j,   q_i = m_i delta_i/A_i,   A_i = sum_j a_ij,
//   a_ij = F V_i V_j min(m_i, m_j)/max(m_i, m_j)  between particles that shift.
// This changes the angular momentum by sum_i m_i D_i x v_i = sum_i q_i x sum_j a_ij u_ij, with the difference u of the
// velocities.  Impulses of the pairs, at the distances r' after the displacement, take the change back:
//   p_ij = a_ij (w_i + w_j) x r'_ij,   I_i w_i = -q_i x sum_j a_ij u_ij,   I_i = sum_j a_ij (r'^2 1 - r' r').
// So a particle and its neighbors conserve momentum and angular momentum exactly.  The change of the kinetic energy becomes
// heat.

#include "sph_dissipation_tensor.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // A particle in a shift; v = velocity after the first half of the kick

  struct ShiftRow {
    double vol = 0.0, mass = 1.0;    // vol 0: the particle does not shift
    double speed = 0.0;              // given speed, added to U
    double per_rate = 0.0;           // U per rate of shear
    double contact = 0.0;            // see contact_inverse(), of all particles
    double q[3] = {}, v[3] = {};     // v - u with u of the last forces, see velocity_in_shift()
    double d[3] = {};                // delta, then D
    double w[3] = {};                // the lost angular momentum, then w
  };

  // Shift of one fix: the bit of its group, and the speed U; automatic: U follows the local rate of shear instead

  struct ShiftMover {
    int groupbit;
    bool automatic;
    double speed;
  };

  SPH_FUNCTION void let_shift(const ShiftMover &mover, double support, double vol, ShiftRow &row)
  {
    constexpr double STRAIN = 5.0;
    row.vol = vol;
    row.speed = mover.automatic ? 0.0 : mover.speed;
    row.per_rate = mover.automatic ? STRAIN * support : 0.0;
  }

  // First loop: sums of a particle over all its neighbors

  struct ShiftSum {
    double gradient[3] = {};               // g
    double share = 0.0;                    // A
    double slopes[9] = {};                 // gradient of u, sum_j V_j F u r, by rows
    double tensor[MOST_OF_TENSOR] = {};    // sum_j V_j F r r, with ShiftLaw::surfaces
  };

  // Second loop: sums over the neighbors that shift, sum_j a_ij q_j and sum_j a_ij u_ij

  struct ShiftExchange {
    double moved[3] = {}, slip[3] = {};
  };

  // Third loop: sum_j a_ij r' r', at the new positions

  struct ShiftTensor {
    double a[MOST_OF_TENSOR] = {};
  };

  // Fourth loop: impulse J_i = sum_j p_ij, and work sum_j p_ij.(v_i + v_j)/2

  struct ShiftReturn {
    double impulse[3] = {}, work = 0.0;
  };

  // Constants of a shift

  struct ShiftLaw {
    int dim;
    double support;           // R
    double time;              // t
    double slope_integral;    // of F
    bool surfaces;            // no particle is pushed out of a free surface
  };

  // Return 1/shape of the kernel at the distance of a neighbor on a lattice of particles of this volume

  template <class K> SPH_FUNCTION double contact_inverse(int dim, double support, double vol)
  {
    const double q = spacing_of(dim, vol) / support;
    return 1.0 / K::shape((q < 0.9) ? q : 0.9);
  }

  // Return the weight of r_ij in g, for a neighbor of volume V, slope F and this shape of the kernel; the second term
  // prevents pairing

  SPH_FUNCTION double concentration_push(double vol, double slope, double shape, double contact)
  {
    constexpr double PAIRING = 0.2;
    const double close = shape * contact * shape * contact;
    return vol * (slope * (1.0 + PAIRING * close * close));
  }

  // Return a_ij; slope = F

  SPH_FUNCTION double shift_share(double slope, const ShiftRow &a, const ShiftRow &b)
  {
    const double ratio = (a.mass < b.mass) ? a.mass / b.mass : b.mass / a.mass;
    return slope * (a.vol * b.vol) * ratio;
  }

  // Add a neighbor of volume vol at distance r to the sums; u = difference of the velocities in the last forces

  SPH_FUNCTION void add_to_shift(const ShiftLaw &law, const double *r, const double *u, double vol,
                                 double slope, double push, double share, ShiftSum &sum)
  {
    for (int d = 0; d < 3; d++) sum.gradient[d] += push * r[d];
    sum.share += share;
    for (int a = 0; a < law.dim; a++)
      for (int b = 0; b < law.dim; b++) sum.slopes[3 * a + b] += vol * slope * u[a] * r[b];
    if (law.surfaces) add_square(law.dim, vol * slope, r, sum.tensor);
  }

  // Return the part of a shift that remains near a free surface; smallest = smallest eigenvalue of sum_j V_j F r r, about 1
  // inside of the fluid, 1/2 at a plane surface

  SPH_FUNCTION double part_at_surface(double smallest)
  {
    constexpr double NONE = 0.6, ALL = 0.9;
    const double part = (smallest - NONE) / (ALL - NONE);
    return (part < 0.0) ? 0.0 : (part < 1.0) ? part : 1.0;
  }

  // Return the rate of shear, the root of 2 D:D with the rate of strain D

  SPH_FUNCTION double rate_of_shear(const double *slopes)
  {
    double sum = 0.0;
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < 3; b++) {
        const double twice = slopes[3 * a + b] + slopes[3 * b + a];
        sum += 0.5 * twice * twice;
      }
    return sqrt(sum);
  }

  // Set delta and q.  A particle with few neighbors that shift does not move: few could not balance its displacement.

  SPH_FUNCTION void set_shift(const ShiftLaw &law, const ShiftSum &sum, ShiftRow &row)
  {
    constexpr double LEAST_SHARE = 0.25, MOST_OF_SUPPORT = 0.1;
    for (int d = 0; d < 3; d++) row.d[d] = row.q[d] = 0.0;
    if (!(sum.share > LEAST_SHARE * law.slope_integral * row.vol)) return;
    const double *const g = sum.gradient;
    const double speed = row.speed + row.per_rate * rate_of_shear(sum.slopes);
    const double wanted = law.support * sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    const double way = law.time * speed, most = MOST_OF_SUPPORT * law.support;
    double scale =
        ((way < most) ? way : most) * law.support * ((wanted > 0.5) ? 0.5 / wanted : 1.0);
    if (law.surfaces) scale *= part_at_surface(smallest_eigenvalue(law.dim, sum.tensor));
    for (int d = 0; d < 3; d++) {
      row.d[d] = scale * g[d];
      row.q[d] = row.mass * row.d[d] / sum.share;
    }
  }

  // Set v to the velocity of a particle, or of its periodic image; u = velocity in the last forces, differs for an image

  SPH_FUNCTION void velocity_in_shift(const ShiftRow &row, const double *u, double *v)
  {
    for (int d = 0; d < 3; d++) v[d] = u[d] + row.v[d];
  }

  // Set D, and the lost angular momentum

  SPH_FUNCTION void set_displacement(const ShiftExchange &sum, ShiftRow &row)
  {
    if (row.vol == 0.0) return;
    for (int d = 0; d < 3; d++) row.d[d] -= sum.moved[d] / row.mass;
    cross_product(row.q, sum.slip, row.w);
  }

  // Set w

  SPH_FUNCTION void set_return(int dim, const ShiftTensor &sum, ShiftRow &row)
  {
    const double *const t = sum.a, lost[3] = {row.w[0], row.w[1], row.w[2]};
    for (int d = 0; d < 3; d++) row.w[d] = 0.0;
    if (lost[0] == 0.0 && lost[1] == 0.0 && lost[2] == 0.0) return;
    if (dim == 2) row.w[2] = -lost[2] / (t[0] + t[2]);
    if (dim < 3) return;
    const double trace = t[0] + t[3] + t[5];
    const double inertia[MOST_OF_TENSOR] = {trace - t[0], -t[1], -t[2],
                                            trace - t[3], -t[4], trace - t[5]};
    double w[3];
    solve_tensor(3, inertia, lost, w);
    for (int d = 0; d < 3; d++) row.w[d] = -w[d];
  }

  // Set push = p_ij; return the work of p_ij at the mean of both velocities

  SPH_FUNCTION double impulse_of_pair(double share, const ShiftRow &a, const ShiftRow &b,
                                      const double *va, const double *vb, const double *r,
                                      double *push)
  {
    const double w[3] = {a.w[0] + b.w[0], a.w[1] + b.w[1], a.w[2] + b.w[2]};
    cross_product(w, r, push);
    double work = 0.0;
    for (int d = 0; d < 3; d++) {
      push[d] *= share;
      work += 0.5 * push[d] * (va[d] + vb[d]);
    }
    return work;
  }

  // Change position, velocities and energy of a particle, after the first half of a step of length dt.  keep: as in
  // TimeStep; mvv2e turns mass * velocity^2 into an energy

  SPH_FUNCTION void finish_shift(const ShiftRow &row, const ShiftReturn &sum, double dt,
                                 double keep, double mvv2e, double *x, double *v, double *vest,
                                 double &energy)
  {
    double work = -sum.work;
    for (int d = 0; d < 3; d++) {
      const double dv = sum.impulse[d] / row.mass;
      work += sum.impulse[d] * (v[d] + 0.5 * dv);
      x[d] += row.d[d] + dt * dv;
      v[d] += dv;
      vest[d] += keep * dv;
    }
    energy -= mvv2e * work;
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
