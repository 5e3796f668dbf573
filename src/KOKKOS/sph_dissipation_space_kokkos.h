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

#ifndef LMP_SPH_DISSIPATION_SPACE_KOKKOS_H
#define LMP_SPH_DISSIPATION_SPACE_KOKKOS_H

#include "sph_dissipation_columns_kokkos.h"
#include "sph_dissipation_masks.h"
#include "sph_dissipation_parameters.h"
#include "sph_dissipation_space.h"

#include <memory>
#include <vector>

namespace LAMMPS_NS {
class Pair;

namespace SPHDissipation {
  template <class DeviceType> struct LoopDataKokkos;
  template <class DeviceType> class BoundaryStageKokkos;

  // Fields of particles that the forces read and modify; the atom style ignores fields that it does not have

  constexpr uint64_t FLUID_READ = X_MASK | F_MASK | TYPE_MASK | MASK_MASK | RMASS_MASK | ESPH_MASK |
      VEST_MASK | TORQUE_MASK | OMEGAEST_MASK | STATES_MASK;
  constexpr uint64_t FLUID_DERIVED = SPH_RHO_MASK | DRHO_MASK | VFRAC_MASK;
  constexpr uint64_t FLUID_MODIFIED =
      F_MASK | TORQUE_MASK | DESPH_MASK | STATES_MASK | FLUID_DERIVED;

  // The device as a space of stages, see HostSpace: the arrays of the loops, loops over full neighbor lists, in which each
  // particle sums up its own pairs, and messages to ghosts.  Ghosts never have sums.

  template <class DeviceType> class DeviceSpace : protected Pointers {
   public:
    template <class T> using Array = Kokkos::View<T *, DeviceType>;
    typedef BoundaryStageKokkos<DeviceType> Boundaries;

    DeviceSpace(class LAMMPS *, Pair *, Engine &, Exchange &);
    ~DeviceSpace() override;

    // Begin a force computation: prepare() copies the coefficients if they are new, and the fields of particles; begin() also
    // sets the input of pass 1 of owned and ghost atoms.  not_fluid = bits of the groups of walls and open zones
    void prepare();
    void begin(int not_fluid);

    // With large viscosities, pass 2 adds to forces() and torques(); add_forces(): add these to the arrays of LAMMPS
    void keep_forces(bool keep) { keeps_forces = keep; }
    void add_forces() const;
    void sum_forces(bool tally);    // pass 2
    void copy_coeffs();
    void forget_coeffs() { copied = false; }
    uint64_t read_mask() const;    // fields that the forces read, and modify
    uint64_t modified_mask() const;
    void set_particles(int not_fluid);

    // The functions of HostSpace

    int nforce() const;
    const Parameters &parameters() const { return engine.parameters(); }
    const ParticleRows &rows() const;
    StateRows states();
    const int *mask() const;
    VectorField x() const, v() const, vest() const, omega() const, omegaest() const;
    const double *inertia() const;
    double *energies() const;
    Spin *spins() const;
    template <class T> static T *reach(Array<T> &array, const char *name, std::size_t n)
    {
      return SPHDissipation::reach(array, name, static_cast<int>(n));
    }
    template <class... One> static double bytes_of(const One &...one)
    {
      return SPHDissipation::bytes_of(one...);
    }
    template <class Function> void for_each(const char *name, int n, const Function &function) const
    {
      SPHDissipation::for_each<DeviceType>(name, n, function);
    }
    template <class Sum, class Add> Sum sum(const char *name, int n, const Add &add) const
    {
      Sum total = 0;
      Kokkos::parallel_reduce(name, Kokkos::RangePolicy<DeviceType>(0, n), add, total);
      return total;
    }
    void forward(const std::vector<Field> &);
    void reverse(const std::vector<Field> &) {}
    void sum_density(NeighList *, double **, double **, bool);
    template <class Sum> void sum_pairs(const char *name, const Sum &);
    void set_shear_rates(int not_fluid);
    double *sum_flow(int k);
    void sum_rates();
    void sum_friction(NeighList *, int not_fluid);
    void collect_forces() {}
    VectorField forces() const, torques() const;
    double *flow_rate(int k) { return flow_rates[k].data(); }
    void forget_flows() { flows_known = false; }

    // Run a loop with the virial of each particle, see VirialLoopKokkos; tally: add up the virial
    template <class Loop> void run_loop(const char *name, int n, const Loop &, bool tally);

    double memory_usage() const;

    const std::unique_ptr<LoopDataKokkos<DeviceType>> data;
    ColumnsKokkos sent;                     // to ghosts, by the pair style's packing on the device
    Array<double> pair_energy, cohesion;    // see Parameters

   private:
    Pair *const pair;
    Engine &engine;
    Exchange &exchange;
    bool keeps_forces = false;
    bool copied = false;         // coefficients on the device are those of the model
    bool flows_known = false;    // rates of the flows, from this run

    // Arrays to which data refers

    Array<TypeParameters> types;
    Array<PairCoeff> pair_coeff;
    Array<Particle> particle;
    Array<DensitySum> density_sum;
    Array<Spin> spin;
    Array<double> zeta_term, state_pressure, weight, viscosity;
    Array<FlowRow> flow[Flows::NUMBER];
    Array<double> flow_rates[Flows::NUMBER];
    typename ArrayTypes<DeviceType>::t_kkacc_1d_3 own_force, own_torque;

    void grow();
    void clear_forces();
    void set_states();
  };

}    // namespace SPHDissipation
}    // namespace LAMMPS_NS

#endif
