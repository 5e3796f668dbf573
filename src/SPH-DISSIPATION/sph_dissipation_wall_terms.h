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

#ifndef LMP_SPH_DISSIPATION_WALL_TERMS_H
#define LMP_SPH_DISSIPATION_WALL_TERMS_H

// Motion of a rigid wall; sums over the fluid around a boundary particle; values of the particle from these sums, as
// S. Adami, X. Y. Hu, N. A. Adams, J. Comput. Phys. 231, 7057 (2012).  In addition, velocity, spin and temperature continue
// behind the surface.  No LAMMPS include.

#include "sph_dissipation_rows.h"
#include "sph_dissipation_settings.h"
#include "sph_dissipation_tensor.h"

#include <cmath>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Extrapolation of a field q of the fluid behind a surface, by a least-squares fit with weights d^2.  d = distance of a
  // fluid particle from the surface; for small d, q/d is not a slope.  The fit needs the means <q d^3>, <q d^4>, and those
  // of d^3 to d^6.  With these weights, viscous forces damp differences between layers of particles not faster than inside
  // of the fluid.  Each distance is at least CLOSEST spacings of the particles, and the mean distance at least CLOSEST_MEAN
  // spacings, a little less than the distance of the first layer of a lattice.  A wall particle without a known surface has
  // the depth CLOSEST_MEAN spacings.

  constexpr double CLOSEST = 0.25;
  constexpr double CLOSEST_MEAN = 0.45;

  // CLOSEST_PAIR: least distance d in surface_factor(), in support radii.  So the viscous rate of a particle next to the
  // surface is at most the same multiple of nu/h^2 with any spacing.  FIRST_LAYER: d if the surface is unknown, in spacings.

  constexpr double CLOSEST_PAIR = 0.05, FIRST_LAYER = 0.5;

  // Fit of a field next to a surface, q = level + slope d + bend d^2.  behind(): return q at d = -depth, behind the surface

  struct Extension {
    double level, slope, bend;
    SPH_FUNCTION double behind(double depth) const
    {
      return level + depth * (bend * depth - slope);
    }
  };

  // Means of d^3 to d^6 over the fluid around a boundary particle; fits with these and f_d3 = <q d^3>, f_d4 = <q d^4>

  struct DistanceMeans {
    double d3, d4, d5, d6;

    // Fit q with zero at the surface: minimize <d^2 (q - slope d - bend d^2)^2> + STIFF depth^2 (bend depth^2)^2.  The
    // second term makes the field straight deep in a wall, where only the first layer contributes.  <d^6> has the factor
    // 1 + alike: if all distances are equal, the fit has no other solution than a straight field.  The fit of a field
    // without a bend is exact.  alike is smaller for the spin, because diffusion of the spin and the vortex viscosity bend
    // the spin next to the surface.

    static constexpr double STIFF = 0.001, ALIKE = 0.01, ALIKE_SPIN = 0.001;

    SPH_FUNCTION Extension stuck(double f_d3, double f_d4, double depth, double alike) const
    {
      const double depth_cubed = depth * depth * depth;
      const double sixth = (1.0 + alike) * d6 + STIFF * depth_cubed * depth_cubed;
      const double norm = 1.0 / (d4 * sixth - d5 * d5);
      return {0.0, norm * (f_d3 * sixth - f_d4 * d5), norm * (f_d4 * d4 - f_d3 * d5)};
    }

    // The next two fits multiply <d^6>, or <d^3> <d^5>, by 1 + DAMPING: so the fitted values stay in the range of the values
    // of the fluid

    static constexpr double DAMPING = 0.1;

    // Fit q with a derivative of zero at the surface

    SPH_FUNCTION Extension free(double f_d3, double f_d4) const
    {
      const double sixth = (1.0 + DAMPING) * d6;
      const double norm = 1.0 / (d3 * sixth - d5 * d4);
      return {norm * (f_d3 * sixth - f_d4 * d5), 0.0, norm * (f_d4 * d3 - f_d3 * d4)};
    }

    // Return the slope of a straight line fitted to q

    SPH_FUNCTION double straight_slope(double f_d3, double f_d4) const
    {
      return (f_d4 * d3 - f_d3 * d4) / ((1.0 + DAMPING) * d3 * d5 - d4 * d4);
    }
  };

  // Place of the surface relative to a boundary particle w

  struct Surface {
    double normal[3];      // toward the fluid; zero: unknown
    double depth;          // distance of w from the surface
    double spacing;        // of the particles
    double curvature;      // mean curvature, > 0: convex
    double flat_depth;     // distance from the tangential planes, for surface_heat()
    double flux_volume;    // volume of w for a flux of heat
    double omega[3];       // angular velocity of the rigid body of w
  };

  // Type of the sums below: a number, or a vector in the loops; in a struct, since compilers warn of vectors as arguments

  struct OneNumber {
    typedef double type;
  };

  // Sums over the fluid particles f around a boundary particle w, of V_f W(r_wf) times the quantity; S. Adami et al.,
  // J. Comput. Phys. 231, 7057 (2012).  Relative velocity and spin: less the rigid motion of the body of w at the place of f.
  // d: distance of f from the surface

  template <class Number> struct BoundarySums {
    typedef typename Number::type Real;
    Real weight;        // 1
    Real rho_r[3];      // density times x_w - x_f
    Real density;       // density over the reference density of its type
    Real pressure;      // p + zeta cdot/c (bulk density), p (otherwise)
    Real zeta_term;     // zeta cdot/c
    Real d, d3;         // d, d^3
    Real d4, d5, d6;    // d^4, d^5, d^6
    Real u[3];          // relative velocity
    Real ud3[3];        // relative velocity times d^3
    Real ud4[3];        // relative velocity times d^4
    Real wd3[3];        // relative spin times d^3 (micropolar)
    Real wd4[3];        // relative spin times d^4 (micropolar)

    static constexpr int OF_SPIN = 6;    // numbers in wd3 and wd4, the last members
  };

  struct BoundarySum : BoundarySums<OneNumber> {};

  // The same sums over only the fluid particles that conduct heat

  template <class Number> struct BoundaryHeatSums {
    typedef typename Number::type Real;
    Real weight;               // 1
    Real d, d3, d4, d5, d6;    // d to the powers
    Real td3, td4;             // temperature times d^3, d^4
    Real coefficient;
    Real flow,
        tflow;    // heat per time to w, per its volume and temperature; the same times temperature
  };

  struct BoundaryHeatSum : BoundaryHeatSums<OneNumber> {};

  // Rigid motion of a wall: velocity of a point on the axis, and rotation about the axis.  r = vector from the point

  struct WallVelocity {
    double point[3], axis[3];
    double u[3], omega;         // velocity of the point, angular velocity
    double rate[3], turning;    // time derivatives of u and omega

    SPH_FUNCTION void angular(double *w) const
    {
      for (int d = 0; d < 3; d++) w[d] = omega * axis[d];
    }

    SPH_FUNCTION void at(const double *r, double *v) const
    {
      double w[3];
      angular(w);
      cross_product(w, r, v);
      for (int d = 0; d < 3; d++) v[d] += u[d];
    }

    SPH_FUNCTION void acceleration_at(const double *r, double *a) const
    {
      double w[3], turn[3], centripetal[3];
      angular(w);
      cross_product(w, r, turn);
      cross_product(w, turn, centripetal);
      cross_product(axis, r, a);
      for (int d = 0; d < 3; d++) a[d] = rate[d] + turning * a[d] + centripetal[d];
    }
  };

  // Displacement of a wall in a step, r -> rotation r + shift, r from the point on the axis; move(): displace x

  struct WallStep {
    double rotation[3][3], shift[3];

    SPH_FUNCTION void turn(const double *r, double *turned) const
    {
      for (int d = 0; d < 3; d++) turned[d] = inner_product(rotation[d], r);
    }

    SPH_FUNCTION void move(const double *r, double *x) const
    {
      double turned[3];
      turn(r, turned);
      for (int d = 0; d < 3; d++) x[d] += shift[d] + (turned[d] - r[d]);
    }
  };

  // Boundary condition of a wall

  enum class WallSpin { ZERO, RATE, FREE };
  enum class WallHeat { ADIABATIC, TEMPERATURE, FLUX };

  struct WallCondition {
    bool slip;
    WallSpin spin;
    double alpha;    // with WallSpin::RATE: spin at the surface over half the vorticity
    double gravity[3];
  };

  // A fluid particle is inside a wall if boundary particles fill more than this part of its near support.  The near support
  // is the smallest support of a fluid, a few particle spacings wide.  Boundary particles fill half of the near support at a
  // plane surface, 7/8 in the corner of a box, and more only inside.  In a larger support, a particle in a pore that is one
  // spacing wide would count as inside.

  constexpr double INSIDE_WALL = 0.9;

  struct NearKernel {
    double norm, scale;    // V W = norm * shape(scale * r)
  };

  // Return the near kernel of a boundary particle with the volume vol, for a fluid with W = weight_norm * shape

  SPH_FUNCTION NearKernel near_kernel(int dim, double support, double weight_norm, double vol)
  {
    const double spacings = (dim == 1) ? 4.0 : (dim == 2) ? 3.0 : 2.5;
    const double wanted = spacings * spacing_of(dim, vol);
    const double radius = (support < wanted) ? support : wanted;
    return {vol * weight_norm * whole_power(support / radius, dim), 1.0 / radius};
  }

  // Repulsion of the surfaces with thermal noise or free surfaces: a fluid particle has the energy k s^2/2.  s = part of a
  // support of CONTACT spacings that boundary particles fill, less 1/2.  This part is 1/2 at the surface and at least 0.96
  // inside of lattices.  Spray is faster than the fluid: with free surfaces, a particle with s > DEEP has also the energy
  // k' (s - DEEP)^2/2, together 0.3 m c0^2 inside of lattices.

  constexpr double CONTACT = 1.7;
  typedef WendlandC2 ContactKernel;
  constexpr Kernel CONTACT_KERNEL = Kernel::WENDLAND_C2;    // that of ContactKernel
  constexpr double HARDNESS_OF_SURFACE = 0.05;              // k/2 of free surfaces, over m c0^2
  constexpr double HARDNESS_OF_CORE = 3.0;                  // k'/2, over m c0^2
  constexpr double DEEP = 0.15;

  struct Repulsion {
    double stiffness, core;    // k, k'
  };

  // Return the contact kernel of a boundary particle with the volume vol; norm = of ContactKernel

  SPH_FUNCTION NearKernel contact_kernel(int dim, double support, double norm, double vol)
  {
    const double wanted = CONTACT * spacing_of(dim, vol);
    const double radius = (support < wanted) ? support : wanted;
    return {vol * norm / whole_power(radius, dim), 1.0 / radius};
  }

  SPH_FUNCTION double beyond_surface(double occupied)
  {
    return (occupied > 0.5) ? occupied - 0.5 : 0.0;
  }

  SPH_FUNCTION Repulsion repulsion_of_surface(double mass, double c0)
  {
    const double energy = mass * c0 * c0;
    return {2.0 * HARDNESS_OF_SURFACE * energy, 2.0 * HARDNESS_OF_CORE * energy};
  }

  SPH_FUNCTION double beyond_core(double s)
  {
    return (s > DEEP) ? s - DEEP : 0.0;
  }

  SPH_FUNCTION double energy_of_repulsion(const Repulsion &k, double s)
  {
    const double deep = beyond_core(s);
    return 0.5 * (k.stiffness * s * s + k.core * deep * deep);
  }

  // Return the force on a fluid particle at this distance from a boundary particle, over this distance

  SPH_FUNCTION double force_of_repulsion(const Repulsion &k, double s, const NearKernel &wall,
                                         double distance)
  {
    const double q = distance * wall.scale;
    if (!(s > 0.0 && q < 1.0)) return 0.0;
    return (k.stiffness * s + k.core * beyond_core(s)) * wall.norm * wall.scale * wall.scale *
        ContactKernel::slope(q);
  }

  // Return the pressure of a wall particle with this acceleration, extrapolated from the fluid around; sum.weight > 0

  SPH_FUNCTION double wall_pressure(const BoundarySum &sum, const double *gravity,
                                    const double *acceleration)
  {
    const double norm = 1.0 / sum.weight;
    double pressure = sum.pressure * norm;
    for (int d = 0; d < 3; d++) pressure += (gravity[d] - acceleration[d]) * sum.rho_r[d] * norm;
    return pressure;
  }

  // Return the pressure of a wall particle with this acceleration, from the background pressure pb, without the fluid

  SPH_FUNCTION double surface_pressure(const Surface &surface, double rho0, double pb,
                                       const double *gravity, const double *acceleration)
  {
    double pressure = pb;
    for (int d = 0; d < 3; d++)
      pressure -= rho0 * (gravity[d] - acceleration[d]) * surface.depth * surface.normal[d];
    return pressure;
  }

  // Factors that turn sums with d, d^3, d^4 into means (sum.weight > 0); means of d^3 to d^6.  <d> is at least CLOSEST_MEAN

  struct DistanceNorms {
    double d, d3, d4;
    DistanceMeans mean;
  };

  template <class Sum>
  SPH_FUNCTION DistanceNorms distance_norms(const Sum &sum, const Surface &surface)
  {
    const double norm = 1.0 / sum.weight;
    const double needed = CLOSEST_MEAN * surface.spacing / (norm * sum.d);
    const double stretch = (needed > 1.0) ? needed : 1.0;
    const double norm_d3 = norm * stretch * stretch * stretch, norm_d4 = norm_d3 * stretch;
    return {norm * stretch,
            norm_d3,
            norm_d4,
            {norm_d3 * sum.d3, norm_d4 * sum.d4, norm_d4 * stretch * sum.d5,
             norm_d4 * stretch * stretch * sum.d6}};
  }

  // Continue velocity and spin of the fluid behind the surface by the boundary condition: add the continued values to u and
  // spin of a wall particle, which hold velocity and spin of the wall (spin: nullptr without spins); sum.weight > 0

  SPH_FUNCTION void extend_motion(const WallCondition &condition, const Surface &surface,
                                  const BoundarySum &sum, double *u, double *spin)
  {
    const double norm = 1.0 / sum.weight;
    const DistanceNorms norms = distance_norms(sum, surface);
    const DistanceMeans &distance = norms.mean;
    const double norm_d3 = norms.d3, norm_d4 = norms.d4, mean_d = norms.d * sum.d;
    const double *const normal = surface.normal;
    const double depth = surface.depth;

    // The normal velocity is zero at the surface.  With no-slip, the slope of the normal velocity is zero, too: the mirrored
    // mean velocity is enough, and needs no smaller time step

    const double mirrored = (depth < mean_d) ? depth / mean_d : 1.0;
    const double across = inner_product(sum.u, normal) * norm;
    const double across_d3 = inner_product(sum.ud3, normal) * norm_d3;
    const double across_d4 = inner_product(sum.ud4, normal) * norm_d4;
    double slope[3];
    for (int d = 0; d < 3; d++) {
      const double along_d3 = sum.ud3[d] * norm_d3 - across_d3 * normal[d];
      const double along_d4 = sum.ud4[d] * norm_d4 - across_d4 * normal[d];
      const Extension along = condition.slip
          ? distance.free(along_d3, along_d4)
          : distance.stuck(along_d3, along_d4, depth, DistanceMeans::ALIKE);
      slope[d] = condition.slip ? distance.straight_slope(along_d3, along_d4) : along.slope;
      u[d] += along.behind(depth) - mirrored * across * normal[d];
    }
    if (!spin) return;

    // the vorticity relative to the wall is normal x slope

    double surface_spin[3] = {0.0, 0.0, 0.0};
    if (condition.spin == WallSpin::RATE) cross_product(normal, slope, surface_spin);
    for (int d = 0; d < 3; d++) {
      const double at_surface = 0.5 * condition.alpha * surface_spin[d];
      const double s_d3 = sum.wd3[d] * norm_d3 - at_surface * distance.d3;
      const double s_d4 = sum.wd4[d] * norm_d4 - at_surface * distance.d4;
      const Extension beyond = (condition.spin == WallSpin::FREE)
          ? distance.free(s_d3, s_d4)
          : distance.stuck(s_d3, s_d4, depth, DistanceMeans::ALIKE_SPIN);
      spin[d] += at_surface + beyond.behind(depth);
    }
  }

  // Return the values of a wall particle of volume vol in the conduction of heat, sum.weight > 0.  value = heat per area and
  // time, or temperature at the surface.  With a temperature, the temperature of the fluid continues behind the surface, as
  // the tangential velocity does; the conductivity is the mean of the fluid around.  An adiabatic particle has the
  // temperature at which it gets no heat.  A pair across the surface also conducts heat along the surface, for fluid and
  // wall: so an adiabatic particle has half of its volume.

  SPH_FUNCTION FlowRow wall_conductor(WallHeat heat, double value, double vol, double conductivity,
                                      const Surface &surface, const BoundaryHeatSum &sum)
  {
    if (heat == WallHeat::ADIABATIC) {
      if (!(sum.flow > 0.0)) return {0.0, 0.0, 0.0, 0.0};
      return {0.5 * vol, sum.tflow / sum.flow, conductivity, 0.0};
    }
    if (heat == WallHeat::FLUX) return {0.0, 0.0, 0.0, value};
    const DistanceNorms norms = distance_norms(sum, surface);
    const Extension beyond = norms.mean.stuck(sum.td3 * norms.d3 - value * norms.mean.d3,
                                              sum.td4 * norms.d4 - value * norms.mean.d4,
                                              surface.depth, DistanceMeans::ALIKE);
    return {vol, value + beyond.behind(surface.depth), sum.coefficient / sum.weight, 0.0};
  }

  // Return the heat per time that the fluid particle f gets from the surface by a wall particle w, r = x_w - x_f.  The sum
  // of 2 V_f V_w F |r.n| over all pairs is the area of the surface, if n is the normal where the pair crosses the surface:
  // the integral of F z^2 over one half of space is 1/2.  C = divergence of the normals over the dimensions of the surface.
  // C <= 0, hollow or plane: n is on average the normal in the middle, n_w - C t/2, t = part of r along the surface.
  // C > 0, convex: the surface is a sphere of radius 1/C + h, h = flat_depth.  The pair crosses the sphere at x_w - s r, with
  // the normal (n_w - C s r)/(1 + C h), and s, at most 1, is the part of r at which this normal has the length 1.
  // V_w is the reference volume times flux_factor(): then the sum is exact on cubic lattices.

  SPH_FUNCTION double surface_heat(double flux, double vol_f, const double *r, double slope,
                                   const Surface &surface)
  {
    const double across = -inner_product(r, surface.normal), rsq = inner_product(r, r);
    const double turn = surface.curvature * rsq;
    double seen = across + 0.5 * (turn - surface.curvature * across * across);
    if (turn > 0.0) {
      const double stretch = 1.0 + surface.curvature * surface.flat_depth;
      const double rise = surface.flat_depth * (1.0 + stretch);
      const double way = across + sqrt(across * across + turn * rise);
      seen = (way > rise) ? (across + turn * rise / way) / stretch : (across + turn) / stretch;
    }
    return 2.0 * flux * vol_f * surface.flux_volume * slope * seen;
  }

  // Return the factor by which the sum of surface_heat() over a cubic lattice is too small.  sums.zeroth corrects the volumes
  // V = 1/c, which are too small; sums.second corrects the difference between the sum of F z^2 and the integral

  inline double flux_factor(const LatticeSums &sums)
  {
    return sums.zeroth / sums.second;
  }

  // Set the values of wall particle i, with this acceleration, for pass 2, extrapolated from the fluid; sum.weight > 0.  The
  // particle gets the mean density over reference density of the fluid around: so, with any fluids, the volume of the
  // particle is the volume of a fluid particle at this place.  A wall does not pull on a fluid without tension.

  template <class Rows>    // ParticleRows
  SPH_FUNCTION void extend_fluid(const Rows &rows, int i, const WallCondition &condition,
                                 const Surface &surface, const BoundarySum &sum,
                                 const double *acceleration, double *spin)
  {
    const double norm = 1.0 / sum.weight;
    const double pressure = wall_pressure(sum, condition.gravity, acceleration);
    const double density = rows.types[rows.type[i]].eos.rho0 * sum.density * norm;
    rows.set_state(i, density, (pressure > 0.0 || rows.par.tension) ? pressure : 0.0);
    rows.zeta_term[i] = sum.zeta_term * norm;
    extend_motion(condition, surface, sum, rows.particle[i].u, spin);
  }

  // The same with thermal noise: the wall has its own motion, volume, and friction, so that the friction matrix is symmetric.
  // Its pressure does not depend on the fluid, so that the force has an energy

  template <class Rows>
  SPH_FUNCTION void rest_at_surface(const Rows &rows, int i, const WallCondition &condition,
                                    const Surface &surface, const double *acceleration)
  {
    const auto &eos = rows.types[rows.type[i]].eos;
    rows.set_state(i, eos.rho0,
                   surface_pressure(surface, eos.rho0, eos.pb, condition.gravity, acceleration));
    rows.zeta_term[i] = 0.0;
  }

  // Return the first c of a body particle with density continuity, and set its rho_sum.  If fluid fills the rest of the
  // support, c gives the pressure of this fluid at rest.  If fluid fills at most EMPTY of the rest, c belongs to the body
  // alone: fluid that comes later does not compress this particle.  In between, c is the linear mean of both.  others, sum,
  // gravity: see set_frozen()

  template <class Rows>
  SPH_FUNCTION double begin_frozen(const Rows &rows, int i, double others, const BoundarySum *sum,
                                   const double *gravity)
  {
    constexpr double EMPTY = 0.8, FULL = 1.0;    // filled part of the support without the body
    constexpr double REST[3] = {0.0, 0.0, 0.0};
    const auto &eos = rows.types[rows.type[i]].eos;
    const double weight = rows.weight[i * rows.each], mass = rows.rmass[i] / weight;
    rows.rho_sum[i] = -mass * rows.density[i].c;
    const double c = rows.density[i].c + others;
    if (!sum || !(sum->weight > 0.0)) return c;

    BoundarySum fluid = *sum;
    fluid.pressure -= fluid.zeta_term;
    double p = wall_pressure(fluid, gravity, REST);
    if (!rows.par.tension && p < 0.0) p = 0.0;
    const double own = rows.reference_volume(i) * (others / weight + rows.par.self_weight);
    const double part = (fluid.weight / (1.0 - own) - EMPTY) / (FULL - EMPTY);
    const double rho = cold_density_at(rows.par.eos, eos, p);
    if (!(rho > 0.0 && part > 0.0)) return c;
    return c + ((part < 1.0) ? part : 1.0) * (rho / mass - c);
  }

  // Give a body particle the pressure of frozen fluid.  others = number density from the other particles of its body; sum =
  // over the fluid around, or nullptr, and gravity = acceleration of the fluid: density continuity reads them for the first
  // density

  template <class Rows>
  SPH_FUNCTION void set_frozen(const Rows &rows, int i, double others, const BoundarySum *sum,
                               const double *gravity)
  {
    double c = rows.density[i].c;    // with an offset, c includes the other particles of the body
    if (!rows.par.continuity)
      c += others;
    else if (!(rows.rho_sum[i] < 0.0))
      c = begin_frozen(rows, i, others, sum, gravity);
    rows.freeze(i, c);
  }

  // Set the excess of a boundary particle: velocity and spin (nullptr: none) in pass 2, less its own velocity u and the spin
  // of its rigid body

  SPH_FUNCTION void set_excess(Excess &excess, const Particle &particle, const double *u,
                               const double *spin, const Surface &surface)
  {
    excess.is_boundary = 1.0;
    for (int d = 0; d < 3; d++) {
      excess.u[d] = particle.u[d] - u[d];
      if (spin) excess.w[d] = spin[d] - surface.omega[d];
    }
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
