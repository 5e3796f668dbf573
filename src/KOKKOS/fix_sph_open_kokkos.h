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
FixStyle(sph/open/kk,FixSPHOpenKokkos<LMPDeviceType>);
FixStyle(sph/open/kk/device,FixSPHOpenKokkos<LMPDeviceType>);
FixStyle(sph/open/kk/host,FixSPHOpenKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_FIX_SPH_OPEN_KOKKOS_H
#define LMP_FIX_SPH_OPEN_KOKKOS_H

#include "fix_sph_open.h"

#include <memory>

namespace LAMMPS_NS {
namespace SPHDissipation {
  template <class DeviceType> class SomeParticlesKokkos;
}

// fix sph/open, whose work the host does.  In most steps, the particles of the zone and near it alone are copied

template <class DeviceType> class FixSPHOpenKokkos : public FixSPHOpen {
 public:
  FixSPHOpenKokkos(class LAMMPS *, int, char **);
  ~FixSPHOpenKokkos() override;
  void setup_pre_exchange() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void post_integrate() override;
  void pre_exchange() override;
  void pre_neighbor() override;
  void final_integrate() override;
  double memory_usage() override;

 private:
  const std::unique_ptr<SPHDissipation::SomeParticlesKokkos<DeviceType>>
      some;                  // of the zone and near it
  bool on_device = false;    // the last setup found the particles of the fluid on the device

  template <class Task> void with_all(const Task &);
  template <class Task> void with_some(uint64_t fields, const Task &);
};

}    // namespace LAMMPS_NS

#endif
#endif
