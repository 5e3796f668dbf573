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
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_loops_kokkos.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_stages.h"
#include "sph_dissipation_sums_kokkos.h"
#include "sph_dissipation_threads.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <string>
#include <utility>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// The threads of the KOKKOS package on the host

class ThreadsKokkos : public Threads {
 public:
  int size() const override { return LMPHostType().concurrency(); }
  void run(const std::function<void(int)> &task) override
  {
    Kokkos::parallel_for("sph:threads", Kokkos::RangePolicy<LMPHostType>(0, size()), [&](int k) {
      task(k);
    });
  }
};

/* ---------------------------------------------------------------------- */

template <class DeviceType>
FluidKokkos<DeviceType>::FluidKokkos(LAMMPS *lmp, Pair *pair, bool spins) :
    Fluid(lmp, pair, spins), on_device(true), copied(false), rates_known(false),
    threads(new ThreadsKokkos), host_list(new NeighList(lmp)), nlocal_device(-1), nghost_device(-1),
    data(new LoopDataKokkos<DeviceType>()),
    boundary_device(new BoundaryStageKokkos<DeviceType>(lmp, pair, *boundary))
{
  atomKK = (AtomKokkos *) atom;
  engine->set_threads(threads.get());
  exchange->set_threads(threads.get());
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> FluidKokkos<DeviceType>::~FluidKokkos() = default;

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::choose(bool device)
{
  on_device = device;
  copied = false;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::request_list()
{
  if (!on_device) return Fluid::request_list();
  own_list = false;
  neighbor->add_request(pair);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> uint64_t FluidKokkos<DeviceType>::read_mask() const
{
  return model->choice.continuity ? FLUID_READ | CONTINUITY_MASK : FLUID_READ;
}

template <class DeviceType> uint64_t FluidKokkos<DeviceType>::modified_mask() const
{
  return model->choice.continuity ? FLUID_MODIFIED | CONTINUITY_MASK : FLUID_MODIFIED;
}

/* ----------------------------------------------------------------------
   Run a task of the CPU style while the forces are computed on the device: with the particles, a neighbor list, and
   communication on the host.
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::on_host(const std::function<void()> &task)
{
  atomKK->sync(Host, ALL_MASK);
  if (!on_device) {
    task();
    return atomKK->modified(Host, FLUID_SET_ON_HOST);
  }
  build_host_list();
  NeighList *const device_list = pair->list;
  pair->list = host_list.get();
  pair->execution_space = Host;
  task();
  pair->execution_space = ExecutionSpaceFromDevice<DeviceType>::space;
  pair->list = device_list;
  atomKK->modified(Host, FLUID_SET_ON_HOST);
}

/* ----------------------------------------------------------------------
   Build the half list of the CPU style from the full list of the device.  With newton on, the IDs decide which of the two
   owners has the pair of an owned particle and a ghost.
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

  const int inum = host_list->inum = pair->list->inum;
  host_list->grow(nlocal, nlocal);
  std::fill_n(host_list->numneigh, nlocal, 0);
  std::fill_n(host_list->firstneigh, nlocal, static_cast<int *>(nullptr));
  host_neighbors.clear();
  std::vector<std::size_t> first(inum);
  for (int ii = 0; ii < inum; ii++) {
    const int i = host_list->ilist[ii] = ilist(ii);
    first[ii] = host_neighbors.size();
    for (int jj = 0; jj < numneigh(i); jj++) {
      const int j = neighbors(i, jj) & NEIGHMASK;
      if (mine(i, j)) host_neighbors.push_back(j);
    }
    host_list->numneigh[i] = static_cast<int>(host_neighbors.size() - first[ii]);
  }
  for (int ii = 0; ii < inum; ii++)
    host_list->firstneigh[host_list->ilist[ii]] = host_neighbors.data() + first[ii];
}

/* ----------------------------------------------------------------------
   Run a report.  Reports need the pairs of pass 1.  Restore the densities after this pass: the densities of walls are not
   sums over their neighbors.
------------------------------------------------------------------------- */

template <class DeviceType>
void FluidKokkos<DeviceType>::for_report(const std::function<void()> &task)
{
  on_host([&]() {
    if (on_device) {
      const int n = atom->nlocal + atom->nghost;
      std::vector<std::pair<double *, std::vector<double>>> before;
      for (double *one : {atom->rho, atom->drho, atom->vfrac, Fields::of(atom)->rho_sum})
        before.emplace_back(one, std::vector<double>(one, one + n));
      density->run(pair->list, atom->vest, nullptr, not_fluid());
      for (const auto &[to, from] : before) std::copy(from.begin(), from.end(), to);
    }
    task();
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
   Get the heat.  With a full list, ghost atoms have no heat.  The heat of states is from the present energies.
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::heating(double *heat, double *power) const
{
  if (!on_device) return Fluid::heating(heat, power);
  std::fill(power, power + NCHANNEL, 0.0);
  if (heat) std::fill(heat, heat + atom->nlocal + atom->nghost, 0.0);
  const bool of_states = engine->parameters().states;
  if (of_states) atomKK->sync(Host, HEAT);
  const StateRows states = engine->states();
  const auto from = Kokkos::create_mirror_view_and_copy(LMPHostType(), data->heat);
  for (int i = 0; i < atom->nlocal; i++) {
    if (atom->mask[i] & not_fluid()) continue;
    double channel[NCHANNEL];
    for (int k = 0; k < NCHANNEL; k++) channel[k] = from(i, k);
    if (of_states) states.add_heat(i, channel);
    for (int k = 0; k < NCHANNEL; k++) {
      power[k] += channel[k];
      if (heat) heat[i] += channel[k];
    }
  }
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::adopt()
{
  if (stale) copied = false;
  Fluid::adopt();
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
void FluidKokkos<DeviceType>::begin_run(double dt, bool continues, const Changes &changes)
{
  rates_known = false;
  Fluid::begin_run(dt, continues, changes);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::advance_states()
{
  if (!on_device) {
    atomKK->sync(Host, HEAT | OFFSET_MASK);
    Fluid::advance_states();
    return atomKK->modified(Host, STATES_MASK);
  }
  copy_coeffs();
  atomKK->sync(pair->execution_space, HEAT);
  set_states();
  const ParticleRows rows = *data;
  const int bits = not_fluid();
  for_each<DeviceType>(
      "sph:states", atom->nlocal, KOKKOS_LAMBDA(int i) {
        if (rows.is_fluid(i, bits))
          rows.states.advance(i, nullptr, 0, 0);
        else
          rows.states.forget(i);
      });
  atomKK->modified(pair->execution_space, STATES_MASK);
}

/* ----------------------------------------------------------------------
   Set the arrays of owned particles that their states need.
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::set_states()
{
  const auto at = [](auto &view) {
    return view.template view<DeviceType>().data();
  };
  const auto &avec = AtomVecSPHBulkKokkos::of(atom);
  data->type = at(atomKK->k_type);
  data->mask = at(atomKK->k_mask);
  data->states = {data->types,     data->type,       at(atomKK->k_rmass),
                  at(avec.k_rho),  at(avec.k_drho),  model->choice.eos,
                  at(avec.k_esph), at(avec.k_desph), {}};
  for (int slot : avec.slots) data->states.state[slot] = at(avec.k_state[slot]);
  for (int k = 0; k < Flows::NUMBER; k++)
    data->states.rate[k] = (rates_known && has_rate(k)) ? flow_rate[k].data() : nullptr;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> bigint FluidKokkos<DeviceType>::compute(PairTally *tally)
{
  if (!on_device) {
    threads->for_each(atom->nlocal + atom->nghost, [&](int i) {
      atom->desph[i] = 0.0;
    });
    const bigint nbeyond = Fluid::compute(tally);
    exchange->reverse({{atom->desph, 1, 1}});    // the atom style does not
    if (spins) exchange->reverse({{atom->torque[0], 3, 3}});
    return nbeyond;
  }

  if (update->setupflag)
    atomKK->sync(Host, ALL_MASK);
  else if (neighbor->ago == 0)
    atomKK->sync(Host,
                 RMASS_MASK | TAG_MASK | TYPE_MASK |
                     (checks_speed() ? V_MASK | MASK_MASK : EMPTY_MASK) |
                     (checks_expansion() ? SPH_RHO_MASK | MASK_MASK : EMPTY_MASK));
  const bigint nbeyond = Fluid::compute(tally);
  atomKK->modified(pair->execution_space, modified_mask());

  if (pair->eflag_either) atomKK->sync(Host, ENERGY);
  nlocal_device = atom->nlocal;
  nghost_device = atom->nghost;
  return nbeyond;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::grow()
{
  const int n = atom->nmax;
  data->particle = reach(particle, "sph:particle", n);
  data->density = reach(density_sum, "sph:density", n);
  data->zeta_term = reach(zeta_term, "sph:zeta_term", n);
  data->state_pressure = reach(state_pressure, "sph:state_pressure", n);
  for (int k = 0; k < Flows::NUMBER; k++) {
    const bool used = engine->parameters().flows >> k & 1;
    data->flow[k] = used ? reach(flow[k], "sph:flow", n) : nullptr;
    if (has_rate(k)) reach(flow_rate[k], "sph:flow_rate", n);
  }
  data->spin = engine->has_spin() ? reach(spin, "sph:spin", n) : nullptr;
  reach(data->heat, "sph:heat", n);
  data->weight = reach(weight, "sph:weight", data->each ? n : 1);
  if (model->choice.limit != Limit::NO) reach(bound_of, "sph:bound", n);
  if (!shift->movers.empty()) {
    reach(shift_row, "sph:shift_row", n);
    reach(shift_return, "sph:shift_return", n);
  }
  if (!(engine->parameters().delta > 0.0)) return;
  reach(diffusion_row, "sph:diffusion_row", n);
  reach(impedance, "sph:impedance", n);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> bool FluidKokkos<DeviceType>::has_rate(int place) const
{
  if (place == HEAT_FLOW) return boundary->conducts();
  return engine->parameters().flows >> place & 1;
}

/* ----------------------------------------------------------------------
   Copy coefficients of types and type pairs, and the parameters of the loops; numbers of states belong to one time step.
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::copy_coeffs()
{
  const Parameters &par = engine->parameters();
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
  data->coeff = copy(par.pair, pair_coeff, "sph:coeff");
  data->typed = par.uniform ? 0 : 1;
  data->each = (par.volume == Volume::MASS) ? 1 : 0;
  weight = Array<double>("sph:weight", 1);    // by mass it is set in each step
  Kokkos::deep_copy(weight, 1.0);
  copied = true;
}

/* ----------------------------------------------------------------------
   Set the input of pass 1, of owned and ghost atoms.
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::set_particles()
{
  const auto &avec = AtomVecSPHBulkKokkos::of(atom);
  auto *k_list = static_cast<NeighListKokkos<DeviceType> *>(pair->list);
  data->ilist = k_list->d_ilist;
  data->numneigh = k_list->d_numneigh;
  data->neighbors = k_list->d_neighbors;
  data->nlocal = atom->nlocal;
  data->excess = nullptr;    // until set_boundary()
  set_states();
  data->rmass = atomKK->k_rmass.template view<DeviceType>().data();
  data->esph = avec.k_esph.template view<DeviceType>().data();
  data->rho = avec.k_rho.template view<DeviceType>().data();
  data->drho = avec.k_drho.template view<DeviceType>().data();
  data->vfrac = avec.k_vfrac.template view<DeviceType>().data();
  data->desph = avec.k_desph.template view<DeviceType>().data();
  data->rho_sum = avec.k_rho_sum.template view<DeviceType>().data();
  data->not_fluid = not_fluid();
  data->f = atomKK->k_f.template view<DeviceType>();

  auto x = atomKK->k_x.template view<DeviceType>();
  auto vest = avec.k_vest.template view<DeviceType>();
  data->torque = atomKK->k_torque.template view<DeviceType>();
  auto omegaest = avec.k_omegaest.template view<DeviceType>();
  const ParticleRows rows = *data;
  Spin *const spins_of = data->spin;
  auto weights = weight;
  for_each<DeviceType>(
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

template <class DeviceType>
void FluidKokkos<DeviceType>::send_to_ghosts(const std::vector<Field> &fields)
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
  exchange->forward(on_host);
  for (std::size_t k = 0; k < fields.size(); k++) Kokkos::deep_copy(numbers(fields[k]), copies[k]);
}

/* ----------------------------------------------------------------------
   Run a loop over the rows of the neighbor list; a loop has the data and further members.
------------------------------------------------------------------------- */

template <class DeviceType>
template <template <class, class> class Loop, class... More>
void FluidKokkos<DeviceType>::sum_pairs(const char *name, const More &...more)
{
  with_kernel(model->choice.kernel, [&](auto kernel) {
    for_each<DeviceType>(name, pair->list->inum,
                         Loop<DeviceType, decltype(kernel)>{*data, more...});
  });
}

/* ----------------------------------------------------------------------
   Replace the functions of the stages by those of the device.  On the device, "pairs" adds the forces and the repulsion.
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::list_stages()
{
  typedef FluidKokkos<DeviceType> Own;
  const std::map<std::string, void (Own::*)(StepData &)> own = {
      {"densities", &Own::sum_density},
      {"wall volumes", &Own::set_reference_volume},
      {"bound", &Own::sum_bound},
      {"pressures", &Own::set_pressure},
      {"walls", &Own::set_boundary},
      {"pairs", &Own::sum_forces},
      {"flows", &Own::sum_flows},
      {"diffusion", &Own::evaluate_diffusion},
      {"diffusion heat", &Own::add_diffusion_heat}};
  Fluid::list_stages();
  if (!on_device) return;
  stages.erase(std::remove_if(stages.begin(), stages.end(),
                              [](const ListedStage &one) {
                                return !strcmp(one.name, "forces") ||
                                    !strcmp(one.name, "repulsion");
                              }),
               stages.end());
  for (ListedStage &one : stages)
    one.run = [this, run = own.at(one.name)](StepData &step) {
      (this->*run)(step);
    };
}

/* ----------------------------------------------------------------------
   Run pass 1.  Thermal pressure needs the energy of ghost atoms.
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::sum_density(StepData &)
{
  copy_coeffs();
  grow();
  // also sync modified fields: LAMMPS communicates on the host if MPI cannot use the memory of the GPU
  atomKK->sync(pair->execution_space, read_mask() | modified_mask());
  set_particles();
  sum_pairs<DensityLoopKokkos>("sph:density");

  const ParticleRows rows = *data;
  const bool states = engine->parameters().states, continuity = engine->parameters().continuity;
  const int bits = not_fluid(), flows = engine->parameters().loops_of_flows;
  if (states || flows || continuity) {
    const bool rest = at_rest();
    for_each<DeviceType>(
        "sph:states", atom->nlocal, KOKKOS_LAMBDA(int i) {
          if (continuity) rows.add_offset(i, bits);
          rows.set_density(i);
          if (states) rows.set_state_pressure(i, bits, rest);
          if (flows) rows.set_flow_values(i);
        });
  }
  std::vector<Field> fields = {field(rows.density, &rows.density->c, 2)};
  if (engine->parameters().thermal_pressure) fields.push_back({rows.esph, 1, 1});
  if (states) fields.push_back({rows.state_pressure, 1, 1});
  for (int k = 0; k < Flows::NUMBER; k++)
    if (flows >> k & 1) fields.push_back(field(rows.flow[k], &rows.flow[k]->value, 1));
  send_to_ghosts(fields);

  for_each<DeviceType>(
      "sph:volume", atom->nlocal + atom->nghost, KOKKOS_LAMBDA(int i) {
        rows.set_density(i);
        if (flows) rows.set_flows(i, bits);
      });
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::sum_bound(StepData &)
{
  sum_pairs<BoundLoopKokkos>("sph:bound", bound_of.data());
  send_to_ghosts({{bound_of.data(), 1, 1}});
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::set_reference_volume(StepData &)
{
  const ParticleRows rows = *data;
  const int bits = boundary->bits();
  for_each<DeviceType>(
      "sph:reference", atom->nlocal + atom->nghost,
      KOKKOS_LAMBDA(int i) { rows.set_reference_volume(i, bits); });
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::set_pressure(StepData &step)
{
  const ParticleRows rows = *data;
  const int bits = boundary->bits();
  const double *const bounds = (model->choice.limit != Limit::NO) ? bound_of.data() : nullptr;
  for_each<DeviceType>(
      "sph:pressure", atom->nlocal + atom->nghost,
      KOKKOS_LAMBDA(int i) { rows.set_pressure(i, bounds, bits); });

  int count = 0;
  if (bounds)
    Kokkos::parallel_reduce(
        "sph:beyond", Kokkos::RangePolicy<DeviceType>(0, atom->nlocal),
        KOKKOS_LAMBDA(int i, int &sum) {
          if (rows.is_fluid(i, bits) && rows.is_beyond(i, bounds)) sum++;
        },
        count);
  step.nbeyond = count;
}

/* ----------------------------------------------------------------------
   Set the values of boundary particles, and send them to ghosts.  The message is redundant for ghosts of the fluid.
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::set_boundary(StepData &)
{
  boundary_device->run(*data, pair->list->inum);
  std::vector<Field> fields = {field(data->particle, data->particle->u, 5),    // u, vol and g
                               {data->zeta_term, 1, 1}};
  if (data->spin) fields.push_back(field(data->spin, data->spin->w, 3));
  FlowRow *const heat = data->flow[HEAT_FLOW];
  if (boundary->conducts()) fields.push_back(field(heat, &heat->vol, 4));
  if (data->par.continuity) fields.push_back({boundary_device->particles().occupied.data(), 1, 1});
  send_to_ghosts(fields);
  boundary_device->set_excess(*data);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::shift_particles(double keep)
{
  constexpr uint64_t CHANGED = X_MASK | V_MASK | VEST_MASK | ESPH_MASK;
  const auto space = on_device ? pair->execution_space : Host;
  atomKK->sync(space, CHANGED | MASK_MASK | RMASS_MASK);
  if (!on_device) {
    Fluid::shift_particles(keep);
    return atomKK->modified(space, CHANGED);
  }
  const ShiftDataKokkos<DeviceType> shifting = {*data, shift->law(), shift_row.data()};
  const auto v = atomKK->k_v.template view<DeviceType>();
  const auto mask = atomKK->k_mask.template view<DeviceType>();
  const auto rmass = atomKK->k_rmass.template view<DeviceType>();
  const int nall = atom->nlocal + atom->nghost;
  for_each<DeviceType>(
      "sph:shift_row", nall, KOKKOS_LAMBDA(int i) {
        ShiftRow &row = shifting.row[i];
        row = ShiftRow();
        row.mass = rmass(i);
        for (int d = 0; d < 3; d++) row.v[d] = v(i, d) - shifting.data.particle[i].u[d];
      });
  for (const ShiftMover &mover : shift->movers)
    for_each<DeviceType>(
        "sph:shift_mover", nall, KOKKOS_LAMBDA(int i) {
          if (mask(i) & mover.groupbit)
            let_shift(mover, shifting.law.support, shifting.data.particle[i].vol, shifting.row[i]);
        });
  with_kernel(model->choice.kernel, [&](auto kernel) {
    run_shift<decltype(kernel)>(shifting);
  });

  const auto &avec = AtomVecSPHBulkKokkos::of(atom);
  const auto x = atomKK->k_x.template view<DeviceType>();
  const auto vest = avec.k_vest.template view<DeviceType>();
  const auto esph = avec.k_esph.template view<DeviceType>();
  const auto sums = shift_return;
  const double dt = update->dt, mvv2e = force->mvv2e;
  for_each<DeviceType>(
      "sph:shift", atom->nlocal, KOKKOS_LAMBDA(int i) {
        if (shifting.row[i].vol == 0.0) return;
        double to[3][3];
        for (int d = 0; d < 3; d++) {
          to[0][d] = x(i, d);
          to[1][d] = v(i, d);
          to[2][d] = vest(i, d);
        }
        finish_shift(shifting.row[i], sums(i), dt, keep, mvv2e, to[0], to[1], to[2], esph(i));
        for (int d = 0; d < 3; d++) {
          x(i, d) = to[0][d];
          v(i, d) = to[1][d];
          vest(i, d) = to[2][d];
        }
      });
  atomKK->modified(space, CHANGED);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
template <class K>
void FluidKokkos<DeviceType>::run_shift(const ShiftDataKokkos<DeviceType> &shifting)
{
  const int n = pair->list->inum;
  ShiftRow *const row = shifting.row;
  for_each<DeviceType>(
      "sph:shift_contact", atom->nlocal, KOKKOS_LAMBDA(int i) {
        const double vol = shifting.data.particle[i].vol;
        row[i].contact = contact_inverse<K>(shifting.law.dim, shifting.law.support, vol);
      });
  for_each<DeviceType>("sph:shift_sums", n, ShiftLoopKokkos<DeviceType, K>{shifting});
  send_to_ghosts({field(row, row->q, 6)});
  for_each<DeviceType>("sph:shift_exchange", n, ShiftExchangeKokkos<DeviceType, K>{shifting});
  send_to_ghosts({field(row, row->d, 3)});
  for_each<DeviceType>("sph:shift_tensor", n, ShiftTensorKokkos<DeviceType, K>{shifting});
  send_to_ghosts({field(row, row->w, 3)});
  for_each<DeviceType>("sph:shift_return", n,
                       ShiftReturnKokkos<DeviceType, K>{shifting, shift_return.data()});
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::sum_forces(StepData &step)
{
  data->vatom = {};
  if (pair->vflag_atom) data->vatom = decltype(data->vatom)("sph:vatom", atom->nlocal);
  const int n = pair->list->inum;

  with_kernel(model->choice.kernel, [&](auto kernel) {
    with_form(data->par.terms(), [&](auto form) {
      typedef decltype(kernel) K;
      typedef decltype(form) Form;
      if (data->par.bulk == Bulk::VOLUME)
        run_loop("sph:forces", n, ForceLoopKokkos<DeviceType, K, Form, true>{*data}, step.tally);
      else
        run_loop("sph:forces", n, ForceLoopKokkos<DeviceType, K, Form, false>{*data}, step.tally);
    });
  });
  if (!boundary->empty() && data->par.continuity) {
    const auto &walls = boundary_device->particles();
    run_loop("sph:repulsion", walls.size(), RepulsionKokkos<DeviceType>{*data, walls}, step.tally);
  }

  if (!pair->vflag_atom) return;
  const auto from = Kokkos::create_mirror_view_and_copy(LMPHostType(), data->vatom);
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < 6; k++) pair->vatom[i][k] += from(i, k);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::sum_flows(StepData &)
{
  rates_known = true;
  for (int k = 0; k < Flows::NUMBER; k++) {
    if (!(engine->parameters().loops_of_flows >> k & 1)) continue;
    double *const rate = has_rate(k) ? flow_rate[k].data() : nullptr;
    sum_pairs<FlowLoopKokkos>("sph:flow", k, rate, k == HEAT_FLOW);
    if (rate && k == HEAT_FLOW) boundary_device->add_surface_heat(*data, rate);
  }
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::evaluate_diffusion(StepData &step)
{
  if (!diffusion_is_due()) return;
  const ParticleRows rows = *data;
  const int bits = step.not_fluid, some = integrated;
  auto row = diffusion_row;
  auto impedances = impedance;
  for_each<DeviceType>(
      "sph:diffusion_row", atom->nlocal + atom->nghost,
      KOKKOS_LAMBDA(int i) { rows.set_diffusion(i, bits, some, row(i), impedances(i)); });
  with_kernel(model->choice.kernel, [&](auto kernel) {
    typedef decltype(kernel) K;
    if (rows.par.dim == 3)
      run_diffusion<K, 3>();
    else if (rows.par.dim == 2)
      run_diffusion<K, 2>();
    else
      run_diffusion<K, 1>();
  });
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
template <class K, int DIM>
void FluidKokkos<DeviceType>::run_diffusion()
{
  const auto &avec = AtomVecSPHBulkKokkos::of(atom);
  const Parameters &par = engine->parameters();
  const double shared = par.impedes_alike ? par.type[1].eos.impedance() : 1.0;
  const DiffusionRowsKokkos rows = {diffusion_row.data(),
                                    impedance.data(),
                                    par.delta * par.support / shared,
                                    avec.k_vol_rate.template view<DeviceType>().data(),
                                    avec.k_vol_heat.template view<DeviceType>().data(),
                                    avec.k_vol_support.template view<DeviceType>().data()};
  const int n = pair->list->inum;
  for_each<DeviceType>("sph:gradient", n, GradientLoopKokkos<DeviceType, K, DIM>{*data, rows});
  send_to_ghosts({field(rows.row, rows.row->a + DiffusionPlaces<DIM>::G, DIM)});
  for_each<DeviceType>("sph:diffusion", n, DiffusionLoopKokkos<DeviceType, K, DIM>{*data, rows});
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::add_diffusion_heat(StepData &step)
{
  const auto &avec = AtomVecSPHBulkKokkos::of(atom);
  auto rate = avec.k_vol_rate.template view<DeviceType>();
  auto heat = avec.k_vol_heat.template view<DeviceType>();
  const ParticleRows rows = *data;
  const int bits = step.not_fluid, some = integrated;
  for_each<DeviceType>(
      "sph:diffusion_heat", atom->nlocal, KOKKOS_LAMBDA(int i) {
        if (!rows.diffuses(i, bits, some)) rate(i) = heat(i) = 0.0;
        rows.desph[i] += heat(i);
      });
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> double FluidKokkos<DeviceType>::wall_energy(double *each_atom) const
{
  if (!on_device) return Fluid::wall_energy(each_atom);
  if (!model->choice.continuity) return 0.0;
  const auto occupied =
      Kokkos::create_mirror_view_and_copy(LMPHostType(), boundary_device->particles().occupied);
  double total = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (is_boundary(i)) continue;
    const double stiffness = stiffness_of_surface(HARDNESS_OF_SURFACE, atom->rmass[i],
                                                  model->coeffs[atom->type[i]].eos.c0);
    const double energy = energy_of_repulsion(stiffness, beyond_surface(occupied(i)));
    total += energy;
    if (each_atom) each_atom[i] += energy;
  }
  return total;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> double FluidKokkos<DeviceType>::received_heat(int groupbit) const
{
  if (!on_device || !pair->compute_flag || !boundary->conducts()) {
    if (model->choice.own_temperatures) atomKK->sync(Host, DESPH_MASK | MASK_MASK);
    return Fluid::received_heat(groupbit);
  }
  auto mask = atomKK->k_mask.template view<DeviceType>();
  auto flow_of = flow_rate[HEAT_FLOW];
  double total = 0.0;
  Kokkos::parallel_reduce(
      "sph:received_heat", Kokkos::RangePolicy<DeviceType>(0, atom->nlocal),
      KOKKOS_LAMBDA(int i, double &sum) {
        if (mask(i) & groupbit) sum += flow_of(i);
      },
      total);
  return total;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
template <class Loop>
void FluidKokkos<DeviceType>::run_loop(const char *name, int n, const Loop &loop, bool tally)
{
  const auto range = Kokkos::RangePolicy<DeviceType>(0, n);
  const VirialLoopKokkos<Loop> with_virial = {loop};
  if (!tally) return Kokkos::parallel_for(name, range, with_virial);
  EV_FLOAT ev;
  Kokkos::parallel_reduce(name, range, with_virial, ev);
  if (pair->vflag_global)
    for (int k = 0; k < 6; k++) pair->virial[k] += ev.v[k];
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> double FluidKokkos<DeviceType>::memory_usage() const
{
  double of_flows = 0.0;
  for (int k = 0; k < Flows::NUMBER; k++) of_flows += bytes_of(flow[k], flow_rate[k]);
  return Fluid::memory_usage() + boundary_device->memory_usage() + of_flows +
      bytes_of(particle, density_sum, spin, zeta_term, state_pressure, weight, bound_of, shift_row,
               shift_return, diffusion_row, impedance, data->heat);
}

/* ---------------------------------------------------------------------- */

template class SPHDissipation::FluidKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class SPHDissipation::FluidKokkos<LMPHostType>;
#endif
