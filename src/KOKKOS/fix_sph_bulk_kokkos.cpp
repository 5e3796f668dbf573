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

/* ----------------------------------------------------------------------
   Contributing authors: the SPH-DISSIPATION authors
------------------------------------------------------------------------- */

#include "fix_sph_bulk_kokkos.h"

#include "atom_kokkos.h"
#include "atom_vec_sph_bulk_kokkos.h"
#include "neighbor.h"
#include "sph_dissipation_fluid_kokkos.h"
#include "sph_dissipation_integrate.h"
#include "sph_dissipation_masks.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// Arrays on the device as functions, see TimeStep

namespace {
template <class DeviceType> struct ParticlesKokkos {
  typedef Kokkos::View<double *, Kokkos::LayoutRight, DeviceType> t_field;
  typedef Kokkos::View<double *[3], Kokkos::LayoutRight, DeviceType> t_field_3;
  typedef ArrayTypes<DeviceType> AT;

  typename AT::t_kkfloat_1d_3_lr x;
  typename AT::t_kkfloat_1d_3 v, omega;
  typename AT::t_kkacc_1d_3 f, torque;
  typename AT::t_int_1d mask;
  typename AT::t_kkfloat_1d rmass;
  t_field esph, desph, desph_before, inertia;
  t_field_3 vest, omegaest;
  bool has_spins;

  ParticlesKokkos(AtomKokkos *atoms, const AtomVecSPHBulkKokkos &avec) :
      x(atoms->k_x.template view<DeviceType>()), v(atoms->k_v.template view<DeviceType>()),
      omega(atoms->k_omega.template view<DeviceType>()), f(atoms->k_f.template view<DeviceType>()),
      torque(atoms->k_torque.template view<DeviceType>()),
      mask(atoms->k_mask.template view<DeviceType>()),
      rmass(atoms->k_rmass.template view<DeviceType>()),
      esph(avec.k_esph.template view<DeviceType>()),
      desph(avec.k_desph.template view<DeviceType>()),
      desph_before(avec.k_desph_before.template view<DeviceType>()),
      inertia(avec.k_inertia.template view<DeviceType>()),
      vest(avec.k_vest.template view<DeviceType>()),
      omegaest(avec.k_omegaest.template view<DeviceType>()), has_spins(avec.has_spins)
  {
  }
};
}    // namespace

// The atom style leaves out the bits of fields that it does not have.

static constexpr uint64_t SPINS = OMEGA_MASK | TORQUE_MASK | INERTIA_MASK | OMEGAEST_MASK;
static constexpr uint64_t READ = X_MASK | V_MASK | F_MASK | MASK_MASK | RMASS_MASK | ESPH_MASK |
    DESPH_MASK | DESPH_BEFORE_MASK | VEST_MASK | SPINS;
static constexpr uint64_t MODIFIED[] = {    // at the beginning and at the end of a step
    X_MASK | V_MASK | ESPH_MASK | DESPH_BEFORE_MASK | VEST_MASK | OMEGA_MASK | OMEGAEST_MASK,
    V_MASK | ESPH_MASK | DESPH_BEFORE_MASK | OMEGA_MASK};
static constexpr uint64_t MOTION = V_MASK | OMEGA_MASK;
static constexpr uint64_t EXTRAPOLATION = VEST_MASK | OMEGAEST_MASK;
static constexpr uint64_t ENERGY = ESPH_MASK | DESPH_BEFORE_MASK | STATES_MASK;
static constexpr uint64_t TRACED =
    X_MASK | MASK_MASK | TYPE_MASK | RMASS_MASK | MOTION | SPH_RHO_MASK | ENERGY | TRACE_MASK;
static constexpr uint64_t DIFFUSION = CONTINUITY_MASK | STATES_MASK;    // of volume

/* ---------------------------------------------------------------------- */

template <class DeviceType>
FixSPHBulkKokkos<DeviceType>::FixSPHBulkKokkos(LAMMPS *lmp, int narg, char **arg) :
    FixSPHBulk(lmp, narg, arg)
{
  kokkosable = 1;
  atomKK = (AtomKokkos *) atom;
  execution_space = ExecutionSpaceFromDevice<DeviceType>::space;
  datamask_read = EMPTY_MASK;    // each function syncs the fields that it reads
  datamask_modify = EMPTY_MASK;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHBulkKokkos<DeviceType>::setup_pre_exchange()
{
  atomKK->sync(Host, TRACED | EXTRAPOLATION | OFFSET_MASK);
  FixSPHBulk::setup_pre_exchange();
  atomKK->modified(Host, EXTRAPOLATION | ENERGY | OFFSET_MASK);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHBulkKokkos<DeviceType>::post_run()
{
  atomKK->sync(Host, TRACED);
  FixSPHBulk::post_run();
  atomKK->modified(Host, TRACE_MASK);
}

template <class DeviceType> void FixSPHBulkKokkos<DeviceType>::write_restart(FILE *fp)
{
  atomKK->sync(Host, TRACED);
  FixSPHBulk::write_restart(fp);
  atomKK->modified(Host, TRACE_MASK);
}

/* ----------------------------------------------------------------------
   Set masses and temperatures; the pair style syncs masses and densities itself.
------------------------------------------------------------------------- */

template <class DeviceType> void FixSPHBulkKokkos<DeviceType>::setup_pre_force(int vflag)
{
  const bool new_energies = sets_temperatures(), on_host = this->on_host() || exact;
  atomKK->sync(Host, (on_host || new_energies) ? ALL_MASK : MOTION | EXTRAPOLATION);
  FixSPHBulk::setup_pre_force(vflag);
  if (new_energies) atomKK->modified(Host, ENERGY);
  if (on_host) atomKK->modified(Host, VEST_MASK | INERTIA_MASK);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHBulkKokkos<DeviceType>::setup(int vflag)
{
  atomKK->sync(Host, TYPE_MASK | MASK_MASK | VFRAC_MASK | INERTIA_MASK | ENERGY | OFFSET_MASK);
  atomKK->modified(Host, INERTIA_MASK | ESPH_MASK | OFFSET_MASK);
  FixSPHBulk::setup(vflag);    // its reports synchronize the particles
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHBulkKokkos<DeviceType>::initial_integrate(int vflag)
{
  check_set_up();
  if (!on_host()) {
    begin_step();
    return integrate_on_device(BEGIN);
  }
  atomKK->sync(Host, ALL_MASK);
  FixSPHBulk::initial_integrate(vflag);
  atomKK->modified(Host, modified_mask(BEGIN));
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHBulkKokkos<DeviceType>::final_integrate()
{
  if (!on_host()) {
    end_step();
    return integrate_on_device(END);
  }
  atomKK->sync(Host, ALL_MASK);
  FixSPHBulk::final_integrate();
  atomKK->modified(Host, modified_mask(END));
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> uint64_t FixSPHBulkKokkos<DeviceType>::modified_mask(Half half) const
{
  return MODIFIED[half] | (diffuses && half == BEGIN ? DIFFUSION : EMPTY_MASK);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHBulkKokkos<DeviceType>::integrate_on_device(Half half)
{
  const auto space = execution_space;
  const bool changes_volume = diffuses && half == BEGIN;
  atomKK->sync(space, changes_volume ? READ | DIFFUSION : READ);
  const ParticlesKokkos<DeviceType> particles(atomKK, AtomVecSPHBulkKokkos::of(atom));
  const TimeStep step = time_step();
  const VolumeStep volume = changes_volume ? volume_step_on_device() : VolumeStep();
  const bool is_exact = exact;
  const OwnForces own = is_exact ? fluid->forces_for_steps() : OwnForces();
  const int bit = groupbit;

  for_each<DeviceType>(
      "sph:integrate", nlocal_group(), KOKKOS_LAMBDA(int i) {
        if (!(particles.mask(i) & bit)) return;
        if (is_exact)
          own.step(step, particles, i, half == BEGIN, true);
        else if (half == BEGIN)
          step.begin(particles, i);
        else
          step.end(particles, i);
        if (changes_volume) volume.begin(i);
      });
  atomKK->modified(space, modified_mask(half));
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> VolumeStep FixSPHBulkKokkos<DeviceType>::volume_step_on_device() const
{
  const auto &avec = AtomVecSPHBulkKokkos::of(atom);
  VolumeStep volume = volume_step();
  volume.rho = avec.k_rho.template view<DeviceType>().data();
  volume.rmass = atomKK->k_rmass.template view<DeviceType>().data();
  volume.rate = avec.k_vol_rate.template view<DeviceType>().data();
  volume.rate_before = avec.k_vol_rate_before.template view<DeviceType>().data();
  for (int slot : avec.slots)
    if (state_info(slot).kind == StateKind::STRAIN)
      volume.strain[volume.nstrains++] = avec.k_state[slot].template view<DeviceType>().data();
  return volume;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> bool FixSPHBulkKokkos<DeviceType>::on_host() const
{
  return remap_v_flag || (exact && !fluid->computes_on_device());
}

/* ----------------------------------------------------------------------
   Shift the particles, and do the work of reset_extrapolation() of the CPU style.
------------------------------------------------------------------------- */

template <class DeviceType> void FixSPHBulkKokkos<DeviceType>::post_integrate()
{
  shift_particles();
  if (!first_instance || (integrated_groups & 1)) return;
  const auto space = execution_space;
  atomKK->sync(space, MOTION | EXTRAPOLATION | MASK_MASK);
  const ParticlesKokkos<DeviceType> particles(atomKK, AtomVecSPHBulkKokkos::of(atom));
  const TimeStep step = time_step();
  const int except = bits_not_followed();

  for_each<DeviceType>(
      "sph:follow", atom->nlocal, KOKKOS_LAMBDA(int i) {
        if (!(particles.mask(i) & except)) step.follow(particles, i);
      });
  atomKK->modified(space, EXTRAPOLATION);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHBulkKokkos<DeviceType>::pre_force(int vflag)
{
  if (!remap_v_flag && !anybody_without_inertia()) return;
  atomKK->sync(Host, V_MASK | VEST_MASK | MASK_MASK | TYPE_MASK | RMASS_MASK | INERTIA_MASK);
  FixSPHBulk::pre_force(vflag);
  atomKK->modified(Host, VEST_MASK | INERTIA_MASK);
}

/* ----------------------------------------------------------------------
   Return whether any particle needs inertia and has none; check with a new neighbor list.
------------------------------------------------------------------------- */

template <class DeviceType> bool FixSPHBulkKokkos<DeviceType>::anybody_without_inertia() const
{
  if (!needs_inertia() || neighbor->ago != 0) return false;

  atomKK->sync(execution_space, MASK_MASK | INERTIA_MASK);
  const ParticlesKokkos<DeviceType> particles(atomKK, AtomVecSPHBulkKokkos::of(atom));
  const int bit = groupbit;
  int count = 0, all;
  Kokkos::parallel_reduce(
      "sph:inertia", Kokkos::RangePolicy<DeviceType>(0, atom->nlocal),
      KOKKOS_LAMBDA(int i, int &sum) {
        if ((particles.mask(i) & bit) && !(particles.inertia(i) > 0.0)) sum++;
      },
      count);
  MPI_Allreduce(&count, &all, 1, MPI_INT, MPI_MAX, world);
  return all;
}

/* ---------------------------------------------------------------------- */

namespace LAMMPS_NS {
template class FixSPHBulkKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class FixSPHBulkKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
