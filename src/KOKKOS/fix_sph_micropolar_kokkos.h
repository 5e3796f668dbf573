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

#ifdef FIX_CLASS
// clang-format off
FixStyle(sph/micropolar/kk,FixSPHMicropolarKokkos<LMPDeviceType>);
FixStyle(sph/micropolar/kk/device,FixSPHMicropolarKokkos<LMPDeviceType>);
FixStyle(sph/micropolar/kk/host,FixSPHMicropolarKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_FIX_SPH_MICROPOLAR_KOKKOS_H
#define LMP_FIX_SPH_MICROPOLAR_KOKKOS_H

#include "fix_sph_bulk_kokkos.h"

namespace LAMMPS_NS {

// The integration of sph/bulk/kk, with the fluid and the atom style sph/micropolar/kk

template <class DeviceType> class FixSPHMicropolarKokkos : public FixSPHBulkKokkos<DeviceType> {
 public:
  using FixSPHBulkKokkos<DeviceType>::FixSPHBulkKokkos;
};

}    // namespace LAMMPS_NS

#endif
#endif
