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
PairStyle(sph/bulk/kk,PairSPHBulkKokkos<LMPDeviceType>);
PairStyle(sph/bulk/kk/device,PairSPHBulkKokkos<LMPDeviceType>);
PairStyle(sph/bulk/kk/host,PairSPHBulkKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_PAIR_SPH_BULK_KOKKOS_H
#define LMP_PAIR_SPH_BULK_KOKKOS_H

#include "kokkos_base.h"
#include "pair_kokkos.h"
#include "pair_sph_bulk.h"

#include <set>
#include <string>

namespace LAMMPS_NS {
namespace SPHDissipation {
  template <class DeviceType> class FluidKokkos;
}

// Interface of LAMMPS to a FluidKokkos.  Chooses in every run between device and host for the forces, see runs_on_device();
// settings without code for the device, see on_host_because(), run on the host with copies of the particles.

template <class DeviceType> class PairSPHBulkKokkos : public PairSPHBulk, public KokkosBase {
 public:
  PairSPHBulkKokkos(class LAMMPS *, bool spins = false);

  void init_style() override;
  int pack_forward_comm_kokkos(int, DAT::tdual_int_1d, DAT::tdual_double_1d &, int, int *) override;
  void unpack_forward_comm_kokkos(int, int, DAT::tdual_double_1d &) override;

 private:
  SPHDissipation::FluidKokkos<DeviceType> *const device;    // the fluid

  bool runs_on_device() const;
  std::string on_host_because() const;
  std::string viscous_on_host_because() const;
  std::set<std::string> copying;    // fixes of the warning
  void warn_of_copies();
};

}    // namespace LAMMPS_NS

#endif
#endif
