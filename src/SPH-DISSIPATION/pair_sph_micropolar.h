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

#ifdef PAIR_CLASS
// clang-format off
PairStyle(sph/micropolar,PairSPHMicropolar);
// clang-format on
#else

#ifndef LMP_PAIR_SPH_MICROPOLAR_H
#define LMP_PAIR_SPH_MICROPOLAR_H

#include "pair_sph_bulk.h"

namespace LAMMPS_NS {

// The fluid of sph/bulk with particles that spin: vortex viscosity mu_r between spin and flow, spin
// viscosities gamma1, gamma2 between the spins.

class PairSPHMicropolar : virtual public PairSPHBulk {
 public:
  PairSPHMicropolar(class LAMMPS *);

 protected:
  static const std::string NAME;

  void check_setup() override;
  double **extrapolated_spin() override;
  const double *spin_inertia() override;

 private:
  class AtomVecSPHMicropolar *spinning() const;
};

}    // namespace LAMMPS_NS

#endif
#endif
