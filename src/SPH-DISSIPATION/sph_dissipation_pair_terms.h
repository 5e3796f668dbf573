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

// The terms of one pair of particles i and j or, in the loops of the CPU, of a vector of them: each
// formula stands here once.  Included in more than one namespace, as sph_dissipation_kernel_shapes.h,
// which must have square_root(a) and if_positive(a, b), see sph_dissipation_simd.h.
//
// r = r_i - r_j, u = u_i - u_j, approach = r.u, slope = F, vv = F V_i V_j; P1, P2, P3: see
// sph_dissipation_coeffs.h.  Forces are those on i, opposite on j; of the heat of a pair half goes to
// each.

// added to r and r^2 before dividing: two particles at the same point, r = 0, exert no force on each
// other

constexpr double TINY = 1.0e-300;

template <class Real> SPH_INLINE Real dot(const Real *a, const Real *b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// F V_i V_j

template <class Real> SPH_INLINE Real volumes_slope(Real rsq, double vol_i, Real vol_j, Real slope)
{
  return if_positive(rsq, vol_i * vol_j * slope);
}

// pressure and bulk term of the form density, P1 (12), (18): F (g_i + g_j) r

template <class Real> SPH_INLINE Real pressing_term(double g_i, Real g_j, Real slope)
{
  return (g_i + g_j) * slope;
}

// bulk term of the form volume, P1 (64): F V_i V_j (zeta_i cdot_i/c_i + zeta_j cdot_j/c_j) r; it heats
// by zeta cdot/c V D with D_i = -sum_j V_j F r.u

template <class Real> SPH_INLINE Real volume_term(double zeta_term_i, Real zeta_term_j, Real vv)
{
  return (zeta_term_i + zeta_term_j) * vv;
}

template <class Real> SPH_INLINE Real divergence_term(Real slope, Real approach)
{
  return slope * approach;
}

// What stands before a drag along r, a F V_i V_j/metric (u.r) r, with the metric r^2, P2 (41), P3 (12),
// or r, P1 (15): by_metric = F V_i V_j/metric

template <bool FR, class Real> SPH_INLINE Real metric_of(Real rsq)
{
  if constexpr (FR)
    return square_root(rsq);
  else
    return rsq;
}

template <class Real> SPH_INLINE Real drag_along_r(Real coefficient, Real by_metric, Real along)
{
  return coefficient * by_metric * along;
}

template <class Real> SPH_INLINE Real half_heat_along_r(Real drag, Real along)
{
  return 0.5 * drag * along;
}

// u* = u - (w_i + w_j)/2 x r with the spins w: the velocity of slip at the point of contact, P3 (12)

template <class Real>
SPH_INLINE void slip_velocity(const double *w_i, const Real *w_j, const Real *r, Real *u)
{
  const Real mx = 0.5 * w_i[0] + 0.5 * w_j[0];
  const Real my = 0.5 * w_i[1] + 0.5 * w_j[1];
  const Real mz = 0.5 * w_i[2] + 0.5 * w_j[2];
  u[0] = u[0] - my * r[2] + mz * r[1];
  u[1] = u[1] - mz * r[0] + mx * r[2];
  u[2] = u[2] - mx * r[1] + my * r[0];
}

// drag along u, or u* of a micropolar fluid: -a F V_i V_j u, with drag = a F V_i V_j, subtracted from
// the force; its half of the heat

template <class Real> SPH_INLINE void add_drag_along_u(Real drag, const Real *u, Real *force)
{
  for (int d = 0; d < 3; d++) force[d] -= drag * u[d];
}

template <class Real> SPH_INLINE Real half_heat_along_u(Real half_drag, const Real *u)
{
  return half_drag * dot(u, u);
}

// half of the torque of that force for each particle, the same on both: 1/2 a F V_i V_j r x u*, P3 (18)

template <class Real>
SPH_INLINE void half_torque(Real half_drag, const Real *r, const Real *u, Real *torque)
{
  torque[0] = half_drag * (r[1] * u[2] - r[2] * u[1]);
  torque[1] = half_drag * (r[2] * u[0] - r[0] * u[2]);
  torque[2] = half_drag * (r[0] * u[1] - r[1] * u[0]);
}

// spin diffusion, P3 (18), with s = w_i - w_j: the torque F V_i V_j [xi1 (s.e) e + xi2 s] on j,
// opposite on i, and half of the heat; drag1 = drag_along_r(xi1, by_metric, s.r), drag2 = xi2 F V_i V_j

template <class Real>
SPH_INLINE void spin_torque(Real drag1, Real drag2, const Real *r, const Real *s, Real *on_j)
{
  for (int d = 0; d < 3; d++) on_j[d] = drag1 * r[d] + drag2 * s[d];
}

template <class Real>
SPH_INLINE Real half_heat_of_spins(Real drag1, Real drag2, Real along, const Real *s)
{
  return 0.5 * (drag1 * along + drag2 * dot(s, s));
}
