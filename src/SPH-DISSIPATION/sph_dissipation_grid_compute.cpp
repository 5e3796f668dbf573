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

#include "sph_dissipation_grid_compute.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "pair_sph_bulk.h"
#include "sph_dissipation_fields.h"
#include "sph_dissipation_fluid.h"
#include "sph_dissipation_grid.h"
#include "sph_dissipation_model.h"

#include <cstring>

using namespace LAMMPS_NS;
using namespace SPHDissipation;

/* ---------------------------------------------------------------------- */

GridCompute::GridCompute(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), count(), linear(true), grid(nullptr), nmax(0), values(nullptr)
{
  if (!domain->box_exist)
    error->all(FLERR, "Compute {} requires a simulation box, which comes later", style);
  if (narg < 6) utils::missing_cmd_args(FLERR, fmt::format("compute {}", style), error);
  for (int d = 0; d < 3; d++) {
    count[d] = utils::inumeric(FLERR, arg[3 + d], false, lmp);
    if (count[d] < 1)
      error->all(FLERR, "Compute {}: the grid must have at least one point per direction", style);
  }
  if (domain->dimension == 2 && count[2] != 1)
    error->all(FLERR, "Compute {}: Nz must be 1 in 2d", style);
  if (!Fields::of(atom))
    error->all(FLERR, "Compute {} requires atom style sph/bulk or sph/micropolar", style);

  pergrid_flag = 1;    // asks for reset_grid() when sub-domains change in a run
  comm_forward = 1;
  grid = new ParticleGrid(lmp, count);
}

/* ---------------------------------------------------------------------- */

GridCompute::~GridCompute()
{
  delete grid;
  memory->destroy(values);
}

/* ----------------------------------------------------------------------
   commands such as replicate change the sub-domains without a word
------------------------------------------------------------------------- */

void GridCompute::init()
{
  const int moved = grid->fits() ? 0 : 1;
  int any_moved;
  MPI_Allreduce(&moved, &any_moved, 1, MPI_INT, MPI_MAX, world);
  if (any_moved) reset_grid();

  if (domain->triclinic)
    error->all(FLERR, "Compute {} needs an orthogonal box, not a triclinic one", style);
  if (fluid()->dimension() != domain->dimension)
    error->all(FLERR, "Compute {} needs a kernel of the dimension of the simulation, not dim {}",
               style, fluid()->dimension());
}

/* ----------------------------------------------------------------------
   looked up at every use, for the pair style may have been replaced since
------------------------------------------------------------------------- */

Fluid *GridCompute::fluid() const
{
  return find_fluid(lmp, fmt::format("Compute {}", style));
}

/* ----------------------------------------------------------------------
   the sub-domains have changed
------------------------------------------------------------------------- */

void GridCompute::reset_grid()
{
  delete grid;
  grid = new ParticleGrid(lmp, count);
}

/* ---------------------------------------------------------------------- */

bool GridCompute::add_value(const std::string &name)
{
  static const struct {
    const char *name;
    Value getter;
    bool spin;
  } KNOWN[] = {
      {"vx", &GridCompute::velocity<0>, false}, {"vy", &GridCompute::velocity<1>, false},
      {"vz", &GridCompute::velocity<2>, false}, {"rho", &GridCompute::density, false},
      {"esph", &GridCompute::energy, false},    {"omegax", &GridCompute::spin<0>, true},
      {"omegay", &GridCompute::spin<1>, true},  {"omegaz", &GridCompute::spin<2>, true},
  };
  for (const auto &value : KNOWN) {
    if (name != value.name) continue;
    if (value.spin && !Fields::with_spins(atom))
      error->all(FLERR, "Compute {} {} requires atom style sph/micropolar", style, name);
    names.push_back(name);
    getters.push_back(value.getter);
    comm_forward = 1 + nvalue();
    return true;
  }
  return false;
}

/* ---------------------------------------------------------------------- */

bool GridCompute::order_keyword(int &iarg, int narg, char **arg)
{
  if (strcmp(arg[iarg], "order") != 0) return false;
  if (iarg + 2 > narg)
    utils::missing_cmd_args(FLERR, fmt::format("compute {} order", style), error);
  const int order = utils::inumeric(FLERR, arg[iarg + 1], false, lmp);
  if (order < 0 || order > 1) error->all(FLERR, "Compute {} order must be 0 or 1", style);
  linear = (order == 1);
  iarg += 2;
  return true;
}

/* ---------------------------------------------------------------------- */

template <int DIM> double GridCompute::velocity(int i) const
{
  return atom->v[i][DIM];
}

template <int DIM> double GridCompute::spin(int i) const
{
  return atom->omega[i][DIM];
}

double GridCompute::density(int i) const
{
  return atom->rho[i];
}

double GridCompute::energy(int i) const
{
  return atom->esph[i] / atom->vfrac[i];
}

/* ---------------------------------------------------------------------- */

bool GridCompute::is_mapped(const Fluid *mapped, int i) const
{
  return (atom->mask[i] & groupbit) && mapped->has_type(atom->type[i]) && !mapped->is_boundary(i);
}

/* ---------------------------------------------------------------------- */

bigint GridCompute::map()
{
  const Fluid *const mapped = fluid();
  if (!mapped->has_forces())
    error->all(FLERR,
               "Compute {} needs the volumes of the particles that are there now: use run 0 first",
               style);

  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->destroy(values);
    memory->create(values, nmax, comm_forward, "sph/grid:values");
  }
  for (int i = 0; i < atom->nlocal; i++) {
    values[i][0] = is_mapped(mapped, i) ? atom->vfrac[i] : 0.0;
    for (int k = 0; k < nvalue(); k++) values[i][1 + k] = (this->*getters[k])(i);
  }

  // a fix may have changed the box at the end of the step, and with it the places of owned particles

  if (domain->box_change) comm->forward_comm();
  comm->forward_comm(this);

  return grid->map({mapped->model->choice.kernel, mapped->support_radius(), linear}, values,
                   nvalue());
}

/* ---------------------------------------------------------------------- */

int GridCompute::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  int m = 0;
  for (int i = 0; i < n; i++)
    for (int k = 0; k < comm_forward; k++) buf[m++] = values[list[i]][k];
  return m;
}

/* ---------------------------------------------------------------------- */

void GridCompute::unpack_forward_comm(int n, int nfirst, double *buf)
{
  int m = 0;
  for (int i = nfirst; i < nfirst + n; i++)
    for (int k = 0; k < comm_forward; k++) values[i][k] = buf[m++];
}

/* ---------------------------------------------------------------------- */

double GridCompute::memory_usage()
{
  return (double) nmax * comm_forward * sizeof(double) + grid->memory_usage();
}
