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

#include "pair_sph_bulk.h"

#include "atom.h"
#include "citeme.h"
#include "error.h"
#include "force.h"
#include "lammps.h"
#include "memory.h"
#include "sph_dissipation_engine.h"
#include "sph_dissipation_exchange.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_model.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

static const char cite_bulk[] =
    "pair sph/bulk command, bulk viscosity: https://doi.org/10.1103/PhysRevE.101.013302\n\n"
    "@Article{BonetAvalos2020,\n"
    " author =  {J. {Bonet Avalos} and M. Antuono and A. Colagrossi and A. Souto-Iglesias},\n"
    " title =   {Shear-viscosity-independent bulk-viscosity term in smoothed particle "
    "hydrodynamics},\n"
    " journal = {Physical Review E},\n"
    " year =    2020,\n"
    " volume =  101,\n"
    " pages =   {013302},\n"
    " doi =     {10.1103/PhysRevE.101.013302},\n"
    "}\n\n";

static const char cite_spin[] =
    "pair sph/micropolar command: https://doi.org/10.1103/PhysRevE.104.015315\n\n"
    "@Article{SoutoIglesias2021,\n"
    " author =  {A. Souto-Iglesias and J. {Bonet Avalos} and M. Antuono and A. Colagrossi},\n"
    " title =   {General isotropic micropolar fluid model in smoothed particle hydrodynamics},\n"
    " journal = {Physical Review E},\n"
    " year =    2021,\n"
    " volume =  104,\n"
    " pages =   {015315},\n"
    " doi =     {10.1103/PhysRevE.104.015315},\n"
    "}\n\n";

static const char cite_sdpd[] =
    "pair sph/bulk command, temp or shear espanol: https://doi.org/10.1103/PhysRevE.67.026705\n\n"
    "@Article{Espanol2003,\n"
    " author =  {P. Espa{\\~n}ol and M. Revenga},\n"
    " title =   {Smoothed dissipative particle dynamics},\n"
    " journal = {Physical Review E},\n"
    " year =    2003,\n"
    " volume =  67,\n"
    " pages =   {026705},\n"
    " doi =     {10.1103/PhysRevE.67.026705},\n"
    "}\n\n";

// Adds the virial of each pair to the accumulators of the pair style; and, if the array exists, the dyad r_ij f_ij, half to
// each particle, to all nine components of the stress per atom, in LAMMPS's order xx yy zz xy xz yz yx zx zy: first index of
// r, second of f.  In general, the forces are not central and the stress is not symmetric: xy - yx is the torque on the
// spins.

class PairSPHBulk::StressTally : public PairTally {
 public:
  StressTally(PairSPHBulk *pair, double **stress, int nlocal, int newton_pair) :
      pair(pair), stress(stress), nlocal(nlocal), newton_pair(newton_pair)
  {
  }
  void tally(int i, int j, const double *f, const double *r) override
  {
    static constexpr int POSITION[9] = {0, 1, 2, 0, 0, 1, 1, 2, 2};
    static constexpr int FORCE[9] = {0, 1, 2, 1, 2, 2, 0, 0, 1};
    for (int k = 0; k < 9 && stress; k++) {
      const double half = 0.5 * r[POSITION[k]] * f[FORCE[k]];
      if (newton_pair || i < nlocal) stress[i][k] += half;
      if (newton_pair || j < nlocal) stress[j][k] += half;
    }
    pair->ev_tally_xyz(i, j, nlocal, newton_pair, 0.0, 0.0, f[0], f[1], f[2], r[0], r[1], r[2]);
  }

 private:
  PairSPHBulk *pair;
  double **stress;
  int nlocal, newton_pair;
};

/* ---------------------------------------------------------------------- */

PairSPHBulk::PairSPHBulk(LAMMPS *lmp) : PairSPHBulk(lmp, false) {}

PairSPHBulk::PairSPHBulk(LAMMPS *lmp, bool spins) : Pair(lmp), fluid(new Fluid(lmp, this, spins))
{
  restartinfo = 1;
  writedata = 1;
  manybody_flag = 1;
  single_enable = 0;
  respa_enable = 0;
  centroidstressflag = CENTROID_AVAIL;
  comm_forward = comm_reverse = Exchange::ROOM;
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
}

/* ---------------------------------------------------------------------- */

Fluid *SPHDissipation::find_fluid(Force *force)
{
  if (!force) return nullptr;    // LAMMPS ends, and deletes fixes last
  for (const char *const name : {"^sph/bulk", "^sph/micropolar"})
    if (auto *pair = dynamic_cast<PairSPHBulk *>(force->pair_match(name, 0)))
      return pair->fluid.get();
  return nullptr;
}

Fluid *SPHDissipation::find_fluid(LAMMPS *lmp, const std::string &user)
{
  Fluid *const fluid = find_fluid(lmp->force);
  if (!fluid) lmp->error->all(FLERR, "{} requires pair style sph/bulk or sph/micropolar", user);
  return fluid;
}

/* ----------------------------------------------------------------------
   Turn off the virial by r f if single particles have a drag: r f is no virial of such forces.  Pair style hybrid has read
   its own flag before this call: hybrid leaves out r f from the next step on.
------------------------------------------------------------------------- */

void PairSPHBulk::sum_virial_by_pairs()
{
  if (fluid->model->constants().drag)
    no_virial_fdotr_compute = force->pair->no_virial_fdotr_compute = 1;
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::compute(int eflag, int vflag)
{
  fluid->adopt();
  sum_virial_by_pairs();
  ev_init(eflag, vflag);
  StressTally stress(this, cvflag_atom ? cvatom : nullptr, atom->nlocal, force->newton_pair);
  pvector[0] = static_cast<double>(fluid->compute(vflag_either ? &stress : nullptr));
  if (eflag_either) {
    const double energy = fluid->energy(eflag_atom ? eatom : nullptr);
    if (eflag_global) eng_vdwl += energy;
  }
  if (vflag_fdotr) virial_fdotr_compute();
}

void PairSPHBulk::finish()
{
  fluid->finish();
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
  fluid->model->allocate();
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::settings(int narg, char **arg)
{
  fluid->settings(narg, arg);
  cite();
}

/* ----------------------------------------------------------------------
   Cite the papers of the settings in use; LAMMPS prints each citation once.
------------------------------------------------------------------------- */

void PairSPHBulk::cite()
{
  if (!lmp->citeme) return;
  const auto &choice = fluid->model->choice;
  if (choice.bulk != Bulk::NONE) lmp->citeme->add(cite_bulk);
  if (fluid->spins) lmp->citeme->add(cite_spin);
  if (choice.thermal || choice.shear == Shear::ESPANOL) lmp->citeme->add(cite_sdpd);
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::coeff(int narg, char **arg)
{
  if (!allocated) allocate();
  fluid->coeff(narg, arg);
}

/* ---------------------------------------------------------------------- */

void PairSPHBulk::init_style()
{
  no_virial_fdotr_compute = 0;
  fluid->init();
  sum_virial_by_pairs();
  fluid->request_list();
}

/* ----------------------------------------------------------------------
   Return the cutoff of a pair of types.  LAMMPS also calls this function after another command, such as fix adapt, has
   changed coefficients.
------------------------------------------------------------------------- */

double PairSPHBulk::init_one(int i, int j)
{
  fluid->derive_anew();
  if (i != j && fluid->model->is_mixed(i, j)) did_mix = true;
  return fluid->support_radius();
}

/* ---------------------------------------------------------------------- */

void *PairSPHBulk::extract(const char *name, int &ndim)
{
  return fluid->model->extract(name, ndim);
}

/* ----------------------------------------------------------------------
   Write and read restart and data files: rank 0 writes, rank 0 reads and broadcasts.
------------------------------------------------------------------------- */

void PairSPHBulk::write_restart(FILE *fp)
{
  write_restart_settings(fp);
  fluid->model->write_coeffs(fp, setflag);
}

void PairSPHBulk::read_restart(FILE *fp)
{
  read_restart_settings(fp);
  allocate();
  fluid->model->read_coeffs(fp, setflag);
}

void PairSPHBulk::write_restart_settings(FILE *fp)
{
  fluid->model->write_settings(fp);
}

void PairSPHBulk::read_restart_settings(FILE *fp)
{
  fluid->model->read_settings(fp);
  cite();
}

void PairSPHBulk::write_data(FILE *fp)
{
  fluid->model->write_data(fp);
}

void PairSPHBulk::write_data_all(FILE *fp)
{
  fluid->model->write_data_all(fp);
}

/* ----------------------------------------------------------------------
   Pack and unpack the messages of the stages.
------------------------------------------------------------------------- */

int PairSPHBulk::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  return fluid->messages().pack_forward(n, list, buf);
}

void PairSPHBulk::unpack_forward_comm(int n, int nfirst, double *buf)
{
  fluid->messages().unpack_forward(n, nfirst, buf);
}

int PairSPHBulk::pack_reverse_comm(int n, int nfirst, double *buf)
{
  return fluid->messages().pack_reverse(n, nfirst, buf);
}

void PairSPHBulk::unpack_reverse_comm(int n, int *list, double *buf)
{
  fluid->messages().unpack_reverse(n, list, buf);
}

/* ---------------------------------------------------------------------- */

double PairSPHBulk::memory_usage()
{
  return Pair::memory_usage() + fluid->memory_usage();
}
