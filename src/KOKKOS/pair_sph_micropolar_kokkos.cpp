/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#include "pair_sph_micropolar_kokkos.h"

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

template <class DeviceType>
PairSPHMicropolarKokkos<DeviceType>::PairSPHMicropolarKokkos(LAMMPS *lmp) :
    PairSPHBulk(lmp, NAME, true), PairSPHBulkKokkos<DeviceType>(lmp), PairSPHMicropolar(lmp)
{
}

/* ---------------------------------------------------------------------- */

namespace LAMMPS_NS {
template class PairSPHMicropolarKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class PairSPHMicropolarKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
