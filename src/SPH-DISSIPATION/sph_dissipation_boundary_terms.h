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

// Terms of pairs of a fluid particle f and a boundary particle w: Real is a vector of f on the CPU, one number on a device.
// Files include this header in more than one namespace, see sph_dissipation_pair_terms.h; the namespace must also have
// larger(a, b) and smaller(a, b).
//
// r = x_w - x_f; S. Adami, X. Y. Hu, N. A. Adams, J. Comput. Phys. 231, 7057 (2012)

template <class Real> SPH_INLINE Real along(const double *a, const Real *b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Return V W of a boundary particle at the distance r

template <class K, class Real> SPH_INLINE Real part_filled(const NearKernel &wall, Real r)
{
  return wall.norm * K::shape(smaller(r * wall.scale, Real() + 1.0));
}

// Return the distance of f from the surface, at least CLOSEST spacings

template <class Real> SPH_INLINE Real height_above(const Surface &s, const Real *r)
{
  return larger(-s.depth - along(s.normal, r), Real() + CLOSEST * s.spacing);
}

// Return the factor of symmetric friction, (d + h)/d, with the distances d of f and h of w from the surface.  A relative
// velocity that is linear in d and zero at the surface continues behind the surface as -h times the slope.  Friction with
// this continuation is friction with the velocity of the body, times the factor.  Unknown surface: d is the distance of the
// first layer of a lattice.

template <class Real>
SPH_INLINE Real surface_factor(const Surface &s, const Real *r, double support)
{
  const bool known = along(s.normal, s.normal) > 0.0;
  const double least = known ? CLOSEST_PAIR * support : FIRST_LAYER * s.spacing;
  const Real d = larger(-s.depth - along(s.normal, r), Real() + least);
  return (d + s.depth) / d;
}

template <class Real, class Sums>
SPH_INLINE void add_distances(Real weight, Real height, Sums &total)
{
  const Real weight_d3 = weight * height * height * height, weight_d4 = weight_d3 * height;
  total.weight += weight;
  total.d += weight * height;
  total.d3 += weight_d3;
  total.d4 += weight_d4;
  total.d5 += weight_d4 * height;
  total.d6 += weight_d4 * height * height;
}

// Add f to the sums of w; return the distance of f from the surface.  kernel_weight = W(r), w_f = weight of f in the loops,
// vol_0 = mass of f over the reference density of its type.  F has the members u, vol, g of a Particle

template <class Real, class F, class Number>
SPH_INLINE Real add_fluid(const F &f, const Particle &w, const Real *r, Real kernel_weight,
                          const Surface &s, Real rho, Real w_f, Real vol_0, Real zeta_term,
                          BoundarySums<Number> &total)
{
  const Real weight = f.vol * kernel_weight;
  const Real height = height_above(s, r);
  const Real weight_d3 = weight * height * height * height, weight_d4 = weight_d3 * height;
  const Real turn[3] = {s.omega[1] * r[2] - s.omega[2] * r[1],
                        s.omega[2] * r[0] - s.omega[0] * r[2],
                        s.omega[0] * r[1] - s.omega[1] * r[0]};

  add_distances(weight, height, total);
  for (int d = 0; d < 3; d++) {
    const Real relative = f.u[d] - w.u[d] + turn[d];
    total.rho_r[d] += weight * rho * r[d];
    total.u[d] += weight * relative;
    total.ud3[d] += weight_d3 * relative;
    total.ud4[d] += weight_d4 * relative;
  }
  total.density += kernel_weight * vol_0;
  total.pressure += kernel_weight * w_f * w_f * f.g / f.vol;
  total.zeta_term += weight * zeta_term;
  return height;
}

// Add the spin of f to the sums of w; weight = V_f W, height from add_fluid()

template <class Real, class Number>
SPH_INLINE void add_fluid_spin(const Real *spin, Real weight, Real height, const Surface &s,
                               BoundarySums<Number> &total)
{
  for (int d = 0; d < 3; d++) {
    const Real weighted = weight * height * height * height * (spin[d] - s.omega[d]);
    total.wd3[d] += weighted;
    total.wd4[d] += weighted * height;
  }
}

// Add the temperature of f, if f conducts heat, to the sums of w; weight_f = V_f W, slope = F, coefficient: coefficient of w
// F has the members vol, value, coefficient of a FlowRow

template <class Real, class F, class Number>
SPH_INLINE void add_fluid_heat(const F &f, Real weight_f, Real slope, Real height,
                               double coefficient, BoundaryHeatSums<Number> &total)
{
  const Real weight = if_positive(f.coefficient, weight_f);
  const Real weight_d3 = weight * height * height * height, weight_d4 = weight_d3 * height;
  add_distances(weight, height, total);
  total.td3 += weight_d3 * f.value;
  total.td4 += weight_d4 * f.value;
  total.coefficient += weight * f.coefficient;
  if (!(coefficient > 0.0)) return;
  const Real flow = f.vol * slope * f.coefficient * coefficient / (f.coefficient + coefficient);
  total.flow += flow;
  total.tflow += flow * f.value;
}
