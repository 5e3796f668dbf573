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

#include "pair_sph_bulk.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "math_extra.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "pair_hybrid.h"
#include "sph_dissipation_boundary_stage.h"
#include "sph_dissipation_channels.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_crowding.h"
#include "sph_dissipation_density.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_eos.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_forces.h"
#include "sph_dissipation_kernel.h"
#include "sph_dissipation_limit.h"
#include "sph_dissipation_model.h"
#include "sph_dissipation_noise.h"
#include "sph_dissipation_open_stage.h"
#include "sph_dissipation_pressure.h"
#include "sph_dissipation_state.h"
#include "sph_dissipation_steps.h"
#include "sph_dissipation_stress.h"
#include "sph_dissipation_surface.h"
#include "sph_dissipation_table.h"
#include "sph_dissipation_viscous.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// the mode of that rate then has 1/(1 - 0.1/2) times the temperature between the steps

static constexpr double ACCURATE_NOISE = 0.1;

// adds the virial of each pair to the accumulators of the pair style

class PairSPHBulk::StressTally : public PairTally {
 public:
  StressTally(PairSPHBulk *pair, int nlocal, int newton_pair) :
      pair(pair), nlocal(nlocal), newton_pair(newton_pair)
  {
  }
  void tally(int i, int j, const double *f, const double *r) override
  {
    pair->ev_tally_xyz(i, j, nlocal, newton_pair, 0.0, 0.0, f[0], f[1], f[2], r[0], r[1], r[2]);
  }

 private:
  PairSPHBulk *pair;
  int nlocal, newton_pair;
};

/* ---------------------------------------------------------------------- */

PairSPHBulk::PairSPHBulk(LAMMPS *lmp) : PairSPHBulk(lmp, "sph/bulk", false) {}

/* ----------------------------------------------------------------------
   for derived styles: name of the style
------------------------------------------------------------------------- */

PairSPHBulk::PairSPHBulk(LAMMPS *lmp, const std::string &name, bool spins) :
    Pair(lmp), fluid_style(name), model(new FluidModel(lmp, name, spins)), dim(0), support(0.0),
    set_up(false), announced(false), stale(false), warned_step(0.0), noise_step(0.0),
    engine(new Engine(lmp)), crowding_requested(false), continued(false), changed(false)
{
  exchange =
      new Exchange(lmp, this,
                   std::max({DensityStage::FORWARD, LimitStage::FORWARD, SurfaceStage::FORWARD,
                             OpenStage::FORWARD, BoundaryStage::FORWARD, NoiseStage::FORWARD,
                             ViscousStage::FORWARD, FluidState::FORWARD}),
                   std::max({DensityStage::REVERSE, LimitStage::REVERSE, SurfaceStage::REVERSE,
                             BoundaryStage::REVERSE, CrowdingStage::REVERSE, NoiseStage::REVERSE,
                             ForceStage::REVERSE, ViscousStage::REVERSE, FluidState::REVERSE}));
  density = new DensityStage(lmp, *engine, *exchange);
  limit = new LimitStage(lmp, *engine, *exchange);
  pressure = new PressureStage(lmp, *engine, *exchange);
  open = new OpenStage(lmp, *engine, *exchange);
  boundary = new BoundaryStage(lmp, *engine, *exchange, *model, fluid_style);
  crowd = new CrowdingStage(lmp, *engine, *exchange);
  noise = new NoiseStage(lmp, *engine, *exchange, *model);
  forces = new ForceStage(lmp, *engine, *exchange);
  viscous = new ViscousStage(lmp, *engine, *exchange, *model, *pressure, *boundary);

  restartinfo = 1;
  writedata = 1;
  manybody_flag = 1;
  single_enable = 0;
  respa_enable = 0;
  centroidstressflag = CENTROID_AVAIL;
  nextra = 1;
  pvector = new double[nextra];
  pvector[0] = 0.0;
}

/* ---------------------------------------------------------------------- */

PairSPHBulk::~PairSPHBulk()
{
  if (allocated) {
    memory->destroy(setflag);
    memory->destroy(cutsq);
  }
  delete[] pvector;
  delete density;
  delete limit;
  delete pressure;
  delete open;
  delete boundary;
  delete crowd;
  delete noise;
  delete forces;
  delete viscous;
  delete exchange;
  delete engine;
  delete model;
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  if (stale) adopt_changes();
  if (neighbor->ago == 0) check_masses(lmp, fluid_style, *model);

  StressTally stress(this, atom->nlocal, force->newton_pair);
  CentroidTally centroid(stress, cvatom, atom->nlocal, force->newton_pair);
  PairTally *tally = vflag_either ? &stress : nullptr;
  if (cvflag_atom) tally = &centroid;

  if (continued && !changed && update->setupflag)
    viscous->begin_run();
  else if (viscous->active())
    find_viscous_velocity();
  const bigint nbeyond = sum_before_forces();
  if (crowding_requested) crowd->run();
  sum_forces(tally);
  if (!open->empty()) open->sum_impacts(list);
  if (viscous->active() || has_own_temperatures()) forces->collect();

  changed = false;
  pvector[0] = static_cast<double>(nbeyond);
  if (eflag_either) tally_energy();
  if (vflag_fdotr) virial_fdotr_compute();
}

/* ----------------------------------------------------------------------
   all that pass 2 needs; returns the number of particles beyond the bound of the limit
------------------------------------------------------------------------- */

bigint PairSPHBulk::sum_before_forces()
{
  // a minimization has no velocities: what is minimized is the energy of the equation of state

  const bool at_rest = (update->whichflag == 2);
  density->run(list, at_rest ? nullptr : atom->vest, at_rest ? nullptr : extrapolated_spin());

  // noise needs the bound of the limit for the volumes that act in its pairs, those of walls as well

  const bool limited = (model->choice.limit != Limit::NO);
  const bool walls = !boundary->empty();
  if (walls && has_noise()) boundary->set_reference_volume();
  if (limited) limit->run();
  if (walls && !has_noise()) boundary->set_reference_volume();
  const double *const bound = limited ? limit->bound : nullptr;
  const bigint nbeyond = pressure->run(bound, boundary->bits());
  if (!open->empty()) open->run();
  if (walls) boundary->run(list);
  if (has_noise()) noise->run(bound, boundary->bits(), continued);
  return nbeyond;
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::sum_forces(PairTally *tally)
{
  engine->set_not_fluid(not_fluid());
  forces->run(list, tally);
  if (!boundary->empty()) boundary->repel(tally);
}

/* ----------------------------------------------------------------------
   friction that is extended behind walls, and the form P1 (64), have no symmetric matrix
------------------------------------------------------------------------- */

void PairSPHBulk::find_viscous_velocity()
{
  viscous->begin(not_fluid(), extrapolated_spin(), spin_inertia());
  sum_before_forces();
  if (neighbor->ago == 0 || viscous->has_old_rates())
    viscous->set_rate(coeff_table().fastest_rate());
  sum_forces(nullptr);
  const bool symmetric =
      (boundary->empty() || has_noise()) && engine->parameters().bulk != Bulk::VOLUME;
  viscous->run(list, (model->choice.limit != Limit::NO) ? limit->bound : nullptr, symmetric);
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::set_viscous(const ViscousSettings &settings, int groups)
{
  viscous->configure(settings, groups, fluid_style);
}

bool PairSPHBulk::has_viscous_stage() const
{
  return viscous->active();
}

const double *PairSPHBulk::viscous_statistics() const
{
  return viscous->statistics;
}

void PairSPHBulk::carry_other_force(int i, double keep)
{
  viscous->carry_force(i, keep);
}

void PairSPHBulk::carry_other_torque(int i)
{
  viscous->carry_torque(i, spin_inertia(), extrapolated_spin());
}

/* ---------------------------------------------------------------------- */

const double *PairSPHBulk::own_force(int i) const
{
  return engine->force[i].f;
}

const double *PairSPHBulk::own_torque(int i) const
{
  return engine->torque[i].t;
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::find_volumes()
{
  density->run(list, nullptr, nullptr);
}

/* ---------------------------------------------------------------------- */

double PairSPHBulk::elastic_energy(Moment moment)
{
  if (moment == NOW) density->run(list, nullptr, nullptr);
  return pressure->elastic_energy(nullptr, not_fluid());
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::tally_energy()
{
  double *const each_atom = eflag_atom ? eatom : nullptr;
  double energy = pressure->elastic_energy(each_atom, not_fluid());
  if (!boundary->empty()) energy += boundary->energy(each_atom);
  if (eflag_global) eng_vdwl += energy;
}

/* ---------------------------------------------------------------------- */

PairSPHBulk *PairSPHBulk::find(Force *force)
{
  if (!force) return nullptr;    // LAMMPS is being taken down, fixes go last
  auto *pair = dynamic_cast<PairSPHBulk *>(force->pair_match("^sph/bulk", 0));
  if (!pair) pair = dynamic_cast<PairSPHBulk *>(force->pair_match("^sph/micropolar", 0));
  return pair;
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::add_boundary(Boundary *one)
{
  boundary->add(one);
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::remove_boundary(Boundary *one)
{
  boundary->remove(one);
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::add_open_zone(OpenZone *zone)
{
  open->add(zone);
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::remove_open_zone(OpenZone *zone)
{
  open->remove(zone);
}

/* ---------------------------------------------------------------------- */

int PairSPHBulk::not_fluid() const
{
  return boundary->bits() | open->bits();
}

/* ---------------------------------------------------------------------- */

bool PairSPHBulk::is_boundary(int i) const
{
  return atom->mask[i] & boundary->bits();
}

/* ---------------------------------------------------------------------- */

const double *PairSPHBulk::crowding(int i) const
{
  return crowd->crowding[i];
}

/* ---------------------------------------------------------------------- */

bool PairSPHBulk::has_noise() const
{
  return model->choice.thermal;
}

/* ---------------------------------------------------------------------- */

bool PairSPHBulk::has_own_temperatures() const
{
  return model->choice.own_temperatures;
}

double PairSPHBulk::internal_temperature(int i) const
{
  return noise->internal_temperature(i);
}

/* ---------------------------------------------------------------------- */

bool PairSPHBulk::has_forces() const
{
  return engine->has_forces();
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::heating(double *heat, double *power) const
{
  forces->heating(heat, power, not_fluid());
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::allocate()
{
  allocated = 1;
  const int n = atom->ntypes + 1;
  memory->create(setflag, n, n, "pair:setflag");
  memory->create(cutsq, n, n, "pair:cutsq");
  std::fill_n(&setflag[0][0], n * n, 0);
  std::fill_n(&cutsq[0][0], n * n, 0.0);
  model->allocate();
}

/* ----------------------------------------------------------------------
   global settings
------------------------------------------------------------------------- */

void PairSPHBulk::settings(int narg, char **arg)
{
  model->settings(narg, arg);

  int found = engine->choose_loops(model->simd), found_all;
  MPI_Allreduce(&found, &found_all, 1, MPI_INT, MPI_MIN, world);
  if (!found_all)
    error->all(FLERR,
               "Pair_style {} simd {}: not in this processor, or not in this executable of LAMMPS",
               fluid_style, model->simd);
  announced = set_up = false;
  changed = true;
}

/* ----------------------------------------------------------------------
   set coeffs for one or more type pairs
------------------------------------------------------------------------- */

void PairSPHBulk::coeff(int narg, char **arg)
{
  if (!allocated) allocate();
  model->adopt();    // what others have set comes first
  model->coeff(narg, arg, setflag);
  announced = set_up = false;
  changed = true;
}

/* ----------------------------------------------------------------------
   init specific to this pair style
------------------------------------------------------------------------- */

void PairSPHBulk::init_style()
{
  crowding_requested = continued = false;
  viscous->configure(ViscousSettings(), 0, fluid_style);
  check_setup();
  derive_coeffs();
  neighbor->add_request(this);
  set_up = true;
}

/* ----------------------------------------------------------------------
   what the style needs from the rest of the simulation
------------------------------------------------------------------------- */

void PairSPHBulk::check_setup()
{
  check_styles(lmp, fluid_style);
  check_rerun(lmp, fluid_style, *model);
  if (update->whichflag == 2 && model->choice.eos == Eos::IDEAL)
    error->all(FLERR,
               "Pair style {} with eos ideal cannot be used in a minimization: its energy depends "
               "on the heat of the particles, not on their positions alone",
               fluid_style);
  if (has_noise()) check_noise(lmp, fluid_style);
  dim = model->dimension();
  support = model->common_support(setflag);
  find_own_types();
  check_support(lmp, fluid_style, *model, dim, support);
}

/* ----------------------------------------------------------------------
   types whose particles are ours: pair_style hybrid may have others, also ones that it
   gave to another style after their coefficients were set here
------------------------------------------------------------------------- */

void PairSPHBulk::find_own_types()
{
  auto *hybrid = dynamic_cast<PairHybrid *>(force->pair);
  std::string name = fluid_style;
  auto ours = [&](int i, int j) {
    return setflag[i][j] && (!hybrid || hybrid->check_ijtype(i, j, &name[0]));
  };

  model->shared = false;
  for (int i = 1; i <= atom->ntypes; i++) {
    model->coeffs[i].other = !ours(i, i);
    if (model->coeffs[i].other) model->shared = true;
  }
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i + 1; j <= atom->ntypes; j++)
      if (ours(i, j) && (model->coeffs[i].other || model->coeffs[j].other))
        error->all(
            FLERR, Error::NOLASTLINE,
            "Pair style {} acts between types {} and {}, but type {} has no coefficients of it",
            fluid_style, i, j, model->coeffs[i].other ? i : j);
}

/* ----------------------------------------------------------------------
   viscosities of unlike types and coefficients of the bulk term
------------------------------------------------------------------------- */

void PairSPHBulk::derive_coeffs()
{
  stale = false;
  if (model->adopt()) {
    announced = false;
    changed = true;
  }
  viscous->forget_rates();
  model->derive(dim, support);
  engine->setup(model->parameters());
}

/* ---------------------------------------------------------------------- */

double PairSPHBulk::reference_density(int type) const
{
  return model->coeffs[type].eos.rho0;
}

bool PairSPHBulk::has_type(int type) const
{
  return !model->coeffs[type].other;
}

double PairSPHBulk::bulk_viscosity(int type) const
{
  return model->bulk_viscosity(type);
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::announce()
{
  if (!compute_flag) return;    // pair_modify compute no
  const CoeffTable table = coeff_table();
  if (!announced) {
    model->warn_of_ignored();
    warned_step = noise_step = 0.0;
    FluidState state(lmp, *engine, *exchange, *model);
    state.run(1, not_fluid());
    if (comm->me == 0)
      utils::logmesg(lmp, "Pair style {}: {}, {} loops\n{}{}", fluid_style,
                     model->summary(dim, support), engine->instruction_set(),
                     table.text(update->dt), state.table());
    check_sizes(lmp, fluid_style, *model, not_fluid());
    state.warn(fluid_style, crowding_requested);
  }
  announced = true;
  if (has_noise() && update->dt != noise_step) announce_noise(table.fastest_rate());

  check_time_step(table);
  check_energies(lmp, fluid_style, *model, not_fluid());
  check_neighbors(lmp, fluid_style, *model, *engine, not_fluid(), dim, support);
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::check_time_step(const CoeffTable &table)
{
  const double smallest = viscous->active() ? table.acoustic_step() : table.smallest_step();
  if (!(update->dt > smallest) || update->dt == warned_step) return;
  warned_step = update->dt;
  if (comm->me == 0)
    error->warning(FLERR,
                   "The time step {:g} exceeds the largest stable time step {:g} of pair "
                   "style {}",
                   update->dt, smallest, fluid_style);
}

/* ----------------------------------------------------------------------
   another command, such as fix adapt, has changed coefficients; fix sph/dt follows by itself
------------------------------------------------------------------------- */

void PairSPHBulk::adopt_changes()
{
  derive_coeffs();
  if (!update->setupflag && update->whichflag == 1 && modify->get_fix_by_style("^sph/dt").empty())
    check_time_step(coeff_table());
}

/* ----------------------------------------------------------------------
   of the pairs of types, for the fluid as it is now: by type, the fastest particle, those of walls
   as well, with the speed of sound at its density and energy, and the thinnest one of the fluid.
   A type without particles counts with its coefficients.  Whatever has to do with the largest
   stable time step takes it from here.
------------------------------------------------------------------------- */

CoeffTable PairSPHBulk::coeff_table()
{
  const double inertia = smallest_inertia();
  const int n = atom->ntypes;
  const Eos eos = model->choice.eos;
  std::vector<double> mine(2 * (n + 1), 0.0), all(2 * (n + 1));
  double *const speed = all.data(), *const thinness = speed + n + 1;    // rho0/rho
  for (int i = 0; i < atom->nlocal; i++) {
    const int type = atom->type[i];
    const TypeCoeff &coeff = model->coeffs[type];
    if (coeff.other) continue;
    const double rho = atom->rho[i];
    const double sound = sound_speed(eos, coeff.eos, rho, atom->esph[i] / atom->rmass[i]);
    mine[type] = std::max(mine[type], sound + MathExtra::len3(atom->v[i]));
    if (!is_boundary(i)) mine[n + 1 + type] = std::max(mine[n + 1 + type], coeff.eos.rho0 / rho);
  }
  MPI_Allreduce(mine.data(), all.data(), 2 * (n + 1), MPI_DOUBLE, MPI_MAX, world);
  for (int i = 1; i <= n; i++) {
    if (speed[i] == 0.0 && eos != Eos::IDEAL) speed[i] = model->coeffs[i].eos.c0;
    if (thinness[i] == 0.0) thinness[i] = 1.0;
  }

  const double h = stability_length(), hsq = h * h;
  CoeffTable table;
  for (int i = 1; i <= n; i++)
    for (int j = i; j <= n; j++) {
      const TypeCoeff &a = model->coeffs[i], &b = model->coeffs[j];
      if (a.other || b.other) continue;
      const double rho = std::min(a.eos.rho0 / thinness[i], b.eos.rho0 / thinness[j]);
      table.add_row(i, j, model->pair_fluid(i, j), {hsq, rho, rho * inertia},
                    acoustic_step(h, std::max(speed[i], speed[j])));
    }
  return table;
}

/* ---------------------------------------------------------------------- */

double PairSPHBulk::smallest_inertia()
{
  const double *const inertia = spin_inertia();
  double mine = UNLIMITED_STEP, smallest;
  if (inertia)
    for (int i = 0; i < atom->nlocal; i++)
      if (inertia[i] > 0.0 && !model->coeffs[atom->type[i]].other)
        mine = std::min(mine, inertia[i]);
  MPI_Allreduce(&mine, &smallest, 1, MPI_DOUBLE, MPI_MIN, world);
  return smallest;
}

/* ---------------------------------------------------------------------- */

double PairSPHBulk::stability_length() const
{
  return sqrt(stability_length_squared(kernel_slope_integral(model->choice.kernel, dim, support)));
}

/* ---------------------------------------------------------------------- */

double PairSPHBulk::fall_time() const
{
  double mine = 0.0, largest;    // acceleration
  for (int i = 0; i < atom->nlocal; i++)
    if (!model->coeffs[atom->type[i]].other && !is_boundary(i))
      mine = std::max(mine, MathExtra::len3(atom->f[i]) / atom->rmass[i]);
  MPI_Allreduce(&mine, &largest, 1, MPI_DOUBLE, MPI_MAX, world);
  return (largest > 0.0) ? sqrt(stability_length() / largest) : UNLIMITED_STEP;
}

/* ----------------------------------------------------------------------
   with rate, of the fastest viscous mode, times the time step: what the noise asks for
------------------------------------------------------------------------- */

void PairSPHBulk::announce_noise(double rate)
{
  noise_step = update->dt;
  const std::string temperature = has_own_temperatures()
      ? "the temperatures of the particles"
      : fmt::format("temperature {:g}", model->choice.temperature);
  if (comm->me == 0)
    utils::logmesg(lmp,
                   "Pair style {}: thermal noise of {}, seed {}, largest viscous rate times time "
                   "step {:.3g}\n",
                   fluid_style, temperature, model->choice.seed, rate * update->dt);
  if (rate == 0.0 && (has_own_temperatures() || model->choice.temperature > 0.0) && comm->me == 0)
    error->warning(FLERR, "Pair style {}: temp has no effect without viscosity", fluid_style);
  if (rate * update->dt > ACCURATE_NOISE && !viscous->active() && comm->me == 0)
    error->warning(
        FLERR,
        "Pair style {}: the largest viscous rate times the time step is {:.3g}, above {:g}; "
        "velocities between steps, and with them the structure of the fluid, are hotter "
        "than the temperature of the noise",
        fluid_style, rate * update->dt, ACCURATE_NOISE);
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::set_mean_density(int groupbit)
{
  constexpr int MOST = 100;
  constexpr double CLOSE = 1.0e-12;
  check_masses(lmp, fluid_style, *model);

  // with volume mass, the volumes depend on the masses of the neighbors of other types

  FluidState state(lmp, *engine, *exchange, *model);
  std::vector<double> factor(atom->ntypes + 1, 1.0);
  for (int k = 0; k < MOST; k++) {
    density->run(list, nullptr, nullptr);
    state.run(groupbit, not_fluid());
    if (state.scale_masses(factor, open->bits()) < CLOSE) break;
  }
  state.report_masses(factor, fluid_style);
}

/* ----------------------------------------------------------------------
   init for one type pair i,j and corresponding j,i
   also called when another command, such as fix adapt, has changed coefficients
------------------------------------------------------------------------- */

double PairSPHBulk::init_one(int i, int j)
{
  stale = true;
  if (i != j && model->is_mixed(i, j)) did_mix = true;
  return support;
}

/* ---------------------------------------------------------------------- */

void *PairSPHBulk::extract(const char *name, int &ndim)
{
  return model->extract(name, ndim);
}

/* ----------------------------------------------------------------------
   restart and data files: proc 0 writes, proc 0 reads and bcasts
------------------------------------------------------------------------- */

void PairSPHBulk::write_restart(FILE *fp)
{
  write_restart_settings(fp);
  model->write_coeffs(fp, setflag);
}

void PairSPHBulk::read_restart(FILE *fp)
{
  read_restart_settings(fp);
  allocate();
  model->read_coeffs(fp, setflag);
}

void PairSPHBulk::write_restart_settings(FILE *fp)
{
  model->write_settings(fp);
}

void PairSPHBulk::read_restart_settings(FILE *fp)
{
  model->read_settings(fp);
}

void PairSPHBulk::write_data(FILE *fp)
{
  model->write_data(fp);
}

void PairSPHBulk::write_data_all(FILE *fp)
{
  model->write_data_all(fp);
}

/* ----------------------------------------------------------------------
   what the stages send
------------------------------------------------------------------------- */

int PairSPHBulk::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  return exchange->pack_forward(n, list, buf);
}

void PairSPHBulk::unpack_forward_comm(int n, int nfirst, double *buf)
{
  exchange->unpack_forward(n, nfirst, buf);
}

int PairSPHBulk::pack_reverse_comm(int n, int nfirst, double *buf)
{
  return exchange->pack_reverse(n, nfirst, buf);
}

void PairSPHBulk::unpack_reverse_comm(int n, int *list, double *buf)
{
  exchange->unpack_reverse(n, list, buf);
}

/* ---------------------------------------------------------------------- */

double PairSPHBulk::memory_usage()
{
  return Pair::memory_usage() + engine->memory_usage() + limit->memory_usage() +
      open->memory_usage() + boundary->memory_usage() + crowd->memory_usage() +
      noise->memory_usage() + viscous->memory_usage();
}
