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

#ifndef LMP_SPH_DISSIPATION_PARTICLE_TERMS_H
#define LMP_SPH_DISSIPATION_PARTICLE_TERMS_H

// Between the passes: what follows for one particle from its density.  No LAMMPS include.

#include "sph_dissipation_channels.h"
#include "sph_dissipation_eos.h"
#include "sph_dissipation_rows.h"

namespace LAMMPS_NS {
namespace SPHDissipation {

  // P/c^2 of pass 2, of the pressure P with the bulk term (bulk density) or without (otherwise), the
  // volume V = w/c, and the reference volume w

  SPH_FUNCTION double pressure_term(double total, double vol, double weight)
  {
    const double c_inv = vol / weight;
    return total * c_inv * c_inv;
  }

  // a particle whose mass density rho and pressure P are prescribed, where density and volume do not
  // follow from pass 1

  SPH_FUNCTION void set_state(Particle &particle, double mass, double rho, double total,
                              double weight)
  {
    particle.vol = mass / rho;
    particle.g = pressure_term(total, particle.vol, weight);
  }

  struct ParticleTerms {
    double zeta_term;    // zeta cdot/c
    double g;            // (p + zeta cdot/c) / c^2 (bulk density), p/c^2 (otherwise)
    double work;         // of the pressure, energy per time
  };

  // volume V = w/c with the reference volume w, density c and its rate cdot, mass density rho, internal
  // energy per mass e; P1 (12), (18)

  SPH_FUNCTION ParticleTerms particle_terms(Eos eos, const EosParams &par, Bulk bulk, double zeta,
                                            double vol, double weight, double cdot, double rho,
                                            double e)
  {
    const double c_inv = vol / weight;
    const double rate = cdot * c_inv;
    const double p = pressure(eos, par, rho, e);
    const double zeta_term = zeta * rate;
    const double total = (bulk == Bulk::DENSITY) ? p + zeta_term : p;
    return {zeta_term, pressure_term(total, vol, weight), p * vol * rate};
  }

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
