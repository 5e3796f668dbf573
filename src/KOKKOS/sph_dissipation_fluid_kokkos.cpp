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

#include "sph_dissipation_fluid_kokkos.h"

#include "atom_kokkos.h"
#include "atom_vec_sph_bulk_kokkos.h"
#include "comm.h"
#include "force.h"
#include "kokkos.h"
#include "neigh_list_kokkos.h"
#include "neighbor.h"
#include "pair.h"
#include "sph_dissipation_boundary_kokkos.h"
#include "sph_dissipation_boundary_stage.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_loops_kokkos.h"
#include "sph_dissipation_masks_kokkos.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_particle_terms.h"
#include "sph_dissipation_stages.h"
#include "sph_dissipation_sums_kokkos.h"
#include "sph_dissipation_threads_kokkos.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// the device is the host

static constexpr bool HOST_ONLY = std::is_same_v<LMPHostType, LMPDeviceType>;

/* ---------------------------------------------------------------------- */

template <class DeviceType>
FluidKokkos<DeviceType>::FluidKokkos(LAMMPS *lmp, Pair *pair, bool spins) :
    Fluid(lmp, pair, spins), on_device(true), copied(false), threads(new ThreadsKokkos),
    kokkos_list(nullptr), host_list(new NeighList(lmp)), nlocal_device(-1), nghost_device(-1),
    data(new LoopDataKokkos<DeviceType>), types(new Kokkos::View<TypeKokkos *, DeviceType>),
    boundary_device(new BoundaryStageKokkos<DeviceType>(lmp, pair, *boundary))
{
  atomKK = (AtomKokkos *) atom;
  engine->set_threads(threads.get());
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> FluidKokkos<DeviceType>::~FluidKokkos()
{
  host_list->ilist = host_list->numneigh = nullptr;    // ours
  host_list->firstneigh = nullptr;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::choose(bool device)
{
  on_device = device;
  copied = false;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::init_list(NeighList *list)
{
  kokkos_list = list;
  if (!on_device && HOST_ONLY) pair->list = host_list.get();
}

/* ----------------------------------------------------------------------
   a task of the CPU style while the forces are computed on the device: with the particles, a
   neighbor list and communication on the host
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::on_host(const std::function<void()> &task)
{
  atomKK->sync(Host, ALL_MASK);
  if (!on_device) {
    refer_to_list();
    task();
    return atomKK->modified(Host, FLUID_DERIVED | RMASS_MASK);
  }
  build_host_list();
  NeighList *const device_list = pair->list;
  pair->list = host_list.get();
  pair->execution_space = Host;
  task();
  pair->execution_space = ExecutionSpaceFromDevice<DeviceType>::space;
  pair->list = device_list;
  atomKK->modified(Host, FLUID_DERIVED | RMASS_MASK);
}

/* ----------------------------------------------------------------------
   the half list of KOKKOS on the host as one of the CPU style
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::refer_to_list()
{
  if constexpr (HOST_ONLY) {
    auto *k_list = static_cast<NeighListKokkos<DeviceType> *>(kokkos_list);
    host_firstneigh.resize(atom->nlocal);
    for (int i = 0; i < atom->nlocal; i++) host_firstneigh[i] = &k_list->d_neighbors(i, 0);
    host_list->inum = k_list->inum;
    host_list->ilist = k_list->d_ilist.data();
    host_list->numneigh = k_list->d_numneigh.data();
    host_list->firstneigh = host_firstneigh.data();
  }
}

/* ----------------------------------------------------------------------
   the half list of the CPU style from the full one of the device; with newton on, IDs tell which of the
   two owners has a pair of an owned particle and a ghost
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::build_host_list()
{
  auto *k_list = static_cast<NeighListKokkos<DeviceType> *>(pair->list);
  const auto ilist = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), k_list->d_ilist);
  const auto numneigh =
      Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), k_list->d_numneigh);
  const auto neighbors =
      Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), k_list->d_neighbors);
  const int nlocal = atom->nlocal;
  double **x = atom->x;
  const tagint *const tag = atom->tag;

  auto above = [=](int i, int j) {
    for (int d : {2, 1, 0})
      if (x[i][d] != x[j][d]) return x[i][d] > x[j][d];
    return false;
  };
  auto mine = [=, this](int i, int j) {
    if (j < nlocal) return i < j;
    if (!force->newton_pair) return true;
    if (!atom->tag_enable || tag[i] == tag[j]) return above(j, i);
    return (tag[i] > tag[j]) == ((tag[i] + tag[j]) % 2 == 1);
  };

  const int inum = pair->list->inum;
  host_ilist.resize(inum);
  host_numneigh.assign(nlocal, 0);
  host_firstneigh.assign(nlocal, nullptr);
  host_neighbors.clear();
  std::vector<std::size_t> first(inum);
  for (int ii = 0; ii < inum; ii++) {
    const int i = host_ilist[ii] = ilist(ii);
    first[ii] = host_neighbors.size();
    for (int jj = 0; jj < numneigh(i); jj++) {
      const int j = neighbors(i, jj) & NEIGHMASK;
      if (mine(i, j)) host_neighbors.push_back(j);
    }
    host_numneigh[i] = static_cast<int>(host_neighbors.size() - first[ii]);
  }
  for (int ii = 0; ii < inum; ii++)
    host_firstneigh[host_ilist[ii]] = host_neighbors.data() + first[ii];

  host_list->inum = inum;
  host_list->ilist = host_ilist.data();
  host_list->numneigh = host_numneigh.data();
  host_list->firstneigh = host_firstneigh.data();
}

/* ----------------------------------------------------------------------
   the reports need the pairs that pass 1 leaves; the densities stay as they are, those of walls are no
   sums over their neighbors
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::announce()
{
  if (!pair->compute_flag) return;
  on_host([&]() {
    if (on_device) {
      const int n = atom->nlocal + atom->nghost;
      const std::vector<double> rho(atom->rho, atom->rho + n), drho(atom->drho, atom->drho + n),
          vfrac(atom->vfrac, atom->vfrac + n);
      density->run(pair->list, atom->vest, nullptr);
      std::copy(rho.begin(), rho.end(), atom->rho);
      std::copy(drho.begin(), drho.end(), atom->drho);
      std::copy(vfrac.begin(), vfrac.end(), atom->vfrac);
    }
    report();
  });
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> double FluidKokkos<DeviceType>::elastic_energy(Moment moment)
{
  if (moment == LAST_FORCES) atomKK->sync(Host, ENERGY);
  return Fluid::elastic_energy(moment);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> bool FluidKokkos<DeviceType>::has_own_forces() const
{
  if (!on_device) return Fluid::has_own_forces();
  return nlocal_device == atom->nlocal && nghost_device == atom->nghost;
}

/* ----------------------------------------------------------------------
   with a full list, no heat is left with ghost atoms
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::heating(double *heat, double *power) const
{
  if (!on_device) return Fluid::heating(heat, power);
  std::fill(power, power + NCHANNEL, 0.0);
  if (heat) std::fill(heat, heat + atom->nlocal + atom->nghost, 0.0);
  for (int k = 0; k < NCHANNEL; k++) {
    const auto from = Kokkos::create_mirror_view_and_copy(LMPHostType(), data->heat[k]);
    for (int i = 0; i < atom->nlocal; i++) {
      if (atom->mask[i] & not_fluid()) continue;
      power[k] += from(i);
      if (heat) heat[i] += from(i);
    }
  }
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> bigint FluidKokkos<DeviceType>::compute(PairTally *tally)
{
  if (!on_device) {
    refer_to_list();
    std::fill_n(atom->desph, atom->nlocal + atom->nghost, 0.0);
    const bigint nbeyond = Fluid::compute(tally);
    exchange->reverse({{atom->desph, 1, 1}});    // the atom style does not
    if (spins) exchange->reverse({{atom->torque[0], 3, 3}});
    return nbeyond;
  }

  if (stale) {
    adopt_changes();
    copied = false;
  }
  if (neighbor->ago == 0) {
    atomKK->sync(Host, RMASS_MASK | TAG_MASK | TYPE_MASK);
    check_masses(lmp, style, *model);
  }
  if (!copied) copy_coeffs();
  grow();

  atomKK->sync(pair->execution_space, FLUID_READ);
  set_particles();
  run_density();
  send_density();
  const bool limited = (model->choice.limit != Limit::NO);
  if (limited) find_bound();
  set_state();
  if (!boundary->empty()) {
    boundary_device->run(*data, model->choice.kernel, dim, pair->list->inum);
    send_boundary();
  }
  if (shift->wanted) find_gradient();
  run_forces(tally);
  atomKK->modified(pair->execution_space, FLUID_MODIFIED);

  if (pair->eflag_either) atomKK->sync(Host, ENERGY);
  nlocal_device = atom->nlocal;
  nghost_device = atom->nghost;
  return limited ? beyond_bound_of_limit() : 0;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::grow()
{
  auto reach = [](auto &view, const char *name, int n) {
    if ((int) view.extent(0) >= n) return;
    view = std::decay_t<decltype(view)>();    // frees the old one first
    view = std::decay_t<decltype(view)>(Kokkos::NoInit(name), n);
  };
  const int n = atom->nmax;
  const bool spins = engine->has_spin();
  reach(data->particle, "sph:particle", n);
  reach(data->density, "sph:density", n);
  reach(data->zeta_term, "sph:zeta_term", n);
  if (spins) reach(data->spin, "sph:spin", n);
  for (int k = 0; k < NCHANNEL; k++) reach(data->heat[k], "sph:heat", n);
  reach(data->weight, "sph:weight", data->each ? n : 1);
}

/* ----------------------------------------------------------------------
   coefficients of types and type pairs, and what the loops need of the model
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::copy_coeffs()
{
  const Parameters &par = engine->parameters();
  const int n = par.ntypes_1;
  if (!types->extent(0)) {
    *types = Kokkos::View<TypeKokkos *, DeviceType>("sph:types", n);
    data->coeff = Kokkos::View<PairCoeff *, DeviceType>("sph:coeff", n * n);
  }
  auto h_types = Kokkos::create_mirror_view(*types);
  auto h_coeff = Kokkos::create_mirror_view(data->coeff);
  for (int i = 1; i < n; i++)
    h_types(i) = {par.type[i].eos, par.type[i].zeta, par.type[i].keywords};
  for (int k = 0; k < n * n; k++) h_coeff(k) = par.pair[k];
  Kokkos::deep_copy(*types, h_types);
  Kokkos::deep_copy(data->coeff, h_coeff);

  data->ntypes_1 = n;
  data->typed = par.uniform ? 0 : 1;
  data->bulk = par.bulk;
  data->types = *types;
  data->drag = par.drag;
  data->support = par.support;
  data->weight_norm = par.weight_norm;
  data->slope_norm = par.slope_norm;
  data->self_weight = par.self_weight;

  data->each = (model->choice.volume == Volume::MASS) ? 1 : 0;
  data->weight = decltype(data->weight)("sph:weight", 1);    // by mass it is set in each step
  Kokkos::deep_copy(data->weight, 1.0);
  copied = true;
}

/* ----------------------------------------------------------------------
   what pass 1 reads of owned and ghost atoms
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::set_particles()
{
  const auto &avec = AtomVecSPHBulkKokkos::of(atom);
  auto x = atomKK->k_x.template view<DeviceType>();
  auto vest = avec.k_vest.template view<DeviceType>();
  auto type = atomKK->k_type.template view<DeviceType>();
  auto rmass = atomKK->k_rmass.template view<DeviceType>();
  auto particle = data->particle;
  auto weight = data->weight;
  auto coeffs = *types;
  const bool weighted = data->each;

  Kokkos::parallel_for(
      "sph:particles", Kokkos::RangePolicy<DeviceType>(0, atom->nlocal + atom->nghost),
      KOKKOS_LAMBDA(int i) {
        for (int d = 0; d < 3; d++) {
          particle(i).x[d] = x(i, d);
          particle(i).u[d] = vest(i, d);
        }
        if (weighted) weight(i) = rmass(i) / coeffs(type(i)).eos.rho0;
      });

  auto *k_list = static_cast<NeighListKokkos<DeviceType> *>(pair->list);
  data->ilist = k_list->d_ilist;
  data->numneigh = k_list->d_numneigh;
  data->neighbors = k_list->d_neighbors;
  data->type = type;
  data->mask = atomKK->k_mask.template view<DeviceType>();
  data->not_fluid = not_fluid();
  data->f = atomKK->k_f.template view<DeviceType>();
  data->desph = avec.k_desph.template view<DeviceType>();
  if (engine->has_spin()) set_spins();
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::set_spins()
{
  const auto &avec = AtomVecSPHBulkKokkos::of(atom);
  auto omegaest = avec.k_omegaest.template view<DeviceType>();
  auto spin = data->spin;
  data->torque = atomKK->k_torque.template view<DeviceType>();

  Kokkos::parallel_for(
      "sph:spins", Kokkos::RangePolicy<DeviceType>(0, atom->nlocal + atom->nghost),
      KOKKOS_LAMBDA(int i) {
        for (int d = 0; d < 3; d++) spin(i).w[d] = omegaest(i, d);
      });
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::run_density()
{
  with_kernel(model->choice.kernel, [&](auto kernel) {
    typedef decltype(kernel) K;
    Kokkos::parallel_for("sph:density", Kokkos::RangePolicy<DeviceType>(0, pair->list->inum),
                         DensityLoopKokkos<DeviceType, K>{*data});
  });
}

/* ----------------------------------------------------------------------
   to the ghosts; LAMMPS has some kinds of communication on the host, whatever the pair style is
------------------------------------------------------------------------- */

template <class DeviceType> bool FluidKokkos<DeviceType>::communicates_on_device() const
{
  return pair->execution_space == Device && !lmp->kokkos->forward_pair_comm_legacy &&
      comm->style != Comm::TILED;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::send_density()
{
  const bool ideal = (model->choice.eos == Eos::IDEAL);    // which needs the energy of ghost atoms

  if (communicates_on_device()) {
    auto *const rows = reinterpret_cast<double *>(data->density.data());
    sent = ColumnsKokkos();
    for (int k : {0, 1}) sent.add(rows + k, 2);
    if (ideal) {
      const auto &avec = AtomVecSPHBulkKokkos::of(atom);
      sent.add(avec.k_esph.template view<DeviceType>());
    }
    comm->forward_comm(pair, sent.n);
    return;
  }

  auto copy = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), data->density);
  const Field sums = field(copy.data(), &copy.data()->c, 2);
  if (ideal) {
    atomKK->sync(Host, ESPH_MASK);
    exchange->forward({sums, {atom->esph, 1, 1}});
    atomKK->modified(Host, ESPH_MASK);
    atomKK->sync(pair->execution_space, ESPH_MASK);
  } else
    exchange->forward({sums});
  Kokkos::deep_copy(data->density, copy);
}

/* ----------------------------------------------------------------------
   of the limit, from the volumes of the densities, for owned and ghost atoms
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::find_bound()
{
  auto particle = data->particle;
  auto density_of = data->density;
  auto weight = data->weight;
  const int each = data->each;
  Kokkos::parallel_for(
      "sph:volume", Kokkos::RangePolicy<DeviceType>(0, atom->nlocal + atom->nghost),
      KOKKOS_LAMBDA(int i) { particle(i).vol = weight(i * each) / density_of(i).c; });

  if ((int) bound.extent(0) < atom->nmax) {
    bound = {};
    bound = decltype(bound)(Kokkos::NoInit("sph:bound"), atom->nmax);
  }
  with_kernel(model->choice.kernel, [&](auto kernel) {
    Kokkos::parallel_for(
        "sph:bound", Kokkos::RangePolicy<DeviceType>(0, pair->list->inum),
        BoundLoopKokkos<DeviceType, decltype(kernel)>{*data, engine->parameters().shear, bound});
  });

  if (communicates_on_device()) {
    sent = ColumnsKokkos();
    sent.add(bound);
    comm->forward_comm(pair, sent.n);
    return;
  }
  auto copy = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), bound);
  exchange->forward({{copy.data(), 1, 1}});
  Kokkos::deep_copy(bound, copy);
}

/* ----------------------------------------------------------------------
   # of particles of the fluid that are beyond it
------------------------------------------------------------------------- */

template <class DeviceType> int FluidKokkos<DeviceType>::beyond_bound_of_limit() const
{
  auto bounds = bound;
  auto coeffs = *types;
  auto type = data->type;
  auto mask = atomKK->k_mask.template view<DeviceType>();
  const int except = not_fluid();
  int count = 0;
  Kokkos::parallel_reduce(
      "sph:beyond", Kokkos::RangePolicy<DeviceType>(0, atom->nlocal),
      KOKKOS_LAMBDA(int i, int &sum) {
        if (!(mask(i) & except) && beyond_bound(coeffs(type(i)).zeta, bounds(i))) sum++;
      },
      count);
  return count;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::find_gradient()
{
  if ((int) gradient_of.extent(0) < atom->nmax) {
    gradient_of = {};
    gradient_of = decltype(gradient_of)(Kokkos::NoInit("sph:gradient"), atom->nmax);
  }
  with_kernel(model->choice.kernel, [&](auto kernel) {
    Kokkos::parallel_for("sph:gradient", Kokkos::RangePolicy<DeviceType>(0, pair->list->inum),
                         ShiftLoopKokkos<DeviceType, decltype(kernel)>{*data, dim, gradient_of});
  });
}

/* ----------------------------------------------------------------------
   what the boundary has set of owned particles; ghosts of the fluid get what they have already
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::send_boundary()
{
  static constexpr int FIRST = 3, WIDTH = 5;    // u, vol and g of Particle
  static constexpr int ROW = sizeof(Particle) / sizeof(double);

  if (communicates_on_device()) {
    auto *const rows = reinterpret_cast<double *>(data->particle.data());
    sent = ColumnsKokkos();
    for (int k = FIRST; k < FIRST + WIDTH; k++) sent.add(rows + k, ROW);
    sent.add(data->zeta_term);
    if (engine->has_spin()) {
      auto *const spins = reinterpret_cast<double *>(data->spin.data());
      for (int k : {0, 1, 2}) sent.add(spins + k, sizeof(Spin) / sizeof(double));
    }
    comm->forward_comm(pair, sent.n);
    return;
  }

  auto particle = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), data->particle);
  auto zeta_term = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), data->zeta_term);
  const Field state = field(particle.data(), particle.data()->u, WIDTH);
  const Field bulk_term = {zeta_term.data(), 1, 1};
  if (engine->has_spin()) {
    auto spin = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), data->spin);
    exchange->forward({state, bulk_term, field(spin.data(), spin.data()->w, 3)});
    Kokkos::deep_copy(data->spin, spin);
  } else
    exchange->forward({state, bulk_term});
  Kokkos::deep_copy(data->particle, particle);
  Kokkos::deep_copy(data->zeta_term, zeta_term);
}

/* ----------------------------------------------------------------------
   volume, density, pressure and bulk term of owned and ghost atoms; boundary particles, most of whose
   neighbors are not there, have the reference density of their type
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::set_state()
{
  const auto &avec = AtomVecSPHBulkKokkos::of(atom);
  auto rmass = atomKK->k_rmass.template view<DeviceType>();
  auto rho = avec.k_rho.template view<DeviceType>();
  auto drho = avec.k_drho.template view<DeviceType>();
  auto vfrac = avec.k_vfrac.template view<DeviceType>();
  auto esph = avec.k_esph.template view<DeviceType>();
  auto desph = data->desph;
  auto type = data->type;
  auto particle = data->particle;
  auto density_of = data->density;
  auto weight_of = data->weight;
  auto zeta_term = data->zeta_term;
  auto coeffs = *types;
  const int each = data->each;
  const Eos eos = model->choice.eos;
  const Bulk bulk = model->choice.bulk;
  auto mask = atomKK->k_mask.template view<DeviceType>();
  const int boundary_bits = boundary->bits();
  const bool limited = (model->choice.limit == Limit::YES);
  auto bounds = bound;

  Kokkos::parallel_for(
      "sph:state", Kokkos::RangePolicy<DeviceType>(0, atom->nlocal + atom->nghost),
      KOKKOS_LAMBDA(int i) {
        if (mask(i) & boundary_bits) {
          rho(i) = coeffs(type(i)).eos.rho0;
          SPHDissipation::set_state(particle(i), rmass(i), rho(i), 0.0, weight_of(i * each));
          vfrac(i) = particle(i).vol;
          drho(i) = zeta_term(i) = desph(i) = 0.0;
          return;
        }
        const double weight = weight_of(i * each);
        const double mass = rmass(i) / weight;
        const double vol = weight / density_of(i).c;
        rho(i) = mass * density_of(i).c;
        drho(i) = mass * density_of(i).cdot;
        vfrac(i) = vol;
        const TypeKokkos &coeff = coeffs(type(i));
        const double zeta = (limited && beyond_bound(coeff.zeta, bounds(i)))
            ? zeta_at_bound(bounds(i))
            : coeff.zeta;
        const ParticleTerms terms = particle_terms(eos, coeff.eos, bulk, zeta, vol, weight,
                                                   density_of(i).cdot, rho(i), esph(i) / rmass(i));
        particle(i).vol = vol;
        particle(i).g = terms.g;
        zeta_term(i) = terms.zeta_term;
        desph(i) = terms.work;
      });
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::run_forces(bool virial)
{
  data->vatom = {};
  if (pair->vflag_atom) data->vatom = decltype(data->vatom)("sph:vatom", atom->nlocal);

  with_kernel(model->choice.kernel, [&](auto kernel) {
    with_form(model->choice.shear, [&](auto form) {
      run_force_loop<decltype(kernel), decltype(form)>(virial);
    });
  });

  if (!pair->vflag_atom) return;
  const auto from = Kokkos::create_mirror_view_and_copy(LMPHostType(), data->vatom);
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < 6; k++) pair->vatom[i][k] += from(i, k);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
template <class K, class Form>
void FluidKokkos<DeviceType>::run_force_loop(bool virial)
{
  if (model->choice.bulk == Bulk::VOLUME)
    run_loop(ForceLoopKokkos<DeviceType, K, Form, true>{*data}, virial);
  else
    run_loop(ForceLoopKokkos<DeviceType, K, Form, false>{*data}, virial);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
template <class Loop>
void FluidKokkos<DeviceType>::run_loop(const Loop &loop, bool tally)
{
  const auto range = Kokkos::RangePolicy<DeviceType>(0, pair->list->inum);
  if (!tally) return Kokkos::parallel_for("sph:forces", range, loop);
  EV_FLOAT ev;
  Kokkos::parallel_reduce("sph:forces", range, loop, ev);
  if (pair->vflag_global)
    for (int k = 0; k < 6; k++) pair->virial[k] += ev.v[k];
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> double FluidKokkos<DeviceType>::memory_usage() const
{
  double bytes = Fluid::memory_usage();
  bytes += (double) data->particle.extent(0) *
      (sizeof(Particle) + sizeof(DensitySum) + 3 * sizeof(double));
  return bytes + (double) data->weight.extent(0) * sizeof(double) +
      boundary_device->memory_usage() +
      (double) (bound.size() + gradient_of.size()) * sizeof(double);
}

/* ---------------------------------------------------------------------- */

namespace LAMMPS_NS {
namespace SPHDissipation {
  template class FluidKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
  template class FluidKokkos<LMPHostType>;
#endif
}    // namespace SPHDissipation
}    // namespace LAMMPS_NS
