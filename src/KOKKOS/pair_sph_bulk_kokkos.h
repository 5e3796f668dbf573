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
#include "sph_dissipation_columns_kokkos.h"

#include <vector>

namespace LAMMPS_NS {
namespace SPHDissipation {
  class Threads;
  template <class DeviceType> class BoundaryStageKokkos;
  template <class DeviceType> struct LoopDataKokkos;
  struct TypeKokkos;
}    // namespace SPHDissipation

// The pair style on the device, with full neighbor lists; or on the host by the loops of the CPU style
// and half lists, with the threads of KOKKOS, see runs_on_device().  On a device, what is not written for
// it, see on_host_because(), is computed on the host from copies of the particles, too; so are the
// reports at the start of a run.

template <class DeviceType>
class PairSPHBulkKokkos : virtual public PairSPHBulk, public KokkosBase {
 public:
  PairSPHBulkKokkos(class LAMMPS *);
  ~PairSPHBulkKokkos() override;

  void compute(int, int) override;
  void init_style() override;
  void init_list(int, class NeighList *) override;
  double memory_usage() override;

  void announce() override;
  void set_mean_density(int) override;
  void find_volumes() override;
  void heating(double *, double *) const override;
  bool has_forces() const override;
  double elastic_energy(Moment) override;

  int pack_forward_comm_kokkos(int, DAT::tdual_int_1d, DAT::tdual_double_1d &, int, int *) override;
  void unpack_forward_comm_kokkos(int, int, DAT::tdual_double_1d &) override;

  bool computes_on_device() const { return on_device; }
  typedef Kokkos::View<double *[3], Kokkos::LayoutRight, DeviceType> Crowding;
  Crowding crowding_on_device() const { return crowding_of; }    // of owned particles

  // of compute(); public because CUDA asks for it of functions with lambdas

  void set_particles();
  void set_spins();
  void set_state();
  void find_bound();
  int beyond_bound_of_limit() const;
  void find_crowding();
  void run_density();
  void run_forces(bool virial);

 private:
  bool on_device;
  bool copied;    // coefficients on the device are those of the model
  SPHDissipation::Threads *threads;
  class NeighList *kokkos_list;    // of LAMMPS
  class NeighList *host_list;      // half; for what runs on the host
  std::vector<int> host_ilist, host_numneigh, host_neighbors;
  std::vector<int *> host_firstneigh;
  SPHDissipation::ColumnsKokkos sent;
  int nlocal_device, nghost_device;    // # of atoms of the last computation on the device

  SPHDissipation::LoopDataKokkos<DeviceType> *data;
  Kokkos::View<SPHDissipation::TypeKokkos *, DeviceType> *types;
  Kokkos::View<double *, DeviceType> bound;    // of the limit, see LimitStage
  Crowding crowding_of;
  SPHDissipation::BoundaryStageKokkos<DeviceType> *boundary_device;

  bool runs_on_device() const;
  std::string on_host_because() const;
  template <class Function> void on_host(Function &&);
  void build_host_list();
  void refer_to_list();
  void grow();
  void copy_coeffs();
  bool communicates_on_device() const;
  void send_density();
  void send_boundary();
  template <class Loop> void run_loop(const Loop &, bool virial);
  template <class K, class Form> void run_force_loop(bool virial);
};

}    // namespace LAMMPS_NS

#endif
#endif
