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
#include "atom_vec_sph_bulk_kokkos.h"
#include "pair_sph_bulk_kokkos.h"
#include "sph_dissipation_integrate.h"
#include "sph_dissipation_masks_kokkos.h"
#include "sph_dissipation_shift_terms.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

template <class DeviceType>
FixSPHBulkKokkos<DeviceType>::FixSPHBulkKokkos(LAMMPS *lmp, int narg, char **arg) :
    FixSPHBulk(lmp, narg, arg)
{
  kokkosable = 1;
  atomKK = (AtomKokkos *) atom;
  execution_space = ExecutionSpaceFromDevice<DeviceType>::space;
  datamask_read = EMPTY_MASK;    // each function says itself what it reads and modifies
  datamask_modify = EMPTY_MASK;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> AtomVecSPHBulkKokkos *FixSPHBulkKokkos<DeviceType>::avec_kokkos() const
{
  return dynamic_cast<AtomVecSPHBulkKokkos *>(avec());
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHBulkKokkos<DeviceType>::setup_pre_exchange()
{
  atomKK->sync(Host, V_MASK | VEST_MASK | MASK_MASK);
  FixSPHBulk::setup_pre_exchange();
  atomKK->modified(Host, VEST_MASK);
}

/* ----------------------------------------------------------------------
   the pair style says itself what it does to masses and densities
------------------------------------------------------------------------- */

template <class DeviceType> void FixSPHBulkKokkos<DeviceType>::setup_pre_force(int vflag)
{
  atomKK->sync(Host, V_MASK | VEST_MASK);
  FixSPHBulk::setup_pre_force(vflag);
  if (remap_v_flag) atomKK->modified(Host, VEST_MASK);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHBulkKokkos<DeviceType>::setup(int vflag)
{
  atomKK->sync(Host, TYPE_MASK | MASK_MASK);
  FixSPHBulk::setup(vflag);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHBulkKokkos<DeviceType>::initial_integrate(int vflag)
{
  check_set_up();
  constexpr uint64_t READ = X_MASK | V_MASK | F_MASK | MASK_MASK | RMASS_MASK | ESPH_MASK |
      DESPH_MASK | DESPH_BEFORE_MASK | VEST_MASK;
  constexpr uint64_t MODIFIED = X_MASK | V_MASK | ESPH_MASK | DESPH_BEFORE_MASK | VEST_MASK;
  if (on_host()) {
    atomKK->sync(Host, ALL_MASK);
    FixSPHBulk::initial_integrate(vflag);
    return atomKK->modified(Host, MODIFIED | DESPH_MASK);
  }
  atomKK->sync(execution_space, READ);

  auto *avecKK = avec_kokkos();
  auto x = atomKK->k_x.template view<DeviceType>();
  auto v = atomKK->k_v.template view<DeviceType>();
  auto f = atomKK->k_f.template view<DeviceType>();
  auto mask = atomKK->k_mask.template view<DeviceType>();
  auto rmass = atomKK->k_rmass.template view<DeviceType>();
  auto esph = avecKK->k_esph.template view<DeviceType>();
  auto desph = avecKK->k_desph.template view<DeviceType>();
  auto desph_before = avecKK->k_desph_before.template view<DeviceType>();
  auto vest = avecKK->k_vest.template view<DeviceType>();
  const TimeStep step = time_step();
  const int bit = groupbit;

  Kokkos::parallel_for(
      "sph:integrate", Kokkos::RangePolicy<DeviceType>(0, nlocal_group()), KOKKOS_LAMBDA(int i) {
        if (!(mask(i) & bit)) return;
        const double dtfm = step.dtf / rmass(i);
        step.begin_energy(desph(i), esph(i), desph_before(i));
        for (int d = 0; d < 3; d++) step.begin(dtfm, f(i, d), x(i, d), v(i, d), vest(i, d));
      });
  if (shift_speed > 0.0) shift_on_device();
  atomKK->modified(execution_space, MODIFIED);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> bool FixSPHBulkKokkos<DeviceType>::on_host() const
{
  if (remap_v_flag || exact) return true;
  if (shift_speed == 0.0) return false;
  auto *const pairKK = dynamic_cast<PairSPHBulkKokkos<DeviceType> *>(pair);
  return !pairKK || !pairKK->computes_on_device();
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHBulkKokkos<DeviceType>::shift_on_device()
{
  auto crowding = dynamic_cast<PairSPHBulkKokkos<DeviceType> *>(pair)->crowding_on_device();
  auto x = atomKK->k_x.template view<DeviceType>();
  auto mask = atomKK->k_mask.template view<DeviceType>();
  const double speed = shift_speed, support = pair->support_radius(), dt = dtv;
  const int bit = groupbit;
  Kokkos::parallel_for(
      "sph:shift", Kokkos::RangePolicy<DeviceType>(0, nlocal_group()), KOKKOS_LAMBDA(int i) {
        if (mask(i) & bit) shift_particle(speed, support, dt, &crowding(i, 0), &x(i, 0));
      });
}

/* ----------------------------------------------------------------------
   as FixSPHBulk::reset_extrapolation()
------------------------------------------------------------------------- */

template <class DeviceType> void FixSPHBulkKokkos<DeviceType>::post_integrate()
{
  if (!first_instance || (integrated_groups & 1)) return;
  atomKK->sync(execution_space, V_MASK | VEST_MASK | MASK_MASK);

  auto v = atomKK->k_v.template view<DeviceType>();
  auto mask = atomKK->k_mask.template view<DeviceType>();
  auto vest = avec_kokkos()->k_vest.template view<DeviceType>();
  const double keep = time_step().keep;
  const int except = integrated_groups;

  Kokkos::parallel_for(
      "sph:follow", Kokkos::RangePolicy<DeviceType>(0, atom->nlocal), KOKKOS_LAMBDA(int i) {
        if (mask(i) & except) return;
        for (int d = 0; d < 3; d++) vest(i, d) = keep * v(i, d);
      });
  atomKK->modified(execution_space, VEST_MASK);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHBulkKokkos<DeviceType>::pre_force(int vflag)
{
  if (!remap_v_flag) return;
  atomKK->sync(Host, V_MASK | VEST_MASK);
  FixSPHBulk::pre_force(vflag);
  atomKK->modified(Host, VEST_MASK);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHBulkKokkos<DeviceType>::final_integrate()
{
  if (on_host()) {
    atomKK->sync(Host, ALL_MASK);
    FixSPHBulk::final_integrate();
    return atomKK->modified(Host, V_MASK | ESPH_MASK | DESPH_MASK);
  }
  atomKK->sync(execution_space,
               V_MASK | F_MASK | MASK_MASK | RMASS_MASK | ESPH_MASK | DESPH_MASK |
                   DESPH_BEFORE_MASK);

  auto *avecKK = avec_kokkos();
  auto v = atomKK->k_v.template view<DeviceType>();
  auto f = atomKK->k_f.template view<DeviceType>();
  auto mask = atomKK->k_mask.template view<DeviceType>();
  auto rmass = atomKK->k_rmass.template view<DeviceType>();
  auto esph = avecKK->k_esph.template view<DeviceType>();
  auto desph = avecKK->k_desph.template view<DeviceType>();
  auto desph_before = avecKK->k_desph_before.template view<DeviceType>();
  const TimeStep step = time_step();
  const int bit = groupbit;

  Kokkos::parallel_for(
      "sph:integrate", Kokkos::RangePolicy<DeviceType>(0, nlocal_group()), KOKKOS_LAMBDA(int i) {
        if (!(mask(i) & bit)) return;
        const double dtfm = step.dtf / rmass(i);
        step.end_energy(desph(i), desph_before(i), esph(i));
        for (int d = 0; d < 3; d++) step.end(dtfm, f(i, d), v(i, d));
      });
  atomKK->modified(execution_space, V_MASK | ESPH_MASK);
}

/* ---------------------------------------------------------------------- */

namespace LAMMPS_NS {
template class FixSPHBulkKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class FixSPHBulkKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
