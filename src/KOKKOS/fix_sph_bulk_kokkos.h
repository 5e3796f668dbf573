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
FixStyle(sph/bulk/kk,FixSPHBulkKokkos<LMPDeviceType>);
FixStyle(sph/bulk/kk/device,FixSPHBulkKokkos<LMPDeviceType>);
FixStyle(sph/bulk/kk/host,FixSPHBulkKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_FIX_SPH_BULK_KOKKOS_H
#define LMP_FIX_SPH_BULK_KOKKOS_H

#include "fix_sph_bulk.h"
#include "kokkos_type.h"

namespace LAMMPS_NS {

// fix sph/bulk with the work of every step on the device.  The CPU style does three things on the host: steps with a pair
// style on the host that exchange energy exactly, velocities that fix deform remaps, and the start of a run.

template <class DeviceType> class FixSPHBulkKokkos : public FixSPHBulk {
 public:
  FixSPHBulkKokkos(class LAMMPS *, int, char **);
  void setup_pre_exchange() override;
  void setup_pre_force(int) override;
  void setup(int) override;
  void initial_integrate(int) override;
  void post_integrate() override;
  void pre_force(int) override;
  void final_integrate() override;
  void post_run() override;
  void write_restart(FILE *) override;

  // Integrate on the device; public, because CUDA requires this of functions with lambdas

  void integrate_on_device(Half);
  bool anybody_without_inertia() const;

 private:
  bool on_host() const;
  uint64_t modified_mask(Half) const;
  SPHDissipation::VolumeStep volume_step_on_device() const;
};

}    // namespace LAMMPS_NS

#endif
#endif
