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

// Large viscosities on the device

#include "sph_dissipation_boundary_kokkos.h"
#include "sph_dissipation_shared_viscous.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

template class SPHDissipation::StiffStage<DeviceSpace<LMPDeviceType>>;
template class SPHDissipation::ViscousStage<DeviceSpace<LMPDeviceType>>;
#ifdef LMP_KOKKOS_GPU
template class SPHDissipation::StiffStage<DeviceSpace<LMPHostType>>;
template class SPHDissipation::ViscousStage<DeviceSpace<LMPHostType>>;
#endif
