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

#include "sph_dissipation_arrays_kokkos.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_noise_data.h"
#include "sph_dissipation_space_kokkos.h"
#include "sph_dissipation_viscous.h"

#include <vector>

namespace LAMMPS_NS {
class NeighList;

namespace SPHDissipation {

  class Threads;
  template <class DeviceType> class BoundaryStageKokkos;

  // Fields that tasks of the host change

  constexpr uint64_t FLUID_SET_ON_HOST =
      RMASS_MASK | STATES_MASK | OFFSET_MASK | ESPH_MASK | DESPH_BEFORE_MASK | FLUID_DERIVED;

  // The fluid on the device, with full neighbor lists; or on the host, with the loops of the CPU style, half lists, and the
  // threads of KOKKOS.  Reports at the start of a run are made on the host.

  template <class DeviceType> class FluidKokkos : public Fluid {
   public:
    FluidKokkos(class LAMMPS *, Pair *, bool spins);
    ~FluidKokkos() override;

    // Called by the pair style before init(): choose where forces are computed in this run

    void choose(bool device);
    void request_list() override;
    DeviceSpace<DeviceType> space;

    void adopt() override;
    bigint compute(PairTally *) override;
    double elastic_energy(Moment) override;
    void heating(double *, double *) const override;
    OwnForces forces_for_steps() override;
    bool computes_on_device() const override { return on_device; }
    double received_heat(int groupbit) const override;
    void get_from_device(uint64_t fields) const override;
    void give_to_device() const override;
    double memory_usage() const override;

    // Stages on the device; public, because CUDA requires this of functions with lambdas

    void sum_density(StepData &);
    void set_reference_volume(StepData &);
    void set_viscosities(StepData &);
    void set_velocity(StepData &);
    void set_noise(StepData &);
    void sum_forces(StepData &);
    void set_zones(StepData &);
    void set_ghosts_of_zones();
    void sum_impacts(StepData &);
    void add_wall_friction(StepData &);
    void sum_tension(StepData &);
    void sum_flows(StepData &);
    void evaluate_diffusion(StepData &);

    // On the device if it was chosen

    void list_stages() override;
    void begin_run(double dt, bool continues, const Changes &) override;
    void advance_states() override;
    void shift_particles(double keep) override;
    void fence() const override { Kokkos::fence(); }

   private:
    static constexpr uint64_t STATES = SPH_RHO_MASK | TYPE_MASK | MASK_MASK | STATES_MASK;
    static constexpr uint64_t ENERGY = STATES | RMASS_MASK;
    static constexpr uint64_t HEAT = ENERGY | ESPH_MASK | DESPH_MASK | DRHO_MASK | OFFSET_MASK;

    bool on_device;
    std::unique_ptr<Threads> threads;
    std::unique_ptr<NeighList> host_list;    // half; for what runs on the host
    std::vector<int> host_neighbors;
    int nlocal_device, nghost_device;    // # of atoms of the last computation on the device

    // Stages on the device

    typedef DeviceSpace<DeviceType> Space;
    DensityStage<Space> density_device;
    LimitStage<Space> limit_device;
    ViscosityStage<Space> viscosity_device;
    PressureStage<Space> pressure_device;
    StateStage<Space> state_device;
    FlowStage<Space> flows_device;
    DiffusionStage<Space> diffusion_device;
    ShiftStage<Space> shift_device;
    Kokkos::View<NoiseCoeff *, DeviceType> noise_coeff;
    double noise_factor = 0.0;                     // 2 kT/dt
    Kokkos::View<double *, DeviceType> tension;    // energies of owned particles in the last forces
    std::unique_ptr<BoundaryStageKokkos<DeviceType>> boundary_device;
    ViscousStage<Space> viscous_device;
    std::vector<int>
        zone_particles;    // OpenZone::zone_particles() of all zones, in ascending order
    SomeParticlesKokkos<DeviceType> near_zones;
    Kokkos::View<double *, DeviceType> zone_of;    // see OpenGroups

    bool has_own_forces() const override;
    double wall_energy(double *) const override;
    void on_host(const std::function<void()> &) override;
    void for_report(const std::function<void()> &) override;
    void build_host_list();
    double tension_energy(double *, int groupbit) const override;
    const double *bound_device() const;    // see Fluid::bound()
    template <class K, int DIM> void run_diffusion();
    template <class Form> void run_impacts();
    template <class K, class Form> void run_wall_friction(const StepData &);
    template <class K, class Form, class Pairs>
    void run_noise(const StepData &, int n, const Pairs &);
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
