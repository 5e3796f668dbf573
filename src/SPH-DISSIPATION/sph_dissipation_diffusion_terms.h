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

#ifndef LMP_SPH_DISSIPATION_DIFFUSION_TERMS_H
#define LMP_SPH_DISSIPATION_DIFFUSION_TERMS_H

// Diffusion of volume between particles of the fluid, for density continuity.  No LAMMPS include.
//
//   dV_i/dt = V_i sum_j a_ij V_j [p_i - p_j - (g_i + g_j).r_ij/2],   a_ij = 4 delta h F/(Z_i + Z_j)
//
// with the acoustic impedance Z = rho0 c0 and h = rc/2.  g is the gradient of the pressure: it minimizes the residual
//   R_i = sum_j a_ij V_j (p_i - p_j - g_i.r_ij)^2.
// No pair changes the sum of the volumes.  The elastic energy of the particles decreases by sum_i V_i R_i/2 per time; this
// energy becomes heat, V_i R_i/2 of particle i.  The residual has the weights a_ij V_j of the flow of volume: with other
// weights, the heat could be negative.  The gradient makes hydrostatic pressure exact, as M. Antuono et al., Comput. Phys.
// Commun. 181, 532 (2010); the variables here conserve volume and have a known heat.

#include "sph_dissipation_tensor.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // Input of the loops for a particle, one cache line.  Volume 0: the particle takes no part.  The order of the numbers is,
  // in one and two dimensions, x y V p, gradient; in three, x y z V, p gradient

  struct alignas(64) DiffusionRow {
    double a[8] = {};
  };

  template <int DIM> struct DiffusionPlaces {
    static constexpr int VOL = (DIM == 3) ? 3 : 2, P = VOL + 1, G = P + 1;
    // sum a V r r by rows of the upper half; sum a V (p_i - p_j) r; with two impedances, sum V F r r less Z times the first
    // sum
    static constexpr int NTENSOR = DIM * (DIM + 1) / 2, NSUM = NTENSOR + DIM;
  };
  struct alignas(64) SumBlock {
    double a[8] = {};
  };
  SPH_FUNCTION int place_of_volume(int dim)
  {
    return (dim == 3) ? 3 : 2;
  }
  inline int number_of_sums(int dim, bool alike)
  {
    return size_of_tensor(dim) * (alike ? 1 : 2) + dim;
  }

  // Return the width of the rows of sums; alike: all particles have the same impedance

  constexpr int width_of_sums(int dim, bool alike)
  {
    return (dim < 3) ? 8 : alike ? 12 : 16;
  }

  struct DiffusionData {
    const DiffusionRow *row;
    const double *impedance;    // Z of each particle; not read if it is the same for all
  };

  // Return the rate of the fastest mode of the diffusion; stiffness = largest rho0 c^2, impedance = mean of two fluids; h
  // and stability_length_squared() as for the channels.  7 delta c0/h for one fluid with Wendland's C2; measured on square,
  // hexagonal, and cubic lattices

  inline double diffusion_rate(double delta, double h, double hsq, double stiffness,
                               double impedance)
  {
    return 7.0 * delta * h / hsq * stiffness / impedance;
  }

  // Set the gradient g of the pressure from the sums of a particle.  filled = sum_j V_j F r r, the tensor of the sums
  // without impedances.  Return the smallest eigenvalue of filled, 1 inside of all fluids.  If it is near zero, neighbors
  // are too few, or on one line or plane: set the gradient to zero.

  constexpr double LEAST_SUPPORT = 0.01;

  SPH_FUNCTION double pressure_gradient(int dim, const double *sums, const double *filled,
                                        double *g)
  {
    const double smallest = smallest_eigenvalue(dim, filled);
    for (int k = 0; k < dim; k++) g[k] = 0.0;
    if (smallest >= LEAST_SUPPORT) solve_tensor(dim, sums, sums + size_of_tensor(dim), g);
    return smallest;
  }

  // Set the rates of the volume of a particle and, work included, of its internal energy.  row = its row from the volume on;
  // flow = its sums of the flow; factor = factor of a_ij that the loops leave out

  SPH_FUNCTION void volume_rates(const double *row, const double *flow, double factor, double &rate,
                                 double &heat)
  {
    const double vol = row[0], p = row[1];
    rate = vol * factor * flow[0];
    heat = 0.5 * vol * factor * flow[1] - p * rate;
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
