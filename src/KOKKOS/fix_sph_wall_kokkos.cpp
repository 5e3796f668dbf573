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

#include "fix_sph_wall_kokkos.h"

#include "atom_kokkos.h"
#include "atom_vec_sph_bulk_kokkos.h"
#include "domain_kokkos.h"
#include "memory_kokkos.h"
#include "neighbor.h"
#include "sph_dissipation_bodies.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_columns_kokkos.h"
#include "sph_dissipation_masks.h"
#include "sph_dissipation_wall_motion.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

static constexpr int NVALUES = 6;    // force and torque

// Fields that the motion of a wall changes; the atom style ignores bits of fields that it does not have.

static constexpr uint64_t MOTION = V_MASK | VEST_MASK | OMEGA_MASK;
static constexpr uint64_t ENERGY = ESPH_MASK | DESPH_BEFORE_MASK;

// Computes the vector from the point on the axis of a wall to its particles, as FixSPHWall::from_point()

namespace {
template <class DeviceType> struct FromPoint {
  typename ArrayTypes<DeviceType>::t_kkfloat_1d_3_lr x;
  typename ArrayTypes<DeviceType>::t_imageint_1d image;
  Few<double, 3> prd;
  Few<double, 6> h;
  int triclinic;

  FromPoint(AtomKokkos *atom, Domain *domain) :
      x(atom->k_x.template view<DeviceType>()), image(atom->k_image.template view<DeviceType>()),
      prd(domain->prd), h(domain->h), triclinic(domain->triclinic)
  {
  }
  KOKKOS_INLINE_FUNCTION void operator()(int i, const double *point, double *r) const
  {
    Few<double, 3> folded;
    for (int d = 0; d < 3; d++) folded[d] = x(i, d);
    const auto place = DomainKokkos::unmap(prd, h, triclinic, folded, image(i));
    for (int d = 0; d < 3; d++) r[d] = place[d] - point[d];
  }
};
}    // namespace

/* ---------------------------------------------------------------------- */

template <class DeviceType>
FixSPHWallKokkos<DeviceType>::FixSPHWallKokkos(LAMMPS *lmp, int narg, char **arg) :
    FixSPHWall(lmp, narg, arg), nparticles(0)
{
  kokkosable = 1;
  exchange_comm_device = sort_device = 1;
  atomKK = (AtomKokkos *) atom;
  execution_space = ExecutionSpaceFromDevice<DeviceType>::space;
  datamask_read = EMPTY_MASK;    // each function syncs the fields that it reads and modifies
  datamask_modify = EMPTY_MASK;

  memory->destroy(array_atom);
  FixSPHWallKokkos::grow_arrays(atom->nmax);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> FixSPHWallKokkos<DeviceType>::~FixSPHWallKokkos()
{
  memoryKK->destroy_kokkos(k_array, array_atom);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHWallKokkos<DeviceType>::setup_pre_exchange()
{
  atomKK->sync(Host, ALL_MASK);
  FixSPHWall::setup_pre_exchange();
  atomKK->modified(Host, bodies ? MOTION | DESPH_BEFORE_MASK : MOTION);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHWallKokkos<DeviceType>::setup(int vflag)
{
  atomKK->sync(Host, ALL_MASK);
  FixSPHWall::setup(vflag);
  if (bodies) atomKK->modified(Host, ESPH_MASK);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHWallKokkos<DeviceType>::initial_integrate(int /*vflag*/)
{
  if (bodies) {
    atomKK->sync(Host, ENERGY | DESPH_MASK | MASK_MASK);
    FixSPHWall::initial_integrate(0);
    return atomKK->modified(Host, ENERGY);
  }
  check_set_up(lmp, this, checked);
  if (motion->has_variables()) atomKK->sync(Host, ALL_MASK);    // variables may read any particles
  const WallVelocity old = motion->velocity();
  motion->advance();
  if (move) motion->move_point();
  const WallVelocity now = motion->velocity();
  const WallStep step = motion->last_step();

  atomKK->sync(execution_space, MOTION | X_MASK | IMAGE_MASK | MASK_MASK);
  auto x = atomKK->k_x.template view<DeviceType>();
  auto v = atomKK->k_v.template view<DeviceType>();
  auto mask = atomKK->k_mask.template view<DeviceType>();
  auto vest = AtomVecSPHBulkKokkos::of(atom).k_vest.template view<DeviceType>();
  const FromPoint<DeviceType> from_point(atomKK, domain);
  auto omega = atomKK->k_omega.template view<DeviceType>();
  const bool moves = move, spins = atom->omega_flag;
  const int bit = groupbit;
  for_each<DeviceType>(
      "sph:wall_move", atom->nlocal, KOKKOS_LAMBDA(int i) {
        if (!(mask(i) & bit)) return;
        double r[3], u[3], w[3];
        if (moves) {
          from_point(i, old.point, r);
          step.move(r, &x(i, 0));
        }
        from_point(i, now.point, r);
        now.at(r, u);
        now.angular(w);
        for (int d = 0; d < 3; d++) {
          vest(i, d) = v(i, d) = u[d];
          if (spins) omega(i, d) = w[d];
        }
      });
  atomKK->modified(execution_space, MOTION | (move ? X_MASK : EMPTY_MASK));
}

/* ----------------------------------------------------------------------
   The motion of bodies is taken over on the host, where the fixes for rigid bodies have moved them.
------------------------------------------------------------------------- */

template <class DeviceType> void FixSPHWallKokkos<DeviceType>::post_integrate()
{
  atomKK->sync(Host,
               X_MASK | V_MASK | VEST_MASK | IMAGE_MASK | MASK_MASK | RMASS_MASK | MOLECULE_MASK |
                   ESPH_MASK | (elastic ? F_MASK : EMPTY_MASK));
  FixSPHWall::post_integrate();
  atomKK->modified(Host, VEST_MASK | ESPH_MASK);
}

template <class DeviceType> void FixSPHWallKokkos<DeviceType>::final_integrate()
{
  atomKK->sync(Host, ENERGY | DESPH_MASK | MASK_MASK);
  FixSPHWall::final_integrate();
  atomKK->modified(Host, ENERGY);
}

template <class DeviceType> void FixSPHWallKokkos<DeviceType>::end_of_step()
{
  if (elastic) return;
  atomKK->sync(Host,
               X_MASK | V_MASK | IMAGE_MASK | MASK_MASK | RMASS_MASK | MOLECULE_MASK | ESPH_MASK);
  FixSPHWall::end_of_step();
  atomKK->modified(Host, ESPH_MASK);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHWallKokkos<DeviceType>::pre_force(int vflag)
{
  if (!heat_value->varies() && !gravity_varies()) return;
  atomKK->sync(Host, ALL_MASK);    // variables may read any particles
  FixSPHWall::pre_force(vflag);
  if (!heat_value->is_by_atom()) return;
  if ((int) heat_values.extent(0) < atom->nlocal) renew(heat_values, "sph/wall:heat", atom->nmax);
  const auto on_host = Kokkos::create_mirror_view(heat_values);
  for (int i = 0; i < atom->nlocal; i++) on_host(i) = (*heat_value)(i);
  Kokkos::deep_copy(heat_values, on_host);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
void FixSPHWallKokkos<DeviceType>::move_surface_kokkos(
    const BoundaryDataKokkos<DeviceType> &boundary, bool before)
{
  if (elastic) return;    // see FixSPHWall::move_surface()
  const WallVelocity now = motion->velocity();
  const bool turns = bodies ? before : turns_surface(before), is_body = bodies != nullptr;
  const WallStep step = motion->last_step();
  if (bodies) {
    renew(moving, "sph/wall:bodies", bodies->size());
    const auto on_host = Kokkos::create_mirror_view(moving);
    for (int k = 0; k < bodies->size(); k++) {
      const Bodies::Body &body = (*bodies)[k];
      std::copy_n(body.omega, 3, on_host(k).omega);
      std::copy_n(&body.rotation[0][0], 9, &on_host(k).rotation[0][0]);
    }
    Kokkos::deep_copy(moving, on_host);
  }
  auto mask = atomKK->k_mask.template view<DeviceType>();
  const auto walls = boundary;
  const auto all = moving;
  const int bit = groupbit, first = first_number;
  for_each<DeviceType>(
      "sph:wall_surface", walls.nall, KOKKOS_LAMBDA(int k) {
        if (!(mask(walls.particles(k)) & bit)) return;
        Surface &s = walls.surface(k);
        now.angular(s.omega);
        const BodyMotion *const body = is_body ? &all(walls.body(k) - first) : nullptr;
        for (int d = 0; body && d < 3; d++) s.omega[d] = body->omega[d];
        if (!turns) return;
        double turned[3];
        for (int d = 0; d < 3; d++)
          turned[d] = inner_product(body ? body->rotation[d] : step.rotation[d], s.normal);
        for (int d = 0; d < 3; d++) s.normal[d] = turned[d];
      });
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
void FixSPHWallKokkos<DeviceType>::set_boundary_kokkos(
    const BoundaryDataKokkos<DeviceType> &boundary, const LoopDataKokkos<DeviceType> &data)
{
  const WallVelocity now = motion->velocity();
  const WallCondition wall = *condition;
  const FromPoint<DeviceType> from_point(atomKK, domain);
  const ParticleRows rows = data;
  const auto walls = boundary;
  auto *const spin = data.spin;
  const int bit = groupbit;
  const WallHeat kind = heat;
  const bool with_heat = data.par.conducts(), by_atom = heat_value->is_by_atom();
  const double value = heat_value->now();
  const bool noisy = noise, is_body = bodies != nullptr;
  auto values = heat_values;

  atomKK->sync(execution_space, IMAGE_MASK);
  for_each<DeviceType>(
      "sph:wall_set", walls.nowned, KOKKOS_LAMBDA(int k) {
        const int i = walls.particles(k);
        const BoundarySum &sum = walls.sum(k);
        if (!(rows.mask[i] & bit)) return;
        if (is_body)
          set_frozen(rows, i, walls.of_body(k), (walls.summed & bit) ? &sum : nullptr,
                     wall.gravity);
        double *const w = spin ? spin[i].w : nullptr;
        if (w) now.angular(w);
        if (!is_body && sum.weight > 0.0) {
          double r[3], acceleration[3];
          from_point(i, now.point, r);
          now.acceleration_at(r, acceleration);
          if (noisy)
            rest_at_surface(rows, i, wall, walls.surface(k), acceleration);
          else
            extend_fluid(rows, i, wall, walls.surface(k), sum, acceleration, w);
        }
        if (with_heat && walls.heat_sum(k).weight > 0.0)
          rows.flow[HEAT_FLOW][i] = wall_conductor(
              kind, by_atom ? values(i) : value, rows.particle[i].vol,
              rows.types[rows.type[i]].flow[HEAT_FLOW], walls.surface(k), walls.heat_sum(k));
      });
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHWallKokkos<DeviceType>::find_particles()
{
  auto mask = atomKK->k_mask.template view<DeviceType>();
  const int bit = groupbit;
  reach(particles, "sph/wall:particles", atom->nmax);
  auto list = particles;
  Kokkos::parallel_scan(
      "sph:wall_find", Kokkos::RangePolicy<DeviceType>(0, atom->nlocal),
      KOKKOS_LAMBDA(int i, int &k, bool last) {
        if (!(mask(i) & bit)) return;
        if (last) list(k) = i;
        k++;
      },
      nparticles);
  if constexpr (ON_HOST) return;
  renew(packed, "sph/wall:packed", nparticles);
  renew(values, "sph/wall:values", nparticles);
  numbers = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), particles);
}

/* ----------------------------------------------------------------------
   Sum up the forces on the wall.  The host gets array_atom in every step, since any command may read it; on a GPU only the
   values of the wall are copied.
------------------------------------------------------------------------- */

template <class DeviceType> void FixSPHWallKokkos<DeviceType>::post_force(int /*vflag*/)
{
  const bool has_torque = atom->torque_flag;
  atomKK->sync(execution_space, X_MASK | F_MASK | IMAGE_MASK | MASK_MASK | TORQUE_MASK);
  auto array = k_array.template view<DeviceType>();
  if (neighbor->ago == 0) {
    find_particles();
    k_array.clear_sync_state();
    Kokkos::deep_copy(k_array.view_device(), 0.0);
    Kokkos::deep_copy(k_array.view_host(), 0.0);
  }
  k_array.template sync<DeviceType>();

  const WallVelocity now = motion->velocity();
  const FromPoint<DeviceType> from_point(atomKK, domain);
  auto f = atomKK->k_f.template view<DeviceType>();
  auto torque = atomKK->k_torque.template view<DeviceType>();
  auto list = particles;
  EV_FLOAT sums;    // force and torque in v
  Kokkos::parallel_reduce(
      "sph:wall_force", Kokkos::RangePolicy<DeviceType>(0, nparticles),
      KOKKOS_LAMBDA(int k, EV_FLOAT &all) {
        const int i = list(k);
        double r[3], force[3], moment[3];
        from_point(i, now.point, r);
        for (int d = 0; d < 3; d++) force[d] = f(i, d);
        cross_product(r, force, moment);
        for (int d = 0; d < 3; d++) {
          const double couple = has_torque ? torque(i, d) : 0.0;
          array(i, d) = force[d];
          array(i, 3 + d) = couple;
          all.v[d] += force[d];
          all.v[3 + d] += moment[d] + couple;
        }
      },
      sums);
  std::copy_n(sums.v, NVALUES, total);
  total_summed = false;
  if (!bodies) add_contact();
  book_heat();
  if constexpr (ON_HOST) return k_array.template modify<DeviceType>();

  auto on_device = packed;
  for_each<DeviceType>(
      "sph:wall_pack", nparticles, KOKKOS_LAMBDA(int k) {
        for (int c = 0; c < NVALUES; c++) on_device(k, c) = array(list(k), c);
      });
  Kokkos::deep_copy(values, packed);
  for (int k = 0; k < nparticles; k++) std::copy_n(&values(k, 0), NVALUES, array_atom[numbers(k)]);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHWallKokkos<DeviceType>::min_post_force(int vflag)
{
  atomKK->sync(Host, F_MASK | MASK_MASK);
  FixSPHWall::min_post_force(vflag);
  atomKK->modified(Host, F_MASK);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FixSPHWallKokkos<DeviceType>::post_run()
{
  atomKK->sync(Host, ALL_MASK);
  FixSPHWall::post_run();
}

/* ----------------------------------------------------------------------
   Grow, set, and copy array_atom, on the host and the device.
------------------------------------------------------------------------- */

template <class DeviceType> void FixSPHWallKokkos<DeviceType>::grow_arrays(int nmax)
{
  k_array.sync_device();
  memoryKK->grow_kokkos(k_array, array_atom, nmax, "sph/wall:array_atom");
  k_array.modify_device();
  k_array.sync_host();
}

template <class DeviceType> void FixSPHWallKokkos<DeviceType>::set_arrays(int i)
{
  k_array.sync_host();
  FixSPHWall::set_arrays(i);
  k_array.modify_host();
}

template <class DeviceType>
void FixSPHWallKokkos<DeviceType>::copy_arrays(int i, int j, int delflag)
{
  k_array.sync_host();
  FixSPHWall::copy_arrays(i, j, delflag);
  k_array.modify_host();
}

template <class DeviceType> int FixSPHWallKokkos<DeviceType>::pack_exchange(int i, double *buf)
{
  k_array.sync_host();
  return FixSPHWall::pack_exchange(i, buf);
}

template <class DeviceType> int FixSPHWallKokkos<DeviceType>::unpack_exchange(int i, double *buf)
{
  k_array.sync_host();
  const int n = FixSPHWall::unpack_exchange(i, buf);
  k_array.modify_host();
  return n;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
void FixSPHWallKokkos<DeviceType>::sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &sorter)
{
  k_array.sync_device();
  sorter.sort(LMPDeviceType(), k_array.view_device());
  k_array.modify_device();
  k_array.sync_host();
}

/* ----------------------------------------------------------------------
   Pack particles that leave, move others to their places, and unpack particles that arrive, in the space of LAMMPS's
   communication.
------------------------------------------------------------------------- */

template <class Space, class Array> static ColumnsKokkos columns_of(Array &array)
{
  ColumnsKokkos columns;
  array.template sync<Space>();
  columns.add(array.template view<Space>());
  return columns;
}

template <class DeviceType>
int FixSPHWallKokkos<DeviceType>::pack_exchange_kokkos(const int &nsend,
                                                       DAT::tdual_double_2d_lr &buf,
                                                       DAT::tdual_int_1d list,
                                                       DAT::tdual_int_1d replacement,
                                                       ExecutionSpace space)
{
  on(space, [&](auto where) {
    typedef decltype(where) Space;
    buf.template sync<Space>();
    list.template sync<Space>();
    replacement.template sync<Space>();
    pack_leaving_columns<Space>(columns_of<Space>(k_array),
                                {buf.template view<Space>().data(), NVALUES}, nsend,
                                list.template view<Space>(), replacement.template view<Space>());
    buf.template modify<Space>();
    k_array.template modify<Space>();
  });
  k_array.sync_host();
  return nsend * NVALUES;
}

template <class DeviceType>
void FixSPHWallKokkos<DeviceType>::unpack_exchange_kokkos(DAT::tdual_double_2d_lr &buf,
                                                          DAT::tdual_int_1d &place, int nrecv,
                                                          int /*nrecv1*/, int /*nextrarecv1*/,
                                                          ExecutionSpace space)
{
  on(space, [&](auto where) {
    typedef decltype(where) Space;
    unpack_columns<Space>(columns_of<Space>(k_array), {buf.template view<Space>().data(), NVALUES},
                          nrecv, place.template view<Space>());
    k_array.template modify<Space>();
  });
  k_array.sync_host();
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> double FixSPHWallKokkos<DeviceType>::memory_usage()
{
  return FixSPHWall::memory_usage() +
      bytes_of(particles, numbers, packed, values, heat_values, moving);
}

/* ---------------------------------------------------------------------- */

namespace LAMMPS_NS {
template class FixSPHWallKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class FixSPHWallKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
