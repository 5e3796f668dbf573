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

// Terms of pairs of particles i and j: in vectors of pairs on the CPU, for single pairs on a device.  Included in more than
// one namespace, as sph_dissipation_kernel_shapes.h; each namespace must have a type Vec, square_root(a), larger(a, b), and
// if_positive(a, b), see sph_dissipation_simd.h.
//
// r = r_i - r_j, u = u_i - u_j, slope = F; P1, P2, P3: see sph_dissipation_channels.h.  Forces act on i, the opposite forces
// on j; each particle gets half of the heat of a pair.

// Added to r and r^2 before a division: two particles at the same point, r = 0, exert no force on each other

constexpr double TINY = 1.0e-300;

template <class Real> SPH_INLINE Real dot(const Real *a, const Real *b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Return F V_i V_j, 0 for r = 0

template <class Real> SPH_INLINE Real volumes_slope(Real rsq, double vol_i, Real vol_j, Real slope)
{
  return if_positive(rsq, vol_i * vol_j * slope);
}

// Return the force of pressure and bulk term of the form density, F (g_i + g_j) r, over r; P1 (12), (18)

template <class Real> SPH_INLINE Real pressing_term(double g_i, Real g_j, Real slope)
{
  return (g_i + g_j) * slope;
}

// Return the metric of the drag along e: r or r^2

template <bool BY_DISTANCE, class Real> SPH_INLINE Real metric_of(Real rsq)
{
  if constexpr (BY_DISTANCE)
    return square_root(rsq);
  else
    return rsq;
}

// Replace u by u* = u - (w_i + w_j)/2 x r with the spins w: the velocity of slip at the point of contact, P3 (6)

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

// Input and sums of the terms of a pair

struct PairState {
  const Vec *coeff;    // of the types, in the order of PairCoeff
  Vec r[3];
  Vec u[3];         // in add_vector(), with spins, the velocity of slip
  Vec s[3];         // difference of the spins
  Vec approach;     // r.u
  Vec vv;           // F V_i V_j
  Vec by_metric;    // F V_i V_j / metric
  Vec mu[2];        // of i and j, if mu is not constant; negative: boundary particle

  Vec central;           // force on i along r, times 1/r
  Vec f[3];              // force on i
  Vec t[3];              // torque on both, with spins
  Vec spin[3];           // torque on j, opposite on i, with spins
  Vec heat[NCHANNEL];    // half of the heat, by channel
};

// Term of a channel, with the coefficients FIRST to LAST in pair.coeff.  add_central() of all terms runs before
// add_vector().  Terms add to force, torques, and the heat of their channel, which begin with zero (central: with the
// pressure).

template <class Of, int FIRST_COEFF, int LAST_COEFF = FIRST_COEFF> struct PairTerm {
  static constexpr int CHANNEL = Channels::place<Of>();
  static constexpr int FIRST = Channels::first<Of>() + FIRST_COEFF;
  static constexpr int LAST = Channels::first<Of>() + LAST_COEFF;
  static constexpr bool CENTRAL = false, VECTOR = false;    // has add_central(), add_vector()
  static constexpr bool BY_DISTANCE = false;                // metric r instead of r^2
  static constexpr bool BY_SQUARE = false;                  // along r, in units of F r^2 V_i V_j
  static constexpr bool SPINS = false;
  static constexpr bool BY_RATE = false;    // reads the viscosities of the particles
  template <class Pair> static SPH_INLINE void add_central(Pair &) {}
  template <class Pair> static SPH_INLINE void add_vector(Pair &) {}
};

// -a F V_i V_j (u.r) r with a coefficient of a channel

template <class Of, int COEFF> struct AlongBySquare : PairTerm<Of, COEFF> {
  using Term = PairTerm<Of, COEFF>;
  static constexpr bool CENTRAL = true, BY_SQUARE = true;
  template <class Pair> static SPH_INLINE void add_central(Pair &pair)
  {
    const auto drag = pair.coeff[Term::FIRST] * pair.vv * pair.approach;
    pair.central -= drag;
    pair.heat[Term::CHANNEL] += 0.5 * drag * pair.approach;
  }
};

// Compute the heat of the channels, without forces

template <class Form> SPH_INLINE void find_heat(PairState &pair)
{
  for (int c = 0; c < NCHANNEL; c++)
    if (Form::heats(c)) pair.heat[c] = Vec();
  Form::add_central(pair);
  Form::add_vector(pair);
}

// After add_vector(): give the fluid all heat of a pair with a boundary; no change if is_boundary is 0.  The heat is the
// work of the friction at the boundary's own velocity and spin: q(u) + q(u - excess) - q(excess), with the quadratic form q,
// half of the heat of the pair.  excess: a copy of the pair with u, s, and approach of the excess, see struct Excess

template <class Form>
SPH_INLINE void add_boundary_heat(PairState &pair, PairState &excess, Vec is_boundary)
{
  PairState own = excess;
  for (int d = 0; d < 3; d++) {
    own.u[d] = pair.u[d] - excess.u[d];
    if constexpr (Form::SPINS) own.s[d] = pair.s[d] - excess.s[d];
  }
  own.approach = pair.approach - excess.approach;
  find_heat<Form>(own);
  find_heat<Form>(excess);
  for (int c = 0; c < NCHANNEL; c++)
    if (Form::heats(c)) pair.heat[c] += is_boundary * (own.heat[c] - excess.heat[c]);
}

// A flow, see sph_dissipation_flows.h: return the mean of the coefficients of two particles, 0 if one is 0; return
// the rate that i gets from j, with vv = F V_i V_j

template <class Own, class Real> SPH_INLINE Real mean_coefficient(Own a, Real b)
{
  return 2.0 * a * b / (a + b + TINY);
}

template <class Real>
SPH_INLINE Real flow_of_pair(Real coefficient, Real vv, double value_i, Real value_j)
{
  return 2.0 * coefficient * vv * (value_j - value_i);
}

// Diffusion of volume, see sph_dissipation_diffusion_terms.h: return F over the mean of two impedances; set the terms of a
// pair, over V_j, in the sums of pressure_gradient(), from difference = p_i - p_j; return the difference less the difference
// by the gradient

template <class Real> SPH_INLINE Real slope_by_impedance(Real slope, double z_i, Real z_j)
{
  return 2.0 * slope / (z_i + z_j);
}

template <int DIM, class Real>
SPH_INLINE void gradient_terms(Real slope, Real difference, const Real *r, Real *term)
{
  int m = 0;
  for (int d = 0; d < DIM; d++)
    for (int e = d; e < DIM; e++) term[m++] = slope * r[d] * r[e];
  for (int d = 0; d < DIM; d++) term[m++] = slope * difference * r[d];
}

template <int DIM, class Of, class Real>
SPH_INLINE Real without_gradient(Real difference, const Of *gradient, const Real *r)
{
  for (int d = 0; d < DIM; d++) difference -= gradient[d] * r[d];
  return difference;
}

#define CHANNEL_TERMS
#include "sph_dissipation_channels.h"
#undef CHANNEL_TERMS
