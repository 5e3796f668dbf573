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
PairStyle(sph/micropolar/kk,PairSPHMicropolarKokkos<LMPDeviceType>);
PairStyle(sph/micropolar/kk/device,PairSPHMicropolarKokkos<LMPDeviceType>);
PairStyle(sph/micropolar/kk/host,PairSPHMicropolarKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_PAIR_SPH_MICROPOLAR_KOKKOS_H
#define LMP_PAIR_SPH_MICROPOLAR_KOKKOS_H

#include "pair_sph_bulk_kokkos.h"

namespace LAMMPS_NS {

// Pair style sph/bulk/kk with particles that spin

template <class DeviceType> class PairSPHMicropolarKokkos : public PairSPHBulkKokkos<DeviceType> {
 public:
  PairSPHMicropolarKokkos(class LAMMPS *lmp) : PairSPHBulkKokkos<DeviceType>(lmp, true) {}
};

}    // namespace LAMMPS_NS

#endif
#endif
