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

#include "fix_sph_bulk_kokkos.h"

#include "atom_kokkos.h"
#include "fix_sph_micropolar.h"
#include "neighbor.h"
#include "sph_dissipation_fluid_kokkos.h"
#include "sph_dissipation_masks_kokkos.h"
#include "sph_dissipation_particles_kokkos.h"
#include "sph_dissipation_shift_terms.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// The atom style leaves out the bits of fields that it does not have.

static constexpr uint64_t SPINS = OMEGA_MASK | TORQUE_MASK | INERTIA_MASK | OMEGAEST_MASK;
static constexpr uint64_t READ = X_MASK | V_MASK | F_MASK | MASK_MASK | RMASS_MASK | ESPH_MASK |
    DESPH_MASK | DESPH_BEFORE_MASK | VEST_MASK | SPINS;
static constexpr uint64_t MODIFIED[] = {    // at the beginning and at the end of a step
    X_MASK | V_MASK | ESPH_MASK | DESPH_BEFORE_MASK | VEST_MASK | OMEGA_MASK | OMEGAEST_MASK,
    V_MASK | ESPH_MASK | DESPH_BEFORE_MASK | OMEGA_MASK};
static constexpr uint64_t MOTION = V_MASK | OMEGA_MASK;
static constexpr uint64_t EXTRAPOLATION = VEST_MASK | OMEGAEST_MASK;
static constexpr uint64_t IDENTITY = X_MASK | IMAGE_MASK | MASK_MASK | TAG_MASK | TYPE_MASK;
static constexpr uint64_t ENERGY = ESPH_MASK | DESPH_BEFORE_MASK;

/* ---------------------------------------------------------------------- */

template <class DeviceType, class Base>
FixSPHKokkos<DeviceType, Base>::FixSPHKokkos(LAMMPS *lmp, int narg, char **arg) :
    Base(lmp, narg, arg)
{
  this->kokkosable = 1;
  this->atomKK = (AtomKokkos *) this->atom;
  this->execution_space = ExecutionSpaceFromDevice<DeviceType>::space;
  this->datamask_read = EMPTY_MASK;    // each function says itself what it reads and modifies
  this->datamask_modify = EMPTY_MASK;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType, class Base> void FixSPHKokkos<DeviceType, Base>::setup_pre_exchange()
{
  this->atomKK->sync(Host, MOTION | EXTRAPOLATION | ENERGY | IDENTITY);
  Base::setup_pre_exchange();
  this->atomKK->modified(Host, EXTRAPOLATION | ENERGY);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType, class Base> void FixSPHKokkos<DeviceType, Base>::post_run()
{
  this->atomKK->sync(Host, MOTION | IDENTITY);
  Base::post_run();
}

template <class DeviceType, class Base> void FixSPHKokkos<DeviceType, Base>::write_restart(FILE *fp)
{
  this->atomKK->sync(Host, MOTION | EXTRAPOLATION | ENERGY | IDENTITY);
  Base::write_restart(fp);
}

/* ----------------------------------------------------------------------
   the pair style says itself what it does to masses and densities
------------------------------------------------------------------------- */

template <class DeviceType, class Base>
void FixSPHKokkos<DeviceType, Base>::setup_pre_force(int vflag)
{
  this->atomKK->sync(Host, on_host() ? ALL_MASK : MOTION | EXTRAPOLATION);
  Base::setup_pre_force(vflag);
  if (on_host()) this->atomKK->modified(Host, VEST_MASK | INERTIA_MASK);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType, class Base> void FixSPHKokkos<DeviceType, Base>::setup(int vflag)
{
  this->atomKK->sync(Host, TYPE_MASK | MASK_MASK | VFRAC_MASK | INERTIA_MASK | ENERGY);
  this->atomKK->modified(Host,
                         INERTIA_MASK | ESPH_MASK);    // what follows synchronizes the particles
  Base::setup(vflag);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType, class Base>
void FixSPHKokkos<DeviceType, Base>::initial_integrate(int vflag)
{
  this->check_set_up();
  if (!on_host()) return integrate(BEGIN);
  this->atomKK->sync(Host, ALL_MASK);
  Base::initial_integrate(vflag);
  this->atomKK->modified(Host, MODIFIED[BEGIN]);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType, class Base> void FixSPHKokkos<DeviceType, Base>::final_integrate()
{
  if (!on_host()) return integrate(END);
  this->atomKK->sync(Host, ALL_MASK);
  Base::final_integrate();
  this->atomKK->modified(Host, MODIFIED[END]);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType, class Base> void FixSPHKokkos<DeviceType, Base>::integrate(Half half)
{
  const auto space = this->execution_space;
  this->atomKK->sync(space, READ);
  const ParticlesKokkos<DeviceType> particles(this->atomKK);
  const TimeStep step = this->time_step();
  const int bit = this->groupbit;

  Kokkos::parallel_for(
      "sph:integrate", Kokkos::RangePolicy<DeviceType>(0, this->nlocal_group()),
      KOKKOS_LAMBDA(int i) {
        if (!(particles.mask(i) & bit)) return;
        if (half == BEGIN)
          particles.begin(step, i);
        else
          particles.end(step, i);
      });
  if (half == BEGIN && this->shift_speed > 0.0) shift_on_device();
  this->atomKK->modified(space, MODIFIED[half]);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType, class Base> bool FixSPHKokkos<DeviceType, Base>::on_host() const
{
  if (this->remap_v_flag || this->exact) return true;
  if (this->shift_speed == 0.0) return false;
  const auto *const fluidKK = dynamic_cast<FluidKokkos<DeviceType> *>(this->fluid);
  return !fluidKK || !fluidKK->computes_on_device();
}

/* ---------------------------------------------------------------------- */

template <class DeviceType, class Base> void FixSPHKokkos<DeviceType, Base>::shift_on_device()
{
  auto crowding = dynamic_cast<FluidKokkos<DeviceType> *>(this->fluid)->crowding_on_device();
  auto x = this->atomKK->k_x.template view<DeviceType>();
  auto mask = this->atomKK->k_mask.template view<DeviceType>();
  const double speed = this->shift_speed, support = this->fluid->support_radius(), dt = this->dtv;
  const int bit = this->groupbit;
  Kokkos::parallel_for(
      "sph:shift", Kokkos::RangePolicy<DeviceType>(0, this->nlocal_group()), KOKKOS_LAMBDA(int i) {
        if (mask(i) & bit) shift_particle(speed, support, dt, &crowding(i, 0), &x(i, 0));
      });
}

/* ----------------------------------------------------------------------
   as reset_extrapolation() of the CPU style
------------------------------------------------------------------------- */

template <class DeviceType, class Base> void FixSPHKokkos<DeviceType, Base>::post_integrate()
{
  if (!this->first_instance || (this->integrated_groups & 1)) return;
  const auto space = this->execution_space;
  this->atomKK->sync(space, MOTION | EXTRAPOLATION | MASK_MASK);
  const ParticlesKokkos<DeviceType> particles(this->atomKK);
  const TimeStep step = this->time_step();
  const int except = this->integrated_groups;

  Kokkos::parallel_for(
      "sph:follow", Kokkos::RangePolicy<DeviceType>(0, this->atom->nlocal), KOKKOS_LAMBDA(int i) {
        if (!(particles.mask(i) & except)) particles.follow(step, i);
      });
  this->atomKK->modified(space, EXTRAPOLATION);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType, class Base> void FixSPHKokkos<DeviceType, Base>::pre_force(int vflag)
{
  if (!this->remap_v_flag && !anybody_without_inertia()) return;
  this->atomKK->sync(Host, V_MASK | VEST_MASK | MASK_MASK | TYPE_MASK | RMASS_MASK | INERTIA_MASK);
  Base::pre_force(vflag);
  this->atomKK->modified(Host, VEST_MASK | INERTIA_MASK);
}

/* ----------------------------------------------------------------------
   among the particles of a new neighbor list, where they need inertia
------------------------------------------------------------------------- */

template <class DeviceType, class Base>
bool FixSPHKokkos<DeviceType, Base>::anybody_without_inertia() const
{
  bool asked = false;
  if constexpr (std::is_base_of_v<FixSPHMicropolar, Base>) asked = this->needs_inertia();
  if (!asked || this->neighbor->ago != 0) return false;

  this->atomKK->sync(this->execution_space, MASK_MASK | INERTIA_MASK);
  const ParticlesKokkos<DeviceType> particles(this->atomKK);
  const int bit = this->groupbit;
  int count = 0, all;
  Kokkos::parallel_reduce(
      "sph:inertia", Kokkos::RangePolicy<DeviceType>(0, this->atom->nlocal),
      KOKKOS_LAMBDA(int i, int &sum) {
        if ((particles.mask(i) & bit) && !(particles.inertia(i) > 0.0)) sum++;
      },
      count);
  MPI_Allreduce(&count, &all, 1, MPI_INT, MPI_MAX, this->world);
  return all;
}

/* ---------------------------------------------------------------------- */

namespace LAMMPS_NS {
template class FixSPHKokkos<LMPDeviceType, FixSPHBulk>;
template class FixSPHKokkos<LMPDeviceType, FixSPHMicropolar>;
#ifdef LMP_KOKKOS_GPU
template class FixSPHKokkos<LMPHostType, FixSPHBulk>;
template class FixSPHKokkos<LMPHostType, FixSPHMicropolar>;
#endif
}    // namespace LAMMPS_NS
