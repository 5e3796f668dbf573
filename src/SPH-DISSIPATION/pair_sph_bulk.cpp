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
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "sph_dissipation_boundary.h"
#include "sph_dissipation_coeffs.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_eos.h"
#include "sph_dissipation_fluids.h"
#include "sph_dissipation_kernel.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

// negative coefficients of the bulk term beyond the bound of a particle: let be, count, cut off

enum class Limit { NO, COUNT, YES };

// most values per atom that any stage of the communication has

static constexpr int MAXFORWARD = 9;
static constexpr int MAXREVERSE = 18;

struct PairSPHBulk::Settings {
  Kernel kernel = Kernel::WENDLAND_C2;
  Eos eos = Eos::LINEAR;
  Shear shear = Shear::MG;
  Bulk bulk = Bulk::DENSITY;
  int dim = 0;    // 0: dimension of the simulation
  Limit limit = Limit::NO;
};

struct PairSPHBulk::TypeCoeff {
  EosParams eos;
  double viscosity[MAXVISCOSITY] = {};    // mu, and what a derived style adds
  double kappa = 0.0;
  double rc = 0.0;
  double gamma = 0.0;    // 0: default of the equation of state
  int intrinsic = 0;     // 1: kappa is what the shear term gives
  double zeta = 0.0;     // coefficient of the bulk term

  // the members that pair_coeff sets, as a restart file holds them

  static constexpr int NSTORED = 7 + MAXVISCOSITY;
  void store(double *buf) const
  {
    const double stored[] = {eos.rho0, eos.c0, eos.pb, gamma, kappa, rc, (double) intrinsic};
    std::copy(stored, stored + 7, buf);
    std::copy(viscosity, viscosity + MAXVISCOSITY, buf + 7);
  }
  void restore(const double *buf)
  {
    eos.rho0 = buf[0];
    eos.c0 = buf[1];
    eos.pb = buf[2];
    gamma = buf[3];
    kappa = buf[4];
    rc = buf[5];
    intrinsic = static_cast<int>(buf[6]);
    std::copy(buf + 7, buf + NSTORED, viscosity);
  }
};

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
    fluid_style(name), viscosity_names(viscosities), choice(new Settings), coeffs(nullptr),
    viscosity(nullptr), viscosity_set(nullptr), dim(0), support(0.0), announced(false),
    warned_step(false), engine(new Engine(lmp)), boundary_bits(0), stage(Stage::DENSITY)
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
    memory->destroy(viscosity);
    memory->destroy(viscosity_set);
  }
  delete[] pvector;
  delete[] coeffs;
  delete choice;
  delete engine;
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);

  const int nlocal = atom->nlocal;
  const int newton_pair = force->newton_pair;

  if (neighbor->ago == 0) check_masses();

  engine->accumulate_density(list, extrapolated_spin());
  reverse_stage(Stage::DENSITY);
  forward_stage(Stage::DENSITY);

  particle_volume();
  if (choice->limit != Limit::NO) {
    engine->accumulate_bound(list);
    reverse_stage(Stage::BOUND);
    forward_stage(Stage::BOUND);
  }
  particle_state();
  if (!boundaries.empty()) extrapolate_to_boundary();

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
    rho[i] = coeffs[atom->type[i]].eos.rho0;
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
  const Eos eos = choice->eos;
  const Limit limit = choice->limit;
  const bool by_density = (choice->bulk == Bulk::DENSITY);
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

void PairSPHBulk::add_boundary(Boundary *boundary)
{
  boundaries.push_back(boundary);
  boundary_bits |= boundary->boundary_bit();
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
  if (choice->bulk == Bulk::VOLUME) return engine->zeta_term[i] * vol * engine->divergence[i];
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
  memory->create(viscosity, nviscosity(), n, n, "pair:viscosity");
  memory->create(viscosity_set, nviscosity(), n, n, "pair:viscosity_set");
  coeffs = new TypeCoeff[n];
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) {
      setflag[i][j] = 0;
      cutsq[i][j] = 0.0;
      for (int k = 0; k < nviscosity(); k++) {
        viscosity_set[k][i][j] = 0;
        viscosity[k][i][j] = 0.0;
      }
    }
}

/* ----------------------------------------------------------------------
   set choice to the entry of table that has this name; false if there is none
------------------------------------------------------------------------- */

template <class Choice>
static bool choose(Choice &choice, const std::string &word,
                   const std::vector<std::pair<std::string, Choice>> &table)
{
  for (const auto &entry : table)
    if (entry.first == word) {
      choice = entry.second;
      return true;
    }
  return false;
}

/* ----------------------------------------------------------------------
   global settings
------------------------------------------------------------------------- */

void PairSPHBulk::settings(int narg, char **arg)
{
  *choice = Settings();
  choice->shear = default_shear();
  announced = false;

  for (int iarg = 0; iarg < narg; iarg += 2) {
    const std::string keyword = arg[iarg];
    if (keyword != "kernel" && keyword != "dim" && keyword != "eos" && keyword != "bulk" &&
        keyword != "limit" && (keyword != "shear" || default_shear() != Shear::MG))
      error->all(FLERR, "Unknown pair_style {} keyword: {}", fluid_style, keyword);
    if (iarg + 2 > narg)
      utils::missing_cmd_args(FLERR, "pair_style " + fluid_style + " " + keyword, error);
    const std::string word = arg[iarg + 1];
    auto unknown = [&](const char *what) {
      error->all(FLERR, "Unknown {} {} for pair_style {}", what, word, fluid_style);
    };

    if (keyword == "kernel") {
      std::vector<std::pair<std::string, Kernel>> kernels;
      for (auto k : {Kernel::WENDLAND_C2, Kernel::WENDLAND_C4, Kernel::WENDLAND_C6, Kernel::CUBIC,
                     Kernel::QUINTIC, Kernel::LUCY})
        kernels.emplace_back(kernel_name(k), k);
      if (!choose(choice->kernel, word, kernels)) unknown("kernel");
    } else if (keyword == "eos") {
      if (!choose(choice->eos, word,
                  {{"linear", Eos::LINEAR}, {"tait", Eos::TAIT}, {"ideal", Eos::IDEAL}}))
        unknown("eos");
    } else if (keyword == "shear") {
      if (!choose(choice->shear, word,
                  {{"mg", Shear::MG},
                   {"mg/fr", Shear::MG_FR},
                   {"morris", Shear::MORRIS},
                   {"espanol", Shear::ESPANOL},
                   {"none", Shear::NONE}}))
        unknown("shear form");
    } else if (keyword == "bulk") {
      if (!choose(choice->bulk, word,
                  {{"density", Bulk::DENSITY}, {"volume", Bulk::VOLUME}, {"none", Bulk::NONE}}))
        unknown("bulk form");
    } else if (keyword == "limit") {
      if (!choose(choice->limit, word,
                  {{"no", Limit::NO}, {"count", Limit::COUNT}, {"yes", Limit::YES}}))
        unknown("limit");
    } else {
      choice->dim = utils::inumeric(FLERR, word, false, lmp);
      if (choice->dim < 1 || choice->dim > 3)
        error->all(FLERR, "Pair_style {} dim must be 1, 2, or 3, not {}", fluid_style, word);
    }
  }
  if (choice->limit != Limit::NO && choice->bulk != Bulk::DENSITY)
    error->all(FLERR, "Pair_style {} limit requires bulk density", fluid_style);
}

/* ----------------------------------------------------------------------
   words of pair_coeff that belong to a type
------------------------------------------------------------------------- */

static bool is_type_keyword(const std::string &word)
{
  for (const auto &keyword : {"rho0", "c0", "kappa", "rc", "pb", "gamma"})
    if (word == keyword) return true;
  return false;
}

/* ----------------------------------------------------------------------
   set coeffs for one or more type pairs
   I J rho0 c0 mu kappa rc [pb p] [gamma g]: the types I = J of both ranges
   I J FILE NAME rc [pb p] [gamma g]: the same, from a file of fluids
   I J mu VALUE: the unlike pairs of both ranges
   derived styles have more viscosities, which follow kappa
------------------------------------------------------------------------- */

void PairSPHBulk::coeff(int narg, char **arg)
{
  if (narg < 3) utils::missing_cmd_args(FLERR, "pair_coeff", error);
  if (!allocated) allocate();

  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);

  const std::string word = arg[2];
  int count;
  if (utils::is_double(word))
    count = type_coeff(narg, arg, ilo, ihi, jlo, jhi);
  else if (narg < 5 || nviscosity() > 1 || is_viscosity(word) >= 0 || is_type_keyword(word))
    count = unlike_coeff(narg, arg, ilo, ihi, jlo, jhi);
  else
    count = fluid_coeff(narg, arg, ilo, ihi, jlo, jhi);

  if (count == 0)
    error->all(
        FLERR,
        "Pair_coeff {} {} {}: the coefficients rho0 c0 mu kappa ... rc are for a type, I = J; "
        "viscosities by keyword are for unlike types",
        arg[0], arg[1], arg[2]);
  announced = false;
}

/* ----------------------------------------------------------------------
   index of a viscosity that unlike types may have of their own, or -1
------------------------------------------------------------------------- */

int PairSPHBulk::is_viscosity(const std::string &word) const
{
  for (int k = 0; k < nviscosity(); k++)
    if (word == viscosity_names[k]) return k;
  return -1;
}

/* ----------------------------------------------------------------------
   coefficients of a type; return # of types
------------------------------------------------------------------------- */

int PairSPHBulk::type_coeff(int narg, char **arg, int ilo, int ihi, int jlo, int jhi)
{
  const int nvalues = 6 + nviscosity();
  if (narg < nvalues) utils::missing_cmd_args(FLERR, "pair_coeff", error);

  auto positive = [&](const char *what, const char *word) {
    const double value = utils::numeric(FLERR, word, false, lmp);
    if (!(value > 0.0) || !std::isfinite(value))
      error->all(FLERR, "Pair_coeff {} must be > 0, not {}", what, word);
    return value;
  };

  TypeCoeff one;
  one.eos.rho0 = positive("rho0", arg[2]);
  one.eos.c0 = positive("c0", arg[3]);
  one.viscosity[0] = utils::numeric(FLERR, arg[4], false, lmp);
  one.intrinsic = (strcmp(arg[5], "intrinsic") == 0) ? 1 : 0;
  if (!one.intrinsic) one.kappa = utils::numeric(FLERR, arg[5], false, lmp);
  for (int k = 1; k < nviscosity(); k++)
    one.viscosity[k] = utils::numeric(FLERR, arg[5 + k], false, lmp);
  one.rc = positive("rc", arg[nvalues - 1]);

  for (int iarg = nvalues; iarg < narg; iarg += 2) {
    const std::string keyword = arg[iarg];
    if (keyword != "pb" && keyword != "gamma")
      error->all(FLERR, "Unknown pair_coeff keyword for pair_style {}: {}", fluid_style, keyword);
    if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "pair_coeff " + keyword, error);
    if (keyword == "pb")
      one.eos.pb = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    else
      one.gamma = positive("gamma", arg[iarg + 1]);
  }

  if (const char *violated = inadmissible(one.viscosity[0], one.kappa))
    error->all(FLERR, "Pair_coeff {}, not mu = {} kappa = {}", violated, arg[4], arg[5]);

  int count = 0;
  for (int i = std::max(ilo, jlo); i <= std::min(ihi, jhi); i++) {
    coeffs[i] = one;
    setflag[i][i] = 1;
    count++;
  }

  // pairs of unlike types in both ranges are ours, too, if another style shares the simulation

  for (int i = ilo; i <= ihi; i++)
    for (int j = std::max(jlo, i); j <= jhi; j++) setflag[i][j] = 1;
  return count;
}

/* ----------------------------------------------------------------------
   coefficients of a type from a file of fluids; return # of types
------------------------------------------------------------------------- */

int PairSPHBulk::fluid_coeff(int narg, char **arg, int ilo, int ihi, int jlo, int jhi)
{
  const Fluid fluid = read_fluid(lmp, arg[2], arg[3]);
  std::vector<std::string> words = {arg[0], arg[1]};
  for (double value : {fluid.rho, fluid.c, fluid.mu, fluid.kappa})
    words.push_back(fmt::format("{:.17g}", value));
  words.insert(words.end(), arg + 4, arg + narg);

  std::vector<char *> pointers;
  for (auto &word : words) pointers.push_back(&word[0]);
  return type_coeff(static_cast<int>(pointers.size()), pointers.data(), ilo, ihi, jlo, jhi);
}

/* ----------------------------------------------------------------------
   viscosity between unlike types; return # of pairs
------------------------------------------------------------------------- */

int PairSPHBulk::unlike_coeff(int narg, char **arg, int ilo, int ihi, int jlo, int jhi)
{
  std::vector<std::pair<int, double>> given;
  for (int iarg = 2; iarg < narg; iarg += 2) {
    const std::string keyword = arg[iarg];
    if (is_type_keyword(keyword))
      error->all(FLERR, "Pair_coeff keyword {} belongs to a type, not to a pair of types", keyword);
    const int k = is_viscosity(keyword);
    if (k < 0)
      error->all(FLERR, "Unknown pair_coeff keyword for pair_style {}: {}", fluid_style, keyword);
    if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "pair_coeff " + keyword, error);
    const double value = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    if (k == 0 && !(value >= 0.0))
      error->all(FLERR, "Pair_coeff mu must be >= 0, not {}", arg[iarg + 1]);
    given.emplace_back(k, value);
  }

  int count = 0;
  for (int i = ilo; i <= ihi; i++)
    for (int j = jlo; j <= jhi; j++) {
      if (i == j) continue;
      for (const auto &one : given) {
        viscosity[one.first][i][j] = viscosity[one.first][j][i] = one.second;
        viscosity_set[one.first][i][j] = viscosity_set[one.first][j][i] = 1;
      }
      setflag[std::min(i, j)][std::max(i, j)] = 1;
      count++;
    }
  return count;
}

/* ----------------------------------------------------------------------
   init specific to this pair style
------------------------------------------------------------------------- */

void PairSPHBulk::init_style()
{
  boundaries.clear();
  boundary_bits = 0;
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
  if (!atom->style_match(fluid_style.c_str()))
    error->all(FLERR, "Pair style {} requires atom style {}", fluid_style, fluid_style);
  if (modify->get_fix_by_style("^" + fluid_style + "$").empty())
    error->all(FLERR, "Pair style {} requires fix {}", fluid_style, fluid_style);
  if (force->mvv2e != 1.0)
    error->all(FLERR,
               "Pair style {} requires units in which mass * velocity^2 is an energy, not units {}",
               fluid_style, update->unit_style);

  // LAMMPS's own particle fluids read the masses of types, which do not exist here

  for (const char *other : {"sph/heatconduction", "sph/idealgas", "sph/lj", "sph/rhosum",
                            "sph/taitwater", "sph/taitwater/morris", "sdpd/taitwater/isothermal"})
    if (force->pair_match(other, 1))
      error->all(FLERR,
                 "Pair style {} cannot be combined with pair style {}, which needs masses by type",
                 fluid_style, other);

  dim = choice->dim ? choice->dim : domain->dimension;
  if (dim == 1 && domain->dimension == 3)
    error->all(FLERR, "Pair_style {} dim 1 requires a 2d box", fluid_style);
  if (dim != 1 && dim != domain->dimension)
    error->all(FLERR, "Pair_style {} dim {} does not match the {}-d simulation box", fluid_style,
               dim, domain->dimension);

  support = 0.0;
  for (int i = 1; i <= atom->ntypes; i++) {
    if (!setflag[i][i]) continue;
    if (support == 0.0) support = coeffs[i].rc;
    if (coeffs[i].rc != support)
      error->all(FLERR,
                 "Pair style {} rc must be the same for all types: {} of type {} differs from {}",
                 fluid_style, coeffs[i].rc, i, support);
  }

  if (comm->cutghostuser > 0.0 && comm->cutghostuser < support)
    error->all(FLERR,
               "The ghost cutoff {} of comm_modify is smaller than the support radius {} of "
               "pair style {}",
               comm->cutghostuser, support, fluid_style);
  if (dim == 1) check_line_of_particles();
}

/* ----------------------------------------------------------------------
   also during a run, for fixes that insert particles, whose mass is zero at first
------------------------------------------------------------------------- */

void PairSPHBulk::check_masses()
{
  double lightest = 1.0;
  tagint id = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if (!(atom->rmass[i] > 0.0)) {
      lightest = 0.0;
      id = atom->tag[i];
    }
  double lightest_all;
  tagint id_all;
  MPI_Allreduce(&lightest, &lightest_all, 1, MPI_DOUBLE, MPI_MIN, world);
  MPI_Allreduce(&id, &id_all, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if (lightest_all <= 0.0)
    error->all(FLERR,
               "Pair style {}: mass must be > 0, which that of particle {} is not; "
               "use the set command",
               fluid_style, id_all);
}

/* ----------------------------------------------------------------------
   dim 1: the periodic images across the line must not interact
------------------------------------------------------------------------- */

void PairSPHBulk::check_line_of_particles()
{
  constexpr double FAR = 1.0e300;
  double extent[4] = {-FAR, -FAR, -FAR, -FAR}, all[4];    // largest x, -x, y, -y
  for (int i = 0; i < atom->nlocal; i++)
    for (int d = 0; d < 2; d++) {
      extent[2 * d] = std::max(extent[2 * d], atom->x[i][d]);
      extent[2 * d + 1] = std::max(extent[2 * d + 1], -atom->x[i][d]);
    }
  MPI_Allreduce(extent, all, 4, MPI_DOUBLE, MPI_MAX, world);

  const int across = (all[0] + all[1] < all[2] + all[3]) ? 0 : 1;
  const double *const prd = domain->prd;
  if (domain->periodicity[across] && prd[across] <= support)
    error->all(FLERR,
               "Pair_style {}: box too narrow for dim 1: its {} extent {} must be "
               "larger than the support radius {}",
               fluid_style, "xy"[across], prd[across], support);
}

/* ----------------------------------------------------------------------
   viscosities of unlike types and coefficients of the bulk term
------------------------------------------------------------------------- */

void PairSPHBulk::derive_coeffs()
{
  const int n = atom->ntypes;
  std::vector<PairCoeff> pair_coeffs((n + 1) * (n + 1));

  for (int i = 1; i <= n; i++) {
    TypeCoeff &type = coeffs[i];
    type.eos.gamma = (type.gamma > 0.0) ? type.gamma : default_gamma(choice->eos);
    if (choice->eos == Eos::IDEAL && !(type.eos.gamma > 1.0))
      error->all(FLERR, "Pair_coeff gamma must be > 1 with eos ideal, not {} for type {}",
                 type.eos.gamma, i);

    for (int k = 0; k < nviscosity(); k++) {
      viscosity[k][i][i] = type.viscosity[k];
      for (int j = 1; j < i; j++)
        if (!viscosity_set[k][i][j]) {
          const double a = type.viscosity[k], b = coeffs[j].viscosity[k];
          viscosity[k][i][j] = viscosity[k][j][i] = (a * b > 0.0) ? 2.0 * a * b / (a + b) : 0.0;
        }
    }
    for (int j = 1; j <= i; j++) {
      if (setflag[i][i] && setflag[j][j]) check_pair(i, j);
      pair_coeffs[i * (n + 1) + j] = pair_coeffs[j * (n + 1) + i] = pair_coefficients(i, j);
    }

    const double intrinsic = intrinsic_kappa_of(i, i);
    type.zeta = (type.intrinsic || choice->bulk == Bulk::NONE) ? 0.0 : type.kappa - intrinsic;
    if (!announced && choice->bulk == Bulk::NONE && !type.intrinsic && setflag[i][i] &&
        type.kappa != intrinsic && comm->me == 0)
      error->warning(FLERR,
                     "Pair_coeff kappa {} of type {} is ignored with bulk none: the shear "
                     "term gives kappa {}",
                     type.kappa, i, intrinsic);
  }

  engine->setup(choice->kernel, dim, support, choice->shear, choice->bulk, pair_coeffs, n);
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
  return shear_coefficients(choice->shear, dim, viscosity[0][i][j],
                            kernel_mean_radius(choice->kernel, dim, support));
}

double PairSPHBulk::intrinsic_kappa_of(int i, int j) const
{
  return intrinsic_kappa(choice->shear, dim, viscosity[0][i][j]);
}

double PairSPHBulk::reference_density(int type) const
{
  return coeffs[type].eos.rho0;
}

void PairSPHBulk::check_pair(int i, int j)
{
  if (choice->shear == Shear::NONE && viscosity[0][i][j] != 0.0)
    error->all(FLERR, "Pair_coeff mu must be 0 with shear none, not {} for types {} {}",
               viscosity[0][i][j], j, i);
}

PairSPHBulk::Columns PairSPHBulk::table_columns(int i, int j, double kappa, double zeta) const
{
  const PairCoeff coeff = pair_coefficients(i, j);
  return {{"mu", viscosity[0][i][j]},
          {"kappa", kappa},
          {"zeta", zeta},
          {"shear_coeff", std::max(coeff.along_r, coeff.along_u)}};
}

PairSPHBulk::Columns PairSPHBulk::viscous_steps(int i, int j, double hsq, double rho) const
{
  return {{"shear", shear_step(choice->shear, hsq, viscosity[0][i][j] / rho)}};
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

  const double hsq = stability_length_squared(kernel_slope_integral(choice->kernel, dim, support));
  std::string table;
  double smallest = UNLIMITED_STEP;

  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      if (!setflag[i][i] || !setflag[j][j]) continue;
      const TypeCoeff &a = coeffs[i], &b = coeffs[j];
      const double zeta = 0.5 * (a.zeta + b.zeta);
      const double rho = std::min(a.eos.rho0, b.eos.rho0);

      const Columns values = table_columns(i, j, zeta + intrinsic_kappa_of(i, j), zeta);
      const double acoustic = acoustic_step(sqrt(hsq), std::max(a.eos.c0, b.eos.c0) + fastest);
      Columns steps = viscous_steps(i, j, hsq, rho);
      steps.insert(steps.begin() + 1, {"bulk", bulk_step(hsq, zeta / rho)});
      double viscous_rate = 0.0;
      for (const auto &step : steps) viscous_rate += 1.0 / step.second;
      steps.insert(steps.begin(), {"acoustic", acoustic});
      steps.push_back({"all", std::min(acoustic, 1.0 / viscous_rate)});
      smallest = std::min(smallest, steps.back().second);

      if (table.empty()) {
        table = "  types   ";
        for (const auto &value : values) table += fmt::format(" {:<11}", value.first);
        table += " | largest stable time step:";
        for (const auto &step : steps) table += fmt::format(" {:<10}", step.first);
        table += "\n";
      }
      table += fmt::format("  {:<8}", fmt::format("{}-{}", i, j));
      for (const auto &value : values) table += fmt::format(" {:<11.4g}", value.second);
      table += " |                          ";
      for (const auto &step : steps)
        table += (step.second < UNLIMITED_STEP) ? fmt::format(" {:<10.4g}", step.second)
                                                : fmt::format(" {:<10}", "-");
      table += "\n";
    }

  table = fmt::format("Pair style {}: kernel {}, dim {}, eos {}, shear {}, bulk {}, support radius "
                      "{:g}, {} loops\n",
                      fluid_style, kernel_name(choice->kernel), dim, eos_name(choice->eos),
                      shear_name(choice->shear), bulk_name(choice->bulk), support,
                      engine->instruction_set()) +
      table;
  if (!announced && comm->me == 0) utils::logmesg(lmp, table);
  announced = true;

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
  if (i != j && !viscosity_set[0][i][j]) did_mix = true;
  return support;
}

/* ----------------------------------------------------------------------
   proc 0 writes to restart file
------------------------------------------------------------------------- */

void PairSPHBulk::write_restart(FILE *fp)
{
  write_restart_settings(fp);
  for (int i = 1; i <= atom->ntypes; i++) {
    fwrite(&setflag[i][i], sizeof(int), 1, fp);
    double stored[TypeCoeff::NSTORED];
    coeffs[i].store(stored);
    fwrite(stored, sizeof(double), TypeCoeff::NSTORED, fp);
    for (int k = 0; k < nviscosity(); k++) {
      fwrite(viscosity_set[k][i], sizeof(int), atom->ntypes + 1, fp);
      fwrite(viscosity[k][i], sizeof(double), atom->ntypes + 1, fp);
    }
  }
}

/* ----------------------------------------------------------------------
   proc 0 reads from restart file, bcasts
------------------------------------------------------------------------- */

void PairSPHBulk::read_restart(FILE *fp)
{
  read_restart_settings(fp);
  allocate();

  const int n = atom->ntypes + 1;
  for (int i = 1; i < n; i++) {
    double stored[TypeCoeff::NSTORED];
    if (comm->me == 0) {
      utils::sfread(FLERR, &setflag[i][i], sizeof(int), 1, fp, nullptr, error);
      utils::sfread(FLERR, stored, sizeof(double), TypeCoeff::NSTORED, fp, nullptr, error);
    }
    MPI_Bcast(&setflag[i][i], 1, MPI_INT, 0, world);
    MPI_Bcast(stored, TypeCoeff::NSTORED, MPI_DOUBLE, 0, world);
    coeffs[i].restore(stored);
    for (int k = 0; k < nviscosity(); k++) {
      if (comm->me == 0) {
        utils::sfread(FLERR, viscosity_set[k][i], sizeof(int), n, fp, nullptr, error);
        utils::sfread(FLERR, viscosity[k][i], sizeof(double), n, fp, nullptr, error);
      }
      MPI_Bcast(viscosity_set[k][i], n, MPI_INT, 0, world);
      MPI_Bcast(viscosity[k][i], n, MPI_DOUBLE, 0, world);
      for (int j = i + 1; j < n; j++)
        if (viscosity_set[k][i][j]) setflag[i][j] = 1;
    }
  }
}

/* ----------------------------------------------------------------------
   proc 0 writes to restart file
------------------------------------------------------------------------- */

void PairSPHBulk::write_restart_settings(FILE *fp)
{
  fwrite(choice, sizeof(Settings), 1, fp);
}

/* ----------------------------------------------------------------------
   proc 0 reads from restart file, bcasts
------------------------------------------------------------------------- */

void PairSPHBulk::read_restart_settings(FILE *fp)
{
  if (comm->me == 0) utils::sfread(FLERR, choice, sizeof(Settings), 1, fp, nullptr, error);
  MPI_Bcast(choice, sizeof(Settings), MPI_BYTE, 0, world);
}

/* ----------------------------------------------------------------------
   proc 0 writes coefficients of types to data file
------------------------------------------------------------------------- */

void PairSPHBulk::write_data(FILE *fp)
{
  for (int i = 1; i <= atom->ntypes; i++) utils::print(fp, "{} {}\n", i, type_line(i));
}

/* ----------------------------------------------------------------------
   proc 0 writes coefficients of types and of unlike pairs to data file
------------------------------------------------------------------------- */

void PairSPHBulk::write_data_all(FILE *fp)
{
  for (int i = 1; i <= atom->ntypes; i++) {
    utils::print(fp, "{} {} {}\n", i, i, type_line(i));
    for (int j = i + 1; j <= atom->ntypes; j++) {
      utils::print(fp, "{} {}", i, j);
      for (int k = 0; k < nviscosity(); k++)
        utils::print(fp, " {} {:.17g}", viscosity_names[k], viscosity[k][i][j]);
      utils::print(fp, "\n");
    }
  }
}

/* ----------------------------------------------------------------------
   arguments of pair_coeff I I
------------------------------------------------------------------------- */

std::string PairSPHBulk::type_line(int i) const
{
  const TypeCoeff &c = coeffs[i];
  std::string line = fmt::format("{:.17g} {:.17g} {:.17g} {}", c.eos.rho0, c.eos.c0, c.viscosity[0],
                                 c.intrinsic ? "intrinsic" : fmt::format("{:.17g}", c.kappa));
  for (int k = 1; k < nviscosity(); k++) line += fmt::format(" {:.17g}", c.viscosity[k]);
  line += fmt::format(" {:.17g} pb {:.17g}", c.rc, c.eos.pb);
  if (c.gamma > 0.0) line += fmt::format(" gamma {:.17g}", c.gamma);
  return line;
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
      return (choice->eos == Eos::IDEAL) ? 3 : 2;
    case Stage::BOUND:
      return 1;
    case Stage::BOUNDARY_STATE:
      return (choice->shear == Shear::MICROPOLAR) ? 9 : 6;
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
      return (choice->shear == Shear::MICROPOLAR) ? 13 : 10;
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
      if (k > 5) return engine->spin[i].w[k - 6];
      return (k == 3) ? particle.vol : (k == 4) ? particle.g : engine->zeta_term[i];
    case Stage::GRADIENT:
      return reinterpret_cast<double *>(engine->gradient + i)[k];
    case Stage::VORTICITY:
      return engine->vorticity[i][k];
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
