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
#include "sph_dissipation_diffusion_terms.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_masks_kokkos.h"
#include "sph_dissipation_parameters.h"
#include "sph_dissipation_rows.h"
#include "sph_dissipation_shift_terms.h"

#include <vector>

namespace LAMMPS_NS {
class NeighList;

namespace SPHDissipation {

  class Threads;
  template <class DeviceType> class BoundaryStageKokkos;
  template <class DeviceType> struct LoopDataKokkos;
  template <class DeviceType> struct ShiftDataKokkos;

  // Fields of particles that the forces read and modify; the atom style ignores fields that it does not have

  constexpr uint64_t FLUID_READ = X_MASK | F_MASK | TYPE_MASK | MASK_MASK | RMASS_MASK | ESPH_MASK |
      VEST_MASK | TORQUE_MASK | OMEGAEST_MASK | STATES_MASK;
  constexpr uint64_t FLUID_DERIVED = SPH_RHO_MASK | DRHO_MASK | VFRAC_MASK;
  constexpr uint64_t FLUID_MODIFIED =
      F_MASK | TORQUE_MASK | DESPH_MASK | STATES_MASK | FLUID_DERIVED;
  constexpr uint64_t FLUID_SET_ON_HOST = RMASS_MASK | STATES_MASK | OFFSET_MASK | FLUID_DERIVED;

  // The fluid on the device, with full neighbor lists; or on the host, with the loops of the CPU style, half lists, and the
  // threads of KOKKOS.  Reports at the start of a run are made on the host.

  template <class DeviceType> class FluidKokkos : public Fluid {
   public:
    FluidKokkos(class LAMMPS *, Pair *, bool spins);
    ~FluidKokkos() override;

    // Called by the pair style before init(): choose where forces are computed in this run

    void choose(bool device);
    void request_list() override;
    uint64_t read_mask() const;    // fields that the forces read on the device, and modify
    uint64_t modified_mask() const;
    ColumnsKokkos sent;    // to ghosts, by the pair style's packing on the device

    void adopt() override;
    bigint compute(PairTally *) override;
    double elastic_energy(Moment) override;
    void heating(double *, double *) const override;
    double received_heat(int groupbit) const override;
    double memory_usage() const override;

    // Stages on the device; public, because CUDA requires this of functions with lambdas

    void sum_density(StepData &);
    void sum_bound(StepData &);
    void set_reference_volume(StepData &);
    void set_pressure(StepData &);
    void set_boundary(StepData &);
    void sum_forces(StepData &);
    void sum_flows(StepData &);
    void evaluate_diffusion(StepData &);
    void add_diffusion_heat(StepData &);

    // On the device if it was chosen

    void list_stages() override;
    void begin_run(double dt, bool continues, const Changes &) override;
    void advance_states() override;
    void shift_particles(double keep) override;
    template <class K> void run_shift(const ShiftDataKokkos<DeviceType> &);
    void fence() const override { Kokkos::fence(); }
    void set_particles();

   private:
    static constexpr uint64_t STATES = SPH_RHO_MASK | TYPE_MASK | MASK_MASK | STATES_MASK;
    static constexpr uint64_t ENERGY = STATES | RMASS_MASK;
    static constexpr uint64_t HEAT = ENERGY | ESPH_MASK | DESPH_MASK | DRHO_MASK;

    bool on_device;
    bool copied;         // coefficients on the device are those of the model
    bool rates_known;    // those of the flows, from this run
    std::unique_ptr<Threads> threads;
    std::unique_ptr<NeighList> host_list;    // half; for what runs on the host
    std::vector<int> host_neighbors;
    int nlocal_device, nghost_device;    // # of atoms of the last computation on the device

    // Arrays on the device to which data refers

    template <class T> using Array = Kokkos::View<T *, DeviceType>;
    std::unique_ptr<LoopDataKokkos<DeviceType>> data;
    Array<TypeParameters> types;
    Array<PairCoeff> pair_coeff;
    Array<Particle> particle;
    Array<DensitySum> density_sum;
    Array<Spin> spin;
    Array<double> zeta_term, state_pressure, weight;
    Array<FlowRow> flow[Flows::NUMBER];
    Array<double>
        flow_rate[Flows::NUMBER];    // of states, and of heat if boundaries give it, see FlowStage
    Array<double> bound_of;          // of the limit, see LimitStage
    Array<ShiftRow> shift_row;       // see ShiftStage
    Array<ShiftReturn> shift_return;
    Array<DiffusionRow> diffusion_row;    // see DiffusionStage
    Array<double> impedance;
    std::unique_ptr<BoundaryStageKokkos<DeviceType>> boundary_device;

    bool has_own_forces() const override;
    double wall_energy(double *) const override;
    void on_host(const std::function<void()> &) override;
    void for_report(const std::function<void()> &) override;
    void build_host_list();
    void grow();
    void set_states();
    void copy_coeffs();
    void send_to_ghosts(const std::vector<Field> &);
    template <template <class, class> class Loop, class... More>
    void sum_pairs(const char *name, const More &...);
    bool has_rate(int place) const;    // of a flow
    template <class Loop> void run_loop(const char *name, int n, const Loop &, bool virial);
    template <class K, int DIM> void run_diffusion();
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
