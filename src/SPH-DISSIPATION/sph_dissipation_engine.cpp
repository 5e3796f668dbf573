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

#include "sph_dissipation_engine.h"

#include "atom.h"
#include "math_extra.h"
#include "memory.h"
#include "neigh_list.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_noise_data.h"
#include "sph_dissipation_particle_terms.h"
#include "update.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

#ifdef __linux__
#include <sys/mman.h>
#endif

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

static const Parameters NO_PARAMETERS;    // of an engine before setup()

Engine::Engine(LAMMPS *lmp) :
    Pointers(lmp), flow(Flows::NUMBER), flow_rate(Flows::NUMBER), par(&NO_PARAMETERS),
    fixed(&NO_PARAMETERS), atom_rows(new ParticleRows())
{
  choose_loops("auto");
}

/* ---------------------------------------------------------------------- */

Engine::~Engine()
{
  memory->sfree(particle);
  memory->sfree(density);
  memory->sfree(force);
  memory->sfree(spin);
  memory->sfree(zeta_term);
  memory->sfree(state_pressure);
  memory->sfree(divergence);
  memory->destroy(weights);
  memory->sfree(data.first);
  memory->sfree(data.count);
  memory->sfree(data.neighbor);
  memory->sfree(slopes);
}

/* ---------------------------------------------------------------------- */

bool Engine::choose_loops(const std::string &simd)
{
  std::vector<std::pair<std::string, const LoopSet *>> available;    // the best one first
#ifdef SPH_DISSIPATION_DISPATCH
  __builtin_cpu_init();
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  if (avx512) available.emplace_back("avx512", &loops_avx512);
  if (avx2) available.emplace_back("avx2", &loops_avx2);
#endif
  available.emplace_back("none", &loops_plain);

  for (const auto &entry : available)
    if (simd == "auto" || simd == entry.first) {
      loops = entry.second;
      return true;
    }
  return false;
}

/* ---------------------------------------------------------------------- */

void Engine::setup(const Parameters &parameters)
{
  par = &parameters;
  fixed = &parameters;
  rate_loop = loops->rates(par->volume);
  const Terms terms = (par->inviscid && !par->spins()) ? Terms{Shear::NONE, false, false, false}
                                                       : par->terms();
  force_loop = loops->forces(terms, par->bulk, par->volume);
  side.set({par->spins(), loops->channels(terms)});
  data.par = par;
}

/* ----------------------------------------------------------------------
   Allocate a long array, on Linux in large pages; old contents are lost.  Pairs access rows all over the arrays: with fewer
   addresses to translate, a step takes 3 percent less time (64,000 particles).
------------------------------------------------------------------------- */

template <class T> static void renew(Memory *memory, T *&array, bigint n, const char *name)
{
  memory->sfree(array);
  const auto length = static_cast<std::size_t>(n) * sizeof(T);
  array = (T *) memory->smalloc(length, name);
#ifdef MADV_HUGEPAGE
  constexpr std::uintptr_t PAGE = 1 << 21;
  const auto begin = reinterpret_cast<std::uintptr_t>(array);
  const std::uintptr_t first = (begin + PAGE - 1) / PAGE * PAGE,
                       end = (begin + length) / PAGE * PAGE;
  if (end > first) madvise(reinterpret_cast<void *>(first), end - first, MADV_HUGEPAGE);
#endif
}

/* ---------------------------------------------------------------------- */

void Engine::grow_atoms()
{
  if (nmax >= atom->nmax) return;
  nmax = atom->nmax;
  const bigint nrow = (bigint) nmax + BLOCK;    // with the spare ones
  renew(memory, particle, nrow, "sph:particle");
  renew(memory, density, nrow, "sph:density");
  renew(memory, force, nrow, "sph:force");
  if (has_spin()) renew(memory, spin, nrow, "sph:spin");
  renew(memory, state_pressure, nrow, "sph:state_pressure");
  renew(memory, zeta_term, nrow, "sph:zeta_term");
  renew(memory, divergence, nrow, "sph:divergence");
}

/* ----------------------------------------------------------------------
   Give each thread rows with about equally many entries of the neighbor list.  Allocate room for all pairs, with rows filled
   up to full blocks, and, for each thread, for one more block and for the indices that pass 2 reads ahead.
------------------------------------------------------------------------- */

void Engine::grow_pairs(NeighList *list, bool leaves_slopes)
{
  constexpr int PARTS = 256;    // per thread, of the rows; a thread gets whole parts
  if (list->inum > imax) {
    imax = list->inum;
    renew(memory, data.first, imax, "sph:first");
    renew(memory, data.count, imax, "sph:count");
  }

  auto room = [=](int ii) {
    return (list->numneigh[list->ilist[ii]] + BLOCK - 1) / BLOCK * BLOCK;
  };
  const int nthread = threads->size();
  const int npart = (nthread == 1) ? 1 : PARTS * nthread;
  std::vector<int> begin(npart + 1);
  std::vector<bigint> pairs_of(npart, 0);
  for (int p = 0; p <= npart; p++)
    begin[p] = static_cast<int>(static_cast<bigint>(list->inum) * p / npart);
  threads->for_each(npart, [&](int p) {
    for (int ii = begin[p]; ii < begin[p + 1]; ii++) pairs_of[p] += room(ii);
  });
  bigint npair = std::accumulate(pairs_of.begin(), pairs_of.end(), bigint(0));

  first_row.assign(nthread + 1, list->inum);
  first_pair.assign(nthread, 0);
  first_row[0] = 0;
  bigint end = 0;
  for (int k = 1, p = 0; k < nthread; k++) {
    for (; p < npart && end < npair * k / nthread; p++) end += pairs_of[p];
    first_row[k] = begin[p];
    first_pair[k] = end + k * 3 * BLOCK;
  }

  npair += nthread * 3 * BLOCK;
  if (npair > pair_max) {
    pair_max = npair + npair / 16;
    renew(memory, data.neighbor, pair_max, "sph:neighbor");
  }
  if (leaves_slopes && slope_max < pair_max) {
    slope_max = pair_max;
    renew(memory, slopes, slope_max, "sph:slope");
  }
  data.slope = leaves_slopes ? slopes : nullptr;
}

/* ----------------------------------------------------------------------
   Return the input of the loops of one thread, without its own sums.
------------------------------------------------------------------------- */

LoopData Engine::part(int thread) const
{
  LoopData part = data;
  const int from = first_row[thread];
  part.inum = first_row[thread + 1] - from;
  part.begin = first_pair[thread];
  part.ilist += from;
  part.first += from;
  part.count += from;
  return part;
}

/* ---------------------------------------------------------------------- */

void Engine::grow_flows()
{
  for (int k = 0; k < Flows::NUMBER; k++) {
    if (!(par->flows >> k & 1)) continue;
    flow[k].resize(nmax + BLOCK);
    std::fill_n(flow[k].begin() + atom->nlocal + atom->nghost, BLOCK, FlowRow());
  }
}

/* ---------------------------------------------------------------------- */

void Engine::prepare_rows(const std::vector<int> &some)
{
  grow_atoms();
  grow_flows();
  set_rows();
  if (par->volume != Volume::MASS) return;    // otherwise, set_rows() has set all weights to 1
  grow_weights();
  for (const int i : some) weights[i] = atom_rows->reference_volume(i);
}

/* ----------------------------------------------------------------------
   Set the rows of atoms between the passes; with temp energy, the rows have a copy of the internal energies.
------------------------------------------------------------------------- */

void Engine::set_rows()
{
  static constexpr double ONE = 1.0;
  double *energies = atom->esph;
  StateRows with_states = states();
  if (par->own_temperatures) {
    energy.assign(atom->esph, atom->esph + atom->nlocal + atom->nghost);
    with_states.esph = energies = energy.data();
  }
  *atom_rows = {
      *par,        par->type.data(), atom->nlocal, particle,      density,  zeta_term, &ONE,
      0,           atom->type,       atom->mask,   atom->rmass,   energies, atom->rho, atom->drho,
      atom->vfrac, atom->desph,      with_states,  state_pressure};
  for (int k = 0; k < Flows::NUMBER; k++) atom_rows->flow[k] = flow[k].data();
  const Fields &fields = *Fields::of(atom);
  atom_rows->rho_sum = fields.rho_sum;
  atom_rows->shear_rate = fields.shear_rate;
  atom_rows->shear_mu = fields.shear_mu;
  atom_rows->vol_rate = fields.vol_rate;
  atom_rows->vol_heat = fields.vol_heat;
  atom_rows->vol_support = fields.vol_support;
  atom_rows->viscosity = viscosity.data();
  atom_rows->pair = par->pair.data();
  atom_rows->body_bits = body_bits;
  atom_rows->keeps_bodies = keeps_bodies;
}

/* ---------------------------------------------------------------------- */

StateRows Engine::states() const
{
  StateRows rows = {par->type.data(), atom->type, atom->rmass, atom->rho, atom->drho,
                    par->eos,         atom->esph, atom->desph, {}};
  std::copy_n(Fields::of(atom)->state, States::MOST, rows.state);
  for (int k = 0; k < Flows::NUMBER; k++)
    if ((par->flows >> k & 1) && flow_rate[k].size() >= static_cast<std::size_t>(atom->nlocal))
      rows.rate[k] = flow_rate[k].data();
  rows.shear_rate = Fields::of(atom)->shear_rate;
  if (!wall_energy.empty()) {
    follow_atoms();
    rows.by_walls = wall_energy.data();
  }
  return rows;
}

/* ---------------------------------------------------------------------- */

void Engine::set_wall_energy(const double *energies)
{
  wall_energy.assign(energies, energies + atom->nlocal);
  wall_energy_tags.assign(atom->tag, atom->tag + atom->nlocal);
  atom_rows->states.by_walls = wall_energy.data();
}

void Engine::forget_wall_energy()
{
  wall_energy.clear();
  atom_rows->states.by_walls = nullptr;
}

/* ----------------------------------------------------------------------
   Sort the energies of the walls into the present order of the atoms; new atoms get 0.
------------------------------------------------------------------------- */

void Engine::follow_atoms() const
{
  const tagint *const tag = atom->tag;
  const std::vector<tagint> &known = wall_energy_tags;
  const std::size_t n = atom->nlocal;
  if (known.size() == n && std::equal(known.begin(), known.end(), tag)) return;
  std::map<tagint, double> energy_of;
  for (std::size_t k = 0; k < known.size(); k++) energy_of[known[k]] = wall_energy[k];
  wall_energy.assign(n, 0.0);
  for (std::size_t i = 0; i < n; i++) {
    const auto found = energy_of.find(tag[i]);
    if (found != energy_of.end()) wall_energy[i] = found->second;
  }
  wall_energy_tags.assign(tag, tag + n);
}

/* ----------------------------------------------------------------------
   Set the reference volumes of owned and ghost atoms, and multiply the term of the particle itself in each density by these
   volumes.
------------------------------------------------------------------------- */

void Engine::set_weights()
{
  const bool by_mass = (par->volume == Volume::MASS);
  if (!by_mass && par->bulk != Bulk::VOLUME && !par->thermal) {
    data.weight = nullptr;
    return;
  }
  grow_weights();
  const int nall = atom->nlocal + atom->nghost;
  for_each(nall, [&](int i) {
    weights[i] = by_mass ? atom_rows->reference_volume(i) : 1.0;
    density[i].c *= weights[i];
  });
  std::fill_n(weights + nall, BLOCK, 0.0);
  data.weight = weights;
}

void Engine::grow_weights()
{
  if (nmax_weights < nmax) {
    nmax_weights = nmax;
    memory->destroy(weights);
    memory->create(weights, nmax + BLOCK, "sph:weight");
  }
  atom_rows->weight = weights;
  atom_rows->each = 1;
}

/* ---------------------------------------------------------------------- */

void Engine::accumulate_density(NeighList *list, double **vest, double **omegaest, bool slopes_read)
{
  const bool leaves_slopes = slopes_read || par->spins() || !loops->computes_slopes;
  grow_atoms();
  grow_pairs(list, leaves_slopes);

  constexpr double FAR = 1.0e15;    // place of spare particles, in support radii
  static constexpr double REST[3] = {0.0, 0.0, 0.0};
  double **x = atom->x;
  const int nlocal = atom->nlocal;
  const int nall = nlocal + atom->nghost;

  for_each(nall, [&](int i) {
    const double *const u = vest ? vest[i] : REST;
    for (int d = 0; d < 3; d++) {
      particle[i].x[d] = x[i][d];
      particle[i].u[d] = u[d];
    }
    density[i].c = (i < nlocal) ? par->self_weight : 0.0;
    density[i].cdot = 0.0;
  });

  if (has_spin())
    for_each(nall, [&](int i) {
      const double *const w = omegaest ? omegaest[i] : REST;
      for (int d = 0; d < 3; d++) spin[i].w[d] = w[d];
    });

  for (int i = nall; i < nall + BLOCK; i++) {
    particle[i] = Particle();
    particle[i].x[0] = FAR * par->support;
    density[i] = DensitySum();
    zeta_term[i] = 0.0;
    if (has_spin()) spin[i] = Spin();
  }

  grow_flows();
  if (par->by_rate) {
    viscosity.resize(nmax + BLOCK);
    std::fill_n(viscosity.begin() + nall, BLOCK, 0.0);
  }
  if (!par->own_temperatures) forget_wall_energy();
  set_rows();
  keeps_bodies = false;
  set_weights();

  data.inum = list->inum;
  data.ilist = list->ilist;
  data.numneigh = list->numneigh;
  data.firstneigh = list->firstneigh;
  data.type = atom->type;
  if (!par->uniform) {    // spare particles have a type, too
    types.assign(atom->type, atom->type + nall);
    types.resize(nall + BLOCK, 1);
    data.type = types.data();
  }
  data.particle = particle;
  data.spin = spin;
  data.zeta_term = zeta_term;
  data.spare = nall;
  data.density = density;
  if (par->by_rate) square.resize(pair_max);
  data.square = square.data();
  run_density(loops->density(par->kernel, par->volume, leaves_slopes, par->by_rate));
}

/* ---------------------------------------------------------------------- */

void Engine::accumulate_rates()
{
  const int nrow = atom->nlocal + atom->nghost + BLOCK;
  for_each(nrow, [&](int i) {
    density[i].cdot = 0.0;
  });
  run_density(rate_loop);
}

/* ---------------------------------------------------------------------- */

double Engine::slope_of(int i, int j) const
{
  const double r = sqrt(MathExtra::distsq3(particle[i].x, particle[j].x));
  return kernel_slope(par->kernel, par->dim, r, par->support);
}

/* ----------------------------------------------------------------------
   Run a loop that adds to density[] on all threads.
------------------------------------------------------------------------- */

void Engine::run_density(Loop loop)
{
  const int nall = atom->nlocal + atom->nghost;
  density_sums.begin(*threads);
  threads->run([&](int k) {
    LoopData own = part(k);
    if (k > 0) own.density = density_sums.zeroed(k, nullptr, nall + BLOCK);
    loop(own);
  });
  density_sums.add_up(*threads, density, nall);
}

/* ---------------------------------------------------------------------- */

void Engine::accumulate_shear_rates(std::vector<double> &rates)
{
  const int nrow = atom->nlocal + atom->nghost + BLOCK;
  rates.assign(nrow, 0.0);
  volume.resize(nrow);
  for_each(nrow, [&](int i) {
    volume[i] = particle[i].vol;
  });
  scalar_sums.run(*threads, rates.data(), rates.size(), [&](int k, double *sum) {
    loops->shear_rates(part(k), volume.data(), sum);
  });
}

void Engine::set_square(int i, int j, bigint entry)
{
  const Particle &a = particle[i], &b = particle[j];
  double approach = 0.0, rsq = 0.0;
  for (int d = 0; d < 3; d++) {
    const double r = a.x[d] - b.x[d];
    rsq += r * r;
    approach += r * (a.u[d] - b.u[d]);
  }
  const double metric = (par->shear == Shear::MG_FR2) ? 1.0 : rsq;
  if (rsq > 0.0) square[entry] = slope(i, j, entry) * approach * (approach / metric);
}

/* ---------------------------------------------------------------------- */

void Engine::accumulate_flow(int place, std::vector<double> &rate)
{
  const int nall = atom->nlocal + atom->nghost;
  const FlowLoop loop = loops->flow(par->flows_alike >> place & 1);
  rate.assign(nall + BLOCK, 0.0);
  scalar_sums.run(*threads, rate.data(), rate.size(), [&](int k, double *sum) {
    loop(part(k), flow[place].data(), sum);
  });
}

/* ---------------------------------------------------------------------- */

void Engine::accumulate_diffusion(DiffusionPart part_of, const DiffusionData &diffusion, int width,
                                  std::vector<SumBlock> &sums)
{
  constexpr std::size_t EACH = sizeof(SumBlock) / sizeof(double);
  const DiffusionLoop loop = loops->diffusion(part_of, par->dim, par->impedes_alike);
  const auto n = static_cast<std::size_t>(atom->nlocal + atom->nghost + BLOCK) * width;
  sums.assign((n + EACH - 1) / EACH, SumBlock());
  scalar_sums.run(*threads, sums[0].a, n, [&](int k, double *sum) {
    loop(part(k), diffusion, sum);
  });
}

/* ---------------------------------------------------------------------- */

void Engine::accumulate_numbers(const NoiseForm &form, const NoiseData &noise)
{
  run_noise(loops->noise_sums(form), noise);
}

void Engine::accumulate_work(const NoiseForm &form, const NoiseData &noise)
{
  run_noise(loops->shared_work(form), noise);
}

void Engine::run_noise(NoiseLoop loop, const NoiseData &noise)
{
  const std::size_t nrow = atom->nlocal + atom->nghost + BLOCK;
  scalar_sums.run(*threads, noise.total, nrow, [&](int k, double *sum) {
    NoiseData own = noise;
    own.total = sum;
    loop(part(k), own);
  });
}

/* ----------------------------------------------------------------------
   Draw random numbers in whole blocks, each block on one thread.
------------------------------------------------------------------------- */

void Engine::draw_numbers(const NoiseData &noise, NoiseChannel channel, int n, int count,
                          double *numbers)
{
  threads->in_parts((n + BLOCK - 1) / BLOCK, [&](int, int from, int to) {
    loops->particle_numbers(noise, channel, from * BLOCK, std::min(to * BLOCK, n), n, count,
                            numbers);
  });
}

/* ----------------------------------------------------------------------
   Return room for the random numbers of the pairs of one particle, for the rows of a thread.
------------------------------------------------------------------------- */

double *Engine::room_for_numbers(int thread, const LoopData &rows)
{
  const int most = rows.inum ? *std::max_element(rows.count, rows.count + rows.inum) : 0;
  const std::size_t room = static_cast<std::size_t>(MOST_NUMBERS) * (most + BLOCK);
  if (random[thread].size() < room) random[thread].resize(room);
  return random[thread].data();
}

/* ---------------------------------------------------------------------- */

void Engine::accumulate_forces(NeighList *list, const StepData &step)
{
  run_forces(list, step, false);
  nlocal_forces = atom->nlocal;
  nghost_forces = atom->nghost;
}

/* ---------------------------------------------------------------------- */

void Engine::accumulate_friction(NeighList *list, int not_fluid)
{
  run_forces(list, {not_fluid}, true);
}

/* ---------------------------------------------------------------------- */

void Engine::run_forces(NeighList *list, const StepData &step, bool linear)
{
  const StepNoise &noise = step.noise;
  const bool by_volume = (par->bulk == Bulk::VOLUME), noisy = noise.pairs.data;
  const Loop loop = noisy ? loops->noisy_forces(noise.pairs.form) : force_loop;
  const int nall = atom->nlocal + atom->nghost;
  const std::size_t nrow = (std::size_t) nall + BLOCK;
  data.inum = list->inum;
  data.viscosity = viscosity.data();
  data.excess = (linear || excess.empty()) ? nullptr : excess.data();
  data.random = nullptr;
  data.cohesion = linear ? CohesionData() : cohesion();
  data.tally = step.tally;
  data.noise = noise.pairs.data;
  force_sums.begin(*threads);
  scalar_sums.begin(*threads);
  side_sums.begin(*threads);
  side.resize((std::size_t) nmax + BLOCK);
  const int width = side.width;
  random.resize(threads->size());

  auto work = [&](int k, LoopData own) {
    own.force = force_sums.zeroed(k, force, nrow);
    if (by_volume) own.divergence = scalar_sums.zeroed(k, divergence, nrow);
    if (width) own.side = side_sums.zeroed(k, side.rows.data(), nrow * width);
    if (noisy) own.random = room_for_numbers(k, own);
    loop(own);
  };
  if (data.tally)
    work(0, data);
  else {
    threads->run([&](int k) {
      work(k, part(k));
    });
    force_sums.add_up(*threads, force, nall);
    if (by_volume) scalar_sums.add_up(*threads, divergence, nall);
    if (width) side_sums.add_up(*threads, side.rows.data(), nall * width);
  }
  if (!par->drag) return;
  for_each(atom->nlocal, [&](int i) {
    double heat[NCHANNEL] = {};
    add_drag(i, step.not_fluid, linear, force[i].f, heat);
    if (noise.drag)
      for (int d = 0; d < 3; d++) force[i].f[d] += noise.drag[3 * i + d];
  });
}

/* ---------------------------------------------------------------------- */

CohesionData Engine::cohesion()
{
  if (par->cohesion.empty()) return {};
  const int nall = atom->nlocal + atom->nghost;
  strength.assign((std::size_t) nall + BLOCK, 0.0);
  for_each(nall, [&](int i) {
    const int type = atom->type[i];
    if (par->type[type].other) return;
    strength[i] = sqrt(par->cohesion[type * (par->ntypes_1 + 1)]) * rows().reference_volume(i);
  });
  const CohesionKernel kernel(par->dim, par->support);
  CohesionData result = {strength.data(), {}, {}};
  std::copy_n(kernel.support_inv, 2, result.support_inv);
  std::copy_n(kernel.slope_norm, 2, result.slope_norm);
  return result;
}

/* ---------------------------------------------------------------------- */

void Engine::add_drag(int i, int not_fluid, bool linear, double *force_of, double *heat) const
{
  const TypeParameters &type = par->type[atom->type[i]];
  if (!par->drag || type.other || (atom->mask[i] & not_fluid)) return;
  Channels::add_drag(type.keywords.a, particle[i].vol, particle[i].u,
                     linear || update->whichflag == 2, force_of, heat);
}

/* ---------------------------------------------------------------------- */

LoopData Engine::part(PairSubset &some) const
{
  const std::size_t end = some.neighbor.size();
  some.neighbor.resize(end + 3 * BLOCK, offset_of(data.spare));    // pass 2 looks ahead
  LoopData part = data;
  part.inum = static_cast<int>(some.rows.size());
  part.ilist = some.rows.data();
  part.first = some.first.data();
  part.count = some.count.data();
  part.neighbor = some.neighbor.data();
  part.slope = some.slope.data();
  part.cohesion = {};
  part.tally = nullptr;
  return part;
}

void Engine::accumulate_flow(int place, PairSubset &some, double *rate) const
{
  loops->flow(par->flows_alike >> place & 1)(part(some), flow[place].data(), rate);
}

void Engine::accumulate_forces(PairSubset &some, ForceSum *force_out, ChannelSums &side_out,
                               double *divergence_out)
{
  LoopData part = this->part(some);
  part.force = force_out;
  part.side = side_out.rows.data();
  part.divergence = divergence_out;
  force_loop(part);
}

/* ---------------------------------------------------------------------- */

bool Engine::has_forces() const
{
  return nlocal_forces == atom->nlocal && nghost_forces == atom->nghost;
}

/* ---------------------------------------------------------------------- */

void PairSubset::begin()
{
  rows.clear();
  count.clear();
  first.clear();
  neighbor.clear();
  slope.clear();
}

void PairSubset::add_row(int i)
{
  rows.push_back(i);
  first.push_back(static_cast<bigint>(neighbor.size()));
}

void PairSubset::add(int j, double slope_ij)
{
  neighbor.push_back(offset_of(j));
  slope.push_back(slope_ij);
}

void PairSubset::end_row(int spare)
{
  const auto n = static_cast<int>(static_cast<bigint>(neighbor.size()) - first.back());
  if (n == 0) {
    rows.pop_back();
    first.pop_back();
    return;
  }
  count.push_back(n);
  for (int l = 0; neighbor.size() % BLOCK; l++) add(spare + l, 0.0);
}

/* ---------------------------------------------------------------------- */

double Engine::memory_usage() const
{
  double per_atom = sizeof(Particle) + sizeof(DensitySum) + sizeof(ForceSum) + 3 * sizeof(double);
  if (has_spin()) per_atom += sizeof(Spin);
  return nmax * per_atom + (double) nmax_weights * sizeof(double) +
      (double) imax * (sizeof(bigint) + sizeof(int)) + (double) pair_max * sizeof(int) +
      (double) slope_max * sizeof(double) +
      bytes(viscosity, excess, square, volume, energy, wall_energy, wall_energy_tags, types, flow,
            flow_rate, random, side, strength, density_sums, force_sums, side_sums, scalar_sums);
}
