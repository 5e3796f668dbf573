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
#include "memory.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "sph_dissipation_boundary.h"
#include "sph_dissipation_checks.h"
#include "sph_dissipation_coeffs.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_eos.h"
#include "sph_dissipation_kernel.h"
#include "sph_dissipation_model.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// most values per atom that any stage of the communication has

static constexpr int MAXFORWARD = 10;
static constexpr int MAXREVERSE = 18;

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

PairSPHBulk::PairSPHBulk(LAMMPS *lmp) : PairSPHBulk(lmp, "sph/bulk", {"mu"}) {}

/* ----------------------------------------------------------------------
   for derived styles: name of the style and of its viscosities by type pair
------------------------------------------------------------------------- */

PairSPHBulk::PairSPHBulk(LAMMPS *lmp, const std::string &name,
                         const std::vector<std::string> &viscosities) :
    Pair(lmp),
    fluid_style(name), model(new FluidModel(lmp, name, viscosities)), dim(0), support(0.0),
    announced(false), warned_step(false), engine(new Engine(lmp)), boundary_bits(0),
    crowding_requested(false), stage(Stage::DENSITY)
{
  restartinfo = 1;
  writedata = 1;
  manybody_flag = 1;
  single_enable = 0;
  respa_enable = 0;
  comm_forward = MAXFORWARD;
  comm_reverse = MAXREVERSE;
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
  delete model;
  delete engine;
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);

  const int nlocal = atom->nlocal;
  const int newton_pair = force->newton_pair;

  if (neighbor->ago == 0) check_masses(lmp, fluid_style);

  engine->accumulate_density(list, extrapolated_spin());
  reverse_stage(Stage::DENSITY);
  forward_stage(Stage::DENSITY);

  particle_volume();
  if (model->choice.limit != Limit::NO) {
    engine->accumulate_bound(list);
    reverse_stage(Stage::BOUND);
    forward_stage(Stage::BOUND);
  }
  particle_state();
  if (!boundaries.empty()) extrapolate_to_boundary();
  if (crowding_requested) {
    engine->accumulate_crowding(list);
    reverse_stage(Stage::CROWDING);
  }

  StressTally stress(this, nlocal, newton_pair);
  engine->accumulate_forces(list, vflag_either ? &stress : nullptr);

  double **f = atom->f;
  double *desph = atom->desph;
  const ForceSum *const total = engine->force;
  const int nforce = newton_pair ? nlocal + atom->nghost : nlocal;
  for (int i = 0; i < nforce; i++) {
    for (int d = 0; d < 3; d++) f[i][d] += total[i].f[d];
    desph[i] += total[i].heat + bulk_heat(i);
  }
  add_torques(nforce);

  if (vflag_fdotr) virial_fdotr_compute();
}

/* ----------------------------------------------------------------------
   volume and density of owned and ghost particles from c and cdot; a boundary
   particle has its reference volume, for most of its neighbors are not there
------------------------------------------------------------------------- */

void PairSPHBulk::particle_volume()
{
  const double *const rmass = atom->rmass;
  double *const rho = atom->rho;
  double *const drho = atom->drho;
  double *const vfrac = atom->vfrac;
  const int nall = atom->nlocal + atom->nghost;

  for (int i = 0; i < nall; i++) {
    const DensitySum &density = engine->density[i];
    rho[i] = rmass[i] * density.c;
    drho[i] = rmass[i] * density.cdot;
    vfrac[i] = engine->particle[i].vol = 1.0 / density.c;
  }

  if (!boundary_bits) return;
  for (int i = 0; i < nall; i++) {
    if (!is_boundary(i)) continue;
    rho[i] = model->coeffs[atom->type[i]].eos.rho0;
    drho[i] = 0.0;
    vfrac[i] = engine->particle[i].vol = rmass[i] / rho[i];
  }
}

/* ----------------------------------------------------------------------
   pressure and bulk term of owned and ghost particles, pressure work and
   elastic energy of owned ones
------------------------------------------------------------------------- */

void PairSPHBulk::particle_state()
{
  const double *const rmass = atom->rmass;
  const double *const rho = atom->rho;
  const double *const esph = atom->esph;
  const int *const type = atom->type;
  double *const desph = atom->desph;
  const int nlocal = atom->nlocal;
  const int nall = nlocal + atom->nghost;
  const TypeCoeff *const coeffs = model->coeffs;
  const Eos eos = model->choice.eos;
  const Limit limit = model->choice.limit;
  const bool by_density = (model->choice.bulk == Bulk::DENSITY);
  bigint nbeyond = 0;

  for (int i = 0; i < nall; i++) {
    if (is_boundary(i)) {
      engine->zeta_term[i] = engine->particle[i].g = 0.0;
      continue;
    }
    const TypeCoeff &coeff = coeffs[type[i]];
    const double vol = engine->particle[i].vol;
    const double cdot = engine->density[i].cdot;

    double zeta = coeff.zeta;
    if (limit != Limit::NO && zeta * engine->bound[i] < -0.5) {
      if (i < nlocal) nbeyond++;
      if (limit == Limit::YES) zeta = -0.5 / engine->bound[i];
    }

    const double pressure_term = pressure(eos, coeff.eos, rho[i], esph[i] / rmass[i]) * vol * vol;
    const double zeta_term = zeta * vol * cdot;
    engine->zeta_term[i] = zeta_term;
    engine->particle[i].g = by_density ? pressure_term + zeta_term * vol * vol : pressure_term;
    if (i < nlocal) desph[i] += pressure_term * cdot;
  }
  pvector[0] = static_cast<double>(nbeyond);

  if (!eflag_either) return;
  for (int i = 0; i < nlocal; i++) {
    if (is_boundary(i)) continue;
    const double energy = rmass[i] * elastic_energy(eos, coeffs[type[i]].eos, rho[i]);
    if (eflag_global) eng_vdwl += energy;
    if (eflag_atom) eatom[i] += energy;
  }
}

/* ---------------------------------------------------------------------- */

PairSPHBulk *PairSPHBulk::find(Force *force)
{
  auto *pair = dynamic_cast<PairSPHBulk *>(force->pair_match("sph/bulk", 1));
  if (!pair) pair = dynamic_cast<PairSPHBulk *>(force->pair_match("sph/micropolar", 1));
  return pair;
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::add_boundary(Boundary *boundary)
{
  boundaries.push_back(boundary);
  boundary_bits |= boundary->boundary_bit();
}

/* ---------------------------------------------------------------------- */

const double *PairSPHBulk::crowding(int i) const
{
  return engine->crowding[i];
}

/* ---------------------------------------------------------------------- */

bool PairSPHBulk::is_boundary(int i) const
{
  return atom->mask[i] & boundary_bits;
}

/* ----------------------------------------------------------------------
   boundary particles get the velocity, pressure and spin that act in the pair forces
------------------------------------------------------------------------- */

void PairSPHBulk::extrapolate_to_boundary()
{
  engine->accumulate_boundary(list, boundary_bits);
  reverse_stage(Stage::BOUNDARY_SUM);
  check_boundary();

  bool vorticity = false;
  for (auto boundary : boundaries) {
    boundary->set_boundary(*engine);
    vorticity = vorticity || boundary->boundary_vorticity();
  }
  forward_stage(Stage::BOUNDARY_STATE);
  engine->update_boundary_velocity();
  if (!vorticity || !extrapolated_spin()) return;

  engine->accumulate_gradient(list, boundary_bits);
  reverse_stage(Stage::GRADIENT);
  engine->solve_vorticity();
  forward_stage(Stage::VORTICITY);
  engine->accumulate_boundary_vorticity(boundary_bits);
  reverse_stage(Stage::VORTICITY);
  for (auto boundary : boundaries)
    if (boundary->boundary_vorticity()) boundary->set_boundary_spin(*engine);
  forward_stage(Stage::BOUNDARY_SPIN);
}

/* ----------------------------------------------------------------------
   the support of a fluid particle at a plane surface is half full of boundary particles,
   that of one in the corner of a box 7/8; more only inside
------------------------------------------------------------------------- */

void PairSPHBulk::check_boundary() const
{
  constexpr double INSIDE = 0.9;
  for (int i = 0; i < atom->nlocal; i++)
    if (engine->boundary_sum[i].weight > INSIDE && !is_boundary(i))
      error->one(FLERR, "Particle {} of the fluid of pair style {} is inside a wall", atom->tag[i],
                 fluid_style);
}

/* ----------------------------------------------------------------------
   heat of the bulk term: zeta V^3 cdot^2 of the particle (density);
   zeta V^2 cdot D with D summed by pairs, also on ghost atoms (volume)
------------------------------------------------------------------------- */

double PairSPHBulk::bulk_heat(int i) const
{
  const double vol = engine->particle[i].vol;
  if (model->choice.bulk == Bulk::VOLUME) return engine->zeta_term[i] * vol * engine->divergence[i];
  return (i < atom->nlocal) ? engine->zeta_term[i] * vol * vol * engine->density[i].cdot : 0.0;
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::heating(double *heat, double *power) const
{
  const int nlocal = atom->nlocal;
  const int nforce = force->newton_pair ? nlocal + atom->nghost : nlocal;
  std::fill(power, power + NCHANNEL, 0.0);
  for (int i = 0; i < nforce; i++) {
    if (heat) heat[i] = 0.0;
    if (is_boundary(i)) continue;
    double channel[NCHANNEL] = {engine->force[i].heat, bulk_heat(i)};
    spin_heat(i, channel);
    for (int k = 0; k < NCHANNEL; k++) {
      if (heat) heat[i] += channel[k];
      power[k] += channel[k];
    }
  }
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
  model->settings(narg, arg, default_shear());
  announced = false;
}

/* ----------------------------------------------------------------------
   set coeffs for one or more type pairs
------------------------------------------------------------------------- */

void PairSPHBulk::coeff(int narg, char **arg)
{
  if (!allocated) allocate();
  model->coeff(narg, arg, setflag);
  announced = false;
}

/* ----------------------------------------------------------------------
   init specific to this pair style
------------------------------------------------------------------------- */

void PairSPHBulk::init_style()
{
  boundaries.clear();
  boundary_bits = 0;
  crowding_requested = false;
  check_setup();
  derive_coeffs();
  announce();
  neighbor->add_request(this);
}

/* ----------------------------------------------------------------------
   what the style needs from the rest of the simulation
------------------------------------------------------------------------- */

void PairSPHBulk::check_setup()
{
  check_styles(lmp, fluid_style);
  dim = model->dimension();
  support = model->common_support(setflag);
  check_support(lmp, fluid_style, dim, support);
}

/* ----------------------------------------------------------------------
   viscosities of unlike types and coefficients of the bulk term
------------------------------------------------------------------------- */

void PairSPHBulk::derive_coeffs()
{
  const int n = atom->ntypes;
  std::vector<PairCoeff> pair_coeffs((n + 1) * (n + 1));

  for (int i = 1; i <= n; i++) {
    model->mix(i);
    for (int j = 1; j <= i; j++) {
      if (setflag[i][i] && setflag[j][j]) check_pair(i, j);
      pair_coeffs[i * (n + 1) + j] = pair_coeffs[j * (n + 1) + i] = pair_coefficients(i, j);
    }
    model->set_bulk(i, intrinsic_kappa_of(i, i), setflag[i][i] && !announced);
  }

  const Settings &choice = model->choice;
  engine->setup(choice.kernel, dim, support, choice.shear, choice.bulk, pair_coeffs, n);
}

/* ----------------------------------------------------------------------
   what a derived style does in its own way
------------------------------------------------------------------------- */

Shear PairSPHBulk::default_shear() const
{
  return Shear::MG;
}

PairCoeff PairSPHBulk::pair_coefficients(int i, int j) const
{
  return shear_coefficients(model->choice.shear, dim, model->viscosity(0, i, j),
                            kernel_mean_radius(model->choice.kernel, dim, support));
}

double PairSPHBulk::intrinsic_kappa_of(int i, int j) const
{
  return intrinsic_kappa(model->choice.shear, dim, model->viscosity(0, i, j));
}

double PairSPHBulk::reference_density(int type) const
{
  return model->coeffs[type].eos.rho0;
}

void PairSPHBulk::check_pair(int i, int j)
{
  if (model->choice.shear == Shear::NONE && model->viscosity(0, i, j) != 0.0)
    error->all(FLERR, "Pair_coeff mu must be 0 with shear none, not {} for types {} {}",
               model->viscosity(0, i, j), j, i);
}

PairSPHBulk::Columns PairSPHBulk::table_columns(int i, int j, double kappa, double zeta) const
{
  const PairCoeff coeff = pair_coefficients(i, j);
  return {{"mu", model->viscosity(0, i, j)},
          {"kappa", kappa},
          {"zeta", zeta},
          {"shear_coeff", std::max(coeff.along_r, coeff.along_u)}};
}

PairSPHBulk::Columns PairSPHBulk::viscous_steps(int i, int j, double hsq, double rho) const
{
  return {{"shear", shear_step(model->choice.shear, hsq, model->viscosity(0, i, j) / rho)}};
}

/* ----------------------------------------------------------------------
   table of viscosities, model coefficients and time-step limits by type pair,
   when the coefficients are new; warning when the time step is too large
------------------------------------------------------------------------- */

void PairSPHBulk::announce()
{
  double speed = 0.0, fastest;
  for (int i = 0; i < atom->nlocal; i++) {
    const double *const v = atom->v[i];
    speed = std::max(speed, v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }
  MPI_Allreduce(&speed, &fastest, 1, MPI_DOUBLE, MPI_MAX, world);
  fastest = sqrt(fastest);

  const double hsq =
      stability_length_squared(kernel_slope_integral(model->choice.kernel, dim, support));
  CoeffTable table;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      if (!setflag[i][i] || !setflag[j][j]) continue;
      const TypeCoeff &a = model->coeffs[i], &b = model->coeffs[j];
      const double zeta = 0.5 * (a.zeta + b.zeta);
      const double rho = std::min(a.eos.rho0, b.eos.rho0);
      Columns steps = viscous_steps(i, j, hsq, rho);
      steps.insert(steps.begin() + 1, {"bulk", bulk_step(hsq, zeta / rho)});
      table.add_row(i, j, table_columns(i, j, zeta + intrinsic_kappa_of(i, j), zeta),
                    acoustic_step(sqrt(hsq), std::max(a.eos.c0, b.eos.c0) + fastest), steps);
    }

  if (!announced && comm->me == 0)
    utils::logmesg(lmp, "Pair style {}: {}, {} loops\n{}", fluid_style,
                   model->summary(dim, support), engine->instruction_set(), table.text());
  announced = true;

  const double smallest = table.smallest_step();
  if (update->dt > smallest && !warned_step) {
    warned_step = true;
    if (comm->me == 0)
      error->warning(FLERR,
                     "The time step {:g} exceeds the largest stable time step {:g} of pair "
                     "style {}",
                     update->dt, smallest, fluid_style);
  }
}

/* ----------------------------------------------------------------------
   init for one type pair i,j and corresponding j,i
------------------------------------------------------------------------- */

double PairSPHBulk::init_one(int i, int j)
{
  if (i != j && model->is_mixed(i, j)) did_mix = true;
  return support;
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
   ghost stage 1: number density and its rate, first summed onto the owner,
   then copied to all ghosts; the ideal gas needs the internal energy there, too
   with a limit on zeta, once more for the bound of each particle
   with boundaries, once more for what they get of the fluid and bring into the forces
------------------------------------------------------------------------- */

void PairSPHBulk::forward_stage(Stage next)
{
  stage = next;
  comm->forward_comm(this, forward_size());
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::reverse_stage(Stage next)
{
  stage = next;
  if (force->newton_pair) comm->reverse_comm(this, reverse_size());
}

/* ----------------------------------------------------------------------
   # of values per atom of a stage; none has more than MAXFORWARD, MAXREVERSE
------------------------------------------------------------------------- */

int PairSPHBulk::forward_size() const
{
  switch (stage) {
    case Stage::DENSITY:
      return (model->choice.eos == Eos::IDEAL) ? 3 : 2;
    case Stage::BOUND:
      return 1;
    case Stage::BOUNDARY_STATE:
      return (model->choice.shear == Shear::MICROPOLAR) ? 10 : 7;
    default:
      return 3;
  }
}

/* ---------------------------------------------------------------------- */

int PairSPHBulk::reverse_size() const
{
  switch (stage) {
    case Stage::DENSITY:
      return 2;
    case Stage::BOUND:
      return 1;
    case Stage::BOUNDARY_SUM:
      return (model->choice.shear == Shear::MICROPOLAR) ? 13 : 10;
    case Stage::GRADIENT:
      return 18;
    default:
      return 3;
  }
}

/* ---------------------------------------------------------------------- */

double &PairSPHBulk::comm_value(int i, int k)
{
  Particle &particle = engine->particle[i];
  switch (stage) {
    case Stage::DENSITY:
      return (k == 0) ? engine->density[i].c : (k == 1) ? engine->density[i].cdot : atom->esph[i];
    case Stage::BOUND:
      return engine->bound[i];
    case Stage::BOUNDARY_SUM:
      return reinterpret_cast<double *>(engine->boundary_sum + i)[k];
    case Stage::BOUNDARY_STATE:
      if (k < 3) return particle.u[k];
      if (k > 6) return engine->spin[i].w[k - 7];
      if (k == 6) return engine->boundary_sum[i].weight;
      return (k == 3) ? particle.vol : (k == 4) ? particle.g : engine->zeta_term[i];
    case Stage::GRADIENT:
      return reinterpret_cast<double *>(engine->gradient + i)[k];
    case Stage::VORTICITY:
      return engine->vorticity[i][k];
    case Stage::CROWDING:
      return engine->crowding[i][k];
    default:
      return engine->spin[i].w[k];
  }
}

/* ---------------------------------------------------------------------- */

int PairSPHBulk::pack_forward_comm(int n, int *sendlist, double *buf, int /*pbc_flag*/,
                                   int * /*pbc*/)
{
  const int nvalues = forward_size();
  int m = 0;
  for (int ii = 0; ii < n; ii++)
    for (int k = 0; k < nvalues; k++) buf[m++] = comm_value(sendlist[ii], k);
  return m;
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::unpack_forward_comm(int n, int nfirst, double *buf)
{
  const int nvalues = forward_size();
  int m = 0;
  for (int i = nfirst; i < nfirst + n; i++)
    for (int k = 0; k < nvalues; k++) comm_value(i, k) = buf[m++];
}

/* ---------------------------------------------------------------------- */

int PairSPHBulk::pack_reverse_comm(int n, int nfirst, double *buf)
{
  const int nvalues = reverse_size();
  int m = 0;
  for (int i = nfirst; i < nfirst + n; i++)
    for (int k = 0; k < nvalues; k++) buf[m++] = comm_value(i, k);
  return m;
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::unpack_reverse_comm(int n, int *sendlist, double *buf)
{
  const int nvalues = reverse_size();
  int m = 0;
  for (int ii = 0; ii < n; ii++)
    for (int k = 0; k < nvalues; k++) comm_value(sendlist[ii], k) += buf[m++];
}

/* ---------------------------------------------------------------------- */

double PairSPHBulk::memory_usage()
{
  return Pair::memory_usage() + engine->memory_usage();
}
