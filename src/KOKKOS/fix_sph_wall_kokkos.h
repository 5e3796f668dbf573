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
FixStyle(sph/wall/kk,FixSPHWallKokkos<LMPDeviceType>);
FixStyle(sph/wall/kk/device,FixSPHWallKokkos<LMPDeviceType>);
FixStyle(sph/wall/kk/host,FixSPHWallKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_FIX_SPH_WALL_KOKKOS_H
#define LMP_FIX_SPH_WALL_KOKKOS_H

#include "fix_sph_wall.h"
#include "kokkos_base.h"
#include "sph_dissipation_boundary_kokkos.h"

namespace LAMMPS_NS {

// fix sph/wall with the work of every step on the device; the CPU style does the start of a run, and minimizations, on the
// host

template <class DeviceType>
class FixSPHWallKokkos :
    public FixSPHWall,
    public KokkosBase,
    public SPHDissipation::BoundaryKokkos<DeviceType> {
 public:
  FixSPHWallKokkos(class LAMMPS *, int, char **);
  ~FixSPHWallKokkos() override;
  void setup_pre_exchange() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void post_integrate() override;
  void final_integrate() override;
  void end_of_step() override;
  void pre_force(int) override;
  void post_force(int) override;
  void min_post_force(int) override;
  void post_run() override;

  void grow_arrays(int) override;
  void set_arrays(int) override;
  void copy_arrays(int, int, int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  void sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &) override;
  int pack_exchange_kokkos(const int &, DAT::tdual_double_2d_lr &, DAT::tdual_int_1d,
                           DAT::tdual_int_1d, ExecutionSpace) override;
  void unpack_exchange_kokkos(DAT::tdual_double_2d_lr &, DAT::tdual_int_1d &, int, int, int,
                              ExecutionSpace) override;
  double memory_usage() override;

  void move_surface_kokkos(const SPHDissipation::BoundaryDataKokkos<DeviceType> &, bool) override;
  void set_boundary_kokkos(const SPHDissipation::BoundaryDataKokkos<DeviceType> &,
                           const SPHDissipation::LoopDataKokkos<DeviceType> &) override;

  // public, because CUDA requires this of functions with lambdas, and of the types in these

  void find_particles();
  struct BodyMotion {
    double omega[3], rotation[3][3];    // acting spin; rotation of the last step
  };

 private:
  Kokkos::DualView<double *[6], Kokkos::LayoutRight, LMPDeviceType> k_array;    // array_atom
  Kokkos::View<int *, DeviceType> particles;    // owned wall particles, since the neighbor list
  int nparticles;
  Kokkos::View<BodyMotion *, DeviceType> moving;    // by body
  // on a GPU: values of these particles that the host gets in each step
  static constexpr bool ON_HOST = std::is_same_v<DeviceType, LMPHostType>;
  Kokkos::View<double *[6], Kokkos::LayoutRight, DeviceType> packed;
  Kokkos::View<double *[6], Kokkos::LayoutRight, Kokkos::HostSpace> values;
  Kokkos::View<int *, Kokkos::HostSpace> numbers;
  Kokkos::View<double *, DeviceType>
      heat_values;    // by owned particle, if heat is a variable of atom style
};

}    // namespace LAMMPS_NS

#endif
#endif
