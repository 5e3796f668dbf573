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

#include "atom_vec_sph_bulk_kokkos.h"

#include "atom_kokkos.h"
#include "error.h"
#include "fix.h"
#include "kokkos.h"
#include "memory_kokkos.h"
#include "modify.h"
#include "sph_dissipation_masks_kokkos.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

AtomVecSPHBulkKokkos::AtomVecSPHBulkKokkos(LAMMPS *lmp) :
    AtomVec(lmp), AtomVecKokkos(lmp), AtomVecSPHBulk(lmp, IN_VIEWS)
{
  bonus_flag = 1;        // for the functions of that name
  forceclearflag = 0;    // the pair style sets desph
  fields_reverse = {};
  datamask_bonus = VEST_MASK | ESPH_MASK | DESPH_BEFORE_MASK;
  setup_fields();
}

/* ---------------------------------------------------------------------- */

AtomVecSPHBulkKokkos::~AtomVecSPHBulkKokkos()
{
  memoryKK->destroy_kokkos(k_rho, owner->rho);
  memoryKK->destroy_kokkos(k_drho, owner->drho);
  memoryKK->destroy_kokkos(k_vfrac, owner->vfrac);
  memoryKK->destroy_kokkos(k_esph, owner->esph);
  memoryKK->destroy_kokkos(k_desph, owner->desph);
  memoryKK->destroy_kokkos(k_desph_before, desph_before);
  memoryKK->destroy_kokkos(k_vest, owner->vest);
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::init()
{
  AtomVecSPHBulk::init();
  set_atom_masks();
}

/* ----------------------------------------------------------------------
   n = 0 grows arrays by a chunk, n > 0 allocates arrays to size n
------------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::grow(int n)
{
  if (n == 0)
    nmax += MAX(LMP_KOKKOS_AV_DELTA, static_cast<int>(nmax * 0.01));
  else
    nmax = n;
  atom->nmax = nmax;
  if (nmax < 0 || nmax > MAXSMALLINT) error->one(FLERR, "Per-processor system is too big");

  atomKK->sync(Device, ALL_MASK);
  atomKK->modified(Device, ALL_MASK);

  memoryKK->grow_kokkos(atomKK->k_tag, atomKK->tag, nmax, "atom:tag");
  memoryKK->grow_kokkos(atomKK->k_type, atomKK->type, nmax, "atom:type");
  memoryKK->grow_kokkos(atomKK->k_mask, atomKK->mask, nmax, "atom:mask");
  memoryKK->grow_kokkos(atomKK->k_image, atomKK->image, nmax, "atom:image");
  memoryKK->grow_kokkos(atomKK->k_x, atomKK->x, nmax, "atom:x");
  memoryKK->grow_kokkos(atomKK->k_v, atomKK->v, nmax, "atom:v");
  memoryKK->grow_kokkos(atomKK->k_f, atomKK->f, nmax, "atom:f");
  memoryKK->grow_kokkos(atomKK->k_rmass, atomKK->rmass, nmax, "atom:rmass");
  memoryKK->grow_kokkos(k_rho, atomKK->rho, nmax, "atom:rho");
  memoryKK->grow_kokkos(k_drho, atomKK->drho, nmax, "atom:drho");
  memoryKK->grow_kokkos(k_vfrac, atomKK->vfrac, nmax, "atom:vfrac");
  memoryKK->grow_kokkos(k_esph, atomKK->esph, nmax, "atom:esph");
  memoryKK->grow_kokkos(k_desph, atomKK->desph, nmax, "atom:desph");
  memoryKK->grow_kokkos(k_desph_before, desph_before, nmax, "atom:desph_before");
  memoryKK->grow_kokkos(k_vest, atomKK->vest, nmax, "atom:vest");

  for (int k = 0; k < atom->nextra_grow; k++) modify->fix[atom->extra_grow[k]]->grow_arrays(nmax);

  grow_pointers();
  atomKK->sync(Host, ALL_MASK);
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::grow_pointers()
{
  AtomVecSPHBulk::grow_pointers();

  tag = atomKK->tag;
  type = atomKK->type;
  mask = atomKK->mask;
  image = atomKK->image;
  x = atomKK->x;
  v = atomKK->v;
  f = atomKK->f;
}

/* ----------------------------------------------------------------------
   function of each view whose bit is set in a mask: the views that LAMMPS transforms
   between the layouts of host and device, or the others
------------------------------------------------------------------------- */

template <class Function>
void AtomVecSPHBulkKokkos::with_atom_fields(uint64_t mask, Function &&each)
{
  if (mask & X_MASK) each(atomKK->k_x);
  if (mask & V_MASK) each(atomKK->k_v);
  if (mask & F_MASK) each(atomKK->k_f);
  if (mask & RMASS_MASK) each(atomKK->k_rmass);
}

template <class Function> void AtomVecSPHBulkKokkos::with_fields(uint64_t mask, Function &&each)
{
  if (mask & TAG_MASK) each(atomKK->k_tag);
  if (mask & TYPE_MASK) each(atomKK->k_type);
  if (mask & MASK_MASK) each(atomKK->k_mask);
  if (mask & IMAGE_MASK) each(atomKK->k_image);
  if (mask & SPH_RHO_MASK) each(k_rho);
  if (mask & DRHO_MASK) each(k_drho);
  if (mask & VFRAC_MASK) each(k_vfrac);
  if (mask & ESPH_MASK) each(k_esph);
  if (mask & DESPH_MASK) each(k_desph);
  if (mask & DESPH_BEFORE_MASK) each(k_desph_before);
  if (mask & VEST_MASK) each(k_vest);
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::sync(ExecutionSpace space, uint64_t mask)
{
  with_atom_fields(mask, [=](auto &view) {
    if (space == Device)
      view.sync_device();
    else if (space == Host)
      view.sync_host();
    else
      view.sync_hostkk();
  });
  with_fields(mask, [=](auto &view) {
    if (space == Device)
      view.sync_device();
    else
      view.sync_host();
  });
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::modified(ExecutionSpace space, uint64_t mask)
{
  with_atom_fields(mask, [=](auto &view) {
    if (space == Device)
      view.modify_device();
    else if (space == Host)
      view.modify_host();
    else
      view.modify_hostkk();
  });
  with_fields(mask, [=](auto &view) {
    if (space == Device)
      view.modify_device();
    else
      view.modify_host();
  });
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::sync_pinned(ExecutionSpace space, uint64_t mask, int async_flag)
{
  with_atom_fields(mask, [&](auto &view) {
    if (space == Device ? view.need_sync_device() : view.need_sync_host())
      perform_pinned_copy_transform(view, space, async_flag);
  });
  with_fields(mask, [&](auto &view) {
    if (space == Device ? view.need_sync_device() : view.need_sync_host())
      perform_pinned_copy(view, space, async_flag);
  });
}

/* ----------------------------------------------------------------------
   what the force computation sets anew is not sorted
------------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &sorter)
{
  const uint64_t moved = ALL_MASK & ~F_MASK;
  atomKK->sync(Device, moved);
  auto sort = [&](auto &view) {
    sorter.sort(LMPDeviceType(), view.view_device());
  };
  with_atom_fields(moved, sort);
  with_fields(moved, sort);
  atomKK->modified(Device, moved);
}

/* ----------------------------------------------------------------------
   own fields of each kind of message, in the order of the strings of the constructor, so that a
   message of the host has the same size
------------------------------------------------------------------------- */

template <class DeviceType> ColumnsKokkos AtomVecSPHBulkKokkos::columns(Occasion occasion) const
{
  ColumnsKokkos result;
  if (occasion != COMM) result.add(k_esph.template view<DeviceType>());
  result.add(k_vest.template view<DeviceType>());
  if (occasion == EXCHANGE) result.add(k_desph_before.template view<DeviceType>());
  return result;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
RowsKokkos AtomVecSPHBulkKokkos::rows(Occasion occasion, const DAT::tdual_double_2d_lr &buf,
                                      int vel_flag) const
{
  int width = (occasion == COMM) ? size_forward
      : (occasion == BORDER)     ? size_border
                                 : size_exchange;
  if (vel_flag) width += size_velocity;
  return {buf.template view<DeviceType>().data() + width - columns<DeviceType>(occasion).n, width};
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::set_size_exchange()
{
  AtomVecKokkos::set_size_exchange();
  size_exchange_bonus = columns<LMPDeviceType>(EXCHANGE).n;
  size_exchange += size_exchange_bonus;
}

/* ----------------------------------------------------------------------
   function of an object of the class that runs on the host (HostKK) or the device
------------------------------------------------------------------------- */

template <class Function> static void on(ExecutionSpace space, Function &&function)
{
  if (space == HostKK)
    function(LMPHostType());
  else
    function(LMPDeviceType());
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::pack_comm_bonus_kokkos(const int &n, const DAT::tdual_int_1d &list,
                                                  const DAT::tdual_double_2d_lr &buf, int vel_flag)
{
  const auto space = lmp->kokkos->forward_comm_on_host ? HostKK : Device;
  atomKK->sync(space, VEST_MASK);
  on(space, [&](auto where) {
    typedef decltype(where) DeviceType;
    pack_columns<DeviceType>(columns<DeviceType>(COMM), rows<DeviceType>(COMM, buf, vel_flag), n,
                             list.template view<DeviceType>());
  });
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::unpack_comm_bonus_kokkos(const int &n, const int &first,
                                                    const DAT::tdual_double_2d_lr &buf,
                                                    int vel_flag)
{
  const auto space = lmp->kokkos->forward_comm_on_host ? HostKK : Device;
  atomKK->sync(space, VEST_MASK);
  on(space, [&](auto where) {
    typedef decltype(where) DeviceType;
    unpack_columns<DeviceType>(columns<DeviceType>(COMM), rows<DeviceType>(COMM, buf, vel_flag), n,
                               first);
  });
  atomKK->modified(space, VEST_MASK);
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::pack_comm_self_bonus_kokkos(const int &n, const DAT::tdual_int_1d &list,
                                                       const int first)
{
  const auto space = lmp->kokkos->forward_comm_on_host ? HostKK : Device;
  atomKK->sync(space, VEST_MASK);
  on(space, [&](auto where) {
    typedef decltype(where) DeviceType;
    copy_columns<DeviceType>(columns<DeviceType>(COMM), n, list.template view<DeviceType>(), first);
  });
  atomKK->modified(space, VEST_MASK);
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::pack_comm_self_fused_bonus_kokkos(const int &n,
                                                             const DAT::tdual_int_2d_lr &list,
                                                             const DAT::tdual_int_1d &sendnum_scan,
                                                             const DAT::tdual_int_1d &firstrecv,
                                                             const DAT::tdual_int_1d &g2l)
{
  const auto space = lmp->kokkos->forward_comm_on_host ? HostKK : Device;
  atomKK->sync(space, VEST_MASK);
  on(space, [&](auto where) {
    typedef decltype(where) DeviceType;
    copy_columns_of_swaps<DeviceType>(
        columns<DeviceType>(COMM), n, list.template view<DeviceType>(),
        sendnum_scan.template view<DeviceType>(), firstrecv.template view<DeviceType>(),
        g2l.template view<DeviceType>());
  });
  atomKK->modified(space, VEST_MASK);
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::pack_border_bonus_kokkos(int n, DAT::tdual_int_1d list,
                                                    DAT::tdual_double_2d_lr &buf,
                                                    ExecutionSpace space, int vel_flag)
{
  atomKK->sync(space, ESPH_MASK | VEST_MASK);
  on(space, [&](auto where) {
    typedef decltype(where) DeviceType;
    pack_columns<DeviceType>(columns<DeviceType>(BORDER), rows<DeviceType>(BORDER, buf, vel_flag),
                             n, list.template view<DeviceType>());
  });
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::unpack_border_bonus_kokkos(const int &n, const int &first,
                                                      const DAT::tdual_double_2d_lr &buf,
                                                      ExecutionSpace space, int vel_flag)
{
  while (first + n >= nmax) grow(0);
  atomKK->sync(space, ESPH_MASK | VEST_MASK);
  on(space, [&](auto where) {
    typedef decltype(where) DeviceType;
    unpack_columns<DeviceType>(columns<DeviceType>(BORDER), rows<DeviceType>(BORDER, buf, vel_flag),
                               n, first);
  });
  atomKK->modified(space, ESPH_MASK | VEST_MASK);
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::pack_exchange_bonus_kokkos(const int &n, DAT::tdual_double_2d_lr &buf,
                                                      DAT::tdual_int_1d list,
                                                      DAT::tdual_int_1d replacement,
                                                      DAT::tdual_int_1d, ExecutionSpace space)
{
  atomKK->sync(space, datamask_bonus);
  on(space, [&](auto where) {
    typedef decltype(where) DeviceType;
    pack_leaving_columns<DeviceType>(
        columns<DeviceType>(EXCHANGE), rows<DeviceType>(EXCHANGE, buf, 0), n,
        list.template view<DeviceType>(), replacement.template view<DeviceType>());
  });
  atomKK->modified(space, datamask_bonus);
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::unpack_exchange_bonus_kokkos(DAT::tdual_double_2d_lr &buf, int nrecv,
                                                        ExecutionSpace space,
                                                        DAT::tdual_int_1d &place)
{
  atomKK->sync(space, datamask_bonus);
  on(space, [&](auto where) {
    typedef decltype(where) DeviceType;
    unpack_arriving_columns<DeviceType>(columns<DeviceType>(EXCHANGE),
                                        rows<DeviceType>(EXCHANGE, buf, 0), nrecv / size_exchange,
                                        place.template view<DeviceType>());
  });
  atomKK->modified(space, datamask_bonus);
}
