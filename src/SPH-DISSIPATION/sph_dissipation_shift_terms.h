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

// Particle shifting: gradient of the particle concentration, and displacement.  S. J. Lind et al.,
// J. Comput. Phys. 231, 1499 (2012); P. N. Sun et al. (2017).  No LAMMPS include.

#include "sph_dissipation_function.h"

#include <cmath>

namespace LAMMPS_NS {
namespace SPHDissipation {

  // 1/shape at the distance of a neighbor on a lattice of particles of this volume

  template <class K> SPH_FUNCTION double contact_inverse(int dim, double support, double vol)
  {
    const double q = spacing_of(dim, vol) / support;
    return 1.0 / K::shape((q < 0.9) ? q : 0.9);
  }

  // weight of r_ij, for a neighbor of volume V, slope F and this shape of the kernel, in the gradient
  //   sum_j V_j F [1 + 0.2 (W/W(spacing))^4] r_ij,
  // whose second term keeps particles from pairing

  SPH_FUNCTION double concentration_push(double vol, double slope, double shape, double contact)
  {
    constexpr double PAIRING = 0.2;
    const double close = shape * contact * shape * contact;
    return vol * (slope * (1.0 + PAIRING * close * close));
  }

  // displacement in a time dt: Fickian, with the velocity U R gradient, at most U/2

  SPH_FUNCTION void shift_particle(double speed, double support, double dt, const double *gradient,
                                   double *x)
  {
    const double scale = speed * support;
    const double wanted = scale *
        sqrt(gradient[0] * gradient[0] + gradient[1] * gradient[1] + gradient[2] * gradient[2]);
    const double limit = (wanted > 0.5 * speed) ? 0.5 * speed / wanted : 1.0;
    for (int d = 0; d < 3; d++) x[d] += dt * limit * scale * gradient[d];
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
