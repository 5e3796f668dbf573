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

#ifndef LMP_SPH_DISSIPATION_FLUID_KOKKOS_H
#define LMP_SPH_DISSIPATION_FLUID_KOKKOS_H

#include "sph_dissipation_columns_kokkos.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_masks_kokkos.h"

#include <vector>

namespace LAMMPS_NS {
class NeighList;

namespace SPHDissipation {

  class Threads;
  template <class DeviceType> class BoundaryStageKokkos;
  template <class DeviceType> struct LoopDataKokkos;
  struct TypeKokkos;

  // the fields of particles that the forces read and modify; the atom style leaves out those that it
  // does not have

  constexpr uint64_t FLUID_READ = X_MASK | F_MASK | TYPE_MASK | MASK_MASK | RMASS_MASK | ESPH_MASK |
      VEST_MASK | TORQUE_MASK | OMEGAEST_MASK;
  constexpr uint64_t FLUID_DERIVED = SPH_RHO_MASK | DRHO_MASK | VFRAC_MASK;
  constexpr uint64_t FLUID_MODIFIED = F_MASK | TORQUE_MASK | DESPH_MASK | FLUID_DERIVED;

  // The fluid on the device, with full neighbor lists; or on the host by the loops of the CPU style and
  // half lists, with the threads of KOKKOS.  The reports at the start of a run are made on the host.

  template <class DeviceType> class FluidKokkos : public Fluid {
   public:
    FluidKokkos(class LAMMPS *, Pair *, bool spins);
    ~FluidKokkos() override;

    // from the pair style: where forces are computed in this run; the neighbor list of LAMMPS

    void choose(bool device);
    void init_list(NeighList *);
    bool computes_on_device() const { return on_device; }
    ColumnsKokkos sent;    // to ghosts, by the pair style's packing on the device

    bigint compute(PairTally *) override;
    double elastic_energy(Moment) override;
    void heating(double *, double *) const override;
    void announce() override;
    double memory_usage() const override;

    typedef Kokkos::View<double *[3], Kokkos::LayoutRight, DeviceType> Gradient;
    Gradient gradient_on_device() const { return gradient_of; }    // of owned particles

    // of compute(); public because CUDA asks for it of functions with lambdas

    void set_particles();
    void set_spins();
    void set_state();
    void find_bound();
    int beyond_bound_of_limit() const;
    void find_gradient();
    void run_density();
    void run_forces(bool virial);

   private:
    static constexpr uint64_t ENERGY = SPH_RHO_MASK | RMASS_MASK | TYPE_MASK | MASK_MASK;

    bool on_device;
    bool copied;    // coefficients on the device are those of the model
    std::unique_ptr<Threads> threads;
    NeighList *kokkos_list;                  // of LAMMPS
    std::unique_ptr<NeighList> host_list;    // half; for what runs on the host
    std::vector<int> host_ilist, host_numneigh, host_neighbors;
    std::vector<int *> host_firstneigh;
    int nlocal_device, nghost_device;    // # of atoms of the last computation on the device

    std::unique_ptr<LoopDataKokkos<DeviceType>> data;
    std::unique_ptr<Kokkos::View<TypeKokkos *, DeviceType>> types;
    Kokkos::View<double *, DeviceType> bound;    // of the limit, see LimitStage
    Gradient gradient_of;
    std::unique_ptr<BoundaryStageKokkos<DeviceType>> boundary_device;

    bool has_own_forces() const override;
    void on_host(const std::function<void()> &) override;
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

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
