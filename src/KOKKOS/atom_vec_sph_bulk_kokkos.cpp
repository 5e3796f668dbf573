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

#include "atom_vec_sph_bulk_kokkos.h"

#include "atom_kokkos.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "kokkos.h"
#include "memory_kokkos.h"
#include "modify.h"
#include "pair.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_fields_kokkos.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_masks.h"

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

template <class View, class Pointer>
void AtomVecSPHBulkKokkos::add_field(uint64_t mask, View &view, Pointer &pointer, Owner owner,
                                     const std::vector<Occasion> &occasions)
{
  typedef SPHDissipation::FieldOfKokkos<View, Pointer> Field;
  fields.push_back(std::make_unique<Field>(mask, owner == OWN, view, pointer));
  for (const auto &occasion : occasions) sent[occasion].push_back(fields.back().get());
}

/* ----------------------------------------------------------------------
   Add the fields; the views are those of the present atomKK, also after replicate has made another one.
------------------------------------------------------------------------- */

AtomVecSPHBulkKokkos::AtomVecSPHBulkKokkos(LAMMPS *lmp, bool spins) :
    AtomVec(lmp), AtomVecSPHBulk(lmp, spins, true), AtomVecKokkos(lmp)
{
  AtomKokkos &atoms = *atomKK;
  add_field(TAG_MASK, atoms.k_tag, atoms.tag, ATOM);
  add_field(TYPE_MASK, atoms.k_type, atoms.type, ATOM);
  add_field(MASK_MASK, atoms.k_mask, atoms.mask, ATOM);
  add_field(IMAGE_MASK, atoms.k_image, atoms.image, ATOM);
  add_field(X_MASK, atoms.k_x, atoms.x, ATOM);
  add_field(V_MASK, atoms.k_v, atoms.v, ATOM);
  add_field(F_MASK, atoms.k_f, atoms.f, ATOM);
  add_field(RMASS_MASK, atoms.k_rmass, atoms.rmass, ATOM);
  add_field(SPH_RHO_MASK, k_rho, atoms.rho, OWN, {EXCHANGE});
  add_field(DRHO_MASK, k_drho, atoms.drho, OWN);
  add_field(VFRAC_MASK, k_vfrac, atoms.vfrac, OWN);
  add_field(ESPH_MASK, k_esph, atoms.esph, OWN, {BORDER, EXCHANGE});
  add_field(DESPH_MASK, k_desph, atoms.desph, OWN);
  add_field(VEST_MASK, k_vest, atoms.vest, OWN, {COMM, BORDER, EXCHANGE});
  add_field(DESPH_BEFORE_MASK, k_desph_before, desph_before, OWN, {EXCHANGE});
  add_field(OFFSET_MASK, k_rho_sum, rho_sum, OWN, {EXCHANGE});
  add_field(OFFSET_MASK, k_vol_rate, vol_rate, OWN, {EXCHANGE});
  add_field(OFFSET_MASK, k_vol_rate_before, vol_rate_before, OWN, {EXCHANGE});
  add_field(OFFSET_MASK, k_vol_heat, vol_heat, OWN, {EXCHANGE});
  add_field(OFFSET_MASK, k_vol_support, vol_support, OWN, {EXCHANGE});
  add_field(OFFSET_MASK, k_shear_rate, shear_rate, OWN, {EXCHANGE});
  add_field(OFFSET_MASK, k_shear_mu, shear_mu, OWN, {EXCHANGE});
  add_field(TRACE_MASK, k_trace, trace, OWN, {EXCHANGE});
  if (has_spins) {
    add_field(OMEGA_MASK, atoms.k_omega, atoms.omega, ATOM);
    add_field(TORQUE_MASK, atoms.k_torque, atoms.torque, ATOM);
    add_field(INERTIA_MASK, k_inertia, inertia, OWN, {EXCHANGE});
    add_field(OMEGAEST_MASK, k_omegaest, omegaest, OWN, {COMM, BORDER, EXCHANGE});
  }
  if (atomKK->k_dvector.extent(0))    // fix property/atom would grow it without these vectors
    error->all(FLERR, "This atom style must come before fixes property/atom with d_ names");
  bonus_flag = 1;        // LAMMPS calls the functions for bonus data
  forceclearflag = 0;    // the pair style sets desph
  fields_reverse = {};
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::process_args(int narg, char **arg)
{
  add_columns(narg, arg);
  for (int slot : slots) {
    std::vector<Occasion> occasions = {EXCHANGE};
    if (state_info(slot).ghosts) occasions = {COMM, BORDER, EXCHANGE};
    add_field(STATES_MASK, k_state[slot], state[slot], OWN, occasions);
  }
  for (const auto occasion : {COMM, BORDER, EXCHANGE}) datamask_bonus |= sent_mask(occasion);
  setup_fields();
}

/* ---------------------------------------------------------------------- */

AtomVecSPHBulkKokkos::~AtomVecSPHBulkKokkos()
{
  for (const auto &field : fields)
    if (field->own) field->destroy(memoryKK);
}

/* ---------------------------------------------------------------------- */

AtomVecSPHBulkKokkos &AtomVecSPHBulkKokkos::of(Atom *atom)
{
  return *dynamic_cast<AtomVecSPHBulkKokkos *>(atom->avec);
}

/* ----------------------------------------------------------------------
   Pack messages on the host with tiled ranks: CommTiledKokkos::forward_comm_device() of LAMMPS 4 Jul 2026 packs messages of
   a processor to itself, but unpacks them only with velocities; with velocities, messages from several processors overlap in
   the buffer, since the rows are assumed to be as long as those of borders() without velocities.
------------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::init()
{
  if (atom->avec != this)
    error->all(FLERR, Error::NOLASTLINE, "Atom style {}/kk cannot be part of atom_style hybrid",
               has_spins ? "sph/micropolar" : "sph/bulk");
  AtomVecSPHBulk::init();
  set_atom_masks();
  if (comm->style == Comm::TILED) lmp->kokkos->forward_comm_legacy = 1;

  const Fluid *const fluid = find_fluid(force);
  if (fluid && !fluid->pair->kokkosable)
    error->all(FLERR, Error::NOLASTLINE,
               "With an atom style sph/bulk/kk or sph/micropolar/kk, the pair style must be one of "
               "them, too, not {}",
               force->pair_style);
  if (!fluid || !fluid->pair->compute_flag) clear_heating();
}

/* ----------------------------------------------------------------------
   Set desph to 0 if no pair style does: class VerletKokkos does not call force_clear().
------------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::clear_heating()
{
  k_desph.clear_sync_state();
  Kokkos::deep_copy(k_desph.view_host(), 0.0);
  Kokkos::deep_copy(k_desph.view_device(), 0.0);
}

/* ----------------------------------------------------------------------
   Grow arrays by a chunk, n = 0, or to size n > 0.
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
  for (const auto &field : fields) field->grow(memoryKK, nmax);
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
   Class AtomKokkos and fix property/atom call sync() and modified() before and after they move the custom properties; those
   of this class do not move.
------------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::sync(ExecutionSpace space, uint64_t mask)
{
  if (mask & DVECTOR_MASK) {
    show_custom_vectors();
    mask |= DESPH_BEFORE_MASK | OFFSET_MASK | INERTIA_MASK | STATES_MASK;
  }
  if (mask & DARRAY_MASK) mask |= OMEGAEST_MASK | TRACE_MASK;
  for (const auto &field : fields)
    if (mask & field->mask) field->sync(space);
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::modified(ExecutionSpace space, uint64_t mask)
{
  if (mask & DVECTOR_MASK) show_custom_vectors();
  for (const auto &field : fields)
    if (mask & field->mask) field->modified(space);
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::sync_pinned(ExecutionSpace space, uint64_t mask, int async_flag)
{
  for (const auto &field : fields)
    if (mask & field->mask) field->sync_pinned(*this, space, async_flag);
}

/* ----------------------------------------------------------------------
   Sort the fields, except those that each force computation sets.
------------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &sorter)
{
  const uint64_t moved = ALL_MASK & ~(F_MASK | TORQUE_MASK);
  atomKK->sync(Device, moved);
  for (const auto &field : fields)
    if (moved & field->mask) field->sort(sorter);
  atomKK->modified(Device, moved);
}

/* ---------------------------------------------------------------------- */

uint64_t AtomVecSPHBulkKokkos::sent_mask(Occasion occasion) const
{
  uint64_t mask = EMPTY_MASK;
  for (const auto *field : sent[occasion]) mask |= field->mask;
  return mask;
}

/* ---------------------------------------------------------------------- */

ColumnsKokkos AtomVecSPHBulkKokkos::columns(Occasion occasion, ExecutionSpace space) const
{
  ColumnsKokkos result;
  for (const auto *field : sent[occasion]) field->add_to(result, space);
  return result;
}

ColumnsKokkos AtomVecSPHBulkKokkos::columns(uint64_t mask, ExecutionSpace space) const
{
  ColumnsKokkos result;
  for (const auto &field : fields)
    if (field->mask & mask) field->add_to(result, space);
  return result;
}

/* ---------------------------------------------------------------------- */

RowsKokkos AtomVecSPHBulkKokkos::rows(Occasion occasion, ExecutionSpace space,
                                      const DAT::tdual_double_2d_lr &buf, int vel_flag) const
{
  int width = (occasion == COMM) ? size_forward
      : (occasion == BORDER)     ? size_border
                                 : size_exchange;
  if (vel_flag) width += size_velocity;
  double *const first = (space == Device) ? buf.view_device().data() : buf.view_host().data();
  return {first + width - columns(occasion, space).n, width};
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::set_size_exchange()
{
  AtomVecKokkos::set_size_exchange();
  size_exchange_bonus = columns(EXCHANGE, Device).n;
  size_exchange += size_exchange_bonus;
}

/* ---------------------------------------------------------------------- */

ExecutionSpace AtomVecSPHBulkKokkos::space_of_comm() const
{
  return lmp->kokkos->forward_comm_on_host ? HostKK : Device;
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::pack(Occasion occasion, ExecutionSpace space, int n,
                                const DAT::tdual_int_1d &list, const DAT::tdual_double_2d_lr &buf,
                                int vel_flag)
{
  atomKK->sync(space, sent_mask(occasion));
  on(space, [&](auto where) {
    typedef decltype(where) DeviceType;
    pack_columns<DeviceType>(columns(occasion, space), rows(occasion, space, buf, vel_flag), n,
                             list.template view<DeviceType>());
  });
}

/* ----------------------------------------------------------------------
   Call task(columns in this message, object of the class that runs in their space), which modifies the columns.
------------------------------------------------------------------------- */

template <class Task>
void AtomVecSPHBulkKokkos::change(Occasion occasion, ExecutionSpace space, const Task &task)
{
  atomKK->sync(space, sent_mask(occasion));
  on(space, [&](auto where) {
    task(columns(occasion, space), where);
  });
  atomKK->modified(space, sent_mask(occasion));
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::unpack(Occasion occasion, ExecutionSpace space, int n, int first,
                                  const DAT::tdual_double_2d_lr &buf, int vel_flag)
{
  change(occasion, space, [&](const ColumnsKokkos &columns, auto where) {
    unpack_columns<decltype(where)>(columns, rows(occasion, space, buf, vel_flag), n,
                                    ParticlesFrom{first});
  });
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::pack_comm_bonus_kokkos(const int &n, const DAT::tdual_int_1d &list,
                                                  const DAT::tdual_double_2d_lr &buf, int vel_flag)
{
  pack(COMM, space_of_comm(), n, list, buf, vel_flag);
}

void AtomVecSPHBulkKokkos::unpack_comm_bonus_kokkos(const int &n, const int &first,
                                                    const DAT::tdual_double_2d_lr &buf,
                                                    int vel_flag)
{
  unpack(COMM, space_of_comm(), n, first, buf, vel_flag);
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::pack_comm_self_bonus_kokkos(const int &n, const DAT::tdual_int_1d &list,
                                                       const int first)
{
  change(COMM, space_of_comm(), [&](const ColumnsKokkos &columns, auto where) {
    typedef decltype(where) DeviceType;
    copy_columns<DeviceType>(columns, n, list.template view<DeviceType>(), first);
  });
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::pack_comm_self_fused_bonus_kokkos(const int &n,
                                                             const DAT::tdual_int_2d_lr &list,
                                                             const DAT::tdual_int_1d &sendnum_scan,
                                                             const DAT::tdual_int_1d &firstrecv,
                                                             const DAT::tdual_int_1d &g2l)
{
  change(COMM, space_of_comm(), [&](const ColumnsKokkos &columns, auto where) {
    typedef decltype(where) DeviceType;
    copy_columns_of_swaps<DeviceType>(
        columns, n, list.template view<DeviceType>(), sendnum_scan.template view<DeviceType>(),
        firstrecv.template view<DeviceType>(), g2l.template view<DeviceType>());
  });
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::pack_border_bonus_kokkos(int n, DAT::tdual_int_1d list,
                                                    DAT::tdual_double_2d_lr &buf,
                                                    ExecutionSpace space, int vel_flag)
{
  pack(BORDER, space, n, list, buf, vel_flag);
}

void AtomVecSPHBulkKokkos::unpack_border_bonus_kokkos(const int &n, const int &first,
                                                      const DAT::tdual_double_2d_lr &buf,
                                                      ExecutionSpace space, int vel_flag)
{
  while (first + n >= nmax) grow(0);
  unpack(BORDER, space, n, first, buf, vel_flag);
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::pack_exchange_bonus_kokkos(const int &n, DAT::tdual_double_2d_lr &buf,
                                                      DAT::tdual_int_1d list,
                                                      DAT::tdual_int_1d replacement,
                                                      DAT::tdual_int_1d, ExecutionSpace space)
{
  change(EXCHANGE, space, [&](const ColumnsKokkos &columns, auto where) {
    typedef decltype(where) DeviceType;
    pack_leaving_columns<DeviceType>(columns, rows(EXCHANGE, space, buf, 0), n,
                                     list.template view<DeviceType>(),
                                     replacement.template view<DeviceType>());
  });
}

/* ---------------------------------------------------------------------- */

void AtomVecSPHBulkKokkos::unpack_exchange_bonus_kokkos(DAT::tdual_double_2d_lr &buf, int nrecv,
                                                        ExecutionSpace space,
                                                        DAT::tdual_int_1d &place)
{
  change(EXCHANGE, space, [&](const ColumnsKokkos &columns, auto where) {
    typedef decltype(where) DeviceType;
    unpack_columns<DeviceType>(columns, rows(EXCHANGE, space, buf, 0), nrecv / size_exchange,
                               place.template view<DeviceType>());
  });
}
