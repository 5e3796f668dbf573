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
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_integrate.h"
#include "sph_dissipation_loops_kokkos.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_noise.h"
#include "sph_dissipation_noise_kokkos.h"
#include "sph_dissipation_open_kokkos.h"
#include "sph_dissipation_open_stage.h"
#include "sph_dissipation_report.h"
#include "sph_dissipation_shared_stages.h"
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
    Fluid(lmp, pair, spins), space(lmp, pair, *engine, *exchange), on_device(true),
    threads(new ThreadsKokkos), host_list(new NeighList(lmp)), nlocal_device(-1), nghost_device(-1),
    density_device(lmp, space), limit_device(lmp, space), viscosity_device(lmp, space),
    pressure_device(lmp, space), state_device(lmp, space), flows_device(lmp, space),
    diffusion_device(lmp, space), shift_device(lmp, space),
    boundary_device(new BoundaryStageKokkos<DeviceType>(lmp, pair, space, *boundary)),
    viscous_device(lmp, space, *viscous, pressure_device, *boundary_device, *rigid)
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
  if (device != on_device) last_setup = 0;    // the list of LAMMPS is another one, and not built
  on_device = device;
  space.forget_coeffs();
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::request_list()
{
  if (!on_device) return Fluid::request_list();
  own_list = false;
  neighbor->add_request(pair);
}

// A pair style has a list of the host while this object exists, also if an error ends the task

class HostList {
 public:
  HostList(Pair *pair, NeighList *list) :
      pair(pair), before(std::exchange(pair->list, list)),
      space(std::exchange(pair->execution_space, Host))
  {
  }
  ~HostList()
  {
    pair->list = before;
    pair->execution_space = space;
  }

 private:
  Pair *const pair;
  NeighList *const before;
  const ExecutionSpace space;
};

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
  {
    const HostList use(pair, host_list.get());
    task();
  }
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
  auto mine = [&](int i, int j) {
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

template <class DeviceType> void FluidKokkos<DeviceType>::get_from_device(uint64_t fields) const
{
  atomKK->sync(Host, fields);
}

template <class DeviceType> void FluidKokkos<DeviceType>::give_to_device() const
{
  atomKK->modified(Host, ALL_MASK);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> OwnForces FluidKokkos<DeviceType>::forces_for_steps()
{
  return on_device ? viscous_device.own_forces() : Fluid::forces_for_steps();
}

/* ----------------------------------------------------------------------
   Solve for the velocities.  The largest rate follows from the present densities, on the host.  Then mark what has changed:
   at the start of a run, the next sync copies each field that is not marked from the host, and these velocities would be lost.
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::set_velocity(StepData &)
{
  if (neighbor->ago == 0 || viscous->has_old_rates()) {
    atomKK->modified(pair->execution_space, SPH_RHO_MASK);
    atomKK->sync(Host, ENERGY | V_MASK | ESPH_MASK | INERTIA_MASK);
  }
  find_rate();
  viscous_device.run(pair->list, bound_device(), has_symmetric_matrix());
  atomKK->modified(pair->execution_space, space.modified_mask());
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
  const auto from = Kokkos::create_mirror_view_and_copy(LMPHostType(), space.data->heat);
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
  if (stale) space.forget_coeffs();
  Fluid::adopt();
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
void FluidKokkos<DeviceType>::begin_run(double dt, bool continues, const Changes &changes)
{
  space.forget_flows();
  Fluid::begin_run(dt, continues, changes);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::advance_states()
{
  if (!on_device) {
    atomKK->sync(Host, HEAT);
    Fluid::advance_states();
    return atomKK->modified(Host, STATES_MASK);
  }
  space.copy_coeffs();
  atomKK->sync(pair->execution_space, HEAT);
  state_device.advance(not_fluid(), boundary->bits(), nullptr, 0);
  atomKK->modified(pair->execution_space, STATES_MASK);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> bigint FluidKokkos<DeviceType>::compute(PairTally *tally)
{
  if (!on_device) {
    nlocal_device = -1;
    threads->for_each(atom->nlocal + atom->nghost, [&](int i) {
      atom->desph[i] = 0.0;
    });
    const bigint nbeyond = Fluid::compute(tally);
    exchange->reverse({{atom->desph, 1, 1}});    // the atom style does not send them
    if (spins) exchange->reverse({{atom->torque[0], 3, 3}});
    return nbeyond;
  }

  if (update->setupflag)
    atomKK->sync(Host, ALL_MASK);
  else if (neighbor->ago == 0)
    atomKK->sync(Host,
                 RMASS_MASK | TAG_MASK | TYPE_MASK |
                     (log->reads_velocities() ? V_MASK | MASK_MASK : EMPTY_MASK) |
                     (log->reads_densities() ? SPH_RHO_MASK | MASK_MASK : EMPTY_MASK));
  const bigint nbeyond = Fluid::compute(tally);
  atomKK->modified(pair->execution_space, space.modified_mask());

  if (pair->eflag_either) atomKK->sync(Host, ENERGY);
  nlocal_device = atom->nlocal;
  nghost_device = atom->nghost;
  return nbeyond;
}

/* ----------------------------------------------------------------------
   Replace the functions of the stages by those of the device.  On the device, "pairs" adds the repulsion and, unless large
   viscosities keep the forces, also the forces to the arrays of LAMMPS.
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::list_stages()
{
  typedef FluidKokkos<DeviceType> Own;
  const auto call = [this](void (Own::*function)(StepData &)) {
    return [this, function](StepData &step) {
      (this->*function)(step);
    };
  };
  const std::map<std::string, std::function<void(StepData &)>> own = {
      {"densities", call(&Own::sum_density)},
      {"wall volumes", call(&Own::set_reference_volume)},
      {"bound",
       [this](StepData &) {
         limit_device.run();
       }},
      {"shear rates", call(&Own::set_viscosities)},
      {"pressures",
       [this](StepData &step) {
         step.nbeyond = pressure_device.run(bound_device(), boundary->bits());
       }},
      {"zones", call(&Own::set_zones)},
      {"ledger", call(&Own::sum_impacts)},
      {"kept viscosities",
       [this](StepData &) {
         viscosity_device.keep();
       }},
      {"guess",
       [this](StepData &step) {
         space.prepare();
         viscous_device.begin(step.not_fluid);
         atomKK->modified(pair->execution_space, space.modified_mask());
       }},
      {"velocities", call(&Own::set_velocity)},
      {"forces",
       [this](StepData &) {
         space.add_forces();
       }},
      {"walls",
       [this](StepData &) {
         boundary_device->run();
       }},
      {"numbers",
       [this](StepData &) {
         noise->begin_step(boundary->bits());
       }},
      {"noise", call(&Own::set_noise)},
      {"pairs", call(&Own::sum_forces)},
      {"wall friction", call(&Own::add_wall_friction)},
      {"tension", call(&Own::sum_tension)},
      {"flows", call(&Own::sum_flows)},
      {"diffusion", call(&Own::evaluate_diffusion)},
      {"diffusion heat", [this](StepData &step) {
         diffusion_device.add_heat(step.not_fluid, integrated);
       }}};
  Fluid::list_stages();
  if (!on_device) return;
  const bool keeps = viscous->active();
  space.keep_forces(keeps);
  stages.erase(std::remove_if(stages.begin(), stages.end(),
                              [keeps](const ListedStage &one) {
                                return (!strcmp(one.name, "forces") && (one.trial || !keeps)) ||
                                    !strcmp(one.name, "repulsion") || !strcmp(one.name, "totals");
                              }),
               stages.end());
  for (ListedStage &one : stages) one.run = own.at(one.name);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::sum_density(StepData &step)
{
  space.begin(step.not_fluid);
  density_device.run(nullptr, nullptr, nullptr, at_rest(), 0.0, step.not_fluid, true);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::set_reference_volume(StepData &)
{
  const ParticleRows rows = *space.data;
  const int bits = boundary->bits();
  space.for_each(
      "sph:reference", atom->nlocal + atom->nghost,
      KOKKOS_LAMBDA(int i) { rows.set_reference_volume(i, bits); });
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> const double *FluidKokkos<DeviceType>::bound_device() const
{
  return (model->choice.limit != Limit::NO) ? limit_device.bound.data() : nullptr;
}

/* ----------------------------------------------------------------------
   Find the viscosities.  The rates of shear are with the velocities of walls in the pair forces, as in
   Fluid::find_viscosities().
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::set_viscosities(StepData &step)
{
  if (boundary->empty()) return viscosity_device.run(boundary->bits());
  const ParticleRows rows = space.rows();
  const int nall = atom->nlocal + atom->nghost, bits = boundary->bits();
  space.for_each(
      "sph:no_pressure", nall,
      KOKKOS_LAMBDA(int i) { rows.particle[i].g = rows.zeta_term[i] = 0.0; });
  boundary_device->run();
  viscosity_device.run(boundary->bits());
  const VectorField vest = space.vest();
  space.for_each(
      "sph:no_slip", nall, KOKKOS_LAMBDA(int i) {
        if (!(rows.mask[i] & bits)) return;
        for (int d = 0; d < 3; d++) rows.particle[i].u[d] = vest.at(i, d);
      });
  set_reference_volume(step);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::shift_particles(double keep)
{
  constexpr uint64_t CHANGED = X_MASK | V_MASK | VEST_MASK | ESPH_MASK;
  const auto where = on_device ? pair->execution_space : Host;
  atomKK->sync(where, CHANGED | MASK_MASK | RMASS_MASK);
  if (on_device) {
    shift_device.movers = shift->movers;
    shift_device.run(keep);
  } else
    Fluid::shift_particles(keep);
  atomKK->modified(where, CHANGED);
}

/* ----------------------------------------------------------------------
   Add the random pressure; set the noise of pass 2.
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::set_noise(StepData &step)
{
  noise_factor = noise->prepare(step.not_fluid);
  const bool any = noise->set_coeffs(noise_factor);
  const NoiseData &numbers = noise->numbers_of_pairs();
  const auto &coeff = noise->coefficients();
  if (noise_coeff.extent(0) != coeff.size())
    renew(noise_coeff, "sph:noise_coeff", static_cast<int>(coeff.size()));
  Kokkos::deep_copy(noise_coeff,
                    Kokkos::View<const NoiseCoeff *, LMPHostType, Kokkos::MemoryUnmanaged>(
                        coeff.data(), coeff.size()));
  if (any) step.noise.pairs = {noise->form_of_pairs(), &numbers};
  space.for_each("sph:random_pressure", atom->nlocal + atom->nghost,
                 on_device::RandomPressureKokkos{
                     space.rows(), on_device::NoiseStep(numbers),
                     on_device::NoiseStep::keys_of(numbers, NoiseChannel::PRESSURE), noise_factor,
                     atomKK->k_tag.template view<DeviceType>().data(), boundary->bits()});
}

/* ----------------------------------------------------------------------
   Add random forces and torques of n rows of pairs.
------------------------------------------------------------------------- */

template <class DeviceType>
template <class K, class Form, class Pairs>
void FluidKokkos<DeviceType>::run_noise(const StepData &step, int n, const Pairs &pairs)
{
  const NoiseData &numbers = noise->numbers_of_pairs();
  const tagint *const tag = atomKK->k_tag.template view<DeviceType>().data();
  const on_device::NoiseStep now(numbers);
  const auto run = [&](auto across) {
    space.run_loop("sph:noise", n,
                   on_device::NoiseLoopKokkos<DeviceType, K, decltype(across)::value, Form::SPINS,
                                              Form::BY_SQUARE, Form::BY_DISTANCE, Pairs>{
                       *space.data, pairs, now, noise_coeff.data(), tag},
                   step.tally);
  };
  if constexpr (Form::VECTOR && !Form::BY_RATE) {
    if (model->constants().dim == 3)
      run(std::integral_constant<int, 3>());
    else
      run(std::integral_constant<int, 2>());
  } else if constexpr (Form::CENTRAL && !Form::BY_RATE)
    run(std::integral_constant<int, 0>());
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::sum_forces(StepData &step)
{
  const int n = pair->list->inum;
  space.sum_forces(step.tally);
  with_kernel(model->choice.kernel, [&](auto kernel) {
    typedef decltype(kernel) K;
    if (step.noise.pairs.data)
      with_form(space.data->par.terms(), [&](auto form) {
        run_noise<K, decltype(form)>(step, n, on_device::AllPairsKokkos<DeviceType>());
      });
    if (!boundary->empty() && boundary_device->particles().occupied.extent(0))
      space.run_loop("sph:repulsion", boundary_device->particles().size(),
                     RepulsionKokkos<DeviceType, K>{*space.data, boundary_device->particles(),
                                                    boundary->thermal_stiffness()},
                     step.tally);
  });
  if (model->choice.thermal && space.data->par.drag) {
    const NoiseData &numbers = noise->numbers_of_pairs();
    space.for_each("sph:random_drag", atom->nlocal,
                   on_device::RandomDragKokkos<DeviceType>{
                       *space.data, on_device::NoiseStep(numbers),
                       on_device::NoiseStep::keys_of(numbers, NoiseChannel::DRAG), noise_factor,
                       atomKK->k_tag.template view<DeviceType>().data()});
  }
}

/* ----------------------------------------------------------------------
   Set the states of the zones on the host, for which the particles near the zones are copied.
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::set_zones(StepData &)
{
  const auto &zones = open->all();
  if (std::any_of(zones.begin(), zones.end(), [](const OpenZone *one) {
        return one->zone_varies();
      })) {    // variables may read any particle
    atomKK->modified(pair->execution_space, space.modified_mask());
    atomKK->sync(Host, ALL_MASK);
  } else if (neighbor->ago == 0)    // the fix checks all particles
    atomKK->sync(Host, X_MASK | V_MASK | MASK_MASK | RMASS_MASK);
  if (neighbor->ago == 0) {
    zone_particles.clear();
    for (const OpenZone *const one : zones)
      zone_particles.insert(zone_particles.end(), one->zone_particles().begin(),
                            one->zone_particles().end());
    std::sort(zone_particles.begin(), zone_particles.end());
    zone_particles.erase(std::unique(zone_particles.begin(), zone_particles.end()),
                         zone_particles.end());
  }

  constexpr uint64_t MOVED = X_MASK | V_MASK | DESPH_BEFORE_MASK;    // no forces need v
  constexpr uint64_t FIELDS = MOVED | SPH_RHO_MASK | DRHO_MASK | VFRAC_MASK | ESPH_MASK;
  atomKK->sync(pair->execution_space, MOVED);
  const auto &avec = AtomVecSPHBulkKokkos::of(atom);
  engine->prepare_rows(zone_particles);
  const ParticleRows &there = space.rows(), &here = engine->rows();
  near_zones.set(zone_particles);
  near_zones.there = avec.columns(FIELDS, Device);
  near_zones.here = avec.columns(FIELDS, Host);
  near_zones.add(there.particle->x, here.particle->x, sizeof(Particle) / sizeof(double));
  near_zones.add(there.zeta_term, here.zeta_term);
  if (there.par.states) near_zones.add(there.state_pressure, here.state_pressure);
  for (int k = 0; k < Flows::NUMBER; k++)
    if (there.par.flows >> k & 1)
      near_zones.add(&there.flow[k]->vol, &here.flow[k]->vol, sizeof(FlowRow) / sizeof(double));
  near_zones.get();
  open->set_states();
  near_zones.put();
  set_ghosts_of_zones();
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::set_ghosts_of_zones()
{
  const ParticleRows rows = space.rows();
  const OpenGroups groups = open->groups();
  double *const zone = reach(zone_of, "sph:zone_of", atom->nmax);
  int *const mask = atomKK->k_mask.template view<DeviceType>().data();
  const int nlocal = atom->nlocal;
  space.for_each(
      "sph:zone_of", nlocal, KOKKOS_LAMBDA(int i) { zone[i] = groups.zone_of(mask[i]); });
  space.forward({field(rows.particle, &rows.particle->vol, 2), {zone, 1, 1}});
  for (int k = 0; k < Flows::NUMBER; k++)
    if (rows.par.flows >> k & 1) space.forward({field(rows.flow[k], &rows.flow[k]->vol, 3)});
  space.for_each(
      "sph:ghosts_of_zones", atom->nghost, KOKKOS_LAMBDA(int k) {
        const int i = nlocal + k;
        mask[i] = groups.mask_in(zone[i], mask[i]);
        if (!(zone[i] > 0.0)) return;
        rows.vfrac[i] = rows.particle[i].vol;
        rows.rho[i] = rows.rmass[i] / rows.vfrac[i];
      });
  atomKK->modified(pair->execution_space, MASK_MASK);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::sum_impacts(StepData &)
{
  with_form(space.data->par.terms(), [&](auto form) {
    run_impacts<decltype(form)>();
  });
}

template <class DeviceType> template <class Form> void FluidKokkos<DeviceType>::run_impacts()
{
  for (std::size_t k = 0; k < open->all().size(); k++) {
    EV_FLOAT sum;
    Kokkos::parallel_reduce("sph:impact", Kokkos::RangePolicy<DeviceType>(0, near_zones.size()),
                            ZoneImpactKokkos<DeviceType, Form>{*space.data, near_zones.list,
                                                               zone_of.data(), k + 1.0,
                                                               model->constants().conducts()},
                            sum);
    OpenImpact impact;
    std::copy_n(sum.v, 3, impact.force);
    std::copy_n(sum.v + 3, 3, impact.torque);
    impact.power = sum.evdwl;
    open->all()[k]->set_impact(impact);
  }
}

/* ----------------------------------------------------------------------
   Add the symmetric friction of boundaries and its noise; there are no viscosities by rate.
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::add_wall_friction(StepData &step)
{
  with_kernel(model->choice.kernel, [&](auto kernel) {
    with_form(space.data->par.terms(), [&](auto form) {
      run_wall_friction<decltype(kernel), decltype(form)>(step);
    });
  });
}

template <class DeviceType>
template <class K, class Form>
void FluidKokkos<DeviceType>::run_wall_friction(const StepData &step)
{
  const SurfacePairsKokkos<DeviceType> pairs = {boundary_device->particles()};
  const int n = pairs.boundary.size();
  if constexpr (!Form::BY_RATE && (Form::CENTRAL || Form::VECTOR))
    space.run_loop("sph:wall_friction", n,
                   SurfaceFrictionKokkos<DeviceType, K, Form>{*space.data, pairs}, step.tally);
  if (step.noise.pairs.data) run_noise<K, Form>(step, n, pairs);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::sum_flows(StepData &)
{
  flows_device.run([this]() {
    if (boundary->conducts())
      boundary_device->add_surface_heat(*space.data, space.flow_rate(HEAT_FLOW));
  });
}

/* ----------------------------------------------------------------------
   Add the forces of the energies of pairs.
------------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::sum_tension(StepData &step)
{
  const Constants &par = model->constants();
  const auto first = [](const auto &array) {
    return array.size() ? array.data() : nullptr;
  };
  double *const energy = reach(tension, "sph:tension", atom->nmax);
  space.run_loop("sph:tension", pair->list->inum,
                 TensionLoopKokkos<DeviceType>{*space.data, first(space.pair_energy),
                                               first(space.cohesion),
                                               PairEnergyKernel(par.dim, par.support),
                                               CohesionKernel(par.dim, par.support), energy},
                 step.tally);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> void FluidKokkos<DeviceType>::evaluate_diffusion(StepData &step)
{
  if (!diffusion_is_due()) return;
  diffusion_device.set_rows(step.not_fluid, integrated);
  const int dim = model->constants().dim;
  with_kernel(model->choice.kernel, [&](auto kernel) {
    typedef decltype(kernel) K;
    if (dim == 3)
      run_diffusion<K, 3>();
    else if (dim == 2)
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
  const Parameters &par = engine->parameters();
  const ParticleRows &particles = space.rows();
  const double shared = par.impedes_alike ? par.type[1].eos.impedance() : 1.0;
  const DiffusionRowsKokkos rows = {diffusion_device.rows.data(),
                                    diffusion_device.impedances.data(),
                                    par.delta * par.support / shared,
                                    particles.vol_rate,
                                    particles.vol_heat,
                                    particles.vol_support};
  const int n = pair->list->inum;
  space.for_each("sph:gradient", n, GradientLoopKokkos<DeviceType, K, DIM>{*space.data, rows});
  space.forward({field(rows.row, rows.row->a + DiffusionPlaces<DIM>::G, DIM)});
  space.for_each("sph:diffusion", n, DiffusionLoopKokkos<DeviceType, K, DIM>{*space.data, rows});
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> double FluidKokkos<DeviceType>::wall_energy(double *each_atom) const
{
  if (!on_device) return Fluid::wall_energy(each_atom);
  double total = boundary->energy_of_bodies(each_atom);
  const auto energy =
      Kokkos::create_mirror_view_and_copy(LMPHostType(), boundary_device->particles().energy);
  for (int i = 0; i < static_cast<int>(energy.extent(0)); i++) {
    total += energy(i);
    if (each_atom) each_atom[i] += energy(i);
  }
  return total;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> double FluidKokkos<DeviceType>::received_heat(int groupbit) const
{
  if (on_device)
    return (boundary->conducts() && pair->compute_flag) ? flows_device.received(groupbit) : 0.0;
  if (model->choice.own_temperatures) atomKK->sync(Host, DESPH_MASK | MASK_MASK);
  return Fluid::received_heat(groupbit);
}

/* ---------------------------------------------------------------------- */

template <class DeviceType>
double FluidKokkos<DeviceType>::tension_energy(double *each_atom, int groupbit) const
{
  if (!on_device) return Fluid::tension_energy(each_atom, groupbit);
  atomKK->sync(Host, MASK_MASK);
  const auto energy = Kokkos::create_mirror_view_and_copy(LMPHostType(), tension);
  double total = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    total += energy(i);
    if (each_atom) each_atom[i] += energy(i);
  }
  return total;
}

/* ---------------------------------------------------------------------- */

template <class DeviceType> double FluidKokkos<DeviceType>::memory_usage() const
{
  return Fluid::memory_usage() + space.memory_usage() + boundary_device->memory_usage() +
      limit_device.memory_usage() + viscous_device.memory_usage() + shift_device.memory_usage() +
      diffusion_device.memory_usage() + bytes_of(tension, zone_of) + near_zones.memory_usage();
}

/* ---------------------------------------------------------------------- */

template class SPHDissipation::FluidKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class SPHDissipation::FluidKokkos<LMPHostType>;
#endif
