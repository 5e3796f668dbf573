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

#ifndef LMP_SPH_DISSIPATION_SPECTRUM_H
#define LMP_SPH_DISSIPATION_SPECTRUM_H

// Spectra of a periodic flow.  No LAMMPS include.
//
// A velocity field u = sum_k u_k exp(i k.x) is the sum of a solenoidal part, u_k at right angles to k,
// and a dilatational one, u_k along k (Helmholtz); a uniform flow, k = 0, counts as solenoidal.  The
// mean of the product of two real fields is the sum of a_k b_k^* over all modes (Parseval).  Notation:
// P. Sagaut, C. Cambon, Homogeneous Turbulence Dynamics (Springer, 2018).

#include "sph_dissipation_kernel.h"

#include <complex>

namespace LAMMPS_NS {
namespace SPHDissipation {

  using Amplitude = std::complex<double>;

  // wave number of mode i of n points along a length: -n/2 to (n-1)/2 wave lengths in it

  inline double wave_number(int i, int n, double length)
  {
    return 2.0 * KERNEL_PI / length * (i <= (n - 1) / 2 ? i : i - n);
  }

  // of one mode of a velocity field: energies |u|^2/2 of both parts, squares of curl and divergence

  struct ModeEnergies {
    double solenoidal, dilatational, curl2, div2;
  };

  inline ModeEnergies split(const double *k, const Amplitude *u)
  {
    const double ksq = k[0] * k[0] + k[1] * k[1] + k[2] * k[2];
    if (ksq == 0.0)
      return {0.5 * (std::norm(u[0]) + std::norm(u[1]) + std::norm(u[2])), 0.0, 0.0, 0.0};
    const double div2 = std::norm(k[0] * u[0] + k[1] * u[1] + k[2] * u[2]);
    const double curl2 = std::norm(k[1] * u[2] - k[2] * u[1]) +
        std::norm(k[2] * u[0] - k[0] * u[2]) + std::norm(k[0] * u[1] - k[1] * u[0]);
    return {0.5 * curl2 / ksq, 0.5 * div2 / ksq, curl2, div2};
  }

  // Power per volume that a Newtonian fluid of uniform viscosities dissipates in a periodic box:
  // mu <curl^2> + (kappa + 2 mu (1 - 1/n)) <div^2>, exact, as the cross terms of the strain rates are
  // divergences.  Coefficient of <div^2>, also called lambda + 2 mu.

  inline double longitudinal_viscosity(double mu, double kappa, int n)
  {
    return kappa + 2.0 * mu * (1.0 - 1.0 / n);
  }

  // Factor by which the squared amplitude of a mode is to be multiplied to undo the smoothing by the
  // kernel, 1/W_k^2; where less than half of the amplitude is left, it is not raised any more.

  inline double deconvolution(Kernel kernel, int n, double k, double support)
  {
    const double transform = kernel_transform(kernel, n, k, support);
    return 1.0 / (transform > 0.5 ? transform * transform : 0.25);
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
