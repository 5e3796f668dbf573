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

#include "sph_dissipation_space_kokkos.h"

#include "atom_kokkos.h"
#include "atom_vec_sph_bulk_kokkos.h"
#include "comm.h"
#include "kokkos.h"
#include "neigh_list_kokkos.h"
#include "pair.h"
#include "sph_dissipation_boundary_kokkos.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_sums_kokkos.h"

#include <algorithm>
#include <utility>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

template <class DeviceType>
DeviceSpace<DeviceType>::DeviceSpace(LAMMPS *lmp, Pair *pair, Engine &engine, Exchange &exchange) :
    Pointers(lmp), data(new LoopDataKokkos<DeviceType>()), pair(pair), engine(engine),
    exchange(exchange)
{
  atomKK = (AtomKokkos *) atom;
}

template <class DeviceType> DeviceSpace<DeviceType>::~DeviceSpace() = default;

/* ---------------------------------------------------------------------- */

template <class DeviceType> uint64_t DeviceSpace<DeviceType>::read_mask() const
{
  const Constants &par = engine.constants();
  return FLUID_READ | (par.thermal ? TAG_MASK : EMPTY_MASK) |
      (keeps_forces ? V_MASK | OMEGA_MASK | INERTIA_MASK : EMPTY_MASK) |
      ((par.continuity || par.by_rate) ? CONTINUITY_MASK : EMPTY_MASK);
}

template <class DeviceType> uint64_t DeviceSpace<DeviceType>::modified_mask() const
{
  const Constants &par = engine.constants();
  return FLUID_MODIFIED | (keeps_forces ? VEST_MASK | OMEGAEST_MASK : EMPTY_MASK) |
      ((par.continuity || par.by_rate) ? CONTINUITY_MASK : EMPTY_MASK);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void DeviceSpace<DeviceType>::prepare()
{
  copy_coeffs();
  grow();
  // also sync modified fields: LAMMPS communicates on the host if MPI cannot use the memory of the GPU
  atomKK->sync(pair->execution_space, read_mask() | modified_mask());
}

template <class DeviceType> void DeviceSpace<DeviceType>::begin(int not_fluid)
{
  prepare();
  set_particles(not_fluid);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void DeviceSpace<DeviceType>::grow()
{
  const int n = atom->nmax;
  data->particle = reach(particle, "sph:particle", n);
  data->density = reach(density_sum, "sph:density", n);
  data->zeta_term = reach(zeta_term, "sph:zeta_term", n);
  data->state_pressure = reach(state_pressure, "sph:state_pressure", n);
  for (int k = 0; k < Flows::NUMBER; k++) {
    const bool used = data->par.flows >> k & 1;
    data->flow[k] = used ? reach(flow[k], "sph:flow", n) : nullptr;
    if (used) reach(flow_rates[k], "sph:flow_rate", n);
  }
  data->spin = engine.has_spin() ? reach(spin, "sph:spin", n) : nullptr;
  data->viscosity = data->par.by_rate ? reach(viscosity, "sph:viscosity", n) : nullptr;
  SPHDissipation::reach(data->heat, "sph:heat", n);
  data->weight = reach(weight, "sph:weight", data->each ? n : 1);
  if (keeps_forces) SPHDissipation::reach(own_force, "sph:own_force", n);
  if (keeps_forces && engine.has_spin()) SPHDissipation::reach(own_torque, "sph:own_torque", n);
}

/* ----------------------------------------------------------------------
   Copy coefficients of types and type pairs, and the parameters of the loops; numbers of states belong to one time step.
------------------------------------------------------------------------- */

template <class DeviceType> void DeviceSpace<DeviceType>::copy_coeffs()
{
  const Parameters &par = engine.parameters();
  if (copied && data->par.step == par.step) return;
  auto copy = [](const auto &from, auto &view, const char *name) {
    renew(view, name, from.size());
    auto on_host = Kokkos::create_mirror_view(view);
    std::copy(from.begin(), from.end(), on_host.data());
    Kokkos::deep_copy(view, on_host);
    return view.data();
  };
  data->par = par;
  data->types = copy(par.type, types, "sph:types");
  data->pair = copy(par.pair, pair_coeff, "sph:coeff");
  copy(par.pair_energy, pair_energy, "sph:pair_energy");
  copy(par.cohesion, cohesion, "sph:cohesion");
  data->typed = par.uniform ? 0 : 1;
  data->each = (par.volume == Volume::MASS) ? 1 : 0;
  weight = Array<double>("sph:weight", 1);    // by mass it is set in each step
  Kokkos::deep_copy(weight, 1.0);
  copied = true;
}

/* ----------------------------------------------------------------------
   Set the arrays of owned particles that their states need.
------------------------------------------------------------------------- */

template <class DeviceType> void DeviceSpace<DeviceType>::set_states()
{
  const auto at = [](auto &view) {
    return view.template view<DeviceType>().data();
  };
  const auto &avec = AtomVecSPHBulkKokkos::of(atom);
  data->type = at(atomKK->k_type);
  data->mask = at(atomKK->k_mask);
  data->states = {data->types,     data->type,       at(atomKK->k_rmass),
                  at(avec.k_rho),  at(avec.k_drho),  data->par.eos,
                  at(avec.k_esph), at(avec.k_desph), {}};
  for (int slot : avec.slots) data->states.state[slot] = at(avec.k_state[slot]);
  for (int k = 0; k < Flows::NUMBER; k++)
    data->states.rate[k] = (flows_known && (engine.parameters().flows >> k & 1)) ? flow_rate(k)
                                                                                 : nullptr;
  data->states.shear_rate = at(avec.k_shear_rate);
}

/* ----------------------------------------------------------------------
   Set the input of pass 1, of owned and ghost atoms.
------------------------------------------------------------------------- */

template <class DeviceType> void DeviceSpace<DeviceType>::set_particles(int not_fluid)
{
  const auto &avec = AtomVecSPHBulkKokkos::of(atom);
  auto *k_list = static_cast<NeighListKokkos<DeviceType> *>(pair->list);
  data->ilist = k_list->d_ilist;
  data->numneigh = k_list->d_numneigh;
  data->neighbors = k_list->d_neighbors;
  data->nlocal = atom->nlocal;
  data->excess = nullptr;    // BoundaryStageKokkos::set_excess() sets it
  set_states();
  data->rmass = atomKK->k_rmass.template view<DeviceType>().data();
  data->esph = avec.k_esph.template view<DeviceType>().data();
  data->rho = avec.k_rho.template view<DeviceType>().data();
  data->drho = avec.k_drho.template view<DeviceType>().data();
  data->vfrac = avec.k_vfrac.template view<DeviceType>().data();
  data->desph = avec.k_desph.template view<DeviceType>().data();
  data->rho_sum = avec.k_rho_sum.template view<DeviceType>().data();
  data->shear_rate = avec.k_shear_rate.template view<DeviceType>().data();
  data->shear_mu = avec.k_shear_mu.template view<DeviceType>().data();
  data->vol_rate = avec.k_vol_rate.template view<DeviceType>().data();
  data->vol_heat = avec.k_vol_heat.template view<DeviceType>().data();
  data->vol_support = avec.k_vol_support.template view<DeviceType>().data();
  data->not_fluid = not_fluid;
  data->body_bits = engine.body_bits;
  data->keeps_bodies = std::exchange(engine.keeps_bodies, false);
  data->linear = false;
  data->f = atomKK->k_f.template view<DeviceType>();
  data->torque = atomKK->k_torque.template view<DeviceType>();
  if (keeps_forces) clear_forces();

  auto x = atomKK->k_x.template view<DeviceType>();
  auto vest = avec.k_vest.template view<DeviceType>();
  auto omegaest = avec.k_omegaest.template view<DeviceType>();
  const ParticleRows rows = *data;
  Spin *const spins_of = data->spin;
  auto weights = weight;
  for_each(
      "sph:particles", atom->nlocal + atom->nghost, KOKKOS_LAMBDA(int i) {
        for (int d = 0; d < 3; d++) {
          rows.particle[i].x[d] = x(i, d);
          rows.particle[i].u[d] = vest(i, d);
          if (spins_of) spins_of[i].w[d] = omegaest(i, d);
        }
        rows.desph[i] = 0.0;
        if (rows.each) weights(i) = rows.reference_volume(i);
      });
}

/* ----------------------------------------------------------------------
   Send fields on the device; with some kinds of communication, LAMMPS sends on the host, whatever the pair style is.
------------------------------------------------------------------------- */

template <class DeviceType> void DeviceSpace<DeviceType>::forward(const std::vector<Field> &fields)
{
  if (pair->execution_space == Device && !lmp->kokkos->forward_pair_comm_legacy &&
      comm->style != Comm::TILED) {
    sent = ColumnsKokkos();
    for (const Field &one : fields) sent.add(one);
    return comm->forward_comm(pair, sent.n);
  }
  const auto numbers = [n = atom->nlocal + atom->nghost](const Field &one) {
    return Kokkos::View<double *, Kokkos::LayoutRight, DeviceType, Kokkos::MemoryUnmanaged>(
        one.first, n ? (n - 1) * one.stride + one.width : 0);
  };
  std::vector<Kokkos::View<double *, Kokkos::LayoutRight, Kokkos::HostSpace>> copies;
  std::vector<Field> on_host = fields;
  for (Field &one : on_host) {
    copies.push_back(Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), numbers(one)));
    one.first = copies.back().data();
  }
  exchange.forward(on_host);
  for (std::size_t k = 0; k < fields.size(); k++) Kokkos::deep_copy(numbers(fields[k]), copies[k]);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> int DeviceSpace<DeviceType>::nforce() const
{
  return atom->nlocal;
}

template <class DeviceType> const ParticleRows &DeviceSpace<DeviceType>::rows() const
{
  return *data;
}

template <class DeviceType> StateRows DeviceSpace<DeviceType>::states()
{
  set_states();
  return data->states;
}

template <class DeviceType> const int *DeviceSpace<DeviceType>::mask() const
{
  return atomKK->k_mask.template view<DeviceType>().data();
}

template <class View> static VectorField field_of_view(const View &view)
{
  return {view.data(), view.stride(0), view.stride(1)};
}

template <class DeviceType, class Array> static VectorField field_of(Array &array)
{
  return field_of_view(array.template view<DeviceType>());
}

template <class DeviceType> VectorField DeviceSpace<DeviceType>::x() const
{
  return field_of<DeviceType>(atomKK->k_x);
}

template <class DeviceType> VectorField DeviceSpace<DeviceType>::v() const
{
  return field_of<DeviceType>(atomKK->k_v);
}

template <class DeviceType> VectorField DeviceSpace<DeviceType>::vest() const
{
  return field_of<DeviceType>(AtomVecSPHBulkKokkos::of(atom).k_vest);
}

template <class DeviceType> VectorField DeviceSpace<DeviceType>::omega() const
{
  return field_of<DeviceType>(atomKK->k_omega);
}

template <class DeviceType> VectorField DeviceSpace<DeviceType>::omegaest() const
{
  return field_of<DeviceType>(AtomVecSPHBulkKokkos::of(atom).k_omegaest);
}

template <class DeviceType> const double *DeviceSpace<DeviceType>::inertia() const
{
  return AtomVecSPHBulkKokkos::of(atom).k_inertia.template view<DeviceType>().data();
}

template <class DeviceType> VectorField DeviceSpace<DeviceType>::forces() const
{
  return field_of_view(own_force);
}

template <class DeviceType> VectorField DeviceSpace<DeviceType>::torques() const
{
  return field_of_view(own_torque);
}

template <class DeviceType> Spin *DeviceSpace<DeviceType>::spins() const
{
  return data->spin;
}

template <class DeviceType> double *DeviceSpace<DeviceType>::energies() const
{
  return AtomVecSPHBulkKokkos::of(atom).k_esph.template view<DeviceType>().data();
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
void DeviceSpace<DeviceType>::sum_density(NeighList *, double **, double **, bool)
{
  with_kernel(data->par.kernel, [&](auto kernel) {
    for_each("sph:density", pair->list->inum,
             DensityLoopKokkos<DeviceType, decltype(kernel)>{*data});
  });
}

template <class DeviceType> void DeviceSpace<DeviceType>::set_shear_rates(int not_fluid)
{
  sum_pairs("sph:shear_rates", ShearRateSum{not_fluid});
}

template <class DeviceType> void DeviceSpace<DeviceType>::sum_rates()
{
  sum_pairs("sph:rates", RateSum());
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void DeviceSpace<DeviceType>::sum_forces(bool tally)
{
  const int n = pair->list->inum;
  with_kernel(data->par.kernel, [&](auto kernel) {
    typedef decltype(kernel) K;
    with_form(data->par.terms(), [&](auto form) {
      typedef decltype(form) Form;
      if (data->par.bulk == Bulk::VOLUME)
        run_loop("sph:forces", n, ForceLoopKokkos<DeviceType, K, Form, true>{*data}, tally);
      else
        run_loop("sph:forces", n, ForceLoopKokkos<DeviceType, K, Form, false>{*data}, tally);
    });
  });
}

template <class DeviceType> void DeviceSpace<DeviceType>::sum_friction(NeighList *, int not_fluid)
{
  clear_forces();
  data->linear = true;
  data->excess = nullptr;
  data->not_fluid = not_fluid;
  sum_forces(false);
}

template <class DeviceType> void DeviceSpace<DeviceType>::clear_forces()
{
  Kokkos::deep_copy(own_force, 0.0);
  data->f = own_force;
  if (!engine.has_spin()) return;
  Kokkos::deep_copy(own_torque, 0.0);
  data->torque = own_torque;
}

template <class DeviceType> void DeviceSpace<DeviceType>::add_forces() const
{
  const bool spins = engine.has_spin();
  const VectorField own = forces(), own_turn = torques(), f = field_of<DeviceType>(atomKK->k_f),
                    torque = field_of<DeviceType>(atomKK->k_torque);
  for_each(
      "sph:add_forces", atom->nlocal, KOKKOS_LAMBDA(int i) {
        for (int d = 0; d < 3; d++) {
          f.at(i, d) += own.at(i, d);
          if (spins) torque.at(i, d) += own_turn.at(i, d);
        }
      });
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> double *DeviceSpace<DeviceType>::sum_flow(int k)
{
  flows_known = true;
  double *const rate = flow_rate(k);
  with_kernel(data->par.kernel, [&](auto kernel) {
    for_each("sph:flow", pair->list->inum,
             FlowLoopKokkos<DeviceType, decltype(kernel)>{*data, k, rate});
  });
  return rate;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> double DeviceSpace<DeviceType>::memory_usage() const
{
  double of_flows = 0.0;
  for (int k = 0; k < Flows::NUMBER; k++) of_flows += bytes_of(flow[k], flow_rates[k]);
  return of_flows +
      bytes_of(particle, density_sum, spin, zeta_term, state_pressure, weight, viscosity,
               data->heat, own_force, own_torque);
}

/* ---------------------------------------------------------------------- */

template class SPHDissipation::DeviceSpace<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class SPHDissipation::DeviceSpace<LMPHostType>;
#endif
