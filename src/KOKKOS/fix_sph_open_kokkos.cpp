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

#include "fix_sph_open_kokkos.h"

#include "atom_kokkos.h"
#include "atom_vec_sph_bulk_kokkos.h"
#include "kokkos.h"
#include "sph_dissipation_columns_kokkos.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_masks.h"

#include <type_traits>
#include <utility>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

static constexpr uint64_t ENERGY = ESPH_MASK | DESPH_BEFORE_MASK;
static constexpr uint64_t IDENTITY = TAG_MASK | TYPE_MASK | MASK_MASK | IMAGE_MASK | RMASS_MASK;
static constexpr uint64_t MOTION = X_MASK | V_MASK;
static constexpr uint64_t ENTERS_OR_LEAVES = MOTION | MASK_MASK | F_MASK | OMEGA_MASK |
    TORQUE_MASK | VEST_MASK | OMEGAEST_MASK | INERTIA_MASK | SPH_RHO_MASK | DRHO_MASK | DESPH_MASK |
    ENERGY | OFFSET_MASK | STATES_MASK;

/* ---------------------------------------------------------------------- */

template <class DeviceType>
FixSPHOpenKokkos<DeviceType>::FixSPHOpenKokkos(LAMMPS *lmp, int narg, char **arg) :
    FixSPHOpen(lmp, narg, arg), some(new SomeParticlesKokkos<DeviceType>())
{
  kokkosable = 1;
  atomKK = (AtomKokkos *) atom;
  execution_space = ExecutionSpaceFromDevice<DeviceType>::space;
  datamask_read = EMPTY_MASK;    // each function syncs the fields that it reads and modifies
  datamask_modify = EMPTY_MASK;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> FixSPHOpenKokkos<DeviceType>::~FixSPHOpenKokkos() = default;

/* ----------------------------------------------------------------------
   Run a task of the CPU style with all particles.  auto_sync: functions of LAMMPS that create particles sync them, as for a
   fix without suffix.
------------------------------------------------------------------------- */

template <class DeviceType>
template <class Task>
void FixSPHOpenKokkos<DeviceType>::with_all(const Task &task)
{
  atomKK->sync(Host, ALL_MASK);
  const int before = std::exchange(lmp->kokkos->auto_sync, 1);
  task();
  lmp->kokkos->auto_sync = before;
  atomKK->modified(Host, ALL_MASK);
}

/* ----------------------------------------------------------------------
   Run a task of the CPU style with these fields of the particles of the zone and near it.  The host gets the groups of all
   particles; the device gets the groups back if they are among the fields.
------------------------------------------------------------------------- */

template <class DeviceType>
template <class Task>
void FixSPHOpenKokkos<DeviceType>::with_some(uint64_t fields, const Task &task)
{
  if (!on_device) return with_all(task);
  atomKK->sync(Host, IDENTITY);
  atomKK->sync(execution_space, fields);
  const auto &avec = AtomVecSPHBulkKokkos::of(atom);
  some->set(members);
  some->there = avec.columns(fields, Device);
  some->here = avec.columns(fields, Host);
  some->get();
  task();
  some->put();
  atomKK->modified(Host, fields & MASK_MASK);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHOpenKokkos<DeviceType>::setup_pre_exchange()
{
  on_device = std::is_same_v<DeviceType, LMPDeviceType> && fluid->computes_on_device();
  with_all([this]() {
    FixSPHOpen::setup_pre_exchange();
  });
}

template <class DeviceType> void FixSPHOpenKokkos<DeviceType>::pre_neighbor()
{
  atomKK->sync(Host, X_MASK | MASK_MASK);
  FixSPHOpen::pre_neighbor();
}

template <class DeviceType> void FixSPHOpenKokkos<DeviceType>::setup(int vflag)
{
  atomKK->sync(Host, ENERGY);
  FixSPHOpen::setup(vflag);
  atomKK->modified(Host, ENERGY);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHOpenKokkos<DeviceType>::initial_integrate(int vflag)
{
  with_some(MOTION, [this, vflag]() {
    FixSPHOpen::initial_integrate(vflag);
  });
}

/* ----------------------------------------------------------------------
   Variables may read any particle.
------------------------------------------------------------------------- */

template <class DeviceType> void FixSPHOpenKokkos<DeviceType>::post_integrate()
{
  const auto task = [this]() {
    FixSPHOpen::post_integrate();
  };
  if (zone_varies() || has_lost_members())
    with_all(task);
  else
    with_some(ENTERS_OR_LEAVES, task);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHOpenKokkos<DeviceType>::pre_exchange()
{
  with_all([this]() {
    FixSPHOpen::pre_exchange();
  });
}

template <class DeviceType> void FixSPHOpenKokkos<DeviceType>::final_integrate()
{
  with_some(ENERGY, [this]() {
    FixSPHOpen::final_integrate();
  });
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> double FixSPHOpenKokkos<DeviceType>::memory_usage()
{
  return FixSPHOpen::memory_usage() + some->memory_usage();
}

/* ---------------------------------------------------------------------- */

namespace LAMMPS_NS {
template class FixSPHOpenKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class FixSPHOpenKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
